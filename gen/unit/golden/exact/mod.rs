//! The third method: the signs of fifteen determinants of points on a grid, nothing rounded (docs/exact.md).
//!
//! The differences, the moments and the determinants of sections 2 and 3 are those of the
//! [determinant unit](super::determinants) before anything is rounded there. A pair in one plane has a rule of its own
//! (`plane`, section 5); all others are decided by their six edges (`verdict`, sections 4 and 6).

mod cascade;
mod plane;
#[cfg(test)]
mod tests;
mod trace;
mod verdict;

use super::determinants::differences::{Differences, Points};
use super::determinants::fifteen::{Dots, Fifteen};
use super::determinants::moments::Moments;
use super::determinants::number::Number;
use crate::pair::{Outcome, Pair, Pose};
use crate::params::Params;
use cascade::FirstStage;
use plane::Components;
use verdict::{outcome, signs};

/// The exact unit of one parameter set.
#[derive(Clone, Copy, Debug)]
pub(super) struct ExactTest {
    differences: Differences,
    /// R - 1: the greatest magnitude of a difference that fits.
    reach: i64,
    /// Whether the determinants, of at most 24 R^3, fit `i64`.
    narrow: bool,
    /// Of a cascade.
    first: Option<FirstStage>,
}

/// What is computed from the differences of a pair that fits, in the order of the data flow.
struct Computed<N> {
    moments: Moments,
    dots: Dots<N>,
    determinants: Fifteen<N>,
    components: Components,
    outcome: Outcome,
}

impl ExactTest {
    pub fn new(p: &Params) -> Self {
        Self {
            differences: Differences::new(p),
            reach: (1 << (p.width - 1)) - 1,
            narrow: 3 * (p.width - 1) + 5 <= 63,
            first: FirstStage::new(p),
        }
    }

    /// The verdict of a pair with what each witness says.
    pub fn outcome(&self, pose: &Pose, pair: &Pair) -> Outcome {
        let points = self.points(pose, pair);
        if !self.fits(&points) {
            return Outcome::outside();
        }
        let decided = self.first.and_then(|first| first.outcome(&points));
        decided.unwrap_or_else(|| match self.narrow {
            true => computed::<i64>(&points).outcome,
            false => computed::<i128>(&points).outcome,
        })
    }

    /// Whether the first stage of a cascade leaves the pair to the second.
    pub fn is_open(&self, pose: &Pose, pair: &Pair) -> bool {
        let points = self.points(pose, pair);
        self.fits(&points) && self.first.is_some_and(|first| first.outcome(&points).is_none())
    }

    /// The points relative to V0 in units of the grid, and whether the unit decides them.
    pub fn snapped(&self, pose: &Pose, pair: &Pair) -> ([[i64; 3]; 6], bool) {
        let points = self.points(pose, pair);
        let Points { v: [v1, v2], w: [w0, w1, w2] } = points;
        ([[0; 3], v1, v2, w0, w1, w2], self.fits(&points))
    }

    /// Section 2: the five points relative to V0.
    fn points(&self, pose: &Pose, pair: &Pair) -> Points {
        self.differences.points(&self.differences.frame(pose), pair)
    }

    /// What the unit goes on with: 0 in place of what does not fit.
    fn held(&self, Points { v, w }: &Points) -> Points {
        let fit = |x: &[i64; 3]| x.map(|x| if x.abs() <= self.reach { x } else { 0 });
        Points { v: v.each_ref().map(fit), w: w.each_ref().map(fit) }
    }

    /// Whether the unit decides the pair.
    fn fits(&self, Points { v, w }: &Points) -> bool {
        v.iter().chain(w).flatten().all(|x| x.abs() <= self.reach)
    }
}

/// Sections 3 to 6.
fn computed<N: Number>(points: &Points) -> Computed<N> {
    let moments = Moments::new(points);
    let dots = Dots::new(points, &moments);
    let determinants = dots.determinants();
    let components = Components::new(points, &moments);
    let outcome = outcome(&signs(&determinants), || components.position::<N>(points, &moments));
    Computed { moments, dots, determinants, components, outcome }
}
