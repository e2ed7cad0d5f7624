//! The files that a campaign ends in: the page, its plots, its data. The page may show several campaigns.

use super::break_even::{BreakEven, Effect, Step};
use super::figures;
use super::floor::Blocks;
use super::headline::{capitalised, grouped, percent, significant, time};
use super::ladder::EXACT;
use super::point::{Options, options};
use super::results::Results;
use super::row::Row;
use super::store::Drawn;
use super::table;
use askama::Template;
use efsat_unit::params::options::Choice;
use efsat_unit::params::{Method, Params};
use serde::Serialize;

/// A line of a small table.
struct Line {
    name: String,
    about: String,
    cells: Vec<String>,
}

/// What the page says about a scene beside its points.
struct Scene<'a> {
    title: &'a str,
    sentences: &'a [String],
    ladder: Vec<Line>,
    changed_by_rounding: String,
    steps: Vec<(String, Vec<Line>)>,
    break_even: Vec<String>,
    folds: Vec<Line>,
    budgets: Vec<String>,
    stages: Vec<Line>,
    examined: String,
    undecided: String,
    floor_about: Vec<String>,
    floor_axes: Vec<Line>,
    command: &'a str,
    sweep: Vec<&'a str>,
    parameters: String,
    pairs: String,
    transfer: String,
    yardstick: String,
}

#[derive(Template)]
#[template(path = "accuracy.html")]
struct Page<'a> {
    scenes: Vec<Scene<'a>>,
    library_style: &'static str,
    library: String,
    style: &'static str,
    script: &'static str,
    data: String,
    version: &'static str,
}

/// What the page's script reads.
#[derive(Serialize)]
struct Data<'a> {
    scenes: Vec<Shown<'a>>,
}

#[derive(Serialize)]
struct Shown<'a> {
    title: &'a str,
    /// The device of the point around which the sweep goes.
    device: &'a str,
    points: Vec<Dot<'a>>,
    software: Vec<Test<'a>>,
}

/// A point, with everything that does not depend on the controls.
#[derive(Serialize)]
struct Dot<'a> {
    kind: u8,
    method: &'a str,
    bits: u32,
    /// Clocks per pair.
    clocks: usize,
    latency: usize,
    /// The clock that the schedule allows, MHz.
    clock: f64,
    multipliers: u64,
    luts: u64,
    flip_flops: u64,
    fits: bool,
    device: &'a str,
    /// Share of undecided pairs, and its bounds.
    share: f64,
    low: f64,
    high: f64,
    wrong: u64,
    /// The exact retest of an undecided pair, ns.
    retest: f64,
    /// Whether it does all the work that the point around which the sweep goes does.
    whole: bool,
    /// Whether it differs from the plain unit of its kind in the width alone.
    line: bool,
    options: String,
}

/// A test in software.
#[derive(Serialize)]
struct Test<'a> {
    kind: u8,
    name: &'a str,
    about: &'a str,
    /// Whether it answers every pair there can be, and never wrongly.
    exact: bool,
    /// Share of pairs without a right answer.
    share: f64,
    /// Time per pair, ns.
    measured: f64,
}

/// What the script draws alike, by its number there.
#[derive(Clone, Copy)]
enum Kind {
    Axes = 0,
    Paper = 1,
    Determinants = 2,
    Software = 3,
}

/// The files of a campaign beside its page, by name: plots and data.
pub fn files(results: &Results) -> Vec<(String, String)> {
    let mut files: Vec<(String, String)> =
        figures::all(results).into_iter().map(|figure| (format!("{}.svg", figure.name), figure.svg)).collect();
    let json = serde_json::to_string_pretty(results).expect("keys are strings and numbers are finite");
    files.push(("points.csv".to_owned(), table::csv(results)));
    files.push(("accuracy.json".to_owned(), json + "\n"));
    files
}

/// The page of one campaign or several.
pub fn page(campaigns: &[Results]) -> String {
    let data = Data { scenes: campaigns.iter().map(shown).collect() };
    let data = serde_json::to_string(&data).expect("keys are strings and numbers are finite");
    let licence = include_str!("../web/uplot/LICENSE");
    let page = Page {
        scenes: campaigns.iter().map(scene).collect(),
        library_style: include_str!("../web/uplot/uPlot.min.css"),
        library: format!("/*\n{licence}*/\n{}", include_str!("../web/uplot/uPlot.iife.min.js")),
        style: include_str!("../web/accuracy.css"),
        script: include_str!("../web/accuracy.js"),
        // No text in it ends the element.
        data: data.replace('<', "\\u003c"),
        version: env!("CARGO_PKG_VERSION"),
    };
    page.render().expect("the template renders")
}

fn shown(results: &Results) -> Shown<'_> {
    let software = results.ladder.iter().map(|step| Test {
        kind: Kind::Software as u8,
        name: &step.rung.name,
        about: &step.rung.about,
        exact: EXACT.contains(&step.rung.name.as_str()),
        share: step.open.share,
        measured: step.ns,
    });
    Shown {
        title: &results.request.title,
        device: results.base().point.option("device"),
        points: results.rows.iter().map(|row| dot(results, row)).collect(),
        software: software.collect(),
    }
}

