//! A set of files as a value: written as a whole or not at all, and compared with what is there.

use super::manifest;
use super::scratch::{Scratch, uninterrupted};
use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::path::{Path, PathBuf};

/// Files by their path relative to a directory, with `/` between the parts.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FileSet(BTreeMap<String, String>);

/// Why a set cannot be written or compared. Each prints as one line.
#[derive(Debug, thiserror::Error)]
pub enum FileSetError {
    /// The target is no directory.
    #[error("{}: found a file; expected a directory, or a name that does not exist yet", .0.display())]
    NotDirectory(PathBuf),
    /// The target holds files and no manifest.
    #[error(
        "{}: found {found} and no manifest.json of efsat; expected a new or empty directory, or one written by efsat",
        dir.display()
    )]
    Occupied {
        /// The directory.
        dir: PathBuf,
        /// One of its files.
        found: String,
    },
    /// A file that is not in the old manifest but in the new set.
    #[error("{}: found {found}, which efsat did not write and would have to replace; move it away", dir.display())]
    Collision {
        /// The directory.
        dir: PathBuf,
        /// The file.
        found: String,
    },
    /// The target is where the process stands: to swap it would leave the caller in a deleted directory.
    #[error("{}: found the current directory or one around it; expected any other directory", .0.display())]
    Current(PathBuf),
    /// The operating system says no.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file or directory.
        path: PathBuf,
        /// What it says.
        source: io::Error,
    },
}

/// A file that is not as it should be.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Difference {
    /// In the set, not in the directory.
    Missing(String),
    /// In both, with different bytes.
    Differs(String),
    /// In the directory, not in the set.
    Extra(String),
}

impl std::fmt::Display for Difference {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Missing(name) => write!(f, "missing {name}"),
            Self::Differs(name) => write!(f, "differs {name}"),
            Self::Extra(name) => write!(f, "extra {name}"),
        }
    }
}

/// Names the path in an error of the operating system.
fn at(path: &Path) -> impl FnOnce(io::Error) -> FileSetError + '_ {
    move |source| FileSetError::Io { path: path.to_owned(), source }
}

impl FileSet {
    /// Adds a file; a text ends with a line feed.
    pub(super) fn insert(&mut self, name: impl Into<String>, text: impl Into<String>) {
        let mut text = text.into();
        if !text.ends_with('\n') {
            text.push('\n');
        }
        self.0.insert(name.into(), text);
    }

    /// Names and texts, by name.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &str)> {
        self.0.iter().map(|(name, text)| (name.as_str(), text.as_str()))
    }

    /// The number of files.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether there is no file.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The text of a file.
    pub fn get(&self, name: &str) -> Option<&str> {
        self.0.get(name).map(String::as_str)
    }

    /// Makes `dir` hold the set. It may be absent, empty or written by efsat before; of the latter, files that a former
    /// manifest names go, and files that efsat did not write stay.
    ///
    /// Everything is written to a directory beside it, which then takes its place; an error or an interruption leaves
    /// the old state.
    ///
    /// # Errors
    /// A target that holds something else, and what the operating system says.
    pub fn write(&self, dir: &Path) -> Result<(), FileSetError> {
        let found = match std::fs::metadata(dir) {
            Ok(found) if !found.is_dir() => return Err(FileSetError::NotDirectory(dir.to_owned())),
            Ok(_) => true,
            Err(e) if e.kind() == io::ErrorKind::NotFound => false,
            Err(e) => return Err(at(dir)(e)),
        };
        let kept = if found { self.foreign(dir)? } else { BTreeSet::new() };
        let target = if found { std::fs::canonicalize(dir) } else { std::path::absolute(dir) }.map_err(at(dir))?;
        if std::env::current_dir().is_ok_and(|here| here.starts_with(&target)) {
            return Err(FileSetError::Current(dir.to_owned()));
        }
        let parent = target.parent().ok_or_else(|| FileSetError::Current(dir.to_owned()))?;
        std::fs::create_dir_all(parent).map_err(at(parent))?;

        let scratch = Scratch::inside(parent).map_err(at(parent))?;
        let (new, old) = (scratch.path().join("new"), scratch.path().join("old"));
        let make_parents = |path: &Path| std::fs::create_dir_all(path.parent().unwrap_or(path)).map_err(at(path));
        for (name, text) in &self.0 {
            let path = new.join(name);
            make_parents(&path)?;
            std::fs::write(&path, text).map_err(at(&path))?;
        }
        for name in &kept {
            let (from, to) = (target.join(name), new.join(name));
            make_parents(&to)?;
            std::fs::hard_link(&from, &to).map_err(at(&from))?;
        }
        uninterrupted(|| {
            if found {
                std::fs::rename(&target, &old).map_err(at(dir))?;
            }
            std::fs::rename(&new, &target).map_err(|e| {
                if found {
                    // The first error is the one to report.
                    let _ = std::fs::rename(&old, &target);
                }
                at(dir)(e)
            })
        })
    }

    /// Compares `dir` with the set.
    ///
    /// # Errors
    /// What the operating system says; a directory that does not exist lacks every file.
    pub fn check(&self, dir: &Path) -> Result<Vec<Difference>, FileSetError> {
        let mut there = BTreeSet::new();
        if !matches!(std::fs::metadata(dir), Err(e) if e.kind() == io::ErrorKind::NotFound) {
            list(dir, "", &mut there)?;
        }
        let mut differences = vec![];
        for (name, text) in &self.0 {
            let path = dir.join(name);
            if !there.remove(name) {
                differences.push(Difference::Missing(name.clone()));
            } else if std::fs::read(&path).map_err(at(&path))? != text.as_bytes() {
                differences.push(Difference::Differs(name.clone()));
            }
        }
        differences.extend(there.into_iter().map(Difference::Extra));
        Ok(differences)
    }

    /// The files of `dir` that efsat did not write, if the rest may be replaced.
    fn foreign(&self, dir: &Path) -> Result<BTreeSet<String>, FileSetError> {
        let mut there = BTreeSet::new();
        list(dir, "", &mut there)?;
        let Some(example) = there.first() else { return Ok(there) };
        let text = std::fs::read_to_string(dir.join(manifest::NAME)).unwrap_or_default();
        let Some(ours) = manifest::files(&text) else {
            return Err(FileSetError::Occupied { dir: dir.to_owned(), found: example.clone() });
        };
        there.remove(manifest::NAME);
        there.retain(|name| !ours.contains(name));
        match there.iter().find(|name| self.0.contains_key(*name)) {
            Some(found) => Err(FileSetError::Collision { dir: dir.to_owned(), found: found.clone() }),
            None => Ok(there),
        }
    }
}

