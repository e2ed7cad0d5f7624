//! Re-normalisation: offsets, shifts and the scaling, by definition.

use super::{Bench, UPPERS, at, rounded, vector};
use efsat::design::number::input_type;
use efsat::design::renormalise;
use efsat::graph::{Sig, Signals, Top, Vec3};
use efsat::op::Type;
use efsat::params::{Params, Transform};

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

/// Greatest magnitude of a point's bound, and of a difference of it and a lower bound.
fn reach(p: &Params) -> [i128; 2] {
    let point = p.formats().transformed_bound().max(p.coordinate_bound() + 1);
    [point, point + p.coordinate_bound()]
}

/// Bits of a word of magnitudes, and stages of the shift that they take.
pub(super) fn word(p: &Params) -> (u32, u32) {
    let bits = bit_length(reach(p)[1]);
    (bits, bit_length(i128::from(bits) - 1))
}

/// Inputs of a scaling: three offsets, and the flags of one shift for all three.
pub(super) fn scaled<'l>(top: Top<'l>, p: &Params) -> Vec3<efsat::design::interval::Interval<Sig<'l>>> {
    let (bits, stages) = word(p);
    let offset = vector(top, "offset", Type { bits: bits + 1, ..input_type(p) }, reach(p)[1]);
    let flags: Vec<Sig<'l>> = (0..stages).map(|_| top.input(Type::FLAG, (0, 1))).collect();
    let flags = flags.named("shift");
    renormalise::scale(p, offset, Vec3::each(|_| flags.clone())).named("scaled")
}

/// The flags of a shift by `shift`.
pub(super) fn flags(shift: u32, stages: u32) -> Vec<i128> {
    (0..stages).map(|i| i128::from(shift >> i & 1)).collect()
}

#[test]
fn offsets_are_exact_and_words_tell_the_greater_magnitude() {
    for p in renormalisers() {
        let ([reach, _], most) = (reach(&p), p.coordinate_bound());
        let mut unit = Bench::new(|top| {
            let point = vector(top, "point", input_type(&p), reach);
            let origin = Vec3::each(|_| top.input(input_type(&p), (-most, most))).named("origin");
            let (offset, magnitudes) = renormalise::offset(&p, point, origin);
            [offset.signals(), magnitudes.signals()].concat()
        });
        for origin in [-most, 1 - most, -1, 0, 1, most] {
            for lo in -reach..=reach {
                let points = [0, 1, 5].map(|width| at(lo, (lo + width).min(reach)));
                let found = unit.run(&points, &[origin; 3]);
                for (i, point) in points.into_iter().enumerate() {
                    let offset = at(point.lo - origin, point.hi - origin);
                    assert_eq!(found[2 * i..2 * i + 2], [offset.lo, offset.hi]);
                    let greater = offset.lo.abs().max(offset.hi.abs());
                    assert_eq!(bit_length(found[6 + i]), bit_length(greater), "{offset:?}");
                }
            }
        }
    }
}

#[test]
fn shifts_are_leading_zeros() {
    for p in renormalisers() {
        let (bits, stages) = word(&p);
        let ty = Type::unsigned(bits);
        let mut unit = Bench::new(|top| renormalise::leading_zeros(&p, top.input(ty, ty.limits()).named("magnitudes")));
        for word in 1..1i128 << bits {
            assert_eq!(unit.run(&[], &[word]), flags(bits - bit_length(word), stages), "{word}");
        }
    }
}

/// Lemma normalise: with |x| < 2^L no stage of the shift overflows (checked by the graph at every evaluation), and the
/// result is x / 2^L rounded outward to s2.(N-2), within [-1, 1].
#[test]
fn scaling_divides_by_a_power_of_two() {
    for p in renormalisers() {
        let mut unit = Bench::new(|top| scaled(top, &p).signals());
        let ((bits, stages), [_, reach]) = (word(&p), reach(&p));
        let drop = bits as i32 - (p.width as i32 - 2);
        let one = 1i128 << (p.width - 2);
        for lo in -reach..=reach {
            for hi in [lo, lo + 1, lo + 2, -lo, reach].into_iter().filter(|hi| *hi >= lo && *hi <= reach) {
                for length in bit_length(lo.abs() | hi.abs())..=bits {
                    // All magnitudes zero: the shift is the most that the stages give, and 0 stays 0.
                    let shift = if length == 0 { (1 << stages) - 1 } else { bits - length };
                    let x = at(lo, hi);
                    let found = unit.bounds(&[x; 3], &flags(shift, stages));
                    let exact = at(lo << (bits - length), hi << (bits - length));
                    assert_eq!(found, [rounded(exact, drop, p.upper); 3], "{x:?} L {length} {p:?}");
                    assert!(-one <= found[0].lo && found[0].hi <= one, "{x:?} L {length} {p:?}");
                }
            }
            // One bit more than the leading zeros is noticed.
            let length = bit_length(lo.abs());
            let too_far = length > 0 && bits - length + 1 < 1 << stages;
            assert!(!too_far || unit.refuses(&[at(lo, lo); 3], &flags(bits - length + 1, stages)), "{lo} {p:?}");
        }
    }
}
