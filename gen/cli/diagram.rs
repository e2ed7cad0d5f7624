//! `efsat generate --dot` and `--svg`: the dataflow picture of one unit.

use super::error::Failure;
use super::file;
use super::output::print;
use efsat_hardware::diagram::{self, Picture};
use efsat_hardware::schedule::Scheduler;
use efsat_unit::design::Design;
use std::path::{Path, PathBuf};

/// Options that are of whole designs. Each option here excludes them by itself: clap does not ask for what an option
/// requires where an option is given that excludes it.
const OF_DESIGNS: [&str; 6] = ["out", "check", "lp", "dump", "stream_width", "name"];

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
        let units: Vec<_> = design.pipelines().flat_map(diagram::blocks).collect();
        let Some(unit) = units.iter().find(|unit| unit.name == name) else {
            let names: Vec<&str> = units.iter().map(|unit| unit.name.as_str()).collect();
            return Err(Failure::Usage(format!("--unit {name}: expected one of {}", names.join(", "))));
        };
        if self.dot.is_none() && self.svg.is_none() {
            return Err(Failure::Usage(format!("--unit {name} alone: expected --dot FILE or --svg FILE with it")));
        }
        let mut scheduler = Scheduler::new(design.device, design.params.frequency);
        let picture = Picture::new(&scheduler.schedule(unit), scheduler.period());
        let files = [(&self.dot, picture.dot()), (&self.svg, picture.svg())];
        let files: Vec<(&Path, String)> =
            files.into_iter().filter_map(|(path, text)| path.as_deref().map(|path| (path, text))).collect();
        file::distinct(files.iter().map(|(path, _)| *path))?;
        file::write_all(files.iter().map(|(path, text)| (path, text)))?;
        let (boxes, clocks) = (picture.places.len(), picture.latency);
        files.iter().try_for_each(|(path, _)| {
            print(&format!("{}: {name}, {boxes} boxes, latency {clocks} clocks\n", path.display()))
        })
    }
}
