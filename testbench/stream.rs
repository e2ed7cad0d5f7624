//! The stream wrapper, the example and the driver in GHDL, against the reference model and the exact oracle.

use efsat::artefact::{design_files_with, stream, stream_vectors, FileSet};
use efsat::design::Design;
use efsat::driver::{Driver, StandIn, Transfer};
use efsat::exact::{self, Exact};
use efsat::golden::sample;
use efsat::params::stream::{StreamFormat, StreamWidth};
use efsat::params::{Axes, Params, Transform, Upper};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use std::path::Path;
use std::process::Command;

/// The GHDL that compiles fastest, none where none is installed.
fn ghdl() -> Option<&'static str> {
    let found = |name: &&str| Command::new(name).arg("--version").output().is_ok_and(|o| o.status.success());
    let command = ["ghdl-mcode", "ghdl", "ghdl-llvm"].into_iter().find(found);
    if command.is_none() {
        eprintln!("skipped: GHDL is not installed");
    }
    command
}

/// Small, fast and complete.
fn small() -> Params {
    Params { width: 8, transform_width: 10, ..Params::default() }
}

/// A generated design in a folder of its own.
struct Bench {
    ghdl: &'static str,
    params: Params,
    format: StreamFormat,
    files: FileSet,
    dir: tempfile::TempDir,
}

impl Bench {
    fn new(ghdl: &'static str, params: &Params, width: StreamWidth) -> Self {
        let design = Design::new(params, false).unwrap();
        let files = design_files_with(&design, width, &params.command_line()).unwrap();
        let dir = tempfile::tempdir().unwrap();
        std::fs::create_dir(dir.path().join("example")).unwrap();
        let format = StreamFormat::new(params, width);
        let bench = Self { ghdl, params: params.clone(), format, files, dir };
        for name in bench.names() {
            bench.write(name, bench.files.get(name).unwrap());
        }
        bench.write("efsat_stream_tb.vec", bench.files.get("efsat_stream_tb.vec").unwrap());
        bench.analyse(&bench.names());
        bench
    }

    /// The VHDL files in dependency order.
    fn names(&self) -> Vec<&str> {
        self.files.get("files.txt").unwrap().lines().collect()
    }

    fn write(&self, name: &str, text: &str) {
        std::fs::write(self.dir.path().join(name), text).unwrap();
    }

    /// Runs GHDL; whether it succeeded, and what it says.
    fn call(&self, args: &[&str]) -> (bool, String) {
        let output = Command::new(self.ghdl).args(args).current_dir(self.dir.path()).output().unwrap();
        let text = String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
        (output.status.success(), text)
    }

    fn analyse(&self, names: &[&str]) {
        let (fine, text) = self.call(&[&["-a", "--std=93", "--warn-error"], names].concat());
        assert!(fine, "{text}");
    }

    /// Runs a testbench; what it says.
    fn run(&self, entity: &str, options: &[&str]) -> String {
        let (fine, text) = self.call(&["-e", "--std=93", entity]);
        assert!(fine, "{text}");
        self.call(&[&["-r", "--std=93", entity, "--ieee-asserts=disable-at-0"], options].concat()).1
    }

    /// Runs the stream testbench on other vectors.
    fn run_vectors(&self, vectors: &str) -> String {
        self.write("other.vec", vectors);
        self.run("efsat_stream_tb", &["-gvectors=other.vec", "-ganswers=answers.txt"])
    }

    /// Sends transfers through the simulated wrapper; what comes back.
    fn through(&self, transfers: &[Transfer]) -> Vec<Transfer> {
        let vectors = self.vectors(transfers, &[]);
        let report = self.run_vectors(&vectors);
        assert!(report.contains(" mismatches 0 "), "{report}");
        let text = std::fs::read_to_string(self.dir.path().join("answers.txt")).unwrap();
        let transfer = |line: &str| {
            let (data, last) = line.split_once(' ').unwrap();
            Transfer { data: u128::from_str_radix(data, 16).unwrap(), last: last == "1" }
        };
        text.lines().map(transfer).collect()
    }

    fn vectors(&self, words: &[Transfer], answers: &[Transfer]) -> String {
        let word = |t: &Transfer| stream_vectors::WordIn { data: t.data, last: t.last, whole: true };
        let vectors = stream_vectors::StreamVectors {
            words: words.iter().map(word).collect(),
            answers: answers.iter().map(|t| (t.data, t.last)).collect(),
        };
        stream_vectors::text(&self.params, &self.format, &vectors)
    }
}

/// The number that follows a word of a report.
fn number(report: &str, name: &str) -> Option<usize> {
    let last = report.lines().find(|line| line.contains("efsat_stream_tb: packets "))?;
    last.split_whitespace().skip_while(|word| *word != name).nth(1)?.parse().ok()
}

