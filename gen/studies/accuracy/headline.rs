//! The headline: sentences computed from the data.

use super::results::Results;
pub use crate::plot::grouped;

/// A share in per cent with three significant digits, for example `1.68 %`.
pub fn percent(share: f64) -> String {
    format!("{} %", significant(100.0 * share))
}

/// Three significant digits, without an exponent.
pub fn significant(x: f64) -> String {
    if x == 0.0 {
        return "0".to_owned();
    }
    let digits = (2 - x.abs().log10().floor() as i32).clamp(0, 8) as usize;
    format!("{x:.digits$}")
}

/// A time with its unit, from nanoseconds.
pub fn time(ns: f64) -> String {
    match ns {
        ns if ns < 1e3 => format!("{} ns", significant(ns)),
        ns if ns < 1e6 => format!("{} µs", significant(ns / 1e3)),
        ns if ns < 1e9 => format!("{} ms", significant(ns / 1e6)),
        ns => format!("{} s", significant(ns / 1e9)),
    }
}

/// With a capital first letter.
pub fn capitalised(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map_or_else(String::new, |first| first.to_uppercase().chain(chars).collect())
}

/// The sentences of the page's head, the most important first.
pub fn sentences(results: &Results) -> Vec<String> {
    let first = [bits(results), dearest(results)].into_iter().flatten().collect::<Vec<_>>().join(" ");
    let mut sentences = if first.is_empty() { vec![] } else { vec![first] };
    sentences.push(definite(results));
    sentences.push(floor(results));
    sentences.extend(fastest(results));
    sentences.extend(determinants(results));
    sentences.push(software(results));
    sentences.extend(budgets(results));
    sentences
}

/// What one more bit does, and where that ends.
fn bits(results: &Results) -> Option<String> {
    let at_clock = results.at_clock.as_ref()?;
    let [first, last] = at_clock.falling;
    if first == last {
        return None;
    }
    let times = match at_clock.ratio {
        ratio if (0.47..0.53).contains(&ratio) => "halves the number of possibly incorrect answers".to_owned(),
        ratio => format!("reduces the possibly incorrect answers to {:.0} %", 100.0 * ratio),
    };
    let widest = at_clock.steps.last().map_or(last, |step| step.to);
    let end = if last == widest { "the greatest width tried" } else { "beyond which hardly any more are decided" };
    Some(format!("From {first} bits on, each additional bit of width {times}; this holds up to {last} bits, {end}."))
}

/// What the dearest bit costs in the budget where it is dearest.
fn dearest(results: &Results) -> Option<String> {
    let steps = results.in_budgets.iter().filter_map(|found| found.dearest().map(|step| (found, step)));
    let (found, step) = steps.max_by(|x, y| x.1.hardware_ns.total_cmp(&y.1.hardware_ns))?;
    let budget = found.series.trim_start_matches("in ").trim_end_matches(" multipliers").parse().ok()?;
    let rows = results.in_budget(budget);
    let before = rows.iter().find(|row| row.point.width() == step.from)?;
    let times = significant((before.hardware_ns + step.hardware_ns) / before.hardware_ns);
    let cost = step.cost_ns.map_or_else(String::new, |cost| {
        let (needed, paid) = (time(cost), time(before.cost_ns));
        if cost > before.cost_ns {
            format!(", which pays only if a possibly incorrect pair costs more than {needed}; measured is {paid}")
        } else {
            format!(", which still pays: a possibly incorrect pair costs {paid}, more than the {needed} that it takes")
        }
    });
    Some(format!(
        "As long as there are enough multipliers, a bit costs no time; with {budget} of them, going to {} bits makes every pair take {times} times as long{cost}.",
        step.to
    ))
}

/// The point around which the sweep goes.
fn definite(results: &Results) -> String {
    let row = results.base();
    let [low, high] = row.possibly_incorrect.bounds;
    let wrong = match results.wrong() {
        0 => format!(
            "of {} definite answers at {} points none is wrong",
            grouped(all_definite(results)),
            results.rows.len()
        ),
        n => format!("{} DEFINITE ANSWERS ARE WRONG", grouped(n)),
    };
    format!(
        "At {} bits {} of the pairs get a definite answer and {} stay possibly incorrect (95 % bounds {} to {}); {wrong}.",
        row.point.width(),
        percent(row.definite.share),
        percent(row.possibly_incorrect.share),
        significant(100.0 * low),
        percent(high),
    )
}

fn all_definite(results: &Results) -> u64 {
    results.rows.iter().map(|row| row.point.answers.verdicts.separate + row.point.answers.verdicts.intersect).sum()
}

