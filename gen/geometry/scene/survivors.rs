//! The pairs of triangles that the stages before the unit leave.

use super::hierarchy::{Directions, Forest, Scratch, Statistics, pieces};
use super::meetings::Meetings;
use super::pieces::MOST;
use super::{Meeting, Scene};
use rayon::prelude::*;

/// Finds the surviving pairs of a scene, with or without the broad phase and the hierarchy. Nothing that touches is
/// lost either way.
#[derive(Clone, Debug)]
pub struct Survivors<'a> {
    scene: &'a Scene,
    meetings: Meetings<'a>,
    sweeps: bool,
    forest: Option<Forest>,
}

impl<'a> Survivors<'a> {
    /// Frames for each thread that are in memory at the same time.
    const FRAMES_A_THREAD: usize = 4;

    /// Prepares a scene: `sweeps` for sort and sweep over the objects, `directions` for the trees of k-DOPs; without
    /// trees all pairs of two objects that meet survive.
    pub fn new(scene: &'a Scene, sweeps: bool, directions: Option<Directions>) -> Self {
        let forest = directions.map(|directions| Forest::new(scene, directions));
        Self { scene, meetings: Meetings::new(scene), sweeps, forest }
    }

    /// The scene.
    pub fn scene(&self) -> &'a Scene {
        self.scene
    }

    /// The objects that may touch in a frame, ascending.
    ///
    /// # Panics
    /// If there is no such frame.
    pub fn meetings(&self, frame: usize) -> Vec<Meeting> {
        if self.sweeps { self.meetings.overlapping(frame) } else { self.meetings.all(frame) }
    }

    /// All pairs of triangles of a meeting, whether they survive or not.
    pub fn all_pairs(&self, meeting: &Meeting) -> u64 {
        [meeting.a, meeting.b].map(|object| self.scene.objects[object].mesh.faces().len() as u64).iter().product()
    }

    /// Calls `visit` with the surviving pairs of a meeting in ascending order, in one piece or several.
    pub fn pairs(&self, meeting: &Meeting, scratch: &mut Scratch, mut visit: impl FnMut(&[(u32, u32)])) -> Statistics {
        if let Some(forest) = &self.forest {
            let [a, b] = forest.trees(meeting);
            return pieces(a, b, &meeting.pose, scratch, visit);
        }
        let [a, b] = [meeting.a, meeting.b].map(|object| self.scene.objects[object].mesh.faces().len() as u32);
        let rows = MOST.div_ceil(b.max(1) as usize) as u32;
        for start in (0..a).step_by(rows as usize) {
            let block: Vec<(u32, u32)> =
                (start..a.min(start + rows)).flat_map(|a| (0..b).map(move |b| (a, b))).collect();
            visit(&block);
        }
        Statistics { pairs_tested: self.all_pairs(meeting), ..Statistics::default() }
    }

    /// Works on all frames by all threads of the current pool, and calls `visit` with the results in the order of the
    /// frames, until it fails. A batch of frames is in memory at a time, so memory does not grow with their number;
    /// what `visit` sees does not depend on the number of threads.
    ///
    /// # Errors
    /// The first error of `visit`.
    pub fn in_order<T: Send, E>(
        &self,
        work: impl Fn(usize, &mut Scratch) -> T + Sync,
        mut visit: impl FnMut(usize, T) -> Result<(), E>,
    ) -> Result<(), E> {
        let batch = Self::FRAMES_A_THREAD * rayon::current_num_threads();
        let frames = self.scene.frames();
        for start in (0..frames).step_by(batch) {
            let here = (start..frames.min(start + batch)).into_par_iter();
            let found: Vec<T> = here.map_init(Scratch::default, |scratch, frame| work(frame, scratch)).collect();
            for (frame, result) in (start..).zip(found) {
                visit(frame, result)?;
            }
        }
        Ok(())
    }
}
