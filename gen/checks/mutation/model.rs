//! Runs mutants of the reference model: each is compiled by itself and its answers are compared with those of the
//! evaluated graph of the unchanged design, under several parameter sets.

use super::{Fate, Mutant, rust, vectors};
use crate::cosim::inputs;
use crate::process::{self, Running};
use efsat_hardware::graph::evaluate::Evaluator;
use efsat_unit::artefact::{Scratch, Stimulus};
use efsat_unit::design::top::DesignError;
use efsat_unit::design::{Design, Probes};
use efsat_unit::golden::{Golden, Input, Pair, Pose};
use efsat_unit::params::{Axes, Guard, Params, ProjectionWidth, Projections, Transform, Upper};
use rayon::prelude::*;
use std::fs::File;
use std::io;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

/// The longest that a mutant may run: it has a loop without an end.
const PATIENCE: Duration = Duration::from_secs(60);

/// Sources that belong to the program around the model: ranges and names of options, and names of inner signals
/// and stages.
const UNCHANGED: [&str; 4] = ["params/options.rs", "params/method.rs", "golden/stages.rs", "golden/trace.rs"];

/// Sources of the other methods.
const OTHER_METHODS: [&str; 2] = ["golden/determinants/", "golden/exact/"];

/// The sources of the reference model, as this program was built from them.
const SOURCES: [(&str, &str); 33] = [
    ("params/options.rs", include_str!("../model/unit/params/options.rs")),
    ("golden/stages.rs", include_str!("../model/unit/golden/stages.rs")),
    ("golden/trace.rs", include_str!("../model/unit/golden/trace.rs")),
    ("number.rs", include_str!("../model/hardware/number.rs")),
    ("params/mod.rs", include_str!("../model/unit/params/mod.rs")),
    ("params/formats.rs", include_str!("../model/unit/params/formats.rs")),
    ("params/guard.rs", include_str!("../model/unit/params/guard.rs")),
    ("params/method.rs", include_str!("../model/unit/params/method.rs")),
    ("golden/mod.rs", include_str!("../model/unit/golden/mod.rs")),
    ("golden/axis_test.rs", include_str!("../model/unit/golden/axis_test.rs")),
    ("golden/axes.rs", include_str!("../model/unit/golden/axes.rs")),
    ("golden/edge_test.rs", include_str!("../model/unit/golden/edge_test.rs")),
    ("golden/guard.rs", include_str!("../model/unit/golden/guard.rs")),
    ("golden/input.rs", include_str!("../model/unit/golden/input.rs")),
    ("golden/interval.rs", include_str!("../model/unit/golden/interval.rs")),
    ("golden/projection.rs", include_str!("../model/unit/golden/projection.rs")),
    ("golden/renormalise.rs", include_str!("../model/unit/golden/renormalise.rs")),
    ("golden/transform.rs", include_str!("../model/unit/golden/transform.rs")),
    ("golden/verdict.rs", include_str!("../model/unit/golden/verdict.rs")),
    ("golden/determinants/mod.rs", include_str!("../model/unit/golden/determinants/mod.rs")),
    ("golden/determinants/bounds.rs", include_str!("../model/unit/golden/determinants/bounds.rs")),
    ("golden/determinants/coordinates.rs", include_str!("../model/unit/golden/determinants/coordinates.rs")),
    ("golden/determinants/differences.rs", include_str!("../model/unit/golden/determinants/differences.rs")),
    ("golden/determinants/fifteen.rs", include_str!("../model/unit/golden/determinants/fifteen.rs")),
    ("golden/determinants/moments.rs", include_str!("../model/unit/golden/determinants/moments.rs")),
    ("golden/determinants/number.rs", include_str!("../model/unit/golden/determinants/number.rs")),
    ("golden/determinants/trace.rs", include_str!("../model/unit/golden/determinants/trace.rs")),
    ("golden/determinants/verdict.rs", include_str!("../model/unit/golden/determinants/verdict.rs")),
    ("golden/exact/mod.rs", include_str!("../model/unit/golden/exact/mod.rs")),
    ("golden/exact/cascade.rs", include_str!("../model/unit/golden/exact/cascade.rs")),
    ("golden/exact/plane.rs", include_str!("../model/unit/golden/exact/plane.rs")),
    ("golden/exact/trace.rs", include_str!("../model/unit/golden/exact/trace.rs")),
    ("golden/exact/verdict.rs", include_str!("../model/unit/golden/exact/verdict.rs")),
];

