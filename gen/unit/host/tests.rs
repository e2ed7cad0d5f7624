//! The host against rational arithmetic.

// Loops over components read like the equations.
#![allow(clippy::needless_range_loop)]

use num_bigint::BigInt;
use num_rational::Ratio;
use num_traits::float::FloatCore;
use num_traits::{One, Signed, Zero};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

use super::{Host, SceneHost, loose_pair, loose_pairs};
use crate::golden::Golden;
use crate::pair::{Input, Pair, Pose, Verdict};
use crate::params::{Method, Params, Transform};
use efsat_geometry::exact::{self, Exact};
use efsat_geometry::sample;

type Real = Ratio<BigInt>;

fn real(x: f64) -> Real {
    let (mantissa, exponent, sign) = x.integer_decode();
    Real::from_integer(BigInt::from(mantissa) * sign) * two_to(exponent.into())
}

fn two_to(power: i64) -> Real {
    let whole = Real::from_integer(BigInt::one() << power.unsigned_abs());
    if power < 0 { whole.recip() } else { whole }
}

/// The largest power of two with which `reach` is at most 1; 1 for zero.
fn scale(reach: &Real) -> Real {
    if reach.is_zero() {
        return Real::one();
    }
    let mut scale = Real::one();
    while reach * &scale > Real::one() {
        scale /= Real::from_integer(2.into());
    }
    while reach * &scale * two_to(1) <= Real::one() {
        scale *= two_to(1);
    }
    scale
}

/// The least and the greatest along each axis.
fn bounds(points: &[[f64; 3]]) -> [[Real; 2]; 3] {
    [0, 1, 2].map(|i| {
        let column = || points.iter().map(|x| real(x[i]));
        [column().min().unwrap(), column().max().unwrap()]
    })
}

fn middle([low, high]: &[Real; 2]) -> Real {
    (low + high) * two_to(-1)
}

fn half([low, high]: &[Real; 2]) -> Real {
    (high - low) * two_to(-1)
}

/// Floor and sticky bit of the real number.
fn assert_quantised(found: Input, x: &Real, p: &Params) {
    let scaled = x * two_to(p.input().fraction.into());
    assert_eq!(BigInt::from(found.lo), scaled.floor().to_integer(), "{x}");
    assert_eq!(found.sticky, !scaled.is_integer(), "{x}");
}

fn unit(host: Host) -> Pair {
    match host {
        Host::Unit(pair) => pair,
        Host::Decided(verdict) => panic!("decided: {verdict}"),
    }
}

fn check_loose(points: &[[f64; 3]; 6], p: &Params) {
    let pair = unit(loose_pair(points, p).unwrap());
    let boxes = bounds(points);
    let scale = scale(&boxes.iter().map(half).max().unwrap());
    for (k, point) in points.iter().enumerate() {
        for i in 0..3 {
            let found = if k < 3 { pair.a[k][i] } else { pair.b[k - 3][i] };
            assert_quantised(found, &((real(point[i]) - middle(&boxes[i])) * &scale), p);
        }
    }
}

#[test]
fn loose_pairs_are_normalised_exactly() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    for (int_bits, transform_width, transform) in
        [(4, 32, Transform::On), (4, 48, Transform::Off), (8, 18, Transform::Translate)]
    {
        let p = Params { int_bits, transform_width, transform, ..Params::default() };
        for round in 0..100 {
            let points = sample::random_points(&mut rng);
            check_loose(&points, &p);
            // Exponents at both ends of binary64, alone and mixed.
            let mut extreme = || match rng.random_range(0..8) {
                0 => 0.0,
                1 => f64::MAX,
                2 => -f64::MAX,
                3 => 5e-324,
                4 => -5e-324,
                5 => f64::MIN_POSITIVE,
                _ => rng.random_range(-1.0..1.0),
            };
            if round % 4 == 0 {
                check_loose(&[(); 6].map(|()| [(); 3].map(|()| extreme())), &p);
            }
        }
        // Spreads around the limit of the fast path.
        for spread in 50..140 {
            let mut points = points_at(1.0 + f64::EPSILON);
            points[5] = [-(-f64::from(spread)).exp2(), -1.75, (-f64::from(spread)).exp2()];
            check_loose(&points, &p);
        }
        // Normal and denormal numbers next to each other.
        for _ in 0..20 {
            let mut least = || f64::MIN_POSITIVE * [0.0, 0.25, 0.75, 1.0, -1.0, -0.5, 1.5][rng.random_range(0..7)];
            check_loose(&[(); 6].map(|()| [(); 3].map(|()| least())), &p);
        }
        check_loose(&points_at(0.1), &p);
        check_loose(&points_at(0.0), &p);
        check_loose(&points_at(-0.0), &p);
        let mut denormal = points_at(0.0);
        denormal[4][1] = 5e-324;
        check_loose(&denormal, &p);
    }
}

