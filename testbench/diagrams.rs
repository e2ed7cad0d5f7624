//! Dataflow pictures: those of the documents are current, and the command line draws every unit or says why not.

use crate::extent::share;
use crate::tools::has;
use crate::tools::program::{efsat, succeeds};
use efsat::design::{Design, Probes};
use efsat::diagram::{Picture, blocks};
use efsat::params::{Axes, Params, Projections};
use efsat::schedule::Scheduler;
use std::fs;
use std::path::Path;
use std::process::Command;

/// The pictures of docs/diagrams.md; scripts/diagrams draws them.
const SHOWN: [&str; 3] = ["comparator_network", "interval_multiply", "projection"];

fn pictures(params: &Params) -> Vec<Picture> {
    let design = Design::new(params, Probes::None).unwrap();
    let mut scheduler = Scheduler::new(design.device, params.frequency);
    blocks(&design.pipeline).iter().map(|unit| Picture::new(&scheduler.schedule(unit), scheduler.period())).collect()
}

#[test]
fn the_pictures_in_the_documents_are_current() {
    let pictures = pictures(&Params::default());
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/diagrams");
    let mut stale = vec![];
    for name in SHOWN {
        let picture = pictures.iter().find(|picture| picture.name == name).unwrap();
        if fs::read_to_string(docs.join(format!("{name}.svg"))).unwrap_or_default() != picture.svg() {
            stale.push(name);
        }
    }
    assert!(stale.is_empty(), "{stale:?}: run scripts/diagrams");
    assert_eq!(fs::read_dir(docs).unwrap().count(), SHOWN.len(), "a picture that nothing draws");
}

/// Every unit of designs with all there is: repeated axes, lagged phases, many units side by side.
#[test]
fn every_unit_has_a_picture() {
    let default = Params::default;
    let folded = Params { axes: Axes::Seventeen, axes_per_clock: 2, projections: Projections::Skip, ..default() };
    let fast = Params { axes_per_clock: 11, projections: Projections::Intersect, frequency: 250, ..default() };
    let mut wrong = vec![];
    for picture in share(2, [default(), fast, folded]).iter().flat_map(pictures) {
        let (svg, dot) = (picture.svg(), picture.dot());
        let drawn = picture.edges.iter().filter(|edge| !edge.late).count();
        let whole = svg.matches("marker-end").count() == drawn && dot.matches(" -> ").count() == picture.edges.len();
        let numbers = !svg.contains("NaN") && !svg.contains("inf\"");
        let outputs = picture.places.iter().any(|place| place.operation == "output");
        if !(whole && numbers && outputs && picture.places.iter().any(|place| place.critical)) {
            wrong.push(picture.name.clone());
        }
    }
    assert!(wrong.is_empty(), "{wrong:?}");
}

#[test]
fn generate_writes_the_picture_and_nothing_else() {
    let home = tempfile::tempdir().unwrap();
    let said = succeeds(&home, "generate --unit projection --svg p.svg --dot p.dot");
    assert!(said.starts_with("p.dot: projection, ") && said.lines().count() == 2, "{said}");
    assert_eq!(fs::read_dir(home.path()).unwrap().count(), 2);
    assert!(fs::read_to_string(home.path().join("p.dot")).unwrap().starts_with("digraph \"projection\" {\n"));
}

#[test]
fn wrong_command_lines_are_told_in_one_line() {
    let lines = [
        ("generate --unit nothing --svg x.svg", "--unit nothing: expected one of guard_translation, "),
        ("generate --unit projection", "--unit projection alone: expected --dot FILE or --svg FILE with it"),
        ("generate --svg x.svg", "--unit"),
        ("generate --svg x.svg --out rtl", "--out"),
        ("generate --dot x.dot --lp lp", "--lp"),
        ("generate --dot x.dot --stream-width 64", "--stream-width"),
        ("generate --svg x.svg --check", "--check"),
        ("generate --unit projection --svg new/", "new/: "),
        ("generate --unit projection --svg d", "d: "),
        ("generate --unit projection --svg /nowhere/x.svg", "/nowhere/x.svg: "),
        ("generate --unit projection --svg .", ".: "),
        ("generate --unit projection --dot ../nowhere/x", "../nowhere/x: "),
        ("generate --unit projection --dot d/../x --svg x", "x: found twice; expected two different files"),
        ("generate --unit projection --dot x.dot --svg /nowhere/x.svg", "/nowhere/x.svg: "),
        ("generate --check --unit projection --dot x.dot", "--check"),
        ("generate --unit projection --dot x.dot --out rtl", "--out"),
        ("generate --unit projection --dot x.dot --lp lp", "--lp"),
        ("generate --unit projection --dot x.dot --stream-width 32", "--stream-width"),
        ("generate --lp lp --stream-width 32", "--stream-width"),
        ("generate --lp lp --dump dump", "--dump"),
        ("generate --dump dump --out rtl", "--out"),
        ("generate --dump dump --ready", "--ready"),
        ("generate --dump dump --name x", "--name"),
        ("generate --dump dump --json", "--json"),
        ("generate --dump dump --unit projection --dot x.dot", "--dump"),
        ("generate --dump", "--dump"),
        ("generate --dump .", ".: found the current directory"),
    ];
    let mut wrong = vec![];
    let home = tempfile::tempdir().unwrap();
    fs::create_dir(home.path().join("d")).unwrap();
    for (line, words) in lines {
        let (status, _, said) = efsat(&home, line);
        if status != Some(2) || said.lines().count() != 1 || !said.contains(words) {
            wrong.push(format!("{line}: {said}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert_eq!(fs::read_dir(&home).unwrap().count(), 1, "nothing is written");
}

/// Graphviz reads what is written for it.
#[test]
fn graphviz_takes_every_dot_file() {
    if !has("Graphviz", "dot", "-V") {
        return;
    }
    let home = tempfile::tempdir().unwrap();
    let mut wrong = vec![];
    for picture in pictures(&Params::default()).iter().filter(|picture| picture.places.len() < 100) {
        let file = home.path().join("unit.dot");
        fs::write(&file, picture.dot()).unwrap();
        let output = Command::new("dot").args(["-Tplain"]).arg(&file).output().unwrap();
        let nodes = String::from_utf8_lossy(&output.stdout).lines().filter(|line| line.starts_with("node ")).count();
        if !output.status.success() || nodes != picture.places.len() || !output.stderr.is_empty() {
            wrong.push(format!("{}: {}", picture.name, String::from_utf8_lossy(&output.stderr)));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
