//! The JSON objects of all commands have the keys that docs/formats.md lists, of the types that it says, and no others.

use crate::tools::program::{efsat, succeeds};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// Commands, and runs that together have every key. The object of `efsat mutate` is checked by its own tests.
const RUNS: [(&str, &[&str]); 18] = [
    (
        "efsat classify",
        &[
            "classify pairs.csv --exact --retest",
            "classify pairs.csv --method exact --exact-clocks 16",
            "classify s.toml --exact --method exact --truth snapped",
        ],
    ),
    (
        "efsat generate",
        &[
            "generate --out a",
            "generate --out b --method exact --width 32 --exact-clocks 16",
            "generate --out engine --engine",
        ],
    ),
    ("efsat cosim", &["cosim --random 20 --simulator builtin"]),
    ("efsat compare", &["compare pairs.csv", "compare s.toml"]),
    ("efsat stress", &["stress --pairs 100"]),
    ("efsat stress --once", &["stress --once --pairs 32768 --family lattice-5 --width 12"]),
    ("efsat wall", &["wall edge-on-face --step 2^-11 --software moeller --out w"]),
    ("efsat synth", &["synth --predict", "synth --predict --engine"]),
    ("efsat scene pairs", &["scene pairs s.toml", "scene pairs tumble.toml", "scene pairs boxes.toml --containment"]),
    ("efsat scene plan", &["scene plan s.toml", "scene plan tumble.toml"]),
    ("efsat scene run", &["scene run s.toml --simulator builtin", "scene run tumble.toml --cosim none"]),
    ("efsat scene run --engine", &["scene run s.toml --engine model", "scene run tumble.toml --engine model"]),
    (
        "efsat self-intersections",
        &["self-intersections m.obj --exact", "self-intersections m.obj --width 18", "self-intersections t.obj"],
    ),
    ("efsat accuracy", &["accuracy --pairs 50 --sweep width=12 --multipliers 72 --out c"]),
    ("efsat tree inspect", &["tree inspect m.tree"]),
    ("efsat tree answer", &["tree answer m.tree m.tree --pose 1,0,0,0,1,0,0,0,1,0.25,0,0"]),
    ("efsat tree count", &["tree count s.toml"]),
    ("efsat accuracy --shard", &["accuracy --pairs 50 --sweep width=12 --multipliers 72 --out d --shard 1/1"]),
];

/// Commands that are on the page, and whose objects are not looked at here; an engine is compiled by other tests.
const OTHERS: [&str; 2] = ["efsat mutate", "efsat cosim --engine"];

const TYPES: [&str; 6] = ["text", "count", "number", "flag", "list", "object"];

/// `a.{b, c}` is `a.b` and `a.c`.
fn expanded(keys: &str) -> Vec<String> {
    let braces = keys.split_once('{').and_then(|(before, rest)| Some((before, rest.split_once('}')?)));
    let Some((before, (inner, after))) = braces else {
        return vec![keys.to_owned()];
    };
    inner.split(',').flat_map(|one| expanded(&format!("{before}{}{after}", one.trim()))).collect()
}

/// The lists of the page: the type of each key, by heading. An item is keys, a type if they are no counts, and what they mean.
fn tables(page: &str) -> BTreeMap<String, BTreeMap<String, String>> {
    let mut items: Vec<(&str, String)> = vec![];
    let mut heading = "";
    for line in page.lines() {
        if line.starts_with("## ") {
            heading = "";
        } else if let Some(text) = line.strip_prefix("### ") {
            heading = text.trim_matches('`');
        } else if line.starts_with("- `") && heading.starts_with("efsat ") {
            items.push((heading, line.to_owned()));
        } else if let (Some(more), Some((of, item))) = (line.strip_prefix("  "), items.last_mut())
            && *of == heading
        {
            *item += " ";
            *item += more;
        }
    }
    let mut tables: BTreeMap<String, BTreeMap<String, String>> = BTreeMap::new();
    for (heading, item) in &items {
        let keys = item.split(": ").next().unwrap();
        let kind = keys.strip_suffix(')').and_then(|keys| Some(keys.rsplit_once(" (")?.1)).unwrap_or("count");
        assert!(TYPES.contains(&kind), "{heading}: {item}");
        for key in keys.split('`').skip(1).step_by(2).flat_map(expanded) {
            let before = tables.entry((*heading).to_owned()).or_default().insert(key.clone(), kind.to_owned());
            assert!(before.is_none(), "{heading}: {key} is there twice");
        }
    }
    tables
}

