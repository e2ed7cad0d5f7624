//! Held's test: the segment in which one triangle crosses the plane of the other, against that triangle in 2D.
//!
//! M. Held, "ERIT: a collection of efficient and reliable intersection tests", Journal of Graphics Tools 2(4), 1997.
//!
//! If B is not on one side of the plane of A, it meets that plane in a segment, whose ends are computed. Segment and A
//! are projected along a coordinate axis: they meet if an end of the segment is in A or the segment meets an edge of
//! A. Coplanar triangles are projected likewise. Thresholds are left to the user of the publication; here is none.
//!
//! * Touching: closed comparisons, but the ends of the segment are rounded points, so contact is missed or seen by
//!   chance.
//! * Coplanar: as edges and contained vertices.
//! * Degenerate: B may be a segment that crosses the plane of A, or a point. If A is degenerate it has no plane: all of
//!   B counts as coplanar, wherever it lies: errs to "intersect".

use super::Points;
use super::planar::{any_edges_meet, edges, inside, projected, segments_meet};
use super::vector::{Plane, one_side, triangles};

/// Whether the triangles have a common point, in plain binary64.
pub(super) fn intersect(points: &Points) -> bool {
    let [a, b] = triangles(points);
    let plane = Plane::through(a);
    let distance = b.map(|x| plane.distance(x));
    if one_side(distance) {
        return false;
    }
    let flat = projected(a, plane.normal);
    if distance == [0.0; 3] {
        let b = projected(b, plane.normal);
        return any_edges_meet(flat, b) || inside(flat[0], b) || inside(b[0], flat);
    }
    let segment = projected(crossing(b, distance), plane.normal);
    segment.iter().any(|&end| inside(end, flat)) || edges(flat).iter().any(|&edge| segments_meet(segment, edge))
}

/// The ends of the segment in which a triangle, its vertices at these distances, meets a plane; equal for a vertex.
fn crossing(triangle: [[f64; 3]; 3], distance: [f64; 3]) -> [[f64; 3]; 2] {
    let on = (0..3).filter(|&i| distance[i] == 0.0).map(|i| triangle[i]);
    let through = [(0, 1), (1, 2), (2, 0)]
        .into_iter()
        .filter(|&(i, j)| (distance[i] < 0.0 && distance[j] > 0.0) || (distance[i] > 0.0 && distance[j] < 0.0));
    let cut = through.map(|(i, j)| {
        let share = distance[i] / (distance[i] - distance[j]);
        [0, 1, 2].map(|x| triangle[i][x] + (triangle[j][x] - triangle[i][x]) * share)
    });
    let mut ends = on.chain(cut);
    // Only numbers that overflow leave no end; a point that is not a number is nowhere.
    let first = ends.next().unwrap_or([f64::NAN; 3]);
    [first, ends.next().unwrap_or(first)]
}
