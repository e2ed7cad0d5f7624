//! `efsat classify`.

use super::error::Failure;
use super::output::{failure, print, print_json, reasoned, table, tell};
use super::params::ParamArguments;
use super::places::{self, Places};
use super::progress;
use super::source::{Source, SourceArguments};
use efsat_geometry::Points;
use efsat_geometry::exact::{self, Exact, Relation};
use efsat_geometry::pair_file::Reader;
use efsat_geometry::sample::random_points;
use efsat_geometry::scene::{Meeting, Scene};
use efsat_geometry::software::retest::retest;
use efsat_unit::host;
use efsat_unit::host::{Host, ReadyScene, Reference, Relations, Verdicts, loose_pairs};
use efsat_unit::pair::{Pose, Verdict};
use efsat_unit::params::{Method, Params, Truth};
use indicatif::ProgressBar;
use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;
use rayon::prelude::*;
use serde::Serialize;
use std::io::{self, BufWriter, StdoutLock, Write};

/// Loose pairs that are in work at a time.
const BATCH: usize = 1 << 14;
/// Of these a thread takes so many at a time.
const SHARE: usize = 1 << 8;

/// Answers pairs with the reference model, which is what the unit answers
///
/// Prints CSV, `pair,verdict`, pairs counted from 0; the verdicts are separate, intersect and possibly-incorrect. A pair that
/// does not fit the unit is decided by the host; how many these were is said on standard error, or in the table or object.
/// Random pairs are near contact, coplanar, degenerate or far, at mixed scales, both triangles in one frame.
#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// Pairs: .csv (18 numbers per row: a0 a1 a2 b0 b1 b2, each x y z; optional header), .f64 (the same as raw
    /// little-endian binary64), - for CSV on standard input; or a scene, .toml
    #[arg(value_name = "FILE", conflicts_with_all = ["scene", "random", "seed"])]
    file: Option<String>,
    #[command(flatten)]
    source: SourceArguments,
    /// Adds the exact rational answer (separate, touch or intersect) and fails if a definite verdict is wrong; of a scene
    /// with --truth snapped that of the snapped geometry, and counts the pairs in which the other truth differs
    #[arg(long)]
    exact: bool,
    /// Tests pairs that are possibly-incorrect again, exactly, so that every answer is final: separate or intersect, which
    /// includes pairs that only touch
    #[arg(long)]
    retest: bool,
    /// Adds to each row who decided the pair: unit, host (the pair does not fit the unit) or, with --retest, retest
    #[arg(long, conflicts_with_all = ["json", "summary"])]
    decided_by: bool,
    /// Adds to each row why the unit leaves the pair open, the gap that it measured and the error of that, in units of the last
    /// place that it compares; empty if it decides
    #[arg(long, conflicts_with_all = ["json", "summary"])]
    reasons: bool,
    /// Adds to each row of a scene where the pair is, as `scene pairs --index` does, and its 18 numbers
    #[arg(long, conflicts_with_all = ["json", "summary", "random"])]
    places: bool,
    /// Print one JSON object instead of rows
    #[arg(long)]
    json: bool,
    /// Print a table of verdicts instead of rows
    #[arg(long, conflicts_with = "json")]
    summary: bool,
    #[command(flatten)]
    params: ParamArguments,
}

/// What is known of a pair.
struct Answer {
    /// Fields that stand behind those of the answer.
    more: String,
    verdict: Verdict,
    host_decided: bool,
    open: bool,
    retested: bool,
    exact: Option<Relation>,
    /// Of a scene that is snapped: whether the exact answer for what is given is the other one.
    truths_differ: Option<bool>,
}

impl Answer {
    /// Who decided the pair, or left it open.
    fn decided_by(&self) -> &'static str {
        match (self.retested, self.host_decided) {
            (true, _) => "retest",
            (false, true) => "host",
            (false, false) => "unit",
        }
    }
}

