//! The meetings of a scene frame by frame, and the pairs of triangles in them that may touch. Nothing that touches is lost,
//! whatever finds them.

use super::forest::Forest;
use super::meetings::Meetings;
use super::{Pose, Scene};
use crate::collide::hierarchy::{Directions, Scratch, Statistics, pieces};
use crate::collide::pieces::MOST;
use crate::collide::{Candidates, Tree};
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

/// What keeps triangles apart that surely do not touch.
#[derive(Clone, Debug)]
enum Volumes<'a> {
    /// Nothing: all pairs of two objects that meet are near.
    None,
    /// Trees of boxes.
    Boxes(Vec<Tree<'a>>),
    /// Trees of k-DOPs.
    Dops(Forest),
}

/// Finds the pairs of a scene that may touch; its trees are built once for all frames.
#[derive(Clone, Debug)]
pub struct Near<'a> {
    scene: &'a Scene,
    meetings: Meetings<'a>,
    sweeps: bool,
    volumes: Volumes<'a>,
}

impl<'a> Near<'a> {
    /// Frames for each thread that are in memory at the same time.
    const FRAMES_A_THREAD: usize = 4;
    /// Meetings for each thread whose pairs are in memory at the same time.
    const MEETINGS_A_THREAD: usize = 8;

    /// By boxes: sort and sweep over the objects, trees of boxes over their triangles.
    pub fn by_boxes(scene: &'a Scene) -> Self {
        let (meshes, _) = scene.meshes();
        let trees = meshes.par_iter().map(|mesh| Tree::new(mesh)).collect();
        Self { scene, meetings: Meetings::new(scene), sweeps: true, volumes: Volumes::Boxes(trees) }
    }

