#![doc = include_str!("../README.md")]

pub mod cli;

pub use efsat_evidence::{accuracy, cosim, effects, mutation, stress, synth, wall};
pub use efsat_geometry::{Points, exact, mesh, pair_file, sample, scene, software};
pub use efsat_hardware::{cells, device, diagram, estimate, graph, netlist, number, op, schedule, vhdl};
pub use efsat_unit::{artefact, design, golden, host, params};
