//! The oracle against a second formulation, the collected hard cases and its own symmetries.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::{filter, integers, pair, posed_pair, Exact};

type Points = [[f64; 3]; 6];
type Vector = [i128; 3];

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

fn det(a: Vector, b: Vector, c: Vector) -> i128 {
    let n = [b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]];
    a[0] * n[0] + a[1] * n[1] + a[2] * n[2]
}

/// Whether `x` is a non-negative combination of `generators`: by Caratheodory's theorem, of at most three of them, which
/// are independent. Fewer than three are completed by coordinate vectors whose coefficients must vanish.
fn in_cone(x: Vector, generators: &[Vector]) -> bool {
    let units = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
    let all: Vec<(Vector, bool)> =
        generators.iter().map(|&g| (g, true)).chain(units.iter().map(|&u| (u, false))).collect();
    let good = |value: i128, d: i128, free: bool| if free { value * d.signum() >= 0 } else { value == 0 };
    (0..all.len()).any(|i| {
        (i + 1..all.len()).any(|j| {
            (j + 1..all.len()).any(|k| {
                let ((a, p), (b, q), (c, r)) = (all[i], all[j], all[k]);
                let d = det(a, b, c);
                d != 0 && good(det(x, b, c), d, p) && good(det(a, x, c), d, q) && good(det(a, b, x), d, r)
            })
        })
    })
}

/// The definition itself: 0 is in A - B if some difference d of vertices has -d in the cone of all of them, and in its
/// relative interior if all have.
fn by_definition(p: &[Vector; 6]) -> Exact {
    let differences: Vec<Vector> = (0..9).map(|i| [0, 1, 2].map(|x| p[i / 3][x] - p[3 + i % 3][x])).collect();
    let covered = |d: &Vector| in_cone(d.map(|x| -x), &differences);
    if differences.iter().all(covered) {
        Exact::Intersect
    } else if differences.iter().any(covered) {
        Exact::Touch
    } else {
        Exact::Separate
    }
}

#[test]
fn agrees_with_the_definition_on_small_integers() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let mut seen = [0; 3];
    for round in 0..30_000 {
        // Few values make degenerate triangles, common vertices and coplanar pairs frequent.
        let reach = [1, 2, 5][round % 3];
        let mut p = [(); 6].map(|()| [(); 3].map(|()| rng.random_range(-reach..=reach)));
        match round % 7 {
            0 => p.iter_mut().for_each(|x| x[2] = 0),
            1 => p[4] = p[3],
            2 => {
                p[1] = p[0];
                p[5] = p[4];
            }
            3 => p.iter_mut().for_each(|x| (x[1], x[2]) = (2 * x[0], -x[0])),
            _ => {}
        }
        let expected = by_definition(&p);
        let points = p.map(|x| x.map(|x| x as f64));
        assert_eq!(pair(&points), expected, "{points:?}");
        // Each axis at its own scale, too far apart for the small integers.
        let stretched = points.map(|x| [x[0] * (-1000f64).exp2(), x[1], x[2] * 1000f64.exp2()]);
        assert_eq!(pair(&stretched), expected, "{stretched:?}");
        seen[expected as usize] += 1;
    }
    assert!(seen.iter().all(|&n| n > 1000), "{seen:?}");
}

#[test]
fn hard_cases_in_all_orders() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/cases/hard-cases.json");
    let Ok(text) = std::fs::read_to_string(path) else { return };
    let cases: Vec<serde_json::Value> = serde_json::from_str(&text).unwrap();
    for case in &cases {
        let triangle = |key: &str| serde_json::from_value::<[[f64; 3]; 3]>(case[key].clone()).unwrap();
        let (a, b) = (triangle("a"), triangle("b"));
        let points = [a[0], a[1], a[2], b[0], b[1], b[2]];
        for points in orders(&points) {
            assert_eq!(pair(&points).to_string(), case["expected"].as_str().unwrap(), "{}", case["name"]);
            assert_eq!(pair(&points), integers::decide(&points), "{}", case["name"]);
        }
    }
}

