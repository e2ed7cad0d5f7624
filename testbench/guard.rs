//! The guard (docs/guard.md): a word outside the declared ranges is never answered definitely, and one inside is answered
//! as without a guard.

use crate::extent::share;
use efsat::design::guard::guard;
use efsat::design::number::{Number, input_type};
use efsat::design::{Design, Probes};
use efsat::evidence::cosim::inputs;
use efsat::exact::{self, Exact};
use efsat::golden::Golden;
use efsat::graph::evaluate::Evaluator;
use efsat::graph::{Block, Library, Signals};
use efsat::host::sample;
use efsat::op::Type;
use efsat::pair::{Input, Pair, Pose, Verdict};
use efsat::params::options::Choice;
use efsat::params::{Guard, Params, Transform, Upper};
use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;
use rayon::prelude::*;
use std::rc::Rc;

/// Whether the host would send the number: the real number that it stands for is within the bound.
fn sent(x: Input, upper: Upper, bound: i128) -> bool {
    let above = i128::from(upper == Upper::Sticky && x.sticky);
    -bound <= i128::from(x.lo) && i128::from(x.lo) + above <= bound
}

/// All words of the input format, with both sticky bits.
fn words(p: &Params) -> impl Iterator<Item = Input> {
    let end = 1i64 << (p.transform_width - 1);
    (-end..end).flat_map(|lo| [false, true].map(|sticky| Input { lo, sticky }))
}

/// Parameter sets with every kind of bound, at widths of which all words can be tried.
fn small() -> Vec<Params> {
    let mut sets = vec![];
    for (width, int_bits, transform_width) in [(6, 4, 6), (6, 4, 9), (8, 4, 8), (8, 5, 8), (8, 6, 11), (10, 8, 12)] {
        for &transform in Transform::ALL {
            for &upper in Upper::ALL {
                for &renormalise in bool::ALL {
                    let guard = Guard::Always;
                    let base = Params { width, int_bits, transform_width, ..Params::default() };
                    sets.push(Params { transform, upper, renormalise, guard, ..base });
                }
            }
        }
    }
    sets
}

/// The guard of one number by itself, for any word.
fn alone(p: &Params, bound: i128) -> Rc<Block> {
    Library::default().block("bench", &[], 1, |top| {
        let lo = top.input(input_type(p), input_type(p).limits());
        let sticky = (p.upper == Upper::Sticky).then(|| top.input(Type::FLAG, (0, 1)));
        let word = Number { lo, sticky }.named("word");
        let (passed, outside) = guard("guard", word, bound);
        (passed.lo.named("passed"), outside.named("outside"))
    })
}

/// Lemma guard: what comes out is within the bound, and it is the number wherever that is inside.
#[test]
fn guards_let_through_what_is_inside_and_nothing_else() {
    for p in small() {
        for bound in [p.coordinate_bound(), p.one(), p.translation_bound()] {
            let mut unit = Evaluator::new(&alone(&p, bound));
            let mut found = [0; 2];
            for x in words(&p) {
                let values = [i128::from(x.lo), i128::from(x.sticky)];
                unit.run(&values[..if p.upper == Upper::Sticky { 2 } else { 1 }]);
                let (passed, outside) = (unit.output("passed"), unit.output("outside") == 1);
                assert_eq!(outside, !sent(x, p.upper, bound), "{x:?}, bound {bound}\n{p:?}");
                assert!(outside || passed == values[0], "{x:?}, bound {bound}");
                let above = if p.upper == Upper::Sticky { values[1] } else { 0 };
                assert!(-bound <= passed && passed + above <= bound, "{x:?}, bound {bound}: {passed}");
                found[usize::from(outside)] += 1;
            }
            assert!(found[0] > 0 && found[1] > 0, "{found:?}");
        }
    }
}

#[test]
fn the_formats_of_a_guarded_unit_hold_for_every_word() {
    for p in small() {
        // The range analysis is part of making the design: it starts from these ranges.
        let design = Design::new(&p, Probes::None).unwrap();
        for input in &design.pipeline.inputs {
            let ty = design.pipeline.node(*input).ty;
            assert_eq!(design.pipeline.range(input.0), ty.limits(), "{p:?}");
        }
    }
}

#[test]
fn only_units_without_a_stage_have_one() {
    let guards = |p: &Params| {
        let design = Design::new(p, Probes::None).unwrap();
        let entities = design.top.hierarchy().iter().filter(|module| module.name.starts_with("guard_")).count();
        let ports = design.top.outputs.iter().filter(|(name, _)| name.to_string() == "out_outside").count();
        (entities, ports)
    };
    let with = |transform, renormalise, guard| guards(&Params { transform, renormalise, guard, ..Params::default() });
    assert_eq!(with(Transform::On, true, Guard::LeftOut), (0, 0));
    assert_eq!(with(Transform::On, true, Guard::Always), (2, 1));
    assert_eq!(with(Transform::On, false, Guard::LeftOut), (2, 1));
    assert_eq!(with(Transform::Translate, true, Guard::LeftOut), (2, 1));
    assert_eq!(with(Transform::Off, true, Guard::LeftOut), (1, 1));
}

/// A place of a number: coordinate 0 to 17 of the pair, then M and t of the pose.
fn put(pose: &mut Pose, pair: &mut Pair, place: usize, x: Input) {
    let numbers = pair.a.iter_mut().chain(&mut pair.b).flatten();
    let numbers = numbers.chain(pose.m.iter_mut().flatten()).chain(&mut pose.t);
    *numbers.into_iter().nth(place).expect("30 numbers") = x;
}

