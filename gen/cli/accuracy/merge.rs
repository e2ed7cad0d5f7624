//! `efsat accuracy merge`.

use super::{command, finish, nanoseconds, output, params, points};
use crate::error::Failure;
use efsat_studies::accuracy::{Missing, Plan, Progress, Request, Results, Store};
use efsat_unit::artefact::Scratch;
use std::path::{Path, PathBuf};

/// Joins the parts of a campaign that `efsat accuracy --shard I/N` made, and writes its page
#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// Folders of the parts
    #[arg(value_name = "DIR", required = true)]
    parts: Vec<PathBuf>,
    /// Folder of the whole
    #[arg(long, value_name = "DIR", required = true)]
    out: PathBuf,
    /// Nanoseconds that the transfer of a possibly incorrect pair to software takes
    #[arg(long, value_name = "NS", default_value_t = 0.0, value_parser = nanoseconds, allow_negative_numbers = true)]
    transfer: f64,
    /// Print one JSON object instead of a summary
    #[arg(long)]
    json: bool,
}

/// The first thing in which two requests differ.
fn difference(x: &Request, y: &Request) -> Option<(&'static str, String, String)> {
    let of = |r: &Request| {
        let base: Vec<String> = r.base.iter().map(|(name, value)| format!("{name} {value}")).collect();
        let multipliers = format!("{:?}", r.multipliers);
        [
            ("version", r.version.clone()),
            ("scene", format!("{} ({})", r.scene, r.digest)),
            ("pairs", r.pairs.clone()),
            ("seed", r.seed.to_string()),
            ("sweep", r.sweep.clone()),
            ("parameters", base.join(" ")),
            ("multipliers", multipliers),
            ("synth", r.synth.to_string()),
        ]
    };
    of(x).into_iter().zip(of(y)).find(|(x, y)| x.1 != y.1).map(|(x, y)| (x.0, x.1, y.1))
}

fn same_campaign(first: &Path, request: &Request, part: &Path) -> Result<(), Failure> {
    match difference(request, &output::request(part)?) {
        None if output::has_results(part) => Ok(()),
        None => Err(Failure::Usage(format!(
            "{}: found no results; expected a folder that efsat accuracy wrote",
            part.display()
        ))),
        Some((what, there, here)) => Err(Failure::Usage(format!(
            "{}: found {what} {here}, but {there} in {}; expected parts of one campaign",
            part.display(),
            first.display()
        ))),
    }
}

/// What a campaign has to do, by what was asked for.
fn plan(request: &Request) -> Result<Plan, String> {
    let base = params(&request.base)?;
    let sweep = points(&request.sweep, &base).map_err(Failure::message)?;
    Plan::new(&base, &sweep, &request.multipliers).map_err(|e| e.to_string())
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let first = &arguments.parts[0];
    let request = output::request(first)?;
    arguments.parts.iter().try_for_each(|part| same_campaign(first, &request, part))?;
    output::claimable(&arguments.out)?;
    let plan = plan(&request).map_err(|message| output::wrong_request(first, &message))?;
    // Joined beside the target first, so that parts that are not complete leave nothing behind.
    let scratch = Scratch::new().map_err(|e| Failure::Usage(e.to_string()))?;
    let mut store = Store::open(scratch.path())?;
    arguments.parts.iter().try_for_each(|part| store.join(part))?;
    let text = command(&request, arguments.transfer);
    let join = |store: &Store| Results::join(&request, &plan, store, arguments.transfer, text.clone());
    let part_of_it =
        |e: Missing| output::wrong_request(first, &format!("{e}; expected all parts of this campaign, finished"));
    join(&store).map_err(part_of_it)?;
    let mut whole = output::claim(&arguments.out, &request)?;
    whole.join(scratch.path())?;
    let results = join(&whole).map_err(|e| Failure::Check(e.to_string()))?;
    let progress = Progress { found: whole.records().count(), made: 0 };
    finish(&results, &arguments.out, progress, arguments.json)
}
