//! The tests against the exact answer: right where they should be, and wrong, in the known direction, where their kind is.

use super::*;
use crate::exact::{self, Exact};
use crate::rounds;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

const ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];

/// All 72 ways to write the same pair.
fn orders(p: &Points) -> impl Iterator<Item = Points> + '_ {
    ORDERS.iter().flat_map(move |i| {
        ORDERS.iter().flat_map(move |j| {
            let (a, b) = (i.map(|i| p[i]), j.map(|j| p[3 + j]));
            [[a[0], a[1], a[2], b[0], b[1], b[2]], [b[0], b[1], b[2], a[0], a[1], a[2]]]
        })
    })
}

fn is_contact(points: &Points) -> bool {
    exact::pair(points).unwrap() != Exact::Separate
}

/// Missed contacts and false ones of a test.
fn errors(test: Test, pairs: &[Points]) -> (usize, usize) {
    let (mut missed, mut wrongly_seen) = (0, 0);
    for points in pairs {
        match (is_contact(points), test.intersect(points).unwrap()) {
            (true, false) => missed += 1,
            (false, true) => wrongly_seen += 1,
            _ => {}
        }
    }
    (missed, wrongly_seen)
}

fn pairs(seed: u64, count: usize, mut make: impl FnMut(&mut ChaCha8Rng) -> Points) -> Vec<Points> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    (0..count).map(|_| make(&mut rng)).collect()
}

fn cube(rng: &mut ChaCha8Rng) -> Points {
    [(); 6].map(|()| [(); 3].map(|()| rng.random_range(-1.0..1.0)))
}

/// Points of the plane z = 0 on a coarse grid, so that all determinants are exact.
fn flat(rng: &mut ChaCha8Rng) -> Points {
    [(); 6].map(|()| [f64::from(rng.random_range(-9..=9)), f64::from(rng.random_range(-9..=9)), 0.0])
}

fn is_proper(points: &Points) -> bool {
    let doubled_area = |t: [[f64; 3]; 3]| {
        let normal = vector::Plane::through(t).normal;
        vector::dot(normal, normal)
    };
    vector::triangles(points).into_iter().all(|t| doubled_area(t) > 0.0)
}

/// Those that are right on segments and points, too.
const EXACT: [Test; 2] = [Test::RobbinsWhitesides, Test::Retest];

#[test]
fn the_list_is_complete_and_has_distinct_names() {
    for (number, test) in Test::ALL.iter().enumerate() {
        assert_eq!(*test as usize, number);
        assert!(test.source().contains("19") || test.source().contains("20"));
        assert_eq!(Test::ALL.iter().filter(|other| other.name() == test.name()).count(), 1);
    }
}

#[test]
fn all_are_right_on_random_pairs() {
    let pairs = pairs(1, rounds(20_000), cube);
    let contacts = pairs.iter().filter(|p| is_contact(p)).count();
    assert!((rounds(2_000)..rounds(18_000)).contains(&contacts), "{contacts}");
    let wrong: Vec<_> = Test::ALL.iter().map(|&t| (t.name(), errors(t, &pairs))).filter(|w| w.1 != (0, 0)).collect();
    assert!(wrong.is_empty(), "{wrong:?}");
}

#[test]
fn no_order_of_the_vertices_changes_an_answer_on_proper_pairs() {
    let pairs = pairs(2, rounds(400), cube);
    let written: Vec<Points> = pairs.iter().flat_map(orders).collect();
    let wrong: Vec<_> = Test::ALL.iter().map(|&t| (t.name(), errors(t, &written))).filter(|w| w.1 != (0, 0)).collect();
    assert!(wrong.is_empty(), "{wrong:?}");
}

/// On a grid everything is exact: contact, vertices in the other's plane, coplanar pairs.
#[test]
fn touching_and_coplanar_pairs_on_a_grid() {
    let grid = |rng: &mut ChaCha8Rng| [(); 6].map(|()| [(); 3].map(|()| f64::from(rng.random_range(-2..=2))));
    let solid: Vec<Points> = pairs(3, 40_000, grid).into_iter().filter(is_proper).collect();
    let coplanar: Vec<Points> = pairs(4, 20_000, flat).into_iter().filter(is_proper).collect();
    let count = |pairs: &[Points], class: Exact| pairs.iter().filter(|p| exact::pair(p).unwrap() == class).count();
    assert!(count(&solid, Exact::Touch) > 3000 && count(&coplanar, Exact::Separate) > 3000);
    assert!(count(&coplanar, Exact::Touch) > 300 && count(&coplanar, Exact::Intersect) > 3000);
    for test in [Test::SeparatingAxes17F64, Test::SeparatingAxes17F32, Test::GuigueDevillers] {
        assert_eq!((errors(test, &solid), errors(test, &coplanar)), ((0, 0), (0, 0)), "{}", test.name());
    }
    for test in [Test::Moeller, Test::MoellerEpsilon, Test::Held] {
        assert_eq!(errors(test, &coplanar), (0, 0), "{}", test.name());
        // Interpolated ends are rounded: a few contacts at a third of an edge go wrong, in both directions.
        let (missed, wrongly_seen) = errors(test, &solid);
        assert!(missed + wrongly_seen < solid.len() / 100, "{}: {missed} {wrongly_seen}", test.name());
    }
}

