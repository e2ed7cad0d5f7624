//! Speed of the reference model and of the exact oracle on random pairs: pairs per second on one core.

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use efsat::golden::Golden;
use efsat::host::{Host, loose_pair, sample};
use efsat::pair::{Pair, Pose};
use efsat::params::{Bound, Method, Params, Transform};
use efsat::sample::random_points;
use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;

const PAIRS: usize = 4096;

fn verdict(c: &mut Criterion) {
    let mut group = c.benchmark_group("golden");
    group.throughput(Throughput::Elements(PAIRS as u64));
    for (name, width, transform_width) in [("width 18", 18, 32), ("width 32", 32, 48)] {
        let params = Params { width, transform_width, ..Params::default() };
        let golden = Golden::new(&params);
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        let queries: Vec<(Pose, Pair)> = (0..PAIRS)
            .map(|_| {
                let pose = sample::random_pose(&mut rng, &params);
                (pose, sample::random_pair_under(&mut rng, &params, &pose))
            })
            .collect();
        group.bench_function(format!("verdict, {name}"), |b| {
            b.iter(|| queries.iter().map(|(pose, pair)| golden.verdict(black_box(pose), pair) as u64).sum::<u64>());
        });
        group.bench_function(format!("outcome, {name}"), |b| {
            b.iter(|| queries.iter().map(|(pose, pair)| golden.outcome(black_box(pose), pair).separated).max());
        });
    }
    group.finish();
}

fn exact(c: &mut Criterion) {
    let mut group = c.benchmark_group("points");
    group.throughput(Throughput::Elements(PAIRS as u64));
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let points: Vec<[[f64; 3]; 6]> = (0..PAIRS).map(|_| random_points(&mut rng)).collect();
    group.bench_function("exact::pair", |b| {
        b.iter(|| points.iter().map(|p| efsat::exact::pair(black_box(p)).unwrap() as u64).sum::<u64>());
    });
    let params = Params::default();
    group.bench_function("host::loose_pair", |b| {
        b.iter(|| {
            points.iter().filter(|p| matches!(loose_pair(black_box(p), &params).unwrap(), Host::Unit(_))).count()
        });
    });
    group.finish();
}

/// Pairs under one pose, in batches and one at a time, by method.
fn batches(c: &mut Criterion) {
    let mut group = c.benchmark_group("batches");
    group.throughput(Throughput::Elements(PAIRS as u64));
    let unit = |method, bound| Params { method, bound, ..Params::of(method) };
    let units = [
        ("axes", Params::default()),
        ("determinants", Params::of(Method::Determinants)),
        ("determinants, products", unit(Method::Determinants, Bound::Products)),
        ("exact", Params::of(Method::Exact)),
    ];
    for (unit, params) in units {
        for (transform, name) in [(Transform::On, "pose"), (Transform::Off, "no transform")] {
            let params = Params { transform, ..params.clone() };
            if params.validate().is_err() {
                continue;
            }
            let golden = Golden::new(&params);
            let mut rng = ChaCha8Rng::seed_from_u64(1);
            let mut pose = sample::random_pose(&mut rng, &params);
            pose.bypass = false;
            let pairs: Vec<Pair> = (0..PAIRS).map(|_| sample::random_pair_under(&mut rng, &params, &pose)).collect();
            let mut verdicts = vec![];
            group.bench_function(format!("verdicts, {unit}, {name}"), |b| {
                b.iter(|| {
                    verdicts.clear();
                    golden.verdicts(black_box(&pose), &pairs, &mut verdicts);
                });
            });
            group.bench_function(format!("outcome, {unit}, {name}"), |b| {
                b.iter(|| pairs.iter().map(|pair| golden.outcome(black_box(&pose), pair).separated).max());
            });
        }
    }
    group.finish();
}

criterion_group!(benches, verdict, batches, exact);
criterion_main!(benches);
