//! All files of a generated engine, as one value.

use super::values::WORD;
use super::{CORE, EngineDesign, NAME, TESTBENCH, bench, by_number, engine_files, engines, host, registers};
use crate::params::{EngineParams, Memory, MemoryPorts};
use crate::words::Command;
use askama::Template;
use efsat_hardware::vhdl::lint::lint;
use efsat_unit::artefact::file_lists::{BenchFiles, FileLists};
use efsat_unit::artefact::{DesignFilesError, FileSet, Prefix};
use efsat_unit::design::top::pace;
use efsat_unit::params::Params;
use efsat_unit::params::options::Choice;
use efsat_unit::parts::{Core, FileRow, Packaged, Project, RETEST, add_projects, add_top, board, manifest, named};
use efsat_unit::words::PacketKind;
use serde::Serialize;
use std::collections::BTreeMap;

#[derive(Template)]
#[template(path = "engine/engine-readme.md", escape = "none")]
struct Readme<'a> {
    version: &'static str,
    prefix: &'a Prefix,
    command_line: &'a str,
    stack: u32,
    in_flight: u32,
    pace: String,
    memory: String,
    axi: bool,
    by_number: bool,
    top: String,
    engines: u32,
    multipliers: usize,
    unit_multipliers: usize,
    volume_multipliers: usize,
    frequency: u32,
    device: &'static str,
    entities: Vec<FileRow>,
    files: Vec<FileRow>,
    stem: &'static str,
    projects: Vec<Project>,
    ports: String,
    simulate: String,
}

/// What is chosen for the files of an engine and does not change it.
#[derive(Clone, Debug, Default)]
pub struct EngineExtras {
    /// Whether there are registers behind AXI4-Lite around the engine.
    pub registers: bool,
    /// Name and text of the [Verilog files](crate::artefact::engine_verilog_files) that are made already.
    pub verilog: Vec<(String, String)>,
}

/// What an engine is.
#[derive(Serialize)]
struct About {
    unit: BTreeMap<String, String>,
    engine: BTreeMap<String, String>,
    clocks_per_pair: usize,
    #[serde(flatten)]
    volumes: Option<Volumes>,
    unit_latency: usize,
    multipliers: usize,
    #[serde(flatten)]
    packets: Packets,
    load_header: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    stop_header: Option<String>,
    reset_header: String,
}

#[derive(Serialize)]
struct Volumes {
    clocks_per_expansion: usize,
    volume_latency: usize,
}

/// Packets of one kind of engine.
#[derive(Serialize)]
#[serde(untagged)]
enum Packets {
    Queries { query_words: u32, pairs_header: String, pose_header: String, query_header: String },
    Numbers { pairs_word: u32, numbers_header: String },
}

/// What the entities of the engine are for, in the order of the data.
const ENTITIES: [(&str, &str); 19] = [
    (
        "engine_command",
        "Packets in: pairs, poses, queries, loads, stops and soft resets; what is none of them is reported.",
    ),
    ("engine_control", "The queries in flight, from job to report, and why they end."),
    ("engine_admission", "When jobs are taken, and when queries are checked and start."),
    ("engine_check", "Whether the trees of a query are where memory is."),
    ("engine_stop", "The numbers of the queries in flight, and which of them a stop ends."),
    ("engine_queries", "The words of the queries in flight."),
    ("engine_traverse", "The traversals of the trees."),
    ("engine_issue", "Which pair of nodes is opened next."),
    ("engine_lane", "The lane of a query: when a pair of it may be opened."),
    ("engine_stack", "The stack of pairs of a query that are still to be opened."),
    ("engine_flight", "Pairs of nodes in flight: children of their blocks, answers of the volume unit."),
    ("engine_survivors", "Pairs of children that are pushed, and pairs of leaves."),
    ("engine_children", "The links of a block, and whether block and links are good."),
    ("volume_unit", "The test of two volumes by directions."),
    ("engine_pairs", "Pairs of leaves between the traversal and their answers."),
    ("engine_lines", "Where blocks and triangles come from."),
    ("engine_triangles", "The way to the triangle unit, and past it."),
    ("efsat", "The triangle unit."),
    ("engine_answer", "Answers out, counters and the report."),
];

