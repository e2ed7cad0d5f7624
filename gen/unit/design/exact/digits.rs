//! Products of factors that are wider than a multiplier, from digits that have signs of their own (section 8 of
//! docs/exact.md).

use super::super::product::product;
use efsat_hardware::device::MULTIPLIER_BITS;
use efsat_hardware::entity;
use efsat_hardware::graph::{Sig, Signals, Vec3};
use efsat_hardware::op::Type;

/// The digits of a number, the lowest first: x is the sum of digit i times 2^(18 i). Each takes a multiplier's width, from
/// -2^17 to 2^17 - 1, and the highest is what is left.
pub fn digits(x: Sig<'_>) -> Vec<Sig<'_>> {
    let bits = x.ty().bits;
    if bits <= MULTIPLIER_BITS {
        return vec![x];
    }
    let doc = ["The digits of a number, each of 18 bits with a sign of its own, the lowest first."];
    entity!(&format!("digits_{bits}"), &doc, (x) => cut(x).named("digit"))
}

fn cut(x: Sig<'_>) -> Vec<Sig<'_>> {
    let bits = x.ty().bits;
    if bits <= MULTIPLIER_BITS {
        return vec![x];
    }
    let below = MULTIPLIER_BITS - 1;
    // The digit's sign is worth -2^17 in it, so that it is missing above.
    let sign = x.floor(below as i32).low(1);
    let wide = |bits: u32| Type { signed: true, bits, fraction: None };
    let digit = x.low(below).resize(wide(MULTIPLIER_BITS)) - sign.floor(-(below as i32)).resize(wide(MULTIPLIER_BITS + 1));
    let above = x.floor(MULTIPLIER_BITS as i32) + sign.resize(wide(2));
    // As wide as what is left: the carry may take a bit more.
    let (least, most) = above.range();
    let rest = 129 - most.max(-1 - least).leading_zeros();
    [vec![digit.bits(MULTIPLIER_BITS)], cut(above.bits(rest))].concat()
}

/// The dot product x . m of coordinates and the digits of a moment, exact.
pub fn dot_product<'l>(x: Vec3<Sig<'l>>, m: Vec3<Vec<Sig<'l>>>) -> Sig<'l> {
    let doc = [
        "The dot product x . m, exact, m in digits of 18 bits: a dot product of three multipliers for each digit, which are",
        "added at their places.",
    ];
    let x = x.map(digits);
    entity!("dot_product", &doc, (x, m) => {
        let (last_x, last_m) = (x[0].len() - 1, m[0].len() - 1);
        // The dot products of each place, the highest first.
        let place = |place: usize| {
            let digits = (0..=last_x).filter_map(|i| Some((i, place.checked_sub(i).filter(|j| *j <= last_m)?)));
            let dot = |(i, j): (usize, usize)| {
                let products = x.clone().zip(m.clone(), |x, m| product(x[i], m[j])).named(&format!("product_{i}{j}"));
                products[0] + products[1] + products[2]
            };
            digits.map(dot).reduce(|a, b| a + b).expect("a place has digits").named(&format!("place_{place}"))
        };
        let places = (0..=last_x + last_m).rev().map(place);
        let join = |above: Sig<'l>, here: Sig<'l>| {
            here.low(MULTIPLIER_BITS).below(&[above + here.floor(MULTIPLIER_BITS as i32)])
        };
        places.reduce(join).expect("there is a place").named("dot")
    })
}
