//! Registers that hardware multipliers take in, although Yosys leaves them outside.
//!
//! Virtex-II's MULT18X18S, ECP5's MULT18X18D and Nexus' MULT18X18 and MULT9X9 have a register behind the product. The
//! vendors' tools put the register of the design there that directly follows; Yosys does not. On Virtex-II it is counted
//! as part of the multiplier; on the other two the netlist is changed before it is placed ([`pack`]).
//!
//! ECP5's has registers in front of its operands too. Where both operands come from registers that load what comes from a
//! flip-flop or a multiplier, these move there: what multipliers far apart have shared is then copied ([`pack_operands`]). Registers
//! behind logic or a memory stay outside of the multiplier.

use super::netlist::{Bit, Cell, Level, Module, Netlist, is_flip_flop};
use super::{ToolError, memory_registers};
use efsat_hardware::device::Family;
use std::collections::{HashMap, HashSet};
use std::path::Path;

/// Names of a family's multipliers and flip-flops, and which flip-flops a multiplier can take in.
struct Names {
    multipliers: &'static [&'static str],
    /// First letter of the ports of the product.
    product: char,
    /// Parameters of a multiplier that put its registers to use, and what they say where none is.
    registers: (&'static [&'static str], &'static str),
    /// How the netlist is told that the register behind the product is used, where it can be.
    inside: Option<Inside>,
    clock: &'static str,
    data: &'static str,
    enable: &'static str,
    reset: &'static str,
    /// Kinds of flip-flops.
    kinds: &'static [&'static str],
    /// Whether a flip-flop may have an enable or a reset that is in use.
    controlled: bool,
    /// Parameters of a flip-flop, each with the values that are legal.
    modes: &'static [(&'static str, &'static [&'static str])],
}

/// The register behind a product.
#[derive(Clone, Copy)]
struct Inside {
    /// Ports of the multiplier for its clock, its enable and its reset.
    ports: [&'static str; 3],
    /// Parameters of the multiplier.
    parameters: &'static [(&'static str, &'static str)],
}

/// Parameters of multipliers before Nexus.
const REGISTERS: &[&str] = &["REG_INPUTA_CLK", "REG_INPUTB_CLK", "REG_PIPELINE_CLK", "REG_OUTPUT_CLK"];

/// MULT18X18S has an enable and a reset, and zero at the start.
const VIRTEX2: Names = Names {
    multipliers: &["MULT18X18"],
    product: 'P',
    registers: (REGISTERS, "NONE"),
    inside: None,
    clock: "C",
    data: "D",
    enable: "CE",
    reset: "R",
    kinds: &["FD", "FDE", "FDR", "FDRE"],
    controlled: true,
    modes: &[("INIT", &["0", "x"])],
};

/// MULT18X18D has them too, but no register of ours behind a product does. Rising edge, plain controls, zero at the start.
const ECP5: Names = Names {
    multipliers: &["MULT18X18D"],
    product: 'P',
    registers: (REGISTERS, "NONE"),
    inside: Some(Inside {
        ports: ["CLK0", "CE0", "RST0"],
        parameters: &[("REG_OUTPUT_CLK", "CLK0"), ("REG_OUTPUT_CE", "CE0"), ("REG_OUTPUT_RST", "RST0")],
    }),
    clock: "CLK",
    data: "DI",
    enable: "CE",
    reset: "LSR",
    kinds: &["TRELLIS_FF"],
    controlled: false,
    modes: &[("CLKMUX", &["CLK"]), ("CEMUX", &["1", "CE"]), ("LSRMUX", &["LSR"]), ("REGSET", &["RESET"])],
};

/// As on the ECP5; the flip-flops do not answer to the reset of the whole part, so the multiplier must not.
const NEXUS: Names = Names {
    multipliers: &["MULT18X18", "MULT9X9"],
    product: 'Z',
    registers: (&["REGINPUTA", "REGINPUTB", "REGOUTPUT"], "BYPASS"),
    inside: Some(Inside {
        ports: ["CLK", "CEOUT", "RSTOUT"],
        parameters: &[("REGOUTPUT", "REGISTER"), ("RESETMODE", "SYNC"), ("GSR", "DISABLED")],
    }),
    clock: "CK",
    data: "D",
    enable: "SP",
    reset: "CD",
    kinds: &["FD1P3IX"],
    controlled: false,
    modes: &[("GSR", &["DISABLED"])],
};

/// Operands of ECP5's multiplier.
const OPERANDS: [&str; 2] = ["A", "B"];

const NEVER: Bit = Bit::Constant(Level::Zero);
const ALWAYS: Bit = Bit::Constant(Level::One);

impl Names {
    /// Those of a family whose multipliers can take a register that Yosys leaves outside.
    fn of(family: Family) -> Option<Self> {
        match family {
            Family::Virtex2 => Some(VIRTEX2),
            Family::Ecp5 => Some(ECP5),
            Family::Nexus => Some(NEXUS),
            Family::Spartan6 | Family::Series7 | Family::UltraScalePlus => None,
        }
    }

