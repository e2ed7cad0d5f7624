//! The headline: sentences computed from the data.

use super::results::{Results, Row};

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

/// A whole number with commas.
pub fn grouped(n: u64) -> String {
    let digits = n.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i) % 3 == 0 {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// The sentences of the page's head, the most important first.
pub fn sentences(results: &Results) -> Vec<String> {
    let mut sentences = vec![];
    sentences.extend(bits(results));
    sentences.push(definite(results));
    sentences.extend(fastest(results));
    sentences.push(software(results));
    sentences.extend(budgets(results));
    sentences
}

/// What one more bit does, and where that ends.
fn bits(results: &Results) -> Option<String> {
    let at_clock = results.break_even.first()?;
    let [first, last] = at_clock.falling;
    if first == last {
        return None;
    }
    let floor = results.floor.share();
    let times = if (0.47..0.53).contains(&at_clock.ratio) {
        "halves the possibly incorrect answers".to_owned()
    } else {
        format!("leaves {} of the possibly incorrect answers", percent(at_clock.ratio))
    };
    let end = if last == at_clock.steps.last().map_or(last, |step| step.to) {
        format!("up to {last} bits, the widest tried")
    } else {
        format!("until {last} bits")
    };
    let beyond = if floor > 0.0 {
        format!("{} of the pairs stay open at any width", percent(floor))
    } else {
        "no pair of these stays open at every width".to_owned()
    };
    Some(format!("One more bit of width {times} {end}; {beyond}."))
}

/// The point around which the sweep goes.
fn definite(results: &Results) -> String {
    let row = results.base();
    let [low, high] = row.possibly_incorrect.bounds;
    let wrong = match results.wrong() {
        0 => format!("of {} definite answers at {} points none is wrong", grouped(all_definite(results)), results.rows.len()),
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
    results.rows.iter().map(|row| row.point.answers.separate + row.point.answers.intersect).sum()
}

/// Where the effective time is least, at the clock given and at the fastest one.
fn fastest(results: &Results) -> Option<String> {
    let at_clock = results.break_even.first()?;
    let retest = |width: u32, rows: &[&Row]| {
        let row = rows.iter().find(|row| row.point.width() == width)?;
        Some(percent((row.effective_ns - row.hardware_ns) / row.effective_ns))
    };
    let share = retest(at_clock.best_width, &results.by_width(&[]))?;
    let mut text = format!(
        "With the clock held {}, width costs multipliers and no time: the effective time a pair falls to {} ns at {} bits, \
         {share} of it for retests.",
        at_clock.series,
        significant(at_clock.best_ns),
        at_clock.best_width
    );
    if at_clock.bit_ns > 0.05 {
        text = format!(
            "{} the effective time a pair is least at {} bits, {} ns, {share} of it for retests.",
            capitalised(&at_clock.series),
            at_clock.best_width,
            significant(at_clock.best_ns)
        );
    }
    if let Some(fast) = results.break_even.get(1) {
        text.push_str(&format!(
            " As fast as each width will clock it is least at {} bits, {} ns: beyond, the slower clock costs more than the \
             retest saves",
            fast.best_width,
            significant(fast.best_ns)
        ));
        match fast.share {
            Some(share) => text.push_str(&format!(
                "; on average one more bit stops paying where fewer than {} of the pairs are possibly incorrect.",
                percent(share)
            )),
            None => text.push('.'),
        }
    }
    Some(text)
}

fn capitalised(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map_or_else(String::new, |first| first.to_uppercase().chain(chars).collect())
}

/// The same pairs in software.
fn software(results: &Results) -> String {
    let time = |name: &str| results.step(name).map_or(0.0, |step| step.ns);
    let open = |name: &str| results.step(name).map_or(0, |step| step.rung.open());
    format!(
        "In software, one core of this machine: separating axes in binary64 take {} ns a pair and are wrong in {} pairs, \
         with the published epsilon {} ns and {}; the exact retest takes {} ns ({} in batches), rational arithmetic {} ns.",
        significant(time("f64")),
        grouped(open("f64")),
        significant(time("f64, epsilon")),
        grouped(open("f64, epsilon")),
        significant(time("retest")),
        significant(time("retest, batch")),
        significant(time("rational")),
    )
}

/// What fits into the first budget.
fn budgets(results: &Results) -> Option<String> {
    let budget = results.foldings.first()?.budget;
    let of_budget: Vec<_> = results.foldings.iter().filter(|fold| fold.budget == budget).collect();
    let fitting: Vec<_> = of_budget.iter().filter_map(|fold| Some((fold.width, &results.rows[fold.row?]))).collect();
    let beyond = of_budget.iter().find(|fold| fold.row.is_none() && fitting.iter().all(|fit| fit.0 < fold.width));
    let Some((width, row)) = fitting.last() else {
        return Some(format!("No width of the sweep fits in {budget} multipliers."));
    };
    let mut text = format!(
        "In {budget} multipliers the most accurate unit has {width} bits: {} ns a pair, {} possibly incorrect",
        significant(row.effective_ns),
        percent(row.possibly_incorrect.share)
    );
    if let Some(fold) = beyond {
        let device = results.base().point.option("device");
        text.push_str(&format!("; {} bits take {} multipliers of an {device} even at one axis a clock", fold.width, fold.least));
    }
    Some(text + ".")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_as_people_write_them() {
        assert_eq!([significant(108.93), significant(1.6769), significant(0.04321), significant(0.0)], ["109", "1.68", "0.0432", "0"]);
        assert_eq!((percent(0.016_77), grouped(1_234_567), grouped(12)), ("1.68 %".to_owned(), "1,234,567".to_owned(), "12".to_owned()));
    }
}
