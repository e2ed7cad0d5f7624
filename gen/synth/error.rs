//! Why there is no report of a synthesis.

use crate::design::top::DesignError;
use crate::verilog::VerilogError;
use std::path::Path;

/// Why there is no report.
#[derive(Debug, thiserror::Error)]
pub enum SynthError {
    /// The design cannot be made.
    #[error(transparent)]
    Design(#[from] DesignError),
    /// A name of the design is no legal VHDL.
    #[error("names: {0}")]
    Names(#[from] crate::vhdl::Clash),
    /// There is no Verilog.
    #[error(transparent)]
    Verilog(#[from] VerilogError),
    /// A tool is not installed.
    #[error("{tool} is not installed: {install} (looked in the folder EFSAT_TOOLS, on PATH and in target/tools/bin)")]
    Missing {
        /// Which.
        tool: &'static str,
        /// How to get it.
        install: &'static str,
    },
    /// The folder to keep files in has others.
    #[error(
        "--keep {0}: holds files that efsat did not write; legal is a new or empty folder, or one of an earlier run"
    )]
    Keep(String),
    /// A file cannot be written or read.
    #[error("{path}: {source}")]
    File {
        /// Which.
        path: String,
        /// Why.
        source: std::io::Error,
    },
    /// A tool failed.
    #[error("{tool}: {message}")]
    Failed {
        /// Which.
        tool: String,
        /// The last error it printed.
        message: String,
    },
}

impl SynthError {
    /// Whether the user can mend it on the command line or by installing something (exit status 2).
    pub fn is_usage(&self) -> bool {
        !matches!(
            self,
            SynthError::Failed { .. }
                | SynthError::Names(_)
                | SynthError::Verilog(VerilogError::Refused { .. } | VerilogError::Unusable { .. })
        )
    }
}

pub(super) fn file_error(path: &Path) -> impl Fn(std::io::Error) -> SynthError + '_ {
    move |source| SynthError::File { path: path.display().to_string(), source }
}
