//! Every operation on all values of its samples' operands: range, lanes and cells against the value.

use super::*;
use crate::cells::{Gate, Source};
use crate::device;
use std::collections::HashMap;

/// All combinations of operands of these types.
fn operands(types: &[Type]) -> Vec<Vec<i128>> {
    types.iter().fold(vec![vec![]], |all, ty| {
        let (least, most) = ty.limits();
        all.iter().flat_map(|args| (least..=most).map(move |x| [&args[..], &[x]].concat())).collect()
    })
}

struct Case {
    op: Comb,
    types: Vec<Type>,
    to: Type,
}

fn cases() -> Vec<Case> {
    let all = samples().into_iter().map(|Sample { op, types }| {
        let to = op.result(&types).unwrap_or_else(|why| panic!("sample of {}: {why}", op.role()));
        Case { op, types, to }
    });
    all.collect()
}

#[test]
fn every_operation_has_samples_of_its_own_role() {
    let mut roles: Vec<&str> = cases().iter().map(|case| case.op.role()).collect();
    roles.dedup();
    let names = cases().iter().map(|case| std::mem::discriminant(&case.op)).collect::<std::collections::HashSet<_>>();
    assert_eq!(roles.len(), names.len(), "{roles:?}");
}

/// All ranges of values of a type.
fn subranges(ty: &Type) -> Vec<Range> {
    let (least, most) = ty.limits();
    (least..=most).flat_map(|lo| (lo..=most).map(move |hi| (lo, hi))).collect()
}

/// The range of single values is the value, at the least, and a range only grows when one of an operand does. So whatever
/// the ranges of operands are, all values of them are in the range of the result.
#[test]
fn ranges_of_operations_enclose_their_values() {
    for Case { op, types, to } in cases() {
        for args in operands(&types) {
            let value = op.value(&args, &types, to);
            let alone: Vec<Range> = args.iter().map(|x| (*x, *x)).collect();
            let (least, most) = op.range(&alone, &types, to);
            // What does not fit is refused when a unit is built.
            assert!((least..=most).contains(&value) || !to.holds((least, most)), "{op:?} of {args:?} is {value}");
        }
        let all = types.iter().map(subranges).fold(vec![vec![]], |all: Vec<Vec<Range>>, each| {
            all.iter().flat_map(|ranges| each.iter().map(|r| [&ranges[..], &[*r]].concat())).collect()
        });
        for ranges in all {
            let (least, most) = op.range(&ranges, &types, to);
            for k in (0..types.len()).filter(|k| ranges[*k].0 < ranges[*k].1) {
                let (lo, hi) = ranges[k];
                for part in [(lo + 1, hi), (lo, hi - 1)] {
                    let mut parts = ranges.clone();
                    parts[k] = part;
                    let (lo, hi) = op.range(&parts, &types, to);
                    assert!(least <= lo && hi <= most || !to.holds((least, most)), "{op:?} of {ranges:?}, {parts:?}");
                }
            }
        }
    }
}

#[test]
fn lanes_compute_the_values() {
    for Case { op, types, to } in cases() {
        let all = operands(&types);
        let lane = |k: usize| all.iter().map(|args| args[k] as i64).collect::<Vec<i64>>();
        let lanes: Vec<Vec<i64>> = (0..types.len()).map(lane).collect();
        let lanes: Vec<&[i64]> = lanes.iter().map(Vec::as_slice).collect();
        let mut results = vec![0; all.len()];
        if op.lanes(&lanes, to, &mut results) {
            for (args, result) in all.iter().zip(results) {
                assert_eq!(i128::from(result), op.value(args, &types, to), "{op:?} of {args:?}");
            }
        }
    }
}

#[test]
fn cells_compute_the_values() {
    for device in device::all() {
        for Case { op, types, to } in cases() {
            let mut words = Words::new(device.fabric);
            let leaf = |(k, ty): (usize, &Type)| Word { bits: words.leaves(ty.bits, |_| Source::Register(k)), ty: *ty };
            let args: Vec<Word> = types.iter().enumerate().map(leaf).collect();
            let result = op.gates(&mut words, &args, to);
            assert_eq!(result.len(), to.bits as usize, "{op:?}");
            for values in operands(&types) {
                let found = evaluate(&words, &args, &values, &result);
                // A value that does not fit the type is refused when a unit is built.
                let expected = to.wrap(op.value(&values, &types, to));
                assert_eq!(to.wrap(found), expected, "{op:?} of {values:?} on {}", device.name);
            }
        }
    }
}

/// The number that bits make, with these values of the operands.
fn evaluate(words: &Words, args: &[Word], values: &[i128], result: &[Bit]) -> i128 {
    let mut known: HashMap<usize, bool> = HashMap::from([(0, false)]);
    for (arg, value) in args.iter().zip(values) {
        known.extend(arg.bits.iter().enumerate().map(|(i, bit)| (bit.gate(), (value >> i) & 1 == 1)));
    }
    let bits = |known: &HashMap<usize, bool>, bits: &[Bit]| -> Option<i128> {
        let each =
            bits.iter().enumerate().map(|(i, b)| Some(i128::from(known.get(&b.gate())? ^ b.is_complement()) << i));
        each.sum()
    };
    for (i, gate) in words.gates.all.iter().enumerate() {
        let one = |known: &HashMap<usize, bool>, bit: Bit| known[&bit.gate()] ^ bit.is_complement();
        let value = match *gate {
            Gate::Zero => false,
            Gate::And(a, b) => one(&known, a) && one(&known, b),
            Gate::Xor(a, b) => one(&known, a) != one(&known, b),
            Gate::Mux(s, a, b) => one(&known, if one(&known, s) { a } else { b }),
            Gate::Leaf => match words.sources[&i] {
                Source::Chain(chain, bit) => {
                    let chain = &words.chains[chain];
                    let (a, b): (Vec<Bit>, Vec<Bit>) = chain.operands.iter().copied().unzip();
                    let (a, b) = (bits(&known, &a).expect("made before"), bits(&known, &b).expect("made before"));
                    ((a + b + i128::from(one(&known, chain.carry))) >> bit) & 1 == 1
                }
                Source::Product(product) => {
                    let [x, y] = &words.products[product];
                    let factor = |bits_of: &[Bit]| {
                        Type::signed(bits_of.len() as u32, 0).wrap(bits(&known, bits_of).expect("made before"))
                    };
                    let first = words.sources.iter().filter(|s| *s.1 == Source::Product(product)).map(|s| *s.0).min();
                    ((factor(x) * factor(y)) >> (i - first.expect("this one"))) & 1 == 1
                }
                Source::Outside | Source::Register(_) => known[&i],
            },
        };
        known.insert(i, value);
    }
    bits(&known, result).expect("all gates are evaluated")
}
