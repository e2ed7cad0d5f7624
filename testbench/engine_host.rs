//! The host side of a generated engine without Rust: `efsat tree query`, and the files in C and Python against the packing here.

use crate::drop_in::run;
use crate::tools::{CHECKED, compiles_everywhere};
use efsat::engine::format::EngineFormat;
use efsat::engine::model::{Model, Query, Row, Side};
use efsat::engine::params::{EngineParams, Memory};
use efsat::engine::words::{Answer, Command as Order, EngineReport, QueryFlags, Reason};
use efsat::golden::{Input, Pose};
use efsat::number::Upper;
use efsat::params::options::Choice;
use efsat::params::{Params, Quantity};
use efsat::scene::hierarchy::Directions;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use serde_json::Value;
use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::process::Command;

const IN_C: &str = r#"
#include "efsat_engine.h"
#include <inttypes.h>
#include <stdio.h>

static long long next(void)
{
  long long number = 0;
  if (scanf("%lld", &number) != 1)
    number = -1;
  return number;
}

static void print(const uint64_t *words, unsigned count)
{
  for (unsigned i = 0; i < count; i++)
    printf("%016" PRIx64 "%s", words[i], i + 1 < count ? " " : "\n");
}

int main(void)
{
  char kind;
  while (scanf(" %c", &kind) == 1) {
    if (kind == 'q') {
      struct efsat_engine_query query;
      uint64_t packet[EFSAT_ENGINE_QUERY_WORDS];
      for (unsigned i = 0; i < 2; i++) {
        query.sides[i].blocks_at = (uint64_t)next() * 64;
        query.sides[i].triangles_at = (uint64_t)next() * 64;
        query.sides[i].blocks = (uint32_t)next();
        query.sides[i].triangles = (uint32_t)next();
      }
      query.options.limit = (uint32_t)next();
      query.options.flags = (uint32_t)next();
      uint32_t number = (uint32_t)next();
      for (unsigned i = 0; i < 3; i++)
        query.errors[i] = (uint32_t)next();
      STICKY;
      for (unsigned i = 0; i < 12; i++)
        query.pose[i] = next();
      for (unsigned i = 0; i < EFSAT_ENGINE_DIRECTIONS; i++) {
        for (unsigned slot = 0; slot < 3; slot++) {
          query.rows[i].choice[slot] = (uint32_t)next();
          query.rows[i].factor[slot] = (uint32_t)next();
        }
        query.rows[i].rest = (uint32_t)next();
      }
      char text[EFSAT_ENGINE_EXPLANATION];
      struct efsat_engine_refusal why;
      const uint32_t own = number;
      if (efsat_engine_put_query(packet, &query, &number, &why)) {
        printf("%s\n", efsat_engine_explain(&why, text));
        continue;
      }
      print(packet, EFSAT_ENGINE_QUERY_WORDS);
      if (number != own + 1 || efsat_engine_move(packet, 640, &why))
        return 1;
      print(packet + 1, 2);
      if (!efsat_engine_move(packet, 63, &why) || !efsat_engine_move(packet, -(INT64_C(1) << 39), NULL))
        return 1;
      uint64_t orders[2] = {efsat_engine_stop(0xabcdef), efsat_engine_reset(7)};
      print(orders, 2);
    } else if (kind == 'd') {
      uint64_t packet[EFSAT_ENGINE_QUERY_WORDS] = {0}, words[64];
      packet[EFSAT_ENGINE_TRIANGLES_WORD] = (uint64_t)next();
      packet[EFSAT_ENGINE_OPTIONS_WORD] = (uint64_t)next();
      const size_t count = (size_t)next();
      struct efsat_engine_report report;
      for (size_t i = 0; i < count; i++) {
        uint64_t low = (uint64_t)next();
        words[i] = low | (uint64_t)next() << 32;
      }
      printf("%s\n", efsat_engine_get_answer(&report, packet, words, count, NULL) ? "refused" : "taken");
    } else {
      uint64_t words[EFSAT_ENGINE_REPORT_WORDS];
      struct efsat_engine_pair pair = efsat_engine_get_pair((uint64_t)next());
      printf("%u %" PRIu32 " %" PRIu32 "\n", pair.verdict, pair.a, pair.b);
      for (unsigned i = 0; i < EFSAT_ENGINE_REPORT_WORDS; i++) {
        uint64_t low = (uint64_t)next();
        words[i] = low | (uint64_t)next() << 32;
      }
      struct efsat_engine_report r = efsat_engine_get_report(words);
      printf("%u %u", r.reason, r.incomplete);
      const uint32_t counts[] = {r.number, r.clocks, r.expansions, r.tests, r.survivors, r.leaf_pairs, r.intersect,
        r.possibly_incorrect, r.blocks, r.blocks_read, r.triangles, r.triangles_read, r.words_read, r.memory_waits,
        r.queue_waits, r.stack};
      for (unsigned i = 0; i < sizeof counts / sizeof *counts; i++)
        printf(" %" PRIu32, counts[i]);
      printf("\n");
    }
  }
  return 0;
}
"#;

