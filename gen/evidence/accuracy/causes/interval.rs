//! Intervals of binary numbers of any length: exact sums and products, and roundings that can be left out.

use efsat_hardware::number::Upper;
use num_bigint::BigInt;
use num_traits::float::FloatCore;
use num_traits::{Signed, Zero};

/// All numbers from `lo` to `hi`, in units of 2^-fraction.
#[derive(Clone, Debug)]
pub struct Interval {
    lo: BigInt,
    hi: BigInt,
    fraction: i64,
}

impl Interval {
    /// From `lo` to `hi`, in units of 2^-fraction.
    pub fn new(lo: i64, hi: i64, fraction: i64) -> Self {
        Self { lo: lo.into(), hi: hi.into(), fraction }
    }

    /// A finite binary64 number.
    pub fn exact(x: f64) -> Self {
        let (mantissa, exponent, sign) = FloatCore::integer_decode(x);
        let m = BigInt::from(mantissa) * sign;
        if m.is_zero() {
            return Self::zero();
        }
        let zeros = m.trailing_zeros().unwrap_or(0);
        let m: BigInt = m >> zeros;
        Self { lo: m.clone(), hi: m, fraction: -i64::from(exponent) - zeros as i64 }
    }

    /// The number 0.
    pub fn zero() -> Self {
        Self { lo: BigInt::ZERO, hi: BigInt::ZERO, fraction: 0 }
    }

    /// Whether it is the number 0 and nothing else.
    pub fn is_zero(&self) -> bool {
        self.lo.is_zero() && self.hi.is_zero()
    }

    /// Times 2^power.
    pub fn scaled(&self, power: i64) -> Self {
        Self { fraction: self.fraction - power, ..self.clone() }
    }

    /// At no less than that many fraction bits.
    pub fn refined(&self, fraction: i64) -> Self {
        let more = (fraction - self.fraction).max(0);
        Self { lo: &self.lo << more, hi: &self.hi << more, fraction: self.fraction + more }
    }

    fn aligned(&self, other: &Self) -> [Self; 2] {
        [self.refined(other.fraction), other.refined(self.fraction)]
    }

    /// self + other.
    pub fn plus(&self, other: &Self) -> Self {
        let [x, y] = self.aligned(other);
        Self { lo: x.lo + y.lo, hi: x.hi + y.hi, fraction: x.fraction }
    }

    /// -self.
    pub fn negated(&self) -> Self {
        Self { lo: -&self.hi, hi: -&self.lo, fraction: self.fraction }
    }

    /// self - other.
    pub fn minus(&self, other: &Self) -> Self {
        self.plus(&other.negated())
    }

    /// Self * other: the least enclosure, and where both straddle zero [-P, P] with P the product of the greatest
    /// magnitudes (contract section 5).
    pub fn times(&self, other: &Self) -> Self {
        let fraction = self.fraction + other.fraction;
        if self.straddles() && other.straddles() {
            let reach = |x: &Self| x.hi.clone().max(-&x.lo);
            let hi = reach(self) * reach(other);
            return Self { lo: -&hi, hi, fraction };
        }
        if self.lo == self.hi && other.lo == other.hi {
            let product = &self.lo * &other.lo;
            return Self { lo: product.clone(), hi: product, fraction };
        }
        let mut ends = [&self.lo * &other.lo, &self.lo * &other.hi, &self.hi * &other.lo, &self.hi * &other.hi];
        ends.sort();
        let [lo, _, _, hi] = ends;
        Self { lo, hi, fraction }
    }

    fn straddles(&self) -> bool {
        self.lo.is_negative() && self.hi.is_positive()
    }

    /// Brought outward to that many fraction bits; exact where there are no more.
    pub fn rounded(&self, fraction: i64, upper: Upper) -> Self {
        let drop = self.fraction - fraction;
        if drop <= 0 {
            return self.refined(fraction);
        }
        let hi = match upper {
            Upper::Implied => (&self.hi >> drop) + 1,
            Upper::Sticky => -(-&self.hi >> drop),
        };
        Self { lo: &self.lo >> drop, hi, fraction }
    }

