//! What a module is as an entity: its objects, and the statements that drive them.

mod held;
mod instances;

use super::fold::{self, Shapes, Statement};
use super::shape::{Object, Process, Records, Shape, objects};
use crate::expression::{Expression, Index, Name, Sub};
use crate::graph::Place;
use crate::netlist::{DelayLine, Driver, Module, Signal, SignalId};
use crate::op::{Comb, Operand, Type};
use std::collections::{BTreeSet, HashMap, HashSet};

/// A constant table of an entity.
pub(super) struct Table {
    pub name: String,
    pub entries: Vec<i128>,
    /// Entries behind them for values that the index never has.
    pub unread: usize,
    pub flags: bool,
}

/// An object that is delayed by several clocks.
pub(super) struct Line {
    /// The object at the end of the line, an array of the clocks: its place among the objects.
    pub object: usize,
    /// What goes in, where that is one value.
    pub source: Option<Expression>,
    /// Else how the first of the line takes in each part.
    pub parts: Vec<Statement>,
    /// Clocks.
    pub length: usize,
}

/// A module, ready to be written down.
pub(super) struct View<'a> {
    pub module: &'a Module,
    /// Whether ports are `std_logic_vector`.
    pub raw: bool,
    /// Input ports, then signals.
    pub objects: Vec<Object>,
    /// Output ports.
    pub outputs: Vec<Object>,
    /// Objects that stand between others and the ports of instances.
    pub between: Vec<Object>,
    pub lines: Vec<Line>,
    /// Instances, folded: the clock in which they begin, and what brings values to and from their ports.
    pub instances: Vec<(Option<i32>, Vec<Statement>, Vec<Statement>)>,
    /// The sections: instances, and what brings values to and from their ports.
    pub sections: Vec<(Vec<Statement>, Vec<Statement>)>,
    /// The name of each signal that has one.
    names: Vec<Option<Name>>,
    /// The signal behind each name.
    signals: HashMap<Name, SignalId>,
    shapes: HashMap<String, Shape>,
    /// Signals that are written where they are read.
    inlined: Vec<bool>,
    /// Signals that are the output port they drive.
    direct: HashSet<SignalId>,
    /// The places of copies that are elements of arrays.
    held: HashMap<SignalId, Place>,
}

impl Shapes for View<'_> {
    fn shape(&self, base: &str) -> Option<&Shape> {
        self.shapes.get(base)
    }
}

/// Who reads a signal.
#[derive(Clone, Default)]
struct Readers {
    /// Signals, in their operations.
    operations: Vec<SignalId>,
    /// Enables, resets, memories and instances, which need a name.
    names: usize,
    /// Output ports.
    outputs: usize,
}

