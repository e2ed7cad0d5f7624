//! Eleven separating axes in binary64 interval arithmetic: a filter whose answers are certain.
//!
//! The future work of the EFSAT paper (Raabe, Tietjen, Anlauf, section 5): "separate" and "intersect" are proven, what
//! is left is undecided. Intervals are midpoints and radii: midpoints in plain binary64, and instead of a radius carried
//! through each operation one bound per kind of axis, from the lengths of the pair's edges.
//!
//! # Ten determinants
//!
//! All that the axes show is in five vectors: the edges `e_k = a_(k+1) - a_k`, `f_l = b_(l+1) - b_l` for k, l = 0, 1,
//! and `d = a_1 - b_1`. With n_A = e_0 x e_1 and n_B = f_0 x f_1, let
//!
//! ```text
//! x_l = n_A . f_l,    y_k = n_B . e_k,    s_kl = (e_k x f_l) . (a_k - b_l)        (k, l = 0, 1, 2)
//! ```
//!
//! - On n_A, all of A is at 0 if a_1 is the origin, and b_1, b_0, b_2 are at `-n_A . d`, that less x_0, and that plus
//!   x_1. On n_B likewise.
//! - On e_k x f_l both ends of either edge coincide. With b_l as the origin, A spans 0 to -x_l from s_kl, and B spans 0
//!   to y_k from 0, because the third vertices are at -f_l . n_A and e_k . n_B from their edges.
//! - The third edges are sums: `x_0 + x_1 + x_2 = 0` and `y_0 + y_1 + y_2 = 0`. Since the area vector n_A is
//!   `sum a_k x a_(k+1)`, also `sum_k s_kl = x_l` and `sum_l s_kl = y_k`.
//! - a_1 is on e_0 and e_1, b_1 on f_0 and f_1, so the four remaining s_kl are `e_k . (f_l x d)`.
//!
//! The *gap* of an axis is how far the images are apart, negative where they overlap. On e_k x f_l, doubled, it is
//! `|t_kl| - |x_l| - |y_k|` with `t_kl = 2 s_kl - x_l - y_k`, and `sum_k t_kl = -x_l`, `sum_l t_kl = -y_k`.
//!
//! The triangles are separate if one gap is positive. If all eleven are negative, 0 is interior to A - B: docs/proofs.md,
//! section 7, which assumes nothing of the triangles; so their relative interiors meet. A pair that touches, lies in one
//! plane, or has a segment or a point, has a gap that is not negative, and is never called intersecting.
//!
//! # Errors
//!
//! Let u = 2^-53, and P, Q, D the greatest magnitudes of the computed components of e_0 and e_1, of f_0 and f_1, and of
//! d. Every operation errs by a factor within 1 +- u, whether products are fused with sums or not.
//!
//! - A determinant is a sum of six products of three components, each component a difference off by one such factor. In
//!   the computed determinant each product has taken at most 2 more in the cross product and 3 in the scalar product.
//!   So with X the product of its vectors' magnitudes it is off by at most (3 + 5) u 6 X + O(u^2) < 49 u X, and it is at
//!   most 6.01 X.
//! - n_A: sums of two determinants, off by 49 u P^2 (D + Q) and one rounding of at most 6.01 P^2 (D + Q): less than
//!   56 u P^2 (P + Q + D). n_B alike with Q^2. Minima and maxima are exact and no more sensitive than their operands.
//! - e_k x f_l, all in units of u P Q. For k, l < 2, x_l is off by 49 P, y_k by 49 Q, s_kl by 49 D, x_l + y_k by 55.1
//!   (P + Q), t_kl by 110.1 D + 61.2 (P + Q) with a magnitude of at most 12.1 D + 6.1 (P + Q). So t_2l is off by
//!   256.5 D + 201.9 P + 140.7 Q at a magnitude of 24.3 D + 18.4 P + 12.3 Q; with P and Q exchanged, so is t_k2. x_2 and
//!   y_2 are off by 110.1 P and 110.1 Q. t_22, from y_2 and both t_2l, is off by 586 D + 460 P + 453 Q at a magnitude of
//!   48.8 D + 37 P + 37 Q, and the doubled gap by less than 690 (P + Q + D).
//! - The bounds used, 64 u P^2 R and 64 u Q^2 R and 1024 u P Q R with R = P + Q + D, leave room for their own roundings,
//!   and for underflow: P, Q >= 2^-300 and R <= 2^300 are required. Then a bound is at least 2^-647 R and R at least
//!   2^-300, while an underflowing product errs by 2^-1075, at most R times as much after another factor, and the 24
//!   determinants that a gap is the sum of have 9 products each. Nothing overflows, as all is of degree three.
//!
//! # Points that are known but for an error
//!
//! Where B is moved, its points are off by up to h in each coordinate, so that f_l is by 2 h and d by h. How much the gaps of the
//! points given then differ from those of the points meant, for h <= Q / 16:
//!
//! - n_A has components of at most 2 P^2. So `n_A . d` is off by 6 P^2 h, x_l by 12 P^2 h, and the gap by 18 P^2 h.
//! - n_B is off by 2 (2 Q 2 h + 2 h^2 2) = 8 h (Q + h). So `n_B . d` is off by 24 h (Q + h)(D + h) + 6 Q^2 h, y_k by 24 h (Q + h) P,
//!   and the gap by 30 h (Q + h)(R + h) < 34 Q R h.
//! - Of all nine s_kl, with third edges of at most 2 P and 2 Q and points at most R apart, none is off by more than
//!   24 P h (R + h) + 24 P Q h, no x_l by more than 24 P^2 h, no y_k by more than 48 P h (Q + h), so no doubled gap by more than
//!   192 P h (R + h) < 204 P R h.
//!
//! The bounds used are those from above with P + h / u for P on n_A, Q + h / u for Q elsewhere: they are wider by 64 P R h, 64 Q R h and
//! 1024 P R h.

