//! What a campaign has to do: the points of its sweep, and the foldings of its budgets.

use super::budget::{self, Folding};
use super::point::{Options, model_options, options};
use efsat_checks::synth::SynthError;
use efsat_unit::params::Params;
use serde::{Deserialize, Serialize};

/// What was asked for, as it is kept beside the results.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Request {
    /// Version of the program.
    pub version: String,
    /// The scene as named on the command line.
    pub scene: String,
    /// What the scene calls itself.
    pub title: String,
    /// Digest of the scene's numbers.
    pub digest: String,
    /// How many pairs: a number, or `all`.
    pub pairs: String,
    /// Seed of the sample.
    pub seed: u64,
    /// The sweep.
    pub sweep: String,
    /// The point around which it goes.
    pub base: Options,
    /// Multipliers for the dual question.
    pub multipliers: Vec<u64>,
    /// Whether cells are synthesised as well.
    pub synth: bool,
}

/// The points of a campaign.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The point around which the sweep goes; the first of all.
    pub base: Params,
    /// All points, each once.
    pub points: Vec<Params>,
    /// The foldings asked for; those that fit are among the points.
    pub foldings: Vec<Folding>,
}

impl Plan {
    /// The points of a sweep around `base`, and for every width in it the fastest folding within each budget.
    ///
    /// # Errors
    /// That a design cannot be made.
    pub fn new(base: &Params, sweep: &[Params], budgets: &[u64]) -> Result<Self, SynthError> {
        let swept = |p: &&Params| Params { width: base.width, ..(*p).clone() } == *base;
        let mut widths: Vec<u32> = sweep.iter().filter(swept).map(|p| p.width).chain([base.width]).collect();
        widths.sort_unstable();
        widths.dedup();
        let foldings = budget::fastest(base, &widths, budgets)?;
        let mut points = vec![base.clone()];
        for params in sweep.iter().chain(foldings.iter().filter_map(|folding| folding.params.as_ref())) {
            if !points.contains(params) {
                points.push(params.clone());
            }
        }
        Ok(Self { base: base.clone(), points, foldings })
    }

    /// The points in groups that give the same answers, in the order of their first points.
    pub fn models(&self) -> Vec<Vec<&Params>> {
        let mut groups: Vec<(Options, Vec<&Params>)> = vec![];
        for params in &self.points {
            let model = model_options(&options(params));
            match groups.iter_mut().find(|(known, _)| *known == model) {
                Some((_, group)) => group.push(params),
                None => groups.push((model, vec![params])),
            }
        }
        groups.into_iter().map(|(_, group)| group).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_there_once_and_grouped_by_answers() {
        let base = Params::paper();
        let wide = Params { width: 20, ..base.clone() };
        let fast = Params { frequency: 200, ..base.clone() };
        let sweep = [wide.clone(), base.clone(), fast.clone(), wide.clone()];
        let plan = Plan::new(&base, &sweep, &[144]).unwrap();
        let folded = Params { axes_per_clock: 2, ..base.clone() };
        assert_eq!(plan.points, [base.clone(), wide, fast, folded]);
        assert_eq!(plan.models().iter().map(Vec::len).collect::<Vec<_>>(), [3, 1]);
        assert_eq!(
            plan.foldings.iter().map(|f| (f.width, f.params.is_some())).collect::<Vec<_>>(),
            [(18, true), (20, false)]
        );
    }
}
