//! Operations on words of bits: arithmetic becomes carry chains, everything else gates.

use super::gates::{Bit, Gates};
use crate::device::{Chains, Fabric};
use crate::graph::{Op, Type};
use std::collections::HashMap;

/// A carry chain. Bit i of an adder has the operands `(a, b)`; bit i of a comparison the flags that carry is passed on
/// and, otherwise, what it becomes.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct Chain {
    /// Whether sums leave the chain, or its last carry alone.
    pub sums: bool,
    /// Operands, the lowest bit first.
    pub operands: Vec<(Bit, Bit)>,
    /// Carry into the lowest bit.
    pub carry: Bit,
}

/// What a leaf is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Source {
    /// Comes from outside: a port, an instance, a memory.
    Outside,
    /// Bit of a register, by index.
    Register(usize),
    /// Output of a bit of a chain.
    Chain(usize, usize),
    /// Output of a multiplier.
    Product(usize),
}

/// Gates and what is no gate.
pub(super) struct Words {
    pub fabric: &'static Fabric,
    pub gates: Gates,
    pub sources: HashMap<usize, Source>,
    pub chains: Vec<Chain>,
    /// For every chain of sums with tables in front, what these tables compute.
    differences: Vec<Vec<Bit>>,
    /// The operands of every multiplier.
    pub products: Vec<[Vec<Bit>; 2]>,
    known: HashMap<Chain, Vec<Bit>>,
}

/// A word cut or extended to a number of bits.
pub(super) fn resized(word: &[Bit], signed: bool, bits: u32) -> Vec<Bit> {
    let fill = if signed { word[word.len() - 1] } else { Bit::ZERO };
    (0..bits as usize).map(|i| word.get(i).copied().unwrap_or(fill)).collect()
}

/// The bits of a number.
pub(super) fn number(value: i128, bits: u32) -> Vec<Bit> {
    (0..bits).map(|i| Bit::constant((value >> i) & 1 == 1)).collect()
}

impl Words {
    pub fn new(fabric: &'static Fabric) -> Self {
        Self {
            fabric,
            gates: Gates::new(),
            sources: HashMap::new(),
            chains: vec![],
            differences: vec![],
            products: vec![],
            known: HashMap::new(),
        }
    }

    /// New leaves.
    pub fn leaves(&mut self, bits: u32, source: impl Fn(usize) -> Source) -> Vec<Bit> {
        let all = 0..bits as usize;
        all.map(|i| {
            let leaf = self.gates.leaf();
            self.sources.insert(leaf.gate(), source(i));
            leaf
        })
        .collect()
    }

    /// The result of an operation, `args` being its operands.
    pub fn operation(&mut self, op: &Op, args: &[(Vec<Bit>, Type)], to: Type) -> Vec<Bit> {
        let joint = args.iter().map(|a| a.1.bits).max().unwrap_or(1);
        let word = |i: usize, bits: u32| resized(&args[i].0, args[i].1.signed, bits);
        match op {
            Op::Constant(value) => number(*value, to.bits),
            Op::Add => self.add(&word(0, to.bits), &word(1, to.bits), Bit::ZERO),
            Op::Subtract => {
                let minus: Vec<Bit> = word(1, to.bits).into_iter().map(|b| !b).collect();
                self.add(&word(0, to.bits), &minus, Bit::ONE)
            }
            Op::Negate => {
                let minus: Vec<Bit> = word(0, to.bits).into_iter().map(|b| !b).collect();
                self.add(&number(0, to.bits), &minus, Bit::ONE)
            }
            Op::NegateIf => self.negate_if(args[0].0[0], &args[1].0),
            Op::Magnitude => {
                let value = &args[0].0;
                self.negate_if(value[value.len() - 1], value)
            }
            Op::Multiply if to.bits < self.fabric.shortest_product => {
                self.small_product(&word(0, to.bits), &args[1].0, to.bits)
            }
            Op::Multiply => {
                let product = self.products.len();
                self.products.push([args[0].0.clone(), args[1].0.clone()]);
                self.leaves(to.bits, |_| Source::Product(product))
            }
            Op::Equal => vec![self.gates.equal(&word(0, joint), &word(1, joint))],
            Op::And => self.bitwise(args, Gates::and),
            Op::Or => self.bitwise(args, Gates::or),
            Op::Not => args[0].0.iter().map(|b| !*b).collect(),
            Op::AnyBit => vec![self.gates.any(&args[0].0)],
            Op::SignBit => vec![args[0].0[args[0].0.len() - 1]],
            Op::Floor(drop) => args[0].0[*drop as usize..].to_vec(),
            Op::Append(zeros) => [number(0, *zeros), args[0].0.clone()].concat(),
            Op::LowBits(bits) => args[0].0[..*bits as usize].to_vec(),
            Op::Clamp(bound, _) => {
                let (value, most, least) = (&args[0].0, number(*bound, to.bits), number(-bound, to.bits));
                let above = self.less(&most, value, to.signed);
                let below = self.less(value, &least, to.signed);
                let inside = self.choose(below, &least, value);
                self.choose(above, &most, &inside)
            }
            Op::Lookup(table, _) => (0..to.bits).map(|bit| self.lookup(table, bit, &args[0].0)).collect(),
            Op::Select => self.select(&args[0].0, &(1..args.len()).map(|i| word(i, to.bits)).collect::<Vec<_>>()),
            Op::Concatenate => args.iter().flat_map(|a| a.0.iter().copied()).collect(),
            Op::Resize(_) | Op::Reinterpret(_) => word(0, to.bits),
            Op::Input
            | Op::Assert(..)
            | Op::Fact(_)
            | Op::Phase(..)
            | Op::Hold { .. }
            | Op::Choose { .. }
            | Op::ScanOr
            | Op::Instance(_)
            | Op::Output(_) => unreachable!("{op:?} is no operation of a module"),
        }
    }

