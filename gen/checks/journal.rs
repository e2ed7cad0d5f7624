//! Finished results, a line of JSON each: only ever appended to, so that whatever ends a run, what was finished stays.
//!
//! A line that a crash cut off has no line feed; it is cut away when the file is opened next. Files may be concatenated.

use serde::Serialize;
use serde::de::{DeserializeOwned, IgnoredAny};
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

/// What is wrong with a journal. Each prints as one line.
#[derive(Debug, thiserror::Error)]
pub enum JournalError {
    /// The operating system says no.
    #[error("{}: {source}; expected a file in an existing folder that can be read and written", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What it says.
        source: io::Error,
    },
    /// Another process has the file open.
    #[error("{}: found another run that writes it; expected one at a time", .0.display())]
    Busy(PathBuf),
    /// A line that is no result.
    #[error("{}, line {line}: found {found}; expected {expected}", path.display())]
    Line {
        /// The file.
        path: PathBuf,
        /// Its number, from 1.
        line: usize,
        /// What is wrong with it.
        found: String,
        /// What a line is.
        expected: String,
    },
}

/// How the lines of a journal look.
#[derive(Clone, Copy, Debug)]
pub struct Form {
    /// How each begins: the name of the first field.
    pub beginning: &'static str,
    /// What each is, in words.
    pub what: &'static str,
}

impl Form {
    /// The whole lines of a file, as read and as they stand there.
    ///
    /// # Errors
    /// A line that is none of this form, also one that is cut off.
    pub fn read<L: DeserializeOwned>(self, path: &Path) -> Result<Vec<(L, String)>, JournalError> {
        let bytes = std::fs::read(path).map_err(at(path))?;
        self.parse(path, &bytes).map(|(lines, _)| lines)
    }

    /// A complaint about a line.
    pub fn wrong(self, path: &Path, line: usize, found: impl Into<String>) -> JournalError {
        JournalError::Line { path: path.to_owned(), line, found: found.into(), expected: self.what.to_owned() }
    }

    /// The whole lines, and how many bytes they have.
    fn parse<L: DeserializeOwned>(self, path: &Path, bytes: &[u8]) -> Result<(Vec<(L, String)>, usize), JournalError> {
        let (whole, rest) = bytes.split_at(bytes.iter().rposition(|&byte| byte == b'\n').map_or(0, |end| end + 1));
        let line = |(i, line): (usize, &[u8])| match serde_json::from_slice(line) {
            Ok(parsed) => Ok((parsed, String::from_utf8_lossy(line).trim_end().to_owned())),
            Err(e) => Err(self.wrong(path, i + 1, e.to_string())),
        };
        let mut lines: Vec<(L, String)> =
            whole.split_inclusive(|&byte| byte == b'\n').enumerate().map(line).collect::<Result<_, _>>()?;
        // Only what is the beginning of a line of ours is cut away; a whole object is none.
        let beginning = self.beginning.as_bytes();
        if serde_json::from_slice::<IgnoredAny>(rest).is_ok() {
            lines.push(line((lines.len(), rest))?);
            return Ok((lines, bytes.len()));
        }
        if rest.starts_with(beginning) || beginning.starts_with(rest) {
            return Ok((lines, whole.len()));
        }
        Err(self.wrong(path, lines.len() + 1, "something else than JSON"))
    }
}

/// Names a file in an error of the operating system.
fn at(path: &Path) -> impl FnOnce(io::Error) -> JournalError + '_ {
    move |source| JournalError::Io { path: path.to_owned(), source }
}

/// A journal that nobody else has open as long as this is there.
#[derive(Debug)]
pub struct Journal {
    path: PathBuf,
    file: File,
}

