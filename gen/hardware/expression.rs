//! Expressions of VHDL as trees: what an operation prints, and what the printer folds.

use crate::types::Type;
use std::fmt::{self, Display, Formatter};

/// An index of an array.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Index {
    /// A number.
    At(usize),
    /// A loop variable plus an offset, modulo the size of the array where that may be exceeded.
    Loop {
        /// Nesting depth of the loop, which names the variable.
        depth: usize,
        /// Added to it.
        plus: usize,
        /// Size of the array, if the sum wraps around.
        modulo: Option<usize>,
    },
}

/// A step into a composite object.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Sub {
    /// An element of an array.
    Index(Index),
    /// Elements of an array, from one to another; those of flags are counted down.
    Range(usize, usize),
    /// A field of a record.
    Field(&'static str),
}

/// A signal, port or constant, or a part of it.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Name {
    /// The declared name.
    pub base: String,
    /// The steps into it.
    pub subs: Vec<Sub>,
}

impl Name {
    /// A whole object.
    pub fn whole(base: impl Into<String>) -> Self {
        Self { base: base.into(), subs: vec![] }
    }

    /// The same with every index replaced.
    pub fn with_indices(&self, f: &mut dyn FnMut(&Index) -> Index) -> Self {
        let sub = |sub: &Sub| match sub {
            Sub::Index(index) => Sub::Index(f(index)),
            other => other.clone(),
        };
        Self { base: self.base.clone(), subs: self.subs.iter().map(sub).collect() }
    }
}

/// An operand in VHDL.
#[derive(Clone, Debug, PartialEq)]
pub struct Operand {
    /// Its value.
    pub value: Expression,
    /// Its type.
    pub ty: Type,
}

