//! The three layers of truth agree: reference model = evaluated graph = built-in simulation = GHDL.
//!
//! Every option is varied over its range one at a time, then in seeded combinations; inner signals are
//! compared in a part of them and GHDL takes a few, unless everything is asked for. The comparison of answers includes the flags of every axis, so
//! that a parameter set whose verdicts are all possibly-incorrect is checked too.

use crate::baseline::hardware::Names;
use crate::extent::{full, share};
use crate::tools::ghdl;
use efsat::artefact::Stimulus;
use efsat::design::{Design, Probes};
use efsat::evidence::cosim::{self, Options, Simulator};
use efsat::exact::{Exact, relation};
use efsat::golden::Golden;
use efsat::graph::evaluate::Evaluator;
use efsat::host::{Host, SceneHost};
use efsat::mesh::Mesh;
use efsat::pair::{Input, Pair, Pose, Verdict};
use efsat::params::options::Choice;
use efsat::params::{
    Axes, Bound, CLOCKS_PER_PAIR, Guard, LEVELS, Method, Params, ProjectionWidth, Projections, SPAN, Transform, Truth,
    Upper,
};
use efsat::scene::{Meeting, Scene};
use rand::{SeedableRng, seq::IndexedRandom};
use rayon::prelude::*;
use std::collections::{BTreeMap, HashSet};
use std::sync::OnceLock;

/// A parameter set and what it is there for.
type Case = (String, Params);

/// Every option over its range, one at a time, the others as given.
fn varied(others: &Params) -> Vec<Case> {
    let mut cases: Vec<Case> = vec![("no change".to_owned(), others.clone())];
    let mut case = |name: String, change: &dyn Fn(&mut Params)| {
        let mut p = others.clone();
        change(&mut p);
        p.validate().unwrap_or_else(|e| panic!("{name}: {e}"));
        cases.push((name, p));
    };
    for width in [6, 7, 8, 12, 19, 24, 25, 32] {
        case(format!("width {width}"), &|p| {
            (p.width, p.transform_width) = (width, p.transform_width.max(width));
        });
    }
    for width in [6, 7, 18, 32] {
        case(format!("transform-width = width {width}"), &|p| (p.width, p.transform_width) = (width, width));
    }
    for transform_width in [18, 19, 33, 35, 36, 48] {
        case(format!("transform-width {transform_width}"), &|p| p.transform_width = transform_width);
    }
    for int_bits in 5..=8 {
        case(format!("int-bits {int_bits}"), &|p| p.int_bits = int_bits);
    }
    for n in 2..=11 {
        case(format!("axes-per-clock {n}"), &|p| p.axes_per_clock = n);
    }
    for n in [1, 2, 3, 5, 6, 9, 11, 12, 17] {
        case(format!("axes 17, axes-per-clock {n}"), &|p| (p.axes, p.axes_per_clock) = (Axes::Seventeen, n));
    }
    for projections in [Projections::Skip, Projections::Intersect] {
        case(format!("projections {projections:?}"), &|p| p.projections = projections);
        case(format!("projections {projections:?}, axes 17"), &|p| {
            (p.projections, p.axes, p.axes_per_clock) = (projections, Axes::Seventeen, 3);
        });
    }
    case("projections All".to_owned(), &|p| p.projections = Projections::All);
    for width in [ProjectionWidth::Rounded, ProjectionWidth::Plus(0), ProjectionWidth::Full] {
        case(format!("projection-width {width:?}"), &|p| p.projection_width = width);
    }
    for axis_shift in [0, 1, 2, 3, 16, 30] {
        case(format!("axis-shift {axis_shift}"), &|p| p.axis_shift = axis_shift);
        case(format!("axis-shift {axis_shift}, upper sticky"), &|p| {
            (p.axis_shift, p.upper) = (axis_shift, Upper::Sticky);
        });
    }
    for projections in [Projections::All, Projections::Skip, Projections::Intersect] {
        case(format!("edge-test off, projections {projections:?}"), &|p| {
            (p.edge_test, p.projections) = (false, projections);
        });
    }
    case("like-paper".to_owned(), &|p| *p = Params { tag_width: p.tag_width, ..Params::paper() });
    case("upper sticky".to_owned(), &|p| p.upper = Upper::Sticky);
    for (transform, renormalise) in [
        (Transform::On, false),
        (Transform::Translate, true),
        (Transform::Translate, false),
        (Transform::Off, true),
        (Transform::Off, false),
    ] {
        case(format!("transform {transform:?}, renormalise {renormalise}"), &|p| {
            (p.transform, p.renormalise) = (transform, renormalise);
        });
    }
    for transform in [Transform::On, Transform::Translate, Transform::Off] {
        for (axes, axes_per_clock, upper) in [(Axes::Eleven, 1, Upper::Sticky), (Axes::Seventeen, 2, Upper::Implied)] {
            case(format!("guard always, transform {transform:?}, axes {axes:?}"), &|p| {
                (p.guard, p.transform) = (Guard::Always, transform);
                (p.axes, p.axes_per_clock, p.upper) = (axes, axes_per_clock, upper);
            });
        }
    }
    for n in [3, 11] {
        case(format!("guard always, axes-per-clock {n}"), &|p| (p.guard, p.axes_per_clock) = (Guard::Always, n));
    }
    for frequency in [20, 50, 133, 200, 250] {
        case(format!("frequency {frequency}"), &|p| p.frequency = frequency);
    }
    for device in efsat::device::names() {
        case(format!("device {device}"), &|p| p.device = device.to_owned());
    }
    for tag_width in [0, 1, 31, 33, 64] {
        case(format!("tag-width {tag_width}"), &|p| p.tag_width = tag_width);
    }
    cases
}

