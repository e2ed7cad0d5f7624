//! Single operators, exhaustively at small widths, through the evaluation of their graphs; and the static range
//! analysis: that it is sound, and that it can fail. `docs/proofs.md` names the test beside each statement.

use efsat::artefact::Stimulus;
use efsat::cosim;
use efsat::design::cross_product::COORDINATES;
use efsat::design::interval::{self, Narrowing, Rounding};
use efsat::design::multiply::{self, case, Span};
use efsat::design::transform_row::{self, Quantised};
use efsat::design::{comparator, cross_product, projection, renormalise, Design};
use efsat::graph::evaluate::Evaluator;
use efsat::graph::flat::Flat;
use efsat::graph::range::{analyse, analyse_flat};
use efsat::graph::{Builder, Op, Rate, Type, Unit};
use efsat::number::{floor_shift, upper_shift, Interval, Upper};
use efsat::params::{Axes, AxisKind, Formats, Params, Projections, Row, Transform};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::collections::HashSet;
use std::ops::RangeInclusive;
use std::panic::{catch_unwind, AssertUnwindSafe};
use std::rc::Rc;

type Bounds = Interval<i128>;

const UPPERS: [Upper; 2] = [Upper::Implied, Upper::Sticky];

fn at(lo: i128, hi: i128) -> Bounds {
    Interval::new(lo, hi)
}

/// All intervals with bounds in a range.
fn intervals(range: RangeInclusive<i128>) -> Vec<Bounds> {
    range.clone().flat_map(|lo| (lo..=*range.end()).map(move |hi| at(lo, hi))).collect()
}

fn values(x: Bounds) -> RangeInclusive<i128> {
    x.lo..=x.hi
}

fn contains(x: Bounds, value: i128) -> bool {
    x.lo <= value && value <= x.hi
}

/// Every way to take one item out of `count` times the same list.
fn tuples<T: Copy>(items: &[T], count: u32, mut visit: impl FnMut(&[T])) {
    let mut tuple = vec![items[0]; count as usize];
    for code in 0..items.len().pow(count) {
        let mut rest = code;
        for place in &mut tuple {
            *place = items[rest % items.len()];
            rest /= items.len();
        }
        visit(&tuple);
    }
}

/// A unit under test: static ranges proven, inputs in port order, outputs by name.
struct Bench {
    evaluator: Evaluator,
    ports: Vec<String>,
}

impl Bench {
    fn new(unit: &Rc<Unit>) -> Self {
        analyse(unit).unwrap_or_else(|e| panic!("{}: {e}", unit.name));
        let ports = unit.inputs.iter().map(|i| unit.node(i.node).name.clone()).collect();
        Self { evaluator: Evaluator::new(unit), ports }
    }

    /// Runs on intervals in port order, then single values.
    fn run(&mut self, x: &[Bounds], extra: &[i128]) {
        let inputs: Vec<i128> = x.iter().flat_map(|x| [x.lo, x.hi]).chain(extra.iter().copied()).collect();
        assert_eq!(inputs.len(), self.ports.len(), "{:?}", self.ports);
        self.evaluator.run(&inputs);
    }

    /// Runs on inputs given by port name.
    fn run_by_name(&mut self, value: impl Fn(&str) -> i128) {
        let inputs: Vec<i128> = self.ports.iter().map(|name| value(name)).collect();
        self.evaluator.run(&inputs);
    }

    /// The interval at the ports `{name}_lo`, `{name}_hi`, or `lo`, `hi` for an empty name.
    fn interval(&self, name: &str) -> Bounds {
        let join = |end: &str| if name.is_empty() { end.to_owned() } else { format!("{name}_{end}") };
        at(self.evaluator.output(&join("lo")), self.evaluator.output(&join("hi")))
    }

    fn flag(&self, name: &str) -> bool {
        self.evaluator.output(name) != 0
    }
}

/// The sign case of an interval, by its definition.
fn sign_case(x: Bounds) -> i128 {
    let case = match () {
        () if 0 <= x.lo => case::POSITIVE,
        () if x.hi <= 0 => case::NEGATIVE,
        () if -x.lo <= x.hi => case::UPPER,
        () => case::LOWER,
    };
    case as i128
}

/// The sign cases of some intervals, for the ports behind their bounds.
fn sign_cases(x: &[Bounds]) -> Vec<i128> {
    x.iter().map(|x| sign_case(*x)).collect()
}

