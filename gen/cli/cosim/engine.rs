//! `efsat cosim --engine`.

use super::{Arguments, spread};
use crate::error::Failure;
use crate::output::{print, print_json};
use crate::params::{EngineArguments, without_engine};
use crate::progress;
use crate::source::{HEADLIGHT, load_scene};
use efsat_checks::cosim::Simulator;
use efsat_checks::cosim::engine::{Channel, Machine, Measure, Reply, check, data_path};
use efsat_engine::artefact::EngineDesign;
use efsat_engine::host::{Image, Images, Numbers, memory};
use efsat_engine::model::Query;
use efsat_engine::params::Memory;
use efsat_engine::words::QueryFlags;
use efsat_geometry::scene::Scene;
use efsat_unit::design::top::{DesignError, pace};
use efsat_unit::params::options::Choice;
use rayon::prelude::*;
use serde::Serialize;
use std::fmt::{self, Write};
use std::ops::RangeInclusive;

/// The longest latency of memory.
const LATENCY: RangeInclusive<u32> = 1..=1000;

#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Options of --engine")]
pub(super) struct EngineRun {
    /// Simulate the collision engine, clock by clock: a query for each two objects of the scene whose boxes overlap in a frame.
    /// --simulator verilator and ghdl run all of it, builtin its two units alone with what the queries give them; --limit takes a
    /// sample of the queries [default: all, with ghdl 8]
    #[arg(long, conflicts_with_all = ["random", "seed", "netlist", "wave", "probe"])]
    pub engine: bool,
    /// With --engine: the engine that takes pairs by number, with the leaf pairs that the traversal would have found, a packet for
    /// each query
    #[arg(long, requires = "engine", conflicts_with = "first_contact")]
    pairs_by_number: bool,
    /// Clocks from an address to its first word of memory, N or LEAST-MOST [default: 32]
    #[arg(long, value_name = "CLOCKS", value_parser = latency, allow_negative_numbers = true)]
    latency: Option<Latency>,
    /// Random gaps on all sides: stream, answers, addresses, words of memory; SEED chooses them
    #[arg(long, value_name = "SEED", value_parser = clap::value_parser!(u32))]
    gaps: Option<u32>,
    /// Stop each query at the first certain contact
    #[arg(long)]
    first_contact: bool,
    /// Empty the caches before each query, as a host does that writes to memory between queries; else they are kept
    #[arg(long)]
    empty_caches: bool,
    #[command(flatten)]
    params: EngineArguments,
}

impl EngineRun {
    /// Refuses options of the engine where there is none.
    pub fn refuse(&self) -> Result<(), Failure> {
        let own = [
            ("gaps", self.gaps.map(|seed| seed.to_string())),
            ("first-contact", self.first_contact.then(String::new)),
            ("empty-caches", self.empty_caches.then(String::new)),
            ("latency", self.latency.as_ref().map(ToString::to_string)),
        ];
        match own.into_iter().find_map(|(option, value)| Some((option, value?))) {
            Some((option, value)) => Err(without_engine(option, &value)),
            None => self.params.refuse(),
        }
    }
}

/// Least and most clocks.
#[derive(Clone, Debug)]
struct Latency(RangeInclusive<u32>);

impl fmt::Display for Latency {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.0.start(), self.0.end()) {
            (least, most) if least == most => write!(f, "{least}"),
            (least, most) => write!(f, "{least}-{most}"),
        }
    }
}

fn latency(text: &str) -> Result<Latency, String> {
    let (least, most) = text.split_once('-').unwrap_or((text, text));
    let number = |text: &str| text.parse().ok().filter(|clocks| LATENCY.contains(clocks));
    let range = number(least).zip(number(most)).filter(|(least, most)| least <= most);
    let (least, most) =
        range.ok_or_else(|| format!("expected clocks from {} to {}, as 32 or 5-60", LATENCY.start(), LATENCY.end()))?;
    Ok(Latency(least..=most))
}

/// Queries where no limit is given, in GHDL.
const GHDL_LIMIT: u64 = 8;

/// The queries of a distance.
#[derive(Serialize)]
struct Distance {
    distance: f64,
    #[serde(flatten)]
    measure: Measure,
}