fn points_at(x: f64) -> [[f64; 3]; 6] {
    [[x; 3]; 6]
}

const IDENTITY: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
const ODD: [[f64; 3]; 3] = [[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]];

fn meshes(rng: &mut ChaCha8Rng) -> [Vec<[f64; 3]>; 2] {
    let mut mesh = |n: usize, size: f64, at: f64| -> Vec<[f64; 3]> {
        (0..n).map(|_| [(); 3].map(|()| at + size * rng.random_range(-1.0..1.0))).collect()
    };
    [mesh(20, 3.7, 1.25), mesh(12, 0.3, -8.0)]
}

/// The relation that the rewritten pose must keep, on the unit's own inputs: M b' + t' = s (M b + t - c_A), whichever
/// side applied it.
#[test]
fn poses_are_rewritten_exactly() {
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    for transform in [Transform::On, Transform::Translate, Transform::Off] {
        let p = Params { transform, int_bits: 5, ..Params::default() };
        for (m, t, turned) in
            [(IDENTITY, [9.0, 9.1, 9.25], false), (IDENTITY, [9.0, 10.0, 9.0], false), (ODD, [2.0, 10.0, 3.0], true)]
        {
            let [a, b] = meshes(&mut rng);
            let host = SceneHost::new(&a, &b, &p).unwrap();
            let scene = host.pose(&m, &t).unwrap();
            let on_host = transform == Transform::Off || transform == Transform::Translate && turned;
            assert_eq!(scene.pose.bypass, on_host);
            let boxes = [bounds(&a), bounds(&b)];
            let scale = scale(&boxes.iter().flatten().map(half).max().unwrap());
            let centre = |side: usize| [0, 1, 2].map(|i| middle(&boxes[side][i]));
            let image = |x: &[Real; 3]| {
                [0, 1, 2].map(|i| {
                    let row = (0..3).fold(real(t[i]), |sum, j| sum + real(m[i][j]) * &x[j]);
                    (row - &centre(0)[i]) * &scale
                })
            };
            if !on_host {
                let shift = image(&centre(1));
                for i in 0..3 {
                    assert_quantised(scene.pose.t[i], &shift[i], &p);
                    for j in 0..3 {
                        assert_quantised(scene.pose.m[i][j], &real(m[i][j]), &p);
                    }
                }
            }
            let mut sent = 0;
            for k in 0..12u32 {
                let expected = if on_host {
                    image(&b[k as usize].map(real))
                } else {
                    [0, 1, 2].map(|i| (real(b[k as usize][i]) - &centre(1)[i]) * &scale)
                };
                let limit = Real::from_integer(p.coordinate_bound().into()) * two_to(-i64::from(p.input().fraction));
                let inside = expected.iter().all(|x| x.abs() <= limit);
                match scene.pair([k, 0, 1], [k, k, k]) {
                    Host::Unit(pair) => {
                        assert!(inside);
                        sent += 1;
                        for i in 0..3 {
                            let x = (real(a[k as usize][i]) - &centre(0)[i]) * &scale;
                            assert_quantised(pair.a[0][i], &x, &p);
                            assert_quantised(pair.b[0][i], &expected[i], &p);
                        }
                    }
                    Host::Decided(_) => assert!(!inside),
                }
            }
            assert!(sent > 0 || on_host, "{transform:?}");
        }
    }
}

#[test]
fn the_identity_is_bypassed() {
    let p = Params::default();
    let mesh = [[0.0, 0.0, 0.1], [1.0, 0.3, 0.0], [0.0, 2.0, 7.0]];
    for transform in [Transform::On, Transform::Translate, Transform::Off] {
        let host = SceneHost::new(&mesh, &mesh, &Params { transform, ..p.clone() }).unwrap();
        assert_eq!(host.pose(&IDENTITY, &[0.0; 3]).unwrap().pose, Pose::identity(&p));
    }
    // Same orientation, other place: a translation in normalised coordinates.
    let host = SceneHost::new(&mesh, &mesh.map(|x| [x[0] + 1.0, x[1], x[2]]), &p).unwrap();
    assert!(!host.pose(&IDENTITY, &[0.0; 3]).unwrap().pose.bypass);
    assert!(host.pose(&IDENTITY, &[-1.0, 0.0, 0.0]).unwrap().pose.bypass);
}

