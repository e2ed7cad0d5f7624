//! Scenes of one mesh: it tumbles in front of itself.

use super::{tumble, Scene};
use crate::mesh::Mesh;
use nalgebra::Vector3;
use std::sync::Arc;

impl Scene {
    /// The steps of a turn of the default scene.
    pub const STEPS: u32 = 360;
    /// The distances of the default scene, in half-sizes of the cube.
    pub const DISTANCES: [f64; 7] = [1.6, 1.575, 1.55, 1.525, 1.5, 1.475, 1.45];

    /// A mesh against itself in the poses of [`tumble`], the direction that of the default scene: along z.
    pub fn against_itself(name: impl Into<String>, mesh: Mesh, steps: u32, distances: &[f64]) -> Self {
        let poses = tumble(&mesh, &mesh, steps, distances, Vector3::z());
        let mesh = Arc::new(mesh);
        Self { name: name.into(), a: Arc::clone(&mesh), b: mesh, poses }
    }
}
