//! The reference model: what the unit answers, bit for bit, written from the numeric contract and from nothing else.
//!
//! A [`Pair`] of quantised triangles under a [`Pose`] is answered by one of three methods: separating axes in interval
//! arithmetic (`axis_test`, docs/contract.md), determinants with error bounds (`determinants`, docs/determinants.md), or
//! determinants without error of points on a grid (`exact`, docs/exact.md). What is read, the three verdicts and what
//! [`Golden`] offers are the same.
//!
//! [`Unrounded`] is the first method with some of the roundings left out: the arithmetic is generic over its numbers, which
//! are integers for the unit and have further digits there.
//!
//! The host side of section 2 and seeded inputs are in [`host`](crate::host).

mod axes;
mod axis_test;
mod determinants;
mod edge_test;
mod exact;
mod guard;
mod interval;
mod lanes;
mod losses;
mod numbers;
mod projection;
mod reason;
mod renormalise;
#[cfg(test)]
mod tests;
mod trace;
mod transform;
mod unrounded;
mod verdict;

use axis_test::AxisTest;
use determinants::DeterminantTest;
use exact::ExactTest;
use guard::Guard;
// For the study of what each rounding costs.
#[doc(hidden)]
pub use losses::{Loss, Lossless};
// For the study of what each rounding costs.
#[doc(hidden)]
pub use numbers::Numbers;
// For the command line, the viewer and the package for Python.
#[doc(hidden)]
pub use reason::{Margin, Reason};
// For the study of what each rounding costs.
#[doc(hidden)]
pub use unrounded::{AxisAnswer, Unrounded};

use crate::pair::{Outcome, Pair, Pose, Verdict};
use crate::params::{Method, Params};
use efsat_hardware::number::Interval;

/// The reference model of one parameter set.
///
/// Inputs must lie in the declared ranges ([`Params::coordinate_bound`], [`Params::translation_bound`], and
/// [`Params::one`] for matrix entries) unless the unit is guarded ([`Params::guarded`]): then any word may come, and a
/// pair outside is answered so. [`host`](crate::host) sends no such pair.
#[derive(Clone, Debug)]
pub struct Golden {
    guard: Guard,
    test: Test,
}

/// What is behind the guard.
#[derive(Clone, Debug)]
enum Test {
    // The larger by far, and there is one of it.
    Axes(Box<AxisTest>),
    Determinants(DeterminantTest),
    Exact(ExactTest),
}

impl Golden {
    /// The model of a validated parameter set.
    pub fn new(params: &Params) -> Self {
        let test = match params.method {
            Method::Axes => Test::Axes(Box::new(AxisTest::without(params, Lossless::NONE))),
            Method::Determinants => Test::Determinants(DeterminantTest::new(params)),
            Method::Exact => Test::Exact(ExactTest::new(params)),
        };
        Self { guard: Guard::new(params), test }
    }

    /// The verdict of a pair under a pose, with all flags.
    pub fn outcome(&self, pose: &Pose, pair: &Pair) -> Outcome {
        if !self.guard.inside(pose, pair) {
            return Outcome::outside();
        }
        match &self.test {
            Test::Axes(test) => test.outcome::<false>(pose, pair),
            Test::Determinants(test) => test.outcome::<false>(&test.frame(pose), pair),
            Test::Exact(test) => test.outcome(pose, pair),
        }
    }

    /// Whether the first stage of a cascade leaves the pair open, so that the second has to decide it; never of another unit.
    pub fn is_open(&self, pose: &Pose, pair: &Pair) -> bool {
        match &self.test {
            Test::Axes(_) | Test::Determinants(_) => false,
            Test::Exact(test) => self.guard.inside(pose, pair) && test.is_open(pose, pair),
        }
    }

    /// The points of a pair inside the declared ranges as the exact unit sees them, behind the pose: relative to V0, in ulps of
    /// the input format; and whether the unit decides the pair. Of another unit none.
    pub fn snapped(&self, pose: &Pose, pair: &Pair) -> Option<([[i64; 3]; 6], bool)> {
        match &self.test {
            Test::Axes(_) | Test::Determinants(_) => None,
            Test::Exact(test) => Some(test.snapped(pose, pair)),
        }
    }

