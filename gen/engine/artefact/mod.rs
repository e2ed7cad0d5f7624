//! The collision engine around a unit (docs/engine.md): hand-written entities, printed by templates from the numbers that
//! `values` computes, the unit and the volume unit.

mod by_number;
// For the command line, the checks and the studies.
#[doc(hidden)]
pub mod cells;
mod engines;
mod files;
mod host;
mod meshes;
mod registers;
// For co-simulation and the testbench.
#[doc(hidden)]
pub mod samples;
mod values;
// For co-simulation and the testbench.
#[doc(hidden)]
pub mod vectors;
mod verilog;
// For co-simulation and the testbench.
#[doc(hidden)]
pub mod volume;

use crate::design::volume_unit::VolumeDesign;
use crate::format::EngineFormat;
use crate::host::{Image, TRIANGLES_AT};
use crate::params::{EngineParams, Memory, MemoryPorts, OFFSET_BITS};
use crate::words::{self, EngineReport, LINK_NUMBER_BITS};
use askama::Template;
use efsat_hardware::netlist::Module;
use efsat_hardware::vhdl::Clash;
use efsat_unit::artefact::{Prefix, origin, vhdl_files};
use efsat_unit::design::Design;
use efsat_unit::design::top::DesignError;
use efsat_unit::params::options::Choice;
use efsat_unit::params::{ParamError, Params};
use efsat_unit::parts::Core;
use efsat_unit::words::PacketKind;
use values::{Lines, Values};
use volume::volume_files;

// For the program and the testbench.
#[doc(hidden)]
pub use files::EngineExtras;
pub use files::{engine_design_files, engine_design_files_with};
pub use verilog::engine_verilog_files;

/// Name of the entity of the engine, without a prefix.
pub const NAME: &str = "efsat_engine";

/// The engine as a core; in the example with its trees in block RAM.
const CORE: Core = Core {
    name: "engine",
    what: "The collision engine of EFSAT: trees of triangles and a pose in, pairs that touch out",
    entity: NAME,
    label: "engine",
    stem: NAME,
    played: "sim",
    report_words: EngineReport::WORDS,
    in_order: true,
    packets: &[
        "byte first. A packet that is no whole words is answered as malformed. The line has no handshake: send the next packet when the",
        "one before is answered; only a stop may come while a query runs.",
    ],
};

/// Name of the testbench entity, without a prefix.
pub const TESTBENCH: &str = "efsat_engine_tb";

/// Bits of the tag of the unit for the numbers of both triangles. Above them is the lane of the query.
const NUMBERS_WIDTH: u32 = 2 * LINK_NUMBER_BITS;
/// With pairs by number there is a bit in its place: whether the pair is answered if it is separate, too.
const NUMBERS_TAG_WIDTH: u32 = NUMBERS_WIDTH + 1;

/// Bytes from a block to the next, and from a triangle to the next, that the memories are made for.
const STRIDE: u32 = 64;

/// An engine: its parameters, the unit and the volume unit in it.
pub struct EngineDesign {
    /// Parameters of the engine.
    pub params: EngineParams,
    /// Its formats.
    pub format: EngineFormat,
    /// The unit. Its tag are the numbers of a pair.
    pub unit: Design,
    /// The volume unit; an engine that takes pairs by number has none.
    pub volume: VolumeDesign,
    /// Whether pairs of triangles are named by the host, in place of a traversal of trees.
    pub by_number: bool,
}

impl EngineDesign {
    /// Builds the unit and the volume unit. The width of the tag in `unit` is not used.
    ///
    /// # Errors
    /// Parameters out of range, an unknown device, or a format that the memories of the engine are not made for.
    pub fn new(params: &EngineParams, unit: &Params) -> Result<Self, DesignError> {
        Self::of(params, unit, false)
    }

