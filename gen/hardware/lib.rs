//! Fixed-point dataflow designs: built as graphs with proven ranges, scheduled for a device, simulated, estimated, drawn
//! and printed as VHDL-93.

pub mod device;
pub mod diagram;
pub mod graph;
pub mod number;
pub mod vhdl;
