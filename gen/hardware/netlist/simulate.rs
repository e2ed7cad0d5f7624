//! Cycle-accurate simulation of a module hierarchy.
//!
//! The hierarchy is dissolved into one list of signals. Signals that feed back into themselves (counters, pointers,
//! running disjunctions) form components that are stepped clock by clock; everything else is computed for a whole block
//! of clocks at a time, signal by signal, in tight loops. The result is that of stepping everything.

use super::module::{Driver, LINE_CLOCKS, Module, SignalId};
use crate::op::{Comb, Resize, Type};
use std::collections::HashSet;
use std::rc::Rc;

/// What a dissolved signal does.
#[derive(Clone, Debug)]
enum Action {
    Input,
    Combinational(Comb),
    Register { op: Option<Comb>, enable: Option<usize>, reset: Option<(usize, i128)> },
    Memory,
    Line,
}

#[derive(Clone, Debug)]
struct Cell {
    action: Action,
    /// Operands; of a memory: write, address, data, read; of a delay line: data, tap.
    args: Vec<usize>,
    /// Their types.
    types: Vec<Type>,
    ty: Type,
}

impl Cell {
    /// Its operands are not known yet.
    fn new(action: Action, ty: Type) -> Self {
        Self { action, args: vec![], types: vec![], ty }
    }

    fn dependencies(&self) -> Vec<usize> {
        let mut all = self.args.clone();
        if let Action::Register { enable, reset, .. } = &self.action {
            all.extend(enable.iter());
            all.extend(reset.iter().map(|r| r.0));
        }
        all
    }
}

/// Values of one signal over a block of clocks.
#[derive(Clone, Debug)]
enum Lane {
    Narrow(Vec<i64>),
    Wide(Vec<i128>),
}

impl Lane {
    fn get(&self, t: usize) -> i128 {
        match self {
            Lane::Narrow(v) => i128::from(v[t]),
            Lane::Wide(v) => v[t],
        }
    }

    fn set(&mut self, t: usize, x: i128) {
        match self {
            Lane::Narrow(v) => v[t] = x as i64,
            Lane::Wide(v) => v[t] = x,
        }
    }
}

/// Signals of at most this many bits are kept in 64-bit lanes.
const NARROW: u32 = 62;

/// A simulation of one hierarchy.
pub struct Simulation {
    cells: Rc<[Cell]>,
    lanes: Vec<Lane>,
    states: Vec<i128>,
    /// Words of a memory or of a delay line; of other cells none.
    memories: Vec<Vec<i128>>,
    components: Vec<(bool, Vec<usize>)>,
    inputs: Vec<usize>,
    outputs: Vec<usize>,
    block: usize,
}

impl Simulation {
    /// Prepares a simulation of `top` that advances `block` clocks at a time.
    pub fn new(top: &Rc<Module>, block: usize) -> Self {
        let mut cells = vec![];
        let mut inputs = vec![];
        let outputs = dissolve(top, None, &mut cells, &mut inputs);
        Self::from_cells(cells, inputs, outputs, block)
    }

    /// The part of a simulation that the named outputs depend on, one clock at a time.
    ///
    /// Inputs keep their order; those not in the part are ignored.
    pub fn restricted(top: &Rc<Module>, names: &[&str]) -> Self {
        let mut cells = vec![];
        let mut inputs = vec![];
        let outputs = dissolve(top, None, &mut cells, &mut inputs);
        let chosen: Vec<usize> = names
            .iter()
            .map(|name| {
                outputs[top
                    .outputs
                    .iter()
                    .position(|(place, _)| place.to_string() == *name)
                    .expect("an output of the top")]
            })
            .collect();
        let mut used = vec![false; cells.len()];
        let mut stack = chosen.clone();
        while let Some(cell) = stack.pop() {
            if !std::mem::replace(&mut used[cell], true) {
                stack.extend(cells[cell].dependencies());
            }
        }
        for (cell, used) in cells.iter_mut().zip(&used) {
            if !used {
                *cell = Cell::new(Action::Input, Type::FLAG);
            }
        }
        let mut part = Self::from_cells(cells, inputs, chosen, 1);
        part.components.retain(|(_, members)| members.iter().any(|m| used[*m]));
        part
    }

