//! Five points relative to the floor of V0 (section 2 of docs/determinants.md).

use super::number::{Number, Vector, minus};
use crate::golden::interval::three;
use crate::pair::{Input, Pair, Pose};
use crate::params::{Params, Transform};

/// The points beside V0, which is the origin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::golden) struct Points {
    /// V1 and V2.
    pub v: [Vector; 2],
    /// W0, W1 and W2.
    pub w: [Vector; 3],
}

impl Points {
    /// The five coordinates along axis `j`.
    #[inline(always)]
    pub fn along(&self, j: usize) -> [i64; 5] {
        [self.v[0][j], self.v[1][j], self.w[0][j], self.w[1][j], self.w[2][j]]
    }

    /// From the five coordinates along each axis.
    #[inline(always)]
    pub fn new(along: [[i64; 5]; 3]) -> Self {
        let point = |i: usize| three(|j| along[j][i]);
        Self { v: [point(0), point(1)], w: [point(2), point(3), point(4)] }
    }
}

/// Bits of a number that a hardware multiplier takes.
const MULTIPLIER: u32 = 18;

/// The first stage of one parameter set.
#[derive(Clone, Copy, Debug)]
pub(in crate::golden) struct Differences {
    transform: Transform,
    /// f, the fraction bits of the input format.
    fraction: u32,
    /// q, the low bits of a factor whose products with each other are not formed; 0 if all are.
    left_out: u32,
    /// Whether the sum of three products of a row fits `i64`.
    narrow: bool,
}

/// What is done to the vertices of B~ under one pose.
#[derive(Clone, Copy, Debug)]
pub(in crate::golden) enum Frame {
    /// Nothing.
    Same,
    /// They are moved by t.
    Moved(Vector),
    /// They are multiplied by M and moved by t. The entries are those of 2 M + 1.
    Turned([Vector; 3], Vector),
}

/// The floors of three numbers.
#[inline(always)]
fn floors(x: &[Input; 3]) -> Vector {
    three(|j| x[j].lo)
}

/// 2 x + 1 is the middle of the interval above the floor x, in halves of an ulp.
#[inline(always)]
fn middles(x: &[Input; 3]) -> Vector {
    three(|j| 2 * x[j].lo + 1)
}

impl Differences {
    pub fn new(p: &Params) -> Self {
        let fraction = p.transform_width - p.int_bits;
        // 2 M + 1 has f + 3 bits: one for the half, one for the sign, and one because M = 1 is legal.
        let low = (fraction + 3).saturating_sub(MULTIPLIER);
        let left_out = if 2 * low <= fraction { low } else { 0 };
        // Each factor is at most 2^(f+1) + 1.
        Self { transform: p.transform, fraction, left_out, narrow: 2 * fraction + 4 <= 62 }
    }

    /// The pose, made ready for its pairs.
    pub fn frame(&self, pose: &Pose) -> Frame {
        match self.transform {
            Transform::Off => Frame::Same,
            _ if pose.bypass => Frame::Same,
            Transform::Translate => Frame::Moved(floors(&pose.t)),
            Transform::On => Frame::Turned(pose.m.each_ref().map(middles), floors(&pose.t)),
        }
    }

    /// The five differences, exact but for the products of low parts and the rounding of the rows.
    #[inline(always)]
    pub fn points(&self, frame: &Frame, pair: &Pair) -> Points {
        let origin = floors(&pair.a[0]);
        let v = [minus(&floors(&pair.a[1]), &origin), minus(&floors(&pair.a[2]), &origin)];
        let w = match frame {
            Frame::Same => pair.b.each_ref().map(|b| minus(&floors(b), &origin)),
            Frame::Moved(t) => {
                let moved = minus(&origin, t);
                pair.b.each_ref().map(|b| minus(&floors(b), &moved))
            }
            Frame::Turned(m, t) => {
                // The halves of t and of V0 cancel.
                let moved = minus(&origin, t);
                pair.b.each_ref().map(|b| {
                    let b = middles(b);
                    let turned = if self.narrow {
                        three(|i| self.row::<i64>(&m[i], &b))
                    } else {
                        three(|i| self.row::<i128>(&m[i], &b))
                    };
                    minus(&turned, &moved)
                })
            }
        };
        Points { v, w }
    }

