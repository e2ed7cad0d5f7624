//! Units: named graphs with ports, and the builder that makes them.

use super::op::{Op, Range, Type};
use std::collections::HashSet;
use std::rc::Rc;

/// A node of a unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct NodeId(pub(crate) usize);

/// How often a value changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rate {
    /// Follows its operands: the unit does not care (its inputs, constants).
    Any,
    /// Once a pair: the value is held for the whole slot of `interval` clocks.
    Pair,
    /// Once a clock: another value in every phase of the slot.
    Phase,
}

impl Rate {
    /// The rate of an operation on values of both rates, if it may combine them.
    pub(crate) fn join(self, other: Rate) -> Option<Rate> {
        match (self, other) {
            (Rate::Any, r) | (r, Rate::Any) => Some(r),
            (a, b) if a == b => Some(a),
            _ => None,
        }
    }
}

/// A node: operation, operands, type, name and comment.
#[derive(Clone, Debug)]
pub struct Node {
    /// What it computes.
    pub op: Op,
    /// Operands, in order.
    pub args: Vec<NodeId>,
    /// Type of the result.
    pub ty: Type,
    /// How often the result changes.
    pub rate: Rate,
    /// Name, unique in the unit: the path of the value in the design.
    pub name: String,
    /// Equation or source, one line; may be empty.
    pub comment: String,
}

/// An input port.
#[derive(Clone, Debug)]
pub struct Input {
    /// The node that stands for it.
    pub node: NodeId,
    /// Declared range: every instance must keep to it.
    pub range: Range,
}

/// A named graph with ports: one entity of the printed design.
#[derive(Clone, Debug)]
pub struct Unit {
    /// Name, also of the entity.
    pub name: String,
    /// What it is, for the entity's header: equation, source, formats.
    pub doc: Vec<String>,
    /// Clocks between pairs: number of phases of a slot.
    pub interval: usize,
    /// Nodes; operands come before their uses but for lagged legs of [`Op::Choose`].
    pub nodes: Vec<Node>,
    /// Input ports, in order.
    pub inputs: Vec<Input>,
    /// Output ports: name and node.
    pub outputs: Vec<(String, NodeId)>,
    /// Nodes that a probed design brings out for comparison, each with the phases in which its value has a meaning
    /// (phase 0 for per-pair values) and whether these are lagged ones.
    pub probes: Vec<(NodeId, Vec<(usize, bool)>)>,
}

impl Unit {
    /// A node of this unit.
    pub fn node(&self, id: NodeId) -> &Node {
        &self.nodes[id.0]
    }

    /// Whether the unit or a unit in it depends on the phase, and so has a `phase` port.
    pub fn phased(&self) -> bool {
        self.interval > 1
            && self.nodes.iter().any(|n| match &n.op {
                Op::Phase(..) | Op::Hold { .. } => true,
                Op::Choose { .. } => true,
                Op::Instance(unit) => unit.phased(),
                _ => false,
            })
    }

    /// Whether a node is its first operand under another name, format or bound: no hardware.
    pub fn renames(&self, node: usize) -> bool {
        let node = &self.nodes[node];
        match &node.op {
            Op::Assert(..) | Op::Fact(_) | Op::Reinterpret(_) => true,
            Op::Resize(to) => {
                let from = self.node(node.args[0]).ty;
                (from.signed, from.bits) == (to.signed, to.bits)
            }
            _ => false,
        }
    }

    /// Index of the output port of that name.
    ///
    /// # Panics
    /// If there is none.
    pub fn output(&self, name: &str) -> usize {
        self.outputs
            .iter()
            .position(|(n, _)| n == name)
            .unwrap_or_else(|| panic!("unit {} has no output {name}", self.name))
    }
}

/// A leg that is not connected yet.
const OPEN: NodeId = NodeId(usize::MAX);

/// Makes a unit. Every method that adds a node takes its name first; a graph that cannot be (widths, rates, names) is
/// a defect of the builder's caller and panics where it is written, naming unit, node and both types.
pub struct Builder {
    unit: Unit,
    names: HashSet<String>,
}

