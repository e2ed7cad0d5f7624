//! Vectors chosen to kill: pairs on whose axes, or of whose determinants, a comparison is decided by a single ulp.
//!
//! A bound that is one ulp off shows in a flag only where that bound is at the edge of flipping it. Random pairs
//! near contact seldom have such an axis, so half of the pairs are made and chosen: in many random ones B is moved until
//! one ulp decides, and of these are taken those that together have most axes, comparisons and vertices at the edge. A
//! quarter fills the working grid to its ends, where clamps act, or is as small as an ulp of the input, where enclosures
//! are as wide as the triangles. In an eighth edges decide: one alone passes through the other triangle, or ends on it.

use super::in_plane;
use efsat_hardware::number::Interval;
use efsat_unit::artefact::Stimulus;
use efsat_unit::golden::Golden;
use efsat_unit::host::sample;
use efsat_unit::pair::{Input, Pair, Pose, Verdict};
use efsat_unit::params::{Method, Params, Transform};
use num_bigint::BigInt;
use num_traits::Signed;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use rayon::prelude::*;
use std::collections::{BTreeMap, HashSet};
use std::iter;

/// Random pairs to choose from, for each one chosen.
const CHOICE: usize = 32;
/// The fewest and the most random pairs to choose from.
const SMALLEST: usize = 512;
const LARGEST: usize = 8192;
/// The most pairs that are chosen.
const MOST_CHOSEN: usize = 160;

/// A comparison at the edge: axis or determinant, which of the four or two, what is lacking (0 or 1 ulp; of a determinant
/// whether it holds), and the ends of A and of B: the vertex that has the bound, and the set of those that nearly have it.
type Edge = (usize, usize, i128, (usize, u8), (usize, u8));

/// What the four comparisons of section 6 lack on an axis, in ulps: each holds where its number is positive. A determinant
/// has two: it is above its bound, or below minus its bound.
type Lacking = [i128; 4];

