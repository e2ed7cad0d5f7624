//! The engine without time: from the words of a query and a memory to the words of the answer.

use super::{Block, Frame, Link, Query, Side, Triangle, overlap};
use crate::format::EngineFormat;
use crate::params::EngineParams;
use crate::words::{EngineAnswer, EngineReport, Reason};
use efsat_unit::golden::Golden;
use efsat_unit::pair::{Pair, Pose, Verdict};
use efsat_unit::params::{ParamError, Params};
use std::collections::VecDeque;

/// The reference model of an engine and the unit behind it.
#[derive(Clone, Debug)]
pub struct Model {
    format: EngineFormat,
    /// Places of the stack, and how far it is filled by more than one pair in flight.
    stack: usize,
    wide: usize,
    in_flight: usize,
    unit: Golden,
}

/// What an engine answers. Of the report the counts of clocks and of memory are zero, which depend on time.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EngineOutcome {
    /// Pairs of triangles, in no order that another engine has to keep.
    pub answers: Vec<EngineAnswer>,
    /// The report.
    pub report: EngineReport,
}

/// Two blocks that are opened together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Opened {
    /// Of A and of B.
    pub blocks: [Block; 2],
    /// Which of their children take part: left, right.
    pub take: [[bool; 2]; 2],
}

/// What a query gives to the two units, in the order of [`Model::run`].
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Visits {
    /// For the volume unit.
    pub opened: Vec<Opened>,
    /// The numbers of their blocks in the images.
    pub nodes: Vec<[u32; 2]>,
    /// For the triangle unit, unless the query is answered without it.
    pub pairs: Vec<Pair>,
    /// The numbers of their triangles in the images, also without a test.
    pub numbers: Vec<[u32; 2]>,
}

/// A node of a tree as the stack knows it: a block, and which of its children are meant.
type Node = (u32, Option<usize>);

/// A pair of nodes on the stack.
#[derive(Clone, Copy, Debug)]
struct Entry {
    nodes: [Node; 2],
    level: u32,
}

impl Model {
    /// The model of parameters.
    ///
    /// # Errors
    /// If they are outside their ranges.
    pub fn new(engine: &EngineParams, unit: &Params) -> Result<Self, ParamError> {
        Ok(Self {
            format: engine.format(unit)?,
            stack: engine.stack as usize,
            wide: engine.wide_limit() as usize,
            in_flight: engine.in_flight as usize,
            unit: Golden::new(unit),
        })
    }

    /// The formats.
    pub fn format(&self) -> &EngineFormat {
        &self.format
    }

    /// Answers a packet over a memory of 64-bit words, one pair of nodes in flight at a time: strictly depth first.
    pub fn run(&self, memory: &[u64], packet: &[u64]) -> EngineOutcome {
        self.run_paced(memory, packet, || false)
    }

    /// Answers a packet; where a pair of nodes may be issued and another is in flight, `issue` says which comes first. Without
    /// a fault, and if all contacts are asked for, answers and counts do not depend on it.
    ///
    /// # Panics
    /// If the stack overflows, which is proved impossible.
    pub fn run_paced(&self, memory: &[u64], packet: &[u64], issue: impl FnMut() -> bool) -> EngineOutcome {
        self.visited(memory, packet, issue, None)
    }

    /// Answers a packet as [`Model::run`] does, and tells what the units were given.
    pub fn visits(&self, memory: &[u64], packet: &[u64]) -> (EngineOutcome, Visits) {
        let mut visits = Visits::default();
        let outcome = self.visited(memory, packet, || false, Some(&mut visits));
        (outcome, visits)
    }

    /// Whether the ranges of both objects are in memory.
    pub(super) fn ranges(&self, memory: &[u64], sides: &[Side; 2]) -> Result<(), Reason> {
        let (block, triangle) = (self.format.block(), self.format.triangle());
        let end = |at: u32, count: u32, stride: u32| 64 * u64::from(at) + u64::from(count) * u64::from(stride);
        let ends = sides.iter().flat_map(|side| {
            [end(side.blocks_at, side.blocks, block.stride), end(side.triangles_at, side.triangles, triangle.stride)]
        });
        match ends.into_iter().all(|end| end <= 8 * memory.len() as u64) {
            true => Ok(()),
            false => Err(Reason::Memory),
        }
    }