fn dot<'a>(results: &'a Results, row: &'a Row) -> Dot<'a> {
    let (point, hardware) = (&row.point, &row.point.hardware);
    let cells = point.synthesised.unwrap_or(hardware.cells);
    let [low, high] = row.possibly_incorrect.bounds;
    let paper = options(&Params::paper());
    let rounds = ["projections", "projection-width", "axis-shift", "edge-test"];
    let kind = match point.method() {
        method if method == Method::Determinants.name() => Kind::Determinants,
        _ if rounds.iter().all(|name| paper.get(*name).is_some_and(|value| value == point.option(name))) => Kind::Paper,
        _ => Kind::Axes,
    };
    let plain = options(&match kind {
        Kind::Paper => Params::paper(),
        Kind::Determinants => Params::of(Method::Determinants),
        _ => Params::default(),
    });
    Dot {
        kind: kind as u8,
        method: point.method(),
        bits: point.width(),
        clocks: hardware.interval,
        latency: hardware.latency,
        clock: hardware.clock,
        multipliers: cells.multipliers,
        luts: cells.luts,
        flip_flops: cells.flip_flops,
        fits: hardware.fits,
        device: point.option("device"),
        share: row.possibly_incorrect.share,
        low,
        high,
        wrong: point.answers.wrong,
        retest: if point.answers.retest.is_some() { row.cost_ns - results.transfer_ns } else { 0.0 },
        whole: point.option("transform") == results.base().point.option("transform"),
        // With or without a guard the answers are the same.
        line: point.differs_only_in(&plain, &["width", "guard"]),
        options: command_options(&point.options),
    }
}

/// The options that `efsat generate` needs for a point.
fn command_options(of: &Options) -> String {
    let method = Method::ALL.iter().find(|method| of.get("method").is_some_and(|name| name == method.name()));
    let usual = options(&Params::of(*method.unwrap_or(&Method::Axes)));
    let given = |(name, value): &(&String, &String)| *name == "method" || usual.get(*name) != Some(*value);
    let words: Vec<String> = of.iter().filter(given).map(|(name, value)| format!("--{name} {value}")).collect();
    words.join(" ")
}

fn scene(results: &Results) -> Scene<'_> {
    Scene {
        title: &results.request.title,
        sentences: &results.headline,
        ladder: ladder(results),
        changed_by_rounding: grouped(results.changed_by_rounding),
        steps: steps(results),
        break_even: results
            .at_clock
            .iter()
            .chain(&results.at_fastest)
            .chain(&results.in_budgets)
            .map(break_even)
            .collect(),
        folds: folds(results),
        budgets: budgets(results).iter().map(|budget| format!("{budget} multipliers")).collect(),
        stages: stages(results),
        examined: grouped(results.causes.examined),
        undecided: grouped(results.causes.undecided),
        floor_about: floor_about(results),
        floor_axes: floor_axes(results),
        command: &results.command,
        sweep: results.request.sweep.split(';').map(str::trim).collect(),
        parameters: parameters(results.base()),
        pairs: pairs(&results.drawn),
        transfer: significant(results.transfer_ns),
        yardstick: significant(results.yardstick_ns),
    }
}

/// Which pairs were asked, and what they are.
fn pairs(drawn: &Drawn) -> String {
    let Drawn { candidates, pairs, truths } = drawn;
    let of = if pairs == candidates {
        format!("all {}", grouped(*pairs))
    } else {
        format!("{} of the {}", grouped(*pairs), grouped(*candidates))
    };
    format!(
        "{of} pairs of triangles whose boxes overlap: {} separate, {} touching, {} intersecting, {} in one plane",
        grouped(truths.truths.separate),
        grouped(truths.truths.touch),
        grouped(truths.truths.intersect),
        grouped(truths.coplanar)
    )
}

fn parameters(row: &Row) -> String {
    let words: Vec<String> = row.point.options.iter().map(|(name, value)| format!("--{name} {value}")).collect();
    words.join(" ")
}

fn line(name: impl Into<String>, about: impl Into<String>, cells: Vec<String>) -> Line {
    Line { name: name.into(), about: about.into(), cells }
}

fn ladder(results: &Results) -> Vec<Line> {
    let of = |step: &super::results::Step| {
        let rung = &step.rung;
        let counts = [rung.missed, rung.invented, rung.undecided].map(grouped);
        line(
            &rung.name,
            &rung.about,
            [vec![significant(step.ns), format!("{:.2}", rung.timing.yardsticks)], counts.to_vec()].concat(),
        )
    };
    results.ladder.iter().map(of).collect()
}

