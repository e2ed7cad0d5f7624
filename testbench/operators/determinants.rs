//! Stages of the determinant unit against what docs/determinants.md defines.

use super::{Bench, tuples};
use efsat::design::determinants::coordinates::{Scale, axis_shift, carries, rounded, shifted};
use efsat::design::determinants::differences::row;
use efsat::design::determinants::moments::component;
use efsat::graph::{Signals, Vec3};
use efsat::op::Type;
use efsat::params::{Method, Params, Transform};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

/// Halves up.
fn round(x: i128, drop: u32) -> i128 {
    (x + (1 << drop >> 1)) >> drop
}

fn integer(bits: u32) -> Type {
    Type { signed: true, bits, fraction: None }
}

#[test]
fn coordinates_are_rounded_by_the_least_shift_that_fits() {
    const MOST: i128 = 75;
    for (transform, levels) in [(Transform::On, 6), (Transform::On, 2), (Transform::On, 0), (Transform::Off, 2)] {
        for width in [4, 5, 7] {
            let p = Params { method: Method::Determinants, width, levels, transform, ..Params::default() };
            let fine = if transform == Transform::On { 6 } else { 2 };
            let (least, reach) = (fine - levels, 1 << (width - 1));
            // Five points along one axis.
            let mut unit = Bench::new(|top| {
                let x = [(); 5].map(|()| top.input(integer(8), (-MOST, MOST))).named("x");
                let scale = Scale::new(&p, (-MOST, MOST));
                let shift = axis_shift(&scale, x);
                let all = Vec3::each(|_| shift.clone());
                let cut = x.map(|x| shifted(&scale, Vec3::each(|_| x), all.clone())).named("cut");
                let carried = carries(&scale, cut.map(|cut| cut[0]));
                let y = cut.map(|cut| rounded(&scale, cut, Vec3::each(|_| carried))).named("y");
                // The results are called otherwise than what the units make.
                y.map(|y| y[0].at_point(Some(0))).to_vec()
            });
            let mut check = |x: [i128; 5]| {
                let fits = |drop: &u32| x.iter().all(|x| round(*x, *drop).abs() < reach);
                let drop = (least..).find(fits).unwrap();
                assert_eq!(unit.run(&[], &x), x.map(|x| round(x, drop)), "{x:?} at width {width}, levels {levels}");
            };
            let values: Vec<i128> = (-MOST..=MOST).collect();
            tuples(&values, 2, |x| check([0, x[0], x[1], 0, 0]));
            let powers: Vec<i128> =
                [0, 1, 3, 4, 7, 8, 15, 16, 31, 32, 33, 63, 64, 75].into_iter().flat_map(|x| [x, -x]).collect();
            tuples(&powers, 3, |x| check([x[0], x[1], 0, 1, x[2]]));
        }
    }
}

#[test]
fn moments_that_are_too_great_for_a_shift_are_noticed() {
    for (width, span) in [(4, 0), (4, 1), (5, 1), (5, 3)] {
        let p = Params { width, span, ..Params::default() };
        let most = (1 << (width - 1)) - 1;
        let mut unit = Bench::new(|top| {
            let input = || top.input(integer(width), (-most, most));
            let [plus, minus] = [(); 2].map(|()| [(); 2].map(|()| input())).named("x");
            let (cut, too_great) = component(&p, plus, minus);
            [vec![cut], too_great].concat()
        });
        let values: Vec<i128> = (-most..=most).step_by(if width == 4 { 1 } else { 2 }).chain([0, most - 1]).collect();
        tuples(&values, 4, |x| {
            let exact = x[0] * x[1] - x[2] * x[3];
            let found = unit.run(&[], x);
            assert_eq!(found[0], exact >> (width - span - 1));
            for k in 0..span {
                let rounded = round(exact, width - span + k);
                let fits = (-(1 << (width - 1))..1 << (width - 1)).contains(&rounded);
                assert_eq!(found[1 + k as usize], i128::from(!fits), "{x:?}");
            }
            assert!(round(exact, width).abs() < 1 << (width - 1), "the greatest shift fits");
        });
    }
}

#[test]
fn rows_are_what_they_are_defined_to_be() {
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    // Exact in one multiplier, cut, and exact in several.
    for transform_width in [18, 20, 32, 34, 35, 48] {
        let p = Params { method: Method::Determinants, transform_width, ..Params::default() };
        let fraction = transform_width - 4;
        let low_bits = (fraction + 3).saturating_sub(18);
        let low_bits = if 2 * low_bits <= fraction { low_bits } else { 0 };
        let one = p.one();
        let mut unit = Bench::new(|top| {
            let vector = |name| Vec3::each(|_| top.input(integer(transform_width), (-one, one))).named(name);
            let (m, w) = (vector("m"), vector("w"));
            vec![row(&p, m, w)]
        });
        for _ in 0..3000 {
            let x = [(); 6].map(|()| match rng.random_range(0..4) {
                0 => *[-one, -one + 1, -1, 0, 1, one - 1, one].get(rng.random_range(0..7)).unwrap(),
                _ => rng.random_range(-one..=one),
            });
            let middle = |x: i128| 2 * x + 1;
            let low = |x: i128| x & ((1 << low_bits) - 1);
            let product = |j: usize| {
                let [m, w] = [middle(x[j]), middle(x[3 + j])];
                m * w - low(m) * low(w)
            };
            let left_out = if low_bits > 0 { 3 << (2 * low_bits - 1) } else { 0 };
            let sum = product(0) + product(1) + product(2) + left_out;
            assert_eq!(unit.run(&[], &x), [round(sum, fraction + 2)], "{x:?}");
        }
    }
}
