//! Small axis-aligned grids, where every coincidence happens often.

use super::draw::{Point, Triangle, lattice_point, pick, whole};
use rand::RngExt;
use rand::rngs::ChaCha8Rng;

fn on(rng: &mut ChaCha8Rng, reach: i32) -> [Triangle; 2] {
    [(); 2].map(|()| [(); 3].map(|()| lattice_point(rng, reach)))
}

/// Coordinates -1, 0 and 1.
pub(super) fn of_three(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    on(rng, 1)
}

/// Whole coordinates from -2 to 2.
pub(super) fn of_five(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    on(rng, 2)
}

/// Whole coordinates from -8 to 8.
pub(super) fn of_seventeen(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    on(rng, 8)
}

/// Right triangles with legs along coordinate axes, as in a voxel mesh.
pub(super) fn right_triangles(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    let reach = pick(rng, &[1, 2]);
    [(); 2].map(|()| {
        let corner = lattice_point(rng, reach);
        let (axis, other) = (rng.random_range(0..3), rng.random_range(1..3));
        let mut leg = |axis: usize| {
            let length = whole(rng, reach);
            corner + Point::from_fn(|row, _| if row == axis % 3 { length } else { 0.0 })
        };
        [corner, leg(axis), leg(axis + other)]
    })
}