    fn is_multiplier(&self, cell: &Cell) -> bool {
        self.multipliers.contains(&cell.kind.as_str())
    }

    /// Whether a port is the product or a bit of it: `P`, or `P0` to `P35`.
    fn is_product(&self, port: &str) -> bool {
        port.strip_prefix(self.product).is_some_and(|bit| bit.bytes().all(|byte| byte.is_ascii_digit()))
    }

    /// Whether a cell is a multiplier all of whose registers are still free.
    fn is_free(&self, cell: &Cell) -> bool {
        let (registers, unused) = self.registers;
        self.is_multiplier(cell)
            && registers.iter().all(|name| cell.parameter(name).is_none_or(|register| register == unused))
    }

    /// Whether a multiplier can do what a flip-flop with such controls (clock, enable, reset) does. An unconnected enable is
    /// set, an unconnected reset is clear.
    fn can_do(&self, cell: &Cell, [_, enable, reset]: [Option<Bit>; 3]) -> bool {
        let loads = enable.is_none_or(|enable| enable == ALWAYS);
        let keeps = reset.is_none_or(|reset| reset == NEVER);
        let legal = |(name, values): &(&str, &[&str])| cell.parameter(name).is_none_or(|value| values.contains(&value));
        self.kinds.contains(&cell.kind.as_str())
            && (self.controlled || (loads && keeps))
            && self.modes.iter().all(legal)
    }
}

/// A multiplier with the register that it can take in.
#[derive(Debug, PartialEq, Eq)]
pub struct Registered {
    /// Name of the multiplier.
    multiplier: String,
    /// Flip-flops, each behind a bit of the product: port, bit of the port, name.
    flip_flops: Vec<(String, usize, String)>,
}

impl Registered {
    /// Flip-flops of the register.
    pub fn flip_flops(&self) -> u64 {
        self.flip_flops.len() as u64
    }

    /// Names of the multiplier and of the flip-flops.
    pub fn cells(&self) -> impl Iterator<Item = &str> {
        let flip_flops = self.flip_flops.iter().map(|(_, _, name)| name.as_str());
        std::iter::once(self.multiplier.as_str()).chain(flip_flops)
    }
}

/// What reads a bit of a product.
enum Load<'a> {
    /// The data input of a flip-flop.
    Register(&'a str, &'a Cell),
    /// Anything else.
    Other,
}

