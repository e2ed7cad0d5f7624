//! The driver against the exact oracle, with the stand-in as the unit.

use super::{Driver, DriverError, StandIn, Transfer, UnitAnswer};
use crate::golden::Golden;
use crate::pair::{Input, Outcome, Pair, Pose, Verdict};
use crate::params::{Axes, Guard, Method, Params, Transform, Upper};
use crate::words::{AnswerFields, StreamReport, StreamWidth, verdict_status};
use efsat_geometry::exact::{self, Exact};
use efsat_geometry::sample;
use efsat_hardware::testing::full;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

const WIDTHS: [StreamWidth; 3] = [StreamWidth::Bits32, StreamWidth::Bits64, StreamWidth::Bits128];

fn variants() -> Vec<Params> {
    let base = Params::default();
    vec![
        base.clone(),
        Params { upper: Upper::Sticky, tag_width: 64, axes: Axes::Seventeen, ..base.clone() },
        Params { transform_width: 48, tag_width: 0, ..base.clone() },
        Params { transform: Transform::Off, tag_width: 1, upper: Upper::Sticky, ..base.clone() },
        Params { width: 12, transform_width: 16, transform: Transform::Translate, ..base },
    ]
}

fn pairs(count: usize) -> Vec<[[f64; 3]; 6]> {
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    (0..count).map(|_| sample::random_points(&mut rng)).collect()
}

#[test]
fn final_answers_of_loose_pairs_are_exact() {
    let pairs = pairs(150);
    for params in variants() {
        for width in WIDTHS {
            let driver = Driver::new(&params, width).unwrap();
            let job = driver.loose(&pairs).unwrap();
            let answers = StandIn::new(&params, width).unwrap().answer(job.transfers());
            assert_eq!(answers.len(), job.answers_due());
            let results = job.finish(&answers).unwrap();
            let expected: Vec<Exact> = pairs.iter().map(|points| exact::pair(points).unwrap()).collect();
            assert_eq!(results.answers, expected, "{}", params.command_line());
            let s = results.statistics;
            assert_eq!((s.host_separate, s.unit_separate + s.unit_intersect + s.retested), (0, pairs.len()));
            assert!(s.unit_separate > 10 && s.retested > 10, "{s:?}");
        }
    }
}

#[test]
fn final_answers_of_posed_meshes_are_exact() {
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    let mut mesh = |count: usize| -> Vec<[f64; 3]> {
        (0..count).map(|_| [0, 1, 2].map(|_| rng.random_range(-1.0..1.0))).collect()
    };
    let (a, b) = (mesh(12), mesh(12));
    let triangles: Vec<([u32; 3], [u32; 3])> =
        (0..10).flat_map(|i| (0..10).map(move |j| ([i, i + 1, i + 2], [j, j + 1, j + 2]))).collect();
    let turn = [[0.6, -0.8, 0.0], [0.8, 0.6, 0.0], [0.0, 0.0, 1.0]];
    let identity = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let poses = [(turn, [0.3, 0.2, 0.1]), (identity, [0.5, 0.0, 0.0]), (turn, [40.0, 0.0, 0.0])];
    let mut host_separate = 0;
    for params in variants() {
        let driver = Driver::new(&params, StreamWidth::Bits64).unwrap();
        let meshes = driver.meshes(&a, &b).unwrap();
        let mut unit = StandIn::new(&params, StreamWidth::Bits64).unwrap();
        for (m, t) in &poses {
            let job = meshes.pose(m, t, &triangles).unwrap();
            let answers = unit.answer(job.transfers());
            let results = job.finish(&answers).unwrap();
            let corners = |mesh: &[[f64; 3]], triangle: [u32; 3]| triangle.map(|i| mesh[i as usize]);
            let exact =
                |(i, j): &([u32; 3], [u32; 3])| exact::posed_pair(&corners(&a, *i), &corners(&b, *j), m, t).unwrap();
            assert_eq!(results.answers, triangles.iter().map(exact).collect::<Vec<_>>(), "{}", params.command_line());
            host_separate += results.statistics.host_separate;
        }
    }
    assert!(host_separate > 100, "the far pose is outside the declared ranges");
}

