//! How far each of the fifteen determinants can be from the truth (section 5 of docs/determinants.md).

use super::coordinates::Coordinates;
use super::fifteen::Fifteen;
use super::moments::Moments;
use super::number::{Vector, minus, norm};
use crate::golden::interval::three;
use crate::params::{Bound, Params};

/// One formula of section 5: F of so many times the norm of each face, so many times each length, and c(k).
#[derive(Clone, Copy, Debug)]
pub(super) struct Row<const FACES: usize, const LENGTHS: usize> {
    pub faces: [i64; FACES],
    pub lengths: [i64; LENGTHS],
    pub k: u32,
}

/// The constants of section 5.
#[derive(Clone, Copy, Debug)]
pub(super) struct Constants {
    /// Of x in F(x), beside 2^level.
    pub half: i64,
    /// Of c.
    pub rest: i64,
    /// Q, X_1l, X_2l; w_l.
    pub plane_a: Row<3, 1>,
    /// S; w_0.
    pub plane_b_0: Row<1, 1>,
    /// S, Y_i0, Y_i1, Y_i2; w_0, A_i.
    pub plane_b_i: Row<4, 2>,
    /// Of side\[0\] and side\[2\]: M_l, X_il, X_i,l+1; A_i.
    pub ends: [Row<3, 1>; 2],
    /// M_l, Q, Y_1l, Y_2l, Z_l, Z_(l+1); A_e, b_l.
    pub side_1: Row<6, 2>,
    /// `static`, where the others have c(3): q; R.
    pub three_points: Row<1, 1>,
    /// `static`, where the others have c(5).
    pub four_points: Row<1, 1>,
}

pub(super) const SECTION_5: Constants = Constants {
    half: 4,
    rest: 8,
    plane_a: Row { faces: [1, 1, 1], lengths: [4], k: 3 },
    plane_b_0: Row { faces: [1], lengths: [4], k: 3 },
    plane_b_i: Row { faces: [2, 1, 1, 1], lengths: [4, 12], k: 5 },
    ends: [Row { faces: [1, 1, 1], lengths: [4], k: 3 }; 2],
    side_1: Row { faces: [2, 2, 1, 1, 1, 1], lengths: [4, 4], k: 5 },
    three_points: Row { faces: [12], lengths: [12], k: 3 },
    four_points: Row { faces: [48], lengths: [48], k: 5 },
};

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

/// What the terms of a bound depend on beside constants, norms and lengths.
#[derive(Clone, Copy)]
struct Terms {
    half: i64,
    rest: i64,
    level: u32,
    h: u32,
}

impl Terms {
    /// A formula with its norms and lengths: F of the sum of norms, the sum of lengths, and terms of second and third order.
    #[inline(always)]
    fn sum<const F: usize, const L: usize>(&self, row: &Row<F, L>, faces: [i64; F], lengths: [i64; L]) -> i64 {
        let times = |constants: &[i64], numbers: &[i64]| constants.iter().zip(numbers).map(|(c, x)| c * x).sum::<i64>();
        let x = times(&row.faces, &faces);
        // Eight times the error of a coordinate, times x.
        let first = self.half * x + (x << self.level);
        first + times(&row.lengths, &lengths) + (self.rest << (self.h + row.k + 2 * self.level.saturating_sub(2)))
    }
}

impl Bounds {
    pub fn new(p: &Params) -> Self {
        Self { bound: p.bound, width: p.width }
    }

    /// The bounds, in eighths of 2^s, of determinants made from these moments.
    #[inline(always)]
    pub fn of(&self, coordinates: &Coordinates, moments: &Moments, shift: u32) -> Fifteen<i64> {
        self.with(&SECTION_5, coordinates, moments, shift)
    }

    /// The same with any constants.
    #[inline(always)]
    pub fn with(&self, c: &Constants, coordinates: &Coordinates, moments: &Moments, shift: u32) -> Fifteen<i64> {
        // R is 2^(h-2) units of 2^s.
        let h = self.width + 1 - shift;
        let terms = Terms { half: c.half, rest: c.rest, level: coordinates.level, h };
        if self.bound == Bound::Static {
            let r = 1 << (self.width - 1);
            let q = (r << h) >> 2;
            let (three_points, four_points) =
                (terms.sum(&c.three_points, [q], [r]), terms.sum(&c.four_points, [q], [r]));
            return Fifteen {
                plane_a: [three_points; 3],
                plane_b: [three_points, four_points, four_points],
                side: [[three_points; 3], [four_points; 3], [three_points; 3]],
            };
        }
        let lengths = Lengths::new(coordinates);
        let faces = self.faces(coordinates, &lengths, moments, shift);
        let Faces { m, n, vertex: x, edge_b: y, edge_a: z } = faces;
        let Lengths { v, a, w, b, .. } = lengths;
        let all_m = m[0] + m[1] + m[2];
        let end = |i: usize, l: usize| terms.sum(&c.ends[i], [m[l], x[i][l], x[i][(l + 1) % 3]], [v[i]]);
        let middle = |l: usize| terms.sum(&c.side_1, [m[l], n, y[0][l], y[1][l], z[l], z[(l + 1) % 3]], [a, b[l]]);
        let corner = |i: usize| terms.sum(&c.plane_b_i, [all_m, y[i][0], y[i][1], y[i][2]], [w[0], v[i]]);
        Fifteen {
            plane_a: three(|l| terms.sum(&c.plane_a, [n, x[0][l], x[1][l]], [w[l]])),
            plane_b: [terms.sum(&c.plane_b_0, [all_m], [w[0]]), corner(0), corner(1)],
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
