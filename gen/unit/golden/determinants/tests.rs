//! The determinant unit against exact arithmetic: each of the fifteen errors keeps to its bound, every definite verdict is
//! right, and the fast ways to a number lead to what docs/determinants.md defines.

// Loops over components read like the equations.
#![allow(clippy::needless_range_loop)]

mod formats;

use num_bigint::BigInt;
use num_traits::{Signed, ToPrimitive};
use rand::rngs::ChaCha8Rng;
use rand::seq::IndexedRandom;
use rand::{RngExt, SeedableRng};

use super::bounds::{Constants, SECTION_5};
use super::coordinates::Scaling;
use super::differences::{Differences, Points};
use super::fifteen::Fifteen;
use super::moments::{Moments, Rounding};
use super::number::{Vector, round};
use super::verdict::{boxes_apart, boxes_apart_by};
use super::{Computed, DeterminantTest};
use crate::golden::Golden;
use crate::host::sample;
use crate::pair::{Input, Pair, Pose, Verdict};
use crate::params::options::Choice;
use crate::params::{Bound, Guard, LEVELS, Method, Params, SPAN, Transform};
use efsat_geometry::exact::{self, Exact};

/// Digits of true numbers behind the last place of the input format.
const BEHIND: u32 = 3;

/// A legal parameter set: widths at most these, every other option by chance.
fn params(rng: &mut ChaCha8Rng, most: u32, most_transform: u32) -> Params {
    let width = rng.random_range(6..=most);
    let p = Params {
        method: Method::Determinants,
        width,
        int_bits: rng.random_range(4..=8.min(width - 2)),
        transform_width: rng.random_range(width..=most_transform.max(width)),
        transform: *[Transform::On, Transform::Translate, Transform::Off].choose(rng).unwrap(),
        span: *SPAN.choose(rng).unwrap(),
        levels: *LEVELS.choose(rng).unwrap(),
        bound: *Bound::ALL.choose(rng).unwrap(),
        boxes: rng.random(),
        ..Params::default()
    };
    p.validate().unwrap();
    p
}

/// Numbers of the user: multiples of 2^-BEHIND ulps of the input format.
#[derive(Clone, Copy, Debug, Default)]
struct Query {
    a: [Vector; 3],
    b: [Vector; 3],
    m: [Vector; 3],
    t: Vector,
    bypass: bool,
}

impl Query {
    /// As the unit reads it.
    fn read(&self) -> (Pose, Pair) {
        let input = |x: i64| Input { lo: x >> BEHIND, sticky: x & ((1 << BEHIND) - 1) != 0 };
        let vector = |x: &Vector| x.map(input);
        let triple = |x: &[Vector; 3]| x.each_ref().map(vector);
        let pose = Pose { m: triple(&self.m), t: vector(&self.t), bypass: self.bypass };
        (pose, Pair { a: triple(&self.a), b: triple(&self.b) })
    }

    /// The exact answer, by the oracle.
    fn exact(&self, p: &Params) -> Exact {
        let unit = f64::from(p.transform_width - p.int_bits + BEHIND).exp2();
        let real = |x: &Vector| x.map(|x| x as f64 / unit);
        let triple = |x: &[Vector; 3]| x.each_ref().map(real);
        let one = identity(1).map(|row| row.map(|x| x as f64));
        let (m, t) = match (p.transform, self.bypass) {
            (Transform::Off, _) | (_, true) => (one, [0.0; 3]),
            (Transform::Translate, false) => (one, real(&self.t)),
            (Transform::On, false) => (triple(&self.m), real(&self.t)),
        };
        exact::posed_pair(&triple(&self.a), &triple(&self.b), &m, &t).unwrap()
    }
}

fn identity(one: i64) -> [Vector; 3] {
    [[one, 0, 0], [0, one, 0], [0, 0, one]]
}

/// A whole number within `reach`.
fn within(rng: &mut ChaCha8Rng, reach: i64) -> i64 {
    rng.random_range(-reach..=reach)
}

