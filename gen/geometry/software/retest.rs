//! The exact software retest: what becomes of pairs that the unit calls possibly incorrect.
//!
//! Three stages, each only for what the one before has left: separating axes in interval arithmetic
//! ([`interval_axes`]), which decide nearly all pairs that do not touch; boxes, and the signs of
//! determinants ([`robbins_whitesides`]), which decide all pairs whose products neither
//! underflow nor overflow; and integers of any length ([`exact::pair`]). Every stage is exact where
//! it answers, so the order changes the time and never the answer.

use rayon::prelude::*;

use super::{interval_axes, robbins_whitesides};
use crate::exact::{self, Exact};

/// Pairs filtered at a time: small enough to stay in the first cache.
const BLOCK: usize = 64;
/// Pairs that a thread takes at a time.
const SHARE: usize = 64 * BLOCK;

/// How the closed triangles a0 a1 a2 and b0 b1 b2 lie to each other, exactly: any finite coordinates, segments, points
/// and coplanar triangles included.
pub fn retest(points: &[[f64; 3]; 6]) -> Exact {
    interval_axes::decide(points).unwrap_or_else(|| close(points))
}

/// Appends the answers of [`retest`] for many pairs, several times as fast.
pub fn retest_batch(pairs: &[[[f64; 3]; 6]], answers: &mut Vec<Exact>) {
    answers.reserve(pairs.len());
    let mut certain = [None; BLOCK];
    for block in pairs.chunks(BLOCK) {
        let certain = &mut certain[..block.len()];
        interval_axes::decide_batch(block, certain);
        answers.extend(block.iter().zip(certain).map(|(points, answer)| answer.unwrap_or_else(|| close(points))));
    }
}

/// The answers of [`retest`] in the order of the pairs, by all threads of the current pool.
pub fn retest_parallel(pairs: &[[[f64; 3]; 6]]) -> Vec<Exact> {
    let mut answers = vec![Exact::Separate; pairs.len()];
    answers.par_chunks_mut(SHARE).zip(pairs.par_chunks(SHARE)).for_each_init(Vec::new, |found, (answers, pairs)| {
        found.clear();
        retest_batch(pairs, found);
        answers.copy_from_slice(found);
    });
    answers
}

/// Decides a pair that is too close to contact for the filter.
#[cold]
fn close(points: &[[f64; 3]; 6]) -> Exact {
    if boxes_apart(points) {
        return Exact::Separate;
    }
    robbins_whitesides::decide(points).unwrap_or_else(|| exact::pair(points))
}

/// Whether a coordinate separates the triangles. The filter has no such axes, which separate many coplanar pairs.
fn boxes_apart(points: &[[f64; 3]; 6]) -> bool {
    let [a0, a1, a2, b0, b1, b2] = points;
    (0..3).any(|i| {
        a0[i].max(a1[i]).max(a2[i]) < b0[i].min(b1[i]).min(b2[i])
            || b0[i].max(b1[i]).max(b2[i]) < a0[i].min(a1[i]).min(a2[i])
    })
}

#[cfg(test)]
mod tests;
