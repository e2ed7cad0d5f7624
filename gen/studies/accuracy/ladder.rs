//! The software ladder: from binary32 to integers of any length, on the pairs of a campaign, in this process, by one
//! thread.

use super::pairs::Pairs;
use super::timing::{Timing, Yardstick, batch_ns, least_ns};
use efsat_geometry::Points;
use efsat_geometry::exact::{self, Exact};
use efsat_geometry::software::Test;
use efsat_geometry::software::interval_axes::{decide, decide_batch};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::hint::black_box;

/// Pairs that a rung is timed on at most, evenly spread.
const TIMED: usize = 1 << 15;

/// The rungs that answer every pair there can be, and never wrongly.
pub const EXACT: [&str; 4] = ["predicates", "retest", "retest, batch", "rational"];

/// One rung.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rung {
    /// Short name.
    pub name: String,
    /// What it is.
    pub about: String,
    /// Pairs with a common point that it calls separate.
    pub missed: u64,
    /// Pairs without one that it calls intersecting.
    pub invented: u64,
    /// Pairs that it leaves open.
    pub undecided: u64,
    /// Its time.
    pub timing: Timing,
}

impl Rung {
    /// Pairs without a right answer.
    pub fn open(&self) -> u64 {
        self.missed + self.invented + self.undecided
    }
}

/// The ladder on one scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ladder {
    /// Nanoseconds per pair of the yardstick, when the ladder was timed.
    pub yardstick_ns: f64,
    /// Pairs whose exact answer changes when B's transformed vertices are rounded to binary64.
    pub changed_by_rounding: u64,
    /// The rungs, roughly by effort.
    pub rungs: Vec<Rung>,
}

/// An answer, none if it is left open.
type Answer = Box<dyn Fn(&Points) -> Option<bool> + Sync>;

/// How a rung is timed.
type Batch = fn(&[Points]) -> f64;

fn one_by_one(points: &[Points], answer: &Answer) -> f64 {
    least_ns(points, |block| {
        black_box(block.iter().filter(|p| answer(black_box(p)) == Some(true)).count());
    })
}

fn filter_ns(points: &[Points]) -> f64 {
    let mut answers = vec![];
    least_ns(points, |block| {
        answers.resize(block.len(), None);
        decide_batch(black_box(block), &mut answers);
        black_box(&answers);
    })
}

/// Name, description, answer, and how it is timed if not one by one.
fn rungs() -> Vec<(&'static str, &'static str, Answer, Option<Batch>)> {
    let test = |test: Test| -> Answer { Box::new(move |points| test.intersect(points).ok()) };
    let filter = || -> Answer { Box::new(|points| decide(points).map(|answer| answer != Exact::Separate)) };
    vec![
        ("f32", "11 separating axes in binary32", test(Test::SeparatingAxes11F32), None),
        ("f64", "11 separating axes in binary64", test(Test::SeparatingAxes11F64), None),
        ("f64, 17 axes", "17 separating axes in binary64", test(Test::SeparatingAxes17F64), None),
        ("f64, epsilon", "Moeller 1997 with its epsilon of 1e-6, binary64", test(Test::MoellerEpsilon), None),
        ("f64, Moeller", "Moeller 1997 without an epsilon, binary64", test(Test::Moeller), None),
        ("f64, Held", "Held 1997, binary64", test(Test::Held), None),
        ("f64, Guigue", "Guigue and Devillers 2003, binary64", test(Test::GuigueDevillers), None),
        ("filter", "11 axes in certified intervals of binary64, one by one", filter(), None),
        ("filter, batch", "the same, several pairs at a time", filter(), Some(filter_ns)),
        ("predicates", "exact orientation predicates, adaptive", test(Test::RobbinsWhitesides), None),
        ("retest", "filter, then predicates, then integers: adaptive and exact", test(Test::Retest), None),
        ("retest, batch", "the same, several pairs at a time", test(Test::Retest), Some(batch_ns)),
        (
            "rational",
            "integers of any length",
            Box::new(|points| exact::pair(points).ok().map(|x| x != Exact::Separate)),
            None,
        ),
    ]
}

impl Ladder {
    /// Counts the errors of every rung on all pairs, and times it on some.
    pub fn climb(pairs: &Pairs, yardstick: &Yardstick) -> Self {
        let all: Vec<u32> = (0..pairs.len() as u32).collect();
        let places = Pairs::spread(&all, TIMED);
        let timed: Vec<Points> = places.iter().map(|&place| pairs.points(place as usize)).collect();
        let apart = |place: usize| pairs.relation(place).class == Exact::Separate;
        let changed =
            |&place: &u32| (exact::pair(&pairs.points(place as usize)) == Ok(Exact::Separate)) != apart(place as usize);
        let rung = |(name, about, answer, batch): (&str, &str, Answer, Option<Batch>)| {
            let one = |&place: &u32| match answer(&pairs.points(place as usize)) {
                None => [0, 0, 1],
                Some(contact) if contact == apart(place as usize) => [u64::from(!contact), u64::from(contact), 0],
                Some(_) => [0; 3],
            };
            let sum = |x: [u64; 3], y: [u64; 3]| [0, 1, 2].map(|i| x[i] + y[i]);
            let [missed, invented, undecided] = all.par_iter().map(one).reduce(|| [0; 3], sum);
            let timing = yardstick.time(timed.len(), || match batch {
                Some(batch) => batch(&timed),
                None => one_by_one(&timed, &answer),
            });
            Rung { name: name.to_owned(), about: about.to_owned(), missed, invented, undecided, timing }
        };
        let changed_by_rounding = all.par_iter().filter(|place| changed(place)).count() as u64;
        let rungs = rungs().into_iter().map(rung).collect();
        Self { yardstick_ns: yardstick.ns(), changed_by_rounding, rungs }
    }

    /// The rung of a name.
    pub fn rung(&self, name: &str) -> Option<&Rung> {
        self.rungs.iter().find(|rung| rung.name == name)
    }
}
