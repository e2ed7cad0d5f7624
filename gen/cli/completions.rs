//! `efsat completions`.

use super::error::Failure;
use super::output::print;
use clap_complete::Shell;

/// Prints a script that makes a shell complete commands, options and their values
///
/// For bash: efsat completions bash > ~/.local/share/bash-completion/completions/efsat
#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// Shell
    #[arg(value_name = "SHELL")]
    shell: Shell,
}

pub(super) fn run(arguments: &Arguments, command: &mut clap::Command) -> Result<(), Failure> {
    let mut script = vec![];
    clap_complete::generate(arguments.shell, command, "efsat", &mut script);
    print(&String::from_utf8_lossy(&script))
}
