//! What a run is asked for and what comes out of it.

use super::Place;
use efsat_geometry::collide::hierarchy::Statistics;
use efsat_geometry::exact::Exact;
use efsat_unit::pair::Verdict;
use serde::Serialize;

/// Which pairs are remembered to be simulated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sampling {
    /// None.
    None,
    /// An even share of every verdict in every frame, so many in all; and of the possibly incorrect and close pairs so
    /// many at most.
    Some {
        /// Pairs of the stratified sample.
        stratified: usize,
        /// Possibly incorrect and close pairs.
        close: usize,
    },
    /// All; they are handed on with each frame.
    All,
}

/// How to run.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// Which pairs are remembered.
    pub sampling: Sampling,
    /// Whether pairs that the unit calls an intersection get the exact answer too.
    pub exact: bool,
    /// Names the sample.
    pub seed: u64,
}

/// What a frame came to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Counts {
    /// Pairs of objects that meet.
    pub meetings: u64,
    /// What it took to find the pairs, and how many there are.
    #[serde(flatten)]
    pub statistics: Statistics,
    /// Pairs that the unit separates.
    pub separate: u64,
    /// Pairs that intersect for certain.
    pub intersect: u64,
    /// Pairs that the unit leaves open.
    pub possibly_incorrect: u64,
    /// Pairs answered before the unit, because a triangle is degenerate.
    pub in_software: u64,
    /// Pairs that have a common point, in the end.
    pub touching: u64,
}

impl Counts {
    /// Adds other counts.
    pub fn add(&mut self, other: &Self) {
        self.meetings += other.meetings;
        self.statistics = self.statistics + other.statistics;
        self.separate += other.separate;
        self.intersect += other.intersect;
        self.possibly_incorrect += other.possibly_incorrect;
        self.in_software += other.in_software;
        self.touching += other.touching;
    }
}

/// What frames are counted by, for reports.
pub trait Counted: Copy + Serialize {
    /// What is counted, in the order of [`Counted::list`].
    const COLUMNS: [&'static str; 10];

    /// The counts.
    fn list(&self) -> [u64; 10];

    /// What a frame came to, in words.
    fn sentence(&self) -> String;
}

impl Counted for Counts {
    const COLUMNS: [&'static str; 10] = [
        "meetings",
        "overlap_tests",
        "transforms",
        "nodes_visited",
        "pairs_tested",
        "separate",
        "intersect",
        "possibly_incorrect",
        "in_software",
        "touching",
    ];

    fn list(&self) -> [u64; 10] {
        let Self { meetings, statistics: s, separate, intersect, possibly_incorrect, in_software, touching } = *self;
        [
            meetings,
            s.overlap_tests,
            s.transforms,
            s.nodes_visited,
            s.pairs_tested,
            separate,
            intersect,
            possibly_incorrect,
            in_software,
            touching,
        ]
    }

    fn sentence(&self) -> String {
        format!(
            "{} candidate pairs: the unit answers {} separate, {} intersect and {} possibly incorrect; {} have a degenerate \
             triangle and were answered in software. By the exact answers {} pairs touch.",
            self.statistics.pairs_tested,
            self.separate,
            self.intersect,
            self.possibly_incorrect,
            self.in_software,
            self.touching
        )
    }
}

/// A frame, counted.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row<C = Counts> {
    /// The number of the frame.
    pub frame: usize,
    /// What it is called.
    pub label: String,
    /// The distance of a tumbling turn.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub distance: Option<f64>,
    /// What it came to.
    #[serde(flatten)]
    pub counts: C,
}

/// A pair that touches, or that the unit leaves open.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Contact {
    /// Where.
    pub place: Place,
    /// What the unit said; none if the pair did not come to it.
    pub verdict: Option<Verdict>,
    /// The exact answer, where it was asked for: for pairs that are an intersection for certain only on request.
    pub exact: Option<Exact>,
}

impl Contact {
    /// Whether the pair has a common point.
    pub fn touches(&self) -> bool {
        self.exact.map_or(self.verdict == Some(Verdict::Intersect), |exact| exact != Exact::Separate)
    }
}

/// Counts that are only compared or checked.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sums {
    /// What pairs came to.
    pub counts: Counts,
    /// Pairs that the planned unit leaves open and the full one does not.
    pub less_definite: u64,
    /// Pairs that the two decide differently.
    pub contradictions: u64,
    /// Definite verdicts that the exact answer refutes, as far as it was asked for.
    pub wrong: u64,
    /// Possibly incorrect and close pairs.
    pub close: u64,
}

impl Sums {
    /// Adds other counts.
    pub fn add(&mut self, other: &Self) {
        self.counts.add(&other.counts);
        self.less_definite += other.less_definite;
        self.contradictions += other.contradictions;
        self.wrong += other.wrong;
        self.close += other.close;
    }
}

/// What all frames came to.
#[derive(Clone, Debug, Default)]
pub struct Total {
    /// The sums of all frames.
    pub sums: Sums,
    /// The pairs to simulate, in order.
    pub places: Vec<Place>,
    /// How many of the possibly incorrect and close pairs are among them.
    pub close_places: usize,
    /// The frame in which most pairs touch, the first of several.
    pub fullest: usize,
    /// How many do.
    pub most: u64,
}

impl Total {
    /// Adds a frame; frames come in order.
    pub(super) fn add(&mut self, frame: usize, sums: &Sums) {
        self.sums.add(sums);
        if sums.counts.touching > self.most {
            (self.fullest, self.most) = (frame, sums.counts.touching);
        }
    }
}
