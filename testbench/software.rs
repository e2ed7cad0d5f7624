//! The exact software as those see it who use nothing else: the page's example in a crate of its own, and the package for Python.

use crate::tools::{has, program, run, skip};
use efsat::collide::{Collider, Contact};
use efsat::self_intersections::{self, Defect};
use efsat::software::retest::retest_parallel;
use efsat::{mesh, scene};
use efsat_hardware::testing::full;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::time::SystemTime;

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

/// The wheel is built, installed into a fresh environment and tested; the page's Python runs.
#[test]
fn the_package_for_python_works() {
    if let Some(python) = package() {
        run(Path::new(ROOT), &python, &["-m", "pytest", "--quiet", "-p", "no:cacheprovider", "gen/python/tests"]);
    }
}

/// The newest change of a file below a folder.
fn newest(folder: &Path) -> SystemTime {
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let changed =
        |path: PathBuf| if path.is_dir() { newest(&path) } else { path.metadata().unwrap().modified().unwrap() };
    entries.map(changed).max().unwrap_or(SystemTime::UNIX_EPOCH)
}

/// The Python that has the package of the present sources; where there is none, this is said. If everything is asked for, the package is
/// made and tested first, once for all tests.
fn package() -> Option<String> {
    static TESTED: OnceLock<()> = OnceLock::new();
    if full() && has("Python", "python3", "--version") {
        TESTED.get_or_init(|| drop(run(Path::new(ROOT), &format!("{ROOT}/scripts/python"), &["test"])));
    }
    let venv = Path::new(ROOT).join("target/python-venv");
    let sources = ["python", "geometry", "unit", "engine", "hardware"]
        .map(|name| newest(&Path::new(ROOT).join("gen").join(name)));
    let built = venv.join("built").metadata().and_then(|built| built.modified());
    let is_present = built.is_ok_and(|built| sources.into_iter().all(|changed| changed <= built));
    if !is_present {
        skip("the package for Python of these sources is not installed: scripts/python");
    }
    is_present.then(|| venv.join("bin/python").display().to_string())
}

/// What a Python answers for the files that are named: a row for each pair of a mesh that intersects itself, for each pair of a file
/// of pairs, and for each contact of a scene.
const IN_PYTHON: &str = r#"
import sys, numpy as np, efsat
for path in sys.argv[1:]:
    try:
        if path.endswith(".f64"):
            words = ["separate", "touch", "intersect"]
            rows = [words[answer] for answer in efsat.retest(np.fromfile(path, "<f8").reshape(-1, 18))]
        elif path.endswith(".toml"):
            scene = efsat.scene(path)
            meshes = scene.meshes()
            rows = [
                f"{frame},{a},{b},{p},{q},{efsat.KINDS[kind]}"
                for frame in range(len(scene))
                for a, b, pose in scene.meetings(frame)
                for found in [efsat.Collider(meshes[a], meshes[b]).contacts(pose)]
                for (p, q), kind in zip(found.pairs, found.kinds)
            ]
        else:
            pairs, kinds = efsat.self_intersections(efsat.read_mesh(path))
            rows = [f"{p},{q},{kind}" for (p, q), kind in zip(pairs, kinds)]
    except ValueError:
        rows = ["refused"]
    print(path, *rows)
"#;

/// The same of the library.
fn in_rust(path: &Path) -> Option<Vec<String>> {
    match path.extension()?.to_str()? {
        "f64" => {
            let bytes = std::fs::read(path).ok()?;
            let numbers: Vec<f64> = bytes.as_chunks::<8>().0.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect();
            let pairs = numbers.as_chunks::<3>().0.as_chunks::<6>().0;
            Some(retest_parallel(pairs).ok()?.iter().map(ToString::to_string).collect())
        }
        "toml" => {
            let scene = scene::load(path).ok()?;
            let contacts = |frame: usize, meeting: &scene::Meeting| {
                let [a, b] = [meeting.a, meeting.b].map(|object| &*scene.objects[object].mesh);
                let row = |Contact { a: p, b: q, kind }: Contact| {
                    format!("{frame},{},{},{p},{q},{}", meeting.a, meeting.b, kind.name())
                };
                Collider::new(a, b).contacts(&meeting.pose).into_iter().map(row).collect::<Vec<_>>()
            };
            let near = scene.near();
            let frames = 0..scene.frames();
            Some(
                frames
                    .flat_map(|frame| near.meetings(frame).iter().flat_map(|m| contacts(frame, m)).collect::<Vec<_>>())
                    .collect(),
            )
        }
        _ => {
            let row = |Defect { pair: (p, q), kind }: &Defect| format!("{p},{q},{}", kind.name());
            Some(self_intersections::find(&mesh::read(path).ok()?).iter().map(row).collect())
        }
    }
}

/// How many rows the command line has for the same file; what they are other tests compare with the library. None also of a file whose
/// faces are left out in part, which the library refuses.
fn on_the_command_line(path: &Path) -> Option<u64> {
    let (of, name) = match path.extension()?.to_str()? {
        "f64" => ("classify --method exact --retest --exact --json", "pairs"),
        "toml" => ("scene pairs --json", "touching"),
        _ => ("self-intersections --json", "defects"),
    };
    let (status, said, errors) = program::efsat(ROOT, &format!("{of} '{}'", path.display()));
    let taken = status == Some(0) && !errors.contains("left out");
    let said: Option<serde_json::Value> = taken.then(|| serde_json::from_str(&said).unwrap());
    said.map(|said| said.get("total").unwrap_or(&said)[name].as_u64().unwrap())
}

/// Everything that users of other programs have reported.
fn reported(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries.flat_map(|path| if path.is_dir() { reported(&path) } else { vec![path] }).collect()
}

#[test]
fn python_rust_and_the_command_line_answer_alike() {
    let files = reported(&Path::new(ROOT).join("testbench/reported"));
    assert!(files.len() > 20);
    let rust: Vec<Option<Vec<String>>> = files.iter().map(|path| in_rust(path)).collect();
    for (path, answers) in files.iter().zip(&rust) {
        let count = answers.as_ref().map(|answers| answers.len() as u64);
        assert_eq!(on_the_command_line(path), count, "{}", path.display());
    }
    if let Some(python) = package() {
        let paths: Vec<&str> = files.iter().map(|path| path.to_str().unwrap()).collect();
        let said = run(Path::new(ROOT), &python, &[&["-c", IN_PYTHON], &paths[..]].concat());
        let refused = || vec!["refused".to_owned()];
        let rows = files.iter().zip(rust).map(|(path, answers)| {
            [vec![path.display().to_string()], answers.unwrap_or_else(refused)].concat().join(" ")
        });
        assert_eq!(said.lines().collect::<Vec<_>>(), rows.collect::<Vec<_>>());
    }
}
