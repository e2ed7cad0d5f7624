//! Lowering: a scheduled unit becomes a module, every wait a register.
//!
//! Names: a value delayed by n clocks is `name_d<n>`, a per-pair value captured again n clocks later is `name_h<n>`,
//! a phase pattern read from clock c on is `name_at_<c>`, the strobe of phase p is `strobe_<p>`. A choice that takes two
//! clocks chooses among the legs of each group (`name_group_<g>`) by `pattern_in_group_at_<c>`, then among the groups by
//! `pattern_group_at_<c>`.

use super::netlist::{Driver, Module, ModuleBuilder, SignalId};
use super::range::Ranges;
use super::schedule::{GROUP, Schedule, Scheduler, leg_phases};
use super::{Op, Range, Rate, Type, Unit};
use crate::device::Device;
use std::collections::{BTreeMap, HashMap};
use std::rc::Rc;

/// Bits of a phase counter over that many phases.
pub fn phase_bits(interval: usize) -> u32 {
    usize::BITS - (interval.max(2) - 1).leading_zeros()
}

/// A node brought out for comparison.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Probe {
    /// Name of the node.
    pub name: String,
    /// Type.
    pub ty: Type,
    /// Whether there is a value in each phase.
    pub per_phase: bool,
    /// Phases with a meaning, each with the clock of its value relative to phase 0 of the unit's inputs.
    pub clocks: Vec<(usize, i32)>,
}

/// Lowers scheduled units to modules, each unit once.
pub struct Lowering<'a> {
    scheduler: &'a mut Scheduler,
    ranges: &'a Ranges,
    device: &'static Device,
    done: HashMap<*const Unit, Rc<Module>>,
}

impl<'a> Lowering<'a> {
    /// Lowers for the scheduler's device and clock.
    pub fn new(scheduler: &'a mut Scheduler, device: &'static Device, ranges: &'a Ranges) -> Self {
        Self { scheduler, ranges, device, done: HashMap::new() }
    }

    /// The module of a unit; `probed` brings out the nodes the unit marks.
    pub fn lower(&mut self, unit: &Rc<Unit>, probed: bool) -> (Rc<Module>, Vec<Probe>) {
        let schedule = self.scheduler.schedule(unit);
        let children = unit.nodes.iter().enumerate().filter_map(|(i, n)| match &n.op {
            Op::Instance(child) => Some((i, Rc::clone(child))),
            _ => None,
        });
        let mut modules = HashMap::new();
        for (i, child) in children.collect::<Vec<_>>() {
            let key = Rc::as_ptr(&child);
            let module = match self.done.get(&key) {
                Some(module) => Rc::clone(module),
                None => {
                    let module = self.lower(&child, false).0;
                    self.done.insert(key, Rc::clone(&module));
                    module
                }
            };
            modules.insert(i, module);
        }
        let lowered = Lowered {
            unit,
            schedule: &schedule,
            modules: &modules,
            ranges: self.ranges.unit(unit),
            device: self.device,
            out: ModuleBuilder::new(unit.name.clone(), unit.doc.clone()),
            base: vec![None; unit.nodes.len()],
            copies: BTreeMap::new(),
            strobes: BTreeMap::new(),
            patterns: BTreeMap::new(),
            phase: None,
            instances: HashMap::new(),
        };
        lowered.run(probed)
    }
}

/// What is read of a phase pattern.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Digits {
    /// All of it.
    All,
    /// Of the index of a choice, the place of the leg in its group.
    InGroup,
    /// Of the index of a choice, the group.
    Group,
}

struct Lowered<'a> {
    unit: &'a Rc<Unit>,
    schedule: &'a Schedule,
    modules: &'a HashMap<usize, Rc<Module>>,
    ranges: Option<&'a [Option<Range>]>,
    device: &'static Device,
    out: ModuleBuilder,
    base: Vec<Option<SignalId>>,
    copies: BTreeMap<(usize, i32), SignalId>,
    strobes: BTreeMap<i32, SignalId>,
    patterns: BTreeMap<(usize, i32, Digits), SignalId>,
    phase: Option<SignalId>,
    instances: HashMap<usize, Vec<SignalId>>,
}