const IN_PYTHON: &str = r#"
import random
import sys
import efsat_engine as engine

# What is read is taken, or refused with a ValueError.
rng = random.Random(6)
report = engine.struct.pack("<8Q", engine.VERDICT_REPORT, 0, 0, 1, *range(4))
readers = [
    engine.asked,
    lambda data: engine.moved(data, 64),
    lambda data: engine.answer(data[:1] + engine.struct.pack("<8Q", engine.VERDICT_REPORT, *[0] * 7)[1:]),
    lambda data: engine.answer(data[:8] + report),
    lambda data: engine.packets(["head", data.decode("latin-1")]),
    lambda data: engine.packets(["head", "1,2," + " ".join(f"{byte:x}{rng.choice('0f -')}" * (byte % 20) for byte in data)]),
]
outcomes = [set() for _ in readers]
for _ in range(400):
    size = rng.choice([8 * engine.QUERY_WORDS, 8 * rng.randrange(20), rng.randrange(300)])
    data = bytes(rng.choice([0, 0, 1, 3, rng.randrange(256)]) for _ in range(size))
    for read, outcome in zip(readers, outcomes):
        try:
            read(data)
            outcome.add("taken")
        except ValueError:
            outcome.add("refused")
assert outcomes.count({"taken", "refused"}) == len(readers), outcomes


class Other:
    """A whole number of another type, as those of numpy are."""

    def __init__(self, value):
        self.value = value

    def __index__(self):
        return self.value


def refused(error, **changes):
    given = {"sides": [engine.Side(0, 64, 1, 1)] * 2, "errors": (1, 2, 3), "pose": [0] * 12}
    given["rows"] = [engine.Row((0, 0, 0), (0, 0, 0), 0)] * engine.DIRECTIONS
    plain = engine.query(**given, number=1)
    wider = dict(given, errors=map(Other, (1, 2, 3)), pose=map(Other, [0] * 12), number=Other(1))
    wider["rows"] = [engine.Row(*[[Other(0)] * 3] * 2, Other(0))] * engine.DIRECTIONS
    assert engine.query(**wider) == plain
    try:
        engine.query(**dict(given, **changes))
    except error as said:
        return str(said)
    raise AssertionError("expected a refusal")


for wrong in [(1, 2), (1, 2, 3, 4), ()]:
    assert refused(ValueError, errors=wrong) == f"errors of the shift: found {len(wrong)}; expected 3"
assert refused(ValueError, errors=(0, Other(65536), 0)) == "error 1: found 65536; expected 0 to 65535"
assert refused(TypeError, errors=(0, 0, 1.0)) == "error 2: found 1.0; expected a whole number, 0 to 65535"
text = refused(ValueError, pose=[0] * 11 + [Other(1 << 40)])
assert text == f"entry of t 11: found {1 << 40}; expected {engine.TRANSLATION_LEAST} to {engine.TRANSLATION_MOST}", text
text = refused(ValueError, pose=[engine.ENTRY_MOST + 1] + [0] * 11)
assert text.startswith(f"entry of M 0: found {engine.ENTRY_MOST + 1}; expected "), text
assert refused(ValueError, sides=[engine.Side(0, 32, 1, 1)] * 2) == "address of side 0: found 32; expected a multiple of 64"
rows = [engine.Row((0, 0), (0, 0, 0), 0)] * engine.DIRECTIONS
assert refused(ValueError, rows=rows) == "choices of row 0: found 2; expected 3"
numbers = {engine.asked(bytes(8 * engine.QUERY_WORDS)) for _ in range(100)}
assert len(numbers) == 100, "each query has a number of its own"

