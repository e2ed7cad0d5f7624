//! The exact software as those see it who use nothing else: the page's example in a crate of its own, and the package for Python.

use crate::tools::{has, run};
use std::path::Path;
use std::process::Command;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// The page's example with the one dependency that it names, as it stands there. (With the crate's own features a test of its
/// documentation runs it, too.)
#[test]
#[ignore = "compiles a crate and what it needs from nothing"]
fn a_crate_of_its_own_runs_the_page() {
    let home = tempfile::tempdir().unwrap();
    let page = std::fs::read_to_string(Path::new(ROOT).join("docs/exact-software.md")).unwrap();
    let (_, rest) = page.split_once("```rust\n").unwrap();
    let manifest = format!(
        "[package]\nname = \"own\"\nedition = \"2024\"\n[dependencies]\nefsat-geometry = {{ path = \"{ROOT}/gen/geometry\" }}\n"
    );
    std::fs::create_dir(home.path().join("src")).unwrap();
    std::fs::write(home.path().join("Cargo.toml"), manifest).unwrap();
    std::fs::copy(Path::new(ROOT).join("Cargo.lock"), home.path().join("Cargo.lock")).unwrap();
    std::fs::write(home.path().join("src/main.rs"), rest.split_once("\n```").unwrap().0).unwrap();
    run(home.path(), env!("CARGO"), &["run", "--release", "--quiet", "--target-dir", "target"]);
    // As many packages as the page says.
    let tree = run(
        home.path(),
        env!("CARGO"),
        &["tree", "--package", "efsat-geometry", "--edges", "normal", "--prefix", "none"],
    );
    let mut packages: Vec<&str> =
        tree.lines().filter_map(|line| line.split(' ').next()).filter(|x| !x.is_empty()).collect();
    packages.sort_unstable();
    packages.dedup();
    let said = format!("{} packages with itself", packages.len());
    assert!(page.contains(&said), "expected \"{said}\": {packages:?}");
}

/// The wheel is built, installed and tested; the page's Python runs.
#[test]
#[ignore = "compiles the binding and what it needs from nothing"]
fn the_package_for_python_works() {
    if has("Python", "python3", "--version") {
        let mut script = Command::new(Path::new(ROOT).join("scripts/python"));
        let output = script.arg("test").output().unwrap();
        let (said, errors) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
        assert!(output.status.success(), "{said}{errors}");
        let size = said.lines().find_map(|line| line.strip_suffix(" MB")?.rsplit_once(", ")?.1.parse::<f64>().ok());
        assert!(size.is_some_and(|size| size < 5.0), "the wheel is below 5 MB: {said}");
    }
}