use pulp::{Arch, Scalar, Simd, WithSimd};

use crate::exact::Exact;

/// Half a unit in the last place of 1.
const U: f64 = f64::EPSILON / 2.0;
/// The bound of the error of a gap on a triangle's normal.
const NORMAL: f64 = 64.0 * U;
/// The bound of the error of a doubled gap on a product of edges.
const PRODUCT: f64 = 1024.0 * U;
/// The greatest length, 2^300; its inverse is the least length of an edge.
const GREATEST: f64 = (1u128 << 100) as f64 * (1u128 << 100) as f64 * (1u128 << 100) as f64;

/// Lanes of the vectors that pairs are transposed into by shuffles.
const SHUFFLED: usize = 4;
/// Lanes of the widest vector.
const WIDEST: usize = 8;

/// The answer for a pair a0 a1 a2 b0 b1 b2, if it is certain; never `Touch`. Of numbers that are not finite nothing is.
pub fn decide(points: &[[f64; 3]; 6]) -> Option<Exact> {
    decide_off(points, 0.0)
}

/// The same for points b0 b1 b2 that are off by at most `error` in each coordinate.
pub(super) fn decide_off(points: &[[f64; 3]; 6], error: f64) -> Option<Exact> {
    answer(evidence(Scalar, points, error / U))
}

/// The answers for pairs as by [`decide`], several at a time where the processor has vectors for it.
///
/// # Panics
/// If the slices have different lengths.
pub fn decide_batch(pairs: &[[[f64; 3]; 6]], answers: &mut [Option<Exact>]) {
    decide_moved(pairs, 0.0, answers);
}

/// The answers for pairs of which the points b0 b1 b2 are off by at most `error` in each coordinate: what is certain of
/// the points that are meant.
///
/// # Panics
/// If the slices have different lengths.
pub fn decide_moved(pairs: &[[[f64; 3]; 6]], error: f64, answers: &mut [Option<Exact>]) {
    assert_eq!(pairs.len(), answers.len(), "one answer per pair");
    Arch::new().dispatch(Batch { pairs, wider: error / U, answers });
}

