//! The decision, over any ring of exact numbers.
//!
//! Let P = A - B = { a - b }, a polytope spanned by the nine differences of vertices. The triangles have a common point
//! if and only if 0 is in P, and their relative interiors meet if and only if 0 is in the relative interior of P
//! (relint(A - B) = relint A - relint B for convex sets). A direction n shows that 0 is not in P if n.p > 0 on all of
//! P, and that 0 is not in its relative interior if n.p >= 0 on all of P and n.p > 0 somewhere. Every direction below
//! is tested in both signs, and any direction may be tested; what matters is that the right ones are not missed. They
//! depend on the dimension of P, which is that of the span of the six edges:
//!
//! - 3: P is bounded by facets, and 0 is outside P, or outside its interior, if and only if some facet's normal shows
//!   it. A facet of a sum of two convex sets is the sum of a face of each. It is two-dimensional, so one of the faces
//!   is a triangle, or both are edges, not parallel: its normal is n_A, n_B or some e_Ak x e_Bl.
//! - 2: all edges lie in a plane with a normal n0 among those same products (two of them are independent; if both belong
//!   to one triangle its normal is one, else their cross product is). If 0 is not in the plane of P, n0 shows it. Else P
//!   is a polygon whose sides are parallel to edges, and n0 x e_Ak, n0 x e_Bl are normal to them.
//! - 1: all edges are parallel to one u. If d = a0 - b0 is not, the sets are on two parallel lines; else P is a segment
//!   along u, and u itself is the direction to test.
//! - 0: two points.
//!
//! The dimension is 3 if and only if some product is not orthogonal to all edges, that is, if on some of the 11 axes an
//! image is longer than a point.
//!
//! The six points are coplanar never in dimension 3, always in dimensions 1 and 0 (two parallel lines, two points), and
//! in dimension 2 if and only if 0 is in the plane of P. Where one of the 11 axes shows that 0 is not in P, they are
//! not: that axis is not zero, so the dimension is 2 or 3, and if it is 2, the axis is n0.

use std::ops::{Add, Mul, Sub};

use super::{Exact, Relation};

/// An exact number.
pub(crate) trait Number: Clone + Ord + Default {
    /// self * other.
    fn times(&self, other: &Self) -> Self;
    /// self + other.
    fn plus(&self, other: &Self) -> Self;
    /// self - other.
    fn minus(&self, other: &Self) -> Self;
}

impl<N> Number for N
where
    N: Clone + Ord + Default,
    for<'a> &'a N: Add<Output = N> + Sub<Output = N> + Mul<Output = N>,
{
    fn times(&self, other: &Self) -> Self {
        self * other
    }

    fn plus(&self, other: &Self) -> Self {
        self + other
    }

    fn minus(&self, other: &Self) -> Self {
        self - other
    }
}

pub(crate) type Vector<N> = [N; 3];

pub(crate) fn difference<N: Number>(a: &Vector<N>, b: &Vector<N>) -> Vector<N> {
    [0, 1, 2].map(|i| a[i].minus(&b[i]))
}

pub(crate) fn cross<N: Number>(a: &Vector<N>, b: &Vector<N>) -> Vector<N> {
    [(1, 2), (2, 0), (0, 1)].map(|(j, k)| a[j].times(&b[k]).minus(&a[k].times(&b[j])))
}

pub(crate) fn dot<N: Number>(a: &Vector<N>, b: &Vector<N>) -> N {
    a[0].times(&b[0]).plus(&a[1].times(&b[1])).plus(&a[2].times(&b[2]))
}

pub(crate) fn is_zero<N: Number>(a: &Vector<N>) -> bool {
    *a == Vector::<N>::default()
}

/// What the directions tested so far have shown.
struct Evidence {
    apart: bool,
    properly_apart: bool,
    /// Some image was longer than a point.
    extended: bool,
}

impl Evidence {
    /// Tests one direction in both signs.
    fn add<N: Number>(&mut self, direction: &Vector<N>, points: &[Vector<N>; 6]) {
        let image = |triangle: &[Vector<N>]| {
            let mut p = [0, 1, 2].map(|i| dot(&triangle[i], direction));
            p.sort();
            let [low, _, high] = p;
            (low, high)
        };
        let (a, b) = (image(&points[..3]), image(&points[3..]));
        self.apart |= a.1 < b.0 || b.1 < a.0;
        let longer = a.0 < a.1 || b.0 < b.1;
        // Images that meet at one end only and are not both that one point.
        self.properly_apart |= longer && (a.1 <= b.0 || b.1 <= a.0);
        self.extended |= longer;
    }

    fn answer(&self) -> Exact {
        match (self.apart, self.properly_apart) {
            (true, _) => Exact::Separate,
            (false, true) => Exact::Touch,
            (false, false) => Exact::Intersect,
        }
    }
}

/// Decides the pair a0 a1 a2 b0 b1 b2.
pub(super) fn decide<N: Number>(points: &[Vector<N>; 6]) -> Relation {
    let edges = [0, 1, 2, 3, 4, 5].map(|i| {
        let next = if i % 3 == 2 { i - 2 } else { i + 1 };
        difference(&points[next], &points[i])
    });
    let mut evidence = Evidence { apart: false, properly_apart: false, extended: false };
    let normals = [cross(&edges[0], &edges[1]), cross(&edges[3], &edges[4])];
    let products = (0..9).map(|i| cross(&edges[i / 3], &edges[3 + i % 3]));
    let mut plane = None;
    for direction in normals.into_iter().chain(products).filter(|n| !is_zero(n)) {
        evidence.add(&direction, points);
        if evidence.apart {
            return Relation { class: Exact::Separate, coplanar: false };
        }
        plane = Some(direction);
    }
    if evidence.extended {
        return Relation { class: evidence.answer(), coplanar: false };
    }
    // From here all edges lie in one plane, and all points do.
    let class = match (plane, edges.iter().find(|e| !is_zero(e))) {
        (Some(normal), _) => {
            for edge in &edges {
                evidence.add(&cross(&normal, edge), points);
            }
            evidence.answer()
        }
        (None, Some(u)) => {
            evidence.add(u, points);
            if is_zero(&cross(&difference(&points[0], &points[3]), u)) { evidence.answer() } else { Exact::Separate }
        }
        (None, None) if points[0] == points[3] => Exact::Intersect,
        (None, None) => Exact::Separate,
    };
    Relation { class, coplanar: true }
}
