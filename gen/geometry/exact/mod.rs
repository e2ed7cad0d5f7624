//! The exact answer for two triangles: the oracle that every other answer is measured against.
//!
//! Inputs are binary64 numbers, taken as exact reals; triangles are closed sets and may be segments or points. There
//! are two formulations that share no code, so that each checks the other: the facets of the Minkowski difference
//! (`minkowski`, over `integers`), which answers here, and a linear programme ([`linear_programme`], over `tableau`).
//! Neither computes in floating point.

mod integers;
pub mod linear_programme;
mod minkowski;
mod round;
mod tableau;
#[cfg(test)]
mod tests;

pub use round::ceiling;

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

impl fmt::Display for Relation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", self.class, if self.coplanar { " and coplanar" } else { "" })
    }
}

/// Decides the pair a0 a1 a2 b0 b1 b2 of finite points.
pub fn relation(points: &[[f64; 3]; 6]) -> Relation {
    integers::decide(points)
}

/// Decides the pair of A and the image of B under x to M * x + t, all numbers finite; `m` is indexed `[row][column]`.
pub fn posed_relation(a: &[[f64; 3]; 3], b: &[[f64; 3]; 3], m: &[[f64; 3]; 3], t: &[f64; 3]) -> Relation {
    integers::decide_posed(a, b, m, t)
}

/// The class of [`relation`].
pub fn pair(points: &[[f64; 3]; 6]) -> Exact {
    relation(points).class
}

/// The class of [`posed_relation`].
pub fn posed_pair(a: &[[f64; 3]; 3], b: &[[f64; 3]; 3], m: &[[f64; 3]; 3], t: &[f64; 3]) -> Exact {
    posed_relation(a, b, m, t).class
}
