//! Pairs on their own grid, for the exact unit (docs/exact.md).

use super::whole::Whole;
use crate::pair::{Input, Pair};

/// The pair a0 a1 a2 b0 b1 b2 with a0 as the origin and without the twos that all coordinates then have in common, if they
/// fit `width` bits as the unit takes them. No grid is coarser, so that no other one would do.
pub(super) fn pair<Z: Whole>(points: &[[Z; 3]; 6], width: u32) -> Option<Pair> {
    let moved = points.each_ref().map(|point| [0, 1, 2].map(|j| point[j].clone() - points[0][j].clone()));
    let numbers = || moved.iter().flatten().filter(|x| !x.is_zero());
    let twos = numbers().map(Z::twos).min().unwrap_or(0);
    if numbers().any(|x| x.abs().length() > twos + width - 1) {
        return None;
    }
    let point = |i: usize| moved[i].each_ref().map(|x| Input::exact((x.clone() >> twos).low()));
    Some(Pair { a: [0, 1, 2].map(point), b: [3, 4, 5].map(point) })
}
