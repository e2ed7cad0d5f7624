//! The engine in Verilog.

use super::EngineDesign;
use super::files::core_of;
use crate::params::Memory;
use efsat_unit::artefact::{FileSet, Prefix, VerilogFile};
use efsat_unit::parts::{board, verilog_of};

/// As [`verilog_files`](efsat_unit::artefact::verilog_files), of an engine. It is on a board only with its trees in block RAM.
pub fn engine_verilog_files(set: &FileSet, design: &EngineDesign, prefix: &Prefix) -> Vec<VerilogFile> {
    let on_board = design.params.memory == Memory::BlockRam;
    verilog_of(set, core_of(design), on_board.then(|| board::verilog_file(&design.unit, prefix)).flatten(), prefix)
}
