//! The host side: exact normalisation and quantisation of binary64 geometry (contract section 2).
//!
//! Nothing here rounds: binary64 numbers are taken as exact reals, differences and products are formed on integers
//! with a common power of two, and only [`Input`](crate::golden::Input) is a floor, with its sticky bit.

mod boxes;
pub mod driver;
pub mod engine;
mod grid;
mod loose;
mod quantised;
pub mod sample;
mod scene;
#[cfg(feature = "scenes")]
pub mod self_intersections;
#[cfg(feature = "scenes")]
pub mod settings;
#[cfg(feature = "scenes")]
mod stage;
#[cfg(test)]
mod tests;
mod whole;

pub use loose::loose_pair;
pub use scene::{SceneHost, ScenePose};
#[cfg(feature = "scenes")]
pub use stage::{Posed, Stage};

use crate::golden::{Pair, Verdict};
use efsat_geometry::exact::Exact;

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

/// A number that is none: NaN or an infinity.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{what} {index}: found {found}; expected a finite number")]
pub struct NotFinite {
    /// What it would be.
    pub what: &'static str,
    /// Its place among the numbers given of that kind, from 0, all of them in their order.
    pub index: usize,
    /// What was found.
    pub found: f64,
}

impl NotFinite {
    /// The first number that is none.
    pub(crate) fn check<'a>(what: &'static str, numbers: impl IntoIterator<Item = &'a f64>) -> Result<(), Self> {
        match numbers.into_iter().enumerate().find(|(_, x)| !x.is_finite()) {
            Some((index, &found)) => Err(Self { what, index, found }),
            None => Ok(()),
        }
    }

    /// The same for the matrix and the translation of a pose.
    pub(crate) fn check_pose(m: &[[f64; 3]; 3], t: &[f64; 3]) -> Result<(), Self> {
        Self::check("entry of M", m.iter().flatten())?;
        Self::check("entry of t", t)
    }
}

impl Host {
    /// A pair that is decided here by its exact answer.
    fn exactly(answer: Exact) -> Self {
        Self::Decided(match answer {
            Exact::Separate => Verdict::Separate,
            Exact::Touch | Exact::Intersect => Verdict::Intersect,
        })
    }
}
