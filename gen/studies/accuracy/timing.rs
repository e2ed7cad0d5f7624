//! How long something takes a pair, as a multiple of a yardstick timed right beside it.
//!
//! A machine that is busy, hot or another one changes both alike; so points that were timed hours apart or on different
//! machines can be compared, and become nanoseconds by the one yardstick of the ladder.

use efsat_geometry::Points;
use efsat_geometry::software::retest::retest_batch;
use serde::{Deserialize, Serialize};
use std::hint::black_box;
use std::time::{Duration, Instant};

/// Pairs of the yardstick.
const PAIRS: usize = 4096;
/// A measurement goes on until so long has passed ...
const LEAST_TIME: Duration = Duration::from_millis(8);
/// ... and so many passes are done, unless it takes longer than this.
const PASSES: u32 = 7;
const MOST_TIME: Duration = Duration::from_millis(400);
/// Pairs between two looks at the clock: long enough that its own time does not count, and short enough that most are
/// not interrupted.
const BLOCK: usize = 512;

/// A time a pair.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Timing {
    /// Pairs that it was measured on.
    pub timed_pairs: usize,
    /// Multiple of the yardstick.
    pub yardsticks: f64,
    /// Nanoseconds, at the time and on the machine of the measurement.
    pub measured_ns: f64,
}

/// The exact retest of an even sample of all pairs, by one thread.
pub struct Yardstick {
    pairs: Vec<Points>,
}

impl Yardstick {
    /// Takes pairs evenly spread over those of a campaign.
    pub fn new(pairs: &super::Pairs) -> Self {
        let all: Vec<u32> = (0..pairs.len() as u32).collect();
        let places = super::Pairs::spread(&all, PAIRS);
        Self { pairs: places.iter().map(|&place| pairs.points(place as usize)).collect() }
    }

    /// Nanoseconds per pair.
    pub fn ns(&self) -> f64 {
        batch_ns(&self.pairs)
    }

    /// The time that `measure` gives, beside the yardstick's before and after it.
    pub fn time(&self, timed_pairs: usize, measure: impl Fn() -> f64) -> Timing {
        let before = self.ns();
        let measured_ns = measure();
        let after = self.ns();
        Timing { timed_pairs, yardsticks: 2.0 * measured_ns / (before + after), measured_ns }
    }
}

/// Nanoseconds per pair of what `pass` does with pairs: of every block of pairs the least time of several passes.
pub(super) fn least_ns(pairs: &[Points], mut pass: impl FnMut(&[Points])) -> f64 {
    let repeats = BLOCK.div_ceil(pairs.len().max(1));
    let mut least = vec![Duration::MAX; pairs.len().div_ceil(BLOCK)];
    let begin = Instant::now();
    let mut passes = 0;
    while (begin.elapsed() < LEAST_TIME || passes < PASSES) && (passes == 0 || begin.elapsed() < MOST_TIME) {
        for (block, least) in pairs.chunks(BLOCK).zip(&mut least) {
            let start = Instant::now();
            (0..repeats).for_each(|_| pass(block));
            *least = start.elapsed().min(*least);
        }
        passes += 1;
    }
    let sum: Duration = least.iter().sum();
    sum.as_nanos() as f64 / (repeats * pairs.len().max(1)) as f64
}

/// Nanoseconds per pair of the exact retest in batches, by one thread.
pub(super) fn batch_ns(pairs: &[Points]) -> f64 {
    let mut answers = Vec::with_capacity(BLOCK);
    least_ns(pairs, |block| {
        answers.clear();
        // What is not finite is refused, and would be in each round.
        let done = retest_batch(black_box(block), &mut answers).is_ok();
        black_box((done, &answers));
    })
}
