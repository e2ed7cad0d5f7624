//! The differences brought to the working width, each coordinate axis by its own shift (section 3 of
//! docs/determinants.md).

use super::differences::Points;
use super::number::round;
use crate::golden::interval::three;
use crate::params::{Params, Transform};

/// The second stage of one parameter set.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scaling {
    width: u32,
    /// The bits that are dropped at least.
    least: u32,
    /// The error level of differences of which nothing is dropped.
    fine: u32,
    /// The greatest level there is.
    greatest: u32,
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
        // Differences are wrong by less than 5, 2 and 1 ulp; see section 7.1.
        let (fine, greatest): (u32, u32) = match p.transform {
            Transform::On => (6, 6),
            Transform::Translate => (4, 4),
            Transform::Off => (3, 2),
        };
        let least = if p.levels >= greatest { 0 } else { fine.saturating_sub(p.levels) };
        Self { width: p.width, least, fine, greatest }
    }

    /// The least shift with every coordinate in [-(R-1), R-1], R = 2^(N-1).
    #[inline(always)]
    fn shift(&self, x: [i64; 5]) -> u32 {
        let all = x.iter().fold(0, |all, x| all | x.unsigned_abs());
        let length = u64::BITS - all.leading_zeros();
        let shift = (length + 1).saturating_sub(self.width).max(self.least);
        // Rounding can carry a coordinate up to R, but not beyond.
        let carried = x.iter().any(|&x| round(x, shift).abs() >> (self.width - 1) != 0);
        shift + u32::from(carried)
    }

    /// The coordinates.
    #[inline(always)]
    pub fn coordinates(&self, differences: &Points) -> Coordinates {
        let dropped = three(|j| self.shift(differences.along(j)));
        let level = |d: u32| self.fine.saturating_sub(d).min(self.greatest);
        Coordinates {
            points: differences.map(|x, j| round(x, dropped[j])),
            dropped,
            level: level(dropped[0]).max(level(dropped[1])).max(level(dropped[2])),
        }
    }
}
