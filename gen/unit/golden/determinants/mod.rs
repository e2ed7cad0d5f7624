//! The second method: fifteen determinants, each with a proven bound on its error, instead of axes (docs/determinants.md).
//!
//! The points are taken relative to V0 (`differences`, section 2) and brought to the working width (`coordinates`,
//! section 3). Two levels of products make the determinants (`moments` and `fifteen`, section 4), each with its bound
//! (`bounds`, section 5). A determinant beyond its bound has a certain sign, and certain signs make the verdict (`verdict`,
//! section 6). Numbers are single integers, no intervals.

mod bounds;
#[cfg(test)]
mod climb;
#[cfg(test)]
mod containment;
mod coordinates;
pub(super) mod differences;
pub(super) mod fifteen;
pub(super) mod moments;
pub(super) mod number;
#[cfg(test)]
mod tests;
pub(super) mod trace;
mod verdict;

use crate::pair::{Outcome, Pair, Pose};
use crate::params::Params;
use bounds::Bounds;
use coordinates::{Coordinates, Scaling};
use differences::{Differences, Frame, Points};
use fifteen::{Dots, Fifteen};
use moments::{Moments, Rounding};
use number::Number;
use verdict::{Signs, boxes_apart, outcome, signs};

/// The determinant unit of one parameter set, behind the guard.
#[derive(Clone, Copy, Debug)]
pub(super) struct DeterminantTest {
    differences: Differences,
    scaling: Scaling,
    rounding: Rounding,
    bounds: Bounds,
    boxes: bool,
    /// Whether the determinants, of 2 N + 3 bits, fit `i64`.
    narrow: bool,
}

/// What is computed from the coordinates of a pair, in the order of the data flow.
struct Computed<N> {
    moments: Moments,
    /// In units of 2^shift.
    rounded: Moments,
    shift: u32,
    dots: Dots<N>,
    determinants: Fifteen<N>,
    bounds: Fifteen<i64>,
    signs: Signs,
}

impl DeterminantTest {
    pub fn new(p: &Params) -> Self {
        Self {
            differences: Differences::new(p),
            scaling: Scaling::new(p),
            rounding: Rounding::new(p),
            bounds: Bounds::new(p),
            boxes: p.boxes,
            narrow: 2 * p.width + 3 <= 63,
        }
    }

    /// The pose, made ready for its pairs.
    pub fn frame(&self, pose: &Pose) -> Frame {
        self.differences.frame(pose)
    }

    /// The verdict of a pair with what each witness says, or with `STOP` the verdict as soon as the boxes are apart.
    #[inline]
    pub fn outcome<const STOP: bool>(&self, frame: &Frame, pair: &Pair) -> Outcome {
        self.of_differences::<STOP>(&self.differences.points(frame, pair))
    }

    /// The same from the differences on.
    #[inline]
    pub fn of_differences<const STOP: bool>(&self, differences: &Points) -> Outcome {
        let coordinates = self.scaling.coordinates(differences);
        let apart = self.boxes && boxes_apart(&coordinates);
        let signs = match self.narrow {
            _ if STOP && apart => Signs::UNKNOWN,
            true => self.computed::<i64>(&coordinates).signs,
            false => self.computed::<i128>(&coordinates).signs,
        };
        outcome(apart, &signs)
    }

    /// Sections 4 and 5, and the signs.
    #[inline(always)]
    fn computed<N: Number>(&self, coordinates: &Coordinates) -> Computed<N> {
        let moments = Moments::new(&coordinates.points);
        let (rounded, shift) = self.rounding.apply(&moments);
        let dots = Dots::new(&coordinates.points, &rounded);
        let determinants = dots.determinants();
        let bounds = self.bounds.of(coordinates, &rounded, shift);
        let signs = signs(&determinants, &bounds);
        Computed { moments, rounded, shift, dots, determinants, bounds, signs }
    }
}
