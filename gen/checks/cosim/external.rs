//! GHDL and nvc: write design, testbench and vectors to a folder, run, read the result back.

use super::{CosimError, Options, Run, Simulator, wave};
use crate::process;
use efsat_hardware::tools::{self, Tool};
use efsat_unit::artefact::{self, Prefix, Scratch, Stimulus, testbench};
use efsat_unit::design::Design;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};

/// Up to so many vectors the back end that compiles fastest is taken.
const FEW: usize = 64;

pub(super) fn file_error(path: &Path) -> impl Fn(std::io::Error) -> CosimError + '_ {
    move |source| CosimError::File { path: path.display().to_string(), source }
}

/// The folder of a run, a temporary one if none is to be kept; that is deleted with what is returned beside it.
pub(super) fn folder(keep: Option<&Path>) -> Result<(PathBuf, Option<Scratch>), CosimError> {
    if let Some(dir) = keep {
        std::fs::create_dir_all(dir).map_err(file_error(dir))?;
        return Ok((dir.to_owned(), None));
    }
    let scratch = Scratch::new().map_err(file_error(&std::env::temp_dir()))?;
    Ok((scratch.path().to_owned(), Some(scratch)))
}

/// Writes a file into a folder.
pub(super) fn write_file(dir: &Path, name: &str, text: &str) -> Result<(), CosimError> {
    let path = dir.join(name);
    std::fs::write(&path, text).map_err(file_error(&path))
}

/// Writes what is to be kept of a run that needs no files.
pub(super) fn keep(
    design: &Design,
    command_line: &str,
    stimulus: &Stimulus,
    options: &Options,
) -> Result<(), CosimError> {
    match &options.keep {
        Some(dir) => {
            std::fs::create_dir_all(dir).map_err(file_error(dir))?;
            write(design, command_line, stimulus, dir).map(|_| ())
        }
        None => Ok(()),
    }
}

/// Refuses a folder that holds files of somebody else: what is kept would mix with them or overwrite them.
pub(super) fn check_keep(dir: &Path) -> Result<(), CosimError> {
    if !dir.exists() {
        return Ok(());
    }
    let mut entries = std::fs::read_dir(dir).map_err(file_error(dir))?;
    let ours = dir.join(format!("{}.vec", testbench::NAME)).is_file();
    if ours || entries.next().is_none() {
        return Ok(());
    }
    let message = format!(
        "--keep {}: holds files that efsat did not write; expected a new or empty folder, or one of an earlier run",
        dir.display()
    );
    Err(CosimError::Option(message))
}

/// A simulator; with `short` the one that compiles fastest, whatever its speed afterwards.
pub(super) fn command(simulator: Simulator, short: bool) -> Result<Tool, CosimError> {
    match simulator {
        Simulator::Nvc => {
            tools::find(&["nvc"], "--version").ok_or(CosimError::Missing("nvc", "see https://www.nickg.me.uk/nvc"))
        }
        _ => tools::ghdl(short).ok_or(CosimError::Missing("GHDL", "apt-get install ghdl-llvm")),
    }
}

/// Name and text of every source in dependency order, the testbench last.
pub(super) fn sources(design: &Design, command_line: &str) -> Result<Vec<(String, String)>, CosimError> {
    let mut sources = artefact::vhdl_files(design, &Prefix::default(), command_line)?;
    let origin = artefact::origin();
    sources.push((format!("{}.vhd", testbench::NAME), testbench::text(design, &Prefix::default(), &origin)));
    Ok(sources)
}

/// Writes the sources into a folder; returns their names in dependency order.
fn write(design: &Design, command_line: &str, stimulus: &Stimulus, dir: &Path) -> Result<Vec<String>, CosimError> {
    let mut sources = sources(design, command_line)?;
    let vectors = artefact::vectors::text(&design.params, stimulus);
    let names = sources.iter().map(|(name, _)| name.clone()).collect();
    sources.push((format!("{}.vec", testbench::NAME), vectors));
    sources.iter().try_for_each(|(name, text)| write_file(dir, name, text))?;
    Ok(names)
}

