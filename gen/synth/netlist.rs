//! A netlist as Yosys writes it (`write_json`).

use crate::verilog::ToolError;
use serde::Deserialize;
use std::collections::HashMap;
use std::io::BufReader;
use std::path::Path;

/// A netlist.
#[derive(Debug, Deserialize)]
pub struct Netlist {
    /// Modules by name, library cells among them.
    pub modules: HashMap<String, Module>,
}

/// A module: ours, or a cell of the library.
#[derive(Debug, Deserialize)]
pub struct Module {
    /// Ports by name.
    #[serde(default)]
    pub ports: HashMap<String, Port>,
    /// Cells by name.
    #[serde(default)]
    pub cells: HashMap<String, Cell>,
}

/// A port of a module.
#[derive(Debug, Deserialize)]
pub struct Port {
    /// The net of each bit, from the lowest up.
    pub bits: Vec<Bit>,
}

/// A cell.
#[derive(Debug, Deserialize)]
pub struct Cell {
    /// Name of a library cell or of a module.
    #[serde(rename = "type")]
    pub kind: String,
    /// The net of each bit of each port, from the lowest up.
    pub connections: HashMap<String, Vec<Bit>>,
}

/// What a bit is connected to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(untagged)]
pub enum Bit {
    /// A net of the module.
    Net(u64),
    /// A constant.
    Constant(Level),
}

/// A constant bit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
pub enum Level {
    /// Low.
    #[serde(rename = "0")]
    Zero,
    /// High.
    #[serde(rename = "1")]
    One,
    /// Any.
    #[serde(rename = "x")]
    Any,
    /// Not driven.
    #[serde(rename = "z")]
    Open,
}

impl Cell {
    /// The net of the lowest bit of a port.
    pub fn bit(&self, port: &str) -> Option<Bit> {
        self.connections.get(port)?.first().copied()
    }
}

impl Netlist {
    /// Reads a file that Yosys has written.
    ///
    /// # Errors
    /// What cannot be read.
    pub fn read(path: &Path) -> Result<Self, ToolError> {
        let file = std::fs::File::open(path).map_err(ToolError::file(path))?;
        let failed = |e: serde_json::Error| ToolError::failed("Yosys", e.to_string());
        serde_json::from_reader(BufReader::new(file)).map_err(failed)
    }
}
