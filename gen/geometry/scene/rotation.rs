//! Rotations, and the ways to say them.

use crate::mesh::angle::sin_cos_degrees;
use nalgebra::{Matrix3, Vector3};

/// A rotation as written in a scene file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Rotation {
    /// None given.
    None,
    /// Nine numbers, whatever they are.
    Matrix(Matrix3<f64>),
    /// An axis other than zero, and an angle in degrees.
    AxisAngle(Vector3<f64>, f64),
    /// (w, x, y, z), not all zero.
    Quaternion([f64; 4]),
}

impl Rotation {
    pub fn matrix(&self) -> Matrix3<f64> {
        match *self {
            Self::None => Matrix3::identity(),
            Self::Matrix(m) => m,
            Self::AxisAngle(axis, degrees) => axis_angle(axis, degrees),
            Self::Quaternion(q) => quaternion(q),
        }
    }
}

/// The translation with which a rotation leaves `centre` where `translation` alone would take it.
pub(super) fn about(centre: &Vector3<f64>, rotation: &Matrix3<f64>, translation: &Vector3<f64>) -> Vector3<f64> {
    translation + (centre - rotation * centre)
}

/// Step `step` of `steps` of a full turn about the z and the x axis: Rx(w) Rz(w) with w = 360 step / steps degrees.
/// Every entry is at most one product of a sine and a cosine, so none exceeds 1.
pub(super) fn tumbled(step: u32, steps: u32) -> Matrix3<f64> {
    let (s, c) = sin_cos_degrees(360.0 * f64::from(step) / f64::from(steps));
    Matrix3::new(c, -s, 0.0, c * s, c * c, -s, s * s, s * c, c)
}

/// The vector of length 1 in a direction other than zero.
pub(super) fn unit(direction: Vector3<f64>) -> Vector3<f64> {
    let scaled = direction / direction.amax();
    scaled / scaled.norm()
}

/// The rotation by `degrees` about `axis` (which need not have unit length), right-handed.
pub(crate) fn axis_angle(axis: Vector3<f64>, degrees: f64) -> Matrix3<f64> {
    let k = unit(axis);
    let (s, c) = sin_cos_degrees(degrees);
    within_one(Matrix3::from_diagonal_element(c) + k.cross_matrix() * s + k * k.transpose() * (1.0 - c))
}

/// The rotation of the quaternion (w, x, y, z), which need not have unit length.
pub(super) fn quaternion(q: [f64; 4]) -> Matrix3<f64> {
    let greatest = q.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    let [w, x, y, z] = q.map(|entry| entry / greatest);
    let v = Vector3::new(x, y, z);
    let s = 2.0 / (w * w + v.norm_squared());
    let cross = v.cross_matrix();
    within_one(Matrix3::identity() + (cross * w + cross * cross) * s)
}

/// Removes the rounding errors that stick out of [-1, 1], where the entries of a rotation are.
fn within_one(m: Matrix3<f64>) -> Matrix3<f64> {
    m.map(|x| x.clamp(-1.0, 1.0))
}
