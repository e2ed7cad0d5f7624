//! The model against exact arithmetic: every signal contains the real number it stands for, every definite verdict is
//! right, and the counter-examples of the contract stay refuted.

// Loops over components read like the equations.
#![allow(clippy::needless_range_loop)]

mod true_numbers;

use super::axes::Axis;
use super::axis_test::AxisTest;
use super::interval::{Flags, Rounding, product};
use super::lanes::LANES;
use super::verdict::Enclosure;
use super::{Golden, Lossless};
use crate::host::{Host, SceneHost, loose_pair, sample};
use crate::pair::{Input, Pair, Pose, Verdict};
use crate::params::{Axes, Guard, Params, ProjectionWidth, Projections, Transform};
use efsat_geometry::Points;
use efsat_geometry::exact::{self, Exact};
use efsat_geometry::sample::random_points;
use efsat_hardware::number::{Interval, Upper, floor_shift, upper_shift};
use efsat_hardware::testing::full;
use rand::rngs::ChaCha8Rng;
use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};
use std::collections::HashMap;

/// Parameter sets that meet every option, small and large widths, and i64 and i128 products.
fn parameter_sets() -> Vec<Params> {
    let widths = [
        (6, 4, 6),
        (6, 4, 32),
        (8, 6, 11),
        (12, 4, 12),
        (18, 4, 32),
        (18, 8, 18),
        (24, 5, 40),
        (30, 4, 31),
        (32, 4, 48),
        (32, 8, 32),
    ];
    let mut sets = Vec::new();
    for (i, (width, int_bits, transform_width)) in widths.into_iter().enumerate() {
        for (j, projections) in [Projections::All, Projections::Skip, Projections::Intersect].into_iter().enumerate() {
            for upper in [Upper::Implied, Upper::Sticky] {
                for renormalise in [true, false] {
                    let axes = if (i + j) % 2 == 0 { Axes::Seventeen } else { Axes::Eleven };
                    let transform = [Transform::On, Transform::Off, Transform::Translate][(i + 2 * j) % 3];
                    let p = Params {
                        width,
                        int_bits,
                        transform_width,
                        axes,
                        projections,
                        upper,
                        renormalise,
                        transform,
                        projection_width: [ProjectionWidth::Rounded, ProjectionWidth::Plus(4), ProjectionWidth::Full]
                            [(i + j) % 3],
                        axis_shift: [0, 7, 30, 2][(sets.len() + j) % 4],
                        edge_test: sets.len() % 3 > 0,
                        ..Params::default()
                    };
                    p.validate().unwrap();
                    sets.push(p);
                }
            }
        }
    }
    sets
}

/// A random query inside the declared ranges, every third at their corners.
fn query(rng: &mut ChaCha8Rng, p: &Params) -> (Pose, Pair) {
    if rng.random_range(0..3) == 0 {
        (sample::corner_pose(rng, p), sample::corner_pair(rng, p))
    } else {
        let pose = sample::random_pose(rng, p);
        let pose = if p.transform == Transform::On { pose } else { Pose::identity(p) };
        (pose, sample::random_pair_under(rng, p, &pose))
    }
}

fn unit_pair(points: &Points, p: &Params) -> Pair {
    match loose_pair(points, p).unwrap() {
        Host::Unit(pair) => pair,
        Host::Decided(verdict) => panic!("a loose pair fits: {verdict}"),
    }
}

fn classified(points: &Points, p: &Params) -> Verdict {
    Golden::new(p).verdict(&Pose::identity(p), &unit_pair(points, p))
}

/// No definite verdict contradicts the exact answer.
fn sound(verdict: Verdict, exact: Exact) -> bool {
    match verdict {
        Verdict::Separate => exact == Exact::Separate,
        Verdict::Intersect => exact != Exact::Separate,
        Verdict::PossiblyIncorrect => true,
    }
}

