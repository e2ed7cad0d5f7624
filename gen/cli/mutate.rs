//! `efsat mutate`.

use super::error::Failure;
use super::output::{print, print_json};
use super::params::{ParamArguments, choice, whole};
use super::progress;
use super::source::seed;
use efsat_checks::cosim::Simulator;
use efsat_checks::mutation::campaign::{self, Campaign, Options};
use efsat_checks::mutation::explained::{self, Table};
use efsat_checks::mutation::score::{Entry, Score, Standing, Tally};
use efsat_checks::mutation::{Fate, Mutant, capped, spread};
use rayon::prelude::*;
use serde::Serialize;
use std::collections::BTreeMap;
use std::sync::mpsc;
use std::time::Instant;

/// Changes the generated VHDL, one statement at a time, and shows that the checks notice it
///
/// Every mutant of the VHDL is run on 16 chosen pairs, then with internal signals compared on 48 and on --vectors pairs,
/// until an answer, a flag, a tag, the latency or a node differs: killed. Where the design that shows internal signals has
/// another statement, answers are compared on --vectors pairs. Mutants that no compiler takes are listed and do not
/// count. Survivors are explained by a table of the program, most of them as equivalent: one that is not explained makes exit status 1, and so does an equivalent one that is killed.
#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// Print the mutants and run none
    #[arg(long)]
    list: bool,
    /// Only mutants of this entity
    #[arg(long, value_name = "NAME")]
    unit: Option<String>,
    /// At most N mutants of each kind in each unit, evenly spread
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = whole(COUNT), allow_negative_numbers = true)]
    each: u32,
    /// At most N mutants in all, evenly spread
    #[arg(long, value_name = "N", value_parser = whole(COUNT), allow_negative_numbers = true)]
    limit: Option<u32>,
    /// What runs the changed VHDL: ghdl or nvc
    #[arg(long, value_name = "NAME", default_value = "ghdl", value_parser = choice::<Simulator>())]
    simulator: Simulator,
    /// Pairs for mutants that the first runs do not kill
    #[arg(long, value_name = "N", default_value_t = 192, value_parser = whole(COUNT), allow_negative_numbers = true)]
    vectors: u32,
    /// Seed of the pairs
    #[arg(long, value_name = "S", default_value_t = 1, value_parser = seed, allow_negative_numbers = true)]
    seed: u64,
    /// Print one JSON object
    #[arg(long, conflicts_with = "list")]
    json: bool,
    #[command(flatten)]
    params: ParamArguments,
}

const COUNT: std::ops::RangeInclusive<u32> = 1..=100_000;

/// A mutant in the JSON object.
#[derive(Serialize)]
struct Row {
    name: String,
    unit: String,
    line: usize,
    kind: String,
    fate: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    by: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<&'static str>,
}

/// The JSON object.
#[derive(Serialize)]
struct Summary {
    /// All that the forms of the text allow.
    existing: usize,
    #[serde(flatten)]
    all: Tally,
    score: f64,
    kinds: BTreeMap<String, Tally>,
    units: BTreeMap<String, Tally>,
    seconds: f64,
    results: Vec<Row>,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let params = arguments.params.params()?;
    let refused = match arguments.simulator {
        Simulator::Ghdl | Simulator::Nvc => None,
        Simulator::Builtin => Some("builtin: runs the graph, not the text"),
        Simulator::Verilator(_) => Some("verilator: runs a netlist, not the text"),
    };
    if let Some(refused) = refused {
        return Err(Failure::Usage(format!("--simulator {refused}; expected one of ghdl, nvc")));
    }
    let start = Instant::now();
    let all = campaign::mutants(&params)?;
    let existing = all.len();
    let chosen = choose(arguments, all)?;
    if arguments.list {
        return print(&chosen.iter().map(|mutant| format!("{}\n", place(mutant))).collect::<String>());
    }
    let spinner = progress::spinner("testing the unchanged text");
    let vectors = arguments.vectors as usize;
    let options = Options { simulator: arguments.simulator, vectors, seed: arguments.seed };
    let campaign = Campaign::new(&params, &options)?;
    spinner.finish_and_clear();
    let entries = results(arguments, chosen, &explained::vhdl(&params), |mutant| Ok(campaign.fate(mutant)?))?;
    let mut score = Score::default();
    entries.iter().for_each(|entry| score.add(entry));
    let seconds = start.elapsed().as_secs_f64();
    if arguments.json {
        let kinds = score.kinds.iter().map(|(kind, tally)| (kind.to_string(), *tally)).collect();
        print_json(&Summary {
            existing,
            all: score.all,
            score: score.all.score(),
            kinds,
            units: score.units.iter().cloned().collect(),
            seconds,
            results: entries.iter().map(row).collect(),
        })?;
    } else {
        let run = score.all.mutants;
        print(&format!("\n{}\n{run} of {existing} mutants run in {seconds:.0} s\n", score.table()))?;
    }
    let mut faults = vec![];
    if score.all.unexplained > 0 {
        faults.push(format!("{} survivors without an explanation", score.all.unexplained));
    }
    if score.all.stale > 0 {
        faults.push(format!("{} mutants killed that are explained as equivalent", score.all.stale));
    }
    if faults.is_empty() {
        return Ok(());
    }
    Err(Failure::Check(faults.join(", ")))
}

