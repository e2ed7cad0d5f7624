//! Vectors chosen to kill: pairs on whose axes a comparison is decided by a single ulp.
//!
//! A bound that is one ulp off shows in a flag only where that bound is at the edge of flipping it. Random pairs
//! near contact seldom have such an axis, so half of the pairs are chosen: from many random ones those that together
//! have most axes, comparisons and vertices at the edge. A quarter fills the working grid to its ends, where clamps act.

use crate::artefact::Stimulus;
use crate::golden::{Golden, Input, Pair, Pose};
use crate::params::{Params, Transform};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use std::collections::{BTreeMap, HashSet};

/// Random pairs to choose from, for each one chosen.
const CHOICE: usize = 32;
/// The fewest and the most random pairs to choose from.
const SMALLEST: usize = 512;
const LARGEST: usize = 8192;
/// The most pairs that are chosen.
const MOST_CHOSEN: usize = 128;

/// A comparison at the edge: axis, which of the four, what is lacking (0 or 1 ulp), and the vertices of A and of B.
type Edge = (usize, usize, i128, usize, usize);

/// `count` pairs: of four two chosen, one at the ends of the working grid, and one random, every other time with an edge
/// of one ulp.
pub fn stimulus(params: &Params, count: usize, seed: u64) -> Stimulus {
    let pool = Stimulus::random(params, (count * CHOICE).clamp(SMALLEST, LARGEST), seed);
    let all: Vec<(Pose, Pair)> =
        pool.segments.iter().flat_map(|(pose, pairs)| pairs.iter().map(move |pair| (*pose, *pair))).collect();
    let (golden, bound) = (Golden::new(params), params.coordinate_bound() as i64);
    let edges: Vec<Vec<Edge>> = all.par_iter().map(|(pose, pair)| edges(&golden, pose, pair)).collect();
    let chosen = cover(&edges, (count / 2).min(MOST_CHOSEN));
    let mut chosen = chosen.into_iter().map(|i| all[i]);
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    // Strides through the pool, so that few pairs see many poses.
    let mut random = (0..).map(|i| all[(i * 17) % all.len()]);
    let mut segments: Vec<(Pose, Vec<Pair>)> = vec![];
    for number in 0..count {
        let next = match number % 4 {
            0 | 2 => chosen.next(),
            1 if number == 1 && params.transform != Transform::Off => Some(farthest(params)),
            1 => Some((Pose::identity(params), extreme(&mut rng, params))),
            _ => None,
        };
        let Some((pose, mut pair)) = next.or_else(|| random.next()) else { break };
        if number % 8 == 3 {
            // V1 next to V0, so that coordinates and n_A straddle 0.
            let near = |x: Input| Input { lo: (x.lo - 1).max(-bound), sticky: x.sticky };
            pair.a[1] = pair.a[0].map(near);
        }
        match segments.last_mut() {
            Some((last, pairs)) if *last == pose => pairs.push(pair),
            _ => segments.push((pose, vec![pair])),
        }
    }
    Stimulus { segments }
}

/// B as far from A as the declared ranges allow, where magnitudes are greatest.
fn farthest(params: &Params) -> (Pose, Pair) {
    let (one, bound) = (Input::exact(params.one() as i64), params.coordinate_bound() as i64);
    let t = Input::exact(params.translation_bound() as i64);
    let pose = Pose { m: [[one; 3]; 3], t: [t; 3], bypass: false };
    (pose, Pair { a: [[Input::exact(-bound); 3]; 3], b: [[Input::exact(bound); 3]; 3] })
}

/// A pair that fills its box to the last ulp: V0 at or near the origin, the rest next to the same power of two, so that
/// edges and areas reach what the formats allow.
fn extreme(rng: &mut ChaCha8Rng, params: &Params) -> Pair {
    let bound = params.coordinate_bound() as i64;
    // With re-normalisation upper bounds must stay below a power of two, or the pair is scaled down.
    let most = bound.ilog2();
    let bits = if rng.random() { most } else { rng.random_range(2..=most) };
    let reach = if params.renormalise { (1 << bits) - 1 } else { bound };
    let mut number = || {
        let lo = match rng.random_range(0..8) {
            0..=2 => reach - rng.random_range(0..2),
            3..=5 => 1 - reach - rng.random_range(0..2),
            6 => 0,
            _ => rng.random_range(-reach..=reach),
        };
        Input { lo: lo.clamp(-bound, bound), sticky: lo < bound && rng.random() }
    };
    let mut triangle = || [(); 3].map(|()| [(); 3].map(|()| number()));
    let mut pair = Pair { a: triangle(), b: triangle() };
    if params.renormalise {
        pair.a[0] = [Input::exact(0); 3];
    }
    if rng.random() {
        // Half of a face of the box: the greatest area that there is.
        let (i, sign) = (rng.random_range(0..3), if rng.random() { 1 } else { -1 });
        let end = |sign: i64| Input::exact(sign * (reach - 1).max(0));
        for (k, (x, y)) in [(1, 1), (-1, 1), (1, -1)].into_iter().enumerate() {
            pair.b[k][(i + 1) % 3] = end(x * sign);
            pair.b[k][(i + 2) % 3] = end(y);
        }
    }
    pair
}

