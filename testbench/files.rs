//! What commands leave in folders: interrupted, twice at the same time, through links, beside files of others.

use crate::tools::program::{PROGRAM, command, efsat, ran, refuses, succeeds};
use std::fs::{self, File, OpenOptions, Permissions};
use std::io::Read;
use std::os::unix::fs::{PermissionsExt, symlink};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Two triangles that cross, beside each other in one frame.
const SCENE: &str = "name = \"s\"\n[a]\nmesh = \"t.obj\"\n[b]\nmesh = \"t.obj\"\n[[pose]]\naxis = [0, 0, 1]\n\
                     angle_degrees = 90\ntranslation = [0.25, 0.25, 0]\n";
const MESH: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0.5\nf 1 2 3\n";

fn names(dir: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        fs::read_dir(dir).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

fn signal(process: u32) {
    assert!(Command::new("kill").args(["-TERM", &process.to_string()]).status().unwrap().success());
}

fn mode(path: &Path) -> u32 {
    fs::metadata(path).unwrap().permissions().mode() & 0o777
}

#[test]
fn an_interruption_leaves_nothing_behind() {
    const RUNS: u32 = 40;
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    let start = Instant::now();
    succeeds(dir, "generate");
    let whole = start.elapsed();
    let mut interrupted = 0;
    for run in 0..RUNS {
        let mut child = command(dir, "generate").stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        std::thread::sleep(whole * run / RUNS);
        signal(child.id());
        interrupted += u32::from(child.wait().unwrap().code() == Some(130));
        assert_eq!(names(dir), ["rtl-out"], "after {run} of {RUNS} parts of the time");
    }
    assert!(interrupted > 0, "no run was interrupted");
    succeeds(dir, "generate --check");
}

#[test]
fn an_interruption_says_what_is_kept() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    let said = |arguments: &str, ready: &dyn Fn() -> bool| {
        let mut child = command(dir, arguments).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
        let start = Instant::now();
        while !ready() && start.elapsed() < Duration::from_secs(60) {
            std::thread::sleep(Duration::from_millis(2));
        }
        signal(child.id());
        let mut said = String::new();
        child.stderr.take().unwrap().read_to_string(&mut said).unwrap();
        assert_eq!(child.wait().unwrap().code(), Some(130), "{arguments}: {said}");
        said
    };
    let soon = Instant::now();
    let later = || soon.elapsed() > Duration::from_millis(300);
    let nothing = "interrupted: nothing is kept but what was printed; the same command begins again\n";
    assert_eq!(said("classify --random 1000000000", &later), nothing);
    let lines = || fs::read_to_string(dir.join("log")).map_or(0, |log| log.lines().count());
    let once = "stress --once --family lattice-5 --log log --pairs";
    let kept = said(&format!("{once} 1000000000"), &|| lines() > 1);
    assert!(kept.starts_with("interrupted: ") && kept.ends_with(" pairs are kept in log; the same command goes on\n"));
    let before = lines();
    succeeds(dir, &format!("{once} 1"));
    assert_eq!(lines(), before, "it went on");
}

#[test]
fn an_interruption_stops_the_simulator() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    let tool = dir.join("nvc");
    // It tells its own process and one that it starts, and never ends.
    let script =
        "#!/bin/sh\ntest \"$1\" = --version && exit\nsleep 600 &\necho $$ $! > told; mv told processes; wait\n";
    fs::write(&tool, script).unwrap();
    fs::set_permissions(&tool, Permissions::from_mode(0o755)).unwrap();
    let path = format!("{}:{}", dir.display(), std::env::var("PATH").unwrap());
    let arguments = "cosim --simulator nvc --random 2 --keep kept";
    let mut child = command(dir, arguments).env("PATH", path).stderr(Stdio::null()).spawn().unwrap();
    let start = Instant::now();
    let patient = || start.elapsed() < Duration::from_secs(60);
    let told = dir.join("kept/processes");
    while !told.exists() && patient() {
        std::thread::sleep(Duration::from_millis(5));
    }
    signal(child.id());
    assert_eq!(child.wait().unwrap().code(), Some(130));
    let processes = fs::read_to_string(told).unwrap();
    // One that has ended and that nobody waits for has no command line any more.
    let lives = |process: &&str| fs::read(format!("/proc/{process}/cmdline")).is_ok_and(|line| !line.is_empty());
    let left = || processes.split_whitespace().filter(lives).map(str::to_owned).collect::<Vec<_>>();
    let soon = Instant::now();
    while !left().is_empty() && soon.elapsed() < Duration::from_secs(5) {
        std::thread::sleep(Duration::from_millis(5));
    }
    let left = left();
    left.iter().for_each(|process| signal(process.parse().unwrap()));
    assert!(left.is_empty(), "processes {left:?} outlive it");
}

