//! The stream wrapper, the example and the driver in GHDL, against the reference model and the exact oracle.

use crate::drop_in::pasted;
use crate::extent::share;
use crate::tools::{Ghdl, ghdl};
use efsat::artefact::{FileSet, Packaging, design_files_with, stream_vectors};
use efsat::design::{Design, Probes};
use efsat::exact::{self, Exact};
use efsat::host::driver::{Driver, StandIn, Statistics, Transfer};
use efsat::params::{Axes, Method, Params, Transform, Upper};
use efsat::sample::random_points;
use efsat::words::{StreamFormat, StreamWidth, StreamWord};
use efsat_hardware::tools::Tool;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use rayon::prelude::*;

/// Small, fast and complete.
fn small() -> Params {
    Params { width: 8, transform_width: 10, ..Params::default() }
}

/// The same of the determinant unit.
fn determinants() -> Params {
    Params { method: Method::Determinants, ..small() }
}

fn packaging(stream_width: StreamWidth) -> Packaging {
    Packaging { stream_width, ..Packaging::default() }
}

/// A generated design in a folder of its own.
struct Bench {
    ghdl: Ghdl,
    params: Params,
    format: StreamFormat,
    files: FileSet,
}

impl Bench {
    fn new(ghdl: &'static Tool, params: &Params, width: StreamWidth) -> Self {
        let design = Design::new(params, Probes::None).unwrap();
        let files = design_files_with(&design, &packaging(width), &params.command_line()).unwrap();
        let format = StreamFormat::new(params, width);
        let bench = Self { ghdl: Ghdl::new(ghdl), params: params.clone(), format, files };
        for name in bench.names() {
            bench.ghdl.write(name, bench.files.get(name).unwrap());
        }
        bench.ghdl.write("efsat_stream_tb.vec", bench.files.get("efsat_stream_tb.vec").unwrap());
        bench.ghdl.analyse(&bench.names());
        bench
    }

    /// The VHDL files in dependency order.
    fn names(&self) -> Vec<&str> {
        self.files.get("files.txt").unwrap().lines().collect()
    }

    /// Runs the stream testbench on other vectors, at full speed only.
    fn run_vectors(&self, vectors: &str) -> String {
        self.ghdl.write("other.vec", vectors);
        self.ghdl.run("efsat_stream_tb", &["-gvectors=other.vec", "-ganswers=answers.txt", "-gpasses=1"]).1
    }

    /// Sends transfers through the simulated wrapper; what comes back.
    fn through(&self, transfers: &[Transfer]) -> Vec<Transfer> {
        let vectors = self.vectors(transfers, &[]);
        let report = self.run_vectors(&vectors);
        assert!(report.contains(" mismatches 0 "), "{report}");
        let text = self.ghdl.read("answers.txt");
        let transfer = |line: &str| {
            let (data, last) = line.split_once(' ').unwrap();
            Transfer { data: StreamWord::from_hex(data).unwrap(), last: last == "1" }
        };
        text.lines().map(transfer).collect()
    }

