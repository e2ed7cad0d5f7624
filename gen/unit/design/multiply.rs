//! Interval multiplication by sign cases (section 5 of the contract): two products an interval, whatever the signs.
//!
//! The sign of a factor is found once ([`sign_case_unit`]) and handed to every multiplication that the factor takes
//! part in; two cases then say which bounds are multiplied ([`multiply_unit`]). Numbers as they come from the host are
//! one unit in the last place wide and never straddle zero; their product is simpler ([`quantised_multiply_unit`]).

use super::interval::{self, Bounds, symmetric};
use efsat_hardware::device::MULTIPLIER_BITS;
use efsat_hardware::graph::{Builder, Fact, NodeId, Op, Rate, Type, Unit};
use std::rc::Rc;

/// Type of a sign case, a number of [`case`].
pub const SIGN_CASE: Type = Type::unsigned(2);

/// The sign cases of an interval. Bit 0: `lo + hi < 0`; bit 1: the interval straddles zero.
pub mod case {
    /// `0 <= lo`.
    pub const POSITIVE: usize = 0b00;
    /// `lo < 0` and `hi <= 0`.
    pub const NEGATIVE: usize = 0b01;
    /// `lo < 0 < hi`, the upper bound being at least as far from zero.
    pub const UPPER: usize = 0b10;
    /// `lo < 0 < hi`, the lower bound being farther from zero.
    pub const LOWER: usize = 0b11;
}

/// An interval and its sign case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Factor {
    /// The bounds.
    pub bounds: Bounds,
    /// The sign case.
    pub sign_case: NodeId,
}

/// The sign case of an interval whose bounds are of type `ty` and within `bound`.
pub fn sign_case_unit(ty: Type, bound: i128) -> Rc<Unit> {
    let mut b = Builder::new(
        "sign_case",
        1,
        &[
            "The sign case of an interval, which tells a multiplication what bounds to take.",
            "  00: 0 <= lo        01: lo < 0, hi <= 0",
            "  10: lo < 0 < hi, -lo <= hi        11: lo < 0 < hi, -lo > hi",
        ],
    );
    let x = interval::input(&mut b, "x", ty, symmetric(bound));
    let below = b.op("lo_below", Op::SignBit, &[x.lo]);
    let hi_below = b.op("hi_below", Op::SignBit, &[x.hi]);
    let hi_not_below = b.op("hi_not_below", Op::Not, &[hi_below]);
    let magnitude = b.op("hi_bits", Op::LowBits(ty.bits - 1), &[x.hi]);
    let hi_not_zero = b.op("hi_not_zero", Op::AnyBit, &[magnitude]);
    let above = b.and("hi_above", hi_not_below, hi_not_zero);
    b.comment(above, "0 < hi");
    let straddles = b.and("straddles", below, above);
    b.comment(straddles, "lo < 0 < hi");
    let sum = b.add("sum", x.lo, x.hi);
    let lower = b.op("lower_is_farther", Op::SignBit, &[sum]);
    b.comment(lower, "-lo > hi, also where the interval is negative");
    let case = b.op("case_number", Op::Concatenate, &[lower, straddles]);
    b.output("x_sign_case", case);
    b.finish()
}

/// Instantiates [`sign_case_unit`] for an interval.
pub fn factor(b: &mut Builder, name: &str, unit: &Rc<Unit>, bounds: Bounds) -> Factor {
    let sign_case = b.instance(&format!("{name}_sign"), unit, &bounds.nodes())[0];
    Factor { bounds, sign_case }
}

/// Instantiates a [`multiply_unit`].
pub fn instance(b: &mut Builder, name: &str, unit: &Rc<Unit>, x: Factor, y: Factor) -> Bounds {
    interval::instance(b, name, unit, &[x.bounds, y.bounds], &[x.sign_case, y.sign_case])[0]
}

