//! The exact unit against the oracle: every pair that fits has the oracle's answer, and its kind of contact too.

use rand::rngs::ChaCha8Rng;
use rand::seq::IndexedRandom;
use rand::{RngExt, SeedableRng};

use crate::golden::Golden;
use crate::pair::{Input, Outcome, Pair, Pose, Verdict};
use crate::params::{Method, Params, Transform};
use efsat_geometry::exact::{self, Exact, Relation};
use efsat_hardware::testing::full;

type Point = [i64; 3];
type Points = [Point; 6];

/// The orders of three things.
const ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];

/// Both triangles as the unit reads them.
fn read(points: &Points) -> Pair {
    let at = |i: usize| points[i].map(Input::exact);
    Pair { a: [at(0), at(1), at(2)], b: [at(3), at(4), at(5)] }
}

/// What the oracle says.
fn truth(points: &Points) -> Relation {
    exact::relation(&points.map(|point| point.map(|x| x as f64))).unwrap()
}

fn params(width: u32) -> Params {
    let p = Params { width, transform_width: width + 4, ..Params::of(Method::Exact) };
    p.validate().unwrap();
    p
}

/// The unit that takes differences of `width` bits.
fn golden(width: u32) -> Golden {
    Golden::new(&params(width))
}

fn outcome(golden: &Golden, points: &Points) -> Outcome {
    golden.outcome(&Pose::identity(&params(6)), &read(points))
}

/// Whether the normals of both triangles have one direction, if they are parallel.
fn agree(points: &Points) -> bool {
    let edge = |from: usize, to: usize| [0, 1, 2].map(|i| i128::from(points[to][i] - points[from][i]));
    let normal = |first: usize| {
        let (x, y) = (edge(first, first + 1), edge(first, first + 2));
        [0, 1, 2].map(|i| x[(i + 1) % 3] * y[(i + 2) % 3] - x[(i + 2) % 3] * y[(i + 1) % 3])
    };
    normal(0).iter().zip(normal(3)).map(|(x, y)| x * y).sum::<i128>() > 0
}

/// The verdict, whether the triangles cross, and whether they are in one plane, all as the oracle says; of triangles that cross in
/// one plane, how their normals lie.
fn check(golden: &Golden, points: &Points) -> Relation {
    let (truth, outcome) = (truth(points), outcome(golden, points));
    let verdict = if truth.class == Exact::Separate { Verdict::Separate } else { Verdict::Intersect };
    let expected = (verdict, truth.class == Exact::Intersect, truth.coplanar, false);
    let found = (outcome.verdict, outcome.overlapping & 1 != 0, outcome.overlapping & 2 != 0, outcome.outside);
    assert_eq!(found, expected, "{points:?}: {truth}, {outcome:?}");
    if truth.coplanar {
        let alike = truth.class == Exact::Intersect && agree(points);
        assert_eq!(outcome.overlapping & 4 != 0, alike, "{points:?}: {outcome:?}");
    }
    truth
}

/// How often each answer came, to see that a test has all kinds of pairs.
#[derive(Debug, Default)]
struct Seen {
    /// Not in one plane, in one plane; separate, touch, intersect.
    classes: [[u64; 3]; 2],
}

impl Seen {
    fn add(&mut self, truth: Relation) {
        self.classes[usize::from(truth.coplanar)][truth.class as usize] += 1;
    }

    fn all(&self) -> impl Iterator<Item = u64> {
        self.classes.into_iter().flatten()
    }
}

