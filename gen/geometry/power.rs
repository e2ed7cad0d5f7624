//! Binary64 numbers and powers of two.

/// The least e with x <= 2^e, for x >= 0; a small number for 0.
pub(crate) fn ceil_log2(x: f64) -> i32 {
    let (exponent, fraction) = ((x.to_bits() >> 52) as i32, x.to_bits() << 12);
    match exponent {
        // Below 2^-1022; what is below the least exponent of a grid needs no better answer.
        0 => -1022,
        _ => exponent - 1023 + i32::from(fraction != 0),
    }
}

/// x * 2^power, which rounds only results that leave the normal numbers.
pub(crate) fn scaled(x: f64, power: i32) -> f64 {
    // 2^power itself may leave them.
    let half = power / 2;
    x * power_of_two(half) * power_of_two(power - half)
}

/// 2^power, of a power that normal numbers have.
pub(crate) fn power_of_two(power: i32) -> f64 {
    f64::from_bits(((1023 + power) as u64) << 52)
}