impl<'a> View<'a> {
    pub fn new(module: &'a Module, records: &Records, raw: bool) -> Self {
        let readers = readers(module);
        let inlined: Vec<bool> = (0..module.signals.len()).map(|i| inlined(module, &readers, SignalId(i))).collect();
        let mut view = Self {
            module,
            raw,
            objects: vec![],
            outputs: vec![],
            between: vec![],
            lines: vec![],
            instances: vec![],
            sections: vec![],
            names: vec![None; module.signals.len()],
            signals: HashMap::new(),
            shapes: HashMap::new(),
            inlined,
            direct: HashSet::new(),
            held: HashMap::new(),
        };
        let lines = module.delay_lines();
        let in_line: HashSet<SignalId> = lines.iter().flat_map(|l| l.registers.clone()).collect();
        let place = |place: &Place| if raw { Place::new(place.to_string()) } else { place.clone() };
        let ports = module.outputs.iter().map(|(p, id)| (place(p), module.signal(*id).ty, *id));
        view.outputs = objects(records, ports, &|_| None);
        for port in &view.outputs {
            let alone = |id: &SignalId| {
                let (r, s) = (&readers[id.0], module.signal(*id));
                let driven = !matches!(s.driver, Driver::Port | Driver::Line { .. }) && !in_line.contains(id);
                driven && !view.inlined[id.0] && r.operations.is_empty() && r.names == 0 && r.outputs == 1
            };
            // Ports of the top are no numbers.
            let plain = |id: &SignalId| !raw || module.signal(*id).ty.is_flag();
            let driver = |id: &SignalId| process(module, *id);
            let together = port.members.iter().all(|(id, _)| driver(id) == driver(&port.members[0].0));
            if together && port.members.iter().all(|(id, _)| alone(id) && plain(id)) {
                view.direct.extend(port.members.iter().map(|m| m.0));
            }
        }
        view.held = held::places(module, &|id| view.direct.contains(&id));
        let mut lines = lines;
        loop {
            let inner: HashSet<SignalId> =
                lines.iter().flat_map(|l| &l.registers[..l.registers.len() - 1]).copied().collect();
            let declared = |id: &SignalId| {
                // A constant is a literal, but for one that is part of a bundle.
                let s = module.signal(*id);
                let constant =
                    matches!(s.driver, Driver::Combinational { op: Comb::Constant(_), .. }) && s.place.path.is_empty();
                !view.inlined[id.0] && !constant && !inner.contains(id) && !view.direct.contains(id)
            };
            let all = (0..module.signals.len()).map(SignalId).filter(declared);
            let all = all.map(|id| (module.signal(id), id)).map(|(s, id)| {
                let is_port = matches!(s.driver, Driver::Port);
                (if is_port { place(&s.place) } else { view.held.get(&id).unwrap_or(&s.place).clone() }, s.ty, id)
            });
            let ends: HashSet<SignalId> = lines.iter().filter_map(|l| l.registers.last().copied()).collect();
            let process = |id| if ends.contains(&id) { Some(Process::Delays) } else { process(module, id) };
            // Ports by themselves, so that they are what an instance takes them for.
            let (ports, others): (Vec<_>, Vec<_>) =
                all.partition(|(_, _, id)| matches!(module.signal(*id).driver, Driver::Port));
            view.objects = objects(records, ports.into_iter(), &|_| None);
            view.objects.extend(objects(records, others.into_iter(), &process));
            // Lines of different lengths that end in one object are registers one by one.
            let uneven: HashSet<SignalId> = view.uneven(&lines);
            if uneven.is_empty() {
                break;
            }
            lines.retain(|line| !line.registers.last().is_some_and(|end| uneven.contains(end)));
        }
        let ports: HashSet<String> = view.outputs.iter().map(|o| o.name.clone()).collect();
        for object in &mut view.objects {
            if ports.contains(&object.name) {
                object.name.push_str("_i");
            }
        }
        view.register_names();
        view.find_lines(&lines);
        view.find_instances(records);
        view
    }

    /// The clocks from which on the copies in an array are there; nothing for other objects.
    pub fn held_from(&self, object: &Object) -> BTreeSet<i32> {
        let clock =
            |(id, _): &(SignalId, Vec<Sub>)| self.module.signal(*id).clock.filter(|_| self.held.contains_key(id));
        object.members.iter().filter_map(clock).collect()
    }

    /// Whether all that is driven without a register from some clock on is constant.
    pub fn are_constants(&self, clock: Option<i32>) -> bool {
        let mut all =
            self.module.signals.iter().zip(&self.inlined).filter(|(s, inlined)| s.clock == clock && !**inlined);
        all.all(|(s, _)| match &s.driver {
            Driver::Combinational { op, .. } => matches!(op, Comb::Constant(_)),
            _ => true,
        })
    }

    /// The shapes of all objects.
    pub fn shapes(&self) -> impl Iterator<Item = &Shape> {
        self.objects.iter().chain(&self.outputs).chain(&self.between).map(|o| &o.shape)
    }

    /// All names that the entity declares.
    pub fn declared(&self) -> Vec<String> {
        let objects = self.objects.iter().chain(&self.outputs).chain(&self.between).map(|o| o.name.clone());
        let instances = self.instances.iter().flat_map(|i| &i.1).chain(self.sections.iter().flat_map(|s| &s.0));
        let labels = instances.flat_map(Statement::labels);
        objects.chain(labels).chain(self.tables().into_iter().map(|t| t.name)).collect()
    }

