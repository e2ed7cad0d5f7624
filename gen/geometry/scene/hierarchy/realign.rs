//! The DOPs of one tree in the frame of another: weak duality in fixed point.

use super::tree::{DopTree, ceil_log2, scaled};
use crate::directions::Term;
use crate::scene::Pose;
use nalgebra::Vector3;

/// The greatest factor of a realignment is at most 2^FACTOR_BITS in units of its last place: 21 bits.
const FACTOR_BITS: i32 = 20;
/// Offsets in the frame of A are clamped to it: beyond any offset of A, whose greatest is below 2^22.
const FAR: i64 = 1 << 28;
/// What factors are clamped to, those of matrices near the end of the numbers.
const MOST: f64 = (1u64 << FACTOR_BITS) as f64;
/// Constants beyond it are clamped; the sums that are added to them cannot make up for it.
const BEYOND: f64 = (1u64 << 61) as f64;

/// How a DOP of B looks from A: for every direction of A, three offsets of B and their factors, and a constant.
///
/// The offset in direction h is `constant + ceil(2^-shift sum of factor_j d_j)`, in steps of A's grid; it is an upper
/// bound of h . (M x + t - c_A) over all x of the DOP. See `docs/hierarchy.md`.
pub(super) struct Realignment {
    rows: Vec<Row>,
    shift: i32,
}

struct Row {
    /// Which directions of B.
    terms: [(usize, i64); 3],
    constant: i64,
}

impl Realignment {
    /// From B's frame to A's, in a pose of B as seen from A. Both trees have the same set of directions.
    pub fn new(a: &DopTree, b: &DopTree, pose: &Pose) -> Self {
        let Pose { rotation: m, translation: t } = pose;
        let directions = a.directions;
        let vectors = (0..directions.count()).map(|index| directions.vector(index).map(f64::from));
        let vectors: Vec<Vector3<f64>> = vectors.map(Vector3::from).collect();
        let combinations: Vec<_> = vectors
            .iter()
            .map(|h| {
                let w = m.transpose() * h;
                (w, directions.combination(&w))
            })
            .collect();
        let greatest = combinations.iter().flat_map(|(_, terms)| terms).map(|(_, factor)| *factor).fold(0.0, f64::max);
        let places = FACTOR_BITS - ceil_log2(greatest);
        // Where the centre of B is seen from that of A, and a bound of the error of that and of M^T h.
        let centre = m * b.centre.coords + t - a.centre.coords;
        let size = m.abs() * b.centre.coords.abs() + t.abs() + a.centre.coords.abs();
        let row = |(h, (w, terms)): (&Vector3<f64>, &(Vector3<f64>, [Term; 3]))| {
            let terms = terms.map(|(index, factor)| (index, scaled(factor, places).round().clamp(0.0, MOST) as i64));
            let kept = terms.map(|(index, factor)| (directions.vector(index), scaled(factor as f64, -places)));
            let sum = |axis: usize| kept.iter().map(|(n, factor)| f64::from(n[axis]) * factor).sum::<f64>();
            let scale = kept.iter().map(|(_, factor)| factor).sum::<f64>() + (m.abs().transpose() * h.abs()).max();
            let rest = Vector3::new(sum(0), sum(1), sum(2)) - w;
            let rest = rest.abs().add_scalar(scale * 2f64.powi(-48));
            let rest = scaled(rest.dot(&b.reach), b.exponent);
            let shift = h.dot(&centre) + h.abs().dot(&size) * 2f64.powi(-48);
            let steps = scaled(shift + rest * (1.0 + 2f64.powi(-40)), -a.exponent);
            Row { terms, constant: upper(steps + steps.abs() * 2f64.powi(-48) + 2f64.powi(-20)) }
        };
        Self { rows: vectors.iter().zip(&combinations).map(row).collect(), shift: places + a.exponent - b.exponent }
    }

    /// The offsets of a DOP of B in A's frame.
    pub fn realign(&self, dop: &[i32], out: &mut [i32]) {
        for (row, out) in self.rows.iter().zip(out) {
            let sum: i64 = row.terms.iter().map(|&(index, factor)| factor * i64::from(dop[index])).sum();
            *out = (ceil_shift(sum, self.shift) + row.constant).clamp(-FAR, FAR) as i32;
        }
    }
}

/// The least whole number not below `steps`, clamped; what is no number is far.
fn upper(steps: f64) -> i64 {
    match steps.is_nan() {
        true => BEYOND as i64,
        false => steps.ceil().clamp(-BEYOND, BEYOND) as i64,
    }
}

/// ceil(sum / 2^shift) for |sum| < 2^44; where the shift goes to the left it is clamped, to -2^60 (which is up) and to
/// 2^62, from where no constant leads back.
fn ceil_shift(sum: i64, shift: i32) -> i64 {
    if shift >= 0 {
        return -(-sum >> shift.min(63));
    }
    (i128::from(sum) << (-shift).min(80)).clamp(-(1 << 60), 1 << 62) as i64
}