impl Builder {
    /// An empty unit with `interval` phases.
    pub fn new(name: impl Into<String>, interval: usize, doc: &[&str]) -> Self {
        let doc = doc.iter().map(|line| (*line).to_owned()).collect();
        let unit =
            Unit { name: name.into(), doc, interval, nodes: vec![], inputs: vec![], outputs: vec![], probes: vec![] };
        Self { unit, names: HashSet::new() }
    }

    /// Number of phases of a slot.
    pub fn interval(&self) -> usize {
        self.unit.interval
    }

    /// Type of a node.
    pub fn ty(&self, id: NodeId) -> Type {
        self.unit.nodes[id.0].ty
    }

    /// How often a node changes.
    pub fn rate(&self, id: NodeId) -> Rate {
        self.unit.nodes[id.0].rate
    }

    fn push(&mut self, name: &str, op: Op, args: Vec<NodeId>, ty: Type, rate: Rate) -> NodeId {
        let unit = &self.unit.name;
        assert!(self.names.insert(name.to_owned()), "unit {unit}: two nodes are called {name}");
        assert!(ty.bits >= 1 && ty.bits <= 120, "unit {unit}, node {name}: {} bits", ty.bits);
        self.unit.nodes.push(Node { op, args, ty, rate, name: name.to_owned(), comment: String::new() });
        NodeId(self.unit.nodes.len() - 1)
    }

    fn rate_of(&self, name: &str, args: &[NodeId]) -> Rate {
        args.iter().fold(Rate::Any, |rate, a| {
            let node = self.unit.node(*a);
            rate.join(node.rate).unwrap_or_else(|| {
                panic!(
                    "unit {}, node {name}: operand {} is {:?}, another {rate:?}; choose brings per-pair values into phases",
                    self.unit.name, node.name, node.rate
                )
            })
        })
    }

    /// Adds a combinational operation.
    ///
    /// # Panics
    /// If the operands do not fit it.
    pub fn op(&mut self, name: &str, op: Op, args: &[NodeId]) -> NodeId {
        let types: Vec<Type> = args.iter().map(|a| self.ty(*a)).collect();
        let ty = op.result(&types).unwrap_or_else(|e| panic!("unit {}, node {name}: {e}", self.unit.name));
        let rate = self.rate_of(name, args);
        self.push(name, op, args.to_vec(), ty, rate)
    }

    /// Gives a node its comment: the equation, with its source.
    pub fn comment(&mut self, id: NodeId, comment: impl Into<String>) -> NodeId {
        self.unit.nodes[id.0].comment = comment.into();
        id
    }

    /// Marks a node for comparison in a probed design; see [`Unit::probes`].
    pub fn probe(&mut self, id: NodeId, phases: Vec<(usize, bool)>) {
        self.unit.probes.push((id, phases));
    }

    /// An input port with the range that every instance keeps to.
    pub fn input(&mut self, name: &str, ty: Type, range: Range, rate: Rate) -> NodeId {
        let (min, max) = ty.limits();
        assert!(min <= range.0 && range.1 <= max, "unit {}, input {name}: {range:?} in {ty}", self.unit.name);
        let node = self.push(name, Op::Input, vec![], ty, rate);
        self.unit.inputs.push(Input { node, range });
        node
    }

    /// A constant.
    pub fn constant(&mut self, name: &str, value: i128, ty: Type) -> NodeId {
        self.push(name, Op::Constant(value), vec![], ty, Rate::Any)
    }

    /// A constant of every phase; none where it does not matter.
    pub fn phase(&mut self, name: &str, values: Vec<Option<i128>>, ty: Type) -> NodeId {
        assert_eq!(values.len(), self.unit.interval, "unit {}, node {name}: one value a phase", self.unit.name);
        let mut known = values.iter().flatten();
        let first = known.next().copied().unwrap_or(0);
        if known.all(|v| *v == first) {
            return self.constant(name, first, ty);
        }
        self.push(name, Op::Phase(values, ty), vec![], ty, Rate::Phase)
    }

