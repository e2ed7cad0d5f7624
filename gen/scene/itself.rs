//! Scenes of one mesh: it tumbles in front of itself.

use super::motion::{Motion, Tumble};
use super::{Object, Pose, Scene};
use crate::mesh::{Findings, Mesh};
use nalgebra::Vector3;
use std::sync::Arc;

impl Scene {
    /// The steps of a turn of the default scene.
    pub const STEPS: u32 = 360;
    /// The distances of the default scene, in half-sizes of the cube.
    pub const DISTANCES: [f64; 7] = [1.6, 1.575, 1.55, 1.525, 1.5, 1.475, 1.45];

    /// A mesh against itself in a tumbling turn, the direction that of the default scene: along z.
    pub fn against_itself(name: impl Into<String>, mesh: Mesh, steps: u32, distances: &[f64]) -> Self {
        let mesh = Arc::new(mesh);
        let object = |name: &str| Object {
            name: name.to_owned(),
            mesh: Arc::clone(&mesh),
            findings: Findings::default(),
            placed: Pose::identity(),
        };
        let tumble = Tumble::about(&object("a"), &object("b"), 1, steps, distances.to_vec(), Vector3::z());
        Self { name: name.into(), objects: vec![object("a"), object("b")], motions: vec![Motion::Tumble(tumble)] }
    }
}

impl Tumble {
    /// The turn of `object`, number `index`, about `fixed`.
    pub(super) fn about(
        fixed: &Object,
        object: &Object,
        index: usize,
        steps: u32,
        distances: Vec<f64>,
        direction: Vector3<f64>,
    ) -> Self {
        let boxes = [fixed, object].map(|object| object.mesh.bounds());
        let reach = boxes[0].half_size().max(boxes[1].half_size());
        Self {
            object: index,
            steps,
            distances,
            centre: boxes[1].centre(),
            origin: fixed.placed.image(&boxes[0].centre()),
            offset: super::pose::unit(direction) * reach,
        }
    }
}
