//! Every operation on all values of its samples' operands: range, lanes, cells and VHDL against the value.

use super::*;
use crate::cells::{Gate, Source};
use crate::device;
use crate::netlist::{Control, SignalId, Wire};
use crate::{testing, tools, vhdl};
use std::collections::{BTreeSet, HashMap};
use std::path::Path;
use std::process::{self, Command};

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
    let all = samples().into_iter().flat_map(|(_, samples)| samples).map(|Sample { op, types }| {
        let to = op.result(&types).unwrap_or_else(|why| panic!("sample of {}: {why}", op.role()));
        Case { op, types, to }
    });
    all.collect()
}

#[test]
fn every_file_is_in_the_list() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("op");
    let files = folder.read_dir().expect("sources").map(|file| file.expect("sources").file_name());
    let files: BTreeSet<String> =
        files.filter_map(|file| file.to_str()?.strip_suffix(".rs").map(str::to_owned)).collect();
    let listed = samples().into_iter().map(|(file, _)| file).chain(["mod", "tests"]).map(str::to_owned).collect();
    let missing: Vec<_> = files.difference(&listed).collect();
    assert!(missing.is_empty(), "not in `operations!` of op/mod.rs: {missing:?}");
}

#[test]
fn every_operation_has_samples() {
    let without: Vec<&str> = samples().into_iter().filter(|(_, all)| all.is_empty()).map(|(file, _)| file).collect();
    assert!(without.is_empty(), "files of op/ without samples: {without:?}");
}

/// Whatever is not wires alone takes time, and is no wire in pictures.
#[test]
fn only_wires_have_no_delay() {
    for device in device::all() {
        for Case { op, types, to } in cases() {
            let names: Vec<String> = types.iter().map(Type::to_string).collect();
            let (delay, kind) = (op.delay(device, &types, to), op.picture(&names).0);
            assert_eq!(delay > 0.0, kind != Kind::Wire, "{op:?}, {kind:?}: {delay} ns on {}", device.name);
        }
    }
}

/// All ranges of values of a type.
fn subranges(ty: &Type) -> Vec<Range> {
    let (least, most) = ty.limits();
    (least..=most).flat_map(|lo| (lo..=most).map(move |hi| (lo, hi))).collect()
}

/// Where all values fit the type of the result, so does the range: else blocks are refused. A resize cuts its values.
#[test]
fn ranges_of_operations_fit_their_types() {
    for Case { op, types, to } in cases().into_iter().filter(|case| !matches!(case.op, Comb::Resize(_))) {
        let values = hull(operands(&types).iter().map(|args| op.value(args, &types, to)).map(|x| (x, x)));
        let limits: Vec<Range> = types.iter().map(|ty| ty.limits()).collect();
        let range = op.range(&limits, &types, to);
        assert!(to.holds(range) || !to.holds(values), "{op:?} of {types:?} is within {values:?}, found {range:?}");
    }
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
            // What does not fit is refused when a block is built.
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
                // A value that does not fit the type is refused when a block is built.
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
                Source::Sum(sum) => {
                    let of = |k: usize| bits(&known, &words.sums[sum].operands[k]).expect("made before");
                    let value = if words.sums[sum].minus { of(0) - of(1) } else { of(0) + of(1) };
                    let first = words.sources.iter().filter(|s| *s.1 == Source::Sum(sum)).map(|s| *s.0).min();
                    (value >> (i - first.expect("this one"))) & 1 == 1
                }
                Source::Outside | Source::Register(_) => known[&i],
            },
        };
        known.insert(i, value);
    }
    bits(&known, result).expect("all gates are evaluated")
}

