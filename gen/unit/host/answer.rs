//! Answers of a unit with its host, beside the exact ones: the one place that says what a wrong answer is.

use super::{Host, loose_pair};
use crate::golden::{Golden, Reason};
use crate::pair::{Pose, Verdict};
use crate::params::Params;
use efsat_geometry::exact::{Exact, Relation};
use efsat_geometry::{NotFinite, Points};
use serde::{Deserialize, Serialize};
use std::ops::AddAssign;

impl Verdict {
    /// Whether this is a definite answer that is not the exact one, which must never be.
    pub fn is_wrong(self, truth: Exact) -> bool {
        match self {
            Self::Separate => truth != Exact::Separate,
            Self::Intersect => truth == Exact::Separate,
            Self::PossiblyIncorrect => false,
        }
    }
}

impl From<Exact> for Verdict {
    /// The definite answer that is right; triangles that touch have a common point.
    fn from(truth: Exact) -> Self {
        match truth {
            Exact::Separate => Self::Separate,
            Exact::Touch | Exact::Intersect => Self::Intersect,
        }
    }
}

/// An answer, and who gave it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Answer {
    /// What was answered.
    pub verdict: Verdict,
    /// The host gave it; the unit has not seen the pair.
    pub host_decided: bool,
}

impl Host {
    /// The answer for a pair under a pose: of the host if it has decided, else of the unit.
    pub fn answer(&self, golden: &Golden, pose: &Pose) -> Answer {
        match self {
            Self::Unit(pair) => Answer { verdict: golden.verdict(pose, pair), host_decided: false },
            Self::Decided(verdict) => Answer { verdict: *verdict, host_decided: true },
        }
    }

    /// Why a pair under a pose is possibly incorrect; none if it is not.
    // For the command line and the viewer.
    #[doc(hidden)]
    pub fn reason(&self, golden: &Golden, pose: &Pose) -> Option<Reason> {
        match self {
            Self::Unit(pair) => golden.reason(pose, pair),
            Self::Decided(verdict) => (*verdict == Verdict::PossiblyIncorrect).then(Reason::outside),
        }
    }
}

/// The reference model of a unit with its host before it: binary64 coordinates in, answers out.
#[derive(Clone, Debug)]
pub struct Reference {
    /// The parameters of the unit.
    pub params: Params,
    /// The unit.
    pub golden: Golden,
    /// The pose under which loose pairs are asked.
    pub identity: Pose,
}

impl Reference {
    /// The reference of a validated parameter set.
    pub fn new(params: &Params) -> Self {
        Self { params: params.clone(), golden: Golden::new(params), identity: Pose::identity(params) }
    }

    /// The answer for the pair a0 a1 a2 b0 b1 b2 in one frame.
    ///
    /// # Errors
    /// A coordinate that is not finite.
    pub fn loose(&self, points: &Points) -> Result<Answer, NotFinite> {
        Ok(loose_pair(points, &self.params)?.answer(&self.golden, &self.identity))
    }
}

/// Verdicts as counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Verdicts {
    /// Answers *separate*.
    pub separate: u64,
    /// Answers *intersect*.
    pub intersect: u64,
    /// Answers *possibly incorrect*.
    pub possibly_incorrect: u64,
}

impl Verdicts {
    /// Counts one more.
    pub fn count(&mut self, verdict: Verdict) {
        *match verdict {
            Verdict::Separate => &mut self.separate,
            Verdict::Intersect => &mut self.intersect,
            Verdict::PossiblyIncorrect => &mut self.possibly_incorrect,
        } += 1;
    }

    /// All of them.
    pub fn total(&self) -> u64 {
        self.separate + self.intersect + self.possibly_incorrect
    }
}

impl AddAssign for Verdicts {
    fn add_assign(&mut self, other: Self) {
        self.separate += other.separate;
        self.intersect += other.intersect;
        self.possibly_incorrect += other.possibly_incorrect;
    }
}

/// Exact answers as counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Truths {
    /// No common point.
    pub separate: u64,
    /// Common points, the insides disjoint.
    pub touch: u64,
    /// The insides meet.
    pub intersect: u64,
}

impl Truths {
    /// Counts one more.
    pub fn count(&mut self, truth: Exact) {
        *match truth {
            Exact::Separate => &mut self.separate,
            Exact::Touch => &mut self.touch,
            Exact::Intersect => &mut self.intersect,
        } += 1;
    }

    /// All of them.
    pub fn total(&self) -> u64 {
        self.separate + self.touch + self.intersect
    }
}

impl AddAssign for Truths {
    fn add_assign(&mut self, other: Self) {
        self.separate += other.separate;
        self.touch += other.touch;
        self.intersect += other.intersect;
    }
}

/// Exact answers as counts, and how many of the pairs are in one plane.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Relations {
    /// By exact answer.
    #[serde(flatten)]
    pub truths: Truths,
    /// Pairs of these in one plane.
    pub coplanar: u64,
}

impl Relations {
    /// Counts one more.
    pub fn count(&mut self, relation: Relation) {
        self.truths.count(relation.class);
        self.coplanar += u64::from(relation.coplanar);
    }
}

/// Verdicts that were compared with the exact answers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Judged {
    /// By verdict.
    #[serde(flatten)]
    pub verdicts: Verdicts,
    /// Definite answers that are not the exact one.
    pub wrong: u64,
}

impl Judged {
    /// Counts one more, and says whether it is wrong.
    pub fn count(&mut self, verdict: Verdict, truth: Exact) -> bool {
        self.verdicts.count(verdict);
        self.wrong += u64::from(verdict.is_wrong(truth));
        verdict.is_wrong(truth)
    }
}

impl AddAssign for Judged {
    fn add_assign(&mut self, other: Self) {
        self.verdicts += other.verdicts;
        self.wrong += other.wrong;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_contradictions_are_wrong() {
        let found = [Verdict::Separate, Verdict::Intersect, Verdict::PossiblyIncorrect]
            .map(|verdict| [Exact::Separate, Exact::Touch, Exact::Intersect].map(|truth| verdict.is_wrong(truth)));
        assert_eq!(found, [[false, true, true], [true, false, false], [false; 3]]);
        let mut judged = Judged::default();
        assert!(judged.count(Verdict::Separate, Exact::Touch) && !judged.count(Verdict::Intersect, Exact::Touch));
        assert_eq!((judged.wrong, judged.verdicts.total()), (1, 2));
    }
}
