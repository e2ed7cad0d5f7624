//! What was found wrong with the faces of a mesh.

use super::Mesh;
use super::error::Fault;
use robust::{Coord, orient2d};
use serde::Serialize;
use std::collections::HashSet;
use std::fmt;

/// What can be wrong with a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Defect {
    /// Fewer than three corners: left out.
    FewCorners,
    /// A vertex that is not in the file: left out.
    OutOfRange,
    /// A coordinate that is infinite or no number: left out.
    NonFinite,
    /// Corners on one line, exactly: kept, as the segment or point that it is.
    Degenerate,
    /// The same three corners as an earlier face, in any order: kept.
    Duplicate,
}

impl Defect {
    /// All of them; those whose faces are left out come first.
    pub const ALL: [Self; 5] = [Self::FewCorners, Self::OutOfRange, Self::NonFinite, Self::Degenerate, Self::Duplicate];

    /// Whether a face of that kind stays in the mesh.
    pub fn is_kept(self) -> bool {
        matches!(self, Self::Degenerate | Self::Duplicate)
    }

    /// What a count of such faces is called.
    fn words(self) -> &'static str {
        match self {
            Self::FewCorners => "with fewer than three corners",
            Self::OutOfRange => "with a vertex out of range",
            Self::NonFinite => "with a coordinate that is not finite",
            Self::Degenerate => "degenerate",
            Self::Duplicate => "duplicate",
        }
    }
}

/// How often a defect was found, and where first.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Finding {
    /// What was found.
    pub defect: Defect,
    /// The number of faces.
    pub count: u64,
    /// The first of them, in words.
    pub first: String,
}

/// Everything found wrong with a mesh; it prints as one line.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Findings {
    /// One entry for each defect that was found, in the order of [`Defect::ALL`].
    pub list: Vec<Finding>,
}

impl Findings {
    /// Looks at the faces of a mesh, and takes the faults of those left out.
    pub(super) fn of(mesh: &Mesh, faults: &[(Defect, Fault)]) -> Self {
        let places = |defect: Defect| -> Vec<String> {
            let face = |index: usize| format!("triangle {index}");
            match defect {
                Defect::Degenerate => degenerate(mesh).into_iter().map(face).collect(),
                Defect::Duplicate => duplicates(mesh).into_iter().map(face).collect(),
                _ => faults.iter().filter(|(d, _)| *d == defect).map(|(_, fault)| fault.brief()).collect(),
            }
        };
        let found = |defect: Defect| {
            let places = places(defect);
            let count = places.len() as u64;
            places.into_iter().next().map(|first| Finding { defect, count, first })
        };
        Self { list: Defect::ALL.into_iter().filter_map(found).collect() }
    }

    /// Looks at the faces of a mesh that was not read from a file.
    pub fn of_mesh(mesh: &Mesh) -> Self {
        Self::of(mesh, &[])
    }

    /// How many faces were left out.
    pub fn left_out(&self) -> u64 {
        self.list.iter().filter(|finding| !finding.defect.is_kept()).map(|finding| finding.count).sum()
    }
}

impl fmt::Display for Findings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let part = |kept: bool, word: &str| {
            let here = self.list.iter().filter(|finding| finding.defect.is_kept() == kept);
            let one = |found: &Finding| format!("{} {} (first: {})", found.count, found.defect.words(), found.first);
            let list: Vec<String> = here.map(one).collect();
            (!list.is_empty()).then(|| format!("{word}: {}", list.join(", ")))
        };
        let parts = [part(false, "faces left out"), part(true, "faces kept")];
        f.write_str(&parts.into_iter().flatten().collect::<Vec<_>>().join("; "))
    }
}

/// Triangles whose corners are on one line: the projections along all three coordinate axes are. The predicate is exact
/// short of numbers whose products leave the range of binary64.
pub(super) fn degenerate(mesh: &Mesh) -> Vec<usize> {
    let is_degenerate = |face: &usize| {
        let corners = mesh.triangle(*face);
        [(0, 1), (1, 2), (2, 0)].into_iter().all(|(x, y)| {
            let [p, q, r] = corners.map(|v| Coord { x: v[x], y: v[y] });
            orient2d(p, q, r) == 0.0
        })
    };
    (0..mesh.faces.len()).filter(is_degenerate).collect()
}

/// Triangles whose corners, in whatever order, are those of an earlier one: equal as numbers.
fn duplicates(mesh: &Mesh) -> Vec<usize> {
    let mut known = HashSet::new();
    let is_known = |face: &usize| {
        // Adding zero makes one of the two zeros.
        let mut corners = mesh.triangle(*face).map(|v| <[f64; 3]>::from(v).map(|x| (x + 0.0).to_bits()));
        corners.sort_unstable();
        !known.insert(corners)
    };
    (0..mesh.faces.len()).filter(is_known).collect()
}