    /// The triangles of a pair of numbers.
    pub(super) fn triangles(&self, memory: &[u64], sides: &[Side; 2], pair: [u32; 2]) -> [Triangle; 2] {
        let stride = self.format.triangle().stride;
        let read = |i: usize| Triangle::of(record(memory, sides[i].triangles_at, pair[i], stride), &self.format);
        [0, 1].map(read)
    }

    /// The verdicts of the unit.
    pub(super) fn verdicts(&self, pose: &Pose, records: &[[Triangle; 2]]) -> (Vec<Pair>, Vec<Verdict>) {
        let pairs: Vec<Pair> = records.iter().map(|[a, b]| Pair { a: a.corners, b: b.corners }).collect();
        let mut verdicts = vec![];
        self.unit.verdicts(pose, &pairs, &mut verdicts);
        (pairs, verdicts)
    }

    fn visited(
        &self,
        memory: &[u64],
        packet: &[u64],
        issue: impl FnMut() -> bool,
        visits: Option<&mut Visits>,
    ) -> EngineOutcome {
        match Query::of(packet, &self.format) {
            Err(reason) => {
                EngineOutcome { answers: vec![], report: EngineReport { reason, ..EngineReport::default() } }
            }
            Ok(query) => {
                let report = EngineReport { number: query.number, ..EngineReport::default() };
                let frame = query.frame(&self.format);
                let mut run = Run {
                    model: self,
                    memory,
                    query: &query,
                    frame,
                    stack: vec![],
                    leaves: vec![],
                    answers: vec![],
                    report,
                    visits,
                };
                let ended = run.traverse(issue);
                // What was found before a fault is answered; after the first contact nothing is.
                let tested = if ended == Err(Reason::Contact) { Ok(()) } else { run.test() };
                run.report.reason = ended.and(tested).err().unwrap_or_default();
                EngineOutcome { answers: run.answers, report: run.report }
            }
        }
    }
}

/// The words from an address in units of 64 bytes and a number of records of so many bytes.
fn record(memory: &[u64], at: u32, number: u32, stride: u32) -> &[u64] {
    let start = 8 * at as usize + number as usize * stride as usize / 8;
    &memory[start..][..stride as usize / 8]
}

/// A query at work. Everything that ends it early is an error with the reason.
struct Run<'a> {
    model: &'a Model,
    memory: &'a [u64],
    query: &'a Query,
    frame: Frame,
    stack: Vec<Entry>,
    /// Pairs of triangles that are not tested yet.
    leaves: Vec<[u32; 2]>,
    answers: Vec<EngineAnswer>,
    report: EngineReport,
    visits: Option<&'a mut Visits>,
}

fn is_inner(link: Link) -> bool {
    matches!(link, Link::Inner(_))
}

/// Pairs of triangles that are tested together.
const BATCH: usize = 1024;

