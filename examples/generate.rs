//! VHDL from Rust: parameters, the design, its files.
//!
//! `cargo run --release --example generate [DIR]` writes the design to DIR, or to a new folder `rtl` below the system's
//! folder for temporary files.

use efsat::artefact::design_files;
use efsat::design::{Design, Probes};
use efsat::params::{Params, Upper};
use std::error::Error;
use std::path::{Path, PathBuf};

fn main() -> Result<(), Box<dyn Error>> {
    let dir = std::env::args_os().nth(1).map_or_else(|| std::env::temp_dir().join("rtl"), PathBuf::from);
    println!("{}", write(&dir)?);
    Ok(())
}

/// Writes a design of 20 bits that answers a pair every four clocks; says what it needs.
pub fn write(dir: &Path) -> Result<String, Box<dyn Error>> {
    let params = Params { width: 20, axes_per_clock: 3, upper: Upper::Sticky, ..Params::default() };
    let design = Design::new(&params, Probes::None)?;
    // A set of files is a value; `write` puts all of them there, or none.
    let files = design_files(&design, &params.command_line())?;
    files.write(dir)?;
    Ok(format!(
        "{}: {} files, {} multipliers, initiation interval {}, latency {} clocks",
        dir.display(),
        files.len(),
        design.top.multipliers(),
        design.interval,
        design.latency
    ))
}
