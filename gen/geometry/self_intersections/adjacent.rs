//! Triangles that share one or two vertices, by the signs of determinants: nearly all of them by one or two in binary64.
//!
//! *One common vertex*, taken as the origin: A is spanned by a1 and a2, B by b1 and b2, and there is a common point elsewhere if
//! and only if the cones that they span have more in common than the origin, as any such point can be scaled into both. With the
//! heights `h_i = det(b1, b2, a_i)` and `g_j = det(a1, a2, b_j)`, any four vectors satisfy
//!
//! ```text
//! h_2 a1 - h_1 a2 + g_2 b1 - g_1 b2 = 0.
//! ```
//!
//! If not all four are zero, the vectors span space, and this is their only relation but for a factor. If further neither both
//! h_i nor both g_j are zero, then neither triangle is a segment: for one on a line g_1 = g_2 = 0. So the cones meet if and only if
//! one of h and g has the signs of s1 a1 + s2 a2 = t1 b1 + t2 b2 with s, t >= 0, turned around or not: h_2 >= 0 >= h_1 and
//! g_1 >= 0 >= g_2, or all of that reversed. Two heights on one side show at once that this does not hold.
//!
//! If all four are zero and neither triangle is a segment, all is in one plane, which a projection along some coordinate axis
//! keeps. There two cones, each less than a half plane, meet if and only if a side of one is in the other, because the
//! sides of what they have in common are sides of theirs.
//!
//! *Two common vertices*: docs/self-intersections.md. The triangles are in one plane if det(w - v, p - v, q - v) = 0, and on one
//! side of the edge if a projection that keeps both shows it.
//!
//! *A line in a projection* through v that has A on one side and B on the other, one of them touching it along an edge from v
//! only, shows for all cases that nothing else is common: a common point is on that edge, where B has only v. This is asked
//! before the exact signs, as it decides most triangles that are in one plane.
//!
//! What binary64 does not show (`determinant`), the exact predicates do. All numbers are in the range of `robbins_whitesides`.

use crate::software::determinant::{self, FLAT, SOLID, difference, sign};
use crate::software::robbins_whitesides::{PLANES, area, volume};

type Point = [f64; 3];
type Flat = [f64; 2];

/// Whether two triangles with the common vertex v, whose other corners are given, have another common point; none if one of them
/// is a segment.
pub(super) fn with_vertex(v: &Point, a: [&Point; 2], b: [&Point; 2]) -> Option<bool> {
    let mut of_a = a.map(|x| certain(v, b, x));
    if of_a[0] * of_a[1] > 0 {
        return Some(false);
    }
    let mut of_b = b.map(|x| certain(v, a, x));
    if of_b[0] * of_b[1] > 0
        || PLANES.iter().any(|plane| are_divided(&flat(v, plane), flats(a, plane), flats(b, plane)))
    {
        return Some(false);
    }
    for (signs, ends, base) in [(&mut of_a, a, b), (&mut of_b, b, a)] {
        for (sign, end) in signs.iter_mut().zip(ends) {
            if *sign == 0 {
                *sign = volume(v, base[0], base[1], end);
            }
        }
    }
    match ([of_a, of_b], of_a == [0; 2], of_b == [0; 2]) {
        (_, true, true) => PLANES.iter().find_map(|plane| cones(&flat(v, plane), flats(a, plane), flats(b, plane))),
        ([[h1, h2], [g1, g2]], false, false) => {
            let meets = |sign: i8| sign * h2 >= 0 && sign * h1 <= 0 && sign * g1 >= 0 && sign * g2 <= 0;
            Some(meets(1) || meets(-1))
        }
        _ => None,
    }
}

/// Whether two triangles with the common edge vw have a common point beside it; none if one of them is a segment.
pub(super) fn with_edge([v, w]: [&Point; 2], p: &Point, q: &Point) -> Option<bool> {
    let beside = |plane: &[usize; 2], sign: fn(&Flat, &Flat, &Flat) -> i8| {
        let [v, w, p, q] = [v, w, p, q].map(|x| flat(x, plane));
        sign(&v, &w, &p) * sign(&v, &w, &q)
    };
    if certain(v, [w, p], q) != 0
        || PLANES.iter().any(|plane| beside(plane, certain_turn) < 0)
        || volume(v, w, p, q) != 0
    {
        return Some(false);
    }
    PLANES.iter().map(|plane| beside(plane, area)).find(|side| *side != 0).map(|side| side > 0)
}

