//! `efsat stress`.

mod once;

use super::accuracy::shard;
use super::error::Failure;
use super::file;
use super::output::{print, print_json};
use super::params::ParamArguments;
use super::progress;
use super::source;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use efsat_checks::stress::{Campaign, Counts, FAMILIES, Family, Plan, Report};
use efsat_studies::accuracy::Shard;
use efsat_unit::host::{Reference, Truths};
use serde::Serialize;
use std::path::{Path, PathBuf};

/// Compares the reference model with the exact answer on named families of hard pairs
///
/// Every pair is asked in all 72 orders of vertices and roles, with permuted and mirrored axes, at exact scales and
/// translations, on other widths and options, and under a pose. The exit status is 1 if a definite answer is wrong.
/// Case i of a family depends on the seed, the family and i alone.
///
/// With --once each pair is asked as its family makes it and no other way, so that very many can be asked, of one or more
/// designs. The exact answer is then that of the software retest, checked by the oracle on every 1,024th case and on every
/// contradiction. Finished blocks of 16,384 cases per family are appended to the log: a run that was interrupted goes on where it
/// stopped, and logs of several shards can be concatenated.
#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// Pairs of all families together, before they are written in other ways; with --once rounded up to whole blocks [default:
    /// 40000, with --once 1000000]
    #[arg(long, value_name = "N", value_parser = source::count, allow_negative_numbers = true)]
    pairs: Option<u64>,
    /// Seed of all pairs
    #[arg(long, value_name = "S", default_value_t = 1, value_parser = source::seed, allow_negative_numbers = true)]
    seed: u64,
    /// Only this family; may be given several times
    #[arg(long = "family", value_name = "NAME", value_parser = family())]
    families: Vec<&'static Family>,
    /// Index of the first pair of each family
    #[arg(long, value_name = "INDEX", default_value_t = 0, value_parser = source::seed, allow_negative_numbers = true)]
    first: u64,
    /// List the families and do nothing else
    #[arg(long, conflicts_with_all = ["pairs", "seed", "families", "first", "json", "once"])]
    list: bool,
    /// Write the pairs to DIR/FAMILY.f64 (18 little-endian binary64 numbers per pair) and do nothing else
    #[arg(long, value_name = "DIR", conflicts_with_all = ["list", "json", "once"])]
    emit: Option<PathBuf>,
    /// Ask each pair once, as its family makes it
    #[arg(long, conflicts_with = "first")]
    once: bool,
    /// Designs to ask, as in `efsat accuracy --sweep`; without it the one design of the other options
    #[arg(long, value_name = "SPEC", requires = "once")]
    sweep: Option<String>,
    /// File that finished blocks are appended to, and taken from
    #[arg(long, value_name = "FILE", requires = "once")]
    log: Option<PathBuf>,
    /// Only part I of N of the blocks
    #[arg(long, value_name = "I/N", value_parser = shard, allow_hyphen_values = true, requires_all = ["once", "log"])]
    shard: Option<Shard>,
    /// Print one JSON object instead of a table
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    params: ParamArguments,
}

fn family() -> impl TypedValueParser<Value = &'static Family> {
    PossibleValuesParser::new(FAMILIES.iter().map(|family| family.name))
        .map(|name| Family::by_name(&name).expect("clap lets names of the list through"))
}

/// A row of the JSON object.
#[derive(Serialize)]
struct Row {
    family: &'static str,
    #[serde(flatten)]
    counts: Columns,
}

/// Counts as the JSON object names them.
#[derive(Serialize)]
struct Columns {
    pairs: u64,
    answers: u64,
    #[serde(flatten)]
    truths: Truths,
    definite: u64,
    definite_separate: u64,
    definite_intersect: u64,
    possibly_incorrect: u64,
    host_decided: u64,
    wrong: u64,
    disagreements: u64,
    unstable: u64,
}

impl From<&Counts> for Columns {
    fn from(counts: &Counts) -> Self {
        Self {
            pairs: counts.truths.total(),
            answers: counts.answers.total(),
            truths: counts.truths,
            definite: counts.answers.separate + counts.answers.intersect,
            definite_separate: counts.answers.separate,
            definite_intersect: counts.answers.intersect,
            possibly_incorrect: counts.answers.possibly_incorrect,
            host_decided: counts.host_decided,
            wrong: counts.wrong,
            disagreements: counts.disagreements,
            unstable: counts.unstable,
        }
    }
}

