//! Verilator: the printed VHDL, synthesised to a netlist and compiled, under the same vectors as GHDL's testbench.
//!
//! The netlist is either what GHDL infers from the VHDL, or that mapped by Yosys to cells of the device's family and
//! simulated with models of the cells. There are two states only, so what GHDL's simulation says of unknown values stays
//! needed.

use super::external::{self, file_error};
use super::{CosimError, Netlist, Options, Run};
use crate::synth::tools::{self, Tool};
use crate::synth::{ToolError, verilog, yosys};
use askama::Template;
use efsat_unit::artefact::testbench::{self, RESET_CLOCKS};
use efsat_unit::artefact::vectors::{Word, formats_line};
use efsat_unit::artefact::{self, Prefix, Stimulus};
use efsat_unit::design::Design;
use efsat_unit::params::options::Choice;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// The Verilog that is compiled.
const NETLIST: &str = "netlist.v";

/// The Verilog of the VHDL, before mapping.
const SOURCE: &str = "efsat.v";

/// Name of the top entity.
const TOP: &str = "efsat";

/// The testbench.
const BENCH: &str = "efsat_tb.cpp";

/// What is compiled, in the folder `obj`.
const PROGRAM: &str = "simulation";

/// A port of the top and its place in a word.
struct Field {
    port: String,
    low: u32,
    bits: u32,
}

#[derive(Template)]
#[template(path = "efsat_tb.cpp", escape = "none")]
struct Bench {
    header: Vec<String>,
    formats: String,
    paced: usize,
    patience: usize,
    full_after: usize,
    reset_clocks: usize,
    pair: Vec<Field>,
    pose: Vec<Field>,
    answer: Vec<Field>,
    answer_bits: u32,
    tag_width: u32,
    tags: u64,
    interval: usize,
    latency: usize,
    two_stages: bool,
}

fn fields(word: &Word) -> Vec<Field> {
    let mut low = 0;
    let place = |(port, _, bits): &(String, i128, u32)| {
        let field = Field { port: port.clone(), low, bits: *bits };
        low += bits;
        field
    };
    word.fields.iter().map(place).collect()
}

/// The C++ of the testbench.
fn bench(design: &Design) -> String {
    let p = &design.params;
    let [pair, pose, answer] = testbench::blank(p);
    let bench = Bench {
        header: artefact::origin(),
        formats: formats_line(p),
        paced: testbench::paced(design),
        patience: testbench::patience(design),
        full_after: testbench::full_after(design),
        reset_clocks: RESET_CLOCKS,
        pair: fields(&pair),
        pose: fields(&pose),
        answer: fields(&answer),
        answer_bits: answer.bits(),
        tag_width: p.tag_width,
        tags: 1 << p.tag_width.min(30),
        interval: design.interval,
        latency: design.latency,
        two_stages: design.second.is_some(),
    };
    bench.render().expect("the template renders")
}

pub(super) fn find() -> Result<Tool, ToolError> {
    let install = "apt-get install verilator g++ make";
    tools::find(&["verilator"], "--version").ok_or(ToolError::Missing { tool: "Verilator", install })
}

/// Writes netlist, testbench and vectors, compiles, runs and reads the result.
pub(super) fn run(
    design: &Design,
    command_line: &str,
    stimulus: &Stimulus,
    netlist: Netlist,
    options: &Options,
) -> Result<Run, CosimError> {
    let verilator = find()?;
    let (dir, _scratch) = external::folder(options.keep.as_deref())?;
    let dir = dir.as_path();
    let write = |name: &str, text: &str| external::write_file(dir, name, text);
    let text = verilog::from_vhdl(&artefact::vhdl_files(design, &Prefix::default(), command_line)?, TOP, dir)?;
    match netlist {
        Netlist::Rtl => write(NETLIST, &text)?,
        Netlist::Mapped => {
            write(SOURCE, &text)?;
            yosys::mapped(design.device.family, SOURCE, TOP, NETLIST, dir)?;
        }
    }
    let vectors = format!("{}.vec", testbench::NAME);
    write(&vectors, &artefact::vectors::text(&design.params, stimulus))?;
    write(BENCH, &bench(design))?;
    let (mut run, seconds) = simulate(&verilator, netlist, dir, &vectors)?;
    run.simulator = format!("{}, {} netlist", verilator.version, netlist.name());
    run.simulation = seconds;
    Ok(run)
}

/// Compiles a netlist and the program around it, both in a folder; the program that results.
pub(super) fn compile(
    verilator: &Tool,
    dir: &Path,
    top: &str,
    netlist: &str,
    bench: &str,
    cost: &str,
) -> Result<PathBuf, CosimError> {
    // Warnings are about style in netlists that nobody wrote; two states need no care for the unknown.
    let options = "--cc --exe --build -j 2 -O3 --x-assign fast --x-initial fast --noassert -Wno-fatal";
    let files = ["--top-module", top, "--Mdir", "obj", "-o", PROGRAM, netlist, bench];
    let args: Vec<&str> = options.split(' ').chain(cost.split(' ')).chain(files).collect();
    tools::call(&verilator.path, &args, dir, "verilator.log")?;
    let dir = dir.canonicalize().map_err(file_error(dir))?;
    Ok(dir.join("obj").join(PROGRAM))
}

/// Compiles the netlist in a folder and runs the testbench on it; what it found, and the time it ran.
fn simulate(verilator: &Tool, netlist: Netlist, dir: &Path, vectors: &str) -> Result<(Run, Duration), CosimError> {
    // The code of a mapped netlist is long: its units are compiled once each, and not optimised.
    let cost = match netlist {
        Netlist::Rtl => "-MAKEFLAGS OPT_FAST=-O1",
        Netlist::Mapped => "--inline-mult 1 -MAKEFLAGS OPT_FAST=-O0",
    };
    let program = compile(verilator, dir, TOP, NETLIST, BENCH, cost)?;
    let start = Instant::now();
    let text = external::call(dir, &program, &[vectors.to_owned()], false)?;
    let seconds = start.elapsed();
    let log = dir.join("simulation.log");
    std::fs::write(&log, &text).map_err(file_error(&log))?;
    Ok((external::parse(&text, "verilator")?, seconds))
}
