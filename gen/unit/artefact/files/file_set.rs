//! A set of files as a value: written as a whole or not at all, and compared with what is there.

use super::manifest;
use super::scratch::{Scratch, uninterrupted};
use std::collections::{BTreeMap, BTreeSet};
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};

/// Files by their path relative to a directory, with `/` between the parts.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FileSet(BTreeMap<String, String>);

/// Why a set cannot be written or compared. Each prints as one line.
#[derive(Debug, thiserror::Error)]
pub enum FileSetError {
    /// The target is no directory.
    #[error("{}: found no directory; expected one, or a name that does not exist yet", .0.display())]
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
    #[error("{}: {source}; expected files and directories that can be read and written", path.display())]
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

/// A text with the licence of generated files, which is that of the program, as a comment: above all but a line that tools look for.
fn licensed(name: &str, text: String) -> String {
    let (open, close) = match name.trim_end_matches(".txt").rsplit('.').next() {
        Some("vhd") => ("--", ""),
        Some("v" | "cpp") => ("//", ""),
        Some("h") => ("/*", " */"),
        Some("md" | "svd") => ("<!--", " -->"),
        Some("py" | "tcl" | "xdc" | "sdc" | "ucf" | "xst" | "lpf" | "sh" | "core") => ("#", ""),
        _ => return text,
    };
    let is_first = |line: &&str| line.starts_with("#!") || line.starts_with("CAPI=") || line.starts_with("<?xml");
    let first = text.split_inclusive('\n').next().filter(is_first).unwrap_or_default();
    let licence = concat!("SPDX-License-Identifier: ", env!("CARGO_PKG_LICENSE"));
    format!("{first}{open} {licence}{close}\n{}", &text[first.len()..])
}

impl FileSet {
    /// Adds a file; a text ends with a line feed, and begins with its licence if it may have comments.
    pub fn insert(&mut self, name: impl Into<String>, text: impl Into<String>) {
        let name = name.into();
        let mut text = licensed(&name, text.into());
        if !text.ends_with('\n') {
            text.push('\n');
        }
        self.0.insert(name, text);
    }

