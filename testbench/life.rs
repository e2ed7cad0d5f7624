//! The page on the life of a design is made of excerpts: of the builder, of what `efsat generate --dump` writes of the default
//! design, and of its VHDL.

use crate::tools::program::{fails, succeeds};
use efsat_unit::artefact::dump_files;
use efsat_unit::design::{Design, Probes};
use efsat_unit::params::Params;
use std::fs;
use std::path::Path;

const PAGE: &str = "docs/life-of-a-design.md";

/// The blocks of a page that name a file behind their language, each with its lines.
fn excerpts(page: &str) -> Vec<(&str, Vec<&str>)> {
    let mut found = vec![];
    let mut lines = page.lines();
    while let Some(line) = lines.next() {
        let Some(info) = line.strip_prefix("```") else { continue };
        let block = lines.by_ref().take_while(|line| *line != "```").collect();
        found.extend(info.split_once(' ').map(|(_, file)| (file, block)));
    }
    found
}

/// The first line of an excerpt that is not where it should be: lines follow each other as in the text but for `...`, which
/// stands for some lines or, behind others, for the rest of a line.
fn misplaced<'e>(excerpt: &[&'e str], text: &str) -> Option<&'e str> {
    let text: Vec<&str> = text.lines().collect();
    let alike = |line: &str, of_text: &str| match line.strip_suffix(" ...") {
        Some(begin) => of_text.starts_with(begin),
        None => of_text == line,
    };
    let mut at = 0;
    for run in excerpt.split(|line| line.trim() == "...").filter(|run| !run.is_empty()) {
        let there =
            |from: &usize| run.iter().enumerate().all(|(k, line)| text.get(from + k).is_some_and(|t| alike(line, t)));
        let Some(from) = (at..text.len()).find(there) else {
            let known = |line: &&&str| !text.iter().any(|of_text| alike(line, of_text));
            return Some(run.iter().find(known).unwrap_or(&run[0]));
        };
        at = from + run.len();
    }
    None
}

#[test]
fn the_excerpts_are_of_the_default_design() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let page = fs::read_to_string(root.join(PAGE)).unwrap();
    let design = Design::new(&Params::default(), Probes::None).unwrap();
    let dumps = dump_files(&design, "");
    let excerpts = excerpts(&page);
    let mut wrong = vec![];
    for (file, lines) in &excerpts {
        let text = dumps.get(file).map(str::to_owned).unwrap_or_else(|| fs::read_to_string(root.join(file)).unwrap());
        wrong.extend(misplaced(lines, &text).map(|line| format!("{PAGE}: not in {file}, or not there: {line}")));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    let ends: Vec<&str> = excerpts.iter().map(|(file, _)| file.split_once('.').map_or(*file, |(_, end)| end)).collect();
    for end in ["rs", "graph.txt", "schedule.txt", "module.txt", "vhd"] {
        assert!(ends.contains(&end), "{PAGE}: no excerpt of a file that ends in .{end}");
    }
}

/// Every entity of the design, whole or not at all.
#[test]
fn the_command_dumps_every_entity_and_replaces_nothing() {
    let home = tempfile::tempdir().unwrap();
    let dumps = home.path().join("dumps");
    let line = "generate --dump dumps";
    // Also over what it wrote before.
    (0..2).for_each(|_| _ = succeeds(&home, line));
    let design = Design::new(&Params::default(), Probes::None).unwrap();
    for module in design.top.hierarchy() {
        assert!(dumps.join(format!("{}.module.txt", module.name)).exists(), "{}", module.name);
    }
    for (schedule, _) in design.schedules() {
        for kind in ["graph", "schedule"] {
            assert!(dumps.join(format!("{}.{kind}.txt", schedule.block.name)).exists(), "{}", schedule.block.name);
        }
    }
    fs::remove_file(dumps.join("manifest.json")).unwrap();
    fails(&home, line, 2, "no manifest.json of efsat");
}

#[test]
fn an_excerpt_that_is_none_is_found() {
    let page = "```sh\nx\n```\n```text a.txt\nb\n...\nd 1 ...\n```\n";
    assert_eq!(excerpts(page), [("a.txt", vec!["b", "...", "d 1 ..."])]);
    let text = "a\nb\nc\nd 1 2\n";
    assert_eq!(misplaced(&["b", "...", "d 1 ..."], text), None);
    assert_eq!(misplaced(&["b", "d 1 ..."], text), Some("b"));
    assert_eq!(misplaced(&["b", "...", "x"], text), Some("x"));
    assert_eq!(misplaced(&["d 1 2", "...", "b"], text), Some("b"));
}
