//! Five points relative to the floor of V0 (section 2 of docs/determinants.md).

use super::number::{Number, Vector, minus};
use crate::golden::interval::three;
use crate::golden::{Input, Pair, Pose};
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