    /// Whether an input reaches the outputs of a [restricted](Simulation::restricted) simulation.
    pub fn reaches(&self, input: usize) -> bool {
        self.components.iter().any(|(_, members)| members.contains(&self.inputs[input]))
    }

    fn from_cells(mut cells: Vec<Cell>, inputs: Vec<usize>, outputs: Vec<usize>, block: usize) -> Self {
        let lanes = cells
            .iter()
            .map(|c| if c.ty.bits <= NARROW { Lane::Narrow(vec![0; block]) } else { Lane::Wide(vec![0; block]) })
            .collect();
        let states = vec![0; cells.len()];
        for i in 0..cells.len() {
            cells[i].types = cells[i].args.iter().map(|a| cells[*a].ty).collect();
        }
        let words = |c: &Cell| match c.action {
            Action::Memory => 1 << c.types[1].bits,
            Action::Line => LINE_CLOCKS,
            _ => 0,
        };
        let memories = cells.iter().map(|c| vec![0; words(c)]).collect();
        let components = components(&cells);
        let cells = cells.into();
        Self { cells, lanes, states, memories, components, inputs, outputs, block }
    }

    /// Sets input port `port` in clock `t` of the coming block.
    pub fn set(&mut self, port: usize, t: usize, value: i128) {
        self.lanes[self.inputs[port]].set(t, value);
    }

    /// Output `port` in clock `t` of the block last run.
    pub fn output(&self, port: usize, t: usize) -> i128 {
        self.lanes[self.outputs[port]].get(t)
    }

    /// The operands of all products in the last clock of the block last run.
    pub fn multiplied(&self) -> Vec<i128> {
        let product = |cell: &&Cell| match &cell.action {
            Action::Combinational(op) | Action::Register { op: Some(op), .. } => matches!(op, Comb::Multiply(_)),
            _ => false,
        };
        let operands = self.cells.iter().filter(product).flat_map(|cell| &cell.args);
        operands.map(|operand| self.lanes[*operand].get(self.block - 1)).collect()
    }

    /// Runs one block of clocks.
    pub fn run(&mut self) {
        let components = std::mem::take(&mut self.components);
        for (feeds_back, members) in &components {
            if *feeds_back {
                for t in 0..self.block {
                    for cell in members {
                        self.present(*cell, t);
                    }
                    for cell in members {
                        self.advance(*cell, t);
                    }
                }
            } else {
                self.whole_block(members[0]);
            }
        }
        self.components = components;
    }

    /// Value of a cell in clock `t`; registers show their state.
    fn present(&mut self, cell: usize, t: usize) {
        let value = match &self.cells[cell].action {
            Action::Input => return,
            Action::Register { .. } => self.states[cell],
            Action::Combinational(op) => self.apply(op, cell, t),
            Action::Memory => {
                let read = self.lanes[self.cells[cell].args[3]].get(t) as usize;
                self.memories[cell][read]
            }
            Action::Line => {
                let tap = self.lanes[self.cells[cell].args[1]].get(t) as usize;
                self.memories[cell][tap]
            }
        };
        self.lanes[cell].set(t, value);
    }

    fn apply(&self, op: &Comb, cell: usize, t: usize) -> i128 {
        let Cell { args, types, ty, .. } = &self.cells[cell];
        let (get, value) = (|a: usize| self.lanes[a].get(t), |args: &[i128]| op.value(args, types, *ty));
        // Few operands need no memory of their own.
        match args[..] {
            [a] => value(&[get(a)]),
            [a, b] => value(&[get(a), get(b)]),
            [a, b, c] => value(&[get(a), get(b), get(c)]),
            _ => value(&args.iter().map(|a| get(*a)).collect::<Vec<_>>()),
        }
    }