struct Batch<'a> {
    pairs: &'a [[[f64; 3]; 6]],
    /// The error of the points, over u.
    wider: f64,
    answers: &'a mut [Option<Exact>],
}

impl WithSimd for Batch<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let lanes = S::F64_LANES;
        for (pairs, answers) in self.pairs.chunks(lanes).zip(self.answers.chunks_mut(lanes)) {
            let mut found = [0.0; WIDEST];
            if pairs.len() == lanes {
                S::as_mut_simd_f64s(&mut found).0[0] = evidence(simd, &transposed(simd, pairs), self.wider);
            } else {
                // The last pairs do not fill a vector.
                found.iter_mut().zip(pairs).for_each(|(to, pair)| *to = evidence(Scalar, pair, self.wider));
            }
            answers.iter_mut().zip(found).for_each(|(to, x)| *to = answer(x));
        }
    }
}

/// What evidence says; without branches, because which of the two it is cannot be foreseen.
#[inline(always)]
fn answer(evidence: f64) -> Option<Exact> {
    const ANSWERS: [Option<Exact>; 3] = [Some(Exact::Intersect), None, Some(Exact::Separate)];
    ANSWERS[usize::from(evidence >= 0.0) + usize::from(evidence > 0.0)]
}

/// As many pairs as there are lanes, coordinate by coordinate.
#[inline(always)]
fn transposed<S: Simd>(simd: S, pairs: &[[[f64; 3]; 6]]) -> [Vector<S>; 6] {
    if let (SHUFFLED, [a, b, c, d]) = (S::F64_LANES, pairs) {
        let pairs = [a, b, c, d];
        let [x0, y0, z0, x1] = columns::<S, 0>(simd, pairs);
        let [y1, z1, x2, y2] = columns::<S, 4>(simd, pairs);
        let [z2, x3, y3, z3] = columns::<S, 8>(simd, pairs);
        let [x4, y4, z4, x5] = columns::<S, 12>(simd, pairs);
        let [_, _, y5, z5] = columns::<S, 14>(simd, pairs);
        return [[x0, y0, z0], [x1, y1, z1], [x2, y2, z2], [x3, y3, z3], [x4, y4, z4], [x5, y5, z5]];
    }
    let mut points = [[simd.splat_f64s(0.0); 3]; 6];
    for (at, point) in points.iter_mut().enumerate() {
        for (axis, to) in point.iter_mut().enumerate() {
            let mut column = [0.0; WIDEST];
            for (x, pair) in column.iter_mut().zip(pairs) {
                *x = pair[at][axis];
            }
            *to = S::as_simd_f64s(&column).0[0];
        }
    }
    points
}

/// Four coordinates, from number `FIRST` on, of four pairs.
#[inline(always)]
fn columns<S: Simd, const FIRST: usize>(simd: S, pairs: [&[[f64; 3]; 6]; SHUFFLED]) -> [S::f64s; SHUFFLED] {
    let [a, b, c, d] = pairs;
    simd.deinterleave_shfl_f64s([row::<S, FIRST>(a), row::<S, FIRST>(b), row::<S, FIRST>(c), row::<S, FIRST>(d)])
}

#[inline(always)]
fn row<S: Simd, const FIRST: usize>(pair: &[[f64; 3]; 6]) -> S::f64s {
    S::as_simd_f64s(&pair.as_flattened()[FIRST..FIRST + SHUFFLED]).0[0]
}

type Vector<S> = [<S as Simd>::f64s; 3];

