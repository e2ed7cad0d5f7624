//! Gates on single bits, folded and shared as they are made: what is left is what synthesis has to map.

use std::collections::HashMap;

/// A bit: the output of a gate, possibly complemented. Complements cost nothing, a look-up table absorbs them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Bit(u32);

impl Bit {
    /// Always 0.
    pub const ZERO: Self = Self(0);
    /// Always 1.
    pub const ONE: Self = Self(1);

    /// The bit of a flag.
    pub fn constant(value: bool) -> Self {
        Self(u32::from(value))
    }

    /// The gate behind it.
    pub fn gate(self) -> usize {
        (self.0 >> 1) as usize
    }

    /// Whether it is a constant.
    pub fn is_constant(self) -> bool {
        self.0 <= 1
    }

    fn new(gate: usize) -> Self {
        Self((gate as u32) << 1)
    }

    /// Whether it is the complement of its gate.
    pub fn is_complement(self) -> bool {
        self.0 & 1 == 1
    }

    /// The gate's own output.
    pub fn plain(self) -> Self {
        Self(self.0 & !1)
    }
}

impl std::ops::Not for Bit {
    type Output = Self;

    fn not(self) -> Self {
        Self(self.0 ^ 1)
    }
}

/// A gate, its operands made before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Gate {
    /// The constant 0; gate 0 and no other.
    Zero,
    /// A bit from elsewhere: a port, register, carry chain, multiplier, memory or instance.
    Leaf,
    /// Conjunction.
    And(Bit, Bit),
    /// Exclusive disjunction.
    Xor(Bit, Bit),
    /// The second operand where the first is set, else the third.
    Mux(Bit, Bit, Bit),
}

impl Gate {
    /// The gates it reads.
    pub fn operands(self) -> impl Iterator<Item = usize> {
        let bits = match self {
            Gate::Zero | Gate::Leaf => [None; 3],
            Gate::And(a, b) | Gate::Xor(a, b) => [Some(a), Some(b), None],
            Gate::Mux(s, a, b) => [Some(s), Some(a), Some(b)],
        };
        bits.into_iter().flatten().map(Bit::gate)
    }
}

/// All gates of a module, operands before users.
pub struct Gates {
    /// The gates.
    pub all: Vec<Gate>,
    known: HashMap<Gate, Bit>,
}

/// Nothing but the constant.
impl Default for Gates {
    fn default() -> Self {
        Self { all: vec![Gate::Zero], known: HashMap::new() }
    }
}

impl Gates {
    /// A bit from elsewhere.
    pub fn leaf(&mut self) -> Bit {
        self.all.push(Gate::Leaf);
        Bit::new(self.all.len() - 1)
    }

    fn make(&mut self, gate: Gate) -> Bit {
        let all = &mut self.all;
        *self.known.entry(gate).or_insert_with(|| {
            all.push(gate);
            Bit::new(all.len() - 1)
        })
    }

    /// Conjunction.
    pub fn and(&mut self, a: Bit, b: Bit) -> Bit {
        match (a.min(b), a.max(b)) {
            (Bit::ZERO, _) => Bit::ZERO,
            (Bit::ONE, b) => b,
            (a, b) if a == b => a,
            (a, b) if a == !b => Bit::ZERO,
            (a, b) => self.make(Gate::And(a, b)),
        }
    }

    /// Disjunction.
    pub fn or(&mut self, a: Bit, b: Bit) -> Bit {
        !self.and(!a, !b)
    }

    /// Exclusive disjunction.
    pub fn xor(&mut self, a: Bit, b: Bit) -> Bit {
        let odd = a.is_complement() != b.is_complement();
        let (a, b) = (a.plain().min(b.plain()), a.plain().max(b.plain()));
        let even = match a {
            Bit::ZERO => b,
            a if a == b => Bit::ZERO,
            a => self.make(Gate::Xor(a, b)),
        };
        if odd { !even } else { even }
    }

    /// The second bit where the first is set, else the third.
    pub fn mux(&mut self, select: Bit, set: Bit, clear: Bit) -> Bit {
        if select.is_complement() {
            return self.mux(!select, clear, set);
        }
        match (select, set, clear) {
            (Bit::ZERO, _, clear) => clear,
            (_, set, clear) if set == clear => set,
            (s, set, clear) if set == !clear => self.xor(s, clear),
            (s, Bit::ZERO, clear) => self.and(!s, clear),
            (s, Bit::ONE, clear) => self.or(s, clear),
            (s, set, Bit::ZERO) => self.and(s, set),
            (s, set, Bit::ONE) => self.or(!s, set),
            (s, set, clear) if set.is_complement() => !self.make(Gate::Mux(s, !set, !clear)),
            (s, set, clear) => self.make(Gate::Mux(s, set, clear)),
        }
    }

    /// The disjunction of bits, as a tree.
    pub fn any(&mut self, bits: &[Bit]) -> Bit {
        match bits {
            [] => Bit::ZERO,
            [one] => *one,
            _ => {
                let (low, high) = bits.split_at(bits.len() / 2);
                let (low, high) = (self.any(low), self.any(high));
                self.or(low, high)
            }
        }
    }

    /// Whether two words of one length are equal.
    pub fn equal(&mut self, a: &[Bit], b: &[Bit]) -> Bit {
        let differences: Vec<Bit> = a.iter().zip(b).map(|(a, b)| self.xor(*a, *b)).collect();
        !self.any(&differences)
    }

    /// Sum and carry of three bits.
    pub fn full_adder(&mut self, a: Bit, b: Bit, carry: Bit) -> (Bit, Bit) {
        let half = self.xor(a, b);
        (self.xor(half, carry), self.mux(half, carry, a))
    }
}
