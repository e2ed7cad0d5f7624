//! From certain signs to the verdict of the pair (section 6 of docs/determinants.md).

use super::coordinates::Coordinates;
use super::fifteen::Fifteen;
use super::number::Number;
use crate::golden::interval::three;
use crate::pair::{Outcome, Verdict};

/// +1 or -1 where the sign of the true determinant is certain, else 0.
pub(super) type Signs = Fifteen<i8>;

impl Signs {
    /// No sign is certain.
    pub const UNKNOWN: Self = Self { plane_a: [0; 3], plane_b: [0; 3], side: [[0; 3]; 3] };
}

/// The signs that are certain: a determinant must be beyond its bound, which is in eighths.
#[inline(always)]
pub(super) fn signs<N: Number>(determinants: &Fifteen<N>, bounds: &Fifteen<i64>) -> Signs {
    determinants.zip(bounds, |x, bound| {
        let bound = N::from(bound >> 3);
        i8::from(x > bound) - i8::from(x < -bound)
    })
}

/// What the signs say of an edge and the other triangle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Edge {
    /// They have no point in common, for certain.
    pub missed: bool,
    /// They have one, for certain.
    pub pierces: bool,
}

impl Edge {
    /// From the signs of its ends against the plane of the other triangle, and of its line against the other's edges.
    #[inline(always)]
    fn new(ends: [i8; 2], sides: [i8; 3]) -> Self {
        let product = ends[0] * ends[1];
        // Without branches, which cannot be predicted here.
        let any = |sign: i8| (sides[0] == sign) | (sides[1] == sign) | (sides[2] == sign);
        Self {
            missed: (product == 1) | (any(1) & any(-1)),
            pierces: (product == -1) & (all(&sides, 1) | all(&sides, -1)),
        }
    }
}

/// Whether all three signs are this one.
#[inline(always)]
fn all(signs: &[i8; 3], sign: i8) -> bool {
    (signs[0] == sign) & (signs[1] == sign) & (signs[2] == sign)
}

/// The six edges, those of A first.
#[inline(always)]
pub(super) fn edges(signs: &Signs) -> [[Edge; 3]; 2] {
    let Fifteen { plane_a, plane_b, side } = signs;
    let ends = |plane: &[i8; 3], k: usize| [plane[k], plane[(k + 1) % 3]];
    [three(|k| Edge::new(ends(plane_b, k), side[k])), three(|l| Edge::new(ends(plane_a, l), three(|k| side[k][l])))]
}

/// Whether the boxes of the triangles are apart, for certain.
#[inline(always)]
pub(super) fn boxes_apart(coordinates: &Coordinates) -> bool {
    // Two coordinates are wrong by at most 1 + 2^(level-2) together.
    boxes_apart_by(2 + (1 << coordinates.level >> 2), coordinates)
}

/// Whether the boxes have a gap of at least this along some axis.
#[inline(always)]
pub(super) fn boxes_apart_by(gap: i64, Coordinates { points, .. }: &Coordinates) -> bool {
    let apart = |j: usize| {
        let [v1, v2, w0, w1, w2] = points.along(j);
        let (a, b) = ([0.min(v1).min(v2), 0.max(v1).max(v2)], [w0.min(w1).min(w2), w0.max(w1).max(w2)]);
        (a[0] - b[1] >= gap) | (b[0] - a[1] >= gap)
    };
    apart(0) | apart(1) | apart(2)
}

/// Bits of the flags: the boxes, the plane of A, that of B, then the edges of A and of B.
const FIRST_EDGE: u32 = 3;
/// The six edges.
const EDGES: u32 = 0b111_111 << FIRST_EDGE;

/// The verdict, with what each of the nine witnesses says.
#[inline(always)]
pub(super) fn outcome(boxes_apart: bool, signs: &Signs) -> Outcome {
    let one_side = |plane: &[i8; 3]| all(plane, 1) | all(plane, -1);
    let mut separated =
        u32::from(boxes_apart) | u32::from(one_side(&signs.plane_a)) << 1 | u32::from(one_side(&signs.plane_b)) << 2;
    let mut overlapping = 0;
    for (i, edge) in (FIRST_EDGE..).zip(edges(signs).iter().flatten()) {
        separated |= u32::from(edge.missed) << i;
        overlapping |= u32::from(edge.pierces) << i;
    }
    // Where triangles meet, two edges take part, or one of each triangle: one edge alone never does.
    let verdict = if separated & !EDGES != 0 || (separated & EDGES).count_ones() >= 5 {
        Verdict::Separate
    } else if overlapping != 0 {
        Verdict::Intersect
    } else {
        Verdict::PossiblyIncorrect
    };
    Outcome { verdict, separated, overlapping, outside: false }
}
