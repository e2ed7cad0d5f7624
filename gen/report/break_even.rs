//! Which bit is the last that pays: what a bit of width costs in hardware time, and what it saves in retests.

use super::results::Row;
use serde::Serialize;

/// Shares that fall to more than this part of the one before have reached the floor.
const FLOOR_RATIO: f64 = 0.85;

/// From one width to the next of a series.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Step {
    /// The lesser width.
    pub from: u32,
    /// The greater one.
    pub to: u32,
    /// By how much the hardware's time a pair grows, ns.
    pub hardware_ns: f64,
    /// By how much the retest's time a pair falls, transfer included, ns.
    pub retest_ns: f64,
    /// Multipliers that are added.
    pub multipliers: i64,
    /// Whether the effective time falls.
    pub pays: bool,
}

/// A series of widths, all else equal.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BreakEven {
    /// What is equal, in words.
    pub series: String,
    /// The steps, in ascending order.
    pub steps: Vec<Step>,
    /// The width of least effective time.
    pub best_width: u32,
    /// That time, ns a pair.
    pub best_ns: f64,
    /// What a bit costs in hardware time on average over the series, ns a pair (least squares).
    pub bit_ns: f64,
    /// What a bit leaves of the possibly incorrect pairs, on average above the floor.
    pub ratio: f64,
    /// The widths between which that holds.
    pub falling: [u32; 2],
    /// The share of possibly incorrect pairs below which one more bit costs more than it saves: a bit's cost over
    /// (1 - ratio) times the cost of a possibly incorrect pair. None where bits cost no time.
    pub share: Option<f64>,
}

impl BreakEven {
    /// Of rows of one series in ascending order of width; none if there are not two.
    pub fn of(series: impl Into<String>, rows: &[&Row]) -> Option<Self> {
        let step = |pair: &[&Row]| {
            let [x, y] = [pair[0], pair[1]];
            let hardware_ns = y.hardware_ns - x.hardware_ns;
            let retest_ns = (x.effective_ns - x.hardware_ns) - (y.effective_ns - y.hardware_ns);
            let multipliers = y.point.hardware.cells.multipliers as i64 - x.point.hardware.cells.multipliers as i64;
            let pays = y.effective_ns < x.effective_ns;
            Step { from: x.point.width(), to: y.point.width(), hardware_ns, retest_ns, multipliers, pays }
        };
        let steps: Vec<Step> = rows.windows(2).map(step).collect();
        let best = rows.iter().min_by(|x, y| x.effective_ns.total_cmp(&y.effective_ns)).filter(|_| !steps.is_empty())?;
        let (falling, ratio) = falling(rows);
        let bit_ns = slope(rows);
        let cost = best.cost_ns.max(rows[0].cost_ns);
        let share = (bit_ns > 0.0 && ratio < 1.0 && cost > 0.0).then(|| (bit_ns / ((1.0 - ratio) * cost)).min(1.0));
        let (best_width, best_ns) = (best.point.width(), best.effective_ns);
        Some(Self { series: series.into(), steps, best_width, best_ns, bit_ns, ratio, falling, share })
    }
}

/// From the first width on as far as the share falls, and what a bit leaves of it there (geometric mean).
fn falling(rows: &[&Row]) -> ([u32; 2], f64) {
    let share = |row: &Row| row.point.answers.share();
    let a_bit = |x: &Row, y: &Row| (share(y) / share(x)).powf(1.0 / f64::from(y.point.width() - x.point.width()));
    let first = rows[0];
    let steps = rows.windows(2).take_while(|w| share(w[1]) > 0.0 && a_bit(w[0], w[1]) < FLOOR_RATIO).count();
    let last = rows[steps];
    let ratio = if steps == 0 { 1.0 } else { a_bit(first, last) };
    ([first.point.width(), last.point.width()], ratio)
}

/// The least-squares slope of the hardware's time over the width.
fn slope(rows: &[&Row]) -> f64 {
    let n = rows.len() as f64;
    let point = |row: &&Row| (f64::from(row.point.width()), row.hardware_ns);
    let (sum_x, sum_y) = rows.iter().map(point).fold((0.0, 0.0), |s, p| (s.0 + p.0, s.1 + p.1));
    let (x, y) = (sum_x / n, sum_y / n);
    let (xy, xx) = rows.iter().map(point).fold((0.0, 0.0), |s, p| (s.0 + (p.0 - x) * (p.1 - y), s.1 + (p.0 - x).powi(2)));
    if xx > 0.0 {
        xy / xx
    } else {
        0.0
    }
}