/// Runs a command in a folder; its whole output if it succeeds or ran to the end.
pub(super) fn call(dir: &Path, program: &Path, args: &[String], must: bool) -> Result<String, CosimError> {
    let name = program.file_name().unwrap_or_default().to_string_lossy();
    let failed = |message: String| CosimError::Failed { tool: name.clone().into_owned(), message };
    let output =
        process::output(Command::new(program).args(args).current_dir(dir)).map_err(|e| failed(e.to_string()))?;
    let text = String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
    if must && !output.status.success() {
        let line = text.lines().find(|l| l.contains("error")).or(text.lines().next()).unwrap_or("failed");
        return Err(failed(line.to_owned()));
    }
    Ok(text)
}

pub(super) fn run(
    design: &Design,
    command_line: &str,
    stimulus: &Stimulus,
    options: &Options,
) -> Result<Run, CosimError> {
    // Those for a guard come on top: to compile longer for them does not pay.
    let asked = stimulus.pairs() - Stimulus::outside(&design.params).pairs();
    let command = command(options.simulator, asked <= FEW)?;
    let (dir, _scratch) = folder(options.keep.as_deref())?;
    let wave = options.wave.as_ref().map(|w| absolute(w)).transpose()?;
    let names = write(design, command_line, stimulus, &dir)?;
    let dir = dir.canonicalize().map_err(file_error(&dir))?;
    let (text, simulation) = execute(&command, &dir, &names, wave.as_deref())?;
    let simulator = version(&command);
    if let Some(wave) = &wave {
        let layout = wave.with_extension("gtkw");
        // A layout that somebody has saved from GTKWave stays.
        let text = std::fs::read_to_string(&layout).unwrap_or_else(|_| wave::MARK.to_owned());
        if text.starts_with(wave::MARK) {
            std::fs::write(&layout, wave::layout(design, wave)).map_err(file_error(&layout))?;
        }
    }
    if options.keep.is_some() {
        let log = dir.join("simulation.log");
        std::fs::write(&log, &text).map_err(file_error(&log))?;
    }
    let mut run = parse(&text, &command.name())?;
    run.simulator = simulator;
    run.simulation = simulation;
    if options.probe {
        run.probes = probes(design, &dir.join("efsat_tb.probe"))?;
    }
    Ok(run)
}

fn absolute(path: &Path) -> Result<PathBuf, CosimError> {
    match path.extension().and_then(|e| e.to_str()) {
        Some("ghw" | "vcd") => {
            let path = std::path::absolute(path).map_err(file_error(path))?;
            match path.parent() {
                Some(parent) if !parent.is_dir() => {
                    Err(CosimError::Option(format!("--wave {}: {} is no folder", path.display(), parent.display())))
                }
                _ => Ok(path),
            }
        }
        _ => Err(CosimError::Option(format!("--wave {}: expected a file ending in .ghw or .vcd", path.display()))),
    }
}

pub(super) fn version(command: &Tool) -> String {
    format!("{} ({})", command.name(), command.version)
}

/// The calls that bring the sources from text to a testbench `top` that is ready to run, in strict VHDL-93.
pub(super) fn build(command: &Tool, names: &[String], top: &str) -> Vec<Vec<String>> {
    let command = command.name();
    let optimised = command == "ghdl-llvm" || command == "ghdl-gcc";
    let analyse = match &command[..] {
        "nvc" => "--std=1993 -a",
        _ if optimised => "-a --std=93 -O2",
        _ => "-a --std=93",
    };
    let elaborate = if command == "nvc" { "--std=1993 -e" } else { "-e --std=93" };
    let mut analyse = words(analyse);
    analyse.extend(names.iter().cloned());
    let mut elaborate = words(elaborate);
    elaborate.push(top.to_owned());
    vec![analyse, elaborate]
}

/// The call that runs a testbench, with some options more; every metavalue warning is let through.
pub(super) fn simulate(command: &Tool, top: &str, options: impl IntoIterator<Item = String>) -> Vec<String> {
    let name = top.to_owned();
    let mut args;
    if command.name() == "nvc" {
        args = words("--std=1993 -r");
        args.extend(options);
        args.push(name);
    } else {
        args = words("-r --std=93");
        args.push(name);
        args.extend(options);
    }
    args
}

