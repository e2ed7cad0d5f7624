//! Projections on an axis and what is done with duplicates (contract section 5, the paper's equation 2).

use super::axes::Axis;
use super::interval::{Mantissa, Rounding, Triple, Vector, Wide, dot, three};
use super::verdict::Enclosure;
use super::{Loss, Lossless};
use crate::params::{Params, Projections};
use efsat_hardware::number::Interval;

/// The images of A and of B on one axis, by side and vertex.
pub(super) type Images<M> = [[Interval<M>; 3]; 2];

/// A mark for each vertex of A and of B.
type Marks = [[bool; 3]; 2];

/// How points are projected on one axis.
#[derive(Clone, Debug)]
struct Plan {
    rounding: Rounding,
    /// The vertices that project to one true number, for each triangle.
    duplicates: Marks,
    /// The vertex of each such group that `skip` keeps.
    kept: [usize; 2],
    /// The vertices whose projections are computed.
    computed: Marks,
}

/// How points are projected on all axes, in the order of the contract.
#[derive(Clone, Debug)]
pub(super) struct ProjectionUnit {
    policy: Projections,
    plans: Vec<Plan>,
}

/// The vertices of A and of B that project to one true number on `axis`.
///
/// Both ends of an edge agree on every axis built from that edge, and all of a triangle on its own normal.
fn duplicates(axis: Axis) -> Marks {
    let ends = |k: usize| three(|i| i == k || i == (k + 1) % 3);
    let (none, all) = ([false; 3], [true; 3]);
    match axis {
        Axis::NormalA => [all, none],
        Axis::NormalB => [none, all],
        Axis::Cross(k, l) => [ends(k), ends(l)],
        Axis::InPlaneA(k) => [ends(k), none],
        Axis::InPlaneB(l) => [none, ends(l)],
    }
}

/// The vertex of a group of duplicates that `skip` keeps: vertex k of edge k, and vertex 0 for a normal.
fn kept(axis: Axis) -> [usize; 2] {
    match axis {
        Axis::NormalA | Axis::NormalB => [0, 0],
        Axis::Cross(k, l) => [k, l],
        Axis::InPlaneA(k) => [k, 0],
        Axis::InPlaneB(l) => [0, l],
    }
}

impl ProjectionUnit {
    pub fn new(p: &Params, exact: Lossless) -> Self {
        let f = p.formats();
        let grid = f.coordinate_a.format.fraction;
        let plan = |&axis: &Axis| {
            let (kind, duplicates, kept) = (axis.kind(), duplicates(axis), kept(axis));
            let dropped =
                |side: usize, i: usize| p.projections == Projections::Skip && duplicates[side][i] && i != kept[side];
            let rounding =
                Rounding::to_row(grid + f.axis(kind).format.fraction, f.projection(kind), p.projection_upper());
            Plan {
                rounding: rounding.left_out_if(exact.has(Loss::Projection)),
                duplicates,
                kept,
                computed: [0, 1].map(|side| three(|i| !dropped(side, i))),
            }
        };
        Self { policy: p.projections, plans: Axis::all(p.axes).iter().map(plan).collect() }
    }

    /// Which projections on axis number `index` are computed.
    pub fn computed(&self, index: usize) -> &Marks {
        &self.plans[index].computed
    }

    /// The raw images on axis number `index`, whose direction is `direction`. An entry that is not computed repeats the
    /// one kept of its group, and equals it in exact arithmetic.
    #[inline(always)]
    pub fn images<W: Wide>(
        &self,
        index: usize,
        direction: &Vector<W::Mantissa>,
        points: &[Triple<W::Mantissa>; 2],
    ) -> Images<W::Mantissa> {
        let plan = &self.plans[index];
        let image = |side: usize, i: usize| plan.rounding.apply(dot::<W>(&points[side][i], direction));
        if self.policy != Projections::Skip {
            return [0, 1].map(|side| three(|i| image(side, i)));
        }
        let distinct = |side: usize| {
            let kept = image(side, plan.kept[side]);
            three(|i| if i != plan.kept[side] && plan.computed[side][i] { image(side, i) } else { kept.clone() })
        };
        [distinct(0), distinct(1)]
    }

    /// The enclosures that the axis test compares.
    #[inline(always)]
    pub fn enclosure<M: Mantissa>(&self, index: usize, images: &Images<M>) -> Enclosure<M> {
        match self.policy {
            Projections::All | Projections::Skip => Enclosure::new(&images[0], &images[1]),
            Projections::Intersect => {
                let groups = &self.plans[index].duplicates;
                Enclosure::new(&intersected(&images[0], &groups[0]), &intersected(&images[1], &groups[1]))
            }
        }
    }
}

/// Every duplicate replaced by the intersection of its group, which encloses their common true number too.
fn intersected<M: Mantissa>(points: &[Interval<M>; 3], group: &[bool; 3]) -> [Interval<M>; 3] {
    let members = (0..3).filter(|&i| group[i]).map(|i| points[i].clone());
    match members.reduce(|x, y| Interval::new(x.lo.greatest(y.lo), x.hi.least(y.hi))) {
        Some(common) => three(|i| if group[i] { common.clone() } else { points[i].clone() }),
        None => points.clone(),
    }
}
