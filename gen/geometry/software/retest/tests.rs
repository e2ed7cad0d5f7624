//! The retest and each of its stages against the oracle.

use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use rayon::prelude::*;

use super::{Posed, Whole, common_extent, relation, retest, retest_batch, retest_kind, retest_parallel, retest_posed};
use crate::exact::{self, Exact};
use crate::finite::{NotFinite, Place};
use crate::rounds;
use crate::sample;
use crate::software::{interval_axes, robbins_whitesides};

type Points = [[f64; 3]; 6];

const ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];

/// All 72 ways to write the same pair.
fn orders(p: &Points) -> Vec<Points> {
    let each = ORDERS.iter().flat_map(|i| ORDERS.iter().map(move |j| (i.map(|i| p[i]), j.map(|j| p[3 + j]))));
    each.flat_map(|([a, b, c], [d, e, f])| [[a, b, c, d, e, f], [d, e, f, a, b, c]]).collect()
}

fn uniform(rng: &mut ChaCha8Rng) -> Points {
    [(); 6].map(|()| [(); 3].map(|()| rng.random_range(-1.0..1.0)))
}

/// Few values, so that triangles are often degenerate, coplanar, in contact or the same.
fn lattice(rng: &mut ChaCha8Rng) -> Points {
    let reach = rng.random_range(1..6);
    [(); 6].map(|()| [(); 3].map(|()| f64::from(rng.random_range(-reach..=reach))))
}

/// A vertex of B on the plane or an edge of A but for some units in the last place, B anywhere or tiny.
fn near_contact(rng: &mut ChaCha8Rng) -> Points {
    let mut p = uniform(rng);
    let (u, v) = (rng.random_range(0.0..1.0), if rng.random() { 0.0 } else { rng.random_range(0.0..1.0) });
    let ulps = f64::from(rng.random_range(-2..=2)) * f64::EPSILON;
    let at = [0, 1, 2].map(|i| p[0][i] + u * (p[1][i] - p[0][i]) + v * (1.0 - u) * (p[2][i] - p[0][i]) + ulps);
    let size = f64::from(-rng.random_range(0..40)).exp2();
    let anchor = p[3];
    p[3..].iter_mut().for_each(|x| *x = [0, 1, 2].map(|i| at[i] + (x[i] - anchor[i]) * size));
    p
}

/// Edges that cross or miss each other by some units in the last place.
fn edge_on_edge(rng: &mut ChaCha8Rng) -> Points {
    let mut p = uniform(rng);
    let (u, v) = (rng.random_range(0.0..1.0), rng.random_range(0.0..1.0));
    let ulps = f64::from(rng.random_range(-2..=2)) * f64::EPSILON;
    let at = |x: &[f64; 3], y: &[f64; 3], u: f64| [0, 1, 2].map(|i| x[i] + u * (y[i] - x[i]));
    let (on_a, on_b) = (at(&p[0], &p[1], u), at(&p[3], &p[4], v));
    p[3..].iter_mut().for_each(|x| *x = [0, 1, 2].map(|i| x[i] + (on_a[i] - on_b[i]) + ulps));
    p
}

/// Whole triangles in one plane through the origin with integral directions, exactly or nearly.
fn coplanar(rng: &mut ChaCha8Rng) -> Points {
    let [u, v] = [(); 2].map(|()| [(); 3].map(|()| f64::from(rng.random_range(-9..=9))));
    let grid = rng.random_range(1..9);
    let mut p = [(); 6].map(|()| {
        let [s, t] = [(); 2].map(|()| f64::from(rng.random_range(-grid..=grid)));
        [0, 1, 2].map(|i| s * u[i] + t * v[i])
    });
    if rng.random() {
        let factor = rng.random_range(0.1..10.0);
        p.as_flattened_mut().iter_mut().for_each(|x| *x *= factor);
    }
    p
}

/// Some vertices of B are vertices of A.
fn shared(rng: &mut ChaCha8Rng) -> Points {
    let mut p = near_contact(rng);
    for i in 3..6 {
        if rng.random() {
            p[i] = p[rng.random_range(0..3)];
        }
    }
    p
}