/// All keys of an object with what they lead to, one for all elements of a list: `a.b`, `list[].c`. What is below a key
/// that the page calls an object or a list is not looked at.
fn keys(value: &Value, path: &str, table: &BTreeMap<String, String>, found: &mut BTreeMap<String, Value>) {
    let whole = table.get(path).is_some_and(|kind| kind == "list" || kind == "object");
    match value {
        Value::Object(map) if !whole => {
            for (key, value) in map {
                let path = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
                keys(value, &path, table, found);
            }
        }
        Value::Array(list) if !whole => list.iter().for_each(|value| keys(value, &format!("{path}[]"), table, found)),
        value => drop(found.insert(path.to_owned(), value.clone())),
    }
}

fn is(value: &Value, kind: &str) -> bool {
    match kind {
        "text" => value.is_string(),
        "count" => value.is_u64(),
        // There may be none.
        "number" => value.is_number() || value.is_null(),
        "flag" => value.is_boolean(),
        "list" => value.is_array(),
        _ => value.is_object() || value.is_null(),
    }
}

/// What is wrong with objects, if the page has this list.
fn faults(command: &str, objects: &[Value], table: &BTreeMap<String, String>) -> Vec<String> {
    let mut found = BTreeSet::new();
    let mut faults = vec![];
    for object in objects {
        let mut here = BTreeMap::new();
        keys(object, "", table, &mut here);
        for (key, value) in here {
            match table.get(&key) {
                // An object that is not there.
                None if value.is_null() && table.keys().any(|below| below.starts_with(&format!("{key}."))) => {}
                None => faults.push(format!("{command}: the page lacks {key}")),
                Some(kind) if !is(&value, kind) => faults.push(format!("{command}: {key} is no {kind}: {value}")),
                _ => {}
            }
            found.insert(key);
        }
    }
    let gone = table.keys().filter(|key| !found.contains(*key));
    faults.extend(gone.map(|key| format!("{command}: no run has {key}")));
    faults.sort();
    faults.dedup();
    faults
}

fn object(dir: &Path, arguments: &str) -> Value {
    // One command prints nothing else.
    let json = if arguments.starts_with("tree answer") { "" } else { "--json" };
    let (status, text, errors) = efsat(dir, &format!("{arguments} {json}"));
    assert_eq!(status, Some(0), "{arguments}: {errors}");
    serde_json::from_str(&text).unwrap_or_else(|e| panic!("{arguments}: {e}: {text}"))
}

/// Pairs, meshes and scenes that all runs read.
fn inputs(dir: &Path) {
    let write = |name: &str, text: &str| fs::write(dir.join(name), text).unwrap();
    write("pairs.csv", include_str!("../examples/three_pairs.csv"));
    // A triangle, a face that cannot be used and a line that is not read; a mesh of two triangles that cross.
    write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0.5\nf 1 2 3\nf 1 2 9\nsurf\n");
    write("m.obj", "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 1 1 -1\nv 1 1 1\nv 2 1 1\nf 1 2 3\nf 4 5 6\n");
    let objects = "name = \"s\"\n[a]\nmesh = \"t.obj\"\n[b]\nmesh = \"t.obj\"\n";
    write(
        "s.toml",
        &format!("{objects}[[pose]]\naxis = [0, 0, 1]\nangle_degrees = 90\ntranslation = [0.25, 0.25, 0]\n"),
    );
    let shells = "v 0 0 0\nv 9 0 0\nv 0 9 0\nv 0 0 9\nf 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n";
    write("outer.obj", shells);
    write("inner.obj", &shells.replace('9', "1"));
    let boxes = "name = \"boxes\"\n[a]\nmesh = \"outer.obj\"\n[b]\nmesh = \"inner.obj\"\n";
    write("boxes.toml", &format!("{boxes}[[pose]]\ntranslation = [1, 1, 1]\n[[pose]]\ntranslation = [0, 0, 0]\n"));
    write("tumble.toml", &format!("{objects}[tumble]\nsteps = 3\ndistances = [0.1]\n"));
    write("q.obj", "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 1 2 -1\nv 1 2 1\nv 1 3 1\nf 1 2 3 4\nf 5 6 7\n");
}

#[test]
fn objects_have_the_keys_of_the_page() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    inputs(dir);
    succeeds(dir, "tree build m.obj --out m.tree");

    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/formats.md");
    let tables = tables(&fs::read_to_string(page).unwrap());
    let on_page: BTreeSet<&str> = tables.keys().map(String::as_str).collect();
    let expected: BTreeSet<&str> = RUNS.map(|run| run.0).into_iter().chain(OTHERS).collect();
    assert_eq!(on_page, expected, "the page has a list for each command");
    let all = RUNS.iter().flat_map(|(command, runs)| {
        let objects: Vec<Value> = runs.iter().map(|arguments| object(dir, arguments)).collect();
        faults(command, &objects, &tables[*command])
    });
    let all: Vec<String> = all.collect();
    assert!(all.is_empty(), "{}", all.join("\n"));
}

