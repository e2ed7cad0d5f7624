//! `efsat soak`.

use super::accuracy::{points, shard};
use super::error::Failure;
use super::output::{print, print_json, tell};
use super::params::ParamArguments;
use super::{progress, source, stress};
use efsat_checks::soak::{BLOCK, Block, Log, LogError, Soak, Tally};
use efsat_checks::stress::{FAMILIES, Family};
use efsat_studies::accuracy::Shard;
use efsat_unit::params::Params;
use serde::Serialize;
use std::path::PathBuf;

/// Asks one or more designs about very many hard pairs, each pair once, and compares every answer with the exact one
///
/// The pairs are those of `efsat stress`, each as its family makes it. The exact answer is that of the software retest, checked by the
/// oracle on every 1,024th case and on every contradiction. Finished blocks of 16,384 cases per family are appended to the log: a
/// run that was interrupted goes on where it stopped, and logs of several shards can be concatenated. The exit status is 1
/// if a definite answer is wrong.
#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// Pairs of all families together, rounded up to whole blocks
    #[arg(long, value_name = "N", default_value_t = 1_000_000, value_parser = source::count)]
    #[arg(allow_negative_numbers = true)]
    pairs: u64,
    /// Seed of all pairs
    #[arg(long, value_name = "S", default_value_t = 1, value_parser = source::seed, allow_negative_numbers = true)]
    seed: u64,
    /// Only this family; may be given several times
    #[arg(long = "family", value_name = "NAME", value_parser = stress::family())]
    families: Vec<&'static Family>,
    /// Designs to ask, as in `efsat accuracy --sweep`; without it the one design of the other options
    #[arg(long, value_name = "SPEC")]
    sweep: Option<String>,
    /// File that finished blocks are appended to, and taken from
    #[arg(long, value_name = "FILE")]
    log: Option<PathBuf>,
    /// Only part I of N of the blocks
    #[arg(long, value_name = "I/N", value_parser = shard, allow_hyphen_values = true, requires = "log")]
    shard: Option<Shard>,
    /// Print one JSON object instead of a table
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    params: ParamArguments,
}

impl From<LogError> for Failure {
    fn from(e: LogError) -> Self {
        Self::Usage(e.to_string())
    }
}

/// The JSON object.
#[derive(Serialize)]
struct Summary<'a> {
    seed: u64,
    designs: Vec<String>,
    pairs: u64,
    total: &'a Tally,
    families: Vec<Row<'a>>,
    faults: &'a [String],
}

/// A row of it.
#[derive(Serialize)]
struct Row<'a> {
    family: &'static str,
    #[serde(flatten)]
    tally: &'a Tally,
}

fn table(families: &[&Family], designs: &[Params], seed: u64, block: &Block) -> String {
    let row = |name: &str, tally: &Tally| {
        let exact = [tally.pairs(), tally.separate, tally.touch, tally.intersect];
        let answers = tally.designs.iter().flat_map(|answers| [answers.possibly_incorrect, answers.wrong]);
        let cells: String = exact.into_iter().chain(answers).map(|count| format!("{count:>13}")).collect();
        format!("{name:<22}{cells}\n")
    };
    let total = block.total();
    let titles = ["pairs", "separate", "touch", "intersect"].into_iter().map(str::to_owned);
    let titles = titles.chain((1..=designs.len()).flat_map(|i| [format!("p.i. ({i})"), format!("wrong ({i})")]));
    let titles: String = titles.map(|title| format!("{title:>13}")).collect();
    let legend: String =
        designs.iter().enumerate().map(|(i, params)| format!("({}) {}\n", i + 1, params.command_line())).collect();
    let rows: String = families.iter().zip(&block.families).map(|(family, tally)| row(family.name, tally)).collect();
    format!(
        "seed {seed}; {} pairs decided by the oracle too, {} disagreements\n{legend}{:<22}{titles}\n{rows}{}",
        total.checked,
        total.disagreements,
        "family",
        row("all", &total)
    )
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let base = arguments.params.params()?;
    let designs = match &arguments.sweep {
        Some(spec) => points(spec, &base)?,
        None => vec![base],
    };
    let asked = |family: &&Family| arguments.families.is_empty() || arguments.families.contains(family);
    let families: Vec<&Family> = FAMILIES.iter().filter(asked).collect();
    let whole = BLOCK * families.len() as u64;
    let blocks = arguments.pairs.div_ceil(whole);
    if blocks.checked_mul(whole).is_none() {
        return Err(Failure::Usage(format!(
            "--pairs {}: expected fewer than 2^64 pairs in whole blocks",
            arguments.pairs
        )));
    }
    let soak = Soak::new(arguments.seed, families.clone(), &designs);
    let mut log =
        arguments.log.as_ref().map(|path| Log::open(path, soak.question(), |block| soak.fits(block))).transpose()?;
    let shard = arguments.shard.unwrap_or(Shard::WHOLE);
    let bar = progress::bar("testing", blocks.div_ceil(shard.count as u64) * whole, "pairs", false);
    let mut sum = Block::default();
    for number in (0..blocks).filter(|number| shard.has(*number as usize)) {
        if let Some(block) = log.as_ref().and_then(|log| log.blocks().get(&number)) {
            sum.add(block);
        } else {
            let block = soak.block(number);
            sum.add(&block);
            log.as_mut().map_or(Ok(()), |log| log.add(number, block))?;
        }
        bar.inc(whole);
    }
    bar.finish_and_clear();
    let total = sum.total();
    if arguments.json {
        let rows = families.iter().zip(&sum.families).map(|(family, tally)| Row { family: family.name, tally });
        print_json(&Summary {
            seed: arguments.seed,
            designs: designs.iter().map(Params::command_line).collect(),
            pairs: total.pairs(),
            total: &total,
            families: rows.collect(),
            faults: &sum.faults,
        })?;
    } else {
        print(&table(&families, &designs, arguments.seed, &sum))?;
    }
    sum.faults.iter().for_each(|fault| tell("fault", &fault.to_string()));
    if total.faults() == 0 {
        return Ok(());
    }
    let wrong: u64 = total.designs.iter().map(|answers| answers.wrong).sum();
    Err(Failure::Check(format!(
        "{wrong} wrong definite answers, {} disagreements of the exact formulations",
        total.disagreements
    )))
}
