//! A loose pair: both triangles in one frame, normalised together, each pair by its own power of two.

use num_bigint::BigInt;

use super::whole::Whole;
use super::{Host, grid};
use crate::dyadic::decoded;
use crate::pair::{Input, Pair, Verdict};
use crate::params::{Method, Params};
use efsat_geometry::Points;
use efsat_geometry::finite::{self, NotFinite};
use efsat_geometry::software::retest::{retest, retest_batch};

/// Normalises and quantises the pair a0 a1 a2 b0 b1 b2: centred on the exact midpoint of the joint
/// box, scaled by the largest power of two with all |coordinates| <= 1 (by 1 if all six points coincide).
///
/// Such a pair is always inside the declared ranges and its pose is [`Pose::identity`](crate::pair::Pose::identity).
///
/// For the exact unit the pair is moved to V0 instead and put on its own grid: scaled by the least power of two with
/// which all differences are whole. One whose differences do not fit then is decided here.
///
/// # Errors
/// If a number is not finite.
pub fn loose_pair(points: &Points, params: &Params) -> Result<Host, NotFinite> {
    fitted(points, params)?.map_or_else(|| Ok(Host::Decided(retest(points)?.into())), |pair| Ok(Host::Unit(pair)))
}

/// The same for many pairs, several times as fast where the host decides.
///
/// # Errors
/// The first number that is not finite.
pub fn loose_pairs(pairs: &[Points], params: &Params) -> Result<Vec<Host>, NotFinite> {
    let (mut hosts, mut left, mut places, mut truths) = (Vec::with_capacity(pairs.len()), vec![], vec![], vec![]);
    for (at, points) in pairs.iter().enumerate() {
        let pair = fitted(points, params).map_err(|e| e.of_pair(at))?;
        if pair.is_none() {
            left.push(*points);
            places.push(at);
        }
        hosts.push(pair.map_or(Host::Decided(Verdict::PossiblyIncorrect), Host::Unit));
    }
    retest_batch(&left, &mut truths)?;
    places.into_iter().zip(truths).for_each(|(at, truth)| hosts[at] = Host::Decided(truth.into()));
    Ok(hosts)
}

/// The pair as the unit takes it; none if it does not fit the exact unit.
fn fitted(points: &Points, params: &Params) -> Result<Option<Pair>, NotFinite> {
    finite::pair(points)?;
    let is_exact = params.method == Method::Exact;
    if is_exact && is_long(points, params.grid_bits()) {
        return Ok(None);
    }
    let numbers = points.map(|point| point.map(decoded));
    let nonzero = || numbers.iter().flatten().filter(|(mantissa, _)| *mantissa != 0);
    let grid = nonzero().map(|&(_, exponent)| exponent).min().unwrap_or(0);
    let top = nonzero().map(|&(m, exponent)| exponent + i128::from(m).abs().length() as i32).max().unwrap_or(0);
    // 2x - (min + max) has two bits more than x, and a sign.
    let short = top - grid <= 120;
    let fraction = params.input().fraction;
    Ok(match (is_exact, short) {
        (true, true) => grid::pair(&points_at::<i128>(&numbers, grid), params.grid_bits()),
        (true, false) => grid::pair(&points_at::<BigInt>(&numbers, grid), params.grid_bits()),
        (false, true) => Some(normalised::<i128>(&numbers, grid, fraction)),
        (false, false) => Some(normalised::<BigInt>(&numbers, grid, fraction)),
    })
}

/// Whether a difference is seen to be too long on any grid, as nearly all are of pairs that are on none: then nothing else need be
/// known of the pair.
fn is_long(points: &Points, width: u32) -> bool {
    let [origin, others @ ..] = points;
    let long = |(x, y): (&f64, &f64)| {
        let ((x, p), (y, q)) = (decoded(*x), decoded(*y));
        let grid = p.min(q);
        if p.abs_diff(q) > 64 {
            return false;
        }
        let difference = (i128::from(x) << (p - grid)) - (i128::from(y) << (q - grid));
        difference != 0 && difference.abs().length() > difference.twos() + width - 1
    };
    others.iter().any(|point| point.iter().zip(origin).any(long))
}

/// Coordinates in units of 2^grid, none of them finer.
fn points_at<Z: Whole>(numbers: &[[(i64, i32); 3]; 6], grid: i32) -> [[Z; 3]; 6] {
    let at_grid = |(mantissa, exponent): (i64, i32)| {
        if mantissa == 0 { Z::zero() } else { Z::from(mantissa) << (exponent - grid) as u32 }
    };
    numbers.map(|point| point.map(at_grid))
}

/// The pair whose coordinates are the given multiples of powers of two, none finer than 2^grid.
fn normalised<Z: Whole>(numbers: &[[(i64, i32); 3]; 6], grid: i32, fraction: i32) -> Pair {
    let points = points_at::<Z>(numbers, grid);
    // Twice the centred coordinates, so that the midpoint is an integer; by axis, then by point.
    let doubled = [0, 1, 2].map(|axis| {
        let x = points.each_ref().map(|point| point[axis].clone());
        let (low, high) = (x.iter().min(), x.iter().max());
        let ends = low.into_iter().chain(high).fold(Z::zero(), |sum, end| sum + end.clone());
        x.map(|x| (x << 1) - ends.clone())
    });
    let reach = doubled.iter().flatten().map(Z::abs).max().unwrap_or_else(Z::zero);
    // The least p with reach <= 2^p; the scale is 2^-p.
    let power = if reach.is_zero() { 0 } else { (reach - Z::one()).length() as i32 };
    let quantised = |x: &Z| {
        let shift = fraction - power;
        if shift >= 0 {
            return Input::exact((x.clone() << shift as u32).low());
        }
        let floor = x.clone() >> shift.unsigned_abs();
        Input { lo: floor.low(), sticky: floor << shift.unsigned_abs() != *x }
    };
    let point = |i: usize| [0, 1, 2].map(|axis| quantised(&doubled[axis][i]));
    Pair { a: [0, 1, 2].map(point), b: [3, 4, 5].map(point) }
}

#[cfg(test)]
mod tests {
    use rand::rngs::ChaCha8Rng;
    use rand::{RngExt, SeedableRng};

    use super::*;
    use efsat_geometry::sample;

    /// Both integers give the same pair.
    #[test]
    fn the_wide_path_agrees_with_the_fast_one() {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        for _ in 0..2000 {
            let numbers = sample::random_points(&mut rng).map(|point| point.map(decoded));
            let grid = numbers.iter().flatten().filter(|x| x.0 != 0).map(|x| x.1).min().unwrap();
            let fraction = rng.random_range(2..44);
            let (fast, wide) =
                (normalised::<i128>(&numbers, grid, fraction), normalised::<BigInt>(&numbers, grid, fraction));
            assert_eq!(fast, wide);
        }
    }
}