/// The JSON object.
#[derive(Serialize)]
struct Summary<'a> {
    mismatches: usize,
    answered_in_software: usize,
    clocks_per_query: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    clocks_per_expansion: Option<usize>,
    clocks_per_pair: usize,
    #[serde(flatten)]
    measure: Measure,
    distances: Vec<Distance>,
    simulator: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    first_mismatch: Option<&'a str>,
}

/// What is asked, and at which distance, where a tumbling turn made the frame.
struct Asked {
    queries: Vec<Query>,
    distances: Vec<Option<f64>>,
    /// How many queries the engine cannot answer.
    refused: usize,
}

/// The queries of a scene.
fn queries(images: &Images, scene: &Scene, arguments: &Arguments) -> Asked {
    let near = scene.near();
    let (_, sides) = memory(&images.all());
    let frames = scene.frames();
    let bar = progress::bar("making queries", frames as u64, "poses", false);
    let made = (0..frames).into_par_iter().flat_map_iter(|frame| {
        bar.inc(1);
        let distance = scene.frame(frame).distance;
        let found = near.meetings(frame).into_iter();
        found.map(|meeting| (distance, images.query(meeting.meshes, &meeting.pose, &sides).ok())).collect::<Vec<_>>()
    });
    let made: Vec<(Option<f64>, Option<Query>)> = made.collect();
    bar.finish_and_clear();
    let total = made.len() as u64;
    let usual = if arguments.simulator == Some(Simulator::Ghdl) { GHDL_LIMIT } else { total };
    let mut asked = Asked { queries: vec![], distances: vec![], refused: 0 };
    for index in spread(total, arguments.limit.unwrap_or(usual)) {
        let (distance, query) = &made[index as usize];
        let Some(query) = query else {
            asked.refused += 1;
            continue;
        };
        let number = asked.queries.len() as u32 % QueryFlags::NUMBERS;
        let EngineRun { first_contact, empty_caches, .. } = arguments.engine;
        asked.queries.push(Query { number, first_contact, keep_caches: !empty_caches, ..query.clone() });
        asked.distances.push(*distance);
    }
    asked
}

/// What the queries of each distance cost, in the order in which they come.
fn by_distance(design: &EngineDesign, distances: &[Option<f64>], replies: &[Reply]) -> Vec<Distance> {
    let mut groups: Vec<(f64, Vec<&Reply>)> = vec![];
    for (distance, reply) in distances.iter().zip(replies) {
        let Some(distance) = *distance else { continue };
        match groups.iter_mut().find(|(known, _)| *known == distance) {
            Some((_, group)) => group.push(reply),
            None => groups.push((distance, vec![reply])),
        }
    }
    let measured =
        |(distance, replies): (f64, Vec<&Reply>)| Distance { distance, measure: Measure::of(design, &replies) };
    groups.into_iter().map(measured).collect()
}

/// Options that the simulation of an engine does not have.
fn refuse(arguments: &Arguments) -> Result<(), Failure> {
    let options = &arguments.engine;
    let behind_axi = [("latency", options.latency.is_some()), ("empty-caches", options.empty_caches)];
    if let Some((option, _)) = behind_axi.into_iter().find(|(_, given)| *given)
        && options.params.params().memory == Memory::BlockRam
    {
        return Err(Failure::Usage(format!("--{option} with --memory block-ram: expected --memory axi")));
    }
    match arguments.simulator {
        None | Some(Simulator::Verilator(_) | Simulator::Ghdl) => Ok(()),
        Some(Simulator::Builtin) => {
            let own = [
                ("latency", options.latency.is_some()),
                ("gaps", options.gaps.is_some()),
                ("empty-caches", options.empty_caches),
                ("keep", arguments.keep.is_some()),
            ];
            match own.into_iter().find(|(_, given)| *given) {
                Some((option, _)) => {
                    let why = "expected verilator or ghdl; builtin simulates the two units alone";
                    Err(Failure::Usage(format!("--{option} with --engine --simulator builtin: {why}")))
                }
                None => Ok(()),
            }
        }
        Some(other) => {
            let why = "expected verilator, ghdl or builtin with --engine";
            Err(Failure::Usage(format!("--simulator {}: {why}", other.name())))
        }
    }
}

