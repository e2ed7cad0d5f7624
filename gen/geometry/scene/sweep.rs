//! Sort and sweep: which objects of a frame can meet at all.

use crate::collide::Pose;
use crate::collide::enclosure::image_of_box;
use crate::mesh::Bounds;
use nalgebra::{Matrix3, Vector3};

/// How far the rotation of an object that others are seen from may be from orthonormal: the greatest entry of
/// `M M^T - I`. Numbers with eight digits do.
pub(super) const SKEW: f64 = 1.0 / (1u64 << 20) as f64;

/// An upper bound of the greatest entry of `|M M^T - I|`. Each entry is a sum of three products; for |M| <= 2 it is
/// computed to within 13 * 2^-53 * 4 < 2^-47.
pub(super) fn skew(m: &Matrix3<f64>) -> f64 {
    (m * m.transpose() - Matrix3::identity()).amax() + 2f64.powi(-47)
}

/// The pairs of objects (i < j, ascending) whose axis-aligned boxes in the frame of the scene overlap: none whose
/// triangles have a common point in the relative pose [`Pose::seen`] is missing.
///
/// Boxes are sorted along the axis of their greatest spread, and one that begins behind the end of another is not
/// compared with it.
///
/// Relative poses are rounded, so that triangles may touch in the relative pose and not quite in the frame of the
/// scene; boxes are widened by as much. Let Q, t_A be the pose of A, R, t_B that of B, and x = M y + t a common point,
/// M = fl(Q^T R), t = fl(Q^T (t_B - t_A)). Its images differ by
/// `(Q x + t_A) - (R y + t_B) = (Q Q^T - I)(R y + t_B - t_A) + Q (dM y + dt)`, where dM and dt are rounding errors. Let
/// W bound the sum of |R||y| + |t_B| and |t_A| in every coordinate, s the entries of |Q Q^T - I| ([`skew`] <= 2^-20, so
/// |Q| < 1.001). The first term is at most 3 s W. Each entry of dM is at most 3u/(1-3u) (|Q^T||R|), of dt at most
/// 4u/(1-4u) |Q^T|(|t_B| + |t_A|), u = 2^-53; so |dM y| + |dt| <= 13 u W and the second term is below 40 u W. The
/// margin is (4 s + 2^-44) W + 2^-1000 for each of the two boxes, which leaves room for the rounding of W and of the
/// widened box (a few u W).
pub(super) fn overlapping(boxes: &[Bounds], poses: &[Pose]) -> Vec<(usize, usize)> {
    // The last object is never the one that others are seen from.
    let skewness = poses.iter().rev().skip(1).map(|pose| skew(&pose.rotation)).fold(0.0, f64::max);
    let reach = |(mesh, pose): (&Bounds, &Pose)| {
        let extent = mesh.min.coords.abs().sup(&mesh.max.coords.abs());
        (pose.rotation.abs() * extent + pose.translation.abs()).max()
    };
    let reach = boxes.iter().zip(poses).map(reach).fold(0.0, f64::max);
    let shift = poses.iter().map(|pose| pose.translation.amax()).fold(0.0, f64::max);
    let margin = Vector3::repeat((4.0 * skewness + 2f64.powi(-44)) * (reach + shift) + 2f64.powi(-1000));
    let placed: Vec<Bounds> = boxes
        .iter()
        .zip(poses)
        .map(|(mesh, pose)| {
            let image = image_of_box(mesh, pose);
            Bounds { min: image.min - margin, max: image.max + margin }
        })
        .collect();
    sort_and_sweep(&placed)
}

/// Pairs of boxes (i < j, ascending) that overlap; touching counts.
fn sort_and_sweep(boxes: &[Bounds]) -> Vec<(usize, usize)> {
    let spread = Bounds::of(&boxes.iter().map(Bounds::centre).collect::<Vec<_>>());
    let axis = (spread.max * 0.5 - spread.min * 0.5).imax();
    let mut order: Vec<usize> = (0..boxes.len()).collect();
    order.sort_by(|&i, &j| boxes[i].min[axis].total_cmp(&boxes[j].min[axis]).then(i.cmp(&j)));
    let mut open: Vec<usize> = vec![];
    let mut pairs = vec![];
    for i in order {
        let begin = boxes[i].min[axis];
        // A bound that is no number keeps its box open.
        let has_ended = |j: usize| boxes[j].max[axis] < begin;
        open.retain(|&j| !has_ended(j));
        let meets = |j: &&usize| !disjoint(&boxes[i], &boxes[**j]);
        pairs.extend(open.iter().filter(meets).map(|&j| (i.min(j), i.max(j))));
        open.push(i);
    }
    pairs.sort_unstable();
    pairs
}

fn disjoint(x: &Bounds, y: &Bounds) -> bool {
    (0..3).any(|axis| x.max[axis] < y.min[axis] || y.max[axis] < x.min[axis])
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Point3;
    use rand::rngs::ChaCha8Rng;
    use rand::{RngExt, SeedableRng};

    #[test]
    fn sort_and_sweep_finds_what_brute_force_finds() {
        let mut rng = ChaCha8Rng::seed_from_u64(5);
        for count in [0, 1, 2, 40, 200] {
            let boxes: Vec<Bounds> = (0..count)
                .map(|_| {
                    // A coarse grid, so that boxes often touch.
                    let min = Point3::from([0; 3].map(|_| f64::from(rng.random_range(0..30))));
                    let size = Vector3::from([0; 3].map(|_| f64::from(rng.random_range(0..9))));
                    Bounds { min, max: min + size }
                })
                .collect();
            let all = (0..count).flat_map(|i| (i + 1..count).map(move |j| (i, j)));
            let expected: Vec<(usize, usize)> = all.filter(|&(i, j)| boxes[i].overlaps(&boxes[j])).collect();
            assert_eq!(sort_and_sweep(&boxes), expected);
            assert!(count < 40 || expected.len() > 10);
        }
    }
}
