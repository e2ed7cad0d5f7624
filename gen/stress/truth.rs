//! The exact answers that verdicts are compared with, each from formulations that share no code.

use super::posed::Posed;
use crate::exact::{self, linear_programme, Exact};
use crate::golden::pair_file::Points;

/// What each formulation says, by name.
pub(super) type Answers = Vec<(&'static str, Exact)>;

const FIRST: &str = "separating planes";
const SECOND: &str = "linear programme";

/// All formulations for a pair in one frame.
pub(super) fn loose(points: &Points) -> Answers {
    vec![(FIRST, exact::pair(points)), (SECOND, linear_programme::relation(points).class)]
}

/// All formulations for a pair under a pose.
pub(super) fn posed(posed: &Posed) -> Answers {
    let Posed { a, b, motion } = posed;
    let second = linear_programme::posed_relation(a, b, &motion.m, &motion.t).class;
    vec![(FIRST, exact::posed_pair(a, b, &motion.m, &motion.t)), (SECOND, second)]
}
