//! What a researcher takes out: every candidate of a scene with its numbers, why pairs are undecided and by how little, and a test of
//! one's own beside the others.

use crate::tools::program::{object, refuses, succeeds};
use efsat::Points;
use efsat::software::retest::retest;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

const SCENE: &str = "name = \"s\"\n[a]\nmesh = \"builtin:headlight\"\n[b]\nmesh = \"builtin:headlight\"\n\
                     [tumble]\nsteps = 4\ndistances = [1.6, 1.45]\n";

/// The rows of a table, each by the names of its columns. Fields may be in quotation marks.
fn rows(table: &str) -> Vec<BTreeMap<String, String>> {
    let fields = |line: &str| -> Vec<String> {
        let mut fields = vec![String::new()];
        for (i, part) in line.split('"').enumerate() {
            let mut parts = part.split(',').map(str::to_owned);
            match i % 2 {
                0 => {
                    fields.last_mut().unwrap().push_str(&parts.next().unwrap());
                    fields.extend(parts);
                }
                _ => fields.last_mut().unwrap().push_str(part),
            }
        }
        fields
    };
    let mut lines = table.lines().map(fields);
    let names = lines.next().unwrap();
    lines.map(|fields| names.iter().cloned().zip(fields).collect()).collect()
}

fn is_open(row: &BTreeMap<String, String>) -> bool {
    row["verdict"] == "possibly-incorrect"
}

/// Open pairs alone have a reason, and their gap is within its error.
fn has_its_reason(row: &BTreeMap<String, String>) -> bool {
    let number = |name: &str| row[name].parse::<f64>();
    match (number("gap"), number("error")) {
        (Ok(gap), Ok(error)) => is_open(row) && gap.abs() <= error && row["reason"].contains(": "),
        _ => !is_open(row) && row["reason"].is_empty(),
    }
}

#[test]
fn candidates_are_written_with_their_numbers() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    fs::write(dir.join("s.toml"), SCENE).unwrap();
    let total = &object(dir, "scene pairs s.toml --out c.f64 --index i.csv --json")["total"];
    let tested = total["pairs_tested"].as_u64().unwrap();
    let index = rows(&fs::read_to_string(dir.join("i.csv")).unwrap());
    assert_eq!((index.len() as u64, fs::metadata(dir.join("c.f64")).unwrap().len()), (tested, 144 * tested));
    assert!(index.iter().all(|row| row["a"] == "a" && row["b"] == "b" && row["triangle_a"].parse::<u32>().is_ok()));
    succeeds(dir, "scene pairs s.toml --out c.csv --summary");
    let exact = object(dir, "classify c.f64 --exact --json");
    assert_eq!(exact, object(dir, "classify c.csv --exact --json"));
    // The corners of B are rounded, which tells no pair of this scene otherwise.
    let count = |name: &str| exact["exact"][name].as_u64().unwrap();
    assert_eq!(count("touch") + count("intersect"), total["touching"].as_u64().unwrap());
    refuses(dir, "scene pairs s.toml --out c.f64 --first-hit", "cannot be used with");
    refuses(dir, "scene pairs s.toml --out c.csv --index ./c.csv", "found twice; expected two different files");
    refuses(dir, "scene pairs s.toml --out c.txt", "expected a name that ends in .csv or .f64");
}

#[test]
fn rows_say_where_a_pair_is_and_why_it_is_undecided() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    fs::write(dir.join("s.toml"), SCENE).unwrap();
    for options in ["--like-paper", "--width 12 --method determinants"] {
        let all = rows(&succeeds(dir, &format!("classify s.toml --places --reasons --exact {options}")));
        assert!(all.iter().filter(|row| is_open(row)).count() > 3, "{options}");
        for row in &all {
            let number = |side: char, corner: u32, axis: char| row[&format!("{side}{corner}_{axis}")].parse().unwrap();
            let corner = |i: u32| ['x', 'y', 'z'].map(|axis| number(if i < 3 { 'a' } else { 'b' }, i % 3, axis));
            let points: Points = [0, 1, 2, 3, 4, 5].map(corner);
            assert_eq!(retest(&points).unwrap().to_string(), row["exact"], "{row:?}");
            assert!(has_its_reason(row), "{row:?}");
        }
    }
    refuses(dir, "classify s.toml --places --json", "cannot be used with");
    fs::write(dir.join("p.csv"), include_str!("../examples/three_pairs.csv")).unwrap();
    refuses(dir, "classify p.csv --places", "--places: found pairs without places; expected a scene");
}

#[test]
fn a_run_lists_what_touches_and_what_is_undecided() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    fs::write(dir.join("s.toml"), SCENE).unwrap();
    let total = &object(dir, "scene run s.toml --cosim none --width 8 --pairs p.csv --json")["total"];
    let listed = rows(&fs::read_to_string(dir.join("p.csv")).unwrap());
    let (open, touching) =
        (listed.iter().filter(|row| is_open(row)), listed.iter().filter(|row| row["exact"] != "separate"));
    let counts = [open.count() as u64, touching.count() as u64];
    assert_eq!(counts, ["possibly_incorrect", "touching"].map(|name| total[name].as_u64().unwrap()));
    assert!(listed.iter().any(|row| is_open(row) && row["exact"] == "separate") && listed.iter().all(has_its_reason));
}

/// What another program says of the pairs is one more test.
#[test]
fn answers_of_another_program_are_compared() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    fs::write(dir.join("s.toml"), SCENE).unwrap();
    let right = succeeds(dir, "classify s.toml --retest");
    let errors = |answers: &str| -> [u64; 2] {
        fs::write(dir.join("answers.csv"), answers).unwrap();
        let report = object(dir, "compare s.toml --answers answers.csv --json");
        let last = report["software"].as_array().unwrap().last().unwrap().clone();
        assert_eq!(last["test"], "answers.csv");
        ["missed", "false"].map(|name| last[name].as_u64().unwrap())
    };
    assert_eq!(errors(&right), [0, 0]);
    assert_eq!(errors(&right.replacen(",intersect", ",0", 1).replacen(",separate", ",possibly-incorrect", 2)), [1, 2]);
    assert!(succeeds(dir, "compare s.toml --answers answers.csv").contains("\nanswers.csv  "));
    let wrong = |path: &str, answers: &str, part: &str| {
        fs::write(dir.join(path), answers).unwrap();
        refuses(dir, &format!("compare s.toml --answers {path}"), part);
    };
    wrong("few.csv", "separate\n", "few.csv: found 1 answers; expected ");
    wrong(
        "odd.csv",
        "pair,verdict\n0,separate\n1,maybe\n",
        "odd.csv: line 3: found '1,maybe'; expected separate, touch",
    );
    refuses(Path::new(dir), "compare s.toml --answers none.csv", "none.csv: cannot be read");
}
