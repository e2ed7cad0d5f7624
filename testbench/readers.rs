//! Every reader of files, shown files that are nearly right: valid ones with a few small changes, many of which pass the
//! first checks. No reader may panic, take memory without bound, or refuse a file in other words than one line that names
//! it; what a reader accepts, the code behind it must be able to use.
//!
//! `EFSAT_ROUNDS=N` asks for N changed files of every kind in place of 80, or 300 with `EFSAT_TESTS=full` ([the campaign](../docs/evidence.md)).
//! The changes depend on the number of the round alone.

use crate::extent::full;
use crate::tools::program::{efsat, succeeds};
use efsat::artefact::FileSet;
use efsat::evidence::accuracy::{self, Results, Store};
use efsat::evidence::stress::once::{Log, Once, Tally};
use efsat::evidence::{stress, times};
use efsat::golden::Golden;
use efsat::host::settings::Settings;
use efsat::host::{Host, ReadyScene, loose_pair};
use efsat::pair::Pose;
use efsat::params::{Method, Params};
use efsat::{exact, mesh, pair_file, scene};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use serde_json::Value;
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::process::Command;
use std::sync::LazyLock;

mod words;

/// Bytes that a reader may take, besides what the test program itself has: in kilobytes, as `ulimit -v` counts.
const MEMORY: u64 = 3_000_000;

/// The campaign ends by then, or some reader does not.
const SECONDS: u64 = 3600;

/// What stands in place of a number, a word or a value.
const HOSTILE: [&str; 28] = [
    "0",
    "-0",
    "-1",
    "1",
    "2",
    "3",
    "1e308",
    "-1e308",
    "1e-320",
    "1e999",
    "nan",
    "inf",
    "-inf",
    "4294967295",
    "4294967296",
    "-2147483649",
    "9223372036854775807",
    "18446744073709551616",
    "0.1",
    "1e-9",
    "",
    "x",
    "\"\"",
    "[]",
    "{}",
    "true",
    "99999",
    "1e154",
];

/// A kind of file: its name, examples, and what reads it and uses what was read. The error of a file that is refused.
struct Reader {
    name: &'static str,
    examples: Vec<Vec<u8>>,
    read: fn(&Path) -> Result<(), String>,
}

fn changed(reader: &Reader, round: u64) -> Vec<u8> {
    let mut rng = ChaCha8Rng::seed_from_u64(round);
    let example = &reader.examples[rng.random_range(0..reader.examples.len())];
    if reader.name.ends_with(".json") || reader.name.ends_with(".jsonl") || reader.name == "log" {
        return changed_json(example, &mut rng);
    }
    let mut bytes = example.clone();
    for _ in 0..rng.random_range(1..=3) {
        if bytes.is_ascii() && !bytes.is_empty() && rng.random_range(0..4) > 0 {
            bytes = changed_text(std::str::from_utf8(&bytes).unwrap(), &mut rng).into_bytes();
        } else {
            change_bytes(&mut bytes, &mut rng);
        }
    }
    bytes
}

/// Words and lines replaced, left out, repeated and exchanged.
fn changed_text(text: &str, rng: &mut ChaCha8Rng) -> String {
    let is_word = |c: char| c.is_ascii_alphanumeric() || "+-._\"".contains(c);
    if rng.random_range(0..2) == 0 {
        let mut words: Vec<(usize, usize)> = vec![];
        let mut start = None;
        for (at, c) in text.char_indices().chain([(text.len(), ' ')]) {
            match (start, is_word(c)) {
                (None, true) => start = Some(at),
                (Some(begin), false) => {
                    words.push((begin, at));
                    start = None;
                }
                _ => {}
            }
        }
        if words.is_empty() {
            return text.to_owned();
        }
        let (begin, end) = words[rng.random_range(0..words.len())];
        let other = words[rng.random_range(0..words.len())];
        let new = match rng.random_range(0..3) {
            0 => &text[other.0..other.1],
            _ => HOSTILE[rng.random_range(0..HOSTILE.len())],
        };
        return [&text[..begin], new, &text[end..]].concat();
    }
    let mut lines: Vec<&str> = text.split_inclusive('\n').collect();
    let (at, other) = (rng.random_range(0..lines.len()), rng.random_range(0..lines.len()));
    match rng.random_range(0..4) {
        0 => drop(lines.remove(at)),
        1 => lines.insert(at, lines[other]),
        2 => lines.swap(at, other),
        _ => lines.truncate(at + 1),
    }
    lines.concat()
}

