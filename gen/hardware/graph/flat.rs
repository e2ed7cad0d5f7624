//! A block with all its instances dissolved: one list of (node, phase) steps in an order in which operands come first.

use super::{Block, Op, Rate};
use crate::op::{Comb, Constant, Type};
use std::collections::HashMap;
use std::rc::Rc;

/// A node of the dissolved graph.
#[derive(Clone, Debug)]
pub struct FlatNode {
    /// What it computes.
    pub op: Op,
    /// Operands, as indices into [`Flat::nodes`].
    pub args: Vec<usize>,
    /// Type of the result.
    pub ty: Type,
    /// Rate, with [`Rate::Any`] only where a value is constant.
    pub rate: Rate,
    /// Path: instance names and node name, with dots.
    pub path: String,
    /// Index of the block in [`Flat::blocks`], and of the node in it.
    pub origin: (usize, usize),
}

/// One step of an evaluation.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    /// Index into [`Flat::nodes`].
    pub node: usize,
    /// Phase of the slot.
    pub phase: usize,
}

/// The dissolved graph.
#[derive(Clone, Debug)]
pub struct Flat {
    /// All nodes.
    pub nodes: Vec<FlatNode>,
    /// Every (node, phase) once, operands first.
    pub steps: Vec<Step>,
    /// The different blocks met, the top first.
    pub blocks: Vec<Rc<Block>>,
    /// Flat nodes of the top's inputs, in order.
    pub inputs: Vec<usize>,
    /// Flat nodes of the top's outputs, in order.
    pub outputs: Vec<usize>,
    /// Number of phases.
    pub interval: usize,
    top_names: HashMap<String, usize>,
}

impl Flat {
    /// Dissolves `top`.
    pub fn new(top: &Rc<Block>) -> Self {
        let mut flat = Self {
            nodes: vec![],
            steps: vec![],
            blocks: vec![Rc::clone(top)],
            inputs: vec![],
            outputs: vec![],
            interval: top.interval,
            top_names: HashMap::new(),
        };
        let own = flat.dissolve(top, 0, "", None);
        flat.inputs = top.inputs.iter().map(|i| own[i.0]).collect();
        flat.outputs = top.outputs.iter().map(|o| own[o.1.0]).collect();
        let names = top.nodes.iter().zip(&own).filter(|(_, flat)| **flat != usize::MAX);
        flat.top_names = names.map(|(node, flat)| (node.name(), *flat)).collect();
        flat.resolve_rates();
        flat.order();
        flat
    }

    /// The node behind a name in the top: its own nodes, and the outputs of its instances.
    pub fn top_node(&self, name: &str) -> Option<usize> {
        self.top_names.get(name).copied()
    }

    /// Whether a node has a value of its own in each phase.
    pub fn per_phase(&self, node: usize) -> bool {
        self.nodes[node].rate == Rate::Phase
    }

    fn dissolve(&mut self, block: &Rc<Block>, index: usize, path: &str, args: Option<&[usize]>) -> Vec<usize> {
        let mut own = vec![usize::MAX; block.nodes.len()];
        let mut instances: HashMap<usize, Vec<usize>> = HashMap::new();
        let mut late: Vec<(usize, usize)> = vec![];
        if let Some(args) = args {
            for (input, arg) in block.inputs.iter().zip(args) {
                own[input.0] = *arg;
            }
        }
        for (i, node) in block.nodes.iter().enumerate() {
            let node_path = format!("{path}{}", node.name());
            match &node.op {
                Op::Input if args.is_some() => {}
                Op::Instance(child) => {
                    let operands: Vec<usize> = node.args.iter().map(|a| own[a.0]).collect();
                    let child_index = self.blocks.iter().position(|u| Rc::ptr_eq(u, child)).unwrap_or_else(|| {
                        self.blocks.push(Rc::clone(child));
                        self.blocks.len() - 1
                    });
                    let inner = self.dissolve(child, child_index, &format!("{node_path}."), Some(&operands));
                    instances.insert(i, child.outputs.iter().map(|o| inner[o.1.0]).collect());
                }
                Op::Output(port) => own[i] = instances[&node.args[0].0][*port],
                op => {
                    let args = node.args.iter().map(|a| own[a.0]).collect();
                    own[i] = self.nodes.len();
                    late.push((i, own[i]));
                    self.nodes.push(FlatNode {
                        op: op.clone(),
                        args,
                        ty: node.ty,
                        rate: node.rate,
                        path: node_path,
                        origin: (index, i),
                    });
                }
            }
        }
        // Late operands may refer to nodes that came later.
        for (i, flat) in late {
            self.nodes[flat].args = block.nodes[i].args.iter().map(|a| own[a.0]).collect();
        }
        own
    }

