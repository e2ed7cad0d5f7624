//! `efsat self-intersections`: the list is that of the file, and with a grid a line says that it is not.

use crate::tools::program::{PROGRAM, ran, succeeds};
use efsat::exact::{self, Exact};
use serde_json::Value;
use std::fs;
use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

/// Standard output of a run that succeeds and says nothing else.
fn told(dir: &Path, arguments: &str) -> String {
    succeeds(dir, &format!("self-intersections {arguments}"))
}

fn object(dir: &Path, arguments: &str) -> Value {
    serde_json::from_str(&told(dir, &format!("{arguments} --json"))).unwrap()
}

/// All self-intersections, and each kind.
fn counts(object: &Value) -> [u64; 5] {
    ["defects", "crossing", "touching", "neighbours_meet", "duplicate"].map(|key| object[key].as_u64().unwrap())
}

fn repository(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

/// Meshes of public reports, in which a grid invents contacts or loses them.
#[test]
fn reported_meshes_get_the_list_of_the_file() {
    let dir = repository("testbench/reported");
    let cases = [
        // Two facets that make an angle of 1e-7.
        ("tetgen_flat.obj", [0; 5]),
        // Two boxes one binary32 ulp apart, and one binary64 ulp.
        ("meshlib_6857_gap.obj", [0; 5]),
        ("openscad_1854.obj", [0; 5]),
        // Two parts of 3 mm that overlap, on a site in UTM coordinates.
        ("tiny_in_big.obj", [12, 12, 0, 0, 0]),
    ];
    for (file, expected) in cases {
        let object = object(&dir, &format!("{file} --exact"));
        assert_eq!((counts(&object), &object["contradictions"]), (expected, &Value::from(0)), "{file}");
        assert_eq!((object.get("grid"), object.get("moved"), object.get("asked")), (None, None, None));
        assert!(told(&dir, file).contains(", coordinates as given\n"));
    }
}

/// The meshes of the scenes; that these are all is shown by a computation of its own (`gen/geometry/self_intersections/tests.rs`).
#[test]
fn meshes_of_scenes_get_the_list_of_the_file() {
    let dir = repository("scenes");
    let cases = [
        ("m8_bolt.stl", [1318, 474, 0, 844, 0]),
        ("m8_nut.stl", [597, 215, 0, 382, 0]),
        ("cad_headlight.stl", [271, 129, 0, 142, 0]),
    ];
    for (file, expected) in cases {
        assert_eq!(counts(&object(&dir, file)), expected, "{file}");
    }
}

#[test]
fn a_grid_says_how_far_it_moved_the_mesh() {
    let dir = repository("testbench/reported");
    let line = |arguments: &str| told(&dir, arguments).lines().nth(1).unwrap().to_owned();
    assert_eq!(
        line("tiny_in_big.obj --width 32"),
        "vertices moved by up to 9.35e-8, none merged with others: the list is that of the moved mesh, not of the file"
    );
    assert!(line("tiny_in_big.obj --width 18").contains(" merged with others: the list is that of the moved mesh"));
    // The moved mesh has another list.
    let fine = object(&dir, "tiny_in_big.obj --width 32 --exact");
    assert_eq!((counts(&fine), &fine["contradictions"]), ([10, 10, 0, 0, 0], &Value::from(0)));
    assert_eq!(
        (fine["width"].as_u64(), fine["grid"].as_f64(), fine["merged"].as_u64()),
        (Some(32), Some(2f64.powi(-23)), Some(0))
    );
    // Half a step along each axis at most.
    let moved = fine["moved"].as_f64().unwrap();
    assert!(moved > 2f64.powi(-25) && moved <= 2f64.powi(-24) * 3f64.sqrt(), "{moved}");
    let coarse = object(&dir, "tiny_in_big.obj --grid 0.01");
    assert_eq!((&coarse["width"], &coarse["vertices"], &coarse["merged"]), (&18.into(), &16.into(), &8.into()));
    // Whole numbers stay where they are.
    let home = tempfile::tempdir().unwrap();
    fs::write(home.path().join("m.obj"), "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 4 0 0\nf 1 2 3\n").unwrap();
    let still = told(home.path(), "m.obj --grid 1");
    assert!(
        still.contains(" 3 vertices on a grid of 1, 18 bits\nno vertex moved: the list is that of the file\n"),
        "{still}"
    );
}

#[test]
fn vertices_of_equal_coordinates_are_one() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    // Two triangles with a common edge that neither shares by number, one of whose zeros is negative.
    let mesh = "v 0 0 0\nv 1 0 0\nv 0.3 1 0\nv -0 0 0\nv 1 0 -0\nv 0.3 0 1\nf 1 2 3\nf 4 5 6\n";
    fs::write(dir.join("m.obj"), mesh).unwrap();
    for grid in ["", " --width 18"] {
        let object = object(dir, &format!("m.obj{grid} --exact"));
        assert_eq!((counts(&object), object["neighbours"].as_u64()), ([0; 5], Some(1)));
    }
}