/// The options of the determinant unit, each over its range and some together, the others as given.
fn determinants(others: &Params) -> Vec<Case> {
    let base = Params { method: Method::Determinants, ..others.clone() };
    let mut cases: Vec<Case> = vec![];
    let mut case = |name: String, change: &dyn Fn(&mut Params)| {
        let mut p = base.clone();
        change(&mut p);
        p.validate().unwrap_or_else(|e| panic!("{name}: {e}"));
        cases.push((format!("determinants, {name}"), p));
    };
    for transform in [Transform::On, Transform::Translate, Transform::Off] {
        for &clocks in CLOCKS_PER_PAIR {
            case(format!("transform {transform:?}, clocks-per-pair {clocks}"), &|p| {
                (p.transform, p.clocks_per_pair) = (transform, clocks);
            });
        }
        case(format!("transform {transform:?}, guard always"), &|p| {
            (p.transform, p.guard, p.clocks_per_pair) = (transform, Guard::Always, 3);
        });
    }
    for bound in [Bound::Static, Bound::Edges, Bound::Moments, Bound::Products] {
        for (&span, &levels) in SPAN.iter().flat_map(|span| LEVELS.iter().map(move |levels| (span, levels))) {
            case(format!("bound {bound:?}, span {span}, levels {levels}"), &|p| {
                (p.bound, p.span, p.levels) = (bound, span, levels);
                (p.boxes, p.clocks_per_pair) = (span != 1, if levels == 2 { 2 } else { 1 });
            });
        }
    }
    for (width, transform_width) in
        [(6, 6), (6, 12), (7, 20), (12, 24), (18, 34), (18, 35), (18, 48), (19, 32), (32, 48)]
    {
        for (bound, clocks) in [(Bound::Moments, 1), (Bound::Products, 6)] {
            case(format!("width {width}, transform-width {transform_width}, bound {bound:?}"), &|p| {
                (p.width, p.transform_width, p.bound, p.clocks_per_pair) = (width, transform_width, bound, clocks);
            });
        }
    }
    for (device, frequency) in efsat::device::names().into_iter().zip([50, 133, 200, 100]) {
        case(format!("device {device}, frequency {frequency}"), &|p| {
            (p.device, p.frequency, p.tag_width) = (device.to_owned(), frequency, 0);
        });
    }
    cases
}

