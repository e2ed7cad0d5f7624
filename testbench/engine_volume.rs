//! The volume unit: graph, built-in simulation and GHDL give the answers of the reference model.

use crate::extent::share;
use crate::tools::clocked::Clocked;
use crate::tools::{Ghdl, ghdl};
use efsat::artefact::Prefix;
use efsat::directions::Directions;
use efsat::engine::artefact::volume::{BENCH, Expansion, NAME, VolumeStimulus, volume_bench, volume_files};
use efsat::engine::design::volume_path;
use efsat::engine::design::volume_unit::VolumeDesign;
use efsat::engine::format::EngineFormat;
use efsat::engine::params::EngineParams;
use efsat::graph::evaluate::Evaluator;
use efsat::graph::{Block, Op};
use efsat::op::Comb;
use efsat::params::Params;
use efsat::vhdl::lint::lint;
use std::collections::HashMap;
use std::rc::Rc;

/// An engine of other directions, widths (of origins, codes and factors) and pace.
fn engine(directions: usize, [origin_bits, offset_bits, factor_bits]: [u32; 3], expansion_clocks: u32) -> EngineParams {
    let directions = Directions::of(directions).expect("a set of directions");
    EngineParams { directions, origin_bits, offset_bits, factor_bits, expansion_clocks, ..EngineParams::default() }
}

const WIDTHS: [u32; 3] = [18, 10, 12];

/// All sets of directions at every pace, and widths that change every shift.
fn engines() -> Vec<EngineParams> {
    let sets = [18, 6, 14, 26].into_iter().flat_map(|k| [4, 2, 1].map(|clocks| engine(k, WIDTHS, clocks)));
    let widths = [[12, 6, 6], [4, 4, 4], [22, 10, 12], [8, 8, 13]].map(|widths| engine(18, widths, 4));
    sets.chain(widths).collect()
}

fn name(engine: &EngineParams) -> String {
    let options = engine.options().into_iter().take(5).map(|(name, value)| format!("{name} {value}"));
    options.collect::<Vec<_>>().join(", ")
}

fn format(engine: &EngineParams) -> EngineFormat {
    engine.format(&Params::default()).unwrap_or_else(|e| panic!("{}: {e}", name(engine)))
}

/// How often each answer comes: every pair of children survives often and is apart often, or nothing would be shown.
fn census(stimulus: &VolumeStimulus) {
    let all = &stimulus.expansions;
    for pair in 0..4 {
        let takes = |e: &&Expansion| e.take[0][pair / 2] && e.take[1][pair % 2];
        let taken = all.iter().filter(takes).count();
        let survives = all.iter().filter(|e| stimulus.answer(e) >> pair & 1 == 1).count();
        assert!(10 * survives > taken && 10 * survives < 9 * taken, "pair {pair}: {survives} of {taken}");
    }
}

/// A unit evaluated on expansions; every value is compared with the range that the graph claims.
struct Bench {
    evaluator: Evaluator,
    inputs: Vec<String>,
}

impl Bench {
    fn new(unit: &Rc<Block>) -> Self {
        let inputs = unit.inputs.iter().map(|id| unit.node(*id).name()).collect();
        Self { evaluator: Evaluator::new(unit), inputs }
    }

    fn answer(&mut self, numbers: &HashMap<String, i128>) -> u32 {
        let inputs: Vec<i128> = self.inputs.iter().map(|port| numbers[port]).collect();
        self.evaluator.run(&inputs);
        let flat = self.evaluator.flat();
        for step in &flat.steps {
            let node = &flat.nodes[step.node];
            if !matches!(node.op, Op::Comb(Comb::ShiftLeft(_))) {
                let (value, (least, most)) =
                    (self.evaluator.at(step.node, step.phase), flat.blocks[node.origin.0].range(node.origin.1));
                assert!(least <= value && value <= most, "{}: {value}", node.path);
            }
        }
        self.evaluator.output("survive") as u32
    }
}

#[test]
fn the_graph_answers_as_the_reference_model() {
    for engine in engines() {
        let format = format(&engine);
        let unit = volume_path::unit(&format, engine.expansion_clocks as usize);
        let stimulus = VolumeStimulus::random(&format, 400, 1);
        census(&stimulus);
        let mut bench = Bench::new(&unit);
        for expansion in &stimulus.expansions {
            let found = bench.answer(&stimulus.numbers(expansion));
            assert_eq!(found, stimulus.answer(expansion), "{}: {expansion:?}", name(&engine));
        }
    }
}

