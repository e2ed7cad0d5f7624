//! Wall maps: what holds on every map, for the default design and others, and `efsat wall` as a command. That the
//! report sees what is wrong is shown in `gen/studies/wall/report.rs`.

use crate::extent::share;
use crate::tools::program::{command, ran, refuses, succeeds};
use efsat::evidence::wall::{Answer, CONTACTS, Contact, Grid, Map, Report, SIZE, Step};
use efsat::params::{Axes, Params, Projections, Upper};
use serde_json::Value;
use std::fs;
use std::path::Path;

/// The commands of docs/walls.md that draw its pictures, and where they put them.
const PICTURES: [(&str, &str); 10] = [
    ("wall --like-paper", ""),
    ("wall vertex-on-edge --step 2^-10 --width 14 --like-paper", "width-14"),
    ("wall vertex-on-edge --step 2^-10 --width 16 --like-paper", "width-16"),
    ("wall vertex-on-edge --step 2^-10 --width 18 --like-paper", "width-18"),
    ("wall vertex-on-edge --step 2^-10 --width 20 --like-paper", "width-20"),
    ("wall vertex-on-edge --step 2^-10 --width 24 --like-paper", "width-24"),
    ("wall coplanar --axes 17 --like-paper", "axes-17"),
    ("wall edge-on-edge --upper sticky --like-paper", "sticky"),
    ("wall edge-on-edge --upper sticky --projections intersect --like-paper", "sticky-intersect"),
    ("wall edge-on-edge --step binary64 --software guigue-devillers", "software"),
];

/// Names and bytes of the files of a directory, folders left out.
fn pictures(dir: &Path) -> Vec<(String, Vec<u8>)> {
    let entries = fs::read_dir(dir).unwrap().map(|entry| entry.unwrap().path()).filter(|path| path.is_file());
    let mut files: Vec<_> = entries
        .map(|path| (path.file_name().unwrap().to_str().unwrap().to_owned(), fs::read(&path).unwrap()))
        .collect();
    files.sort();
    files
}

fn drawn(contact: &Contact, step: Step, params: &Params) -> (Map, Map, Report) {
    let grid = Grid::new(contact, step, params).unwrap();
    let (verdicts, exact) = (Map::verdicts(&grid, params), Map::exact(&grid));
    let report = Report::new(&verdicts, &exact);
    (verdicts, exact, report)
}

