//! The host files in C and Python: they pack, unpack and refuse as the driver does.

use crate::tools::program::succeeds;
use crate::tools::{CHECKED, compiles_everywhere, has, run};
use efsat::golden::Golden;
use efsat::host::driver::{Driver, DriverError, Transfer, UnitAnswer};
use efsat::host::sample::{random_pair_under, random_pose};
use efsat::pair::{Input, Pair, Pose};
use efsat::params::options::Choice;
use efsat::params::{Method, Params, Quantity, Transform, Upper};
use efsat::words::{AnswerFields, PacketKind, StreamFormat, StreamReport, StreamWidth, verdict_status};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use std::fmt::Write;
use std::path::Path;

/// Packs the pairs and poses that it reads, and unpacks the answers; says what is refused.
const IN_C: &str = include_str!("host.c");

const IN_PYTHON: &str = include_str!("host.py");

/// An answer as both programs print it.
fn told(driver: &Driver, word: u128) -> Option<String> {
    let (verdict, reason, outside, malformed, tag, separated, overlapping) = match driver.unpack(word.into())? {
        UnitAnswer::Pair { tag, outcome: o } => {
            (o.verdict as u8, 0, u8::from(o.outside), 0, tag, o.separated, o.overlapping)
        }
        UnitAnswer::Report(report) => (3, report as u8, 0, u8::from(report != StreamReport::PoseTaken), 0, 0, 0),
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
        succeeds(dir, &format!("generate --out rtl --stream-width {} {options}", width.name()));
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
            let count = format.numbers(PacketKind::Pose) as usize;
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
                    [
                        StreamReport::PoseTaken,
                        StreamReport::UnknownHeader,
                        StreamReport::TooShort,
                        StreamReport::TooLong,
                    ][round / 5 % 4],
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
                matches!(driver.unpack(word.into()), Some(UnitAnswer::Pair { tag: found, .. }) if found == *tag)
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
        let python = has("Python", "python3", "--version");
        for command in ["./test < asked", "python3 -B test.py < asked"].iter().take(if python { 2 } else { 1 }) {
            let found = run(&host, "sh", &["-c", command]);
            let differs = found.lines().zip(expected.lines()).position(|(found, due)| found != due);
            let lines = differs.map(|at| (at, found.lines().nth(at), expected.lines().nth(at)));
            assert_eq!((lines, found.lines().count()), (None, expected.lines().count()), "{command}: {params:?}");
        }
    }
}

/// The headers of the ready designs, in C and C++; one that several have is compiled once.
#[test]
fn ready_headers_compile_everywhere() {
    let ready = Path::new(env!("CARGO_MANIFEST_DIR")).join("rtl-out");
    let mut seen = std::collections::HashSet::new();
    for design in std::fs::read_dir(ready).unwrap().map(|design| design.unwrap().path().join("host")) {
        let files = design.is_dir().then(|| std::fs::read_dir(design).unwrap()).into_iter().flatten();
        let headers = files.map(|file| file.unwrap().path()).filter(|file| file.extension().is_some_and(|e| e == "h"));
        headers
            .filter(|header| seen.insert(std::fs::read(header).unwrap()))
            .for_each(|header| compiles_everywhere(&header));
    }
    assert!(seen.len() >= 9, "{} headers", seen.len());
}

/// Pairs of which B is far outside the range of the unit, turned by 45 degrees: a unit without a guard called 56 of these 200
/// pairs intersecting, at a distance of 16.
const FAR: &str = include_str!("far.py");

#[test]
fn pairs_far_outside_the_range_are_refused() {
    if !has("Python", "python3", "--version") {
        return;
    }
    let home = tempfile::tempdir().unwrap();
    succeeds(home.path(), "generate --out rtl");
    let host = home.path().join("rtl/host");
    std::fs::write(host.join("far.py"), FAR).unwrap();
    assert_eq!(run(&host, "python3", &["-B", "far.py"]), "200\n");
    // With a guard they can be sent as they are.
    succeeds(home.path(), "generate --out guarded --guard always");
    let host = home.path().join("guarded/host");
    std::fs::write(host.join("far.py"), FAR.replace("a + b], 0)])", "a + b], 0)], outside=True)")).unwrap();
    assert_eq!(run(&host, "python3", &["-B", "far.py"]), "0\n");
    compiles_everywhere(&host.join("efsat.h"));
}
