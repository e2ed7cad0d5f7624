//! The queries of a scene.

use super::{BuildError, Image, Numbers, Refusal};
use crate::golden::engine::{Query, Side};
use efsat_geometry::scene::{Meeting, Scene};

/// The meshes of a scene as images for one engine.
#[derive(Clone, Debug)]
pub struct Meetings {
    /// One image for each mesh of the scene, in the order of [`Scene::meshes`].
    pub images: Vec<Image>,
    numbers: Numbers,
    mesh_of: Vec<usize>,
}

impl Meetings {
    /// Builds the images of a scene's meshes.
    ///
    /// # Errors
    /// If a mesh is too large.
    pub fn new(scene: &Scene, numbers: Numbers) -> Result<Self, BuildError> {
        let (meshes, mesh_of) = scene.meshes();
        Ok(Self { images: Image::build(&meshes, numbers.format())?, numbers, mesh_of })
    }

    /// Makes the queries.
    pub fn numbers(&self) -> &Numbers {
        &self.numbers
    }

    /// The query for all contacts of two objects of a frame, of the images at `sides`.
    ///
    /// # Errors
    /// If the engine cannot answer it, which software then has to do.
    pub fn query(&self, meeting: &Meeting, sides: &[Side]) -> Result<Query, Refusal> {
        let objects = [meeting.a, meeting.b].map(|object| self.mesh_of[object]);
        let images = objects.map(|mesh| (&self.images[mesh], sides[mesh]));
        self.numbers.query(images, &meeting.pose.rows(), &meeting.pose.translation.into())
    }
}