/// A step away from contact, of a few ulps or less.
fn offset(rng: &mut ChaCha8Rng) -> Vector {
    let reach = 1 << rng.random_range(0..8);
    [(); 3].map(|()| within(rng, reach))
}

/// How a triangle is drawn.
fn triangle(rng: &mut ChaCha8Rng, bound: i64) -> [Vector; 3] {
    let size = bound >> rng.random_range(0..u64::BITS - bound.leading_zeros());
    let centre = [(); 3].map(|()| within(rng, bound - size));
    let step = 1 << rng.random_range(0..=BEHIND + 3);
    match rng.random_range(0..6) {
        // Corners of a box.
        0 => [(); 3].map(|()| [(); 3].map(|()| *[-bound, -bound + 1, 0, bound - 1, bound].choose(rng).unwrap())),
        // A lattice of few points.
        1 => [(); 3].map(|()| [0, 1, 2].map(|j| (centre[j] + step * within(rng, 3)).clamp(-bound, bound))),
        // A plane of coordinates.
        2 => [(); 3].map(|()| [centre[0] + within(rng, size), centre[1] + within(rng, size), centre[2]]),
        _ => [(); 3].map(|()| centre.map(|x| x + within(rng, size))),
    }
}

/// A point of the plane of a triangle with coordinates in sixteenths, inside in most cases, rounded down.
fn point_of(rng: &mut ChaCha8Rng, x: &[Vector; 3]) -> Vector {
    let (u, v) = match rng.random_range(0..4) {
        0 => (16 * rng.random_range(0..2), 0),
        1 => (rng.random_range(0..=16), 0),
        2 => (rng.random_range(-16..=16), rng.random_range(-16..=16)),
        _ => (rng.random_range(0..=8), rng.random_range(0..=8)),
    };
    [0, 1, 2].map(|j| x[0][j] + ((u * (x[1][j] - x[0][j]) + v * (x[2][j] - x[0][j])) >> 4))
}

/// A second triangle that is hard beside the first.
fn beside(rng: &mut ChaCha8Rng, a: &[Vector; 3], bound: i64) -> [Vector; 3] {
    let mut b = triangle(rng, bound);
    match rng.random_range(0..9) {
        0 => {}
        // Common vertices.
        1 => b[0] = a[rng.random_range(0..3)],
        2 => (b[0], b[1]) = (a[1], a[2]),
        // One plane but for the rounding.
        3 => b = [(); 3].map(|()| point_of(rng, a)),
        // A parallel edge.
        4 => b[1] = [0, 1, 2].map(|j| b[0][j] + (a[1][j] - a[0][j])),
        // A segment or a point.
        5 => b[1] = b[0],
        6 => b = [b[0]; 3],
        // A point of one in or near the other.
        _ => {
            let (x, y) = (point_of(rng, a), point_of(rng, &b));
            let off = offset(rng);
            b = b.map(|w| [0, 1, 2].map(|j| w[j] + x[j] - y[j] + off[j]));
        }
    }
    b.map(|w| w.map(|x| x.clamp(-bound, bound)))
}

/// The greatest coordinate, entry of the matrix and translation.
fn ends(p: &Params) -> [i64; 3] {
    [p.coordinate_bound(), p.one(), p.translation_bound()].map(|bound| (bound as i64) << BEHIND)
}

/// A hard pair inside the declared ranges, under a pose if there is one.
fn query(rng: &mut ChaCha8Rng, p: &Params) -> Query {
    let [bound, one, reach] = ends(p);
    let a = triangle(rng, bound);
    let mut query = Query { a, b: beside(rng, &a, bound), m: identity(one), ..Query::default() };
    query.bypass = rng.random_range(0..6) == 0;
    if p.transform == Transform::Off || query.bypass {
        return query;
    }
    if p.transform == Transform::On {
        match rng.random_range(0..4) {
            0 => query.m = [[0, one, 0], [-one, 0, 0], [0, 0, one]],
            1 => query.m = [(); 3].map(|()| [(); 3].map(|()| *[-one, 1, 0, one - 1, one].choose(rng).unwrap())),
            _ => query.m = [(); 3].map(|()| [(); 3].map(|()| within(rng, one))),
        }
    }
    // A point of the moved B at one of A, nearly.
    if rng.random_range(0..4) > 0 {
        query.b = triangle(rng, bound);
    }
    let (x, y) = (point_of(rng, &a), point_of(rng, &query.b));
    let off = offset(rng);
    query.t = [0, 1, 2].map(|i| {
        let turned: i128 = (0..3).map(|j| i128::from(query.m[i][j]) * i128::from(y[j])).sum();
        (x[i] - (turned / i128::from(one)) as i64 + off[i]).clamp(-reach, reach)
    });
    query
}

