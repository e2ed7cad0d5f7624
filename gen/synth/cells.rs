//! What the cells of a netlist are in the terms of the device model.
//!
//! A LUT is a LUT of any width, an inverter, or half a carry cell of the ECP5 (`CCU2C`: two LUTs and two bits of carry;
//! the LUTs of a Xilinx carry chain are cells of their own). Shift registers and memories are counted in the LUTs they
//! take. Registers directly behind a MULT18X18 are part of a MULT18X18S in the vendor's tools, which Yosys does not
//! know; they are counted apart.

use super::netlist::{Bit, Cell, Module};
use super::Flow;
use crate::device::Resources;
use std::collections::{HashMap, HashSet};
use std::iter::Sum;
use std::ops::{Add, Mul};

/// Cells of a netlist.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cells {
    /// In the terms of the device model, flip-flops in multipliers excepted.
    pub resources: Resources,
    /// Multipliers that take up the register behind them (MULT18X18S).
    pub registered_multipliers: u64,
    /// Flip-flops of the netlist that are in these.
    pub absorbed_flip_flops: u64,
}

impl Add for Cells {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            resources: self.resources + other.resources,
            registered_multipliers: self.registered_multipliers + other.registered_multipliers,
            absorbed_flip_flops: self.absorbed_flip_flops + other.absorbed_flip_flops,
        }
    }
}

impl Mul<u64> for Cells {
    type Output = Self;

    fn mul(self, n: u64) -> Self {
        Self {
            resources: self.resources * n,
            registered_multipliers: self.registered_multipliers * n,
            absorbed_flip_flops: self.absorbed_flip_flops * n,
        }
    }
}

impl Sum for Cells {
    fn sum<I: Iterator<Item = Self>>(all: I) -> Self {
        all.fold(Self::default(), Add::add)
    }
}

/// The cells of a module itself, without its instances.
pub fn own(module: &Module, flow: Flow) -> Cells {
    let resources = module.cells.values().map(|cell| resources(&cell.kind, flow)).fold(Resources::default(), Add::add);
    let mut cells = Cells { resources, ..Cells::default() };
    if flow == Flow::Virtex2 {
        (cells.registered_multipliers, cells.absorbed_flip_flops) = registered_products(module);
        cells.resources.flip_flops -= cells.absorbed_flip_flops;
    }
    cells
}

/// A cell of the library in the terms of the device model; nothing for what is free or no cell of the library.
fn resources(kind: &str, flow: Flow) -> Resources {
    let none = Resources::default();
    match kind {
        "MULT18X18" | "MULT18X18S" | "DSP48A1" | "DSP48E1" | "MULT18X18D" => Resources { multipliers: 1, ..none },
        "LUT1" | "LUT2" | "LUT3" | "LUT4" | "LUT5" | "LUT6" | "INV" => Resources { luts: 1, ..none },
        "CCU2C" => Resources { luts: 2, carry: 2, ..none },
        "MUXCY" => Resources { carry: 1, ..none },
        "CARRY4" => Resources { carry: 4, ..none },
        "SRL16" | "SRL16E" | "SRLC16" | "SRLC16E" | "RAM16X1S" => Resources { memory_luts: 1, ..none },
        // Twice as deep as a LUT of four inputs.
        "SRLC32E" | "RAM32X1S" if flow == Flow::Virtex2 => Resources { memory_luts: 2, ..none },
        "SRLC32E" | "RAM32X1S" | "RAM64X1S" => Resources { memory_luts: 1, ..none },
        "RAM32X1D" if flow == Flow::Virtex2 => Resources { memory_luts: 4, ..none },
        "RAM16X1D" | "RAM32X1D" | "RAM64X1D" => Resources { memory_luts: 2, ..none },
        "RAM32M" | "RAM64M" | "RAM128X1D" => Resources { memory_luts: 4, ..none },
        // Two slices of data and one that writes.
        "TRELLIS_DPR16X4" => Resources { memory_luts: 6, ..none },
        "TRELLIS_FF" => Resources { flip_flops: 1, ..none },
        kind if is_flip_flop(kind) => Resources { flip_flops: 1, ..none },
        _ => none,
    }
}

/// Xilinx flip-flops: `FDRE`, `FDSE` and their like.
fn is_flip_flop(kind: &str) -> bool {
    kind.starts_with("FD")
}

