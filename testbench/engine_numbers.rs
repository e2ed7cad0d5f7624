//! The engine that takes pairs by number, in GHDL and in Verilator, against its reference model: answers in order, every end of a packet,
//! memory with latencies, gaps and faults, soft resets, and a pair per clock.

use crate::engine_host::generated;
use crate::engine_rtl::{Bench, axi, fine, number, small};
use crate::extent::{full, in_full, share};
use crate::tools::{CHECKED, compiles_everywhere, ghdl_of_long_runs, has, made, run};
use efsat::artefact::Prefix;
use efsat::design::Design;
use efsat::engine::artefact::samples::{cuboid, hills, turn};
use efsat::engine::artefact::vectors::EngineVectors;
use efsat::engine::artefact::{EngineDesign, engine_files};
use efsat::engine::format::EngineFormat;
use efsat::engine::host::{Image, Images, Numbers, memory};
use efsat::engine::model::{ByNumber, Model, Side};
use efsat::engine::params::{EngineParams, Memory};
use efsat::engine::words::{Command, EngineAnswer, EngineReport, Reason};
use efsat::evidence::cosim::engine::{Channel, Machine, Packet, Step};
use efsat::pair::{Input, Pose};
use efsat::params::options::Choice;
use efsat::params::{Guard, Method, Params, Quantity, Transform, Truth, Upper};
use efsat::scene::Scene;
use efsat_hardware::tools::Tool;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use rayon::prelude::*;
use std::collections::HashSet;

fn determinants() -> Params {
    Params { clocks_per_pair: 1, frequency: Params::default().frequency, ..small() }
}

/// The triangles of both meshes and some more.
fn block_ram() -> EngineParams {
    EngineParams { memory: Memory::BlockRam, triangle_lines: 128, ..EngineParams::default() }
}

fn design(engine: &EngineParams, unit: &Params) -> EngineDesign {
    EngineDesign::by_number(engine, unit).unwrap()
}

/// A field of hills and a box that cross, all pairs of them, a row of hills after the other.
struct Crossing {
    images: Vec<Image>,
    packet: ByNumber,
}

impl Crossing {
    fn new(design: &EngineDesign) -> Self {
        let numbers = Numbers::new(&design.params, &design.unit.params).unwrap();
        let images = Image::build(&[&hills(6), &cuboid(3, 4, 2)], &design.format).unwrap();
        let (_, sides) = memory(&images.iter().collect::<Vec<_>>());
        let query = numbers.query([(&images[0], sides[0]), (&images[1], sides[1])], &turn(2), &[2.5, 1.0, -1.0]);
        let pairs = (0..72).flat_map(|a| (0..12).map(move |b| [a, b])).collect();
        Self { packet: ByNumber::of_query(&query.unwrap(), pairs), images }
    }

    /// An engine, and they in its formats.
    fn bench(ghdl: &'static Tool, engine: &EngineParams, unit: &Params) -> (Bench, Self) {
        let bench = Bench::of(ghdl, design(engine, unit));
        let crossing = Self::new(&bench.design);
        (bench, crossing)
    }

    fn vectors<'a>(&self, design: &'a EngineDesign) -> EngineVectors<'a> {
        EngineVectors::new(design, &self.images.iter().collect::<Vec<_>>())
    }

    /// Some of the pairs, with the caches of the packet before.
    fn some(&self, number: u32, from: usize, count: usize) -> ByNumber {
        let pairs = self.packet.pairs[from..][..count].to_vec();
        ByNumber { number, pairs, all_pairs: true, keep_caches: true, ..self.packet.clone() }
    }

    fn triangle(&self, side: usize, number: u32) -> u32 {
        self.packet.sides[side].triangles_at + number
    }
}

