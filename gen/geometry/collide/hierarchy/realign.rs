//! The DOPs of one tree in the frame of another: weak duality in fixed point.

use super::Directions;
use super::family::{Group, LANES, groups};
use super::tree::DopTree;
use crate::collide::Pose;
use crate::power::{ceil_log2, scaled};
use nalgebra::Vector3;

/// The greatest factor of a realignment is at most 2^FACTOR_BITS in units of its last place: 21 bits.
const FACTOR_BITS: i32 = 20;
/// Offsets in the frame of A are clamped to it: beyond any offset of A, whose greatest is below 2^22.
const FAR: f64 = (1u64 << 28) as f64;
/// The most groups of a family.
const GROUPS: usize = groups(Directions::TwentySix);
/// What factors are clamped to, those of matrices near the end of the numbers.
const MOST: f64 = (1u64 << FACTOR_BITS) as f64;
/// Constants beyond it are clamped; the sums that are added to them cannot make up for it.
const BEYOND: f64 = (1u64 << 61) as f64;

/// Sums are clamped between these, where their grid is that much coarser; no constant leads back.
const LEAST_SUM: f64 = -((1u64 << 60) as f64);
const GREATEST_SUM: f64 = (1u64 << 62) as f64;
/// Numbers around it are whole, and their lowest 32 bits are those of what was added to it.
const WHOLE: f64 = 1.5 * (1u64 << 52) as f64;
/// The greatest shift either way: by as much no sum leaves the normal numbers, and any sum is beyond these, or below 1.
const SHIFTS: i32 = 200;

/// How a DOP of B looks from A: for every direction of A, three offsets of B and their factors, and a constant.
///
/// The offset in direction h is `constant + ceil(2^-shift sum of factor_j d_j)`, in steps of A's grid; it is an upper
/// bound of h . (M x + t - c_A) over all x of the DOP. See `docs/hierarchy.md`. All are whole numbers, though in binary64: sums are
/// below 2^46, and what is beyond 2^53 is clamped.
pub(super) struct Realignment {
    /// For each place in a family, that of the opposite of a direction of A: three directions of B and their factors.
    terms: [[(u32, f64); 3]; GROUPS * LANES / 2],
    /// Each for both children, at the same places.
    constants: [[f64; LANES]; GROUPS],
    /// 2^-shift.
    scale: f64,
}

impl Realignment {
    /// From B's frame to A's, in a pose of B as seen from A. Both trees have the same set of directions.
    pub fn new(a: &DopTree, b: &DopTree, pose: &Pose) -> Self {
        let Pose { rotation: m, translation: t } = pose;
        let directions = a.directions;
        // The entries without the power of two of the greatest, so that no sum of them overflows. Of those that are less than 2^-969 of
        // it the last bits may be lost, below 2^-1074, which `rest` allows for by far.
        let power = ceil_log2(m.amax());
        let unit = m.map(|x| scaled(x, -power));
        // Of each direction and its opposite, the first; what is a sum for one is, of opposites, a sum for the other.
        let axes = (0..directions.count()).step_by(2).map(|index| {
            let h = Vector3::from(directions.vector(index).map(f64::from));
            let w = unit.transpose() * h;
            (index, h, w, directions.combination(&w))
        });
        let axes: Vec<_> = axes.collect();
        let greatest = axes.iter().flat_map(|(_, _, _, terms)| terms).map(|(_, factor)| *factor).fold(0.0, f64::max);
        let places = FACTOR_BITS - ceil_log2(greatest);
        // Where the centre of B is seen from that of A, and a bound of the error of that. Where a sum overflows, so does the bound, and
        // then the constant, which is infinite or no number, is far.
        let centre = m * b.centre.coords + t - a.centre.coords;
        let size = m.abs() * b.centre.coords.abs() + t.abs() + a.centre.coords.abs();
        let mut realignment = Self {
            terms: Default::default(),
            constants: Default::default(),
            scale: scaled(1.0, (power + b.exponent - a.exponent - places).clamp(-SHIFTS, SHIFTS)),
        };
        for (index, h, w, terms) in axes {
            // Poses and trees are finite, and so is every factor. If one were not, `max` would make it 0, and `rest`, of which it is a part
            // through w, would make the constant far.
            let terms = terms.map(|(index, factor)| (index, scaled(factor, places).round().clamp(0.0, MOST).max(0.0)));
            let kept = terms.map(|(index, factor)| (directions.vector(index), scaled(factor, -places)));
            let sum = |axis: usize| kept.iter().map(|(n, factor)| f64::from(n[axis]) * factor).sum::<f64>();
            let scale = kept.iter().map(|(_, factor)| factor).sum::<f64>() + (unit.abs().transpose() * h.abs()).max();
            let rest = Vector3::new(sum(0), sum(1), sum(2)) - w;
            let rest = rest.abs().add_scalar(scale * 2f64.powi(-48));
            let rest = scaled(rest.dot(&b.reach), power + b.exponent);
            let error = h.abs().dot(&size) * 2f64.powi(-48);
            for (opposite, sign) in [(0, 1.0), (1, -1.0)] {
                let shift = sign * h.dot(&centre) + error;
                let steps = scaled(shift + rest * (1.0 + 2f64.powi(-40)), -a.exponent);
                let constant = upper(steps + steps.abs() * 2f64.powi(-48) + 2f64.powi(-20));
                let place = index ^ opposite ^ 1;
                realignment.constants.as_flattened_mut()[2 * place..][..2].fill(constant);
                realignment.terms[place] = terms.map(|(index, factor)| ((index ^ opposite) as u32, factor));
            }
        }
        realignment
    }

    /// The offsets of a family of B in A's frame, each at the place of the opposite direction: beside what it is compared with.
    #[inline(always)]
    pub fn realign<const GROUPS: usize>(&self, family: &[Group; GROUPS], out: &mut [Group; GROUPS]) {
        // A power of two of them, so that no index is beyond it.
        let mut offsets = [[0.0; 2]; 32];
        for (from, to) in family.iter().zip(offsets.as_flattened_mut().as_chunks_mut::<LANES>().0) {
            *to = from.0.map(f64::from);
        }
        let mut sums = [[0.0; LANES]; GROUPS];
        for (terms, sums) in self.terms.iter().zip(sums.as_flattened_mut().as_chunks_mut::<2>().0) {
            let [x, y, z] = terms.map(|(index, factor)| offsets[index as usize & 31].map(|offset| factor * offset));
            *sums = [x[0] + y[0] + z[0], x[1] + y[1] + z[1]];
        }
        // One loop over all lanes, which is vectorised.
        let mut steps = [[0; LANES]; GROUPS];
        let lanes = sums.as_flattened().iter().zip(self.constants.as_flattened()).zip(steps.as_flattened_mut());
        for ((sum, constant), steps) in lanes {
            // `clamp` keeps NaN, of which the conversion would make 0; but sums are whole numbers below 2^46, the scale is a normal number,
            // and `upper` has made every constant finite.
            let sum = (sum * self.scale).ceil().clamp(LEAST_SUM, GREATEST_SUM);
            *steps = ((sum + constant).clamp(-FAR, FAR) + WHOLE).to_bits() as i32;
        }
        *out = steps.map(Group);
    }
}

/// The least whole number not below `steps`, clamped; what is no number is far.
fn upper(steps: f64) -> f64 {
    if steps.is_nan() { BEYOND } else { steps.ceil().clamp(-BEYOND, BEYOND) }
}