/// Multipliers all of whose used product bits go to one flip-flop each and nowhere else, flip-flops that load and clear
/// together; and the number of these flip-flops.
fn registered_products(module: &Module) -> (u64, u64) {
    let products = || module.cells.values().filter(|cell| cell.kind == "MULT18X18");
    let bits: HashSet<u64> = products().flat_map(|cell| nets(&cell.connections["P"])).collect();
    let mut loads: HashMap<u64, Vec<Load>> = bits.iter().map(|bit| (*bit, vec![])).collect();
    for port in module.ports.values() {
        for net in nets(&port.bits) {
            loads.entry(net).and_modify(|loads| loads.push(Load::Other));
        }
    }
    for cell in module.cells.values() {
        for (port, bits) in &cell.connections {
            if cell.kind == "MULT18X18" && port == "P" {
                continue;
            }
            for net in nets(bits) {
                let load = if is_flip_flop(&cell.kind) && port == "D" { Load::register(cell) } else { Load::Other };
                loads.entry(net).and_modify(|loads| loads.push(load));
            }
        }
    }
    let flip_flops = |cell: &Cell| -> u64 {
        let used: Vec<&[Load]> =
            nets(&cell.connections["P"]).map(|bit| loads[&bit].as_slice()).filter(|loads| !loads.is_empty()).collect();
        let first = used.first().and_then(|loads| loads.first()).copied();
        let together = used.iter().all(|loads| loads.len() == 1 && Some(loads[0]) == first);
        if together && first.is_some_and(|load| load != Load::Other) {
            used.len() as u64
        } else {
            0
        }
    };
    let absorbed: Vec<u64> = products().map(flip_flops).filter(|n| *n > 0).collect();
    (absorbed.len() as u64, absorbed.iter().sum())
}

/// What reads a bit of a product.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Load {
    /// The data input of a flip-flop with that enable and that reset.
    Register(Option<Bit>, Option<Bit>),
    /// Anything else.
    Other,
}

impl Load {
    fn register(cell: &Cell) -> Self {
        Self::Register(cell.bit("CE"), cell.bit("R"))
    }
}

fn nets(bits: &[Bit]) -> impl Iterator<Item = u64> + '_ {
    bits.iter().filter_map(|bit| match bit {
        Bit::Net(net) => Some(*net),
        Bit::Constant(_) => None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A multiplier with two bits of product, each into a register; `more` are cells beside them.
    fn module(more: &str) -> Module {
        let text = format!(
            r#"{{"ports": {{"q": {{"bits": [9]}}}}, "cells": {{
            "m": {{"type": "MULT18X18", "connections": {{"A": [2], "B": [3], "P": [4, 5]}}}},
            "a": {{"type": "FDRE", "connections": {{"D": [4], "Q": [6], "C": [1], "CE": ["1"], "R": ["0"]}}}},
            "b": {{"type": "FDRE", "connections": {{"D": [5], "Q": [7], "C": [1], "CE": ["1"], "R": ["0"]}}}},
            "l": {{"type": "LUT2", "connections": {{"I0": [6], "I1": [7], "O": [9]}}}}{more}}}}}"#
        );
        serde_json::from_str(&text).unwrap()
    }

    #[test]
    fn registers_behind_a_multiplier_are_part_of_it() {
        let cells = own(&module(""), Flow::Virtex2);
        assert_eq!((cells.registered_multipliers, cells.absorbed_flip_flops), (1, 2));
        assert_eq!(cells.resources, Resources { multipliers: 1, luts: 1, ..Resources::default() });
        // Not in other families, where Yosys itself moves them.
        assert_eq!(own(&module(""), Flow::Series7).resources.flip_flops, 2);
    }

    #[test]
    fn a_product_that_is_read_elsewhere_keeps_its_registers() {
        let inverter = r#", "i": {"type": "INV", "connections": {"I": [5], "O": [8]}}"#;
        let cells = own(&module(inverter), Flow::Virtex2);
        assert_eq!((cells.registered_multipliers, cells.resources.flip_flops), (0, 2));
        let port = r#"{"ports": {"p": {"bits": [4]}}, "cells": {
            "m": {"type": "MULT18X18", "connections": {"P": [4]}},
            "a": {"type": "FDRE", "connections": {"D": [4], "Q": [6], "CE": ["1"], "R": ["0"]}}}}"#;
        assert_eq!(registered_products(&serde_json::from_str(port).unwrap()), (0, 0));
    }
}
