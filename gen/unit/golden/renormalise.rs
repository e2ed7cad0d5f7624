//! The pair moved to the origin and scaled up, each coordinate axis by its own power of two (contract section 4, the
//! paper's 2.5).

use super::interval::{Mantissa, Rounding, Triple, three};
use super::{Exact, Stage};
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
    pub fn new(p: &Params, exact: Exact) -> Self {
        let (n, t) = (p.width as i32, p.transform_width as i32);
        // x * 2^(T+1-L) has T+1 fraction bits where 2^L counts as 1; N-2 of them stay.
        let rounding = match p.renormalise {
            true => Rounding::dropping(t + 3 - n, p.upper).of_shifted(),
            false => Rounding::dropping(t - n, p.upper),
        };
        let rounding = rounding.left_out_if(exact.has(Stage::Renormalise));
        Self { renormalise: p.renormalise, transform_width: p.transform_width, rounding }
    }

    /// The coordinates of A and B in the format of the axis test.
    pub fn apply<M: Mantissa>(&self, a: &Triple<M>, b: &Triple<M>) -> [Triple<M>; 2] {
        let shift = self.renormalise.then(|| three(|i| self.axis(a, b, i)));
        let normalised = |x: &Interval<M>, i: usize| {
            let Some(shift) = &shift else { return self.rounding.apply(x.clone()) };
            let (origin, left) = &shift[i];
            let moved = |x: &M| (x.clone() - origin.clone()).times_power(*left);
            self.rounding.apply(Interval::new(moved(&x.lo), moved(&x.hi)))
        };
        let triangle = |x: &Triple<M>| three(|k| three(|i| normalised(&x[k][i], i)));
        [triangle(a), triangle(b)]
    }

    /// For coordinate axis `i`: the lower bound of V0, an exact constant, and T + 1 - L.
    ///
    /// 2^L is the least power of two above every magnitude.
    fn axis<M: Mantissa>(&self, a: &Triple<M>, b: &Triple<M>, i: usize) -> (M, u32) {
        let origin = &a[0][i].lo;
        let [p, q, r] = a.each_ref().map(|x| &x[i]);
        let [s, t, u] = b.each_ref().map(|x| &x[i]);
        let bounds = [&p.lo, &p.hi, &q.lo, &q.hi, &r.lo, &r.hi, &s.lo, &s.hi, &t.lo, &t.hi, &u.lo, &u.hi];
        let length = M::length(bounds.map(|x| x.clone() - origin.clone()).iter());
        (origin.clone(), (self.transform_width as i32 + 1 - length) as u32)
    }
}
