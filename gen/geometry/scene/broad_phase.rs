//! The meetings of a scene frame by frame, and their candidate pairs.

use super::meetings::Meetings;
use super::tree::{Tree, candidates};
use super::{Pose, Scene};
use crate::mesh::Mesh;
use rayon::prelude::*;

/// Two objects that may touch in a frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Meeting {
    /// The number of the frame.
    pub frame: usize,
    /// The object in whose frame they meet.
    pub a: usize,
    /// The other one, of a higher number.
    pub b: usize,
    /// The pose of B as seen from A: its twelve doubles are the truth.
    pub pose: Pose,
}

/// The trees of a scene's meshes, built once for all frames.
#[derive(Clone, Debug)]
pub struct BroadPhase<'a> {
    scene: &'a Scene,
    meetings: Meetings<'a>,
    trees: Vec<Tree<'a>>,
    mesh_of: Vec<usize>,
}

impl<'a> BroadPhase<'a> {
    /// Frames for each thread that are in memory at the same time.
    const FRAMES_A_THREAD: usize = 4;

    /// Builds the trees.
    pub fn new(scene: &'a Scene) -> Self {
        let (meshes, mesh_of) = scene.meshes();
        let trees = meshes.par_iter().map(|mesh| Tree::new(mesh)).collect();
        Self { scene, meetings: Meetings::new(scene), trees, mesh_of }
    }

    /// The objects that may touch in a frame, by sort and sweep over their boxes; ascending.
    ///
    /// # Panics
    /// If there is no such frame.
    pub fn meetings(&self, frame: usize) -> Vec<Meeting> {
        self.meetings.overlapping(frame)
    }

    /// The pairs (triangle of A, triangle of B) to test in a meeting, in ascending order.
    pub fn pairs(&self, meeting: &Meeting) -> Vec<(u32, u32)> {
        let [a, b] = [meeting.a, meeting.b].map(|object| &self.trees[self.mesh_of[object]]);
        candidates(a, b, &meeting.pose)
    }

    /// The meshes of a meeting.
    pub fn meshes(&self, meeting: &Meeting) -> [&'a Mesh; 2] {
        [meeting.a, meeting.b].map(|object| self.scene.objects[object].mesh.as_ref())
    }

    /// Calls `visit` with each meeting and its pairs, in the order of the frames, until it fails. The pairs are found
    /// by all threads of the current pool, a batch of frames at a time, so memory does not grow with the number of
    /// frames; what `visit` sees does not depend on the number of threads.
    ///
    /// # Errors
    /// The first error of `visit`.
    pub fn try_for_each<E>(&self, mut visit: impl FnMut(&Meeting, &[(u32, u32)]) -> Result<(), E>) -> Result<(), E> {
        let batch = Self::FRAMES_A_THREAD * rayon::current_num_threads();
        let frames = self.scene.frames();
        for start in (0..frames).step_by(batch) {
            let meetings = (start..frames.min(start + batch)).into_par_iter().flat_map_iter(|i| self.meetings(i));
            let found: Vec<_> = meetings.map(|meeting| (self.pairs(&meeting), meeting)).collect();
            for (pairs, meeting) in &found {
                visit(meeting, pairs)?;
            }
        }
        Ok(())
    }
}
