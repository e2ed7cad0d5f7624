//! Everything the page shows, joined from the results of a campaign and reckoned from them.

use super::break_even::BreakEven;
use super::campaign::Keys;
use super::causes::Causes;
use super::floor::Floor;
use super::headline;
use super::ladder::{Ladder, Rung};
use super::plan::{Plan, Request};
use super::point::{options, Point};
use super::store::{Drawn, Record, Store};
use super::{Answers, Share};
use serde::Serialize;

/// A result that is not there yet.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{missing} of {all} results are missing, the first is {first}")]
pub struct Missing {
    /// How many.
    pub missing: usize,
    /// Of how many.
    pub all: usize,
    /// One of them, in words.
    pub first: String,
}

/// A point with what follows from it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// The point.
    #[serde(flatten)]
    pub point: Point,
    /// Whether it is the one around which the sweep goes.
    pub base: bool,
    /// Definite answers.
    pub definite: Share,
    /// Answers "separate".
    pub separate: Share,
    /// Answers "intersect".
    pub intersect: Share,
    /// Answers "possibly incorrect".
    pub possibly_incorrect: Share,
    /// Million pairs a second at full speed, retests left out.
    pub million_pairs_per_second: f64,
    /// The hardware's time a pair, ns.
    pub hardware_ns: f64,
    /// What a possibly incorrect pair costs beyond that: exact retest and transfer, ns.
    pub cost_ns: f64,
    /// The effective time a pair: hardware time + share of possibly incorrect pairs x their cost, ns.
    pub effective_ns: f64,
    /// No other point has both fewer possibly incorrect pairs and less effective time.
    pub best_for_time: bool,
    /// The same for multipliers.
    pub best_for_multipliers: bool,
}

/// A rung of the software ladder in nanoseconds.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Step {
    /// The rung.
    #[serde(flatten)]
    pub rung: Rung,
    /// Nanoseconds a pair on one core.
    pub ns: f64,
    /// Pairs without a right answer.
    pub open: Share,
}

/// The fastest folding of a width within a budget.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Fold {
    /// Multipliers there are.
    pub budget: u64,
    /// Working width.
    pub width: u32,
    /// Multipliers of one axis a clock, the slowest folding there is.
    pub least: u64,
    /// The point, by its place among the rows; none if nothing fits.
    pub row: Option<usize>,
}

