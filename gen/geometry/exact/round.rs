//! Exact roundings of sums of binary64 numbers.

use super::integers::split;
use num_bigint::BigInt;
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

#[cfg(test)]
mod tests {
    use super::*;

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
