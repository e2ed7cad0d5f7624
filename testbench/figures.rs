//! The tables of the pages are those that their commands make (scripts/figures, docs/figures.toml).

use crate::tools::has;
use crate::tools::program::PROGRAM;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

fn repository() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Whether there is a Python that runs the script; where there is none, this is said.
fn python() -> bool {
    has("Python 3.11", "python3", "-cimport tomllib")
}

/// Runs the script of a repository.
fn figures(root: &Path, arguments: &[&str]) -> Output {
    let script = root.join("scripts/figures");
    Command::new("python3").arg(script).args(arguments).env("EFSAT", PROGRAM).output().unwrap()
}

#[track_caller]
fn expect(output: &Output, status: i32, parts: &[&str]) {
    let said = String::from_utf8_lossy(&[&output.stdout[..], &output.stderr[..]].concat()).into_owned();
    assert_eq!(output.status.code(), Some(status), "{said}");
    for part in parts {
        assert!(said.contains(part), "expected {part} in:\n{said}");
    }
}

#[test]
fn cheap_tables_are_as_their_commands_make_them() {
    if python() {
        expect(&figures(repository(), &["--check"]), 0, &["cheap tables made again, 0 differ"]);
    }
}

/// Timing diagrams are drawn from the sources beside them, and a page shows each; a source that was changed is noticed.
#[test]
fn timing_diagrams_are_those_of_their_sources() {
    if !python() {
        return;
    }
    let drawn = |root: &Path| Command::new("python3").arg(root.join("scripts/waves")).arg("--check").output().unwrap();
    expect(&drawn(repository()), 0, &[]);
    let pages: Vec<String> = fs::read_dir(repository().join("docs"))
        .unwrap()
        .filter_map(|entry| Some(entry.unwrap().path()).filter(|path| path.extension().is_some_and(|end| end == "md")))
        .map(|path| fs::read_to_string(path).unwrap())
        .collect();
    let home = tempfile::tempdir().unwrap();
    let copy = home.path();
    for folder in ["scripts", "docs/waves"] {
        fs::create_dir_all(copy.join(folder)).unwrap();
    }
    fs::copy(repository().join("scripts/waves"), copy.join("scripts/waves")).unwrap();
    let mut shown = 0;
    for file in fs::read_dir(repository().join("docs/waves")).unwrap().map(|entry| entry.unwrap().path()) {
        let name = file.file_name().unwrap().to_str().unwrap();
        fs::copy(&file, copy.join("docs/waves").join(name)).unwrap();
        if name.ends_with(".svg") {
            assert!(pages.iter().any(|page| page.contains(&format!("](waves/{name})"))), "{name}");
            shown += 1;
        }
    }
    assert_eq!(shown, 4);
    let source = copy.join("docs/waves/unit.json");
    fs::write(&source, fs::read_to_string(&source).unwrap().replacen("01.0", "011.", 1)).unwrap();
    expect(&drawn(copy), 1, &["not as their sources: unit.svg"]);
}

const PAGE: &str = "# Page\n\nBefore.\n\n<!-- figures: parts -->\n\n| device | multipliers |\n| --- | ---: |\n| `lfe5u-85-6` | 48 |\n\n\
    <!-- end of figures -->\n\nBehind.\n\n<!-- figures: pairs -->\n\nold\n\n<!-- end of figures -->\n";

const REGISTRY: &str = r#"
[depends]
scenes = ["scenes"]

[parts]
page = "docs/page.md"
cost = "cheap"
depends = "scenes"
command = "efsat synth --predict {options}"
rows = [["`lfe5u-85-6`", "--device lfe5u-85-6"]]
columns = [["<device", "label"], ["multipliers", "units.predicted.multipliers"]]

[pairs]
page = "docs/page.md"
cost = "dear"
depends = "scenes"
command = "efsat classify {column} {options}"
rows = ["", "--like-paper"]
head = "<options"
columns = [["random", "--random 20"]]
cell = "pairs"
"#;

/// A repository with two tables in one page, both as their commands make them, the dear one not yet of any commit.
fn small() -> tempfile::TempDir {
    let dir = tempfile::tempdir().unwrap();
    let root = dir.path();
    for folder in ["docs", "scripts", "scenes"] {
        fs::create_dir(root.join(folder)).unwrap();
    }
    for script in ["figures", "tables.py"] {
        fs::copy(repository().join("scripts").join(script), root.join("scripts").join(script)).unwrap();
    }
    for (file, text) in
        [("README.md", ""), ("CONTRIBUTING.md", ""), ("docs/page.md", PAGE), ("docs/figures.toml", REGISTRY)]
    {
        fs::write(root.join(file), text).unwrap();
    }
    fs::write(root.join("scenes/scene.toml"), "# A scene.\n").unwrap();
    dir
}

/// Changes one place of a file.
fn change(root: &Path, file: &str, from: &str, to: &str) {
    let text = fs::read_to_string(root.join(file)).unwrap();
    fs::write(root.join(file), crate::tools::replaced(&text, from, to)).unwrap();
}

