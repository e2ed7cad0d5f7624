//! Synthesis with open tools: predicted and actual cells, netlists against the reference model, a routed clock.
//!
//! Tests whose tools are not installed say so on standard error and check nothing.

use crate::extent::{full, share};
use crate::tools::made;
use crate::tools::program::{efsat, object, refuses, without_tools};
use efsat::artefact::{Stimulus, vhdl_files};
use efsat::design::{Design, Probes};
use efsat::device;
use efsat::estimate;
use efsat::evidence::cosim::{self, Netlist, Options, Simulator};
use efsat::evidence::synth::{self, Flow, Placer, Report, Routed, Subject, verilog, yosys};
use efsat::params::{Method, Params, Projections, Transform};
use serde_json::Value;
use std::path::Path;
use std::process::Command;
use std::time::Duration;
use tempfile::TempDir;

/// A small design that has every unit.
fn small() -> Params {
    Params { width: 8, transform_width: 10, ..Params::default() }
}

/// Answers that differ from the reference model's in a run on Verilator; none if a tool is missing.
fn mismatches(params: &Params, count: usize, netlist: Netlist) -> Option<u64> {
    let stimulus = Stimulus::random(params, count, 2009);
    let options = Options { simulator: Simulator::Verilator(netlist), keep: None, wave: None, probe: false };
    let report = made(cosim::run(params, "", &stimulus, &options))?;
    assert_eq!(report.vectors, count as u64);
    assert_eq!(report.initiation_interval, params.interval() as u64);
    Some(report.mismatches)
}

#[test]
#[ignore = "compiles a netlist; engine_clocks:: compiles another on every change: scripts/test full"]
fn netlists_answer_as_the_reference_model() {
    let other = Params {
        width: 12,
        transform_width: 14,
        upper: efsat::params::Upper::Sticky,
        transform: Transform::Translate,
        axes_per_clock: 2,
        tag_width: 40,
        ..Params::default()
    };
    let found: Vec<_> = share(2, [other, small()])
        .iter()
        .map(|p| mismatches(p, if full() { 20_000 } else { 4_000 }, Netlist::Rtl))
        .collect();
    assert!(found.iter().all(|n| n.is_none_or(|n| n == 0)), "{found:?}");
}

/// Answers that differ on a device's cells. 9 bits are the fewest whose products take a multiplier on every device.
fn mapped_mismatches(device: &str, frequency: u32) -> Option<u64> {
    let params = Params { width: 9, transform_width: 9, transform: Transform::Off, frequency, ..Params::default() };
    mismatches(&Params { device: device.to_owned(), ..params }, 2000, Netlist::Mapped)
}

#[test]
#[ignore = "a minute or more: scripts/test full"]
fn cells_of_virtex_ii_answer_as_the_reference_model() {
    assert!(mapped_mismatches("xc2v6000-4", 100).is_none_or(|n| n == 0));
}

/// The registers of products are in the multipliers, and choices take two clocks.
#[test]
#[ignore = "a minute or more: scripts/test full"]
fn cells_of_ecp5_answer_as_the_reference_model() {
    assert!(mapped_mismatches("lfe5u-85-6", 150).is_none_or(|n| n == 0));
}

/// The same, and products of 9 bits are of MULT9X9.
#[test]
#[ignore = "a minute or more: scripts/test full"]
fn cells_of_nexus_answer_as_the_reference_model() {
    assert!(mapped_mismatches("lifcl-40-9", 150).is_none_or(|n| n == 0));
}

/// Sums of products are in the multipliers, differences too.
#[test]
#[ignore = "a minute or more: scripts/test full"]
fn cells_of_the_7_series_answer_as_the_reference_model() {
    let params = Params { width: 9, transform_width: 9, transform: Transform::Off, ..Params::default() };
    let device = "xc7a200t-1".to_owned();
    let params = Params { method: Method::Determinants, clocks_per_pair: 2, frequency: 200, device, ..params };
    assert!(mismatches(&params, 2000, Netlist::Mapped).is_none_or(|n| n == 0));
}

