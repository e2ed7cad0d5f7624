//! A batch of pairs: what is sent, and what its answers mean.

use super::{Driver, DriverError, Transfer, UnitAnswer};
use crate::host::{Host, SceneHost, ScenePose};
use crate::pair::{Outcome, Pose, Verdict};
use crate::params::Method;
use crate::words::StreamReport;
use efsat_geometry::exact::Exact;
use efsat_geometry::finite::NotFinite;
use efsat_geometry::software::retest;
use rayon::prelude::*;

/// Two meshes of a driver's design.
#[derive(Debug)]
pub struct Meshes<'a> {
    driver: &'a Driver,
    host: SceneHost,
    a: &'a [[f64; 3]],
    b: &'a [[f64; 3]],
}

impl<'a> Meshes<'a> {
    pub(super) fn new(driver: &'a Driver, host: SceneHost, a: &'a [[f64; 3]], b: &'a [[f64; 3]]) -> Self {
        Self { driver, host, a, b }
    }

    /// The job of some pairs of triangles, given by vertex indices into A and B, with B at M * x + t in the frame of
    /// A; `m` is indexed `[row][column]`. Memory grows with the number of pairs: give them in batches.
    ///
    /// # Errors
    /// The first number of the pose that is not finite.
    ///
    /// # Panics
    /// If an index is outside its mesh.
    pub fn pose(
        &'a self,
        m: &'a [[f64; 3]; 3],
        t: &'a [f64; 3],
        pairs: &'a [([u32; 3], [u32; 3])],
    ) -> Result<Job<'a>, NotFinite> {
        let posed = self.host.pose(m, t)?;
        let normalised = pairs.iter().map(|&(a, b)| posed.pair(a, b));
        let (a, b) = (self.a, self.b);
        let geometry = Geometry::Posed { a, b, m, t, pairs, posed: Box::new(posed.clone()) };
        Ok(Job::new(self.driver, &posed.pose, normalised, geometry))
    }
}

/// The pairs as the user gave them, for the retest.
#[derive(Clone, Debug)]
pub(super) enum Geometry<'a> {
    Loose(&'a [[[f64; 3]; 6]]),
    Posed {
        a: &'a [[f64; 3]],
        b: &'a [[f64; 3]],
        m: &'a [[f64; 3]; 3],
        t: &'a [f64; 3],
        pairs: &'a [([u32; 3], [u32; 3])],
        /// Where the unit answers for other points.
        posed: Box<ScenePose<'a>>,
    },
}

impl Geometry<'_> {
    /// The exact answers of some pairs.
    fn retest(&self, open: &[usize]) -> Vec<Exact> {
        match self {
            Self::Loose(pairs) => {
                let points: Vec<[[f64; 3]; 6]> = open.iter().map(|&i| pairs[i]).collect();
                retest::retest_parallel(&points).expect("jobs are made of finite pairs")
            }
            Self::Posed { a, b, m, t, pairs, posed } => {
                let corners = |mesh: &[[f64; 3]], triangle: [u32; 3]| triangle.map(|i| mesh[i as usize]);
                let exact = |&i: &usize| match posed.snapped(pairs[i].0, pairs[i].1) {
                    Some(points) => retest::retest(&points),
                    None => retest::retest_posed(&corners(a, pairs[i].0), &corners(b, pairs[i].1), m, t),
                };
                let exact = |i: &usize| exact(i).expect("jobs are made of finite vertices and poses");
                open.par_iter().map(exact).collect()
            }
        }
    }
}

/// How the pairs of a job were decided.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Statistics {
    /// Decided by the host, never sent: outside the declared ranges and separate by their boxes, or beside the exact unit
    /// separate and of no fitting grid.
    pub host_separate: usize,
    /// Decided by the unit: separate.
    pub unit_separate: usize,
    /// Decided by the unit: intersect.
    pub unit_intersect: usize,
    /// Decided by neither: retested in software. Beside the exact unit these are pairs that do not fit, unless they are
    /// separate.
    pub retested: usize,
}

/// The answers of a job.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Results {
    /// The exact answer of every pair, in the order given.
    pub answers: Vec<Exact>,
    /// Who gave them.
    pub statistics: Statistics,
}

/// Pairs on their way through the unit.
#[derive(Debug)]
pub struct Job<'a> {
    driver: &'a Driver,
    geometry: Geometry<'a>,
    transfers: Vec<Transfer>,
    /// By pair: what the host says, none if it is sent.
    decided: Vec<Option<Verdict>>,
}

