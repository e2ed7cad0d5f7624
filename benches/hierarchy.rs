//! Speed of the k-DOP hierarchy on two meshes of 20,000 triangles, and a guard: a tumbling turn of 1000 poses must take
//! less than a minute on the cores at hand.

use criterion::{Criterion, criterion_group, criterion_main};
use efsat::collide::hierarchy::{Directions, DopTree, Scratch, pairs};
use efsat::mesh::Mesh;
use efsat::scene::{Pose, Scene};
use nalgebra::Point3;
use rayon::prelude::*;
use std::hint::black_box;
use std::time::Instant;

/// Poses of the turn.
const POSES: usize = 1000;
/// One pose in so many is measured; the time of all is reckoned from it.
const STEP: usize = 25;
/// The most seconds that the turn may take.
const SECONDS: f64 = 60.0;

/// A sphere with bumps and dents: 100 by 100 quadrangles, 20,000 triangles, of which the poles are needles.
fn bumpy_sphere() -> Mesh {
    let (rings, sides) = (100u32, 100u32);
    let vertex = |i: u32, j: u32| {
        let angle = |part: u32, whole: u32, turn: f64| turn * f64::from(part) / f64::from(whole);
        let (u, v) = (angle(i, rings, std::f64::consts::PI), angle(j, sides, std::f64::consts::TAU));
        let r = 1.0 + 0.1 * (9.0 * u).sin() * (7.0 * v).cos();
        Point3::new(r * u.sin() * v.cos(), r * u.sin() * v.sin(), r * u.cos())
    };
    let index = |i: u32, j: u32| i * sides + j % sides;
    let vertices: Vec<_> = (0..=rings).flat_map(|i| (0..sides).map(move |j| vertex(i, j))).collect();
    let square = |(i, j): (u32, u32)| {
        let [p, q, r, s] = [index(i, j), index(i, j + 1), index(i + 1, j + 1), index(i + 1, j)];
        [[p, q, r], [p, r, s]]
    };
    let faces: Vec<_> = (0..rings).flat_map(|i| (0..sides).map(move |j| (i, j))).flat_map(square).collect();
    Mesh::new(vertices, faces).unwrap()
}

/// Ten distances, from just apart to well into each other.
fn poses(mesh: &Mesh) -> Vec<Pose> {
    let distances: Vec<f64> = (0..10).map(|i| 2.0 - 0.1 * f64::from(i)).collect();
    let scene = Scene::against_itself("sphere", mesh.clone(), (POSES / distances.len()) as u32, &distances).unwrap();
    (0..scene.frames()).map(|frame| scene.frame(frame).poses[1]).collect()
}

fn query(c: &mut Criterion) {
    let mesh = bumpy_sphere();
    assert_eq!(mesh.faces().len(), 20_000);
    let poses = poses(&mesh);
    let mut group = c.benchmark_group("hierarchy");
    group.sample_size(10);
    group.bench_function("build, k = 18", |b| b.iter(|| DopTree::new(black_box(&mesh), Directions::Eighteen)));
    for set in Directions::ALL {
        let tree = DopTree::new(&mesh, set);
        let mut scratch = Scratch::default();
        let pose = poses[POSES / 2];
        group.bench_function(format!("all pairs of one pose, k = {}", set.count()), |b| {
            b.iter(|| pairs(&tree, &tree, black_box(&pose), &mut scratch).0.len());
        });
    }
    group.finish();
}

fn turn(_: &mut Criterion) {
    let mesh = bumpy_sphere();
    let poses: Vec<Pose> = poses(&mesh).into_iter().step_by(STEP).collect();
    for set in Directions::ALL {
        let start = Instant::now();
        let tree = DopTree::new(&mesh, set);
        let found =
            poses.par_iter().map_init(Scratch::default, |scratch, pose| pairs(&tree, &tree, pose, scratch).0.len());
        let found: usize = found.sum();
        let seconds = start.elapsed().as_secs_f64() * STEP as f64;
        println!("1000 poses, k = {}: {seconds:.1} s, {} pairs", set.count(), found * STEP);
        assert!(seconds < SECONDS, "two meshes of 20,000 triangles in 1000 poses: {seconds:.0} s, above {SECONDS} s");
    }
}

criterion_group!(benches, turn, query);
criterion_main!(benches);
