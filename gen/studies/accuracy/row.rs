//! A point of the sweep with what follows from it.

use super::point::{Options, Point};
use super::{Answers, Share};
use efsat_unit::host::Verdicts;
use serde::{Deserialize, Serialize};

/// A point with what follows from it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// The point.
    #[serde(flatten)]
    pub point: Point,
    /// Whether it is the one around which the sweep goes.
    pub base: bool,
    /// Definite answers.
    pub definite: Share,
    /// Answers "separate".
    pub separate: Share,
    /// Answers "intersect".
    pub intersect: Share,
    /// Answers "possibly incorrect".
    pub possibly_incorrect: Share,
    /// Million pairs per second at full speed, retests left out.
    pub million_pairs_per_second: f64,
    /// The hardware's time a pair, ns.
    pub hardware_ns: f64,
    /// What a possibly incorrect pair costs beyond that: exact retest and transfer, ns.
    pub cost_ns: f64,
    /// The effective time a pair: hardware time + share of possibly incorrect pairs x their cost, ns.
    pub effective_ns: f64,
    /// No other point has both fewer possibly incorrect pairs and less effective time.
    pub best_for_time: bool,
    /// The same for multipliers.
    pub best_for_multipliers: bool,
}

impl Row {
    pub(super) fn new(point: Point, base: &Options, yardstick_ns: f64, transfer_ns: f64) -> Self {
        let Answers { pairs, verdicts: Verdicts { separate, intersect, possibly_incorrect }, retest, .. } =
            point.answers;
        let hardware_ns = point.hardware.ns();
        let cost_ns = retest.map_or(0.0, |timing| timing.yardsticks * yardstick_ns + transfer_ns);
        Self {
            base: point.options == *base,
            definite: Share::new(separate + intersect, pairs),
            separate: Share::new(separate, pairs),
            intersect: Share::new(intersect, pairs),
            possibly_incorrect: Share::new(possibly_incorrect, pairs),
            million_pairs_per_second: 1000.0 / hardware_ns,
            hardware_ns,
            cost_ns,
            effective_ns: hardware_ns + point.answers.share() * cost_ns,
            best_for_time: false,
            best_for_multipliers: false,
            point,
        }
    }
}

/// Whether no other point is at least as good in both and better in one.
pub(super) fn is_best(x: &[f64], y: &[f64], i: usize) -> bool {
    (0..x.len()).all(|j| !(x[j] <= x[i] && y[j] <= y[i] && (x[j] < x[i] || y[j] < y[i])))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_best_are_those_that_nothing_beats() {
        let (x, y) = ([1.0, 2.0, 2.0, 3.0, 3.0], [5.0, 4.0, 4.0, 4.0, 1.0]);
        let best: Vec<bool> = (0..5).map(|i| is_best(&x, &y, i)).collect();
        assert_eq!(best, [true, true, true, false, true]);
    }
}
