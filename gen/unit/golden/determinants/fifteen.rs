//! The second level of products, and the fifteen determinants whose signs decide a pair (section 4 of
//! docs/determinants.md).

use super::differences::Points;
use super::moments::Moments;
use super::number::{Number, dot};
use crate::golden::interval::three;

/// Something for each of the fifteen determinants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::golden) struct Fifteen<T> {
    /// Of W_l against the plane of A.
    pub plane_a: [T; 3],
    /// Of V_k against the plane of B.
    pub plane_b: [T; 3],
    /// Of edge l of B against edge k of A, `[k][l]`: on which side the lines pass each other.
    pub side: [[T; 3]; 3],
}

impl<T: Copy> Fifteen<T> {
    /// A function of two things for each determinant.
    #[inline(always)]
    pub fn zip<U: Copy, V>(&self, other: &Fifteen<U>, f: impl Fn(T, U) -> V) -> Fifteen<V> {
        let three = |x: &[T; 3], y: &[U; 3]| three(|i| f(x[i], y[i]));
        Fifteen {
            plane_a: three(&self.plane_a, &other.plane_a),
            plane_b: three(&self.plane_b, &other.plane_b),
            side: [0, 1, 2].map(|k| three(&self.side[k], &other.side[k])),
        }
    }
}

impl<T> Fifteen<T> {
    /// All fifteen with their names.
    pub fn named(self) -> impl Iterator<Item = (String, T)> {
        let plane = |name: &str, x: [T; 3]| (0..3).zip(x).map(|(l, x)| (format!("{name}{l}"), x)).collect::<Vec<_>>();
        let planes = [plane("plane_a", self.plane_a), plane("plane_b", self.plane_b)];
        let sides = (0..3).zip(self.side).map(move |(k, x)| plane(&format!("side{k}"), x));
        planes.into_iter().chain(sides).flatten()
    }
}

/// The ten dot products of the second level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::golden) struct Dots<N> {
    /// a_l = n . W_l.
    pub a: [N; 3],
    /// d_il = V_i . m_l, `[i - 1][l]`.
    pub d: [[N; 3]; 2],
    /// v = W0 . m_1.
    pub v: N,
}

impl<N: Number> Dots<N> {
    /// From rounded moments.
    #[inline(always)]
    pub fn new(points: &Points, moments: &Moments) -> Self {
        Self {
            a: three(|l| dot(&moments.n, &points.w[l])),
            d: [0, 1].map(|i| three(|l| dot(&points.v[i], &moments.m[l]))),
            v: dot(&points.w[0], &moments.m[1]),
        }
    }

    /// The determinants, in units of 2^s.
    #[inline(always)]
    pub fn determinants(&self) -> Fifteen<N> {
        let Self { a, d: [d1, d2], v } = *self;
        let sum = |d: [N; 3]| d[0] + d[1] + d[2];
        Fifteen {
            plane_a: a,
            plane_b: [v, v - sum(d1), v - sum(d2)],
            side: [three(|l| -d1[l]), three(|l| d1[l] - d2[l] + a[l] - a[(l + 1) % 3]), d2],
        }
    }
}
