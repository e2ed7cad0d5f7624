//! The generated VHDL read back by GHDL and written as Verilog, for tools that read no VHDL.
//!
//! What GHDL infers is checked on the way: a latch, an unbound instance and a signal with two drivers are errors. GHDL
//! 2.0 writes some Verilog wrongly; [`fixes`] mends what efsat's VHDL meets, and finds nothing to do in the Verilog of
//! newer versions.

pub mod fixes;

use std::fs;
use std::path::Path;
use std::process::Command;

/// The GHDL commands there may be; any back end synthesizes.
const GHDLS: [&str; 4] = ["ghdl-mcode", "ghdl-llvm", "ghdl-gcc", "ghdl"];

/// What GHDL says of hardware that nobody asked for, some of it as a warning only.
const UNWANTED: [&str; 3] = ["latch", "not bound", "multiple assignments"];

/// Why there is no Verilog.
#[derive(Debug, thiserror::Error)]
pub enum VerilogError {
    /// GHDL is not installed.
    #[error("GHDL is not installed: apt-get install ghdl-mcode")]
    Missing,
    /// A source cannot be written.
    #[error("{path}: {source}")]
    File {
        /// Which.
        path: String,
        /// Why.
        source: std::io::Error,
    },
    /// GHDL refuses the sources, or infers a latch, an unbound instance or several drivers.
    #[error("{tool}: {message}")]
    Refused {
        /// The GHDL command.
        tool: String,
        /// What it said.
        message: String,
    },
    /// GHDL wrote what cannot be mended.
    #[error("Verilog of {top}: {reason}")]
    Unusable {
        /// The top entity.
        top: String,
        /// What is wrong with it.
        reason: String,
    },
}

/// The GHDL command.
///
/// # Errors
/// That there is none.
pub fn ghdl() -> Result<&'static str, VerilogError> {
    let works = |command: &&str| Command::new(command).arg("--version").output().is_ok_and(|o| o.status.success());
    GHDLS.into_iter().find(works).ok_or(VerilogError::Missing)
}

/// VHDL files (name and text, in dependency order) as one Verilog text, a module an entity. The files are written to
/// `dir`, which is the caller's to keep or to delete.
///
/// # Errors
/// See [`VerilogError`].
pub fn from_vhdl(files: &[(String, String)], top: &str, dir: &Path) -> Result<String, VerilogError> {
    let command = ghdl()?;
    for (name, text) in files {
        let path = dir.join(name);
        fs::write(&path, text).map_err(|source| VerilogError::File { path: path.display().to_string(), source })?;
    }
    let refused = |message: String| VerilogError::Refused { tool: command.to_owned(), message };
    let names = files.iter().map(|(name, _)| name.as_str());
    let output = Command::new(command)
        .args(["--synth", "--std=93c", "--out=verilog"])
        .args(names)
        .args(["-e", top])
        .current_dir(dir)
        .output()
        .map_err(|e| refused(e.to_string()))?;
    let said = String::from_utf8_lossy(&output.stderr);
    if let Some(line) = said.lines().find(|line| UNWANTED.iter().any(|what| line.contains(what))) {
        return Err(refused(line.to_owned()));
    }
    if !output.status.success() {
        let line = said.lines().find(|line| line.contains(':')).or(said.lines().next());
        return Err(refused(line.unwrap_or("it failed without a word").to_owned()));
    }
    fixes::all(&String::from_utf8_lossy(&output.stdout))
        .map_err(|reason| VerilogError::Unusable { top: top.to_owned(), reason })
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEAD: &str = "library ieee;\nuse ieee.std_logic_1164.all;\nentity u is port (a, b : in std_logic; q : out std_logic); end;\narchitecture x of u is\n";

    fn read_back(body: &str) -> Result<String, VerilogError> {
        let dir = tempfile::TempDir::new().unwrap();
        from_vhdl(&[("u.vhd".to_owned(), format!("{HEAD}{body}\nend;\n"))], "u", dir.path())
    }

    #[test]
    fn unwanted_hardware_is_an_error() {
        if ghdl().is_err() {
            return eprintln!("skipped: GHDL is not installed");
        }
        let refusal = |body: &str| read_back(body).unwrap_err().to_string();
        let latch = "begin\nprocess (a, b) begin if a = '1' then q <= b; end if; end process;";
        assert!(refusal(latch).contains("latch"));
        let drivers = "signal s : std_logic;\nbegin\ns <= a;\ns <= b;\nq <= s;";
        assert!(refusal(drivers).contains("multiple assignments"));
        let unbound = "component k port (a : in std_logic; b : out std_logic); end component;\nbegin\nk1 : k port map (a => a, b => q);";
        assert!(refusal(unbound).contains("not bound"));
        assert!(refusal("begin\nq <= c;").contains("u.vhd:5"));
        assert!(read_back("begin\nq <= a and b;").unwrap().contains("module u"));
    }
}
