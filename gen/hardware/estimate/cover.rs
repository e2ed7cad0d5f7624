//! Covering gates by look-up tables: cuts of at most k leaves, first the shallowest, then the cheapest by area flow.
//!
//! A cut of a gate is a set of gates from which it can be computed; one look-up table does it if the set has at most k
//! members. As synthesis does, the first cover makes every gate as early as it can be; the ones after it take cheaper
//! cuts where no root gets later than the latest of the first. Area flow shares the price of a leaf among its users,
//! which are those of the gates at first; each cover then moves the numbers a third of the way to its own, so that a
//! gate that one cover passes over is not given up.

use crate::cells::{Bit, Gate, Gates};
use std::collections::HashMap;

/// Cuts kept for a gate.
const CUTS: usize = 12;

/// Covers tried, each from the users of the one before.
const ROUNDS: usize = 4;

/// Most inputs of a look-up table, of all devices.
const MOST_INPUTS: usize = 6;

/// Carry chains as mapping sees them: a cut that is late before a long chain makes the whole late.
#[derive(Default)]
pub(super) struct Passages {
    /// For a bit that leaves a chain, those from which it comes.
    pub before: HashMap<usize, Vec<Bit>>,
    /// Tables in a row that take as long.
    pub levels: u32,
}

impl Passages {
    /// What leaves a chain, with what goes into it and the levels between. A chain behind another ripples along with it,
    /// which takes half.
    fn entries(&self, gate: usize) -> impl Iterator<Item = (usize, u32)> + '_ {
        let before = self.before.get(&gate).into_iter().flatten().map(|bit| bit.gate());
        before.map(|gate| (gate, if self.before.contains_key(&gate) { self.levels.div_ceil(2) } else { self.levels }))
    }
}

/// A set of gates in ascending order. It is small and made by the hundred thousand, so it lies in place.
#[derive(Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
struct Leaves {
    all: [u32; MOST_INPUTS],
    count: usize,
}

impl Leaves {
    fn of(gate: usize) -> Self {
        let mut leaves = Self { count: 1, ..Self::default() };
        leaves.all[0] = gate as u32;
        leaves
    }

    fn iter(&self) -> impl Iterator<Item = usize> + '_ {
        self.all[..self.count].iter().map(|leaf| *leaf as usize)
    }

    /// The union with another set, if it has at most so many members.
    fn union(&self, other: &Self, most: usize) -> Option<Self> {
        let mut union = Self::default();
        let (mut a, mut b) = (&self.all[..self.count], &other.all[..other.count]);
        while let Some(least) = a.first().into_iter().chain(b.first()).min().copied() {
            if union.count == most {
                return None;
            }
            union.all[union.count] = least;
            union.count += 1;
            a = &a[usize::from(a.first() == Some(&least))..];
            b = &b[usize::from(b.first() == Some(&least))..];
        }
        Some(union)
    }
}

#[derive(Clone, Copy)]
struct Cut {
    leaves: Leaves,
    flow: f64,
    /// Tables in a row.
    depth: u32,
}

