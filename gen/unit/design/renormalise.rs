//! The re-normaliser (section 4 of the contract, the paper's 2.5), as three units: the offset of a point from V0 with the
//! magnitudes of its bounds, the common shift from the OR of all magnitudes, and the shift itself.

use super::interval::{Interval, Vector};
use super::number::input_type;
use super::rounding::{Rounding, Roundings};
use crate::params::Params;
use efsat_hardware::entity;
use efsat_hardware::graph::{Sig, Signals, Vec3};
use efsat_hardware::op::Type;

/// Bits of the magnitude of a difference of two bounds.
fn magnitude_bits(p: &Params) -> u32 {
    let reach = p.formats().transformed_bound().max(p.coordinate_bound() + 1);
    128 - (reach + p.coordinate_bound()).leading_zeros()
}

/// Stages of the barrel shifter: bit i of the shift moves by 2^i.
fn stages(p: &Params) -> u32 {
    32 - (magnitude_bits(p) - 1).leading_zeros()
}

/// `d = x - V0_lo`, exact, and for each coordinate a word with as many leading zeros as the greater magnitude of its bounds.
pub fn offset<'l>(p: &Params, point: Vector<'l>, origin: Vec3<Sig<'l>>) -> (Vector<'l>, Vec3<Sig<'l>>) {
    let doc = [
        "Re-normalisation, first step: the point relative to the lower bound of V0, exact (subtracting a constant, not an",
        "interval, widens nothing).",
    ];
    let bits = magnitude_bits(p);
    let offset = entity!("renormalise_offset", &doc, (point, origin) => {
        let signed = Type { bits: bits + 1, ..input_type(p) };
        let relative = |x: Sig<'l>, origin: Sig<'l>| (x - origin).resize(signed);
        point.zip(origin, |x, o| Interval { lo: relative(x.lo, o), hi: relative(x.hi, o) }).named("offset")
    });
    // A negative upper bound is nearer to zero than the lower one.
    (offset, offset.map(|d| d.lo.magnitude().bits(bits) | d.hi.positive(bits)))
}

/// The number of leading zeros of the OR word, a flag per stage: flag i says to shift by 2^i.
pub fn leading_zeros<'l>(p: &Params, magnitudes: Sig<'l>) -> Vec<Sig<'l>> {
    let doc = [
        "Re-normalisation, second step: the leading zeros of the OR of all magnitudes of one coordinate, found by halving",
        "from the top. Flag i: shift by 2^i.",
    ];
    let bits = magnitude_bits(p);
    entity!("renormalise_shift", &doc, (magnitudes) => {
        let mut word = magnitudes.at_point(None);
        let mut flags = vec![];
        for i in (0..stages(p)).rev() {
            let zero = !word.floor((bits - (1 << i)) as i32).any();
            flags.push(zero.named(&format!("zero_{}", 1 << i)).comment(&format!("the top {} bits are zero", 1 << i)));
            if i > 0 {
                // What is shifted out is zero where the shift is taken.
                word = flags[flags.len() - 1].choose(word.shift_left(1 << i), word).named(&format!("word_{i}"));
            }
        }
        flags.reverse();
        flags.named("shift")
    })
}

/// The shift of one point, each bound of a coordinate by the flags of that coordinate, rounded outward to s2.(N-2).
pub fn scale<'l>(p: &Params, offset: Vector<'l>, shift: Vec3<Vec<Sig<'l>>>) -> Vector<'l> {
    let doc = [
        "Re-normalisation, third step: x / 2^L, a power of two for each coordinate axis (an affine map, so the answer",
        "stays), rounded outward to the working format. A barrel shifter; flag i shifts by 2^i.",
    ];
    let bits = magnitude_bits(p);
    let drop = bits as i32 - (p.width as i32 - 2);
    let ty = Type::signed(p.width, p.width as i32 - 2);
    entity!("renormalise_scale", &doc, (offset, shift) => {
        let mut x = offset.map(|x| Interval { lo: x.lo.at_point(None), hi: x.hi.at_point(None) });
        for i in (0..stages(p)).rev() {
            let shifted = |x: Sig<'l>, flag: Sig<'l>| {
                // |x| < 2^L before, so |x| < 2^bits now: nothing is shifted out.
                flag.choose(x.shift_left(1 << i), x).assume((1 << bits) - 1, "normalise")
            };
            x = Vec3::each(|c| {
                let flag = shift[c][i as usize];
                Interval { lo: shifted(x[c].lo, flag), hi: shifted(x[c].hi, flag) }
            });
            x = x.named(&format!("shifted_{i}"));
        }
        let roundings = Roundings::one(Rounding { drop, saturate: None }, p.upper, ty);
        let normal = x.map(|x| Interval { lo: x.lo.at_point(Some(bits as i32)), hi: x.hi.at_point(Some(bits as i32)) });
        normal.map(|x| x.round_outward(&roundings)).named("scaled")
    })
}

/// Without re-normalisation: a point rounded outward from T to N bits.
pub fn round<'l>(p: &Params, point: Vector<'l>) -> Vector<'l> {
    let doc = ["The coordinates of a point rounded outward to the working width; no re-normalisation."];
    let ty = Type::signed(p.width, p.width as i32 - p.int_bits as i32);
    let drop = p.transform_width as i32 - p.width as i32;
    if drop == 0 {
        // The same bits, under a name of their own.
        return point.map(|x| x.each(|_, end| end.at_point(None).at_point(end.ty().fraction)));
    }
    entity!("coordinate_round", &doc, (point) => {
        let roundings = Roundings::one(Rounding { drop, saturate: None }, p.upper, ty);
        point.map(|x| x.round_outward(&roundings)).named("rounded")
    })
}
