//! The axes of the data path: which axis each unit tests in which phase, on what operands, and how the flags are held.

use super::axes::{Axis, Duplicates, Factor};
use super::cross_product::{self, COORDINATES, select_bits};
use super::interval::{Bounds, Rounding};
use super::multiply::{self, Factor as Signed};
use super::pipeline::{Edges, Flags, Pipeline, Point, rounding};
use super::{comparator, projection};
use crate::params::{AxisKind, Formats, Params, Projections, Row};
use efsat_hardware::graph::{NodeId, Type, Unit};
use std::rc::Rc;

impl Pipeline<'_> {
    /// All axes: cross products, projections, comparators, and the flags of each axis, clear for a pair `outside`.
    pub(super) fn axes(&mut self, points: &[Point], edges: &Edges, outside: Option<NodeId>) -> Flags {
        let p = self.p;
        let all = Axis::all(p.axes);
        let units = p.axes_per_clock;
        let jobs: Vec<Vec<Option<Axis>>> =
            (0..units).map(|u| (0..self.interval).map(|s| all.get(s * units + u).copied()).collect()).collect();
        let shared = Shared::new(p, &self.formats, &all);
        let pure = |jobs: &[Option<Axis>]| jobs.iter().flatten().all(Axis::in_plane);
        // Units that test an in-plane axis and nothing else wait for the normals; the others come first.
        let (late, early): (Vec<usize>, Vec<usize>) = (0..units).partition(|u| pure(&jobs[*u]));
        let mut open = vec![];
        let mut crosses: Vec<Option<Point>> = vec![None; units];
        for u in early {
            crosses[u] = Some(self.cross(u, &jobs[u], &shared, edges, None, &mut open));
        }
        if p.axes.count() > 11 {
            let normals = [0, 1].map(|i: usize| {
                let (u, s) = (i % units, i / units);
                let l = crosses[u].expect("normals are tested early");
                let name = all[i].name();
                [0, 1, 2].map(|c| {
                    let mut held =
                        |end: &str, node| self.b.hold(&format!("{name}_{}_{end}", COORDINATES[c]), node, s, false);
                    let lo = held("lo", l[c].lo);
                    Bounds { lo, hi: held("hi", l[c].hi) }
                })
            });
            for (choice, leg, factor, c, upper) in open {
                let normal = normals[usize::from(factor == Factor::NormalB)][c];
                self.b.connect(choice, leg, if upper { normal.hi } else { normal.lo });
            }
            for u in late {
                crosses[u] = Some(self.cross(u, &jobs[u], &shared, edges, Some(&normals), &mut vec![]));
            }
        }
        let names = ["v0", "v1", "v2", "w0", "w1", "w2"];
        let points: Vec<[Signed; 3]> =
            names.iter().zip(points).map(|(name, x)| self.signed(name, &shared, *x)).collect();
        let mut flags: Vec<Option<(NodeId, NodeId)>> = vec![None; all.len()];
        for (u, jobs) in jobs.iter().enumerate() {
            let l = crosses[u].expect("every unit has axes");
            let l = self.signed(&format!("axis_{u}_l"), &shared, l);
            let flags_now = self.decide(u, jobs, &shared, &points, l);
            let (separated, overlapping) = self.silenced(u, jobs, outside, flags_now);
            for (s, axis) in jobs.iter().enumerate() {
                let Some(axis) = axis else { continue };
                let lagged = lagged(jobs, axis);
                let name = axis.name();
                let separated = self.b.hold(&format!("separated_{name}"), separated, s, lagged);
                let overlapping = self.b.hold(&format!("overlapping_{name}"), overlapping, s, lagged);
                flags[axis.index] = Some((separated, overlapping));
            }
        }
        let (separated, overlapping) = flags.into_iter().flatten().unzip();
        Flags { separated, overlapping }
    }

    /// The cross product of unit `u`.
    fn cross(
        &mut self,
        u: usize,
        jobs: &[Option<Axis>],
        shared: &Shared,
        edges: &Edges,
        normals: Option<&[Point; 2]>,
        open: &mut Vec<(NodeId, usize, Factor, usize, bool)>,
    ) -> Point {
        let name = format!("axis_{u}");
        let mut args = vec![];
        for (side, of) in [("e", (|a| a.left) as fn(&Axis) -> Factor), ("f", |a| a.right)] {
            let phases: Vec<Option<(Factor, bool)>> =
                jobs.iter().map(|job| job.map(|axis| (of(&axis), lagged(jobs, &axis)))).collect();
            let (select, legs) = self.pattern(&format!("{name}_{side}"), &phases);
            for (c, coordinate) in COORDINATES.iter().enumerate() {
                for (end, upper) in [("lo", false), ("hi", true)] {
                    let value = |factor: Factor| {
                        let point = match factor {
                            Factor::EdgeA(k) => edges.a[k],
                            Factor::EdgeB(l) => edges.b[l],
                            Factor::MinusEdgeA2 => edges.minus_a2,
                            Factor::MinusEdgeB2 => edges.minus_b2,
                            Factor::NormalA => normals?[0],
                            Factor::NormalB => normals?[1],
                        };
                        Some(if upper { point[c].hi } else { point[c].lo })
                    };
                    let nodes: Vec<(Option<NodeId>, bool)> =
                        legs.iter().map(|(factor, lagged)| (value(*factor), *lagged)).collect();
                    let choice = self.b.choose(&format!("{name}_{side}_{coordinate}_{end}"), select, &nodes);
                    for (leg, (node, _)) in nodes.iter().enumerate() {
                        if node.is_none() {
                            open.push((choice, leg, legs[leg].0, c, upper));
                        }
                    }
                    args.push(choice);
                }
            }
        }
        if shared.axis_roundings.len() > 1 {
            let values: Vec<Option<usize>> =
                jobs.iter().map(|job| job.map(|axis| shared.axis_rounding(&self.formats, axis.kind))).collect();
            args.push(self.control(&format!("{name}_rounding"), &values, select_bits(shared.axis_roundings.len())));
        }
        let l = self.b.instance(&format!("{name}_cross"), &shared.cross, &args);
        for node in &l {
            self.b.probe(*node, meaningful(jobs));
        }
        [0, 1, 2].map(|c| Bounds { lo: l[2 * c], hi: l[2 * c + 1] })
    }

    /// A vector with the sign cases of its components, found once for all its products.
    fn signed(&mut self, name: &str, shared: &Shared, x: Point) -> [Signed; 3] {
        [0, 1, 2].map(|c| multiply::factor(&mut self.b, &format!("{name}_{}", COORDINATES[c]), &shared.sign_case, x[c]))
    }

    /// Projections and comparators of unit `u`.
    fn decide(
        &mut self,
        u: usize,
        jobs: &[Option<Axis>],
        shared: &Shared,
        points: &[[Signed; 3]],
        l: [Signed; 3],
    ) -> (NodeId, NodeId) {
        let p = self.p;
        let name = format!("axis_{u}");
        let several = shared.projection_roundings.len() > 1;
        let rounding = several.then(|| {
            let values: Vec<Option<usize>> =
                jobs.iter().map(|job| job.map(|axis| shared.projection_rounding(&self.formats, axis.kind))).collect();
            self.control(
                &format!("{name}_projection_rounding"),
                &values,
                select_bits(shared.projection_roundings.len()),
            )
        });
        let mut results = vec![];
        for slot in 0..shared.slots {
            let phases: Vec<Option<(usize, bool)>> = jobs
                .iter()
                .map(|job| {
                    let axis = (*job)?;
                    Some((shared.point(&axis, p.projections, slot)?, lagged(jobs, &axis)))
                })
                .collect();
            let slot_name = format!("{name}_p{slot}");
            if phases.iter().all(Option::is_none) {
                // No axis of this unit projects so many points: the comparator is told to ignore the slot.
                results.extend_from_within(..2);
                continue;
            }
            let (select, legs) = self.pattern(&format!("{slot_name}_point"), &phases);
            let mut chosen = |what: &str, of: fn(&Signed) -> NodeId| {
                [0, 1, 2].map(|c| {
                    let leg = |(i, lagged): &(usize, bool)| (Some(of(&points[*i][c])), *lagged);
                    let nodes: Vec<(Option<NodeId>, bool)> = legs.iter().map(leg).collect();
                    self.b.choose(&format!("{slot_name}_{}_{what}", COORDINATES[c]), select, &nodes)
                })
            };
            let lo = chosen("lo", |x| x.bounds.lo);
            let hi = chosen("hi", |x| x.bounds.hi);
            let sign_cases = chosen("sign_case", |x| x.sign_case);
            let mut args: Vec<NodeId> = (0..3).flat_map(|c| [lo[c], hi[c]]).collect();
            args.extend(l.iter().flat_map(|x| x.bounds.nodes()));
            args.extend(sign_cases);
            args.extend(l.iter().map(|x| x.sign_case));
            args.extend(rounding);
            let out = self.b.instance(&format!("{slot_name}_project"), &shared.projection, &args);
            for node in &out {
                let meaning: Vec<(usize, bool)> =
                    meaningful(jobs).into_iter().filter(|(s, _)| phases[*s].is_some()).collect();
                self.b.probe(*node, meaning);
            }
            results.extend(out);
        }
        match p.projections {
            Projections::All => {}
            Projections::Skip => {
                for (triangle, t) in ["a", "b"].into_iter().enumerate() {
                    for i in 1..3 {
                        let slot = if triangle == 0 { i } else { shared.slots - 1 - i };
                        let values: Vec<Option<usize>> = jobs
                            .iter()
                            .map(|job| job.map(|a| usize::from(i < a.projected(triangle, p.projections).len())))
                            .collect();
                        results.push(self.control(&format!("{name}_{t}_has_{slot}"), &values, 1));
                    }
                }
            }
            Projections::Intersect => {
                for (triangle, t) in ["a", "b"].into_iter().enumerate() {
                    let code = |axis: Axis| match axis.duplicates(triangle) {
                        Duplicates::None => 0,
                        Duplicates::Edge(k) => 1 + k,
                        Duplicates::All => 4,
                    };
                    let values: Vec<Option<usize>> = jobs.iter().map(|job| job.map(code)).collect();
                    results.push(self.control(&format!("{name}_duplicates_{t}"), &values, comparator::DUPLICATE_BITS));
                }
            }
        }
        let out = self.b.instance(&format!("{name}_compare"), &shared.compare, &results);
        self.b.probe(out[0], meaningful(jobs));
        self.b.probe(out[1], meaningful(jobs));
        (out[0], out[1])
    }
}

