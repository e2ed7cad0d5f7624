//! Interval arithmetic on mantissas: exact sums and products, and the outward rounding that brings a result back to
//! its format (contract section 5, the paper's 2.3).

use std::ops::{Add, Mul, Neg, Shl, Shr, Sub};

use crate::params::Row;
use efsat_hardware::number::{Interval, Upper};

/// A mantissa of any signal of the design; every format is at most 48 bits wide.
pub(super) type Number = Interval<i64>;

/// Three coordinates or components.
pub(super) type Vector = [Number; 3];

/// The three vertices of a triangle, or its three edges.
pub(super) type Triple = [Vector; 3];

/// An integer in which exact products and their sums are held before rounding: `i64` where they fit, else `i128`.
pub(super) trait Wide:
    Copy
    + Ord
    + From<i64>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Neg<Output = Self>
    + Shl<u32, Output = Self>
    + Shr<u32, Output = Self>
{
    /// Back to a mantissa; the format table guarantees that a rounded result fits.
    fn mantissa(self) -> i64;
}

impl Wide for i64 {
    #[inline(always)]
    fn mantissa(self) -> i64 {
        self
    }
}

impl Wide for i128 {
    #[inline(always)]
    fn mantissa(self) -> i64 {
        self as i64
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
fn sign(a: Number) -> Sign {
    if a.lo >= 0 {
        Sign::Plus
    } else if a.hi <= 0 {
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
pub(super) fn product<W: Wide>(a: Number, b: Number) -> Interval<W> {
    product_by(sign(b), a, b)
}

/// [`product`] with the sign case of `b` known: each bound of the product then belongs to one bound of `a`, and that
/// bound's sign tells which bound of `b` stretches it.
#[inline(always)]
fn product_by<W: Wide>(sign_b: Sign, a: Number, b: Number) -> Interval<W> {
    let times = |x: i64, y: i64| W::from(x) * W::from(y);
    match sign_b {
        Sign::Plus => {
            let lo = if a.lo >= 0 { b.lo } else { b.hi };
            let hi = if a.hi >= 0 { b.hi } else { b.lo };
            Interval::new(times(a.lo, lo), times(a.hi, hi))
        }
        Sign::Minus => {
            let lo = if a.hi >= 0 { b.lo } else { b.hi };
            let hi = if a.lo >= 0 { b.hi } else { b.lo };
            Interval::new(times(a.hi, lo), times(a.lo, hi))
        }
        Sign::Straddling => match sign(a) {
            Sign::Plus => Interval::new(times(a.hi, b.lo), times(a.hi, b.hi)),
            Sign::Minus => Interval::new(times(a.lo, b.hi), times(a.lo, b.lo)),
            Sign::Straddling => {
                let reach = times(a.hi.max(-a.lo), b.hi.max(-b.lo));
                Interval::new(-reach, reach)
            }
        },
    }
}

/// a . b, exact: accumulated at full product width.
#[inline(always)]
pub(super) fn dot<W: Wide>(a: &Vector, b: &Vector) -> Interval<W> {
    sum(sum(product(a[0], b[0]), product(a[1], b[1])), product(a[2], b[2]))
}

/// [`dot`] of every point of both triangles with one direction; the sign cases of the direction are told apart once.
#[inline(always)]
pub(super) fn dots<W: Wide>(points: &[Triple; 2], direction: &Vector) -> [[Interval<W>; 3]; 2] {
    let mut sums = [[Interval::new(W::from(0), W::from(0)); 3]; 2];
    for (i, &d) in direction.iter().enumerate() {
        let mut add = |case: Sign| {
            for (sums, triangle) in sums.iter_mut().zip(points) {
                for (s, point) in sums.iter_mut().zip(triangle) {
                    *s = sum(*s, product_by(case, point[i], d));
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
pub(super) fn cross_component<W: Wide>(a: &Vector, b: &Vector, i: usize) -> Interval<W> {
    let (j, k) = ((i + 1) % 3, (i + 2) % 3);
    difference(product(a[j], b[k]), product(a[k], b[j]))
}

/// How an exact result is brought to a format: drop so many fraction bits outward, then clamp.
///
/// The upper bound is one shift too: floor(x / 2^d) + 1 = floor((x + 2^d) / 2^d) for [`Upper::Implied`], and
/// ceil(x / 2^d) = floor((x + 2^d - 1) / 2^d) for [`Upper::Sticky`]. Where nothing is dropped nothing is added.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rounding {
    drop: u32,
    append: u32,
    /// What is added to an upper bound before it is shifted.
    lift: i64,
    clamp: i64,
}

impl Rounding {
    /// To fewer fraction bits by `drop`, without a clamp; a negative `drop` appends zeros.
    pub fn dropping(drop: i32, upper: Upper) -> Self {
        let lift = match upper {
            _ if drop <= 0 => 0,
            Upper::Implied => 1 << drop,
            Upper::Sticky => (1 << drop) - 1,
        };
        Self { drop: drop.max(0) as u32, append: (-drop).max(0) as u32, lift, clamp: i64::MAX }
    }

    /// From `fraction` fraction bits to the format of `row`, clamped as the row says.
    pub fn to_row(fraction: i32, row: &Row, upper: Upper) -> Self {
        let clamp = row.clamp.map_or(i64::MAX, |c| c.bound as i64);
        Self { clamp, ..Self::dropping(fraction - row.format.fraction, upper) }
    }

    /// Rounds outward: down by the floor, up by the one rule for every upper bound of the design.
    #[inline(always)]
    pub fn apply<W: Wide>(self, x: Interval<W>) -> Number {
        let lo = (x.lo << self.append) >> self.drop;
        let hi = ((x.hi << self.append) + W::from(self.lift)) >> self.drop;
        let clamp = |x: W| x.mantissa().clamp(-self.clamp, self.clamp);
        Interval::new(clamp(lo), clamp(hi))
    }
}
