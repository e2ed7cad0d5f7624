//! The house (rooms on floors) as a test: who imports whom, who prints, and what must not be left lying about.

use std::fs;
use std::path::{Path, PathBuf};

/// The rooms by floor; a room imports from floors below its own only.
const FLOORS: [&[&str]; 7] = [
    &["number", "params", "device"],
    &["graph", "golden", "exact", "mesh"],
    &["design", "vhdl", "software", "diagram", "verilog"],
    &["scene", "artefact", "stress", "wall", "driver"],
    &["cosim", "synth"],
    &["mutation", "effects", "report"],
    &["cli"],
];

/// Room and room of the same floor that it may import: parameters are made of formats.
const NEIGHBOURS: [(&str, &str); 1] = [("params", "number")];

/// Room and room below that it must not know all the same.
const STRANGERS: [(&str, &str); 18] = [
    ("vhdl", "design"),
    ("vhdl", "golden"),
    ("vhdl", "params"),
    ("golden", "graph"),
    ("golden", "device"),
    ("design", "golden"),
    ("graph", "params"),
    ("exact", "number"),
    ("exact", "params"),
    ("mesh", "number"),
    ("mesh", "params"),
    ("mesh", "device"),
    ("scene", "vhdl"),
    ("software", "number"),
    ("software", "params"),
    ("software", "golden"),
    ("stress", "design"),
    ("wall", "design"),
];

