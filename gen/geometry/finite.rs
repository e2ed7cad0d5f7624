//! Numbers that have to be finite: which one is not.
//!
//! Meshes and poses are checked when they are made, so that nothing behind them looks again; functions that take plain numbers
//! check these, and refuse them with the place of the first that is infinite or no number.
//!
//! ```
//! use efsat_geometry::finite::Place;
//! use efsat_geometry::software::retest::retest;
//!
//! let mut points = [[0.0; 3]; 6];
//! points[4][2] = f64::INFINITY;
//! let refused = retest(&points).unwrap_err();
//! assert_eq!(refused.place, Place::Pair { pair: None, corner: 4, axis: 2 });
//! assert_eq!(refused.to_string(), "z of b1 is inf: expected a finite number");
//! ```

use crate::Points;
use std::fmt;

/// A number that is infinite or no number.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{place} is {value}: expected a finite number")]
pub struct NotFinite {
    /// Where it stands.
    pub place: Place,
    /// What was found.
    pub value: f64,
}

/// Where a number stands; everything is counted from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// A coordinate of a pair of triangles.
    Pair {
        /// Which pair, if there are several.
        pair: Option<usize>,
        /// Which of a0 a1 a2 b0 b1 b2.
        corner: usize,
        /// x, y or z.
        axis: usize,
    },
    /// A coordinate of a vertex of a mesh.
    Vertex {
        /// Which mesh, if there are two: 0 is A, 1 is B.
        mesh: Option<usize>,
        /// The vertex.
        vertex: usize,
        /// x, y or z.
        axis: usize,
    },
    /// An entry of the matrix of a pose.
    Matrix {
        /// Its row.
        row: usize,
        /// Its column.
        column: usize,
    },
    /// An entry of the translation of a pose.
    Translation {
        /// x, y or z.
        axis: usize,
    },
}

const AXES: [&str; 3] = ["x", "y", "z"];

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        const CORNERS: [&str; 6] = ["a0", "a1", "a2", "b0", "b1", "b2"];
        match *self {
            Self::Pair { pair, corner, axis } => {
                if let Some(pair) = pair {
                    write!(f, "pair {pair}: ")?;
                }
                write!(f, "{} of {}", AXES[axis], CORNERS[corner])
            }
            Self::Vertex { mesh, vertex, axis } => {
                let of_mesh = mesh.map_or("", |mesh| [" of mesh a", " of mesh b"][mesh]);
                write!(f, "{} of vertex {vertex}{of_mesh}", AXES[axis])
            }
            Self::Matrix { row, column } => write!(f, "the entry in row {row}, column {column} of the matrix"),
            Self::Translation { axis } => write!(f, "{} of the translation", AXES[axis]),
        }
    }
}

/// The first of some numbers that is not finite, by its index.
fn first(numbers: &[f64], place: impl Fn(usize) -> Place) -> Result<(), NotFinite> {
    // All are looked at, without a branch for each.
    if numbers.iter().fold(true, |finite, x| finite & x.is_finite()) {
        return Ok(());
    }
    let found = numbers.iter().position(|x| !x.is_finite());
    found.map_or(Ok(()), |index| Err(NotFinite { place: place(index), value: numbers[index] }))
}

/// Whether all coordinates of a pair are finite.
///
/// # Errors
/// The first that is not.
pub fn pair(points: &Points) -> Result<(), NotFinite> {
    first(points.as_flattened(), |index| Place::Pair { pair: None, corner: index / 3, axis: index % 3 })
}

/// Whether all coordinates of vertices are finite.
///
/// # Errors
/// The first that is not.
pub fn vertices(vertices: &[[f64; 3]]) -> Result<(), NotFinite> {
    first(vertices.as_flattened(), |index| Place::Vertex { mesh: None, vertex: index / 3, axis: index % 3 })
}

/// Whether all coordinates of the vertices of two meshes are finite.
///
/// # Errors
/// The first that is not, with its mesh.
pub fn meshes(a: &[[f64; 3]], b: &[[f64; 3]]) -> Result<(), NotFinite> {
    let of = |mesh: usize| move |i: usize| Place::Vertex { mesh: Some(mesh), vertex: i / 3, axis: i % 3 };
    first(a.as_flattened(), of(0))?;
    first(b.as_flattened(), of(1))
}

/// Whether all twelve numbers of a pose are finite; `m` is indexed `[row][column]`.
///
/// # Errors
/// The first that is not.
pub fn pose(m: &[[f64; 3]; 3], t: &[f64; 3]) -> Result<(), NotFinite> {
    first(m.as_flattened(), |index| Place::Matrix { row: index / 3, column: index % 3 })?;
    first(t, |axis| Place::Translation { axis })
}

/// Whether all numbers of a triangle, another one and its pose are finite.
pub(crate) fn posed(a: &[[f64; 3]; 3], b: &[[f64; 3]; 3], m: &[[f64; 3]; 3], t: &[f64; 3]) -> Result<(), NotFinite> {
    pair(&[a[0], a[1], a[2], b[0], b[1], b[2]])?;
    pose(m, t)
}

impl NotFinite {
    /// The same in a list of pairs, of which the one meant is so many after the one named, or after the first.
    pub fn of_pair(self, after: usize) -> Self {
        match self.place {
            Place::Pair { pair, corner, axis } => {
                Self { place: Place::Pair { pair: Some(pair.unwrap_or(0) + after), corner, axis }, ..self }
            }
            _ => self,
        }
    }
}
