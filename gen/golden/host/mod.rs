//! The host side: exact normalisation and quantisation of binary64 geometry (contract section 2).
//!
//! Nothing here rounds: binary64 numbers are taken as exact reals, differences and products are formed on integers
//! with a common power of two, and only [`Input`](super::Input) is a floor, with its sticky bit.

mod boxes;
mod dyadic;
mod loose;
mod scene;
#[cfg(test)]
mod tests;

pub use loose::loose_pair;
pub use scene::{SceneHost, ScenePose};

use super::{Pair, Verdict};

/// What the host makes of a pair.
// A boxed pair would cost an allocation for every pair of a scene.
#[allow(clippy::large_enum_variant)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Host {
    /// Inside the declared ranges: for the unit.
    Unit(Pair),
    /// Outside the declared ranges: decided here, `separate` if the boxes are strictly disjoint, else
    /// `possibly-incorrect`.
    Decided(Verdict),
}
