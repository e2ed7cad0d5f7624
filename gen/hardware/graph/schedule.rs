//! Scheduling: when each node of a unit is computed, on a device at a clock period.
//!
//! As soon as possible, on times (clock, nanoseconds): a node starts when its last operand has arrived; where it would
//! end after the period it starts a clock later from registers, and where even that is too long it is followed by as
//! many registers as its delay spans periods (for products that is the rule, and the synthesiser moves the first into
//! the multiplier). A choice among more than four legs that is too long takes two clocks: among the legs of each group,
//! then among the groups, with registers between; what is too long even so stays so. Units are scheduled by themselves,
//! their inputs arriving from registers in clock 0, and all outputs leave at one latency; an instance then is one
//! operation of its parent. That fixes the latency; within it nodes then start where they take the fewest register bits
//! (see [`programme`](super::programme)).
//!
//! A per-pair value is valid in a *window* of clocks, at most one interval long. Uses inside the window need no
//! register at all; a use beyond it captures the value again (a *hold*), which costs one register an interval whatever
//! the distance. A per-phase value moves by one register a clock.

use super::constraints::Constraints;
use super::flat::pattern;
use super::programme::Programme;
use super::{Op, Rate, Type, Unit};
use crate::device::Device;
use std::collections::{BTreeMap, HashMap};
use std::rc::Rc;

/// When a node's value is there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slot {
    /// Clock in which the operands are consumed, relative to phase 0 of the unit's inputs.
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

    /// Latest arrival, ns, of a leg that a choice with this slot reads as it is; what arrives later is captured first.
    pub(super) fn latest_leg(&self, device: &Device, legs: usize, lagged: bool) -> f64 {
        if lagged || self.registered { device.launch() } else { self.ns - device.mux(legs) }
    }
}

/// The schedule of one unit.
#[derive(Clone, Debug)]
pub struct Schedule {
    /// The unit.
    pub unit: Rc<Unit>,
    /// One slot a node.
    pub slots: Vec<Slot>,
    /// Clocks from inputs to outputs.
    pub latency: i32,
    /// Longest path from an input to the first register (or to an output, if the latency is 0), ns.
    pub input_path: f64,
    /// Arrival of the latest output after the edge, ns.
    pub output_ns: f64,
    /// By how many intervals lagged phases follow.
    pub lag: i32,
    /// The longest path between registers in the unit and its instances, ns, with the name of its last node.
    pub critical: (f64, String),
    /// All schedules of this latency as a linear programme.
    pub programme: Programme,
    /// Register bits of this one by the programme.
    pub register_bits: u64,
    /// Schedules of the instances, by node.
    pub children: BTreeMap<usize, Rc<Schedule>>,
}

impl Schedule {
    /// The schedules of the unit and of all units in it, instantiated ones first, each with its number of instances.
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

    /// Clocks by which lagged phases follow the others.
    pub fn lag_clocks(&self) -> i32 {
        self.lag * self.unit.interval as i32
    }
}

/// Schedules units for one device and clock; each unit once.
pub struct Scheduler {
    device: &'static Device,
    period: f64,
    done: HashMap<*const Unit, Rc<Schedule>>,
}

/// Legs of a group, where a choice takes two clocks: two bits of the index choose among them.
pub const GROUP: usize = 4;

/// Lags tried before giving up: a result that needs more intervals than this is a defect of the unit.
const MOST_LAG: i32 = 256;

impl Scheduler {
    /// A scheduler for a clock in MHz.
    pub fn new(device: &'static Device, frequency: u32) -> Self {
        Self { device, period: 1000.0 / f64::from(frequency), done: HashMap::new() }
    }

    /// Clock period, ns.
    pub fn period(&self) -> f64 {
        self.period
    }

    /// The schedule of a unit (made on first use).
    pub fn schedule(&mut self, unit: &Rc<Unit>) -> Rc<Schedule> {
        if let Some(schedule) = self.done.get(&Rc::as_ptr(unit)) {
            return Rc::clone(schedule);
        }
        let children: BTreeMap<usize, Rc<Schedule>> = unit
            .nodes
            .iter()
            .enumerate()
            .filter_map(|(i, n)| match &n.op {
                Op::Instance(child) => Some((i, self.schedule(child))),
                _ => None,
            })
            .collect();
        let lagged = unit.nodes.iter().any(|n| matches!(&n.op, Op::Choose { lagged } if lagged.contains(&true)));
        let lags = if lagged { 0..MOST_LAG } else { 0..1 };
        let schedule = lags
            .map(|lag| Pass {
                device: self.device,
                period: self.period,
                unit,
                children: &children,
                users: users(unit),
                lag,
            })
            .find_map(|pass| pass.run())
            .unwrap_or_else(|| panic!("unit {}: lagged legs depend on themselves", unit.name));
        let schedule = Rc::new(schedule);
        self.done.insert(Rc::as_ptr(unit), Rc::clone(&schedule));
        schedule
    }
}