    /// By k-DOPs: `sweeps` for sort and sweep over the objects, `directions` for the trees over their triangles; without
    /// trees all pairs of two objects that meet.
    pub fn by_dops(scene: &'a Scene, sweeps: bool, directions: Option<Directions>) -> Self {
        let forest = |directions| Volumes::Dops(Forest::new(scene, directions));
        let volumes = directions.map_or(Volumes::None, forest);
        Self { scene, meetings: Meetings::new(scene), sweeps, volumes }
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

    /// The meshes of a meeting.
    pub fn meshes(&self, meeting: &Meeting) -> [&'a Mesh; 2] {
        [meeting.a, meeting.b].map(|object| self.scene.objects[object].mesh.as_ref())
    }

    /// All pairs of triangles of a meeting, whether they are near or not.
    pub fn all_pairs(&self, meeting: &Meeting) -> u64 {
        self.meshes(meeting).map(|mesh| mesh.faces().len() as u64).iter().product()
    }

    /// Calls `visit` with the pairs (triangle of A, triangle of B) of a meeting in ascending order, in one piece or several. What
    /// it took is counted for trees of k-DOPs.
    #[doc(hidden)]
    pub fn pieces(&self, meeting: &Meeting, scratch: &mut Scratch, mut visit: impl FnMut(&[(u32, u32)])) -> Statistics {
        match &self.volumes {
            Volumes::Dops(forest) => {
                let [a, b] = forest.trees(meeting);
                pieces(a, b, &meeting.pose, scratch, visit)
            }
            Volumes::Boxes(trees) => {
                let Ok(()) = candidates(trees, meeting).pieces(|pairs| {
                    visit(pairs);
                    Ok::<(), Infallible>(())
                });
                Statistics::default()
            }
            Volumes::None => {
                let [a, b] = self.meshes(meeting).map(|mesh| mesh.faces().len() as u32);
                let rows = MOST.div_ceil(b.max(1) as usize) as u32;
                for start in (0..a).step_by(rows as usize) {
                    let block: Vec<(u32, u32)> =
                        (start..a.min(start + rows)).flat_map(|a| (0..b).map(move |b| (a, b))).collect();
                    visit(&block);
                }
                Statistics { pairs_tested: self.all_pairs(meeting), ..Statistics::default() }
            }
        }
    }

    /// The same pairs, all in memory.
    pub fn pairs(&self, meeting: &Meeting) -> Vec<(u32, u32)> {
        let mut all = vec![];
        self.pieces(meeting, &mut Scratch::default(), |pairs| all.extend_from_slice(pairs));
        all
    }

    /// The same pairs, unless they are [too many](MOST).
    fn few(&self, meeting: &Meeting, scratch: &mut Scratch) -> Option<Vec<(u32, u32)>> {
        if let Volumes::Boxes(trees) = &self.volumes {
            return candidates(trees, meeting).few();
        }
        let mut all = vec![];
        self.pieces(meeting, scratch, |pairs| {
            if all.len() <= MOST {
                all.extend_from_slice(pairs);
            }
        });
        (all.len() <= MOST).then_some(all)
    }

    /// Calls `visit` with each meeting and its pairs, in the order of the frames, until it fails. Of a meeting of very
    /// many pairs there are several calls, each with some of them. The pairs are found by all threads of the current
    /// pool; what `visit` sees does not depend on their number.
    ///
    /// # Errors
    /// The first error of `visit`.
    pub fn try_for_each<E>(&self, mut visit: impl FnMut(&Meeting, &[(u32, u32)]) -> Result<(), E>) -> Result<(), E> {
        self.meetings_in_order(|_, pairs| pairs.to_vec(), |meeting, pairs| visit(meeting, &pairs))
    }

    /// Works on the pairs of all meetings by all threads of the current pool, and calls `visit` with the results in the
    /// order of the frames, until it fails. A meeting of very many pairs has several results, each of some of them. What
    /// is in memory at a time grows neither with the number of frames nor with that of pairs.
    ///
    /// # Errors
    /// The first error of `visit`.
    pub fn meetings_in_order<T: Send, E>(
        &self,
        work: impl Fn(&Meeting, &[(u32, u32)]) -> T + Sync,
        mut visit: impl FnMut(&Meeting, T) -> Result<(), E>,
    ) -> Result<(), E> {
        let most = Self::MEETINGS_A_THREAD * rayon::current_num_threads();
        for frames in self.batches() {
            let meetings: Vec<Meeting> = frames.into_par_iter().flat_map_iter(|frame| self.meetings(frame)).collect();
            for meetings in meetings.chunks(most) {
                let few = |scratch: &mut Scratch, meeting: &Meeting| Some(work(meeting, &self.few(meeting, scratch)?));
                let results: Vec<Option<T>> = meetings.par_iter().map_init(Scratch::default, few).collect();
                for (meeting, result) in meetings.iter().zip(results) {
                    match result {
                        Some(result) => visit(meeting, result)?,
                        None => self.many(meeting, |pairs| visit(meeting, work(meeting, pairs)))?,
                    }
                }
            }
        }
        Ok(())
    }

    /// Works on all frames by all threads of the current pool, and calls `visit` with the results in the order of the
    /// frames, until it fails. A batch of frames is in memory at a time, so memory does not grow with their number;
    /// what `visit` sees does not depend on the number of threads.
    ///
    /// # Errors
    /// The first error of `visit`.
    #[doc(hidden)]
    pub fn frames_in_order<T: Send, E>(
        &self,
        work: impl Fn(usize, &mut Scratch) -> T + Sync,
        mut visit: impl FnMut(usize, T) -> Result<(), E>,
    ) -> Result<(), E> {
        for frames in self.batches() {
            let here = frames.clone().into_par_iter();
            let found: Vec<T> = here.map_init(Scratch::default, |scratch, frame| work(frame, scratch)).collect();
            for (frame, result) in frames.zip(found) {
                visit(frame, result)?;
            }
        }
        Ok(())
    }

    /// The frames that are in memory at the same time.
    fn batches(&self) -> impl Iterator<Item = std::ops::Range<usize>> + use<> {
        let (frames, batch) = (self.scene.frames(), Self::FRAMES_A_THREAD * rayon::current_num_threads());
        (0..frames).step_by(batch).map(move |start| start..frames.min(start + batch))
    }

    /// Calls `visit` with pairs that are too many, until it fails.
    fn many<E>(&self, meeting: &Meeting, mut visit: impl FnMut(&[(u32, u32)]) -> Result<(), E>) -> Result<(), E> {
        if let Volumes::Boxes(trees) = &self.volumes {
            return candidates(trees, meeting).rows(visit);
        }
        let mut result = Ok(());
        self.pieces(meeting, &mut Scratch::default(), |pairs| {
            if result.is_ok() {
                result = visit(pairs);
            }
        });
        result
    }
}

fn candidates<'t>(trees: &'t [Tree<'_>], meeting: &Meeting) -> Candidates<'t> {
    let [a, b] = meeting.meshes.map(|mesh| &trees[mesh]);
    Candidates::new(a, b, &meeting.pose)
}