    fn register_names(&mut self) {
        for object in &self.objects {
            self.shapes.insert(object.name.clone(), object.shape.clone());
            for (id, subs) in &object.members {
                let name = object.part(subs);
                self.names[id.0] = Some(name.clone());
                self.signals.insert(name, *id);
            }
        }
        for port in &self.outputs {
            self.shapes.insert(port.name.clone(), port.shape.clone());
            for (id, subs) in port.members.iter().filter(|m| self.direct.contains(&m.0)) {
                let name = port.part(subs);
                self.names[id.0] = Some(name.clone());
                self.signals.insert(name, *id);
            }
        }
    }

    /// The ends of delay lines in objects that are not delayed as a whole.
    fn uneven(&self, lines: &[DelayLine]) -> HashSet<SignalId> {
        let lengths: HashMap<SignalId, usize> =
            lines.iter().filter_map(|l| l.registers.last().map(|end| (*end, l.registers.len()))).collect();
        let length = |member: &(SignalId, Vec<Sub>)| lengths.get(&member.0);
        let even = |object: &&Object| object.members.iter().all(|m| length(m) == length(&object.members[0]));
        let uneven = self.objects.iter().filter(|object| !even(object));
        uneven.flat_map(|object| object.members.iter().filter(|m| length(m).is_some()).map(|m| m.0)).collect()
    }

    /// Delay lines of whole objects.
    fn find_lines(&mut self, lines: &[DelayLine]) {
        let by_end: HashMap<SignalId, &DelayLine> =
            lines.iter().filter_map(|l| l.registers.last().map(|end| (*end, l))).collect();
        let mut found = vec![];
        for (i, object) in self.objects.iter().enumerate() {
            let Some(first) = by_end.get(&object.members[0].0) else { continue };
            let length = first.registers.len();
            let sources: Vec<(Vec<Sub>, SignalId)> =
                object.members.iter().map(|(id, subs)| (subs.clone(), by_end[id].source)).collect();
            found.push((i, sources, length));
        }
        let mut shapes = vec![];
        for (object, _, length) in &found {
            let (shape, end) = (self.objects[*object].shape.clone(), self.objects[*object].name.clone());
            // The line is called after what it delays.
            let base = end.rsplit_once('_').map_or(end.as_str(), |(base, _)| base);
            let short = format!("{base}_line");
            let name = if self.shapes.contains_key(&short) { format!("{end}_line") } else { short };
            for (id, subs) in &self.objects[*object].members {
                let subs = std::iter::once(Sub::Index(Index::At(*length))).chain(subs.iter().cloned()).collect();
                self.names[id.0] = Some(Name { base: name.clone(), subs });
            }
            self.objects[*object].name.clone_from(&name);
            self.shapes.remove(&end);
            self.shapes
                .insert(name, Shape::Array { vector: false, first: 0, size: length + 1, of: Box::new(shape.clone()) });
            shapes.push(shape);
        }
        // All lines have their names: one may delay what another ends in.
        for ((object, sources, length), shape) in found.into_iter().zip(shapes) {
            let of: HashMap<&[Sub], SignalId> = sources.iter().map(|(subs, id)| (&subs[..], *id)).collect();
            let source = self.whole(&shape, &mut vec![], &|subs| of.get(subs).map(|id| self.value(*id)));
            // What is no whole is taken in part by part.
            let first = Name { base: self.objects[object].name.clone(), subs: vec![Sub::Index(Index::At(1))] };
            let leaf = |n: &Name| Some(Statement::Assign(n.clone(), self.value(*of.get(&n.subs[1..])?)));
            let parts = if source.is_some() { vec![] } else { fold::fold(self, &shape, &first, 0, &leaf) };
            self.lines.push(Line { object, source, parts, length });
        }
    }