/// Only these print: the command line, and the binary that calls it.
const PRINTERS: [&str; 2] = ["cli", "main"];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// All files of a folder and the folders in it, sorted; none if there is no such folder.
fn files(folder: &str) -> Vec<PathBuf> {
    let mut open = vec![root().join(folder)];
    let mut found = vec![];
    while let Some(folder) = open.pop() {
        for entry in fs::read_dir(&folder).into_iter().flatten() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                open.push(path);
            } else {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

fn relative(path: &Path) -> String {
    path.strip_prefix(root()).unwrap().to_string_lossy().replace('\\', "/")
}

/// Rust sources of the library and the binary that are no tests: path below the repository and text.
fn sources() -> Vec<(String, String)> {
    let all = files("gen").into_iter().map(|path| (relative(&path), path));
    let sources = all.filter(|(name, _)| name.ends_with(".rs") && !name.ends_with("/tests.rs"));
    sources.map(|(name, path)| (name, fs::read_to_string(path).unwrap())).collect()
}

/// The room a source lives in: `gen/graph/op.rs` and `gen/number.rs` are in `graph` and `number`.
fn room(path: &str) -> &str {
    let path = path.strip_prefix("gen/").unwrap();
    path.split_once('/').map_or_else(|| path.trim_end_matches(".rs"), |(room, _)| room)
}

/// The code of a source: without line comments and without modules of tests.
fn code(text: &str) -> String {
    let mut lines = vec![];
    let mut rest = text.lines().peekable();
    while let Some(line) = rest.next() {
        if line == "#[cfg(test)]" && rest.peek().is_some_and(|next| next.ends_with('{') && next.starts_with("mod ")) {
            // A module ends at the next brace that is not indented.
            rest.by_ref().find(|line| *line == "}");
            continue;
        }
        if !line.trim_start().starts_with("//") {
            lines.push(line);
        }
    }
    lines.join("\n")
}

/// The rooms that code names by `crate::`, in use declarations and in paths.
fn imports(code: &str) -> Vec<String> {
    let ident = |text: &str| text.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>();
    let mut rooms = vec![];
    for (at, found) in code.match_indices("crate::") {
        let rest = &code[at + found.len()..];
        let Some(group) = rest.strip_prefix('{') else {
            rooms.push(ident(rest));
            continue;
        };
        // The first name of every entry of the group, whatever is nested in it.
        let mut depth = 0;
        let mut start = true;
        for (i, c) in group.char_indices() {
            match c {
                '{' => depth += 1,
                '}' if depth == 0 => break,
                '}' => depth -= 1,
                ',' if depth == 0 => start = true,
                _ if start && !c.is_whitespace() => {
                    rooms.push(ident(&group[i..]));
                    start = false;
                }
                _ => {}
            }
        }
    }
    rooms.sort();
    rooms.dedup();
    rooms
}

fn floor(room: &str) -> Option<usize> {
    FLOORS.iter().position(|rooms| rooms.contains(&room))
}

/// What is wrong about a source of a room, in words.
fn wrong_imports(room: &str, text: &str) -> Vec<String> {
    let Some(own) = floor(room) else { return vec![format!("room {room} is on no floor")] };
    let wrong = |other: &String| {
        let pair = (room, other.as_str());
        if room == other {
            None
        } else if STRANGERS.contains(&pair) {
            Some(format!("{room} must not know {other}"))
        } else {
            match floor(other) {
                None => Some(format!("{room} imports {other}, which is on no floor")),
                Some(floor) if floor < own || NEIGHBOURS.contains(&pair) => None,
                Some(floor) => Some(format!("{room} (floor {own}) imports {other} (floor {floor})")),
            }
        }
    };
    imports(&code(text)).iter().filter_map(wrong).collect()
}

/// Macros that print.
fn prints(text: &str) -> bool {
    let code = code(text);
    ["print!(", "println!(", "eprint!(", "eprintln!(", "dbg!("].iter().any(|name| code.contains(name))
}

/// Marks of unfinished work.
fn unfinished(text: &str) -> Option<&'static str> {
    ["TODO", "FIXME", "XXX", "unimplemented!", "todo!("].into_iter().find(|mark| text.contains(mark))
}

/// Template expressions that compute.
fn computing(template: &str) -> Vec<&str> {
    let expressions = template.split("{{").skip(1).filter_map(|rest| rest.split_once("}}")).map(|(inside, _)| inside);
    expressions.filter(|inside| inside.contains(['*', '/'])).collect()
}

#[test]
fn rooms_import_from_floors_below() {
    let mut wrong = vec![];
    let sources = sources();
    for (path, text) in &sources {
        if ["gen/lib.rs", "gen/main.rs"].contains(&path.as_str()) {
            continue;
        }
        wrong.extend(wrong_imports(room(path), text).into_iter().map(|w| format!("{path}: {w}")));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(sources.len() > 40, "{} sources", sources.len());
}

#[test]
fn every_room_of_the_library_is_on_a_floor() {
    let library = fs::read_to_string(root().join("gen/lib.rs")).unwrap();
    let rooms: Vec<&str> = library
        .lines()
        .filter_map(|line| line.strip_prefix("pub mod "))
        .map(|rest| rest.trim_end_matches(';'))
        .collect();
    assert!(rooms.len() >= 13 && rooms.iter().all(|room| floor(room).is_some()), "{rooms:?}");
}

#[test]
fn only_the_command_line_prints() {
    let printing = sources().into_iter().filter(|(path, text)| !PRINTERS.contains(&room(path)) && prints(text));
    assert_eq!(printing.map(|(path, _)| path).collect::<Vec<_>>(), Vec::<String>::new());
}

#[test]
fn nothing_is_left_unfinished() {
    let all = ["gen", "templates", "scripts"].into_iter().flat_map(files);
    let marked: Vec<String> = all
        .filter_map(|path| {
            let text = String::from_utf8_lossy(&fs::read(&path).unwrap()).into_owned();
            unfinished(&text).map(|mark| format!("{}: {mark}", relative(&path)))
        })
        .collect();
    assert!(marked.is_empty(), "{}", marked.join("\n"));
}

#[test]
fn templates_do_not_compute() {
    let templates = files("templates");
    assert!(templates.len() >= 3);
    for path in templates {
        let text = fs::read_to_string(&path).unwrap();
        assert!(computing(&text).is_empty(), "{}: {:?}", relative(&path), computing(&text));
    }
}

/// Each check sees what it is there for.
#[test]
fn the_checks_can_fail() {
    assert_eq!(wrong_imports("vhdl", "use crate::design::Design;"), ["vhdl must not know design"]);
    assert_eq!(wrong_imports("graph", "use crate::cli::main;"), ["graph (floor 1) imports cli (floor 6)"]);
    assert_eq!(wrong_imports("golden", "fn f(x: crate::graph::Op) {}"), ["golden must not know graph"]);
    assert_eq!(wrong_imports("exact", "use crate::mesh::Mesh;"), ["exact (floor 1) imports mesh (floor 1)"]);
    let group = "use crate::{\n    number::{floor_shift, Upper},\n    cosim,\n};";
    assert_eq!(imports(group), ["cosim", "number"]);
    assert_eq!(wrong_imports("design", group), ["design (floor 2) imports cosim (floor 4)"]);
    assert_eq!(wrong_imports("cellar", ""), ["room cellar is on no floor"]);
    // What is fine stays so: own room, comments, tests.
    assert!(wrong_imports("golden", "use crate::golden::Pair;\n//! [`Op`](crate::graph::Op)").is_empty());
    let tested = "#[cfg(test)]\nmod tests {\n    use crate::exact::pair;\n}\n";
    assert!(wrong_imports("golden", tested).is_empty());
    assert_eq!(wrong_imports("golden", &format!("{tested}use crate::exact::pair;")).len(), 1);
    assert!(wrong_imports("graph", "use crate::device::Device;").is_empty());
    assert!(prints("fn f() {\n    println!(\"x\");\n}") && !prints("// println!(\"x\");\nfn f() {}"));
    assert_eq!(unfinished(&["TO", "DO: later"].concat()), Some("TODO"));
    assert_eq!(computing("{{ a }} {{ bits - 1 }} {{ 2 * b }} a / b"), [" 2 * b "]);
}
