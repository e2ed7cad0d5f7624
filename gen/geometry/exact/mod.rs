//! The exact answer for two triangles: the oracle that every other answer is measured against.
//!
//! Inputs are binary64 numbers, taken as exact reals; triangles are closed sets and may be segments or points. There
//! are two formulations that share no code, so that each checks the other: the facets of the Minkowski difference
//! (`minkowski`, over `integers`), which answers here, and a linear programme ([`linear_programme`], over `tableau`).
//! Neither computes in floating point.
//!
//! ```
//! use efsat_geometry::exact::{Exact, Relation, relation};
//!
//! // Two triangles in one plane that share area.
//! let pair = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [1.0, 1.0, 0.0], [5.0, 1.0, 0.0], [1.0, 5.0, 0.0]];
//! assert_eq!(relation(&pair)?, Relation { class: Exact::Intersect, coplanar: true });
//! # Ok::<(), efsat_geometry::NotFinite>(())
//! ```

mod common;
mod integers;
// For the stress campaign: another exact answer.
#[doc(hidden)]
pub mod linear_programme;
mod minkowski;
#[cfg(feature = "meshes")]
mod parity;
mod round;
mod tableau;
#[cfg(test)]
mod tests;

pub use common::{ExactPoint, common, posed_common};
#[cfg(feature = "meshes")]
pub(crate) use common::{Whole, clipped};
pub(crate) use integers::posed_points;
#[cfg(feature = "meshes")]
pub(crate) use integers::{Motion, Scaled, whole};
#[cfg(feature = "meshes")]
pub(crate) use minkowski::{cross, difference, dot, is_zero};
#[cfg(feature = "meshes")]
pub(crate) use parity::crosses;
pub use round::ceiling;

use crate::finite::{self, NotFinite};

use std::fmt;

/// How two closed triangles lie to each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Exact {
    /// No common point.
    Separate,
    /// Common points, but the relative interiors are disjoint: some plane that does not contain both triangles has one
    /// on each side. A vertex on a face, an edge on an edge, a common vertex.
    Touch,
    /// The relative interiors meet. Coplanar triangles that share area intersect; so does a segment that passes
    /// through the inside of a triangle. The relative interior of a point is the point.
    Intersect,
}

impl fmt::Display for Exact {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Separate => "separate",
            Self::Touch => "touch",
            Self::Intersect => "intersect",
        })
    }
}

/// How two closed triangles lie to each other, coplanar pairs told apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Relation {
    /// Separate, touch or intersect.
    pub class: Exact,
    /// Whether one plane holds all six points.
    pub coplanar: bool,
}

/// How triangles with a common point meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ContactKind {
    /// [`Exact::Touch`]: a common point, while the relative interiors are disjoint.
    Touching,
    /// [`Exact::Intersect`] in different planes: the relative interiors meet.
    Crossing,
    /// [`Exact::Intersect`] in one plane: triangles that share area; or segments and points in one plane with what they meet.
    Coplanar,
}

impl ContactKind {
    /// What a list calls it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Touching => "touching",
            Self::Crossing => "crossing",
            Self::Coplanar => "coplanar",
        }
    }

    /// The class of a pair that meets so, or not at all.
    pub(crate) fn class(kind: Option<Self>) -> Exact {
        kind.map_or(Exact::Separate, Exact::from)
    }

    /// What an answer of the filter says, which never is of a pair in one plane unless it is separate.
    pub(crate) fn of_filter(answer: Exact) -> Option<Self> {
        Relation { class: answer, coplanar: false }.kind()
    }
}

impl From<ContactKind> for Exact {
    fn from(kind: ContactKind) -> Self {
        match kind {
            ContactKind::Touching => Self::Touch,
            ContactKind::Crossing | ContactKind::Coplanar => Self::Intersect,
        }
    }
}

impl Relation {
    /// How the triangles meet; none if they are separate.
    pub fn kind(self) -> Option<ContactKind> {
        match (self.class, self.coplanar) {
            (Exact::Separate, _) => None,
            (Exact::Touch, _) => Some(ContactKind::Touching),
            (Exact::Intersect, false) => Some(ContactKind::Crossing),
            (Exact::Intersect, true) => Some(ContactKind::Coplanar),
        }
    }
}

impl fmt::Display for Relation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", self.class, if self.coplanar { " and coplanar" } else { "" })
    }
}

/// Decides the pair a0 a1 a2 b0 b1 b2. It checks the faster [`retest`](crate::software::retest::retest), which is what programs
/// ask.
///
/// # Errors
/// If a number is not finite.
pub fn relation(points: &[[f64; 3]; 6]) -> Result<Relation, NotFinite> {
    finite::pair(points)?;
    Ok(integers::decide(points))
}

/// Decides the pair of A and the image of B under x to M * x + t; `m` is indexed `[row][column]`. It checks the faster
/// [`retest_posed`](crate::software::retest::retest_posed), which is what programs ask.
///
/// # Errors
/// If a number is not finite.
pub fn posed_relation(
    a: &[[f64; 3]; 3],
    b: &[[f64; 3]; 3],
    m: &[[f64; 3]; 3],
    t: &[f64; 3],
) -> Result<Relation, NotFinite> {
    finite::posed(a, b, m, t)?;
    Ok(integers::decide_posed(a, b, m, t))
}

/// The class of [`relation`].
///
/// # Errors
/// If a number is not finite.
pub fn pair(points: &[[f64; 3]; 6]) -> Result<Exact, NotFinite> {
    relation(points).map(|relation| relation.class)
}

/// The class of [`posed_relation`].
///
/// # Errors
/// If a number is not finite.
pub fn posed_pair(a: &[[f64; 3]; 3], b: &[[f64; 3]; 3], m: &[[f64; 3]; 3], t: &[f64; 3]) -> Result<Exact, NotFinite> {
    posed_relation(a, b, m, t).map(|relation| relation.class)
}

/// [`relation`] of numbers that are known to be finite.
pub(crate) fn decide(points: &[[f64; 3]; 6]) -> Relation {
    integers::decide(points)
}
