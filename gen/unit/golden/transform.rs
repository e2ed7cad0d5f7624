//! The change of frame, B = M * B~ + t (contract section 3).

use super::Pose;
use super::interval::{Number, Rounding, Triple, Wide, dot, sum, three};
use crate::params::{Params, Transform};
use efsat_hardware::number::{Interval, Upper};

/// The transform of one parameter set.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    kind: Transform,
    upper: Upper,
    /// Fraction bits of the input format.
    fraction: u32,
    /// Whether a row sum fits 63 bits.
    narrow: bool,
}

impl Frame {
    pub fn new(p: &Params) -> Self {
        let fraction = p.transform_width - p.int_bits;
        // A row sum has 2 (T - K) fraction bits, and by the declared ranges all its terms stay below 2^K.
        Self { kind: p.transform, upper: p.upper, fraction, narrow: 2 * fraction + p.int_bits <= 62 }
    }

    /// The vertices of B~ in the frame of A, in the input format.
    pub fn apply(&self, pose: &Pose, b: &Triple) -> Triple {
        match self.kind {
            Transform::Off => *b,
            _ if pose.bypass => *b,
            Transform::Translate => {
                let t = three(|i| pose.t[i].interval(self.upper));
                three(|l| three(|i| sum(b[l][i], t[i])))
            }
            Transform::On if self.narrow => self.multiply::<i64>(pose, b),
            Transform::On => self.multiply::<i128>(pose, b),
        }
    }

    /// Row i of the product: sum over j of M_ij * b_j, plus t_i, exact and rounded once.
    fn multiply<W: Wide>(&self, pose: &Pose, b: &Triple) -> Triple {
        let rounding = Rounding::dropping(self.fraction as i32, self.upper);
        let m = three(|i| three(|j| pose.m[i][j].interval(self.upper)));
        let t = three(|i| aligned(pose.t[i].interval(self.upper), self.fraction));
        three(|l| three(|i| rounding.apply(sum(dot::<W>(&m[i], &b[l]), t[i]))))
    }
}

/// The translation at the fraction bits of a product.
#[inline]
fn aligned<W: Wide>(t: Number, fraction: u32) -> Interval<W> {
    Interval::new(W::from(t.lo) << fraction, W::from(t.hi) << fraction)
}
