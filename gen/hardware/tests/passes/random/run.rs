//! A design under a sequencer: what the graph says of the pairs, and what simulation and GHDL say clock by clock.

use super::build::{Built, build};
use super::case::Case;
use efsat_hardware::graph::evaluate::Evaluator;
use efsat_hardware::graph::{Op, Place, Step};
use efsat_hardware::netlist::lower::{HOLDS, PHASE};
use efsat_hardware::netlist::simulate::Simulation;
use efsat_hardware::netlist::{Control, Module, Wire};
use efsat_hardware::op::{Lookup, Range, Type};
use efsat_hardware::{testing, tools, vhdl};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use std::fmt::Write;
use std::panic::catch_unwind;
use std::process::Command;
use std::rc::Rc;

/// Slots in which pairs may come.
const SLOTS: usize = 10;

/// What goes in and what comes out.
struct Run {
    top: Rc<Module>,
    /// Of every input port in every clock.
    inputs: Vec<Vec<i128>>,
    /// Of every output port in every clock in which it has a meaning.
    expected: Vec<Vec<Option<i128>>>,
    block: usize,
}

/// The design under a counter of phases, whose slot holds a pair where `accept` was set in the last clock of the one before.
fn top(module: &Rc<Module>, interval: usize) -> Rc<Module> {
    let m = Control::new("top", vec![]);
    let phased = module.inputs.iter().any(|id| module.signal(*id).place.base == PHASE);
    let accept = phased.then(|| m.input("accept", Type::FLAG));
    let ty = Type::index(interval);
    let phase = m.register("slot_phase", ty);
    let next = (0..interval as i128).map(|s| (s + 1) % interval as i128).collect();
    phase.loads(phase.apply(Lookup(next, ty), &[]), None, None);
    let last = phase.is(interval as i128 - 1).named("last_phase");
    let mut before = accept;
    let input = |id: &efsat_hardware::netlist::SignalId| {
        let signal = module.signal(*id);
        match (signal.place.base.as_str(), before) {
            (PHASE, Some(_)) => phase,
            (HOLDS, Some(flag)) => {
                let [Step::Index(age)] = signal.place.path[..] else { panic!("an age") };
                let holds = m.register(Place::at("slot_holds", &[Step::Index(age)]), Type::FLAG);
                holds.loads(flag, Some(last), None);
                before = Some(holds);
                holds
            }
            _ => m.input(&signal.name()[..], signal.ty),
        }
    };
    let inputs: Vec<Wire> = module.inputs.iter().map(input).collect();
    let outputs = m.instance("inner", module, &inputs);
    outputs.iter().zip(&module.outputs).for_each(|(wire, (place, _))| wire.output(Place::new(place.to_string())));
    m.finish()
}

