//! Strictness: every generated VHDL file, of several parameter sets, through every analyser there is, with warnings as
//! errors; and read back by synthesis. `scripts/strict` runs this with more analysers than a distribution has
//! (docs/strictness.md).

use crate::extent::share;
use crate::tools::ghdl;
use efsat::artefact::{FileSet, Scratch, design_files};
use efsat::design::{Design, Probes};
use efsat::number::Upper;
use efsat::params::{Axes, Bound, Method, Params, Projections, Transform};
use efsat::vhdl::lint::{lint, rules};
use efsat_hardware::tools::{Tool, find};
use rayon::prelude::*;
use std::path::Path;
use std::process::Command;

/// More analysers: paths with colons between.
const MORE: &str = "EFSAT_ANALYSERS";

/// All warnings of GHDL 2.0, which has no `-Wall`, that concern a design.
const WARNINGS: [&str; 8] =
    ["-Wbinding", "-Wreserved", "-Wlibrary", "-Wdelayed-checks", "-Wbody", "-Wspecs", "-Wunused", "-Werror"];

fn settings() -> Vec<(&'static str, Params)> {
    let default = Params::default;
    vec![
        ("default", default()),
        ("small", Params { width: 8, transform_width: 10, frequency: 40, ..default() }),
        ("17 axes", Params { axes: Axes::Seventeen, axes_per_clock: 3, ..default() }),
        ("sticky", Params { upper: Upper::Sticky, ..default() }),
        ("no transform", Params { transform: Transform::Off, ..default() }),
        ("translation", Params { transform: Transform::Translate, projections: Projections::Intersect, ..default() }),
        ("250 MHz", Params { frequency: 250, ..default() }),
        ("no tag", Params { tag_width: 0, ..default() }),
        ("no renormalisation", Params { renormalise: false, ..default() }),
        ("all axes at once", Params { axes_per_clock: 11, projections: Projections::Skip, ..default() }),
        ("determinants", Params { method: Method::Determinants, ..default() }),
        (
            "determinants, folded",
            Params { method: Method::Determinants, clocks_per_pair: 11, bound: Bound::Products, ..default() },
        ),
        (
            "determinants, wide",
            Params {
                method: Method::Determinants,
                width: 32,
                transform_width: 48,
                span: 3,
                clocks_per_pair: 2,
                ..default()
            },
        ),
        ("exact", Params::of(Method::Exact)),
        // Delay lines that begin where others end.
        ("exact, 130 MHz", Params { device: "lfe5u-85-6".to_owned(), frequency: 130, ..Params::of(Method::Exact) }),
        (
            "exact, folded and wide",
            Params {
                width: 30,
                clocks_per_pair: 6,
                transform: Transform::Translate,
                device: "lfe5u-85-6".to_owned(),
                ..Params::of(Method::Exact)
            },
        ),
        ("exact, snapped", Params { clocks_per_pair: 2, ..Params::snapped() }),
        ("cascade", Params { width: 32, exact_clocks: Some(16), ..Params::of(Method::Exact) }),
        ("wide", Params { width: 32, transform_width: 48, tag_width: 64, ..default() }),
    ]
}

/// GHDL as installed, and what the environment names.
fn tools() -> Vec<Tool> {
    let mut tools: Vec<Tool> = ghdl().cloned().into_iter().collect();
    let more = std::env::var(MORE).unwrap_or_default();
    for command in more.split(':').filter(|c| !c.is_empty()) {
        tools.push(find(&[command], "--version").unwrap_or_else(|| panic!("{MORE}: {command} does not run")));
    }
    tools
}

fn is_nvc(tool: &Tool) -> bool {
    tool.version.starts_with("nvc")
}

