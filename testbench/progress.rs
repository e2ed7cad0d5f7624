//! Progress as somebody at a terminal sees it: each phase of a long run has a name, and what is counted has one.

use std::path::Path;
use std::process::{Command, Stdio};

/// What a run shows on a terminal, which the command `script` stands for; nothing without that command.
fn shown(arguments: &str) -> Option<String> {
    let command = format!("{} {arguments} > /dev/null", env!("CARGO_BIN_EXE_efsat"));
    let mut script = Command::new("script");
    script.args(["-q", "-e", "-c", &command, "/dev/null"]).stdin(Stdio::null());
    let output = script.current_dir(Path::new(env!("CARGO_MANIFEST_DIR"))).output().ok()?;
    assert!(output.status.success(), "efsat {arguments}: {output:?}");
    Some(String::from_utf8(output.stdout).unwrap())
}

#[test]
fn phases_and_what_they_count_have_names_on_a_terminal() {
    let runs = [
        ("classify --random 20000 --summary", "answering", "of 20,000 pairs, "),
        ("compare --random 3000", "comparing", "of 3,000 pairs, "),
        ("stress --pairs 2000", "testing", "of 2,000 pairs, "),
        ("scene pairs scenes/gears.toml --summary", "finding pairs", "of 17 poses, "),
        ("scene run scenes/gears.toml --summary --cosim none", "planning", ""),
        ("scene run scenes/gears.toml --summary --cosim none", "answering", "of 17 poses, "),
        ("tree count scenes/gears.toml", "counting", "of 17 poses, "),
        ("self-intersections scenes/m8_bolt.stl", "finding intersections", " triangles, "),
        ("wall", "mapping", " contacts, "),
    ];
    for (arguments, phase, counts) in runs {
        let Some(shown) = shown(arguments) else {
            eprintln!("skipped: the command script is not installed");
            return;
        };
        // One state after the other, each in the place of the one before.
        let states: Vec<&str> = shown.split(['\r', '\n']).map(|state| state.trim_start_matches("\u{1b}[2K")).collect();
        let named = |state: &&str| state.starts_with(phase) && state.contains(counts);
        assert!(states.iter().any(named), "efsat {arguments}: {shown}");
        let nameless =
            states.iter().find(|state| state.chars().any(char::is_numeric) && !state.starts_with(char::is_alphabetic));
        assert_eq!(nameless, None, "efsat {arguments}");
    }
}