/// `x * y` by sign cases (Kulisch): two multipliers; where both factors straddle zero the product is `[-P, P]` with
/// `P = max(-x_lo, x_hi) * max(-y_lo, y_hi)`.
///
/// Inputs are the bounds of both factors, then their sign cases. Factors are bounded by `x` and `y` (type and bound);
/// multipliers are as wide as these need.
pub fn multiply_unit(name: &str, x: (Type, i128), y: (Type, i128)) -> Rc<Unit> {
    let mut b = Builder::new(
        name,
        1,
        &[
            "Interval multiplication by sign cases, two multipliers, exact.",
            "",
            "  x \\ y   y_lo >= 0                   y_hi <= 0                   y straddles 0",
            "  x_lo>=0  [x_lo*y_lo, x_hi*y_hi]      [x_hi*y_lo, x_lo*y_hi]      [x_hi*y_lo, x_hi*y_hi]",
            "  x_hi<=0  [x_lo*y_hi, x_hi*y_lo]      [x_hi*y_hi, x_lo*y_lo]      [x_lo*y_hi, x_lo*y_lo]",
            "  x str.0  [x_lo*y_hi, x_hi*y_hi]      [x_hi*y_lo, x_lo*y_lo]      [-P, P]",
            "",
            "  P = max(-x_lo, x_hi) * max(-y_lo, y_hi): the bounds farther from zero, one of them negated where their",
            "  signs would give the other end. The sign cases are those of unit sign_case.",
        ],
    );
    let bits = [needed(x.1), needed(y.1)];
    let bounds = |b: &mut Builder, name: &str, factor: (Type, i128), bits: u32| {
        let ports = interval::input(b, name, factor.0, symmetric(factor.1));
        let lo = b.resize(&format!("{name}_lo_bits"), ports.lo, true, bits);
        Bounds { lo, hi: b.resize(&format!("{name}_hi_bits"), ports.hi, true, bits) }
    };
    let xs = bounds(&mut b, "x", x, bits[0]);
    let ys = bounds(&mut b, "y", y, bits[1]);
    let cases = ["x", "y"].map(|f| b.input(&format!("{f}_sign_case"), SIGN_CASE, SIGN_CASE.limits(), Rate::Any));
    let both = b.op("cases", Op::Concatenate, &[cases[1], cases[0]]);
    b.comment(both, "4 * (sign case of x) + (sign case of y)");
    let mut flag = |name: &str, rule: fn(usize, usize) -> bool, comment: &str| {
        let table = (0..16).map(|i| i128::from(rule(i >> 2, i & 3))).collect();
        let id = b.op(name, Op::Lookup(table, Type::FLAG), &[both]);
        b.comment(id, comment)
    };
    let lo_takes_x_hi = flag("lo_takes_x_hi", takes_upper_for_least, "bound of x that the least product takes");
    let lo_takes_y_hi = flag("lo_takes_y_hi", |x, y| takes_upper_for_least(y, x), "... and of y");
    let hi_takes_x_hi = flag("hi_takes_x_hi", takes_upper_for_greatest, "bound of x that the greatest product takes");
    let hi_takes_y_hi = flag("hi_takes_y_hi", |x, y| takes_upper_for_greatest(y, x), "... and of y");
    let lo_negates = flag("lo_negates_x", |x, y| straddles(x) && x == y, "[-P, P] from factors of one sign");
    let hi_negates = flag("hi_negates_x", |x, y| straddles(x) && straddles(y) && x != y, "... of both signs");
    let mut product_of = |end: &str, x_hi, y_hi, negates| {
        let x_bound = b.either(&format!("{end}_x_bound"), x_hi, xs.hi, xs.lo);
        let x = b.op(&format!("{end}_x"), Op::NegateIf, &[negates, x_bound]);
        let y = b.either(&format!("{end}_y"), y_hi, ys.hi, ys.lo);
        product(&mut b, &format!("product_{end}"), x, y)
    };
    let lo = product_of("lo", lo_takes_x_hi, lo_takes_y_hi, lo_negates);
    let hi = product_of("hi", hi_takes_x_hi, hi_takes_y_hi, hi_negates);
    interval::output(&mut b, "", Bounds { lo, hi });
    b.finish()
}

