//! Files that commands write: there as a whole, or as they were. What a link leads to is written, permissions stay.

use super::error::Failure;
use efsat_unit::artefact::Scratch;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// A file that takes its name when it is finished.
pub(super) struct Output {
    /// As it was typed.
    name: PathBuf,
    target: PathBuf,
    /// None where bytes go straight to the target: a pipe or a terminal has no place beside it.
    scratch: Option<Scratch>,
    file: BufWriter<File>,
}

/// The name in the scratch folder.
const NAME: &str = "output";

impl Output {
    /// Begins a file; a target that cannot be written is found out here.
    pub fn new(path: &Path) -> Result<Self, Failure> {
        named(path, "file")?;
        distinct(std::iter::once(path))?;
        let target = place(path)?;
        let found = fs::metadata(&target).ok();
        if found.as_ref().is_some_and(fs::Metadata::is_dir) {
            let message = format!("{}: found a directory; expected the name of a file", path.display());
            return Err(Failure::Usage(message));
        }
        let (scratch, file) = match &found {
            Some(found) if !found.is_file() => (None, File::options().write(true).open(&target)),
            _ => {
                let scratch = target.parent().map(Scratch::inside).transpose().map_err(fault(path))?;
                let beside = scratch.as_ref().map_or(Path::new(""), Scratch::path).join(NAME);
                (scratch, File::create_new(beside))
            }
        };
        let file = file.map_err(fault(path))?;
        if let (Some(_), Some(found)) = (&scratch, found) {
            file.set_permissions(found.permissions()).map_err(fault(path))?;
        }
        Ok(Self { name: path.to_owned(), target, scratch, file: BufWriter::new(file) })
    }

    /// Adds bytes.
    pub fn write(&mut self, bytes: impl AsRef<[u8]>) -> Result<(), Failure> {
        self.file.write_all(bytes.as_ref()).map_err(fault(&self.name))
    }

    /// Puts the file in its place.
    pub fn finish(mut self) -> Result<(), Failure> {
        self.file.flush().map_err(fault(&self.name))?;
        let Some(scratch) = self.scratch else { return Ok(()) };
        fs::rename(scratch.path().join(NAME), &self.target).map_err(fault(&self.name))
    }
}

/// The name of a picture.
pub(super) fn picture(text: &str) -> Result<PathBuf, String> {
    ending(text, &["svg", "png"])
}

/// The name of a file of rows.
pub(super) fn rows(text: &str) -> Result<PathBuf, String> {
    ending(text, &["csv"])
}

/// A name with one of some extensions.
pub(super) fn ending(text: &str, legal: &[&str]) -> Result<PathBuf, String> {
    match Path::new(text).extension().and_then(|e| e.to_str()) {
        Some(found) if legal.contains(&found) => Ok(text.into()),
        _ => Err(format!("expected a name that ends in .{}", legal.join(" or ."))),
    }
}

/// Writes all files or, as far as that can be known before, none.
pub(super) fn write_all(files: impl Iterator<Item = (impl AsRef<Path>, impl AsRef<[u8]>)>) -> Result<(), Failure> {
    let begun = files.map(|(path, bytes)| {
        let mut file = Output::new(path.as_ref())?;
        file.write(bytes)?;
        Ok(file)
    });
    let begun: Vec<Output> = begun.collect::<Result<_, Failure>>()?;
    begun.into_iter().try_for_each(Output::finish)
}

/// Makes a folder if it is absent.
pub(super) fn folder(path: &Path) -> Result<(), Failure> {
    named(path, "directory")?;
    if path.exists() && !path.is_dir() {
        let message =
            format!("{}: found no directory; expected one, or a name that does not exist yet", path.display());
        return Err(Failure::Usage(message));
    }
    fs::create_dir_all(path).map_err(|e| Failure::Usage(format!("{}: cannot be made: {e}", path.display())))
}

/// Refuses the name that stands for standard output elsewhere.
pub(super) fn named(path: &Path, what: &str) -> Result<(), Failure> {
    match path.as_os_str() == "-" {
        true => Err(Failure::Usage(format!("-: expected the name of a {what}; ./- is one with this name"))),
        false => Ok(()),
    }
}

/// The places of the files that this run reads.
static READ: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Says that a file is read, so that it is not written over.
pub(super) fn reads(path: &Path) {
    if let Ok(place) = place(path) {
        READ.lock().unwrap_or_else(PoisonError::into_inner).push(place);
    }
}

/// Refuses names of outputs that lead to one file, or to one that is read.
pub(super) fn distinct<'a>(paths: impl Iterator<Item = &'a Path>) -> Result<(), Failure> {
    let mut places = READ.lock().unwrap_or_else(PoisonError::into_inner).clone();
    for path in paths {
        let place = place(path)?;
        if places.contains(&place) {
            let message = format!("{}: found twice; expected two different files", path.display());
            return Err(Failure::Usage(message));
        }
        places.push(place);
    }
    Ok(())
}

/// The one name of a file or folder, links followed, that may not exist yet, nor those around it. A link that leads
/// nowhere is no file, nor is a name that ends in a slash.
pub(super) fn place(path: &Path) -> Result<PathBuf, Failure> {
    fn seek(path: &Path) -> io::Result<PathBuf> {
        fs::canonicalize(path).or_else(|e| {
            let absent = path.symlink_metadata().is_err() && !path.as_os_str().as_encoded_bytes().ends_with(b"/");
            let name = path.file_name().filter(|_| absent).ok_or(e)?;
            let parent = path.parent().filter(|parent| !parent.as_os_str().is_empty());
            Ok(seek(parent.unwrap_or(Path::new(".")))?.join(name))
        })
    }
    // A pipe behind a name of the system has no other name.
    let is_stream = fs::metadata(path).is_ok_and(|found| !found.is_file() && !found.is_dir());
    if is_stream { std::path::absolute(path) } else { seek(path) }.map_err(fault(path))
}

pub(super) fn fault(path: &Path) -> impl FnOnce(io::Error) -> Failure + use<> {
    let path = path.display().to_string();
    move |e| {
        let is_full = matches!(e.kind(), io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded);
        let expected = if is_full { "" } else { "; expected a file in an existing folder that can be written" };
        Failure::Usage(format!("{path}: {e}{expected}"))
    }
}