/// Points of a small lattice, in families in which most pairs are degenerate in some way.
fn small(rng: &mut ChaCha8Rng) -> Points {
    let reach = rng.random_range(1..=3);
    let within = |rng: &mut ChaCha8Rng| rng.random_range(-reach..=reach);
    let any = |rng: &mut ChaCha8Rng| [(); 3].map(|()| within(rng));
    let [origin, x, y] = [(); 3].map(|()| any(rng));
    let family = rng.random_range(0..8);
    let mut points = [(); 6].map(|()| match family {
        // One coordinate plane.
        0 => [within(rng), within(rng), 0],
        // One slanted plane, or a line.
        1 | 2 => {
            let (u, v) = (within(rng), if family == 1 { within(rng) } else { 0 });
            [0, 1, 2].map(|j| origin[j] + u * x[j] + v * y[j])
        }
        _ => any(rng),
    });
    match family {
        // Two lines through a point, or through the points of a parallelogram.
        3 => {
            let apart = *[[0; 3], y].choose(rng).unwrap();
            for (i, point) in points.iter_mut().enumerate() {
                let (along, shift) = if i < 3 { (x, [0; 3]) } else { (y, apart) };
                let u = within(rng);
                *point = [0, 1, 2].map(|j| origin[j] + shift[j] + u * along[j]);
            }
        }
        // Common vertices.
        4 => {
            for _ in 0..rng.random_range(1..=3) {
                points[rng.random_range(3..6)] = points[rng.random_range(0..3)];
            }
        }
        // Segments and points.
        5 => {
            for _ in 0..rng.random_range(1..=3) {
                let (to, from) = *[(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3)].choose(rng).unwrap();
                points[to] = points[from];
            }
        }
        // One triangle in a line with points of the other.
        6 => points[5] = [0, 1, 2].map(|j| 2 * points[rng.random_range(0..2)][j] - points[4][j]),
        _ => {}
    }
    points
}

/// A pair of differences up to R - 1, with large determinants that are 0 or nearly so.
fn large(rng: &mut ChaCha8Rng, width: u32) -> Points {
    let reach: i64 = (1 << (width - 1)) - 1;
    let vector = |rng: &mut ChaCha8Rng, reach: i64| [(); 3].map(|()| rng.random_range(-reach..=reach));
    let sum = |terms: &[(i64, Point)]| [0, 1, 2].map(|j| terms.iter().map(|(u, x)| u * x[j]).sum::<i64>());
    // Multiples of four, so that quarters are on the grid.
    let [x, y, z] = [(); 3].map(|()| vector(rng, reach / 8));
    let mut points: Points = [(); 6].map(|()| vector(rng, reach));
    match rng.random_range(0..7) {
        // Corners of the box of all pairs.
        0 => {
            let ends = [reach, reach - 1, -reach, 1 - reach, 0, 1, -1];
            points = [(); 6].map(|()| [(); 3].map(|()| *ends.choose(rng).unwrap()));
        }
        // A small lattice made great.
        1 => points = small(rng).map(|point| point.map(|x| x * (reach / 6))),
        // A slanted plane, or a line.
        2 => points = [(); 6].map(|()| sum(&[(rng.random_range(-4..=4), x), (rng.random_range(-4..=4), y)])),
        3 => points = [(); 6].map(|()| sum(&[(rng.random_range(-8..=8), x)])),
        // A vertex of B in the plane of A, in or near the triangle.
        4 => {
            points[..3].copy_from_slice(&[[0; 3], sum(&[(4, x)]), sum(&[(4, y)])]);
            points[3] = sum(&[(rng.random_range(-1..=4), x), (rng.random_range(-1..=4), y)]);
        }
        // Edges that meet, or whose lines do.
        5 => {
            points[..2].copy_from_slice(&[[0; 3], sum(&[(4, x)])]);
            let at = rng.random_range(-1..=5);
            let [down, up] = [rng.random_range(-3..=1), rng.random_range(0..=3)];
            (points[3], points[4]) = (sum(&[(at, x), (down, z)]), sum(&[(at, x), (up, z)]));
        }
        // One plane but for a vertex of B.
        _ => {
            points = [0, 1, 2, 3, 4, 5].map(|i| {
                let off = (i64::from(i == 5) * rng.random_range(-1..=1), z);
                sum(&[(rng.random_range(-3..=3), x), (rng.random_range(-3..=3), y), off])
            })
        }
    }
    if rng.random() {
        points[rng.random_range(0..6)][rng.random_range(0..3)] += [-1, 1][rng.random_range(0..2)];
    }
    // Any difference may be the greatest there is, and so V0 is the origin.
    let origin = if rng.random() { points[0] } else { [0; 3] };
    points[0] = origin;
    let off = vector(rng, reach);
    points.map(|point| [0, 1, 2].map(|j| (point[j] - origin[j]).clamp(-reach, reach) + off[j]))
}

#[test]
fn every_pair_of_a_small_lattice_is_right() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let golden = golden(7);
    let mut seen = Seen::default();
    for _ in 0..200_000 {
        seen.add(check(&golden, &small(&mut rng)));
    }
    assert!(seen.all().all(|count| count > 2000), "{seen:?}");
}

