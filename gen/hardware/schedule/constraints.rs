//! From a block and its earliest schedule to the program of all schedules of the same latency.

use super::linear_program::{Event, Held, LinearProgram, Reading, Stream};
use super::{GROUP, Pass, Slot, delay, operand_phases};
use crate::graph::{Block, Op};
use crate::op::Comb;
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// When a per-pair value is there, as far as one of its sources goes: from one event until before another.
#[derive(Clone, Copy)]
struct Window {
    from: Event,
    until: Event,
}

/// When the value of a node is there.
#[derive(Clone)]
enum Valid {
    /// At any time.
    Always,
    /// In every phase, that of phase 0 from this event on.
    Stream(Event),
    /// While all of these windows are open.
    Pair(Vec<Window>),
}

/// The program in the making.
pub(super) struct Constraints<'a> {
    pass: &'a Pass<'a>,
    earliest: &'a [Slot],
    program: LinearProgram,
    /// Whether an output depends on each node.
    live: Vec<bool>,
    valid: Vec<Valid>,
    /// The variable of each node that has a start of its own.
    pub(super) variables: Vec<Option<usize>>,
    /// The variable of each bundle, by the clocks in which its elements start and are there.
    bundles: HashMap<(String, i32, i32), usize>,
    /// The start of each variable in the earliest schedule.
    starts: Vec<i32>,
    /// Place of each node's value among the streams or the held values.
    streams: Vec<Option<usize>>,
    held: Vec<Option<usize>>,
}

const PORTS: Event = Event { variable: 0, offset: 0 };

impl<'a> Constraints<'a> {
    /// The program, and the variable of each node that has one.
    pub(super) fn collect(
        pass: &'a Pass<'a>,
        earliest: &'a [Slot],
        latency: i32,
        output_ns: f64,
    ) -> (LinearProgram, Vec<Option<usize>>) {
        let count = pass.block.nodes.len();
        let program = LinearProgram {
            variables: vec!["ports".to_owned()],
            interval: pass.interval(),
            constraints: BTreeMap::new(),
            streams: vec![],
            held: vec![],
            fixed: 0,
        };
        let none = vec![None; count];
        let (streams, held) = (none.clone(), none.clone());
        let mut all = Self {
            pass,
            earliest,
            program,
            live: live(pass.block),
            valid: vec![],
            variables: none,
            bundles: HashMap::new(),
            starts: vec![0],
            streams,
            held,
        };
        for i in 0..count {
            let valid = all.node(i);
            all.valid.push(valid);
        }
        for i in 0..count {
            all.uses(i);
        }
        for (_, node) in &pass.block.outputs {
            let out = PORTS.later(latency);
            match all.valid[node.0].clone() {
                Valid::Always => {}
                Valid::Stream(from) => {
                    all.order(from, out);
                    all.carry(node.0, out);
                }
                Valid::Pair(windows) => {
                    let reading = Reading { first: out, last: out, captured: false };
                    all.hold(node.0, &windows, reading);
                }
            }
        }
        for i in 0..count {
            all.paths(i, latency, output_ns);
        }
        (all.program, all.variables)
    }

    fn order(&mut self, earlier: Event, later: Event) {
        self.program.order(earlier, later);
    }

    /// A start for a node. The elements of a bundle that start together in the earliest schedule go on doing so, so that
    /// they are printed as one.
    fn variable(&mut self, i: usize) -> Event {
        let (node, slot) = (&self.pass.block.nodes[i], self.earliest[i]);
        let bundle = (format!("{}{}", node.place.base, node.place.suffix), slot.start, slot.from);
        let variable = *self.bundles.entry(bundle).or_insert_with(|| {
            self.program.variables.push(node.name());
            self.starts.push(slot.start);
            self.program.variables.len() - 1
        });
        self.variables[i] = Some(variable);
        let start = Event { variable, offset: 0 };
        self.order(PORTS, start);
        start
    }

