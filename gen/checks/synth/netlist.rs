//! A netlist as Yosys writes it (`write_json`). What is not named here is kept as it is.

use super::ToolError;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use std::io::{BufReader, BufWriter, Write};
use std::path::Path;

/// A netlist.
#[derive(Debug, Deserialize, Serialize)]
pub struct Netlist {
    /// Modules by name, library cells among them.
    pub modules: BTreeMap<String, Module>,
    #[serde(flatten)]
    rest: Map<String, Value>,
}

/// A module: ours, or a cell of the library.
#[derive(Debug, Deserialize, Serialize)]
pub struct Module {
    /// Ports by name.
    #[serde(default)]
    pub ports: BTreeMap<String, Port>,
    /// Cells by name.
    #[serde(default)]
    pub cells: BTreeMap<String, Cell>,
    /// Signals by name.
    #[serde(default)]
    pub netnames: BTreeMap<String, Signal>,
    #[serde(flatten)]
    rest: Map<String, Value>,
}

/// A port of a module.
#[derive(Debug, Deserialize, Serialize)]
pub struct Port {
    /// The net of each bit, from the lowest up.
    pub bits: Vec<Bit>,
    #[serde(flatten)]
    rest: Map<String, Value>,
}

/// A signal of a module.
#[derive(Debug, Deserialize, Serialize)]
pub struct Signal {
    /// The net of each bit, from the lowest up.
    pub bits: Vec<Bit>,
    #[serde(flatten)]
    rest: Map<String, Value>,
}

/// A cell.
#[derive(Debug, Deserialize, Serialize)]
pub struct Cell {
    /// Name of a library cell or of a module.
    #[serde(rename = "type")]
    pub kind: String,
    /// The net of each bit of each port, from the lowest up.
    pub connections: BTreeMap<String, Vec<Bit>>,
    #[serde(flatten)]
    rest: Map<String, Value>,
}

/// What a bit is connected to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize, Serialize)]
#[serde(untagged)]
pub enum Bit {
    /// A net of the module.
    Net(u64),
    /// A constant.
    Constant(Level),
}

/// A constant bit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize, Serialize)]
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

/// Whether cells of a kind are flip-flops: Xilinx' `FDRE`, `FDSE` and their like, or ECP5's.
pub fn is_flip_flop(kind: &str) -> bool {
    kind.starts_with("FD") || kind == "TRELLIS_FF"
}

/// Whether a name is one of our signals: not one of Yosys' (`$...`) nor of GHDL's (`n123_q`).
pub fn is_ours(name: &str) -> bool {
    let number = name.strip_prefix('n').is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()));
    !name.contains('$') && !number
}

impl Bit {
    /// The net; none of a constant.
    pub fn net(self) -> Option<u64> {
        match self {
            Self::Net(net) => Some(net),
            Self::Constant(_) => None,
        }
    }
}

impl Port {
    /// Whether it is an input.
    pub fn is_input(&self) -> bool {
        self.rest.get("direction").is_some_and(|direction| direction == "input")
    }
}

impl Module {
    /// Whether it is a cell of the library.
    pub fn is_library(&self) -> bool {
        let attributes = self.rest.get("attributes");
        ["blackbox", "whitebox"].iter().any(|mark| attributes.is_some_and(|all| all.get(mark).is_some()))
    }
}

impl Cell {
    /// The net of the lowest bit of a port.
    pub fn bit(&self, port: &str) -> Option<Bit> {
        self.connections.get(port)?.first().copied()
    }

    /// Whether a port is an output.
    pub fn is_output(&self, port: &str) -> bool {
        let directions = self.rest.get("port_directions");
        directions.and_then(|all| all.get(port)).is_some_and(|direction| direction == "output")
    }

    /// Connects an input of one bit.
    pub fn connect(&mut self, port: &str, bit: Bit) {
        self.connections.insert(port.to_owned(), vec![bit]);
        self.entry("port_directions", port, "input");
    }

    /// A parameter as a word. Yosys writes a word that could be read as bits, such as `1`, with a space behind it.
    pub fn parameter(&self, name: &str) -> Option<&str> {
        let word = self.rest.get("parameters")?.get(name)?.as_str()?;
        Some(word.strip_suffix(' ').filter(|bits| bits.bytes().all(|bit| b"01xz".contains(&bit))).unwrap_or(word))
    }

    /// Sets a parameter to a word that cannot be read as bits.
    pub fn set(&mut self, parameter: &str, value: &str) {
        self.entry("parameters", parameter, value);
    }

    fn entry(&mut self, table: &str, key: &str, value: &str) {
        let table = self.rest.entry(table).or_insert_with(|| Value::Object(Map::new()));
        if let Value::Object(entries) = table {
            entries.insert(key.to_owned(), value.into());
        }
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

    /// Writes a file as Yosys would.
    ///
    /// # Errors
    /// What cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), ToolError> {
        let failed = |e: serde_json::Error| ToolError::failed("netlist", e.to_string());
        let file = std::fs::File::create(path).map_err(ToolError::file(path))?;
        let mut file = BufWriter::new(file);
        serde_json::to_writer(&mut file, self).map_err(failed)?;
        file.flush().map_err(ToolError::file(path))
    }
}