/// The thresholds are there: a step of the grid changes the answer.
#[test]
fn some_answers_hang_on_one_step() {
    let format = format(&EngineParams::default());
    let stimulus = VolumeStimulus::random(&format, 300, 3);
    let apart = |expansion: &Expansion| {
        let all = Expansion { take: [[true; 2]; 2], ..expansion.clone() };
        stimulus.answer(&all) & 1 == 0
    };
    let flips = stimulus.expansions.windows(2).filter(|pair| {
        let [x, y] = pair else { return false };
        let one_step = |i: usize| (stimulus.frames[x.frame].shift[i] - stimulus.frames[y.frame].shift[i]).abs() == 1;
        x.blocks == y.blocks && (0..3).any(one_step) && apart(x) != apart(y)
    });
    assert!(flips.count() >= 20);
}

/// The table of docs/engine-volume.md: the proven ranges give the formats.
#[test]
fn ranges_give_the_formats_of_the_table() {
    for engine in engines() {
        let format = format(&engine);
        let unit = volume_path::unit(&format, engine.expansion_clocks as usize);
        let widths = format.widths();
        let bits =
            |signal: &str| unit.nodes.iter().find(|n| n.name() == signal).unwrap_or_else(|| panic!("{signal}")).ty.bits;
        let expected = [("d0", widths.distance), ("bound6", widths.base), ("u0", widths.upper), ("v0_0", widths.code)];
        for (signal, width) in expected.into_iter().filter(|(signal, _)| *signal != "bound6" || format.k() > 6) {
            assert_eq!(bits(signal), width.bits(), "{}: {signal}", name(&engine));
        }
        // The sum has room for what makes a ceiling of a floor.
        assert!((widths.sum.bits()..=widths.sum.bits() + 1).contains(&bits("s0")), "{}", name(&engine));
    }
    let format = format(&EngineParams::default());
    let unit = volume_path::unit(&format, 4);
    let bits =
        |signal: &str| unit.nodes.iter().find(|n| n.name() == signal).unwrap_or_else(|| panic!("{signal}")).ty.bits;
    assert_eq!(["d0", "bound6", "s0", "u0", "v0_0"].map(bits), [26, 28, 24, 28, 25]);
}

/// Clock by clock: with gaps and without, every answer is there after the latency and no other is. For the default device
/// and for a faster clock of another one, by which registers move.
#[test]
fn the_hardware_answers_as_the_reference_model() {
    let mut cases: Vec<(EngineParams, Params)> =
        share(4, engines()).into_iter().map(|engine| (engine, Params::default())).collect();
    let faster = Params { device: "lfe5u-85-6".to_owned(), frequency: 150, ..Params::default() };
    cases.extend([4, 1].map(|clocks| (engine(18, WIDTHS, clocks), faster.clone())));
    for (engine, params) in cases {
        let design = VolumeDesign::new(&engine, &params).unwrap();
        let stimulus = VolumeStimulus::random(&design.format, 200, 2);
        let mut unit = Clocked::new(&design.stage);
        let mut due: Vec<(usize, u32)> = vec![];
        let (mut next, mut clock, mut accepted, mut offered) = (0, 0, None, false);
        let (mut random, mut fastest) = (0xace1u16, usize::MAX);
        while next < stimulus.expansions.len() || !due.is_empty() {
            random = random << 1 | (random >> 15 ^ random >> 13 ^ random >> 12 ^ random >> 10) & 1;
            let full_speed = next < stimulus.expansions.len() / 2;
            if let Some(expansion) = stimulus.expansions.get(next)
                && !offered
                && (full_speed || random & 3 == 0)
            {
                for (name, value) in stimulus.numbers(expansion) {
                    unit.set(&name, value);
                }
                offered = true;
            }
            unit.set("in_valid", offered.into());
            unit.clock();
            let answer = (unit.get("out_valid") == 1).then(|| unit.get("out_survive") as u32);
            let expected = due.first().filter(|(at, _)| *at == clock).map(|due| due.1);
            assert_eq!(answer, expected, "{}: clock {clock}", name(&engine));
            due.retain(|(at, _)| *at > clock);
            if offered && unit.get("in_ready") == 1 {
                due.push((clock + design.latency, stimulus.answer(&stimulus.expansions[next])));
                if let Some(before) = accepted.replace(clock) {
                    fastest = fastest.min(clock - before);
                }
                (next, offered) = (next + 1, false);
            }
            clock += 1;
        }
        assert_eq!(fastest, design.interval, "{}", name(&engine));
        // After a reset there is no answer to what was in flight.
        unit.set("in_valid", 1);
        (0..2 * design.interval).for_each(|_| unit.clock());
        unit.set("in_valid", 0);
        unit.reset(1);
        for _ in 0..2 * design.latency {
            unit.clock();
            assert_eq!(unit.get("out_valid"), 0, "{}", name(&engine));
        }
    }
}

