//! Blocks: named graphs with ports.

use super::place::{Place, Step};
use crate::op::{Comb, Range, Type};
use std::cell::RefCell;
use std::rc::Rc;

/// A node of a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct NodeId(pub usize);

/// How often a value changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rate {
    /// Follows its operands: the block does not care (its inputs, constants, what is steady).
    Any,
    /// Once per pair: the value is held for the whole slot of `interval` clocks.
    Pair,
    /// Once per clock: another value in every phase of the slot.
    Phase,
}

/// What a node is. Operands are the node's arguments, in order.
#[derive(Clone, Debug, PartialEq)]
pub enum Op {
    /// An input port of the block.
    Input,
    /// An input port of the block at the top that does not change while anything is in flight.
    Steady,
    /// A combinational operation.
    Comb(Comb),
    /// A constant per phase; none where it does not matter.
    Phase(Vec<Option<i128>>),
    /// The value of a per-phase operand in one phase, captured and held for the pair. `late` phases belong to the pair
    /// whose slot began a whole number of intervals earlier (see [`Op::Mux`]).
    Capture {
        /// Phase captured.
        phase: usize,
        /// Whether the phase is a late one.
        late: bool,
    },
    /// Operand multiplexer: in each phase one of the operands after the first, by the first, an [`Op::Phase`] or
    /// constant. Late operands are read a whole number of intervals later than the others: that is how a stage feeds
    /// results of early phases back into its later phases without waiting.
    Mux {
        /// One flag per operand.
        late: Vec<bool>,
    },
    /// Running disjunction over phases: the first operand is the value, the second a flag set in the phase that starts
    /// anew.
    ScanOr,
    /// The value of a per-phase operand this many phases before; that of the first phases has no meaning.
    Earlier(usize),
    /// No hardware: a bound on the computed value that ranges cannot see, by the named lemma, in the phases marked or,
    /// without marks, in all. Checked at every evaluation.
    Assume(Range, &'static str, Vec<bool>),
    /// No hardware: what the first operand is known to equal, as a function of the others; gives it the exact range.
    /// Checked at every evaluation.
    Known(Fact),
    /// No hardware: the same bits with another binary point.
    Point,
    /// An instance of a block; its arguments are the block's inputs, in order.
    Instance(Rc<Block>),
    /// This output of an instance.
    Output(usize),
}

/// What a value is known to equal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fact {
    /// The product of the second and third operand: a sum of partial products is the product they were cut from.
    Product,
    /// The second operand divided by 2^n, rounded up: floor + OR of the n dropped bits.
    Ceiling(u32),
}

impl Fact {
    /// What the first of the operands equals.
    pub fn value(self, args: &[i128]) -> i128 {
        match self {
            Self::Product => args[1] * args[2],
            Self::Ceiling(drop) => -(-args[1] >> drop),
        }
    }

    /// The range of that.
    pub fn range(self, args: &[Range]) -> Range {
        match self {
            Self::Product => {
                let [a, b] = [args[1], args[2]];
                crate::op::hull([a.0 * b.0, a.0 * b.1, a.1 * b.0, a.1 * b.1].map(|x| (x, x)))
            }
            Self::Ceiling(_) => (self.value(&[0, args[1].0]), self.value(&[0, args[1].1])),
        }
    }
}

/// A part of a block that is an entity of its own: what is made in it belongs to it, and everything keeps the clocks of the block.
// For lowering.
#[doc(hidden)]
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// Name, also of the entity.
    pub name: String,
    /// What it is, for the entity's header.
    pub doc: Vec<String>,
}

/// A node: operation, operands, type, name and comment.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// What it is.
    pub op: Op,
    /// Operands, in order.
    pub args: Vec<NodeId>,
    /// Type of the result.
    pub ty: Type,
    /// How often the result changes.
    pub rate: Rate,
    /// Name, unique in the block.
    pub place: Place,
    /// Whether somebody gave it this name: such nodes stay visible in the printed text.
    pub named: bool,
    /// Equation or source, one line; may be empty.
    pub comment: String,
    /// The section of the block in which it was made, if it was made in one.
    pub section: Option<usize>,
}

impl Node {
    /// The whole name in one word.
    pub fn name(&self) -> String {
        self.place.to_string()
    }
}

/// Nodes that a probed design brings out for comparison.
#[derive(Clone, Debug, PartialEq)]
pub struct Probe {
    /// The node.
    pub node: NodeId,
    /// The phases in which its value has a meaning, and whether they are late ones; phase 0 for per-pair values.
    pub phases: Vec<(usize, bool)>,
}

