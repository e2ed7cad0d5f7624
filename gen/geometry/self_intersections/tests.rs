//! Every pair against the extreme points of the intersection, in whole numbers of any length: a computation that shares no code
//! with the search.

use super::*;
use crate::mesh;
use nalgebra::Point3;
use num_bigint::BigInt;
use num_traits::{Signed, Zero};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use std::collections::BTreeMap;
use std::convert::Infallible;
use std::path::Path;

type Vector = [BigInt; 3];

/// Where a point goes.
type Place = fn([f64; 3]) -> [f64; 3];

/// A point: numerators over one positive denominator.
type Fraction = (Vector, BigInt);

fn minus(x: &Vector, y: &Vector) -> Vector {
    [0, 1, 2].map(|i| &x[i] - &y[i])
}

fn times(x: &Vector, m: &BigInt) -> Vector {
    [0, 1, 2].map(|i| &x[i] * m)
}

fn dot(x: &Vector, y: &Vector) -> BigInt {
    (0..3).map(|i| &x[i] * &y[i]).sum()
}

fn cross(x: &Vector, y: &Vector) -> Vector {
    [0, 1, 2].map(|i| &x[(i + 1) % 3] * &y[(i + 2) % 3] - &x[(i + 2) % 3] * &y[(i + 1) % 3])
}

fn is_zero(x: &Vector) -> bool {
    x.iter().all(Zero::is_zero)
}

/// p + d n / m.
fn along(p: &Vector, d: &Vector, n: &BigInt, m: &BigInt) -> Fraction {
    let (n, m) = if m.is_negative() { (-n, -m) } else { (n.clone(), m.clone()) };
    ([0, 1, 2].map(|i| &p[i] * &m + &d[i] * &n), m)
}

/// Whether a segment has the point.
fn on_segment([p, q]: [&Vector; 2], (x, m): &Fraction) -> bool {
    let (from, to) = (minus(x, &times(p, m)), minus(&times(q, m), x));
    is_zero(&cross(&from, &to)) && !dot(&from, &to).is_negative()
}

/// Whether a triangle has it.
fn inside(t: &[Vector; 3], point: &Fraction) -> bool {
    let n = cross(&minus(&t[1], &t[0]), &minus(&t[2], &t[0]));
    if is_zero(&n) {
        return (0..3).any(|k| on_segment([&t[k], &t[(k + 1) % 3]], point));
    }
    let (x, m) = point;
    let side = |k: usize| !dot(&n, &cross(&minus(&t[(k + 1) % 3], &t[k]), &minus(x, &times(&t[k], m)))).is_negative();
    dot(&n, &minus(x, &times(&t[0], m))).is_zero() && (0..3).all(side)
}

/// The points among which are all extreme points of the intersection.
fn extreme(a: &[Vector; 3], b: &[Vector; 3]) -> Vec<Fraction> {
    let mut points: Vec<Fraction> = a.iter().chain(b).map(|p| (p.clone(), BigInt::from(1))).collect();
    for (x, y) in [(a, b), (b, a)] {
        let n = cross(&minus(&y[1], &y[0]), &minus(&y[2], &y[0]));
        for k in 0..3 {
            let (p, d) = (&x[k], minus(&x[(k + 1) % 3], &x[k]));
            let rate = dot(&n, &d);
            if !rate.is_zero() {
                points.push(along(p, &d, &dot(&n, &minus(&y[0], p)), &rate));
            }
            for l in 0..3 {
                let (q, f) = (&y[l], minus(&y[(l + 1) % 3], &y[l]));
                let c = cross(&d, &f);
                if !is_zero(&c) && dot(&minus(q, p), &c).is_zero() {
                    points.push(along(p, &d, &dot(&cross(&minus(q, p), &f), &c), &dot(&c, &c)));
                }
            }
        }
    }
    points.into_iter().filter(|x| inside(a, x) && inside(b, x)).collect()
}