/// All counts; also the JSON object.
#[derive(Default, Serialize)]
struct Counts {
    pairs: u64,
    verdicts: Verdicts,
    host_decided: u64,
    #[serde(skip_serializing_if = "Option::is_none")]
    second_stage: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    retested: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    exact: Option<Relations>,
    #[serde(skip_serializing_if = "Option::is_none")]
    wrong: Option<u64>,
    /// Pairs of which the exact answer for the geometry as it is given is not that for the snapped one.
    #[serde(skip_serializing_if = "Option::is_none")]
    truths_differ: Option<u64>,
    #[serde(skip)]
    first_wrong: Option<u64>,
    /// What is said of the pairs that the host decided.
    #[serde(skip)]
    by_host: &'static str,
}

impl Counts {
    fn new(arguments: &Arguments, params: &Params) -> Self {
        let by_host = match params.method {
            Method::Exact => "do not fit the exact unit: decided on the host, exactly",
            Method::Axes | Method::Determinants => "decided on the host",
        };
        let Arguments { exact, retest, .. } = *arguments;
        Self {
            second_stage: params.exact_clocks.map(|_| 0),
            retested: retest.then_some(0),
            exact: exact.then(Relations::default),
            wrong: exact.then_some(0),
            by_host,
            ..Self::default()
        }
    }

    fn add(&mut self, answer: &Answer) {
        self.verdicts.count(answer.verdict);
        self.host_decided += u64::from(answer.host_decided);
        if let Some(second_stage) = &mut self.second_stage {
            *second_stage += u64::from(answer.open);
        }
        if let Some(retested) = &mut self.retested {
            *retested += u64::from(answer.retested);
        }
        if let (Some(exact), Some(counts), Some(wrong)) = (answer.exact, &mut self.exact, &mut self.wrong) {
            counts.count(exact);
            if answer.verdict.is_wrong(exact.class) {
                *wrong += 1;
                self.first_wrong.get_or_insert(self.pairs);
            }
        }
        if let Some(differ) = answer.truths_differ {
            *self.truths_differ.get_or_insert(0) += u64::from(differ);
        }
        self.pairs += 1;
    }

    fn table(&self) -> String {
        let mut text = table(&self.verdicts);
        if self.host_decided > 0 {
            text.push_str(&format!("{} of them {}\n", self.host_decided, self.by_host));
        }
        if let Some(second_stage) = self.second_stage {
            text.push_str(&format!("{second_stage} of them left open by the first stage, decided by the second\n"));
        }
        if let Some(retested) = self.retested {
            text.push_str(&format!("{retested} of them tested again in software\n"));
        }
        if let (Some(exact), Some(wrong)) = (&self.exact, self.wrong) {
            text.push_str(&format!(
                "exact: {} separate, {} touch, {} intersect; {} coplanar; {wrong} wrong definite verdicts\n",
                exact.truths.separate, exact.truths.touch, exact.truths.intersect, exact.coplanar
            ));
        }
        if let Some(differ) = self.truths_differ {
            let share = 100.0 * differ as f64 / self.pairs as f64;
            text.push_str(&format!("{differ} of them ({share:.3} %) are answered otherwise as they are given\n"));
        }
        text
    }
}

/// Takes answers in the order of the pairs: counts them and prints their rows.
struct Sink {
    counts: Counts,
    rows: Option<BufWriter<StdoutLock<'static>>>,
    /// Whether a row tells who decided the pair.
    decided_by: bool,
}

impl Sink {
    fn new(arguments: &Arguments, params: &Params, places: &str) -> Result<Self, Failure> {
        let mut rows = arguments.rows().then(|| BufWriter::new(io::stdout().lock()));
        if let Some(rows) = &mut rows {
            let Arguments { exact, decided_by, reasons, .. } = *arguments;
            let columns =
                [(exact, ",exact"), (decided_by, ",decided_by"), (reasons, ",reason,gap,error"), (true, places)];
            let more: String = columns.iter().filter(|(wanted, _)| *wanted).map(|(_, name)| *name).collect();
            writeln!(rows, "pair,verdict{more}").map_err(failure)?;
        }
        Ok(Self { counts: Counts::new(arguments, params), rows, decided_by: arguments.decided_by })
    }

