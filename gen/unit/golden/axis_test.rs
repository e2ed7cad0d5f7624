//! The first method: separating axes in interval arithmetic, as in the paper.
//!
//! A pair goes through the change of frame (`transform`, contract section 3), is moved to the origin and scaled up
//! (`renormalise`, section 4), yields edges and separating axes (`axes`, section 5), is projected on each of them
//! (`projection`, section 5), and the images are compared (`verdict`, sections 6 and 7). Every signal is an interval that
//! encloses the true real number; every intermediate is computed exactly and rounded outward once, to the row that
//! [`Params::formats`] has for it.

use super::axes::{Axis, AxisUnit};
use super::edge_test::Sides;
use super::input::{Input, Numbers, Pair, Pose};
use super::interval::{Triple, Vector, Wide, three};
use super::projection::{Images, ProjectionUnit};
use super::renormalise::Normaliser;
use super::stages::Exact;
use super::transform::Frame;
use super::verdict::{Enclosure, Outcome};
use crate::params::{Axes, Params, Transform};
use efsat_hardware::number::{Interval, Upper};

/// The axis unit of one parameter set, behind the guard.
#[derive(Clone, Debug)]
pub(super) struct AxisTest {
    upper: Upper,
    axes: Axes,
    edge_test: bool,
    transform: Transform,
    /// Whether products of two working-width numbers and their sums fit `i64`.
    narrow: bool,
    frame: Frame,
    normaliser: Normaliser,
    pub axis_unit: AxisUnit,
    pub projection_unit: ProjectionUnit,
}

/// Everything that precedes the axis test.
pub(super) struct Points<M> {
    /// B after the change of frame, in the input format.
    pub transformed: Triple<M>,
    /// A and B after section 4.
    pub coordinates: [Triple<M>; 2],
}

/// One axis, and what is projected on it.
pub(super) struct Tested<'a, M> {
    pub axis: Axis,
    pub direction: &'a Vector<M>,
    pub images: &'a Images<M>,
    pub enclosure: &'a Enclosure<M>,
}

impl AxisTest {
    /// The model without the roundings of these stages.
    pub fn without(params: &Params, exact: Exact) -> Self {
        Self {
            upper: params.upper,
            axes: params.axes,
            edge_test: params.edge_test,
            transform: params.transform,
            narrow: 2 * params.width + 4 <= 62,
            frame: Frame::new(params, exact),
            normaliser: Normaliser::new(params, exact),
            axis_unit: AxisUnit::new(params, exact),
            projection_unit: ProjectionUnit::new(params, exact),
        }
    }

    /// The flags of all axes, or with `STOP` of those up to the first separated one.
    pub fn outcome<const STOP: bool>(&self, pose: &Pose, pair: &Pair) -> Outcome {
        let points = self.read_points(pose, pair);
        if self.narrow { self.test::<i64, STOP>(&points) } else { self.test::<i128, STOP>(&points) }
    }

    /// The enclosures of what the unit reads.
    pub fn read<M: From<i64>>(&self, pose: &Pose, pair: &Pair) -> Numbers<M> {
        let number = |x: Input| {
            let x = x.interval(self.upper);
            Interval::new(x.lo.into(), x.hi.into())
        };
        let triple = |x: &[[Input; 3]; 3]| three(|k| three(|i| number(x[k][i])));
        let bypass = pose.bypass || self.transform == Transform::Off;
        let frame = (!bypass).then(|| (triple(&pose.m), three(|i| number(pose.t[i]))));
        Numbers { a: triple(&pair.a), b: triple(&pair.b), pose: frame }
    }

    /// Sections 2 to 4.
    pub fn read_points(&self, pose: &Pose, pair: &Pair) -> Points<i64> {
        let numbers = self.read(pose, pair);
        if self.frame.narrow { self.points::<i64>(&numbers) } else { self.points::<i128>(&numbers) }
    }

    /// Sections 3 and 4.
    pub fn points<W: Wide>(&self, numbers: &Numbers<W::Mantissa>) -> Points<W::Mantissa> {
        let transformed = self.frame.apply::<W>(numbers);
        let coordinates = self.normaliser.apply(&numbers.a, &transformed);
        Points { transformed, coordinates }
    }

    /// Section 5, axis by axis in the order of the contract, for as long as `test` wants another.
    #[inline(always)]
    pub fn axes<W: Wide>(
        &self,
        points: &Points<W::Mantissa>,
        mut test: impl FnMut(usize, Tested<'_, W::Mantissa>) -> bool,
    ) {
        let edges = self.axis_unit.edges(&points.coordinates);
        let normals = self.axis_unit.normals::<W>(&edges);
        for (i, &axis) in Axis::all(self.axes).iter().enumerate() {
            let direction = &self.axis_unit.axis::<W>(axis, &edges, &normals);
            let images = &self.projection_unit.images::<W>(i, direction, &points.coordinates);
            let enclosure = &self.projection_unit.enclosure(i, images);
            if !test(i, Tested { axis, direction, images, enclosure }) {
                break;
            }
        }
    }

    /// All axes, or with `STOP` the axes up to the first separated one.
    pub fn test<W: Wide, const STOP: bool>(&self, points: &Points<W::Mantissa>) -> Outcome {
        let (mut separated, mut overlapping, mut sides) = (0, 0, Sides::UNKNOWN);
        self.axes::<W>(points, |i, Tested { axis, images, enclosure, .. }| {
            if self.edge_test {
                sides.see(axis, images);
            }
            separated |= u32::from(enclosure.separated()) << i;
            overlapping |= u32::from(enclosure.overlapping()) << i;
            !STOP || separated == 0
        });
        Outcome::new(separated, overlapping, self.edge_test && sides.pierced())
    }
}