/// Results of a whole campaign.
#[derive(Clone, Debug, Serialize)]
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
    /// Joins the results of a campaign.
    ///
    /// # Errors
    /// That results are missing.
    pub fn join(
        request: &Request,
        plan: &Plan,
        store: &Store,
        transfer_ns: f64,
        command: String,
    ) -> Result<Self, Missing> {
        let keys = Keys::new(request);
        let mut absent: Vec<String> = vec![];
        let mut note = |what: &str| absent.push(what.to_owned());
        let drawn = match store.get(&keys.drawn()) {
            Some(Record::Drawn(drawn)) => Some(drawn.clone()),
            _ => None,
        };
        let ladder = match store.get(&keys.ladder()) {
            Some(Record::Ladder(ladder)) => Some(ladder.clone()),
            _ => None,
        };
        let causes = match store.get(&keys.causes()) {
            Some(Record::Causes(causes)) => Some(causes.clone()),
            _ => None,
        };
        let floor = match store.get(&keys.floor()) {
            Some(Record::Floor(floor)) => Some(floor.as_ref().clone()),
            _ => None,
        };
        let parts = [("ladder", ladder.is_some()), ("causes", causes.is_some()), ("floor", floor.is_some())];
        parts.iter().filter(|part| !part.1).for_each(|part| note(&format!("the {}", part.0)));
        let mut points = vec![];
        for params in &plan.points {
            let Some(Record::Point(point)) = store.get(&keys.point(params)) else {
                note(&format!("the point {}", short(params, &plan.base)));
                continue;
            };
            let mut point = point.as_ref().clone();
            if request.synth {
                match store.get(&keys.synthesis(params)) {
                    Some(Record::Synthesis(cells)) => point.synthesised = Some(*cells),
                    _ => note(&format!("the synthesis of {}", short(params, &plan.base))),
                }
            }
            points.push(point);
        }
        let (Some(drawn), Some(ladder), Some(causes), Some(floor), true) =
            (drawn, ladder, causes, floor, absent.is_empty())
        else {
            let all = 3 + plan.points.len() * if request.synth { 2 } else { 1 };
            let first = absent.first().cloned().unwrap_or_else(|| "the pairs".to_owned());
            return Err(Missing { missing: absent.len().max(1), all, first });
        };
        Ok(Self::reckon(request, plan, points, transfer_ns, command, (drawn, ladder, causes, floor)))
    }

    fn reckon(
        request: &Request,
        plan: &Plan,
        points: Vec<Point>,
        transfer_ns: f64,
        command: String,
        (drawn, ladder, causes, floor): (Drawn, Ladder, Causes, Floor),
    ) -> Self {
        let base = options(&plan.base);
        let mut rows: Vec<Row> =
            points.into_iter().map(|point| Row::new(point, &base, ladder.yardstick_ns, transfer_ns)).collect();
        let shares: Vec<f64> = rows.iter().map(|row| row.point.answers.share()).collect();
        let times: Vec<f64> = rows.iter().map(|row| row.effective_ns).collect();
        let multipliers: Vec<f64> = rows.iter().map(|row| row.point.hardware.cells.multipliers as f64).collect();
        for (i, row) in rows.iter_mut().enumerate() {
            row.best_for_time = is_best(&times, &shares, i);
            row.best_for_multipliers = is_best(&multipliers, &shares, i);
        }
        let of_folding = |folding: &super::budget::Folding| Fold {
            budget: folding.budget,
            width: folding.width,
            least: folding.least,
            row: folding.params.as_ref().and_then(|params| plan.points.iter().position(|p| p == params)),
        };
        let step = |rung: &Rung| Step {
            rung: rung.clone(),
            ns: rung.timing.yardsticks * ladder.yardstick_ns,
            open: Share::new(rung.open(), drawn.pairs),
        };
        let mut results = Self {
            request: request.clone(),
            command,
            transfer_ns,
            headline: vec![],
            at_clock: None,
            at_fastest: None,
            in_budgets: vec![],
            foldings: plan.foldings.iter().map(of_folding).collect(),
            ladder: ladder.rungs.iter().map(step).collect(),
            yardstick_ns: ladder.yardstick_ns,
            changed_by_rounding: ladder.changed_by_rounding,
            drawn,
            rows,
            causes,
            floor,
        };
        let clock = format!("at {} MHz", results.base().point.option("frequency"));
        results.at_clock = BreakEven::of(clock, &results.by_width(&[]));
        results.at_fastest = BreakEven::of("at the fastest clock", &results.fastest());
        let in_budget = |&budget: &u64| BreakEven::of(format!("in {budget} multipliers"), &results.in_budget(budget));
        results.in_budgets = request.multipliers.iter().filter_map(in_budget).collect();
        results.headline = headline::sentences(&results);
        results
    }

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

impl Row {
    fn new(point: Point, base: &super::Options, yardstick_ns: f64, transfer_ns: f64) -> Self {
        let Answers { pairs, separate, intersect, possibly_incorrect, retest, .. } = point.answers;
        let hardware_ns = point.hardware.ns();
        let cost_ns = retest.map_or(0.0, |timing| timing.yardsticks * yardstick_ns + transfer_ns);
        Self {
            base: point.options == *base,
            definite: Share::new(separate + intersect, pairs),
            separate: Share::new(separate, pairs),
            intersect: Share::new(intersect, pairs),
            possibly_incorrect: Share::new(possibly_incorrect, pairs),
            million_pairs_per_second: 1000.0 / hardware_ns,
            hardware_ns,
            cost_ns,
            effective_ns: hardware_ns + point.answers.share() * cost_ns,
            best_for_time: false,
            best_for_multipliers: false,
            point,
        }
    }
}

/// Whether no other point is at least as good in both and better in one.
fn is_best(x: &[f64], y: &[f64], i: usize) -> bool {
    (0..x.len()).all(|j| !(x[j] <= x[i] && y[j] <= y[i] && (x[j] < x[i] || y[j] < y[i])))
}

/// In what a parameter set differs from the base.
fn short(params: &crate::params::Params, base: &crate::params::Params) -> String {
    let differences = params.options().into_iter().zip(base.options()).filter(|(x, y)| x != y);
    let words: Vec<String> = differences.map(|((name, value), _)| format!("{name}={value}")).collect();
    if words.is_empty() {
        "around which the sweep goes".to_owned()
    } else {
        words.join(",")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_best_are_those_that_nothing_beats() {
        let (x, y) = ([1.0, 2.0, 2.0, 3.0, 3.0], [5.0, 4.0, 4.0, 4.0, 1.0]);
        let best: Vec<bool> = (0..5).map(|i| is_best(&x, &y, i)).collect();
        assert_eq!(best, [true, true, true, false, true]);
    }
}