/// All pairs of triangles with corners in {0, 1, 2}^3 up to the symmetries of the cube, each in an image and an order
/// that are left to chance.
#[test]
fn every_pair_of_the_cube_of_27_points_is_right() {
    let triangles: Vec<[usize; 3]> =
        (0..27).flat_map(|i| (i..27).flat_map(move |j| (j..27).map(move |k| [i, j, k]))).collect();
    // A symmetry permutes the coordinates and turns some of them round.
    let turned = |symmetry: usize, i: usize| {
        let point = [i / 9, i / 3 % 3, i % 3];
        [0, 1, 2].map(|j| {
            let x = point[ORDERS[symmetry / 8][j]];
            (if symmetry >> j & 1 == 0 { x } else { 2 - x }) as i64
        })
    };
    let is_first = |triangle: &&[usize; 3]| {
        (0..48).all(|symmetry| {
            let number = |[x, y, z]: Point| (9 * x + 3 * y + z) as usize;
            let mut image = triangle.map(|i| number(turned(symmetry, i)));
            image.sort_unstable();
            **triangle <= image
        })
    };
    let first: Vec<&[usize; 3]> = triangles.iter().filter(is_first).collect();
    assert_eq!((triangles.len(), first.len()), (3654, 136));
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    let golden = golden(6);
    let mut seen = Seen::default();
    for a in first.into_iter().step_by(if full() { 1 } else { 4 }) {
        for b in &triangles {
            let symmetry = rng.random_range(0..48);
            let [a, b] = [a, b].map(|x| ORDERS[rng.random_range(0..6)].map(|i| turned(symmetry, x[i])));
            let [a, b] = if rng.random() { [a, b] } else { [b, a] };
            seen.add(check(&golden, &[a[0], a[1], a[2], b[0], b[1], b[2]]));
        }
    }
    assert!(seen.all().all(|count| count > if full() { 5000 } else { 1000 }), "{seen:?}");
}

/// Determinants of all lengths, and contact that a single unit breaks.
#[test]
fn large_coordinates_are_right() {
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    for width in [6, 9, 10, 18, 19, 20, 21, 32] {
        let golden = golden(width);
        let mut seen = Seen::default();
        for _ in 0..if full() { 20_000 } else { 6_000 } {
            seen.add(check(&golden, &large(&mut rng, width)));
        }
        assert!(seen.all().all(|count| count > if full() { 150 } else { 40 }), "{width}: {seen:?}");
    }
}

/// Neither the order of the vertices nor that of the triangles matters, nor where the pair is.
#[test]
fn all_orders_have_one_answer() {
    let mut rng = ChaCha8Rng::seed_from_u64(4);
    for width in [7, 18, 32] {
        // One bit more, because the differences are those from another vertex then.
        let golden = golden(width);
        for _ in 0..if full() { 3000 } else { 800 } {
            let points = if rng.random() { small(&mut rng) } else { large(&mut rng, width - 1) };
            let answer = |points: &Points| {
                let Outcome { verdict, overlapping, outside, .. } = outcome(&golden, points);
                assert!(!outside);
                (verdict, overlapping & 0b11)
            };
            let expected = answer(&points);
            for (a, b) in ORDERS.iter().flat_map(|a| ORDERS.iter().map(move |b| (a, b))) {
                let (a, b) = (a.map(|i| points[i]), b.map(|i| points[i + 3]));
                assert_eq!(answer(&[a[0], a[1], a[2], b[0], b[1], b[2]]), expected, "{points:?}");
                assert_eq!(answer(&[b[0], b[1], b[2], a[0], a[1], a[2]]), expected, "{points:?}");
            }
        }
    }
}

/// What single witnesses say is so: an edge that misses is separate from the other triangle, one that hits is not.
#[test]
fn witnesses_say_what_is_so() {
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    let golden = golden(10);
    for _ in 0..10_000 {
        let points = if rng.random() { small(&mut rng) } else { large(&mut rng, 10) };
        let Outcome { separated, overlapping, .. } = outcome(&golden, &points);
        if separated & 0b111 != 0 {
            assert_eq!(truth(&points).class, Exact::Separate, "{points:?}");
        }
        assert_eq!((separated & overlapping, separated >> 9, overlapping >> 9), (0, 0, 0));
        assert!(overlapping & 0b100 == 0 || overlapping & 1 == 1, "an edge pierces, or normals agree: {points:?}");
        for i in 0..6 {
            let (own, other) = (3 * (i / 3), 3 - 3 * (i / 3));
            let [from, to] = [points[own + i % 3], points[own + (i + 1) % 3]];
            let edge = truth(&[from, to, to, points[other], points[other + 1], points[other + 2]]);
            let apart = edge.class == Exact::Separate;
            assert!(separated >> (3 + i) & 1 == 0 || apart, "edge {i} of {points:?}");
            assert!(overlapping >> (3 + i) & 1 == 0 || !apart, "edge {i} of {points:?}");
        }
    }
}

