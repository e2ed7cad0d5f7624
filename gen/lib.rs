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
//! # Map
//!
//! | what you want | where |
//! | --- | --- |
//! | make a core | [`params`], its options; [`design`], the unit of them; [`artefact`], its files |
//! | drive it | [`host`], triangles as the unit's numbers; [`host::driver`], packets and answers; [`pair`] and [`words`], what travels |
//! | know its answers without hardware | [`golden`], the reference model, bit for bit |
//! | two meshes and a pose | [`engine`], the collision engine: [`engine::params`], [`engine::artefact`], [`engine::driver`] |
//! | exact answers in software | [`software::retest`], fast; [`exact`], the oracle |
//! | triangles, meshes and scenes | [`mesh`], [`scene`], [`self_intersections`], [`pair_file`], [`sample`] |
//! | hardware of your own | [`graph`], [`op`], [`schedule`], [`netlist`], [`vhdl`], on a [`device`]; [`estimate`] and [`diagram`] read it |
//! | evidence | [`evidence`]: simulation, synthesis, and the campaigns that check the rest |
//!
//! What only these crates share with each other is public and not documented: it can change at any time.
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
    NotFinite, Points, collide, directions, exact, finite, mesh, pair_file, sample, scene, self_intersections,
    software, solids,
};
pub use efsat_hardware::{cells, device, diagram, estimate, graph, netlist, number, op, schedule, vhdl};
pub use efsat_unit::{artefact, design, golden, host, pair, params, words};
