//! Where an object stands.

use crate::finite::{self, NotFinite};
use nalgebra::{Matrix3, Point3, Vector3};

/// Where an object stands: `x_world = rotation * x + translation`, in the units of the scene; the twelve doubles are
/// the truth, and the matrix need not be perfectly orthonormal. They are finite: what takes a pose need not look again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    // Made in other ways only by the motions of a scene, which looks at all its frames when it is made.
    pub(crate) rotation: Matrix3<f64>,
    pub(crate) translation: Vector3<f64>,
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

    /// The pose of a matrix in rows, which may be any, and a translation.
    ///
    /// # Errors
    /// The first number that is not finite.
    pub fn from_rows(m: [[f64; 3]; 3], t: [f64; 3]) -> Result<Self, NotFinite> {
        Self::new(Matrix3::from(m).transpose(), t.into())
    }

    /// The pose of a translation.
    ///
    /// # Errors
    /// The first number that is not finite.
    pub fn moved(t: [f64; 3]) -> Result<Self, NotFinite> {
        Self::new(Matrix3::identity(), t.into())
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
