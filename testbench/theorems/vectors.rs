//! Options, words and answers of the reference models as lists of numbers, which `proofs/Compare.v` reads.

use efsat::evidence::stress::FAMILIES;
use efsat::golden::Golden;
use efsat::host::sample::{corner_pair, corner_pose, random_pair_under, random_pose};
use efsat::host::{Host, loose_pair};
use efsat::number::Upper;
use efsat::pair::{Input, Outcome, Pair, Pose};
use efsat::params::options::Choice;
use efsat::params::{
    Axes, AxisKind, Bound, Clamp, FormatRow, LEVELS, Method, Params, ProjectionWidth, Projections, SPAN, Transform,
    Truth,
};
use rand::rngs::ChaCha8Rng;
use rand::seq::IndexedRandom;
use rand::{RngExt, SeedableRng};
use std::fmt;

type Numbers = Vec<i128>;

/// A design and its cases.
struct Group {
    options: Numbers,
    cases: Vec<Numbers>,
}

/// The groups of each method.
pub struct Vectors([Vec<Group>; Vectors::METHODS]);

/// The names of the methods in `proofs/Compare.v`, with the numbers that the words of a case are.
const NAMES: [(&str, usize); Vectors::METHODS] = [("determinants", 31), ("exact", 31), ("cascade", 31), ("axes", 61)];

impl Vectors {
    /// Determinants, exact, cascade, axes.
    pub const METHODS: usize = 4;

    /// So many designs of each method.
    pub fn new(designs: usize) -> Self {
        let mut rng = ChaCha8Rng::seed_from_u64(43);
        let mut groups = |make: fn(&mut ChaCha8Rng) -> Params, least: usize| {
            (0..designs.max(least)).map(|_| group(&mut rng)(make)).collect::<Vec<_>>()
        };
        Self([groups(determinants, 1), groups(exact, 1), groups(cascade, 1), groups(axes, 1)])
    }

    /// The last number of the last case of a method is another.
    pub fn changed(&self, method: usize) -> Self {
        let copy = |group: &Group| Group { options: group.options.clone(), cases: group.cases.clone() };
        let mut other = Self(self.0.each_ref().map(|groups| groups.iter().map(copy).collect()));
        *other.0[method].last_mut().unwrap().cases.last_mut().unwrap().last_mut().unwrap() += 1;
        other
    }

    /// A file for the kernel.
    pub fn text(&self) -> String {
        let list = |numbers: &Numbers| numbers.iter().map(i128::to_string).collect::<Vec<_>>().join(";");
        let mut text = "From Coq Require Import ZArith List.\nRequire Import Efsat.Compare.\nImport ListNotations.\nLocal Open Scope Z_scope.\n".to_owned();
        for ((name, words), groups) in NAMES.iter().zip(&self.0) {
            let groups = groups.iter().map(|Group { options, cases }| {
                let cases: Vec<String> = cases.iter().map(|case| format!("[{}]", list(case))).collect();
                format!("([{}], [{}])", list(options), cases.join(";\n"))
            });
            let groups: Vec<String> = groups.collect();
            text += &format!("Definition {name} : list group := [{}].\n", groups.join(";\n"));
            if ["determinants", "axes"].contains(name) {
                text += &format!(
                    "Theorem {name}_valid : all_valid {name}_valid {name} = true. Proof. vm_compute. reflexivity. Qed.\n"
                );
            }
            text += &format!(
                "Definition no_difference_of_{name} : differences {words} {name}_answer {name} = [] := ltac:(vm_compute; reflexivity).\n"
            );
        }
        text
    }
}

impl fmt::Display for Vectors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for ((name, _), groups) in NAMES.iter().zip(&self.0) {
            let cases: usize = groups.iter().map(|group| group.cases.len()).sum();
            writeln!(f, "{name}: {} designs, {cases} cases, no difference", groups.len())?;
        }
        Ok(())
    }
}

fn one<T: Copy>(rng: &mut ChaCha8Rng, all: &[T]) -> T {
    *all.choose(rng).unwrap()
}

/// Widths and an input format.
fn widths(rng: &mut ChaCha8Rng) -> Params {
    let width = one(rng, &[6, 8, 12, 16, 18, 18, 20, 24, 32]);
    let transform_width = (width + rng.random_range(0..=16)).min(48);
    Params { width, transform_width, int_bits: rng.random_range(4..=8.min(width - 2)), ..Params::default() }
}

