//! Poses: where an object stands, and the ways to say it.

use crate::finite::{self, NotFinite};
use crate::mesh::angle::sin_cos_degrees;
use nalgebra::{Matrix3, Point3, Vector3};

/// Where an object stands: `x_world = rotation * x + translation`, in the units of the scene; the twelve doubles are
/// the truth, and the matrix need not be perfectly orthonormal. They are finite: what takes a pose need not look again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    // Made in other ways only by the motions of a scene, which looks at all its frames when it is made.
    pub(super) rotation: Matrix3<f64>,
    pub(super) translation: Vector3<f64>,
}

impl Pose {
    /// The pose of a matrix, which may be any, and a translation.
    ///
    /// # Errors
    /// The first number that is not finite.
    pub fn new(rotation: Matrix3<f64>, translation: Vector3<f64>) -> Result<Self, NotFinite> {
        let pose = Self { rotation, translation };
        finite::pose(&pose.rows(), &translation.into())?;
        Ok(pose)
    }

    /// The matrix.
    pub fn rotation(&self) -> Matrix3<f64> {
        self.rotation
    }

    /// The translation.
    pub fn translation(&self) -> Vector3<f64> {
        self.translation
    }

    /// As in the mesh file.
    pub fn identity() -> Self {
        Self { rotation: Matrix3::identity(), translation: Vector3::zeros() }
    }

    /// The pose of `other` as seen from an object in this pose, with the transpose for the inverse of this rotation,
    /// computed in binary64. Seen from the identity it is `other` itself, bit for bit but for the signs of zeros.
    ///
    /// # Errors
    /// If a number of the result is too great for binary64.
    pub fn seen(&self, other: &Self) -> Result<Self, NotFinite> {
        let back = self.rotation.transpose();
        Self::new(back * other.rotation, back * (other.translation - self.translation))
    }

    /// The matrix, indexed `[row][column]`.
    pub fn rows(&self) -> [[f64; 3]; 3] {
        self.rotation.transpose().into()
    }

    /// The image of a point, rounded.
    #[inline]
    pub fn image(&self, point: &Point3<f64>) -> Point3<f64> {
        // The sums in the order of `rotation * point + translation`, without its loops, which are not always unrolled.
        let (m, t) = (&self.rotation, &self.translation);
        Point3::from([0, 1, 2].map(|i| m[(i, 0)] * point.x + m[(i, 1)] * point.y + m[(i, 2)] * point.z + t[i]))
    }
}

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
pub(super) fn axis_angle(axis: Vector3<f64>, degrees: f64) -> Matrix3<f64> {
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