#[test]
fn the_unit_answers_on_a_grid() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    let mesh = repository("scenes/m8_nut.stl");
    let arguments = "--width 18 --exact --csv d.csv --pairs p.csv --picture p.png";
    let object = object(dir, &format!("{} {arguments}", mesh.display()));
    let numbers =
        ["triangles", "defects", "crossing", "contradictions", "by_host"].map(|key| object[key].as_u64().unwrap());
    assert_eq!(numbers, [4218, 588, 214, 0, 0]);
    let rows = fs::read_to_string(dir.join("d.csv")).unwrap();
    assert_eq!((rows.lines().next(), rows.lines().count()), (Some("first,second,kind"), 589));
    assert!(fs::read(dir.join("p.png")).unwrap().starts_with(b"\x89PNG"));
    let pairs = fs::read_to_string(dir.join("p.csv")).unwrap();
    assert_eq!(pairs.lines().count() as u64, object["asked"].as_u64().unwrap());
    let some: Vec<&str> = pairs.lines().step_by(500).collect();
    fs::write(dir.join("some.csv"), some.join("\n")).unwrap();
    succeeds(dir, "cosim some.csv --method exact --simulator builtin");
    // A coarser unit has a coarser grid; on a finer one some pairs do not fit, and the host decides them.
    let told = told(dir, "builtin:gear --width 12 --grid 0.001 --exact");
    let count = |part: &str| told.lines().find(|line| line.contains(part)).unwrap().rsplit(' ').next().unwrap();
    let [all, unit, host] =
        ["asked about", "by the unit", "by the host"].map(|part| count(part).parse::<u64>().unwrap());
    assert!(all == unit + host && host > 0, "{told}");
}

#[test]
fn rows_of_the_file_are_those_of_the_table() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    let mesh = repository("scenes/m8_nut.stl");
    let object = object(dir, &format!("{} --csv d.csv --picture p.svg", mesh.display()));
    let rows = fs::read_to_string(dir.join("d.csv")).unwrap();
    let of_kind = |kind: &str| rows.lines().filter(|row| row.ends_with(kind)).count() as u64;
    let found = [",crossing", ",touching", ",neighbours", ",duplicate"].map(of_kind);
    assert_eq!(found, counts(&object)[1..]);
    let pairs: Vec<(u32, u32)> = rows
        .lines()
        .skip(1)
        .map(|row| {
            let (first, rest) = row.split_once(',').unwrap();
            (first.parse().unwrap(), rest.split(',').next().unwrap().parse().unwrap())
        })
        .collect();
    assert!(pairs.is_sorted() && pairs.iter().all(|(p, q)| p < q));
    assert!(fs::read_to_string(dir.join("p.svg")).unwrap().contains("<svg"));
}

/// Seconds that the exact test of a pair takes which shares a vertex; the least of some runs, as whatever else is running takes time.
fn exact_test() -> f64 {
    let points = [[0.0; 3], [10.0, 0.0, 0.0], [9.5, 3.0, 0.0], [0.0; 3], [-10.0, 0.5, 0.0], [-9.5, -3.0, 0.0]];
    let run = || {
        let start = Instant::now();
        (0..1000).for_each(|_| assert_eq!(exact::pair(black_box(&points)), Ok(Exact::Touch)));
        start.elapsed().as_secs_f64() / 1000.0
    };
    (0..9).map(|_| run()).fold(f64::INFINITY, f64::min)
}

/// A cone, and the disc that it is seen from above: all triangles share one vertex, and all pairs are neighbours. 18 million pairs
/// take less than a tenth of the time of their exact tests.
#[test]
fn triangles_around_one_vertex_take_no_exact_tests() {
    let home = tempfile::tempdir().unwrap();
    let count = 6000;
    for (name, tip) in [("cone", 5), ("disc", 0)] {
        let mut mesh = format!("v 0 0 {tip}\n");
        for index in 0..count {
            let (y, x) = (f64::from(index) * std::f64::consts::TAU / f64::from(count)).sin_cos();
            mesh += &format!("v {:.4} {:.4} 0\n", 10.0 * x, 10.0 * y);
        }
        (0..count).for_each(|index| mesh += &format!("f 1 {} {}\n", index + 2, (index + 1) % count + 2));
        fs::write(home.path().join("mesh.obj"), mesh).unwrap();
        // The times of the shell's children are the last line: user and system.
        let run = || {
            let script = "\"$0\" self-intersections mesh.obj --json; times";
            let mut command = Command::new("sh");
            let (_, text, _) = ran(command.args(["-c", script, PROGRAM]).current_dir(&home));
            let object: Value = serde_json::from_str(text.lines().next().unwrap()).unwrap();
            assert_eq!((counts(&object), object["neighbours"].as_u64()), ([0; 5], Some(17_997_000)), "{name}");
            let seconds = text.lines().last().unwrap().split_whitespace().map(|time| {
                let (minutes, seconds) = time.trim_end_matches('s').split_once('m').unwrap();
                60.0 * minutes.parse::<f64>().unwrap() + seconds.parse::<f64>().unwrap()
            });
            seconds.sum::<f64>()
        };
        // The least of some runs: whatever else is running takes time, too.
        let seconds = (0..3).map(|_| run()).fold(f64::INFINITY, f64::min);
        let exact = 17_997_000.0 * exact_test();
        assert!(10.0 * seconds < exact, "{name}: {seconds} s, exact tests {exact} s");
    }
}
