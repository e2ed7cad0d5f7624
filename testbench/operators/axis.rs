//! Cross products and projections contain every exact one.

use super::{Bench, UPPERS, intervals, minus, plus, product, rounded, sign_cases, tuples, values};
use efsat::design::cross_product::COORDINATES;
use efsat::design::interval::Rounding;
use efsat::design::{cross_product, multiply, projection};
use efsat::graph::Type;

#[test]
fn cross_products_contain_every_cross_product() {
    let roundings = [Rounding { drop: 1, clamp: None }, Rounding { drop: 0, clamp: None }];
    for upper in UPPERS {
        let sign_case = &multiply::sign_case_unit(Type::signed(4, 0), 2);
        let spec =
            cross_product::Spec { bits: 4, left: 1, right: 1, roundings: &roundings, upper, notes: &[], sign_case };
        let mut unit = Bench::new(&cross_product::unit(&spec));
        tuples(&intervals(-1..=1), 6, |x| {
            let (e, f) = x.split_at(3);
            let way = usize::from(x[0].lo == x[5].hi);
            unit.run(x, &[way as i128]);
            for (i, (j, k)) in [(1, 2), (2, 0), (0, 1)].into_iter().enumerate() {
                let found = unit.interval(&format!("l_{}", COORDINATES[i]));
                let exact = minus(product(e[j], f[k]), product(e[k], f[j]));
                let drop = roundings[way].drop;
                assert_eq!(found, rounded(exact, drop, upper), "{x:?}");
                for (a, b) in values(e[j]).flat_map(|a| values(f[k]).map(move |b| (a, b))) {
                    for (c, d) in values(e[k]).flat_map(|c| values(f[j]).map(move |d| (c, d))) {
                        let component = a * b - c * d;
                        assert!(found.lo << drop <= component && component <= found.hi << drop, "{x:?}");
                    }
                }
            }
        });
    }
}

#[test]
fn projections_contain_every_dot_product() {
    let roundings = [Rounding { drop: 1, clamp: None }];
    for upper in UPPERS {
        let spec = projection::Spec { bits: 4, point: 1, axis: 1, roundings: &roundings, upper, notes: &[] };
        let mut unit = Bench::new(&projection::unit(&spec));
        tuples(&intervals(-1..=1), 6, |x| {
            let (v, l) = x.split_at(3);
            unit.run(x, &sign_cases(x));
            let found = unit.interval("p");
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
