//! Commands of `cargo`: packages, features, targets and tests that there are, by the files of the workspace.

use crate::book::root;
use std::fs;
use std::path::Path;
use std::sync::OnceLock;

/// Packages and their folders.
const PACKAGES: [(&str, &str); 9] = [
    ("efsat", "gen"),
    ("efsat-hardware", "gen/hardware"),
    ("efsat-geometry", "gen/geometry"),
    ("efsat-unit", "gen/unit"),
    ("efsat-engine", "gen/engine"),
    ("efsat-checks", "gen/checks"),
    ("efsat-studies", "gen/studies"),
    ("efsat-cli", "gen/cli"),
    ("benches", "benches"),
];

/// The file that says what a package is.
fn manifest(package: &str) -> Option<String> {
    let (_, folder) = PACKAGES.iter().find(|(name, _)| *name == package)?;
    let folder = if package == "efsat" { "." } else { folder };
    let manifest = fs::read_to_string(root().join(folder).join("Cargo.toml")).unwrap();
    assert!(manifest.contains(&format!("\nname = \"{package}\"\n")), "{folder}/Cargo.toml");
    Some(manifest)
}

/// Whether a section of a manifest, such as `[features]`, has an entry of this name, or a target is called so.
fn has(manifest: &str, section: &str, name: &str) -> bool {
    let sections = manifest.split("\n[").filter(|text| text.starts_with(section));
    let own = [format!("{name} = "), format!("name = \"{name}\"")];
    sections.flat_map(str::lines).any(|line| own.iter().any(|own| line.starts_with(own)))
}

/// The names of the tests in a text, behind that of its module. Code is as `cargo fmt` leaves it: a module within a file ends at a
/// brace in the first column.
fn names(module: &str, text: &str) -> Vec<String> {
    let mut found = vec![];
    let (mut inner, mut test) = (String::new(), false);
    for line in text.lines() {
        let code = line.trim_start();
        if let Some(name) = line.strip_suffix(" {").and_then(|line| line.strip_prefix("mod ")) {
            inner = format!("{name}::");
        } else if line == "}" {
            inner.clear();
        } else if code == "#[test]" {
            test = true;
        } else if let Some((_, name)) = code.split_once("fn ").filter(|_| test) {
            let name = name.split('(').next().unwrap_or_default();
            found.push(format!("{module}{inner}{name}"));
            test = false;
        }
    }
    found
}

/// The names of all tests below a folder.
fn search(folder: &Path, module: &str, found: &mut Vec<String>) {
    for entry in fs::read_dir(folder).unwrap().map(Result::unwrap) {
        let name = entry.file_name().into_string().unwrap();
        let kind = entry.file_type().unwrap();
        let other_package = PACKAGES.iter().any(|(_, folder)| entry.path() == root().join(folder));
        if kind.is_dir() && !other_package {
            search(&entry.path(), &format!("{module}{name}::"), found);
        } else if let Some(name) = name.strip_suffix(".rs").filter(|_| kind.is_file()) {
            let whole = ["mod", "lib", "main"].contains(&name);
            let module = if whole { module.to_owned() } else { format!("{module}{name}::") };
            found.extend(names(&module, &fs::read_to_string(entry.path()).unwrap()));
        }
    }
}

/// The names of all tests of a package, or of those in `testbench`.
pub fn tests(of: &str) -> &'static [String] {
    static ALL: OnceLock<Vec<(&str, Vec<String>)>> = OnceLock::new();
    let all = ALL.get_or_init(|| {
        let folders = PACKAGES.into_iter().chain([("testbench", "testbench")]);
        let of = |folder: &str| {
            let mut found = vec![];
            search(&root().join(folder), "", &mut found);
            found
        };
        folders.map(|(name, folder)| (name, of(folder))).collect()
    });
    all.iter().find(|(name, _)| *name == of).map_or(&[], |(_, tests)| tests)
}

/// The words of a `cargo test` that say what is compiled.
pub fn selection(words: &[String]) -> Option<Vec<String>> {
    let at = words.iter().position(|word| word == "-p")?;
    let features = words.iter().position(|word| word == "--features");
    Some([Some(at), features].into_iter().flatten().flat_map(|at| words[at..].iter().take(2).cloned()).collect())
}

/// The words before and behind `--`.
fn halves(words: &[String]) -> [&[String]; 2] {
    let at = words.iter().position(|word| word == "--");
    [&words[..at.unwrap_or(words.len())], at.map_or(&[], |at| &words[at + 1..])]
}

/// What is wrong with a command, by the words after `cargo`.
pub fn fault(words: &[String]) -> Option<String> {
    let (name, rest) = words.split_first()?;
    let known = [
        "bench", "binstall", "build", "clippy", "doc", "fmt", "install", "mutants", "package", "publish", "run",
        "test", "tree",
    ];
    if !known.contains(&name.as_str()) {
        return Some(format!("cargo {name}: no such command"));
    }
    let [ours, behind] = halves(rest);
    let (mut package, mut target, mut features, mut filters) = (None, None, "", vec![]);
    let mut ours = ours.iter().map(String::as_str);
    while let Some(word) = ours.next() {
        match word {
            "-p" | "--package" => package = ours.next().filter(|name| !super::is_placeholder(name)),
            // A file of cargo mutants.
            "-f" => drop(ours.next()),
            "--features" => features = ours.next().unwrap_or_default(),
            "--test" | "--bench" => target = ours.next().map(|name| (&word[2..], name)),
            _ if word.starts_with('-') => {}
            _ => filters.push(word),
        }
    }
    filters.extend(behind.iter().map(String::as_str).filter(|word| !word.starts_with('-')));
    // Those of the top level stand in its own manifest.
    let of = package.unwrap_or("efsat");
    let Some(manifest) = manifest(of) else { return Some(format!("{of}: no such package")) };
    let mut of_package = features.split(',').filter(|name| !name.is_empty());
    if let Some(name) = of_package.find(|name| !has(&manifest, "features]", name)) {
        return Some(format!("{name}: no feature of {of}"));
    }
    if let Some((kind, name)) = target.filter(|(kind, name)| !has(&manifest, &format!("[{kind}]]"), name)) {
        return Some(format!("{name}: no {kind} of {of}"));
    }
    let sought = match (name.as_str(), package, target) {
        ("test", _, Some((_, target))) => vec![target],
        ("test", Some(package), None) => vec![package],
        ("test", None, None) => PACKAGES.iter().map(|(name, _)| *name).chain(["testbench"]).collect(),
        _ => return None,
    };
    let found = |filter: &str| sought.iter().flat_map(|of| tests(of)).any(|test| test.contains(filter));
    let missing = filters.into_iter().find(|filter| !super::is_placeholder(filter) && !found(filter))?;
    Some(format!("{missing}: no test of {}", sought.join(", ")))
}

/// What is found in the files are the tests that there are.
#[test]
fn the_search_finds_the_tests_of_this_program() {
    let output =
        std::process::Command::new(std::env::current_exe().unwrap()).args(["--list", "--format", "terse"]).output();
    let listed = String::from_utf8(output.unwrap().stdout).unwrap();
    let mut listed: Vec<&str> = listed.lines().filter_map(|line| line.strip_suffix(": test")).collect();
    let mut found = tests("testbench").to_vec();
    listed.sort();
    found.sort();
    assert!(found.len() > 200);
    assert_eq!(found, listed);
}