    /// Both bounds brought into [-bound, bound], in units of the interval.
    pub fn clamped(&self, bound: i128) -> Self {
        let bound = BigInt::from(bound);
        let clamp = |x: &BigInt| x.clone().min(bound.clone()).max(-&bound);
        Self { lo: clamp(&self.lo), hi: clamp(&self.hi), fraction: self.fraction }
    }

    /// The lower bound as a number.
    pub fn lower(&self) -> Self {
        Self { hi: self.lo.clone(), ..self.clone() }
    }

    /// The upper bound as a number.
    pub fn upper(&self) -> Self {
        Self { lo: self.hi.clone(), ..self.clone() }
    }

    /// From the lower bound of one to the upper bound of another.
    fn between(lower: &Self, upper: &Self) -> Self {
        let [x, y] = lower.aligned(upper);
        Self { lo: x.lo, hi: y.hi, fraction: x.fraction }
    }

    /// The least p with all magnitudes below 2^p; none for zero.
    pub fn exponent(&self) -> Option<i64> {
        let bits = self.lo.bits().max(self.hi.bits()) as i64;
        (bits > 0).then_some(bits - self.fraction)
    }

    /// The least p with a positive number at most 2^p.
    pub fn ceil_log2(&self) -> i64 {
        (&self.hi - 1u32).bits() as i64 - self.fraction
    }

    /// Whether the lower bound is above the other's upper bound.
    pub fn above(&self, other: &Self) -> bool {
        let [x, y] = self.aligned(other);
        x.lo > y.hi
    }

    /// The enclosure of the lesser of two numbers.
    pub fn min(&self, other: &Self) -> Self {
        let [x, y] = self.aligned(other);
        Self { lo: x.lo.min(y.lo), hi: x.hi.min(y.hi), fraction: x.fraction }
    }

    /// The enclosure of the greater of two numbers.
    pub fn max(&self, other: &Self) -> Self {
        self.negated().min(&other.negated()).negated()
    }

    /// The numbers of both.
    pub fn intersected(&self, other: &Self) -> Self {
        let lower = self.lower().max(&other.lower());
        let upper = self.upper().min(&other.upper());
        Self::between(&lower, &upper)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(x: &Interval) -> [f64; 2] {
        let at = |m: &BigInt| f64::from(i32::try_from(m.clone()).unwrap()) * (-(x.fraction as f64)).exp2();
        [at(&x.lo), at(&x.hi)]
    }

    #[test]
    fn arithmetic_on_small_numbers() {
        let (x, y) = (Interval::new(-3, 2, 1), Interval::new(1, 5, 2));
        assert_eq!(value(&x.plus(&y)), [-1.25, 2.25]);
        assert_eq!(value(&x.minus(&y)), [-2.75, 0.75]);
        assert_eq!(value(&x.times(&y)), [-1.875, 1.25]);
        assert_eq!(value(&x.times(&x)), [-2.25, 2.25]);
        assert_eq!(value(&y.rounded(0, Upper::Sticky)), [0.0, 2.0]);
        assert_eq!(value(&Interval::new(4, 4, 2).rounded(0, Upper::Sticky)), [1.0, 1.0]);
        assert_eq!(value(&Interval::new(4, 4, 2).rounded(0, Upper::Implied)), [1.0, 2.0]);
        assert_eq!(value(&Interval::exact(-0.375)), [-0.375, -0.375]);
        assert_eq!(value(&x.min(&y)), [-1.5, 1.0]);
        assert_eq!(value(&x.max(&y)), [0.25, 1.25]);
        assert_eq!(value(&x.intersected(&y)), [0.25, 1.0]);
        assert_eq!((x.exponent(), y.exponent(), Interval::zero().exponent()), (Some(1), Some(1), None));
        assert_eq!((Interval::exact(0.25).ceil_log2(), Interval::exact(0.26).ceil_log2()), (-2, -1));
        assert!(Interval::new(3, 4, 0).above(&y) && !y.above(&x));
    }
}
