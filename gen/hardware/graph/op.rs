//! The operations of a graph: their width rules, their meaning on integers, and their ranges, one match each.

use super::Unit;
use std::rc::Rc;

/// Type of a node: a two's-complement or unsigned integer of `bits` bits whose unit in the last place is
/// 2^-`fraction`. One unsigned bit is a flag.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Type {
    /// Whether the top bit is a sign.
    pub signed: bool,
    /// Number of bits, at least one.
    pub bits: u32,
    /// Fraction bits, possibly negative.
    pub fraction: i32,
}

impl Type {
    /// A signed number.
    pub const fn signed(bits: u32, fraction: i32) -> Self {
        Self { signed: true, bits, fraction }
    }

    /// An unsigned integer.
    pub const fn unsigned(bits: u32) -> Self {
        Self { signed: false, bits, fraction: 0 }
    }

    /// One bit.
    pub const FLAG: Self = Self::unsigned(1);

    /// The least and the greatest value.
    pub const fn limits(self) -> (i128, i128) {
        if self.signed { (-(1 << (self.bits - 1)), (1 << (self.bits - 1)) - 1) } else { (0, (1 << self.bits) - 1) }
    }
}

impl std::fmt::Display for Type {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match (self.signed, self.bits) {
            (true, bits) => write!(f, "s{}.{}", bits as i32 - self.fraction, self.fraction),
            (false, 1) => write!(f, "flag"),
            (false, bits) if self.fraction == 0 => write!(f, "u{bits}"),
            (false, bits) => write!(f, "u{}.{}", bits as i32 - self.fraction, self.fraction),
        }
    }
}

/// A set of integers from the first to the second bound, both included.
pub type Range = (i128, i128);

