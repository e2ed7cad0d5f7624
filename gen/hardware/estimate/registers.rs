//! Registers, bit by bit: equal ones are one, some are part of a multiplier, and long delays are shift registers.

use crate::cells::{Bit, Source, Words};
use crate::device::MultiplierRegisters;
use std::collections::HashMap;

/// What governs a register.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Control {
    pub enable: Option<Bit>,
    pub reset: Option<Bit>,
    /// Value at the start and after a reset.
    pub start: Bit,
}

/// One bit.
#[derive(Clone, Copy, Debug)]
pub(super) struct Register {
    /// Its output.
    pub output: Bit,
    /// Its data, once connected.
    pub input: Option<(Bit, Control)>,
}

/// All registers of a module.
#[derive(Default)]
pub(super) struct Registers {
    pub all: Vec<Register>,
    known: HashMap<(Bit, Control), Bit>,
}

/// What registers take.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Taken {
    pub flip_flops: u64,
    pub shift_luts: u64,
}

/// Registers in a row that a multiplier has in front of each operand.
const OPERAND_REGISTERS: usize = 2;

/// A delay of fewer clocks stays in flip-flops.
const SHORTEST_SHIFT: usize = 3;

impl Registers {
    /// Registers whose data is not known yet.
    pub fn reserve(&mut self, outputs: &[Bit]) {
        self.all.extend(outputs.iter().map(|output| Register { output: *output, input: None }));
    }

    /// Connects reserved registers.
    pub fn connect(&mut self, first: usize, data: &[Bit], controls: &[Control]) {
        for ((register, data), control) in self.all[first..].iter_mut().zip(data).zip(controls) {
            register.input = Some((*data, *control));
        }
    }

    /// The output of a register, shared with an equal one; a register that never changes is its constant.
    pub fn output(&mut self, data: Bit, control: Control, words: &mut Words) -> Bit {
        if data == control.start {
            return data;
        }
        if let Some(known) = self.known.get(&(data, control)) {
            return *known;
        }
        let index = self.all.len();
        let output = words.leaves(1, |_| Source::Register(index))[0];
        self.all.push(Register { output, input: Some((data, control)) });
        self.known.insert((data, control), output);
        output
    }

    /// The bits a register reads.
    pub fn inputs(&self, i: usize) -> impl Iterator<Item = Bit> {
        let input = self.all[i].input;
        input.into_iter().flat_map(|(data, control)| [Some(data), control.enable, control.reset].into_iter().flatten())
    }

    /// What the registers in use take, `roots` being all bits that are there as signals, with repetitions.
    pub fn count(&self, used: &[bool], roots: &[Bit], words: &Words) -> Taken {
        let mut readers: HashMap<usize, u32> = HashMap::new();
        roots.iter().for_each(|r| *readers.entry(r.gate()).or_default() += 1);
        for gate in &words.gates.all {
            gate.operands().for_each(|o| *readers.entry(o).or_default() += 1);
        }
        let absorbed = self.absorbed(used, &readers, words);
        let register = |bit: Bit| match words.sources.get(&bit.gate()) {
            Some(Source::Register(i)) => Some(*i),
            _ => None,
        };
        // The register in front, where this one is nothing but its delay.
        let before = |i: usize| {
            let (data, control) = self.all[i].input?;
            let source = register(data).filter(|s| used[*s] && !absorbed[*s])?;
            let (_, other) = self.all[source].input?;
            let plain = control.reset.is_none() && other.reset.is_none() && control.enable == other.enable;
            (plain && readers.get(&data.gate()) == Some(&1)).then_some(source)
        };
        let most = words.fabric.longest_shift;
        let mut taken = Taken::default();
        let mut has_follower = vec![false; self.all.len()];
        let mine = |i: &usize| used[*i] && !absorbed[*i];
        let all: Vec<usize> = (0..self.all.len()).filter(mine).collect();
        all.iter().filter_map(|i| before(*i)).for_each(|source| has_follower[source] = true);
        for last in all.iter().copied().filter(|i| !has_follower[*i]) {
            let length = std::iter::successors(Some(last), |i| before(*i)).count();
            if most > 0 && length >= SHORTEST_SHIFT && self.all[last].input.is_some_and(|i| i.1.reset.is_none()) {
                taken.shift_luts += length.div_ceil(most) as u64;
            } else {
                taken.flip_flops += length as u64;
            }
        }
        taken
    }

    /// The registers that are inside multipliers.
    fn absorbed(&self, used: &[bool], readers: &HashMap<usize, u32>, words: &Words) -> Vec<bool> {
        let mut inside = vec![false; self.all.len()];
        let data = |i: usize| self.all[i].input.filter(|(_, control)| control.reset.is_none()).map(|(data, _)| data);
        for i in (0..self.all.len()).filter(|i| used[*i]) {
            let product = |bit: Bit| matches!(words.sources.get(&bit.gate()), Some(Source::Product(_)));
            inside[i] = data(i).is_some_and(product);
        }
        if words.fabric.multiplier_registers == MultiplierRegisters::OperandsAndProduct {
            let first = inside.clone();
            let sum = |bit: Bit| matches!(words.sources.get(&bit.gate()), Some(Source::Sum(_)));
            for i in (0..self.all.len()).filter(|i| used[*i]) {
                let behind = |bit: Bit| match words.sources.get(&bit.gate()) {
                    Some(Source::Register(source)) => first[*source] && readers.get(&bit.gate()) == Some(&1),
                    _ => false,
                };
                inside[i] |= data(i).is_some_and(|bit| behind(bit) || sum(bit));
            }
            let mut operands: HashMap<usize, u32> = HashMap::new();
            words.products.iter().flatten().flatten().for_each(|b| *operands.entry(b.gate()).or_default() += 1);
            for _ in 0..OPERAND_REGISTERS {
                let mut next = HashMap::new();
                for (i, register) in self.all.iter().enumerate().filter(|(i, _)| used[*i]) {
                    let gate = register.output.gate();
                    let whole = operands.contains_key(&gate) && operands.get(&gate) == readers.get(&gate);
                    if let Some(bit) = data(i).filter(|_| whole) {
                        inside[i] = true;
                        *next.entry(bit.gate()).or_default() += 1;
                    }
                }
                operands = next;
            }
        }
        inside
    }
}
