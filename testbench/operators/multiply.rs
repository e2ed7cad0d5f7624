//! Multiplication: the contract's, on all small intervals, and in tiles.

use super::{Bench, Bounds, at, inputs, intervals, product, values};
use efsat::design::interval::{Factor, sign, sign_case};
use efsat::graph::Signals;
use efsat::op::Type;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use std::collections::BTreeSet;

/// A product of two intervals, each with its type and bound, made of multipliers of so many bits.
fn multiplier([x, y]: [(Type, i128); 2], of: [u32; 2]) -> Bench {
    Bench::of_multipliers(of, |top| {
        let ([x], [y]) = (inputs(top, "x", x.0, x.1), inputs(top, "y", y.0, y.1));
        // One entity finds the sign cases of both.
        let bits = x.lo.ty().bits.max(y.lo.ty().bits);
        let sign_cases = [x, y].map(|x| sign_case(x.each(|_, end| end.bits(bits)))).named("case");
        let factor = |i: usize| Factor { interval: [x, y][i], sign_case: sign_cases[i] };
        (factor(0) * factor(1)).signals()
    })
}

#[test]
fn multiplication_is_the_contracts_on_all_small_intervals() {
    for (bits, x_bound, y_bound) in [(4, 7, 7), (5, 8, 8), (5, 15, 15), (5, 3, 15), (6, 16, 1)] {
        let mut unit = multiplier([x_bound, y_bound].map(|bound| (Type::signed(bits, 0), bound)), [18, 18]);
        for x in intervals(-x_bound..=x_bound) {
            for y in intervals(-y_bound..=y_bound) {
                let found = unit.bounds(&[x, y], &[])[0];
                assert_eq!(found, product(x, y), "{x:?} {y:?}");
                assert!(values(x).all(|a| values(y).all(|b| values(found).contains(&(a * b)))), "{x:?} {y:?}");
            }
        }
    }
}

#[test]
fn sign_cases_are_as_defined() {
    let mut unit = Bench::new(|top| sign_case(inputs::<1>(top, "x", Type::signed(5, 0), 15)[0]).signals());
    for x in intervals(-15..=15) {
        let expected = match () {
            () if 0 <= x.lo => sign::POSITIVE,
            () if x.hi <= 0 => sign::NEGATIVE,
            () if -x.lo <= x.hi => sign::UPPER,
            () => sign::LOWER,
        };
        assert_eq!(unit.run(&[x], &[]), [expected as i128], "{x:?}");
    }
}

#[test]
fn multiplication_in_tiles_is_exact() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let widths = [[18, 18], [19, 19], [19, 12], [32, 32], [35, 35], [36, 19], [48, 48], [20, 48]];
    let wider = [[25, 18], [18, 25], [24, 24], [26, 27], [32, 32], [49, 35], [35, 49], [48, 48]];
    let cases = widths.map(|bits| ([18, 18], bits)).into_iter();
    for (of, bits) in cases.chain(wider.into_iter().flat_map(|bits| [([25, 18], bits), ([27, 18], bits)])) {
        let bounds = bits.map(|bits| (1i128 << (bits - 1)) - 1);
        let types = [Type::signed(bits[0], 4), Type::signed(bits[1], -3)];
        let mut unit = multiplier([(types[0], bounds[0]), (types[1], bounds[1])], of);
        // Values at the seams of tiles of 17 bits, and of more.
        let corners = bounds.map(|bound| {
            let mut seams =
                vec![0, 1, 1 << 16, (1 << 17) - 1, 1 << 17, (1 << 17) + 1, 1 << 33, (1 << 34) - 1, 1 << 34, bound];
            if of[0] > 18 {
                seams.extend([24, 26, 48].into_iter().flat_map(|bit| [(1 << bit) - 1, 1 << bit]));
            }
            let kept = seams.into_iter().filter(|x| *x <= bound).flat_map(|x| [x, -x]).collect::<BTreeSet<_>>();
            kept.into_iter().collect::<Vec<i128>>()
        });
        let mut check = |x: Bounds, y: Bounds| {
            assert_eq!(unit.bounds(&[x, y], &[]), [product(x, y)], "{x:?} {y:?}");
        };
        for &x in &corners[0] {
            corners[1].iter().for_each(|&y| check(at(x, x), at(y, y)));
        }
        for _ in 0..5000 {
            let [x, y] = [0, 1].map(|i: usize| {
                let mut value = || match rng.random_range(0..3) {
                    0 => corners[i][rng.random_range(0..corners[i].len())],
                    _ => rng.random_range(-bounds[i]..=bounds[i]) >> rng.random_range(0..40),
                };
                let (a, b) = (value(), value());
                at(a.min(b), a.max(b))
            });
            check(x, y);
        }
    }
}
