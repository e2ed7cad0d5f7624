//! Points, segments and triangles in the plane, in plain binary64.

use super::vector::longest;

/// A point of the plane.
pub(super) type Point = [f64; 2];

/// Drops the coordinate along which `normal` is longest: the projection along an axis that keeps most area.
pub(super) fn projected<const N: usize>(points: [[f64; 3]; N], normal: [f64; 3]) -> [Point; N] {
    let (j, k) = [(1, 2), (2, 0), (0, 1)][longest(normal)];
    points.map(|x| [x[j], x[k]])
}

/// Twice the signed area of the triangle a b c: positive if it turns left.
pub(super) fn orientation(a: Point, b: Point, c: Point) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// The three edges of a triangle, in order.
pub(super) fn edges([a, b, c]: [Point; 3]) -> [[Point; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

/// Whether two closed segments that are not parallel meet; parallel ones never do here.
pub(super) fn segments_meet([p0, p1]: [Point; 2], [q0, q1]: [Point; 2]) -> bool {
    let cross = |u: Point, v: Point| u[0] * v[1] - u[1] * v[0];
    let vector = |from: Point, to: Point| [to[0] - from[0], to[1] - from[1]];
    let (p, q, between) = (vector(p0, p1), vector(q0, q1), vector(p0, q0));
    // The lines meet at p0 + (s / d) p and q0 + (r / d) q.
    let (d, s, r) = (cross(p, q), cross(between, q), cross(between, p));
    let within = |x: f64| if d > 0.0 { (0.0..=d).contains(&x) } else { (d..=0.0).contains(&x) };
    d != 0.0 && within(s) && within(r)
}

/// Whether a point is in the closed triangle, whichever way that turns.
pub(super) fn inside(x: Point, triangle: [Point; 3]) -> bool {
    let sides = edges(triangle).map(|[a, b]| orientation(a, b, x));
    sides.iter().all(|&s| s >= 0.0) || sides.iter().all(|&s| s <= 0.0)
}

/// Whether a point is in the open triangle, whichever way that turns.
pub(super) fn strictly_inside(x: Point, triangle: [Point; 3]) -> bool {
    let sides = edges(triangle).map(|[a, b]| orientation(a, b, x));
    sides.iter().all(|&s| s > 0.0) || sides.iter().all(|&s| s < 0.0)
}

/// Whether any edges of two triangles meet.
pub(super) fn any_edges_meet(a: [Point; 3], b: [Point; 3]) -> bool {
    edges(a).iter().any(|&p| edges(b).iter().any(|&q| segments_meet(p, q)))
}
