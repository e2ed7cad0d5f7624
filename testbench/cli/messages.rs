//! Mistakes on the command line and in input files: one line each, which names what was typed and what was expected.

use super::*;

#[test]
fn every_wrong_value_is_one_line_and_status_2() {
    let home = tempfile::tempdir().unwrap();
    let cases = [
        ("--width 5", "'5' for '--width <N>': expected a whole number from 6 to 32"),
        ("--width 33", "expected a whole number from 6 to 32"),
        ("--width -8", "'-8'"),
        ("--width wide", "'wide' for '--width <N>': expected a whole number from 6 to 32"),
        ("--width 4294967304", "expected a whole number from 6 to 32"),
        ("--int-bits 3", "expected a whole number from 4 to 8"),
        ("--int-bits 9", "expected a whole number from 4 to 8"),
        ("--width 8 --int-bits 7", "--int-bits 7: expected 4 to 6"),
        ("--transform-width 49", "expected a whole number from 6 to 48"),
        ("--transform-width 17", "--transform-width 17: expected 18 to 48"),
        ("--axes 12", "'12' for '--axes <SET>': expected one of 11, 17"),
        ("--axes-per-clock 0", "expected a whole number from 1 to 17"),
        ("--axes-per-clock 12", "--axes-per-clock 12: expected 1 to 11"),
        ("--projections some", "expected one of all, skip, intersect"),
        ("--upper lower", "expected one of implied, sticky"),
        ("--renormalise yes", "expected one of on, off"),
        ("--transform rotate", "expected one of on, translate, off"),
        ("--guard sometimes", "expected one of left-out, always"),
        (
            "--device xc7",
            "expected one of xc2v6000-4, xc6slx150-3, xc7a200t-1, lfe5u-85-6, xc7a100t-1, xc7z020-1, xczu3eg-1, lifcl-40-9",
        ),
        ("--device good.TOML", "lifcl-40-9, or a file NAME.toml of your own"),
        ("--device xc7k325t", "; for another device of the 7 series take xc7a100t-1, or a file NAME.toml of your own"),
        ("--frequency 19", "expected a whole number from 20 to 400"),
        ("--frequency 100.5", "expected a whole number from 20 to 400"),
        ("--tag-width 65", "expected a whole number from 0 to 64"),
        ("--method area", "'area' for '--method <METHOD>': expected one of axes, determinants"),
        ("--span 3", "--span 3: expected --method determinants, which has this option"),
        ("--bound products", "--bound products: expected --method determinants, which has this option"),
        ("--method determinants --span 2", "'2' for '--span <BITS>': expected one of 0, 1, 3"),
        ("--method determinants --upper sticky", "--upper sticky: expected --method axes, which has this option"),
        ("--method determinants --axes 17", "--axes 17: expected --method axes, which has this option"),
        ("--width", "a value is required for '--width <N>'"),
        ("--axes", "expected one of 11, 17"),
        ("--widht 18", "unexpected argument '--widht'"),
        ("--width 18 --width 18", "cannot be used multiple times"),
    ];
    for command in ["generate", "cosim --simulator builtin", "classify --random 1"] {
        for (options, part) in cases {
            fails(home.path(), &format!("{command} {options}"), 2, part);
        }
    }
    let others = [
        ("", "no command: expected one of generate, cosim, classify"),
        ("paint", "unrecognized subcommand 'paint'; expected one of generate, cosim, classify"),
        ("generate more", "unexpected argument 'more'"),
        ("generate --stream-width 48", "expected one of 32, 64, 128"),
        ("generate --device XC7Z020-1", "; for another device of the 7 series take xc7a100t-1"),
        ("synth --predict --device lfe5um-45f", "; for another device of the ECP5 take lfe5u-85-6"),
        ("synth --predict --device LFCPNX-100", "; for another device of Nexus take lifcl-40-9"),
        ("accuracy --method determinants", "--method determinants: expected axes, whose stages the page examines"),
        ("cosim --random 0", "expected a whole number from 1 to 18446744073709551615"),
        ("cosim --random 1000001", "--random 1000001: expected a whole number from 1 to 1000000"),
        ("cosim --seed -1", "expected a whole number from 0 to 18446744073709551615"),
        ("cosim --limit 0", "expected a whole number from 1 to 18446744073709551615"),
        ("cosim --simulator modelsim", "expected one of ghdl, nvc, builtin"),
        ("cosim --random 3 --scene headlight", "cannot be used with"),
        ("cosim --random 3 --limit 2", "cannot be used with"),
        ("cosim --scene headlight --seed 2", "cannot be used with"),
        ("classify", "no pairs: expected one of FILE, --scene FILE and --random N"),
        ("classify - --random 3", "cannot be used with"),
        ("classify - --json --summary", "cannot be used with"),
    ];
    for (arguments, part) in others {
        fails(home.path(), arguments, 2, part);
    }
    assert!(tree(home.path()).is_empty(), "nothing is written");
}