/// `count` pairs: of four two chosen (of the exact unit three), one at the ends of the working grid or, one in sixteen, tiny (every second of these
/// under a rotation), and one random with an edge of one ulp or with parallel edges.
pub fn stimulus(params: &Params, count: usize, seed: u64) -> Stimulus {
    let pool = Stimulus::random(params, (count * CHOICE).clamp(SMALLEST, LARGEST), seed);
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let in_plane = |(i, (pose, pair)): (usize, (Pose, Pair))| {
        if params.method != Method::Exact || i % 2 == 0 {
            return (pose, pair);
        }
        let points = in_plane::points(&mut rng, params);
        (pose, sample::placed(&mut rng, params, &pose, points))
    };
    let random: Vec<(Pose, Pair)> = pool
        .segments
        .iter()
        .flat_map(|(pose, pairs)| pairs.iter().map(move |pair| (*pose, *pair)))
        .enumerate()
        .map(in_plane)
        .collect();
    let (golden, bound) = (Golden::new(params), params.coordinate_bound() as i64);
    let second = second_stage(params);
    let near = |x: Input, by: i64| within(bound, x.lo + by, x.sticky);
    let at_edge = |(i, (pose, pair)): (usize, &(Pose, Pair))| {
        let mut pair = *pair;
        if params.method == Method::Exact {
            // Such pairs are at the edge of the exact unit as they come. The first stage of a cascade has bounds.
            let moved =
                second.as_ref().map(|_| moved_to_edge(&golden, bound, 1 << (params.width - 1), pose, pair, i / 2));
            return (*pose, moved.filter(|pair| !golden.outcome(pose, pair).outside).unwrap_or(pair));
        }
        // Vertices next to each other: enclosures overlap, and which of them is taken matters.
        let (one, other, by) = (i % 3, (i / 3) % 3, (i / 9) as i64 % 5 - 2);
        let triangle = if i % 2 == 0 { &mut pair.a } else { &mut pair.b };
        triangle[one] = triangle[other].map(|x| near(x, by));
        (*pose, moved_to_edge(&golden, bound, bound, pose, pair, i / 2))
    };
    let all: Vec<(Pose, Pair)> = random.par_iter().enumerate().map(at_edge).chain(random.par_iter().copied()).collect();
    let cases = |(pose, pair): &(Pose, Pair)| match &second {
        Some(second) => edges_in_stages(&golden, second, pose, pair),
        None => edges(&golden, pose, pair),
    };
    let edges: Vec<Vec<Edge>> = all.par_iter().map(cases).collect();
    let share = if params.method == Method::Exact { 3 * count / 4 } else { count / 2 };
    let chosen = cover(&edges, share.min(MOST_CHOSEN));
    let mut chosen = chosen.into_iter().map(|i| all[i]);
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    // Strides through the pool, so that few pairs see many poses.
    let mut random = (0..).map(|i| random[(i * 17) % random.len()]);
    let mut segments: Vec<(Pose, Vec<Pair>)> = vec![];
    for number in 0..count {
        let next = match number % 4 {
            0 | 2 => chosen.next(),
            1 if params.method == Method::Exact && number % 8 == 1 => {
                Some((Pose::identity(params), sample::corner_pair(&mut rng, params)))
            }
            1 | 3 if params.method == Method::Exact && number % 8 != 7 => chosen.next(),
            _ if params.method == Method::Exact => None,
            1 if number == 1 && params.transform != Transform::Off => Some(farthest(params)),
            1 if number % 32 == 13 => Some((Pose::identity(params), tiny(&mut rng))),
            1 if number % 32 == 29 => {
                let pose = random.next().map_or_else(|| Pose::identity(params), |(pose, _)| pose);
                Some((at_origin(&mut rng, pose), tiny(&mut rng)))
            }
            1 if number % 32 == 21 => Some((Pose::identity(params), below_power(&mut rng, params))),
            1 => Some((Pose::identity(params), extreme(&mut rng, params))),
            3 if number % 8 == 7 => {
                let pose = Pose::identity(params);
                let pair = match (number / 8 + (seed / 8) as usize) % 24 {
                    kind @ 0..12 => answered(&golden, &pose, Verdict::Intersect, || parallel(&mut rng, params, kind)),
                    kind => {
                        answered(&golden, &pose, Verdict::PossiblyIncorrect, || on_face(&mut rng, params, kind % 2))
                    }
                };
                Some((pose, pair))
            }
            _ => None,
        };
        let Some((pose, mut pair)) = next.or_else(|| random.next()) else { break };
        if number % 8 == 3 && params.method != Method::Exact {
            // V1 next to V0, so that coordinates and n_A straddle 0.
            pair.a[1] = pair.a[0].map(|x| near(x, -1));
        }
        // Between poses a unit that takes a pair in every clock has to wait, so there equal ones come together.
        let last = segments.len().saturating_sub(if params.interval() == 1 { segments.len() } else { 1 });
        match segments[last..].iter_mut().find(|(known, _)| *known == pose) {
            Some((_, pairs)) => pairs.push(pair),
            None => segments.push((pose, vec![pair])),
        }
    }
    Stimulus { segments }
}