/// A named graph with ports: one entity of the printed design.
#[derive(Debug)]
pub struct Block {
    /// Name, also of the entity.
    pub name: String,
    /// What it is, for the entity's header: equation, source, formats.
    pub doc: Vec<String>,
    /// Clocks between pairs: number of phases of a slot.
    pub interval: usize,
    /// Nodes; operands come before their uses but for late operands of [`Op::Mux`].
    pub nodes: Vec<Node>,
    /// Input ports, in order.
    pub inputs: Vec<NodeId>,
    /// Output ports, in order.
    pub outputs: Vec<(Place, NodeId)>,
    /// What a probed design brings out.
    pub probes: Vec<Probe>,
    /// Sections, in the order of the data.
    pub sections: Vec<Section>,
    /// Range of every node over all phases and instances.
    ranges: RefCell<Vec<Range>>,
}

impl Block {
    pub(super) fn new(name: String, doc: Vec<String>, interval: usize) -> Self {
        let (nodes, inputs, outputs, probes, sections) = (vec![], vec![], vec![], vec![], vec![]);
        Self { name, doc, interval, nodes, inputs, outputs, probes, sections, ranges: RefCell::default() }
    }

    /// The same made of other nodes with these ranges, and where each is now. Those that are `kept` still have the operands of
    /// before, some of which come later.
    pub(crate) fn remade(
        &self,
        mut nodes: Vec<Node>,
        ranges: Vec<Range>,
        at: &[NodeId],
        kept: impl Fn(usize) -> bool,
    ) -> Self {
        for (i, node) in self.nodes.iter().enumerate().filter(|(i, _)| kept(*i)) {
            nodes[at[i].0].args = node.args.iter().map(|a| at[a.0]).collect();
        }
        let inputs = self.inputs.iter().map(|id| at[id.0]).collect();
        let outputs = self.outputs.iter().map(|(place, id)| (place.clone(), at[id.0])).collect();
        let probes = self.probes.iter().map(|p| Probe { node: at[p.node.0], ..p.clone() }).collect();
        let ranges = RefCell::new(ranges);
        Self {
            name: self.name.clone(),
            doc: self.doc.clone(),
            interval: self.interval,
            nodes,
            inputs,
            outputs,
            probes,
            sections: self.sections.clone(),
            ranges,
        }
    }

    /// A node of this block.
    pub fn node(&self, id: NodeId) -> &Node {
        &self.nodes[id.0]
    }

    /// The proven range of a node.
    pub fn range(&self, node: usize) -> Range {
        self.ranges.borrow()[node]
    }

    /// Includes the ranges of another use of the block.
    pub(super) fn widen(&self, ranges: &[Range]) {
        let mut own = self.ranges.borrow_mut();
        own.resize(ranges.len(), (i128::MAX, i128::MIN));
        own.iter_mut().zip(ranges).for_each(|(own, r)| *own = (own.0.min(r.0), own.1.max(r.1)));
    }

    /// Whether another block is the same but for ranges.
    pub(super) fn same(&self, other: &Self) -> bool {
        (&self.nodes, &self.inputs, &self.outputs) == (&other.nodes, &other.inputs, &other.outputs)
            && (self.interval, &self.doc, &self.sections) == (other.interval, &other.doc, &other.sections)
    }

    /// Whether the block has a `phase` port: values of pairs are captured in some phase of a slot of several clocks, if only to
    /// be held until the others are there.
    pub fn phased(&self) -> bool {
        self.interval > 1
    }

    /// Whether a node is its first operand under another name, format or bound: no hardware.
    pub fn renames(&self, node: usize) -> bool {
        let node = &self.nodes[node];
        match &node.op {
            Op::Assume(..) | Op::Known(_) | Op::Point => true,
            Op::Comb(Comb::Resize(to)) => self.node(node.args[0]).ty.same_bits(to.0),
            _ => false,
        }
    }

    /// The node that carries the value of a node in hardware.
    pub fn carrier(&self, mut node: usize) -> usize {
        while self.renames(node) {
            node = self.nodes[node].args[0].0;
        }
        node
    }

    /// Index of the output port of that name, in one word.
    ///
    /// # Panics
    /// If there is none.
    pub fn output(&self, name: &str) -> usize {
        let found = self.outputs.iter().position(|(place, _)| place.to_string() == name);
        found.unwrap_or_else(|| panic!("block {} has no output {name}", self.name))
    }
}

/// Instances of one block are equal.
impl PartialEq for Block {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self, other)
    }
}

impl Step {
    /// Whether two steps are of one kind, whatever element they go to.
    pub fn alike(self, other: Self) -> bool {
        match (self, other) {
            (Self::Field(a, ..), Self::Field(b, ..)) => a == b,
            _ => std::mem::discriminant(&self) == std::mem::discriminant(&other),
        }
    }
}
