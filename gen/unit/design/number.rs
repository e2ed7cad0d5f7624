//! Numbers as the host quantises them: a lower bound, and how far above it the upper bound is.

use super::interval::Interval;
use crate::params::Params;
use efsat_hardware::graph::{Sig, Signals, Top};
use efsat_hardware::number::Upper;
use efsat_hardware::op::Type;
use efsat_hardware::record;

record! {
    /// An input number.
    Number "number" {
        /// Lower bound.
        lo: S,
        /// With [`Upper::Sticky`]: the upper bound is one unit in the last place above, else exactly the lower one.
        sticky: Option<S>,
    }
}

/// The type of an input number.
pub fn input_type(p: &Params) -> Type {
    let format = p.input();
    Type::signed(format.bits, format.fraction)
}

impl<'l> Number<Sig<'l>> {
    /// An input; of a guarded unit any word may come.
    pub fn input(u: Top<'l>, p: &Params, bound: i128) -> Self {
        let ty = input_type(p);
        let range = if p.guarded() { ty.limits() } else { (-bound, bound) };
        let lo = u.input(ty, range);
        Self { lo, sticky: (p.upper == Upper::Sticky).then(|| u.input(Type::FLAG, (0, 1))) }
    }

    /// Flag: the upper bound is above the lower one.
    pub fn inexact(self) -> Sig<'l> {
        self.sticky.unwrap_or_else(|| self.lo.block().constant(1, Type::FLAG))
    }

    /// The interval: the upper bound is one unit in the last place above the lower one (equation 5), or a sticky bit.
    pub fn interval(self) -> Interval<Sig<'l>> {
        Interval { lo: self.lo, hi: (self.lo + self.inexact()).resize(self.lo.ty()) }
    }

    /// The same number, whose ceiling is within the declared bound as its true value is.
    pub fn declared(self, bound: i128) -> Interval<Sig<'l>> {
        let Interval { lo, hi } = self.interval();
        Interval { lo, hi: if self.sticky.is_some() { hi.assume(bound, "declared-range") } else { hi } }
    }
}
