//! A wavy sheet.

use crate::mesh::Mesh;
use crate::mesh::angle::sin_cos_degrees;
use nalgebra::Point3;

/// Squares along an edge.
const SQUARES: u32 = 40;
/// Degrees of the wave from a square to the next.
const STEP: f64 = 18.0;
/// The height of the wave.
const HEIGHT: f64 = 2.0;

/// A sheet over [0, 40] x [0, 40] that waves between z = -2 and 2; not closed.
pub(super) fn mesh() -> Mesh {
    let wave = |i: u32| sin_cos_degrees(f64::from(i) * STEP).0;
    let vertex = |i: u32, j: u32| Point3::new(f64::from(i), f64::from(j), HEIGHT * wave(i) * wave(j));
    let vertices = (0..=SQUARES).flat_map(|j| (0..=SQUARES).map(move |i| vertex(i, j))).collect();
    let index = |i: u32, j: u32| j * (SQUARES + 1) + i;
    let square = |i: u32, j: u32| {
        let (p, q, r, s) = (index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1));
        [[p, q, r], [p, r, s]]
    };
    let faces = (0..SQUARES).flat_map(|j| (0..SQUARES).flat_map(move |i| square(i, j))).collect();
    Mesh { vertices, faces }
}