/// The true points, whole multiples of 2^-`fraction`.
struct Truth {
    v: [[BigInt; 3]; 3],
    w: [[BigInt; 3]; 3],
    fraction: u32,
}

impl Truth {
    fn new(p: &Params, query: &Query) -> Self {
        let fraction = p.transform_width - p.int_bits + BEHIND;
        let big = |x: &Vector| x.map(BigInt::from);
        let (v, b) = (query.a.each_ref().map(big), query.b.each_ref().map(big));
        match (p.transform, query.bypass) {
            (Transform::Off, _) | (_, true) => Self { v, w: b, fraction },
            (Transform::Translate, false) => {
                let moved = |b: [BigInt; 3]| [0, 1, 2].map(|i| &b[i] + query.t[i]);
                Self { v, w: b.map(moved), fraction }
            }
            (Transform::On, false) => {
                let row = |i: usize, b: &[BigInt; 3]| (0..3).map(|j| query.m[i][j] * &b[j]).sum::<BigInt>();
                let image = |b: [BigInt; 3]| [0, 1, 2].map(|i| row(i, &b) + (BigInt::from(query.t[i]) << fraction));
                Self { v: v.map(|v| v.map(|x| x << fraction)), w: b.map(image), fraction: 2 * fraction }
            }
        }
    }

    /// The fifteen determinants as they are defined.
    fn determinants(&self) -> Fifteen<BigInt> {
        let minus = |x: &[BigInt; 3], y: &[BigInt; 3]| [0, 1, 2].map(|j| &x[j] - &y[j]);
        let cross =
            |x: &[BigInt; 3], y: &[BigInt; 3]| [(1, 2), (2, 0), (0, 1)].map(|(j, k)| &x[j] * &y[k] - &x[k] * &y[j]);
        let dot = |x: &[BigInt; 3], y: &[BigInt; 3]| (0..3).map(|j| &x[j] * &y[j]).sum::<BigInt>();
        let edge = |x: &[[BigInt; 3]; 3], k: usize| minus(&x[(k + 1) % 3], &x[k]);
        let normal = |x: &[[BigInt; 3]; 3]| cross(&edge(x, 0), &edge(x, 1));
        let Self { v, w, .. } = self;
        Fifteen {
            plane_a: [0, 1, 2].map(|l| dot(&normal(v), &minus(&w[l], &v[0]))),
            plane_b: [0, 1, 2].map(|k| dot(&normal(w), &minus(&w[0], &v[k]))),
            side: [0, 1, 2].map(|k| [0, 1, 2].map(|l| dot(&minus(&w[l], &v[k]), &cross(&edge(v, k), &edge(w, l))))),
        }
    }
}

/// The greatest part of its bound that one of fifteen errors takes, or the name of one that is beyond. The truth is in
/// units of 2^-power of those of the others.
fn greatest_part(
    determinants: Fifteen<i128>,
    bounds: Fifteen<i64>,
    truth: Fifteen<BigInt>,
    power: u32,
) -> Result<f64, String> {
    let mut greatest: f64 = 0.0;
    for (((name, x), (_, bound)), (_, truth)) in determinants.named().zip(bounds.named()).zip(truth.named()) {
        let scaled: BigInt = BigInt::from(8 * x) << power;
        let error = (scaled - BigInt::from(8) * truth).abs();
        let bound: BigInt = BigInt::from(bound) << power;
        if error > bound {
            return Err(name);
        }
        greatest = greatest.max(error.to_f64().unwrap() / bound.to_f64().unwrap());
    }
    Ok(greatest)
}