fn determinants(rng: &mut ChaCha8Rng) -> Params {
    Params {
        method: Method::Determinants,
        transform: one(rng, &[Transform::Off, Transform::Translate, Transform::On]),
        span: one(rng, SPAN),
        levels: one(rng, LEVELS),
        bound: one(rng, Bound::ALL),
        boxes: rng.random(),
        ..widths(rng)
    }
}

fn exact(rng: &mut ChaCha8Rng) -> Params {
    let p = Params { method: Method::Exact, ..widths(rng) };
    match rng.random_range(0..3) {
        0 => Params { transform: Transform::Off, ..p },
        1 => Params { transform: Transform::Translate, ..p },
        _ => Params { transform: Transform::On, truth: Truth::Snapped, transform_width: p.width + 1, ..p },
    }
}

fn cascade(rng: &mut ChaCha8Rng) -> Params {
    Params { transform: Transform::Off, exact_clocks: Some(16), ..Params { method: Method::Exact, ..widths(rng) } }
}

fn axes(rng: &mut ChaCha8Rng) -> Params {
    Params {
        transform: one(rng, &[Transform::Off, Transform::Translate, Transform::On]),
        renormalise: rng.random(),
        upper: one(rng, &[Upper::Implied, Upper::Sticky]),
        axes: one(rng, &[Axes::Eleven, Axes::Seventeen]),
        axis_shift: one(rng, &[0, 7, 30]),
        projections: one(rng, &[Projections::All, Projections::Skip, Projections::Intersect]),
        projection_width: one(rng, &[ProjectionWidth::Rounded, ProjectionWidth::Plus(4), ProjectionWidth::Full]),
        edge_test: rng.random(),
        ..widths(rng)
    }
}

/// A design with its cases: ordinary ones, ones at the ends of the ranges, and one of each of some hard families.
fn group(rng: &mut ChaCha8Rng) -> impl FnOnce(fn(&mut ChaCha8Rng) -> Params) -> Group + '_ {
    |make| {
        let p = make(rng);
        p.validate().unwrap_or_else(|e| panic!("{e}"));
        let golden = Golden::new(&p);
        let mut cases: Vec<(Pose, Pair)> = vec![];
        for n in 0..4 {
            let pose = if n == 3 { corner_pose(rng, &p) } else { random_pose(rng, &p) };
            let pair = if n == 3 { corner_pair(rng, &p) } else { random_pair_under(rng, &p, &pose) };
            cases.push((pose, pair));
        }
        for _ in 0..4 {
            let family = FAMILIES.choose(rng).unwrap();
            if let Ok(Host::Unit(pair)) = loose_pair(&family.case(43, rng.random_range(0..1000)).0, &p) {
                cases.push((Pose::identity(&p), pair));
            }
        }
        // The guard is no part of the functions.
        cases.retain(|(pose, pair)| {
            p.method == Method::Exact && p.truth == Truth::Given || !golden.outcome(pose, pair).outside
        });
        let cases = cases.iter().map(|(pose, pair)| [words(&p, pose, pair), answer(&p, &golden, pose, pair)].concat());
        Group { options: options(&p), cases: cases.collect() }
    }
}

fn transform(p: &Params) -> i128 {
    match p.transform {
        Transform::Off => 0,
        Transform::Translate => 1,
        Transform::On => 2,
    }
}

