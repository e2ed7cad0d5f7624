//! A scene through the collision engine: a query for each two objects that meet, answered by its reference model or by the whole
//! machine in Verilator.

use super::outcome::Counted;
use super::{Contact, Front, Place, Row};
use efsat_checks::cosim::CosimError;
use efsat_checks::cosim::engine::{Channel, Machine};
use efsat_engine::driver::{Contacts, Engine, Job, Objects, QueryOptions, StandIn};
use efsat_engine::words::{EngineReport, Sums};
use efsat_geometry::scene::{Frame, Meeting};
use rayon::prelude::*;
use serde::Serialize;

/// Frames of which queries are sent together.
const BATCH: usize = 64;

/// What a frame came to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct EngineCounts {
    /// What the queries came to: one for each two objects that meet.
    #[serde(flatten)]
    pub sums: Sums,
    /// Queries that were answered in software.
    pub in_software: u64,
    /// Pairs that have a common point, in the end.
    pub touching: u64,
    /// Clocks that the reports say, 0 of the reference model.
    pub clocks: u64,
}

impl EngineCounts {
    fn of(contacts: &Contacts) -> Self {
        let report = contacts.report.unwrap_or_default();
        Self {
            sums: (&report).into(),
            in_software: contacts.software.is_some().into(),
            touching: contacts.touching().count() as u64,
            clocks: report.clocks.into(),
        }
    }

    /// Adds other counts.
    pub fn add(&mut self, other: &Self) {
        self.sums += other.sums;
        self.in_software += other.in_software;
        self.touching += other.touching;
        self.clocks += other.clocks;
    }
}

impl Counted for EngineCounts {
    const COLUMNS: [&'static str; 10] = [
        "queries",
        "in_software",
        "expansions",
        "tests",
        "survivors",
        "leaf_pairs",
        "intersect",
        "possibly_incorrect",
        "touching",
        "clocks",
    ];

    fn list(&self) -> [u64; 10] {
        [
            self.sums.queries,
            self.in_software,
            self.sums.expansions,
            self.sums.tests,
            self.sums.survivors,
            self.sums.leaf_pairs,
            self.sums.intersect,
            self.sums.possibly_incorrect,
            self.touching,
            self.clocks,
        ]
    }

    fn sentence(&self) -> String {
        format!(
            "{} queries to the engine: {} pairs of triangles are left by the trees, {} intersect and {} are possibly incorrect; {} \
             queries were answered in software. By the exact answers {} pairs touch.",
            self.sums.queries,
            self.sums.leaf_pairs,
            self.sums.intersect,
            self.sums.possibly_incorrect,
            self.in_software,
            self.touching
        )
    }
}

/// Answers frames of a scene by an engine that holds its meshes, in the order of [`Scene::meshes`]. `visit` gets each frame with
/// the pairs that touch or are left open, until it fails.
///
/// # Errors
/// The first error of the engine or of `visit`.
///
/// [`Scene::meshes`]: efsat_geometry::scene::Scene::meshes
pub fn run<E: Engine, F: From<E::Error>>(
    front: &Front<'_>,
    objects: &Objects<'_>,
    frames: &[usize],
    engine: &mut E,
    mut visit: impl FnMut(Row<EngineCounts>, &[Contact]) -> Result<(), F>,
) -> Result<(), F> {
    let scene = front.scene();
    for batch in frames.chunks(BATCH) {
        let meetings: Vec<Meeting> = batch.iter().flat_map(|&frame| front.near.meetings(frame)).collect();
        // The memory stays as it is.
        let options = QueryOptions { keep_caches: true, ..QueryOptions::default() };
        let job = |meeting: &Meeting| -> Job<'_, '_> { objects.query(meeting.meshes, &meeting.pose, options) };
        let jobs: Vec<Job<'_, '_>> = meetings.par_iter().map(job).collect();
        let answers = objects.contacts(jobs, engine)?;
        let mut answers = meetings.iter().zip(answers).peekable();
        for &frame in batch {
            let Frame { label, distance, .. } = scene.frame(frame);
            let (mut counts, mut found) = (EngineCounts::default(), vec![]);
            while let Some((meeting, contacts)) = answers.next_if(|(meeting, _)| meeting.frame == frame) {
                counts.add(&EngineCounts::of(&contacts));
                found.extend(contacts.pairs.iter().map(|pair| {
                    let place = Place::new(meeting, pair.triangles.into());
                    Contact { place, verdict: pair.verdict, exact: Some(pair.exact) }
                }));
            }
            visit(Row { frame, label, distance, counts }, &found)?;
        }
    }
    Ok(())
}

/// An engine in Verilator, each of whose answers is compared with the reference model.
pub struct Simulation<'a, 'b> {
    machine: Machine,
    objects: &'b Objects<'a>,
    model: StandIn,
    /// Queries that were simulated.
    pub queries: u64,
    /// Those whose answers differ from the model's.
    pub mismatches: u64,
    /// The number of the first of them.
    pub first_mismatch: Option<u64>,
}

impl<'a, 'b> Simulation<'a, 'b> {
    /// A machine that gets objects into its memory, and their reference model.
    pub fn new(machine: Machine, objects: &'b Objects<'a>, model: StandIn) -> Self {
        Self { machine, objects, model, queries: 0, mismatches: 0, first_mismatch: None }
    }

    /// The simulator, in words.
    pub fn simulator(&self) -> &str {
        &self.machine.simulator
    }
}

impl Engine for Simulation<'_, '_> {
    type Error = CosimError;

    /// Each time from reset on, so that caches are empty at first.
    fn answer(&mut self, packets: &[&[u64]]) -> Result<Vec<Vec<u64>>, CosimError> {
        if packets.is_empty() {
            return Ok(vec![]);
        }
        let loads = self.objects.loads();
        let all: Vec<Vec<u64>> = loads.iter().cloned().chain(packets.iter().map(|packet| packet.to_vec())).collect();
        let replies = self.machine.exchange(self.objects.memory(), &all, &Channel::default())?;
        let answers: Vec<Vec<u64>> = replies.into_iter().skip(loads.len()).map(|packet| packet.words).collect();
        for (found, due) in answers.iter().zip(self.model.answer(packets)?) {
            if comparable(found) != comparable(&due) {
                self.mismatches += 1;
                self.first_mismatch.get_or_insert(self.queries);
            }
            self.queries += 1;
        }
        Ok(answers)
    }
}

/// What of an answer does not depend on time: its pairs in some order, and the report but for counts of clocks and memory.
fn comparable(words: &[u64]) -> Option<(Vec<u64>, [u64; 4])> {
    let (pairs, report) = words.split_last_chunk::<{ EngineReport::WORDS }>()?;
    let mut pairs = pairs.to_vec();
    pairs.sort_unstable();
    let [first, rest @ ..] = report;
    Some((pairs, [u64::from(*first as u32), rest[0], rest[1], rest[2]]))
}
