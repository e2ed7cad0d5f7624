//! What was found wrong with the faces of a mesh.

use super::Mesh;
use super::build::Faults;
use robust::{Coord, orient2d};
use std::collections::HashSet;
use std::fmt;
use std::sync::Arc;

/// What can be wrong with a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "scenes", derive(serde::Serialize), serde(rename_all = "snake_case"))]
pub enum Defect {
    /// Fewer than three corners: left out.
    FewCorners,
    /// A vertex that is not in the file: left out.
    OutOfRange,
    /// A coordinate that is infinite or no number: left out.
    NonFinite,
    /// A polygon that is not simple along any coordinate axis: left out.
    NotSimple,
    /// A polygon whose corners are not exactly in one plane: kept, as triangles that its corners do not settle.
    NotPlanar,
    /// Corners on one line, exactly: kept, as the segment or point that it is.
    Degenerate,
    /// The same three corners as an earlier face, in any order: kept.
    Duplicate,
}

impl Defect {
    /// All of them; those whose faces are left out come first.
    pub const ALL: [Self; 7] = [
        Self::FewCorners,
        Self::OutOfRange,
        Self::NonFinite,
        Self::NotSimple,
        Self::NotPlanar,
        Self::Degenerate,
        Self::Duplicate,
    ];

    /// Whether a face of that kind stays in the mesh.
    pub fn is_kept(self) -> bool {
        matches!(self, Self::NotPlanar | Self::Degenerate | Self::Duplicate)
    }

    /// What a count of such faces is called.
    fn words(self) -> &'static str {
        match self {
            Self::FewCorners => "with fewer than three corners",
            Self::OutOfRange => "with a vertex out of range",
            Self::NonFinite => "with a coordinate that is not finite",
            Self::NotSimple => "with a polygon that is not simple",
            Self::NotPlanar => "not exactly in one plane",
            Self::Degenerate => "degenerate",
            Self::Duplicate => "duplicate",
        }
    }
}

/// How often a defect was found, and where first.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "scenes", derive(serde::Serialize))]
pub struct Finding {
    /// What was found.
    pub defect: Defect,
    /// The number of faces.
    pub count: u64,
    /// The first of them, in words.
    pub first: String,
}

/// What a reader did not take as part of the mesh, or took otherwise than the file says: how often, and where first.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "scenes", derive(serde::Serialize))]
pub struct Remark {
    /// What it is.
    pub what: &'static str,
    /// How often it was found.
    pub count: u64,
    /// The first of them: line and text.
    pub first: String,
}

/// The triangles of a mesh by the faces of its file: which face each one is of, and which triangle of that face.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Numbers {
    /// Face and part of each triangle; empty if every triangle is the face of its own number.
    list: Arc<Vec<[u32; 2]>>,
    /// Whether a face is more than one triangle.
    split: bool,
}

impl Numbers {
    /// The number of the face in its file, counted from 0 and with the faces that were left out, and which of its triangles
    /// it is, counted from 0: 0 for a face that is a triangle.
    pub fn of(&self, triangle: u32) -> [u32; 2] {
        self.list.get(triangle as usize).copied().unwrap_or([triangle, 0])
    }

    /// Whether every triangle is the face of its own number.
    pub fn are_plain(&self) -> bool {
        self.list.is_empty()
    }

    /// Whether a face is more than one triangle.
    pub fn are_split(&self) -> bool {
        self.split
    }

    /// A triangle as text: the number of its face, behind a point that of its part if faces are split.
    pub fn name(&self, triangle: u32) -> String {
        let [face, part] = self.of(triangle);
        if self.are_split() { format!("{face}.{part}") } else { face.to_string() }
    }

    /// The face and part of triangle number `triangle`, the next one.
    pub(super) fn push(&mut self, triangle: usize, face: u32, part: u32) {
        if self.list.is_empty() && triangle as u32 == face && part == 0 {
            return;
        }
        self.split |= part > 0;
        let list = Arc::make_mut(&mut self.list);
        list.extend((list.len() as u32..triangle as u32).map(|plain| [plain, 0]));
        list.push([face, part]);
    }
}

/// Everything found in a mesh file that its triangles do not show; it prints as one line.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "scenes", derive(serde::Serialize))]
pub struct Findings {
    /// One entry for each defect that was found, in the order of [`Defect::ALL`].
    pub list: Vec<Finding>,
    /// What else there is to say.
    pub remarks: Vec<Remark>,
    /// The faces that the triangles are of.
    #[cfg_attr(feature = "scenes", serde(skip))]
    pub numbers: Numbers,
}

impl Findings {
    /// Looks at the faces of a mesh, and takes the faults that its reader found.
    pub(super) fn of(mesh: &Mesh, faults: &Faults, remarks: Vec<Remark>, numbers: Numbers) -> Self {
        let found = |defect: Defect| {
            let listed = |list: Vec<usize>| {
                let first = format!("triangle {}", numbers.name(*list.first()? as u32));
                Some(Finding { defect, count: list.len() as u64, first })
            };
            match defect {
                Defect::Degenerate => listed(degenerate(mesh)),
                Defect::Duplicate => listed(duplicates(mesh)),
                _ => {
                    let (_, count, fault) = faults.0.iter().find(|(known, ..)| *known == defect)?;
                    Some(Finding { defect, count: *count, first: fault.brief() })
                }
            }
        };
        Self { list: Defect::ALL.into_iter().filter_map(found).collect(), remarks, numbers }
    }

    /// Looks at the faces of a mesh that was not read from a file.
    pub fn of_mesh(mesh: &Mesh) -> Self {
        Self::of(mesh, &Faults::default(), vec![], Numbers::default())
    }

    /// Whether the mesh is not simply what the faces of the file say, so that a command has to say so.
    pub fn must_be_said(&self) -> bool {
        let is_said = |finding: &Finding| !finding.defect.is_kept() || finding.defect == Defect::NotPlanar;
        !self.remarks.is_empty() || self.list.iter().any(is_said)
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
        let remark = |Remark { what, count, first }: &Remark| match count {
            1 => format!("{what} ({first})"),
            _ => format!("{what}, {count} times (first: {first})"),
        };
        let parts: Vec<String> = parts.into_iter().flatten().chain(self.remarks.iter().map(remark)).collect();
        f.write_str(&parts.join("; "))
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
    // Numbers of vertices take a sixth of the room of coordinates.
    let Mesh { faces, .. } = mesh.welded();
    let mut known = HashSet::new();
    let is_known = |face: &usize| {
        let mut corners = faces[*face];
        corners.sort_unstable();
        !known.insert(corners)
    };
    (0..faces.len()).filter(is_known).collect()
}
