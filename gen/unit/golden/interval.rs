//! Interval arithmetic on mantissas: exact sums and products, and the outward rounding that brings a result back to
//! its format (contract section 5, the paper's 2.3).

use std::ops::{Add, BitAnd, BitOr, Mul, Neg, Sub};

use crate::params::FormatRow;
use efsat_hardware::number::{Interval, Upper};

/// Three coordinates or components.
pub(super) type Vector<M> = [Interval<M>; 3];

/// The three vertices of a triangle, or its three edges.
pub(super) type Triple<M> = [Vector<M>; 3];

/// Answers of comparisons, a bit each: one word of them, or a word for each of several pairs.
pub(super) trait Flags: Copy + Default + BitAnd<Output = Self> + BitOr<Output = Self> {
    /// The answer of one comparison as bit `i` of a word.
    fn bit(self, i: usize) -> Self;

    /// Whether no word is zero.
    fn all(self) -> bool;
}

impl Flags for u32 {
    #[inline(always)]
    fn bit(self, i: usize) -> Self {
        self << i
    }

    #[inline(always)]
    fn all(self) -> bool {
        self != 0
    }
}

/// What can be compared: a number, or the numbers of several pairs each with its like.
pub(super) trait Ordered: Clone {
    /// What a comparison gives: zero where it does not hold.
    type Flags: Flags;

    /// The lesser of two.
    fn least(self, other: Self) -> Self;

    /// The greater of two.
    fn greatest(self, other: Self) -> Self;

    /// Whether this is less than the other.
    fn below(&self, other: &Self) -> Self::Flags;

    /// The one where the comparison held, else the other.
    fn select(held: Self::Flags, one: Self, other: Self) -> Self;
}

impl<T: Ord + Clone> Ordered for T {
    type Flags = u32;

    #[inline(always)]
    fn least(self, other: Self) -> Self {
        self.min(other)
    }

    #[inline(always)]
    fn greatest(self, other: Self) -> Self {
        self.max(other)
    }

    #[inline(always)]
    fn below(&self, other: &Self) -> u32 {
        u32::from(self < other)
    }

    #[inline(always)]
    fn select(held: u32, one: Self, other: Self) -> Self {
        if held != 0 { one } else { other }
    }
}

/// A number in which exact products and their sums are held before rounding.
///
/// The unit's are integers, `i64` where they fit, else `i128`; [`Lanes`](super::lanes::Lanes) are those of several
/// pairs. A [`Dyadic`](crate::dyadic::Dyadic) may have digits below the last place, and is what a rounding can be left
/// out with.
pub(super) trait Wide:
    Ordered + From<Self::Mantissa> + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    /// What the number is held in once it is rounded.
    type Mantissa: Mantissa<Flags = Self::Flags, Places = Self::Places>;
    /// A number of binary places.
    type Places: Copy;

    /// Times 2^places.
    fn shifted(self, places: Self::Places) -> Self;

    /// Both bounds brought outward to another format.
    fn rounded(x: Interval<Self>, to: Rounding) -> Interval<Self::Mantissa>;
}

/// A number of any signal of the design, in units of the last place; every format is at most 48 bits wide.
pub(super) trait Mantissa: Wide<Mantissa = Self> + From<i64> {
    /// By how many places, at most `most`, this can be shifted so that all magnitudes in it stay below 2^length.
    fn free_places(x: Interval<Self>, length: u32, most: u32) -> Self::Places;
}

macro_rules! integer {
    ($type:ty) => {
        impl Wide for $type {
            type Mantissa = i64;
            type Places = u32;

            #[inline(always)]
            fn shifted(self, places: u32) -> Self {
                self << places
            }

            #[inline(always)]
            fn rounded(x: Interval<Self>, to: Rounding) -> Interval<i64> {
                debug_assert!(!to.left_out, "integers have no digits below the last place");
                let lo = (x.lo << to.append) >> to.drop;
                let hi = ((x.hi << to.append) + Self::from(to.lift)) >> to.drop;
                // The format table guarantees that a rounded result fits.
                let clamp = |x: Self| (x as i64).clamp(-to.clamp, to.clamp);
                Interval::new(clamp(lo), clamp(hi))
            }
        }
    };
}

integer!(i64);
integer!(i128);

impl Mantissa for i64 {
    #[inline(always)]
    fn free_places(x: Interval<Self>, length: u32, most: u32) -> u32 {
        let both = x.lo.unsigned_abs() | x.hi.unsigned_abs();
        length.saturating_sub(u64::BITS - both.leading_zeros()).min(most)
    }
}

/// A vector, or any three things, by component.
#[inline(always)]
pub(super) fn three<T>(component: impl Fn(usize) -> T) -> [T; 3] {
    [component(0), component(1), component(2)]
}

/// a + b.
#[inline(always)]
pub(super) fn sum<W: Wide>(a: Interval<W>, b: Interval<W>) -> Interval<W> {
    Interval::new(a.lo + b.lo, a.hi + b.hi)
}

/// a - b.
#[inline(always)]
pub(super) fn difference<W: Wide>(a: Interval<W>, b: Interval<W>) -> Interval<W> {
    Interval::new(a.lo - b.hi, a.hi - b.lo)
}

/// -a, exact.
#[inline(always)]
pub(super) fn negated<W: Wide>(a: Interval<W>) -> Interval<W> {
    Interval::new(-a.hi, -a.lo)
}

