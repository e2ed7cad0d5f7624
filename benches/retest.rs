//! The exact retest beside its own stages, plain separating axes and the oracle: time per pair on one core.
//!
//! Divide a time by the number of pairs, which is the throughput's element.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, SamplingMode, Throughput, criterion_group, criterion_main};
use efsat::exact;
use efsat::golden::Golden;
use efsat::host::{Host, SceneHost};
use efsat::pair::Verdict;
use efsat::params::Params;
use efsat::scene::Scene;
use efsat::software::retest::{retest, retest_batch};
use efsat::software::{Test, robbins_whitesides};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

type Points = [[f64; 3]; 6];

const PAIRS: usize = 1024;
/// One pose in so many of the default scene.
const POSE_STEP: usize = 6;

/// Both triangles in the unit cube, B's moved by `distance` along x.
fn random(rng: &mut ChaCha8Rng, distance: f64) -> Points {
    let mut p = [(); 6].map(|()| [(); 3].map(|()| rng.random_range(0.0..1.0)));
    p[3..].iter_mut().for_each(|x| x[0] += distance);
    p
}

fn shared_vertex(rng: &mut ChaCha8Rng) -> Points {
    let mut p = random(rng, 0.0);
    p[3] = p[0];
    p
}

fn shared_edge(rng: &mut ChaCha8Rng) -> Points {
    let mut p = shared_vertex(rng);
    p[4] = p[1];
    p
}

/// On a grid that makes the contact exact.
fn vertex_on_face(rng: &mut ChaCha8Rng) -> Points {
    let mut p = random(rng, 0.0).map(|x| x.map(|x| (x * 1024.0).round()));
    p[3] = [0, 1, 2].map(|i| p[0][i] + (p[1][i] - p[0][i]) * 0.25 + (p[2][i] - p[0][i]) * 0.5);
    p
}

/// Rounded to the plane of the face, as vertices computed in binary64 are.
fn vertex_near_face(rng: &mut ChaCha8Rng) -> Points {
    let mut p = random(rng, 0.0);
    let (u, v): (f64, f64) = (rng.random_range(0.0..0.5), rng.random_range(0.0..0.5));
    p[3] = [0, 1, 2].map(|i| p[0][i] + (p[1][i] - p[0][i]) * u + (p[2][i] - p[0][i]) * v);
    p
}

/// Edges that cross but for the rounding.
fn edge_near_edge(rng: &mut ChaCha8Rng) -> Points {
    let mut p = random(rng, 0.0);
    let (u, v) = (rng.random_range(0.0..1.0), rng.random_range(0.0..1.0));
    let at = |x: &[f64; 3], y: &[f64; 3], u: f64| [0, 1, 2].map(|i| x[i] + (y[i] - x[i]) * u);
    let (on_a, on_b) = (at(&p[0], &p[1], u), at(&p[3], &p[4], v));
    p[3..].iter_mut().for_each(|x| *x = [0, 1, 2].map(|i| x[i] + (on_a[i] - on_b[i])));
    p
}

fn coplanar_lattice(rng: &mut ChaCha8Rng) -> Points {
    let [u, v] = [(); 2].map(|()| [(); 3].map(|()| f64::from(rng.random_range(-9..=9))));
    [(); 6].map(|()| {
        let [s, t] = [(); 2].map(|()| f64::from(rng.random_range(-9..=9)));
        [0, 1, 2].map(|i| s * u[i] + t * v[i])
    })
}

fn coplanar_rounded(rng: &mut ChaCha8Rng) -> Points {
    let [u, v] = [(); 2].map(|()| [(); 3].map(|()| rng.random_range(-1.0..1.0)));
    [(); 6].map(|()| {
        let [s, t] = [(); 2].map(|()| rng.random_range(-1.0..1.0));
        [0, 1, 2].map(|i| s * u[i] + t * v[i])
    })
}

/// Needles of a width of 2^-30, crossing or passing.
fn slivers(rng: &mut ChaCha8Rng) -> Points {
    let mut p = edge_near_edge(rng);
    for i in [0, 3] {
        p[i + 2] = [0, 1, 2].map(|x| p[i][x] + (p[i + 1][x] - p[i][x]) * 0.5 + p[i + 2][x] * (-30f64).exp2());
    }
    p
}

