//! The meetings of a scene frame by frame, and their candidate pairs.

use super::meetings::Meetings;
use super::tree::{Candidates, Tree};
use super::{Pose, Scene};
use crate::mesh::Mesh;
use rayon::prelude::*;
use std::convert::Infallible;

/// Two objects that may touch in a frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Meeting {
    /// The number of the frame.
    pub frame: usize,
    /// The object in whose frame they meet.
    pub a: usize,
    /// The other one, of a higher number.
    pub b: usize,
    /// The meshes of both, by their places in [`Scene::meshes`].
    pub meshes: [usize; 2],
    /// The pose of B as seen from A: its twelve doubles are the truth.
    pub pose: Pose,
}

/// The trees of a scene's meshes, built once for all frames.
#[derive(Clone, Debug)]
pub struct BroadPhase<'a> {
    scene: &'a Scene,
    meetings: Meetings<'a>,
    trees: Vec<Tree<'a>>,
}

impl<'a> BroadPhase<'a> {
    /// Frames for each thread that are in memory at the same time.
    const FRAMES_A_THREAD: usize = 4;
    /// Meetings for each thread whose pairs are in memory at the same time.
    const MEETINGS_A_THREAD: usize = 8;

    /// Builds the trees.
    pub fn new(scene: &'a Scene) -> Self {
        let (meshes, _) = scene.meshes();
        let trees = meshes.par_iter().map(|mesh| Tree::new(mesh)).collect();
        Self { scene, meetings: Meetings::new(scene), trees }
    }

    /// The objects that may touch in a frame, by sort and sweep over their boxes; ascending.
    ///
    /// # Panics
    /// If there is no such frame.
    pub fn meetings(&self, frame: usize) -> Vec<Meeting> {
        self.meetings.overlapping(frame)
    }

    /// The pairs (triangle of A, triangle of B) to test in a meeting, in ascending order; all in memory.
    pub fn pairs(&self, meeting: &Meeting) -> Vec<(u32, u32)> {
        let mut all = vec![];
        let Ok(()) = self.candidates(meeting).pieces(|pairs| {
            all.extend_from_slice(pairs);
            Ok::<(), Infallible>(())
        });
        all
    }

    /// The same pairs, to be handed on in pieces.
    pub fn candidates(&self, meeting: &Meeting) -> Candidates<'_> {
        let [a, b] = meeting.meshes.map(|mesh| &self.trees[mesh]);
        Candidates::new(a, b, &meeting.pose)
    }

    /// The meshes of a meeting.
    pub fn meshes(&self, meeting: &Meeting) -> [&'a Mesh; 2] {
        [meeting.a, meeting.b].map(|object| self.scene.objects[object].mesh.as_ref())
    }

    /// Calls `visit` with each meeting and its pairs, in the order of the frames, until it fails. Of a meeting of very
    /// many pairs there are several calls, each with some of them. The pairs are found by all threads of the current
    /// pool; what `visit` sees does not depend on their number.
    ///
    /// # Errors
    /// The first error of `visit`.
    pub fn try_for_each<E>(&self, mut visit: impl FnMut(&Meeting, &[(u32, u32)]) -> Result<(), E>) -> Result<(), E> {
        self.in_order(|_, pairs| pairs.to_vec(), |meeting, pairs| visit(meeting, &pairs))
    }

    /// Works on the pairs of all meetings by all threads of the current pool, and calls `visit` with the results in the
    /// order of the frames, until it fails. A meeting of very many pairs has several results, each of some of them. What
    /// is in memory at a time grows neither with the number of frames nor with that of pairs.
    ///
    /// # Errors
    /// The first error of `visit`.
    pub fn in_order<T: Send, E>(
        &self,
        work: impl Fn(&Meeting, &[(u32, u32)]) -> T + Sync,
        mut visit: impl FnMut(&Meeting, T) -> Result<(), E>,
    ) -> Result<(), E> {
        let threads = rayon::current_num_threads();
        let frames = self.scene.frames();
        for start in (0..frames).step_by(Self::FRAMES_A_THREAD * threads) {
            let here = (start..frames.min(start + Self::FRAMES_A_THREAD * threads)).into_par_iter();
            let meetings: Vec<Meeting> = here.flat_map_iter(|frame| self.meetings(frame)).collect();
            for meetings in meetings.chunks(Self::MEETINGS_A_THREAD * threads) {
                let few = |meeting: &Meeting| Some(work(meeting, &self.candidates(meeting).few()?));
                let results: Vec<Option<T>> = meetings.par_iter().map(few).collect();
                for (meeting, result) in meetings.iter().zip(results) {
                    match result {
                        Some(result) => visit(meeting, result)?,
                        None => self.candidates(meeting).rows(|pairs| visit(meeting, work(meeting, pairs)))?,
                    }
                }
            }
        }
        Ok(())
    }
}
