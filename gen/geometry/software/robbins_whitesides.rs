//! Robbins and Whitesides' way: nothing is constructed, everything is decided by the signs of determinants.
//!
//! After S. Robbins, S. Whitesides, *On the Reliability of Triangle Intersection in 3D* (ICCSA 2003). The signs are
//! those of Shewchuk's adaptive orientation predicates (crate `robust`); the order of the questions is that of
//! O. Devillers, P. Guigue, *Faster Triangle-Triangle Intersection Tests* (INRIA RR-4488, 2002). Write `h_i` for the
//! height n_B . (a_i - b_0) of a vertex of A above the plane of B, `g_j` for n_A . (b_j - a_0).
//!
//! *One triangle on one side of the other's plane.* All h_i or all g_j have one sign and are not zero: separate.
//!
//! *Neither all h_i nor all g_j are zero.* Then both triangles are proper and their planes meet in a line along
//! v = n_A x n_B. Rotate A, and reverse B if need be, so that h_0 >= 0 >= h_1, h_2 and h_0 > h_1, h_2; likewise B. The
//! plane of B cuts A in the segment from i on a0 a1 to j on a0 a2, the plane of A cuts B in that from k on b0 b1 to l
//! on b0 b2, and A and B meet where these do. With e = a1 - a0 and i = a0 + s e, j = a0 + t (a2 - a0), s, t >= 0,
//! (j - i) x e = -t n_A and v x e = (h_0 - h_1) n_A: j is not after i along v. Likewise k is not after l. So the
//! segments meet if and only if k is not after i and j is not after l. If k - i = r v, then for f = b1 - b0
//!
//! ```text
//! det(e, f, b0 - a0) = det(e, f, k - i) = r (e x f) . v = -r (e . n_B) (f . n_A) = -r (h_0 - h_1) (g_0 - g_1),
//! ```
//!
//! and its negative is the volume of (a0, a1, b0, b1): k is not after i if and only if that volume is not positive, and
//! in the same way j is not after l if and only if the volume of (a0, a2, b0, b2) is not negative. A zero says that
//! the two points coincide. The relative interior of A meets the plane of B if and only if some h_i > 0 and some
//! h_i < 0, and then in the open segment. So the relative interiors meet if and only if both triangles have vertices on
//! either side and neither volume is zero.
//!
//! *All g_j are zero, but not all h_i.* Then A is a segment, and it leads from one side of the plane of B to the other
//! or ends on the plane. The line through it meets B if and only if it does not pass two edges of B on different sides.
//!
//! *All are zero.* Six points in one plane, or two segments, or fewer. Segments that are not in one plane are separate.
//! Otherwise the plane is projected along a coordinate axis such that not all points come to lie on one line, if there
//! is one, which keeps all incidences. A - B is a polygon whose sides are parallel to edges, or part of a line parallel
//! to an edge, so an edge's line has the triangles on different sides if anything has; strictly if they are separate,
//! and not holding both if only their relative interiors are disjoint. Points on one line are in lexicographic order.

use robust::{Coord, Coord3D, orient2d, orient3d};
use std::cmp::Ordering;

use crate::Points;
use crate::exact::{Exact, Relation};

type Point = [f64; 3];

/// The greatest magnitude, 2^250, and one over the least at which the predicates are exact: coordinates are multiples of
/// 2^-302, so everything of degree three is a multiple of 2^-906, and below 2^760.
pub(super) const GREATEST: f64 = (1u128 << 125) as f64 * (1u128 << 125) as f64;

/// What is asked about six corners, which are numbered as in a0 a1 a2 b0 b1 b2. All answers are exact.
pub(super) trait Signs {
    /// The sign of det(q - p, r - p, s - p), which is that of the height of s above the plane of p, q, r.
    fn volume(&self, corners: [usize; 4]) -> i8;
    /// The sign of det(q - p, r - p) in the projection that keeps two axes: positive if r is to the left of the line from p to q.
    fn area(&self, axes: [usize; 2], corners: [usize; 3]) -> i8;
    /// How coordinates of two corners compare.
    fn compare(&self, axis: usize, p: usize, q: usize) -> Ordering;
}

/// Points in the range of [`intersect`], by the predicates of the crate.
impl Signs for Points {
    fn volume(&self, corners: [usize; 4]) -> i8 {
        let [p, q, r, s] = corners.map(|corner| &self[corner]);
        volume(p, q, r, s)
    }

    fn area(&self, [i, j]: [usize; 2], corners: [usize; 3]) -> i8 {
        let [p, q, r] = corners.map(|corner| [self[corner][i], self[corner][j]]);
        area(&p, &q, &r)
    }

    fn compare(&self, axis: usize, p: usize, q: usize) -> Ordering {
        self[p][axis].partial_cmp(&self[q][axis]).expect("coordinates are finite")
    }
}

