//! The built-in scenes through the program: no definite verdict contradicts the exact answer, and re-normalisation is
//! what makes most of them definite.

use serde_json::Value;
use std::process::Command;

fn classify(args: &[&str]) -> Value {
    let output =
        Command::new(env!("CARGO_BIN_EXE_efsat")).arg("classify").args(args).args(["--exact", "--json"]).output();
    let output = output.expect("it runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("one JSON object")
}

/// Share of definite verdicts.
fn definite(report: &Value) -> f64 {
    assert_eq!(report["wrong"], 0, "{report}");
    1.0 - report["verdicts"]["possibly_incorrect"].as_f64().unwrap() / report["pairs"].as_f64().unwrap()
}

#[test]
fn default_scene() {
    let shares = [&[][..], &["--width", "19"], &["--renormalise", "off"], &["--axes", "17", "--upper", "sticky"]];
    let [default, wider, raw, sticky] = shares.map(|change| {
        let mut args = vec!["--scene", "headlight"];
        args.extend(change);
        definite(&classify(&args))
    });
    assert!(default > 0.98, "{default}");
    assert!(wider > 0.99, "one more bit: {wider}");
    assert!(raw < 0.5, "without re-normalisation: {raw}");
    assert!(sticky > default, "exact ceilings: {sticky}");
}

#[test]
fn bolt_and_nut() {
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/bolt_nut.toml");
    assert!(definite(&classify(&["--scene", scene])) > 0.98);
}