/// Analyses files in order, elaborates `benches` and synthesizes `tops`; all that is said against them.
fn complaints(tool: &Tool, dir: &Path, standard: &str, files: &[&str], benches: &[&str], tops: &[&str]) -> Vec<String> {
    let mut complaints = vec![];
    let mut run = |step: &[&str], more: &[&str]| {
        let output = Command::new(&tool.path).args(step).args(more).current_dir(dir).output();
        let output = output.unwrap_or_else(|e| panic!("{}: {e}", tool.path.display()));
        let text = String::from_utf8_lossy(&output.stderr);
        // A message that is not a note of what was found, such as a memory; the other lines quote the source.
        let message = |line: &&str| line.contains(":error:") || line.contains("warning") || line.starts_with("** ");
        let note = |line: &&str| line.contains(":note:") || line.starts_with("** Note");
        let said: Vec<&str> = text.lines().filter(message).filter(|line| !note(line)).collect();
        let other = text.lines().filter(|line| line.contains("latch") || line.contains("not bound"));
        let said: Vec<&str> = said.into_iter().chain(other).collect();
        complaints.extend(said.iter().map(|line| format!("{} {}: {line}", tool.version, more.join(" "))));
        // GHDL 2.0 says nothing of a latch or of a signal without a driver: what it makes of them is X.
        let netlist = String::from_utf8_lossy(&output.stdout);
        let lines: Vec<&str> = netlist.lines().collect();
        let unknown = (0..lines.len())
            .filter(|_| step.contains(&"--synth"))
            .filter(|n| (lines[*n].contains("'X'") || lines[*n].contains("\"X")) && !is_never_reached(&lines[..=*n]))
            .map(|n| lines[n]);
        complaints
            .extend(unknown.map(|line| format!("{} {}: a latch or no driver: {line}", tool.version, more.join(" "))));
        if said.is_empty() && !output.status.success() {
            complaints.push(format!("{} {}: {text}", tool.version, step.join(" ")));
        }
    };
    if is_nvc(tool) {
        let standard = if standard == "93" { "--std=1993" } else { "--std=2008" };
        run(&[standard, "-a"], files);
        benches.iter().for_each(|bench| run(&[standard, "-e"], &[bench]));
        return complaints;
    }
    let standard = format!("--std={standard}");
    let step = |command| [&[command, standard.as_str()], &WARNINGS[..]].concat();
    run(&step("-a"), files);
    benches.iter().for_each(|bench| run(&step("-e"), &[bench]));
    tops.iter().for_each(|top| run(&step("--synth"), &[top]));
    complaints
}

/// Whether the last line is what a selection has for all others, behind a choice for every value.
fn is_never_reached(lines: &[&str]) -> bool {
    let unknown = |last: &str| {
        let value = last.trim().strip_suffix(" when others;");
        value.is_some_and(|x| x == "'X'" || x.ends_with("=> 'X')") || x.trim_matches('"').bytes().all(|c| c == b'X'))
    };
    let Some((_, before)) = lines.split_last().filter(|(last, _)| unknown(last)) else {
        return false;
    };
    let choices: Vec<&str> = before.iter().rev().take_while(|line| line.ends_with("\",")).copied().collect();
    let value = |line: &&str| line.rsplit_once(" when \"").map_or(0, |(_, value)| value.len() - 2);
    choices.first().is_some_and(|line| choices.len() == 1 << value(line))
}

fn files(params: &Params) -> FileSet {
    design_files(&Design::new(params, Probes::None).unwrap(), &params.command_line()).unwrap()
}

/// The VHDL files of a set in dependency order, without testbenches.
fn synthesizable(set: &FileSet) -> Vec<(&str, &str)> {
    let list = set.get("files.txt").unwrap();
    let sources = list.lines().filter(|name| !name.ends_with("_tb.vhd"));
    sources.map(|name| (name, set.get(name).unwrap_or_else(|| panic!("{name} is listed and absent")))).collect()
}

fn entity(name: &str) -> &str {
    name.rsplit('/').next().unwrap_or(name).trim_end_matches(".vhd")
}

#[test]
fn every_generated_file_is_taken_without_a_warning() {
    let tools = &tools();
    // On every change every third design, by one standard, in turn.
    let jobs: Vec<(&str, Params, &Tool, &str)> = share(3, settings())
        .into_iter()
        .enumerate()
        .flat_map(|(i, (name, params))| {
            let standards = share(2, [["93", "08"], ["08", "93"]][i % 2]);
            let by = move |standard| tools.iter().map(move |tool| (tool, standard));
            standards.into_iter().flat_map(by).map(move |(tool, standard)| (name, params.clone(), tool, standard))
        })
        .collect();
    let results: Vec<(String, Vec<String>)> = jobs
        .par_iter()
        .map(|(name, params, tool, standard)| {
            let set = files(params);
            let dir = Scratch::new().unwrap();
            let list: Vec<&str> = set.get("files.txt").unwrap().lines().collect();
            for file in &list {
                let path = dir.path().join(file);
                std::fs::create_dir_all(path.parent().unwrap()).unwrap();
                std::fs::write(path, set.get(file).unwrap()).unwrap();
            }
            let sources = synthesizable(&set);
            let used =
                |name: &str| sources.iter().any(|(_, text)| text.contains(&format!("entity work.{}\n", entity(name))));
            let entities =
                sources.iter().filter(|(name, text)| text.contains(&format!("\nentity {} is", entity(name))));
            let tops: Vec<&str> = entities.map(|s| s.0).filter(|name| !used(name)).map(entity).collect();
            let benches: Vec<&str> =
                list.iter().filter(|name| name.ends_with("_tb.vhd")).map(|name| entity(name)).collect();
            assert!(!tops.is_empty() && !benches.is_empty());
            let complaints = complaints(tool, dir.path(), standard, &list, &benches, &tops);
            let row = format!("| {} | {standard} | {name} | {} | {} |", tool.version, list.len(), complaints.len());
            (row, complaints)
        })
        .collect();
    let complaints: Vec<&String> = results.iter().flat_map(|r| &r.1).collect();
    println!("| analyser | standard | design | files | complaints |\n| --- | --- | --- | --- | --- |");
    results.iter().for_each(|r| println!("{}", r.0));
    assert!(complaints.is_empty(), "{complaints:#?}");
}

