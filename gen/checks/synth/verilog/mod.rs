//! The generated VHDL read back by GHDL and written as Verilog, for tools that read no VHDL.
//!
//! What GHDL infers is checked on the way: a latch, an unbound instance and a signal with two drivers are errors. GHDL
//! 2.0 writes some Verilog wrongly; [`fixes`] mends what efsat's VHDL meets, and finds nothing to do in the Verilog of
//! newer versions.

pub mod fixes;

use super::ToolError;
use crate::process;
use efsat_hardware::tools::{self, Tool};
use efsat_unit::artefact::{FileSet, Scratch, VerilogFile, origin};
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;

/// What GHDL says of hardware that nobody asked for, some of it as a warning only.
const UNWANTED: [&str; 3] = ["latch", "not bound", "multiple assignments"];

/// Finds GHDL; any back end synthesizes.
///
/// # Errors
/// That it is not installed.
pub fn ghdl() -> Result<Tool, ToolError> {
    let missing = ToolError::Missing { tool: "GHDL", install: "apt-get install ghdl-mcode" };
    tools::ghdl(true).ok_or(missing)
}

/// VHDL files (name and text, in dependency order) as one Verilog text, a module an entity. The files are written to
/// `dir`, which is the caller's to keep or to delete.
///
/// # Errors
/// See [`ToolError`].
pub fn from_vhdl(files: &[(String, String)], top: &str, dir: &Path) -> Result<String, ToolError> {
    let ghdl = ghdl()?;
    for (name, text) in files {
        let path = dir.join(name);
        fs::write(&path, text).map_err(ToolError::file(&path))?;
    }
    let refused = |message: String| ToolError::failed(&ghdl.version, message);
    let names = files.iter().map(|(name, _)| name.as_str());
    let mut command = Command::new(&ghdl.path);
    command.args(["--synth", "--std=93c", "--out=verilog"]).args(names).args(["-e", top]).current_dir(dir);
    let output = process::output(&mut command).map_err(|e| refused(e.to_string()))?;
    let said = String::from_utf8_lossy(&output.stderr);
    if let Some(line) = said.lines().find(|line| UNWANTED.iter().any(|what| line.contains(what))) {
        return Err(refused(line.to_owned()));
    }
    if !output.status.success() {
        let line = said.lines().find(|line| line.contains(':')).or(said.lines().next());
        return Err(refused(line.unwrap_or("it failed without a word").to_owned()));
    }
    fixes::all(&String::from_utf8_lossy(&output.stdout))
        .map_err(|reason| refused(format!("Verilog of {top}: {reason}")))
}

/// Verilog files of a set of VHDL files: name and text of each. The same version of GHDL makes the same bytes.
///
/// # Errors
/// See [`ToolError`].
pub fn of_set(set: &FileSet, files: &[VerilogFile]) -> Result<Vec<(String, String)>, ToolError> {
    let version = ghdl()?.version;
    let scratch = Scratch::new().map_err(ToolError::file(&std::env::temp_dir()))?;
    // Nets are numbered through all modules of a run, so a module that was written before is known by its name. Modules of
    // other generics have other names.
    let mut written: BTreeSet<String> = files.iter().filter_map(|file| file.without.clone()).collect();
    let mut texts = vec![];
    for file in files {
        let source = |name: &String| {
            let flat = name.rsplit('/').next().unwrap_or_default();
            (flat.to_owned(), set.get(name).unwrap_or_default().to_owned())
        };
        let sources: Vec<_> = file.sources.iter().map(source).collect();
        let mut text: String = origin().iter().map(|line| format!("// {line}\n")).collect();
        text.push_str(&format!("// {} as Verilog, by {version}.\n", file.top));
        for module in from_vhdl(&sources, &file.top, scratch.path())?.split_inclusive("endmodule\n") {
            if module_name(module).is_some_and(|name| written.insert(name.to_owned())) {
                text.push('\n');
                text.push_str(module.trim_start());
            }
        }
        texts.push((file.name.clone(), text));
    }
    Ok(texts)
}

/// The name of the module that a text begins with.
fn module_name(text: &str) -> Option<&str> {
    text.trim_start().strip_prefix("module ")?.split(|c: char| !c.is_alphanumeric() && c != '_').next()
}

#[cfg(test)]
mod tests {
    use super::*;
    use efsat_hardware::testing;

    const HEAD: &str = "library ieee;\nuse ieee.std_logic_1164.all;\nentity u is port (a, b : in std_logic; q : out std_logic); end;\narchitecture x of u is\n";

    fn read_back(body: &str) -> Result<String, ToolError> {
        let dir = tempfile::TempDir::new().unwrap();
        from_vhdl(&[("u.vhd".to_owned(), format!("{HEAD}{body}\nend;\n"))], "u", dir.path())
    }

    #[test]
    fn unwanted_hardware_is_an_error() {
        if let Err(missing) = ghdl() {
            return testing::skip(missing);
        }
        let refusal = |body: &str| read_back(body).unwrap_err().to_string();
        let latch = "begin\nprocess (a, b) begin if a = '1' then q <= b; end if; end process;";
        assert!(refusal(latch).contains("latch"));
        let drivers = "signal s : std_logic;\nbegin\ns <= a;\ns <= b;\nq <= s;";
        assert!(refusal(drivers).contains("multiple assignments"));
        let unbound = "component k port (a : in std_logic; b : out std_logic); end component;\nbegin\nk1 : k port map (a => a, b => q);";
        assert!(refusal(unbound).contains("not bound"));
        assert!(refusal("begin\nq <= c;").contains("u.vhd:6"));
        assert!(read_back("begin\nq <= a and b;").unwrap().contains("module u"));
    }
}
