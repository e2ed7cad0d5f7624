//! Which plots there are, and what is in them.

use super::break_even::TOLERANCE;
use super::headline::{grouped, percent, significant, time};
use super::results::Results;
use super::row::{Row, is_best};
use crate::plot::{
    Axis, BLACK, BLUE, Bar, Bars, Chart, Dot, GREEN, GREY, Label, Line, Mark, ORANGE, PURPLE, SKY, Series, Style,
    VERMILION,
};
use efsat_unit::params::Params;

/// A plot.
pub struct Figure {
    /// Name of its file, without extension.
    pub name: &'static str,
    /// The picture.
    pub svg: String,
}

const COLOURS: [&str; 6] = [BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY];
/// The determinant unit in all its defaults.
const DETERMINANTS: [(&str, &str); 6] = [
    ("method", "determinants"),
    ("clocks-per-pair", "1"),
    ("span", "1"),
    ("levels", "6"),
    ("bound", "moments"),
    ("boxes", "on"),
];
const MARKS: [Mark; 4] = [Mark::Circle, Mark::Square, Mark::Diamond, Mark::Triangle];

/// All plots, the main one first.
pub fn all(results: &Results) -> Vec<Figure> {
    let mut figures = vec![frontier(results), time_by_width(results), share_by_width(results)];
    figures.push(share_by_multipliers(results));
    figures.extend(time_by_budget(results));
    figures.push(causes(results));
    figures
}

fn style(colour: &'static str, mark: Mark, line: Line) -> Style {
    Style { colour, mark, line }
}

fn series(name: &str, style: Style, rows: &[&Row], dot: impl Fn(&Row) -> Dot) -> Series {
    Series { name: name.to_owned(), style, dots: rows.iter().map(|row| dot(row)).collect() }
}

/// A point in words.
fn about(results: &Results, row: &Row) -> String {
    let base = &results.base().point.options;
    let differs =
        |(name, value): (&String, &String)| (base.get(name) != Some(value)).then(|| format!("{name} {value}"));
    let what: Vec<String> = row.point.options.iter().filter_map(differs).collect();
    let what = if what.is_empty() { point_name(results) } else { what.join(", ") };
    format!(
        "{what}: {} p.i., {} ns per pair, {} multipliers",
        percent(row.possibly_incorrect.share),
        significant(row.effective_ns),
        grouped(row.point.hardware.cells.multipliers)
    )
}

/// What the point around which the sweep goes is called.
fn point_name(results: &Results) -> String {
    // A guard changes no answer to a pair of a scene.
    let is = |params: Params| results.base().point.differs_only_in(&super::options(&params), &["guard"]);
    if is(Params::paper()) {
        "the paper's point"
    } else if is(Params::default()) {
        "the default"
    } else {
        "the point given"
    }
    .to_owned()
}

fn base_label(results: &Results, x: f64, y: f64) -> Label {
    Label { x, y, text: point_name(results), ring: true }
}

fn percents([low, high]: [f64; 2]) -> Option<[f64; 2]> {
    Some([100.0 * low, 100.0 * high])
}

/// Share of possibly incorrect pairs over the width.
fn share_by_width(results: &Results) -> Figure {
    let dot = |row: &Row| Dot {
        x: row.point.width().into(),
        y: 100.0 * row.possibly_incorrect.share,
        bounds: percents(row.possibly_incorrect.bounds),
        about: about(results, row),
    };
    let sticky = [("upper", "sticky"), ("projections", "intersect")];
    let seventeen = [("upper", "sticky"), ("projections", "intersect"), ("axes", "17")];
    let paper = [("projections", "all"), ("projection-width", "rounded"), ("axis-shift", "0"), ("edge-test", "off")];
    let own = point_name(results);
    let lines: [(&str, &[(&str, &str)]); 6] = [
        (&own, &[]),
        ("determinants", &DETERMINANTS),
        ("the paper's roundings", &paper),
        ("exact ceilings, intersected projections", &sticky),
        ("the same with 17 axes", &seventeen),
        ("without re-normalisation", &[("renormalise", "off")]),
    ];
    let mut all: Vec<Series> = lines
        .iter()
        .enumerate()
        .filter(|(i, (_, with))| {
            *i == 0 || with.iter().any(|(name, value)| results.base().point.option(name) != *value)
        })
        .map(|(i, (name, with))| {
            series(name, style(COLOURS[i], MARKS[i % MARKS.len()], Line::Solid), &results.by_width(with), dot)
        })
        .filter(|series| series.dots.len() > 1 || series.name == own)
        .collect();
    let floor = 100.0 * results.floor.share();
    let widths = all.iter().flat_map(|s| &s.dots).map(|dot| dot.x);
    let (least, most) = widths.fold((f64::MAX, f64::MIN), |(least, most), x| (least.min(x), most.max(x)));
    if floor > 0.0 {
        let ends = [least, most].map(|x| Dot { x, y: floor, bounds: None, about: String::new() });
        let name = format!("no width decides: {}", percent(results.floor.share()));
        all.push(Series { name, style: style(GREY, Mark::None, Line::Dashed), dots: ends.to_vec() });
    }
    let base = results.base();
    let chart = Chart {
        title: "More bits, fewer open answers".to_owned(),
        about: "Share of possibly incorrect pairs over the working width".to_owned(),
        x: Axis::linear("working width, bits"),
        y: Axis::logarithmic("possibly incorrect, share of the pairs (log scale)").with_unit(" %"),
        labels: vec![base_label(results, base.point.width().into(), 100.0 * base.possibly_incorrect.share)],
        series: all,
        none: "none".to_owned(),
    };
    Figure { name: "share-by-width", svg: chart.svg() }
}

