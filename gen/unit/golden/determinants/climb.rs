//! Sections 7.3 to 7.5 of docs/determinants.md by a search that climbs: points, and errors of their coordinates, that bring the
//! error of a number as near to its bound as they can. No error passes its bound, and each constant of section 5 less one is
//! noticed: then an error does pass.

// Loops over components read like the equations.
#![allow(clippy::needless_range_loop)]

use super::bounds::{Bounds, Constants, SECTION_5};
use super::coordinates::Coordinates;
use super::differences::Points;
use super::fifteen::{Dots, Fifteen};
use super::moments::{Moments, Rounding};
use super::number::{Vector, cross, dot, minus};
use crate::params::options::Choice;
use crate::params::{Bound, Params, SPAN};
use efsat_hardware::testing::full;
use rand::rngs::ChaCha8Rng;
use rand::seq::IndexedRandom;
use rand::{RngExt, SeedableRng};

/// Wide enough for lengths to count more than constants, and narrow enough for `i64`.
const WIDTH: u32 = 16;

/// The greatest coordinate.
const END: i64 = (1 << (WIDTH - 1)) - 1;

/// Numbers: the fifteen in the order of their names.
const NUMBERS: usize = 15;

/// The corners of the tetrahedron of a number among V0, V1, V2, W0, W1, W2, and the sign of the number.
fn corners(number: usize) -> ([usize; 4], i64) {
    let (k, l) = (number / 3, number % 3);
    match k {
        0 => ([0, 1, 2, 3 + l], 1),
        1 => ([l, 3, 4, 5], 1),
        _ => ([k - 2, (k - 1) % 3, 3 + l, 3 + (l + 1) % 3], -1),
    }
}

fn nth<T: Copy>(Fifteen { plane_a, plane_b, side }: &Fifteen<T>, number: usize) -> T {
    [plane_a, plane_b, &side[0], &side[1], &side[2]][number / 3][number % 3]
}

/// Six times the volume of a tetrahedron.
fn volume(x: &[Vector; 4]) -> i64 {
    dot(&minus(&x[1], &x[0]), &cross(&minus(&x[2], &x[0]), &minus(&x[3], &x[0])))
}

/// A unit at one level, with its own constants and those that are tried.
struct Unit {
    rounding: Rounding,
    bounds: Bounds,
    level: u32,
    tried: Constants,
    tried_level: u32,
}

/// An error and two bounds on it, all in the same unit.
#[derive(Clone, Copy)]
struct Found {
    error: i64,
    bound: i64,
    tried: i64,
}

impl Found {
    /// The part of the bound that is tried.
    fn part(self) -> f64 {
        self.error as f64 / self.tried as f64
    }
}

impl Unit {
    fn new(bound: Bound, span: u32, level: u32) -> Self {
        let p = Params { width: WIDTH, transform_width: WIDTH, span, bound, ..Params::default() };
        let (rounding, bounds) = (Rounding::new(&p), Bounds::new(&p));
        Self { rounding, bounds, level, tried: SECTION_5, tried_level: level }
    }

    /// The error of a number with these coordinates, if each true one is off by all that the level allows, towards greater
    /// volumes or towards smaller ones.
    fn look(&self, points: &Points, number: usize) -> Found {
        let (corners, sign) = corners(number);
        let Points { v: [v1, v2], w: [w0, w1, w2] } = *points;
        let six = [[0; 3], v1, v2, w0, w1, w2];
        let of = corners.map(|corner| six[corner]);
        let edges = [1, 2, 3].map(|n| minus(&of[n], &of[0]));
        let normals = [cross(&edges[1], &edges[2]), cross(&edges[2], &edges[0]), cross(&edges[0], &edges[1])];
        let opposite = [0, 1, 2].map(|j| -(normals[0][j] + normals[1][j] + normals[2][j]));
        let normals = [opposite, normals[0], normals[1], normals[2]];
        let eps = 4 + (1 << self.level);
        let (moments, shift) = self.rounding.apply(&Moments::new(points));
        let computed = nth(&Dots::<i64>::new(points, &moments).determinants(), number) << shift << 9;
        // In eighths.
        let error = |towards: i64| {
            let moved = [0, 1, 2, 3].map(|n| {
                let off = if corners[n] == 0 { 0 } else { eps };
                [0, 1, 2].map(|j| 8 * of[n][j] + if towards * normals[n][j] < 0 { -off } else { off })
            });
            (computed - sign * volume(&moved)).abs()
        };
        let bound = |constants: &Constants, level: u32| {
            let coordinates = Coordinates { points: *points, dropped: [0; 3], level };
            nth(&self.bounds.with(constants, &coordinates, &moments, shift), number) << shift << 6
        };
        Found {
            error: error(1).max(error(-1)),
            bound: bound(&SECTION_5, self.level),
            tried: bound(&self.tried, self.tried_level),
        }
    }

