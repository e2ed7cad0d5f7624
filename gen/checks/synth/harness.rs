//! The harness in which the whole is placed and routed.

use super::netlist;
use askama::Template;
use efsat_hardware::netlist::Module;

/// Name of the harness module.
pub const TOP: &str = "harness";

/// Name of the file.
pub const VERILOG: &str = "harness.v";

/// Label of the unit in it.
pub const INSTANCE: &str = "unit";

/// A port of the unit and its place among all bits of its direction.
struct Port {
    name: String,
    high: u32,
    low: u32,
}

#[derive(Template)]
#[template(path = "harness.v", escape = "none")]
struct Harness<'a> {
    name: &'a str,
    top: &'a str,
    instance: &'a str,
    clock: &'a str,
    inputs: Vec<Port>,
    input_high: u32,
    outputs: Vec<Port>,
    output_high: u32,
}

/// Ports side by side, and the bits of all.
fn side_by_side(ports: impl Iterator<Item = (String, u32)>) -> (Vec<Port>, u32) {
    let mut low = 0;
    let place = |(name, bits): (String, u32)| {
        let port = Port { name, high: low + bits - 1, low };
        low += bits;
        port
    };
    let ports = ports.map(place).collect();
    (ports, low)
}

/// The Verilog of the harness of a module of ours.
pub fn of_module(top: &Module) -> String {
    let inputs = top.inputs.iter().map(|id| (top.signal(*id).name(), top.signal(*id).ty.bits));
    let outputs = top.outputs.iter().map(|(name, id)| (name.to_string(), top.signal(*id).ty.bits));
    text(&top.name, "clk", side_by_side(inputs), side_by_side(outputs))
}

/// The Verilog of the harness of a module of a netlist, with the name of its clock.
pub fn of_netlist(top: &str, clock: &str, module: &netlist::Module) -> String {
    let side = |input: bool| {
        let ports = module.ports.iter().filter(|(name, port)| *name != clock && port.is_input() == input);
        side_by_side(ports.map(|(name, port)| (name.clone(), port.bits.len() as u32)))
    };
    text(top, clock, side(true), side(false))
}

fn text(
    top: &str,
    clock: &str,
    (inputs, input_bits): (Vec<Port>, u32),
    (outputs, output_bits): (Vec<Port>, u32),
) -> String {
    let [input_high, output_high] = [input_bits - 1, output_bits - 1];
    let harness = Harness { name: TOP, top, instance: INSTANCE, clock, inputs, input_high, outputs, output_high };
    harness.render().expect("the template renders")
}
