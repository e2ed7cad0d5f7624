//! Rows of the frame transform contain every true row.

use super::{Bench, Bounds, UPPERS, at, plus, product, rounded};
use efsat::design::number::{Number, input_type};
use efsat::design::transform_row::{transform_row, translate_row};
use efsat::graph::{Sig, Signals, Top, Vec3};
use efsat::number::Upper;
use efsat::op::Type;
use efsat::params::{Params, Transform};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

/// The least widths at which inputs have fraction bits.
pub(super) fn small(upper: Upper) -> Params {
    Params { width: 6, int_bits: 4, transform_width: 6, upper, ..Params::default() }
}

/// An input within its declared range.
fn number<'l>(top: Top<'l>, p: &Params, bound: i128) -> Number<Sig<'l>> {
    let lo = top.input(input_type(p), (-bound, bound));
    Number { lo, sticky: (p.upper == Upper::Sticky).then(|| top.input(Type::FLAG, (0, 1))) }
}

/// The bounds of a true number as the host quantises it, in halves of an input's unit in the last place.
fn quantised(halves: i128, upper: Upper) -> Bounds {
    at(halves >> 1, (halves >> 1) + if upper == Upper::Implied { 1 } else { halves & 1 })
}

/// The words of numbers, and then the flag for the bypass.
fn words(numbers: &[Bounds], upper: Upper, bypass: Option<bool>) -> Vec<i128> {
    let words = |x: &Bounds| if upper == Upper::Implied { vec![x.lo] } else { vec![x.lo, x.hi - x.lo] };
    numbers.iter().flat_map(words).chain(bypass.map(i128::from)).collect()
}

/// Lemma declared-range: the ceiling of a number within a bound on the grid is within it too.
#[test]
fn sticky_bounds_stay_within_the_declared_range() {
    for upper in UPPERS {
        let p = small(upper);
        let bound = p.coordinate_bound();
        let mut unit = Bench::new(|top| number(top, &p, bound).named("x").declared(bound).signals());
        for halves in -2 * bound..=2 * bound {
            let x = quantised(halves, upper);
            assert_eq!(unit.bounds(&[], &words(&[x], upper, None)), [x]);
            assert!(upper == Upper::Implied || x.hi <= bound);
        }
        // A number outside its declared range is noticed.
        assert!(upper == Upper::Implied || unit.refuses(&[], &[bound, 1]));
    }
}

/// A row: m, x and t in this order, and the bypass.
fn row(p: &Params) -> Bench {
    Bench::new(|top| {
        let [m, x] = [("m", p.one()), ("x", p.coordinate_bound())]
            .map(|(name, bound)| Vec3::each(|_| number(top, p, bound)).named(name));
        let t = number(top, p, p.translation_bound()).named("t");
        transform_row(p, m, x, t, top.input(Type::FLAG, (0, 1)).named("bypass")).signals()
    })
}

/// Every two terms with all numbers on and between the grid, the third term and t drawn for each.
#[test]
fn transform_rows_contain_every_true_row() {
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    for upper in UPPERS {
        let p = small(upper);
        let mut unit = row(&p);
        let f = p.input().fraction;
        let limits = [p.one(), p.coordinate_bound(), p.translation_bound()].map(|bound| 2 * bound);
        let terms: Vec<[i128; 2]> =
            (-limits[0]..=limits[0]).flat_map(|m| (-limits[1]..=limits[1]).map(move |x| [m, x])).collect();
        for (i, first) in terms.iter().enumerate() {
            for (j, second) in terms.iter().enumerate() {
                let mut drawn = |limit: i128| match rng.random_range(0..3) {
                    0 => limit * rng.random_range(-1..=1),
                    _ => rng.random_range(-limit..=limit),
                };
                let mut term = [*first, *second, [drawn(limits[0]), drawn(limits[1])]];
                term.rotate_left((i + j) % 3);
                let t = drawn(limits[2]);
                let truth = [term[0][0], term[1][0], term[2][0], term[0][1], term[1][1], term[2][1], t];
                let q = truth.map(|halves| quantised(halves, upper));
                let found = unit.bounds(&[], &words(&q, upper, Some(false)))[0];
                let t = at(q[6].lo << f, q[6].hi << f);
                let sum = (0..3).map(|j| product(q[j], q[3 + j])).fold(t, plus);
                assert_eq!(found, rounded(sum, f, upper), "{truth:?}");
                let exact: i128 = term.iter().map(|[m, x]| m * x).sum::<i128>() + (truth[6] << (f + 1));
                assert!(found.lo << (f + 2) <= exact && exact <= found.hi << (f + 2), "{truth:?} {found:?}");
            }
        }
        // The sum of numbers that are all at the end of their range, with bits that say that they are beyond.
        let beyond = [limits[0], limits[0], limits[0], limits[1], limits[1], limits[1], limits[2]];
        let beyond = beyond.map(|halves| quantised(halves + 1, upper));
        assert!(upper == Upper::Implied || unit.refuses(&[], &words(&beyond, upper, Some(false))));
    }
}

/// With the bypass a row gets a row of the exact identity and no translation, and returns its coordinate bit for bit.
#[test]
fn bypassed_rows_return_their_coordinate() {
    for upper in UPPERS {
        let p = small(upper);
        let limit = 2 * p.coordinate_bound();
        let exact = |x: i128| quantised(2 * x, upper);
        let (mut unit, mut translated) = (row(&p), translation(&p));
        for (row, x, other) in (0..3).flat_map(|row| (-limit..=limit).map(move |x| (row, x, limit - 5 - x / 2))) {
            let m = [0, 1, 2].map(|j| exact(if j == row { p.one() } else { 0 }));
            let mut xs = [other, -other, x].map(|halves| quantised(halves.clamp(-limit, limit), upper));
            xs.swap(row, 2);
            let numbers = [&m[..], &xs[..], &[exact(0)]].concat();
            assert_eq!(unit.bounds(&[], &words(&numbers, upper, Some(true))), [xs[row]]);
            let numbers = [xs[row], exact(0)];
            assert_eq!(translated.bounds(&[], &words(&numbers, upper, Some(true))), [xs[row]]);
        }
    }
}

/// A pure translation: x and t, and the bypass.
fn translation(p: &Params) -> Bench {
    let p = &Params { transform: Transform::Translate, ..p.clone() };
    Bench::new(|top| {
        let (x, t) =
            (number(top, p, p.coordinate_bound()).named("x"), number(top, p, p.translation_bound()).named("t"));
        translate_row(p, x, t, top.input(Type::FLAG, (0, 1)).named("bypass")).signals()
    })
}

#[test]
fn translated_rows_contain_every_true_row() {
    for upper in UPPERS {
        let p = small(upper);
        let mut unit = translation(&p);
        let (x_limit, t_limit) = (2 * p.coordinate_bound(), 2 * p.translation_bound());
        for (x, t) in (-x_limit..=x_limit).flat_map(|x| (-t_limit..=t_limit).map(move |t| (x, t))) {
            let q = [x, t].map(|halves| quantised(halves, upper));
            let found = unit.bounds(&[], &words(&q, upper, Some(false)))[0];
            assert_eq!(found, plus(q[0], q[1]));
            assert!(2 * found.lo <= x + t && x + t <= 2 * found.hi);
        }
    }
}