#[test]
fn products_by_the_nine_cases() {
    let reach = -5..=5i64;
    let intervals: Vec<Interval<i64>> =
        reach.clone().flat_map(|lo| (lo..=5).map(move |hi| Interval::new(lo, hi))).collect();
    for &a in &intervals {
        for &b in &intervals {
            let bounds = [a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi];
            let expected = if a.lo < 0 && a.hi > 0 && b.lo < 0 && b.hi > 0 {
                let p = a.hi.max(-a.lo) * b.hi.max(-b.lo);
                Interval::new(-p, p)
            } else {
                Interval::new(*bounds.iter().min().unwrap(), *bounds.iter().max().unwrap())
            };
            assert_eq!(product::<i64>(&a, &b), expected, "{a:?} {b:?}");
            assert_eq!(product::<i128>(&a, &b), Interval::new(expected.lo.into(), expected.hi.into()));
            for x in a.lo..=a.hi {
                for y in b.lo..=b.hi {
                    assert!((expected.lo..=expected.hi).contains(&(x * y)));
                }
            }
        }
    }
}

#[test]
fn roundings_are_those_of_the_number_room() {
    for upper in [Upper::Implied, Upper::Sticky] {
        for drop in -3..20 {
            let rounding = Rounding::dropping(drop, upper);
            for x in (-70..70).chain([-(1 << 40), (1 << 40) - 1, (1 << 40) + 1]) {
                let expected = (floor_shift(x, drop) as i64, upper_shift(x, drop, upper) as i64);
                let narrow = rounding.apply(Interval::new(x as i64, x as i64));
                let wide = rounding.apply(Interval::new(x, x));
                assert_eq!(((narrow.lo, narrow.hi), (wide.lo, wide.hi)), (expected, expected));
            }
        }
    }
}

/// All ways to choose one number out of each of two intervals.
fn choices(a: Interval<i64>, b: Interval<i64>) -> impl Iterator<Item = (i64, i64)> {
    (a.lo..=a.hi).flat_map(move |x| (b.lo..=b.hi).map(move |y| (x, y)))
}

/// Lines of the paper's (7) and (8) as printed: a case and what is then asked for an intersection.
fn printed_line(line: usize, e: &Enclosure<i64>) -> bool {
    match line {
        0 => e.a_max.hi < e.b_max.lo && e.b_min.hi < e.a_max.lo,
        1 => e.b_max.hi < e.a_max.lo && e.a_min.hi < e.b_max.lo,
        2 => e.a_min.hi < e.b_min.lo && e.a_max.lo < e.b_min.hi,
        _ => e.b_min.hi < e.a_min.lo && e.b_max.lo < e.a_min.hi,
    }
}

/// Contract section 6: the one test is right about every choice of true projections, it covers (7) and the sound line
/// of (8), and the other two lines of (8) call disjoint images intersecting.
#[test]
fn the_axis_test_is_sound_and_printed_lines_of_8_are_not() {
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    let mut counts = [0; 3];
    let mut wrong = [0; 4];
    for _ in 0..40_000 {
        let mut vertex = || {
            let lo = rng.random_range(-5..5i64);
            Interval::new(lo, lo + rng.random_range(0..4))
        };
        let (a, b) = ([(); 3].map(|()| vertex()), [(); 3].map(|()| vertex()));
        let e = Enclosure::new(&a, &b);
        // The images of one choice are disjoint or not; the extremes of the choices tell about all.
        let may_be_disjoint =
            choices(e.a_max, e.b_min).any(|(x, y)| x < y) || choices(e.b_max, e.a_min).any(|(x, y)| x < y);
        let must_be_disjoint =
            choices(e.a_max, e.b_min).all(|(x, y)| x < y) || choices(e.b_max, e.a_min).all(|(x, y)| x < y);
        let [separated, overlapping] = [e.separated(), e.overlapping()].map(Flags::all);
        assert_eq!(separated, must_be_disjoint, "{e:?}");
        assert!(!(overlapping && may_be_disjoint), "{e:?}");
        for line in 0..2 {
            assert!(!printed_line(line, &e) || overlapping, "{e:?}");
        }
        for (line, wrong) in wrong.iter_mut().enumerate() {
            *wrong += usize::from(printed_line(line, &e) && may_be_disjoint);
        }
        counts[0] += usize::from(separated);
        counts[1] += usize::from(overlapping);
        counts[2] += usize::from(!separated && !overlapping);
    }
    assert!(counts.iter().all(|&n| n > 1000), "{counts:?}");
    assert!(wrong[0] == 0 && wrong[1] == 0 && wrong[2] > 1000 && wrong[3] > 1000, "{wrong:?}");
    // One by hand: A may end at 1, before B begins at 4, and line 3 calls it an intersection.
    let at = Interval::new;
    let e = Enclosure { a_min: at(0, 0), a_max: at(1, 3), b_min: at(2, 4), b_max: at(5, 6) };
    assert!(printed_line(2, &e) && !e.overlapping().all() && !e.separated().all());
}

