//! Triangle meshes: what they are, how they are read from STL, OBJ, PLY and OFF files, and those that are built in.
//!
//! Reading keeps every triangle of a file, degenerate ones included, in the order of the file; nothing is repaired,
//! scaled or moved. Of STL files, vertices that are equal bit for bit are stored once. Polygons become triangles that tile
//! them. What is read and what is refused is described in `docs/formats.md`.
//!
//! ```
//! use efsat_geometry::mesh::{Mesh, read};
//!
//! // A mesh of shared vertices, and one of triangles by their corners.
//! let square = Mesh::new([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]], [[0, 1, 2], [0, 2, 3]])?;
//! let triangles = [[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]], [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]];
//! assert_eq!(Mesh::from_triangles(triangles)?, square);
//!
//! let error = Mesh::new([[0.0, 0.0, 0.0]], [[0, 0, 1]]).unwrap_err();
//! assert_eq!(error.to_string(), "triangle 0: vertex 1; expected one of 1 vertices, counted from 0");
//! assert!(read("no_such_file.stl".as_ref()).is_err());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub(crate) mod angle;
mod bounds;
mod build;
mod builtin;
mod error;
mod findings;
mod obj;
mod off;
mod ply;
mod polygon;
mod snapped;
mod stl;
mod text;

pub use bounds::Bounds;
pub use builtin::{BUILTIN, builtin, headlight};
pub use error::MeshError;
pub use findings::{Defect, Finding, Findings, Numbers, Remark};
pub use snapped::Snapped;

use crate::finite::{NotFinite, Place};
use crate::input;
use build::Faults;
use error::Fault;
use nalgebra::Point3;
use std::collections::HashMap;
use std::path::Path;

/// A triangle mesh with shared vertices, in the units of its file. Its coordinates are finite and its indices are those of vertices:
/// what takes a mesh need not look again.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    vertices: Vec<Point3<f64>>,
    faces: Vec<[u32; 3]>,
}

/// Why a mesh cannot be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum InvalidMesh {
    /// A coordinate that is infinite or no number.
    #[error(transparent)]
    NotFinite(#[from] NotFinite),
    /// A triangle of a vertex that there is not.
    #[error("triangle {face}: vertex {vertex}; expected one of {count} vertices, counted from 0")]
    OutOfRange {
        /// The triangle, counted from 0.
        face: usize,
        /// The vertex that it names.
        vertex: u32,
        /// How many vertices there are.
        count: usize,
    },
    /// More corners than indices count.
    #[error("{count} corners; expected fewer than 2^32")]
    TooMany {
        /// How many there are.
        count: usize,
    },
}

impl Mesh {
    /// A mesh of vertices, arrays or points, and of triangles as three indices into these, counted from 0.
    ///
    /// # Errors
    /// The first coordinate that is not finite, or the first triangle with an index out of range.
    pub fn new<V: Into<Point3<f64>>>(
        vertices: impl IntoIterator<Item = V>,
        faces: impl IntoIterator<Item = [u32; 3]>,
    ) -> Result<Self, InvalidMesh> {
        let vertices: Vec<Point3<f64>> = vertices.into_iter().map(Into::into).collect();
        let faces: Vec<[u32; 3]> = faces.into_iter().collect();
        for (vertex, point) in vertices.iter().enumerate() {
            if let Some(axis) = (0..3).find(|&axis| !point[axis].is_finite()) {
                return Err(NotFinite { place: Place::Vertex { mesh: None, vertex, axis }, value: point[axis] }.into());
            }
        }
        let count = vertices.len();
        for (face, corners) in faces.iter().enumerate() {
            if let Some(&vertex) = corners.iter().find(|&&vertex| vertex as usize >= count) {
                return Err(InvalidMesh::OutOfRange { face, vertex, count });
            }
        }
        Ok(Self { vertices, faces })
    }

    /// A mesh of triangles by their corners. Corners that are equal as numbers become one vertex.
    ///
    /// # Errors
    /// The first coordinate that is not finite; corner c of triangle t is vertex 3 t + c. More corners than 32 bits count.
    pub fn from_triangles<V: Into<Point3<f64>>>(
        triangles: impl IntoIterator<Item = [V; 3]>,
    ) -> Result<Self, InvalidMesh> {
        let corners: Vec<Point3<f64>> = triangles.into_iter().flatten().map(Into::into).collect();
        let count = u32::try_from(corners.len()).map_err(|_| InvalidMesh::TooMany { count: corners.len() })?;
        Ok(Self::new(corners, (0..count).step_by(3).map(|first| [first, first + 1, first + 2]))?.welded())
    }

    /// The vertices.
    #[inline]
    pub fn vertices(&self) -> &[Point3<f64>] {
        &self.vertices
    }

    /// The triangles, as three indices into the vertices.
    #[inline]
    pub fn faces(&self) -> &[[u32; 3]] {
        &self.faces
    }

    /// The three corners of triangle `face`.
    ///
    /// # Panics
    /// If there is no such face.
    #[inline]
    pub fn triangle(&self, face: usize) -> [Point3<f64>; 3] {
        self.faces[face].map(|vertex| self.vertices[vertex as usize])
    }

    /// The triangles whose corners are on one line, ascending: the projections along all three coordinate axes are. That
    /// is decided exactly, short of numbers whose products leave the range of binary64.
    pub fn degenerate(&self) -> Vec<usize> {
        findings::degenerate(self)
    }