    fn bitwise(&mut self, args: &[(Vec<Bit>, Type)], gate: fn(&mut Gates, Bit, Bit) -> Bit) -> Vec<Bit> {
        args[0].0.iter().zip(&args[1].0).map(|(a, b)| gate(&mut self.gates, *a, *b)).collect()
    }

    fn choose(&mut self, flag: Bit, set: &[Bit], clear: &[Bit]) -> Vec<Bit> {
        set.iter().zip(clear).map(|(a, b)| self.gates.mux(flag, *a, *b)).collect()
    }

    /// Complement and carry: `-word` where the flag is set.
    fn negate_if(&mut self, flag: Bit, word: &[Bit]) -> Vec<Bit> {
        let complemented: Vec<Bit> = word.iter().map(|b| self.gates.xor(*b, flag)).collect();
        let one = resized(&[flag], false, word.len() as u32);
        self.add(&complemented, &one, Bit::ZERO)
    }

    /// A product as the sum of one operand at every bit of the other, whose sign counts negatively.
    fn small_product(&mut self, x: &[Bit], y: &[Bit], bits: u32) -> Vec<Bit> {
        let mut sum = number(0, bits);
        for (i, bit) in y.iter().enumerate() {
            let shifted = std::iter::repeat_n(Bit::ZERO, i).chain(x.iter().copied()).take(bits as usize);
            let row: Vec<Bit> = shifted.map(|x| self.gates.and(x, *bit)).collect();
            sum = if i + 1 == y.len() {
                let minus: Vec<Bit> = row.into_iter().map(|b| !b).collect();
                self.add(&sum, &minus, Bit::ONE)
            } else {
                self.add(&sum, &row, Bit::ZERO)
            };
        }
        sum
    }

    /// Legs one after the other, each under its own comparison; the last needs none.
    fn select(&mut self, index: &[Bit], legs: &[Vec<Bit>]) -> Vec<Bit> {
        let (last, others) = legs.split_last().expect("a choice has legs");
        let mut chosen = last.clone();
        for (i, leg) in others.iter().enumerate().rev() {
            let here = self.gates.equal(index, &number(i as i128, index.len() as u32));
            chosen = self.choose(here, leg, &chosen);
        }
        chosen
    }

    /// One bit of a table by halving; what lies beyond the table is the value it ends with.
    fn lookup(&mut self, table: &[i128], bit: u32, index: &[Bit]) -> Bit {
        match index.split_last() {
            _ if table.is_empty() => Bit::ZERO,
            None => Bit::constant((table[0] >> bit) & 1 == 1),
            Some((top, rest)) => {
                let half = table.len().min(1 << rest.len());
                let low = self.lookup(&table[..half], bit, rest);
                let high = if half < table.len() { self.lookup(&table[half..], bit, rest) } else { low };
                self.gates.mux(*top, high, low)
            }
        }
    }

    /// Sum of two words of one length, as long.
    fn add(&mut self, a: &[Bit], b: &[Bit], carry: Bit) -> Vec<Bit> {
        // Below the lowest bit of one operand the sum is the other.
        let blank = |(a, b): &(&Bit, &Bit)| **a == Bit::ZERO || **b == Bit::ZERO;
        let low = if carry == Bit::ZERO { a.iter().zip(b).take_while(blank).count().min(a.len() - 1) } else { 0 };
        let mut sum: Vec<Bit> = (0..low).map(|i| if a[i] == Bit::ZERO { b[i] } else { a[i] }).collect();
        let operands: Vec<(Bit, Bit)> = a[low..].iter().copied().zip(b[low..].iter().copied()).collect();
        if operands.len() <= self.fabric.shortest_sum {
            let mut carry = carry;
            for (a, b) in operands {
                let (bit, next) = self.gates.full_adder(a, b, carry);
                sum.push(bit);
                carry = next;
            }
        } else {
            let bits = operands.len();
            sum.extend(self.chain(Chain { sums: true, operands, carry }, bits));
        }
        sum
    }

