//! Planes and edges that are parallel, or all but parallel.

use super::coplanar::Plane;
use super::draw::{Triangle, direction, fine, lattice_point, lattice_triangle, pick, whole};
use rand::RngExt;
use rand::rngs::ChaCha8Rng;

/// Exactly parallel planes, one to eight steps of a power of two apart.
pub(super) fn planes(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    let plane = Plane::random(rng);
    let reach = pick(rng, &[2, 8, 64]);
    let gap = plane.normal() * fine(rng, 0..=34) * f64::from(rng.random_range(1..=8)) * pick(rng, &[1.0, -1.0]);
    let (a, b) = (plane.triangle(rng, reach), plane.triangle(rng, reach));
    [a, b.map(|vertex| vertex + gap)]
}

/// Planes that enclose an angle of a few steps of a power of two: each vertex of B is moved on its own.
pub(super) fn tilted(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    let plane = Plane::random(rng);
    let reach = pick(rng, &[2, 8, 64]);
    let step = plane.normal() * fine(rng, 0..=34);
    let (a, b) = (plane.triangle(rng, reach), plane.triangle(rng, reach));
    [a, b.map(|vertex| vertex + step * whole(rng, 4))]
}

/// An edge of B along an edge of A, its ends a few steps of a power of two off that line, or not at all.
pub(super) fn edges(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    let reach = pick(rng, &[2, 8, 64]);
    let a = lattice_triangle(rng, reach).map(|x| x * 8.0);
    let step = fine(rng, -3..=36);
    let along = (a[1] - a[0]) / 8.0;
    let [near, far] = [(); 2].map(|()| a[0] + along * whole(rng, 16) + lattice_point(rng, 3) * step);
    // A parallel edge somewhere else every fourth time, a common line or nearly so otherwise.
    let aside = if rng.random_range(0..4) == 0 { direction(rng, reach) } else { direction(rng, 1) * step };
    [a, [near + aside, far + aside, a[0] + direction(rng, 8 * reach)]]
}