/// One sum of the netlist made a difference, the run goes on and answers differ.
#[test]
#[ignore = "the check itself: scripts/test full"]
fn a_mutated_netlist_is_noticed() {
    let params = Params { width: 6, transform_width: 6, transform: Transform::Off, ..Params::default() };
    let dir = TempDir::new().unwrap();
    let stimulus = Stimulus::random(&params, 2000, 2009);
    let simulator = Simulator::Verilator(Netlist::Rtl);
    let options = Options { simulator, keep: Some(dir.path().to_owned()), wave: None, probe: false };
    let Some(report) = made(cosim::run(&params, "", &stimulus, &options)) else { return };
    assert_eq!(report.mismatches, 0);
    let netlist = dir.path().join("netlist.v");
    let text = std::fs::read_to_string(&netlist).unwrap();
    let unit = text.find("module axis_subtract").or(text.find("module cross_product")).unwrap();
    let sum = unit + text[unit..].find(" - ").unwrap();
    std::fs::write(&netlist, format!("{} + {}", &text[..sum], &text[sum + 3..])).unwrap();
    let make = Command::new("verilator")
        .args(["--cc", "--exe", "--build", "-Wno-fatal", "--top-module", "efsat", "--Mdir", "mutant"])
        .args(["-MAKEFLAGS", "OPT_FAST=-O0", "-o", "mutant", "netlist.v", "efsat_tb.cpp"])
        .current_dir(dir.path())
        .output()
        .unwrap();
    assert!(make.status.success(), "{}", String::from_utf8_lossy(&make.stderr));
    let run = Command::new(dir.path().join("mutant/mutant")).current_dir(dir.path()).output().unwrap();
    let said = String::from_utf8_lossy(&run.stdout).into_owned();
    assert!(said.contains("efsat_tb: mismatch at vector"), "{said}");
}

/// What places the cells, whether nets are routed again, and the clock that is asked for.
type Way = (Placer, bool, Option<u32>);

fn report(params: &Params, seeds: u32, (placer, reroute, route_for): Way, keep: Option<&Path>) -> Option<Report> {
    let (flow, keep) = (Flow::of(device::find(&params.device).unwrap()), keep.map(Path::to_owned));
    let design = Design::new(params, Probes::None).unwrap();
    let subject = Subject::Unit(&design);
    let limit = Duration::from_secs(600);
    made(synth::run(&subject, "", &synth::Options { flow, seeds, limit, route_for, placer, reroute, keep }, &|_| ()))
}

/// The counts of a unit are at least those of its parts.
fn adds_up(unit: &Value) {
    let luts = |unit: &Value| unit["actual"]["luts"].as_u64().unwrap();
    let parts = unit["parts"].as_array().unwrap();
    let in_parts: u64 = parts.iter().map(|part| luts(part) * part["instances"].as_u64().unwrap()).sum();
    assert!(luts(unit) >= in_parts, "{}", unit["entity"]);
    parts.iter().for_each(adds_up);
}

/// A design that is placed within a minute.
fn smallest_on(device: &str) -> Params {
    let params = Params { width: 6, transform_width: 6, tag_width: 0, device: device.to_owned(), ..Params::default() };
    Params { projections: Projections::Skip, renormalise: false, transform: Transform::Off, ..params }
}

#[test]
fn multipliers_of_ecp5_and_nexus_are_the_predicted_with_their_registers() {
    for device in share(2, ["lfe5u-85-6", "lifcl-40-9"]) {
        let Some(report) = report(&smallest_on(device), 0, (Placer::Static, false, None), None) else { return };
        let (predicted, cells) = (report.top.predicted, report.top.actual.unwrap());
        let multipliers = predicted.multipliers;
        assert_eq!((cells.resources.multipliers, cells.registered_multipliers), (multipliers, multipliers), "{device}");
        assert!(predicted.flip_flops.abs_diff(cells.resources.flip_flops) <= 3, "{device}: {cells:?}");
    }
}