/// Multipliers all of whose used product bits go to one flip-flop each and nowhere else, flip-flops that the multiplier
/// can take in and that load and clear together; in the order of their names.
pub fn find(module: &Module, family: Family) -> Vec<Registered> {
    let Some(names) = Names::of(family) else { return vec![] };
    let multipliers = || module.cells.iter().filter(|(_, cell)| names.is_free(cell));
    let product = |cell: &'_ Cell| -> Vec<(String, usize, u64)> {
        let ports = cell.connections.iter().filter(|(port, _)| names.is_product(port));
        let bits = ports.flat_map(|(port, bits)| {
            let net = |(i, bit): (usize, &Bit)| bit.net().map(|net| (port.clone(), i, net));
            bits.iter().enumerate().filter_map(net)
        });
        bits.collect()
    };
    let nets = multipliers().flat_map(|(_, cell)| product(cell)).map(|(_, _, net)| (net, vec![]));
    let mut loads: HashMap<u64, Vec<Load>> = nets.collect();
    for net in module.ports.values().flat_map(|port| &port.bits).filter_map(|bit| bit.net()) {
        loads.entry(net).and_modify(|loads| loads.push(Load::Other));
    }
    for (name, cell) in &module.cells {
        for (port, bits) in &cell.connections {
            if names.is_multiplier(cell) && names.is_product(port) {
                continue;
            }
            let register = is_flip_flop(&cell.kind) && port == names.data;
            for net in bits.iter().filter_map(|bit| bit.net()) {
                let load = if register { Load::Register(name, cell) } else { Load::Other };
                loads.entry(net).and_modify(|loads| loads.push(load));
            }
        }
    }
    // Yosys drives constants of Nexus by cells.
    let constant = |(kind, level)| {
        let cells = module.cells.values().filter(move |cell| cell.kind == kind);
        cells.filter_map(move |cell| Some((cell.bit("Z")?, level)))
    };
    let constants: HashMap<Bit, Bit> = [("VHI", ALWAYS), ("VLO", NEVER)].into_iter().flat_map(constant).collect();
    let controls = |cell: &Cell| {
        let ports = [names.clock, names.enable, names.reset];
        ports.map(|port| cell.bit(port).map(|bit| *constants.get(&bit).unwrap_or(&bit)))
    };
    // What a register of the multiplier cannot tell apart from flip-flop to flip-flop.
    let control = |cell: &Cell| {
        let nets = controls(cell);
        let modes = names.modes.iter().map(|(name, _)| cell.parameter(name).map(str::to_owned));
        (cell.kind.clone(), nets, modes.collect::<Vec<_>>())
    };
    let register = |(name, cell): (&String, &Cell)| -> Option<Registered> {
        let mut found = Registered { multiplier: name.clone(), flip_flops: vec![] };
        let mut together = None;
        for (port, bit, net) in product(cell) {
            match loads[&net].as_slice() {
                [] => {}
                [Load::Register(name, cell)]
                    if names.can_do(cell, controls(cell))
                        && *together.get_or_insert(control(cell)) == control(cell) =>
                {
                    found.flip_flops.push((port, bit, (*name).to_owned()));
                }
                _ => return None,
            }
        }
        (!found.flip_flops.is_empty()).then_some(found)
    };
    multipliers().filter_map(register).collect()
}

/// Moves registers into the multipliers of a netlist for the ECP5 or Nexus, where they always load and never clear; returns
/// how many.
pub fn pack(netlist: &mut Netlist, family: Family) -> u64 {
    let Some(names) = Names::of(family) else { return 0 };
    let Some(inside) = names.inside else { return 0 };
    let mut packed = 0;
    for module in netlist.modules.values_mut() {
        for Registered { multiplier, flip_flops } in find(module, family) {
            // nextpnr for Nexus takes constants from the cells that drive them alone, as the flip-flop does.
            let flip_flop = &module.cells[&flip_flops[0].2];
            let Some(clock) = flip_flop.bit(names.clock) else { continue };
            let enable = flip_flop.bit(names.enable).unwrap_or(ALWAYS);
            let reset = flip_flop.bit(names.reset).unwrap_or(NEVER);
            let outputs: Vec<_> = flip_flops
                .into_iter()
                .filter_map(|(port, bit, name)| Some((port, bit, module.cells.remove(&name)?.bit("Q")?)))
                .collect();
            let Some(cell) = module.cells.get_mut(&multiplier) else { continue };
            for (port, bit, output) in outputs {
                cell.connections.entry(port).and_modify(|bits| bits[bit] = output);
            }
            for (port, bit) in inside.ports.into_iter().zip([clock, enable, reset]) {
                cell.connect(port, bit);
            }
            for (parameter, value) in inside.parameters {
                cell.set(parameter, value);
            }
            packed += 1;
        }
    }
    packed
}

/// A bit of an operand from now on: port, what is read there, and the net of the flip-flop in whose place the multiplier reads it.
type Moved = (String, Bit, Option<u64>);

