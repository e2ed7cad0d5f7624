//! Seeded pairs of triangles in binary64: near, far, touching, coplanar, degenerate, at mixed scales. They depend on the
//! generator's state only, so a seed names its pairs on every machine.
//!
//! ```
//! use efsat_geometry::sample::random_points;
//! use rand::{SeedableRng, rngs::ChaCha8Rng};
//!
//! let [first, again] = [(); 2].map(|()| random_points(&mut ChaCha8Rng::seed_from_u64(1)));
//! assert_eq!(first, again);
//! ```

use nalgebra::Vector3;
use rand::RngExt;
use rand::rngs::ChaCha8Rng;

use crate::Points;

type Point = Vector3<f64>;

/// A pair of random triangles, at a random scale and place.
pub fn random_points(rng: &mut ChaCha8Rng) -> Points {
    let scale = signed(rng).abs().max(0.1) * f64::from(rng.random_range(-12..12i32)).exp2();
    let shift = if rng.random() { [(); 3].map(|()| signed(rng) * scale) } else { [0.0; 3] };
    shape(rng).map(|point| [0, 1, 2].map(|i| point[i] * scale + shift[i]))
}

/// Two triangles in [-1, 1]^3: independent, near contact, coplanar, sharing vertices, or degenerate.
pub fn shape(rng: &mut ChaCha8Rng) -> Points {
    let a = triangle(rng);
    let near = rng.random_range(0..10) != 0;
    let size = if near { f64::from(rng.random_range(-3..3i32)) } else { 0.0 };
    let extent = (1..3).map(|i| (a[i] - a[0]).amax()).fold(0.0, f64::max);
    let mut b = if near { triangle_at(rng, a[0], extent * size.exp2()) } else { triangle(rng) };
    match rng.random_range(0..10) {
        // As it comes: the triangles overlap or are some of their sizes apart.
        0..=2 => {}
        // A point of B next to a point of A, both inside, on an edge or at a vertex.
        3..=6 => {
            let gap = extent * (-f64::from(rng.random_range(0..40u32))).exp2();
            let offset = if rng.random_range(0..5) == 0 { Point::zeros() } else { random_point(rng) * gap };
            let shift = point_of(rng, &a) + offset - point_of(rng, &b);
            b = b.map(|vertex| vertex + shift);
        }
        // Coplanar but for the rounding.
        7 => {
            for vertex in &mut b {
                *vertex = a[0] + (a[1] - a[0]) * signed(rng) * 2.0 + (a[2] - a[0]) * signed(rng) * 2.0;
            }
        }
        // One or two common vertices.
        8 => {
            b[0] = a[rng.random_range(0..3)];
            if rng.random() {
                b[1] = a[rng.random_range(0..3)];
            }
        }
        // A segment or a point.
        _ => {
            b[1] = if rng.random() { b[0] } else { b[2] };
            if rng.random_range(0..3) == 0 {
                b[2] = b[1];
            }
        }
    }
    let points = [a[0], a[1], a[2], b[0], b[1], b[2]];
    let points = if rng.random() { points } else { [b[0], b[1], b[2], a[0], a[1], a[2]] };
    let reach = points.iter().map(Point::amax).fold(1.0, f64::max);
    points.map(|point| (point / reach).into())
}

fn random_point(rng: &mut ChaCha8Rng) -> Point {
    Point::new(signed(rng), signed(rng), signed(rng))
}

/// A triangle anywhere, of a size from 1 down to 2^-14 or so.
fn triangle(rng: &mut ChaCha8Rng) -> [Point; 3] {
    let at = random_point(rng);
    let size = (-rng.random_range(0.0..14.0f64)).exp2();
    triangle_at(rng, at, size)
}

/// A triangle within `size` of a point, sometimes flat along a coordinate axis.
fn triangle_at(rng: &mut ChaCha8Rng, at: Point, size: f64) -> [Point; 3] {
    let mut vertices = [(); 3].map(|()| at + random_point(rng) * size);
    if rng.random_range(0..8) == 0 {
        let axis = rng.random_range(0..3);
        for vertex in &mut vertices {
            vertex[axis] = at[axis];
        }
    }
    vertices
}

/// A point of a triangle: inside, on an edge or a vertex.
fn point_of(rng: &mut ChaCha8Rng, x: &[Point; 3]) -> Point {
    let (u, v): (f64, f64) = (rng.random(), rng.random());
    match rng.random_range(0..3) {
        0 => x[rng.random_range(0..3)],
        1 => {
            let k = rng.random_range(0..3);
            x[k] + (x[(k + 1) % 3] - x[k]) * u
        }
        _ => x[0] + (x[1] - x[0]) * u + (x[2] - x[0]) * v * (1.0 - u),
    }
}

/// Uniform in [-1, 1).
pub fn signed(rng: &mut ChaCha8Rng) -> f64 {
    rng.random_range(-1.0..1.0)
}
