//! The built-in scenes through the program: no definite verdict contradicts the exact answer, re-normalisation is what
//! makes most of them definite, and both formulations of the exact answer agree on every pair.

use efsat::exact::{linear_programme, posed_relation};
use efsat::scene::{load, Scene};
use rayon::prelude::*;
use serde_json::Value;
use std::process::Command;

fn classify(args: &[&str]) -> Value {
    let output =
        Command::new(env!("CARGO_BIN_EXE_efsat")).arg("classify").args(args).args(["--exact", "--json"]).output();
    let output = output.expect("it runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("one JSON object")
}

/// Share of definite verdicts.
fn definite(report: &Value) -> f64 {
    assert_eq!(report["wrong"], 0, "{report}");
    1.0 - report["verdicts"]["possibly_incorrect"].as_f64().unwrap() / report["pairs"].as_f64().unwrap()
}

#[test]
fn default_scene() {
    let shares = [&[][..], &["--width", "19"], &["--renormalise", "off"], &["--axes", "17", "--upper", "sticky"]];
    let [default, wider, raw, sticky] = shares.map(|change| {
        let mut args = vec!["--scene", "headlight"];
        args.extend(change);
        definite(&classify(&args))
    });
    assert!(default > 0.98, "{default}");
    assert!(wider > 0.99, "one more bit: {wider}");
    assert!(raw < 0.5, "without re-normalisation: {raw}");
    assert!(sticky > default, "exact ceilings: {sticky}");
}

const BOLT_NUT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/bolt_nut.toml");

#[test]
fn bolt_and_nut() {
    assert!(definite(&classify(&["--scene", BOLT_NUT])) > 0.98);
}

/// The pairs of a scene, and those on which the two formulations disagree, as pose and faces.
fn disagreements(scene: &Scene) -> (usize, Vec<(usize, (u32, u32))>) {
    let trees = scene.broad_phase();
    let compared = |pose: usize| {
        let (m, t) = (&scene.poses[pose].rotation, scene.poses[pose].translation.into());
        let m = [0, 1, 2].map(|i| [0, 1, 2].map(|j| m[(i, j)]));
        let pairs = trees.pairs(pose);
        let differ = |&(a, b): &(u32, u32)| {
            let a = scene.a.faces[a as usize].map(|vertex| scene.a.vertices[vertex as usize].into());
            let b = scene.b.faces[b as usize].map(|vertex| scene.b.vertices[vertex as usize].into());
            posed_relation(&a, &b, &m, &t) != linear_programme::posed_relation(&a, &b, &m, &t)
        };
        (pairs.len(), pairs.into_iter().filter(differ).map(|pair| (pose, pair)).collect::<Vec<_>>())
    };
    let poses = (0..scene.poses.len()).into_par_iter().map(compared);
    poses.reduce(Default::default, |x, y| (x.0 + y.0, [x.1, y.1].concat()))
}

#[test]
fn both_formulations_agree_on_every_pair_of_both_scenes() {
    for scene in [Scene::default_scene(), load(BOLT_NUT.as_ref()).expect("it is ours")] {
        let (pairs, wrong) = disagreements(&scene);
        assert!(pairs > 100_000, "{}: {pairs} pairs", scene.name);
        assert!(wrong.is_empty(), "{}: {wrong:?}", scene.name);
    }
}
