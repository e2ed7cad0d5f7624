//! The contract once more, over numbers of any length, with a switch a stage: rounded as the unit does it, or exact.
//!
//! With every stage rounded it gives the flags of the reference model, with every stage exact those of real arithmetic.

use super::interval::Interval;
use super::{Exact, Stage};
use crate::accuracy::pairs::Asked;
use efsat_unit::golden::{Input, Pair, Pose};
use efsat_unit::host::Host;
use efsat_unit::params::{Axes, AxisKind, Params, Projections, Row, Transform};

type Vector = [Interval; 3];
type Triple = [Vector; 3];

/// What one axis shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AxisAnswer {
    /// Its kind.
    pub kind: AxisKind,
    /// The images are certainly disjoint.
    pub separated: bool,
    /// They certainly overlap.
    pub overlapping: bool,
    /// The axis is certainly zero.
    pub zero: bool,
    /// All six points are certainly projected to one number.
    pub flat: bool,
}

/// A pair with its pose, as given and as quantised.
pub struct Case<'a> {
    params: &'a Params,
    /// A, B~, M and t as real numbers, normalised as the host does it.
    real: Motion,
    /// As the unit reads them.
    read: Motion,
}

/// What goes into the transform.
struct Motion {
    a: Triple,
    b: Triple,
    /// None where B = B~.
    pose: Option<(Triple, Vector)>,
}

fn three<T>(of: impl Fn(usize) -> T) -> [T; 3] {
    [of(0), of(1), of(2)]
}

fn dot(a: &Vector, b: &Vector) -> Interval {
    a[0].times(&b[0]).plus(&a[1].times(&b[1])).plus(&a[2].times(&b[2]))
}

fn cross(a: &Vector, b: &Vector) -> Vector {
    three(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        a[j].times(&b[k]).minus(&a[k].times(&b[j]))
    })
}

fn difference(a: &Vector, b: &Vector) -> Vector {
    three(|i| a[i].minus(&b[i]))
}

fn vector(x: [f64; 3]) -> Vector {
    x.map(Interval::exact)
}

/// M x + t.
fn image(m: &Triple, t: &Vector, x: &Vector) -> Vector {
    three(|i| dot(&m[i], x).plus(&t[i]))
}

impl Motion {
    /// The numbers of the unit's inputs.
    fn read(params: &Params, pose: &Pose, pair: &Pair) -> Self {
        let fraction = i64::from(params.input().fraction);
        let number = |x: Input| {
            let x = x.interval(params.upper);
            Interval::new(x.lo, x.hi, fraction)
        };
        let triple = |x: &[[Input; 3]; 3]| three(|k| x[k].map(number));
        let bypass = pose.bypass || params.transform == Transform::Off;
        let motion = (triple(&pose.m), pose.t.map(number));
        Self { a: triple(&pair.a), b: triple(&pair.b), pose: (!bypass).then_some(motion) }
    }

    /// The real numbers they stand for: s (x - c), M, and t' = s (M c_B + t - c_A); with B moved by the host where the
    /// unit cannot.
    fn real(asked: &Asked, place: usize, bypass: bool) -> Self {
        let (pairs, met) = (asked.pairs, asked.pairs.met(place));
        let ends = met.meshes.map(|mesh| bounds(pairs.mesh(mesh)));
        let centres = ends.each_ref().map(|ends| ends.each_ref().map(|[low, high]| low.plus(high).scaled(-1)));
        let halves = ends.iter().flatten().map(|[low, high]| high.minus(low).scaled(-1));
        let power = halves.filter(|half| !half.is_zero()).map(|half| -half.ceil_log2()).min().unwrap_or(0);
        let (m, t) = (met.m.map(vector), vector(met.t));
        let scaled = |x: Vector| x.map(|x| x.scaled(power));
        let shift = scaled(difference(&image(&m, &t, &centres[1]), &centres[0]));
        let [a, b] = pairs.corners(met, place).map(|triangle| triangle.map(vector));
        let a = a.map(|x| scaled(difference(&x, &centres[0])));
        let unturned = (0..3).all(|i| (0..3).all(|j| met.m[i][j] == f64::from(i == j)));
        if bypass && !(unturned && shift.iter().all(Interval::is_zero)) {
            let b = b.map(|x| scaled(difference(&image(&m, &t, &x), &centres[0])));
            return Self { a, b, pose: None };
        }
        let b = b.map(|x| scaled(difference(&x, &centres[1])));
        Self { a, b, pose: (!bypass).then_some((m, shift)) }
    }
}

