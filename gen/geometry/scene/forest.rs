//! The trees of a scene.

use super::{Meeting, Scene};
use crate::collide::hierarchy::{Directions, DopTree};
use rayon::prelude::*;

/// The k-DOP trees of a scene's meshes, each built once.
#[derive(Clone, Debug)]
pub struct Forest {
    trees: Vec<DopTree>,
}

impl Forest {
    /// Builds the trees.
    pub fn new(scene: &Scene, directions: Directions) -> Self {
        let (meshes, _) = scene.meshes();
        Self { trees: meshes.par_iter().map(|mesh| DopTree::new(mesh, directions)).collect() }
    }

    /// The trees of the two objects of a meeting.
    ///
    /// # Panics
    /// If the meeting is one of another scene, of more meshes.
    pub fn trees(&self, meeting: &Meeting) -> [&DopTree; 2] {
        meeting.meshes.map(|mesh| &self.trees[mesh])
    }
}
