//! Images of points and boxes as boxes that surely hold them.

use super::Pose;
use crate::mesh::Bounds;
use crate::software::affine::radius;
use nalgebra::{Point3, Vector3};

/// A box that surely holds the real point `m * x + t`.
///
/// With u = 2^-53 and S = |m0 x0| + |m1 x1| + |m2 x2| + |t|, each coordinate is computed in binary64 as y with
/// |y - exact| <= 4u/(1-4u) S + 3 * 2^-1075, the last term for products that underflow. The computed S is
/// short of the real one by no more than that. The radius r = 2^-50 S + 2^-1022, rounded, therefore exceeds the error
/// by more than 3u S + 2^-1023, and y - r and y + r are rounded by at most u |y +- r| <= 1.1 u S + 2^-1074. If S is
/// too large for that argument (or not a number) the interval is all numbers.
pub(super) fn image(x: &Point3<f64>, pose: &Pose) -> Bounds {
    let Pose { rotation: m, translation: t } = pose;
    let y = m * x.coords + t;
    let size = m.abs() * x.coords.abs() + t.abs();
    let radius = size.map(radius);
    let bound = |sign: f64| y.zip_map(&radius, |y, r| if r.is_finite() { y + sign * r } else { sign * r });
    Bounds { min: bound(-1.0).into(), max: bound(1.0).into() }
}

/// How far [`Pose::image`] is from the real point at most, in each coordinate, for points whose coordinates are at most as great as
/// those of `reach`. It sums in the same way, and twice the radius makes up for roundings of `reach`.
pub(super) fn error(reach: &Vector3<f64>, pose: &Pose) -> f64 {
    // A reach that overflows, times an entry of 0, is no number, which `max` may lose: the radius is taken first, and is infinite.
    2.0 * (pose.rotation.abs() * reach + pose.translation.abs()).map(radius).max()
}

/// A box that surely holds the image of a box: an affine map keeps convex hulls, so the boxes of the corners do.
#[cfg(feature = "scenes")]
pub(crate) fn image_of_box(x: &Bounds, pose: &Pose) -> Bounds {
    let corner = |index: usize| {
        let side = |axis: usize| if index >> axis & 1 == 0 { x.min[axis] } else { x.max[axis] };
        image(&Point3::new(side(0), side(1), side(2)), pose)
    };
    (0..8).map(corner).fold(Bounds::empty(), |sum, corner| sum.union(&corner))
}
