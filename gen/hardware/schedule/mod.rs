//! Scheduling: when each node of a block is computed, on a device at a clock period.
//!
//! As soon as possible, on times (clock, nanoseconds): a node starts when its last operand has arrived; where it would
//! end after the period it starts a clock later from registers, and what is too long even then misses the clock. A product
//! stands between registers, the one behind it being the multiplier's own; where the nets to multipliers would take too much
//! of the period, there is one more register in front of each operand. A multiplexer of more than four operands that is too
//! long takes two clocks: among the operands of each group, then among the groups, with registers between. Sums, negations and
//! comparisons that no clock holds are made of parts first (`divide.rs`); what is too long even so stays so. Sums of products
//! become chains of multipliers where the part has adders behind them (`chain.rs`). Blocks are scheduled by themselves,
//! their inputs arriving from registers in clock 0, and all outputs leave at one latency; an instance then is one
//! operation of its parent. That fixes the latency; within it nodes then start where they take the fewest register bits
//! (see [`linear_program`]).
//!
//! A per-pair value is valid in a *window* of clocks, at most one interval long. Uses inside the window need no
//! register at all; a use beyond it captures the value again (a *hold*), which costs one register an interval whatever
//! the distance. A per-phase value moves by one register per clock.

mod chain;
mod constraints;
mod cut;
mod divide;
// For the tests that find the optimum otherwise.
#[doc(hidden)]
pub mod linear_program;

use crate::device::Device;
use crate::graph::flat::pattern;
use crate::graph::{Block, Library, Op, Rate, Step};
use crate::op::{Comb, Type};
use constraints::Constraints;
use linear_program::LinearProgram;
use std::collections::{BTreeMap, HashMap, HashSet};
use std::rc::Rc;

/// When a node's value is there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slot {
    /// Clock in which the operands are consumed, relative to phase 0 of the block's inputs.
    pub start: i32,
    /// Clock in which the value is first valid (per-phase values: that of phase 0).
    pub from: i32,
    /// Clock in which a per-pair value is no longer valid; `i32::MAX` for others.
    pub until: i32,
    /// Arrival in its clock, nanoseconds after the edge.
    pub ns: f64,
    /// Whether operands must come from registers (they start a clock of their own).
    pub registered: bool,
}

impl Slot {
    /// A value that is there at any time.
    const ALWAYS: Self = Self { start: i32::MIN, from: i32::MIN, until: i32::MAX, ns: 0.0, registered: false };

    /// Latest arrival, ns, of a operand that a multiplexer with this slot reads as it is; what arrives later is captured first.
    pub(crate) fn latest_operand(&self, device: &Device, operands: usize, late: bool) -> f64 {
        if late || self.registered { device.launch() } else { self.ns - device.mux(operands) }
    }
}

/// The schedule of one block.
#[derive(Clone, Debug)]
pub struct Schedule {
    /// The block, with operations divided that no clock holds.
    pub block: Rc<Block>,
    /// One slot a node.
    pub slots: Vec<Slot>,
    /// Clocks from inputs to outputs.
    pub latency: i32,
    /// Longest path from an input to the first register (or to an output, if the latency is 0), ns.
    pub input_path: f64,
    /// Arrival of the latest output after the edge, ns.
    pub output_ns: f64,
    /// By how many intervals late phases follow.
    pub lag: i32,
    /// The longest path between registers in the block and its instances, ns, with the name of its last node.
    pub critical: (f64, String),
    /// All schedules of this latency as a linear program.
    pub program: LinearProgram,
    /// This one as a solution of it: the start of each variable.
    pub starts: Vec<i32>,
    /// Register bits of this one by the program.
    pub register_bits: u64,
    /// Schedules of the instances, by node.
    pub children: BTreeMap<usize, Rc<Schedule>>,
}

