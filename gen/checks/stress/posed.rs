//! A case under a pose: B is given in a frame of its own and comes back by a rotation and a translation.

use super::families::power_of_two;
use efsat_geometry::Points;
use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};
use rand::RngExt;
use rand::rngs::ChaCha8Rng;

/// x to M * x + t; twelve finite numbers, taken as exact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// M, indexed `[row][column]`.
    pub m: [[f64; 3]; 3],
    /// t.
    pub t: [f64; 3],
}

/// Two triangles, the second in its own frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Posed {
    /// Vertices of A.
    pub a: [[f64; 3]; 3],
    /// Vertices of B before the motion.
    pub b: [[f64; 3]; 3],
    /// Takes B to the frame of A.
    pub motion: Motion,
}

type Point = Vector3<f64>;

impl Posed {
    /// A pair under a random pose. B is taken back by the inverse of the pose in binary64, so the posed pair is the
    /// given one but for the rounding of that.
    pub(super) fn random(points: &Points, rng: &mut ChaCha8Rng) -> Self {
        let [a, b] = [0, 3].map(|k| [points[k], points[k + 1], points[k + 2]]);
        let first = Point::from(b[0]);
        let reach = b.map(|vertex| (Point::from(vertex) - first).amax()).into_iter().fold(0.0, f64::max);
        let m = rotation(rng);
        let t = match rng.random_range(0..4) {
            0 => Point::zeros(),
            1 => first,
            2 => first + Point::from_fn(|_, _| rng.random_range(-1.0..1.0)) * reach,
            _ => first + Point::from_fn(|_, _| rng.random_range(-1.0..1.0)) * reach * 1024.0,
        };
        let back = b.map(|vertex| m.transpose() * (Point::from(vertex) - t));
        let finite = back.iter().chain([&t]).flatten().all(|x| x.is_finite());
        let (m, t, b) = if finite { (m, t, back.map(Into::into)) } else { (Matrix3::identity(), Point::zeros(), b) };
        let motion = Motion { m: [0, 1, 2].map(|i| [0, 1, 2].map(|j| m[(i, j)])), t: t.into() };
        Self { a, b, motion }
    }
}

/// A rotation in no special position, by a tiny angle, by quarter turns or none.
fn rotation(rng: &mut ChaCha8Rng) -> Matrix3<f64> {
    let mut axis = || Point::from_fn(|_, _| rng.random_range(-1.0..1.0f64));
    let q = match axis().x {
        ..-0.75 => {
            let angle = axis();
            Quaternion::from_parts(1.0, angle * power_of_two(-rng.random_range(1..=60)))
        }
        ..-0.5 => {
            let quarter = [[1.0, 1.0, 0.0, 0.0], [1.0, 1.0, 1.0, 1.0], [0.0, 1.0, 1.0, 0.0], [1.0, 0.0, 0.0, -1.0]];
            Quaternion::from(quarter[rng.random_range(0..4)])
        }
        ..-0.375 => Quaternion::identity(),
        _ => Quaternion::from_parts(axis().y, axis()),
    };
    // Rounding must not bring an entry out of the declared range.
    UnitQuaternion::from_quaternion(q).to_rotation_matrix().matrix().map(|x| x.clamp(-1.0, 1.0))
}