def show(packet):
    return " ".join(f"{int.from_bytes(packet[i : i + 8], 'little'):016x}" for i in range(0, len(packet), 8))

for line in sys.stdin:
    kind, *rest = line.split()
    rest = iter(map(int, rest))
    take = lambda count: [next(rest) for _ in range(count)]
    if kind == "q":
        sides = []
        for _ in range(2):
            blocks_at, triangles_at, blocks, triangles = take(4)
            sides.append(engine.Side(64 * blocks_at, 64 * triangles_at, blocks, triangles))
        limit, flags, number = take(3)
        errors, [sticky], pose, rows = take(3), take(1), take(12), []
        for _ in range(engine.DIRECTIONS):
            terms = take(6)
            rows.append(engine.Row(terms[::2], terms[1::2], next(rest)))
        more = {"sticky": sticky} if STICKY else {}
        try:
            plain = engine.query(sides, errors, pose, rows, **more)
        except ValueError as said:
            print(said)
            continue
        packet = engine.asked(plain, limit, flags, number)
        assert packet == engine.query(sides, errors, pose, rows, limit, flags, number, **more)
        print(show(packet))
        print(show(engine.moved(packet, 640)[8:24]))
        print(show(engine.stop(0xABCDEF) + engine.reset(7)))
    elif kind == "d":
        packet = [0] * engine.QUERY_WORDS
        packet[engine.TRIANGLES_WORD], packet[engine.OPTIONS_WORD], count = take(3)
        packet = [word % (1 << 64) for word in packet]
        words = [low | high << 32 for low, high in zip(*[rest] * 2)]
        assert len(words) == count
        pack = lambda words: engine.struct.pack(f"<{len(words)}Q", *words)
        try:
            engine.answer(pack(words), pack(packet))
            print("taken")
        except ValueError:
            print("refused")
    else:
        pair = next(rest)
        words = [low | high << 32 for low, high in zip(*[rest] * 2)]
        [found], report = engine.answer(engine.struct.pack("<9Q", pair, *words))
        assert report.incomplete == (report.reason >= engine.REASON_LIMIT)
        print(*found)
        print(*map(int, report))
"#;