/// The same of a pair, with any constants in the bounds.
fn errors(p: &Params, constants: &Constants, query: &Query) -> Result<f64, String> {
    let test = DeterminantTest::new(p);
    let (pose, pair) = query.read();
    let coordinates = test.scaling.coordinates(&test.differences.points(&test.frame(&pose), &pair));
    let computed: Computed<i128> = test.computed(&coordinates);
    let truth = Truth::new(p, query);
    let input = p.transform_width - p.int_bits;
    let dropped = coordinates.dropped.iter().sum::<u32>() + computed.shift;
    // What is computed is in units of 2^s, with every axis scaled up by 2^(f-d).
    let power = 3 * (truth.fraction - input) + dropped;
    let bounds = test.bounds.with(constants, &coordinates, &computed.rounded, computed.shift);
    let part = greatest_part(computed.determinants, bounds, truth.determinants(), power);
    part.map_err(|name| format!("{name}: {p:?} {query:?}"))
}

/// No definite verdict contradicts the oracle.
fn sound(verdict: Verdict, exact: Exact) -> bool {
    match verdict {
        Verdict::Separate => exact == Exact::Separate,
        Verdict::Intersect => exact != Exact::Separate,
        Verdict::PossiblyIncorrect => true,
    }
}

/// The fuzz test: hard pairs at small widths with all options.
#[test]
fn errors_keep_to_their_bounds_and_verdicts_to_the_truth() {
    let mut rng = ChaCha8Rng::seed_from_u64(17);
    let (mut verdicts, mut common) = ([0; 3], 0);
    for _ in 0..2000 {
        let p = params(&mut rng, 12, 26);
        let golden = Golden::new(&p);
        for _ in 0..25 {
            let query = query(&mut rng, &p);
            errors(&p, &SECTION_5, &query).unwrap_or_else(|message| panic!("{message}"));
            let (pose, pair) = query.read();
            let (verdict, exact) = (golden.verdict(&pose, &pair), query.exact(&p));
            assert!(sound(verdict, exact), "{verdict} but {exact}: {p:?} {query:?}");
            verdicts[verdict as usize] += 1;
            common += usize::from(exact != Exact::Separate);
        }
    }
    assert!(verdicts.iter().all(|&n| n > 50) && common > 2000, "{verdicts:?}, {common}");
}

/// One number of a query is changed, by much or by little, and stays in its range.
fn step(rng: &mut ChaCha8Rng, p: &Params, query: &Query) -> Query {
    let [bound, one, reach] = ends(p);
    let mut next = *query;
    let kinds = match p.transform {
        Transform::Off => 1,
        Transform::Translate => 2,
        Transform::On => 3,
    };
    let (n, j) = (rng.random_range(0..3), rng.random_range(0..3));
    let (number, most) = match rng.random_range(0..kinds) {
        0 if rng.random() => (&mut next.a[n][j], bound),
        0 => (&mut next.b[n][j], bound),
        1 => (&mut next.t[j], reach),
        _ => (&mut next.m[n][j], one),
    };
    let bits = u64::BITS - most.leading_zeros();
    *number = match rng.random_range(0..8) {
        0 => -*number,
        1 => *[-most, 0, most].choose(rng).unwrap(),
        // The ends of what is read as the same number.
        2 => *number | ((1 << BEHIND) - 1),
        3 => *number & -(1 << BEHIND),
        _ => *number + (*[-1, 1].choose(rng).unwrap() << rng.random_range(0..bits)),
    };
    *number = (*number).clamp(-most, most);
    next
}

/// The greatest part of its bound that an error takes on the way up from a start: numbers of the user, and what the unit reads of
/// them. It ends beyond the bound that is tried.
fn climb(rng: &mut ChaCha8Rng, p: &Params, tried: &Constants, start: Query, steps: usize) -> f64 {
    let part = |query: &Query| {
        errors(p, &SECTION_5, query).unwrap_or_else(|message| panic!("{message}"));
        errors(p, tried, query).unwrap_or(f64::INFINITY)
    };
    let (mut best, mut most) = (start, part(&start));
    for _ in 0..steps {
        if most > 1.0 {
            break;
        }
        let query = step(rng, p, &best);
        let found = part(&query);
        if found >= most {
            (best, most) = (query, found);
        }
    }
    most
}

