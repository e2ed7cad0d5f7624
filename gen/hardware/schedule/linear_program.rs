//! The schedule of a block as a linear program: difference constraints between start clocks, and register bits.
//!
//! One integer per node: its start. A value that follows the phases is carried by one register per clock to its last use; a
//! per-pair value is captured again once an interval after its window has closed. But for the whole number of captures the
//! matrix is totally unimodular, and the best starts are found by cuts: from the earliest schedule, the group of nodes
//! whose common move by one clock saves most is a minimum cut, and where no group saves anything the schedule is optimal
//! (the cost is L-natural-convex).

use super::cut::{Network, UNLIMITED};
use std::collections::BTreeMap;
use std::fmt::Write;

/// A clock: the start of a variable plus an offset. Variable 0 stands for the ports and starts in clock 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Event {
    /// Variable.
    pub variable: usize,
    /// Clocks after its start.
    pub offset: i32,
}

impl Event {
    /// The event in a schedule.
    pub fn clock(self, starts: &[i32]) -> i32 {
        starts[self.variable] + self.offset
    }

    /// The event some clocks later.
    pub fn later(self, clocks: i32) -> Self {
        Self { offset: self.offset + clocks, ..self }
    }
}

/// The least schedule from `starts` on that keeps to the constraints, if there is one.
fn least(constraints: &BTreeMap<(usize, usize), i32>, mut starts: Vec<i32>) -> Option<Vec<i32>> {
    for _ in 0..=starts.len() {
        let mut moved = false;
        for ((earlier, later), clocks) in constraints {
            let bound = starts[*earlier] + clocks;
            if starts[*later] < bound {
                if *later == 0 {
                    return None;
                }
                (starts[*later], moved) = (bound, true);
            }
        }
        if !moved {
            return Some(starts);
        }
    }
    None
}

fn order(constraints: &mut BTreeMap<(usize, usize), i32>, earlier: Event, later: Event) {
    if earlier.variable != later.variable {
        let clocks = constraints.entry((earlier.variable, later.variable)).or_insert(i32::MIN);
        *clocks = (*clocks).max(earlier.offset - later.offset);
    }
}

/// A value of every phase and its uses.
#[derive(Clone, Debug)]
pub struct Stream {
    /// Name of the node.
    pub name: String,
    /// Bits.
    pub bits: u32,
    /// When it is there.
    pub from: Event,
    /// When it is used.
    pub uses: Vec<Event>,
}

/// A per-pair value and its uses.
#[derive(Clone, Debug)]
pub struct Held {
    /// Name of the node.
    pub name: String,
    /// Bits.
    pub bits: u32,
    /// It is there from the last of the first events until before the first of the second ones.
    pub windows: Vec<(Event, Event)>,
    /// When it is used.
    pub uses: Vec<Reading>,
}

/// A use of a per-pair value over some clocks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reading {
    /// The first clock.
    pub first: Event,
    /// The last clock.
    pub last: Event,
    /// Whether the value is captured even where its window is open, because it arrives too late in the clock.
    pub captured: bool,
}

/// The program of one block.
#[derive(Clone, Debug)]
pub struct LinearProgram {
    /// Names of the variables.
    pub variables: Vec<String>,
    /// Clocks between pairs.
    pub interval: i32,
    /// Two variables, and by how many clocks at least the second starts after the first.
    pub constraints: BTreeMap<(usize, usize), i32>,
    /// Values of every phase.
    pub streams: Vec<Stream>,
    /// Per-pair values.
    pub held: Vec<Held>,
    /// Register bits that no schedule changes: registers behind operations and between the two clocks of a choice, first
    /// captures, running state.
    pub fixed: u64,
}

impl Stream {
    /// Clocks by which the value is carried.
    pub(crate) fn carried(&self, starts: &[i32]) -> i32 {
        self.uses.iter().map(|u| u.clock(starts)).max().map_or(0, |last| (last - self.from.clock(starts)).max(0))
    }
}

