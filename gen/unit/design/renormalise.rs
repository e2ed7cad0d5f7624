//! The re-normaliser (section 4 of the contract, the paper's 2.5), as three units: the offset of a point from V0 with
//! the magnitudes of its bounds, the common shift from the OR of all magnitudes, and the shift itself.

use super::cross_product::COORDINATES;
use super::interval::{self, Bounds, Rounding};
use super::transform_row::input_type;
use crate::params::Params;
use efsat_hardware::graph::{Builder, NodeId, Op, Rate, Type, Unit};
use std::rc::Rc;

/// Bound on a difference of two bounds, and the bits of its magnitude.
fn difference(p: &Params) -> (i128, u32) {
    let formats = p.formats();
    let reach = formats.transformed_bound().max(p.coordinate_bound() + 1);
    let bound = reach + p.coordinate_bound();
    (bound, 128 - bound.leading_zeros())
}

/// Bits of a magnitude: the OR of all of them is an unsigned word of that width.
pub fn magnitude_bits(p: &Params) -> u32 {
    difference(p).1
}

/// Number of stages of the shift: bit i of the shift moves by 2^i.
pub fn stages(p: &Params) -> u32 {
    32 - (magnitude_bits(p) - 1).leading_zeros()
}

/// `d = x - V0_lo` for the three coordinates of one point, exact, and the OR of the magnitudes of both bounds.
pub fn offset_unit(p: &Params) -> Rc<Unit> {
    let mut b = Builder::new(
        "renormalise_offset",
        1,
        &[
            "Re-normalisation, first step: the point relative to the lower bound of V0, exact (subtracting a constant, not",
            "an interval, widens nothing), and the OR of the magnitudes of its bounds, coordinate by coordinate.",
        ],
    );
    let ty = input_type(p);
    let reach = p.formats().transformed_bound().max(p.coordinate_bound() + 1);
    let (_, bits) = difference(p);
    let points = COORDINATES.map(|c| interval::input(&mut b, &format!("point_{c}"), ty, interval::symmetric(reach)));
    let origins =
        COORDINATES.map(|c| b.input(&format!("origin_{c}"), ty, interval::symmetric(p.coordinate_bound()), Rate::Any));
    for (i, c) in COORDINATES.iter().enumerate() {
        let offset = |b: &mut Builder, end: &str, x| {
            let exact = b.subtract(&format!("difference_{c}_{end}"), x, origins[i]);
            let d = b.resize(&format!("difference_{c}_{end}_bits"), exact, true, bits + 1);
            b.comment(d, format!("point_{c}_{end} - V0_{c}_lo, exact"));
            let m = b.op(&format!("magnitude_{c}_{end}_bits"), Op::Magnitude, &[d]);
            (d, b.resize(&format!("magnitude_{c}_{end}"), m, false, bits))
        };
        let (lo, m_lo) = offset(&mut b, "lo", points[i].lo);
        let (hi, m_hi) = offset(&mut b, "hi", points[i].hi);
        let m = b.op(&format!("magnitudes_{c}"), Op::Or, &[m_lo, m_hi]);
        interval::output(&mut b, &format!("offset_{c}"), Bounds { lo, hi });
        b.output(&format!("magnitude_{c}"), m);
    }
    b.finish()
}

/// The number of leading zeros of the OR word, one flag a stage, found by halving from the top.
pub fn shift_unit(p: &Params) -> Rc<Unit> {
    let (_, bits) = difference(p);
    let mut b = Builder::new(
        "renormalise_shift",
        1,
        &[
            "Re-normalisation, second step: the number of insignificant bits, W - L with L the bit length of the OR of",
            "all magnitudes of one coordinate and W their width. Flag i: shift by 2^i.",
        ],
    );
    let ty = Type { signed: false, ..Type { bits, ..input_type(p) } };
    let mut word = b.input("magnitudes", ty, (0, (1 << bits) - 1), Rate::Any);
    let mut flags = vec![];
    for i in (0..stages(p)).rev() {
        let top = b.op(&format!("top_{i}"), Op::Floor(bits - (1 << i)), &[word]);
        let any = b.op(&format!("top_{i}_used"), Op::AnyBit, &[top]);
        let flag = b.op(&format!("shift_{i}_flag"), Op::Not, &[any]);
        b.comment(flag, format!("the top {} bits are all zero", 1 << i));
        flags.push((i, flag));
        if i > 0 {
            // What is shifted out is zero where the shift is taken.
            let rest = b.op(&format!("rest_{i}"), Op::LowBits(bits - (1 << i)), &[word]);
            let moved = b.op(&format!("moved_{i}"), Op::Append(1 << i), &[rest]);
            let moved = b.op(&format!("moved_{i}_point"), Op::Reinterpret(ty.fraction), &[moved]);
            word = b.either(&format!("word_{i}"), flag, moved, word);
        }
    }
    for (i, flag) in flags.into_iter().rev() {
        b.output(&format!("shift_{i}"), flag);
    }
    b.finish()
}