/// Section 5 of the contract: four products, but [-P, P] where both factors straddle zero.
fn product(x: Bounds, y: Bounds) -> Bounds {
    let straddles = |x: Bounds| x.lo < 0 && 0 < x.hi;
    if straddles(x) && straddles(y) {
        let p = x.hi.max(-x.lo) * y.hi.max(-y.lo);
        return at(-p, p);
    }
    let corners = [x.lo * y.lo, x.lo * y.hi, x.hi * y.lo, x.hi * y.hi];
    at(corners.into_iter().min().unwrap(), corners.into_iter().max().unwrap())
}

fn plus(x: Bounds, y: Bounds) -> Bounds {
    at(x.lo + y.lo, x.hi + y.hi)
}

fn minus(x: Bounds, y: Bounds) -> Bounds {
    at(x.lo - y.hi, x.hi - y.lo)
}

fn rounded(x: Bounds, drop: i32, upper: Upper) -> Bounds {
    at(floor_shift(x.lo, drop), upper_shift(x.hi, drop, upper))
}

/// That `r` is `x` with `drop` bits dropped: outward, and by no more than one unit in the last place of the result.
fn within_one_ulp(r: Bounds, x: Bounds, drop: i32, upper: Upper) -> bool {
    let (finer, ulp) = (1i128 << (-drop).max(0), 1i128 << drop.max(0));
    let below = x.lo * finer - r.lo * ulp;
    let above = r.hi * ulp - x.hi * finer;
    let most_above = match upper {
        _ if drop <= 0 => 0,
        Upper::Implied => ulp,
        Upper::Sticky => ulp - 1,
    };
    (0..ulp).contains(&below) && (0..=most_above).contains(&above)
}

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