/// An expression. Operands of a binary one are in parentheses unless they bind more tightly.
#[derive(Clone, Debug, PartialEq)]
pub enum Expression {
    /// A name.
    Name(Name),
    /// A number of a type.
    Number(i128, Type),
    /// `left operator right`.
    Binary(Box<Expression>, &'static str, Box<Expression>),
    /// `-x`, `not x`.
    Unary(&'static str, Box<Expression>),
    /// A function or type conversion.
    Call(&'static str, Vec<Expression>),
    /// An integer argument of a function.
    Integer(i128),
    /// A number of a type that counts with a loop.
    Count(Index, Type),
    /// Bits of a name, `(high downto low)`.
    Slice(Box<Expression>, u32, u32),
    /// One bit of a name.
    Bit(Box<Expression>, u32),
    /// Entry of a constant table by an unsigned index; the printer declares the table and gives it a name.
    Table {
        /// Name of the table.
        name: String,
        /// Its entries.
        entries: Vec<i128>,
        /// Type of an entry.
        ty: Type,
        /// The index.
        index: Box<Operand>,
    },
    /// The leg that an unsigned index chooses; the last serves all greater ones.
    Select(Box<Operand>, Vec<Expression>),
}

/// The name of a loop variable by the depth of its loop.
pub fn loop_variable(depth: usize) -> &'static str {
    ["i", "k", "m", "n"][depth.min(3)]
}

impl Expression {
    /// `self + other`.
    pub fn plus(self, other: Self) -> Self {
        Self::Binary(Box::new(self), "+", Box::new(other))
    }

    /// A call.
    pub fn call(name: &'static str, args: impl Into<Vec<Self>>) -> Self {
        Self::Call(name, args.into())
    }

    /// A binary expression.
    pub fn binary(self, operator: &'static str, other: Self) -> Self {
        Self::Binary(Box::new(self), operator, Box::new(other))
    }

    /// What is compared, or is an index: in simulation a signal may have no value before the first clock.
    pub fn known(self, ty: Type) -> Self {
        let constant = matches!(self, Self::Number(..) | Self::Count(..));
        if ty.is_flag() || constant { self } else { Self::call("known", [self]) }
    }

    /// A unary expression.
    pub fn unary(operator: &'static str, x: Self) -> Self {
        Self::Unary(operator, Box::new(x))
    }

    /// Bits of a name, or of bits of a name.
    pub fn slice(self, high: u32, low: u32) -> Self {
        match self {
            Self::Slice(name, _, below) => Self::Slice(name, below + high, below + low),
            // In VHDL-93 no bits can be taken of a conversion: it is the bits that are converted.
            Self::Call(name, args) if Self::converts(name) => {
                Self::Call(name, args.into_iter().map(|name| name.slice(high, low)).collect())
            }
            name => Self::Slice(Box::new(name), high, low),
        }
    }

    /// A bit of a name, or of bits of a name.
    pub fn bit(self, i: u32) -> Self {
        match self {
            Self::Slice(name, _, below) => Self::Bit(name, below + i),
            Self::Call(name, mut args) if Self::converts(name) => args.remove(0).bit(i),
            name => Self::Bit(Box::new(name), i),
        }
    }

    /// Whether a function is a conversion of vectors, bit for bit.
    fn converts(function: &str) -> bool {
        ["signed", "unsigned"].contains(&function)
    }

    /// The number behind a literal.
    pub fn number(&self) -> Option<i128> {
        match self {
            Self::Number(value, _) => Some(*value),
            _ => None,
        }
    }

    /// How tightly it binds: operands that bind less tightly than their operator are put in parentheses.
    fn binding(&self) -> u8 {
        match self {
            Self::Binary(_, "and" | "or" | "xor" | "nand" | "nor", _) => 0,
            Self::Binary(_, "=" | "/=" | "<" | ">" | "<=" | ">=", _) => 1,
            Self::Binary(_, "+" | "-" | "&", _) => 2,
            Self::Unary("-", _) => 2,
            Self::Binary(..) => 3,
            Self::Unary(..) => 4,
            _ => 5,
        }
    }

    /// The direct parts, in order.
    pub fn parts(&self) -> Vec<&Self> {
        match self {
            Self::Name(_) | Self::Number(..) | Self::Integer(_) | Self::Count(..) => vec![],
            Self::Binary(a, _, b) => vec![a, b],
            Self::Unary(_, a) | Self::Slice(a, ..) | Self::Bit(a, _) => vec![a],
            Self::Call(_, args) => args.iter().collect(),
            Self::Table { index, .. } => vec![&index.value],
            Self::Select(index, legs) => std::iter::once(&index.value).chain(legs).collect(),
        }
    }

    /// The same with every direct part replaced.
    pub fn with_parts(&self, mut f: impl FnMut(&Self) -> Self) -> Self {
        let operand =
            |o: &Operand, f: &mut dyn FnMut(&Self) -> Self| Box::new(Operand { value: f(&o.value), ty: o.ty });
        match self {
            Self::Name(_) | Self::Number(..) | Self::Integer(_) | Self::Count(..) => self.clone(),
            Self::Binary(a, op, b) => Self::Binary(Box::new(f(a)), op, Box::new(f(b))),
            Self::Unary(op, a) => Self::Unary(op, Box::new(f(a))),
            Self::Slice(a, high, low) => Self::Slice(Box::new(f(a)), *high, *low),
            Self::Bit(a, i) => Self::Bit(Box::new(f(a)), *i),
            Self::Call(name, args) => Self::Call(name, args.iter().map(f).collect()),
            Self::Table { name, entries, ty, index } => {
                Self::Table { name: name.clone(), entries: entries.clone(), ty: *ty, index: operand(index, &mut f) }
            }
            Self::Select(index, legs) => {
                let index = operand(index, &mut f);
                Self::Select(index, legs.iter().map(f).collect())
            }
        }
    }

    /// The same with every index replaced.
    pub fn with_indices(&self, f: &mut dyn FnMut(&Index) -> Index) -> Self {
        match self {
            Self::Name(name) => Self::Name(name.with_indices(f)),
            Self::Count(index, ty) => Self::Count(f(index), *ty),
            other => other.with_parts(|part| part.with_indices(f)),
        }
    }

    /// Every name in it.
    pub fn names(&self) -> Vec<&Name> {
        match self {
            Self::Name(name) => vec![name],
            other => other.parts().into_iter().flat_map(Self::names).collect(),
        }
    }
}

impl Operand {
    /// The operand in another number of bits: widened by its own sign, or cut where the value is known to fit.
    pub fn resized(&self, to: Type) -> Expression {
        let (value, bits) = (self.value.clone(), Expression::Integer(i128::from(to.bits)));
        if let Some(number) = value.number() {
            return Expression::Number(number, to);
        }
        if self.ty.is_flag() {
            return match (to.is_flag(), to.signed) {
                (true, _) => value,
                (false, true) => Expression::call("to_signed", [value, bits]),
                (false, false) => Expression::call("to_unsigned", [value, bits]),
            };
        }
        if to.is_flag() {
            return value.bit(0);
        }
        let sized = match to.bits.cmp(&self.ty.bits) {
            std::cmp::Ordering::Less => value.slice(to.bits - 1, 0),
            std::cmp::Ordering::Equal => value,
            std::cmp::Ordering::Greater => Expression::call("resize", [value, bits]),
        };
        // What is converted has no type of its own where parts are joined: vectors of words are joined by the same sign.
        let whole = |name, sized: Expression| match &sized {
            Expression::Binary(_, "&", _) => Expression::call(name, [sized]),
            _ => sized,
        };
        match (self.ty.signed, to.signed) {
            (false, true) => Expression::call("signed", [whole("unsigned'", sized)]),
            (true, false) => Expression::call("unsigned", [whole("signed'", sized)]),
            _ => sized,
        }
    }
}

/// A number as a value of its type.
fn literal(value: i128, ty: Type) -> String {
    if ty.is_flag() {
        return format!("'{value}'");
    }
    if i32::try_from(value).is_ok() {
        return format!("to_{}({value}, {})", if ty.signed { "signed" } else { "unsigned" }, ty.bits);
    }
    let bits: String = (0..ty.bits).rev().map(|i| if value >> i & 1 == 1 { '1' } else { '0' }).collect();
    format!("\"{bits}\"")
}

impl Display for Index {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::At(i) => write!(f, "{i}"),
            Self::Loop { depth, plus, modulo } => {
                let variable = loop_variable(*depth);
                match (plus, modulo) {
                    (0, None) => write!(f, "{variable}"),
                    (0, Some(size)) => write!(f, "{variable} mod {size}"),
                    (plus, None) => write!(f, "{variable} + {plus}"),
                    (plus, Some(size)) => write!(f, "({variable} + {plus}) mod {size}"),
                }
            }
        }
    }
}

