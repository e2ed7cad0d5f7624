//! `efsat accuracy`.

mod merge;
mod output;
mod page;

use super::error::Failure;
use super::output::{print, print_json};
use super::params::ParamArguments;
use super::progress;
use super::source;
use clap::{Args, FromArgMatches};
use efsat_studies::accuracy::{self, Amount, Campaign, MOST, Plan, Progress, Request, Results, Shard, sweep};
use efsat_unit::design::Design;
use efsat_unit::params::options::Choice;
use efsat_unit::params::{Method, Params};
use std::path::{Path, PathBuf};

/// Pairs of a scene where nothing else is asked for.
const PAIRS: u64 = 100_000;
/// Budgets where nothing else is asked for: the paper's design, its device, three of the paper's.
const MULTIPLIERS: [u64; 3] = [72, 144, 216];
/// Folder of the results.
const OUT: &str = "accuracy-out";

/// Sweeps the design space over a scene and reports what accuracy costs in time: a page, plots and data
///
/// Of every point: definite and possibly incorrect answers with 95 % bounds, wrong answers by the exact oracle, cells,
/// clock, and the effective time per pair, which is hardware time + share of possibly incorrect pairs x (measured time of
/// their exact retest + transfer). Results are kept as they are finished: the same command goes on where it stopped.
/// Fails if a definite answer is wrong.
#[derive(Debug, clap::Args)]
#[command(args_conflicts_with_subcommands = true)]
pub(super) struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
    /// Scene whose pairs are asked: a TOML file, or `headlight` for the built-in scene
    #[arg(long, value_name = "FILE", default_value = source::HEADLIGHT)]
    scene: String,
    /// Points: grids such as width=12..24,upper=implied|sticky joined by `;`, around the parameters given
    #[arg(long, value_name = "SPEC", default_value = sweep::DEFAULT, hide_default_value = true)]
    sweep: String,
    /// Folder of the results
    #[arg(long, value_name = "DIR", default_value = OUT)]
    out: PathBuf,
    /// Candidate pairs of the scene, drawn at random, or `all`
    #[arg(long, value_name = "N", default_value_t = Amount::Some(PAIRS), value_parser = amount)]
    #[arg(allow_negative_numbers = true)]
    pairs: Amount,
    /// Seed of the draw
    #[arg(long, value_name = "S", default_value_t = 1, value_parser = source::seed, allow_negative_numbers = true)]
    seed: u64,
    /// Budgets of multipliers: for each width the fastest folding that fits
    #[arg(long, value_name = "LIST", default_values_t = MULTIPLIERS, value_delimiter = ',', value_parser = source::count)]
    #[arg(allow_negative_numbers = true)]
    multipliers: Vec<u64>,
    /// Nanoseconds that the transfer of a possibly incorrect pair to software takes
    #[arg(long, value_name = "NS", default_value_t = 0.0, value_parser = nanoseconds, allow_negative_numbers = true)]
    #[arg(conflicts_with = "shard")]
    transfer: f64,
    /// Compute only part I of N and write no page; `efsat accuracy merge` joins the parts
    #[arg(long, value_name = "I/N", value_parser = shard, allow_hyphen_values = true)]
    shard: Option<Shard>,
    /// Map every point with Yosys as well: minutes per point
    #[arg(long)]
    synth: bool,
    /// Print one JSON object instead of a summary
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    params: ParamArguments,
}

#[derive(Debug, clap::Subcommand)]
enum Command {
    Merge(merge::Arguments),
    Page(page::Arguments),
}

fn amount(text: &str) -> Result<Amount, String> {
    let number = || text.parse().ok().filter(|n| (1..=MOST).contains(n)).map(Amount::Some);
    let found = if text == "all" { Some(Amount::All) } else { number() };
    found.ok_or_else(|| format!("expected `all` or a whole number from 1 to {MOST}"))
}

fn nanoseconds(text: &str) -> Result<f64, String> {
    let legal = |x: &f64| (0.0..=1e12).contains(x);
    text.parse().ok().filter(legal).ok_or_else(|| "expected a number of nanoseconds from 0 to 1e12".to_owned())
}

