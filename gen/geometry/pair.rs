//! Two triangles.

use crate::exact::{ContactKind, ExactPoint, common};
use crate::finite::{self, NotFinite};
use crate::{Points, software::retest::retest_kind};

/// Two triangles whose numbers are finite. A triangle may be a segment or a point.
///
/// ```
/// use efsat_geometry::{ContactKind, Pair};
///
/// let face = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
/// let with = |z: f64| Pair::new(face, [[1.0, 1.0, z], [1.0, 1.0, 1.0], [2.0, 1.0, 1.0]]);
/// assert_eq!(with(-1.0)?.kind(), Some(ContactKind::Crossing));
/// // A corner on a face, and off it by the least binary64 number.
/// assert_eq!(with(0.0)?.kind(), Some(ContactKind::Touching));
/// assert_eq!(with(5e-324)?.kind(), None);
///
/// let error = with(f64::NAN).unwrap_err();
/// assert_eq!(error.to_string(), "z of b0 is NaN: expected a finite number");
/// # Ok::<(), efsat_geometry::NotFinite>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair(Points);

impl Pair {
    /// Two triangles by their corners, which are arrays, or points or vectors of `nalgebra`.
    ///
    /// # Errors
    /// The first number that is not finite.
    pub fn new<A: Into<[f64; 3]>, B: Into<[f64; 3]>>(a: [A; 3], b: [B; 3]) -> Result<Self, NotFinite> {
        let ([a0, a1, a2], [b0, b1, b2]) = (a.map(Into::into), b.map(Into::into));
        let points = [a0, a1, a2, b0, b1, b2];
        finite::pair(&points)?;
        Ok(Self(points))
    }

    /// The corners a0 a1 a2 b0 b1 b2.
    pub fn points(&self) -> &Points {
        &self.0
    }

    /// How the triangles meet, exactly; none if they have no common point.
    pub fn kind(&self) -> Option<ContactKind> {
        retest_kind(&self.0).expect("pairs are finite")
    }

    /// What the triangles have in common, as [`common`](crate::exact::common()) says it.
    pub fn common(&self) -> Vec<ExactPoint> {
        self.kind().map_or(vec![], |_| common(&self.0).expect("pairs are finite"))
    }
}
