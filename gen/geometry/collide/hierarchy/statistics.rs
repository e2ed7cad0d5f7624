//! What a query cost, as the literature counts it.

use std::iter::Sum;
use std::ops::Add;

/// The cost of a query.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "scenes", derive(serde::Serialize))]
pub struct Statistics {
    /// Overlap tests of two DOPs.
    pub overlap_tests: u64,
    /// DOPs of B brought to the frame of A; each at most once a query.
    pub transforms: u64,
    /// Pairs of nodes that overlap, leaves included.
    pub nodes_visited: u64,
    /// Pairs of triangles handed to the triangle test.
    pub pairs_tested: u64,
}

impl Add for Statistics {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            overlap_tests: self.overlap_tests + other.overlap_tests,
            transforms: self.transforms + other.transforms,
            nodes_visited: self.nodes_visited + other.nodes_visited,
            pairs_tested: self.pairs_tested + other.pairs_tested,
        }
    }
}

impl Sum for Statistics {
    fn sum<I: Iterator<Item = Self>>(list: I) -> Self {
        list.fold(Self::default(), Add::add)
    }
}
