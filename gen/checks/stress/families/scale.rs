//! Sizes and distances far apart.

use super::draw::{Point, Triangle, brought_near, fine, point, power_of_two, triangle};
use rand::RngExt;
use rand::rngs::ChaCha8Rng;

/// B is 2^-8 to 2^-45 of A and close to it.
pub(super) fn tiny_against_huge(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    let a = triangle(rng, Point::zeros(), 1.0);
    let size = fine(rng, 8..=45);
    let b = triangle(rng, Point::zeros(), size);
    let b = brought_near(rng, &a, b, size);
    [a, b]
}

/// Both are tiny and close to each other, far from the origin.
pub(super) fn tiny_and_far(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    let (at, size) = (point(rng), fine(rng, 8..=45));
    let a = triangle(rng, at, size);
    let b = triangle(rng, at, size);
    let gap = size * fine(rng, 0..=20);
    let b = brought_near(rng, &a, b, gap);
    [a, b]
}

/// A near contact, then one offset of 2^8 to 2^44 for all points, rounded: few bits are left for the pair.
pub(super) fn large_offset(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    let (a, b) = (triangle(rng, Point::zeros(), 1.0), triangle(rng, Point::zeros(), 1.0));
    let gap = fine(rng, 0..=40);
    let b = brought_near(rng, &a, b, gap);
    let offset = point(rng) * power_of_two(rng.random_range(8..=44));
    [a, b].map(|triangle| triangle.map(|vertex| vertex + offset))
}

/// Ordinary triangles that are far from each other.
pub(super) fn far_apart(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    let a = triangle(rng, Point::zeros(), 1.0);
    let offset = point(rng) * power_of_two(rng.random_range(1..=60));
    let b = triangle(rng, offset, 1.0);
    [a, b]
}
