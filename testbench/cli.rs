//! The command line as others script against it: results, JSON fields, exit statuses, and one clear line for every
//! error.

mod messages;

use crate::tools::program::{Ran, command, efsat, fails, object, succeeds};
use serde_json::Value;
use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Output, Stdio};

/// A pair that intersects, one that is separate, one that shares a vertex.
const PAIRS: [[f64; 18]; 3] = [
    [0., 0., 0., 4., 0., 0., 0., 4., 0., 1., 1., -1., 1.25, 1.5, 1., 2., 0.75, 1.5],
    [0., 0., 0., 4., 0., 0., 0., 4., 0., 0., 0., 9., 1., 0., 9., 0., 1., 9.],
    [0., 0., 0., 4., 0., 0., 0., 4., 0., 0., 0., 0., 1., 0., 9., 0., 1., 9.],
];

fn csv() -> String {
    let row = |pair: &[f64; 18]| pair.map(|x| x.to_string()).join(",") + "\n";
    PAIRS.iter().map(row).collect()
}

fn raw() -> Vec<u8> {
    PAIRS.iter().flatten().flat_map(|x| x.to_le_bytes()).collect()
}

/// Runs the program with `input` on its standard input.
fn efsat_with(dir: &Path, line: &str, input: &[u8]) -> Ran {
    let mut command = command(dir, line);
    let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    // It may end without reading.
    let _ = child.stdin.take().unwrap().write_all(input);
    let Output { status, stdout, stderr } = child.wait_with_output().unwrap();
    (status.code(), String::from_utf8(stdout).unwrap(), String::from_utf8(stderr).unwrap())
}

/// Names and bytes of all files below a directory.
fn tree(dir: &Path) -> Vec<(String, Vec<u8>)> {
    let mut files = vec![];
    for entry in fs::read_dir(dir).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        if path.is_dir() {
            files.extend(tree(&path).into_iter().map(|(below, bytes)| (format!("{name}/{below}"), bytes)));
        } else {
            files.push((name, fs::read(&path).unwrap()));
        }
    }
    files.sort();
    files
}

#[test]
fn classify_prints_one_row_a_pair() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    fs::write(dir.join("pairs.csv"), csv()).unwrap();
    fs::write(dir.join("pairs.f64"), raw()).unwrap();
    let expected = "pair,verdict\n0,intersect\n1,separate\n2,possibly-incorrect\n";
    for name in ["pairs.csv", "pairs.f64"] {
        assert_eq!(succeeds(dir, &format!("classify {name}")), expected);
    }
    let (_, output, _) = efsat_with(dir, "classify -", format!("{}\n{}", "x,".repeat(17), csv()).as_bytes());
    assert_eq!(output, expected, "with a header, on standard input");
    assert_eq!(
        succeeds(dir, "classify pairs.csv --exact"),
        "pair,verdict,exact\n0,intersect,intersect\n1,separate,separate\n2,possibly-incorrect,touch\n"
    );
    assert_eq!(
        object(dir, "classify pairs.csv --json"),
        serde_json::json!({"pairs": 3, "host_decided": 0,
            "verdicts": {"separate": 1, "intersect": 1, "possibly_incorrect": 1}})
    );
    let exact = object(dir, "classify pairs.f64 --json --exact");
    assert_eq!(exact["exact"], serde_json::json!({"separate": 1, "touch": 1, "intersect": 1, "coplanar": 0}));
    assert_eq!(exact["wrong"], 0);
    assert!(succeeds(dir, "classify pairs.csv --summary").contains("possibly-incorrect             1"));
}

#[test]
fn classify_takes_scenes_and_random_pairs() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    let scene = "name = \"s\"\n[a]\nmesh = \"builtin:headlight\"\n[b]\nmesh = \"builtin:headlight\"\n\
                 [tumble]\nsteps = 4\ndistances = [1.6, 1.45]\n";
    fs::write(dir.join("s.toml"), scene).unwrap();
    let by_file = succeeds(dir, "classify s.toml --exact");
    assert_eq!(by_file, succeeds(dir, "classify --scene s.toml --exact"));
    let counts = object(dir, "classify --scene s.toml --exact --json");
    assert_eq!(counts["pairs"], by_file.lines().count() - 1);
    assert!(counts["pairs"].as_u64().unwrap() > 100);
    // Without a transform the host applies the pose and decides what then lies outside; nothing becomes wrong.
    for options in ["--transform off", "--transform translate --axes 17 --upper sticky", "--width 6"] {
        let other = object(dir, &format!("classify s.toml --exact --json {options}"));
        assert_eq!((&other["pairs"], &other["exact"]), (&counts["pairs"], &counts["exact"]), "{options}");
        assert_eq!(other["wrong"], 0, "{options}");
    }
    let random = succeeds(dir, "classify --random 500 --seed 7 --exact");
    assert_eq!(random.lines().count(), 501);
    assert_eq!(random, succeeds(dir, "classify --random 500 --seed 7 --exact"));
    assert_ne!(random, succeeds(dir, "classify --random 500 --seed 8 --exact"));
}

