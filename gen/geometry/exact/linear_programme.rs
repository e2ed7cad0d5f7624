//! The second formulation: a linear programme over the integers, without any case for degenerate input.
//!
//! The relative interior of the convex hull of points is the set of their combinations with positive weights that sum
//! to 1 (Rockafellar, *Convex Analysis*, theorem 6.9); with weights that may be 0 it is the hull itself. Both hold for any
//! points, coinciding and collinear ones included, hence for segments and points. So consider weights l of A's vertices,
//! m of B's, and their least value t:
//!
//! ```text
//! maximise t   subject to   sum l_i a_i = sum m_j b_j,   sum l_i = 1,   sum m_j = 1,   l_i >= t,   m_j >= t,   t >= 0
//! ```
//!
//! - no solution: no point is common;
//! - a positive maximum: some point is a combination with positive weights both of A's and of B's vertices, so the
//!   relative interiors meet;
//! - the maximum 0: points are common, but none has positive weights in both.
//!
//! With l_i = l'_i + t and m_j = m'_j + t these are five equations in seven variables that are at least 0, and t is
//! bounded, because the weights of a triangle sum to 1.
//!
//! *Coplanar.* The columns of the equations are (a_i, 1, 0), (-b_j, 0, 1) and sums of these; the right side is (0, 1, 1).
//! A column (-b_j, 0, 1) taken from the right side leaves (b_j, 1, 0). All together they span what the six (p, 1, 0) span
//! and (0, 1, 1), which is independent of those. The (p, 1) of points that span a space of dimension d are of rank
//! d + 1. The rank of the equations with their right sides is therefore d + 2, and at most 4 if one plane holds all
//! six points.
//!
//! Nothing here is shared with `integers` and `minkowski` but the type of the answer.

use num_bigint::BigInt;
use num_traits::float::FloatCore;

use super::tableau::Tableau;
use super::{Exact, Relation};
use crate::finite::{self, NotFinite};

/// Every finite binary64 number is an integer multiple of 2^-UNIT.
const UNIT: i32 = 1075;

type Point = [BigInt; 3];

/// Decides the pair a0 a1 a2 b0 b1 b2.
///
/// # Errors
/// If a number is not finite.
pub fn relation(points: &[[f64; 3]; 6]) -> Result<Relation, NotFinite> {
    finite::pair(points)?;
    Ok(solve(&points.map(|point| point.map(integer))))
}

/// Decides the pair of A and the image of B under x to M * x + t; `m` is indexed `[row][column]`.
///
/// # Errors
/// If a number is not finite.
pub fn posed_relation(
    a: &[[f64; 3]; 3],
    b: &[[f64; 3]; 3],
    m: &[[f64; 3]; 3],
    t: &[f64; 3],
) -> Result<Relation, NotFinite> {
    finite::posed(a, b, m, t)?;
    // A product of two numbers comes in squares of the unit, so single numbers are written in those as well.
    let fine = |x: f64| integer(x) << UNIT;
    let m = m.map(|row| row.map(integer));
    let image = |x: &[f64; 3]| {
        let x = x.map(integer);
        [0, 1, 2].map(|i| fine(t[i]) + &m[i][0] * &x[0] + &m[i][1] * &x[1] + &m[i][2] * &x[2])
    };
    Ok(solve(&[a[0].map(fine), a[1].map(fine), a[2].map(fine), image(&b[0]), image(&b[1]), image(&b[2])]))
}

/// A finite number in units of 2^-UNIT.
fn integer(x: f64) -> BigInt {
    let (mantissa, exponent, sign) = FloatCore::integer_decode(x);
    (BigInt::from(mantissa) * sign) << (i32::from(exponent) + UNIT)
}

fn solve(points: &[Point; 6]) -> Relation {
    let sums = [[1, 1, 1, 0, 0, 0, 3, 1], [0, 0, 0, 1, 1, 1, 3, 1]].map(|row| row.map(BigInt::from).to_vec());
    let tableau = Tableau::new(sums.into_iter().chain([0, 1, 2].map(|axis| equation(points, axis))).collect());
    let coplanar = tableau.rank() <= 4;
    let class = match tableau.maximum() {
        None => Exact::Separate,
        Some(t) if t == BigInt::ZERO => Exact::Touch,
        Some(_) => Exact::Intersect,
    };
    Relation { class, coplanar }
}

/// The equation of one coordinate, without the power of two that all its coefficients share.
fn equation(points: &[Point; 6], axis: usize) -> Vec<BigInt> {
    let shared = points.iter().filter_map(|point| point[axis].trailing_zeros()).min().unwrap_or(0);
    let mut row: Vec<BigInt> = points.iter().map(|point| &point[axis] >> shared).collect();
    for x in &mut row[3..] {
        *x = -std::mem::take(x);
    }
    row.push(row.iter().sum());
    row.push(BigInt::ZERO);
    row
}
