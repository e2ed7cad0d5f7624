//! From the projections on one axis to the verdict of the pair (contract sections 6 and 7, the paper's equations 3
//! and 6, and the one test that replaces 7 to 9).

use super::interval::Mantissa;
use crate::pair::{Outcome, Verdict};
use efsat_hardware::number::Interval;

/// The 11 axes whose certain overlap is asked for by `intersect`.
const ELEVEN: u32 = (1 << 11) - 1;

impl Outcome {
    /// Section 7: one separated axis decides; else all of the 11 must surely overlap, or an edge pass through the other
    /// triangle.
    pub(super) fn new(separated: u32, overlapping: u32, pierced: bool) -> Self {
        let verdict = if separated != 0 {
            Verdict::Separate
        } else if pierced || overlapping & ELEVEN == ELEVEN {
            Verdict::Intersect
        } else {
            Verdict::PossiblyIncorrect
        };
        Self { verdict, separated, overlapping, outside: false }
    }

    /// Section 10: no flag of any axis is set, so that section 7 makes it possibly-incorrect.
    pub(crate) fn outside() -> Self {
        Self { outside: true, ..Self::new(0, 0, false) }
    }
}

/// Enclosures of the least and greatest projection of both triangles on one axis.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Enclosure<M> {
    pub a_min: Interval<M>,
    pub a_max: Interval<M>,
    pub b_min: Interval<M>,
    pub b_max: Interval<M>,
}

impl<M: Mantissa> Enclosure<M> {
    /// Equation (3) on intervals: the enclosure of a minimum takes the minima of both bounds.
    #[inline(always)]
    pub fn new(a: &[Interval<M>; 3], b: &[Interval<M>; 3]) -> Self {
        let min = |x: Interval<M>, y: Interval<M>| Interval::new(x.lo.least(y.lo), x.hi.least(y.hi));
        let max = |x: Interval<M>, y: Interval<M>| Interval::new(x.lo.greatest(y.lo), x.hi.greatest(y.hi));
        let least = |[x, y, z]: [Interval<M>; 3]| min(min(x, y), z);
        let greatest = |[x, y, z]: [Interval<M>; 3]| max(max(x, y), z);
        Self {
            a_min: least(a.clone()),
            a_max: greatest(a.clone()),
            b_min: least(b.clone()),
            b_max: greatest(b.clone()),
        }
    }

    /// Equation (6): the images are certainly disjoint.
    #[inline(always)]
    pub fn separated(&self) -> M::Flags {
        self.a_max.hi.below(&self.b_min.lo) | self.b_max.hi.below(&self.a_min.lo)
    }

    /// The images certainly overlap. Strict: on an axis that projects all six points to one true number t,
    /// a_min.hi >= t >= b_max.lo, so such an axis can never say this, and that is what makes 11 axes sound.
    #[inline(always)]
    pub fn overlapping(&self) -> M::Flags {
        self.a_min.hi.below(&self.b_max.lo) & self.b_min.hi.below(&self.a_max.lo)
    }
}