/// The options of the exact unit, each over its range and some together.
fn exact() -> Vec<Case> {
    let mut cases: Vec<Case> = vec![];
    let mut case = |width: u32, transform_width: u32, clocks_per_pair: u32, transform: Transform| {
        let p = Params { width, transform_width, clocks_per_pair, transform, ..Params::of(Method::Exact) };
        p.validate().unwrap_or_else(|e| panic!("{e}"));
        cases.push((format!("exact, width {width}, {transform:?}, clocks-per-pair {clocks_per_pair}"), p));
    };
    for &clocks in CLOCKS_PER_PAIR {
        case(18, 32, clocks, Transform::Off);
        case(18, 20, clocks, Transform::Translate);
    }
    for (width, transform_width) in [(6, 6), (7, 18), (9, 12), (10, 10), (12, 48), (19, 32), (27, 32), (32, 32)] {
        case(width, transform_width, 1, Transform::Off);
        case(width, transform_width, 3, Transform::Translate);
    }
    // On the last one factors have registers of their own from 134 MHz on.
    for (device, frequency) in efsat::device::names().into_iter().zip([50, 133, 200, 140]) {
        let p = Params { device: device.to_owned(), frequency, tag_width: 0, ..Params::of(Method::Exact) };
        cases.push((format!("exact, device {device}, frequency {frequency}"), p));
    }
    for (width, transform_width, clocks_per_pair, exact_clocks, transform) in [
        (32, 32, 1, 16, Transform::Off),
        (6, 6, 1, 11, Transform::Off),
        (9, 12, 2, 14, Transform::Translate),
        (18, 32, 1, 15, Transform::Translate),
        (19, 24, 6, 30, Transform::Off),
        (27, 48, 11, 32, Transform::Translate),
    ] {
        let exact_clocks = Some(exact_clocks);
        let p =
            Params { width, transform_width, clocks_per_pair, exact_clocks, transform, ..Params::of(Method::Exact) };
        cases.push((format!("cascade, width {width}, {transform:?}, {clocks_per_pair} and {exact_clocks:?}"), p));
    }
    for (width, transform_width, clocks_per_pair, exact_clocks) in [
        (18, 19, 1, None),
        (18, 24, 2, None),
        (8, 8, 3, None),
        (22, 22, 6, None),
        (12, 15, 11, None),
        (20, 20, 1, Some(16)),
        (32, 32, 3, Some(20)),
    ] {
        let p = Params { width, transform_width, clocks_per_pair, exact_clocks, ..Params::snapped() };
        cases.push((
            format!("snapped, width {width}, {transform_width} bits, {clocks_per_pair} and {exact_clocks:?}"),
            p,
        ));
    }
    for (device, frequency) in efsat::device::names().into_iter().zip([50, 133, 150, 100]) {
        let (device, exact_clocks) = (device.to_owned(), Some(16));
        let p = Params { device, frequency, exact_clocks, tag_width: 0, ..Params::of(Method::Exact) };
        cases.push((format!("cascade, device {}, frequency {frequency}", p.device), p));
    }
    cases
}

fn others_than_axes() -> Vec<Case> {
    [determinants(&Params::default()), exact()].concat()
}

const WIDTHS: [ProjectionWidth; 4] =
    [ProjectionWidth::Rounded, ProjectionWidth::Plus(2), ProjectionWidth::Plus(31), ProjectionWidth::Full];

