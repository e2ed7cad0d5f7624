//! Numbers of several pairs, one in each lane of a processor's vectors.
//!
//! They are held in binary64: most processors cannot multiply vectors of 64-bit integers, and integers of up to 53 bits
//! have exact sums and products there, exact powers of two as factors, and floors and ceilings.

use super::axis_test::{AxisTest, Shown};
use super::interval::{Flags, Mantissa, Ordered, Rounding, Triple, Wide};
use crate::pair::{Outcome, Pair, Pose, Verdict};
use efsat_hardware::number::{Interval, Upper};
use std::ops::{Add, BitAnd, BitOr, Mul, Neg, Sub};
use wide::{f64x8, i64x8, u64x8};

/// How many pairs.
pub(super) const LANES: usize = 8;

/// Whether they are faster than one pair after the other: with the vectors of any x86-64, where a floor is a call of a
/// function, they take twice as long.
const PAY: bool = cfg!(target_feature = "avx2");

impl AxisTest {
    /// Appends the verdicts of many pairs inside the declared ranges.
    pub fn verdicts(&self, pose: &Pose, pairs: &[Pair], verdicts: &mut Vec<Verdict>) {
        if !(PAY && self.laned) {
            return verdicts.extend(pairs.iter().map(|pair| self.outcome::<true>(pose, pair).verdict));
        }
        for pairs in pairs.chunks(LANES) {
            verdicts.extend(self.outcomes::<true>(pose, pairs).map(|outcome| outcome.verdict));
        }
    }

    /// The flags of up to [`LANES`] pairs, or with `STOP` those up to the axis by which the last of them is separated.
    pub fn outcomes<const STOP: bool>(&self, pose: &Pose, pairs: &[Pair]) -> impl Iterator<Item = Outcome> {
        let placed = Lanes::gather(pairs.iter().map(|pair| self.placed(pose, pair)));
        let shown = self.test::<Lanes, STOP>(&self.normaliser.apply(&placed));
        shown.lanes().take(pairs.len()).map(Shown::outcome)
    }
}

/// A number of each pair.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lanes(f64x8);

/// A word of flags of each pair; a comparison that holds sets all bits of it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Words(u64x8);

/// A number of binary places of each pair, as a power of two.
#[derive(Clone, Copy)]
pub(super) struct Powers(f64x8);

impl Lanes {
    /// The coordinates of up to [`LANES`] pairs; the lanes behind them are zero.
    #[inline(always)]
    pub fn gather(pairs: impl Iterator<Item = [Triple<i64>; 2]>) -> [Triple<Self>; 2] {
        let mut bounds = [[[[[0.0; LANES]; 2]; 3]; 3]; 2];
        for (lane, pair) in pairs.enumerate() {
            for (to, from) in bounds.iter_mut().flatten().flatten().zip(pair.iter().flatten().flatten()) {
                (to[0][lane], to[1][lane]) = (from.lo as f64, from.hi as f64);
            }
        }
        bounds.map(|x| x.map(|x| x.map(|[lo, hi]| Interval::new(Self(lo.into()), Self(hi.into())))))
    }
}

impl Shown<Words> {
    /// What the axes show of each pair.
    pub fn lanes(self) -> impl Iterator<Item = Shown<u32>> {
        let words = [self.separated, self.overlapping, self.pierced].map(|words| words.0.to_array());
        (0..LANES).map(move |lane| {
            let [separated, overlapping, pierced] = words.map(|words| words[lane] as u32);
            Shown { separated, overlapping, pierced }
        })
    }
}

macro_rules! operator {
    ($type:ident, $trait:ident, $function:ident) => {
        impl $trait for $type {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                Self(self.0.$function(other.0))
            }
        }
    };
}

operator!(Lanes, Add, add);
operator!(Lanes, Sub, sub);
operator!(Lanes, Mul, mul);
operator!(Words, BitAnd, bitand);
operator!(Words, BitOr, bitor);

impl Neg for Lanes {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl From<i64> for Lanes {
    #[inline(always)]
    fn from(x: i64) -> Self {
        Self(f64x8::splat(x as f64))
    }
}

impl Flags for Words {
    #[inline(always)]
    fn bit(self, i: usize) -> Self {
        Self(self.0 & u64x8::splat(1 << i))
    }

    #[inline(always)]
    fn all(self) -> bool {
        self.0.simd_eq(u64x8::ZERO).none()
    }
}

impl Ordered for Lanes {
    type Flags = Words;

    #[inline(always)]
    fn least(self, other: Self) -> Self {
        Self(self.0.fast_min(other.0))
    }

    #[inline(always)]
    fn greatest(self, other: Self) -> Self {
        Self(self.0.fast_max(other.0))
    }

    #[inline(always)]
    fn below(&self, other: &Self) -> Words {
        Words(self.0.simd_lt(other.0).to_bits())
    }

    #[inline(always)]
    fn select(held: Words, one: Self, other: Self) -> Self {
        Self(f64x8::from_bits(held.0).select(one.0, other.0))
    }
}

impl Wide for Lanes {
    type Mantissa = Self;
    type Places = Powers;

    #[inline(always)]
    fn shifted(self, places: Powers) -> Self {
        Self(self.0 * places.0)
    }

    #[inline(always)]
    fn rounded(x: Interval<Self>, to: Rounding) -> Interval<Self> {
        debug_assert!(!to.left_out, "integers have no digits below the last place");
        let scale = Powers::new(i64x8::splat(i64::from(to.append) - i64::from(to.drop)));
        let (lo, hi) = (x.lo.shifted(scale).0, x.hi.shifted(scale).0);
        let hi = match to.upper {
            Some(Upper::Implied) if to.drop > 0 => hi.floor() + f64x8::ONE,
            Some(Upper::Sticky) => hi.ceil(),
            _ => hi.floor(),
        };
        let bound = f64x8::splat(to.clamp as f64);
        let clamp = |x: f64x8| Self(x.fast_clamp(-bound, bound));
        Interval::new(clamp(lo.floor()), clamp(hi))
    }
}

impl Mantissa for Lanes {
    #[inline(always)]
    fn free_places(x: Interval<Self>, length: u32, most: u32) -> Powers {
        let greatest = x.lo.0.abs().fast_max(x.hi.0.abs());
        // The greatest n with 2^n <= greatest; less than any other for zero.
        let n = (greatest.to_bits() >> EXPONENT_AT).cast_signed() - i64x8::splat(EXPONENT_OF_1);
        let free = i64x8::splat(i64::from(length) - 1) - n;
        Powers::new(free.max(i64x8::ZERO).min(i64x8::splat(most.into())))
    }
}

impl Powers {
    #[inline(always)]
    fn new(places: i64x8) -> Self {
        Self(f64x8::from_bits((places + i64x8::splat(EXPONENT_OF_1)).cast_unsigned() << EXPONENT_AT))
    }
}

/// Where the exponent of a binary64 number begins.
const EXPONENT_AT: u32 = f64::MANTISSA_DIGITS - 1;
/// What it is for 1.
const EXPONENT_OF_1: i64 = f64::MAX_EXP as i64 - 1;
