//! Which bit is the last that pays: what a bit of width costs in hardware time, and what it saves in retests.

use super::row::Row;
use serde::{Deserialize, Serialize};

/// Times that differ by less than this part are even: the clocks of schedules differ by up to 0.7 % for no reason of width.
pub const TOLERANCE: f64 = 0.01;
/// A bit that leaves more than this part of the possibly incorrect pairs has reached the floor.
const FLOOR_RATIO: f64 = 0.85;
/// One that leaves more than this part while most pairs are still open does not count as falling yet.
const FALLING_RATIO: f64 = 0.72;

/// What a step does to the effective time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Effect {
    /// Less by more than the tolerance.
    Pays,
    /// The same within it.
    Even,
    /// More by more than it.
    Costs,
}

/// From one width to the next of a series.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Step {
    /// The lesser width.
    pub from: u32,
    /// The greater one.
    pub to: u32,
    /// By how much the hardware's time a pair grows, ns.
    pub hardware_ns: f64,
    /// By how much the time for retest and transfer falls, ns per pair.
    pub retest_ns: f64,
    /// Multipliers that are added.
    pub multipliers: i64,
    /// What becomes of the effective time.
    pub effect: Effect,
    /// The share of possibly incorrect pairs below which the step does not pay: its hardware time over the part of them
    /// that it decides times the cost of one. Above 1 no share is enough. None where hardware takes no longer.
    pub share: Option<f64>,
    /// The cost of a possibly incorrect pair, retest and transfer, from which the step pays at these shares, ns. None where
    /// hardware takes no longer, or nothing is decided.
    pub cost_ns: Option<f64>,
}

/// A series of widths, all else equal or made to fit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BreakEven {
    /// What is equal, in words.
    pub series: String,
    /// The steps, in ascending order.
    pub steps: Vec<Step>,
    /// The least width whose effective time is within the tolerance of the least.
    pub best_width: u32,
    /// Whether that of every greater width is, too.
    pub lasting: bool,
    /// Its effective time, ns per pair.
    pub best_ns: f64,
    /// What a bit leaves of the possibly incorrect pairs between the widths `falling` (geometric mean).
    pub ratio: f64,
    /// From where the share falls fast down to its floor.
    pub falling: [u32; 2],
    /// By what part the hardware's time differs over the series.
    pub span: f64,
}

impl BreakEven {
    /// The least width that is best, in words: `from 18 bits on`, or `at 18 bits` if greater ones take longer again.
    pub fn best(&self) -> String {
        let width = self.best_width;
        if self.lasting { format!("from {width} bits on") } else { format!("at {width} bits") }
    }

    /// Of rows of one series in ascending order of width; none if there are not two.
    pub fn of(series: impl Into<String>, rows: &[&Row]) -> Option<Self> {
        let steps: Vec<Step> = rows.windows(2).map(|pair| step(pair[0], pair[1])).collect();
        let least = rows.iter().map(|row| row.effective_ns).fold(f64::INFINITY, f64::min);
        let good = |row: &&&Row| row.effective_ns <= least * (1.0 + TOLERANCE);
        let best = rows.iter().find(good).filter(|_| !steps.is_empty())?;
        let (falling, ratio) = falling(rows);
        let hardware = rows.iter().map(|row| row.hardware_ns);
        let span = hardware.clone().fold(0.0, f64::max) / hardware.fold(f64::INFINITY, f64::min) - 1.0;
        let (best_width, best_ns) = (best.point.width(), best.effective_ns);
        let lasting = rows.iter().skip_while(|row| row.point.width() < best_width).all(|row| good(&row));
        Some(Self { series: series.into(), steps, best_width, lasting, best_ns, ratio, falling, span })
    }

    /// The step whose hardware is dearest, if any is beyond the tolerance.
    pub fn dearest(&self) -> Option<&Step> {
        let dear = self.steps.iter().filter(|step| step.share.is_some() || step.cost_ns.is_some());
        dear.max_by(|x, y| x.hardware_ns.total_cmp(&y.hardware_ns))
    }
}

fn step(x: &Row, y: &Row) -> Step {
    let share = |row: &Row| row.point.answers.share();
    let hardware_ns = y.hardware_ns - x.hardware_ns;
    let margin = TOLERANCE * x.effective_ns;
    let decided = share(x) - share(y);
    let slower = hardware_ns > margin;
    let multipliers = |row: &Row| row.point.hardware.cells.multipliers as i64;
    Step {
        from: x.point.width(),
        to: y.point.width(),
        hardware_ns,
        retest_ns: (x.effective_ns - x.hardware_ns) - (y.effective_ns - y.hardware_ns),
        multipliers: multipliers(y) - multipliers(x),
        effect: match y.effective_ns - x.effective_ns {
            less if less < -margin => Effect::Pays,
            more if more > margin => Effect::Costs,
            _ => Effect::Even,
        },
        share: (slower && decided > 0.0 && x.cost_ns > 0.0).then(|| hardware_ns * share(x) / (decided * x.cost_ns)),
        cost_ns: (slower && decided > 0.0).then(|| hardware_ns / decided),
    }
}

/// Between which widths the share falls fast, and what a bit leaves of it there.
fn falling(rows: &[&Row]) -> ([u32; 2], f64) {
    let share = |row: &Row| row.point.answers.share();
    let bits = |x: &Row, y: &Row| f64::from(y.point.width() - x.point.width());
    let a_bit = |x: &Row, y: &Row| if share(x) > 0.0 { (share(y) / share(x)).powf(1.0 / bits(x, y)) } else { 1.0 };
    let falls: Vec<f64> = rows.windows(2).map(|pair| a_bit(pair[0], pair[1])).collect();
    // Where it never falls fast, the whole series counts.
    let fast = falls.iter().position(|ratio| *ratio < FALLING_RATIO);
    let (first, end) = fast.map_or((0, 1.0), |first| (first, FLOOR_RATIO));
    // A share that becomes none has no ratio to speak of.
    let steps = falls[first..].iter().take_while(|ratio| **ratio > 0.0 && **ratio < end).count();
    let (from, to) = (rows[first], rows[first + steps]);
    let ratio = if steps == 0 { 1.0 } else { a_bit(from, to) };
    ([from.point.width(), to.point.width()], ratio)
}