    /// Adds the files of another set, in a folder.
    // For the ready designs.
    #[doc(hidden)]
    pub fn insert_folder(&mut self, folder: &str, files: Self) {
        self.0.extend(files.0.into_iter().map(|(name, text)| (format!("{folder}/{name}"), text)));
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
    /// manifest names go, and what efsat did not write stays. Files and directories that stay keep their permissions.
    ///
    /// Everything is written to a directory beside it, which then takes its place; an error or an interruption leaves
    /// the old state. Where the system cannot exchange two directories, files take their places one by one. Runs that write
    /// beside each other take turns.
    ///
    /// # Errors
    /// A target that holds something else, and what the operating system says.
    pub fn write(&self, dir: &Path) -> Result<(), FileSetError> {
        let target = std::fs::canonicalize(dir).or_else(|_| std::path::absolute(dir)).map_err(at(dir))?;
        let parent = target.parent().ok_or_else(|| FileSetError::Current(dir.to_owned()))?;
        std::fs::create_dir_all(parent).map_err(at(parent))?;
        let _turn = turn(parent);
        let found = self.replaceable(dir)?;
        let scratch = Scratch::inside(parent).map_err(at(parent))?;
        let new = scratch.path().join("new");
        uninterrupted(|| {
            self.fill(&new, &target)?;
            let Some(found) = found else { return std::fs::rename(&new, &target).map_err(at(dir)) };
            match found.link(&target, &new).and_then(|()| exchange(&new, &target)) {
                Ok(()) => found.rescue(&new, &target).map_err(at(dir)),
                Err(_) => self.one_by_one(&new, &target, &found),
            }
        })
    }

    /// Whether `dir` is one that [`write`](Self::write) takes; nothing is written.
    ///
    /// # Errors
    /// As [`write`](Self::write).
    pub fn check_target(&self, dir: &Path) -> Result<(), FileSetError> {
        self.replaceable(dir).map(|_| ())
    }

    /// What is in `dir`, if it is there.
    fn replaceable(&self, dir: &Path) -> Result<Option<Found>, FileSetError> {
        match std::fs::metadata(dir) {
            Ok(found) if !found.is_dir() => return Err(FileSetError::NotDirectory(dir.to_owned())),
            Ok(_) => {}
            Err(e) if e.kind() == io::ErrorKind::NotFound => return Ok(None),
            Err(e) => return Err(at(dir)(e)),
        }
        let found = self.found(dir)?;
        let target = std::fs::canonicalize(dir).map_err(at(dir))?;
        match std::env::current_dir().is_ok_and(|here| here.starts_with(&target)) {
            true => Err(FileSetError::Current(dir.to_owned())),
            false => Ok(Some(found)),
        }
    }

    /// Writes all files to a new directory, each with the permissions that it has in the old one.
    fn fill(&self, new: &Path, old: &Path) -> Result<(), FileSetError> {
        for (name, text) in &self.0 {
            let path = new.join(name);
            make_parents(&path).and_then(|()| std::fs::write(&path, text)).map_err(at(&path))?;
            copy_permissions(&old.join(name), &path).map_err(at(&path))?;
        }
        Ok(())
    }

    /// Moves the files of `new` to `target`. The manifest is the first: where this ends early, it names what is there.
    fn one_by_one(&self, new: &Path, target: &Path, found: &Found) -> Result<(), FileSetError> {
        for name in found.ours.iter().filter(|name| name.to_str().is_none_or(|name| !self.0.contains_key(name))) {
            let path = target.join(name);
            std::fs::remove_file(&path).map_err(at(&path))?;
            // A directory that holds something stays.
            let _ = path.parent().filter(|parent| *parent != target).map(std::fs::remove_dir);
        }
        let manifest = self.0.keys().filter(|name| *name == manifest::NAME);
        for name in manifest.chain(self.0.keys().filter(|name| *name != manifest::NAME)) {
            let path = target.join(name);
            make_parents(&path).and_then(|()| std::fs::rename(new.join(name), &path)).map_err(at(&path))?;
        }
        Ok(())
    }

    /// Compares `dir` with the set. Of what is not in the set, only files that the manifest there names count: the others
    /// were not written by efsat.
    ///
    /// # Errors
    /// What the operating system says; a directory that does not exist lacks every file.
    pub fn check(&self, dir: &Path) -> Result<Vec<Difference>, FileSetError> {
        let mut there = Found::default();
        if !matches!(std::fs::metadata(dir), Err(e) if e.kind() == io::ErrorKind::NotFound) {
            there.list(dir, Path::new("")).map_err(|(path, source)| FileSetError::Io { path, source })?;
        }
        let mut there = there.foreign;
        let text = std::fs::read_to_string(dir.join(manifest::NAME)).unwrap_or_default();
        let ours = manifest::files(&text).unwrap_or_default();
        let mut differences = vec![];
        for (name, text) in &self.0 {
            let path = dir.join(name);
            if !there.remove(Path::new(name)) {
                differences.push(Difference::Missing(name.clone()));
            } else if std::fs::read(&path).map_err(at(&path))? != text.as_bytes() {
                differences.push(Difference::Differs(name.clone()));
            }
        }
        let extra = there.into_iter().map(|name| name.display().to_string()).filter(|name| ours.contains(name));
        differences.extend(extra.map(Difference::Extra));
        Ok(differences)
    }

    /// What is in `dir`, if what efsat wrote of it may be replaced by this set.
    fn found(&self, dir: &Path) -> Result<Found, FileSetError> {
        let mut there = Found::default();
        there.list(dir, Path::new("")).map_err(|(path, source)| FileSetError::Io { path, source })?;
        let Some(example) = there.foreign.first() else { return Ok(there) };
        let text = std::fs::read_to_string(dir.join(manifest::NAME)).unwrap_or_default();
        let Some(mut ours) = manifest::files(&text) else {
            return Err(FileSetError::Occupied { dir: dir.to_owned(), found: example.display().to_string() });
        };
        ours.insert(manifest::NAME.to_owned());
        // A link in place of a file is somebody's.
        let is_ours =
            |name: &PathBuf| name.to_str().is_some_and(|name| ours.contains(name)) && !dir.join(name).is_symlink();
        (there.ours, there.foreign) = there.foreign.into_iter().partition(is_ours);
        let parents: BTreeSet<&Path> = there.ours.iter().flat_map(|name| name.ancestors().skip(1)).collect();
        there.folders.retain(|name| !parents.contains(name.as_path()));
        // A file with the name of one of the set, or where a directory of it would be, or below a name of a file of it.
        let in_the_way =
            |found: &&PathBuf| self.0.keys().any(|name| Path::new(name).starts_with(found) || found.starts_with(name));
        let empty = |found: &&PathBuf| self.0.keys().any(|name| Path::new(name) == *found);
        match there.foreign.iter().find(in_the_way).or_else(|| there.folders.iter().find(empty)) {
            Some(found) => Err(FileSetError::Collision { dir: dir.to_owned(), found: found.display().to_string() }),
            None => Ok(there),
        }
    }
}

/// What is in a directory, by path relative to it.
#[derive(Default)]
struct Found {
    /// Files that efsat wrote.
    ours: BTreeSet<PathBuf>,
    /// Files that it did not write.
    foreign: BTreeSet<PathBuf>,
    /// Directories that hold none of the former.
    folders: BTreeSet<PathBuf>,
}

impl Found {
    /// Adds all files below `dir`, at first as foreign ones, and all directories. Links are not followed.
    fn list(&mut self, dir: &Path, below: &Path) -> Result<(), (PathBuf, io::Error)> {
        let here = dir.join(below);
        let named = |e| (here.clone(), e);
        for entry in std::fs::read_dir(&here).map_err(named)? {
            let entry = entry.map_err(named)?;
            let name = below.join(entry.file_name());
            if entry.file_type().map_err(named)?.is_dir() {
                self.list(dir, &name)?;
                self.folders.insert(name);
            } else {
                self.foreign.insert(name);
            }
        }
        Ok(())
    }

