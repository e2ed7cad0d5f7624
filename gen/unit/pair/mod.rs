//! What the unit reads and answers: a pair of triangles under a pose, and its verdict.

mod input;
mod verdict;

pub use input::{Input, Pair, Pose};
pub use verdict::{Outcome, Verdict};