    /// Steps from a start towards greater parts of the bound that is tried, as long as it holds. No step finds an error that is
    /// beyond the bound of the unit.
    fn climb(&self, rng: &mut ChaCha8Rng, start: Points, number: usize, steps: usize) -> f64 {
        let look = |points: &Points| {
            let found = self.look(points, number);
            assert!(
                found.error <= found.bound,
                "number {number}, level {}: {points:?} in {:?}",
                self.level,
                self.bounds
            );
            found.part()
        };
        let (mut best, mut most) = (start, look(&start));
        for _ in 0..steps {
            if most > 1.0 {
                break;
            }
            // Two at a time, too: one alone may make it worse.
            let points = step(rng, best);
            let points = if rng.random() { step(rng, points) } else { points };
            let found = look(&points);
            if found >= most {
                (best, most) = (points, found);
            }
        }
        most
    }
}

/// One coordinate, or one point, is changed.
fn step(rng: &mut ChaCha8Rng, points: Points) -> Points {
    let mut five = [points.v[0], points.v[1], points.w[0], points.w[1], points.w[2]];
    let (n, other, j) = (rng.random_range(0..5), rng.random_range(0..5), rng.random_range(0..3));
    match rng.random_range(0..8) {
        0 => five[n][j] = *[-END, 0, END].choose(rng).unwrap(),
        1 => five[n][j] = -five[n][j],
        2 => five[n] = five[other],
        3 => five[n] = five[other].map(|x| -x),
        4 => five[n] = five[n].map(|x| x / 2),
        _ => five[n][j] += *[-1, 1].choose(rng).unwrap() << rng.random_range(0..WIDTH - 1),
    }
    let [v1, v2, w0, w1, w2] = five.map(|point| point.map(|x| x.clamp(-END, END)));
    Points { v: [v1, v2], w: [w0, w1, w2] }
}

/// Where errors are great. The normals of faces are, between corners of the cube. The rounding of a moment is, where its three
/// components are halves of 2^s: between the corners of a triangle in the plane x + y + z = 0 around the origin, of this size. Terms
/// of second order are, where B is small and in a corner.
fn start(rng: &mut ChaCha8Rng) -> Points {
    let size = 181;
    let around: [Vector; 3] = [[size, -size, 0], [0, size, -size], [-size, 0, size]];
    let mut point = || match rng.random_range(0..4) {
        0 => [0; 3],
        1 => *around.choose(rng).unwrap(),
        _ => [(); 3].map(|()| *[-END, END].choose(rng).unwrap()),
    };
    let [v1, v2, w0, w1, w2] = [(); 5].map(|()| point());
    match rng.random_range(0..9) {
        0 => Points { v: [v1, v2], w: around },
        1 => Points { v: [v1, v1.map(|x| -x)], w: around },
        2 => Points { v: [around[0], around[1]], w: [w0, w1, w2] },
        3 => Points { v: [around[0], around[1]], w: [w0, w0.map(|x| -x), w2] },
        4 => Points { v: [v1, v2], w: [w0, around[0], around[1]] },
        5 => Points { v: [v1, v2], w: [w0, w0.map(|x| -x), w2] },
        6 => Points { v: [v1, v2], w: [(); 3].map(|()| w0.map(|x| x - x.signum() * rng.random_range(0..2 * size))) },
        _ => Points { v: [v1, v2], w: [w0, w1, w2] },
    }
}

