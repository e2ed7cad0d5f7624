//! `efsat generate`.

use super::diagram::DiagramArguments;
use super::error::Failure;
use super::file;
use super::output::{print, print_json, warn_of};
use super::params::{EngineArguments, ParamArguments, choice};
use efsat_checks::synth::{SynthError, verilog};
use efsat_engine::artefact::{EngineDesign, EngineExtras, engine_design_files_with, engine_verilog_files, samples};
use efsat_engine::ready::{ENGINES, ready_files};
use efsat_hardware::estimate;
use efsat_unit::artefact::{
    DesignFilesError, FileSet, Packaging, Prefix, ReadyDesign, design_files_with, dump_files, programme_files,
    ready_designs, verilog_files,
};
use efsat_unit::design::Design;
use efsat_unit::design::top::{DesignError, pace};
use efsat_unit::params::Params;
use efsat_unit::params::options::{Choice, FREQUENCY};
use efsat_unit::words::StreamWidth;
use serde::Serialize;
use std::fmt;
use std::path::{Path, PathBuf};

/// Writes the design: VHDL, stream wrapper, example, testbenches, vectors, projects for tools and a manifest
///
/// DIR may be absent, empty, or written by efsat before; files in it that efsat did not write stay. Everything or
/// nothing is written.
#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// Directory of the design [default: that of the ready design with these options below rtl-out, with --ready rtl-out]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Write all ready designs, each to a folder below DIR, in place of one design
    #[arg(long, conflicts_with_all = ["lp", "dump", "stream_width"])]
    ready: bool,
    /// Write nothing; fail if a generated file in DIR is missing, differs by a byte, or would no longer be written
    #[arg(long)]
    check: bool,
    /// Write to DIR the schedule of every unit as a linear program in CPLEX LP format, and nothing else
    #[arg(long, value_name = "DIR", conflicts_with_all = ["out", "check", "stream_width"])]
    lp: Option<PathBuf>,
    /// Write to DIR what the design is on its way to VHDL, graphs, schedules and modules, as text, and nothing else
    #[arg(long, value_name = "DIR", conflicts_with_all = ["out", "check", "lp", "stream_width"])]
    dump: Option<PathBuf>,
    /// Bits of a word into the AXI4-Stream wrapper
    #[arg(long, value_name = "BITS", default_value = StreamWidth::default().name())]
    #[arg(value_parser = choice::<StreamWidth>(), allow_negative_numbers = true)]
    stream_width: StreamWidth,
    /// Put NAME_ before the name of every entity, package and file, so that two designs can live in one library
    #[arg(long, value_name = "NAME", value_parser = Prefix::new, conflicts_with_all = ["lp", "dump", "ready"])]
    name: Option<Prefix>,
    /// Also write the design in Verilog, by GHDL: efsat.v, or efsat_engine.v; other versions of GHDL write other Verilog
    #[arg(long, conflicts_with_all = ["lp", "dump", "ready", "unit"])]
    verilog: bool,
    /// Also write registers behind AXI4-Lite around the unit's stream wrapper or the engine, two queues and an interrupt, for a
    /// processor without a DMA engine; with --stream-width 64
    #[arg(long, conflicts_with_all = ["lp", "dump", "ready", "unit"])]
    registers: bool,
    /// Print one JSON object about the design
    #[arg(long, conflicts_with_all = ["lp", "dump", "check", "ready", "unit"])]
    json: bool,
    /// Write the collision engine: two trees and a pose in, the pairs of triangles that touch out. The unit in it is by default of
    /// --method determinants, with --clocks-per-pair 1, 2 or 3 for --expansion-clocks 1, 2 or 4
    #[arg(long, requires = "out", conflicts_with_all = ["lp", "dump", "ready", "stream_width", "unit", "svg", "dot"])]
    engine: bool,
    /// With --engine: no trees; a packet is a pose and the numbers of two triangles in memory for each pair, 8 bytes
    #[arg(long, requires = "engine")]
    pairs_by_number: bool,
    #[command(flatten)]
    diagram: DiagramArguments,
    #[command(flatten)]
    params: ParamArguments,
    #[command(flatten)]
    engine_params: EngineArguments,
}

