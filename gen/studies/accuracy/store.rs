//! Finished results, in a journal. Every line has the key of what it is the result of: digest of scene and pairs, parameters,
//! version. Equal keys are equal questions.

use super::causes::Causes;
use super::floor::Floor;
use super::hardware::Cells;
use super::ladder::Ladder;
use super::pairs::hex;
use super::point::{Options, Point};
use efsat_checks::journal::{Form, Journal, JournalError};
use efsat_unit::host::Relations;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::collections::HashMap;
use std::path::Path;

/// The file of a folder of results.
pub const FILE: &str = "points.jsonl";

/// The pairs of a campaign.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Drawn {
    /// Candidate pairs of the scene.
    pub candidates: u64,
    /// Those that were asked.
    pub pairs: u64,
    /// Their exact answers.
    pub truths: Relations,
}

/// A result.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Record {
    /// The pairs.
    Drawn(Drawn),
    /// A point of the sweep.
    Point(Box<Point>),
    /// Cells of a point as mapped by a tool.
    Synthesis(Cells),
    /// The software ladder.
    Ladder(Ladder),
    /// Where possibly incorrect answers come from.
    Causes(Causes),
    /// What no width decides.
    Floor(Box<Floor>),
}

#[derive(Serialize, Deserialize)]
struct Line {
    key: String,
    result: Record,
}

const FORM: Form =
    Form { beginning: "{\"key\":", what: concat!("a result that efsat ", env!("CARGO_PKG_VERSION"), " wrote") };

/// The key of a result: what kind, of what, with which options.
pub fn key(kind: &str, of: &str, options: &Options) -> String {
    let mut hash = Sha256::new();
    hash.update(format!("{}\n{kind}\n{of}\n", env!("CARGO_PKG_VERSION")));
    options.iter().for_each(|(name, value)| hash.update(format!("{name}={value}\n")));
    hex(hash)
}

/// The results of a folder. Nobody else opens them as long as this is there.
pub struct Store {
    journal: Journal,
    records: HashMap<String, Record>,
}

impl Store {
    /// Opens the results of a folder, or begins them; the folder must be there.
    ///
    /// # Errors
    /// A file that cannot be read or written, that another process has open, or that holds something else.
    pub fn open(dir: &Path) -> Result<Self, JournalError> {
        let (journal, lines) = Journal::open(&dir.join(FILE), FORM)?;
        let mut store = Self { journal, records: HashMap::new() };
        lines.into_iter().for_each(|(line, _)| store.know(line));
        Ok(store)
    }

    fn know(&mut self, line: Line) {
        self.records.entry(line.key).or_insert(line.result);
    }

    /// A finished result.
    pub fn get(&self, key: &str) -> Option<&Record> {
        self.records.get(key)
    }

    /// All finished results, in no order.
    pub fn records(&self) -> impl Iterator<Item = &Record> {
        self.records.values()
    }

    /// Adds a finished result, for good. It is known as it will be read again.
    ///
    /// # Errors
    /// What the operating system says.
    pub fn add(&mut self, key: &str, result: Record) -> Result<(), JournalError> {
        let text = self.journal.add(&Line { key: key.to_owned(), result })?;
        self.know(serde_json::from_str(&text).expect("it was a line a moment ago"));
        Ok(())
    }

    /// Adds all results of another folder that this one does not have; their lines stay as they are.
    ///
    /// # Errors
    /// A file that cannot be read, or that holds something else.
    pub fn join(&mut self, dir: &Path) -> Result<(), JournalError> {
        for (line, text) in FORM.read::<Line>(&dir.join(FILE))? {
            if !self.records.contains_key(&line.key) {
                self.journal.append(&text)?;
                self.know(line);
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(pairs: u64) -> Record {
        Record::Drawn(Drawn { candidates: 9, pairs, truths: Relations::default() })
    }

    #[test]
    fn a_line_cut_off_is_forgotten_and_the_others_stay() {
        let dir = tempfile::tempdir().unwrap();
        let mut store = Store::open(dir.path()).unwrap();
        store.add("a", drawn(1)).unwrap();
        store.add("b", drawn(2)).unwrap();
        drop(store);
        let path = dir.path().join(FILE);
        let text = std::fs::read_to_string(&path).unwrap();
        std::fs::write(&path, &text[..text.len() - 5]).unwrap();
        let mut store = Store::open(dir.path()).unwrap();
        assert_eq!((store.get("a"), store.get("b")), (Some(&drawn(1)), None));
        store.add("c", drawn(3)).unwrap();
        drop(store);
        let store = Store::open(dir.path()).unwrap();
        assert_eq!((store.get("a"), store.get("b"), store.get("c")), (Some(&drawn(1)), None, Some(&drawn(3))));
    }

    #[test]
    fn a_strange_line_is_named() {
        let dir = tempfile::tempdir().unwrap();
        std::fs::write(dir.path().join(FILE), "{\"key\":\"a\"}\n").unwrap();
        let message = Store::open(dir.path()).err().unwrap().to_string();
        assert!(message.contains("points.jsonl, line 1: found missing field `result`"), "{message}");
    }

    #[test]
    fn keys_tell_options_apart() {
        let with = |name: &str, value: &str| Options::from([(name.to_owned(), value.to_owned())]);
        let keys = [
            key("a", "x", &with("n", "1")),
            key("a", "x", &with("n", "2")),
            key("b", "x", &with("n", "1")),
            key("a", "y", &with("n", "1")),
        ];
        assert!((0..4).all(|i| (0..i).all(|j| keys[i] != keys[j])));
    }
}