fn combined(count: usize) -> Vec<Case> {
    let mut rng = rand::rngs::ChaCha8Rng::seed_from_u64(2009);
    let mut cases = vec![];
    while cases.len() < count {
        let axes = *[Axes::Eleven, Axes::Seventeen].choose(&mut rng).unwrap();
        let p = Params {
            width: *[6, 7, 12, 18, 19, 24, 32].choose(&mut rng).unwrap(),
            int_bits: *[4, 5, 6, 8].choose(&mut rng).unwrap(),
            transform_width: *[18, 20, 32, 36, 48].choose(&mut rng).unwrap(),
            axes,
            axes_per_clock: *[1, 2, 3, 5, 11, 17].choose(&mut rng).unwrap(),
            projections: *[Projections::All, Projections::Skip, Projections::Intersect].choose(&mut rng).unwrap(),
            projection_width: *WIDTHS.choose(&mut rng).unwrap(),
            axis_shift: *[0, 1, 3, 7, 30].choose(&mut rng).unwrap(),
            edge_test: *[true, false].choose(&mut rng).unwrap(),
            upper: *[Upper::Implied, Upper::Sticky].choose(&mut rng).unwrap(),
            renormalise: *[true, false].choose(&mut rng).unwrap(),
            transform: *[Transform::On, Transform::Translate, Transform::Off].choose(&mut rng).unwrap(),
            guard: *[Guard::LeftOut, Guard::Always].choose(&mut rng).unwrap(),
            device: (*efsat::device::names().choose(&mut rng).unwrap()).to_owned(),
            frequency: *[20, 66, 100, 150, 250].choose(&mut rng).unwrap(),
            tag_width: *[0, 8, 16].choose(&mut rng).unwrap(),
            method: *[Method::Axes, Method::Axes, Method::Determinants, Method::Exact].choose(&mut rng).unwrap(),
            clocks_per_pair: *CLOCKS_PER_PAIR.choose(&mut rng).unwrap(),
            exact_clocks: *[None, Some(11), Some(16)].choose(&mut rng).unwrap(),
            span: *SPAN.choose(&mut rng).unwrap(),
            levels: *LEVELS.choose(&mut rng).unwrap(),
            bound: *Bound::ALL.choose(&mut rng).unwrap(),
            boxes: *[true, false].choose(&mut rng).unwrap(),
            ..Params::default()
        };
        if p.validate().is_ok() {
            cases.push((format!("combination {}", cases.len()), p));
        }
    }
    cases
}

fn options(simulator: Simulator, probe: bool) -> Options {
    Options { simulator, keep: None, wave: None, probe }
}

/// The scene, a meeting of it, and pairs of triangles that are candidates there.
type SceneSample = (Scene, Meeting, Vec<(u32, u32)>);

/// A few candidate pairs of the default scene in one of its poses, as the unit of a parameter set reads them.
fn scene_segment(p: &Params) -> (Pose, Vec<Pair>) {
    static CHOSEN: OnceLock<SceneSample> = OnceLock::new();
    let (scene, meeting, pairs) = CHOSEN.get_or_init(|| {
        let scene = Scene::default_scene();
        let near = scene.near();
        let meetings = (0..scene.frames()).step_by(30).flat_map(|frame| near.meetings(frame));
        let candidates = meetings.map(|meeting| (near.pairs(&meeting), meeting));
        let (all, meeting) = candidates.max_by_key(|(pairs, _)| pairs.len()).expect("the scene has poses");
        drop(near);
        let step = (all.len() / 8).max(1);
        let pairs = all.iter().copied().step_by(step).collect();
        (scene, meeting, pairs)
    });
    let points = |mesh: &Mesh| -> Vec<[f64; 3]> { mesh.vertices().iter().map(|v| [v.x, v.y, v.z]).collect() };
    let [a, b] = [0, 1].map(|object: usize| scene.objects[object].mesh.as_ref());
    let host = SceneHost::new(&points(a), &points(b), p).unwrap();
    let pose = &meeting.pose;
    let m = pose.rows();
    let placed = host.pose(&m, &[pose.translation().x, pose.translation().y, pose.translation().z]).unwrap();
    let unit = |(p, q): &(u32, u32)| match placed.pair(a.faces()[*p as usize], b.faces()[*q as usize]) {
        Host::Unit(pair) => Some(pair),
        Host::Decided(_) => None,
    };
    (placed.pose, pairs.iter().filter_map(unit).collect())
}