/// Runs the printed VHDL under its testbench; the last line that it prints.
fn simulated(
    design: &VolumeDesign,
    stimulus: &VolumeStimulus,
    change: impl Fn(&str, String) -> String,
) -> Option<String> {
    let ghdl = Ghdl::new(ghdl()?);
    let prefix = Prefix::default();
    let mut files = volume_files(design, &prefix).unwrap();
    files.push((format!("{BENCH}.vhd"), volume_bench(design, &prefix)));
    let names: Vec<String> = files.iter().map(|(name, _)| name.clone()).collect();
    let texts: Vec<(&str, &str)> = files[..files.len() - 1].iter().map(|(name, text)| (&name[..], &text[..])).collect();
    assert_eq!(lint(&texts), []);
    for (name, text) in files {
        ghdl.write(&name, &change(&name, text));
    }
    ghdl.write(&format!("{BENCH}.vec"), &stimulus.text(design));
    ghdl.analyse(&names);
    let half = format!("-gfull_speed={}", stimulus.expansions.len() / 2);
    let (succeeds, text) = ghdl.run(BENCH, &[&half]);
    let count = text.lines().find(|line| line.ends_with(" mismatches")).expect("the bench counts").to_owned();
    // Its status tells too.
    assert_eq!(succeeds, count.ends_with(" 0 mismatches"), "{text}");
    Some(count)
}

#[test]
fn the_printed_vhdl_answers_as_the_reference_model() {
    for engine in share(4, engines()) {
        let design = VolumeDesign::new(&engine, &Params::default()).unwrap();
        let stimulus = VolumeStimulus::random(&design.format, 150, 4);
        let Some(line) = simulated(&design, &stimulus, |_, text| text) else { return };
        let expected = format!("{BENCH}: {} expansions, 0 mismatches", stimulus.expansions.len());
        assert_eq!(line, expected, "{}", name(&engine));
    }
}

/// The test notices mistakes in the text.
#[test]
#[ignore = "mistakes in the text, each compiled: scripts/test full"]
fn mistakes_in_the_text_are_noticed() {
    let design = VolumeDesign::new(&EngineParams::default(), &Params::default()).unwrap();
    let stimulus = VolumeStimulus::random(&design.format, 150, 5);
    let mistakes = [
        // A floor in place of the ceiling of U.
        ("volume_rows.vhd", "(2047, 1023, 511, 255, 127, 63, 31,", "(0, 0, 0, 0, 0, 0, 0,"),
        // The code of a direction in place of that of the opposite one.
        ("volume_tests.vhd", "a_code_h4(m)(1)", "a_code_h4(m)(0)"),
        // No rest.
        ("volume_row_sum.vhd", "resize(rest, 14) + ", ""),
        // The errors of the shift left out.
        ("volume_bounds.vhd", "resize(query_error_resized_h6(i), 27) + ", ""),
        // Apart where the volumes touch.
        ("volume_direction_test.vhd", "reach + resize(v(k), 29)", "reach + resize(v(k), 29) - 1"),
        // One child of B in place of the other.
        (&format!("{NAME}.vhd"), "stage_b_take(i) <= in_take_b(i)", "stage_b_take(i) <= in_take_b(1 - i)"),
        // A code one bit too low in the block.
        (
            &format!("{NAME}.vhd"),
            "in_block_b(10 * i + 341 downto 10 * i + 332)",
            "in_block_b(10 * i + 340 downto 10 * i + 331)",
        ),
    ];
    for (file, right, wrong) in mistakes {
        let change = |name: &str, text: String| {
            if name != file {
                return text;
            }
            assert!(text.contains(right), "{file}: no {right}");
            text.replacen(right, wrong, 1)
        };
        let Some(line) = simulated(&design, &stimulus, change) else { return };
        assert!(line.starts_with(BENCH) && !line.ends_with(" 0 mismatches"), "{file}: {wrong}: {line}");
    }
}
