//! Where possibly incorrect answers come from: each stage made exact in turn.
//!
//! Of the pairs that the unit leaves undecided, some are so close to contact that only one rounding of many had to be
//! finer, some need several, and some no arithmetic decides (`genuine`). Which stage gets the credit depends on the
//! order in which stages are made exact, so a stage's part is the mean over all 120 orders (L. S. Shapley's value,
//! 1953); the parts and the genuine cases add up to all.

mod model;
mod reason;

pub(super) use model::{Case, Model};
pub use reason::{Reason, Reasons};

use super::pairs::{Asked, Pairs};
use efsat_unit::golden::{Loss, Lossless};
use efsat_unit::params::Params;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// Pairs that are looked at, at most; 32 sets of exact stages each.
const SAMPLE: usize = 1000;

/// One stage.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cause {
    /// The stage.
    pub stage: String,
    /// Pairs that become definite if this stage alone is made exact.
    pub alone_exact: u64,
    /// Pairs that are undecided if all other stages are exact, the genuine cases left out.
    pub alone_rounded: u64,
    /// Its part of all undecided pairs: the mean over all orders in which stages are made exact.
    pub part: f64,
}

/// The causes of a parameter set.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Causes {
    /// Possibly incorrect pairs of the campaign.
    pub undecided: u64,
    /// Those of them that were looked at, evenly spread, without those that the host decides.
    pub examined: u64,
    /// The stages, in the order of the data flow.
    pub stages: Vec<Cause>,
    /// What remains with every stage exact, by reason.
    pub genuine: Reasons,
}

impl Causes {
    /// Examines the pairs at these places, which the unit leaves undecided.
    pub fn examine(pairs: &Pairs, params: &Params, undecided: &[u32]) -> Self {
        let asked = Asked::new(pairs, params);
        let places = Pairs::spread(undecided, SAMPLE);
        let models: Vec<Model> = Lossless::sets().map(|set| Model::new(params, set)).collect();
        let one = |&place: &u32| {
            let case = Case::new(&asked, place as usize)?;
            let definite: Vec<bool> = models.iter().map(|model| model.definite(&case)).collect();
            let axes = models[Lossless::ALL.index()].axes(&case);
            let reason = Reason::of(pairs.relation(place as usize), &axes);
            Some((definite, reason))
        };
        let cases: Vec<(Vec<bool>, Option<Reason>)> = places.par_iter().filter_map(one).collect();
        let mut counts = [0u64; 32];
        let mut genuine = Reasons::default();
        for (definite, reason) in &cases {
            counts.iter_mut().zip(definite).for_each(|(count, definite)| *count += u64::from(*definite));
            if let Some(reason) = reason {
                genuine.add(*reason);
            }
        }
        let examined = cases.len() as u64;
        let open = examined - counts[Lossless::ALL.index()];
        let cause = |stage: Loss| {
            let others = Loss::ALL.into_iter().filter(|other| *other != stage).fold(Lossless::NONE, Lossless::and);
            Cause {
                stage: stage.name().to_owned(),
                alone_exact: counts[Lossless::NONE.and(stage).index()].saturating_sub(counts[0]),
                alone_rounded: (examined - counts[others.index()]).saturating_sub(open),
                part: part(&counts, stage) / examined.max(1) as f64,
            }
        };
        Self { undecided: undecided.len() as u64, examined, stages: Loss::ALL.map(cause).to_vec(), genuine }
    }
}

/// The mean, over all orders, of how many more pairs are definite once a stage is made exact.
fn part(definite: &[u64; 32], stage: Loss) -> f64 {
    let factorial = |n: u32| f64::from((1..=n).product::<u32>());
    let stages = Loss::ALL.len() as u32;
    let without = Lossless::sets().filter(|set| !set.has(stage));
    let terms = without.map(|set| {
        let orders = factorial(set.count()) * factorial(stages - 1 - set.count());
        orders * (definite[set.and(stage).index()] as f64 - definite[set.index()] as f64)
    });
    terms.sum::<f64>() / factorial(stages)
}

#[cfg(test)]
mod tests;
