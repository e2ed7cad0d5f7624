//! The set of generated files, as values: VHDL, testbenches, vectors, projects for tools and boards, and the manifest.
//!
//! [`design_files`] makes the whole set of a design, [`FileSet`] writes or compares it as a whole. Texts are printed by
//! templates from ready values; nothing here decides a number of the design. What has to do with [`files`] of any kind, what
//! [`check`]s a design, and what is [`wrap`]ped around it are rooms of their own.

pub(crate) mod bits;
pub mod check;
mod design_files;
mod dumps;
pub mod files;
mod programmes;
mod units;
pub mod wrap;

pub use check::{Stimulus, stream_vectors, testbench, vectors};
pub use design_files::{DesignFilesError, Packaging, design_files, design_files_with};
pub use dumps::dump_files;
pub use files::{
    Difference, FileSet, FileSetError, Prefix, PrefixError, ReadyDesign, Scratch, VerilogFile, file_lists, interrupted,
    origin, ready_designs, sources, vhdl_files,
};
pub use programmes::programme_files;
pub use wrap::{stream, verilog_files};
