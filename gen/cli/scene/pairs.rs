//! `efsat scene pairs`.

use super::directions;
use super::summary::Summary;
use crate::error::Failure;
use crate::file::{self, Output};
use crate::output::{failure, print, quoted};
use crate::places::{self, Places};
use crate::progress;
use crate::source::load_scene;
use efsat_geometry::collide::hierarchy::{Directions, Scratch, Statistics, batches, first_hit};
use efsat_geometry::collide::{Components, Nesting, nestings};
use efsat_geometry::exact::Exact;
use efsat_geometry::mesh::{Findings, Mesh};
use efsat_geometry::scene::{Forest, Frame, Meeting, Near, Object, Scene};
use efsat_geometry::software::retest::retest_posed;
use rayon::prelude::*;
use serde::Serialize;
use std::collections::HashSet;
use std::fmt;
use std::io::{self, BufWriter, StdoutLock, Write};
use std::path::{Path, PathBuf};

/// Finds the pairs of triangles that a tree of k-DOPs cannot tell apart, frame by frame, and those of them that touch
///
/// The rows count, for each frame: pairs of objects whose boxes overlap (sort and sweep); overlap tests of two k-DOPs;
/// k-DOPs of B brought to the frame of A; pairs of nodes visited; pairs of triangles tested, in software; and pairs that
/// have a common point, exactly. A solid inside another one touches nothing: --containment finds it.
#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// A scene: a TOML file, or `headlight` for the built-in one
    #[arg(value_name = "FILE")]
    file: String,
    /// Directions of the bounding volumes
    #[arg(long, value_name = "K", default_value = "18", value_parser = directions, allow_negative_numbers = true)]
    k: Directions,
    /// Write the numbers of every pair that is tested to FILE, as `classify` reads them: .csv or .f64, both triangles in the frame
    /// of A, the corners of B rounded once
    #[arg(long, value_name = "FILE", value_parser = numbers, conflicts_with = "first_hit")]
    out: Option<PathBuf>,
    /// Write where each of these pairs is to FILE, as CSV: frame, objects, faces in their files
    #[arg(long, value_name = "FILE", value_parser = file::rows, conflicts_with = "first_hit")]
    index: Option<PathBuf>,
    /// Stop at the first pair of triangles that touch, in every meeting of two objects
    #[arg(long)]
    first_hit: bool,
    /// Adds to each row which connected components of closed meshes lie inside each other or touch, exactly; refuses
    /// open meshes
    #[arg(long, conflicts_with_all = ["first_hit", "summary"])]
    containment: bool,
    /// Print the mean and the greatest row of each distance instead of the rows
    #[arg(long, conflicts_with = "json")]
    summary: bool,
    /// Print one JSON object instead of CSV
    #[arg(long)]
    json: bool,
}

/// What a frame took.
#[derive(Clone, Debug, Serialize)]
struct Row {
    frame: usize,
    label: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    distance: Option<f64>,
    #[serde(flatten)]
    counts: Counts,
    /// Of components that are not apart.
    #[serde(skip_serializing_if = "Option::is_none")]
    containment: Option<Vec<Nested>>,
    /// The pairs tested, if they are written.
    #[serde(skip)]
    candidates: Vec<(Meeting, Vec<(u32, u32)>)>,
}

/// How two components of two objects lie.
#[derive(Clone, Debug, Serialize)]
struct Nested {
    a: String,
    component_a: u32,
    b: String,
    component_b: u32,
    relation: &'static str,
}

impl fmt::Display for Nested {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { a, component_a, b, component_b, relation } = self;
        write!(f, "{a}/{component_a} {relation} {b}/{component_b}")
    }
}

#[derive(Clone, Copy, Debug, Default, Serialize)]
struct Counts {
    meetings: u64,
    #[serde(flatten)]
    statistics: Statistics,
    touching: u64,
}

