//! What cells of Virtex-II do in time.

use super::flatten::Design;
use super::{Start, TimingError, delay};
use crate::synth::netlist::is_flip_flop;
use std::collections::HashMap;

/// A place where a path ends.
pub(super) struct End<'a> {
    pub net: usize,
    pub cell: usize,
    pub port: &'a str,
    /// Set-up, none where it is not known.
    pub setup: Option<f64>,
}

/// The cells of a design with their neighbours.
pub(super) struct Cells<'a> {
    design: &'a Design,
    drivers: HashMap<usize, usize>,
    loads: HashMap<usize, Vec<(usize, &'a str)>>,
}

fn is_output(port: &str) -> bool {
    matches!(port, "O" | "LO" | "Q" | "Q15" | "P" | "SPO" | "DPO")
}

fn is_table(kind: &str) -> bool {
    kind.starts_with("LUT") || kind == "INV"
}

fn is_memory(kind: &str) -> bool {
    kind.starts_with("SRL") || kind.starts_with("RAM")
}

impl<'a> Cells<'a> {
    pub fn new(design: &'a Design) -> Self {
        let mut drivers = HashMap::new();
        let mut loads: HashMap<usize, Vec<(usize, &str)>> = HashMap::new();
        for (i, cell) in design.cells.iter().enumerate() {
            for (port, _, net) in &cell.pins {
                if is_output(port) {
                    drivers.insert(*net, i);
                } else {
                    loads.entry(*net).or_default().push((i, port));
                }
            }
        }
        Self { design, drivers, loads }
    }

    /// Whether a cell is a multiplier with the register behind it inside.
    fn is_registered_multiplier(&self, cell: usize) -> bool {
        self.design.cells[cell].registered && !self.is_in_multiplier(cell)
    }

    /// Whether a cell is a flip-flop that a multiplier takes in.
    fn is_in_multiplier(&self, cell: usize) -> bool {
        self.design.cells[cell].registered && is_flip_flop(self.kind(cell))
    }