    /// Gives a new directory all that is not ours, and its directories the permissions they have in the old one.
    fn link(&self, old: &Path, new: &Path) -> io::Result<()> {
        self.folders.iter().try_for_each(|name| std::fs::create_dir_all(new.join(name)))?;
        for name in &self.foreign {
            make_parents(&new.join(name))?;
            std::fs::hard_link(old.join(name), new.join(name))?;
        }
        let ours = self.ours.iter().flat_map(|name| name.ancestors().skip(1));
        let folders: BTreeSet<&Path> = self.folders.iter().map(PathBuf::as_path).chain(ours).collect();
        folders.into_iter().try_for_each(|name| copy_permissions(&old.join(name), &new.join(name)))?;
        copy_permissions(old, new)
    }

    /// Moves what came to the old directory until the last moment to the new one. What is linked to both stays.
    fn rescue(&self, old: &Path, new: &Path) -> io::Result<()> {
        let mut left = Self::default();
        left.list(old, Path::new("")).map_err(|(_, e)| e)?;
        for name in left.foreign.difference(&self.ours) {
            make_parents(&new.join(name))?;
            std::fs::rename(old.join(name), new.join(name))?;
        }
        Ok(())
    }
}

fn make_parents(path: &Path) -> io::Result<()> {
    path.parent().map_or(Ok(()), std::fs::create_dir_all)
}

/// Waits until no other run writes in a directory; as long as the result is there, this one does. Not every file system
/// has locks.
fn turn(dir: &Path) -> Option<File> {
    let dir = File::open(dir).ok()?;
    dir.lock().ok()?;
    Some(dir)
}

/// Copies permissions where both are there.
fn copy_permissions(from: &Path, to: &Path) -> io::Result<()> {
    match std::fs::symlink_metadata(from) {
        Ok(from) if to.exists() => std::fs::set_permissions(to, from.permissions()),
        _ => Ok(()),
    }
}

/// Exchanges two directories; there is no moment at which one of the names leads nowhere.
#[cfg(target_os = "linux")]
fn exchange(a: &Path, b: &Path) -> io::Result<()> {
    use rustix::fs::{CWD, RenameFlags, renameat_with};
    Ok(renameat_with(CWD, a, CWD, b, RenameFlags::EXCHANGE)?)
}

#[cfg(not(target_os = "linux"))]
fn exchange(_: &Path, _: &Path) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use efsat_hardware::testing::full;
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
        let first = set(&[("x.vec", "x"), ("ise/y.prj", "y")]);
        first.write(&dir).unwrap();
        assert_eq!(first.check(&dir).unwrap(), []);
        assert_eq!(fs::read_to_string(dir.join("x.vec")).unwrap(), "x\n");

