//! `efsat accuracy` as others use it: a small sweep end to end, a run that is killed, shards and their merge, a page
//! without network, and one clear line for every error. The models behind it are tested in `gen/studies/accuracy`.

use crate::tools::program::{command, refuses, succeeds};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::time::{Duration, Instant};

/// The built-in meshes in a few poses, so that their pairs are found at once.
const SCENE: &str = "name = \"few poses\"\n[a]\nmesh = \"builtin:headlight\"\n[b]\nmesh = \"builtin:headlight\"\n\
    [tumble]\nsteps = 12\ndistances = [1.45]\ndirection = [0, 0, 1]\n";

/// A sweep of some points over a sample of that scene, with the paper's roundings, which leave pairs undecided.
const SMALL: &str = "accuracy --like-paper --scene few.toml --sweep 'width=12..20/4; width=18; upper=sticky,axes=17; \
    frequency=50; width=12|16,axes-per-clock=2' --pairs 1500 --multipliers 72,144";

/// A folder with that scene.
fn folder() -> tempfile::TempDir {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("few.toml"), SCENE).unwrap();
    dir
}

/// Results of that sweep beside its points: pairs, ladder, floor and causes, the pairs not being counted.
const SCENE_RESULTS: usize = 3;

fn small(dir: &Path, more: &str) -> String {
    succeeds(dir, &format!("{SMALL} {more}"))
}

fn object(text: &str) -> Value {
    serde_json::from_str(text).unwrap()
}

fn number(value: &Value) -> usize {
    value.as_u64().unwrap_or_else(|| panic!("{value} is no count")) as usize
}

/// What was timed, and everything that is reckoned from it or says so.
fn is_timing(name: &str) -> bool {
    let timed = ["retest", "timing", "headline", "at_clock", "at_fastest", "in_budgets", "best_for_time"];
    timed.contains(&name) || name.ends_with("_ns") || name == "ns" || name == "found" || name == "made"
}

/// A value without anything that was timed.
fn untimed(value: &Value) -> Value {
    match value {
        Value::Object(fields) => {
            fields.iter().filter(|(name, _)| !is_timing(name)).map(|(name, v)| (name.clone(), untimed(v))).collect()
        }
        Value::Array(values) => values.iter().map(untimed).collect(),
        other => other.clone(),
    }
}

fn lines(path: &Path) -> usize {
    fs::read_to_string(path).map_or(0, |text| text.lines().count())
}

