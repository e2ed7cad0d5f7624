//! Triangles that share vertices: what to ask so that the shared vertex or edge alone is no defect
//! (docs/self-intersections.md has the proofs).

use efsat_geometry::mesh::Mesh;

/// What shows what is wrong with two triangles: of those that share vertices, whether they have a common point elsewhere.
/// Triangles are named by their vertices; segments and points repeat one.
pub(super) enum Question {
    /// They share no vertex: how do they lie?
    How,
    /// They are the same triangle.
    Duplicate,
    /// The relative interiors meet.
    Crosses,
    /// One of these pairs has a common point.
    Meets(Vec<[[u32; 3]; 2]>),
}

/// The question about two faces that share a vertex at least.
pub(super) fn question(mesh: &Mesh, faces: [[u32; 3]; 2]) -> Question {
    let [a, b] = faces.map(distinct);
    let shared: Vec<u32> = a.iter().copied().filter(|vertex| b.contains(vertex)).collect();
    match shared[..] {
        [v] => {
            let pairs = parts(mesh, v, &a)
                .into_iter()
                .flat_map(|x| parts(mesh, v, &b).into_iter().map(move |y| (x.clone(), y)));
            // The ray from v through a common point leaves one of the two opposite v.
            Question::Meets(
                pairs.flat_map(|(x, y)| [[face(&x), face(&with(v, &y))], [face(&with(v, &x)), face(&y)]]).collect(),
            )
        }
        [v, w] => {
            let third = |of: &[u32]| of.iter().copied().find(|vertex| ![v, w].contains(vertex));
            match (third(&a), third(&b)) {
                // On one line both, else the edge is all that they have on its line.
                (Some(p), Some(q)) if [p, q].iter().all(|x| on_a_line(mesh, v, w, *x)) => {
                    let beyond = |x: &u32| !between(mesh, v, *x, w);
                    let ends = [(p, &b), (q, &a)].into_iter().filter(|(x, _)| beyond(x));
                    Question::Meets(ends.map(|(x, other)| [[x; 3], face(other)]).collect())
                }
                (Some(p), Some(q)) if ![p, q].iter().any(|x| on_a_line(mesh, v, w, *x)) => Question::Crosses,
                _ => Question::Meets(vec![]),
            }
        }
        _ => Question::Duplicate,
    }
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
        [p, q] if on_a_line(mesh, p, q, v) && between(mesh, p, v, q) => vec![vec![p], vec![q]],
        _ => vec![others],
    }
}

/// The difference of two vertices, in whole units.
fn difference(mesh: &Mesh, from: u32, to: u32) -> [i128; 3] {
    let [from, to] = [from, to].map(|vertex| mesh.vertices()[vertex as usize]);
    [0, 1, 2].map(|axis| to[axis] as i128 - from[axis] as i128)
}

/// Whether three vertices are on one line.
fn on_a_line(mesh: &Mesh, p: u32, q: u32, x: u32) -> bool {
    let (u, v) = (difference(mesh, p, q), difference(mesh, p, x));
    (0..3).all(|i| u[(i + 1) % 3] * v[(i + 2) % 3] == u[(i + 2) % 3] * v[(i + 1) % 3])
}

/// Whether, of three vertices on one line, the second is between the others.
fn between(mesh: &Mesh, p: u32, x: u32, q: u32) -> bool {
    let (u, v) = (difference(mesh, x, p), difference(mesh, x, q));
    (0..3).map(|i| u[i] * v[i]).sum::<i128>() <= 0
}
