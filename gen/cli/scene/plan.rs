//! `efsat scene plan`.

use super::given::GivenArguments;
use crate::error::Failure;
use crate::output::{print, print_json};
use crate::progress;
use crate::source::load_planned;
use efsat_studies::planner::{self, Answers, Cost, Finding, Other, Plan, Saving, Tally, Wish};
use efsat_unit::params::Params;
use efsat_unit::params::options::Choice;
use std::cmp::Ordering;

/// Finds out which optional stages a scene needs, why, and what leaving out the others saves
///
/// Stages before the unit: broad_phase, hierarchy, degenerate. Stages of the unit: transform, renormalise, in_plane_axes,
/// exact_ceiling. One of the unit is left out if no surviving pair becomes less definite without it, measured with the
/// reference model (--allowed grants a share of them). Begins with the conclusion and the command that generates the planned
/// unit; then what the other method, axes or determinants, does with the same pairs, and its command.
#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// A scene: a TOML file, or `headlight` for the built-in one
    #[arg(value_name = "FILE")]
    file: String,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    given: GivenArguments,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let (scene, settings) = load_planned(&arguments.file)?;
    let request = arguments.given.request(&arguments.file, &settings)?;
    let spinner = progress::spinner("measuring");
    let plan = planner::plan(&scene, &request)?;
    spinner.finish_and_clear();
    if arguments.json {
        return print_json(&plan);
    }
    print(&text(&plan))
}

fn text(plan: &Plan) -> String {
    let mut text = conclusion(plan);
    text.push_str(&format!(
        "\nThe scene: {} poses; {} pairs of triangles survive, {} of them come to the unit.\n\n",
        plan.census.frames, plan.census.statistics.pairs_tested, plan.unit_pairs
    ));
    text.push_str(&format!("{:<15}{:<8}{:<11}{:<13}measured\n", "stage", "needed", "it is", "decided by"));
    for finding in &plan.effects {
        text.push_str(&line(finding));
    }
    text.push_str(&format!(
        "\n{:<20}{:>10}{:>11}{:>19}{:>13}{:>8}{:>12}{:>10}{:>10}\n",
        "answers of the unit",
        "separate",
        "intersect",
        "undecided",
        "multipliers",
        "LUTs",
        "flip-flops",
        "latency",
        "interval"
    ));
    let other = plan.other.iter().map(|other| (format!("by {}", other.method), &other.answers));
    let units = [("with every stage".to_owned(), &plan.full), ("as planned".to_owned(), &plan.planned)];
    for (name, answers) in units.into_iter().chain(other) {
        text.push_str(&unit(&name, answers));
    }
    text + "Latency: clocks from a pair to its answer. Interval: clocks between pairs. Cells are predicted.\n"
}

/// What to do, and the command that does it.
fn conclusion(plan: &Plan) -> String {
    let tally = &plan.planned.tally;
    let out: Vec<&str> =
        plan.effects.iter().filter(|effect| effect.state == "off").map(|effect| effect.effect).collect();
    let mut text = match out.as_slice() {
        [] => format!("{}: keep every stage.", plan.scene),
        [one] => format!("{}: leave out {one}.", plan.scene),
        [first @ .., last] => format!("{}: leave out {} and {last}.", plan.scene, first.join(", ")),
    };
    let open = undecided(tally);
    text.push_str(&match tally.verdicts.total() {
        0 => " No pair comes to the unit.".to_owned(),
        pairs => format!(" The unit decides all but {open} of {pairs} pairs."),
    });
    if plan.planned.cost.is_some_and(|cost| !cost.fits) {
        text.push_str(&format!(" It does not fit the {}.", plan.params.device));
    }
    if let Some(saving) = plan.saving.as_ref().filter(|_| plan.params != plan.full_params) {
        text.push_str(&format!(" Against the unit with every stage that {}.", words(saving, "saves", "costs")));
    }
    let (less, allowed) = (tally.less_definite, (plan.allowed * plan.unit_pairs as f64).floor());
    if less > 0 || plan.allowed > 0.0 {
        text.push_str(&format!(" Pairs that become undecided by that: {less}, of {allowed} allowed."));
    }
    if tally.contradictions > 0 {
        text.push_str(&format!(" CONTRADICTIONS: {}.", tally.contradictions));
    }
    text.push_str(&format!("\n\n  {}\n", command(&plan.params)));
    if let Some(other) = plan.other.as_ref().filter(|_| tally.verdicts.total() > 0) {
        text.push('\n');
        text.push_str(&compared(plan, other));
    }
    text
}

