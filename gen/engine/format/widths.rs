//! The widths of the numbers in the test of two volumes, from bounds of their values.

use super::EngineFormat;
use crate::words::BlockLayout;

/// A signed number of the test.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Width {
    /// Its magnitude is at most that.
    pub bound: i64,
    /// Its fraction bits; none where it counts steps of its own.
    pub fraction: Option<u32>,
}

impl Width {
    /// Bits of two's complement that hold it.
    pub fn bits(&self) -> u32 {
        65 - self.bound.leading_zeros()
    }
}

/// The numbers of the test of two volumes (docs/engine.md), for words within their declared ranges.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Widths {
    /// Coordinates of origins, and entries of the matrix that meets them.
    pub origin: Width,
    /// Coordinates of the shift.
    pub translation: Width,
    /// D, where the origin of B's block is from that of A's.
    pub distance: Width,
    /// h . D with its error.
    pub base: Width,
    /// The sum of a row.
    pub sum: Width,
    /// U, the row's bound of B.
    pub upper: Width,
    /// V, A's code.
    pub code: Width,
    /// The sum of the three, of which only the sign is kept.
    pub gap: Width,
}

impl Widths {
    pub(super) fn new(format: &EngineFormat) -> Self {
        let grid = format.grid_fraction();
        let on_grid = |bound| Width { bound, fraction: Some(grid) };
        let one = 1i64 << grid;
        let most_origin = i64::from(format.most_origin());
        let rotated = shifted(3 * most_origin * most_origin, format.product_shift()) + 1;
        // The declared bound of a pose word is 4 and 8 ulps below the end of the format.
        let translation = (one << (format.int_bits - 1)) - 4 * one;
        let distance = rotated + translation + (most_origin << format.origin_shift());
        let steps =
            (0..format.directions.count()).map(|i| format.directions.vector(i).iter().map(|x| x.abs()).sum::<i8>());
        let steps = i64::from(steps.max().unwrap_or(0));
        let base = steps * (distance + (1 << format.shift_error_bits()) - 1);
        let factor = (1i64 << format.factor_bits) - 1;
        let sum = 3 * factor * i64::from(format.most()) + (1 << format.rest_bits()) - 1;
        let exponent = (1 << BlockLayout::EXPONENT_BITS) - 1;
        let upper = shifted(sum << exponent, format.factor_fraction() as i32) + 1;
        let code = i64::from(format.most()) << exponent;
        Self {
            origin: Width { bound: most_origin, fraction: Some(format.origin_fraction()) },
            translation: on_grid(translation),
            distance: on_grid(distance),
            base: on_grid(base),
            sum: Width { bound: sum, fraction: None },
            upper: on_grid(upper),
            code: on_grid(code),
            gap: on_grid(base + upper + code),
        }
    }
}

/// A bound that is not negative, times 2^-drop, rounded down.
fn shifted(bound: i64, drop: i32) -> i64 {
    if drop >= 0 { bound >> drop } else { bound << -drop }
}
