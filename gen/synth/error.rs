//! Why there is no report of a synthesis.

use crate::design::top::DesignError;
use crate::verilog::ToolError;

/// Why there is no report.
#[derive(Debug, thiserror::Error)]
pub enum SynthError {
    /// The design cannot be made.
    #[error(transparent)]
    Design(#[from] DesignError),
    /// A name of the design is no legal VHDL.
    #[error("names: {0}")]
    Names(#[from] crate::vhdl::Clash),
    /// A tool did not do its work.
    #[error(transparent)]
    Tool(#[from] ToolError),
    /// There is nothing to place: the part is too small.
    #[error("{used} {kind} do not fit on {part}, which has {there}; --no-route counts without placing")]
    Part {
        /// The part.
        part: &'static str,
        /// Kind of cell.
        kind: &'static str,
        /// How many are needed.
        used: u64,
        /// How many there are.
        there: u64,
    },
    /// The folder to keep files in has others.
    #[error(
        "--keep {0}: holds files that efsat did not write; legal is a new or empty folder, or one of an earlier run"
    )]
    Keep(String),
}

impl SynthError {
    /// Whether the user can mend it on the command line or by installing something (exit status 2).
    pub fn is_usage(&self) -> bool {
        match self {
            SynthError::Names(_) => false,
            SynthError::Tool(e) => e.is_usage(),
            SynthError::Design(_) | SynthError::Keep(_) | SynthError::Part { .. } => true,
        }
    }
}
