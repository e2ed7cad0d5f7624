//! Sums of products as chains of multipliers, where the part has an adder behind each of them.
//!
//! Multiplier k adds its product to what multiplier k - 1 has made, so it takes its factors k clocks later:
//!
//! ```text
//!   clock 1        clock 2       clock 3       clock 4
//!   x0 y0          s0 = x0 y0
//!   x1, y1         x1 y1         s1 = s0 + x1 y1
//!   x2, y2         x2, y2        x2 y2         s2 = s1 + x2 y2
//! ```
//!
//! A multiplier has registers for the product, for the sum, and two in front of each factor. What factors wait longer, they wait
//! in flip-flops: a chain ends where these are more than the look-up tables and flip-flops of the sum that it saves.
//!
//! A chain is an entity of its own, named after its multiplier: `multiply_18_18_chain_2_less_1_plus_5` is
//! `5 + x0 y0 + x1 y1 - x2 y2`.

use crate::device::{Device, SHORTEST_PRODUCT};
use crate::graph::{Block, Library, Node, NodeId, Op, Rate, Sig, Signals};
use crate::op::*;
use std::rc::Rc;

/// Clocks that a factor waits in registers of the multiplier.
const OWN_REGISTERS: u32 = 2;

/// An operand of a sum.
struct Term {
    /// What is added.
    node: usize,
    /// The product that this is, with another width or name at most.
    product: usize,
    minus: bool,
}

/// A sum that becomes chains.
struct Sum {
    products: Vec<Term>,
    constant: i128,
    others: Vec<Term>,
}

/// The block with sums of products as instances of chains; itself if there are none. `longest` is the latest arrival in a clock.
pub(super) fn chained(block: &Rc<Block>, device: &Device, longest: f64, library: &Library) -> Rc<Block> {
    if device.adder == 0 {
        return Rc::clone(block);
    }
    let mut search =
        Search { block, device, readers: readers(block), timed: timed(block), inner: vec![false; block.nodes.len()] };
    let mut sums: Vec<Option<Sum>> = block.nodes.iter().map(|_| None).collect();
    // Whole sums before their parts.
    for i in (0..sums.len()).rev() {
        sums[i] = search.sum(i);
    }
    if sums.iter().all(Option::is_none) {
        return Rc::clone(block);
    }
    let inner = search.inner;
    let mut making = Making { block, device, longest, library, nodes: vec![], ranges: vec![] };
    let mut at: Vec<NodeId> = vec![];
    for (i, sum) in sums.iter().enumerate() {
        let id = match sum {
            _ if inner[i] => NodeId(usize::MAX),
            Some(sum) => making.sum(i, sum, &at),
            None => making.push(block.nodes[i].clone(), block.range(i)),
        };
        at.push(id);
    }
    Rc::new(block.remade(making.nodes, making.ranges, &at, |i| !inner[i] && sums[i].is_none()))
}

/// How often each node is read, by others and outside.
fn readers(block: &Block) -> Vec<usize> {
    let mut readers = vec![0; block.nodes.len()];
    let inside = block.nodes.iter().flat_map(|node| &node.args);
    let outside = block.outputs.iter().map(|output| &output.1).chain(block.probes.iter().map(|probe| &probe.node));
    inside.chain(outside).for_each(|id| readers[id.0] += 1);
    readers
}

/// Whether the value of each node comes with the pair, and is not there at any time.
fn timed(block: &Block) -> Vec<bool> {
    let mut timed = vec![];
    for node in &block.nodes {
        timed.push(match node.op {
            Op::Input | Op::Mux { .. } | Op::Capture { .. } | Op::ScanOr => true,
            _ => node.args.iter().any(|arg| timed[arg.0]),
        });
    }
    timed
}

/// The factors of a product of hardware, with what it is called.
fn product(block: &Block, i: usize) -> Option<([NodeId; 2], String)> {
    let node = &block.nodes[i];
    match &node.op {
        Op::Comb(Comb::Multiply(_)) => {
            let [x, y] = [node.args[0], node.args[1]];
            let name = format!("{}_multiply_{}_{}", block.name, block.node(x).ty.bits, block.node(y).ty.bits);
            Some(([x, y], name))
        }
        Op::Output(_) => {
            let instance = block.node(node.args[0]);
            let Op::Instance(child) = &instance.op else { return None };
            let [.., last] = &child.nodes[..] else { return None };
            let alone = matches!(last.op, Op::Comb(Comb::Multiply(_))) && last.args == child.inputs[..];
            (alone && child.nodes.len() == 3).then(|| ([instance.args[0], instance.args[1]], child.name.clone()))
        }
        _ => None,
    }
}

