//! `efsat manual`.

use super::error::Failure;
use super::file;
use super::output::print;
use clap_mangen::Man;
use std::path::PathBuf;

/// Writes the manual pages: efsat.1, and one for each command
///
/// For the current user: efsat manual ~/.local/share/man/man1
#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// Directory, which is made if it is absent
    #[arg(value_name = "DIR")]
    dir: PathBuf,
}

pub(super) fn run(arguments: &Arguments, mut command: clap::Command) -> Result<(), Failure> {
    command.build();
    let mut pages = vec![];
    collect(&command, "efsat", &mut pages)?;
    let dir = arguments.dir.display();
    file::folder(&arguments.dir)?;
    file::write_all(pages.iter().map(|(name, text)| (arguments.dir.join(name), text)))?;
    print(&format!("{dir}: {} pages\n", pages.len()))
}

/// The page of a command, and those of the commands below it.
fn collect(command: &clap::Command, name: &str, pages: &mut Vec<(String, Vec<u8>)>) -> Result<(), Failure> {
    let mut text = vec![];
    let page = Man::new(command.clone().name(name.to_owned()).disable_help_subcommand(true));
    page.render(&mut text).map_err(|e| Failure::Check(format!("{name}.1: {e}")))?;
    pages.push((format!("{name}.1"), text));
    let mut below = command.get_subcommands().filter(|command| command.get_name() != "help");
    below.try_for_each(|command| collect(command, &format!("{name}-{}", command.get_name()), pages))
}
