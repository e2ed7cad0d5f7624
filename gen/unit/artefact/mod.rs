//! The set of generated files, as values: VHDL, testbenches, vectors, projects for tools and boards, and the manifest.
//!
//! [`design_files`] makes the whole set of a design, [`FileSet`] writes or compares it as a whole. Texts are printed by
//! templates from ready values; nothing here decides a number of the design. What has to do with [`files`] of any kind, what
//! [`check`]s a design, and what is [`wrap`]ped around it are rooms of their own.

pub(crate) mod bits;
// For co-simulation and the testbench.
#[doc(hidden)]
pub mod check;
mod design_files;
mod dumps;
pub mod files;
mod programmes;
mod units;
// For the engine and the checks.
#[doc(hidden)]
pub mod wrap;

// For co-simulation and the testbench.
#[doc(hidden)]
pub use check::{Stimulus, stream_vectors, testbench, vectors};
pub use design_files::{DesignFilesError, Packaging, design_files, design_files_with};
pub use dumps::dump_files;
pub use files::{
    Difference, FileSet, FileSetError, Prefix, PrefixError, ReadyDesign, VerilogFile, ready_designs, vhdl_files,
};
// For the engine, the checks and the program, which tidies up when it is interrupted.
#[doc(hidden)]
pub use files::{Scratch, file_lists, interrupted, origin, sources};
pub use programmes::programme_files;
// For the engine and the checks.
#[doc(hidden)]
pub use wrap::stream;
pub use wrap::verilog_files;