/// Contract section 6: with `<=` for `<`, disjoint coplanar triangles on the grid would be called intersecting.
#[test]
fn strictness_saves_coplanar_pairs() {
    let mut rng = ChaCha8Rng::seed_from_u64(6);
    let p = Params { upper: Upper::Sticky, ..Params::default() };
    let seventeen = Params { axes: Axes::Seventeen, ..p.clone() };
    let golden = Golden::new(&p);
    let pose = Pose::identity(&p);
    let mut tried = 0;
    while tried < 200 {
        let points: Points =
            [(); 6].map(|()| [f64::from(rng.random_range(-16..16)), f64::from(rng.random_range(-16..16)), 3.0]);
        if exact::pair(&points).unwrap() != Exact::Separate {
            continue;
        }
        tried += 1;
        let pair = unit_pair(&points, &p);
        let trace: HashMap<String, Interval<i128>> = golden.trace(&pose, &pair).into_iter().collect();
        let relaxed = Axis::all(Axes::Eleven).iter().all(|axis| {
            let bound = |name: &str| trace[&format!("enclosure.{axis}.{name}")];
            bound("a_min").hi <= bound("b_max").lo && bound("b_min").hi <= bound("a_max").lo
        });
        assert!(relaxed, "with <= this would be an intersection: {points:?}");
        assert_eq!(golden.verdict(&pose, &pair), Verdict::PossiblyIncorrect);
        assert_ne!(classified(&points, &seventeen), Verdict::Intersect);
    }
    let apart: Points = [[0., 0., 0.], [4., 0., 0.], [0., 4., 0.], [4., 4., 0.], [8., 4., 0.], [4., 8., 0.]];
    assert_eq!(classified(&apart, &seventeen), Verdict::Separate);
}

/// A and B have a pair of parallel edges, so that no eleven axes can say *intersect*, and an edge of A passes through B.
#[test]
fn parallel_edges_are_decided_where_an_edge_passes() {
    let a = [[-3., -1., 0.], [3., -1., 0.], [0., 2., 4.]];
    let b = [[-3., -0.5, 1.], [3., -0.5, 1.], [0., 3., -1.]];
    let points: Points = [a[0], a[1], a[2], b[0], b[1], b[2]];
    assert_eq!(exact::pair(&points).unwrap(), Exact::Intersect);
    let p = Params::default();
    assert_eq!(classified(&points, &p), Verdict::Intersect);
    for axes in [Axes::Eleven, Axes::Seventeen] {
        let p = Params { edge_test: false, width: 32, transform_width: 48, axes, ..p.clone() };
        assert_eq!(classified(&points, &p), Verdict::PossiblyIncorrect);
    }
    // A segment through a triangle, which is degenerate.
    let points: Points = [[0., 0., -1.], [0., 0., -1.], [0., 0., 1.], [-2., -1., 0.], [2., -1., 0.], [0., 3., 0.]];
    assert_eq!(classified(&points, &p), Verdict::Intersect);
}

