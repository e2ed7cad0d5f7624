//! Determinants in binary64, and how far their roundings may have moved them.
//!
//! With u = 2^-53, a computed determinant of third order is a sum of six products of three differences each. A product has
//! taken at most three roundings of differences, three of products and sums in its minor and with its factor, and two of the sum of
//! three: it is off by 8 u (1 + 8 u) of its magnitude. The same sum over magnitudes is itself at most 8 u too small. So a
//! determinant greater than 16 u times that sum has the sign that is computed; in the plane, with four roundings, one greater
//! than 8 u times it. Nothing may underflow or overflow.

/// Half a unit in the last place of 1.
pub(crate) const U: f64 = f64::EPSILON / 2.0;
/// What a determinant of third order is off by, for a sum of magnitudes of 1.
pub(crate) const SOLID: f64 = 16.0 * U;
/// The same of second order.
pub(crate) const FLAT: f64 = 8.0 * U;

/// det(x, y, z), and the sum of the magnitudes of its six products.
#[inline(always)]
pub(crate) fn solid(x: [f64; 3], y: [f64; 3], z: [f64; 3]) -> (f64, f64) {
    let (mut sum, mut magnitude) = (0.0, 0.0);
    for (axis, z) in z.into_iter().enumerate() {
        let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
        let (left, right) = (x[i] * y[j], x[j] * y[i]);
        sum += (left - right) * z;
        magnitude += (left.abs() + right.abs()) * z.abs();
    }
    (sum, magnitude)
}

/// det(x, y), and the sum of the magnitudes of its two products.
#[inline(always)]
pub(crate) fn flat(x: [f64; 2], y: [f64; 2]) -> (f64, f64) {
    let (left, right) = (x[0] * y[1], x[1] * y[0]);
    (left - right, left.abs() + right.abs())
}

/// The sign of a number that is off by up to an error, or 0 if that hides it.
#[inline(always)]
pub(crate) fn sign(x: f64, error: f64) -> i8 {
    i8::from(x > error) - i8::from(x < -error)
}

/// x - y.
#[inline(always)]
pub(crate) fn difference<const N: usize>(x: &[f64; N], y: &[f64; N]) -> [f64; N] {
    std::array::from_fn(|i| x[i] - y[i])
}