    /// When the value of a node is there; operands come first.
    fn node(&mut self, i: usize) -> Valid {
        let (block, slot) = (self.pass.block, self.earliest[i]);
        let node = &block.nodes[i];
        let interval = self.pass.interval();
        let bits = u64::from(node.ty.bits);
        match &node.op {
            Op::Input if slot.until == i32::MAX => Valid::Stream(PORTS),
            Op::Input => Valid::Pair(vec![Window { from: PORTS, until: PORTS.later(slot.until) }]),
            Op::Comb(Comb::Constant(_)) | Op::Phase(..) | Op::Steady => Valid::Always,
            // What no output depends on is no hardware and follows the others.
            _ if !self.live[i] => Valid::Always,
            _ if block.renames(i) => self.valid[node.args[0].0].clone(),
            Op::Output(_) | Op::Earlier(_) => self.valid[node.args[0].0].clone(),
            Op::Capture { phase, late } => {
                self.program.fixed += bits;
                let lag = if *late { self.pass.lag_clocks() } else { 0 };
                let from = match self.valid[node.args[0].0] {
                    Valid::Stream(from) => from,
                    _ => PORTS,
                };
                let from = from.later(*phase as i32 + 1 + lag);
                Valid::Pair(vec![Window { from, until: from.later(interval) }])
            }
            _ if slot.from == i32::MIN => Valid::Always,
            op => {
                let registers = slot.from - slot.start;
                match op {
                    Op::Instance(_) => {}
                    Op::ScanOr => self.program.fixed += bits,
                    Op::Mux { late } if registers > 0 => {
                        self.program.fixed += bits * late.len().div_ceil(GROUP) as u64;
                    }
                    _ => self.program.fixed += bits * registers as u64,
                }
                if slot.until == i32::MAX {
                    return Valid::Stream(self.variable(i).later(registers));
                }
                let sources: Vec<(bool, Vec<Window>)> = node
                    .args
                    .iter()
                    .filter_map(|a| match &self.valid[a.0] {
                        Valid::Pair(windows) => Some((self.earliest[a.0].until > slot.start, windows.clone())),
                        _ => None,
                    })
                    .collect();
                let all: Vec<Window> = sources.iter().flat_map(|s| s.1.clone()).collect();
                let open = sources.iter().filter(|s| s.0 && !slot.registered).flat_map(|s| s.1.clone());
                let open: Vec<Window> = open.collect();
                let later = |w: &Window| Window { from: w.from.later(registers), until: w.until.later(registers) };
                let mut windows: Vec<Window> = open.iter().map(later).collect();
                if !slot.registered && sources.iter().all(|s| s.0) {
                    // Windows that overlap go on doing so.
                    for w in &all {
                        all.iter().for_each(|other| self.order(w.from.later(1), other.until));
                    }
                    return Valid::Pair(windows);
                }
                // Operands captured again in the clock in which the node starts.
                let start = self.variable(i);
                all.iter().for_each(|w| self.order(w.from.later(i32::from(slot.registered)), start));
                open.iter().for_each(|w| self.order(start.later(1), w.until));
                for (_, closed) in sources.iter().filter(|s| !s.0 && !slot.registered) {
                    // What is closed stays so, by the window that closes first.
                    let first = closed.iter().map(|w| w.until).min_by_key(|until| until.clock(&self.starts));
                    first.into_iter().for_each(|until| self.order(until, start));
                }
                let from = start.later(registers);
                windows.push(Window { from, until: from.later(interval) });
                Valid::Pair(windows)
            }
        }
    }