#[test]
fn coplanar_pairs_in_all_orders() {
    let written: Vec<Points> = pairs(5, 300, flat).iter().filter(|p| is_proper(p)).flat_map(orders).collect();
    for test in [Test::SeparatingAxes17F64, Test::GuigueDevillers, Test::Moeller, Test::Held] {
        assert_eq!(errors(test, &written), (0, 0), "{}", test.name());
    }
}

#[test]
fn eleven_axes_separate_no_coplanar_pair() {
    let coplanar = pairs(6, 3000, flat);
    let separate = coplanar.iter().filter(|p| !is_contact(p)).count();
    assert!(separate > 1000);
    for test in [Test::SeparatingAxes11F64, Test::SeparatingAxes11F32] {
        assert_eq!(errors(test, &coplanar), (0, separate), "{}", test.name());
    }
}

/// Triangles of 1e-2 in parallel planes 1e-3 apart: plane distances are 1e-4 * 1e-3, below the epsilon.
#[test]
fn moellers_epsilon_takes_small_triangles_for_coplanar() {
    let small = [[0.0, 0.0, 0.0], [0.01, 0.0, 0.0], [0.0, 0.01, 0.0]];
    let above = small.map(|[x, y, _]| [x, y, 1e-3]);
    let points = [small[0], small[1], small[2], above[0], above[1], above[2]];
    assert!(!is_contact(&points));
    for test in Test::ALL.iter().copied() {
        assert_eq!(test.intersect(&points).unwrap(), test == Test::MoellerEpsilon, "{}", test.name());
    }
    // A hundred times larger the same pair is right.
    let larger = points.map(|point| point.map(|x| 100.0 * x));
    assert!(!Test::MoellerEpsilon.intersect(&larger).unwrap());
    // At a thousandth of the size nearly all random pairs that are near each other are taken for contacts.
    let tiny: Vec<Points> = pairs(7, 3000, cube).into_iter().map(|p| p.map(|x| x.map(|x| x / 1024.0))).collect();
    let (missed, wrongly_seen) = errors(Test::MoellerEpsilon, &tiny);
    assert!(wrongly_seen > 500 && missed < 100, "{missed} {wrongly_seen}");
    assert_eq!(errors(Test::Moeller, &tiny), (0, 0));
}

/// A gap of 1e-9 on numbers about 1 is no gap in binary32.
#[test]
fn binary32_does_not_see_what_binary64_sees() {
    let base = [[1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 0.0, 1.0]];
    let beside = [[1.0 + 1e-9, 0.25, 0.25], [2.0, 1.0, 0.0], [2.0, 0.0, 1.0]];
    let points = [base[0], base[1], base[2], beside[0], beside[1], beside[2]];
    assert!(!is_contact(&points));
    for test in Test::ALL.iter().copied() {
        let is_f32 = [Test::SeparatingAxes11F32, Test::SeparatingAxes17F32].contains(&test);
        // Moeller's epsilon does not see it either.
        assert_eq!(test.intersect(&points).unwrap(), is_f32 || test == Test::MoellerEpsilon, "{}", test.name());
    }
}

/// A common vertex is a contact, whatever the rest: nothing can be wrongly seen, and what constructs points or rounds
/// determinants misses some.
#[test]
fn shared_vertices_are_missed() {
    let shared = pairs(8, 3000, |rng| {
        let mut points = cube(rng);
        points[3 + rng.random_range(0..3usize)] = points[rng.random_range(0..3usize)];
        points
    });
    for test in [Test::Moeller, Test::MoellerEpsilon, Test::Held, Test::GuigueDevillers] {
        let (missed, wrongly_seen) = errors(test, &shared);
        assert!(missed > 20 && wrongly_seen == 0, "{}: {missed} {wrongly_seen}", test.name());
    }
    // Equal coordinates have equal projections.
    for &test in Test::ALL.iter().filter(|test| test.name().starts_with("sat")) {
        assert_eq!(errors(test, &shared), (0, 0), "{}", test.name());
    }
}

