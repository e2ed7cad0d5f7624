//! The stages before the unit: what they leave for it.

use efsat_geometry::collide::hierarchy::Directions;
use efsat_geometry::scene::{Meeting, Near, Scene};
use serde::Serialize;

/// Which stages there are before the unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Software {
    /// Sort and sweep over the objects; without it every two objects meet.
    pub broad_phase: bool,
    /// Trees of k-DOPs; without them all pairs of triangles of two objects that meet survive.
    pub hierarchy: bool,
    /// Pairs with a degenerate triangle are answered at once, exactly; without it they go to the unit.
    pub degenerate: bool,
}

/// The stages before the unit, made ready for a scene.
#[derive(Clone, Debug)]
pub struct Front<'a> {
    /// What finds the pairs.
    pub near: Near<'a>,
    software: Software,
    /// Which triangles are degenerate, by mesh, and which mesh each object has.
    degenerate: Vec<Vec<bool>>,
    mesh_of: Vec<usize>,
}

impl<'a> Front<'a> {
    /// Prepares a scene.
    pub fn new(scene: &'a Scene, software: Software, directions: Directions) -> Self {
        let near = Near::by_dops(scene, software.broad_phase, software.hierarchy.then_some(directions));
        let (meshes, mesh_of) = scene.meshes();
        let flags = |mesh: &&efsat_geometry::mesh::Mesh| {
            let mut flags = vec![false; mesh.faces().len()];
            mesh.degenerate().into_iter().for_each(|face| flags[face] = true);
            flags
        };
        Self { near, software, degenerate: meshes.iter().map(flags).collect(), mesh_of }
    }

    /// Which stages there are.
    pub fn software(&self) -> Software {
        self.software
    }

    /// The scene.
    pub fn scene(&self) -> &'a Scene {
        self.near.scene()
    }

    /// All triangles of all objects, and the degenerate ones among them.
    pub fn triangles(&self) -> (u64, u64) {
        let flags = || self.mesh_of.iter().flat_map(|&mesh| &self.degenerate[mesh]);
        (flags().count() as u64, flags().filter(|flag| **flag).count() as u64)
    }

    /// Whether a triangle of a pair is degenerate.
    pub fn is_degenerate(&self, meeting: &Meeting, pair: (u32, u32)) -> bool {
        let [a, b] = meeting.meshes.map(|mesh| &self.degenerate[mesh]);
        a[pair.0 as usize] || b[pair.1 as usize]
    }

    /// Whether a pair is answered here and does not go to the unit.
    pub fn answers(&self, meeting: &Meeting, pair: (u32, u32)) -> bool {
        self.software.degenerate && self.is_degenerate(meeting, pair)
    }
}
