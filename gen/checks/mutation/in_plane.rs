//! What decides a pair of the exact unit, in one plane or on one line above all (sections 4 and 5 of docs/exact.md): the cases
//! that pairs chosen to kill mutants should have, each by itself.

use efsat_hardware::number::Interval;
use efsat_unit::params::Params;
use rand::RngExt;
use rand::rngs::ChaCha8Rng;
use std::array::from_fn;
use std::collections::BTreeMap;

/// A case: which rule, which of its parts, and how.
pub type Case = (usize, usize, i128);

/// The number of the first rule: behind those of axes and determinants.
pub const FIRST: usize = 100;
/// Whether a rule has few cases.
pub fn is_rare(rule: usize) -> bool {
    rule >= FIRST && !matches!(rule - FIRST, 3 | 4 | 10..=23)
}

/// A sign pattern as one number.
fn pattern(signs: impl IntoIterator<Item = i128>) -> i128 {
    signs.into_iter().fold(0, |sum, x| 3 * sum + x.signum() + 1)
}

/// The only one that holds.
fn sole(holds: &[bool]) -> Option<usize> {
    let mut those = holds.iter().enumerate().filter(|(_, holds)| **holds).map(|(i, _)| i);
    those.next().filter(|_| those.next().is_none())
}

/// Six points of small multiples of directions of which most components are 0: segments on two lines, points, triangles in a
/// plane of two axes, and triangles that cross in a segment which ends on edges of both.
pub fn points(rng: &mut ChaCha8Rng, params: &Params) -> [[i64; 3]; 6] {
    let size = 1 << rng.random_range(0..=params.width - 5);
    let [x, y, z] = [(); 3].map(|()| [(); 3].map(|()| rng.random_range(-1..=1) * rng.random_range(0..=1)));
    let (kind, beyond, order) = (rng.random_range(0..8), rng.random(), rng.random_range(0..3));
    let ends: [i64; 2] = [(); 2].map(|()| rng.random_range(0..=2));
    let mut point = |i: usize| {
        let [a, b]: [i64; 2] = [(); 2].map(|()| rng.random_range(-2..=2));
        let times = match (kind, i) {
            // Where the lines meet.
            (0..4, 0) => [0, 0, 0],
            (0..4, 1..3) => [a, 0, 0],
            (0..4, _) if beyond => [0, b.abs().max(1), 0],
            (0..4, _) => [0, b, 0],
            // From -x to x.
            (4, _) => {
                let [along, across] = [[-1, -ends[i / 3]], [-1, 1], [3, -1]][(i + order) % 3];
                if i < 3 { [along, across, 0] } else { [along, 0, across] }
            }
            // A segment that ends in the plane, and no corner elsewhere.
            (5, 3..) if i == 3 + order => [a, b, 1],
            (5, 3..) => [ends[0], ends[1], 0],
            _ => [a, b, 0],
        };
        from_fn(|j| size * (times[0] * x[j] + times[1] * y[j] + times[2] * z[j]))
    };
    from_fn(&mut point)
}

/// What the trace of a pair says.
pub fn cases(trace: &BTreeMap<String, Interval>) -> Vec<Case> {
    found(trace).into_iter().map(|(rule, part, how)| (FIRST + rule, part, how)).collect()
}

