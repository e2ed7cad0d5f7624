//! The programs in `examples/`, each run once.

use crate::tools::program::succeeds;
use efsat::exact::Exact;
use efsat::pair::Verdict;
use std::path::Path;

#[path = "../examples/classify.rs"]
#[allow(dead_code, reason = "the test calls what main calls")]
mod classify;
#[path = "../examples/drive.rs"]
#[allow(dead_code, reason = "the test calls what main calls")]
mod drive;
#[path = "../examples/engine.rs"]
#[allow(dead_code, reason = "the test calls what main calls")]
mod engine;
#[path = "../examples/generate.rs"]
#[allow(dead_code, reason = "the test calls what main calls")]
mod generate;

const PAIRS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/three_pairs.csv");

#[test]
fn vhdl_is_generated() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path().join("rtl");
    let said = generate::write(&dir).unwrap();
    assert!(said.contains(" multipliers, initiation interval 4, latency "), "{said}");
    assert!(dir.join("efsat.vhd").exists() && dir.join("manifest.json").exists());
}

#[test]
fn pairs_are_classified() {
    let answers = classify::answers(PAIRS).unwrap();
    let expected = [
        (Verdict::Intersect, Exact::Intersect),
        (Verdict::Separate, Exact::Separate),
        (Verdict::PossiblyIncorrect, Exact::Touch),
    ];
    assert_eq!(answers, expected);
    let wrong = Path::new(env!("CARGO_MANIFEST_DIR")).join("Cargo.toml");
    assert!(classify::answers(wrong.to_str().unwrap()).is_err());
}

/// The same file as the command line reads it.
#[test]
fn the_command_line_says_the_same() {
    let expected = "pair,verdict,exact\n0,intersect,intersect\n1,separate,separate\n2,possibly-incorrect,touch\n";
    assert_eq!(succeeds(".", &format!("classify '{PAIRS}' --exact")), expected);
}

#[test]
fn a_stream_is_driven() {
    let (answers, sent) = drive::drive().unwrap();
    assert_eq!(answers, [Exact::Intersect, Exact::Touch, Exact::Separate]);
    assert!(sent > 0 && sent % 8 == 0);
}

#[test]
fn an_engine_is_driven() {
    let answers = engine::contacts(&[0, 823, 824]).unwrap();
    let touching: Vec<usize> = answers.iter().map(|(_, contacts)| contacts.touching().count()).collect();
    assert_eq!(touching, [0, 22, 54], "as efsat scene pairs counts them");
    assert!(answers.iter().all(|(_, contacts)| contacts.software.is_none()));
}
