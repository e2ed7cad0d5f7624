//! Dyadic rationals: exact sums and products of binary64 numbers.

use std::cmp::Ordering;
use std::ops::{Add, Mul, Sub};

use num_bigint::{BigInt, Sign};
use num_traits::{ToPrimitive, Zero};

use crate::golden::Input;

/// A finite binary64 number as `mantissa * 2^exponent`, the mantissa odd or zero.
///
/// The arithmetic of the host is exact for finite numbers only; readers of files refuse the others.
pub(super) fn decoded(x: f64) -> (i64, i32) {
    debug_assert!(x.is_finite(), "{x} is no real number");
    let bits = x.to_bits();
    let field = ((bits >> 52) & 0x7ff) as i32;
    let fraction = (bits & ((1 << 52) - 1)) as i64;
    // A denormal has the exponent of the least normal number and no hidden one.
    let (mantissa, exponent) = if field == 0 { (fraction, -1074) } else { (fraction | 1 << 52, field - 1075) };
    if mantissa == 0 {
        return (0, 0);
    }
    let zeros = mantissa.trailing_zeros();
    let odd = mantissa >> zeros;
    (if x < 0.0 { -odd } else { odd }, exponent + zeros as i32)
}

/// `mantissa * 2^exponent` with an unbounded mantissa.
#[derive(Clone, Debug)]
pub(super) struct Dyadic {
    mantissa: BigInt,
    exponent: i64,
}

impl Dyadic {
    pub fn zero() -> Self {
        Self { mantissa: BigInt::zero(), exponent: 0 }
    }

    pub fn is_zero(&self) -> bool {
        self.mantissa.is_zero()
    }

    /// Times 2^power.
    pub fn scaled(&self, power: i64) -> Self {
        Self { mantissa: self.mantissa.clone(), exponent: self.exponent + power }
    }

    /// The least p with self <= 2^p, for a positive number.
    pub fn ceil_log2(&self) -> i64 {
        (&self.mantissa - 1u32).bits() as i64 + self.exponent
    }

    /// The floor at `fraction` fraction bits and its sticky bit, if the real number lies in
    /// `[-bound, bound] * 2^-fraction`.
    pub fn quantised(&self, fraction: u32, bound: i128) -> Option<Input> {
        let shift = self.exponent + i64::from(fraction);
        let (floor, sticky) = if shift >= 0 {
            (&self.mantissa << shift as u64, false)
        } else {
            let floor = &self.mantissa >> shift.unsigned_abs();
            let sticky = (&floor << shift.unsigned_abs()) != self.mantissa;
            (floor, sticky)
        };
        let lo = i128::from(floor.to_i64()?);
        let inside = -bound <= lo && lo + i128::from(sticky) <= bound;
        inside.then_some(Input { lo: lo as i64, sticky })
    }

    /// Both mantissas at the lesser exponent.
    fn aligned(&self, other: &Self) -> (BigInt, BigInt, i64) {
        let exponent = self.exponent.min(other.exponent);
        let at = |x: &Self| &x.mantissa << (x.exponent - exponent) as u64;
        (at(self), at(other), exponent)
    }
}

impl From<f64> for Dyadic {
    fn from(x: f64) -> Self {
        let (mantissa, exponent) = decoded(x);
        Self { mantissa: mantissa.into(), exponent: exponent.into() }
    }
}

impl Add for &Dyadic {
    type Output = Dyadic;

    fn add(self, other: Self) -> Dyadic {
        if self.is_zero() {
            return other.clone();
        }
        if other.is_zero() {
            return self.clone();
        }
        let (x, y, exponent) = self.aligned(other);
        Dyadic { mantissa: x + y, exponent }
    }
}

impl Sub for &Dyadic {
    type Output = Dyadic;

    fn sub(self, other: Self) -> Dyadic {
        let negated = Dyadic { mantissa: -&other.mantissa, exponent: other.exponent };
        self + &negated
    }
}

impl Mul for &Dyadic {
    type Output = Dyadic;

    fn mul(self, other: Self) -> Dyadic {
        Dyadic { mantissa: &self.mantissa * &other.mantissa, exponent: self.exponent + other.exponent }
    }
}

impl Ord for Dyadic {
    fn cmp(&self, other: &Self) -> Ordering {
        let (x, y) = (self.mantissa.sign(), other.mantissa.sign());
        if x != y || x == Sign::NoSign {
            return x.cmp(&y);
        }
        let (x, y, _) = self.aligned(other);
        x.cmp(&y)
    }
}

impl PartialOrd for Dyadic {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Dyadic {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Dyadic {}
