//! Single operators, exhaustively at small widths, through the evaluation of their graphs; and the static range
//! analysis: that it is sound, and that it can fail. `docs/proofs.md` names the test beside each statement.

mod axis;
mod comparator;
mod edge;
mod integral_digits;
mod multiply;
mod range;
mod renormalise;
mod rounding;
mod transform_row;

use efsat::design::multiply::case;
use efsat::graph::Unit;
use efsat::graph::evaluate::Evaluator;
use efsat::graph::range::analyse;
use efsat::number::{Interval, Upper, floor_shift, upper_shift};
use std::ops::RangeInclusive;
use std::rc::Rc;

type Bounds = Interval<i128>;

const UPPERS: [Upper; 2] = [Upper::Implied, Upper::Sticky];

fn at(lo: i128, hi: i128) -> Bounds {
    Interval::new(lo, hi)
}

/// All intervals with bounds in a range.
fn intervals(range: RangeInclusive<i128>) -> Vec<Bounds> {
    range.clone().flat_map(|lo| (lo..=*range.end()).map(move |hi| at(lo, hi))).collect()
}

fn values(x: Bounds) -> RangeInclusive<i128> {
    x.lo..=x.hi
}

fn contains(x: Bounds, value: i128) -> bool {
    x.lo <= value && value <= x.hi
}

/// Every way to take one item out of `count` times the same list.
fn tuples<T: Copy>(items: &[T], count: u32, mut visit: impl FnMut(&[T])) {
    let mut tuple = vec![items[0]; count as usize];
    for code in 0..items.len().pow(count) {
        let mut rest = code;
        for place in &mut tuple {
            *place = items[rest % items.len()];
            rest /= items.len();
        }
        visit(&tuple);
    }
}

/// A unit under test: static ranges proven, inputs in port order, outputs by name.
struct Bench {
    evaluator: Evaluator,
    ports: Vec<String>,
}

impl Bench {
    fn new(unit: &Rc<Unit>) -> Self {
        analyse(unit).unwrap_or_else(|e| panic!("{}: {e}", unit.name));
        let ports = unit.inputs.iter().map(|i| unit.node(i.node).name.clone()).collect();
        Self { evaluator: Evaluator::new(unit), ports }
    }

    /// Runs on intervals in port order, then single values.
    fn run(&mut self, x: &[Bounds], extra: &[i128]) {
        let inputs: Vec<i128> = x.iter().flat_map(|x| [x.lo, x.hi]).chain(extra.iter().copied()).collect();
        assert_eq!(inputs.len(), self.ports.len(), "{:?}", self.ports);
        self.evaluator.run(&inputs);
    }

    /// Runs on inputs given by port name.
    fn run_by_name(&mut self, value: impl Fn(&str) -> i128) {
        let inputs: Vec<i128> = self.ports.iter().map(|name| value(name)).collect();
        self.evaluator.run(&inputs);
    }

    /// The interval at the ports `{name}_lo`, `{name}_hi`, or `lo`, `hi` for an empty name.
    fn interval(&self, name: &str) -> Bounds {
        let join = |end: &str| if name.is_empty() { end.to_owned() } else { format!("{name}_{end}") };
        at(self.evaluator.output(&join("lo")), self.evaluator.output(&join("hi")))
    }

    fn flag(&self, name: &str) -> bool {
        self.evaluator.output(name) != 0
    }
}

/// The sign case of an interval, by its definition.
fn sign_case(x: Bounds) -> i128 {
    let case = match () {
        () if 0 <= x.lo => case::POSITIVE,
        () if x.hi <= 0 => case::NEGATIVE,
        () if -x.lo <= x.hi => case::UPPER,
        () => case::LOWER,
    };
    case as i128
}

/// The sign cases of some intervals, for the ports behind their bounds.
fn sign_cases(x: &[Bounds]) -> Vec<i128> {
    x.iter().map(|x| sign_case(*x)).collect()
}

/// Section 5 of the contract: four products, but [-P, P] where both factors straddle zero.
fn product(x: Bounds, y: Bounds) -> Bounds {
    let straddles = |x: Bounds| x.lo < 0 && 0 < x.hi;
    if straddles(x) && straddles(y) {
        let p = x.hi.max(-x.lo) * y.hi.max(-y.lo);
        return at(-p, p);
    }
    let corners = [x.lo * y.lo, x.lo * y.hi, x.hi * y.lo, x.hi * y.hi];
    at(corners.into_iter().min().unwrap(), corners.into_iter().max().unwrap())
}

fn plus(x: Bounds, y: Bounds) -> Bounds {
    at(x.lo + y.lo, x.hi + y.hi)
}

fn minus(x: Bounds, y: Bounds) -> Bounds {
    at(x.lo - y.hi, x.hi - y.lo)
}

fn rounded(x: Bounds, drop: i32, upper: Upper) -> Bounds {
    at(floor_shift(x.lo, drop), upper_shift(x.hi, drop, upper))
}

/// That `r` is `x` with `drop` bits dropped: outward, and by no more than one unit in the last place of the result.
fn within_one_ulp(r: Bounds, x: Bounds, drop: i32, upper: Upper) -> bool {
    let (finer, ulp) = (1i128 << (-drop).max(0), 1i128 << drop.max(0));
    let below = x.lo * finer - r.lo * ulp;
    let above = r.hi * ulp - x.hi * finer;
    let most_above = match upper {
        _ if drop <= 0 => 0,
        Upper::Implied => ulp,
        Upper::Sticky => ulp - 1,
    };
    (0..ulp).contains(&below) && (0..=most_above).contains(&above)
}
