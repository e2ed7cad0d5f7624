//! Two formulations against each other and against a third, the definition; and against what is known by hand.

use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

use super::{Exact, Relation, linear_programme, posed_relation, relation};
use crate::rounds;

type Points = [[f64; 3]; 6];
type Matrix = [[f64; 3]; 3];
type Vector = [i128; 3];

const ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];

/// What both formulations say.
fn agreed(points: &Points) -> Relation {
    let [first, second] = [relation(points), linear_programme::relation(points)].map(Result::unwrap);
    assert_eq!(first, second, "{points:?}");
    first
}

/// What both formulations say under a pose.
fn agreed_posed(points: &Points, m: &Matrix, t: &[f64; 3]) -> Relation {
    let (a, b) = ([points[0], points[1], points[2]], [points[3], points[4], points[5]]);
    let [first, second] =
        [posed_relation(&a, &b, m, t), linear_programme::posed_relation(&a, &b, m, t)].map(Result::unwrap);
    assert_eq!(first, second, "{points:?} {m:?} {t:?}");
    first
}

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
/// relative interior if all have. Points are coplanar if no four of them span a volume.
fn by_definition(p: &[Vector; 6]) -> Relation {
    let from = |x: &Vector, y: &Vector| [0, 1, 2].map(|i| x[i] - y[i]);
    let differences: Vec<Vector> = (0..9).map(|i| from(&p[i / 3], &p[3 + i % 3])).collect();
    let covered = |d: &Vector| in_cone(d.map(|x| -x), &differences);
    let class = if differences.iter().all(covered) {
        Exact::Intersect
    } else if differences.iter().any(covered) {
        Exact::Touch
    } else {
        Exact::Separate
    };
    let mut volumes =
        (0..216).map(|i| det(from(&p[i / 36], &p[0]), from(&p[i / 6 % 6], &p[0]), from(&p[i % 6], &p[0])));
    Relation { class, coplanar: volumes.all(|volume| volume == 0) }
}

#[test]
fn both_agree_with_the_definition_on_small_integers() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let mut seen = [[0; 2]; 3];
    for round in 0..rounds(30_000) {
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
        assert_eq!(agreed(&points), expected, "{points:?}");
        // Each axis at its own scale, too far apart for the small integers.
        let stretched = points.map(|x| [x[0] * (-1000f64).exp2(), x[1], x[2] * 1000f64.exp2()]);
        assert_eq!(agreed(&stretched), expected, "{stretched:?}");
        seen[expected.class as usize][usize::from(expected.coplanar)] += 1;
    }
    assert!(seen.as_flattened().iter().all(|&n| n > rounds(500)), "{seen:?}");
}

/// The collected failing inputs of other libraries.
#[test]
fn published_hard_cases_in_all_orders() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/cases/hard-cases.json");
    let Ok(text) = std::fs::read_to_string(path) else { return };
    let cases: Vec<serde_json::Value> = serde_json::from_str(&text).unwrap();
    for case in &cases {
        let triangle = |key: &str| serde_json::from_value::<Matrix>(case[key].clone()).unwrap();
        let (a, b) = (triangle("a"), triangle("b"));
        let name = case["name"].as_str().unwrap();
        for points in orders(&[a[0], a[1], a[2], b[0], b[1], b[2]]) {
            let Relation { class, coplanar } = agreed(&points);
            assert_eq!(class.to_string(), case["expected"].as_str().unwrap(), "{name}");
            assert_eq!(class != Exact::Separate, case["closed"].as_bool().unwrap(), "{name}");
            let kind = match (class, coplanar) {
                (Exact::Separate, _) => "separate",
                (Exact::Touch, _) => "touch",
                (Exact::Intersect, true) => "coplanar-area",
                (Exact::Intersect, false) => "proper",
            };
            assert_eq!(kind, case["class"].as_str().unwrap(), "{name}");
        }
    }
    assert!(cases.len() > 30, "{} cases", cases.len());
}