impl<'a> Job<'a> {
    pub(super) fn new(
        driver: &'a Driver,
        pose: &Pose,
        normalised: impl Iterator<Item = Host>,
        geometry: Geometry<'a>,
    ) -> Self {
        let (mut pairs, mut decided) = (vec![], vec![]);
        for host in normalised {
            match host {
                Host::Unit(pair) => {
                    pairs.push(pair);
                    decided.push(None);
                }
                Host::Decided(verdict) => decided.push(Some(verdict)),
            }
        }
        let mut transfers = vec![];
        if !pairs.is_empty() {
            let normal = "the host sends what is inside the declared ranges, under a pose that the design can do";
            transfers.extend(driver.pack_pose(pose).expect(normal));
            transfers.extend(driver.pack_pairs((0..).zip(&pairs)).expect(normal));
        }
        Self { driver, geometry, transfers, decided }
    }

    /// The words to send, in order: a packet with the pose (where the design has one) and a packet of pairs; none if
    /// the host has decided all pairs.
    pub fn transfers(&self) -> &[Transfer] {
        &self.transfers
    }

    /// Words that the unit sends back: the pose's report and a verdict per pair.
    pub fn answers_due(&self) -> usize {
        self.transfers.iter().filter(|transfer| transfer.last).count().saturating_sub(1) + self.sent()
    }

    pub(super) fn sent(&self) -> usize {
        self.decided.iter().filter(|decided| decided.is_none()).count()
    }

    /// The exact answers, from the words that came back. Pairs that are possibly incorrect are retested by all threads
    /// of the current pool.
    ///
    /// # Errors
    /// What came back does not answer what was sent; then nothing is known of any pair of the job.
    pub fn finish(self, answers: &[Transfer]) -> Result<Results, DriverError> {
        let mut outcomes = self.outcomes(answers)?.into_iter();
        // The exact unit says whether they cross. All eleven axes overlap strictly, or an edge passes through the inside of
        // a triangle: then the relative interiors meet in any case.
        let touch = |outcome: &Outcome| self.driver.params.method == Method::Exact && outcome.overlapping & 1 == 0;
        let mut statistics = Statistics::default();
        let mut open = vec![];
        let mut found = vec![Exact::Separate; self.decided.len()];
        for (i, decided) in self.decided.iter().enumerate() {
            if let Some(verdict) = decided {
                match verdict {
                    Verdict::Separate => statistics.host_separate += 1,
                    Verdict::Intersect | Verdict::PossiblyIncorrect => open.push(i),
                }
                continue;
            }
            let outcome = outcomes.next().expect("a verdict was due for every pair sent");
            match outcome.verdict {
                Verdict::Separate => statistics.unit_separate += 1,
                Verdict::Intersect => {
                    statistics.unit_intersect += 1;
                    found[i] = if touch(&outcome) { Exact::Touch } else { Exact::Intersect };
                }
                Verdict::PossiblyIncorrect => open.push(i),
            }
        }
        statistics.retested = open.len();
        for (i, exact) in open.iter().zip(self.geometry.retest(&open)) {
            found[*i] = exact;
        }
        Ok(Results { answers: found, statistics })
    }

    /// What the unit says of the pairs sent, if the answers are what is due.
    fn outcomes(&self, answers: &[Transfer]) -> Result<Vec<Outcome>, DriverError> {
        let (due, sent) = (self.answers_due(), self.sent());
        let tags = u64::MAX.checked_shr(64 - self.driver.format.tag_width).unwrap_or(0);
        let mut outcomes = vec![];
        for (at, transfer) in answers.iter().enumerate().take(due) {
            let answer =
                self.driver.unpack(transfer.data).ok_or(DriverError::Word { at, data: Box::new(transfer.data) })?;
            // The answer to the pose comes first, in a packet of its own.
            let pose = at < due - sent;
            let last = pose || at + 1 == due;
            match answer {
                UnitAnswer::Report(StreamReport::PoseTaken) if pose && transfer.last => {}
                UnitAnswer::Report(report) => return Err(DriverError::Reported { at, report }),
                UnitAnswer::Pair { tag, outcome }
                    if !pose && transfer.last == last && tag == outcomes.len() as u64 & tags =>
                {
                    outcomes.push(outcome);
                }
                UnitAnswer::Pair { .. } => return Err(DriverError::Order { at }),
            }
        }
        if answers.len() != due {
            return Err(DriverError::Count { expected: due, found: answers.len() });
        }
        Ok(outcomes)
    }
}
