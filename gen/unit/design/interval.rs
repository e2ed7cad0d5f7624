//! Interval arithmetic on signals: sums, differences, and products by sign cases.

use super::product::product;
use efsat_hardware::graph::{Bundle, Sig, Signals, Step, Vec3};
use efsat_hardware::op::Type;
use efsat_hardware::{entity, record};
use std::ops::{Add, Mul, Neg, Sub};

record! {
    /// An enclosure of a real number.
    Interval "interval" {
        /// Lower bound.
        lo: S,
        /// Upper bound.
        hi: S,
    }
}

/// An interval that is going to be multiplied, with its sign case, which is an object of its own in VHDL.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Factor<S> {
    /// The interval.
    pub interval: Interval<S>,
    /// Which bounds a product takes; see [`sign`].
    pub sign_case: S,
}

impl<S: Copy + Bundle<S>> Bundle<S> for Factor<S> {
    fn map(&self, path: &mut Vec<Step>, f: &mut dyn FnMut(&[Step], S) -> S) -> Self {
        let interval = self.interval.map(path, f);
        path.push(Step::Beside("case"));
        let sign_case = self.sign_case.map(path, f);
        path.pop();
        Self { interval, sign_case }
    }
}

/// Three intervals.
pub type Vector<'l> = Vec3<Interval<Sig<'l>>>;
/// Three factors.
pub type Factors<'l> = Vec3<Factor<Sig<'l>>>;

impl<'l> Add for Interval<Sig<'l>> {
    type Output = Self;

    fn add(self, y: Self) -> Self {
        Self { lo: self.lo + y.lo, hi: self.hi + y.hi }
    }
}

impl<'l> Sub for Interval<Sig<'l>> {
    type Output = Self;

    fn sub(self, y: Self) -> Self {
        Self { lo: self.lo - y.hi, hi: self.hi - y.lo }
    }
}

impl<'l> Neg for Interval<Sig<'l>> {
    type Output = Self;

    fn neg(self) -> Self {
        Self { lo: -self.hi, hi: -self.lo }
    }
}

impl<'l> Interval<Sig<'l>> {
    /// The bounds without their binary points: what works on mantissas serves every format.
    fn mantissa(self) -> Self {
        Self { lo: self.lo.at_point(None), hi: self.hi.at_point(None) }
    }

    /// The interval with its sign case.
    pub fn factor(self) -> Factor<Sig<'l>> {
        Factor { interval: self, sign_case: sign_case(self) }
    }
}

impl<'l> Factor<Sig<'l>> {
    /// The factor without binary points.
    pub fn mantissa(self) -> Self {
        Self { interval: self.interval.mantissa(), ..self }
    }
}

/// The sign cases of an interval. Bit 0: `lo + hi < 0`; bit 1: the interval straddles zero.
pub mod sign {
    /// `0 <= lo`.
    pub const POSITIVE: usize = 0b00;
    /// `lo < 0` and `hi <= 0`.
    pub const NEGATIVE: usize = 0b01;
    /// `lo < 0 < hi`, the upper bound being at least as far from zero.
    pub const UPPER: usize = 0b10;
    /// `lo < 0 < hi`, the lower bound being farther from zero.
    pub const LOWER: usize = 0b11;
}

/// Which bounds a product takes of an interval.
pub fn sign_case<'l>(x: Interval<Sig<'l>>) -> Sig<'l> {
    let doc = [
        "The sign case of an interval, which tells a product which bounds to take.",
        "  00: 0 <= lo        01: lo < 0, hi <= 0",
        "  10: lo < 0 < hi, -lo <= hi        11: lo < 0 < hi, -lo > hi",
    ];
    let x = x.mantissa();
    entity!("sign_case", &doc, (x) => {
        let above = !x.hi.negative() & x.hi.low(x.hi.ty().bits - 1).any();
        let straddles = (x.lo.negative() & above).named("straddles").comment("lo < 0 < hi");
        let lower = (x.lo + x.hi).negative();
        lower.below(&[straddles]).named("number")
    })
}

impl<'l> Mul for Factor<Sig<'l>> {
    type Output = Interval<Sig<'l>>;

    fn mul(self, y: Self) -> Self::Output {
        multiply(self, y)
    }
}

/// `x * y` by sign cases (Kulisch): two products, none rounded; where both factors straddle zero the result is the wider
/// `[-P, P]` with `P = max(-x_lo, x_hi) * max(-y_lo, y_hi)`.
pub fn multiply<'l>(x: Factor<Sig<'l>>, y: Factor<Sig<'l>>) -> Interval<Sig<'l>> {
    let doc = [
        "p contains x * y, by sign cases: two products, none rounded. Wider than x * y only where both straddle 0.",
        "",
        "  x \\ y   y_lo >= 0                   y_hi <= 0                   y straddles 0",
        "  x_lo>=0  [x_lo*y_lo, x_hi*y_hi]      [x_hi*y_lo, x_lo*y_hi]      [x_hi*y_lo, x_hi*y_hi]",
        "  x_hi<=0  [x_lo*y_hi, x_hi*y_lo]      [x_hi*y_hi, x_lo*y_lo]      [x_lo*y_hi, x_lo*y_lo]",
        "  x str.0  [x_lo*y_hi, x_hi*y_hi]      [x_hi*y_lo, x_lo*y_lo]      [-P, P]",
        "",
        "  P = max(-x_lo, x_hi) * max(-y_lo, y_hi): the bounds farther from zero, one of them negated where their",
        "  signs would give the other end. Sign cases are those of unit sign_case.",
    ];
    let (x, y) = (x.mantissa(), y.mantissa());
    entity!("interval_multiply", &doc, (x, y) => {
        let cases = y.sign_case.below(&[x.sign_case]).named("cases").comment("4 * (sign case of x) + (sign case of y)");
        let flag = |name: &str, rule: &dyn Fn(usize, usize) -> bool| {
            let table = (0..16).map(|i| i128::from(rule(i >> 2, i & 3))).collect();
            cases.lookup(table, Type::FLAG).named(name)
        };
        let straddles = |case: usize| case >= sign::UPPER;
        // The flags of one end: which bounds it takes, and whether one is negated.
        let end = |name: &str, takes: fn(usize, usize) -> bool, same_sign: bool| {
            let takes_x_hi = flag(&format!("{name}_takes_x_hi"), &takes);
            let takes_y_hi = flag(&format!("{name}_takes_y_hi"), &|x, y| takes(y, x));
            let both = move |x, y| straddles(x) && straddles(y) && (x == y) == same_sign;
            let negates_x = flag(&format!("{name}_negates_x"), &both);
            let x = takes_x_hi.choose(x.interval.hi, x.interval.lo).negate_if(negates_x);
            let y = takes_y_hi.choose(y.interval.hi, y.interval.lo);
            product(x, y)
        };
        let lo = end("lo", takes_upper_for_least, true);
        let hi = end("hi", takes_upper_for_greatest, false);
        Interval { lo, hi }.named("p")
    })
}

/// Whether the least product takes the upper bound of the factor whose sign case is `own`.
fn takes_upper_for_least(own: usize, other: usize) -> bool {
    match (own, other) {
        (_, sign::NEGATIVE) => true,
        (_, sign::POSITIVE) => false,
        (sign::POSITIVE | sign::UPPER, _) => true,
        _ => false,
    }
}

/// Whether the greatest product does.
fn takes_upper_for_greatest(own: usize, other: usize) -> bool {
    match (own, other) {
        (_, sign::NEGATIVE) => false,
        (_, sign::POSITIVE) => true,
        (sign::POSITIVE | sign::UPPER, _) => true,
        _ => false,
    }
}
