//! Interval operators: add, subtract and multiply by sign cases, and the outward roundings.

use crate::device::MULTIPLIER_BITS;
use crate::graph::{Builder, Fact, NodeId, Op, Range, Rate, Type, Unit};
use crate::number::Upper;
use std::rc::Rc;

/// The two bounds of an interval in a graph.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bounds {
    /// Lower bound.
    pub lo: NodeId,
    /// Upper bound.
    pub hi: NodeId,
}

impl Bounds {
    /// The bounds as an array, for ports.
    pub fn nodes(self) -> [NodeId; 2] {
        [self.lo, self.hi]
    }
}

/// A symmetric range.
pub fn symmetric(bound: i128) -> Range {
    (-bound, bound)
}

/// Two input ports `{name}_lo` and `{name}_hi`.
pub fn input(b: &mut Builder, name: &str, ty: Type, range: Range) -> Bounds {
    let lo = b.input(&format!("{name}_lo"), ty, range, Rate::Any);
    let hi = b.input(&format!("{name}_hi"), ty, range, Rate::Any);
    Bounds { lo, hi }
}

/// Two output ports `{name}_lo` and `{name}_hi`, or `lo` and `hi` for an empty name.
pub fn output(b: &mut Builder, name: &str, x: Bounds) {
    let join = |end: &str| if name.is_empty() { end.to_owned() } else { format!("{name}_{end}") };
    b.output(&join("lo"), x.lo);
    b.output(&join("hi"), x.hi);
}

/// Instantiates a unit whose outputs are intervals.
pub fn instance(b: &mut Builder, name: &str, unit: &Rc<Unit>, args: &[Bounds], extra: &[NodeId]) -> Vec<Bounds> {
    let args: Vec<NodeId> = args.iter().flat_map(|x| x.nodes()).chain(extra.iter().copied()).collect();
    b.instance(name, unit, &args).chunks_exact(2).map(|c| Bounds { lo: c[0], hi: c[1] }).collect()
}

/// How a value is brought to its format: drop low bits outward (negative: append zeros), then clamp.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Rounding {
    /// Low bits dropped.
    pub drop: i32,
    /// Bound on the true value, and its lemma.
    pub clamp: Option<(i128, &'static str)>,
}

/// Rounds outward to `bits` bits; where there are several ways, `select` chooses among them.
pub fn round(
    b: &mut Builder,
    name: &str,
    x: Bounds,
    ways: &[Rounding],
    select: Option<NodeId>,
    upper: Upper,
    bits: u32,
) -> Bounds {
    let single = ways.len() == 1;
    let mut rounded = vec![];
    for (i, way) in ways.iter().enumerate() {
        let name = if single { name.to_owned() } else { format!("{name}_way_{i}") };
        rounded.push(round_one(b, &name, x, *way, upper, single));
    }
    let end = |b: &mut Builder, end: &str, of: fn(&Bounds) -> NodeId| {
        let value = match select.filter(|_| !single) {
            None => of(&rounded[0]),
            Some(select) => {
                let legs: Vec<NodeId> = std::iter::once(select).chain(rounded.iter().map(of)).collect();
                b.op(&format!("{name}_chosen_{end}"), Op::Select, &legs)
            }
        };
        b.resize(&format!("{name}_{end}"), value, true, bits)
    };
    Bounds { lo: end(b, "lo", |x| x.lo), hi: end(b, "hi", |x| x.hi) }
}

fn round_one(b: &mut Builder, name: &str, x: Bounds, way: Rounding, upper: Upper, keep_point: bool) -> Bounds {
    let cut = |b: &mut Builder, end: &str, value: NodeId| match way.drop {
        0 => value,
        drop if drop > 0 => {
            let id = b.op(&format!("{name}_floor_{end}"), Op::Floor(drop as u32), &[value]);
            b.comment(id, "floor: drop the low bits")
        }
        drop => b.op(&format!("{name}_append_{end}"), Op::Append(drop.unsigned_abs()), &[value]),
    };
    let lo = cut(b, "lo", x.lo);
    let floor = cut(b, "hi", x.hi);
    let hi = if way.drop <= 0 {
        floor
    } else {
        let fraction = b.ty(floor).fraction;
        match upper {
            Upper::Implied => {
                let ulp = b.constant(&format!("{name}_ulp"), 1, Type { fraction, ..Type::FLAG });
                let id = b.add(&format!("{name}_up"), floor, ulp);
                b.comment(id, "floor + ulp (equation 5)")
            }
            Upper::Sticky => {
                let low = b.op(&format!("{name}_dropped"), Op::LowBits(way.drop as u32), &[x.hi]);
                let any = b.op(&format!("{name}_sticky"), Op::AnyBit, &[low]);
                let any = b.op(&format!("{name}_sticky_ulp"), Op::Reinterpret(fraction), &[any]);
                let up = b.add(&format!("{name}_up"), floor, any);
                b.comment(up, "exact ceiling: floor + OR of the dropped bits");
                b.op(&format!("{name}_ceiling"), Op::Fact(Fact::Ceiling(way.drop as u32)), &[up, x.hi])
            }
        }
    };
    let finish = |b: &mut Builder, end: &str, value: NodeId| {
        let value = match way.clamp {
            Some((bound, lemma)) => {
                let id = b.op(&format!("{name}_clamp_{end}"), Op::Clamp(bound, lemma), &[value]);
                b.comment(id, format!("the true value is within +-{bound}: lemma {lemma}"))
            }
            None => value,
        };
        if keep_point || b.ty(value).fraction == 0 {
            value
        } else {
            // Several formats share these bits; the binary point moves with the phase.
            b.op(&format!("{name}_bits_{end}"), Op::Reinterpret(0), &[value])
        }
    };
    Bounds { lo: finish(b, "lo", lo), hi: finish(b, "hi", hi) }
}

