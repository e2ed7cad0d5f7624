//! Interval operators: add, subtract, and the outward roundings.

use efsat_hardware::graph::{Builder, Fact, NodeId, Op, Range, Rate, Type, Unit};
use efsat_hardware::number::Upper;
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
