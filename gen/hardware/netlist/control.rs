//! Control logic: modules with state, written with copyable handles as units are.

use super::module::{Driver, Home, Instance, Module, Signal, SignalId};
use crate::graph::{Bundle, Place, Step};
use crate::op::*;
use std::cell::RefCell;
use std::collections::{HashMap, HashSet};
use std::ops;
use std::rc::Rc;

/// A module in the making.
pub struct Control {
    module: RefCell<Module>,
    /// Signals that are connected later, with what they stand for.
    later: RefCell<HashMap<usize, SignalId>>,
}

/// A signal of a module in the making.
#[derive(Clone, Copy)]
pub struct Wire<'m> {
    control: &'m Control,
    /// Its number in the module.
    pub id: SignalId,
}

impl<'m> Bundle<Wire<'m>> for Wire<'m> {
    fn map(&self, path: &mut Vec<Step>, f: &mut dyn FnMut(&[Step], Self) -> Self) -> Self {
        f(path, *self)
    }
}

impl Control {
    /// An empty module.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// let m = Control::new("nothing", vec!["Does nothing.".to_owned()]);
    /// assert_eq!(m.finish().name, "nothing");
    /// ```
    pub fn new(name: &str, doc: Vec<String>) -> Self {
        Self { module: RefCell::new(Module::new(name, doc)), later: RefCell::default() }
    }

    fn push(&self, place: Place, ty: Type, driver: Driver) -> Wire<'_> {
        let named = !place.is_empty();
        let (comment, range, clock) = (String::new(), None, None);
        let mut module = self.module.borrow_mut();
        module.signals.push(Signal { place, named, ty, driver, comment, range, clock, home: Home::default() });
        Wire { control: self, id: SignalId(module.signals.len() - 1) }
    }

    /// An input port.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(simulated(&[&[3, 4]], |m| m.input("x", NUMBER).plus(1).output("y")), [[4, 5]]);
    /// ```
    pub fn input(&self, place: impl Into<Place>, ty: Type) -> Wire<'_> {
        let wire = self.push(place.into(), ty, Driver::Port);
        self.module.borrow_mut().inputs.push(wire.id);
        wire
    }

    /// A constant.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(simulated(&[&[3, 4]], |m| m.input("x", NUMBER).equals(m.constant(4, NUMBER)).output("y")), [[0, 1]]);
    /// ```
    pub fn constant(&self, value: i128, ty: Type) -> Wire<'_> {
        self.push(Place::default(), ty, Driver::Combinational { op: Constant(value, ty).into(), args: vec![] })
    }

    /// A signal that is made later, for an instance that is given what depends on its own outputs: see [`Wire::stands_for`].
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// let inner = { let m = Control::new("inner", vec![]); (!m.input("x", Type::FLAG)).output("y"); m.finish() };
    /// assert_eq!(simulated(&[&[0, 1]], |m| {
    ///     let x = m.later(Type::FLAG);
    ///     let y = m.instance("inner", &inner, &[x])[0];
    ///     x.stands_for(m.input("x", Type::FLAG));
    ///     y.output("y");
    /// }), [[1, 0]]);
    /// ```
    pub fn later(&self, ty: Type) -> Wire<'_> {
        self.constant(0, ty)
    }

    /// A register whose input is connected later by [`Wire::loads`].
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(simulated(&[&[3, 4, 5]], |m| {
    ///     let x = m.input("x", NUMBER);
    ///     let q = m.register("q", NUMBER);
    ///     q.loads(x, None, None);
    ///     q.output("y");
    /// }), [[0, 3, 4]]);
    /// ```
    pub fn register(&self, place: impl Into<Place>, ty: Type) -> Wire<'_> {
        self.push(place.into(), ty, Driver::Register { op: None, args: vec![], enable: None, reset: None })
    }

    /// A memory of as many words as the address counts, with one synchronous write port and one asynchronous read port:
    /// what is read.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(simulated(&[&[1, 0, 0], &[2, 0, 0], &[7, 8, 9]], |m| {
    ///     let write = m.input("write", Type::FLAG);
    ///     let (place, data) = (m.input("place", Type::unsigned(2)), m.input("data", NUMBER));
    ///     m.memory("words", write, place, data, m.constant(2, Type::unsigned(2))).output("y");
    /// }), [[0, 7, 7]]);
    /// ```
    pub fn memory<'m>(
        &'m self,
        place: impl Into<Place>,
        write: Wire<'m>,
        address: Wire<'m>,
        data: Wire<'m>,
        read: Wire<'m>,
    ) -> Wire<'m> {
        let (depth, ty) = (1 << address.ty().bits, data.ty());
        let [write, address, data, read] = [write, address, data, read].map(|w| w.id);
        self.push(place.into(), ty, Driver::Memory { write, address, data, read, depth })
    }

    /// An instance; its outputs, named `{label}_{port}`.
    ///
    /// # Panics
    /// If the operands do not fit its ports.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// let inner = { let m = Control::new("inner", vec![]); m.input("x", NUMBER).plus(1).output("y"); m.finish() };
    /// assert_eq!(simulated(&[&[3]], |m| m.instance("inner", &inner, &[m.input("x", NUMBER)])[0].output("y")), [[4]]);
    /// ```
    pub fn instance<'m>(&'m self, label: &str, module: &Rc<Module>, inputs: &[Wire<'m>]) -> Vec<Wire<'m>> {
        assert_eq!(inputs.len(), module.inputs.len(), "instance {label} of {}", module.name);
        for (given, port) in inputs.iter().zip(&module.inputs) {
            let port = module.signal(*port);
            let why = format!("instance {label}: {} at port {}", given.ty(), port.name());
            assert!(given.ty().same_bits(port.ty), "{why}");
        }
        let mut own = self.module.borrow_mut();
        let instance = own.instances.len();
        let inputs = inputs.iter().map(|w| w.id).collect();
        own.instances.push(Instance { place: Place::new(label), module: Rc::clone(module), inputs });
        drop(own);
        let outputs = module.outputs.iter().enumerate();
        outputs
            .map(|(port, (place, signal))| {
                let inner = module.signal(*signal);
                let place = Place { base: format!("{label}_{}", place.base), ..place.clone() };
                let wire = self.push(place, inner.ty, Driver::Instance { instance, port });
                self.module.borrow_mut().signals[wire.id.0].range = inner.range;
                wire
            })
            .collect()
    }

    /// The finished module, without signals that nothing depends on.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// let m = Control::new("inverter", vec![]);
    /// (!m.input("x", Type::FLAG)).output("y");
    /// assert_eq!(m.finish().signals.len(), 2);
    /// ```
    pub fn finish(self) -> Rc<Module> {
        let mut module = self.module.into_inner();
        let later = self.later.into_inner();
        let connect = |id: &mut SignalId| *id = later.get(&id.0).copied().unwrap_or(*id);
        module.signals.iter_mut().for_each(|signal| signal.driver.operands_mut().into_iter().for_each(connect));
        module.instances.iter_mut().flat_map(|instance| &mut instance.inputs).for_each(connect);
        module.outputs.iter_mut().for_each(|(_, id)| connect(id));
        module.name_signals();
        Rc::new(module.pruned())
    }
}