/// A bad file with a good bench, and what must be said of it.
const BAD: [(&str, &str, &str); 6] = [
    ("latch", "signal q : std_logic;", "process (a, b) begin if a = '1' then q <= b; end if; end process; y <= q;"),
    ("", "signal q : std_logic;", "q <= a; q <= b; y <= q;"),
    ("", "signal q : std_logic;", "y <= q and a;"),
    (
        "bound",
        "component nothing is port (a : in std_logic; y : out std_logic); end component;",
        "c : nothing port map (a => a, y => y);",
    ),
    ("", "", "y <= undeclared;"),
    ("", "function f return std_logic is begin return '0'; end function;", "y <= a and b;"),
];

#[test]
fn every_analyser_sees_what_is_wrong() {
    let mut missed = vec![];
    for tool in tools().iter().filter(|tool| !is_nvc(tool)) {
        for (word, declaration, body) in BAD {
            let dir = Scratch::new().unwrap();
            let text = format!(
                "library ieee;\nuse ieee.std_logic_1164.all;\nentity bad is port (a, b : in std_logic; y : out std_logic); \
                 end entity;\narchitecture rtl of bad is\n{declaration}\nbegin\n{body}\nend architecture;\n"
            );
            std::fs::write(dir.path().join("bad.vhd"), text).unwrap();
            let complaints = complaints(tool, dir.path(), "93", &["bad.vhd"], &["bad"], &["bad"]);
            if !complaints.iter().any(|line| line.contains(word)) {
                missed.push(format!("{}: {body}: {complaints:?}", tool.version));
            }
        }
        let dir = Scratch::new().unwrap();
        std::fs::write(dir.path().join("later.vhd"), "entity later is end entity;\n/* a comment of VHDL-2008 */\n")
            .unwrap();
        if complaints(tool, dir.path(), "93", &["later.vhd"], &[], &[]).is_empty() {
            missed.push(format!("{}: takes VHDL-2008 as 93", tool.version));
        }
    }
    assert!(missed.is_empty(), "{}", missed.join("\n"));
}

#[test]
fn the_lint_passes_every_generated_file() {
    let findings: Vec<String> = share(2, settings())
        .par_iter()
        .flat_map(|(name, params)| {
            let set = files(params);
            let found = lint(&synthesizable(&set));
            found.iter().map(|finding| format!("{name}: {finding}")).collect::<Vec<_>>()
        })
        .collect();
    assert!(findings.is_empty(), "{}", findings.join("\n"));
}

#[test]
fn every_rule_is_documented() {
    let text = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/strictness.md")).unwrap();
    let missing: Vec<&str> =
        rules().iter().map(|rule| rule.0).filter(|name| !text.contains(&format!("| `{name}` | "))).collect();
    assert!(missing.is_empty(), "{missing:?}");
}

/// The lint sees the printed text: each line of a generated file that is broken is found again.
#[test]
fn the_lint_catches_changes_of_generated_files() {
    let set = files(&Params::default());
    let changes = [
        ("product", "multiply_18_18.vhd", "p <= x * y", "p <= x * y + 1"),
        ("clocked-process", "sequencer.vhd", "process (clk)", "process (clk, reset)"),
        ("named-association", "projection.vhd", "clk => clk", "clk"),
        ("constructs", "comparator_network.vhd", "process (clk)", "process (all)"),
        ("libraries", "efsat.vhd", "use ieee.numeric_std.all;", "use ieee.std_logic_unsigned.all;"),
        ("direct-entity", "efsat.vhd", "entity work.", "component "),
    ];
    let mut missed = vec![];
    for (rule, file, from, to) in changes {
        let change = |(name, text): (&str, &str)| {
            (name.to_owned(), if name == file { text.replace(from, to) } else { text.to_owned() })
        };
        let texts: Vec<(String, String)> = synthesizable(&set).into_iter().map(change).collect();
        let texts: Vec<(&str, &str)> = texts.iter().map(|(name, text)| (name.as_str(), text.as_str())).collect();
        if !lint(&texts).iter().any(|finding| finding.rule == rule && finding.file == file) {
            missed.push(format!("{rule}: {file}"));
        }
    }
    assert!(missed.is_empty(), "{missed:?}");
}