/// The exact unit tells touching pairs from others, and what it does not take is decided by the host.
#[test]
fn final_answers_of_the_exact_unit_are_exact() {
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    let mut lattice = || [(); 6].map(|()| [(); 3].map(|()| f64::from(rng.random_range(-3..=3)) / 8.0));
    let mut given: Vec<[[f64; 3]; 6]> = (0..400).map(|_| lattice()).collect();
    given.extend(pairs(50));
    for (transform, exact_clocks) in [
        (Transform::Off, None),
        (Transform::Translate, None),
        (Transform::Off, Some(16)),
        (Transform::Translate, Some(16)),
    ] {
        let params = Params { transform, exact_clocks, ..Params::of(Method::Exact) };
        let driver = Driver::new(&params, StreamWidth::Bits64).unwrap();
        let job = driver.loose(&given).unwrap();
        let answers = StandIn::new(&params, StreamWidth::Bits64).unwrap().answer(job.transfers());
        let results = job.finish(&answers).unwrap();
        assert_eq!(results.answers, given.iter().map(|points| exact::pair(points).unwrap()).collect::<Vec<_>>());
        assert!(results.answers[..400].iter().filter(|answer| **answer == Exact::Touch).count() > 10);
        let s = results.statistics;
        assert_eq!((s.unit_separate + s.unit_intersect, s.host_separate + s.retested), (400, 50));
    }
}

#[test]
fn answers_that_do_not_fit_are_refused() {
    let params = Params::default();
    let width = StreamWidth::Bits64;
    let driver = Driver::new(&params, width).unwrap();
    let pairs = pairs(3);
    let good = StandIn::new(&params, width).unwrap().answer(driver.loose(&pairs).unwrap().transfers());
    let finish = |answers: &[Transfer]| driver.loose(&pairs).unwrap().finish(answers).map(|_| ());
    assert_eq!(finish(&good), Ok(()));
    assert_eq!(finish(&good[..3]), Err(DriverError::Count { expected: 4, found: 3 }));
    assert_eq!(finish(&[&good[..], &good[3..]].concat()), Err(DriverError::Count { expected: 4, found: 5 }));
    let swapped = [good[0], good[2], good[1], good[3]];
    assert_eq!(finish(&swapped), Err(DriverError::Order { at: 1 }));
    assert_eq!(finish(&good[1..]), Err(DriverError::Order { at: 0 }), "the pose was not answered");
    let mut late = good.clone();
    late[2].last = true;
    assert_eq!(finish(&late), Err(DriverError::Order { at: 2 }));
    let mut unknown = good.clone();
    unknown[1].data = unknown[1].data.flipped(63);
    assert!(matches!(finish(&unknown), Err(DriverError::Word { at: 1, .. })));

    // A word is lost on the way: the unit notices.
    let mut lost = driver.loose(&pairs).unwrap().transfers().to_vec();
    lost.remove(12);
    let answers = StandIn::new(&params, width).unwrap().answer(&lost);
    assert!(finish(&answers).is_err());
    assert_eq!(driver.unpack(answers.last().unwrap().data), Some(UnitAnswer::Report(StreamReport::TooShort)));
}

#[test]
fn a_design_refuses_what_was_packed_for_another() {
    let pairs = pairs(2);
    for params in &variants()[1..] {
        let packed = Driver::new(params, StreamWidth::Bits64).unwrap().loose(&pairs).unwrap().transfers().to_vec();
        let driver = Driver::new(&Params::default(), StreamWidth::Bits64).unwrap();
        for answer in StandIn::new(&Params::default(), StreamWidth::Bits64).unwrap().answer(&packed) {
            assert_eq!(driver.unpack(answer.data), Some(UnitAnswer::Report(StreamReport::UnknownHeader)));
        }
    }
}