#[test]
fn wrong_input_files_are_one_line_and_status_2() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    let row = csv().lines().next().unwrap().to_owned();
    let mut infinite = raw();
    infinite[144..152].copy_from_slice(&f64::INFINITY.to_le_bytes());
    let files: [(&str, Vec<u8>, &str); 12] = [
        ("empty.csv", vec![], "found no pair"),
        ("header.csv", b"a,b,c\n".to_vec(), "found no pair"),
        ("short.csv", row[..20].into(), "line 1: found"),
        ("long.csv", format!("{row}\n{row},1\n").into(), "line 2: found 19 fields; expected 18"),
        ("nan.csv", format!("{row}\n{}\n", row.replacen('4', "NaN", 1)).into(), "line 2, column 4"),
        ("inf.csv", format!("{row}\n{}\n", row.replacen('4', "1e999", 1)).into(), "found \"1e999\""),
        ("garbage.csv", b"\xff\xfe\x00\n\x01\n\x02".to_vec(), "found 1 field;"),
        ("empty.f64", vec![], "found no pair"),
        ("cut.f64", raw()[..200].into(), "found 200 bytes; expected a multiple of 144"),
        ("inf.f64", infinite, "byte 144 (pair 1, number 1): found inf"),
        ("pairs.txt", row.into(), "found a name ending in .txt; expected .csv or .f64"),
        ("broken.toml", b"name = \n".to_vec(), "broken.toml:1:"),
    ];
    for (name, bytes, part) in files {
        fs::write(dir.join(name), bytes).unwrap();
        fails(dir, &format!("classify {name} --exact"), 2, part);
        fails(dir, &format!("cosim {name} --simulator builtin --keep kept"), 2, part);
    }
    fs::create_dir(dir.join("folder.csv")).unwrap();
    for name in ["absent.csv", "folder.csv", "absent.f64", "absent.toml"] {
        fails(dir, &format!("classify {name}"), 2, name);
    }
    fails(dir, "classify --scene absent.toml", 2, "absent.toml");
    fails(dir, "classify -", 2, "standard input: found no pair");
    assert!(!dir.join("kept").exists());
}

#[test]
fn wrong_targets_are_refused_and_left_alone() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    fs::write(dir.join("file"), "mine").unwrap();
    fs::create_dir(dir.join("thesis")).unwrap();
    fs::write(dir.join("thesis/chapter.tex"), "mine").unwrap();
    fails(dir, "generate --out file", 2, "file: found no directory; expected one, or a name that does not exist yet");
    fails(dir, "generate --out file/below", 2, "file");
    fails(dir, "generate --out thesis", 2, "thesis: found chapter.tex and no manifest.json of efsat");
    fails(dir.join("thesis"), "generate --out ..", 2, "found ");
    fails(dir, "cosim --random 2 --simulator builtin --keep file", 2, "file");
    fails(dir, "cosim --random 2 --simulator builtin --keep thesis", 2, "did not write");
    let files = tree(dir);
    let names: Vec<&str> = files.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["file", "thesis/chapter.tex"]);
    assert!(files.iter().all(|(_, bytes)| bytes == b"mine"));
}

#[test]
fn a_scene_that_is_not_there_is_answered_with_those_that_are() {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    fails(here, "classify --scene gear", 2, "gear: not found: expected one of headlight, scenes/bolt_nut.toml, ");
    let home = tempfile::tempdir().unwrap();
    fails(home.path(), "classify --scene gear", 2, "expected headlight or a file that ends in .toml");
}

