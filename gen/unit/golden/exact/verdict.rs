//! From signs to the verdict of a pair, with what each witness says (sections 4 and 6 of docs/exact.md).

use crate::golden::determinants::fifteen::Fifteen;
use crate::golden::determinants::number::Number;
use crate::golden::interval::three;
use crate::pair::{Outcome, Verdict};

/// -1, 0 or 1 for each determinant.
pub(super) type Signs = Fifteen<i8>;

/// The signs of the determinants.
pub(super) fn signs<N: Number>(determinants: &Fifteen<N>) -> Signs {
    determinants.zip(determinants, |x, _| i8::from(x > N::from(0)) - i8::from(x < N::from(0)))
}

/// How two closed triangles lie to each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Position {
    /// They have no common point.
    pub separate: bool,
    /// Their relative interiors have one.
    pub crosses: bool,
    /// They cross in one plane, and their normals have one direction.
    pub alike: bool,
}

/// What the signs say of an edge and the other triangle.
#[derive(Clone, Copy, Debug)]
struct Edge {
    /// They have no common point.
    misses: bool,
    /// They have one, and the edge is not in the plane of the triangle.
    hits: bool,
    /// The inside of the edge meets the inside of the triangle.
    pierces: bool,
}

impl Edge {
    /// From the signs of its ends against the plane of the other triangle, and of its line against the other's edges.
    fn new(ends: [i8; 2], sides: [i8; 3]) -> Self {
        let misses = ends[0] * ends[1] == 1 || (sides.contains(&1) && sides.contains(&-1));
        Self {
            misses,
            hits: !misses && ends != [0, 0],
            pierces: ends[0] * ends[1] == -1 && (sides == [1; 3] || sides == [-1; 3]),
        }
    }
}

/// The six edges, those of A first.
fn edges(Fifteen { plane_a, plane_b, side }: &Signs) -> [Edge; 6] {
    let ends = |plane: &[i8; 3], k: usize| [plane[k], plane[(k + 1) % 3]];
    let of_a = three(|k| Edge::new(ends(plane_b, k), side[k]));
    let of_b = three(|l| Edge::new(ends(plane_a, l), three(|k| side[k][l])));
    [of_a[0], of_a[1], of_a[2], of_b[0], of_b[1], of_b[2]]
}

/// Section 4: of a pair that is not in one plane.
fn position(signs: &Signs, edges: &[Edge; 6]) -> Position {
    let Fifteen { plane_a, plane_b, side } = signs;
    let both_sides = |plane: &[i8; 3]| plane.contains(&1) && plane.contains(&-1);
    // A meets the plane of B in a segment; some end of it is strictly inside of edge l.
    let inside = |l: usize| {
        (0..3).any(|k| {
            let passes = (plane_b[(k + 1) % 3] - plane_b[k]).signum();
            passes * side[k][l] == 1
        })
    };
    let through = both_sides(plane_a) && both_sides(plane_b) && (0..3).all(inside);
    Position {
        separate: !edges.iter().any(|edge| edge.hits),
        crosses: through || edges.iter().any(|edge| edge.pierces),
        alike: false,
    }
}

/// The verdict; `in_plane` says how the pair lies if all six points are in one plane.
pub(super) fn outcome(signs: &Signs, in_plane: impl FnOnce() -> Position) -> Outcome {
    let Fifteen { plane_a, plane_b, side } = signs;
    let flat = plane_a.iter().chain(plane_b).all(|sign| *sign == 0);
    let coplanar = flat && side.iter().flatten().all(|sign| *sign == 0);
    let edges = edges(signs);
    let Position { separate, crosses, alike } = match (flat, coplanar) {
        (false, _) => position(signs, &edges),
        // Segments on skew lines.
        (true, false) => Position { separate: true, crosses: false, alike: false },
        (true, true) => in_plane(),
    };
    let one_side = |plane: &[i8; 3]| *plane == [1; 3] || *plane == [-1; 3];
    let mut separated =
        u32::from(flat && separate) | u32::from(one_side(plane_a)) << 1 | u32::from(one_side(plane_b)) << 2;
    let pierced = edges.iter().any(|edge| edge.pierces);
    let mut overlapping = u32::from(crosses) | u32::from(coplanar) << 1 | u32::from(pierced || alike) << 2;
    for (i, edge) in (3..).zip(edges) {
        separated |= u32::from(edge.misses) << i;
        overlapping |= u32::from(edge.hits) << i;
    }
    let verdict = if separate { Verdict::Separate } else { Verdict::Intersect };
    Outcome { verdict, separated, overlapping, outside: false }
}
