//! Triangle meshes: what they are, how they are read from STL and OBJ files, and the one that is built in.
//!
//! Reading keeps every triangle of a file, degenerate ones included, in the order of the file; nothing is repaired,
//! scaled or moved. Vertices that are equal bit for bit are stored once.

mod bounds;
mod error;
mod lines;
mod obj;
mod stl;

pub use bounds::Bounds;
pub use error::MeshError;

use nalgebra::Point3;
use std::path::Path;
use std::sync::{Arc, OnceLock};

/// The built-in mesh as it stands in the repository.
const HEADLIGHT: &[u8] = include_bytes!("../../scenes/cad_headlight.stl");

/// A triangle mesh with shared vertices, in the units of its file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Vertices; each of the three numbers is finite.
    pub vertices: Vec<Point3<f64>>,
    /// Triangles, as three indices into `vertices`.
    pub faces: Vec<[u32; 3]>,
}

impl Mesh {
    /// The three corners of triangle `face`.
    ///
    /// # Panics
    /// If there is no such face.
    pub fn triangle(&self, face: usize) -> [Point3<f64>; 3] {
        self.faces[face].map(|vertex| self.vertices[vertex as usize])
    }

    /// The exact bounding box of the vertices (empty for a mesh without any).
    pub fn bounds(&self) -> Bounds {
        Bounds::of(&self.vertices)
    }
}

/// Reads a mesh; the extension of the file name says which format it has: `.stl` (binary or ASCII, told apart by the
/// content) or `.obj` (polygons become triangle fans).
///
/// # Errors
/// One line with the file, the line where it can be known, what was found and what is legal.
pub fn read(path: &Path) -> Result<Mesh, MeshError> {
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    let parse = match extension.as_str() {
        "stl" => stl::parse,
        "obj" => obj::parse,
        _ => return Err(error::Fault::new(format!("extension '{extension}'"), "legal is .stl or .obj").of(path)),
    };
    let bytes = std::fs::read(path)
        .map_err(|e| error::Fault::new(format!("cannot be read ({e})"), "legal is a readable file").of(path))?;
    parse(&bytes).map_err(|fault| fault.of(path))
}

/// The built-in car headlight: a stand-in, made for this project, for the one the paper measured (5962 triangles
/// against 5947). Millimetres; its lens faces +z.
pub fn headlight() -> Arc<Mesh> {
    static MESH: OnceLock<Arc<Mesh>> = OnceLock::new();
    let mesh = MESH.get_or_init(|| Arc::new(stl::parse(HEADLIGHT).expect("the built-in mesh is a valid STL file")));
    Arc::clone(mesh)
}

#[cfg(test)]
mod tests;
