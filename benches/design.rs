//! Making and simulating the default design.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use efsat::artefact::{self, Stimulus};
use efsat::design::Design;
use efsat::evidence::cosim::{self, Options, Simulator};
use efsat::params::Params;
use std::hint::black_box;

/// Graph, proof of all ranges, schedule, modules and the text of every entity: to stay under 0.1 s.
fn generate(c: &mut Criterion) {
    c.bench_function("generate default design", |b| {
        b.iter(|| {
            let design = Design::new(black_box(&Params::default()), false).expect("the default is valid");
            artefact::vhdl_files(&design, &Default::default(), "bench").expect("legal names")
        });
    });
}

/// Vectors per second of the built-in simulator, second pass and comparison included.
fn simulate(c: &mut Criterion) {
    let params = Params::default();
    let design = Design::new(&params, false).expect("the default is valid");
    let stimulus = Stimulus::random(&params, 2000, 1);
    let options = Options { simulator: Simulator::Builtin, keep: None, wave: None, probe: false };
    let mut group = c.benchmark_group("built-in simulation");
    group.throughput(Throughput::Elements(2000)).sample_size(10);
    group.bench_function("2000 vectors", |b| {
        b.iter(|| cosim::run_design(&design, "bench", &stimulus, &options).expect("it runs"));
    });
    group.finish();
}

criterion_group!(benches, generate, simulate);
criterion_main!(benches);
