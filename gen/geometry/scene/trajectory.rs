//! Trajectories: poses between key frames.

use super::Pose;
use super::rotation::{Rotation, about, axis_angle, quaternion, unit};
use crate::mesh::angle::sin_cos_degrees;
use nalgebra::{Matrix3, Vector3, Vector4};

/// Objects that move at the same time, each along its own key frames.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Trajectory {
    pub label: String,
    /// At least two: the first is at the earliest key, the last at the latest, the others evenly between.
    pub frames: u32,
    pub tracks: Vec<Track>,
}

/// The way of one object.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Track {
    pub object: usize,
    /// In ascending order of time, at least one.
    pub keys: Vec<Key>,
}

/// A pose at a time.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Key {
    pub time: f64,
    /// No matrix: it has nothing to turn between.
    pub rotation: Rotation,
    /// The point of the object about which the rotation turns.
    pub about: Vector3<f64>,
    pub translation: Vector3<f64>,
}

impl Trajectory {
    /// The poses of frame `frame`, object by object.
    pub fn poses(&self, frame: u32) -> impl Iterator<Item = (usize, Pose)> + '_ {
        let ends = self.tracks.iter().flat_map(|track| track.keys.first().into_iter().chain(track.keys.last()));
        let (first, last) = ends.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, greatest), key| {
            (least.min(key.time), greatest.max(key.time))
        });
        let time = mix(first, last, f64::from(frame) / f64::from(self.frames - 1));
        self.tracks.iter().map(move |track| (track.object, track.pose(time)))
    }
}

impl Track {
    /// The pose at a time; before the first key and after the last one the object rests.
    fn pose(&self, time: f64) -> Pose {
        let after = self.keys.partition_point(|key| key.time <= time);
        let [from, to] = [after.saturating_sub(1), after.min(self.keys.len() - 1)].map(|index| &self.keys[index]);
        let span = to.time - from.time;
        let part = if span > 0.0 { (time - from.time) / span } else { 0.0 };
        let vector = |x: &Vector3<f64>, y: &Vector3<f64>| x.zip_map(y, |x, y| mix(x, y, part));
        let rotation = between(&from.rotation, &to.rotation, part);
        let (centre, translation) = (vector(&from.about, &to.about), vector(&from.translation, &to.translation));
        Pose { rotation, translation: about(&centre, &rotation, &translation) }
    }
}

/// Between two numbers; exactly the one at 0 and the other at 1.
fn mix(x: f64, y: f64, part: f64) -> f64 {
    x * (1.0 - part) + y * part
}

/// Between two rotations. About the same axis the angle is interpolated, so that several turns are possible; otherwise
/// the unit quaternions are, along the shorter arc, which keeps the path of the spherical interpolation but not its
/// even speed. (That one needs an arc cosine, which is not the same bits everywhere.)
fn between(from: &Rotation, to: &Rotation, part: f64) -> Matrix3<f64> {
    let turn = match (*from, *to) {
        (Rotation::AxisAngle(axis, x), Rotation::AxisAngle(other, y)) if axis == other => Some((axis, x, y)),
        (Rotation::AxisAngle(axis, x), Rotation::None) => Some((axis, x, 0.0)),
        (Rotation::None, Rotation::AxisAngle(axis, y)) => Some((axis, 0.0, y)),
        _ => None,
    };
    match turn {
        Some((axis, x, y)) => axis_angle(axis, mix(x, y, part)),
        None if part == 0.0 => from.matrix(),
        None => {
            let (p, q) = (unit_quaternion(from), unit_quaternion(to));
            let q = if p.dot(&q) < 0.0 { -q } else { q };
            quaternion((p * (1.0 - part) + q * part).into())
        }
    }
}

/// (w, x, y, z) of length 1; of a matrix, which a key cannot have, that of no rotation.
fn unit_quaternion(rotation: &Rotation) -> Vector4<f64> {
    let q = match *rotation {
        Rotation::None | Rotation::Matrix(_) => Vector4::new(1.0, 0.0, 0.0, 0.0),
        Rotation::AxisAngle(axis, degrees) => {
            let (s, c) = sin_cos_degrees(degrees / 2.0);
            let v = unit(axis) * s;
            Vector4::new(c, v.x, v.y, v.z)
        }
        Rotation::Quaternion(q) => {
            let q = Vector4::from(q);
            q / q.amax()
        }
    };
    q / q.norm()
}