impl Schedule {
    /// The schedules of the block and of all blocks in it, instantiated ones first, each with its number of instances.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// # let library = Library::default();
    /// # let block = library.block("square", &[], 1, |top| {
    /// #     let x = top.input(NUMBER, (-9, 9)).named("x");
    /// #     (x * x).named("y")
    /// # });
    /// let schedule = Scheduler::new(device::find("xc2v6000-4")?, 100).schedule(&block);
    /// assert_eq!(schedule.hierarchy().len(), 1);
    /// # Ok::<(), device::DeviceError>(())
    /// ```
    pub fn hierarchy(self: &Rc<Self>) -> Vec<(Rc<Schedule>, usize)> {
        fn visit(schedule: &Rc<Schedule>, all: &mut Vec<(Rc<Schedule>, usize)>) {
            schedule.children.values().for_each(|child| visit(child, all));
            match all.iter_mut().find(|(known, _)| Rc::ptr_eq(known, schedule)) {
                Some((_, count)) => *count += 1,
                None => all.push((Rc::clone(schedule), 1)),
            }
        }
        let mut all = vec![];
        visit(self, &mut all);
        all
    }

    /// Clocks by which late phases follow the others.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// # let library = Library::default();
    /// # let block = library.block("square", &[], 1, |top| {
    /// #     let x = top.input(NUMBER, (-9, 9)).named("x");
    /// #     (x * x).named("y")
    /// # });
    /// let schedule = Scheduler::new(device::find("xc2v6000-4")?, 100).schedule(&block);
    /// assert_eq!(schedule.lag_clocks(), 0, "no late phases");
    /// # Ok::<(), device::DeviceError>(())
    /// ```
    pub fn lag_clocks(&self) -> i32 {
        self.lag * self.block.interval as i32
    }
}

/// Schedules blocks for one device and clock; each block once.
pub struct Scheduler {
    device: &'static Device,
    period: f64,
    done: HashMap<*const Block, Rc<Schedule>>,
    /// The chains of multipliers.
    chains: Library,
}

/// Legs of a group, where a multiplexer takes two clocks: two bits of the index choose among them.
pub const GROUP: usize = 4;

/// Rounds in which bundles are aligned before those that still move are given up.
const MOST_MOVES: usize = 64;

/// Lags tried before giving up: a result that needs more intervals than this is a defect of the block.
const MOST_LAG: i32 = 256;

impl Scheduler {
    /// A scheduler for a clock in MHz.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(Scheduler::new(device::find("xc2v6000-4")?, 100).period(), 10.0);
    /// # Ok::<(), device::DeviceError>(())
    /// ```
    pub fn new(device: &'static Device, frequency: u32) -> Self {
        Self { device, period: 1000.0 / f64::from(frequency), done: HashMap::new(), chains: Library::default() }
    }

    /// Clock period, ns.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(Scheduler::new(device::find("xc2v6000-4")?, 50).period(), 20.0);
    /// # Ok::<(), device::DeviceError>(())
    /// ```
    pub fn period(&self) -> f64 {
        self.period
    }

    /// The schedule of a block (made on first use).
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// # let library = Library::default();
    /// # let block = library.block("square", &[], 1, |top| {
    /// #     let x = top.input(NUMBER, (-9, 9)).named("x");
    /// #     (x * x).named("y")
    /// # });
    /// let schedule = Scheduler::new(device::find("xc2v6000-4")?, 100).schedule(&block);
    /// assert_eq!(schedule.latency, 1, "a product has a register");
    /// # Ok::<(), device::DeviceError>(())
    /// ```
    pub fn schedule(&mut self, block: &Rc<Block>) -> Rc<Schedule> {
        if let Some(schedule) = self.done.get(&Rc::as_ptr(block)) {
            return Rc::clone(schedule);
        }
        let whole = Rc::as_ptr(block);
        let room = self.period - self.device.setup() - self.device.launch() + 1e-9;
        let longest = self.period - self.device.setup() + 1e-9;
        let block = &chain::chained(block, self.device, longest, &self.chains);
        let block = &divide::divided(block, self.device, room);
        let children: BTreeMap<usize, Rc<Schedule>> = block
            .nodes
            .iter()
            .enumerate()
            .filter_map(|(i, n)| match &n.op {
                Op::Instance(child) => Some((i, self.schedule(child))),
                _ => None,
            })
            .collect();
        let late = block.nodes.iter().any(|n| matches!(&n.op, Op::Mux { late } if late.contains(&true)));
        let lags = if late { 0..MOST_LAG } else { 0..1 };
        let schedule = lags
            .map(|lag| Pass {
                device: self.device,
                period: self.period,
                block,
                children: &children,
                users: users(block),
                lag,
            })
            .find_map(|pass| pass.run())
            .unwrap_or_else(|| panic!("block {}: late operands depend on themselves", block.name));
        let schedule = Rc::new(schedule);
        self.done.insert(whole, Rc::clone(&schedule));
        schedule
    }
}