/// The look-up tables that compute `roots`, by their number of inputs (entry i: those with i inputs), at `prices[i]`
/// for a table of i inputs; at most as many inputs as there are prices, less one.
///
/// # Panics
/// If tables have more inputs than those of any device.
pub(super) fn cover(gates: &Gates, roots: &[Bit], prices: &[f64], passages: &Passages) -> Vec<u64> {
    assert!(prices.len() <= MOST_INPUTS + 1);
    let mut users = vec![0u32; gates.all.len()];
    for gate in needed(gates, roots) {
        gates.all[gate].operands().for_each(|o| users[o] += 1);
    }
    roots.iter().for_each(|r| users[r.gate()] += 1);
    let mut shares: Vec<f64> = users.iter().map(|n| f64::from(*n)).collect();
    let mut required: Vec<u32> = vec![0; gates.all.len()];
    let mut latest = None;
    let mut best: Option<(f64, Vec<u64>)> = None;
    for _ in 0..ROUNDS {
        let cuts = choose(gates, &shares, prices, &required, passages);
        let end = *latest.get_or_insert_with(|| roots.iter().map(|r| cuts[r.gate()].depth).max().unwrap_or(0));
        let mut tables = vec![0; prices.len()];
        users.iter_mut().for_each(|n| *n = 0);
        required.iter_mut().for_each(|r| *r = u32::MAX);
        for root in roots {
            users[root.gate()] += 1;
            required[root.gate()] = end;
        }
        // Gates are in order, so that the users of each come after it.
        for gate in (0..gates.all.len()).rev() {
            if users[gate] == 0 {
                continue;
            }
            if matches!(gates.all[gate], Gate::Zero | Gate::Leaf) {
                for (before, levels) in passages.entries(gate) {
                    required[before] = required[before].min(required[gate].saturating_sub(levels));
                }
                continue;
            }
            let leaves = &cuts[gate].leaves;
            tables[leaves.count] += 1;
            for leaf in leaves.iter() {
                users[leaf] += 1;
                required[leaf] = required[leaf].min(required[gate].saturating_sub(1));
            }
        }
        shares.iter_mut().zip(&users).for_each(|(share, n)| *share = (2.0 * *share + f64::from(*n)) / 3.0);
        let price = tables.iter().zip(prices).map(|(n, price)| *n as f64 * price).sum();
        if best.as_ref().is_none_or(|b| price < b.0) {
            best = Some((price, tables));
        }
    }
    best.map_or(vec![], |b| b.1)
}

/// The gates on which the roots depend.
fn needed(gates: &Gates, roots: &[Bit]) -> Vec<usize> {
    let mut seen = vec![false; gates.all.len()];
    let mut open: Vec<usize> = roots.iter().map(|r| r.gate()).collect();
    let mut all = vec![];
    while let Some(gate) = open.pop() {
        if !std::mem::replace(&mut seen[gate], true) {
            all.push(gate);
            open.extend(gates.all[gate].operands());
        }
    }
    all
}