#[test]
fn answers_equal_the_reference_models_in_order() {
    let Some(ghdl) = ghdl_of_long_runs() else { return };
    let least = "-glatency_least=1";
    let most = "-glatency_most=200";
    let memory = |memory_width| EngineParams { memory_width, ..axi() };
    let slow = Params { clocks_per_pair: 3, guard: Guard::Always, transform_width: 28, ..determinants() };
    let exact = Params { method: Method::Exact, truth: Truth::Snapped, transform_width: 26, ..Params::default() };
    let cases: [(EngineParams, Params, &[&str]); 7] = [
        (block_ram(), determinants(), if full() { &["-gpasses=3"] } else { &["-gpasses=1"] }),
        (axi(), small(), &[least, "-glatency_most=1"]),
        (axi(), determinants(), &["-glatency_least=5", most, "-gseed=7", "-gpasses=3"]),
        (memory(128), Params { upper: Upper::Sticky, width: 10, transform_width: 26, ..Params::default() }, &[]),
        (memory(32), slow, &["-glatency_least=3", "-glatency_most=9"]),
        (EngineParams { axi_id_bits: 0, triangle_lines: 256, ..memory(512) }, determinants(), &[least, most]),
        (block_ram(), exact, &["-gpasses=1"]),
    ];
    let wrong: Vec<String> = share(7, cases)
        .par_iter()
        .filter_map(|(engine, unit, options)| {
            let bench = Bench::of(ghdl, design(engine, unit));
            let report = bench.run(options);
            (!fine(&report)).then(|| format!("{} {options:?}:\n{report}", bench.design.command_line()))
        })
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// A fault of memory ends the packet whose pairs it was asked for, behind the first of its answers; the packet before, whose pairs are
/// in the unit, and the packet behind are whole. A memory that is silent ends packets until it answers.
#[test]
#[ignore = "compiles an engine; faults of memory end queries on every change: scripts/test full"]
fn a_fault_of_memory_ends_one_packet() {
    let Some(ghdl) = ghdl_of_long_runs() else { return };
    let (bench, crossing) = Crossing::bench(ghdl, &EngineParams { watchdog: 500, ..axi() }, &determinants());
    let passes = if full() { "-gpasses=2" } else { "-gpasses=1" };
    let options = [passes, "-glatency_least=2", "-glatency_most=40", "-ghang=2500"];
    // Triangles of A that the packet asks for first, in its midst, last; and one of B.
    let faults =
        [crossing.triangle(0, 20), crossing.triangle(0, 25), crossing.triangle(0, 29), crossing.triangle(1, 3)];
    let text = |at: u32, kind: u8| {
        let mut vectors = crossing.vectors(&bench.design);
        vectors.fault(at, kind);
        // The box is read by the packet before, but not its fourth triangle.
        vectors.numbers(&crossing.some(1, 0, 3));
        vectors.numbers_that_end(&crossing.some(2, 240, 120), Reason::Memory);
        vectors.numbers(&crossing.some(3, 240, 120));
        vectors.numbers(&ByNumber { number: 4, ..crossing.packet.clone() });
        vectors.text().to_owned()
    };
    for (at, kind) in share(4, faults.into_iter().zip([1, 2, 3, 1])) {
        bench.passes(&text(at, kind), &options);
    }

    let late = |number: u32| {
        let mut vectors = crossing.vectors(&bench.design);
        vectors.fault(crossing.triangle(0, number), 4);
        vectors.numbers(&crossing.some(1, 0, 3));
        vectors.numbers_that_end(&crossing.some(2, 240, 120), Reason::Silent);
        vectors.numbers_that_end(&crossing.some(3, 240, 1), Reason::Silent);
        vectors.numbers(&crossing.some(4, 0, 0));
        vectors.wait();
        vectors.reset(3, Some(5));
        vectors.numbers_that_end(&crossing.some(6, 0, 9), Reason::Silent);
        vectors.wait();
        vectors.pause(3000);
        vectors.numbers(&ByNumber { number: 7, ..crossing.packet.clone() });
        vectors.text().to_owned()
    };
    let once = ["-gpasses=1", "-glatency_least=5", "-glatency_most=40", "-ghang=2500"];
    for number in in_full([20, 27]) {
        bench.passes(&late(number), &once);
    }

    let first = text(crossing.triangle(0, 25), 1);
    let file = "engine_number_command.vhd";
    let changes = [
        // Memory that fails is not noticed, or not that it is silent; what it was asked for is not forgotten.
        (file, "fails <= (memory_error or memory_silent)", "fails <= memory_silent"),
        (file, "fails <= (memory_error or memory_silent)", "fails <= memory_error"),
        (file, "restart_now <= '1';", "restart_now <= '0';"),
        (file, "waiting <= (others => '0');\n        if closing", "if closing"),
        // The packet that closes has its own reason, and so has the packet that is taken.
        (
            file,
            "if closing = '1' then\n          closing_reason <= reason_silent;",
            "if closing = '0' then\n          closing_reason <= reason_silent;",
        ),
    ];
    let options = [&once[..], &["-gpatience=4500"]].concat();
    bench.notices(in_full(changes), &[&first, &late(27)], &options);
}

/// Pairs that wait in front of a unit of several clocks per pair do not go on behind a fault, in the clock before memory forgets them: the
/// unit would take one in that clock with one latency out of some.
#[test]
#[ignore = "compiles an engine: scripts/test full"]
fn no_pair_goes_on_behind_a_fault() {
    let Some(ghdl) = ghdl_of_long_runs() else { return };
    let (bench, crossing) = Crossing::bench(ghdl, &axi(), &small());
    let mut vectors = crossing.vectors(&bench.design);
    vectors.fault(crossing.triangle(0, 21), 1);
    vectors.numbers_that_end(&crossing.some(1, 240, 120), Reason::Memory);
    vectors.numbers(&crossing.some(2, 240, 120));
    let options: Vec<[String; 3]> = (1..=11)
        .map(|clocks| ["-gpasses=1".into(), format!("-glatency_least={clocks}"), format!("-glatency_most={clocks}")])
        .collect();
    let fine_with = |bench: &Bench, options: &[String; 3]| {
        fine(&bench.run_vectors(vectors.text(), &options.each_ref().map(String::as_str)))
    };
    for options in &options {
        bench.passes(vectors.text(), &options.each_ref().map(String::as_str));
    }
    for with in ["triangles_there;", "triangles_there and not memory_silent;"] {
        let changed = bench.with(("efsat_engine.vhd", "triangles_there and not failing;", with));
        assert!(!options.iter().all(|options| fine_with(&changed, options)), "{with}");
    }
}

/// A mesh is written over at its old address: a packet without the option to keep the caches is about what is there now.
#[test]
fn triangles_that_were_written_over_are_read_again() {
    let Some(ghdl) = ghdl_of_long_runs() else { return };
    let (bench, crossing) = Crossing::bench(ghdl, &axi(), &small());
    let other = Image::build(&[&cuboid(4, 1, 1)], &bench.design.format).unwrap();
    let (words, side) = memory(&[&other[0]]);
    let mut vectors = crossing.vectors(&bench.design);
    vectors.numbers(&crossing.some(1, 0, 60));
    let at = 8 * crossing.triangle(1, 0) as usize;
    for (i, word) in words[8 * side[0].triangles_at as usize..].iter().enumerate() {
        vectors.rewrite(at + i, *word);
    }
    vectors.numbers(&ByNumber { keep_caches: false, ..crossing.some(2, 0, 60) });
    vectors.numbers(&crossing.some(3, 0, 60));
    let options = ["-gpasses=1", "-glatency_least=5", "-glatency_most=20"];
    bench.passes(vectors.text(), &options);
    let change = ("engine_number_command.vhd", "flush_now <= '1';", "flush_now <= '0';");
    bench.notices(in_full([change]), &[vectors.text()], &options);
}

/// Mistakes in the text, each of which the generated vectors notice.
#[test]
#[ignore = "compiles an engine: scripts/test full"]
fn a_wrong_entity_is_noticed() {
    let Some(ghdl) = ghdl_of_long_runs() else { return };
    let (command, answer, top) = ("engine_number_command.vhd", "engine_number_answer.vhd", "efsat_engine.vhd");
    let changes = [
        // Numbers that are not there, of one side; the pose of the packet behind.
        (
            command,
            "unsigned(s_axis_tdata(63 downto 32)) < counts(1)",
            "unsigned(s_axis_tdata(63 downto 32)) <= counts(1)",
        ),
        (command, "unsigned(s_axis_tdata(31 downto 0)) < counts(0)", "unsigned(s_axis_tdata(30 downto 0)) < counts(0)"),
        (command, "checked <= not closing when", "checked <= '1' when"),
        // What is wrong with a head is not looked at.
        (command, "and s_axis_tdata(option_leaves) = '0'", ""),
        (command, "if place /= 0 and unfit = '1' then", "if place = 1 and unfit = '1' then"),
        (command, "> 67108864 then", "> 67108900 then"),
        (command, "if head_whole = '0' then", "if head_whole = '0' and expectation /= pair_state then"),
        // A report comes before the last pairs have gone to the unit, or with the number of the packet behind.
        (command, "reports <= closing and none_wait;", "reports <= closing;"),
        (command, "closing_number <= options(option_number);", "closing_number <= head(option_number);"),
        (command, "separate_now <= options(option_separate);", "separate_now <= '0';"),
        // What was before a soft reset is not forgotten.
        (
            command,
            "expectation <= skip_state;\n        end if;\n        fault <= fine;",
            "end if;\n        fault <= fine;",
        ),
        (top, "clears <= reset or forget;", "clears <= reset;"),
        // Answers of the packet behind come before a report; one, or a report, is lost when the host is slow.
        (answer, "std_logic_vector(taken_count) = head(mark_field)", "tested_valid = '0'"),
        (answer, "free <= m_axis_tready or not offered;", "free <= '1';"),
        (
            answer,
            "full <= '1' when report_in(2 downto 0) = report_out(2 downto 0) and",
            "full <= '0' when report_in(2 downto 0) = report_out(2 downto 0) and",
        ),
        // Lines of A and of B are exchanged; the memory drains nothing.
        (top, "request_b <= \"00\" & line_b;", "request_b <= \"00\" & line_a;"),
        (top, "restart => forgets,", "restart => reset,"),
    ];
    let bench = Bench::of(ghdl, design(&axi(), &determinants()));
    let text = bench.files.get("efsat_engine_tb.vec").unwrap().to_owned();
    let options = ["-glatency_least=5", "-glatency_most=60", "-gfirst_pass=2"];
    bench.notices(changes, &[&text], &options);

    // What few runs meet: a soft reset while a word waits for the host or a pair goes to the unit.
    let rare = [
        (command, "if (clears or reset_now) = '1' then\n        waiting", "if clears = '1' then\n        waiting"),
        (answer, "offered <= offered and not free;", "offered <= '0';"),
    ];
    bench.notices(rare, &[&text], &[&options[..], &["-gpasses=6"]].concat());
}

/// With a unit that takes a pair per clock a packet of N pairs takes N clocks and some: out of block RAM, and of caches that hold the
/// triangles.
#[test]
#[ignore = "compiles a wide unit: scripts/test full"]
fn a_pair_per_clock() {
    let Some(ghdl) = ghdl_of_long_runs() else { return };
    for engine in [block_ram(), EngineParams { triangle_lines: 256, ..axi() }] {
        let (bench, crossing) = Crossing::bench(ghdl, &engine, &determinants());
        let clocks = |packets: u32| {
            let mut vectors = crossing.vectors(&bench.design);
            for number in 0..packets {
                let pairs = crossing.packet.pairs.clone();
                vectors.numbers(&ByNumber { number, pairs, keep_caches: true, ..crossing.packet.clone() });
            }
            let report = bench.passes(vectors.text(), &["-gpasses=1"]);
            number(&report, "total").unwrap()
        };
        // The head of a packet, the way from the stream to the unit, and the pose.
        let more = clocks(4) - clocks(3) - crossing.packet.pairs.len();
        assert!(more <= 10 + 12, "{more} clocks more than pairs");
    }
}

/// The engine is reset at every clock of two packets, while memory goes on, by the stream and by the port, also between the words of a
/// packet: one report with reason 10, and the packet behind is right.
#[test]
#[ignore = "compiles an engine: scripts/test full"]
fn every_packet_after_a_reset_is_right() {
    let engine = EngineParams { triangle_lines: 16, ..EngineParams::default() };
    let design = design(&engine, &determinants());
    let crossing = Crossing::new(&design);
    let (memory, _) = memory(&crossing.images.iter().collect::<Vec<_>>());
    let model = Model::new(&design.params, &design.unit.params).unwrap();
    let files = engine_files(&design, &Prefix::default(), "efsat generate --engine").unwrap();
    let Some(machine) = made(Machine::of(design, &files, None)) else { return };
    let format = machine.design().format;
    let words = |number: u32, from: usize, count: usize| crossing.some(number, from, count).words(&format);
    let due = |words: &[u64]| {
        let outcome = model.run_numbers(&memory, words);
        (outcome.answers, outcome.report)
    };
    let read = |packet: &Packet| {
        let (pairs, report) = packet.words.split_last_chunk::<{ EngineReport::WORDS }>().unwrap();
        let report = EngineReport::of(report).unwrap();
        (pairs.to_vec(), EngineReport { triangles: [0; 2], words: 0, ..report })
    };
    let is = |packet: &Packet, asked: &[u64]| {
        let (answers, report) = due(asked);
        read(packet) == (answers.iter().map(EngineAnswer::word).collect(), report)
    };
    let [first, second, last] = [words(1, 0, 40), words(2, 300, 5), words(3, 96, 30)];
    for (latency, most) in [(1, usize::MAX), (30, usize::MAX), (160, usize::MAX), (1200, 100)] {
        let channel = Channel { latency: latency..=latency, patience: 400_000, ..Channel::default() };
        let both = [Step::Packet(first.clone()), Step::Packet(second.clone())];
        let answers = machine.play(&memory, &both, &channel).unwrap();
        assert!(is(&answers[0], &first) && is(&answers[1], &second), "{answers:?}");
        let clocks = answers[1].clock as usize + 20;
        let stride = clocks.div_ceil(most);
        let resets = clocks.div_ceil(stride);
        let mut steps = vec![both[0].clone()];
        // From the last word of the first packet on, those of the second one among them.
        steps.extend((0..resets).flat_map(|i| {
            let mut apart = match i % 3 {
                0 => vec![both[1].clone(), Step::SoftReset],
                1 => vec![Step::Packet(vec![format.order(Command::Reset, i as u32)])],
                _ => {
                    let (begun, rest) = second.split_at(1 + i / 3 % (second.len() - 1));
                    vec![Step::Begin(begun.to_vec()), Step::SoftReset, Step::Packet(rest.to_vec())]
                }
            };
            apart.extend([Step::Packet(last.clone()), Step::Wait]);
            [Some(Step::Apart(apart)), (stride > 1).then(|| Step::Pause(stride as u32 - 2))].into_iter().flatten()
        }));
        let answers = machine.play(&memory, &steps, &channel).unwrap();
        let mut answers = answers.iter().peekable();
        for i in 0..resets {
            let at = format!("latency {latency}, reset {i} of {resets}");
            while let Some(whole) = answers.next_if(|packet| read(packet).1.reason != Reason::Reset) {
                assert!(is(whole, &first) || is(whole, &second), "{at}: {whole:?}");
            }
            let (_, report) = read(answers.next().expect(&at));
            assert_eq!(report.number, if i % 3 == 1 { i as u32 } else { 0 }, "{at}");
            assert!(answers.next().is_some_and(|packet| is(packet, &last)), "{at}");
        }
        assert!(answers.all(|whole| is(whole, &first)), "latency {latency}");
    }
}

/// Lines of a memory of moved triangles, of which there may be none.
const LINES: [usize; 3] = [16, 64, 256];
/// Pairs that a stage in front of the unit looks ahead.
const AHEAD: usize = 16;

/// Clocks of the leaf pairs of a query, one of which may begin in each clock, behind a stage that moves a triangle of B in `clocks` and
/// keeps it in one of `lines`; and how many triangles it moves.
fn moved(pairs: &[[u32; 2]], lines: usize, clocks: usize) -> [usize; 2] {
    let mut held: Vec<Option<(u32, usize)>> = vec![None; lines];
    let (mut enters, mut leaves): (Vec<usize>, Vec<usize>) = (vec![], vec![]);
    let (mut free, mut moves) = (0, 0);
    for (i, &[_, b]) in pairs.iter().enumerate() {
        let behind = enters.last().map_or(0, |last| last + 1);
        let enter = if i >= AHEAD { behind.max(leaves[i - AHEAD]) } else { behind };
        let line = &mut held[b as usize % lines];
        let ready = match *line {
            Some((number, ready)) if number == b => ready,
            _ => {
                free = free.max(enter) + clocks;
                moves += 1;
                *line = Some((b, free));
                free
            }
        };
        enters.push(enter);
        leaves.push(ready.max(leaves.last().map_or(0, |last| last + 1)));
    }
    [leaves.last().map_or(0, |last| last + 1), moves]
}

/// How often a triangle of B is met again in a query of the default scene, and what a stage that moves each once would save; the table
/// is printed with `--nocapture`.
#[test]
#[ignore = "runs all queries of the default scene: scripts/test full"]
fn a_triangle_of_b_is_met_again() {
    let (engine, unit) = (EngineParams::default(), Params { method: Method::Determinants, ..Params::default() });
    let numbers = Numbers::new(&engine, &unit).unwrap();
    let scene = Scene::default_scene();
    let images = Images::new(&scene.meshes().0, numbers).unwrap();
    let (words, sides) = memory(&images.all());
    let model = Model::new(&engine, &unit).unwrap();
    let near = scene.near();
    let queries: Vec<Vec<[u32; 2]>> = (0..scene.frames())
        .into_par_iter()
        .flat_map_iter(|frame| near.meetings(frame))
        .filter_map(|meeting| images.query(meeting.meshes, &meeting.pose, &sides).ok())
        .map(|query| model.visits(&words, &query.words(model.format())).1.numbers)
        .collect();
    let pairs: usize = queries.iter().map(Vec::len).sum();
    let once: usize = queries.iter().map(|pairs| pairs.iter().map(|pair| pair[1]).collect::<HashSet<_>>().len()).sum();
    println!(
        "{} queries, {pairs} leaf pairs, {once} triangles of B: each is met {:.2} times",
        queries.len(),
        pairs as f64 / once as f64
    );

    let multipliers = |transform| Design::new(&Params { transform, ..unit.clone() }, false).unwrap().top.multipliers();
    let [with, without] = [Transform::On, Transform::Off].map(multipliers);
    println!("a unit of a pair per clock: {with} multipliers, without the transform {without}");
    let mut best = f64::INFINITY;
    for lines in LINES {
        for clocks in [1, 2, 3, 4] {
            let sum = |i: usize| queries.iter().map(|pairs| moved(pairs, lines, clocks)[i]).sum::<usize>();
            let stage = (with - without).div_ceil(clocks);
            let [all, slower] = [(without + stage) as f64 / with as f64, sum(0) as f64 / pairs as f64];
            println!(
                "{lines:>4} lines, a triangle in {clocks}: {:>4} multipliers ({all:.2} of now), {} moved, clocks x {slower:.3}",
                without + stage,
                sum(1),
            );
            if slower < 1.02 {
                best = best.min(all);
            }
        }
    }
    assert!((1.0..20.0).contains(&(pairs as f64 / once as f64)) && best <= 1.0, "{best}");
}

/// A packet of any numbers that its fields hold, of objects of 50 and 60 triangles.
fn random_packet(rng: &mut ChaCha8Rng, format: &EngineFormat, unit: &Params) -> ByNumber {
    let mut input = |quantity| {
        let [least, most] = unit.declared(quantity);
        Input { lo: rng.random_range(least..most), sticky: format.sticky && rng.random() }
    };
    let m = [(); 3].map(|()| [(); 3].map(|()| input(Quantity::Entry)));
    let mut pose = Pose { m, t: [(); 3].map(|()| input(Quantity::Translation)), bypass: false };
    if rng.random_range(0..4) == 0 {
        let zero = Input { lo: 0, sticky: false };
        pose = Pose { m: [[zero; 3]; 3], t: [zero; 3], bypass: true };
    }
    let mut side = |triangles| Side { triangles_at: rng.random_range(0..1 << 26), triangles, ..Side::default() };
    let sides = [side(50), side(60)];
    let pairs = (0..rng.random_range(2..9)).map(|_| [rng.random_range(0..50), rng.random_range(0..60)]).collect();
    let number = rng.random_range(0..1 << 24);
    ByNumber { sides, all_pairs: rng.random(), keep_caches: rng.random(), number, pose, pairs }
}

/// The answer to a packet, whose faces are the places counted from the last one, and whether it is to be taken: it is damaged, or not.
fn random_answer(rng: &mut ChaCha8Rng, packet: &ByNumber) -> (Vec<u64>, bool) {
    let mut report = EngineReport { number: packet.number, ..EngineReport::default() };
    report.leaf_pairs = packet.pairs.len() as u32;
    let mut words = vec![];
    for &[a, b] in &packet.pairs {
        let verdict = rng.random_range(0..3);
        report.intersect += u32::from(verdict == 1);
        report.possibly_incorrect += u32::from(verdict == 2);
        if verdict > 0 || packet.all_pairs {
            words.push(EngineAnswer { verdict, triangles: [49 - a, 59 - b] }.word());
        }
    }
    let damage = rng.random_range(0..6);
    let fine = match damage {
        1 => {
            report.number ^= 1;
            false
        }
        2 => {
            report.leaf_pairs += 1;
            false
        }
        3 => words.pop().is_none(),
        4 => words.first_mut().map(|word| *word ^= 1 << 50).is_none(),
        5 => words.last().copied().map(|word| words.push(word)).is_none(),
        _ => true,
    };
    words.extend(report.words());
    (words, fine)
}

/// The files in C and in Python pack and refuse as the host here does.
#[test]
fn files_in_c_and_python_name_pairs() {
    let mut rng = ChaCha8Rng::seed_from_u64(9);
    for unit in [Params::default(), Params { upper: Upper::Sticky, ..Params::default() }] {
        let format = EngineParams::default().format(&unit).unwrap();
        let upper = unit.upper.name();
        let home = generated(&design(&EngineParams::default(), &unit));
        let (mut c, mut python, mut due) = (String::new(), String::new(), String::new());
        for _ in 0..40 {
            let packet = random_packet(&mut rng, &format, &unit);
            let words = packet.words(&format);
            let (answer, fine) = random_answer(&mut rng, &packet);
            let hex = |words: &[u64]| words.iter().map(|word| format!("{word:016x}")).collect::<Vec<_>>().join(" ");
            due += &format!("{}\n{}\n", hex(&words), if fine { "taken" } else { "refused" });
            let flags = u32::from(packet.all_pairs) << 1 | u32::from(packet.keep_caches) << 3;
            let numbers: Vec<Input> = packet.pose.m.into_iter().flatten().chain(packet.pose.t).collect();
            let sticky = numbers.iter().enumerate().map(|(i, x)| u32::from(x.sticky) << i).sum::<u32>();
            let pose = numbers.iter().map(|x| x.lo.to_string()).collect::<Vec<_>>().join(", ");
            let list = |list: &[u64]| list.iter().map(|word| format!("{word}u")).collect::<Vec<_>>().join(", ");
            let pairs = |open: char, close: char| {
                let pair = |[a, b]: &[u32; 2]| format!("{open}{a}, {b}{close}");
                packet.pairs.iter().map(pair).collect::<Vec<_>>().join(", ")
            };
            let [a, b] = packet.sides.map(|side| u64::from(side.triangles_at) * 64);
            let (bypass, number, count) = (packet.pose.bypass, packet.number, packet.pairs.len());
            let of_sticky = if format.sticky { format!(", {sticky}") } else { String::new() };
            c += &format!(
                "  {{\n    const struct efsat_engine_head head = {{{{{{{a}u, 50}}, {{{b}u, 60}}}}, {flags}, {}, \
                 {{{pose}}}{of_sticky}}};\n    const uint32_t pairs[][2] = {{{}}};\n    const uint64_t answer[] = \
                 {{{}}};\n    failed |= check(&head, {number}, pairs, {count}, answer, sizeof answer / 8);\n  }}\n",
                u8::from(bypass),
                pairs('{', '}'),
                list(&answer)
            );
            let of_pose = if bypass { "None".to_owned() } else { format!("[{pose}]") };
            let of_sticky = if format.sticky { format!(", sticky={sticky}") } else { String::new() };
            python += &format!(
                "check(e.pairs([e.Side({a}, 50), e.Side({b}, 60)], [{}], {of_pose}, {flags}, {number}{of_sticky}), [{}])\n",
                pairs('(', ')'),
                list(&answer).replace('u', "")
            );
        }
        let host = home.path().join("rtl/host");
        std::fs::write(host.join("test.c"), IN_C.replace("CHECKS", &c)).unwrap();
        std::fs::write(host.join("test.py"), format!("{IN_PYTHON}{python}")).unwrap();
        compiles_everywhere(&host.join("efsat_engine.h"));
        run(&host, "cc", &[CHECKED, &["-o", "test", "test.c"]].concat());
        let python = has("Python", "python3", "--version");
        for command in ["./test", "python3 -B test.py"].iter().take(if python { 2 } else { 1 }) {
            let found = run(&host, "sh", &["-c", command]);
            let differs = found.lines().zip(due.lines()).find(|(found, due)| found != due);
            assert_eq!((differs, found.lines().count()), (None, due.lines().count()), "{command}: {upper}");
        }
    }
}

const IN_C: &str = "#include \"efsat_engine.h\"
#include <inttypes.h>
#include <stdio.h>

static int check(const struct efsat_engine_head *head, uint32_t number, const uint32_t (*pairs)[2], size_t count, const uint64_t *answer, size_t words)
{
  static uint32_t places[2][60];
  const uint32_t *const faces[2] = {places[0], places[1]};
  uint64_t packet[64];
  struct efsat_engine_report report;
  for (uint32_t i = 0; i < 60; i++) {
    places[0][i] = 49 - i;
    places[1][i] = 59 - i;
  }
  if (efsat_engine_put_head(packet, head, &number, NULL))
    return 1;
  for (size_t i = 0; i < count; i++)
    if (efsat_engine_put_pair(packet + EFSAT_ENGINE_PAIRS_WORD + i, packet, pairs[i][0], pairs[i][1], NULL))
      return 1;
  if (!efsat_engine_put_pair(packet, packet, 50, 0, NULL) || !efsat_engine_put_pair(packet, packet, 0, 60, NULL))
    return 1;
  for (size_t i = 0; i < EFSAT_ENGINE_PAIRS_WORD + count; i++)
    printf(\"%s%016\" PRIx64, i ? \" \" : \"\", packet[i]);
  printf(\"\\n%s\\n\", efsat_engine_get_answer(&report, packet, count, faces, answer, words, NULL) ? \"refused\" : \"taken\");
  return 0;
}

int main(void)
{
  int failed = 0;
CHECKS  return failed;
}
";

const IN_PYTHON: &str = "import struct
import efsat_engine as e

def check(packet, words):
    print(' '.join(f'{word:016x}' for word in struct.unpack(f'<{len(packet) // 8}Q', packet)))
    try:
        e.answer(struct.pack(f'<{len(words)}Q', *words), packet, [range(49, -1, -1), range(59, -1, -1)])
        print('taken')
    except ValueError:
        print('refused')

";
