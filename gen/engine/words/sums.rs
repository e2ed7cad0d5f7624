//! Sums over the reports of queries.

use super::EngineReport;
use serde::Serialize;
use std::ops::AddAssign;

/// What queries came to, in counts that do not depend on time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Sums {
    /// How many queries there were.
    pub queries: u64,
    /// Pairs of nodes opened.
    pub expansions: u64,
    /// Pairs of volumes tested.
    pub tests: u64,
    /// Those that may overlap.
    pub survivors: u64,
    /// Those of them that are two triangles.
    pub leaf_pairs: u64,
    /// Pairs of triangles that intersect for certain.
    pub intersect: u64,
    /// Pairs that the unit leaves open.
    pub possibly_incorrect: u64,
    /// The greatest stack of all queries, in entries.
    pub greatest_stack: u64,
}

impl From<&EngineReport> for Sums {
    fn from(report: &EngineReport) -> Self {
        Self {
            queries: 1,
            expansions: report.expansions.into(),
            tests: report.tests.into(),
            survivors: report.survivors.into(),
            leaf_pairs: report.leaf_pairs.into(),
            intersect: report.intersect.into(),
            possibly_incorrect: report.possibly_incorrect.into(),
            greatest_stack: report.stack.into(),
        }
    }
}

impl AddAssign for Sums {
    fn add_assign(&mut self, other: Self) {
        self.queries += other.queries;
        self.expansions += other.expansions;
        self.tests += other.tests;
        self.survivors += other.survivors;
        self.leaf_pairs += other.leaf_pairs;
        self.intersect += other.intersect;
        self.possibly_incorrect += other.possibly_incorrect;
        self.greatest_stack = self.greatest_stack.max(other.greatest_stack);
    }
}