#[test]
fn answers_equal_the_reference_models() {
    let Some(ghdl) = ghdl() else { return };
    let sticky = Upper::Sticky;
    let cases = [
        (small(), StreamWidth::Bits32),
        (small(), StreamWidth::Bits64),
        (small(), StreamWidth::Bits128),
        (Params { upper: sticky, tag_width: 64, axes: Axes::Seventeen, ..small() }, StreamWidth::Bits64),
        (Params { transform_width: 48, tag_width: 1, ..small() }, StreamWidth::Bits32),
        (Params { transform_width: 33, upper: sticky, tag_width: 33, ..small() }, StreamWidth::Bits128),
        (Params { transform: Transform::Off, tag_width: 0, upper: sticky, ..small() }, StreamWidth::Bits128),
        (Params { transform: Transform::Translate, tag_width: 40, axes_per_clock: 11, ..small() }, StreamWidth::Bits64),
    ];
    let wrong: Vec<String> = cases
        .par_iter()
        .filter_map(|(params, width)| {
            let bench = Bench::new(ghdl, params, *width);
            let answers = stream_vectors::mixed(params, &bench.format).answers.len();
            let report = bench.run("efsat_stream_tb", &[]);
            let fine = number(&report, "answers") == Some(answers)
                && number(&report, "compared") == Some(2 * answers)
                && number(&report, "mismatches") == Some(0);
            (!fine).then(|| format!("{} --stream-width {}:\n{report}", params.command_line(), width.bits()))
        })
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_wrong_wrapper_is_noticed() {
    let Some(ghdl) = ghdl() else { return };
    let bench = Bench::new(ghdl, &small(), StreamWidth::Bits64);
    let wrapper = bench.files.get("efsat_stream.vhd").unwrap();
    let changes = [
        // TLAST one word late.
        ("m_axis_tlast <= head(3);", "m_axis_tlast <= head(3) after 5 ns when answer_taken'delayed(5 ns) = '1';"),
        // Words in the other order.
        ("s_axis_tdata & assembly(639 downto 64)", "assembly(575 downto 0) & s_axis_tdata"),
        // The pose overtakes the pair before it.
        ("(not (pair_valid or pose_valid)) or", "'1' or"),
        // A short packet is not reported.
        ("word_taken and (s_axis_tlast or at_pair_end)", "word_taken and at_pair_end"),
        // A pose with a word too many is taken.
        ("pose_valid <= s_axis_tlast;", "pose_valid <= '1';"),
        // Missing bytes are not noticed.
        ("whole <= '1' when s_axis_tkeep = all_bytes else '0';", "whole <= '1';"),
        // The tag of one bit less.
        ("out_separated & out_tag &", "out_separated & '0' & out_tag(14 downto 0) &"),
        // An answer is dropped although it was not taken.
        ("answer_taken <= answer_valid and m_axis_tready;", "answer_taken <= answer_valid;"),
    ];
    let mut missed = vec![];
    for (old, new) in changes {
        let changed = wrapper.replace(old, new);
        assert_ne!(changed, wrapper, "{old}");
        bench.write("efsat_stream.vhd", &changed);
        bench.analyse(&["efsat_stream.vhd", "efsat_stream_tb.vhd"]);
        let report = bench.run("efsat_stream_tb", &[]);
        if number(&report, "mismatches") == Some(0) {
            missed.push(format!("{old}:\n{report}"));
        }
    }
    assert!(missed.is_empty(), "{}", missed.join("\n"));
}

#[test]
fn damaged_packets_are_answered_as_the_stand_in_answers_them() {
    let Some(ghdl) = ghdl() else { return };
    let params = Params { upper: Upper::Sticky, ..small() };
    let width = StreamWidth::Bits128;
    let bench = Bench::new(ghdl, &params, width);
    let good = stream_vectors::mixed(&params, &bench.format).words;
    let packets: Vec<_> = good.split_inclusive(|word| word.last).filter(|p| p.len() < 60).collect();
    let mut rng = ChaCha8Rng::seed_from_u64(8);
    let mut transfers = vec![];
    for _ in 0..60 {
        let packet = packets[rng.random_range(0..packets.len())];
        let mut words: Vec<u128> = packet.iter().map(|word| word.data).collect();
        let at = rng.random_range(0..words.len());
        match rng.random_range(0..5) {
            0 if words.len() > 1 => drop(words.remove(at)),
            1 => words.insert(at, words[at]),
            2 => words[0] ^= 1 << rng.random_range(0..64),
            3 => words.truncate(at + 1),
            _ => {}
        }
        let count = words.len();
        transfers.extend(words.into_iter().enumerate().map(|(i, data)| Transfer { data, last: i + 1 == count }));
    }
    let answers = StandIn::new(&params, width).unwrap().answer(&transfers);
    let report = bench.run_vectors(&bench.vectors(&transfers, &answers));
    assert_eq!((number(&report, "answers"), number(&report, "mismatches")), (Some(answers.len()), Some(0)), "{report}");
    assert!(answers.iter().filter(|t| t.data & 0x80 != 0).count() > 15, "many packets are malformed");
}

#[test]
fn the_driver_gets_exact_answers_through_the_wrapper() {
    let Some(ghdl) = ghdl() else { return };
    let mut rng = ChaCha8Rng::seed_from_u64(11);
    let loose: Vec<[[f64; 3]; 6]> = (0..40).map(|_| sample::random_points(&mut rng)).collect();
    let mut mesh = || -> Vec<[f64; 3]> { (0..9).map(|_| [0, 1, 2].map(|_| rng.random_range(-1.0..1.0))).collect() };
    let (a, b) = (mesh(), mesh());
    let triangles: Vec<([u32; 3], [u32; 3])> =
        (0..6).flat_map(|i| (0..6).map(move |j| ([i, i + 1, i + 2], [j, j + 1, j + 3]))).collect();
    let (m, t) = ([[0.6, -0.8, 0.0], [0.8, 0.6, 0.0], [0.0, 0.0, 1.0]], [0.25, 0.5, 0.0]);
    let cases = [
        (Params { width: 12, transform_width: 20, upper: Upper::Sticky, ..Params::default() }, StreamWidth::Bits64),
        (
            Params { width: 10, transform: Transform::Off, transform_width: 18, ..Params::default() },
            StreamWidth::Bits32,
        ),
    ];
    cases.par_iter().for_each(|(params, width)| {
        let bench = Bench::new(ghdl, params, *width);
        let driver = Driver::new(params, *width).unwrap();
        let meshes = driver.meshes(&a, &b);
        // One run for two jobs, the second under a pose.
        let (first, second) = (driver.loose(&loose), meshes.pose(&m, &t, &triangles));
        let words = [first.transfers(), second.transfers()].concat();
        let answers = bench.through(&words);
        assert_eq!(answers, StandIn::new(params, *width).unwrap().answer(&words));
        let (to_first, to_second) = answers.split_at(first.answers_due());
        let expected: Vec<Exact> = loose.iter().map(exact::pair).collect();
        assert_eq!(first.finish(to_first).unwrap().answers, expected);
        let corners = |mesh: &[[f64; 3]], triangle: [u32; 3]| triangle.map(|i| mesh[i as usize]);
        let posed = |(i, j): &([u32; 3], [u32; 3])| exact::posed_pair(&corners(&a, *i), &corners(&b, *j), &m, &t);
        let results = second.finish(to_second).unwrap();
        assert_eq!(results.answers, triangles.iter().map(posed).collect::<Vec<_>>());
        assert!(results.statistics.unit_separate > 0 && results.statistics.unit_intersect > 0);
    });
}

#[test]
fn a_long_packet_runs_at_the_stated_speed() {
    let Some(ghdl) = ghdl() else { return };
    [StreamWidth::Bits32, StreamWidth::Bits64, StreamWidth::Bits128].par_iter().for_each(|width| {
        let params = small();
        let bench = Bench::new(ghdl, &params, *width);
        let clocks = |pairs| {
            let vectors = stream_vectors::one_packet(&params, &bench.format, pairs);
            let report = bench.run_vectors(&stream_vectors::text(&params, &bench.format, &vectors));
            assert_eq!(number(&report, "mismatches"), Some(0), "{report}");
            number(&report, "clocks").unwrap()
        };
        let period = stream::pair_period(&params, &bench.format);
        assert_eq!(clocks(45) - clocks(5), 40 * period, "{} bits", width.bits());
    });
}

#[test]
fn a_pair_goes_through_the_uart_example() {
    let Some(ghdl) = ghdl() else { return };
    let cases = [
        (small(), StreamWidth::Bits64, 24),
        (Params { transform: Transform::Off, tag_width: 0, ..small() }, StreamWidth::Bits32, 8),
    ];
    cases.par_iter().for_each(|(params, width, bytes)| {
        let bench = Bench::new(ghdl, params, *width);
        let report = bench.run("efsat_uart_tb", &[]);
        assert!(report.contains(&format!("efsat_uart_tb: bytes compared {bytes} mismatches 0")), "{report}");
        let example = bench.files.get("example/efsat_uart_top.vhd").unwrap();
        let changed = example.replace("data => leaving(7 downto 0)", "data => leaving(8 downto 1)");
        assert_ne!(changed, example);
        bench.write("example/efsat_uart_top.vhd", &changed);
        bench.analyse(&["example/efsat_uart_top.vhd", "example/efsat_uart_tb.vhd"]);
        let report = bench.run("efsat_uart_tb", &[]);
        assert!(!report.contains(" mismatches 0"), "a shifted byte is noticed: {report}");
    });
}

/// The files are where the projects look for them.
#[test]
fn every_file_that_a_project_names_is_there() {
    let params = small();
    let set = design_files_with(&Design::new(&params, false).unwrap(), StreamWidth::Bits64, "efsat").unwrap();
    let core = set.get("efsat.core").unwrap();
    let named = core.lines().filter_map(|line| line.trim().strip_prefix("- "));
    let named: Vec<&str> = named.map(|rest| rest.split(':').next().unwrap()).collect();
    assert!(named.len() > 20);
    for name in named {
        assert!(set.get(name).is_some(), "{name}");
    }
    for (folder, file) in [("vivado", "efsat.xdc"), ("quartus", "efsat.sdc"), ("vunit", "run.py")] {
        assert!(set.get(&Path::new(folder).join(file).to_string_lossy()).is_some(), "{folder}");
    }
}
