//! The host side of a generated engine without Rust: `efsat tree query`, and the files in C and Python against the packing here.

mod in_c;

use crate::tools::program::{object, refuses, succeeds};
use crate::tools::{CHECKED, compiles_everywhere, has, run};
use efsat::collide::hierarchy::Directions;
use efsat::engine::artefact::EngineDesign;
use efsat::engine::format::EngineFormat;
use efsat::engine::model::{Model, Query, QueryRow, Side};
use efsat::engine::params::EngineParams;
use efsat::engine::params::Memory;
use efsat::engine::words::{Command as Order, EngineAnswer, EngineReport, QueryFlags, Reason};
use efsat::number::Upper;
use efsat::pair::{Input, Pose};
use efsat::params::{Params, Quantity};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use std::fmt::Write;
use std::fs;
use tempfile::TempDir;

const IN_C: &str = include_str!("engine_host/host.c");

const IN_PYTHON: &str = include_str!("engine_host/host.py");

/// The files of an engine in the folder `rtl` of one of their own, by its command line.
pub(crate) fn generated(design: &EngineDesign) -> TempDir {
    let home = tempfile::tempdir().unwrap();
    let command = design.command_line();
    succeeds(&home, &format!("{} --out rtl", command.strip_prefix("efsat ").unwrap()));
    home
}

/// A query of any numbers that its fields hold, in its pose inside the declared ranges.
fn random_query(rng: &mut ChaCha8Rng, format: &EngineFormat, unit: &Params) -> Query {
    let mut input = |quantity| {
        let [least, most] = unit.declared(quantity);
        Input { lo: rng.random_range(least..most), sticky: format.sticky && rng.random() }
    };
    let m = [(); 3].map(|()| [(); 3].map(|()| input(Quantity::Entry)));
    let pose = Pose { m, t: [(); 3].map(|()| input(Quantity::Translation)), bypass: false };
    let slots = format.directions.slots();
    let mut row = || QueryRow {
        terms: slots.map(|slot| (rng.random_range(0..slot.len() as u32), rng.random_range(0..1 << format.factor_bits))),
        rest: rng.random_range(0..1 << format.rest_bits()),
    };
    let rows = (0..format.rows()).map(|_| row()).collect();
    // Images at addresses that can be moved.
    let mut side = || Side {
        blocks_at: rng.random_range(0..1 << 31),
        triangles_at: rng.random_range(0..1 << 31),
        blocks: rng.random(),
        triangles: rng.random(),
    };
    Query {
        sides: [side(), side()],
        limit: rng.random(),
        first_contact: rng.random(),
        all_pairs: rng.random(),
        leaf_pairs: rng.random(),
        keep_caches: rng.random(),
        number: rng.random_range(0..1 << 24),
        errors: [(); 3].map(|()| rng.random_range(0..1 << 16)),
        pose,
        rows,
    }
}

fn random_report(rng: &mut ChaCha8Rng, answer: &EngineAnswer) -> EngineReport {
    let is = |verdict| u32::from(answer.verdict == verdict);
    EngineReport {
        reason: Reason::ALL[rng.random_range(0..Reason::ALL.len())],
        number: rng.random_range(0..1 << 24),
        clocks: rng.random(),
        expansions: rng.random(),
        tests: rng.random(),
        survivors: rng.random(),
        leaf_pairs: rng.random(),
        intersect: is(1),
        possibly_incorrect: is(2),
        blocks: rng.random(),
        triangles: rng.random(),
        words: rng.random(),
        memory_waits: rng.random(),
        queue_waits: rng.random(),
        stack: rng.random(),
    }
}

fn hex(words: &[u64]) -> String {
    words.iter().map(|word| format!("{word:016x}")).collect::<Vec<_>>().join(" ")
}