/// Nothing is left open by the exact unit and its host, whatever the numbers are.
#[test]
fn snapped_geometry_has_answers_of_its_own() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    let scene = "name = \"s\"\n[a]\nmesh = \"builtin:headlight\"\n[b]\nmesh = \"builtin:headlight\"\n\
                 [tumble]\nsteps = 4\ndistances = [1.6, 1.45]\n";
    fs::write(dir.join("s.toml"), scene).unwrap();
    let given = object(dir, "classify s.toml --method exact --exact --json");
    let mut differ = vec![];
    // Coarse grids tell more pairs otherwise. Without room for the differences the host decides, for the same points.
    for (options, by_host) in [("--width 8 --transform-width 9", false), ("", false), ("--transform-width 32", true)] {
        let command = format!("classify s.toml --method exact --truth snapped --exact --json {options}");
        let counts = object(dir, &command);
        assert_eq!((&counts["pairs"], &counts["wrong"]), (&given["pairs"], &0.into()));
        assert_eq!(counts["verdicts"]["possibly_incorrect"], 0);
        assert_eq!(counts["host_decided"].as_u64().unwrap() > 0, by_host, "{options}");
        differ.push(counts["truths_differ"].as_u64().unwrap());
    }
    assert!(differ[0] > differ[1] && differ[2] == 0, "{differ:?}");
    assert!(given.get("truths_differ").is_none());
    fails(dir, "compare --scene s.toml --method exact --truth snapped", 2, "--truth snapped: expected given");
    fails(dir, "classify s.toml --method exact --truth snapped --transform off", 2, "expected on with --truth snapped");
}

