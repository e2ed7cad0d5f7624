//! Lowering: a scheduled block becomes a module, every wait a register.
//!
//! Names: a value delayed by n clocks is `name_d<n>`, a per-pair value captured again n clocks later is `name_h<n>`, a
//! constant of each phase read from phase p of the slot on is `name_at_<p>`, and the strobe of phase p is element p of
//! `strobe`. A multiplexer that takes two clocks chooses among the operands of each group (`name_group_<g>`) by
//! `select_in_group_at_<p>`, then among the groups by `select_group_at_<p>`.
//!
//! A slot without a pair leaves products at rest if the inputs rest: what selects moves on only while `busy_<n>` is set,
//! which is from the clock before clock n of a pair on, for a slot, and there are strobes only while some pair is in the
//! data path.
//!
//! Where a multiplexer chooses among values captured of one stream, and the device has delay lines with a tap, it becomes such
//! a line (`{name}_line`), which is read at `select_tap_at_<p>` clocks: one look-up table per bit in place of a register for
//! each value and two or three tables.

mod multiplexer;
mod phases;
mod sections;
mod tapped_line;

use self::multiplexer::Digits;
use super::module::{Driver, Home, Instance, Module, Signal, SignalId};
use crate::device::Device;
use crate::graph::{Block, Op, Place, Rate, Step};
use crate::op::{Comb, Or, Type};
use crate::schedule::{Schedule, Scheduler};
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::rc::Rc;

/// The port by which what has phases hears of them.
pub const PHASE: &str = "phase";
/// The port that tells which slots in flight hold a pair: element k of the slot that began k slots before the running one.
pub const HOLDS: &str = "holds";

/// What the names of outputs begin with that bring a node out.
// For the designs of the unit.
#[doc(hidden)]
pub const PROBE: &str = "probe_";

/// A node brought out for comparison.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Probe {
    /// Name of the node.
    pub name: String,
    /// Type.
    pub ty: Type,
    /// Whether there is a value in each phase.
    pub per_phase: bool,
    /// Phases with a meaning, each with the clock of its value relative to phase 0 of the block's inputs.
    pub clocks: Vec<(usize, i32)>,
}

/// Lowers scheduled blocks to modules, each block once.
pub struct Lowering<'a> {
    scheduler: &'a mut Scheduler,
    device: &'static Device,
    done: HashMap<*const Block, Rc<Module>>,
    /// Delay lines with a tap, by sign and bits of what they delay.
    lines: HashMap<(bool, u32), Rc<Module>>,
}

impl<'a> Lowering<'a> {
    /// Lowers for the scheduler's device and clock.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// # let library = Library::default();
    /// # let block = library.block("square", &[], 1, |top| {
    /// #     let x = top.input(NUMBER, (-9, 9)).named("x");
    /// #     (x * x).named("y")
    /// # });
    /// let device = device::find("xc2v6000-4")?;
    /// let mut scheduler = Scheduler::new(device, 100);
    /// let (module, _) = Lowering::new(&mut scheduler, device).lower(&block, false);
    /// assert_eq!(module.register_bits(), 32);
    /// # Ok::<(), device::DeviceError>(())
    /// ```
    pub fn new(scheduler: &'a mut Scheduler, device: &'static Device) -> Self {
        Self { scheduler, device, done: HashMap::new(), lines: HashMap::new() }
    }

