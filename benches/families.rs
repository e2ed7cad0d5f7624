//! The exact software tests on a file of pairs: how many intersect by the oracle, and nanoseconds per pair of the retest
//! in batches and of the scalar retest, the best of five rounds on one core. `scripts/cgal` prints them beside CGAL's.

use efsat::exact::{self, Exact};
use efsat::pair_file;
use efsat::software::retest::{retest, retest_batch};
use std::hint::black_box;
use std::time::Instant;

fn best(pairs: usize, mut round: impl FnMut()) -> f64 {
    let rounds = (0..5).map(|_| {
        let start = Instant::now();
        round();
        start.elapsed().as_nanos() as f64
    });
    rounds.fold(f64::INFINITY, f64::min) / pairs as f64
}

fn main() {
    let Some(file) = std::env::args().skip(1).find(|argument| argument.ends_with(".f64")) else { return };
    let pairs = pair_file::read(&file).unwrap_or_else(|error| panic!("{error}"));
    let intersecting = pairs.iter().filter(|p| exact::pair(p).unwrap() != Exact::Separate).count();
    let mut answers = Vec::with_capacity(pairs.len());
    let batch = best(pairs.len(), || {
        answers.clear();
        retest_batch(black_box(&pairs), &mut answers).unwrap();
    });
    let single = best(pairs.len(), || {
        black_box(pairs.iter().filter(|p| retest(black_box(p)).unwrap() != Exact::Separate).count());
    });
    println!("{intersecting} {batch:.0} {single:.0}");
}
