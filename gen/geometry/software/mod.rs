//! Triangle tests in software that EFSAT is compared with, each written from its publication.
//!
//! They answer whether two closed triangles have a common point, given as a0 a1 a2 b0 b1 b2. None of the plain
//! floating-point ones is exact: what each answers on touching, coplanar and degenerate input stands in its module.
//! [`robbins_whitesides`] is exact where no product leaves the range of binary64, [`retest`] everywhere: it is what becomes
//! of pairs that the unit calls possibly incorrect.
//!
//! ```
//! use efsat_geometry::software::Test;
//!
//! // A corner next to a face.
//! let pair = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [1.0, 1.0, 1e-8], [1.0, 1.0, 1.0], [2.0, 1.0, 1.0]];
//! assert_eq!(Test::MoellerEpsilon.intersect(&pair), Ok(true));
//! assert_eq!(Test::Retest.intersect(&pair), Ok(false));
//! ```

pub(crate) mod affine;
pub(crate) mod determinant;
mod double_double;
mod guigue_devillers;
mod held;
// For comparisons.
#[doc(hidden)]
pub mod interval_axes;
mod moeller;
mod planar;
mod posed;
pub mod retest;
// For comparisons.
#[doc(hidden)]
pub mod robbins_whitesides;
mod separating_axes;
#[cfg(test)]
mod tests;
mod vector;
mod whole;

use crate::Points;
use crate::exact::Exact;
use crate::finite::{self, NotFinite};

/// The tests.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Test {
    /// Moeller 1997 with its absolute epsilon of 1e-6 on plane distances, as published.
    MoellerEpsilon,
    /// Moeller 1997 with plane distances compared with zero.
    Moeller,
    /// Eleven separating axes in binary32.
    SeparatingAxes11F32,
    /// Eleven separating axes in binary64.
    SeparatingAxes11F64,
    /// Seventeen separating axes in binary32.
    SeparatingAxes17F32,
    /// Seventeen separating axes in binary64.
    SeparatingAxes17F64,
    /// Held 1997.
    Held,
    /// Guigue and Devillers 2003.
    GuigueDevillers,
    /// Robbins and Whitesides 2003: exact orientation predicates.
    RobbinsWhitesides,
    /// Separating axes in binary64 interval arithmetic, exact arithmetic where they leave a doubt.
    Retest,
}

const MOELLER: &str = "T. Moeller, A fast triangle-triangle intersection test, Journal of Graphics Tools 2(2), 1997";
const SEPARATING_AXES: &str = "S. Gottschalk, M. C. Lin, D. Manocha, OBBTree: a hierarchical structure for rapid \
    interference detection, SIGGRAPH 1996";
const HELD: &str =
    "M. Held, ERIT: a collection of efficient and reliable intersection tests, Journal of Graphics Tools 2(4), 1997";
const GUIGUE_DEVILLERS: &str = "P. Guigue, O. Devillers, Fast and robust triangle-triangle overlap test using \
    orientation predicates, Journal of Graphics Tools 8(1), 2003";
const ROBBINS_WHITESIDES: &str = "S. Robbins, S. Whitesides, On the reliability of triangle intersection in 3D, \
    ICCSA 2003";
const RETEST: &str = "A. Raabe, J. Tietjen, J. K. Anlauf, EFSAT: an exact and efficient triangle intersection test \
    hardware, GRAPP 2009, section 5 (future work)";

impl Test {
    /// All tests, in the order of their declaration.
    pub const ALL: &'static [Self] = &[
        Self::MoellerEpsilon,
        Self::Moeller,
        Self::SeparatingAxes11F32,
        Self::SeparatingAxes11F64,
        Self::SeparatingAxes17F32,
        Self::SeparatingAxes17F64,
        Self::Held,
        Self::GuigueDevillers,
        Self::RobbinsWhitesides,
        Self::Retest,
    ];

    /// Name, publication and function.
    fn row(self) -> (&'static str, &'static str, fn(&Points) -> bool) {
        match self {
            Self::MoellerEpsilon => ("moeller-epsilon", MOELLER, moeller::intersect_with_epsilon),
            Self::Moeller => ("moeller", MOELLER, moeller::intersect),
            Self::SeparatingAxes11F32 => ("sat-11-f32", SEPARATING_AXES, separating_axes::eleven_f32),
            Self::SeparatingAxes11F64 => ("sat-11-f64", SEPARATING_AXES, separating_axes::eleven_f64),
            Self::SeparatingAxes17F32 => ("sat-17-f32", SEPARATING_AXES, separating_axes::seventeen_f32),
            Self::SeparatingAxes17F64 => ("sat-17-f64", SEPARATING_AXES, separating_axes::seventeen_f64),
            Self::Held => ("held", HELD, held::intersect),
            Self::GuigueDevillers => ("guigue-devillers", GUIGUE_DEVILLERS, guigue_devillers::intersect),
            Self::RobbinsWhitesides => ("robbins-whitesides", ROBBINS_WHITESIDES, robbins_whitesides::intersect),
            // What is not finite has been refused.
            Self::Retest => ("retest", RETEST, |points| retest::retest(points).is_ok_and(|x| x != Exact::Separate)),
        }
    }

    /// A short name, without spaces.
    pub fn name(self) -> &'static str {
        self.row().0
    }

    /// The publication: authors, title, place, year.
    pub fn source(self) -> &'static str {
        self.row().1
    }

    /// Whether the closed triangles have a common point, as this test sees it.
    ///
    /// # Errors
    /// If a number is not finite.
    pub fn intersect(self, points: &Points) -> Result<bool, NotFinite> {
        finite::pair(points)?;
        Ok(self.row().2(points))
    }
}