    /// Per-phase choice among legs (node, lagged) by leg index; see [`Op::Choose`]. A lagged leg may be left open and
    /// [connected](Builder::connect) when its node exists.
    pub fn choose(&mut self, name: &str, select: NodeId, legs: &[(Option<NodeId>, bool)]) -> NodeId {
        let known: Vec<Type> = legs.iter().filter_map(|l| l.0).map(|n| self.ty(n)).collect();
        let first = *known.first().unwrap_or_else(|| panic!("unit {}, node {name}: no leg", self.unit.name));
        let fraction = if known.iter().all(|t| t.fraction == first.fraction) { first.fraction } else { 0 };
        for t in &known {
            assert_eq!((t.signed, t.bits), (first.signed, first.bits), "unit {}, node {name}", self.unit.name);
        }
        let args = std::iter::once(select).chain(legs.iter().map(|l| l.0.unwrap_or(OPEN))).collect();
        let op = Op::Choose { lagged: legs.iter().map(|l| l.1).collect() };
        self.push(name, op, args, Type { fraction, ..first }, Rate::Phase)
    }

    /// Connects an open leg of a choice.
    pub fn connect(&mut self, choose: NodeId, leg: usize, node: NodeId) {
        let (found, wanted) = (self.ty(node), self.ty(choose));
        assert_eq!((found.signed, found.bits), (wanted.signed, wanted.bits), "leg {leg} of {choose:?}");
        let arg = &mut self.unit.nodes[choose.0].args[1 + leg];
        assert_eq!(*arg, OPEN, "leg {leg} of {choose:?} is connected already");
        *arg = node;
    }

    /// The same per-pair value in every phase.
    pub fn broadcast(&mut self, name: &str, value: NodeId) -> NodeId {
        let select = self.constant(&format!("{name}_leg"), 0, Type::FLAG);
        self.choose(name, select, &[(Some(value), false)])
    }

    /// The value of a per-phase node in one phase, held for the slot.
    pub fn hold(&mut self, name: &str, value: NodeId, phase: usize, lagged: bool) -> NodeId {
        let ty = self.ty(value);
        self.push(name, Op::Hold { phase, lagged }, vec![value], ty, Rate::Pair)
    }

    /// Running disjunction over phases.
    pub fn scan_or(&mut self, name: &str, value: NodeId, first: NodeId) -> NodeId {
        let ty = self.ty(value);
        self.push(name, Op::ScanOr, vec![value, first], ty, Rate::Phase)
    }

    /// An instance of a unit; returns its outputs in order, named `{name}_{output}`.
    pub fn instance(&mut self, name: &str, unit: &Rc<Unit>, args: &[NodeId]) -> Vec<NodeId> {
        assert_eq!(args.len(), unit.inputs.len(), "unit {}, instance {name} of {}", self.unit.name, unit.name);
        let mut free = Rate::Any;
        for (arg, input) in args.iter().zip(&unit.inputs) {
            let (given, port) = (self.unit.node(*arg), unit.node(input.node));
            assert_eq!(
                (given.ty.signed, given.ty.bits),
                (port.ty.signed, port.ty.bits),
                "unit {}, instance {name}: {} is {}, port {} is {}",
                self.unit.name,
                given.name,
                given.ty,
                port.name,
                port.ty
            );
            match port.rate {
                Rate::Any => {
                    free = free
                        .join(given.rate)
                        .unwrap_or_else(|| panic!("unit {}, instance {name}: operands of both rates", self.unit.name));
                }
                rate => assert!(
                    given.rate == rate || given.rate == Rate::Any,
                    "unit {}, instance {name}: {} is {:?}, port {} {rate:?}",
                    self.unit.name,
                    given.name,
                    given.rate,
                    port.name
                ),
            }
        }
        let instance = self.push(name, Op::Instance(Rc::clone(unit)), args.to_vec(), Type::FLAG, free);
        let outputs = unit.outputs.iter().enumerate();
        outputs
            .map(|(i, (port, node))| {
                let node = unit.node(*node);
                let rate = if node.rate == Rate::Any { free } else { node.rate };
                self.push(&format!("{name}_{port}"), Op::Output(i), vec![instance], node.ty, rate)
            })
            .collect()
    }

