//! Finished blocks, a line of JSON each. A line that a crash cut off has no line feed and is cut away when the file is opened
//! next. Logs of the same test may be concatenated: a block that is there twice counts once.

use super::Block;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// How every line begins.
const BEGINNING: &str = "{\"question\":";

#[derive(Serialize, Deserialize)]
struct Line {
    question: String,
    block: u64,
    result: Block,
}

/// What is wrong with a log. Each prints as one line.
#[derive(Debug, thiserror::Error)]
pub enum LogError {
    /// The operating system says no.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What it says.
        source: io::Error,
    },
    /// Another program has the file open.
    #[error("{}: another run writes to it; expected a file of this run's own", .0.display())]
    Busy(PathBuf),
    /// A line that is no block.
    #[error("{}, line {line}: found {found}; expected a block of efsat soak", path.display())]
    Line {
        /// The file.
        path: PathBuf,
        /// Its number, from 1.
        line: usize,
        /// What is wrong with it.
        found: String,
    },
    /// A line of another test.
    #[error("{}, line {line}: found a block of another test ({found}); expected {expected}", path.display())]
    Other {
        /// The file.
        path: PathBuf,
        /// Its number, from 1.
        line: usize,
        /// What it asks.
        found: String,
        /// What this test asks.
        expected: String,
    },
}

/// The log of a test.
pub struct Log {
    path: PathBuf,
    file: File,
    question: String,
    blocks: BTreeMap<u64, Block>,
}

impl Log {
    /// Opens a log, or begins one; `fits` knows counts that no block has.
    ///
    /// # Errors
    /// A file that cannot be read or written, that another run writes to, or that holds something else.
    pub fn open(path: &Path, question: String, fits: impl Fn(&Block) -> bool) -> Result<Self, LogError> {
        let at = |source| LogError::Io { path: path.to_owned(), source };
        let mut file = OpenOptions::new().create(true).truncate(false).read(true).write(true).open(path).map_err(at)?;
        file.try_lock().map_err(|e| match e {
            TryLockError::WouldBlock => LogError::Busy(path.to_owned()),
            TryLockError::Error(source) => at(source),
        })?;
        let mut text = String::new();
        file.read_to_string(&mut text).map_err(at)?;
        let whole = text.rfind('\n').map_or(0, |end| end + 1);
        let mut blocks = BTreeMap::new();
        for (i, line) in text[..whole].lines().enumerate() {
            let (path, line_number) = (path.to_owned(), i + 1);
            let line: Line = serde_json::from_str(line).map_err(|e| LogError::Line {
                path: path.clone(),
                line: line_number,
                found: e.to_string(),
            })?;
            if line.question != question {
                return Err(LogError::Other { path, line: line_number, found: line.question, expected: question });
            }
            if !fits(&line.result) {
                let found = "counts that no block of this test has".to_owned();
                return Err(LogError::Line { path, line: line_number, found });
            }
            blocks.insert(line.block, line.result);
        }
        // Only what is the beginning of a line of ours is cut away.
        let rest = &text[whole..];
        if !(rest.starts_with(BEGINNING) || BEGINNING.starts_with(rest)) {
            let found = "something else than JSON".to_owned();
            return Err(LogError::Line { path: path.to_owned(), line: text[..whole].lines().count() + 1, found });
        }
        file.set_len(whole as u64).and_then(|()| file.seek(SeekFrom::End(0))).map_err(at)?;
        Ok(Self { path: path.to_owned(), file, question, blocks })
    }

    /// Finished blocks by number.
    pub fn blocks(&self) -> &BTreeMap<u64, Block> {
        &self.blocks
    }

    /// Adds a finished block, for good.
    ///
    /// # Errors
    /// What the operating system says.
    pub fn add(&mut self, block: u64, result: Block) -> Result<(), LogError> {
        let line = Line { question: self.question.clone(), block, result };
        let text = serde_json::to_string(&line).expect("keys are strings");
        // One write, so that a crash leaves a whole line or one without an end.
        let written = self.file.write_all(format!("{text}\n").as_bytes());
        written.map_err(|source| LogError::Io { path: self.path.clone(), source })?;
        self.blocks.insert(block, line.result);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::soak::Tally;

    fn block(separate: u64) -> Block {
        Block { families: vec![Tally { separate, ..Tally::default() }], faults: vec![] }
    }

    #[test]
    fn what_is_finished_stays() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("log");
        let open = || Log::open(&path, "q".to_owned(), |_| true);
        let mut log = open().unwrap();
        assert!(matches!(open(), Err(LogError::Busy(_))));
        log.add(7, block(1)).unwrap();
        log.add(9, block(2)).unwrap();
        drop(log);
        let text = std::fs::read_to_string(&path).unwrap();
        std::fs::write(&path, &text[..text.len() - 5]).unwrap();
        let mut log = open().unwrap();
        assert_eq!(log.blocks().keys().copied().collect::<Vec<_>>(), [7]);
        log.add(9, block(3)).unwrap();
        drop(log);
        assert_eq!(open().unwrap().blocks()[&9], block(3));
    }

    #[test]
    fn what_does_not_belong_is_refused() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("log");
        let fits = |block: &Block| block.total().separate < 5;
        let open = |question: &str| Log::open(&path, question.to_owned(), fits).map(drop).map_err(|e| e.to_string());
        open("q").unwrap();
        Log::open(&path, "q".to_owned(), fits).unwrap().add(0, block(1)).unwrap();
        let message = open("other").unwrap_err();
        assert!(message.ends_with("line 1: found a block of another test (q); expected other"), "{message}");
        Log::open(&path, "q".to_owned(), fits).unwrap().add(1, block(5)).unwrap();
        let message = open("q").unwrap_err();
        assert!(message.contains("line 2: found counts that no block of this test has"), "{message}");
        std::fs::write(&path, "{}\n").unwrap();
        let message = open("q").unwrap_err();
        assert!(message.contains("line 1: found missing field `question`"), "{message}");
        std::fs::write(&path, "mine").unwrap();
        assert!(open("q").unwrap_err().contains("line 1: found something else"));
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "mine");
        let message = Log::open(dir.path(), "q".to_owned(), fits).map(drop).unwrap_err().to_string();
        assert!(message.contains("irectory"), "{message}");
    }
}
