//! The k-DOP hierarchy against brute force on every mesh at hand, and `efsat scene pairs`.

use crate::extent::{full, share};
use crate::tools::program::{command, efsat, object, ran, refuses, succeeds};
use efsat::collide::hierarchy::{Directions, DopTree, Scratch, first_hit, pairs};
use efsat::exact::{Exact, posed_pair};
use efsat::mesh::{Bounds, Mesh, read};
use efsat::scene::{Pose, Scene};
use rayon::prelude::*;
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};

/// The meshes of the project, and those that may lie beside it.
fn meshes() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut found: Vec<PathBuf> = ["scenes", "../shared/meshes"]
        .into_iter()
        .flat_map(|folder| fs::read_dir(root.join(folder)).into_iter().flatten())
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == "stl" || e == "obj"))
        .collect();
    found.sort();
    found.dedup_by(|x, y| x.file_name() == y.file_name());
    found
}

/// Pairs of triangles that touch, exactly, by boxes sorted along x and no tree: boxes of the rounded images, widened by
/// far more than the rounding.
pub fn brute_force(a: &Mesh, b: &Mesh, pose: &Pose) -> Vec<(u32, u32)> {
    let moved: Vec<_> = b.vertices().iter().map(|v| pose.image(v)).collect();
    let size = a.bounds().half_size() + Bounds::of(&moved).half_size();
    let near = nalgebra::Vector3::repeat(1e-9 * size);
    let of_a: Vec<Bounds> = (0..a.faces().len()).map(|face| Bounds::of(&a.triangle(face))).collect();
    let of_b = |face: &[u32; 3]| {
        let tight = Bounds::of(face.map(|v| &moved[v as usize]));
        Bounds { min: tight.min - near, max: tight.max + near }
    };
    let mut of_b: Vec<(u32, Bounds)> = (0..).zip(b.faces().iter().map(of_b)).collect();
    of_b.sort_by(|x, y| x.1.min.x.total_cmp(&y.1.min.x));
    let widest = of_b.iter().map(|(_, there)| there.max.x - there.min.x).fold(0.0, f64::max);
    let m = pose.rows();
    let corners = |mesh: &Mesh, face: u32| mesh.triangle(face as usize).map(<[f64; 3]>::from);
    let row = |(p, here): (usize, &Bounds)| -> Vec<(u32, u32)> {
        // Rounding cannot matter: boxes are widened by more.
        let start = of_b.partition_point(|(_, there)| there.min.x < here.min.x - widest);
        let end = of_b.partition_point(|(_, there)| there.min.x <= here.max.x);
        let near = of_b[start..end].iter().filter(|(_, there)| here.overlaps(there));
        let touch = |q: u32| {
            let (x, y) = (corners(a, p as u32), corners(b, q));
            posed_pair(&x, &y, &m, &pose.translation().into()).unwrap() != Exact::Separate
        };
        near.filter(|(q, _)| touch(*q)).map(|(q, _)| (p as u32, *q)).collect()
    };
    let mut pairs: Vec<(u32, u32)> = of_a.par_iter().enumerate().flat_map_iter(row).collect();
    pairs.sort_unstable();
    pairs
}

/// Pairs lost by a tree that brute force finds, in words.
fn lost(name: &str, a: &Mesh, b: &Mesh, poses: &[Pose]) -> (usize, Vec<String>) {
    let expected: Vec<_> = poses.iter().map(|pose| brute_force(a, b, pose)).collect();
    let wrong = Directions::ALL.par_iter().flat_map_iter(|&set| {
        let trees = [a, b].map(|mesh| DopTree::new(mesh, set));
        let mut scratch = Scratch::default();
        let mut wrong = vec![];
        for (number, (pose, expected)) in poses.iter().zip(&expected).enumerate() {
            let (found, _) = pairs(&trees[0], &trees[1], pose, &mut scratch);
            let lost = expected.iter().filter(|pair| found.binary_search(pair).is_err()).count();
            if lost > 0 {
                wrong.push(format!("{name}, pose {number}, {set:?}: {lost} of {} pairs lost", expected.len()));
            }
            let touches = |pair: (u32, u32)| expected.binary_search(&pair).is_ok();
            let hit = first_hit(&trees[0], &trees[1], pose, &mut scratch, touches).0;
            if hit.is_some() == expected.is_empty() || hit.is_some_and(|pair| !touches(pair)) {
                wrong.push(format!("{name}, pose {number}, {set:?}: first hit {hit:?} of {}", expected.len()));
            }
        }
        wrong
    });
    (expected.iter().map(Vec::len).sum(), wrong.collect())
}

