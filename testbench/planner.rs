//! Effects: the planned unit of a scene says what the full one says, `efsat scene plan` and `efsat scene run`.

use crate::extent::{full, share};
use crate::tools::program::{command, efsat, object, ran, refuses, succeeds};
use crate::tools::{ghdl, made};
use efsat::collide::hierarchy::{Directions, Scratch};
use efsat::evidence::planner::{Front, Options, Plan, Request, Sampling, TooMany, frame_contacts, plan, run};
use efsat::golden::Golden;
use efsat::host::ReadyScene;
use efsat::host::settings::Settings;
use efsat::pair::Verdict;
use efsat::params::Params;
use efsat::scene::{Near, Scene, load};
use rayon::prelude::*;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The ready scenes.
fn ready() -> Vec<PathBuf> {
    let mut found: Vec<PathBuf> = fs::read_dir(root().join("scenes"))
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == "toml"))
        .collect();
    found.sort();
    assert!(found.len() >= 6);
    found
}

/// Every frame of a short scene, every tenth of a long one.
fn frames(scene: &Scene) -> Vec<usize> {
    let step = if scene.frames() > 100 { 10 } else { 1 };
    (0..scene.frames()).step_by(step).collect()
}

/// The 11 axes, ceilings and so on of the full unit do not stand in the parameters: 17 axis units may.
fn request() -> Request {
    let directions = Directions::of(18).unwrap();
    Request { costs: false, ..Request::new(&Settings::default(), Params::default(), directions) }
}

/// What is wrong about the planned unit, pair by pair: against the full unit and against the exact answer.
fn wrong(scene: &Scene, plan: &Plan) -> Vec<String> {
    let near = Near::by_dops(scene, true, Directions::of(18));
    let full = Params { ..plan.full_params.clone() };
    let stages = [ReadyScene::new(scene, &full), ReadyScene::new(scene, &plan.params)];
    let goldens = [Golden::new(&full), Golden::new(&plan.params)];
    let of_frame = |frame: usize| {
        let mut wrong = vec![];
        for meeting in near.meetings(frame) {
            let mut pairs = vec![];
            near.pieces(&meeting, &mut Scratch::default(), |some| pairs.extend_from_slice(some));
            if pairs.is_empty() {
                continue;
            }
            let posed = [0, 1].map(|unit: usize| stages[unit].posed(&meeting));
            let hosts = [0, 1].map(|unit: usize| posed[unit].host());
            for pair in pairs {
                let exact = posed[0].relation(pair).class;
                let verdicts = [0, 1].map(|unit: usize| {
                    let [a, b] = posed[unit].faces(pair);
                    hosts[unit].pair(a, b).answer(&goldens[unit], &hosts[unit].pose).verdict
                });
                let kept = verdicts[0] == Verdict::PossiblyIncorrect || verdicts[0] == verdicts[1];
                if verdicts.into_iter().any(|verdict| verdict.is_wrong(exact)) || !kept {
                    wrong.push(format!("frame {frame}, pair {pair:?}: {verdicts:?}, exactly {exact}"));
                }
            }
        }
        wrong
    };
    frames(scene).into_par_iter().flat_map_iter(of_frame).collect()
}