/// The exact answer where all numbers are exact and B = B~ or B~ + t.
fn exact_answer(p: &Params, pose: &Pose, pair: &Pair) -> Exact {
    let moved = p.transform != Transform::Off && !pose.bypass;
    let shift = |i: usize| if moved { pose.t[i].lo } else { 0 };
    let a = pair.a.map(|v| [0, 1, 2].map(|i| v[i].lo as f64));
    let b = pair.b.map(|w| [0, 1, 2].map(|i| (w[i].lo + shift(i)) as f64));
    exact::pair(&[a[0], a[1], a[2], b[0], b[1], b[2]]).unwrap()
}

/// Every word in one place: what is wrong about the answers, and how many of the definite ones changed to outside.
fn every_word(p: &Params, place: usize, seed: u64) -> Result<[usize; 2], String> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let golden = Golden::new(p);
    let complete = p.transform == Transform::On && p.renormalise;
    let unguarded = Golden::new(&Params { guard: Guard::LeftOut, ..p.clone() });
    let design = Design::new(p, Probes::None).unwrap();
    let mut graph = Evaluator::new(&design.pipeline);
    let exactly = |x: &mut Input| x.sticky = false;
    // A pair that is answered definitely, so that there is something to lose.
    let (pose, pair) = loop {
        let mut pose = sample::random_pose(&mut rng, p);
        if p.transform == Transform::Off || place < 18 {
            pose = Pose::identity(p);
        }
        let mut pair = sample::random_pair_under(&mut rng, p, &pose);
        pair.a.iter_mut().chain(&mut pair.b).flatten().for_each(exactly);
        pose.m.iter_mut().flatten().chain(&mut pose.t).for_each(exactly);
        let definite = golden.outcome(&pose, &pair).verdict != Verdict::PossiblyIncorrect;
        if definite && (place < 18 || !pose.bypass) {
            break (pose, pair);
        }
    };
    let bound = match place {
        0..18 => p.coordinate_bound(),
        18..27 => p.one(),
        _ => p.translation_bound(),
    };
    let mut counts = [0; 2];
    for x in words(p).filter(|x| p.upper == Upper::Sticky || !x.sticky) {
        let (mut pose, mut pair) = (pose, pair);
        put(&mut pose, &mut pair, place, x);
        let outcome = golden.outcome(&pose, &pair);
        let answer = || format!("place {place}, {x:?}: {outcome:?}\n{p:?}");
        // The graph is much slower: it is asked around the ends of the range, and now and then elsewhere.
        if (i128::from(x.lo).abs() - bound).abs() < 8 || x.lo % 64 == 0 {
            graph.run(&inputs(&design, &pose, &pair));
            let found = ["verdict", "separated", "overlapping", "outside"].map(|name| graph.output(name));
            let expected = [outcome.verdict as i128, outcome.separated.into(), outcome.overlapping.into()];
            if found[..3] != expected || found[3] != i128::from(outcome.outside) {
                return Err(format!("graph {found:?}, {}", answer()));
            }
        }
        let inside = sent(x, p.upper, bound);
        if inside == outcome.outside {
            return Err(answer());
        }
        if !inside {
            counts[1] += 1;
            if (outcome.verdict, outcome.separated, outcome.overlapping) != (Verdict::PossiblyIncorrect, 0, 0) {
                return Err(answer());
            }
            continue;
        }
        counts[0] += usize::from(outcome.verdict != Verdict::PossiblyIncorrect);
        if complete && unguarded.outcome(&pose, &pair) != outcome {
            return Err(answer());
        }
        if p.transform != Transform::On && !x.sticky {
            let exact = exact_answer(p, &pose, &pair);
            let wrong = match outcome.verdict {
                Verdict::Separate => exact != Exact::Separate,
                Verdict::Intersect => exact == Exact::Separate,
                Verdict::PossiblyIncorrect => false,
            };
            if wrong {
                return Err(format!("{exact:?} is right: {}", answer()));
            }
        }
    }
    Ok(counts)
}

#[test]
fn no_word_outside_is_answered_definitely() {
    let mut cases = vec![];
    for &transform in Transform::ALL {
        for &upper in Upper::ALL {
            for &renormalise in bool::ALL {
                let base = Params { width: 12, transform_width: 12, guard: Guard::Always, ..Params::default() };
                let p = Params { transform, upper, renormalise, axes_per_clock: 11, ..base };
                let places: &[usize] = match transform {
                    Transform::On => &[0, 4, 8, 9, 17, 18, 22, 27, 29],
                    Transform::Translate => &[1, 5, 6, 10, 14, 28],
                    Transform::Off => &[2, 3, 7, 11, 13],
                };
                cases.extend(places.iter().map(|place| (p.clone(), *place)));
            }
        }
    }
    let results: Vec<_> = share(2, &cases).par_iter().map(|(p, place)| every_word(p, *place, 3)).collect();
    let wrong: Vec<&String> = results.iter().filter_map(|result| result.as_ref().err()).collect();
    assert!(wrong.is_empty(), "{} of {}:\n{}", wrong.len(), cases.len(), wrong[0]);
    let sum = |i: usize| results.iter().flatten().map(|counts| counts[i]).sum::<usize>();
    assert!(sum(0) > 10_000 && sum(1) > 10_000, "{} definite inside, {} outside", sum(0), sum(1));
}
