//! Tests of scenes: the default one, scene files and their faults, poses, and that no pair is missed.

use super::*;
use crate::collide::{Candidates, Tree, pieces};
use crate::mesh::{self, Bounds, Defect};
use nalgebra::{Matrix3, Point3, Vector3};
use num_bigint::BigInt;
use num_traits::Float;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use std::path::Path;

fn scene_folder() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes")
}

/// A scene of the headlight with the given further lines.
fn parse(lines: &str) -> Result<Scene, SceneError> {
    let text = format!("name = 'x'\na.mesh = 'builtin:headlight'\nb.mesh = 'builtin:headlight'\n{lines}");
    file::parse(&text, Path::new("x.toml"))
}

/// The poses of the last object.
fn moved(scene: &Scene) -> Vec<Pose> {
    (0..scene.frames()).map(|frame| *scene.frame(frame).poses.last().unwrap()).collect()
}

#[test]
fn the_default_scene_is_its_file() {
    let scene = Scene::default_scene();
    assert_eq!(load(&scene_folder().join("headlight.toml")).unwrap(), scene);
    assert_eq!((scene.name.as_str(), scene.frames()), ("headlight", 7 * 360));
    assert!(Arc::ptr_eq(&scene.objects[0].mesh, &scene.objects[1].mesh));
    let last = scene.frame(6 * 360 + 90);
    assert_eq!((last.label.as_str(), last.distance), ("distance 1.45 step 90", Some(1.45)));
    assert_eq!(last.poses[0], Pose::identity());
    assert_eq!(last.poses[1].rotation, Matrix3::new(0., -1., 0., 0., 0., -1., 1., 0., 0.));
    assert!(moved(&scene).iter().all(|p| p.rotation.iter().all(|x| x.abs() <= 1.0)));
}

#[test]
fn a_mesh_against_itself_tumbles_like_the_default_scene() {
    let mesh = Mesh::clone(&mesh::headlight());
    assert_eq!(
        Scene::against_itself("headlight", mesh, Scene::STEPS, &Scene::DISTANCES).unwrap(),
        Scene::default_scene(),
        "scenes/headlight.toml has other steps, distances or another direction"
    );
}

#[test]
fn the_centres_of_a_tumbling_turn_are_at_the_distance() {
    let scene = parse("[tumble]\nsteps = 7\ndistances = [0.5, 3]\ndirection = [3e200, 4e200, 0]").unwrap();
    let centre = scene.objects[0].mesh.bounds().centre();
    for frame in (0..scene.frames()).map(|frame| scene.frame(frame)) {
        let pose = frame.poses[1];
        let offset = pose.rotation * centre + pose.translation - centre;
        let expected = Vector3::new(0.6, 0.8, 0.0) * 122.0 * frame.distance.unwrap();
        assert!((offset - expected).norm() < 1e-12);
        let square = pose.rotation * pose.rotation.transpose();
        assert!((square - Matrix3::identity()).amax() < 1e-15 && pose.rotation.determinant() > 0.9);
    }
}

#[test]
fn the_second_scene_is_read() {
    let scene = load(&scene_folder().join("bolt_nut.toml")).unwrap();
    let [a, b] = [0, 1].map(|object: usize| scene.objects[object].mesh.faces().len());
    assert_eq!((a, b, scene.frames()), (9320, 4218, 9));
}

#[test]
fn explicit_poses_and_scales_are_read() {
    let scene = parse(
        "b.scale = 0.5\n[[pose]]\n[[pose]]\nmatrix = [1, 2, 3, 4, 5, 6, 7, 8, 9]\ntranslation = [1, 2, 3]\n\
         [[pose]]\nlabel = 'turn'\naxis = [0, 0, 1e300]\nangle_degrees = 450\n\
         [[pose]]\nquaternion = [1e200, 0, 0, 1e200]\n\
         [[pose]]\naxis = [1, 2, -2]\nangle_degrees = 120\n[[pose]]\nquaternion = [1.5, 1.5, 3, -3]",
    )
    .unwrap();
    assert_eq!(scene.objects[1].mesh.bounds().half_size(), 61.0);
    assert_eq!(scene.objects[0].mesh.bounds().half_size(), 122.0);
    assert_eq!([0, 2].map(|frame| scene.frame(frame).label), ["pose 0", "turn"]);
    let [id, matrix, turn, quaternion, by_angle, by_quaternion] = moved(&scene)[..] else { panic!("six poses") };
    assert_eq!(id, Pose::identity());
    assert_eq!(matrix.rotation[(0, 2)], 3.0);
    assert_eq!(matrix.translation, Vector3::new(1.0, 2.0, 3.0));
    assert_eq!(turn.rotation, Matrix3::new(0., -1., 0., 1., 0., 0., 0., 0., 1.));
    assert_eq!(quaternion.rotation, turn.rotation);
    // The quaternion is 1.5 (1 + 3 k) for the unit axis k, so the tangent of half its angle is 3.
    let degrees = 2.0 * 3f64.atan().to_degrees();
    let expected = rotation::axis_angle(Vector3::new(1.0, 2.0, -2.0), degrees);
    assert!((by_quaternion.rotation - expected).amax() < 1e-15);
    assert!(by_angle.rotation.trace().abs() < 1e-15, "1 + 2 cos 120 degrees");
}