#[test]
fn the_planned_unit_says_what_the_full_one_says_on_every_ready_scene() {
    let mut failures = vec![];
    let mut sets = BTreeSet::new();
    for path in share(2, ready()) {
        let scene = load(&path).unwrap();
        let plan = plan(&scene, &request()).unwrap();
        assert_eq!(plan.full_params.axes.count(), 17);
        let tally = plan.planned.tally;
        if (tally.less_definite, tally.contradictions) != (0, 0) || plan.unit_pairs == 0 {
            failures.push(format!("{}: {tally:?}", plan.scene));
        }
        failures.extend(wrong(&scene, &plan).into_iter().take(3).map(|wrong| format!("{}: {wrong}", plan.scene)));
        sets.insert(plan.effects.iter().map(|finding| finding.state).collect::<Vec<_>>());
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    assert!(sets.len() >= if full() { 5 } else { 3 }, "different scenes call for different stages: {sets:?}");
}

/// A unit without stages that are needed is caught by the same check, so the check can fail.
#[test]
fn a_unit_without_a_needed_stage_is_noticed() {
    let scene = load(&root().join("scenes/gears.toml")).unwrap();
    let mut plan = plan(&scene, &request()).unwrap();
    assert!(plan.params.renormalise && wrong(&scene, &plan).is_empty());
    plan.params.renormalise = false;
    assert!(!wrong(&scene, &plan).is_empty());
}

/// A small globe at the pole of a large one, where both have degenerate triangles, and a third one away from both.
const POLES: &str = "name = 's'\n[[object]]\nname = 'p'\nmesh = 'builtin:globe'\n\
    [[object]]\nname = 'q'\nmesh = 'builtin:globe'\nscale = 0.0625\n\
    [[object]]\nname = 'r'\nmesh = 'builtin:plate'\nplaced = { translation = [0, 0, -9] }\n\
    [[pose]]\nobject = 'q'\ntranslation = [0.001, 0, 1.06]\n\
    [[pose]]\nobject = 'q'\ntranslation = [0, 0, 1.0625]\n";

/// The final answer for every pair is the exact one, with or without the stages before the unit.
#[test]
fn contacts_are_those_of_the_exact_test_whatever_is_switched_off() {
    let home = tempfile::tempdir().unwrap();
    let path = home.path().join("s.toml");
    fs::write(&path, POLES).unwrap();
    let scene = load(&path).unwrap();
    let mut counts = BTreeSet::new();
    for switches in share(2, [vec![], vec![0], vec![2], vec![1], vec![3, 4, 5, 6]]) {
        let mut request = request();
        switches.iter().for_each(|effect| request.wishes[*effect] = efsat::evidence::planner::Wish::Off);
        let plan = plan(&scene, &request).unwrap();
        let front = Front::new(&scene, plan.software, request.directions);
        let options = Options { sampling: Sampling::None, exact: true, seed: 1 };
        let total = run(&front, &plan, options, |_, _, _| Ok::<(), TooMany>(())).unwrap();
        assert_eq!((total.sums.wrong, total.sums.contradictions), (0, 0), "without {switches:?}");
        assert!(switches != [2] || total.sums.counts.in_software == 0);
        assert!(!switches.is_empty() || total.sums.counts.in_software > 0);
        counts.insert(total.sums.counts.touching);
    }
    assert_eq!(counts.len(), 1, "{counts:?}");
    assert!(counts.iter().all(|touching| *touching > 100), "{counts:?}");
}

#[test]
fn contacts_of_a_frame_are_retested() {
    let scene = load(&root().join("scenes/plates.toml")).unwrap();
    let plan = plan(&scene, &request()).unwrap();
    let front = Front::new(&scene, plan.software, Directions::of(18).unwrap());
    let contacts = frame_contacts(&front, &plan, 0);
    assert!(contacts.iter().all(|contact| contact.exact.is_some()));
    // One on the other: the two triangles of the lower top and of the upper bottom, at least.
    assert!(contacts.iter().filter(|contact| contact.touches()).count() >= 4);
}

/// A folder with three blocks, one of them with a degenerate triangle, in a scene with further lines.
fn blocks(lines: &str) -> tempfile::TempDir {
    let home = tempfile::tempdir().unwrap();
    let corner = |i: u32| format!("v {} {} {}\n", i & 1, i >> 1 & 1, i >> 2 & 1);
    let faces = "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
    let block: String = (0..8).map(corner).collect::<String>() + faces;
    fs::write(home.path().join("block.obj"), &block).unwrap();
    fs::write(home.path().join("odd.obj"), format!("{block}v 0.5 0 1\nf 5 9 6\n")).unwrap();
    let object = |name: &str, mesh: &str, x: f64| {
        format!("[[object]]\nname = '{name}'\nmesh = '{mesh}'\nplaced = {{ translation = [{x}, 0, 0] }}\n")
    };
    let objects = object("p", "block.obj", 0.0) + &object("q", "odd.obj", 0.75) + &object("r", "block.obj", 9.0);
    fs::write(home.path().join("s.toml"), format!("name = 's'\n{objects}{lines}")).unwrap();
    home
}

/// The findings of a plan by their names.
fn findings(plan: &Value) -> BTreeMap<String, Value> {
    let list = plan["effects"].as_array().unwrap();
    list.iter().map(|finding| (finding["effect"].as_str().unwrap().to_owned(), finding.clone())).collect()
}

/// Two objects that do not meet: the broad phase finds that, and nothing behind it has anything to do.
#[test]
fn what_never_meets_costs_nothing() {
    let home = tempfile::tempdir().unwrap();
    let globes = "name = 'far'\na.mesh = 'builtin:fine_globe'\nb.mesh = 'builtin:fine_globe'\n";
    fs::write(home.path().join("far.toml"), format!("{globes}[[pose]]\ntranslation = [100, 0, 1]\n")).unwrap();
    let plan: Value = serde_json::from_str(&succeeds(home.path(), "scene plan far.toml --json")).unwrap();
    let found = findings(&plan);
    assert_eq!((&found["broad_phase"]["needed"], &found["broad_phase"]["state"]), (&true.into(), &"on".into()));
    for effect in ["hierarchy", "degenerate", "transform", "renormalise", "in_plane_axes", "exact_ceiling"] {
        assert_eq!((&found[effect]["needed"], &found[effect]["state"]), (&false.into(), &"off".into()), "{effect}");
    }
    assert_eq!(plan["unit_pairs"], 0);
}

#[test]
fn plans_name_each_effect_with_its_reason_and_saving() {
    let home =
        blocks("[effects]\nrenormalise = 'off'\nexact_ceiling = 'on'\nallowed = 0.25\n[parameters]\nwidth = 20\n");
    let dir = home.path();
    let plan = object(dir, "scene plan s.toml --json");
    let found = findings(&plan);
    let names =
        ["broad_phase", "degenerate", "exact_ceiling", "hierarchy", "in_plane_axes", "renormalise", "transform"];
    assert_eq!(found.keys().map(String::as_str).collect::<Vec<_>>(), names);
    let state = |name: &str| (found[name]["state"].as_str().unwrap(), found[name]["decided_by"].as_str().unwrap());
    assert_eq!(state("broad_phase"), ("on", "auto"));
    assert_eq!(state("degenerate"), ("on", "auto"));
    assert_eq!((state("renormalise"), state("exact_ceiling")), (("off", "off"), ("on", "on")));
    assert_eq!(state("transform"), ("translate", "auto"));
    assert_eq!(plan["allowed"], 0.25);
    let reason = found["degenerate"]["reason"].as_str().unwrap();
    assert!(reason.starts_with("1 of 37 triangles are degenerate"), "{reason}");
    for name in ["transform", "renormalise", "in_plane_axes", "exact_ceiling"] {
        let saving = &found[name]["saving"];
        assert!(saving["simulation"].as_f64() > Some(0.0), "{name}: {saving}");
        // Without re-normalisation there is no lane that makes the edges one after the other, so it saves time only.
        let what = if name == "renormalise" { "latency" } else { "luts" };
        assert!(saving[what].as_i64() > Some(0), "{name}: {saving}");
    }
    assert_eq!(found["in_plane_axes"]["saving"]["interval"], 6);
    assert_eq!(found["transform"]["saving"]["multipliers"], 12);
    let command = plan["command_line"].as_str().unwrap();
    for words in ["--width 20 ", "--renormalise off ", "--upper sticky ", "--transform translate "] {
        assert!(command.contains(words), "{command}");
    }
    // The command line wins: over parameters and over effects.
    let wins =
        object(dir, "scene plan s.toml --json --width 19 --renormalise on --effect exact_ceiling=off --allowed 0");
    let command = wins["command_line"].as_str().unwrap();
    for words in ["--width 19 ", "--renormalise on ", "--upper implied "] {
        assert!(command.contains(words), "{command}");
    }
    assert_eq!(findings(&wins)["renormalise"]["decided_by"], "option");
    assert_eq!(wins["allowed"], 0.0);
    let paper = object(dir, "scene plan s.toml --json --like-paper --edge-test on");
    let command = paper["command_line"].as_str().unwrap();
    for words in ["--projections all ", "--projection-width rounded ", "--axis-shift 0 ", "--edge-test on "] {
        assert!(command.contains(words), "{command}");
    }
    // As many axis units as the full set has axes, and never more than the planned one has.
    let wide = object(dir, "scene plan s.toml --json --axes-per-clock 17 --effect in_plane_axes=off");
    assert!(wide["command_line"].as_str().unwrap().contains("--axes 11 --axes-per-clock 11 "));
    // The planned unit can be generated.
    let words: Vec<&str> = command.split_whitespace().skip(1).collect();
    succeeds(dir, &format!("{} --out rtl", words.join(" ")));
    // Other commands say that they do not look at these tables.
    let (status, _, errors) = efsat(dir, "scene pairs s.toml");
    assert_eq!(status, Some(0));
    assert!(errors.contains("[effects] and [parameters] are for scene plan and scene run"), "{errors}");
}

#[test]
fn runs_answer_retest_simulate_and_draw() {
    let home = blocks(
        "[[pose]]\nlabel = 'as \"placed\"'\nobject = 'q'\ntranslation = [1, 0, 0]\n[[pose]]\nobject = 'q'\ntranslation = [0.75, 0.5, 0.25]\n",
    );
    let dir = home.path();
    let files = "--csv rows.csv --pairs pairs.csv --picture p.svg --frame 1 --out rtl";
    let report = object(dir, &format!("scene run s.toml --json --simulator builtin {files}"));
    let total = &report["total"];
    let number = |key: &str| total[key].as_u64().unwrap();
    assert_eq!(
        number("separate") + number("intersect") + number("possibly_incorrect") + number("in_software"),
        number("pairs_tested")
    );
    assert!(number("touching") > 0 && number("in_software") > 0);
    assert_eq!((&report["contradictions"], &report["wrong"]), (&Value::from(0), &Value::from(0)));
    let cosim = &report["cosim"];
    assert_eq!((&cosim["mismatches"], &cosim["simulator"]), (&Value::from(0), &Value::from("builtin")));
    assert!(cosim["vectors"].as_u64() >= Some(number("possibly_incorrect")));
    assert_eq!(cosim["close"], cosim["close_simulated"]);
    let every = |cosim: &Value| -> u64 {
        assert_eq!(cosim["every_close"]["mismatches"], 0);
        ["vectors", "host_decided"].map(|key| cosim["every_close"][key].as_u64().unwrap()).iter().sum()
    };
    assert_eq!(every(cosim), cosim["close"].as_u64().unwrap());
    // Rows, pairs and totals fit each other.
    let rows = fs::read_to_string(dir.join("rows.csv")).unwrap();
    assert_eq!(rows, succeeds(dir, "scene run s.toml --cosim none"));
    assert!(rows.lines().nth(1).unwrap().starts_with("0,\"as \"\"placed\"\"\",1,"), "{rows}");
    let pairs = fs::read_to_string(dir.join("pairs.csv")).unwrap();
    assert_eq!(pairs.lines().count() as u64, 1 + number("touching"));
    assert!(pairs.lines().skip(1).all(|line| matches!(line.split(',').nth(6), Some("touch" | "intersect"))), "{pairs}");
    assert!(pairs.contains(",software,") && pairs.contains("\"p\",\"q\","), "{pairs}");
    let svg = fs::read_to_string(dir.join("p.svg")).unwrap();
    assert!(svg.starts_with("<svg ") && svg.ends_with("</svg>\n") && svg.contains("frame 1: pose 1"));
    assert!(dir.join("rtl/manifest.json").is_file());
    // Everything simulated, and nothing.
    let all = object(dir, "scene run s.toml --json --cosim all --simulator builtin");
    let sent = number("pairs_tested") - number("in_software");
    assert_eq!(all["cosim"]["vectors"], sent);
    assert_eq!(object(dir, "scene run s.toml --json --cosim none")["cosim"], Value::Null);
    // A bound on the pairs of interest is none for the built-in simulator.
    let few = object(dir, "scene run s.toml --json --close 1 --simulator builtin");
    assert_eq!((&few["cosim"]["close_simulated"], every(&few["cosim"])), (&1.into(), every(cosim)));
    let output = succeeds(dir, "scene run s.toml --summary --close 1 --simulator builtin");
    assert!(
        output.contains("0 contradictions") && output.contains("all that are possibly incorrect or close"),
        "{output}"
    );
    let left: Vec<_> = fs::read_dir(dir).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(left.len(), 7, "nothing half-written is left: {left:?}");
}

/// The engine finds the pairs that the planned unit and the software find, and draws them.
#[test]
#[ignore = "compiles an engine for a scene: scripts/test full"]
fn runs_are_answered_by_the_engine_too() {
    let home = blocks(
        "[[pose]]\nobject = 'q'\ntranslation = [1, 0, 0]\n[[pose]]\nobject = 'q'\ntranslation = [0.75, 0.5, 0.25]\n\
         [[pose]]\nobject = 'q'\ntranslation = [9, 9, 9]\n",
    );
    let dir = home.path();
    succeeds(dir, "scene run s.toml --cosim none --pairs due.csv");
    let files = "--csv rows.csv --pairs pairs.csv --picture p.svg --view v.html --frame 1";
    let plan = succeeds(dir, "plan-engine s.toml");
    assert!(plan.contains("\nefsat generate --engine") && plan.contains("its limit: "), "{plan}");
    // The engine is pipelined for the part that it is planned for.
    let plan = succeeds(dir, "plan-engine s.toml --device xc7a200t-1");
    assert!(plan.contains(" --device xc7a200t-1 --out engine"), "{plan}");
    refuses(dir, "plan-engine nothing.toml", "nothing.toml: cannot be read");
    let report = object(dir, &format!("scene run s.toml --engine model --json {files}"));
    let exact = |name: &str| -> Vec<String> {
        let text = fs::read_to_string(dir.join(name)).unwrap();
        // Where what touches is; what is undecided and separate another unit may decide.
        let fields = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
        let touching = fields.filter(|fields| fields[6] != "separate");
        let mut pairs: Vec<String> = touching.map(|fields| fields[..5].join(",")).collect();
        pairs.sort_unstable();
        pairs
    };
    assert!(exact("pairs.csv").len() > 10);
    assert_eq!(exact("pairs.csv"), exact("due.csv"));
    let total = &report["total"];
    assert_eq!(total["touching"].as_u64(), Some(exact("due.csv").len() as u64 - 1));
    assert_eq!((&total["queries"], &total["in_software"], &total["clocks"]), (&2.into(), &0.into(), &0.into()));
    let svg = fs::read_to_string(dir.join("p.svg")).unwrap();
    assert!(svg.contains("frame 1: pose 1"));
    assert!(fs::read_to_string(dir.join("v.html")).unwrap().contains("queries to the engine"));
    assert_eq!(fs::read_to_string(dir.join("rows.csv")).unwrap(), succeeds(dir, "scene run s.toml --engine model"));
    // A tree that is too high for the engine, and some of the poses.
    let low = object(dir, "scene run s.toml --engine model --json --tree-height 2 --stack 8");
    assert_eq!((&low["total"]["in_software"], &low["total"]["touching"]), (&2.into(), &total["touching"]));
    let some = succeeds(dir, "scene run s.toml --engine model --frames 1 --frame 2 --picture q.svg");
    assert_eq!(some.lines().count(), 3, "{some}");
    // The same query in the built-in simulator and, without the time that its unit takes at full width, in GHDL.
    let report = object(dir, "cosim --engine --scene s.toml --simulator builtin --json");
    let count = |key: &str| report[key].as_u64().unwrap();
    assert_eq!((count("queries"), count("mismatches")), (2, 0));
    assert!(count("expansions") > 5 && count("leaf_pairs") > 10, "{report}");
    if ghdl().is_some() {
        let small =
            "--width 10 --transform-width 26 --block-lines 16 --triangle-lines 16 --limit 1 --gaps 3 --latency 2-9";
        let report = object(dir, &format!("cosim --engine --scene s.toml --simulator ghdl --json {small}"));
        let counts = ["queries", "mismatches"].map(|key| report[key].as_u64());
        assert_eq!(counts, [Some(1), Some(0)]);
        assert!(
            report["clocks"].as_u64() > Some(100) && report["simulator"].as_str().unwrap().contains("ghdl"),
            "{report}"
        );
    }
    for (options, part) in [
        ("--simulator nvc", "--simulator nvc: expected verilator, ghdl or builtin with --engine"),
        ("--simulator builtin --gaps 1", "--gaps with --engine --simulator builtin: expected verilator or ghdl"),
        ("--simulator builtin --latency 5", "--latency with --engine --simulator builtin: expected verilator or ghdl"),
        ("--simulator builtin --keep k", "--keep with --engine --simulator builtin: expected verilator or ghdl"),
        ("--simulator ghdl --memory block-ram --latency 5", "--latency with --memory block-ram: expected --memory axi"),
    ] {
        refuses(dir, &format!("cosim --engine --scene s.toml {options}"), part);
    }
    // What plans a unit, or needs the engine.
    for (options, part) in [
        ("--engine model --cosim none", "cannot be used with '--cosim <WHICH>'"),
        ("--engine model --effect transform=on", "cannot be used with '--effect"),
        ("--engine model --tag-width 3", "expected no width of the tag with --engine"),
        ("--engine model --method exact --truth snapped --transform-width 26", "expected axes or determinants"),
        ("--engine model --memory block-ram --block-lines 16", "--block-lines 16: expected at least"),
        (
            "--engine model --in-flight 4",
            "--in-flight 4: expected --engine verilator: the option changes the clocks alone",
        ),
        ("--engine model --block-lines 1024", "--block-lines 1024: expected --engine verilator"),
        ("--directions 6", "--directions 6: expected --engine, which has this option"),
        ("--frames 3", "--engine <MACHINE>"),
    ] {
        refuses(dir, &format!("scene run s.toml {options}"), part);
    }
}

/// The whole machine, clock by clock.
#[test]
#[ignore = "compiles the engine for minutes; run by scripts/test full"]
fn runs_are_answered_by_the_simulated_engine() {
    let home = blocks("[[pose]]\nobject = 'q'\ntranslation = [0.75, 0.5, 0.25]\n");
    let dir = home.path();
    let (status, output, errors) = efsat(dir, "scene run s.toml --engine verilator --json");
    let Some(output) = made(if status == Some(0) { Ok(output) } else { Err(errors) }) else { return };
    let report: Value = serde_json::from_str(&output).unwrap();
    assert_eq!((&report["total"]["queries"], &report["mismatches"]), (&1.into(), &0.into()));
    assert!(report["total"]["clocks"].as_u64() > Some(100));
    assert_eq!(report["total"]["touching"], object(dir, "scene run s.toml --json --cosim none")["total"]["touching"]);
}

/// The conclusion comes first, and its commands generate the units that the rest is about.
#[test]
fn plans_begin_with_their_conclusion() {
    let home = blocks("[[pose]]\nobject = 'q'\ntranslation = [0.75, 0.5, 0.25]\n");
    let dir = home.path();
    let plan = object(dir, "scene plan s.toml --json --width 17");
    let text = succeeds(dir, "scene plan s.toml --width 17");
    let open = plan["planned"]["possibly_incorrect"].as_u64().unwrap();
    let first = text.lines().next().unwrap();
    assert!(first.starts_with("s: ") && first.contains(&format!("decides all but {open} (")), "{text}");
    let other = &plan["other"];
    assert_eq!((other["method"].as_str(), &other["contradictions"]), (Some("determinants"), &Value::from(0)));
    let says = format!("{} (", other["possibly_incorrect"]);
    assert!(text.contains("The other method, determinants, leaves") && text.contains(&says), "{text}");
    let commands: Vec<&str> = text.lines().filter_map(|line| line.strip_prefix("  efsat ")).collect();
    let full = [&plan, other].map(|of| of["command_line"].as_str().unwrap().strip_prefix("efsat ").unwrap());
    assert_eq!(commands.len(), 2, "{text}");
    for (short, full) in commands.into_iter().zip(full) {
        assert!(short.len() < full.len(), "{short}");
        let manifests = [short, full].map(|command| {
            let out = tempfile::tempdir().unwrap();
            succeeds(out.path(), &format!("{command} --out out"));
            fs::read_to_string(out.path().join("out/manifest.json")).unwrap()
        });
        assert!(manifests[0] == manifests[1], "{short}");
    }
    // A unit that is too large for its device is said to be.
    let wide = succeeds(dir, "scene plan s.toml --width 32");
    assert!(wide.contains("(more than the device has)") && !text.contains("(more than the device has)"), "{wide}");
    // The other way round: the default axes answer as when they are asked for themselves.
    let turned = object(dir, "scene plan s.toml --json --method determinants");
    let alone = object(dir, "scene run s.toml --json --cosim none --axes 11 --upper implied --renormalise on");
    assert_eq!(turned["other"]["method"], "axes");
    for answer in ["separate", "intersect", "possibly_incorrect"] {
        assert_eq!(turned["other"][answer], alone["total"][answer], "{answer}");
    }
}

/// The page of a scene has every pair that touches or is left open, and what its axes or determinants say fits its verdict.
#[test]
fn pages_of_scenes_have_every_contact() {
    let home = blocks(
        "[[pose]]\nobject = 'q'\ntranslation = [0.75, 0.5, 0.25]\n[[pose]]\nobject = 'q'\ntranslation = [5, 5, 5]\n",
    );
    let dir = home.path();
    for method in ["axes", "determinants"] {
        let run = object(dir, &format!("scene run s.toml --method {method} --json --cosim none --view v.html"));
        let page = fs::read_to_string(dir.join("v.html")).unwrap();
        assert!(page.contains("http-equiv=\"Content-Security-Policy\" content=\"default-src 'none';"));
        let data = page.split_once("id=\"data\">").and_then(|(_, rest)| rest.split_once("</script>")).unwrap().0;
        let data: Value = serde_json::from_str(data).unwrap();
        let frames = data["frames"].as_array().unwrap();
        // Nothing touches in the second pose.
        assert_eq!((frames.len(), &frames[0]["number"]), (1, &Value::from(0)));
        let contacts = frames[0]["contacts"].as_array().unwrap();
        let exact = |contact: &&Value| contact[5] != "separate";
        let number = |key: &str| run["frames"][0][key].as_u64().unwrap() as usize;
        assert_eq!(contacts.iter().filter(exact).count(), number("touching"));
        let kinds = data["kinds"].as_array().unwrap();
        let verdict = |contact: &Value| kinds[contact[0].as_u64().unwrap() as usize]["verdict"].as_str().unwrap();
        for (name, key) in [("intersect", "intersect"), ("possibly incorrect", "possibly_incorrect")] {
            assert_eq!(contacts.iter().filter(|contact| verdict(contact) == name).count(), number(key), "{name}");
        }
        let witnesses = data["witnesses"].as_array().unwrap().len();
        for contact in contacts {
            let Some(says) = contact[6].as_str() else { continue };
            assert_eq!(says.len(), witnesses);
            assert!(says.chars().all(|sign| data["words"].get(sign.to_string()).is_some()), "{contact}");
            if method == "axes" {
                let overlap = says[..11].chars().all(|sign| sign == 'o') || says.ends_with('o');
                assert_eq!((says.contains('s'), overlap), (false, verdict(contact) == "intersect"), "{contact}");
            }
        }
    }
}

#[test]
fn runs_do_not_depend_on_the_number_of_threads() {
    let home = tempfile::tempdir().unwrap();
    let scene = "name = \"s\"\n[a]\nmesh = \"builtin:gear\"\n[b]\nmesh = \"builtin:globe\"\nscale = 4\n\
        [tumble]\nsteps = 6\ndistances = [1.3, 0.4]\n";
    fs::write(home.path().join("s.toml"), scene).unwrap();
    let with = |threads: &str, line: &str| ran(command(&home, line).env("RAYON_NUM_THREADS", threads));
    let run = |threads: &str| {
        let said = share(2, ["json", "summary"]).into_iter().map(|how| {
            let options =
                "--simulator builtin --sample 40 --close 30 --csv r.csv --pairs p.csv --picture p.png --view v.html";
            let said = with(threads, &format!("scene run s.toml --{how} {options}"));
            assert_eq!(said.0, Some(0), "{}", said.2);
            said
        });
        let said: Vec<_> = said.collect();
        let files = ["r.csv", "p.csv", "p.png", "v.html"].map(|name| fs::read(home.path().join(name)).unwrap());
        (said, files)
    };
    assert_eq!(run("1"), run("2"));
    // Plans but for the measured time.
    let plan = |threads: &str| {
        let mut plan: Value = serde_json::from_str(&with(threads, "scene plan s.toml --json").1).unwrap();
        plan["saving"]["simulation"].take();
        for finding in plan["effects"].as_array_mut().unwrap() {
            finding["saving"]["simulation"].take();
        }
        plan
    };
    assert_eq!(plan("1"), plan("2"));
}

#[test]
fn wrong_input_is_named() {
    let cases = [
        ("[effects]\nrenormalise = 'maybe'\n", "", "s.toml:15: 'maybe': expected one of \"auto\", \"on\", \"off\""),
        ("[effects]\n\nfog = 'on'\n", "", "s.toml:16: effect 'fog': expected one of broad_phase, "),
        ("[effects]\nallowed = 2\n", "", "s.toml:15: allowed 2: expected a number from 0 to 1"),
        ("[effects]\nhierarchy = true\n", "", "s.toml:15: true: expected one of"),
        ("[parameters]\ncolour = 3\n", "", "s.toml:15: parameter 'colour': expected one of method, width, "),
        (
            "[parameters]\nmethod = \"determinants\"\n",
            "--effect in_plane_axes=on",
            "effect in_plane_axes: expected --method axes, which has this stage",
        ),
        ("[parameters]\nwidth = 99\n", "", "s.toml:15: "),
        ("[parameters]\nwidth = 2.5\n", "", "s.toml:15: width 2.5: expected a whole number or a word in quotes"),
        ("[parameters]\nrenormalise = 'on'\n[effects]\nrenormalise = 'off'\n", "", "beside the effect 'renormalise'"),
        ("[extra]\n", "", "unknown field `extra`"),
        ("[[object]]\nname = 'z'\nmesh = 'absent.stl'\n", "", "s.toml:16: absent.stl: cannot be read"),
        ("", "--frame 1 --picture p.svg --cosim none", "--frame 1: expected 0 to 0"),
        ("", "--picture p.jpg", "expected a name that ends in .svg or .png"),
        ("", "--view p.svg", "expected a name that ends in .html"),
        ("", "--frame 0", "--picture"),
        ("", "--cosim none --simulator builtin", "--simulator needs --cosim sample or all, not none"),
        ("", "--cosim all --sample 3", "--sample needs --cosim sample, not all"),
        ("", "--csv s.toml", "expected a name that ends in .csv"),
        ("", "--csv r.csv --pairs r.csv", "found twice; expected two different files"),
        ("", "--effect hierarchy=on --effect hierarchy=off", "--effect hierarchy: found twice; expected once"),
        ("", "--effect fog=on", "expected one of broad_phase, "),
        ("", "--effect renormalise=on --renormalise off", "--effect renormalise=on beside --renormalise"),
        ("", "--allowed 1.5", "expected a number from 0 to 1"),
        ("", "--csv absent/rows.csv", "absent/rows.csv: "),
        ("", "--k 7", "expected one of 6, 14, 18, 26"),
    ];
    let mut failures = vec![];
    for (lines, options, expected) in cases {
        let home = blocks(lines);
        let (status, output, errors) = efsat(home.path(), &format!("scene run s.toml {options}"));
        if status != Some(2) || !errors.contains(expected) || errors.lines().count() != 1 || !output.is_empty() {
            failures.push(format!("{lines:?} {options}: {status:?} {errors:?} {output:?}"));
        }
        if fs::read_dir(home.path()).unwrap().count() != 3 {
            failures.push(format!("{lines:?} {options}: files are left"));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}