fn change_bytes(bytes: &mut Vec<u8>, rng: &mut ChaCha8Rng) {
    let at = rng.random_range(0..=bytes.len());
    match rng.random_range(0..5) {
        0 => bytes.truncate(at),
        1 => bytes.insert(at, rng.random_range(0..=255)),
        2 if at < bytes.len() => bytes[at] ^= 1 << rng.random_range(0..8),
        // Counts and coordinates of binary files.
        3 if at + 4 <= bytes.len() => {
            let word = [0, 1, u32::MAX, 1 << 31, f32::NAN.to_bits(), f32::MAX.to_bits()][rng.random_range(0..6)];
            bytes[at..at + 4].copy_from_slice(&word.to_le_bytes());
        }
        _ if at < bytes.len() => drop(bytes.remove(at)),
        _ => {}
    }
}

/// A line whose values are changed, so that it stays JSON; or, now and then, bytes.
fn changed_json(example: &[u8], rng: &mut ChaCha8Rng) -> Vec<u8> {
    let text = std::str::from_utf8(example).unwrap();
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    let at = rng.random_range(0..lines.len());
    for _ in 0..rng.random_range(1..=3) {
        let mut value: Value = serde_json::from_str(&lines[at]).unwrap();
        change_value(&mut value, rng);
        lines[at] = value.to_string();
    }
    let whole = lines.join("\n") + "\n";
    if rng.random_range(0..8) == 0 {
        let mut bytes = whole.into_bytes();
        change_bytes(&mut bytes, rng);
        return bytes;
    }
    whole.into_bytes()
}

/// Changes one value, found by going down at random.
fn change_value(value: &mut Value, rng: &mut ChaCha8Rng) {
    let stop = rng.random_range(0..12) == 0;
    match value {
        Value::Array(list) if !list.is_empty() => {
            let at = rng.random_range(0..list.len());
            match rng.random_range(0..10) {
                0 => list.truncate(at),
                1 => drop(list.remove(at)),
                2 => list.push(list[at].clone()),
                _ => change_value(&mut list[at], rng),
            }
        }
        Value::Object(map) if !map.is_empty() && !stop => {
            let at = rng.random_range(0..map.len());
            let key = map.keys().nth(at).unwrap().clone();
            change_value(&mut map[&key], rng);
        }
        Value::String(text) => *text = HOSTILE[rng.random_range(0..HOSTILE.len())].to_owned(),
        _ => {
            let hostile = HOSTILE[rng.random_range(0..HOSTILE.len())];
            *value = serde_json::from_str(hostile).unwrap_or(Value::Null);
        }
    }
}

fn text(error: impl std::fmt::Display) -> String {
    error.to_string()
}

fn read_pairs(path: &Path) -> Result<(), String> {
    let pairs = pair_file::read(path.to_str().unwrap()).map_err(text)?;
    for params in [Params::default(), Params::of(Method::Determinants), Params::of(Method::Exact)] {
        let (golden, pose) = (Golden::new(&params), Pose::identity(&params));
        for points in pairs.iter().take(4) {
            if let Host::Unit(pair) = loose_pair(points, &params).unwrap() {
                golden.verdict(&pose, &pair);
            }
            exact::pair(points).unwrap();
        }
    }
    Ok(())
}

fn read_mesh(path: &Path) -> Result<(), String> {
    let read = mesh::read(path).map_err(text);
    let (mesh, findings) = mesh::survey(path).map_err(text)?;
    assert!(!mesh.faces().is_empty() && (read.is_err() == (findings.left_out() > 0)), "{findings}");
    let finite = mesh.vertices().iter().all(|vertex| vertex.iter().all(|x| x.is_finite()));
    assert!(finite && mesh.faces().iter().flatten().all(|vertex| (*vertex as usize) < mesh.vertices().len()));
    efsat::collide::Tree::new(&mesh);
    if let Some(grid) = mesh::Snapped::finest(&mesh, 131_071.0)
        && mesh::Snapped::most(&mesh) / grid < 2f64.powi(53)
    {
        mesh::Snapped::new(&mesh, grid);
    }
    Ok(())
}

