//! Scenes that no file describes: objects at rest, and one mesh that tumbles in front of itself.

use super::motion::{Motion, Tumble};
use super::{InvalidScene, Object, Pose, Scene};
use crate::mesh::{Findings, Mesh};
use nalgebra::Vector3;
use std::sync::Arc;

impl Scene {
    /// The steps of a turn of the default scene.
    pub const STEPS: u32 = 360;
    /// The distances of the default scene, in half-sizes of the cube.
    pub const DISTANCES: [f64; 7] = [1.6, 1.575, 1.55, 1.525, 1.5, 1.475, 1.45];

    /// Objects that stay where they are placed, in one frame.
    ///
    /// # Errors
    /// If an object but the last one is distorted, or a pose is too far away.
    pub fn at_rest(name: impl Into<String>, objects: Vec<Object>) -> Result<Self, InvalidScene> {
        let motions = vec![Motion::Rest];
        Self { name: name.into(), objects, effects: vec![], parameters: vec![], motions, files: vec![] }.checked()
    }

    /// A mesh against itself in a tumbling turn, the direction that of the default scene: along z.
    ///
    /// # Errors
    /// If a pose is too far away, which is so for a mesh or a distance that is too large, and for one that is no number.
    pub fn against_itself(
        name: impl Into<String>,
        mesh: Mesh,
        steps: u32,
        distances: &[f64],
    ) -> Result<Self, InvalidScene> {
        let mesh = Arc::new(mesh);
        let object = |name: &str| Object {
            name: name.to_owned(),
            mesh: Arc::clone(&mesh),
            findings: Findings::default(),
            placed: Pose::identity(),
        };
        let tumble = Tumble::about(&object("a"), &object("b"), 1, steps, distances.to_vec(), Vector3::z());
        let objects = vec![object("a"), object("b")];
        let motions = vec![Motion::Tumble(tumble)];
        Self { name: name.into(), objects, effects: vec![], parameters: vec![], motions, files: vec![] }.checked()
    }
}