/// Long and thin, B through or past A.
fn slivers(rng: &mut ChaCha8Rng) -> Points {
    let mut p = near_contact(rng);
    for i in [0, 3] {
        let thin = f64::from(-rng.random_range(0..60)).exp2();
        p[i + 2] = [0, 1, 2].map(|x| p[i][x] + (p[i + 1][x] - p[i][x]) * 0.5 + (p[i + 2][x] - p[i][x]) * thin);
    }
    p
}

/// Segments and points.
fn degenerate(rng: &mut ChaCha8Rng) -> Points {
    let mut p = if rng.random() { near_contact(rng) } else { lattice(rng) };
    p[5] = p[rng.random_range(3..5)];
    if rng.random_range(0..3) == 0 {
        p[1] = p[0];
    }
    if rng.random_range(0..4) == 0 {
        p[4] = p[5];
    }
    p
}

/// Any finite numbers, all exponents alike.
fn any_bits(rng: &mut ChaCha8Rng) -> Points {
    let number = |rng: &mut ChaCha8Rng| loop {
        let x = f64::from_bits(rng.random());
        if x.is_finite() {
            return x;
        }
    };
    [(); 6].map(|()| [(); 3].map(|()| number(rng)))
}

/// As `points`, scaled into any part of the range of binary64, the axes alike or not.
fn scaled(rng: &mut ChaCha8Rng, points: &Points) -> Points {
    let reach = points.as_flattened().iter().fold(1.0, |m: f64, x| m.max(x.abs()));
    let common: i32 = rng.random_range(-1074..1023);
    let alike: bool = rng.random();
    let powers = [(); 3].map(|()| if alike { common } else { rng.random_range(-1074..1023) });
    // 2^1023 times a number up to 1; in two steps, since the least power is denormal.
    let scale = |x: f64, power: i32| x / reach * f64::from(power / 2).exp2() * f64::from(power - power / 2).exp2();
    points.map(|x| [0, 1, 2].map(|i| scale(x[i], powers[i])))
}

const KINDS: [fn(&mut ChaCha8Rng) -> Points; 10] = [
    sample::random_points,
    uniform,
    lattice,
    near_contact,
    edge_on_edge,
    coplanar,
    shared,
    slivers,
    degenerate,
    any_bits,
];

/// Pairs of all kinds, some of them at the ends of the range.
fn mixed(seed: u64, count: usize) -> Vec<Points> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let pair = |i: usize| {
        let mut points = KINDS[i % KINDS.len()](&mut rng);
        // Zeros of both signs are one.
        for x in points.as_flattened_mut().iter_mut().filter(|x| **x == 0.0) {
            *x = if rng.random() { 0.0 } else { -0.0 };
        }
        match rng.random_range(0..32) {
            0..2 => scaled(&mut rng, &points),
            // A coordinate that all have in common, however far away.
            2 => {
                let (axis, far) = (rng.random_range(0..3), f64::from(rng.random_range(-1074..1023)).exp2());
                points.map(|point| [0, 1, 2].map(|i| if i == axis { far } else { point[i] }))
            }
            _ => points,
        }
    };
    (0..count).map(pair).collect()
}

/// The answer of the last stage for posed pairs, which nothing moves.
fn at_rest([a0, a1, a2, b0, b1, b2]: &Points) -> Exact {
    let unit = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    relation(&Posed::new(&[*a0, *a1, *a2], &[*b0, *b1, *b2], &unit, &[0.0; 3])).class
}

/// Pairs that each stage has decided, and pairs by class.
#[derive(Default)]
struct Seen {
    stages: [u64; 4],
    classes: [u64; 3],
    wrong: Vec<String>,
}