/// The least widths at which inputs have fraction bits.
fn small(upper: Upper) -> Params {
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

fn bit_length(x: i128) -> u32 {
    128 - x.leading_zeros()
}

/// Parameter sets of the re-normaliser that can be exhausted.
fn renormalisers() -> Vec<Params> {
    let mut sets = vec![];
    for upper in UPPERS {
        for (width, transform_width) in [(6, 6), (6, 8), (7, 9), (10, 10)] {
            for transform in [Transform::On, Transform::Translate, Transform::Off] {
                sets.push(Params { width, transform_width, transform, upper, ..Params::default() });
            }
        }
    }
    sets
}

#[test]
fn offsets_are_exact_with_true_magnitudes() {
    for p in renormalisers() {
        let mut unit = Bench::new(&renormalise::offset_unit(&p));
        let reach = p.formats().transformed_bound().max(p.coordinate_bound() + 1);
        let most = p.coordinate_bound();
        for origin in [-most, 1 - most, -1, 0, 1, most] {
            for lo in -reach..=reach {
                let points = [0, 1, 5].map(|width| at(lo, (lo + width).min(reach)));
                unit.run(&points, &[origin; 3]);
                for (c, point) in COORDINATES.iter().zip(points) {
                    let offset = at(point.lo - origin, point.hi - origin);
                    assert_eq!(unit.interval(&format!("offset_{c}")), offset);
                    let magnitude = unit.evaluator.output(&format!("magnitude_{c}"));
                    assert_eq!(magnitude, offset.lo.abs() | offset.hi.abs());
                }
            }
        }
    }
}

#[test]
fn shifts_are_leading_zeros() {
    for p in renormalisers() {
        let mut unit = Bench::new(&renormalise::shift_unit(&p));
        let (bits, stages) = (renormalise::magnitude_bits(&p), renormalise::stages(&p));
        for word in 1..1i128 << bits {
            unit.run(&[], &[word]);
            let shift: u32 = (0..stages).map(|i| u32::from(unit.flag(&format!("shift_{i}"))) << i).sum();
            assert_eq!(shift, bits - bit_length(word), "{word}");
        }
    }
}

/// Drives a scale unit: offsets of three coordinates, one shift for all.
fn scale(unit: &mut Bench, offsets: [Bounds; 3], shift: u32, stages: u32) -> [Bounds; 3] {
    let flags: Vec<i128> = (0..stages).map(|i| i128::from(shift >> i & 1)).collect();
    unit.run(&offsets, &flags.repeat(3));
    COORDINATES.map(|c| unit.interval(c))
}

/// Lemma normalise: with |x| < 2^L no stage of the shift overflows (checked by the graph at every evaluation), and the
/// result is x / 2^L rounded outward to s2.(N-2), within [-1, 1].
#[test]
fn scaling_divides_by_a_power_of_two() {
    for p in renormalisers() {
        let mut unit = Bench::new(&renormalise::scale_unit(&p));
        let (bits, stages) = (renormalise::magnitude_bits(&p), renormalise::stages(&p));
        let drop = bits as i32 - (p.width as i32 - 2);
        let reach = p.formats().transformed_bound().max(p.coordinate_bound() + 1) + p.coordinate_bound();
        let one = 1i128 << (p.width - 2);
        for lo in -reach..=reach {
            for hi in [lo, lo + 1, lo + 2, -lo, reach].into_iter().filter(|hi| *hi >= lo && *hi <= reach) {
                for length in bit_length(lo.abs() | hi.abs())..=bits {
                    // All magnitudes zero: the shift is the most that the stages give, and 0 stays 0.
                    let shift = if length == 0 { (1 << stages) - 1 } else { bits - length };
                    let x = at(lo, hi);
                    let found = scale(&mut unit, [x, x, x], shift, stages);
                    let exact = at(lo << (bits - length), hi << (bits - length));
                    assert_eq!(found, [rounded(exact, drop, p.upper); 3], "{x:?} L {length} {p:?}");
                    assert!(-one <= found[0].lo && found[0].hi <= one, "{x:?} L {length} {p:?}");
                }
            }
        }
        // One bit more than the leading zeros is noticed.
        let too_far = catch_unwind(AssertUnwindSafe(|| scale(&mut unit, [at(reach, reach); 3], 1, stages)));
        assert_eq!(too_far.is_err(), bit_length(reach) == bits);
    }
}

/// Lemma anchored-edge: an edge at V0 stays within 1 + ulp, for every second vertex of A and every common power of two,
/// and reaches it.
#[test]
fn anchored_edges_stay_within_one_and_an_ulp() {
    for p in renormalisers() {
        let (bits, stages) = (renormalise::magnitude_bits(&p), renormalise::stages(&p));
        let row = &p.formats().edge_a[0];
        let grid = p.formats().coordinate_a.format.fraction;
        let one = 1i128 << grid;
        let ty = Type::signed(p.width, grid);
        let narrowing = Narrowing {
            bound: Some((one + 1, "anchored-edge")),
            rounding: Rounding { drop: grid - row.format.fraction, clamp: None },
            bits: p.width,
            upper: p.upper,
        };
        let mut edge =
            Bench::new(&interval::subtract_unit("edge", (ty, (-one, one)), (ty, (-one, one)), Some(narrowing)));
        let mut unit = Bench::new(&renormalise::scale_unit(&p));
        let reach = 2 * p.coordinate_bound();
        let widths: &[i128] = if p.upper == Upper::Implied { &[1] } else { &[0, 1] };
        let mut greatest = 0;
        for lo in -reach..=reach {
            for (v0_width, v1_width) in widths.iter().flat_map(|x| widths.iter().map(move |y| (*x, *y))) {
                let (v0, v1) = (at(0, v0_width), at(lo, lo + v1_width));
                for length in bit_length(v0.hi | v1.lo.abs() | v1.hi.abs()).max(1)..=bits {
                    let [v0, v1, _] = scale(&mut unit, [v0, v1, v0], bits - length, stages);
                    for [to, from] in [[v1, v0], [v0, v1]] {
                        edge.run(&[to, from], &[]);
                        let found = edge.interval("");
                        assert!(-row.bound <= found.lo && found.hi <= row.bound, "{to:?} {from:?} {found:?}");
                        greatest = greatest.max(to.hi - from.lo).max(from.hi - to.lo);
                    }
                }
            }
        }
        // Both roundings must be inexact for the ulp; an exact ceiling is one where points reach beyond the grid.
        let inexact = p.upper == Upper::Implied || reach >= 2 * one - 1;
        assert_eq!(greatest, one + i128::from(inexact), "{p:?}");
    }
}

/// Lemma triangle-area: twice the area of a triangle in a box is at most the product of the box's sides.
#[test]
fn twice_the_area_of_a_triangle_is_at_most_its_box() {
    for (width, height) in [(1, 1), (2, 2), (4, 4), (2, 5), (3, 1)] {
        let points: Vec<(i128, i128)> = (0..=width).flat_map(|x| (0..=height).map(move |y| (x, y))).collect();
        let mut greatest = 0;
        tuples(&points, 3, |w| {
            let [a, b] = [1, 2].map(|i: usize| (w[i].0 - w[0].0, w[i].1 - w[0].1));
            greatest = greatest.max((a.0 * b.1 - a.1 * b.0).abs());
        });
        assert_eq!(greatest, width * height);
    }
}

/// Lemma edge-extent: a difference of two coordinates in [-1, 1] is at most 2, and of two rows of M B~ + t at most 6;
/// both are multilinear, so the corners decide.
#[test]
fn true_edges_stay_within_their_extent() {
    let mut greatest = [0, 0];
    tuples(&[-2i128, -1, 0, 1, 2], 2, |x| greatest[0] = greatest[0].max((x[1] - x[0]).abs()));
    tuples(&[-1i128, 0, 1], 9, |x| {
        let (m, rest) = x.split_at(3);
        let edge: i128 = (0..3).map(|j| m[j] * (rest[3 + j] - rest[j])).sum();
        greatest[1] = greatest[1].max(edge.abs());
    });
    assert_eq!(greatest, [2 * 2, 6]);
}

/// True bounds along one coordinate axis, of an edge of A and of B, in ulps of the coordinates (lemma edge-extent),
/// written from sections 3 and 4 of the contract.
fn extents(p: &Params, f: &Formats) -> [i128; 2] {
    let one = 1i128 << f.coordinate_a.format.fraction;
    let natural = [2 * f.coordinate_a.bound, 2 * f.coordinate_b.bound];
    match (p.renormalise, p.transform) {
        (true, _) | (false, Transform::Translate) => [2 * one; 2],
        (false, Transform::On) => [2 * one, natural[1].min(6 * one)],
        (false, Transform::Off) => natural,
    }
}

/// Edges and normal of B with their clamps, on triangles in and near the corners of the domain: whatever is clamped,
/// the true number stays inside.
#[test]
fn clamped_edges_and_normals_contain_the_true_ones() {
    let mut clamps = HashSet::new();
    for upper in UPPERS {
        for (width, transform, renormalise) in [
            (6, Transform::On, true),
            (7, Transform::On, true),
            (6, Transform::Off, false),
            (6, Transform::Translate, false),
        ] {
            let p = Params { width, transform_width: width, transform, renormalise, upper, ..Params::default() };
            let f = p.formats();
            let (coordinate, edge_row, normal_row) = (&f.coordinate_b, &f.edge_b, f.axis(AxisKind::NormalB));
            clamps.extend([edge_row, normal_row].into_iter().filter_map(|r| r.clamp).map(|c| c.lemma));
            let grid = coordinate.format.fraction;
            let ty = Type::signed(p.width, grid);
            let range = (-coordinate.bound, coordinate.bound);
            let narrowing = Narrowing { bound: None, rounding: way(grid, edge_row, 0, None), bits: p.width, upper };
            let mut edge = Bench::new(&interval::subtract_unit("edge_b", (ty, range), (ty, range), Some(narrowing)));
            let rounding = way(2 * edge_row.format.fraction, normal_row, 0, None);
            let spec = cross_product::Spec {
                bits: p.width,
                left: edge_row.bound,
                right: edge_row.bound,
                roundings: &[rounding],
                upper,
                notes: &[],
                sign_case: &multiply::sign_case_unit(Type::signed(p.width, 0), edge_row.bound),
            };
            let mut cross = Bench::new(&cross_product::unit(&spec));
            // Half an ulp, so that the true numbers lie on and off the grid; the box is the lemma's.
            let half = extents(&p, &f)[1] - 1;
            tuples(&[-half, 1 - half, -1, 0, half - 2, half], 6, |w| {
                // Vertices in the plane z = 0: x0 x1 x2 y0 y1 y2.
                let enclosure = |x: i128| {
                    let hi = if upper == Upper::Implied { (x >> 1) + 1 } else { -(-x >> 1) };
                    at(x >> 1, hi.min(coordinate.bound))
                };
                let mut difference = |to: usize, from: usize| {
                    edge.run(&[enclosure(w[to]), enclosure(w[from])], &[]);
                    let found = edge.interval("");
                    let drop = grid - edge_row.format.fraction;
                    assert!(holds(found, w[to] - w[from], drop + 1), "{w:?} {found:?} {p:?}");
                    found
                };
                // W1 - W0, and W2 - W0 as the negated edge.
                let e = [difference(1, 0), difference(4, 3), at(0, 0)];
                let minus = |x: Bounds| at(-x.hi, -x.lo);
                let g = [minus(difference(0, 2)), minus(difference(3, 5)), at(0, 0)];
                cross.run(&[e[0], e[1], e[2], g[0], g[1], g[2]], &[]);
                let found = cross.interval("l_z");
                let truth = (w[1] - w[0]) * (w[5] - w[3]) - (w[4] - w[3]) * (w[2] - w[0]);
                assert!(holds(found, truth, 2 * grid - normal_row.format.fraction + 2), "{w:?} {found:?} {p:?}");
                assert!(-normal_row.bound <= found.lo && found.hi <= normal_row.bound);
            });
        }
    }
    assert_eq!(clamps, HashSet::from(["edge-extent", "triangle-area"]));
}

/// Whether an interval contains a number given with `drop` fraction bits more.
fn holds(x: Bounds, value: i128, drop: i32) -> bool {
    let (finer, coarser) = ((-drop).max(0), drop.max(0));
    x.lo << coarser <= value << finer && value << finer <= x.hi << coarser
}

/// The rounding to a row, with `fewer` integral digits less than it has; the clamp is the row's, or the least mantissa
/// above a true bound where that is given as bound, fraction bits and lemma.
fn way(exact: i32, row: &Row, fewer: i32, truth: Option<(i128, i32, &'static str)>) -> Rounding {
    let fraction = row.format.fraction + fewer;
    let clamp = match truth {
        None => row.clamp.map(|c| (c.bound, c.lemma)),
        Some((bound, at, lemma)) => Some((upper_shift(bound, at - fraction, Upper::Sticky), lemma)),
    };
    Rounding { drop: exact - fraction, clamp }
}

/// The rows an axis is made of, left and right factor.
fn factors(f: &Formats, kind: AxisKind) -> [&Row; 2] {
    match kind {
        AxisKind::NormalA => [&f.edge_a[0], &f.edge_a[2]],
        AxisKind::NormalB => [&f.edge_b, &f.edge_b],
        AxisKind::Cross(k) => [&f.edge_a[k], &f.edge_b],
        AxisKind::InPlaneA(k) => [f.axis(AxisKind::NormalA), &f.edge_a[k]],
        AxisKind::InPlaneB => [f.axis(AxisKind::NormalB), &f.edge_b],
    }
}

/// The least-k rule: range analysis proves the unit with the row's format, and rejects the same unit with one integral
/// digit fewer, whatever lemma helps it.
#[test]
fn every_row_has_the_least_integral_digits() {
    let mut rows = 0;
    for width in [6, 9, 18, 25] {
        for (transform, renormalise) in [
            (Transform::On, true),
            (Transform::Off, true),
            (Transform::On, false),
            (Transform::Translate, false),
            (Transform::Off, false),
        ] {
            for upper in UPPERS {
                let transform_width = width.max(12);
                let axes = Axes::Seventeen;
                let p = Params { width, transform_width, axes, transform, renormalise, upper, ..Params::default() };
                let f = p.formats();
                let mut check = |row: &Row, unit: &dyn Fn(i32) -> Rc<Unit>| {
                    analyse(&unit(0)).unwrap_or_else(|e| panic!("{}: {e} {p:?}", row.name));
                    let fewer = analyse(&unit(1)).err().unwrap_or_else(|| panic!("{} is loose: {p:?}", row.name));
                    assert!(fewer.path.contains("rounded"), "{fewer}");
                    rows += 1;
                };
                let grid = f.coordinate_a.format.fraction;
                let one = 1i128 << grid;
                let [extent_a, extent_b] = extents(&p, &f);
                let edges = [
                    (&f.edge_a[0], f.coordinate_a.bound, extent_a, renormalise),
                    (&f.edge_a[1], f.coordinate_a.bound, extent_a, false),
                    (&f.edge_a[2], f.coordinate_a.bound, extent_a, renormalise),
                    (&f.edge_b, f.coordinate_b.bound, extent_b, false),
                ];
                for (row, coordinate, extent, anchored) in edges {
                    check(row, &|fewer| {
                        let ty = Type::signed(width, grid);
                        let range = (-coordinate, coordinate);
                        let truth = (fewer > 0 && !anchored).then_some((extent, grid, "edge-extent"));
                        let narrowing = Narrowing {
                            bound: anchored.then_some((one + 1, "anchored-edge")),
                            rounding: way(grid, row, fewer, truth),
                            bits: width,
                            upper,
                        };
                        interval::subtract_unit("edge", (ty, range), (ty, range), Some(narrowing))
                    });
                }
                let mut kinds = vec![AxisKind::NormalA, AxisKind::NormalB, AxisKind::InPlaneB];
                kinds.extend((0..3).flat_map(|k| [AxisKind::Cross(k), AxisKind::InPlaneA(k)]));
                for kind in kinds {
                    let (row, [left, right]) = (f.axis(kind), factors(&f, kind));
                    let area = match kind {
                        AxisKind::NormalA => Some(extent_a * extent_a),
                        AxisKind::NormalB => Some(extent_b * extent_b),
                        _ => None,
                    };
                    check(row, &|fewer| {
                        let truth = area.filter(|_| fewer > 0).map(|area| (area, 2 * grid, "triangle-area"));
                        let exact = left.format.fraction + right.format.fraction;
                        let roundings = &[way(exact, row, fewer, truth)];
                        let (left, right) = (left.bound, right.bound);
                        cross_product::unit(&cross_product::Spec {
                            bits: width,
                            left,
                            right,
                            roundings,
                            upper,
                            notes: &[],
                            sign_case: &multiply::sign_case_unit(Type::signed(width, 0), left.max(right)),
                        })
                    });
                    let (point, axis) = (f.coordinate_a.bound.max(f.coordinate_b.bound), row.bound);
                    let projected = f.projection(kind);
                    check(projected, &|fewer| {
                        let roundings = &[way(grid + row.format.fraction, projected, fewer, None)];
                        projection::unit(&projection::Spec { bits: width, point, axis, roundings, upper, notes: &[] })
                    });
                }
                if renormalise {
                    // 1 is representable, and would not be with one integral digit.
                    let format = f.coordinate_a.format;
                    assert!(one <= format.max() && 2 * one > format.max());
                }
            }
        }
    }
    assert_eq!(rows, 4 * 5 * 2 * (4 + 18));
}

/// All images (least and greatest projection) that three true projections can have, duplicates being equal.
fn images(p: &[Bounds], equal: &[(usize, usize)]) -> Vec<(i128, i128)> {
    let mut found = HashSet::new();
    let third = p.get(2).copied();
    for x in values(p[0]) {
        for y in p.get(1).map_or(x..=x, |p| values(*p)) {
            for z in third.map_or(x..=x, values) {
                let v = [x, y, z];
                if equal.iter().all(|(i, j)| v[*i] == v[*j]) {
                    found.insert((x.min(y).min(z), x.max(y).max(z)));
                }
            }
        }
    }
    found.into_iter().collect()
}

/// Section 6 by definition: what holds for every choice of true projections. `None` if there is none.
fn decided(a: &[(i128, i128)], b: &[(i128, i128)]) -> Option<(bool, bool)> {
    if a.is_empty() || b.is_empty() {
        return None;
    }
    let all = |test: fn((i128, i128), (i128, i128)) -> bool| a.iter().all(|x| b.iter().all(|y| test(*x, *y)));
    let separated = all(|a, b| a.1 < b.0) || all(|a, b| b.1 < a.0);
    assert_eq!(separated, all(|a, b| a.1 < b.0 || b.1 < a.0));
    Some((separated, all(|a, b| a.0 < b.1 && b.0 < a.1)))
}

/// Tallies of (separated, overlapping, unknown), to see that a test met all three.
fn tally(counts: &mut [usize; 3], flags: (bool, bool)) {
    counts[if flags.0 { 0 } else { 2 - usize::from(flags.1) }] += 1;
}

/// All small integer cases against section 6, with every projection computed.
#[test]
fn comparators_decide_by_definition_with_all_projections() {
    let mut unit = Bench::new(&comparator::unit(4, 4, 6, Projections::All));
    let mut counts = [0; 3];
    let mut check = |p: &[Bounds]| {
        unit.run(p, &[]);
        let found = (unit.flag("separated"), unit.flag("overlapping"));
        assert_eq!(Some(found), decided(&images(&p[..3], &[]), &images(&p[3..], &[])), "{p:?}");
        tally(&mut counts, found);
    };
    tuples(&intervals(-1..=1), 6, &mut check);
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    for _ in 0..20_000 {
        let p: Vec<Bounds> = (0..6)
            .map(|_| {
                let lo = rng.random_range(-4..=4);
                at(lo, rng.random_range(lo..=(lo + 3).min(4)))
            })
            .collect();
        check(&p);
    }
    assert!(counts.iter().all(|n| *n > 300), "{counts:?}");
}

/// With duplicates skipped: A's projections from the first, B's from the last; what lies between changes hands.
#[test]
fn comparators_decide_by_definition_with_duplicates_skipped() {
    // Eleven axes need four projections, seventeen five.
    for (points, splits) in [(4usize, vec![(2, 2), (1, 3), (3, 1)]), (5, vec![(2, 2), (1, 3), (3, 1), (2, 3), (3, 2)])]
    {
        let mut unit = Bench::new(&comparator::unit(4, 3, points, Projections::Skip));
        let last = points - 1;
        let flags = ["a_has_1", "a_has_2"].map(str::to_owned).into_iter();
        let flags: Vec<String> = flags.chain([1, 2].map(|i| format!("b_has_{}", last - i))).collect();
        assert_eq!(unit.ports[2 * points..], flags);
        for (of_a, of_b) in splits {
            let has = [of_a > 1, of_a > 2, of_b > 1, of_b > 2].map(i128::from);
            let mut counts = [0; 3];
            tuples(&intervals(if points == 4 { -1..=2 } else { -1..=1 }), points as u32, |p| {
                unit.run(p, &has);
                let found = (unit.flag("separated"), unit.flag("overlapping"));
                let (a, b) = (&p[..of_a], &p[points - of_b..]);
                assert_eq!(Some(found), decided(&images(a, &[]), &images(b, &[])), "{p:?} {of_a} {of_b}");
                tally(&mut counts, found);
            });
            // One projection of A alone never overlaps strictly where all three of it are equal.
            assert!(counts[0] > 50 && counts[2] > 50 && counts[1] > 0, "{counts:?} {of_a} {of_b}");
        }
    }
}

/// With duplicates intersected: the choices are those in which duplicates are equal; there is at least the true one.
#[test]
fn comparators_decide_by_definition_with_duplicates_intersected() {
    let mut unit = Bench::new(&comparator::unit(4, 4, 6, Projections::Intersect));
    assert_eq!(unit.ports[12..], ["duplicates_a", "duplicates_b"]);
    let groups: [&[(usize, usize)]; 5] = [&[], &[(0, 1)], &[(1, 2)], &[(2, 0)], &[(0, 1), (1, 2)]];
    let mut rng = ChaCha8Rng::seed_from_u64(4);
    for (code_a, code_b) in (0..5).flat_map(|a| (0..5).map(move |b| (a, b))) {
        let mut counts = [0; 3];
        let mut check = |p: &[Bounds]| {
            let expected = decided(&images(&p[..3], groups[code_a]), &images(&p[3..], groups[code_b]));
            let Some(expected) = expected else { return };
            unit.run(p, &[code_a as i128, code_b as i128]);
            let found = (unit.flag("separated"), unit.flag("overlapping"));
            assert_eq!(found, expected, "{p:?} {code_a} {code_b}");
            tally(&mut counts, found);
        };
        tuples(&[at(-1, -1), at(-1, 0), at(0, 1), at(0, 0), at(-1, 1)], 6, &mut check);
        for _ in 0..5_000 {
            let p: Vec<Bounds> = (0..6)
                .map(|_| {
                    let lo = rng.random_range(-4..=4);
                    at(lo, rng.random_range(lo..=(lo + 3).min(4)))
                })
                .collect();
            check(&p);
        }
        assert!(counts[0] > 0 && counts[2] > 0, "{counts:?}");
        // Both triangles seen edge on: two points never overlap strictly.
        assert_eq!(counts[1] > 0, (code_a, code_b) != (4, 4), "{counts:?} {code_a} {code_b}");
    }
}

/// Whole data paths: in every phase every value lies in its analysed range, at the corners of the declared input ranges
/// too.
#[test]
fn analysed_ranges_contain_every_value() {
    let base = Params { width: 6, transform_width: 8, ..Params::default() };
    let sets = [
        base.clone(),
        small(Upper::Sticky),
        Params { axes: Axes::Seventeen, axes_per_clock: 3, upper: Upper::Sticky, ..base.clone() },
        Params { projections: Projections::Intersect, axes_per_clock: 11, ..base.clone() },
        Params { projections: Projections::Skip, axes: Axes::Seventeen, axes_per_clock: 17, ..base.clone() },
        Params { transform: Transform::Translate, width: 9, transform_width: 20, ..base.clone() },
        Params { transform: Transform::Off, renormalise: false, ..base.clone() },
        Params { renormalise: false, width: 7, int_bits: 5, ..base },
    ];
    for p in sets {
        let design = Design::new(&p, false).unwrap_or_else(|e| panic!("{e} {p:?}"));
        let flat = Flat::new(&design.pipeline);
        let (_, ranges) = analyse_flat(&flat).unwrap();
        let mut evaluator = Evaluator::new(&design.pipeline);
        let (mut steps, mut reached) = (0usize, HashSet::new());
        for (pose, pairs) in &Stimulus::random(&p, 160, 5).segments {
            for pair in pairs {
                evaluator.run(&cosim::inputs(&design, pose, pair));
                for step in &flat.steps {
                    let value = evaluator.at(step.node, step.phase);
                    let key = step.node * flat.interval + step.phase;
                    let (lo, hi) = ranges[key];
                    let path = &flat.nodes[step.node].path;
                    assert!(lo <= value && value <= hi, "{path}: {value} not in [{lo}, {hi}] {p:?}");
                    steps += 1;
                    if value == lo || value == hi {
                        reached.insert(key);
                    }
                }
            }
        }
        // The ranges are not vacuous: many are reached at one end or the other.
        assert!(steps > 100_000 && 4 * reached.len() > flat.steps.len(), "{} of {}", reached.len(), flat.steps.len());
    }
}

/// The analysis fails where it must: a result cut too narrow, and an operand beyond a port's declared range.
#[test]
fn an_overflow_is_reported_with_its_path() {
    let inner = |bits: u32| {
        let mut b = Builder::new("inner", 1, &[]);
        let x = b.input("x", Type::signed(6, 0), (-20, 20), Rate::Any);
        let sum = b.add("sum", x, x);
        let narrow = b.resize("narrow", sum, true, bits);
        b.output("narrow", narrow);
        b.finish()
    };
    let outer = |bits: u32, range: (i128, i128)| {
        let unit = inner(bits);
        let mut b = Builder::new("outer", 1, &[]);
        let x = b.input("x", Type::signed(6, 0), range, Rate::Any);
        let result = b.instance("twice", &unit, &[x])[0];
        b.output("result", result);
        b.finish()
    };
    assert!(analyse(&outer(7, (-20, 20))).is_ok());
    let overflow = analyse(&outer(6, (-20, 20))).unwrap_err();
    assert_eq!((overflow.path.as_str(), overflow.range), ("twice.narrow", (-40, 40)));
    assert_eq!(overflow.to_string(), "twice.narrow, phase 0: values from -40 to 40 do not fit s6.0");
    let overflow = analyse(&outer(7, (-21, 20))).unwrap_err();
    assert!(overflow.path.starts_with("twice, port x"), "{overflow}");
    // A multiplier is as wide as the declared bounds of its factors; what exceeds them does not fit.
    let ty = Type::signed(6, 0);
    assert!(analyse(&multiply::multiply_unit("multiply", (ty, 31), (ty, 31))).is_ok());
    let mut b = Builder::new("wrapper", 1, &[]);
    let x = interval::input(&mut b, "x", ty, (-32, 31));
    let unit = multiply::multiply_unit("multiply", (ty, 31), (ty, 31));
    let x = multiply::Factor { bounds: x, sign_case: b.constant("x_sign_case", 0, multiply::SIGN_CASE) };
    let out = multiply::instance(&mut b, "product", &unit, x, x);
    interval::output(&mut b, "", out);
    assert!(analyse(&b.finish()).unwrap_err().path.starts_with("product"));
}

/// The operations' ranges enclose their values, on all small operands.
#[test]
fn ranges_of_operations_enclose_their_values() {
    let signed = Type::signed(4, 0);
    let unsigned = Type::unsigned(3);
    let alike = |op: Op, ty: Type, count: usize| (op, vec![ty; count]);
    let all = [
        alike(Op::Add, signed, 2),
        alike(Op::Subtract, signed, 2),
        alike(Op::Multiply, signed, 2),
        alike(Op::Equal, signed, 2),
        alike(Op::And, unsigned, 2),
        alike(Op::Or, unsigned, 2),
        alike(Op::Concatenate, unsigned, 2),
        (Op::Concatenate, vec![unsigned, signed]),
        (Op::NegateIf, vec![Type::FLAG, signed]),
        alike(Op::Negate, signed, 1),
        alike(Op::Magnitude, signed, 1),
        alike(Op::SignBit, signed, 1),
        alike(Op::Floor(2), signed, 1),
        alike(Op::Append(2), signed, 1),
        alike(Op::LowBits(2), signed, 1),
        alike(Op::Clamp(3, "edge-extent"), signed, 1),
        alike(Op::Not, unsigned, 1),
        alike(Op::AnyBit, unsigned, 1),
    ];
    for (op, types) in all {
        let result = op.result(&types).unwrap();
        // The least number of a type has no negative in it, and the range says so.
        let fits = |range: (i128, i128)| result.limits().0 <= range.0 && range.1 <= result.limits().1;
        let operands: Vec<Vec<Bounds>> = types.iter().map(|t| intervals(t.limits().0..=t.limits().1)).collect();
        let none = vec![at(0, 0)];
        for x in &operands[0] {
            for y in operands.get(1).unwrap_or(&none) {
                let range = op.range(&[(x.lo, x.hi), (y.lo, y.hi)][..types.len()], &types, result);
                assert!(fits(range) || matches!(op, Op::NegateIf) && y.lo == signed.limits().0, "{op:?} {x:?} {y:?}");
                for (a, b) in values(*x).flat_map(|a| values(*y).map(move |b| (a, b))) {
                    let value = op.apply(&[a, b][..types.len()], &types, result);
                    assert!(range.0 <= value && value <= range.1, "{op:?} {a} {b}: {value} in {range:?}");
                }
            }
        }
    }
}
