//! Ranges: that no value leaves the one that the graph claims, and that what cannot be is refused.

use super::Bench;
use super::transform_row::small;
use efsat::artefact::Stimulus;
use efsat::design::Design;
use efsat::evidence::cosim;
use efsat::graph::{Fact, Library, Phases, Sig, Signals, Top};
use efsat::number::Upper;
use efsat::op::{Add, Range, Type};
use efsat::params::{Axes, Params, Projections, Transform};
use efsat_hardware::entity;
use std::collections::HashSet;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Whole data paths: in every phase every value lies in its claimed range, at the corners of the declared input ranges
/// too.
#[test]
fn analysed_ranges_contain_every_value() {
    let base = Params { width: 6, transform_width: 8, ..Params::default() };
    let sets = [
        base.clone(),
        small(Upper::Sticky),
        Params { axes: Axes::Seventeen, axes_per_clock: 3, upper: Upper::Sticky, ..base.clone() },
        Params { projections: Projections::Intersect, axes_per_clock: 11, ..base.clone() },
        Params { projections: Projections::Skip, axes: Axes::Seventeen, axes_per_clock: 17, ..base.clone() },
        Params { transform: Transform::Translate, width: 9, transform_width: 20, ..base.clone() },
        Params { transform: Transform::Off, renormalise: false, ..base.clone() },
        Params { renormalise: false, width: 7, int_bits: 5, ..base },
    ];
    for p in sets {
        let design = Design::new(&p, false).unwrap_or_else(|e| panic!("{e} {p:?}"));
        let mut bench = Bench::of(&design.pipeline);
        let (mut steps, mut reached) = (0, HashSet::new());
        for (pose, pairs) in &Stimulus::random(&p, 160, 5).segments {
            for pair in pairs {
                bench.run(&[], &cosim::inputs(&design, pose, pair));
                let flat = bench.evaluator.flat();
                let ends = flat.steps.iter().filter(|step| {
                    let (lo, hi) = bench.claimed[step.node];
                    [lo, hi].contains(&bench.evaluator.at(step.node, step.phase))
                });
                reached.extend(ends.map(|step| step.node));
                steps += flat.steps.len();
            }
        }
        // The ranges are not vacuous: many are reached at one end or the other.
        let nodes = bench.claimed.len();
        assert!(steps > 100_000 && 4 * reached.len() > nodes, "{} of {nodes}", reached.len());
    }
}

/// Two inputs.
fn numbers(top: Top<'_>, range: Range) -> [Sig<'_>; 2] {
    ["x", "y"].map(|name| top.input(Type::signed(6, 0), range).named(name))
}

/// Why a unit of the inputs x and y within a range cannot be made.
fn refusal(range: Range, body: impl for<'l> FnOnce(Top<'l>, Sig<'l>, Sig<'l>) -> Sig<'l>) -> Option<String> {
    let made = catch_unwind(AssertUnwindSafe(|| {
        Library::default().block("outer", &[], 2, |top| {
            let [x, y] = numbers(top, range);
            body(top, x, y).named("result")
        });
    }));
    made.err().map(|why| *why.downcast::<String>().expect("a message"))
}

/// What does not fit is refused where it is made, in whatever unit that is, with names and numbers.
#[test]
fn an_overflow_is_refused_by_name() {
    let of_sum = |most: i128, bits| {
        refusal((-most, most), |_, x, y| entity!("inner", &[], (x, y) => x.apply(Add(Some(bits)), &[y]).named("sum")))
    };
    let found = |why: &str| Some(format!("block {why}"));
    assert_eq!((of_sum(20, 7), of_sum(15, 6)), (None, None));
    assert_eq!(of_sum(20, 6), found("inner, sum(x, y): values from -40 to 40 do not fit s6.0"));
    let of_phases = |range| {
        refusal(range, |top, x, _| {
            let operand = Phases::new(2, |s| Some([top.constant(0, x.ty()), x][s])).mux().named("operand");
            operand.apply(Add(Some(6)), &[operand])
        })
    };
    assert_eq!(of_phases((-15, 15)), None);
    let in_phase = "outer, sum(operand, operand): values from -40 to 40 in phase 1 do not fit s6.0";
    assert_eq!(of_phases((-20, 20)), found(in_phase));
    let promised = |most: i128| {
        refusal((-20, 20), move |top, x, y| {
            let later = top.later(x.ty(), (-most, most)).named("promised");
            later.connect(x);
            later + y
        })
    };
    assert_eq!(promised(20), None);
    let broken = "outer, promised: expected s6.0 within (-19, 19), found x of s6.0 within (-20, 20)";
    assert_eq!(promised(19), found(broken));
}

/// What is assumed of a value is checked at every evaluation.
#[test]
fn what_is_assumed_and_false_is_found() {
    fn assumed(known: impl for<'l> FnOnce([Sig<'l>; 2]) -> Sig<'l>) -> Bench {
        Bench::new(|top| vec![known(numbers(top, (-5, 5)))])
    }
    let mut units = [
        assumed(|[x, y]| (x + y).assume(4, "of some")),
        assumed(|[x, y]| (x + y).known(Fact::Product, &[x, y])),
        assumed(|[x, y]| (x.floor(2) + y.at_point(None)).known(Fact::Ceiling(2), &[x])),
    ];
    for (x, y) in (-5..=5i128).flat_map(|x| (-5..=5).map(move |y| (x, y))) {
        let holds = [(x + y).abs() <= 4, x + y == x * y, (x >> 2) + y == -(-x >> 2)];
        for (unit, holds) in units.iter_mut().zip(holds) {
            assert_eq!(unit.refuses(&[], &[x, y]), !holds, "{x} {y}");
        }
    }
}