impl From<&str> for Place {
    fn from(name: &str) -> Self {
        Self::new(name)
    }
}

impl<'m> Wire<'m> {
    /// Its type.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(simulated(&[&[3]], |m| { let x = m.input("x", NUMBER); m.constant(7, x.ty()).output("y") }), [[7]]);
    /// ```
    pub fn ty(self) -> Type {
        self.control.module.borrow().signals[self.id.0].ty
    }

    /// Names it.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// let m = Control::new("inverter", vec![]);
    /// (!m.input("x", Type::FLAG)).named("inverse").output("y");
    /// assert_eq!(m.finish().signals[1].name(), "inverse");
    /// ```
    pub fn named(self, place: impl Into<Place>) -> Self {
        let mut module = self.control.module.borrow_mut();
        let signal = &mut module.signals[self.id.0];
        (signal.place, signal.named) = (place.into(), true);
        self
    }

    /// Says what it is.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// let m = Control::new("copy", vec![]);
    /// m.input("x", Type::FLAG).comment("a flag").output("y");
    /// assert_eq!(m.finish().signals[0].comment, "a flag");
    /// ```
    pub fn comment(self, text: &str) -> Self {
        self.control.module.borrow_mut().signals[self.id.0].comment = text.to_owned();
        self
    }

    /// Makes an input port of the top one that may be left open: each of its bits has this value then.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// let m = Control::new("copy", vec![]);
    /// m.input("x", Type::FLAG).or(true).output("y");
    /// assert_eq!(m.finish().optional["x"], true);
    /// ```
    pub fn or(self, bit: bool) -> Self {
        let mut module = self.control.module.borrow_mut();
        let name = module.signals[self.id.0].name();
        module.optional.insert(name, bit);
        drop(module);
        self
    }