/// A number moved into the declared range: where its lower bound is the greatest there is, it is exact.
fn within(bound: i64, lo: i64, sticky: bool) -> Input {
    Input { lo: lo.clamp(-bound, bound), sticky: sticky && lo < bound }
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
        within(bound, lo, rng.random())
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

/// A normal whose greatest bound is one ulp below a power of two before it is shifted.
fn below_power(rng: &mut ChaCha8Rng, params: &Params) -> Pair {
    let (most, fraction) = (params.coordinate_bound().ilog2(), params.width - 2);
    let reach = (1 << most) - 1;
    let short = (1i64 << rng.random_range(fraction.saturating_sub(4).max(2)..=fraction)) - 2;
    let a = [[0; 3], [reach, 0, 0], [0, short << most.saturating_sub(fraction), 0]];
    let mut b = [(); 3].map(|()| [(); 3].map(|()| rng.random_range(-reach..=reach)));
    b[0][1] = reach;
    exact_pair(a, b)
}

/// A pair with that answer, if one of many has it.
fn answered(golden: &Golden, pose: &Pose, verdict: Verdict, mut pair: impl FnMut() -> Pair) -> Pair {
    let first = pair();
    iter::once(first)
        .chain(iter::repeat_with(pair).take(2_000))
        .find(|x| golden.verdict(pose, x) == verdict)
        .unwrap_or(first)
}

/// An edge of B parallel to one of A, and another edge that touches one of A: two axes are zero and can say neither
/// separated nor overlapping. One edge passes through the other triangle, that of the `kind`, 0 to 11.
fn parallel(rng: &mut ChaCha8Rng, params: &Params, kind: usize) -> Pair {
    let weights = |edge: usize, first: i64| [0, 1, 2].map(|k| [first, 4 - first, 0][(k + 3 - edge) % 3]);
    loop {
        let (a, mut b) = (triangle(rng, params), triangle(rng, params));
        let [k, l] = [(); 2].map(|()| rng.random_range(0..3));
        b[(l + 1) % 3] = [0, 1, 2].map(|i| b[l][i] + a[(k + 1) % 3][i] - a[k][i]);
        // Not both in the middle of the edge, because the parallel edges are of one length.
        let of_a = weighted(&a, weights((k + rng.random_range(1..3)) % 3, 2));
        let of_b = weighted(&b, weights((l + rng.random_range(1..3)) % 3, 1));
        let b = moved(&b, of_b, of_a);
        let passing = |side: usize, x: Points, y: Points| {
            (0..3).filter_map(move |i| passes(&x, i, &y).map(|above| (side, i, above)))
        };
        let of_kind = passing(0, a, b).chain(passing(1, b, a)).eq([(kind % 2, kind / 4, (kind / 2).is_multiple_of(2))]);
        if of_kind && inside(&b, params) {
            return exact_pair(a, b);
        }
    }
}

/// A vertex of one triangle, the `other` one or the first, on the face of the other, which edges can only nearly reach.
fn on_face(rng: &mut ChaCha8Rng, params: &Params, other: usize) -> Pair {
    loop {
        let (a, b) = (triangle(rng, params), triangle(rng, params));
        let l = rng.random_range(0..3);
        let b = moved(&b, b[l], weighted(&a, [2, 1, 1]));
        let [left, right] = [1, 2].map(|n| volume([&a[0], &a[1], &a[2], &b[(l + n) % 3]]));
        if left * right > 0 && inside(&b, params) {
            return if other == 1 { exact_pair(a, b) } else { exact_pair(b, a) };
        }
    }
}

type Points = [[i64; 3]; 3];

/// A random triangle of which quarters of differences are on the grid.
fn triangle(rng: &mut ChaCha8Rng, params: &Params) -> Points {
    let reach = params.coordinate_bound() as i64 / 8;
    [(); 3].map(|()| [(); 3].map(|()| 4 * rng.random_range(-reach..=reach)))
}

/// Whether all coordinates are in the declared range.
fn inside(x: &Points, params: &Params) -> bool {
    x.as_flattened().iter().all(|x| i128::from(*x).abs() <= params.coordinate_bound())
}

/// A point of a triangle, by weights that add up to 4.
fn weighted(x: &Points, weights: [i64; 3]) -> [i64; 3] {
    [0, 1, 2].map(|i| (0..3).map(|k| x[k][i] * weights[k]).sum::<i64>() / 4)
}

fn moved(x: &Points, from: [i64; 3], to: [i64; 3]) -> Points {
    x.map(|point| [0, 1, 2].map(|i| point[i] + to[i] - from[i]))
}

/// Whether edge `i` of `x` passes through `y`, and then whether its first end is above the plane of `y`.
fn passes(x: &Points, i: usize, y: &Points) -> Option<bool> {
    let ends = [&x[i], &x[(i + 1) % 3]];
    let [first, second] = ends.map(|end| volume([&y[0], &y[1], &y[2], end]));
    let sides = [0, 1, 2].map(|j| volume([ends[0], ends[1], &y[j], &y[(j + 1) % 3]]));
    (first * second < 0 && sides[0] != 0 && sides.iter().all(|side| *side == sides[0])).then_some(first > 0)
}

/// The sign of the volume of a tetrahedron. Of the widest numbers the volume has more than 128 bits.
fn volume(points: [&[i64; 3]; 4]) -> i8 {
    let edge = |n: usize| [0, 1, 2].map(|i| i128::from(points[n][i] - points[0][i]));
    let [e, f, g] = [edge(1), edge(2), edge(3)];
    let term = |i: usize, j: usize, k: usize| BigInt::from(e[i]) * (f[j] * g[k] - f[k] * g[j]);
    let volume = term(0, 1, 2) + term(1, 2, 0) + term(2, 0, 1);
    i8::from(volume.is_positive()) - i8::from(volume.is_negative())
}

fn exact_pair(a: Points, b: Points) -> Pair {
    let exact = |triangle: Points| triangle.map(|point| point.map(Input::exact));
    Pair { a: exact(a), b: exact(b) }
}

/// The pose with a translation of next to nothing: it leaves a tiny pair tiny, but B's enclosures as wide as the pair, so
/// that coordinates of B straddle 0 as far as they can.
fn at_origin(rng: &mut ChaCha8Rng, pose: Pose) -> Pose {
    Pose { t: [(); 3].map(|()| Input { lo: -i64::from(rng.random::<bool>()), sticky: rng.random() }), ..pose }
}

/// A pair in a box of two ulps of the input with V0 in its middle: re-normalised, V0 and all differences are as wide as
/// half of the box, so that they straddle 0 far from it.
fn tiny(rng: &mut ChaCha8Rng) -> Pair {
    let mut number = || Input { lo: -i64::from(rng.random::<bool>()), sticky: rng.random() };
    let mut triangle = || [(); 3].map(|()| [(); 3].map(|()| number()));
    let mut pair = Pair { a: triangle(), b: triangle() };
    pair.a[0] = [Input { lo: 0, sticky: true }; 3];
    pair
}

/// Greedy: each time the entry with most that is new; once all is covered, from the beginning.
fn cover(entries: &[Vec<Edge>], count: usize) -> Vec<usize> {
    let mut chosen: Vec<usize> = vec![];
    let mut covered = HashSet::new();
    while chosen.len() < count.min(entries.len()) {
        // Every second one is chosen by cases of which there are few.
        let weight = |edge: &Edge| if chosen.len() % 2 == 1 && in_plane::is_rare(edge.0) { 1000 } else { 1 };
        let gain = |i: &usize| entries[*i].iter().filter(|edge| !covered.contains(*edge)).map(weight).sum::<usize>();
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

/// The pair with B moved along one coordinate until one ulp decides the comparison that `number` stands for, if some
/// such place is found by halving, at most `reach` from where B is.
fn moved_to_edge(golden: &Golden, bound: i64, reach: i64, pose: &Pose, pair: Pair, number: usize) -> Pair {
    let moved = |by: i64| {
        let mut pair = pair;
        let coordinate = (number / 4) % 3;
        for w in &mut pair.b {
            w[coordinate] = within(bound, w[coordinate].lo + by, w[coordinate].sticky);
        }
        pair
    };
    let lacking = |by: i64| {
        let axes = Axes::new(golden, pose, &moved(by));
        let axis = (number / 12) % axes.names().len();
        axes.lacking(axis)[number % 4]
    };
    let (mut from, mut to) = (-reach, reach);
    let rising = lacking(from) <= 0;
    if rising == (lacking(to) <= 0) {
        return pair;
    }
    while to - from > 1 {
        let middle = from + (to - from) / 2;
        if (lacking(middle) <= 0) == rising {
            from = middle;
        } else {
            to = middle;
        }
    }
    moved(if number % 8 < 4 { from } else { to })
}

/// What the reference model computes on the axes of a pair, or its determinants.
struct Axes(BTreeMap<String, Interval>);

impl Axes {
    fn new(golden: &Golden, pose: &Pose, pair: &Pair) -> Self {
        Self(golden.trace(pose, pair).into_iter().collect())
    }

    /// The names of the axes or determinants, in one order for all pairs of a parameter set.
    fn names(&self) -> Vec<&str> {
        self.0.keys().filter_map(|name| compared(name)).collect()
    }

    fn enclosure(&self, axis: &str, end: &str) -> Interval {
        self.0[&format!("enclosure.{axis}.{end}")]
    }

    fn lacking(&self, axis: usize) -> Lacking {
        let axis = self.names()[axis];
        if let Some(x) = self.0.get(&format!("determinant.{axis}")) {
            let bound = self.bound(axis);
            return [x.lo - bound, -x.lo - bound, x.lo - bound, -x.lo - bound];
        }
        let [a_min, a_max, b_min, b_max] = ["a_min", "a_max", "b_min", "b_max"].map(|end| self.enclosure(axis, end));
        [b_min.lo - a_max.hi, a_min.lo - b_max.hi, b_max.lo - a_min.hi, a_max.lo - b_min.hi]
    }

    /// The bound of a determinant, which is in eighths of it; exact determinants have none.
    fn bound(&self, determinant: &str) -> i128 {
        self.0.get(&format!("bound.{determinant}")).map_or(0, |bound| bound.lo >> 3)
    }

    /// The vertex whose projection has this bound (3: none has), and those of the same triangle whose enclosures overlap its.
    fn end(&self, axis: &str, side: char, bound: Bound, value: i128) -> (usize, u8) {
        let images = [0, 1, 2].map(|k| self.0.get(&format!("projection.{axis}.{side}{k}")).copied());
        let Some(k) = (0..3).find(|k| images[*k].is_some_and(|x| bound(&x) == value)) else { return (3, 0) };
        let overlaps = |other: &Interval| images[k].is_some_and(|x| x.lo <= other.hi && other.lo <= x.hi);
        let near = (0..3).filter(|i| *i != k && images[*i].as_ref().is_some_and(overlaps));
        (k, near.fold(0, |set, i| set | 1 << i))
    }
}

/// The axis or determinant whose number that is.
fn compared(name: &str) -> Option<&str> {
    name.strip_prefix("determinant.").or_else(|| name.strip_prefix("axis.")?.strip_suffix("_x"))
}

/// A bound of an interval.
type Bound = fn(&Interval) -> i128;

/// The exact unit that decides what the first stage of a cascade leaves open.
fn second_stage(params: &Params) -> Option<Golden> {
    params.exact_clocks.map(|_| Golden::new(&Params { exact_clocks: None, ..params.clone() }))
}

/// Of a cascade: the comparisons of the first stage, and of a pair that it leaves open what decides in the second.
fn edges_in_stages(first: &Golden, second: &Golden, pose: &Pose, pair: &Pair) -> Vec<Edge> {
    let mut found = comparisons(&Axes::new(first, pose, pair));
    if first.is_open(pose, pair) {
        // Behind the determinants of the first stage.
        let behind = |edge: Edge| {
            if edge.0 < in_plane::FIRST { (edge.0 + in_plane::FIRST / 2, edge.1, edge.2, edge.3, edge.4) } else { edge }
        };
        found.extend(edges(second, pose, pair).into_iter().map(behind));
    }
    found
}

/// The comparisons of a pair that one ulp decides, and behind them the cases of pairs in one plane.
fn edges(golden: &Golden, pose: &Pose, pair: &Pair) -> Vec<Edge> {
    let axes = Axes::new(golden, pose, pair);
    let in_plane = in_plane::cases(&axes.0).into_iter().map(|(rule, part, how)| (rule, part, how, (3, 0), (3, 0)));
    in_plane.chain(comparisons(&axes)).collect()
}

/// The comparisons of a pair that one ulp decides, where no other comparison hides it.
fn comparisons(axes: &Axes) -> Vec<Edge> {
    let (lo, hi): (Bound, Bound) = (|x| x.lo, |x| x.hi);
    let mut found: Vec<Edge> = vec![];
    for (number, axis) in axes.names().into_iter().enumerate() {
        let lacking = axes.lacking(number);
        if axes.0.contains_key(&format!("determinant.{axis}")) {
            // A step of a coordinate moves a determinant by about its bound, so few are nearer than a part of it.
            let near = axes.bound(axis) / 4 + 1;
            let at_edge = (0..2).filter(|i| (-near..near).contains(&(lacking[*i] - 1)));
            found.extend(at_edge.map(|i| (number, i, i128::from(lacking[i] > 0), (3, 0), (3, 0))));
            continue;
        }
        // The bound of A, and that of B, that each comparison looks at.
        let ends = [
            (("a_max", hi), ("b_min", lo)),
            (("a_min", lo), ("b_max", hi)),
            (("a_min", hi), ("b_max", lo)),
            (("a_max", lo), ("b_min", hi)),
        ];
        for (i, (a, b)) in ends.into_iter().enumerate() {
            // Either says separated, both together overlapping.
            let other = lacking[i ^ 1];
            let seen = if i < 2 { other <= 0 } else { other > 0 };
            if seen && matches!(lacking[i], 0 | 1) {
                let end = |side, (name, bound): (&str, Bound)| {
                    axes.end(axis, side, bound, bound(&axes.enclosure(axis, name)))
                };
                found.push((number, i, lacking[i], end('v', a), end('w', b)));
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use efsat_hardware::testing::full;

    #[test]
    fn numbers_are_within_the_declared_range() {
        for (transform, renormalise) in [(Transform::On, true), (Transform::Translate, true), (Transform::Off, false)] {
            let params = Params { transform, renormalise, ..Params::default() };
            let bound = params.coordinate_bound() as i64;
            let stimulus = stimulus(&params, if full() { 64 } else { 16 }, 1);
            let pairs = stimulus.segments.iter().flat_map(|(_, pairs)| pairs);
            let mut numbers = pairs.flat_map(|pair| pair.a.iter().chain(&pair.b).flatten());
            assert_eq!(numbers.find(|x| x.lo < -bound || x.lo + i64::from(x.sticky) > bound), None);
        }
    }

    #[test]
    fn the_widest_volumes_have_their_sign() {
        let far = 1 << 47;
        let corners = [[-far, 0, 0], [far, 0, 0], [0, far, 0], [0, 0, far]];
        let [p, q, r, s] = corners.each_ref();
        assert_eq!([volume([p, q, r, s]), volume([q, p, r, s]), volume([p, q, r, q])], [1, -1, 0]);
    }

    #[test]
    fn other_methods_have_comparisons_at_the_edge_too() {
        for method in [Method::Determinants, Method::Exact] {
            let params = Params::of(method);
            let golden = Golden::new(&params);
            let stimulus = stimulus(&params, 64, 1);
            let pairs = stimulus.segments.iter().flat_map(|(pose, pairs)| pairs.iter().map(move |pair| (pose, pair)));
            let found: HashSet<Edge> = pairs.flat_map(|(pose, pair)| edges(&golden, pose, pair)).collect();
            assert!(found.len() >= 45, "{method:?}: {} of 60", found.len());
        }
    }

    #[test]
    fn pairs_of_the_exact_unit_have_the_cases_of_pairs_in_one_plane() {
        let params = Params::of(Method::Exact);
        let golden = Golden::new(&params);
        let stimulus = stimulus(&params, 192, 1);
        let pairs = stimulus.segments.iter().flat_map(|(pose, pairs)| pairs.iter().map(move |pair| (pose, pair)));
        let of_plane =
            pairs.flat_map(|(pose, pair)| edges(&golden, pose, pair)).filter(|edge| edge.0 >= in_plane::FIRST);
        let rules: std::collections::BTreeSet<usize> = of_plane.map(|edge| edge.0 - in_plane::FIRST).collect();
        assert_eq!(rules, (0..26).collect());
    }

    #[test]
    fn pairs_of_a_cascade_are_at_the_edge_of_both_stages() {
        let params = Params { exact_clocks: Some(16), ..Params::of(Method::Exact) };
        let (golden, second) = (Golden::new(&params), second_stage(&params).unwrap());
        let stimulus = stimulus(&params, 160, 1);
        let pairs: Vec<(&Pose, &Pair)> =
            stimulus.segments.iter().flat_map(|(pose, pairs)| pairs.iter().map(move |pair| (pose, pair))).collect();
        let edges = pairs.iter().flat_map(|(pose, pair)| edges_in_stages(&golden, &second, pose, pair));
        let found: HashSet<usize> = edges.map(|edge| edge.0).collect();
        let of = |from: usize, to: usize| found.iter().filter(|number| (from..to).contains(*number)).count();
        assert_eq!([of(0, 50), of(50, 100)], [15, 15], "determinants");
        // Pairs on one line that are apart along one coordinate alone are decided by the boxes of the first stage.
        let missing: Vec<usize> = (0..26).filter(|rule| !found.contains(&(in_plane::FIRST + rule))).collect();
        assert_eq!(missing, [3], "cases of pairs in one plane");
        let open = pairs.iter().filter(|(pose, pair)| golden.is_open(pose, pair)).count();
        assert!((60..150).contains(&open), "{open} open");
    }

    #[test]
    fn edges_alone_decide_some_pairs() {
        for (width, transform_width, least) in [(8, 10, 6), (18, 32, 12)].into_iter().take(if full() { 2 } else { 1 }) {
            let params = Params { width, transform_width, ..Params::default() };
            let stimulus = stimulus(&params, 128, 1);
            let [with, without] = [true, false].map(|edge_test| Golden::new(&Params { edge_test, ..params.clone() }));
            let pairs = stimulus.segments.iter().flat_map(|(pose, pairs)| pairs.iter().map(move |pair| (pose, pair)));
            let of_edges = pairs.filter(|(pose, pair)| with.verdict(pose, pair) != without.verdict(pose, pair)).count();
            assert!(of_edges >= least, "{of_edges} {params:?}");
        }
    }

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
