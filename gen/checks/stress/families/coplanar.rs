//! Pairs in one plane. The plane carries a lattice, so that all six points are on it exactly.

use super::draw::{Point, Triangle, direction, lattice_point, pick, signed, triangle, whole};
use rand::RngExt;
use rand::rngs::ChaCha8Rng;

/// The plane of `origin + p u + q v` for whole p and q.
pub(super) struct Plane {
    origin: Point,
    u: Point,
    v: Point,
}

impl Plane {
    /// Some plane, every fourth parallel to a coordinate plane.
    pub fn random(rng: &mut ChaCha8Rng) -> Self {
        let reach = pick(rng, &[1, 4, 16]);
        let origin = lattice_point(rng, 64);
        if rng.random_range(0..4) == 0 {
            let axis = rng.random_range(0..3);
            let unit = |i: usize| Point::from_fn(|row, _| f64::from(u8::from(row == i % 3)));
            return Self { origin, u: unit(axis), v: unit(axis + 1) };
        }
        loop {
            let (u, v) = (direction(rng, reach), direction(rng, reach));
            if u.cross(&v) != Point::zeros() {
                return Self { origin, u, v };
            }
        }
    }

    pub fn at(&self, [p, q]: [f64; 2]) -> Point {
        self.origin + self.u * p + self.v * q
    }

    /// Normal to the plane, whole.
    pub fn normal(&self) -> Point {
        self.u.cross(&self.v)
    }

    /// A triangle of lattice points.
    pub fn triangle(&self, rng: &mut ChaCha8Rng, reach: i32) -> Triangle {
        [(); 3].map(|()| self.at([whole(rng, reach), whole(rng, reach)]))
    }

    fn pair(&self, a: [[f64; 2]; 3], b: [[f64; 2]; 3]) -> [Triangle; 2] {
        [a, b].map(|triangle| triangle.map(|x| self.at(x)))
    }
}

fn reach(rng: &mut ChaCha8Rng) -> i32 {
    pick(rng, &[2, 8, 64, 4096])
}

/// On both sides of a line of the plane, one to a few lattice steps apart.
pub(super) fn disjoint(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    let (plane, reach) = (Plane::random(rng), reach(rng));
    let gap = f64::from(rng.random_range(1..=4));
    let a = [(); 3].map(|()| [-whole(rng, reach).abs(), whole(rng, reach)]);
    let b = [(); 3].map(|()| [gap + whole(rng, reach).abs(), whole(rng, reach)]);
    plane.pair(a, b)
}

/// Two triangles with one centroid.
pub(super) fn overlapping(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    let (plane, reach) = (Plane::random(rng), reach(rng));
    let centroid = [(); 2].map(|()| whole(rng, reach));
    let mut around = || {
        let (d, e) = ([(); 2].map(|()| whole(rng, reach)), [(); 2].map(|()| whole(rng, reach)));
        let offsets = [d, e, [-d[0] - e[0], -d[1] - e[1]]];
        offsets.map(|x| [centroid[0] + x[0], centroid[1] + x[1]])
    };
    let (a, b) = (around(), around());
    plane.pair(a, b)
}

/// B inside A; vertices of B may lie on edges or vertices of A.
pub(super) fn nested(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    let (plane, reach) = (Plane::random(rng), reach(rng));
    let a = [(); 3].map(|()| [(); 2].map(|()| whole(rng, reach)));
    let outer = a.map(|x| x.map(|x| 8.0 * x));
    // Weights are eighths.
    let inner = [(); 3].map(|()| {
        let first = rng.random_range(0..=8);
        let second = rng.random_range(0..=8 - first);
        let weights = [first, second, 8 - first - second].map(f64::from);
        [0, 1].map(|i| (0..3).map(|k| weights[k] * a[k][i]).sum())
    });
    plane.pair(outer, inner)
}

/// On both sides of a line of the plane, with a common vertex, a vertex on an edge or overlapping edges on it.
pub(super) fn touching(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    let (plane, reach) = (Plane::random(rng), reach(rng));
    let at = whole(rng, reach);
    let beyond = |rng: &mut ChaCha8Rng, side: f64| [side * (1.0 + whole(rng, reach).abs()), whole(rng, reach)];
    let mut side = |sign: f64| {
        let second = if rng.random() { [0.0, at + 1.0 + whole(rng, reach).abs()] } else { beyond(rng, sign) };
        [[0.0, at], second, beyond(rng, sign)]
    };
    let (a, b) = (side(-1.0), side(1.0));
    plane.pair(a, b)
}

/// B in the plane of A but for the rounding of binary64, the plane in no special position.
pub(super) fn rounded(rng: &mut ChaCha8Rng) -> [Triangle; 2] {
    let a = triangle(rng, Point::zeros(), 1.0);
    let spread = pick(rng, &[0.75, 1.5]);
    let b = [(); 3].map(|()| a[0] + (a[1] - a[0]) * signed(rng) * spread + (a[2] - a[0]) * signed(rng) * spread);
    [a, b]
}
