//! What tests have in common: the program, GHDL, netlists clock by clock, and other tools that some need.

pub mod clocked;
pub mod ghdl;
pub mod program;

pub use efsat_hardware::testing::skip;
pub use ghdl::{Ghdl, ghdl, ghdl_of_long_runs};

use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

/// A text with one place of it changed. A place that is not there, or there twice, is a mistake of the test.
pub fn replaced(text: &str, from: &str, to: &str) -> String {
    assert_eq!(text.matches(from).count(), 1, "{from}");
    text.replace(from, to)
}

/// How files in C are compiled: as the standard has it, without a warning, and with a look at every access when they run.
pub const CHECKED: &[&str] = &[
    "-std=c99",
    "-Wall",
    "-Wextra",
    "-pedantic",
    "-Werror",
    "-fsanitize=address,undefined",
    "-fno-sanitize-recover=all",
];

/// Compiles a header alone, as every version of C and C++ has it, with more warnings than users have, all of them errors. Where
/// there is no compiler of C++ this is said.
pub fn compiles_everywhere(header: &Path) {
    let strict = ["-Wconversion", "-Wsign-conversion", "-Wshadow"];
    let versions = |compiler, language, versions: &[u32]| {
        let standard = |version: &u32| (compiler, language, format!("-std={language}{version:02}"));
        versions.iter().map(standard).collect::<Vec<_>>()
    };
    let c = versions("cc", "c", &[99, 11, 17]);
    let cpp = versions("c++", "c++", &[98, 11, 14, 17, 20]);
    let compiled = if has("a compiler of C++", "c++", "--version") { [c, cpp].concat() } else { c };
    for (compiler, language, standard) in compiled {
        let mut command = Command::new(compiler);
        command.args(["-x", language, &standard, "-fsyntax-only", "-Wall", "-Wextra", "-pedantic", "-Werror"]);
        // A header that is compiled by itself would be warned of; this is all there is to the file.
        let include = format!("#include \"{}\"\n", header.display());
        let mut child = command.args(strict).arg("-").stdin(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        child.stdin.take().unwrap().write_all(include.as_bytes()).unwrap();
        let output = child.wait_with_output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{compiler} {standard} {}:\n{said}", header.display());
    }
}

/// Runs a program in a folder; what it says, if it succeeds.
pub fn run(dir: &Path, program: &str, arguments: &[&str]) -> String {
    let (status, output, errors) = program::ran(Command::new(program).args(arguments).current_dir(dir));
    assert_eq!(status, Some(0), "{program} {arguments:?}: {output}{errors}");
    output + &errors
}

/// Whether a tool is installed, so that its command takes an option; where it is not, this is said.
pub fn has(tool: &str, command: &str, option: &str) -> bool {
    let found = Command::new(command).arg(option).output().is_ok_and(|output| output.status.success());
    if !found {
        skip(format!("{tool} is not installed"));
    }
    found
}

/// What tools have made; none where one is not installed, which is said.
pub fn made<T, E: std::fmt::Display>(made: Result<T, E>) -> Option<T> {
    match made {
        Err(error) if error.to_string().contains("is not installed") => {
            skip(error.to_string().trim_start_matches("error: ").trim_end());
            None
        }
        made => Some(made.unwrap_or_else(|error| panic!("{error}"))),
    }
}

fn script(path: &Path, text: &str) {
    std::fs::write(path, text).unwrap();
    std::fs::set_permissions(path, std::os::unix::fs::PermissionsExt::from_mode(0o755)).unwrap();
}

/// The last line of `scripts/test` only filters what cargo says, which stands for it here.
#[test]
fn the_last_line_of_all_tests_counts_what_was_skipped() {
    let home = tempfile::tempdir().unwrap();
    let path = format!("{}:{}", home.path().display(), std::env::var("PATH").unwrap());
    let last = |said: &str, ends: u32| {
        script(&home.path().join("cargo"), &format!("#!/bin/sh\ncat <<'END'\n{said}END\nexit {ends}\n"));
        let (status, output, _) = program::ran(Command::new("scripts/test").args(["only", "a::"]).env("PATH", &path));
        (status, output.lines().last().unwrap_or_default().to_owned())
    };
    let results = "test result: ok. 30 passed; 0 failed; 2 ignored\ntest result: ok. 12 passed; 0 failed; 0 ignored\n";
    assert_eq!(last(results, 0), (Some(0), "42 passed, 0 failed".to_owned()));
    let skips = "skipped: a::b: GHDL is not installed: apt-get install ghdl\ntest a::c ... skipped: a::c: Yosys is not installed\n\
                 skipped: a::b: a compiler of C++ is not installed\n";
    let line = "40 passed, 0 failed, 2 skipped in whole or in part (not installed: GHDL, Yosys, a compiler of C++)";
    assert_eq!(last(&[skips, results].concat(), 0), (Some(0), line.to_owned()));
    assert_eq!(last("test result: FAILED. 3 passed; 1 failed;\n", 101), (Some(1), "3 passed, 1 failed".to_owned()));
    assert_eq!(last("error: could not compile\n", 101), (Some(1), "0 passed, 1 failed".to_owned()));
}

/// Two runs would unpack the same folders, so the second waits for the first.
#[test]
fn one_run_of_the_set_up_waits_for_the_other() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    let (scripts, tools, log) = (dir.join("scripts"), dir.join("tools"), dir.join("log"));
    std::fs::create_dir(&scripts).unwrap();
    std::fs::create_dir(&tools).unwrap();
    for script in ["setup", "unpack"] {
        std::fs::copy(format!("scripts/{script}"), scripts.join(script)).unwrap();
    }
    for found in ["bash", "dirname", "flock", "head", "id", "mkdir", "sleep"] {
        let path = ["/usr/bin", "/bin"].map(|folder| format!("{folder}/{found}"));
        let Some(path) = path.iter().find(|path| std::path::Path::new(path).exists()) else {
            return skip(format!("{found} is not installed"));
        };
        std::os::unix::fs::symlink(path, tools.join(found)).unwrap();
    }
    let tool = |name: &str, text: &str| script(&tools.join(name), &format!("#!{}/bash\n{text}\n", tools.display()));
    for name in ["ghdl-llvm", "ghdl-mcode", "verilator", "g++", "make"] {
        tool(name, ":");
    }
    // What a run starts while it has its turn. Without a way to nextpnr it fails after that.
    tool("yosys", &format!("echo begins >>'{0}'; sleep 0.2; echo ends >>'{0}'", log.display()));
    tool("python3", "exit 1");
    let run = || {
        let mut setup = Command::new(tools.join("bash"));
        setup.arg(scripts.join("setup")).arg("--synth").env("PATH", &tools).output().unwrap()
    };
    let outputs = std::thread::scope(|scope| [(); 2].map(|()| scope.spawn(run)).map(|run| run.join().unwrap()));
    for output in outputs {
        assert_eq!(output.status.code(), Some(1));
        let errors = String::from_utf8(output.stderr).unwrap();
        assert!(errors.contains("could not be installed into target/tools"), "{errors}");
    }
    assert_eq!(std::fs::read_to_string(log).unwrap(), "begins\nends\n".repeat(2));
}