/// `x + y`, exact.
pub fn add_unit(name: &str, x: (Type, Range), y: (Type, Range)) -> Rc<Unit> {
    let mut b = Builder::new(name, 1, &["Interval addition, exact: [x_lo + y_lo, x_hi + y_hi]."]);
    let x = input(&mut b, "x", x.0, x.1);
    let y = input(&mut b, "y", y.0, y.1);
    let lo = b.add("sum_lo", x.lo, y.lo);
    let hi = b.add("sum_hi", x.hi, y.hi);
    output(&mut b, "", Bounds { lo, hi });
    b.finish()
}

/// What follows an interval subtraction.
#[derive(Clone, Copy, Debug)]
pub struct Narrowing {
    /// A bound on the exact difference that ranges cannot see, with its lemma.
    pub bound: Option<(i128, &'static str)>,
    /// Rounding.
    pub rounding: Rounding,
    /// Bits of the result.
    pub bits: u32,
    /// Rule for upper bounds.
    pub upper: Upper,
}

/// `x - y`, exact, or narrowed to a format.
pub fn subtract_unit(name: &str, x: (Type, Range), y: (Type, Range), narrowing: Option<Narrowing>) -> Rc<Unit> {
    let doc = match narrowing {
        None => "Interval subtraction, exact: [x_lo - y_hi, x_hi - y_lo].",
        Some(_) => "Interval subtraction [x_lo - y_hi, x_hi - y_lo], rounded outward.",
    };
    let mut b = Builder::new(name, 1, &[doc]);
    let x = input(&mut b, "x", x.0, x.1);
    let y = input(&mut b, "y", y.0, y.1);
    let lo = b.subtract("difference_lo", x.lo, y.hi);
    let hi = b.subtract("difference_hi", x.hi, y.lo);
    let exact = Bounds { lo, hi };
    let result = match narrowing {
        None => exact,
        Some(Narrowing { bound, rounding, bits, upper }) => {
            let bounded = match bound {
                None => exact,
                Some((bound, lemma)) => {
                    let op = Op::Assert(symmetric(bound), lemma);
                    let lo = b.op("bounded_lo", op.clone(), &[exact.lo]);
                    let hi = b.op("bounded_hi", op, &[exact.hi]);
                    b.comment(lo, format!("within +-{bound}: lemma {lemma}"));
                    Bounds { lo, hi }
                }
            };
            round(&mut b, "rounded", bounded, &[rounding], None, upper, bits)
        }
    };
    output(&mut b, "", result);
    b.finish()
}

/// `x * y` by sign cases (Kulisch): two multipliers; where both factors straddle zero the product is `[-P, P]` with
/// `P = max(-x_lo, x_hi) * max(-y_lo, y_hi)`.
///
/// Factors are bounded by `x_bound` and `y_bound`; multipliers are as wide as these need.
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
            "  P = max(-x_lo, x_hi) * max(-y_lo, y_hi); a zero bound counts as non-negative.",
        ],
    );
    let bits = [needed(x.1), needed(y.1)];
    let xs = input(&mut b, "x", x.0, symmetric(x.1));
    let ys = input(&mut b, "y", y.0, symmetric(y.1));
    let x = classify(&mut b, "x", xs, bits[0]);
    let y = classify(&mut b, "y", ys, bits[1]);
    let both = b.and("both_straddle", x.straddles, y.straddles);
    b.comment(both, "the case of four products: [-P, P]");
    // The bound taken as factor: upper of x where y is negative, or straddles beside a non-negative x, and so on.
    let rule = |b: &mut Builder, name: &str, other: &Class, own: NodeId| {
        let straddle = b.and(&format!("{name}_straddle"), other.straddles, own);
        b.op(name, Op::Or, &[other.negative, straddle])
    };
    let lo_takes_x_hi = rule(&mut b, "lo_takes_x_hi", &y, x.positive);
    let lo_takes_y_hi = rule(&mut b, "lo_takes_y_hi", &x, y.positive);
    let hi_takes_x_lo = rule(&mut b, "hi_takes_x_lo", &y, x.negative);
    let hi_takes_y_lo = rule(&mut b, "hi_takes_y_lo", &x, y.negative);
    let factor = |b: &mut Builder, name: &str, flag, if_set, if_clear, extreme| {
        let bound = b.either(&format!("{name}_bound"), flag, if_set, if_clear);
        b.either(name, both, extreme, bound)
    };
    let lo_x = factor(&mut b, "lo_x", lo_takes_x_hi, x.hi, x.lo, x.least);
    let lo_y = factor(&mut b, "lo_y", lo_takes_y_hi, y.hi, y.lo, y.greatest);
    let hi_x = factor(&mut b, "hi_x", hi_takes_x_lo, x.lo, x.hi, x.greatest);
    let hi_y = factor(&mut b, "hi_y", hi_takes_y_lo, y.lo, y.hi, y.greatest);
    let lo = product(&mut b, "product_lo", lo_x, lo_y);
    let hi = product(&mut b, "product_hi", hi_x, hi_y);
    output(&mut b, "", Bounds { lo, hi });
    b.finish()
}

