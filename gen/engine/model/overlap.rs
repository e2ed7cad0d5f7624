//! The test of two volumes: section "The test" of docs/engine.md, integer by integer.

use super::block::{Block, Volume};
use crate::format::EngineFormat;
use efsat_hardware::number::floor_shift;
use efsat_unit::pair::Pose;

/// A row of the realignment, of direction 2 i of A: three directions of B with their factors, and the rest. That of direction
/// 2 i + 1 has the opposite directions of B.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct QueryRow {
    /// In each slot, the place of the direction among those of the slot, and its factor in steps of 2^-(factor bits - 1).
    pub terms: [(u32, u32); 3],
    /// What the factors miss, in the same steps of a code.
    pub rest: u32,
}

/// What a query says of the pose, as the test uses it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Frame {
    /// The matrix that meets origins, `[row][column]`, with the fraction of an origin.
    pub matrix: [[i64; 3]; 3],
    /// The shift on the grid.
    pub shift: [i64; 3],
    /// The error of the shift for each axis of A, in steps of the grid.
    pub errors: [u32; 3],
    /// One row for each two opposite directions.
    pub rows: Vec<QueryRow>,
}

impl Frame {
    /// Of the pose words and the rest of the query.
    pub fn new(pose: &Pose, errors: [u32; 3], rows: Vec<QueryRow>, format: &EngineFormat) -> Self {
        let shift = |word: i64| floor_shift(word.into(), format.translation_shift()) as i64;
        Self { matrix: Self::matrix(pose, format), shift: pose.t.map(|x| shift(x.lo)), errors, rows }
    }

    /// The matrix that meets origins.
    pub fn matrix(pose: &Pose, format: &EngineFormat) -> [[i64; 3]; 3] {
        let most = i128::from(format.most_origin());
        let entry = |word: i64| floor_shift(word.into(), format.matrix_shift()).clamp(-most, most) as i64;
        pose.m.map(|row| row.map(|x| entry(x.lo)))
    }
}

/// D: where the origin of B's block is from that of A's, in steps of the grid.
pub type Distance = [i64; 3];

/// D_i = floor(sum_j M_ij o_B,j) + t_i - o_A,i, each brought to the grid.
pub fn distance(frame: &Frame, a: &Block, b: &Block, format: &EngineFormat) -> Distance {
    [0, 1, 2].map(|i| {
        let sum: i64 = (0..3).map(|j| frame.matrix[i][j] * i64::from(b.origin[j])).sum();
        let rotated = floor_shift(sum.into(), format.product_shift()) as i64;
        rotated + frame.shift[i] - (i64::from(a.origin[i]) << format.origin_shift())
    })
}

/// What direction h of A says of two volumes, in steps of the grid: B_h, an upper bound of h . (M o_B + t - o_A); U_h, one of
/// how far B's volume reaches beyond that along h; and V_h, one of how far A's reaches beyond o_A along -h.
pub fn bounds(
    h: usize,
    distance: &Distance,
    frame: &Frame,
    a: &Volume<'_>,
    b: &Volume<'_>,
    format: &EngineFormat,
) -> [i64; 3] {
    let normal = format.directions.vector(h).map(i64::from);
    let base: i64 = (0..3).map(|i| normal[i] * distance[i] + normal[i].abs() * i64::from(frame.errors[i])).sum();
    let row = &frame.rows[h / 2];
    let terms = row.terms.iter().zip(format.directions.slots()).map(|(&(choice, factor), slot)| {
        let direction = usize::from(slot[choice as usize]) ^ (h & 1);
        i64::from(factor) * i64::from(b.codes[direction])
    });
    let sum = terms.sum::<i64>() + i64::from(row.rest);
    let upper = -((-(sum << b.exponent)) >> format.factor_fraction());
    let code = i64::from(a.codes[h ^ 1]) << a.exponent;
    [base, upper, code]
}

/// Whether direction h of A certainly separates the two volumes: B_h + U_h + V_h < 0.
pub fn apart(
    h: usize,
    distance: &Distance,
    frame: &Frame,
    a: &Volume<'_>,
    b: &Volume<'_>,
    format: &EngineFormat,
) -> bool {
    bounds(h, distance, frame, a, b, format).iter().sum::<i64>() < 0
}

/// Whether the volumes of child p of A's block and of child q of B's may overlap; volumes that touch do.
pub fn overlap(frame: &Frame, [a, b]: [&Block; 2], [p, q]: [usize; 2], format: &EngineFormat) -> bool {
    let distance = distance(frame, a, b, format);
    let (a, b) = (a.volume(p), b.volume(q));
    !(0..format.directions.count()).any(|h| apart(h, &distance, frame, &a, &b, format))
}
