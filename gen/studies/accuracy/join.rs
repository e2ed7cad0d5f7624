//! The results of a campaign, joined from its store.

use super::Share;
use super::break_even::BreakEven;
use super::campaign::Keys;
use super::causes::Causes;
use super::floor::Floor;
use super::headline;
use super::ladder::{Ladder, Rung};
use super::plan::{Plan, Request};
use super::point::{Point, options};
use super::results::{Fold, Results, Step};
use super::row::{Row, is_best};
use super::store::{Drawn, Record, Store};

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
}

/// In what a parameter set differs from the base.
fn short(params: &efsat_unit::params::Params, base: &efsat_unit::params::Params) -> String {
    let differences = params.differences(base).into_iter();
    let words: Vec<String> = differences.map(|(name, value)| format!("{name}={value}")).collect();
    if words.is_empty() { "around which the sweep goes".to_owned() } else { words.join(",") }
}
