//! `efsat synth`.

use super::error::Failure;
use super::params::ParamArguments;

/// Synthesises the design with open tools and compares with what the device model predicts
#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    #[command(flatten)]
    params: ParamArguments,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    arguments.params.params()?;
    Ok(())
}