/// A constant less one, with the numbers that it is for and the kinds of bounds that have it.
struct Lowered {
    name: String,
    tried: Constants,
    numbers: &'static [usize],
    kinds: &'static [Bound],
    levels: &'static [u32],
}

/// The numbers of each formula.
const PLANE_A: &[usize] = &[0, 1, 2];
const PLANE_B_0: &[usize] = &[3];
const PLANE_B_I: &[usize] = &[4, 5];
const ENDS: [&[usize]; 2] = [&[6, 7, 8], &[12, 13, 14]];
const SIDE_1: &[usize] = &[9, 10, 11];

/// Every constant of section 5 less one, but for c(k) and the lengths of four points in `static`, which section 7.10 says to have
/// room.
fn lowered() -> Vec<Lowered> {
    let mut all = vec![];
    let mut less = |name: &str, n: usize, numbers, change: &dyn Fn(&mut Constants)| {
        let mut tried = SECTION_5;
        change(&mut tried);
        let kinds: &[Bound] =
            if name.starts_with("static") { &[Bound::Static] } else { &[Bound::Products, Bound::Moments] };
        let levels: &[u32] = if name.ends_with('k') { &[2] } else { &[0, 6] };
        all.push(Lowered { name: format!("{name} {n}"), tried, numbers, kinds, levels });
    };
    for numbers in [PLANE_A, PLANE_B_0, PLANE_B_I, ENDS[0], ENDS[1], SIDE_1] {
        less("4 x in F, number", numbers[0], numbers, &|c| c.half -= 1);
    }
    less("plane_b[0]: face", 0, PLANE_B_0, &|c| c.plane_b_0.faces[0] -= 1);
    less("plane_b[0]: length", 0, PLANE_B_0, &|c| c.plane_b_0.lengths[0] -= 1);
    less("plane_b[0]: k", 0, PLANE_B_0, &|c| c.plane_b_0.k -= 1);
    less("plane_a: length", 0, PLANE_A, &|c| c.plane_a.lengths[0] -= 1);
    (0..3).for_each(|n| less("plane_a: face", n, PLANE_A, &|c| c.plane_a.faces[n] -= 1));
    (0..4).for_each(|n| less("plane_b[i]: face", n, PLANE_B_I, &|c| c.plane_b_i.faces[n] -= 1));
    (0..2).for_each(|n| less("plane_b[i]: length", n, PLANE_B_I, &|c| c.plane_b_i.lengths[n] -= 1));
    (0..6).for_each(|n| less("side[1]: face", n, SIDE_1, &|c| c.side_1.faces[n] -= 1));
    (0..2).for_each(|n| less("side[1]: length", n, SIDE_1, &|c| c.side_1.lengths[n] -= 1));
    for i in 0..2 {
        (0..3).for_each(|n| less(&format!("side[{}]: face", 2 * i), n, ENDS[i], &|c| c.ends[i].faces[n] -= 1));
        less(&format!("side[{}]: length", 2 * i), 0, ENDS[i], &|c| c.ends[i].lengths[0] -= 1);
    }
    less("static: faces of", 3, PLANE_A, &|c| c.three_points.faces[0] -= 1);
    less("static: lengths of", 3, PLANE_A, &|c| c.three_points.lengths[0] -= 1);
    less("static: faces of", 4, PLANE_B_I, &|c| c.four_points.faces[0] -= 1);
    all
}

/// Whether some climb of so many starts finds an error beyond the bound that is tried; else the greatest part of it.
fn noticed(rng: &mut ChaCha8Rng, lowered: &Lowered, starts: usize) -> Result<(), f64> {
    let mut greatest: f64 = 0.0;
    for n in 0..starts {
        for (&bound, &level) in
            lowered.kinds.iter().flat_map(|bound| lowered.levels.iter().map(move |level| (bound, level)))
        {
            let unit = Unit { tried: lowered.tried, ..Unit::new(bound, SPAN[n % SPAN.len()], level) };
            let number = *lowered.numbers.choose(rng).unwrap();
            let start = start(rng);
            greatest = greatest.max(unit.climb(rng, start, number, 1500));
            if greatest > 1.0 {
                return Ok(());
            }
        }
    }
    Err(greatest)
}

