//! The collision engine in Verilator: the printed VHDL as a netlist, under a vector file with the answers of the reference
//! model. Fast enough for whole scenes.

use super::CosimError;
use super::external::{call, file_error};
use super::verilator::find;
use crate::synth::{tools, verilog};
use efsat_unit::artefact::engine::{EngineDesign, NAME, TESTBENCH, engine_files, program};
use efsat_unit::artefact::{Prefix, Scratch};
use std::collections::HashMap;
use std::ops::RangeInclusive;

/// What the testbench found.
#[derive(Clone, Debug)]
pub struct EngineRun {
    /// What it said last.
    pub summary: String,
    numbers: HashMap<String, u64>,
}

impl EngineRun {
    /// The number behind a name in the last line: `packets`, `pairs`, `mismatches`, `stack`, `clocks` (of all reports),
    /// `total`, `expansions`, `leaf-pairs`, `words`, `starved`, `stalled`.
    ///
    /// # Panics
    /// If there is no such name.
    pub fn number(&self, name: &str) -> u64 {
        self.numbers[name]
    }
}

/// Compiles an engine and runs it over each of the vector files. Memory behind AXI answers after `latency` clocks.
///
/// # Errors
/// What is missing, or what a tool said.
pub fn run(design: &EngineDesign, vectors: &[&str], latency: RangeInclusive<u32>) -> Result<Vec<EngineRun>, CosimError> {
    let verilator = find()?;
    let scratch = Scratch::new().map_err(file_error(&std::env::temp_dir()))?;
    let dir = scratch.path();
    let write = |name: &str, text: &str| {
        let path = dir.join(name);
        std::fs::write(&path, text).map_err(file_error(&path))
    };
    let files = engine_files(design, &Prefix::default(), &design.command_line())
        .map_err(|clash| CosimError::Failed { tool: "generate".to_owned(), message: clash.to_string() })?;
    write("netlist.v", &verilog::from_vhdl(&files, NAME, dir)?)?;
    write("bench.cpp", &program(design))?;
    let options = "--cc --exe --build -j 2 -O3 --x-assign fast --x-initial fast --noassert -Wno-fatal -MAKEFLAGS OPT_FAST=-O1 \
                   --Mdir obj --top-module";
    let options: Vec<&str> = options.split_whitespace().chain([NAME, "-o", TESTBENCH, "netlist.v", "bench.cpp"]).collect();
    tools::call(&verilator.path, &options, dir, "verilator.log")?;
    let dir = dir.canonicalize().map_err(file_error(dir))?;
    let program = dir.join("obj").join(TESTBENCH).to_string_lossy().into_owned();
    let mut runs = vec![];
    for text in vectors {
        write("bench.vec", text)?;
        let arguments = ["bench.vec".to_owned(), latency.start().to_string(), latency.end().to_string()];
        let said = call(&dir, &program, &arguments, false)?;
        let summary = said.lines().find(|line| line.contains(" total ")).unwrap_or(&said).to_owned();
        let words: Vec<&str> = summary.split_whitespace().collect();
        let pairs = words.windows(2).filter_map(|pair| Some((pair[0].to_owned(), pair[1].parse().ok()?)));
        let numbers: HashMap<String, u64> = pairs.collect();
        if !numbers.contains_key("total") {
            return Err(CosimError::Failed { tool: TESTBENCH.to_owned(), message: said });
        }
        runs.push(EngineRun { summary: said.trim().to_owned(), numbers });
    }
    Ok(runs)
}
