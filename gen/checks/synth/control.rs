//! The control of engines as predicted and as Yosys maps it, entity by entity, around units without contents.

use super::units::{self, Unit};
use super::{Flow, VERILOG, verilog, yosys};
use efsat_engine::artefact::cells::WITHIN;
use efsat_engine::artefact::{EngineDesign, NAME, engine_files};
use efsat_engine::params::{EngineParams, Memory};
use efsat_geometry::directions::Directions;
use efsat_hardware::device;
use efsat_hardware::testing::{full, skip};
use efsat_unit::artefact::Prefix;
use efsat_unit::params::{Method, Params};

/// Part by which an entity of some size may differ; all of them together may by [`WITHIN`].
const OF_ONE: f64 = 0.25;
/// Cells of any kind by which an entity may differ whatever its size.
const FEW: f64 = 20.0;
/// Part by which flip-flops and look-up tables as memory may, which are counted.
const OF_COUNTED: f64 = 0.05;

/// An entity without contents, for what is not looked at.
fn hollow(text: &str, name: &str) -> String {
    let end = format!("end entity {name};");
    let head = &text[..text.find(&end).unwrap()];
    format!("{head}{end}\narchitecture rtl of {name} is\nbegin\nend architecture rtl;\n")
}

/// The control of an engine, mapped, with some entities hollow.
fn mapped(design: &EngineDesign, name: &str, without: &[&str]) -> Unit {
    let device = device::find(name).unwrap();
    let (flow, dir) = (Flow::of(device), tempfile::TempDir::new().unwrap());
    let mut sources = engine_files(design, &Prefix::default(), "").unwrap();
    for (file, text) in &mut sources {
        let entity = file.trim_end_matches(".vhd");
        if without.contains(&entity) {
            *text = hollow(text, entity);
        }
    }
    let text = verilog::from_vhdl(&sources, design.top(), dir.path()).unwrap();
    std::fs::write(dir.path().join(VERILOG), text).unwrap();
    let netlist = units::netlist(&yosys::find().unwrap(), flow, design.top(), dir.path()).unwrap();
    let control = design.control(device);
    units::around(&control, &[], device, Some((&netlist, flow)))
}

/// An entity without its parts, predicted and mapped: LUTs, LUTs as memory, flip-flops.
fn own(unit: &Unit) -> [[f64; 3]; 2] {
    let kinds =
        |cells: efsat_hardware::device::Resources| [cells.luts, cells.memory_luts, cells.flip_flops].map(|n| n as f64);
    let mut found = [kinds(unit.predicted), kinds(unit.actual.unwrap().resources)];
    for part in &unit.parts {
        let inner = [kinds(part.predicted), kinds(part.actual.unwrap().resources)];
        for (sum, inner) in found.iter_mut().flatten().zip(inner.iter().flatten()) {
            *sum -= part.instances as f64 * inner;
        }
    }
    found
}

fn compare(unit: &Unit, without: &[&str], device: &str, wrong: &mut Vec<String>) {
    if without.contains(&unit.entity.as_str()) {
        return;
    }
    let [predicted, actual] = own(unit);
    for (kind, part) in [OF_ONE, OF_COUNTED, OF_COUNTED].into_iter().enumerate() {
        let (p, a) = (predicted[kind], actual[kind]);
        let few = if kind == 0 { FEW } else { 4.0 };
        if (p - a).abs() > f64::max(few, part * a) {
            let what = ["LUTs", "LUTs as memory", "flip-flops"][kind];
            wrong.push(format!("{device}, {}: {p} {what} instead of {a}", unit.entity));
        }
    }
    unit.parts.iter().for_each(|part| compare(part, without, device, wrong));
}

/// Units are hollow, of several engines these too.
fn check(design: &EngineDesign, devices: &[&str]) {
    if let Err(missing) = verilog::ghdl() {
        return skip(missing);
    }
    if let Err(missing) = yosys::find() {
        return skip(missing);
    }
    let several = design.params.engines > 1;
    let without = if several { &["efsat", "volume_unit", NAME][..] } else { &["efsat", "volume_unit"] };
    let mut wrong = vec![];
    for device in devices {
        let unit = mapped(design, device, without);
        compare(&unit, without, device, &mut wrong);
        if !several {
            let [predicted, actual] = [unit.predicted, unit.actual.unwrap().resources].map(|cells| cells.luts as f64);
            let part = (predicted / actual - 1.0).abs();
            assert!(100.0 * part <= f64::from(WITHIN), "{device}: {predicted} LUTs instead of {actual}");
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

const DEVICES: [&str; 3] = ["xc7a200t-1", "xc2v6000-4", "lfe5u-85-6"];

#[test]
#[ignore = "half a minute: scripts/test full"]
fn pairs_by_number_have_the_predicted_control() {
    let params = EngineParams { memory_width: 64, ..EngineParams::default() };
    check(&EngineDesign::by_number(&params, &Params::of(Method::Determinants)).unwrap(), &DEVICES);
}

#[test]
fn several_engines_have_the_predicted_control_around_them() {
    let params = EngineParams { engines: if full() { 4 } else { 2 }, ..EngineParams::default() };
    let devices = if full() { &DEVICES[..] } else { &DEVICES[..1] };
    check(&EngineDesign::new(&params, &params.unit()).unwrap(), devices);
}

#[test]
#[ignore = "a minute or more: scripts/test full"]
fn an_engine_has_the_predicted_control() {
    let params = EngineParams {
        stack: 256,
        tree_height: 24,
        in_flight: 32,
        pair_queue: 64,
        block_number_bits: 18,
        directions: Directions::Six,
        memory_width: 128,
        block_lines: 512,
        triangle_lines: 512,
        origin_bits: 15,
        expansion_clocks: 2,
        ..EngineParams::default()
    };
    let unit = Params { width: 12, transform_width: 28, ..params.unit() };
    check(&EngineDesign::new(&params, &unit).unwrap(), &DEVICES);
}

#[test]
#[ignore = "a minute or more: scripts/test full"]
fn engines_of_two_and_eight_queries_have_the_predicted_control() {
    for queries in [2, 8] {
        let params = EngineParams { queries, watchdog: 0, memory: Memory::Axi, ..EngineParams::default() };
        check(&EngineDesign::new(&params, &params.unit()).unwrap(), &DEVICES[..1]);
    }
}