/// Whether two triangles in a plane with the common vertex v have another common point; none if one of them is a segment.
fn cones(v: &Flat, a: [Flat; 2], b: [Flat; 2]) -> Option<bool> {
    // Each from its right side to its left one.
    let [a, b] = [a, b].map(|[x, y]| match area(v, &x, &y) {
        0 => None,
        turn => Some(if turn > 0 { [x, y] } else { [y, x] }),
    });
    let (a, b) = (a?, b?);
    let holds = |[right, left]: &[Flat; 2], x: &Flat| area(v, right, x) >= 0 && area(v, x, left) >= 0;
    Some(a.iter().any(|x| holds(&b, x)) || b.iter().any(|x| holds(&a, x)))
}

/// Whether a line along an edge at v certainly divides two triangles in a projection.
fn are_divided(v: &Flat, a: [Flat; 2], b: [Flat; 2]) -> bool {
    let turn = |x: &Flat, y: &Flat| certain_turn(v, x, y);
    let divides = |edge: &Flat, own: &Flat, other: &[Flat; 2]| {
        let side = turn(edge, own);
        side != 0 && other.iter().all(|x| turn(edge, x) == -side)
    };
    divides(&a[0], &a[1], &b) || divides(&a[1], &a[0], &b) || divides(&b[0], &b[1], &a) || divides(&b[1], &b[0], &a)
}

fn flat(x: &Point, [i, j]: &[usize; 2]) -> Flat {
    [x[*i], x[*j]]
}

fn flats(ends: [&Point; 2], plane: &[usize; 2]) -> [Flat; 2] {
    ends.map(|x| flat(x, plane))
}

/// The sign of det(x - v, y - v, z - v), or 0 if binary64 does not show it.
#[inline]
fn certain(v: &Point, [x, y]: [&Point; 2], z: &Point) -> i8 {
    let (sum, magnitude) = determinant::solid(difference(x, v), difference(y, v), difference(z, v));
    sign(sum, SOLID * magnitude)
}

/// The sign of det(x - v, y - v), or 0 if binary64 does not show it.
#[inline]
fn certain_turn(v: &Flat, x: &Flat, y: &Flat) -> i8 {
    let (sum, magnitude) = determinant::flat(difference(x, v), difference(y, v));
    sign(sum, FLAT * magnitude)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::rngs::ChaCha8Rng;
    use rand::{RngExt, SeedableRng};

    /// Corners that are next to a plane: what is certain is right, and much is.
    #[test]
    fn certain_signs_are_those_of_the_exact_predicates() {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        let mut counts = [[0; 2]; 2];
        for _ in 0..200_000 {
            let far = f64::from(rng.random_range(0..40)).exp2();
            let mut point = || [(); 3].map(|()| far + rng.random_range(-1.0..1.0));
            let (v, x, y) = (point(), point(), point());
            let (s, t): (f64, f64) = (rng.random_range(-2.0..2.0), rng.random_range(-2.0..2.0));
            let off = f64::from(-rng.random_range(20..60)).exp2();
            let z = [0, 1, 2].map(|i| v[i] + s * (x[i] - v[i]) + t * (y[i] - v[i]) + off * rng.random_range(-1.0..1.0));
            let solid = (certain(&v, [&x, &y], &z), volume(&v, &x, &y, &z));
            let along = [0, 1].map(|i| v[i] + s * (x[i] - v[i]) + off * rng.random_range(-1.0..1.0));
            let (v, x) = (flat(&v, &[0, 1]), flat(&x, &[0, 1]));
            let plane = (certain_turn(&v, &x, &along), area(&v, &x, &along));
            for (count, (found, exact)) in counts.iter_mut().zip([solid, plane]) {
                assert!(found == 0 || found == exact, "{found} {exact}");
                count[usize::from(found != 0)] += 1;
            }
        }
        assert!(counts.as_flattened().iter().all(|count| *count > 5_000), "{counts:?}");
    }
}
