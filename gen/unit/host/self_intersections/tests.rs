//! Every pair against the extreme points of the intersection, in exact fractions.

use super::*;
use crate::params::Method;
use nalgebra::Point3;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

type Vector = [i128; 3];

/// A point: numerators over one positive denominator.
type Fraction = (Vector, i128);

fn minus(x: Vector, y: Vector) -> Vector {
    [0, 1, 2].map(|i| x[i] - y[i])
}

fn dot(x: Vector, y: Vector) -> i128 {
    (0..3).map(|i| x[i] * y[i]).sum()
}

fn cross(x: Vector, y: Vector) -> Vector {
    [0, 1, 2].map(|i| x[(i + 1) % 3] * y[(i + 2) % 3] - x[(i + 2) % 3] * y[(i + 1) % 3])
}

/// p + d n / m.
fn along(p: Vector, d: Vector, n: i128, m: i128) -> Fraction {
    let (n, m) = if m < 0 { (-n, -m) } else { (n, m) };
    ([0, 1, 2].map(|i| p[i] * m + d[i] * n), m)
}

/// Whether a segment has the point.
fn on_segment([p, q]: [Vector; 2], (x, m): Fraction) -> bool {
    let (from, to) = (minus(x, p.map(|y| y * m)), minus(q.map(|y| y * m), x));
    cross(from, to) == [0; 3] && dot(from, to) >= 0
}

/// Whether a triangle has it.
fn inside(t: [Vector; 3], (x, m): Fraction) -> bool {
    let n = cross(minus(t[1], t[0]), minus(t[2], t[0]));
    if n == [0; 3] {
        return (0..3).any(|k| on_segment([t[k], t[(k + 1) % 3]], (x, m)));
    }
    let side = |k: usize| dot(n, cross(minus(t[(k + 1) % 3], t[k]), minus(x, t[k].map(|y| y * m)))) >= 0;
    dot(n, minus(x, t[0].map(|y| y * m))) == 0 && (0..3).all(side)
}

/// The points among which are all extreme points of the intersection.
fn extreme(a: [Vector; 3], b: [Vector; 3]) -> Vec<Fraction> {
    let mut points: Vec<Fraction> = a.iter().chain(&b).map(|p| (*p, 1)).collect();
    for (x, y) in [(a, b), (b, a)] {
        let n = cross(minus(y[1], y[0]), minus(y[2], y[0]));
        for k in 0..3 {
            let (p, d) = (x[k], minus(x[(k + 1) % 3], x[k]));
            if dot(n, d) != 0 {
                points.push(along(p, d, dot(n, minus(y[0], p)), dot(n, d)));
            }
            for l in 0..3 {
                let (q, f) = (y[l], minus(y[(l + 1) % 3], y[l]));
                let c = cross(d, f);
                if c != [0; 3] && dot(minus(q, p), c) == 0 {
                    points.push(along(p, d, dot(cross(minus(q, p), f), c), dot(c, c)));
                }
            }
        }
    }
    points.into_iter().filter(|x| inside(a, *x) && inside(b, *x)).collect()
}

/// What is wrong with two faces, by that.
fn expected(mesh: &Mesh, p: u32, q: u32) -> Option<Kind> {
    let faces = [p, q].map(|face| mesh.faces()[face as usize]);
    let at = |vertex: u32| -> Vector { [0, 1, 2].map(|i| mesh.vertices()[vertex as usize][i] as i128) };
    let [a, b] = faces.map(|face| face.map(at));
    let shared: Vec<Vector> = a.iter().copied().filter(|x| b.contains(x)).collect();
    let points = extreme(a, b);
    if shared.is_empty() {
        let corners = faces.map(|face| face.map(|vertex| mesh.vertices()[vertex as usize].into()));
        let class = exact::pair(&[corners[0], corners[1]].concat().try_into().unwrap()).unwrap();
        assert_eq!(points.is_empty(), class == Exact::Separate);
        return [None, Some(Kind::Touching), Some(Kind::Crossing)][class as usize];
    }
    let mut different = shared.clone();
    different.sort_unstable();
    different.dedup();
    match different[..] {
        [v] => points.iter().any(|(x, m)| *x != v.map(|y| y * m)).then_some(Kind::Neighbours),
        [v, w] => points.iter().any(|x| !on_segment([v, w], *x)).then_some(Kind::Neighbours),
        _ => Some(Kind::Duplicate),
    }
}

#[test]
fn every_pair_of_small_meshes_is_what_the_extreme_points_say() {
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    let params = Params { width: 6, ..Params::of(Method::Exact) };
    let mut counts = [0; 5];
    for _ in 0..4000 {
        let size = rng.random_range(1..=3);
        let mut vertices: Vec<[i64; 3]> = (0..9).map(|_| [0; 3].map(|_: i64| rng.random_range(0..=size))).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let count = vertices.len() as u32;
        let faces: Vec<[u32; 3]> = (0..8).map(|_| [0; 3].map(|_: u32| rng.random_range(0..count))).collect();
        let vertices = vertices.iter().map(|x| Point3::from(x.map(|x| x as f64))).collect();
        let mesh = Mesh::new(vertices, faces).unwrap();
        let checker = Checker::new(&mesh, &params, true);
        let pairs: Vec<(u32, u32)> = (0..8).flat_map(|q| (0..q).map(move |p| (p, q))).collect();
        let (defects, effort) = checker.check(&pairs);
        assert_eq!((effort.contradictions, effort.by_host), (0, 0));
        for pair in pairs {
            let found = defects.iter().find(|defect| defect.pair == pair).map(|defect| defect.kind);
            let faces = [pair.0, pair.1].map(|face| mesh.faces()[face as usize].map(|v| mesh.vertices()[v as usize]));
            assert_eq!(found, expected(&mesh, pair.0, pair.1), "{faces:?}");
            counts[found.map_or(4, |kind| kind as usize)] += 1;
        }
        // No defect is outside the candidates.
        let Ok(()) = checker.candidates(|pairs| {
            assert_eq!(checker.check(pairs).0.len(), defects.len());
            Ok::<(), std::convert::Infallible>(())
        });
    }
    assert!(counts.iter().all(|count| *count > 100), "{counts:?}");
}