pub(super) fn shard(text: &str) -> Result<Shard, String> {
    let parts = text.split_once('/').and_then(|(i, n)| Some((i.parse().ok()?, n.parse().ok()?)));
    let legal = |(index, count): &(usize, usize)| (1..=*count).contains(index) && *count <= 10_000;
    let found = parts.filter(legal).map(|(index, count)| Shard { index, count });
    found.ok_or_else(|| "expected I/N with I from 1 to N, N up to 10000".to_owned())
}

/// The parameters of every point of a sweep around `base`.
pub(super) fn points(spec: &str, base: &Params) -> Result<Vec<Params>, Failure> {
    combinations(spec)?.iter().map(|settings| point(settings, base)).collect()
}

/// The same beside options that were typed; one that all points set is refused, as it would change nothing.
pub(super) fn points_beside(spec: &str, typed: &ParamArguments, base: &Params) -> Result<Vec<Params>, Failure> {
    let all = combinations(spec)?;
    let swept = |option: &&str| all.iter().all(|settings| settings.iter().any(|one| one.option == *option));
    match Params::OPTIONS.iter().map(|option| option.name).find(|name| typed.has(name) && swept(name)) {
        None => all.iter().map(|settings| point(settings, base)).collect(),
        Some(name) => {
            Err(Failure::Usage(format!("--{name} with --sweep, which sets {name} too: expected only one of them")))
        }
    }
}

/// The settings of every point of a sweep.
fn combinations(spec: &str) -> Result<Vec<Vec<sweep::Setting>>, Failure> {
    let names: Vec<&str> = Params::OPTIONS.iter().map(|option| option.name).collect();
    sweep::parse(spec, &names).map_err(|e| Failure::Usage(format!("--sweep: {e}")))
}

/// The parameters of a point, read as the command line reads them.
fn point(settings: &[sweep::Setting], base: &Params) -> Result<Params, Failure> {
    let mut options = accuracy::options(base);
    options.extend(settings.iter().map(|setting| (setting.option.clone(), setting.value.clone())));
    // Where a point has another method than the base, options that only the base has are not asked for, and what the base
    // has by default does not hold for it.
    let method = options.get("method").and_then(|name| Method::ALL.iter().find(|method| method.name() == name));
    if let Some(method) = method.filter(|method| **method != base.method) {
        let given = |name: &str| settings.iter().any(|setting| setting.option == name);
        let default = accuracy::options(&Params::of(base.method));
        let has = |name: &str| Params::OPTIONS.iter().any(|option| option.name == name && option.of.contains(method));
        options.retain(|name, value| given(name) || (has(name) && default.get(name) != Some(value)));
    }
    params(&options).map_err(|message| {
        // The message names the option; the last setting that does is the place.
        let named = |setting: &&sweep::Setting| message.contains(&format!("--{} ", setting.option));
        let at = settings.iter().rev().find(named).or(settings.first()).map_or(1, |setting| setting.at);
        Failure::Usage(format!("--sweep: at character {at}: {message}"))
    })
}

/// Parameters from options by name.
fn params(options: &accuracy::Options) -> Result<Params, String> {
    let command = ParamArguments::augment_args(clap::Command::new("efsat").no_binary_name(true));
    let words = options.iter().map(|(name, value)| format!("--{name}={value}"));
    let matches = command.try_get_matches_from(words).and_then(|matches| ParamArguments::from_arg_matches(&matches));
    let arguments = matches.map_err(|e| super::error::from_clap(&e, &[]).message())?;
    arguments.params().map_err(Failure::message)
}

