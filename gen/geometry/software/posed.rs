//! A triangle and the image of another one under x to M * x + t, exactly: the signs that decide them come from binary64 if its
//! errors allow it, else from numbers of twice the length, which leave little but zeros, and these from integers.
//!
//! # Errors
//!
//! With u = 2^-53, S the sum of the magnitudes of an image's four terms, and no product below 2^-900 but 0:
//!
//! - *Images.* Products and sums are split into a rounded number and its error. Six errors of at most u S each are left beside the
//!   sum and are added up in binary64, with roundings of at most 5 u times their 6 u S: less than 2^-100 S. Where these five sums are
//!   exact, the image is. Of products below 2^-900 the errors may be lost, each below 2^-1000.
//! - *Determinants* of differences of at most D of points that are off by at most E, so that differences are by 2 E. Each of six
//!   products of three moves by at most 3 (2 E) (D + 2 E)^2, all by 36 E (D + 2 E)^2, and the two of second order by 8 E (D + 2 E). The
//!   arithmetic adds, of second order, 16 u^2 times two products; of third order, where a product takes part in at most three
//!   differences, two products and four sums, 35 u^2 times six: below 2^-98 D^3. The bounds used have room for their own roundings,
//!   and for underflow, as D is at least 2^-200 and nothing is above 2^200.
//! - In binary64 the same holds with E = 2 u times the greatest coordinate, which makes up for the lower halves, and the errors
//!   of `determinant`.

use super::determinant::{FLAT, SOLID, U, difference, flat, sign, solid};
use super::double_double::{Double, two_product, two_sum};
use super::robbins_whitesides::Signs;
use crate::Points;
use crate::exact::posed_points;
use num_bigint::{BigInt, Sign};
use std::cell::OnceCell;
use std::cmp::Ordering;

/// What of numbers of twice the length is lost at most: 2^-97.
const LOST: f64 = 1.0 / (1u128 << 97) as f64;
/// Numbers from 2^-200 to 2^200 are far from the ends of the range.
const GREATEST: f64 = (1u128 << 100) as f64 * (1u128 << 100) as f64;

type Triangle = [[f64; 3]; 3];

/// The triangles.
pub(super) struct Posed<'a> {
    a: &'a Triangle,
    b: &'a Triangle,
    m: &'a Triangle,
    t: &'a [f64; 3],
    points: [[Double; 3]; 6],
    /// What each coordinate is off by at most: 0 if it is exact.
    errors: [[f64; 3]; 6],
    /// The greatest of these, and the greatest coordinate.
    error: f64,
    reach: f64,
    /// The points in units of some power of two, once they are needed.
    whole: OnceCell<[[BigInt; 3]; 6]>,
}

impl<'a> Posed<'a> {
    /// A triangle A, and B with its pose; `m` is indexed `[row][column]`.
    pub fn new(a: &'a Triangle, b: &'a Triangle, m: &'a Triangle, t: &'a [f64; 3]) -> Self {
        let (mut points, mut errors) = ([[Double::default(); 3]; 6], [[0.0; 3]; 6]);
        for corner in 0..3 {
            points[corner] = a[corner].map(Double::from);
            for axis in 0..3 {
                (points[3 + corner][axis], errors[3 + corner][axis]) = image(&m[axis], &b[corner], t[axis]);
            }
        }
        let reach = points.as_flattened().iter().fold(0.0, |reach, x| f64::max(reach, x.high.abs()));
        let mut error = errors.as_flattened().iter().copied().fold(0.0, f64::max);
        if reach > GREATEST {
            error = f64::INFINITY;
        }
        Self { a, b, m, t, points, errors, error, reach, whole: OnceCell::new() }
    }

    /// The corners rounded, and what that moved them by at most; none did if it is 0.
    pub fn rounded(&self) -> (Points, f64) {
        let is_short = self.error == 0.0 && self.points.as_flattened().iter().all(|x| x.low == 0.0);
        let moved = if is_short { 0.0 } else { U * self.reach + self.error };
        (self.points.map(|point| point.map(|x| x.high)), moved)
    }

    fn whole(&self) -> &[[BigInt; 3]; 6] {
        self.whole.get_or_init(|| posed_points(self.a, self.b, self.m, self.t))
    }

    /// Whether two corners are certainly one.
    fn are_one(&self, p: usize, q: usize) -> bool {
        self.points[p] == self.points[q] && self.errors[p] == [0.0; 3] && self.errors[q] == [0.0; 3]
    }

    /// For corners of greatest difference D that are off by E, D + 2 E, unless D is too small for bounds.
    fn size<const N: usize>(differences: &[[f64; 3]; N], error: f64) -> f64 {
        let greatest = differences.as_flattened().iter().fold(0.0, |greatest, x| f64::max(greatest, x.abs()));
        if greatest < 1.0 / GREATEST { f64::INFINITY } else { greatest + 2.0 * error }
    }
}