/// What the model does without: the stream, the engine, errors with words, and numbers of any length.
const LEFT_OUT: [&str; 7] = [
    "pub mod stream;",
    "pub mod engine;",
    "pub use engine::{EngineFormat, EngineParams};",
    "#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]",
    "#[error(\"--{option} {found}: {legal}\")]",
    "mod unrounded;",
    "pub use unrounded::{AxisAnswer, Unrounded};",
];

/// In place of the file of that name, whose vectors of numbers are another crate's: one pair after the other.
const LANES: (&str, &str) = ("golden/lanes.rs", include_str!("model_lanes.txt"));

/// A program around the model: parameters (`S`), poses (`P`) and pairs (`V`) in, answers out, one a line.
const MAIN: &str = include_str!("model_main.txt");

/// Why no mutant can be tried.
#[derive(Debug, thiserror::Error)]
pub enum ModelError {
    /// There is no compiler.
    #[error("rustc is not installed: --target golden compiles every mutant (https://rustup.rs)")]
    Missing,
    /// The unchanged design cannot be made.
    #[error(transparent)]
    Design(#[from] DesignError),
    /// A file cannot be written or read, or a program not be started.
    #[error("mutants of the reference model: {0}")]
    File(#[from] io::Error),
    /// The unchanged model does not compile or does not agree.
    #[error("the unchanged reference model: {0}")]
    Baseline(String),
}

/// Vectors under several parameter sets, and the answers of the evaluated graph.
pub struct ModelCampaign {
    input: String,
    expected: Vec<String>,
    /// Name of the parameter set and number of the pair of each answer.
    places: Vec<(&'static str, usize)>,
}

/// Parameter sets that together reach every line of the model.
fn sets() -> Vec<(&'static str, Params)> {
    let with = |change: &dyn Fn(&mut Params)| {
        let mut params = Params::default();
        change(&mut params);
        params
    };
    vec![
        ("default", Params::default()),
        ("like the paper", Params::paper()),
        ("like the paper, 17 axes, sticky", Params { axes: Axes::Seventeen, upper: Upper::Sticky, ..Params::paper() }),
        ("like the paper, no renormalisation", Params { renormalise: false, ..Params::paper() }),
        (
            "other shifts and widths",
            with(&|p| (p.axis_shift, p.projection_width, p.upper) = (30, ProjectionWidth::Full, Upper::Sticky)),
        ),
        ("no edge test", with(&|p| (p.edge_test, p.projections, p.axis_shift) = (false, Projections::All, 2))),
        ("sticky, intersect", with(&|p| (p.upper, p.projections) = (Upper::Sticky, Projections::Intersect))),
        ("17 axes, skip", with(&|p| (p.axes, p.projections) = (Axes::Seventeen, Projections::Skip))),
        (
            "17 axes, sticky, intersect",
            with(&|p| (p.axes, p.upper, p.projections) = (Axes::Seventeen, Upper::Sticky, Projections::Intersect)),
        ),
        ("translate, sticky", with(&|p| (p.transform, p.upper) = (Transform::Translate, Upper::Sticky))),
        ("no transform", with(&|p| p.transform = Transform::Off)),
        ("no renormalisation", with(&|p| p.renormalise = false)),
        (
            "no renormalisation, translate, 17 axes, sticky",
            with(&|p| {
                (p.renormalise, p.transform) = (false, Transform::Translate);
                (p.axes, p.upper) = (Axes::Seventeen, Upper::Sticky);
            }),
        ),
        ("no renormalisation, no transform", with(&|p| (p.renormalise, p.transform) = (false, Transform::Off))),
        ("guard always, sticky", with(&|p| (p.guard, p.upper) = (Guard::Always, Upper::Sticky))),
        ("widest", with(&|p| (p.width, p.transform_width, p.int_bits) = (32, 48, 5))),
        ("wide rows", with(&|p| p.transform_width = 37)),
        ("narrow", with(&|p| (p.width, p.transform_width, p.axes) = (8, 10, Axes::Seventeen))),
        ("narrowest", with(&|p| (p.width, p.transform_width, p.axes) = (6, 18, Axes::Seventeen))),
        (
            "no renormalisation, no transform, input as wide as the axis test",
            with(&|p| (p.renormalise, p.transform, p.transform_width) = (false, Transform::Off, p.width)),
        ),
    ]
}

impl ModelCampaign {
    /// Chooses `count` pairs for each parameter set, evaluates the graphs, and compiles and runs the unchanged model.
    ///
    /// # Errors
    /// See [`ModelError`].
    pub fn new(count: usize, seed: u64) -> Result<Self, ModelError> {
        let found = Command::new("rustc").arg("--version").output().is_ok_and(|o| o.status.success());
        if !found {
            return Err(ModelError::Missing);
        }
        let parts: Result<Vec<_>, DesignError> = sets()
            .into_par_iter()
            .map(|(name, params)| {
                let stimulus = vectors::stimulus(&params, count, seed).followed_by(Stimulus::outside(&params));
                Ok((name, input(&params, &stimulus), expected(&params, &stimulus)?))
            })
            .collect();
        let mut campaign = Self { input: String::new(), expected: vec![], places: vec![] };
        for (name, input, expected) in parts? {
            campaign.input.push_str(&input);
            campaign.places.extend((0..expected.len()).map(|pair| (name, pair)));
            campaign.expected.extend(expected);
        }
        match campaign.simulate(None)? {
            Fate::Survived => Ok(campaign),
            Fate::Killed(what) | Fate::Invalid(what) => Err(ModelError::Baseline(what)),
        }
    }

    /// Compiles a mutant and compares its answers.
    ///
    /// # Errors
    /// [`ModelError::File`].
    pub fn fate(&self, mutant: &Mutant) -> Result<Fate, ModelError> {
        self.simulate(Some(mutant))
    }

    fn simulate(&self, mutant: Option<&Mutant>) -> Result<Fate, ModelError> {
        let scratch = Scratch::new()?;
        let dir = scratch.path();
        OTHER_METHODS.iter().try_for_each(|other| std::fs::create_dir_all(dir.join(other)))?;
        std::fs::create_dir(dir.join("params"))?;
        for (name, text) in SOURCES.into_iter().chain([LANES]) {
            let changed = mutant.filter(|mutant| mutant.unit == name).map(|mutant| mutant.apply(text));
            let text = changed.as_deref().unwrap_or(text);
            let kept = |line: &&str| !LEFT_OUT.contains(line);
            std::fs::write(dir.join(name), text.lines().filter(kept).collect::<Vec<_>>().join("\n"))?;
        }
        std::fs::write(dir.join("main.rs"), MAIN)?;
        std::fs::write(dir.join("input"), &self.input)?;
        let args = ["--edition=2024", "-Copt-level=1", "--cap-lints=allow", "main.rs", "-o", "model"];
        let compiler = process::output(Command::new("rustc").args(args).current_dir(dir))?;
        if !compiler.status.success() {
            let text = String::from_utf8_lossy(&compiler.stderr);
            return Ok(Fate::Invalid(text.lines().find(|l| l.starts_with("error")).unwrap_or("refused").to_owned()));
        }
        self.compare(dir)
    }

    /// Runs the compiled model; the first difference, if there is one.
    fn compare(&self, dir: &Path) -> Result<Fate, ModelError> {
        let mut command = Command::new(dir.join("model"));
        let (input, output) = (File::open(dir.join("input"))?, File::create(dir.join("output"))?);
        command.stdin(input).stdout(output).stderr(Stdio::null());
        let Some(status) = Running::start(&mut command)?.wait(PATIENCE)? else {
            return Ok(Fate::Killed("silence: no answer".to_owned()));
        };
        let output = std::fs::read_to_string(dir.join("output"))?;
        let mut lines = output.lines();
        for (expected, (set, pair)) in self.expected.iter().zip(&self.places) {
            match lines.next() {
                Some(line) if line == expected => {}
                Some(line) => {
                    // The last word stands for the inner signals.
                    let answer = |line: &str| line.rsplit_once(' ').map(|(answer, _)| answer.to_owned());
                    let what = if answer(line) == answer(expected) { "node" } else { "answer" };
                    return Ok(Fate::Killed(format!("{what}: pair {pair}, {set}")));
                }
                None => return Ok(Fate::Killed(format!("panic: at pair {pair} or before, {set}, {status}"))),
            }
        }
        Ok(Fate::Survived)
    }
}

/// All mutants of all sources, in the order of files and lines.
pub fn mutants() -> Vec<Mutant> {
    let of_axes = |name: &str| !OTHER_METHODS.iter().any(|other| name.starts_with(other));
    let sources = SOURCES.iter().filter(|(name, _)| !UNCHANGED.contains(name) && of_axes(name));
    sources.flat_map(|(name, text)| rust::mutants(name, text)).collect()
}

/// What the program around the model reads: whole numbers, a number of the unit as mantissa and sticky bit.
fn input(p: &Params, stimulus: &Stimulus) -> String {
    let switches = [p.axes as u32, p.projections as u32, p.upper as u32, u32::from(p.renormalise), p.transform as u32];
    let bits = match p.projection_width {
        ProjectionWidth::Rounded => 32,
        ProjectionWidth::Plus(bits) => bits,
        ProjectionWidth::Full => 33,
    };
    let switches = switches.into_iter().chain([p.guard as u32, bits, p.axis_shift, u32::from(p.edge_test)]);
    let words = [p.width, p.int_bits, p.transform_width].into_iter().chain(switches).map(|word| word.to_string());
    let number = |x: &Input| format!("{} {}", x.lo, u32::from(x.sticky));
    let mut lines = vec![format!("S {}", words.collect::<Vec<_>>().join(" "))];
    for (pose, pairs) in &stimulus.segments {
        let entries: Vec<String> = pose.m.iter().flatten().chain(&pose.t).map(number).collect();
        lines.push(format!("P {} {}", entries.join(" "), u32::from(pose.bypass)));
        for pair in pairs {
            let points: Vec<String> = pair.a.iter().chain(&pair.b).flatten().map(number).collect();
            lines.push(format!("V {}", points.join(" ")));
        }
    }
    lines.push(String::new());
    lines.join("\n")
}

/// The answers of the evaluated graph, and a digest of the inner signals of the unchanged model, which are those of the
/// graph (`testbench/agreement.rs`).
fn expected(p: &Params, stimulus: &Stimulus) -> Result<Vec<String>, DesignError> {
    let design = Design::new(p, Probes::None)?;
    let golden = Golden::new(p);
    let mut evaluator = Evaluator::new(&design.pipeline);
    let mut answer = |pose: &Pose, pair: &Pair| {
        evaluator.run(&inputs(&design, pose, pair));
        let [verdict, separated, overlapping] =
            ["verdict", "separated", "overlapping"].map(|name| evaluator.output(name));
        let outside = if p.guarded() { evaluator.output("outside") } else { 0 };
        format!("{verdict} {separated} {overlapping} {outside} {}", digest(&golden, pose, pair))
    };
    let mut answers = vec![];
    for (pose, pairs) in &stimulus.segments {
        answers.extend(pairs.iter().map(|pair| answer(pose, pair)));
    }
    Ok(answers)
}

/// All inner signals that are nodes of the graph, in one number; the program around the model computes the same.
fn digest(golden: &Golden, pose: &Pose, pair: &Pair) -> u64 {
    let trace = golden.trace(pose, pair);
    let nodes = trace.iter().filter(|(name, _)| !name.starts_with("enclosure."));
    nodes.fold(0, |sum: u64, (_, x)| {
        let mix = |sum: u64, bound: i128| (sum ^ bound as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(29);
        mix(mix(sum, x.lo), x.hi)
    })
}
