//! The rules of the house that the compiler does not hold: what modules of one crate must not know of each other, what a
//! user of the generator compiles, who prints, and what must not be left lying about. The order of the crates is in their
//! `Cargo.toml`.

mod face;

use crate::tools::skip;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Folders, and modules of their own crate or of one below that they must not know: the reference model is written from
/// the contract alone, the design without the model, and what judges answers without the design.
const STRANGERS: [(&str, &[&str]); 8] = [
    ("gen/unit/pair/", &["words", "design", "golden", "artefact", "host"]),
    ("gen/unit/words/", &["golden", "artefact", "host"]),
    ("gen/unit/golden/", &["graph", "device", "vhdl", "design", "host"]),
    ("gen/unit/design/", &["golden", "host"]),
    ("gen/engine/model/", &["graph", "device", "vhdl", "design", "host"]),
    ("gen/engine/design/", &["golden", "model", "host"]),
    ("gen/checks/stress/", &["design", "graph"]),
    ("gen/studies/wall/", &["design", "graph"]),
];

/// Only these print: the command line, and the binary that calls it.
const PRINTERS: [&str; 2] = ["gen/cli/", "gen/main.rs"];

/// Packages that whoever generates VHDL does not compile: pictures, progress, terminals.
const NOT_FOR_GENERATORS: [&str; 5] = ["indicatif", "ctrlc", "png", "console", "anstream"];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// All files of a folder and the folders in it, sorted; none if there is no such folder.
fn files(folder: &str) -> Vec<PathBuf> {
    let mut open = vec![root().join(folder)];
    let mut found = vec![];
    while let Some(folder) = open.pop() {
        for entry in fs::read_dir(&folder).into_iter().flatten() {
            let entry = entry.unwrap();
            // What a link leads to, for the sake of `cargo package`, has a place of its own.
            match entry.file_type().unwrap() {
                kind if kind.is_dir() => open.push(entry.path()),
                kind if kind.is_symlink() => {}
                _ => found.push(entry.path()),
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
    let is_test = |name: &str| name.ends_with("/tests.rs") || name.contains("/tests/");
    let sources = all.filter(|(name, _)| name.ends_with(".rs") && !is_test(name));
    sources.map(|(name, path)| (name, fs::read_to_string(path).unwrap())).collect()
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

/// The modules that code names by `crate::` or by the crates below, in use declarations and in paths.
fn imports(code: &str) -> Vec<String> {
    let ident = |text: &str| text.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>();
    let mut modules = vec![];
    let crates = ["crate::", "efsat_hardware::", "efsat_geometry::", "efsat_unit::", "efsat_engine::"];
    let found = crates.iter().flat_map(|name| code.match_indices(name));
    for (at, name) in found {
        let rest = &code[at + name.len()..];
        let Some(group) = rest.strip_prefix('{') else {
            modules.push(ident(rest));
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
                    modules.push(ident(&group[i..]));
                    start = false;
                }
                _ => {}
            }
        }
    }
    modules.sort();
    modules.dedup();
    modules
}

/// The paths that code imports, each as its steps.
fn paths(code: &str) -> Vec<Vec<String>> {
    fn expand(before: &[String], tree: &str, paths: &mut Vec<Vec<String>>) {
        let (head, group) = tree.split_once('{').map_or((tree, None), |(head, group)| (head, Some(group)));
        let steps = head.split(" as ").next().unwrap_or(head).split("::").map(|step| step.trim().to_owned());
        let path: Vec<String> = before.iter().cloned().chain(steps.filter(|step| !step.is_empty())).collect();
        let Some(group) = group else { return paths.push(path) };
        let (mut depth, mut from) = (0, 0);
        for (i, c) in group.char_indices() {
            match c {
                '{' => depth += 1,
                ',' if depth == 0 => {
                    expand(&path, &group[from..i], paths);
                    from = i + 1;
                }
                '}' if depth == 0 => return expand(&path, &group[from..i], paths),
                '}' => depth -= 1,
                _ => {}
            }
        }
    }
    let mut paths = vec![];
    for (at, word) in code.match_indices("use ") {
        let begins = code[..at].chars().next_back().is_none_or(char::is_whitespace);
        if let (true, Some((tree, _))) = (begins, code[at + word.len()..].split_once(';')) {
            expand(&[], tree, &mut paths);
        }
    }
    paths
}

/// Pairs of modules side by side that need each other, by way of others or not. Given are the paths of all modules of a
/// crate with their code. What a module shares with those around it is no cycle: a folder's `mod.rs` is the folder.
fn cycles(modules: &BTreeMap<Vec<String>, String>) -> Vec<String> {
    let mut needs: BTreeMap<&[String], BTreeSet<&[String]>> = BTreeMap::new();
    for (module, code) in modules {
        for path in paths(code) {
            let ups = path.iter().take_while(|step| *step == "super").count();
            let around = match path.first().map(String::as_str) {
                Some("crate") => &[][..],
                Some("super") if ups <= module.len() => &module[..module.len() - ups],
                _ => continue,
            };
            let mut found = [around, &path[ups.max(1)..]].concat();
            while !found.is_empty() && !modules.contains_key(&found) {
                found.pop();
            }
            let Some((found, _)) = modules.get_key_value(&found) else { continue };
            if !module.starts_with(found) && !found.starts_with(module) {
                // The two that are side by side.
                let shared = module.iter().zip(found).take_while(|(x, y)| x == y).count();
                needs.entry(&module[..=shared]).or_default().insert(&found[..=shared]);
            }
        }
    }
    let reaches = |from: &[String], to: &[String]| {
        let mut open = vec![from];
        let mut seen = BTreeSet::new();
        while let Some(module) = open.pop() {
            let next: Vec<&[String]> = needs.get(module).into_iter().flatten().copied().collect();
            if next.contains(&to) {
                return true;
            }
            open.extend(next.into_iter().filter(|module| seen.insert(*module)));
        }
        false
    };
    let direct = needs.iter().flat_map(|(from, to)| to.iter().map(move |to| (*from, *to)));
    let both = direct.filter(|(from, to)| reaches(to, from));
    both.map(|(from, to)| format!("{} needs {}", from.join("::"), to.join("::"))).collect()
}

/// The modules that a source names and must not know.
fn strangers(path: &str, text: &str) -> Vec<String> {
    let mut modules = imports(&code(text));
    modules.retain(|module| {
        STRANGERS.iter().any(|(folder, names)| path.starts_with(folder) && names.contains(&module.as_str()))
    });
    modules
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

/// Expressions and conditions of a template that compute: with an operator, or a part of a text or a list. What stands in quotes
/// is text, and a sign at the edge of a tag takes the blanks beside it.
fn computing(template: &str) -> Vec<&str> {
    let tags = [("{{", "}}"), ("{%", "%}")];
    let inside = tags.iter().flat_map(|(open, close)| {
        template.split(open).skip(1).filter_map(move |rest| rest.split_once(close)).map(|(inside, _)| inside)
    });
    let computes = |inside: &&str| {
        let code: String = inside.split('"').step_by(2).collect();
        // What a reference leads to is no product.
        let code = code.replace("if *", "if ");
        let code = code.trim_matches(['-', '+', '~', ' ']);
        code.contains(['+', '-', '*', '/', '%']) || code.contains("..]") || code.contains("[..")
    };
    inside.filter(computes).collect()
}

#[test]
fn strangers_stay_strangers() {
    let sources = sources();
    let wrong =
        sources.iter().flat_map(|(path, text)| strangers(path, text).into_iter().map(move |m| (path.as_str(), m)));
    assert_eq!(wrong.collect::<Vec<_>>(), []);
    for (folder, _) in STRANGERS {
        assert!(sources.iter().any(|(path, _)| path.starts_with(folder)), "{folder} is nowhere");
    }
}

#[test]
fn no_two_modules_need_each_other() {
    let mut crates: BTreeMap<&str, BTreeMap<Vec<String>, String>> = BTreeMap::new();
    for (path, text) in sources() {
        let members =
            ["gen/geometry/", "gen/hardware/", "gen/unit/", "gen/engine/", "gen/checks/", "gen/studies/", "gen/cli/"];
        let root = members.into_iter().find(|root| path.starts_with(root)).unwrap_or("gen/");
        let mut module: Vec<String> = path[root.len()..path.len() - 3].split('/').map(str::to_owned).collect();
        if module.last().is_some_and(|last| ["mod", "lib", "main"].contains(&last.as_str())) {
            module.pop();
        }
        crates.entry(root).or_default().insert(module, code(&text));
    }
    let cycles: Vec<String> = crates
        .iter()
        .flat_map(|(root, modules)| cycles(modules).into_iter().map(move |c| format!("{root}: {c}")))
        .collect();
    assert!(cycles.is_empty(), "{}", cycles.join("\n"));
}

#[test]
fn whoever_generates_vhdl_compiles_nothing_else() {
    let arguments = ["tree", "--package", "efsat-unit", "--edges", "normal", "--prefix", "none", "--format", "{p}"];
    let mut cargo = Command::new(env!("CARGO"));
    let output = cargo.args(arguments).args(["--offline", "--locked"]).current_dir(root()).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let tree = String::from_utf8(output.stdout).unwrap();
    let packages: Vec<&str> = tree.lines().filter_map(|line| line.split(' ').next()).collect();
    assert!(packages.contains(&"efsat-hardware") && packages.contains(&"askama"), "{packages:?}");
    let burden: Vec<&str> = NOT_FOR_GENERATORS.into_iter().filter(|name| packages.contains(name)).collect();
    assert_eq!(burden, [""; 0]);
    // Names that no package has would be absent, too.
    let lock = fs::read_to_string(root().join("Cargo.lock")).unwrap();
    let known = |name: &&str| lock.contains(&format!("\nname = \"{name}\"\n"));
    assert!(NOT_FOR_GENERATORS.iter().all(known));
}

/// The licences of deny.toml.
fn allowed(deny: &str) -> Vec<&str> {
    let (_, rest) = deny.split_once("allow = [").unwrap();
    rest.split(']').next().unwrap().split('"').skip(1).step_by(2).collect()
}

/// Whether an expression such as `(MIT OR Apache-2.0) AND Unicode-3.0` can be met with some licences.
fn is_met(expression: &str, allowed: &[&str]) -> bool {
    // An old way to write it.
    let expression = expression.replace('/', " OR ");
    let parts = expression.split(" AND ").map(|part| part.trim_matches(['(', ')']));
    parts
        .into_iter()
        .all(|part| part.split(" OR ").any(|licence| allowed.contains(&licence.trim_matches(['(', ')', ' ']))))
}

/// The packages that a workspace depends on, each with its licence; none if they are not here and cannot be fetched. A lock file that is
/// behind its manifests is a fault.
fn licences(folder: &Path, more: &[&str]) -> Option<Vec<(String, String)>> {
    let arguments = ["tree", "--workspace", "--edges", "normal,build,dev", "--prefix", "none", "--format", "{p}|{l}"];
    let mut cargo = Command::new(env!("CARGO"));
    let output = cargo.args(arguments).arg("--locked").args(more).current_dir(folder).output().unwrap();
    let why = String::from_utf8_lossy(&output.stderr);
    assert!(!why.contains("cannot update the lock file"), "{}: {why}", folder.display());
    let tree = output.status.success().then(|| String::from_utf8(output.stdout).unwrap())?;
    // A package that is there before has a star behind it.
    let packages = tree.lines().map(|line| line.trim_end_matches(" (*)")).filter_map(|line| line.split_once('|'));
    Some(packages.map(|(name, licence)| (name.to_owned(), licence.to_owned())).collect())
}

#[test]
fn licences_of_dependencies_are_allowed() {
    let deny = fs::read_to_string(root().join("deny.toml")).unwrap();
    let allowed = allowed(&deny);
    let mut packages = licences(root(), &["--offline"]).expect("they are compiled");
    assert!(packages.len() > 100);
    let of_python = licences(&root().join("gen/python"), &[]);
    if of_python.is_none() {
        skip("a package that gen/python needs is not installed");
    }
    let all = of_python.is_some();
    packages.extend(of_python.into_iter().flatten());
    let refused: Vec<_> = packages.iter().filter(|(_, licence)| !is_met(licence, &allowed)).collect();
    assert!(refused.is_empty(), "{refused:?}");
    let is_used = |licence: &&&str| packages.iter().any(|(_, expression)| expression.contains(**licence));
    assert!(!all || allowed.iter().all(|licence| is_used(&licence)), "deny.toml allows what nothing needs");
}

/// The fields that the Citation File Format 1.2.0 requires, and the release.
#[test]
fn the_citation_is_complete() {
    let text = fs::read_to_string(root().join("CITATION.cff")).unwrap();
    let value = |key: &str| {
        let line = text.lines().find_map(|line| line.strip_prefix(key)?.strip_prefix(':'));
        line.unwrap_or_else(|| panic!("CITATION.cff lacks {key}")).trim()
    };
    assert_eq!((value("cff-version"), value("version")), ("1.2.0", env!("CARGO_PKG_VERSION")));
    assert!(["message", "title"].into_iter().all(|key| !value(key).is_empty()) && value("authors").is_empty());
    assert!(text.contains("\nauthors:\n  - "), "at least one author");
}

/// Most items that the documentation of all crates of the library shows, counted by [`face::shown`].
const FACE: usize = 928;

#[test]
fn the_face_is_small() {
    let sources = sources();
    let counts = ["hardware", "geometry", "unit", "engine", "checks", "studies"].map(|name| {
        let folder = format!("gen/{name}/");
        let inside =
            sources.iter().filter_map(|(path, text)| Some((path.strip_prefix(&folder)?.to_owned(), code(text))));
        let shown = face::shown(&inside.collect::<Vec<_>>()).len();
        assert!(shown > 20, "{name} shows {shown} items");
        (name, shown)
    });
    let all: usize = counts.iter().map(|(_, shown)| shown).sum();
    assert!(all <= FACE, "{all} public items, expected at most {FACE}; hide what no user needs: {counts:?}");
}

/// Modules of the exact software that its documentation shows, each with an example that runs.
#[test]
fn every_module_of_the_software_has_an_example() {
    let sources = sources();
    let strip = |(path, text): &(String, String)| Some((path.strip_prefix("gen/geometry/")?.to_owned(), text.clone()));
    let sources: BTreeMap<String, String> = sources.iter().filter_map(strip).collect();
    let codes: Vec<(String, String)> = sources.iter().map(|(path, text)| (path.clone(), code(text))).collect();
    let file = |item: String| {
        let path = item.replace("::", "/");
        [format!("{path}.rs"), format!("{path}/mod.rs")].into_iter().find(|path| sources.contains_key(path))
    };
    let modules: BTreeSet<String> = face::shown(&codes).into_iter().filter_map(file).collect();
    assert!(modules.len() > 8, "{modules:?}");
    let has_example = |path: &&String| ["//! ```\n", "/// ```\n"].iter().any(|mark| sources[*path].contains(mark));
    let bare: Vec<&String> = modules.iter().filter(|path| !has_example(path)).collect();
    assert!(bare.is_empty(), "without an example: {bare:?}");
}

#[test]
fn only_the_command_line_prints() {
    let printing = sources()
        .into_iter()
        .filter(|(path, text)| !PRINTERS.iter().any(|printer| path.starts_with(printer)) && prints(text));
    assert_eq!(printing.map(|(path, _)| path).collect::<Vec<_>>(), Vec::<String>::new());
}

/// What a test prints by itself nobody counts: `tools::skip` says that a tool is missing.
#[test]
fn no_test_skips_uncounted() {
    let mark = ["println!(\"", "skipped"].concat();
    let skips = ["gen", "testbench"].into_iter().flat_map(files).filter(|path| {
        let text = String::from_utf8_lossy(&fs::read(path).unwrap()).into_owned();
        text.contains(&mark)
    });
    assert_eq!(skips.map(|path| relative(&path)).collect::<Vec<_>>(), Vec::<String>::new());
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
    let wrong = |path, text: &str| strangers(path, text).concat();
    assert_eq!(wrong("gen/unit/golden/axes.rs", "use efsat_hardware::graph::Op;"), "graph");
    assert_eq!(wrong("gen/unit/golden/mod.rs", "fn f(x: crate::design::Design) {}"), "design");
    let group = "use efsat_unit::{\n    params::{Params, Upper},\n    design,\n};";
    assert_eq!(imports(group), ["design", "params"]);
    assert_eq!(wrong("gen/studies/wall/map.rs", group), "design");
    // What is fine stays so: other folders, comments, tests.
    assert_eq!(wrong("gen/checks/cosim/mod.rs", group), "");
    assert_eq!(wrong("gen/unit/golden/mod.rs", "use efsat_hardware::number::Upper;\n//! [`host`](crate::host)"), "");
    let tested = "#[cfg(test)]\nmod tests {\n    use crate::host::sample;\n}\n";
    assert_eq!(wrong("gen/unit/golden/mod.rs", tested), "");
    assert_eq!(wrong("gen/unit/golden/mod.rs", &format!("{tested}use crate::host::sample;")), "host");
    assert!(prints("fn f() {\n    println!(\"x\");\n}") && !prints("// println!(\"x\");\nfn f() {}"));
    assert_eq!(unfinished(&["TO", "DO: later"].concat()), Some("TODO"));
    assert_eq!(allowed("[licenses]\nallow = [\n \"MIT\",\n \"ISC\"]\n"), ["MIT", "ISC"]);
    assert!(is_met("MIT/Apache-2.0", &["MIT"]) && is_met("(MIT OR X) AND Y", &["MIT", "Y"]));
    assert!(!is_met("(MIT OR X) AND Y", &["MIT"]) && !is_met("GPL-3.0", &["MIT"]) && !is_met("", &["MIT"]));
    let template = "{{ a }} {{ bits - 1 }} {{ 2*b }} a / b {{ list[1..] }} {{ list[0] }} {% if *c %} {%- if a - 1 > b -%} \
        {%- if a == \"-\" -%} {{- c -}}";
    assert_eq!(computing(template), [" bits - 1 ", " 2*b ", " list[1..] ", "- if a - 1 > b -"]);
    let module = |path: &str, text: &str| (path.split("::").map(str::to_owned).collect(), text.to_owned());
    let ring = [
        module("a::x", "use super::y::{self, Z};"),
        module("a::y", "use crate::b::W;"),
        module("b", "use super::a::x;"),
    ];
    let source = |path: &str, text: &str| (path.to_owned(), text.to_owned());
    let lib = "pub mod a;\n#[doc(hidden)]\npub mod b;\nmod c;\npub use c::{T, f};\n#[doc(hidden)]\npub use c::U;\npub(crate) fn g() {}";
    let hidden = "pub struct T;\nimpl<P: X<Y>> T {\n    pub const fn new() {}\n    fn old() {}\n}\n\
        pub struct U;\nimpl U {\n    pub fn new() {}\n}\npub fn f() {}";
    let small = [
        source("lib.rs", lib),
        source("a.rs", "pub enum E {}"),
        source("b.rs", "pub enum F {}"),
        source("c.rs", hidden),
    ];
    assert_eq!(face::shown(&small), ["a", "a::E", "c::T", "c::f", "c::T.new"]);
    assert_eq!(cycles(&ring.clone().into()), ["a needs b", "b needs a"]);
    assert!(cycles(&ring[..2].iter().cloned().collect()).is_empty());
}
