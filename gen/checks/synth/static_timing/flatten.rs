//! A netlist of modules as one list of cells.

use crate::synth::netlist::{Bit, Module, Netlist, is_ours};
use crate::synth::product_registers;
use efsat_hardware::device::Family;
use std::collections::{HashMap, HashSet};

/// A cell of the library.
pub(super) struct Cell {
    pub kind: String,
    /// Port, bit of the port, net.
    pub pins: Vec<(String, usize, usize)>,
    /// Whether it is a multiplier with the register behind it inside, or a flip-flop of such a register.
    pub registered: bool,
}

/// All cells of a design; nets are numbered from 0.
#[derive(Default)]
pub(super) struct Design {
    pub cells: Vec<Cell>,
    pub nets: usize,
    /// Our own name of a net, where it has one.
    pub names: Vec<Option<String>>,
}

type Nets = HashMap<u64, usize>;

/// Puts the modules below `top` into it; none if it is not there.
pub(super) fn flatten(netlist: &Netlist, top: &str) -> Option<Design> {
    let module = netlist.modules.get(top)?;
    let mut design = Design::default();
    design.module(netlist, module, "", &mut Nets::new());
    Some(design)
}

/// The nets of a connection with their places, constants left out.
fn nets(bits: &[Bit]) -> impl Iterator<Item = (usize, u64)> + '_ {
    bits.iter().enumerate().filter_map(|(i, bit)| Some((i, bit.net()?)))
}

impl Design {
    fn net(&mut self, known: &mut Nets, bit: u64) -> usize {
        *known.entry(bit).or_insert_with(|| {
            self.names.push(None);
            self.nets += 1;
            self.nets - 1
        })
    }

    fn module(&mut self, netlist: &Netlist, module: &Module, path: &str, known: &mut Nets) {
        for (name, signal) in module.netnames.iter().filter(|(name, _)| is_ours(name)) {
            for (i, bit) in nets(&signal.bits) {
                let net = self.net(known, bit);
                let place = if signal.bits.len() > 1 { format!("[{i}]") } else { String::new() };
                self.names[net].get_or_insert_with(|| format!("{path}{name}{place}"));
            }
        }
        let found = product_registers::find(module, Family::Virtex2);
        let registered: HashSet<&str> = found.iter().flat_map(|found| found.cells()).collect();
        for (name, cell) in &module.cells {
            match netlist.modules.get(&cell.kind).filter(|module| !module.is_library()) {
                None => {
                    let mut pins = vec![];
                    for (port, bits) in &cell.connections {
                        pins.extend(nets(bits).map(|(i, bit)| (port.clone(), i, self.net(known, bit))));
                    }
                    let registered = registered.contains(name.as_str());
                    self.cells.push(Cell { kind: cell.kind.clone(), pins, registered });
                }
                Some(inner) => {
                    let mut below = Nets::new();
                    for (port, outside) in &cell.connections {
                        let inside = inner.ports.get(port).map_or(&[][..], |port| &port.bits);
                        for (inside, outside) in inside.iter().zip(outside) {
                            if let (Some(inside), Some(outside)) = (inside.net(), outside.net()) {
                                let net = self.net(known, outside);
                                below.insert(inside, net);
                            }
                        }
                    }
                    self.module(netlist, inner, &format!("{path}{name}."), &mut below);
                }
            }
        }
    }
}