    /// The module of a block; `probed` brings out the nodes the block marks.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// # let library = Library::default();
    /// # let block = library.block("square", &[], 1, |top| {
    /// #     let x = top.input(NUMBER, (-9, 9)).named("x");
    /// #     (x * x).named("y")
    /// # });
    /// let device = device::find("xc2v6000-4")?;
    /// let mut scheduler = Scheduler::new(device, 100);
    /// let (module, probes) = Lowering::new(&mut scheduler, device).lower(&block, true);
    /// assert_eq!((module.latency, probes.len()), (Some(1), 0));
    /// # Ok::<(), device::DeviceError>(())
    /// ```
    pub fn lower(&mut self, block: &Rc<Block>, probed: bool) -> (Rc<Module>, Vec<Probe>) {
        let schedule = self.scheduler.schedule(block);
        let block = &schedule.block;
        let mut modules = HashMap::new();
        for (i, node) in block.nodes.iter().enumerate() {
            let Op::Instance(child) = &node.op else { continue };
            let key = Rc::as_ptr(child);
            let known = self.done.get(&key).cloned();
            let module = known.unwrap_or_else(|| self.lower(child, false).0);
            self.done.insert(key, Rc::clone(&module));
            modules.insert(i, module);
        }
        let out = Module::new(&block.name, block.doc.clone());
        let lowered = Lowered {
            block: Rc::clone(block),
            schedule: &schedule,
            modules: &modules,
            device: self.device,
            out,
            base: vec![None; block.nodes.len()],
            copies: BTreeMap::new(),
            strobes: vec![],
            selects: BTreeMap::new(),
            read: BTreeMap::new(),
            phase: None,
            holds: vec![],
            busy: BTreeMap::new(),
            either: BTreeMap::new(),
            instances: HashMap::new(),
            lines: &mut self.lines,
            taps: HashMap::new(),
        };
        lowered.run(probed)
    }
}

struct Lowered<'a> {
    block: Rc<Block>,
    schedule: &'a Schedule,
    modules: &'a HashMap<usize, Rc<Module>>,
    device: &'static Device,
    out: Module,
    /// The signal of each node in the clock in which its value is first there.
    base: Vec<Option<SignalId>>,
    /// Later copies, by the signal that carries a value first, whether it follows that from clock to clock, and clocks after it.
    copies: BTreeMap<(SignalId, bool, i32), SignalId>,
    strobes: Vec<SignalId>,
    selects: BTreeMap<(usize, i32, Digits), SignalId>,
    /// The clocks in which the uses of what selects begin.
    read: BTreeMap<SignalId, BTreeSet<i32>>,
    phase: Option<SignalId>,
    /// Which slots in flight hold a pair, by their age.
    holds: Vec<SignalId>,
    /// Flags of pairs in the clocks from one on.
    busy: BTreeMap<i32, SignalId>,
    either: BTreeMap<[SignalId; 2], SignalId>,
    /// Number in the module of each instance.
    instances: HashMap<usize, usize>,
    lines: &'a mut HashMap<(bool, u32), Rc<Module>>,
    /// Taps of delay lines, by index of the multiplexer, phase of its first use, and what they are in each phase of the slot.
    taps: HashMap<(usize, i32, Vec<i32>), SignalId>,
}

