//! Synthesis with open tools: predicted and actual cells, netlists against the reference model, a routed clock.
//!
//! Tests whose tools are not installed say so on standard error and check nothing.

use efsat::artefact::{vhdl_files, Stimulus};
use efsat::cosim::{self, Netlist, Options, Simulator};
use efsat::design::Design;
use efsat::params::{Params, Transform};
use efsat::synth::{self, Flow, Report, SynthError, Unit};
use efsat::verilog::{self, tools, ToolError};
use serde_json::Value;
use std::process::{Command, Output};
use tempfile::TempDir;

/// A small design that has every unit.
fn small() -> Params {
    Params { width: 8, transform_width: 10, ..Params::default() }
}

/// Whether an error means that a tool is not installed, which is then said.
fn skipped(e: &dyn std::fmt::Display) -> bool {
    let missing = e.to_string().contains("is not installed");
    if missing {
        eprintln!("skipped: {e}");
    }
    missing
}

/// Answers that differ from the reference model's in a run on Verilator; none if a tool is missing.
fn mismatches(params: &Params, count: usize, netlist: Netlist) -> Option<u64> {
    let stimulus = Stimulus::random(params, count, 2009);
    let options = Options { simulator: Simulator::Verilator(netlist), keep: None, wave: None, probe: false };
    match cosim::run(params, "", &stimulus, &options) {
        Ok(report) => {
            assert_eq!(report.vectors, count as u64);
            assert_eq!(report.initiation_interval, params.interval() as u64);
            Some(report.mismatches)
        }
        Err(e) if skipped(&e) => None,
        Err(e) => panic!("{e}"),
    }
}

#[test]
fn netlists_answer_as_the_reference_model() {
    let sticky = Params { width: 12, transform_width: 14, upper: efsat::params::Upper::Sticky, ..Params::default() };
    let wide = Params { transform: Transform::Translate, axes_per_clock: 2, tag_width: 40, ..Params::default() };
    let found: Vec<_> = [small(), sticky, wide].iter().map(|p| mismatches(p, 20_000, Netlist::Rtl)).collect();
    assert!(found.iter().all(|n| n.is_none_or(|n| n == 0)), "{found:?}");
}

#[test]
fn a_mapped_netlist_answers_as_the_reference_model() {
    let params = Params { width: 6, transform_width: 6, transform: Transform::Off, ..Params::default() };
    assert!(mismatches(&params, 2000, Netlist::Mapped).is_none_or(|n| n == 0));
}

/// One sum of the netlist made a difference, the run goes on and answers differ.
#[test]
fn a_mutated_netlist_is_noticed() {
    let params = Params { width: 6, transform_width: 6, transform: Transform::Off, ..Params::default() };
    let dir = TempDir::new().unwrap();
    let stimulus = Stimulus::random(&params, 2000, 2009);
    let simulator = Simulator::Verilator(Netlist::Rtl);
    let options = Options { simulator, keep: Some(dir.path().to_owned()), wave: None, probe: false };
    match cosim::run(&params, "", &stimulus, &options) {
        Err(e) if skipped(&e) => return,
        report => assert_eq!(report.unwrap().mismatches, 0),
    }
    let netlist = dir.path().join("netlist.v");
    let text = std::fs::read_to_string(&netlist).unwrap();
    let unit = text.find("module axis_subtract").or(text.find("module cross_product")).unwrap();
    let sum = unit + text[unit..].find(" - ").unwrap();
    std::fs::write(&netlist, format!("{} + {}", &text[..sum], &text[sum + 3..])).unwrap();
    let make = Command::new("verilator")
        .args(["--cc", "--exe", "--build", "-Wno-fatal", "--top-module", "efsat", "--Mdir", "mutant"])
        .args(["-o", "mutant", "netlist.v", "efsat_tb.cpp"])
        .current_dir(dir.path())
        .output()
        .unwrap();
    assert!(make.status.success(), "{}", String::from_utf8_lossy(&make.stderr));
    let run = Command::new(dir.path().join("mutant/mutant")).current_dir(dir.path()).output().unwrap();
    let said = String::from_utf8_lossy(&run.stdout).into_owned();
    assert!(said.contains("efsat_tb: mismatch at vector"), "{said}");
}

fn report(params: &Params, flow: Flow, seeds: u32) -> Option<Report> {
    match synth::run(params, "", &synth::Options { flow, seeds, keep: None }, &|_| ()) {
        Ok(report) => Some(report),
        Err(SynthError::Tool(e @ ToolError::Missing { .. })) if skipped(&e) => None,
        Err(e) => panic!("{e}"),
    }
}

/// The counts of a unit are at least those of its parts.
fn adds_up(unit: &Unit) {
    let parts: u64 = unit.parts.iter().map(|part| part.actual.unwrap().resources.luts * part.instances).sum();
    assert!(unit.actual.unwrap().resources.luts >= parts, "{}", unit.entity);
    unit.parts.iter().for_each(adds_up);
}