impl Seen {
    fn add(mut self, points: &Points) -> Self {
        let truth = exact::pair(points).unwrap();
        let whole = common_extent(points, 0.0).and_then(|extent| Whole::of(points, extent));
        let whole = whole.map(|whole| relation(&whole).class);
        let closest = robbins_whitesides::decide(points);
        let stages = [interval_axes::decide(points), whole, closest.map(|relation| relation.class)];
        let decided = stages.iter().position(Option::is_some).unwrap_or(3);
        self.stages[decided] += 1;
        self.classes[truth as usize] += 1;
        let closed = stages[2].map(|_| robbins_whitesides::intersect(points));
        if stages.iter().any(|stage| stage.is_some_and(|found| found != truth))
            || closed.is_some_and(|found| found != (truth != Exact::Separate))
            || retest(points).unwrap() != truth
            || at_rest(points) != truth
            || retest_kind(points).unwrap() != exact::relation(points).unwrap().kind()
            || closest.is_some_and(|found| found != exact::relation(points).unwrap())
        {
            self.wrong.push(format!("{truth}, but {stages:?} {closed:?} {}: {points:?}", retest(points).unwrap()));
        }
        self
    }

    fn with(mut self, other: Self) -> Self {
        (0..4).for_each(|i| self.stages[i] += other.stages[i]);
        (0..3).for_each(|i| self.classes[i] += other.classes[i]);
        self.wrong.extend(other.wrong);
        self
    }
}

/// The lot in shares of their own seeds, so that the pairs do not depend on the number of threads.
fn against_the_oracle(shares: u64, share: usize) -> Seen {
    let one = |seed| mixed(seed, share).iter().fold(Seen::default(), Seen::add);
    (0..shares).into_par_iter().map(one).reduce(Seen::default, Seen::with)
}

#[test]
fn pairs_equal_the_oracle_at_every_stage() {
    pairs_equal_the_oracle(30);
}

#[test]
#[ignore = "takes long: scripts/test full"]
fn a_million_pairs_equal_the_oracle_at_every_stage() {
    pairs_equal_the_oracle(1000);
}

fn pairs_equal_the_oracle(thousands: u64) {
    let seen = against_the_oracle(thousands, 1024);
    assert!(seen.wrong.is_empty(), "{} wrong\n{}", seen.wrong.len(), seen.wrong[..seen.wrong.len().min(5)].join("\n"));
    assert!(seen.stages.iter().all(|&n| n > 10 * thousands), "{:?}", seen.stages);
    assert!(seen.classes.iter().all(|&n| n > 50 * thousands), "{:?}", seen.classes);
}

#[test]
fn a_batch_equals_single_pairs_in_every_lane_and_length() {
    let pairs = mixed(5000, 400);
    let expected: Vec<Exact> = pairs.iter().map(|p| exact::pair(p).unwrap()).collect();
    for start in 0..16 {
        for length in (0..40).chain(120..140).chain([300]) {
            let range = start..start + length;
            let mut answers = vec![Exact::Touch];
            retest_batch(&pairs[range.clone()], &mut answers).unwrap();
            assert_eq!(answers[0], Exact::Touch);
            assert_eq!(answers[1..], expected[range], "{start} {length}");
        }
    }
    // One pair that only the last stage decides, in every lane among pairs that the first one does.
    let tiny = f64::from_bits(1);
    let hard = [[0.0; 3], [tiny, 0.0, 0.0], [0.0, tiny, 0.0], [0.0, 0.0, tiny], [tiny, tiny, tiny], [tiny, tiny, 0.0]];
    let easy = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.2, 0.2, -1.0], [0.2, 0.3, 1.0], [0.31, 0.2, 0.9]];
    assert_eq!((exact::pair(&hard).unwrap(), interval_axes::decide(&hard)), (Exact::Separate, None));
    assert_eq!((robbins_whitesides::decide(&hard), interval_axes::decide(&easy)), (None, Some(Exact::Intersect)));
    for at in 0..70 {
        let mut pairs = vec![easy; 70];
        pairs[at] = hard;
        let mut answers = vec![];
        retest_batch(&pairs, &mut answers).unwrap();
        let expected: Vec<Exact> = (0..70).map(|i| if i == at { Exact::Separate } else { Exact::Intersect }).collect();
        assert_eq!(answers, expected, "{at}");
    }
}

