//! A square plate.

use crate::mesh::Mesh;
use nalgebra::Point3;

/// Half an edge.
const HALF: f64 = 4.0;

/// A plate of 8 x 8 and of thickness 1, its lower face on z = 0: twelve triangles with whole coordinates.
pub(super) fn mesh() -> Mesh {
    let corner = |i: u32| {
        let side = |bit: u32| if i >> bit & 1 == 0 { -HALF } else { HALF };
        Point3::new(side(0), side(1), f64::from(i >> 2 & 1))
    };
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let faces = quads.into_iter().flat_map(|[p, q, r, s]| [[p, q, r], [p, r, s]]).collect();
    Mesh { vertices: (0..8).map(corner).collect(), faces }
}