#[test]
fn classify_by_the_exact_method_answers_every_pair() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    let (a, far, tiny) = ([[0.0; 3], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]], 1e300, 1e-300);
    let on_grid = [
        // Through the face, on it, above it; with a common vertex and a common edge.
        [[1.0, 1.0, -1.0], [1.5, 1.25, 1.0], [2.0, 1.5, 1.25]],
        [[1.0, 1.0, 0.0], [1.5, 1.25, 1.0], [2.0, 1.5, 1.25]],
        [[1.0, 1.0, 0.125], [1.5, 1.25, 1.0], [2.0, 1.5, 1.25]],
        [[4.0, 0.0, 0.0], [8.0, 0.0, 1.0], [8.0, 1.0, 0.0]],
        [[4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [4.0, 4.0, 4.0]],
        // In one plane: inside, along an edge, beside.
        [[1.0, 1.0, 0.0], [1.5, 1.0, 0.0], [1.0, 1.5, 0.0]],
        [[1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, -2.0, 0.0]],
        [[5.0, 0.0, 0.0], [6.0, 0.0, 0.0], [5.0, 2.0, 0.0]],
        // A segment through the face and one that ends on an edge; a point in the face and one outside.
        [[1.0, 1.0, -1.0], [1.0, 1.0, 1.0], [1.0, 1.0, 1.0]],
        [[2.0, 2.0, 0.0], [2.0, 2.0, 1.0], [2.0, 2.0, 1.0]],
        [[1.0, 1.0, 0.0]; 3],
        [[3.0, 3.0, 0.0]; 3],
    ];
    let off_grid = [
        [[1.0, 1.0, -tiny], [1.0, 1.0, tiny], [1.5, 1.0, far]],
        [[1.0, 1.0, tiny], [1.0, 1.0, far], [1.5, 1.0, far]],
        [[1.0, 1.0, 0.0], [1.0, 1.0, far], [1.5, tiny, far]],
        [[0.1, 0.2, 0.0], [0.3, 0.7, 0.0], [0.9, 0.7, 0.0]],
        [[-tiny, -tiny, -tiny], [far, far, far], [0.1, 0.1, 0.1]],
        [[-far, -far, 0.0], [far, far, 0.0], [far, -tiny, 0.0]],
        [[5e-324; 3], [f64::MAX; 3], [-f64::MAX; 3]],
    ];
    let pairs: Vec<efsat::Points> =
        on_grid.iter().chain(&off_grid).map(|b| [a[0], a[1], a[2], b[0], b[1], b[2]]).collect();
    let raw: Vec<u8> = pairs.iter().flatten().flatten().flat_map(|x| x.to_le_bytes()).collect();
    fs::write(dir.join("pairs.f64"), raw).unwrap();
    let answers: Vec<efsat::exact::Exact> = pairs.iter().map(|points| efsat::exact::pair(points).unwrap()).collect();
    let verdict = |answer| if answer == efsat::exact::Exact::Separate { "separate" } else { "intersect" };
    let rows = answers.iter().enumerate().map(|(i, answer)| format!("{i},{}\n", verdict(*answer)));
    let expected = rows.fold("pair,verdict\n".to_owned(), |text, row| text + &row);
    for options in ["", " --width 32 --transform translate", " --width 6 --transform-width 6"] {
        let (status, rows, said) = efsat(dir, &format!("classify pairs.f64 --method exact{options}"));
        assert_eq!((status, &rows), (Some(0), &expected), "{options}");
        assert!(said.contains(" of 19 pairs do not fit the exact unit: decided on the host, exactly; "), "{said}");
    }
    let report = object(dir, "classify pairs.f64 --method exact --exact --json");
    let counts = ["pairs", "host_decided", "wrong"].map(|name| report[name].as_u64().unwrap());
    assert_eq!(counts, [19, 7, 0]);
    assert_eq!(report["verdicts"]["possibly_incorrect"], 0);
    let said = succeeds(dir, "classify pairs.f64 --method exact --summary");
    assert!(said.contains("\n7 of them do not fit the exact unit: decided on the host, exactly\n"), "{said}");
    // A rotation leaves the grid; quarter turns and shifts do not.
    fs::write(dir.join("t.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0.5\nf 1 2 3\n").unwrap();
    let scene = "name = \"s\"\n[a]\nmesh = \"t.obj\"\n[b]\nmesh = \"t.obj\"\n[[pose]]\naxis = [0, 0, 1]\n\
                 angle_degrees = 30\n[[pose]]\nmatrix = [0, -1, 0, 1, 0, 0, 0, 0, 1]\n[[pose]]\naxis = [0, 0, 1]\n\
                 angle_degrees = 0\ntranslation = [0.25, 0, 0]\n";
    fs::write(dir.join("s.toml"), scene).unwrap();
    let report = object(dir, "classify --scene s.toml --method exact --exact --json");
    let counts = ["pairs", "host_decided", "wrong"].map(|name| report[name].as_u64().unwrap());
    assert_eq!((counts, &report["verdicts"]["possibly_incorrect"]), ([3, 1, 0], &0.into()));
    for command in ["scene plan s.toml --method exact", "accuracy --method exact", "accuracy --sweep method=exact"] {
        fails(dir, command, 2, "expected axes");
    }
    let report = object(dir, "stress --once --pairs 1 --family shared-edge --sweep method=axes|exact --json");
    let designs: Vec<[u64; 2]> = report["total"]["designs"]
        .as_array()
        .unwrap()
        .iter()
        .map(|design| ["possibly_incorrect", "wrong"].map(|name| design[name].as_u64().unwrap()))
        .collect();
    assert!(designs[0][0] > 0 && designs[1] == [0, 0], "{designs:?}");
}

#[test]
fn a_reader_that_leaves_is_no_error() {
    let mut command = command(".", "classify --random 200000");
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!((output.status.code(), output.stderr.as_slice()), (Some(0), &b""[..]));
}

#[test]
fn generation_is_reproducible_and_checked_to_the_byte() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    succeeds(dir, "generate");
    succeeds(dir, "generate --tag-width 16 --width=18 --out again/deep");
    let files = tree(&dir.join("rtl-out/axes"));
    assert_eq!(files, tree(&dir.join("again/deep")), "however the options are typed");
    succeeds(dir, "generate");
    assert_eq!(files, tree(&dir.join("rtl-out/axes")), "written over itself");
    succeeds(dir, "generate --check");
    fails(dir, "generate --check --width 17 --out rtl-out/axes", 1, "differs manifest.json");
    fails(dir, "generate --check --out absent", 1, "found nothing");
    fails(dir, "generate --ready --check --out absent", 1, "found nothing");
    // A design of other options is not put in the place of a ready one.
    fails(dir, "generate --width 17", 2, "expected --out DIR");
    fails(dir, "generate --stream-width 256", 2, "expected --out DIR");
    assert_eq!(files, tree(&dir.join("rtl-out/axes")));
    succeeds(dir, "generate --method exact --stream-width 1024");
    assert!(dir.join("rtl-out/exact/efsat.vhd").exists());

    for (name, bytes) in files.iter().filter(|(name, _)| name.starts_with("efsat") || name.contains('/')) {
        let mut changed = bytes.clone();
        changed[bytes.len() / 2] ^= 1;
        let path = dir.join("rtl-out/axes").join(name);
        fs::write(&path, changed).unwrap();
        fails(dir, "generate --check", 1, &format!("differs {name}"));
        fs::write(&path, bytes).unwrap();
    }
    fs::write(dir.join("rtl-out/axes/notes.txt"), "mine").unwrap();
    succeeds(dir, "generate --check");
    succeeds(dir, "generate --width 16 --out rtl-out/axes");
    assert_eq!(fs::read_to_string(dir.join("rtl-out/axes/notes.txt")).unwrap(), "mine");
}