    /// State after clock `t`.
    fn advance(&mut self, cell: usize, t: usize) {
        let c = &self.cells[cell];
        match &c.action {
            Action::Register { op, enable, reset } => {
                let next = match (reset, enable) {
                    (Some((flag, value)), _) if self.lanes[*flag].get(t) != 0 => *value,
                    (_, Some(flag)) if self.lanes[*flag].get(t) == 0 => return,
                    _ => match op {
                        None => self.lanes[c.args[0]].get(t),
                        Some(op) => self.apply(op, cell, t),
                    },
                };
                self.states[cell] = next;
            }
            Action::Memory if self.lanes[c.args[0]].get(t) != 0 => {
                let address = self.lanes[c.args[1]].get(t) as usize;
                self.memories[cell][address] = self.lanes[c.args[2]].get(t);
            }
            // The newest value stands first.
            Action::Line => {
                let words = &mut self.memories[cell];
                words.rotate_right(1);
                words[0] = self.lanes[c.args[0]].get(t);
            }
            _ => {}
        }
    }

    /// A cell outside any feedback, for all clocks of the block.
    fn whole_block(&mut self, cell: usize) {
        let cells = Rc::clone(&self.cells);
        match &cells[cell].action {
            Action::Input => {}
            Action::Line => self.line(cell),
            Action::Memory => {
                for t in 0..self.block {
                    self.present(cell, t);
                    self.advance(cell, t);
                }
            }
            Action::Register { op, enable, reset } => {
                // What it would load in each clock of the block, then what it shows.
                match op {
                    None => self.copy(cell),
                    Some(op) => self.combinational(op, cell),
                }
                let state = self.states[cell];
                self.states[cell] = match (enable, reset) {
                    (None, None) => self.delay(cell, state),
                    _ => self.load(cell, *enable, *reset, state),
                };
            }
            Action::Combinational(op) => self.combinational(op, cell),
        }
    }

    /// A register that always loads: what it loads becomes what it shows, a clock later. Gives its state after the block.
    fn delay(&mut self, cell: usize, state: i128) -> i128 {
        let last = self.lanes[cell].get(self.block - 1);
        match &mut self.lanes[cell] {
            Lane::Narrow(v) => v.rotate_right(1),
            Lane::Wide(v) => v.rotate_right(1),
        }
        self.lanes[cell].set(0, state);
        last
    }

    /// The same for a register with an enable or a reset.
    fn load(&mut self, cell: usize, enable: Option<usize>, reset: Option<(usize, i128)>, mut state: i128) -> i128 {
        let mut lane = std::mem::replace(&mut self.lanes[cell], Lane::Narrow(vec![]));
        for t in 0..self.block {
            let loaded = lane.get(t);
            lane.set(t, state);
            match reset {
                Some((flag, value)) if self.lanes[flag].get(t) != 0 => state = value,
                _ if enable.is_none_or(|flag| self.lanes[flag].get(t) != 0) => state = loaded,
                _ => {}
            }
        }
        self.lanes[cell] = lane;
        state
    }

    /// A delay line outside any feedback, for all clocks of the block.
    fn line(&mut self, cell: usize) {
        let mut lane = std::mem::replace(&mut self.lanes[cell], Lane::Narrow(vec![]));
        let [data, tap] = [0, 1].map(|k| &self.lanes[self.cells[cell].args[k]]);
        let before = &mut self.memories[cell];
        for t in 0..self.block {
            let clocks = tap.get(t) as usize + 1;
            lane.set(t, if clocks <= t { data.get(t - clocks) } else { before[clocks - t - 1] });
        }
        // What was there before the next block, the newest value first.
        let kept = |k: usize| if k < self.block { data.get(self.block - 1 - k) } else { before[k - self.block] };
        *before = (0..LINE_CLOCKS).map(kept).collect();
        self.lanes[cell] = lane;
    }

