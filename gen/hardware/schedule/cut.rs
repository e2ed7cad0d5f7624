//! Minimum cuts of small networks, by shortest augmenting paths (Dinic).

use std::collections::VecDeque;

/// A capacity that no cut pays.
pub const UNLIMITED: i64 = i64::MAX / 4;

/// A network of directed edges with capacities.
#[derive(Clone, Debug, Default)]
pub struct Network {
    /// Edges leaving each node, as indices into `ends`.
    leaving: Vec<Vec<usize>>,
    /// Head and remaining capacity; edge `i ^ 1` is edge `i` reversed.
    ends: Vec<(usize, i64)>,
}

impl Network {
    /// A network without edges.
    pub fn new(nodes: usize) -> Self {
        Self { leaving: vec![vec![]; nodes], ends: vec![] }
    }

    /// Adds an edge.
    pub fn edge(&mut self, from: usize, to: usize, capacity: i64) {
        self.leaving[from].push(self.ends.len());
        self.ends.push((to, capacity));
        self.leaving[to].push(self.ends.len());
        self.ends.push((from, 0));
    }

    /// The least side of the source among all minimum cuts between `source` and `sink`: one flag a node.
    pub fn source_side(mut self, source: usize, sink: usize) -> Vec<bool> {
        loop {
            let level = self.levels(source);
            if level[sink].is_none() {
                return level.into_iter().map(|l| l.is_some()).collect();
            }
            let mut next = vec![0; self.leaving.len()];
            while self.augment(source, sink, &level, &mut next) {}
        }
    }

    /// Distance from the source over edges that have capacity left.
    fn levels(&self, source: usize) -> Vec<Option<u32>> {
        let mut level = vec![None; self.leaving.len()];
        level[source] = Some(0);
        let mut queue = VecDeque::from([source]);
        while let Some(node) = queue.pop_front() {
            for edge in &self.leaving[node] {
                let (to, capacity) = self.ends[*edge];
                if capacity > 0 && level[to].is_none() {
                    level[to] = level[node].map(|l| l + 1);
                    queue.push_back(to);
                }
            }
        }
        level
    }

    /// Sends flow along one path of rising levels, if there is one. `next` skips edges found useless before.
    fn augment(&mut self, source: usize, sink: usize, level: &[Option<u32>], next: &mut [usize]) -> bool {
        let mut path: Vec<usize> = vec![];
        let mut node = source;
        while node != sink {
            if let Some(edge) = self.leaving[node].get(next[node]).copied() {
                let (to, capacity) = self.ends[edge];
                if capacity > 0 && level[to] == level[node].map(|l| l + 1) {
                    path.push(edge);
                    node = to;
                } else {
                    next[node] += 1;
                }
            } else if let Some(edge) = path.pop() {
                node = self.ends[edge ^ 1].0;
                next[node] += 1;
            } else {
                return false;
            }
        }
        let flow = path.iter().map(|edge| self.ends[*edge].1).min().unwrap_or(0);
        for edge in path {
            self.ends[edge].1 -= flow;
            self.ends[edge ^ 1].1 += flow;
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a side costs: the capacity of the edges that leave it.
    fn cost(edges: &[(usize, usize, i64)], side: impl Fn(usize) -> bool) -> i64 {
        edges.iter().filter(|(a, b, _)| side(*a) && !side(*b)).map(|e| e.2).sum()
    }

    #[test]
    fn the_cut_is_the_least_of_all() {
        // All sides of pseudo-random networks of eight nodes, source 0, sink 7.
        let mut state = 1u64;
        let mut random = |n: u64| {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 33) % n
        };
        for _ in 0..200 {
            let edges: Vec<(usize, usize, i64)> =
                (0..20).map(|_| (random(8) as usize, random(8) as usize, random(9) as i64)).collect();
            let mut network = Network::new(8);
            for (a, b, c) in &edges {
                network.edge(*a, *b, *c);
            }
            let side = network.source_side(0, 7);
            let best = (0..1u32 << 6).map(|bits| cost(&edges, |n| n == 0 || (n < 7 && bits >> (n - 1) & 1 == 1))).min();
            assert!(side[0] && !side[7]);
            assert_eq!(Some(cost(&edges, |n| side[n])), best, "{edges:?}");
        }
    }
}