fn straddles(sign_case: usize) -> bool {
    sign_case >= case::UPPER
}

/// Whether the least product takes the upper bound of the factor whose sign case is `own`.
fn takes_upper_for_least(own: usize, other: usize) -> bool {
    match (own, other) {
        (_, case::NEGATIVE) => true,
        (_, case::POSITIVE) => false,
        (case::POSITIVE | case::UPPER, _) => true,
        _ => false,
    }
}

/// Whether the greatest product does.
fn takes_upper_for_greatest(own: usize, other: usize) -> bool {
    match (own, other) {
        (_, case::NEGATIVE) => false,
        (_, case::POSITIVE) => true,
        (case::POSITIVE | case::UPPER, _) => true,
        _ => false,
    }
}

/// A number that is one unit in the last place wide or exact: the interval `[lo, lo + ulp]`.
#[derive(Clone, Copy, Debug)]
pub struct Span {
    /// Type of the bounds.
    pub ty: Type,
    /// Bound on the magnitude of the lower bound.
    pub lo: i128,
    /// Bound on the magnitude of the upper bound; where it is not greater than `lo` that is by lemma declared-range.
    pub hi: i128,
}

/// `m * x` for numbers as the host quantises them: lower bounds, and flags that say whether they are a unit in the
/// last place wide. Neither straddles zero, so the sign of the lower bounds decides, and a bound is the lower one plus
/// a flag.
///
/// Inputs are `m_lo`, `m_ulp`, `x_lo` and `x_ulp`.
pub fn quantised_multiply_unit(name: &str, m: Span, x: Span) -> Rc<Unit> {
    let mut b = Builder::new(
        name,
        1,
        &[
            "Multiplication of the intervals [m_lo, m_lo + m_ulp] and [x_lo, x_lo + x_ulp], two multipliers, exact.",
            "Bounds are whole units in the last place, so neither straddles zero:",
            "",
            "  lo = (m_lo + (m_ulp if x_lo < 0)) * (x_lo + (x_ulp if m_lo < 0))",
            "  hi = (m_lo + (m_ulp if x_lo >= 0)) * (x_lo + (x_ulp if m_lo >= 0))",
        ],
    );
    let spans = [("m", m), ("x", x)].map(|(name, span)| {
        let bits = needed(span.hi.max(span.lo));
        let port = b.input(&format!("{name}_lo"), span.ty, symmetric(span.lo), Rate::Any);
        let ulp = b.input(&format!("{name}_ulp"), Type::FLAG, (0, 1), Rate::Any);
        let lo = b.resize(&format!("{name}_lo_bits"), port, true, bits);
        let negative = b.op(&format!("{name}_negative"), Op::SignBit, &[lo]);
        let positive = b.op(&format!("{name}_positive"), Op::Not, &[negative]);
        (name, span, lo, ulp, negative, positive)
    });
    let mut bound = |end: &str, own: usize| {
        let (name, span, lo, ulp, ..) = spans[own];
        let (.., negative, positive) = spans[1 - own];
        let sign = if end == "lo" { negative } else { positive };
        let add = b.and(&format!("{end}_{name}_up"), ulp, sign);
        let add = b.op(&format!("{end}_{name}_ulp"), Op::Reinterpret(span.ty.fraction), &[add]);
        let mut sum = b.add(&format!("{end}_{name}_sum"), lo, add);
        if span.hi <= span.lo {
            sum = b.op(&format!("{end}_{name}_declared"), Op::Assert(symmetric(span.hi), "declared-range"), &[sum]);
        }
        let bits = b.ty(lo).bits;
        b.resize(&format!("{end}_{name}"), sum, true, bits)
    };
    let factors = ["lo", "hi"].map(|end| (bound(end, 0), bound(end, 1)));
    let lo = product(&mut b, "product_lo", factors[0].0, factors[0].1);
    let hi = product(&mut b, "product_hi", factors[1].0, factors[1].1);
    interval::output(&mut b, "", Bounds { lo, hi });
    b.finish()
}