#[test]
fn the_manifest_has_the_fields_of_the_contract() {
    let home = tempfile::tempdir().unwrap();
    succeeds(home.path(), "generate");
    let text = fs::read_to_string(home.path().join("rtl-out/axes/manifest.json")).unwrap();
    let manifest: Value = serde_json::from_str(&text).unwrap();
    let line = manifest["command_line"].as_str().unwrap();
    assert!(
        line.starts_with("efsat generate --width 18 --int-bits 4 ")
            && line.ends_with(" --tag-width 16 --stream-width 64")
    );
    assert_eq!((&manifest["initiation_interval"], &manifest["multipliers"]), (&Value::from(11), &Value::from(48)));
    assert!(manifest["latency"].as_u64().unwrap() > 0);
    assert_eq!(manifest["parameters"].as_object().unwrap().len(), 16);
    assert_eq!(manifest["guard"], true);
    assert!(manifest["assumptions"][0].as_str().unwrap().starts_with("input: |coordinate| <= "));
    let port = |name: &str| manifest["ports"].as_array().unwrap().iter().find(|port| port["name"] == name).unwrap();
    assert_eq!(port("in_v0_x")["format"], "s4.28");
    assert_eq!((&port("out_verdict")["direction"], &port("out_verdict")["bits"]), (&"out".into(), &2.into()));
    for (name, bytes) in tree(&home.path().join("rtl-out/axes")) {
        let sum = &manifest["files"][&name];
        assert_eq!(sum.is_string(), name != "manifest.json", "{name}");
        assert!(bytes.is_ascii(), "{name}");
    }
}

#[test]
fn cosim_reports_the_fields_of_the_contract() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    let report = object(dir, "cosim --random 20 --simulator builtin --json");
    assert_eq!(
        (&report["vectors"], &report["mismatches"], &report["host_decided"]),
        (&20.into(), &0.into(), &0.into())
    );
    let verdicts = report["verdicts"].as_object().unwrap();
    assert_eq!(verdicts.keys().collect::<Vec<_>>(), ["intersect", "possibly_incorrect", "separate"]);
    assert_eq!(verdicts.values().filter_map(Value::as_u64).sum::<u64>(), 20);
    assert_eq!(report["initiation_interval"], 11);
    for field in ["latency", "cycles"] {
        assert!(report[field].as_u64().unwrap() > 0, "{field}");
    }
    assert!(report["simulator"].is_string() && report["seconds"].is_f64());
    let said = succeeds(dir, "cosim --random 20 --simulator builtin");
    assert!(said.contains("All 20 vectors, and 39 for the guard, agree bit for bit.\n"), "{said}");

    fs::write(dir.join("pairs.csv"), csv()).unwrap();
    let report = object(dir, "cosim pairs.csv --limit 2 --simulator builtin --json");
    assert_eq!((&report["vectors"], &report["mismatches"]), (&2.into(), &0.into()));
    assert_eq!(report["verdicts"], serde_json::json!({"separate": 1, "intersect": 1, "possibly_incorrect": 0}));
}

