//! The exact software retest: what becomes of pairs that the unit calls possibly incorrect.
//!
//! Stages, each only for what the one before has left: separating axes in interval arithmetic ([`interval_axes`]), which decide
//! nearly all pairs that do not touch; boxes; and the signs of determinants ([`robbins_whitesides`]), in whole numbers where the
//! coordinates have a common grid (`whole`), and else by predicates that decide all pairs whose products neither underflow nor
//! overflow. Pairs beyond that range are moved into it by a power of two; those with numbers from both of its ends are left to integers
//! of any length ([`exact::pair`]). Every stage is exact where it answers, so the order changes the time and never the answer.
//!
//! Where B is moved by a pose, the filter is told what the rounded image may be off by. What it leaves is decided as a pair of points if
//! the image is exact, and else by determinants that know the pose (`posed`).
//!
//! Numbers that are not finite never pass the filter, so that only what it leaves is looked at.
//!
//! ```
//! use efsat_geometry::exact::Exact;
//! use efsat_geometry::software::retest::{retest_batch, retest_parallel};
//!
//! let face = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
//! let pair = |z: f64| [face[0], face[1], face[2], [1.0, 1.0, z], [1.0, 1.0, 1.0], [2.0, 1.0, 1.0]];
//! let pairs = [pair(-1.0), pair(0.0), pair(5e-324)];
//! let mut answers = vec![];
//! retest_batch(&pairs, &mut answers)?;
//! assert_eq!(answers, [Exact::Intersect, Exact::Touch, Exact::Separate]);
//! assert_eq!(retest_parallel(&pairs)?, answers);
//! # Ok::<(), efsat_geometry::NotFinite>(())
//! ```

use rayon::prelude::*;

use super::posed::Posed;
use super::robbins_whitesides::{GREATEST, is_in_range, relation};
use super::whole::Whole;
use super::{affine, interval_axes, robbins_whitesides};
use crate::Points;
use crate::exact::{self, ContactKind, Exact};
use crate::finite::{self, NotFinite};
use crate::power::{ceil_log2, scaled};

/// Pairs filtered at a time: small enough to stay in the first cache.
const BLOCK: usize = 64;
/// Pairs that a thread takes at a time.
const SHARE: usize = 64 * BLOCK;

/// How the closed triangles a0 a1 a2 and b0 b1 b2 lie to each other, exactly: any finite coordinates, segments, points
/// and coplanar triangles included.
///
/// # Errors
/// If a number is not finite.
pub fn retest(points: &[[f64; 3]; 6]) -> Result<Exact, NotFinite> {
    match interval_axes::decide(points) {
        Some(answer) => Ok(answer),
        None => close(points).map(ContactKind::class),
    }
}

/// The same with the kind of contact; none if the triangles are separate.
pub(crate) fn retest_kind(points: &[[f64; 3]; 6]) -> Result<Option<ContactKind>, NotFinite> {
    interval_axes::decide(points).map_or_else(|| close(points), |answer| Ok(ContactKind::of_filter(answer)))
}

/// How a triangle A and the image of B under x to M * x + t lie to each other, as [`retest`] says it of points; `m` is indexed
/// `[row][column]`. The image is not rounded.
///
/// # Errors
/// If a number is not finite.
pub fn retest_posed(a: &[[f64; 3]; 3], b: &[[f64; 3]; 3], m: &[[f64; 3]; 3], t: &[f64; 3]) -> Result<Exact, NotFinite> {
    retest_posed_kind(a, b, m, t).map(ContactKind::class)
}

/// The same with the kind of contact; none if the triangles are separate.
pub(crate) fn retest_posed_kind(
    a: &[[f64; 3]; 3],
    b: &[[f64; 3]; 3],
    m: &[[f64; 3]; 3],
    t: &[f64; 3],
) -> Result<Option<ContactKind>, NotFinite> {
    finite::posed(a, b, m, t)?;
    let ([b0, b1, b2], error) = affine::rounded(b, m, t);
    let certain = interval_axes::decide_off(&[a[0], a[1], a[2], b0, b1, b2], error);
    Ok(certain.map_or_else(|| close_posed(a, b, m, t), ContactKind::of_filter))
}

