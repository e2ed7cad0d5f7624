//! The axes of the data path: which axis each unit tests in which phase, on what operands, and how the flags are held.

use super::axes::{Axis, Duplicates, Factor as Of};
use super::axis_shift::axis_shift;
use super::comparator::{DUPLICATES, Owners, Sides, comparator, pairs};
use super::cross_product::cross_product;
use super::edge_test::{Seen, Side, pierced, seen};
use super::interval::{Factor, Factors, Interval};
use super::projection::projection;
use super::rounding::{Rounding, Roundings, working};
use crate::params::{AxisKind, FormatRow, Formats, Params, Projections};
use efsat_hardware::graph::{Phases, Sig, Signals, Top, Vec3};
use efsat_hardware::op::Type;

/// The edges of both triangles.
pub(super) struct Edges<'l> {
    /// Whether lanes have made them, one after the other.
    pub from_lanes: bool,
    pub a: [Factors<'l>; 3],
    pub b: [Factors<'l>; 3],
}

/// What the axes say, held for the pair and clear for one `outside`.
pub(super) struct Flags<'l> {
    /// Of each axis.
    pub separated: Vec<Sig<'l>>,
    /// Of each axis.
    pub overlapping: Vec<Sig<'l>>,
    /// Whether an edge passes through the other triangle, where that is tested.
    pub pierced: Option<Sig<'l>>,
}

/// All axes.
pub(super) fn axes<'l>(
    u: Top<'l>,
    p: &Params,
    points: &[Factors<'l>; 6],
    edges: &Edges<'l>,
    outside: Option<Sig<'l>>,
) -> Flags<'l> {
    let formats = &p.formats();
    let all = Axis::all(p.axes);
    let units = p.axes_per_clock;
    let tested =
        if edges.from_lanes && all.len() == 11 && units == 1 { Axis::as_edges_come(&all) } else { all.clone() };
    let jobs = |u: usize| {
        let jobs = Phases::new(p.interval(), |s| tested.get(s * units + u).copied());
        // In-plane axes need a finished normal: in a unit that tests others too they come a number of slots later.
        let pure = jobs.busy().all(|(_, axis)| axis.in_plane());
        (jobs.late(|axis| axis.in_plane() && !pure), pure)
    };
    let jobs: Vec<(Phases<Axis>, bool)> = (0..units).map(jobs).collect();
    let stage =
        Tester { u, p, edges, cross: Table::crosses(formats, &all), project: Table::projections(formats, &all) };
    // The normals as the in-plane axes take them: connected when they have been computed.
    let promised = [AxisKind::NormalA, AxisKind::NormalB].map(|kind| {
        let bound = formats.axis(kind).bound;
        let number = || u.later(working(p), (-bound, bound));
        let factor = || Factor {
            interval: Interval { lo: number(), hi: number() },
            sign_case: u.later(Type::unsigned(2), (0, 3)),
        };
        (p.axes.count() > 11).then(|| Vec3::each(|_| factor()))
    });
    let mut l: Vec<Option<Factors<'l>>> = vec![None; units];
    let early = jobs.iter().enumerate().filter(|(_, (_, pure))| !pure);
    for (u, (jobs, _)) in early {
        l[u] = Some(stage.cross(u, jobs, promised));
    }
    let normals = [0, 1].map(|i: usize| {
        let l = l[i % units].expect("normals are tested early");
        (p.axes.count() > 11).then(|| l.capture(i / units, false).named(["n_a", "n_b"][i]))
    });
    for (promised, normal) in promised.signals().into_iter().zip(normals.signals()) {
        promised.connect(normal);
    }
    for (u, (jobs, _)) in jobs.iter().enumerate().filter(|(_, (_, pure))| *pure) {
        l[u] = Some(stage.cross(u, jobs, normals));
    }
    let mut flags: Vec<Option<(Sig<'l>, Sig<'l>)>> = vec![None; all.len()];
    let mut sides: Vec<(Seen, Side<'l>)> = vec![];
    for (u, (jobs, _)) in jobs.iter().enumerate() {
        let image = stage.projected(u, jobs, points, l[u].expect("every unit has axes"));
        let (said, seen) = stage.decide(u, jobs, image);
        sides.extend(seen.iter().flat_map(|seen| stage.sides(jobs, seen)));
        let said = match outside {
            None => said,
            // Section 7 then makes the pair possibly incorrect.
            Some(outside) => {
                let inside = !jobs.map(|_| outside).mux().named_at("axis_outside", u);
                let (separated, overlapping) = (said.0 & inside, said.1 & inside);
                (separated.named_at("axis_counts_separated", u), overlapping.named_at("axis_counts_overlapping", u))
            }
        };
        jobs.capture(&said).for_each(|(axis, said)| flags[axis.index] = Some(said));
    }
    let (separated, overlapping): (Vec<_>, Vec<_>) = flags.into_iter().flatten().unzip();
    let (separated, overlapping) = (separated.named("separated"), overlapping.named("overlapping"));
    let pierced = p.edge_test.then(|| {
        let of = |seen: Seen| sides.iter().find(|side| side.0 == seen).expect("every side is seen on an axis").1;
        let pierced = pierced(of);
        outside.map_or(pierced, |outside| pierced & !outside).named("pierced")
    });
    Flags { separated, overlapping, pierced }
}

