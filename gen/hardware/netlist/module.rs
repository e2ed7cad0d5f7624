//! Clocked modules: what a scheduled block becomes. One module is one entity of the printed design.
//!
//! A module is a list of signals, each with one driver: a combinational operation, a register, a memory or the output
//! of an instance. Blocks are [lowered](super::lower()) to modules; the little control logic there is (sequencer, top) is
//! written with [`Control`](super::Control), because it has state that no dataflow graph has.

use crate::device::SHORTEST_PRODUCT;
use crate::graph::{Place, Step};
use crate::op::{Comb, Range, Type};
use std::collections::{HashMap, HashSet};
use std::rc::Rc;

/// A signal of a module.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct SignalId(pub usize);

/// What drives a signal.
#[derive(Clone, Debug)]
pub enum Driver {
    /// An input port.
    Port,
    /// A combinational operation.
    Combinational {
        /// The operation.
        op: Comb,
        /// Its operands.
        args: Vec<SignalId>,
    },
    /// A register. Data registers have neither enable nor reset; all start at zero (or `reset`).
    Register {
        /// Operation in front of the register, none for a plain copy of the one operand.
        op: Option<Comb>,
        /// Operands.
        args: Vec<SignalId>,
        /// Loads only where this flag is set.
        enable: Option<SignalId>,
        /// Synchronous reset: flag and value.
        reset: Option<(SignalId, i128)>,
    },
    /// A memory with one synchronous write port and one asynchronous read port; this signal is what is read.
    Memory {
        /// Write flag.
        write: SignalId,
        /// Write address.
        address: SignalId,
        /// Write data.
        data: SignalId,
        /// Read address.
        read: SignalId,
        /// Words.
        depth: usize,
    },
    /// A delay line with a tap: what the operand was `tap` + 1 clocks before, at most [`LINE_CLOCKS`].
    Line {
        /// What is delayed.
        data: SignalId,
        /// Clocks, less one.
        tap: SignalId,
    },
    /// An output of an instance.
    Instance {
        /// Index into [`Module::instances`].
        instance: usize,
        /// Index into its module's outputs.
        port: usize,
    },
}

impl Driver {
    /// All signals it reads.
    pub fn operands(&self) -> Vec<SignalId> {
        match self {
            Driver::Port | Driver::Instance { .. } => vec![],
            Driver::Combinational { args, .. } => args.clone(),
            Driver::Register { args, enable, reset, .. } => {
                args.iter().copied().chain(*enable).chain(reset.map(|r| r.0)).collect()
            }
            Driver::Memory { write, address, data, read, .. } => vec![*write, *address, *data, *read],
            Driver::Line { data, tap } => vec![*data, *tap],
        }
    }
}

impl Driver {
    /// All signals it reads, to change them.
    pub(super) fn operands_mut(&mut self) -> Vec<&mut SignalId> {
        match self {
            Driver::Port | Driver::Instance { .. } => vec![],
            Driver::Combinational { args, .. } => args.iter_mut().collect(),
            Driver::Register { args, enable, reset, .. } => {
                args.iter_mut().chain(enable).chain(reset.as_mut().map(|r| &mut r.0)).collect()
            }
            Driver::Memory { write, address, data, read, .. } => vec![write, address, data, read],
            Driver::Line { data, tap } => vec![data, tap],
        }
    }
}

/// A signal: name, type, driver and what a reader wants to know.
#[derive(Clone, Debug)]
pub struct Signal {
    /// Name, unique in the module.
    pub place: Place,
    /// Whether somebody gave it this name; the others are printed where they are read, if that is one place.
    pub named: bool,
    /// Type.
    pub ty: Type,
    /// Driver.
    pub driver: Driver,
    /// Equation or source; may be empty.
    pub comment: String,
    /// Proven range, where known.
    pub range: Option<Range>,
    /// Clock of the pair's slot in which the value is first valid, where it has one.
    pub clock: Option<i32>,
    /// Where it is, of a block with sections.
    pub home: Home,
}

/// Where a signal of a block with sections is.
// For lowering.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Home {
    /// Where it is read, if that is one place: a later copy, for example.
    #[default]
    WhereRead,
    /// In the block itself.
    Block,
    /// In this one of its sections.
    Section(usize),
}

/// An instance of a module.
#[derive(Clone, Debug)]
pub struct Instance {
    /// Label.
    pub place: Place,
    /// Module.
    pub module: Rc<Module>,
    /// One signal an input port, in order.
    pub inputs: Vec<SignalId>,
}

/// Registers in a row of which only the last is read: a shift register. Flags of one vector are no line, but that vector.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DelayLine {
    /// What is delayed.
    pub source: SignalId,
    /// The registers, in order.
    pub registers: Vec<SignalId>,
}

/// Clocks of a delay line with a tap.
pub const LINE_CLOCKS: usize = 16;

/// Registers that make a delay line: fewer are cheaper apart.
pub const LEAST_DELAY_LINE: usize = 3;

/// A module.
#[derive(Clone, Debug)]
pub struct Module {
    /// Name, also of the entity.
    pub name: String,
    /// Header lines.
    pub doc: Vec<String>,
    /// All signals.
    pub signals: Vec<Signal>,
    /// Input ports, in order (clock excepted).
    pub inputs: Vec<SignalId>,
    /// Names of the input ports of a top that may be left open, and the value of each of their bits then.
    pub optional: HashMap<String, bool>,
    /// Output ports: name and the signal behind it.
    pub outputs: Vec<(Place, SignalId)>,
    /// Instances.
    pub instances: Vec<Instance>,
    /// Clocks from inputs to outputs, for lowered blocks.
    pub latency: Option<i32>,
    /// Whether it is a section of a lowered block, with the clocks of that.
    pub section: bool,
}