fn segments(rng: &mut ChaCha8Rng) -> Points {
    let mut p = vertex_near_face(rng);
    p[5] = p[4];
    p
}

/// Triangles of the default scene that survive the broad phase, and those of them that the unit leaves undecided; the
/// pose is applied in binary64, and the rounded points are the pairs.
fn scene_pairs() -> [Vec<Points>; 2] {
    let (scene, params) = (Scene::default_scene(), Params::default());
    let meshes = [0, 1].map(|object: usize| scene.objects[object].mesh.as_ref());
    let [a, b] = meshes.map(|mesh| mesh.vertices().iter().map(|v| [v.x, v.y, v.z]).collect::<Vec<_>>());
    let (host, golden, near) = (SceneHost::new(&a, &b, &params).unwrap(), Golden::new(&params), scene.near());
    let [mut all, mut undecided] = [vec![], vec![]];
    for meeting in (0..scene.frames()).step_by(POSE_STEP).flat_map(|frame| near.meetings(frame)) {
        let m = meeting.pose.rotation();
        let rows = [0, 1, 2].map(|i| [0, 1, 2].map(|j| m[(i, j)]));
        let posed = host.pose(&rows, &meeting.pose.translation().into()).unwrap();
        for (of_a, of_b) in near.pairs(&meeting) {
            let (of_a, of_b) = (meshes[0].faces()[of_a as usize], meshes[1].faces()[of_b as usize]);
            let [a0, a1, a2] = of_a.map(|i| a[i as usize]);
            let [b0, b1, b2] = of_b.map(|i| meeting.pose.image(&meshes[1].vertices()[i as usize]).into());
            all.push([a0, a1, a2, b0, b1, b2]);
            let verdict = match posed.pair(of_a, of_b) {
                Host::Unit(pair) => golden.verdict(&posed.pose, &pair),
                Host::Decided(verdict) => verdict,
            };
            if verdict == Verdict::PossiblyIncorrect {
                undecided.push([a0, a1, a2, b0, b1, b2]);
            }
        }
    }
    [all, undecided]
}

fn bench(c: &mut Criterion) {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let mut set = |make: &dyn Fn(&mut ChaCha8Rng) -> Points| (0..PAIRS).map(|_| make(&mut rng)).collect::<Vec<_>>();
    let mut sets = vec![
        ("random, distance 0", set(&|rng| random(rng, 0.0))),
        ("random, distance 1", set(&|rng| random(rng, 1.0))),
        ("shared vertex", set(&shared_vertex)),
        ("shared edge", set(&shared_edge)),
        ("vertex on face", set(&vertex_on_face)),
        ("vertex near face", set(&vertex_near_face)),
        ("edge near edge", set(&edge_near_edge)),
        ("coplanar, lattice", set(&coplanar_lattice)),
        ("coplanar, rounded", set(&coplanar_rounded)),
        ("slivers", set(&slivers)),
        ("segments", set(&segments)),
    ];
    let [all, undecided] = scene_pairs();
    sets.extend([("scene, all", all), ("scene, possibly incorrect", undecided)]);
    for (name, pairs) in &sets {
        let mut group = c.benchmark_group(*name);
        group.throughput(Throughput::Elements(pairs.len() as u64)).sample_size(20).sampling_mode(SamplingMode::Flat);
        group.warm_up_time(std::time::Duration::from_millis(200));
        group.measurement_time(std::time::Duration::from_millis(800));
        let mut answers = Vec::with_capacity(pairs.len());
        group.bench_function(BenchmarkId::from_parameter("retest_batch"), |b| {
            b.iter(|| {
                answers.clear();
                retest_batch(black_box(pairs), &mut answers).unwrap();
                answers.len()
            });
        });
        let mut single = |what: &str, test: &dyn Fn(&Points) -> bool| {
            group.bench_function(BenchmarkId::from_parameter(what), |b| {
                b.iter(|| pairs.iter().filter(|p| test(black_box(p))).count());
            });
        };
        single("retest", &|p| retest(p).unwrap() != exact::Exact::Separate);
        single("robbins_whitesides", &robbins_whitesides::intersect);
        single("separating axes, binary64, inexact", &|points| Test::SeparatingAxes11F64.intersect(points).unwrap());
        single("exact::pair", &|p| exact::pair(p).unwrap() != exact::Exact::Separate);
        group.finish();
    }
}

criterion_group!(benches, bench);
criterion_main!(benches);