/// In each lane a positive number if the triangles are separate, a negative one if they intersect, 0 if neither is
/// certain. The points of B are off by at most u `wider`.
#[inline(always)]
fn evidence<S: Simd>(simd: S, points: &[Vector<S>; 6], wider: f64) -> S::f64s {
    let [a0, a1, a2, b0, b1, b2] = points;
    let e = [difference(simd, a1, a0), difference(simd, a2, a1)];
    let f = [difference(simd, b1, b0), difference(simd, b2, b1)];
    let d = difference(simd, a1, b1);

    let length_a = simd.max_f64s(magnitude(simd, &e[0]), magnitude(simd, &e[1]));
    let length_b = simd.max_f64s(magnitude(simd, &f[0]), magnitude(simd, &f[1]));
    let reach = simd.add_f64s(simd.add_f64s(length_a, length_b), magnitude(simd, &d));
    let least = simd.splat_f64s((1.0 / GREATEST).max(16.0 * U * wider));
    let long = simd.greater_than_or_equal_f64s(simd.min_f64s(length_a, length_b), least);
    let legal = simd.and_m64s(long, simd.less_than_or_equal_f64s(reach, simd.splat_f64s(GREATEST)));
    // The greater one of NaN and another number may be either. A sum with a term that is not finite is not finite.
    let finite =
        simd.less_than_f64s(simd.abs_f64s(sum(simd, &[e[0], e[1], f[0], f[1], d])), simd.splat_f64s(f64::INFINITY));
    let legal = simd.and_m64s(legal, finite);
    let (near_a, near_b) = (simd.mul_f64s(length_a, reach), simd.mul_f64s(length_b, reach));

    let normal = cross(simd, &e[0], &e[1]);
    let x = [dot(simd, &normal, &f[0]), dot(simd, &normal, &f[1])];
    let gap_a = normal_gap(simd, simd.neg_f64s(dot(simd, &normal, &d)), x);
    let normal = cross(simd, &f[0], &f[1]);
    let y = [dot(simd, &normal, &e[0]), dot(simd, &normal, &e[1])];
    let gap_b = normal_gap(simd, dot(simd, &normal, &d), y);

    let wider = simd.splat_f64s(wider);
    let (wider_a, wider_b) = (simd.add_f64s(length_a, wider), simd.add_f64s(length_b, wider));
    let radius_a = simd.mul_f64s(simd.mul_f64s(near_a, wider_a), simd.splat_f64s(NORMAL));
    let radius_b = simd.mul_f64s(simd.mul_f64s(near_b, wider_b), simd.splat_f64s(NORMAL));
    let apart = simd.max_f64s(simd.sub_f64s(gap_a, radius_a), simd.sub_f64s(gap_b, radius_b));
    let apart = simd.select_f64s(legal, apart, simd.splat_f64s(0.0));
    // Most pairs that survive a broad phase are separated by a plane of one of the triangles.
    if simd.reduce_min_f64s(apart) > 0.0 {
        return apart;
    }

    let gap = product_gap(simd, &e, &f, &d, x, y);
    let radius = simd.mul_f64s(simd.mul_f64s(near_a, wider_b), simd.splat_f64s(PRODUCT));
    let apart = simd.max_f64s(apart, simd.sub_f64s(gap, radius));
    let over = simd.max_f64s(simd.add_f64s(gap_a, radius_a), simd.add_f64s(gap_b, radius_b));
    let over = simd.max_f64s(over, simd.add_f64s(gap, radius));
    let zero = simd.splat_f64s(0.0);
    let found = simd.add_f64s(simd.max_f64s(apart, zero), simd.min_f64s(over, zero));
    simd.select_f64s(legal, found, zero)
}

/// The gap on a triangle's normal, from the place of the other's vertex 1 and the steps along its first two edges.
#[inline(always)]
fn normal_gap<S: Simd>(simd: S, at: S::f64s, steps: [S::f64s; 2]) -> S::f64s {
    let (before, after) = (simd.sub_f64s(at, steps[0]), simd.add_f64s(at, steps[1]));
    let least = simd.min_f64s(simd.min_f64s(before, after), at);
    let greatest = simd.max_f64s(simd.max_f64s(before, after), at);
    simd.max_f64s(least, simd.neg_f64s(greatest))
}

