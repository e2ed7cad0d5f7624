//! `efsat stress --once` as others use it: the log, a run that goes on, shards, and one clear line for every error.

use crate::tools::program::{object, refuses, succeeds};
use serde_json::Value;
use std::fs;

/// Two families, so that a block is small.
const FEW: &str = "stress --once --family lattice-5 --family vertex-on-face-sweep --seed 7 --width 12";
/// Two blocks.
const PAIRS: &str = "--pairs 65536";

#[test]
fn a_run_goes_on_and_shards_are_the_whole() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    let whole = succeeds(dir, &format!("{FEW} {PAIRS} --log log --json"));
    assert_eq!(whole, succeeds(dir, &format!("{FEW} {PAIRS} --json")), "with a log and without");
    let text = fs::read_to_string(dir.join("log")).unwrap();
    assert_eq!(text.lines().count(), 2);

    // Cut within the second line: that block is made again.
    fs::write(dir.join("log"), &text[..text.len() - 100]).unwrap();
    assert_eq!(whole, succeeds(dir, &format!("{FEW} {PAIRS} --log log --json")));
    assert_eq!(text, fs::read_to_string(dir.join("log")).unwrap());

    for part in [1, 2] {
        succeeds(dir, &format!("{FEW} {PAIRS} --shard {part}/2 --log part-{part}"));
        assert_eq!(fs::read_to_string(dir.join(format!("part-{part}"))).unwrap().lines().count(), 1);
    }
    let parts = ["part-2", "part-1"].map(|part| fs::read_to_string(dir.join(part)).unwrap());
    fs::write(dir.join("parts"), parts.concat()).unwrap();
    assert_eq!(whole, succeeds(dir, &format!("{FEW} {PAIRS} --log parts --json")));

    let value: Value = serde_json::from_str(&whole).unwrap();
    assert_eq!(value["pairs"], 65536);
    let total = &value["total"];
    let count = |value: &Value, name: &str| value[name].as_u64().unwrap();
    let exact: u64 = ["separate", "touch", "intersect"].map(|name| count(total, name)).iter().sum();
    let design = &total["designs"][0];
    let answered: u64 = ["separate", "intersect", "possibly_incorrect"].map(|name| count(design, name)).iter().sum();
    assert_eq!((exact, answered, count(design, "wrong"), count(total, "disagreements")), (65536, 65536, 0, 0));
    assert!(count(design, "separate") > 10_000 && count(design, "intersect") > 1_000);
}

#[test]
fn a_sweep_asks_every_design() {
    let home = tempfile::tempdir().unwrap();
    let sweep = "stress --once --sweep method=axes|determinants,width=8|18 --family lattice-5 --pairs 1";
    let value = object(&home, &format!("{sweep} --json"));
    let open: Vec<u64> = value["total"]["designs"]
        .as_array()
        .unwrap()
        .iter()
        .map(|design| design["possibly_incorrect"].as_u64().unwrap())
        .collect();
    assert_eq!(open.len(), 4);
    assert!(open[1] < open[0] && open[3] < open[2], "more bits, fewer open pairs: {open:?}");
    let table = succeeds(home.path(), sweep);
    assert!(table.contains("(3) efsat generate --method determinants --width 8 "), "{table}");
    assert!(table.contains("wrong (4)"), "{table}");
}

#[test]
fn errors_say_what_was_expected() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    succeeds(dir, &format!("{FEW} --pairs 1 --log log"));
    refuses(dir, &format!("{} --pairs 1 --log log", FEW.replace("12", "13")), "found a block of another test");
    fs::write(dir.join("notes"), "mine\n").unwrap();
    refuses(dir, "stress --once --log notes", "line 1: found expected value");
    assert_eq!(fs::read_to_string(dir.join("notes")).unwrap(), "mine\n");
    refuses(dir, "stress --once --log .", "directory");
    refuses(dir, "stress --once --shard 1/2", "--log");
    refuses(dir, "stress --once --shard 3/2 --log x", "I from 1 to N");
    refuses(dir, "stress --once --pairs 0", "expected a whole number from 1 to 18446744073709551615");
    refuses(dir, "stress --once --pairs 18446744073709551615", "expected fewer than 2^64 pairs");
    refuses(dir, "stress --once --sweep width=1", "--sweep: at character");
    refuses(
        dir,
        "stress --once --sweep width=16|18 --width 20",
        "--width with --sweep, which sets width too: expected only one",
    );
    refuses(dir, "stress --once --family nobody", "nobody");
}