/// Pairs whose answer is known by construction, beside the triangle (0, 0), (4, 0), (0, 4) in the plane z = 0.
#[test]
fn hard_cases_by_hand_in_all_orders() {
    use Exact::{Intersect, Separate, Touch};
    let tiny = 5e-324;
    let near = 1.0 + f64::EPSILON;
    let cases: [(&str, Matrix, Exact, bool); 27] = [
        ("vertex on the face", [[1.0, 1.0, 0.0], [1.0, 1.0, 1.0], [2.0, 1.0, 1.0]], Touch, false),
        ("above it by the least number", [[1.0, 1.0, tiny], [1.0, 1.0, 1.0], [2.0, 1.0, 1.0]], Separate, false),
        ("below it by the least number", [[1.0, 1.0, -tiny], [1.0, 1.0, 1.0], [2.0, 1.0, 1.0]], Intersect, false),
        (
            "parallel, apart by the least number",
            [[0.0, 0.0, tiny], [4.0, 0.0, tiny], [0.0, 4.0, tiny]],
            Separate,
            false,
        ),
        ("the same triangle", [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]], Intersect, true),
        ("hinged at an edge", [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, tiny]], Touch, false),
        ("a common vertex", [[0.0, 0.0, 0.0], [-1.0, 0.0, 1.0], [0.0, -1.0, 1.0]], Touch, false),
        ("through it from a common vertex", [[0.0, 0.0, 0.0], [3.0, 3.0, 1.0], [3.0, 3.0, -1.0]], Intersect, false),
        ("edge across an edge", [[2.0, -1.0, -1.0], [2.0, 1.0, 1.0], [2.0, -1.0, 1.0]], Touch, false),
        ("edge across an edge, nearer", [[2.0, -1.0, -1.0], [2.0, 1.0, near], [2.0, -1.0, 1.0]], Separate, false),
        ("edge across an edge, farther", [[2.0, -1.0, -near], [2.0, 1.0, 1.0], [2.0, -1.0, 1.0]], Intersect, false),
        ("a needle through the inside", [[1.0, 1.0, -1e300], [1.0, 1.0, 1e300], [near, 1.0, 0.0]], Intersect, false),
        ("coplanar, area shared", [[1.0, 1.0, 0.0], [5.0, 5.0, 0.0], [5.0, 1.0, 0.0]], Intersect, true),
        ("coplanar, star", [[-1.0, 2.0, 0.0], [2.0, -1.0, 0.0], [3.0, 3.0, 0.0]], Intersect, true),
        ("coplanar, an edge shared", [[4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [4.0, 4.0, 0.0]], Touch, true),
        ("coplanar, a vertex shared", [[4.0, 0.0, 0.0], [5.0, 0.0, 0.0], [5.0, 1.0, 0.0]], Touch, true),
        ("coplanar, nothing shared", [[4.0 + 1e-15, 0.0, 0.0], [5.0, 0.0, 0.0], [5.0, 1.0, 0.0]], Separate, true),
        ("segment through the inside", [[1.0, 1.0, -1.0], [1.0, 1.0, 1.0], [1.0, 1.0, 0.5]], Intersect, false),
        ("segment along an edge", [[1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 0.0, 0.0]], Touch, true),
        ("segment inside the face", [[1.0, 1.0, 0.0], [2.0, 1.0, 0.0], [1.5, 1.0, 0.0]], Intersect, true),
        ("segment that ends on the face", [[1.0, 1.0, 0.0], [1.0, 1.0, 1.0], [1.0, 1.0, 1.0]], Touch, false),
        ("segment past the face", [[3.0, 3.0, -1.0], [3.0, 3.0, 1.0], [3.0, 3.0, 1.0]], Separate, false),
        ("segment beside it", [[5.0, 0.0, 0.0], [5.0, 9.0, 0.0], [5.0, 1.0, 0.0]], Separate, true),
        ("point inside", [[1.0, 1.0, 0.0]; 3], Intersect, true),
        ("point at a vertex", [[0.0, 4.0, 0.0]; 3], Touch, true),
        ("point above the face", [[1.0, 1.0, tiny]; 3], Separate, false),
        ("point at the end of the range", [[1e308, -1e308, 1e308]; 3], Separate, false),
    ];
    for (name, b, class, coplanar) in cases {
        let tent = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
        for points in orders(&[tent[0], tent[1], tent[2], b[0], b[1], b[2]]) {
            assert_eq!(agreed(&points), Relation { class, coplanar }, "{name}");
        }
    }
}

