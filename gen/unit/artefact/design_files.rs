//! All files of a generated design, as one value.

use super::check::{register_script, stream_vectors, testbench, vectors};
use super::files::core::{Core, FileRow};
use super::files::file_lists::{BenchFiles, FileLists};
use super::files::manifest;
use super::files::project::Project;
use super::units::{UnitRow, first_sentence, units};
use super::wrap::packaged::Packaged;
use super::wrap::registers::Shell;
use super::wrap::{board, drop_in, example, host, projects, stream};
use super::{FileSet, Prefix, Stimulus, origin, vhdl_files};
use crate::design::Design;
use crate::design::top::pace;
use crate::words::registers::Behind;
use crate::words::{StreamFormat, StreamWidth};
use askama::Template;
use efsat_hardware::vhdl::Clash;
use efsat_hardware::vhdl::lint::{Finding, lint};

/// Pairs in the vector file: some seconds of simulation.
const PAIRS: usize = 256;

/// What is chosen for the files of a design and does not change the unit.
#[derive(Clone, Debug, Default)]
pub struct Packaging {
    /// Words into the stream wrapper.
    pub stream_width: StreamWidth,
    /// What stands before all names.
    pub prefix: Prefix,
    /// Whether there are registers behind AXI4-Lite around the stream wrapper.
    pub registers: bool,
    /// Whether there are [Verilog files](super::verilog_files), too: name and text of those that are made already.
    pub verilog: Option<Vec<(String, String)>>,
}

/// Why a design cannot be printed: a defect of the generator, never of the parameters; a name that a prefix makes equal
/// to another; or registers for words that they cannot carry.
#[derive(Debug, thiserror::Error)]
pub enum DesignFilesError {
    /// A name that is not legal VHDL.
    #[error("names: {0}")]
    Name(#[from] Clash),
    /// A text that the target's tools would not take.
    #[error("lint: {0}")]
    Lint(Finding),
    /// What registers cannot be around.
    #[error("{found}; expected {expected}")]
    Registers {
        /// What was found.
        found: String,
        /// What can be.
        expected: &'static str,
    },
}

#[derive(Template)]
#[template(path = "rtl-readme.md", escape = "none")]
struct Readme<'a> {
    version: &'static str,
    prefix: &'a Prefix,
    command_line: &'a str,
    interval: usize,
    latency: usize,
    multipliers: usize,
    pace: String,
    register_bits: u64,
    frequency: u32,
    device: &'static str,
    delays: &'static str,
    units: Vec<UnitRow>,
    files: Vec<FileRow>,
    projects: Vec<Project>,
    ports: String,
    simulate: String,
}

/// As [`design_files_with`], packaged by default.
///
/// # Errors
/// A name in the design that is not legal VHDL, or a breach of the [rules](efsat_hardware::vhdl::lint) of the target.
pub fn design_files(design: &Design, command_line: &str) -> Result<FileSet, DesignFilesError> {
    design_files_with(design, &Packaging::default(), command_line)
}

