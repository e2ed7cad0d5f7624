//! Logic in cells: gates on single bits, and words of them with carry chains and multipliers between.

mod gates;
mod words;

pub use gates::{Bit, Gate, Gates};
pub use words::{Chain, Source, Word, Words, number, resized};
