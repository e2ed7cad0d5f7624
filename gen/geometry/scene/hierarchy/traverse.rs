//! Simultaneous traversal of two trees.

use super::realign::Realignment;
use super::{DopTree, Statistics};
use crate::scene::Pose;
use crate::scene::split::Node;
use std::ops::ControlFlow;

/// Memory that queries use one after the other.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    /// The realigned DOPs of B.
    offsets: Vec<i32>,
    /// Which of them are there.
    known: Vec<bool>,
    /// Pairs of nodes that overlap and have not been visited.
    open: Vec<(usize, usize)>,
}

/// All pairs (triangle of A, triangle of B) whose DOPs overlap with B in `pose` as seen from A, in ascending order. No
/// pair with a common point is missing, whatever the doubles are.
///
/// # Panics
/// If the trees have different sets of directions.
pub fn pairs(a: &DopTree, b: &DopTree, pose: &Pose, scratch: &mut Scratch) -> (Vec<(u32, u32)>, Statistics) {
    let mut pairs = vec![];
    let (statistics, _) = traverse(a, b, pose, scratch, |pair| {
        pairs.push(pair);
        ControlFlow::<()>::Continue(())
    });
    pairs.sort_unstable();
    (pairs, statistics)
}

/// The first pair, in the order of the traversal, that `hits` says yes to; nothing is done after it.
///
/// # Panics
/// If the trees have different sets of directions.
pub fn first_hit(
    a: &DopTree,
    b: &DopTree,
    pose: &Pose,
    scratch: &mut Scratch,
    mut hits: impl FnMut((u32, u32)) -> bool,
) -> (Option<(u32, u32)>, Statistics) {
    let (statistics, hit) = traverse(a, b, pose, scratch, |pair| match hits(pair) {
        true => ControlFlow::Break(pair),
        false => ControlFlow::Continue(()),
    });
    (hit, statistics)
}

/// Visits the pairs of leaves that overlap, depth first, until `visit` breaks.
fn traverse<T>(
    a: &DopTree,
    b: &DopTree,
    pose: &Pose,
    scratch: &mut Scratch,
    mut visit: impl FnMut((u32, u32)) -> ControlFlow<T>,
) -> (Statistics, Option<T>) {
    assert_eq!(a.directions, b.directions, "the trees have the same directions");
    let mut query =
        Query { a, b, realignment: Realignment::new(a, b, pose), scratch, statistics: Statistics::default() };
    query.scratch.open.clear();
    query.scratch.known.clear();
    query.scratch.known.resize(b.len(), false);
    query.scratch.offsets.resize(b.offsets.len(), 0);
    if !a.is_empty() && !b.is_empty() {
        query.test(0, 0);
    }
    while let Some((i, j)) = query.scratch.open.pop() {
        query.statistics.nodes_visited += 1;
        match (a.nodes[i], b.nodes[j]) {
            (Node::Leaf(p), Node::Leaf(q)) => {
                query.statistics.pairs_tested += 1;
                if let ControlFlow::Break(found) = visit((p, q)) {
                    return (query.statistics, Some(found));
                }
            }
            (Node::Leaf(_), Node::Inner(right)) => [j + 1, right as usize].into_iter().for_each(|j| query.test(i, j)),
            (Node::Inner(right), Node::Leaf(_)) => [i + 1, right as usize].into_iter().for_each(|i| query.test(i, j)),
            (Node::Inner(right), Node::Inner(other)) => {
                for i in [i + 1, right as usize] {
                    [j + 1, other as usize].into_iter().for_each(|j| query.test(i, j));
                }
            }
        }
    }
    (query.statistics, None)
}

/// A traversal at work.
struct Query<'a> {
    a: &'a DopTree,
    b: &'a DopTree,
    realignment: Realignment,
    scratch: &'a mut Scratch,
    statistics: Statistics,
}

impl Query<'_> {
    /// Tests two nodes and remembers them if they overlap.
    fn test(&mut self, i: usize, j: usize) {
        let k = self.a.directions.count();
        let there = &mut self.scratch.offsets[j * k..][..k];
        if !self.scratch.known[j] {
            self.scratch.known[j] = true;
            self.statistics.transforms += 1;
            self.realignment.realign(self.b.dop(j), there);
            // Each beside what it is compared with, the offset of A on the opposite direction.
            there.chunks_exact_mut(2).for_each(|pair| pair.swap(0, 1));
        }
        self.statistics.overlap_tests += 1;
        if overlap(self.a.dop(i), there) {
            self.scratch.open.push((i, j));
        }
    }
}

/// Whether two DOPs in the same frame overlap in all their directions; touching counts. `there` has its offsets at the places of
/// the opposite directions. Apart in direction h means that the greatest projection of one on h is below the least of the
/// other, which is minus its offset on the opposite of h.
fn overlap(here: &[i32], there: &[i32]) -> bool {
    match here.len() {
        6 => together::<6>(here, there),
        14 => together::<14>(here, there),
        18 => together::<18>(here, there),
        _ => together::<26>(here, there),
    }
}

/// Whether no sum is negative: all are made at once, without a branch between them, in the lanes of vector registers.
fn together<const K: usize>(here: &[i32], there: &[i32]) -> bool {
    let (here, there) = (&here[..K], &there[..K]);
    (0..K).fold(0, |signs, h| signs | (here[h] + there[h])) >= 0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dops_that_touch_overlap() {
        // From -3 to 5, from 0 to 2 and at 0 on the three axes; the other one begins where that ends, or ends where that begins.
        let here = [5, 3, 2, 0, 0, 0];
        let overlap = |[a, b, c, d]: [i32; 4]| overlap(&here, &[b, a, d, c, 0, 0]);
        assert!(overlap([9, -5, 1, 1]) && overlap([-3, 9, 1, 1]));
        assert!(!overlap([9, -6, 1, 1]) && !overlap([-4, 9, 1, 1]));
        assert!(overlap([0, 0, 0, 7]) && !overlap([0, 0, -1, 7]));
        assert!(overlap([0, 0, 7, -2]) && !overlap([0, 0, 7, -3]));
    }
}
