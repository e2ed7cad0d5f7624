//! Confidence bounds of a share.

/// The 97.5 % quantile of the normal distribution: two-sided bounds of 95 %.
const Z: f64 = 1.959_963_984_540_054;

/// The 95 % bounds of the share of which `count` of `all` are a sample (E. B. Wilson, Journal of the American
/// Statistical Association 22, 1927): the shares p with `|count/all - p| <= z sqrt(p (1 - p) / all)`. They stay within
/// 0 and 1 and are not empty where the count is 0. No sample gives [0, 1].
pub fn wilson(count: u64, all: u64) -> [f64; 2] {
    if all == 0 {
        return [0.0, 1.0];
    }
    let n = all as f64;
    let share = count as f64 / n;
    let square = Z * Z / n;
    let middle = share + square / 2.0;
    let half = Z * (share * (1.0 - share) / n + square / (4.0 * n)).sqrt();
    let bound = |x: f64| (x / (1.0 + square)).clamp(0.0, 1.0);
    // The bounds of none and of all are exactly 0 and 1; the formula rounds.
    let low = if count == 0 { 0.0 } else { bound(middle - half) };
    let high = if count == all { 1.0 } else { bound(middle + half) };
    [low, high]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each bound solves the equation that defines it.
    #[test]
    fn bounds_solve_their_equation() {
        for (count, all) in [(0, 10), (1, 10), (5, 10), (10, 10), (2904, 173_174), (3, 100_000)] {
            let (n, share) = (all as f64, count as f64 / all as f64);
            let [low, high] = wilson(count, all);
            assert!((0.0..=1.0).contains(&low) && low <= share && share <= high && high <= 1.0, "{count}/{all}");
            let ends = [(low, count > 0), (high, count < all)];
            for (p, _) in ends.into_iter().filter(|end| end.1) {
                let distance = (share - p).abs() - Z * (p * (1.0 - p) / n).sqrt();
                assert!(distance.abs() < 1e-12, "{count}/{all}: {p} is off by {distance}");
            }
        }
    }

    /// Newcombe, Statistics in Medicine 17 (1998), table I, method 3: 81 of 263, 15 of 148, 0 of 20, 1 of 29.
    #[test]
    fn published_bounds() {
        let expected =
            [(81, 263, 0.2553, 0.3662), (15, 148, 0.0624, 0.1605), (0, 20, 0.0, 0.1611), (1, 29, 0.0061, 0.1718)];
        for (count, all, low, high) in expected {
            let found = wilson(count, all);
            assert!((found[0] - low).abs() < 6e-5 && (found[1] - high).abs() < 6e-5, "{count}/{all}: {found:?}");
        }
        assert_eq!(wilson(0, 0), [0.0, 1.0]);
    }
}
