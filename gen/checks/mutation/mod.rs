//! Mutation: the checks themselves are checked.
//!
//! A *mutant* is a small change of one statement of the generated VHDL ([`vhdl`]): bounds swapped, a rounding direction, a
//! comparison, a sign case, an operand, a delay, a constant. Co-simulation must notice it, which *kills* the mutant. One that survives is either
//! *equivalent*, that is, no input whatever tells it from the original, and then [`explained`] says why; or it shows a
//! hole in the checks. Mutants are enumerated, never drawn, so that a score can be repeated.

pub mod campaign;
// For the command line.
#[doc(hidden)]
pub mod explained;
mod in_plane;
// For the command line.
#[doc(hidden)]
pub mod score;
mod text;
// For the command line.
#[doc(hidden)]
pub mod vectors;
// For the command line.
#[doc(hidden)]
pub mod vhdl;

use std::fmt;
use std::ops::Range;

/// What is changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Kind {
    /// A lower bound in place of an upper one, or the reverse.
    Bound,
    /// An ulp dropped, added or added twice, a sticky bit dropped or forced.
    Rounding,
    /// `<` in place of `<=`, a comparison reversed or negated.
    Comparison,
    /// Arms of a choice swapped, a condition negated, `and` in place of `or`.
    Case,
    /// Operands exchanged, `+` in place of `-`, a sign dropped, another signal of the same type.
    Operand,
    /// A register too many or too few.
    Delay,
    /// A constant, an index or a shift off by one.
    Constant,
}

impl Kind {
    /// All kinds, in the order in which they are listed.
    pub const ALL: [Self; 7] =
        [Self::Bound, Self::Rounding, Self::Comparison, Self::Case, Self::Operand, Self::Delay, Self::Constant];
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Bound => "bound",
            Self::Rounding => "rounding",
            Self::Comparison => "comparison",
            Self::Case => "case",
            Self::Operand => "operand",
            Self::Delay => "delay",
            Self::Constant => "constant",
        })
    }
}

/// A change of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mutant {
    /// Entity of the design.
    pub unit: String,
    /// Line of the file, from 1.
    pub line: usize,
    /// What the line assigns or defines.
    pub target: String,
    /// What is changed.
    pub kind: Kind,
    /// How, in a few words: `x_hi -> x_lo`.
    pub change: String,
    /// What is cut out of the file, in bytes.
    pub place: Range<usize>,
    /// What takes its place.
    pub new: String,
}

impl Mutant {
    /// The name by which explanations know it: unit, target and change.
    pub fn name(&self) -> String {
        format!("{}:{}:{}:{}", self.unit, self.target, self.kind, self.change)
    }

    /// The whole file, changed.
    pub fn apply(&self, original: &str) -> String {
        format!("{}{}{}", &original[..self.place.start], self.new, &original[self.place.end..])
    }
}

/// What became of a mutant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Fate {
    /// Noticed; by what.
    Killed(String),
    /// Nothing noticed it.
    Survived,
    /// The text is refused by the compiler: no mutant at all.
    Invalid(String),
}

/// `limit` of the mutants, evenly spread; all of them if there are no more.
pub fn spread<T>(all: Vec<T>, limit: usize) -> Vec<T> {
    let (total, count) = (all.len(), limit.min(all.len()));
    let mut chosen = (0..count).map(|i| i * total / count).peekable();
    all.into_iter().enumerate().filter(|(i, _)| chosen.next_if_eq(i).is_some()).map(|(_, item)| item).collect()
}

/// At most `each` mutants of every kind in every unit, evenly spread among those of their kind, in their order.
pub fn capped(all: Vec<Mutant>, each: usize) -> Vec<Mutant> {
    let mut groups = std::collections::BTreeMap::<_, Vec<usize>>::new();
    for (i, mutant) in all.iter().enumerate() {
        groups.entry((mutant.unit.clone(), mutant.kind)).or_default().push(i);
    }
    let mut chosen: Vec<usize> = groups.into_values().flat_map(|group| spread(group, each)).collect();
    chosen.sort_unstable();
    let mut chosen = chosen.into_iter().peekable();
    all.into_iter().enumerate().filter(|(i, _)| chosen.next_if_eq(i).is_some()).map(|(_, mutant)| mutant).collect()
}
