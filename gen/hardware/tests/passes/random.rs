//! Random designs: what a graph evaluates to is what its netlist gives clock by clock, in simulation and in GHDL.
//!
//! A design that fails is made smaller as long as it fails, and written to `kept/`; whatever is there is tried again each time.

mod build;
mod case;
mod run;

use case::Case;
use run::{compare, ghdl};
use std::fs;
use std::path::{Path, PathBuf};

/// Designs in the test of the two semantics in Rust, and among them those that GHDL runs.
const DESIGNS: u64 = 3000;
const IN_GHDL: u64 = 300;

fn kept() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/passes/kept")
}

/// Makes a failure smaller, keeps it, and tells it.
fn fail(case: &Case, fails: impl Fn(&Case) -> Option<String>) -> ! {
    let (case, why) = case.shrunk(fails);
    let text = case.to_string();
    let name = text.bytes().fold(0u32, |hash, byte| hash.rotate_left(5) ^ u32::from(byte).wrapping_mul(0x9E37_79B1));
    let path = kept().join(format!("{name:08x}.txt"));
    fs::create_dir_all(kept()).expect("a folder for failures");
    fs::write(&path, &text).expect("a file for the failure");
    panic!("{why}\nkept as {}:\n{text}{}", path.display(), build::shown(&case));
}

#[test]
fn graphs_and_netlists_agree() {
    for case in (0..DESIGNS).map(Case::random) {
        if compare(&case).is_some() {
            fail(&case, compare);
        }
    }
}

#[test]
fn netlists_and_vhdl_agree() {
    let cases: Vec<Case> = (0..IN_GHDL).map(Case::random).collect();
    // So many at once that a command line has room for their files.
    for some in cases.chunks(100) {
        if let Some((wrong, _)) = ghdl(some) {
            fail(&some[wrong], |case| ghdl(std::slice::from_ref(case)).map(|(_, why)| why));
        }
    }
}

#[test]
fn what_failed_once_does_not_fail_again() {
    let mut files: Vec<PathBuf> =
        fs::read_dir(kept()).into_iter().flatten().map(|file| file.expect("a file").path()).collect();
    files.sort();
    let texts = files.iter().filter(|file| file.extension().is_some_and(|end| end == "txt"));
    let cases: Vec<Case> = texts.map(|file| Case::parse(&fs::read_to_string(file).expect("a case"))).collect();
    for case in &cases {
        assert_eq!(compare(case), None, "{case}");
    }
    assert_eq!(ghdl(&cases), None);
}

/// Every kind of step is taken, and most designs have what makes passes differ.
#[test]
fn designs_are_of_all_kinds() {
    let cases: Vec<Case> = (0..600).map(Case::random).collect();
    let without: Vec<&str> = build::kinds()
        .filter(|kind| !cases.iter().any(|case| case.steps.iter().any(|step| step.kind == *kind)))
        .collect();
    assert_eq!(without, [""; 0]);
    let texts: Vec<String> = cases.iter().map(build::shown).collect();
    assert!(texts.iter().filter(|text| text.starts_with("not built")).count() < 30);
    let share = |word: &str| texts.iter().filter(|text| text.contains(word)).count();
    let rare: Vec<(&str, usize)> = [
        " late",
        "Mux",
        "Capture",
        "Earlier",
        "ScanOr",
        "Instance of",
        "strobe0",
        "busy_",
        "_h2",
        "Clocks are those of design.",
        "_d2",
        "group_0",
        "Line of",
        "_chain_",
        "Assume",
        "Known",
        "Steady",
    ]
    .map(|word| (word, share(word)))
    .into_iter()
    .filter(|(_, designs)| *designs < 5)
    .collect();
    assert_eq!(rare, [], "words and the designs of 600 that have them");
}

/// A design with a mistake is found, and made small.
#[test]
fn failures_are_made_small() {
    let multiplies = |case: &Case| build::shown(case).contains("Multiply").then(|| "it multiplies".to_owned());
    let case = (0..).map(Case::random).find(|case| multiplies(case).is_some()).expect("some design multiplies");
    let (small, why) = case.shrunk(multiplies);
    assert_eq!((small.steps.len(), why.as_str()), (1, "it multiplies"), "{small}");
    assert_eq!(Case::parse(&small.to_string()), small);
}