    fn take(&mut self, answers: &[Answer]) -> Result<(), Failure> {
        for answer in answers {
            if let Some(rows) = &mut self.rows {
                let (pair, verdict) = (self.counts.pairs, answer.verdict);
                write!(rows, "{pair},{verdict}").map_err(failure)?;
                if let Some(exact) = answer.exact {
                    write!(rows, ",{}", exact.class).map_err(failure)?;
                }
                if self.decided_by {
                    write!(rows, ",{}", answer.decided_by()).map_err(failure)?;
                }
                writeln!(rows, "{}", answer.more).map_err(failure)?;
            }
            self.counts.add(answer);
        }
        Ok(())
    }
}

/// Answers pairs one by one.
struct Classifier {
    reference: Reference,
    exact: bool,
    retest: bool,
    reasons: bool,
}

impl Classifier {
    /// The answer for a pair: of the unit, then of `retest` if it is open and `--retest` was given; and of the oracle.
    fn answer(
        &self,
        pose: &Pose,
        pair: &Host,
        retest: impl FnOnce() -> Exact,
        exact: impl FnOnce() -> Relation,
    ) -> Answer {
        let golden = &self.reference.golden;
        let open = matches!(pair, Host::Unit(pair) if golden.is_open(pose, pair));
        let host::Answer { verdict, host_decided } = pair.answer(golden, pose);
        let retested = self.retest && verdict == Verdict::PossiblyIncorrect;
        let verdict = if retested { retest().into() } else { verdict };
        let more = match self.reasons {
            true => format!(",{}", reasoned(pair.reason(golden, pose).as_ref())),
            false => String::new(),
        };
        Answer { more, verdict, host_decided, open, retested, exact: self.exact.then(exact), truths_differ: None }
    }

    fn loose(&self, points: &[Points]) -> Vec<Answer> {
        const FINITE: &str = "pairs are finite";
        let one = |(pair, p): (&Host, &Points)| {
            let (retest, exact) = (|| retest(p).expect(FINITE), || exact::relation(p).expect(FINITE));
            self.answer(&self.reference.identity, pair, retest, exact)
        };
        let some = |points: &[Points]| -> Vec<Answer> {
            let pairs = loose_pairs(points, &self.reference.params).expect(FINITE);
            pairs.iter().zip(points).map(one).collect()
        };
        points.par_chunks(SHARE).flat_map_iter(some).collect()
    }

    /// Answers the first pairs of a file, which have been read, and then the others.
    fn file(
        &self,
        first: Vec<Points>,
        file: &mut Reader<'_>,
        sink: &mut Sink,
        bar: &ProgressBar,
    ) -> Result<(), Failure> {
        let mut batch = first;
        while !batch.is_empty() {
            bar.set_position(file.position());
            sink.take(&self.loose(&batch))?;
            batch = file.next(BATCH)?;
        }
        Ok(())
    }

    fn random(&self, count: u64, seed: u64, sink: &mut Sink, bar: &ProgressBar) -> Result<(), Failure> {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut left = count;
        while left > 0 {
            let batch: Vec<Points> = (0..left.min(BATCH as u64)).map(|_| random_points(&mut rng)).collect();
            left -= batch.len() as u64;
            bar.inc(batch.len() as u64);
            sink.take(&self.loose(&batch))?;
        }
        Ok(())
    }

