//! Products of factors that are wider than a multiplier, from digits that have signs of their own (section 8 of
//! docs/exact.md).

use super::super::determinants::shared;
use super::super::product::product;
use efsat_hardware::device::MULTIPLIER_BITS;
use efsat_hardware::entity;
use efsat_hardware::graph::{Phases, Sig, Signals, Top, Vec3};
use efsat_hardware::op::Type;

/// Bits of a digit below its sign.
const BELOW: u32 = MULTIPLIER_BITS - 1;

/// The number of digits of a number of so many bits.
fn count(bits: u32) -> u32 {
    bits.div_ceil(MULTIPLIER_BITS)
}

/// The greatest magnitude of a difference that fits.
pub fn most(difference: Sig<'_>) -> i128 {
    (1 << (difference.ty().bits - 1)) - 1
}

/// A number of at most that magnitude, with 2^17 added to each digit but the highest: the digits can then be cut out of it,
/// each less 2^17.
pub fn offset(x: Sig<'_>, most: i128) -> Sig<'_> {
    let of_digits = |digits: u32| {
        let added: i128 = (0..digits - 1).map(|i| 1 << (BELOW + MULTIPLIER_BITS * i)).sum();
        let sum =
            x + x.block().constant(added, Type { bits: x.ty().bits.max(MULTIPLIER_BITS * (digits - 1) + 1), ..x.ty() });
        sum.bits(129 - (most + added).leading_zeros())
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

/// Dot products x . m of coordinates and of moments that have their offsets, exact, by as few multipliers as the phases of
/// the slot allow: a unit takes a dot product in a phase, or one coordinate of it.
pub(super) fn dot_products<'l>(u: Top<'l>, jobs: &[(Vec3<Sig<'l>>, Vec3<Sig<'l>>)]) -> Vec<Sig<'l>> {
    // Jobs of a unit that takes a coordinate in a phase.
    let each = u.interval() / 3;
    if each == 0 || jobs.len().div_ceil(each) >= 3 * jobs.len().div_ceil(u.interval()) {
        return shared(u, "dot", jobs, |k, (x, m)| {
            dot_product(x.named_at("dot_x", k), m.named_at("dot_m", k)).named_at("dot_lane", k)
        });
    }
    let units = jobs.len().div_ceil(each);
    let mut dots = vec![None; jobs.len()];
    for k in 0..units {
        let phases =
            Phases::new(u.interval(), |s| Some((s / 3 * units + k, s % 3)).filter(|(job, _)| *job < jobs.len()));
        let (x, m) = phases.map(|(job, j)| (jobs[*job].0[*j], jobs[*job].1[*j])).mux();
        let product = wide_product(x.named_at("dot_x", k), m.named_at("dot_m", k)).named_at("dot_part", k);
        let sum = (product + product.earlier(1) + product.earlier(2)).named_at("dot_lane", k);
        let whole = phases.filter_map(|(job, j)| Some(*job).filter(|_| *j == 2));
        whole.capture(&sum).for_each(|(job, dot)| dots[*job] = Some(dot));
    }
    dots.into_iter().map(|dot| dot.expect("every job has a unit")).collect::<Vec<_>>().named("dot")
}

/// The dot product x . m.
fn dot_product<'l>(x: Vec3<Sig<'l>>, m: Vec3<Sig<'l>>) -> Sig<'l> {
    let doc = [
        "The dot product x . m, exact. m has 2^17 added to each digit of 18 bits but the highest; less that, a digit is a",
        "factor with a sign of its own. Three multipliers for each digit, whose products are added at their places.",
    ];
    entity!("dot_product", &doc, (x, m) => {
        let (x, m) = (x.map(|x| digits(offset(x, most(x)))), m.map(digits));
        // One digit is the port itself, which has its name.
        let m = if m[0].len() > 1 { m.named("digit") } else { m };
        at_places([x[0].len(), m[0].len()], |i, j| {
            let products = x.clone().zip(m.clone(), |x, m| product(x[i], m[j])).named(&format!("product_{i}{j}"));
            products[0] + products[1] + products[2]
        })
        .named("dot")
    })
}

/// The product of a coordinate and a component of a moment that has its offset.
fn wide_product<'l>(x: Sig<'l>, m: Sig<'l>) -> Sig<'l> {
    let doc = [
        "x m, exact. m has 2^17 added to each digit of 18 bits but the highest; less that, a digit is a factor with a sign of",
        "its own. A multiplier for each two digits, whose products are added at their places.",
    ];
    entity!("wide_product", &doc, (x, m) => {
        let (x, m) = (digits(offset(x, most(x))), digits(m).named("digit"));
        at_places([x.len(), m.len()], |i, j| product(x[i], m[j]).named(&format!("product_{i}{j}"))).named("p")
    })
}

/// What is made of two factors from what is made of each two of their digits.
fn at_places<'l>([x, m]: [usize; 2], of_digits: impl Fn(usize, usize) -> Sig<'l>) -> Sig<'l> {
    let place = |place: usize| {
        let digits = (0..x).filter_map(|i| Some((i, place.checked_sub(i).filter(|j| *j < m)?)));
        let here = digits.map(|(i, j)| of_digits(i, j)).reduce(|a, b| a + b);
        here.expect("a place has digits").named(&format!("place_{place}"))
    };
    let join =
        |above: Sig<'l>, here: Sig<'l>| here.low(MULTIPLIER_BITS).below(&[above + here.floor(MULTIPLIER_BITS as i32)]);
    (0..x + m - 1).rev().map(place).reduce(join).expect("there is a place")
}
