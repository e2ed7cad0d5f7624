//! Whole collision queries in software on one core: trees of k-DOPs, then the exact retest, for every meeting of two objects
//! of a scene. Writes meshes and poses to a folder, so that `scripts/fcl` can ask another library the same.

use efsat::exact::Exact;
use efsat::mesh::Mesh;
use efsat::scene::hierarchy::{Directions, DopTree, Scratch, pairs};
use efsat::scene::{Meeting, Scene, load};
use efsat::software::retest::retest_batch;
use std::fs;
use std::path::Path;
use std::time::Instant;

/// The triangles of a pair, B's vertices moved to the frame of A and rounded there.
fn points(a: &Mesh, b: &Mesh, meeting: &Meeting, (i, j): (u32, u32)) -> [[f64; 3]; 6] {
    let [p, q, r] = a.triangle(i as usize);
    let [u, v, w] = b.triangle(j as usize).map(|x| meeting.pose.image(&x));
    [p, q, r, u, v, w].map(|x| x.into())
}

/// `mesh_I.f64`, nine numbers per triangle, and `meetings.f64`: meshes of A and B, matrix by rows, translation.
fn emit(dir: &Path, meshes: &[&Mesh], mesh_of: &[usize], meetings: &[Meeting]) -> std::io::Result<()> {
    let bytes = |numbers: Vec<f64>| numbers.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>();
    for (i, mesh) in meshes.iter().enumerate() {
        let numbers = (0..mesh.faces.len()).flat_map(|face| mesh.triangle(face)).flat_map(|x| [x.x, x.y, x.z]);
        fs::write(dir.join(format!("mesh_{i}.f64")), bytes(numbers.collect()))?;
    }
    let numbers = meetings.iter().flat_map(|Meeting { a, b, pose, .. }| {
        let matrix = pose.rotation.transpose();
        let objects = [*a, *b].map(|object| mesh_of[object] as f64);
        objects.into_iter().chain(matrix.iter().copied()).chain(pose.translation.iter().copied()).collect::<Vec<f64>>()
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
    let (meshes, mesh_of) = scene.meshes();
    let trees: Vec<DopTree> = meshes.iter().map(|mesh| DopTree::new(mesh, Directions::Eighteen)).collect();
    let broad_phase = scene.broad_phase();
    let meetings: Vec<Meeting> = (0..scene.frames()).flat_map(|frame| broad_phase.meetings(frame)).collect();
    emit(dir.as_ref(), &meshes, &mesh_of, &meetings).unwrap_or_else(|error| panic!("{dir}: {error}"));
    let mut scratch = Scratch::default();
    let mut answers = vec![];
    let mut best = f64::INFINITY;
    let mut touching = 0;
    for _ in 0..5 {
        touching = 0;
        let start = Instant::now();
        for meeting in &meetings {
            let [a, b] = [meeting.a, meeting.b].map(|object| mesh_of[object]);
            let (found, _) = pairs(&trees[a], &trees[b], &meeting.pose, &mut scratch);
            let found: Vec<_> = found.into_iter().map(|pair| points(meshes[a], meshes[b], meeting, pair)).collect();
            answers.clear();
            retest_batch(&found, &mut answers);
            touching += answers.iter().filter(|answer| **answer != Exact::Separate).count();
        }
        best = best.min(start.elapsed().as_secs_f64());
    }
    println!("{} {touching} {:.2}", meetings.len(), best * 1e6 / meetings.len() as f64);
}
