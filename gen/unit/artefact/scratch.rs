//! Temporary folders that neither an error nor an interruption leaves behind.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use tempfile::TempDir;

/// The folders there are now.
static LIVE: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn live() -> MutexGuard<'static, Vec<PathBuf>> {
    LIVE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A temporary folder, deleted with all it holds when it goes out of scope, and by [`interrupted`].
#[derive(Debug)]
pub struct Scratch(TempDir);

impl Scratch {
    /// A folder where the system keeps such.
    ///
    /// # Errors
    /// What the operating system says.
    pub fn new() -> io::Result<Self> {
        Self::inside(&std::env::temp_dir())
    }

    /// A folder in `parent`, so that its content can be renamed to somewhere else in it.
    ///
    /// # Errors
    /// What the operating system says.
    pub fn inside(parent: &Path) -> io::Result<Self> {
        let mut live = live();
        // Its error names the folder that was to be made, which nobody has asked for.
        let dir = tempfile::Builder::new().prefix(".efsat-").tempdir_in(parent).map_err(|e| e.kind())?;
        live.push(dir.path().to_owned());
        Ok(Self(dir))
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        self.0.path()
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        live().retain(|path| path != self.0.path());
    }
}

/// Runs `action`; an interruption waits until it is done.
pub(super) fn uninterrupted<T>(action: impl FnOnce() -> T) -> T {
    let _waits = live();
    action()
}

/// For the handler of an interruption: deletes all scratch folders and ends the process with `status`.
pub fn interrupted(status: i32) -> ! {
    // Kept until the end, so that no other thread makes a folder or swaps one in any more.
    let live = live();
    for path in live.iter() {
        // A simulator that is just dying may still write; and there is no one left to tell if it cannot be deleted.
        let _ = std::fs::remove_dir_all(path).or_else(|_| std::fs::remove_dir_all(path));
    }
    std::process::exit(status)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn deleted_and_forgotten_when_dropped() {
        let scratch = Scratch::new().unwrap();
        let path = scratch.path().to_owned();
        std::fs::write(path.join("x"), "x").unwrap();
        assert!(live().contains(&path));
        drop(scratch);
        assert!(!path.exists() && !live().contains(&path));
    }
}