#[test]
fn hard_cases_by_hand() {
    let tent = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
    let with = |b: [[f64; 3]; 3]| [tent[0], tent[1], tent[2], b[0], b[1], b[2]];
    let tiny = 5e-324;
    let cases = [
        // A vertex on the face, and off it by the least denormal number.
        ([[1.0, 1.0, 0.0], [1.0, 1.0, 1.0], [2.0, 1.0, 1.0]], Exact::Touch),
        ([[1.0, 1.0, tiny], [1.0, 1.0, 1.0], [2.0, 1.0, 1.0]], Exact::Separate),
        ([[1.0, 1.0, -tiny], [1.0, 1.0, 1.0], [2.0, 1.0, 1.0]], Exact::Intersect),
        // Coplanar: sharing area, an edge, a vertex, nothing.
        ([[1.0, 1.0, 0.0], [5.0, 5.0, 0.0], [5.0, 1.0, 0.0]], Exact::Intersect),
        ([[4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [4.0, 4.0, 0.0]], Exact::Touch),
        ([[4.0, 0.0, 0.0], [5.0, 0.0, 0.0], [5.0, 1.0, 0.0]], Exact::Touch),
        ([[4.0 + 1e-15, 0.0, 0.0], [5.0, 0.0, 0.0], [5.0, 1.0, 0.0]], Exact::Separate),
        // A segment through the inside, along an edge, ending on the face, past it.
        ([[1.0, 1.0, -1.0], [1.0, 1.0, 1.0], [1.0, 1.0, 0.5]], Exact::Intersect),
        ([[1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 0.0, 0.0]], Exact::Touch),
        ([[1.0, 1.0, 0.0], [1.0, 1.0, 1.0], [1.0, 1.0, 1.0]], Exact::Touch),
        ([[3.0, 3.0, -1.0], [3.0, 3.0, 1.0], [3.0, 3.0, 1.0]], Exact::Separate),
        // A point inside, at a vertex, outside.
        ([[1.0, 1.0, 0.0]; 3], Exact::Intersect),
        ([[0.0, 4.0, 0.0]; 3], Exact::Touch),
        ([[1e308, -1e308, 1e308]; 3], Exact::Separate),
    ];
    for (b, expected) in cases {
        for points in orders(&with(b)) {
            assert_eq!(pair(&points), expected, "{b:?}");
        }
    }
    // A denormal number half way along a segment that ends at normal ones.
    let least = f64::MIN_POSITIVE;
    let (end, middle) = ([2.0 * least, least, 0.0], [least, least / 2.0, 0.0]);
    assert_eq!(pair(&[[0.0; 3], end, end, middle, middle, middle]), Exact::Intersect);
    let point = |x: f64| [[x, x, x]; 3];
    for (x, y, expected) in [(0.1, 0.1, Exact::Intersect), (0.1, 0.2, Exact::Separate), (0.0, -0.0, Exact::Intersect)] {
        let (a, b) = (point(x), point(y));
        assert_eq!(pair(&[a[0], a[1], a[2], b[0], b[1], b[2]]), expected);
    }
}

/// Pairs near contact: a vertex of B on the plane of A or on an edge of A, but for a few units in the last place.
fn near_contact(rng: &mut ChaCha8Rng) -> Points {
    let mut p = [(); 6].map(|()| [(); 3].map(|()| rng.random_range(-1.0..1.0f64)));
    let (u, v) = (rng.random_range(0.0..1.0), if rng.random() { 0.0 } else { rng.random_range(0.0..1.0) });
    let ulps = rng.random_range(-2.0..2.0f64).trunc() * 1e-16;
    p[3] = [0, 1, 2].map(|i| p[0][i] + u * (p[1][i] - p[0][i]) + v * (1.0 - u) * (p[2][i] - p[0][i]) + ulps);
    p
}

#[test]
fn the_filter_agrees_and_decides_most() {
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    let mut decided = 0;
    for round in 0..20_000 {
        let points = if round % 2 == 0 {
            near_contact(&mut rng)
        } else {
            [(); 6].map(|()| [(); 3].map(|()| rng.random_range(-1.0..1.0)))
        };
        let exact = integers::decide(&points);
        if let Some(quick) = filter::decide(&points, 0.0) {
            assert_eq!(quick, exact, "{points:?}");
            decided += 1;
        }
    }
    assert!((10_000..19_000).contains(&decided), "{decided}");
}

#[test]
fn no_order_axis_or_scale_changes_the_answer() {
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    for _ in 0..300 {
        let points = near_contact(&mut rng);
        let expected = pair(&points);
        for written in orders(&points) {
            assert_eq!(pair(&written), expected);
        }
        for axes in ORDERS {
            let turned = points.map(|x| [-x[axes[0]], x[axes[1]], 1024.0 * x[axes[2]]]);
            assert_eq!(pair(&turned), expected);
        }
    }
}

#[test]
fn poses() {
    let mut rng = ChaCha8Rng::seed_from_u64(4);
    let quarter = [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
    let mut touching = 0;
    for round in 0..3000 {
        // Multiples of 2^-10 keep the posed coordinates exact in binary64, so that both entries must agree.
        let grid = if round % 2 == 0 { 4.0 } else { 1024.0 };
        let p = [(); 6].map(|()| [(); 3].map(|()| (rng.random_range(-1.0..1.0f64) * grid).round() / grid));
        let t = [(); 3].map(|()| (rng.random_range(-0.5..0.5f64) * grid).round() / grid);
        let half = if round % 3 == 0 { 0.5 } else { 1.0 };
        let m = quarter.map(|row| row.map(|x| x * half));
        let image = |x: [f64; 3]| [0, 1, 2].map(|i| m[i][0] * x[0] + m[i][1] * x[1] + m[i][2] * x[2] + t[i]);
        let (a, b) = ([p[0], p[1], p[2]], [p[3], p[4], p[5]]);
        let expected = pair(&[p[0], p[1], p[2], image(p[3]), image(p[4]), image(p[5])]);
        assert_eq!(posed_pair(&a, &b, &m, &t), expected);
        assert_eq!(integers::decide_posed(&a, &b, &m, &t), expected);
        touching += usize::from(expected == Exact::Touch);
    }
    assert!(touching > 20, "{touching}");
    // Near contact after a pose that binary64 cannot apply exactly.
    let turn = [[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]];
    let mut decided = 0;
    for _ in 0..3000 {
        let p = near_contact(&mut rng);
        // A long translation that cancels makes the image's error much greater than the pair's own scale suggests.
        let t = [1e5, -7e4, 3e4];
        // The inverse of a rotation is its transpose, but for the rounding.
        let back = |x: [f64; 3]| [0, 1, 2].map(|j| (0..3).map(|i| turn[i][j] * (x[i] - t[i])).sum::<f64>());
        let (a, b) = ([p[0], p[1], p[2]], [back(p[3]), back(p[4]), back(p[5])]);
        if let Some(quick) = filter::decide_posed(&a, &b, &turn, &t) {
            assert_eq!(quick, integers::decide_posed(&a, &b, &turn, &t));
            decided += 1;
        }
    }
    assert!((300..2700).contains(&decided), "{decided}");
    // 0.1 * 0.1 is greater as a binary64 number than as a product of the reals: with B starting at the product, an A
    // that ends at the binary64 number overlaps it, one that ends a unit in the last place below does not.
    let b = [[0.1, 0.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0]];
    let m = [[0.1, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let product = 0.1 * 0.1;
    for (end, expected) in [(product, Exact::Intersect), (product - 2e-18, Exact::Separate)] {
        let a = [[end, 0.0, 0.0], [-1.0, -1.0, 0.0], [-1.0, 1.0, 0.0]];
        assert_eq!(posed_pair(&a, &b, &m, &[0.0; 3]), expected);
    }
}