/// The two units in the built-in simulator.
fn data_path(design: &EngineDesign, images: &[&Image], asked: &Asked, json: bool) -> Result<(), Failure> {
    let bar = progress::bar("simulating the units", asked.queries.len() as u64, "queries", false);
    let found = data_path::run(design, images, &asked.queries, || bar.inc(1));
    bar.finish_and_clear();
    if json {
        print_json(&found)?;
    } else {
        print(&format!(
            "{} queries, {} more for software: {} expansions in the volume unit, {} pairs in the triangle unit\n",
            found.queries, asked.refused, found.expansions, found.leaf_pairs
        ))?;
    }
    match found.first_mismatch {
        None if json => Ok(()),
        None => print("All answers of both units agree with the reference model.\n"),
        Some(first) => Err(Failure::Check(format!("answers that differ: {}, the first: {first}", found.mismatches))),
    }
}

/// The command.
pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    refuse(arguments)?;
    let options = &arguments.engine;
    let design = match options.pairs_by_number {
        false => options.params.design(&arguments.params)?,
        true => options.params.design_by_number(&arguments.params)?,
    };
    let name = arguments.file.as_ref().or(arguments.source.scene.as_ref()).map_or(HEADLIGHT, String::as_str);
    let scene = load_scene(name)?;
    let numbers = Numbers::new(&design.params, &design.unit.params).map_err(DesignError::from)?;
    let held = Images::new(&scene.meshes().0, numbers).map_err(|e| Failure::Usage(format!("{name}: {e}")))?;
    let images = held.all();
    // Before the time that the queries take.
    design.layout(&images).map_err(DesignError::from)?;
    let asked = queries(&held, &scene, arguments);
    let queries = &asked.queries;
    if queries.is_empty() {
        return Err(Failure::Usage(format!("{name}: expected two objects whose boxes overlap in a frame")));
    }
    if arguments.simulator == Some(Simulator::Builtin) {
        return data_path(&design, &images, &asked, arguments.json);
    }
    let spinner = progress::spinner("compiling the engine");
    let machine = match arguments.simulator {
        Some(Simulator::Ghdl) => Machine::in_ghdl(design, arguments.keep.as_deref())?,
        _ => Machine::build(design, arguments.keep.as_deref())?,
    };
    spinner.finish_and_clear();
    let usual = Channel::default();
    let channel = Channel {
        latency: options.latency.clone().map_or(usual.latency, |Latency(clocks)| clocks),
        gaps: options.gaps.is_some(),
        seed: options.gaps.unwrap_or(usual.seed),
        ..usual
    };
    let spinner = progress::spinner("simulating queries");
    let replies = machine.run(&images, queries, &channel)?;
    spinner.finish_and_clear();
    let bar = progress::bar("comparing with the reference model", queries.len() as u64, "queries", false);
    let wrong = check(machine.design(), &images, queries, &replies, || bar.inc(1));
    bar.finish_and_clear();
    let measure = Measure::of(machine.design(), &replies);
    if arguments.json {
        print_json(&Summary {
            mismatches: wrong.len(),
            answered_in_software: asked.refused,
            clocks_per_query: measure.clocks_per_query(),
            clocks_per_expansion: (!machine.design().by_number).then_some(machine.design().volume.interval),
            clocks_per_pair: machine.design().unit.interval,
            measure,
            distances: by_distance(machine.design(), &asked.distances, &replies),
            simulator: &machine.simulator,
            first_mismatch: wrong.first().map(String::as_str),
        })?;
    } else {
        print(&table(&measure, machine.design(), &machine.simulator, asked.refused))?;
    }
    match wrong.first() {
        None if arguments.json => Ok(()),
        None => print(&format!("All {} queries agree with the reference model.\n", queries.len())),
        Some(first) => {
            Err(Failure::Check(format!("{} of {} queries differ, the first: {first}", wrong.len(), queries.len())))
        }
    }
}

/// What pairs by number came to.
fn table_by_number(measure: &Measure, design: &EngineDesign, simulator: &str, refused: usize) -> String {
    let mut text = format!("{:<38}{:>14}{:>14}\n", "", "per pair", "all");
    let pairs = measure.sums.leaf_pairs;
    for (name, count) in [
        ("pairs", pairs),
        ("clocks", measure.clocks),
        ("intersect", measure.sums.intersect),
        ("possibly incorrect", measure.sums.possibly_incorrect),
        ("triangles asked for", measure.triangles),
        ("triangles read", measure.triangles_read),
        ("words read", measure.words),
    ] {
        let mean = count as f64 / pairs.max(1) as f64;
        let _ = writeln!(text, "{name:<38}{mean:>14.3}{count:>14}");
    }
    let _ = writeln!(
        text,
        "{} packets, {refused} more for software; the unit: {}; {simulator}\nclocks are those from the first word in to the last \
         word out",
        measure.sums.queries,
        pace(design.unit.interval)
    );
    text
}