/// Out of range: strictly disjoint boxes are `separate`, all others `possibly-incorrect`, and touching is not disjoint.
#[test]
fn pairs_outside_the_ranges_are_decided_by_their_boxes() {
    let a =
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 1.0], [100.0, 0.0, 0.0], [101.0, 0.0, 0.0], [100.0, 1.0, 1.0]];
    let decided = |transform, b: &[[f64; 3]], m: &[[f64; 3]; 3], t: [f64; 3], triangle: [u32; 3]| {
        let p = Params { transform, ..Params::default() };
        SceneHost::new(&a, b, &p).unwrap().pose(m, &t).unwrap().pair(triangle, [0, 1, 2])
    };
    let b = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 1.0]];
    // A translation too long for the format.
    let far = decided(Transform::On, &b, &IDENTITY, [1e5, 0.0, 0.0], [0, 1, 2]);
    assert_eq!(far, Host::Decided(Verdict::Separate));
    // A matrix entry just above 1: everything is the host's.
    let mut stretched = IDENTITY;
    stretched[0][0] = 1.0 + f64::EPSILON;
    for (t, expected) in [
        ([1.0, 0.0, 0.0], Verdict::PossiblyIncorrect),
        ([1.0 + f64::EPSILON, 0.0, 0.0], Verdict::Separate),
        ([0.0, 0.0, -1.0], Verdict::PossiblyIncorrect),
        ([0.0, 0.0, -1.0 - f64::EPSILON], Verdict::Separate),
    ] {
        assert_eq!(decided(Transform::On, &b, &stretched, t, [0, 1, 2]), Host::Decided(expected), "{t:?}");
    }
    // The host has applied the pose, and one vertex of B left the range of the unit; others did not.
    let p = Params { transform: Transform::Translate, ..Params::default() };
    let b = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 1.0], [0.0, 80.0, 0.0]];
    let host = SceneHost::new(&a, &b, &p).unwrap();
    let turn = [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
    let scene = host.pose(&turn, &[50.0, 0.0, 0.0]).unwrap();
    assert!(matches!(scene.pair([0, 1, 2], [0, 1, 2]), Host::Unit(_)));
    let scene = host.pose(&turn, &[0.0, 0.0, 0.0]).unwrap();
    assert_eq!(scene.pair([3, 4, 5], [0, 1, 3]), Host::Decided(Verdict::Separate));
    assert_eq!(scene.pair([0, 1, 2], [0, 1, 3]), Host::Decided(Verdict::PossiblyIncorrect));
    assert!(matches!(scene.pair([0, 1, 2], [0, 1, 2]), Host::Unit(_)));
}

#[test]
fn a_vertex_that_is_not_finite_is_named_with_its_mesh() {
    let good = [[0.0, 1.0, 2.0]; 3];
    let mut bad = good;
    bad[2][1] = f64::NAN;
    let said =
        |a: &[[f64; 3]], b: &[[f64; 3]]| SceneHost::new(a, b, &Params::default()).map(drop).unwrap_err().to_string();
    assert_eq!(said(&bad, &good), "y of vertex 2 of mesh a is NaN: expected a finite number");
    assert_eq!(said(&good, &bad), "y of vertex 2 of mesh b is NaN: expected a finite number");
}

#[test]
fn a_point_mesh_keeps_its_scale() {
    let p = Params::default();
    let point = [[3.0, 4.0, 5.0]];
    let host = SceneHost::new(&point, &point, &p).unwrap();
    assert_eq!(unit(host.pose(&IDENTITY, &[0.0; 3]).unwrap().pair([0; 3], [0; 3])), Pair::default());
    let scene = host.pose(&IDENTITY, &[1.5, 0.0, 0.0]).unwrap();
    assert_eq!(scene.pose.t[0], Input::exact(3 << 27));
    // Nothing to read from a mesh without vertices, but it can be posed.
    assert!(SceneHost::new(&[], &[], &p).unwrap().pose(&IDENTITY, &[0.0; 3]).unwrap().pose.bypass);
}