/// The least interval around both.
#[inline(always)]
pub(super) fn hull<W: Wide>(a: Interval<W>, b: Interval<W>) -> Interval<W> {
    Interval::new(a.lo.least(b.lo), a.hi.greatest(b.hi))
}

/// a * 2^places, exact.
#[inline(always)]
pub(super) fn shifted<W: Wide>(a: Interval<W>, places: W::Places) -> Interval<W> {
    Interval::new(a.lo.shifted(places), a.hi.shifted(places))
}

/// a * b, exact, at full width: the least enclosure, except where both factors straddle zero. That would take four
/// multiplications of hardware, so there the product is [-P, P] with P = max(-a.lo, a.hi) * max(-b.lo, b.hi).
///
/// Each bound is that of two products, one for each bound of a, whose sign tells which bound of b stretches it; where
/// both factors straddle zero, b is first widened to [-max(-b.lo, b.hi), max(-b.lo, b.hi)]. That needs no branch.
#[inline(always)]
pub(super) fn product<W: Wide>(a: &Interval<W::Mantissa>, b: &Interval<W::Mantissa>) -> Interval<W> {
    let zero = W::Mantissa::from(0);
    let signs = |x: &Interval<W::Mantissa>| (x.lo.below(&zero), zero.below(&x.hi));
    let ((minus, plus), (b_minus, b_plus)) = (signs(a), signs(b));
    let straddling = minus & plus & (b_minus & b_plus);
    let select = |flag, one: &W::Mantissa, other: &W::Mantissa| W::Mantissa::select(flag, one.clone(), other.clone());
    let reach = b.hi.clone().greatest(-b.lo.clone());
    let (lo, hi) = (select(straddling, &-reach.clone(), &b.lo), select(straddling, &reach, &b.hi));
    let times = |x: &W::Mantissa, y| W::from(x.clone()) * W::from(y);
    Interval::new(
        times(&a.lo, select(minus, &hi, &lo)).least(times(&a.hi, select(plus, &lo, &hi))),
        times(&a.lo, select(minus, &lo, &hi)).greatest(times(&a.hi, select(plus, &hi, &lo))),
    )
}

/// a . b, exact: accumulated at full product width.
#[inline(always)]
pub(super) fn dot<W: Wide>(a: &Vector<W::Mantissa>, b: &Vector<W::Mantissa>) -> Interval<W> {
    sum(sum(product(&a[0], &b[0]), product(&a[1], &b[1])), product(&a[2], &b[2]))
}

/// Component `i` of a x b, exact: a_j b_k - a_k b_j.
#[inline(always)]
pub(super) fn cross_component<W: Wide>(a: &Vector<W::Mantissa>, b: &Vector<W::Mantissa>, i: usize) -> Interval<W> {
    let (j, k) = ((i + 1) % 3, (i + 2) % 3);
    difference(product(&a[j], &b[k]), product(&a[k], &b[j]))
}

/// How an exact result is brought to a format: drop so many fraction bits outward, then clamp.
///
/// The upper bound is one shift too: floor(x / 2^d) + 1 = floor((x + 2^d) / 2^d) for [`Upper::Implied`], and
/// ceil(x / 2^d) = floor((x + 2^d - 1) / 2^d) for [`Upper::Sticky`]. Where nothing is dropped nothing is added.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rounding {
    pub drop: u32,
    pub append: u32,
    /// What is added to an upper bound before it is shifted.
    lift: i64,
    pub clamp: i64,
    /// The rule for upper bounds; without one they are rounded down too.
    pub upper: Option<Upper>,
    /// Whether numbers come from a shifter, which fills their last places with zeros.
    pub shifted: bool,
    /// Whether the digits below the last place of the format are kept instead, and no clamp is needed.
    pub left_out: bool,
}

impl Rounding {
    /// To fewer fraction bits by `drop`, without a clamp; a negative `drop` appends zeros.
    pub fn dropping(drop: i32, upper: impl Into<Option<Upper>>) -> Self {
        let upper = upper.into();
        let lift = match upper {
            Some(Upper::Implied) if drop > 0 => 1 << drop,
            Some(Upper::Sticky) if drop > 0 => (1 << drop) - 1,
            _ => 0,
        };
        let (drop, append) = (drop.max(0) as u32, (-drop).max(0) as u32);
        Self { drop, append, lift, clamp: i64::MAX, upper, shifted: false, left_out: false }
    }

    /// From `fraction` fraction bits to the format of `row`, clamped as the row says.
    pub fn to_row(fraction: i32, row: &FormatRow, upper: impl Into<Option<Upper>>) -> Self {
        let clamp = row.clamp.map_or(i64::MAX, |c| c.bound as i64);
        Self { clamp, ..Self::dropping(fraction - row.format.fraction, upper) }
    }

    /// For numbers from a shifter: the zeros behind their last digits are dropped like digits.
    pub fn of_shifted(self) -> Self {
        Self { shifted: true, ..self }
    }

    /// The same change of format, without rounding if `left_out`.
    pub fn left_out_if(self, left_out: bool) -> Self {
        Self { left_out, ..self }
    }

    /// Rounds outward: down by the floor, up by the one rule for every upper bound of the design.
    #[inline(always)]
    pub fn apply<W: Wide>(self, x: Interval<W>) -> Interval<W::Mantissa> {
        W::rounded(x, self)
    }
}