/// Whether all of a triangle is strictly on one side of the plane of another.
fn is_beside(t: &[Vector; 3], x: &[Vector; 3]) -> bool {
    let n = cross(&minus(&t[1], &t[0]), &minus(&t[2], &t[0]));
    let heights = [0, 1, 2].map(|k| dot(&n, &minus(&x[k], &t[0])));
    heights.iter().all(Signed::is_positive) || heights.iter().all(Signed::is_negative)
}

/// What is wrong with two triangles, by that. Crossing and touching are told apart by the oracle.
fn expected(a: &[Vector; 3], b: &[Vector; 3], corners: &Points) -> Option<Kind> {
    let mut shared: Vec<&Vector> = a.iter().filter(|x| b.contains(x)).collect();
    shared.sort_unstable();
    shared.dedup();
    if shared.is_empty() && (is_beside(a, b) || is_beside(b, a)) {
        return None;
    }
    let points = extreme(a, b);
    match shared[..] {
        [] => {
            let class = exact::pair(corners).unwrap();
            assert_eq!(points.is_empty(), class == Exact::Separate);
            [None, Some(Kind::Touching), Some(Kind::Crossing)][class as usize]
        }
        [v] => points.iter().any(|(x, m)| *x != times(v, m)).then_some(Kind::Neighbours),
        [v, w] => points.iter().any(|x| !on_segment([v, w], x)).then_some(Kind::Neighbours),
        _ => Some(Kind::Duplicate),
    }
}

/// The coordinates as whole numbers of one power of two.
fn whole(mesh: &Mesh) -> Vec<Vector> {
    let decoded = |x: f64| {
        let bits = x.to_bits();
        let exponent = (bits >> 52 & 0x7ff) as i64;
        let mantissa = (bits & ((1 << 52) - 1)) as i64 | i64::from(exponent > 0) << 52;
        (if x < 0.0 { -mantissa } else { mantissa }, exponent.max(1))
    };
    let numbers: Vec<[(i64, i64); 3]> = mesh.vertices().iter().map(|v| [0, 1, 2].map(|i| decoded(v[i]))).collect();
    let nonzero = numbers.iter().flatten().filter(|(mantissa, _)| *mantissa != 0);
    let least = nonzero.map(|(mantissa, e)| e + i64::from(mantissa.trailing_zeros())).min().unwrap_or(0);
    let scaled = |(mantissa, e): (i64, i64)| match e - least {
        up @ 0.. => BigInt::from(mantissa) << up,
        down => BigInt::from(mantissa) >> -down,
    };
    numbers.into_iter().map(|v| v.map(scaled)).collect()
}

/// All defects of a mesh by the extreme points: among triangles whose boxes overlap, found by a sweep along x.
fn by_extreme_points(mesh: &Mesh) -> Vec<Defect> {
    let vertices = whole(mesh);
    let corners = |face: u32| mesh.faces()[face as usize].map(|v| <[f64; 3]>::from(mesh.vertices()[v as usize]));
    let ends = |face: u32, axis: usize| {
        let x = corners(face).map(|p| p[axis]);
        (x[0].min(x[1]).min(x[2]), x[0].max(x[1]).max(x[2]))
    };
    let overlap = |p: u32, q: u32, axis: usize| {
        let (p, q) = (ends(p, axis), ends(q, axis));
        p.0 <= q.1 && q.0 <= p.1
    };
    let mut order: Vec<u32> = (0..mesh.faces().len() as u32).collect();
    order.sort_by(|p, q| ends(*p, 0).0.total_cmp(&ends(*q, 0).0));
    let of = |at: usize| {
        let p = order[at];
        let later = order[at + 1..].iter().take_while(|q| ends(**q, 0).0 <= ends(p, 0).1);
        let near = later.filter(|q| overlap(p, **q, 1) && overlap(p, **q, 2));
        let defects = near.filter_map(|&q| {
            let pair = (p.min(q), p.max(q));
            let [a, b] = [pair.0, pair.1].map(|face| mesh.faces()[face as usize]);
            let [x, y] = [a, b].map(|face| face.map(|v| vertices[v as usize].clone()));
            expected(&x, &y, &points(mesh, [a, b])).map(|kind| Defect { pair, kind })
        });
        defects.collect::<Vec<Defect>>()
    };
    let mut defects: Vec<Defect> = (0..order.len()).into_par_iter().flat_map_iter(of).collect();
    defects.sort_unstable();
    defects
}

