//! Interval arithmetic on mantissas: exact sums and products, and the outward rounding that brings a result back to
//! its format (contract section 5, the paper's 2.3).

use std::ops::{Add, Mul, Neg, Sub};

use crate::params::Row;
use efsat_hardware::number::{Interval, Upper};

/// Three coordinates or components.
pub(super) type Vector<M> = [Interval<M>; 3];

/// The three vertices of a triangle, or its three edges.
pub(super) type Triple<M> = [Vector<M>; 3];

/// A number in which exact products and their sums are held before rounding.
///
/// The unit's are integers, `i64` where they fit, else `i128`. A [`Dyadic`](crate::dyadic::Dyadic) may
/// have digits below the last place, and is what a rounding can be left out with.
pub(super) trait Wide:
    Clone + Ord + From<Self::Mantissa> + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    /// What the number is held in once it is rounded.
    type Mantissa: Mantissa;

    /// Times 2^power.
    fn times_power(self, power: u32) -> Self;

    /// Both bounds brought outward to another format.
    fn rounded(x: Interval<Self>, to: Rounding) -> Interval<Self::Mantissa>;
}

/// A number of any signal of the design, in units of the last place; every format is at most 48 bits wide.
pub(super) trait Mantissa: Wide<Mantissa = Self> + From<i64> {
    /// The least p with all these magnitudes below 2^p; any p if all are zero.
    fn length<'a>(numbers: impl Iterator<Item = &'a Self>) -> i32
    where
        Self: 'a;
}

macro_rules! integer {
    ($type:ty) => {
        impl Wide for $type {
            type Mantissa = i64;

            #[inline(always)]
            fn times_power(self, power: u32) -> Self {
                self << power
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
    fn length<'a>(numbers: impl Iterator<Item = &'a Self>) -> i32 {
        let all = numbers.fold(0, |all, x| all | x.unsigned_abs());
        (u64::BITS - all.leading_zeros()) as i32
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

/// The three sign cases of a factor; a zero bound counts as non-negative.
#[derive(Clone, Copy)]
enum Sign {
    Plus,
    Minus,
    Straddling,
}

#[inline(always)]
fn sign<M: Mantissa>(a: &Interval<M>) -> Sign {
    let zero = M::from(0);
    if a.lo >= zero {
        Sign::Plus
    } else if a.hi <= zero {
        Sign::Minus
    } else {
        Sign::Straddling
    }
}

/// a * b, exact, at full width, by Kulisch's nine sign cases.
///
/// In eight of them this is the least enclosure and takes two multiplications. Where both factors straddle zero it
/// would take four, and the product is the wider [-P, P] with P = max(-a.lo, a.hi) * max(-b.lo, b.hi) instead.
#[inline(always)]
pub(super) fn product<W: Wide>(a: &Interval<W::Mantissa>, b: &Interval<W::Mantissa>) -> Interval<W> {
    product_by(sign(b), a, b)
}

/// [`product`] with the sign case of `b` known: each bound of the product then belongs to one bound of `a`, and that
/// bound's sign tells which bound of `b` stretches it.
#[inline(always)]
fn product_by<W: Wide>(sign_b: Sign, a: &Interval<W::Mantissa>, b: &Interval<W::Mantissa>) -> Interval<W> {
    let zero = W::Mantissa::from(0);
    let times = |x: &W::Mantissa, y: &W::Mantissa| W::from(x.clone()) * W::from(y.clone());
    match sign_b {
        Sign::Plus => {
            let lo = if a.lo >= zero { &b.lo } else { &b.hi };
            let hi = if a.hi >= zero { &b.hi } else { &b.lo };
            Interval::new(times(&a.lo, lo), times(&a.hi, hi))
        }
        Sign::Minus => {
            let lo = if a.hi >= zero { &b.lo } else { &b.hi };
            let hi = if a.lo >= zero { &b.hi } else { &b.lo };
            Interval::new(times(&a.hi, lo), times(&a.lo, hi))
        }
        Sign::Straddling => match sign(a) {
            Sign::Plus => Interval::new(times(&a.hi, &b.lo), times(&a.hi, &b.hi)),
            Sign::Minus => Interval::new(times(&a.lo, &b.hi), times(&a.lo, &b.lo)),
            Sign::Straddling => {
                let reach = |x: &Interval<W::Mantissa>| x.hi.clone().max(-x.lo.clone());
                let hi = times(&reach(a), &reach(b));
                Interval::new(-hi.clone(), hi)
            }
        },
    }
}

/// a . b, exact: accumulated at full product width.
#[inline(always)]
pub(super) fn dot<W: Wide>(a: &Vector<W::Mantissa>, b: &Vector<W::Mantissa>) -> Interval<W> {
    sum(sum(product(&a[0], &b[0]), product(&a[1], &b[1])), product(&a[2], &b[2]))
}

/// [`dot`] of every point of both triangles with one direction; the sign cases of the direction are told apart once.
#[inline(always)]
pub(super) fn dots<W: Wide>(
    points: &[Triple<W::Mantissa>; 2],
    direction: &Vector<W::Mantissa>,
) -> [[Interval<W>; 3]; 2] {
    let zero = || W::from(W::Mantissa::from(0));
    let none = || three(|_| Interval::new(zero(), zero()));
    let mut sums = [none(), none()];
    for (i, d) in direction.iter().enumerate() {
        let mut add = |case: Sign| {
            for (sums, triangle) in sums.iter_mut().zip(points) {
                for (s, point) in sums.iter_mut().zip(triangle) {
                    *s = sum(s.clone(), product_by(case, &point[i], d));
                }
            }
        };
        match sign(d) {
            Sign::Plus => add(Sign::Plus),
            Sign::Minus => add(Sign::Minus),
            Sign::Straddling => add(Sign::Straddling),
        }
    }
    sums
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
    pub fn to_row(fraction: i32, row: &Row, upper: impl Into<Option<Upper>>) -> Self {
        let clamp = row.clamp.map_or(i64::MAX, |c| c.bound as i64);
        Self { clamp, ..Self::dropping(fraction - row.format.fraction, upper) }
    }

    /// For numbers from a shifter: the zeros behind their last digits are dropped like digits.
    pub fn of_shifted(self) -> Self {
        Self { shifted: true, ..self }
    }

    /// The same for numbers shifted left by so many places.
    pub fn behind_shift(self, left: u32) -> Self {
        Self { append: self.append + left, ..self }
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
