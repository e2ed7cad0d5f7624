//! The change of frame, B = M * B~ + t (contract section 3).

use super::interval::{Rounding, Triple, Wide, dot, sum, three};
use super::{Loss, Lossless, Numbers};
use crate::params::{Params, Transform};
use efsat_hardware::number::Interval;

/// The transform of one parameter set.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    kind: Transform,
    /// Fraction bits of the input format.
    fraction: u32,
    rounding: Rounding,
    /// Whether a row sum fits 63 bits.
    pub narrow: bool,
}

impl Frame {
    pub fn new(p: &Params, exact: Lossless) -> Self {
        let fraction = p.transform_width - p.int_bits;
        let rounding = Rounding::dropping(fraction as i32, p.upper).left_out_if(exact.has(Loss::Transform));
        // A row sum has 2 (T - K) fraction bits, and by the declared ranges all its terms stay below 2^K.
        Self { kind: p.transform, fraction, rounding, narrow: 2 * fraction + p.int_bits <= 62 }
    }

    /// The vertices of A, and those of B~ in the frame of A, in the input format.
    ///
    /// With a matrix: row i of the product, sum over j of M_ij * b_j, plus t_i, exact and rounded once.
    #[inline(always)]
    pub fn apply<W: Wide<Places = u32>>(&self, numbers: &Numbers<W::Mantissa>) -> [Triple<W::Mantissa>; 2] {
        let b = &numbers.b;
        let moved = match (&numbers.pose, self.kind) {
            (None, _) => b.clone(),
            (Some((_, t)), Transform::Translate) => three(|l| three(|i| sum(b[l][i].clone(), t[i].clone()))),
            (Some((m, t)), _) => {
                // The translation at the fraction bits of a product.
                let aligned = |x: &W::Mantissa| W::from(x.clone()).shifted(self.fraction);
                let t = t.each_ref().map(|x| Interval::new(aligned(&x.lo), aligned(&x.hi)));
                three(|l| three(|i| self.rounding.apply(sum(dot::<W>(&m[i], &b[l]), t[i].clone()))))
            }
        };
        [numbers.a.clone(), moved]
    }
}
