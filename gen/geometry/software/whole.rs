//! Pairs whose coordinates are whole multiples of one power of two, and not too many: lattices, integers, short decimals of a
//! binary fraction, numbers that were binary32. There a determinant that is zero is found to be zero without any expansion.
//!
//! In units of the greatest such power of two all is whole. A determinant is computed in binary64, which rounds nothing if no two
//! coordinates differ by more than 2^16: six products of three of these are below 2^53. Its sign is certain, too, if it is
//! greater than its error, and if the sum of its magnitudes is below 2^52: then nothing was rounded, as all that was computed,
//! products with 0 aside, is whole and at most that sum. Otherwise 128 bits hold it, as no two coordinates differ by more than
//! 2^41: six products of three of these are below 2^126.

use super::determinant::{FLAT, SOLID, difference, flat, sign, solid};
use super::robbins_whitesides::Signs;
use crate::Points;
use crate::power::power_of_two;
use std::cmp::Ordering;

/// Differences are at most 2^BITS.
const BITS: i32 = 41;
/// Whole numbers whose magnitudes sum up to less, as computed, are not rounded: 2^52.
const WHOLE: f64 = (1u64 << 52) as f64;
/// Extents outside of 2^-RANGE to 2^RANGE are left to others.
const RANGE: i32 = 900;

/// No determinant of differences of at most 2^SHORT is rounded.
const SHORT: i32 = 16;

/// A pair on its grid.
pub(super) struct Whole {
    points: Points,
    /// Whether no difference is greater than 2^[`SHORT`].
    is_short: bool,
}

impl Whole {
    /// A pair whose joint box is `extent` wide, if it has such a grid.
    pub fn of(points: &Points, extent: f64) -> Option<Self> {
        let exponent = (extent.to_bits() >> 52) as i32 - 1023;
        if !(-RANGE..=RANGE).contains(&exponent) {
            return None;
        }
        // The exponent of the lowest bit that is set, of subnormal numbers of one below it.
        let lowest = |x: &f64| match x.to_bits() {
            bits if bits << 1 == 0 => i32::MAX,
            bits => (bits >> 52 & 0x7ff) as i32 + (bits | 1 << 52).trailing_zeros() as i32 - 1075,
        };
        let unit = points.as_flattened().iter().map(lowest).min()?;
        // The extent is less than 2^bits units.
        let bits = exponent + 1 - unit;
        if bits > BITS {
            return None;
        }
        // Adding zero makes one of the two zeros.
        let points = points.map(|point| point.map(|x| x * power_of_two(-unit) + 0.0));
        let is_finite = points.as_flattened().iter().fold(true, |all, x| all & x.is_finite());
        is_finite.then_some(Self { points, is_short: bits <= SHORT })
    }
}

impl Signs for Whole {
    #[inline(always)]
    fn volume(&self, [p, q, r, s]: [usize; 4]) -> i8 {
        let [x, y, z] = [q, r, s].map(|corner| difference(&self.points[corner], &self.points[p]));
        if self.is_short { sign(solid(x, y, z).0, 0.0) } else { long_volume(x, y, z) }
    }

    #[inline(never)]
    fn area(&self, [i, j]: [usize; 2], [p, q, r]: [usize; 3]) -> i8 {
        let [x, y] = [q, r].map(|corner| [i, j].map(|axis| self.points[corner][axis] - self.points[p][axis]));
        if self.is_short { sign(flat(x, y).0, 0.0) } else { long_area(x, y) }
    }

    #[inline]
    fn compare(&self, axis: usize, p: usize, q: usize) -> Ordering {
        self.points[p][axis].total_cmp(&self.points[q][axis])
    }
}

/// The sign of det(x, y, z) for whole numbers up to 2^[`BITS`].
#[inline(never)]
fn long_volume(x: [f64; 3], y: [f64; 3], z: [f64; 3]) -> i8 {
    let (sum, magnitude) = solid(x, y, z);
    if sum.abs() > SOLID * magnitude || magnitude < WHOLE {
        return sign(sum, 0.0);
    }
    // Common vertices are the most frequent zeros of long numbers; those of s and p have been seen.
    if x == y || x == z || y == z {
        return 0;
    }
    let [x, y, z] = [x, y, z].map(|x| x.map(|x| i128::from(x as i64)));
    let minor = |i: usize, j: usize| x[i] * y[j] - x[j] * y[i];
    (minor(1, 2) * z[0] + minor(2, 0) * z[1] + minor(0, 1) * z[2]).signum() as i8
}

/// The sign of det(x, y) for whole numbers up to 2^[`BITS`].
#[inline(never)]
fn long_area(x: [f64; 2], y: [f64; 2]) -> i8 {
    let (sum, magnitude) = flat(x, y);
    if sum.abs() > FLAT * magnitude || magnitude < WHOLE {
        return sign(sum, 0.0);
    }
    let [x, y] = [x, y].map(|x| x.map(|x| i128::from(x as i64)));
    (x[0] * y[1] - x[1] * y[0]).signum() as i8
}