#[test]
fn two_runs_of_accuracy_do_not_mix() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    fs::create_dir(dir.join("out")).unwrap();
    let results = dir.join("out/points.jsonl");
    let first = OpenOptions::new().create(true).append(true).open(&results).unwrap();
    first.lock().unwrap();
    let arguments = "accuracy --pairs 100 --sweep width=12 --multipliers 72 --shard 1/1 --out out";
    refuses(dir, arguments, "points.jsonl: found another run that writes it; expected one at a time");
    assert_eq!((names(&dir.join("out")), fs::read(&results).unwrap().len()), (vec!["points.jsonl".to_owned()], 0));
    drop(first);
    succeeds(dir, arguments);
}

#[test]
fn standard_error_that_cannot_be_written_changes_nothing() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    fs::write(dir.join("t.obj"), format!("{MESH}f 1 2 9\n")).unwrap();
    fs::write(dir.join("s.toml"), SCENE).unwrap();
    let status = |arguments: &str| {
        let full = OpenOptions::new().write(true).open("/dev/full").unwrap();
        command(dir, arguments).stdout(Stdio::null()).stderr(full).status().unwrap().code()
    };
    assert_eq!(status("generate --width 5"), Some(2), "an error");
    assert_eq!(status("classify s.toml"), Some(0), "a warning");
}

#[test]
fn outputs_of_a_scene_inside_and_beside_the_design() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    fs::write(dir.join("t.obj"), MESH).unwrap();
    fs::write(dir.join("s.toml"), SCENE).unwrap();
    let before = names(dir);
    symlink(".", dir.join("here")).unwrap();
    let run = |options: &str| format!("scene run s.toml --cosim none {options}");
    for (options, part) in [
        ("--csv x.csv --pairs ./x.csv", "found twice"),
        ("--csv x.csv --pairs here/x.csv", "found twice"),
        ("--csv x.csv --out x.csv", "on the way to --out"),
        ("--csv x.csv --out x.csv/d", "on the way to --out"),
        ("--csv absent/x.csv --out d", "absent/x.csv"),
        ("--csv x.csv --out here", "and no manifest.json of efsat"),
        ("--picture d/dataflow/x.svg --csv d/efsat.csv --pairs d/./efsat.csv --out d", "found twice"),
    ] {
        refuses(dir, &run(options), part);
    }
    fs::remove_file(dir.join("here")).unwrap();
    assert_eq!(names(dir), before, "nothing is written");
    // Twice: to a folder that is not there, and to that of an earlier run.
    for _ in 0..2 {
        succeeds(dir, &run("--out d/ --csv d/x.csv --pairs ./d/y.csv --picture beside.svg"));
        let there = names(&dir.join("d"));
        assert!(["x.csv", "y.csv", "efsat.vhd"].iter().all(|name| there.contains(&(*name).to_owned())), "{there:?}");
        assert!(fs::read_to_string(dir.join("d/x.csv")).unwrap().lines().count() == 2);
    }
    assert_eq!(names(dir), ["beside.svg", "d", "s.toml", "t.obj"]);
    // The contact is one point, which an inset cannot show at any scale: coordinates that no integer holds.
    assert!(!fs::read_to_string(dir.join("beside.svg")).unwrap().contains("922337203685"));
}