impl LinearProgram {
    /// Captures of a per-pair value for one use.
    fn captures(&self, held: &Held, reading: &Reading, starts: &[i32]) -> i32 {
        let until = held.windows.iter().map(|w| w.1.clock(starts)).min().unwrap_or(i32::MAX);
        let missing = reading.last.clock(starts).saturating_add(1).saturating_sub(until);
        // Rounded up.
        (missing.saturating_add(self.interval - 1)).div_euclid(self.interval).max(i32::from(reading.captured))
    }

    /// Captures of a per-pair value for all of its uses.
    pub(crate) fn most_captures(&self, held: &Held, starts: &[i32]) -> i32 {
        held.uses.iter().map(|u| self.captures(held, u, starts)).max().unwrap_or(0)
    }

    /// Demands that one event is not before another.
    pub fn order(&mut self, earlier: Event, later: Event) {
        order(&mut self.constraints, earlier, later);
    }

    /// Register bits of a schedule.
    pub fn cost(&self, starts: &[i32]) -> u64 {
        let streams = self.streams.iter().map(|s| u64::from(s.bits) * s.carried(starts) as u64);
        let held = self.held.iter().map(|h| u64::from(h.bits) * self.most_captures(h, starts) as u64);
        self.fixed + streams.chain(held).sum::<u64>()
    }

    /// Whether a schedule keeps to all constraints.
    pub fn holds(&self, starts: &[i32]) -> bool {
        starts[0] == 0 && self.constraints.iter().all(|((a, b), clocks)| starts[*b] - starts[*a] >= *clocks)
    }

    /// A good schedule, no node before its clock in `earliest`, the earliest schedule. The best one if no per-pair value is
    /// used; else the best of those that capture as often as the optimum with captures by the clock, or as `earliest`.
    pub fn optimise(&self, earliest: &[i32]) -> Vec<i32> {
        let relaxed = self.ascend(&self.constraints, earliest.to_vec(), true);
        if self.held.is_empty() {
            return relaxed;
        }
        let fixed = [relaxed.as_slice(), earliest].into_iter().filter_map(|like| {
            let constraints = self.with_captures(like);
            let least = least(&constraints, earliest.to_vec())?;
            Some(self.ascend(&constraints, least, false))
        });
        fixed.min_by_key(|starts| self.cost(starts)).unwrap_or_else(|| earliest.to_vec())
    }

    /// The constraints with every per-pair value captured as often as in another schedule.
    fn with_captures(&self, like: &[i32]) -> BTreeMap<(usize, usize), i32> {
        let mut constraints = self.constraints.clone();
        for held in &self.held {
            for reading in &held.uses {
                let captures = self.captures(held, reading, like);
                for (from, until) in &held.windows {
                    order(&mut constraints, from.later(captures.min(1)), reading.first);
                    order(&mut constraints, reading.last, until.later(captures * self.interval - 1));
                }
            }
        }
        constraints
    }

    /// Moves groups of nodes to the next clock while that saves register bits; from the least schedule that keeps to the
    /// constraints this ends in the best one. A capture costs by the clock it bridges, or nothing.
    fn ascend(&self, constraints: &BTreeMap<(usize, usize), i32>, mut starts: Vec<i32>, captures: bool) -> Vec<i32> {
        loop {
            let moved = self.best_move(constraints, &starts, captures);
            if !moved.contains(&true) {
                return starts;
            }
            for (start, moved) in starts.iter_mut().zip(moved) {
                *start += i32::from(moved);
            }
        }
    }