/// The line that asks for a query, and the lines that are due.
fn query_lines(query: &Query, format: &EngineFormat) -> [String; 2] {
    let words = query.words(format);
    let ten = |word: u64| word + (10 | 10 << 32);
    let orders = hex(&[format.order(Order::Stop, 0xabcdef), format.order(Order::Reset, 7)]);
    let due = format!("{}\n{}\n{orders}", hex(&words), hex(&[ten(words[1]), ten(words[2])]));
    [query_asked(query), due]
}

fn query_asked(query: &Query) -> String {
    let mut asked = "q".to_owned();
    let mut put = |x: i64| write!(asked, " {x}").unwrap();
    for side in query.sides {
        [side.blocks_at, side.triangles_at, side.blocks, side.triangles].into_iter().for_each(|x| put(x.into()));
    }
    let flags = [query.first_contact, query.all_pairs, query.leaf_pairs, query.keep_caches];
    let flags: i64 = flags.into_iter().enumerate().map(|(i, flag)| i64::from(flag) << i).sum();
    [query.limit.into(), flags, query.number.into()].into_iter().for_each(&mut put);
    query.errors.into_iter().for_each(|error| put(error.into()));
    let pose: Vec<Input> = query.pose.m.into_iter().flatten().chain(query.pose.t).collect();
    put(pose.iter().enumerate().map(|(i, x)| i64::from(x.sticky) << i).sum());
    pose.iter().for_each(|x| put(x.lo));
    for row in &query.rows {
        row.terms.into_iter().flat_map(|(choice, factor)| [choice, factor]).for_each(|x| put(x.into()));
        put(row.rest.into());
    }
    asked
}

fn answer_lines(answer: &EngineAnswer, report: &EngineReport) -> [String; 2] {
    let halves: String =
        report.words().iter().map(|word| format!(" {} {}", word & u64::from(u32::MAX), word >> 32)).collect();
    let [a, b] = answer.triangles;
    let r = report;
    let due = format!(
        "{} {a} {b}\n{} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {}",
        answer.verdict,
        r.reason as u8,
        u8::from(r.reason.is_incomplete()),
        r.number,
        r.clocks,
        r.expansions,
        r.tests,
        r.survivors,
        r.leaf_pairs,
        r.intersect,
        r.possibly_incorrect,
        r.blocks[0],
        r.blocks[1],
        r.triangles[0],
        r.triangles[1],
        r.words,
        r.memory_waits,
        r.queue_waits,
        r.stack
    );
    [format!("a {}{halves}", answer.word() as i64), due]
}

/// The line that asks whether an answer is one to a query for pairs of 50 and 60 triangles, and what is due. By what `damage` says it
/// is damaged, in a way that can be recognised.
fn damaged_lines(rng: &mut ChaCha8Rng, damage: u32) -> [String; 2] {
    let (number, mut report) =
        (rng.random_range(0..1u64 << 24), random_report(rng, &EngineAnswer { verdict: 0, triangles: [0; 2] }));
    // Of half of the queries separate pairs are answered, too; then the report counts them among the leaf pairs.
    let all: bool = rng.random();
    let mut words = std::collections::BTreeMap::new();
    let count = rng.random_range(2..20);
    while words.len() < count {
        let triangles = [rng.random_range(0..50), rng.random_range(0..60)];
        words.insert(triangles, EngineAnswer { verdict: rng.random_range(if all { 0 } else { 1 }..3), triangles });
    }
    let mut pairs: Vec<u64> = words.values().map(EngineAnswer::word).collect();
    let count = |code| pairs.iter().filter(|word| **word & 3 == code).count() as u32;
    (report.intersect, report.possibly_incorrect) = (count(1), count(2));
    (report.reason, report.number, report.leaf_pairs) = (Reason::Complete, number as u32, pairs.len() as u32);
    let (at, other) = (rng.random_range(0..pairs.len() - 1), pairs.len() - 1);
    match damage {
        // A pair twice, in place of one of the same verdict.
        1 => pairs[at] = pairs[other] & !3 | pairs[at] & 3,
        2 => pairs[at] ^= 1 << rng.random_range(0..8),
        3 => _ = pairs.remove(at),
        4 => pairs.push(rng.random_range(0..50) << 8 | 49 << 36 | 1),
        5 => report.number ^= 1 << rng.random_range(0..24),
        6 => pairs[at] = pairs[at] & !(0xfff << 8) | rng.random_range(50..4096) << 8,
        7 => pairs[at] = pairs[at] & !(0xfff << 36) | rng.random_range(60..4096) << 36,
        8 => report.reason = Reason::Contact,
        9 => report.intersect ^= 1 << rng.random_range(0..32),
        _ => {}
    }
    pairs.extend(report.words());
    if damage == 10 {
        // The report itself: no report, a reason that there is not, *incomplete* without one.
        let head = pairs.len() - EngineReport::WORDS;
        pairs[head] ^= 1 << [0, 1, 6, 7][rng.random_range(0..4)];
    }
    let halves: String = pairs.iter().map(|word| format!(" {} {}", word & u64::from(u32::MAX), word >> 32)).collect();
    // In 63 bits, for programs that read signed numbers.
    let asked = (number << 40 | u64::from(all) << QueryFlags::ALL_PAIRS) as i64;
    let due = if damage == 0 { "taken" } else { "refused" };
    [format!("d {} {asked} {}{halves}", 50u64 | 60 << 32, pairs.len()), due.to_owned()]
}

