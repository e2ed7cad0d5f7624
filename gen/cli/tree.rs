//! `efsat tree`.

mod answer;
mod build;
mod count;
mod inspect;
mod query;
mod verify;

use super::error::Failure;
use super::params::{choice, whole};
use clap::Subcommand;
use efsat_engine::host::{Image, ImageError};
use efsat_engine::params::{EngineParams, OFFSET_BITS, ORIGIN_BITS};
use efsat_geometry::collide::hierarchy::Directions;
use efsat_geometry::input;
use std::path::Path;

/// Builds and checks images of trees for the collision engine, and counts what it would do with them
#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Build(build::Arguments),
    Inspect(inspect::Arguments),
    Verify(verify::Arguments),
    Count(count::Arguments),
    Answer(Box<answer::Arguments>),
    Query(Box<query::Arguments>),
}

/// The options of the engine that a tree depends on.
#[derive(Debug, clap::Args)]
struct VolumeArguments {
    /// Directions of a bounding volume
    #[arg(long, value_name = "K", default_value = "18", value_parser = choice::<Directions>(), allow_negative_numbers = true)]
    directions: Directions,
    /// Bits of a coordinate of a block's origin, 4 to 22
    #[arg(long, value_name = "N", default_value_t = 18, value_parser = whole(ORIGIN_BITS), allow_negative_numbers = true)]
    origin_bits: u32,
    /// Bits of a code, which is an offset of a bounding volume relative to its block, 4 to 15
    #[arg(long, value_name = "N", default_value_t = 10, value_parser = whole(OFFSET_BITS), allow_negative_numbers = true)]
    offset_bits: u32,
}

impl VolumeArguments {
    /// An engine with these options.
    fn engine(&self) -> EngineParams {
        let Self { directions, origin_bits, offset_bits } = *self;
        EngineParams { directions, origin_bits, offset_bits, ..EngineParams::default() }
    }
}

/// Reads an image; `fault` is what one that is not in order means.
fn read(path: &Path, fault: fn(String) -> Failure) -> Result<Image, Failure> {
    let bytes = input::read(path).map_err(|e| {
        Failure::Usage(format!("{}: cannot be read ({e}); expected an image made by efsat tree build", path.display()))
    })?;
    Image::read(&bytes).map_err(|e| fault(wrong(path, &e)))
}

/// Words of 64 bits as they are printed.
fn hexadecimal(words: &[u64]) -> Vec<String> {
    words.iter().map(|word| format!("{word:016x}")).collect()
}

/// What is wrong inside an image.
fn wrong(path: &Path, e: &ImageError) -> String {
    format!("{}: {e}", path.display())
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    match &arguments.command {
        Command::Build(arguments) => build::run(arguments),
        Command::Inspect(arguments) => inspect::run(arguments),
        Command::Verify(arguments) => verify::run(arguments),
        Command::Count(arguments) => count::run(arguments),
        Command::Answer(arguments) => answer::run(arguments),
        Command::Query(arguments) => query::run(arguments),
    }
}