impl Arguments {
    fn packaging(&self) -> Packaging {
        Packaging {
            stream_width: self.stream_width,
            prefix: self.name.clone().unwrap_or_default(),
            registers: self.registers,
            verilog: self.verilog.then(Vec::new),
        }
    }
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    [&arguments.out, &arguments.lp, &arguments.dump]
        .into_iter()
        .flatten()
        .try_for_each(|dir| file::named(dir, "directory"))?;
    if arguments.engine {
        return engine(arguments);
    }
    let params = arguments.params.params()?;
    arguments.engine_params.refuse()?;
    if arguments.ready {
        return ready(arguments, &params);
    }
    let mut design = Design::new(&params, false)?;
    leave_out_folders(&mut design.params);
    let lp = arguments.lp.iter().map(|dir| (dir, programme_files(&design, &design.params.command_line())));
    let dump = arguments.dump.iter().map(|dir| (dir, dump_files(&design, &design.params.command_line())));
    if let Some((dir, set)) = lp.chain(dump).next() {
        set.write(dir)?;
        return print(&format!("{}: {} files\n", dir.display(), set.len()));
    }
    if arguments.diagram.wanted() {
        return arguments.diagram.run(&design);
    }
    reaches(&design, &params, Design::clock, |params| Design::new(params, false))?;
    let out = &folder(arguments, &params)?;
    let mut packaging = arguments.packaging();
    let mut set = files(&design, &packaging)?;
    if arguments.verilog {
        if !arguments.check {
            // Before the time that GHDL takes.
            set.check_target(out)?;
        }
        let verilog = verilog::of_set(&set, &verilog_files(&set, &design, &packaging.prefix));
        packaging.verilog = Some(verilog.map_err(SynthError::Tool)?);
        set = files(&design, &packaging)?;
    }
    if arguments.check {
        return check(&set, out);
    }
    set.write(out)?;
    let written = Written::new(&design, &set, out);
    if arguments.json {
        print_json(&written)?
    } else {
        print(&written.to_string())?
    }
    let shortages = estimate::whole(&design.top, design.device).shortages(&design.device.capacity);
    warn_of(design.device, &shortages);
    Ok(())
}

/// Files name a part of one's own by its file without folders: the same part gives the same files, wherever it lies.
fn leave_out_folders(params: &mut Params) {
    params.device = params.device.rsplit('/').next().unwrap_or_default().to_owned();
}

/// Whether a schedule does not reach a clock, but for what is lost where a period becomes a clock.
pub(super) fn misses(megahertz: f64, frequency: u32) -> bool {
    megahertz + 1e-6 < f64::from(frequency)
}

/// Refuses a clock that the longest operation between registers does not hold, and names the highest that is held; `again` makes the
/// design with other parameters.
fn reaches<D>(
    design: &D,
    params: &Params,
    clock: impl Fn(&D) -> (f64, &str),
    again: impl Fn(&Params) -> Result<D, DesignError>,
) -> Result<(), Failure> {
    let missing = |design: &D, frequency: u32| {
        let (megahertz, end) = clock(design);
        misses(megahertz, frequency).then(|| (megahertz, end.to_owned()))
    };
    let Params { device, frequency, .. } = params;
    let Some(mut longest) = missing(design, *frequency) else { return Ok(()) };
    // What no clock holds stays undivided: a design for less may be faster than this one.
    let (mut held, mut missed) = (FREQUENCY.start() - 1, *frequency);
    while missed - held > 1 {
        let frequency = held.midpoint(missed);
        match missing(&again(&Params { frequency, ..params.clone() })?, frequency) {
            None => held = frequency,
            Some(found) => (missed, longest) = (frequency, found),
        }
    }
    let (megahertz, end) = longest;
    Err(Failure::Usage(format!(
        "--frequency {frequency}: on {device} {end} takes {:.1} ns between registers and cannot be divided: expected at most {held}",
        1000.0 / megahertz
    )))
}

fn files(design: &Design, packaging: &Packaging) -> Result<FileSet, Failure> {
    let set = design_files_with(design, packaging, &command_line(&design.params, packaging));
    set.map_err(|e| unprinted(e, &packaging.prefix))
}

/// Why files are not printed, which may be the name that was asked for.
fn unprinted(error: DesignFilesError, prefix: &Prefix) -> Failure {
    match (error, prefix.name()) {
        (DesignFilesError::Name(clash), Some(name)) => {
            Failure::Usage(format!("--name {name}: {clash}; expected another name"))
        }
        (e @ DesignFilesError::Registers { .. }, _) => Failure::Usage(format!("--registers: {e}")),
        (e, _) => Failure::Check(e.to_string()),
    }
}

