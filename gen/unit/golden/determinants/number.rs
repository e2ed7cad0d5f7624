//! Vectors of integers, and the few operations on them that the determinants are made of.

use std::ops::{Add, Mul, Neg, Shr, Sub};

/// Three coordinates or components.
pub(in crate::golden) type Vector = [i64; 3];

/// An integer in which products and their sums are exact: `i64` where they fit, else `i128`.
pub(in crate::golden) trait Number:
    Copy
    + Ord
    + From<i64>
    + Into<i128>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Neg<Output = Self>
    + Shr<u32, Output = Self>
{
    /// The number as an `i64`, in which it is known to fit.
    fn narrow(self) -> i64;
}

impl Number for i64 {
    #[inline(always)]
    fn narrow(self) -> i64 {
        self
    }
}

impl Number for i128 {
    #[inline(always)]
    fn narrow(self) -> i64 {
        self as i64
    }
}

/// x / 2^shift, rounded to the nearest integer, halves up.
#[inline(always)]
pub(in crate::golden) fn round(x: i64, shift: u32) -> i64 {
    // Half a unit of the result; none where nothing is dropped.
    (x + (1 << shift >> 1)) >> shift
}

/// x - y.
#[inline(always)]
pub(in crate::golden) fn minus(x: &Vector, y: &Vector) -> Vector {
    [x[0] - y[0], x[1] - y[1], x[2] - y[2]]
}

/// x . y.
#[inline(always)]
pub(in crate::golden) fn dot<N: Number>(x: &Vector, y: &Vector) -> N {
    let product = |j: usize| N::from(x[j]) * N::from(y[j]);
    product(0) + product(1) + product(2)
}

/// x x y.
#[inline(always)]
pub(in crate::golden) fn cross(x: &Vector, y: &Vector) -> Vector {
    let component = |j: usize, k: usize| x[j] * y[k] - x[k] * y[j];
    [component(1, 2), component(2, 0), component(0, 1)]
}

/// |x|, the sum of the magnitudes of the components.
#[inline(always)]
pub(in crate::golden) fn norm(x: &Vector) -> i64 {
    x[0].abs() + x[1].abs() + x[2].abs()
}
