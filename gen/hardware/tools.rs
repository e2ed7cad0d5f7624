//! Programs that read what is printed here, and where they are found: GHDL first of all, under the one list of its names.

use std::path::PathBuf;
use std::process::Command;

/// The environment variable that names a folder of tools, looked into before PATH.
pub const FOLDER: &str = "EFSAT_TOOLS";

/// Where `scripts/setup --synth` puts tools, looked into after PATH.
const INSTALLED: &str = "target/tools/bin";

/// The commands of GHDL: the back ends that simulate fastest first.
const GHDLS: [&str; 4] = ["ghdl-llvm", "ghdl-gcc", "ghdl-mcode", "ghdl"];

/// The same, the back end first that compiles fastest.
const QUICK_GHDLS: [&str; 4] = [GHDLS[2], GHDLS[0], GHDLS[1], GHDLS[3]];

/// A tool and how it calls itself.
#[derive(Clone, Debug)]
pub struct Tool {
    /// The program.
    pub path: PathBuf,
    /// Its name and version, as it says.
    pub version: String,
}

impl Tool {
    /// The name of the command.
    #[must_use]
    pub fn name(&self) -> String {
        self.path.file_name().unwrap_or_default().to_string_lossy().into_owned()
    }
}

/// The first of some names under which a tool is installed and answers `option`; in [`FOLDER`], if there is any of them.
#[must_use]
pub fn find(names: &[&str], option: &str) -> Option<Tool> {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let first: Vec<PathBuf> = std::env::var_os(FOLDER).map(PathBuf::from).into_iter().collect();
    let others: Vec<PathBuf> = std::env::split_paths(&path).chain([INSTALLED.into()]).collect();
    let candidates = [first, others].into_iter().flat_map(|folders| {
        names.iter().flat_map(|name| folders.iter().map(move |folder| folder.join(name))).collect::<Vec<_>>()
    });
    candidates.filter(|path| path.is_file()).find_map(|path| {
        // Programs run in folders of their own: no relative paths.
        let path = std::path::absolute(path).ok()?;
        let output = Command::new(&path).arg(option).output().ok().filter(|o| o.status.success())?;
        // nextpnr tells its version on standard error, and the first start of a WebAssembly build tells other things.
        let said = String::from_utf8_lossy(&output.stdout) + String::from_utf8_lossy(&output.stderr);
        let version = said.lines().find(|line| line.contains(char::is_numeric));
        Some(Tool { version: shorten(version.unwrap_or_default()), path })
    })
}

/// GHDL: the back end that simulates fastest, or with `short` the one that compiles fastest.
#[must_use]
pub fn ghdl(short: bool) -> Option<Tool> {
    find(if short { &QUICK_GHDLS } else { &GHDLS }, "--version")
}

/// Name and number of a line that tells a version: `Yosys 0.23`, not who compiled it.
fn shorten(line: &str) -> String {
    match line.split_once("(Version ") {
        Some((_, version)) => format!("nextpnr {}", version.trim_end_matches(')').trim_start_matches("nextpnr-")),
        None => line.split_whitespace().take(2).collect::<Vec<_>>().join(" "),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn versions_are_short() {
        assert_eq!(shorten("Yosys 0.23 (git sha1 7ce5011c24b)"), "Yosys 0.23");
        let line = "\"nextpnr-ecp5\" -- Next Generation Place and Route (Version nextpnr-0.11.1)";
        assert_eq!(shorten(line), "nextpnr 0.11.1");
    }
}