/// What the transfer of a possibly incorrect pair may take beyond what is given, in words and in ns.
const TRANSFERS: [(&str, f64); 3] = [("", 0.0), (" + 1 µs", 1e3), (" + 10 µs", 1e4)];

/// Effective time over the width, for several costs of a possibly incorrect pair.
fn time_by_width(results: &Results) -> Figure {
    let (at_clock, fastest) = (results.by_width(&[]), results.fastest());
    let base = results.base();
    let mut all = vec![];
    let mut labels = vec![base_label(results, base.point.width().into(), base.effective_ns)];
    let given = if results.transfer_ns > 0.0 {
        format!("retest and {} of transfer", time(results.transfer_ns))
    } else {
        "retest".to_owned()
    };
    let mut line = |name: String, look: Style, rows: &[&Row], more: f64| {
        let costly = |row: &Row| row.effective_ns + more * row.point.answers.share();
        let dot = |row: &Row| Dot {
            x: row.point.width().into(),
            y: costly(row),
            bounds: None,
            about: format!(
                "{} bits: {} per pair, {} p.i.",
                row.point.width(),
                time(costly(row)),
                percent(row.possibly_incorrect.share)
            ),
        };
        let least = rows.iter().map(|row| costly(row)).fold(f64::INFINITY, f64::min);
        let good = |row: &&&Row| costly(row) <= least * (1.0 + TOLERANCE);
        let mut name = name;
        if let Some(row) = rows.iter().find(good).filter(|_| rows.len() > 1) {
            name.push_str(&format!(": least from {} bits, {}", row.point.width(), time(costly(row))));
            labels.push(Label { x: row.point.width().into(), y: costly(row), text: String::new(), ring: true });
        }
        all.push(series(&name, look, rows, dot));
    };
    for (i, (words, more)) in TRANSFERS.iter().enumerate().rev() {
        let look = style([BLUE, PURPLE, VERMILION][i], MARKS[i], Line::Solid);
        line(format!("{given}{words}"), look, &at_clock, *more);
    }
    let determinants = results.by_width(&DETERMINANTS);
    if determinants.len() > 1 {
        line(
            "determinants, one pair per clock".to_owned(),
            style(BLACK, Mark::Diamond, Line::Solid),
            &determinants,
            0.0,
        );
    }
    if fastest.len() > 1 {
        line("fastest clock".to_owned(), style(SKY, Mark::Triangle, Line::Solid), &fastest, 0.0);
    }
    let widths = || at_clock.iter().map(|row| f64::from(row.point.width()));
    let ends = [widths().fold(f64::MAX, f64::min), widths().fold(f64::MIN, f64::max)];
    for (name, what, colour) in
        [("f64", "binary64 axes in software", ORANGE), ("retest, batch", "exact in software", GREEN)]
    {
        if let Some(step) = results.step(name) {
            let dots = ends.map(|x| Dot { x, y: step.ns, bounds: None, about: what.to_owned() });
            all.push(Series {
                name: what.to_owned(),
                style: style(colour, Mark::None, Line::Dashed),
                dots: dots.to_vec(),
            });
        }
    }
    let chart = Chart {
        title: "What a pair costs at each width".to_owned(),
        about: "Effective time per pair over the working width".to_owned(),
        x: Axis::linear("working width, bits"),
        y: Axis::logarithmic("effective time per pair, ns (log scale)"),
        labels,
        series: all,
        none: String::new(),
    };
    Figure { name: "time-by-width", svg: chart.svg() }
}

