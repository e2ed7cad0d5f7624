//! Everything the page shows.

use super::Share;
use super::break_even::BreakEven;
use super::causes::Causes;
use super::floor::Floor;
use super::ladder::Rung;
use super::plan::Request;
use super::row::Row;
use super::store::Drawn;
use serde::{Deserialize, Serialize};

/// A rung of the software ladder in nanoseconds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Step {
    /// The rung.
    #[serde(flatten)]
    pub rung: Rung,
    /// Nanoseconds per pair on one core.
    pub ns: f64,
    /// Pairs without a right answer.
    pub open: Share,
}

/// The fastest folding of a width within a budget.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Fold {
    /// Multipliers there are.
    pub budget: u64,
    /// Working width.
    pub width: u32,
    /// Multipliers of one axis per clock, the slowest folding there is.
    pub least: u64,
    /// The point, by its place among the rows; none if nothing fits.
    pub row: Option<usize>,
}

/// Results of a whole campaign.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Results {
    /// What was asked for.
    pub request: Request,
    /// The command that makes it again.
    pub command: String,
    /// Cost of the transfer of a possibly incorrect pair, ns.
    pub transfer_ns: f64,
    /// The pairs.
    pub drawn: Drawn,
    /// The headline, a sentence each.
    pub headline: Vec<String>,
    /// All points, in the order of the plan; the first is the one around which the sweep goes.
    pub rows: Vec<Row>,
    /// Nanoseconds of the yardstick, by which all timings become nanoseconds.
    pub yardstick_ns: f64,
    /// Pairs whose exact answer changes with the rounding that software does before it begins.
    pub changed_by_rounding: u64,
    /// The software ladder.
    pub ladder: Vec<Step>,
    /// Where possibly incorrect answers come from.
    pub causes: Causes,
    /// What no width decides.
    pub floor: Floor,
    /// Widths at the clock given.
    pub at_clock: Option<BreakEven>,
    /// Widths at the fastest clock of each, where more than one clock was swept.
    pub at_fastest: Option<BreakEven>,
    /// Widths in the fastest folding within each budget.
    pub in_budgets: Vec<BreakEven>,
    /// Foldings within budgets.
    pub foldings: Vec<Fold>,
}

impl Results {
    /// The row around which the sweep goes.
    pub fn base(&self) -> &Row {
        &self.rows[0]
    }

    /// The rows that differ from the base in width and in these options with these values, ascending.
    pub fn by_width(&self, with: &[(&str, &str)]) -> Vec<&Row> {
        let names: Vec<&str> = with.iter().map(|w| w.0).chain(["width"]).collect();
        let base = &self.base().point.options;
        let fits = |row: &&Row| {
            row.point.differs_only_in(base, &names) && with.iter().all(|(name, value)| row.point.option(name) == *value)
        };
        let mut rows: Vec<&Row> = self.rows.iter().filter(fits).collect();
        rows.sort_by_key(|row| row.point.width());
        rows
    }

    /// For each width the row that is fastest in hardware, all but width and target clock being as in the base.
    pub fn fastest(&self) -> Vec<&Row> {
        let base = &self.base().point.options;
        let mut rows: Vec<&Row> =
            self.rows.iter().filter(|r| r.point.differs_only_in(base, &["width", "frequency"])).collect();
        rows.sort_by(|x, y| x.point.width().cmp(&y.point.width()).then(x.hardware_ns.total_cmp(&y.hardware_ns)));
        rows.dedup_by_key(|row| row.point.width());
        // A width that was swept at one clock only would look slow.
        let several = |row: &&Row| row.point.option("frequency") != self.base().point.option("frequency");
        rows.retain(several);
        rows
    }

    /// The fastest foldings within a budget, ascending by width.
    pub fn in_budget(&self, budget: u64) -> Vec<&Row> {
        self.foldings
            .iter()
            .filter(|fold| fold.budget == budget)
            .filter_map(|fold| Some(&self.rows[fold.row?]))
            .collect()
    }

    /// The step of the ladder with a name.
    pub fn step(&self, name: &str) -> Option<&Step> {
        self.ladder.iter().find(|step| step.rung.name == name)
    }

    /// Definite answers that are wrong, over all points.
    pub fn wrong(&self) -> u64 {
        self.rows.iter().map(|row| row.point.answers.wrong).sum::<u64>() + self.floor.answers.wrong
    }
}
