//! How far each of the fifteen determinants can be from the truth (section 5 of docs/determinants.md).

use super::coordinates::Coordinates;
use super::fifteen::Fifteen;
use super::moments::Moments;
use super::number::{Vector, minus, norm};
use crate::golden::interval::three;
use crate::params::{Bound, Params};

/// The bounds of one parameter set.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    bound: Bound,
    width: u32,
}

/// Upper bounds on the L1 norms of the normals of faces, in units of 2^s.
struct Faces {
    /// Of m_l.
    m: [i64; 3],
    /// Of n_A.
    n: i64,
    /// Of V_i x W_l, `[i - 1][l]`.
    vertex: [[i64; 3]; 2],
    /// Of V_i x e_Bl, `[i - 1][l]`.
    edge_b: [[i64; 3]; 2],
    /// Of e_A1 x W_l.
    edge_a: [i64; 3],
}

/// Edges, and the L1 norms of edges and vertices.
struct Lengths {
    e_a1: Vector,
    e_b: [Vector; 3],
    /// |V_i|, `[i - 1]`.
    v: [i64; 2],
    /// |e_A1|.
    a: i64,
    /// |W_l|.
    w: [i64; 3],
    /// |e_Bl|.
    b: [i64; 3],
}

impl Lengths {
    #[inline(always)]
    fn new(Coordinates { points, .. }: &Coordinates) -> Self {
        let e_a1 = minus(&points.v[1], &points.v[0]);
        let e_b = three(|l| minus(&points.w[(l + 1) % 3], &points.w[l]));
        Self {
            e_a1,
            e_b,
            v: points.v.each_ref().map(norm),
            a: norm(&e_a1),
            w: points.w.each_ref().map(norm),
            b: e_b.each_ref().map(norm),
        }
    }
}

impl Bounds {
    pub fn new(p: &Params) -> Self {
        Self { bound: p.bound, width: p.width }
    }

    /// The bounds, in eighths of 2^s, of determinants made from these moments.
    #[inline(always)]
    pub fn of(&self, coordinates: &Coordinates, moments: &Moments, shift: u32) -> Fifteen<i64> {
        // R is 2^(h-2) units of 2^s.
        let h = self.width + 1 - shift;
        let level = coordinates.level;
        // Eight times the error of a coordinate, times x.
        let first = |x: i64| 4 * x + (x << level);
        // Terms of second and third order.
        let rest = |k: u32| 8 << (h + k + 2 * level.saturating_sub(2));
        if self.bound == Bound::Static {
            let r = 1 << (self.width - 1);
            let q = (r << h) >> 2;
            let three_points = first(12 * q) + 12 * r + rest(3);
            let four_points = first(48 * q) + 48 * r + rest(5);
            return Fifteen {
                plane_a: [three_points; 3],
                plane_b: [three_points, four_points, four_points],
                side: [[three_points; 3], [four_points; 3], [three_points; 3]],
            };
        }
        let lengths = Lengths::new(coordinates);
        let faces = self.faces(coordinates, &lengths, moments, shift);
        let Lengths { v, a, w, b, .. } = lengths;
        let all_m = faces.m[0] + faces.m[1] + faces.m[2];
        let end = |i: usize, l: usize| {
            let [x, y] = [faces.vertex[i][l], faces.vertex[i][(l + 1) % 3]];
            first(faces.m[l] + x + y) + 4 * v[i] + rest(3)
        };
        let middle = |l: usize| {
            let of_b = faces.edge_b[0][l] + faces.edge_b[1][l];
            let of_a = faces.edge_a[l] + faces.edge_a[(l + 1) % 3];
            first(2 * faces.m[l] + 2 * faces.n + of_b + of_a) + 4 * (a + b[l]) + rest(5)
        };
        let corner = |i: usize| {
            let [x, y, z] = faces.edge_b[i];
            first(2 * all_m + x + y + z) + 4 * w[0] + 12 * v[i] + rest(5)
        };
        Fifteen {
            plane_a: three(|l| first(faces.n + faces.vertex[0][l] + faces.vertex[1][l]) + 4 * w[l] + rest(3)),
            plane_b: [first(all_m) + 4 * w[0] + rest(3), corner(0), corner(1)],
            side: [three(|l| end(0, l)), three(middle), three(|l| end(1, l))],
        }
    }