/// What the search finds, with the oracle.
fn found(mesh: &Mesh) -> Vec<Defect> {
    let mut all = vec![];
    let mut last = 0;
    let Ok(()) = Search::new(mesh, true).each(|done, defects, effort| {
        assert!(done > last && effort.contradictions == 0, "{effort:?}");
        last = done;
        all.extend_from_slice(defects);
        Ok::<(), Infallible>(())
    });
    assert_eq!(last, mesh.faces().len());
    all
}

/// Random faces on few places, so that common vertices and edges, segments, points and duplicates are frequent; the places
/// moved by `place`.
fn small(rng: &mut ChaCha8Rng, place: impl Fn([f64; 3]) -> [f64; 3]) -> Mesh {
    let size = rng.random_range(1..=3);
    let at = |rng: &mut ChaCha8Rng| [(); 3].map(|()| f64::from(rng.random_range(0..=size)));
    // Some vertices are equal, and one has another zero.
    let mut vertices: Vec<Point3<f64>> = (0..9).map(|_| place(at(rng)).into()).collect();
    vertices.push(vertices[0].map(|x| if x == 0.0 { -x } else { x }));
    let faces: Vec<_> = (0..8).map(|_| [0; 3].map(|_: u32| rng.random_range(0..10))).collect();
    Mesh::new(vertices, faces).unwrap()
}

#[test]
fn every_pair_of_small_meshes_is_what_the_extreme_points_say() {
    pairs_are_what_the_extreme_points_say(150);
}

#[test]
#[ignore = "takes long: scripts/test full"]
fn every_pair_of_many_small_meshes_is_what_the_extreme_points_say() {
    pairs_are_what_the_extreme_points_say(2000);
}

fn pairs_are_what_the_extreme_points_say(meshes: u32) {
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    // As they are; sheared, so that planes are tilted; rounded, so that they are bent; scaled to either end of binary64.
    let places: [(&str, Place); 6] = [
        ("whole", |x| x),
        ("tilted", |[x, y, z]| [x + 3.0 * y, y - 2.0 * z, z + x + y]),
        ("rounded", |[x, y, z]| [0.1 * x + 0.7 * y, 0.3 * y - 0.9 * z, 0.2 * z + 0.3 * x + 1e6]),
        ("least", |x| x.map(|x| x * f64::from_bits(1))),
        ("greatest", |x| x.map(|x| x * (f64::MAX / 4.0))),
        ("wide", |[x, y, z]| [x * 1e-300, y * 1e300, z]),
    ];
    for (name, place) in places {
        let mut counts = [0; Kind::ALL.len()];
        for _ in 0..meshes {
            let mesh = small(&mut rng, place);
            let found = found(&mesh);
            assert_eq!(found, by_extreme_points(&mesh), "{name}: {mesh:?}");
            found.iter().for_each(|defect| counts[defect.kind as usize] += 1);
        }
        assert!(counts.iter().all(|count| *count > meshes / 50), "{name}: {counts:?}");
    }
}

/// Two triangles with common vertices, near a plane or not, which random places on a lattice are too coarse for.
#[test]
fn neighbours_next_to_contact_are_what_the_extreme_points_say() {
    neighbours_are_what_the_extreme_points_say(600);
}

#[test]
#[ignore = "takes long: scripts/test full"]
fn many_neighbours_next_to_contact_are_what_the_extreme_points_say() {
    neighbours_are_what_the_extreme_points_say(20_000);
}