        fs::write(dir.join("ise/notes.txt"), "mine").unwrap();
        fs::write(dir.join("x.vec"), "X\n").unwrap();
        let second = set(&[("x.vec", "x2"), ("z.vec", "z")]);
        let names: Vec<String> = second.check(&dir).unwrap().iter().map(ToString::to_string).collect();
        assert_eq!(
            names,
            ["differs manifest.json", "differs x.vec", "missing z.vec", "extra ise/y.prj"],
            "a file of somebody else is none"
        );
        second.write(&dir).unwrap();
        assert_eq!(second.check(&dir).unwrap(), []);
        assert_eq!(fs::read_to_string(dir.join("ise/notes.txt")).unwrap(), "mine");
        assert_eq!(fs::read_dir(home.path().join("a")).unwrap().count(), 1, "nothing is left beside it");
    }

    /// Permissions of a file or directory.
    #[cfg(unix)]
    fn mode(path: &Path) -> u32 {
        use std::os::unix::fs::PermissionsExt;
        fs::metadata(path).unwrap().permissions().mode() & 0o777
    }

    #[test]
    #[cfg(unix)]
    fn what_stays_is_as_it_was() {
        use std::os::unix::ffi::OsStrExt;
        use std::os::unix::fs::{PermissionsExt, symlink};
        let home = tempfile::tempdir().unwrap();
        let dir = home.path().join("out");
        set(&[("x.vec", "x"), ("ise/y.prj", "y"), ("old/z", "z")]).write(&dir).unwrap();
        fs::create_dir_all(dir.join("empty/inner")).unwrap();
        symlink("nowhere", dir.join("link")).unwrap();
        let latin = dir.join(std::ffi::OsStr::from_bytes(b"na\xefve"));
        fs::write(&latin, "mine").unwrap();
        let modes = [("", 0o750), ("x.vec", 0o640), ("ise", 0o711), ("ise/y.prj", 0o604), ("empty/inner", 0o700)];
        for (name, mode) in modes {
            fs::set_permissions(dir.join(name), fs::Permissions::from_mode(mode)).unwrap();
        }
        set(&[("x.vec", "x2"), ("ise/y.prj", "y"), ("new", "n")]).write(&dir).unwrap();
        for (name, expected) in modes {
            assert_eq!(mode(&dir.join(name)), expected, "{name}");
        }
        assert_eq!(fs::read_link(dir.join("link")).unwrap(), Path::new("nowhere"));
        assert_eq!(fs::read_to_string(latin).unwrap(), "mine");
        assert!(!dir.join("old").exists(), "it was ours and is empty");
    }

    #[test]
    fn others_always_find_their_files() {
        let home = tempfile::tempdir().unwrap();
        let dir = home.path().join("out");
        let sets = [set(&[("x.vec", "x"), ("a/b", "b")]), set(&[("x.vec", "y")])];
        sets[0].write(&dir).unwrap();
        fs::write(dir.join("notes.txt"), "mine").unwrap();
        let done = std::sync::atomic::AtomicBool::new(false);
        let relaxed = std::sync::atomic::Ordering::Relaxed;
        std::thread::scope(|scope| {
            let writer = scope.spawn(|| {
                let written = (0..if full() { 300 } else { 100 }).try_for_each(|i| sets[i % 2].write(&dir));
                done.store(true, relaxed);
                written
            });
            while !done.load(relaxed) {
                assert_eq!(fs::read_to_string(dir.join("notes.txt")).unwrap_or_default(), "mine");
            }
            writer.join().unwrap().unwrap();
        });
    }

    #[test]
    fn of_two_runs_at_a_time_one_is_there() {
        let home = tempfile::tempdir().unwrap();
        let dir = home.path().join("out");
        let sets = [set(&[("x.vec", "x"), ("a/b", "b")]), set(&[("x.vec", "y"), ("c/d", "d")])];
        sets[0].write(&dir).unwrap();
        fs::write(dir.join("notes.txt"), "mine").unwrap();
        for _ in 0..50 {
            std::thread::scope(|scope| {
                let writers = sets.each_ref().map(|set| scope.spawn(|| set.write(&dir)));
                writers.into_iter().for_each(|writer| writer.join().unwrap().unwrap());
            });
            assert!(sets.iter().any(|set| set.check(&dir).unwrap().is_empty()), "{:?}", sets[0].check(&dir));
            assert!(!dir.join("a").exists() || !dir.join("c").exists(), "not both");
            assert!(dir.join("notes.txt").exists());
        }
    }

