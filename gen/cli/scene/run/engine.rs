//! `efsat scene run --engine`.

use super::report::Report;
use super::{Arguments, Outputs, Sinks, draw};
use crate::cosim::spread;
use crate::error::Failure;
use crate::params::EngineArguments;
use crate::progress;
use crate::source::count;
use efsat_checks::cosim::engine::Machine;
use efsat_engine::driver::{Objects, StandIn};
use efsat_engine::words::Sums;
use efsat_geometry::collide::hierarchy::Directions;
use efsat_geometry::scene::Scene;
use efsat_studies::planner::engine::{self, EngineCounts, Simulation};
use efsat_studies::planner::{Contact, Front, Row, Software, Viewer};
use efsat_unit::design::top::DesignError;
use efsat_unit::host::settings::{Effect, Settings, Switch};
use efsat_unit::params::options::{Choice, choice};
use serde::Serialize;

/// Frames that are simulated where nothing else is asked for.
const FRAMES: u64 = 40;

#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Options of --engine")]
pub(super) struct EngineOptions {
    /// Answer by the collision engine instead of a planned unit: by its reference model, or by the whole machine in Verilator,
    /// clock by clock, compared with the model. The rows then count queries, those answered in software, expansions, tests,
    /// survivors, leaf pairs, pairs that intersect, are possibly incorrect and touch, and clocks, which are 0 of the model
    #[arg(long, value_name = "MACHINE", value_parser = choice::<Answering>())]
    #[arg(conflicts_with_all = ["out", "cosim", "simulator", "sample", "close", "seed", "effect", "allowed", "k"])]
    pub engine: Option<Answering>,
    /// Answer an evenly spread sample of N poses, and that of --frame [default: all by the model, 40 by Verilator]
    #[arg(long, value_name = "N", requires = "engine", value_parser = count, allow_negative_numbers = true)]
    frames: Option<u64>,
    #[command(flatten)]
    params: EngineArguments,
}

/// What answers queries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Answering {
    Model,
    Verilator,
}

impl Choice for Answering {
    const ALL: &'static [Self] = &[Self::Model, Self::Verilator];

    fn name(self) -> &'static str {
        match self {
            Self::Model => "model",
            Self::Verilator => "verilator",
        }
    }
}

impl EngineOptions {
    /// Refuses options of the engine without one.
    pub fn refuse(&self) -> Result<(), Failure> {
        self.params.refuse()
    }
}

/// What the JSON object says first.
#[derive(Serialize)]
struct Head<'a> {
    scene: &'a str,
    machine: &'static str,
    command_line: &'a str,
}

/// What it says behind the frames.
#[derive(Serialize)]
struct End<'a> {
    total: EngineCounts,
    simulator: &'a str,
    mismatches: u64,
}

/// What is kept while frames come.
struct Taken {
    total: EngineCounts,
    /// The frame that is drawn, and what was found in it.
    drawn: usize,
    most: Option<u64>,
    contacts: Vec<Contact>,
}

impl Taken {
    /// Remembers a frame if it is the one that is drawn: the one asked for, or the fullest so far.
    fn take(&mut self, row: &Row<EngineCounts>, found: &[Contact], asked: Option<u64>) {
        self.total.add(&row.counts);
        let draws = match asked {
            Some(frame) => frame == row.frame as u64,
            None => self.most.is_none_or(|most| row.counts.touching > most),
        };
        if draws {
            self.most = Some(row.counts.touching);
            (self.drawn, self.contacts) = (row.frame, found.to_vec());
        }
    }
}

/// The frames that are answered.
fn frames(arguments: &Arguments, machine: Answering, scene: &Scene) -> Vec<usize> {
    let total = scene.frames() as u64;
    let usual = if machine == Answering::Verilator { FRAMES } else { total };
    let mut frames: Vec<usize> =
        spread(total, arguments.engine.frames.unwrap_or(usual)).map(|frame| frame as usize).collect();
    frames.extend(arguments.frame.map(|frame| frame as usize));
    frames.sort_unstable();
    frames.dedup();
    frames
}

