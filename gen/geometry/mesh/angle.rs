//! Sine and cosine that are the same bits on every machine.

/// Degrees of the octant the series is used in.
const OCTANT: f64 = 45.0;

/// Sine and cosine of an angle in degrees, accurate to a few units in the last place and never beyond 1.
///
/// The functions of the standard library are those of the platform and may differ in the last bit; a scene must be the
/// same everywhere. Here are only the operations that IEEE 754 fixes. Multiples of 90 degrees give exact 0 and +-1.
pub fn sin_cos_degrees(angle: f64) -> (f64, f64) {
    // The remainder is exact, and so is the distance to the nearest quarter turn, by Sterbenz' lemma.
    let turn = angle % 360.0;
    let quarters = (turn / 90.0).round();
    let rest = turn - quarters * 90.0;
    debug_assert!(rest.abs() <= OCTANT);
    let (sin, cos) = series(rest * (std::f64::consts::PI / 180.0));
    match (quarters as i32).rem_euclid(4) {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    }
}

/// Taylor series for |x| <= pi / 4: the first term left out is below 2^-56 of the result.
fn series(x: f64) -> (f64, f64) {
    let square = x * x;
    let sum = |degrees: [f64; 8]| degrees.iter().fold(1.0, |rest, n| 1.0 - square / (n * (n + 1.0)) * rest);
    let sin = x * sum([16.0, 14.0, 12.0, 10.0, 8.0, 6.0, 4.0, 2.0]);
    let cos = sum([15.0, 13.0, 11.0, 9.0, 7.0, 5.0, 3.0, 1.0]);
    (sin.clamp(-1.0, 1.0), cos.clamp(-1.0, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quarter_turns_are_exact() {
        let expected = [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)];
        for quarter in -8..=8i32 {
            let found = sin_cos_degrees(f64::from(quarter) * 90.0);
            assert_eq!(found, expected[quarter.rem_euclid(4) as usize]);
        }
    }

    #[test]
    fn it_agrees_with_the_platform() {
        for i in -20_000..20_000 {
            let angle = f64::from(i) * 0.037;
            let (sin, cos) = sin_cos_degrees(angle);
            let platform = angle.to_radians().sin_cos();
            assert!((sin - platform.0).abs() < 3e-15 && (cos - platform.1).abs() < 3e-15, "{angle}");
            assert!((sin * sin + cos * cos - 1.0).abs() < 1e-15);
        }
    }
}