impl Lowered<'_> {
    fn interval(&self) -> i32 {
        self.unit.interval as i32
    }

    fn run(mut self, probed: bool) -> (Rc<Module>, Vec<Probe>) {
        if self.unit.phased() {
            let ty = Type::unsigned(phase_bits(self.unit.interval));
            let phase = self.out.input("phase", ty);
            self.out.comment(phase, "phase of the slot: 0 in the first clock of the inputs");
            self.phase = Some(phase);
        }
        for input in &self.unit.inputs {
            let node = self.unit.node(input.node);
            let id = self.out.input(&node.name, node.ty);
            self.describe(id, input.node.0, Some(0));
            self.base[input.node.0] = Some(id);
        }
        // Lagged legs refer to nodes that come later: everything else first, choices with lagged legs connected last.
        let mut pending = vec![];
        for i in 0..self.unit.nodes.len() {
            match &self.unit.nodes[i].op {
                Op::Choose { lagged } if lagged.contains(&true) => pending.push((i, self.reserve_choose(i))),
                _ => self.node(i),
            }
        }
        for (i, id) in pending {
            let legs = self.legs(i);
            self.connect_choose(i, id, legs);
        }
        let latency = self.schedule.latency;
        let outputs: Vec<(String, SignalId)> =
            self.unit.outputs.iter().map(|(name, node)| (name.clone(), self.fetch(node.0, latency))).collect();
        for (name, id) in outputs {
            self.out.output(&name, id);
        }
        let mut probes = vec![];
        if probed {
            for (node, phases) in &self.unit.probes {
                let (i, slot) = (node.0, self.schedule.slots[node.0]);
                let Some(id) = self.base[i] else { continue };
                let node = &self.unit.nodes[i];
                let per_phase = node.rate == Rate::Phase;
                self.out.output(&format!("probe_{}", node.name), id);
                let clock = |(phase, lagged): &(usize, bool)| {
                    let lag = if *lagged { self.schedule.lag_clocks() } else { 0 };
                    (*phase, slot.from + if per_phase { *phase as i32 + lag } else { 0 })
                };
                let clocks = phases.iter().map(clock).collect();
                probes.push(Probe { name: node.name.clone(), ty: node.ty, per_phase, clocks });
            }
        }
        let mut module = Rc::try_unwrap(self.out.finish()).expect("not shared yet");
        module.latency = Some(latency);
        (Rc::new(module), probes)
    }

    fn describe(&mut self, id: SignalId, node: usize, clock: Option<i32>) {
        let signal = &mut self.out.module.signals[id.0];
        signal.comment = self.unit.nodes[node].comment.clone();
        if let Some(range) = self.ranges.and_then(|r| r[node]) {
            signal.range = Some(range);
        }
        signal.clock = clock;
    }

    /// Computes node `i` and everything it needs.
    fn node(&mut self, i: usize) {
        let unit = Rc::clone(self.unit);
        let node = &unit.nodes[i];
        let slot = self.schedule.slots[i];
        let id = match &node.op {
            Op::Input | Op::Phase(..) => return,
            _ if unit.renames(i) => {
                // Knowledge, not hardware; what is known of the value is said where it is declared.
                let id = self.base[node.args[0].0].expect("operands come first");
                self.base[i] = Some(id);
                if let Some(range) = self.ranges.and_then(|r| r[i]) {
                    self.out.module.signals[id.0].range = Some(range);
                }
                if !node.comment.is_empty() {
                    self.out.module.signals[id.0].comment = node.comment.clone();
                }
                return;
            }
            Op::Constant(value) => self.out.constant(&node.name, *value, node.ty),
            Op::Hold { phase, lagged } => {
                let arg = node.args[0].0;
                let lag = if *lagged { self.schedule.lag_clocks() } else { 0 };
                let clock = self.schedule.slots[arg].from + *phase as i32 + lag;
                let args = vec![self.base[arg].expect("streams come first")];
                let enable = self.strobe(clock);
                self.out.push(&node.name, node.ty, Driver::Register { op: None, args, enable, reset: None })
            }
            Op::Choose { .. } => {
                let legs = self.legs(i);
                if slot.from == slot.start && legs.iter().all(|l| *l == legs[0]) {
                    // One signal in all phases: no choice to be made.
                    self.base[i] = Some(legs[0]);
                    return;
                }
                let id = self.reserve_choose(i);
                self.connect_choose(i, id, legs);
                return;
            }
            Op::ScanOr => {
                let args: Vec<SignalId> = node.args.iter().map(|a| self.fetch(a.0, slot.start)).collect();
                let so_far = self.out.register(&format!("{}_so_far", node.name), node.ty);
                let zero = self.out.constant(&format!("{}_zero", node.name), 0, node.ty);
                let kept = self.out.op(&format!("{}_kept", node.name), Op::Select, &[args[1], so_far, zero]);
                let id = self.out.op(&node.name, Op::Or, &[args[0], kept]);
                self.out.drive(so_far, id, None, None);
                id
            }
            Op::Instance(_) => {
                let mut inputs: Vec<SignalId> = vec![];
                for a in &node.args {
                    inputs.push(self.operand(a.0, slot.start, slot.registered));
                }
                let module = Rc::clone(&self.modules[&i]);
                let outputs = self.out.instance(&node.name, &module, &inputs);
                self.instances.insert(i, outputs);
                return;
            }
            Op::Output(port) => {
                let id = self.instances[&node.args[0].0][*port];
                self.describe_output(id, i, slot.from);
                self.base[i] = Some(id);
                return;
            }
            op => {
                let args: Vec<SignalId> =
                    node.args.iter().map(|a| self.operand(a.0, slot.start, slot.registered)).collect();
                let op = op.clone();
                let registers = if slot.from == i32::MIN { 0 } else { slot.from - slot.start };
                if registers == 0 {
                    self.out.push(&node.name, node.ty, Driver::Combinational { op, args })
                } else {
                    let first = Driver::Register { op: Some(op), args, enable: None, reset: None };
                    let mut id = self.out.push(&node.name, node.ty, first);
                    for r in 1..registers {
                        self.describe(id, i, Some(slot.start + r));
                        let copy = Driver::Register { op: None, args: vec![id], enable: None, reset: None };
                        id = self.out.push(&format!("{}_r{r}", node.name), node.ty, copy);
                    }
                    id
                }
            }
        };
        self.describe(id, i, (slot.from != i32::MIN).then_some(slot.from));
        self.base[i] = Some(id);
    }

    fn describe_output(&mut self, id: SignalId, node: usize, clock: i32) {
        let signal = &mut self.out.module.signals[id.0];
        signal.comment = self.unit.nodes[node].comment.clone();
        signal.clock = Some(clock);
    }

    fn reserve_choose(&mut self, i: usize) -> SignalId {
        let node = &self.unit.nodes[i];
        let driver = Driver::Combinational { op: Op::Select, args: vec![] };
        let id = self.out.push(&node.name, node.ty, driver);
        self.describe(id, i, Some(self.schedule.slots[i].from));
        self.base[i] = Some(id);
        id
    }

    fn connect_choose(&mut self, i: usize, id: SignalId, legs: Vec<SignalId>) {
        let (select, slot) = (self.unit.nodes[i].args[0].0, self.schedule.slots[i]);
        let (select, legs) = if slot.from == slot.start {
            (self.fetch(select, slot.start), legs)
        } else {
            let groups = self.groups(i, &legs);
            (self.pattern(select, slot.from, Digits::Group), groups)
        };
        let args = std::iter::once(select).chain(legs).collect();
        self.out.module.signals[id.0].driver = Driver::Combinational { op: Op::Select, args };
    }

    /// The first of the two clocks of a choice: the chosen leg of each group, registered.
    fn groups(&mut self, i: usize, legs: &[SignalId]) -> Vec<SignalId> {
        let (node, slot) = (&self.unit.nodes[i], self.schedule.slots[i]);
        let (name, ty, select) = (node.name.clone(), node.ty, node.args[0].0);
        let mut chosen = vec![];
        for (group, legs) in legs.chunks(GROUP).enumerate() {
            let (op, args) = if legs.iter().all(|l| *l == legs[0]) {
                (None, vec![legs[0]])
            } else {
                let index = self.pattern(select, slot.start, Digits::InGroup);
                (Some(Op::Select), std::iter::once(index).chain(legs.iter().copied()).collect())
            };
            let driver = Driver::Register { op, args, enable: None, reset: None };
            let id = self.out.push(&format!("{name}_group_{group}"), ty, driver);
            self.describe(id, i, Some(slot.from));
            let (first, last) = (group * GROUP, group * GROUP + legs.len() - 1);
            let which = if first == last { format!("leg {first}") } else { format!("legs {first} to {last}") };
            self.out.module.signals[id.0].comment = format!("{which} of {name}");
            chosen.push(id);
        }
        chosen
    }

    /// The legs of a choice, each as it is in the clocks in which it is read.
    fn legs(&mut self, i: usize) -> Vec<SignalId> {
        let unit = Rc::clone(self.unit);
        let node = &unit.nodes[i];
        let Op::Choose { lagged } = &node.op else { unreachable!("only choices have legs") };
        let slot = self.schedule.slots[i];
        let lag_clocks = self.schedule.lag_clocks();
        let mut legs = vec![];
        for (leg, is_lagged) in lagged.iter().enumerate() {
            let arg = node.args[1 + leg].0;
            let Some((first, last)) = leg_phases(&unit, i, leg) else {
                // Never read: any leg will do.
                legs.push(None);
                continue;
            };
            let lag = if *is_lagged { lag_clocks } else { 0 };
            let (first, last) = (slot.start + first as i32 + lag, slot.start + last as i32 + lag);
            // The scheduler's own figure: a leg is direct exactly where the scheduler took it to be.
            let limit = slot.latest_leg(self.device, lagged.len(), *is_lagged);
            legs.push(Some(self.leg(arg, slot.start, first, last, limit)));
        }
        let any = legs.iter().flatten().next().copied().expect("some leg is read");
        legs.into_iter().map(|l| l.unwrap_or(any)).collect()
    }

    /// A leg of a choice that starts in clock `start`, read from clock `first` to clock `last`; values that arrive
    /// after `limit` nanoseconds are captured first.
    fn leg(&mut self, arg: usize, start: i32, first: i32, last: i32, limit: f64) -> SignalId {
        let slot = self.schedule.slots[arg];
        if slot.from == i32::MIN || slot.until == i32::MAX {
            return self.fetch(arg, start);
        }
        if slot.ns <= limit + 1e-9 && slot.from <= first && last < slot.until {
            return self.base[arg].expect("operands come first");
        }
        self.hold(arg, last - self.interval() + 1, first)
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

    /// The node that carries the value of node `i` in hardware.
    fn carrier(&self, mut i: usize) -> usize {
        while self.unit.renames(i) {
            i = self.unit.nodes[i].args[0].0;
        }
        i
    }

    /// The value of a node as it is in a clock.
    fn fetch(&mut self, i: usize, clock: i32) -> SignalId {
        let i = self.carrier(i);
        let slot = self.schedule.slots[i];
        if matches!(self.unit.nodes[i].op, Op::Phase(..)) {
            return self.pattern(i, clock, Digits::All);
        }
        let base = self.base[i].expect("operands come first");
        if slot.from == i32::MIN || clock == slot.from {
            return base;
        }
        assert!(clock > slot.from, "{}: {} is read before it is there", self.unit.name, self.unit.nodes[i].name);
        if slot.until == i32::MAX {
            return self.delayed(i, clock - slot.from);
        }
        if clock < slot.until {
            return base;
        }
        self.hold(i, clock, clock)
    }

    fn delayed(&mut self, i: usize, clocks: i32) -> SignalId {
        if clocks == 0 {
            return self.base[i].expect("operands come first");
        }
        if let Some(id) = self.copies.get(&(i, clocks)) {
            return *id;
        }
        let before = self.delayed(i, clocks - 1);
        let name = format!("{}_d{clocks}", self.unit.nodes[i].name);
        self.copy(i, clocks, &name, before, None)
    }

    fn copy(&mut self, i: usize, clocks: i32, name: &str, from: SignalId, enable: Option<SignalId>) -> SignalId {
        let driver = Driver::Register { op: None, args: vec![from], enable, reset: None };
        let id = self.out.push(name, self.unit.nodes[i].ty, driver);
        let clock = self.schedule.slots[i].from + clocks;
        self.describe(id, i, Some(clock));
        self.out.module.signals[id.0].comment = String::new();
        self.copies.insert((i, clocks), id);
        id
    }

    /// A per-pair value captured again so that its window begins in clock `earliest` to `latest`.
    fn hold(&mut self, i: usize, earliest: i32, latest: i32) -> SignalId {
        let i = self.carrier(i);
        let slot = self.schedule.slots[i];
        let known = self.copies.range((i, earliest - slot.from)..=(i, latest - slot.from)).next_back();
        if let Some((_, id)) = known {
            return *id;
        }
        let mut source = self.base[i].expect("operands come first");
        let (mut from, mut until) = (slot.from, slot.until);
        loop {
            let at = until.min(latest);
            assert!(
                at > from,
                "{}: {} cannot be held from {earliest} to {latest}: {slot:?}",
                self.unit.name,
                self.unit.nodes[i].name
            );
            let clocks = at - slot.from;
            source = match self.copies.get(&(i, clocks)) {
                Some(id) => *id,
                None => {
                    let name = format!("{}_h{clocks}", self.unit.nodes[i].name);
                    let enable = self.strobe(at - 1);
                    self.copy(i, clocks, &name, source, enable)
                }
            };
            if at >= earliest {
                return source;
            }
            (from, until) = (at, at + self.interval());
        }
    }

    /// A flag set in the clocks congruent to `clock`; none if that is always.
    fn strobe(&mut self, clock: i32) -> Option<SignalId> {
        let interval = self.interval();
        if interval == 1 {
            return None;
        }
        let at = clock.rem_euclid(interval);
        if let Some(id) = self.strobes.get(&at) {
            return Some(*id);
        }
        let table = (0..interval).map(|p| i128::from((p + 1).rem_euclid(interval) == at)).collect();
        let id = self.table(&format!("strobe_{at}"), table, Type::FLAG);
        self.out.comment(id, format!("set in phase {at}"));
        self.strobes.insert(at, id);
        Some(id)
    }

    /// The values of a phase pattern for a use that starts in `clock`.
    fn pattern(&mut self, i: usize, clock: i32, digits: Digits) -> SignalId {
        let unit = Rc::clone(self.unit);
        let interval = self.interval();
        let at = clock.rem_euclid(interval);
        if let Some(id) = self.patterns.get(&(i, at, digits)) {
            return *id;
        }
        let Op::Phase(values, ty) = &unit.nodes[i].op else { unreachable!("only phase patterns") };
        let group = GROUP as i128;
        let most = values.iter().flatten().max().copied().unwrap_or(0);
        let (part, ty) = match digits {
            Digits::All => ("", *ty),
            Digits::InGroup => ("_in_group", Type::unsigned(phase_bits(GROUP))),
            Digits::Group => ("_group", Type::unsigned(phase_bits((most / group) as usize + 1))),
        };
        let value = |phase: i32| {
            let value = values[phase.rem_euclid(interval) as usize].unwrap_or(0);
            match digits {
                Digits::All => value,
                Digits::InGroup => value % group,
                Digits::Group => value / group,
            }
        };
        let table = (0..interval).map(|p| value(p + 1 - at)).collect();
        let id = self.table(&format!("{}{part}_at_{at}", unit.nodes[i].name), table, ty);
        self.out.comment(id, unit.nodes[i].comment.clone());
        self.patterns.insert((i, at, digits), id);
        id
    }

    fn table(&mut self, name: &str, table: Vec<i128>, ty: Type) -> SignalId {
        let phase = self.phase.expect("a unit with phases has the port");
        let op = Some(Op::Lookup(table, ty));
        self.out.push(name, ty, Driver::Register { op, args: vec![phase], enable: None, reset: None })
    }
}