#[test]
fn mistakes_about_self_intersections() {
    let dir = tempfile::tempdir().unwrap();
    let expect = |arguments: &str, part: &str| fails(dir.path(), &format!("self-intersections {arguments}"), 2, part);
    expect("absent.stl", "expected a readable file");
    expect("part.txt", "expected .stl, .obj, .ply or .off");
    expect("builtin:teapot", "one of headlight, gear");
    expect("builtin:gear --grid 0", "expected a positive number");
    expect("builtin:gear --grid 1e-30", "expected a coarser grid");
    expect("builtin:gear --width 5", "expected a whole number from 6 to 32");
    expect("builtin:gear --grid 1e-300", "--grid 1e-300: a coordinate has 2^53 units or more");
    expect("builtin:gear --pairs x.f64", "expected a name that ends in .csv");
    expect(
        "builtin:gear --pairs x.csv",
        "--pairs: these are the pairs of the exact unit; expected --grid or --width with it",
    );
    expect("builtin:gear --picture x.txt", "expected a name that ends in .svg or .png");
    expect("builtin:gear --width 18 --csv x.csv --pairs x.csv", "x.csv");
    fs::write(dir.path().join("m.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    expect("m.obj --csv ./m.obj", "found twice; expected two different files");
}

/// What a command that succeeds warns of.
fn warns(dir: &Path, arguments: &str) -> String {
    let (status, _, errors) = efsat(dir, arguments);
    assert_eq!(status, Some(0), "efsat {arguments}");
    errors
}

#[test]
fn what_does_not_fit_is_said() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    let coarse = warns(dir, "self-intersections builtin:gear --grid 1000");
    assert_eq!(coarse, "warning: every triangle is a segment or a point on a grid of 1000; expected a finer --grid\n");
    assert_eq!(warns(dir, "self-intersections builtin:gear"), "");
    assert_eq!(warns(dir, "self-intersections builtin:gear --width 18"), "");
    assert_eq!(warns(dir, "generate --engine --out small"), "");
    let large = "--memory block-ram --block-lines 16384 --triangle-lines 16384";
    let said = warns(dir, &format!("generate --engine --out large {large}"));
    assert_eq!(said, "warning: xc2v6000-4 has 144 block RAMs; the design is predicted to take 842\n");
    let many = warns(dir, "generate --engine --out many --clocks-per-pair 1");
    assert!(many.contains("xc2v6000-4 has 144 multipliers; the design is predicted to take "), "{many}");
    let predicted = |options: &str| object(dir, &format!("synth --predict --engine --json {options}"));
    let block_rams = |options: &str| predicted(options)["block_rams"].clone();
    assert_eq!(block_rams(""), serde_json::json!({"predicted": 74, "capacity": 144}));
    assert_eq!(block_rams(large)["predicted"], 842);
    assert!(succeeds(dir, "synth --predict --engine").contains("74 of 144 (51.4 %) block RAMs of 18 kbit\n"));
}

#[test]
fn errors_name_what_was_typed() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    let says = |arguments: &str, part: &str| fails(dir, arguments, 2, part);
    fs::write(dir.join("pairs.csv"), csv()).unwrap();
    fs::write(dir.join("blanks.csv"), csv().replace(',', " ")).unwrap();
    fs::write(dir.join("empty"), "").unwrap();
    says("classify --method exact --like-paper --random 1", "--like-paper with --method exact: expected --method axes");
    says("tree count pairs.csv", "pairs.csv: found pairs of triangles: expected a scene in TOML");
    // The same of the same file, whoever asks; it is a failed check for the command that checks.
    for (command, status) in [("tree inspect empty", 2), ("tree verify empty", 1)] {
        fails(dir, command, status, "empty: byte 0: end of the file: 0 of 64 bytes; expected a header of 64 bytes");
    }
    says("tree build nofile --out t", "nofile: not found: expected a file that ends in .stl, .obj, .ply or .off");
    says("tree build builtin:gear --beside nofile --out t", "nofile: not found");
    says("generate --unit nope", "--unit nope: expected one of guard_translation");
    says("generate --unit projection", "--unit projection alone: expected --dot FILE or --svg FILE with it");
    says("classify blanks.csv", "blanks.csv: line 1: found blanks between the numbers; expected commas");
    says("classify .", ".: found a directory; expected .csv or .f64 (pairs), .toml (a scene)");
    says("classify empty", "empty: found a name without an ending; expected .csv or .f64 (pairs), .toml (a scene)");
    says(
        "generate --engine --out e --directions 26",
        "--directions 26: expected --offset-bits 4 to 6 with it in the engine",
    );
    says(
        "generate --engine --out e --offset-bits 11",
        "--offset-bits 11: expected 4 to 10 with --directions 18 in the engine",
    );
    says("cosim --engine --method exact", "--truth given: expected snapped with --transform-width 26 in the engine");
    let numbers = "--memory block-ram --block-lines 1024 --block-number-bits 9";
    says(&format!("cosim --engine {numbers}"), "--block-number-bits 9: expected at least 10 for the 1024 blocks");
    says(
        "cosim --engine --block-number-bits 27",
        "--block-number-bits 27: expected at most 26: no more blocks have an address",
    );
    for command in
        ["generate --engine --out -", "generate --out -", "accuracy --out -", "tree build builtin:gear --out -"]
    {
        says(command, "-: expected the name of a ");
    }
    #[cfg(target_os = "linux")]
    {
        std::os::unix::fs::symlink("/dev/zero", dir.join("endless.stl")).unwrap();
        says(
            "tree inspect endless.stl",
            "endless.stl: cannot be read (it is a device); expected an image made by efsat",
        );
        says(
            "tree build endless.stl --out t",
            "endless.stl: cannot be read (it is a device): expected a readable file",
        );
        says("scene plan /dev/zero", "/dev/zero: cannot be read (it is a device): expected a readable TOML file");
        fs::remove_file(dir.join("endless.stl")).unwrap();
        says("generate --out /dev/full", "/dev/full: found no directory; expected one");
        says("stress --pairs 49 --emit /dev/full", "/dev/full: found no directory; expected one");
        let full = "/dev/full: No space left on device (os error 28)";
        assert_eq!(efsat(dir, "self-intersections builtin:gear --csv /dev/full").2, format!("error: {full}\n"));
        says("generate --out /proc/x", "expected files and directories that can be read and written");
    }
    let names: Vec<String> = tree(dir).into_iter().map(|(name, _)| name).collect();
    assert_eq!(names, ["blanks.csv", "empty", "pairs.csv"], "nothing is written");
}

