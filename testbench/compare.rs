//! `efsat compare` as others script against it: the paper's table, its fields, and one clear line for every error.

use crate::tools::program::{self, refuses, succeeds};
use serde_json::Value;
use std::fs;
use std::path::Path;

fn object(dir: &Path, arguments: &str) -> Value {
    program::object(dir, &format!("compare {arguments} --json"))
}

fn number(value: &Value) -> u64 {
    value.as_u64().unwrap_or_else(|| panic!("{value} is no count"))
}

fn row<'a>(report: &'a Value, [efsat, moeller, sat]: [&str; 3]) -> &'a Value {
    let is = |row: &&Value| row["efsat"] == efsat && row["moeller"] == moeller && row["sat"] == sat;
    report["rows"].as_array().unwrap().iter().find(is).expect("all twelve rows are there")
}

fn software<'a>(report: &'a Value, test: &str) -> &'a Value {
    report["software"].as_array().unwrap().iter().find(|line| line["test"] == test).expect("the test is there")
}

/// What holds for every report: rows and truths add up, and the columns' errors are those of their rows.
fn is_consistent(report: &Value) {
    let rows = report["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 12);
    let truths = |row: &Value| ["separate", "touch", "intersect"].map(|class| number(&row["truth"][class]));
    for row in rows {
        assert_eq!(number(&row["pairs"]), truths(row).iter().sum::<u64>());
    }
    assert_eq!(number(&report["pairs"]), rows.iter().map(|row| number(&row["pairs"])).sum::<u64>());
    for column in ["moeller", "sat"] {
        let of = |answer: &'static str| rows.iter().filter(move |row| row[column] == answer).map(truths);
        let missed: u64 = of("separate").map(|[_, touch, intersect]| touch + intersect).sum();
        let wrongly_seen: u64 = of("intersect").map(|[separate, ..]| separate).sum();
        let errors = serde_json::json!({"missed": missed, "false": wrongly_seen});
        assert_eq!(report["wrong"][column], errors, "{column}");
        let test = software(report, if column == "sat" { "sat-11-f64" } else { "moeller-epsilon" });
        assert_eq!((&test["missed"], &test["false"]), (&errors["missed"], &errors["false"]));
    }
    assert_eq!(report["wrong"]["efsat"], 0);
}

const ORDER: [&str; 3] = ["separate", "possibly-incorrect", "intersect"];

/// Pairs whose answers are known: proper, coplanar disjoint (no eleven axes separate it), shared vertex, and small
/// triangles in parallel planes (Moeller's epsilon takes them for coplanar).
const PAIRS: &str = "0,0,0, 4,0,0, 0,4,0, 1,1,-1, 1.25,1.5,1, 2,0.75,1.5\n\
    0,0,0, 4,0,0, 0,4,0, 0,0,9, 1,0,9, 0,1,9\n\
    0,0,0, 4,0,0, 0,4,0, 8,8,0, 9,8,0, 8,9,0\n\
    0,0,0, 4,0,0, 0,4,0, 0,0,0, 1,0,9, 0,1,9\n\
    0,0,0, 0.01,0,0, 0,0.01,0, 0,0,0.002, 0.01,0,0.002, 0,0.01,0.002\n";

#[test]
fn known_pairs_come_in_their_rows() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    fs::write(dir.join("pairs.csv"), PAIRS.replace(' ', "")).unwrap();
    let report = object(dir, "pairs.csv");
    is_consistent(&report);
    assert_eq!((&report["source"], &report["pairs"]), (&"pairs.csv".into(), &5.into()));
    let order = report["rows"].as_array().unwrap().iter().map(|row| row["efsat"].as_str().unwrap());
    assert!(order.eq(ORDER.iter().flat_map(|word| [*word; 4])), "the paper's order");
    let expected = [
        (["intersect", "intersect", "intersect"], [0, 0, 1]),
        (["separate", "separate", "separate"], [1, 0, 0]),
        (["possibly-incorrect", "separate", "intersect"], [1, 0, 0]),
        (["possibly-incorrect", "intersect", "intersect"], [0, 1, 0]),
        (["separate", "intersect", "separate"], [1, 0, 0]),
    ];
    for (words, [separate, touch, intersect]) in expected {
        let truth = serde_json::json!({"separate": separate, "touch": touch, "intersect": intersect});
        assert_eq!(row(&report, words)["truth"], truth, "{words:?}");
    }
    assert_eq!(
        software(&report, "moeller"),
        &serde_json::json!({"test": "moeller", "missed": 0, "false": 0,
        "source": software(&report, "moeller-epsilon")["source"]})
    );
    assert!(report.get("units").is_none() && report.get("rounding").is_none());
    // With 17 axes the unit finds the coplanar separation.
    let more = object(dir, "pairs.csv --axes 17 --upper sticky");
    assert_eq!(row(&more, ["separate", "separate", "intersect"])["pairs"], 1);
    let text = succeeds(dir, "compare pairs.csv");
    assert!(text.contains("separate            intersect  separate            1   20.000 %"), "{text}");
    assert!(text.contains("EFSAT, definite                                   0    0.0000 %"), "{text}");
}