/// The rows in groups of axis units, and those of the other method, for colour.
fn by_folding(rows: &[&Row], about: impl Fn(&Row) -> String, x: impl Fn(&Row) -> f64) -> Vec<Series> {
    let units = |row: &Row| row.point.option("axes-per-clock").parse::<u32>().ok();
    let mut foldings: Vec<Option<u32>> = rows.iter().map(|row| units(row)).collect();
    foldings.sort_unstable();
    foldings.dedup();
    let of = |(i, n): (usize, &Option<u32>)| {
        let rows: Vec<&Row> = rows.iter().copied().filter(|row| units(row) == *n).collect();
        let (name, colour) = match n {
            None => ("determinants".to_owned(), BLACK),
            Some(1) => ("1 axis per clock".to_owned(), COLOURS[i % COLOURS.len()]),
            Some(n) => (format!("{n} axes per clock"), COLOURS[i % COLOURS.len()]),
        };
        let look = style(colour, MARKS[i % MARKS.len()], Line::None);
        let dot =
            |row: &Row| Dot { x: x(row), y: 100.0 * row.possibly_incorrect.share, bounds: None, about: about(row) };
        series(&name, look, &rows, dot)
    };
    foldings.iter().enumerate().map(of).collect()
}

/// The line through points that nothing beats.
fn front(mut rows: Vec<&Row>, x: impl Fn(&Row) -> f64) -> Series {
    rows.sort_by(|p, q| x(p).total_cmp(&x(q)));
    rows.dedup_by(|p, q| x(p) == x(q) && p.possibly_incorrect.share == q.possibly_incorrect.share);
    let look = style(GREY, Mark::None, Line::Solid);
    let dot = |x: f64, row: &Row| {
        let y = 100.0 * row.possibly_incorrect.share;
        Dot { x, y, bounds: None, about: String::new() }
    };
    // In steps: between two points nothing is better than the one before.
    let corners = rows.windows(2).flat_map(|pair| [dot(x(pair[0]), pair[0]), dot(x(pair[1]), pair[0])]);
    let dots = corners.chain(rows.last().map(|row| dot(x(row), row))).collect();
    Series { name: "best of all".to_owned(), style: look, dots }
}

/// Share over time, hardware and software, with the names of what nothing beats on the device of the base.
fn frontier(results: &Results) -> Figure {
    let base = &results.base().point;
    // A unit without a stage of the base leaves work to the host.
    let same = |row: &&Row| ["device", "transform"].iter().all(|name| row.point.option(name) == base.option(name));
    let rows: Vec<&Row> = results.rows.iter().filter(same).filter(|row| row.point.hardware.fits).collect();
    let (times, shares): (Vec<f64>, Vec<f64>) =
        rows.iter().map(|row| (row.effective_ns, row.possibly_incorrect.share)).unzip();
    let best: Vec<&Row> = (0..rows.len()).filter(|i| is_best(&times, &shares, *i)).map(|i| rows[i]).collect();
    let mut all = vec![front(best.clone(), |row| row.effective_ns)];
    all.extend(by_folding(&rows, |row| about(results, row), |row| row.effective_ns));
    let step = |step: &super::results::Step| Dot {
        x: step.ns,
        y: 100.0 * step.open.share,
        bounds: None,
        about: format!(
            "{} ({}): {} ns per pair, {} without a right answer",
            step.rung.name,
            step.rung.about,
            significant(step.ns),
            percent(step.open.share)
        ),
    };
    // What takes much longer than every unit would squeeze all others together.
    let slowest = times.iter().copied().fold(0.0, f64::max);
    let shown = |step: &&super::results::Step| step.ns < 5.0 * slowest;
    let software = results.ladder.iter().filter(shown).map(step).collect();
    all.push(Series {
        name: "software, one core".to_owned(),
        style: style(BLACK, Mark::Hollow, Line::None),
        dots: software,
    });
    let name = |row: &Row| {
        let (bits, hardware) = (row.point.width(), &row.point.hardware);
        let clocks = if hardware.interval == 1 { "clock" } else { "clocks" };
        let (interval, multipliers) = (hardware.interval, grouped(hardware.cells.multipliers));
        format!("{} {bits} bits, {interval} {clocks}, {multipliers} multipliers", row.point.method())
    };
    let label = |row: &&Row| Label {
        x: row.effective_ns,
        y: 100.0 * row.possibly_incorrect.share,
        text: name(row),
        ring: false,
    };
    let mut labels: Vec<Label> = best.iter().map(label).collect();
    let default = results.base();
    labels.push(base_label(results, default.effective_ns, 100.0 * default.possibly_incorrect.share));
    let names = ["f64, epsilon", "f64", "f32", "filter, batch", "retest, batch", "retest", "predicates", "rational"];
    let named = names.iter().filter_map(|name| results.step(name)).filter(shown).map(|step| Label {
        x: step.ns,
        y: 100.0 * step.open.share,
        text: step.rung.name.clone(),
        ring: false,
    });
    labels.extend(named);
    let chart = Chart {
        title: format!("Accuracy against time: units that fit the {}, and software", base.option("device")),
        about: "Share of pairs without a right definite answer over the effective time per pair".to_owned(),
        x: Axis::logarithmic("effective time per pair, undecided pairs retested, ns (log scale)"),
        y: Axis::logarithmic("pairs without a right definite answer (log scale)").with_unit(" %"),
        series: all,
        labels,
        none: "none".to_owned(),
    };
    Figure { name: "frontier", svg: chart.svg() }
}