fn words(text: &str) -> Vec<String> {
    text.split_whitespace().map(str::to_owned).collect()
}

/// Builds and runs; the simulation's lines and its duration.
fn execute(
    command: &Tool,
    dir: &Path,
    names: &[String],
    wave: Option<&Path>,
) -> Result<(String, Duration), CosimError> {
    let vcd = wave.is_some_and(|wave| wave.extension().is_some_and(|e| e == "vcd"));
    let nvc = command.name() == "nvc";
    if nvc && wave.is_some() && !vcd {
        return Err(CosimError::Option("--wave: nvc writes .vcd, not .ghw".to_owned()));
    }
    for args in build(command, names, testbench::NAME) {
        call(dir, &command.path, &args, true)?;
    }
    let mut options = vec![];
    if let Some(wave) = wave {
        if nvc {
            options.push("--format=vcd".to_owned());
        }
        let option = if vcd && !nvc { "--vcd" } else { "--wave" };
        options.push(format!("{option}={}", wave.display()));
    }
    let start = Instant::now();
    let text = call(dir, &command.path, &simulate(command, testbench::NAME, options), false)?;
    Ok((text, start.elapsed()))
}

/// Reads the testbench's lines.
pub(super) fn parse(text: &str, command: &str) -> Result<Run, CosimError> {
    let failed = |message: &str| CosimError::Failed { tool: command.to_owned(), message: message.to_owned() };
    let mut run = Run::default();
    if let Some(line) = text.lines().find(|l| l.contains("metavalue")) {
        return Err(failed(line));
    }
    let last = text.lines().find_map(|l| l.split_once("efsat_tb: vectors ").map(|x| x.1));
    let Some(summary) = last else {
        let line = text.lines().find(|l| l.contains("efsat_tb:") || l.contains("error")).or(text.lines().last());
        return Err(failed(line.unwrap_or("the testbench said nothing")));
    };
    let words: Vec<&str> = summary.split_whitespace().collect();
    let field = |name: &str| {
        let place = words.iter().position(|w| *w == name)?;
        words.get(place + 1)?.parse().ok()
    };
    let number = |name: &str| field(name).ok_or_else(|| failed(summary));
    run.mismatches = number("mismatches")?;
    run.clocks = number("clocks")?;
    run.latency = number("latency")?;
    run.interval = number("interval")?;
    run.total = number("total")?;
    let mismatch = text.lines().find_map(|l| l.split_once("efsat_tb: mismatch at ").map(|x| x.1));
    run.first = mismatch.map(str::to_owned);
    let complaints = ["assertion error", "assertion failure", "Error:", "Failure:"];
    let complaint = text.lines().find(|line| complaints.iter().any(|word| line.contains(word)));
    if let (0, Some(line)) = (run.mismatches, complaint) {
        return Err(failed(line));
    }
    Ok(run)
}

/// The log of the probe ports: one line per clock.
pub(super) fn probes(design: &Design, path: &Path) -> Result<Vec<(bool, Vec<i128>)>, CosimError> {
    let text = std::fs::read_to_string(path).map_err(file_error(path))?;
    let word = testbench::probe_word(design);
    let widths: Vec<usize> = word.fields.iter().map(|f| f.2 as usize).collect();
    let line = |line: &str| {
        let (accepted, hex) = line.split_once(' ').unwrap_or((line, ""));
        let bits: Vec<bool> = hex
            .bytes()
            .rev()
            .flat_map(|c| {
                let digit = (c as char).to_digit(16).unwrap_or(0);
                (0..4).map(move |i| (digit >> i) & 1 == 1)
            })
            .collect();
        let mut low = 0;
        let values = widths.iter().map(|w| {
            let value = (0..*w).fold(0i128, |v, i| v | (i128::from(bits.get(low + i) == Some(&true)) << i));
            low += w;
            value
        });
        (accepted == "1", values.collect())
    };
    Ok(text.lines().map(line).collect())
}