    /// What node `i` needs of its operands.
    fn uses(&mut self, i: usize) {
        let (block, slot) = (self.pass.block, self.earliest[i]);
        if let (Op::Capture { .. }, Some(arg)) = (&block.nodes[i].op, block.nodes[i].args.first())
            && let (Op::Earlier(_), Valid::Stream(from)) =
                (&block.nodes[self.pass.block.carrier(arg.0)].op, &self.valid[arg.0])
        {
            return self.carry(arg.0, *from);
        }
        let Some(variable) = self.variables[i] else { return };
        let start = Event { variable, offset: 0 };
        if let Op::Mux { late } = &block.nodes[i].op {
            let operands = late.len();
            for (operand, late) in late.iter().enumerate() {
                let Some((first, last)) = operand_phases(block, i, operand) else { continue };
                let lag = if *late { self.pass.lag_clocks() } else { 0 };
                let limit = slot.latest_operand(self.pass.device, operands, *late);
                let arg = block.nodes[i].args[1 + operand].0;
                match self.valid[arg].clone() {
                    Valid::Always => {}
                    Valid::Stream(from) => {
                        let registered = *late && self.earliest[arg].ns > limit + 1e-9;
                        self.order(from.later(i32::from(registered)), start.later(lag));
                        self.carry(arg, start.later(lag));
                    }
                    Valid::Pair(windows) => {
                        let captured = self.earliest[arg].ns > limit + 1e-9;
                        let (first, last) = (start.later(first as i32 + lag), start.later(last as i32 + lag));
                        self.hold(arg, &windows, Reading { first, last, captured });
                    }
                }
            }
            return;
        }
        for arg in block.nodes[i].args.iter().map(|a| a.0) {
            match self.valid[arg].clone() {
                Valid::Always => {}
                Valid::Stream(from) => {
                    self.order(from, start);
                    self.carry(arg, start);
                }
                // What is open and not captured passes its window on.
                Valid::Pair(_) if !slot.registered && self.earliest[arg].until > slot.start => {}
                Valid::Pair(windows) => {
                    let captured = slot.registered && self.earliest[arg].ns > self.pass.launch();
                    let last = start.later(self.pass.interval() - 1);
                    let there = self.earliest[arg].until - self.earliest[arg].from;
                    if slot.registered && there < self.pass.interval() {
                        windows.iter().for_each(|w| self.order(w.from.later(1), start));
                    }
                    self.hold(arg, &windows, Reading { first: start, last, captured });
                }
            }
        }
    }

    /// A value of every phase is used in a clock.
    fn carry(&mut self, i: usize, mut at: Event) {
        let mut i = self.pass.block.carrier(i);
        while let Op::Earlier(phases) = &self.pass.block.nodes[i].op {
            at = at.later(*phases as i32);
            i = self.pass.block.carrier(self.pass.block.nodes[i].args[0].0);
        }
        let Valid::Stream(from) = self.valid[i] else { return };
        // With one phase, a choice among one is the per-pair value itself, and all that use it share its registers.
        if self.pass.interval() == 1
            && matches!(&self.pass.block.nodes[i].op, Op::Mux { late } if late.len() == 1)
            && let arg = self.pass.block.nodes[i].args[1].0
            && let Valid::Pair(windows) = self.valid[arg].clone()
        {
            return self.hold(arg, &windows, Reading { first: at, last: at, captured: false });
        }
        let streams = &mut self.program.streams;
        let place = *self.streams[i].get_or_insert_with(|| {
            let node = &self.pass.block.nodes[i];
            streams.push(Stream { name: node.name(), bits: node.ty.bits, from, uses: vec![] });
            streams.len() - 1
        });
        if !streams[place].uses.contains(&at) {
            streams[place].uses.push(at);
        }
    }

    /// A per-pair value is used.
    fn hold(&mut self, i: usize, windows: &[Window], reading: Reading) {
        let i = self.pass.block.carrier(i);
        for w in windows {
            self.order(w.from.later(i32::from(reading.captured)), reading.first);
        }
        let held = &mut self.program.held;
        let place = *self.held[i].get_or_insert_with(|| {
            let node = &self.pass.block.nodes[i];
            let windows = windows.iter().map(|w| (w.from, w.until)).collect();
            held.push(Held { name: node.name(), bits: node.ty.bits, windows, uses: vec![] });
            held.len() - 1
        });
        if !held[place].uses.contains(&reading) {
            held[place].uses.push(reading);
        }
    }

