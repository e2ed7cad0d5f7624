//! Which connected components of closed meshes lie inside others.
//!
//! A mesh is *closed* if every edge borders an even number of its triangles, edges with the same two ends being one. Then each of its
//! components divides space: a point that is not on it is inside if a ray from there crosses the component an odd number of times. No
//! matter how the triangles are oriented, or which pose the mesh is in, for an affine image of a closed surface is closed.
//!
//! Two components that have no common point lie inside each other or apart as a whole, because each of them is connected; so one point
//! tells it, and exact arithmetic tells it of the point ([`crosses`]). At most one of the two is inside the other: a point of both that
//! is farthest along x is not inside the one that it does not belong to.

use super::enclosure::image;
use super::pose::Pose;
use crate::exact::{Motion, Scaled, crosses};
use crate::mesh::{Bounds, Mesh};
use std::collections::{BTreeSet, HashMap, HashSet};
use std::fmt;

/// The connected components of a closed mesh: triangles that have a vertex in common, directly or by way of others. Vertices that are
/// equal as points are one.
#[derive(Clone, Debug)]
pub struct Components {
    /// The component of each triangle.
    of_face: Vec<u32>,
    /// The triangles of each component, ascending.
    faces: Vec<Vec<u32>>,
}

/// An edge that shows that a mesh is not closed.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub struct OpenEdge {
    /// The first triangle at it, counted from 0.
    pub triangle: u32,
    /// Its ends.
    pub ends: [[f64; 3]; 2],
    /// How many triangles are at it.
    pub count: u32,
}

impl fmt::Display for OpenEdge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { triangle, ends: [[x, y, z], [u, v, w]], count } = self;
        write!(
            f,
            "the mesh is open: at the edge of triangle {triangle} from {x} {y} {z} to {u} {v} {w} the number of triangles is {count}, \
             expected an even number"
        )
    }
}

/// How two components without a common point lie, if they are not apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Nesting {
    /// That of A is inside that of B.
    AInB,
    /// That of B is inside that of A.
    BInA,
}

impl Components {
    /// The components of a mesh, in the order of their first triangles.
    ///
    /// # Errors
    /// If the mesh is not closed: the open edge of the first triangle that has one.
    pub fn new(mesh: &Mesh) -> Result<Self, OpenEdge> {
        let points = merged(mesh);
        let corners = |face: usize| mesh.faces()[face].map(|vertex| points[vertex as usize]);
        // An edge from a point to itself is its own opposite, and bounds nothing.
        let edges = |face: usize| {
            let [p, q, r] = corners(face);
            [(p, q), (q, r), (r, p)].map(|(p, q)| (p.min(q), p.max(q))).into_iter().filter(|(p, q)| p != q)
        };
        let mut counts: HashMap<(u32, u32), u32> = HashMap::new();
        for edge in (0..mesh.faces().len()).flat_map(edges) {
            *counts.entry(edge).or_default() += 1;
        }
        for face in 0..mesh.faces().len() {
            if let Some(edge) = edges(face).find(|edge| counts[edge] % 2 == 1) {
                let ends = [edge.0, edge.1].map(|vertex| mesh.vertices()[vertex as usize].into());
                return Err(OpenEdge { triangle: face as u32, ends, count: counts[&edge] });
            }
        }
        let mut parents: Vec<u32> = (0..points.len() as u32).collect();
        for face in 0..mesh.faces().len() {
            let roots = corners(face).map(|point| root(&mut parents, point));
            parents[roots[1] as usize] = roots[0];
            // The first union may have moved it.
            let last = root(&mut parents, roots[2]);
            parents[last as usize] = roots[0];
        }
        let mut numbers = HashMap::new();
        let (mut of_face, mut faces) = (vec![], vec![]);
        for face in 0..mesh.faces().len() {
            let component = *numbers.entry(root(&mut parents, corners(face)[0])).or_insert_with(|| {
                faces.push(vec![]);
                faces.len() - 1
            });
            of_face.push(component as u32);
            faces[component].push(face as u32);
        }
        Ok(Self { of_face, faces })
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.faces.len()
    }

    /// Whether the mesh has no triangle.
    pub fn is_empty(&self) -> bool {
        self.faces.is_empty()
    }

    /// Around each component so many others are, none of which it has a common point with.
    pub(crate) fn depths(&self, mesh: &Mesh) -> Vec<usize> {
        let placed = Placed::new(mesh, self, &Pose::identity());
        let around = |inner: usize| {
            let others = (0..self.len()).filter(|other| *other != inner && placed.overlap(*other, &placed, inner));
            others.filter(|other| placed.holds(*other, &placed, inner)).count()
        };
        (0..self.len()).map(around).collect()
    }

    /// Whether a component of one of two solids that touches nothing of the other one is inside it, with B in `pose`.
    pub(crate) fn enter(
        meshes: [&Mesh; 2],
        components: [&Self; 2],
        pose: &Pose,
        touching: &[BTreeSet<u32>; 2],
    ) -> bool {
        let placed =
            [Placed::new(meshes[0], components[0], &Pose::identity()), Placed::new(meshes[1], components[1], pose)];
        [0, 1].into_iter().any(|side| {
            let [own, other] = [&placed[side], &placed[1 - side]];
            let is_inside = |inner: usize| {
                let around = (0..other.boxes.len()).filter(|outer| other.overlap(*outer, own, inner));
                around.filter(|outer| other.holds(*outer, own, inner)).count() % 2 == 1
            };
            (0..own.boxes.len()).any(|inner| !touching[side].contains(&(inner as u32)) && is_inside(inner))
        })
    }