/// Greedy: each time the entry with most that is new; once all is covered, from the beginning.
fn cover(entries: &[Vec<Edge>], count: usize) -> Vec<usize> {
    let mut chosen: Vec<usize> = vec![];
    let mut covered = HashSet::new();
    while chosen.len() < count.min(entries.len()) {
        let gain = |i: &usize| entries[*i].iter().filter(|edge| !covered.contains(*edge)).count();
        let open = (0..entries.len()).filter(|i| !chosen.contains(i));
        let Some(best) = open.max_by_key(|i| (gain(i), std::cmp::Reverse(*i))) else { break };
        if gain(&best) == 0 && !covered.is_empty() {
            covered.clear();
            continue;
        }
        covered.extend(entries[best].iter().copied());
        chosen.push(best);
    }
    chosen
}

/// The comparisons of a pair that one ulp decides, where no other comparison hides it.
fn edges(golden: &Golden, pose: &Pose, pair: &Pair) -> Vec<Edge> {
    let trace = golden.trace(pose, pair);
    let mut axes: Vec<&str> =
        trace.iter().filter_map(|(name, _)| name.strip_prefix("axis.")?.strip_suffix("_x")).collect();
    axes.dedup();
    let values: BTreeMap<&str, _> = trace.iter().map(|(name, x)| (name.as_str(), *x)).collect();
    let mut found = vec![];
    for (number, axis) in axes.iter().enumerate() {
        let image = |side: char, k: usize| values.get(format!("projection.{axis}.{side}{k}").as_str()).copied();
        let of = |end: &str| values[format!("enclosure.{axis}.{end}").as_str()];
        let vertex = |side, bound: &dyn Fn(crate::number::Interval) -> i128, value| {
            (0..3).find(|k| image(side, *k).is_some_and(|x| bound(x) == value)).unwrap_or(3)
        };
        let (lo, hi) = (|x: crate::number::Interval| x.lo, |x: crate::number::Interval| x.hi);
        let (a_min, a_max, b_min, b_max) = (of("a_min"), of("a_max"), of("b_min"), of("b_max"));
        // Each is positive where the comparison of section 6 holds.
        let apart = [b_min.lo - a_max.hi, a_min.lo - b_max.hi];
        let reach = [b_max.lo - a_min.hi, a_max.lo - b_min.hi];
        let ends = [
            (vertex('v', &hi, a_max.hi), vertex('w', &lo, b_min.lo)),
            (vertex('v', &lo, a_min.lo), vertex('w', &hi, b_max.hi)),
            (vertex('v', &hi, a_min.hi), vertex('w', &lo, b_max.lo)),
            (vertex('v', &lo, a_max.lo), vertex('w', &hi, b_min.hi)),
        ];
        for i in 0..2 {
            if matches!(apart[i], 0 | 1) && apart[1 - i] <= 0 {
                found.push((number, i, apart[i], ends[i].0, ends[i].1));
            }
            if matches!(reach[i], 0 | 1) && reach[1 - i] > 0 {
                found.push((number, 2 + i, reach[i], ends[2 + i].0, ends[2 + i].1));
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chosen_pairs_have_more_comparisons_at_the_edge_than_random_ones() {
        let params = Params::default();
        let golden = Golden::new(&params);
        let count = |stimulus: &Stimulus| -> usize {
            let pairs = stimulus.segments.iter().flat_map(|(pose, pairs)| pairs.iter().map(move |pair| (pose, pair)));
            pairs.map(|(pose, pair)| edges(&golden, pose, pair).len()).sum()
        };
        let chosen = stimulus(&params, 16, 1);
        assert_eq!(chosen.pairs(), 16);
        let random = count(&Stimulus::random(&params, 16, 1));
        assert!(count(&chosen) > 2 * random.max(10), "{} against {random}", count(&chosen));
        assert_eq!(chosen.segments, stimulus(&params, 16, 1).segments);
    }
}