    /// Two nodes on a path that does not fit in one clock are at least one clock apart.
    fn paths(&mut self, origin: usize, latency: i32, output_ns: f64) {
        let Valid::Stream(from) = self.valid[origin] else { return };
        let node = &self.pass.block.nodes[origin];
        if matches!(node.op, Op::Output(_)) || self.pass.block.renames(origin) {
            return;
        }
        let arrival = match &node.op {
            Op::Instance(_) if from.offset > 0 => self.pass.children[&origin].output_ns,
            Op::Comb(Comb::Multiply(_)) => self.pass.device.product_launch(),
            Op::Mux { late } if from.offset > 0 => self.pass.launch() + self.pass.choice(late.len()),
            _ if from.offset > 0 || matches!(node.op, Op::Input) => self.pass.launch(),
            _ => self.base(origin) + self.delay(origin),
        };
        let mut arrivals = vec![f64::NEG_INFINITY; self.pass.block.nodes.len()];
        arrivals[origin] = arrival;
        let mut open: BTreeSet<usize> = self.pass.users[origin].iter().copied().collect();
        while let Some(i) = open.pop_first() {
            let node = &self.pass.block.nodes[i];
            // Late operands come from registers.
            let late = |k: usize| matches!(&node.op, Op::Mux { late } if k > 0 && late[k - 1]);
            let in_time = node.args.iter().enumerate().filter(|(k, _)| !late(*k));
            let mut before = in_time.map(|(_, a)| arrivals[a.0]).fold(f64::NEG_INFINITY, f64::max);
            if before == f64::NEG_INFINITY {
                continue;
            }
            if self.pass.block.renames(i) || matches!(self.pass.block.nodes[i].op, Op::Output(_)) {
                arrivals[i] = before;
                open.extend(&self.pass.users[i]);
                continue;
            }
            let Some(variable) = self.variables[i] else { continue };
            if !matches!(self.pass.block.nodes[i].op, Op::Mux { .. }) {
                before = before.max(self.base(i));
            }
            let ns = before + self.delay(i);
            let too_long = before > self.pass.launch() + 1e-9 && !self.pass.fits(ns);
            if too_long || self.pass.registers_operands(i) {
                self.order(from.later(1), Event { variable, offset: 0 });
            } else if self.earliest[i].from == self.earliest[i].start {
                arrivals[i] = ns;
                open.extend(&self.pass.users[i]);
            }
        }
        // Outputs arrive no later than in the earliest schedule, so that what follows them still fits.
        if self.pass.block.outputs.iter().any(|o| arrivals[o.1.0] > output_ns + 1e-9) {
            self.order(from.later(1), PORTS.later(latency));
        }
    }

    /// Arrival of what does not depend on the schedule at the inputs of a node.
    fn base(&self, i: usize) -> f64 {
        let slot = self.earliest[i];
        if let Op::Mux { late } = &self.pass.block.nodes[i].op {
            return slot.latest_operand(self.pass.device, late.len(), false);
        }
        let always = self.pass.block.nodes[i].args.iter().filter(|a| matches!(self.valid[a.0], Valid::Always));
        always.map(|a| self.earliest[a.0].ns).fold(self.pass.launch(), f64::max)
    }

    /// Delay from the inputs of a node to its output, or to its first registers; unlimited where operands must come
    /// from registers.
    fn delay(&self, i: usize) -> f64 {
        let node = &self.pass.block.nodes[i];
        match &node.op {
            Op::Instance(_) => self.pass.children[&i].input_path,
            Op::Comb(Comb::Accumulate(_) | Comb::Delay(_)) => 0.0,
            _ if self.earliest[i].from > self.earliest[i].start => f64::INFINITY,
            Op::Mux { late } => self.pass.device.mux(late.len()),
            _ => delay(self.pass.device, self.pass.block, i),
        }
    }
}

/// The nodes that some output depends on; of what merely renames its first operand the others do not count.
fn live(block: &Block) -> Vec<bool> {
    let mut live = vec![false; block.nodes.len()];
    let mut open: Vec<usize> = block.outputs.iter().map(|o| o.1.0).collect();
    while let Some(i) = open.pop() {
        if !std::mem::replace(&mut live[i], true) {
            let args = &block.nodes[i].args;
            let count = if block.renames(i) { 1 } else { args.len() };
            open.extend(args[..count].iter().map(|a| a.0));
        }
    }
    live
}