/// The steps of the series that are worth a table, each with its name: at the clock given, and in the greatest budget.
fn steps(results: &Results) -> Vec<(String, Vec<Line>)> {
    let series = results.at_clock.iter().chain(results.in_budgets.last());
    series.map(|found| (capitalised(&found.series), found.steps.iter().map(step).collect())).collect()
}

fn step(step: &Step) -> Line {
    let effect = match step.effect {
        Effect::Pays => "yes",
        Effect::Even => "even",
        Effect::Costs => "no",
    };
    let share = match step.share {
        Some(share) if share > 1.0 => "no share".to_owned(),
        Some(share) => percent(share),
        None => String::new(),
    };
    let cells = vec![
        format!("{:+.2}", step.hardware_ns),
        format!("{:.3}", step.retest_ns),
        format!("{:+}", step.multipliers),
        effect.to_owned(),
        share,
        step.cost_ns.map_or_else(String::new, time),
    ];
    line(format!("{} to {}", step.from, step.to), "", cells)
}

/// What a series says, in words.
fn break_even(found: &BreakEven) -> String {
    let mut text = format!("{}: the effective time is shortest {}", capitalised(&found.series), found.best());
    match found.dearest() {
        None => text.push_str(", and no bit makes the hardware slower: one more pays as long as it decides anything."),
        Some(step) => {
            text.push_str(&format!(
                "; the most expensive step is the one to {} bits, {} ns more per pair",
                step.to,
                significant(step.hardware_ns)
            ));
            match step.share {
                Some(share) if share > 1.0 => text.push_str(", which no share of possibly incorrect pairs pays for"),
                Some(share) => {
                    text.push_str(&format!(", which stops paying below {} possibly incorrect", percent(share)));
                }
                None => {}
            }
            if let Some(cost) = step.cost_ns {
                text.push_str(&format!(
                    "; at the measured shares it pays if such a pair costs more than {}",
                    time(cost)
                ));
            }
            text.push('.');
        }
    }
    text
}

fn budgets(results: &Results) -> Vec<u64> {
    let mut budgets: Vec<u64> = results.foldings.iter().map(|fold| fold.budget).collect();
    budgets.dedup();
    budgets
}

fn folds(results: &Results) -> Vec<Line> {
    let budgets = budgets(results);
    let mut widths: Vec<u32> = results.foldings.iter().map(|fold| fold.width).collect();
    widths.sort_unstable();
    widths.dedup();
    let cell = |width: u32, budget: u64| {
        let fold = results.foldings.iter().find(|fold| (fold.width, fold.budget) == (width, budget));
        match fold.map(|fold| (fold.row, fold.least)) {
            Some((Some(row), _)) => {
                let row = &results.rows[row];
                let units = row.point.option("axes-per-clock");
                format!("{} ns ({units} per clock)", significant(row.effective_ns))
            }
            Some((None, least)) => format!("needs {least}"),
            None => String::new(),
        }
    };
    widths.iter().map(|&w| line(w.to_string(), "", budgets.iter().map(|&b| cell(w, b)).collect())).collect()
}

fn stages(results: &Results) -> Vec<Line> {
    let examined = results.causes.examined.max(1) as f64;
    let of = |cause: &super::causes::Cause| {
        let share = |count: u64| percent(count as f64 / examined);
        line(&cause.stage, "", vec![percent(cause.part.max(0.0)), share(cause.alone_exact), share(cause.alone_rounded)])
    };
    let genuine = percent(results.causes.genuine.total() as f64 / examined);
    let rest = line("genuine contact and degeneracy", "", vec![genuine, String::new(), String::new()]);
    results.causes.stages.iter().map(of).chain([rest]).collect()
}

fn floor_about(results: &Results) -> Vec<String> {
    let floor = &results.floor;
    let reasons = floor.reasons;
    let [low, high] = super::wilson(floor.answers.verdicts.possibly_incorrect, floor.answers.pairs);
    vec![
        format!(
            "The widest unit there is (32 bits, transform 48, 17 axes, exact ceilings, intersected projections) leaves {} of {} \
             pairs possibly incorrect: {} (95 % bounds {} to {}).",
            grouped(floor.answers.verdicts.possibly_incorrect),
            grouped(floor.answers.pairs),
            percent(floor.answers.share()),
            significant(100.0 * low),
            percent(high)
        ),
        format!(
            "Of {} examined exactly, {} intersect and have parallel edges (C_kl is zero and shows no overlap), {} touch, {} lie in \
             one plane, {} have a segment or a point; {} would be decided by still more bits.",
            grouped(floor.examined),
            grouped(reasons.parallel_edges),
            grouped(reasons.touch),
            grouped(reasons.coplanar),
            grouped(reasons.degenerate),
            grouped(floor.rounding)
        ),
    ]
}

fn floor_axes(results: &Results) -> Vec<Line> {
    let of = |(kind, blocks): (&String, &Blocks)| {
        line(kind, "", [blocks.zero, blocks.flat, blocks.apart, blocks.rounding].map(grouped).to_vec())
    };
    results.floor.axes.iter().map(of).collect()
}