#[test]
fn every_command_with_json_is_on_the_page() {
    let help = |command: &str| succeeds(".", &format!("{command} --help"));
    let below = |text: &str| -> Vec<String> {
        let listed = text.lines().skip_while(|line| *line != "Commands:").skip(1).take_while(|line| !line.is_empty());
        listed
            .filter_map(|line| Some(line.split_whitespace().next()?.to_owned()))
            .filter(|name| name != "help")
            .collect()
    };
    let mut with_json = vec![];
    for name in below(&help("")) {
        let text = help(&name);
        if text.contains("--json") {
            with_json.push(format!("efsat {name}"));
        }
        // `accuracy merge` prints what `accuracy` does.
        for inner in below(&text).iter().filter(|inner| *inner != "merge") {
            if help(&format!("{name} {inner}")).contains("--json") {
                with_json.push(format!("efsat {name} {inner}"));
            }
        }
    }
    let listed: BTreeSet<&str> = RUNS.map(|run| run.0).into_iter().chain(OTHERS).collect();
    let absent: Vec<&String> = with_json.iter().filter(|command| !listed.contains(command.as_str())).collect();
    assert!(with_json.len() >= 13 && absent.is_empty(), "{with_json:?}");
}

/// Runs, and the files of rows that they write; without one the rows are printed.
const ROWS: [(&str, &str); 9] = [
    ("classify s.toml --exact --decided-by --reasons --places", ""),
    ("scene pairs s.toml", ""),
    ("scene pairs boxes.toml --containment", ""),
    ("scene pairs s.toml --index i.csv --out o.csv", "i.csv"),
    ("scene run s.toml --cosim none", ""),
    ("scene run s.toml --cosim none --pairs p.csv", "p.csv"),
    ("self-intersections q.obj --csv d.csv", "d.csv"),
    ("tree build q.obj --out q.tree --faces f.csv", "f.csv"),
    ("tree query s.toml --out q.csv", "q.csv"),
];

#[test]
fn every_column_of_rows_is_on_the_page() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    inputs(dir);
    let page = |name: &str| fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("docs").join(name)).unwrap();
    let pages = page("formats.md") + &page("scenes.md");
    let code = pages.split('`').skip(1).step_by(2).flat_map(|code| code.split([',', ' ', '{', '}'])).map(str::trim);
    let code: BTreeSet<&str> = code.collect();
    for (arguments, file) in ROWS {
        let said = efsat(dir, arguments).1;
        let rows = if file.is_empty() { said } else { fs::read_to_string(dir.join(file)).unwrap() };
        let columns: Vec<&str> = rows.lines().next().unwrap().split(',').collect();
        // 18 numbers have two names on the page.
        let is_number = |name: &&str| name.len() == 4 && name.ends_with(['x', 'y', 'z']) && name.contains('_');
        let absent: Vec<&&str> = columns.iter().filter(|name| !is_number(name) && !code.contains(**name)).collect();
        assert!(columns.len() >= 3 && absent.is_empty(), "{arguments}: {absent:?}");
    }
}

/// The checks are shown something that they have to complain of.
#[test]
fn the_checks_can_fail() {
    let tables = tables("### `efsat x`\n\n- `a`,\n  `b[].{c}`: what (these) are\n- `d` (list)\n\n## Others\n\n- `f`\n");
    let keys = [("a", "count"), ("b[].c", "count"), ("d", "list")].map(|(key, kind)| (key.to_owned(), kind.to_owned()));
    assert_eq!(tables, BTreeMap::from([("efsat x".to_owned(), BTreeMap::from(keys))]));
    assert_eq!(expanded("{a, b[]}.{c, d}.e"), ["a.c.e", "a.d.e", "b[].c.e", "b[].d.e"]);
    let table = &tables["efsat x"];
    let say = |object: Value| faults("x", &[object], table);
    assert!(say(serde_json::json!({"a": 1, "b": [{"c": 2}], "d": [{"anything": 1}]})).is_empty());
    assert_eq!(say(serde_json::json!({"a": -1, "b": [], "d": []})), ["x: a is no count: -1", "x: no run has b[].c"]);
    assert_eq!(say(serde_json::json!({"a": 1, "b": null, "d": []})), ["x: no run has b[].c", "x: the page lacks b"]);
    assert_eq!(say(serde_json::json!({"a": 1, "b": [{"c": 2}], "d": [], "e": 1})), ["x: the page lacks e"]);
}