/// Whether an edge passes through the other triangle, from the projections.
fn passes(trace: &HashMap<String, Interval<i128>>) -> bool {
    let side = |axis: &str, k: usize, l: usize| {
        let [v, w] = [format!("v{k}"), format!("w{l}")].map(|point| trace[&format!("projection.{axis}.{point}")]);
        i32::from(w.lo > v.hi) - i32::from(w.hi < v.lo)
    };
    let edge = |k: usize, l: usize| side(&format!("c_{k}{l}"), k, l);
    let through = |ends: [i32; 2], sides: [i32; 3]| ends[0] * ends[1] == -1 && sides.iter().sum::<i32>().abs() == 3;
    (0..3).any(|i| {
        let next = (i + 1) % 3;
        through([side("n_b", i, 0), side("n_b", next, 0)], [0, 1, 2].map(|l| edge(i, l)))
            || through([side("n_a", 0, i), side("n_a", 0, next)], [0, 1, 2].map(|k| edge(k, i)))
    })
}

#[test]
fn the_fast_verdict_is_the_outcomes() {
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    let mut seen = [0; 3];
    for p in parameter_sets() {
        let golden = Golden::new(&p);
        for _ in 0..100 {
            let (pose, pair) = query(&mut rng, &p);
            let outcome = golden.outcome(&pose, &pair);
            assert_eq!(golden.verdict(&pose, &pair), outcome.verdict);
            assert_eq!(outcome.separated & outcome.overlapping, 0);
            assert!(outcome.separated | outcome.overlapping < 1 << p.axes.count());
            let trace: HashMap<String, Interval<i128>> = golden.trace(&pose, &pair).into_iter().collect();
            let expected = match (outcome.separated, outcome.overlapping & 0x7ff) {
                (0, 0x7ff) => Verdict::Intersect,
                (0, _) if p.edge_test && passes(&trace) => Verdict::Intersect,
                (0, _) => Verdict::PossiblyIncorrect,
                _ => Verdict::Separate,
            };
            assert_eq!(outcome.verdict, expected);
            seen[expected as usize] += 1;
            // The trace is computed in i128 throughout; the flags follow from its enclosures.
            for (i, axis) in Axis::all(p.axes).iter().enumerate() {
                let bound = |name: &str| trace[&format!("enclosure.{axis}.{name}")];
                let (a_min, a_max, b_min, b_max) = (bound("a_min"), bound("a_max"), bound("b_min"), bound("b_max"));
                let separated = b_min.lo > a_max.hi || a_min.lo > b_max.hi;
                let overlapping = a_min.hi < b_max.lo && b_min.hi < a_max.lo;
                let flags = (outcome.separated >> i & 1 == 1, outcome.overlapping >> i & 1 == 1);
                assert_eq!(flags, (separated, overlapping), "{axis} {p:?}");
            }
        }
    }
    assert!(seen.iter().all(|&n| n > 500), "{seen:?}");
}

