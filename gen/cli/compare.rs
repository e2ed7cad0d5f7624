//! `efsat compare`.

mod tally;

use super::error::Failure;
use super::file;
use super::output::{print, print_json};
use super::params::{ParamArguments, whole};
use super::progress;
use super::source::{Source, SourceArguments, load_mesh};
use efsat_geometry::Points;
use efsat_geometry::exact::{self, Exact};
use efsat_geometry::sample::random_points;
use efsat_geometry::scene::Scene;
use efsat_geometry::software::Test;
use efsat_unit::host;
use efsat_unit::host::{Host, ReadyScene, Reference, loose_pair};
use efsat_unit::pair::Pose;
use efsat_unit::params::Truth;
use indicatif::ProgressBar;
use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;
use rayon::prelude::*;
use std::convert::Infallible;
use std::fs;
use std::path::{Path, PathBuf};
use tally::{Answer, TESTS, Tally};

/// What excludes a mesh. Options of meshes exclude it by themselves: clap does not ask for what an option requires where
/// an option is given that excludes it.
const NO_MESH: [&str; 4] = ["file", "scene", "random", "seed"];

/// Loose pairs that are in work at a time.
const BATCH: usize = 1 << 14;

/// Compares the reference model with software tests: the paper's Table 1 beside the exact answers
///
/// The columns are EFSAT, Moeller 1997 as published (binary64, epsilon 1e-6) and eleven separating axes in binary64;
/// a second table says how often these and other tests were wrong. Without a source of pairs it is the built-in scene.
/// In scenes the software tests read B's vertices as transformed and rounded to binary64; the exact answer is that for
/// the numbers of the pose as reals, and beside it stands the one for the rounded vertices.
#[derive(Debug, clap::Args)]
#[command(mut_arg("seed", |seed| seed.requires("random")))]
pub(super) struct Arguments {
    /// Pairs: .csv (18 numbers per row: a0 a1 a2 b0 b1 b2, each x y z; optional header), .f64 (the same as raw
    /// little-endian binary64), - for CSV on standard input; or a scene, .toml
    #[arg(value_name = "FILE", conflicts_with_all = ["scene", "random", "seed"])]
    file: Option<String>,
    #[command(flatten)]
    source: SourceArguments,
    /// A mesh against itself, .stl, .obj, .ply or .off, tumbling like the built-in scene
    #[arg(long, value_name = "FILE", conflicts_with_all = NO_MESH)]
    mesh: Option<PathBuf>,
    /// Steps in a full turn of the mesh
    #[arg(long, value_name = "N", default_value_t = Scene::STEPS, value_parser = whole(1..=100_000), requires = "mesh")]
    #[arg(allow_negative_numbers = true, conflicts_with_all = NO_MESH)]
    steps: u32,
    /// Distances between the centres of the mesh's boxes, in half-sizes of its cube
    #[arg(long, value_name = "LIST", default_values_t = Scene::DISTANCES, value_parser = distance, requires = "mesh")]
    #[arg(value_delimiter = ',', allow_hyphen_values = true, conflicts_with_all = NO_MESH)]
    distances: Vec<f64>,
    /// Unit of length in which the software tests read a scene, which only Moeller's epsilon depends on; cube if not
    /// given
    #[arg(long, value_name = "UNIT", conflicts_with = "random")]
    units: Option<Units>,
    /// Answers of another program, .csv, as one more test: a row for each pair in the order of `classify`, whose last field is
    /// separate or 0, touch, intersect or 1, possibly-incorrect or 2; optional header. What is not separate counts as a contact
    #[arg(long, value_name = "FILE", value_parser = file::rows)]
    answers: Option<PathBuf>,
    /// Print one JSON object instead of tables
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    params: ParamArguments,
}

/// The unit of length of the software tests.
#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum Units {
    /// The least power of two with which both meshes fit the cube [-1, 1]^3, as in the paper's benchmark
    Cube,
    /// That of the mesh files
    File,
}

impl Units {
    fn name(self) -> &'static str {
        match self {
            Self::Cube => "cube",
            Self::File => "file",
        }
    }

    /// What the coordinates of a scene are multiplied by.
    fn factor(self, scene: &Scene) -> f64 {
        match self {
            Self::File => 1.0,
            Self::Cube => {
                let half = scene.objects.iter().map(|object| object.mesh.bounds().half_size()).fold(0.0, f64::max);
                let (exponent, fraction) = ((half.to_bits() >> 52) as i32 - 1023, half.to_bits() << 12);
                if half > 0.0 { (-f64::from(exponent + i32::from(fraction != 0))).exp2() } else { 1.0 }
            }
        }
    }
}