/// The making of one schedule.
pub(super) struct Pass<'a> {
    pub(super) device: &'static Device,
    period: f64,
    pub(super) unit: &'a Rc<Unit>,
    pub(super) children: &'a BTreeMap<usize, Rc<Schedule>>,
    /// The nodes that have each node as operand.
    pub(super) users: Vec<Vec<usize>>,
    lag: i32,
}

/// What a node needs of an operand: the value in this clock, and whether straight from a register.
struct Arrival {
    clock: i32,
    ns: f64,
    until: i32,
}

/// What is asked of a node beyond its operands: a start that is not earlier, and for choices legs that arrive no later.
#[derive(Clone, Copy)]
struct Wish {
    start: i32,
    ns: f64,
    /// Whether a per-pair value is made from captured operands.
    captured: bool,
}

const NO_WISH: Wish = Wish { start: i32::MIN, ns: f64::INFINITY, captured: false };

impl Pass<'_> {
    pub(super) fn launch(&self) -> f64 {
        self.device.launch()
    }

    pub(super) fn fits(&self, ns: f64) -> bool {
        ns + self.device.setup() <= self.period + 1e-9
    }

    pub(super) fn interval(&self) -> i32 {
        self.unit.interval as i32
    }

    pub(super) fn lag_clocks(&self) -> i32 {
        self.lag * self.interval()
    }

    /// Runs the pass; none if a lagged leg is not there in time.
    fn run(&self) -> Option<Schedule> {
        let earliest = self.slots(&vec![NO_WISH; self.unit.nodes.len()]);
        if !self.lagged_legs_arrive(&earliest) {
            return None;
        }
        let (latency, output_ns) = self.latency(&earliest);
        let (programme, variables) = Constraints::collect(self, &earliest, latency, output_ns);
        let mut starts = vec![0; programme.variables.len()];
        for (slot, variable) in earliest.iter().zip(&variables) {
            variable.iter().for_each(|v| starts[*v] = slot.start);
        }
        let best = programme.optimise(&starts);
        let wish = |(slot, variable): (&Slot, &Option<usize>)| Wish {
            start: variable.map_or(i32::MIN, |v| best[v]),
            ns: slot.ns,
            captured: slot.registered && slot.until != i32::MAX,
        };
        let wishes: Vec<Wish> = earliest.iter().zip(&variables).map(wish).collect();
        let slots = self.slots(&wishes);
        let as_wished = slots.iter().zip(&variables).all(|(slot, v)| v.is_none_or(|v| slot.start == best[v]));
        // What the programme does not see (windows of values made from many) may push a node back: then nothing moves.
        let (slots, starts) =
            if as_wished && self.lagged_legs_arrive(&slots) { (slots, best) } else { (earliest, starts) };
        let register_bits = programme.cost(&starts);
        Some(self.schedule(slots, programme, register_bits))
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
        let outputs = || self.unit.outputs.iter().map(|o| slots[o.1.0]);
        let latency = outputs().map(|s| s.from).max().unwrap_or(0).max(0);
        let late = outputs().filter(|s| s.from == latency);
        (latency, late.map(|s| s.ns).fold(self.launch(), f64::max))
    }

    fn schedule(&self, slots: Vec<Slot>, programme: Programme, register_bits: u64) -> Schedule {
        let unit = self.unit;
        let (latency, output_ns) = self.latency(&slots);
        // Every node that starts in clock 0 lies on a path from the inputs to the first register.
        let path = |i: usize| match self.children.get(&i) {
            Some(child) if slots[i].start == 0 && child.latency > 0 => self.arrival(i, &slots, 0).ns + child.input_path,
            _ if slots[i].from == 0 => slots[i].ns,
            // With registers behind it an operation leaves nothing of the period to what comes before.
            None if slots[i].start == 0 && !matches!(unit.nodes[i].op, Op::Hold { .. } | Op::Output(_)) => self.period,
            _ => self.launch(),
        };
        let input_path = (0..slots.len()).map(path).fold(self.launch(), f64::max) - self.launch();
        let mut critical = (0.0, String::new());
        for (i, slot) in slots.iter().enumerate() {
            let ns = match &unit.nodes[i].op {
                Op::Choose { .. } if slot.from > slot.start => slot.ns.max(self.launch() + self.device.mux(GROUP)),
                _ => slot.ns,
            };
            if ns > critical.0 {
                critical = (ns, format!("{}.{}", unit.name, unit.nodes[i].name));
            }
        }
        for child in self.children.values() {
            if child.critical.0 > critical.0 || (child.critical.0 == critical.0 && child.critical.1 < critical.1) {
                critical = child.critical.clone();
            }
        }
        Schedule {
            unit: Rc::clone(unit),
            slots,
            latency,
            input_path,
            output_ns,
            lag: self.lag,
            critical,
            programme,
            register_bits,
            children: self.children.clone(),
        }
    }

    fn place(&self, i: usize, slots: &[Slot], wish: Wish) -> Slot {
        let node = &self.unit.nodes[i];
        let interval = self.interval();
        match &node.op {
            Op::Input => {
                let until = if node.rate == Rate::Pair { interval } else { i32::MAX };
                Slot { start: 0, from: 0, until, ns: self.launch(), registered: false }
            }
            Op::Constant(_) => Slot::ALWAYS,
            _ if self.unit.renames(i) => slots[node.args[0].0],
            Op::Phase(..) => Slot { ns: self.launch(), ..Slot::ALWAYS },
            Op::Hold { phase, lagged } => {
                let arg = slots[node.args[0].0];
                let lag = if *lagged { self.lag * interval } else { 0 };
                let from = arg.from + *phase as i32 + 1 + lag;
                Slot { start: from - 1, from, until: from + interval, ns: self.launch(), registered: false }
            }
            Op::Choose { lagged } => self.place_choose(i, lagged, slots, wish),
            Op::Output(_) => {
                let instance = slots[node.args[0].0];
                let until = if node.rate == Rate::Pair { instance.until } else { i32::MAX };
                Slot { until, ..instance }
            }
            Op::Instance(_) => {
                let child = &self.children[&i];
                let arrival = self.arrival(i, slots, if wish.captured { i32::MIN } else { wish.start });
                let (start, ns, registered) = self.start(&arrival, child.input_path, wish);
                let ns = if child.latency == 0 { ns } else { child.output_ns };
                let until = arrival.until.saturating_add(child.latency);
                let captured = registered && arrival.until != i32::MAX;
                let until = if captured { start + interval + child.latency } else { until };
                Slot { start, from: start + child.latency, until, ns, registered }
            }
            op => {
                let types: Vec<Type> = node.args.iter().map(|a| self.unit.node(*a).ty).collect();
                let delay = delay(self.device, op, &types, node.ty);
                let arrival = self.arrival(i, slots, if wish.captured { i32::MIN } else { wish.start });
                if arrival.clock == i32::MIN {
                    return Slot { ns: self.launch() + delay, ..Slot::ALWAYS };
                }
                if matches!(op, Op::Multiply) {
                    let registers = self.registers(delay).max(1);
                    let wait = i32::from(arrival.ns > self.launch());
                    let start = arrival.clock + wait;
                    let from = start + registers;
                    return Slot { start, from, until: i32::MAX, ns: self.device.product_launch(), registered: true };
                }
                let (start, ns, registered) = self.start(&arrival, delay, wish);
                let registers = if self.fits(ns) { 0 } else { self.registers(delay) };
                let ns = if registers == 0 { ns } else { self.launch() };
                let until = if registered { start.saturating_add(interval) } else { arrival.until };
                let until = if node.rate == Rate::Pair { until.saturating_add(registers) } else { i32::MAX };
                Slot { start, from: start + registers, until, ns, registered }
            }
        }
    }

    /// Registers behind an operation that takes `delay` from registers: one a period it spans.
    fn registers(&self, delay: f64) -> i32 {
        ((self.launch() + delay + self.device.setup()) / self.period).ceil() as i32
    }

    /// Start clock, arrival of the result and whether the operands are registered for it.
    fn start(&self, arrival: &Arrival, delay: f64, wish: Wish) -> (i32, f64, bool) {
        if wish.captured {
            (wish.start, self.launch() + delay, true)
        } else if self.fits(arrival.ns + delay) || arrival.ns <= self.launch() {
            (arrival.clock, arrival.ns + delay, false)
        } else {
            (arrival.clock + 1, self.launch() + delay, true)
        }
    }

    /// When the last operand of a node arrives, or where that is later, clock `least`.
    fn arrival(&self, i: usize, slots: &[Slot], least: i32) -> Arrival {
        let node = &self.unit.nodes[i];
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

    /// Whether a choice among that many legs takes two clocks.
    pub(super) fn divides(&self, legs: usize) -> bool {
        legs > GROUP && !self.fits(self.launch() + self.device.mux(legs))
    }

    /// Delay of a choice among that many legs from its legs, or from its inner registers, to its output.
    pub(super) fn choice(&self, legs: usize) -> f64 {
        self.device.mux(if self.divides(legs) { legs.div_ceil(GROUP) } else { legs })
    }

    fn place_choose(&self, i: usize, lagged: &[bool], slots: &[Slot], wish: Wish) -> Slot {
        let node = &self.unit.nodes[i];
        let delay = self.choice(lagged.len());
        let divided = self.divides(lagged.len());
        let mut clock = wish.start.max(0);
        loop {
            let (mut ready, mut ns) = (clock, self.launch());
            for (leg, is_lagged) in lagged.iter().enumerate() {
                let Some((first, last)) = leg_phases(self.unit, i, leg).filter(|_| !is_lagged) else { continue };
                let slot = slots[node.args[1 + leg].0];
                if slot.from == i32::MIN {
                    continue;
                }
                let per_pair = slot.until != i32::MAX;
                // A value that leaves too little of the period for the choice, or of its window for the last phase
                // it is read in, is captured first.
                let outlives = !per_pair || clock + (last as i32) < slot.until;
                let in_time = if divided {
                    slot.ns <= self.launch()
                } else {
                    self.fits(slot.ns + delay) && slot.ns + delay <= wish.ns + 1e-9
                };
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

    fn lagged_legs_arrive(&self, slots: &[Slot]) -> bool {
        self.unit.nodes.iter().enumerate().all(|(i, node)| {
            let Op::Choose { lagged } = &node.op else { return true };
            lagged.iter().enumerate().filter(|l| *l.1).all(|(leg, _)| {
                let Some((first, last)) = leg_phases(self.unit, i, leg) else { return true };
                let slot = slots[node.args[1 + leg].0];
                let read = |phase: usize| slots[i].start + phase as i32 + self.lag * self.interval();
                let direct = slot.ns <= self.launch() && read(last) < slot.until;
                slot.from + i32::from(!direct) <= read(first)
            })
        })
    }
}

/// The nodes that have each node as operand.
fn users(unit: &Unit) -> Vec<Vec<usize>> {
    let mut users = vec![vec![]; unit.nodes.len()];
    for (i, node) in unit.nodes.iter().enumerate() {
        for arg in &node.args {
            users[arg.0].push(i);
        }
    }
    users
}

/// Delay of an operation from its inputs to its output, nets before it included, ns. Wires take no time.
pub(super) fn delay(device: &Device, op: &Op, args: &[Type], result: Type) -> f64 {
    let widest = args.iter().map(|a| a.bits).max().unwrap_or(0);
    match op {
        Op::Add | Op::Subtract | Op::Negate => device.chain(result.bits),
        Op::NegateIf | Op::Magnitude => device.conditional_negation(result.bits),
        Op::Equal => device.comparison(widest),
        Op::Clamp(..) => device.comparison(widest) + device.mux(2),
        Op::Multiply => device.product(result.bits),
        Op::And | Op::Or | Op::Not | Op::ScanOr => device.tree(2),
        Op::AnyBit => device.tree(widest),
        Op::Select => device.mux(args.len() - 1),
        Op::Lookup(..) => device.tree(args[0].bits),
        Op::Input
        | Op::Constant(_)
        | Op::SignBit
        | Op::Floor(_)
        | Op::Append(_)
        | Op::LowBits(_)
        | Op::Resize(_)
        | Op::Reinterpret(_)
        | Op::Assert(..)
        | Op::Fact(_)
        | Op::Concatenate
        | Op::Phase(..)
        | Op::Hold { .. }
        | Op::Choose { .. }
        | Op::Instance(_)
        | Op::Output(_) => 0.0,
    }
}

/// First and last phase in which a leg of a choice is read, if any.
pub fn leg_phases(unit: &Unit, choose: usize, leg: usize) -> Option<(usize, usize)> {
    let select = &unit.node(unit.nodes[choose].args[0]).op;
    let mut phases = (0..unit.interval).filter(|s| pattern(select, *s) == Some(leg));
    let first = phases.next()?;
    Some((first, phases.next_back().unwrap_or(first)))
}
