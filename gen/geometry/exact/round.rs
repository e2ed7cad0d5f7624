//! Exact roundings of sums of binary64 numbers.

use super::integers::split;
use num_bigint::{BigInt, Sign};
use num_traits::ToPrimitive;

/// Numbers of at most this many bits, of which there are at most 2^6, add up inside `i128`.
const SMALL: i64 = 120;

/// The least whole number not below 2^power times the sum of the numbers, if 64 bits hold it: none if a number is not finite.
/// Nothing is rounded before.
///
/// # Panics
/// If there are more than 64 numbers.
pub fn ceiling(numbers: &[f64], power: i32) -> Option<i64> {
    assert!(numbers.len() <= 64, "{} numbers", numbers.len());
    if !numbers.iter().all(|x| x.is_finite()) {
        return None;
    }
    let parts = || numbers.iter().map(|&x| split(x)).filter(|(mantissa, _)| *mantissa != 0);
    let parts = || parts().map(|(mantissa, exponent)| (mantissa, exponent + i64::from(power)));
    // The last place of the sum, and the length of the longest number in it.
    let grid = parts().map(|(_, exponent)| exponent).min().unwrap_or(0).min(0);
    let length = |mantissa: i64| i64::from(u64::BITS - mantissa.unsigned_abs().leading_zeros());
    let longest = parts().map(|(mantissa, exponent)| length(mantissa) + exponent - grid).max().unwrap_or(0);
    if longest <= SMALL {
        let sum: i128 = parts().map(|(mantissa, exponent)| i128::from(mantissa) << (exponent - grid)).sum();
        return (-(-sum >> (-grid).min(127))).to_i64();
    }
    let sum: BigInt = parts().map(|(mantissa, exponent)| BigInt::from(mantissa) << (exponent - grid)).sum();
    (-(-sum >> -grid)).to_i64()
}

/// The binary64 number nearest to a quotient, that with an even last place of two that are as near; infinite beyond all of them.
///
/// # Panics
/// If the divisor is not positive.
pub(super) fn nearest(dividend: &BigInt, divisor: &BigInt) -> f64 {
    assert_eq!(divisor.sign(), Sign::Plus, "divided by {divisor}");
    let magnitude = BigInt::from(dividend.magnitude().clone());
    // A quotient of 55 or 56 bits in units of 2^power, and whether it has been cut.
    let power = magnitude.bits() as i64 - divisor.bits() as i64 - 55;
    let (above, below) = (power.max(0), (-power).max(0));
    let (scaled, divisor) = (magnitude << below, divisor << above);
    let quotient = &scaled / &divisor;
    let is_cut = &quotient * &divisor != scaled;
    let quotient = quotient.to_u64().expect("56 bits at most");
    // The last place of the result: 53 bits, or the least that there is.
    let place = (power + i64::from(u64::BITS - quotient.leading_zeros()) - 53).max(-1074);
    let dropped = place - power;
    let magnitude = if quotient == 0 || dropped > 60 {
        0.0
    } else if place > 971 {
        f64::INFINITY
    } else {
        let (kept, rest, half) = (quotient >> dropped, quotient & ((1 << dropped) - 1), 1 << (dropped - 1));
        let up = rest > half || (rest == half && (is_cut || kept % 2 == 1));
        // The leading bit counts one in the exponent, and so does one that is carried.
        f64::from_bits((((place + 1074) as u64) << 52) + kept + u64::from(up))
    };
    if dividend.sign() == Sign::Minus { -magnitude } else { magnitude }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::rngs::ChaCha8Rng;
    use rand::{RngExt, SeedableRng};

    #[test]
    fn quotients_are_rounded_to_the_nearest() {
        let at = |dividend: i128, divisor: i128| nearest(&dividend.into(), &divisor.into());
        assert_eq!([at(0, 7), at(1, 3), at(-2, 3), at(10, 5)], [0.0, 1.0 / 3.0, -2.0 / 3.0, 2.0]);
        let one: BigInt = 1.into();
        let tiny = |dividend: u32, power: u32| nearest(&dividend.into(), &(&one << power));
        // Subnormal numbers, half of the least one, a little more, and what is far below.
        assert_eq!([tiny(1, 1074), tiny(3, 1075), tiny(1, 1075)], [5e-324, 1e-323, 0.0]);
        assert_eq!([tiny(3, 1076), tiny(1, 1200)], [5e-324, 0.0]);
        assert_eq!(
            [tiny(1, 1022), nearest(&((&one << 52) - 1), &(&one << 1074))],
            [f64::MIN_POSITIVE, f64::from_bits((1 << 52) - 1)]
        );
        // The greatest number, and half a place more.
        let most = ((&one << 54) - 1) << 970;
        assert_eq!(
            [nearest(&(&most - 1), &one), nearest(&most, &one), nearest(&(-&one << 1100), &one)],
            [f64::MAX, f64::INFINITY, f64::NEG_INFINITY]
        );
        // Whole numbers are rounded as the processor rounds them, and quotients of numbers that binary64 has as it divides.
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        for _ in 0..100_000 {
            let x = rng.random::<i128>() >> rng.random_range(0..127);
            assert_eq!(at(x, 1), x as f64);
            let [p, q] = [(); 2].map(|()| i128::from(rng.random::<i64>() >> rng.random_range(11..60)));
            if q > 0 {
                assert_eq!(at(p, q), p as f64 / q as f64);
            }
        }
    }

    #[test]
    fn sums_are_rounded_up_once() {
        assert_eq!(ceiling(&[], 5), Some(0));
        assert_eq!(ceiling(&[1.0, f64::EPSILON], 0), Some(2));
        assert_eq!(ceiling(&[1.0, -f64::EPSILON], 0), Some(1));
        assert_eq!(ceiling(&[-1.0, f64::EPSILON], 0), Some(0));
        assert_eq!(ceiling(&[0.75, 0.25, -0.5], 1), Some(1));
        assert_eq!(ceiling(&[-0.75], 3), Some(-6));
        // What vanishes beside the others counts.
        assert_eq!(ceiling(&[1e300, 5e-324, -1e300], 0), Some(1));
        assert_eq!(ceiling(&[1e300, -5e-324, -1e300], 0), Some(0));
        assert_eq!(ceiling(&[5e-324], 0), Some(1));
        assert_eq!(ceiling(&[-5e-324], -1000), Some(0));
        assert_eq!(ceiling(&[5e-324], 1074), Some(1));
        assert_eq!(ceiling(&[2f64.powi(62), 2f64.powi(62)], 0), None);
        assert_eq!(ceiling(&[-(2f64.powi(62)), -(2f64.powi(62))], 0), Some(i64::MIN));
        assert_eq!(ceiling(&[1e300], 100), None);
        assert_eq!([f64::NAN, f64::INFINITY].map(|x| ceiling(&[1.0, x], 0)), [None; 2]);
    }
}
