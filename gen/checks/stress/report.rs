//! What a campaign counts.

use super::Family;
use super::fault::{Fault, Kind};
use efsat_unit::host::{Answer, Truths, Verdicts};

/// Faults that are kept to be shown; all are counted.
const SHOWN: usize = 5;

/// Counts of one family, or of all.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Cases by their exact answers.
    pub truths: Truths,
    /// Answers, over all ways to write the cases, all rungs of the ladder and all poses.
    pub answers: Verdicts,
    /// Answers that the host gave.
    pub host_decided: u64,
    /// Definite answers that are not the exact ones.
    pub wrong: u64,
    /// Cases, in one frame or posed, for which the exact formulations contradict each other.
    pub disagreements: u64,
    /// Answers that differ where the numbers are the same, or the same but for an exact scale or translation.
    pub unstable: u64,
}

impl Counts {
    /// Everything that must not be.
    pub fn faults(&self) -> u64 {
        self.wrong + self.disagreements + self.unstable
    }

    pub(super) fn count_answer(&mut self, answer: Answer) {
        self.answers.count(answer.verdict);
        self.host_decided += u64::from(answer.host_decided);
    }

    pub(super) fn count_fault(&mut self, kind: &Kind) {
        *match kind {
            Kind::Wrong { .. } => &mut self.wrong,
            Kind::Disagreement(_) => &mut self.disagreements,
            Kind::Unstable { .. } => &mut self.unstable,
        } += 1;
    }

    fn add(&mut self, other: &Self) {
        self.truths += other.truths;
        self.answers += other.answers;
        self.host_decided += other.host_decided;
        self.wrong += other.wrong;
        self.disagreements += other.disagreements;
        self.unstable += other.unstable;
    }
}

/// The result of a campaign; the same whatever the number of threads.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// The families that were asked, in their order, each with its counts.
    pub families: Vec<(&'static Family, Counts)>,
    /// The first fault of each of the first few cases that have one, in the order of cases.
    pub faults: Vec<Fault>,
    /// A hash of every answer of every case: two runs with equal digests gave equal answers.
    pub digest: u64,
}

impl Report {
    pub(super) fn new(families: &[&'static Family]) -> Self {
        let families = families.iter().map(|&family| (family, Counts::default())).collect();
        Self { families, faults: vec![], digest: 0 }
    }

    /// The counts of all families together.
    pub fn total(&self) -> Counts {
        let mut total = Counts::default();
        self.families.iter().for_each(|(_, counts)| total.add(counts));
        total
    }

    /// Both reports in one; they must be about the same families.
    pub(super) fn merged(mut self, other: Self) -> Self {
        for ((_, mine), (_, theirs)) in self.families.iter_mut().zip(&other.families) {
            mine.add(theirs);
        }
        self.digest = self.digest.wrapping_add(other.digest);
        other.faults.into_iter().for_each(|fault| self.keep(fault));
        self
    }

    /// Keeps a fault if it is among the first.
    pub(super) fn keep(&mut self, fault: Fault) {
        let place = |fault: &Fault| (fault.index, self.families.iter().position(|(f, _)| f.name == fault.family));
        let at = self.faults.partition_point(|kept| place(kept) < place(&fault));
        self.faults.insert(at, fault);
        self.faults.truncate(SHOWN);
    }
}
