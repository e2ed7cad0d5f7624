//! The first level of products: the moments of the edges of B, and the normal of A (section 4 of docs/determinants.md).

use super::differences::Points;
use super::number::{Vector, cross, round};
use crate::golden::interval::three;
use crate::params::Params;

/// m_l = W_l x W_(l+1) and n_A = V1 x V2.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::golden) struct Moments {
    pub m: [Vector; 3],
    pub n: Vector,
}

impl Moments {
    /// Exact: at most 2 (R-1)^2 < 2^63 in magnitude.
    #[inline(always)]
    pub fn new(points: &Points) -> Self {
        let [w0, w1, w2] = &points.w;
        Self { m: [cross(w0, w1), cross(w1, w2), cross(w2, w0)], n: cross(&points.v[0], &points.v[1]) }
    }

    /// All divided by 2^shift and rounded.
    #[inline(always)]
    fn rounded(&self, shift: u32) -> Self {
        let vector = |x: &Vector| three(|j| round(x[j], shift));
        Self { m: self.m.each_ref().map(vector), n: vector(&self.n) }
    }
}

/// How moments are brought to the working width.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rounding {
    width: u32,
    span: u32,
}

impl Rounding {
    pub fn new(p: &Params) -> Self {
        Self { width: p.width, span: p.span }
    }

    /// The moments in N bits, and their shift s: the least from N - span to N with which all of them fit.
    #[inline(always)]
    pub fn apply(&self, moments: &Moments) -> (Moments, u32) {
        let components = || moments.m.iter().flatten().chain(&moments.n).copied();
        let (least, greatest) = components().fold((0, 0), |(least, greatest), x| (x.min(least), x.max(greatest)));
        let end = 1 << (self.width - 1);
        let fits = |s: u32| -end <= round(least, s) && round(greatest, s) < end;
        let shift = (self.width - self.span..self.width).find(|&s| fits(s)).unwrap_or(self.width);
        (moments.rounded(shift), shift)
    }
}
