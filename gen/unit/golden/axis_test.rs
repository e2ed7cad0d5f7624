//! The first method: separating axes in interval arithmetic, as in the paper.
//!
//! A pair goes through the change of frame (`transform`, contract section 3), is moved to the origin and scaled up
//! (`renormalise`, section 4), yields edges and separating axes (`axes`, section 5), is projected on each of them
//! (`projection`, section 5), and the images are compared (`verdict`, sections 6 and 7). Every signal is an interval that
//! encloses the true real number; every intermediate is computed exactly and rounded outward once, to the row that
//! [`Params::formats`] has for it.

use super::axes::{Axis, AxisUnit};
use super::edge_test::Sides;
use super::interval::{Flags, Triple, Vector, Wide, three};
use super::losses::Lossless;
use super::numbers::Numbers;
use super::projection::{Images, ProjectionUnit};
use super::renormalise::Normaliser;
use super::transform::Frame;
use super::verdict::Enclosure;
use crate::pair::{Input, Outcome, Pair, Pose};
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
    /// Whether they fit the 53 bits of a lane, as the numbers before the axis test always do.
    pub laned: bool,
    pub frame: Frame,
    pub normaliser: Normaliser,
    pub axis_unit: AxisUnit,
    pub projection_unit: ProjectionUnit,
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
    pub fn without(params: &Params, exact: Lossless) -> Self {
        Self {
            upper: params.upper,
            axes: params.axes,
            edge_test: params.edge_test,
            transform: params.transform,
            narrow: 2 * params.width + 4 <= 62,
            laned: 2 * params.width + 4 <= f64::MANTISSA_DIGITS,
            frame: Frame::new(params, exact),
            normaliser: Normaliser::new(params, exact),
            axis_unit: AxisUnit::new(params, exact),
            projection_unit: ProjectionUnit::new(params, exact),
        }
    }

    /// The flags of all axes, or with `STOP` of those up to the first separated one.
    pub fn outcome<const STOP: bool>(&self, pose: &Pose, pair: &Pair) -> Outcome {
        let points = self.normaliser.apply(&self.placed(pose, pair));
        if self.narrow { self.test::<i64, STOP>(&points) } else { self.test::<i128, STOP>(&points) }.outcome()
    }

    /// The enclosures of what the unit reads.
    #[inline(always)]
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

    /// A and B in the frame of A: sections 2 and 3.
    #[inline(always)]
    pub fn placed(&self, pose: &Pose, pair: &Pair) -> [Triple<i64>; 2] {
        let numbers = self.read(pose, pair);
        if self.frame.narrow { self.frame.apply::<i64>(&numbers) } else { self.frame.apply::<i128>(&numbers) }
    }

    /// Section 5, axis by axis in the order of the contract, for as long as `test` wants another.
    #[inline(always)]
    pub fn axes<W: Wide>(
        &self,
        points: &[Triple<W::Mantissa>; 2],
        mut test: impl FnMut(usize, Tested<'_, W::Mantissa>) -> bool,
    ) {
        let edges = self.axis_unit.edges(points);
        let normals = self.axis_unit.normals::<W>(&edges);
        for (i, &axis) in Axis::all(self.axes).iter().enumerate() {
            let direction = &self.axis_unit.axis::<W>(axis, &edges, &normals);
            let images = &self.projection_unit.images::<W>(i, direction, points);
            let enclosure = &self.projection_unit.enclosure(i, images);
            if !test(i, Tested { axis, direction, images, enclosure }) {
                break;
            }
        }
    }

    /// All axes, or with `STOP` the axes up to the first by which all pairs are separated.
    #[inline(always)]
    pub fn test<W: Wide, const STOP: bool>(&self, points: &[Triple<W::Mantissa>; 2]) -> Shown<W::Flags> {
        let mut shown = Shown::<W::Flags>::default();
        let mut sides = Sides::default();
        self.axes::<W>(points, |i, Tested { axis, images, enclosure, .. }| {
            if self.edge_test {
                sides.see(axis, images);
            }
            shown.separated = shown.separated | enclosure.separated().bit(i);
            shown.overlapping = shown.overlapping | enclosure.overlapping().bit(i);
            !STOP || !shown.separated.all()
        });
        if self.edge_test {
            shown.pierced = sides.pierced();
        }
        shown
    }
}

/// What the axes show: bit i of the flags belongs to axis i.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Shown<F> {
    pub separated: F,
    pub overlapping: F,
    /// Not 0 if an edge certainly passes through the other triangle.
    pub pierced: F,
}

impl Shown<u32> {
    /// Section 7.
    #[inline(always)]
    pub fn outcome(self) -> Outcome {
        Outcome::new(self.separated, self.overlapping, self.pierced != 0)
    }
}