/// Whether the phase of an axis is a lagged one: in-plane axes in a unit that tests others too.
pub(super) fn lagged(jobs: &[Option<Axis>], axis: &Axis) -> bool {
    axis.in_plane() && !jobs.iter().flatten().all(Axis::in_plane)
}

/// The phases of a unit in which there is an axis, and which of them are lagged.
fn meaningful(jobs: &[Option<Axis>]) -> Vec<(usize, bool)> {
    let phase = |(s, job): (usize, &Option<Axis>)| job.map(|axis| (s, lagged(jobs, &axis)));
    jobs.iter().enumerate().filter_map(phase).collect()
}

/// The units that all axis units share, and their roundings.
struct Shared {
    sign_case: Rc<Unit>,
    cross: Rc<Unit>,
    projection: Rc<Unit>,
    compare: Rc<Unit>,
    axis_roundings: Vec<Rounding>,
    projection_roundings: Vec<Rounding>,
    slots: usize,
}

impl Shared {
    fn new(p: &Params, formats: &Formats, axes: &[Axis]) -> Self {
        let mut axis_roundings = vec![];
        let mut projection_roundings = vec![];
        let (mut left, mut right, mut axis_bound, mut projection_bound) = (0, 0, 0, 0);
        let mut notes: [Vec<String>; 2] = Default::default();
        let coordinate = formats.coordinate_a.format;
        for axis in axes {
            let (e, f) = (factor_row(formats, axis.left), factor_row(formats, axis.right));
            (left, right) = (e.bound.max(left), f.bound.max(right));
            axis_bound = formats.axis(axis.kind).bound.max(axis_bound);
            projection_bound = formats.projection(axis.kind).bound.max(projection_bound);
            let (l, image) = (formats.axis(axis.kind), formats.projection(axis.kind));
            let clamped = l.clamp.map_or(String::new(), |c| format!(", clamped by lemma {}", c.lemma));
            let bounded = |row: &Row| format!("{}, |.| <= {} ulp", row.format, row.bound);
            let (name, e, f) = (l.name, e.format, f.format);
            remember(&mut notes[0], format!("  {name}: {e} x {f} -> {}{clamped}", bounded(l)));
            remember(&mut notes[1], format!("  {}: {coordinate} * {} -> {}", image.name, l.format, bounded(image)));
            remember(&mut axis_roundings, axis_way(formats, axis.kind));
            remember(&mut projection_roundings, projection_way(formats, axis.kind));
        }
        let point = formats.coordinate_a.bound.max(formats.coordinate_b.bound);
        let (bits, upper) = (p.width, p.upper);
        let widest = left.max(right).max(axis_bound).max(point);
        let sign_case = multiply::sign_case_unit(Type::signed(bits, 0), widest);
        let spec = cross_product::Spec {
            bits,
            left,
            right,
            roundings: &axis_roundings,
            upper,
            notes: &notes[0],
            sign_case: &sign_case,
        };
        let cross = cross_product::unit(&spec);
        let roundings = &projection_roundings;
        let spec = projection::Spec { bits, point, axis: axis_bound, roundings, upper, notes: &notes[1] };
        let projection = projection::unit(&spec);
        let count = |a: &Axis| a.projected(0, p.projections).len() + a.projected(1, p.projections).len();
        let slots = axes.iter().map(count).max().unwrap_or(6);
        let compare = comparator::unit(p.width, projection_bound, slots, p.projections);
        Self { sign_case, cross, projection, compare, axis_roundings, projection_roundings, slots }
    }

