//! What simulated queries answered and cost, against the reference model.

use super::Reply;
use efsat_engine::artefact::EngineDesign;
use efsat_engine::host::{Image, memory};
use efsat_engine::model::{Model, Outcome, Query};
use efsat_engine::words::{Answer, EngineReport, Reason};
use rayon::prelude::*;
use serde::Serialize;
use std::borrow::Borrow;

/// Sums over queries.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Measure {
    /// How many queries there were.
    pub queries: u64,
    /// All clocks, from the first word of the first query to the last word of the last report.
    pub clocks: u64,
    /// Clocks in which a query ran, as the reports say.
    pub running: u64,
    /// Pairs of nodes opened.
    pub expansions: u64,
    /// Pairs of volumes tested.
    pub tests: u64,
    /// Pairs of triangles that the unit tested.
    pub leaf_pairs: u64,
    /// Pairs of triangles that intersect.
    pub intersect: u64,
    /// Pairs of triangles that are possibly incorrect.
    pub possibly_incorrect: u64,
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
    /// The greatest stack of all queries.
    pub greatest_stack: u64,
    /// Clocks in which the volume unit was busy: those of its expansions.
    pub volume_busy: u64,
    /// Clocks in which the triangle unit was busy: those of its pairs.
    pub triangle_busy: u64,
}

impl Measure {
    /// Of the replies to some queries.
    pub fn of(design: &EngineDesign, replies: &[impl Borrow<Reply>]) -> Self {
        let sum = |of: fn(&Reply) -> u64| replies.iter().map(|reply| of(reply.borrow())).sum::<u64>();
        let mut measure = Self {
            queries: replies.len() as u64,
            clocks: sum(|reply| reply.clocks),
            running: sum(|reply| reply.report.clocks.into()),
            expansions: sum(|reply| reply.report.expansions.into()),
            tests: sum(|reply| reply.report.tests.into()),
            leaf_pairs: sum(|reply| reply.report.leaf_pairs.into()),
            intersect: sum(|reply| reply.report.intersect.into()),
            possibly_incorrect: sum(|reply| reply.report.possibly_incorrect.into()),
            blocks: sum(|reply| reply.report.blocks[0].into()),
            blocks_read: sum(|reply| reply.report.blocks[1].into()),
            triangles: sum(|reply| reply.report.triangles[0].into()),
            triangles_read: sum(|reply| reply.report.triangles[1].into()),
            words: sum(|reply| reply.report.words.into()),
            memory_waits: sum(|reply| reply.report.memory_waits.into()),
            queue_waits: sum(|reply| reply.report.queue_waits.into()),
            greatest_stack: replies.iter().map(|reply| reply.borrow().report.stack.into()).max().unwrap_or(0),
            ..Self::default()
        };
        measure.volume_busy = measure.expansions * design.volume.interval as u64;
        measure.triangle_busy = measure.leaf_pairs * design.unit.interval as u64;
        measure
    }

    /// Mean clocks per query.
    pub fn clocks_per_query(&self) -> f64 {
        self.clocks as f64 / self.queries as f64
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
fn difference(due: &Outcome, reply: &Reply) -> Option<String> {
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
    let sorted = |answers: &[Answer]| {
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
fn early_end(due: &Outcome, all: &[Answer], reply: &Reply) -> Option<String> {
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
