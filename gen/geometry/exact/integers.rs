//! Binary64 numbers as integers with one common power of two.

use num_bigint::BigInt;

use super::{Relation, minkowski};

/// `mantissa * 2^exponent`.
#[derive(Clone, Debug)]
pub(crate) struct Scaled {
    mantissa: BigInt,
    exponent: i64,
}

impl From<f64> for Scaled {
    fn from(x: f64) -> Self {
        let (mantissa, exponent) = split(x);
        Self { mantissa: mantissa.into(), exponent }
    }
}

/// A finite number as an odd integer (or zero) times a power of two.
pub(super) fn split(x: f64) -> (i64, i64) {
    debug_assert!(x.is_finite(), "{x} is no real number");
    let bits = x.to_bits();
    let biased = (bits >> 52 & 0x7ff) as i64;
    let stored = (bits & 0x000f_ffff_ffff_ffff) as i64;
    let magnitude = if biased == 0 { stored } else { stored + (1 << 52) };
    if magnitude == 0 {
        return (0, 0);
    }
    let zeros = magnitude.trailing_zeros();
    let odd = magnitude >> zeros;
    (if x.is_sign_negative() { -odd } else { odd }, biased.max(1) - 1075 + i64::from(zeros))
}

/// Coordinates of at most this many bits keep every number of the decision, degree four in them, inside `i128`: a
/// difference has one bit more, a cross product 2 * 28 + 1 bits, a further one 57 + 28 + 1 and a projection of it
/// 86 + 27 + 2.
const SMALL: i64 = 27;

/// Decides the pair exactly.
pub(super) fn decide(points: &[[f64; 3]; 6]) -> Relation {
    let parts = points.map(|point| point.map(split));
    let nonzero = || parts.iter().flatten().filter(|(mantissa, _)| *mantissa != 0);
    let grid = nonzero().map(|&(_, exponent)| exponent).min().unwrap_or(0);
    let length = |mantissa: i64| i64::from(u64::BITS - mantissa.unsigned_abs().leading_zeros());
    let top = nonzero().map(|&(mantissa, exponent)| length(mantissa) + exponent).max().unwrap_or(0);
    if top - grid <= SMALL {
        let at = |(mantissa, exponent): (i64, i64)| {
            if mantissa == 0 { 0 } else { i128::from(mantissa) << (exponent - grid) }
        };
        return minkowski::decide(&parts.map(|point| point.map(at)));
    }
    let scaled = |(mantissa, exponent): (i64, i64)| Scaled { mantissa: mantissa.into(), exponent };
    minkowski::decide(&from_a0(&parts.map(|point| point.map(scaled))))
}

/// Decides the pair of A and the image of B, exactly.
pub(super) fn decide_posed(a: &[[f64; 3]; 3], b: &[[f64; 3]; 3], m: &[[f64; 3]; 3], t: &[f64; 3]) -> Relation {
    minkowski::decide(&posed_points(a, b, m, t))
}

/// The corners of A and of the image of B relative to a0, in units of one power of two.
pub(crate) fn posed_points(a: &[[f64; 3]; 3], b: &[[f64; 3]; 3], m: &[[f64; 3]; 3], t: &[f64; 3]) -> [[BigInt; 3]; 6] {
    let motion = Motion::new(m, t);
    let [[a0, a1, a2], [b0, b1, b2]] = [a.map(|x| x.map(Scaled::from)), b.map(|x| motion.image(&x))];
    from_a0(&[a0, a1, a2, b0, b1, b2])
}

/// x to M * x + t, exactly.
pub(crate) struct Motion {
    m: [[Scaled; 3]; 3],
    t: [Scaled; 3],
}

impl Motion {
    /// By a matrix, indexed `[row][column]`, and a translation.
    pub fn new(m: &[[f64; 3]; 3], t: &[f64; 3]) -> Self {
        Self { m: m.map(|row| row.map(Scaled::from)), t: t.map(Scaled::from) }
    }

    /// The image of a point.
    pub fn image(&self, x: &[f64; 3]) -> [Scaled; 3] {
        let x = x.map(Scaled::from);
        [0, 1, 2].map(|i| {
            let terms: Vec<Scaled> = (0..3).map(|j| self.m[i][j].times(&x[j])).chain([self.t[i].clone()]).collect();
            let grid = grid(&terms);
            Scaled { mantissa: terms.iter().map(|term| term.at(grid)).sum(), exponent: grid }
        })
    }
}

/// Points relative to a0, which makes the numbers of a small pair far from the origin small.
fn from_a0(points: &[[Scaled; 3]; 6]) -> [[BigInt; 3]; 6] {
    relative(&points[0], points)
}

/// Points relative to one of them, in units of one power of two.
pub(super) fn relative<const COUNT: usize>(
    origin: &[Scaled; 3],
    points: &[[Scaled; 3]; COUNT],
) -> [[BigInt; 3]; COUNT] {
    let grid = grid(points.as_flattened()).min(grid(origin));
    points.each_ref().map(|point| [0, 1, 2].map(|i| point[i].at(grid) - origin[i].at(grid)))
}

/// Points in units of one power of two, and its exponent.
pub(crate) fn whole(points: &[[Scaled; 3]]) -> (Vec<[BigInt; 3]>, i64) {
    let grid = grid(points.as_flattened());
    (points.iter().map(|point| point.each_ref().map(|x| x.at(grid))).collect(), grid)
}

/// The least exponent of numbers other than zero.
fn grid(numbers: &[Scaled]) -> i64 {
    numbers.iter().filter(|x| x.mantissa != BigInt::ZERO).map(|x| x.exponent).min().unwrap_or(0)
}

impl Scaled {
    fn times(&self, other: &Self) -> Self {
        Self { mantissa: &self.mantissa * &other.mantissa, exponent: self.exponent + other.exponent }
    }

    /// In units of 2^grid.
    fn at(&self, grid: i64) -> BigInt {
        if self.mantissa == BigInt::ZERO { BigInt::ZERO } else { &self.mantissa << (self.exponent - grid) }
    }
}