impl Display for Name {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.base)?;
        self.subs.iter().try_for_each(|sub| match sub {
            Sub::Index(index) => write!(f, "({index})"),
            Sub::Range(from, to) if from > to => write!(f, "({from} downto {to})"),
            Sub::Range(from, to) => write!(f, "({from} to {to})"),
            Sub::Field(field) => write!(f, ".{field}"),
        })
    }
}

impl Display for Expression {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        // The right operand of an operator that is not associative binds more tightly.
        let operand = |x: &Self, least: u8| if x.binding() < least { format!("({x})") } else { x.to_string() };
        match self {
            Self::Name(name) => write!(f, "{name}"),
            Self::Number(value, ty) => write!(f, "{}", literal(*value, *ty)),
            Self::Integer(value) => write!(f, "{value}"),
            Self::Count(index, ty) => {
                write!(f, "to_{}({index}, {})", if ty.signed { "signed" } else { "unsigned" }, ty.bits)
            }
            Self::Binary(a, op, b) => {
                let binding = self.binding();
                // In sums and comparisons numeric_std takes small numbers as they are: logic it does not have on numbers, and a
                // product with one has twice the bits of the other factor.
                let plain = binding == 1 || matches!(*op, "+" | "-");
                let number = |x: &Self| match x {
                    Self::Number(value, ty) if plain && !ty.is_flag() && (0..1 << 31).contains(value) => {
                        Some(value.to_string())
                    }
                    Self::Count(index, _) if plain => Some(index.to_string()),
                    _ => None,
                };
                // Logic mixes with nothing without parentheses, and neither do two kinds of it.
                let tight = if binding == 0 { 2 } else { binding };
                let left = match **a {
                    Self::Binary(_, inner, _) if inner == *op && binding != 1 => a.to_string(),
                    _ => number(a).unwrap_or_else(|| operand(a, tight)),
                };
                let same = matches!(**b, Self::Binary(_, inner, _) if inner == *op && binding == 0);
                let right = if same { b.to_string() } else { number(b).unwrap_or_else(|| operand(b, binding + 1)) };
                write!(f, "{left} {op} {right}")
            }
            Self::Unary("-", a) => write!(f, "-{}", operand(a, 4)),
            Self::Unary(op, a) => write!(f, "{op} {}", operand(a, 5)),
            Self::Call(name, args) => {
                let args: Vec<String> = args.iter().map(ToString::to_string).collect();
                write!(f, "{name}({})", args.join(", "))
            }
            Self::Slice(a, high, low) => write!(f, "{a}({high} downto {low})"),
            Self::Bit(a, i) => write!(f, "{a}({i})"),
            Self::Table { name, ty, index, .. } => {
                let entry = format!("{name}(to_integer({}))", index.value.clone().known(index.ty));
                match (ty.is_flag(), ty.signed) {
                    (true, _) => write!(f, "{entry}"),
                    (false, true) => write!(f, "to_signed({entry}, {})", ty.bits),
                    (false, false) => write!(f, "to_unsigned({entry}, {})", ty.bits),
                }
            }
            Self::Select(index, legs) => match &legs[..] {
                [clear, set] if index.ty.is_flag() => write!(f, "choose({}, {set}, {clear})", index.value),
                _ => panic!("a choice among {} is a statement of its own", legs.len()),
            },
        }
    }
}
