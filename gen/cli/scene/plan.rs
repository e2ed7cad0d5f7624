//! `efsat scene plan`.

use super::given::GivenArguments;
use crate::cli::error::Failure;
use crate::cli::output::{print, print_json};
use crate::cli::progress;
use crate::cli::source::load_planned;
use crate::effects::{self, Answers, Cost, Finding, Plan, Saving, Wish};

/// Finds out which optional stages a scene needs, why, and what leaving out the others saves
///
/// Stages before the unit: broad_phase, hierarchy, degenerate. Stages of the unit: transform, renormalise, in_plane_axes,
/// exact_ceiling. One of the unit is left out if no surviving pair becomes less definite without it, measured with the
/// reference model (--allowed grants a share of them). The last line generates the planned unit.
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
    let plan = effects::plan(&scene, &request)?;
    spinner.finish_and_clear();
    if arguments.json {
        return print_json(&plan);
    }
    print(&text(&plan))
}

fn text(plan: &Plan) -> String {
    let (frames, survive) = (plan.census.frames, plan.census.statistics.pairs_tested);
    let mut text = format!(
        "{}: {frames} poses, {survive} pairs of triangles survive, {} come to the unit\n\n",
        plan.scene, plan.unit_pairs
    );
    text.push_str(&format!("{:<15}{:<8}{:<11}{:<8}reason\n", "effect", "needed", "state", "by"));
    for finding in &plan.effects {
        text.push_str(&line(finding));
    }
    text.push_str(&format!(
        "\n{:<10}{:>10}{:>11}{:>20}{:>13}{:>8}{:>12}{:>9}{:>10}\n",
        "unit",
        "separate",
        "intersect",
        "possibly incorrect",
        "multipliers",
        "LUTs",
        "flip-flops",
        "latency",
        "interval"
    ));
    for (name, answers) in [("full", &plan.full), ("planned", &plan.planned)] {
        text.push_str(&unit(name, answers));
    }
    text.push_str(&format!(
        "{} pairs less definite in the planned unit, {} allowed; {} contradictions\n",
        plan.planned.tally.less_definite,
        (plan.allowed * plan.unit_pairs as f64).floor(),
        plan.planned.tally.contradictions
    ));
    if let Some(saving) = &plan.saving {
        text.push_str(&format!("the planned unit saves {} in all\n", words(saving)));
    }
    text.push_str(&format!("\n{}\n", plan.command_line));
    text
}

fn line(finding: &Finding) -> String {
    let needed = if finding.needed { "yes" } else { "no" };
    let by = match finding.decided_by {
        Wish::Auto => "auto",
        Wish::On => "on",
        Wish::Off => "off",
        Wish::Option => "option",
    };
    let mut text = format!("{:<15}{needed:<8}{:<11}{by:<8}{}\n", finding.effect, finding.state, finding.reason);
    if let Some(saving) = &finding.saving {
        let verb = if finding.state == "on" { "would save" } else { "saves" };
        text.push_str(&format!("{:<42}leaving it out {verb} {}\n", "", words(saving)));
    }
    text
}

fn words(saving: &Saving) -> String {
    let Saving { multipliers, luts, flip_flops, latency, interval, simulation } = saving;
    let simulation = simulation.map_or(String::new(), |ratio| format!("; simulation {ratio:.2} times as fast"));
    format!(
        "{multipliers} multipliers, {luts} LUTs, {flip_flops} flip-flops, {latency} clocks of latency and {interval} of \
         the interval{simulation}"
    )
}

fn unit(name: &str, answers: &Answers) -> String {
    let Answers { tally, cost } = answers;
    let column = |pick: fn(&Cost) -> u64| cost.as_ref().map_or(String::new(), |cost| pick(cost).to_string());
    let share = match tally.pairs() {
        0 => 0.0,
        pairs => 100.0 * tally.possibly_incorrect as f64 / pairs as f64,
    };
    format!(
        "{name:<10}{:>10}{:>11}{:>20}{:>13}{:>8}{:>12}{:>9}{:>10}\n",
        tally.separate,
        tally.intersect,
        format!("{} ({share:.2} %)", tally.possibly_incorrect),
        column(|cost| cost.multipliers),
        column(|cost| cost.luts),
        column(|cost| cost.flip_flops),
        column(|cost| cost.latency),
        column(|cost| cost.interval)
    )
}
