//! What one parameter set answers on the pairs of a campaign.

use super::pairs::{Asked, Pairs};
use super::timing::{Timing, Yardstick, batch_ns};
use super::wilson;
use efsat_geometry::Points;
use efsat_unit::host::{Relations, Verdicts};
use efsat_unit::pair::Verdict;
use efsat_unit::params::Params;
use serde::{Deserialize, Serialize};

/// Possibly incorrect pairs that the retest is timed on at most, evenly spread.
const TIMED: usize = 1 << 16;

/// A count as a share, with its 95 % bounds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Share {
    /// The share.
    pub share: f64,
    /// Lower and upper bound.
    pub bounds: [f64; 2],
}

impl Share {
    /// `count` of `all`.
    pub fn new(count: u64, all: u64) -> Self {
        Self { share: count as f64 / all.max(1) as f64, bounds: wilson(count, all) }
    }
}

/// The verdicts of a parameter set as counts, and what its possibly incorrect pairs cost.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Answers {
    /// All pairs.
    pub pairs: u64,
    /// Their verdicts.
    #[serde(flatten)]
    pub verdicts: Verdicts,
    /// What the possibly incorrect ones are, exactly.
    pub undecided: Relations,
    /// Definite answers that contradict the exact one.
    pub wrong: u64,
    /// Answered by the host, because they are outside the declared ranges.
    pub host_decided: u64,
    /// The exact retest of the possibly incorrect pairs; none if there are none.
    pub retest: Option<Timing>,
}

impl Answers {
    /// Asks all pairs. Also gives the places of the possibly incorrect ones. Nothing is timed.
    pub(super) fn ask(pairs: &Pairs, params: &Params) -> (Self, Vec<u32>) {
        let answered = Asked::new(pairs, params).all(|answer| answer);
        let mut answers = Self {
            pairs: pairs.len() as u64,
            verdicts: Verdicts::default(),
            undecided: Relations::default(),
            wrong: 0,
            host_decided: 0,
            retest: None,
        };
        let mut undecided = vec![];
        for (place, (answer, relation)) in answered.into_iter().zip(pairs.relations()).enumerate() {
            answers.host_decided += u64::from(answer.host_decided);
            answers.verdicts.count(answer.verdict);
            answers.wrong += u64::from(answer.verdict.is_wrong(relation.class));
            if answer.verdict == Verdict::PossiblyIncorrect {
                answers.undecided.count(*relation);
                undecided.push(place as u32);
            }
        }
        (answers, undecided)
    }

    /// Times the retest of the possibly incorrect pairs, at these places.
    pub(super) fn time(&mut self, pairs: &Pairs, undecided: &[u32], yardstick: &Yardstick) {
        let places = Pairs::spread(undecided, TIMED);
        let points: Vec<Points> = places.iter().map(|&place| pairs.points(place as usize)).collect();
        self.retest = (!points.is_empty()).then(|| yardstick.time(points.len(), || batch_ns(&points)));
    }

    /// The share of possibly incorrect pairs.
    pub fn share(&self) -> f64 {
        self.verdicts.possibly_incorrect as f64 / self.pairs.max(1) as f64
    }
}
