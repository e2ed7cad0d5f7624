//! Operations on words of bits: arithmetic becomes carry chains, everything else gates.

use super::gates::{Bit, Gates};
use crate::device::{Chains, Fabric};
use crate::types::Type;
use std::collections::HashMap;

/// A carry chain that adds: bit i has the operands `(a, b)`.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Chain {
    /// Operands, the lowest bit first.
    pub operands: Vec<(Bit, Bit)>,
    /// Carry into the lowest bit.
    pub carry: Bit,
}

/// What a leaf is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// Comes from outside: a port, an instance, a memory.
    Outside,
    /// Bit of a register, by index.
    Register(usize),
    /// Output of a bit of a chain.
    Chain(usize, usize),
    /// Output of a multiplier.
    Product(usize),
    /// Output of the adder behind a multiplier.
    Sum(usize),
}

/// What an adder behind a multiplier adds, or takes the second from the first.
#[derive(Clone, Debug)]
pub struct Sum {
    /// What was there before, and the product.
    pub operands: [Vec<Bit>; 2],
    /// Whether it takes the product away.
    pub minus: bool,
}

/// An operand in cells.
pub struct Word {
    /// Its bits, the lowest first.
    pub bits: Vec<Bit>,
    /// Its type.
    pub ty: Type,
}

impl Word {
    /// The word cut, or extended by its own sign, to a number of bits.
    pub fn resized(&self, bits: u32) -> Vec<Bit> {
        resized(&self.bits, self.ty.signed, bits)
    }
}

/// Gates and what is no gate.
pub struct Words {
    /// What the cells are of.
    pub fabric: &'static Fabric,
    /// The gates.
    pub gates: Gates,
    /// What each leaf is, by its gate.
    pub sources: HashMap<usize, Source>,
    /// The carry chains.
    pub chains: Vec<Chain>,
    /// For every chain of sums with tables in front, what these tables compute.
    differences: Vec<Vec<Bit>>,
    /// The operands of every multiplier.
    pub products: Vec<[Vec<Bit>; 2]>,
    /// The adders behind multipliers.
    pub sums: Vec<Sum>,
    known: HashMap<Chain, Vec<Bit>>,
}

/// A word cut or extended to a number of bits.
pub fn resized(word: &[Bit], signed: bool, bits: u32) -> Vec<Bit> {
    let fill = if signed { word[word.len() - 1] } else { Bit::ZERO };
    (0..bits as usize).map(|i| word.get(i).copied().unwrap_or(fill)).collect()
}

/// The bits of a number.
pub fn number(value: i128, bits: u32) -> Vec<Bit> {
    (0..bits).map(|i| Bit::constant((value >> i) & 1 == 1)).collect()
}

impl Words {
    /// Nothing yet.
    pub fn new(fabric: &'static Fabric) -> Self {
        Self {
            fabric,
            gates: Gates::default(),
            sources: HashMap::new(),
            chains: vec![],
            differences: vec![],
            products: vec![],
            sums: vec![],
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

    /// A gate for every bit of two words of one length.
    pub fn bitwise(&mut self, args: &[Word], gate: fn(&mut Gates, Bit, Bit) -> Bit) -> Vec<Bit> {
        args[0].bits.iter().zip(&args[1].bits).map(|(a, b)| gate(&mut self.gates, *a, *b)).collect()
    }

    /// A product: a multiplier, or where it is too short for one, a sum.
    pub fn multiply(&mut self, args: &[Word], bits: u32) -> Vec<Bit> {
        if bits < self.fabric.shortest_product {
            return self.small_product(&args[0].resized(bits), &args[1].bits, bits);
        }
        let product = self.products.len();
        self.products.push([args[0].bits.clone(), args[1].bits.clone()]);
        self.leaves(bits, |_| Source::Product(product))
    }

    /// A sum with a product of as many bits, in the adder behind its multiplier.
    pub fn accumulate(&mut self, operands: [Vec<Bit>; 2], minus: bool) -> Vec<Bit> {
        let (sum, bits) = (self.sums.len(), operands[0].len() as u32);
        self.sums.push(Sum { operands, minus });
        self.leaves(bits, |_| Source::Sum(sum))
    }

    /// The one word where the flag is set, else the other.
    pub fn choose(&mut self, flag: Bit, set: &[Bit], clear: &[Bit]) -> Vec<Bit> {
        set.iter().zip(clear).map(|(a, b)| self.gates.mux(flag, *a, *b)).collect()
    }

    /// Complement and carry: `-word` where the flag is set.
    pub fn negate_if(&mut self, flag: Bit, word: &[Bit]) -> Vec<Bit> {
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
    pub fn select(&mut self, index: &[Bit], legs: &[Vec<Bit>]) -> Vec<Bit> {
        let (last, others) = legs.split_last().expect("a choice has legs");
        let mut chosen = last.clone();
        for (i, leg) in others.iter().enumerate().rev() {
            let here = self.gates.equal(index, &number(i as i128, index.len() as u32));
            chosen = self.choose(here, leg, &chosen);
        }
        chosen
    }

    /// One bit of a table by halving; what lies beyond the table is the value it ends with.
    pub fn lookup(&mut self, table: &[i128], bit: u32, index: &[Bit]) -> Bit {
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
    pub fn add(&mut self, a: &[Bit], b: &[Bit], carry: Bit) -> Vec<Bit> {
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
            sum.extend(self.chain(Chain { operands, carry }));
        }
        sum
    }

    fn chain(&mut self, chain: Chain) -> Vec<Bit> {
        if let Some(known) = self.known.get(&chain) {
            return known.clone();
        }
        let (index, bits) = (self.chains.len(), chain.operands.len() as u32);
        let through_tables = self.fabric.chains == Chains::WithTables;
        let operands = chain.operands.iter().filter(|_| through_tables);
        self.differences.push(operands.map(|(a, b)| self.gates.xor(*a, *b)).collect());
        self.chains.push(chain.clone());
        let outputs = self.leaves(bits, |i| Source::Chain(index, i));
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
}
