//! `efsat list`.

use super::error::Failure;
use super::output::print;
use efsat_engine::params::EngineParams;
use efsat_geometry::mesh::{BUILTIN, builtin};
use efsat_hardware::device::{self, Device};
use efsat_unit::params::options::OptionRow;
use efsat_unit::params::{Method, Params};
use efsat_unit::parts::registers;

/// Prints what there is to choose from, as a table in Markdown: options with their defaults, devices, or built-in meshes
#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// What to list
    #[arg(value_name = "WHAT")]
    what: What,
}

#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum What {
    /// Options that all methods have
    Options,
    /// Options of separating axes that not all methods have
    AxesOptions,
    /// The same of determinants
    DeterminantsOptions,
    /// The same of the exact unit
    ExactOptions,
    /// Options of the collision engine
    EngineOptions,
    /// Registers of `generate --registers`
    Registers,
    /// Why these refuse an access
    RefusedAccesses,
    /// Devices: what is on the part, and the delays that pipelining reckons with, in nanoseconds
    Devices,
    /// Built-in meshes
    Meshes,
}

pub(super) fn run(arguments: &Arguments, command: &clap::Command) -> Result<(), Failure> {
    print(&match arguments.what {
        What::Options => options(command, |row| row.of.len() == 3 || row.name == "method"),
        What::AxesOptions => of(command, Method::Axes),
        What::DeterminantsOptions => of(command, Method::Determinants),
        What::ExactOptions => of(command, Method::Exact),
        What::EngineOptions => {
            let engine = EngineParams::default().options();
            rows_of(command, |name| engine.iter().any(|(option, _)| *option == name))
        }
        What::Registers => registers::table(),
        What::RefusedAccesses => registers::refusal_table(),
        What::Devices => devices(),
        What::Meshes => meshes(),
    })
}

/// A table in Markdown.
fn table(head: &[&str], numbers: usize, rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let rule = (0..head.len()).map(|i| if i + numbers < head.len() { "---" } else { "---:" }.to_owned());
    let lines = [head.iter().map(|&cell| cell.to_owned()).collect(), rule.collect()].into_iter().chain(rows);
    lines.map(|cells: Vec<String>| format!("| {} |\n", cells.join(" | "))).collect()
}

/// Options of one method that not all methods have.
fn of(command: &clap::Command, method: Method) -> String {
    options(command, |row| row.of.len() < 3 && row.of.contains(&method) && row.name != "method")
}

fn options(command: &clap::Command, wanted: impl Fn(&OptionRow) -> bool) -> String {
    let paper = Params::paper().differences(&Params::default());
    let names: Vec<_> = Params::OPTIONS.iter().filter(|row| wanted(row)).map(|row| row.name).collect();
    // The flag stands for options of the paper's design.
    let flag = |name: &str| name == "like-paper" && paper.iter().any(|(option, _)| names.contains(option));
    rows_of(command, |name| names.contains(&name) || flag(name))
}

/// The options of `efsat generate` of some names, in the order in which its help has them.
fn rows_of(command: &clap::Command, wanted: impl Fn(&str) -> bool) -> String {
    let generate = command.find_subcommand("generate").expect("a command");
    let arguments = generate.get_arguments().filter(|argument| argument.get_long().is_some_and(&wanted));
    let rows = arguments.map(|argument| {
        let values: Vec<_> = argument.get_possible_values().iter().map(|value| value.get_name().to_owned()).collect();
        let takes = argument.get_action().takes_values();
        let value = match argument.get_value_names() {
            _ if !takes => String::new(),
            _ if (1..=6).contains(&values.len()) => format!(" {}", values.join("\\|")),
            names => format!(" {}", names.map_or("", |names| names[0].as_str()).replace('|', "\\|")),
        };
        let default = if takes { argument.get_default_values() } else { &[] };
        let default: Vec<_> = default.iter().map(|value| value.to_string_lossy().into_owned()).collect();
        let help = argument.get_help().map(ToString::to_string).unwrap_or_default().replace('|', "\\|");
        vec![format!("`--{}{value}`", argument.get_long().unwrap_or_default()), default.join(", "), help]
    });
    table(&["option", "default", "meaning"], 0, rows)
}

fn devices() -> String {
    let row = |d: &Device| {
        let rounded = |ns: f64| (ns * 1000.0).round() / 1000.0;
        let delay = |(first, bit): (f64, f64)| match rounded(bit) {
            0.0 => rounded(first).to_string(),
            bit => format!("{} + {bit} k", rounded(first)),
        };
        let capacity = [d.multipliers.into(), d.capacity.luts, d.capacity.flip_flops, d.block_rams.into()];
        let cells = capacity.map(|n: u64| n.to_string()).into_iter().chain(d.delays().map(delay));
        std::iter::once(format!("`{}`", d.name)).chain(cells).collect()
    };
    let parts = ["device", "multipliers", "LUTs", "flip-flops", "block RAMs"];
    let delays = [
        "clock to output",
        "set-up",
        "LUT",
        "net",
        "net with many loads",
        "carry chain, k + 2 bits",
        "product, bit k",
        "register behind it",
    ];
    let head = [&parts[..], &delays].concat();
    table(&head, head.len() - 1, device::all().iter().map(row))
}

fn meshes() -> String {
    let row = |name: &str| {
        let mesh = builtin(name).expect("one of the names");
        vec![format!("`builtin:{name}`"), mesh.faces().len().to_string(), mesh.degenerate().len().to_string()]
    };
    table(&["mesh", "triangles", "degenerate"], 2, BUILTIN.into_iter().map(row))
}
