//! The program as others run it: in a folder, with what is typed behind its name.

use efsat_hardware::tools::FOLDER;
use serde_json::Value;
use std::path::Path;
use std::process::{Command, Stdio};
use tempfile::TempDir;

/// Where it is.
pub const PROGRAM: &str = env!("CARGO_BIN_EXE_efsat");

/// Status, standard output, standard error.
pub type Ran = (Option<i32>, String, String);

/// The program, not yet started. Words have blanks between them, or are `'in quotes'`.
pub fn command(dir: impl AsRef<Path>, line: &str) -> Command {
    let mut command = Command::new(PROGRAM);
    for (i, part) in line.split('\'').enumerate() {
        match i % 2 {
            0 => command.args(part.split_whitespace()),
            _ => command.arg(part),
        };
    }
    // Tests run side by side.
    command.current_dir(dir).stdin(Stdio::null()).env("RAYON_NUM_THREADS", "2");
    command
}

/// Runs a program to its end.
pub fn ran(command: &mut Command) -> Ran {
    let output = command.output().unwrap_or_else(|e| panic!("{command:?}: {e}"));
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

pub fn efsat(dir: impl AsRef<Path>, line: &str) -> Ran {
    ran(&mut command(dir, line))
}

/// Runs it in an empty folder, without any tool.
pub fn without_tools(empty: &TempDir, line: &str) -> Ran {
    ran(command(empty, line).env("PATH", empty.path()).env_remove(FOLDER))
}

/// Standard output of a run that succeeds and says nothing else.
pub fn succeeds(dir: impl AsRef<Path>, line: &str) -> String {
    let (status, output, errors) = efsat(dir, line);
    assert_eq!((status, errors.as_str()), (Some(0), ""), "efsat {line}");
    output
}

/// The JSON object that such a run prints, as one line.
pub fn object(dir: impl AsRef<Path>, line: &str) -> Value {
    let output = succeeds(dir, line);
    assert_eq!(output.lines().count(), 1, "efsat {line}: {output}");
    serde_json::from_str(&output).unwrap_or_else(|e| panic!("efsat {line}: {e}: {output}"))
}

/// Expects `status`, one line on standard error with `part` in it, and nothing on standard output.
pub fn fails(dir: impl AsRef<Path>, line: &str, status: i32, part: &str) {
    let (found, output, errors) = efsat(dir, line);
    assert_eq!((found, output.as_str(), errors.lines().count()), (Some(status), "", 1), "efsat {line}: {errors}");
    assert!(errors.starts_with("error: ") && errors.contains(part), "efsat {line}: {errors}; expected {part}");
}

/// As [`fails`], with the status of wrong input.
pub fn refuses(dir: impl AsRef<Path>, line: &str, part: &str) {
    fails(dir, line, 2, part);
}