/// A query with one field beyond its range, and what is due.
fn refused_lines(rng: &mut ChaCha8Rng, format: &EngineFormat, unit: &Params) -> [String; 2] {
    let mut query = random_query(rng, format, unit);
    let place = rng.random_range(0..12);
    let quantity = if place < 9 { Quantity::Entry } else { Quantity::Translation };
    let [least, end] = unit.declared(quantity);
    let number = query.pose.m.iter_mut().flatten().chain(&mut query.pose.t).nth(place).unwrap();
    let most = end - i64::from(number.sticky);
    number.lo = [least - 1, most + 1, most + (1 << 32), i64::MIN, i64::MAX][rng.random_range(0..5)];
    let due = format!("{} {place}: found {}; expected {least} to {most}", quantity.name(), number.lo);
    [query_asked(&query), due]
}

#[test]
fn files_in_c_and_python_pack_as_the_host_here_does() {
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    let sticky = Params { upper: Upper::Sticky, ..Params::default() };
    let corners = EngineParams { directions: Directions::TwentySix, offset_bits: 6, ..EngineParams::default() };
    let block_ram = EngineParams { memory: Memory::BlockRam, factor_bits: 10, ..EngineParams::default() };
    for (engine, unit) in
        [(EngineParams::default(), sticky), (corners, Params::default()), (block_ram, Params::default())]
    {
        let design = EngineDesign::new(&engine, &unit).unwrap();
        let (home, format) = (generated(&design), design.format);
        let (mut asked, mut due) = (String::new(), String::new());
        let mut add = |[line, lines]: [String; 2]| {
            asked += &(line + "\n");
            due += &(lines + "\n");
        };
        for _ in 0..40 {
            add(query_lines(&random_query(&mut rng, &format, &unit), &format));
            add(refused_lines(&mut rng, &format, &unit));
            let number = |rng: &mut ChaCha8Rng| rng.random_range(0..1 << 28);
            // A word of 63 bits, for programs that read signed numbers.
            let triangles = [number(&mut rng), number(&mut rng) >> 1];
            let answer = EngineAnswer { verdict: rng.random_range(0..3), triangles };
            add(answer_lines(&answer, &random_report(&mut rng, &answer)));
        }
        for round in 0..4_000 {
            add(damaged_lines(&mut rng, round % 11));
        }
        let host = home.path().join("rtl/host");
        let given = if format.sticky { "query.sticky = (uint32_t)next()" } else { "(void)next()" };
        fs::write(host.join("test.c"), IN_C.replace("STICKY", given)).unwrap();
        let said = if format.sticky { "True" } else { "False" };
        fs::write(host.join("test.py"), IN_PYTHON.replace("STICKY", said)).unwrap();
        fs::write(host.join("asked"), asked).unwrap();
        compiles_everywhere(&host.join("efsat_engine.h"));
        run(&host, "cc", &[CHECKED, &["-o", "test", "test.c"]].concat());
        let python = has("Python", "python3", "--version");
        for command in ["./test < asked", "python3 -B test.py < asked"].iter().take(if python { 2 } else { 1 }) {
            let found = run(&host, "sh", &["-c", command]);
            let differs = found.lines().zip(due.lines()).find(|(found, due)| found != due);
            assert_eq!(
                (differs, found.lines().count()),
                (None, due.lines().count()),
                "{command}: {}",
                design.command_line()
            );
        }
    }
}

