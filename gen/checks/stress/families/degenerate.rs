//! Segments, points and colinear triangles against each other and against proper triangles, half of them in contact.

use super::draw::{Point, Triangle, direction, lattice_point, lattice_triangle, pick, whole};
use rand::RngExt;
use rand::rngs::ChaCha8Rng;

/// Weights are quarters and points multiples of four, so that contacts are exact.
const PARTS: i32 = 4;

fn reach(rng: &mut ChaCha8Rng) -> i32 {
    pick(rng, &[1, 2, 8, 1 << 12])
}

fn proper(rng: &mut ChaCha8Rng) -> Triangle {
    let reach = reach(rng);
    lattice_triangle(rng, reach).map(|x| x * f64::from(PARTS))
}

/// A segment: two different points, one of them twice.
fn segment(rng: &mut ChaCha8Rng) -> Triangle {
    let reach = reach(rng);
    let from = lattice_point(rng, reach) * f64::from(PARTS);
    let to = from + direction(rng, reach) * f64::from(PARTS);
    let mut triangle = [from, to, if rng.random() { from } else { to }];
    triangle.rotate_left(rng.random_range(0..3));
    triangle
}

/// Three points of one line.
fn colinear(rng: &mut ChaCha8Rng) -> Triangle {
    let reach = reach(rng);
    let (at, along) = (lattice_point(rng, reach), direction(rng, reach));
    [(); 3].map(|()| (at + along * whole(rng, reach)) * f64::from(PARTS))
}

fn single(rng: &mut ChaCha8Rng) -> Triangle {
    let reach = reach(rng);
    [lattice_point(rng, reach) * f64::from(PARTS); 3]
}

/// A point of the triangle: a vertex, on an edge or inside.
fn point_of(rng: &mut ChaCha8Rng, x: &Triangle) -> Point {
    let first = rng.random_range(0..=PARTS);
    let second = rng.random_range(0..=PARTS - first);
    let [u, v] = [first, second].map(|weight| f64::from(weight) / f64::from(PARTS));
    x[0] + (x[1] - x[0]) * u + (x[2] - x[0]) * v
}

/// Every other time, B is moved so that a point of it lies on a point of A.
fn met(rng: &mut ChaCha8Rng, a: Triangle, b: Triangle) -> [Triangle; 2] {
    if rng.random() {
        return [a, b];
    }
    let shift = point_of(rng, &a) - point_of(rng, &b);
    [a, b.map(|vertex| vertex + shift)]
}

pub(super) fn segment_and_triangle(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    let (a, b) = (proper(rng), segment(rng));
    met(rng, a, b)
}

pub(super) fn segment_and_segment(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    let (a, b) = (segment(rng), segment(rng));
    met(rng, a, b)
}

pub(super) fn colinear_and_triangle(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    let (a, b) = (colinear(rng), proper(rng));
    met(rng, a, b)
}

/// Both on one line, every other time.
pub(super) fn colinear_and_colinear(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    let a = colinear(rng);
    if rng.random() {
        let b = colinear(rng);
        return met(rng, a, b);
    }
    let along = (a[1] - a[0]) / f64::from(PARTS);
    let b = [(); 3].map(|()| a[0] + along * whole(rng, 3 * PARTS));
    [a, b]
}

pub(super) fn point_and_triangle(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    let (a, b) = (proper(rng), single(rng));
    met(rng, a, b)
}

pub(super) fn point_and_segment(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    let (a, b) = (segment(rng), single(rng));
    met(rng, a, b)
}

pub(super) fn point_and_point(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    let (a, b) = (single(rng), single(rng));
    met(rng, a, b)
}