#[test]
fn cosim_takes_pairs_that_the_host_decides() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    // Much farther apart than the transform's declared range.
    let scene = "name = \"far\"\n[a]\nmesh = \"t.obj\"\n[b]\nmesh = \"t.obj\"\n[[pose]]\naxis = [0, 0, 1]\n\
                 angle_degrees = 30\ntranslation = [0, 0, 0]\n[[pose]]\nmatrix = [3, 0, 0, 0, 3, 0, 0, 0, 3]\n";
    fs::write(dir.join("far.toml"), scene).unwrap();
    fs::write(dir.join("t.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0.5\nf 1 2 3\n").unwrap();
    let report = object(dir, "cosim --scene far.toml --simulator builtin --json");
    assert_eq!((&report["vectors"], &report["host_decided"]), (&1.into(), &1.into()));
    let sum: u64 = report["verdicts"].as_object().unwrap().values().filter_map(Value::as_u64).sum();
    assert_eq!(sum, 2, "both are counted");
}

#[test]
fn cosim_of_a_guarded_unit_counts_its_own_vectors_apart() {
    let home = tempfile::tempdir().unwrap();
    let small = "--width 6 --transform-width 8 --transform off --simulator builtin";
    let report = object(home.path(), &format!("cosim --random 20 {small} --json"));
    let counts = ["vectors", "guard_vectors", "mismatches", "host_decided"].map(|name| report[name].as_u64());
    assert_eq!(counts, [20, 24, 0, 0].map(Some));
    let sum: u64 = report["verdicts"].as_object().unwrap().values().filter_map(Value::as_u64).sum();
    assert_eq!(sum, 20, "the pairs that were asked for");
    let said = succeeds(home.path(), &format!("cosim --random 20 {small}"));
    assert!(said.contains("All 20 vectors, and 24 for the guard, agree bit for bit.\n"), "{said}");
}

#[test]
fn help_and_version_go_to_standard_output() {
    let home = tempfile::tempdir().unwrap();
    // In a clone the commit follows.
    let version = format!("efsat {}", env!("CARGO_PKG_VERSION"));
    let said = succeeds(home.path(), "--version");
    let commit = said.trim_end().strip_prefix(&version).unwrap();
    assert!(commit.is_empty() || (commit.starts_with(" (") && commit.ends_with(')')), "{said}");
    for arguments in ["--help", "generate --help", "cosim -h", "classify --help", "help", "help scene plan"] {
        assert!(succeeds(home.path(), arguments).contains("Usage: efsat"), "{arguments}");
    }
}

#[test]
fn shells_and_man_know_every_command() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    let help = succeeds(dir, "--help");
    let listed = help.lines().skip_while(|line| *line != "Commands:").skip(1).take_while(|line| !line.is_empty());
    let commands: Vec<&str> = listed.filter_map(|line| line.split_whitespace().next()).collect();
    assert!(commands.len() > 10 && commands.contains(&"generate"), "{commands:?}");
    for shell in ["bash", "zsh", "fish"] {
        let script = succeeds(dir, &format!("completions {shell}"));
        let absent: Vec<_> = commands.iter().filter(|command| !script.contains(**command)).collect();
        assert!(absent.is_empty() && script.contains("clocks-per-pair"), "{shell}: {absent:?}");
    }
    succeeds(dir, "manual new/man1");
    for command in commands.iter().filter(|command| **command != "help") {
        let page = fs::read_to_string(dir.join(format!("new/man1/efsat-{command}.1"))).unwrap().replace("\\-", "-");
        assert!(page.contains(".SH SYNOPSIS") && page.contains(&format!("efsat {command}")), "{page}");
    }
    assert!(fs::read_to_string(dir.join("new/man1/efsat.1")).unwrap().contains("generate"));
    fails(dir, "completions tcsh", 2, "expected one of bash, elvish, fish");
    fs::write(dir.join("file"), "").unwrap();
    fails(dir, "manual file", 2, "file: ");
}

#[test]
fn a_retest_leaves_nothing_open() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    fs::write(dir.join("pairs.csv"), csv()).unwrap();
    let rows = "pair,verdict\n0,intersect\n1,separate\n2,intersect\n";
    assert_eq!(succeeds(dir, "classify pairs.csv --retest"), rows, "touching pairs have a common point");
    let report = object(dir, "classify pairs.csv --retest --exact --json");
    assert_eq!(report["verdicts"], serde_json::json!({"separate": 1, "intersect": 2, "possibly_incorrect": 0}));
    assert_eq!((&report["retested"], &report["wrong"]), (&1.into(), &0.into()));
    assert!(succeeds(dir, "classify pairs.csv --retest --summary").contains("\n1 of them tested again in software\n"));
    let report = object(dir, "classify --random 2000 --retest --exact --json");
    assert_eq!((&report["verdicts"]["possibly_incorrect"], &report["wrong"]), (&0.into(), &0.into()));
}