/// What the other method does with the same pairs.
fn compared(plan: &Plan, other: &Other) -> String {
    let [here, there] = [&plan.planned, &other.answers];
    let (fewer, equal) = (there.tally.verdicts.possibly_incorrect, here.tally.verdicts.possibly_incorrect);
    let says = match fewer.cmp(&equal) {
        Ordering::Less => "leaves fewer pairs undecided",
        Ordering::Equal => "leaves as many pairs undecided",
        Ordering::Greater => "leaves more pairs undecided",
    };
    let takes = |answers: &Answers| {
        answers.cost.map_or(String::new(), |cost| {
            let Cost { multipliers, luts, interval, fits, .. } = cost;
            let clocks = if interval == 1 { "clock" } else { "clocks" };
            let lacks = if fits { "" } else { " (more than the device has)" };
            format!("{multipliers} multipliers, {luts} LUTs{lacks}, {interval} {clocks} per pair")
        })
    };
    format!(
        "The other method, {}, {says}: {} instead of {}. It takes {} instead of {}.\n\n  {}\n",
        other.method,
        undecided(&there.tally),
        undecided(&here.tally),
        takes(there),
        takes(here),
        command(&other.params)
    )
}

/// The command that generates a unit, without what goes without saying.
fn command(params: &Params) -> String {
    let usual = Params::of(params.method);
    let method = (params.method != Params::default().method).then(|| format!(" --method {}", params.method.name()));
    let options = params.differences(&usual).into_iter().map(|(name, value)| format!(" --{name} {value}"));
    "efsat generate".to_owned() + &method.into_iter().chain(options).collect::<String>()
}

fn undecided(tally: &Tally) -> String {
    let share = match tally.verdicts.total() {
        0 => 0.0,
        pairs => 100.0 * tally.verdicts.possibly_incorrect as f64 / pairs as f64,
    };
    format!("{} ({share:.2} %)", tally.verdicts.possibly_incorrect)
}

fn line(finding: &Finding) -> String {
    let needed = if finding.needed { "yes" } else { "no" };
    let by = match finding.decided_by {
        Wish::Auto => "measuring",
        Wish::On | Wish::Off => "--effect",
        Wish::Option => "its option",
    };
    let state = match finding.state {
        "on" => "kept",
        "off" => "left out",
        other => other,
    };
    let mut text = format!("{:<15}{needed:<8}{state:<11}{by:<13}{}\n", finding.effect, finding.reason);
    if let Some(saving) = &finding.saving {
        let verbs = if finding.state == "on" { ("would save", "would cost") } else { ("saves", "costs") };
        text.push_str(&format!("{:<47}leaving it out {}\n", "", words(saving, verbs.0, verbs.1)));
    }
    text
}

/// What is saved, and what is spent for it.
fn words(saving: &Saving, saves: &str, costs: &str) -> String {
    let Saving { multipliers, luts, flip_flops, latency, interval, simulation } = *saving;
    let all = [
        (multipliers, "multipliers"),
        (luts, "LUTs"),
        (flip_flops, "flip-flops"),
        (latency, "clocks of latency"),
        (interval, "clocks between pairs"),
    ];
    let list = |sign: i64| {
        let some = all.iter().filter(|(amount, _)| amount.signum() == sign);
        some.map(|(amount, what)| format!("{} {what}", amount.abs())).collect::<Vec<_>>().join(", ")
    };
    let (saved, spent) = (list(1), list(-1));
    let mut text = match (saved.is_empty(), spent.is_empty()) {
        (true, true) => format!("{saves} no cell and no clock"),
        (false, true) => format!("{saves} {saved}"),
        (true, false) => format!("{costs} {spent}"),
        (false, false) => format!("{saves} {saved} and {costs} {spent}"),
    };
    if let Some(ratio) = simulation {
        text.push_str(&format!("; simulation {ratio:.2} times as fast"));
    }
    text
}

fn unit(name: &str, answers: &Answers) -> String {
    let Answers { tally, cost } = answers;
    let column = |pick: fn(&Cost) -> u64| cost.as_ref().map_or(String::new(), |cost| pick(cost).to_string());
    format!(
        "{name:<20}{:>10}{:>11}{:>19}{:>13}{:>8}{:>12}{:>10}{:>10}\n",
        tally.verdicts.separate,
        tally.verdicts.intersect,
        undecided(tally),
        column(|cost| cost.multipliers),
        column(|cost| cost.luts),
        column(|cost| cost.flip_flops),
        column(|cost| cost.latency),
        column(|cost| cost.interval)
    )
}
