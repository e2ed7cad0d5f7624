//! Multiplication: the contract's, on all small intervals, in tiles, and of quantised numbers.

use super::{Bench, Bounds, at, contains, intervals, product, sign_case, sign_cases, values};
use efsat::design::multiply;
use efsat::design::multiply::Span;
use efsat::graph::Type;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use std::collections::HashSet;

#[test]
fn multiplication_is_the_contracts_on_all_small_intervals() {
    for (bits, x_bound, y_bound) in [(4, 7, 7), (5, 8, 8), (5, 15, 15), (5, 3, 15), (6, 16, 1)] {
        let ty = Type::signed(bits, 0);
        let mut unit = Bench::new(&multiply::multiply_unit("multiply", (ty, x_bound), (ty, y_bound)));
        for x in intervals(-x_bound..=x_bound) {
            for y in intervals(-y_bound..=y_bound) {
                unit.run(&[x, y], &sign_cases(&[x, y]));
                let found = unit.interval("");
                assert_eq!(found, product(x, y), "{x:?} {y:?}");
                assert!(values(x).all(|a| values(y).all(|b| contains(found, a * b))), "{x:?} {y:?}");
            }
        }
    }
}

#[test]
fn sign_cases_are_as_defined() {
    let mut unit = Bench::new(&multiply::sign_case_unit(Type::signed(5, 0), 15));
    for x in intervals(-15..=15) {
        unit.run(&[x], &[]);
        assert_eq!(unit.evaluator.output("x_sign_case"), sign_case(x), "{x:?}");
    }
}

#[test]
fn multiplication_of_quantised_numbers_is_the_contracts() {
    // Upper bounds one ulp above the range (implied), or within it (sticky); one multiplier, and tiles.
    for (m_lo, x_lo) in [(7, 5), (8, 8), (1 << 17, 3), (3, 1 << 35)] {
        for beyond in [0, 1] {
            let span = |lo: i128| Span { ty: Type::signed(48, 3), lo, hi: lo + beyond };
            let mut unit = Bench::new(&multiply::quantised_multiply_unit("multiply", span(m_lo), span(x_lo)));
            let numbers = |most: i128| {
                let near = move |x: i128| (x - 9..=x + 9).filter(move |x| x.abs() <= most);
                let lower: HashSet<i128> = [-most, -1 << 17, 0, 1 << 17, most].into_iter().flat_map(near).collect();
                let ulps = lower.into_iter().flat_map(|lo| [at(lo, lo), at(lo, lo + 1)]);
                ulps.filter(move |x| x.hi <= most + beyond).collect::<Vec<_>>()
            };
            for m in numbers(m_lo) {
                for x in numbers(x_lo) {
                    unit.run(&[], &[m.lo, m.hi - m.lo, x.lo, x.hi - x.lo]);
                    assert_eq!(unit.interval(""), product(m, x), "{m:?} {x:?}");
                }
            }
        }
    }
}

#[test]
fn multiplication_in_tiles_is_exact() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    for (x_bits, y_bits) in [(18, 18), (19, 19), (19, 12), (32, 32), (35, 35), (36, 19), (48, 48), (20, 48)] {
        let bound = |bits: u32| (1i128 << (bits - 1)) - 1;
        let (x_bound, y_bound) = (bound(x_bits), bound(y_bits));
        let (x_type, y_type) = (Type::signed(x_bits, 4), Type::signed(y_bits, -3));
        let mut unit = Bench::new(&multiply::multiply_unit("multiply", (x_type, x_bound), (y_type, y_bound)));
        // Values at the seams of tiles of 17 bits.
        let corners = |bound: i128| -> Vec<i128> {
            let seams = [0, 1, 1 << 16, (1 << 17) - 1, 1 << 17, (1 << 17) + 1, 1 << 33, (1 << 34) - 1, 1 << 34, bound];
            let kept = seams.into_iter().filter(|x| *x <= bound);
            kept.flat_map(|x| [x, -x]).collect::<HashSet<_>>().into_iter().collect()
        };
        let (x_corners, y_corners) = (corners(x_bound), corners(y_bound));
        let mut check = |x: Bounds, y: Bounds| {
            unit.run(&[x, y], &sign_cases(&[x, y]));
            assert_eq!(unit.interval(""), product(x, y), "{x:?} {y:?}");
        };
        for &x in &x_corners {
            for &y in &y_corners {
                check(at(x, x), at(y, y));
            }
        }
        for _ in 0..5000 {
            let mut draw = |corners: &[i128], bound: i128| {
                let mut value = || match rng.random_range(0..3) {
                    0 => corners[rng.random_range(0..corners.len())],
                    _ => rng.random_range(-bound..=bound) >> rng.random_range(0..40),
                };
                let (a, b) = (value(), value());
                at(a.min(b), a.max(b))
            };
            let (x, y) = (draw(&x_corners, x_bound), draw(&y_corners, y_bound));
            check(x, y);
        }
    }
}
