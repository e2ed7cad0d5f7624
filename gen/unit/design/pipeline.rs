//! The data path of one pair: which unit works on what in which phase of the slot.
//!
//! Transform rows, re-normalisation lanes and axis units are shared over the phases. In phase s, transform unit r computes
//! row `s * rows + r` (vertex by vertex), a lane re-normalises one point, and axis unit u tests axis `s * units + u`, in the
//! order of the contract or in that in which [edges come](super::axes::Axis::as_edges_come). Where
//! there is a [guard](super::guard), numbers pass it on their way to the first unit.

use super::guard::{Guards, any};
use super::interval::{Factor, Factors, Interval, Vector};
use super::number::Number;
use super::product::multiplier;
use super::renormalise;
use super::rounding::{Rounding, Roundings};
use super::tested_axes::{self, Edges, Flags};
use super::transform_row::{transform_row, translate_row};
use crate::params::{FormatRow, Formats, Params, Transform};
use efsat_hardware::graph::{Block, Library, Phases, Sig, Signals, Top, Vec3};
use efsat_hardware::op::Type;
use std::rc::Rc;

/// A point as it comes from the host.
type Point<'l> = Vec3<Number<Sig<'l>>>;

/// The data path for a parameter set. Its inputs are the pair and its pose, held for the slot; its outputs are
/// `verdict`, `separated` and `overlapping` (bit i: axis i), and `outside` where there is a guard.
pub fn unit(p: &Params) -> Rc<Block> {
    let doc = [
        "The data path of one pair: frame transform, re-normalisation, axes, verdict. Units are shared over the phases of",
        "the slot; a bound at a port covers all uses of the unit. A value captured for the pair is named after what it is;",
        "later copies end in _h<clocks>, or are elements of x_held.",
    ];
    Library::default().with_multiplier(multiplier(p)).block("pair_pipeline", &doc, p.interval(), |u| {
        let path = Path { u, p, formats: p.formats(), guards: Guards::new(u, p) };
        let Inputs { v, w, pose } = Inputs::new(u, p);
        let doc = ["Section 3: B's vertices in A's frame."];
        let b = pose.map(|pose| u.section("pair_transform", &doc, || path.transformed(&w, &pose)));
        let doc = ["Section 4: the points at working width, and the edges."];
        let (points, edges) = u.section("pair_points", &doc, || path.working(&v, &w, b.as_ref()));
        let outside = path.guards.outside();
        let doc = ["Sections 5 and 6: the axes, and what each of them says."];
        let flags = u.section("pair_axes", &doc, || tested_axes::axes(u, p, &points, &edges, outside));
        let Flags { separated, overlapping, pierced } = flags;
        // Section 7.
        let separate = any(&separated).named("separate");
        let surely = (!(!overlapping[0].below(&overlapping[1..11])).any()).named("all_overlap");
        let surely = pierced.map_or(surely, |pierced| surely | pierced).named("surely");
        let not_separate = (!separate).named("not_separate");
        let (intersect, unknown) = (not_separate & surely, not_separate & !surely);
        let verdict = intersect.below(&[unknown]).named("verdict");
        let verdict = verdict.comment("00 separate, 01 intersect, 10 possibly incorrect");
        ((verdict, outside), (separated, overlapping))
    })
}

/// The pose of B: rows of M, t, and whether both are left out.
pub(super) struct Pose<'l> {
    pub m: Option<[Point<'l>; 3]>,
    pub t: Point<'l>,
    pub bypass: Sig<'l>,
}

