//! The candidate pairs of a scene, pose by pose.

use super::tree::{candidates, Tree};
use super::Scene;
use rayon::prelude::*;

/// The trees of a scene's meshes, built once for all poses.
#[derive(Clone, Debug)]
pub struct BroadPhase<'a> {
    scene: &'a Scene,
    a: Tree<'a>,
    b: Tree<'a>,
}

impl<'a> BroadPhase<'a> {
    /// Poses for each thread that are in memory at the same time.
    const POSES_A_THREAD: usize = 4;

    /// Builds the trees.
    pub fn new(scene: &'a Scene) -> Self {
        Self { scene, a: Tree::new(&scene.a), b: Tree::new(&scene.b) }
    }

    /// The pairs (triangle of A, triangle of B) to test in pose number `pose`, in ascending order.
    ///
    /// # Panics
    /// If there is no such pose.
    pub fn pairs(&self, pose: usize) -> Vec<(u32, u32)> {
        let pose = &self.scene.poses[pose];
        candidates(&self.a, &self.b, &pose.rotation, &pose.translation)
    }

    /// Calls `visit` with the number of each pose and its pairs, in the order of the poses, until it fails. The pairs
    /// are found by all threads of the current pool, a batch of poses at a time, so memory does not grow with the
    /// number of poses; what `visit` sees does not depend on the number of threads.
    ///
    /// # Errors
    /// The first error of `visit`.
    pub fn try_for_each<E>(&self, mut visit: impl FnMut(usize, &[(u32, u32)]) -> Result<(), E>) -> Result<(), E> {
        let batch = Self::POSES_A_THREAD * rayon::current_num_threads();
        let poses = self.scene.poses.len();
        for start in (0..poses).step_by(batch) {
            let found: Vec<_> = (start..poses.min(start + batch)).into_par_iter().map(|i| self.pairs(i)).collect();
            for (pose, pairs) in (start..).zip(&found) {
                visit(pose, pairs)?;
            }
        }
        Ok(())
    }
}