pub(super) fn run(
    arguments: &Arguments,
    machine: Answering,
    scene: &Scene,
    settings: &Settings,
) -> Result<(), Failure> {
    if machine == Answering::Model {
        arguments.engine.params.refuse_timing()?;
    }
    let design = arguments.given.engine(&arguments.file, settings, &arguments.engine.params)?;
    let (meshes, _) = scene.meshes();
    let objects = Objects::new(&design.params, &design.unit.params, &meshes)?;
    let model = StandIn::new(&objects).map_err(DesignError::from)?;
    arguments.check_outputs()?;
    let mut outputs = Outputs::default();
    outputs.begin(arguments, false)?;
    let Outputs { csv, pairs, picture, view } = outputs;
    // The engine has trees of its own.
    let broad_phase = settings.switches.get(Effect::BroadPhase) != Switch::Off;
    let software = Software { broad_phase, hierarchy: false, degenerate: false };
    let front = Front::new(scene, software, Directions::Eighteen);
    let command_line = design.command_line();
    let head = Head { scene: &scene.name, machine: machine.name(), command_line: &command_line };
    let (params, frames) = (design.unit.params.clone(), frames(arguments, machine, scene));
    let report = Report::new::<EngineCounts>(arguments.json, arguments.summary, "engine", &head)?;
    let viewer = view.is_some().then(|| Viewer::new(&front, &params));
    let mut sinks = Sinks::new::<EngineCounts>(scene, &params, report, viewer, csv, pairs)?;
    let mut taken = Taken { total: EngineCounts::default(), drawn: frames[0], most: None, contacts: vec![] };
    let bar = progress::bar("answering", frames.len() as u64, "poses", !arguments.summary);
    let visit = |row: Row<EngineCounts>, found: &[Contact]| {
        bar.inc(1);
        taken.take(&row, found, arguments.frame);
        sinks.take(&row, found)
    };
    let simulation = match machine {
        Answering::Model => {
            let mut model = model;
            engine::run(&front, &objects, &frames, &mut model, visit)?;
            None
        }
        Answering::Verilator => {
            let spinner = progress::spinner("compiling the engine");
            let mut simulation = Simulation::new(Machine::build(design, None)?, &objects, model);
            spinner.finish_and_clear();
            engine::run(&front, &objects, &frames, &mut simulation, visit)?;
            Some(simulation)
        }
    };
    bar.finish_and_clear();
    if let Some(picture) = picture {
        draw(arguments, scene, taken.drawn, &taken.contacts, picture)?;
    }
    let report = sinks.finish(view, &command_line)?;
    let (total, simulated) = (taken.total, simulation.as_ref());
    let mismatches = simulated.map_or(0, |simulation| simulation.mismatches);
    let end = End { total, simulator: simulated.map_or("reference model", Simulation::simulator), mismatches };
    report.finish(&end, || words(&command_line, &total, frames.len(), simulated))?;
    match simulated.and_then(|simulation| simulation.first_mismatch.map(|first| (first, simulation.queries))) {
        None => Ok(()),
        Some((first, queries)) => {
            let message =
                format!("{mismatches} of {queries} queries differ from the reference model, the first: {first}");
            Err(Failure::Check(message))
        }
    }
}

/// What came out, in words.
fn words(command_line: &str, total: &EngineCounts, frames: usize, simulation: Option<&Simulation<'_, '_>>) -> String {
    let EngineCounts { sums, in_software, touching, .. } = total;
    let Sums { queries, leaf_pairs, intersect, possibly_incorrect, .. } = sums;
    let mut text = format!(
        "{command_line}\n\n{queries} queries in {frames} poses, {in_software} of them answered in software\n\
         {leaf_pairs} leaf pairs: {intersect} intersect, {possibly_incorrect} possibly incorrect\n\
         {touching} pairs touch, by the final answers\n"
    );
    if let Some(simulation) = simulation {
        let (name, queries) = (simulation.simulator(), simulation.queries);
        let clocks = total.clocks as f64 / queries.max(1) as f64;
        text.push_str(&format!(
            "{queries} queries simulated ({name}), {clocks:.0} clocks each in the mean: {} mismatches\n",
            simulation.mismatches
        ));
    }
    text
}