    /// The component that a triangle belongs to.
    ///
    /// # Panics
    /// If there is no such triangle.
    pub fn of(&self, face: u32) -> u32 {
        self.of_face[face as usize]
    }
}

/// For each vertex the first one that is equal to it.
fn merged(mesh: &Mesh) -> Vec<u32> {
    let mut known = HashMap::new();
    // Adding zero makes one of the two zeros.
    let key = |v: &nalgebra::Point3<f64>| <[f64; 3]>::from(*v).map(|x| (x + 0.0).to_bits());
    (0..).zip(mesh.vertices()).map(|(index, v)| *known.entry(key(v)).or_insert(index)).collect()
}

/// The root of a point, with shorter ways for later.
fn root(parents: &mut [u32], mut point: u32) -> u32 {
    while parents[point as usize] != point {
        parents[point as usize] = parents[parents[point as usize] as usize];
        point = parents[point as usize];
    }
    point
}

/// Pairs of components (of A, of B), ascending, and which of both is inside the other.
pub type Nestings = Vec<((u32, u32), Nesting)>;

/// The pairs of components (of A, of B) of which one is inside the other with B in `pose` as seen from A, ascending. Those that have
/// a common point are given, and are never among them.
///
/// # Panics
/// If the components are not those of the meshes.
pub fn nestings(
    meshes: [&Mesh; 2],
    components: [&Components; 2],
    pose: &Pose,
    touching: &HashSet<(u32, u32)>,
) -> Nestings {
    let [a, b] =
        [(0, &Pose::identity()), (1, pose)].map(|(side, pose)| Placed::new(meshes[side], components[side], pose));
    let count = |side: usize| components[side].len() as u32;
    let pairs = (0..count(0)).flat_map(|p| (0..count(1)).map(move |q| (p, q)));
    let nesting = |pair: (u32, u32)| {
        let (p, q) = (pair.0 as usize, pair.1 as usize);
        if touching.contains(&pair) || !a.overlap(p, &b, q) {
            return None;
        }
        let found = if a.holds(p, &b, q) {
            Nesting::BInA
        } else if b.holds(q, &a, p) {
            Nesting::AInB
        } else {
            return None;
        };
        Some((pair, found))
    };
    pairs.filter_map(nesting).collect()
}

/// A mesh in the frame of A.
struct Placed<'a> {
    mesh: &'a Mesh,
    components: &'a Components,
    motion: Motion,
    /// What surely holds each vertex, and each component.
    vertices: Vec<Bounds>,
    boxes: Vec<Bounds>,
}

impl<'a> Placed<'a> {
    fn new(mesh: &'a Mesh, components: &'a Components, pose: &Pose) -> Self {
        let motion = Motion::new(&pose.rows(), &pose.translation.into());
        let vertices: Vec<Bounds> = mesh.vertices().iter().map(|v| image(v, pose)).collect();
        let union = |faces: &Vec<u32>| {
            let corners = faces.iter().flat_map(|&face| mesh.faces()[face as usize]);
            corners.fold(Bounds::empty(), |sum, vertex| sum.union(&vertices[vertex as usize]))
        };
        let boxes = components.faces.iter().map(union).collect();
        Self { mesh, components, motion, vertices, boxes }
    }

    /// The exact place of a vertex.
    fn place(&self, vertex: u32) -> [Scaled; 3] {
        self.motion.image(&self.mesh.vertices()[vertex as usize].into())
    }

    /// Whether the boxes of one of its components and one of another mesh overlap.
    fn overlap(&self, component: usize, other: &Placed<'_>, of_other: usize) -> bool {
        self.boxes[component].overlaps(&other.boxes[of_other])
    }

    /// Whether one component of it is around one of another, if they have no common point.
    fn holds(&self, component: usize, other: &Placed<'_>, inner: usize) -> bool {
        let point = other.mesh.faces()[other.components.faces[inner][0] as usize][0];
        let near = &other.vertices[point as usize];
        if !self.boxes[component].overlaps(near) {
            return false;
        }
        let point = other.place(point);
        // Triangles that surely are not on the ray, nor on one beside it, need no exact arithmetic.
        let is_near = |face: &&u32| {
            let corners = self.mesh.faces()[**face as usize].map(|vertex| &self.vertices[vertex as usize]);
            let bounds = corners.into_iter().fold(Bounds::empty(), |sum, corner| sum.union(corner));
            let meets = |axis: usize| bounds.min[axis] <= near.max[axis] && near.min[axis] <= bounds.max[axis];
            meets(1) && meets(2) && near.min.x <= bounds.max.x
        };
        let crossed = |face: &&u32| {
            let triangle = self.mesh.faces()[**face as usize].map(|vertex| self.place(vertex));
            crosses(&point, &triangle)
        };
        self.components.faces[component].iter().filter(is_near).filter(crossed).count() % 2 == 1
    }
}

#[cfg(test)]
mod tests;