/// An operation. Operands are the node's arguments, in order.
#[derive(Clone, Debug)]
pub enum Op {
    /// An input port of the unit.
    Input,
    /// A constant.
    Constant(i128),
    /// Exact sum, one bit wider than its operands.
    Add,
    /// Exact difference, signed, one bit wider.
    Subtract,
    /// Exact negation, signed, one bit wider.
    Negate,
    /// The second operand, negated where the first, a flag, is set; range analysis must show that it fits.
    NegateIf,
    /// Exact product, as wide as both operands together: one hardware multiplier if both fit it.
    Multiply,
    /// Flag: both operands equal.
    Equal,
    /// Bitwise conjunction of unsigned operands of one width.
    And,
    /// Bitwise disjunction of unsigned operands of one width.
    Or,
    /// Bitwise complement of an unsigned operand.
    Not,
    /// Flag: some bit of an unsigned operand is set.
    AnyBit,
    /// Flag: the operand is negative.
    SignBit,
    /// Absolute value of a signed operand, unsigned, as wide.
    Magnitude,
    /// Drops this many low bits: rounds towards minus infinity.
    Floor(u32),
    /// Appends this many zero fraction bits; the value stays.
    Append(u32),
    /// This many low bits, unsigned, keeping the place of the binary point.
    LowBits(u32),
    /// Bounds the operand to `[-bound, bound]`: sound where the true value lies inside by the named lemma.
    Clamp(i128, &'static str),
    /// The same value in another number of bits; range analysis must show that nothing is lost.
    Resize(Type),
    /// The same bits with another place of the binary point.
    Reinterpret(i32),
    /// No hardware: a bound on the computed value that interval ranges cannot see, by the named lemma. Checked at
    /// every evaluation.
    Assert(Range, &'static str),
    /// No hardware: what the first operand is known to equal, as a function of the others; gives it the exact range.
    /// Checked at every evaluation.
    Fact(Fact),
    /// A constant table indexed by an unsigned operand.
    Lookup(Vec<i128>, Type),
    /// The operand chosen by an unsigned first operand: 0 takes the first of the others.
    Select,
    /// Operands side by side, the first in the low bits and with its binary point; only the last may be signed.
    Concatenate,
    /// A constant that depends on the phase of the pair's slot: entry s in phase s; none where it does not matter.
    Phase(Vec<Option<i128>>, Type),
    /// The pair's value of a per-phase operand in one phase, captured and held. `lagged` phases belong to the pair
    /// whose slot began a whole number of intervals earlier (see [`Op::Choose`]).
    Hold {
        /// Phase captured.
        phase: usize,
        /// Whether the phase is a lagged one.
        lagged: bool,
    },
    /// Per-phase choice among per-pair (or per-phase) operands by a [`Op::Phase`] pattern, the first operand.
    /// `lagged` legs are read a whole number of intervals later than the others: that is how a stage feeds results of
    /// early phases back into its late phases without waiting.
    Choose {
        /// One flag per leg.
        lagged: Vec<bool>,
    },
    /// Running disjunction over phases: first operand the value, second a flag set in the phase that starts anew.
    ScanOr,
    /// An instance of a unit; its arguments are the unit's inputs, in order.
    Instance(Rc<Unit>),
    /// This output of an instance.
    Output(usize),
}

/// What a value is known to equal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fact {
    /// The product of the second and third operand: a sum of tiles is the product they were cut from.
    Product,
    /// The second operand divided by 2^n, rounded up: floor + OR of the n dropped bits.
    Ceiling(u32),
}

impl Fact {
    fn value(self, args: &[i128]) -> i128 {
        match self {
            Fact::Product => args[1] * args[2],
            Fact::Ceiling(drop) => -(-args[1] >> drop),
        }
    }
}

fn same_kind(name: &str, types: &[Type]) -> Result<Type, String> {
    let (first, rest) = types.split_first().ok_or("no operands")?;
    let mut joined = *first;
    for t in rest {
        if t.signed != first.signed || t.fraction != first.fraction {
            return Err(format!("{name} of {first} and {t}: sign or binary point differ"));
        }
        joined.bits = joined.bits.max(t.bits);
    }
    Ok(joined)
}

impl Op {
    /// The width rules: the type of the result from the types of the operands.
    ///
    /// # Errors
    /// What does not fit, with both types.
    pub fn result(&self, args: &[Type]) -> Result<Type, String> {
        let unsigned = |name: &str| {
            let t = same_kind(name, args)?;
            if t.signed || args.iter().any(|a| a.bits != t.bits) {
                return Err(format!("{name} needs unsigned operands of one width, found {args:?}"));
            }
            Ok(t)
        };
        let wider = |t: Type, signed| Type { signed, bits: t.bits + 1, fraction: t.fraction };
        match self {
            Op::Input | Op::Instance(_) | Op::Output(_) | Op::Choose { .. } => Err("typed where it is made".to_owned()),
            Op::Constant(_) => Err("typed where it is made".to_owned()),
            Op::Add => {
                let [a, b] = [args[0], args[1]];
                if a.fraction != b.fraction {
                    return Err(format!("addition of {a} and {b}: binary points differ"));
                }
                // An unsigned operand takes one more bit to become signed.
                let signed = a.signed || b.signed;
                let bits = [a, b].map(|t| t.bits + u32::from(signed && !t.signed)).into_iter().max().unwrap_or(1);
                Ok(Type { signed, bits: bits + 1, fraction: a.fraction })
            }
            Op::Subtract => Ok(wider(same_kind("difference", args)?, true)),
            Op::Negate => Ok(wider(args[0], true)),
            Op::NegateIf if args[0] == Type::FLAG && args[1].signed => Ok(args[1]),
            Op::NegateIf => Err(format!("{} cannot be negated by {}", args[1], args[0])),
            Op::Multiply => {
                let [a, b] = [args[0], args[1]];
                if !(a.signed && b.signed) {
                    return Err(format!("product of {a} and {b}: both must be signed"));
                }
                Ok(Type::signed(a.bits + b.bits, a.fraction + b.fraction))
            }
            Op::Equal => same_kind("comparison", args).map(|_| Type::FLAG),
            Op::And => unsigned("and"),
            Op::Or => unsigned("or"),
            Op::Not => unsigned("not"),
            Op::AnyBit => unsigned("any bit").map(|_| Type::FLAG),
            Op::SignBit if args[0].signed => Ok(Type::FLAG),
            Op::Magnitude if args[0].signed => Ok(Type { signed: false, ..args[0] }),
            Op::SignBit | Op::Magnitude => Err(format!("{} has no sign", args[0])),
            Op::Floor(drop) | Op::LowBits(drop) if *drop == 0 || *drop >= args[0].bits => {
                Err(format!("{drop} bits cut from {}", args[0]))
            }
            Op::Floor(drop) => {
                let a = args[0];
                Ok(Type { bits: a.bits - drop, fraction: a.fraction - *drop as i32, ..a })
            }
            Op::Append(zeros) => {
                let a = args[0];
                Ok(Type { bits: a.bits + zeros, fraction: a.fraction + *zeros as i32, ..a })
            }
            Op::LowBits(bits) => Ok(Type { signed: false, bits: *bits, fraction: args[0].fraction }),
            Op::Clamp(..) | Op::Assert(..) | Op::Fact(_) => Ok(args[0]),
            Op::Resize(t) if t.fraction != args[0].fraction => Err(format!("resize of {} to {t}", args[0])),
            Op::Resize(t) => Ok(*t),
            Op::Reinterpret(fraction) => Ok(Type { fraction: *fraction, ..args[0] }),
            Op::Lookup(table, t) => {
                if table.len() > 1usize << args[0].bits {
                    return Err(format!("table of {} entries indexed by {}", table.len(), args[0]));
                }
                Ok(*t)
            }
            Op::Select => same_kind("select", &args[1..]),
            Op::Concatenate => {
                let (last, low) = args.split_last().ok_or("no operands")?;
                if let Some(signed) = low.iter().find(|a| a.signed) {
                    return Err(format!("{signed} below other bits"));
                }
                let fraction = args[0].fraction;
                Ok(Type { signed: last.signed, bits: args.iter().map(|a| a.bits).sum(), fraction })
            }
            Op::Phase(_, t) => Ok(*t),
            Op::Hold { .. } => Ok(args[0]),
            Op::ScanOr => same_kind("scan", &args[..1]),
        }
    }