/// Three objects of the built-in mesh.
fn three(lines: &str) -> Result<Scene, SceneError> {
    let object = |name: &str| format!("[[object]]\nname = '{name}'\nmesh = 'builtin:headlight'\n");
    let text = format!("name = 'x'\n{}{}{}{lines}", object("p"), object("q"), object("r"));
    file::parse(&text, Path::new("x.toml"))
}

#[test]
fn objects_stand_where_they_are_placed_and_move_alone() {
    let scene = three(
        "placed = { translation = [1, 2, 3], axis = [0, 0, 1], angle_degrees = 90, about = [10, 0, 0] }\n\
         [[pose]]\nobject = 'q'\ntranslation = [7, 0, 0]\n[[pose]]\nquaternion = [0, 1, 0, 0]\n",
    )
    .unwrap();
    assert_eq!(scene.objects.iter().map(|object| object.name.as_str()).collect::<Vec<_>>(), ["p", "q", "r"]);
    let quarter = Matrix3::new(0., -1., 0., 1., 0., 0., 0., 0., 1.);
    // The point (10, 0, 0) goes where the translation alone would take it.
    let placed = Pose { rotation: quarter, translation: Vector3::new(11.0, -8.0, 3.0) };
    assert_eq!(placed.image(&Point3::new(10.0, 0.0, 0.0)), Point3::new(11.0, 2.0, 3.0));
    assert_eq!(scene.objects[2].placed, placed);
    let at = |x: f64| Pose { translation: Vector3::new(x, 0.0, 0.0), ..Pose::identity() };
    assert_eq!(scene.frame(0).poses, [at(0.0), at(7.0), placed]);
    let turned = Pose { rotation: Matrix3::from_diagonal(&Vector3::new(1., -1., -1.)), ..at(0.0) };
    assert_eq!(scene.frame(1).poses, [at(0.0), at(0.0), turned]);
    // Without any motion there is one frame; all three share a mesh.
    let still = three("").unwrap();
    assert_eq!((still.frames(), still.frame(0).label.as_str()), (1, "as placed"));
    assert_eq!((still.meshes().0.len(), still.meshes().1), (1, vec![0, 0, 0]));
    assert_eq!(still.near().meetings(0).iter().map(|m| (m.a, m.b)).collect::<Vec<_>>(), [(0, 1), (0, 2), (1, 2)]);
}

#[test]
fn units_and_cubes_scale_meshes() {
    let file = |lines: &str| {
        let text = format!("name = 'x'\n{lines}\n[b]\nmesh = 'builtin:headlight'\n[[pose]]\n");
        file::parse(&text, Path::new("x.toml")).map(|scene| scene.objects[0].mesh.bounds().half_size())
    };
    let half = |lines: &str| file(lines).unwrap();
    assert_eq!(half("unit = 'm'\n[a]\nmesh = 'builtin:headlight'\nunit = 'mm'"), 0.122);
    assert_eq!(half("unit = 'mm'\n[a]\nmesh = 'builtin:headlight'\nunit = 'inch'\nscale = 2"), 244.0 * 25.4);
    assert_eq!(half("[a]\nmesh = 'builtin:headlight'\nscale = 'cube'"), 1.0);
    let fault = |lines: &str| file(lines).unwrap_err().to_string();
    let own = fault("[a]\nmesh = 'builtin:headlight'\nunit = 'mm'");
    assert_eq!(own, "x.toml:4: unit of an object in a scene without one: expected unit at the top");
    let league = fault("unit = 'm'\n[a]\nmesh = 'builtin:headlight'\nunit = 'league'");
    assert_eq!(league, "x.toml:5: unit 'league': expected one of um, mm, cm, m, inch, foot");
    let parsec = fault("unit = 'parsec'\n[a]\nmesh = 'builtin:headlight'");
    assert!(parsec.starts_with("x.toml:2: unit 'parsec': expected"), "{parsec}");
    let sphere = fault("[a]\nmesh = 'builtin:headlight'\nscale = 'sphere'");
    assert_eq!(sphere, "x.toml:4: scale 'sphere': expected a positive number or \"cube\"");
}

