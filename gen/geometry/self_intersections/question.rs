//! Triangles that share vertices: what to ask so that the shared vertex or edge alone is no defect
//! (docs/self-intersections.md has the proofs). Whoever answers, the questions are right of every pair, segments and points
//! included.

use super::Kind;
use crate::Points;
use crate::exact::Exact;
use crate::mesh::Mesh;
use crate::software::retest::retest;
use crate::software::robbins_whitesides::{area, is_in_range};

/// Two triangles by their vertices; segments and points repeat one.
pub type Faces = [[u32; 3]; 2];

/// What shows what is wrong with two triangles: of those that share vertices, whether they have a common point elsewhere.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Question {
    /// They share no vertex: how do they lie?
    How(Faces),
    /// They are the same triangle.
    Duplicate,
    /// The relative interiors meet.
    Crosses(Faces),
    /// One of these pairs has a common point.
    Meets(Vec<Faces>),
}

impl Question {
    /// The question about two faces of a mesh that has no two equal vertices.
    pub fn of(mesh: &Mesh, faces: Faces) -> Self {
        let [a, b] = faces.map(distinct);
        let shared: Vec<u32> = a.iter().copied().filter(|vertex| b.contains(vertex)).collect();
        match shared[..] {
            [] => Self::How(faces),
            [v] => {
                let pairs = parts(mesh, v, &a)
                    .into_iter()
                    .flat_map(|x| parts(mesh, v, &b).into_iter().map(move |y| (x.clone(), y)));
                // The ray from v through a common point leaves one of the two opposite v.
                Self::Meets(
                    pairs.flat_map(|(x, y)| [[face(&x), face(&with(v, &y))], [face(&with(v, &x)), face(&y)]]).collect(),
                )
            }
            [v, w] => {
                let third = |of: &[u32]| of.iter().copied().find(|vertex| ![v, w].contains(vertex));
                match (third(&a), third(&b)) {
                    // On one line both, else the edge is all that they have on its line.
                    (Some(p), Some(q)) if [p, q].iter().all(|x| on_a_line(mesh, [v, w, *x])) => {
                        let beyond = |x: &u32| !between(mesh, v, *x, w);
                        let ends = [(p, &b), (q, &a)].into_iter().filter(|(x, _)| beyond(x));
                        Self::Meets(ends.map(|(x, other)| [[x; 3], face(other)]).collect())
                    }
                    (Some(p), Some(q)) if ![p, q].iter().any(|x| on_a_line(mesh, [v, w, *x])) => Self::Crosses(faces),
                    _ => Self::Meets(vec![]),
                }
            }
            _ => Self::Duplicate,
        }
    }

    /// The pairs that are asked about.
    pub fn asked(&self) -> &[Faces] {
        match self {
            Self::Duplicate => &[],
            Self::How(faces) | Self::Crosses(faces) => std::slice::from_ref(faces),
            Self::Meets(parts) => parts,
        }
    }

    /// What is wrong, by the answers to all that is asked.
    pub fn kind(&self, mut answer: impl FnMut(Faces) -> Exact) -> Option<Kind> {
        match self {
            Self::How(faces) => Kind::apart(answer(*faces)),
            Self::Duplicate => Some(Kind::Duplicate),
            Self::Crosses(faces) => (answer(*faces) == Exact::Intersect).then_some(Kind::Neighbours),
            Self::Meets(parts) => {
                // All of them are asked, so that as many pairs are counted as are listed.
                let meets = |parts: &&Faces| answer(**parts) != Exact::Separate;
                (parts.iter().filter(meets).count() > 0).then_some(Kind::Neighbours)
            }
        }
    }
}

/// The corners of two faces.
pub fn points(mesh: &Mesh, faces: Faces) -> Points {
    let [a, b] = faces.map(|face| face.map(|vertex| mesh.vertices()[vertex as usize].into()));
    [a[0], a[1], a[2], b[0], b[1], b[2]]
}

/// How two faces lie to each other, exactly.
pub(super) fn answer(mesh: &Mesh, faces: Faces) -> Exact {
    retest(&points(mesh, faces)).expect("meshes are finite")
}

/// Whether the corners of a face are on one line, exactly.
pub(super) fn on_a_line(mesh: &Mesh, [p, q, r]: [u32; 3]) -> bool {
    let corners: [[f64; 3]; 3] = [p, q, r].map(|vertex| mesh.vertices()[vertex as usize].into());
    if corners.iter().all(is_in_range) {
        return [(0, 1), (1, 2), (2, 0)].into_iter().all(|(i, j)| {
            let [p, q, r] = corners.map(|x| [x[i], x[j]]);
            area(&p, &q, &r) == 0
        });
    }
    // Then one of them is on the segment between the others.
    [[p, q, r], [q, r, p], [r, p, q]].into_iter().any(|[p, q, r]| answer(mesh, [[p, q, q], [r; 3]]) != Exact::Separate)
}

/// The vertices of a face without repetitions.
fn distinct(face: [u32; 3]) -> Vec<u32> {
    let mut vertices = face.to_vec();
    vertices.sort_unstable();
    vertices.dedup();
    vertices
}

/// One to three vertices as a face.
fn face(vertices: &[u32]) -> [u32; 3] {
    [0, 1, 2].map(|i| vertices[i.min(vertices.len() - 1)])
}

fn with(v: u32, others: &[u32]) -> Vec<u32> {
    [&[v], others].concat()
}

/// A triangle without its vertex v: the vertices opposite v. A segment that has v inside has two such ends, each of a part of
/// its own; a point has none.
fn parts(mesh: &Mesh, v: u32, triangle: &[u32]) -> Vec<Vec<u32>> {
    let others: Vec<u32> = triangle.iter().copied().filter(|vertex| *vertex != v).collect();
    match others[..] {
        [] => vec![],
        [p, q] if on_a_line(mesh, [p, q, v]) && between(mesh, p, v, q) => vec![vec![p], vec![q]],
        _ => vec![others],
    }
}

/// Whether, of three vertices on one line, the second is between the others: along a line, points are in lexicographic order.
fn between(mesh: &Mesh, p: u32, x: u32, q: u32) -> bool {
    let [p, x, q]: [[f64; 3]; 3] = [p, x, q].map(|vertex| mesh.vertices()[vertex as usize].into());
    (p <= x && x <= q) || (q <= x && x <= p)
}