    /// What a combinational operation computes, on integers.
    ///
    /// # Panics
    /// If a lemma is violated (an [`Op::Assert`] that does not hold) or the operation is no combinational one.
    #[inline]
    pub fn apply(&self, args: &[i128], types: &[Type], result: Type) -> i128 {
        match self {
            Op::Constant(c) => *c,
            Op::Add => args[0] + args[1],
            Op::Subtract => args[0] - args[1],
            Op::Negate => -args[0],
            Op::NegateIf if args[0] == 1 => -args[1],
            Op::NegateIf => args[1],
            Op::Multiply => args[0] * args[1],
            Op::Equal => i128::from(args[0] == args[1]),
            Op::And => args[0] & args[1],
            Op::Or => args[0] | args[1],
            Op::Not => ((1 << result.bits) - 1) - args[0],
            Op::AnyBit => i128::from(args[0] != 0),
            Op::SignBit => i128::from(args[0] < 0),
            Op::Magnitude => args[0].abs(),
            Op::Floor(drop) => args[0] >> drop,
            Op::Append(zeros) => args[0] << zeros,
            Op::LowBits(bits) => args[0] & ((1 << bits) - 1),
            Op::Clamp(bound, _) => args[0].clamp(-bound, *bound),
            Op::Resize(_) | Op::Reinterpret(_) => args[0],
            Op::Assert((lo, hi), lemma) => {
                assert!(*lo <= args[0] && args[0] <= *hi, "lemma {lemma}: {} outside [{lo}, {hi}]", args[0]);
                args[0]
            }
            Op::Fact(fact) => {
                assert_eq!(args[0], fact.value(args), "{fact:?} of {args:?}");
                args[0]
            }
            Op::Lookup(table, _) => table.get(args[0] as usize).copied().unwrap_or(0),
            Op::Select => args[1 + (args[0] as usize).min(args.len() - 2)],
            Op::Concatenate => args.iter().zip(types).rev().fold(0, |word, (a, t)| (word << t.bits) | a),
            Op::Input
            | Op::Phase(..)
            | Op::Hold { .. }
            | Op::Choose { .. }
            | Op::ScanOr
            | Op::Instance(_)
            | Op::Output(_) => unreachable!("{self:?} is no combinational operation"),
        }
    }