/// What of a module registers of operands can be: by the net behind it, what each flip-flop loads, and its clock, of those that load
/// what comes from a flip-flop or a multiplier.
fn in_front(module: &Module) -> HashMap<u64, (Bit, Bit)> {
    let flip_flops = || module.cells.values().filter(|cell| is_flip_flop(&cell.kind));
    let products = module.cells.values().filter(|cell| ECP5.is_multiplier(cell)).flat_map(|cell| &cell.connections);
    let products = products.filter(|(port, _)| ECP5.is_product(port)).flat_map(|(_, bits)| bits);
    let direct: HashSet<u64> =
        flip_flops().filter_map(|cell| cell.bit("Q")).chain(products.copied()).filter_map(Bit::net).collect();
    let found = |cell: &Cell| {
        let controls = [ECP5.clock, ECP5.enable, ECP5.reset].map(|port| cell.bit(port));
        let (output, data, clock) = (cell.bit("Q")?.net()?, cell.bit(ECP5.data)?, controls[0]?);
        let is_direct = data.net().is_none_or(|net| direct.contains(&net));
        (is_direct && ECP5.can_do(cell, controls)).then_some((output, (data, clock)))
    };
    flip_flops().filter_map(found).collect()
}

/// The bits of an operand of a multiplier with its register inside, and the clock; none if that cannot be.
fn operand(cell: &Cell, operand: &str, in_front: &HashMap<u64, (Bit, Bit)>) -> Option<(Vec<Moved>, Bit)> {
    let ports = (0..18).map(|i| format!("{operand}{i}"));
    let bits: Vec<(String, Bit)> = ports.filter_map(|port| Some((port.clone(), cell.bit(&port)?))).collect();
    let free = cell.parameter(&format!("REG_INPUT{operand}_CLK")).is_none_or(|clock| clock == "NONE");
    let (_, clock) = *bits.iter().find_map(|(_, bit)| in_front.get(&bit.net()?))?;
    let own = cell.bit("CLK0").filter(|bit| bit.net().is_some());
    let moved = |(port, bit): (String, Bit)| match bit.net() {
        // Behind a register a one would be a zero at the start.
        None => (bit != ALWAYS).then_some((port, bit, None)),
        Some(net) => in_front.get(&net).filter(|found| found.1 == clock).map(|found| (port, found.0, Some(net))),
    };
    let moved = bits.into_iter().map(moved).collect::<Option<_>>()?;
    (free && own.is_none_or(|own| own == clock)).then_some((moved, clock))
}

/// Moves registers of both operands into the multipliers of a netlist for the ECP5; returns how many multipliers have theirs there.
/// One alone stays outside: nextpnr takes both or none. A flip-flop that something else reads stays beside its copies.
pub fn pack_operands(netlist: &mut Netlist) -> u64 {
    let mut packed = 0;
    for module in netlist.modules.values_mut() {
        let in_front = in_front(module);
        let mut copied: HashSet<u64> = HashSet::new();
        for cell in module.cells.values_mut().filter(|cell| ECP5.is_multiplier(cell)) {
            let operands = OPERANDS.map(|name| operand(cell, name, &in_front));
            let [Some((a, clock)), Some((b, clock_of_b))] = operands else { continue };
            if clock != clock_of_b {
                continue;
            }
            for name in OPERANDS {
                for (parameter, value) in [("CLK", "CLK0"), ("CE", "CE0"), ("RST", "RST0")] {
                    cell.set(&format!("REG_INPUT{name}_{parameter}"), value);
                }
            }
            for (port, bit) in [("CLK0", clock), ("CE0", ALWAYS), ("RST0", NEVER)] {
                cell.connect(port, bit);
            }
            for (port, bit, in_place_of) in a.into_iter().chain(b) {
                cell.connections.insert(port, vec![bit]);
                copied.extend(in_place_of);
            }
            packed += 1;
        }
        // What a flip-flop that goes has read, a multiplier reads now: none goes because another has gone.
        let output = |cell: &Cell| cell.bit("Q").and_then(Bit::net).filter(|_| is_flip_flop(&cell.kind));
        let cells = module.cells.values();
        let read =
            cells.flat_map(|cell| cell.connections.iter().filter(|(port, _)| *port != "Q" || output(cell).is_none()));
        let read = read.map(|(_, bits)| bits).chain(module.ports.values().map(|port| &port.bits));
        let read: HashSet<u64> = read.flatten().filter_map(|bit| bit.net()).collect();
        let gone = |cell: &Cell| output(cell).is_some_and(|net| copied.contains(&net) && !read.contains(&net));
        module.cells.retain(|_, cell| !gone(cell));
    }
    packed
}

