//! Open synthesis tools on the generated VHDL: Yosys' counts and nextpnr's clock beside what the device model predicts.

pub mod slices;
pub mod static_timing;