    fn scene(
        &self,
        scene: &Scene,
        places: Option<&Places<'_>>,
        sink: &mut Sink,
        bar: &ProgressBar,
    ) -> Result<(), Failure> {
        let stage = ReadyScene::new(scene, &self.reference.params);
        let answers = |meeting: &Meeting, pairs: &[(u32, u32)]| -> Vec<Answer> {
            if pairs.is_empty() {
                return vec![];
            }
            let posed = stage.posed(meeting);
            let host = posed.host();
            let answer = |&pair: &(u32, u32)| {
                let [a, b] = posed.faces(pair);
                let (retest, exact) = (|| posed.class(pair), || posed.relation(pair));
                let mut answer = self.answer(&host.pose, &host.pair(a, b), retest, exact);
                if let Some(places) = places {
                    let points = places::points(stage.near.meshes(meeting), &meeting.pose, pair);
                    let numbers = format!(",{}", places::fields(&points));
                    answer.more += &format!(",{}", places.row(&places::place(meeting, pair), &numbers));
                }
                let differs =
                    |exact: Relation| (exact.class == Exact::Separate) != (posed.given(pair) == Exact::Separate);
                let snapped = answer.exact.filter(|_| self.reference.params.truth == Truth::Snapped);
                Answer { truths_differ: snapped.map(differs), ..answer }
            };
            pairs.par_iter().map(answer).collect()
        };
        stage.near.meetings_in_order(answers, |meeting, answers| {
            bar.set_position(meeting.frame as u64);
            sink.take(&answers)
        })
    }
}

impl Arguments {
    /// Whether each pair has a row.
    fn rows(&self) -> bool {
        !self.json && !self.summary
    }
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let params = arguments.params.params()?;
    let given = match (&arguments.file, &arguments.source) {
        (Some(name), _) => Some(Source::file(name)?),
        (None, SourceArguments { scene: Some(name), .. }) => Some(Source::scene(name)?),
        (None, SourceArguments { random: Some(_), .. }) => None,
        _ => return Err(Failure::Usage("no pairs: expected one of FILE, --scene FILE and --random N".to_owned())),
    };
    // Of a file that begins with something else nothing is answered.
    let (mut file, scene) = match given {
        Some(Source::Pairs(file)) => (Some(file), None),
        Some(Source::Scene(scene)) => (None, Some(scene)),
        None => (None, None),
    };
    let first = file.as_mut().map(|file| file.next(BATCH)).transpose()?;
    if arguments.places && scene.is_none() {
        return Err(Failure::Usage("--places: found pairs without places; expected a scene".to_owned()));
    }
    let places = scene.as_ref().filter(|_| arguments.places).map(Places::new);
    let columns = |places: &Places<'_>| format!(",{}", places.columns(&format!(",{}", places::numbers())));
    let mut sink = Sink::new(arguments, &params, &places.as_ref().map_or(String::new(), columns))?;
    let Arguments { exact, retest, reasons, .. } = *arguments;
    let classifier = Classifier { reference: Reference::new(&params), exact, retest, reasons };
    let bar = |count: u64, steps| progress::bar("answering", count, steps, arguments.rows());
    match (&mut file, &scene) {
        (Some(file), _) => {
            let bar = bar(file.length(), "bytes");
            classifier.file(first.unwrap_or_default(), file, &mut sink, &bar)?;
        }
        (None, Some(scene)) => {
            classifier.scene(scene, places.as_ref(), &mut sink, &bar(scene.frames() as u64, "poses"))?;
        }
        (None, None) => {
            let count = arguments.source.random.unwrap_or_default();
            classifier.random(count, arguments.source.seed, &mut sink, &bar(count, "pairs"))?;
        }
    }
    let Sink { counts, rows, .. } = sink;
    match rows {
        Some(mut rows) => {
            rows.flush().map_err(failure)?;
            if counts.host_decided > 0 {
                let Counts { host_decided, pairs, by_host, .. } = counts;
                tell("note", &format!("{host_decided} of {pairs} pairs {by_host}; --decided-by shows which"));
            }
        }
        None if arguments.json => print_json(&counts)?,
        None => print(&counts.table())?,
    }
    match (counts.wrong, counts.first_wrong) {
        (Some(wrong), Some(first)) => {
            Err(Failure::Check(format!("{wrong} wrong definite verdicts, the first is that of pair {first}")))
        }
        _ => Ok(()),
    }
}
