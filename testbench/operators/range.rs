//! The static range analysis: that it is sound, and that it can fail.

use super::transform_row::small;
use super::{Bounds, at, intervals, values};
use efsat::artefact::Stimulus;
use efsat::cosim;
use efsat::design::{Design, interval, multiply};
use efsat::graph::evaluate::Evaluator;
use efsat::graph::flat::Flat;
use efsat::graph::range::{analyse, analyse_flat};
use efsat::graph::{Builder, Op, Rate, Type};
use efsat::number::Upper;
use efsat::params::{Axes, Params, Projections, Transform};
use std::collections::HashSet;

/// Whole data paths: in every phase every value lies in its analysed range, at the corners of the declared input ranges
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
        let flat = Flat::new(&design.pipeline);
        let (_, ranges) = analyse_flat(&flat).unwrap();
        let mut evaluator = Evaluator::new(&design.pipeline);
        let (mut steps, mut reached) = (0usize, HashSet::new());
        for (pose, pairs) in &Stimulus::random(&p, 160, 5).segments {
            for pair in pairs {
                evaluator.run(&cosim::inputs(&design, pose, pair));
                for step in &flat.steps {
                    let value = evaluator.at(step.node, step.phase);
                    let key = step.node * flat.interval + step.phase;
                    let (lo, hi) = ranges[key];
                    let path = &flat.nodes[step.node].path;
                    assert!(lo <= value && value <= hi, "{path}: {value} not in [{lo}, {hi}] {p:?}");
                    steps += 1;
                    if value == lo || value == hi {
                        reached.insert(key);
                    }
                }
            }
        }
        // The ranges are not vacuous: many are reached at one end or the other.
        assert!(steps > 100_000 && 4 * reached.len() > flat.steps.len(), "{} of {}", reached.len(), flat.steps.len());
    }
}

/// The analysis fails where it must: a result cut too narrow, and an operand beyond a port's declared range.
#[test]
fn an_overflow_is_reported_with_its_path() {
    let inner = |bits: u32| {
        let mut b = Builder::new("inner", 1, &[]);
        let x = b.input("x", Type::signed(6, 0), (-20, 20), Rate::Any);
        let sum = b.add("sum", x, x);
        let narrow = b.resize("narrow", sum, true, bits);
        b.output("narrow", narrow);
        b.finish()
    };
    let outer = |bits: u32, range: (i128, i128)| {
        let unit = inner(bits);
        let mut b = Builder::new("outer", 1, &[]);
        let x = b.input("x", Type::signed(6, 0), range, Rate::Any);
        let result = b.instance("twice", &unit, &[x])[0];
        b.output("result", result);
        b.finish()
    };
    assert!(analyse(&outer(7, (-20, 20))).is_ok());
    let overflow = analyse(&outer(6, (-20, 20))).unwrap_err();
    assert_eq!((overflow.path.as_str(), overflow.range), ("twice.narrow", (-40, 40)));
    assert_eq!(overflow.to_string(), "twice.narrow, phase 0: values from -40 to 40 do not fit s6.0");
    let overflow = analyse(&outer(7, (-21, 20))).unwrap_err();
    assert!(overflow.path.starts_with("twice, port x"), "{overflow}");
    // A multiplier is as wide as the declared bounds of its factors; what exceeds them does not fit.
    let ty = Type::signed(6, 0);
    assert!(analyse(&multiply::multiply_unit("multiply", (ty, 31), (ty, 31))).is_ok());
    let mut b = Builder::new("wrapper", 1, &[]);
    let x = interval::input(&mut b, "x", ty, (-32, 31));
    let unit = multiply::multiply_unit("multiply", (ty, 31), (ty, 31));
    let x = multiply::Factor { bounds: x, sign_case: b.constant("x_sign_case", 0, multiply::SIGN_CASE) };
    let out = multiply::instance(&mut b, "product", &unit, x, x);
    interval::output(&mut b, "", out);
    assert!(analyse(&b.finish()).unwrap_err().path.starts_with("product"));
}

/// The operations' ranges enclose their values, on all small operands.
#[test]
fn ranges_of_operations_enclose_their_values() {
    let signed = Type::signed(4, 0);
    let unsigned = Type::unsigned(3);
    let alike = |op: Op, ty: Type, count: usize| (op, vec![ty; count]);
    let all = [
        alike(Op::Add, signed, 2),
        alike(Op::Subtract, signed, 2),
        alike(Op::Multiply, signed, 2),
        alike(Op::Equal, signed, 2),
        alike(Op::And, unsigned, 2),
        alike(Op::Or, unsigned, 2),
        alike(Op::Concatenate, unsigned, 2),
        (Op::Concatenate, vec![unsigned, signed]),
        (Op::NegateIf, vec![Type::FLAG, signed]),
        alike(Op::Negate, signed, 1),
        alike(Op::Magnitude, signed, 1),
        alike(Op::SignBit, signed, 1),
        alike(Op::Floor(2), signed, 1),
        alike(Op::Append(2), signed, 1),
        alike(Op::LowBits(2), signed, 1),
        alike(Op::Clamp(3, "edge-extent"), signed, 1),
        alike(Op::Not, unsigned, 1),
        alike(Op::AnyBit, unsigned, 1),
    ];
    for (op, types) in all {
        let result = op.result(&types).unwrap();
        // The least number of a type has no negative in it, and the range says so.
        let fits = |range: (i128, i128)| result.limits().0 <= range.0 && range.1 <= result.limits().1;
        let operands: Vec<Vec<Bounds>> = types.iter().map(|t| intervals(t.limits().0..=t.limits().1)).collect();
        let none = vec![at(0, 0)];
        for x in &operands[0] {
            for y in operands.get(1).unwrap_or(&none) {
                let range = op.range(&[(x.lo, x.hi), (y.lo, y.hi)][..types.len()], &types, result);
                assert!(fits(range) || matches!(op, Op::NegateIf) && y.lo == signed.limits().0, "{op:?} {x:?} {y:?}");
                for (a, b) in values(*x).flat_map(|a| values(*y).map(move |b| (a, b))) {
                    let value = op.apply(&[a, b][..types.len()], &types, result);
                    assert!(range.0 <= value && value <= range.1, "{op:?} {a} {b}: {value} in {range:?}");
                }
            }
        }
    }
}
