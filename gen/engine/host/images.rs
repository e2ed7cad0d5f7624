//! The images of several meshes for one engine.

use super::{BuildError, Image, Numbers, Refusal};
use crate::model::{Query, Side};
use efsat_geometry::mesh::Mesh;
use efsat_geometry::scene::Pose;

/// Meshes as images for one engine.
#[derive(Clone, Debug)]
pub struct Images {
    images: Vec<Image>,
    numbers: Numbers,
}

impl Images {
    /// Builds the images of meshes.
    ///
    /// # Errors
    /// If a mesh is too large, or a coordinate is not finite.
    pub fn new(meshes: &[&Mesh], numbers: Numbers) -> Result<Self, BuildError> {
        Ok(Self { images: Image::build(meshes, numbers.format())?, numbers })
    }

    /// All of them, in the order of the meshes.
    pub fn all(&self) -> Vec<&Image> {
        self.images.iter().collect()
    }

    /// The number formats of images and queries.
    pub fn numbers(&self) -> &Numbers {
        &self.numbers
    }

    /// The query for all contacts of two meshes, whose images lie at `sides`, with the second one in `pose` as seen from the first.
    ///
    /// # Errors
    /// If the engine cannot answer it, which software then has to do, or if a number is not finite.
    ///
    /// # Panics
    /// If there is no such mesh.
    pub fn query(&self, meshes: [usize; 2], pose: &Pose, sides: &[Side]) -> Result<Query, Refusal> {
        let images = meshes.map(|mesh| (&self.images[mesh], sides[mesh]));
        self.numbers.query(images, &pose.rows(), &pose.translation().into())
    }
}