    /// One value for a whole, from those of its parts.
    fn whole(
        &self,
        shape: &Shape,
        subs: &mut Vec<Sub>,
        part: &dyn Fn(&[Sub]) -> Option<Expression>,
    ) -> Option<Expression> {
        let steps: Vec<(Sub, &Shape)> = match shape {
            Shape::Flag | Shape::Number(..) => return part(subs),
            Shape::Record(_, fields) => fields.iter().map(|(field, shape)| (Sub::Field(field), shape)).collect(),
            Shape::Array { first, size, of, .. } => {
                (*first..first + size).map(|i| (Sub::Index(Index::At(i)), &**of)).collect()
            }
        };
        let mut parts = vec![];
        for (sub, shape) in steps {
            subs.push(sub.clone());
            let value = self.whole(shape, subs, part);
            subs.pop();
            parts.push((sub, value?));
        }
        let parts: Vec<(&Sub, &Expression)> = parts.iter().map(|(sub, value)| (sub, value)).collect();
        fold::join_values(self, shape, &parts)
    }

    pub fn signal(&self, name: &Name) -> Option<(SignalId, &'a Signal)> {
        self.signals.get(name).map(|id| (*id, self.module.signal(*id)))
    }

    /// The value of a signal where it is read.
    pub fn value(&self, id: SignalId) -> Expression {
        let signal = self.module.signal(id);
        if let (Driver::Combinational { op: Comb::Constant(c), .. }, None) = (&signal.driver, &self.names[id.0]) {
            return Expression::Number(c.0, signal.ty);
        }
        let Some(name) = &self.names[id.0] else {
            assert!(self.inlined[id.0], "{}: {} is not declared", self.module.name, signal.name());
            return self.driven(id);
        };
        let name = Expression::Name(name.clone());
        let port = matches!(signal.driver, Driver::Port);
        match (self.raw && port && !signal.ty.is_flag(), signal.ty.signed) {
            (false, _) => name,
            (true, true) => Expression::call("signed", [name]),
            (true, false) => Expression::call("unsigned", [name]),
        }
    }

    /// What a signal is driven with: the operation, or what a register loads.
    pub fn driven(&self, id: SignalId) -> Expression {
        let signal = self.module.signal(id);
        match &signal.driver {
            Driver::Combinational { op, args } | Driver::Register { op: Some(op), args, .. } => {
                let operand = |a: &SignalId| Operand { value: self.value(*a), ty: self.module.signal(*a).ty };
                let mut operands: Vec<Operand> = args.iter().map(operand).collect();
                if let Comb::Concatenate(_) = op {
                    operands = self.whole_vectors(operands);
                }
                match op.vhdl(&operands, signal.ty) {
                    Expression::Table { entries, ty, index, .. } => {
                        Expression::Table { name: self.table_name(id), entries, ty, index }
                    }
                    other => other,
                }
            }
            Driver::Register { args, .. } => self.value(args[0]),
            _ => panic!("{}: {} is driven by no expression", self.module.name, signal.name()),
        }
    }

    /// Operands that are all the elements of a vector, in order, as that vector.
    fn whole_vectors(&self, operands: Vec<Operand>) -> Vec<Operand> {
        let element = |operand: &Operand| {
            let Expression::Name(name) = &operand.value else { return None };
            let (Sub::Index(Index::At(i)), rest) = name.subs.split_last()? else { return None };
            let vector = Name { base: name.base.clone(), subs: rest.to_vec() };
            match self.part(&vector)? {
                shape @ Shape::Array { first, size, .. } if shape.is_flags() => {
                    Some((vector, i.checked_sub(*first)?, *size))
                }
                _ => None,
            }
        };
        let mut all = vec![];
        let mut rest = &operands[..];
        while let Some(first) = rest.first() {
            let run = element(first).filter(|(vector, i, size)| {
                let follows = |(k, x): (usize, &Operand)| element(x).is_some_and(|e| (&e.0, e.1) == (vector, k));
                *i == 0 && rest.len() >= *size && rest[..*size].iter().enumerate().all(follows)
            });
            let taken = match run {
                Some((vector, _, size)) => {
                    let value = Expression::call("unsigned", [Expression::Name(vector)]);
                    all.push(Operand { value, ty: Type::unsigned(size as u32) });
                    size
                }
                None => {
                    all.push(first.clone());
                    1
                }
            };
            rest = &rest[taken..];
        }
        all
    }

