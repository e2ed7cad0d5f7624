//! The reference model of the collision engine (docs/engine.md), in exact integers and without time: blocks, the test of two
//! volumes, the traversal and the report.

mod block;
mod overlap;
#[cfg(test)]
mod tests;

pub use block::{BadBlock, Block, Link, Volume};
pub use overlap::{Distance, Frame, Row, apart, distance, overlap};
