//! What a module is predicted to take of a device, from its signals alone.
//!
//! Every signal is written in bits. Sums and comparisons become carry chains, products multipliers, and all else
//! gates, folded and shared as they are made ([`cells`](crate::cells)). What no output depends on is dropped, equal
//! registers become one, and the gates that remain are covered by look-up tables (`cover`). What is then counted:
//!
//! * look-up tables of the cover, and one for every inverter that stands alone, in front of a carry chain for example;
//!   on the ECP5 and Nexus two for a carry cell;
//! * flip-flops, without those that the device's multipliers take in, and without delay lines of three clocks or more,
//!   which become shift registers in look-up tables;
//! * memories, and delay lines with a tap, as look-up tables.
//!
//! Each module is estimated by itself, as in a synthesis that keeps the hierarchy.

mod cover;
mod registers;

use crate::cells::{Bit, Gate, Source, Words, number};
use crate::device::{Device, Resources};
use crate::netlist::{Driver, LINE_CLOCKS, Module, SignalId};
use crate::op::{Comb, Type, Word};
use cover::Passages;
use registers::{Control, Registers};
use std::collections::{HashMap, VecDeque};

/// The resources of one module by itself, without its instances.
pub fn own(module: &Module, device: &Device) -> Resources {
    let mut reader = Reader::new(module, device);
    reader.read();
    reader.count(device)
}

/// The resources of a module with everything in it.
pub fn whole(module: &Module, device: &Device) -> Resources {
    fn sum(module: &Module, device: &Device, known: &mut HashMap<*const Module, Resources>) -> Resources {
        if let Some(known) = known.get(&std::ptr::from_ref(module)) {
            return *known;
        }
        let below: Resources = module.instances.iter().map(|i| sum(&i.module, device, known)).sum();
        let all = own(module, device) + below;
        known.insert(module, all);
        all
    }
    sum(module, device, &mut HashMap::new())
}

/// Reads a module bit by bit.
struct Reader<'a> {
    module: &'a Module,
    words: Words,
    registers: Registers,
    bits: Vec<Option<Vec<Bit>>>,
}

impl<'a> Reader<'a> {
    fn new(module: &'a Module, device: &Device) -> Self {
        let bits = vec![None; module.signals.len()];
        Self { module, words: Words::new(device.fabric), registers: Registers::default(), bits }
    }

    fn of(&self, id: SignalId) -> Vec<Bit> {
        self.bits[id.0].clone().expect("operands are read first")
    }

    /// Reads all signals, operands first; where registers depend on themselves, one of them is read before its operand.
    fn read(&mut self) {
        let signals = &self.module.signals;
        let mut users: Vec<Vec<usize>> = vec![vec![]; signals.len()];
        let mut waits = vec![0; signals.len()];
        for (i, signal) in signals.iter().enumerate() {
            for operand in operands(&signal.driver) {
                users[operand.0].push(i);
                waits[i] += 1;
            }
        }
        let mut ready: VecDeque<usize> = (0..signals.len()).filter(|i| waits[*i] == 0).collect();
        let mut late = vec![];
        let mut next = 0;
        loop {
            let Some(i) = ready.pop_front() else {
                let waiting =
                    |i: &usize| self.bits[*i].is_none() && matches!(signals[*i].driver, Driver::Register { .. });
                let Some(i) = (next..signals.len()).find(waiting) else { break };
                next = i + 1;
                let first = self.registers.all.len();
                let ty = signals[i].ty;
                let outputs = self.words.leaves(ty.bits, |bit| Source::Register(first + bit));
                self.registers.reserve(&outputs);
                late.push((i, first));
                self.bits[i] = Some(outputs);
                users[i].iter().for_each(|u| waits[*u] -= 1);
                ready.extend(users[i].iter().filter(|u| waits[**u] == 0));
                continue;
            };
            if self.bits[i].is_some() {
                continue;
            }
            self.bits[i] = Some(self.signal(i));
            users[i].iter().for_each(|u| waits[*u] -= 1);
            ready.extend(users[i].iter().filter(|u| waits[**u] == 0));
        }
        for (i, first) in late {
            let (data, controls) = self.register(i);
            self.registers.connect(first, &data, &controls);
        }
    }

    fn operation(&mut self, op: &Comb, args: &[SignalId], to: Type) -> Vec<Bit> {
        let word = |a: &SignalId| Word { bits: self.of(*a), ty: self.module.signal(*a).ty };
        let args: Vec<Word> = args.iter().map(word).collect();
        op.gates(&mut self.words, &args, to)
    }

    /// What goes into the register of a signal: data and control, bit by bit.
    fn register(&mut self, i: usize) -> (Vec<Bit>, Vec<Control>) {
        let signal = &self.module.signals[i];
        let Driver::Register { op, args, enable, reset } = &signal.driver else { unreachable!("only registers") };
        let data = match op {
            Some(op) => self.operation(op, args, signal.ty),
            None => self.of(args[0]),
        };
        let enable = enable.map(|e| self.of(e)[0]);
        let start = number(reset.map_or(0, |r| r.1), signal.ty.bits);
        let reset = reset.map(|r| self.of(r.0)[0]);
        let controls = start.into_iter().map(|start| Control { enable, reset, start }).collect();
        (data, controls)
    }

