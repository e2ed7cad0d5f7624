//! The finished blocks of a run, in a journal. Those of the same test may be concatenated: a block that is there twice counts
//! once.

use super::Block;
use crate::journal::{Form, Journal, JournalError};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;

const FORM: Form = Form { beginning: "{\"question\":", what: "a block of efsat stress --once" };

#[derive(Serialize, Deserialize)]
struct Line {
    question: String,
    block: u64,
    result: Block,
}

/// The log of a test.
pub struct Log {
    journal: Journal,
    question: String,
    blocks: BTreeMap<u64, Block>,
}

impl Log {
    /// Opens a log, or begins one; `fits` knows counts that no block has.
    ///
    /// # Errors
    /// A file that cannot be read or written, that another run writes to, or that holds something else.
    pub fn open(path: &Path, question: String, fits: impl Fn(&Block) -> bool) -> Result<Self, JournalError> {
        let (journal, lines) = Journal::open::<Line>(path, FORM)?;
        let mut blocks = BTreeMap::new();
        for (i, (line, _)) in lines.into_iter().enumerate() {
            if line.question != question {
                let found = format!("a block of another test ({})", line.question);
                return Err(JournalError::Line { path: path.to_owned(), line: i + 1, found, expected: question });
            }
            if !fits(&line.result) {
                return Err(FORM.wrong(path, i + 1, "counts that no block of this test has"));
            }
            blocks.insert(line.block, line.result);
        }
        Ok(Self { journal, question, blocks })
    }

    /// Finished blocks by number.
    pub fn blocks(&self) -> &BTreeMap<u64, Block> {
        &self.blocks
    }

    /// Adds a finished block, for good.
    ///
    /// # Errors
    /// What the operating system says.
    pub fn add(&mut self, block: u64, result: Block) -> Result<(), JournalError> {
        let line = Line { question: self.question.clone(), block, result };
        self.journal.add(&line)?;
        self.blocks.insert(block, line.result);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::super::Tally;
    use super::*;
    use efsat_unit::host::Truths;

    fn block(separate: u64) -> Block {
        let truths = Truths { separate, ..Truths::default() };
        Block { families: vec![Tally { truths, ..Tally::default() }], faults: vec![] }
    }

    #[test]
    fn what_is_finished_is_there_again() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("log");
        let open = || Log::open(&path, "q".to_owned(), |_| true).unwrap();
        let mut log = open();
        log.add(7, block(1)).unwrap();
        log.add(9, block(2)).unwrap();
        assert_eq!(log.blocks()[&9], block(2));
        drop(log);
        assert_eq!(
            open().blocks().iter().map(|(number, block)| (*number, block.clone())).collect::<Vec<_>>(),
            [(7, block(1)), (9, block(2))]
        );
    }

    #[test]
    fn what_does_not_belong_is_refused() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("log");
        let fits = |block: &Block| block.total().truths.separate < 5;
        let open = |question: &str| Log::open(&path, question.to_owned(), fits).map(drop).map_err(|e| e.to_string());
        Log::open(&path, "q".to_owned(), fits).unwrap().add(0, block(1)).unwrap();
        let message = open("other").unwrap_err();
        assert!(message.ends_with("line 1: found a block of another test (q); expected other"), "{message}");
        Log::open(&path, "q".to_owned(), fits).unwrap().add(1, block(5)).unwrap();
        let message = open("q").unwrap_err();
        assert!(message.contains("line 2: found counts that no block of this test has"), "{message}");
        std::fs::write(&path, "{}\n").unwrap();
        let message = open("q").unwrap_err();
        assert!(message.contains("line 1: found missing field `question`"), "{message}");
    }
}