/// By whatever name: a link, or a path that goes around.
#[test]
fn no_file_that_is_read_is_written_over() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    fs::write(dir.join("t.obj"), MESH).unwrap();
    fs::write(dir.join("s.toml"), SCENE).unwrap();
    for (link, file) in
        [("l.csv", "t.obj"), ("l.svg", "t.obj"), ("l.html", "t.obj"), ("m.csv", "s.toml"), ("l.obj", "t.obj")]
    {
        symlink(file, dir.join(link)).unwrap();
    }
    let before = names(dir);
    for line in [
        "scene run s.toml --cosim none --csv l.csv",
        "scene run s.toml --cosim none --pairs m.csv",
        "scene run s.toml --cosim none --picture l.svg",
        "scene run s.toml --cosim none --view l.html",
        "scene run s.toml --engine model --csv l.csv",
        "tree query s.toml --out l.obj",
        "tree query s.toml --out q --image ./t.obj",
        "tree build t.obj --out l.obj",
        "tree build builtin:gear --beside l.obj --out t.obj",
        "tree build t.obj --out x --faces l.csv",
        "self-intersections l.obj --csv l.csv",
        "self-intersections t.obj --picture l.svg",
    ] {
        refuses(dir, line, "found twice; expected two different files");
        assert_eq!(names(dir), before, "{line}");
    }
    assert_eq!(fs::read_to_string(dir.join("t.obj")).unwrap(), MESH);
    assert_eq!(fs::read_to_string(dir.join("s.toml")).unwrap(), SCENE);
}

/// The status of a file that cannot be written, whichever command prints.
#[test]
#[cfg(target_os = "linux")]
fn a_full_standard_output_is_no_failed_check() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    fs::write(dir.join("t.obj"), MESH).unwrap();
    fs::write(dir.join("s.toml"), SCENE).unwrap();
    for line in [
        "--help",
        "list options",
        "classify --random 20000",
        "classify --random 9 --json",
        "compare --random 9",
        "scene pairs s.toml",
        "scene plan s.toml",
        "scene run s.toml --cosim none",
        "tree count s.toml",
        "self-intersections t.obj",
        "stress --pairs 9",
        "generate --out rtl",
        "completions bash",
    ] {
        let full = OpenOptions::new().write(true).open("/dev/full").unwrap();
        let output = command(dir, line).stdout(full).output().unwrap();
        let errors = String::from_utf8(output.stderr).unwrap();
        let expected =
            "error: standard output: No space left on device (os error 28); expected one that can be written\n";
        assert_eq!((output.status.code(), errors.as_str()), (Some(2), expected), "efsat {line}");
    }
}

#[test]
fn links_are_followed_and_permissions_stay() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    fs::write(dir.join("t.obj"), MESH).unwrap();
    fs::write(dir.join("s.toml"), SCENE).unwrap();
    fs::create_dir(dir.join("elsewhere")).unwrap();
    for (arguments, name) in [
        ("scene run s.toml --cosim none --csv x.csv", "x.csv"),
        ("generate --unit projection --svg x.svg", "x.svg"),
        ("wall edge-on-face --out .", "edge-on-face.png"),
    ] {
        let target = dir.join("elsewhere").join(name);
        fs::write(&target, "old").unwrap();
        fs::set_permissions(&target, Permissions::from_mode(0o640)).unwrap();
        symlink(&target, dir.join(name)).unwrap();
        succeeds(dir, arguments);
        assert_eq!(fs::read_link(dir.join(name)).unwrap(), target, "{name} is a link still");
        assert!(fs::read(&target).unwrap() != b"old" && mode(&target) == 0o640, "{name}");
    }
    refuses(dir, "generate --unit projection --svg elsewhere", "found a directory");
    symlink("nowhere", dir.join("dangling.svg")).unwrap();
    refuses(dir, "generate --unit projection --svg dangling.svg", "dangling.svg");
}

