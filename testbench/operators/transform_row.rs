//! Rows of the frame transform contain every true row.

use super::{Bench, Bounds, UPPERS, at, plus, product, rounded};
use efsat::design::transform_row::Quantised;
use efsat::design::{interval, transform_row};
use efsat::graph::{Builder, Rate};
use efsat::number::Upper;
use efsat::params::{Params, Transform};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// The least widths at which inputs have fraction bits.
pub(super) fn small(upper: Upper) -> Params {
    Params { width: 6, int_bits: 4, transform_width: 6, upper, ..Params::default() }
}

/// A true number, in quarters of an input's unit in the last place, as the host quantises it: bounds and sticky bit.
fn quantised(quarters: i128, upper: Upper) -> (Bounds, i128) {
    let lo = quarters >> 2;
    let sticky = i128::from(quarters & 3 != 0);
    (at(lo, lo + if upper == Upper::Implied { 1 } else { sticky }), sticky)
}

/// Lemma declared-range: the ceiling of a number within a bound on the grid is within it too.
#[test]
fn sticky_bounds_stay_within_the_declared_range() {
    for upper in UPPERS {
        let p = small(upper);
        let mut b = Builder::new("quantised", 1, &[]);
        let bound = p.coordinate_bound();
        let x = Quantised::input(&mut b, "x", &p, bound, Rate::Any);
        let bounds = x.bounds(&mut b, "x_bounds", &p, None);
        interval::output(&mut b, "", bounds);
        let mut unit = Bench::new(&b.finish());
        for quarters in -4 * bound..=4 * bound {
            let (expected, sticky) = quantised(quarters, upper);
            unit.run_by_name(|name| if name == "x" { expected.lo } else { sticky });
            assert_eq!(unit.interval(""), expected);
            assert!(upper == Upper::Implied || expected.hi <= bound);
        }
        // A number outside its declared range is noticed.
        if upper == Upper::Sticky {
            let outside =
                catch_unwind(AssertUnwindSafe(|| unit.run_by_name(|name| if name == "x" { bound } else { 1 })));
            assert!(outside.is_err());
        }
    }
}

#[test]
fn transform_rows_contain_every_true_row() {
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    for upper in UPPERS {
        let p = small(upper);
        let mut unit = Bench::new(&transform_row::unit(&p));
        let f = p.input().fraction as u32;
        let limits = [p.one(), p.coordinate_bound(), p.translation_bound()].map(|b| 4 * b);
        for m0 in -limits[0]..=limits[0] {
            for x0 in -limits[1]..=limits[1] {
                for _ in 0..8 {
                    let mut other = |limit: i128| match rng.random_range(0..3) {
                        0 => limit * rng.random_range(-1..=1),
                        _ => rng.random_range(-limit..=limit),
                    };
                    // m0 m1 m2 x0 x1 x2 t.
                    let truth = [
                        m0,
                        other(limits[0]),
                        other(limits[0]),
                        x0,
                        other(limits[1]),
                        other(limits[1]),
                        other(limits[2]),
                    ];
                    let q = truth.map(|x| quantised(x, upper));
                    let number = |name: &str| {
                        let base = name.trim_end_matches("_sticky");
                        let at = ["m0", "m1", "m2", "x0", "x1", "x2", "t"].iter().position(|n| *n == base);
                        at.map_or(0, |i| if base == name { q[i].0.lo } else { q[i].1 })
                    };
                    unit.run_by_name(number);
                    let found = unit.interval("b");
                    let t = at(q[6].0.lo << f, q[6].0.hi << f);
                    let sum = (0..3).map(|j| product(q[j].0, q[3 + j].0)).fold(t, plus);
                    assert_eq!(found, rounded(sum, f as i32, upper), "{truth:?}");
                    let exact: i128 = (0..3).map(|j| truth[j] * truth[3 + j]).sum::<i128>() + (truth[6] << (f + 2));
                    assert!(found.lo << (f + 4) <= exact && exact <= found.hi << (f + 4), "{truth:?} {found:?}");
                }
            }
        }
    }
}

/// With the bypass the pose registers hold the identity, and a row returns its coordinate bit for bit.
#[test]
fn bypassed_rows_return_their_coordinate() {
    for upper in UPPERS {
        for transform in [Transform::On, Transform::Translate] {
            let p = Params { transform, ..small(upper) };
            let mut unit = Bench::new(&transform_row::unit(&p));
            let terms: i128 = if transform == Transform::On { 3 } else { 1 };
            let limit = 4 * p.coordinate_bound();
            for row in 0..terms {
                for quarters in -limit..=limit {
                    let (x, sticky) = quantised(quarters, upper);
                    let other = quantised(limit - 5, upper);
                    unit.run_by_name(|name| match name {
                        "bypass" => 1,
                        _ if name == format!("m{row}") => p.one(),
                        _ if name.starts_with('m') => 0,
                        _ if name == format!("x{row}") => x.lo,
                        _ if name == format!("x{row}_sticky") => sticky,
                        _ if name.starts_with('x') && name.ends_with("sticky") => other.1,
                        _ if name.starts_with('x') => other.0.lo,
                        _ => 0,
                    });
                    assert_eq!(unit.interval("b"), x);
                }
            }
        }
    }
}

#[test]
fn translated_rows_contain_every_true_row() {
    for upper in UPPERS {
        let p = Params { transform: Transform::Translate, ..small(upper) };
        let mut unit = Bench::new(&transform_row::unit(&p));
        let (x_limit, t_limit) = (4 * p.coordinate_bound(), 4 * p.translation_bound());
        for x in -x_limit..=x_limit {
            for t in -t_limit..=t_limit {
                let (qx, qt) = (quantised(x, upper), quantised(t, upper));
                unit.run_by_name(|name| match name {
                    "x0" => qx.0.lo,
                    "x0_sticky" => qx.1,
                    "t" => qt.0.lo,
                    "t_sticky" => qt.1,
                    _ => 0,
                });
                let found = unit.interval("b");
                assert_eq!(found, plus(qx.0, qt.0));
                assert!(4 * found.lo <= x + t && x + t <= 4 * found.hi);
            }
        }
    }
}