/// Random and corner vectors, then vectors of the default scene.
fn stimulus(p: &Params, pairs: usize) -> Stimulus {
    let mut stimulus = Stimulus::random(p, pairs, 7);
    let segment = scene_segment(p);
    if !segment.1.is_empty() {
        stimulus.segments.push(segment);
    }
    if p.method == Method::Exact {
        equals_oracle(p, &stimulus);
    }
    stimulus
}

/// A vertex of B behind the pose, in ulps of the input format.
fn moved(p: &Params, pose: &Pose, w: [i64; 3]) -> [i64; 3] {
    let (t, f) = (pose.t.map(|x| x.lo), p.transform_width - p.int_bits);
    match p.transform {
        _ if pose.bypass => w,
        Transform::Off => w,
        Transform::Translate => [0, 1, 2].map(|j| w[j] + t[j]),
        Transform::On => [0, 1, 2].map(|i| {
            // Section 2 of docs/determinants.md: middles, less the products of two low parts of more than 18 bits.
            let q = Some((f + 3).saturating_sub(18)).filter(|q| 2 * q <= f).unwrap_or(0);
            let products = (0..3).map(|j| {
                let (x, y) = (2 * i128::from(pose.m[i][j].lo) + 1, 2 * i128::from(w[j]) + 1);
                x * y - x.rem_euclid(1 << q) * y.rem_euclid(1 << q)
            });
            let left_out = if q > 0 { 3 << (2 * q - 1) } else { 0 };
            let row = (products.sum::<i128>() + left_out + (1 << (f + 1))).div_euclid(1 << (f + 2));
            row as i64 + t[i]
        }),
    }
}

/// Whether all numbers that are read are inside the declared ranges of a unit with the frame transform.
fn inside_the_ranges(p: &Params, pose: &Pose, pair: &Pair) -> bool {
    let one = p.one() as i64;
    let inside = |x: &Input, bound: i64| (-bound..=bound).contains(&x.lo);
    let pose_is = pose.m.iter().flatten().all(|x| inside(x, one))
        && pose.t.iter().all(|x| inside(x, p.translation_bound() as i64));
    pair.a.iter().chain(&pair.b).flatten().all(|x| inside(x, one)) && (pose.bypass || pose_is)
}

/// The answers of the exact unit's model, which those of the hardware are compared with, are the oracle's.
fn equals_oracle(p: &Params, stimulus: &Stimulus) {
    let golden = Golden::new(p);
    let mut decided = 0;
    for (pose, pairs) in &stimulus.segments {
        for pair in pairs {
            let b = pair.b.map(|vertex| moved(p, pose, vertex.map(|x| x.lo)));
            let at = |i: usize, j: usize| if i < 3 { pair.a[i][j].lo } else { b[i - 3][j] };
            let points: [[f64; 3]; 6] = std::array::from_fn(|i| std::array::from_fn(|j| at(i, j) as f64));
            let reach = (1 << (p.width - 1)) - 1;
            let inside = p.truth == Truth::Given || inside_the_ranges(p, pose, pair);
            let fits = inside && (1..6).all(|i| (0..3).all(|j| (at(i, j) - at(0, j)).abs() <= reach));
            let (truth, found) = (relation(&points).unwrap(), golden.outcome(pose, pair));
            let expected = match truth.class {
                _ if !fits => Verdict::PossiblyIncorrect,
                truth => truth.into(),
            };
            let crosses = fits && truth.class == Exact::Intersect;
            assert_eq!((found.verdict, found.outside), (expected, !fits), "{points:?}: {truth}");
            assert_eq!(found.overlapping & 1 == 1, crosses, "{points:?}: {truth}");
            decided += u32::from(fits);
        }
    }
    assert!(decided > 0, "no pair fits");
}