/// As [`engine_design_files_with`], without files in Verilog.
///
/// # Errors
/// A name in the design that is not legal VHDL, or a breach of the [rules](efsat_hardware::vhdl::lint) of the target.
pub fn engine_design_files(
    design: &EngineDesign,
    prefix: &Prefix,
    command_line: &str,
    vectors: &str,
) -> Result<FileSet, DesignFilesError> {
    engine_design_files_with(design, prefix, command_line, vectors, &EngineExtras::default())
}

/// Sources, testbench, its vectors, lists, a README and the manifest; with block RAM also the example behind a UART and the files
/// of a board that has the device. Equal designs, vectors and command lines give equal bytes.
///
/// # Errors
/// As [`engine_design_files`].
pub fn engine_design_files_with(
    design: &EngineDesign,
    prefix: &Prefix,
    command_line: &str,
    vectors: &str,
    extras: &EngineExtras,
) -> Result<FileSet, DesignFilesError> {
    let mut sources = engine_files(design, prefix, command_line)?;
    let (constants, package) = host::package(design, prefix);
    sources.push((constants.clone(), package));
    let mut set = FileSet::default();
    let names: Vec<String> = sources.iter().map(|(name, _)| name.clone()).collect();
    sources.into_iter().for_each(|(name, text)| set.insert(name, text));
    let core = core_of(design);
    let bench_files = BenchFiles::new(TESTBENCH, "Testbench of the streams", CORE.played, prefix);
    let (bench_file, vector_file) = (bench_files.file.clone(), bench_files.vectors.clone());
    let mut lists = FileLists::new(core, names, vec![bench_files], prefix);
    let mut registers = vec![];
    if extras.registers {
        if design.params.engines > 1 {
            let found = format!("--engines {}", design.params.engines);
            return Err(DesignFilesError::Registers { found, expected: "one engine, whose answers come in order" });
        }
        registers = registers::shell(design, prefix, &design.command_line()).add(&mut set);
        lists = lists.with_registers(prefix);
    }
    if design.params.memory == Memory::BlockRam {
        lists = lists.with_example(prefix);
    }
    let (lists, names) = (&lists, &lists.synthesised[..]);
    let texts: Vec<(&str, &str)> = names.iter().filter_map(|name| Some((name.as_str(), set.get(name)?))).collect();
    if let Some(finding) = lint(&texts).into_iter().next() {
        return Err(DesignFilesError::Lint(finding));
    }
    let row = FileRow::new;
    let mut files = vec![
        row(
            &format!("{prefix}{}.vhd", design.top()),
            match design.params.engines {
                1 => "The engine; the other `.vhd` files are its entities and those of the units.",
                _ => {
                    "The engines; the other `.vhd` files are what is around them, their entities and those of the units."
                }
            },
        ),
        row(
            &format!("{}.vhd", prefix.of("engine_layout")),
            "The package of the widths that the entities share, and of the fields of their words.",
        ),
        row(&bench_file, "Testbench, for simulation only."),
        row(
            &vector_file,
            match design.by_number {
                false => {
                    "Meshes, queries of every kind, packets that are none, and the answers of the reference model."
                }
                true => "Meshes, pairs by number, packets that are none, and the answers of the reference model.",
            },
        ),
        row(
            &format!("host/{prefix}{NAME}.h"),
            "The words of the streams in C: packing of packets, unpacking of answers.",
        ),
        row(&format!("host/{prefix}{NAME}.py"), "The same in Python."),
        row(&format!("host/{prefix}{NAME}_image.h"), "A reader of images in C, which checks them."),
        row(
            &format!("host/{prefix}{NAME}_pose.h"),
            match design.by_number {
                false => "From a pose to the numbers of a query, in C.",
                true => "From a pose to the head of a packet, in C.",
            },
        ),
        row(&format!("host/{prefix}{RETEST}.h"), "The exact answer to pairs that are possibly incorrect, in C."),
        row(
            &constants,
            "Formats, headers and places in the words of the streams, as VHDL constants for those who instantiate the engine.",
        ),
        row("files.txt", "All VHDL files in dependency order, the testbench last."),
        row("files-synthesis.txt", "Those of them that are synthesised."),
        row("manifest.json", "Parameters, headers of the stream, latencies, and a SHA-256 per file, for programs."),
    ];
    files.extend(registers);
    host::files(design, prefix).into_iter().for_each(|(name, text)| set.insert(name, text));
    set.insert(&bench_file, bench(design, prefix));
    set.insert(vector_file, vectors.to_owned());
    set.insert(FileLists::SYNTHESISED, format!("{}\n", names.join("\n")));
    set.insert("files.txt", lists.all().join("\n"));
    let shell = extras.registers.then(|| lists.top.clone());
    let name = name_of(design, prefix, extras.registers);
    let packaged = Packaged {
        core,
        prefix,
        name: &name,
        pace: &pace(design.unit.interval),
        command_line,
        device: design.unit.device,
        frequency: design.unit.params.frequency,
        lists,
        instances: &shell.into_iter().chain([prefix.of(core.entity)]).collect::<Vec<_>>(),
    };
    let (rows, mut projects) = add_projects(&packaged, &mut set);
    files.extend(rows);
    if design.params.memory == Memory::BlockRam {
        let unit = &design.unit;
        add_top(&mut set, &CORE, unit.params.frequency, [WORD; 2], prefix);
        files.push(row("example", "The engine behind a UART, a whole design."));
        projects.extend(board::add(&mut set, &CORE, unit, prefix, names));
    }
    files.extend(projects.iter().map(FileRow::of_project));
    for (name, text) in &extras.verilog {
        files.push(FileRow::of_verilog(name));
        set.insert(name, text);
    }
    let (ports, simulate) = (packaged.port_tables(&set), packaged.simulation());
    set.insert("README.md", readme(design, prefix, command_line, files, projects, ports, simulate));
    let text = manifest_of(design, command_line, &set);
    set.insert(manifest::NAME, text);
    Ok(set)
}