/// Share over multipliers.
fn share_by_multipliers(results: &Results) -> Figure {
    let multipliers = |row: &Row| row.point.hardware.cells.multipliers as f64;
    let rows: Vec<&Row> = results.rows.iter().collect();
    let best = rows.iter().copied().filter(|row| row.best_for_multipliers).collect();
    let mut all = vec![front(best, multipliers)];
    all.extend(by_folding(&rows, |row| about(results, row), multipliers));
    let base = results.base();
    let chart = Chart {
        title: "Accuracy against multipliers".to_owned(),
        about: "Share of possibly incorrect pairs over the number of multipliers".to_owned(),
        x: Axis::logarithmic("multipliers of 18 x 18 bits (log scale)"),
        y: Axis::logarithmic("possibly incorrect, share of the pairs (log scale)").with_unit(" %"),
        series: all,
        labels: vec![base_label(results, multipliers(base), 100.0 * base.possibly_incorrect.share)],
        none: "none".to_owned(),
    };
    Figure { name: "share-by-multipliers", svg: chart.svg() }
}

/// Time over width in fixed budgets.
fn time_by_budget(results: &Results) -> Option<Figure> {
    let mut budgets: Vec<u64> = results.foldings.iter().map(|fold| fold.budget).collect();
    budgets.dedup();
    let of = |(i, budget): (usize, &u64)| {
        let rows = results.in_budget(*budget);
        let look = style(COLOURS[i % COLOURS.len()], MARKS[i % MARKS.len()], Line::Solid);
        series(&format!("{budget} multipliers"), look, &rows, |row| Dot {
            x: row.point.width().into(),
            y: row.effective_ns,
            bounds: None,
            about: about(results, row),
        })
    };
    let all: Vec<Series> = budgets.iter().enumerate().map(of).filter(|series| !series.dots.is_empty()).collect();
    let last = |series: &Series| {
        let dot = series.dots.last().filter(|dot| dot.x != f64::from(results.base().point.width()))?;
        let text = format!("{} bits", dot.x);
        Some(Label { x: dot.x, y: dot.y, text, ring: false })
    };
    if all.is_empty() {
        return None;
    }
    let base = results.base();
    let mut labels = vec![base_label(results, base.point.width().into(), base.effective_ns)];
    labels.retain(|label| all.iter().any(|s| s.dots.iter().any(|dot| (dot.x, dot.y) == (label.x, label.y))));
    labels.extend(all.iter().filter_map(last));
    let chart = Chart {
        title: "The same multipliers, more bits: accuracy costs clocks".to_owned(),
        about: "Effective time per pair over the width, with the fastest folding that fits".to_owned(),
        x: Axis::linear("working width, bits"),
        y: Axis::logarithmic("effective time per pair, ns (log scale)"),
        labels,
        series: all,
        none: String::new(),
    };
    Some(Figure { name: "time-by-budget", svg: chart.svg() })
}

/// Where possibly incorrect answers come from.
fn causes(results: &Results) -> Figure {
    let causes = &results.causes;
    let examined = causes.examined.max(1) as f64;
    let bar = |name: &str, value: f64, colour| Bar { name: name.to_owned(), value, text: percent(value), colour };
    let mut bars: Vec<Bar> = causes.stages.iter().map(|cause| bar(&cause.stage, cause.part.max(0.0), BLUE)).collect();
    let genuine = &causes.genuine;
    let reasons = [
        ("touching", genuine.touch),
        ("coplanar", genuine.coplanar),
        ("parallel edges", genuine.parallel_edges),
        ("segment or point", genuine.degenerate),
    ];
    bars.extend(reasons.iter().map(|(name, count)| bar(name, *count as f64 / examined, VERMILION)));
    let chart = Bars {
        title: "Where possibly incorrect answers come from".to_owned(),
        about: "Parts of the possibly incorrect pairs by the stage that loses accuracy".to_owned(),
        bars,
    };
    Figure { name: "causes", svg: chart.svg() }
}
