//! Scenes: meshes that stand and move, frame by frame, and the pairs of triangles close enough to test.
//!
//! The pose of an object takes a point of its mesh to the frame of the scene. Two objects meet in the frame of the one
//! named first: `x_A = M * x_B + t`. The twelve doubles of that relative pose are taken as exact reals by everything
//! that follows; `M` need not be perfectly orthonormal. If A stands as in its file they are those of B's own pose;
//! otherwise they are computed from both poses in binary64 ([`Pose::seen`]).
//!
//! ```
//! use efsat_geometry::Collider;
//! use efsat_geometry::scene::Scene;
//!
//! let scene = Scene::default_scene();
//! let collider = Collider::new(&*scene.objects[0].mesh, &*scene.objects[1].mesh);
//! let meeting = &scene.near().meetings(823)[0];
//! assert_eq!(collider.contacts(&meeting.pose).len(), 22);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod check;
mod file;
mod forest;
mod itself;
mod meetings;
mod motion;
mod near;
pub(crate) mod rotation;
mod sweep;
mod trajectory;

pub use crate::collide::Pose;
pub use check::InvalidScene;
pub use file::{SceneError, load};
pub use forest::Forest;
pub use near::{Meeting, Near};
pub use toml::Value;

use crate::mesh::{Findings, Mesh};
use motion::Motion;
use std::path::PathBuf;
use std::sync::Arc;

/// A mesh in a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Object {
    /// What the object is called in reports.
    pub name: String,
    /// Its mesh, scaled to the units of the scene; equal meshes are one in memory.
    pub mesh: Arc<Mesh>,
    /// What was found wrong with the faces of the mesh file.
    pub findings: Findings,
    /// Where it stands when nothing moves it.
    pub placed: Pose,
}

/// Objects, and the frames in which they meet.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// What the scene is called in reports.
    pub name: String,
    /// The objects, at least two.
    pub objects: Vec<Object>,
    /// The table `[effects]` of its file, which is for the unit that is to serve it, by key.
    pub effects: Vec<Entry>,
    /// The table `[parameters]`, likewise.
    pub parameters: Vec<Entry>,
    /// The frames, in the order in which they are tested.
    motions: Vec<Motion>,
    /// The mesh files that were read.
    files: Vec<PathBuf>,
}

/// What a scene file says to others.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// The key.
    pub key: String,
    /// The value, whatever it is.
    pub value: Value,
    /// The line of the file, counted from 1.
    pub line: usize,
}

/// A frame of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// What the frame is called in reports.
    pub label: String,
    /// The distance between the centres of the bounding boxes in cube half-sizes, where a tumbling turn made the
    /// frame: reports group by it.
    pub distance: Option<f64>,
    /// Where the objects stand, in their order.
    pub poses: Vec<Pose>,
}

impl Scene {
    /// The mesh files that it was read from, as its file and its folder name them.
    pub fn files(&self) -> &[PathBuf] {
        &self.files
    }

    /// The paper's benchmark as far as it is known: two identical headlights, one tumbling in front of the other at
    /// several distances. It is defined by `scenes/headlight.toml`.
    pub fn default_scene() -> Self {
        file::parse(include_str!("../scenes/headlight.toml"), "scenes/headlight.toml".as_ref())
            .expect("the built-in scene is valid")
    }

    /// The number of frames.
    pub fn frames(&self) -> usize {
        self.motions.iter().map(Motion::frames).sum()
    }

    /// Frame number `frame`.
    ///
    /// # Panics
    /// If there is no such frame.
    pub fn frame(&self, frame: usize) -> Frame {
        let change = self.change(frame);
        let mut poses: Vec<Pose> = self.objects.iter().map(|object| object.placed).collect();
        for (object, pose) in change.poses {
            poses[object] = pose;
        }
        Frame { label: change.label, distance: change.distance, poses }
    }

    fn change(&self, frame: usize) -> motion::Change {
        let mut before = 0;
        for motion in &self.motions {
            if frame < before + motion.frames() {
                return motion.change(frame - before);
            }
            before += motion.frames();
        }
        panic!("frame {frame} of {before}");
    }

    /// Builds trees of boxes of the meshes; the result yields the meetings of each frame and their near pairs.
    pub fn near(&self) -> Near<'_> {
        Near::by_boxes(self)
    }

    /// The meshes of the objects, each once, and which of them each object has.
    pub fn meshes(&self) -> (Vec<&Mesh>, Vec<usize>) {
        let mut meshes: Vec<&Arc<Mesh>> = vec![];
        let mut of_objects = vec![];
        for Object { mesh, .. } in &self.objects {
            let known = meshes.iter().position(|other| Arc::ptr_eq(other, mesh));
            of_objects.push(known.unwrap_or(meshes.len()));
            if known.is_none() {
                meshes.push(mesh);
            }
        }
        (meshes.into_iter().map(Arc::as_ref).collect(), of_objects)
    }
}

#[cfg(test)]
mod tests;
