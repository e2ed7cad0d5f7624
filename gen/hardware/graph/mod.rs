//! The hardware description: typed nodes in units, and their readers.
//!
//! A [`Unit`] is a named dataflow graph with ports; units contain instances of units. Time enters in two steps only.
//! A set of inputs, a pair, occupies a *slot* of `interval` clocks (the initiation interval); a node is either *per pair*
//! (one value, held for the slot) or *per phase* (another value in each clock of the slot). [`Builder::choose`] brings
//! per-pair values into phases, [`Builder::hold`] takes one phase out: resource sharing is written with these two
//! and nothing else. Clocks proper appear only when a unit is [scheduled](schedule).
//!
//! Readers of one graph:
//! * [`evaluate`]: untimed integers, every node in every phase;
//! * [`range`]: static range analysis, the proof that nothing overflows;
//! * [`schedule`], [`lower`] and [`netlist`]: clocks, registers, modules;
//! * [`simulate`]: the modules, clock by clock;
//! * [`vhdl`](crate::vhdl): the modules, as text.

mod constraints;
mod cut;
pub mod estimate;
pub mod evaluate;
pub mod flat;
pub mod lower;
pub mod netlist;
pub mod op;
pub mod programme;
pub mod range;
pub mod schedule;
pub mod simulate;
mod unit;

pub use op::{Fact, Op, Range, Type};
pub use unit::{Builder, Input, Node, NodeId, Rate, Unit};
