//! Registers that ECP5's block RAM takes in, although Yosys leaves them outside.
//!
//! A DP16KD has a register behind its outputs, with an enable. The vendor's tools put the register of the design there that directly
//! follows; Yosys does not, and a word would then leave the memory late in its clock.

use super::netlist::{Bit, Cell, Level, Module, Netlist};
use std::collections::HashMap;

const KIND: &str = "DP16KD";
/// Both ports of a memory, which has 36 bits of a word at both together.
const SIDES: [char; 2] = ['A', 'B'];
const NEVER: Bit = Bit::Constant(Level::Zero);
const ALWAYS: Bit = Bit::Constant(Level::One);

/// The clock and the enable of a flip-flop that a memory can take in: rising edge, no reset, zero at the start.
fn controls(cell: &Cell) -> Option<[Bit; 2]> {
    let is = |name, values: &[&str]| cell.parameter(name).is_none_or(|value| values.contains(&value));
    let plain =
        is("CLKMUX", &["CLK"]) && is("CEMUX", &["1", "CE"]) && is("LSRMUX", &["LSR"]) && is("REGSET", &["RESET"]);
    let keeps = cell.bit("LSR").is_none_or(|reset| reset == NEVER);
    let enable = if cell.parameter("CEMUX") == Some("1") { ALWAYS } else { cell.bit("CE").unwrap_or(ALWAYS) };
    (cell.kind == "TRELLIS_FF" && plain && keeps).then_some([cell.bit("CLK")?, enable])
}

/// Whether a cell is a memory whose registers are free and are never cleared, with one clock.
fn is_free(cell: &Cell, clock: Bit) -> bool {
    let side = |side: char| {
        let free = cell.parameter(&format!("REGMODE_{side}")).is_none_or(|mode| mode == "NOREG");
        let plain = cell.parameter(&format!("CLK{side}MUX")).is_none_or(|edge| edge == format!("CLK{side}"));
        let keeps = cell.bit(&format!("RST{side}")).is_none_or(|reset| reset == NEVER);
        free && plain && keeps && cell.bit(&format!("CLK{side}")) == Some(clock)
    };
    cell.kind == KIND && SIDES.into_iter().all(side)
}

/// A memory with the register behind it: the name of each flip-flop with its port, and their clock and enable.
struct Registered {
    flip_flops: Vec<(String, String)>,
    enable: Bit,
}

/// What reads each net, as (cell, port); a port of the module has no cell.
fn readers(module: &Module) -> HashMap<u64, Vec<Option<(&str, &str)>>> {
    let mut found: HashMap<u64, Vec<_>> = HashMap::new();
    for net in module.ports.values().flat_map(|port| &port.bits).filter_map(|bit| bit.net()) {
        found.entry(net).or_default().push(None);
    }
    for (name, cell) in &module.cells {
        for (port, bits) in &cell.connections {
            // The cell's own output: one of a kind that is not looked at below does no harm.
            if (cell.kind == KIND && port.starts_with("DO")) || (cell.kind == "TRELLIS_FF" && port == "Q") {
                continue;
            }
            for net in bits.iter().filter_map(|bit| bit.net()) {
                found.entry(net).or_default().push(Some((name.as_str(), port.as_str())));
            }
        }
    }
    found
}

/// The register behind a memory all of whose bits that are read go to one flip-flop each and nowhere else.
fn behind(module: &Module, cell: &Cell, readers: &HashMap<u64, Vec<Option<(&str, &str)>>>) -> Option<Registered> {
    let mut flip_flops = vec![];
    let mut together = None;
    for (port, bits) in cell.connections.iter().filter(|(port, _)| port.starts_with("DO")) {
        let Some(read) = bits.first().and_then(|bit| readers.get(&bit.net()?)) else { continue };
        let &[Some((name, "DI"))] = read.as_slice() else { return None };
        let found = controls(&module.cells[name])?;
        if *together.get_or_insert(found) != found {
            return None;
        }
        flip_flops.push((port.clone(), name.to_owned()));
    }
    let [clock, enable] = together?;
    is_free(cell, clock).then_some(Registered { flip_flops, enable })
}

