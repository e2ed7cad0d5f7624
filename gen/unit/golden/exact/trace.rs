//! Every inner number by name, for comparison with another implementation of docs/exact.md.

use super::{Computed, ExactTest, computed};
use crate::golden::determinants::differences::Points;
use crate::golden::determinants::number::Number;
use crate::golden::determinants::trace::Record;
use crate::pair::{Outcome, Pair, Pose};

impl ExactTest {
    /// See [`Golden::trace`](crate::golden::Golden::trace).
    pub fn trace(&self, pose: &Pose, pair: &Pair) -> Vec<(String, i128)> {
        let points = self.points(pose, pair);
        let mut record = Record::default();
        record.points("difference", &points);
        let held = self.held(&points);
        if let Some(first) = &self.first {
            first.trace(&held, &mut record);
            return record.0;
        }
        let outcome = if self.narrow {
            record_computed::<i64>(&mut record, &held)
        } else {
            record_computed::<i128>(&mut record, &held)
        };
        let outcome = if self.fits(&points) { outcome } else { Outcome::outside() };
        record.number("verdict", outcome.verdict as u8);
        record.0
    }
}

/// The numbers of a pair, 0 in place of those that do not fit.
fn record_computed<N: Number>(record: &mut Record, points: &Points) -> Outcome {
    let Computed { moments, dots, determinants, components, outcome } = computed::<N>(points);
    record.moments("moment", &moments);
    record.dots(&dots);
    record.determinants(determinants);
    for (t, x) in components.products(points).into_iter().enumerate() {
        record.number(format!("component.c{t}"), x);
    }
    outcome
}
