//! Pairs whose coordinates are whole multiples of one power of two, and not too many: lattices, integers, short decimals of a
//! binary fraction, numbers that were binary32. There a determinant that is zero is found to be zero without any expansion.
//!
//! In units of the greatest such power of two all is whole. A determinant is computed in binary64. Its sign is certain if it is
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

/// A pair on its grid.
pub(super) struct Whole(Points);

impl Whole {
    /// A pair whose joint box is `extent` wide, if it has such a grid.
    pub fn of(points: &Points, extent: f64) -> Option<Self> {
        let exponent = (extent.to_bits() >> 52) as i32 - 1023;
        if !(-RANGE..=RANGE).contains(&exponent) {
            return None;
        }
        let (fine, unit) = (power_of_two(BITS - 1 - exponent), power_of_two(exponent + 1 - BITS));
        let (mut units, mut all) = ([[0; 3]; 6], 0);
        for (units, x) in units.as_flattened_mut().iter_mut().zip(points.as_flattened()) {
            let whole = (x * fine) as i64;
            // Also not so where the product overflows or underflows.
            if whole as f64 * unit != *x {
                return None;
            }
            *units = whole;
            all |= whole;
        }
        let coarse = power_of_two(-(all.trailing_zeros() as i32));
        Some(Self(units.map(|point| point.map(|x| x as f64 * coarse))))
    }
}

impl Signs for Whole {
    #[inline]
    fn volume(&self, [p, q, r, s]: [usize; 4]) -> i8 {
        let [x, y, z] = [q, r, s].map(|corner| difference(&self.0[corner], &self.0[p]));
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

    #[inline]
    fn area(&self, [i, j]: [usize; 2], [p, q, r]: [usize; 3]) -> i8 {
        let [x, y] = [q, r].map(|corner| [i, j].map(|axis| self.0[corner][axis] - self.0[p][axis]));
        let (sum, magnitude) = flat(x, y);
        if sum.abs() > FLAT * magnitude || magnitude < WHOLE {
            return sign(sum, 0.0);
        }
        let [x, y] = [x, y].map(|x| x.map(|x| i128::from(x as i64)));
        (x[0] * y[1] - x[1] * y[0]).signum() as i8
    }

    #[inline]
    fn compare(&self, axis: usize, p: usize, q: usize) -> Ordering {
        self.0[p][axis].total_cmp(&self.0[q][axis])
    }
}