/// Signed bits that hold `[-bound, bound]`.
fn needed(bound: i128) -> u32 {
    129 - bound.leading_zeros()
}

/// Bits a tile contributes: a multiplier's width less the sign.
const TILE: u32 = MULTIPLIER_BITS - 1;

/// An exact product, from as many hardware multipliers as its operands need: wider operands are cut in tiles of 17
/// unsigned bits under a signed top.
///
/// Products of tiles that are as far apart as they are wide, those on one diagonal, stand side by side without adding.
fn product(b: &mut Builder, name: &str, x: NodeId, y: NodeId) -> NodeId {
    let (bits_x, bits_y) = (b.ty(x).bits, b.ty(y).bits);
    if bits_x <= MULTIPLIER_BITS && bits_y <= MULTIPLIER_BITS {
        return b.op(name, Op::Multiply, &[x, y]);
    }
    let xs = tiles(b, &format!("{name}_x"), x);
    let ys = tiles(b, &format!("{name}_y"), y);
    let (last_x, last_y) = (xs.len() as i32 - 1, ys.len() as i32 - 1);
    let mut diagonals = vec![];
    for diagonal in -last_y..=last_x {
        let places = (0..=last_x).filter(|i| (0..=last_y).contains(&(i - diagonal)));
        let mut parts = vec![];
        for i in places {
            let j = i - diagonal;
            let tile = b.op(&format!("{name}_tile_{i}{j}"), Op::Multiply, &[xs[i as usize], ys[j as usize]]);
            // Only the topmost part may be negative; the others are products of tails.
            let inner = i < last_x && j < last_y;
            parts.push(if inner { b.resize(&format!("{name}_part_{i}{j}"), tile, false, 2 * TILE) } else { tile });
        }
        let bits = match parts[..] {
            [one] => one,
            _ => b.op(&format!("{name}_diagonal_{}", diagonal + last_y), Op::Concatenate, &parts),
        };
        diagonals.push(bits);
    }
    // From the highest place down: the low bits of a diagonal pass by the adders.
    diagonals.sort_by_key(|d| b.ty(*d).fraction);
    let mut sum = diagonals[0];
    for (n, diagonal) in diagonals.into_iter().enumerate().skip(1) {
        let name = format!("{name}_sum_{n}");
        let below = (b.ty(diagonal).fraction - b.ty(sum).fraction) as u32;
        sum = if below == 0 {
            b.add(&name, diagonal, sum)
        } else {
            let low = b.op(&format!("{name}_low"), Op::LowBits(below), &[diagonal]);
            let high = b.op(&format!("{name}_high"), Op::Floor(below), &[diagonal]);
            let above = b.add(&format!("{name}_above"), high, sum);
            b.op(&name, Op::Concatenate, &[low, above])
        };
    }
    let whole = b.op(&format!("{name}_whole"), Op::Fact(Fact::Product), &[sum, x, y]);
    b.resize(name, whole, true, bits_x + bits_y)
}

fn tiles(b: &mut Builder, name: &str, x: NodeId) -> Vec<NodeId> {
    let ty = b.ty(x);
    if ty.bits <= MULTIPLIER_BITS {
        return vec![x];
    }
    let low = b.op(&format!("{name}_tail"), Op::LowBits(TILE), &[x]);
    let low = b.resize(&format!("{name}_tail_signed"), low, true, MULTIPLIER_BITS);
    let high = b.op(&format!("{name}_head"), Op::Floor(TILE), &[x]);
    let mut all = vec![low];
    all.extend(tiles(b, &format!("{name}_head"), high));
    all
}