/// Appends the answers of [`retest`] for many pairs, several times as fast.
///
/// # Errors
/// If a number is not finite; then nothing is appended.
pub fn retest_batch(pairs: &[[[f64; 3]; 6]], answers: &mut Vec<Exact>) -> Result<(), NotFinite> {
    let before = answers.len();
    answers.reserve(pairs.len());
    let mut certain = [None; BLOCK];
    let mut refused = None;
    for (number, block) in pairs.chunks(BLOCK).enumerate() {
        let certain = &mut certain[..block.len()];
        interval_axes::decide_batch(block, certain);
        let answer = |(place, (points, answer)): (usize, (_, &mut Option<Exact>))| {
            answer.unwrap_or_else(|| {
                close(points).map(ContactKind::class).unwrap_or_else(|e| {
                    refused.get_or_insert(e.of_pair(number * BLOCK + place));
                    Exact::Separate
                })
            })
        };
        answers.extend(block.iter().zip(certain).enumerate().map(answer));
        if let Some(refused) = refused {
            answers.truncate(before);
            return Err(refused);
        }
    }
    Ok(())
}

/// The answers of [`retest`] in the order of the pairs, by all threads of the current pool.
///
/// # Errors
/// If a number is not finite: the first that is not.
pub fn retest_parallel(pairs: &[[[f64; 3]; 6]]) -> Result<Vec<Exact>, NotFinite> {
    let mut answers = vec![Exact::Separate; pairs.len()];
    let shares = answers.par_chunks_mut(SHARE).zip(pairs.par_chunks(SHARE)).enumerate();
    let one = |found: &mut Vec<Exact>, (number, (answers, pairs)): (usize, (&mut [Exact], &[Points]))| {
        found.clear();
        retest_batch(pairs, found).map_err(|e| e.of_pair(number * SHARE))?;
        answers.copy_from_slice(found);
        Ok(())
    };
    // Of two errors that of the earlier share stays.
    shares.map_init(Vec::new, one).reduce(|| Ok(()), Result::and)?;
    Ok(answers)
}

/// Decides a pair that is too close to contact for the filter, or not finite.
#[cold]
fn close(points: &[[f64; 3]; 6]) -> Result<Option<ContactKind>, NotFinite> {
    finite::pair(points)?;
    Ok(close_points(points))
}

fn close_points(points: &[[f64; 3]; 6]) -> Option<ContactKind> {
    let extent = common_extent(points, 0.0)?;
    if let Some(whole) = Whole::of(points, extent) {
        return relation(&whole).kind();
    }
    robbins_whitesides::decide(points).map_or_else(|| far(points), |relation| relation.kind())
}

/// Decides a pair of which a number is at an end of binary64: in units of another power of two, if all are in range then.
#[cold]
fn far(points: &[[f64; 3]; 6]) -> Option<ContactKind> {
    let greatest = points.as_flattened().iter().fold(0.0, |greatest, x| f64::max(greatest, x.abs()));
    let units = points.map(|point| point.map(|x| scaled(x, ceil_log2(GREATEST) - ceil_log2(greatest))));
    let vanishes = |(x, unit): (&f64, &f64)| *x != 0.0 && *unit == 0.0;
    let vanish = points.as_flattened().iter().zip(units.as_flattened()).any(vanishes);
    if vanish || !units.iter().all(is_in_range) {
        return exact::decide(points).kind();
    }
    interval_axes::decide(&units).map_or_else(|| relation(&units).kind(), ContactKind::of_filter)
}

/// Decides a pair under a pose, all numbers finite, that is too close to contact for a filter that knows what rounding does.
#[cold]
pub(crate) fn close_posed(
    a: &[[f64; 3]; 3],
    b: &[[f64; 3]; 3],
    m: &[[f64; 3]; 3],
    t: &[f64; 3],
) -> Option<ContactKind> {
    let posed = Posed::new(a, b, m, t);
    let (points, error) = posed.rounded();
    if error == 0.0 {
        return interval_axes::decide(&points).map_or_else(|| close_points(&points), ContactKind::of_filter);
    }
    common_extent(&points, error)?;
    relation(&posed).kind()
}

/// How wide the joint box of the triangles is, but for roundings, unless a coordinate separates those whose corners are off by at
/// most `error`. The filter has no such axes, which separate many coplanar pairs.
fn common_extent(points: &[[f64; 3]; 6], error: f64) -> Option<f64> {
    let [a0, a1, a2, b0, b1, b2] = points;
    let mut extent: f64 = 0.0;
    for i in 0..3 {
        let (a, b) = (a0[i].min(a1[i]).min(a2[i]), b0[i].min(b1[i]).min(b2[i]));
        let (c, d) = (a0[i].max(a1[i]).max(a2[i]), b0[i].max(b1[i]).max(b2[i]));
        // Rounding is monotonic: a difference that is positive is so exactly.
        if b - c > 2.0 * error || a - d > 2.0 * error {
            return None;
        }
        extent = extent.max(c.max(d) - a.min(b));
    }
    Some(extent)
}

#[cfg(test)]
mod tests;
