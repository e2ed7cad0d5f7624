//! The data path of one pair: which unit works on what in which phase of the slot.
//!
//! Transform rows, re-normalisation lanes and axis units are shared over the phases; everything here is said with
//! [`Builder::choose`] and [`Builder::hold`], the schedule finds the clocks. In phase s, transform unit r computes row
//! `s * rows + r` (vertex by vertex), lane j re-normalises point `s * lanes + j` (V0 V1 V2 W0 W1 W2) and axis unit u
//! tests axis `s * units + u`. Where there is a [guard](super::guard), numbers pass it on their way to the first unit.

use super::cross_product::{COORDINATES, select_bits};
use super::guard::Guards;
use super::interval::{self, Bounds, Narrowing, Rounding, symmetric};
use super::renormalise;
use super::transform_row::{self, Quantised};
use crate::params::{Formats, Params, Row, Transform};
use efsat_hardware::graph::{Builder, NodeId, Op, Rate, Type, Unit};
use std::rc::Rc;

/// The coordinates of a point, or the components of a vector.
pub(super) type Point = [Bounds; 3];

/// The data path for a parameter set. Its inputs are the pair and its pose, held for the slot; its outputs are
/// `verdict`, `separated` and `overlapping` (bit i: axis i), and `outside` where there is a guard.
pub fn unit(p: &Params) -> Rc<Unit> {
    let interval = p.interval();
    let b = Builder::new(
        "pair_pipeline",
        interval,
        &[
            "The data path of one pair: frame transform, re-normalisation, axes, verdict. Units are shared over the",
            "phases of the slot; a value held for the pair is named after the node, its later copies end in _h<clocks>.",
        ],
    );
    let mut path = Pipeline { b, p, formats: p.formats(), interval, guards: Guards::default() };
    let (v, w, pose) = path.inputs();
    let (points, is_a) = path.transformed(&v, &w, pose);
    let points = path.working_points(&points, &is_a);
    let edges = path.edges(&points);
    let outside = path.outside();
    let flags = path.axes(&points, &edges, outside);
    path.verdict(&flags);
    if let Some(outside) = outside {
        path.b.output("outside", outside);
    }
    path.b.finish()
}

struct Pose {
    m: Vec<Vec<Quantised>>,
    t: Vec<Quantised>,
    bypass: NodeId,
}

/// A point before re-normalisation: lower bounds, and upper bounds where they exist apart (B after the transform).
#[derive(Clone)]
pub(super) enum Source {
    Input([Quantised; 3]),
    Transformed(Point),
}

impl Source {
    /// Coordinate `c` of an input.
    pub(super) fn input(&self, c: usize) -> Option<Quantised> {
        match self {
            Self::Input(x) => Some(x[c]),
            Self::Transformed(_) => None,
        }
    }

    /// Coordinate `c` of a transformed point.
    pub(super) fn transformed(&self, c: usize) -> Option<Bounds> {
        match self {
            Self::Input(_) => None,
            Self::Transformed(x) => Some(x[c]),
        }
    }
}

/// The edges of both triangles, and the two negated ones that the normals take.
pub(super) struct Edges {
    pub(super) a: [Point; 3],
    pub(super) b: [Point; 3],
    pub(super) minus_a2: Point,
    pub(super) minus_b2: Point,
}

/// What every axis says, held for the pair.
pub(super) struct Flags {
    pub(super) separated: Vec<NodeId>,
    pub(super) overlapping: Vec<NodeId>,
}

/// The data path in the making.
pub(super) struct Pipeline<'a> {
    pub(super) b: Builder,
    pub(super) p: &'a Params,
    pub(super) formats: Formats,
    pub(super) interval: usize,
    pub(super) guards: Guards,
}

