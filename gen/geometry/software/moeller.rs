//! Moeller's test: the intervals that both triangles cut from the common line of their planes.
//!
//! T. Moeller, "A fast triangle-triangle intersection test", Journal of Graphics Tools 2(2), 1997.
//!
//! Each triangle is first held against the plane of the other. If neither is on one side, both meet the line of both
//! planes; each cuts an interval from it, whose ends are interpolated by the plane distances, measured along the
//! coordinate axis nearest to the line. The triangles meet if and only if the intervals do. If all distances are zero,
//! the triangles are projected along a coordinate axis: they meet if edges do or if one holds a vertex of the other.
//!
//! The publication sets plane distances below 1e-6 to zero. They are distances times twice the area of a triangle, so
//! the threshold is absolute in the cube of the unit of length.
//!
//! * Touching: closed comparisons, but interpolated ends are rounded, so contact is missed or seen by chance.
//! * Coplanar: edges that are parallel never meet here, which is right because a common point of parallel edges is one
//!   of others, too.
//! * Degenerate: outside of the method. A segment has no normal, all distances from its "plane" are zero and the pair
//!   counts as coplanar, wherever the other triangle lies; what the projection then shows may be wrong both ways.
//! * Small: with the epsilon, triangles of about 1e-2 and less are taken for coplanar when they are not.

use super::Points;
use super::planar::{any_edges_meet, projected, strictly_inside};
use super::vector::{Plane, cross, longest, one_side, triangles};

/// The published threshold of plane distances.
const EPSILON: f64 = 1e-6;

/// The test as published.
pub(super) fn intersect_with_epsilon(points: &Points) -> bool {
    decide(points, EPSILON)
}

/// The test with distances compared with zero.
pub(super) fn intersect(points: &Points) -> bool {
    decide(points, 0.0)
}

fn decide(points: &Points, epsilon: f64) -> bool {
    let [a, b] = triangles(points);
    let planes = [a, b].map(Plane::through);
    let distances = |plane: &Plane, triangle: [[f64; 3]; 3]| {
        triangle.map(|x| Some(plane.distance(x)).filter(|d| d.abs() >= epsilon).unwrap_or(0.0))
    };
    let of_b = distances(&planes[0], b);
    if one_side(of_b) {
        return false;
    }
    let of_a = distances(&planes[1], a);
    if one_side(of_a) {
        return false;
    }
    let axis = longest(cross(planes[0].normal, planes[1].normal));
    match (interval(a.map(|x| x[axis]), of_a), interval(b.map(|x| x[axis]), of_b)) {
        (Some([a_min, a_max]), Some([b_min, b_max])) => a_min <= b_max && b_min <= a_max,
        _ => coplanar(projected(a, planes[0].normal), projected(b, planes[0].normal)),
    }
}

/// The interval that a triangle cuts from the line, its vertices at `along` and at these distances from the plane;
/// none if the triangle lies in the plane.
fn interval(along: [f64; 3], distance: [f64; 3]) -> Option<[f64; 2]> {
    let [i, j, k] = lone(distance)?;
    let end = |j: usize| along[i] + (along[j] - along[i]) * distance[i] / (distance[i] - distance[j]);
    let (first, second) = (end(j), end(k));
    Some([first.min(second), first.max(second)])
}

/// The vertex that is alone on its side of the plane, and the two others; none if all are in the plane.
fn lone(d: [f64; 3]) -> Option<[usize; 3]> {
    let opposite = [[0, 1, 2], [1, 2, 0], [2, 0, 1]];
    let same_side = |&[_, j, k]: &[usize; 3]| (d[j] > 0.0 && d[k] > 0.0) || (d[j] < 0.0 && d[k] < 0.0);
    // Otherwise the others are on the plane or on both of its sides; a vertex off the plane serves.
    opposite.into_iter().find(same_side).or_else(|| opposite.into_iter().find(|&[i, ..]| d[i] != 0.0))
}

fn coplanar(a: [[f64; 2]; 3], b: [[f64; 2]; 3]) -> bool {
    any_edges_meet(a, b) || strictly_inside(a[0], b) || strictly_inside(b[0], a)
}
