//! Products of factors that are wider than a multiplier, from digits that have signs of their own (section 8 of
//! docs/exact.md).

use super::super::product::product;
use efsat_hardware::device::MULTIPLIER_BITS;
use efsat_hardware::entity;
use efsat_hardware::graph::{Sig, Signals, Vec3};
use efsat_hardware::op::Type;

/// Bits of a digit below its sign.
const BELOW: u32 = MULTIPLIER_BITS - 1;

/// The number of digits of a number of so many bits.
fn count(bits: u32) -> u32 {
    bits.div_ceil(MULTIPLIER_BITS)
}

/// A number with 2^17 added to each digit but the highest: the digits can then be cut out of it, each less 2^17.
pub fn offset(x: Sig<'_>) -> Sig<'_> {
    let of_digits = |digits: u32| {
        let added = (0..digits - 1).map(|i| 1 << (BELOW + MULTIPLIER_BITS * i)).sum();
        let sum =
            x + x.unit().constant(added, Type { bits: x.ty().bits.max(MULTIPLIER_BITS * (digits - 1) + 1), ..x.ty() });
        let (least, most) = sum.range();
        sum.bits(129 - most.max(-1 - least).leading_zeros())
    };
    match count(x.ty().bits) {
        1 => x,
        // What is added may take one more.
        digits => Some(of_digits(digits))
            .filter(|sum| count(sum.ty().bits) == digits)
            .unwrap_or_else(|| of_digits(digits + 1)),
    }
}

/// The digits of a number that has its offset, the lowest first. Each takes a multiplier's width, from -2^17 to 2^17 - 1.
fn digits(x: Sig<'_>) -> Vec<Sig<'_>> {
    if count(x.ty().bits) == 1 {
        return vec![x];
    }
    let wide = |bits: u32| Type { signed: true, bits, fraction: None };
    // The highest bit of a digit less 2^17 is a sign once it is inverted.
    let sign = !x.floor(BELOW as i32).low(1);
    let digit =
        x.low(BELOW).resize(wide(MULTIPLIER_BITS)) - sign.floor(-(BELOW as i32)).resize(wide(MULTIPLIER_BITS + 1));
    [vec![digit.bits(MULTIPLIER_BITS)], digits(x.floor(MULTIPLIER_BITS as i32))].concat()
}

/// The dot product x . m of coordinates and of a moment that has its offset, exact.
pub fn dot_product<'l>(x: Vec3<Sig<'l>>, m: Vec3<Sig<'l>>) -> Sig<'l> {
    let doc = [
        "The dot product x . m, exact. m has 2^17 added to each digit of 18 bits but the highest; less that, a digit is a",
        "factor with a sign of its own. Three multipliers for each digit, whose products are added at their places.",
    ];
    entity!("dot_product", &doc, (x, m) => {
        let (x, m) = (x.map(|x| digits(offset(x))), m.map(digits));
        let (last_x, last_m) = (x[0].len() - 1, m[0].len() - 1);
        // One digit is the port itself, which has its name.
        let m = if last_m > 0 { m.named("digit") } else { m };
        // The dot product of the digits at a place.
        let place = |place: usize| {
            let digits = (0..=last_x).filter_map(|i| Some((i, place.checked_sub(i).filter(|j| *j <= last_m)?)));
            let dot = |(i, j): (usize, usize)| {
                let products = x.clone().zip(m.clone(), |x, m| product(x[i], m[j])).named(&format!("product_{i}{j}"));
                products[0] + products[1] + products[2]
            };
            digits.map(dot).reduce(|a, b| a + b).expect("a place has digits").named(&format!("place_{place}"))
        };
        let join = |above: Sig<'l>, here: Sig<'l>| {
            here.low(MULTIPLIER_BITS).below(&[above + here.floor(MULTIPLIER_BITS as i32)])
        };
        (0..=last_x + last_m).rev().map(place).reduce(join).expect("there is a place").named("dot")
    })
}