#[test]
fn queries_that_no_engine_takes_are_refused_with_the_reason() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    let says = |arguments: &str, part: &str| fails(dir, arguments, 2, part);
    fs::write(dir.join("empty"), "").unwrap();
    fs::write(dir.join("m.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    succeeds(dir, "tree build m.obj --out m.tree");
    let query = "tree answer m.tree m.tree --pose";
    says(&format!("{query} 1,0,0"), "--pose: found 3 numbers; expected 12, nine of M and three of t");
    says(&format!("{query} 1,0,0,0,1,0,0,0,1,0,0,inf"), "--pose: found inf; expected finite numbers");
    says(&format!("{query} 1,0,0,0,1,0,0,0,2,0,0,0"), "this query: entry 2, 2 of the matrix: 2; expected -1 to 1");
    says(
        &format!("{query} 1,0,0,0,1,0,0,0,1,0,0,0 --directions 14"),
        "image A: another format than the engine's; expected one that was built for it",
    );
    says("tree answer m.tree empty --pose 1,0,0,0,1,0,0,0,1,0,0,0", "empty: byte 0: end of the file: 0 of 64 bytes");
}

#[test]
fn options_of_another_method_are_refused_with_any_value() {
    let home = tempfile::tempdir().unwrap();
    let refused = |arguments: &str, part: &str| fails(home.path(), arguments, 2, part);
    refused("classify --random 1 --span 3", "expected --method determinants, which has this option");
    refused("classify --random 1 --method exact --axes 11", "expected --method axes, which has this option");
    refused("generate --method determinants --upper implied", "expected --method axes, which has this option");
    succeeds(home.path(), "classify --random 1 --method determinants --span 3 --summary");
}

#[test]
fn files_of_another_kind_are_named() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    fs::write(dir.join("semicolons.csv"), csv().replace(',', ";")).unwrap();
    fs::write(dir.join("pairs.csv"), csv()).unwrap();
    fails(dir, "classify semicolons.csv", 2, "line 1: found semicolons between the numbers; expected commas");
    fails(dir, "classify part.stl", 2, "a mesh: a scene file names it");
    fails(dir, "classify --scene pairs.csv", 2, "found pairs of triangles: expected a scene in TOML");
}