/// Where the design goes. Without --out it is a ready one, which another one must not replace.
fn folder(arguments: &Arguments, params: &Params) -> Result<PathBuf, Failure> {
    if let Some(out) = &arguments.out {
        return Ok(out.clone());
    }
    if let Some(name) = arguments.name.as_ref().and_then(Prefix::name) {
        return Err(Failure::Usage(format!("no --out: expected --out DIR with --name {name}")));
    }
    let is_ready = |ready: &ReadyDesign| {
        let added = arguments.verilog || arguments.registers;
        ready.params == *params && ready.stream_width == arguments.stream_width && !added
    };
    match ready_designs().into_iter().find(is_ready) {
        Some(ready) => Ok(Path::new("rtl-out").join(ready.name)),
        None => {
            let why = "rtl-out has the ready designs, and none has these options";
            Err(Failure::Usage(format!("no --out: expected --out DIR, as {why}")))
        }
    }
}

/// What is said of a design that was written; also the JSON object.
#[derive(Serialize)]
struct Written {
    out: String,
    files: usize,
    device: &'static str,
    multipliers: u64,
    multipliers_of_device: u64,
    register_bits: u64,
    frequency_mhz: u32,
    expected_mhz: f64,
    initiation_interval: usize,
    latency: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    latency_of_open_pairs: Option<usize>,
}

impl Written {
    fn new(design: &Design, set: &FileSet, out: &Path) -> Self {
        Self {
            out: out.display().to_string(),
            files: set.len(),
            device: design.device.name,
            multipliers: design.top.multipliers() as u64,
            multipliers_of_device: design.device.multipliers.into(),
            register_bits: design.top.register_bits(),
            frequency_mhz: design.params.frequency,
            expected_mhz: design.clock().0,
            initiation_interval: design.interval,
            latency: design.latency,
            latency_of_open_pairs: design.second.as_ref().map(|second| second.latency),
        }
    }
}

impl fmt::Display for Written {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { out, files, device, multipliers, multipliers_of_device: all, register_bits, .. } = self;
        writeln!(f, "{out}: {files} files")?;
        writeln!(
            f,
            "{multipliers} multipliers ({device} has {all}), {register_bits} register bits, {} MHz",
            self.frequency_mhz
        )?;
        write!(f, "{}, verdict after {} clocks", pace(self.initiation_interval), self.latency)?;
        if let Some(latency) = self.latency_of_open_pairs {
            write!(f, ", of an open pair after {latency} at most if no other waits")?;
        }
        writeln!(f)
    }
}

/// What is said of an engine that was written; also the JSON object.
#[derive(Serialize)]
struct EngineWritten {
    out: String,
    files: usize,
    device: &'static str,
    multipliers: usize,
    multipliers_of_device: usize,
    block_rams: u64,
    block_rams_of_device: u32,
    luts: u64,
    flip_flops: u64,
    frequency_mhz: u32,
    #[serde(skip_serializing_if = "Option::is_none")]
    clocks_per_expansion: Option<usize>,
    clocks_per_pair: usize,
    #[serde(skip)]
    engines: u32,
    #[serde(skip)]
    without: &'static str,
}

impl fmt::Display for EngineWritten {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { out, files, device, multipliers, multipliers_of_device: all, block_rams, .. } = self;
        writeln!(f, "{out}: {files} files")?;
        let there = self.block_rams_of_device;
        writeln!(f, "{multipliers} multipliers ({device} has {all}), {block_rams} block RAMs of 18 kbit ({there})")?;
        writeln!(f, "{} LUTs with memory and {} flip-flops, predicted{}", self.luts, self.flip_flops, self.without)?;
        writeln!(f, "units pipelined for {} MHz", self.frequency_mhz)?;
        if self.engines > 1 {
            write!(f, "each of {} engines: ", self.engines)?;
        }
        if let Some(clocks) = self.clocks_per_expansion {
            write!(f, "{}, ", pace(clocks).replacen("pair", "expansion", 1))?;
        }
        writeln!(f, "{}", pace(self.clocks_per_pair))
    }
}