/// Least and greatest coordinate along each axis.
fn bounds(mesh: &[[f64; 3]]) -> [[Interval; 2]; 3] {
    three(|axis| {
        let column = || mesh.iter().map(|vertex| vertex[axis]);
        [column().reduce(f64::min), column().reduce(f64::max)].map(|x| Interval::exact(x.unwrap_or(0.0)))
    })
}

impl<'a> Case<'a> {
    /// The pair at a place; none if the host decides it.
    pub fn new(asked: &Asked<'a>, place: usize) -> Option<Self> {
        let (pose, Host::Unit(pair)) = asked.inputs(place) else { return None };
        let read = Motion::read(asked.params, &pose, &pair);
        let real = Motion::real(asked, place, read.pose.is_none());
        Some(Self { params: asked.params, real, read })
    }

    /// What every axis shows, with these stages exact.
    pub fn axes(&self, exact: Exact) -> Vec<AxisAnswer> {
        let points = self.coordinates(exact);
        let tables = Tables { params: self.params, formats: self.params.formats(), exact };
        let [a, b] = &points;
        let edge = |x: &Triple, k: usize, row: &Row| difference(&x[(k + 1) % 3], &x[k]).map(|x| tables.axis(&x, row));
        let edge_a = three(|k| edge(a, k, &tables.formats.edge_a[k]));
        let edge_b = three(|k| edge(b, k, &tables.formats.edge_b));
        let axis =
            |kind: AxisKind, e: &Vector, f: &Vector| cross(e, f).map(|x| tables.axis(&x, tables.formats.axis(kind)));
        let back = |e: &Vector| e.each_ref().map(|x| x.negated());
        let normal_a = axis(AxisKind::NormalA, &edge_a[0], &back(&edge_a[2]));
        let normal_b = axis(AxisKind::NormalB, &edge_b[0], &back(&edge_b[2]));
        let (none, all) = ([false; 3], [true; 3]);
        let ends = |k: usize| three(|i| i == k || i == (k + 1) % 3);
        let mut answers = vec![
            tables.answer(AxisKind::NormalA, &normal_a, &points, [all, none], [0, 0]),
            tables.answer(AxisKind::NormalB, &normal_b, &points, [none, all], [0, 0]),
        ];
        for (k, e) in edge_a.iter().enumerate() {
            for (l, f) in edge_b.iter().enumerate() {
                let kind = AxisKind::Cross(k);
                answers.push(tables.answer(kind, &axis(kind, e, f), &points, [ends(k), ends(l)], [k, l]));
            }
        }
        if self.params.axes == Axes::Seventeen {
            for (k, e) in edge_a.iter().enumerate() {
                let kind = AxisKind::InPlaneA(k);
                answers.push(tables.answer(kind, &axis(kind, &normal_a, e), &points, [ends(k), none], [k, 0]));
            }
            for (l, f) in edge_b.iter().enumerate() {
                let direction = axis(AxisKind::InPlaneB, &normal_b, f);
                answers.push(tables.answer(AxisKind::InPlaneB, &direction, &points, [none, ends(l)], [0, l]));
            }
        }
        answers
    }

    /// Whether the pair gets a definite answer with these stages exact.
    pub fn definite(&self, exact: Exact) -> bool {
        let axes = self.axes(exact);
        axes.iter().any(|axis| axis.separated) || axes[..11].iter().all(|axis| axis.overlapping)
    }