#[test]
fn bytes_are_little_endian_words() {
    let driver = Driver::new(&Params::default(), StreamWidth::Bits64).unwrap();
    let words = [Transfer { data: 0x0102.into(), last: false }, Transfer { data: 3.into(), last: true }];
    let bytes = driver.bytes(&words);
    assert_eq!(bytes, [2, 1, 0, 0, 0, 0, 0, 0, 3, 0, 0, 0, 0, 0, 0, 0]);
    assert_eq!(driver.packet(&bytes).unwrap(), words, "answers of this design have 64 bits too");
    assert_eq!(driver.packet(&bytes[1..]), Err(DriverError::Bytes { found: 15, word: 8 }));
}

#[test]
fn poses_and_numbers_that_the_words_do_not_hold_are_refused() {
    let with = |transform| Params { transform, ..Params::default() };
    let driver = |params: &Params| Driver::new(params, StreamWidth::Bits64).unwrap();
    let bypassed = Pose::identity(&Params::default());
    let still = Pose { bypass: false, ..bypassed };
    let (mut moved, mut turned) = (still, still);
    moved.t[1] = Input::exact(5);
    turned.m[0][0].lo -= 1;
    let refused = |transform, pose: &Pose| driver(&with(transform)).pack_pose(pose).is_err();
    for (transform, expected) in [(Transform::On, [false, false]), (Transform::Translate, [false, true])] {
        assert_eq!([&moved, &turned].map(|pose| refused(transform, pose)), expected);
    }
    assert_eq!(
        [&bypassed, &still, &moved, &turned].map(|pose| refused(Transform::Off, pose)),
        [false, false, true, true]
    );
    assert!(!refused(Transform::Translate, &Pose { bypass: true, ..turned }), "with the bypass M is not read");

    let driver = driver(&Params { transform_width: 18, ..Params::default() });
    let mut pair = Pair::default();
    pair.b[2][1] = Input::exact(-(1 << 17));
    assert!(driver.pack_pairs([(0, &pair)]).is_err(), "s4.14 holds it, but 1 is the end of the declared range");
    pair.b[2][1].lo = 1 - (1 << 14);
    assert!(driver.pack_pairs([(0, &pair)]).is_ok());
    pair.b[2][1].lo -= 2;
    let error = driver.pack_pairs([(0, &pair)]).unwrap_err().to_string();
    assert_eq!(error, "coordinate 16: found -16385; expected -16384 to 16384");
    moved.m = Pose::identity(&Params { transform_width: 18, ..Params::default() }).m;
    moved.t[0].lo = 65_529;
    let error = driver.pack_pose(&moved).unwrap_err().to_string();
    assert_eq!(error, "entry of t 9: found 65529; expected -65528 to 65528");
    moved.m[1][0].lo = -(1 << 14) - 1;
    let error = driver.pack_pose(&moved).unwrap_err().to_string();
    assert_eq!(error, "entry of M 3: found -16385; expected -16384 to 16384");
    moved.bypass = true;
    assert!(driver.pack_pose(&moved).is_ok(), "with the bypass the numbers are not read");
    moved.t[0].lo = 1 << 17;
    assert!(driver.pack_pose(&moved).is_err(), "but are not cut, either");
    let unguarded = Params { guard: Guard::LeftOut, ..Params::default() };
    let unguarded = Driver::new(&unguarded, StreamWidth::Bits64).unwrap();
    assert_eq!(unguarded.passing_all().unwrap_err(), DriverError::Unguarded);

    // A number above its lower bound is below the end.
    let params = Params { upper: Upper::Sticky, ..Params::default() };
    let driver = Driver::new(&params, StreamWidth::Bits64).unwrap();
    let mut pair = Pair::default();
    pair.a[0][2] = Input { lo: 1 << 28, sticky: false };
    assert!(driver.pack_pairs([(0, &pair)]).is_ok());
    pair.a[0][2].sticky = true;
    let error = driver.pack_pairs([(0, &pair)]).unwrap_err().to_string();
    assert_eq!(error, "coordinate 2: found 268435456; expected -268435456 to 268435455");
}

