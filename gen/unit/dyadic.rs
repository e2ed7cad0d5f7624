//! Dyadic rationals: exact sums and products of binary64 numbers.

use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

use num_bigint::{BigInt, Sign};
use num_traits::{ToPrimitive, Zero};

use efsat_hardware::number::Upper;

/// A finite binary64 number as `mantissa * 2^exponent`, the mantissa odd or zero.
///
/// The arithmetic of the host is exact for finite numbers only; readers of files refuse the others.
pub(crate) fn decoded(x: f64) -> (i64, i32) {
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
///
/// The mantissa may be even: 2^exponent is the last place that was computed.
#[derive(Clone, Debug)]
pub struct Dyadic {
    mantissa: BigInt,
    exponent: i64,
}

impl Dyadic {
    /// 0.
    pub fn zero() -> Self {
        Self { mantissa: BigInt::ZERO, exponent: 0 }
    }

    /// Whether it is 0.
    pub fn is_zero(&self) -> bool {
        self.mantissa.is_zero()
    }

    /// Times 2^power.
    pub fn scaled(self, power: i64) -> Self {
        Self { exponent: self.exponent + power, ..self }
    }

    /// The least p with a magnitude below 2^p; none for zero.
    pub fn length(&self) -> Option<i64> {
        (!self.is_zero()).then(|| self.mantissa.bits() as i64 + self.exponent)
    }

    /// The least p with self <= 2^p, for a positive number.
    pub fn ceil_log2(&self) -> i64 {
        (&self.mantissa - 1u32).bits() as i64 + self.exponent
    }

    /// With a last place of 2^exponent or finer.
    fn refined(self, exponent: i64) -> Self {
        let zeros = (self.exponent - exponent).max(0);
        Self { mantissa: self.mantissa << zeros, exponent: self.exponent - zeros }
    }

    /// With a last place of 1 or finer.
    pub fn at_last_place(self) -> Self {
        self.refined(0)
    }

    /// The greatest whole number that is not above.
    pub fn floor(self) -> Self {
        let Self { mantissa, exponent } = self.refined(0);
        Self { mantissa: mantissa >> -exponent, exponent: 0 }
    }

    /// A whole number above by the rule for upper bounds; itself if there are no places below 1.
    pub fn upper(self, rule: Upper) -> Self {
        match rule {
            Upper::Implied if self.exponent < 0 => self.floor() + Self::from(1),
            _ => -(-self).floor(),
        }
    }

    /// The greatest whole number that is not above, if it has at most 64 bits, and whether the number is above it.
    pub fn floor_and_rest(self) -> Option<(i64, bool)> {
        let floor = self.clone().floor();
        let rest = floor != self;
        Some((floor.mantissa.to_i64()?, rest))
    }

    /// The coordinates of points as integers, all with one last place.
    pub fn together<const N: usize>(points: [[Self; 3]; N]) -> [[BigInt; 3]; N] {
        let exponent = points.iter().flatten().filter(|x| !x.is_zero()).map(|x| x.exponent).min().unwrap_or(0);
        points.map(|point| point.map(|x| if x.is_zero() { BigInt::ZERO } else { x.refined(exponent).mantissa }))
    }

    /// Both mantissas at the lesser exponent.
    fn aligned(&self, other: &Self) -> (BigInt, BigInt, i64) {
        let exponent = self.exponent.min(other.exponent);
        let at = |x: &Self| x.clone().refined(exponent).mantissa;
        (at(self), at(other), exponent)
    }
}

impl From<f64> for Dyadic {
    fn from(x: f64) -> Self {
        let (mantissa, exponent) = decoded(x);
        Self { mantissa: mantissa.into(), exponent: exponent.into() }
    }
}

impl From<i64> for Dyadic {
    fn from(x: i64) -> Self {
        Self { mantissa: x.into(), exponent: 0 }
    }
}

impl Add for Dyadic {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let (x, y, exponent) = self.aligned(&other);
        Self { mantissa: x + y, exponent }
    }
}

impl Sub for Dyadic {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Neg for Dyadic {
    type Output = Self;

    fn neg(self) -> Self {
        Self { mantissa: -self.mantissa, ..self }
    }
}

impl Mul for Dyadic {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Self { mantissa: self.mantissa * other.mantissa, exponent: self.exponent + other.exponent }
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
