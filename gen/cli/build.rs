//! The version that `efsat --version` prints: the release and, in a clone of the repository, the commit.

use std::path::Path;
use std::process::Command;

fn main() {
    let release = env!("CARGO_PKG_VERSION");
    let git = |arguments: &[&str]| {
        let output = Command::new("git").args(arguments).output().ok().filter(|output| output.status.success())?;
        Some(String::from_utf8(output.stdout).ok()?.trim().to_owned())
    };
    let mut version = release.to_owned();
    // In a package, or below another repository, the commit would be of something else.
    if let Some(commit) = Path::new("../../.git").exists().then(|| git(&["rev-parse", "--short", "HEAD"])).flatten() {
        version = format!("{release} ({commit})");
        for file in ["HEAD", "logs/HEAD"].iter().filter_map(|name| git(&["rev-parse", "--git-path", name])) {
            println!("cargo::rerun-if-changed={file}");
        }
    }
    println!("cargo::rustc-env=EFSAT_VERSION={version}");
    println!("cargo::rerun-if-changed=build.rs");
}
