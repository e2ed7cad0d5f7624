//! Simultaneous traversal of two trees.

use super::family::{Group, Members, overlap};
use super::realign::Realignment;
use super::{Directions, DopTree, Statistics};
use crate::collide::Pose;
use crate::collide::pieces::{MOST, rows};
use pulp::{Arch, Simd, WithSimd};
use std::convert::Infallible;

/// Pairs that [`batches`] hands on at once, about: few enough to stay in the second cache with what is made of them.
const BATCH: usize = 1 << 12;

/// Memory that queries use one after the other.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    /// The realigned families of B.
    families: Vec<Group>,
    /// The query that has made each of them.
    made_by: Vec<u32>,
    /// The number of the query.
    query: u32,
    /// Nodes to be opened against each other: the first `height` ones.
    open: Vec<(Members, Members)>,
    height: usize,
    /// Leaves that overlap: the first `count` ones.
    leaves: Vec<(Members, Members)>,
    count: usize,
    /// The triangles of these.
    pairs: Vec<(u32, u32)>,
}

/// All pairs (triangle of A, triangle of B) whose DOPs overlap with B in `pose` as seen from A, in ascending order, all in
/// memory. No pair with a common point is missing, whatever the doubles are.
///
/// # Panics
/// If the trees have different sets of directions.
pub fn pairs(a: &DopTree, b: &DopTree, pose: &Pose, scratch: &mut Scratch) -> (Vec<(u32, u32)>, Statistics) {
    let mut all = vec![];
    let statistics = batches(a, b, pose, scratch, |pairs| all.extend_from_slice(pairs));
    sort(&mut all);
    (all, statistics)
}

/// Calls `visit` with the same pairs, some at a time, in the order in which they are found, which is the same every time. The fastest
/// of all.
///
/// # Panics
/// If the trees have different sets of directions.
pub fn batches(
    a: &DopTree,
    b: &DopTree,
    pose: &Pose,
    scratch: &mut Scratch,
    mut visit: impl FnMut(&[(u32, u32)]),
) -> Statistics {
    let mut query = Query::new(a, b, pose, scratch);
    query.begin(a.root(), b.root());
    while let Some(pairs) = query.next(BATCH) {
        visit(pairs);
    }
    query.statistics
}

/// Calls `visit` with the same pairs in ascending order, in one piece or several.
///
/// # Panics
/// If the trees have different sets of directions.
pub fn pieces(
    a: &DopTree,
    b: &DopTree,
    pose: &Pose,
    scratch: &mut Scratch,
    mut visit: impl FnMut(&[(u32, u32)]),
) -> Statistics {
    let mut few = vec![];
    let statistics = batches(a, b, pose, scratch, |pairs| {
        if few.len() <= MOST {
            few.extend_from_slice(pairs);
        }
    });
    if few.len() <= MOST {
        sort(&mut few);
        visit(&few);
        return statistics;
    }
    let mut query = Query::new(a, b, pose, scratch);
    let members = a.members();
    let row = |leaf: usize, pairs: &mut Vec<(u32, u32)>| {
        query.begin(Some(members[leaf].0), b.root());
        while let Some(found) = query.next(BATCH) {
            pairs.extend_from_slice(found);
        }
    };
    let Ok(()) = rows(&a.nodes, row, |pairs| {
        visit(pairs);
        Ok::<(), Infallible>(())
    });
    statistics
}

/// The first pair, in the order in which they are found, that `hits` says yes to; nothing is done after it.
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
    let mut query = Query::new(a, b, pose, scratch);
    query.begin(a.root(), b.root());
    while let Some(pairs) = query.next(1) {
        let untested = pairs.len() as u64;
        if let Some(place) = pairs.iter().position(|&pair| hits(pair)) {
            let hit = pairs[place];
            query.statistics.pairs_tested -= untested - 1 - place as u64;
            return (Some(hit), query.statistics);
        }
    }
    (None, query.statistics)
}

fn sort(pairs: &mut [(u32, u32)]) {
    pairs.sort_unstable_by_key(|&pair| rank(pair));
}

/// The order of pairs as one number.
pub(super) fn rank((p, q): (u32, u32)) -> u64 {
    u64::from(p) << 32 | u64::from(q)
}

/// A traversal at work.
struct Query<'a> {
    a: &'a DopTree,
    b: &'a DopTree,
    realignment: Realignment,
    scratch: &'a mut Scratch,
    statistics: Statistics,
}