#[test]
fn no_pair_of_any_mesh_is_lost() {
    let mut wrong = vec![];
    let mut touching = 0;
    let meshes = meshes();
    assert!(meshes.len() >= 3);
    for path in meshes {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        let mesh = read(&path).unwrap();
        // Some steps at each distance; step 0 is no turn, with entries 0 and 1.
        let scene = Scene::against_itself(name.as_str(), mesh.clone(), 7, &[1.5, 0.4, 0.0]).unwrap();
        let poses: Vec<Pose> =
            share(7, [17, 0, 1, 9, 4, 7, 15]).into_iter().map(|frame| scene.frame(frame).poses[1]).collect();
        let (found, lost) = lost(&name, &mesh, &mesh, &poses);
        touching += found;
        wrong.extend(lost);
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(touching > if full() { 10_000 } else { 3_000 }, "{touching} pairs touch");
}

/// Two headlights in eight poses.
const TUMBLING: &str = "name = \"s\"\n[a]\nmesh = \"builtin:headlight\"\n[b]\nmesh = \"builtin:headlight\"\n\
    [tumble]\nsteps = 4\ndistances = [1.5, 0.8]\n";

#[test]
fn every_hierarchy_finds_what_classify_finds() {
    let home = tempfile::tempdir().unwrap();
    fs::write(home.path().join("s.toml"), TUMBLING).unwrap();
    let exact = object(home.path(), "classify s.toml --exact --json")["exact"].clone();
    let touching = exact["touch"].as_u64().unwrap() + exact["intersect"].as_u64().unwrap();
    assert!(touching > 500);
    let mut tested = vec![];
    for k in ["6", "14", "18", "26"] {
        let report = object(home.path(), &format!("scene pairs s.toml --k {k} --json"));
        assert_eq!(report["total"]["touching"], touching, "k = {k}");
        assert_eq!((report["scene"].as_str(), &report["k"].to_string()[..]), (Some("s"), k));
        let frames = report["frames"].as_array().unwrap();
        assert_eq!(frames.len(), 8);
        let sum = |key: &str| frames.iter().map(|row| row[key].as_u64().unwrap()).sum::<u64>();
        for key in ["meetings", "overlap_tests", "transforms", "nodes_visited", "pairs_tested", "touching"] {
            assert_eq!(report["total"][key], sum(key), "{key}");
        }
        assert_eq!(report["objects"][1]["triangles"], 5962);
        tested.push(report["total"]["pairs_tested"].as_u64().unwrap());
        let first = object(home.path(), &format!("scene pairs s.toml --k {k} --first-hit --json"));
        for (row, whole) in first["frames"].as_array().unwrap().iter().zip(frames) {
            let expected = u64::from(whole["touching"].as_u64().unwrap() > 0);
            assert_eq!(row["touching"], expected, "{row} beside {whole}");
            assert!(row["overlap_tests"].as_u64() <= whole["overlap_tests"].as_u64());
        }
    }
    assert!(tested[0] > tested[1] && tested[0] > tested[2] && tested[2] > tested[3], "{tested:?}");
}

#[test]
fn rows_and_summaries_do_not_depend_on_the_number_of_threads() {
    let home = tempfile::tempdir().unwrap();
    fs::write(home.path().join("s.toml"), TUMBLING).unwrap();
    for options in ["", "--json", "--summary", "--first-hit", "--k 26 --json --first-hit"] {
        let [one, three] = ["1", "3"].map(|threads| {
            ran(command(&home, &format!("scene pairs s.toml {options}")).env("RAYON_NUM_THREADS", threads))
        });
        assert_eq!(one, three, "{options}");
        assert_eq!((one.0, one.2.as_str()), (Some(0), ""));
    }
    let rows = succeeds(home.path(), "scene pairs s.toml");
    let lines: Vec<&str> = rows.lines().collect();
    assert_eq!(lines[0], "frame,label,meetings,overlap_tests,transforms,nodes_visited,pairs_tested,touching");
    assert!(lines.len() == 9 && lines[6].starts_with("5,\"distance 0.8 step 1\",1,"), "{rows}");
    let summary = succeeds(home.path(), "scene pairs s.toml --summary");
    assert!(summary.contains("1.5, mean") && summary.contains("0.8, greatest"), "{summary}");
}

/// Where the scenes and pairs of reports are.
fn reported() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("testbench/reported")
}