#[test]
fn scenes_and_meshes_are_counted_alike() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    let scene = "name = \"s\"\n[a]\nmesh = \"builtin:headlight\"\n[b]\nmesh = \"builtin:headlight\"\n\
                 [tumble]\nsteps = 12\ndistances = [1.6, 1.45]\n";
    fs::write(dir.join("s.toml"), scene).unwrap();
    let mesh = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/cad_headlight.stl");
    let by_file = object(dir, "s.toml");
    is_consistent(&by_file);
    assert!(number(&by_file["pairs"]) > 300 && by_file["poses"] == 24 && by_file["units"] == "cube");
    assert!(by_file["rounding"]["missed"].is_u64());
    assert!(software(&by_file, "held")["on_rounded_vertices"]["false"].is_u64());
    let same = [
        object(dir, "--scene s.toml"),
        object(dir, &format!("--mesh {mesh} --steps 12 --distances 1.6,1.45")),
        object(dir, "s.toml --units cube"),
    ];
    for other in same {
        assert_eq!((&other["rows"], &other["software"]), (&by_file["rows"], &by_file["software"]));
    }
    // In millimetres the triangles are 128 times larger, so that Moeller's epsilon takes fewer for coplanar; it is
    // the only number that a unit of length changes.
    let millimetres = object(dir, "s.toml --units file");
    is_consistent(&millimetres);
    let of = |report: &Value, test| number(&software(report, test)["false"]);
    assert!(of(&by_file, "moeller-epsilon") > of(&millimetres, "moeller-epsilon"));
    for test in ["moeller", "held", "sat-11-f64", "sat-17-f32", "guigue-devillers"] {
        assert_eq!(software(&by_file, test), software(&millimetres, test));
    }
}

/// 0.1 * 0.35 is less as a binary64 number than as a product of the reals: an A that ends at the former is separate
/// from a B that starts at the latter, and touches the B that software reads.
#[test]
fn the_rounding_of_the_pose_is_told_apart() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    fs::write(dir.join("a.obj"), "v 0.034999999999999996 0 0\nv -1 -1 0\nv -1 1 0\nf 1 2 3\n").unwrap();
    fs::write(dir.join("b.obj"), "v 0.35 0 0\nv 1 -1 0\nv 1 1 0\nf 1 2 3\n").unwrap();
    let pose = "[[pose]]\nmatrix = [0.1, 0, 0, 0, 1, 0, 0, 0, 1]\n";
    let scene = format!("name = \"r\"\n[a]\nmesh = \"a.obj\"\n[b]\nmesh = \"b.obj\"\n{pose}");
    fs::write(dir.join("r.toml"), scene).unwrap();
    let report = object(dir, "r.toml");
    is_consistent(&report);
    assert_eq!(report["pairs"], 1);
    let one = serde_json::json!({"missed": 0, "false": 1});
    let none = serde_json::json!({"missed": 0, "false": 0});
    assert_eq!(report["rounding"], one);
    let test = software(&report, "sat-17-f64");
    assert_eq!((&test["false"], &test["on_rounded_vertices"]), (&1.into(), &none));
}