/// GHDL makes the values of the printed text.
#[test]
fn vhdl_computes_the_values() {
    let Some(ghdl) = tools::ghdl(true) else { return testing::skip("GHDL is not installed") };
    let cases = cases();
    let folder = std::env::temp_dir().join(format!("efsat-operations-{}", process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let mut files = printed(&cases);
    files.push(("bench".to_owned(), bench(&cases)));
    let names: Vec<String> = files.iter().map(|(name, _)| format!("{name}.vhd")).collect();
    for ((_, text), name) in files.iter().zip(&names) {
        std::fs::write(folder.join(name), text).expect("a file");
    }
    let call = |step: &str, more: &[&str]| {
        let output = Command::new(&ghdl.path).args([step, "--std=93"]).args(more).current_dir(&folder).output();
        let output = output.expect("GHDL runs");
        let text = [output.stdout, output.stderr].map(|text| String::from_utf8_lossy(&text).into_owned()).concat();
        (output.status.success(), text)
    };
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let steps = [("-a", &names[..]), ("-e", &["bench"]), ("-r", &["bench", "--ieee-asserts=disable"])];
    let said: Vec<(bool, String)> = steps.iter().map(|(step, more)| call(step, more)).collect();
    std::fs::remove_dir_all(&folder).expect("the folder");
    let Some((_, text)) = said.iter().find(|(done, _)| !done) else { return };
    if let Some((_, found)) = text.split_once("wrong: ") {
        let numbers: Vec<usize> = found.split_whitespace().map_while(|word| word.parse().ok()).collect();
        let case = &cases[numbers[0]];
        panic!("{:?} of {:?} in VHDL", case.op, vectors(case)[numbers[1]].0);
    }
    panic!("{text}");
}

/// All cases as one entity: the operands of case 7 are `x_7_0` and `x_7_1`, the result is called after its role, `less_7`.
fn printed(cases: &[Case]) -> Vec<(String, String)> {
    let control = Control::new("operations", vec![]);
    for (i, Case { op, types, .. }) in cases.iter().enumerate() {
        let operand = |(k, ty): (usize, &Type)| control.input(&format!("x_{i}_{k}")[..], *ty);
        let args: Vec<Wire> = types.iter().enumerate().map(operand).collect();
        let result = match (op, &args[..]) {
            (Comb::Constant(Constant(value, ty)), _) => control.constant(*value, *ty),
            (_, [first, others @ ..]) => first.apply(op.clone(), others),
            _ => panic!("{op:?} has no operands"),
        };
        result.output(&format!("{}_{i}", op.role())[..]);
    }
    let operations = control.finish();
    // The ports of a top are plain vectors: the top is another.
    let top = Control::new("top", vec![]);
    let port = |id: &SignalId| top.input(operations.signal(*id).place.clone(), operations.signal(*id).ty);
    let inputs: Vec<Wire> = operations.inputs.iter().map(port).collect();
    let outputs = top.instance("inner", &operations, &inputs);
    outputs.iter().zip(&operations.outputs).for_each(|(wire, (place, _))| wire.output(place.clone()));
    vhdl::print(&top.finish(), "", "types", &[]).expect("legal names")
}

/// The operands of a case whose result fits its type and that lie in its table, and the bits of operands and result.
fn vectors(case: &Case) -> Vec<(Vec<i128>, String)> {
    let Case { op, types, to } = case;
    let word = |(value, ty): (&i128, &Type)| -> String {
        (0..ty.bits).rev().map(|i| if value >> i & 1 == 1 { '1' } else { '0' }).collect()
    };
    let vector = |args: Vec<i128>| {
        let result = op.value(&args, types, *to);
        let bits = args.iter().chain([&result]).zip(types.iter().chain([to])).map(word).collect();
        let beyond = matches!(op, Comb::Lookup(Lookup(table, _)) if args[0] >= table.len() as i128);
        (to.holds((result, result)) && !beyond).then_some((args, bits))
    };
    operands(types).into_iter().filter_map(vector).collect()
}

/// A testbench that ends at the first wrong result and reports the numbers of its case and of its vector.
fn bench(cases: &[Case]) -> String {
    let (mut declared, mut map, mut checks) = (String::new(), vec![], String::new());
    for (i, case) in cases.iter().enumerate() {
        let mut low = case.types.iter().map(|ty| ty.bits).sum::<u32>() + case.to.bits;
        let mut steps = String::new();
        let rows: Vec<String> = vectors(case).iter().enumerate().map(|(k, v)| format!("{k} => \"{}\"", v.1)).collect();
        declared += &format!("  type t_{i} is array (natural range <>) of std_logic_vector({} downto 0);\n", low - 1);
        declared += &format!("  constant c_{i} : t_{i} := (\n    {});\n", rows.join(",\n    "));
        for (k, ty) in case.types.iter().chain([&case.to]).enumerate() {
            let high = low - 1;
            low -= ty.bits;
            let name = if k < case.types.len() { format!("x_{i}_{k}") } else { format!("{}_{i}", case.op.role()) };
            let kind = if ty.signed { "signed" } else { "unsigned" };
            let (ty, part) = if ty.is_flag() {
                ("std_logic".to_owned(), format!("c_{i}(k)({low})"))
            } else {
                (format!("{kind}({} downto 0)", ty.bits - 1), format!("{kind}(c_{i}(k)({high} downto {low}))"))
            };
            declared += &format!("  signal {name} : {ty};\n");
            steps += &if k < case.types.len() {
                format!("      {name} <= {part};\n")
            } else {
                let report = format!("report \"wrong: {i} \" & integer'image(k) & \" \" severity failure");
                format!("      wait for 1 ns;\n      assert {name} = {part} {report};\n")
            };
            map.push(format!("{name} => {name}"));
        }
        checks += &format!(
            "  process\n  begin\n    for k in c_{i}'range loop\n{steps}    end loop;\n    wait;\n  end process;\n"
        );
    }
    format!(
        "library ieee;\nuse ieee.std_logic_1164.all;\nuse ieee.numeric_std.all;\n\nentity bench is\nend entity bench;\n\n\
         architecture sim of bench is\n{declared}begin\n  unit : entity work.operations\n    port map (\n      {}\n    );\n\
         {checks}end architecture sim;\n",
        map.join(",\n      "),
    )
}