fn table(measure: &Measure, design: &EngineDesign, simulator: &str, refused: usize) -> String {
    if design.by_number {
        return table_by_number(measure, design, simulator, refused);
    }
    let mut text = format!("{:<38}{:>14}{:>14}\n", "", "per query", "all");
    let mut row = |name: &str, count: u64| {
        let mean = count as f64 / measure.sums.queries as f64;
        let _ = writeln!(text, "{name:<38}{mean:>14.1}{count:>14}");
    };
    row("clocks", measure.clocks);
    row("clocks in which a query ran", measure.running);
    row("expansions", measure.sums.expansions);
    row("tests of volumes", measure.sums.tests);
    row("leaf pairs", measure.sums.leaf_pairs);
    row("intersect", measure.sums.intersect);
    row("possibly incorrect", measure.sums.possibly_incorrect);
    row("blocks asked for", measure.blocks);
    row("blocks read", measure.blocks_read);
    row("triangles asked for", measure.triangles);
    row("triangles read", measure.triangles_read);
    row("words read", measure.words);
    row("clocks: volume unit waits for memory", measure.memory_waits);
    row("clocks: survivors wait for the queue", measure.queue_waits);
    let share = |busy: u64| 100.0 * busy as f64 / measure.clocks as f64;
    let mut busy = |name: &str, busy: u64| {
        let _ = writeln!(text, "{name:<38}{:>13.1}%", share(busy));
    };
    busy("volume unit busy", measure.volume_busy);
    busy("triangle unit busy", measure.triangle_busy);
    busy("memory bus busy", measure.words / design.read_ports().len() as u64);
    let _ = writeln!(
        text,
        "{} queries, {refused} more for software; greatest stack {}; {}an expansion in {} clocks, a pair in {}; {}",
        measure.sums.queries,
        measure.sums.greatest_stack,
        if design.params.engines > 1 { format!("{} engines, each ", design.params.engines) } else { String::new() },
        design.volume.interval,
        design.unit.interval,
        simulator
    );
    text.push_str(
        "clocks are those from the first word in to the last word out; a query runs from its start to its report\n",
    );
    if measure.sums.leaf_pairs == 0 {
        text.push_str("no query of this sample reaches a pair of triangles; a greater --limit takes more queries\n");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use efsat_engine::params::EngineParams;
    use efsat_engine::words::EngineReport;
    use efsat_unit::params::Params;

    /// What the clocks are is always said; that no pair of triangles was reached, if it was so.
    #[test]
    fn a_sample_without_a_pair_says_so() {
        let design = EngineDesign::new(&EngineParams::default(), &Params::default()).unwrap();
        let text = |leaf_pairs| {
            let report = EngineReport { leaf_pairs, ..EngineReport::default() };
            let measure = Measure::of(&design, &[Reply { answers: vec![], report, clocks: 100 }]);
            table(&measure, &design, "a simulator", 2)
        };
        let [without, with] = [text(0), text(1)];
        for text in [&without, &with] {
            assert!(text.contains("1 queries, 2 more for software; greatest stack 0; "), "{text}");
            assert!(
                text.contains("a simulator\nclocks are those from the first word in to the last word out; "),
                "{text}"
            );
        }
        let said = "no query of this sample reaches a pair of triangles; a greater --limit takes more queries\n";
        assert!(without.ends_with(said) && !with.contains(said), "{without}{with}");
    }

    #[test]
    fn a_latency_is_a_number_or_a_range() {
        assert_eq!(latency("32").unwrap().0, 32..=32);
        assert_eq!(latency("5-60").unwrap().0, 5..=60);
        for text in ["", "0", "60-5", "5-", "1001", "x"] {
            assert!(latency(text).unwrap_err().starts_with("expected clocks"), "{text}");
        }
    }
}
