//! **efsat** generates synthesizable VHDL for an exact triangle-triangle intersection unit, and holds everything that
//! checks it: a reference model, an exact oracle, a simulator, proofs and campaigns.
//!
//! The unit implements EFSAT (Raabe, Tietjen, Anlauf): separating axes in fixed-point interval arithmetic. It answers
//! every pair of triangles *separate*, *intersect* or *possibly incorrect*, and a definite answer is never wrong.
//!
//! This crate is the program and one roof over the crates below it; a program that only generates VHDL can
//! depend on `efsat-unit` alone. From parameters to generated files:
//!
//! ```
//! use efsat::artefact::design_files;
//! use efsat::design::{Design, Probes};
//! use efsat::params::Params;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let params = Params { width: 20, axes_per_clock: 3, ..Params::default() };
//! let design = Design::new(&params, Probes::None)?;
//! println!("initiation interval {}, latency {}, in clocks", design.interval, design.latency);
//!
//! let files = design_files(&design, &params.command_line())?;
//! assert!(files.get("projection.vhd").unwrap().contains("entity projection is"));
//! # let dir = tempfile::tempdir()?;
//! # let target = dir.path().join("rtl-20");
//! files.write(&target)?; // all of them or none; files.iter() gives names and texts
//! # assert!(target.join("README.md").exists());
//! # Ok(())
//! # }
//! ```
//!
//! Programs to start from are in `examples/`: `generate` (the above), `classify` (verdicts and exact answers of pairs) and
//! `drive` (the stream of words to the unit and back). `cargo run --release --example NAME` runs one.
//!
//! Where to go on:
//!
//! * [`params`], [`design`], [`artefact`]: parameters, the units as dataflow graphs, the generated files;
//! * [`engine`]: the collision engine around the unit, with modules of the same names;
//! * [`pair`] and [`words`]: what the unit reads and answers, and how that travels in the words of its stream;
//! * [`golden`]: the reference model, which gives every answer of the unit bit for bit;
//! * [`host`]: quantising triangles for the unit, and the driver of its AXI4-Stream wrapper;
//! * [`exact`], [`software`]: the exact oracle, and tests in floating point with an exact retest;
//! * [`graph`], [`schedule`], [`netlist`], [`vhdl`]: the generator of pipelined fixed-point hardware underneath;
//! * [`evidence`]: simulation, synthesis, and the campaigns that check the rest.
//!
//! The README follows; the pages that it names are in `docs/`.
#![doc = include_str!("../README.md")]

/// Campaigns: what shows that the unit is right, and what accuracy costs in time.
pub mod evidence {
    pub use efsat_checks::{cosim, mutation, process, stress, synth};
    pub use efsat_studies::{accuracy, planner, times, wall};
}

pub use efsat_engine as engine;
pub use efsat_geometry::{
    NotFinite, Points, directions, exact, finite, mesh, pair_file, sample, scene, self_intersections, software,
};
pub use efsat_hardware::{cells, device, diagram, estimate, graph, netlist, number, op, schedule, vhdl};
pub use efsat_unit::{artefact, design, golden, host, pair, params, words};
