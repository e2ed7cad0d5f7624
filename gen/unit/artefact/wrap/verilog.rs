//! The design in Verilog, for tools that read no VHDL: which file is made of which. Who has GHDL makes them.

use super::board;
use crate::artefact::VerilogFile;
use crate::artefact::files::core::Core;
use crate::artefact::files::file_lists::FileLists;
use crate::artefact::{FileSet, Prefix};
use crate::design::Design;

/// The Verilog files of a set of VHDL files: the unit in its wrapper, and what is around it on a board whose tools read no
/// VHDL. A later file has no module that an earlier one has.
pub fn verilog_files(set: &FileSet, design: &Design, prefix: &Prefix) -> Vec<VerilogFile> {
    verilog_of(set, &Core::UNIT, board::verilog_file(design, prefix), prefix)
}

/// The same of a core, with what is around it on such a board, if there is one.
pub fn verilog_of(set: &FileSet, core: &Core, around: Option<VerilogFile>, prefix: &Prefix) -> Vec<VerilogFile> {
    let list = set.get(FileLists::SYNTHESISED).unwrap_or_default();
    let sources: Vec<String> = list.lines().map(str::to_owned).collect();
    let around = around.map(|around| {
        let sources = sources.iter().cloned().chain(around.sources).collect();
        VerilogFile { sources, ..around }
    });
    let has_registers = set.get(&FileLists::registers(prefix)[2]).is_some();
    let top = prefix.of(if has_registers { FileLists::SHELL } else { core.entity });
    let core = VerilogFile { name: format!("{prefix}{}.v", core.stem), top, sources, without: None };
    [Some(core), around].into_iter().flatten().collect()
}