    fn copy(&mut self, cell: usize) {
        let source = self.cells[cell].args[0];
        let mut lane = std::mem::replace(&mut self.lanes[cell], Lane::Narrow(vec![]));
        match (&self.lanes[source], &mut lane) {
            (Lane::Narrow(a), Lane::Narrow(z)) => z.copy_from_slice(a),
            (Lane::Wide(a), Lane::Wide(z)) => z.copy_from_slice(a),
            (a, z) => (0..self.block).for_each(|t| z.set(t, a.get(t))),
        }
        self.lanes[cell] = lane;
    }

    fn combinational(&mut self, op: &Comb, cell: usize) {
        let mut lane = std::mem::replace(&mut self.lanes[cell], Lane::Narrow(vec![]));
        if !self.narrow(op, cell, &mut lane) {
            for t in 0..self.block {
                lane.set(t, self.apply(op, cell, t));
            }
        }
        self.lanes[cell] = lane;
    }

    /// An operation on 64-bit lanes; false if it has wider ones.
    fn narrow(&self, op: &Comb, cell: usize, result: &mut Lane) -> bool {
        let Lane::Narrow(results) = result else { return false };
        let c = &self.cells[cell];
        let lane = |a: usize| match &self.lanes[a] {
            Lane::Narrow(v) => Some(v.as_slice()),
            Lane::Wide(_) => None,
        };
        let mut over = |lanes: &[&[i64]]| op.lanes(lanes, c.ty, results);
        match c.args[..] {
            [a] => lane(a).is_some_and(|a| over(&[a])),
            [a, b] => lane(a).zip(lane(b)).is_some_and(|(a, b)| over(&[a, b])),
            _ => c.args.iter().map(|a| lane(*a)).collect::<Option<Vec<_>>>().is_some_and(|lanes| over(&lanes)),
        }
    }
}

/// Appends the cells of a module; returns the cells of its outputs.
fn dissolve(module: &Rc<Module>, args: Option<&[usize]>, cells: &mut Vec<Cell>, inputs: &mut Vec<usize>) -> Vec<usize> {
    let mut own: Vec<usize> = vec![usize::MAX; module.signals.len()];
    // Cells first, so that feedback can refer to them; instance outputs follow.
    for (i, signal) in module.signals.iter().enumerate() {
        let action = match &signal.driver {
            Driver::Port => match args {
                Some(args) => {
                    let port = module.inputs.iter().position(|p| p.0 == i).expect("ports are inputs");
                    own[i] = args[port];
                    continue;
                }
                None => Action::Input,
            },
            Driver::Combinational { op, .. } => Action::Combinational(op.clone()),
            Driver::Register { op, .. } => Action::Register { op: op.clone(), enable: None, reset: None },
            Driver::Memory { .. } => Action::Memory,
            Driver::Line { .. } => Action::Line,
            Driver::Instance { .. } => continue,
        };
        own[i] = cells.len();
        cells.push(Cell::new(action, signal.ty));
    }
    if args.is_none() {
        inputs.extend(module.inputs.iter().map(|p| own[p.0]));
    }
    // Outputs of instances are wires, connected when the instance has been dissolved.
    for (i, signal) in module.signals.iter().enumerate() {
        if matches!(signal.driver, Driver::Instance { .. }) {
            own[i] = cells.len();
            cells.push(Cell::new(Action::Combinational(Resize(signal.ty).into()), signal.ty));
        }
    }
    let id = |s: &SignalId| own[s.0];
    let mut results = vec![];
    for instance in &module.instances {
        let operands: Vec<usize> = instance.inputs.iter().map(id).collect();
        results.push(dissolve(&instance.module, Some(&operands), cells, inputs));
    }
    for (i, signal) in module.signals.iter().enumerate() {
        match &signal.driver {
            Driver::Port => {}
            Driver::Combinational { args, .. } => cells[own[i]].args = args.iter().map(id).collect(),
            Driver::Register { args, enable, reset, .. } => {
                let (enable_cell, reset_cell) = (enable.as_ref().map(id), reset.as_ref().map(|r| (own[r.0.0], r.1)));
                let cell = &mut cells[own[i]];
                cell.args = args.iter().map(id).collect();
                if let Action::Register { enable, reset, .. } = &mut cell.action {
                    *enable = enable_cell;
                    *reset = reset_cell;
                }
            }
            Driver::Memory { write, address, data, read, .. } => {
                cells[own[i]].args = [write, address, data, read].map(id).to_vec();
            }
            Driver::Line { data, tap } => cells[own[i]].args = [data, tap].map(id).to_vec(),
            Driver::Instance { instance, port } => cells[own[i]].args = vec![results[*instance][*port]],
        }
    }
    module.outputs.iter().map(|(_, s)| own[s.0]).collect()
}