impl Run<'_> {
    fn traverse(&mut self, mut issue: impl FnMut() -> bool) -> Result<(), Reason> {
        self.model.ranges(self.memory, &self.query.sides)?;
        if self.query.sides.iter().any(|side| side.blocks == 0) {
            return Err(Reason::BadTree);
        }
        let mut flying = VecDeque::new();
        self.push(Entry { nodes: [(0, None); 2], level: 0 });
        loop {
            let (used, wide) = (self.stack.len(), self.model.wide);
            let may_issue = used > 0
                && flying.len() < self.model.in_flight
                && (flying.is_empty() || used - 1 + 4 * (flying.len() + 1) <= wide);
            if may_issue && (flying.is_empty() || issue()) {
                if self.query.limit > 0 && self.report.expansions == self.query.limit {
                    return Err(Reason::Limit);
                }
                self.report.expansions += 1;
                flying.extend(self.stack.pop());
                continue;
            }
            let Some(entry) = flying.pop_front() else { return Ok(()) };
            self.expand(entry)?;
        }
    }

    fn push(&mut self, entry: Entry) {
        self.stack.push(entry);
        assert!(self.stack.len() <= self.model.stack, "the stack overflows");
        self.report.stack = self.report.stack.max(self.stack.len() as u16);
    }

    /// Opens a pair of nodes. The survivors are pushed so that those of both left children are popped first.
    fn expand(&mut self, Entry { nodes, level }: Entry) -> Result<(), Reason> {
        let format = &self.model.format;
        let mut blocks = vec![];
        for (side, (number, _)) in self.query.sides.iter().zip(nodes) {
            let words = record(self.memory, side.blocks_at, number, format.block().stride);
            blocks.push(Block::of(words, format).map_err(|_| Reason::BadTree)?);
        }
        let chosen = |side: usize| {
            let links = blocks[side].links;
            let wanted = move |child: &usize| nodes[side].1.is_none_or(|only| only == *child);
            (0..2).rev().filter(wanted).filter(move |&child| links[child] != Link::None)
        };
        if let Some(visits) = &mut self.visits {
            let take = [0, 1].map(|side| [0, 1].map(|child| chosen(side).any(|other| other == child)));
            visits.nodes.push(nodes.map(|(number, _)| number));
            visits.opened.push(Opened { blocks: [blocks[0].clone(), blocks[1].clone()], take });
        }
        let mut survivors = [[false; 2]; 2];
        for p in chosen(0) {
            for q in chosen(1) {
                self.report.tests += 1;
                if overlap(&self.frame, [&blocks[0], &blocks[1]], [p, q], format) {
                    self.report.survivors += 1;
                    survivors[p][q] = true;
                }
            }
        }
        let links = [0, 1].map(|side| blocks[side].links);
        let leaves = links.map(|links| links.iter().all(|link| matches!(link, Link::Leaf(_))));
        for p in [1, 0] {
            for q in [1, 0] {
                // Two leaves that both meet the same inner node are opened against it together.
                let both = [
                    leaves[0] && !leaves[1] && is_inner(links[1][q]) && survivors[0][q] && survivors[1][q],
                    leaves[1] && !leaves[0] && is_inner(links[0][p]) && survivors[p][0] && survivors[p][1],
                ];
                if survivors[p][q] && !(both[0] && p == 0) && !(both[1] && q == 0) {
                    self.survive(nodes, [p, q], [links[0][p], links[1][q]], both, level)?;
                }
            }
        }
        Ok(())
    }

    /// Sends a pair of triangles to the test, and pushes any other pair of nodes.
    /// `both` says for each side whether its two leaves are meant.
    fn survive(
        &mut self,
        nodes: [Node; 2],
        children: [usize; 2],
        links: [Link; 2],
        both: [bool; 2],
        level: u32,
    ) -> Result<(), Reason> {
        let sides = &self.query.sides;
        if let [Link::Leaf(a), Link::Leaf(b)] = links {
            if a >= sides[0].triangles || b >= sides[1].triangles {
                return Err(Reason::BadTree);
            }
            self.report.leaf_pairs += 1;
            self.leaves.push([a, b]);
            if self.leaves.len() == BATCH || self.query.first_contact {
                self.test()?;
            }
            return Ok(());
        }
        if level == self.model.format.tree_height {
            return Err(Reason::BadTree);
        }
        let mut next = nodes;
        for side in 0..2 {
            next[side] = match links[side] {
                Link::Inner(number) if number <= nodes[side].0 || number >= sides[side].blocks => {
                    return Err(Reason::BadTree);
                }
                Link::Inner(number) => (number, None),
                // The volume of a leaf is in the block of its parent.
                Link::Leaf(_) | Link::None => (nodes[side].0, (!both[side]).then_some(children[side])),
            };
        }
        self.push(Entry { nodes: next, level: level + 1 });
        Ok(())
    }

    /// Tests the pairs of triangles that wait.
    fn test(&mut self) -> Result<(), Reason> {
        let leaves = std::mem::take(&mut self.leaves);
        let records: Vec<[Triangle; 2]> =
            leaves.iter().map(|&pair| self.model.triangles(self.memory, &self.query.sides, pair)).collect();
        let mut verdicts = vec![];
        if let Some(visits) = &mut self.visits {
            visits.numbers.extend(&leaves);
        }
        if self.query.leaf_pairs {
            verdicts.resize(records.len(), Verdict::PossiblyIncorrect);
        } else {
            let pairs;
            (pairs, verdicts) = self.model.verdicts(&self.query.pose, &records);
            if let Some(visits) = &mut self.visits {
                visits.pairs.extend(pairs);
            }
        }
        for (verdict, [a, b]) in verdicts.into_iter().zip(records) {
            match verdict {
                Verdict::Separate if !self.query.all_pairs => continue,
                Verdict::Separate => {}
                Verdict::Intersect => self.report.intersect += 1,
                Verdict::PossiblyIncorrect => self.report.possibly_incorrect += 1,
            }
            self.answers.push(EngineAnswer { verdict: verdict as u8, triangles: [a.number, b.number] });
            if self.query.first_contact && verdict == Verdict::Intersect {
                return Err(Reason::Contact);
            }
        }
        Ok(())
    }
}
