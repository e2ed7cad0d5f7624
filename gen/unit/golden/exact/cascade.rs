//! The first stage of a cascade: rounded determinants of the differences that fit (docs/cascade.md).

use crate::golden::determinants::DeterminantTest;
use crate::golden::determinants::differences::Points;
use crate::golden::determinants::trace::Record;
use crate::pair::{Outcome, Verdict};
use crate::params::{BELOW_GRID, Params};

/// The first stage of one parameter set.
#[derive(Clone, Copy, Debug)]
pub(super) struct FirstStage(DeterminantTest);

impl FirstStage {
    /// None if the unit is no cascade.
    pub fn new(p: &Params) -> Option<Self> {
        p.first_stage().map(|first| Self(DeterminantTest::new(&first)))
    }

    /// The answer of a pair that fits; none if it is left open. An edge that pierces hits, and the pair crosses.
    pub fn outcome(&self, points: &Points) -> Option<Outcome> {
        let outcome = self.0.of_differences::<false>(&scaled(points));
        match outcome.verdict {
            Verdict::Separate => Some(outcome),
            Verdict::Intersect => Some(Outcome { overlapping: outcome.overlapping | 0b101, ..outcome }),
            Verdict::PossiblyIncorrect => None,
        }
    }

    /// What is computed of differences, 0 in place of those that do not fit.
    pub fn trace(&self, points: &Points, record: &mut Record) {
        self.0.trace_from(&scaled(points), record);
    }
}

/// The differences with places below the grid, which are 0.
fn scaled(Points { v, w }: &Points) -> Points {
    let below = |x: &[i64; 3]| x.map(|x| x << BELOW_GRID);
    Points { v: v.each_ref().map(below), w: w.each_ref().map(below) }
}
