//! From meshes to images.

use super::image::{Header, Image, LINE};
use crate::format::EngineFormat;
use crate::model::{Block, Link, Triangle};
use efsat_geometry::collide::hierarchy::{LocalBlock, LocalChild, LocalFormat, LocalTree, Placement};
use efsat_geometry::mesh::Mesh;
use efsat_unit::pair::Input;

/// Why there is no image of a mesh.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BuildError {
    /// More triangles than numbers.
    #[error("{found} triangles: expected at most {most}, the numbers that answers carry")]
    Triangles {
        /// How many there are.
        found: usize,
        /// How many there may be.
        most: usize,
    },
    /// An image beyond 4 GB, the offsets in its header.
    #[error("an image of {found} bytes: expected at most 4294967232")]
    Size {
        /// How many there would be.
        found: u64,
    },
}

impl Image {
    /// The images of meshes that meet in queries: all with one scale, the greatest with which they fit.
    ///
    /// # Errors
    /// If a mesh is too large.
    pub fn build(meshes: &[&Mesh], format: &EngineFormat) -> Result<Vec<Self>, BuildError> {
        let placements = Placement::common(meshes);
        meshes.iter().zip(&placements).map(|(mesh, placement)| Self::of(mesh, placement, format)).collect()
    }

    /// The first of the images of meshes that meet in queries.
    ///
    /// # Errors
    /// If the mesh is too large.
    ///
    /// # Panics
    /// If there is no mesh.
    pub fn build_first(meshes: &[&Mesh], format: &EngineFormat) -> Result<Self, BuildError> {
        Self::of(meshes[0], &Placement::common(meshes)[0], format)
    }

    /// The image of a mesh inside its cube.
    fn of(mesh: &Mesh, placement: &Placement, format: &EngineFormat) -> Result<Self, BuildError> {
        let most = 1 << format.triangle().number_bits;
        if mesh.faces().len() > most {
            return Err(BuildError::Triangles { found: mesh.faces().len(), most });
        }
        let local = LocalFormat {
            directions: format.directions,
            grid_fraction: format.grid_fraction(),
            origin_fraction: format.origin_fraction(),
            most: format.most(),
        };
        let tree = LocalTree::new(mesh, placement, local);
        let mut header = Header {
            format: *format,
            blocks: tree.block_count(),
            triangles: mesh.faces().len() as u32,
            power: placement.power,
            height: tree.height(),
            centre: placement.centre,
        };
        // An image knows its own formats only: what a reader finds in it.
        header.format = Header::of(&header.words()).expect("its own words are in order").format;
        let size = header.size();
        if size > u64::from(u32::MAX - LINE) {
            return Err(BuildError::Size { found: size });
        }
        let mut image = Self { header, words: Vec::with_capacity(size as usize / 8) };
        image.words.extend(header.words());
        for block in tree.blocks() {
            image.words.extend(converted(block).words(format));
        }
        image.words.resize(header.triangles_at() as usize / 8, 0);
        for face in tree.triangles() {
            let corners = image.corners(mesh, face as usize, placement);
            image.words.extend(Triangle { number: face, corners }.words(format));
        }
        Ok(image)
    }

    /// A triangle of the mesh as the unit reads it.
    pub(super) fn corners(&self, mesh: &Mesh, face: usize, placement: &Placement) -> [[Input; 3]; 3] {
        let fraction = self.header.format.word_fraction();
        mesh.triangle(face).map(|corner| {
            [0, 1, 2].map(|axis| {
                let (lo, sticky) =
                    placement.floor(corner[axis], axis, fraction).expect("the corner is inside the cube");
                Input { lo, sticky: sticky && self.header.format.sticky }
            })
        })
    }
}

fn converted(block: LocalBlock) -> Block {
    let links = block.children.map(|child| match child {
        LocalChild::None => Link::None,
        LocalChild::Leaf(number) => Link::Leaf(number),
        LocalChild::Inner(number) => Link::Inner(number),
    });
    Block { links, origin: block.origin, exponent: block.exponent, codes: block.codes }
}
