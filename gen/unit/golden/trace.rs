//! Every inner interval of the axis unit by name, for comparison with another implementation of the contract.

use super::axis_test::{AxisTest, Tested};
use super::interval::{Triple, Vector};
use crate::pair::{Pair, Pose};
use efsat_hardware::number::Interval;

/// The record being written.
#[derive(Default)]
struct Record(Vec<(String, Interval<i128>)>);

impl Record {
    fn number(&mut self, name: String, x: Interval<i64>) {
        self.0.push((name, Interval::new(x.lo.into(), x.hi.into())));
    }

    fn vector(&mut self, name: &str, x: &Vector<i64>) {
        for (component, x) in ["x", "y", "z"].iter().zip(x) {
            self.number(format!("{name}_{component}"), *x);
        }
    }

    fn triple(&mut self, name: &str, x: &Triple<i64>) {
        for (i, x) in x.iter().enumerate() {
            self.vector(&format!("{name}{i}"), x);
        }
    }
}

impl AxisTest {
    /// See [`Golden::trace`](super::Golden::trace).
    pub fn trace(&self, pose: &Pose, pair: &Pair) -> Vec<(String, Interval<i128>)> {
        let mut record = Record::default();
        let placed = self.placed(pose, pair);
        record.triple("transform.w", &placed[1]);
        let points = self.normaliser.apply(&placed);
        record.triple("renormalise.v", &points[0]);
        record.triple("renormalise.w", &points[1]);
        let edges = self.axis_unit.edges(&points);
        record.triple("edge.a", &edges.a);
        record.triple("edge.b", &edges.b);
        self.axes::<i128>(&points, |i, Tested { axis, direction, images, enclosure }| {
            record.vector(&format!("axis.{axis}"), direction);
            let computed = self.projection_unit.computed(i);
            for (side, vertex) in ["v", "w"].iter().enumerate() {
                for k in (0..3).filter(|&k| computed[side][k]) {
                    record.number(format!("projection.{axis}.{vertex}{k}"), images[side][k]);
                }
            }
            record.number(format!("enclosure.{axis}.a_min"), enclosure.a_min);
            record.number(format!("enclosure.{axis}.a_max"), enclosure.a_max);
            record.number(format!("enclosure.{axis}.b_min"), enclosure.b_min);
            record.number(format!("enclosure.{axis}.b_max"), enclosure.b_max);
            true
        });
        record.0
    }
}
