//! The model with the roundings of some stages left out, for what each of them costs.

use super::axis_test::AxisTest;
use super::interval::{Mantissa, Rounding, Triple, Wide};
use super::verdict::Enclosure;
use super::{Lossless, Numbers};
use crate::dyadic::Dyadic;
use crate::pair::{Outcome, Pair, Pose};
use crate::params::{AxisKind, Params};
use efsat_hardware::number::Interval;

impl Wide for Dyadic {
    type Mantissa = Self;
    type Places = u32;

    fn shifted(self, places: u32) -> Self {
        self.scaled(places.into())
    }

    fn rounded(x: Interval<Self>, to: Rounding) -> Interval<Self> {
        let power = i64::from(to.append) - i64::from(to.drop);
        if to.left_out {
            return Interval::new(x.lo.scaled(power), x.hi.scaled(power));
        }
        let bring = |x: Self| if to.shifted { x.at_last_place().scaled(power) } else { x.scaled(power) };
        let (lo, hi) = (bring(x.lo), bring(x.hi));
        let clamp = |x: Self| x.clamp((-to.clamp).into(), to.clamp.into());
        Interval::new(
            clamp(lo.floor()),
            clamp(match to.upper {
                Some(upper) => hi.upper(upper),
                None => hi.floor(),
            }),
        )
    }
}

impl Mantissa for Dyadic {
    fn free_places(x: Interval<Self>, length: u32, most: u32) -> u32 {
        let longest = x.lo.length().max(x.hi.length()).unwrap_or(0);
        (i64::from(length) - longest).clamp(0, most.into()) as u32
    }
}

/// The axis unit over numbers of any length: without left-out stages it gives the flags of [`Golden`](super::Golden), and
/// without any rounding those of real arithmetic.
#[derive(Clone, Debug)]
pub struct Unrounded {
    model: AxisTest,
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
    pub fn new(params: &Params, exact: Lossless) -> Self {
        Self { model: AxisTest::without(params, exact) }
    }

    /// The numbers of a pair as the unit reads them.
    pub fn read(&self, pose: &Pose, pair: &Pair) -> Numbers<Dyadic> {
        self.model.read(pose, pair)
    }

    /// What every axis shows, in the order of the contract.
    pub fn axes(&self, numbers: &Numbers<Dyadic>) -> Vec<AxisAnswer> {
        let zero = Dyadic::from(0);
        let points = self.points(numbers);
        let mut answers = vec![];
        self.model.axes::<Dyadic>(&points, |_, tested| {
            answers.push(AxisAnswer {
                kind: tested.axis.kind(),
                separated: tested.enclosure.separated() != 0,
                overlapping: tested.enclosure.overlapping() != 0,
                zero: tested.direction.iter().all(|x| x.lo == zero && x.hi == zero),
                flat: flat(tested.enclosure),
            });
            true
        });
        answers
    }

    /// The outcome of a pair.
    pub fn outcome(&self, numbers: &Numbers<Dyadic>) -> Outcome {
        self.model.test::<Dyadic, false>(&self.points(numbers)).outcome()
    }

    /// Sections 3 and 4.
    fn points(&self, numbers: &Numbers<Dyadic>) -> [Triple<Dyadic>; 2] {
        self.model.normaliser.apply(&self.model.frame.apply::<Dyadic>(numbers))
    }
}

/// All six points are certainly projected to one number.
fn flat(e: &Enclosure<Dyadic>) -> bool {
    e.a_min.lo == e.a_min.hi && [&e.a_max, &e.b_min, &e.b_max].into_iter().all(|x| *x == e.a_min)
}