#[test]
fn generate_says_what_it_wrote_and_what_does_not_fit() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    let said = object(dir, "generate --json --out a");
    let number = |field: &str| said[field].as_u64().unwrap();
    assert_eq!((&said["out"], &said["device"]), (&"a".into(), &"xc2v6000-4".into()));
    assert_eq!(["multipliers", "initiation_interval"].map(number), [48, 11]);
    assert_eq!(number("files"), tree(&dir.join("a")).len() as u64);
    assert!(said["expected_mhz"].as_f64().unwrap() >= 100.0);
    let wide = "--width 32 --axes-per-clock 11";
    let (status, _, errors) = efsat(dir, &format!("generate --out b {wide}"));
    assert_eq!(status, Some(0), "{errors}");
    assert!(errors.starts_with("warning: xc2v6000-4 has 144 multipliers; the design is predicted to take"), "{errors}");
    succeeds(dir, "generate --out c --device xc7a200t-1 --method determinants");
    // At 300 MHz another sum stays undivided, which 181 divides.
    let ecp5 = "generate --out d --device lfe5u-85-6 --method determinants --frequency";
    let part = "multiply_18_18.p takes 5.5 ns between registers and cannot be divided: expected at most 181";
    fails(dir, &format!("{ecp5} 300"), 2, part);
    succeeds(dir, &format!("{ecp5} 181"));
    let (status, _, errors) = efsat(dir, "synth --predict --method exact --width 32 --device lifcl-40-9");
    assert_eq!(status, Some(0), "{errors}");
    assert!(
        errors.starts_with("warning: lifcl-40-9 has 56 multipliers; the design is predicted to take 384"),
        "{errors}"
    );
}

#[test]
fn the_ready_designs_are_current() {
    let repository = Path::new(env!("CARGO_MANIFEST_DIR"));
    let (status, told, errors) = efsat(repository, "generate --ready --check");
    assert_eq!(status, Some(0), "run `efsat generate --ready` in the repository: {errors}");
    // What the demo prints of them is on the page of the first hour.
    let page = fs::read_to_string(repository.join("docs/start.md")).unwrap();
    let files = told.split(',').next().unwrap();
    let manifest: Value =
        serde_json::from_slice(&fs::read(repository.join("rtl-out/axes/manifest.json")).unwrap()).unwrap();
    for part in [format!("{files}, "), format!(", verdict after {} clocks; ", manifest["latency"])] {
        assert!(page.contains(&part), "docs/start.md: expected '{part}'");
    }
}

#[test]
fn rows_say_which_pairs_the_host_decided() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    // A pair on the grid of the exact unit, and one that does not fit 18 bits.
    let pairs = "0,0,0,4,0,0,0,4,0,1,1,-1,1,1,1,2,1,1\n0,0,0,1,0,0,0,1,0,0.1,0.1,-1,0.3,0.1,1,0.2,0.1,1\n";
    fs::write(dir.join("pairs.csv"), pairs).unwrap();
    let (_, rows, said) = efsat(dir, "classify --method exact pairs.csv");
    assert_eq!(rows, "pair,verdict\n0,intersect\n1,intersect\n");
    let note = "note: 1 of 2 pairs do not fit the exact unit: decided on the host, exactly; --decided-by shows which\n";
    assert_eq!(said, note);
    assert_eq!(
        efsat(dir, "classify --method exact --exact --decided-by pairs.csv").1,
        "pair,verdict,exact,decided_by\n0,intersect,intersect,unit\n1,intersect,intersect,host\n"
    );
    fs::write(dir.join("three.csv"), csv()).unwrap();
    assert_eq!(
        succeeds(dir, "classify --retest --decided-by three.csv"),
        "pair,verdict,decided_by\n0,intersect,unit\n1,separate,unit\n2,intersect,retest\n"
    );
    fails(dir, "classify --decided-by --summary pairs.csv", 2, "cannot be used with");
}

#[test]
fn a_check_is_about_generated_files() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    succeeds(dir, "generate --out rtl");
    fs::write(dir.join("rtl/notes.txt"), "mine").unwrap();
    assert!(succeeds(dir, "generate --out rtl --check").contains("all as generated"));
    fs::write(dir.join("rtl/efsat.vhd"), "").unwrap();
    fails(dir, "generate --out rtl --check", 1, "rtl is not as generated: differs efsat.vhd");
}
