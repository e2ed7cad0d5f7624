//! What checks a design in a simulator: stimuli, vector files, the testbench.

pub mod register_script;
mod stimulus;
pub mod stream_vectors;
pub mod testbench;
pub mod vectors;

pub use vectors::Stimulus;