    /// Makes it an output port.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(simulated(&[&[3]], |m| m.input("x", NUMBER).output("y")), [[3]]);
    /// ```
    pub fn output(self, place: impl Into<Place>) {
        self.control.module.borrow_mut().outputs.push((place.into(), self.id));
    }

    /// An operation on this signal and others.
    ///
    /// # Panics
    /// If the operands do not fit the operation.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(simulated(&[&[3]], |m| { let x = m.input("x", NUMBER); x.apply(Add(None), &[x]).output("y") }), [[6]]);
    /// ```
    pub fn apply(self, op: impl Into<Comb>, others: &[Self]) -> Self {
        let op = op.into();
        let args = [&[self], others].concat();
        let types: Vec<Type> = args.iter().map(|a| a.ty()).collect();
        let ty = op
            .result(&types)
            .unwrap_or_else(|why| panic!("module {}, {}: {why}", self.control.module.borrow().name, op.role()));
        let args = args.iter().map(|a| a.id).collect();
        self.control.push(Place::default(), ty, Driver::Combinational { op, args })
    }

    /// Connects a register: what it loads, when, and the value it is reset to by a flag.
    ///
    /// # Panics
    /// If this is no register, or the types differ.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// // A counter that a flag stops, and that begins with 5.
    /// assert_eq!(simulated(&[&[0, 0, 0, 1], &[1, 1, 0, 1]], |m| {
    ///     let [reset, go] = ["reset", "go"].map(|name| m.input(name, Type::FLAG));
    ///     let count = m.register("count", NUMBER);
    ///     count.loads(count.plus(1), Some(go), Some((reset, 5)));
    ///     count.output("y");
    /// }), [[0, 1, 2, 2]]);
    /// ```
    pub fn loads(self, data: Self, when: Option<Self>, reset_to: Option<(Self, i128)>) {
        let fits = self.ty().same_bits(data.ty());
        let mut module = self.control.module.borrow_mut();
        let signal = &mut module.signals[self.id.0];
        assert!(fits, "register {}", signal.place);
        let Driver::Register { args, enable, reset, .. } = &mut signal.driver else {
            panic!("{} is no register", signal.place)
        };
        *args = vec![data.id];
        *enable = when.map(|w| w.id);
        *reset = reset_to.map(|(flag, value)| (flag.id, value));
    }

    /// Connects a signal that was to be made later.
    ///
    /// # Panics
    /// If the types differ.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(simulated(&[&[3]], |m| {
    ///     let x = m.later(NUMBER);
    ///     x.plus(1).output("y");
    ///     x.stands_for(m.input("x", NUMBER));
    /// }), [[4]]);
    /// ```
    pub fn stands_for(self, made: Self) {
        assert!(self.ty().same_bits(made.ty()), "{} is made later as {}", self.ty(), made.ty());
        self.control.later.borrow_mut().insert(self.id.0, made.id);
    }

    /// Flag: it equals a number.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(simulated(&[&[3, 4]], |m| m.input("x", NUMBER).is(4).output("y")), [[0, 1]]);
    /// ```
    pub fn is(self, value: i128) -> Self {
        self.apply(Equal, &[self.control.constant(value, self.ty())])
    }

    /// Flag: both are equal.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(simulated(&[&[3, 4], &[3, 3]], |m| m.input("x", NUMBER).equals(m.input("y", NUMBER)).output("z")), [[1, 0]]);
    /// ```
    pub fn equals(self, other: Self) -> Self {
        self.apply(Equal, &[other])
    }

    /// With this flag set the one, else the other.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(simulated(&[&[3, 4]], |m| { let x = m.input("x", NUMBER); x.is(3).choose(x, x.plus(5)).output("y") }), [[3, 9]]);
    /// ```
    pub fn choose(self, set: Self, clear: Self) -> Self {
        self.apply(Select::default(), &[clear, set])
    }

    /// The lowest bits.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(simulated(&[&[13]], |m| m.input("x", NUMBER).low(3).output("y")), [[5]]);
    /// ```
    pub fn low(self, bits: u32) -> Self {
        if self.ty() == Type::unsigned(bits) { self } else { self.apply(LowBits(bits), &[]) }
    }

