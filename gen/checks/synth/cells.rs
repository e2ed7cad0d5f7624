//! What the cells of a netlist are in the terms of the device model.
//!
//! A LUT is a LUT of any width, an inverter, half of a `WIDEFN9`, or half a carry cell of the ECP5 or Nexus (`CCU2C`, `CCU2`:
//! two LUTs and two bits of carry; the LUTs of a Xilinx carry chain are cells of their own). Shift registers and memories are
//! counted in the LUTs they take. Registers that multipliers take in although Yosys leaves them outside are counted apart.

use crate::synth::netlist::{Module, is_flip_flop};
use crate::synth::product_registers::{self, Registered};
use efsat_hardware::device::{Family, Resources};
use std::iter::Sum;
use std::ops::{Add, Mul};

/// Cells of a netlist.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cells {
    /// In the terms of the device model, flip-flops in multipliers excepted.
    pub resources: Resources,
    /// Multipliers that take in the register behind them (MULT18X18S, MULT18X18D, MULT18X18 of Nexus).
    pub registered_multipliers: u64,
    /// Flip-flops of the netlist that are in these.
    pub absorbed_flip_flops: u64,
    /// Block RAMs of 18 kbit.
    pub block_rams: u64,
}

impl Add for Cells {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            resources: self.resources + other.resources,
            registered_multipliers: self.registered_multipliers + other.registered_multipliers,
            absorbed_flip_flops: self.absorbed_flip_flops + other.absorbed_flip_flops,
            block_rams: self.block_rams + other.block_rams,
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
            block_rams: self.block_rams * n,
        }
    }
}

impl Sum for Cells {
    fn sum<I: Iterator<Item = Self>>(all: I) -> Self {
        all.fold(Self::default(), Add::add)
    }
}

/// The cells of a module itself, without its instances.
pub fn own(module: &Module, family: Family) -> Cells {
    let resources =
        module.cells.values().map(|cell| resources(&cell.kind, family)).fold(Resources::default(), Add::add);
    let registered = product_registers::find(module, family);
    let absorbed_flip_flops = registered.iter().map(Registered::flip_flops).sum();
    let flip_flops = resources.flip_flops - absorbed_flip_flops;
    let resources = Resources { flip_flops, ..resources };
    let block_rams = module.cells.values().map(|cell| block_rams(&cell.kind)).sum();
    Cells { resources, registered_multipliers: registered.len() as u64, absorbed_flip_flops, block_rams }
}

/// Block RAMs of 18 kbit that a cell of the library is.
fn block_rams(kind: &str) -> u64 {
    match kind {
        "DP16KD" | "PDPW16KD" | "DP16K" | "PDP16K" | "PDPSC16K" => 1,
        kind if kind.starts_with("RAMB36") => 2,
        kind => kind.starts_with("RAMB").into(),
    }
}

/// A cell of the library in the terms of the device model; nothing for what is free or no cell of the library.
fn resources(kind: &str, family: Family) -> Resources {
    let none = Resources::default();
    match kind {
        "MULT18X18" | "MULT18X18S" | "DSP48A1" | "DSP48E1" | "DSP48E2" | "MULT18X18D" | "MULT9X9" => {
            Resources { multipliers: 1, ..none }
        }
        "LUT1" | "LUT2" | "LUT3" | "LUT4" | "LUT5" | "LUT6" | "INV" => Resources { luts: 1, ..none },
        "WIDEFN9" => Resources { luts: 2, ..none },
        "CCU2C" | "CCU2" => Resources { luts: 2, carry: 2, ..none },
        "MUXCY" => Resources { carry: 1, ..none },
        "CARRY4" => Resources { carry: 4, ..none },
        "SRL16" | "SRL16E" | "SRLC16" | "SRLC16E" | "RAM16X1S" => Resources { memory_luts: 1, ..none },
        // Twice as deep as a LUT of four inputs.
        "SRLC32E" | "RAM32X1S" if family == Family::Virtex2 => Resources { memory_luts: 2, ..none },
        "SRLC32E" | "RAM32X1S" | "RAM64X1S" => Resources { memory_luts: 1, ..none },
        "RAM32X1D" if family == Family::Virtex2 => Resources { memory_luts: 4, ..none },
        "RAM64X1D" if family == Family::Virtex2 => Resources { memory_luts: 8, ..none },
        "RAM16X1D" | "RAM32X1D" | "RAM64X1D" => Resources { memory_luts: 2, ..none },
        "RAM32M" | "RAM64M" | "RAM128X1D" => Resources { memory_luts: 4, ..none },
        "RAM32M16" | "RAM64M8" => Resources { memory_luts: 8, ..none },
        // Two slices of data and one that writes.
        "TRELLIS_DPR16X4" | "DPR16X4" => Resources { memory_luts: 6, ..none },
        kind if is_flip_flop(kind) => Resources { flip_flops: 1, ..none },
        _ => none,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn registers_in_multipliers_are_counted_apart() {
        let text = r#"{"cells": {
            "m": {"type": "MULT18X18", "connections": {"A": [2], "B": [3], "P": [4]}},
            "a": {"type": "FDRE", "connections": {"D": [4], "Q": [6], "C": [1], "CE": ["1"], "R": ["0"]}},
            "b": {"type": "FDRE", "connections": {"D": [6], "Q": [7], "C": [1], "CE": ["1"], "R": ["0"]}},
            "l": {"type": "LUT1", "connections": {"I0": [7], "O": [9]}}}}"#;
        let module: Module = serde_json::from_str(text).unwrap();
        let cells = own(&module, Family::Virtex2);
        assert_eq!((cells.registered_multipliers, cells.absorbed_flip_flops), (1, 1));
        assert_eq!(cells.resources, Resources { multipliers: 1, luts: 1, flip_flops: 1, ..Resources::default() });
        assert_eq!(own(&module, Family::Series7).resources.flip_flops, 2);
    }
}
