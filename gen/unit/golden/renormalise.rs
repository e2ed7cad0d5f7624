//! The pair moved to the origin and scaled up, each coordinate axis by its own power of two (contract section 4, the
//! paper's 2.5).

use super::interval::{Number, Rounding, Triple, three};
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
    pub fn new(p: &Params) -> Self {
        let (n, t) = (p.width as i32, p.transform_width as i32);
        // x * 2^(T+1-L) has T+1 fraction bits where 2^L counts as 1; N-2 of them stay.
        let drop = if p.renormalise { t + 3 - n } else { t - n };
        let rounding = Rounding::dropping(drop, p.upper);
        Self { renormalise: p.renormalise, transform_width: p.transform_width, rounding }
    }

    /// The coordinates of A and B in the format of the axis test.
    pub fn apply(&self, a: &Triple, b: &Triple) -> [Triple; 2] {
        let shift = if self.renormalise { three(|i| self.axis(a, b, i)) } else { [(0, 0); 3] };
        let normalised = |x: Number, (origin, left): (i64, u32)| {
            self.rounding.apply(Interval::new((x.lo - origin) << left, (x.hi - origin) << left))
        };
        let triangle = |x: &Triple| three(|k| three(|i| normalised(x[k][i], shift[i])));
        [triangle(a), triangle(b)]
    }

    /// For coordinate axis `i`: the lower bound of V0, an exact constant, and T + 1 - L.
    ///
    /// 2^L is the least power of two above every magnitude, read off the bitwise OR of the magnitudes.
    fn axis(&self, a: &Triple, b: &Triple, i: usize) -> (i64, u32) {
        let origin = a[0][i].lo;
        let magnitude = |x: Number| (x.lo - origin).unsigned_abs() | (x.hi - origin).unsigned_abs();
        let all = (0..3).fold(0, |all, k| all | magnitude(a[k][i]) | magnitude(b[k][i]));
        let length = u64::BITS - all.leading_zeros();
        (origin, self.transform_width + 1 - length)
    }
}
