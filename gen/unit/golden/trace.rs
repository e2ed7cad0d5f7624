//! Every inner interval by name, for comparison with another implementation of the contract.

use super::interval::{Triple, Vector};
use super::{Golden, Pair, Pose, Tested};
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

impl Golden {
    /// Mantissas of every inner interval, each in the format that [`crate::params::Params::formats`] has for it
    /// (`transform` in the input format), in the order of the data flow.
    ///
    /// Names, with vertices k and l, components x, y and z, and axes `n_a`, `n_b`, `c_00` .. `c_22`, `n_a_a0` ..,
    /// `n_b_b0` ..:
    /// `transform.w{l}_{x}`; `renormalise.v{k}_{x}` and `renormalise.w{l}_{x}` (the coordinates after section 4, with
    /// re-normalisation off too); `edge.a{k}_{x}`, `edge.b{l}_{x}`; `axis.{axis}_{x}`; `projection.{axis}.v{k}` and
    /// `.w{l}`, those that are computed, before duplicates are intersected; `enclosure.{axis}.a_min`, `.a_max`,
    /// `.b_min`, `.b_max`. Of a pair outside the declared ranges they are those of the numbers that the guard lets
    /// through.
    pub fn trace(&self, pose: &Pose, pair: &Pair) -> Vec<(String, Interval<i128>)> {
        let mut record = Record::default();
        let (pose, pair) = self.guard.held(pose, pair);
        let points = self.read_points(&pose, &pair);
        record.triple("transform.w", &points.transformed);
        record.triple("renormalise.v", &points.coordinates[0]);
        record.triple("renormalise.w", &points.coordinates[1]);
        let edges = self.axis_unit.edges(&points.coordinates);
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