/// The sign case of a factor, and what the straddling case needs.
struct Class {
    lo: NodeId,
    hi: NodeId,
    positive: NodeId,
    negative: NodeId,
    straddles: NodeId,
    least: NodeId,
    greatest: NodeId,
}

fn classify(b: &mut Builder, name: &str, bounds: Bounds, bits: u32) -> Class {
    let lo = b.resize(&format!("{name}_lo_bits"), bounds.lo, true, bits);
    let hi = b.resize(&format!("{name}_hi_bits"), bounds.hi, true, bits);
    let ty = b.ty(hi);
    let below = b.op(&format!("{name}_lo_below"), Op::SignBit, &[lo]);
    let positive = b.op(&format!("{name}_positive"), Op::Not, &[below]);
    b.comment(positive, format!("{name}_lo >= 0"));
    let zero = b.constant(&format!("{name}_zero"), 0, ty);
    let above = b.op(&format!("{name}_hi_above"), Op::Less, &[zero, hi]);
    let straddles = b.and(&format!("{name}_straddles"), below, above);
    b.comment(straddles, format!("{name}_lo < 0 < {name}_hi"));
    let not_above = b.op(&format!("{name}_hi_not_above"), Op::Not, &[above]);
    let negative = b.and(&format!("{name}_negative"), below, not_above);
    b.comment(negative, format!("{name}_lo < 0 and {name}_hi <= 0"));
    let minus_lo = b.op(&format!("{name}_minus_lo"), Op::Negate, &[lo]);
    let minus_hi = b.op(&format!("{name}_minus_hi"), Op::Negate, &[hi]);
    let greatest = b.op(&format!("{name}_greatest_wide"), Op::Maximum, &[minus_lo, hi]);
    let greatest = b.resize(&format!("{name}_greatest"), greatest, true, bits);
    b.comment(greatest, format!("max(-{name}_lo, {name}_hi)"));
    let least = b.op(&format!("{name}_least_wide"), Op::Minimum, &[lo, minus_hi]);
    let least = b.resize(&format!("{name}_least"), least, true, bits);
    b.comment(least, format!("-max(-{name}_lo, {name}_hi)"));
    Class { lo, hi, positive, negative, straddles, least, greatest }
}

/// Signed bits that hold `[-bound, bound]`.
fn needed(bound: i128) -> u32 {
    129 - bound.leading_zeros()
}

/// Bits a tile contributes: a multiplier's width less the sign.
const TILE: u32 = MULTIPLIER_BITS - 1;

/// An exact product, from as many hardware multipliers as its operands need: wider operands are cut in tiles of 17
/// unsigned bits under a signed top.
fn product(b: &mut Builder, name: &str, x: NodeId, y: NodeId) -> NodeId {
    let (bits_x, bits_y) = (b.ty(x).bits, b.ty(y).bits);
    if bits_x <= MULTIPLIER_BITS && bits_y <= MULTIPLIER_BITS {
        return b.op(name, Op::Multiply, &[x, y]);
    }
    let fraction = b.ty(x).fraction + b.ty(y).fraction;
    let xs = tiles(b, &format!("{name}_x"), x);
    let ys = tiles(b, &format!("{name}_y"), y);
    let mut terms = vec![];
    for (i, x) in xs.iter().enumerate() {
        for (j, y) in ys.iter().enumerate() {
            let term = b.op(&format!("{name}_tile_{i}{j}"), Op::Multiply, &[*x, *y]);
            let zeros = fraction - b.ty(term).fraction;
            terms.push((zeros, format!("{name}_term_{i}{j}"), term));
        }
    }
    terms.sort_by_key(|t| t.0);
    let terms: Vec<NodeId> = terms
        .into_iter()
        .map(|(zeros, name, term)| if zeros == 0 { term } else { b.op(&name, Op::Append(zeros as u32), &[term]) })
        .collect();
    let sum = b.tree(&format!("{name}_sum"), Op::Add, &terms);
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