fn neighbours_are_what_the_extreme_points_say(meshes: u32) {
    let mut rng = ChaCha8Rng::seed_from_u64(8);
    let mut counts: BTreeMap<(usize, bool), u32> = BTreeMap::new();
    for _ in 0..meshes {
        let far = f64::from(rng.random_range(0..30)).exp2();
        let mut vertices: Vec<[f64; 3]> = (0..5).map(|_| [(); 3].map(|()| far + rng.random_range(-1.0..1.0))).collect();
        // Corners next to the plane of the first three, or next to an edge.
        for corner in 3..5 {
            let off = f64::from(-rng.random_range(0..60)).exp2();
            let (s, t) = (rng.random_range(-1.0..1.0), if rng.random() { 0.0 } else { rng.random_range(-1.0..1.0) });
            vertices[corner] = [0, 1, 2].map(|i| {
                let [v, x, y] = [0, 1, 2].map(|corner: usize| vertices[corner][i]);
                v + s * (x - v) + t * (y - v) + off * rng.random_range(-1.0..1.0)
            });
        }
        let shared = rng.random_range(1..=2);
        let faces = vec![[0, 1, 2], if shared == 1 { [3, 0, 4] } else { [1, 3, 0] }];
        let mesh = Mesh::new(vertices, faces).unwrap();
        let found = found(&mesh);
        assert_eq!(found, by_extreme_points(&mesh), "{mesh:?}");
        *counts.entry((shared, !found.is_empty())).or_default() += 1;
    }
    // Triangles with a common edge meet in one plane only, which rounded corners seldom are in.
    let least = meshes / 20;
    assert!(
        counts[&(1, true)] > least && counts[&(1, false)] > 2 * least && counts[&(2, false)] > 2 * least,
        "{counts:?}"
    );
}

/// A mesh of the scenes, whole.
#[test]
fn self_intersections_of_a_file_are_those_of_the_extreme_points() {
    files_have_what_the_extreme_points_say(&[("m8_nut.stl", 597)]);
}

#[test]
#[ignore = "takes long: scripts/test full"]
fn self_intersections_of_files_are_those_of_the_extreme_points() {
    files_have_what_the_extreme_points_say(&[("m8_bolt.stl", 1318), ("cad_headlight.stl", 271)]);
}

fn files_have_what_the_extreme_points_say(files: &[(&str, usize)]) {
    for &(name, count) in files {
        let (mesh, _) = mesh::survey(&Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(name)).unwrap();
        let mut found = vec![];
        let search = Search::new(&mesh, false);
        let Ok(()) = search.each(|_, defects, _| {
            found.extend_from_slice(defects);
            Ok::<(), Infallible>(())
        });
        assert!(found == by_extreme_points(&mesh), "{name}");
        assert_eq!((found.len(), search.degenerate()), (count, 0), "{name}");
    }
}

#[test]
fn what_is_found_does_not_depend_on_threads() {
    let mut rng = ChaCha8Rng::seed_from_u64(9);
    let vertices: Vec<[f64; 3]> = (0..600).map(|_| [(); 3].map(|()| rng.random_range(-1.0..1.0))).collect();
    let faces: Vec<_> = (0..3000).map(|_| [0; 3].map(|_: u32| rng.random_range(0..600))).collect();
    let mesh = Mesh::new(vertices, faces).unwrap();
    let run = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let (mut all, mut sum) = (vec![], Effort::default());
            let Ok(()) = Search::new(&mesh, false).each(|_, defects, effort| {
                assert!(defects.len() < 600_000, "{}", defects.len());
                all.extend_from_slice(defects);
                sum.add(effort);
                Ok::<(), Infallible>(())
            });
            (all, sum)
        })
    };
    let (one, three) = (run(1), run(3));
    assert!(one == three && one.0.is_sorted() && one.0.len() > 100_000, "{:?}", one.1);
    assert_eq!(Search::new(&mesh, false).each(|_, _, _| Err("full")), Err("full"));
}

#[test]
fn segments_and_points_are_counted_exactly() {
    let least = f64::from_bits(1);
    let corners = [[0.0; 3], [least, 0.0, 0.0], [2.0 * least, 0.0, 0.0], [0.0, least, 0.0], [1e300, 0.0, least]];
    let faces = vec![[0, 1, 2], [0, 1, 3], [0, 0, 3], [4, 4, 4], [0, 1, 4]];
    let mesh = Mesh::new(corners, faces).unwrap();
    assert_eq!(Search::new(&mesh, false).degenerate(), 3);
}
