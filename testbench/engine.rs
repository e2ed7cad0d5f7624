//! The collision engine's reference model on the meshes of the project, and `efsat tree`.

use crate::extent::{full, share};
use crate::hierarchy::brute_force;
use crate::tools::program::{fails, object, succeeds};
use efsat::collide::Collider;
use efsat::collide::hierarchy::Directions;
use efsat::engine::host::{Image, Images, Numbers, memory};
use efsat::engine::model::{Model, Query};
use efsat::engine::params::EngineParams;
use efsat::engine::words::Reason;
use efsat::mesh::{Mesh, read};
use efsat::pair::Verdict;
use efsat::params::Params;
use efsat::scene::{Meeting, Pose, Scene, load};
use rayon::prelude::*;
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};

fn scenes() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes")
}

/// The default, and the coarsest formats.
fn engines() -> [EngineParams; 4] {
    let make = |directions, origin_bits, offset_bits, factor_bits| EngineParams {
        directions,
        origin_bits,
        offset_bits,
        factor_bits,
        ..EngineParams::default()
    };
    [
        make(Directions::Eighteen, 18, 10, 12),
        make(Directions::Six, 12, 6, 6),
        make(Directions::Fourteen, 14, 8, 9),
        make(Directions::TwentySix, 12, 6, 6),
    ]
}

/// Pairs that touch and the engine loses, or its unit calls separate, in words; how many touch, and how many queries were
/// answered.
fn lost(name: &str, meshes: [&Mesh; 2], pose: &Pose) -> (usize, usize, Vec<String>) {
    let expected = brute_force(meshes[0], meshes[1], pose);
    let unit = Params::default();
    let m = pose.rows();
    let (mut queries, mut wrong) = (0, vec![]);
    for engine in engines() {
        let numbers = Numbers::new(&engine, &unit).unwrap();
        let images = Image::build(&meshes, numbers.format()).unwrap();
        let (memory, sides) = memory(&[&images[0], &images[1]]);
        let Ok(query) = numbers.query([(&images[0], sides[0]), (&images[1], sides[1])], &m, &pose.translation().into())
        else {
            continue;
        };
        queries += 1;
        let model = Model::new(&engine, &unit).unwrap();
        let query = Query { all_pairs: true, ..query };
        let outcome = model.run(&memory, &query.words(numbers.format()));
        let mut found: Vec<_> = outcome.answers.iter().map(|a| ((a.triangles[0], a.triangles[1]), a.verdict)).collect();
        found.sort_unstable();
        let survives = |pair: &(u32, u32)| {
            let place = found.binary_search_by_key(pair, |(pair, _)| *pair);
            place.is_ok_and(|place| found[place].1 != Verdict::Separate as u8)
        };
        let lost = expected.iter().filter(|pair| !survives(pair)).count();
        if lost > 0 || outcome.report.reason != Reason::Complete {
            let reason = outcome.report.reason;
            wrong.push(format!("{name}, {:?}: {lost} of {} lost, {reason:?}", engine.directions, expected.len()));
        }
        // What is called an intersection is one.
        let intersect = found.iter().filter(|(_, verdict)| *verdict == Verdict::Intersect as u8);
        let false_alarms = intersect.filter(|(pair, _)| expected.binary_search(pair).is_err()).count();
        if false_alarms > 0 {
            wrong.push(format!("{name}, {:?}: {false_alarms} pairs intersect that do not touch", engine.directions));
        }
    }
    (expected.len(), queries, wrong)
}

/// The ready scenes, and how many meetings of two objects each is sampled by.
const READY: [(&str, usize); 7] =
    [("headlight", 12), ("bolt_nut", 9), ("sliding", 7), ("far", 8), ("plates", 5), ("gears", 8), ("lock_nuts", 5)];

#[test]
fn every_ready_scene_is_in_the_list() {
    let scenes = fs::read_dir(scenes()).unwrap().map(|entry| entry.unwrap().path());
    let mut there: Vec<String> = scenes
        .filter(|path| path.extension().is_some_and(|e| e == "toml"))
        .map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned())
        .collect();
    let mut listed = READY.map(|(name, _)| name.to_owned()).to_vec();
    there.sort();
    listed.sort();
    assert_eq!(there, listed);
}