/// What the unit is given: vertices of both triangles, and the pose.
pub(super) struct Inputs<'l> {
    pub v: [Point<'l>; 3],
    pub w: [Point<'l>; 3],
    pub pose: Option<Pose<'l>>,
}

impl<'l> Inputs<'l> {
    pub fn new(u: Top<'l>, p: &Params) -> Self {
        let point = |bound: i128| Vec3::each(|_| Number::input(u, p, bound));
        let triangle = |name| [(); 3].map(|()| point(p.coordinate_bound())).named(name);
        let (v, w) = (triangle("in_v"), triangle("in_w"));
        let pose = (p.transform != Transform::Off).then(|| Pose {
            m: (p.transform == Transform::On).then(|| [(); 3].map(|()| point(p.one())).named("pose_m")),
            t: point(p.translation_bound()).named("pose_t"),
            bypass: u.input(Type::FLAG, (0, 1)).named("pose_bypass"),
        });
        Self { v, w, pose }
    }
}

/// A point before re-normalisation: an input, or one of B after the transform.
#[derive(Clone, Copy)]
enum Source<'l> {
    Input(Point<'l>),
    Transformed(Vector<'l>),
}

impl<'l> Source<'l> {
    fn input(&self) -> Option<Point<'l>> {
        match self {
            Self::Input(x) => Some(*x),
            Self::Transformed(_) => None,
        }
    }

    fn transformed(&self) -> Option<Vector<'l>> {
        match self {
            Self::Input(_) => None,
            Self::Transformed(x) => Some(*x),
        }
    }

    fn lower(&self) -> Vec3<Sig<'l>> {
        match self {
            Self::Input(x) => x.map(|n| n.lo),
            Self::Transformed(x) => x.map(|n| n.lo),
        }
    }
}

/// The data path in the making.
struct Path<'l, 'p> {
    u: Top<'l>,
    p: &'p Params,
    formats: Formats,
    guards: Guards<'l, 'p>,
}