/// What the host makes of a pair for the exact unit: the pair relative to V0 on its coarsest grid, if that fits.
fn check_grid(host: Host, points: &[[Real; 3]; 6], truth: Exact, p: &Params) -> bool {
    let differences = points.each_ref().map(|point| [0, 1, 2].map(|j| &point[j] - &points[0][j]));
    // How often two divides a number; its denominator is a power of two.
    let twos = |x: &Real| x.numer().trailing_zeros().unwrap() as i64 - x.denom().trailing_zeros().unwrap() as i64;
    let grid = differences.iter().flatten().filter(|x| !x.is_zero()).map(twos).min().unwrap_or(0);
    let whole = differences.map(|point| point.map(|x| (x * two_to(-grid)).to_integer()));
    let fits = whole.iter().flatten().all(|x| x.bits() < u64::from(p.width));
    let expected = if truth == Exact::Separate { Verdict::Separate } else { Verdict::Intersect };
    match host {
        Host::Unit(pair) => {
            let read = pair.a.iter().chain(&pair.b).flatten();
            assert!(fits && read.clone().all(|x| !x.sticky));
            assert!(read.map(|x| BigInt::from(x.lo)).eq(whole.into_iter().flatten()));
            assert_eq!(Golden::new(p).verdict(&Pose::identity(p), &pair), expected);
        }
        Host::Decided(verdict) => assert_eq!((fits, verdict), (false, expected)),
    }
    fits
}

#[test]
fn the_exact_unit_gets_pairs_on_their_own_grid() {
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    for (width, transform) in [(6, Transform::Off), (18, Transform::Translate), (32, Transform::Off)] {
        let p = Params { width, transform, ..Params::of(Method::Exact) };
        let (mut fit, mut hosts, mut given) = (0, vec![], vec![]);
        for round in 0..1500 {
            // Coordinates of few bits at any place, on several grids, and some that no grid holds.
            let bits = rng.random_range(1..=width + 2);
            let mut unit = f64::from(rng.random_range(-1000..900)).exp2();
            let at = f64::from(rng.random_range(-(1i64 << 20)..1 << 20) as i32) * unit;
            let mut points = [(); 6].map(|()| [(); 3].map(|()| at + rng.random_range(0..1i64 << bits) as f64 * unit));
            match round % 10 {
                0 => points = sample::random_points(&mut rng),
                1 => (points[4], points[5]) = (points[3], points[3]),
                2 => points[3] = points[1],
                3 => points[5][2] = 1e300,
                4 => {
                    // One plane that is at the other end of binary64.
                    unit = 1e-300;
                    points = [(); 6].map(|()| [1e300, 5.0 * unit, rng.random_range(0..4) as f64 * unit]);
                }
                5 => points = [points[0]; 6],
                _ => {}
            }
            let host = loose_pair(&points, &p).unwrap();
            fit += i32::from(check_grid(host, &points.map(|x| x.map(real)), exact::pair(&points).unwrap(), &p));
            hosts.push(host);
            given.push(points);
        }
        assert!((400..1400).contains(&fit), "{fit}");
        assert_eq!(loose_pairs(&given, &p).unwrap(), hosts);
        given[700][4][1] = f64::NAN;
        assert!(loose_pairs(&given, &p).unwrap_err().to_string().starts_with("pair 700: y of b1 is NaN"));
    }
}

#[test]
fn the_exact_unit_gets_scenes_after_their_pose() {
    let mut rng = ChaCha8Rng::seed_from_u64(6);
    let (turned, mut fit) = ([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]], [0; 3]);
    for transform in [Transform::Off, Transform::Translate] {
        let p = Params { transform, width: 10, ..Params::of(Method::Exact) };
        for _ in 0..20 {
            let mut mesh = || (0..6).map(|_| [(); 3].map(|()| f64::from(rng.random_range(-200..200)) / 4.0)).collect();
            let [a, b]: [Vec<[f64; 3]>; 2] = [mesh(), mesh()];
            let t = [0.25, -1e3, 7.5].map(|x| if rng.random() { x } else { 0.0 });
            let host = SceneHost::new(&a, &b, &p).unwrap();
            for (m, fit) in [IDENTITY, turned, ODD].iter().zip(&mut fit) {
                let scene = host.pose(m, &t).unwrap();
                assert!(scene.pose.bypass);
                let image = |x: &[f64; 3]| {
                    [0, 1, 2].map(|i| (0..3).fold(real(t[i]), |sum, j| sum + real(m[i][j]) * real(x[j])))
                };
                for k in 0..6 {
                    let (v, w) = ([k, 0, 1], [k, 2, k]);
                    let (of_a, of_b) = (v.map(|i| a[i as usize]), w.map(|i| b[i as usize]));
                    let [v0, v1, v2] = of_a.map(|x| x.map(real));
                    let [w0, w1, w2] = of_b.each_ref().map(image);
                    let truth = exact::posed_pair(&of_a, &of_b, m, &t).unwrap();
                    *fit += i32::from(check_grid(scene.pair(v, w), &[v0, v1, v2, w0, w1, w2], truth, &p));
                }
            }
        }
    }
    // Rotations by other angles leave no grid.
    assert!(fit[0] > 20 && fit[1] > 20 && fit[2] == 0, "{fit:?}");
}

