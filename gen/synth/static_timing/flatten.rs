//! A netlist of modules as one list of cells.

use super::TimingError;
use serde_json::{Map, Value};
use std::collections::HashMap;

/// A cell of the library.
pub(super) struct Cell {
    pub kind: String,
    /// Port, bit of the port, net.
    pub pins: Vec<(String, usize, usize)>,
}

/// All cells of a design; nets are numbered from 0.
#[derive(Default)]
pub(super) struct Design {
    pub cells: Vec<Cell>,
    pub nets: usize,
    /// Our own name of a net, where it has one.
    pub names: Vec<Option<String>>,
    /// Nets that leave the design.
    pub outputs: Vec<usize>,
}

type Nets = HashMap<u64, usize>;

/// Puts the modules below `top` into it.
pub(super) fn flatten(netlist: &Value, top: &str) -> Result<Design, TimingError> {
    let missing = |what: &str| TimingError::Netlist(format!("{what} is missing"));
    let modules = netlist["modules"].as_object().ok_or_else(|| missing("modules"))?;
    let module = modules.get(top).ok_or_else(|| missing(top))?;
    let mut design = Design::default();
    let mut nets = Nets::new();
    design.module(modules, module, "", &mut nets)?;
    let ports = module["ports"].as_object();
    for port in ports.into_iter().flat_map(Map::values).filter(|port| port["direction"] == "output") {
        design.outputs.extend(bits(&port["bits"]).filter_map(|(_, bit)| nets.get(&bit?).copied()));
    }
    Ok(design)
}

/// The bits of a connection, none for constants.
fn bits(connection: &Value) -> impl Iterator<Item = (usize, Option<u64>)> + '_ {
    connection.as_array().into_iter().flatten().map(Value::as_u64).enumerate()
}

/// Whether a module is a cell of the library.
fn is_library(module: &Value) -> bool {
    ["blackbox", "whitebox"].iter().any(|mark| !module["attributes"][*mark].is_null())
}

impl Design {
    fn net(&mut self, nets: &mut Nets, bit: u64) -> usize {
        *nets.entry(bit).or_insert_with(|| {
            self.names.push(None);
            self.nets += 1;
            self.nets - 1
        })
    }

    fn module(
        &mut self,
        modules: &Map<String, Value>,
        module: &Value,
        path: &str,
        nets: &mut Nets,
    ) -> Result<(), TimingError> {
        let cells = module["cells"].as_object().ok_or_else(|| TimingError::Netlist(format!("no cells in {path}")))?;
        for (name, value) in module["netnames"].as_object().into_iter().flatten() {
            if is_ours(name) {
                let all: Vec<(usize, Option<u64>)> = bits(&value["bits"]).collect();
                for (i, bit) in all.iter().filter_map(|(i, bit)| Some((i, (*bit)?))) {
                    let net = self.net(nets, bit);
                    let place = if all.len() > 1 { format!("[{i}]") } else { String::new() };
                    self.names[net].get_or_insert_with(|| format!("{path}{name}{place}"));
                }
            }
        }
        for (name, cell) in cells {
            let kind = cell["type"].as_str().ok_or_else(|| TimingError::Netlist(format!("{name} has no type")))?;
            let connections = cell["connections"].as_object();
            match modules.get(kind).filter(|module| !is_library(module)) {
                None => {
                    let mut pins = vec![];
                    for (port, connection) in connections.into_iter().flatten() {
                        for (i, bit) in bits(connection).filter_map(|(i, bit)| Some((i, bit?))) {
                            pins.push((port.clone(), i, self.net(nets, bit)));
                        }
                    }
                    self.cells.push(Cell { kind: kind.to_owned(), pins });
                }
                Some(inner) => {
                    let mut below = Nets::new();
                    for (port, connection) in connections.into_iter().flatten() {
                        let inside: Vec<(usize, Option<u64>)> = bits(&inner["ports"][port]["bits"]).collect();
                        for ((_, inside), (_, outside)) in inside.iter().zip(bits(connection)) {
                            if let (Some(inside), Some(outside)) = (inside, outside) {
                                let net = self.net(nets, outside);
                                below.insert(*inside, net);
                            }
                        }
                    }
                    self.module(modules, inner, &format!("{path}{name}."), &mut below)?;
                }
            }
        }
        Ok(())
    }
}

/// Whether a name is one of our signals: not one of Yosys' (`$...`) nor of GHDL's (`n123_q`).
fn is_ours(name: &str) -> bool {
    let number = name.strip_prefix('n').is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()));
    !name.contains('$') && !number
}