    /// The table of section 5.
    #[inline(always)]
    fn faces(&self, coordinates: &Coordinates, lengths: &Lengths, moments: &Moments, shift: u32) -> Faces {
        let Lengths { e_a1, e_b, v, a, w, b } = lengths;
        let points = &coordinates.points;
        // The normal of a coordinate vector and any other one is at most 2 times the norm of the other: g units.
        let times_g = |x: i64| x << (self.width - shift);
        let (m, n) = match self.bound {
            Bound::Edges => (three(|l| times_g(b[l])), times_g(*a)),
            _ => (moments.m.each_ref().map(norm), norm(&moments.n)),
        };
        if self.bound == Bound::Products {
            let product = |x: &Vector, y: &Vector| self.product(x, y, shift);
            return Faces {
                m,
                n,
                vertex: [0, 1].map(|i| three(|l| product(&points.v[i], &points.w[l]))),
                edge_b: [0, 1].map(|i| three(|l| product(&points.v[i], &e_b[l]))),
                edge_a: three(|l| product(e_a1, &points.w[l])),
            };
        }
        Faces {
            m,
            n,
            vertex: [0, 1].map(|i| three(|l| times_g(v[i].min(w[l])))),
            edge_b: [three(|l| times_g(b[l])); 2],
            edge_a: [times_g(*a); 3],
        }
    }

    /// A bound on |x x y|, from the leading bits of both.
    #[inline(always)]
    fn product(&self, x: &Vector, y: &Vector, shift: u32) -> i64 {
        let dropped = self.width - 6;
        let leading = |z: i64| (z + (1 << dropped) - 1) >> dropped;
        let whole = norm(y);
        let sum: i64 = (0..3).map(|j| leading(x[j].abs()) * leading(whole - y[j].abs())).sum();
        match (2 * dropped).checked_sub(shift) {
            Some(power) => sum << power,
            None => (sum >> (shift - 2 * dropped)) + 1,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::coordinates::Coordinates;
    use super::super::differences::Points;
    use super::super::moments::{Moments, Rounding};
    use super::super::number::{Vector, cross, minus, norm};
    use super::{Bounds, Lengths};
    use crate::params::{Bound, Params};
    use rand::rngs::ChaCha8Rng;
    use rand::{RngExt, SeedableRng};

    /// The table of faces: no norm is above its bound, that of a rounded vector aside, which may be 3/2 above.
    #[test]
    fn norms_of_faces_are_below_their_bounds() {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        for _ in 0..20_000 {
            let bound = [Bound::Edges, Bound::Moments, Bound::Products][rng.random_range(0..3)];
            let (width, span) = (rng.random_range(6..=18), [0, 1, 3][rng.random_range(0..3)]);
            let p = Params { width, span, bound, ..Params::default() };
            let reach = [(); 2].map(|()| (1i64 << rng.random_range(0..width)) - 1);
            let mut vector = |i: usize| [(); 3].map(|()| rng.random_range(-reach[i]..=reach[i]));
            let points = Points { v: [vector(0), vector(0)], w: [vector(1), vector(1), vector(1)] };
            let moments = Moments::new(&points);
            let (rounded, shift) = Rounding::new(&p).apply(&moments);
            let coordinates = Coordinates { points, dropped: [0; 3], level: 0 };
            let lengths = Lengths::new(&coordinates);
            let faces = Bounds::new(&p).faces(&coordinates, &lengths, &rounded, shift);
            // In halves of a unit of 2^s.
            let below = |x: &Vector, bound: i64, slack: i64| 2 * norm(x) <= (2 * bound + slack) << shift;
            let slack = if bound == Bound::Edges { 0 } else { 3 };
            assert!(below(&moments.n, faces.n, slack), "{p:?} {points:?}");
            let e_a1 = minus(&points.v[1], &points.v[0]);
            for l in 0..3 {
                let e_b = minus(&points.w[(l + 1) % 3], &points.w[l]);
                assert!(below(&moments.m[l], faces.m[l], slack), "{p:?} {points:?}");
                assert!(below(&cross(&e_a1, &points.w[l]), faces.edge_a[l], 0), "{p:?} {points:?}");
                for i in 0..2 {
                    assert!(below(&cross(&points.v[i], &points.w[l]), faces.vertex[i][l], 0), "{p:?} {points:?}");
                    assert!(below(&cross(&points.v[i], &e_b), faces.edge_b[i][l], 0), "{p:?} {points:?}");
                }
            }
        }
    }
}