impl Signal {
    /// The whole name in one word.
    pub fn name(&self) -> String {
        self.place.to_string()
    }

    /// Base and suffix of the vector that a flag is an element of: its elements stay together.
    pub(super) fn vector(&self) -> Option<(&str, &str)> {
        let is_element = self.ty.is_flag() && matches!(self.place.path[..], [Step::Index(_)]);
        is_element.then_some((&self.place.base, &self.place.suffix))
    }
}

impl Module {
    /// An empty module.
    pub(super) fn new(name: &str, doc: Vec<String>) -> Self {
        let (signals, inputs, outputs, instances) = (vec![], vec![], vec![], vec![]);
        let optional = HashMap::new();
        Self {
            name: name.to_owned(),
            doc,
            signals,
            inputs,
            optional,
            outputs,
            instances,
            latency: None,
            section: false,
        }
    }

    /// A signal.
    pub fn signal(&self, id: SignalId) -> &Signal {
        &self.signals[id.0]
    }

    /// The module and its sections.
    // For what looks at a block as a whole.
    #[doc(hidden)]
    pub fn parts(&self) -> impl Iterator<Item = &Module> {
        let sections = self.instances.iter().map(|instance| &*instance.module).filter(|module| module.section);
        std::iter::once(self).chain(sections)
    }

    /// Whether the module needs a clock.
    pub fn clocked(&self) -> bool {
        self.signals
            .iter()
            .any(|s| matches!(s.driver, Driver::Register { .. } | Driver::Memory { .. } | Driver::Line { .. }))
            || self.instances.iter().any(|i| i.module.clocked())
    }

    /// The modules of the hierarchy, each once, instantiated ones before those that use them.
    pub fn hierarchy(self: &Rc<Self>) -> Vec<Rc<Module>> {
        fn visit(module: &Rc<Module>, seen: &mut HashSet<*const Module>, order: &mut Vec<Rc<Module>>) {
            if seen.insert(Rc::as_ptr(module)) {
                for instance in &module.instances {
                    visit(&instance.module, seen, order);
                }
                order.push(Rc::clone(module));
            }
        }
        let mut order = vec![];
        visit(self, &mut HashSet::new(), &mut order);
        order
    }

    /// Hardware multipliers in the hierarchy: products, but those so short that look-up tables make them.
    pub fn multipliers(&self) -> usize {
        let product = |s: &&Signal| match &s.driver {
            Driver::Combinational { op, .. } => matches!(op, Comb::Multiply(_)),
            Driver::Register { op, .. } => matches!(op, Some(Comb::Multiply(_))),
            _ => false,
        };
        let own = |s: &&Signal| product(s) && s.ty.bits >= SHORTEST_PRODUCT;
        self.signals.iter().filter(own).count() + self.instances.iter().map(|i| i.module.multipliers()).sum::<usize>()
    }

    /// The delay lines of the module itself, in the order of their last registers.
    pub fn delay_lines(&self) -> Vec<DelayLine> {
        // In a chain of multipliers registers are theirs.
        let in_chain = |s: &Signal| matches!(s.driver, Driver::Register { op: Some(Comb::Accumulate(_)), .. });
        if self.signals.iter().any(in_chain) {
            return vec![];
        }
        let copied = |id: SignalId| match &self.signal(id).driver {
            Driver::Register { op: None, args, enable: None, reset: None } => {
                let [from, to] = [args[0], id].map(|id| self.signal(id));
                (!to.ty.is_flag() || !to.place.shares_bundle(&from.place)).then_some(args[0])
            }
            _ => None,
        };
        let mut reads = vec![0; self.signals.len()];
        let read = self.signals.iter().flat_map(|s| s.driver.operands());
        let read =
            read.chain(self.outputs.iter().map(|o| o.1)).chain(self.instances.iter().flat_map(|i| i.inputs.clone()));
        read.for_each(|id| reads[id.0] += 1);
        // A register goes on in the one register that alone reads it.
        let inner = |id: SignalId| copied(id).is_some() && reads[id.0] == 1;
        let mut goes_on = vec![false; self.signals.len()];
        let all = || (0..self.signals.len()).map(SignalId);
        for id in all() {
            if let Some(before) = copied(id).filter(|before| inner(*before)) {
                goes_on[before.0] = true;
            }
        }
        let mut lines = vec![];
        for last in all().filter(|id| copied(*id).is_some() && !goes_on[id.0]) {
            let mut registers = vec![last];
            let mut source = copied(last).expect("a copy");
            while inner(source) {
                registers.push(source);
                source = copied(source).expect("a copy");
            }
            registers.reverse();
            if registers.len() >= LEAST_DELAY_LINE {
                lines.push(DelayLine { source, registers });
            }
        }
        lines
    }

    /// Register bits in the hierarchy.
    pub fn register_bits(&self) -> u64 {
        let own = self.signals.iter().filter(|s| matches!(s.driver, Driver::Register { .. }));
        own.map(|s| u64::from(s.ty.bits)).sum::<u64>()
            + self.instances.iter().map(|i| i.module.register_bits()).sum::<u64>()
    }
}