#[test]
fn scene_vectors_reach_the_unit() {
    assert!(scene_segment(&Params::default()).1.len() >= 8);
}

/// The report of a run that agrees in every bit, and in the initiation interval; otherwise what differs.
fn agrees(name: &str, p: &Params, pairs: usize, simulator: Simulator, probe: bool) -> Result<cosim::Report, String> {
    let report = cosim::run(p, "test", &stimulus(p, pairs), &options(simulator, probe));
    let report = report.map_err(|e| format!("{name}: {e}\n{p:?}"))?;
    if report.mismatches > 0 || report.initiation_interval != p.interval() as u64 {
        return Err(format!("{name}: {report:?}\n{p:?}"));
    }
    Ok(report)
}

/// Runs a check on all cases, on all cores, and fails with everything that went wrong.
fn all_hold(cases: &[Case], check: impl Fn(&str, &Params) -> Result<(), String> + Sync) {
    let failures: Vec<String> = cases.par_iter().filter_map(|(name, p)| check(name, p).err()).collect();
    assert!(failures.is_empty(), "{} of {} cases:\n{}", failures.len(), cases.len(), failures.join("\n"));
}

#[test]
fn builtin_agrees_with_the_reference_model_in_every_option_value() {
    let cases = share(2, [varied(&Params::default()), others_than_axes()].concat());
    let pairs = if full() { 60 } else { 6 };
    all_hold(&cases, |name, p| agrees(name, p, pairs, Simulator::Builtin, true).map(|_| ()));
}

#[test]
fn builtin_agrees_with_the_reference_model_in_combinations() {
    let cases = combined(if full() { 2000 } else { 12 });
    all_hold(&cases, |name, p| agrees(name, p, 100, Simulator::Builtin, true).map(|_| ()));
}

/// The register behind what is chosen in a phase was taken for one that holds it for the pair.
#[test]
fn a_delay_is_no_hold() {
    let p = Params {
        axes: Axes::Seventeen,
        axes_per_clock: 11,
        renormalise: false,
        device: "xc7a200t-1".to_owned(),
        frequency: 60,
        ..Params::default()
    };
    agrees("17 axes, 2 clocks", &p, 100, Simulator::Builtin, true).unwrap();
}

#[test]
fn flags_tell_more_than_verdicts_where_all_verdicts_are_possibly_incorrect() {
    // At small widths hardly a verdict is definite; the flags still take many values.
    let p = Params { width: 8, ..Params::default() };
    let golden = Golden::new(&p);
    let stimulus = Stimulus::random(&p, 400, 3);
    let outcomes = stimulus.segments.iter().flat_map(|(pose, pairs)| pairs.iter().map(|x| golden.outcome(pose, x)));
    let flags: HashSet<(u32, u32)> = outcomes.map(|o| (o.separated, o.overlapping)).collect();
    assert!(flags.len() > 20, "{} different flag words", flags.len());
}

/// The nodes of the data path that are signals of the reference model's trace: node, phase, signal, and 1 for an upper bound.
fn traced(p: &Params, design: &Design, stimulus: &Stimulus) -> Vec<(usize, usize, String, usize)> {
    let evaluator = Evaluator::new(&design.pipeline);
    let mut found = vec![];
    if p.method != Method::Axes {
        // Nodes are called after the signals.
        let (pose, pairs) = &stimulus.segments[0];
        // The verdict is compared as an answer: the trace has that of the numbers that a guard lets through.
        for (signal, _) in Golden::new(p).trace(pose, &pairs[0]).into_iter().filter(|(signal, _)| signal != "verdict") {
            let node = evaluator.flat().top_node(&signal.replacen('.', "_", 1));
            found.extend(node.map(|node| (node, 0, signal, 0)));
        }
        return found;
    }
    let names = Names::new(p, &stimulus.segments);
    for probe in &design.probes {
        let node = evaluator.flat().top_node(&probe.name).expect("a node");
        for (phase, _) in &probe.clocks {
            let signal = names.signal(&probe.name, *phase).filter(|(signal, _)| !signal.starts_with("flags."));
            found.extend(signal.map(|(signal, part)| (node, *phase, signal, part)));
        }
    }
    found
}

