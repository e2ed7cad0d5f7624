//! A file of Verilog, which GHDL makes of VHDL files.

/// A Verilog file that is made of VHDL files.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VerilogFile {
    /// Its name.
    pub name: String,
    /// Its top, an entity.
    pub top: String,
    /// VHDL files of the set, in dependency order.
    pub sources: Vec<String>,
    /// An entity of them that is written in Verilog already.
    pub without: Option<String>,
}