/// Entries of the matrix add up beyond binary64 in one of two scenes that are the same over the reals.
#[test]
fn no_pair_is_lost_in_a_pose_at_the_end_of_the_numbers() {
    for (scene, k) in
        ["lost.toml", "same.toml"].into_iter().flat_map(|scene| ["6", "14", "18", "26"].map(|k| (scene, k)))
    {
        for options in ["", "--first-hit"] {
            let report = object(reported().join("lost"), &format!("scene pairs {scene} --k {k} --json {options}"));
            assert_eq!(report["total"]["touching"], 1, "{scene}, k = {k} {options}");
        }
    }
}

#[test]
fn solids_inside_others_are_found_if_they_are_asked_for() {
    let dir = reported().join("scenes");
    let command = "scene pairs fcl_inside_492.toml";
    let report = object(&dir, &format!("{command} --containment --json"));
    assert_eq!(report["total"]["touching"], 0);
    let nested = serde_json::json!([{"a": "b", "component_a": 0, "b": "a", "component_b": 0, "relation": "in"}]);
    assert_eq!(report["frames"][0]["containment"], nested);
    assert_eq!((&report["objects"][0]["components"], &report["objects"][1]["components"]), (&1.into(), &1.into()));
    let rows = succeeds(&dir, &format!("{command} --containment"));
    assert!(
        rows.lines().next().unwrap().ends_with(",touching,containment") && rows.ends_with(",0,\"b/0 in a/0\"\n"),
        "{rows}"
    );
    assert!(object(&dir, &format!("{command} --json"))["frames"][0]["containment"].is_null());
    for option in ["--first-hit", "--summary"] {
        refuses(&dir, &format!("{command} --containment {option}"), "cannot be used with");
    }

    // Two boxes in one mesh, of which one is around a third, and touches a fourth; then the mesh without its last triangle.
    let home = tempfile::tempdir().unwrap();
    let at = |text: String, [x, y, z]: [f64; 3]| -> String {
        let moved = |line: &str| {
            let numbers: Vec<f64> = line.split(' ').skip(1).map(|x| x.parse().unwrap()).collect();
            format!("v {} {} {}\n", numbers[0] + x, numbers[1] + y, numbers[2] + z)
        };
        text.lines().filter(|line| line.starts_with('v')).map(moved).collect()
    };
    let faces =
        "f 1 3 4\nf 1 4 2\nf 5 6 8\nf 5 8 7\nf 1 2 6\nf 1 6 5\nf 3 7 8\nf 3 8 4\nf 1 5 7\nf 1 7 3\nf 2 4 8\nf 2 8 6\n";
    let more = faces.lines().map(|line| {
        let numbers = line.split(' ').skip(1).map(|x| (x.parse::<u32>().unwrap() + 8).to_string());
        format!("f {}\n", numbers.collect::<Vec<_>>().join(" "))
    });
    let (small, large) = (block([1.0; 3]), block([9.0; 3]));
    let vertices =
        |first: [f64; 3], second: [f64; 3], other: &String| at(large.clone(), first) + &at(other.clone(), second);
    let faces = faces.to_owned() + &more.collect::<String>();
    fs::write(home.path().join("a.obj"), vertices([0.0; 3], [20.0, 0.0, 0.0], &large) + &faces).unwrap();
    fs::write(home.path().join("b.obj"), vertices([2.5, 2.5, -4.5], [3.0, 4.0, 5.0], &small) + &faces).unwrap();
    let scene = "name = \"c\"\n[a]\nmesh = \"a.obj\"\n[b]\nmesh = \"b.obj\"\n[[pose]]\naxis = [1, 1, 1]\nangle_degrees = 0.25\n\
        [[pose]]\ntranslation = [20, 0, 0.1]\n[[pose]]\ntranslation = [0, 0, 100]\n";
    fs::write(home.path().join("c.toml"), scene).unwrap();
    let rows = succeeds(home.path(), "scene pairs c.toml --containment");
    let ends: Vec<&str> = rows.lines().skip(1).map(|row| row.split(',').next_back().unwrap()).collect();
    assert_eq!(ends, ["\"a/0 touches b/0; b/1 in a/0\"", "\"a/1 touches b/0; b/1 in a/1\"", "\"\""]);
    let cut = faces.lines().take(23).map(|line| format!("{line}\n")).collect::<String>();
    fs::write(home.path().join("b.obj"), vertices([2.5, 2.5, -4.5], [3.0, 4.0, 5.0], &small) + &cut).unwrap();
    let (status, output, errors) = efsat(home.path(), "scene pairs c.toml --containment");
    assert_eq!((status, output.as_str()), (Some(2), ""), "{errors}");
    let expected = "error: c.toml: object b: the mesh is open: at the edge of triangle 14 from 4 4 6 to 4 5 6 the number of triangles is \
        1, expected an even number; --containment expects closed meshes\n";
    assert_eq!(errors, expected);
}

