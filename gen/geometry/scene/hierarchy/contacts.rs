//! The pairs of triangles that touch, exactly: traversal, a filter in floating point, and whole numbers for what that leaves.

use super::traverse::rank;
use super::{DopTree, Scratch, Statistics, batches};
use crate::exact::{Exact, posed_pair};
use crate::mesh::Mesh;
use crate::scene::Pose;
use crate::scene::enclosure;
use crate::software::interval_axes::decide_moved;

/// Pairs filtered at a time: small enough to stay in the first cache.
const BLOCK: usize = 64;

/// All pairs (triangle of A, triangle of B) that touch with B in `pose` as seen from A, in ascending order, and how they do. The
/// twelve doubles of the pose are taken as they are.
///
/// # Panics
/// If the trees have different sets of directions, or are not those of the meshes.
pub fn contacts(
    [a, b]: [&Mesh; 2],
    trees: [&DopTree; 2],
    pose: &Pose,
    scratch: &mut Scratch,
) -> (Vec<((u32, u32), Exact)>, Statistics) {
    let error = enclosure::error(&trees[1].farthest(), pose);
    let (rows, translation) = (pose.rows(), pose.translation.into());
    let exactly = |(p, q): (u32, u32)| {
        let corners = |mesh: &Mesh, face: u32| mesh.triangle(face as usize).map(<[f64; 3]>::from);
        posed_pair(&corners(a, p), &corners(b, q), &rows, &translation)
    };
    let mut found = vec![];
    let (mut points, mut answers) = ([[[0.0; 3]; 6]; BLOCK], [None; BLOCK]);
    let statistics = batches(trees[0], trees[1], pose, scratch, |pairs| {
        for pairs in pairs.chunks(BLOCK) {
            let (points, answers) = (&mut points[..pairs.len()], &mut answers[..pairs.len()]);
            for (points, &(p, q)) in points.iter_mut().zip(pairs) {
                let [p0, p1, p2] = a.triangle(p as usize);
                let [q0, q1, q2] = b.triangle(q as usize);
                let [q0, q1, q2] = [pose.image(&q0), pose.image(&q1), pose.image(&q2)];
                *points = [p0.into(), p1.into(), p2.into(), q0.into(), q1.into(), q2.into()];
            }
            decide_moved(points, error, answers);
            let exact =
                pairs.iter().zip(answers).map(|(&pair, answer)| (pair, answer.unwrap_or_else(|| exactly(pair))));
            found.extend(exact.filter(|(_, exact)| *exact != Exact::Separate));
        }
    });
    found.sort_unstable_by_key(|&(pair, _)| rank(pair));
    (found, statistics)
}
