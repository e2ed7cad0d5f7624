//! Poses, and the ways to make them: a tumbling turn, an axis and an angle, a quaternion.

use super::angle::sin_cos_degrees;
use crate::mesh::Mesh;
use nalgebra::{Matrix3, Vector3};

/// One position of mesh B: `x_A = rotation * x_B + translation`, in the units of the mesh files.
#[derive(Clone, Debug, PartialEq)]
pub struct ScenePose {
    /// What the pose is called in reports.
    pub label: String,
    /// The distance between the centres of the bounding boxes in cube half-sizes, where a tumbling turn made the
    /// pose: reports group by it.
    pub distance: Option<f64>,
    /// The matrix; its nine doubles are the truth.
    pub rotation: Matrix3<f64>,
    /// The translation; its three doubles are the truth.
    pub translation: Vector3<f64>,
}

/// A full turn of B about the z and the x axis through the centre of its bounding box, in equal steps, at each of
/// several distances: the benchmark procedure of the paper's group.
///
/// Step i of n has the rotation `Rx(w) * Rz(w)` with w = 360 i / n degrees. A distance is that between the centres of
/// the bounding boxes, along `direction`, in half-sizes of the cube that both meshes fit: half the longest edge of
/// the larger box. Distances come in the order given, the steps of one distance together.
pub fn tumble(a: &Mesh, b: &Mesh, steps: u32, distances: &[f64], direction: Vector3<f64>) -> Vec<ScenePose> {
    let (box_a, box_b) = (a.bounds(), b.bounds());
    let unit = direction / direction.amax();
    let offset = unit / unit.norm() * box_a.half_size().max(box_b.half_size());
    let pose = |distance: f64, step: u32| {
        let (s, c) = sin_cos_degrees(360.0 * f64::from(step) / f64::from(steps));
        // Every entry is at most one product of a sine and a cosine, so none exceeds 1.
        let rotation = Matrix3::new(c, -s, 0.0, c * s, c * c, -s, s * s, s * c, c);
        ScenePose {
            label: format!("distance {distance} step {step}"),
            distance: Some(distance),
            rotation,
            translation: box_a.centre().coords + offset * distance - rotation * box_b.centre().coords,
        }
    };
    distances.iter().flat_map(|&d| (0..steps).map(move |i| (d, i))).map(|(d, i)| pose(d, i)).collect()
}

/// The rotation by `degrees` about `axis` (which need not have unit length), right-handed.
pub(super) fn axis_angle(axis: Vector3<f64>, degrees: f64) -> Matrix3<f64> {
    let scaled = axis / axis.amax();
    let k = scaled / scaled.norm();
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
