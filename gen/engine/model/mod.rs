//! The reference model of the collision engine (docs/engine.md), in exact integers and without time: blocks, the test of two
//! volumes, the traversal and the report.

mod block;
mod by_number;
mod overlap;
mod query;
#[cfg(test)]
mod tests;
mod traversal;
mod triangle;

// For the tests of the volume unit.
#[doc(hidden)]
pub use block::{BadBlock, Block, Link, Volume};
// For the tests of the volume unit.
pub use by_number::ByNumber;
#[doc(hidden)]
pub use overlap::{Distance, Frame, QueryRow, apart, bounds, distance, overlap};
pub use query::{Query, Side};
pub use traversal::{EngineOutcome, Model, Opened, Visits};
// For the tests of the volume unit.
#[doc(hidden)]
pub use triangle::Triangle;