    fn chain(&mut self, chain: Chain, outputs: usize) -> Vec<Bit> {
        if let Some(known) = self.known.get(&chain) {
            return known.clone();
        }
        let (index, bits) = (self.chains.len(), chain.operands.len());
        let through_tables = chain.sums && self.fabric.chains == Chains::WithTables;
        let operands = chain.operands.iter().filter(|_| through_tables);
        self.differences.push(operands.map(|(a, b)| self.gates.xor(*a, *b)).collect());
        self.chains.push(chain.clone());
        let sums = chain.sums;
        let outputs = self.leaves(outputs as u32, |i| Source::Chain(index, if sums { i } else { bits - 1 }));
        self.known.insert(chain, outputs.clone());
        outputs
    }

    /// The bits that bit `i` of a chain needs as signals. Where tables stand in front of the chain, a sum needs the
    /// exclusive disjunction of its operands, and one operand of the bit below for the carry. A complete chain
    /// complements operands itself.
    pub fn chain_inputs(&self, chain: usize, i: usize) -> Vec<Bit> {
        let (operands, differences) = (&self.chains[chain].operands, &self.differences[chain]);
        let complete = self.fabric.chains == Chains::Complete;
        let (a, b) = operands[i];
        match differences.get(i) {
            Some(differ) if i > 0 => vec![*differ, operands[i - 1].0],
            Some(differ) => vec![*differ],
            None => vec![a, b].into_iter().map(|bit| if complete { bit.plain() } else { bit }).collect(),
        }
    }

    /// Whether `a < b`.
    fn less(&mut self, a: &[Bit], b: &[Bit], signed: bool) -> Bit {
        let top = a.len() - 1;
        let mut pairs: Vec<(Bit, Bit)> = a.iter().copied().zip(b.iter().copied()).collect();
        if signed {
            // With the sign bits exchanged the words compare as unsigned ones.
            pairs[top] = (pairs[top].1, pairs[top].0);
        }
        match self.fabric.chains {
            Chains::WithTables => self.less_by_groups(&pairs),
            Chains::Complete => self.less_by_subtraction(a, b, signed),
        }
    }

    /// Groups of as many bits as a table takes, from the top, each passing the carry on where its bits are equal.
    fn less_by_groups(&mut self, pairs: &[(Bit, Bit)]) -> Bit {
        let most = self.fabric.lut_inputs();
        let mut groups: Vec<(Bit, Bit)> = vec![];
        let mut left = 0;
        for (a, b) in pairs.iter().rev() {
            let inputs = usize::from(!a.is_constant()) + usize::from(!b.is_constant());
            if groups.is_empty() || inputs > left {
                groups.push((Bit::ONE, Bit::ZERO));
                left = most;
            }
            left -= inputs;
            let (equal, below) = groups[groups.len() - 1];
            let here = self.gates.and(!*a, *b);
            let here = self.gates.and(equal, here);
            let same = !self.gates.xor(*a, *b);
            let group = (self.gates.and(equal, same), self.gates.or(below, here));
            *groups.last_mut().expect("a group was pushed") = group;
        }
        groups.reverse();
        if groups.len() <= self.fabric.shortest_comparison {
            return groups.iter().fold(Bit::ZERO, |carry, (equal, below)| {
                let passed = self.gates.and(*equal, carry);
                self.gates.or(*below, passed)
            });
        }
        self.chain(Chain { sums: false, operands: groups, carry: Bit::ZERO }, 1)[0]
    }

    /// The borrow of a difference; of signed numbers, its sign where it does not overflow.
    fn less_by_subtraction(&mut self, a: &[Bit], b: &[Bit], signed: bool) -> Bit {
        let top = a.len() - 1;
        if a.len() <= self.fabric.shortest_comparison {
            let mut borrow = Bit::ZERO;
            for (i, (a, b)) in a.iter().zip(b).enumerate() {
                let differ = self.gates.xor(*a, *b);
                borrow = self.gates.mux(differ, if signed && i == top { *a } else { *b }, borrow);
            }
            return borrow;
        }
        let operands = a.iter().zip(b).map(|(a, b)| (*a, !*b)).collect();
        // Last carry; and for the overflow the sum and the carry of the bits below it.
        let outputs = self.chain(Chain { sums: false, operands, carry: Bit::ONE }, 3);
        if !signed {
            return !outputs[0];
        }
        let (_, below) = self.gates.full_adder(a[top], !b[top], outputs[1]);
        let overflow = self.gates.xor(outputs[0], below);
        self.gates.xor(overflow, outputs[2])
    }
}