impl<'a> Query<'a> {
    fn new(a: &'a DopTree, b: &'a DopTree, pose: &Pose, scratch: &'a mut Scratch) -> Self {
        assert_eq!(a.directions, b.directions, "the trees have the same directions");
        scratch.query = scratch.query.wrapping_add(1);
        if scratch.query == 0 || scratch.made_by.len() < b.links.len() {
            scratch.made_by.clear();
            scratch.made_by.resize(b.links.len(), 0);
            scratch.query = 1;
        }
        if scratch.families.len() < b.families.len() {
            scratch.families.resize(b.families.len(), Group::ZERO);
        }
        Self { a, b, realignment: Realignment::new(a, b, pose), scratch, statistics: Statistics::default() }
    }

    /// Begins with two nodes, if there are both.
    fn begin(&mut self, a: Option<Members>, b: Option<Members>) {
        let Scratch { open, height, count, .. } = self.scratch;
        (*height, *count) = (0, 0);
        if let Some(nodes) = a.zip(b) {
            open.clear();
            open.push(nodes);
            *height = 1;
        }
    }

    /// At least so many more pairs, or all that are left; nothing if none is.
    fn next(&mut self, least: usize) -> Option<&[(u32, u32)]> {
        Arch::new().dispatch(Opening { query: self, least });
        let Scratch { leaves, count, pairs, .. } = self.scratch;
        let triangles = |&(p, q): &(Members, Members)| (self.a.triangle(p), self.b.triangle(q));
        pairs.clear();
        pairs.extend(leaves[..*count].iter().map(triangles));
        *count = 0;
        self.statistics.pairs_tested += pairs.len() as u64;
        (!pairs.is_empty()).then_some(pairs)
    }

    /// Opens nodes depth first until there are enough pairs of leaves.
    #[inline(always)]
    fn open<const GROUPS: usize>(&mut self, least: usize) {
        let Self { a, b, realignment, scratch, statistics } = self;
        let Scratch { families, made_by, query, open, height, leaves, count, .. } = &mut **scratch;
        let (of_a, _) = a.families.as_chunks::<GROUPS>();
        let (of_b, _) = b.families.as_chunks::<GROUPS>();
        let (realigned, _) = families.as_chunks_mut::<GROUPS>();
        while *height > 0 && *count < least {
            *height -= 1;
            let (p, q) = open[*height];
            let there = &mut realigned[q.family()];
            let maker = &mut made_by[q.family()];
            if *maker != *query {
                *maker = *query;
                statistics.transforms += b.children(q.family());
                realignment.realign(&of_b[q.family()], there);
            }
            let tested = p.pairs(q);
            let hits = overlap(&of_a[p.family()], there) & tested;
            statistics.overlap_tests += u64::from(tested.count_ones());
            statistics.nodes_visited += u64::from(hits.count_ones());
            // Every pair is written where it would belong in either list, and each list grows by those that do: which they are
            // cannot be foreseen.
            let (links_a, links_b) = (a.links[p.family()], b.links[q.family()]);
            let (inner, pairs) = (room(open, *height), room(leaves, *count));
            let (mut inners, mut found) = (0, 0);
            for pair in 0..4 {
                let (p, q) = (links_a[pair >> 1], links_b[pair & 1]);
                let hit = (hits >> pair & 1) as usize;
                let leaf = hit & p.single() & q.single();
                inner[inners & 3] = (p, q);
                pairs[found & 3] = (p, q);
                inners += hit - leaf;
                found += leaf;
            }
            *height += inners;
            *count += found;
        }
    }
}

/// Four places of a list from a place on; the list grows if it has to.
#[inline(always)]
fn room(list: &mut Vec<(Members, Members)>, from: usize) -> &mut [(Members, Members); 4] {
    if list.len() < from + 4 {
        list.resize(2 * from + 4, Default::default());
    }
    list[from..].first_chunk_mut().expect("there are four places")
}

/// [`Query::open`], compiled for the widest vectors of the processor.
struct Opening<'a, 'b> {
    query: &'a mut Query<'b>,
    least: usize,
}

impl WithSimd for Opening<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { query, least } = self;
        match query.a.directions {
            Directions::Six => query.open::<2>(least),
            Directions::Fourteen => query.open::<4>(least),
            Directions::Eighteen => query.open::<5>(least),
            Directions::TwentySix => query.open::<7>(least),
        }
    }
}
