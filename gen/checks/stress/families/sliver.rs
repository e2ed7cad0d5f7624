//! Needles: triangles whose height is a tiny part of their length.

use super::draw::{Point, Triangle, brought_near, fine, point, triangle};
use rand::RngExt;
use rand::rngs::ChaCha8Rng;

/// A triangle of length about 1 and a height of 2^-5 to 2^-50, its third vertex anywhere along it.
fn sliver(rng: &mut ChaCha8Rng) -> Triangle {
    let (from, to) = (point(rng), point(rng));
    let along = from + (to - from) * f64::from(rng.random_range(0..=16)) / 16.0;
    [from, to, along + point(rng) * fine(rng, 5..=50)]
}

/// Needles next to each other or crossing.
pub(super) fn against_sliver(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    let (a, b) = (sliver(rng), sliver(rng));
    let gap = fine(rng, 0..=50);
    let b = brought_near(rng, &a, b, gap);
    [a, b]
}

/// Needles side by side: B is A with every vertex moved a little.
pub(super) fn beside_sliver(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    let a = sliver(rng);
    let gap = fine(rng, 5..=50);
    let b = a.map(|vertex| vertex + point(rng) * gap);
    [a, b]
}

/// A needle at or through a triangle of ordinary shape.
pub(super) fn against_fat(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    let (a, b) = (triangle(rng, Point::zeros(), 1.0), sliver(rng));
    let gap = fine(rng, 0..=50);
    let b = brought_near(rng, &a, b, gap);
    [a, b]
}
