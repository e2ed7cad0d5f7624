//! Whole collision queries in software on one core: trees of k-DOPs, then the exact retest, for every meeting of two objects
//! of a scene. Prints queries, touching pairs and microseconds per query; then distance, queries and microseconds per query for
//! each distance of a turn.

use efsat::collide::hierarchy::{Directions, DopTree, Scratch, rounded_contacts};
use efsat::scene::{Meeting, Scene, load};
use std::time::Instant;

fn main() {
    // Cargo adds `--bench`.
    let arguments: Vec<String> = std::env::args().skip(1).filter(|argument| !argument.starts_with("--")).collect();
    let [file] = &arguments[..] else { return };
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
