//! Loads of control signals: what a flag or an index that chooses, enables or taps drives. A register with more than
//! [`MOST_LOADS`] of them gets copies, each with a part of its readers. A copy is a register of the same value, which
//! the printer marks so that no tool merges it with the others.
//!
//! Readers in a module of their own are counted with what the port drives there. A reader is never divided: one
//! word that is wider than the limit is the one load of its copy. Three registers or more in a row are counted as the shift
//! register that most parts make of them. Resets are not counted.

use super::module::{Driver, LEAST_DELAY_LINE, Module, Signal, SignalId};
use crate::graph::{Place, Step};
use crate::op::Comb;
use std::collections::HashMap;

/// The most loads of a control register, unless one reader has more.
// For the tests of the limit.
#[doc(hidden)]
pub const MOST_LOADS: u64 = 64;

/// Most bits of what a register loads by an operation, for copies of that operation to be cheap.
const CHEAP: u32 = 8;

/// A place where a module reads a signal.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Reader {
    /// An operand of a signal's driver, in the order of [`Driver::operands`].
    Operand(usize, usize),
    /// A port of an instance.
    Port(usize, usize),
    /// An output.
    Output(usize),
}

/// A reader, what it loads, and whether it is controlled by what it reads.
#[derive(Clone, Copy)]
struct Load {
    reader: Reader,
    loads: u64,
    control: bool,
}

impl Module {
    /// The registers that control something, and gates behind them, with their loads and the most of one reader.
    // For the tests of the limit.
    #[doc(hidden)]
    pub fn control_loads(&self) -> Vec<(SignalId, u64, u64)> {
        let all = self.loads().into_iter().enumerate();
        let control = all.filter(|(i, loads)| self.is_copied(SignalId(*i)) && loads.iter().any(|load| load.control));
        control
            .map(|(i, loads)| {
                let rows = self.rows(SignalId(i), loads);
                let each = || rows.iter().map(|row| Self::row_loads(row));
                (SignalId(i), each().sum(), each().max().unwrap_or(0))
            })
            .collect()
    }

    /// The module with copies of control registers that have too many loads.
    pub(super) fn limited(self) -> Self {
        let loads = self.loads();
        let mut open: Vec<SignalId> = (0..self.signals.len()).map(SignalId).collect();
        let mut all = Copies { module: self, loads, numbers: HashMap::new(), open: vec![] };
        // A copy reads what the signal reads, which may have too many loads in turn.
        while let Some(id) = open.pop() {
            all.divide(id);
            open.append(&mut all.open);
        }
        all.module
    }

    /// Whether copies are made of a signal: of a register that does not read itself and loads no long result, or of a gate
    /// that reads such a register, which is copied with it.
    fn is_copied(&self, id: SignalId) -> bool {
        match &self.signal(id).driver {
            Driver::Register { op, args, .. } => {
                let bits = || args.iter().map(|arg| self.signal(*arg).ty.bits).sum::<u32>();
                (op.is_none() || bits() <= CHEAP) && !self.signal(id).driver.operands().contains(&id)
            }
            Driver::Combinational { op: Comb::And(_) | Comb::Or(_) | Comb::Not(_), .. } => self.source(id).is_some(),
            _ => false,
        }
    }

    /// The first of the registers in a row that end in one which a flag enables, and which it enables all.
    fn first_of_row(&self, last: SignalId, by: SignalId) -> Option<SignalId> {
        let before = |id: SignalId| match &self.signal(id).driver {
            Driver::Register { op: None, args, enable: Some(enable), reset: None } if *enable == by => Some(args[0]),
            _ => None,
        };
        let row =
            std::iter::successors(before(last).map(|_| last), |id| before(*id).filter(|id| before(*id).is_some()));
        // Registers in a ring have no first one.
        row.take(self.signals.len()).last()
    }

    /// The loads of a signal, registers in a row that it enables together: three and more may become a shift register, whose one
    /// enable they have then.
    fn rows(&self, of: SignalId, loads: Vec<Load>) -> Vec<Vec<Load>> {
        let mut rows: Vec<Vec<Load>> = vec![];
        let mut places = HashMap::new();
        for load in loads {
            let first = match load.reader {
                Reader::Operand(reader, _) => self.first_of_row(SignalId(reader), of),
                Reader::Port(..) | Reader::Output(_) => None,
            };
            let place = first.map_or(rows.len(), |first| *places.entry(first).or_insert(rows.len()));
            if place == rows.len() {
                rows.push(vec![]);
            }
            rows[place].push(load);
        }
        let is_long = |row: &Vec<Load>| row.len() >= LEAST_DELAY_LINE;
        let apart = |row: Vec<Load>| row.into_iter().map(|load| vec![load]).collect();
        rows.into_iter().flat_map(|row| if is_long(&row) { vec![row] } else { apart(row) }).collect()
    }

    /// What a row loads.
    fn row_loads(row: &[Load]) -> u64 {
        row.iter().map(|load| load.loads).max().unwrap_or(0)
    }

    /// The register that is copied with a gate.
    fn source(&self, gate: SignalId) -> Option<SignalId> {
        let is_register = |id: &SignalId| matches!(self.signal(*id).driver, Driver::Register { .. });
        self.signal(gate).driver.operands().into_iter().find(|id| is_register(id) && self.is_copied(*id))
    }