/// What is generated: an engine, or several.
pub(super) fn core_of(design: &EngineDesign) -> &'static Core {
    if design.params.engines > 1 { &engines::CORE } else { &CORE }
}

/// The name of an engine in a library of FuseSoC.
fn name_of(design: &EngineDesign, prefix: &Prefix, registers: bool) -> String {
    let usual = EngineParams::default();
    let unit = &design.unit.params;
    let usual_unit = if unit.method == usual.unit().method { usual.unit() } else { Params::of(unit.method) };
    let usual_unit = Params { tag_width: unit.tag_width, ..usual_unit };
    let of_unit = unit.differences(&usual_unit).into_iter();
    let method = (unit.method != usual.unit().method).then(|| unit.method.name().to_owned());
    let usual = usual.options();
    let of_engine = design.options().into_iter().filter(|option| !usual.contains(option));
    let options = of_unit.chain(of_engine).map(|(option, value)| format!("{option}-{value}"));
    let words = [(design.by_number, "by-number"), (registers, "registers")];
    let words = words.into_iter().filter(|(there, _)| *there).map(|(_, word)| word.to_owned());
    named(&CORE.stem.replace('_', "-"), method.into_iter().chain(options).chain(words), prefix)
}

fn readme(
    design: &EngineDesign,
    prefix: &Prefix,
    command_line: &str,
    files: Vec<FileRow>,
    projects: Vec<Project>,
    ports: String,
    simulate: String,
) -> String {
    let params = &design.params;
    let [unit, volume] = design.multipliers();
    let memory = match params.memory {
        _ if design.by_number => by_number::memory(design),
        Memory::BlockRam => format!(
            "Trees are in block RAM, which holds {} blocks and {} triangles.",
            params.block_lines, params.triangle_lines
        ),
        Memory::Axi => format!(
            "Trees are in memory behind an AXI4 read master of {} bits, with caches of {} blocks and {} triangles.",
            params.memory_width, params.block_lines, params.triangle_lines
        ),
    };
    let list = if design.by_number { &by_number::ENTITIES[..] } else { &ENTITIES };
    let several = params.engines > 1;
    let around = if several { &engines::ENTITIES[..] } else { &[] };
    let shared = (several && params.memory_ports == MemoryPorts::One).then_some(&engines::SHARED_MEMORY);
    let all = around.iter().chain(shared).chain(list);
    let mut entities: Vec<FileRow> = all.map(|(name, what)| FileRow::new(&prefix.of(name), what)).collect();
    let stores: &[(&str, &str)] = match params.memory {
        Memory::BlockRam => &[("engine_block_memory", "Blocks."), ("engine_triangle_memory", "Triangles.")],
        Memory::Axi => &[
            ("engine_block_cache", "Blocks of one tree behind a direct-mapped cache."),
            ("engine_triangle_cache", "Triangles of one object behind a direct-mapped cache."),
            ("engine_read_master", "AXI4 reads for the caches."),
        ],
    };
    let stores = stores.iter().filter(|(name, _)| !design.by_number || !name.contains("block"));
    entities.extend(stores.map(|(name, what)| FileRow::new(&prefix.of(name), what)));

    let readme = Readme {
        version: env!("CARGO_PKG_VERSION"),
        prefix,
        command_line,
        stack: params.stack,
        in_flight: params.in_flight,
        pace: pace(design.unit.interval),
        memory,
        axi: params.memory == Memory::Axi,
        by_number: design.by_number,
        top: prefix.of(design.top()),
        engines: params.engines,
        multipliers: params.engines as usize * (unit + volume),
        unit_multipliers: unit,
        volume_multipliers: volume,
        frequency: design.unit.params.frequency,
        device: design.unit.device.name,
        entities,
        files,
        stem: core_of(design).stem,
        projects,
        ports,
        simulate,
    };
    readme.render().expect("the template renders")
}