impl Counts {
    /// What is counted, in the order of [`list`](Self::list).
    const COLUMNS: [&'static str; 6] =
        ["meetings", "overlap_tests", "transforms", "nodes_visited", "pairs_tested", "touching"];

    fn list(&self) -> [u64; 6] {
        let Statistics { overlap_tests, transforms, nodes_visited, pairs_tested } = self.statistics;
        [self.meetings, overlap_tests, transforms, nodes_visited, pairs_tested, self.touching]
    }

    fn plus(self, other: &Self) -> Self {
        Self {
            meetings: self.meetings + other.meetings,
            statistics: self.statistics + other.statistics,
            touching: self.touching + other.touching,
        }
    }
}

/// An object, for the report.
#[derive(Serialize)]
struct ObjectReport<'a> {
    name: &'a str,
    triangles: usize,
    findings: &'a Findings,
    #[serde(skip_serializing_if = "Option::is_none")]
    components: Option<usize>,
}

/// What finds the pairs and tests them.
struct Search<'a> {
    scene: &'a Scene,
    near: Near<'a>,
    forest: Forest,
    first_hit: bool,
    /// Whether the pairs tested are kept.
    keeps: bool,
    /// Those of the objects, if they are asked for.
    components: Option<Vec<Components>>,
}

impl Search<'_> {
    fn row(&self, frame: usize, scratch: &mut Scratch) -> Row {
        let mut counts = Counts::default();
        let mut containment = self.components.as_ref().map(|_| vec![]);
        let mut candidates = vec![];
        for meeting in self.near.meetings(frame) {
            let (found, nested) = self.meeting(&meeting, scratch);
            if self.keeps {
                let ([a, b], mut pairs) = (self.forest.trees(&meeting), vec![]);
                batches(a, b, &meeting.pose, scratch, |found| pairs.extend_from_slice(found));
                pairs.sort_unstable();
                candidates.push((meeting, pairs));
            }
            counts = counts.plus(&found);
            containment.iter_mut().for_each(|all| all.extend(nested.iter().cloned()));
        }
        let Frame { label, distance, .. } = self.scene.frame(frame);
        Row { frame, label, distance, counts, containment, candidates }
    }

    fn meeting(&self, meeting: &Meeting, scratch: &mut Scratch) -> (Counts, Vec<Nested>) {
        let [a, b] = self.forest.trees(meeting);
        let meshes = self.near.meshes(meeting);
        let (m, t) = (meeting.pose.rows(), meeting.pose.translation().into());
        let touch = |(p, q): (u32, u32)| {
            let [p, q] = [(meshes[0], p), (meshes[1], q)].map(|(mesh, face)| corners(mesh, face));
            retest_posed(&p, &q, &m, &t).expect("meshes and poses are finite") != Exact::Separate
        };
        if self.first_hit {
            let (hit, statistics) = first_hit(a, b, &meeting.pose, scratch, touch);
            return (Counts { meetings: 1, statistics, touching: u64::from(hit.is_some()) }, vec![]);
        }
        let Some(components) = self.components.as_ref().map(|all| [&all[meeting.a], &all[meeting.b]]) else {
            let mut touching = 0;
            let count = |pairs: &[(u32, u32)]| pairs.par_iter().filter(|pair| touch(**pair)).count() as u64;
            let statistics = batches(a, b, &meeting.pose, scratch, |pairs| touching += count(pairs));
            return (Counts { meetings: 1, statistics, touching }, vec![]);
        };
        let mut touching = 0;
        let mut met = HashSet::new();
        let statistics = batches(a, b, &meeting.pose, scratch, |pairs| {
            let hits: Vec<&(u32, u32)> = pairs.par_iter().filter(|pair| touch(**pair)).collect();
            touching += hits.len() as u64;
            met.extend(hits.iter().map(|(p, q)| (components[0].of(*p), components[1].of(*q))));
        });
        let inside = nestings(meshes, components, &meeting.pose, &met).into_iter();
        let mut nested: Vec<((u32, u32), Option<Nesting>)> =
            inside.map(|(pair, nesting)| (pair, Some(nesting))).collect();
        nested.extend(met.into_iter().map(|pair| (pair, None)));
        nested.sort_unstable_by_key(|(pair, _)| *pair);
        let named = |(pair, nesting)| self.nested(meeting, pair, nesting);
        (Counts { meetings: 1, statistics, touching }, nested.into_iter().map(named).collect())
    }

    /// How two components lie, that inside named first.
    fn nested(&self, meeting: &Meeting, (p, q): (u32, u32), nesting: Option<Nesting>) -> Nested {
        let [a, b] =
            [(meeting.a, p), (meeting.b, q)].map(|(object, part)| (self.scene.objects[object].name.clone(), part));
        let (relation, ((a, component_a), (b, component_b))) = match nesting {
            None => ("touches", (a, b)),
            Some(Nesting::AInB) => ("in", (a, b)),
            Some(Nesting::BInA) => ("in", (b, a)),
        };
        Nested { a, component_a, b, component_b, relation }
    }
}