    /// As [`EngineDesign::new`], an engine that takes pairs by number: of the options of the engine it has those of the memory of
    /// triangles alone, and the others are as they are by default.
    ///
    /// # Errors
    /// As there.
    pub fn by_number(params: &EngineParams, unit: &Params) -> Result<Self, DesignError> {
        let &EngineParams { memory, memory_width, watchdog, axi_id_bits, triangle_lines, .. } = params;
        // A mesh has no more blocks than triangles.
        let block_lines = triangle_lines;
        let usual = EngineParams::default();
        let params = EngineParams { memory, memory_width, watchdog, axi_id_bits, triangle_lines, block_lines, ..usual };
        Self::of(&params, unit, true)
    }

    fn of(params: &EngineParams, unit: &Params, by_number: bool) -> Result<Self, DesignError> {
        let tag_width = if by_number { NUMBERS_TAG_WIDTH } else { NUMBERS_WIDTH + params.lane_bits() };
        let unit = Params { tag_width, ..unit.clone() };
        let format = params.format(&unit)?;
        params.several()?;
        supported(&format)?;
        let volume = VolumeDesign::new(params, &unit)?;
        Ok(Self { params: params.clone(), format, unit: Design::new(&unit, false)?, volume, by_number })
    }

    /// The clock in MHz that the schedules of its units reach, and the node that ends the longest path.
    pub fn clock(&self) -> (f64, &str) {
        let (unit, volume) = (self.unit.clock(), self.volume.clock());
        if self.by_number || unit.0 <= volume.0 { unit } else { volume }
    }

    /// The entity that is the top, without a prefix; for co-simulation.
    #[doc(hidden)]
    pub fn top(&self) -> &'static str {
        files::core_of(self).entity
    }

    /// What stands behind the m in the names of the top's read ports: a number, or nothing if there is one port.
    #[doc(hidden)]
    pub fn read_ports(&self) -> Vec<String> {
        match self.params.memory_ports {
            MemoryPorts::One => vec![String::new()],
            MemoryPorts::Each => (0..self.params.engines).map(|i| i.to_string()).collect(),
        }
    }

    /// The options of the engine with their values.
    #[doc(hidden)]
    pub fn options(&self) -> Vec<(&'static str, String)> {
        let options = self.params.options().into_iter();
        let by_number = |name| !self.by_number || Self::OPTIONS_BY_NUMBER.contains(&name);
        options.filter(|(name, _)| self.params.has(name) && by_number(*name)).collect()
    }

    /// The options of the engine that one has which takes pairs by number.
    #[doc(hidden)]
    pub const OPTIONS_BY_NUMBER: [&'static str; 5] =
        ["memory", "memory-width", "watchdog", "axi-id-bits", "triangle-lines"];

    /// The command line that generates the engine, all options spelled out: the method of axes too, which is not the default of an
    /// engine.
    pub fn command_line(&self) -> String {
        let unit = &self.unit.params;
        let others = unit.options().into_iter().filter(|(name, _)| !["method", "tag-width"].contains(name));
        let options = [("method", unit.method.name().to_owned())].into_iter().chain(others).chain(self.options());
        let options = options.map(|(name, value)| format!(" --{name} {value}"));
        let by_number = if self.by_number { " --pairs-by-number" } else { "" };
        format!("efsat generate --engine{by_number}{}", options.collect::<String>())
    }

    /// Where images are in its memory.
    ///
    /// # Errors
    /// If block RAM is too small for them.
    #[doc(hidden)]
    pub fn layout(&self, images: &[&Image]) -> Result<crate::host::Layout, ParamError> {
        let mut layout = crate::host::Layout::new(&self.params, &self.format, images)?;
        if self.by_number {
            layout.loads.retain(|load| load[1] >= u64::from(TRIANGLES_AT) << 6);
        }
        Ok(layout)
    }

    /// The unit and the volume unit, of one engine.
    #[doc(hidden)]
    pub fn units(&self) -> Vec<&Module> {
        let volume = (!self.by_number).then_some(&*self.volume.stage);
        [&*self.unit.top].into_iter().chain(volume).collect()
    }

    /// Multipliers of the unit and of the volume unit, of one engine.
    #[doc(hidden)]
    pub fn multipliers(&self) -> [usize; 2] {
        let volume = if self.by_number { 0 } else { self.volume.stage.multipliers() };
        [self.unit.top.multipliers(), volume]
    }
}