/// The shift of one point: each bound of coordinate c by the flags of c, then rounded outward to s2.(N-2).
pub fn scale_unit(p: &Params) -> Rc<Unit> {
    let (bound, bits) = difference(p);
    let mut b = Builder::new(
        "renormalise_scale",
        1,
        &[
            "Re-normalisation, third step: x / 2^L, one power of two for each coordinate axis (an affine map, so the answer",
            "stays), rounded outward to the working format.",
        ],
    );
    let ty = Type::signed(bits + 1, input_type(p).fraction);
    let offsets = COORDINATES.map(|c| interval::input(&mut b, &format!("offset_{c}"), ty, interval::symmetric(bound)));
    let flags: Vec<Vec<NodeId>> = COORDINATES
        .iter()
        .map(|c| (0..stages(p)).map(|i| b.input(&format!("shift_{c}_{i}"), Type::FLAG, (0, 1), Rate::Any)).collect())
        .collect();
    let most = (1i128 << bits) - 1;
    for (c, (offset, flags)) in COORDINATES.iter().zip(offsets.iter().zip(&flags)) {
        let shifted = |b: &mut Builder, end: &str, mut x: NodeId| {
            for i in (0..stages(p)).rev() {
                let moved = b.op(&format!("moved_{c}_{end}_{i}"), Op::Append(1 << i), &[x]);
                let moved = b.op(&format!("moved_{c}_{end}_{i}_point"), Op::Reinterpret(ty.fraction), &[moved]);
                let either = b.either(&format!("either_{c}_{end}_{i}"), flags[i as usize], moved, x);
                let bounded = Op::Assert(interval::symmetric(most), "normalise");
                let bounded = b.op(&format!("bounded_{c}_{end}_{i}"), bounded, &[either]);
                x = b.resize(&format!("shifted_{c}_{end}_{i}"), bounded, true, bits + 1);
            }
            // |x| < 2^L before, so |x| < 2^W now: the binary point moves to the top.
            b.op(&format!("normal_{c}_{end}"), Op::Reinterpret(bits as i32), &[x])
        };
        let x = Bounds { lo: shifted(&mut b, "lo", offset.lo), hi: shifted(&mut b, "hi", offset.hi) };
        let way = Rounding { drop: bits as i32 - (p.width as i32 - 2), clamp: None };
        let x = interval::round(&mut b, &format!("{c}_rounded"), x, &[way], None, p.upper, p.width);
        interval::output(&mut b, c, x);
    }
    b.finish()
}

/// Without re-normalisation: the three coordinates of one point rounded outward from T to N bits.
pub fn round_unit(p: &Params) -> Rc<Unit> {
    let mut b = Builder::new(
        "coordinate_round",
        1,
        &["The coordinates of one point rounded outward to the working width; no re-normalisation."],
    );
    let reach = p.formats().transformed_bound().max(p.coordinate_bound() + 1);
    for c in COORDINATES {
        let x = interval::input(&mut b, &format!("point_{c}"), input_type(p), interval::symmetric(reach));
        let way = Rounding { drop: p.transform_width as i32 - p.width as i32, clamp: None };
        let x = interval::round(&mut b, &format!("{c}_rounded"), x, &[way], None, p.upper, p.width);
        interval::output(&mut b, c, x);
    }
    b.finish()
}
