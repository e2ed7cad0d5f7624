//! Guigue and Devillers' test: signs of orientation determinants alone, nothing is constructed.
//!
//! P. Guigue, O. Devillers, "Fast and robust triangle-triangle overlap test using orientation predicates", Journal of
//! Graphics Tools 8(1), 2003. Here the determinants are plain binary64 numbers.
//!
//! Each triangle is held against the plane of the other. Otherwise its vertices are renamed so that p is alone on its
//! side, and, by turning the other triangle over, on the positive one. Both triangles then cut intervals from the
//! common line that begin and end on known edges; two determinants of four vertices say whether they overlap.
//!
//! Coplanar triangles are projected. If the first vertex of A is not in B, it sees one or two edges of B, and a common
//! point of the triangles exists if and only if A meets one of these: the way from that vertex to the common point is in
//! A and enters B through an edge that it sees. The publication walks a decision tree for one visible edge and another for
//! two; the latter, as printed, misses overlaps in some orders of the vertices. Here the tree of one edge is asked for
//! each visible edge, which needs the same predicates and leaves no case out.
//!
//! * Touching: closed comparisons, but a determinant that is zero may be rounded to either sign.
//! * Coplanar: found by three determinants that are exactly zero, else by chance one side or across.
//! * Degenerate: outside of the method. All determinants with a segment's "plane" are zero, so that it is taken for
//!   coplanar and, projected, for a triangle that holds what lies on its line: errs to "intersect".

use super::Points;
use super::planar::{Point, edges, orientation, projected};
use super::vector::{cross, difference, dot, one_side, triangles};

type Triangle = [[f64; 3]; 3];

/// Whether the triangles have a common point, by determinants in plain binary64.
pub(super) fn intersect(points: &Points) -> bool {
    let [a, b] = triangles(points);
    let sides = |[p, q, r]: Triangle, triangle: Triangle| triangle.map(|x| determinant(p, q, r, x));
    let of_a = sides(b, a);
    if one_side(of_a) {
        return false;
    }
    let of_b = sides(a, b);
    if one_side(of_b) {
        return false;
    }
    let (Some(a_first), Some(b_first)) = (lone(of_a), lone(of_b)) else { return coplanar(a, b) };
    let [p1, q1, r1] = renamed(a, a_first.vertex, !b_first.positive);
    let [p2, q2, r2] = renamed(b, b_first.vertex, !a_first.positive);
    determinant(p1, q1, p2, q2) <= 0.0 && determinant(p1, r1, r2, p2) <= 0.0
}

/// Six times the signed volume of the tetrahedron a b c d: positive if d is where the normal of a b c points.
fn determinant(a: [f64; 3], b: [f64; 3], c: [f64; 3], d: [f64; 3]) -> f64 {
    dot(cross(difference(b, a), difference(c, a)), difference(d, a))
}

/// A vertex that no other shares its side of a plane with.
struct Lone {
    vertex: usize,
    positive: bool,
}

/// The lone vertex of a triangle that is not on one side; none if it lies in the plane.
fn lone(d: [f64; 3]) -> Option<Lone> {
    let others = |i: usize| [d[(i + 1) % 3], d[(i + 2) % 3]];
    let all = |i: usize, legal: fn(f64) -> bool| others(i).into_iter().all(legal);
    (0..3).find_map(|vertex| {
        // A vertex in the plane is alone there if both others are on one side.
        let positive = (d[vertex] > 0.0 && all(vertex, |x| x <= 0.0)) || (d[vertex] == 0.0 && all(vertex, |x| x < 0.0));
        let negative = (d[vertex] < 0.0 && all(vertex, |x| x >= 0.0)) || (d[vertex] == 0.0 && all(vertex, |x| x > 0.0));
        (positive || negative).then_some(Lone { vertex, positive })
    })
}

/// The triangle from vertex `first` on, turned over if asked.
fn renamed(t: Triangle, first: usize, over: bool) -> Triangle {
    let [p, q, r] = [t[first], t[(first + 1) % 3], t[(first + 2) % 3]];
    if over { [p, r, q] } else { [p, q, r] }
}

fn coplanar(a: Triangle, b: Triangle) -> bool {
    let normal = cross(difference(a[1], a[0]), difference(a[2], a[0]));
    let [a, b] = [a, b].map(|triangle| {
        let [p, q, r] = projected(triangle, normal);
        if orientation(p, q, r) < 0.0 { [p, r, q] } else { [p, q, r] }
    });
    let mut visible = edges(b).into_iter().filter(|&[from, to]| orientation(from, to, a[0]) < 0.0).peekable();
    visible.peek().is_none() || visible.any(|edge| meets(a, edge))
}

/// Whether the triangle p q r, which turns left, meets a segment that p lies strictly to the right of.
///
/// On the line of the segment, seen from p, the triangle reaches from where its boundary leaves p's side, on the
/// right, to where it comes back, on the left.
fn meets([p, q, r]: [Point; 3], [left, right]: [Point; 2]) -> bool {
    let across = |x: Point| orientation(left, right, x) >= 0.0;
    let ([from, to], [back, home]) = match (across(q), across(r)) {
        (true, true) => ([p, q], [r, p]),
        (true, false) => ([p, q], [q, r]),
        (false, true) => ([q, r], [r, p]),
        (false, false) => return false,
    };
    orientation(from, to, left) >= 0.0 && orientation(back, home, right) >= 0.0
}