fn distance(text: &str) -> Result<f64, String> {
    let legal = |x: &f64| x.is_finite();
    text.parse().ok().filter(legal).ok_or_else(|| "expected finite numbers, separated by commas".to_owned())
}

/// The pairs of a run.
enum Pairs {
    Loose(Vec<Points>),
    Random(u64, u64),
    Scene(Scene, Units),
}

impl Arguments {
    /// The name of the source and its pairs.
    fn pairs(&self) -> Result<(String, Pairs), Failure> {
        let units = self.units.unwrap_or(Units::Cube);
        let given = match (&self.file, &self.source, &self.mesh) {
            (Some(name), _, _) => Source::file(name)?,
            (None, SourceArguments { random: Some(count), seed, .. }, _) => {
                return Ok((format!("random {count}, seed {seed}"), Pairs::Random(*count, *seed)));
            }
            (None, _, Some(_)) => Source::Scene(self.tumbling_mesh()?),
            (None, SourceArguments { scene: Some(name), .. }, None) => Source::scene(name)?,
            (None, _, None) => Source::Scene(Scene::default_scene()),
        };
        match given {
            Source::Scene(scene) => Ok((scene.name.clone(), Pairs::Scene(scene, units))),
            Source::Pairs(_) if self.units.is_some() => {
                Err(Failure::Usage("--units: found a file of pairs, which has no unit; expected a scene".to_owned()))
            }
            Source::Pairs(pairs) => Ok((self.file.clone().unwrap_or_default(), Pairs::Loose(pairs.all()?))),
        }
    }

    fn tumbling_mesh(&self) -> Result<Scene, Failure> {
        let path = self.mesh.as_deref().unwrap_or("".as_ref());
        let (mesh, _) = load_mesh(path)?;
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        Scene::against_itself(name, mesh, self.steps, &self.distances).map_err(|e| Failure::Usage(e.to_string()))
    }
}

/// Answers pairs by the reference model, exactly and in software.
struct Comparison {
    reference: Reference,
    /// Whether another program sees a contact, pair by pair.
    others: Option<Vec<bool>>,
}

impl Comparison {
    fn answer(&self, pose: &Pose, pair: &Host, points: &Points, truth: Exact, rounded: Option<Exact>) -> Answer {
        let host::Answer { verdict, host_decided } = pair.answer(&self.reference.golden, pose);
        let mut software = [false; TESTS];
        for (seen, test) in software.iter_mut().zip(Test::ALL) {
            // What has been moved may have become infinite, where these tests see no contact.
            *seen = test.intersect(points).is_ok_and(|meets| meets);
        }
        Answer { verdict, host_decided, truth, rounded, software, other: None }
    }

    /// Pairs in one frame, the first of which is number `first`.
    fn loose(&self, pairs: &[Points], first: u64) -> Tally {
        const FINITE: &str = "pairs are finite";
        let answer = |p: &Points| {
            let (pair, truth) = (loose_pair(p, &self.reference.params).expect(FINITE), exact::pair(p).expect(FINITE));
            self.answer(&self.reference.identity, &pair, p, truth, None)
        };
        self.tally(pairs, first, answer)
    }

    /// Answers pairs, the first of which is number `first`.
    fn tally<P: Sync>(&self, pairs: &[P], first: u64, answer: impl Fn(&P) -> Answer + Sync) -> Tally {
        let add = |tally: Tally, (index, pair): (usize, &P)| {
            let number = first + index as u64;
            let other = self.others.as_ref().and_then(|all| all.get(number as usize).copied());
            tally.add(number, &Answer { other, ..answer(pair) })
        };
        pairs.par_iter().enumerate().fold(Tally::default, add).reduce(Tally::default, |x, y| x.merge(&y))
    }

    fn random(&self, count: u64, seed: u64, bar: &ProgressBar) -> Tally {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut total = Tally::default();
        let mut done = 0;
        while done < count {
            let size = (count - done).min(BATCH as u64);
            let batch: Vec<Points> = (0..size).map(|_| random_points(&mut rng)).collect();
            total = total.merge(&self.loose(&batch, done));
            done += size;
            bar.inc(size);
        }
        total
    }