/// The options and tables of a design, as `options_of` and `table_of` read them.
fn options(p: &Params) -> Numbers {
    let fraction = i128::from(p.transform_width - p.int_bits);
    if p.method != Method::Axes {
        let levels = p.error_levels();
        let [fine, least, greatest] = [levels.fine, levels.least, levels.greatest].map(i128::from);
        let bound = match p.bound {
            Bound::Static => 0,
            Bound::Edges => 1,
            Bound::Moments => 2,
            Bound::Products => 3,
        };
        return vec![
            p.width.into(),
            fraction,
            transform(p),
            fine,
            least,
            greatest,
            p.span.into(),
            bound,
            p.boxes.into(),
        ];
    }
    let f = p.formats();
    let row = |row: &FormatRow| [row.format.fraction.into(), row.clamp.map_or(-1, |Clamp { bound, .. }| bound)];
    let (axis, image) = (|kind| row(f.axis(kind)), |kind| i128::from(f.projection(kind).format.fraction));
    let three = |kind: fn(usize) -> AxisKind| [0, 1, 2].map(kind);
    let projections = match p.projections {
        Projections::All => 0,
        Projections::Skip => 1,
        Projections::Intersect => 2,
    };
    let mut numbers = vec![
        p.width.into(),
        p.transform_width.into(),
        p.int_bits.into(),
        (p.upper == Upper::Sticky).into(),
        transform(p),
    ];
    numbers.extend([i128::from(p.renormalise), p.axis_positions().into(), p.projection_upper().is_some().into()]);
    numbers.extend([
        projections,
        (p.axes == Axes::Seventeen).into(),
        p.edge_test.into(),
        f.coordinate_a.format.fraction.into(),
    ]);
    numbers.extend(f.edge_a.iter().flat_map(row));
    numbers.extend([row(&f.edge_b), axis(AxisKind::NormalA), axis(AxisKind::NormalB)].concat());
    numbers.extend([AxisKind::Cross, AxisKind::InPlaneA].map(three).concat().into_iter().flat_map(axis));
    numbers.extend(axis(AxisKind::InPlaneB));
    numbers.extend([image(AxisKind::NormalA), image(AxisKind::NormalB)]);
    numbers.extend([AxisKind::Cross, AxisKind::InPlaneA].map(three).concat().into_iter().map(image));
    numbers.push(image(AxisKind::InPlaneB));
    numbers
}

/// The words of a pair: vertices of A and of B, rows of M, t, and the bypass.
fn words(p: &Params, pose: &Pose, pair: &Pair) -> Numbers {
    let inputs = pair.a.iter().chain(&pair.b).chain(&pose.m).chain([&pose.t]).flatten();
    let number = |x: &Input| match p.method {
        Method::Axes => vec![x.lo.into(), x.sticky.into()],
        _ => vec![x.lo.into()],
    };
    inputs.flat_map(number).chain([i128::from(pose.bypass)]).collect()
}

/// What the reference model says, as the answers of `proofs/Compare.v`.
fn answer(p: &Params, golden: &Golden, pose: &Pose, pair: &Pair) -> Numbers {
    let Outcome { verdict, separated, overlapping, outside } = golden.outcome(pose, pair);
    let trace = golden.trace(pose, pair);
    let of = |prefix: &str| {
        trace.iter().filter(|(name, _)| name.starts_with(prefix)).map(|(_, x)| x.lo).collect::<Numbers>()
    };
    let computed =
        || ["dropped", "level", "coordinate", "moment", "shift", "determinant", "bound.", "sign"].map(of).concat();
    let flags = vec![verdict as i128, separated.into(), overlapping.into()];
    match p.method {
        Method::Determinants => [of("difference"), flags, computed()].concat(),
        Method::Exact if outside => {
            if p.exact_clocks.is_some() {
                vec![2]
            } else {
                vec![2, 0, 0]
            }
        }
        Method::Exact if p.exact_clocks.is_some() => {
            let signs = of("sign");
            let first = [of("verdict"), of("boxes_apart")].concat();
            let one_side = |plane: &[i128]| i128::from(plane == [1; 3] || plane == [-1; 3]);
            let bits = |bits: Numbers| bits.iter().rev().fold(0, |all, bit| 2 * all + bit);
            let separated =
                bits([vec![first[1], one_side(&signs[..3]), one_side(&signs[3..6])], of("missed")].concat());
            let overlapping = bits([vec![0; 3], of("pierces")].concat());
            [vec![verdict as i128, first[0], separated, overlapping], computed()].concat()
        }
        Method::Exact => [flags, of("determinant")].concat(),
        Method::Axes => {
            let digest = |prefix: &str| {
                let ends = trace.iter().filter(|(name, _)| name.starts_with(prefix)).flat_map(|(_, x)| [x.lo, x.hi]);
                ends.fold(0, |h: i128, x| (h * 1_000_003 + x).rem_euclid((1 << 61) - 1))
            };
            [flags, ["transform", "renormalise", "edge", "axis", "enclosure"].map(digest).to_vec()].concat()
        }
    }
}
