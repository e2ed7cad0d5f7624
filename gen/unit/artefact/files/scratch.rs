//! Temporary folders that neither an error nor an interruption leaves behind.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// How often an interruption tries to delete a folder.
const ATTEMPTS: usize = 100;

/// The folders there are now.
static LIVE: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn live() -> MutexGuard<'static, Vec<PathBuf>> {
    LIVE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A temporary folder, deleted with all it holds when it goes out of scope, and by [`interrupted`].
#[derive(Debug)]
pub struct Scratch(PathBuf);

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
        std::fs::metadata(parent)?;
        // Its error names the folder that was to be made, which nobody has asked for.
        let dir = tempfile::Builder::new().prefix(".efsat-").tempdir_in(parent).map_err(|e| e.kind())?.keep();
        live.push(dir.clone());
        Ok(Self(dir))
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.0
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        // Known until it is deleted, so that an interruption finds what is left of it.
        let mut live = live();
        // There is no one to tell if it cannot be deleted.
        let _ = std::fs::remove_dir_all(&self.0);
        live.retain(|path| *path != self.0);
    }
}

/// Runs `action`; an interruption waits until it is done.
pub(in crate::artefact) fn uninterrupted<T>(action: impl FnOnce() -> T) -> T {
    let _waits = live();
    action()
}

/// For the handler of an interruption: deletes all scratch folders and ends the process with `status`.
pub fn interrupted(status: i32) -> ! {
    // Kept until the end, so that no other thread makes a folder or swaps one in any more.
    let live = live();
    // Other threads may write to them still; and there is no one left to tell if one cannot be deleted.
    for _ in 0..ATTEMPTS {
        let mut there = live.iter().filter(|path| path.exists()).peekable();
        if there.peek().is_none() {
            break;
        }
        there.for_each(|path| drop(std::fs::remove_dir_all(path)));
        std::thread::sleep(Duration::from_millis(1));
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

    #[test]
    fn known_until_it_is_deleted() {
        let scratch = Scratch::new().unwrap();
        let path = scratch.path().to_owned();
        // Enough to delete that it takes a while.
        (0..2000).for_each(|i| std::fs::write(path.join(i.to_string()), "").unwrap());
        let deleting = std::thread::spawn(|| drop(scratch));
        while live().contains(&path) {
            std::thread::yield_now();
        }
        assert!(!path.exists(), "an interruption would leave it");
        deleting.join().unwrap();
    }
}
