//! Netlists small enough to add up by hand.

use super::*;
use serde_json::{Value, json};

/// A netlist of one module; `names` are its nets.
fn netlist(cells: Value, names: &[(&str, u64)]) -> Value {
    let names: serde_json::Map<String, Value> =
        names.iter().map(|(name, bit)| ((*name).to_owned(), json!({ "bits": [bit] }))).collect();
    json!({ "modules": { "top": { "ports": {}, "cells": cells, "netnames": names } } })
}

fn flip_flop(d: u64, q: u64) -> Value {
    json!({ "type": "FDRE", "connections": { "C": [1], "CE": ["1"], "R": ["0"], "D": [d], "Q": [q] } })
}

fn cell(kind: &str, pins: &[(&str, u64)]) -> Value {
    let pins: serde_json::Map<String, Value> =
        pins.iter().map(|(port, net)| ((*port).to_owned(), json!([net]))).collect();
    json!({ "type": kind, "connections": pins })
}

fn read(netlist: Value) -> Netlist {
    serde_json::from_value(netlist).unwrap()
}

fn timing_of(netlist: Value) -> Timing {
    estimate(&read(netlist), "top").unwrap()
}

#[track_caller]
fn close(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-9, "{found}, not {expected}");
}

#[test]
fn a_table_between_flip_flops() {
    let cells = json!({
        "f": flip_flop(9, 2),
        "l": cell("LUT1", &[("I0", 2), ("O", 3)]),
        "g": flip_flop(3, 4),
    });
    let timing = timing_of(netlist(cells, &[("x", 2), ("n17_q", 2), ("y", 3), ("$auto$1", 3)]));
    // Clock to output, net of one load, table, no net to its own flip-flop, set-up.
    close(timing.ns, 0.568 + 0.61 + 0.439 + 0.370);
    close(timing.megahertz, 1000.0 / 1.987);
    close(timing.derated_megahertz, 800.0 / 1.987);
    assert_eq!(timing.path, ["x", "y"]);
    assert_eq!(timing.beside_multipliers, BesideMultipliers::default());
}

#[test]
fn a_sum_of_three_bits() {
    let cells = json!({
        "a": flip_flop(20, 2),
        "s0": cell("LUT2", &[("I0", 2), ("I1", 30), ("O", 3)]),
        "c0": cell("MUXCY", &[("S", 3), ("DI", 2), ("CI", 31), ("O", 4)]),
        "c1": cell("MUXCY", &[("S", 32), ("DI", 33), ("CI", 4), ("O", 5)]),
        "x2": cell("XORCY", &[("LI", 34), ("CI", 5), ("O", 6)]),
        "q": flip_flop(6, 7),
    });
    let timing = timing_of(netlist(cells, &[("a", 2), ("sum", 6)]));
    // The operand has two loads: its table and the carry.
    close(timing.ns, 0.568 + 0.83 + 0.439 + 0.298 + 0.053 + 1.274 + 0.370);
    assert_eq!(timing.path, ["a", "sum"]);
}

#[test]
fn a_carry_that_leaves_its_chain_is_slower() {
    let cells = json!({
        "a": flip_flop(20, 2),
        "s0": cell("LUT2", &[("I0", 2), ("I1", 30), ("O", 3)]),
        "c0": cell("MUXCY", &[("S", 3), ("DI", 35), ("CI", 31), ("O", 4)]),
        "q": flip_flop(4, 7),
    });
    close(timing_of(netlist(cells, &[])).ns, 0.568 + 0.61 + 0.439 + 1.187 + 0.61 + 0.370);
}

fn multiplier(more: Value) -> Value {
    let mut cells = json!({
        "a": flip_flop(20, 2),
        "m": json!({ "type": "MULT18X18", "connections": { "A": [2], "B": ["1"], "P": [3, 4] } }),
        "p0": flip_flop(3, 5),
        "p1": flip_flop(4, 6),
        "l": cell("LUT2", &[("I0", 5), ("I1", 6), ("O", 7)]),
        "q": flip_flop(7, 8),
        "r": flip_flop(8, 9),
    });
    cells.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
    cells
}

#[test]
fn registered_multipliers_are_given_apart() {
    let timing = timing_of(netlist(multiplier(json!({})), &[]));
    close(timing.ns, 0.568 + 0.61 + 0.370);
    close(timing.beside_multipliers.into.unwrap(), 0.568 + 0.61);
    close(timing.beside_multipliers.out_of.unwrap(), 0.61 + 0.439 + 0.370);
}

#[test]
fn a_product_that_is_read_elsewhere_is_combinational() {
    let inverter = json!({ "i": cell("INV", &[("I", 3), ("O", 10)]) });
    let timing = timing_of(netlist(multiplier(inverter), &[]));
    // Bit 1 has one load, bit 0 two.
    close(timing.ns, 0.568 + 0.61 + 3.111 + 0.83 + 0.370);
    assert_eq!(timing.beside_multipliers, BesideMultipliers::default());
}

#[test]
fn modules_are_put_into_each_other() {
    let inner = json!({
        "ports": { "d": { "direction": "input", "bits": [2] }, "q": { "direction": "output", "bits": [3] } },
        "cells": { "l": cell("LUT1", &[("I0", 2), ("O", 3)]) },
        "netnames": { "d": { "bits": [2] }, "q": { "bits": [3] } },
    });
    let cells = json!({
        "f": flip_flop(9, 5),
        "u": cell("inner", &[("d", 5), ("q", 6)]),
        "v": cell("inner", &[("d", 6), ("q", 7)]),
        "g": flip_flop(7, 8),
    });
    let mut netlist = netlist(cells, &[("x", 5)]);
    netlist["modules"]["inner"] = inner;
    let timing = timing_of(netlist.clone());
    close(timing.ns, 0.568 + 0.61 + 0.439 + 0.61 + 0.439 + 0.370);
    assert_eq!(timing.path, ["x", "u.q", "v.q"]);
    // What is marked as a cell of the library stays one.
    netlist["modules"]["LUT1"] = json!({ "attributes": { "blackbox": "1" }, "cells": {} });
    close(timing_of(netlist).ns, timing.ns);
}

#[test]
fn what_cannot_be_timed_is_said() {
    let nothing = read(netlist(json!({}), &[]));
    assert_eq!(estimate(&nothing, "efsat"), Err(TimingError::Missing("efsat".to_owned())));
    assert_eq!(estimate(&nothing, "top"), Err(TimingError::NoPath("top".to_owned())));
    let ring = json!({
        "a": cell("INV", &[("I", 2), ("O", 3)]),
        "b": cell("INV", &[("I", 3), ("O", 2)]),
    });
    assert_eq!(estimate(&read(netlist(ring, &[("ring", 3)])), "top"), Err(TimingError::Loop("ring".to_owned())));
}