#[test]
fn no_touching_pair_of_any_mesh_is_lost() {
    let mut cases: Vec<(String, Mesh, Mesh, Pose)> = vec![];
    for name in ["cad_headlight.stl", "m8_bolt.stl", "m8_nut.stl"] {
        let mesh = read(&scenes().join(name)).unwrap();
        let scene = Scene::against_itself(name, mesh.clone(), 7, &[1.5, 0.4, 0.0]).unwrap();
        for frame in share(7, [17, 0, 1, 4, 7, 9, 15]) {
            cases.push((format!("{name}, frame {frame}"), mesh.clone(), mesh.clone(), scene.frame(frame).poses[1]));
        }
    }
    // Every ready scene: of their meetings a sample over all frames, and of the bolt in its nut every second one at least.
    for (name, most) in READY {
        let scene = load(&scenes().join(format!("{name}.toml"))).unwrap();
        let near = scene.near();
        let all: Vec<_> = (0..scene.frames()).flat_map(|frame| near.meetings(frame)).collect();
        for meeting in share(8, all.iter().step_by(all.len().div_ceil(most))) {
            let [a, b] = [meeting.a, meeting.b].map(|object| (*scene.objects[object].mesh).clone());
            cases.push((format!("{name}, frame {}", meeting.frame), a, b, meeting.pose));
        }
    }
    assert!(READY.iter().all(|(name, _)| cases.iter().any(|(case, ..)| case.starts_with(name))));
    let all: Vec<_> = cases.par_iter().map(|(name, a, b, pose)| lost(name, [a, b], pose)).collect();
    let wrong: Vec<&str> = all.iter().flat_map(|(_, _, wrong)| wrong).map(String::as_str).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    let (touching, queries) = all.iter().fold((0, 0), |(t, q), (touching, queries, _)| (t + touching, q + queries));
    assert!(touching > if full() { 5_000 } else { 2_000 }, "{touching} pairs touch");
    assert!(queries > 3 * cases.len(), "{queries} queries of {} answered", 4 * cases.len());
}

/// Behind the hierarchy the exact unit, also as a cascade, decides every pair, and finds what software finds in the snapped meshes.
#[test]
fn an_exact_unit_leaves_no_third_answer() {
    let scene = load(&scenes().join("sliding.toml")).unwrap();
    let (meshes, near) = (scene.meshes().0, scene.near());
    let queries: Vec<_> = (0..scene.frames()).flat_map(|frame| near.meetings(frame)).collect();
    let engine = EngineParams::default();
    for (width, exact_clocks) in [(26, None), (32, None), (32, Some(16))] {
        let unit = Params { width, transform_width: width, exact_clocks, ..Params::snapped() };
        let images = Images::new(&meshes, Numbers::new(&engine, &unit).unwrap()).unwrap();
        let (memory, sides) = memory(&images.all());
        let model = Model::new(&engine, &unit).unwrap();
        let touching = queries.par_iter().map(|Meeting { meshes, pose, .. }| {
            let query = images.query(*meshes, pose, &sides).unwrap();
            let outcome = model.run(&memory, &query.words(images.numbers().format()));
            assert_eq!((outcome.report.reason, outcome.report.possibly_incorrect), (Reason::Complete, 0));
            let [a, b] = images.snapped(*meshes, pose).unwrap().unwrap();
            let expected = Collider::new(a, b).contacts(&Pose::identity());
            let mut expected: Vec<[u32; 2]> = expected.iter().map(|contact| [contact.a, contact.b]).collect();
            let mut found: Vec<[u32; 2]> = outcome.answers.iter().map(|answer| answer.triangles).collect();
            expected.sort_unstable();
            found.sort_unstable();
            assert!(found == expected, "{width} bits: {} pairs, expected {}", found.len(), expected.len());
            found.len()
        });
        assert!(touching.sum::<usize>() > 10_000);
    }
}