struct Search<'a> {
    block: &'a Block,
    device: &'a Device,
    readers: Vec<usize>,
    timed: Vec<bool>,
    /// The nodes that go into a chain.
    inner: Vec<bool>,
}

impl Search<'_> {
    /// The sum that ends in a node, if some of its products make a chain; its nodes are then marked.
    fn sum(&mut self, i: usize) -> Option<Sum> {
        let is_sum = matches!(&self.block.nodes[i].op, Op::Comb(Comb::Add(_) | Comb::Subtract(_)));
        if self.inner[i] || !is_sum {
            return None;
        }
        let mut found = (Sum { products: vec![], constant: 0, others: vec![] }, vec![]);
        self.terms(i, false, &mut found);
        let (mut sum, mut inner) = found;
        // A chain is of alike multipliers.
        let name = |term: &Term| product(self.block, term.product).map(|(_, name)| name);
        let first = sum.products.first().and_then(name);
        let (products, others) = sum.products.into_iter().partition(|term| name(term) == first);
        sum.products = products;
        sum.others.extend::<Vec<Term>>(others);
        let fits = bits(sum.constant) <= self.block.nodes[sum.products.first()?.product].ty.bits;
        let times = sum.products.iter().any(|term| self.timed[term.product]);
        if sum.products.len() < 2 || !fits || !times {
            return None;
        }
        for term in &sum.products {
            inner.extend(self.path(term.node, term.product));
            if let Op::Output(_) = self.block.nodes[term.product].op {
                inner.push(self.block.nodes[term.product].args[0].0);
            }
        }
        inner.into_iter().for_each(|node| self.inner[node] = true);
        Some(sum)
    }

    /// Adds the operands of a sum to its terms, those of sums in it in their place; `found` has the nodes that are gone then too.
    fn terms(&self, i: usize, minus: bool, found: &mut (Sum, Vec<usize>)) {
        let node = &self.block.nodes[i];
        for (k, arg) in node.args.iter().enumerate() {
            let minus = minus != (k == 1 && matches!(node.op, Op::Comb(Comb::Subtract(_))));
            self.term(arg.0, minus, found);
        }
    }

    fn term(&self, i: usize, minus: bool, found: &mut (Sum, Vec<usize>)) {
        // What is no hardware between sums, and widths.
        let mut node = i;
        while self.readers[node] == 1 && self.keeps_value(node) {
            node = self.block.nodes[node].args[0].0;
        }
        let (sum, inner) = found;
        match &self.block.nodes[node].op {
            Op::Comb(Comb::Constant(constant)) => {
                sum.constant += if minus { -constant.0 } else { constant.0 };
            }
            Op::Comb(Comb::Add(_) | Comb::Subtract(_)) if self.readers[node] == 1 => {
                inner.extend(self.path(i, node));
                self.terms(node, minus, found);
            }
            _ if self.readers[node] == 1 && self.fits(node) => {
                sum.products.push(Term { node: i, product: node, minus })
            }
            _ => sum.others.push(Term { node: i, product: node, minus }),
        }
    }

    /// The nodes from one that has another's value down to that.
    fn path(&self, from: usize, to: usize) -> Vec<usize> {
        let below = |node: &usize| (*node != to).then(|| self.block.nodes[*node].args[0].0);
        std::iter::successors(Some(from), below).collect()
    }

    fn keeps_value(&self, i: usize) -> bool {
        let node = &self.block.nodes[i];
        match &node.op {
            Op::Assume(..) | Op::Known(_) | Op::Point => node.args.len() == 1,
            Op::Comb(Comb::Resize(to)) => to.0.holds(self.block.range(node.args[0].0)),
            _ => false,
        }
    }

    /// Whether it is a product that one multiplier makes.
    fn fits(&self, i: usize) -> bool {
        let bits = self.block.nodes[i].ty.bits;
        product(self.block, i).is_some_and(|(factors, _)| {
            let [x, y] = factors.map(|id| self.block.node(id).ty.bits);
            let [wide, narrow] = self.device.multiplier;
            x.max(y) <= wide && x.min(y) <= narrow && bits >= SHORTEST_PRODUCT
        })
    }
}

/// Bits of a signed number.
fn bits(number: i128) -> u32 {
    129 - number.unsigned_abs().leading_zeros()
}

struct Making<'a> {
    block: &'a Block,
    device: &'a Device,
    longest: f64,
    library: &'a Library,
    nodes: Vec<Node>,
    ranges: Vec<Range>,
}

/// A term made.
#[derive(Clone, Copy)]
struct Made {
    id: NodeId,
    minus: bool,
}