/// Whether the memories are made for a format.
fn supported(format: &EngineFormat) -> Result<(), ParamError> {
    let wrong = |option, found: String, legal: String| Err(ParamError { option, found, legal });
    let block = format.block();
    if block.stride != STRIDE {
        let bits = 8 * STRIDE;
        let fits = |offset_bits: &u32| EngineFormat { offset_bits: *offset_bits, ..*format }.block().stride == STRIDE;
        let fitting: Vec<u32> = OFFSET_BITS.filter(fits).collect();
        let (least, most) = (fitting.first().unwrap_or(&0), fitting.last().unwrap_or(&0));
        let why = format!("in the engine, whose blocks have {} to {bits} bits; found {}", bits / 2 + 1, block.bits);
        // The option that is not as it is by default is to blame.
        if format.directions != EngineParams::default().directions {
            let legal = format!("expected --offset-bits {least} to {most} with it {why}");
            return wrong("directions", format.k().to_string(), legal);
        }
        let legal = format!("expected {least} to {most} with --directions {} {why}", format.k());
        return wrong("offset-bits", format.offset_bits.to_string(), legal);
    }
    if format.triangle().stride != STRIDE {
        let legal = "expected at most 32 in the engine".to_owned();
        return wrong("transform-width", format.transform_width.to_string(), legal);
    }
    if format.matrix_shift() < 0 || format.translation_shift() < 0 {
        let least = format.int_bits + format.grid_fraction().max(format.origin_fraction());
        let legal = format!("expected at least {least}: poses as fine as the grid of the volumes");
        return wrong("transform-width", format.transform_width.to_string(), legal);
    }
    Ok(())
}

macro_rules! entities {
    ($($name:ident $path:literal;)+) => {$(
        #[derive(Template)]
        #[template(path = $path, escape = "none")]
        struct $name<'a> {
            header: &'a [String],
            prefix: &'a Prefix,
            // Traverse only joins others and has no number.
            #[allow(dead_code)]
            e: &'a Values,
        }

        impl<'a> $name<'a> {
            fn text(header: &'a [String], prefix: &'a Prefix, e: &'a Values) -> String {
                Self { header, prefix, e }.render().expect("the template renders")
            }
        }
    )+};
}

entities! {
    Layout "engine/engine_layout.vhd";
    Stack "engine/engine_stack.vhd";
    Children "engine/engine_children.vhd";
    Lane "engine/engine_lane.vhd";
    Issue "engine/engine_issue.vhd";
    Flight "engine/engine_flight.vhd";
    Survivors "engine/engine_survivors.vhd";
    Traverse "engine/engine_traverse.vhd";
    Queries "engine/engine_queries.vhd";
    Pairs "engine/engine_pairs.vhd";
    Answer "engine/engine_answer.vhd";
    Command "engine/engine_command.vhd";
    Triangles "engine/engine_triangles.vhd";
    Check "engine/engine_check.vhd";
    Stop "engine/engine_stop.vhd";
    Admission "engine/engine_admission.vhd";
    Control "engine/engine_control.vhd";
    ReadMaster "engine/engine_read_master.vhd";
    LinesOf "engine/engine_lines.vhd";
    Engine "engine/efsat_engine.vhd";
    NumberCommand "engine/engine_number_command.vhd";
    NumberAnswer "engine/engine_number_answer.vhd";
    ByNumber "engine/efsat_engine_by_number.vhd";
    Dispatch "engine/engines_dispatch.vhd";
    Queue "engine/engines_queue.vhd";
    Gather "engine/engines_gather.vhd";
    SharedMemory "engine/engines_memory.vhd";
    Engines "engine/efsat_engines.vhd";
    Bench "engine/efsat_engine_tb.vhd";
}

