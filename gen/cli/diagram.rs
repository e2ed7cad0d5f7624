//! `efsat generate --dot` and `--svg`: the dataflow picture of one unit.

use super::error::Failure;
use super::output::print;
use crate::artefact::Scratch;
use crate::design::Design;
use crate::diagram::{self, Picture};
use crate::schedule::Scheduler;
use std::path::{Path, PathBuf};
use std::{fs, io};

/// Options that are of whole designs. Each option here excludes them by itself: clap does not ask for what an option
/// requires where an option is given that excludes it.
const OF_DESIGNS: [&str; 4] = ["out", "check", "lp", "stream_width"];

/// A picture in place of the design.
#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Dataflow picture of one unit, written in place of the design")]
pub(super) struct DiagramArguments {
    /// Unit to be drawn; an unknown name is answered with the list of units
    #[arg(long, value_name = "NAME", conflicts_with_all = OF_DESIGNS)]
    unit: Option<String>,
    /// Picture for Graphviz: a cluster per clock, formats on the edges, the critical path in red
    #[arg(long, value_name = "FILE", requires = "unit", conflicts_with_all = OF_DESIGNS)]
    dot: Option<PathBuf>,
    /// The same picture drawn, needing no Graphviz
    #[arg(long, value_name = "FILE", requires = "unit", conflicts_with_all = OF_DESIGNS)]
    svg: Option<PathBuf>,
}

impl DiagramArguments {
    /// Whether a picture is wanted.
    pub fn wanted(&self) -> bool {
        self.unit.is_some()
    }

    /// Draws the unit.
    pub fn run(&self, design: &Design) -> Result<(), Failure> {
        let name = self.unit.as_deref().unwrap_or_default();
        if self.dot.is_none() && self.svg.is_none() {
            return Err(Failure::Usage(format!("--unit {name}: needs --dot FILE or --svg FILE")));
        }
        let units = diagram::units(&design.pipeline);
        let Some(unit) = units.iter().find(|unit| unit.name == name) else {
            let names: Vec<&str> = units.iter().map(|unit| unit.name.as_str()).collect();
            return Err(Failure::Usage(format!("--unit {name}: expected one of {}", names.join(", "))));
        };
        let mut scheduler = Scheduler::new(design.device, design.params.frequency);
        let picture = Picture::new(&scheduler.schedule(unit), scheduler.period());
        let files = [(&self.dot, picture.dot()), (&self.svg, picture.svg())];
        let files: Vec<(&Path, String)> =
            files.into_iter().filter_map(|(path, text)| path.as_deref().map(|path| (path, text))).collect();
        write(&files)?;
        let (boxes, clocks) = (picture.places.len(), picture.latency);
        files.iter().try_for_each(|(path, _)| {
            print(&format!("{}: {name}, {boxes} boxes, latency {clocks} clocks\n", path.display()))
        })
    }
}

/// The one name of a file, links followed, that may not exist yet. A link that leads nowhere is no file, nor is a name
/// that ends in a slash.
fn place(path: &Path) -> io::Result<PathBuf> {
    fs::canonicalize(path).or_else(|e| {
        let absent = path.symlink_metadata().is_err() && !path.as_os_str().as_encoded_bytes().ends_with(b"/");
        let name = path.file_name().filter(|_| absent).ok_or(e)?;
        let parent = path.parent().filter(|parent| !parent.as_os_str().is_empty());
        Ok(fs::canonicalize(parent.unwrap_or(Path::new(".")))?.join(name))
    })
}

/// Writes all files or none: each beside its place first.
fn write(files: &[(&Path, String)]) -> Result<(), Failure> {
    let at = |path: &Path| {
        let path = path.display().to_string();
        move |e: io::Error| Failure::Usage(format!("{path}: {e}; expected a file in an existing folder"))
    };
    let mut staged: Vec<(&Path, PathBuf, Option<Scratch>, &String)> = vec![];
    for (path, text) in files {
        let target = place(path).map_err(at(path))?;
        if staged.iter().any(|(_, other, ..)| *other == target) {
            return Err(Failure::Usage(format!("{}: found twice; expected two different files", path.display())));
        }
        // A pipe or a terminal has no place beside it.
        let stream = fs::metadata(&target).is_ok_and(|there| !there.is_file() && !there.is_dir());
        let parent = target.parent().filter(|_| !stream && !target.is_dir());
        let scratch = parent.map(Scratch::inside).transpose().map_err(at(path))?;
        if let Some(scratch) = &scratch {
            fs::write(scratch.path().join("picture"), text).map_err(at(path))?;
        } else if !stream {
            return Err(at(path)(io::ErrorKind::IsADirectory.into()));
        }
        staged.push((path, target, scratch, text));
    }
    for (path, target, scratch, text) in &staged {
        match scratch {
            Some(scratch) => fs::rename(scratch.path().join("picture"), target),
            None => fs::write(target, text),
        }
        .map_err(at(path))?;
    }
    Ok(())
}
