//! `efsat plan-engine`.

use super::error::Failure;
use super::output::print;
use super::progress;
use super::source::load_scene;
use efsat_engine::params::ENGINES;
use efsat_hardware::device;
use efsat_studies::engine_plan::{Candidate, PlanError, plan};
use std::fmt::Write;

/// Engines that are printed.
const LINES: usize = 8;

/// Chooses a collision engine for a scene and a part: directions, clocks, caches, width of memory, and how many fit
///
/// Some hundred engines are compared by the work of all frames, counted by the reference model, and by predicted cells. Clocks are
/// those of the busiest of volume unit, triangle unit and memory port, and 40 for the ends of a query; `efsat cosim --engine` with the
/// printed options simulates them.
#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// A scene: a TOML file, or `headlight` for the built-in one
    #[arg(value_name = "FILE")]
    file: String,
    /// The part
    #[arg(long, value_name = "NAME", default_value = "xc2v6000-4", value_parser = efsat_unit::params::options::device())]
    device: String,
    /// At most so many engines on the part
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = super::params::whole(ENGINES), allow_negative_numbers = true)]
    engines: u32,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let scene = load_scene(&arguments.file)?;
    let device = device::find(&arguments.device).map_err(|e| Failure::Usage(e.to_string()))?;
    let bar = progress::bar("counting", 4 * scene.frames() as u64, "poses", false);
    let found = plan(&scene, device, arguments.engines.into(), || bar.inc(1)).map_err(|e| match e {
        PlanError::Design(e) => e.into(),
        e => Failure::Usage(format!("{}: {e}", arguments.file)),
    })?;
    bar.finish_and_clear();
    match found.first() {
        None => Err(Failure::Usage(format!("--device {}: expected a larger part: no engine fits", arguments.device))),
        Some(best) => print(&table(&found[..LINES.min(found.len())], best)),
    }
}

fn table(found: &[Candidate], best: &Candidate) -> String {
    let mut text = format!(
        "{:>10}{:>11}{:>6}{:>8}{:>11}{:>7}{:>13}{:>8}{:>12}{:>9}{:>8}{:>8}  {}\n",
        "directions",
        "expansion",
        "pair",
        "blocks",
        "triangles",
        "width",
        "multipliers",
        "LUTs",
        "block RAMs",
        "engines",
        "clocks",
        "bytes",
        "busiest"
    );
    for one in found {
        let Candidate { engine, unit, cells, block_rams, engines, limit, .. } = one;
        let _ = writeln!(
            text,
            "{:>10}{:>11}{:>6}{:>8}{:>11}{:>7}{:>13}{:>8}{:>12}{:>9}{:>8.0}{:>8.0}  {}",
            engine.directions.count(),
            engine.expansion_clocks,
            unit.clocks_per_pair,
            engine.block_lines,
            engine.triangle_lines,
            engine.memory_width,
            cells.multipliers,
            cells.luts + cells.memory_luts,
            block_rams,
            engines,
            one.clocks,
            one.bytes(),
            limit.name()
        );
    }
    let _ = writeln!(text, "\nefsat generate --engine{} --out engine", best.options());
    let _ =
        writeln!(text, "its limit: {}; what another engine has too little of: {}", best.limit.name(), best.full.name());
    text
}
