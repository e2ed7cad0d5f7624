//! Tools that some tests need.

use std::process::Command;

/// A text with one place of it changed. A place that is not there, or there twice, is a mistake of the test.
pub fn replaced(text: &str, from: &str, to: &str) -> String {
    assert_eq!(text.matches(from).count(), 1, "{from}");
    text.replace(from, to)
}

/// The GHDL that compiles fastest; where none is installed none, which is said.
pub fn ghdl() -> Option<&'static str> {
    let found = |name: &&str| Command::new(name).arg("--version").output().is_ok_and(|o| o.status.success());
    let command = ["ghdl-mcode", "ghdl", "ghdl-llvm", "ghdl-gcc"].into_iter().find(found);
    if command.is_none() {
        eprintln!("skipped: GHDL is not installed");
    }
    command
}
