//! Files that a command writes beside its output: there as a whole, or not at all.

use crate::artefact::Scratch;
use crate::cli::error::Failure;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// A file that takes its name when it is finished.
pub(super) struct Output {
    target: PathBuf,
    scratch: Scratch,
    file: BufWriter<File>,
}

/// The name in the scratch folder.
const NAME: &str = "output";

impl Output {
    /// Begins a file; a target that cannot be written is found out here.
    pub fn new(target: &Path) -> Result<Self, Failure> {
        // What a link leads to is written, and nothing but a file is replaced.
        let target = &target.canonicalize().unwrap_or_else(|_| target.to_owned());
        if target.exists() && !target.is_file() {
            let found = if target.is_dir() { "a directory" } else { "something else" };
            let message = format!("{}: found {found}; expected the name of a file", target.display());
            return Err(Failure::Usage(message));
        }
        let folder = target.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let scratch = Scratch::inside(folder).map_err(|e| fault(target, &e))?;
        let file = File::create(scratch.path().join(NAME)).map_err(|e| fault(target, &e))?;
        Ok(Self { target: target.to_owned(), scratch, file: BufWriter::new(file) })
    }

    /// Adds bytes.
    pub fn write(&mut self, bytes: impl AsRef<[u8]>) -> Result<(), Failure> {
        self.file.write_all(bytes.as_ref()).map_err(|e| fault(&self.target, &e))
    }

    /// Puts the file in its place.
    pub fn finish(mut self) -> Result<(), Failure> {
        self.file.flush().map_err(|e| fault(&self.target, &e))?;
        fs::rename(self.scratch.path().join(NAME), &self.target).map_err(|e| fault(&self.target, &e))
    }
}

fn fault(path: &Path, e: &io::Error) -> Failure {
    Failure::Usage(format!("{}: {e}", path.display()))
}

/// A field of a CSV file.
pub(super) fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('"', "\"\""))
}