fn files(dir: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        fs::read_dir(dir).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn a_small_sweep_end_to_end() {
    let dir = folder();
    let found = object(&small(dir.path(), "--out out --json"));
    let out = dir.path().join("out");
    let expected = [
        "accuracy.json",
        "campaign.json",
        "causes.svg",
        "frontier.svg",
        "index.html",
        "points.csv",
        "points.jsonl",
        "share-by-multipliers.svg",
        "share-by-width.svg",
        "time-by-budget.svg",
        "time-by-width.svg",
    ];
    assert_eq!(files(&out), expected);
    let rows = found["rows"].as_array().unwrap();
    let base: Vec<&Value> = rows.iter().filter(|row| row["base"] == true).collect();
    assert!(base.len() == 1 && base[0]["options"]["width"] == "18");
    assert_eq!(number(&found["made"]), rows.len() + SCENE_RESULTS);
    assert_eq!(number(&found["wrong"]), 0);
    for row in rows {
        let answers = &row["answers"];
        let [separate, intersect, open] =
            ["separate", "intersect", "possibly_incorrect"].map(|name| number(&answers[name]));
        assert_eq!((separate + intersect + open, number(&answers["wrong"])), (1500, 0));
        let share = row["possibly_incorrect"]["share"].as_f64().unwrap();
        let bounds = [0, 1].map(|i| row["possibly_incorrect"]["bounds"][i].as_f64().unwrap());
        assert!(bounds[0] <= share && share <= bounds[1] && (share - open as f64 / 1500.0).abs() < 1e-12);
        let [hardware, cost, effective] =
            ["hardware_ns", "cost_ns", "effective_ns"].map(|name| row[name].as_f64().unwrap());
        assert!((hardware + share * cost - effective).abs() < 1e-9);
        let clocks = row["hardware"]["interval"].as_f64().unwrap() / row["hardware"]["clock"].as_f64().unwrap();
        assert!((1000.0 * clocks - hardware).abs() < 1e-9);
    }
    // Wider is never worse on one sample, and the paper's point has the paper's projections.
    let widths = ["12", "16", "18", "20"].map(|width| {
        let fits = |row: &&Value| {
            let is = |name: &str, value: &str| row["options"][name] == value;
            is("width", width)
                && is("axes", "11")
                && is("upper", "implied")
                && is("axes-per-clock", "1")
                && is("frequency", "100")
        };
        number(&rows.iter().find(fits).unwrap()["answers"]["possibly_incorrect"])
    });
    assert!(widths.is_sorted_by(|x, y| x >= y) && widths[0] > 3 * widths[2], "{widths:?}");
    assert_eq!(number(&base[0]["hardware"]["cells"]["multipliers"]), 60);
    // The folding of two axes per clock is there for 144 multipliers, and none for 20 bits in 72.
    let fold = |budget: usize, width: usize| {
        let folds = found["foldings"].as_array().unwrap();
        folds.iter().find(|f| number(&f["budget"]) == budget && number(&f["width"]) == width).unwrap()
    };
    assert_eq!(rows[number(&fold(144, 18)["row"])]["options"]["axes-per-clock"], "2");
    assert!(fold(72, 20)["row"].is_null() && number(&fold(72, 20)["least"]) > 72);
    // The ladder's exact rungs are exact.
    for rung in found["ladder"].as_array().unwrap() {
        let exact = ["predicates", "retest", "retest, batch", "rational"].contains(&rung["name"].as_str().unwrap());
        assert!(
            !exact || [&rung["missed"], &rung["invented"], &rung["undecided"]].iter().all(|n| number(n) == 0),
            "{rung}"
        );
    }
    // Parts of the causes add up.
    let causes = &found["causes"];
    let parts: f64 = causes["stages"].as_array().unwrap().iter().map(|stage| stage["part"].as_f64().unwrap()).sum();
    let genuine: usize = causes["genuine"].as_object().unwrap().values().map(number).sum();
    assert!((parts + genuine as f64 / number(&causes["examined"]) as f64 - 1.0).abs() < 1e-9);
    // The data in the folder are those printed, and CSV has a row per point.
    let kept = object(&fs::read_to_string(out.join("accuracy.json")).unwrap());
    assert_eq!(untimed(&kept["rows"]), untimed(&found["rows"]));
    let csv = fs::read_to_string(out.join("points.csv")).unwrap();
    let columns: Vec<usize> = csv.lines().map(|line| line.split(',').count()).collect();
    assert!(columns.len() == rows.len() + 1 && columns.iter().all(|n| *n == columns[0]), "{columns:?}");
    is_a_page(&out, &found);
}

/// The page is one file that the browser lets load nothing, with the points and the headline of the data.
fn is_a_page(out: &Path, found: &Value) {
    let page = fs::read_to_string(out.join("index.html")).unwrap();
    assert!(page.contains("http-equiv=\"Content-Security-Policy\" content=\"default-src 'none';"));
    for forbidden in [" src=", "@import", "url(", "<link", "<iframe", "fetch(", "XMLHttp"] {
        assert!(!page.contains(forbidden), "the page contains {forbidden}");
    }
    let headline: Vec<&str> = found["headline"].as_array().unwrap().iter().map(|s| s.as_str().unwrap()).collect();
    let escaped = |text: &str| text.replace('\'', "&#39;");
    assert!(headline.len() >= 4 && headline.iter().all(|sentence| page.contains(&escaped(sentence))), "{headline:?}");
    assert!(headline[0].starts_with("From ") && headline[0].contains(" of width "), "{headline:?}");
    let open = 100.0 * found["rows"][0]["possibly_incorrect"]["share"].as_f64().unwrap();
    assert!(headline.iter().any(|sentence| sentence.contains(&format!("{open:.2} %"))), "{open}: {headline:?}");
    let data = page.split_once("id=\"data\">").and_then(|(_, rest)| rest.split_once("</script>")).unwrap().0;
    let shown = object(data);
    let points = shown["scenes"][0]["points"].as_array().unwrap();
    let rows = found["rows"].as_array().unwrap();
    assert_eq!(points.len(), rows.len());
    for (point, row) in points.iter().zip(rows) {
        assert_eq!(point["share"], row["possibly_incorrect"]["share"]);
        let of = |value: &Value| value.as_f64().unwrap();
        let hardware = 1000.0 * of(&point["clocks"]) / of(&point["clock"]);
        let effective = hardware + of(&point["share"]) * of(&point["retest"]);
        assert!((effective - of(&row["effective_ns"])).abs() < 1e-9, "{point} {row}");
    }
    for name in files(out).into_iter().filter(|name| name.ends_with(".svg")) {
        let svg = fs::read_to_string(out.join(&name)).unwrap();
        assert!(
            svg.starts_with("<svg xmlns=") && svg.ends_with("</svg>\n") && !svg.contains("NaN") && !svg.contains("inf"),
            "{name}"
        );
    }
}

/// The page in the repository and everything beside it is what its results make.
#[test]
fn the_page_in_the_repository_is_that_of_its_results() {
    let kept = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/accuracy");
    let dir = tempfile::tempdir().unwrap();
    let scenes = ["headlight", "bolt_nut", "lock_nuts"];
    for scene in scenes {
        fs::create_dir(dir.path().join(scene)).unwrap();
        fs::copy(kept.join(scene).join("accuracy.json"), dir.path().join(scene).join("accuracy.json")).unwrap();
    }
    assert_eq!(
        succeeds(dir.path(), &format!("accuracy page {} --out .", scenes.join(" "))),
        "The page: ./index.html\n"
    );
    assert_eq!(files(dir.path()), files(&kept));
    let same = |name: &str| {
        let [made, kept] = [dir.path(), &kept].map(|folder| fs::read_to_string(folder.join(name)).unwrap());
        assert!(made == kept, "docs/accuracy/{name} is stale: scripts/accuracy page");
    };
    same("index.html");
    for scene in scenes {
        assert_eq!(files(&dir.path().join(scene)), files(&kept.join(scene)));
        files(&kept.join(scene)).iter().for_each(|name| same(&format!("{scene}/{name}")));
    }
}

#[test]
fn a_killed_run_goes_on_where_it_stopped() {
    let dir = folder();
    let arguments = format!("{SMALL} --out out --json");
    let mut child = command(dir.path(), &arguments).stdout(Stdio::null()).spawn().unwrap();
    let store = dir.path().join("out/points.jsonl");
    let begin = Instant::now();
    while lines(&store) < 4 && begin.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(2));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let before = fs::read_to_string(&store).unwrap();
    // What a crash leaves of a line in the making.
    fs::write(&store, format!("{before}{{\"key\":\"0123")).unwrap();
    let whole: Vec<&str> = before.split_inclusive('\n').filter(|line| line.ends_with('\n')).collect();
    let second = object(&small(dir.path(), "--out out --json"));
    let rows = second["rows"].as_array().unwrap().len();
    // One line is that of the pairs, which is no point.
    assert_eq!(
        (number(&second["found"]), number(&second["made"])),
        (whole.len() - 1, rows + SCENE_RESULTS + 1 - whole.len())
    );
    let after = fs::read_to_string(&store).unwrap();
    assert!(after.starts_with(&whole.concat()) && after.lines().count() == rows + SCENE_RESULTS + 1);
    // Once more: nothing is done again, and with another transfer, neither.
    let third = object(&small(dir.path(), "--out out --json --transfer 500"));
    assert_eq!((number(&third["found"]), number(&third["made"])), (rows + SCENE_RESULTS, 0));
    assert_eq!(fs::read_to_string(&store).unwrap(), after);
    let cost = |run: &Value| run["rows"][0]["cost_ns"].as_f64().unwrap();
    assert!((cost(&third) - cost(&second) - 500.0).abs() < 1e-6);
}