/// Adds the names of all files below `dir`, relative to it, each after `prefix`. Links are not followed.
fn list(dir: &Path, prefix: &str, names: &mut BTreeSet<String>) -> Result<(), FileSetError> {
    for entry in std::fs::read_dir(dir).map_err(at(dir))? {
        let entry = entry.map_err(at(dir))?;
        let name = format!("{prefix}{}", entry.file_name().to_string_lossy());
        if entry.file_type().map_err(at(&entry.path()))?.is_dir() {
            list(&entry.path(), &format!("{name}/"), names)?;
        } else {
            names.insert(name);
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    fn set(files: &[(&str, &str)]) -> FileSet {
        let mut set = FileSet::default();
        let mut names = vec![];
        for (name, text) in files {
            set.insert(*name, *text);
            names.push(format!("\"{name}\": \"\""));
        }
        set.insert(manifest::NAME, format!("{{\"generator\": \"efsat 0\", \"files\": {{{}}}}}", names.join(",")));
        set
    }

    #[test]
    fn written_compared_and_replaced() {
        let home = tempfile::tempdir().unwrap();
        let dir = home.path().join("a/out");
        let first = set(&[("x.vhd", "x"), ("ise/y.prj", "y")]);
        first.write(&dir).unwrap();
        assert_eq!(first.check(&dir).unwrap(), []);
        assert_eq!(fs::read_to_string(dir.join("x.vhd")).unwrap(), "x\n");

        fs::write(dir.join("ise/notes.txt"), "mine").unwrap();
        fs::write(dir.join("x.vhd"), "X\n").unwrap();
        let second = set(&[("x.vhd", "x2"), ("z.vhd", "z")]);
        let names: Vec<String> = second.check(&dir).unwrap().iter().map(ToString::to_string).collect();
        assert_eq!(
            names,
            ["differs manifest.json", "differs x.vhd", "missing z.vhd", "extra ise/notes.txt", "extra ise/y.prj"]
        );
        second.write(&dir).unwrap();
        assert_eq!(second.check(&dir).unwrap(), [Difference::Extra("ise/notes.txt".to_owned())]);
        assert_eq!(fs::read_to_string(dir.join("ise/notes.txt")).unwrap(), "mine");
        assert_eq!(fs::read_dir(home.path().join("a")).unwrap().count(), 1, "nothing is left beside it");
    }

    #[test]
    fn what_others_wrote_is_never_replaced() {
        let home = tempfile::tempdir().unwrap();
        let dir = home.path().join("out");
        let files = set(&[("x.vhd", "x")]);
        fs::create_dir(&dir).unwrap();
        fs::write(dir.join("thesis.tex"), "t").unwrap();
        assert!(files.write(&dir).unwrap_err().to_string().contains("found thesis.tex and no manifest.json of efsat"));
        fs::write(dir.join(manifest::NAME), "{\"name\": \"a web page\"}").unwrap();
        assert!(matches!(files.write(&dir), Err(FileSetError::Occupied { .. })));
        assert_eq!(fs::read_dir(&dir).unwrap().count(), 2);

        fs::write(dir.join(manifest::NAME), set(&[]).get(manifest::NAME).unwrap()).unwrap();
        fs::write(dir.join("x.vhd"), "by hand").unwrap();
        assert!(matches!(files.write(&dir), Err(FileSetError::Collision { .. })));
        assert_eq!(fs::read_to_string(dir.join("x.vhd")).unwrap(), "by hand");

        let file = home.path().join("file");
        fs::write(&file, "").unwrap();
        assert!(matches!(files.write(&file), Err(FileSetError::NotDirectory(_))));
        assert!(matches!(files.write(&file.join("below")), Err(FileSetError::Io { .. })));
    }
}