/// A vertex next to the inside of an edge or face of the other triangle: gaps of some units in the last place drown.
#[test]
fn separating_axes_err_to_intersect_near_contact() {
    let near = pairs(9, 3000, |rng| {
        let mut p = cube(rng);
        let u = rng.random_range(0.1..0.9);
        let v = rng.random_range(0.05..0.95) * (1.0 - u);
        p[3] = [0, 1, 2].map(|i| p[0][i] + u * (p[1][i] - p[0][i]) + v * (p[2][i] - p[0][i]));
        p
    });
    let (missed, wrongly_seen) = errors(Test::SeparatingAxes11F64, &near);
    assert!(wrongly_seen > 3 * missed && missed > 0, "{missed} {wrongly_seen}");
}

#[test]
fn degenerate_triangles_are_outside_of_most_methods() {
    // On a grid, so that everything is exact but the methods: a segment and a triangle, two segments.
    let grid = |rng: &mut ChaCha8Rng| {
        let mut p = [(); 6].map(|()| [(); 3].map(|()| f64::from(rng.random_range(-3..=3))));
        p[2] = p[1];
        p
    };
    let one = pairs(10, 3000, grid);
    let both: Vec<Points> = one.iter().map(|&[a, b, c, d, e, _]| [a, b, c, d, e, e]).collect();
    for &test in Test::ALL {
        let (of_one, of_both) = (errors(test, &one), errors(test, &both));
        if EXACT.contains(&test) {
            assert_eq!((of_one, of_both), ((0, 0), (0, 0)), "{}", test.name());
            continue;
        }
        let misses = [Test::Moeller, Test::MoellerEpsilon].contains(&test);
        let known = (of_one.0 > 0) == misses && (of_both.0 > 0) == misses && of_one.1 > 0 && of_both.1 > of_one.1 / 2;
        assert!(known, "{}: {of_one:?} {of_both:?}", test.name());
        // 17 axes lack little with one segment, the sign tests much.
        assert!(!test.name().starts_with("sat") || of_one.1 < 10, "{}: {of_one:?}", test.name());
    }
}

/// Public failing inputs of other libraries, in all orders.
#[test]
fn hard_cases() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/cases/hard-cases.json");
    let Ok(text) = std::fs::read_to_string(path) else { return };
    let cases: Vec<serde_json::Value> = serde_json::from_str(&text).unwrap();
    let failed = |test: Test| -> Vec<&str> {
        let fails = |case: &&serde_json::Value| {
            let triangle = |key: &str| serde_json::from_value::<[[f64; 3]; 3]>(case[key].clone()).unwrap();
            let ([a0, a1, a2], [b0, b1, b2]) = (triangle("a"), triangle("b"));
            let contact = case["closed"].as_bool().unwrap();

            orders(&[a0, a1, a2, b0, b1, b2]).any(|points| test.intersect(&points).unwrap() != contact)
        };
        cases.iter().filter(fails).map(|case| case["name"].as_str().unwrap()).collect()
    };
    for test in [Test::SeparatingAxes17F64, Test::SeparatingAxes17F32].into_iter().chain(EXACT) {
        assert_eq!(failed(test), Vec::<&str>::new(), "{}", test.name());
    }
    // Coplanar but for the rounding, and far apart: no axis of the eleven, and signs of noise.
    for test in [Test::SeparatingAxes11F64, Test::GuigueDevillers] {
        assert!(failed(test).contains(&"contours-1"), "{}", test.name());
    }
    // The overlaps that the printed decision tree of the latter misses are found, in all orders.
    let (axom, loki) = ("axom", "loki");
    let missed =
        failed(Test::GuigueDevillers).into_iter().filter(|name| name.starts_with(axom) || name.starts_with(loki));
    assert_eq!(missed.collect::<Vec<_>>(), Vec::<&str>::new());
    assert!(cases.iter().filter(|case| case["name"].as_str().unwrap().starts_with(axom)).count() > 0);
    // What the epsilon is for.
    assert!(failed(Test::Moeller).contains(&"loki-almost-coplanar"));
    assert!(!failed(Test::MoellerEpsilon).contains(&"loki-almost-coplanar"));
}
