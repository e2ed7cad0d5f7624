//! What shows that the unit is right: simulators and synthesis tools on the generated files, campaigns against the exact
//! answer, changes that must be noticed.

pub mod cosim;
pub mod journal;
pub mod mutation;
pub mod process;
pub mod stress;
pub mod synth;
