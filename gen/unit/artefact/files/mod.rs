//! Files of any kind: sets that are written or compared as a whole, names, lists, the manifest.

pub(crate) mod core;
// For the engine, which has the same lists.
#[doc(hidden)]
pub mod file_lists;
mod file_set;
pub(crate) mod manifest;
mod prefix;
pub(crate) mod project;
mod ready;
mod scratch;
// For the engine.
#[doc(hidden)]
pub mod sources;
mod verilog_file;

pub use file_set::{Difference, FileSet, FileSetError};
pub use prefix::{Prefix, PrefixError};
pub use ready::{ReadyDesign, ready_designs};
// For the program, which tidies up when it is interrupted.
#[doc(hidden)]
pub use scratch::{Scratch, interrupted};
pub use sources::{origin, vhdl_files};
pub use verilog_file::VerilogFile;