/// The making of one schedule.
struct Pass<'a> {
    device: &'static Device,
    period: f64,
    block: &'a Rc<Block>,
    children: &'a BTreeMap<usize, Rc<Schedule>>,
    /// The nodes that have each node as operand.
    users: Vec<Vec<usize>>,
    lag: i32,
}

/// What a node needs of an operand: the value in this clock, and whether straight from a register.
struct Arrival {
    clock: i32,
    ns: f64,
    until: i32,
}

/// What is asked of a node beyond its operands: a start that is not earlier, and for multiplexers operands that arrive no later.
#[derive(Clone, Copy)]
struct Wish {
    start: i32,
    ns: f64,
    /// Whether a per-pair value is made from captured operands.
    captured: bool,
}

const NO_WISH: Wish = Wish { start: i32::MIN, ns: f64::INFINITY, captured: false };

impl Pass<'_> {
    fn launch(&self) -> f64 {
        self.device.launch()
    }

    fn fits(&self, ns: f64) -> bool {
        ns <= self.longest()
    }

    /// Whether a node is a product whose operands each have a register of their own.
    fn registers_operands(&self, i: usize) -> bool {
        let node = &self.block.nodes[i];
        matches!(node.op, Op::Comb(Comb::Multiply(_))) && self.device.registers_operands(node.ty.bits, self.longest())
    }

    /// Latest arrival in a clock.
    fn longest(&self) -> f64 {
        self.period - self.device.setup() + 1e-9
    }

    fn interval(&self) -> i32 {
        self.block.interval as i32
    }

    fn lag_clocks(&self) -> i32 {
        self.lag * self.interval()
    }

    /// Runs the pass; none if a late operand is not there in time.
    fn run(&self) -> Option<Schedule> {
        let earliest = self.aligned();
        if !self.late_operands_arrive(&earliest) {
            return None;
        }
        let (latency, output_ns) = self.latency(&earliest);
        let (program, variables) = Constraints::collect(self, &earliest, latency, output_ns);
        let mut starts = vec![0; program.variables.len()];
        for (slot, variable) in earliest.iter().zip(&variables) {
            variable.iter().for_each(|v| starts[*v] = slot.start);
        }
        let best = program.optimise(&starts);
        let wish = |(slot, variable): (&Slot, &Option<usize>)| Wish {
            start: variable.map_or(i32::MIN, |v| best[v]),
            ns: slot.ns,
            captured: slot.registered && slot.until != i32::MAX,
        };
        let wishes: Vec<Wish> = earliest.iter().zip(&variables).map(wish).collect();
        let slots = self.slots(&wishes);
        let as_wished = slots.iter().zip(&variables).all(|(slot, v)| v.is_none_or(|v| slot.start == best[v]));
        // What the program does not see (windows of values made from many) may push a node back: then nothing moves.
        let (slots, starts) =
            if as_wished && self.late_operands_arrive(&slots) { (slots, best) } else { (earliest, starts) };
        Some(self.schedule(slots, program, starts))
    }

    /// The earliest schedule in which the elements of a vector or record start together, unless one is made of another.
    fn aligned(&self) -> Vec<Slot> {
        let mut bundles = self.bundles();
        loop {
            let mut wishes = vec![NO_WISH; self.block.nodes.len()];
            let mut moving = HashSet::new();
            for _ in 0..MOST_MOVES {
                let slots = self.slots(&wishes);
                moving.clear();
                for (bundle, members) in bundles.iter().enumerate() {
                    let start = members.iter().map(|i| slots[*i].start).max().unwrap_or(i32::MIN);
                    for i in members {
                        if slots[*i].start < start {
                            moving.insert(bundle);
                        }
                        wishes[*i].start = start;
                    }
                }
                if moving.is_empty() {
                    return slots;
                }
            }
            // Bundles made of parts of each other push each other on for ever: their elements start on their own.
            let mut bundle = 0..;
            bundles.retain(|_| !bundle.next().is_some_and(|b| moving.contains(&b)));
        }
    }

    /// The nodes that are elements of one vector or record: all of them, or those of one field.
    fn bundles(&self) -> Vec<Vec<usize>> {
        let block = self.block;
        let mut bundles: BTreeMap<(String, Vec<Step>), Vec<usize>> = BTreeMap::new();
        for (i, node) in block.nodes.iter().enumerate() {
            let own = matches!(node.op, Op::Comb(_) | Op::Mux { .. }) && !block.renames(i);
            let constant = matches!(node.op, Op::Comb(Comb::Constant(_)));
            let element = node.place.path.iter().any(|step| !matches!(step, Step::Index(_)));
            let read = !self.users[i].is_empty() || block.outputs.iter().any(|o| o.1.0 == i);
            if own && !constant && element && read {
                let elements = node.place.path.iter().copied().filter(|step| matches!(step, Step::Index(_)));
                let key = (format!("{}{}", node.place.base, node.place.suffix), elements.collect());
                bundles.entry(key).or_default().push(i);
            }
        }
        let mut all = vec![];
        for members in bundles.into_values() {
            if !self.depend(&members) {
                all.push(members);
                continue;
            }
            let mut fields: BTreeMap<Option<Step>, Vec<usize>> = BTreeMap::new();
            for i in members {
                let field = block.nodes[i].place.path.iter().copied().find(|step| matches!(step, Step::Field(..)));
                fields.entry(field).or_default().push(i);
            }
            all.extend(fields.into_values().filter(|members| !self.depend(members)));
        }
        all
    }

    /// Whether one of the nodes is made of another.
    fn depend(&self, nodes: &[usize]) -> bool {
        let mut seen = vec![false; self.block.nodes.len()];
        let mut open: Vec<usize> = nodes.iter().flat_map(|i| self.users[*i].clone()).collect();
        while let Some(i) = open.pop() {
            if nodes.contains(&i) {
                return true;
            }
            if !std::mem::replace(&mut seen[i], true) {
                open.extend(&self.users[i]);
            }
        }
        false
    }

    /// All slots, operands before their uses.
    fn slots(&self, wishes: &[Wish]) -> Vec<Slot> {
        let mut slots: Vec<Slot> = vec![];
        for (i, wish) in wishes.iter().enumerate() {
            let slot = self.place(i, &slots, *wish);
            slots.push(slot);
        }
        slots
    }

    /// Clocks to the last output, and its arrival.
    fn latency(&self, slots: &[Slot]) -> (i32, f64) {
        let outputs = || self.block.outputs.iter().map(|o| slots[o.1.0]);
        let latency = outputs().map(|s| s.from).max().unwrap_or(0).max(0);
        let late = outputs().filter(|s| s.from == latency);
        (latency, late.map(|s| s.ns).fold(self.launch(), f64::max))
    }

    fn schedule(&self, slots: Vec<Slot>, program: LinearProgram, starts: Vec<i32>) -> Schedule {
        let block = self.block;
        let (latency, output_ns) = self.latency(&slots);
        // Every node that starts in clock 0 lies on a path from the inputs to the first register.
        let path = |i: usize| match self.children.get(&i) {
            Some(child) if slots[i].start == 0 && child.latency > 0 => self.arrival(i, &slots, 0).ns + child.input_path,
            _ if slots[i].from == 0 => slots[i].ns,
            // With registers behind it an operation leaves nothing of the period to what comes before.
            None if (slots[i].start == 0 || self.registers_operands(i))
                && !matches!(block.nodes[i].op, Op::Capture { .. } | Op::Output(_)) =>
            {
                self.period
            }
            _ => self.launch(),
        };
        let input_path = (0..slots.len()).map(path).fold(self.launch(), f64::max) - self.launch();
        let mut critical = (0.0, String::new());
        for (i, slot) in slots.iter().enumerate() {
            let ns = match &block.nodes[i].op {
                Op::Mux { .. } if slot.from > slot.start => slot.ns.max(self.launch() + self.device.mux(GROUP)),
                Op::Comb(Comb::Multiply(_)) => self.device.product_arrival(block.nodes[i].ty.bits, self.longest()),
                Op::Comb(Comb::Accumulate(_)) => self.device.product_launch(),
                _ => slot.ns,
            };
            if ns > critical.0 {
                critical = (ns, format!("{}.{}", block.name, block.nodes[i].name()));
            }
        }
        for child in self.children.values() {
            if child.critical.0 > critical.0 || (child.critical.0 == critical.0 && child.critical.1 < critical.1) {
                critical = child.critical.clone();
            }
        }
        Schedule {
            block: Rc::clone(block),
            slots,
            latency,
            input_path,
            output_ns,
            lag: self.lag,
            critical,
            register_bits: program.cost(&starts),
            program,
            starts,
            children: self.children.clone(),
        }
    }

    fn place(&self, i: usize, slots: &[Slot], wish: Wish) -> Slot {
        let node = &self.block.nodes[i];
        let interval = self.interval();
        match &node.op {
            Op::Input => {
                let until = if node.rate == Rate::Pair { interval } else { i32::MAX };
                Slot { start: 0, from: 0, until, ns: self.launch(), registered: false }
            }
            Op::Comb(Comb::Constant(_)) => Slot::ALWAYS,
            Op::Steady => Slot { ns: self.launch(), ..Slot::ALWAYS },
            _ if self.block.renames(i) => slots[node.args[0].0],
            Op::Phase(..) => Slot { ns: self.launch(), ..Slot::ALWAYS },
            Op::Capture { phase, late } => {
                let arg = slots[node.args[0].0];
                let lag = if *late { self.lag * interval } else { 0 };
                // What is there at any time changes with the phase of the slot.
                let from = arg.from.max(0) + *phase as i32 + 1 + lag;
                Slot { start: from - 1, from, until: from + interval, ns: self.launch(), registered: false }
            }
            // In time with its operand, whose delay line it is a tap of.
            Op::Earlier(_) => Slot { ns: self.launch(), ..slots[node.args[0].0] },
            Op::Mux { late } => self.place_mux(i, late, slots, wish),
            Op::Output(_) => {
                let instance = slots[node.args[0].0];
                let until = if node.rate == Rate::Pair { instance.until } else { i32::MAX };
                Slot { until, ..instance }
            }
            Op::Instance(_) => {
                let child = &self.children[&i];
                let (arrival, start, ns, registered) = self.start(i, slots, child.input_path, wish);
                let ns = if child.latency == 0 { ns } else { child.output_ns };
                let until = arrival.until.saturating_add(child.latency);
                let captured = registered && arrival.until != i32::MAX;
                let until = if captured { start + interval + child.latency } else { until };
                Slot { start, from: start + child.latency, until, ns, registered }
            }
            // From the multiplier's registers to another one of it.
            Op::Comb(Comb::Accumulate(_) | Comb::Delay(_)) => {
                let start = self.arrival(i, slots, wish.start).clock;
                let sum = matches!(node.op, Op::Comb(Comb::Accumulate(_)));
                let ns = if sum { self.device.sum_launch() } else { self.launch() };
                Slot { start, from: start + 1, until: i32::MAX, ns, registered: false }
            }
            op => {
                let delay = delay(self.device, self.block, i);
                // Made of constants of each phase alone: they are there at any time, but another one in every clock.
                let wish = if node.rate == Rate::Phase { Wish { start: wish.start.max(0), ..wish } } else { wish };
                let (arrival, start, ns, registered) = self.start(i, slots, delay, wish);
                if arrival.clock == i32::MIN {
                    return Slot { ns: self.launch() + delay, ..Slot::ALWAYS };
                }
                if matches!(op, Op::Comb(Comb::Multiply(_))) {
                    // Operands straight from registers, and the register behind the product is the multiplier's own.
                    let captured = arrival.ns > self.launch() || self.too_short(i, slots, arrival.clock);
                    let more = i32::from(captured) + i32::from(self.registers_operands(i));
                    let start = arrival.clock + more;
                    let ns = self.device.product_launch();
                    return Slot { start, from: start + 1, until: i32::MAX, ns, registered: true };
                }
                let until = if registered { start.saturating_add(interval) } else { arrival.until };
                let until = if node.rate == Rate::Pair { until } else { i32::MAX };
                Slot { start, from: start, until, ns, registered }
            }
        }
    }

    /// Arrival of the operands, start clock, arrival of the result and whether the operands are registered for it.
    fn start(&self, i: usize, slots: &[Slot], delay: f64, wish: Wish) -> (Arrival, i32, f64, bool) {
        let in_register = self.launch() + delay;
        if wish.captured {
            // Operands that arrive after the edge, or are gone before the slot is over, are captured in the clock before.
            let earliest = self.block.nodes[i].args.iter().map(|a| slots[a.0]).map(|s| match s.until {
                _ if s.from == i32::MIN => i32::MIN,
                i32::MAX => s.from + i32::from(s.ns > self.launch()),
                until => s.from + i32::from(s.ns > self.launch() || until < wish.start.saturating_add(self.interval())),
            });
            let start = earliest.fold(wish.start, i32::max);
            return (self.arrival(i, slots, i32::MIN), start, in_register, true);
        }
        let arrival = self.arrival(i, slots, wish.start);
        if self.fits(arrival.ns + delay) || arrival.ns <= self.launch() {
            let (start, ns) = (arrival.clock, arrival.ns + delay);
            return (arrival, start, ns, false);
        }
        // Even where operands wait for the wish, one that is there at any time may be too late in every clock.
        let arrival = self.arrival(i, slots, wish.start.saturating_sub(1));
        let start = arrival.clock.saturating_add(1);
        (arrival, start, in_register, true)
    }

    /// Whether an operand that is first there in a clock is gone before a slot is over: it has to be captured first.
    fn too_short(&self, i: usize, slots: &[Slot], clock: i32) -> bool {
        let until = clock.saturating_add(self.interval());
        self.block.nodes[i].args.iter().map(|a| slots[a.0]).any(|s| s.from == clock && s.until < until)
    }

    /// When the last operand of a node arrives, or where that is later, clock `least`.
    fn arrival(&self, i: usize, slots: &[Slot], least: i32) -> Arrival {
        let node = &self.block.nodes[i];
        let args: Vec<Slot> = node.args.iter().map(|a| slots[a.0]).collect();
        let clock = args.iter().map(|s| s.from).max().unwrap_or(i32::MIN).max(least);
        let mut arrival = Arrival { clock, ns: self.launch(), until: i32::MAX };
        for s in args {
            let (ns, until) = if s.from == i32::MIN {
                (s.ns, i32::MAX)
            } else if s.until == i32::MAX {
                (if s.from == clock { s.ns } else { self.launch() }, i32::MAX)
            } else if s.until > clock {
                (s.ns, s.until)
            } else {
                (self.launch(), clock + self.interval())
            };
            arrival.ns = arrival.ns.max(ns);
            arrival.until = arrival.until.min(until);
        }
        arrival
    }

    /// Whether a multiplexer among that many operands takes two clocks.
    fn divides(&self, operands: usize) -> bool {
        operands > GROUP && !self.fits(self.launch() + self.device.mux(operands))
    }

    /// Delay of a multiplexer among that many operands from its operands, or from its inner registers, to its output.
    fn choice(&self, operands: usize) -> f64 {
        self.device.mux(if self.divides(operands) { operands.div_ceil(GROUP) } else { operands })
    }

    fn place_mux(&self, i: usize, late: &[bool], slots: &[Slot], wish: Wish) -> Slot {
        let node = &self.block.nodes[i];
        let delay = self.choice(late.len());
        let divided = self.divides(late.len());
        let mut clock = wish.start.max(0);
        loop {
            let (mut ready, mut ns) = (clock, self.launch());
            for (operand, is_late) in late.iter().enumerate() {
                let Some((first, last)) = operand_phases(self.block, i, operand).filter(|_| !is_late) else { continue };
                let slot = slots[node.args[1 + operand].0];
                if slot.from == i32::MIN {
                    continue;
                }
                let per_pair = slot.until != i32::MAX;
                // A value that leaves too little of the period for the choice, or of its window for the last phase
                // it is read in, is captured first.
                let outlives = !per_pair || clock + (last as i32) < slot.until;
                let in_time = slot.ns <= self.launch()
                    || !divided && self.fits(slot.ns + delay) && slot.ns + delay <= wish.ns + 1e-9;
                let direct = in_time && outlives;
                ready = ready.max(slot.from + i32::from(!direct) - if per_pair { first as i32 } else { 0 });
                ns = ns.max(if direct { slot.ns } else { self.launch() });
            }
            if ready == clock {
                let ns = if divided { self.launch() } else { ns } + delay;
                let from = clock + i32::from(divided);
                return Slot { start: clock, from, until: i32::MAX, ns, registered: divided };
            }
            clock = ready;
        }
    }

    fn late_operands_arrive(&self, slots: &[Slot]) -> bool {
        self.block.nodes.iter().enumerate().all(|(i, node)| {
            let Op::Mux { late } = &node.op else { return true };
            late.iter().enumerate().filter(|l| *l.1).all(|(operand, _)| {
                let Some((first, last)) = operand_phases(self.block, i, operand) else { return true };
                let slot = slots[node.args[1 + operand].0];
                let read = |phase: usize| slots[i].start + phase as i32 + self.lag * self.interval();
                let direct = slot.ns <= self.launch() && read(last) < slot.until;
                // What follows the phases is delayed from its own phase 0 on.
                let first = if slot.until == i32::MAX { 0 } else { first };
                slot.from + i32::from(!direct) <= read(first)
            })
        })
    }
}

/// The nodes that have each node as operand.
fn users(block: &Block) -> Vec<Vec<usize>> {
    let mut users = vec![vec![]; block.nodes.len()];
    for (i, node) in block.nodes.iter().enumerate() {
        for arg in &node.args {
            users[arg.0].push(i);
        }
    }
    users
}

/// Delay of a node from its inputs to its output, nets before it included, ns.
fn delay(device: &Device, block: &Block, i: usize) -> f64 {
    let node = &block.nodes[i];
    match &node.op {
        Op::Comb(op) => {
            let types: Vec<Type> = node.args.iter().map(|a| block.node(*a).ty).collect();
            op.delay(device, &types, node.ty)
        }
        Op::ScanOr => device.tree(2),
        _ => 0.0,
    }
}

/// First and last phase in which a operand of a multiplexer is read, if any.
pub fn operand_phases(block: &Block, choose: usize, operand: usize) -> Option<(usize, usize)> {
    let select = &block.node(block.nodes[choose].args[0]).op;
    let mut phases = (0..block.interval).filter(|s| pattern(select, *s) == Some(operand));
    let first = phases.next()?;
    Some((first, phases.next_back().unwrap_or(first)))
}