/// The best cut of every gate: the cheapest that is not later than required, else the shallowest.
fn choose(gates: &Gates, shares: &[f64], prices: &[f64], required: &[u32], passages: &Passages) -> Vec<Cut> {
    let most = prices.len() - 1;
    // One after another, with where those of each gate begin.
    let (mut cuts, mut starts): (Vec<Cut>, Vec<usize>) = (vec![], vec![0]);
    let (mut unions, mut larger, mut own) = (vec![], vec![], vec![]);
    for (i, gate) in gates.all.iter().enumerate() {
        let first = |gate: usize| cuts[starts[gate]];
        if matches!(gate, Gate::Zero | Gate::Leaf) {
            let leaves = if *gate == Gate::Leaf { Leaves::of(i) } else { Leaves::default() };
            let depth = passages.entries(i).map(|(before, levels)| first(before).depth + levels).max().unwrap_or(0);
            cuts.push(Cut { leaves, flow: 0.0, depth });
            starts.push(cuts.len());
            continue;
        }
        unions.push(Leaves::default());
        for operand in gate.operands() {
            let with = &cuts[starts[operand]..starts[operand + 1]];
            for union in unions.drain(..) {
                larger.extend(with.iter().filter_map(|cut| union.union(&cut.leaves, most)));
            }
            std::mem::swap(&mut unions, &mut larger);
        }
        let price = |leaves: Leaves| {
            let below: f64 = leaves.iter().map(|leaf| first(leaf).flow).sum();
            let depth = leaves.iter().map(|leaf| first(leaf).depth).max().unwrap_or(0) + 1;
            Cut { leaves, flow: below + prices[leaves.count], depth }
        };
        own.extend(unions.drain(..).map(price));
        let key = |cut: &Cut| if cut.depth <= required[i] { 0 } else { cut.depth };
        own.sort_unstable_by(|a, b| {
            let by_depth = key(a).cmp(&key(b));
            by_depth.then(a.flow.total_cmp(&b.flow)).then_with(|| a.leaves.cmp(&b.leaves))
        });
        own.dedup_by(|a, b| a.leaves == b.leaves);
        // The shallowest stays, whatever its price.
        let shallowest = own.iter().min_by_key(|cut| cut.depth).copied();
        own.truncate(CUTS);
        own.extend(shallowest);
        // What users of this gate pay when they take it as a leaf; the cut that computes it comes first.
        own[0].flow /= shares[i].max(1.0);
        own.push(Cut { leaves: Leaves::of(i), ..own[0] });
        cuts.append(&mut own);
        starts.push(cuts.len());
    }
    starts[..gates.all.len()].iter().map(|start| cuts[*start]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const FOUR: [f64; 5] = [0.0, 1.0, 1.0, 1.0, 1.0];

    fn tables(gates: &Gates, roots: &[Bit]) -> u64 {
        cover(gates, roots, &FOUR, &Passages::default()).iter().sum()
    }

    #[test]
    fn a_table_takes_what_has_four_inputs() {
        let mut gates = Gates::default();
        let x: Vec<Bit> = (0..8).map(|_| gates.leaf()).collect();
        let four = gates.any(&x[..4]);
        let eight = gates.any(&x);
        assert_eq!(tables(&gates, &[four]), 1);
        assert_eq!(tables(&gates, &[!four]), 1, "complements are absorbed");
        assert_eq!(tables(&gates, &[eight]), 3);
        assert_eq!(tables(&gates, &[eight, four]), 3, "what is there already is used");
        assert_eq!(tables(&gates, &[x[0], !x[1], Bit::ONE]), 0, "copies take none");
    }

    #[test]
    fn a_choice_before_an_exclusive_disjunction_is_one_table() {
        let mut gates = Gates::default();
        let [s, a, b, c] = [0; 4].map(|_| gates.leaf());
        let mux = gates.mux(s, a, b);
        let sum = gates.xor(mux, c);
        assert_eq!(tables(&gates, &[sum]), 1);
        assert_eq!(tables(&gates, &[sum, mux]), 2, "the choice is needed as well");
    }

    #[test]
    fn a_table_as_dear_as_three_is_taken_where_it_is_earlier() {
        let mut gates = Gates::default();
        let x: Vec<Bit> = (0..6).map(|_| gates.leaf()).collect();
        let low = gates.mux(x[0], x[2], x[3]);
        let high = gates.mux(x[0], x[4], x[5]);
        let four_to_one = gates.mux(x[1], low, high);
        let prices = [0.0, 1.0, 1.0, 1.0, 1.0, 2.0, 4.0];
        assert_eq!(cover(&gates, &[four_to_one], &prices, &Passages::default())[6], 1);
        // One root that is late anyway takes the haste away.
        let late = (0..9).fold(x[0], |chain, _| {
            let (and, xor) = (gates.leaf(), gates.leaf());
            let both = gates.and(chain, and);
            gates.xor(both, xor)
        });
        let after = gates.leaf();
        let before = HashMap::from([(after.gate(), vec![x[0]])]);
        let wide = |roots: &[Bit]| cover(&gates, roots, &prices, &Passages::default())[6];
        assert_eq!(wide(&[four_to_one, late]), wide(&[late]));
        // So does a chain that takes as long as two tables, but not for what goes into it.
        let chain = Passages { before, levels: 2 };
        let wide = |passages: &Passages, roots: &[Bit]| cover(&gates, roots, &prices, passages)[6];
        assert_eq!(wide(&chain, &[four_to_one, after]), 0);
        let behind = Passages { before: HashMap::from([(after.gate(), vec![four_to_one])]), levels: 2 };
        assert_eq!(wide(&behind, &[four_to_one, after]), 1);
    }
}
