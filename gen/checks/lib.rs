//! What shows that the unit is right: simulators and synthesis tools on the generated files, campaigns against the exact
//! answer, changes that must be noticed.

pub mod cosim;
// For campaigns that go on where they stopped.
#[doc(hidden)]
pub mod journal;
pub mod mutation;
// For whoever starts tools.
#[doc(hidden)]
pub mod process;
pub mod stress;
pub mod synth;