/// Writes or checks an engine.
fn engine(arguments: &Arguments) -> Result<(), Failure> {
    let Some(out) = &arguments.out else {
        return Err(Failure::Usage("no --out: expected --out DIR with --engine".to_owned()));
    };
    let mut design = match arguments.pairs_by_number {
        false => arguments.engine_params.design(&arguments.params)?,
        true => arguments.engine_params.design_by_number(&arguments.params)?,
    };
    let again = if arguments.pairs_by_number { EngineDesign::by_number } else { EngineDesign::new };
    reaches(&design, &design.unit.params, EngineDesign::clock, |unit| again(&design.params, unit))?;
    leave_out_folders(&mut design.unit.params);
    let prefix = arguments.name.clone().unwrap_or_default();
    let name = prefix.name().map(|name| format!(" --name {name}")).unwrap_or_default();
    let registers = if arguments.registers { " --registers" } else { "" };
    let verilog = if arguments.verilog { " --verilog" } else { "" };
    let command_line = format!("{}{name}{registers}{verilog}", design.command_line());
    let vectors = samples::text(&design).map_err(|e| Failure::Usage(e.to_string()))?;
    let files = |verilog: Vec<(String, String)>| {
        let extras = EngineExtras { registers: arguments.registers, verilog };
        let set = engine_design_files_with(&design, &prefix, &command_line, &vectors, &extras);
        set.map_err(|e| unprinted(e, &prefix))
    };
    let mut set = files(vec![])?;
    if arguments.verilog {
        if !arguments.check {
            // Before the time that GHDL takes.
            set.check_target(out)?;
        }
        let verilog = verilog::of_set(&set, &engine_verilog_files(&set, &design, &prefix));
        set = files(verilog.map_err(SynthError::Tool)?)?;
    }
    if arguments.check {
        return check(&set, out);
    }
    set.write(out)?;
    let device = design.unit.device;
    let engines = design.params.engines;
    let cells = design.cells(device);
    let written = EngineWritten {
        out: out.display().to_string(),
        files: set.len(),
        device: device.name,
        multipliers: engines as usize * design.multipliers().iter().sum::<usize>(),
        multipliers_of_device: device.multipliers as usize,
        block_rams: cells.block_rams,
        block_rams_of_device: device.block_rams,
        luts: cells.resources.luts + cells.resources.memory_luts,
        flip_flops: cells.resources.flip_flops,
        frequency_mhz: design.unit.params.frequency,
        clocks_per_expansion: (!design.by_number).then_some(design.volume.interval),
        clocks_per_pair: design.unit.interval,
        engines,
        without: if arguments.registers { " without the registers behind AXI4-Lite" } else { "" },
    };
    if arguments.json {
        print_json(&written)?
    } else {
        print(&written.to_string())?
    }
    let mut shortages = cells.resources.shortages(&device.capacity);
    if cells.block_rams > device.block_rams.into() {
        shortages.push(("block RAMs", cells.block_rams, device.block_rams.into()));
    }
    warn_of(device, &shortages);
    Ok(())
}

/// Writes or checks the ready designs.
fn ready(arguments: &Arguments, params: &Params) -> Result<(), Failure> {
    if let Some((name, value)) = params.differences(&Params::default()).into_iter().next() {
        return Err(Failure::Usage(format!("--ready with --{name} {value}: expected no option of the design")));
    }
    if arguments.diagram.wanted() {
        return Err(Failure::Usage("--ready with a diagram: expected one design".to_owned()));
    }
    let out = arguments.out.as_deref().unwrap_or(Path::new("rtl-out"));
    let set = ready_files(command_line).map_err(|e| Failure::Check(e.to_string()))?;
    if arguments.check {
        return check(&set, out);
    }
    set.write(out)?;
    let (files, designs) = (set.len(), ready_designs().len());
    print(&format!("{}: {files} files, {designs} designs and {ENGINES} engines\n", out.display()))
}

/// The command line that stands in the files of a design.
pub(super) fn command_line(params: &Params, packaging: &Packaging) -> String {
    let name = packaging.prefix.name().map(|name| format!(" --name {name}")).unwrap_or_default();
    let verilog = if packaging.verilog.is_some() { " --verilog" } else { "" };
    let registers = if packaging.registers { " --registers" } else { "" };
    format!("{} --stream-width {}{name}{registers}{verilog}", params.command_line(), packaging.stream_width.name())
}

fn check(set: &FileSet, dir: &Path) -> Result<(), Failure> {
    if !dir.exists() {
        return Err(Failure::Check(format!(
            "{}: found nothing; expected {} generated files",
            dir.display(),
            set.len()
        )));
    }
    let differences = set.check(dir)?;
    if differences.is_empty() {
        return print(&format!("{}: {} files, all as generated\n", dir.display(), set.len()));
    }
    let names: Vec<String> = differences.iter().map(ToString::to_string).collect();
    Err(Failure::Check(format!("{} is not as generated: {}", dir.display(), names.join(", "))))
}