#[test]
fn trajectories_go_through_their_keys() {
    let scene = three(
        "[[trajectory]]\nlabel = 'arm'\nframes = 5\n\
         [[trajectory.track]]\nobject = 'q'\n\
         key = [{ time = 1, translation = [8, 0, 0], axis = [0, 0, 1], angle_degrees = 720 }, { time = 3 }]\n\
         [[trajectory.track]]\n\
         key = [{ time = 2, quaternion = [1, 0, 0, 0] }, { time = 5, quaternion = [0, 0, -3, 0], translation = [0, 6, 0] }]\n",
    )
    .unwrap();
    assert_eq!((scene.frames(), scene.frame(2).label.as_str()), (5, "arm 2"));
    let frames: Vec<Frame> = (0..5).map(|frame| scene.frame(frame)).collect();
    assert!(frames.iter().all(|frame| frame.poses[0] == Pose::identity()));
    // Times 1, 2, 3, 4, 5: two turns back to nothing while it moves, then rest.
    let ways = frames.iter().map(|frame| frame.poses[1].translation.x).collect::<Vec<_>>();
    assert_eq!(ways, [8.0, 4.0, 0.0, 0.0, 0.0]);
    assert_eq!(frames[0].poses[1].rotation, Matrix3::identity());
    assert_eq!(frames[1].poses[1].rotation, Matrix3::identity(), "one turn");
    // The other rests up to time 2 and turns half about y until 5: a third of the way is 60 degrees by quaternions
    // interpolated in a line, or nearly so; the ends are exact.
    assert_eq!(frames[0].poses[2], Pose::identity());
    assert_eq!(frames[1].poses[2], Pose::identity());
    assert_eq!(frames[4].poses[2].rotation, Matrix3::from_diagonal(&Vector3::new(-1., 1., -1.)));
    assert_eq!(frames[4].poses[2].translation, Vector3::new(0.0, 6.0, 0.0));
    let third = frames[2].poses[2];
    assert_eq!(third.translation, Vector3::new(0.0, 2.0, 0.0));
    // Half the angle has the tangent (1/3) / (2/3).
    let expected = rotation::axis_angle(Vector3::new(0., -1., 0.), 2.0 * 0.5f64.atan().to_degrees());
    assert!((third.rotation - expected).amax() < 1e-15, "{third:?}");
    let middle = three(
        "[[trajectory]]\nframes = 3\n[[trajectory.track]]\n\
         key = [{ time = 0, axis = [1, 0, 0], angle_degrees = 0 }, { time = 1, axis = [0, 0, 2], angle_degrees = 90 }]\n",
    );
    let halfway = middle.unwrap().frame(1).poses[2].rotation;
    assert!((halfway - rotation::axis_angle(Vector3::z(), 45.0)).amax() < 1e-15, "{halfway}");
    // Three quarters of a turn one way is a quarter the other way.
    let shorter = three(
        "[[trajectory]]\nframes = 3\n[[trajectory.track]]\n\
         key = [{ time = 0, quaternion = [1, 0, 0, 0] }, { time = 1, quaternion = [-1, 0, 0, 1] }]\n",
    );
    let halfway = shorter.unwrap().frame(1).poses[2].rotation;
    assert!((halfway - rotation::axis_angle(Vector3::z(), -45.0)).amax() < 1e-15, "{halfway}");
}