    fn table_name(&self, id: SignalId) -> String {
        let name = match &self.names[id.0] {
            Some(name) => name.subs.iter().fold(name.base.clone(), |mut text, sub| {
                match sub {
                    Sub::Index(Index::At(i)) => text.push_str(&format!("_{i}")),
                    Sub::Index(Index::Loop { .. }) | Sub::Range(..) => {}
                    Sub::Field(field) => text.push_str(&format!("_{field}")),
                }
                text
            }),
            None => self.module.signal(id).name(),
        };
        format!("{name}_table")
    }

    /// The tables that expressions refer to.
    pub fn tables(&self) -> Vec<Table> {
        let mut tables = vec![];
        for (i, signal) in self.module.signals.iter().enumerate() {
            let op = match &signal.driver {
                Driver::Combinational { op, .. } | Driver::Register { op: Some(op), .. } => op,
                _ => continue,
            };
            let index = signal.driver.operands().first().map(|id| self.module.signal(*id).ty);
            if let Comb::Lookup(lookup) = op
                && !index.is_some_and(Type::is_flag)
            {
                let (name, entries) = (self.table_name(SignalId(i)), lookup.0.clone());
                // An entry for every value of the index, so that no tool subtracts it from the last.
                let unread = index.map_or(0, |ty| (1 << ty.bits) - entries.len());
                tables.push(Table { name, entries, unread, flags: signal.ty.is_flag() });
            }
        }
        tables
    }