/// Any number of pairs, hard ones and ones outside the declared ranges among them; in lanes every flag is compared.
#[test]
fn pairs_at_once_are_answered_as_each_alone() {
    let mut rng = ChaCha8Rng::seed_from_u64(16);
    let points = point_sets(17, 40);
    let (mut seen, mut laned) = ([0; 3], 0);
    for (i, p) in parameter_sets().into_iter().enumerate() {
        let p = Params { guard: [Guard::LeftOut, Guard::Always][i % 2], ..p };
        let (golden, test) = (Golden::new(&p), AxisTest::without(&p, Lossless::NONE));
        for pose in [Pose::identity(&p), query(&mut rng, &p).0] {
            let mut pairs: Vec<Pair> = points.iter().map(|points| unit_pair(points, &p)).collect();
            pairs.extend((0..20).map(|_| sample::random_pair_under(&mut rng, &p, &pose)));
            pairs.extend((0..5).map(|_| sample::corner_pair(&mut rng, &p)));
            pairs.shuffle(&mut rng);
            if test.laned {
                for pairs in pairs.chunks(LANES) {
                    let alone = pairs.iter().map(|pair| test.outcome::<false>(&pose, pair));
                    assert!(test.outcomes::<false>(&pose, pairs).eq(alone), "{pose:?} {pairs:?} {p:?}");
                    laned += pairs.len();
                }
            }
            if p.guarded() {
                for (number, how) in sample::Outside::ALL.into_iter().enumerate() {
                    let at = rng.random_range(0..=pairs.len());
                    let outside = sample::pair_outside(&mut rng, &p, pairs[0], 3 * number, how);
                    pairs.insert(at, outside);
                }
            }
            for count in [0, 1, LANES - 1, LANES, LANES + 1, pairs.len()] {
                let mut verdicts = vec![];
                golden.verdicts(&pose, &pairs[..count], &mut verdicts);
                let alone: Vec<Verdict> = pairs[..count].iter().map(|pair| golden.verdict(&pose, pair)).collect();
                assert_eq!(verdicts, alone, "{p:?}");
                alone.iter().for_each(|&verdict| seen[verdict as usize] += 1);
            }
        }
    }
    assert!(seen.iter().all(|&n| n > 500) && laned > 5000, "{seen:?} {laned}");
}

/// `skip` keeps vertex k of edge k, and vertex 0 on the triangle's own normal.
#[test]
fn skipping_keeps_the_vertices_of_the_contract() {
    let p = Params { axes: Axes::Seventeen, projections: Projections::Skip, ..Params::default() };
    let trace = Golden::new(&p).trace(&Pose::identity(&p), &Pair::default());
    let on = |axis: &str| {
        let prefix = format!("projection.{axis}.");
        trace.iter().filter_map(|(name, _)| name.strip_prefix(&prefix)).collect::<Vec<_>>().join(" ")
    };
    let expected = [
        ("n_a", "v0 w0 w1 w2"),
        ("n_b", "v0 v1 v2 w0"),
        ("c_00", "v0 v2 w0 w2"),
        ("c_12", "v0 v1 w1 w2"),
        ("c_20", "v1 v2 w0 w2"),
        ("n_a_a0", "v0 v2 w0 w1 w2"),
        ("n_a_a2", "v1 v2 w0 w1 w2"),
        ("n_b_b1", "v0 v1 v2 w0 w1"),
    ];
    for (axis, vertices) in expected {
        assert_eq!(on(axis), vertices, "{axis}");
    }
}

/// Samples near and far, coplanar, degenerate, and the collected hard cases.
fn point_sets(seed: u64, count: usize) -> Vec<Points> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut sets: Vec<Points> = (0..count).map(|_| random_points(&mut rng)).collect();
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/cases/hard-cases.json");
    if let Ok(text) = std::fs::read_to_string(path) {
        for case in serde_json::from_str::<Vec<serde_json::Value>>(&text).unwrap() {
            let triangle = |key: &str| serde_json::from_value::<[[f64; 3]; 3]>(case[key].clone()).unwrap();
            let (a, b) = (triangle("a"), triangle("b"));
            sets.push([a[0], a[1], a[2], b[0], b[1], b[2]]);
        }
    }
    // A false positive of binary64 predicates, coplanar up to rounding, and a vertex on a face.
    sets.push([
        [0.392347991466522, 0.384436011314392, 0.447445005178452],
        [0.39079749584197976, 0.3850367590785025, 0.45253425091505073],
        [0.387003496289253, 0.38789276033639897, 0.45634675025939975],
        [0.3892470002174375, 0.385637506842613, 0.4576234966516495],
        [0.39279749989509577, 0.37299175560474374, 0.455539248883724],
        [0.3876965045928953, 0.3862382546067235, 0.4627127423882482],
    ]);
    sets.push([[0., 0., 0.], [4., 0., 0.], [0., 4., 0.], [1., 1., 0.], [1., 1., 1.], [2., 1., 1.]]);
    sets
}

