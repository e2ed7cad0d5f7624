//! Whole collision queries in software on one core: trees of k-DOPs, then the exact retest, for every meeting of two objects
//! of a scene. Writes meshes and poses to a folder, so that `scripts/fcl` can ask another library the same. Prints queries,
//! touching pairs and microseconds per query; then distance, queries and microseconds per query for each distance of a turn.

use efsat::collide::hierarchy::{Directions, DopTree, Scratch, rounded_contacts};
use efsat::mesh::Mesh;
use efsat::scene::{Meeting, Scene, load};
use std::fs;
use std::path::Path;
use std::time::Instant;

/// `mesh_I.f64`, nine numbers per triangle, and `meetings.f64`: the distance (NaN without one), meshes of A and B, matrix by
/// rows, translation.
fn emit(dir: &Path, meshes: &[&Mesh], meetings: &[Meeting], distances: &[f64]) -> std::io::Result<()> {
    let bytes = |numbers: Vec<f64>| numbers.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>();
    for (i, mesh) in meshes.iter().enumerate() {
        let numbers = (0..mesh.faces().len()).flat_map(|face| mesh.triangle(face)).flat_map(|x| [x.x, x.y, x.z]);
        fs::write(dir.join(format!("mesh_{i}.f64")), bytes(numbers.collect()))?;
    }
    let numbers = meetings.iter().zip(distances).flat_map(|(Meeting { meshes, pose, .. }, distance)| {
        let matrix = pose.rotation().transpose();
        [*distance]
            .into_iter()
            .chain(meshes.map(|mesh| mesh as f64))
            .chain(matrix.iter().copied())
            .chain(pose.translation().iter().copied())
            .collect::<Vec<f64>>()
    });
    fs::write(dir.join("meetings.f64"), bytes(numbers.collect()))
}

fn main() {
    // Cargo adds `--bench`.
    let arguments: Vec<String> = std::env::args().skip(1).filter(|argument| !argument.starts_with("--")).collect();
    let [file, dir] = &arguments[..] else { return };
    let scene = match &file[..] {
        "headlight" => Scene::default_scene(),
        _ => load(file.as_ref()).unwrap_or_else(|error| panic!("{error}")),
    };
    let (meshes, _) = scene.meshes();
    let trees: Vec<DopTree> = meshes.iter().map(|mesh| DopTree::new(mesh, Directions::Eighteen)).collect();
    let near = scene.near();
    let meetings: Vec<Meeting> = (0..scene.frames()).flat_map(|frame| near.meetings(frame)).collect();
    let distance = |meeting: &Meeting| scene.frame(meeting.frame).distance.unwrap_or(f64::NAN);
    let distances: Vec<f64> = meetings.iter().map(distance).collect();
    emit(dir.as_ref(), &meshes, &meetings, &distances).unwrap_or_else(|error| panic!("{dir}: {error}"));
    let mut scratch = Scratch::default();
    // The best time of each query: what else the machine does comes and goes.
    let mut best = vec![f64::INFINITY; meetings.len()];
    let mut touching = 0;
    for _ in 0..5 {
        touching = 0;
        for (meeting, best) in meetings.iter().zip(&mut best) {
            let start = Instant::now();
            let [a, b] = meeting.meshes;
            let (found, _) =
                rounded_contacts([meshes[a], meshes[b]], [&trees[a], &trees[b]], &meeting.pose, &mut scratch).unwrap();
            touching += found.len();
            *best = best.min(start.elapsed().as_secs_f64());
        }
    }
    let mean = |times: &[f64]| 1e6 * times.iter().sum::<f64>() / times.len() as f64;
    println!("{} {touching} {:.2}", meetings.len(), mean(&best));
    for group in distances.chunk_by(|x, y| x == y).filter(|group| !group[0].is_nan()) {
        let (now, rest) = best.split_at(group.len());
        println!("{} {} {:.2}", group[0], group.len(), mean(now));
        best = rest.to_vec();
    }
}