    fn signal(&mut self, i: usize) -> Vec<Bit> {
        let signal = &self.module.signals[i];
        let bits = signal.ty.bits;
        match &signal.driver {
            Driver::Port | Driver::Instance { .. } | Driver::Memory { .. } | Driver::Line { .. } => {
                self.words.leaves(bits, |_| Source::Outside)
            }
            Driver::Combinational { op, args } => self.operation(op, args, signal.ty),
            Driver::Register { .. } => {
                let (data, controls) = self.register(i);
                let pairs = data.into_iter().zip(controls);
                pairs.map(|(data, control)| self.registers.output(data, control, &mut self.words)).collect()
            }
        }
    }

    /// Counts what the outputs, instances and memories depend on.
    fn count(&self, device: &Device) -> Resources {
        let fabric = device.fabric;
        let mut resources = Resources::default();
        // Bits that must be there as signals.
        let mut roots: Vec<Bit> = self.module.outputs.iter().flat_map(|o| self.of(o.1)).collect();
        roots.extend(self.module.instances.iter().flat_map(|i| &i.inputs).flat_map(|id| self.of(*id)));
        for signal in &self.module.signals {
            resources.memory_luts += match &signal.driver {
                Driver::Memory { depth, .. } => fabric.memory_luts(*depth, signal.ty.bits, false),
                Driver::Line { .. } => {
                    LINE_CLOCKS.div_ceil(fabric.longest_shift.max(1)) as u64 * u64::from(signal.ty.bits)
                }
                _ => continue,
            };
            roots.extend(signal.driver.operands().into_iter().flat_map(|id| self.of(id)));
        }
        let live = self.live(&mut roots);
        let products = live.products.iter().filter(|used| **used).count();
        resources.multipliers = products as u64;
        for bits in &live.chains {
            // The sum of the top bit needs no carry out of it; a cell of several bits is there all the same.
            let unused = usize::from(fabric.carry_cell == 1 && *bits > 0);
            resources.carry += fabric.carry_bits(bits - unused);
        }
        roots.sort_unstable();
        let delays = self.registers.count(&live.registers, &roots, &self.words);
        resources.flip_flops = delays.flip_flops;
        resources.memory_luts += delays.shift_luts;
        roots.dedup();
        let tables = cover::cover(&self.words.gates, &roots, fabric.prices, &self.passages(&live, fabric.chain_levels));
        let in_tables: u64 = tables.iter().zip(fabric.tables).map(|(n, luts)| n * luts).sum();
        resources.luts = in_tables + self.inverters(&roots) + fabric.chain_luts(resources.carry);
        resources
    }

    /// The chains that mapping sees as ways from operands to sums; none where it takes them for ends of paths.
    fn passages(&self, live: &Live, levels: u32) -> Passages {
        let before = |(gate, source): (&usize, &Source)| match source {
            Source::Chain(i, bit) if levels > 0 && live.chains[*i] > *bit => {
                Some((*gate, (0..=*bit).flat_map(|bit| self.words.chain_inputs(*i, bit)).collect()))
            }
            _ => None,
        };
        Passages { before: self.words.sources.iter().filter_map(before).collect(), levels }
    }

    /// Complements of what is no gate: an inverter each, where the family's tables do not absorb it.
    fn inverters(&self, roots: &[Bit]) -> u64 {
        let gates = &self.words.gates;
        let leaf = |bit: &&Bit| !bit.is_constant() && bit.is_complement() && gates.all[bit.gate()] == Gate::Leaf;
        roots.iter().filter(leaf).count() as u64
    }

    /// Adds to the roots what they depend on beyond gates, and says what of it is used.
    fn live(&self, roots: &mut Vec<Bit>) -> Live {
        let words = &self.words;
        let mut live = Live {
            registers: vec![false; self.registers.all.len()],
            chains: vec![0; words.chains.len()],
            products: vec![false; words.products.len()],
            sums: vec![false; words.sums.len()],
        };
        let mut seen = vec![false; words.gates.all.len()];
        let mut open: Vec<usize> = roots.iter().map(|r| r.gate()).collect();
        while let Some(gate) = open.pop() {
            if std::mem::replace(&mut seen[gate], true) {
                continue;
            }
            open.extend(words.gates.all[gate].operands());
            let mut more = vec![];
            match words.sources.get(&gate) {
                None | Some(Source::Outside) => {}
                Some(Source::Register(i)) => {
                    live.registers[*i] = true;
                    more.extend(self.registers.inputs(*i));
                }
                Some(Source::Product(i)) => {
                    if !std::mem::replace(&mut live.products[*i], true) {
                        more.extend(words.products[*i].iter().flatten());
                    }
                }
                Some(Source::Sum(i)) => {
                    if !std::mem::replace(&mut live.sums[*i], true) {
                        more.extend(words.sums[*i].operands.iter().flatten());
                    }
                }
                Some(Source::Chain(i, bit)) => {
                    let known = live.chains[*i];
                    if bit + 1 > known {
                        live.chains[*i] = bit + 1;
                        more.extend((known..bit + 1).flat_map(|bit| words.chain_inputs(*i, bit)));
                    }
                }
            }
            open.extend(more.iter().map(|b| b.gate()));
            roots.extend(more);
        }
        live
    }
}

/// What is used.
struct Live {
    registers: Vec<bool>,
    /// Bits of every chain.
    chains: Vec<usize>,
    products: Vec<bool>,
    sums: Vec<bool>,
}

/// The signals that must be read before one of this driver; of memories and lines, as of instances, the outputs are leaves.
fn operands(driver: &Driver) -> Vec<SignalId> {
    match driver {
        Driver::Memory { .. } | Driver::Line { .. } => vec![],
        other => other.operands(),
    }
}

#[cfg(test)]
mod tests;