/// [`pack`], and on the ECP5 [`pack_operands`] and that of memories, on a netlist that Yosys has written to `from`; the changed one is written to `to`.
///
/// # Errors
/// What cannot be read or written.
pub fn pack_file(from: &Path, to: &Path, family: Family) -> Result<Netlist, ToolError> {
    let mut netlist = Netlist::read(from)?;
    pack(&mut netlist, family);
    if family == Family::Ecp5 {
        pack_operands(&mut netlist);
        memory_registers::pack(&mut netlist);
    }
    netlist.write(to)?;
    Ok(netlist)
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
        let found = find(&module(""), Family::Virtex2);
        assert_eq!(found.iter().map(Registered::flip_flops).collect::<Vec<_>>(), [2]);
        // Not in other families, where Yosys itself moves them.
        assert_eq!(find(&module(""), Family::Series7), []);
    }

    #[test]
    fn registers_that_a_multiplier_cannot_be_stay_outside() {
        let with = |kind: &str, init: &str| {
            let mut module = module("");
            let cell = module.cells.get_mut("b").unwrap();
            cell.kind = kind.to_owned();
            cell.set("INIT", init);
            find(&module, Family::Virtex2).len()
        };
        assert_eq!((with("FDE", "0"), with("FDE", "1"), with("FDSE", "0"), with("FDRE_1", "0")), (0, 0, 0, 0));
        let both = |init: &str| {
            let mut module = module("");
            for name in ["a", "b"] {
                module.cells.get_mut(name).unwrap().set("INIT", init);
            }
            find(&module, Family::Virtex2).len()
        };
        assert_eq!((both("0"), both("1")), (1, 0));
    }

    #[test]
    fn a_product_that_is_read_elsewhere_keeps_its_registers() {
        let inverter = r#", "i": {"type": "INV", "connections": {"I": [5], "O": [8]}}"#;
        assert_eq!(find(&module(inverter), Family::Virtex2), []);
        let port = r#"{"ports": {"p": {"bits": [4]}}, "cells": {
            "m": {"type": "MULT18X18", "connections": {"P": [4]}},
            "a": {"type": "FDRE", "connections": {"D": [4], "Q": [6], "CE": ["1"], "R": ["0"]}}}}"#;
        assert_eq!(find(&serde_json::from_str(port).unwrap(), Family::Virtex2), []);
    }

    /// A MULT18X18D with two registered bits of product; `control` are more connections of the second flip-flop.
    fn ecp5(control: &str) -> Netlist {
        let text = format!(
            r#"{{"creator": "Yosys", "modules": {{"top": {{"attributes": {{"top": "1"}}, "ports": {{"q": {{"bits": [6, 7]}}}},
            "netnames": {{"q": {{"bits": [6, 7]}}}}, "cells": {{
            "m": {{"type": "MULT18X18D", "parameters": {{}}, "port_directions": {{"P0": "output"}},
                   "connections": {{"A0": [2], "B0": [3], "P0": [4], "P1": [5], "P2": [8]}}}},
            "a": {{"type": "TRELLIS_FF", "parameters": {{"CEMUX": "1 ", "CLKMUX": "CLK"}},
                   "connections": {{"DI": [4], "Q": [6], "CLK": [1], "LSR": ["0"]}}}},
            "b": {{"type": "TRELLIS_FF", "parameters": {{"CEMUX": "1 ", "CLKMUX": "CLK"}},
                   "connections": {{"DI": [5], "Q": [7], "CLK": [1]{control}}}}}}}}}}}}}"#
        );
        serde_json::from_str(&text).unwrap()
    }

    #[test]
    fn registers_move_into_multipliers_and_all_else_stays() {
        let mut netlist = ecp5(r#", "LSR": ["0"]"#);
        assert_eq!(pack(&mut netlist, Family::Ecp5), 1);
        let expected = r#"{"creator": "Yosys", "modules": {"top": {"attributes": {"top": "1"}, "ports": {"q": {"bits": [6, 7]}},
            "netnames": {"q": {"bits": [6, 7]}}, "cells": {
            "m": {"type": "MULT18X18D",
                  "parameters": {"REG_OUTPUT_CLK": "CLK0", "REG_OUTPUT_CE": "CE0", "REG_OUTPUT_RST": "RST0"},
                  "port_directions": {"P0": "output", "CLK0": "input", "CE0": "input", "RST0": "input"},
                  "connections": {"A0": [2], "B0": [3], "P0": [6], "P1": [7], "P2": [8],
                                  "CLK0": [1], "CE0": ["1"], "RST0": ["0"]}}}}}}"#;
        let value = |text: &str| serde_json::from_str::<serde_json::Value>(text).unwrap();
        assert_eq!(serde_json::to_value(&netlist).unwrap(), value(expected));
        // Once more there is nothing to be moved, and a second register stays where it is.
        let register = r#"{"type": "TRELLIS_FF", "connections": {"DI": [6], "Q": [9], "CLK": [1]}}"#;
        let top = netlist.modules.get_mut("top").unwrap();
        top.ports.clear();
        top.cells.insert("second".to_owned(), serde_json::from_str(register).unwrap());
        assert_eq!(pack(&mut netlist, Family::Ecp5), 0);
    }

    #[test]
    fn registers_that_do_not_load_together_or_clear_stay_outside() {
        assert_eq!(pack(&mut ecp5(r#", "LSR": ["0"], "CE": [9]"#), Family::Ecp5), 0);
        assert_eq!(pack(&mut ecp5(r#", "LSR": [9]"#), Family::Ecp5), 0);
        let both = |port, control| {
            let mut both = ecp5(control);
            both.modules.get_mut("top").unwrap().cells.get_mut("a").unwrap().connect(port, Bit::Net(9));
            pack(&mut both, Family::Ecp5)
        };
        assert_eq!(both("LSR", r#", "LSR": [9]"#), 0);
        assert_eq!(both("CE", r#", "LSR": ["0"], "CE": [9]"#), 0);
        assert_eq!(both("CLK", r#", "LSR": ["0"], "CLK": [1]"#), 0);
        let mode = |name, value, cells: &[&str]| {
            let mut netlist = ecp5(r#", "LSR": ["0"]"#);
            for cell in cells {
                netlist.modules.get_mut("top").unwrap().cells.get_mut(*cell).unwrap().set(name, value);
            }
            pack(&mut netlist, Family::Ecp5)
        };
        assert_eq!(mode("CLKMUX", "CLK", &["a", "b"]), 1);
        assert_eq!(mode("CLKMUX", "INV", &["a", "b"]), 0);
        assert_eq!(mode("REGSET", "SET", &["a", "b"]), 0);
        assert_eq!(mode("REGSET", "SET", &["b"]), 0);
    }

    /// A multiplier of `a` and `b`, and one of `a` and `z`: `a` and `z` are behind `x`, `b` is behind `y`; `more` are cells beside them.
    fn operands(y: &str, more: &str) -> Netlist {
        let flip_flop = |d: u64, q: u64| {
            format!(r#"{{"type": "TRELLIS_FF", "connections": {{"DI": [{d}], "Q": [{q}], "CLK": [1], "LSR": ["0"]}}}}"#)
        };
        let multiplier = |b: u64, p: u64| {
            format!(r#"{{"type": "MULT18X18D", "connections": {{"A0": [3], "A1": ["0"], "B0": [{b}], "P0": [{p}]}}}}"#)
        };
        let cells = [
            ("x", flip_flop(9, 2)),
            ("a", flip_flop(2, 3)),
            ("y", y.replace("NET", "4")),
            ("b", flip_flop(4, 5)),
            ("z", flip_flop(2, 8)),
            ("m", multiplier(5, 6)),
            ("n", multiplier(8, 7)),
        ];
        let cells = cells.map(|(name, cell)| format!(r#""{name}": {cell}"#)).join(", ");
        serde_json::from_str(&format!(r#"{{"modules": {{"top": {{"cells": {{{cells}{more}}}}}}}}}"#)).unwrap()
    }

    #[test]
    fn registers_of_operands_move_into_each_multiplier() {
        let inner = r#"{"type": "MULT18X18D", "connections": {"P0": [NET]}}"#;
        let table = r#"{"type": "LUT4", "connections": {"A": [9], "Z": [NET]}}"#;
        let reader = r#", "r": {"type": "LUT4", "connections": {"A": [3], "Z": [10]}}"#;
        // Multipliers with operands taken in, and whether the flip-flops are left.
        let found = |y: &str, more: &str| {
            let mut netlist = operands(y, more);
            let packed = pack_operands(&mut netlist);
            let cells = &netlist.modules["top"].cells;
            (packed, ["x", "a", "b"].map(|name| cells.contains_key(name)))
        };
        assert_eq!(found(inner, ""), (2, [true, false, false]));
        assert_eq!(found(table, ""), (1, [true, true, true]), "a register behind logic stays, and the other operand's");
        assert_eq!(found(inner, reader), (2, [true, true, false]), "one that is read elsewhere stays");
        let mut netlist = operands(inner, "");
        pack_operands(&mut netlist);
        let n = &netlist.modules["top"].cells["n"];
        assert_eq!(["A0", "B0", "CLK0"].map(|port| n.bit(port)), [2, 2, 1].map(|net| Some(Bit::Net(net))));
        assert_eq!(["REG_INPUTA_CLK", "REG_INPUTB_CLK"].map(|name| n.parameter(name)), [Some("CLK0"); 2]);
        assert_eq!(pack_operands(&mut netlist), 0, "once more there is nothing to be moved");
    }

    #[test]
    fn registers_of_operands_that_a_multiplier_cannot_be_stay_outside() {
        let inner = r#"{"type": "MULT18X18D", "connections": {"P0": [NET]}}"#;
        let with = |change: &dyn Fn(&mut Cell)| {
            let mut netlist = operands(inner, "");
            change(netlist.modules.get_mut("top").unwrap().cells.get_mut("a").unwrap());
            pack_operands(&mut netlist)
        };
        assert_eq!(with(&|_| ()), 2);
        assert_eq!(with(&|a| a.connect("DI", ALWAYS)), 2, "a one that is a zero at the start, as in the multiplier");
        assert_eq!(with(&|a| a.set("REGSET", "SET")), 0);
        assert_eq!(with(&|a| a.connect("CE", Bit::Net(10))), 0);
        assert_eq!(with(&|a| a.connect("CLK", Bit::Net(10))), 0, "one clock for both operands");
    }

    #[test]
    fn nexus_multipliers_take_their_registers_in() {
        // Two products, the latter of 9 x 9 bits; `gsr` of the flip-flop behind it.
        let nexus = |gsr: &str| -> Netlist {
            let multiplier = |kind: &str, z: u64| {
                format!(
                    r#"{{"type": "{kind}", "parameters": {{"REGINPUTA": "BYPASS", "REGINPUTB": "BYPASS", "REGOUTPUT": "BYPASS"}},
                    "connections": {{"A": [2], "B": [3], "Z": [{z}]}}}}"#
                )
            };
            let flip_flop = |gsr: &str, d: u64| {
                format!(
                    r#"{{"type": "FD1P3IX", "parameters": {{"GSR": "{gsr}"}},
                    "connections": {{"D": [{d}], "Q": [{}], "CK": [1], "SP": [8], "CD": [9]}}}}"#,
                    d + 2
                )
            };
            let cells = [
                ("m", multiplier("MULT18X18", 4)),
                ("n", multiplier("MULT9X9", 5)),
                ("a", flip_flop("DISABLED", 4)),
                ("b", flip_flop(gsr, 5)),
                ("one", r#"{"type": "VHI", "connections": {"Z": [8]}}"#.to_owned()),
                ("zero", r#"{"type": "VLO", "connections": {"Z": [9]}}"#.to_owned()),
            ];
            let cells = cells.map(|(name, cell)| format!(r#""{name}": {cell}"#)).join(", ");
            serde_json::from_str(&format!(r#"{{"modules": {{"top": {{"cells": {{{cells}}}}}}}}}"#)).unwrap()
        };
        let mut netlist = nexus("DISABLED");
        assert_eq!(pack(&mut netlist, Family::Nexus), 2);
        let cells = &netlist.modules["top"].cells;
        assert_eq!(cells.keys().collect::<Vec<_>>(), ["m", "n", "one", "zero"]);
        let n = &cells["n"];
        let [z, clock, enable, reset] = ["Z", "CLK", "CEOUT", "RSTOUT"].map(|port| n.bit(port));
        assert_eq!([z, clock, enable, reset], [7, 1, 8, 9].map(|net| Some(Bit::Net(net))));
        let of = ["REGOUTPUT", "REGINPUTA", "RESETMODE", "GSR"].map(|name| n.parameter(name).unwrap());
        assert_eq!(of, ["REGISTER", "BYPASS", "SYNC", "DISABLED"]);
        assert_eq!(pack(&mut netlist, Family::Nexus), 0);
        assert_eq!(pack(&mut nexus("ENABLED"), Family::Nexus), 1, "a reset of the whole part stays");
    }
}
