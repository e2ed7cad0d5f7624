//! The set of generated files, as values: VHDL, testbenches, vectors, projects for tools and boards, and the manifest.
//!
//! [`design_files`] makes the whole set of a design, [`FileSet`] writes or compares it as a whole. Texts are printed by
//! templates from ready values; nothing here decides a number of the design.

pub(crate) mod bits;
pub(crate) mod board;
mod design_files;
mod drop_in;
mod dumps;
pub(crate) mod example;
pub mod file_lists;
mod file_set;
mod ise;
pub(crate) mod layout;
pub(crate) mod manifest;
mod prefix;
mod programmes;
pub(crate) mod project;
mod ready;
mod scratch;
pub mod sources;
mod stimulus;
pub mod stream;
pub mod stream_vectors;
pub mod testbench;
mod units;
pub mod vectors;
pub(crate) mod verilog;
mod verilog_file;
mod vivado;

pub use design_files::{DesignFilesError, Packaging, design_files, design_files_with};
pub use dumps::dump_files;
pub use file_set::{Difference, FileSet, FileSetError};
pub use prefix::{Prefix, PrefixError};
pub use programmes::programme_files;
pub use ready::{ReadyDesign, ready_designs};
pub use scratch::{Scratch, interrupted};
pub use sources::{origin, vhdl_files};
pub use vectors::Stimulus;
pub use verilog::verilog_files;
pub use verilog_file::VerilogFile;