impl Arguments {
    fn request(&self, scene: &efsat_geometry::scene::Scene, base: &Params) -> Request {
        Request {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            scene: self.scene.clone(),
            title: scene.name.clone(),
            digest: accuracy::digest(scene),
            pairs: self.pairs.to_string(),
            seed: self.seed,
            sweep: self.sweep.clone(),
            base: accuracy::options(base),
            multipliers: self.multipliers.clone(),
            synth: self.synth,
        }
    }
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    match &arguments.command {
        Some(Command::Merge(arguments)) => return merge::run(arguments),
        Some(Command::Page(arguments)) => return page::run(arguments),
        None => {}
    }
    let base = arguments.params.params()?;
    has_axes(&base)?;
    // Every point has its hardware beside it.
    let check = |params: &Params| -> Result<(), Failure> { Ok(Design::check(params).map(drop)?) };
    check(&base)?;
    let sweep = points(&arguments.sweep, &base)?;
    if sweep.iter().any(|params| params.method == Method::Exact) {
        let why =
            "--sweep: found method=exact, which leaves no pair undecided on its grid; expected axes or determinants";
        return Err(Failure::Usage(why.to_owned()));
    }
    sweep.iter().try_for_each(check)?;
    let scene = source::load_scene(&arguments.scene)?;
    output::claimable(&arguments.out)?;
    let request = arguments.request(&scene, &base);
    let spinner = progress::spinner("planning");
    let plan = Plan::new(&base, &sweep, &arguments.multipliers)?;
    spinner.finish_and_clear();
    let shard = arguments.shard.unwrap_or(Shard::WHOLE);
    let campaign = Campaign { request: &request, plan: &plan, scene: &scene, amount: arguments.pairs, shard };
    let mut store = output::claim(&arguments.out, &request)?;
    let bar = progress::bar("measuring", campaign.len() as u64, "points", false);
    bar.tick();
    progress::kept(&arguments.out, &bar);
    let progress = campaign.run(&mut store, &|| bar.inc(1)).map_err(output::ended)?;
    bar.finish_and_clear();
    if let Some(shard) = arguments.shard {
        return part_done(arguments, shard, progress);
    }
    let results = Results::join(&request, &plan, &store, arguments.transfer, command(&request, arguments.transfer));
    finish(&results.map_err(|e| Failure::Check(e.to_string()))?, &arguments.out, progress, arguments.json)
}

fn part_done(arguments: &Arguments, shard: Shard, Progress { found, made }: Progress) -> Result<(), Failure> {
    let (index, count) = (shard.index, shard.count);
    if arguments.json {
        return print_json(&serde_json::json!({ "shard": [index, count], "found": found, "made": made }));
    }
    let dir = arguments.out.display();
    print(&format!("{dir}: part {index} of {count}, {made} results made, {found} found finished\n"))
}

/// Writes the page and prints what is in it.
fn finish(results: &Results, dir: &Path, progress: Progress, json: bool) -> Result<(), Failure> {
    let page = (output::PAGE.to_owned(), accuracy::page(std::slice::from_ref(results)));
    output::write(dir, &[accuracy::files(results), vec![page]].concat())?;
    if json {
        print_json(&output::Printed::new(results, progress))?;
    } else {
        print(&output::summary(results, dir, progress))?;
    }
    match results.wrong() {
        0 => Ok(()),
        wrong => Err(Failure::Check(format!("{wrong} wrong definite answers"))),
    }
}

/// The command that makes a campaign's results, whatever shards made them.
fn command(request: &Request, transfer: f64) -> String {
    let mut text = "efsat accuracy".to_owned();
    let quoted = |text: &str| {
        let plain = |c: char| c.is_ascii_alphanumeric() || "-_./,=".contains(c);
        if text.chars().all(plain) { text.to_owned() } else { format!("'{}'", text.replace('\'', r"'\''")) }
    };
    let mut add = |name: &str, value: &str, default: &str| {
        if value != default {
            text.push_str(&format!(" --{name} {}", quoted(value)));
        }
    };
    let list = |list: &[u64]| list.iter().map(u64::to_string).collect::<Vec<_>>().join(",");
    add("scene", &request.scene, source::HEADLIGHT);
    add("sweep", &request.sweep, sweep::DEFAULT);
    add("pairs", &request.pairs, &PAIRS.to_string());
    add("seed", &request.seed.to_string(), "1");
    add("multipliers", &list(&request.multipliers), &list(&MULTIPLIERS));
    add("transfer", &transfer.to_string(), "0");
    for (name, default) in Params::default().every_option() {
        // A method does not record the options of the other one.
        add(name, request.base.get(name).unwrap_or(&default), &default);
    }
    if request.synth {
        text.push_str(" --synth");
    }
    text
}

/// Refuses a base whose stages the page does not examine; points of the sweep may be determinants.
fn has_axes(params: &Params) -> Result<(), Failure> {
    match params.method {
        Method::Axes => Ok(()),
        Method::Determinants => {
            let why = "--method determinants: expected axes, whose stages the page examines; a --sweep may name method=determinants";
            Err(Failure::Usage(why.to_owned()))
        }
        Method::Exact => {
            let why = "--method exact: expected axes, whose stages the page examines; the exact unit rounds nothing";
            Err(Failure::Usage(why.to_owned()))
        }
    }
}
