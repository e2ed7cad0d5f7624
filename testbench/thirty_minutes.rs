//! The pages that lead from nothing to an answer, typed as they stand: in an empty folder with the small meshes of `examples/`, every
//! file that such a page shows is written, every `sh` block is run, and what the page prints behind it comes.

use crate::book::{pages, text};
use crate::extent::full;
use crate::tools::{ghdl, skip};
use std::fs;
use std::path::Path;
use std::process::Command;

/// A step of a page.
#[derive(Debug, PartialEq)]
enum Step {
    /// A file with its name, which stands first in the paragraph before it.
    File(String, String),
    /// Commands, and lines that are among what they print.
    Run(String, Vec<String>),
    /// Words that stand in a file that was made, with what they mean behind them.
    Words(Vec<String>),
}

fn is_word(word: &str) -> bool {
    word.len() == 16 && word.chars().all(|c| c.is_ascii_hexdigit())
}

fn steps(page: &str) -> Vec<Step> {
    let mut found = vec![];
    let (mut paragraph, mut blank) = (String::new(), false);
    let mut lines = page.lines();
    while let Some(line) = lines.next() {
        let Some(language) = line.strip_prefix("```") else {
            if std::mem::replace(&mut blank, line.is_empty()) {
                paragraph.clear();
            }
            paragraph += line;
            continue;
        };
        let block: Vec<&str> = lines.by_ref().take_while(|line| *line != "```").collect();
        let owned = || block.iter().map(|line| (*line).to_owned()).collect::<Vec<_>>();
        match (language, found.last_mut()) {
            ("sh", _) => found.push(Step::Run(block.join("\n"), vec![])),
            ("text", Some(Step::Run(_, printed))) if paragraph.is_empty() => *printed = owned(),
            ("text", _) => {
                let words = block.iter().filter_map(|line| line.split(' ').next()).filter(|word| is_word(word));
                found.push(Step::Words(words.map(str::to_owned).collect()));
            }
            _ => {
                let name = paragraph.split('`').nth(1).unwrap_or_else(|| panic!("{language}: no name before it"));
                found.push(Step::File(name.to_owned(), block.join("\n") + "\n"));
            }
        }
        paragraph.clear();
        blank = false;
    }
    found
}

/// What is printed by commands; they must all end well.
fn run(commands: &str, dir: &Path, ghdl: &str) -> String {
    let program = Path::new(env!("CARGO_BIN_EXE_efsat")).parent().unwrap();
    let path = format!("{}:{}", program.display(), std::env::var("PATH").unwrap());
    let script = format!("set -e -o pipefail\nghdl() {{ command {ghdl} \"$@\"; }}\nexec 2>&1\n{commands}");
    let output = Command::new("bash").args(["-c", &script]).current_dir(dir).env("PATH", path).output().unwrap();
    let printed = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{commands}\n{printed}");
    printed
}

fn follow(page: &str, ghdl: &str) {
    let dir = tempfile::tempdir().unwrap();
    for mesh in ["tetrahedron.obj", "octahedron.obj"] {
        fs::copy(Path::new(env!("CARGO_MANIFEST_DIR")).join("examples").join(mesh), dir.path().join(mesh)).unwrap();
    }
    let mut ran = 0;
    for step in steps(page) {
        match step {
            Step::File(name, text) => fs::write(dir.path().join(name), text).unwrap(),
            // Its compiler takes most of a minute.
            Step::Run(commands, _) if commands.starts_with("verilator") && !full() => {}
            Step::Run(commands, expected) => {
                let printed = run(&commands, dir.path(), ghdl);
                for line in expected {
                    assert!(printed.lines().any(|found| found == line), "{commands}\n{printed}\nexpected {line}");
                }
                ran += 1;
            }
            Step::Words(words) => {
                let made =
                    fs::read_dir(dir.path()).unwrap().map(|entry| entry.unwrap().path()).filter(|path| path.is_file());
                let made: Vec<Vec<u8>> = made.map(|path| fs::read(path).unwrap()).collect();
                for word in words {
                    let bytes = u64::from_str_radix(&word, 16).unwrap().to_le_bytes();
                    let has = |file: &Vec<u8>| {
                        file.windows(8).any(|found| found == bytes)
                            || file.windows(16).any(|found| found == word.as_bytes())
                    };
                    assert!(made.iter().any(has), "{word}: in no file");
                }
            }
        }
    }
    assert!(ran > 1, "{ran} blocks of commands");
}

#[test]
fn what_pages_of_thirty_minutes_show_comes() {
    let Some(ghdl) = ghdl() else { return };
    let tools: &[&str] = if full() { &["python3", "verilator"] } else { &["python3"] };
    if let Some(tool) = tools.iter().find(|tool| Command::new(tool).arg("--version").output().is_err()) {
        return skip(format!("{tool} is not installed"));
    }
    let pages: Vec<String> = pages().into_iter().filter(|page| page.ends_with("-in-thirty-minutes.md")).collect();
    assert!(!pages.is_empty());
    pages.iter().for_each(|page| follow(&text(page), &ghdl.path.to_string_lossy()));
}

#[test]
fn steps_are_told_apart() {
    let page = "# A\n\n`a.py` is\nit:\n\n```python\nx\ny\n```\n\n```sh\nb\n```\n\n```text\nc\n```\n\nd\n\n```text\n\
                0123456789abcdef e\nf\n```\n";
    let expected = [
        Step::File("a.py".to_owned(), "x\ny\n".to_owned()),
        Step::Run("b".to_owned(), vec!["c".to_owned()]),
        Step::Words(vec!["0123456789abcdef".to_owned()]),
    ];
    assert_eq!(steps(page), expected);
}
