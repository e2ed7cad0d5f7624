//! Clocked modules: what a scheduled unit becomes. One module is one entity of the printed design.
//!
//! A module is a list of signals, each with one driver: a combinational operation, a register, a memory or the output
//! of an instance. Units are [lowered](super::lower) to modules; the little control logic there is (sequencer, top) is
//! written with [`ModuleBuilder`] directly, because it has state that no dataflow graph has.

use super::{Op, Range, Type};
use std::collections::HashSet;
use std::rc::Rc;

/// A signal of a module.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct SignalId(pub(crate) usize);

/// What drives a signal.
#[derive(Clone, Debug)]
pub enum Driver {
    /// An input port.
    Port,
    /// A combinational operation.
    Combinational {
        /// The operation.
        op: Op,
        /// Its operands.
        args: Vec<SignalId>,
    },
    /// A register. Data registers have neither enable nor reset; all start at zero (or `reset`).
    Register {
        /// Operation in front of the register, none for a plain copy of the one operand.
        op: Option<Op>,
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
        }
    }
}

/// A signal: name, type, driver and what a reader wants to know.
#[derive(Clone, Debug)]
pub struct Signal {
    /// Name, unique in the module.
    pub name: String,
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
}

/// An instance of a module.
#[derive(Clone, Debug)]
pub struct Instance {
    /// Label.
    pub label: String,
    /// Module.
    pub module: Rc<Module>,
    /// One signal an input port, in order.
    pub inputs: Vec<SignalId>,
}

/// Registers in a row of which only the last is read: a shift register.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DelayLine {
    /// What is delayed.
    pub source: SignalId,
    /// The registers, in order.
    pub registers: Vec<SignalId>,
}

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
    /// Output ports: name and the signal behind it.
    pub outputs: Vec<(String, SignalId)>,
    /// Instances.
    pub instances: Vec<Instance>,
    /// Clocks from inputs to outputs, for lowered units.
    pub latency: Option<i32>,
}

impl Module {
    /// A signal.
    pub fn signal(&self, id: SignalId) -> &Signal {
        &self.signals[id.0]
    }

