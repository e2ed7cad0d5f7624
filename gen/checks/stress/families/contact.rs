//! The classic contacts on a lattice: exactly touching, and swept through the contact by steps of a power of two.

use super::draw::{Point, Triangle, direction, lattice_triangle, main_direction, normal, pick, power_of_two, whole};
use rand::RngExt;
use rand::rngs::ChaCha8Rng;

/// Weights are multiples of 1/PARTS and vertices of A multiples of PARTS, so that points of A are whole.
const PARTS: i32 = 16;

/// A pair that touches exactly, with a vector on whose side of a separating plane B lies.
struct Contact {
    a: Triangle,
    b: Triangle,
    away: Point,
}

impl Contact {
    fn exact(self) -> [Triangle; 2] {
        [self.a, self.b]
    }

    /// B, or one vertex of it, moved off A or into it by up to eight steps.
    fn swept(self, rng: &mut ChaCha8Rng) -> [Triangle; 2] {
        let shift = main_direction(&self.away) * whole(rng, 8) * power_of_two(rng.random_range(-40..=4));
        let mut b = self.b;
        let moved = if rng.random_range(0..4) == 0 { 1 } else { 3 };
        for vertex in &mut b[..moved] {
            *vertex += shift;
        }
        [self.a, b]
    }
}

fn large_triangle(rng: &mut ChaCha8Rng) -> Triangle {
    let reach = pick(rng, &[2, 8, 32]);
    lattice_triangle(rng, reach).map(|x| x * f64::from(PARTS))
}

/// A point on the side of `normal` seen from `at`, or in the plane.
fn beyond(rng: &mut ChaCha8Rng, at: Point, normal: &Point) -> Point {
    let step = direction(rng, 32 * PARTS);
    at + if step.dot(normal) < 0.0 { -step } else { step }
}

/// A point between two others, by sixteenths.
fn between(rng: &mut ChaCha8Rng, x: &Point, y: &Point) -> Point {
    x + (y - x) / f64::from(PARTS) * f64::from(rng.random_range(1..PARTS))
}

fn vertex_and_face(rng: &mut ChaCha8Rng) -> Contact {
    let a = large_triangle(rng);
    let (first, second) = (rng.random_range(1..PARTS / 2), rng.random_range(1..PARTS / 2));
    let [u, v] = [first, second].map(|weight| f64::from(weight) / f64::from(PARTS));
    let at = a[0] + (a[1] - a[0]) * u + (a[2] - a[0]) * v;
    let away = normal(&a);
    Contact { a, b: [at, beyond(rng, at, &away), beyond(rng, at, &away)], away }
}

fn vertex_and_edge(rng: &mut ChaCha8Rng) -> Contact {
    let a = large_triangle(rng);
    let at = between(rng, &a[0], &a[1]);
    // Normal to the edge, in the plane of A, away from its third vertex; or tilted out of that plane.
    let outward = (a[1] - a[0]).cross(&normal(&a));
    let away = outward + normal(&a) * whole(rng, PARTS);
    debug_assert!(outward.dot(&(a[2] - a[0])) < 0.0);
    Contact { a, b: [at, beyond(rng, at, &away), beyond(rng, at, &away)], away }
}

fn edge_and_edge(rng: &mut ChaCha8Rng) -> Contact {
    let mut a = large_triangle(rng);
    let at = between(rng, &a[0], &a[1]);
    let along = direction(rng, 32);
    let [back, forth] = [(); 2].map(|()| along * f64::from(rng.random_range(1..PARTS)));
    let away = (a[1] - a[0]).cross(&along);
    // The third vertex of A goes to the other side of the plane of both edges.
    if (a[2] - a[0]).dot(&away) > 0.0 {
        a[2] = a[0] * 2.0 - a[2];
    }
    Contact { a, b: [at - back, at + forth, beyond(rng, at, &away)], away }
}

pub(super) fn vertex_on_face(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    vertex_and_face(rng).exact()
}

pub(super) fn vertex_on_face_sweep(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    vertex_and_face(rng).swept(rng)
}

pub(super) fn vertex_on_edge(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    vertex_and_edge(rng).exact()
}

pub(super) fn vertex_on_edge_sweep(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    vertex_and_edge(rng).swept(rng)
}

pub(super) fn edge_on_edge(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    edge_and_edge(rng).exact()
}

pub(super) fn edge_on_edge_sweep(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    edge_and_edge(rng).swept(rng)
}