    /// The verdict alone: stops at the first certain separation.
    pub fn verdict(&self, pose: &Pose, pair: &Pair) -> Verdict {
        if !self.guard.inside(pose, pair) {
            return Verdict::PossiblyIncorrect;
        }
        match &self.test {
            Test::Axes(test) => test.outcome::<true>(pose, pair).verdict,
            Test::Determinants(test) => test.outcome::<true>(&test.frame(pose), pair).verdict,
            Test::Exact(test) => test.outcome(pose, pair).verdict,
        }
    }

    /// Appends the verdicts of many pairs under one pose, in their order: what is common to them is computed once.
    pub fn verdicts(&self, pose: &Pose, pairs: &[Pair], verdicts: &mut Vec<Verdict>) {
        // Runs of pairs inside, between which one pair is outside each.
        for (i, inside) in pairs.split(|pair| !self.guard.inside(pose, pair)).enumerate() {
            if i > 0 {
                verdicts.push(Verdict::PossiblyIncorrect);
            }
            match &self.test {
                Test::Axes(test) => test.verdicts(pose, inside, verdicts),
                Test::Determinants(test) => {
                    let frame = test.frame(pose);
                    verdicts.extend(inside.iter().map(|pair| test.outcome::<true>(&frame, pair).verdict));
                }
                Test::Exact(test) => verdicts.extend(inside.iter().map(|pair| test.outcome(pose, pair).verdict)),
            }
        }
    }

    /// Every inner number by name, in the order of the data flow. Of a pair outside the declared ranges they are those of
    /// the numbers that the guard lets through.
    ///
    /// **Axes**: mantissas of intervals, each in the format that [`Params::formats`] has for it (`transform` in the input
    /// format). Names, with vertices k and l, components x, y and z, and axes `n_a`, `n_b`, `c_00` .. `c_22`, `n_a_a0` ..,
    /// `n_b_b0` ..:
    /// `transform.w{l}_{x}`; `renormalise.v{k}_{x}` and `renormalise.w{l}_{x}` (the coordinates after section 4, with
    /// re-normalisation off too); `edge.a{k}_{x}`, `edge.b{l}_{x}`; `axis.{axis}_{x}`; `projection.{axis}.v{k}` and
    /// `.w{l}`, those that are computed, before duplicates are intersected; `enclosure.{axis}.a_min`, `.a_max`,
    /// `.b_min`, `.b_max`.
    ///
    /// **Determinants**: single numbers, both bounds being equal. Names, with vertices i = 1, 2 of A and l = 0, 1, 2 of B,
    /// and determinants `plane_a{l}`, `plane_b{k}`, `side{k}{l}`:
    /// `difference.v{i}_{x}`, `difference.w{l}_{x}`; `dropped_{x}`, the bits that an axis drops; `level`;
    /// `coordinate.v{i}_{x}`, `coordinate.w{l}_{x}`; `exact.m{l}_{x}`, `exact.n_{x}`, the moments and the normal of A before
    /// rounding, and `moment.m{l}_{x}`, `moment.n_{x}` after it; `shift`, what their rounding drops; `dot.a{l}`,
    /// `dot.d{i}{l}`, `dot.v`; `determinant.{name}`; `bound.{name}` in eighths; `sign.{name}`, -1, 0 or 1; `missed.a{k}`,
    /// `missed.b{l}`, `pierces.a{k}`, `pierces.b{l}`; `boxes_apart`; `verdict`.
    ///
    /// **Exact**: single numbers, with the names of the determinants where they are the same: `difference`, `moment` (not
    /// rounded), `dot`, `determinant`; `component.{t}`, t = 0 to 5, what the multipliers of section 5 give: x_1l and x_2l, or
    /// for triangles on a line each u and the first components of v_2 x w_l; `verdict`. Of a pair that does not fit
    /// they are those of 0 in place of the differences that do not. Of a cascade: `difference`, then the numbers of its first stage with the names
    /// of the determinant unit.
    pub fn trace(&self, pose: &Pose, pair: &Pair) -> Vec<(String, Interval<i128>)> {
        let (pose, pair) = self.guard.held(pose, pair);
        match &self.test {
            Test::Axes(test) => test.trace(&pose, &pair),
            Test::Determinants(test) => {
                let trace = test.trace(&test.frame(&pose), &pair);
                trace.into_iter().map(|(name, x)| (name, Interval::new(x, x))).collect()
            }
            Test::Exact(test) => {
                test.trace(&pose, &pair).into_iter().map(|(name, x)| (name, Interval::new(x, x))).collect()
            }
        }
    }
}