#[derive(Template)]
#[template(path = "engine/engine_memory.vhd", escape = "none")]
struct MemoryText<'a> {
    header: &'a [String],
    prefix: &'a Prefix,
    m: &'a Lines,
}

#[derive(Template)]
#[template(path = "engine/engine_cache.vhd", escape = "none")]
struct CacheText<'a> {
    header: &'a [String],
    prefix: &'a Prefix,
    m: &'a Lines,
}

/// Name and text of each VHDL source that is synthesised, in dependency order: the unit, the volume unit, the entities of the
/// engine, the engine. All names begin with the prefix.
///
/// # Errors
/// A name that some tool would refuse.
pub fn engine_files(
    design: &EngineDesign,
    prefix: &Prefix,
    command_line: &str,
) -> Result<Vec<(String, String)>, Clash> {
    let values = Values::new(design);
    let header = origin();
    let mut files = vhdl_files(&design.unit, prefix, command_line)?;
    if !design.by_number {
        files.extend(volume_files(&design.volume, prefix)?);
    }
    let mut add = |name: &str, text: String| files.push((format!("{}.vhd", prefix.of(name)), text));
    add("engine_layout", Layout::text(&header, prefix, &values));
    let memories = &values.memory.memories;
    for lines in if design.by_number { &memories[1..] } else { memories } {
        let text = match design.params.memory {
            Memory::BlockRam => MemoryText { header: &header, prefix, m: lines }.render(),
            Memory::Axi => CacheText { header: &header, prefix, m: lines }.render(),
        };
        add(lines.entity, text.expect("the template renders"));
    }
    if design.params.memory == Memory::Axi {
        add("engine_read_master", ReadMaster::text(&header, prefix, &values));
    }
    let mut top = header.clone();
    top.push(command_line.to_owned());
    if design.by_number {
        top.extend(by_number::description(design));
        add("engine_number_answer", NumberAnswer::text(&header, prefix, &values));
        add("engine_number_command", NumberCommand::text(&header, prefix, &values));
        add(NAME, ByNumber::text(&top, prefix, &values));
        return Ok(files);
    }
    add("engine_queries", Queries::text(&header, prefix, &values));
    add("engine_stack", Stack::text(&header, prefix, &values));
    add("engine_children", Children::text(&header, prefix, &values));
    add("engine_lane", Lane::text(&header, prefix, &values));
    add("engine_issue", Issue::text(&header, prefix, &values));
    add("engine_flight", Flight::text(&header, prefix, &values));
    add("engine_survivors", Survivors::text(&header, prefix, &values));
    add("engine_traverse", Traverse::text(&header, prefix, &values));
    add("engine_pairs", Pairs::text(&header, prefix, &values));
    add("engine_answer", Answer::text(&header, prefix, &values));
    add("engine_command", Command::text(&header, prefix, &values));
    add("engine_triangles", Triangles::text(&header, prefix, &values));
    add("engine_check", Check::text(&header, prefix, &values));
    add("engine_stop", Stop::text(&header, prefix, &values));
    add("engine_admission", Admission::text(&header, prefix, &values));
    add("engine_control", Control::text(&header, prefix, &values));
    add("engine_lines", LinesOf::text(&header, prefix, &values));
    let mut around = top.clone();
    top.extend(description(design));
    add(NAME, Engine::text(&top, prefix, &values));
    if design.params.engines > 1 {
        around.extend(engines::description(design));
        add("engines_dispatch", Dispatch::text(&header, prefix, &values));
        add("engines_queue", Queue::text(&header, prefix, &values));
        add("engines_gather", Gather::text(&header, prefix, &values));
        if !values.engines.own_ports {
            add("engines_memory", SharedMemory::text(&header, prefix, &values));
        }
        add(design.top(), Engines::text(&around, prefix, &values));
    }
    Ok(files)
}

/// The testbench.
pub fn bench(design: &EngineDesign, prefix: &Prefix) -> String {
    Bench::text(&origin(), prefix, &Values::new(design))
}

