//! The host side: exact normalisation and quantisation of binary64 geometry (contract section 2).
//!
//! Nothing here rounds: binary64 numbers are taken as exact reals, differences and products are formed on integers
//! with a common power of two, and only [`Input`](crate::pair::Input) is a floor, with its sticky bit.

mod answer;
mod boxes;
pub mod driver;
mod grid;
mod loose;
mod quantised;
#[cfg(feature = "scenes")]
mod ready_scene;
// For checks, studies, the command line and the testbench.
#[doc(hidden)]
pub mod sample;
mod scene;
#[cfg(feature = "scenes")]
pub mod self_intersections;
// For checks, studies, the command line and the testbench.
#[doc(hidden)]
#[cfg(feature = "scenes")]
pub mod settings;
#[cfg(test)]
mod tests;
mod whole;

pub use answer::{Answer, Judged, Reference, Relations, Truths, Verdicts};
pub use loose::loose_pair;
// For the command line and the package for Python.
#[doc(hidden)]
pub use loose::loose_pairs;
#[cfg(feature = "scenes")]
pub use ready_scene::{ReadyMeeting, ReadyScene};
pub use scene::{SceneHost, ScenePose};

use crate::pair::{Pair, Verdict};

/// What the host makes of a pair.
// A boxed pair would cost an allocation for every pair of a scene.
#[allow(clippy::large_enum_variant)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Host {
    /// Inside the declared ranges, or for the exact unit a pair that fits: for the unit.
    Unit(Pair),
    /// Outside the declared ranges: decided here, `separate` if the boxes are strictly disjoint, else
    /// `possibly-incorrect`. Beside the exact unit the host decides exactly, `separate` or `intersect`, what does not fit.
    Decided(Verdict),
}
