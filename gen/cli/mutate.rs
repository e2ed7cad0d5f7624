//! `efsat mutate`.

use super::error::Failure;
use super::output::{print, print_json};
use super::params::{choice, whole, ParamArguments};
use super::progress;
use crate::cosim::Simulator;
use crate::mutation::campaign::{Campaign, Options};
use crate::mutation::explained::{self, Explanation};
use crate::mutation::{capped, spread, Fate, Kind, Mutant};
use rayon::prelude::*;
use serde::Serialize;
use std::time::Instant;

/// Changes the generated VHDL or the reference model, one line at a time, and shows that the checks notice it
///
/// Every mutant of the VHDL is run on 16 chosen pairs, then on 48 with inner nodes compared, then on --vectors pairs,
/// until an answer, a flag, a tag, the latency or a node differs: killed. Mutants that no compiler takes are listed and
/// do not count. A survivor must be explained in the program's table of equivalent mutants; one that is not, or an
/// explained mutant that is killed, makes exit status 1.
#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// Print the mutants and run none
    #[arg(long)]
    list: bool,
    /// Only mutants of this entity or source file
    #[arg(long, value_name = "NAME")]
    unit: Option<String>,
    /// At most N mutants of each kind in each unit, evenly spread
    #[arg(long, value_name = "N", default_value_t = 6, value_parser = whole(1..=100_000), allow_negative_numbers = true)]
    each: u32,
    /// Of these N in all, evenly spread
    #[arg(long, value_name = "N", value_parser = whole(1..=100_000), allow_negative_numbers = true)]
    limit: Option<u32>,
    /// What runs the changed VHDL: ghdl or nvc
    #[arg(long, value_name = "NAME", default_value = "ghdl", value_parser = choice::<Simulator>())]
    simulator: Simulator,
    /// Pairs for mutants that the first runs do not kill
    #[arg(long, value_name = "N", default_value_t = 256, value_parser = whole(1..=100_000), allow_negative_numbers = true)]
    vectors: u32,
    /// Seed of the pairs
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    params: ParamArguments,
}

/// A mutant with its fate.
struct Entry {
    mutant: Mutant,
    fate: Fate,
    explanation: Option<&'static Explanation>,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let params = arguments.params.params()?;
    let options =
        Options { simulator: arguments.simulator, vectors: arguments.vectors as usize, seed: arguments.seed };
    let start = Instant::now();
    let campaign = Campaign::new(&params, &options)?;
    let all = campaign.mutants();
    let mut chosen = capped(all, arguments.each as usize);
    if let Some(unit) = &arguments.unit {
        chosen.retain(|m| m.unit == *unit);
    }
    let chosen = spread(chosen, arguments.limit.map_or(usize::MAX, |l| l as usize));
    if arguments.list {
        let lines: String = chosen.iter().map(|m| format!("{}:{}:{}\n", m.unit, m.line, m.name())).collect();
        return print(&lines);
    }
    let bar = progress::bar(chosen.len() as u64, "mutants", false);
    let entries: Result<Vec<Entry>, _> = chosen
        .into_par_iter()
        .map(|mutant| {
            let fate = campaign.fate(&mutant)?;
            bar.inc(1);
            let explanation = explained::find(explained::VHDL, &mutant.name());
            Ok::<_, crate::cosim::CosimError>(Entry { mutant, fate, explanation })
        })
        .collect();
    for e in entries? {
        let what = match e.fate { Fate::Killed(k) => format!("killed {k}"), Fate::Survived => "SURVIVED".to_owned(), Fate::Invalid(s) => format!("INVALID {s}") };
        print(&format!("{}:{} {}  {}\n", e.mutant.unit, e.mutant.line, e.mutant.name(), what))?;
    }
    eprintln!("{:?}", start.elapsed());
    Ok(())
}