#[test]
fn the_check_notices_what_differs() {
    if !python() {
        return;
    }
    let check = |changes: &[(&str, &str, &str)], status, parts: &[&str]| {
        let dir = small();
        changes.iter().for_each(|(file, from, to)| change(dir.path(), file, from, to));
        expect(&figures(dir.path(), &["--check"]), status, parts);
    };
    let (page, registry) = ("docs/page.md", "docs/figures.toml");
    check(&[], 0, &["pairs: age unknown: no commit stands beside it", "1 cheap tables made again, 0 differ"]);
    check(
        &[(page, "| 48 |", "| 49 |")],
        1,
        &[
            "docs/page.md: run scripts/figures parts",
            "found    | `lfe5u-85-6` | 49 |",
            "expected | `lfe5u-85-6` | 48 |",
        ],
    );
    check(&[(page, "| 48 |", "| 48 |\n| more | 1 |")], 1, &["found    | more | 1 |", "expected the end of the table"]);
    check(
        &[(page, "figures: parts", "figures: party")],
        1,
        &["expected one pair of marks of parts, found 0", "party: not in docs/figures.toml"],
    );
    check(&[(page, "Before.", "Before.\n\n<!-- end of figures -->")], 1, &["docs/page.md: 2 tables begin, 3 end"]);
    check(&[(registry, "[\"scenes\"]", "[\"scene\"]")], 1, &["parts: no such path: scene"]);
    check(&[(registry, "cost = \"dear\"", "cost = \"free\"")], 1, &["pairs: cost free: expected cheap or dear"]);
    check(&[(registry, "predicted.multipliers", "predicted.dividers")], 1, &["dividers"]);
    check(&[(registry, "--predict {", "--predikt {")], 1, &["efsat synth --predikt --device lfe5u-85-6"]);
}

#[test]
fn tables_are_written_with_their_commit() {
    if !python() || !has("git", "git", "--version") {
        return;
    }
    let dir = small();
    let root = dir.path();
    let git = |arguments: &[&str]| {
        let mut command = Command::new("git");
        command.args([
            "-c",
            "user.name=a",
            "-c",
            "user.email=a@b.example",
            "-c",
            "commit.gpgsign=false",
            "-c",
            "core.abbrev=7",
        ]);
        let output = command.args(arguments).current_dir(root).output().unwrap();
        assert!(output.status.success(), "{output:?}");
        String::from_utf8(output.stdout).unwrap().trim().to_owned()
    };
    expect(&figures(root, &["sweep"]), 2, &["error: sweep: expected --list, --check, --all-cheap or names of tables"]);
    expect(&figures(root, &[]), 2, &["error: nothing: expected"]);
    expect(&figures(root, &["--list"]), 0, &["parts", "cheap", "docs/page.md", "efsat synth --predict {options}"]);
    git(&["init", "--quiet"]);
    git(&["add", "scenes", "docs"]);
    git(&["commit", "--quiet", "--message", "first"]);
    let first = git(&["rev-parse", "HEAD"])[..7].to_owned();

    // What is not committed belongs to no commit.
    change(root, "scenes/scene.toml", "A scene", "Another");
    expect(&figures(root, &["pairs"]), 1, &["error: pairs: expected scenes as committed"]);
    git(&["checkout", "--quiet", "scenes"]);

    change(root, "docs/page.md", "| 48 |", "| 49 |");
    expect(&figures(root, &["pairs", "--all-cheap"]), 2, &["error: --all-cheap: expected"]);
    expect(&figures(root, &["--all-cheap"]), 0, &["parts: written into docs/page.md"]);
    expect(&figures(root, &["--all-cheap"]), 0, &["parts: as it was"]);
    expect(&figures(root, &["pairs"]), 0, &["pairs: written into docs/page.md"]);
    let made = "| options | random |\n| --- | ---: |\n| none | 20 |\n| `--like-paper` | 20 |";
    let expected = PAGE
        .replace("figures: parts", &format!("figures: parts, commit {first}"))
        .replace("figures: pairs", &format!("figures: pairs, commit {first}"))
        .replace("\n\nold\n\n", &format!("\n\n{made}\n\n"));
    assert_eq!(fs::read_to_string(root.join("docs/page.md")).unwrap(), expected);
    let output = figures(root, &["--check"]);
    expect(&output, 0, &["1 cheap tables made again, 0 differ"]);
    assert!(!String::from_utf8_lossy(&output.stdout).contains("pairs"), "{output:?}");

    change(root, "scenes/scene.toml", "A scene", "Another");
    git(&["commit", "--all", "--quiet", "--message", "second"]);
    let second = git(&["rev-parse", "HEAD"])[..7].to_owned();
    expect(&figures(root, &["--check"]), 0, &[&format!("pairs: of commit {first}, older than {second}")]);
    change(root, "docs/page.md", &format!("pairs, commit {first}"), "pairs, commit 0123456");
    expect(&figures(root, &["--check"]), 0, &["pairs: age unknown: no history here reaches back to commit 0123456"]);
    fs::remove_dir_all(root.join(".git")).unwrap();
    expect(&figures(root, &["--check"]), 0, &["pairs: age unknown", "1 cheap tables made again, 0 differ"]);
}
