//! The images of several meshes for one engine.

use super::{BuildError, Image, Numbers, Refusal};
use crate::model::{Query, Side};
use efsat_geometry::mesh::Mesh;
use efsat_geometry::scene::Pose;
use efsat_unit::golden::Golden;
use efsat_unit::pair::{Input, Pair};
use nalgebra::Point3;

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

    /// The meshes for which an exact unit answers that query: behind the pose, snapped to its grid, in steps of its words. None for
    /// other units.
    ///
    /// # Errors
    /// As [`Images::query`].
    ///
    /// # Panics
    /// If there is no such mesh.
    #[doc(hidden)]
    pub fn snapped(&self, meshes: [usize; 2], pose: &Pose) -> Result<Option<[Mesh; 2]>, Refusal> {
        if !self.numbers.format().snapped {
            return Ok(None);
        }
        let [a, b] = meshes.map(|mesh| &self.images[mesh]);
        let pose = self.numbers.pose([a, b].map(Image::header), &pose.rows(), &pose.translation().into())?;
        let unit = Golden::new(self.numbers.unit());
        // B's triangles as seen from a triangle in the origin.
        let origin = [[Input::default(); 3]; 3];
        let moved = |b| {
            let ([_, _, _, corners @ ..], _) = unit.snapped(&pose, &Pair { a: origin, b }).expect("an exact unit");
            corners
        };
        Ok(Some([a.mesh(|corners| corners.map(|corner| corner.map(|x| x.lo))), b.mesh(moved)]))
    }
}

impl Image {
    /// The triangles as a mesh, with their numbers, by what comes of their words.
    fn mesh(&self, of: impl Fn([[Input; 3]; 3]) -> [[i64; 3]; 3]) -> Mesh {
        let places = self.places();
        let mut vertices = Vec::with_capacity(3 * places.len());
        for &place in &places {
            let triangle = self.triangle(place).expect("a checked image");
            // At most 50 bits.
            vertices.extend(of(triangle.corners).map(|corner| Point3::from(corner.map(|x| x as f64))));
        }
        let faces = (0..places.len() as u32).map(|face| [3 * face, 3 * face + 1, 3 * face + 2]);
        Mesh::new(vertices, faces).expect("whole numbers are finite")
    }
}
