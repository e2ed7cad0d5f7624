//! Combinational operations, a file each: what it computes, its type and range, delay, cells, VHDL and picture.
//!
//! A new operation is a file here with an [`Operation`] and a line in the list below; CONTRIBUTING.md walks through it.

pub use crate::cells::Word;
use crate::cells::{Bit, Gates, Words, number};
use crate::device::Device;
use crate::expression::Expression;
pub use crate::expression::Operand;
use crate::types::common_point;
pub use crate::types::{Range, Type};

#[cfg(test)]
mod tests;

/// What an operation is in pictures; it sets the colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A product.
    Product,
    /// A sum, difference or negation.
    Sum,
    /// A comparison or saturation.
    Comparison,
    /// A multiplexer.
    Multiplexer,
    /// Logic on bits, tables.
    Logic,
    /// Wires alone: slices, constants.
    Wire,
}

/// An operation on given types, for the tests that every operation must pass.
#[derive(Clone, Debug)]
pub struct Sample {
    /// The operation.
    pub op: Comb,
    /// Its operands.
    pub types: Vec<Type>,
}

impl Sample {
    fn new(op: impl Into<Comb>, types: &[Type]) -> Self {
        Self { op: op.into(), types: types.to_vec() }
    }
}

/// All there is to know of an operation.
pub trait Operation: std::fmt::Debug {
    /// What its result is called where nobody gave it a name: `l_x_floor`.
    fn role(&self) -> &'static str;

    /// Type of the result, from the types of the operands.
    ///
    /// # Errors
    /// What was expected of the operands, and what was found.
    fn result(&self, args: &[Type]) -> Result<Type, String>;

    /// What it computes, on integers.
    fn value(&self, args: &[i128], types: &[Type], to: Type) -> i128;

    /// An enclosure of its values, from enclosures of its operands.
    fn range(&self, args: &[Range], types: &[Type], to: Type) -> Range;

    /// [`value`](Self::value) on many clocks of narrow operands at once, into the last argument. Returns whether it has
    /// done so; without it the simulator asks for every value.
    fn lanes(&self, _args: &[&[i64]], _to: Type, _results: &mut [i64]) -> bool {
        false
    }

    /// Delay from operands to result, the net before it included, ns.
    fn delay(&self, device: &Device, args: &[Type], to: Type) -> f64;

    /// Its result in gates, carry chains and multipliers.
    fn gates(&self, words: &mut Words, args: &[Word], to: Type) -> Vec<Bit>;

    /// Its result in VHDL.
    fn vhdl(&self, args: &[Operand], to: Type) -> Expression;

    /// Its kind and its text in pictures, with the names of its operands and, for where that is too long, without.
    fn picture(&self, args: &[String]) -> (Kind, String, String);

    /// Cases in which it is tested against all of the above.
    fn samples() -> Vec<Sample>
    where
        Self: Sized;
}

macro_rules! operations {
    ($($file:ident::$name:ident),* $(,)?) => {
        $(mod $file; pub use $file::$name;)*

        /// One of the combinational operations.
        #[derive(Clone, Debug, PartialEq)]
        #[allow(missing_docs, reason = "each is documented where it is defined")]
        pub enum Comb { $($name($name)),* }

        impl std::ops::Deref for Comb {
            type Target = dyn Operation;

            fn deref(&self) -> &Self::Target {
                match self { $(Self::$name(op) => op),* }
            }
        }

        $(impl From<$name> for Comb {
            fn from(op: $name) -> Self {
                Self::$name(op)
            }
        })*

        /// The samples of all operations, each with the name of its file.
        pub fn samples() -> Vec<(&'static str, Vec<Sample>)> {
            vec![$((stringify!($file), $name::samples())),*]
        }
    };
}

operations! {
    accumulate::Accumulate,
    add::Add,
    and::And,
    append::Append,
    concatenate::Concatenate,
    constant::Constant,
    delay::Delay,
    equal::Equal,
    floor::Floor,
    less::Less,
    lookup::Lookup,
    low_bits::LowBits,
    magnitude::Magnitude,
    multiply::Multiply,
    negate::Negate,
    negate_if::NegateIf,
    not::Not,
    or::Or,
    or_reduce::OrReduce,
    resize::Resize,
    select::Select,
    shift_left::ShiftLeft,
    sign_bit::SignBit,
    subtract::Subtract,
}

/// The hull of ranges.
pub fn hull(ranges: impl IntoIterator<Item = Range>) -> Range {
    ranges.into_iter().reduce(|a, b| (a.0.min(b.0), a.1.max(b.1))).unwrap_or((0, 0))
}

/// Operands of bitwise logic: unsigned, of one width.
fn bitwise(args: &[Type]) -> Result<Type, String> {
    let joint = Type::joint(args)?;
    match args.iter().find(|t| t.signed || t.bits != joint.bits) {
        Some(other) => Err(format!("expected unsigned operands of one width, found {joint} and {other}")),
        None => Ok(joint),
    }
}

/// The text of an operation between two operands.
fn infix(sign: &str, args: &[String]) -> (String, String) {
    (format!("{} {sign} {}", args[0], args[1]), format!("a {sign} b"))
}

/// Cuts sums to their type where that has fewer bits than they may take: in phases that nobody reads, that may cut something.
fn wrapped(bits: Option<u32>, to: Type, sums: &mut [i64]) {
    if bits.is_some() {
        let unused = 64 - to.bits;
        sums.iter_mut().for_each(|x| *x = if to.signed { *x << unused >> unused } else { *x & to.limits().1 as i64 });
    }
}