fn read_scene(path: &Path) -> Result<(), String> {
    let scene = scene::load(path).map_err(text)?;
    Settings::of(&scene, path).map_err(text)?;
    let params = Params::default();
    let stage = ReadyScene::new(&scene, &params);
    let golden = Golden::new(&params);
    for frame in [0, scene.frames() / 2, scene.frames() - 1] {
        for meeting in stage.near.meetings(frame).iter().take(3) {
            let posed = stage.posed(meeting);
            let host = posed.host();
            for pair in stage.near.pairs(meeting).into_iter().take(3) {
                let [a, b] = posed.faces(pair);
                if let Host::Unit(unit) = host.pair(a, b) {
                    golden.verdict(&host.pose, &unit);
                }
                posed.relation(pair);
            }
        }
    }
    Ok(())
}

fn read_manifest(path: &Path) -> Result<(), String> {
    // A folder beside it that has this manifest, and a file of somebody.
    let dir = path.parent().unwrap().join("folder");
    fs::create_dir_all(dir.join("ise")).unwrap();
    fs::copy(path, dir.join("manifest.json")).unwrap();
    fs::write(dir.join("ise/notes"), "mine").unwrap();
    let written = FileSet::default().write(&dir).map_err(text);
    assert_eq!(fs::read_to_string(dir.join("ise/notes")).unwrap(), "mine");
    written.map_err(|e| e.replace("folder", "manifest.json"))
}

fn read_results(path: &Path) -> Result<(), String> {
    let results = Results::read(&fs::read_to_string(path).unwrap_or_default()).map_err(named)?;
    accuracy::files(&results);
    accuracy::page(&[results]);
    Ok(())
}

fn read_store(path: &Path) -> Result<(), String> {
    let store = Store::open(path.parent().unwrap()).map_err(text)?;
    store.records().count();
    Ok(())
}

/// By the program, which alone joins parts.
fn read_request(path: &Path) -> Result<(), String> {
    let dir = path.parent().unwrap();
    fs::write(dir.join("points.jsonl"), &CAMPAIGN[1]).unwrap();
    let (status, _, errors) = efsat(dir, "accuracy merge . --out whole");
    let whole = dir.join("whole/index.html");
    match status {
        Some(0) if whole.exists() => Ok(()),
        Some(2) if !whole.exists() => Err(errors.trim_end().to_owned()),
        _ => panic!("{status:?}: {errors}"),
    }
}

fn read_log(path: &Path) -> Result<(), String> {
    let params = Params { width: 12, ..Params::default() };
    let family = stress::FAMILIES.iter().filter(|family| family.name == "lattice-5").collect();
    let once = Once::new(7, family, &[params]);
    let log = Log::open(path, "q".to_owned(), |block| once.fits(block)).map_err(text)?;
    let mut total = Tally::default();
    log.blocks().values().for_each(|block| total.add(&block.total()));
    total.truths.total();
    Ok(())
}

fn read_times(path: &Path) -> Result<(), String> {
    times::plot(&fs::read_to_string(path).unwrap_or_default()).map(drop).map_err(|e| format!("times.csv: {e}"))
}

/// The command line puts the name of the file before it.
fn named(error: impl std::fmt::Display) -> String {
    format!("accuracy.json: {error}")
}

const ROW: &str = "0,0,0, 4,0,0, 0,4,0, 1,1,-1, 1.25,1.5,1, 2,0.75,1.5\n";
const OBJ: &str =
    "# a mesh\nv 0 0 0\nv 1 0 0 1\nv 0 1 0.5 0.1 0.2 0.3\nv 1 1 1\nvt 0 0\nf 1 2 3\nf 1/1 -3//2 3/1/1 4\n";
const STL: &str = "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0.5\nendloop\nendfacet\n\
                   endsolid s\n";
const PLY: &str = "ply\nformat ascii 1.0\ncomment c\nelement vertex 4\nproperty float x\nproperty double y\nproperty float z\n\
                   property uchar red\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n\
                   0 0 0 9\n1 0 0 9\n0 1 0.5 9\n1 1 1 9\n3 0 1 2\n4 0 1 3 2\n";
const OFF: &str = "OFF # c\n5 3 0\n0 0 0\n4 0 0\n4 4 0\n1 1 0\n0 4 1e-3\n5 0 1 2 3 4 255 0 0\n3 0 1 2\n4 0 1 2 3\n";

