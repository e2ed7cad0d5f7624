//! Progress as somebody at a terminal sees it: each phase of a long run has a name, and what is counted has one.

use crate::tools::has;
use crate::tools::program::{PROGRAM, ran};
use std::process::{Command, Stdio};

/// What a run shows on a terminal, which the command `script` stands for.
fn shown(arguments: &str) -> String {
    let command = format!("{PROGRAM} {arguments} > /dev/null");
    let mut script = Command::new("script");
    script.args(["-q", "-e", "-c", &command, "/dev/null"]).stdin(Stdio::null());
    let (status, shown, _) = ran(script.current_dir(env!("CARGO_MANIFEST_DIR")));
    assert_eq!(status, Some(0), "efsat {arguments}: {shown}");
    shown
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
    if !has("the command script", "script", "--version") {
        return;
    }
    for (arguments, phase, counts) in runs {
        let shown = shown(arguments);
        // One state after the other, each in the place of the one before.
        let states: Vec<&str> = shown.split(['\r', '\n']).map(|state| state.trim_start_matches("\u{1b}[2K")).collect();
        let named = |state: &&str| state.starts_with(phase) && state.contains(counts);
        assert!(states.iter().any(named), "efsat {arguments}: {shown}");
        let nameless =
            states.iter().find(|state| state.chars().any(char::is_numeric) && !state.starts_with(char::is_alphabetic));
        assert_eq!(nameless, None, "efsat {arguments}");
    }
}
