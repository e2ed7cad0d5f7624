//! Fixed-point formats, the two outward roundings, and intervals of integers.
//!
//! A fixed-point number is an integer *mantissa* together with a [`Format`] that places the binary point; all
//! arithmetic in this project happens on mantissas, so it is exact. `s4.14` is a signed format of 18 bits with 4
//! integral digits (the sign among them) and 14 fraction bits; one unit in the last place (the paper's *EPS*,
//! equation 4) is 2^-14.

use std::fmt;

/// A signed two's-complement fixed-point format: `bits` in all, `fraction` of them right of the binary point.
///
/// `fraction` may be negative (the unit in the last place is then greater than one) or exceed `bits`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Format {
    /// All bits, the sign included.
    pub bits: u32,
    /// Fraction bits: the unit in the last place is 2^-fraction.
    pub fraction: i32,
}

impl Format {
    /// The format `s{integral}.{bits - integral}`.
    pub const fn signed(bits: u32, integral: i32) -> Self {
        Self { bits, fraction: bits as i32 - integral }
    }

    /// Integral digits, the sign included: `bits - fraction`.
    pub const fn integral(self) -> i32 {
        self.bits as i32 - self.fraction
    }

    /// The greatest mantissa, 2^(bits-1) - 1.
    pub const fn max(self) -> i128 {
        (1 << (self.bits - 1)) - 1
    }

    /// The least mantissa, -2^(bits-1).
    pub const fn min(self) -> i128 {
        -(1 << (self.bits - 1))
    }

    /// The real value of a mantissa in this format, rounded to binary64 (for messages and plots only).
    pub fn value(self, mantissa: i128) -> f64 {
        mantissa as f64 * (-f64::from(self.fraction)).exp2()
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "s{}.{}", self.integral(), self.fraction)
    }
}

/// How an upper bound is rounded up: the one rule for every rounding of a design (option `--upper`).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Upper {
    /// The next grid point above the floor, always: floor + ulp, the paper's equation (5). Costs no logic to detect
    /// exactness and no extra input bit.
    Implied,
    /// The exact ceiling: floor + OR of the dropped bits. A number on the grid gets an interval of zero width.
    Sticky,
}

/// Drops `drop` low bits rounding towards minus infinity; a negative `drop` appends zeros.
///
/// Lemma R1: `floor_shift(x, d) * 2^d <= x`.
#[inline(always)]
pub fn floor_shift(x: i128, drop: i32) -> i128 {
    if drop >= 0 { x >> drop } else { x << -drop }
}

/// Drops `drop` low bits rounding towards plus infinity by the rule `upper`; a `drop` of zero or less is exact and
/// adds nothing.
///
/// Lemma R2: `upper_shift(x, d, u) * 2^d >= x`.
#[inline(always)]
pub fn upper_shift(x: i128, drop: i32, upper: Upper) -> i128 {
    if drop <= 0 {
        return x << -drop;
    }
    match upper {
        Upper::Implied => (x >> drop) + 1,
        Upper::Sticky => -(-x >> drop),
    }
}

/// A closed interval of mantissas; the real interval it stands for depends on the [`Format`] it is read in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Interval<I = i128> {
    /// Lower bound.
    pub lo: I,
    /// Upper bound, at least `lo`.
    pub hi: I,
}

impl<I> Interval<I> {
    /// The interval from `lo` to `hi`.
    pub const fn new(lo: I, hi: I) -> Self {
        Self { lo, hi }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formats_print_as_in_the_contract() {
        assert_eq!(Format::signed(18, 4).to_string(), "s4.14");
        assert_eq!(Format::signed(6, 8).to_string(), "s8.-2");
        assert_eq!((Format::signed(18, 4).min(), Format::signed(18, 4).max()), (-131_072, 131_071));
    }

    #[test]
    fn roundings_are_outward_and_within_one_ulp() {
        for drop in -2..6 {
            for x in -300..300i128 {
                let (lo, scale) = (floor_shift(x, drop), 1i128 << drop.max(0));
                let exact = x << (-drop).max(0);
                assert!(lo * scale <= exact && exact < (lo + 1) * scale);
                for upper in [Upper::Implied, Upper::Sticky] {
                    let hi = upper_shift(x, drop, upper);
                    assert!(hi * scale >= exact && (hi - 1) * scale <= exact);
                }
                assert!((upper_shift(x, drop, Upper::Sticky) - 1) * scale < exact);
            }
        }
    }
}
