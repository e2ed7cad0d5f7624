//! `efsat wall`.

use super::error::Failure;

/// To be written
#[derive(Debug, clap::Args)]
pub(super) struct Arguments {}

pub(super) fn run(_arguments: &Arguments) -> Result<(), Failure> {
    Err(Failure::Usage("not yet".to_owned()))
}
