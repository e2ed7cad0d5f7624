//! The pairs of triangles that touch: traversal, and a test of what it finds in blocks.

use super::traverse::rank;
use super::{DopTree, Scratch, Statistics, batches};
use crate::collide::Pose;
use crate::collide::enclosure;
use crate::exact::{ContactKind, Exact};
use crate::finite::NotFinite;
use crate::mesh::Mesh;
use crate::software::interval_axes::decide_moved;
use crate::software::retest::{close_posed, retest_batch};
use rayon::prelude::*;

/// Pairs tested at a time: small enough to stay in the first cache.
const BLOCK: usize = 64;
/// Open pairs of a block that are worth a second thread.
const MANY: usize = 32;

/// Pairs (triangle of A, triangle of B) that touch, in ascending order, and how they do; and what the traversal cost.
pub type Contacts<How> = (Vec<((u32, u32), How)>, Statistics);

/// All pairs that touch with B in `pose` as seen from A. The twelve doubles of the pose are taken as they are: a filter in floating
/// point knows how far the corners of B may be off, and exact signs decide what it leaves, by all threads of the current pool where
/// very many pairs touch in planes.
///
/// # Panics
/// If the trees have different sets of directions, or are not those of the meshes.
pub fn contacts(meshes: [&Mesh; 2], trees: [&DopTree; 2], pose: &Pose, scratch: &mut Scratch) -> Contacts<ContactKind> {
    let error = enclosure::error(&trees[1].farthest(), pose);
    let (rows, translation) = (pose.rows(), pose.translation.into());
    let exactly = |(p, q): (u32, u32)| {
        let [a, b] =
            [(meshes[0], p), (meshes[1], q)].map(|(mesh, face)| mesh.triangle(face as usize).map(<[f64; 3]>::from));
        close_posed(&a, &b, &rows, &translation)
    };
    let mut certain = [None; BLOCK];
    search(meshes, trees, pose, scratch, |pairs, points, answers| {
        let certain = &mut certain[..pairs.len()];
        decide_moved(points, error, certain);
        let answer = |(&pair, certain): (&(u32, u32), &Option<Exact>)| {
            certain.map_or_else(|| exactly(pair), ContactKind::of_filter)
        };
        if certain.iter().filter(|certain| certain.is_none()).count() < MANY {
            answers.extend(pairs.iter().zip(&*certain).map(answer));
        } else {
            answers.par_extend(pairs.par_iter().zip(&*certain).map(answer));
        }
    })
}

/// The same for corners of B that are rounded when they are moved, as other programs do it: the answers are exact for these.
///
/// # Errors
/// If a corner of B is moved to where it is no binary64 number.
///
/// # Panics
/// If the trees have different sets of directions, or are not those of the meshes.
pub fn rounded_contacts(
    meshes: [&Mesh; 2],
    trees: [&DopTree; 2],
    pose: &Pose,
    scratch: &mut Scratch,
) -> Result<Contacts<Exact>, NotFinite> {
    let (mut refused, mut found) = (None, vec![]);
    let touching = search(meshes, trees, pose, scratch, |_, points, answers| {
        found.clear();
        match retest_batch(points, &mut found) {
            Ok(()) => answers.extend(found.iter().map(|answer| Some(*answer).filter(|x| *x != Exact::Separate))),
            Err(e) => {
                refused.get_or_insert(e);
            }
        }
    });
    refused.map_or(Ok(touching), Err)
}

/// Finds pairs, and keeps those that touch by the answers that `test` appends for pairs and their rounded corners.
fn search<How: Copy>(
    [a, b]: [&Mesh; 2],
    trees: [&DopTree; 2],
    pose: &Pose,
    scratch: &mut Scratch,
    mut test: impl FnMut(&[(u32, u32)], &[[[f64; 3]; 6]], &mut Vec<Option<How>>),
) -> Contacts<How> {
    let mut found = vec![];
    let (mut points, mut answers) = ([[[0.0; 3]; 6]; BLOCK], Vec::with_capacity(BLOCK));
    let statistics = batches(trees[0], trees[1], pose, scratch, |pairs| {
        for pairs in pairs.chunks(BLOCK) {
            let points = &mut points[..pairs.len()];
            for (points, &(p, q)) in points.iter_mut().zip(pairs) {
                let [p0, p1, p2] = a.triangle(p as usize);
                let [q0, q1, q2] = b.triangle(q as usize);
                let [q0, q1, q2] = [pose.image(&q0), pose.image(&q1), pose.image(&q2)];
                *points = [p0.into(), p1.into(), p2.into(), q0.into(), q1.into(), q2.into()];
            }
            answers.clear();
            test(pairs, points, &mut answers);
            found.extend(pairs.iter().zip(&answers).filter_map(|(pair, answer)| Some((*pair, (*answer)?))));
        }
    });
    found.sort_unstable_by_key(|&(pair, _)| rank(pair));
    (found, statistics)
}
