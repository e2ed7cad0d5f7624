//! Where synthesis tools are found, and how they are run.

use super::ToolError;
use crate::process::{FOREVER, Running};
use std::fs::File;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

pub use efsat_hardware::tools::{FOLDER, Tool, find};

/// Runs a tool in a folder, its output kept in `log`.
///
/// # Errors
/// The first error it printed.
pub fn call(tool: &Path, args: &[&str], dir: &Path, log: &str) -> Result<(), ToolError> {
    call_within(FOREVER, tool, args, dir, log).map(|_| ())
}

/// Runs a tool in a folder, its output kept in `log`, and stops it after a time; whether it ended by itself.
///
/// # Errors
/// The first error it printed, one in capitals before others.
pub fn call_within(limit: Duration, tool: &Path, args: &[&str], dir: &Path, log: &str) -> Result<bool, ToolError> {
    let name = tool.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let failed = |message: String| ToolError::failed(&name, message);
    let path = dir.join(log);
    let file = File::create(&path).map_err(ToolError::file(&path))?;
    let both = file.try_clone().map_err(ToolError::file(&path))?;
    let mut command = Command::new(tool);
    command.args(args).current_dir(dir).stdin(Stdio::null()).stdout(file).stderr(both);
    let status = Running::start(&mut command).and_then(|running| running.wait(limit));
    let Some(status) = status.map_err(|e| failed(e.to_string()))? else { return Ok(false) };
    if status.success() {
        return Ok(true);
    }
    let said = std::fs::read(&path).map_err(ToolError::file(&path))?;
    let said = String::from_utf8_lossy(&said);
    // Yosys' own error is in capitals; what a tool that it calls gets over is not.
    let error = ["ERROR", "rror:"].iter().find_map(|word| said.lines().find(|line| line.contains(word)));
    Err(failed(error.or(said.lines().last()).unwrap_or("it failed without a word").trim().to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tool_is_stopped_when_its_time_is_over() {
        let dir = tempfile::TempDir::new().unwrap();
        let run = |limit: u64, script: &str| {
            call_within(Duration::from_secs(limit), Path::new("/bin/sh"), &["-c", script], dir.path(), "log")
        };
        assert!(run(60, "echo out; echo err >&2").unwrap());
        assert_eq!(std::fs::read_to_string(dir.path().join("log")).unwrap(), "out\nerr\n");
        assert!(!run(0, "exec sleep 60").unwrap());
        let error = run(60, "echo ERROR: no such pin >&2; echo bye; exit 1").unwrap_err().to_string();
        assert_eq!(error, "sh: ERROR: no such pin");
        let error = run(60, "echo Error: passed over; echo ERROR: the end; exit 1").unwrap_err().to_string();
        assert_eq!(error, "sh: ERROR: the end");
    }
}