#[test]
fn every_fault_of_objects_and_trajectories_is_one_clear_line() {
    let key = "[[trajectory.track]]\n[[trajectory.track.key]]\n";
    let cases = [
        ("name = 'r'".to_owned(), "x.toml:11: duplicate key"),
        ("[[object]]\nname = 'p'\nmesh = 'builtin:headlight'".to_owned(), "x.toml:11: a second object 'p'"),
        ("[[object]]\nmesh = 'builtin:headlight'".to_owned(), "x.toml:11: an object without a name"),
        ("[a]\nmesh = 'builtin:headlight'".to_owned(), "x.toml:2: [[object]] beside [a] or [b]: expected two tables"),
        ("placed = { angle_degrees = 3 }".to_owned(), "x.toml:11: pose: expected one of matrix"),
        ("[[pose]]\nobject = 's'".to_owned(), "x.toml:12: object 's': expected one of p, q, r"),
        (
            "[[pose]]\nobject = 'p'\nmatrix = [1, 0, 0, 0, 1, 0, 0, 0, 2]".to_owned(),
            "x.toml: pose 0: the matrix of p is",
        ),
        ("[[pose]]\nabout = [inf, 0, 0]".to_owned(), "x.toml:12: about holds inf"),
        ("[tumble]\nsteps = 1\ndistances = [1]\nobject = 'p'".to_owned(), "x.toml:14: 'p' around itself: expected two"),
        ("[[trajectory]]\nframes = 1\n".to_owned(), "x.toml:11: a trajectory without a track"),
        ("[[trajectory]]\nframes = 3\n[[trajectory.track]]\n".to_owned(), "x.toml:13: a track without a key"),
        (format!("[[trajectory]]\nframes = 1\n{key}time = 0\n"), "x.toml:12: frames 1: expected 2 to 1000000"),
        (format!("[[trajectory]]\nframes = 9\n{key}time = nan\n"), "x.toml:15: time NaN: expected a finite number"),
        (format!("[[trajectory]]\nframes = 9\n{key}time = 0\nmatrix = [1]"), "x.toml:16: unknown field `matrix`"),
        (
            format!("[[trajectory]]\nframes = 9\n{key}time = 1\n[[trajectory.track.key]]\ntime = 1"),
            "x.toml:17: time 1: expected",
        ),
        (format!("[[trajectory]]\nframes = 9\n{key}time = 1\n{key}time = 1"), "x.toml:16: a second track of 'r'"),
        (
            format!("[[trajectory]]\nframes = 9\n{key}time = 1\naxis = [0, 0, 1]"),
            "x.toml:14: pose: expected one of axis",
        ),
        (
            format!("[[trajectory]]\nframes = 900000\n{key}time = 1\n[[trajectory]]\nframes = 100001\n{key}time = 1"),
            "x.toml:17: 1000001 frames in all",
        ),
    ];
    let mut wrong = vec![];
    for (lines, expected) in cases {
        let found = three(&lines).map_or_else(|e| e.to_string(), |_| "no fault".to_owned());
        if !found.starts_with(expected) || found.contains('\n') {
            wrong.push(format!("{lines:?}: {found}, not {expected}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    let none = file::parse("name = 'x'", Path::new("x.toml")).unwrap_err().to_string();
    assert!(none.starts_with("x.toml: no object: expected two tables [a] and [b], or"), "{none}");
    let one = file::parse("name = 'x'\n[a]\nmesh = 'm.stl'", Path::new("x.toml")).unwrap_err().to_string();
    assert!(one.starts_with("x.toml:2: [a] without [b]: expected"), "{one}");
}

/// Objects seen from one that is itself turned: no pair of triangles that touch is missing from the meetings, and
/// those that touch by construction are found.
#[test]
fn no_meeting_of_turned_objects_is_missed() {
    let mut rng = ChaCha8Rng::seed_from_u64(6);
    let (mut met, mut all) = (0, 0);
    for round in 0..40 {
        let count = 6;
        let meshes: Vec<Mesh> = (0..count).map(|_| random_mesh(&mut rng, 2, 1.0)).collect();
        let poses: Vec<Pose> = (0..count)
            .map(|_| {
                let axis = Vector3::from([0; 3].map(|_| rng.random_range(-1.0..1.0)));
                let degrees = if round % 2 == 0 {
                    90.0 * f64::from(rng.random_range(0..4))
                } else {
                    rng.random_range(0.0..360.0)
                };
                let rotation = rotation::axis_angle(if round % 2 == 0 { Vector3::y() } else { axis }, degrees);
                Pose { rotation, translation: Vector3::from([0; 3].map(|_| f64::from(rng.random_range(-9..=9)))) }
            })
            .collect();
        let boxes: Vec<Bounds> = meshes.iter().map(Mesh::bounds).collect();
        let found = sweep::overlapping(&boxes, &poses);
        for i in 0..count {
            for j in i + 1..count {
                let seen = poses[i].seen(&poses[j]).unwrap();
                let m = [0, 1, 2].map(|r| [0, 1, 2].map(|c| seen.rotation[(r, c)]));
                let corners = |mesh: &Mesh, face: usize| mesh.triangle(face).map(<[f64; 3]>::from);
                let touch = (0..4).any(|k| {
                    let (x, y) = (corners(&meshes[i], k / 2), corners(&meshes[j], k % 2));
                    crate::exact::posed_pair(&x, &y, &m, &seen.translation.into()).unwrap()
                        != crate::exact::Exact::Separate
                });
                assert!(!touch || found.contains(&(i, j)), "round {round}: {i} and {j}");
                met += usize::from(touch);
            }
        }
        all += found.len();
    }
    assert!(met > 40 && all < 40 * 14, "{met} pairs of objects touch, {all} of {} meet", 40 * 15);
}

#[test]
fn findings_of_a_mesh_are_those_of_its_objects() {
    let folder = tempfile::tempdir().unwrap();
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 3 2 1\nf 1 2 7\n";
    std::fs::write(folder.path().join("m.obj"), obj).unwrap();
    let text = "name = 'x'\n[a]\nmesh = 'm.obj'\n[b]\nmesh = 'm.obj'\n[[pose]]\n";
    let scene = file::parse(text, &folder.path().join("x.toml")).unwrap();
    assert!(Arc::ptr_eq(&scene.objects[0].mesh, &scene.objects[1].mesh));
    for object in &scene.objects {
        let defects: Vec<_> = object.findings.list.iter().map(|finding| (finding.defect, finding.count)).collect();
        assert_eq!(defects, [(Defect::OutOfRange, 1), (Defect::Duplicate, 1)]);
    }
}

#[test]
fn every_fault_of_a_scene_file_is_one_clear_line() {
    let cases = [
        ("", "x.toml: no pose: expected"),
        ("c = 1", "x.toml:4: unknown field `c`"),
        ("[tumble", "x.toml:4: "),
        ("[tumble]\nsteps = 3", "x.toml:4: missing field `distances`"),
        ("[tumble]\nsteps = -3\ndistances = [1]", "x.toml:5: invalid value: integer `-3`, expected u32"),
        ("[tumble]\nsteps = 0\ndistances = [1]", "x.toml:5: steps 0: expected 1 to 1000000"),
        ("[tumble]\nsteps = 500001\ndistances = [1, 2]", "x.toml:5: steps 500001: expected 1 to 500000"),
        ("[tumble]\nsteps = 1\n\ndistances = []", "x.toml:7: distances is empty"),
        ("[tumble]\nsteps = 1\ndistances = [1, nan]", "x.toml:6: distances holds NaN: expected"),
        ("[tumble]\nsteps = 1\ndistances = [1e308]", "x.toml: distance 100"),
        ("[tumble]\nsteps = 1\ndistances = [1]\ndirection = [0, 0, 0]", "x.toml:7: direction of three zeros"),
        ("[[pose]]\n[[pose]]\naxis = [1, 0, 0]", "x.toml:5: pose: expected one of matrix"),
        ("[[pose]]\naxis = [1, 0, 0]\nquaternion = [1, 0, 0, 0]", "x.toml:4: pose: expected one of"),
        ("[[pose]]\naxis = [0, 0, 0]\nangle_degrees = 1", "x.toml:5: axis of three zeros"),
        ("[[pose]]\naxis = [0, 0, 1]\nangle_degrees = inf", "x.toml:6: angle_degrees inf: expected"),
        ("[[pose]]\nquaternion = [0, 0, 0, 0]", "x.toml:5: quaternion of four zeros"),
        ("[[pose]]\nmatrix = [1, 0, 0]", "x.toml:5: invalid length 3, expected an array of length 9"),
        ("[[pose]]\ntranslation = [1, 0, 'a']", "x.toml:5: invalid type: string \"a\", expected f64"),
        ("[[pose]]\ntranslation = [1, 0, -inf]", "x.toml:5: translation holds -inf"),
        ("[[pose]]\nspeed = 1", "x.toml:5: unknown field `speed`"),
        ("a.scale = -2", "x.toml:4: scale -2: expected a positive number"),
        ("a.scale = 1e307", "x.toml:4: scale 1"),
    ];
    for (lines, expected) in cases {
        let found = parse(lines).unwrap_err().to_string();
        assert!(found.starts_with(expected) && !found.contains('\n'), "{lines:?}: {found}");
    }
    let mesh = |m: &str| file::parse(&format!("name = ''\na.mesh = '{m}'\nb.mesh = 'b.stl'"), Path::new("d/x.toml"));
    let absent = mesh("a.stl").unwrap_err().to_string();
    let file = Path::new("d").join("a.stl");
    assert!(absent.starts_with(&format!("d/x.toml:2: {}: cannot be read", file.display())), "{absent}");
    let unknown = mesh("builtin:cow").unwrap_err().to_string();
    let names = mesh::BUILTIN.map(|name| format!("builtin:{name}")).join(", ");
    assert_eq!(unknown, format!("d/x.toml:2: mesh 'builtin:cow': expected one of {names}"));
    assert!(load(Path::new("no/such.toml")).unwrap_err().to_string().starts_with("no/such.toml: cannot be read ("));
}

/// Random bytes in a valid file never panic.
#[test]
fn damaged_scene_files_never_panic() {
    let seed = include_str!("../scenes/bolt_nut.toml").as_bytes();
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    for _ in 0..300 {
        let mut bytes = seed[seed.len() - rng.random_range(1..seed.len())..].to_vec();
        for _ in 0..3 {
            let at = rng.random_range(0..bytes.len());
            bytes[at] = rng.random();
        }
        let _ = file::parse(&String::from_utf8_lossy(&bytes), Path::new("absent/x.toml"));
    }
}

/// A binary64 number in units of 2^-1075, where it is an integer.
fn exact(x: f64) -> BigInt {
    let (mantissa, exponent, sign) = Float::integer_decode(x);
    (BigInt::from(mantissa) << (exponent + 1075)) * sign
}

/// Exact boxes of B's triangles in A's frame, in units of 2^-2150.
fn exact_boxes(mesh: &Mesh, pose: &Pose) -> Vec<[(BigInt, BigInt); 3]> {
    let Pose { rotation: m, translation: t } = pose;
    let row = |i: usize, x: &Point3<f64>| {
        let translation = exact(t[i]) << 1075u32;
        (0..3).fold(translation, |sum, j| sum + exact(m[(i, j)]) * exact(x[j]))
    };
    let side = |mut v: [BigInt; 3]| {
        v.sort();
        let [least, _, greatest] = v;
        (least, greatest)
    };
    let corners = |face: usize, i: usize| mesh.triangle(face).map(|x| row(i, &x));
    (0..mesh.faces().len()).map(|face| [0, 1, 2].map(|i| side(corners(face, i)))).collect()
}

/// A mesh of `count` triangles with corners on a coarse grid, so that boxes often touch exactly.
fn random_mesh(rng: &mut ChaCha8Rng, count: u32, scale: f64) -> Mesh {
    let mut corner = || Point3::from([0; 3].map(|_| f64::from(rng.random_range(-8..=8)) * scale));
    let vertices: Vec<_> = (0..3 * count).map(|_| corner()).collect();
    Mesh::new(vertices, (0..count).map(|i| [3 * i, 3 * i + 1, 3 * i + 2])).unwrap()
}

#[test]
fn no_pair_of_exact_boxes_is_missed() {
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    let (mut touching, mut overlapping, mut more) = (0, 0, 0);
    for round in 0..60 {
        // Scales down to where products underflow and up to where they overflow or nearly so.
        let scale = [1.0, 0.1, 1e-3, 1e-160, 1e150, 1e306][round % 6];
        let (a, b) = (random_mesh(&mut rng, 12, scale), random_mesh(&mut rng, 12, scale));
        let axis = Vector3::from([0; 3].map(|_| rng.random_range(-1.0..1.0)));
        let m = match round % 4 {
            0 => Matrix3::identity(),
            1 => rotation::axis_angle(axis, 90.0 * f64::from(rng.random_range(0..4))),
            _ => rotation::axis_angle(axis, rng.random_range(-180.0..180.0)),
        };
        let t = Vector3::from([0; 3].map(|_| f64::from(rng.random_range(-9..=9)) * scale));
        let pose = Pose { rotation: m, translation: t };
        let (a_tree, b_tree) = (Tree::new(&a), Tree::new(&b));
        let found = Candidates::new(&a_tree, &b_tree, &pose).few().unwrap();
        let boxes = (exact_boxes(&a, &Pose::identity()), exact_boxes(&b, &pose));
        for (p, x) in (0..).zip(&boxes.0) {
            for (q, y) in (0..).zip(&boxes.1) {
                let overlap = x.iter().zip(y).all(|(x, y)| x.0 <= y.1 && y.0 <= x.1);
                let is_found = found.binary_search(&(p, q)).is_ok();
                assert!(is_found || !overlap, "round {round}: pair ({p}, {q})");
                overlapping += u32::from(overlap);
                touching += u32::from(overlap && x.iter().zip(y).any(|(x, y)| x.0 == y.1 || y.0 == x.1));
                more += u32::from(is_found && !overlap && scale < 1e300);
            }
        }
    }
    assert!(touching > 100, "touching boxes are tested: {touching}");
    assert!(more * 20 < overlapping, "and little else is found: {more} beside {overlapping}");
}

#[test]
fn the_tree_agrees_with_brute_force_on_the_headlight() {
    let scene = Scene::default_scene();
    let near = scene.near();
    // The fullest of some poses of the smallest distance.
    let meetings = (6 * 360..7 * 360).step_by(20).flat_map(|frame| near.meetings(frame));
    let meeting = meetings.max_by_key(|meeting| near.pairs(meeting).len()).unwrap();
    let [fixed, tumbling] = near.meshes(&meeting);
    let vertices: Vec<_> = tumbling.vertices().iter().map(|v| meeting.pose.image(v)).collect();
    let moved = Mesh::new(vertices, tumbling.faces().to_vec()).unwrap();
    let boxes = |mesh: &Mesh| (0..mesh.faces().len()).map(|i| mesh::Bounds::of(&mesh.triangle(i))).collect::<Vec<_>>();
    let (a, b) = (boxes(fixed), boxes(&moved));
    // Every fifth triangle of A: the rest would only cost time.
    let tested = |p: usize| p.is_multiple_of(5);
    let pairs = near.pairs(&meeting);
    let found: std::collections::BTreeSet<_> = pairs.into_iter().filter(|&(p, _)| tested(p as usize)).collect();
    assert!(!found.is_empty());
    let mut count = 0;
    for (p, x) in a.iter().enumerate().filter(|&(p, _)| tested(p)) {
        for (q, _) in b.iter().enumerate().filter(|(_, y)| x.overlaps(y)) {
            assert!(found.contains(&(p as u32, q as u32)));
            count += 1;
        }
    }
    assert!(found.len() - count <= 2, "{} found, {count} by brute force", found.len());
}

#[test]
fn pairs_come_in_order_whatever_the_number_of_threads() {
    let scene = parse("[tumble]\nsteps = 12\ndistances = [1.5, 1.4]").unwrap();
    let run = |threads: usize| {
        let mut seen = Vec::new();
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            scene.near().try_for_each(|meeting, pairs| {
                seen.push((meeting.clone(), pairs.to_vec()));
                Ok::<(), ()>(())
            })
        })
        .unwrap();
        seen
    };
    let seen = run(1);
    assert_eq!(seen, run(3));
    assert!(seen.windows(2).all(|w| w[0].0.frame < w[1].0.frame) && seen.iter().any(|(_, pairs)| !pairs.is_empty()));
    assert!(seen.iter().all(|(_, pairs)| pairs.windows(2).all(|w| w[0] < w[1])));
    let mut calls = 0;
    let stopped = scene.near().try_for_each(|_, _| {
        calls += 1;
        if calls == 3 { Err("enough") } else { Ok(()) }
    });
    assert_eq!((stopped, calls), (Err("enough"), 3));
}

#[test]
fn a_mesh_without_triangles_has_no_pairs() {
    let (empty, one) = (Mesh::default(), mesh::headlight());
    let (empty, one) = (Tree::new(&empty), Tree::new(&one));
    assert_eq!(Candidates::new(&empty, &one, &Pose::identity()).few(), Some(vec![]));
}

#[test]
fn pairs_that_are_too_many_come_in_pieces() {
    use std::convert::Infallible;
    // Triangles at one place, and some beside them: the former all meet, and the boxes of the latter meet some.
    let mut mesh = random_mesh(&mut ChaCha8Rng::seed_from_u64(9), 40, 1.0);
    let faces = mesh.faces().iter().copied().chain(vec![[0, 1, 2]; 260]);
    mesh = Mesh::new(mesh.vertices().to_vec(), faces).unwrap();
    let tree = Tree::new(&mesh);
    let pose = Pose { rotation: Matrix3::identity(), translation: Vector3::repeat(0.5) };
    let all = Candidates::new(&tree, &tree, &pose);
    assert!(all.few().is_none());
    let (mut found, mut calls) = (vec![], 0);
    let Ok(()) = all.pieces(|pairs| {
        assert!(pairs.len() < pieces::MOST + mesh.faces().len());
        found.extend_from_slice(pairs);
        calls += 1;
        Ok::<(), Infallible>(())
    });
    assert!(calls > 1 && found.len() > 260 * 260 && found.windows(2).all(|two| two[0] < two[1]));
    let boxes = [&Pose::identity(), &pose].map(|pose| exact_boxes(&mesh, pose));
    let meets = |p: usize, q: usize| boxes[0][p].iter().zip(&boxes[1][q]).all(|(x, y)| x.0 <= y.1 && y.0 <= x.1);
    let triangles = mesh.faces().len();
    let meeting = (0..triangles).flat_map(|p| (0..triangles).map(move |q| (p, q))).filter(|(p, q)| meets(*p, *q));
    assert_eq!(meeting.map(|(p, q)| (p as u32, q as u32)).collect::<Vec<_>>(), found, "each once, and no others");
}

#[test]
fn what_is_not_finite_is_no_pose_and_no_mesh() {
    for (index, value) in (0..12).flat_map(|index| [f64::NAN, f64::INFINITY, f64::NEG_INFINITY].map(|x| (index, x))) {
        let mut numbers = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 4.0];
        numbers[index] = value;
        let error =
            Pose::new(Matrix3::from_row_slice(&numbers[..9]), Vector3::from_row_slice(&numbers[9..])).unwrap_err();
        let place = match index {
            0..9 => format!("the entry in row {}, column {} of the matrix", index / 3, index % 3),
            _ => format!("{} of the translation", ["x", "y", "z"][index - 9]),
        };
        assert_eq!(error.to_string(), format!("{place} is {value}: expected a finite number"));
    }
    let corner = |x| vec![Point3::origin(), Point3::new(0.0, 1.0, 2.0), Point3::new(3.0, 4.0, x)];
    let refused = |x, face| Mesh::new(corner(x), vec![[0, 1, 2], face]).unwrap_err().to_string();
    assert_eq!(refused(f64::NAN, [0, 1, 2]), "z of vertex 2 is NaN: expected a finite number");
    assert_eq!(refused(5.0, [1, 3, 0]), "triangle 1: vertex 3; expected one of 3 vertices, counted from 0");
    assert!(Mesh::new(corner(f64::MAX), vec![[0, 1, 2]]).is_ok());
}

#[test]
fn poses_that_cannot_be_seen_from_each_other_are_refused() {
    let huge = Pose::new(Matrix3::repeat(f64::MAX), Vector3::zeros()).unwrap();
    let turned = Pose::new(rotation::axis_angle(Vector3::z(), 30.0), Vector3::zeros()).unwrap();
    assert_eq!(Pose::identity().seen(&huge), Ok(huge));
    assert!(turned.seen(&huge).is_err());
    let object = |name: &str, placed| Object {
        name: name.to_owned(),
        mesh: mesh::headlight(),
        findings: Findings::default(),
        placed,
    };
    let rest = |first, last| Scene::at_rest("x", vec![object("p", first), object("q", last)]);
    let meetings = |scene: Scene| scene.near().meetings(0).len();
    assert_eq!(rest(Pose::identity(), huge).map(meetings), Ok(1));
    let error = rest(turned, huge).unwrap_err().to_string();
    assert!(
        error.starts_with("placed: an entry of the matrix of q is above 1e306, and another object is rotated"),
        "{error}"
    );
    assert!(rest(huge, Pose::identity()).unwrap_err().to_string().contains("the matrix of p is no rotation"));
    let distance =
        |x| Scene::against_itself("x", (*mesh::headlight()).clone(), 3, &[1.0, x]).map(|scene| scene.frames());
    assert_eq!(distance(2.0), Ok(6));
    for x in [f64::NAN, f64::INFINITY, f64::MAX] {
        assert!(distance(x).unwrap_err().to_string().contains("the translation of b overflows"));
    }
}