/// The greatest of the nine doubled gaps on products of edges.
#[inline(always)]
fn product_gap<S: Simd>(
    simd: S,
    e: &[Vector<S>; 2],
    f: &[Vector<S>; 2],
    d: &Vector<S>,
    x: [S::f64s; 2],
    y: [S::f64s; 2],
) -> S::f64s {
    let moments = [cross(simd, &f[0], d), cross(simd, &f[1], d)];
    let centre = |k: usize, l: usize| {
        let s = dot(simd, &e[k], &moments[l]);
        simd.sub_f64s(simd.add_f64s(s, s), simd.add_f64s(x[l], y[k]))
    };
    let [t00, t01, t10, t11] = [centre(0, 0), centre(0, 1), centre(1, 0), centre(1, 1)];
    let sum = |a, b, c| simd.add_f64s(simd.add_f64s(a, b), c);
    // The negatives of t_20, t_21, t_02 and t_12.
    let [t20, t21] = [sum(x[0], t00, t10), sum(x[1], t01, t11)];
    let [t02, t12] = [sum(y[0], t00, t01), sum(y[1], t10, t11)];
    let (x2, y2) = (simd.add_f64s(x[0], x[1]), simd.add_f64s(y[0], y[1]));
    let t22 = sum(y2, t20, t21);

    // Written out, because a vector that crosses a call that is not inlined goes through memory.
    let x = [simd.abs_f64s(x[0]), simd.abs_f64s(x[1]), simd.abs_f64s(x2)];
    let y = [simd.abs_f64s(y[0]), simd.abs_f64s(y[1]), simd.abs_f64s(y2)];
    let gap = |t: S::f64s, k: usize, l: usize| simd.sub_f64s(simd.sub_f64s(simd.abs_f64s(t), x[l]), y[k]);
    let max = |a, b| simd.max_f64s(a, b);
    let first = max(max(gap(t00, 0, 0), gap(t01, 0, 1)), max(gap(t10, 1, 0), gap(t11, 1, 1)));
    let second = max(max(gap(t20, 2, 0), gap(t21, 2, 1)), max(gap(t02, 0, 2), gap(t12, 1, 2)));
    max(max(first, second), gap(t22, 2, 2))
}

#[inline(always)]
fn difference<S: Simd>(simd: S, a: &Vector<S>, b: &Vector<S>) -> Vector<S> {
    [simd.sub_f64s(a[0], b[0]), simd.sub_f64s(a[1], b[1]), simd.sub_f64s(a[2], b[2])]
}

#[inline(always)]
fn cross<S: Simd>(simd: S, a: &Vector<S>, b: &Vector<S>) -> Vector<S> {
    [minor(simd, a, b, 1, 2), minor(simd, a, b, 2, 0), minor(simd, a, b, 0, 1)]
}

/// a_i b_j - a_j b_i.
#[inline(always)]
fn minor<S: Simd>(simd: S, a: &Vector<S>, b: &Vector<S>, i: usize, j: usize) -> S::f64s {
    simd.negate_mul_add_e_f64s(a[j], b[i], simd.mul_f64s(a[i], b[j]))
}

#[inline(always)]
fn dot<S: Simd>(simd: S, a: &Vector<S>, b: &Vector<S>) -> S::f64s {
    simd.mul_add_e_f64s(a[2], b[2], simd.mul_add_e_f64s(a[1], b[1], simd.mul_f64s(a[0], b[0])))
}

/// The sum of all components.
#[inline(always)]
fn sum<S: Simd>(simd: S, vectors: &[Vector<S>; 5]) -> S::f64s {
    let add = |a, b| simd.add_f64s(a, b);
    let [p, q, r, s, t] = vectors.map(|v| add(add(v[0], v[1]), v[2]));
    add(add(add(p, q), add(r, s)), t)
}

/// The greatest magnitude of a component.
#[inline(always)]
fn magnitude<S: Simd>(simd: S, a: &Vector<S>) -> S::f64s {
    simd.max_f64s(simd.max_f64s(simd.abs_f64s(a[0]), simd.abs_f64s(a[1])), simd.abs_f64s(a[2]))
}