/// A point of each mesh is snapped to one point, whatever the pair, and to one close by; what does not fit is decided by the
/// host for the same points.
#[test]
fn a_mesh_is_snapped_as_a_whole() {
    let mut rng = ChaCha8Rng::seed_from_u64(8);
    let angle = [[0.6, -0.8, 0.0], [0.8, 0.6, 0.0], [0.0, 0.0, 1.0]];
    let mut by_host = 0;
    for (width, transform_width) in [(18, 19), (18, 24), (32, 32), (9, 12)] {
        let p = Params { width, transform_width, ..Params::snapped() };
        let mut mesh = || (0..8).map(|_| [(); 3].map(|()| rng.random_range(-1.0..1.0))).collect();
        let [a, b]: [Vec<[f64; 3]>; 2] = [mesh(), mesh()];
        let reach = [&a, &b].iter().flat_map(|mesh| bounds(mesh)).map(|x| half(&x)).max().unwrap();
        let to_ulps = scale(&reach) * two_to(i64::from(transform_width) - i64::from(p.int_bits));
        let (host, golden) = (SceneHost::new(&a, &b, &p).unwrap(), Golden::new(&p));
        for (m, t) in [(IDENTITY, [0.0; 3]), (angle, [0.0; 3]), (angle, [0.25, -0.5, 0.125]), (ODD, [0.1, 0.0, 0.2])] {
            let scene = host.pose(&m, &t).unwrap();
            let at = |i: usize, l: usize| scene.snapped([0, i as u32, 1], [l as u32, 2, 3]).unwrap();
            for (i, l) in (0..8).flat_map(|i| (0..8).map(move |l| (i, l))) {
                assert_eq!([at(i, l)[1], at(i, l)[3]], [at(i, 0)[1], at(0, l)[3]]);
                // V_i - V_0 and W_l - V_0 in ulps.
                let image = |j: usize| (0..3).fold(real(t[j]), |sum, k| sum + real(m[j][k]) * real(b[l][k]));
                for j in 0..3 {
                    let far = |x: Real, snapped: f64| ((x - real(a[0][j])) * &to_ulps - real(snapped)).abs();
                    assert!(far(real(a[i][j]), at(i, l)[1][j]) < Real::one());
                    assert!(far(image(j), at(i, l)[3][j]) < Real::from_integer(5.into()));
                }
                let (a, b) = ([0, i as u32, 1], [l as u32, 2, 3]);
                let truth = exact::pair(&scene.snapped(a, b).unwrap()).unwrap();
                let expected = if truth == Exact::Separate { Verdict::Separate } else { Verdict::Intersect };
                match scene.pair(a, b) {
                    Host::Unit(pair) => assert_eq!(golden.verdict(&scene.pose, &pair), expected),
                    Host::Decided(verdict) => {
                        by_host += 1;
                        assert_eq!(verdict, expected);
                    }
                }
            }
        }
    }
    assert!(by_host > 100, "{by_host}");
}

#[test]
fn numbers_that_are_not_finite_are_refused() {
    let triangle = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
    for (value, index) in
        [f64::NAN, f64::INFINITY].into_iter().flat_map(|value| (0..9).map(move |index| (value, index)))
    {
        let mut other = triangle;
        other.as_flattened_mut()[index] = value;
        for method in [Method::Axes, Method::Determinants, Method::Exact] {
            let params = Params::of(method);
            let pair: [[f64; 3]; 6] = [triangle, other].concat().try_into().unwrap();
            assert!(loose_pair(&pair, &params).is_err());
            assert!(
                SceneHost::new(&triangle, &other, &params).is_err()
                    && SceneHost::new(&other, &triangle, &params).is_err()
            );
            let host = SceneHost::new(&triangle, &triangle, &params).unwrap();
            assert!(host.pose(&other, &[0.0; 3]).is_err() && host.pose(&IDENTITY, &other[index / 3]).is_err());
            assert!(host.numbers(&IDENTITY, &other[index / 3], &[triangle; 2]).is_err());
            assert!(host.numbers(&IDENTITY, &[0.0; 3], &[triangle, other]).is_err());
        }
    }
}