/// The image of a point along one axis, and what it is off by at most.
fn image(row: &[f64; 3], x: &[f64; 3], t: f64) -> (Double, f64) {
    let products = [0, 1, 2].map(|i| two_product(row[i], x[i]));
    let [p, q, r] = products.map(|product| product.high);
    let first = two_sum(p, q);
    let second = two_sum(first.high, r);
    let third = two_sum(second.high, t);
    // The products are exact if none is tiny, and none of their parts overflowed.
    let (mut size, mut least) = (t.abs(), f64::INFINITY);
    for (i, product) in products.iter().enumerate() {
        size += product.high.abs();
        if row[i] != 0.0 && x[i] != 0.0 {
            least = least.min(product.high.abs());
        }
    }
    let (mut low, mut rounded) = (first.low, 0.0);
    for error in [second.low, third.low, products[0].low, products[1].low, products[2].low] {
        let sum = two_sum(low, error);
        (low, rounded) = (sum.high, rounded + sum.low.abs());
    }
    let tiny = if least < 2f64.powi(-900) { 2f64.powi(-990) } else { 0.0 };
    let lost = if rounded == 0.0 { 0.0 } else { size / (1u128 << 100) as f64 };
    // NaN, from a product that overflowed, is not less than anything.
    let sum = two_sum(third.high, low);
    (sum, if size < GREATEST && sum.low.is_finite() { lost + tiny } else { f64::INFINITY })
}

impl Signs for Posed<'_> {
    fn volume(&self, corners @ [p, q, r, s]: [usize; 4]) -> i8 {
        if [(p, q), (p, r), (p, s), (q, r), (q, s), (r, s)].iter().any(|(x, y)| self.are_one(*x, *y)) {
            return 0;
        }
        let at = corners.map(|corner| &self.points[corner]);
        let high = at.map(|point| point.map(|x| x.high));
        let [x, y, z] = [1, 2, 3].map(|corner| difference(&high[corner], &high[0]));
        let (sum, magnitude) = solid(x, y, z);
        let error = 2.0 * U * self.reach + self.error;
        let size = Self::size(&[x, y, z], error);
        let found = sign(sum, SOLID * magnitude + 64.0 * error * size * size);
        if found != 0 {
            return found;
        }
        let [x, y, z] = [1, 2, 3].map(|corner| [0, 1, 2].map(|axis| at[corner][axis].minus(at[0][axis])));
        let product = |i: usize, j: usize, k: usize| x[i].times(y[j]).minus(x[j].times(y[i])).times(z[k]);
        let sum = product(1, 2, 0).plus(product(2, 0, 1)).plus(product(0, 1, 2));
        let found = sign(sum.high, (LOST * size + 64.0 * self.error) * size * size);
        if found != 0 {
            return found;
        }
        let at = corners.map(|corner| &self.whole()[corner]);
        let [x, y, z] = [1, 2, 3].map(|corner| [0, 1, 2].map(|axis| &at[corner][axis] - &at[0][axis]));
        let product = |i: usize, j: usize, k: usize| (&x[i] * &y[j] - &x[j] * &y[i]) * &z[k];
        of_integer(&(product(1, 2, 0) + product(2, 0, 1) + product(0, 1, 2)))
    }

    fn area(&self, [i, j]: [usize; 2], corners: [usize; 3]) -> i8 {
        let at = corners.map(|corner| [self.points[corner][i], self.points[corner][j]]);
        let high = at.map(|point| point.map(|x| x.high));
        let [x, y] = [1, 2].map(|corner| difference(&high[corner], &high[0]));
        let (sum, magnitude) = flat(x, y);
        let error = 2.0 * U * self.reach + self.error;
        let size = Self::size(&[[x[0], x[1], 0.0], [y[0], y[1], 0.0]], error);
        let found = sign(sum, FLAT * magnitude + 16.0 * error * size);
        if found != 0 {
            return found;
        }
        let [x, y] = [1, 2].map(|corner| [0, 1].map(|axis| at[corner][axis].minus(at[0][axis])));
        let sum = x[0].times(y[1]).minus(x[1].times(y[0]));
        let found = sign(sum.high, (LOST * size + 16.0 * self.error) * size);
        // A zero needs no integers where two corners are one.
        let [p, q, r] = corners;
        if found != 0 || self.are_one(p, q) || self.are_one(p, r) || self.are_one(q, r) {
            return found;
        }
        let at = corners.map(|corner| [&self.whole()[corner][i], &self.whole()[corner][j]]);
        let [x, y] = [1, 2].map(|corner| [0, 1].map(|axis| at[corner][axis] - at[0][axis]));
        of_integer(&(&x[0] * &y[1] - &x[1] * &y[0]))
    }

    fn compare(&self, axis: usize, p: usize, q: usize) -> Ordering {
        let difference = self.points[p][axis].minus(self.points[q][axis]).high;
        let error = 2.0 * (self.errors[p][axis] + self.errors[q][axis]);
        match sign(difference, error) {
            0 if error > 0.0 || difference.is_nan() => self.whole()[p][axis].cmp(&self.whole()[q][axis]),
            sign => sign.cmp(&0),
        }
    }
}

fn of_integer(x: &BigInt) -> i8 {
    match x.sign() {
        Sign::Minus => -1,
        Sign::NoSign => 0,
        Sign::Plus => 1,
    }
}