    /// A row of M times a vertex, from the middles of both: sums of products have 2 f + 2 fraction bits.
    #[inline(always)]
    fn row<N: Number>(&self, m: &Vector, b: &Vector) -> i64 {
        let low = |x: i64| N::from(x & ((1 << self.left_out) - 1));
        let product = |j: usize| N::from(m[j]) * N::from(b[j]) - low(m[j]) * low(b[j]);
        // Each product left out is from 1 to almost 2^2q: in the middle 2^(2q-1).
        let middle = if self.left_out > 0 { 3 << (2 * self.left_out - 1) } else { 0 };
        let sum = product(0) + product(1) + product(2) + N::from(middle);
        ((sum + N::from(1 << (self.fraction + 1))) >> (self.fraction + 2)).narrow()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::Method;
    use rand::rngs::ChaCha8Rng;
    use rand::{RngExt, SeedableRng};

    /// The ends of the true numbers of a floor x, which keep to the declared range.
    fn ends(x: i64, one: i64) -> [i128; 2] {
        [x, (x + 1).min(one)].map(i128::from)
    }

    /// The greatest error of a row of M times a vertex, plus t, less V0, in ulps: of some words, and any numbers behind them.
    /// The error of a product is linear in each of its factors, and so is greatest at ends of both. t - V0 is off by less
    /// than 1, up or down.
    fn error_of_row(differences: &Differences, one: i64, words: &[(i64, i64); 3]) -> f64 {
        let products = words.map(|(m, b)| {
            let corners = ends(m, one).map(|m| ends(b, one).map(|b| m * b)).concat();
            [corners.iter().min(), corners.iter().max()].map(|end| *end.expect("four corners"))
        });
        let middle = |x: i64| 2 * x + 1;
        let row = differences.row::<i128>(&words.map(|w| middle(w.0)), &words.map(|w| middle(w.1)));
        let found = i128::from(row) << differences.fraction;
        let most = [0, 1].map(|end| (products.iter().map(|ends| ends[end]).sum::<i128>() - found).abs());
        1.0 + most[0].max(most[1]) as f64 / one as f64
    }

    fn determinants(transform: Transform, width: u32, transform_width: u32) -> Params {
        Params { transform, width, transform_width, ..Params::of(Method::Determinants) }
    }

    /// That the bound is above 4 is needed: with 4 in its place, levels would be one less.
    fn between_four_and_its_bound(p: &Params, greatest: f64) {
        assert!(4.0 < greatest && greatest < f64::from(p.difference_error()), "{greatest}: {p:?}");
    }

    /// All words of the narrowest format.
    #[test]
    fn rows_of_all_words_keep_to_the_error_of_a_difference() {
        let p = determinants(Transform::On, 6, 6);
        let (differences, one) = (Differences::new(&p), p.one() as i64);
        let all: Vec<(i64, i64)> = (-one..=one).flat_map(|m| (-one..=one).map(move |b| (m, b))).collect();
        let mut greatest = 0.0f64;
        for x in &all {
            for y in &all {
                for z in &all {
                    greatest = greatest.max(error_of_row(&differences, one, &[*x, *y, *z]));
                }
            }
        }
        between_four_and_its_bound(&p, greatest);
    }

    /// Words near the ends of their ranges, where errors are greatest, of formats that leave products out and of others.
    #[test]
    fn rows_keep_to_the_error_of_a_difference() {
        let mut rng = ChaCha8Rng::seed_from_u64(71);
        for transform_width in [8, 16, 19, 20, 24, 32, 35, 48] {
            let p = determinants(Transform::On, 6, transform_width);
            let (differences, one) = (Differences::new(&p), p.one() as i64);
            let mut greatest = 0.0f64;
            for _ in 0..100_000 {
                let mut word = || {
                    let reach = 1 << rng.random_range(1..10);
                    let off = rng.random_range(0..one.min(reach));
                    if rng.random() { one - off } else { off - one }
                };
                let words = [(); 3].map(|()| (word(), word()));
                greatest = greatest.max(error_of_row(&differences, one, &words));
            }
            between_four_and_its_bound(&p, greatest);
        }
    }

    /// Without M the error is that of floors: reached but for less than any number.
    #[test]
    fn sums_of_floors_keep_to_the_error_of_a_difference() {
        for transform in [Transform::Translate, Transform::Off] {
            let p = determinants(transform, 6, 8);
            let differences = Differences::new(&p);
            let mut greatest = 0;
            for code in 0..512 {
                let digit = |place: u32| (code >> (3 * place)) % 4 - 2;
                let [b, t, origin] = [0, 1, 2].map(digit);
                let input = |lo: i64| [Input { lo, sticky: true }; 3];
                let pose = Pose { t: input(t), bypass: false, ..Pose::identity(&p) };
                let pair = Pair { a: [input(origin); 3], b: [input(b); 3] };
                let found = differences.points(&differences.frame(&pose), &pair).w[0][0];
                // Ends of the three true numbers; without a translation there is no t.
                let moved = if transform == Transform::Off { 0..=0 } else { t..=t + 1 };
                for t in moved {
                    for (b, origin) in [(b, origin), (b + 1, origin), (b, origin + 1), (b + 1, origin + 1)] {
                        greatest = greatest.max((b + t - origin - found).abs());
                    }
                }
            }
            assert_eq!(greatest, i64::from(p.difference_error()));
        }
    }
}