#[test]
fn each_constant_less_one_is_noticed() {
    let mut rng = ChaCha8Rng::seed_from_u64(37);
    let all = lowered();
    assert_eq!(all.len(), 38);
    for lowered in all {
        let found = noticed(&mut rng, &lowered, 400);
        assert_eq!(found, Ok(()), "{}", lowered.name);
    }
}

/// Section 7.10: what has room has it. No climb finds an error beyond a bound with c(k-1) for c(k) but in `plane_b[0]`, or with 7 for
/// the 8 of c(k).
#[test]
fn constants_with_room_are_not_passed() {
    let mut rng = ChaCha8Rng::seed_from_u64(40);
    let mut halved = SECTION_5;
    let Constants { plane_a, plane_b_i, ends: [first, last], side_1, three_points: three, four_points: four, .. } =
        &mut halved;
    let of_rows =
        [&mut plane_a.k, &mut plane_b_i.k, &mut first.k, &mut last.k, &mut side_1.k, &mut three.k, &mut four.k];
    of_rows.into_iter().for_each(|k| *k -= 1);
    let seven = Constants { rest: 7, ..SECTION_5 };
    for (bound, number) in Bound::ALL.iter().flat_map(|&bound| (0..NUMBERS).map(move |number| (bound, number))) {
        for n in 0..if full() { 400 } else { 12 } {
            // Where terms of second order are greatest beside c(k).
            let mut unit = Unit::new(bound, SPAN[n % SPAN.len()], 2);
            unit.tried = if PLANE_B_0.contains(&number) { seven } else { halved };
            let start = start(&mut rng);
            let part = unit.climb(&mut rng, start, number, 400);
            assert!(part <= 1.0, "{bound:?}, number {number}: {part}");
        }
    }
}

/// So is 2^level in F, at every level that has one below. `plane_b[i]` with `edges` has room for it.
#[test]
fn each_level_less_one_is_noticed() {
    let mut rng = ChaCha8Rng::seed_from_u64(39);
    for bound in [Bound::Static, Bound::Edges, Bound::Moments, Bound::Products] {
        for (level, number) in (1..=6).flat_map(|level| (0..NUMBERS).map(move |number| (level, number))) {
            if bound == Bound::Edges && PLANE_B_I.contains(&number) {
                continue;
            }
            let found = (0..400).any(|_| {
                let unit = Unit { tried_level: level - 1, ..Unit::new(bound, 1, level) };
                let start = start(&mut rng);
                unit.climb(&mut rng, start, number, 400) > 1.0
            });
            assert!(found, "{bound:?}, level {level}, number {number}");
        }
    }
}

/// The greatest parts of the bounds themselves. `plane_b[i]` takes less with `edges`, which knows nothing of n_B but the lengths of
/// edges.
#[test]
fn errors_come_near_their_bounds_and_keep_to_them() {
    let mut rng = ChaCha8Rng::seed_from_u64(38);
    let starts = if full() { 400 } else { 12 };
    for (&bound, level) in Bound::ALL.iter().flat_map(|bound| (0..=6).map(move |level| (bound, level))) {
        let part = |rng: &mut ChaCha8Rng, number: usize| {
            let climb = |n: usize| {
                let unit = Unit::new(bound, SPAN[n % SPAN.len()], level);
                let start = start(rng);
                unit.climb(rng, start, number, 400)
            };
            (0..starts).map(climb).fold(0.0, f64::max)
        };
        for number in 0..NUMBERS {
            let least = match bound {
                Bound::Edges if PLANE_B_I.contains(&number) => 0.5,
                Bound::Static => 0.75,
                _ => 0.9,
            };
            let part = part(&mut rng, number);
            assert!(
                part > least,
                "{bound:?}, level {level}, number {number}: errors take {part} of their bounds at most"
            );
        }
    }
}
