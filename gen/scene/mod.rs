//! Scenes: two meshes, the poses of one relative to the other, and the pairs of triangles close enough to test.
//!
//! A pose takes a point of mesh B's file to the frame of mesh A's file: `x_A = M * x_B + t`. Its twelve doubles are
//! taken as exact reals by everything that follows; `M` need not be perfectly orthonormal.

mod angle;
mod broad_phase;
mod file;
mod itself;
mod pose;
mod tree;

pub use broad_phase::BroadPhase;
pub use file::{load, SceneError};
pub use pose::{tumble, ScenePose};
pub use tree::{candidates, Tree};

use crate::mesh::Mesh;
use std::sync::Arc;

/// Two meshes and the poses in which they meet.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// What the scene is called in reports.
    pub name: String,
    /// The mesh at rest.
    pub a: Arc<Mesh>,
    /// The mesh that moves.
    pub b: Arc<Mesh>,
    /// The poses of B, in the order in which they are tested.
    pub poses: Vec<ScenePose>,
}

impl Scene {
    /// The paper's benchmark as far as it is known: two identical headlights, one tumbling in front of the other at
    /// several distances. It is defined by `scenes/headlight.toml`.
    pub fn default_scene() -> Self {
        file::parse(include_str!("../../scenes/headlight.toml"), "scenes/headlight.toml".as_ref())
            .expect("the built-in scene is valid")
    }

    /// Builds the trees of both meshes; the result yields the candidate pairs of each pose.
    pub fn broad_phase(&self) -> BroadPhase<'_> {
        BroadPhase::new(self)
    }
}

#[cfg(test)]
mod tests;