/// Sources, stream wrapper, example, testbenches, vectors, projects, a README and the manifest. Equal designs and command
/// lines give equal bytes.
///
/// # Errors
/// As [`design_files`].
pub fn design_files_with(
    design: &Design,
    packaging: &Packaging,
    command_line: &str,
) -> Result<FileSet, DesignFilesError> {
    let Packaging { stream_width: width, prefix, registers, verilog } = packaging;
    let mut set = FileSet::default();
    let mut described = vec![];
    let constants = prefix.of("efsat_constants.vhd");
    let wrapper = format!("{prefix}{}.vhd", stream::NAME);
    let mut synthesised = vec![constants.clone()];
    let (params, origin) = (&design.params, origin());
    let modules = design.top.hierarchy();
    let entities = modules.iter().map(|module| first_sentence(&module.doc));
    let what = std::iter::once("Types and functions of the entities.".to_owned()).chain(entities);
    for ((name, text), what) in vhdl_files(design, prefix, command_line)?.into_iter().zip(what) {
        described.push(FileRow { name: name.clone(), what });
        set.insert(name.clone(), text);
        synthesised.push(name);
    }
    synthesised.push(wrapper.clone());
    let uart_bench = BenchFiles {
        entity: prefix.of("efsat_uart_tb"),
        file: format!("example/{prefix}efsat_uart_tb.vhd"),
        vectors: String::new(),
        what: "Testbench of the UART example",
        target: "sim_uart",
    };
    let benches = vec![
        BenchFiles::new(testbench::NAME, "Testbench of the unit", "sim", prefix),
        BenchFiles::new(stream::TESTBENCH, "Testbench of the stream wrapper", "sim_stream", prefix),
        uart_bench.clone(),
    ];
    let mut lists = FileLists::new(&Core::UNIT, synthesised, benches, prefix).with_example(prefix);
    let format = StreamFormat::new(params, *width);
    if *registers {
        lists = lists.with_registers(prefix);
        let (word, answer) = (width.bits(), format.answer_width());
        if word != 64 || answer > 64 {
            let found = format!("words of {word} bits in and {answer} out");
            return Err(DesignFilesError::Registers { found, expected: "64 in and at most 64 out" });
        }
    }
    let lists = lists;
    let mut describe = |name: &str, what: &str| described.push(FileRow::new(name, what));
    set.insert(&wrapper, stream::wrapper(design, &format, prefix, &origin));
    set.insert(&constants, host::package(design, &format, prefix));
    describe(&constants, "Widths, latency and places in the words of the stream, as VHDL constants for users.");
    for (name, text) in host::files(design, &format, prefix) {
        set.insert(name, text);
    }
    describe("host", "The words of the stream in C and in Python, and the exact retest in C.");
    describe(&wrapper, &format!("AXI4-Stream wrapper, words of {} bits in.", width.bits()));
    example::add(&mut set, design, &format, prefix, &uart_bench);
    describe("example", "The wrapped unit behind a UART, a whole design, and its testbench.");
    if *registers {
        let rows = shell(design, &format, &params.command_line(), prefix).add(&mut set);
        rows.iter().for_each(|row| describe(&row.name, &row.what));
    }

    let synthesised = &lists.synthesised[..];
    let texts: Vec<(&str, &str)> =
        synthesised.iter().filter_map(|name| set.get(name).map(|text| (name.as_ref(), text))).collect();
    if let Some(finding) = lint(&texts).into_iter().next() {
        return Err(DesignFilesError::Lint(finding));
    }

    let (unit_bench, stream_bench) = (&lists.benches[0], &lists.benches[1]);
    set.insert(&unit_bench.file, testbench::text(design, prefix, &origin));
    let stimulus = Stimulus::random(params, PAIRS, 1).followed_by(Stimulus::outside(params));
    set.insert(&unit_bench.vectors, vectors::text(params, &stimulus));
    describe(&unit_bench.file, "Testbench of the unit, for simulation only.");
    describe(
        &unit_bench.vectors,
        &match stimulus.pairs() - PAIRS {
            0 => format!("{PAIRS} random pairs under random poses, with the reference model's answers."),
            more => format!(
                "{PAIRS} random pairs under random poses and {more} for the guard, with the reference model's answers."
            ),
        },
    );
    set.insert(&stream_bench.file, stream::bench(design, &format, prefix, &origin));
    let mixed = stream_vectors::mixed(params, &format, stream_vectors::FILLING);
    set.insert(&stream_bench.vectors, stream_vectors::text(params, &format, &mixed));
    describe(&stream_bench.file, "Testbench of the wrapper, for simulation only.");
    describe(&stream_bench.vectors, "Packets of pairs and poses, good and malformed, with the expected answers.");
    set.insert("files.txt", lists.all().join("\n"));
    describe("files.txt", "All VHDL files in dependency order, the testbenches last.");
    set.insert(FileLists::SYNTHESISED, synthesised.join("\n"));
    describe(FileLists::SYNTHESISED, "The VHDL files to synthesise: the unit, its wrapper and the constants.");
    describe(
        manifest::NAME,
        "Parameters, ports, number formats, latency, the words of the stream, and a SHA-256 per file, for programs.",
    );
    let shell = registers.then(|| lists.top.clone());
    let instances = [prefix.of(stream::NAME), prefix.of("efsat")];
    let packaged = Packaged {
        core: &Core::UNIT,
        prefix,
        name: &drop_in::core_name(params, packaging),
        pace: &pace(design.interval),
        command_line,
        device: design.device,
        frequency: params.frequency,
        lists: &lists,
        instances: &shell.into_iter().chain(instances).collect::<Vec<_>>(),
    };
    let (rows, mut projects) = projects::add(&packaged, &mut set);
    described.extend(rows);
    projects.extend(board::add(&mut set, &Core::UNIT, design, prefix, synthesised));
    described.extend(projects.iter().map(FileRow::of_project));
    for (name, text) in verilog.iter().flatten() {
        set.insert(name, text);
        described.push(FileRow::of_verilog(name));
    }
    let (ports, simulate) = (packaged.port_tables(&set), packaged.simulation());
    set.insert("README.md", readme(design, packaging, command_line, described, projects, ports, simulate));
    let manifest = manifest::text(design, Some(&format), command_line, &set);
    set.insert(manifest::NAME, manifest);
    Ok(set)
}

