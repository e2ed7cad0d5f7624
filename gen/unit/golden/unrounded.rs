//! The model with the roundings of some stages left out, for what each of them costs.

use super::{Exact, Golden, Numbers, Outcome, Pair, Pose, Tested};
use crate::dyadic::Dyadic;
use crate::params::{AxisKind, Params};

/// The reference model over numbers of any length: without left-out stages it gives the flags of [`Golden`], and
/// without any rounding those of real arithmetic.
#[derive(Clone, Debug)]
pub struct Unrounded {
    model: Golden,
}

/// What one axis shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AxisAnswer {
    /// Its kind.
    pub kind: AxisKind,
    /// The images are certainly disjoint.
    pub separated: bool,
    /// They certainly overlap.
    pub overlapping: bool,
    /// The axis is certainly zero.
    pub zero: bool,
    /// All six points are certainly projected to one number.
    pub flat: bool,
}

impl Unrounded {
    /// The model without the roundings of these stages; that of the input is the caller's, who chooses the numbers.
    pub fn new(params: &Params, exact: Exact) -> Self {
        Self { model: Golden::without(params, exact) }
    }

    /// The numbers of a pair as the unit reads them.
    pub fn read(&self, pose: &Pose, pair: &Pair) -> Numbers<Dyadic> {
        self.model.read(pose, pair)
    }

    /// What every axis shows, in the order of the contract.
    pub fn axes(&self, numbers: &Numbers<Dyadic>) -> Vec<AxisAnswer> {
        let zero = Dyadic::from(0);
        let points = self.model.points::<Dyadic>(numbers);
        let answer = |tested: Tested<Dyadic>| AxisAnswer {
            kind: tested.axis.kind(),
            separated: tested.enclosure.separated(),
            overlapping: tested.enclosure.overlapping(),
            zero: tested.direction.iter().all(|x| x.lo == zero && x.hi == zero),
            flat: tested.enclosure.flat(),
        };
        self.model.axes::<Dyadic>(&points).map(answer).collect()
    }

    /// The outcome of a pair.
    pub fn outcome(&self, numbers: &Numbers<Dyadic>) -> Outcome {
        self.model.test::<Dyadic, false>(&self.model.points::<Dyadic>(numbers))
    }
}