impl Journal {
    /// Opens a journal, or begins one; also gives its lines, as read and as they stand there.
    ///
    /// # Errors
    /// A file that cannot be read or written, that another process has open, or that holds something else.
    pub fn open<L: DeserializeOwned>(path: &Path, form: Form) -> Result<(Self, Vec<(L, String)>), JournalError> {
        // A device has no end, and a pipe nothing to read.
        if path.metadata().is_ok_and(|found| !found.is_file() && !found.is_dir()) {
            let no_file = io::Error::new(io::ErrorKind::InvalidInput, "found a device or a pipe; expected a file");
            return Err(at(path)(no_file));
        }
        let mut file = OpenOptions::new().create(true).read(true).append(true).open(path).map_err(at(path))?;
        match file.try_lock() {
            Err(TryLockError::WouldBlock) => return Err(JournalError::Busy(path.to_owned())),
            // Not every file system has locks.
            Err(TryLockError::Error(e)) if e.kind() != io::ErrorKind::Unsupported => return Err(at(path)(e)),
            _ => {}
        }
        let mut bytes = vec![];
        file.read_to_end(&mut bytes).map_err(at(path))?;
        let (lines, whole) = form.parse(path, &bytes)?;
        file.set_len(whole as u64).map_err(at(path))?;
        if bytes[..whole].last().is_some_and(|&byte| byte != b'\n') {
            file.write_all(b"\n").map_err(at(path))?;
        }
        Ok((Self { path: path.to_owned(), file }, lines))
    }

    /// Adds a line, for good; also gives it as it stands there.
    ///
    /// # Errors
    /// What the operating system says.
    pub fn add(&mut self, line: &impl Serialize) -> Result<String, JournalError> {
        let text = serde_json::to_string(line).expect("keys are strings and numbers are finite");
        self.append(&text)?;
        Ok(text)
    }

    /// Adds a line that stands in another journal.
    ///
    /// # Errors
    /// What the operating system says.
    pub fn append(&mut self, text: &str) -> Result<(), JournalError> {
        // One write, so that a crash leaves a whole line or one without an end.
        self.file.write_all(format!("{text}\n").as_bytes()).and_then(|()| self.file.flush()).map_err(at(&self.path))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FORM: Form = Form { beginning: "[\"", what: "a word in brackets" };

    fn words(path: &Path) -> Vec<String> {
        let (_, lines) = Journal::open::<[String; 1]>(path, FORM).unwrap();
        lines.into_iter().map(|([word], _)| word).collect()
    }

    #[test]
    fn what_is_finished_stays_and_what_is_cut_off_goes() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("journal");
        let (mut journal, _) = Journal::open::<[String; 1]>(&path, FORM).unwrap();
        let message = Journal::open::<[String; 1]>(&path, FORM).unwrap_err().to_string();
        assert!(message.ends_with("journal: found another run that writes it; expected one at a time"), "{message}");
        journal.add(&["one"]).unwrap();
        journal.add(&["two"]).unwrap();
        drop(journal);
        let text = std::fs::read(&path).unwrap();
        // Within a line, within its beginning, within a letter.
        for tail in [&b"[\"thr"[..], b"[", b"[\"\xc3"] {
            std::fs::write(&path, [&text, tail].concat()).unwrap();
            assert_eq!(FORM.read::<[String; 1]>(&path).unwrap().len(), 2);
            assert_eq!(words(&path), ["one", "two"]);
            assert_eq!(std::fs::read(&path).unwrap(), text);
        }
        // A line without its end is one.
        std::fs::write(&path, &text[..text.len() - 1]).unwrap();
        assert_eq!(words(&path), ["one", "two"]);
        assert_eq!(std::fs::read(&path).unwrap(), text);
    }

    #[test]
    fn what_does_not_belong_is_named_and_stays() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("journal");
        let wrong = [
            ("mine", "line 1: found something else than JSON; expected a word in brackets"),
            ("[1]\n", "line 1: found "),
            // A whole object is not cut off, whatever it begins with.
            ("[\"one\"]\n[\"two\", 2]", "line 2: found "),
        ];
        for (text, expected) in wrong {
            std::fs::write(&path, text).unwrap();
            let message = Journal::open::<[String; 1]>(&path, FORM).unwrap_err().to_string();
            assert!(message.contains(expected), "{message}");
            assert_eq!(std::fs::read_to_string(&path).unwrap(), text);
        }
        for path in [dir.path(), Path::new("/dev/null")] {
            assert!(matches!(Journal::open::<[String; 1]>(path, FORM), Err(JournalError::Io { .. })), "{path:?}");
        }
    }
}