#[test]
fn random_pairs_replay_and_eleven_axes_are_wrong_on_them() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    let report = object(dir, "--random 20000 --seed 5");
    is_consistent(&report);
    assert_eq!(report["source"], "random 20000, seed 5");
    assert!(number(&report["wrong"]["sat"]["false"]) > 500, "coplanar pairs are among them");
    assert!(number(&software(&report, "sat-17-f64")["false"]) < number(&report["wrong"]["sat"]["false"]));
    assert_eq!(report, object(dir, "--random 20000 --seed 5"));
    assert_ne!(report["rows"], object(dir, "--random 20000 --seed 6")["rows"]);
}

#[test]
fn wrong_command_lines_and_files_are_one_line_and_status_2() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    let files: [(&str, &[u8]); 6] = [
        ("empty.csv", b""),
        ("pairs.csv", b"0,0,0,4,0,0,0,4,0,1,1,-1,1.25,1.5,1,2,0.75,1.5\n"),
        ("cut.f64", &[0; 100]),
        ("broken.stl", b"solid nothing\n"),
        ("broken.obj", b"v 0 0 0\nf 1 2 3\n"),
        ("broken.toml", b"name = \n"),
    ];
    for (name, bytes) in files {
        fs::write(dir.join(name), bytes).unwrap();
    }
    let cases = [
        ("absent.csv", "absent.csv"),
        ("empty.csv", "found no pair"),
        ("cut.f64", "found 100 bytes; expected a multiple of 144"),
        ("pairs.txt", "expected .csv or .f64"),
        ("broken.toml", "broken.toml:1:"),
        ("--scene absent.toml", "absent.toml"),
        ("--mesh absent.stl", "absent.stl: cannot be read"),
        ("--mesh pairs.csv", "expected .stl, .obj, .ply or .off"),
        ("--mesh broken.stl", "broken.stl:"),
        ("--mesh broken.obj", "broken.obj:2:"),
        ("--mesh", "a value is required"),
        ("--mesh a.stl --scene headlight", "cannot be used with"),
        ("pairs.csv --mesh a.stl", "cannot be used with"),
        ("pairs.csv --random 3", "cannot be used with"),
        ("pairs.csv --units cube", "--units: found a file of pairs"),
        ("--random 3 --units cube", "cannot be used with"),
        ("--random 0", "expected a whole number from 1 to 18446744073709551615"),
        ("--seed 3", "required"),
        ("--steps 3", "required"),
        ("--distances 1", "required"),
        ("--scene headlight --steps 3", "cannot be used with"),
        ("--random 3 --distances 1", "cannot be used with"),
        ("pairs.csv --steps 3", "cannot be used with"),
        ("--mesh a.stl --steps 0", "expected a whole number from 1 to 100000"),
        ("--mesh a.stl --distances 1,nan", "expected finite numbers"),
        ("--mesh a.stl --distances 1,,2", "expected finite numbers"),
        ("--scene headlight --units mile", "expected one of cube, file"),
        ("--moeller", "unexpected argument '--moeller'"),
        ("--width 5", "expected a whole number from 6 to 32"),
    ];
    for (arguments, part) in cases {
        refuses(dir, &format!("compare {arguments}"), part);
    }
    fs::write(dir.join("t.obj"), "v 0 0 0\nv 9 0 0\nv 0 9 5\nf 1 2 3\n").unwrap();
    refuses(
        dir,
        "compare --mesh t.obj --distances 1e308",
        "the translation of b overflows: expected smaller meshes or distances",
    );
}
