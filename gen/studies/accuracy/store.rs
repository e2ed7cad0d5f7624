//! Finished results, a line of JSON each: only ever appended to, so that whatever ends a run, what was finished stays.
//!
//! A line that a crash cut off has no line feed; it is cut away when the file is opened next. Every line has the key of
//! what it is the result of: digest of scene and pairs, parameters, version. Equal keys are equal questions.

use super::Truths;
use super::causes::Causes;
use super::floor::Floor;
use super::hardware::Cells;
use super::ladder::Ladder;
use super::pairs::hex;
use super::point::{Options, Point};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::collections::HashMap;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

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
    pub truths: Truths,
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

/// What is wrong with a folder of results. Each prints as one line.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    /// The operating system says no.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file or folder.
        path: PathBuf,
        /// What it says.
        source: io::Error,
    },
    /// Another process has the results open.
    #[error("{}: found another run that writes it; expected one at a time", .0.display())]
    Busy(PathBuf),
    /// A line that is no result of this version.
    #[error("{}, line {line}: found {found}; expected a result that efsat {} wrote", path.display(), env!("CARGO_PKG_VERSION"))]
    Line {
        /// The file.
        path: PathBuf,
        /// Its number, from 1.
        line: usize,
        /// What is wrong with it.
        found: String,
    },
}

/// Names a path in an error of the operating system.
pub(super) fn at(path: &Path) -> impl FnOnce(io::Error) -> StoreError + '_ {
    move |source| StoreError::Io { path: path.to_owned(), source }
}

/// The key of a result: what kind, of what, with which options.
pub fn key(kind: &str, of: &str, options: &Options) -> String {
    let mut hash = Sha256::new();
    hash.update(format!("{}\n{kind}\n{of}\n", env!("CARGO_PKG_VERSION")));
    options.iter().for_each(|(name, value)| hash.update(format!("{name}={value}\n")));
    hex(hash)
}

/// The results of a folder. Nobody else opens them as long as this is there.
pub struct Store {
    path: PathBuf,
    file: File,
    records: HashMap<String, Record>,
    lines: Vec<(String, String)>,
}

impl Store {
    /// Opens the results of a folder, or begins them; the folder must be there.
    ///
    /// # Errors
    /// A file that cannot be read or written, that another process has open, or that holds something else.
    pub fn open(dir: &Path) -> Result<Self, StoreError> {
        let path = dir.join(FILE);
        let mut file = OpenOptions::new().create(true).read(true).append(true).open(&path).map_err(at(&path))?;
        match file.try_lock() {
            Err(TryLockError::WouldBlock) => return Err(StoreError::Busy(path)),
            // Not every file system has locks.
            Err(TryLockError::Error(e)) if e.kind() != io::ErrorKind::Unsupported => return Err(at(&path)(e)),
            _ => {}
        }
        let mut bytes = vec![];
        file.read_to_end(&mut bytes).map_err(at(&path))?;
        let whole = whole(&bytes);
        let lines = read(&path, whole)?;
        file.set_len(whole.len() as u64).map_err(at(&path))?;
        let mut store = Self { path, file, records: HashMap::new(), lines: vec![] };
        lines.into_iter().for_each(|(line, text)| store.know(line, text));
        Ok(store)
    }

    fn know(&mut self, line: Line, text: String) {
        if !self.records.contains_key(&line.key) {
            self.lines.push((line.key.clone(), text));
            self.records.insert(line.key, line.result);
        }
    }

    /// A finished result.
    pub fn get(&self, key: &str) -> Option<&Record> {
        self.records.get(key)
    }

    /// All finished results, in no order.
    pub fn records(&self) -> impl Iterator<Item = &Record> {
        self.records.values()
    }

    /// Adds a finished result, for good.
    ///
    /// # Errors
    /// What the operating system says.
    pub fn add(&mut self, key: &str, result: Record) -> Result<(), StoreError> {
        let line = Line { key: key.to_owned(), result };
        let text = serde_json::to_string(&line).expect("keys are strings and numbers are finite");
        self.append(text)
    }

    /// Adds a line, and what it says as it will be read again.
    fn append(&mut self, text: String) -> Result<(), StoreError> {
        // One write, so that a crash leaves a whole line or one without an end.
        self.file.write_all(format!("{text}\n").as_bytes()).and_then(|()| self.file.flush()).map_err(at(&self.path))?;
        let line = serde_json::from_str(&text).expect("it was a line a moment ago");
        self.know(line, text);
        Ok(())
    }

    /// Adds all results of another folder that this one does not have; their lines stay as they are.
    ///
    /// # Errors
    /// A file that cannot be read, or that holds something else.
    pub fn join(&mut self, dir: &Path) -> Result<(), StoreError> {
        let path = dir.join(FILE);
        let bytes = std::fs::read(&path).map_err(at(&path))?;
        for (line, text) in read(&path, whole(&bytes))? {
            if !self.records.contains_key(&line.key) {
                self.append(text)?;
            }
        }
        Ok(())
    }
}

/// The lines that are whole. One that a crash cut off may end inside a letter.
fn whole(bytes: &[u8]) -> &[u8] {
    &bytes[..bytes.iter().rposition(|&byte| byte == b'\n').map_or(0, |end| end + 1)]
}

fn read(path: &Path, text: &[u8]) -> Result<Vec<(Line, String)>, StoreError> {
    let parse = |(i, line): (usize, &[u8])| match serde_json::from_slice(line) {
        Ok(parsed) => Ok((parsed, String::from_utf8_lossy(line).trim_end().to_owned())),
        Err(e) => Err(StoreError::Line { path: path.to_owned(), line: i + 1, found: e.to_string() }),
    };
    text.split_inclusive(|&byte| byte == b'\n').enumerate().map(parse).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(pairs: u64) -> Record {
        Record::Drawn(Drawn { candidates: 9, pairs, truths: Truths::default() })
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
    fn one_run_at_a_time() {
        let dir = tempfile::tempdir().unwrap();
        let first = Store::open(dir.path()).unwrap();
        let message = Store::open(dir.path()).err().unwrap().to_string();
        assert!(
            message.ends_with("points.jsonl: found another run that writes it; expected one at a time"),
            "{message}"
        );
        drop(first);
        Store::open(dir.path()).unwrap();
    }

    #[test]
    fn a_line_cut_off_inside_a_letter_is_forgotten() {
        let dir = tempfile::tempdir().unwrap();
        Store::open(dir.path()).unwrap().add("a", drawn(1)).unwrap();
        let path = dir.path().join(FILE);
        let text = [&std::fs::read(&path).unwrap()[..], b"{\"key\":\"\xc3"].concat();
        std::fs::write(&path, text).unwrap();
        assert_eq!(Store::open(dir.path()).unwrap().get("a"), Some(&drawn(1)));
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