/// A part of one's own is named by its file without folders, which are the user's, in a word that all tools take.
#[test]
fn a_part_of_ones_own_is_the_same_wherever_it_lies() {
    const PART: &str = "like = 'xc7a200t-1'\nname = 'xc7k325t-2'\nmultipliers = 840\nluts = 203800\nmemory_luts = 64000\n\
        flip_flops = 407600\nblock_rams = 890\n\
        [part]\nfamily = 'Kintex7'\ndevice = 'xc7k325t'\npackage = 'ffg900'\nspeed = '-2'\n";
    let home = tempfile::tempdir().unwrap();
    let [top, parts] = [home.path().to_owned(), home.path().join("parts.own")];
    fs::create_dir(&parts).unwrap();
    fs::write(parts.join("k.325.toml"), PART).unwrap();
    for (options, core) in [("", "efsat-device-k-325"), (" --engine", "efsat-engine-device-k-325")] {
        succeeds(&top, &format!("generate --device parts.own/k.325.toml --out d{options}"));
        succeeds(&parts, &format!("generate --device k.325.toml --out ../d --check{options}"));
        let name =
            fs::read_to_string(top.join(if options.is_empty() { "d/efsat.core" } else { "d/efsat_engine.core" }));
        assert!(name.unwrap().contains(&format!("efsat:core:{core}:")), "{core}");
        fs::remove_dir_all(top.join("d")).unwrap();
    }
    let summary = succeeds(&top, "synth --predict --json --device parts.own/k.325.toml");
    assert!(summary.contains("\"device\":\"xc7k325t-2\""), "{summary}");
}

#[test]
fn a_picture_goes_into_a_pipe() {
    let home = tempfile::tempdir().unwrap();
    let (status, output, errors) = efsat(&home, "generate --unit projection --svg /dev/stdout");
    assert!(status == Some(0) && output.starts_with("<svg"), "{errors}");
    let fifo = home.path().join("pipe.svg");
    assert!(Command::new("mkfifo").arg(&fifo).status().unwrap().success());
    let reader = std::thread::spawn({
        let fifo = fifo.clone();
        move || {
            let mut text = String::new();
            File::open(fifo).unwrap().read_to_string(&mut text).unwrap();
            text
        }
    });
    succeeds(home.path(), "generate --unit projection --svg pipe.svg");
    assert!(reader.join().unwrap().starts_with("<svg"));
}

/// One face many times: the pairs of two such meshes are as many as the square of that.
fn many_times(dir: &Path, times: usize) {
    fs::write(dir.join("many.obj"), MESH.to_owned() + &"f 1 2 3\n".repeat(times - 1)).unwrap();
    fs::write(dir.join("many.toml"), SCENE.replace("t.obj", "many.obj")).unwrap();
}

#[test]
fn memory_does_not_grow_with_the_number_of_pairs() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    many_times(dir, 5000);
    // 25 million pairs take 200 MB as such, and twice that as a list grows.
    let limited = |arguments: &str, part: &str| {
        let script = format!("ulimit -v 250000; exec \"$0\" {arguments}");
        let mut command = Command::new("sh");
        let command = command.args(["-c", &script, PROGRAM]).current_dir(dir).env("RAYON_NUM_THREADS", "2");
        let (status, text, errors) = ran(command);
        assert!(status == Some(0) && text.contains(part), "{arguments}: {text}{errors}");
    };
    limited("scene pairs many.toml --first-hit --json", "\"touching\":1");
    limited("cosim --scene many.toml --limit 3 --simulator builtin --json", "\"vectors\":3");
    limited("self-intersections many.obj", "12497500");
    limited("self-intersections many.obj --width 18", "12497500");
    // So many that they come in pieces, in which none is lost.
    many_times(dir, 300);
    limited("classify many.toml --summary", " 90000   100.00 %");
}

#[test]
fn a_pose_with_too_many_contacts_is_refused() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    many_times(dir, 515);
    let (status, _, errors) = efsat(dir, "scene run many.toml --cosim none --csv x.csv");
    assert!(status == Some(2) && errors.contains("more than 262144 pairs that touch"), "{errors}");
    assert_eq!(names(dir), ["many.obj", "many.toml"], "nothing is left behind");
}