#[test]
fn shards_merge_to_the_whole() {
    let dir = folder();
    // Thread counts differ, answers do not.
    let mut whole = command(dir.path(), &format!("{SMALL} --out whole --json"));
    let whole = whole.env("RAYON_NUM_THREADS", "1").output().unwrap();
    let whole = object(&String::from_utf8(whole.stdout).unwrap());
    for part in ["1", "2"] {
        let text = small(dir.path(), &format!("--out {part} --shard {part}/2"));
        assert!(text.starts_with(&format!("{part}: part {part} of 2, ")), "{text}");
        assert_eq!(files(&dir.path().join(part)), ["campaign.json", "points.jsonl"]);
    }
    let merged = object(&succeeds(dir.path(), "accuracy merge 1 2 --out merged --json"));
    assert_eq!(untimed(&merged), untimed(&whole));
    assert!(number(&merged["rows"].as_array().unwrap().len().into()) > 5);
    assert_eq!(files(&dir.path().join("merged")), files(&dir.path().join("whole")));
    // A name with an apostrophe is one word of the command.
    let request = fs::read_to_string(dir.path().join("2/campaign.json")).unwrap();
    let other = request.replace("few.toml", "it's few.toml");
    ["1", "2"].iter().for_each(|part| fs::write(dir.path().join(part).join("campaign.json"), &other).unwrap());
    let quoted = object(&succeeds(dir.path(), "accuracy merge 1 2 --out quoted --json"));
    let command = quoted["command"].as_str().unwrap();
    assert!(command.contains(r"--scene 'it'\''s few.toml' --"), "{command}");
    // A part alone, and parts of different campaigns, are no whole.
    refuses(dir.path(), "accuracy merge 1 --out none", "results are missing, the first is");
    fs::create_dir(dir.path().join("other")).unwrap();
    fs::copy(dir.path().join("2/points.jsonl"), dir.path().join("other/points.jsonl")).unwrap();
    fs::write(dir.path().join("other/campaign.json"), other.replace("\"seed\": 1", "\"seed\": 2")).unwrap();
    refuses(dir.path(), "accuracy merge 1 other --out none", "other: found seed 2, but 1 in 1; expected parts of one");
    assert!(!dir.path().join("none").exists());
}

