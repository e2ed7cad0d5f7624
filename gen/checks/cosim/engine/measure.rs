//! What simulated queries answered and cost, against the reference model.

use super::{Reply, by_number};
use efsat_engine::artefact::EngineDesign;
use efsat_engine::host::{Image, memory};
use efsat_engine::model::{EngineOutcome, Model, Query};
use efsat_engine::words::{EngineAnswer, EngineReport, Reason, Sums};
use rayon::prelude::*;
use serde::Serialize;
use std::borrow::Borrow;

/// Sums over queries.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Measure {
    /// What the queries came to.
    #[serde(flatten)]
    pub sums: Sums,
    /// All clocks, from the first word of the first query to the last word of the last report.
    pub clocks: u64,
    /// Clocks in which a query ran, as the reports say.
    pub running: u64,
    /// Blocks asked for.
    pub blocks: u64,
    /// Blocks read from memory.
    pub blocks_read: u64,
    /// Triangles asked for.
    pub triangles: u64,
    /// Triangles read from memory.
    pub triangles_read: u64,
    /// Words read from memory.
    pub words: u64,
    /// Clocks in which the volume unit could have begun, and waited for blocks.
    pub memory_waits: u64,
    /// Clocks in which survivors waited for the queue of leaf pairs.
    pub queue_waits: u64,
    /// Clocks in which the volume unit was busy: those of its expansions; of several engines the mean.
    pub volume_busy: u64,
    /// The same of the triangle unit and its pairs.
    pub triangle_busy: u64,
}

impl Measure {
    /// Of the replies to some queries.
    pub fn of(design: &EngineDesign, replies: &[impl Borrow<Reply>]) -> Self {
        let mut measure = Self::default();
        for Reply { report, clocks, .. } in replies.iter().map(Borrow::borrow) {
            measure.sums += report.into();
            measure.clocks += clocks;
            measure.running += u64::from(report.clocks);
            measure.blocks += u64::from(report.blocks[0]);
            measure.blocks_read += u64::from(report.blocks[1]);
            measure.triangles += u64::from(report.triangles[0]);
            measure.triangles_read += u64::from(report.triangles[1]);
            measure.words += u64::from(report.words);
            measure.memory_waits += u64::from(report.memory_waits);
            measure.queue_waits += u64::from(report.queue_waits);
        }
        let engines = u64::from(design.params.engines);
        measure.volume_busy = measure.sums.expansions * design.volume.interval as u64 / engines;
        measure.triangle_busy = measure.sums.leaf_pairs * design.unit.interval as u64 / engines;
        measure
    }

    /// Mean clocks per query.
    pub fn clocks_per_query(&self) -> f64 {
        self.clocks as f64 / self.sums.queries as f64
    }
}

/// Compares replies with the reference model: what differs, for each query that is wrong. `done` is called after each query.
pub fn check(
    design: &EngineDesign,
    images: &[&Image],
    queries: &[Query],
    replies: &[Reply],
    done: impl Fn() + Sync,
) -> Vec<String> {
    let model = Model::new(&design.params, &design.unit.params).expect("parameters of a design are in their ranges");
    let (words, _) = memory(images);
    let (format, stack) = (model.format(), design.params.stack);
    if design.by_number {
        let packets = by_number(design, &words, queries);
        let compared = packets.par_iter().zip(replies).enumerate().map(|(number, (packet, reply))| {
            let due = model.run_numbers(&words, &packet.words(format));
            done();
            let order = (due.answers != reply.answers).then(|| "the answers, or their order".to_owned());
            difference(&due, reply).or(order).map(|difference| format!("query {number}: {difference}"))
        });
        return compared.flatten().collect();
    }
    let compared = queries.par_iter().zip(replies).enumerate().map(|(number, (query, reply))| {
        let run = |query: &Query| model.run(&words, &query.words(format));
        let due = run(query);
        let difference = match due.report.reason {
            Reason::Complete => difference(&due, reply),
            // Which pairs are found before the end depends on time.
            _ => {
                let all = run(&Query { first_contact: false, limit: 0, ..query.clone() });
                early_end(&due, &all.answers, reply)
            }
        };
        let full = u32::from(reply.report.stack) > stack;
        let difference = difference.or(full.then(|| format!("{} entries on the stack", reply.report.stack)));
        done();
        difference.map(|difference| format!("query {number}: {difference}"))
    });
    compared.flatten().collect()
}

/// What differs where everything has to be equal.
fn difference(due: &EngineOutcome, reply: &Reply) -> Option<String> {
    let counts = |report: &EngineReport| {
        [
            ("reason", report.reason as u32),
            ("number", report.number),
            ("expansions", report.expansions),
            ("tests", report.tests),
            ("survivors", report.survivors),
            ("leaf pairs", report.leaf_pairs),
            ("intersect", report.intersect),
            ("possibly incorrect", report.possibly_incorrect),
        ]
    };
    let mut pairs = counts(&due.report).into_iter().zip(counts(&reply.report));
    if let Some(((name, due), (_, found))) = pairs.find(|(due, found)| due != found) {
        return Some(format!("{name} {found}; expected {due}"));
    }
    let sorted = |answers: &[EngineAnswer]| {
        let mut answers = answers.to_vec();
        answers.sort_unstable_by_key(|answer| (answer.triangles, answer.verdict));
        answers
    };
    let (due, found) = (sorted(&due.answers), sorted(&reply.answers));
    let first = due.iter().zip(&found).find(|(due, found)| due != found);
    match first {
        Some((due, found)) => Some(format!("answer {found:?}; expected {due:?}")),
        None if due.len() != found.len() => Some(format!("{} answers; expected {}", found.len(), due.len())),
        None => None,
    }
}

/// What differs where a query ends early: the reason, or an answer that is none of `all`.
fn early_end(due: &EngineOutcome, all: &[EngineAnswer], reply: &Reply) -> Option<String> {
    let (found, expected) = (reply.report.reason, due.report.reason);
    if found != expected {
        return Some(format!("reason {found:?}; expected {expected:?}"));
    }
    if found == Reason::Contact && reply.report.intersect == 0 {
        return Some("no contact; expected one".to_owned());
    }
    let stranger = reply.answers.iter().find(|answer| !all.contains(answer))?;
    Some(format!("answer {stranger:?}; expected none but the {} of the whole query", all.len()))
}
