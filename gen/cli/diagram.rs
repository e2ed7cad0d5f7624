//! `efsat generate --dot` and `--svg`: the dataflow picture of one unit.

use super::error::Failure;
use super::output::print;
use crate::design::Design;
use crate::diagram::{self, Picture};
use crate::graph::schedule::Scheduler;
use std::path::{Path, PathBuf};

/// A picture in place of the design.
#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Dataflow picture of one unit, written in place of the design")]
pub(super) struct DiagramArguments {
    /// Unit to be drawn; an unknown name is answered with the legal ones
    #[arg(long, value_name = "NAME", conflicts_with = "check")]
    unit: Option<String>,
    /// Picture for Graphviz: a cluster a clock, formats on the edges, the critical path in red
    #[arg(long, value_name = "FILE", requires = "unit")]
    dot: Option<PathBuf>,
    /// The same picture drawn, needing no Graphviz
    #[arg(long, value_name = "FILE", requires = "unit")]
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
            return Err(Failure::Usage(format!("--unit {name}: legal is one of {}", names.join(", "))));
        };
        let mut scheduler = Scheduler::new(design.device, design.params.frequency);
        let picture = Picture::new(&scheduler.schedule(unit), scheduler.period());
        let files = [(&self.dot, picture.dot()), (&self.svg, picture.svg())];
        for (path, text) in files.iter().filter_map(|(path, text)| path.as_ref().map(|path| (path, text))) {
            write(path, text)?;
            let (boxes, clocks) = (picture.places.len(), picture.latency);
            print(&format!("{}: {name}, {boxes} boxes, latency {clocks} clocks\n", path.display()))?;
        }
        Ok(())
    }
}

fn write(path: &Path, text: &str) -> Result<(), Failure> {
    std::fs::write(path, text).map_err(|e| Failure::Usage(format!("{}: {e}", path.display())))
}
