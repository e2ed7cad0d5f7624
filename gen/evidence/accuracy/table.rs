//! The points as rows of a table: for the page and as CSV.

use super::headline::{grouped, significant};
use super::results::Results;
use super::row::Row;
use std::collections::BTreeSet;

/// A column: what its head says, what it means, and whether a narrow or printed table leaves it out.
pub struct Column {
    pub head: &'static str,
    pub unit: &'static str,
    pub about: &'static str,
    pub minor: bool,
    pub words: bool,
}

/// A cell: what is shown, and what it is sorted by.
pub struct Cell {
    pub text: String,
    pub sort: String,
    pub minor: bool,
    pub words: bool,
}

const fn column(head: &'static str, unit: &'static str, about: &'static str) -> Column {
    Column { head, unit, about, minor: false, words: false }
}

const fn minor(head: &'static str, unit: &'static str, about: &'static str) -> Column {
    Column { head, unit, about, minor: true, words: false }
}

const fn words(head: &'static str, about: &'static str) -> Column {
    Column { head, unit: "", about, minor: false, words: true }
}

/// All columns, in their order.
pub const COLUMNS: [Column; 22] = [
    words("method", "axes or determinants; what follows of options is empty where a method has none"),
    column("width", "bits", "working width of the axis test"),
    minor("transform", "bits", "width of inputs and frame transform"),
    words("upper", "rule of upper bounds"),
    words("projections", "what is done with duplicate projections"),
    column("axes", "", "axis set"),
    words("re-norm.", "pairs re-normalised one by one"),
    column("axes", "/clock", "axis units side by side"),
    column("target", "MHz", "clock that the design was scheduled for"),
    words("device", "device model"),
    column("p.i.", "%", "share of possibly incorrect pairs"),
    minor("95 % bounds", "%", "confidence bounds of that share"),
    minor("separate", "%", "pairs answered separate"),
    minor("intersect", "%", "pairs answered intersect"),
    column("wrong", "", "definite answers that contradict the exact one"),
    column("mult.", "", "hardware multipliers, 18 x 18 bits"),
    column("LUTs", "", "look-up tables, predicted; synthesised where asked for"),
    minor("FFs", "", "flip-flops outside multipliers"),
    column("clock", "MHz", "that the schedule's delays allow"),
    column("interval", "clocks", "clocks between pairs"),
    minor("latency", "clocks", "clocks from a pair to its verdict"),
    column("effective", "ns", "effective time a pair"),
];

/// The cells of a row, one for each column.
pub fn cells(row: &Row) -> Vec<Cell> {
    let (point, hardware) = (&row.point, &row.point.hardware);
    let shown = point.synthesised.unwrap_or(hardware.cells);
    let option = |name: &str| (point.option(name).to_owned(), point.option(name).to_owned());
    let share = |x: f64| (significant(100.0 * x), x.to_string());
    let count = |n: u64| (grouped(n), n.to_string());
    let [low, high] = row.possibly_incorrect.bounds;
    let bounds = (format!("{} – {}", significant(100.0 * low), significant(100.0 * high)), low.to_string());
    let multipliers = format!("{}{}", grouped(shown.multipliers), if hardware.fits { "" } else { " †" });
    let texts = [
        (point.method().to_owned(), point.method().to_owned()),
        option("width"),
        option("transform-width"),
        option("upper"),
        option("projections"),
        option("axes"),
        option("renormalise"),
        option("axes-per-clock"),
        option("frequency"),
        option("device"),
        share(row.possibly_incorrect.share),
        bounds,
        share(row.separate.share),
        share(row.intersect.share),
        count(point.answers.wrong),
        (multipliers, shown.multipliers.to_string()),
        count(shown.luts),
        count(shown.flip_flops),
        (format!("{:.1}", hardware.clock), hardware.clock.to_string()),
        count(hardware.interval as u64),
        count(hardware.latency as u64),
        (format!("{:.1}", row.effective_ns), row.effective_ns.to_string()),
    ];
    let cell = |((text, sort), column): ((String, String), &Column)| Cell {
        text,
        sort,
        minor: column.minor,
        words: column.words,
    };
    texts.into_iter().zip(&COLUMNS).map(cell).collect()
}

/// All points as CSV: every option, every count, every figure.
pub fn csv(results: &Results) -> String {
    // Not every point has every option.
    let names: BTreeSet<&String> = results.rows.iter().flat_map(|row| row.point.options.keys()).collect();
    let figures = "pairs,separate,intersect,possibly_incorrect,possibly_incorrect_share,bound_low,bound_high,\
        undecided_separate,undecided_touch,undecided_intersect,undecided_coplanar,wrong,host_decided,multipliers,luts,\
        flip_flops,fits,synthesised_multipliers,synthesised_luts,synthesised_flip_flops,clock_mhz,interval,latency,\
        million_pairs_per_second,hardware_ns,retest_and_transfer_ns,effective_ns,best_for_time,best_for_multipliers";
    let mut text = names.iter().map(|name| format!("{},", name.replace('-', "_"))).collect::<String>() + figures + "\n";
    for row in &results.rows {
        let (point, a, h) = (&row.point, &row.point.answers, &row.point.hardware);
        names.iter().for_each(|name| text.push_str(&format!("{},", point.option(name))));
        let [low, high] = row.possibly_incorrect.bounds;
        let (u, c) = (a.undecided, h.cells);
        let synthesised =
            point.synthesised.map_or(",,".to_owned(), |c| format!("{},{},{}", c.multipliers, c.luts, c.flip_flops));
        text.push_str(&format!(
            "{},{},{},{},{},{low},{high},{},{},{},{},{},{},{},{},{},{},{synthesised},{},{},{},{},{},{},{},{},{}\n",
            a.pairs,
            a.separate,
            a.intersect,
            a.possibly_incorrect,
            row.possibly_incorrect.share,
            u.separate,
            u.touch,
            u.intersect,
            u.coplanar,
            a.wrong,
            a.host_decided,
            c.multipliers,
            c.luts,
            c.flip_flops,
            h.fits,
            h.clock,
            h.interval,
            h.latency,
            row.million_pairs_per_second,
            row.hardware_ns,
            row.cost_ns,
            row.effective_ns,
            row.best_for_time,
            row.best_for_multipliers,
        ));
    }
    text
}
