//! The dataflow graph: nodes in blocks, written with copyable handles and bundles of them.
//!
//! A [`Block`] is a named graph with ports; blocks contain instances of blocks. Time enters in two steps only. A pair
//! occupies a *slot* of `interval` clocks (the initiation interval), and a value is either *per pair* (held for the slot)
//! or *per phase* (another one in each clock of the slot). A block is shared over the phases with [`Phases`]: a value for
//! each phase, from which operand multiplexers and capture registers follow. Clocks proper appear only when a block is
//! [scheduled](crate::schedule).
//!
//! What a value is called follows from the structure: a [bundle](Bundle) is named as a whole, and what was given no name
//! is called after what reads it. Every value's range is known when it is made, and one that does not fit is refused
//! there.

mod build;
mod bundle;
pub mod evaluate;
// For the tests of operators.
mod block;
#[doc(hidden)]
pub mod flat;
mod instance;
mod names;
mod phases;
mod place;
mod signals;
mod vector;

pub use build::{Library, Sig, Top};
pub use bundle::Bundle;
pub use instance::{Port, Ports, instance};
pub use phases::Phases;
// For printing.
pub use block::{Block, Fact, Node, NodeId, Op, Probe, Rate, Section};
#[doc(hidden)]
pub use place::{Place, Step, append_step};
pub use signals::Signals;
pub use vector::Vec3;
