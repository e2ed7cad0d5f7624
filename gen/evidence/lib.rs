//! What shows that the unit is right, and what it costs: simulators and synthesis tools on the generated files, campaigns
//! against the exact answer, changes that must be noticed, accuracy against time.

pub mod accuracy;
pub mod cosim;
pub mod effects;
pub mod mutation;
mod plot;
pub mod process;
pub mod soak;
pub mod stress;
pub mod synth;
pub mod times;
pub mod wall;
