//! Queries of two meshes that move against each other.

use super::hierarchy::{Directions, DopTree, Scratch, contacts, first_hit};
use super::{Components, Nestings, OpenEdge, Pose, nestings};
use crate::exact::{ContactKind, ExactPoint, posed_common};
use crate::mesh::Mesh;
use crate::software::retest::retest_posed_kind;
use rayon::prelude::*;
use std::cell::Cell;
use std::collections::HashSet;
use std::sync::{Arc, OnceLock};

thread_local! {
    /// Memory of the queries of a thread. A query takes it away: while it waits for other threads, its own may begin another one.
    static SCRATCH: Cell<Scratch> = Cell::default();
}

fn with_scratch<T>(query: impl FnOnce(&mut Scratch) -> T) -> T {
    let mut scratch = SCRATCH.take();
    let found = query(&mut scratch);
    SCRATCH.set(scratch);
    found
}

/// A mesh and its tree. Copies share both.
#[derive(Clone, Debug)]
pub struct Body(Arc<Parts>);

#[derive(Debug)]
struct Parts {
    mesh: Mesh,
    tree: DopTree,
    components: OnceLock<Result<Components, OpenEdge>>,
}

impl From<Mesh> for Body {
    fn from(mesh: Mesh) -> Self {
        let tree = DopTree::new(&mesh, Directions::Eighteen);
        Self(Arc::new(Parts { mesh, tree, components: OnceLock::new() }))
    }
}

impl From<&Mesh> for Body {
    fn from(mesh: &Mesh) -> Self {
        mesh.clone().into()
    }
}

impl From<&Body> for Body {
    fn from(body: &Body) -> Self {
        body.clone()
    }
}

impl Body {
    /// The mesh.
    pub fn mesh(&self) -> &Mesh {
        &self.0.mesh
    }

    /// The connected components of the mesh, found when they are first asked for.
    ///
    /// # Errors
    /// If the mesh is not closed.
    pub fn components(&self) -> Result<&Components, OpenEdge> {
        self.0.components.get_or_init(|| Components::new(self.mesh())).as_ref().map_err(|open| *open)
    }

    /// The corners of a triangle.
    pub(crate) fn triangle(&self, face: u32) -> [[f64; 3]; 3] {
        self.mesh().triangle(face as usize).map(Into::into)
    }
}

/// A triangle of A and one of B that have a common point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Contact {
    /// The number of the triangle of A.
    pub a: u32,
    /// The number of the triangle of B.
    pub b: u32,
    /// How they meet.
    pub kind: ContactKind,
}

/// Finds the contacts of two bodies in any pose of B as seen from A, exactly for the twelve numbers of the pose.
#[derive(Clone, Debug)]
pub struct Collider {
    a: Body,
    b: Body,
}

impl Collider {
    /// For two meshes, whose trees are built, or bodies, which have them.
    pub fn new(a: impl Into<Body> + Send, b: impl Into<Body> + Send) -> Self {
        let (a, b) = rayon::join(|| a.into(), || b.into());
        Self { a, b }
    }

    /// All contacts, ascending.
    pub fn contacts(&self, pose: &Pose) -> Vec<Contact> {
        let ([a, b], [p, q]) = ([&self.a.0.mesh, &self.b.0.mesh], [&self.a.0.tree, &self.b.0.tree]);
        let (found, _) = with_scratch(|scratch| contacts([a, b], [p, q], pose, scratch));
        found.into_iter().map(|((a, b), kind)| Contact { a, b, kind }).collect()
    }

    /// Some contact, always the same one, in less time than all of them.
    pub fn first_contact(&self, pose: &Pose) -> Option<Contact> {
        let (m, t) = (pose.rows(), pose.translation.into());
        let mut kind = None;
        let hits = |(p, q): (u32, u32)| {
            kind = retest_posed_kind(&self.a.triangle(p), &self.b.triangle(q), &m, &t).expect("all is finite");
            kind.is_some()
        };
        let (hit, _) = with_scratch(|scratch| first_hit(&self.a.0.tree, &self.b.0.tree, pose, scratch, hits));
        let (a, b) = hit?;
        Some(Contact { a, b, kind: kind? })
    }

    /// All contacts of each pose, by all threads of the current pool.
    pub fn contacts_at(&self, poses: &[Pose]) -> Vec<Vec<Contact>> {
        poses.par_iter().map(|pose| self.contacts(pose)).collect()
    }

    /// Some contact of each pose, by all threads of the current pool.
    pub fn first_contacts_at(&self, poses: &[Pose]) -> Vec<Option<Contact>> {
        poses.par_iter().map(|pose| self.first_contact(pose)).collect()
    }

    /// What two triangles have in common, as [`common`](crate::exact::common()) says it, exact, in the frame of A.
    ///
    /// # Panics
    /// If there are no such triangles.
    pub fn common(&self, contact: &Contact, pose: &Pose) -> Vec<ExactPoint> {
        let (a, b) = (self.a.triangle(contact.a), self.b.triangle(contact.b));
        posed_common(&a, &b, &pose.rows(), &pose.translation.into()).expect("meshes and poses are finite")
    }

    /// The pairs of components (of A, of B) of closed meshes of which one is inside the other without touching it, ascending.
    ///
    /// # Errors
    /// If a mesh is not closed.
    pub fn nestings(&self, pose: &Pose) -> Result<Nestings, OpenEdge> {
        let components = [self.a.components()?, self.b.components()?];
        let touching: HashSet<(u32, u32)> =
            self.contacts(pose).iter().map(|found| (components[0].of(found.a), components[1].of(found.b))).collect();
        Ok(nestings([self.a.mesh(), self.b.mesh()], components, pose, &touching))
    }
}
