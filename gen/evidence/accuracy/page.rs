//! The files that a campaign ends in: the page, its plots, its data.

use super::break_even::{BreakEven, Effect, Step};
use super::figures::{self, Figure};
use super::floor::Blocks;
use super::headline::{capitalised, grouped, percent, significant, time};
use super::results::Results;
use super::row::Row;
use super::store::Drawn;
use super::table::{self, COLUMNS, Cell, Column};
use askama::Template;

/// A number worth its size.
struct Fact {
    number: String,
    unit: &'static str,
    about: String,
}

/// A line of a small table.
struct Line {
    name: String,
    about: String,
    cells: Vec<String>,
}

/// A row of the big table.
struct TableRow {
    base: bool,
    cells: Vec<Cell>,
}

/// A plot in both sizes.
struct Plot {
    name: &'static str,
    caption: String,
    wide: String,
    narrow: String,
}

#[derive(Template)]
#[template(path = "accuracy.html")]
struct Page<'a> {
    title: &'a str,
    lede: &'a str,
    sentences: &'a [String],
    facts: Vec<Fact>,
    main: Plot,
    plots: Vec<Plot>,
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
    columns: &'static [Column],
    rows: Vec<TableRow>,
    points: usize,
    command: &'a str,
    sweep: Vec<&'a str>,
    parameters: String,
    pairs: String,
    transfer: String,
    yardstick: String,
    version: &'static str,
}

/// All files by name.
pub fn files(results: &Results) -> Vec<(String, String)> {
    let figures = figures::all(results);
    let mut files: Vec<(String, String)> =
        figures.iter().map(|figure| (format!("{}.svg", figure.name), figure.wide.clone())).collect();
    let json = serde_json::to_string_pretty(results).expect("keys are strings and numbers are finite");
    files.push(("points.csv".to_owned(), table::csv(results)));
    files.push(("accuracy.json".to_owned(), json + "\n"));
    files.push(("index.html".to_owned(), page(results, figures)));
    files
}

fn page(results: &Results, figures: Vec<Figure>) -> String {
    let mut plots = figures.into_iter().map(plot);
    let main = plots.next().expect("there is a main plot");
    let (lede, sentences) = results.headline.split_first().expect("there is a headline");
    let page = Page {
        title: &results.request.title,
        lede,
        sentences,
        facts: facts(results),
        main,
        plots: plots.collect(),
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
        columns: &COLUMNS,
        rows: results.rows.iter().map(|row| TableRow { base: row.base, cells: table::cells(row) }).collect(),
        points: results.rows.len(),
        command: &results.command,
        sweep: results.request.sweep.split(';').map(str::trim).collect(),
        parameters: parameters(results.base()),
        pairs: pairs(&results.drawn),
        transfer: significant(results.transfer_ns),
        yardstick: significant(results.yardstick_ns),
        version: env!("CARGO_PKG_VERSION"),
    };
    page.render().expect("the template renders")
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
        grouped(truths.separate),
        grouped(truths.touch),
        grouped(truths.intersect),
        grouped(truths.coplanar)
    )
}

fn plot(figure: Figure) -> Plot {
    // Inside HTML the namespace is known, and the page names no address at all.
    let inline = |svg: String| svg.replace(" xmlns=\"http://www.w3.org/2000/svg\"", "");
    Plot { name: figure.name, caption: figure.caption, wide: inline(figure.wide), narrow: inline(figure.narrow) }
}

fn facts(results: &Results) -> Vec<Fact> {
    let row = results.base();
    let number = |share: f64| significant(100.0 * share);
    let mut facts = vec![
        Fact {
            number: number(row.definite.share),
            unit: "%",
            about: format!("definite answers at {} bits", row.point.width()),
        },
        Fact {
            number: grouped(results.wrong()),
            unit: "",
            about: format!("wrong definite answers at all {} points", results.rows.len()),
        },
        Fact {
            number: significant(row.effective_ns),
            unit: "ns",
            about: format!("effective time a pair, {} axes a clock", row.point.option("axes-per-clock")),
        },
        Fact { number: number(results.floor.share()), unit: "%", about: "that no width decides".to_owned() },
    ];
    if facts[2].about.contains(" 1 axes") {
        facts[2].about = "effective time a pair, one axis a clock".to_owned();
    }
    facts
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
    let mut text = format!("{}: the effective time is least {}", capitalised(&found.series), found.best());
    match found.dearest() {
        None => text.push_str(", and no bit takes the hardware longer: one more pays as long as it decides anything."),
        Some(step) => {
            text.push_str(&format!(
                "; the dearest step is to {} bits, {} ns a pair more",
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
                text.push_str(&format!("; at these shares it pays if such a pair costs more than {}", time(cost)));
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
                format!("{} ns ({units} a clock)", significant(row.effective_ns))
            }
            Some((None, least)) => format!("takes {least}"),
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
    let [low, high] = super::wilson(floor.answers.possibly_incorrect, floor.answers.pairs);
    vec![
        format!(
            "The widest unit there is (32 bits, transform 48, 17 axes, exact ceilings, intersected projections) leaves {} of {} \
             pairs possibly incorrect: {} (95 % bounds {} to {}).",
            grouped(floor.answers.possibly_incorrect),
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