#[test]
fn definite_verdicts_are_right() {
    let sets = point_sets(9, 1500);
    let answers: Vec<Exact> = sets.iter().map(|points| exact::pair(points).unwrap()).collect();
    assert!(
        [Exact::Separate, Exact::Touch, Exact::Intersect]
            .iter()
            .all(|e| answers.iter().filter(|x| *x == e).count() > 20)
    );
    for p in parameter_sets() {
        let golden = Golden::new(&p);
        let mut definite = 0;
        for (points, &answer) in sets.iter().zip(&answers) {
            let verdict = golden.verdict(&Pose::identity(&p), &unit_pair(points, &p));
            assert!(sound(verdict, answer), "{verdict} but {answer}: {points:?} {p:?}");
            definite += usize::from(verdict != Verdict::PossiblyIncorrect);
        }
        assert!(p.width < 18 || !p.renormalise || definite > 300, "{definite} {p:?}");
    }
}

#[test]
fn definite_verdicts_under_poses_are_right() {
    let mut rng = ChaCha8Rng::seed_from_u64(10);
    let sets = point_sets(11, 40);
    for p in parameter_sets() {
        let golden = Golden::new(&p);
        for points in &sets {
            let (a, b) = ([points[0], points[1], points[2]], [points[3], points[4], points[5]]);
            let scene = SceneHost::new(&a, &b, &p).unwrap();
            let (m, t) = motion(&mut rng, points);
            let posed = scene.pose(&m, &t).unwrap();
            let verdict = match posed.pair([0, 1, 2], [0, 1, 2]) {
                Host::Unit(pair) => golden.verdict(&posed.pose, &pair),
                Host::Decided(verdict) => verdict,
            };
            let answer = exact::posed_pair(&a, &b, &m, &t).unwrap();
            assert!(sound(verdict, answer), "{verdict} but {answer}: {points:?} {m:?} {t:?} {p:?}");
        }
    }
}

/// A rotation about an axis of coordinates or a random one, that keeps B roughly in its place.
fn motion(rng: &mut ChaCha8Rng, points: &Points) -> ([[f64; 3]; 3], [f64; 3]) {
    let angle = [0.0, 0.0, 1e-9, 1.0, -2.5][rng.random_range(0..5)];
    let axis = nalgebra::Vector3::new(rng.random_range(-1.0..1.0), rng.random_range(-1.0..1.0), 0.3);
    let r = nalgebra::Rotation3::from_axis_angle(&nalgebra::Unit::new_normalize(axis), angle);
    let m = [0, 1, 2].map(|i| [0, 1, 2].map(|j| r[(i, j)]));
    let at = points[3];
    let t = match rng.random_range(0..4) {
        0 => [0.0; 3],
        1 => [1e6, 0.0, 0.0],
        _ => [0, 1, 2].map(|i| at[i] - (m[i][0] * at[0] + m[i][1] * at[1] + m[i][2] * at[2])),
    };
    (m, t)
}

