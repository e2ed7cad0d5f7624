//! Exact numbers as the unit reads them.

use crate::dyadic::Dyadic;
use crate::pair::Input;

impl Dyadic {
    /// The floor at `fraction` fraction bits and its sticky bit, if the real number lies in
    /// `[-bound, bound] * 2^-fraction`.
    pub fn quantised(self, fraction: u32, bound: i128) -> Option<Input> {
        let (lo, sticky) = self.scaled(fraction.into()).floor_and_rest()?;
        let inside = -bound <= lo.into() && i128::from(lo) + i128::from(sticky) <= bound;
        inside.then_some(Input { lo, sticky })
    }
}
