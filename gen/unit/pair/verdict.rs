//! What the unit answers.

use std::fmt;

/// The answer of the unit. The discriminants are the codes at its port.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(u8)]
pub enum Verdict {
    /// No common point, for certain.
    Separate = 0,
    /// A common point, for certain.
    Intersect = 1,
    /// Neither is certain: to be treated as an intersection.
    PossiblyIncorrect = 2,
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Separate => "separate",
            Self::Intersect => "intersect",
            Self::PossiblyIncorrect => "possibly-incorrect",
        })
    }
}

/// The verdict of a pair with the flags of all its axes; bit i belongs to axis i in the order of the contract (n_A,
/// n_B, C_00 .. C_22, then n_A x e_A0 .. 2 and n_B x e_B0 .. 2 with 17 axes).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Outcome {
    /// Contract section 7.
    pub verdict: Verdict,
    /// The axes on which the images are certainly disjoint.
    pub separated: u32,
    /// The axes on which the images certainly overlap.
    pub overlapping: u32,
    /// A number of the pair or its pose is outside the declared ranges (contract section 10); only guarded units say so.
    pub outside: bool,
}