fn run(case: &Case) -> Option<Run> {
    let Built { block, inputs: ranges, outputs, schedule, module, probes } = &build(case)?;
    let mut random = ChaCha8Rng::seed_from_u64(case.seed);
    let top = top(module, case.interval);
    let interval = case.interval;
    let lag = schedule.lag_clocks() as usize;
    let clocks = (SLOTS + 2) * interval + module.latency.unwrap_or(0) as usize + lag;
    let mut value = |(least, most): Range| match random.random_range(0..8) {
        0 => least,
        1 => most,
        _ => random.random_range(least..=most),
    };
    let steady: Vec<i128> = ranges.iter().map(|range| value(*range)).collect();
    let phased = top.inputs.len() > block.inputs.len();
    // No pair is accepted before the first clock.
    let holds: Vec<bool> = (0..SLOTS).map(|slot| (slot > 0 || !phased) && value((0, 3)) > 0).collect();
    let mut inputs = vec![vec![]; top.inputs.len()];
    let mut expected = vec![vec![None; clocks]; top.outputs.len()];
    let mut evaluator = Evaluator::new(block);
    for slot in 0..clocks.div_ceil(interval) {
        let pair = holds.get(slot) == Some(&true);
        let each = block.inputs.iter().enumerate().map(|(k, id)| match (&block.node(*id).op, pair) {
            (Op::Steady, _) => steady[k],
            (_, true) => value(ranges[k]),
            // Whatever has so many bits.
            (_, false) => value(block.node(*id).ty.limits()),
        });
        let each: Vec<i128> = each.collect();
        let first = inputs.len() - each.len();
        for s in 0..interval {
            if phased {
                let next = holds.get(slot + 1) == Some(&true);
                inputs[0].push(i128::from(if s + 1 == interval { next } else { value((0, 1)) == 1 }));
            }
            (inputs[first..].iter_mut().zip(&each)).for_each(|(words, value)| words.push(*value));
        }
        if !pair {
            continue;
        }
        evaluator.run(&each);
        let mut expect = |port: usize, clock: usize, value: i128| {
            // Where the next pair has taken the place of a per-pair value it would be another one's.
            expected[port][slot * interval + clock] = Some(value);
        };
        for (port, phases) in outputs.iter().enumerate() {
            let node = evaluator.flat().outputs[port];
            for (phase, late) in phases {
                let clock = schedule.latency as usize + phase + if *late { lag } else { 0 };
                expect(port, clock, evaluator.at(node, *phase));
            }
        }
        for (k, probe) in probes.iter().enumerate() {
            let node = evaluator.flat().top_node(&probe.name).expect("a node of the top");
            for (phase, clock) in &probe.clocks {
                expect(outputs.len() + k, *clock as usize, evaluator.at(node, *phase));
            }
        }
    }
    inputs.iter_mut().for_each(|values| values.truncate(clocks));
    Some(Run { top, inputs, expected, block: [1, 3, 16, clocks][case.seed as usize % 4] })
}

/// Where the simulation of the netlist is not what the graph says, or why there is none.
pub fn compare(case: &Case) -> Option<String> {
    let found = catch_unwind(|| {
        let Run { top, inputs, expected, block } = run(case)?;
        let mut simulation = Simulation::new(&top, block);
        let clocks = inputs.first().map_or(0, Vec::len);
        for start in (0..clocks).step_by(block) {
            for (port, values) in inputs.iter().enumerate() {
                values[start..].iter().take(block).enumerate().for_each(|(t, value)| simulation.set(port, t, *value));
            }
            simulation.run();
            for (port, values) in expected.iter().enumerate() {
                for t in 0..block.min(clocks - start) {
                    let (found, clock) = (simulation.output(port, t), start + t);
                    if let Some(expected) = values[clock].filter(|expected| *expected != found) {
                        let name = &top.outputs[port].0;
                        return Some(format!(
                            "{name} in clock {clock}: the netlist gives {found}, expected {expected}"
                        ));
                    }
                }
            }
        }
        None
    });
    found.unwrap_or_else(|why| Some(why.downcast_ref::<String>().cloned().unwrap_or_else(|| "a panic".to_owned())))
}

/// The first of some designs whose text GHDL refuses or runs to other values, and what it says.
pub fn ghdl(cases: &[Case]) -> Option<(usize, String)> {
    let Some(tool) = tools::ghdl(true) else {
        testing::skip("GHDL is not installed");
        return None;
    };
    let folder = tempfile::tempdir().expect("a folder");
    let mut files = vec![];
    let (mut declared, mut body) = (String::new(), String::new());
    for (i, case) in cases.iter().enumerate() {
        let Some(run) = run(case) else { continue };
        let texts = match vhdl::print(&run.top, &format!("g{i}_"), "types", &[]) {
            Ok(texts) => texts,
            Err(clash) => return Some((i, clash.to_string())),
        };
        let file = format!("g{i}.vhd");
        let text: String = texts.iter().map(|(_, text)| text.clone() + "\n").collect();
        std::fs::write(folder.path().join(&file), text).expect("a file");
        files.push(file);
        bench(i, &run, &mut declared, &mut body);
    }
    let text = format!(
        "library ieee;\nuse ieee.std_logic_1164.all;\nuse ieee.numeric_std.all;\n\nentity bench is\nend entity bench;\n\n\
         architecture sim of bench is\n{declared}begin\n{body}end architecture sim;\n"
    );
    std::fs::write(folder.path().join("bench.vhd"), text).expect("a file");
    files.push("bench.vhd".to_owned());
    let call = |step: &str, more: &[String]| {
        let output = Command::new(&tool.path).args([step, "--std=93"]).args(more).current_dir(&folder).output();
        let output = output.expect("GHDL runs");
        let text = [output.stdout, output.stderr].map(|text| String::from_utf8_lossy(&text).into_owned()).concat();
        if output.status.success() { None } else { Some(text) }
    };
    let words = |text: &str| text.split(' ').map(str::to_owned).collect::<Vec<_>>();
    let text = call("-a", &files).or_else(|| call("-e", &words("bench")));
    let text = text.or_else(|| call("-r", &words("bench --ieee-asserts=disable")))?;
    // It names the file of the design, or the bench its number.
    let number = |before: &str| {
        let digits: String = text.split_once(before)?.1.chars().take_while(char::is_ascii_digit).collect();
        digits.parse().ok()
    };
    let wrong = number("wrong: ")
        .or_else(|| text.lines().find_map(|line| line.strip_prefix('g')?.split_once('.')?.0.parse().ok()));
    Some((wrong.unwrap_or(0), text))
}

