//! The reference model: what the unit answers, bit for bit, written from the numeric contract and from nothing else.
//!
//! A [`Pair`] of quantised triangles goes through the change of frame (`transform`, contract section 3), is moved to
//! the origin and scaled up (`renormalise`, section 4), yields edges and separating axes (`axes`, section 5), is
//! projected on each of them (`projection`, section 5), and the images are compared (`verdict`, sections 6 and 7).
//! Every signal is an interval that encloses the true real number; every intermediate is computed exactly and rounded
//! outward once, to the row that [`Params::formats`] has for it.
//!
//! The host side of section 2 and seeded inputs are in [`host`](crate::host).

mod axes;
mod guard;
mod input;
mod interval;
mod projection;
mod renormalise;
#[cfg(test)]
mod tests;
mod trace;
mod transform;
mod verdict;

use axes::{Axis, AxisUnit, Edges, Normals};
use guard::Guard;
pub use input::{Input, Pair, Pose};
use interval::{Triple, Wide, three};
use projection::ProjectionUnit;
use renormalise::Normaliser;
use transform::Frame;
pub use verdict::{Outcome, Verdict};

use crate::params::{Axes, Params};
use efsat_hardware::number::Upper;

/// The reference model of one parameter set.
///
/// Inputs must lie in the declared ranges ([`Params::coordinate_bound`], [`Params::translation_bound`], and
/// [`Params::one`] for matrix entries) unless the unit is guarded ([`Params::guarded`]): then any word may come, and a
/// pair outside is answered so. [`host`](crate::host) sends no such pair.
#[derive(Clone, Debug)]
pub struct Golden {
    upper: Upper,
    axes: Axes,
    guard: Guard,
    /// Whether products of two working-width numbers and their sums fit `i64`.
    narrow: bool,
    frame: Frame,
    normaliser: Normaliser,
    axis_unit: AxisUnit,
    projection_unit: ProjectionUnit,
}

/// Everything that precedes the axis test.
struct Points {
    /// B after the change of frame, in the input format.
    transformed: Triple,
    /// A and B after section 4.
    coordinates: [Triple; 2],
}

impl Golden {
    /// The model of a validated parameter set.
    pub fn new(params: &Params) -> Self {
        Self {
            upper: params.upper,
            axes: params.axes,
            guard: Guard::new(params),
            narrow: 2 * params.width + 4 <= 62,
            frame: Frame::new(params),
            normaliser: Normaliser::new(params),
            axis_unit: AxisUnit::new(params),
            projection_unit: ProjectionUnit::new(params),
        }
    }

    /// The verdict of a pair under a pose, with the flags of all axes.
    pub fn outcome(&self, pose: &Pose, pair: &Pair) -> Outcome {
        if !self.guard.inside(pose, pair) {
            Outcome::outside()
        } else if self.narrow {
            self.test::<i64, false>(pose, pair)
        } else {
            self.test::<i128, false>(pose, pair)
        }
    }

    /// The verdict alone: stops at the first separated axis.
    pub fn verdict(&self, pose: &Pose, pair: &Pair) -> Verdict {
        if !self.guard.inside(pose, pair) {
            Outcome::outside().verdict
        } else if self.narrow {
            self.test::<i64, true>(pose, pair).verdict
        } else {
            self.test::<i128, true>(pose, pair).verdict
        }
    }

    /// Sections 3 and 4.
    fn points(&self, pose: &Pose, pair: &Pair) -> Points {
        let interval = |x: &[[Input; 3]; 3]| three(|k| three(|i| x[k][i].interval(self.upper)));
        let transformed = self.frame.apply(pose, &interval(&pair.b));
        let coordinates = self.normaliser.apply(&interval(&pair.a), &transformed);
        Points { transformed, coordinates }
    }

    /// The edges and normals that all axes are built from.
    fn edges<W: Wide>(&self, points: &Points) -> (Edges, Normals) {
        let [a, b] = &points.coordinates;
        let edges = self.axis_unit.edges(a, b);
        let normals = self.axis_unit.normals::<W>(&edges);
        (edges, normals)
    }

    /// All axes, or with `STOP` the axes up to the first separated one.
    fn test<W: Wide, const STOP: bool>(&self, pose: &Pose, pair: &Pair) -> Outcome {
        let points = self.points(pose, pair);
        let (edges, normals) = self.edges::<W>(&points);
        let (mut separated, mut overlapping) = (0, 0);
        for (i, &axis) in Axis::all(self.axes).iter().enumerate() {
            let direction = self.axis_unit.axis::<W>(axis, &edges, &normals);
            let images = self.projection_unit.images::<W>(i, &direction, &points.coordinates);
            let enclosure = self.projection_unit.enclosure(i, &images);
            separated |= u32::from(enclosure.separated()) << i;
            overlapping |= u32::from(enclosure.overlapping()) << i;
            if STOP && separated != 0 {
                break;
            }
        }
        Outcome::new(separated, overlapping)
    }
}
