//! The registers behind AXI4-Lite in GHDL: the generated testbench around units and engines, and mistakes that it must notice.

use crate::engine_rtl::{analysed, axi, small};
use crate::extent::{full, share};
use crate::tools::program::{refuses, succeeds};
use crate::tools::{CHECKED, Ghdl, compiles_everywhere, ghdl_of_long_runs, run};
use efsat::artefact::{DesignFilesError, FileSet, Packaging, Prefix, design_files_with};
use efsat::design::{Design, Probes};
use efsat::engine::artefact::{EngineDesign, EngineExtras, engine_design_files_with};
use efsat::engine::params::{EngineParams, Memory};
use efsat::params::{Method, Params, Transform, Upper};
use efsat_hardware::tools::Tool;
use rayon::prelude::*;

fn unit(params: &Params) -> FileSet {
    let design = Design::new(params, Probes::None).unwrap();
    design_files_with(&design, &Packaging { registers: true, ..Packaging::default() }, "efsat generate").unwrap()
}

fn engine(design: &EngineDesign) -> FileSet {
    let extras = EngineExtras { registers: true, ..EngineExtras::default() };
    engine_design_files_with(design, &Prefix::default(), "efsat generate --engine", "", &extras).unwrap()
}

fn block_ram() -> EngineParams {
    EngineParams { memory: Memory::BlockRam, block_lines: 256, triangle_lines: 256, ..EngineParams::default() }
}

fn tiny() -> Params {
    Params { width: 8, transform_width: 10, ..Params::default() }
}

/// A set of files in a folder, analysed.
fn bench(tool: Option<&'static Tool>, files: &FileSet) -> Option<Ghdl> {
    Some(analysed(tool?, files, &list(files)))
}

/// Its VHDL files in the order of analysis.
fn list(files: &FileSet) -> Vec<&str> {
    files.get("files-synthesis.txt").unwrap().lines().chain(["efsat_registers_tb.vhd"]).collect()
}

/// What the testbench says of registers that are changed from one text to another.
fn said_of(right: &Ghdl, files: &FileSet, (from, to): (&str, &str)) -> String {
    said(&right.changed(files, &list(files), ("efsat_registers.vhd", from, to)).0, &PASS)
}

/// What the testbench says; it is right if it compared words and found no mismatch.
fn said(bench: &Ghdl, options: &[&str]) -> String {
    bench.run("efsat_registers_tb", &[&["--ieee-asserts=disable-at-0"], options].concat()).1
}

fn fine(report: &str) -> bool {
    let line = report.lines().find(|line| line.contains("efsat_registers_tb: words "));
    let words =
        line.and_then(|line| line.split_whitespace().skip_while(|word| *word != "words").nth(1)?.parse::<usize>().ok());
    words.is_some_and(|words| words > 100) && report.contains(" mismatches 0") && !report.contains("metavalue")
}