/// The units of all methods, with what changes the flags or the verdict.
fn units() -> Vec<Params> {
    let base = Params::default();
    let exact = Params { transform: Transform::Translate, ..Params::of(Method::Exact) };
    vec![
        Params { axes: Axes::Seventeen, edge_test: false, ..base.clone() },
        Params { axes: Axes::Seventeen, edge_test: true, upper: Upper::Sticky, ..base.clone() },
        Params { guard: Guard::Always, width: 12, ..base },
        Params::of(Method::Determinants),
        Params { width: 10, transform: Transform::Translate, ..Params::of(Method::Determinants) },
        exact.clone(),
        Params { exact_clocks: Some(16), ..exact },
    ]
}

/// No answer that a unit gives contradicts itself.
#[test]
fn answers_of_units_do_not_contradict_themselves() {
    let mut rng = ChaCha8Rng::seed_from_u64(21);
    for params in units() {
        let driver = Driver::new(&params, StreamWidth::Bits64).unwrap();
        let golden = Golden::new(&params);
        let mut verdicts = [0; 3];
        for _ in 0..60_000 {
            let pose = crate::host::sample::random_pose(&mut rng, &params);
            let pair = match rng.random_range(0..4) {
                0 => crate::host::sample::corner_pair(&mut rng, &params),
                _ => crate::host::sample::random_pair_under(&mut rng, &params, &pose),
            };
            let Outcome { verdict, separated, overlapping, outside } = golden.outcome(&pose, &pair);
            let status = verdict_status(verdict as u8, outside);
            let word = driver.format().answer(&AnswerFields { status, tag: 3, separated, overlapping });
            assert!(driver.unpack(word.into()).is_some(), "{word:#x}: {}", params.command_line());
            verdicts[verdict as usize] += 1;
        }
        assert!(verdicts.iter().all(|count| *count > 50), "{verdicts:?}: {}", params.command_line());
    }
}

/// Words are changed on their way, in ways that can be recognised: no wrong answer is accepted.
#[test]
fn damage_that_can_be_recognised_is_never_accepted() {
    let mut rng = ChaCha8Rng::seed_from_u64(22);
    // Each unit gets pairs on a grid, too, which is all that the exact unit takes.
    let mut given = pairs(40);
    let mut lattice = || [(); 6].map(|()| [(); 3].map(|()| f64::from(rng.random_range(-3..=3)) / 8.0));
    given.extend((0..40).map(|_| lattice()));
    let expected: Vec<Exact> = given.iter().map(|points| exact::pair(points).unwrap()).collect();
    for params in units() {
        let driver = Driver::new(&params, StreamWidth::Bits64).unwrap();
        let job = || driver.loose(&given).unwrap();
        let good = StandIn::new(&params, StreamWidth::Bits64).unwrap().answer(job().transfers());
        let (mut refused, mut tried) = (0, 0);
        let (first, rounds) = (good.len() - job().sent(), if full() { 4_000 } else { 1_000 });
        for round in 0..rounds {
            let mut answers = good.clone();
            let at = rng.random_range(first..good.len());
            let other = rng.random_range(first..good.len());
            match round % 5 {
                0 => answers[at].data = answers[at].data.flipped(rng.random_range(0..8)),
                1 => answers[at].data = answers[other].data,
                2 => {
                    (answers[at].data, answers[other].data) = (answers[other].data, answers[at].data);
                }
                3 => _ = answers.remove(at),
                _ => answers.insert(at, answers[other]),
            }
            tried += usize::from(answers != good);
            match job().finish(&answers) {
                Ok(results) => assert_eq!(results.answers, expected, "round {round}: {}", params.command_line()),
                Err(_) => refused += 1,
            }
        }
        // What is accepted is *outside* in place of another *possibly incorrect*, which is retested as well.
        assert!(refused > tried * 97 / 100 && tried > rounds / 2, "{refused} of {tried}: {}", params.command_line());
    }
}