#[test]
fn images_are_built_inspected_and_verified() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    for name in ["m8_bolt.stl", "m8_nut.stl"] {
        fs::copy(scenes().join(name), dir.join(name)).unwrap();
    }
    let told = succeeds(dir, "tree build m8_nut.stl --beside m8_bolt.stl --out nut.image");
    let size = fs::metadata(dir.join("nut.image")).unwrap().len();
    assert!(told.starts_with(&format!("nut.image: 4218 triangles, {size} bytes, height ")), "{told}");
    assert_eq!(succeeds(dir, "tree verify nut.image"), "nut.image: 4217 blocks and 4218 triangles are in order\n");
    assert_eq!(succeeds(dir, "tree verify nut.image m8_nut.stl"), succeeds(dir, "tree verify nut.image"));
    let report: Value = object(dir, "tree inspect nut.image --json");
    assert_eq!((&report["bytes"], &report["blocks"]), (&Value::from(size), &Value::from(4217)));
    let exponents = report["exponents"].as_array().unwrap().iter().map(|count| count.as_u64().unwrap());
    assert_eq!((report["directions"].as_u64(), exponents.sum::<u64>()), (Some(18), 4217));
    let table = succeeds(dir, "tree inspect nut.image");
    assert!(table.contains("code                    10 bits, steps of 2^exponent 2^-22\n"), "{table}");
    // The scale is that of both: alone, the nut is larger.
    succeeds(dir, "tree build m8_nut.stl --out alone.image --directions 6 --offset-bits 8 --transform-width 48");
    let alone: Value = object(dir, "tree inspect alone.image --json");
    assert!(alone["power"].as_i64() > report["power"].as_i64());
    assert_eq!((alone["bytes_per_block"].as_u64(), alone["bytes_per_triangle"].as_u64()), (Some(32), Some(128)));
    // Bad images: a code made smaller is seen with the mesh or without, and another mesh is another mesh.
    fails(dir, "tree verify nut.image m8_bolt.stl", 1, "nut.image: byte 20: number of triangles: 4218; expected 9320");
    let good = fs::read(dir.join("nut.image")).unwrap();
    let mut bad = good.clone();
    // Code 0 of the root's left child, 10 bits from bit 152, 100 less.
    let code = u16::from_le_bytes([bad[64 + 19], bad[64 + 20]]);
    let less = code & !0x3ff | code.wrapping_sub(100) & 0x3ff;
    bad[64 + 19..64 + 21].copy_from_slice(&less.to_le_bytes());
    fs::write(dir.join("bad.image"), &bad).unwrap();
    fails(dir, "tree verify bad.image m8_nut.stl", 1, "bad.image: byte 64: block 0: code ");
    fails(dir, "tree inspect bad.image", 2, "bad.image: byte 64: block 0: code ");
    fs::write(dir.join("short.image"), &good[..100]).unwrap();
    fails(dir, "tree inspect short.image", 2, "short.image: byte 100: end of the file: 100 bytes; expected ");
    fails(dir, "tree inspect none.image", 2, "none.image: cannot be read");
    let absent = "nowhere/x.image: No such file or directory (os error 2); expected a file in an existing folder";
    fails(dir, "tree build m8_nut.stl --out nowhere/x.image", 2, absent);
    // Factors are not in an image: none is too wide for one.
    succeeds(dir, "tree build builtin:plate --out wide.image --directions 26 --offset-bits 15");
    succeeds(dir, "tree verify wide.image builtin:plate");
    fails(dir, "tree build none.stl --out x.image", 2, "none.stl: cannot be read");
    fails(
        dir,
        "tree build m8_nut.stl --out x.image --origin-bits 20 --offset-bits 5",
        2,
        "--origin-bits 20: expected at most 18",
    );
    assert!(!dir.join("x.image").exists());
    fails(dir, "tree", 2, "expected one of build, inspect, verify, count, answer, query");
}

/// What docs/engine.md says of the default scene.
#[test]
fn the_counts_of_the_page_are_those_of_the_model() {
    let counts = object(scenes(), "tree count headlight --json");
    let page = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/engine.md")).unwrap();
    let row = page.lines().find(|line| line.starts_with("| headlight | 18 | 18 | 10 | 12 |")).unwrap();
    let found: Vec<String> = row.split('|').skip(6).map(|cell| cell.trim().replace(',', "")).collect();
    let names = ["queries", "expansions", "tests", "leaf_pairs", "intersect", "possibly_incorrect"];
    let expected: Vec<String> = names.iter().map(|name| counts[name].to_string()).collect();
    assert_eq!(found[..names.len()], expected);
    assert_eq!(counts["answered_in_software"], 0);
}
