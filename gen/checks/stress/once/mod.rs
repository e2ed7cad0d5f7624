//! Very many pairs of the families, each asked once of every design, all answers compared with the exact ones: as many pairs as time
//! allows, where the campaign writes each in every way. The batched exact retest gives the truth; the two formulations of the oracle check it on every
//! [`SAMPLE`]th case of a family and wherever a definite answer contradicts it.

mod log;

pub use log::Log;

use super::Family;
use efsat_geometry::Points;
use efsat_geometry::exact::{self, linear_programme};
use efsat_geometry::software::retest::retest_batch;
use efsat_unit::host::{Host, Judged, Reference, Truths, Verdicts, loose_pair};
use efsat_unit::pair::{Pair, Verdict};
use efsat_unit::params::{Method, Params};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::collections::HashMap;

/// Why no number is refused.
const FINITE: &str = "the pairs are finite";

/// Cases of each family in a block, which is what a line of the log holds.
pub const BLOCK: u64 = 1 << 14;
/// One case of so many of a family is decided by the oracle too.
pub const SAMPLE: u64 = 1 << 10;
/// Cases that a thread takes at a time; their numbers stay in the second cache.
const SHARE: u64 = 1 << 9;
/// Faults of a block that are kept to be shown; all are counted.
const SHOWN: usize = 5;

/// What is asked: designs, families and the seed of their cases.
pub struct Once {
    seed: u64,
    families: Vec<&'static Family>,
    designs: Vec<Reference>,
}

/// The cases of a family, exactly and as each design answers them.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Tally {
    /// By their exact answers.
    #[serde(flatten)]
    pub truths: Truths,
    /// Pairs that the oracle decided too.
    pub checked: u64,
    /// Those for which oracle and retest do not agree.
    pub disagreements: u64,
    /// By design.
    pub designs: Vec<Judged>,
}

/// The result of a block.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Block {
    /// By family.
    pub families: Vec<Tally>,
    /// The first few faults, each with the command that shows it again.
    pub faults: Vec<String>,
}

impl Tally {
    /// Everything that must not be.
    pub fn faults(&self) -> u64 {
        self.disagreements + self.designs.iter().map(|answers| answers.wrong).sum::<u64>()
    }

    /// Adds the counts of another.
    pub fn add(&mut self, other: &Self) {
        self.truths += other.truths;
        self.checked += other.checked;
        self.disagreements += other.disagreements;
        self.designs.resize(other.designs.len(), Judged::default());
        self.designs.iter_mut().zip(&other.designs).for_each(|(mine, theirs)| *mine += *theirs);
    }
}

impl Block {
    /// Adds another, of the same families.
    pub fn add(&mut self, other: &Self) {
        self.families.resize(other.families.len(), Tally::default());
        self.families.iter_mut().zip(&other.families).for_each(|(mine, theirs)| mine.add(theirs));
        self.faults.extend(other.faults.iter().take(SHOWN - self.faults.len().min(SHOWN)).cloned());
    }

    /// All families together.
    pub fn total(&self) -> Tally {
        let mut total = Tally::default();
        self.families.iter().for_each(|tally| total.add(tally));
        total
    }
}

/// Pairs as a design reads them.
#[derive(Default)]
struct Read {
    pairs: Vec<Pair>,
    /// What the host has decided, by place; some pair is there. It is nothing but for the exact unit.
    decided: Vec<(usize, Verdict)>,
}

impl Read {
    fn new(pairs: &[Points], params: &Params) -> Self {
        let mut read = Self::default();
        for (i, points) in pairs.iter().enumerate() {
            read.pairs.push(match loose_pair(points, params).expect(FINITE) {
                Host::Unit(pair) => pair,
                Host::Decided(verdict) => {
                    read.decided.push((i, verdict));
                    Pair::default()
                }
            });
        }
        read
    }

    /// The verdicts of a design that reads pairs so, in their order.
    fn verdicts(&self, design: &Reference) -> Vec<Verdict> {
        let mut verdicts = Vec::with_capacity(self.pairs.len());
        design.golden.verdicts(&design.identity, &self.pairs, &mut verdicts);
        self.decided.iter().for_each(|(i, verdict)| verdicts[*i] = *verdict);
        verdicts
    }
}

/// Designs of which this is equal read the same numbers: a format, or for the exact unit a width.
fn reading(params: &Params) -> (i32, Option<u32>) {
    (params.input().fraction, (params.method == Method::Exact).then_some(params.grid_bits()))
}

impl Once {
    /// Prepares a test of validated designs.
    pub fn new(seed: u64, families: Vec<&'static Family>, designs: &[Params]) -> Self {
        Self { seed, families, designs: designs.iter().map(Reference::new).collect() }
    }

    /// What this test asks, in words: equal tests give equal results.
    pub fn question(&self) -> String {
        let families: Vec<&str> = self.families.iter().map(|family| family.name).collect();
        let designs = self.designs.iter().map(|design| design.params.command_line());
        let designs = designs.collect::<Vec<_>>().join("; ");
        format!("efsat {}, seed {}, {}: {designs}", env!("CARGO_PKG_VERSION"), self.seed, families.join(" "))
    }