    /// The variables whose common move to the next clock saves most; none if no move saves anything.
    fn best_move(&self, constraints: &BTreeMap<(usize, usize), i32>, starts: &[i32], captures: bool) -> Vec<bool> {
        // The ports do not move: they are the sink. A value has a node for its last use, and one for its beginning.
        let (count, sink) = (self.variables.len(), 0);
        let source = count + self.streams.len() + 2 * self.held.len();
        let mut network = Network::new(source + 1);
        for ((earlier, later), clocks) in constraints {
            if starts[*later] - starts[*earlier] == *clocks {
                network.edge(*earlier, *later, UNLIMITED);
            }
        }
        // What it costs that `last` moves and `from` does not, and that `from` moves and `last` does not.
        let mut carry = |last: usize, from: usize, bits: i64, clocks: i32, free: i32| {
            if clocks > free {
                network.edge(last, sink, bits);
                network.edge(source, from, bits);
            } else if clocks == free {
                network.edge(last, from, bits);
            }
        };
        let mut ties = vec![];
        for (i, stream) in self.streams.iter().enumerate() {
            let (last, carried) = (count + i, stream.carried(starts));
            let end = stream.from.clock(starts) + carried;
            ties.extend(stream.uses.iter().filter(|u| u.clock(starts) == end).map(|u| (u.variable, last)));
            carry(last, stream.from.variable, i64::from(stream.bits) * i64::from(self.interval), carried, 0);
        }
        for (i, held) in self.held.iter().enumerate().filter(|_| captures) {
            let last = count + self.streams.len() + 2 * i;
            let close = last + 1;
            let end = held.uses.iter().map(|r| r.last.clock(starts)).max().unwrap_or(i32::MIN);
            let until = held.windows.iter().map(|w| w.1.clock(starts)).min().unwrap_or(i32::MAX);
            ties.extend(held.uses.iter().filter(|r| r.last.clock(starts) == end).map(|r| (r.last.variable, last)));
            ties.extend(held.windows.iter().filter(|w| w.1.clock(starts) == until).map(|w| (close, w.1.variable)));
            let free = i32::from(held.uses.iter().any(|r| r.captured)) * self.interval;
            carry(last, close, i64::from(held.bits), end.saturating_add(1).saturating_sub(until), free);
        }
        for (mover, moved) in ties {
            network.edge(mover, moved, UNLIMITED);
        }
        let mut side = network.source_side(source, sink);
        side.truncate(count);
        side
    }

    /// The program in CPLEX LP format, the captures of per-pair values as general integers.
    pub fn text(&self, doc: &str) -> String {
        let mut text = format!("\\ {doc}\nMinimize\n register_bits: {} fixed", self.fixed);
        for s in &self.streams {
            let _ = write!(text, "\n + {} delay_{}", s.bits, s.name);
        }
        for h in &self.held {
            let _ = write!(text, "\n + {} hold_{}", h.bits, h.name);
        }
        text.push_str("\nSubject To\n");
        let start = |e: Event| (e.variable > 0).then(|| format!("start_{}", self.variables[e.variable]));
        // count >= later - earlier, the count being none for a plain constraint.
        let mut row = |count: Option<String>, later: Event, earlier: Event| {
            let mut terms: Vec<String> = count.into_iter().collect();
            if later.variable != earlier.variable {
                terms.extend(start(earlier).map(|s| format!("+ {s}")));
                terms.extend(start(later).map(|s| format!("- {s}")));
            }
            if !terms.is_empty() {
                let _ = writeln!(text, " {} >= {}", terms.join(" "), later.offset - earlier.offset);
            }
        };
        for ((a, b), clocks) in &self.constraints {
            // later - earlier >= clocks: the later one starts as many clocks early.
            row(None, Event { variable: *a, offset: *clocks }, Event { variable: *b, offset: 0 });
        }
        for s in &self.streams {
            for u in &s.uses {
                row(Some(format!("delay_{}", s.name)), *u, s.from);
            }
        }
        for h in &self.held {
            for reading in &h.uses {
                for (_, until) in &h.windows {
                    row(Some(format!("{} hold_{}", self.interval, h.name)), reading.last.later(1), *until);
                }
            }
        }
        text.push_str("Bounds\n fixed = 1\n");
        for h in self.held.iter().filter(|h| h.uses.iter().any(|u| u.captured)) {
            let _ = writeln!(text, " hold_{} >= 1", h.name);
        }
        if !self.held.is_empty() {
            text.push_str("General\n");
            for h in &self.held {
                let _ = writeln!(text, " hold_{}", h.name);
            }
        }
        text.push_str("End\n");
        text
    }
}
