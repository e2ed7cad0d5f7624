//! Operations that are too long for a clock, divided: the scheduler then puts registers between their parts.
//!
//! A word `x` of a sum is `2^k X + x'`, `x'` its lowest k bits. With the carry `c` of the lowest bits the others are `A + B + c`, for
//! which one chain does: they are `(2A + 1) + (2B + c)` without the lowest bit. In the same way
//!
//! * `a - b` has `2A - (2B + c)`, with the borrow `c` of `a' - b'`, and `a < b` is `2A < 2B + c`;
//! * `-x` has `-(2X + c)`, with `c` set unless `x'` is 0: so have negations under a flag and magnitudes;
//! * words are equal if all their parts are, and have a bit set if one of the parts has;
//! * a choice among many is one in each group of them, by the lowest bits of the index, then one among groups.
//!
//! The upper part is divided again if need be. What no clock holds even so stays as it is.

use super::delay;
use crate::device::Device;
use crate::graph::{Block, Node, NodeId, Op, Place, Rate};
use crate::op::*;
use std::collections::HashSet;
use std::rc::Rc;

/// Bits of the least part that is worth a clock of its own.
const LEAST: u32 = 4;

/// The block with operations divided that take more than `room` ns between registers; itself if there are none.
pub(super) fn divided(block: &Rc<Block>, device: &Device, room: f64) -> Rc<Block> {
    let long = |i: usize| matches!(&block.nodes[i].op, Op::Comb(op) if divisible(op)) && delay(device, block, i) > room;
    let long: Vec<bool> = (0..block.nodes.len()).map(long).collect();
    if !long.contains(&true) {
        return Rc::clone(block);
    }
    let names = block.nodes.iter().map(Node::name).collect();
    let mut division = Division { device, room, nodes: vec![], ranges: vec![], names, section: None };
    let mut at: Vec<NodeId> = vec![];
    for (i, node) in block.nodes.iter().enumerate() {
        let id = match &node.op {
            Op::Comb(op) if long[i] => {
                division.section = node.section;
                let args: Vec<NodeId> = node.args.iter().map(|a| at[a.0]).collect();
                let made = division.part(op.clone(), &args, &node.place, "");
                division.in_place_of(node, made)
            }
            _ => division.keep(node.clone()),
        };
        division.ranges[id.0] = block.range(i);
        at.push(id);
    }
    Rc::new(block.remade(division.nodes, division.ranges, &at, |i| !long[i]))
}

/// Whether there are parts of an operation.
fn divisible(op: &Comb) -> bool {
    use Comb::*;
    matches!(
        op,
        Add(_) | Subtract(_) | Negate(_) | NegateIf(_) | Magnitude(_) | Less(_) | Equal(_) | OrReduce(_) | Select(_)
    )
}

struct Division<'a> {
    device: &'a Device,
    room: f64,
    nodes: Vec<Node>,
    ranges: Vec<Range>,
    names: HashSet<String>,
    /// That of what is divided.
    section: Option<usize>,
}

