//! A pair that is looked at, with any set of stages exact.

use crate::accuracy::pairs::Asked;
use efsat_unit::dyadic::Dyadic;
use efsat_unit::golden::{AxisAnswer, Loss, Lossless, Numbers, Unrounded};
use efsat_unit::host::Host;
use efsat_unit::pair::{Pair, Pose, Verdict};
use efsat_unit::params::Params;
use std::borrow::Cow;

/// The reference model with some stages exact.
pub struct Model {
    exact: Lossless,
    rest: Unrounded,
}

/// A pair with its pose, as given and as quantised.
pub struct Case {
    given: Numbers<Dyadic>,
    read: (Pose, Pair),
}

impl Model {
    /// The model of a parameter set with these stages exact.
    pub fn new(params: &Params, exact: Lossless) -> Self {
        Self { exact, rest: Unrounded::new(params, exact) }
    }

    /// What every axis shows.
    pub fn axes(&self, case: &Case) -> Vec<AxisAnswer> {
        self.rest.axes(&self.numbers(case))
    }

    /// Whether the pair gets a definite answer.
    pub fn definite(&self, case: &Case) -> bool {
        self.rest.outcome(&self.numbers(case)).verdict != Verdict::PossiblyIncorrect
    }

    fn numbers<'a>(&self, case: &'a Case) -> Cow<'a, Numbers<Dyadic>> {
        let (pose, pair) = &case.read;
        match self.exact.has(Loss::Input) {
            true => Cow::Borrowed(&case.given),
            false => Cow::Owned(self.rest.read(pose, pair)),
        }
    }
}

impl Case {
    /// The pair at a place; none if the host decides it.
    pub fn new(asked: &Asked, place: usize) -> Option<Self> {
        let (pose, Host::Unit(pair)) = asked.inputs(place) else { return None };
        Some(Self { given: asked.numbers(place), read: (pose, pair) })
    }
}