/// Two cones tip to tip: every triangle of one touches every one of the other, which no filter decides.
#[test]
fn many_triangles_at_one_point_take_no_time() {
    let home = tempfile::tempdir().unwrap();
    let cone = |height: f64, count: u32| -> String {
        let corner = |i: u32| {
            let angle = std::f64::consts::TAU * f64::from(i) / f64::from(count);
            format!("v {} {} {height}\n", angle.cos(), angle.sin())
        };
        let face = |i: u32| format!("f 1 {} {}\n", i + 2, (i + 1) % count + 2);
        "v 0 0 0\n".to_owned() + &(0..count).map(corner).collect::<String>() + &(0..count).map(face).collect::<String>()
    };
    for (name, height) in [("up.obj", 1.0), ("down.obj", -1.0)] {
        fs::write(home.path().join(name), cone(height, 300)).unwrap();
    }
    let pose = "[[pose]]\ntranslation = [0, 0, 0]\n[[pose]]\nmatrix = [0, -1, 0, 1, 0, 0, 0, 0, 1]\n";
    let scene = format!("name = \"cones\"\n[a]\nmesh = \"up.obj\"\n[b]\nmesh = \"down.obj\"\n{pose}");
    fs::write(home.path().join("cones.toml"), scene).unwrap();
    let report = object(home.path(), "scene pairs cones.toml --json");
    assert_eq!(report["total"]["touching"], 2 * 300 * 300);
}

/// The eight corners of a box as an OBJ file, with its twelve triangles.
fn block(size: [f64; 3]) -> String {
    let corner = |i: usize| {
        format!(
            "v {} {} {}\n",
            size[0] * f64::from(i as u32 & 1),
            size[1] * f64::from(i as u32 >> 1 & 1),
            size[2] * f64::from(i as u32 >> 2 & 1)
        )
    };
    let faces = "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
    (0..8).map(corner).collect::<String>() + faces
}