impl Making<'_> {
    fn push(&mut self, node: Node, range: Range) -> NodeId {
        self.nodes.push(node);
        self.ranges.push(range);
        NodeId(self.nodes.len() - 1)
    }

    /// A node that is made for a sum.
    fn part(&mut self, op: Op, args: Vec<NodeId>, ty: Type, range: Range, (root, name): (usize, &str)) -> NodeId {
        let of = &self.block.nodes[root];
        let (rate, place, section) = (of.rate, of.place.suffixed(name), of.section);
        let node = Node { op, args, ty, rate, place, named: false, comment: String::new(), section };
        self.push(node, range)
    }

    /// What stands for a sum.
    fn sum(&mut self, root: usize, sum: &Sum, at: &[NodeId]) -> NodeId {
        let lengths = self.lengths(sum);
        let mut products = &sum.products[..];
        let mut terms = vec![];
        for (k, length) in lengths.iter().enumerate() {
            let (chain, others) = products.split_at(*length);
            products = others;
            let constant = if k == 0 { sum.constant } else { 0 };
            let name = if lengths.len() > 1 { format!("chain_{k}") } else { "chain".to_owned() };
            terms.push(self.chain(root, chain, constant, &name, at));
        }
        for (k, term) in sum.others.iter().enumerate() {
            terms.push(Made { id: self.alike(root, at[term.node], k), minus: term.minus });
        }
        self.added(root, terms)
    }

    /// An operand with a sign and the binary point of the sum, which those of sums in it need not have.
    fn alike(&mut self, root: usize, mut id: NodeId, k: usize) -> NodeId {
        let (range, mut ty) = (self.ranges[id.0], self.nodes[id.0].ty);
        let fraction = self.block.nodes[root].ty.fraction;
        if ty.fraction != fraction {
            ty.fraction = fraction;
            id = self.part(Op::Point, vec![id], ty, range, (root, &format!("point_{k}")));
        }
        if !ty.signed {
            ty = Type { signed: true, bits: ty.bits + 1, ..ty };
            id = self.part(Op::Comb(Resize(ty).into()), vec![id], ty, range, (root, &format!("signed_{k}")));
        }
        id
    }

    /// In how many products each chain is.
    fn lengths(&self, sum: &Sum) -> Vec<usize> {
        let (count, first) = (sum.products.len(), sum.products[0].product);
        let (factors, _) = product(self.block, first).expect("it was one before");
        let bits: u32 = factors.iter().map(|id| self.block.node(*id).ty.bits).sum();
        let before = u32::from(self.device.registers_operands(bits, self.longest));
        // With product k and a constant there are k + 1 bits more.
        let holds = |k: &u32| {
            let waits = (k + before).saturating_sub(OWN_REGISTERS) * bits;
            waits <= 2 * (bits + k) && bits + k < self.device.adder
        };
        let most = (0..).take_while(holds).count();
        assert!(most > 2, "{}: expected an adder for three products of {bits} bits", self.device.name);
        let chains = count.div_ceil(most);
        (0..chains).map(|k| (count + k) / chains).rev().collect()
    }

    fn chain(&mut self, root: usize, products: &[Term], constant: i128, name: &str, at: &[NodeId]) -> Made {
        // What is taken away comes last; where that is all there is, the others take away the sum of it.
        let negative = products.iter().all(|term| term.minus);
        let (less, plus): (Vec<&Term>, Vec<&Term>) = products.iter().partition(|term| term.minus != negative);
        let constant = if negative { -constant } else { constant };
        let factors: Vec<[NodeId; 2]> = plus
            .iter()
            .chain(&less)
            .map(|term| product(self.block, term.product).expect("it was one before").0.map(|id| at[id.0]))
            .collect();
        let (_, multiplier) = product(self.block, products[0].product).expect("it was one before");
        let types = factors.iter().map(|pair| pair.map(|id| (self.nodes[id.0].ty, self.ranges[id.0]))).collect();
        let made = Chain { factors: types, less: less.len(), constant }.block(self.library, &multiplier);
        let output = made.node(made.outputs[0].1).ty;
        let range = made.range(made.outputs[0].1.0);
        let args = factors.iter().map(|pair| pair[0]).chain(factors.iter().map(|pair| pair[1])).collect();
        let instance = self.part(Op::Instance(made), args, Type::FLAG, (0, 0), (root, name));
        let ty = Type { fraction: self.block.nodes[root].ty.fraction, ..output };
        let id = self.part(Op::Output(0), vec![instance], ty, range, (root, &format!("{name}_sum")));
        Made { id, minus: negative }
    }

    /// Terms added two by two; the last sum is the root.
    fn added(&mut self, root: usize, mut terms: Vec<Made>) -> NodeId {
        let node = self.block.nodes[root].clone();
        let mut count = 0;
        while terms.len() > 1 {
            // Of a pair with different signs the first is positive.
            terms.sort_by_key(|term| term.minus);
            let mut next = vec![];
            for pair in terms.chunks(2) {
                let [a, b] = pair else {
                    next.push(pair[0]);
                    continue;
                };
                let minus = a.minus != b.minus;
                let last = terms.len() == 2 && !a.minus;
                let types = [a, b].map(|term| self.nodes[term.id.0].ty);
                let make = |bits: Option<u32>| -> Comb { if minus { Subtract(bits).into() } else { Add(bits).into() } };
                let whole = make(None).result(&types).expect("it was made before");
                let cut = last && node.ty.bits < whole.bits && node.ty.signed == whole.signed;
                let op = make(cut.then_some(node.ty.bits));
                let ty = op.result(&types).expect("it was made before");
                let ranges = [a, b].map(|term| self.ranges[term.id.0]);
                let range = op.range(&ranges, &types, ty);
                let range = if ty.holds(range) { range } else { ty.limits() };
                let id = self.part(Op::Comb(op), vec![a.id, b.id], ty, range, (root, &format!("part_{count}")));
                count += 1;
                next.push(Made { id, minus: a.minus });
            }
            terms = next;
        }
        let Made { mut id, minus } = terms[0];
        if minus {
            let ty = Type { bits: node.ty.bits, ..self.nodes[id.0].ty };
            let op = Negate(Some(ty.bits)).into();
            id = self.part(Op::Comb(op), vec![id], ty, self.block.range(root), (root, "negative"));
        }
        if self.nodes[id.0].ty != node.ty {
            id = self.part(Op::Comb(Resize(node.ty).into()), vec![id], node.ty, (0, 0), (root, "whole"));
        }
        let last = &mut self.nodes[id.0];
        (last.place, last.named, last.comment) = (node.place, node.named, node.comment);
        self.ranges[id.0] = self.block.range(root);
        id
    }
}