/// The whole way from numbers of the user: words, and the reals behind them. The widths are those at which axes drop as few bits
/// as the least level needs, so that errors of differences count. F with 3 x for 4 x is noticed without a transform.
#[test]
fn reals_behind_words_come_near_the_bounds_and_keep_to_them() {
    let mut rng = ChaCha8Rng::seed_from_u64(29);
    let lowered = Constants { half: 3, ..SECTION_5 };
    let cases = [
        (Transform::Off, 3, &lowered, 1.0),
        (Transform::Off, 3, &SECTION_5, 0.8),
        (Transform::Translate, 4, &lowered, 1.0),
        (Transform::Translate, 4, &SECTION_5, 0.8),
        (Transform::On, 6, &SECTION_5, 0.6),
    ];
    for (transform, fine, tried, least) in cases {
        let p = Params { method: Method::Determinants, width: 12, transform, ..Params::default() };
        let p = Params { transform_width: p.width + p.int_bits + fine - 1, ..p };
        p.validate().unwrap();
        let [bound, one, _] = ends(&p);
        let mut greatest: f64 = 0.0;
        for _ in 0..200 {
            let mut point = || match rng.random_range(0..3) {
                0 => [0; 3],
                _ => [(); 3].map(|()| *[-bound, bound].choose(&mut rng).unwrap()),
            };
            let [v1, v2, w0, w1, w2] = [(); 5].map(|()| point());
            let start = Query { a: [[0; 3], v1, v2], b: [w0, w1, w2], m: identity(one), ..Query::default() };
            greatest = greatest.max(climb(&mut rng, &p, tried, start, 300));
            if greatest > least {
                break;
            }
        }
        assert!(greatest > least, "{transform:?}: errors take {greatest} of the bounds at most");
    }
}

/// Section 6: along an axis the boxes are apart wherever they are said to be, and with a gap of 1 at levels 0 and 1 they would not
/// be, where a transform or a translation adds its errors.
#[test]
fn gaps_of_boxes_are_wide_enough() {
    let mut rng = ChaCha8Rng::seed_from_u64(31);
    for (transform, fine) in [(Transform::Off, 3), (Transform::Translate, 4), (Transform::On, 6)] {
        let (mut apart, mut wrong) = (0, 0);
        for _ in 0..12_000 {
            let p = Params { method: Method::Determinants, width: 8, transform, ..Params::default() };
            // About as many bits are dropped as level 1 needs.
            let p = Params { transform_width: p.width + fine + rng.random_range(0..3), ..p };
            let [bound, one, reach] = ends(&p);
            // A is above B, or below it, along the first axis, and both are long, so that many bits are dropped.
            let side = *[-1, 1].choose(&mut rng).unwrap();
            let near = within(&mut rng, bound / 4);
            let far = [(); 2].map(|()| rng.random_range(bound / 2..=bound));
            // Some units of the coordinates, of which there are 2^(N-1) for two times the bound, or some ulps.
            let units = (bound >> (p.width - 2)).max(1) << rng.random_range(0..4);
            let about = if rng.random() { units } else { 30 };
            let about = [(); 3].map(|()| within(&mut rng, about));
            let a = [far[0] * side, near, near + about[0].abs() * side];
            // Below, or above by an ulp or two.
            let below = [1, 2].map(|n| near - side * (about[n].abs() - 20));
            let b = [-far[1] * side, below[0], below[1]];
            // The other two axes are as long, and there the boxes are the same.
            let triangle = |x: [i64; 3]| {
                [0, 1, 2].map(|n| [x[n].clamp(-bound, bound), [-bound, 0, bound][n], [-bound, 0, bound][n]])
            };
            let mut query = Query { a: triangle(a), b: triangle(b), m: identity(one), ..Query::default() };
            if transform != Transform::Off {
                let off = within(&mut rng, reach.min(bound / 4));
                query.t[0] = off;
                query.a.iter_mut().for_each(|v| v[0] = (v[0] + off).clamp(-bound, bound));
            }
            if transform == Transform::On {
                query.m[0] = [one - rng.random_range(0..16), one, -one].map(|x: i64| x.clamp(-one, one));
            }
            let test = DeterminantTest::new(&p);
            let (pose, pair) = query.read();
            let coordinates = test.scaling.coordinates(&test.differences.points(&test.frame(&pose), &pair));
            let truth = Truth::new(&p, &query);
            let along = |points: &[[BigInt; 3]; 3]| {
                let x = points.each_ref().map(|point| point[0].clone());
                (x.iter().min().unwrap().clone(), x.iter().max().unwrap().clone())
            };
            let ((a_least, a_most), (b_least, b_most)) = (along(&truth.v), along(&truth.w));
            let meet = a_least <= b_most && b_least <= a_most;
            assert!(!(meet && boxes_apart(&coordinates)), "{p:?} {query:?}");
            apart += usize::from(boxes_apart(&coordinates));
            wrong += usize::from(meet && coordinates.level <= 1 && boxes_apart_by(1, &coordinates));
        }
        assert!(apart > 300, "{transform:?}: {apart}");
        assert!(transform == Transform::Off || wrong > 0, "{transform:?}: {wrong}");
    }
}