#[test]
#[ignore = "a minute or more: scripts/test full"]
fn ecp5_is_placed_and_routed() {
    for way in [(Placer::Static, true, None), (Placer::Heap, false, Some(60))] {
        let dir = TempDir::new().unwrap();
        let Some(report) = report(&smallest_on("lfe5u-85-6"), 1, way, Some(dir.path())) else { return };
        let routed = report.routed.as_ref().unwrap();
        assert_eq!(routed.asked, way.2.unwrap_or(100));
        let seed = routed.middle().unwrap();
        assert!((20.0..500.0).contains(&seed.megahertz), "{routed:?}");
        let multipliers = report.cells().multipliers;
        assert_eq!(seed.used["MULT18X18D"], multipliers);
        // Every product's register is in its multiplier in what was placed.
        let packed = std::fs::read_to_string(dir.path().join("packed.json")).unwrap();
        assert_eq!(packed.matches("\"REG_OUTPUT_CLK\":\"CLK0\"").count() as u64, multipliers);
        // The path is told in names of the design and is as long as the clock says.
        let (ns, names) = (seed.critical.logic() + seed.critical.routing(), &seed.critical.steps);
        assert!((ns - 1000.0 / seed.megahertz).abs() < 0.1, "{ns} ns, {} MHz", seed.megahertz);
        assert!(
            names.len() >= 2 && names[..names.len() - 1].iter().all(|step| !step.signal.contains('$')),
            "{names:?}"
        );
        // A clock that is out of reach is a fault.
        let hopeless = Report { routed: Some(Routed { asked: 500, ..routed.clone() }), ..report };
        assert_eq!(hopeless.faults().iter().filter(|fault| fault.contains("MHz instead of 500")).count(), 1);
    }
}

/// The options of [`small`].
const SMALL: &str = "--width 8 --transform-width 10";

#[test]
#[ignore = "a minute or more: scripts/test full"]
fn an_engine_has_the_multipliers_of_its_units_and_fits() {
    if made(verilog::ghdl()).is_none() || made(yosys::find()).is_none() {
        return;
    }
    let value = object(".", "synth --engine --json");
    assert_eq!(value["faults"], Value::Array(vec![]));
    adds_up(&value["units"]);
    let (top, capacity) = (&value["units"], &value["capacity"]);
    for kind in ["multipliers", "luts", "flip_flops"] {
        let (used, there) = (top["actual"][kind].as_f64().unwrap(), capacity[kind].as_f64().unwrap());
        assert!(used > 0.0 && used < 0.6 * there, "{kind}: {used} of {there}");
        let predicted = top["predicted"][kind].as_f64().unwrap();
        assert!((predicted / used - 1.0).abs() <= 0.1, "{kind}: {predicted} instead of {used}");
    }
    let block_rams = top["actual"]["block_rams"].as_u64().unwrap();
    assert!((1..144).contains(&block_rams), "{block_rams} block RAMs");
}

#[test]
#[ignore = "Yosys for half a minute; another part is tried on every change: scripts/test full"]
fn virtex_ii_has_the_predicted_cells() {
    if made(verilog::ghdl()).is_none() || made(yosys::find()).is_none() {
        return;
    }
    let dir = TempDir::new().unwrap();
    let value = object(".", &format!("synth --json --keep {} {SMALL}", dir.path().display()));
    assert_eq!(value["faults"], Value::Array(vec![]));
    assert_eq!((&value["flow"], &value["units"]["entity"]), (&Value::from("yosys-xc2v"), &Value::from("efsat")));
    let count = |kind: &str, field: &str| value["units"][kind][field].as_u64().unwrap();
    for field in ["multipliers", "luts", "memory_luts", "flip_flops", "carry"] {
        let (predicted, actual) = (count("predicted", field) as f64, count("actual", field) as f64);
        assert!(actual > 0.0 && (predicted / actual - 1.0).abs() <= 0.15, "{field}: {predicted} instead of {actual}");
    }
    // All products are registered, and nothing else than registers stands behind them.
    let multipliers = Design::new(&small(), Probes::None).unwrap().top.multipliers() as u64;
    assert_eq!((count("actual", "multipliers"), count("actual", "registered_multipliers")), (multipliers, multipliers));
    assert!(count("actual", "absorbed_flip_flops") >= 16 * multipliers);
    adds_up(&value["units"]);
    assert!(value["slices"]["estimate"].as_u64() > value["slices"]["dense"].as_u64());
    let clock = &value["clock"];
    assert!(clock["scheduled"].as_f64().unwrap() >= 100.0 && clock["median"].is_null());
    assert!(clock["estimated"]["path"].as_array().unwrap().len() >= 2);
    for name in ["efsat.v", "units.ys", "units.log", "units.json"] {
        assert!(dir.path().join(name).is_file(), "{name}");
    }
}

