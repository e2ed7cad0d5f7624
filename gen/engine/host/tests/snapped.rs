//! Points that are snapped to the grid of an exact unit: the engine answers the pairs of their triangles that touch, no others.

use super::*;
use efsat_geometry::collide::Collider;
use efsat_geometry::scene::Pose;
use efsat_hardware::testing::full;

/// A large triangle, which sets the scale, and small ones of some steps of a word around a place: each corner lies so far above one
/// of the grid.
fn cluster(rng: &mut ChaCha8Rng, step: f64, place: [f64; 3], above: Option<f64>) -> Mesh {
    let mut vertices = [[-1.0, -1.0, -1.0], [-1.0, 1.0, -0.98], [1.0, -0.99, 1.0]].map(Point3::from).to_vec();
    vertices.extend((0..36).map(|_| {
        let along = |x: f64| x / step + rng.random_range(-20.0..20.0);
        Point3::from(place.map(along).map(|x| step * above.map_or(x, |above| x.floor() + above)))
    }));
    Mesh::new(vertices, (0..13).map(|i| [3 * i, 3 * i + 1, 3 * i + 2])).unwrap()
}

/// Pairs that touch.
fn touch([a, b]: &[Mesh; 2], pose: &Pose) -> Vec<[u32; 2]> {
    let found = Collider::new(a, b).contacts(pose);
    let mut found: Vec<_> = found.iter().map(|contact| [contact.a, contact.b]).collect();
    found.sort_unstable();
    found
}

#[test]
fn what_touches_when_it_is_snapped_is_found() {
    let mut rng = ChaCha8Rng::seed_from_u64(6);
    let [engine, finest] = [&engines()[0], &engines()[3]].map(EngineParams::clone);
    let of = |width, exact_clocks| Params { width, transform_width: width, exact_clocks, ..Params::snapped() };
    let units =
        [(&engine, of(26, None)), (&engine, of(32, None)), (&engine, of(32, Some(16))), (&finest, of(30, None))];
    let (mut touching, mut real) = (0, 0);
    for (engine, unit) in units {
        let numbers = Numbers::new(engine, &unit).unwrap();
        let (model, step) = (Model::new(engine, &unit).unwrap(), 0.5f64.powi(numbers.format().word_fraction() as i32));
        for round in 0..if full() { 600 } else { 150 } {
            // In every other round all roundings bring the snapped points together, as far as they can.
            let worst = round % 2 == 0;
            let range = if worst { 0.8..0.97 } else { -0.5..0.5 };
            let place = [0; 2].map(|_| [0; 3].map(|_| rng.random_range(range.clone())));
            let m = match worst {
                true => [0; 3].map(|_| [0; 3].map(|_| f64::from(rng.random_range(200..=256)) / 256.0)),
                false => random_matrix(&mut rng, [0, 1, 4][round % 3]),
            };
            let above = if worst { [Some(0.99), Some(0.0)] } else { [None; 2] };
            let meshes = [0, 1].map(|i| cluster(&mut rng, step, place[i], above[i]));
            let [p, q] = place;
            let t = [0, 1, 2].map(|i| {
                let apart = rng.random_range(-30..30);
                let t = p[i] - (0..3).map(|j| m[i][j] * q[j]).sum::<f64>();
                step * ((t / step).floor() + f64::from(apart) + 0.01)
            });
            let pose = Pose::from_rows(m, t).unwrap();
            let images = Images::new(&[&meshes[0], &meshes[1]], numbers.clone()).unwrap();
            let (memory, sides) = memory(&images.all());
            // Some of the matrices are too far from a rotation for the finest format.
            let Ok(query) = images.query([0, 1], &pose, &sides) else { continue };
            let outcome = model.run(&memory, &query.words(numbers.format()));
            assert_eq!((outcome.report.reason, outcome.report.possibly_incorrect), (Reason::Complete, 0));
            let expected = touch(&images.snapped([0, 1], &pose).unwrap().unwrap(), &Pose::identity());
            assert_eq!(pairs(&outcome), expected, "round {round} of {unit:?}");
            touching += expected.len();
            real += touch(&meshes, &pose).len();
        }
    }
    assert!(
        touching > if full() { 1000 } else { 250 } && touching != real,
        "{touching} pairs touch, {real} of them as they are"
    );
}