/// What the header of the engine says.
fn description(design: &EngineDesign) -> Vec<String> {
    let (params, format) = (&design.params, &design.format);
    let memory = match params.memory {
        Memory::BlockRam => format!(
            "Trees are in block RAM, {} blocks and {} triangles, filled through the stream.",
            params.block_lines, params.triangle_lines
        ),
        Memory::Axi => {
            format!("Trees are in memory behind an AXI4 read master, words of {} bits.", params.memory_width)
        }
    };
    let lines = [
        "The collision engine: two trees and a pose in, the pairs of triangles that touch out.".to_owned(),
        String::new(),
        format!(
            "An expansion every {} clocks, up to {} in flight; the volume unit answers {} clocks after it has taken one.",
            params.expansion_clocks, params.in_flight, design.volume.latency
        ),
        memory,
        String::new(),
        format!("In: packets of 64-bit words, the last with TLAST. A query has {} words:", format.query_words()),
        "  0      header 31..0, format 63..32".to_owned(),
        "  1, 2   blocks of A and B, triangles of A and B: addresses / 64".to_owned(),
        "  3, 4   number of blocks of A and B, of triangles of A and B".to_owned(),
        "  5      most expansions 31..0 (0: 2^32); 32 stop at the first certain contact; 33 answer separate pairs too;"
            .to_owned(),
        "         34 leaf pairs only, no triangle test; 35 keep the caches; 63..40 number that the report returns"
            .to_owned(),
        "  6      errors of the shift 15..0, 31..16, 47..32".to_owned(),
        "  7 ...  pose, as in packets of the stream wrapper; then a row for each two opposite directions".to_owned(),
        format!(
            "A stop and a soft reset are one word: header 16#{:08x}# or 16#{:08x}# in 31..0, a number in 63..40.",
            format.header(words::Command::Stop),
            format.header(words::Command::Reset)
        ),
        String::new(),
        "Out: for each query one packet: pairs that are not separate, A's number in 35..8, B's in 63..36, the verdict in 1..0, then".to_owned(),
        "a report of eight words, two counts in each, the first one in 31..0:".to_owned(),
        "  0      1..0 = 11, 6..2 reason, 7 incomplete, 31..8 the query's number; clocks in 63..32".to_owned(),
        "  1, 2   expansions, tests; survivors, leaf pairs".to_owned(),
        "  3      pairs that intersect, pairs that are possibly incorrect".to_owned(),
        "  4, 5   blocks, triangles: asked for, read from memory".to_owned(),
        "  6      words read; clocks in which the volume unit waited for memory".to_owned(),
        "  7      clocks in which survivors waited for the queue of leaf pairs; greatest stack".to_owned(),
        String::new(),
        "Between queries also packets of pairs and poses, in and out as by a stream wrapper of 64-bit words and 16-bit tags:"
            .to_owned(),
        format!(
            "headers 16#{:08x}# and 16#{:08x}#. The pose of a packet or of a query holds until the next one.",
            format.stream.header(PacketKind::Pairs),
            format.stream.header(PacketKind::Pose)
        ),
    ];
    lines.to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;
    use efsat_hardware::vhdl::lint::lint;

    #[test]
    fn the_texts_keep_to_the_rules_of_the_target() {
        for memory in [Memory::BlockRam, Memory::Axi] {
            let params = EngineParams { memory, ..EngineParams::default() };
            for make in [EngineDesign::new, EngineDesign::by_number] {
                let design = make(&params, &Params::default()).unwrap();
                let files = engine_files(&design, &Prefix::default(), "efsat generate --engine").unwrap();
                let texts: Vec<(&str, &str)> =
                    files.iter().map(|(name, text)| (name.as_str(), text.as_str())).collect();
                let findings: Vec<String> = lint(&texts).iter().map(ToString::to_string).collect();
                assert!(findings.is_empty(), "{}", findings.join("\n"));
            }
        }
    }
}