#[test]
fn a_foreign_folder_is_refused() {
    let foreign = TempDir::new().unwrap();
    std::fs::write(foreign.path().join("letter.txt"), "").unwrap();
    let (status, _, said) = efsat(&foreign, "synth --keep .");
    // Without Yosys that is said first.
    assert!(said.contains("holds files that efsat did not write") || said.contains("is not installed"), "{said}");
    assert_eq!(status, Some(2));
}

/// The model's counts need no tool, and are the ones beside which a tool's are set.
#[test]
fn predictions_need_no_tools() {
    let empty = TempDir::new().unwrap();
    let (status, output, errors) = without_tools(&empty, &format!("synth --predict --json {SMALL}"));
    assert_eq!((status, errors.as_str()), (Some(0), ""));
    let value: Value = serde_json::from_str(&output).unwrap();
    let design = Design::new(&small(), Probes::None).unwrap();
    let resources = estimate::whole(&design.top, design.device);
    assert_eq!(value["units"]["predicted"]["luts"], resources.luts);
    assert_eq!(value["units"]["predicted"]["flip_flops"], resources.flip_flops);
    assert_eq!((&value["latency"], &value["initiation_interval"]), (&design.latency.into(), &design.interval.into()));
    assert!(value["units"]["actual"].is_null() && value["clock"]["estimated"].is_null());
}

#[test]
fn wrong_options_are_told() {
    let cases = [
        ("synth --flow quartus", "expected one of yosys-xc2v, yosys-xc6s, yosys-xc7, yosys-xcup, ecp5, nexus"),
        ("synth --flow yosys-xc7 --seeds 3", "--seeds: flow yosys-xc7 ends after Yosys"),
        ("synth --predict --keep x", "'--predict' cannot be used with '--keep <DIR>'"),
        ("synth --minutes 3", "--minutes: flow yosys-xc2v ends after Yosys; expected --flow ecp5"),
        ("synth --flow ecp5 --minutes 0", "expected a whole number from 1 to 1440"),
        ("synth --placer heap", "--placer: flow yosys-xc2v ends after Yosys"),
        ("synth --reroute", "--reroute: flow yosys-xc2v ends after Yosys"),
        ("synth --route-for 100", "--route-for: flow yosys-xc2v ends after Yosys"),
        ("synth --flow ecp5 --no-route --route-for 100", "cannot be used with '--route-for <MHZ>'"),
        ("synth --flow ecp5 --predict --route-for 100", "cannot be used with '--route-for <MHZ>'"),
        ("synth --flow ecp5 --route-for 1", "expected a whole number from 20 to 400"),
        ("synth --flow ecp5 --placer annealing", "expected one of static, heap"),
        ("synth --no-route", "--no-route: flow yosys-xc2v ends after Yosys"),
        ("synth --flow ecp5 --seeds 0", "expected a whole number from 1 to 32"),
        ("cosim --netlist rtl", "--netlist needs --simulator verilator, not ghdl"),
        ("cosim --simulator verilator --probe", "--probe needs --simulator ghdl, nvc or builtin"),
    ];
    for (line, part) in cases {
        refuses(".", line, part);
    }
}

#[test]
fn a_missing_tool_is_named() {
    let empty = TempDir::new().unwrap();
    let (status, _, said) = without_tools(&empty, "synth --width 8 --transform-width 8");
    assert_eq!(status, Some(2));
    assert!(said.starts_with("error: Yosys is not installed: apt-get install yosys"), "{said}");
}

/// What the VHDL of the default design becomes has the signed products that it was written with.
#[test]
fn products_stay_signed() {
    let files = vhdl_files(&Design::new(&small(), Probes::None).unwrap(), &Default::default(), "").unwrap();
    let dir = TempDir::new().unwrap();
    let Some(text) = made(verilog::from_vhdl(&files, "efsat", dir.path())) else { return };
    assert!(text.matches("$signed(").count() >= 2 && !text.contains("// smul"));
}