const SCENE: &str = "name = \"s\"\nunit = \"mm\"\n[[object]]\nname = \"a\"\nmesh = \"t.obj\"\nscale = 2.5\n[[object]]\nname = \"b\"\n\
                     mesh = \"builtin:plate\"\nunit = \"cm\"\n[object.placed]\naxis = [0, 0, 1]\nangle_degrees = 30\n\
                     translation = [0.5, 0, 0]\n[tumble]\nsteps = 4\ndistances = [1.5, 1.4]\ndirection = [1, 0, 0]\n[[pose]]\n\
                     quaternion = [1, 0, 0, 0.5]\nabout = [1, 2, 3]\n[[pose]]\nmatrix = [1, 0, 0, 0, 1, 0, 0, 0, 1]\n\
                     [[trajectory]]\nframes = 5\n[[trajectory.track]]\nobject = \"b\"\n[[trajectory.track.key]]\ntime = 0\n\
                     [[trajectory.track.key]]\ntime = 1.5\naxis = [0, 1, 0]\nangle_degrees = 90\ntranslation = [1, 2, 3]\n\
                     [effects]\nrenormalise = \"on\"\nguard = \"auto\"\n[parameters]\nwidth = 16\n";

const TIMES: &str =
    "series,distance,queries,microseconds\nFCL,0,12,1.5\nFCL,0.25,3,2\nengine,0,12,0.5\nengine,1.5,1,9.25\n";

fn binary_stl() -> Vec<u8> {
    let mut bytes = vec![b' '; 80];
    bytes.extend(2u32.to_le_bytes());
    for triangle in 0..2 {
        let numbers = [0., 0., 1., 0., 0., 0., 1., 0., 0., 0., 1., triangle as f32];
        bytes.extend(numbers.iter().flat_map(|x: &f32| x.to_le_bytes()));
        bytes.extend([0, 0]);
    }
    bytes
}

fn binary_ply(big: bool) -> Vec<u8> {
    let (header, _) = PLY.split_once("0 0 0 9").unwrap();
    let format = if big { "binary_big_endian" } else { "binary_little_endian" };
    let mut bytes = header.replace("ascii", format).into_bytes();
    let order = |mut bytes: Vec<u8>| {
        if big {
            bytes.reverse();
        }
        bytes
    };
    for [x, y, z] in [[0.0f32, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.5], [1.0; 3]] {
        bytes.extend(order(x.to_le_bytes().to_vec()));
        bytes.extend(order(f64::from(y).to_le_bytes().to_vec()));
        bytes.extend(order(z.to_le_bytes().to_vec()));
        bytes.push(9);
    }
    for face in [&[0u32, 1, 2][..], &[0, 1, 3, 2]] {
        bytes.push(face.len() as u8);
        face.iter().for_each(|corner| bytes.extend(order(corner.to_le_bytes().to_vec())));
    }
    bytes
}

/// The results in the repository, with fewer rows.
fn results() -> Vec<u8> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/accuracy/headlight/accuracy.json");
    let mut value: Value = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    value["rows"].as_array_mut().unwrap().truncate(24);
    // Foldings name rows by their places.
    value["foldings"].as_array_mut().unwrap().retain(|fold| fold["row"].as_u64().is_none_or(|row| row < 24));
    value.to_string().into_bytes()
}

fn manifest() -> Vec<u8> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("rtl-out/axes/manifest.json");
    let value: Value = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    value.to_string().into_bytes()
}

/// A log as the program writes it: one block.
fn log() -> Vec<u8> {
    let home = tempfile::tempdir().unwrap();
    let path = home.path().join("log");
    succeeds(&home, "stress --once --family lattice-5 --seed 7 --width 12 --pairs 32768 --log log");
    let text = fs::read_to_string(path).unwrap();
    let mut line: Value = serde_json::from_str(text.lines().next().unwrap()).unwrap();
    line["question"] = "q".into();
    format!("{line}\n").into_bytes()
}

/// What was asked for, and the results, of a small campaign.
static CAMPAIGN: LazyLock<[Vec<u8>; 2]> = LazyLock::new(|| {
    let home = tempfile::tempdir().unwrap();
    succeeds(&home, "accuracy --pairs 50 --sweep width=12 --multipliers 72 --shard 1/1 --out out");
    ["campaign.json", "points.jsonl"].map(|name| fs::read(home.path().join("out").join(name)).unwrap())
});

fn request() -> Vec<u8> {
    serde_json::from_slice::<Value>(&CAMPAIGN[0]).unwrap().to_string().into_bytes()
}