    /// Makes a node an output port.
    pub fn output(&mut self, name: &str, id: NodeId) {
        self.unit.outputs.push((name.to_owned(), id));
    }

    /// The finished unit.
    ///
    /// # Panics
    /// If a leg is still open.
    pub fn finish(self) -> Rc<Unit> {
        for node in &self.unit.nodes {
            assert!(!node.args.contains(&OPEN), "unit {}, node {}: open leg", self.unit.name, node.name);
        }
        Rc::new(self.unit)
    }
}

/// Shorthand for the common operations.
impl Builder {
    /// Exact sum.
    pub fn add(&mut self, name: &str, a: NodeId, b: NodeId) -> NodeId {
        self.op(name, Op::Add, &[a, b])
    }

    /// Exact difference.
    pub fn subtract(&mut self, name: &str, a: NodeId, b: NodeId) -> NodeId {
        self.op(name, Op::Subtract, &[a, b])
    }

    /// Flag: `a < b`, the sign of their difference. One carry chain on every device, which synthesisers do not all make
    /// of a comparison.
    pub fn less(&mut self, name: &str, a: NodeId, b: NodeId) -> NodeId {
        let difference = self.subtract(&format!("{name}_difference"), a, b);
        let flag = self.op(name, Op::SignBit, &[difference]);
        let comment = format!("{} < {}", self.unit.node(a).name, self.unit.node(b).name);
        self.comment(flag, comment)
    }

    /// The lesser of two values.
    pub fn least(&mut self, name: &str, a: NodeId, b: NodeId) -> NodeId {
        let less = self.less(&format!("{name}_order"), a, b);
        self.either(name, less, a, b)
    }

    /// The greater of two values.
    pub fn greatest(&mut self, name: &str, a: NodeId, b: NodeId) -> NodeId {
        let less = self.less(&format!("{name}_order"), a, b);
        self.either(name, less, b, a)
    }

    /// `if_set` where the flag is set, else `if_clear`.
    pub fn either(&mut self, name: &str, flag: NodeId, if_set: NodeId, if_clear: NodeId) -> NodeId {
        self.op(name, Op::Select, &[flag, if_clear, if_set])
    }

    /// The same value in `bits` bits (an unsigned value becomes signed where `signed`).
    pub fn resize(&mut self, name: &str, a: NodeId, signed: bool, bits: u32) -> NodeId {
        let ty = self.ty(a);
        if ty.bits == bits && ty.signed == signed {
            return a;
        }
        self.op(name, Op::Resize(Type { signed, bits, fraction: ty.fraction }), &[a])
    }

    /// Flag conjunction.
    pub fn and(&mut self, name: &str, a: NodeId, b: NodeId) -> NodeId {
        self.op(name, Op::And, &[a, b])
    }

    /// Disjunction of any number of unsigned values, as a balanced tree.
    pub fn or_all(&mut self, name: &str, values: &[NodeId]) -> NodeId {
        self.tree(name, Op::Or, values)
    }

    /// A balanced tree of a two-operand operation.
    ///
    /// # Panics
    /// If there is nothing to combine.
    pub fn tree(&mut self, name: &str, op: Op, values: &[NodeId]) -> NodeId {
        match values {
            [] => panic!("unit {}, node {name}: empty tree", self.unit.name),
            [one] => *one,
            _ => {
                let (left, right) = values.split_at(values.len().div_ceil(2));
                let left = self.tree(&format!("{name}_l"), op.clone(), left);
                let right = self.tree(&format!("{name}_r"), op.clone(), right);
                self.op(name, op, &[left, right])
            }
        }
    }
}
