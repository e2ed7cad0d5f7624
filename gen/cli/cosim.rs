//! `efsat cosim`.

mod engine;

use super::error::Failure;
use super::file;
use super::output::{print, print_json, table};
use super::params::{ParamArguments, choice, whole};
use super::progress;
use super::source::{Source, SourceArguments, count};
use efsat_checks::cosim::{self, Netlist, Options, Report, Simulator};
use efsat_geometry::Points;
use efsat_geometry::collide::hierarchy::Scratch;
use efsat_geometry::scene::Scene;
use efsat_unit::artefact::Stimulus;
use efsat_unit::design::top::pace;
use efsat_unit::host::{Host, ReadyScene, Verdicts, loose_pair};
use efsat_unit::pair::{Pair, Pose, Verdict};
use efsat_unit::params::{Params, options::Choice};
use engine::EngineRun;
use rayon::prelude::*;
use serde::Serialize;
use std::path::PathBuf;

/// Random pairs where nothing else is asked for.
const RANDOM: u64 = 1000;
/// The most random pairs: they are in memory at once.
const MOST_RANDOM: u32 = 1_000_000;
/// Pairs of a scene where no limit is given.
const SCENE_LIMIT: u64 = 2000;

/// Generates the design, simulates it and compares every output bit with the reference model
///
/// Without a source of pairs: --random 1000 --seed 1. Random pairs are made as the unit reads them: 16 each under one
/// random pose, about a quarter of pairs and poses at the corners of the declared ranges, the rest near contact under
/// the pose.
#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// Pairs of a file: .csv, .f64 or - as for classify, or a scene, .toml
    #[arg(value_name = "FILE", conflicts_with_all = ["scene", "random", "seed"])]
    file: Option<String>,
    #[command(flatten)]
    source: SourceArguments,
    /// Take an evenly spread sample of N pairs of a file or scene [default: 2000 of a scene, all of a file]
    #[arg(long, value_name = "N", value_parser = count, allow_negative_numbers = true, conflicts_with = "random")]
    limit: Option<u64>,
    /// Simulator that runs the design [default: ghdl, with --engine verilator]
    #[arg(long, value_name = "NAME", value_parser = choice::<Simulator>())]
    simulator: Option<Simulator>,
    /// What Verilator runs: rtl, as GHDL infers it, or mapped by Yosys to cells of --device's family [default: rtl]
    #[arg(long, value_name = "KIND", value_parser = choice::<Netlist>())]
    netlist: Option<Netlist>,
    /// Leave design, vectors and logs in DIR
    #[arg(long, value_name = "DIR")]
    keep: Option<PathBuf>,
    /// Write a waveform (.ghw or .vcd)
    #[arg(long, value_name = "FILE")]
    wave: Option<PathBuf>,
    /// Compare internal signals too
    #[arg(long)]
    probe: bool,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    params: ParamArguments,
    #[command(flatten)]
    engine: EngineRun,
}

/// The JSON object.
#[derive(Serialize)]
struct Summary<'a> {
    vectors: u64,
    guard_vectors: u64,
    mismatches: u64,
    host_decided: u64,
    verdicts: Verdicts,
    initiation_interval: u64,
    latency: u64,
    cycles: u64,
    total_clocks: u64,
    simulator: &'a str,
    seconds: f64,
    simulation_seconds: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    first_mismatch: Option<&'a str>,
}

/// What the unit is driven with, and what the host has decided before.
#[derive(Default)]
struct Job {
    stimulus: Stimulus,
    decided: Vec<Verdict>,
}

impl Job {
    fn segment(&mut self, pose: Pose, hosts: impl Iterator<Item = Host>) {
        let mut pairs: Vec<Pair> = vec![];
        for host in hosts {
            match host {
                Host::Unit(pair) => pairs.push(pair),
                Host::Decided(verdict) => self.decided.push(verdict),
            }
        }
        if !pairs.is_empty() {
            self.stimulus.segments.push((pose, pairs));
        }
    }

    fn pairs(params: &Params, pairs: &[Points], limit: Option<u64>) -> Self {
        let total = pairs.len() as u64;
        let mut job = Self::default();
        let chosen = spread(total, limit.unwrap_or(total));
        job.segment(
            Pose::identity(params),
            chosen.map(|i| loose_pair(&pairs[i as usize], params).expect("pairs are finite")),
        );
        job
    }

    /// Counts the candidate pairs of all frames, chooses, and makes only those that are chosen.
    fn scene(params: &Params, scene: &Scene, limit: u64) -> Self {
        let stage = ReadyScene::new(scene, params);
        let frames = stage.frames();
        let bar = progress::bar("counting pairs", frames as u64, "poses", false);
        let counts: Vec<u64> = (0..frames)
            .into_par_iter()
            .map_init(Scratch::default, |scratch, frame| {
                bar.inc(1);
                let mut count = 0;
                for meeting in stage.near.meetings(frame) {
                    stage.near.pieces(&meeting, scratch, |pairs| count += pairs.len() as u64);
                }
                count
            })
            .collect();
        let mut chosen = spread(counts.iter().sum(), limit).peekable();
        let mut job = Self::default();
        let mut start = 0;
        for (frame, count) in counts.into_iter().enumerate() {
            if chosen.peek().is_none_or(|i| *i >= start + count) {
                start += count;
                continue;
            }
            for meeting in stage.near.meetings(frame) {
                let mut here: Vec<(u32, u32)> = vec![];
                stage.near.pieces(&meeting, &mut Scratch::default(), |pairs| {
                    let end = start + pairs.len() as u64;
                    let numbers = std::iter::from_fn(|| chosen.next_if(|i| *i < end));
                    here.extend(numbers.map(|i| pairs[(i - start) as usize]));
                    start = end;
                });
                if !here.is_empty() {
                    let posed = stage.posed(&meeting);
                    let host = posed.host();
                    let faces = here.into_iter().map(|pair| posed.faces(pair));
                    job.segment(host.pose, faces.map(|[a, b]| host.pair(a, b)));
                }
            }
        }
        job
    }
}