/// The mutants that the options ask for.
fn choose(arguments: &Arguments, mut all: Vec<Mutant>) -> Result<Vec<Mutant>, Failure> {
    if let Some(unit) = &arguments.unit {
        let mut units: Vec<String> = all.iter().map(|mutant| mutant.unit.clone()).collect();
        units.dedup();
        if !units.contains(unit) {
            return Err(Failure::Usage(format!("--unit {unit}: expected one of {}", units.join(", "))));
        }
        all.retain(|mutant| mutant.unit == *unit);
    }
    let chosen = capped(all, arguments.each as usize);
    Ok(spread(chosen, arguments.limit.map_or(usize::MAX, |limit| limit as usize)))
}

/// Runs the mutants on all cores; each is printed as soon as it and those before it are done.
fn results(
    arguments: &Arguments,
    chosen: Vec<Mutant>,
    table: &Table,
    fate: impl Fn(&Mutant) -> Result<Fate, Failure> + Sync,
) -> Result<Vec<Entry>, Failure> {
    let bar = progress::bar("testing", chosen.len() as u64, "mutants", !arguments.json);
    let (sender, receiver) = mpsc::channel();
    let run = |sender: &mut mpsc::Sender<_>, (number, mutant): (usize, Mutant)| {
        let fate = fate(&mutant)?;
        bar.inc(1);
        // Nobody listens once printing has failed.
        let _ = sender.send((number, Entry::new(mutant, fate, table)));
        Ok::<_, Failure>(())
    };
    std::thread::scope(|scope| {
        let printer = scope.spawn(move || {
            let mut early = BTreeMap::new();
            let mut entries: Vec<Entry> = vec![];
            for (number, entry) in receiver {
                early.insert(number, entry);
                while let Some(entry) = early.remove(&entries.len()) {
                    if !arguments.json {
                        print(&line(&entry))?;
                    }
                    entries.push(entry);
                }
            }
            Ok(entries)
        });
        // Handed out one by one, so that the list grows from its top.
        let outcome = chosen.into_iter().enumerate().par_bridge().try_for_each_with(sender, run);
        let entries = printer.join().expect("the printer does not panic");
        outcome.and(entries)
    })
}

fn place(mutant: &Mutant) -> String {
    format!("{:>5} {}", mutant.line, mutant.name())
}

/// One line of the list: place, name, what became of it and why.
fn line(entry: &Entry) -> String {
    let place = place(&entry.mutant);
    let reason = entry.explanation.map(|explanation| explanation.reason).unwrap_or_default();
    match (entry.standing(), &entry.fate) {
        (Standing::Killed, Fate::Killed(by)) => format!("{place}  killed by {by}\n"),
        (Standing::Stale, Fate::Killed(by)) => format!("{place}  KILLED by {by}, but explained: {reason}\n"),
        (Standing::Equivalent, _) => format!("{place}  equivalent: {reason}\n"),
        (Standing::Hidden, _) => format!("{place}  survived: {reason}\n"),
        (Standing::Invalid, Fate::Invalid(why)) => format!("{place}  invalid: {why}\n"),
        _ => format!("{place}  SURVIVED\n"),
    }
}

fn row(entry: &Entry) -> Row {
    let (fate, by) = match &entry.fate {
        Fate::Killed(by) => ("killed", Some(by.clone())),
        Fate::Invalid(why) => ("invalid", Some(why.clone())),
        Fate::Survived => ("survived", None),
    };
    let Mutant { unit, line, kind, .. } = entry.mutant.clone();
    let reason = entry.explanation.map(|explanation| explanation.reason);
    Row { name: entry.mutant.name(), unit, line, kind: kind.to_string(), fate, by, reason }
}