#[test]
fn what_is_no_number_is_refused_with_its_place() {
    let driver = Driver::new(&Params::default(), StreamWidth::Bits64).unwrap();
    let mut given = pairs(2);
    given[1][2][0] = f64::NAN;
    assert_eq!(driver.loose(&given).unwrap_err().to_string(), "pair 1: x of a2 is NaN: expected a finite number");
    let mesh = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, f64::INFINITY]];
    let refused = |a: &[[f64; 3]], b: &[[f64; 3]]| driver.meshes(a, b).unwrap_err().to_string();
    assert_eq!(refused(&mesh, &mesh[..2]), "z of vertex 2 of mesh a is inf: expected a finite number");
    assert_eq!(refused(&mesh[..2], &mesh), "z of vertex 2 of mesh b is inf: expected a finite number");
    let meshes = driver.meshes(&mesh[..2], &mesh[..2]).unwrap();
    let pairs = [([0, 0, 1], [0, 1, 1])];
    let pose = |m: &[[f64; 3]; 3], t: &[f64; 3]| meshes.pose(m, t, &pairs).map(drop).map_err(|e| e.to_string());
    let mut m = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    assert_eq!(pose(&m, &[0.0; 3]), Ok(()));
    let refused = Err("z of the translation is -inf: expected a finite number".to_owned());
    assert_eq!(pose(&m, &[0.0, 0.0, f64::NEG_INFINITY]), refused);
    m[1][2] = f64::NAN;
    assert_eq!(
        pose(&m, &[0.0; 3]),
        Err("the entry in row 1, column 2 of the matrix is NaN: expected a finite number".to_owned())
    );
}

#[test]
fn a_pair_outside_is_told_and_never_definite() {
    let params = Params { transform: Transform::Translate, transform_width: 20, ..Params::default() };
    let strict = Driver::new(&params, StreamWidth::Bits64).unwrap();
    let driver = strict.clone().passing_all().unwrap();
    let mut unit = StandIn::new(&params, StreamWidth::Bits64).unwrap();
    let one = params.one() as i64;
    // One above the other.
    let triangle = |z: i64| [[0, 0, z], [one, 0, z], [0, one, z]].map(|v| v.map(Input::exact));
    let pair = Pair { a: triangle(0), b: triangle(one) };
    let mut far = pair;
    far.b[1][2].lo += 1;
    assert!(matches!(strict.pack_pairs([(2, &far)]), Err(DriverError::Number { index: 14, .. })));
    let answers = unit.answer(&driver.pack_pairs([(1, &pair), (2, &far)]).unwrap());
    let told: Vec<UnitAnswer> = answers.iter().map(|t| driver.unpack(t.data).unwrap()).collect();
    let outcomes = told.iter().map(|answer| match answer {
        UnitAnswer::Pair { outcome, .. } => (outcome.verdict, outcome.outside),
        UnitAnswer::Report(report) => panic!("{report:?}"),
    });
    let expected = [(Verdict::Separate, false), (Verdict::PossiblyIncorrect, true)];
    assert_eq!(outcomes.collect::<Vec<_>>(), expected);
    // No unit says so of a definite verdict, and none without a guard at all.
    assert_eq!(driver.unpack(answers[0].data.flipped(4)), None);
    let complete = Params { transform_width: 20, guard: Guard::LeftOut, ..Params::default() };
    let complete = Driver::new(&complete, StreamWidth::Bits64).unwrap();
    assert_eq!(complete.unpack(answers[1].data), None);
    // A number that is cut to another one on its way: its field is more than the unit reads. The first word after the
    // header has flags and tag, the next one the first number.
    let mut words = driver.pack_pairs([(3, &pair)]).unwrap();
    words[2].data = words[2].data.flipped(20);
    let cut = unit.answer(&words);
    assert!(matches!(driver.unpack(cut[0].data), Some(UnitAnswer::Pair { tag: 3, outcome }) if outcome.outside));
}