/// `limit` numbers below `total`, evenly spread and ascending; all of them if there are no more.
pub(super) fn spread(total: u64, limit: u64) -> impl Iterator<Item = u64> {
    let count = limit.min(total);
    (0..count).map(move |i| (u128::from(i) * u128::from(total) / u128::from(count)) as u64)
}

fn job(arguments: &Arguments, params: &Params) -> Result<Job, Failure> {
    let source = match (&arguments.file, &arguments.source.scene) {
        (Some(name), _) => Source::file(name)?,
        (None, Some(name)) => Source::scene(name)?,
        (None, None) => {
            let count = arguments.source.random.unwrap_or(RANDOM).to_string();
            let count = whole(1..=MOST_RANDOM)(&count).map_err(|e| Failure::Usage(format!("--random {count}: {e}")))?;
            let stimulus = Stimulus::random(params, count as usize, arguments.source.seed);
            return Ok(Job { stimulus, decided: vec![] });
        }
    };
    Ok(match source {
        Source::Pairs(pairs) => Job::pairs(params, &pairs.all()?, arguments.limit),
        Source::Scene(scene) => Job::scene(params, &scene, arguments.limit.unwrap_or(SCENE_LIMIT)),
    })
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    if arguments.engine.engine {
        return engine::run(arguments);
    }
    arguments.engine.refuse()?;
    let params = arguments.params.params()?;
    let simulator = match (arguments.simulator.unwrap_or(Simulator::Ghdl), arguments.netlist) {
        (Simulator::Verilator(_), Some(netlist)) => Simulator::Verilator(netlist),
        (simulator, None) => simulator,
        (simulator, Some(_)) => {
            let message = format!("--netlist needs --simulator verilator, not {}", Choice::name(simulator));
            return Err(Failure::Usage(message));
        }
    };
    arguments.keep.iter().try_for_each(|dir| file::named(dir, "directory"))?;
    let Job { stimulus, decided } = job(arguments, &params)?;
    let options =
        Options { simulator, keep: arguments.keep.clone(), wave: arguments.wave.clone(), probe: arguments.probe };
    let spinner = progress::spinner("simulating");
    let report = cosim::run(&params, &params.command_line(), &stimulus, &options)?;
    spinner.finish_and_clear();

    let [separate, intersect, possibly_incorrect] = report.verdicts;
    let mut verdicts = Verdicts { separate, intersect, possibly_incorrect };
    decided.iter().for_each(|verdict| verdicts.count(*verdict));
    let host_decided = decided.len() as u64;
    if arguments.json {
        print_json(&Summary {
            vectors: report.vectors,
            guard_vectors: report.guard_vectors,
            mismatches: report.mismatches,
            host_decided,
            verdicts,
            initiation_interval: report.initiation_interval,
            latency: report.latency,
            cycles: report.cycles,
            total_clocks: report.total_clocks,
            simulator: &report.simulator,
            seconds: report.seconds,
            simulation_seconds: report.simulation_seconds,
            first_mismatch: report.first_mismatch.as_deref(),
        })?;
    } else {
        print(&text(&report, &verdicts, host_decided))?;
    }
    match report.mismatches {
        0 => Ok(()),
        n => {
            let first = report.first_mismatch.unwrap_or_else(|| "unknown".to_owned());
            Err(Failure::Check(format!("vectors that differ: {n} of {}, the first: {first}", report.vectors)))
        }
    }
}

fn text(report: &Report, verdicts: &Verdicts, host_decided: u64) -> String {
    let mut text = table(verdicts);
    if host_decided > 0 {
        text.push_str(&format!("{host_decided} of them decided on the host\n"));
    }
    text.push_str(&format!(
        "{}, verdict after {} clocks; {} clocks at full speed, {:.1} s in {}\n",
        pace(report.initiation_interval as usize),
        report.latency,
        report.cycles,
        report.seconds,
        report.simulator
    ));
    if report.mismatches == 0 {
        let more = match report.guard_vectors {
            0 => String::new(),
            n => format!(", and {n} for the guard,"),
        };
        let all = match report.vectors {
            1 => "The one vector".to_owned(),
            n => format!("All {n} vectors"),
        };
        text.push_str(&format!("{all}{more} agree bit for bit.\n"));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sample_is_evenly_spread() {
        let all = |total, limit| spread(total, limit).collect::<Vec<_>>();
        assert_eq!(all(10, 5), [0, 2, 4, 6, 8]);
        assert_eq!(all(3, 5), [0, 1, 2]);
        assert_eq!(all(7, 3), [0, 2, 4]);
        assert!(all(0, 3).is_empty());
    }
}
