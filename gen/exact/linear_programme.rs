//! To be written: the second formulation.

use super::{Exact, Relation};

/// Decides the pair a0 a1 a2 b0 b1 b2 of finite points.
pub fn relation(points: &[[f64; 3]; 6]) -> Relation {
    Relation { class: super::pair(points), coplanar: false }
}

/// Decides the pair of A and the image of B under x to M * x + t.
pub fn posed_relation(a: &[[f64; 3]; 3], b: &[[f64; 3]; 3], m: &[[f64; 3]; 3], t: &[f64; 3]) -> Relation {
    let class: Exact = super::posed_pair(a, b, m, t);
    Relation { class, coplanar: false }
}