#[test]
fn parallel_answers_are_in_order() {
    let pairs = mixed(6000, 3 * super::SHARE + 77);
    let mut expected = vec![];
    retest_batch(&pairs, &mut expected).unwrap();
    for threads in [1, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        assert!(pool.install(|| retest_parallel(&pairs).unwrap()) == expected, "{threads} threads");
    }
}

#[test]
fn the_filter_decides_random_pairs() {
    let mut rng = ChaCha8Rng::seed_from_u64(7000);
    for (distance, size) in [(0.0, 1.0), (1.0, 1.0), (0.0, 1e-60), (0.0, 1e60), (1e6, 1.0)] {
        let pairs: Vec<Points> =
            (0..50_000).map(|_| uniform(&mut rng).map(|x| x.map(|x| x * size + distance))).collect();
        let mut answers = vec![None; pairs.len()];
        interval_axes::decide_batch(&pairs, &mut answers);
        let undecided = answers.iter().filter(|answer| answer.is_none()).count();
        assert!(undecided * 1000 <= pairs.len(), "{undecided} at {distance} of {size}");
    }
}

/// Gaps down to the filter's bounds: a vertex above a face, edge above edge, at distances of 2^-30 to 2^-60.
#[test]
fn the_filter_is_right_and_sharp_next_to_contact() {
    let mut rng = ChaCha8Rng::seed_from_u64(8000);
    let mut decided = [0; 2];
    for round in 0..100_000 {
        let mut p = if round % 2 == 0 { near_contact(&mut rng) } else { edge_on_edge(&mut rng) };
        let gap = f64::from(-rng.random_range(30..60)).exp2();
        p[3..].iter_mut().for_each(|x| x[2] += gap);
        if let Some(found) = interval_axes::decide(&p) {
            assert_eq!(found, exact::pair(&p).unwrap(), "{p:?}");
            decided[usize::from(gap < (-40f64).exp2())] += 1;
        }
    }
    assert!(decided[0] > 20_000 && decided[1] > 100, "{decided:?}");
}

/// Triangles of B that are elsewhere by up to an error: what is certain of them is right of those that are meant.
#[test]
fn the_filter_is_right_of_points_that_are_off() {
    let mut rng = ChaCha8Rng::seed_from_u64(8500);
    let (mut decided, mut misled) = (0, 0);
    for round in 0..400 {
        let error = f64::from(-rng.random_range(10..50)).exp2();
        let mut near = || {
            let mut p = if round % 2 == 0 { near_contact(&mut rng) } else { edge_on_edge(&mut rng) };
            let away = error * f64::from(1 << rng.random_range(0..10)) * rng.random_range(-1.0..1.0);
            p[3..].iter_mut().for_each(|x| x[2] += away);
            // Together, or each corner elsewhere.
            let together = [0; 3].map(|_| rng.random_range(-1..=1));
            let apart = rng.random();
            let given = [0, 1, 2, 3, 4, 5].map(|corner| match corner {
                0..3 => p[corner],
                _ => [0, 1, 2].map(|axis| {
                    let way = if apart { rng.random_range(-1..=1) } else { together[axis] };
                    p[corner][axis] + 0.99 * error * f64::from(way)
                }),
            });
            (p, given)
        };
        let (meant, given): (Vec<Points>, Vec<Points>) = (0..101).map(|_| near()).unzip();
        let mut answers = vec![None; given.len()];
        interval_axes::decide_moved(&given, error, &mut answers);
        for ((meant, given), answer) in meant.iter().zip(&given).zip(answers) {
            let truth = exact::pair(meant).unwrap();
            if let Some(found) = answer {
                assert_eq!(found, truth, "off by {error}: {meant:?} {given:?}");
                decided += 1;
            }
            misled += usize::from(interval_axes::decide(given).is_some_and(|found| found != truth));
        }
    }
    assert!(decided > 5_000 && misled > 500, "{decided} decided, {misled} misled without the error");
}

