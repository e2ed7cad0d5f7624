//! Trials: printed text that was changed on purpose, run until the first difference from the reference model.

use super::external::{self, file_error};
use super::{CosimError, Simulator, probe};
use crate::process::{self, FOREVER, Running};
use efsat_hardware::tools::Tool;
use efsat_unit::artefact::{Scratch, Stimulus, testbench};
use efsat_unit::design::{Design, Probes};
use efsat_unit::params::Params;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

/// Clocks that a trial may run longer than the unchanged design before it counts as silent.
const GRACE: u64 = 64;

/// The testbench's words before a wrong answer.
const MISMATCH: &str = "efsat_tb: mismatch at ";

/// What became of a trial.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Trial {
    /// No difference in any answer, tag, latency, interval or probe.
    Agrees,
    /// The text is no legal VHDL, or widths do not fit: it cannot be tried.
    Invalid(String),
    /// An answer or a tag differs.
    Answer(String),
    /// All answers are right, but latency, interval or the clocks of the whole run are not.
    Timing(String),
    /// An inner node differs, and no answer does.
    Node(String),
    /// Fewer answers than pairs in the time that the unchanged design takes.
    Silent(String),
    /// The simulator stops with an error or reports metavalues.
    Broken(String),
}

/// A design with its testbench and vectors, ready to be run with changed files.
pub struct Bench {
    params: Params,
    probed: bool,
    stimulus: Stimulus,
    command: Tool,
    /// Sources in dependency order, the testbench last.
    sources: Vec<(String, String)>,
    vectors: String,
    /// Clocks of the whole run of the unchanged design.
    total: Option<u64>,
}

impl Bench {
    /// Prints the design and runs it unchanged once, to see that it agrees and how long it takes. With `probed` inner
    /// nodes are compared too.
    ///
    /// # Errors
    /// As [`super::run`]; the unchanged design not agreeing is one of them.
    pub fn new(params: &Params, stimulus: Stimulus, simulator: Simulator, probed: bool) -> Result<Self, CosimError> {
        let command = external::command(simulator, true)?;
        let stimulus = stimulus.followed_by(Stimulus::outside(params));
        let sources = external::sources(&Design::new(params, probed)?, &params.command_line())?;
        let vectors = efsat_unit::artefact::vectors::text(params, &stimulus);
        let mut bench = Self { params: params.clone(), probed, stimulus, command, sources, vectors, total: None };
        let (trial, total) = bench.simulate(None)?;
        if trial != Trial::Agrees {
            let message = format!("the unchanged design does not agree: {trial:?}");
            return Err(CosimError::Failed { tool: bench.command.name(), message });
        }
        bench.total = Some(total);
        Ok(bench)
    }

    /// The printed files of the design, without the testbench: name and text.
    pub fn files(&self) -> &[(String, String)] {
        &self.sources[..self.sources.len() - 1]
    }

    /// Runs the design with `text` in place of the file `name`.
    ///
    /// # Errors
    /// Files that cannot be written, or a simulator that cannot be started.
    pub fn run(&self, name: &str, text: &str) -> Result<Trial, CosimError> {
        Ok(self.simulate(Some((name, text)))?.0)
    }

    /// The outcome, and the clocks of the whole run if it went to its end.
    fn simulate(&self, changed: Option<(&str, &str)>) -> Result<(Trial, u64), CosimError> {
        let scratch = Scratch::new().map_err(file_error(&std::env::temp_dir()))?;
        let dir = scratch.path();
        let write = |name: &str, text: &str| external::write_file(dir, name, text);
        for (name, text) in &self.sources {
            let changed = changed.filter(|(file, _)| file == name);
            write(name, changed.map_or(text.as_str(), |(_, text)| text))?;
        }
        write(&format!("{}.vec", testbench::NAME), &self.vectors)?;
        if let Some(line) = self.analyse(dir)? {
            return Ok((Trial::Invalid(line), 0));
        }
        let lines = self.watch(dir)?;
        self.judge(&lines, dir)
    }