/// Whether the closed triangles a0 a1 a2 and b0 b1 b2 have a common point.
///
/// Exact if every coordinate is zero or of a magnitude from 2^-250 to 2^250, segments and points included; beyond,
/// products underflow or overflow and the answer may be wrong.
pub fn intersect(points: &Points) -> bool {
    relation(points).class != Exact::Separate
}

/// How the triangles lie to each other; none if a coordinate is outside the range of [`intersect`].
pub fn decide(points: &Points) -> Option<Relation> {
    points.iter().all(is_in_range).then(|| relation(points))
}

/// Whether all coordinates of a point are in the range of [`intersect`], where the signs of [`volume`] and [`area`] are exact.
pub(crate) fn is_in_range(point: &Point) -> bool {
    point.iter().all(|x| *x == 0.0 || (1.0 / GREATEST..=GREATEST).contains(&x.abs()))
}

const A: [usize; 3] = [0, 1, 2];
const B: [usize; 3] = [3, 4, 5];
/// What projections along an axis keep.
pub(crate) const PLANES: [[usize; 2]; 3] = [[0, 1], [1, 2], [2, 0]];

/// How the triangles lie to each other, by the signs that are given.
pub(super) fn relation(signs: &impl Signs) -> Relation {
    // A coordinate that all have in common leaves nothing to find out about the heights.
    if let Some(axis) = (0..3).find(|&axis| (1..6).all(|corner| signs.compare(axis, 0, corner).is_eq())) {
        return in_plane(signs, axis);
    }
    let across_planes = |class: Exact| Relation { class, coplanar: false };
    let heights_a = A.map(|x| signs.volume([3, 4, 5, x]));
    if on_one_side(heights_a) {
        return across_planes(Exact::Separate);
    }
    // A is in the plane of B, if B has one, and then B is in that of A.
    if heights_a == [0; 3] && PLANES.iter().any(|&axes| signs.area(axes, B) != 0) {
        return in_plane(signs, 2);
    }
    let heights_b = B.map(|x| signs.volume([0, 1, 2, x]));
    if on_one_side(heights_b) {
        return across_planes(Exact::Separate);
    }
    match (heights_a == [0; 3], heights_b == [0; 3]) {
        (false, false) => across_planes(crossing(signs, heights_a, heights_b)),
        (false, true) => across_planes(piercing(signs, A, heights_a, B)),
        (true, false) => across_planes(piercing(signs, B, heights_b, A)),
        (true, true) => in_plane(signs, 2),
    }
}

/// Proper triangles in different planes, neither strictly on one side of the other's plane.
fn crossing(signs: &impl Signs, heights_a: [i8; 3], heights_b: [i8; 3]) -> Exact {
    let (mut a, mut b) = (A, B);
    let ((vertex_a, below_a), (vertex_b, below_b)) = (apex(heights_a), apex(heights_b));
    a.rotate_left(vertex_a);
    b.rotate_left(vertex_b);
    if below_a {
        b.swap(1, 2);
    }
    if below_b {
        a.swap(1, 2);
    }
    let first = signs.volume([a[0], a[1], b[0], b[1]]);
    if first > 0 {
        return Exact::Separate;
    }
    let second = signs.volume([a[0], a[2], b[0], b[2]]);
    if second < 0 {
        return Exact::Separate;
    }
    met(on_both_sides(heights_a) && on_both_sides(heights_b) && first != 0 && second != 0)
}

/// The vertex that the other triangle's plane has alone on one side, or alone in it, and whether that side is below.
fn apex(heights: [i8; 3]) -> (usize, bool) {
    let alone = |vertex: usize, sign: i8| {
        let others = [sign * heights[(vertex + 1) % 3], sign * heights[(vertex + 2) % 3]];
        others.iter().all(|&other| other <= 0 && sign * heights[vertex] > other) && sign * heights[vertex] >= 0
    };
    let above = (0..3).find(|&vertex| alone(vertex, 1)).map(|vertex| (vertex, false));
    let below = || (0..3).find(|&vertex| alone(vertex, -1)).map(|vertex| (vertex, true));
    above.or_else(below).expect("heights that are not all zero, nor on one side, have an apex")
}

/// A segment, not in the plane of a proper triangle and not strictly on one side of it.
fn piercing(signs: &impl Signs, segment: [usize; 3], heights: [i8; 3], triangle: [usize; 3]) -> Exact {
    let (mut top, mut bottom) = (0, 0);
    for vertex in 1..3 {
        if heights[vertex] > heights[top] {
            top = vertex;
        }
        if heights[vertex] < heights[bottom] {
            bottom = vertex;
        }
    }
    let side = |edge: usize| signs.volume([segment[top], segment[bottom], triangle[edge], triangle[(edge + 1) % 3]]);
    let sides = [0, 1, 2].map(side);
    if on_both_sides(sides) {
        return Exact::Separate;
    }
    met(on_both_sides(heights) && !sides.contains(&0))
}