#[test]
fn virtex_ii_has_the_predicted_multipliers() {
    let params = small();
    let Some(report) = report(&params, Flow::Virtex2, 0) else { return };
    let design = Design::new(&params, false).unwrap();
    let actual = report.top.actual.unwrap();
    assert_eq!(actual.resources.multipliers, design.top.multipliers() as u64);
    // All products are registered, and nothing else than registers stands behind them.
    assert_eq!(actual.registered_multipliers, actual.resources.multipliers);
    assert!(actual.absorbed_flip_flops >= 16 * actual.registered_multipliers);
    assert!(actual.resources.memory_luts > 0 && report.routed.is_none());
    adds_up(&report.top);
    let faults = report.faults(params.frequency);
    assert_eq!(faults, Vec::<String>::new());
}

#[test]
fn ecp5_is_placed_and_routed() {
    let params = Params { width: 6, transform_width: 6, transform: Transform::Off, tag_width: 0, ..Params::default() };
    let Some(report) = report(&params, Flow::Ecp5, 1) else { return };
    let routed = report.routed.as_ref().unwrap();
    let seed = routed.middle();
    assert!((20.0..500.0).contains(&routed.median()), "{routed:?}");
    assert_eq!(seed.used["MULT18X18D"], report.cells().multipliers);
    // The path is told in names of the design and is as long as the clock says.
    let (ns, names) = (seed.critical.logic() + seed.critical.routing(), &seed.critical.steps);
    assert!((ns - 1000.0 / seed.megahertz).abs() < 0.1, "{ns} ns, {} MHz", seed.megahertz);
    assert!(names.len() >= 2 && names[..names.len() - 1].iter().all(|step| !step.signal.contains('$')), "{names:?}");
    // A clock that is out of reach is a fault.
    assert_eq!(report.faults(500).iter().filter(|fault| fault.contains("MHz instead of 500")).count(), 1);
}

fn efsat(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_efsat")).args(args).output().unwrap()
}

#[test]
fn the_command_prints_what_was_counted() {
    if verilog::ghdl().is_err() || verilog::yosys::find().is_err() {
        return eprintln!("skipped: GHDL or Yosys is not installed");
    }
    let params = ["--width", "6", "--transform-width", "6", "--transform", "off", "--tag-width", "0"];
    let dir = TempDir::new().unwrap();
    let keep = dir.path().to_str().unwrap();
    let output = efsat(&[&["synth", "--json", "--keep", keep], &params[..]].concat());
    let value: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(value["flow"], "yosys-xc2v");
    assert_eq!(value["units"]["entity"], "efsat");
    for field in ["multipliers", "luts", "memory_luts", "flip_flops", "carry"] {
        assert!(value["units"]["actual"][field].is_u64(), "{field}");
        assert!(value["units"]["parts"][0]["predicted"][field].is_u64(), "{field}");
    }
    assert!(value["clock"]["scheduled"].as_f64().unwrap() >= 100.0);
    assert_eq!(output.status.code(), Some(i32::from(!value["faults"].as_array().unwrap().is_empty())));
    for name in ["efsat.v", "units.ys", "units.log", "units.json"] {
        assert!(dir.path().join(name).is_file(), "{name}");
    }
    // What is kept is synthesised again only where it is ours.
    let foreign = TempDir::new().unwrap();
    std::fs::write(foreign.path().join("letter.txt"), "").unwrap();
    let refused = efsat(&["synth", "--keep", foreign.path().to_str().unwrap()]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&refused.stderr).contains("holds files that efsat did not write"));
}

#[test]
fn wrong_options_are_told() {
    let cases: [(&[&str], &str); 6] = [
        (&["synth", "--flow", "quartus"], "legal is one of yosys-xc2v, yosys-xc6s, yosys-xc7, ecp5"),
        (&["synth", "--flow", "yosys-xc7", "--seeds", "3"], "--seeds: flow yosys-xc7 ends after Yosys"),
        (&["synth", "--no-route"], "--no-route: flow yosys-xc2v ends after Yosys"),
        (&["synth", "--flow", "ecp5", "--seeds", "0"], "legal is a whole number from 1 to 32"),
        (&["cosim", "--netlist", "rtl"], "--netlist needs --simulator verilator, not ghdl"),
        (&["cosim", "--simulator", "verilator", "--probe"], "--probe needs --simulator ghdl, nvc or builtin"),
    ];
    let wrong = cases.iter().filter(|(args, message)| {
        let output = efsat(args);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        output.status.code() != Some(2) || !said.contains(message) || said.lines().count() != 1
    });
    assert_eq!(wrong.collect::<Vec<_>>(), Vec::<&(&[&str], &str)>::new());
}

#[test]
fn a_missing_tool_is_named() {
    let empty = TempDir::new().unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_efsat"))
        .args(["synth", "--width", "8", "--transform-width", "8"])
        .env("PATH", empty.path())
        .env_remove(tools::FOLDER)
        .current_dir(empty.path())
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2));
    assert!(said.starts_with("error: Yosys is not installed: apt-get install yosys"), "{said}");
}

/// What the VHDL of the default design becomes has the signed products that it was written with.
#[test]
fn products_stay_signed() {
    let files = vhdl_files(&Design::new(&small(), false).unwrap(), "").unwrap();
    let dir = TempDir::new().unwrap();
    match verilog::from_vhdl(&files, "efsat", dir.path()) {
        Ok(text) => assert!(text.matches("$signed(").count() >= 2 && !text.contains("// smul")),
        Err(e) => assert!(skipped(&e), "{e}"),
    }
}