/// Definite cells are right, possibly-incorrect ones lie between the definite verdicts, and nothing strays farther than
/// the band is wide: on every contact, for parameter sets over the range of every option that the verdict depends on.
#[test]
fn maps_are_right_and_guarded_for_every_parameter_set() {
    let plain = Params::paper;
    let closer = Params { upper: Upper::Sticky, projections: Projections::Intersect, ..Params::default() };
    let sets = [
        plain(),
        Params::default(),
        Params { upper: Upper::Sticky, ..Params::default() },
        Params { width: 14, axes: Axes::Seventeen, ..closer.clone() },
        closer,
        Params { upper: Upper::Sticky, ..plain() },
        Params { upper: Upper::Sticky, projections: Projections::Intersect, axes: Axes::Seventeen, ..plain() },
        Params { projections: Projections::Skip, ..plain() },
        Params { width: 14, ..plain() },
        Params { width: 17, int_bits: 8, axes: Axes::Seventeen, ..plain() },
        Params { width: 20, renormalise: false, ..plain() },
        Params { width: 24, transform_width: 40, projections: Projections::Intersect, ..plain() },
        Params { width: 32, ..plain() },
        Params { width: 32, transform_width: 48, upper: Upper::Sticky, ..plain() },
    ];
    let mut wrong = vec![];
    for params in &share(5, sets) {
        for contact in &CONTACTS {
            let (_, _, report) = drawn(contact, Step::Working, params);
            // With the paper's roundings the band is a cell wide at least.
            let without_band = *params == (Params { axis_shift: 0, ..params.clone() }) && report.adjacent != 0;
            if report.wrong != 0 || without_band || report.fault().is_some() {
                wrong.push(format!("{}, {}: {report:?}", contact.name, params.command_line()));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// What one plane decides has a wall without fringe and without speckles.
#[test]
fn a_wall_of_one_plane_is_straight() {
    for name in ["vertex-on-face", "sliver-tip", "vertex-on-sliver"] {
        let contact = Contact::named(name).unwrap();
        let (_, _, report) = drawn(contact, Step::Working, &Params::default());
        assert_eq!((report.disordered, report.lines, report.speckles), (0, SIZE, 0), "{name}");
        assert!(report.separate > 0 && report.intersect > 0, "{name}");
    }
}

/// Contract section 9: a wider design never turns one definite verdict into the other; and the band gets narrower.
#[test]
fn bands_narrow_with_the_width() {
    let contact = Contact::named("vertex-on-edge").unwrap();
    let maps = [14, 16, 18, 20, 24].map(|width| {
        let params = Params { width, ..Params::default() };
        drawn(contact, Step::Power(-10), &params).0
    });
    let mut flipped = 0;
    for wider in &maps {
        for (x, y) in maps[0].cells().iter().zip(wider.cells()) {
            flipped += usize::from(x != y && ![x, y].contains(&&Answer::PossiblyIncorrect));
        }
    }
    let undecided = maps.each_ref().map(|map| map.count(Answer::PossiblyIncorrect));
    assert_eq!(flipped, 0);
    // Four times as narrow for two bits more, as long as the band is many cells wide.
    for pair in undecided.windows(2).filter(|pair| pair[0] < 20000 && pair[1] > 500) {
        assert!((3.5..4.5).contains(&(pair[0] as f64 / pair[1] as f64)), "{undecided:?}");
    }
    assert!(undecided.windows(2).all(|pair| pair[0] > 3 * pair[1] && pair[1] > 0), "{undecided:?}");
}

#[test]
fn coplanar_pairs_need_seventeen_axes() {
    let contact = Contact::named("coplanar").unwrap();
    let (eleven, _, _) = drawn(contact, Step::Working, &Params::default());
    assert_eq!(eleven.count(Answer::PossiblyIncorrect), SIZE * SIZE);
    let params = Params { axes: Axes::Seventeen, ..Params::default() };
    let (seventeen, exact, report) = drawn(contact, Step::Working, &params);
    assert!(2 * seventeen.count(Answer::Separate) > exact.count(Answer::Separate));
    assert_eq!((report.intersect, report.disordered, report.speckles), (0, 0, 0));
}

#[test]
fn the_documented_pictures_and_figures_are_what_the_commands_give() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs");
    let text = fs::read_to_string(root.join("walls.md")).unwrap();
    let home = tempfile::tempdir().unwrap();
    let mut wrong = vec![];
    for (arguments, folder) in PICTURES {
        let folder = Path::new("walls").join(folder);
        let out = home.path().join(&folder);
        let printed = succeeds(home.path(), &format!("{arguments} --out {}", out.display()));
        wrong.extend((pictures(&out) != pictures(&root.join(&folder))).then(|| format!("{arguments}: pictures")));
        let rows: Vec<&str> = printed.lines().filter(|row| !text.contains(row)).collect();
        wrong.extend(rows.iter().map(|row| format!("{arguments}: not documented: {row}")));
        wrong.extend((!text.contains(&format!("efsat {arguments}"))).then(|| format!("{arguments}: not documented")));
        for (name, _) in pictures(&out) {
            let link = folder.join(name);
            wrong.extend((!text.contains(link.to_str().unwrap())).then(|| format!("{}: not shown", link.display())));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn equal_whatever_the_number_of_threads() {
    let home = tempfile::tempdir().unwrap();
    let run = |threads: &str| {
        let mut command = command(&home, &format!("wall edge-on-face --out {threads}"));
        let (status, output, _) = ran(command.env("RAYON_NUM_THREADS", threads));
        assert_eq!(status, Some(0));
        (output, pictures(&home.path().join(threads)))
    };
    assert_eq!(run("1"), run("3"));
}

#[test]
fn the_json_object() {
    let home = tempfile::tempdir().unwrap();
    let text = succeeds(home.path(), "wall --json vertex-on-face shared-edge --step 2^-11");
    assert_eq!(text.lines().count(), 1);
    let object: Value = serde_json::from_str(&text).unwrap();
    assert_eq!((&object["step"], &object["wrong"]), (&"2^-11".into(), &0.into()));
    assert_eq!(object["cells"], 2 * SIZE * SIZE);
    let contacts = object["contacts"].as_array().unwrap();
    let names: Vec<&Value> = contacts.iter().map(|contact| &contact["contact"]).collect();
    assert_eq!(names, ["vertex-on-face", "shared-edge"]);
    let sum = |contact: &Value| {
        ["separate", "possibly_incorrect", "intersect"].map(|key| contact[key].as_u64().unwrap()).iter().sum::<u64>()
    };
    for contact in contacts {
        assert_eq!((sum(contact), &contact["step_exponent"]), ((SIZE * SIZE) as u64, &(-11).into()));
        for key in ["wrong", "adjacent", "lines", "disordered", "fringe", "speckles", "speckle_distance"] {
            assert!(contact[key].is_u64(), "{key}");
        }
    }
    assert!(contacts[0]["band"]["median"].as_u64().unwrap() > 0 && contacts[1]["band"].is_null());
    // Without --out nothing is written.
    assert_eq!(fs::read_dir(home.path()).unwrap().count(), 0);
    assert_eq!(succeeds(home.path(), "wall --list").lines().count(), CONTACTS.len());
}

#[test]
fn what_is_wrong_is_one_line_and_nothing_is_written() {
    let home = tempfile::tempdir().unwrap();
    fs::write(home.path().join("file"), "mine").unwrap();
    let cases = [
        ("wall vertex", "'vertex'"),
        ("wall --step 2^-6", "'2^-6' for '--step <STEP>': expected working, input, binary64 or a power of two"),
        ("wall --step -12", "'-12'"),
        ("wall --step 0.001", "expected working, input, binary64 or a power of two from 2^-53 to 2^-7"),
        ("wall --list --json", "--json"),
        ("wall --list --width 20", "--width"),
        ("wall --list --step input", "--step"),
        ("wall --width 5", "expected a whole number from 6 to 32"),
        (
            "wall edge-on-edge --width 13 --out new",
            "contact edge-on-edge: found a step of 2^-6 (working); expected 2^-7",
        ),
        ("wall coplanar --out file", "file: "),
        ("wall coplanar --out file/below", "file/below: "),
    ];
    for (arguments, part) in cases {
        refuses(&home, arguments, part);
    }
    assert_eq!(pictures(home.path()), [("file".to_owned(), b"mine".to_vec())]);
    assert!(!home.path().join("new").exists());
}