impl Pipeline<'_> {
    fn inputs(&mut self) -> (Vec<[Quantised; 3]>, Vec<[Quantised; 3]>, Option<Pose>) {
        let p = self.p;
        let mut number = |name: String, bound| {
            if p.guarded() {
                Quantised::word(&mut self.b, &name, p, Rate::Pair)
            } else {
                Quantised::input(&mut self.b, &name, p, bound, Rate::Pair)
            }
        };
        let mut triangle = |name: &str| -> Vec<[Quantised; 3]> {
            (0..3).map(|k| COORDINATES.map(|c| number(format!("{name}{k}_{c}"), p.coordinate_bound()))).collect()
        };
        let v = triangle("in_v");
        let w = triangle("in_w");
        if p.transform == Transform::Off {
            return (v, w, None);
        }
        let rows = if p.transform == Transform::On { 3 } else { 0 };
        let m = (0..rows).map(|i| (0..3).map(|j| number(format!("pose_m{i}{j}"), p.one())).collect()).collect();
        let t = COORDINATES.iter().map(|c| number(format!("pose_t_{c}"), p.translation_bound())).collect();
        let bypass = self.b.input("pose_bypass", Type::FLAG, (0, 1), Rate::Pair);
        (v, w, Some(Pose { m, t, bypass }))
    }

    /// A select pattern and the legs it chooses among, from the leg of each phase.
    pub(super) fn pattern<T: PartialEq + Copy>(&mut self, name: &str, phases: &[Option<T>]) -> (NodeId, Vec<T>) {
        let mut legs: Vec<T> = vec![];
        let values = phases
            .iter()
            .map(|leg| {
                leg.map(|leg| {
                    let known = legs.iter().position(|l| *l == leg);
                    known.unwrap_or_else(|| {
                        legs.push(leg);
                        legs.len() - 1
                    }) as i128
                })
            })
            .collect();
        let ty = Type::unsigned(select_bits(legs.len()));
        (self.b.phase(name, values, ty), legs)
    }

    /// A constant of each phase. Idle phases repeat the first busy one, as the operands of idle phases do, so that what
    /// a unit computes there is in range too.
    pub(super) fn control(&mut self, name: &str, values: &[Option<usize>], bits: u32) -> NodeId {
        let first = values.iter().flatten().next().copied();
        let values = values.iter().map(|v| v.or(first).map(|v| v as i128)).collect();
        self.b.phase(name, values, Type::unsigned(bits))
    }

    /// Section 3: all six points in A's frame; the flags say which still are inputs.
    fn transformed(
        &mut self,
        v: &[[Quantised; 3]],
        w: &[[Quantised; 3]],
        pose: Option<Pose>,
    ) -> (Vec<Source>, Vec<bool>) {
        let mut points: Vec<Source> = v.iter().map(|x| Source::Input(*x)).collect();
        let Some(pose) = pose else {
            points.extend(w.iter().map(|x| Source::Input(*x)));
            return (points, vec![true; 6]);
        };
        let units = self.p.transform_rows();
        let row = transform_row::unit(self.p);
        let mut results: Vec<Vec<Option<Bounds>>> = vec![vec![None; 3]; 3];
        for r in 0..units {
            let jobs: Vec<Option<usize>> =
                (0..self.interval).map(|s| Some(s * units + r).filter(|index| *index < 9)).collect();
            if jobs.iter().all(Option::is_none) {
                continue;
            }
            let name = format!("row_{r}");
            let (vertex, vertices) =
                self.pattern(&format!("{name}_vertex"), &jobs.iter().map(|j| j.map(|j| j / 3)).collect::<Vec<_>>());
            let (component, components) =
                self.pattern(&format!("{name}_component"), &jobs.iter().map(|j| j.map(|j| j % 3)).collect::<Vec<_>>());
            let mut args: Vec<NodeId> = vec![];
            let busy: Vec<bool> = jobs.iter().map(Option::is_some).collect();
            let mut take = |path: &mut Self, name: String, select, numbers: Vec<Quantised>, bound| {
                let chosen = path.chosen(&name, select, &numbers);
                args.extend(path.guarded(&name, chosen, bound, &busy).nodes());
            };
            let (coordinate, translation) = (self.p.coordinate_bound(), self.p.translation_bound());
            if self.p.transform == Transform::On {
                for j in 0..3 {
                    let column = components.iter().map(|i| pose.m[*i][j]).collect();
                    take(self, format!("{name}_m{j}"), component, column, self.p.one());
                }
                for j in [0, 1, 2] {
                    let column = vertices.iter().map(|k| w[*k][j]).collect();
                    take(self, format!("{name}_x{j}"), vertex, column, coordinate);
                }
            } else {
                let (job, coordinates) = self.pattern(&format!("{name}_job"), &jobs);
                let column = coordinates.iter().map(|j| w[j / 3][j % 3]).collect();
                take(self, format!("{name}_x0"), job, column, coordinate);
            }
            let column = components.iter().map(|i| pose.t[*i]).collect();
            take(self, format!("{name}_t"), component, column, translation);
            args.push(self.b.broadcast(&format!("{name}_bypass"), pose.bypass));
            let outputs = self.b.instance(&name, &row, &args);
            for (s, job) in jobs.iter().enumerate() {
                let Some(job) = job else { continue };
                let (k, c) = (job / 3, COORDINATES[job % 3]);
                let lo = self.b.hold(&format!("b{k}_{c}_lo"), outputs[0], s, false);
                let hi = self.b.hold(&format!("b{k}_{c}_hi"), outputs[1], s, false);
                self.b.comment(lo, format!("B's vertex {k} in A's frame, {c}"));
                self.b.probe(lo, vec![(0, false)]);
                self.b.probe(hi, vec![(0, false)]);
                results[k][job % 3] = Some(Bounds { lo, hi });
            }
        }
        for vertex in results {
            let done: Vec<Bounds> = vertex.into_iter().flatten().collect();
            points.push(Source::Transformed([done[0], done[1], done[2]]));
        }
        (points, [true, true, true, false, false, false].to_vec())
    }

    /// The number that a pattern chooses in each phase.
    pub(super) fn chosen(&mut self, name: &str, select: NodeId, numbers: &[Quantised]) -> Quantised {
        let mut part = |name: &str, part: usize| {
            let legs: Vec<(Option<NodeId>, bool)> =
                numbers.iter().filter_map(|n| n.nodes().nth(part)).map(|n| (Some(n), false)).collect();
            (!legs.is_empty()).then(|| self.b.choose(name, select, &legs))
        };
        let lo = part(name, 0).expect("a number has a lower bound");
        Quantised { lo, sticky: part(&format!("{name}_sticky"), 1), bound: None }
    }

    /// Section 4: the points at working width.
    fn working_points(&mut self, points: &[Source], is_input: &[bool]) -> Vec<Point> {
        let p = self.p;
        let names = ["v0", "v1", "v2", "w0", "w1", "w2"];
        if !p.renormalise {
            let unit = renormalise::round_unit(p);
            let mut working = vec![];
            for (i, source) in points.iter().enumerate() {
                let point = match source {
                    Source::Transformed(point) => *point,
                    Source::Input(x) => [0, 1, 2].map(|c| {
                        let name = format!("in_{}_{}", names[i], COORDINATES[c]);
                        let x = self.guarded(&name, x[c], p.coordinate_bound(), &[]);
                        x.bounds(&mut self.b, &format!("{name}_bounds"), p, None)
                    }),
                };
                let rounded = interval::instance(&mut self.b, &format!("{}_round", names[i]), &unit, &point, &[]);
                working.push(self.named_point(names[i], &rounded));
            }
            return working;
        }
        let lanes = 6usize.div_ceil(self.interval);
        let offset = renormalise::offset_unit(p);
        let shift = renormalise::shift_unit(p);
        let scale = renormalise::scale_unit(p);
        let Source::Input(v0) = points[0] else { unreachable!("A is never transformed") };
        let bound = p.coordinate_bound();
        let v0 = [0, 1, 2].map(|c| self.guarded(&format!("in_v0_{}", COORDINATES[c]), v0[c], bound, &[]));
        let points = [&[Source::Input(v0)], &points[1..]].concat();
        let origin: Vec<NodeId> =
            (0..3).map(|c| self.b.broadcast(&format!("origin_{}", COORDINATES[c]), v0[c].lo)).collect();
        let jobs = |j: usize| -> Vec<Option<usize>> {
            (0..self.interval).map(|s| Some(s * lanes + j).filter(|point| *point < 6)).collect()
        };
        let all_jobs: Vec<Vec<Option<usize>>> = (0..lanes).map(jobs).collect();
        let mut offsets = vec![];
        let mut magnitudes: [Vec<NodeId>; 3] = Default::default();
        for (j, jobs) in all_jobs.iter().enumerate() {
            if jobs.iter().all(Option::is_none) {
                continue;
            }
            let lane = self.lane(j, jobs, &points, is_input);
            let out = {
                let mut args: Vec<NodeId> = lane.iter().flat_map(|x| x.nodes()).collect();
                args.extend(&origin);
                self.b.instance(&format!("offset_{j}"), &offset, &args)
            };
            // Outputs come coordinate by coordinate: offset lo, hi, magnitude.
            let mut point = vec![];
            for c in 0..3 {
                let [lo, hi, magnitude] = [out[3 * c], out[3 * c + 1], out[3 * c + 2]];
                point.push(Bounds { lo, hi });
                let idle: Vec<Option<usize>> = jobs.iter().map(|j| Some(usize::from(j.is_some()))).collect();
                magnitudes[c].push(if idle.contains(&Some(0)) {
                    self.masked(&format!("magnitude_{j}_{}", COORDINATES[c]), magnitude, &idle)
                } else {
                    magnitude
                });
            }
            offsets.push((j, jobs.clone(), point));
        }
        let shifts = self.shifts(&magnitudes, &all_jobs, &shift);
        let mut working: Vec<Option<Point>> = vec![None; 6];
        for (j, jobs, point) in offsets {
            let scaled = interval::instance(&mut self.b, &format!("scale_{j}"), &scale, &point, &shifts);
            for (s, job) in jobs.iter().enumerate() {
                let Some(i) = *job else { continue };
                let mut held = vec![];
                for (c, x) in COORDINATES.iter().zip(&scaled) {
                    let lo = self.b.hold(&format!("{}_{c}_lo", names[i]), x.lo, s, false);
                    let hi = self.b.hold(&format!("{}_{c}_hi", names[i]), x.hi, s, false);
                    held.push(Bounds { lo, hi });
                }
                working[i] = Some(self.probed_point(&held));
            }
        }
        working.into_iter().flatten().collect()
    }

    fn named_point(&mut self, name: &str, x: &[Bounds]) -> Point {
        // The instance's outputs under the names that the re-normalised points have too.
        let alias = |path: &mut Self, c: &str, end: &str, node| {
            let ty = path.b.ty(node);
            path.b.op(&format!("{name}_{c}_{end}"), Op::Resize(ty), &[node])
        };
        let named: Vec<Bounds> = COORDINATES
            .iter()
            .zip(x)
            .map(|(c, x)| Bounds { lo: alias(self, c, "lo", x.lo), hi: alias(self, c, "hi", x.hi) })
            .collect();
        self.probed_point(&named)
    }

    fn probed_point(&mut self, x: &[Bounds]) -> Point {
        for node in x.iter().flat_map(|x| x.nodes()) {
            self.b.probe(node, vec![(0, false)]);
        }
        [x[0], x[1], x[2]]
    }

    /// The operand of one lane in each phase: lower bounds as they are, upper bounds made where they are implied.
    fn lane(&mut self, j: usize, jobs: &[Option<usize>], points: &[Source], is_input: &[bool]) -> Vec<Bounds> {
        if self.p.guarded() {
            return self.guarded_lane(j, jobs, points, is_input);
        }
        let name = format!("lane_{j}");
        let p = self.p;
        let (select, legs) = self.pattern(&format!("{name}_point"), jobs);
        let of = |want: bool| -> Vec<Option<usize>> {
            jobs.iter().map(|job| job.filter(|i| is_input[*i] == want)).collect()
        };
        let (inputs, transformed) = (of(true), of(false));
        let has = |jobs: &[Option<usize>]| jobs.iter().any(Option::is_some);
        let own = has(&inputs).then(|| self.pattern(&format!("{name}_input"), &inputs));
        let other = has(&transformed).then(|| self.pattern(&format!("{name}_transformed"), &transformed));
        let which: Vec<Option<usize>> = jobs.iter().map(|job| job.map(|i| usize::from(is_input[i]))).collect();
        let from_input = self.control(&format!("{name}_from_input"), &which, 1);
        let mut point = vec![];
        for (c, coordinate) in COORDINATES.iter().enumerate() {
            let name = format!("{name}_{coordinate}");
            let lower = |i: usize| match &points[i] {
                Source::Input(x) => x[c].lo,
                Source::Transformed(x) => x[c].lo,
            };
            let lo_legs: Vec<(Option<NodeId>, bool)> = legs.iter().map(|i| (Some(lower(*i)), false)).collect();
            let lo = self.b.choose(&format!("{name}_lo"), select, &lo_legs);
            let implied = own.as_ref().map(|(select, legs)| {
                let sticky: Vec<(Option<NodeId>, bool)> = legs
                    .iter()
                    .filter_map(|i| match &points[*i] {
                        Source::Input(x) => x[c].sticky.map(|s| (Some(s), false)),
                        Source::Transformed(_) => None,
                    })
                    .collect();
                let sticky = (!sticky.is_empty()).then(|| self.b.choose(&format!("{name}_sticky"), *select, &sticky));
                // In phases of B the sum is not used; it must fit all the same.
                Quantised { lo, sticky, bound: None }.bounds(&mut self.b, &format!("{name}_input"), p, None).hi
            });
            let computed = other.as_ref().map(|(select, legs)| {
                let legs: Vec<(Option<NodeId>, bool)> = legs
                    .iter()
                    .filter_map(|i| match &points[*i] {
                        Source::Transformed(x) => Some((Some(x[c].hi), false)),
                        Source::Input(_) => None,
                    })
                    .collect();
                self.b.choose(&format!("{name}_transformed_hi"), *select, &legs)
            });
            let hi = match (implied, computed) {
                (Some(hi), None) | (None, Some(hi)) => hi,
                (Some(implied), Some(computed)) => self.b.either(&format!("{name}_hi"), from_input, implied, computed),
                (None, None) => unreachable!("a lane has points"),
            };
            point.push(Bounds { lo, hi });
        }
        point
    }

    /// The value in phases with a job, zero in idle ones.
    fn masked(&mut self, name: &str, value: NodeId, busy: &[Option<usize>]) -> NodeId {
        let busy = self.control(&format!("{name}_busy"), busy, 1);
        let ty = self.b.ty(value);
        let zero = self.b.constant(&format!("{name}_zero"), 0, ty);
        self.b.either(&format!("{name}_masked"), busy, value, zero)
    }

    /// The common shift of each coordinate, in every phase.
    fn shifts(&mut self, magnitudes: &[Vec<NodeId>; 3], jobs: &[Vec<Option<usize>>], unit: &Rc<Unit>) -> Vec<NodeId> {
        let last = jobs.iter().flat_map(|j| j.iter().rposition(Option::is_some)).max().unwrap_or(0);
        let mut shifts = vec![];
        for (c, lanes) in COORDINATES.iter().zip(magnitudes) {
            let mut word = self.b.or_all(&format!("magnitudes_{c}"), lanes);
            if self.interval > 1 {
                let first: Vec<Option<usize>> = (0..self.interval).map(|s| Some(usize::from(s == 0))).collect();
                let first = self.control(&format!("magnitudes_{c}_first"), &first, 1);
                word = self.b.scan_or(&format!("magnitudes_{c}_all"), word, first);
            }
            let word = self.b.hold(&format!("magnitude_{c}"), word, last, false);
            self.b.comment(word, format!("OR of the magnitudes of the twelve bounds, {c}"));
            let flags = self.b.instance(&format!("shift_{c}"), unit, &[word]);
            for (i, flag) in flags.into_iter().enumerate() {
                shifts.push(self.b.broadcast(&format!("shift_{c}_by_{i}"), flag));
            }
        }
        shifts
    }

    /// e_Xk = X_(k+1) - X_k (equation 1), and the two negated ones that the normals take.
    fn edges(&mut self, points: &[Point]) -> Edges {
        let f = self.formats.clone();
        let (p, grid) = (self.p, f.coordinate_a.format.fraction);
        let ty = Type::signed(p.width, grid);
        let unit = |name: &str, row: &Row, coordinate: i128, lemma: Option<(i128, &'static str)>| {
            let range = symmetric(coordinate);
            let rounding = rounding(grid, row);
            let narrowing = Narrowing { bound: lemma, rounding, bits: p.width, upper: p.upper };
            interval::subtract_unit(name, (ty, range), (ty, range), Some(narrowing))
        };
        let anchored = p.renormalise.then(|| ((1i128 << grid) + 1, "anchored-edge"));
        let kinds = [
            unit("edge_a_anchored", &f.edge_a[0], f.coordinate_a.bound, anchored),
            unit("edge_a", &f.edge_a[1], f.coordinate_a.bound, None),
            unit("edge_b", &f.edge_b, f.coordinate_b.bound, None),
        ];
        let mut edge = |name: &str, unit: &Rc<Unit>, from: Point, to: Point| -> Point {
            [0, 1, 2].map(|c| {
                let name = format!("{name}_{}", COORDINATES[c]);
                let x = interval::instance(&mut self.b, &name, unit, &[to[c], from[c]], &[])[0];
                self.b.probe(x.lo, vec![(0, false)]);
                self.b.probe(x.hi, vec![(0, false)]);
                x
            })
        };
        let (v, w) = points.split_at(3);
        let of_a = |k: usize| if k == 1 { &kinds[1] } else { &kinds[0] };
        let a = [0, 1, 2].map(|k| edge(&format!("e_a{k}"), of_a(k), v[k], v[(k + 1) % 3]));
        let b = [0, 1, 2].map(|k| edge(&format!("e_b{k}"), &kinds[2], w[k], w[(k + 1) % 3]));
        let (minus_a2, minus_b2) = (self.negated("minus_e_a2", a[2]), self.negated("minus_e_b2", b[2]));
        Edges { a, b, minus_a2, minus_b2 }
    }

    fn negated(&mut self, name: &str, x: Point) -> Point {
        [0, 1, 2].map(|c| {
            let mut minus = |end: &str, node| {
                let name = format!("{name}_{}_{end}", COORDINATES[c]);
                let bits = self.b.ty(node).bits;
                let wide = self.b.op(&format!("{name}_wide"), Op::Negate, &[node]);
                self.b.resize(&name, wide, true, bits)
            };
            let lo = minus("lo", x[c].hi);
            Bounds { lo, hi: minus("hi", x[c].lo) }
        })
    }

    /// Section 7.
    fn verdict(&mut self, flags: &Flags) {
        let b = &mut self.b;
        let separate = b.or_all("any_separated", &flags.separated);
        let surely = b.tree("all_overlapping", Op::And, &flags.overlapping[..11]);
        let not_separate = b.op("none_separated", Op::Not, &[separate]);
        let not_surely = b.op("not_all_overlapping", Op::Not, &[surely]);
        let intersect = b.and("is_intersect", not_separate, surely);
        let possibly = b.and("is_possibly_incorrect", not_separate, not_surely);
        let verdict = b.op("verdict_code", Op::Concatenate, &[intersect, possibly]);
        b.comment(verdict, "00 separate, 01 intersect, 10 possibly incorrect");
        let separated = b.op("separated_flags", Op::Concatenate, &flags.separated);
        let overlapping = b.op("overlapping_flags", Op::Concatenate, &flags.overlapping);
        b.output("verdict", verdict);
        b.output("separated", separated);
        b.output("overlapping", overlapping);
    }
}

/// From exact fraction bits to a row's format.
pub(super) fn rounding(exact_fraction: i32, row: &Row) -> Rounding {
    Rounding { drop: exact_fraction - row.format.fraction, clamp: row.clamp.map(|c| (c.bound, c.lemma)) }
}
