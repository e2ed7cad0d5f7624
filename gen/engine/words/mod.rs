//! The words of an engine (docs/engine.md): what it takes, what it answers, and what it reads from memory.
//!
//! Where a field has the same place in every engine, it is said here; the places that depend on its options are in the
//! [`format`](mod@crate::format).

mod answer;
mod memory;
mod query;
mod sums;
#[cfg(test)]
mod tests;

pub use answer::{EngineAnswer, EngineReport, Reason};
// For the memory model of the testbench.
#[doc(hidden)]
pub use memory::{BlockLayout, LEAF_BIT, LINK_NUMBER_BITS, NO_CHILD, TriangleLayout};
pub use query::{Command, QueryFlags};
pub use sums::Sums;
