//! Whole numbers wide enough for the pair at hand: 128 bits, or as many as it takes.

use num_bigint::BigInt;
use num_traits::Signed;

/// An integer wide enough for the pair at hand.
pub(super) trait Whole:
    Signed + Ord + Clone + From<i64> + std::ops::Shl<u32, Output = Self> + std::ops::Shr<u32, Output = Self>
{
    /// The number of bits of a non-negative number.
    fn length(&self) -> u32;

    /// How often two divides a number that is not zero.
    fn twos(&self) -> u32;

    /// The low bits; only asked for what fits.
    fn low(&self) -> i64;
}

impl Whole for i128 {
    fn length(&self) -> u32 {
        Self::BITS - self.leading_zeros()
    }

    fn twos(&self) -> u32 {
        self.trailing_zeros()
    }

    fn low(&self) -> i64 {
        *self as i64
    }
}

impl Whole for BigInt {
    fn length(&self) -> u32 {
        self.bits() as u32
    }

    fn twos(&self) -> u32 {
        self.trailing_zeros().map_or(0, |twos| twos as u32)
    }

    fn low(&self) -> i64 {
        i64::try_from(self).expect("a normalised coordinate has at most 48 bits")
    }
}