/// The registers around the wrapper.
fn shell<'a>(design: &Design, format: &StreamFormat, options: &'a str, prefix: &'a Prefix) -> Shell<'a> {
    Shell {
        behind: Behind::Unit,
        options,
        prefix,
        core: stream::NAME,
        answer_bits: format.answer_width(),
        query_kind: String::new(),
        report: (1, String::new()),
        more_ports: String::new(),
        half_period: format!("{} ps", testbench::half_period(&design.params)),
        memory: [String::new(), String::new()],
        script: register_script::unit(&design.params, format, options),
    }
}

fn readme(
    design: &Design,
    packaging: &Packaging,
    command_line: &str,
    files: Vec<FileRow>,
    projects: Vec<Project>,
    ports: String,
    simulate: String,
) -> String {
    let prefix = &packaging.prefix;
    let readme = Readme {
        version: env!("CARGO_PKG_VERSION"),
        prefix,
        command_line,
        interval: design.interval,
        latency: design.latency,
        multipliers: design.top.multipliers(),
        pace: pace(design.interval),
        register_bits: design.top.register_bits(),
        frequency: design.params.frequency,
        device: design.device.name,
        delays: design.device.source,
        units: units(design, prefix),
        files,
        projects,
        ports,
        simulate,
    };
    readme.render().expect("the template renders")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::Params;
    use std::collections::BTreeSet;

    fn default_files() -> FileSet {
        let params = Params::default();
        design_files(&Design::new(&params, false).unwrap(), &params.command_line()).unwrap()
    }

    #[test]
    fn equal_parameters_give_equal_bytes() {
        assert_eq!(default_files(), default_files());
    }

    #[test]
    fn every_file_says_where_it_comes_from() {
        let command_line = Params::default().command_line();
        for (name, text) in default_files().iter() {
            assert!(text.is_ascii() && text.ends_with('\n') && !text.ends_with("\n\n"), "{name}");
            let generated = format!("-- Generated by efsat {}; do not edit.", env!("CARGO_PKG_VERSION"));
            if name == "efsat.vhd" {
                let lines: Vec<&str> = text.lines().take(4).collect();
                assert_eq!(lines[2..], [generated, format!("-- {command_line}")]);
            } else if name.ends_with(".vhd") {
                assert!(!text.contains(&command_line), "{name}");
            }
        }
    }

    #[test]
    fn lists_are_in_dependency_order() {
        let set = default_files();
        let order: Vec<&str> = set.get("files.txt").unwrap().lines().collect();
        let benches = ["efsat_tb.vhd", "efsat_stream_tb.vhd", "example/efsat_uart_tb.vhd"];
        assert_eq!(order[order.len() - 3..], benches);
        let stem = |name: &str| name.rsplit('/').next().unwrap().trim_end_matches(".vhd").to_owned();
        for (i, name) in order.iter().enumerate() {
            let text = set.get(name).unwrap();
            for later in &order[i..] {
                assert!(!text.contains(&format!("entity work.{}\n", stem(later))), "{name} uses {later}");
            }
        }
        let end = order.iter().position(|name| *name == "efsat_stream.vhd").unwrap();
        assert_eq!(order[end - 1], "efsat.vhd");
        for (list, line) in [
            ("ise/efsat.prj", "vhdl work \"../NAME\""),
            ("ise/project.tcl", "xfile add ../NAME"),
            ("efsat.core", "      - NAME"),
        ] {
            let lines: Vec<&str> =
                set.get(list).unwrap().lines().filter(|line| line.contains(".vhd") && !line.contains('*')).collect();
            let named: Vec<String> = order[..=end].iter().map(|name| line.replace("NAME", name)).collect();
            assert_eq!(lines[..=end], named, "{list}");
            assert!(list == "efsat.core" || lines.len() == named.len(), "{list}");
        }
        let all: BTreeSet<&str> = set.iter().map(|(name, _)| name).filter(|name| name.ends_with(".vhd")).collect();
        assert_eq!(all, order.into_iter().collect(), "every VHDL file is in the list");
    }

    #[test]
    fn a_tool_that_knows_the_device_gets_a_project() {
        let files = |device: &str| {
            let params = Params { device: device.to_owned(), ..Params::default() };
            design_files(&Design::new(&params, false).unwrap(), &params.command_line()).unwrap()
        };
        let expected = [
            ("xc2v6000-4", "ise", "efsat.xst", "-p xc2v6000-4-bf957\n"),
            ("xc2v6000-4", "ise", "project.tcl", "project new efsat.ise\n"),
            ("xc2v6000-4", "ise", "efsat.ucf", "PERIOD \"aclk\" 100 MHz HIGH 50 %;"),
            ("xc6slx150-3", "ise", "efsat.xst", "-p xc6slx150-3-fgg676\n"),
            ("xc6slx150-3", "ise", "project.tcl", "project new efsat.xise\n"),
            ("xc7a200t-1", "vivado", "project.tcl", "\"xc7a200tfbg676-1\""),
            ("xc7a200t-1", "vivado", "efsat_ooc.xdc", "-period 10.000 "),
            ("xc7a200t-1", "vivado", "package_ip.tcl", "  [file join $here .. efsat_stream.vhd] \\\n]"),
        ];
        for (device, folder, name, part) in expected {
            let set = files(device);
            let text = set.get(&format!("{folder}/{name}")).unwrap_or_else(|| panic!("{device}: {folder}/{name}"));
            assert!(text.contains(part), "{device}: {folder}/{name}: {text}");
            let readme = set.get("README.md").unwrap();
            let other = if folder == "ise" { "vivado" } else { "ise" };
            assert!(set.iter().all(|(name, _)| !name.starts_with(&format!("{other}/"))), "{device}");
            assert!(
                readme.contains(&format!("| `{folder}` |")) && !readme.contains(&format!("| `{other}` |")),
                "{device}"
            );
        }
        assert!(files("lfe5u-85-6").iter().all(|(name, _)| !name.ends_with(".tcl")));
    }

    #[test]
    fn a_device_on_a_board_gets_the_files_of_the_board() {
        let files = |device: &str| {
            let params = Params { device: device.to_owned(), frequency: 60, ..Params::default() };
            design_files(&Design::new(&params, false).unwrap(), &params.command_line()).unwrap()
        };
        let expected = [
            ("lfe5u-85-6", "ulx3s", "efsat_ulx3s.vhd", "clock_frequency : positive := 60000000;"),
            ("lfe5u-85-6", "ulx3s", "efsat_ulx3s_clock.v", ".CLKFB_DIV(12)"),
            ("lfe5u-85-6", "ulx3s", "efsat_ulx3s_stand_in.vhd", "entity efsat_ulx3s_clock is"),
            ("lfe5u-85-6", "ulx3s", "build.sh", "--freq 60 "),
            ("xc7a100t-1", "arty_a7", "efsat_arty_a7.vhd", "clock_frequency : positive := 59701492;"),
            ("xc7a100t-1", "arty_a7", "efsat_arty_a7_clock.vhd", "CLKOUT0_DIVIDE_F => 16.750"),
            ("xc7a100t-1", "arty_a7", "project.tcl", "-part \"xc7a100tcsg324-1\""),
        ];
        for (device, folder, name, part) in expected {
            let set = files(device);
            let text = set.get(&format!("{folder}/{name}")).unwrap_or_else(|| panic!("{device}: {folder}/{name}"));
            assert!(text.contains(part), "{device}: {folder}/{name}: {text}");
            assert!(set.get("README.md").unwrap().contains(&format!("| `{folder}` |")), "{device}");
            // Every port of the top has a pin, and no pin is of anything else.
            let top = set.get(&format!("{folder}/efsat_{folder}.vhd")).unwrap();
            let ports = top.split("  port (\n").nth(1).unwrap().split("  );").next().unwrap();
            let ports: BTreeSet<&str> =
                ports.lines().filter_map(|line| Some(line.split_once(" : ")?.0.trim())).collect();
            let ending = if folder == "ulx3s" { "lpf" } else { "xdc" };
            let constraints = set.get(&format!("{folder}/efsat_{folder}.{ending}")).unwrap();
            let pin = |line: &str| match ending {
                "lpf" => Some(line.strip_prefix("LOCATE COMP \"")?.split('"').next()?.to_owned()),
                _ if line.contains("PACKAGE_PIN") => {
                    Some(line.split("get_ports ").nth(1)?.trim_end_matches(']').to_owned())
                }
                _ => None,
            };
            let pins: Vec<String> = constraints.lines().filter_map(pin).collect();
            assert_eq!(pins.len(), ports.len(), "{pins:?}");
            assert_eq!(pins.iter().map(String::as_str).collect::<BTreeSet<_>>(), ports, "{device}");
        }
        assert!(files("xc7a200t-1").iter().all(|(name, _)| !name.starts_with("arty")));
    }
}