    /// This number plus another, modulo its range.
    ///
    /// ```
    /// # use efsat_hardware::testing::examples::*;
    /// assert_eq!(simulated(&[&[6, 7]], |m| m.input("x", Type::unsigned(3)).plus(1).output("y")), [[7, 0]]);
    /// ```
    pub fn plus(self, number: i128) -> Self {
        let ty = self.ty();
        self.apply(Add(Some(ty.bits)), &[self.control.constant(number, ty)])
    }
}

impl ops::BitAnd for Wire<'_> {
    type Output = Self;

    fn bitand(self, other: Self) -> Self {
        self.apply(And, &[other])
    }
}

impl ops::BitOr for Wire<'_> {
    type Output = Self;

    fn bitor(self, other: Self) -> Self {
        self.apply(Or, &[other])
    }
}

impl ops::Not for Wire<'_> {
    type Output = Self;

    fn not(self) -> Self {
        self.apply(Not, &[])
    }
}

impl Module {
    /// Names what has no name after the one signal that reads it, or after what it is made of.
    fn name_signals(&mut self) {
        let mut readers: Vec<Vec<usize>> = vec![vec![]; self.signals.len()];
        for (i, signal) in self.signals.iter().enumerate() {
            signal.driver.operands().into_iter().for_each(|o| readers[o.0].push(i));
        }
        // Readers come after what they read, but for registers, which have names.
        for i in (0..self.signals.len()).rev().filter(|i| !self.signals[*i].named).collect::<Vec<_>>() {
            let role = match &self.signals[i].driver {
                Driver::Combinational { op, .. } => op.role(),
                _ => "value",
            };
            let near = match readers[i][..] {
                [reader] => Some(reader),
                _ => self.signals[i].driver.operands().first().map(|o| o.0),
            };
            let near = near.map(|n| self.signals[n].place.to_string()).filter(|n| !n.is_empty());
            self.signals[i].place = Place::new(near.map_or(role.to_owned(), |n| format!("{n}_{role}")));
        }
        let mut known = HashSet::new();
        for signal in &self.signals {
            let constant = matches!(&signal.driver, Driver::Combinational { op: Comb::Constant(_), .. });
            let name = signal.name();
            assert!(constant || known.insert(name.clone()), "module {}: two signals are called {name}", self.name);
        }
    }

    /// The module without signals that nothing depends on.
    pub(super) fn pruned(mut self) -> Self {
        let mut used: Vec<bool> = self.signals.iter().map(|s| matches!(s.driver, Driver::Port)).collect();
        let mut open: Vec<SignalId> = self.outputs.iter().map(|o| o.1).collect();
        let mut instances = vec![false; self.instances.len()];
        // Flags that are printed as one vector stay together.
        while !open.is_empty() {
            while let Some(id) = open.pop() {
                if std::mem::replace(&mut used[id.0], true) {
                    continue;
                }
                let driver = &self.signals[id.0].driver;
                open.extend(driver.operands());
                let Driver::Instance { instance, .. } = *driver else { continue };
                if !std::mem::replace(&mut instances[instance], true) {
                    open.extend(&self.instances[instance].inputs);
                }
            }
            let elements = || self.signals.iter().enumerate().filter_map(|(i, s)| Some((i, s.vector()?.0)));
            let bases: HashSet<&str> = elements().filter(|(i, _)| used[*i]).map(|(_, base)| base).collect();
            let beside = elements().filter(|(i, base)| !used[*i] && bases.contains(base));
            open = beside.map(|(i, _)| SignalId(i)).collect();
        }
        assert!(instances.iter().all(|used| *used), "module {}: an instance is not used", self.name);
        // Outputs of instances stay, so that every port is connected.
        let mut place = vec![usize::MAX; self.signals.len()];
        let mut kept = vec![];
        for (i, signal) in std::mem::take(&mut self.signals).into_iter().enumerate() {
            if used[i] || matches!(signal.driver, Driver::Instance { .. }) {
                place[i] = kept.len();
                kept.push(signal);
            }
        }
        let moved = |id: &mut SignalId| id.0 = place[id.0];
        kept.iter_mut().for_each(|s| s.driver.operands_mut().into_iter().for_each(moved));
        self.signals = kept;
        self.inputs.iter_mut().for_each(moved);
        self.outputs.iter_mut().for_each(|o| moved(&mut o.1));
        self.instances.iter_mut().flat_map(|i| &mut i.inputs).for_each(moved);
        self
    }
}