#[test]
fn graph_equals_reference_model_in_every_inner_signal() {
    let cases = share(28, [varied(&Params::default()), combined(20), others_than_axes()].concat());
    cases.par_iter().for_each(|(name, p)| {
        let design = Design::new(p, Probes::All).unwrap_or_else(|e| panic!("{name}: {e}"));
        let golden = Golden::new(p);
        let mut evaluator = Evaluator::new(&design.pipeline);
        let stimulus = Stimulus::random(p, 40, 11).followed_by(Stimulus::outside(p));
        let nodes = traced(p, &design, &stimulus);
        let mut second = design.second.as_ref().map(|second| Evaluator::new(&second.pipeline));
        let mut open = [0; 2];
        let least = match p.method {
            Method::Axes => 2 * (18 + 18 + 33 + 44),
            // Differences, coordinates, moments, determinants but two that are sums on the way to their signs; bounds, if they
            // are not constant.
            Method::Determinants => 15 + 15 + 12 + 13,
            Method::Exact if p.exact_clocks.is_some() => 15 + 15 + 12 + 13,
            // Differences, moments, determinants, components.
            Method::Exact => 15 + 12 + 13 + 6,
        };
        let names = || nodes.iter().map(|(_, _, signal, _)| signal.as_str()).collect::<Vec<_>>();
        assert!(nodes.len() >= least, "{name}: {} signals compared: {:?}", nodes.len(), names());
        for (pose, pairs) in &stimulus.segments {
            for pair in pairs {
                evaluator.run(&cosim::inputs(&design, pose, pair));
                let trace: BTreeMap<_, _> = golden.trace(pose, pair).into_iter().collect();
                for (node, phase, signal, part) in &nodes {
                    let x = trace.get(signal).unwrap_or_else(|| panic!("{name}: the model has no {signal}"));
                    let expected = [x.lo, x.hi][*part];
                    assert_eq!(evaluator.at(*node, *phase), expected, "{name}: {signal}, bound {part}\n{p:?}");
                }
                let outcome = golden.outcome(pose, pair);
                let is_open = golden.is_open(pose, pair);
                open[usize::from(is_open)] += 1;
                let mut decides = &evaluator;
                if let Some(second) = &mut second {
                    assert_eq!(evaluator.output("left_open"), i128::from(is_open), "{name}");
                    if is_open {
                        assert_eq!(evaluator.output("verdict"), Verdict::PossiblyIncorrect as i128, "{name}");
                        let differences = golden.trace(pose, pair).into_iter().take(15);
                        second.run(&differences.map(|(_, x)| x.lo).collect::<Vec<_>>());
                        decides = second;
                    }
                }
                assert_eq!(decides.output("verdict"), outcome.verdict as i128, "{name}");
                assert_eq!(decides.output("separated"), i128::from(outcome.separated), "{name}");
                assert_eq!(decides.output("overlapping"), i128::from(outcome.overlapping), "{name}");
                if p.guarded() {
                    assert_eq!(evaluator.output("outside"), i128::from(outcome.outside), "{name}");
                }
            }
        }
        assert!(second.is_none() || open.iter().all(|count| *count > 0), "{name}: {open:?} pairs are decided and open");
    });
}