    /// Analyses and elaborates; the first error if there is one.
    fn analyse(&self, dir: &Path) -> Result<Option<String>, CosimError> {
        let names: Vec<String> = self.sources.iter().map(|(name, _)| name.clone()).collect();
        for args in external::build(&self.command, &names, testbench::NAME) {
            let output = process::output(Command::new(&self.command.path).args(&args).current_dir(dir));
            let output = output.map_err(|e| self.failed(&e.to_string()))?;
            if !output.status.success() {
                let text = String::from_utf8_lossy(&output.stdout) + String::from_utf8_lossy(&output.stderr);
                let line = text.lines().find(|line| line.contains(':')).or(text.lines().next());
                return Ok(Some(line.unwrap_or("refused").to_owned()));
            }
        }
        Ok(None)
    }

    /// Runs the simulation; its lines up to the first that decides.
    fn watch(&self, dir: &Path) -> Result<Vec<String>, CosimError> {
        let failed = |e: std::io::Error| self.failed(&e.to_string());
        let log = dir.join("errors.log");
        let errors = std::fs::File::create(&log).map_err(file_error(&log))?;
        let mut command = Command::new(&self.command.path);
        command
            .args(external::simulate(&self.command, testbench::NAME, self.total.map(|total| self.stop_time(total))))
            .current_dir(dir)
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(errors);
        let mut simulation = Running::start(&mut command).map_err(failed)?;
        let mut lines = vec![];
        let mut patience = FOREVER;
        if let Some(out) = simulation.stdout() {
            for line in BufReader::new(out).split(b'\n') {
                let line = String::from_utf8_lossy(&line.map_err(failed)?).into_owned();
                let decided = line.contains(MISMATCH) || line.contains("metavalue");
                lines.push(line);
                if decided {
                    patience = Duration::ZERO;
                    break;
                }
            }
        }
        simulation.wait(patience).map_err(failed)?;
        let errors = std::fs::read(&log).map_err(file_error(&log))?;
        lines.extend(String::from_utf8_lossy(&errors).lines().map(str::to_owned));
        Ok(lines)
    }

    /// The option that gives up a run that still goes on when the unchanged design has long been done.
    fn stop_time(&self, total: u64) -> String {
        let period = 2 * u64::from(testbench::half_period(&self.params));
        format!("--stop-time={}ps", (total + GRACE) * period)
    }

    /// What the lines of a simulation say, and its clocks if it went to its end.
    fn judge(&self, lines: &[String], dir: &Path) -> Result<(Trial, u64), CosimError> {
        let after = |mark: &str| lines.iter().find_map(|line| line.split_once(mark)).map(|(_, rest)| rest.to_owned());
        if let Some(rest) = after(MISMATCH) {
            let place = rest.split_once(" pair ").map_or(rest.as_str(), |(place, _)| place);
            return Ok((Trial::Answer(place.to_owned()), 0));
        }
        if let Some(invalid) = lines.iter().find(|line| line.contains("bound check failure")) {
            return Ok((Trial::Invalid(invalid.clone()), 0));
        }
        let broken = match external::parse(&lines.join("\n"), &self.command.name()) {
            Ok(run) if self.total.is_some_and(|total| total != run.total) => {
                let total = self.total.unwrap_or_default();
                return Ok((Trial::Timing(format!("{} clocks in all instead of {total}", run.total)), run.total));
            }
            Ok(run) if self.probed => {
                // A design is not to be shared by threads, so every run has its own.
                let design = Design::new(&self.params, Probes::All)?;
                let log = external::probes(&design, &dir.join(format!("{}.probe", testbench::NAME)))?;
                let (_, first) = probe::compare(&design, &self.stimulus, &log);
                return Ok((first.map_or(Trial::Agrees, Trial::Node), run.total));
            }
            Ok(run) => return Ok((Trial::Agrees, run.total)),
            Err(e) => e.to_string(),
        };
        let timing = ["latency is not", "initiation interval is not"].into_iter().find(|mark| after(mark).is_some());
        let silent = after("stop-time").is_some() || after("no answer any more").is_some();
        let trial = match timing {
            Some(timing) => Trial::Timing(format!("{timing} as scheduled")),
            None if silent => Trial::Silent("answers are missing at the end".to_owned()),
            None => Trial::Broken(broken),
        };
        Ok((trial, 0))
    }

    fn failed(&self, message: &str) -> CosimError {
        CosimError::Failed { tool: self.command.name(), message: message.to_owned() }
    }
}
