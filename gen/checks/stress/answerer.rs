//! Who is asked: the reference model with its host side, or anything else with the same questions.

use super::posed::Posed;
use efsat_geometry::Points;
use efsat_unit::host::{Answer, Reference, SceneHost};

/// Why no number is refused.
const FINITE: &str = "cases are finite";

/// Vertex indices of A and of B, in the order in which they are written.
pub type VertexOrder = [[u32; 3]; 2];

/// Answers pairs of triangles.
pub trait Answerer: Sync {
    /// The answer for the pair a0 a1 a2 b0 b1 b2 in one frame.
    fn loose(&self, points: &Points) -> Answer;

    /// The answers for one pair under a pose, its vertices written in several orders.
    fn posed(&self, posed: &Posed, orders: &[VertexOrder]) -> Vec<Answer>;
}

impl Answerer for Reference {
    fn loose(&self, points: &Points) -> Answer {
        self.loose(points).expect(FINITE)
    }

    fn posed(&self, posed: &Posed, orders: &[VertexOrder]) -> Vec<Answer> {
        let host = SceneHost::new(&posed.a, &posed.b, &self.params).expect(FINITE);
        let scene = host.pose(&posed.motion.m, &posed.motion.t).expect(FINITE);
        orders.iter().map(|&[a, b]| scene.pair(a, b).answer(&self.golden, &scene.pose)).collect()
    }
}