    /// The statements of all signals, folded by object. `make` gives for a signal what makes its statement from its name, if it
    /// has one.
    pub fn statements<S: FnOnce(&Name) -> Statement>(
        &self,
        make: impl Fn(SignalId, &'a Signal) -> Option<S>,
    ) -> Vec<Statement> {
        let at_end: HashSet<usize> = self.lines.iter().map(|l| l.object).collect();
        let objects = self.objects.iter().enumerate().filter(|(i, _)| !at_end.contains(i)).map(|(_, o)| o);
        let mut all = vec![];
        for object in objects.chain(&self.outputs) {
            // Every clock of a schedule asks for its own: most objects have none.
            if !object.members.iter().any(|(id, _)| make(*id, self.module.signal(*id)).is_some()) {
                continue;
            }
            let leaf = |name: &Name| self.signal(name).and_then(|(id, signal)| Some(make(id, signal)?(name)));
            all.extend(fold::fold(self, &object.shape, &Name::whole(object.name.clone()), 0, &leaf));
        }
        all
    }

    /// Whether an output port is driven by the statements of its signals.
    pub fn is_direct(&self, port: &Object) -> bool {
        port.members.iter().all(|m| self.direct.contains(&m.0))
    }

    /// Assignments of what drives output ports that are not driven directly.
    pub fn port_assignments(&self) -> Vec<Statement> {
        let mut all = vec![];
        for port in self.outputs.iter().filter(|p| !self.is_direct(p)) {
            let of: HashMap<&[Sub], SignalId> = port.members.iter().map(|(id, subs)| (&subs[..], *id)).collect();
            let leaf = |name: &Name| {
                let id = of.get(&name.subs[..])?;
                let value = self.value(*id);
                let raw = self.raw && !self.module.signal(*id).ty.is_flag();
                let value = if raw { Expression::call("std_logic_vector", [value]) } else { value };
                Some(Statement::Assign(name.clone(), value))
            };
            all.extend(fold::fold(self, &port.shape, &Name::whole(port.name.clone()), 0, &leaf));
        }
        all
    }
}

/// The input and output ports of a module as objects, their members being numbers of inputs or outputs.
pub(super) fn ports(records: &Records, module: &Module) -> Vec<(bool, Object)> {
    let inputs = module.inputs.iter().map(|id| (module.signal(*id).place.clone(), module.signal(*id).ty));
    let outputs = module.outputs.iter().map(|(place, id)| (place.clone(), module.signal(*id).ty));
    let numbered = |ports: Vec<(Place, Type)>| ports.into_iter().enumerate().map(|(k, (p, t))| (p, t, SignalId(k)));
    let inputs = objects(records, numbered(inputs.collect()), &|_| None);
    let outputs = objects(records, numbered(outputs.collect()), &|_| None);
    inputs.into_iter().map(|o| (true, o)).chain(outputs.into_iter().map(|o| (false, o))).collect()
}

/// An array of as many elements as another, of another kind.
fn around(shape: &Shape, of: &Shape) -> Shape {
    match shape {
        Shape::Array { vector, first, size, of: inner } => {
            Shape::Array { vector: *vector, first: *first, size: *size, of: Box::new(around(inner, of)) }
        }
        _ => of.clone(),
    }
}

fn readers(module: &Module) -> Vec<Readers> {
    let mut readers = vec![Readers::default(); module.signals.len()];
    for (i, signal) in module.signals.iter().enumerate() {
        match &signal.driver {
            Driver::Combinational { args, .. } => {
                args.iter().for_each(|a| readers[a.0].operations.push(SignalId(i)));
            }
            Driver::Register { args, enable, reset, .. } => {
                args.iter().for_each(|a| readers[a.0].operations.push(SignalId(i)));
                enable.iter().for_each(|e| readers[e.0].names += 1);
                reset.iter().for_each(|r| readers[r.0.0].names += 1);
            }
            Driver::Memory { .. } | Driver::Line { .. } => {
                signal.driver.operands().iter().for_each(|o| readers[o.0].names += 1)
            }
            Driver::Port | Driver::Instance { .. } => {}
        }
    }
    module.outputs.iter().for_each(|o| readers[o.1.0].outputs += 1);
    module.instances.iter().flat_map(|i| &i.inputs).for_each(|id| readers[id.0].names += 1);
    readers
}

/// The process that drives a signal, if it is no delay line's.
fn process(module: &Module, id: SignalId) -> Option<Process> {
    let signal = module.signal(id);
    match &signal.driver {
        Driver::Register { reset: Some(_), .. } => Some(Process::State),
        Driver::Register { enable: Some(_), .. } => Some(Process::Captures),
        Driver::Register { .. } => Some(Process::Clock(signal.clock)),
        _ => None,
    }
}

/// Whether a signal is written where it is read: it has one reader, which can take an expression, and no name of its own.
/// A table gives its name to a constant.
fn inlined(module: &Module, readers: &[Readers], id: SignalId) -> bool {
    let signal = module.signal(id);
    let Driver::Combinational { op, args } = &signal.driver else { return false };
    if matches!(op, Comb::Constant(_)) {
        return false;
    }
    let table = matches!(op, Comb::Lookup(_));
    if (signal.named && !table) || readers[id.0].names > 0 || readers[id.0].outputs > 0 {
        return false;
    }
    // A choice among more than two is a statement of its own.
    if matches!(op, Comb::Select(_)) && args.len() > 3 {
        return false;
    }
    let [reader] = readers[id.0].operations[..] else { return false };
    let reading = match &module.signal(reader).driver {
        Driver::Combinational { op, .. } | Driver::Register { op: Some(op), .. } => op,
        _ => return true,
    };
    // Slices are of names, or of slices of names.
    if matches!(op, Comb::Floor(_)) {
        return true;
    }
    let cuts =
        matches!(reading, Comb::Resize(_) | Comb::Select(_) | Comb::Add(_) | Comb::Subtract(_) | Comb::Negate(_));
    let narrows = cuts && module.signal(reader).ty.bits < signal.ty.bits;
    !narrows && !matches!(reading, Comb::Floor(_) | Comb::LowBits(_) | Comb::SignBit(_))
}