impl Division<'_> {
    fn keep(&mut self, node: Node) -> NodeId {
        self.nodes.push(node);
        self.ranges.push((0, 0));
        NodeId(self.nodes.len() - 1)
    }

    /// Gives the last of the new nodes the name and the comment of what it stands for.
    fn in_place_of(&mut self, node: &Node, made: NodeId) -> NodeId {
        let last = &mut self.nodes[made.0];
        assert_eq!(last.ty, node.ty, "{}", node.name());
        self.names.remove(&last.name());
        (last.place, last.named, last.comment) = (node.place.clone(), node.named, node.comment.clone());
        made
    }

    fn ty(&self, id: NodeId) -> Type {
        self.nodes[id.0].ty
    }

    /// A new node; of constants it is one.
    fn push(&mut self, op: impl Into<Comb>, args: &[NodeId], of: &Place, name: &str) -> NodeId {
        let op = op.into();
        let types: Vec<Type> = args.iter().map(|a| self.ty(*a)).collect();
        let ty = op.result(&types).unwrap_or_else(|why| panic!("{of}, {name}: {why}"));
        let constants: Option<Vec<i128>> = args.iter().map(|a| self.constant(*a)).collect();
        let (op, args, range) = match constants.filter(|_| !args.is_empty()) {
            Some(values) => {
                let value = op.value(&values, &types, ty);
                (Constant(value, ty).into(), vec![], (value, value))
            }
            None => {
                let ranges: Vec<Range> = args.iter().map(|a| self.ranges[a.0]).collect();
                let range = op.range(&ranges, &types, ty);
                (op, args.to_vec(), if ty.holds(range) { range } else { ty.limits() })
            }
        };
        let rate = args.iter().map(|a| self.nodes[a.0].rate).find(|rate| *rate != Rate::Any).unwrap_or(Rate::Any);
        let mut place = of.suffixed(name);
        while !self.names.insert(place.to_string()) {
            place = place.suffixed("part");
        }
        let (comment, section) = (String::new(), self.section);
        let node = Node { op: Op::Comb(op), args, ty, rate, place, named: false, comment, section };
        let id = self.keep(node);
        self.ranges[id.0] = range;
        id
    }

    fn constant(&self, id: NodeId) -> Option<i128> {
        match &self.nodes[id.0].op {
            Op::Comb(Comb::Constant(constant)) => Some(constant.0),
            _ => None,
        }
    }

    fn fits(&self, op: &Comb, types: &[Type]) -> bool {
        op.result(types).is_ok_and(|to| op.delay(self.device, types, to) <= self.room)
    }

    /// How many of so many bits make the lowest part: as few as there must be with the least number of parts of which a clock
    /// holds each, the others with a carry; none if it does not hold even a small one.
    fn lowest(&self, bits: u32, holds: impl Fn(u32) -> bool) -> Option<u32> {
        let most = (LEAST..bits).rev().find(|k| holds(*k))?;
        let more = (bits - most).div_ceil(most.saturating_sub(1).max(1));
        // One bit alone would be a flag.
        Some(bits.div_ceil(more + 1).max(LEAST).min(most).min(bits - 2))
    }

    /// The value of an operation, in as many parts as it takes.
    fn part(&mut self, op: Comb, args: &[NodeId], of: &Place, name: &str) -> NodeId {
        let types: Vec<Type> = args.iter().map(|a| self.ty(*a)).collect();
        let whole = if name.is_empty() { "whole" } else { name };
        let made = match &op {
            _ if self.fits(&op, &types) => None,
            Comb::Add(_) | Comb::Subtract(_) => self.sum(&op, [args[0], args[1]], of, name),
            Comb::Negate(_) => {
                let to = op.result(&types).expect("it was made before");
                let zero = self.push(Constant(0, types[0]), &[], of, &join(name, "zero"));
                self.sum(&Subtract(Some(to.bits)).into(), [zero, args[0]], of, name)
            }
            Comb::NegateIf(_) => self.negation(args[0], args[1], true, of, name),
            Comb::Magnitude(_) => {
                let sign = self.push(SignBit, args, of, &join(name, "sign"));
                self.negation(sign, args[0], false, of, name)
            }
            Comb::Less(_) => self.less([args[0], args[1]], of, name),
            Comb::Equal(_) => self.equal([args[0], args[1]], of, name),
            Comb::OrReduce(_) => self.any(args[0], of, name),
            Comb::Select(_) => self.choice(&op, args, of, name),
            _ => None,
        };
        made.unwrap_or_else(|| self.push(op, args, of, whole))
    }

    /// A word in a type, its lowest bits and the others.
    fn halves(&mut self, x: NodeId, ty: Type, k: u32, of: &Place, name: &str) -> [NodeId; 2] {
        let ty = Type { fraction: self.ty(x).fraction, ..ty };
        let x = if self.ty(x) == ty { x } else { self.push(Resize(ty), &[x], of, &join(name, "wide")) };
        [self.push(LowBits(k), &[x], of, &join(name, "low")), self.push(Floor(k), &[x], of, &join(name, "rest"))]
    }

    /// The same of two operands.
    fn both(&mut self, [a, b]: [NodeId; 2], ty: Type, k: u32, of: &Place, name: &str) -> [[NodeId; 2]; 2] {
        [(a, "a"), (b, "b")].map(|(x, operand)| self.halves(x, ty, k, of, &join(name, operand)))
    }

    fn sum(&mut self, op: &Comb, args: [NodeId; 2], of: &Place, name: &str) -> Option<NodeId> {
        let to = op.result(&args.map(|a| self.ty(a))).expect("it was made before");
        let minus = matches!(op, Comb::Subtract(_));
        let make = |bits: Option<u32>| -> Comb { if minus { Subtract(bits).into() } else { Add(bits).into() } };
        let k = self.lowest(to.bits, |k| self.fits(&make(None), &[Type::unsigned(k); 2]))?;
        let [[a_low, a], [b_low, b]] = self.both(args, to, k, of, name);
        let low = self.push(make(None), &[a_low, b_low], of, &join(name, "low"));
        let carry = if minus {
            self.push(SignBit, &[low], of, &join(name, "carry"))
        } else {
            let bit = self.push(Floor(k), &[low], of, &join(name, "carry"));
            self.push(Resize(Type::FLAG), &[bit], of, &join(name, "carry_flag"))
        };
        let ones = self.push(Constant(i128::from(!minus), Type::FLAG), &[], of, &join(name, "one"));
        let a = self.push(Concatenate, &[ones, a], of, &join(name, "a_up"));
        let b = self.push(Concatenate, &[carry, b], of, &join(name, "b_up"));
        let high = self.part(make(Some(to.bits - k + 1)), &[a, b], of, &join(name, "high"));
        Some(self.joined(low, high, k, to.signed, of, name))
    }

    /// Negated under a flag; where a clock does not hold the choice in front of a chain, chosen behind it.
    fn negation(&mut self, flag: NodeId, x: NodeId, keeps_sign: bool, of: &Place, name: &str) -> Option<NodeId> {
        let ty = self.ty(x);
        let holds = |k| self.fits(&NegateIf.into(), &[Type::FLAG, Type::signed(k + 1, 0)]);
        let Some(k) = self.lowest(ty.bits, holds) else {
            let minus = self.part(Negate(Some(ty.bits)).into(), &[x], of, &join(name, "minus"));
            let chosen = self.push(Select(None), &[flag, x, minus], of, &join(name, "chosen"));
            let ty = Type { signed: keeps_sign, ..ty };
            return Some(if keeps_sign { chosen } else { self.push(Resize(ty), &[chosen], of, &join(name, "whole")) });
        };
        let [x_low, x] = self.halves(x, ty, k, of, &join(name, "x"));
        let signed = Type { signed: true, bits: k + 1, ..self.ty(x_low) };
        let positive = self.push(Resize(signed), &[x_low], of, &join(name, "positive"));
        let low = self.push(NegateIf, &[flag, positive], of, &join(name, "low"));
        let carry = self.part(OrReduce.into(), &[x_low], of, &join(name, "carry"));
        let above = self.push(Concatenate, &[carry, x], of, &join(name, "up"));
        let high = self.part(NegateIf.into(), &[flag, above], of, &join(name, "high"));
        Some(self.joined(low, high, k, keeps_sign, of, name))
    }

    /// The lowest bits of one part, and the other without its carry.
    fn joined(&mut self, low: NodeId, high: NodeId, k: u32, signed: bool, of: &Place, name: &str) -> NodeId {
        let low = self.push(LowBits(k), &[low], of, &join(name, "sum_low"));
        let mut high = self.push(Floor(1), &[high], of, &join(name, "sum_high"));
        let ty = Type { signed, ..self.ty(high) };
        if ty != self.ty(high) {
            high = self.push(Resize(ty), &[high], of, &join(name, "sum_top"));
        }
        self.push(Concatenate, &[low, high], of, &join(name, "whole"))
    }

    fn less(&mut self, args: [NodeId; 2], of: &Place, name: &str) -> Option<NodeId> {
        let ty = Type::joint(&args.map(|a| self.ty(a))).expect("it was made before");
        let k = self.lowest(ty.bits, |k| self.fits(&Subtract(None).into(), &[Type::unsigned(k); 2]))?;
        let [[a_low, a], [b_low, b]] = self.both(args, ty, k, of, name);
        let low = self.push(Subtract(None), &[a_low, b_low], of, &join(name, "low"));
        let borrow = self.push(SignBit, &[low], of, &join(name, "borrow"));
        let zero = self.push(Constant(0, Type::FLAG), &[], of, &join(name, "zero"));
        let a = self.push(Concatenate, &[zero, a], of, &join(name, "a_up"));
        let b = self.push(Concatenate, &[borrow, b], of, &join(name, "b_up"));
        Some(self.part(Less.into(), &[a, b], of, &join(name, "high")))
    }

    fn equal(&mut self, args: [NodeId; 2], of: &Place, name: &str) -> Option<NodeId> {
        let ty = Type::joint(&args.map(|a| self.ty(a))).expect("it was made before");
        let k = self.lowest(ty.bits, |k| self.fits(&Equal.into(), &[Type::unsigned(k); 2]))?;
        let [[a_low, a], [b_low, b]] = self.both(args, ty, k, of, name);
        let low = self.push(Equal, &[a_low, b_low], of, &join(name, "low"));
        let high = self.part(Equal.into(), &[a, b], of, &join(name, "high"));
        Some(self.push(And, &[low, high], of, &join(name, "whole")))
    }

    fn choice(&mut self, op: &Comb, args: &[NodeId], of: &Place, name: &str) -> Option<NodeId> {
        let (index, legs) = (args[0], &args[1..]);
        // Legs beyond the greatest index are not chosen, and an index beyond the last leg chooses that.
        let most = self.ranges[index.0].1 as usize;
        let legs: Vec<NodeId> = (0..=most).map(|i| legs[i.min(legs.len() - 1)]).collect();
        let fits = |legs: usize| self.device.mux(legs) <= self.room;
        let bits = (1..self.ty(index).bits).rev().find(|bits| 1 << bits < legs.len() && fits(1 << bits))?;
        let low = self.push(LowBits(bits), &[index], of, &join(name, "in_group"));
        let high = self.push(Floor(bits), &[index], of, &join(name, "group"));
        let mut groups = vec![high];
        for (i, group) in legs.chunks(1 << bits).enumerate() {
            let operands: Vec<NodeId> = [low].iter().chain(group).copied().collect();
            let same = group.iter().all(|leg| *leg == group[0]);
            let chosen = (!same).then(|| self.push(op.clone(), &operands, of, &join(name, &format!("group_{i}"))));
            groups.push(chosen.unwrap_or(group[0]));
        }
        Some(self.part(op.clone(), &groups, of, &join(name, "groups")))
    }

    fn any(&mut self, x: NodeId, of: &Place, name: &str) -> Option<NodeId> {
        let ty = self.ty(x);
        let k = self.lowest(ty.bits, |k| self.fits(&OrReduce.into(), &[Type::unsigned(k)]))?;
        let [x_low, x] = self.halves(x, ty, k, of, &join(name, "x"));
        let low = self.push(OrReduce, &[x_low], of, &join(name, "low"));
        let high = self.part(OrReduce.into(), &[x], of, &join(name, "high"));
        Some(self.push(Or, &[low, high], of, &join(name, "whole")))
    }
}

/// The name of a part of a part: `high2` is the upper part of `high`.
fn join(name: &str, part: &str) -> String {
    match name.strip_prefix("high").map(|level| level.parse::<u32>().unwrap_or(1)) {
        Some(level) if part == "high" => format!("high{}", level + 1),
        _ if name.is_empty() => part.to_owned(),
        _ => format!("{name}_{part}"),
    }
}