/// What a host without Rust sends is answered by the model as `efsat tree count` counts it.
#[test]
fn queries_of_a_scene_are_written() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    let scene = "name = 's'\na.mesh = 'builtin:plate'\nb.mesh = 'builtin:plate'\n[[pose]]\ntranslation = [2.5, 1.75, 1]\n\
                 [[pose]]\ntranslation = [8, 8, 1]\n[[pose]]\ntranslation = [80, 0, 0]\n";
    fs::write(dir.join("s.toml"), scene).unwrap();
    let said = succeeds(dir, "tree query s.toml --out q.csv --image memory.bin");
    assert_eq!(said, "q.csv: 2 packets, and 0 without, for software\n");
    let bytes = fs::read(dir.join("memory.bin")).unwrap();
    let memory: Vec<u64> = bytes.chunks(8).map(|word| u64::from_le_bytes(word.try_into().unwrap())).collect();
    let packets = |name: &str| -> Vec<(String, Vec<u64>)> {
        let text = fs::read_to_string(dir.join(name)).unwrap();
        let row = |line: &str| {
            let (head, words) = line.rsplit_once(',').unwrap();
            (head.to_owned(), words.split(' ').map(|word| u64::from_str_radix(word, 16).unwrap()).collect())
        };
        assert!(text.starts_with("frame,a,b,number,words\n"));
        text.lines().skip(1).map(row).collect()
    };
    let engine = EngineParams::default();
    let model = Model::new(&engine, &engine.unit()).unwrap();
    let found = packets("q.csv");
    let heads: Vec<&str> = found.iter().map(|(head, _)| head.as_str()).collect();
    assert_eq!(heads, ["0,0,1,0", "1,0,1,1"]);
    let reports: Vec<EngineReport> = found.iter().map(|(_, words)| model.run(&memory, words).report).collect();
    let counts = object(dir, "tree count s.toml --json");
    assert_eq!(counts["queries"], 2);
    for (name, of) in [("tests", (|r| r.tests) as fn(&EngineReport) -> u32), ("intersect", |r| r.intersect)] {
        assert_eq!(counts[name], reports.iter().map(of).sum::<u32>(), "{name}");
    }
    // One frame; with block RAM what fills it comes first, here one mesh for both objects.
    let said = succeeds(dir, "tree query s.toml --out r.csv --frame 1 --memory block-ram --first-contact");
    assert_eq!(said, "r.csv: 1 packet, and 0 without, for software\n");
    let heads: Vec<String> = packets("r.csv").into_iter().map(|(head, _)| head).collect();
    assert_eq!(heads, ["load,,,", "load,,,", "1,0,1,0"]);
    for (options, part) in [
        ("s.toml --frame 3", "--frame 3: expected a number below 3"),
        ("s.toml --image x.csv", "found twice; expected two different files"),
        ("s.toml --image y --memory block-ram", "--image with --memory block-ram: expected --memory axi"),
        (
            "headlight --memory block-ram",
            "--block-lines 1024: expected at least 5961, which the meshes take in block RAM",
        ),
    ] {
        refuses(dir, &format!("tree query {options} --out x.csv"), part);
        assert!(!dir.join("x.csv").exists(), "{options}");
    }
}
