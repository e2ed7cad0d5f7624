//! `efsat scene`.

mod pairs;

use super::error::Failure;
use clap::Subcommand;

/// Looks at scenes: what touches, and what it takes to find out
#[derive(Debug, clap::Args)]
#[command(disable_help_subcommand = true)]
pub(super) struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Pairs(pairs::Arguments),
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    match &arguments.command {
        Command::Pairs(arguments) => pairs::run(arguments),
    }
}
