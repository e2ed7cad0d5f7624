//! Fixed-point dataflow designs as hardware: built as graphs with proven ranges, scheduled for a device, lowered to
//! netlists, simulated, estimated, drawn and printed as VHDL-93.
//!
//! A module knows those before it alone: [`number`], [`types`], [`device`], [`expression`] (of VHDL), [`cells`], [`op`] (all there is
//! to know of an operation), [`graph`] (the builder), [`schedule`], [`netlist`], and their readers [`estimate`], [`vhdl`],
//! [`diagram`] and [`dump`]. [`tools`] finds the programs that read what is printed.

// For the synthesis checks, which count the same cells.
#[doc(hidden)]
pub mod cells;
pub mod device;
pub mod diagram;
pub mod dump;
pub mod estimate;
// For the operations, which write their own VHDL.
#[doc(hidden)]
pub mod expression;
pub mod graph;
pub mod netlist;
pub mod number;
pub mod op;
pub mod schedule;
#[doc(hidden)]
pub mod testing;
// For whoever runs the tools: checks and testbench.
#[doc(hidden)]
pub mod tools;
pub mod types;
pub mod vhdl;