/// Triangles each in the plane of the other; a segment or a point has none. The projection along `axis` is looked at first.
fn in_plane(signs: &impl Signs, axis: usize) -> Relation {
    let coplanar = |class: Exact| Relation { class, coplanar: true };
    for axes in [1, 2, 0].map(|next| [(axis + next) % 3, (axis + next + 1) % 3]) {
        let turns = [A, B].map(|corners| signs.area(axes, corners));
        if turns != [0; 2] {
            return coplanar(in_coordinate_plane(signs, axes, turns));
        }
        let [least, greatest] = ends(signs, &axes, 0..6);
        if (0..6).any(|x| signs.area(axes, [least, greatest, x]) != 0) {
            let [a, b] = [A, B].map(|corners| ends(signs, &[0, 1, 2], corners));
            let skew = signs.volume([a[0], a[1], b[0], b[1]]) != 0;
            let apart = Relation { class: Exact::Separate, coplanar: false };
            return if skew { apart } else { coplanar(in_coordinate_plane(signs, axes, turns)) };
        }
    }
    coplanar(on_line(signs))
}

/// Triangles in a plane, not all on one line, that turn to the left or to the right or are segments.
fn in_coordinate_plane(signs: &impl Signs, axes: [usize; 2], turns: [i8; 2]) -> Exact {
    let mut touching = false;
    for (own, turn, other) in [(A, turns[0], B), (B, turns[1], A)] {
        for edge in 0..3 {
            let sides = other.map(|corner| signs.area(axes, [own[edge], own[(edge + 1) % 3], corner]));
            let beyond = |sign: i8, limit: i8| sign * turn >= 0 && sides.iter().all(|side| sign * side <= limit);
            if beyond(1, -1) || beyond(-1, -1) {
                return Exact::Separate;
            }
            let all_on_it = turn == 0 && sides == [0; 3];
            touching |= !all_on_it && (beyond(1, 0) || beyond(-1, 0));
        }
    }
    met(!touching)
}

/// Segments on one line, or points.
fn on_line(signs: &impl Signs) -> Exact {
    let [a, b] = [A, B].map(|corners| ends(signs, &[0, 1, 2], corners));
    let order = |p: usize, q: usize| along(signs, &[0, 1, 2], p, q);
    if order(a[1], b[0]).is_lt() || order(b[1], a[0]).is_lt() {
        return Exact::Separate;
    }
    let both_points = order(a[0], a[1]).is_eq() && order(b[0], b[1]).is_eq();
    met(both_points || (order(a[1], b[0]).is_gt() && order(b[1], a[0]).is_gt()))
}

/// What triangles with a common point are.
fn met(properly: bool) -> Exact {
    if properly { Exact::Intersect } else { Exact::Touch }
}

fn on_one_side(signs: [i8; 3]) -> bool {
    signs == [1; 3] || signs == [-1; 3]
}

fn on_both_sides(signs: [i8; 3]) -> bool {
    signs.contains(&1) && signs.contains(&-1)
}

/// The corners that are least and greatest in lexicographic order: the ends, where all are on one line.
fn ends(signs: &impl Signs, axes: &[usize], corners: impl IntoIterator<Item = usize>) -> [usize; 2] {
    let mut corners = corners.into_iter();
    let first = corners.next().unwrap_or_default();
    corners.fold([first; 2], |[least, greatest], corner| {
        let is = |order: Ordering, other: usize| along(signs, axes, corner, other) == order;
        [
            if is(Ordering::Less, least) { corner } else { least },
            if is(Ordering::Greater, greatest) { corner } else { greatest },
        ]
    })
}

/// The lexicographic order of two corners.
fn along(signs: &impl Signs, axes: &[usize], p: usize, q: usize) -> Ordering {
    axes.iter().fold(Ordering::Equal, |order, &axis| order.then_with(|| signs.compare(axis, p, q)))
}

/// The sign of det(q - p, r - p, s - p), which is that of the height of s above the plane of p, q, r.
pub(crate) fn volume(p: &Point, q: &Point, r: &Point, s: &Point) -> i8 {
    // The predicate takes most time to find a zero; common vertices are its most frequent cause.
    if p == s || q == s || r == s || p == q || p == r || q == r {
        return 0;
    }
    let [p, q, r, s] = [p, q, r, s].map(|&[x, y, z]| Coord3D { x, y, z });
    -sign(orient3d(p, q, r, s))
}

/// The sign of det(q - p, r - p): positive if r is to the left of the line from p to q.
pub(crate) fn area(p: &[f64; 2], q: &[f64; 2], r: &[f64; 2]) -> i8 {
    let [p, q, r] = [p, q, r].map(|&[x, y]| Coord { x, y });
    sign(orient2d(p, q, r))
}

fn sign(x: f64) -> i8 {
    i8::from(x > 0.0) - i8::from(x < 0.0)
}