impl<'l> Path<'l, '_> {
    /// Section 3: B's vertices in A's frame.
    fn transformed(&self, w: &[Point<'l>; 3], pose: &Pose<'l>) -> [Vector<'l>; 3] {
        let (p, units) = (self.p, self.p.transform_rows());
        let mut b: [Option<Interval<Sig<'l>>>; 9] = [None; 9];
        for r in 0..units {
            let rows = Phases::new(p.interval(), |s| Some(s * units + r).filter(|row| *row < 9));
            if rows.idle() {
                continue;
            }
            let busy = rows.marks();
            let bypass = rows.map(|_| pose.bypass).mux().named_at("row_bypass", r);
            let guarded = |number: Number<Sig<'l>>, bound, name: &str| {
                self.guards.guarded([number], bound, &busy, (name, None))[0]
            };
            // With the bypass t is 0.
            let t = rows.map(|row| pose.t[row % 3]).mux().named_at("row_t_pose", r);
            let t = or_else(bypass, None, t).named_at("row_t", r);
            let t = guarded(t, p.translation_bound(), &format!("row{r}_t"));
            let row = match &pose.m {
                Some(m) => {
                    let entries = rows.map(|row| m[row % 3]).mux().named_at("row_m_pose", r);
                    // With the bypass M is the identity.
                    let diagonal = |j: usize| rows.map(|row| i128::from(row % 3 == j)).constant(self.u, Type::FLAG);
                    let diagonal = Vec3::each(diagonal).named_at("row_diagonal", r);
                    let entry = |j: usize| {
                        let lo = entries[j].lo;
                        or_else(bypass, Some(diagonal[j].choose(lo.like(p.one()), lo.like(0))), entries[j])
                    };
                    let m = Vec3::each(entry).named_at("row_m", r);
                    let m = Vec3(self.guards.guarded(m.0, p.one(), &busy, (&format!("row{r}_m"), None)));
                    let x = rows.map(|row| w[row / 3]).mux().named_at("row_x", r);
                    let x = Vec3(self.guards.guarded(x.0, p.coordinate_bound(), &busy, (&format!("row{r}_x"), None)));
                    transform_row(p, m, x, t, bypass)
                }
                None => {
                    let x = rows.map(|row| w[row / 3][row % 3]).mux().named_at("row_x", r);
                    translate_row(p, guarded(x, p.coordinate_bound(), &format!("row{r}_x")), t, bypass)
                }
            };
            let row = row.named_at("row", r);
            rows.capture(&row).for_each(|(row, value)| b[*row] = Some(value));
        }
        let of = |row: usize| b[row].expect("every row is computed");
        let b = [0, 1, 2].map(|k| Vec3::each(|i| of(3 * k + i)));
        b.named("b").comment("B's vertices in A's frame").probe(&[(0, false)])
    }

    /// Section 4: the points at working width, and the edges.
    fn working(
        &self,
        v: &[Point<'l>; 3],
        w: &[Point<'l>; 3],
        b: Option<&[Vector<'l>; 3]>,
    ) -> ([Factors<'l>; 6], Edges<'l>) {
        let mut sources = v.map(Source::Input).to_vec();
        match b {
            Some(b) => sources.extend(b.map(Source::Transformed)),
            None => sources.extend(w.map(Source::Input)),
        }
        let (points, streamed) = if self.p.renormalise { self.renormalised(sources) } else { self.rounded(&sources) };
        let probed =
            |x: [Factors<'l>; 3], name: &str| x.each(|_, signal| signal).named(name).map(|x| x.probe(&[(0, false)]));
        let [v0, v1, v2, w0, w1, w2] = points;
        let (v, w) = (probed([v0, v1, v2], "v"), probed([w0, w1, w2], "w"));
        let direct = |triangle: usize, k: usize, x: &[Factors<'l>; 3]| {
            let known = streamed.iter().find(|(edge, _)| *edge == (triangle, k)).map(|(_, edge)| *edge);
            known.unwrap_or_else(|| {
                let (from, to) = (x[k].map(|x| x.interval), x[(k + 1) % 3].map(|x| x.interval));
                let (way, lemma) = self.edge_format(triangle, k);
                let exact = to - from;
                let exact = lemma.map_or(exact, |bound| exact.assume(bound, "anchored-edge"));
                let ty = Type::signed(self.p.width, self.grid() - way.drop);
                let roundings = Roundings::one(way, self.p.upper, ty);
                exact.map(|x| x.round_outward(&roundings).factor())
            })
        };
        let a = probed([0, 1, 2].map(|k| direct(0, k, &v)), "e_a");
        let b = probed([0, 1, 2].map(|k| direct(1, k, &w)), "e_b");
        ([v[0], v[1], v[2], w[0], w[1], w[2]], Edges { from_lanes: !streamed.is_empty(), a, b })
    }

    /// Fraction bits of the coordinates.
    fn grid(&self) -> i32 {
        self.formats.coordinate_a.format.fraction
    }

    /// The rounding of edge `k` of a triangle, and where re-normalisation bounds it by the lemma anchored-edge, that bound.
    fn edge_format(&self, triangle: usize, k: usize) -> (Rounding, Option<i128>) {
        let row: &FormatRow = if triangle == 0 { &self.formats.edge_a[k] } else { &self.formats.edge_b };
        let anchored = self.p.renormalise && triangle == 0 && k != 1;
        (Rounding::to_row(self.grid(), row), anchored.then(|| (1 << self.grid()) + 1))
    }

    /// Without re-normalisation: every point rounded by itself.
    fn rounded(&self, sources: &[Source<'l>]) -> ([Factors<'l>; 6], Vec<Streamed<'l>>) {
        let bound = self.p.coordinate_bound();
        let point = |i: usize| {
            let point = match &sources[i] {
                Source::Transformed(point) => *point,
                Source::Input(x) => {
                    let name = if i < 3 { ("in_v", Some(i)) } else { ("in_w", Some(i - 3)) };
                    Vec3(self.guards.guarded(x.0, bound, &[], name)).map(|x| x.declared(bound))
                }
            };
            renormalise::round(self.p, point).map(Interval::factor)
        };
        (std::array::from_fn(point), vec![])
    }

    /// Re-normalised points, and the edges between points that follow each other in a lane.
    fn renormalised(&self, mut sources: Vec<Source<'l>>) -> ([Factors<'l>; 6], Vec<Streamed<'l>>) {
        let (p, bound) = (self.p, self.p.coordinate_bound());
        let v0 = sources[0].input().expect("A is never transformed");
        // All others are taken relative to V0, so it has a guard of its own.
        let v0 = Vec3(self.guards.guarded(v0.0, bound, &[], ("in_v0", None)));
        sources[0] = Source::Input(v0);
        let origin = v0.map(|x| x.lo);
        let lanes = lanes(p.interval());
        let mut offsets = vec![];
        let mut magnitudes = vec![];
        for (j, jobs) in lanes.iter().enumerate() {
            let point = self.lane(jobs, &sources, j).named_at("lane", j);
            let (offset, magnitude) = renormalise::offset(p, point, origin);
            offsets.push(offset.named_at("offset", j));
            magnitudes.push(magnitude.named_at("magnitude", j));
        }
        // A vertex that comes once more adds nothing to the word.
        let first_of = |i: usize| lanes.iter().filter_map(|jobs| jobs.busy().find(|(_, point)| **point == i)).next();
        let last = (0..6).filter_map(|i| first_of(i).map(|(s, _)| s)).max().unwrap_or(0);
        let word = Vec3::each(|c| magnitudes.iter().map(|m| m[c]).reduce(|a, b| a | b).expect("a lane has points"));
        let word = if p.interval() > 1 {
            let first = Phases::new(p.interval(), |s| Some(i128::from(s == 0))).constant(self.u, Type::FLAG);
            word.map(|word| word.or_over_phases(first)).named("magnitude_so_far")
        } else {
            word
        };
        let word = word.capture(last, false).named("magnitudes").comment("OR of the magnitudes of the twelve bounds");
        let shift = word.map(|word| renormalise::leading_zeros(p, word)).named("shift");
        let mut points: [Option<Factors<'l>>; 6] = [None; 6];
        let mut edges = vec![];
        for (j, jobs) in lanes.iter().enumerate() {
            let scaled = renormalise::scale(p, offsets[j], shift.clone()).named_at("scaled", j);
            let factors = scaled.map(Interval::factor).named_at("scaled", j);
            for (point, value) in jobs.capture(&factors) {
                points[*point].get_or_insert(value);
            }
            self.stream_edges(jobs, scaled, j, &mut edges);
        }
        let mut points = points.map(|point| point.expect("every point is in a lane"));
        // V0 is taken relative to its own lower bounds.
        points[0] = points[0].map(|x| {
            let zero = self.u.element(0, x.interval.lo.ty());
            let sign_case = self.u.element(0, x.sign_case.ty());
            Factor { interval: Interval { lo: zero, hi: x.interval.hi }, sign_case }
        });
        (points, edges)
    }

    /// The operand of a lane in each phase. Of inputs the upper bounds are made behind the multiplexer.
    fn lane(&self, jobs: &Phases<usize>, sources: &[Source<'l>], j: usize) -> Vector<'l> {
        let (inputs, transformed) =
            (jobs.filter_map(|i| sources[*i].input()), jobs.filter_map(|i| sources[*i].transformed()));
        if inputs.idle() {
            return transformed.mux();
        }
        let is_input = |i: &usize| i128::from(sources[*i].input().is_some());
        let from_input = jobs.map(is_input).constant(self.u, Type::FLAG).named_at("lane_from_input", j);
        if transformed.idle() || self.p.guarded() {
            let point = inputs.mux().named_at("lane_input", j);
            // V0 alone has passed its guard.
            let alone = jobs.busy().all(|(_, i)| *i == 0);
            let bound = self.p.coordinate_bound();
            let guarded = || Vec3(self.guards.guarded(point.0, bound, &inputs.marks(), ("lane_input", Some(j))));
            let point = if alone { point } else { guarded() }.map(|x| x.declared(bound));
            return if transformed.idle() { point } else { from_input.choose(point, transformed.mux()) };
        }
        let lo = jobs.map(|i| sources[*i].lower()).mux().named_at("lane_lower", j);
        let sticky = inputs.map(|point| point.map(|x| x.sticky)).mux();
        let upper = transformed.map(|point| point.map(|x| x.hi)).mux();
        let ulp = lo.zip(sticky, |lo, sticky| from_input & Number { lo, sticky }.inexact());
        let hi = lo.zip(upper, |lo, upper| from_input.choose(lo, upper)).zip(ulp, |hi, ulp| (hi + ulp).resize(hi.ty()));
        lo.zip(hi, |lo, hi| Interval { lo, hi })
    }

    /// The edges between neighbours in a lane: `e_k = X_(k+1) - X_k` (equation 1).
    fn stream_edges(&self, jobs: &Phases<usize>, scaled: Vector<'l>, j: usize, edges: &mut Vec<Streamed<'l>>) {
        let mut before = None;
        let streamed = Phases::new(self.p.interval(), |s| {
            let (from, to) = (before, jobs.get(s).copied());
            before = to;
            let (from, to) = (from?, to?);
            let follows = from / 3 == to / 3 && (from + 1) % 3 == to % 3;
            follows.then_some((from / 3, from % 3))
        });
        // Only lanes that take a triangle around stream its edges.
        if streamed.busy().count() < 3 {
            return;
        }
        // In idle phases, where any two points may meet, as for an edge of which nothing is known.
        let ways = Phases::new(self.p.interval(), |s| {
            let (triangle, k) = streamed.get(s).copied().unwrap_or((0, 1));
            Some(self.edge_format(triangle, k).0)
        });
        let all: Vec<Rounding> = ways.busy().map(|(_, way)| *way).collect();
        let anchored = streamed.map(|(triangle, k)| self.edge_format(*triangle, *k).1);
        let marks: Vec<bool> = (0..self.p.interval()).map(|s| anchored.get(s).is_some_and(Option::is_some)).collect();
        let exact = (scaled - scaled.earlier(1)).named_at("lane_difference", j);
        let bound = (1 << self.grid()) + 1;
        let exact = if marks.contains(&true) { exact.assume_in(&marks, bound, "anchored-edge") } else { exact };
        let roundings = Roundings::by_phase(self.p, &all, &ways, self.u, "lane_edge_rounding");
        let edge = exact.map(|x| x.round_outward(&roundings)).named_at("lane_edge", j);
        let factors = edge.map(Interval::factor).named_at("lane_edge", j);
        edges.extend(streamed.capture(&factors).map(|(edge, value)| (*edge, value)));
    }
}

/// An edge by triangle and number.
type Streamed<'l> = ((usize, usize), Factors<'l>);

/// The points that each lane takes, phase by phase: V0 V1 V2 W0 W1 W2. Where there is time a triangle's first vertex
/// comes once more behind its last, so that the edges can be formed on the way.
fn lanes(interval: usize) -> Vec<Phases<usize>> {
    let lists: Vec<Vec<usize>> = match interval {
        8.. => vec![vec![0, 1, 2, 0, 3, 4, 5, 3]],
        6 | 7 => vec![vec![0, 1, 2, 3, 4, 5]],
        4 | 5 => vec![vec![0, 1, 2, 0], vec![3, 4, 5, 3]],
        _ => {
            let lanes = 6usize.div_ceil(interval);
            (0..lanes).map(|j| (j..6).step_by(lanes).collect()).collect()
        }
    };
    lists.into_iter().map(|list| Phases::new(interval, |s| list.get(s).copied())).collect()
}

/// The number, or with the flag set an exact one: another, or 0.
fn or_else<'l>(flag: Sig<'l>, exact: Option<Sig<'l>>, number: Number<Sig<'l>>) -> Number<Sig<'l>> {
    let lo = flag.choose(exact.unwrap_or_else(|| number.lo.like(0)), number.lo);
    Number { lo, sticky: number.sticky.map(|sticky| !flag & sticky) }
}
