//! What goes wrong with tools.

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
