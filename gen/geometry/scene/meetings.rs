//! Which objects of a frame meet.

use super::{Frame, Meeting, Scene, sweep};
use crate::mesh::Bounds;

/// The boxes of a scene's objects, from which the meetings of each frame follow.
#[derive(Clone, Debug)]
pub(super) struct Meetings<'a> {
    scene: &'a Scene,
    boxes: Vec<Bounds>,
    mesh_of: Vec<usize>,
}

impl<'a> Meetings<'a> {
    pub fn new(scene: &'a Scene) -> Self {
        let (meshes, mesh_of) = scene.meshes();
        let boxes: Vec<Bounds> = meshes.iter().map(|mesh| mesh.bounds()).collect();
        Self { scene, boxes: mesh_of.iter().map(|&mesh| boxes[mesh]).collect(), mesh_of }
    }

    /// The objects that may touch, by sort and sweep over their boxes; ascending.
    pub fn overlapping(&self, frame: usize) -> Vec<Meeting> {
        self.of(frame, |poses| sweep::overlapping(&self.boxes, poses))
    }

    /// Every two objects, ascending.
    pub fn all(&self, frame: usize) -> Vec<Meeting> {
        let objects = self.boxes.len();
        self.of(frame, |_| (0..objects).flat_map(|a| (a + 1..objects).map(move |b| (a, b))).collect())
    }

    fn of(&self, frame: usize, choose: impl Fn(&[super::Pose]) -> Vec<(usize, usize)>) -> Vec<Meeting> {
        let Frame { poses, .. } = self.scene.frame(frame);
        let meeting = |(a, b): (usize, usize)| {
            let meshes = [a, b].map(|object| self.mesh_of[object]);
            let pose = poses[a].seen(&poses[b]).expect("the poses of a scene can be seen from each other");
            Meeting { frame, a, b, meshes, pose }
        };
        choose(&poses).into_iter().map(meeting).collect()
    }
}
