//! Who is asked: the reference model with its host side, or anything else with the same questions.

use super::posed::Posed;
use efsat_geometry::Points;
use efsat_unit::golden::{Golden, Pose, Verdict};
use efsat_unit::host::{Host, SceneHost, loose_pair};
use efsat_unit::params::Params;

/// An answer, and whether the host gave it because the pair was outside the declared ranges.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Answer {
    /// What was answered.
    pub verdict: Verdict,
    /// The unit has not seen the pair.
    pub host_decided: bool,
}

/// Vertex indices of A and of B, in the order in which they are written.
pub type VertexOrder = [[u32; 3]; 2];

/// Answers pairs of triangles.
pub trait Answerer: Sync {
    /// The answer for the pair a0 a1 a2 b0 b1 b2 in one frame.
    fn loose(&self, points: &Points) -> Answer;

    /// The answers for one pair under a pose, its vertices written in several orders.
    fn posed(&self, posed: &Posed, orders: &[VertexOrder]) -> Vec<Answer>;
}

/// The reference model of one parameter set, with the host side before it.
#[derive(Clone, Debug)]
pub struct Model {
    params: Params,
    golden: Golden,
    identity: Pose,
}

impl Model {
    /// The model of a validated parameter set.
    pub fn new(params: &Params) -> Self {
        Self { params: params.clone(), golden: Golden::new(params), identity: Pose::identity(params) }
    }

    fn answer(&self, pose: &Pose, pair: &Host) -> Answer {
        match pair {
            Host::Unit(pair) => Answer { verdict: self.golden.verdict(pose, pair), host_decided: false },
            Host::Decided(verdict) => Answer { verdict: *verdict, host_decided: true },
        }
    }
}

impl Answerer for Model {
    fn loose(&self, points: &Points) -> Answer {
        self.answer(&self.identity, &loose_pair(points, &self.params).expect("cases are finite"))
    }

    fn posed(&self, posed: &Posed, orders: &[VertexOrder]) -> Vec<Answer> {
        let host = SceneHost::new(&posed.a, &posed.b, &self.params).expect("cases are finite");
        let scene = host.pose(&posed.motion.m, &posed.motion.t).expect("cases are finite");
        orders.iter().map(|&[a, b]| self.answer(&scene.pose, &scene.pair(a, b))).collect()
    }
}
