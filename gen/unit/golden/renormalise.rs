//! The pair moved to the origin and scaled up, each coordinate axis by its own power of two (contract section 4, the
//! paper's 2.5).

use super::interval::{Mantissa, Rounding, Triple, hull, shifted, three};
use super::{Loss, Lossless};
use crate::params::Params;
use efsat_hardware::number::Interval;

/// Brings the twelve bounds along each coordinate axis to the working width.
#[derive(Clone, Copy, Debug)]
pub(super) struct Normaliser {
    renormalise: bool,
    transform_width: u32,
    rounding: Rounding,
}

impl Normaliser {
    pub fn new(p: &Params, exact: Lossless) -> Self {
        let (n, t) = (p.width as i32, p.transform_width as i32);
        // x * 2^(T+1-L) has T+1 fraction bits where 2^L counts as 1; N-2 of them stay.
        let rounding = match p.renormalise {
            true => Rounding::dropping(t + 3 - n, p.upper).of_shifted(),
            false => Rounding::dropping(t - n, p.upper),
        };
        let rounding = rounding.left_out_if(exact.has(Loss::Renormalise));
        Self { renormalise: p.renormalise, transform_width: p.transform_width, rounding }
    }

    /// The coordinates of A and B in the format of the axis test.
    #[inline(always)]
    pub fn apply<M: Mantissa>(&self, placed: &[Triple<M>; 2]) -> [Triple<M>; 2] {
        let shift = self.renormalise.then(|| three(|i| self.axis(placed, i)));
        let normalised = |x: &Interval<M>, i: usize| {
            let Some(shift) = &shift else { return self.rounding.apply(x.clone()) };
            let (origin, left) = &shift[i];
            self.rounding.apply(shifted(moved(x.clone(), origin), *left))
        };
        let triangle = |x: &Triple<M>| three(|k| three(|i| normalised(&x[k][i], i)));
        [triangle(&placed[0]), triangle(&placed[1])]
    }

    /// For coordinate axis `i`: the lower bound of V0, an exact constant, and T + 1 - L.
    ///
    /// 2^L is the least power of two above every magnitude.
    #[inline(always)]
    fn axis<M: Mantissa>(&self, [a, b]: &[Triple<M>; 2], i: usize) -> (M, M::Places) {
        let origin = &a[0][i].lo;
        let around = |x: &Triple<M>| hull(hull(x[0][i].clone(), x[1][i].clone()), x[2][i].clone());
        let length = self.transform_width + 1;
        let all = moved(hull(around(a), around(b)), origin);
        (origin.clone(), M::free_places(all, length, length))
    }
}

/// As seen from an exact constant.
#[inline(always)]
fn moved<M: Mantissa>(x: Interval<M>, origin: &M) -> Interval<M> {
    Interval::new(x.lo - origin.clone(), x.hi - origin.clone())
}