/// Ten blocks in a row, each touching the next, one of which is lifted and turned away.
#[test]
fn scenes_of_many_objects_meet_where_boxes_do() {
    let home = tempfile::tempdir().unwrap();
    fs::write(home.path().join("block.obj"), block([1.0, 1.0, 1.0])).unwrap();
    let objects: String = (0..10)
        .map(|i| {
            format!("[[object]]\nname = \"o{i}\"\nmesh = \"block.obj\"\nplaced = {{ translation = [{i}, 0, 0] }}\n")
        })
        .collect();
    let moves = "[[pose]]\nlabel = \"as it was\"\nobject = \"o4\"\ntranslation = [4, 0, 0]\n\
        [[pose]]\nlabel = \"away\"\nobject = \"o4\"\ntranslation = [4, 5, 0]\n\
        [[trajectory]]\nframes = 3\n[[trajectory.track]]\nobject = \"o0\"\n\
        [[trajectory.track.key]]\ntime = 0\n[[trajectory.track.key]]\ntime = 1\ntranslation = [0, 0, 8]\n\
        axis = [0, 0, 1]\nangle_degrees = 90\n";
    fs::write(home.path().join("row.toml"), format!("name = \"row\"\n{objects}{moves}")).unwrap();
    let report = object(home.path(), "scene pairs row.toml --json");
    let column = |key: &str| -> Vec<u64> {
        report["frames"].as_array().unwrap().iter().map(|row| row[key].as_u64().unwrap()).collect()
    };
    assert_eq!(column("meetings"), [9, 7, 9, 8, 8]);
    // Two blocks that share a face have the same pairs of triangles in contact wherever they stand.
    let touching = column("touching");
    assert_eq!(touching[0] / 9 * 9, touching[0]);
    let one = touching[0] / 9;
    assert_eq!(touching, [9 * one, 7 * one, 9 * one, 8 * one, 8 * one]);
    let classified = object(home.path(), "classify row.toml --exact --json");
    let exact = &classified["exact"];
    assert_eq!(exact["touch"].as_u64().unwrap() + exact["intersect"].as_u64().unwrap(), touching.iter().sum::<u64>());
    assert_eq!(classified["wrong"], 0);
    let compared = object(home.path(), "compare row.toml --json");
    assert_eq!(compared["pairs"], classified["pairs"]);
    let simulated = object(home.path(), "cosim --scene row.toml --limit 10000 --simulator builtin --json");
    assert_eq!(simulated["mismatches"], 0);
    assert_eq!(simulated["verdicts"], classified["verdicts"], "all pairs are in the sample");
}

#[test]
fn broken_faces_are_reported_and_the_scene_goes_on() {
    let home = tempfile::tempdir().unwrap();
    fs::write(home.path().join("good.obj"), block([1.0, 1.0, 1.0])).unwrap();
    fs::write(home.path().join("bad.obj"), block([1.0, 1.0, 1.0]) + "f 1 2 99\nf 1 2\nf 1 1 2\n").unwrap();
    let scene =
        "name = \"b\"\n[a]\nmesh = \"good.obj\"\n[b]\nmesh = \"bad.obj\"\n[[pose]]\ntranslation = [0.5, 0.5, 0.5]\n";
    fs::write(home.path().join("b.toml"), scene).unwrap();
    let (status, output, errors) = efsat(home.path(), "scene pairs b.toml --json");
    assert_eq!(status, Some(0), "{errors}");
    let expected = "warning: b.toml: object b: faces left out: 1 with fewer than three corners (first: line 16: a face of \
        2 vertices), 1 with a vertex out of range (first: line 15: vertex '99' in a file of 8); faces kept: 1 \
        degenerate (first: triangle 8.0)\n";
    assert_eq!(errors, expected);
    let report: Value = serde_json::from_str(&output).unwrap();
    assert_eq!(report["objects"][0]["findings"]["list"], serde_json::json!([]));
    let found = &report["objects"][1]["findings"]["list"];
    assert_eq!((&found[1]["defect"], &found[1]["count"]), (&Value::from("out_of_range"), &Value::from(1)));
    assert_eq!(efsat(home.path(), "classify b.toml --summary").2, expected);
    for (arguments, part) in [
        ("scene", "no command: expected one of pairs"),
        ("scene paint", "expected one of pairs"),
        ("scene pairs b.toml --k 8", "'8' for '--k <K>': expected one of 6, 14, 18, 26"),
        ("scene pairs none.toml", "none.toml: cannot be read"),
        ("scene pairs b.toml --json --summary", "cannot be used with"),
    ] {
        refuses(&home, arguments, part);
    }
}