/// Strongly connected components in data-flow order (Tarjan), registers counted as connections; within a component,
/// combinational cells in an order in which operands come first.
fn components(cells: &[Cell]) -> Vec<(bool, Vec<usize>)> {
    const NEW: usize = usize::MAX;
    let depends: Vec<Vec<usize>> = cells.iter().map(Cell::dependencies).collect();
    let mut index = vec![NEW; cells.len()];
    let mut low = vec![0; cells.len()];
    let mut on_stack = vec![false; cells.len()];
    let (mut stack, mut next, mut result) = (vec![], 0, vec![]);
    for root in 0..cells.len() {
        if index[root] != NEW {
            continue;
        }
        let mut calls = vec![(root, 0)];
        while let Some((v, edge)) = calls.last().copied() {
            if edge == 0 {
                (index[v], low[v]) = (next, next);
                next += 1;
                stack.push(v);
                on_stack[v] = true;
            }
            if let Some(w) = depends[v].get(edge).copied() {
                calls.last_mut().expect("not empty").1 += 1;
                if index[w] == NEW {
                    calls.push((w, 0));
                } else if on_stack[w] {
                    low[v] = low[v].min(index[w]);
                }
                continue;
            }
            calls.pop();
            if let Some((parent, _)) = calls.last() {
                low[*parent] = low[*parent].min(low[v]);
            }
            if low[v] == index[v] {
                let mut members = vec![];
                loop {
                    let w = stack.pop().expect("the component is on the stack");
                    on_stack[w] = false;
                    members.push(w);
                    if w == v {
                        break;
                    }
                }
                let feeds_back = members.len() > 1 || depends[v].contains(&v);
                result.push((feeds_back, combinational_order(cells, members)));
            }
        }
    }
    result
}

fn combinational_order(cells: &[Cell], members: Vec<usize>) -> Vec<usize> {
    if members.len() == 1 {
        return members;
    }
    let inside: HashSet<usize> = members.iter().copied().collect();
    let mut done = HashSet::new();
    let mut order = vec![];
    let mut sorted = members;
    sorted.sort_unstable();
    // Registers show their state; what is combinational follows its operands (a memory: its read address, a delay line: its tap).
    let combinational = |cell: usize| -> Vec<usize> {
        match &cells[cell].action {
            Action::Combinational(_) => cells[cell].args.clone(),
            Action::Memory => vec![cells[cell].args[3]],
            Action::Line => vec![cells[cell].args[1]],
            _ => vec![],
        }
    };
    for m in sorted {
        let mut stack = vec![(m, false)];
        while let Some((cell, ready)) = stack.pop() {
            if done.contains(&cell) || !inside.contains(&cell) {
                continue;
            }
            if ready {
                done.insert(cell);
                order.push(cell);
            } else {
                stack.push((cell, true));
                stack.extend(combinational(cell).into_iter().map(|a| (a, false)));
            }
        }
    }
    order
}