    /// Whether the module needs a clock.
    pub fn clocked(&self) -> bool {
        self.signals.iter().any(|s| matches!(s.driver, Driver::Register { .. } | Driver::Memory { .. }))
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

    /// Hardware multipliers in the hierarchy: products of operands that fit one.
    pub fn multipliers(&self) -> usize {
        let own = |s: &&Signal| match &s.driver {
            Driver::Combinational { op, .. } => matches!(op, Op::Multiply),
            Driver::Register { op, .. } => matches!(op, Some(Op::Multiply)),
            _ => false,
        };
        self.signals.iter().filter(own).count() + self.instances.iter().map(|i| i.module.multipliers()).sum::<usize>()
    }

    /// The delay lines of the module itself, in the order of their last registers.
    pub fn delay_lines(&self) -> Vec<DelayLine> {
        let copied = |id: SignalId| match &self.signal(id).driver {
            Driver::Register { op: None, args, enable: None, reset: None } => Some(args[0]),
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

/// Makes a module by hand.
pub struct ModuleBuilder {
    pub(super) module: Module,
    names: HashSet<String>,
}

impl ModuleBuilder {
    /// An empty module.
    pub fn new(name: impl Into<String>, doc: Vec<String>) -> Self {
        let module = Module {
            name: name.into(),
            doc,
            signals: vec![],
            inputs: vec![],
            outputs: vec![],
            instances: vec![],
            latency: None,
        };
        Self { module, names: HashSet::new() }
    }

    /// Type of a signal.
    pub fn ty(&self, id: SignalId) -> Type {
        self.module.signal(id).ty
    }

    pub(super) fn push(&mut self, name: &str, ty: Type, driver: Driver) -> SignalId {
        let module = &self.module.name;
        assert!(self.names.insert(name.to_owned()), "module {module}: two signals are called {name}");
        let name = name.to_owned();
        self.module.signals.push(Signal { name, ty, driver, comment: String::new(), range: None, clock: None });
        SignalId(self.module.signals.len() - 1)
    }

    /// Gives a signal its comment.
    pub fn comment(&mut self, id: SignalId, comment: impl Into<String>) -> SignalId {
        self.module.signals[id.0].comment = comment.into();
        id
    }

    /// An input port.
    pub fn input(&mut self, name: &str, ty: Type) -> SignalId {
        let id = self.push(name, ty, Driver::Port);
        self.module.inputs.push(id);
        id
    }

    /// An output port.
    pub fn output(&mut self, name: &str, id: SignalId) {
        let module = &self.module.name;
        assert!(self.names.insert(name.to_owned()), "module {module}: output {name} has the name of a signal");
        self.module.outputs.push((name.to_owned(), id));
    }

    /// A combinational operation.
    ///
    /// # Panics
    /// If the operands do not fit it.
    pub fn op(&mut self, name: &str, op: Op, args: &[SignalId]) -> SignalId {
        let ty = self.result(name, &op, args);
        self.push(name, ty, Driver::Combinational { op, args: args.to_vec() })
    }

    fn result(&self, name: &str, op: &Op, args: &[SignalId]) -> Type {
        let types: Vec<Type> = args.iter().map(|a| self.ty(*a)).collect();
        op.result(&types).unwrap_or_else(|e| panic!("module {}, signal {name}: {e}", self.module.name))
    }

    /// A constant.
    pub fn constant(&mut self, name: &str, value: i128, ty: Type) -> SignalId {
        self.push(name, ty, Driver::Combinational { op: Op::Constant(value), args: vec![] })
    }

    /// A register whose input is connected later by [`ModuleBuilder::drive`].
    pub fn register(&mut self, name: &str, ty: Type) -> SignalId {
        self.push(name, ty, Driver::Register { op: None, args: vec![], enable: None, reset: None })
    }

    /// Connects a register.
    ///
    /// # Panics
    /// If the types differ.
    pub fn drive(&mut self, id: SignalId, d: SignalId, load: Option<SignalId>, zero: Option<(SignalId, i128)>) {
        let (q, name) = (self.ty(id), &self.module.signals[id.0].name);
        assert_eq!((q.signed, q.bits), (self.ty(d).signed, self.ty(d).bits), "register {name}");
        let Driver::Register { args, enable, reset, .. } = &mut self.module.signals[id.0].driver else {
            panic!("{} is no register", self.module.signals[id.0].name)
        };
        *args = vec![d];
        *enable = load;
        *reset = zero;
    }

    /// A memory; see [`Driver::Memory`].
    pub fn memory(
        &mut self,
        name: &str,
        write: SignalId,
        address: SignalId,
        data: SignalId,
        read: SignalId,
    ) -> SignalId {
        let depth = 1 << self.ty(address).bits;
        let ty = self.ty(data);
        self.push(name, ty, Driver::Memory { write, address, data, read, depth })
    }

    /// An instance; returns its outputs.
    pub fn instance(&mut self, label: &str, module: &Rc<Module>, inputs: &[SignalId]) -> Vec<SignalId> {
        assert_eq!(inputs.len(), module.inputs.len(), "instance {label} of {}", module.name);
        for (given, port) in inputs.iter().zip(&module.inputs) {
            let (given, port) = (self.module.signal(*given), module.signal(*port));
            assert_eq!(
                (given.ty.signed, given.ty.bits),
                (port.ty.signed, port.ty.bits),
                "instance {label}: {} at port {}",
                given.name,
                port.name
            );
        }
        let instance = self.module.instances.len();
        let module = Rc::clone(module);
        let inputs = inputs.to_vec();
        assert!(self.names.insert(label.to_owned()), "two things are called {label}");
        self.module.instances.push(Instance { label: label.to_owned(), module: Rc::clone(&module), inputs });
        let outputs = module.outputs.iter().enumerate();
        outputs
            .map(|(port, (name, signal))| {
                let inner = module.signal(*signal);
                let id = self.push(&format!("{label}_{name}"), inner.ty, Driver::Instance { instance, port });
                self.module.signals[id.0].range = inner.range;
                id
            })
            .collect()
    }

    /// The finished module, without signals that nothing depends on.
    pub fn finish(self) -> Rc<Module> {
        let mut module = self.module;
        let mut used: Vec<bool> = module.signals.iter().map(|s| matches!(s.driver, Driver::Port)).collect();
        let mut stack: Vec<SignalId> = module.outputs.iter().map(|o| o.1).collect();
        let mut instances = vec![false; module.instances.len()];
        while let Some(id) = stack.pop() {
            if std::mem::replace(&mut used[id.0], true) {
                continue;
            }
            let driver = &module.signals[id.0].driver;
            stack.extend(driver.operands());
            if let Driver::Instance { instance, .. } = driver
                && !std::mem::replace(&mut instances[*instance], true)
            {
                stack.extend(&module.instances[*instance].inputs);
            }
        }
        assert!(instances.iter().all(|used| *used), "module {}: an instance is not used", module.name);
        // Outputs of used instances stay, so that every port is connected.
        let keep = |i: usize, s: &Signal| used[i] || matches!(s.driver, Driver::Instance { .. });
        let mut place = vec![usize::MAX; module.signals.len()];
        let mut kept = vec![];
        for (i, signal) in module.signals.into_iter().enumerate() {
            if keep(i, &signal) {
                place[i] = kept.len();
                kept.push(signal);
            }
        }
        let moved = |id: &mut SignalId| id.0 = place[id.0];
        for signal in &mut kept {
            match &mut signal.driver {
                Driver::Port | Driver::Instance { .. } => {}
                Driver::Combinational { args, .. } => args.iter_mut().for_each(moved),
                Driver::Register { args, enable, reset, .. } => {
                    args.iter_mut().for_each(moved);
                    enable.iter_mut().for_each(moved);
                    reset.iter_mut().for_each(|r| moved(&mut r.0));
                }
                Driver::Memory { write, address, data, read, .. } => {
                    [write, address, data, read].into_iter().for_each(moved);
                }
            }
        }
        module.signals = kept;
        module.inputs.iter_mut().for_each(moved);
        module.outputs.iter_mut().for_each(|o| moved(&mut o.1));
        module.instances.iter_mut().for_each(|i| i.inputs.iter_mut().for_each(moved));
        Rc::new(module)
    }
}