fn readers() -> Vec<Reader> {
    let raw = [0.0, 1.0, 1e-300, 1e300].map(|scale: f64| [scale; 18].map(f64::to_le_bytes).concat());
    let of = |name, examples: Vec<Vec<u8>>, read| Reader { name, examples, read };
    vec![
        of(
            "pairs.csv",
            vec![ROW.into(), ROW.repeat(2).into(), format!("{}\n{ROW}", "x,".repeat(17)).into()],
            read_pairs,
        ),
        of("pairs.f64", raw.to_vec(), read_pairs),
        of("mesh.obj", vec![OBJ.into()], read_mesh),
        of("mesh.off", vec![OFF.into()], read_mesh),
        of("mesh.stl", vec![STL.into(), binary_stl()], read_mesh),
        of("mesh.ply", vec![PLY.into(), binary_ply(false), binary_ply(true)], read_mesh),
        of("scene.toml", vec![SCENE.into()], read_scene),
        of("manifest.json", vec![manifest()], read_manifest),
        of("accuracy.json", vec![results()], read_results),
        of("points.jsonl", vec![CAMPAIGN[1].clone()], read_store),
        of("campaign.json", vec![request()], read_request),
        of("log", vec![log()], read_log),
        of("times.csv", vec![TIMES.into()], read_times),
    ]
    .into_iter()
    .chain(words::readers())
    .collect()
}

/// Rounds of every reader; the faults found.
fn campaign(rounds: u64) -> Vec<String> {
    let mut faults = vec![];
    for reader in readers() {
        let (mut accepted, mut refused) = (0, 0);
        // This one starts the program each time.
        let rounds = if reader.name == "campaign.json" { rounds.div_ceil(10) } else { rounds };
        for round in 0..rounds {
            let home = tempfile::tempdir().unwrap();
            fs::write(home.path().join("t.obj"), OBJ).unwrap();
            let path = home.path().join(reader.name);
            fs::write(&path, changed(&reader, round)).unwrap();
            // The last line before an abort says which file it was.
            println!("{} round {round}", reader.name);
            let fault = match catch_unwind(AssertUnwindSafe(|| (reader.read)(&path))) {
                Ok(Ok(())) => {
                    accepted += 1;
                    continue;
                }
                Ok(Err(message)) if message.contains(reader.name) && !message.contains(char::is_control) => {
                    refused += 1;
                    continue;
                }
                Ok(Err(message)) => format!("says {message:?}"),
                Err(_) => "panics".to_owned(),
            };
            let kept = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{round}-{}", reader.name));
            fs::copy(&path, &kept).unwrap();
            faults.push(format!("{}: {fault}", kept.display()));
        }
        println!("{}: {accepted} accepted, {refused} refused", reader.name);
        assert!(accepted > 0 && refused > 0, "{}: {accepted} accepted, {refused} refused", reader.name);
    }
    faults
}

/// Each of these made the page end in a panic, or in nonsense.
#[test]
fn results_that_cannot_be_are_refused() {
    let refused = |change: &dyn Fn(&mut Value), expected: &str| {
        let mut value: Value = serde_json::from_slice(&results()).unwrap();
        change(&mut value);
        assert_eq!(Results::read(&value.to_string()).unwrap_err().to_string(), expected);
    };
    refused(&|value| value["rows"] = Value::Array(vec![]), "rows: found none");
    refused(&|value| value["foldings"][0]["row"] = 99.into(), "foldings[].row: found 99 where there are 24 rows");
    let large = "rows.2.answers.separate: found 18446744073709552000";
    refused(&|value| value["rows"][2]["answers"]["separate"] = u64::MAX.into(), large);
}

/// The campaign, in a process of its own that has little memory: see below.
#[test]
#[ignore = "the next test starts it"]
fn in_little_memory() {
    let rounds = std::env::var("EFSAT_ROUNDS").map_or(300, |rounds| rounds.parse().expect("a whole number"));
    let faults = campaign(rounds);
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}

#[test]
fn no_file_panics_a_reader_or_takes_its_memory() {
    let test = std::env::current_exe().unwrap();
    let script = format!(
        "ulimit -v {MEMORY}; exec timeout {SECONDS} \"$0\" readers::in_little_memory --exact --ignored --nocapture"
    );
    let rounds = std::env::var("EFSAT_ROUNDS").unwrap_or_else(|_| if full() { "300" } else { "80" }.to_owned());
    let mut command = Command::new("sh");
    command.env("EFSAT_ROUNDS", rounds);
    let output = command.args(["-c", &script]).arg(test).env("RAYON_NUM_THREADS", "2").output().unwrap();
    let (told, errors) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(told.contains("in_little_memory"), "the campaign is not there: {told}{errors}");
    let last: Vec<&str> = told.lines().rev().take(3).collect();
    let faults: Vec<&str> = errors.lines().rev().take(40).collect();
    assert!(output.status.success(), "{:?}, after {last:?}: {faults:#?}", output.status);
}