/// Moves registers into the memories of a netlist for the ECP5; returns how many memories have theirs inside.
pub fn pack(netlist: &mut Netlist) -> u64 {
    let mut packed = 0;
    for module in netlist.modules.values_mut() {
        let readers = readers(module);
        let memories = module.cells.iter().filter(|(_, cell)| cell.kind == KIND);
        let found = memories.filter_map(|(name, cell)| Some((name.clone(), behind(module, cell, &readers)?)));
        for (name, Registered { flip_flops, enable }) in found.collect::<Vec<_>>() {
            let outputs: Vec<_> = flip_flops
                .into_iter()
                .filter_map(|(port, flip_flop)| Some((port, module.cells.remove(&flip_flop)?.bit("Q")?)))
                .collect();
            let Some(cell) = module.cells.get_mut(&name) else { continue };
            for (port, output) in outputs {
                cell.connections.insert(port, vec![output]);
            }
            for side in SIDES {
                cell.set(&format!("REGMODE_{side}"), "OUTREG");
                cell.connect(&format!("OCE{side}"), enable);
            }
            packed += 1;
        }
    }
    packed
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A memory with two bits that are read, each into a register with an enable; `more` are cells beside them.
    fn memory(more: &str) -> Netlist {
        let flip_flop = |d: u64, q: u64| {
            format!(
                r#"{{"type": "TRELLIS_FF", "parameters": {{"CEMUX": "CE", "REGSET": "RESET"}},
                "connections": {{"DI": [{d}], "Q": [{q}], "CLK": [1], "CE": [8], "LSR": ["0"]}}}}"#
            )
        };
        let memory = r#"{"type": "DP16KD", "parameters": {"REGMODE_A": "NOREG", "REGMODE_B": "NOREG"}, "connections": {
            "DOA0": [2], "DOA1": [10], "DOB0": [3], "CLKA": [1], "CLKB": [1], "RSTA": ["0"], "RSTB": ["0"],
            "OCEA": ["0"], "OCEB": ["1"]}}"#;
        let cells = format!(r#""m": {memory}, "a": {}, "b": {}{more}"#, flip_flop(2, 4), flip_flop(3, 5));
        let ports = r#"{"q": {"bits": [4, 5]}}"#;
        serde_json::from_str(&format!(r#"{{"modules": {{"top": {{"ports": {ports}, "cells": {{{cells}}}}}}}}}"#))
            .unwrap()
    }

    #[test]
    fn registers_move_into_memories() {
        let mut netlist = memory("");
        assert_eq!(pack(&mut netlist), 1);
        let cells = &netlist.modules["top"].cells;
        assert_eq!(cells.keys().collect::<Vec<_>>(), ["m"]);
        let m = &cells["m"];
        let nets = ["DOA0", "DOA1", "DOB0", "OCEA", "OCEB"].map(|port| m.bit(port).and_then(Bit::net));
        assert_eq!(nets, [4, 10, 5, 8, 8].map(Some));
        assert_eq!(["REGMODE_A", "REGMODE_B"].map(|name| m.parameter(name)), [Some("OUTREG"); 2]);
        assert_eq!(pack(&mut netlist), 0, "once more there is nothing to be moved");
    }

    #[test]
    fn registers_without_an_enable_always_load() {
        let mut netlist = memory("");
        for name in ["a", "b"] {
            netlist.modules.get_mut("top").unwrap().cells.get_mut(name).unwrap().set("CEMUX", "1");
        }
        assert_eq!(pack(&mut netlist), 1);
        let m = &netlist.modules["top"].cells["m"];
        assert_eq!(["OCEA", "OCEB"].map(|port| m.bit(port)), [Some(ALWAYS); 2]);
    }

    #[test]
    fn registers_that_a_memory_cannot_be_stay_outside() {
        let with = |name: &str, change: &dyn Fn(&mut Cell)| {
            let mut netlist = memory("");
            change(netlist.modules.get_mut("top").unwrap().cells.get_mut(name).unwrap());
            pack(&mut netlist)
        };
        assert_eq!(with("b", &|_| ()), 1);
        assert_eq!(with("b", &|b| b.set("REGSET", "SET")), 0, "a one at the start");
        for mux in ["CLKMUX", "CEMUX", "LSRMUX"] {
            assert_eq!(with("b", &|b| b.set(mux, "INV")), 0, "{mux}");
        }
        assert_eq!(
            with("b", &|b| {
                let read = b.connections.remove("DI").unwrap();
                b.connect("CE", read[0]);
            }),
            0,
            "an enable"
        );
        assert_eq!(with("b", &|b| b.connect("LSR", Bit::Net(9))), 0, "a reset");
        assert_eq!(with("b", &|b| b.connect("CE", Bit::Net(9))), 0, "another enable");
        assert_eq!(with("b", &|b| b.set("CEMUX", "1")), 0, "none beside one");
        assert_eq!(with("b", &|b| b.connect("CLK", Bit::Net(9))), 0, "another clock");
        assert_eq!(with("b", &|b| b.kind = "LUT4".to_owned()), 0, "logic");
        assert_eq!(with("m", &|m| m.connect("CLKA", Bit::Net(9))), 0, "two clocks");
        assert_eq!(with("m", &|m| m.connect("RSTB", Bit::Net(9))), 0);
        assert_eq!(with("m", &|m| m.set("CLKBMUX", "INV")), 0);
        assert_eq!(with("m", &|m| m.set("REGMODE_A", "OUTREG")), 0);
    }

    #[test]
    fn a_word_that_is_read_elsewhere_keeps_its_register() {
        let reader = r#", "r": {"type": "LUT4", "connections": {"A": [3], "Z": [11]}}"#;
        assert_eq!(pack(&mut memory(reader)), 0);
        let mut netlist = memory("");
        netlist.modules.get_mut("top").unwrap().ports.get_mut("q").unwrap().bits.push(Bit::Net(2));
        assert_eq!(pack(&mut netlist), 0, "an output of the design");
    }
}