    fn kind(&self, cell: usize) -> &'a str {
        &self.design.cells[cell].kind
    }

    fn loads_of(&self, net: usize) -> &[(usize, &'a str)] {
        self.loads.get(&net).map_or(&[], Vec::as_slice)
    }

    /// Input ports and their nets.
    pub fn inputs(&self, cell: usize) -> impl Iterator<Item = (&'a str, usize)> {
        let pins = self.design.cells[cell].pins.iter().filter(|pin| !is_output(&pin.0));
        pins.map(|(port, _, net)| (port.as_str(), *net))
    }

    /// Output ports with the bit, and their nets.
    pub fn outputs(&self, cell: usize) -> impl Iterator<Item = ((&'a str, usize), usize)> {
        let pins = self.design.cells[cell].pins.iter().filter(|pin| is_output(&pin.0));
        pins.map(|(port, bit, net)| ((port.as_str(), *bit), *net))
    }

    /// The path that starts in a cell, if one does.
    pub fn start(&self, cell: usize) -> Option<(Start, f64)> {
        match self.kind(cell) {
            _ if self.is_in_multiplier(cell) => Some((Start::Multiplier, 0.0)),
            kind if is_flip_flop(kind) => Some((Start::FlipFlop, delay::CLOCK_TO_OUTPUT)),
            kind if is_memory(kind) => Some((Start::FlipFlop, delay::SHIFT_CLOCK_TO_OUTPUT)),
            _ => None,
        }
    }

    /// The delay from an input to an output (its port, bit and net), none where nothing passes.
    pub fn through(&self, cell: usize, port: &str, output: (&str, usize), net: usize) -> Option<f64> {
        let leaves = || {
            let stays = |load: &(usize, &str)| matches!(self.kind(load.0), "MUXCY" | "XORCY") && load.1 == "CI";
            !self.loads_of(net).iter().all(stays)
        };
        let ns = match (self.kind(cell), port) {
            _ if self.is_registered_multiplier(cell) => return None,
            (kind, _) if is_table(kind) => delay::LUT,
            ("MUXCY", "S") if leaves() => delay::CARRY_START_LEAVING,
            ("MUXCY", "S") => delay::CARRY_START,
            ("MUXCY", "CI") if leaves() => delay::CARRY_LEAVING,
            ("MUXCY", "CI") => delay::CARRY,
            ("MUXCY", "DI") => delay::CARRY_DATA,
            ("XORCY", "CI") => delay::SUM,
            ("XORCY", _) => delay::SUM_FROM_LUT,
            ("MUXF5", "S") => delay::WIDE.1,
            ("MUXF5", _) => delay::WIDE.0,
            ("MUXF6" | "MUXF7" | "MUXF8", "S") => delay::WIDER.1,
            ("MUXF6" | "MUXF7" | "MUXF8", _) => delay::WIDER.0,
            ("MULT18X18", _) => delay::PRODUCT.0 + delay::PRODUCT.1 * output.1 as f64,
            (kind, port) if is_memory(kind) && (port.starts_with('A') || port.starts_with("DPRA")) => delay::LUT,
            _ => return None,
        };
        Some(ns)
    }

    /// The delay of a net to one of its loads.
    pub fn net_delay(&self, net: usize, cell: usize, port: &str) -> f64 {
        let Some(driver) = self.drivers.get(&net).map(|driver| self.kind(*driver)) else { return 0.0 };
        let loads = self.loads_of(net).len();
        let own = loads == 1 && (is_table(driver) || driver == "XORCY" || driver.starts_with("MUXF"));
        match (self.kind(cell), port) {
            ("MUXCY" | "XORCY", "CI" | "S" | "LI") => 0.0,
            (kind, "I0" | "I1") if kind.starts_with("MUXF") => 0.0,
            (kind, "D") if is_flip_flop(kind) && own => 0.0,
            _ => delay::net(loads),
        }
    }

    /// Where paths end: flip-flops, memories, and the operands of registered multipliers.
    pub fn ends(&self) -> Vec<End<'a>> {
        let mut ends = vec![];
        for cell in (0..self.design.cells.len()).filter(|cell| !self.is_in_multiplier(*cell)) {
            let kind = self.kind(cell);
            for (port, net) in self.inputs(cell) {
                let setup = match port {
                    "A" | "B" if self.is_registered_multiplier(cell) => None,
                    "D" if is_flip_flop(kind) || is_memory(kind) => Some(delay::SETUP),
                    "CE" | "WE" if is_flip_flop(kind) || is_memory(kind) => Some(delay::ENABLE_SETUP),
                    "R" | "S" if is_flip_flop(kind) => Some(delay::RESET_SETUP),
                    _ => continue,
                };
                ends.push(End { net, cell, port, setup });
            }
        }
        ends
    }

    /// Cells in the order of their signals: those that start paths first.
    pub fn in_order(&self) -> Result<Vec<usize>, TimingError> {
        let count = self.design.cells.len();
        let waits_for = |cell: usize| {
            let outputs: Vec<_> = self.outputs(cell).collect();
            let passes = move |port: &str| outputs.iter().any(|(o, net)| self.through(cell, port, *o, *net).is_some());
            self.inputs(cell).filter(move |(port, _)| passes(port)).filter_map(|(_, net)| self.drivers.get(&net))
        };
        let mut waits = vec![0; count];
        let mut users: Vec<Vec<usize>> = vec![vec![]; count];
        for (cell, waits) in waits.iter_mut().enumerate() {
            for driver in waits_for(cell) {
                *waits += 1;
                users[*driver].push(cell);
            }
        }
        let mut order: Vec<usize> = (0..count).filter(|cell| waits[*cell] == 0).collect();
        let mut next = 0;
        while next < order.len() {
            for user in &users[order[next]] {
                waits[*user] -= 1;
                if waits[*user] == 0 {
                    order.push(*user);
                }
            }
            next += 1;
        }
        match (0..count).find(|cell| waits[*cell] > 0) {
            None => Ok(order),
            Some(cell) => {
                let named = self.outputs(cell).find_map(|(_, net)| self.design.names[net].clone());
                Err(TimingError::Loop(named.unwrap_or_else(|| self.kind(cell).to_owned())))
            }
        }
    }
}