/// What it says of points in one plane; of other pairs, which edge of A alone is inside which edge of B.
fn found(trace: &BTreeMap<String, Interval>) -> Vec<Case> {
    let number = |name: String| trace.get(&name).map_or(0, |x| x.lo);
    let vector = |kind: &str, name: &str| ["x", "y", "z"].map(|c| number(format!("{kind}.{name}_{c}")));
    let [of_a, of_b] = ["a", "b"].map(|of| [0, 1, 2].map(|k| number(format!("determinant.plane_{of}{k}")).signum()));
    if !trace.contains_key("moment.n_x") {
        return vec![];
    }
    if [of_a, of_b] != [[0; 3]; 2] {
        let signs = [of_a, of_b].concat();
        let alone = sole(&[0, 1, 2, 3, 4, 5].map(|i| signs[i] != 0)).map(|i| (25, i, signs[i]));
        let inner = inner_sides(
            of_a,
            of_b,
            [0, 1, 2].map(|k| [0, 1, 2].map(|l| number(format!("determinant.side{k}{l}")).signum())),
        );
        return alone.into_iter().chain(inner).collect();
    }
    let [v1, v2, w0, w1, w2] = ["v1", "v2", "w0", "w1", "w2"].map(|point| vector("difference", point));
    let [m0, m1, m2, n] = ["m0", "m1", "m2", "n"].map(|moment| vector("moment", moment));
    let x: [i128; 6] = from_fn(|t| number(format!("component.c{t}")));
    let (mut cases, mut next, mut lacks) = (vec![], vec![], vec![]);
    // Everything that keeps the triangles apart, and everything that nearly does.
    let (mut apart, mut nearly) = (vec![], vec![]);
    let (mut through_a, mut through_b, mut without_0) = (vec![], vec![], vec![]);
    for j in 0..3 {
        let (a, b) = ([0, v1[j], v2[j]], [w0[j], w1[j], w2[j]]);
        let ends = |of: [i128; 3]| [of[0].min(of[1]).min(of[2]), of[0].max(of[1]).max(of[2])];
        let ([a_least, a_most], [b_least, b_most]) = (ends(a), ends(b));
        let one = a_least == b_most && a_most == b_least;
        apart.extend([a_most < b_least, b_most < a_least]);
        nearly.extend([a_most <= b_least && !one, b_most <= a_least && !one]);
        through_a.extend([v1[j] < 0 && v2[j] > 0, v1[j] > 0 && v2[j] < 0]);
        through_b.push(b_least < 0 && b_most > 0);
        without_0.push(b_least > 0 || b_most < 0);
        // Which corners are next to each other.
        let [below, above] = [(a_most, b_least), (a_least, b_most)]
            .map(|(of_a, of_b)| pattern(a.map(|x| x - of_a).into_iter().chain(b.map(|x| x - of_b))));
        next.extend([below, above]);
        // All corners of one triangle but one are beyond all of the other.
        let lacking = |x: [i128; 3], y: [i128; 3]| sole(&from_fn::<_, 9, _>(|i| x[i / 3] >= y[i % 3]));
        lacks.extend([(2 * j, lacking(a, b)), (2 * j + 1, lacking(b, a))]);
    }
    if !apart.contains(&true) {
        let lacks = lacks.into_iter().filter_map(|(along, corners)| Some((23, along, corners? as i128)));
        cases.extend(lacks);
    }
    let left_out = (0..3).find(|c| [m0, m1, m2, n].iter().any(|moment| moment[*c] != 0));
    let Some(c) = left_out else {
        let seen = |points: &[[i128; 3]]| pattern(points.iter().map(|x| i128::from(*x != [0; 3])));
        let u = [x[0], x[1], x[2]];
        if u == [0; 3] {
            cases.push((2, 0, seen(&[v1, v2, w0, w1, w2])));
            cases.extend(sole(&apart).map(|i| (3, i, next[i])));
            cases.extend(sole(&nearly).map(|i| (4, i, next[i])));
        } else {
            cases.extend([(0, 0, seen(&[v1, v2])), (1, 0, seen(&[w0, w1, w2]))]);
            let (a, b) = (through_a.contains(&true), through_b.contains(&true));
            cases.extend(sole(&without_0).filter(|_| !apart.contains(&true)).map(|i| (5, i, 0)));
            cases.extend(sole(&through_a).filter(|_| b).map(|i| (6, i, 0)));
            cases.extend(sole(&through_b).filter(|_| a).map(|i| (7, i, pattern([w0[i], w1[i], w2[i]]))));
            if !apart.contains(&true) && !without_0.contains(&true) {
                cases.push((8, usize::from(a), i128::from(b)));
            }
        }
        return cases;
    };
    let (m, n) = ([m0[c], m1[c], m2[c]], n[c]);
    cases.push((9, c, pattern(m.map(i128::abs)) + 100 * i128::from(n == 0)));
    for k in 0..6 {
        let l = k % 3;
        let sides = match k {
            0 => [x[0], x[1], x[2]],
            1 => from_fn(|l| n + x[3 + l] - x[l]),
            2 => [-x[3], -x[4], -x[5]],
            _ => [m[l], m[l] + x[l] - x[(l + 1) % 3], m[l] + x[3 + l] - x[3 + (l + 1) % 3]],
        };
        let area = if k < 3 { n } else { m[0] + m[1] + m[2] };
        let all = |test: fn(&i128) -> bool| sides.iter().all(test);
        apart.push(all(|x| *x < 0) && area >= 0 || all(|x| *x > 0) && area <= 0);
        let level = area == 0 && sides == [0; 3];
        nearly.push((all(|x| *x <= 0) && area >= 0 || all(|x| *x >= 0) && area <= 0) && !level);
        next.push(pattern(sides.into_iter().chain([area])));
    }
    cases.extend(sole(&apart).map(|i| (10 + c, i, next[i])));
    cases.extend(sole(&nearly).map(|i| (13 + c, i, next[i])));
    if !nearly.contains(&true) {
        // Edges without length of a pair that crosses: all their numbers are 0.
        cases.extend((6..12).filter(|i| next[*i] == pattern([0; 4])).map(|i| (24, i, 0)));
    }
    // Several edges of a triangle without area part a pair together.
    let edges = |of: &[bool]| (6..12).filter(|i| of[*i] && !of[..6].contains(&true)).collect::<Vec<_>>();
    cases.extend(edges(&apart).into_iter().map(|i| (22, i, next[i])));
    cases
}

/// Of a pair that crosses, or not, by the part of A in the plane of B: which edge of A alone has that part on the inner side of
/// an edge of B, or the only edge of B of which it is not.
fn inner_sides(of_a: [i128; 3], of_b: [i128; 3], side: [[i128; 3]; 3]) -> Vec<Case> {
    let both_sides = [of_a, of_b].iter().all(|signs| signs.contains(&1) && signs.contains(&-1));
    let alike = |x: [i128; 3]| x == [1; 3] || x == [-1; 3];
    let pierces = |k: usize| {
        let of = |ends: [i128; 3], sides| ends[k] * ends[(k + 1) % 3] == -1 && alike(sides);
        of(of_b, side[k]) || of(of_a, side.map(|of_edge| of_edge[k]))
    };
    if !both_sides || (0..3).any(pierces) {
        return vec![];
    }
    let inner: [[bool; 3]; 3] = from_fn(|l| from_fn(|k| side[k][l] * (of_b[(k + 1) % 3] - of_b[k]) > 0));
    let outside: Vec<usize> = (0..3).filter(|l| !inner[*l].contains(&true)).collect();
    match outside[..] {
        [] => (0..3).filter_map(|l| Some((16 + l, sole(&inner[l])?, pattern(of_b)))).collect(),
        [l] => (0..3).map(|k| (19 + l, k, pattern([of_b[k], of_b[(k + 1) % 3], side[k][l]]))).collect(),
        _ => vec![],
    }
}