fn corners(mesh: &Mesh, face: u32) -> [[f64; 3]; 3] {
    mesh.triangle(face as usize).map(<[f64; 3]>::from)
}

/// The components of the meshes of all objects.
fn components(file: &str, scene: &Scene) -> Result<Vec<Components>, Failure> {
    let of = |object: &Object| {
        let legal = "--containment expects closed meshes";
        Components::new(&object.mesh)
            .map_err(|e| Failure::Usage(format!("{file}: object {}: {e}; {legal}", object.name)))
    };
    scene.objects.iter().map(of).collect()
}

/// Takes rows in the order of the frames.
enum Sink {
    Csv(BufWriter<StdoutLock<'static>>),
    Json(BufWriter<StdoutLock<'static>>, bool),
    Summary(Summary<6>),
}

impl Sink {
    fn new(arguments: &Arguments, search: &Search<'_>) -> Result<Self, Failure> {
        let scene = search.scene;
        if arguments.summary {
            return Ok(Self::Summary(Summary::new(Counts::COLUMNS)));
        }
        let mut out = BufWriter::new(io::stdout().lock());
        if arguments.json {
            let object = |(number, object): (usize, &Object)| {
                json(&ObjectReport {
                    name: &object.name,
                    triangles: object.mesh.faces().len(),
                    findings: &object.findings,
                    components: search.components.as_ref().map(|all| all[number].len()),
                })
            };
            let objects: Vec<String> = scene.objects.iter().enumerate().map(object).collect();
            let (name, k, objects) = (json(&scene.name), arguments.k.count(), objects.join(","));
            let first_hit = arguments.first_hit;
            write!(out, r#"{{"scene":{name},"k":{k},"first_hit":{first_hit},"objects":[{objects}],"frames":["#)
                .map_err(failure)?;
            return Ok(Self::Json(out, false));
        }
        let more = if arguments.containment { ",containment" } else { "" };
        writeln!(out, "frame,label,{}{more}", Counts::COLUMNS.join(",")).map_err(failure)?;
        Ok(Self::Csv(out))
    }

    fn take(&mut self, row: &Row) -> Result<(), Failure> {
        match self {
            Self::Summary(summary) => summary.add(row.distance, row.counts.list()),
            Self::Json(out, later) => {
                let comma = if std::mem::replace(later, true) { "," } else { "" };
                write!(out, "{comma}{}", json(row)).map_err(failure)?;
            }
            Self::Csv(out) => {
                let numbers = row.counts.list().map(|count| count.to_string()).join(",");
                write!(out, "{},{},{numbers}", row.frame, quoted(&row.label)).map_err(failure)?;
                if let Some(list) = &row.containment {
                    let list: Vec<String> = list.iter().map(Nested::to_string).collect();
                    write!(out, ",{}", quoted(&list.join("; "))).map_err(failure)?;
                }
                writeln!(out).map_err(failure)?;
            }
        }
        Ok(())
    }

    fn finish(self, total: &Counts) -> Result<(), Failure> {
        match self {
            Self::Summary(summary) => print(&summary.table()),
            Self::Json(mut out, _) => {
                writeln!(out, r#"],"total":{}}}"#, json(total)).and_then(|()| out.flush()).map_err(failure)
            }
            Self::Csv(mut out) => out.flush().map_err(failure),
        }
    }
}

/// The files of pairs.
struct Candidates<'a> {
    near: &'a Near<'a>,
    places: Places<'a>,
    /// Of numbers, and whether they are raw.
    out: Option<(Output, bool)>,
    index: Option<Output>,
}

impl<'a> Candidates<'a> {
    fn new(arguments: &Arguments, search: &'a Search<'a>) -> Result<Self, Failure> {
        file::distinct(arguments.out.iter().chain(&arguments.index).map(PathBuf::as_path))?;
        let places = Places::new(search.scene);
        let is_raw = |path: &Path| path.extension() == Some("f64".as_ref());
        let numbers = |path: &Path| Output::new(path).map(|file| (file, is_raw(path)));
        let mut out = arguments.out.as_deref().map(numbers).transpose()?;
        let mut index = arguments.index.as_deref().map(Output::new).transpose()?;
        if let Some((out, false)) = &mut out {
            out.write(places::numbers() + "\n")?;
        }
        index.as_mut().map_or(Ok(()), |index| index.write(places.columns("") + "\n"))?;
        Ok(Self { near: &search.near, places, out, index })
    }

    fn take(&mut self, row: &Row) -> Result<(), Failure> {
        for (meeting, pair) in
            row.candidates.iter().flat_map(|(meeting, pairs)| pairs.iter().map(move |pair| (meeting, *pair)))
        {
            if let Some((out, is_raw)) = &mut self.out {
                let points = places::points(self.near.meshes(meeting), &meeting.pose, pair);
                match is_raw {
                    true => points.as_flattened().iter().try_for_each(|x| out.write(x.to_le_bytes()))?,
                    false => out.write(places::fields(&points) + "\n")?,
                }
            }
            if let Some(index) = &mut self.index {
                index.write(self.places.row(&places::place(meeting, pair), "") + "\n")?;
            }
        }
        Ok(())
    }

    fn finish(self) -> Result<(), Failure> {
        self.out.map(|(out, _)| out).into_iter().chain(self.index).try_for_each(Output::finish)
    }
}

/// The name of a file of numbers.
fn numbers(text: &str) -> Result<PathBuf, String> {
    file::ending(text, &["csv", "f64"])
}

fn json(value: &impl Serialize) -> String {
    serde_json::to_string(value).expect("keys are strings and numbers are finite")
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let scene = load_scene(&arguments.file)?;
    let components = arguments.containment.then(|| components(&arguments.file, &scene)).transpose()?;
    let search = Search {
        scene: &scene,
        near: Near::by_dops(&scene, true, None),
        forest: Forest::new(&scene, arguments.k),
        first_hit: arguments.first_hit,
        keeps: arguments.out.is_some() || arguments.index.is_some(),
        components,
    };
    let frames = scene.frames();
    let bar = progress::bar("finding pairs", frames as u64, "poses", !arguments.summary);
    let mut candidates = Candidates::new(arguments, &search)?;
    let mut sink = Sink::new(arguments, &search)?;
    let mut total = Counts::default();
    // Some frames at a time, so that memory does not grow with their number.
    let batch = 4 * rayon::current_num_threads();
    for start in (0..frames).step_by(batch) {
        let here = (start..frames.min(start + batch)).into_par_iter();
        let rows: Vec<Row> = here.map_init(Scratch::default, |scratch, frame| search.row(frame, scratch)).collect();
        for row in &rows {
            total = total.plus(&row.counts);
            sink.take(row)?;
            candidates.take(row)?;
        }
        bar.inc(rows.len() as u64);
    }
    bar.finish_and_clear();
    candidates.finish()?;
    sink.finish(&total)
}