    fn axis_rounding(&self, formats: &Formats, kind: AxisKind) -> usize {
        let way = axis_way(formats, kind);
        self.axis_roundings.iter().position(|w| *w == way).expect("collected from all kinds")
    }

    fn projection_rounding(&self, formats: &Formats, kind: AxisKind) -> usize {
        let way = projection_way(formats, kind);
        self.projection_roundings.iter().position(|w| *w == way).expect("collected from all kinds")
    }

    /// The point (V0 V1 V2 W0 W1 W2) that projection unit `slot` projects on an axis: A's from the first unit on, B's
    /// from the last one down.
    fn point(&self, axis: &Axis, policy: Projections, slot: usize) -> Option<usize> {
        let (a, b) = (axis.projected(0, policy), axis.projected(1, policy));
        if policy != Projections::Skip {
            return Some(slot);
        }
        let from_last = self.slots - 1 - slot;
        a.get(slot).copied().or_else(|| b.get(from_last).map(|l| 3 + l))
    }
}

/// Adds what is not there yet.
fn remember<T: PartialEq>(all: &mut Vec<T>, one: T) {
    if !all.contains(&one) {
        all.push(one);
    }
}

fn factor_row(formats: &Formats, factor: Factor) -> &Row {
    match factor {
        Factor::EdgeA(k) => &formats.edge_a[k],
        Factor::MinusEdgeA2 => &formats.edge_a[2],
        Factor::EdgeB(_) | Factor::MinusEdgeB2 => &formats.edge_b,
        Factor::NormalA => formats.axis(AxisKind::NormalA),
        Factor::NormalB => formats.axis(AxisKind::NormalB),
    }
}

fn axis_way(formats: &Formats, kind: AxisKind) -> Rounding {
    let (left, right) = match kind {
        AxisKind::NormalA => (Factor::EdgeA(0), Factor::EdgeA(2)),
        AxisKind::NormalB => (Factor::EdgeB(0), Factor::EdgeB(2)),
        AxisKind::Cross(k) => (Factor::EdgeA(k), Factor::EdgeB(0)),
        AxisKind::InPlaneA(k) => (Factor::NormalA, Factor::EdgeA(k)),
        AxisKind::InPlaneB => (Factor::NormalB, Factor::EdgeB(0)),
    };
    let exact = factor_row(formats, left).format.fraction + factor_row(formats, right).format.fraction;
    rounding(exact, formats.axis(kind))
}

fn projection_way(formats: &Formats, kind: AxisKind) -> Rounding {
    let exact = formats.coordinate_a.format.fraction + formats.axis(kind).format.fraction;
    rounding(exact, formats.projection(kind))
}