/// Contract section 9: however a pair is written, it is never both `separate` and `intersect`, and identical inputs
/// give identical bits.
#[test]
fn no_way_of_writing_a_pair_changes_a_definite_verdict() {
    const ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
    let sets = point_sets(12, if full() { 60 } else { 20 });
    for p in parameter_sets().into_iter().step_by(3) {
        for points in &sets {
            let mut seen = [false; 3];
            for i in ORDERS {
                for j in ORDERS {
                    let (a, b) = (i.map(|i| points[i]), j.map(|j| points[3 + j]));
                    for [a, b] in [[a, b], [b, a]] {
                        seen[classified(&[a[0], a[1], a[2], b[0], b[1], b[2]], &p) as usize] = true;
                    }
                }
            }
            for i in ORDERS {
                for scale in [1.0, -0.25, 1024.0] {
                    let written = points.map(|x| [scale * x[i[0]], -scale * x[i[1]], scale * x[i[2]]]);
                    seen[classified(&written, &p) as usize] = true;
                }
            }
            // Multiples of 2^-20 can be moved exactly.
            let coarse = points.map(|x| x.map(|x| (x * 1048576.0).round() / 1048576.0));
            let mut moved = [false; 3];
            for shift in [0.0, 1.0, -777.0] {
                moved[classified(&coarse.map(|x| [x[0] + shift, x[1] - 3.0 * shift, x[2]]), &p) as usize] = true;
            }
            assert!(!(seen[0] && seen[1]), "{points:?} {p:?}");
            assert!(!(moved[0] && moved[1]), "{coarse:?} {p:?}");
            assert_eq!(classified(points, &p), classified(points, &p));
        }
    }
}

/// Contract section 9: more bits turn `possibly-incorrect` into a definite verdict, never one into the other.
#[test]
fn wider_is_never_contradictory() {
    for points in point_sets(13, 300) {
        let mut seen = [false; 3];
        for (width, transform_width) in [(6, 6), (8, 16), (10, 32), (14, 20), (18, 32), (24, 48), (32, 48)] {
            for upper in [Upper::Implied, Upper::Sticky] {
                let p = Params { width, transform_width, upper, ..Params::default() };
                seen[classified(&points, &p) as usize] = true;
            }
        }
        assert!(!(seen[0] && seen[1]), "{points:?}");
    }
}

/// The policies only ever narrow the enclosures: with `intersect` an axis says at least what it says with `all`.
#[test]
fn intersecting_duplicates_loses_nothing() {
    let mut rng = ChaCha8Rng::seed_from_u64(14);
    let all = Params { axes: Axes::Seventeen, ..Params::default() };
    let narrowed = Params { projections: Projections::Intersect, ..all.clone() };
    let (all_model, narrowed_model) = (Golden::new(&all), Golden::new(&narrowed));
    let mut gained = 0;
    for _ in 0..3000 {
        let pose = sample::random_pose(&mut rng, &all);
        let pair = sample::random_pair_under(&mut rng, &all, &pose);
        let (x, y) = (all_model.outcome(&pose, &pair), narrowed_model.outcome(&pose, &pair));
        assert_eq!((x.separated & !y.separated, x.overlapping & !y.overlapping), (0, 0));
        gained += usize::from(x.verdict != y.verdict);
    }
    assert!(gained > 0);
}

#[test]
fn samples_stay_inside_the_declared_ranges() {
    let mut rng = ChaCha8Rng::seed_from_u64(15);
    let inside = |x: Input, bound: i128| -bound <= x.lo.into() && i128::from(x.lo) + i128::from(x.sticky) <= bound;
    for p in parameter_sets() {
        for _ in 0..60 {
            for pose in [sample::random_pose(&mut rng, &p), sample::corner_pose(&mut rng, &p)] {
                assert!(pose.m.iter().flatten().all(|&x| inside(x, p.one())));
                assert!(pose.t.iter().all(|&x| inside(x, p.translation_bound())));
                for pair in [sample::random_pair_under(&mut rng, &p, &pose), sample::corner_pair(&mut rng, &p)] {
                    assert!(pair.a.iter().chain(&pair.b).flatten().all(|&x| inside(x, p.coordinate_bound())));
                }
            }
        }
    }
}

#[test]
fn verdicts_by_word() {
    let words = [Verdict::Separate, Verdict::Intersect, Verdict::PossiblyIncorrect].map(|v| v.to_string());
    assert_eq!(words, ["separate", "intersect", "possibly-incorrect"]);
}
