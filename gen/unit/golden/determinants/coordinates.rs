//! The differences brought to the working width, each coordinate axis by its own shift (section 3 of
//! docs/determinants.md).

use super::differences::Points;
use super::number::round;
use crate::golden::interval::three;
use crate::params::{ErrorLevels, Params};

/// The second stage of one parameter set.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scaling {
    width: u32,
    levels: ErrorLevels,
}

/// The five points in the working width.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Coordinates {
    pub points: Points,
    /// d, the bits dropped on each axis.
    pub dropped: [u32; 3],
    /// A coordinate is wrong by at most 1/2 + 2^(level-3).
    pub level: u32,
}

impl Scaling {
    pub fn new(p: &Params) -> Self {
        Self { width: p.width, levels: p.error_levels() }
    }

    /// The coordinates along one axis, all in [-(R-1), R-1] with R = 2^(N-1), and the bits dropped for that.
    #[inline(always)]
    fn axis(&self, x: [i64; 5]) -> ([i64; 5], u32) {
        let all = x.iter().fold(0, |all, x| all | x.unsigned_abs());
        let length = u64::BITS - all.leading_zeros();
        let dropped = (length + 1).saturating_sub(self.width).max(self.levels.least);
        let y = x.map(|x| round(x, dropped));
        // Rounding can carry a coordinate up to R, but not beyond.
        let carried = y.iter().fold(0, |all, y| all | y.abs()) >> (self.width - 1) != 0;
        if carried { (x.map(|x| round(x, dropped + 1)), dropped + 1) } else { (y, dropped) }
    }

    /// The coordinates.
    #[inline(always)]
    pub fn coordinates(&self, differences: &Points) -> Coordinates {
        let axes = three(|j| self.axis(differences.along(j)));
        let dropped = three(|j| axes[j].1);
        let level = |d: u32| self.levels.fine.saturating_sub(d).min(self.levels.greatest);
        Coordinates {
            points: Points::new(three(|j| axes[j].0)),
            dropped,
            level: level(dropped[0]).max(level(dropped[1])).max(level(dropped[2])),
        }
    }
}