/// Segments and points among themselves: the first two vertices of each span it.
#[test]
fn degenerate_pairs_by_hand_in_all_orders() {
    use Exact::{Intersect, Separate, Touch};
    // The end and the middle of a segment that passes from normal to denormal numbers.
    let least = f64::MIN_POSITIVE;
    let (end, middle) = ([2.0 * least, least, 0.0], [least, least / 2.0, 0.0]);
    let line = |x: f64| [x, 2.0 * x, -x];
    let cases: [([[f64; 3]; 4], Exact, bool); 12] = [
        ([[0.0; 3], end, middle, middle], Intersect, true),
        ([[0.0; 3], [2.0 * least, least, 5e-324], middle, middle], Separate, true),
        ([line(0.0), line(2.0), line(1.0), line(3.0)], Intersect, true),
        ([line(0.0), line(2.0), line(2.0), line(3.0)], Touch, true),
        ([line(0.0), line(2.0), line(2.5), line(3.0)], Separate, true),
        ([line(0.0), line(2.0), line(0.5), line(1.5)], Intersect, true),
        ([[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 1.0, 0.0]], Intersect, true),
        ([[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 1.0, 0.0]], Touch, true),
        ([[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, -1.0, 5e-324], [0.0, 1.0, 5e-324]], Separate, false),
        ([[0.1; 3], [0.1; 3], [0.1; 3], [0.1; 3]], Intersect, true),
        ([[0.1; 3], [0.1; 3], [0.2; 3], [0.2; 3]], Separate, true),
        ([[0.0; 3], [0.0; 3], [-0.0; 3], [-0.0; 3]], Intersect, true),
    ];
    for ([a, b, c, d], class, coplanar) in cases {
        for points in orders(&[a, b, b, c, d, d]) {
            assert_eq!(agreed(&points), Relation { class, coplanar }, "{points:?}");
        }
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

/// Triangles in one plane, but for the rounding.
fn near_plane(rng: &mut ChaCha8Rng) -> Points {
    let [origin, u, v] = [(); 3].map(|()| [(); 3].map(|()| rng.random_range(-1.0..1.0f64)));
    [(); 6].map(|()| {
        let (x, y) = (rng.random_range(-1.0..1.0), rng.random_range(-1.0..1.0));
        [0, 1, 2].map(|i| origin[i] + x * u[i] + y * v[i])
    })
}

#[test]
fn both_agree_near_contact_in_all_orders_axes_and_scales() {
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    for round in 0..10_000 {
        let points = if round % 2 == 0 { near_contact(&mut rng) } else { near_plane(&mut rng) };
        let expected = agreed(&points);
        if round < 100 {
            for written in orders(&points) {
                assert_eq!(agreed(&written), expected);
            }
            for axes in ORDERS {
                let turned = points.map(|x| [-x[axes[0]], x[axes[1]], 1024.0 * x[axes[2]]]);
                assert_eq!(agreed(&turned), expected);
            }
        }
    }
}

/// Numbers of any exponent, and contacts moved to the ends of the range.
#[test]
fn both_agree_at_the_extremes_of_binary64() {
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    let mut seen = [0; 3];
    for round in 0..1500 {
        let mut any = || loop {
            let x = f64::from_bits(rng.random());
            if x.is_finite() {
                return x;
            }
        };
        let points = match round % 3 {
            0 => [(); 6].map(|()| [(); 3].map(|()| any())),
            1 => {
                let ends = [0.0, -0.0, 5e-324, -5e-324, f64::MIN_POSITIVE, f64::MAX, f64::MIN, 1.0, any(), any()];
                [(); 6].map(|()| [(); 3].map(|()| ends[rng.random_range(0..ends.len())]))
            }
            // Few bits stay of coordinates that become denormal, so contacts become exact.
            _ => {
                let scale = [-1073.0, -1060.0, -1022.0, 1000.0, 1023.0][rng.random_range(0..5)];
                near_contact(&mut rng).map(|x| x.map(|x| x * f64::exp2(scale)))
            }
        };
        seen[agreed(&points).class as usize] += 1;
    }
    assert!(seen.iter().all(|&n| n > 20), "{seen:?}");
}

#[test]
fn poses_are_applied_exactly() {
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
        let expected = agreed(&[p[0], p[1], p[2], image(p[3]), image(p[4]), image(p[5])]);
        assert_eq!(agreed_posed(&p, &m, &t), expected);
        touching += usize::from(expected.class == Exact::Touch);
    }
    assert!(touching > 20, "{touching}");
    // 0.1 * 0.1 is greater as a binary64 number than as a product of the reals: with B starting at the product, an A
    // that ends at the binary64 number overlaps it, one that ends a unit in the last place below does not.
    let b = [[0.1, 0.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0]];
    let m = [[0.1, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let product = 0.1 * 0.1;
    for (end, class) in [(product, Exact::Intersect), (product - 2e-18, Exact::Separate)] {
        let points = [[end, 0.0, 0.0], [-1.0, -1.0, 0.0], [-1.0, 1.0, 0.0], b[0], b[1], b[2]];
        assert_eq!(agreed_posed(&points, &m, &[0.0; 3]), Relation { class, coplanar: true });
    }
}

/// Rotations, matrices that are none, singular ones, and translations that cancel, vanish or dwarf the pair.
#[test]
fn both_agree_under_any_pose() {
    let turn = [[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]];
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    let mut seen = [0; 3];
    for round in 0..3000 {
        let mut p = near_contact(&mut rng);
        let mut any = || rng.random_range(-1.0..1.0f64);
        let (m, t) = match round % 6 {
            // The inverse of a rotation is its transpose, but for the rounding.
            0 | 1 => {
                let t = if round % 6 == 0 { [1e5, -7e4, 3e4] } else { [1e-200, 0.0, -5e-324] };
                for x in &mut p[3..] {
                    *x = [0, 1, 2].map(|j| (0..3).map(|i| turn[i][j] * (x[i] - t[i])).sum());
                }
                (turn, t)
            }
            2 => ([(); 3].map(|()| [(); 3].map(|()| any())), [(); 3].map(|()| any() * 0.1)),
            // B becomes a segment at a vertex of A, or a point that may be one.
            3 => ([[any(), 0.0, 0.0], [any(), 0.0, 0.0], [any(), 0.0, 0.0]], p[rng.random_range(0..3)]),
            4 => ([[0.0; 3]; 3], p[rng.random_range(0..4)]),
            _ => (turn.map(|row| row.map(|x| x * f64::exp2(-1070.0))), [1e300 * any(), any(), 5e-324]),
        };
        seen[agreed_posed(&p, &m, &t).class as usize] += 1;
    }
    assert!(seen.iter().all(|&n| n > 20), "{seen:?}");
}
