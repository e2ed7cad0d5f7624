//! What can be wrong with a mesh file.

use std::path::{Path, PathBuf};

/// A mesh file that cannot be used: where, what was found, what was expected. It prints as one line.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{}:{} {found}: {legal}", file.display(), line.map(|n| format!("{n}:")).unwrap_or_default())]
pub struct MeshError {
    /// The file.
    pub file: PathBuf,
    /// The line, counted from 1, of a text file, where one line is to blame.
    pub line: Option<usize>,
    /// What was found.
    pub found: String,
    /// What was expected, in words.
    pub legal: &'static str,
}

/// A [`MeshError`] before the file is known: parsers see bytes, not files.
#[derive(Debug, Clone)]
pub(super) struct Fault {
    line: Option<usize>,
    found: String,
    legal: &'static str,
}

impl Fault {
    /// The longest quotation of a file's content in a message, in characters.
    const QUOTE: usize = 160;

    /// A fault of the file as a whole.
    pub(super) fn new(found: impl Into<String>, legal: &'static str) -> Self {
        let found: String = found.into();
        // Control characters of a garbled file must not reach a terminal, nor break the one line.
        let printable = |c: char| if c.is_control() { char::REPLACEMENT_CHARACTER } else { c };
        let mut shown: String = found.chars().take(Self::QUOTE).map(printable).collect();
        if found.chars().nth(Self::QUOTE).is_some() {
            shown.push_str("...");
        }
        Self { line: None, found: shown, legal }
    }

    /// The same, at a line.
    pub(super) fn at(self, line: usize) -> Self {
        Self { line: Some(line), ..self }
    }

    /// Where and what, without what is legal.
    pub(super) fn brief(&self) -> String {
        self.line.map(|line| format!("line {line}: ")).unwrap_or_default() + &self.found
    }

    /// The error, now that the file is known.
    pub(super) fn of(self, file: &Path) -> MeshError {
        MeshError { file: file.to_owned(), line: self.line, found: self.found, legal: self.legal }
    }
}