#[test]
fn the_unit_answers_a_processor_as_the_reference_model() {
    let wide =
        Params { transform_width: 33, tag_width: 40, transform: Transform::Translate, upper: Upper::Sticky, ..tiny() };
    let bare = Params { transform: Transform::Off, tag_width: 0, ..tiny() };
    let determinants = Params { method: Method::Determinants, ..tiny() };
    let wrong: Vec<String> = share(4, [tiny(), Params { tag_width: 34, ..wide }, bare, determinants])
        .par_iter()
        .filter_map(|params| {
            let report = said(&bench(ghdl_of_long_runs(), &unit(params))?, if full() { &[] } else { &PASS });
            (!fine(&report)).then(|| format!("{}: {report}", params.command_line()))
        })
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
#[ignore = "compiles an engine; the same registers are around a unit on every change: scripts/test full"]
fn the_engine_answers_a_processor_as_the_reference_model() {
    let narrow = EngineParams { axi_id_bits: 4, memory_width: 32, ..axi() };
    let cases = [(axi(), false), (narrow, false), (block_ram(), false), (axi(), true)];
    let wrong: Vec<String> = cases
        .par_iter()
        .filter_map(|(params, by_number)| {
            let make = if *by_number { EngineDesign::by_number } else { EngineDesign::new };
            let design = make(params, &small()).unwrap();
            let report = said(&bench(ghdl_of_long_runs(), &engine(&design))?, &[]);
            (!fine(&report)).then(|| format!("{}: {report}", design.command_line()))
        })
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// One pass, and an end soon after nothing comes any more.
const PASS: [&str; 2] = ["-gpasses=1", "-gpatience=2000"];

/// Changes of the registers around the unit.
const MISTAKES: [(&str, &str); 24] = [
    ("refused_unaligned when write_address", "refused_not when write_address"),
    ("refused_unknown when read_known", "refused_not when read_known"),
    ("refused_partial when write_whole", "refused_not when write_whole"),
    ("refused_direction when read_legal", "refused_not when read_legal"),
    ("write_done <= writes when write_refusal = refused_not else '0';", "write_done <= writes;"),
    ("count := count + 1;", "null;"),
    ("refused_address <= write_address;", "null;"),
    ("transmit_full <= transmit_level(place_bits);", "transmit_full <= '1' when transmit_level = places - 1 else '0';"),
    ("receive_full <= receive_level(place_bits);", "receive_full <= '0';"),
    ("transmit_there and enable;", "transmit_there;"),
    ("<= receive_there and oldest", "<= receive_there and not oldest"),
    ("read_done when read_address = receive_high_at", "read_done when read_address = receive_low_at"),
    ("(pending and not cleared) or events;", "pending or events;"),
    ("if (pending and mask) /= no_interrupts", "if pending /= no_interrupts"),
    ("receive_level >= receive_threshold", "receive_level > receive_threshold"),
    ("transmit_level <= transmit_threshold", "transmit_level < transmit_threshold"),
    ("soft_reset <= write_word(control_soft_reset);", "null;"),
    ("open_packet <= '0';\n        end if;", "null;\n        end if;"),
    ("fault_event <= s_axis_tdata(last_report_fault);", "null;"),
    ("answer_event <= receive_push and s_axis_tlast;", "answer_event <= '0';"),
    ("pair_count <= pair_count + 1;", "null;"),
    ("packets_in <= packets_in + 1;", "null;"),
    ("transmit_ends & write_word & transmit_low", "transmit_ends & transmit_low & write_word"),
    ("write_address_there <= '1';", "null;"),
];

#[test]
#[ignore = "compiles a unit for each mistake: scripts/test full"]
fn mistakes_in_the_registers_are_noticed() {
    let files = unit(&small());
    let Some(right) = bench(ghdl_of_long_runs(), &files) else { return };
    assert!(fine(&said(&right, &PASS)));
    let unnoticed: Vec<&str> =
        MISTAKES.par_iter().filter_map(|change| fine(&said_of(&right, &files, *change)).then_some(change.0)).collect();
    assert!(unnoticed.is_empty(), "{}", unnoticed.join("\n"));
}

/// A soft reset of the engine in a part of a packet: without the last word that the shell gives it, the next packet would be lost.
#[test]
#[ignore = "takes long: scripts/test full"]
fn mistakes_around_the_engine_are_noticed() {
    let mistakes = [
        ("closing <= stays_open;", "closing <= '0';"),
        ("ended_pairs <= packet_words - (report_words - 1);", "ended_pairs <= packet_words;"),
        ("query_count <= query_count + 1;", "null;"),
    ];
    let files = engine(&EngineDesign::new(&block_ram(), &small()).unwrap());
    let Some(right) = bench(ghdl_of_long_runs(), &files) else { return };
    assert!(fine(&said(&right, &PASS)));
    let unnoticed: Vec<&str> = share(3, mistakes)
        .par_iter()
        .filter_map(|change| fine(&said_of(&right, &files, *change)).then_some(change.0))
        .collect();
    assert!(unnoticed.is_empty(), "{}", unnoticed.join("\n"));
}

/// The header compiles as C99 and as C++; address, mask and value after reset of every register are those of the VHDL and the SVD file.
#[test]
fn header_constants_and_description_agree() {
    let set = engine(&EngineDesign::new(&axi(), &small()).unwrap());
    let (map, header) = (set.get("efsat_register_map.vhd").unwrap(), set.get("host/efsat_registers.h").unwrap());
    let svd = set.get("efsat_registers.svd").unwrap();
    let constants: Vec<(&str, &str)> = map
        .lines()
        .filter_map(|line| line.trim().strip_prefix("constant ")?.split_once(" : register_address := x\""))
        .map(|(name, value)| (name.strip_suffix("_at").unwrap(), value.trim_end_matches("\";")))
        .collect();
    assert!(constants.len() > 20);
    for (name, at) in constants {
        let upper = name.to_uppercase();
        assert!(header.contains(&format!("#define EFSAT_REGISTERS_{upper} 0x{at}\n")), "{name}");
        let reset = map.split(&format!("constant {name}_reset : register_word := x\"")).nth(1).unwrap();
        let reset = &reset[..8];
        assert!(header.contains(&format!("#define EFSAT_REGISTERS_{upper}_RESET UINT32_C(0x{reset})\n")), "{name}");
        let register = svd.split(&format!("<name>{name}</name>")).nth(1).unwrap().split("</register>").next().unwrap();
        assert!(register.contains(&format!("<addressOffset>0x{at}</addressOffset>")), "{name}");
        assert!(register.contains(&format!("<resetValue>0x{reset}</resetValue>")), "{name}");
    }
}

#[test]
fn words_that_the_registers_cannot_carry_are_refused() {
    let design = Design::new(&Params { tag_width: 64, ..tiny() }, Probes::None).unwrap();
    let refused =
        |packaging| matches!(design_files_with(&design, &packaging, ""), Err(DesignFilesError::Registers { .. }));
    assert!(refused(Packaging { registers: true, ..Packaging::default() }));
    assert!(!refused(Packaging::default()));
    let home = tempfile::tempdir().unwrap();
    refuses(
        home.path(),
        "generate --registers --stream-width 128 --out x",
        "--registers: words of 128 bits in and 64 out; expected 64 in and at most 64 out",
    );
    let message = "--registers: --engines 2; expected one engine, whose answers come in order";
    refuses(home.path(), "generate --engine --engines 2 --registers --out x", message);
    succeeds(home.path(), "generate --registers --out x --width 8 --transform-width 10");
    succeeds(home.path(), "generate --check --registers --out x --width 8 --transform-width 10");
    compiles_everywhere(&home.path().join("x/host/efsat_registers.h"));
    // The functions that send and receive, against a model of the queues.
    std::fs::write(home.path().join("host.c"), include_str!("registers/host.c")).unwrap();
    run(home.path(), "cc", &[CHECKED, &["-Ix/host", "host.c", "-o", "host"]].concat());
    let said = run(home.path(), home.path().join("host").to_str().unwrap(), &[]);
    assert!(said.contains("200 packets, all as sent"), "{said}");
}