/// The same at every width, where numbers do not fit `i64`.
#[test]
fn wide_units_keep_to_their_bounds() {
    let mut rng = ChaCha8Rng::seed_from_u64(18);
    for _ in 0..600 {
        let p = params(&mut rng, 32, 48);
        for _ in 0..4 {
            errors(&p, &SECTION_5, &query(&mut rng, &p)).unwrap_or_else(|message| panic!("{message}"));
        }
    }
}

/// A legal pair of any parameter set, at the corners of the ranges or anywhere.
fn any(rng: &mut ChaCha8Rng, p: &Params) -> (Pose, Pair) {
    match rng.random_range(0..3) {
        0 => (sample::corner_pose(rng, p), sample::corner_pair(rng, p)),
        1 => query(rng, p).read(),
        _ => {
            let pose = sample::random_pose(rng, p);
            (pose, sample::random_pair_under(rng, p, &pose))
        }
    }
}

/// Both number types, the verdict alone, and many at once.
#[test]
fn all_ways_lead_to_one_outcome() {
    let mut rng = ChaCha8Rng::seed_from_u64(19);
    let mut seen = [0; 3];
    for _ in 0..400 {
        let p = params(&mut rng, 32, 48);
        let (golden, test) = (Golden::new(&p), DeterminantTest::new(&p));
        let (pose, first) = any(&mut rng, &p);
        let pairs: Vec<Pair> = (0..10).map(|_| any(&mut rng, &p).1).chain([first]).collect();
        let mut verdicts = vec![];
        golden.verdicts(&pose, &pairs, &mut verdicts);
        for (pair, verdict) in pairs.iter().zip(verdicts) {
            let outcome = golden.outcome(&pose, pair);
            assert_eq!(verdict, outcome.verdict);
            assert_eq!(verdict, golden.verdict(&pose, pair));
            if !outcome.outside {
                let wide = DeterminantTest { narrow: false, ..test };
                assert_eq!(wide.outcome::<false>(&wide.frame(&pose), pair), outcome);
            }
            assert_eq!((outcome.separated & outcome.overlapping, outcome.overlapping & 0b111), (0, 0));
            let edges = outcome.separated >> 3;
            let expected = match (outcome.separated & 0b111 != 0 || edges.count_ones() >= 5, outcome.overlapping) {
                (true, _) => Verdict::Separate,
                (false, 0) => Verdict::PossiblyIncorrect,
                (false, _) => Verdict::Intersect,
            };
            assert_eq!(verdict, expected);
            seen[verdict as usize] += 1;
        }
    }
    assert!(seen.iter().all(|&n| n > 30), "{seen:?}");
}
