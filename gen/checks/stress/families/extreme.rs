//! The ends of the number ranges: binary64, the fixed-point domain and the working grid.

use super::contact;
use super::draw::{Point, Triangle, fine, nudged, pick, point_of, power_of_two, signed, triangle, whole};
use rand::RngExt;
use rand::rngs::ChaCha8Rng;

/// One of the contacts on a lattice, exact or swept by a step that is a whole number; coordinates below 2^11.
fn lattice_contact(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    let makers = [contact::vertex_on_face, contact::vertex_on_edge, contact::edge_on_edge];
    let [a, b] = pick(rng, &makers)(rng);
    let step = if rng.random() { Point::zeros() } else { Point::from_fn(|_, _| whole(rng, 2)) };
    [a, b.map(|vertex| vertex + step)]
}

fn scaled(pair: [Triangle; 2], scale: impl Fn(usize) -> f64) -> [Triangle; 2] {
    pair.map(|triangle| triangle.map(|vertex| Point::from_fn(|axis, _| vertex[axis] * scale(axis))))
}

/// Contacts in units of the least denormal number.
pub(super) fn denormal(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    scaled(lattice_contact(rng), |_| power_of_two(-1074))
}

/// Contacts at the upper end of the range: squares and differences overflow.
pub(super) fn overflow(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    scaled(lattice_contact(rng), |_| power_of_two(1012))
}

/// Contacts with every coordinate axis at a scale of its own.
pub(super) fn stretched(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    let reach: i32 = pick(rng, &[4, 14, 40, 1074]);
    let scales = [(); 3].map(|()| power_of_two(rng.random_range(-reach..=reach.min(1012))));
    scaled(lattice_contact(rng), |axis| scales[axis])
}

/// Coordinates at the corners of binary64: the greatest, the least normal and the least number, 1, 0 and neighbours.
pub(super) fn binary64_corners(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    let corners = [f64::MAX, f64::MIN_POSITIVE, 5e-324, 1.0, 0.0];
    [(); 2].map(|()| {
        [(); 3].map(|()| {
            Point::from_fn(|_, _| {
                let corner: f64 = pick(rng, &corners);
                let near = nudged(corner, rng.random_range(-1..=1)).clamp(f64::MIN, f64::MAX);
                if rng.random() { near } else { -near }
            })
        })
    })
}

/// Every coordinate with an exponent of its own.
pub(super) fn mixed_exponents(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    let reach = pick(rng, &[4, 60, 1070]);
    let mut number = || signed(rng) * power_of_two(rng.random_range(-reach..=reach.min(1023)));
    [(); 2].map(|()| [(); 3].map(|()| Point::from_fn(|_, _| number())))
}

/// Coordinates that come to exactly +-1, 0 and one step inside or beside them, after normalisation too.
pub(super) fn domain_corners(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    let ulp = pick(rng, &[14, 16, 28, 30, 44]);
    let ulp = power_of_two(-ulp);
    let values = [1.0, 1.0 - ulp, -1.0, -1.0 + ulp, 0.0, ulp, -ulp, 0.5];
    [(); 2].map(|()| [(); 3].map(|()| Point::from_fn(|_, _| pick(rng, &values))))
}

/// Everything on the grid of a fixed-point format, with a vertex of B within a step of a point of A.
fn on_grid(rng: &mut ChaCha8Rng, fraction: i32) -> [Triangle; 2] {
    let ulp = power_of_two(-fraction);
    let size = pick(rng, &[1.0, 1.0, 0.125, 0.015625]);
    let at = Point::from_fn(|_, _| signed(rng));
    let near = |x: Point| x.map(|x| (x / ulp).round() * ulp);
    let a = triangle(rng, at * (1.0 - size), size).map(near);
    let step = Point::from_fn(|_, _| whole(rng, 1)) * ulp;
    let contact = near(point_of(rng, &a)) + step;
    let b = triangle(rng, at * (1.0 - size), size).map(near);
    [a, [contact, b[1], b[2]]]
}

/// The paper's grid: multiples of 2^-14, 18 bits with 4 integral digits.
pub(super) fn grid_of_18_bits(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    on_grid(rng, 14)
}

/// Multiples of 2^-16, the working ulp of 18 bits after re-normalisation.
pub(super) fn grid_of_working_ulps(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    on_grid(rng, 16)
}

/// Multiples of 2^-28, the ulp of a 32-bit input.
pub(super) fn grid_of_input_ulps(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    on_grid(rng, 28)
}

/// Half-way between numbers of a grid, where rounding down and up are farthest from the number.
pub(super) fn between_grid_points(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    let fraction = pick(rng, &[14, 16]);
    let half = power_of_two(-fraction - 1);
    let finer = half * fine(rng, 1..=12);
    on_grid(rng, fraction).map(|triangle| {
        triangle.map(|vertex| vertex + Point::from_fn(|_, _| half + finer * f64::from(rng.random_range(-1..=1))))
    })
}
