//! Seeded numbers, points and triangles that families are made of.
//!
//! Only operations that IEEE 754 fixes are used, so that a case has the same bits on every machine. Most numbers are
//! whole or have few fraction bits: sums of them are exact, which keeps a contact exact and a pair movable.

use nalgebra::Vector3;
use rand::RngExt;
use rand::rngs::ChaCha8Rng;
use std::ops::RangeInclusive;

pub(super) type Point = Vector3<f64>;
pub(super) type Triangle = [Point; 3];

/// 2^power, from the least denormal number, 2^-1074, to 2^1023.
pub(crate) fn power_of_two(power: i32) -> f64 {
    debug_assert!((-1074..=1023).contains(&power));
    let bits = if power < -1022 { 1 << (power + 1074) } else { ((power + 1023) as u64) << 52 };
    f64::from_bits(bits)
}

/// `x` moved by a number of binary64 units in the last place, upwards if that is positive.
pub(super) fn nudged(x: f64, steps: i64) -> f64 {
    // Patterns as signed integers are in the order of the numbers once the negative ones are turned around.
    let turned = |bits: i64| if bits < 0 { i64::MIN - bits } else { bits };
    f64::from_bits(turned(turned(x.to_bits() as i64) + steps) as u64)
}

/// One of the values.
pub(super) fn pick<T: Copy>(rng: &mut ChaCha8Rng, values: &[T]) -> T {
    values[rng.random_range(0..values.len())]
}

/// A whole number in [-reach, reach].
pub(super) fn whole(rng: &mut ChaCha8Rng, reach: i32) -> f64 {
    f64::from(rng.random_range(-reach..=reach))
}

/// A point with whole coordinates in [-reach, reach].
pub(super) fn lattice_point(rng: &mut ChaCha8Rng, reach: i32) -> Point {
    Point::from_fn(|_, _| whole(rng, reach))
}

/// Like [`lattice_point`], but never the origin.
pub(super) fn direction(rng: &mut ChaCha8Rng, reach: i32) -> Point {
    loop {
        let point = lattice_point(rng, reach);
        if point != Point::zeros() {
            return point;
        }
    }
}

/// Three lattice points that do not lie on one line.
pub(super) fn lattice_triangle(rng: &mut ChaCha8Rng, reach: i32) -> Triangle {
    loop {
        let triangle = [(); 3].map(|()| lattice_point(rng, reach));
        if normal(&triangle) != Point::zeros() {
            return triangle;
        }
    }
}

/// A power of two 2^-k with k in the range.
pub(super) fn fine(rng: &mut ChaCha8Rng, k: RangeInclusive<i32>) -> f64 {
    power_of_two(-rng.random_range(k))
}

/// A multiple of 2^-30 in [-1, 1].
pub(super) fn signed(rng: &mut ChaCha8Rng) -> f64 {
    whole(rng, 1 << 30) * power_of_two(-30)
}

/// A point in [-1, 1]^3, each coordinate a multiple of 2^-30.
pub(super) fn point(rng: &mut ChaCha8Rng) -> Point {
    Point::from_fn(|_, _| signed(rng))
}

/// A triangle within `size` of a point.
pub(super) fn triangle(rng: &mut ChaCha8Rng, at: Point, size: f64) -> Triangle {
    [(); 3].map(|()| at + point(rng) * size)
}

/// A vertex, a point of an edge or an inner point of a triangle, but for the rounding.
pub(super) fn point_of(rng: &mut ChaCha8Rng, x: &Triangle) -> Point {
    let k = rng.random_range(0..3);
    let (u, v) = (signed(rng).abs(), signed(rng).abs());
    match rng.random_range(0..3) {
        0 => x[k],
        1 => x[k] + (x[(k + 1) % 3] - x[k]) * u,
        _ => x[0] + (x[1] - x[0]) * u + (x[2] - x[0]) * v * (1.0 - u),
    }
}

/// `b` moved so that a point of it comes next to a point of `a`, or upon it, but for the rounding.
pub(super) fn brought_near(rng: &mut ChaCha8Rng, a: &Triangle, b: Triangle, gap: f64) -> Triangle {
    let shift = point_of(rng, a) - point_of(rng, &b) + point(rng) * gap;
    b.map(|vertex| vertex + shift)
}

/// The normal of a triangle; exact for whole coordinates below 2^24.
pub(super) fn normal(x: &Triangle) -> Point {
    (x[1] - x[0]).cross(&(x[2] - x[0]))
}

/// The coordinate direction in which `along` is longest, with its sign.
pub(super) fn main_direction(along: &Point) -> Point {
    let mut main = Point::zeros();
    let axis = along.iamax();
    main[axis] = if along[axis] < 0.0 { -1.0 } else { 1.0 };
    main
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_and_steps_are_exact() {
        assert_eq!([-1074, -1023, -1022, -1, 0, 1023].map(power_of_two), {
            let least = f64::from_bits(1);
            [least, f64::MIN_POSITIVE / 2.0, f64::MIN_POSITIVE, 0.5, 1.0, f64::MAX / (2.0 - f64::EPSILON)]
        });
        let up = |x: f64| nudged(x, 1);
        assert_eq!((up(1.0), up(-1.0), nudged(1.0, -1)), (1.0 + f64::EPSILON, -1.0 + f64::EPSILON / 2.0, -up(-1.0)));
        assert_eq!((up(0.0), up(-0.0), nudged(0.0, -1)), (5e-324, 5e-324, -5e-324));
        assert_eq!(nudged(5e-324, -3), -1e-323);
    }
}