/// One design in the bench: its ports are parts of two vectors, a row of a table is what goes in and comes out in a clock.
fn bench(i: usize, run: &Run, declared: &mut String, body: &mut String) {
    let bits = |value: i128, ty: Type| {
        (0..ty.bits).rev().map(|k| if value >> k & 1 == 1 { '1' } else { '0' }).collect::<String>()
    };
    let inputs: Vec<(String, Type)> =
        run.top.inputs.iter().map(|id| (run.top.signal(*id).name(), run.top.signal(*id).ty)).collect();
    let outputs: Vec<(String, Type)> =
        run.top.outputs.iter().map(|(place, id)| (place.to_string(), run.top.signal(*id).ty)).collect();
    let rows = (0..run.inputs[0].len()).map(|clock| {
        let into = run.inputs.iter().zip(&inputs).map(|(values, (_, ty))| bits(values[clock], *ty));
        let out = run.expected.iter().zip(&outputs).map(|(values, (_, ty))| match values[clock] {
            Some(value) => bits(value, *ty),
            None => "-".repeat(ty.bits as usize),
        });
        format!("{clock} => \"{}\"", into.chain(out).collect::<String>())
    });
    let rows: Vec<String> = rows.collect();
    let width = |ports: &[(String, Type)]| ports.iter().map(|(_, ty)| ty.bits).sum::<u32>();
    let (wide_in, wide_out) = (width(&inputs), width(&outputs));
    let mut map = vec![];
    if run.top.clocked() {
        map.push(format!("clk => clk_{i}"));
    }
    for (ports, vector) in [(&inputs, "x"), (&outputs, "y")] {
        let mut high = width(ports);
        for (name, ty) in ports {
            let part =
                if ty.is_flag() { format!("{}", high - 1) } else { format!("{} downto {}", high - 1, high - ty.bits) };
            map.push(format!("{name} => {vector}_{i}({part})"));
            high -= ty.bits;
        }
    }
    let (all, last) = (wide_in + wide_out, wide_out - 1);
    let _ = write!(
        declared,
        "  type t_{i} is array (natural range <>) of std_logic_vector({} downto 0);\n  constant c_{i} : t_{i} := (\n    {});\n  \
         signal clk_{i} : std_logic := '0';\n  signal x_{i} : std_logic_vector({} downto 0);\n  \
         signal y_{i} : std_logic_vector({last} downto 0);\n",
        all - 1,
        rows.join(",\n    "),
        wide_in - 1,
    );
    let _ = write!(
        body,
        "  unit_{i} : entity work.g{i}_top\n    port map ({});\n  process\n  begin\n    for k in c_{i}'range loop\n      \
         x_{i} <= c_{i}(k)({} downto {wide_out});\n      wait for 1 ns;\n      assert std_match(y_{i}, c_{i}(k)({last} downto 0)) report \
         \"wrong: {i} in clock \" & integer'image(k) & \" \" severity failure;\n      clk_{i} <= '1';\n      wait for 1 ns;\n      clk_{i} <= '0';\n      \
         wait for 1 ns;\n    end loop;\n    wait;\n  end process;\n",
        map.join(", "),
        all - 1,
    );
}