/// What all axis units share.
struct Tester<'l, 'a> {
    u: Top<'l>,
    p: &'a Params,
    edges: &'a Edges<'l>,
    cross: Table,
    project: Table,
}

impl<'l> Tester<'l, '_> {
    fn factor(&self, of: Of, normals: [Option<Factors<'l>>; 2]) -> Factors<'l> {
        match of {
            Of::EdgeA(k) => self.edges.a[k],
            Of::EdgeB(l) => self.edges.b[l],
            Of::NormalA => normals[0].expect("17 axes have normals"),
            Of::NormalB => normals[1].expect("17 axes have normals"),
        }
    }

    /// The axes of unit `u`, with their sign cases.
    fn cross(&self, u: usize, jobs: &Phases<Axis>, normals: [Option<Factors<'l>>; 2]) -> Factors<'l> {
        // Sign cases of edges that no lane has made are made behind the choice where those are fewer.
        let cases_behind = !self.edges.from_lanes && self.p.axes_per_clock < 3;
        let chosen = |side: fn(&Axis) -> Of, name: &str| {
            let factor = |axis: &Axis| self.factor(side(axis), normals).map(Factor::mantissa);
            let chosen = jobs.map(factor).mux();
            let chosen =
                if cases_behind { chosen.map(|x| x.interval).named_at(name, u).map(Interval::factor) } else { chosen };
            chosen.named_at(name, u)
        };
        let (e, f) = (chosen(|axis| axis.left, "axis_e"), chosen(|axis| axis.right, "axis_f"));
        let l = if self.p.axis_shift > 0 {
            let exact = cross_product(e, f, None, &self.cross.text).named_at("axis_exact", u);
            axis_shift(self.p, exact)
        } else {
            let roundings = self.cross.roundings(self.u, self.p, jobs, &format!("axis{u}_rounding"));
            cross_product(e, f, Some(&roundings), &self.cross.text)
        };
        let l = l.probe(&jobs.meaning());
        l.map(Interval::factor).named_at("axis_l", u)
    }

    /// How many points an axis unit projects at most.
    fn slots(&self) -> usize {
        let p = self.p;
        let count = |axis: &Axis| axis.projected(0, p.projections).len() + axis.projected(1, p.projections).len();
        Axis::all(p.axes).iter().map(count).max().unwrap_or(6)
    }

    /// The projections of unit `u`.
    fn projected(
        &self,
        u: usize,
        jobs: &Phases<Axis>,
        points: &[Factors<'l>; 6],
        l: Factors<'l>,
    ) -> Vec<Interval<Sig<'l>>> {
        let (p, slots) = (self.p, self.slots());
        let roundings = self.project.roundings(self.u, self.p, jobs, &format!("projection{u}_rounding"));
        let roundings = roundings.of_projections(p, self.project.bits);
        let name = if p.axes_per_clock == 1 { "p".to_owned() } else { format!("axis{u}_p") };
        let mut image: Vec<Interval<Sig<'l>>> = vec![];
        for slot in 0..slots {
            let point = jobs.filter_map(|axis| projected(axis, p.projections, slot, slots));
            if point.idle() {
                // No axis of this unit projects so many points: the comparator is told to ignore the projection.
                image.push(image[0]);
                continue;
            }
            let v = point.map(|i| points[*i]).mux().named_at(&format!("axis{u}_v"), slot);
            let meaning = point.meaning();
            image.push(projection(p, v, l, &roundings, &self.project.text).named_at(&name, slot).probe(&meaning));
        }
        image
    }

    /// Where the vertices and edges certainly are that the axes of a unit tell of.
    fn sides(&self, jobs: &Phases<Axis>, [above, below]: &Sides<'l>) -> Vec<(Seen, Side<'l>)> {
        let (p, slots) = (self.p, self.slots());
        let slot = |axis: &Axis, point: usize| {
            (0..slots)
                .find(|slot| projected(axis, p.projections, *slot, slots) == Some(point))
                .expect("it is projected")
        };
        let seen_in = |axis: &Axis, pair: [usize; 2]| {
            let mut seen = seen(axis).into_iter();
            seen.find(|(_, [i, j])| [slot(axis, *i), slot(axis, 3 + j)] == pair).map(|(seen, _)| seen)
        };
        let mut sides = vec![];
        for (pair, (above, below)) in pairs(slots).zip(above.iter().zip(below)) {
            let jobs = jobs.filter_map(|axis| seen_in(axis, pair));
            sides.extend(jobs.capture(&[*above, *below]).map(|(seen, side)| (*seen, side)));
        }
        sides
    }

    /// Comparators of unit `u`.
    fn decide(
        &self,
        u: usize,
        jobs: &Phases<Axis>,
        image: Vec<Interval<Sig<'l>>>,
    ) -> ((Sig<'l>, Sig<'l>), Option<Sides<'l>>) {
        let (p, unit) = (self.p, self.u);
        let flag = |triangle: usize, i: usize| {
            let has = jobs.map(|axis| i128::from(i < axis.projected(triangle, p.projections).len()));
            has.constant(unit, Type::FLAG).named(&format!("axis{u}_has_{}{i}", ["a", "b"][triangle]))
        };
        let code = |triangle: usize| {
            let code = jobs.map(|axis| match axis.duplicates(triangle) {
                Duplicates::None => 0,
                Duplicates::Edge(k) => 1 + k as i128,
                Duplicates::All => 4,
            });
            code.constant(unit, DUPLICATES).named(&format!("axis{u}_duplicates_{}", ["a", "b"][triangle]))
        };
        let owners = match p.projections {
            Projections::All => Owners::Fixed,
            Projections::Skip => Owners::Shared([0, 1].map(|t| vec![flag(t, 1), flag(t, 2)])),
            Projections::Intersect => Owners::Intersected([code(0), code(1)]),
        };
        let ((separated, overlapping), sides) = comparator(image, owners, p.edge_test);
        let separated = separated.named_at("axis_separated", u).probe(&jobs.meaning());
        let overlapping = overlapping.named_at("axis_overlapping", u).probe(&jobs.meaning());
        let sides = sides
            .map(|[above, below]| [above.named(&format!("axis{u}_above")), below.named(&format!("axis{u}_below"))]);
        ((separated, overlapping), sides)
    }
}

/// The point (V0 V1 V2 W0 W1 W2) that a projection unit projects on an axis: A's from the first unit on, B's from the last
/// one down.
fn projected(axis: &Axis, policy: Projections, slot: usize, slots: usize) -> Option<usize> {
    if policy != Projections::Skip {
        return Some(slot);
    }
    let (a, b) = (axis.projected(0, policy), axis.projected(1, policy));
    a.get(slot).copied().or_else(|| b.get(slots - 1 - slot).map(|l| 3 + l))
}

/// The roundings of a unit by kind of axis, and its formats in words.
struct Table {
    ways: Vec<(AxisKind, Rounding)>,
    /// Bits of the widest result.
    bits: u32,
    text: Vec<String>,
}

impl Table {
    fn crosses(formats: &Formats, axes: &[Axis]) -> Self {
        let row = |axis: &Axis| {
            let (e, f) = (row_of(formats, axis.left), row_of(formats, axis.right));
            let l = formats.axis(axis.kind);
            (e.format.fraction + f.format.fraction, l, [e.format.to_string(), f.format.to_string()])
        };
        Self::new(axes, ["e", "f", "l"], row)
    }

    fn projections(formats: &Formats, axes: &[Axis]) -> Self {
        let row = |axis: &Axis| {
            let (v, l) = (formats.coordinate_a.format, formats.axis(axis.kind).format);
            (v.fraction + l.fraction, formats.projection(axis.kind), [v.to_string(), l.to_string()])
        };
        Self::new(axes, ["v", "l", "p"], row)
    }

    /// `row` gives the exact fraction bits, the row of the result and the formats of the operands.
    fn new<'f>(axes: &[Axis], names: [&str; 3], row: impl Fn(&Axis) -> (i32, &'f FormatRow, [String; 2])) -> Self {
        let [e, f, l] = names;
        let mut text = vec![format!("  {:<12} {e:<7} {f:<7} {l:<7} {:<10} rounding", "axis", format!("|{l}| <="))];
        let mut ways: Vec<(AxisKind, Rounding)> = vec![];
        let mut bits = 0;
        for axis in axes {
            let (fraction, to, [e, f]) = row(axis);
            let way = Rounding::to_row(fraction, to);
            bits = bits.max(to.format.bits);
            if ways.iter().any(|w| w.0 == axis.kind) {
                continue;
            }
            ways.push((axis.kind, way));
            let cut = match way.drop {
                drop if drop > 0 => format!("{drop} bits dropped"),
                0 => "exact".to_owned(),
                drop => format!("{} zeros appended", -drop),
            };
            let saturated =
                way.saturate.map_or(String::new(), |(bound, lemma)| format!(", within +-{bound}: lemma {lemma}"));
            let (format, bound) = (to.format.to_string(), to.bound);
            text.push(format!("  {:<12} {e:<7} {f:<7} {format:<7} {bound:<10} {cut}{saturated}", kind_name(axis.kind)));
        }
        Self { ways, bits, text }
    }

    fn way(&self, kind: AxisKind) -> Rounding {
        self.ways.iter().find(|w| w.0 == kind).expect("collected from all axes").1
    }

    fn roundings<'l>(&self, u: Top<'l>, p: &Params, jobs: &Phases<Axis>, name: &str) -> Roundings<'l> {
        let all: Vec<Rounding> = self.ways.iter().map(|w| w.1).collect();
        Roundings::by_phase(p, &all, &jobs.map(|axis| self.way(axis.kind)), u, name)
    }
}

/// What the axes of a kind are called.
fn kind_name(kind: AxisKind) -> String {
    match kind {
        AxisKind::NormalA => "n_a".to_owned(),
        AxisKind::NormalB => "n_b".to_owned(),
        AxisKind::Cross(k) => format!("c_{k}0 to c_{k}2"),
        AxisKind::InPlaneA(k) => format!("n_a x e_a{k}"),
        AxisKind::InPlaneB => "n_b x e_b".to_owned(),
    }
}

fn row_of(formats: &Formats, factor: Of) -> &FormatRow {
    match factor {
        Of::EdgeA(k) => &formats.edge_a[k],
        Of::EdgeB(_) => &formats.edge_b,
        Of::NormalA => formats.axis(AxisKind::NormalA),
        Of::NormalB => formats.axis(AxisKind::NormalB),
    }
}