/// The JSON object.
#[derive(Serialize)]
struct Summary {
    seed: u64,
    first: u64,
    #[serde(flatten)]
    total: Columns,
    digest: String,
    families: Vec<Row>,
}

impl Summary {
    fn new(plan: &Plan, report: &Report) -> Self {
        let row = |(family, counts): &(&Family, Counts)| Row { family: family.name, counts: counts.into() };
        Self {
            seed: plan.seed,
            first: plan.first,
            total: (&report.total()).into(),
            digest: format!("{:016x}", report.digest),
            families: report.families.iter().map(row).collect(),
        }
    }
}

fn table(plan: &Plan, report: &Report) -> String {
    let line = |name: &str, cells: [&str; 9]| {
        let cells: String = cells.iter().map(|cell| format!("{cell:>12}")).collect();
        format!("{name:<22}{cells}\n")
    };
    let row = |name: &str, counts: &Counts| {
        let cells = [
            counts.truths.total(),
            counts.truths.separate,
            counts.truths.touch,
            counts.truths.intersect,
            counts.answers.total(),
            counts.answers.separate,
            counts.answers.intersect,
            counts.answers.possibly_incorrect,
            counts.wrong,
        ];
        let cells = cells.map(|cell| cell.to_string());
        line(name, [0, 1, 2, 3, 4, 5, 6, 7, 8].map(|i| cells[i].as_str()))
    };
    let titles = ["pairs", "separate", "touch", "intersect", "answers", "separate", "intersect", "p.i.", "wrong"];
    let rows: String = report.families.iter().map(|(family, counts)| row(family.name, counts)).collect();
    let total = report.total();
    format!(
        "seed {}, pairs from {} on; digest of all answers {:016x}\n{}{}{rows}{}{} host-decided, {} disagreements of \
         the exact formulations, {} unstable\n",
        plan.seed,
        plan.first,
        report.digest,
        line("", ["", "exactly", "", "", "", "answered", "", "", ""]),
        line("family", titles),
        row("all", &total),
        total.host_decided,
        total.disagreements,
        total.unstable
    )
}

fn list() -> String {
    FAMILIES.iter().map(|family| format!("{:<22}{}\n", family.name, family.what)).collect()
}

/// The pairs of each family as a file.
fn emit(plan: &Plan, dir: &Path) -> Result<(), Failure> {
    file::folder(dir)?;
    let files = plan.families.iter().enumerate().map(|(i, family)| {
        let cases = (i as u64..plan.pairs).step_by(plan.families.len()).zip(plan.first..);
        let points = cases.map(|(_, index)| family.case(plan.seed, index).0);
        let bytes: Vec<u8> =
            points.flat_map(|points| points.into_iter().flatten()).flat_map(f64::to_le_bytes).collect();
        (dir.join(family.name).with_extension("f64"), bytes)
    });
    file::write_all(files.filter(|(_, bytes)| !bytes.is_empty()))
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let params = arguments.params.params()?;
    if arguments.list {
        return print(&list());
    }
    let asked = |family: &&Family| arguments.families.is_empty() || arguments.families.contains(family);
    let families: Vec<&Family> = FAMILIES.iter().filter(asked).collect();
    if arguments.once {
        return once::run(arguments, &families, params);
    }
    let Arguments { first, seed, .. } = *arguments;
    let pairs = arguments.pairs.unwrap_or(40_000);
    if first.checked_add(pairs.div_ceil(families.len() as u64) - 1).is_none() {
        return Err(Failure::Usage(format!("--first {first}: expected an index with --pairs {pairs} below 2^64")));
    }
    let plan = Plan { families, pairs, first, seed };
    if let Some(dir) = &arguments.emit {
        return emit(&plan, dir);
    }
    let bar = progress::bar("testing", pairs, "pairs", false);
    let report = Campaign::new(&params, Reference::new).run(&plan, &|| bar.inc(1));
    bar.finish_and_clear();
    if arguments.json {
        print_json(&Summary::new(&plan, &report))?;
    } else {
        print(&table(&plan, &report))?;
    }
    report.faults.iter().for_each(|fault| eprint!("{fault}"));
    let total = report.total();
    if total.faults() == 0 {
        return Ok(());
    }
    Err(Failure::Check(format!(
        "{} wrong definite answers, {} disagreements of the exact formulations, {} unstable answers",
        total.wrong, total.disagreements, total.unstable
    )))
}
