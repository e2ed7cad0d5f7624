//! `efsat scene times`.

use crate::error::Failure;
use efsat_studies::times::plot;
use std::fs;
use std::path::PathBuf;

/// Draws times per query over the distance of the objects
///
/// FILE is a CSV file with the columns series, distance, queries and microseconds: the mean time of a query at a distance, for
/// each of some programs or engines.
#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// Table of times
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Plot to write, SVG
    #[arg(long, value_name = "FILE", required = true)]
    out: PathBuf,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let Arguments { file, out } = arguments;
    let table = fs::read_to_string(file)
        .map_err(|e| Failure::Usage(format!("{}: cannot be read ({e}); expected a table of times", file.display())))?;
    let svg = plot(&table).map_err(|e| Failure::Usage(format!("{}: {e}", file.display())))?;
    fs::write(out, svg).map_err(|e| Failure::Usage(format!("{}: cannot be written: {e}", out.display())))
}