    /// A node of a block that does not care takes the rate of what it is given.
    fn resolve_rates(&mut self) {
        for i in 0..self.nodes.len() {
            if self.nodes[i].rate == Rate::Any {
                let joined = self.nodes[i].args.iter().filter(|a| **a < i).map(|a| self.nodes[*a].rate);
                self.nodes[i].rate =
                    joined.fold(Rate::Any, |r, a| if r == Rate::Phase || a == Rate::Any { r } else { a });
            }
        }
    }

    /// Operands of a step: (node, phase).
    pub fn operands(&self, step: Step) -> Vec<Step> {
        let node = &self.nodes[step.node];
        let at = |arg: usize, phase: usize| Step { node: arg, phase: if self.per_phase(arg) { phase } else { 0 } };
        match &node.op {
            Op::Capture { phase, .. } => vec![at(node.args[0], *phase)],
            // Before the first phase there is nothing; what stands there has no meaning.
            Op::Earlier(n) => vec![at(node.args[0], step.phase.saturating_sub(*n))],
            Op::Mux { .. } => {
                let leg = self.taken(node, step.phase);
                vec![at(node.args[1 + leg], step.phase)]
            }
            Op::ScanOr => {
                let mut operands = vec![at(node.args[0], step.phase), at(node.args[1], step.phase)];
                if step.phase > 0 {
                    operands.push(Step { node: step.node, phase: step.phase - 1 });
                }
                operands
            }
            _ => node.args.iter().map(|a| at(*a, step.phase)).collect(),
        }
    }

    fn taken(&self, mux: &FlatNode, phase: usize) -> usize {
        pattern(&self.nodes[mux.args[0]].op, phase).unwrap_or(0)
    }

    fn order(&mut self) {
        // Depth-first over (node, phase): 0 not seen, 1 open, 2 done.
        let mut state = vec![0u8; self.nodes.len() * self.interval];
        let mut steps = vec![];
        for node in 0..self.nodes.len() {
            for phase in 0..if self.per_phase(node) { self.interval } else { 1 } {
                let mut stack = vec![Step { node, phase }];
                while let Some(step) = stack.last().copied() {
                    let key = step.node * self.interval + step.phase;
                    match state[key] {
                        0 => {
                            state[key] = 1;
                            let operands = self.operands(step);
                            stack.extend(operands.iter().filter(|s| state[s.node * self.interval + s.phase] != 2));
                        }
                        1 => {
                            state[key] = 2;
                            steps.push(step);
                            stack.pop();
                        }
                        _ => {
                            stack.pop();
                        }
                    }
                }
            }
        }
        self.steps = steps;
    }
}

/// The value of a phase pattern (or constant) in one phase; none where it does not matter.
///
/// # Panics
/// If the operation is neither.
pub fn pattern(op: &Op, phase: usize) -> Option<usize> {
    match op {
        Op::Phase(values) => values[phase].map(|v| v as usize),
        Op::Comb(Comb::Constant(Constant(value, _))) => Some(*value as usize),
        other => panic!("expected a constant of each phase, found {other:?}"),
    }
}