/// A query of any numbers that its fields hold, in its pose inside the declared ranges.
fn random_query(rng: &mut ChaCha8Rng, format: &EngineFormat, unit: &Params) -> Query {
    let mut input = |quantity| {
        let [least, most] = unit.declared(quantity);
        Input { lo: rng.random_range(least..most), sticky: format.sticky && rng.random() }
    };
    let m = [(); 3].map(|()| [(); 3].map(|()| input(Quantity::Entry)));
    let pose = Pose { m, t: [(); 3].map(|()| input(Quantity::Translation)), bypass: false };
    let slots = format.directions.slots();
    let mut row = || Row {
        terms: slots.map(|slot| (rng.random_range(0..slot.len() as u32), rng.random_range(0..1 << format.factor_bits))),
        rest: rng.random_range(0..1 << format.rest_bits()),
    };
    let rows = (0..format.k()).map(|_| row()).collect();
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

fn random_report(rng: &mut ChaCha8Rng, answer: &Answer) -> EngineReport {
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

fn answer_lines(answer: &Answer, report: &EngineReport) -> [String; 2] {
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
        (rng.random_range(0..1u64 << 24), random_report(rng, &Answer { verdict: 0, triangles: [0; 2] }));
    // Of half of the queries separate pairs are answered, too; then the report counts them among the leaf pairs.
    let all: bool = rng.random();
    let mut words = std::collections::BTreeMap::new();
    let count = rng.random_range(2..20);
    while words.len() < count {
        let triangles = [rng.random_range(0..50), rng.random_range(0..60)];
        words.insert(triangles, Answer { verdict: rng.random_range(if all { 0 } else { 1 }..3), triangles });
    }
    let mut pairs: Vec<u64> = words.values().map(Answer::word).collect();
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

fn efsat(dir: &Path, arguments: &str) -> (Option<i32>, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_efsat"));
    let output = command.args(arguments.split_whitespace()).current_dir(dir).output().unwrap();
    (output.status.code(), String::from_utf8([output.stdout, output.stderr].concat()).unwrap())
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
        let (home, format) = (tempfile::tempdir().unwrap(), engine.format(&unit).unwrap());
        let options = engine.options().into_iter().chain([("upper", unit.upper.name().to_owned())]);
        let of_memory = |name: &str| engine.memory == Memory::BlockRam && name == "memory-width";
        let options = options.filter(|(name, _)| !of_memory(name));
        let options: String = options.map(|(name, value)| format!(" --{name} {value}")).collect();
        let (status, said) = efsat(home.path(), &format!("generate --engine --out rtl{options}"));
        assert_eq!(status, Some(0), "{said}");
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
            let answer = Answer { verdict: rng.random_range(0..3), triangles };
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
        let python = Command::new("python3").arg("--version").output().is_ok();
        if !python {
            eprintln!("skipped in part: Python is not installed");
        }
        for command in ["./test < asked", "python3 -B test.py < asked"].iter().take(if python { 2 } else { 1 }) {
            let found = run(&host, "sh", &["-c", command]);
            let differs = found.lines().zip(due.lines()).find(|(found, due)| found != due);
            assert_eq!((differs, found.lines().count()), (None, due.lines().count()), "{command}: {options}");
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
    let (status, said) = efsat(dir, "tree query s.toml --out q.csv --image memory.bin");
    assert_eq!((status, said.as_str()), (Some(0), "q.csv: 2 packets, and 0 without, for software\n"));
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
    let model = Model::new(&EngineParams::default(), &Params::default()).unwrap();
    let found = packets("q.csv");
    let heads: Vec<&str> = found.iter().map(|(head, _)| head.as_str()).collect();
    assert_eq!(heads, ["0,0,1,0", "1,0,1,1"]);
    let reports: Vec<EngineReport> = found.iter().map(|(_, words)| model.run(&memory, words).report).collect();
    let (status, counts) = efsat(dir, "tree count s.toml --json");
    let counts: Value = serde_json::from_str(&counts).unwrap();
    assert_eq!((status, counts["queries"].as_u64()), (Some(0), Some(2)));
    for (name, of) in [("tests", (|r| r.tests) as fn(&EngineReport) -> u32), ("intersect", |r| r.intersect)] {
        assert_eq!(counts[name], reports.iter().map(of).sum::<u32>(), "{name}");
    }
    // One frame; with block RAM what fills it comes first, here one mesh for both objects.
    let (status, said) = efsat(dir, "tree query s.toml --out r.csv --frame 1 --memory block-ram --first-contact");
    assert_eq!((status, said.as_str()), (Some(0), "r.csv: 1 packet, and 0 without, for software\n"));
    let heads: Vec<String> = packets("r.csv").into_iter().map(|(head, _)| head).collect();
    assert_eq!(heads, ["load,,,", "load,,,", "1,0,1,0"]);
    for (options, part) in [
        ("s.toml --frame 3", "--frame 3: expected a number below 3"),
        ("s.toml --image x.csv", "found twice; expected two different files"),
        ("s.toml --image y --memory block-ram", "--image with --memory block-ram: expected --memory axi"),
        (
            "headlight --memory block-ram",
            "--block-lines 512: expected at least 5961, which the meshes take in block RAM",
        ),
    ] {
        let (status, said) = efsat(dir, &format!("tree query {options} --out x.csv"));
        assert!(status == Some(2) && said.contains(part) && !dir.join("x.csv").exists(), "{options}: {said}");
    }
}