fn manifest_of(design: &EngineDesign, command_line: &str, files: &FileSet) -> String {
    let options = |list: Vec<(&'static str, String)>| list.into_iter().map(|(k, v)| (k.replace('-', "_"), v)).collect();
    let header = |command| format!("{:016x}", design.format.header(command));
    let unit = |kind| format!("{:016x}", design.format.stream.header(kind));
    let load = (design.params.memory == Memory::BlockRam).then(|| header(Command::Load));
    let (volume, trees) = (&design.volume, !design.by_number);
    let about = About {
        unit: options(design.unit.params.options()),
        engine: options(design.options()),
        clocks_per_pair: design.unit.interval,
        volumes: trees.then_some(Volumes { clocks_per_expansion: volume.interval, volume_latency: volume.latency }),
        unit_latency: design.unit.latency,
        multipliers: design.params.engines as usize * design.multipliers().iter().sum::<usize>(),
        packets: match trees {
            true => Packets::Queries {
                query_words: design.format.query_words(),
                pairs_header: unit(PacketKind::Pairs),
                pose_header: unit(PacketKind::Pose),
                query_header: header(Command::Query),
            },
            false => {
                Packets::Numbers { pairs_word: design.format.pairs_at(), numbers_header: header(Command::Numbers) }
            }
        },
        load_header: load,
        stop_header: trees.then(|| header(Command::Stop)),
        reset_header: header(Command::Reset),
    };
    manifest::of(command_line, about, files) + "\n"
}
