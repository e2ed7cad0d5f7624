//! Separating axes in plain floating point, binary32 or binary64, 11 axes or 17.
//!
//! S. Gottschalk, M. C. Lin, D. Manocha, "OBBTree: a hierarchical structure for rapid interference detection", SIGGRAPH
//! 1996, and Gottschalk's RAPID: two convex polytopes are disjoint if and only if their projections on the normal of a
//! face of one of them, or on the product of an edge of each, are. For triangles that are 11 axes; for coplanar ones
//! the six normals of edges in the plane are needed, too, which makes 17.
//!
//! The triangles are separate if the greatest projection of one is below the least of the other on some axis; nothing
//! is added to either side.
//!
//! * Touching: equal coordinates give equal projections, so shared vertices and edges are seen; else by chance. Small gaps
//!   drown in the rounding of all axes but one or two, so errors tend to "intersect".
//! * Coplanar: 11 axes separate no coplanar pair. 17 do.
//! * Degenerate: a segment has no normal, and some separate pairs are left even by 17 axes.
//! * Binary32: coordinates are rounded first, which moves the triangles.

use super::Points;
use super::vector::{cross, difference, dot, triangles};
use num_traits::Float;

/// Eleven axes in binary32.
pub(super) fn eleven_f32(points: &Points) -> bool {
    intersect(&rounded(points), false)
}

/// Eleven axes in binary64.
pub(super) fn eleven_f64(points: &Points) -> bool {
    intersect(points, false)
}

/// Seventeen axes in binary32.
pub(super) fn seventeen_f32(points: &Points) -> bool {
    intersect(&rounded(points), true)
}

/// Seventeen axes in binary64.
pub(super) fn seventeen_f64(points: &Points) -> bool {
    intersect(points, true)
}

fn rounded(points: &Points) -> [[f32; 3]; 6] {
    points.map(|point| point.map(|x| x as f32))
}

fn intersect<T: Float>(points: &[[T; 3]; 6], in_plane: bool) -> bool {
    let triangles = triangles(points);
    let edges = triangles.map(|t| [0, 1, 2].map(|k| difference(t[(k + 1) % 3], t[k])));
    let normals = edges.map(|e| cross(e[0], e[1]));
    let products = (0..9).map(|i| cross(edges[0][i / 3], edges[1][i % 3]));
    let sides = if in_plane { 0..6 } else { 0..0 };
    let sides = sides.map(|i: usize| cross(normals[i / 3], edges[i / 3][i % 3]));
    !normals.into_iter().chain(products).chain(sides).any(|axis| separates(axis, &triangles))
}

/// Whether the projections on an axis leave a gap.
fn separates<T: Float>(axis: [T; 3], triangles: &[[[T; 3]; 3]; 2]) -> bool {
    let [a, b] = triangles.map(|triangle| {
        let [x, y, z] = triangle.map(|point| dot(point, axis));
        (x.min(y).min(z), x.max(y).max(z))
    });
    a.1 < b.0 || b.1 < a.0
}