    /// The range of a combinational operation from the ranges of its operands: an enclosure of [`Op::apply`].
    pub fn range(&self, args: &[Range], types: &[Type], result: Type) -> Range {
        let corners = |f: &dyn Fn(i128, i128) -> i128| {
            let [a, b] = [args[0], args[1]];
            let all = [f(a.0, b.0), f(a.0, b.1), f(a.1, b.0), f(a.1, b.1)];
            all.iter().fold((i128::MAX, i128::MIN), |r, x| (r.0.min(*x), r.1.max(*x)))
        };
        let hull = |ranges: &[Range]| ranges.iter().fold((i128::MAX, i128::MIN), |r, x| (r.0.min(x.0), r.1.max(x.1)));
        let fill = |x: i128| (1i128 << (128 - x.leading_zeros())) - 1;
        match self {
            Op::Constant(c) => (*c, *c),
            Op::Add => (args[0].0 + args[1].0, args[0].1 + args[1].1),
            Op::Subtract => (args[0].0 - args[1].1, args[0].1 - args[1].0),
            Op::Negate => (-args[0].1, -args[0].0),
            Op::NegateIf if args[0] == (0, 0) => args[1],
            Op::NegateIf => {
                let negated = (-args[1].1, -args[1].0);
                if args[0] == (1, 1) { negated } else { hull(&[args[1], negated]) }
            }
            Op::Multiply => corners(&|a, b| a * b),
            Op::Equal => (0, 1),
            Op::And => (0, args[0].1.min(args[1].1)),
            Op::Or => (args[0].0.max(args[1].0), fill(args[0].1.max(args[1].1))),
            Op::Not => (result.limits().1 - args[0].1, result.limits().1 - args[0].0),
            Op::AnyBit => (i128::from(args[0].0 > 0), i128::from(args[0].1 > 0)),
            Op::SignBit => (i128::from(args[0].1 < 0), i128::from(args[0].0 < 0)),
            Op::Magnitude if args[0].0 >= 0 => args[0],
            Op::Magnitude if args[0].1 <= 0 => (-args[0].1, -args[0].0),
            Op::Magnitude => (0, args[0].1.max(-args[0].0)),
            Op::Floor(drop) => (args[0].0 >> drop, args[0].1 >> drop),
            Op::Append(zeros) => (args[0].0 << zeros, args[0].1 << zeros),
            Op::LowBits(bits) if args[0].0 >= 0 && args[0].1 < 1 << bits => args[0],
            Op::LowBits(bits) => (0, (1 << bits) - 1),
            Op::Clamp(bound, _) => (args[0].0.clamp(-bound, *bound), args[0].1.clamp(-bound, *bound)),
            Op::Resize(_) | Op::Reinterpret(_) => args[0],
            Op::Assert((lo, hi), _) => (args[0].0.max(*lo), args[0].1.min(*hi)),
            Op::Fact(Fact::Product) => Op::Multiply.range(&args[1..], types, result),
            Op::Fact(fact) => (fact.value(&[0, args[1].0]), fact.value(&[0, args[1].1])),
            Op::Lookup(table, _) => hull(&table.iter().map(|x| (*x, *x)).collect::<Vec<_>>()),
            Op::Select => {
                let last = args.len() as i128 - 2;
                hull(&args[1 + args[0].0.min(last) as usize..=1 + args[0].1.min(last) as usize])
            }
            Op::Concatenate => {
                let word = |bound: fn(&Range) -> i128| {
                    args.iter().zip(types).rev().fold(0, |word, (a, t)| (word << t.bits) | bound(a))
                };
                (word(|r| r.0), word(|r| r.1))
            }
            Op::Input
            | Op::Phase(..)
            | Op::Hold { .. }
            | Op::Choose { .. }
            | Op::ScanOr
            | Op::Instance(_)
            | Op::Output(_) => unreachable!("{self:?} is no combinational operation"),
        }
    }
}
