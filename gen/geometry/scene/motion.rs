//! What moves in a scene: sweeps, single poses and trajectories, as rules from which every frame is made anew, so that
//! memory does not grow with the number of frames.

use super::Object;
use super::Pose;
use super::rotation::{tumbled, unit};
use super::trajectory::Trajectory;
use nalgebra::{Point3, Vector3};

/// A part of the motion of a scene: a sequence of frames.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Motion {
    /// One frame in which all objects stay where they are placed.
    Rest,
    /// A turn at several distances.
    Tumble(Tumble),
    /// One frame in which one object stands elsewhere.
    Single { label: String, object: usize, pose: Pose },
    /// Objects along key frames.
    Trajectory(Trajectory),
}

/// A full turn of one object about the z and the x axis through the centre of its bounding box, in equal steps, at each
/// of several distances from another one: the benchmark procedure of the paper's group.
///
/// A distance is that between the centres of the bounding boxes, in half-sizes of the cube that both meshes fit: half
/// the longest edge of the larger box. Distances come in the order given, the steps of one distance together.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tumble {
    /// What turns.
    pub object: usize,
    pub steps: u32,
    pub distances: Vec<f64>,
    /// The centre of its box, in its own frame.
    pub centre: Point3<f64>,
    /// Where that would be at distance 0.
    pub origin: Point3<f64>,
    /// The way of its centre for a distance of 1.
    pub offset: Vector3<f64>,
}

/// What changes in a frame.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Change {
    pub label: String,
    pub distance: Option<f64>,
    /// Objects and where they stand; the others stand where they are placed.
    pub poses: Vec<(usize, Pose)>,
}

impl Motion {
    /// The number of frames.
    pub fn frames(&self) -> usize {
        match self {
            Self::Rest | Self::Single { .. } => 1,
            Self::Tumble(tumble) => tumble.distances.len() * tumble.steps as usize,
            Self::Trajectory(trajectory) => trajectory.frames as usize,
        }
    }

    /// Frame `frame`, which there is.
    pub fn change(&self, frame: usize) -> Change {
        match self {
            Self::Rest => Change { label: "as placed".to_owned(), distance: None, poses: vec![] },
            Self::Tumble(tumble) => tumble.change(frame),
            Self::Single { label, object, pose } => {
                Change { label: label.clone(), distance: None, poses: vec![(*object, *pose)] }
            }
            Self::Trajectory(trajectory) => Change {
                label: format!("{} {frame}", trajectory.label),
                distance: None,
                poses: trajectory.poses(frame as u32).collect(),
            },
        }
    }
}

impl Tumble {
    /// The turn of `object`, number `index`, about `fixed`.
    pub fn about(
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
            offset: unit(direction) * reach,
        }
    }

    fn change(&self, frame: usize) -> Change {
        let (distance, step) = (self.distances[frame / self.steps as usize], frame as u32 % self.steps);
        let rotation = tumbled(step, self.steps);
        let translation = self.origin.coords + self.offset * distance - rotation * self.centre.coords;
        Change {
            label: format!("distance {distance} step {step}"),
            distance: Some(distance),
            poses: vec![(self.object, Pose { rotation, translation })],
        }
    }
}