    /// Whether counts can be those of a block of this test.
    pub fn fits(&self, block: &Block) -> bool {
        let sum = |counts: [u64; 3]| counts.into_iter().try_fold(0, u64::checked_add);
        let design = |judged: &Judged| {
            let Verdicts { separate, intersect, possibly_incorrect } = judged.verdicts;
            sum([separate, intersect, possibly_incorrect]) == Some(BLOCK) && judged.wrong <= BLOCK
        };
        let family = |tally: &Tally| {
            sum([tally.truths.separate, tally.truths.touch, tally.truths.intersect]) == Some(BLOCK)
                && tally.disagreements <= tally.checked
                && tally.checked <= BLOCK
                && tally.designs.len() == self.designs.len()
                && tally.designs.iter().all(design)
        };
        block.families.len() == self.families.len() && block.families.iter().all(family)
    }

    /// Asks block number `number`; all threads of the pool take part.
    pub fn block(&self, number: u64) -> Block {
        let first = number * BLOCK;
        let shares: Vec<(usize, u64)> =
            (0..self.families.len()).flat_map(|family| (0..BLOCK / SHARE).map(move |share| (family, share))).collect();
        let asked =
            |&(family, share): &(usize, u64)| (family, self.share(self.families[family], first + share * SHARE));
        // In order, so that the faults that are kept do not depend on the threads.
        let answers: Vec<(usize, (Tally, Vec<String>))> = shares.par_iter().map(asked).collect();
        let mut block = Block { families: vec![Tally::default(); self.families.len()], faults: vec![] };
        for (family, (tally, faults)) in answers {
            block.families[family].add(&tally);
            block.faults.extend(faults);
        }
        block.faults.truncate(SHOWN);
        block
    }

    /// The cases of a family from `first` on.
    fn share(&self, family: &Family, first: u64) -> (Tally, Vec<String>) {
        let pairs: Vec<Points> = (first..first + SHARE).map(|index| family.case(self.seed, index).0).collect();
        let mut truths = vec![];
        retest_batch(&pairs, &mut truths).expect(FINITE);
        let (mut tally, mut faults) = (Tally::default(), vec![]);
        truths.iter().for_each(|truth| tally.truths.count(*truth));
        let mut checked: Vec<usize> = (0..pairs.len()).filter(|i| (first + *i as u64).is_multiple_of(SAMPLE)).collect();
        let mut all: HashMap<(i32, Option<u32>), Read> = HashMap::new();
        for design in &self.designs {
            let read = all.entry(reading(&design.params)).or_insert_with(|| Read::new(&pairs, &design.params));
            let mut judged = Judged::default();
            for (i, (verdict, truth)) in read.verdicts(design).into_iter().zip(&truths).enumerate() {
                if judged.count(verdict, *truth) {
                    checked.push(i);
                    let index = first + i as u64;
                    let replay = format!("--seed {} --family {} --first {index} --pairs 1", self.seed, family.name);
                    let options = design.params.command_line();
                    let options = options.strip_prefix("efsat generate").unwrap_or(&options).trim();
                    faults.push(format!("{verdict}, exactly {truth}: efsat stress {options} {replay}"));
                }
            }
            tally.designs.push(judged);
        }
        checked.sort_unstable();
        checked.dedup();
        for i in checked {
            tally.checked += 1;
            let (facets, programme) =
                (exact::relation(&pairs[i]).expect(FINITE), linear_programme::relation(&pairs[i]).expect(FINITE));
            if facets != programme || facets.class != truths[i] {
                tally.disagreements += 1;
                let index = first + i as u64;
                faults.push(format!(
                    "retest {}, facets {facets}, linear programme {programme}: efsat stress --seed {} --family {} --first \
                     {index} --pairs 1",
                    truths[i], self.seed, family.name
                ));
            }
        }
        faults.truncate(SHOWN);
        (tally, faults)
    }
}

#[cfg(test)]
mod tests {
    use super::super::FAMILIES;
    use super::*;

    #[test]
    fn a_block_is_the_same_whatever_the_threads() {
        let once = Once::new(3, FAMILIES.iter().take(2).collect(), &[Params::default()]);
        let pool = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let (one, three) = (pool(1).install(|| once.block(1)), pool(3).install(|| once.block(1)));
        assert_eq!(one, three);
        assert_eq!(one.total().truths.total(), 2 * BLOCK);
        assert_eq!(one.total().checked, 2 * BLOCK / SAMPLE);
        assert_ne!(one, once.block(0));
    }

    /// A design that moves B a little answers for other pairs, which is noticed and can be shown again.
    #[test]
    fn wrong_answers_are_noticed() {
        let family = Family::by_name("vertex-on-face-sweep").unwrap();
        let mut once = Once::new(3, vec![family], &[Params::default()]);
        let pose = &mut once.designs[0].identity;
        (pose.bypass, pose.t[0].lo) = (false, 1 << 26);
        let (tally, faults) = once.share(family, 0);
        assert!(tally.designs[0].wrong > 0 && tally.disagreements == 0, "{tally:?}");
        assert!(faults[0].contains("--family vertex-on-face-sweep --first "), "{faults:?}");
    }
}