    /// Sections 2 to 4.
    fn coordinates(&self, exact: Exact) -> [Triple; 2] {
        let p = self.params;
        let Motion { a, b, pose } = if exact.has(Stage::Input) { &self.real } else { &self.read };
        let fraction = i64::from(p.input().fraction);
        let b = match pose {
            None => b.clone(),
            Some((_, t)) if p.transform == Transform::Translate => b.each_ref().map(|x| three(|i| x[i].plus(&t[i]))),
            Some((m, t)) => b.each_ref().map(|x| {
                image(m, t, x).map(|x| match exact.has(Stage::Transform) {
                    true => x,
                    false => x.rounded(fraction, p.upper),
                })
            }),
        };
        let working = i64::from(p.formats().coordinate_a.format.fraction);
        let rounds = !exact.has(Stage::Renormalise);
        let mut points = [a.clone(), b];
        if !p.renormalise {
            return points.map(|x| x.map(|x| x.map(|x| if rounds { x.rounded(working, p.upper) } else { x })));
        }
        let origin = a[0].each_ref().map(Interval::lower);
        points = points.map(|x| x.map(|x| difference(&x, &origin)));
        let power = three(|i| points.iter().flatten().filter_map(|x| x[i].exponent()).max().unwrap_or(0));
        // The shifter hands on transform-width + 1 fraction bits, zeros among them where the pair is small.
        let handed = i64::from(p.transform_width) + 1;
        let normalised = |x: Vector| {
            three(|i| {
                let x = x[i].scaled(-power[i]);
                if rounds { x.refined(handed).rounded(working, p.upper) } else { x }
            })
        };
        points.map(|x| x.map(normalised))
    }
}

/// Formats, and which of them are used.
struct Tables<'a> {
    params: &'a Params,
    formats: efsat_unit::params::Formats,
    exact: Exact,
}

impl Tables<'_> {
    fn rounded(&self, x: &Interval, row: &Row) -> Interval {
        let rounded = x.rounded(i64::from(row.format.fraction), self.params.upper);
        match row.clamp {
            Some(clamp) => rounded.clamped(clamp.bound),
            None => rounded,
        }
    }

    fn axis(&self, x: &Interval, row: &Row) -> Interval {
        if self.exact.has(Stage::Axis) { x.clone() } else { self.rounded(x, row) }
    }

    /// Sections 5 and 6 for one axis; `groups` are the points with one true projection, `kept` those of them that
    /// `skip` keeps.
    fn answer(
        &self,
        kind: AxisKind,
        direction: &Vector,
        points: &[Triple; 2],
        groups: [[bool; 3]; 2],
        kept: [usize; 2],
    ) -> AxisAnswer {
        let row = self.formats.projection(kind);
        let project = |point: &Vector| {
            let x = dot(point, direction);
            if self.exact.has(Stage::Projection) { x } else { self.rounded(&x, row) }
        };
        let [a, b] = [0, 1].map(|side: usize| {
            let raw = points[side].each_ref().map(project);
            let common = match self.params.projections {
                Projections::All => return raw,
                Projections::Skip => raw[kept[side]].clone(),
                Projections::Intersect => {
                    let group = (0..3).filter(|&i| groups[side][i]).map(|i| raw[i].clone());
                    group.reduce(|x, y| x.intersected(&y)).unwrap_or_else(|| raw[0].clone())
                }
            };
            three(|i| if groups[side][i] { common.clone() } else { raw[i].clone() })
        });
        let least = |x: &[Interval; 3]| x[0].min(&x[1]).min(&x[2]);
        let greatest = |x: &[Interval; 3]| x[0].max(&x[1]).max(&x[2]);
        let (a_min, a_max, b_min, b_max) = (least(&a), greatest(&a), least(&b), greatest(&b));
        AxisAnswer {
            kind,
            separated: b_min.above(&a_max) || a_min.above(&b_max),
            overlapping: b_max.lower().above(&a_min.upper()) && a_max.lower().above(&b_min.upper()),
            zero: direction.iter().all(Interval::is_zero),
            flat: a.iter().chain(&b).all(|x| x.minus(&a[0]).is_zero()),
        }
    }
}
