//! `efsat scene pairs`.

use super::directions;
use super::summary::Summary;
use crate::cli::error::Failure;
use crate::cli::output::{failure, print};
use crate::cli::progress;
use crate::cli::source::load_scene;
use crate::exact::Exact;
use crate::golden::{Golden, Verdict};
use crate::host::{Host, Posed, ScenePose, Stage};
use crate::mesh::Findings;
use crate::params::Params;
use crate::scene::hierarchy::{Directions, Forest, Scratch, Statistics, batches, first_hit};
use crate::scene::{Frame, Meeting, Object, Scene};
use rayon::prelude::*;
use serde::Serialize;
use std::io::{self, BufWriter, StdoutLock, Write};

/// Finds the pairs of triangles that a tree of k-DOPs cannot tell apart, frame by frame, and those of them that touch
///
/// The rows count, for each frame: pairs of objects whose boxes overlap (sort and sweep); overlap tests of two k-DOPs;
/// k-DOPs of B brought to the frame of A; pairs of nodes visited; pairs of triangles tested; and pairs that have a
/// common point, exactly. The pairs of triangles are tested by the reference model and, where that leaves it open,
/// exactly.
#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// A scene: a TOML file, or `headlight` for the built-in one
    #[arg(value_name = "FILE")]
    file: String,
    /// Directions of the bounding volumes
    #[arg(long, value_name = "K", default_value = "18", value_parser = directions, allow_negative_numbers = true)]
    k: Directions,
    /// Stop at the first pair of triangles that touch, in every meeting of two objects
    #[arg(long)]
    first_hit: bool,
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
}

/// What finds the pairs and tests them.
struct Search<'a> {
    stage: Stage<'a>,
    scene: &'a Scene,
    forest: Forest,
    golden: Golden,
    first_hit: bool,
}

impl Search<'_> {
    fn row(&self, frame: usize, scratch: &mut Scratch) -> Row {
        let meetings = self.stage.broad_phase.meetings(frame);
        let counts = meetings.iter().fold(Counts::default(), |sum, meeting| sum.plus(&self.meeting(meeting, scratch)));
        let Frame { label, distance, .. } = self.scene.frame(frame);
        Row { frame, label, distance, counts }
    }

    fn meeting(&self, meeting: &Meeting, scratch: &mut Scratch) -> Counts {
        let [a, b] = self.forest.trees(meeting);
        let posed = self.stage.posed(meeting);
        let host = posed.host();
        let touch = |pair: (u32, u32)| self.touch(&posed, &host, pair);
        let (statistics, touching) = if self.first_hit {
            let (hit, statistics) = first_hit(a, b, &meeting.pose, scratch, touch);
            (statistics, u64::from(hit.is_some()))
        } else {
            let mut touching = 0;
            let count = |pairs: &[(u32, u32)]| pairs.par_iter().filter(|pair| touch(**pair)).count() as u64;
            let statistics = batches(a, b, &meeting.pose, scratch, |pairs| touching += count(pairs));
            (statistics, touching)
        };
        Counts { meetings: 1, statistics, touching }
    }

    /// Whether two triangles have a common point. A definite verdict of the reference model is right.
    fn touch(&self, posed: &Posed<'_>, host: &ScenePose<'_>, pair: (u32, u32)) -> bool {
        let [a, b] = posed.faces(pair);
        let verdict = match host.pair(a, b) {
            Host::Unit(unit) => self.golden.verdict(&host.pose, &unit),
            Host::Decided(verdict) => verdict,
        };
        match verdict {
            Verdict::Separate => false,
            Verdict::Intersect => true,
            Verdict::PossiblyIncorrect => posed.relation(pair).class != Exact::Separate,
        }
    }
}

/// Takes rows in the order of the frames.
enum Sink {
    Csv(BufWriter<StdoutLock<'static>>),
    Json(BufWriter<StdoutLock<'static>>, bool),
    Summary(Summary<6>),
}

impl Sink {
    fn new(arguments: &Arguments, scene: &Scene) -> Result<Self, Failure> {
        if arguments.summary {
            return Ok(Self::Summary(Summary::new(Counts::COLUMNS)));
        }
        let mut out = BufWriter::new(io::stdout().lock());
        if arguments.json {
            let object = |object: &Object| {
                let report =
                    ObjectReport { name: &object.name, triangles: object.mesh.faces.len(), findings: &object.findings };
                json(&report)
            };
            let objects: Vec<String> = scene.objects.iter().map(object).collect();
            let (name, k, objects) = (json(&scene.name), arguments.k.count(), objects.join(","));
            let first_hit = arguments.first_hit;
            write!(out, r#"{{"scene":{name},"k":{k},"first_hit":{first_hit},"objects":[{objects}],"frames":["#)
                .map_err(failure)?;
            return Ok(Self::Json(out, false));
        }
        writeln!(out, "frame,label,{}", Counts::COLUMNS.join(",")).map_err(failure)?;
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
                let label = row.label.replace('"', "\"\"");
                writeln!(out, "{},\"{label}\",{numbers}", row.frame).map_err(failure)?;
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

fn json(value: &impl Serialize) -> String {
    serde_json::to_string(value).expect("keys are strings and numbers are finite")
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let scene = load_scene(&arguments.file)?;
    let params = Params::default();
    let search = Search {
        stage: Stage::new(&scene, &params),
        scene: &scene,
        forest: Forest::new(&scene, arguments.k),
        golden: Golden::new(&params),
        first_hit: arguments.first_hit,
    };
    let frames = scene.frames();
    let bar = progress::bar("finding pairs", frames as u64, "poses", !arguments.summary);
    let mut sink = Sink::new(arguments, &scene)?;
    let mut total = Counts::default();
    // Some frames at a time, so that memory does not grow with their number.
    let batch = 4 * rayon::current_num_threads();
    for start in (0..frames).step_by(batch) {
        let here = (start..frames.min(start + batch)).into_par_iter();
        let rows: Vec<Row> = here.map_init(Scratch::default, |scratch, frame| search.row(frame, scratch)).collect();
        for row in &rows {
            total = total.plus(&row.counts);
            sink.take(row)?;
        }
        bar.inc(rows.len() as u64);
    }
    bar.finish_and_clear();
    sink.finish(&total)
}