#[test]
fn hard_cases_in_all_orders() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/cases/hard-cases.json");
    let Ok(text) = std::fs::read_to_string(path) else { return };
    let cases: Vec<serde_json::Value> = serde_json::from_str(&text).unwrap();
    assert!(cases.len() > 30);
    for case in &cases {
        let triangle = |key: &str| serde_json::from_value::<[[f64; 3]; 3]>(case[key].clone()).unwrap();
        let (a, b) = (triangle("a"), triangle("b"));
        let expected = case["expected"].as_str().unwrap();
        let written = orders(&[a[0], a[1], a[2], b[0], b[1], b[2]]);
        let mut batch = vec![];
        retest_batch(&written, &mut batch).unwrap();
        for (points, found) in written.iter().zip(batch) {
            assert_eq!(found.to_string(), expected, "{}", case["name"]);
            assert_eq!(retest(points).unwrap(), found, "{}", case["name"]);
            assert_eq!(robbins_whitesides::intersect(points), found != Exact::Separate, "{}", case["name"]);
        }
    }
}

#[test]
fn no_order_axis_or_scale_changes_the_answer() {
    let wrong: Vec<Points> = mixed(9000, 2000)
        .into_par_iter()
        .filter(|points| {
            let expected = exact::pair(points).unwrap();
            let turned = ORDERS.map(|axes| points.map(|x| [-x[axes[0]], x[axes[1]], x[axes[2]]]));
            orders(points).iter().chain(&turned).any(|written| retest(written).unwrap() != expected)
        })
        .collect();
    assert!(wrong.is_empty(), "{} wrong, {:?}", wrong.len(), wrong[0]);
}

/// The pose of a triangle that touches: rotations whose entries are short leave nothing to round, others do, and some leave binary64.
#[test]
fn posed_pairs_are_decided_as_they_are_given() {
    let mut rng = ChaCha8Rng::seed_from_u64(21);
    let (mut seen, mut exactly) = ([0; 3], 0);
    for round in 0..30_000 {
        let scale = [1.0, 2f64.powi(-500), 2f64.powi(500), 2f64.powi(-1040), 2f64.powi(900)][round % 5];
        let mut whole = |most: i32| f64::from(rng.random_range(-most..=most));
        let a = [(); 3].map(|()| [(); 3].map(|()| whole(3) * scale));
        let b = [(); 3].map(|()| [(); 3].map(|()| whole(3)));
        let m = [(); 3].map(|()| [(); 3].map(|()| whole(1) * scale));
        let mut t = [(); 3].map(|()| whole(2) * scale);
        if round % 3 == 0 {
            // One number that is long, or moves everything by less than anything shows.
            t[round / 3 % 3] +=
                [0.1, f64::EPSILON, 1e-30, -5e-324][round / 9 % 4] * if round % 2 == 0 { scale } else { 1.0 };
        }
        let expected = exact::posed_pair(&a, &b, &m, &t).unwrap();
        assert_eq!(retest_posed(&a, &b, &m, &t), Ok(expected), "{a:?} {b:?} {m:?} {t:?}");
        seen[expected as usize] += 1;
        let (points, error) = Posed::new(&a, &b, &m, &t).rounded();
        if error == 0.0 {
            exactly += 1;
            assert_eq!(exact::pair(&points), Ok(expected));
        }
    }
    assert!(seen.iter().all(|count| *count > 800) && (5_000..25_000).contains(&exactly), "{seen:?} {exactly}");
}