/// Section 2: which pairs are answered, and how the others are.
#[test]
fn pairs_that_do_not_fit_are_outside() {
    let mut rng = ChaCha8Rng::seed_from_u64(6);
    for (width, transform) in
        [6, 11, 18, 32].into_iter().flat_map(|width| [(width, Transform::Off), (width, Transform::Translate)])
    {
        let p = Params { transform, ..params(width) };
        let (golden, unmoved, reach) = (Golden::new(&p), golden(width), (1i64 << (width - 1)) - 1);
        let end = 1i64 << (p.transform_width - 1);
        for round in 0..2000 {
            let points = large(&mut rng, width);
            let t = [(); 3].map(|()| rng.random_range(-reach..=reach));
            let moves = transform == Transform::Translate && rng.random_range(0..4) > 0;
            let pose = Pose { t: t.map(Input::exact), bypass: !moves && rng.random(), ..Pose::identity(&p) };
            // Without the transform no pose is read.
            let moves = transform == Transform::Translate && !pose.bypass;
            let mut pair = read(&points);
            let mut back = |x: Input, t: i64| Input { lo: x.lo - t, sticky: rng.random() };
            if moves {
                pair.b = pair.b.map(|w| [back(w[0], t[0]), back(w[1], t[1]), back(w[2], t[2])]);
            }
            let found = golden.outcome(&pose, &pair);
            assert_eq!(found, outcome(&unmoved, &points));
            assert!(!found.outside);
            // One difference out of range: the first numbers there, the last of the word, or any.
            let (vertex, j) = (1 + round % 5, rng.random_range(0..3));
            let (number, base) = match vertex {
                1 | 2 => (&mut pair.a[vertex][j], points[0][j]),
                _ => (&mut pair.b[vertex - 3][j], points[0][j] - if moves { t[j] } else { 0 }),
            };
            let difference = match rng.random_range(0..6) {
                0 => reach,
                1 => -reach,
                2 => reach + 1,
                3 => -reach - 1,
                4 => end - 1 - base,
                _ => -end - base,
            };
            number.lo = base + difference;
            let fits = difference.abs() <= reach;
            let found = golden.outcome(&pose, &pair);
            assert_eq!(found.outside, !fits, "{difference}");
            if !fits {
                assert_eq!(found, Outcome::outside());
                assert_eq!((found.verdict, found.separated, found.overlapping), (Verdict::PossiblyIncorrect, 0, 0));
            }
            assert_eq!(golden.verdict(&pose, &pair), found.verdict);
            let trace = golden.trace(&pose, &pair);
            assert_eq!(trace.last().map(|(name, x)| (name.as_str(), x.lo)), Some(("verdict", found.verdict as i128)));
            assert_eq!(trace.len(), 15 + 12 + 10 + 15 + 6 + 1);
        }
    }
}

/// Sections 2, 3 and 5: numbers have the bits that the page says.
#[test]
fn numbers_keep_to_their_formats() {
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    for width in [6, 18, 19, 32] {
        let (p, golden, reach) = (params(width), golden(width), (1i128 << (width - 1)) - 1);
        for _ in 0..3000 {
            for (name, x) in golden.trace(&Pose::identity(&p), &read(&large(&mut rng, width))) {
                let most = match name.split('.').next().unwrap() {
                    "difference" => reach,
                    "moment" | "component" => 2 * reach * reach,
                    "dot" => 6 * reach * reach * reach,
                    "determinant" => 24 * reach * reach * reach,
                    _ => 2,
                };
                assert!(x.lo == x.hi && x.lo.abs() <= most, "{name} = {} of {width} bits", x.lo);
            }
        }
    }
}

