//! Why a tool did not do its work, and why there is no report of a synthesis.

use efsat_unit::design::top::DesignError;
use std::path::Path;

/// Why a tool did not do its work.
#[derive(Debug, thiserror::Error)]
pub enum ToolError {
    /// It is not installed.
    #[error("{tool} is not installed: {install} (looked in the folder EFSAT_TOOLS, on PATH and in target/tools/bin)")]
    Missing {
        /// Which.
        tool: &'static str,
        /// How to get it.
        install: &'static str,
    },
    /// A file cannot be written or read.
    #[error("{path}: {source}")]
    File {
        /// Which.
        path: String,
        /// Why.
        source: std::io::Error,
    },
    /// It failed, or complains about what it was given.
    #[error("{tool}: {message}")]
    Failed {
        /// Which.
        tool: String,
        /// What it said.
        message: String,
    },
}

impl ToolError {
    /// What it means that a file cannot be written or read.
    pub fn file(path: &Path) -> impl Fn(std::io::Error) -> Self + '_ {
        move |source| Self::File { path: path.display().to_string(), source }
    }

    /// A failure of a tool.
    pub fn failed(tool: &str, message: impl Into<String>) -> Self {
        Self::Failed { tool: tool.to_owned(), message: message.into() }
    }

    /// Whether the user can mend it by installing something or with another folder (exit status 2).
    pub fn is_usage(&self) -> bool {
        !matches!(self, Self::Failed { .. })
    }
}

/// Why there is no report.
#[derive(Debug, thiserror::Error)]
pub enum SynthError {
    /// The design cannot be made.
    #[error(transparent)]
    Design(#[from] DesignError),
    /// A name of the design is no legal VHDL.
    #[error("names: {0}")]
    Names(#[from] efsat_hardware::vhdl::Clash),
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
        "--keep {0}: holds files that efsat did not write; expected a new or empty folder, or one of an earlier run"
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
