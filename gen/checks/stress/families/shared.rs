//! Neighbours in a mesh: one, two or three common vertices, exactly or but for a few units in the last place.

use super::draw::{Point, Triangle, fine, lattice_triangle, nudged, pick, point, triangle, whole};
use rand::RngExt;
use rand::rngs::ChaCha8Rng;

/// Two triangles of which the first `common` vertices agree, on a lattice or anywhere; B's vertices then turned round.
fn neighbours(rng: &mut ChaCha8Rng, common: usize, off: impl Fn(&mut ChaCha8Rng, Point) -> Point) -> [Triangle; 2] {
    let a = if rng.random() {
        let reach = pick(rng, &[2, 64, 1 << 20]);
        lattice_triangle(rng, reach)
    } else {
        triangle(rng, Point::zeros(), 1.0)
    };
    let size = a.iter().map(Point::amax).fold(0.0, f64::max);
    let mut b = [(); 3].map(|()| point(rng) * size);
    for (vertex, shared) in b.iter_mut().zip(&a).take(common) {
        *vertex = off(rng, *shared);
    }
    b.rotate_left(rng.random_range(0..3));
    [a, b]
}

fn exactly(_: &mut ChaCha8Rng, x: Point) -> Point {
    x
}

/// Off by up to four binary64 units in the last place, or by as many steps of a coarser grid.
fn nearly(rng: &mut ChaCha8Rng, x: Point) -> Point {
    if rng.random() {
        return x.map(|x| nudged(x, rng.random_range(-4..=4)));
    }
    let step = x.amax() * fine(rng, 4..=48);
    x.map(|x| x + step * whole(rng, 4))
}

pub(super) fn vertex(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    neighbours(rng, 1, exactly)
}

pub(super) fn vertex_off(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    neighbours(rng, 1, nearly)
}

pub(super) fn edge(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    neighbours(rng, 2, exactly)
}

pub(super) fn edge_off(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    neighbours(rng, 2, nearly)
}

pub(super) fn whole_triangle(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    neighbours(rng, 3, exactly)
}

pub(super) fn whole_triangle_off(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    neighbours(rng, 3, nearly)
}