    /// The same faces on vertices no two of which are equal as numbers; each is at the place of the first, and no zero is negative.
    pub fn welded(&self) -> Self {
        let mut numbers: HashMap<[u64; 3], u32> = HashMap::with_capacity(self.vertices.len());
        let mut vertices = vec![];
        let mut number = |vertex: &Point3<f64>| {
            // Adding zero makes one of the two zeros.
            let vertex = vertex.map(|x| x + 0.0);
            *numbers.entry(vertex.map(f64::to_bits).into()).or_insert_with(|| {
                vertices.push(vertex);
                vertices.len() as u32 - 1
            })
        };
        let of_old: Vec<u32> = self.vertices.iter().map(&mut number).collect();
        let faces = self.faces.iter().map(|face| face.map(|vertex| of_old[vertex as usize])).collect();
        Self { vertices, faces }
    }

    /// The exact bounding box of the vertices (empty for a mesh without any).
    pub fn bounds(&self) -> Bounds {
        Bounds::of(&self.vertices)
    }
}

/// A mesh file as read: the faces that can be used, the faults of the others, and what else there is to say.
struct Parsed {
    mesh: Mesh,
    numbers: Numbers,
    faults: Faults,
    remarks: Vec<Remark>,
}

/// Reads a mesh all of whose faces can be used; the extension of the file name says which format it has: `.stl`, `.obj`,
/// `.ply` or `.off`, the content whether it is binary. Polygons become triangles. What else there is to say of a file, such
/// as bytes that are not read and corners that are not in one plane, only [`survey`] says.
///
/// # Errors
/// One line with the file, the line where it can be known, what was found and what was expected.
pub fn read(path: &Path) -> Result<Mesh, MeshError> {
    let Parsed { mesh, faults, .. } = parsed(path)?;
    match faults.0.into_iter().find(|(defect, ..)| !defect.is_kept()) {
        Some((.., fault)) => Err(fault.of(path)),
        None => Ok(mesh),
    }
}

/// Reads a mesh as [`read`] does, leaves out the faces that cannot be used (fewer than three corners, vertices that
/// are not in the file or not finite, polygons that are not simple), and says what was found, also of the faces that stay,
/// and which faces of the file the triangles are.
///
/// # Errors
/// As [`read`], for files that are broken as a whole and for those without a face that can be used.
pub fn survey(path: &Path) -> Result<(Mesh, Findings), MeshError> {
    let Parsed { mesh, numbers, faults, remarks } = parsed(path)?;
    if mesh.faces.is_empty() {
        if let Some((.., fault)) = faults.0.into_iter().next() {
            return Err(fault.of(path));
        }
        return Err(Fault::new("no face", "expected at least one").of(path));
    }
    let findings = Findings::of(&mesh, &faults, remarks, numbers);
    Ok((mesh, findings))
}

/// The formats of mesh files.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Format {
    Stl,
    Obj,
    Ply,
    Off,
}

impl Format {
    const LEGAL: &str = "expected .stl, .obj, .ply or .off";

    fn of_extension(extension: &str) -> Option<Self> {
        match extension {
            "stl" => Some(Self::Stl),
            "obj" => Some(Self::Obj),
            "ply" => Some(Self::Ply),
            "off" => Some(Self::Off),
            _ => None,
        }
    }

    /// What a file surely is by its content; an OBJ file is never sure.
    fn of_content(bytes: &[u8]) -> Option<Self> {
        let text = text::without_mark(bytes);
        let begins = |word: &[u8]| text.starts_with(word) && text.get(word.len()).is_none_or(u8::is_ascii_whitespace);
        if begins(b"ply") {
            Some(Self::Ply)
        } else if off::KEYWORDS.iter().any(|word| begins(word.as_bytes())) {
            Some(Self::Off)
        } else {
            stl::is_surely(bytes).then_some(Self::Stl)
        }
    }

    fn parse(self, bytes: &[u8]) -> Result<Parsed, Fault> {
        match self {
            Self::Stl => stl::parse(bytes),
            Self::Obj => obj::parse(bytes),
            Self::Ply => ply::parse(bytes),
            Self::Off => off::parse(bytes),
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Stl => "STL",
            Self::Obj => "OBJ",
            Self::Ply => "PLY",
            Self::Off => "OFF",
        }
    }
}

fn parsed(path: &Path) -> Result<Parsed, MeshError> {
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    let format = Format::of_extension(&extension).ok_or_else(|| {
        if extension.is_empty() && !path.exists() {
            return Fault::new("not found", "expected a file that ends in .stl, .obj, .ply or .off").of(path);
        }
        Fault::new(format!("extension '{extension}'"), Format::LEGAL).of(path)
    })?;
    let bytes = input::read(path)
        .map_err(|e| Fault::new(format!("cannot be read ({e})"), "expected a readable file").of(path))?;
    let content = Format::of_content(&bytes).unwrap_or(format);
    let mut parsed = content.parse(&bytes).map_err(|fault| fault.of(path))?;
    if content != format {
        let first = format!("{}, not {}", content.name(), format.name());
        parsed.remarks.push(Remark { what: "read as what its content is", count: 1, first });
    }
    Ok(parsed)
}

#[cfg(test)]
mod tests;