    #[test]
    fn what_comes_at_the_last_moment_is_not_lost() {
        let home = tempfile::tempdir().unwrap();
        let [old, new] = ["old", "new"].map(|name| home.path().join(name));
        let files = set(&[("x.vec", "x")]);
        files.write(&old).unwrap();
        fs::write(old.join("kept"), "mine").unwrap();
        let found = files.found(&old).unwrap();
        set(&[("x.vec", "new")]).write(&new).unwrap();
        found.link(&old, &new).unwrap();
        // After the other directory was filled: a file that is new, and one that an editor writes beside and renames.
        fs::create_dir(old.join("late")).unwrap();
        fs::write(old.join("late/file"), "mine").unwrap();
        fs::write(old.join("beside"), "changed").unwrap();
        fs::rename(old.join("beside"), old.join("kept")).unwrap();
        found.rescue(&old, &new).unwrap();
        let text = |name: &str| fs::read_to_string(new.join(name)).unwrap();
        assert_eq!((text("late/file"), text("kept"), text("x.vec")), ("mine".into(), "changed".into(), "new\n".into()));
    }

    #[test]
    fn files_take_their_places_one_by_one_where_directories_cannot() {
        let home = tempfile::tempdir().unwrap();
        let [dir, new] = ["out", "new"].map(|name| home.path().join(name));
        set(&[("x.vec", "x"), ("old/z", "z"), ("ise/y", "y")]).write(&dir).unwrap();
        fs::write(dir.join("ise/notes.txt"), "mine").unwrap();
        let second = set(&[("x.vec", "x2"), ("deep/a", "a")]);
        second.fill(&new, &dir).unwrap();
        second.one_by_one(&new, &dir, &second.found(&dir).unwrap()).unwrap();
        assert_eq!(second.check(&dir).unwrap(), []);
        assert!(!dir.join("old").exists() && !dir.join("ise/y").exists() && dir.join("ise/notes.txt").exists());
    }

    #[test]
    fn what_others_wrote_is_never_replaced() {
        let home = tempfile::tempdir().unwrap();
        let dir = home.path().join("out");
        let files = set(&[("x.vec", "x")]);
        fs::create_dir(&dir).unwrap();
        fs::write(dir.join("thesis.tex"), "t").unwrap();
        assert!(files.write(&dir).unwrap_err().to_string().contains("found thesis.tex and no manifest.json of efsat"));
        fs::write(dir.join(manifest::NAME), "{\"name\": \"a web page\"}").unwrap();
        assert!(matches!(files.write(&dir), Err(FileSetError::Occupied { .. })));
        assert_eq!(fs::read_dir(&dir).unwrap().count(), 2);

        fs::write(dir.join(manifest::NAME), set(&[]).get(manifest::NAME).unwrap()).unwrap();
        fs::write(dir.join("x.vec"), "by hand").unwrap();
        assert!(matches!(files.write(&dir), Err(FileSetError::Collision { .. })));
        assert_eq!(fs::read_to_string(dir.join("x.vec")).unwrap(), "by hand");
        // A folder of ours that is somebody's file, and a manifest that names what is not below it.
        let deep = set(&[("x.vec/y", "y")]);
        assert!(matches!(deep.write(&dir), Err(FileSetError::Collision { .. })));
        fs::remove_file(dir.join("x.vec")).unwrap();
        // Somebody's directory where a file of ours would be, empty or not.
        fs::create_dir(dir.join("x.vec")).unwrap();
        assert!(matches!(files.write(&dir), Err(FileSetError::Collision { .. })));
        fs::write(dir.join("x.vec/notes"), "n").unwrap();
        assert!(matches!(files.write(&dir), Err(FileSetError::Collision { .. })));
        fs::remove_dir_all(dir.join("x.vec")).unwrap();
        fs::write(home.path().join("thesis.tex"), "t").unwrap();
        fs::write(dir.join(manifest::NAME), set(&[("../thesis.tex", "")]).get(manifest::NAME).unwrap()).unwrap();
        files.write(&dir).unwrap();
        assert_eq!(fs::read_to_string(home.path().join("thesis.tex")).unwrap(), "t");

        let file = home.path().join("file");
        fs::write(&file, "").unwrap();
        assert!(matches!(files.write(&file), Err(FileSetError::NotDirectory(_))));
        assert!(matches!(files.write(&file.join("below")), Err(FileSetError::Io { .. })));
    }
}
