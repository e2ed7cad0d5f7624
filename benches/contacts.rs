//! All contacts of two meshes by the software: two headlights of the default scene deep in each other, by the distance of their centres,
//! and two tori of 100,352 triangles. Prints how many pairs the trees leave and how many of them touch, and the microseconds of a query:
//! of the traversal alone, of the exact answer for the pose as given, and of that for rounded corners. Then the milliseconds for the
//! trees of both tori, and for the self-intersections of both as one mesh. All on one thread, the best of several rounds.

use efsat::collide::hierarchy::{Directions, DopTree, Scratch, batches, contacts, rounded_contacts};
use efsat::mesh::{Mesh, builtin};
use efsat::scene::{Pose, Scene};
use efsat::self_intersections;
use nalgebra::{Point3, Vector3};
use std::f64::consts::TAU;
use std::fs;
use std::sync::LazyLock;
use std::time::Instant;

const ROUNDS: usize = 9;
static START: LazyLock<Instant> = LazyLock::new(Instant::now);
/// Sides of a torus, and of its cross-section.
const SIDES: u32 = 224;

/// Seconds by the clock, for what is over before anything else runs.
fn clock() -> f64 {
    START.elapsed().as_secs_f64()
}

/// Processor seconds of this thread, counted a few milliseconds at a time.
fn processor() -> f64 {
    let said = fs::read_to_string("/proc/thread-self/schedstat").expect("the system counts processor time");
    1e-9 * said.split(' ').next().and_then(|nanoseconds| nanoseconds.parse::<f64>().ok()).expect("a number is first")
}

/// The least time of several rounds in seconds.
fn best(now: fn() -> f64, mut run: impl FnMut()) -> f64 {
    let times = (0..ROUNDS).map(|_| {
        let start = now();
        run();
        now() - start
    });
    times.fold(f64::INFINITY, f64::min)
}

fn queries(what: &str, meshes: [&Mesh; 2], poses: &[Pose]) {
    let trees = meshes.map(|mesh| DopTree::new(mesh, Directions::Eighteen));
    let trees = [&trees[0], &trees[1]];
    let mut scratch = Scratch::default();
    let (mut near, mut touching, mut exact, mut rounded, mut alone) = (0, 0, 0.0, 0.0, 0.0);
    for pose in poses {
        near += batches(trees[0], trees[1], pose, &mut scratch, |_| {}).pairs_tested;
        touching += contacts(meshes, trees, pose, &mut scratch).0.len();
        alone += best(clock, || _ = batches(trees[0], trees[1], pose, &mut scratch, |_| {}));
        exact += best(clock, || _ = contacts(meshes, trees, pose, &mut scratch));
        rounded += best(clock, || _ = rounded_contacts(meshes, trees, pose, &mut scratch));
    }
    let mean = |sum: f64| sum / poses.len() as f64;
    let micros = [alone, exact, rounded].map(|seconds| format!("{:.0}", 1e6 * mean(seconds)));
    println!(
        "| {what} | {} | {:.0} | {:.0} | {} |",
        poses.len(),
        mean(near as f64),
        mean(touching as f64),
        micros.join(" | ")
    );
}

fn torus(at: Vector3<f64>) -> Mesh {
    let place = |i: u32| (i / SIDES, i % SIDES);
    let vertex = |i: u32| {
        let [u, v] = <[u32; 2]>::from(place(i)).map(|angle| TAU * f64::from(angle) / f64::from(SIDES));
        let r = 1.0 + 0.4 * v.cos();
        Point3::new(r * u.cos(), r * u.sin(), 0.4 * v.sin()) + at
    };
    let square = |i: u32| {
        let ((i, j), index) = (place(i), |i: u32, j: u32| i % SIDES * SIDES + j % SIDES);
        let [p, q, s, t] = [index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)];
        [[p, q, s], [p, s, t]]
    };
    Mesh::new((0..SIDES * SIDES).map(vertex), (0..SIDES * SIDES).flat_map(square))
        .expect("indices are those of vertices")
}

fn main() {
    // All work is done by this thread, whose time is measured.
    rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread().build_global().expect("there is no other pool");
    println!("| query | poses | pairs near | touch | traversal | exact for the pose | for rounded corners |");
    println!("| --- | ---: | ---: | ---: | ---: | ---: | ---: |");
    let headlight = builtin("headlight").expect("it is built in");
    for distance in [1.3, 1.2, 1.1, 1.0, 0.9, 0.8] {
        let scene = Scene::against_itself("deep", (*headlight).clone(), 7, &[distance]).expect("a distance is finite");
        let poses: Vec<Pose> = (0..scene.frames()).map(|frame| scene.frame(frame).poses[1]).collect();
        let meshes = scene.meshes().0;
        queries(&format!("headlight at {distance}"), [meshes[0], meshes[0]], &poses);
    }
    let torus_here = torus(Vector3::zeros());
    let moved = [2.79, 2.6, 2.4, 2.2, 1.9].map(|x| Pose::moved([x, 0.1, 0.2]).expect("a move is finite"));
    queries("tori", [&torus_here; 2], &moved);

    let there = torus(Vector3::new(2.6, 0.1, 0.2));
    let shifted = there.faces().iter().map(|face| face.map(|i| i + SIDES * SIDES));
    let both = Mesh::new(
        torus_here.vertices().iter().chain(there.vertices()).copied(),
        torus_here.faces().iter().copied().chain(shifted),
    );
    let both = both.expect("indices are those of vertices");
    let trees = best(processor, || _ = [&torus_here, &there].map(|mesh| DopTree::new(mesh, Directions::Eighteen)));
    let own = best(processor, || _ = self_intersections::find(&both));
    println!("trees of the tori: {:.1} ms; self-intersections of both: {:.1} ms", 1e3 * trees, 1e3 * own);
}
