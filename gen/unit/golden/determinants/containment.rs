//! Sections 7.3 to 7.5 of docs/determinants.md by enumeration: at 2 bits, where coordinates are -1, 0 and 1, each bound
//! contains the error of its number for all points, all errors of a level, all spans and all kinds of bounds but `products`,
//! which takes six bits. Levels from 3 on are for R from 32 on. A thirteenth of the first columns is tried on every change.

use super::bounds::Bounds;
use super::coordinates::Coordinates;
use super::differences::Points;
use super::fifteen::{Dots, Fifteen};
use super::moments::{Moments, Rounding};
use super::number::{Vector, cross, minus, norm};
use crate::golden::interval::three;
use crate::params::{Bound, Params};
use efsat_hardware::testing::full;
use rayon::prelude::*;

const WIDTH: u32 = 2;

/// Levels, of errors of 5, 6 and 8 eighths.
const LEVELS: [u32; 3] = [0, 1, 2];

/// The coordinates along one axis, by their number.
fn column(number: usize) -> [i64; 5] {
    [1, 3, 9, 27, 81].map(|place| (number / place % 3) as i64 - 1)
}

const COLUMNS: usize = 243;

/// What a number can be wrong by if corners of its tetrahedron move by eps: the sums of the norms of the normals of faces
/// opposite a corner, of edges opposite two, and the number of sets of three.
struct Order {
    faces: i64,
    edges: i64,
    corners: i64,
}

impl Order {
    /// V0, the first of the six points, does not move.
    fn new(points: &[Vector; 6], corners: [usize; 4]) -> Self {
        let moving = |n: &usize| corners[*n] != 0;
        let others = |out: &[usize]| -> Vec<&Vector> {
            (0..4).filter(|n| !out.contains(n)).map(|n| &points[corners[n]]).collect()
        };
        let face = |n: usize| {
            let of = others(&[n]);
            norm(&cross(&minus(of[1], of[0]), &minus(of[2], of[0])))
        };
        let edge = |n: usize, m: usize| {
            let of = others(&[n, m]);
            norm(&minus(of[1], of[0]))
        };
        let number = (0..4).filter(moving).count();
        Self {
            faces: (0..4).filter(moving).map(face).sum(),
            edges: (0..4).filter(moving).flat_map(|n| (n + 1..4).filter(moving).map(move |m| edge(n, m))).sum(),
            corners: if number == 3 { 1 } else { 4 },
        }
    }

    /// In 128ths, with eps in eighths.
    fn most(&self, eps: i64) -> i64 {
        16 * eps * self.faces + 4 * eps * eps * self.edges + eps * eps * eps * self.corners
    }
}

/// The units of a kind of bounds, by their spans.
fn units(bound: Bound) -> [(Bounds, Rounding); 3] {
    [0, 1, 2].map(|span| {
        let p = Params { width: WIDTH, span, bound, ..Params::default() };
        (Bounds::new(&p), Rounding::new(&p))
    })
}

fn all<T>(Fifteen { plane_a, plane_b, side }: Fifteen<T>) -> impl Iterator<Item = T> {
    plane_a.into_iter().chain(plane_b).chain(side.into_iter().flatten())
}

/// The greatest part of a bound that an error takes, in thousandths, by the kind of bounds; more than 1000 breaks it.
fn greatest_parts(points: &Points, kinds: &[[(Bounds, Rounding); 3]; 3]) -> [i64; 3] {
    let Points { v: [v1, v2], w: [w0, w1, w2] } = *points;
    let six = [[0; 3], v1, v2, w0, w1, w2];
    let order = |corners| {
        let order = Order::new(&six, corners);
        LEVELS.map(|level| order.most(4 + (1 << level)))
    };
    let orders = Fifteen {
        plane_a: three(|l| order([0, 1, 2, 3 + l])),
        plane_b: three(|k| order([k, 3, 4, 5])),
        side: three(|k| three(|l| order([k, (k + 1) % 3, 3 + l, 3 + (l + 1) % 3]))),
    };
    let moments = Moments::new(points);
    let exact = Dots::<i64>::new(points, &moments).determinants();
    let part = |(bounds, rounding): &(Bounds, Rounding)| {
        let (rounded, shift) = rounding.apply(&moments);
        let numbers = Dots::<i64>::new(points, &rounded).determinants();
        let wrong = exact.zip(&numbers, |exact, number| 128 * (exact - (number << shift)).abs());
        let of_level = |level: u32| {
            let coordinates = Coordinates { points: *points, dropped: [0; 3], level };
            let bounds =
                bounds.of(&coordinates, &rounded, shift).zip(&wrong, |bound, wrong| (bound << shift << 4, wrong));
            let parts = bounds.zip(&orders, |(bound, wrong), orders| 1000 * (wrong + orders[level as usize]) / bound);
            all(parts).max().expect("fifteen")
        };
        LEVELS.map(of_level).into_iter().max().expect("three levels")
    };
    three(|kind| kinds[kind].iter().map(part).max().expect("three spans"))
}

#[test]
fn each_bound_contains_the_error_of_its_number() {
    let kinds = [Bound::Static, Bound::Edges, Bound::Moments].map(units);
    let greater = |x: [i64; 3], y: [i64; 3]| three(|kind| x[kind].max(y[kind]));
    // Axes may be exchanged in turn, so that the first has the least number.
    let first = |x: usize| {
        let rest = (x..COLUMNS).flat_map(|y| (x..COLUMNS).map(move |z| [x, y, z]));
        rest.map(|columns| greatest_parts(&Points::new(columns.map(column)), &kinds)).fold([0; 3], greater)
    };
    let share = if full() { 1 } else { 31 };
    let greatest =
        (0..COLUMNS).step_by(share).collect::<Vec<_>>().into_par_iter().map(first).reduce(|| [0; 3], greater);
    // So a quarter of a bound would be found to be broken.
    let holds = greatest.iter().all(|part| (250..=1000).contains(part));
    assert!(holds, "errors take {greatest:?} thousandths of their bounds: static, edges, moments");
}