    fn scene(&self, scene: &Scene, units: Units, bar: &ProgressBar) -> Tally {
        let stage = ReadyScene::new(scene, &self.reference.params);
        let factor = units.factor(scene);
        let mut total = Tally::default();
        let mut done = 0;
        let mut frame = 0;
        let Ok(()) = stage.near.try_for_each(|meeting, pairs| {
            bar.inc((meeting.frame - frame) as u64);
            frame = meeting.frame;
            if pairs.is_empty() {
                return Ok::<(), Infallible>(());
            }
            let posed = stage.posed(meeting);
            let host = posed.host();
            let [mesh_a, mesh_b] = stage.near.meshes(meeting);
            // The factor is a power of two and rounds nothing.
            let a = |vertex: u32| mesh_a.vertices()[vertex as usize].into();
            let images: Vec<[f64; 3]> = mesh_b.vertices().iter().map(|x| meeting.pose.image(x).into()).collect();
            let answer = |&pair: &(u32, u32)| {
                let [of_a, of_b] = posed.faces(pair);
                let [p, q, r] = of_a.map(a);
                let [s, t, u] = of_b.map(|vertex| images[vertex as usize]);
                let points = [p, q, r, s, t, u].map(|point| point.map(|x: f64| factor * x));
                let rounded = exact::pair(&points).ok();
                self.answer(&host.pose, &host.pair(of_a, of_b), &points, posed.relation(pair).class, rounded)
            };
            total = std::mem::take(&mut total).merge(&self.tally(pairs, done, answer));
            done += pairs.len() as u64;
            Ok(())
        });
        total
    }
}

/// The answers of a file: whether each is a contact.
fn others(path: &Path) -> Result<Vec<bool>, Failure> {
    file::reads(path);
    let place = path.display();
    let text = fs::read_to_string(path)
        .map_err(|e| Failure::Usage(format!("{place}: cannot be read ({e}); expected a table of answers")))?;
    let answer = |line: &str| match line.rsplit(',').next().unwrap_or_default().trim() {
        "separate" | "0" => Some(false),
        "touch" | "intersect" | "possibly-incorrect" | "1" | "2" => Some(true),
        _ => None,
    };
    let header = text.lines().next().filter(|line| answer(line).is_none() && line.contains(char::is_alphabetic));
    let rows = text.lines().enumerate().skip(usize::from(header.is_some()));
    let read = |(number, line): (usize, &str)| {
        let expected = "expected separate, touch, intersect or possibly-incorrect, or 0, 1 or 2, behind the last comma";
        answer(line).ok_or_else(|| Failure::Usage(format!("{place}: line {}: found '{line}'; {expected}", number + 1)))
    };
    rows.map(read).collect()
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let params = arguments.params.params()?;
    if params.truth == Truth::Snapped {
        let why = "the tests in software answer for the geometry as it is given";
        return Err(Failure::Usage(format!("--truth snapped: expected given, as {why}")));
    }
    let (source, pairs) = arguments.pairs()?;
    let others = arguments.answers.as_deref().map(others).transpose()?;
    let comparison = Comparison { reference: Reference::new(&params), others };
    let bar = |count: u64, steps| progress::bar("comparing", count, steps, false);
    let (tally, poses, units) = match &pairs {
        Pairs::Loose(pairs) => {
            let bar = bar(pairs.len() as u64, "pairs");
            let batches = pairs.chunks(BATCH).enumerate();
            let tally = batches.fold(Tally::default(), |total, (index, batch)| {
                bar.inc(batch.len() as u64);
                total.merge(&comparison.loose(batch, (index * BATCH) as u64))
            });
            (tally, None, None)
        }
        Pairs::Random(count, seed) => (comparison.random(*count, *seed, &bar(*count, "pairs")), None, None),
        Pairs::Scene(scene, units) => {
            let poses = scene.frames() as u64;
            (comparison.scene(scene, *units, &bar(poses, "poses")), Some(poses), Some(units.name()))
        }
    };
    let given = arguments.answers.as_ref().map(|path| path.display().to_string());
    let report = tally.report(source, poses, units, given.as_deref());
    if let (Some(name), Some(others)) = (&given, &comparison.others)
        && others.len() as u64 != report.pairs
    {
        let (found, expected) = (others.len(), report.pairs);
        return Err(Failure::Usage(format!("{name}: found {found} answers; expected {expected}, one for each pair")));
    }
    if arguments.json {
        print_json(&report)?;
    } else {
        print(&report.table())?;
    }
    match tally.first_wrong {
        Some(first) => {
            let wrong = report.wrong.efsat;
            Err(Failure::Check(format!("{wrong} wrong definite verdicts, the first is that of pair {first}")))
        }
        None => Ok(()),
    }
}