/// Rotations, which round everything, of pairs near contact: some are nearer than numbers of twice the length can tell.
#[test]
fn posed_pairs_near_contact_are_decided_as_they_are_given() {
    let mut rng = ChaCha8Rng::seed_from_u64(22);
    let turns = [
        [[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]],
        // About an axis: coordinates along it are exact.
        [
            [10f64.to_radians().cos(), -10f64.to_radians().sin(), 0.0],
            [10f64.to_radians().sin(), 10f64.to_radians().cos(), 0.0],
            [0.0, 0.0, 1.0],
        ],
    ];
    let mut seen = [0; 3];
    for round in 0..20_000 {
        let mut p = KINDS[round % 9](&mut rng);
        let (m, t) =
            (turns[round % 2], [[0.0; 3], [1e5, -7e4, 3e4], [0.0, 0.0, 1.0], [1e-200, 0.0, -5e-324]][round / 2 % 4]);
        match round % 3 {
            // Back by the transpose, but for the rounding.
            0 => p[3..].iter_mut().for_each(|x| *x = [0, 1, 2].map(|j| (0..3).map(|i| m[i][j] * (x[i] - t[i])).sum())),
            // On the axis of the turn, which does not move it.
            1 => {
                p[3] = [0.0, 0.0, p[3][2]];
                p[0] = [0, 1, 2].map(|i| t[i] + p[3][i]);
            }
            _ => p.iter_mut().for_each(|x| x[2] = 1.0),
        }
        let (a, b) = ([p[0], p[1], p[2]], [p[3], p[4], p[5]]);
        let expected = exact::posed_pair(&a, &b, &m, &t).unwrap();
        assert_eq!(retest_posed(&a, &b, &m, &t), Ok(expected), "{a:?} {b:?} {m:?} {t:?}");
        assert_eq!(relation(&Posed::new(&a, &b, &m, &t)).class, expected, "{a:?} {b:?} {m:?} {t:?}");
        seen[expected as usize] += 1;
    }
    assert!(seen.iter().all(|count| *count > 500), "{seen:?}");
}

#[test]
fn numbers_that_are_not_finite_are_refused_wherever_they_stand() {
    // A pair that every filter decides, and one that none does.
    let face = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
    let far = [face[0], face[1], face[2], [1.0, 1.0, 9.0], [1.0, 1.0, 10.0], [2.0, 1.0, 10.0]];
    let near = [face[0], face[1], face[2], [1.0, 1.0, 0.0], [1.0, 1.0, 1.0], [2.0, 1.0, 1.0]];
    for (pair, value) in
        [far, near].into_iter().flat_map(|pair| [f64::NAN, f64::INFINITY, -f64::INFINITY].map(|x| (pair, x)))
    {
        for index in (0..18).step_by(18 / rounds(18)) {
            let mut points = pair;
            points.as_flattened_mut()[index] = value;
            let place = |pair| Place::Pair { pair, corner: index / 3, axis: index % 3 };
            let refused = |place: Place, result: Result<(), NotFinite>| {
                let error = result.unwrap_err();
                assert!(error.place == place && error.value.to_bits() == value.to_bits(), "{error}");
            };
            refused(place(None), retest(&points).map(|_| ()));
            refused(place(None), exact::pair(&points).map(|_| ()));
            refused(place(None), exact::linear_programme::relation(&points).map(|_| ()));
            // At every place of a vector, and where none is full.
            let mut pairs = vec![pair; 77];
            for at in [0, 1, 2, 3, 6, 64, 76] {
                pairs[at] = points;
                let mut answers = vec![Exact::Touch];
                refused(place(Some(at)), retest_batch(&pairs, &mut answers));
                assert_eq!(answers, [Exact::Touch]);
                let many: Vec<Points> = pairs.iter().cycle().take(77 * 60).copied().collect();
                refused(place(Some(at)), retest_parallel(&many).map(|_| ()));
                let later: Vec<Points> = vec![pair; 5000].into_iter().chain(pairs.iter().copied()).collect();
                refused(place(Some(5000 + at)), retest_parallel(&later).map(|_| ()));
                pairs[at] = pair;
            }
        }
    }
    let numbers = |m, t| retest_posed(&face, &face, &m, &t).map(|_| ()).map_err(|e: NotFinite| e.to_string());
    let unit = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    assert_eq!(
        numbers(unit, [0.0, f64::NAN, 0.0]),
        Err("y of the translation is NaN: expected a finite number".to_owned())
    );
    let mut m = unit;
    m[1][2] = f64::INFINITY;
    let expected = "the entry in row 1, column 2 of the matrix is inf: expected a finite number";
    assert_eq!(numbers(m, [0.0; 3]), Err(expected.to_owned()));
}
