//! Re-normalisation: offsets, shifts and the scaling, by definition.

use super::{Bench, Bounds, UPPERS, at, rounded};
use efsat::design::cross_product::COORDINATES;
use efsat::design::renormalise;
use efsat::params::{Params, Transform};
use std::panic::{AssertUnwindSafe, catch_unwind};

pub(super) fn bit_length(x: i128) -> u32 {
    128 - x.leading_zeros()
}

/// Parameter sets of the re-normaliser that can be exhausted.
pub(super) fn renormalisers() -> Vec<Params> {
    let mut sets = vec![];
    for upper in UPPERS {
        for (width, transform_width) in [(6, 6), (6, 8), (7, 9), (10, 10)] {
            for transform in [Transform::On, Transform::Translate, Transform::Off] {
                sets.push(Params { width, transform_width, transform, upper, ..Params::default() });
            }
        }
    }
    sets
}

#[test]
fn offsets_are_exact_with_true_magnitudes() {
    for p in renormalisers() {
        let mut unit = Bench::new(&renormalise::offset_unit(&p));
        let reach = p.formats().transformed_bound().max(p.coordinate_bound() + 1);
        let most = p.coordinate_bound();
        for origin in [-most, 1 - most, -1, 0, 1, most] {
            for lo in -reach..=reach {
                let points = [0, 1, 5].map(|width| at(lo, (lo + width).min(reach)));
                unit.run(&points, &[origin; 3]);
                for (c, point) in COORDINATES.iter().zip(points) {
                    let offset = at(point.lo - origin, point.hi - origin);
                    assert_eq!(unit.interval(&format!("offset_{c}")), offset);
                    let magnitude = unit.evaluator.output(&format!("magnitude_{c}"));
                    assert_eq!(magnitude, offset.lo.abs() | offset.hi.abs());
                }
            }
        }
    }
}

#[test]
fn shifts_are_leading_zeros() {
    for p in renormalisers() {
        let mut unit = Bench::new(&renormalise::shift_unit(&p));
        let (bits, stages) = (renormalise::magnitude_bits(&p), renormalise::stages(&p));
        for word in 1..1i128 << bits {
            unit.run(&[], &[word]);
            let shift: u32 = (0..stages).map(|i| u32::from(unit.flag(&format!("shift_{i}"))) << i).sum();
            assert_eq!(shift, bits - bit_length(word), "{word}");
        }
    }
}

/// Drives a scale unit: offsets of three coordinates, one shift for all.
pub(super) fn scale(unit: &mut Bench, offsets: [Bounds; 3], shift: u32, stages: u32) -> [Bounds; 3] {
    let flags: Vec<i128> = (0..stages).map(|i| i128::from(shift >> i & 1)).collect();
    unit.run(&offsets, &flags.repeat(3));
    COORDINATES.map(|c| unit.interval(c))
}

/// Lemma normalise: with |x| < 2^L no stage of the shift overflows (checked by the graph at every evaluation), and the
/// result is x / 2^L rounded outward to s2.(N-2), within [-1, 1].
#[test]
fn scaling_divides_by_a_power_of_two() {
    for p in renormalisers() {
        let mut unit = Bench::new(&renormalise::scale_unit(&p));
        let (bits, stages) = (renormalise::magnitude_bits(&p), renormalise::stages(&p));
        let drop = bits as i32 - (p.width as i32 - 2);
        let reach = p.formats().transformed_bound().max(p.coordinate_bound() + 1) + p.coordinate_bound();
        let one = 1i128 << (p.width - 2);
        for lo in -reach..=reach {
            for hi in [lo, lo + 1, lo + 2, -lo, reach].into_iter().filter(|hi| *hi >= lo && *hi <= reach) {
                for length in bit_length(lo.abs() | hi.abs())..=bits {
                    // All magnitudes zero: the shift is the most that the stages give, and 0 stays 0.
                    let shift = if length == 0 { (1 << stages) - 1 } else { bits - length };
                    let x = at(lo, hi);
                    let found = scale(&mut unit, [x, x, x], shift, stages);
                    let exact = at(lo << (bits - length), hi << (bits - length));
                    assert_eq!(found, [rounded(exact, drop, p.upper); 3], "{x:?} L {length} {p:?}");
                    assert!(-one <= found[0].lo && found[0].hi <= one, "{x:?} L {length} {p:?}");
                }
            }
        }
        // One bit more than the leading zeros is noticed.
        let too_far = catch_unwind(AssertUnwindSafe(|| scale(&mut unit, [at(reach, reach); 3], 1, stages)));
        assert_eq!(too_far.is_err(), bit_length(reach) == bits);
    }
}
