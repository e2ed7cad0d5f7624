//! `efsat stress --once`.

use super::Arguments;
use crate::accuracy::points_beside;
use crate::error::Failure;
use crate::output::{print, print_json, tell};
use crate::progress;
use efsat_checks::stress::Family;
use efsat_checks::stress::once::{BLOCK, Block, Log, Once, Tally};
use efsat_studies::accuracy::Shard;
use efsat_unit::params::Params;
use serde::Serialize;

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
        let exact = [tally.truths.total(), tally.truths.separate, tally.truths.touch, tally.truths.intersect];
        let answers = tally.designs.iter().flat_map(|answers| [answers.verdicts.possibly_incorrect, answers.wrong]);
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

pub(super) fn run(arguments: &Arguments, families: &[&'static Family], base: Params) -> Result<(), Failure> {
    let designs = match &arguments.sweep {
        Some(spec) => points_beside(spec, &arguments.params, &base)?,
        None => vec![base],
    };
    let pairs = arguments.pairs.unwrap_or(1_000_000);
    let whole = BLOCK * families.len() as u64;
    let blocks = pairs.div_ceil(whole);
    if blocks.checked_mul(whole).is_none() {
        return Err(Failure::Usage(format!("--pairs {pairs}: expected fewer than 2^64 pairs in whole blocks")));
    }
    let once = Once::new(arguments.seed, families.to_vec(), &designs);
    let mut log =
        arguments.log.as_ref().map(|path| Log::open(path, once.question(), |block| once.fits(block))).transpose()?;
    let shard = arguments.shard.unwrap_or(Shard::WHOLE);
    let bar = progress::bar("testing", blocks.div_ceil(shard.count as u64) * whole, "pairs", false);
    arguments.log.iter().for_each(|log| progress::kept(log, &bar));
    let mut sum = Block::default();
    for number in (0..blocks).filter(|number| shard.has(*number as usize)) {
        if let Some(block) = log.as_ref().and_then(|log| log.blocks().get(&number)) {
            sum.add(block);
        } else {
            let block = once.block(number);
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
            pairs: total.truths.total(),
            total: &total,
            families: rows.collect(),
            faults: &sum.faults,
        })?;
    } else {
        print(&table(families, &designs, arguments.seed, &sum))?;
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