/// What no width decides.
fn floor(results: &Results) -> String {
    let (floor, reasons) = (&results.floor, results.floor.reasons);
    let named = [
        (reasons.parallel_edges, "intersect with parallel edges"),
        (reasons.touch, "touch"),
        (reasons.coplanar, "lie in one plane"),
        (reasons.degenerate, "have a segment or a point"),
    ];
    let counts: Vec<String> =
        named.iter().filter(|n| n.0 > 0).map(|(count, what)| format!("{} {what}", grouped(*count))).collect();
    if counts.is_empty() {
        return match floor.answers.verdicts.possibly_incorrect {
            0 => "The widest unit decides every pair.".to_owned(),
            open => format!(
                "The widest unit leaves {} pairs open, all of them because of rounding: no pair needs a retest at every width.",
                grouped(open)
            ),
        };
    }
    let all = if floor.examined < floor.answers.verdicts.possibly_incorrect { " examined" } else { "" };
    format!(
        "No width decides {} of the pairs. Of the {}{all} that the widest unit leaves open, {}.",
        percent(floor.share()),
        grouped(floor.examined),
        counts.join(", ")
    )
}

/// Where the effective time is shortest, at the clock given and at the fastest one.
fn fastest(results: &Results) -> Option<String> {
    let at_clock = results.at_clock.as_ref()?;
    let rows = results.by_width(&[]);
    let row = rows.iter().find(|row| row.point.width() == at_clock.best_width)?;
    let mut text = format!(
        "{}, the effective time per pair is shortest {}: {}, of which retests take {}.",
        capitalised(&at_clock.series),
        at_clock.best(),
        time(at_clock.best_ns),
        percent((row.effective_ns - row.hardware_ns) / row.effective_ns)
    );
    if let Some(fast) = &results.at_fastest {
        let (best, least) = (fast.best(), time(fast.best_ns));
        if fast.span < 0.01 {
            text.push_str(&format!(
                " The fastest clock that the schedule allows is the same at every width; with it the shortest time is {least}, {best}."
            ));
        } else {
            text.push_str(&format!(
                " With the fastest clock of each width it is shortest {best}, {least}: beyond that, the slower clock costs more than the fewer retests save."
            ));
        }
    }
    Some(text)
}

/// The same pairs in software.
fn software(results: &Results) -> String {
    let took = |name: &str| time(results.step(name).map_or(0.0, |step| step.ns));
    let open = |name: &str| results.step(name).map_or(0, |step| step.rung.open());
    format!(
        "In software, one core of this machine: separating axes in binary64 take {} per pair and are wrong for {} pairs; \
         Moeller's test with its published epsilon takes {} and is wrong for {}; the exact retest takes {} ({} in batches), \
         rational arithmetic {}.",
        took("f64"),
        grouped(open("f64")),
        took("f64, epsilon"),
        grouped(open("f64, epsilon")),
        took("retest"),
        took("retest, batch"),
        took("rational"),
    )
}

/// The fastest point of the other method on the device of the base.
fn determinants(results: &Results) -> Option<String> {
    let base = &results.base().point;
    let same = |row: &&super::row::Row| {
        let point = &row.point;
        let alike = ["width", "transform", "transform-width", "device", "frequency"];
        point.method() != base.method() && alike.iter().all(|name| point.option(name) == base.option(name))
    };
    let row = results.rows.iter().filter(same).min_by(|x, y| x.effective_ns.total_cmp(&y.effective_ns))?;
    let clocks = match row.point.hardware.interval {
        1 => "one clock".to_owned(),
        n => format!("{n} clocks"),
    };
    let fits = if row.point.hardware.fits { "" } else { " (more than the device has)" };
    Some(format!(
        "With {} instead of axes, a pair takes {}: {clocks} per pair, {} multipliers{fits}, {} possibly incorrect.",
        row.point.method(),
        time(row.effective_ns),
        row.point.hardware.cells.multipliers,
        percent(row.possibly_incorrect.share)
    ))
}

/// What fits into the first budget.
fn budgets(results: &Results) -> Option<String> {
    let budget = results.foldings.first()?.budget;
    let of_budget: Vec<_> = results.foldings.iter().filter(|fold| fold.budget == budget).collect();
    let fitting: Vec<_> = of_budget.iter().filter_map(|fold| Some((fold.width, &results.rows[fold.row?]))).collect();
    let beyond = of_budget.iter().find(|fold| fold.row.is_none() && fitting.iter().all(|fit| fit.0 < fold.width));
    let Some((width, row)) = fitting.last() else {
        return Some(format!("No width of the sweep fits into {budget} multipliers."));
    };
    let mut text = format!(
        "With {budget} multipliers the most accurate unit has {width} bits: {} per pair, {} possibly incorrect",
        time(row.effective_ns),
        percent(row.possibly_incorrect.share)
    );
    if let Some(fold) = beyond {
        let device = results.base().point.option("device");
        text.push_str(&format!(
            "; {} bits need {} multipliers on an {device}, even at one axis per clock",
            fold.width, fold.least
        ));
    }
    Some(text + ".")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_as_people_write_them() {
        assert_eq!(
            [significant(108.93), significant(1.6769), significant(0.04321), significant(0.0)],
            ["109", "1.68", "0.0432", "0"]
        );
        assert_eq!([time(12.34), time(9280.0), time(3e9)], ["12.3 ns", "9.28 µs", "3.00 s"]);
        assert_eq!(
            (percent(0.016_77), grouped(1_234_567), grouped(12)),
            ("1.68 %".to_owned(), "1,234,567".to_owned(), "12".to_owned())
        );
    }
}
