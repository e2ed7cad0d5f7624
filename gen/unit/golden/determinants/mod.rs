//! The second method: fifteen determinants, each with a proven bound on its error, instead of axes (docs/determinants.md).
//!
//! The points are taken relative to V0 (`differences`, section 2) and brought to the working width (`coordinates`,
//! section 3). Two levels of products make the determinants (`moments` and `fifteen`, section 4), each with its bound
//! (`bounds`, section 5). A determinant beyond its bound has a certain sign, and certain signs make the verdict (`verdict`,
//! section 6). Numbers are single integers, no intervals.

mod bounds;
mod coordinates;
mod differences;
mod fifteen;
mod moments;
mod number;
#[cfg(test)]
mod tests;
mod trace;
mod verdict;

use super::{Outcome, Pair, Pose, Verdict};
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

/// Everything that is computed of a pair, in the order of the data flow.
struct Computed<N> {
    differences: Points,
    coordinates: Coordinates,
    moments: Moments,
    /// In units of 2^shift.
    rounded: Moments,
    shift: u32,
    dots: Dots<N>,
    determinants: Fifteen<N>,
    bounds: Fifteen<i64>,
    signs: Signs,
    boxes_apart: bool,
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

    /// The verdict of a pair, with what each witness says.
    #[inline]
    pub fn outcome(&self, frame: &Frame, pair: &Pair) -> Outcome {
        if self.narrow { self.answer::<i64>(frame, pair) } else { self.answer::<i128>(frame, pair) }
    }

    /// The verdict alone: stops at separate boxes.
    #[inline]
    pub fn verdict(&self, frame: &Frame, pair: &Pair) -> Verdict {
        if self.boxes && boxes_apart(&self.coordinates(frame, pair)) {
            return Verdict::Separate;
        }
        self.outcome(frame, pair).verdict
    }

    #[inline(always)]
    fn answer<N: Number>(&self, frame: &Frame, pair: &Pair) -> Outcome {
        let computed = self.computed::<N>(frame, pair);
        outcome(computed.boxes_apart, &computed.signs)
    }

    /// Sections 2 and 3.
    #[inline(always)]
    fn coordinates(&self, frame: &Frame, pair: &Pair) -> Coordinates {
        self.scaling.coordinates(&self.differences.points(frame, pair))
    }

    /// Sections 2 to 6, up to the signs.
    #[inline(always)]
    fn computed<N: Number>(&self, frame: &Frame, pair: &Pair) -> Computed<N> {
        let differences = self.differences.points(frame, pair);
        let coordinates = self.scaling.coordinates(&differences);
        let moments = Moments::new(&coordinates.points);
        let (rounded, shift) = self.rounding.apply(&moments);
        let dots = Dots::new(&coordinates.points, &rounded);
        let determinants = dots.determinants();
        let bounds = self.bounds.of(&coordinates, &rounded, shift);
        let signs = signs(&determinants, &bounds);
        let boxes_apart = self.boxes && boxes_apart(&coordinates);
        Computed { differences, coordinates, moments, rounded, shift, dots, determinants, bounds, signs, boxes_apart }
    }
}
