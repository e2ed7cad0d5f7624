//! Stub.
use super::{Outcome, Pair, Pose};
use crate::params::Params;
#[derive(Clone, Debug)]
pub(super) struct ExactTest;
impl ExactTest {
    pub fn new(_: &Params) -> Self { Self }
    pub fn outcome(&self, _: &Pose, _: &Pair) -> Outcome { Outcome::outside() }
    pub fn trace(&self, _: &Pose, _: &Pair) -> Vec<(String, i128)> { vec![] }
}