impl Lowered<'_> {
    fn interval(&self) -> i32 {
        self.block.interval as i32
    }

    fn run(mut self, probed: bool) -> (Rc<Module>, Vec<Probe>) {
        let block = Rc::clone(&self.block);
        if block.phased() {
            let latency = self.schedule.latency;
            let mut port = |place: Place, ty, comment: &str| {
                let port = self.push(place, ty, Driver::Port);
                self.out.signals[port.0].comment = comment.to_owned();
                self.out.inputs.push(port);
                port
            };
            let phase = port(
                Place::new(PHASE),
                Type::index(block.interval),
                "phase of the slot: 0 in the first clock of the inputs",
            );
            let place = |age: i32| Place::at(HOLDS, &[Step::Index(age as usize)]);
            // Outputs of every phase leave until the last phase of the slot that begins with the latency.
            let per_phase = block.outputs.iter().any(|(_, node)| block.node(*node).rate == Rate::Phase);
            let last = latency + if per_phase { block.interval as i32 - 1 } else { 0 };
            let ages = 0..=last / block.interval as i32;
            self.holds =
                ages.map(|age| port(place(age), Type::FLAG, "whether the slot k slots ago holds a pair")).collect();
            self.phase = Some(phase);
        }
        for input in &block.inputs {
            let id = self.of_node(input.0, Driver::Port);
            self.out.inputs.push(id);
        }
        // Late operands refer to nodes that come later: everything else first, what has late operands connected last.
        let mut pending = vec![];
        for (i, node) in block.nodes.iter().enumerate() {
            match &node.op {
                Op::Mux { late } if late.contains(&true) => pending.push((i, self.reserve_mux(i))),
                _ => self.node(i),
            }
        }
        for (i, id) in pending {
            let operands = self.mux_operands(i);
            self.connect_mux(i, id, operands);
        }
        let latency = self.schedule.latency;
        for (place, node) in &block.outputs {
            let id = self.fetch(node.0, latency);
            self.out.outputs.push((place.clone(), id));
        }
        let probes = if probed { self.probes() } else { vec![] };
        self.rest();
        self.out.latency = Some(latency);
        (Rc::new(sections::divided(self.out.pruned(), &block.sections)), probes)
    }

    fn probes(&mut self) -> Vec<Probe> {
        let block = Rc::clone(&self.block);
        let mut probes = vec![];
        for probe in &block.probes {
            let (i, slot, node) = (probe.node.0, self.schedule.slots[probe.node.0], block.node(probe.node));
            let Some(id) = self.base[i] else { continue };
            let per_phase = node.rate == Rate::Phase;
            let name = node.name();
            self.out.outputs.push((Place::new(format!("{PROBE}{name}")), id));
            let clock = |(phase, late): &(usize, bool)| {
                let lag = if *late { self.schedule.lag_clocks() } else { 0 };
                // A constant is there at any time.
                let from = slot.from.max(0);
                (*phase, from + if per_phase { *phase as i32 + lag } else { 0 })
            };
            let clocks = probe.phases.iter().map(clock).collect();
            probes.push(Probe { name, ty: node.ty, per_phase, clocks });
        }
        probes
    }

    fn push(&mut self, place: Place, ty: Type, driver: Driver) -> SignalId {
        let (comment, range, clock, home) = (String::new(), None, None, Home::default());
        self.out.signals.push(Signal { place, named: true, ty, driver, comment, range, clock, home });
        SignalId(self.out.signals.len() - 1)
    }

    /// The signal of a node.
    fn of_node(&mut self, i: usize, driver: Driver) -> SignalId {
        let node = &self.block.nodes[i];
        let (place, named, ty) = (node.place.clone(), node.named, node.ty);
        let home = node.section.map_or(Home::Block, Home::Section);
        let id = self.push(place, ty, driver);
        (self.out.signals[id.0].named, self.out.signals[id.0].home) = (named, home);
        let slot = self.schedule.slots[i];
        self.describe(id, i, (slot.from != i32::MIN).then_some(slot.from));
        self.base[i] = Some(id);
        id
    }

    fn describe(&mut self, id: SignalId, node: usize, clock: Option<i32>) {
        let signal = &mut self.out.signals[id.0];
        signal.comment.clone_from(&self.block.nodes[node].comment);
        signal.range = Some(self.block.range(node));
        signal.clock = clock;
    }

    fn register(&mut self, place: Place, ty: Type, from: SignalId, enable: Option<SignalId>) -> SignalId {
        self.push(place, ty, Driver::Register { op: None, args: vec![from], enable, reset: None })
    }

    /// Computes node `i` from its operands.
    fn node(&mut self, i: usize) {
        let block = Rc::clone(&self.block);
        let node = &block.nodes[i];
        let slot = self.schedule.slots[i];
        match &node.op {
            Op::Input | Op::Steady | Op::Phase(..) | Op::Earlier(_) => {}
            _ if block.renames(i) => self.rename(i),
            Op::Capture { phase, late } => {
                let arg = node.args[0].0;
                let lag = if *late { self.schedule.lag_clocks() } else { 0 };
                let from = self.schedule.slots[arg].from.max(0);
                let enable = self.strobe(from + *phase as i32 + lag);
                let args = vec![self.fetch(arg, from)];
                self.of_node(i, Driver::Register { op: None, args, enable, reset: None });
            }
            Op::Mux { .. } => {
                if let Some(delays) = self.delays(i) {
                    self.tapped(i, &delays);
                    return;
                }
                let operands = self.mux_operands(i);
                if slot.from == slot.start && operands.iter().all(|o| *o == operands[0]) {
                    // One signal in all phases: nothing to choose.
                    self.base[i] = Some(operands[0]);
                } else {
                    let id = self.reserve_mux(i);
                    self.connect_mux(i, id, operands);
                }
            }
            Op::ScanOr => {
                let value = self.fetch(node.args[0].0, slot.start);
                // What it held is gone in the clock in which it starts anew.
                let reset = Some((self.fetch(node.args[1].0, slot.start - 1), 0));
                let so_far = self.register(node.place.suffixed("before"), node.ty, value, None);
                let id = self.of_node(i, Driver::Combinational { op: Or.into(), args: vec![value, so_far] });
                self.out.signals[so_far.0].driver = Driver::Register { op: None, args: vec![id], enable: None, reset };
            }
            Op::Instance(_) => {
                let inputs = node.args.iter().map(|a| self.operand(a.0, slot.start, slot.registered)).collect();
                let module = Rc::clone(&self.modules[&i]);
                self.instances.insert(i, self.out.instances.len());
                self.out.instances.push(Instance { place: node.place.clone(), module, inputs });
            }
            Op::Output(port) => {
                let instance = self.instances[&node.args[0].0];
                self.of_node(i, Driver::Instance { instance, port: *port });
            }
            Op::Comb(op) => {
                let args: Vec<SignalId> =
                    node.args.iter().map(|a| self.operand(a.0, slot.start, slot.registered)).collect();
                let registers = if slot.from == i32::MIN { 0 } else { slot.from - slot.start };
                if registers == 0 {
                    self.of_node(i, Driver::Combinational { op: op.clone(), args });
                    return;
                }
                let op = Some(op.clone()).filter(|op| !matches!(op, Comb::Delay(_)));
                let driver = Driver::Register { op, args, enable: None, reset: None };
                if registers == 1 {
                    self.of_node(i, driver);
                    return;
                }
                // The operation and its first register, then the others.
                let mut last = self.push(node.place.suffixed("r0"), node.ty, driver);
                self.describe(last, i, Some(slot.start + 1));
                for r in 1..registers - 1 {
                    last = self.register(node.place.suffixed(&format!("r{r}")), node.ty, last, None);
                    self.describe(last, i, Some(slot.start + r + 1));
                }
                self.of_node(i, Driver::Register { op: None, args: vec![last], enable: None, reset: None });
            }
            Op::Assume(..) | Op::Known(_) | Op::Point => {}
        }
    }

    /// Knowledge, not hardware; what is known of the value is said where it is declared.
    fn rename(&mut self, i: usize) {
        let block = Rc::clone(&self.block);
        let node = &block.nodes[i];
        let Some(id) = self.base[node.args[0].0] else { return };
        self.base[i] = Some(id);
        let signal = &mut self.out.signals[id.0];
        signal.range = Some(block.range(i));
        signal.ty.fraction = node.ty.fraction;
        if !node.comment.is_empty() {
            signal.comment.clone_from(&node.comment);
        }
        // A name is taken from what has none.
        if node.named && !signal.named {
            (signal.place, signal.named) = (node.place.clone(), true);
        }
    }

    /// An operand consumed in one clock.
    fn operand(&mut self, arg: usize, clock: i32, registered: bool) -> SignalId {
        let slot = self.schedule.slots[arg];
        let per_pair = slot.from != i32::MIN && slot.until != i32::MAX;
        // The scheduler counts on a whole interval from here.
        let lasts = slot.until >= clock.saturating_add(self.interval());
        if per_pair && registered && (slot.ns > self.device.launch() || !lasts) {
            return self.hold(arg, clock, clock);
        }
        self.fetch(arg, clock)
    }

    /// The value of a node as it is in a clock.
    fn fetch(&mut self, i: usize, clock: i32) -> SignalId {
        self.fetch_earlier(i, clock, 0)
    }

    /// The value of a node as it was some phases before a clock.
    fn fetch_earlier(&mut self, i: usize, clock: i32, phases: usize) -> SignalId {
        let i = self.block.carrier(i);
        let slot = self.schedule.slots[i];
        let (used, clock) = (clock, clock.saturating_add(phases as i32));
        match &self.block.nodes[i].op {
            Op::Phase(..) => return self.select(i, clock, used, Digits::All),
            Op::Earlier(more) => return self.fetch_earlier(self.block.nodes[i].args[0].0, used, phases + more),
            _ => {}
        }
        let base = self.base[i].expect("operands come first");
        if slot.from == i32::MIN || clock == slot.from {
            return base;
        }
        assert!(clock > slot.from, "{}: {} is read before it is there", self.block.name, self.block.nodes[i].name());
        if slot.until == i32::MAX {
            return self.delayed(i, clock - slot.from);
        }
        if clock < slot.until {
            return base;
        }
        self.hold(i, clock, clock)
    }

    fn delayed(&mut self, i: usize, clocks: i32) -> SignalId {
        let base = self.base[i].expect("operands come first");
        if clocks == 0 {
            return base;
        }
        if let Some(id) = self.copies.get(&(base, self.follows('d'), clocks)) {
            return *id;
        }
        let before = self.delayed(i, clocks - 1);
        self.copy(i, clocks, 'd', before, None)
    }

    fn copy(&mut self, i: usize, clocks: i32, kind: char, from: SignalId, enable: Option<SignalId>) -> SignalId {
        // A copy is called after the signal, which may have a name that its node has not.
        let base = self.base[i].expect("operands come first");
        let place = self.out.signal(base).place.suffixed(&format!("{kind}{clocks}"));
        let id = self.register(place, self.block.nodes[i].ty, from, enable);
        self.describe(id, i, Some(self.schedule.slots[i].from + clocks));
        let signal = &mut self.out.signals;
        signal[id.0].ty = signal[base.0].ty;
        signal[id.0].comment.clear();
        self.copies.insert((base, self.follows(kind), clocks), id);
        id
    }

    /// Whether a copy of a kind follows what it is made of from clock to clock. One signal may be a value of the pair that is there for
    /// a clock, and what is chosen in a phase: the register behind that is no hold. With one phase both are the same.
    fn follows(&self, kind: char) -> bool {
        kind == 'd' && self.interval() > 1
    }

    /// A per-pair value captured again so that its window begins in clock `earliest` to `latest`.
    fn hold(&mut self, i: usize, earliest: i32, latest: i32) -> SignalId {
        let i = self.block.carrier(i);
        let slot = self.schedule.slots[i];
        let base = self.base[i].expect("operands come first");
        let hold = self.follows('h');
        let known =
            self.copies.range((base, hold, earliest - slot.from)..=(base, hold, latest - slot.from)).next_back();
        if let Some((_, id)) = known {
            return *id;
        }
        let mut source = base;
        let (mut from, mut until) = (slot.from, slot.until);
        loop {
            let at = until.min(latest);
            let name = || self.block.nodes[i].name();
            assert!(at > from, "{}: {} cannot be held from {earliest} to {latest}: {slot:?}", self.block.name, name());
            let clocks = at - slot.from;
            source = match self.copies.get(&(base, hold, clocks)) {
                Some(id) => *id,
                None => {
                    let enable = self.strobe(at - 1);
                    self.copy(i, clocks, 'h', source, enable)
                }
            };
            if at >= earliest {
                return source;
            }
            (from, until) = (at, at + self.interval());
        }
    }
}
