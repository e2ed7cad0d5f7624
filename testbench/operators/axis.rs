//! Cross products and projections contain every exact one.

use super::{Bench, UPPERS, intervals, minus, plus, product, rounded, tuples, values, vector};
use efsat::design::cross_product::cross_product;
use efsat::design::interval::Interval;
use efsat::design::projection::projection;
use efsat::design::rounding::{Rounding, Roundings};
use efsat::graph::{Phases, Signals};
use efsat::op::Type;
use efsat::params::Params;

#[test]
fn cross_products_contain_every_cross_product() {
    for upper in UPPERS {
        // Another rounding in each of two phases.
        let p = Params { width: 4, upper, ..Params::default() };
        let ways = [1, 0].map(|drop| Rounding { drop, saturate: None });
        let mut unit = Bench::shared(2, |top| {
            let [e, f] =
                ["e", "f"].map(|name| vector(top, name, Type::signed(4, 1), 1).map(Interval::factor).named(name));
            let phases = Phases::new(2, |s| Some(ways[s]));
            let l =
                cross_product(e, f, Some(&Roundings::by_phase(&p, &ways, &phases, top, "rounding")), &[]).named("l");
            phases.capture(&l).flat_map(|(_, l)| l.signals()).collect()
        });
        tuples(&intervals(-1..=1), 6, |x| {
            let (e, f) = x.split_at(3);
            let found = unit.bounds(x, &[]);
            for (i, (j, k)) in [(1, 2), (2, 0), (0, 1)].into_iter().enumerate() {
                let exact = minus(product(e[j], f[k]), product(e[k], f[j]));
                let components = values(e[j])
                    .flat_map(|a| values(f[k]).map(move |b| (a, b)))
                    .flat_map(|(a, b)| values(e[k]).flat_map(move |c| values(f[j]).map(move |d| a * b - c * d)));
                let (least, greatest) = components.fold((9, -9), |(lo, hi), c| (c.min(lo), c.max(hi)));
                for (way, found) in ways.iter().zip([found[i], found[3 + i]]) {
                    assert_eq!(found, rounded(exact, way.drop, upper), "{x:?}");
                    assert!(found.lo << way.drop <= least && greatest <= found.hi << way.drop, "{x:?}");
                }
            }
        });
    }
}

#[test]
fn projections_contain_every_dot_product() {
    for upper in UPPERS {
        let mut unit = Bench::new(|top| {
            let [v, l] =
                ["v", "l"].map(|name| vector(top, name, Type::signed(4, 1), 1).map(Interval::factor).named(name));
            let roundings = Roundings::one(Rounding { drop: 1, saturate: None }, upper, Type::signed(4, 1));
            projection(&Params::paper(), v, l, &roundings, &[]).signals()
        });
        tuples(&intervals(-1..=1), 6, |x| {
            let (v, l) = x.split_at(3);
            let found = unit.bounds(x, &[])[0];
            let exact = (0..3).map(|i| product(v[i], l[i])).reduce(plus).unwrap();
            assert_eq!(found, rounded(exact, 1, upper), "{x:?}");
            // The terms are independent: their extremes are those of the sum.
            let term = |i: usize| values(v[i]).flat_map(move |a| values(l[i]).map(move |b| a * b));
            let least: i128 = (0..3).map(|i| term(i).min().unwrap()).sum();
            let greatest: i128 = (0..3).map(|i| term(i).max().unwrap()).sum();
            assert!(found.lo * 2 <= least && greatest <= found.hi * 2, "{x:?}");
        });
    }
}
