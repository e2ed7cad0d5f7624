//! How many inputs the outputs of a design drive, at most.

use super::harness;
use super::netlist::{Module, Netlist, is_flip_flop};
use std::collections::HashMap;

/// The most inputs that one output drives; the harness's own outputs are left out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Loads {
    /// Of logic: a look-up table, a multiplexer behind tables, or a carry chain.
    pub logic: usize,
    /// Of a flip-flop.
    pub flip_flop: usize,
}

/// Cells of the ECP5 that are logic.
const LOGIC: [&str; 4] = ["LUT4", "PFUMX", "L6MUX21", "CCU2C"];

impl Loads {
    /// Those of a netlist of the whole in its harness.
    pub(super) fn of(netlist: &Netlist) -> Self {
        netlist.modules.values().map(Self::in_module).fold(Self::default(), |most, of| Self {
            logic: most.logic.max(of.logic),
            flip_flop: most.flip_flop.max(of.flip_flop),
        })
    }

    fn in_module(module: &Module) -> Self {
        let (mut read, mut driven) = (HashMap::<u64, usize>::new(), vec![]);
        for (name, cell) in &module.cells {
            for (port, bits) in &cell.connections {
                let nets = bits.iter().filter_map(|bit| bit.net());
                if !cell.is_output(port) {
                    nets.for_each(|net| *read.entry(net).or_default() += 1);
                } else if of_design(name) {
                    driven.extend(nets.map(|net| (net, cell.kind.as_str())));
                }
            }
        }
        let most = |is: &dyn Fn(&str) -> bool| {
            let ours = driven.iter().filter(|(_, kind)| is(kind));
            ours.filter_map(|(net, _)| read.get(net)).copied().max().unwrap_or(0)
        };
        Self { logic: most(&|kind| LOGIC.contains(&kind)), flip_flop: most(&is_flip_flop) }
    }
}

/// Whether a cell is of the design and not of its harness.
fn of_design(name: &str) -> bool {
    name.strip_prefix(harness::INSTANCE).is_some_and(|rest| rest.starts_with('.'))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_most_inputs_of_one_output_are_counted() {
        let cell = |name: &str, kind: &str, inputs: &[u64], output: u64| {
            let ports = [("A", "input"), ("B", "input"), ("C", "input"), ("Z", "output")];
            let nets = inputs.iter().chain(std::iter::repeat(&0)).take(3).chain([&output]);
            let connections: Vec<String> =
                ports.iter().zip(nets).map(|((p, _), n)| format!("\"{p}\": [{n}]")).collect();
            let directions: Vec<String> = ports.iter().map(|(p, d)| format!("\"{p}\": \"{d}\"")).collect();
            format!(
                r#""{name}": {{"type": "{kind}", "port_directions": {{{}}}, "connections": {{{}}}}}"#,
                directions.join(", "),
                connections.join(", ")
            )
        };
        let loads = |cells: &[String]| {
            let text = format!(r#"{{"modules": {{"top": {{"cells": {{{}}}}}}}}}"#, cells.join(", "));
            Loads::of(&serde_json::from_str(&text).unwrap())
        };
        // Net 1 has one reader twice and another once, net 2 two; net 3 is of the harness and has three.
        let cells = [
            cell("unit.a", "LUT4", &[2, 3], 1),
            cell("unit.b", "TRELLIS_FF", &[1, 1, 3], 2),
            cell("given", "LUT4", &[1], 3),
            cell("unit.c", "DP16KD", &[2, 3], 4),
        ];
        assert_eq!(loads(&cells), Loads { logic: 3, flip_flop: 2 });
        assert_eq!(loads(&cells[..1]), Loads::default());
    }
}
