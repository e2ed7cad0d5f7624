//! Where synthesis tools are found, and how they are run.

use super::ToolError;
use crate::process::{FOREVER, Running};
use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Duration;

/// The environment variable that names a folder of tools, looked into before PATH.
pub const FOLDER: &str = "EFSAT_TOOLS";

/// Where `scripts/setup --synth` puts tools, looked into after PATH.
const INSTALLED: &str = "target/tools/bin";

/// A tool and how it calls itself.
#[derive(Clone, Debug)]
pub struct Tool {
    /// The program.
    pub path: PathBuf,
    /// Its name and version, as it says.
    pub version: String,
}

/// The first of some names under which a tool is installed and answers `option`.
pub fn find(names: &[&str], option: &str) -> Option<Tool> {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let folders = std::env::var_os(FOLDER).map(PathBuf::from).into_iter();
    // Programs run in folders of their own: no relative paths.
    let installed = std::path::absolute(INSTALLED).ok();
    let folders: Vec<PathBuf> = folders.chain(std::env::split_paths(&path)).chain(installed).collect();
    let candidates = folders.iter().flat_map(|folder| names.iter().map(move |name| folder.join(name)));
    candidates.filter(|path| path.is_file()).find_map(|path| {
        let path = std::path::absolute(path).ok()?;
        let output = Command::new(&path).arg(option).output().ok().filter(|o| o.status.success())?;
        // nextpnr tells its version on standard error, and the first start of a WebAssembly build tells other things.
        let said = String::from_utf8_lossy(&output.stdout) + String::from_utf8_lossy(&output.stderr);
        let version = said.lines().find(|line| line.contains(char::is_numeric));
        Some(Tool { version: shorten(version.unwrap_or_default()), path })
    })
}

/// Name and number of a line that tells a version: `Yosys 0.23`, not who compiled it.
fn shorten(line: &str) -> String {
    match line.split_once("(Version ") {
        Some((_, version)) => format!("nextpnr {}", version.trim_end_matches(')').trim_start_matches("nextpnr-")),
        None => line.split_whitespace().take(2).collect::<Vec<_>>().join(" "),
    }
}

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
/// The first error it printed.
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
    let error = said.lines().find(|line| line.contains("ERROR") || line.contains("rror:"));
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
    }

    #[test]
    fn versions_are_short() {
        assert_eq!(shorten("Yosys 0.23 (git sha1 7ce5011c24b)"), "Yosys 0.23");
        let line = "\"nextpnr-ecp5\" -- Next Generation Place and Route (Version nextpnr-0.11.1)";
        assert_eq!(shorten(line), "nextpnr 0.11.1");
    }
}