/// By hand: one pair of each kind, with all flags.
#[test]
fn plain_pairs() {
    let golden = golden(8);
    let a = [[0, 0, 0], [8, 0, 0], [0, 8, 0]];
    let of = |b: [Point; 3]| {
        let Outcome { verdict, separated, overlapping, .. } = outcome(&golden, &[a[0], a[1], a[2], b[0], b[1], b[2]]);
        (verdict, separated, overlapping)
    };
    // The two long edges of B pierce A, and no edge of A reaches B.
    assert_eq!(of([[2, 2, -4], [2, 3, 4], [3, 2, 4]]), (Verdict::Intersect, 0b010_111_000, 0b101_000_101));
    // Above A; and with a corner on it, where two edges of B hit.
    assert_eq!(of([[2, 2, 1], [2, 3, 4], [3, 2, 4]]).1 & 0b111, 0b010);
    assert_eq!(of([[2, 2, 0], [2, 3, 4], [3, 2, 4]]), (Verdict::Intersect, 0b010_111_000, 0b101_000_000));
    // In one plane: inside, also with the other normal, along an edge, beside.
    assert_eq!(of([[1, 1, 0], [2, 1, 0], [1, 2, 0]]), (Verdict::Intersect, 0, 0b111));
    assert_eq!(of([[1, 1, 0], [1, 2, 0], [2, 1, 0]]), (Verdict::Intersect, 0, 0b011));
    assert_eq!(of([[1, 0, 0], [2, 0, 0], [1, -2, 0]]), (Verdict::Intersect, 0, 0b10));
    assert_eq!(of([[9, 0, 0], [10, 0, 0], [9, 2, 0]]), (Verdict::Separate, 1, 0b10));
}

/// A cascade answers as the exact unit does, and what its first stage says is so; how many of the pairs are left open.
fn cascaded(width: u32, pairs: impl Iterator<Item = Points>) -> [u64; 2] {
    let p = Params { exact_clocks: Some(16), ..params(width) };
    let (cascade, exact) = (Golden::new(&p), golden(width));
    let pose = Pose::identity(&p);
    let mut stages = [0; 2];
    for points in pairs {
        let (expected, found, pair) = (outcome(&exact, &points), outcome(&cascade, &points), read(&points));
        let open = cascade.is_open(&pose, &pair);
        stages[usize::from(open)] += 1;
        if open {
            assert_eq!(found, expected, "{points:?}");
            continue;
        }
        let truth = truth(&points);
        assert_eq!(found.verdict == Verdict::Separate, truth.class == Exact::Separate, "{points:?}: {truth}");
        assert_ne!(found.verdict, Verdict::PossiblyIncorrect);
        // What crosses is known; else no flag is wrong but that of the boxes, which the exact unit has not.
        assert_eq!((found.overlapping ^ expected.overlapping) & 0b1, 0, "{points:?}");
        assert_eq!((found.separated & !1 & !expected.separated, found.outside), (0, false), "{points:?}");
        assert_eq!(found.overlapping & !expected.overlapping, 0, "{points:?}");
        assert_ne!(truth.class, Exact::Touch, "{points:?}");
        assert_eq!(cascade.verdict(&pose, &pair), found.verdict);
    }
    stages
}

#[test]
fn a_cascade_is_right_and_its_second_stage_gets_what_touches() {
    let mut rng = ChaCha8Rng::seed_from_u64(8);
    for width in [7, 9, 18, 19, 24, 32] {
        let [decided, open] =
            cascaded(width, (0..20_000).map(|i| if i % 2 == 0 { small(&mut rng) } else { large(&mut rng, width) }));
        assert!(decided > 2000 && open > 2000, "width {width}: {decided} decided, {open} open");
    }
}

/// Of pairs at random the second stage gets few, however small they are on the grid.
#[test]
fn a_cascade_leaves_few_pairs_open() {
    let mut rng = ChaCha8Rng::seed_from_u64(9);
    let tries = if full() { 100_000 } else { 30_000 };
    for bits in [5, 8, 12, 18, 24, 31] {
        let reach = (1i64 << (bits - 1)) - 1;
        let any = |rng: &mut ChaCha8Rng| [(); 6].map(|()| [(); 3].map(|()| rng.random_range(-reach..=reach) / 2));
        let [decided, open] = cascaded(32, (0..tries).map(|_| any(&mut rng)));
        // On the smallest grid many pairs touch.
        let most = tries * if bits == 5 { 150 } else { 6 } / 10_000;
        assert!((tries / 10_000..most).contains(&open) && decided + open == tries, "{bits} bits: {open} open");
    }
}