#[test]
fn wrong_input_is_told_and_leaves_nothing() {
    let dir = tempfile::tempdir().unwrap();
    let foreign: PathBuf = dir.path().join("foreign");
    fs::create_dir(&foreign).unwrap();
    fs::write(foreign.join("thesis.tex"), "mine").unwrap();
    fs::write(dir.path().join("broken.toml"), "name = ").unwrap();
    let cases = [
        ("--sweep width=12..20,hight=3", "--sweep: at character 14: found 'hight'; expected OPTION=VALUES"),
        ("--sweep 'width=12; width=20..12'", "--sweep: at character 17: found '20..12'; expected FIRST..LAST"),
        ("--sweep upper=sticky,width=33", "--sweep: at character 20: invalid value '33' for '--width <N>'"),
        ("--sweep width=24|28,transform-width=26", "expected 28 to 48 (at least --width 28)"),
        ("--scene none.toml", "none.toml"),
        ("--scene broken.toml", "broken.toml"),
        ("--pairs 0", "expected `all` or a whole number"),
        ("--shard 3/2", "expected I/N with I from 1 to N"),
        ("--transfer -1", "expected a number of nanoseconds"),
        ("--multipliers 72,none", "expected a whole number"),
        ("--out foreign", "foreign: found files and no campaign.json; expected a new or empty folder"),
        ("merge foreign --out out", "expected a folder that efsat accuracy wrote"),
        ("page foreign --out .", "foreign/accuracy.json: No such file or directory (os error 2); expected"),
    ];
    for (arguments, part) in cases {
        refuses(&dir, &format!("accuracy {arguments}"), part);
    }
    assert_eq!(files(dir.path()), ["broken.toml", "foreign"]);
    assert_eq!(files(&foreign), ["thesis.tex"]);
}
