//! Slices of a Virtex-II, estimated: a mapper of Yosys knows look-up tables and flip-flops, but not how ISE packs them.
//!
//! The rule is a least-squares fit to 21 public MAP reports of ISE 10.1 for the XC2V6000 (23 to 8,253 slices, error -16
//! to +21 %). Designs with many more flip-flops than tables came out 7 to 16 % above it.

/// Slices by the fitted rule, between the least and the most that packing can make.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Slices {
    /// 0.487 LUT + 0.223 FF.
    pub fitted: u64,
    /// Every slice full: two tables and two flip-flops. What MAP comes near on a full device.
    pub dense: u64,
    /// Unrelated tables and flip-flops never share half a slice. What MAP does on an empty device.
    pub related_only: u64,
}

/// Slices of so many look-up tables (shift registers and memories included) and flip-flops. `unrelated` is the number of
/// flip-flops that no table of their own feeds; where it is not known it is taken that none is fed.
pub fn estimate(luts: u64, flip_flops: u64, unrelated: Option<u64>) -> Slices {
    let fitted = 0.487 * luts as f64 + 0.223 * flip_flops as f64;
    let halves = luts + unrelated.unwrap_or(flip_flops);
    Slices {
        fitted: fitted.round() as u64,
        dense: luts.max(flip_flops).div_ceil(2),
        related_only: halves.max(flip_flops).div_ceil(2),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rule_and_its_bracket() {
        // 0.487 * 4597 + 0.223 * 6066 = 3591.5.
        let slices = estimate(4597, 6066, None);
        assert_eq!(slices, Slices { fitted: 3591, dense: 3033, related_only: 5332 });
        assert_eq!(estimate(4597, 6066, Some(4897)).related_only, 4747);
        assert_eq!(estimate(0, 0, None), Slices { fitted: 0, dense: 0, related_only: 0 });
        assert_eq!(estimate(1, 4, Some(0)).related_only, 2, "flip-flops need room of their own");
    }
}
