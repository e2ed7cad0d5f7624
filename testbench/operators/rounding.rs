//! Rounding, saturation, sums and differences: by definition. That a rounding by definition is outward and within one unit
//! in the last place, the tests of `gen/hardware/number.rs` show.

use super::{Bench, UPPERS, at, inputs, intervals, minus, plus, rounded, values};
use efsat::design::rounding::{Rounding, Roundings};
use efsat::graph::{Phases, Signals};
use efsat::number::Upper;
use efsat::op::Type;
use efsat::params::Params;

/// A unit that rounds one interval.
fn single(ty: Type, way: Rounding, upper: Upper, bits: u32) -> Bench {
    let to = Type::signed(bits, ty.fraction.unwrap() - way.drop);
    let roundings = Roundings::one(way, upper, to);
    Bench::new(|top| inputs::<1>(top, "x", ty, ty.limits().1)[0].round_outward(&roundings).signals())
}

#[test]
fn rounding_is_outward_and_within_one_ulp() {
    let ty = Type::signed(8, 5);
    let ways = [-3, -1, 0, 1, 2, 5, 7].map(|drop| Rounding { drop, saturate: None });
    for upper in UPPERS {
        // Another rounding in each phase.
        let p = Params { width: 12, upper, ..Params::default() };
        let mut several = Bench::shared(ways.len(), |top| {
            let [x] = inputs(top, "x", ty, 127);
            let phases = Phases::new(ways.len(), |s| Some(ways[s]));
            let roundings = Roundings::by_phase(&p, &ways, &phases, top, "way");
            let rounded = x.round_outward(&roundings).named("rounded");
            phases.capture(&rounded).flat_map(|(_, x)| x.signals()).collect()
        });
        let mut singles = ways.map(|way| single(ty, way, upper, 12));
        for x in -127..128 {
            for width in [0, 1, 2, 3, 31, 64] {
                let x = at(x, (x + width).min(127));
                for ((way, unit), several) in ways.iter().zip(&mut singles).zip(several.bounds(&[x], &[])) {
                    let found = unit.bounds(&[x], &[])[0];
                    assert_eq!((found, several), (rounded(x, way.drop, upper), found), "{x:?} {way:?}");
                }
            }
        }
    }
}

/// Saturation at a bound on the true value keeps the true value, wherever it lies in the interval.
#[test]
fn saturation_keeps_every_value_within_the_bound() {
    let bound = 9i128;
    for (upper, drop) in UPPERS.into_iter().flat_map(|upper| [0, 1, 2].map(|drop| (upper, drop))) {
        let way = Rounding { drop, saturate: Some((bound, "edge-extent")) };
        let mut unit = single(Type::signed(7, 0), way, upper, 5);
        for x in intervals(-63..=63) {
            let found = unit.bounds(&[x], &[])[0];
            assert!(-bound <= found.lo && found.lo <= found.hi && found.hi <= bound);
            let exact = rounded(x, drop, upper);
            let expected = [exact.lo, exact.hi].map(|end| end.clamp(-bound, bound));
            assert_eq!([found.lo, found.hi], expected, "{x:?}");
            for value in values(x).filter(|v| v.abs() <= bound << drop) {
                assert!(found.lo << drop <= value && value <= found.hi << drop, "{x:?} {found:?} {value}");
            }
        }
    }
}

#[test]
fn sums_and_differences_are_contained_within_one_ulp() {
    let ty = Type::signed(4, 0);
    let ways: Vec<_> = UPPERS.into_iter().flat_map(|upper| [-1, 0, 1, 2].map(|drop| (upper, drop))).collect();
    let mut unit = Bench::new(|top| {
        let [x, y] = inputs(top, "x", ty, 7);
        let difference = (x - y).named("difference");
        let mut results = [x + y, difference, -x].signals();
        for (i, (upper, drop)) in ways.iter().enumerate() {
            let roundings = Roundings::one(Rounding { drop: *drop, saturate: None }, *upper, Type::signed(6, -drop));
            results.extend(difference.round_outward(&roundings).named_at("rounded", i).signals());
        }
        results
    });
    let all = intervals(-7..=7);
    for (x, y) in all.iter().flat_map(|x| all.iter().map(move |y| (*x, *y))) {
        let found = unit.bounds(&[x, y], &[]);
        assert_eq!(found[..3], [plus(x, y), minus(x, y), at(-x.hi, -x.lo)]);
        assert!(values(x).all(|a| values(y).all(|b| values(found[0]).contains(&(a + b)))), "{x:?} {y:?}");
        assert!(values(x).all(|a| values(y).all(|b| values(found[1]).contains(&(a - b)))), "{x:?} {y:?}");
        for ((upper, drop), found) in ways.iter().zip(&found[3..]) {
            assert_eq!(*found, rounded(minus(x, y), *drop, *upper), "{x:?} {y:?}");
        }
    }
}
