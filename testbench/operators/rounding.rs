//! Rounding, clamping, sums and differences: outward, and within one unit in the last place.

use super::{Bench, UPPERS, at, contains, intervals, minus, plus, rounded, values, within_one_ulp};
use efsat::design::interval::{Narrowing, Rounding};
use efsat::design::{cross_product, interval};
use efsat::graph::{Builder, Rate, Type, Unit};
use efsat::number::{Upper, floor_shift};
use std::rc::Rc;

/// A unit that rounds one interval, by one way or several.
fn rounding_unit(ty: Type, ways: &[Rounding], upper: Upper, bits: u32) -> Rc<Unit> {
    let mut b = Builder::new("rounding", 1, &[]);
    let x = interval::input(&mut b, "x", ty, ty.limits());
    let several = ways.len() > 1;
    let ways_type = Type::unsigned(cross_product::select_bits(ways.len()));
    let select = several.then(|| b.input("way", ways_type, (0, ways.len() as i128 - 1), Rate::Any));
    let result = interval::round(&mut b, "rounded", x, ways, select, upper, bits);
    interval::output(&mut b, "", result);
    b.finish()
}

#[test]
fn rounding_is_outward_and_within_one_ulp() {
    let ty = Type::signed(8, 5);
    let ways: Vec<Rounding> = [-3, -1, 0, 1, 2, 5, 7].map(|drop| Rounding { drop, clamp: None }).to_vec();
    for upper in UPPERS {
        let mut several = Bench::new(&rounding_unit(ty, &ways, upper, 12));
        for (number, way) in ways.iter().enumerate() {
            let mut single = Bench::new(&rounding_unit(ty, &[*way], upper, 12));
            for x in -128..128 {
                for width in [0, 1, 2, 3, 31, 64] {
                    let x = at(x, (x + width).min(127));
                    single.run(&[x], &[]);
                    several.run(&[x], &[number as i128]);
                    let found = single.interval("");
                    assert_eq!(found, rounded(x, way.drop, upper), "{x:?} {way:?}");
                    assert_eq!(found, several.interval(""), "{x:?} {way:?}");
                    assert!(within_one_ulp(found, x, way.drop, upper), "{x:?} {way:?} {found:?}");
                }
            }
        }
    }
}

/// Clamping to a bound on the true value keeps the true value, wherever it lies in the interval.
#[test]
fn clamping_keeps_every_value_within_the_bound() {
    let ty = Type::signed(7, 0);
    for upper in UPPERS {
        for drop in [0, 1, 2] {
            let bound = 9i128;
            let way = Rounding { drop, clamp: Some((bound, "edge-extent")) };
            let mut unit = Bench::new(&rounding_unit(ty, &[way], upper, 5));
            for x in intervals(-64..=63) {
                unit.run(&[x], &[]);
                let found = unit.interval("");
                assert!(-bound <= found.lo && found.lo <= found.hi && found.hi <= bound);
                for value in values(x).filter(|v| v.abs() <= bound << drop) {
                    assert!(found.lo << drop <= value && value <= found.hi << drop, "{x:?} {found:?} {value}");
                }
            }
        }
    }
}

#[test]
fn sums_and_differences_are_contained_within_one_ulp() {
    let ty = Type::signed(4, 0);
    let all = intervals(-7..=7);
    let mut add = Bench::new(&interval::add_unit("add", (ty, (-7, 7)), (ty, (-7, 7))));
    let mut exact = Bench::new(&interval::subtract_unit("subtract", (ty, (-7, 7)), (ty, (-7, 7)), None));
    for x in &all {
        for y in &all {
            add.run(&[*x, *y], &[]);
            exact.run(&[*x, *y], &[]);
            assert_eq!((add.interval(""), exact.interval("")), (plus(*x, *y), minus(*x, *y)));
        }
    }
    for upper in UPPERS {
        for drop in [-1, 0, 1, 2] {
            let rounding = Rounding { drop, clamp: None };
            let narrowing = Narrowing { bound: None, rounding, bits: 6, upper };
            let unit = interval::subtract_unit("subtract", (ty, (-7, 7)), (ty, (-7, 7)), Some(narrowing));
            let mut unit = Bench::new(&unit);
            for x in &all {
                for y in &all {
                    unit.run(&[*x, *y], &[]);
                    let found = unit.interval("");
                    assert!(within_one_ulp(found, minus(*x, *y), drop, upper), "{x:?} {y:?} {found:?}");
                    let fits = |d: i128| contains(at(floor_shift(found.lo, -drop), found.hi << drop.max(0)), d);
                    // With fraction bits appended the difference is exact, else it is compared at its own point.
                    let inside = |d: i128| if drop < 0 { contains(found, d << -drop) } else { fits(d) };
                    assert!(values(*x).all(|a| values(*y).all(|b| inside(a - b))), "{x:?} {y:?} {found:?}");
                }
            }
        }
    }
}