    /// What each signal drives.
    fn loads(&self) -> Vec<Vec<Load>> {
        let mut loads = vec![vec![]; self.signals.len()];
        for (i, signal) in self.signals.iter().enumerate() {
            for (at, operand) in signal.driver.operands().into_iter().enumerate() {
                loads[operand.0].push(Load { reader: Reader::Operand(i, at), ..self.load(signal, at) });
            }
        }
        for (i, instance) in self.instances.iter().enumerate() {
            let inner = instance.module.loads();
            for (at, (given, port)) in instance.inputs.iter().zip(&instance.module.inputs).enumerate() {
                let (within, control) = (&inner[port.0], inner[port.0].iter().any(|load| load.control));
                let sum = within.iter().map(|load| load.loads).sum();
                loads[given.0].push(Load { reader: Reader::Port(i, at), loads: sum, control });
            }
        }
        for (i, (_, id)) in self.outputs.iter().enumerate() {
            loads[id.0].push(Load { reader: Reader::Output(i), loads: 1, control: false });
        }
        loads
    }

    /// What an operand of a signal's driver loads: all bits that it chooses, enables or taps, else one.
    fn load(&self, signal: &Signal, at: usize) -> Load {
        let controls = |op: &Comb| at == 0 && matches!(op, Comb::Select(_) | Comb::NegateIf(_) | Comb::Lookup(_));
        let control = match &signal.driver {
            Driver::Combinational { op, .. } => controls(op),
            Driver::Register { op, args, enable, .. } => match at.checked_sub(args.len()) {
                None => op.as_ref().is_some_and(controls),
                Some(0) => enable.is_some(),
                Some(_) => false,
            },
            Driver::Memory { .. } => at != 2,
            Driver::Line { .. } => at == 1,
            Driver::Port | Driver::Instance { .. } => false,
        };
        let loads = if control { u64::from(signal.ty.bits) } else { 1 };
        Load { reader: Reader::Output(0), loads, control }
    }
}

/// Copies in the making.
struct Copies {
    module: Module,
    loads: Vec<Vec<Load>>,
    /// How many copies there are of each signal.
    numbers: HashMap<SignalId, usize>,
    /// What has got loads.
    open: Vec<SignalId>,
}

impl Copies {
    /// Gives a signal as many copies as its loads need.
    fn divide(&mut self, of: SignalId) {
        if !self.module.is_copied(of) || !self.loads[of.0].iter().any(|load| load.control) {
            return;
        }
        let mut groups: Vec<Vec<Load>> = vec![vec![]];
        let mut sum = 0;
        for row in self.module.rows(of, std::mem::take(&mut self.loads[of.0])) {
            let more = Module::row_loads(&row);
            if sum > 0 && sum + more > MOST_LOADS {
                groups.push(vec![]);
                sum = 0;
            }
            sum += more;
            groups.last_mut().expect("a group").extend(row);
        }
        let mut groups = groups.into_iter();
        self.loads[of.0] = groups.next().expect("a group");
        for group in groups {
            let id = self.copy(of);
            let module = &mut self.module;
            for load in &group {
                match load.reader {
                    Reader::Operand(reader, at) => *module.signals[reader].driver.operands_mut().remove(at) = id,
                    Reader::Port(instance, port) => module.instances[instance].inputs[port] = id,
                    Reader::Output(output) => module.outputs[output].1 = id,
                }
            }
            self.loads[id.0] = group;
        }
    }

    fn copy(&mut self, of: SignalId) -> SignalId {
        let original = self.module.signal(of).copy_of.unwrap_or(of);
        let number = self.numbers.entry(original).or_default();
        let place = Place::at(format!("{}_copy", self.module.signal(original).name()), &[Step::Index(*number)]);
        *number += 1;
        let mut copy = Signal {
            place,
            named: true,
            comment: format!("for at most {MOST_LOADS} loads each"),
            copy_of: Some(original),
            ..self.module.signal(of).clone()
        };
        if let Driver::Combinational { args, .. } = &mut copy.driver {
            let source = self.module.source(of);
            let own = source.map(|source| self.copy(source));
            args.iter_mut().filter(|arg| Some(**arg) == source).for_each(|arg| *arg = own.unwrap_or(*arg));
        }
        self.push(copy)
    }

    /// Appends a signal, with a copy of the logic in front that has no name: that is written where it is read.
    fn push(&mut self, mut signal: Signal) -> SignalId {
        if let Driver::Register { args, .. } | Driver::Combinational { args, .. } = &mut signal.driver {
            for arg in args {
                let front = self.module.signal(*arg);
                let is_logic = matches!(
                    front.driver,
                    Driver::Combinational { op: Comb::And(_) | Comb::Or(_) | Comb::Not(_) | Comb::Equal(_), .. }
                );
                if is_logic && !front.named {
                    *arg = self.push(front.clone());
                }
            }
        }
        let id = SignalId(self.module.signals.len());
        for (at, operand) in signal.driver.operands().into_iter().enumerate() {
            let load = self.module.load(&signal, at);
            self.loads[operand.0].push(Load { reader: Reader::Operand(id.0, at), ..load });
            self.open.push(operand);
        }
        self.module.signals.push(signal);
        self.loads.push(vec![]);
        id
    }
}