    fn vectors(&self, words: &[Transfer], answers: &[Transfer]) -> String {
        let word = |t: &Transfer| stream_vectors::WordIn { data: t.data, last: t.last, whole: true };
        let vectors = stream_vectors::StreamVectors {
            words: words.iter().map(word).collect(),
            answers: answers.iter().map(|t| (t.data.low(), t.last)).collect(),
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
        (Params { width: 12, transform_width: 16, ..small() }, StreamWidth::Bits64),
        (Params { transform_width: 48, tag_width: 1, ..small() }, StreamWidth::Bits128),
        (Params { upper: sticky, tag_width: 64, axes: Axes::Seventeen, ..small() }, StreamWidth::Bits64),
        (Params { transform: Transform::Off, tag_width: 0, upper: sticky, ..small() }, StreamWidth::Bits128),
        (Params { transform: Transform::Translate, tag_width: 40, axes_per_clock: 3, ..small() }, StreamWidth::Bits32),
        (Params { clocks_per_pair: 2, transform_width: 33, ..determinants() }, StreamWidth::Bits512),
        (Params { transform: Transform::Off, method: Method::Exact, ..small() }, StreamWidth::Bits1024),
        (determinants(), StreamWidth::Bits1024),
        (
            Params { exact_clocks: Some(15), width: 12, transform_width: 16, ..Params::of(Method::Exact) },
            StreamWidth::Bits1024,
        ),
        (Params { transform: Transform::Translate, ..determinants() }, StreamWidth::Bits256),
    ];
    let wrong: Vec<String> = share(5, cases)
        .par_iter()
        .filter_map(|(params, width)| {
            let bench = Bench::new(ghdl, params, *width);
            let vectors = stream_vectors::mixed(params, &bench.format, stream_vectors::FILLING);
            let answers = vectors.answers.len();
            let report = bench.ghdl.run("efsat_stream_tb", &[]).1;
            let fine = number(&report, "answers") == Some(answers)
                && number(&report, "compared") == Some(2 * answers)
                && number(&report, "mismatches") == Some(0);
            (!fine).then(|| format!("{} --stream-width {}:\n{report}", params.command_line(), width.bits()))
        })
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
#[ignore = "mistakes in the wrapper, each compiled: scripts/test full"]
fn a_wrong_wrapper_is_noticed() {
    let Some(ghdl) = ghdl() else { return };
    let params = small();
    let bench = Bench::new(ghdl, &params, StreamWidth::Bits64);
    let few = stream_vectors::mixed(&params, &bench.format, 3);
    bench.ghdl.write("efsat_stream_tb.vec", &stream_vectors::text(&params, &bench.format, &few));
    let report = bench.ghdl.run("efsat_stream_tb", &[]).1;
    assert_eq!(number(&report, "mismatches"), Some(0), "{report}");
    let wrapper = bench.files.get("efsat_stream.vhd").unwrap();
    // With the number of passes that show it: stalls and the reset come with the second.
    let changes = [
        // TLAST one word late.
        (1, "m_axis_tlast <= head(3);", "m_axis_tlast <= order_memory(to_integer(given_count(4 downto 0) - 1))(3);"),
        // Words in the other order.
        (1, "s_axis_tdata & assembly(639 downto 64)", "assembly(575 downto 0) & s_axis_tdata"),
        // The pose overtakes the pair before it.
        (1, "(not (pair_valid or pose_valid)) or", "'1' or"),
        // A short packet is not reported.
        (1, "word_taken and (s_axis_tlast or at_pair_end)", "word_taken and at_pair_end"),
        // A pose with a word too many is taken.
        (1, "pose_valid <= s_axis_tlast;", "pose_valid <= '1';"),
        // Missing bytes are not noticed.
        (1, "whole <= '1' when s_axis_tkeep = all_bytes else '0';", "whole <= '1';"),
        // The tag of one bit less.
        (1, "flags_answer & out_tag &", "flags_answer & '0' & out_tag(14 downto 0) &"),
        // An answer is dropped although it was not taken.
        (2, "answer_taken <= answer_valid and m_axis_tready;", "answer_taken <= answer_valid;"),
        // TVALID waits for TREADY.
        (2, "owing and (head(2) or out_valid);", "owing and (head(2) or out_valid) and m_axis_tready;"),
        // An answer changes while it is stalled.
        (2, "m_axis_tlast <= head(3);", "m_axis_tlast <= head(3) or not m_axis_tready;"),
        // A reset forgets neither the packet, nor the record, nor the answers owed, nor the pose.
        (2, "expectation <= header_state;\n        place", "place"),
        (2, "pair_valid <= '0';\n        pose_valid", "pose_valid"),
        (2, "given_count <= (others => '0');\n      else", "else"),
        (2, "reset => reset,", "reset => '0',"),
        // Words are taken in reset.
        (2, "running <= '0';\n        expectation", "expectation"),
    ];
    let mut missed = vec![];
    for (passes, old, new) in share(7, changes) {
        let changed = wrapper.replace(old, new);
        assert_ne!(changed, wrapper, "{old}");
        bench.ghdl.write("efsat_stream.vhd", &changed);
        bench.ghdl.analyse(&["efsat_stream.vhd", "efsat_stream_tb.vhd"]);
        let report = bench.ghdl.run("efsat_stream_tb", &[&format!("-gpasses={passes}")]).1;
        if number(&report, "mismatches") == Some(0) {
            missed.push(format!("{old} -> {new}:\n{report}"));
        }
    }
    assert!(missed.is_empty(), "{}", missed.join("\n"));
}

#[test]
#[ignore = "mistakes in the wrapper, each compiled: scripts/test full"]
fn a_wrapper_that_loses_the_flag_of_the_guard_is_noticed() {
    let Some(ghdl) = ghdl() else { return };
    // Wide enough for definite verdicts, which are what there is to lose.
    let params = Params { width: 14, transform_width: 16, transform: Transform::Translate, ..small() };
    let bench = Bench::new(ghdl, &params, StreamWidth::Bits64);
    let few = stream_vectors::mixed(&params, &bench.format, 2);
    bench.ghdl.write("efsat_stream_tb.vec", &stream_vectors::text(&params, &bench.format, &few));
    let report = bench.ghdl.run("efsat_stream_tb", &["-gpasses=1"]).1;
    assert_eq!(number(&report, "mismatches"), Some(0), "{report}");
    let wrapper = bench.files.get("efsat_stream.vhd").unwrap();
    let changes = [
        ("\"000\" & outside_answer & \"00\"", "\"000000\""),
        ("outside_answer <= out_outside or head(0);", "outside_answer <= head(0);"),
        ("outside_answer <= out_outside or head(0);", "outside_answer <= out_outside;"),
        // The unit's answer to the low bits of a number is given all the same.
        ("code_answer <= \"10\" when head(0) = '1' else", "code_answer <="),
        ("flags_answer <= (others => '0') when head(0) = '1' else", "flags_answer <="),
        // Numbers of a pose are not looked at, or those of a bypassed one are.
        ("pair_unfit <= record_unfit or pose_unfit;", "pair_unfit <= record_unfit;"),
        ("next_pose_unfit and not assembly(479);", "next_pose_unfit;"),
        // All words of a record but the last are forgotten, or a record marks those behind it.
        ("begun_unfit <= record_unfit;", "begun_unfit <= word_unfit;"),
        ("place <= \"000000\";\n              begun_unfit <= '0';", "place <= \"000000\";"),
    ];
    let mut missed = vec![];
    for (old, new) in share(3, changes) {
        let changed = wrapper.replace(old, new);
        assert_ne!(changed, wrapper, "{old}");
        bench.ghdl.write("efsat_stream.vhd", &changed);
        bench.ghdl.analyse(&["efsat_stream.vhd", "efsat_stream_tb.vhd"]);
        let report = bench.ghdl.run("efsat_stream_tb", &["-gpasses=1"]).1;
        if number(&report, "mismatches") == Some(0) {
            missed.push(format!("{old} -> {new}:\n{report}"));
        }
    }
    assert!(missed.is_empty(), "{}", missed.join("\n"));
}

#[test]
fn damaged_packets_are_answered_as_the_stand_in_answers_them() {
    let Some(ghdl) = ghdl() else { return };
    let params = Params { upper: Upper::Sticky, width: 6, transform_width: 8, ..Params::default() };
    let width = StreamWidth::Bits128;
    let bench = Bench::new(ghdl, &params, width);
    let good = stream_vectors::mixed(&params, &bench.format, 3).words;
    let packets: Vec<_> = good.split_inclusive(|word| word.last).collect();
    let mut rng = ChaCha8Rng::seed_from_u64(8);
    let mut transfers = vec![];
    for _ in 0..30 {
        let packet = packets[rng.random_range(0..packets.len())];
        let mut words: Vec<StreamWord> = packet.iter().map(|word| word.data).collect();
        let at = rng.random_range(0..words.len());
        match rng.random_range(0..5) {
            0 if words.len() > 1 => drop(words.remove(at)),
            1 => words.insert(at, words[at]),
            2 => words[0] = words[0].flipped(rng.random_range(0..64)),
            3 => words.truncate(at + 1),
            _ => {}
        }
        let count = words.len();
        transfers.extend(words.into_iter().enumerate().map(|(i, data)| Transfer { data, last: i + 1 == count }));
    }
    let answers = StandIn::new(&params, width).unwrap().answer(&transfers);
    let report = bench.run_vectors(&bench.vectors(&transfers, &answers));
    assert_eq!((number(&report, "answers"), number(&report, "mismatches")), (Some(answers.len()), Some(0)), "{report}");
    assert!(answers.iter().filter(|t| t.data.bit(7)).count() > 8, "many packets are malformed");
}

#[test]
fn the_driver_gets_exact_answers_through_the_wrapper() {
    let Some(ghdl) = ghdl() else { return };
    let mut rng = ChaCha8Rng::seed_from_u64(11);
    let loose: Vec<[[f64; 3]; 6]> = (0..24).map(|_| random_points(&mut rng)).collect();
    let mut mesh = || -> Vec<[f64; 3]> { (0..9).map(|_| [0, 1, 2].map(|_| rng.random_range(-1.0..1.0))).collect() };
    let (a, b) = (mesh(), mesh());
    let triangles: Vec<([u32; 3], [u32; 3])> =
        (0..6).flat_map(|i| (0..6).map(move |j| ([i, i + 1, i + 2], [j, j + 1, j + 3]))).collect();
    let (m, t) = ([[0.6, -0.8, 0.0], [0.8, 0.6, 0.0], [0.0, 0.0, 1.0]], [0.25, 0.5, 0.0]);
    let cases = [
        (Params { width: 12, transform_width: 16, upper: Upper::Sticky, ..Params::default() }, StreamWidth::Bits64),
        (
            Params { width: 10, transform_width: 14, transform: Transform::Off, ..Params::default() },
            StreamWidth::Bits32,
        ),
    ];
    let wrong: Vec<String> = share(2, cases)
        .par_iter()
        .flat_map_iter(|(params, width)| {
            let bench = Bench::new(ghdl, params, *width);
            let driver = Driver::new(params, *width).unwrap();
            let meshes = driver.meshes(&a, &b).unwrap();
            // One run for two jobs, the second under a pose.
            let (first, second) = (driver.loose(&loose).unwrap(), meshes.pose(&m, &t, &triangles).unwrap());
            let words = [first.transfers(), second.transfers()].concat();
            let answers = bench.through(&words);
            let stand_in = StandIn::new(params, *width).unwrap().answer(&words);
            let (to_first, to_second) = answers.split_at(first.answers_due());
            let corners = |mesh: &[[f64; 3]], triangle: [u32; 3]| triangle.map(|i| mesh[i as usize]);
            let posed =
                |(i, j): &([u32; 3], [u32; 3])| exact::posed_pair(&corners(&a, *i), &corners(&b, *j), &m, &t).unwrap();
            let (first, second) = (first.finish(to_first).unwrap(), second.finish(to_second).unwrap());
            let used = [first.statistics, second.statistics];
            let all = |count: fn(&Statistics) -> usize| used.iter().map(count).sum::<usize>() > 0;
            let checks = [
                ("the stand-in answers as the wrapper", stand_in == answers),
                (
                    "loose pairs",
                    first.answers == loose.iter().map(|points| exact::pair(points).unwrap()).collect::<Vec<Exact>>(),
                ),
                ("posed pairs", second.answers == triangles.iter().map(posed).collect::<Vec<Exact>>()),
                ("separate by the unit", all(|s| s.unit_separate)),
                ("intersecting by the unit", all(|s| s.unit_intersect) || params.width < 12),
                ("retested", all(|s| s.retested)),
            ];
            let failed = checks.into_iter().filter(|(_, fine)| !fine);
            let text = |(what, _)| format!("{}: {what}: {used:?}", params.command_line());
            failed.map(text).collect::<Vec<_>>()
        })
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_long_packet_runs_at_the_stated_speed() {
    let Some(ghdl) = ghdl() else { return };
    use StreamWidth::{Bits32, Bits64, Bits128, Bits256, Bits512, Bits1024};
    let tiny = Params { width: 6, transform_width: 8, ..Params::default() };
    let axes = [(Bits32, 22), (Bits64, 11), (Bits128, 11)];
    let determinants = [(Bits64, 10), (Bits128, 5), (Bits256, 3), (Bits512, 2), (Bits1024, 1)];
    let of = |method: Method, widths: &[(StreamWidth, usize)]| -> Vec<_> {
        let params = Params { method, transform: Params::of(method).transform, ..tiny.clone() };
        widths.iter().map(|(width, period)| (params.clone(), *width, *period)).collect()
    };
    let exact = [(Bits512, 2), (Bits1024, 1)];
    let cases = [of(Method::Axes, &axes), of(Method::Determinants, &determinants), of(Method::Exact, &exact)].concat();
    let wrong: Vec<String> = share(3, cases)
        .par_iter()
        .filter_map(|(params, width, period)| {
            let bench = Bench::new(ghdl, params, *width);
            let clocks = |pairs| {
                let vectors = stream_vectors::one_packet(params, &bench.format, pairs);
                let report = bench.run_vectors(&stream_vectors::text(params, &bench.format, &vectors));
                assert_eq!(number(&report, "mismatches"), Some(0), "{} bits: {report}", width.bits());
                number(&report, "clocks").unwrap_or(0)
            };
            let stated = bench.format.pair_period(params.interval());
            let measured = clocks(14) - clocks(4);
            let fine = stated == *period && measured == 10 * period;
            (!fine).then(|| format!("{} bits: {measured} clocks for 10 pairs, stated {stated} each", width.bits()))
        })
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_pair_goes_through_the_uart_example() {
    let Some(ghdl) = ghdl() else { return };
    let tiny = Params { width: 6, transform_width: 8, ..Params::default() };
    let bare = Params { transform: Transform::Off, tag_width: 0, ..tiny.clone() };
    let shift = ("data => leaving(7 downto 0)", "data => leaving(8 downto 1)");
    let cases = [(&tiny, StreamWidth::Bits64, 24, shift, false), (&bare, StreamWidth::Bits32, 8, shift, true)];
    let wrong: Vec<String> = cases
        .par_iter()
        .filter_map(|(params, width, bytes, (old, new), broken)| {
            let bench = Bench::new(ghdl, params, *width);
            let example = bench.files.get("example/efsat_uart_top.vhd").unwrap();
            assert!(example.contains(old));
            if *broken {
                bench.ghdl.write("example/efsat_uart_top.vhd", &example.replace(old, new));
                bench.ghdl.analyse(&["example/efsat_uart_top.vhd", "example/efsat_uart_tb.vhd"]);
            }
            let report = bench.ghdl.run("efsat_uart_tb", &[]).1;
            let fine = report.contains(&format!("efsat_uart_tb: bytes compared {bytes} mismatches 0"));
            (fine == *broken).then_some(report)
        })
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The instances to copy, pasted into a design, elaborate: no port is missing, none has another type.
#[test]
fn the_instances_to_copy_fit_their_entities() {
    let Some(ghdl) = ghdl() else { return };
    let bare = Params { transform: Transform::Off, tag_width: 0, upper: Upper::Sticky, ..small() };
    let cases = [(Params { tag_width: 1, ..small() }, StreamWidth::Bits64), (bare, StreamWidth::Bits32)];
    for (params, width) in &cases {
        let bench = Bench::new(ghdl, params, *width);
        let text = bench.files.get("efsat_instance.vhd.txt").unwrap();
        bench.ghdl.write("pasted.vhd", &pasted(text));
        bench.ghdl.analyse(&["pasted.vhd"]);
        let (fine, said) = bench.ghdl.call("-e", &["pasted"]);
        assert!(fine && text.contains("s_axis_tkeep : "), "{}: {said}", params.command_line());
    }
}
