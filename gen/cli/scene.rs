//! `efsat scene`.

mod given;
mod pairs;
mod plan;
mod run;
mod summary;
mod times;

use super::error::Failure;
use clap::Subcommand;
use efsat_geometry::collide::hierarchy::Directions;

/// Analyses scenes: which triangles come close, and which optional stages of the unit that calls for
#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Pairs(pairs::Arguments),
    Plan(plan::Arguments),
    Run(Box<run::Arguments>),
    Times(times::Arguments),
}

/// Directions of bounding volumes by their number.
fn directions(text: &str) -> Result<Directions, String> {
    let legal = || "expected one of 6, 14, 18, 26".to_owned();
    text.parse().ok().and_then(Directions::of).ok_or_else(legal)
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    match &arguments.command {
        Command::Pairs(arguments) => pairs::run(arguments),
        Command::Plan(arguments) => plan::run(arguments),
        Command::Run(arguments) => run::run(arguments),
        Command::Times(arguments) => times::run(arguments),
    }
}