/// What makes a chain.
struct Chain {
    /// Types and ranges of the factors.
    factors: Vec<[(Type, Range); 2]>,
    /// How many of the products, the last ones, are taken away.
    less: usize,
    constant: i128,
}

impl Chain {
    /// Its block.
    fn block(&self, library: &Library, multiplier: &str) -> Rc<Block> {
        let (count, plus) = (self.factors.len(), self.factors.len() - self.less);
        let less = if self.less > 0 { format!("_less_{}", self.less) } else { String::new() };
        let constant = match self.constant {
            0 => String::new(),
            n if n < 0 => format!("_minus_{}", -n),
            n => format!("_plus_{n}"),
        };
        let term = |k: usize| format!("x({k}) y({k})");
        let mut sum = if self.constant == 0 { term(0) } else { format!("{} + {}", self.constant, term(0)) };
        (1..count).for_each(|k| sum += &format!(" {} {}", if k < plus { '+' } else { '-' }, term(k)));
        let doc = [
            &format!("p = {sum}, a chain of multipliers: each adds its product to what"),
            "the one before has made, and takes its factors a clock later.",
        ];
        library.block(&format!("{multiplier}_chain_{plus}{less}{constant}"), &doc, 1, |top| {
            let factor = |side: usize| -> Vec<Sig<'_>> {
                let port = |pair: &[(Type, Range); 2]| {
                    let (ty, range) = pair[side];
                    top.port(Type { fraction: None, ..ty }, vec![range], Rate::Any)
                };
                self.factors.iter().map(port).collect::<Vec<_>>().named(["x", "y"][side])
            };
            let sides = [factor(0), factor(1)];
            let waiting = |side: usize, k: usize| {
                let name = |clocks: usize| format!("{}{k}_d{clocks}", ["x", "y"][side]);
                (1..=k).fold(sides[side][k], |x, clocks| x.apply(Delay, &[]).named(&name(clocks)))
            };
            let product = |k: usize| (waiting(0, k) * waiting(1, k)).named(&format!("product{k}"));
            let first = product(0);
            let first = match self.constant {
                0 => first.apply(Delay, &[]),
                n => {
                    let ty = Type { signed: true, bits: bits(n), fraction: None };
                    top.constant(n, ty).apply(Accumulate { minus: false }, &[first])
                }
            };
            let mut sum = first;
            for k in 1..count {
                sum = sum.named(&format!("sum{}", k - 1)).apply(Accumulate { minus: k >= plus }, &[product(k)]);
            }
            sum.named("p")
        })
    }
}