/// Runs GHDL and the built-in simulator on the same stimulus; answers, latency and clock counts must be the same.
fn ghdl_equals_builtin(name: &str, p: &Params) -> Result<(), String> {
    let [ghdl, builtin] = [Simulator::Ghdl, Simulator::Builtin].map(|s| agrees(name, p, 12, s, true));
    let numbers = |r: &cosim::Report| (r.cycles, r.latency, r.initiation_interval, r.total_clocks, r.vectors);
    let [ghdl, builtin] = [numbers(&ghdl?), numbers(&builtin?)];
    if ghdl == builtin { Ok(()) } else { Err(format!("{name}: GHDL {ghdl:?}, built-in {builtin:?}\n{p:?}")) }
}

#[test]
fn ghdl_agrees_in_option_values() {
    if ghdl().is_none() {
        return;
    }
    // Narrow but for the widths under test: GHDL takes many times as long as the built-in simulator, which runs them all.
    let narrow = Params { width: 10, transform_width: 14, ..Params::default() };
    all_hold(&share(62, [varied(&narrow), determinants(&narrow)].concat()), ghdl_equals_builtin);
}

#[test]
fn ghdl_agrees_in_cascades_and_with_snapped_geometry() {
    if ghdl().is_none() {
        return;
    }
    let narrow = |clocks_per_pair, exact_clocks, transform| {
        let (width, transform_width, exact_clocks) = (9, 12, Some(exact_clocks));
        let p =
            Params { width, transform_width, clocks_per_pair, exact_clocks, transform, ..Params::of(Method::Exact) };
        (format!("cascade, {clocks_per_pair} and {exact_clocks:?}"), p)
    };
    let wide = Params { width: 32, exact_clocks: Some(16), ..Params::of(Method::Exact) };
    let mut cases =
        vec![("wide cascade".to_owned(), wide), narrow(1, 11, Transform::Translate), narrow(3, 15, Transform::Off)];
    for (clocks_per_pair, exact_clocks) in [(1, None), (2, None), (2, Some(12))] {
        let p = Params { width: 8, transform_width: 8, clocks_per_pair, exact_clocks, ..Params::snapped() };
        cases.push((format!("snapped, {clocks_per_pair} and {exact_clocks:?}"), p));
    }
    all_hold(&share(4, cases), ghdl_equals_builtin);
}

#[test]
fn ghdl_agrees_in_combinations() {
    if ghdl().is_none() {
        return;
    }
    let mut cases = combined(60);
    if !full() {
        cases.sort_by_key(|(_, p)| p.width as usize * p.axes_per_clock);
        cases.truncate(2);
    }
    all_hold(&cases, ghdl_equals_builtin);
}

#[test]
fn a_broken_design_is_caught_and_the_first_wrong_node_named() {
    // The design of one parameter set against the vectors of another that has the same ports.
    let p = Params::default();
    let other = Params { projections: Projections::Intersect, ..p.clone() };
    let design = Design::new(&other, Probes::None).unwrap();
    let stimulus = Stimulus::random(&p, 200, 5);
    let wrong = Design { params: p.clone(), ..design };
    let report = cosim::run_design(&wrong, "test", &stimulus, &options(Simulator::Builtin, false)).unwrap();
    assert!(report.mismatches > 0 && report.first_mismatch.unwrap().contains("expected"));
}

#[test]
fn a_wrong_inner_node_is_named_with_both_values() {
    // The modules of one format against the graph of another with the same ports and names.
    let p = Params::default();
    let other = Design::new(&Params { int_bits: 5, ..p.clone() }, Probes::All).unwrap();
    let wrong = Design { pipeline: other.pipeline, ..Design::new(&p, Probes::All).unwrap() };
    let report = cosim::run_design(&wrong, "test", &Stimulus::random(&p, 40, 5), &options(Simulator::Builtin, true));
    let message = report.unwrap().first_mismatch.unwrap();
    assert!(message.contains("node b") && message.contains("expected"), "{message}");
}
