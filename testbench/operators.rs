//! Single operators, exhaustively at small widths, through the evaluation of their graphs; and the ranges that graphs
//! claim: that no value leaves them, and that impossible ones are refused. `docs/proofs.md` names the test beside each
//! statement.

mod axis;
mod axis_shift;
mod comparator;
mod determinants;
mod edge;
mod edge_test;
mod integral_digits;
mod multiply;
mod range;
mod renormalise;
mod rounding;
mod transform_row;

use efsat::design::interval::Interval as Bundle;
use efsat::graph::evaluate::Evaluator;
use efsat::graph::flat::FlatNode;
use efsat::graph::{Block, Library, Op, Sig, Signals, Top, Vec3};
use efsat::number::{Interval, Upper, floor_shift, upper_shift};
use efsat::op::{Comb, Range, Type};
use std::ops::RangeInclusive;
use std::panic::{AssertUnwindSafe, catch_unwind};
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

/// A unit under test: inputs and outputs are in the order in which they were made. At every run all values are compared
/// with the ranges that the graph claims.
struct Bench {
    evaluator: Evaluator,
    claimed: Vec<Range>,
    inputs: Vec<i128>,
}

impl Bench {
    fn new(body: impl for<'l> FnOnce(Top<'l>) -> Vec<Sig<'l>>) -> Self {
        Self::shared(1, body)
    }

    /// For a part with multipliers of so many bits.
    fn of_multipliers(of: [u32; 2], body: impl for<'l> FnOnce(Top<'l>) -> Vec<Sig<'l>>) -> Self {
        let library = Library::default().with_multiplier(of);
        Self::of(&library.block("bench", &[], 1, |top| body(top).named("result")))
    }

    /// A unit that is shared over phases.
    fn shared(interval: usize, body: impl for<'l> FnOnce(Top<'l>) -> Vec<Sig<'l>>) -> Self {
        let library = Library::default();
        Self::of(&library.block("bench", &[], interval, |top| body(top).named("result")))
    }

    fn of(unit: &Rc<Block>) -> Self {
        let evaluator = Evaluator::new(unit);
        let flat = evaluator.flat();
        let claim = |node: &FlatNode| match node.op {
            // What a shift would lose shows in its value; where that is chosen, the choice has a bound.
            Op::Comb(Comb::ShiftLeft(_)) => (i128::MIN, i128::MAX),
            _ => flat.blocks[node.origin.0].range(node.origin.1),
        };
        Self { claimed: flat.nodes.iter().map(claim).collect(), evaluator, inputs: vec![] }
    }

    /// Sets the inputs: intervals and then single values.
    fn set(&mut self, x: &[Bounds], extra: &[i128]) {
        self.inputs.clear();
        self.inputs.extend(x.iter().flat_map(|x| [x.lo, x.hi]).chain(extra.iter().copied()));
        assert_eq!(self.inputs.len(), self.evaluator.flat().inputs.len());
    }

    /// Runs on intervals and then single values.
    fn run(&mut self, x: &[Bounds], extra: &[i128]) -> Vec<i128> {
        self.set(x, extra);
        self.evaluator.run(&self.inputs);
        let flat = self.evaluator.flat();
        for step in &flat.steps {
            let (value, (least, most)) = (self.evaluator.at(step.node, step.phase), self.claimed[step.node]);
            assert!(least <= value && value <= most, "{}: {value}", flat.nodes[step.node].path);
        }
        flat.outputs.iter().map(|output| self.evaluator.at(*output, 0)).collect()
    }

    /// Runs where all outputs are intervals.
    fn bounds(&mut self, x: &[Bounds], extra: &[i128]) -> Vec<Bounds> {
        self.run(x, extra).chunks(2).map(|x| at(x[0], x[1])).collect()
    }

    /// Whether the evaluator finds, by itself, that something assumed does not hold.
    fn refuses(&mut self, x: &[Bounds], extra: &[i128]) -> bool {
        self.set(x, extra);
        catch_unwind(AssertUnwindSafe(|| self.evaluator.run(&self.inputs))).is_err()
    }
}

/// Named intervals with bounds no farther from zero than one number.
fn inputs<'l, const N: usize>(top: Top<'l>, name: &str, ty: Type, bound: i128) -> [Bundle<Sig<'l>>; N] {
    let end = || top.input(ty, (-bound, bound));
    [(); N].map(|()| Bundle { lo: end(), hi: end() }).named(name)
}

/// The same as a vector.
fn vector<'l>(top: Top<'l>, name: &str, ty: Type, bound: i128) -> Vec3<Bundle<Sig<'l>>> {
    Vec3(inputs(top, name, ty, bound))
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
