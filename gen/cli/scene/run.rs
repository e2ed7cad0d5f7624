//! `efsat scene run`.

mod engine;
mod report;

use super::given::GivenArguments;
use crate::error::Failure;
use crate::file::{self, Output};
use crate::generate::command_line;
use crate::output::{failure, reasoned, warn};
use crate::params::choice;
use crate::places::Places;
use crate::source::{count, load_planned, seed};
use crate::{output, progress};
use efsat_checks::cosim::Simulator;
use efsat_geometry::scene::Scene;
use efsat_studies::planner::picture::Picture;
use efsat_studies::planner::{
    self, Contact, Cosimulation, Counted, Counts, Front, Options, Place, Plan, Row, Sampling, Total, Undecided, Viewer,
};
use efsat_unit::artefact::{FileSet, Packaging, design_files};
use efsat_unit::design::Design;
use efsat_unit::pair::Verdict;
use efsat_unit::params::{Params, options::Choice};
use engine::EngineOptions;
use report::{End, Report, words};
use std::path::{Path, PathBuf};

/// Pairs of the stratified sample where nothing else is asked for.
const SAMPLE: u64 = 500;
/// Possibly incorrect and close pairs, likewise.
const CLOSE: u64 = 2000;

/// Plans a scene, answers all its surviving pairs by the planned unit, retests exactly what it leaves open, and simulates
/// the unit
///
/// Prints CSV, a row for each pose: what `scene pairs` counts, then pairs that the unit separates, intersects, and leaves
/// open; pairs answered in software; and pairs that touch, by the final answers. The verdicts are compared with those of the full
/// unit. Simulated are a sample of every verdict in every pose, and every pair that is possibly incorrect or close (which
/// a unit of two bits less would leave open).
#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// A scene: a TOML file, or `headlight` for the built-in one
    #[arg(value_name = "FILE")]
    file: String,
    /// Print the mean and the greatest row of each distance, and what came out, instead of the rows
    #[arg(long, conflicts_with = "json")]
    summary: bool,
    /// Print one JSON object instead of CSV
    #[arg(long)]
    json: bool,
    /// Write the rows to FILE, as CSV
    #[arg(long, value_name = "FILE", value_parser = table)]
    csv: Option<PathBuf>,
    /// Write the pairs of triangles that touch or are undecided to FILE, as CSV, each with the exact answer; of undecided ones
    /// why, the gap that was measured and its error
    #[arg(long, value_name = "FILE", value_parser = table)]
    pairs: Option<PathBuf>,
    /// Draw a pose to FILE, .svg or .png: what touches coloured by verdict
    #[arg(long, value_name = "FILE", value_parser = file::picture)]
    picture: Option<PathBuf>,
    /// Write a page to FILE, .html, in which the scene can be turned and every pair that touches or is undecided be looked at
    #[arg(long, value_name = "FILE", value_parser = page)]
    view: Option<PathBuf>,
    /// The pose that is drawn, from 0 [default: the one in which most pairs touch]
    #[arg(long, value_name = "N", requires = "picture", value_parser = seed, allow_negative_numbers = true)]
    frame: Option<u64>,
    /// Write the planned design to DIR, as generate does
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Which pairs are simulated
    #[arg(long, value_name = "WHICH", default_value = "sample", value_parser = choice::<Which>())]
    cosim: Which,
    /// Simulator that runs the design [default: ghdl]
    #[arg(long, value_name = "NAME", value_parser = choice::<Simulator>())]
    simulator: Option<Simulator>,
    /// Pairs of the sample [default: 500]
    #[arg(long, value_name = "N", value_parser = count, allow_negative_numbers = true)]
    sample: Option<u64>,
    /// Possibly incorrect and close pairs that are simulated at most [default: 2000]
    #[arg(long, value_name = "N", value_parser = count, allow_negative_numbers = true)]
    close: Option<u64>,
    /// Seed of the sample [default: 1]
    #[arg(long, value_name = "S", value_parser = seed, allow_negative_numbers = true)]
    seed: Option<u64>,
    #[command(flatten)]
    given: GivenArguments,
    #[command(flatten)]
    engine: EngineOptions,
}

/// Which pairs are simulated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Which {
    All,
    Sample,
    None,
}

impl Choice for Which {
    const ALL: &'static [Self] = &[Self::All, Self::Sample, Self::None];

    fn name(self) -> &'static str {
        match self {
            Self::All => "all",
            Self::Sample => "sample",
            Self::None => "none",
        }
    }
}

/// The name of a table. That of a scene or a mesh, typed by mistake, is none.
fn table(text: &str) -> Result<PathBuf, String> {
    file::ending(text, &["csv"])
}

/// The name of a page.
fn page(text: &str) -> Result<PathBuf, String> {
    file::ending(text, &["html"])
}

impl Arguments {
    /// What clap cannot know of options that need each other.
    fn check(&self, scene: &Scene) -> Result<(), Failure> {
        let which = Choice::name(self.cosim);
        let sample = [("sample", self.sample), ("close", self.close), ("seed", self.seed)];
        if let Some((option, _)) = sample.iter().find(|(_, given)| given.is_some() && self.cosim != Which::Sample) {
            return Err(Failure::Usage(format!("--{option} needs --cosim sample, not {which}")));
        }
        if self.simulator.is_some() && self.cosim == Which::None {
            return Err(Failure::Usage("--simulator needs --cosim sample or all, not none".to_owned()));
        }
        let frames = scene.frames() as u64;
        match self.frame {
            Some(frame) if frame >= frames => {
                Err(Failure::Usage(format!("--frame {frame}: expected 0 to {}", frames - 1)))
            }
            _ => Ok(()),
        }
    }

    /// The name of a file within the directory of the design, if it is to be there.
    fn inside(&self, path: &Path) -> Result<Option<PathBuf>, Failure> {
        let Some(dir) = &self.out else { return Ok(None) };
        // A slash at the end says of a directory that it is one.
        let dir = file::place(&dir.components().collect::<PathBuf>())?;
        let place = file::place(path)?;
        if dir.starts_with(&place) {
            let message = format!("{}: found a name on the way to --out; expected another one", path.display());
            return Err(Failure::Usage(message));
        }
        Ok(place.strip_prefix(dir).ok().map(Path::to_owned))
    }

    /// Whether files can be where they are wanted, as far as that is known before the design.
    fn check_outputs(&self) -> Result<(), Failure> {
        let files = [&self.csv, &self.pairs, &self.picture, &self.view];
        let files = || files.into_iter().flatten().map(PathBuf::as_path);
        self.out.iter().try_for_each(|dir| file::named(dir, "directory"))?;
        file::distinct(files())?;
        files().try_for_each(|path| self.inside(path).map(|_| ()))?;
        self.out.as_ref().map_or(Ok(()), |dir| Ok(FileSet::default().check_target(dir)?))
    }

    /// Writes the planned design, unless another file has the name of one of its files.
    fn write_design(&self, dir: &Path, set: &FileSet) -> Result<(), Failure> {
        for path in [&self.csv, &self.pairs, &self.picture, &self.view].into_iter().flatten() {
            // One of the two may be taken for a folder, too.
            let clash = |name: &Path, file: &Path| file.starts_with(name) || name.starts_with(file);
            let taken = |name: &Path| set.iter().any(|(file, _)| clash(name, Path::new(file)));
            if self.inside(path)?.is_some_and(|name| taken(&name)) {
                let message = format!("{}: found a file of the design; expected another name", path.display());
                return Err(Failure::Usage(message));
            }
        }
        Ok(set.write(dir)?)
    }

    fn sampling(&self) -> Sampling {
        let number = |given: Option<u64>, default: u64| given.unwrap_or(default).min(u64::from(u32::MAX)) as usize;
        match self.cosim {
            Which::None => Sampling::None,
            Which::All => Sampling::All,
            Which::Sample => {
                Sampling::Some { stratified: number(self.sample, SAMPLE), close: number(self.close, CLOSE) }
            }
        }
    }
}

/// The files that are written beside the design, or into its directory.
#[derive(Default)]
struct Outputs {
    csv: Option<Output>,
    pairs: Option<Output>,
    picture: Option<Output>,
    view: Option<Output>,
}

impl Outputs {
    /// Begins those inside `--out`, or the others.
    fn begin(&mut self, arguments: &Arguments, inside: bool) -> Result<(), Failure> {
        let Arguments { csv, pairs, picture, view, .. } = arguments;
        let files =
            [(csv, &mut self.csv), (pairs, &mut self.pairs), (picture, &mut self.picture), (view, &mut self.view)];
        for (path, file) in files {
            if let Some(path) = path
                && inside == arguments.inside(path)?.is_some()
            {
                *file = Some(Output::new(path)?);
            }
        }
        Ok(())
    }
}

/// The file of pairs, and what its rows are made of.
struct Pairs<'a> {
    file: Output,
    places: Places<'a>,
    undecided: Undecided<'a>,
}

impl<'a> Pairs<'a> {
    fn new(mut file: Output, scene: &'a Scene, params: &Params) -> Result<Self, Failure> {
        let places = Places::new(scene);
        file.write(places.columns(",verdict,exact,reason,gap,error") + "\n")?;
        Ok(Self { file, places, undecided: Undecided::new(scene, params) })
    }

    fn take(&mut self, frame: usize, contacts: &[Contact]) -> Result<(), Failure> {
        for (contact, reason) in contacts.iter().zip(self.undecided.reasons(frame, contacts)) {
            let verdict = contact.verdict.map_or("software".to_owned(), |verdict: Verdict| verdict.to_string());
            let exact = contact.exact.map_or(String::new(), |exact| exact.to_string());
            let others = format!(",{verdict},{exact},{}", reasoned(reason.as_ref()));
            self.file.write(self.places.row(&contact.place, &others) + "\n")?;
        }
        Ok(())
    }
}

/// Where the frames go.
struct Sinks<'a> {
    report: Report,
    csv: Option<Output>,
    pairs: Option<Pairs<'a>>,
    viewer: Option<Viewer<'a, 'a>>,
}

impl<'a> Sinks<'a> {
    /// Writes the first lines of tables.
    fn new<C: Counted>(
        scene: &'a Scene,
        params: &Params,
        report: Report,
        viewer: Option<Viewer<'a, 'a>>,
        mut csv: Option<Output>,
        pairs: Option<Output>,
    ) -> Result<Self, Failure> {
        if let Some(csv) = &mut csv {
            csv.write(report::heads::<C>())?;
        }
        let pairs = pairs.map(|file| Pairs::new(file, scene, params)).transpose()?;
        Ok(Self { report, csv, pairs, viewer })
    }

    /// Ends tables and page; the report is left.
    fn finish(self, view: Option<Output>, command_line: &str) -> Result<Report, Failure> {
        if let (Some(viewer), Some(mut file)) = (self.viewer, view) {
            if viewer.left_out() > 0 {
                warn(&format!("the page is full: {} more pairs are not on it", viewer.left_out()));
            }
            file.write(viewer.page(command_line))?;
            file.finish()?;
        }
        self.csv.into_iter().chain(self.pairs.map(|pairs| pairs.file)).try_for_each(Output::finish)?;
        Ok(self.report)
    }

    fn take<C: Counted>(&mut self, row: &Row<C>, contacts: &[Contact]) -> Result<(), Failure> {
        self.report.take(row)?;
        if let Some(csv) = &mut self.csv {
            csv.write(report::line(row))?;
        }
        if let Some(pairs) = &mut self.pairs {
            pairs.take(row.frame, contacts)?;
        }
        if let Some(viewer) = &mut self.viewer {
            viewer.take(row, contacts);
        }
        Ok(())
    }
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let (scene, settings) = load_planned(&arguments.file)?;
    arguments.check(&scene)?;
    if let Some(machine) = arguments.engine.engine {
        return engine::run(arguments, machine, &scene, &settings);
    }
    arguments.engine.refuse()?;
    let mut request = arguments.given.request(&arguments.file, &settings)?;
    request.costs = false;
    arguments.check_outputs()?;
    let mut outputs = Outputs::default();
    outputs.begin(arguments, false)?;
    let spinner = progress::spinner("planning");
    let plan = planner::plan(&scene, &request)?;
    spinner.finish_and_clear();
    // The reference model alone answers where nothing is written or simulated.
    let design = || Design::new(&plan.params, false);
    if let Some(dir) = &arguments.out {
        let set = design_files(&design()?, &command_line(&plan.params, &Packaging::default()))
            .map_err(|e| Failure::Check(e.to_string()))?;
        arguments.write_design(dir, &set)?;
        outputs.begin(arguments, true)?;
    }
    let Outputs { csv, pairs, picture, view } = outputs;
    let front = Front::new(&scene, plan.software, request.directions);
    let simulator = arguments.simulator.unwrap_or(Simulator::Ghdl);
    let simulated = |simulator| design().map(|design| Cosimulation::new(&front, design, simulator));
    let mut cosimulation = (arguments.cosim != Which::None).then(|| simulated(simulator)).transpose()?;
    // What GHDL takes hours for, the built-in simulator takes seconds for: it gets every pair that matters.
    let every = || simulated(Simulator::Builtin);
    let mut every = (arguments.cosim == Which::Sample).then(every).transpose()?;
    let exact = arguments.pairs.is_some() || arguments.view.is_some();
    let options = Options { sampling: arguments.sampling(), exact, seed: arguments.seed.unwrap_or(1) };
    let report = Report::new::<Counts>(arguments.json, arguments.summary, "plan", &plan)?;
    let viewer = view.is_some().then(|| Viewer::new(&front, &plan.params));
    let mut sinks = Sinks::new::<Counts>(&scene, &plan.params, report, viewer, csv, pairs)?;
    let bar = progress::bar("answering", scene.frames() as u64, "poses", !arguments.summary);
    let mut waiting: Vec<Place> = vec![];
    let total = planner::run(&front, &plan, options, |row, contacts, all| {
        bar.inc(1);
        sinks.take(&row, contacts)?;
        waiting.extend_from_slice(all);
        match every.as_mut().or(cosimulation.as_mut()) {
            Some(all) if waiting.len() >= Cosimulation::BATCH => {
                all.simulate(&std::mem::take(&mut waiting)).map_err(Failure::from)
            }
            _ => Ok(()),
        }
    })?;
    bar.finish_and_clear();
    if let Some(all) = every.as_mut().or(cosimulation.as_mut()) {
        all.simulate(&waiting)?;
    }
    if let Some(cosimulation) = &mut cosimulation {
        let spinner = progress::spinner("simulating");
        cosimulation.simulate(&total.places)?;
        spinner.finish_and_clear();
        let fewer = total.sums.close > total.close_places as u64;
        if arguments.cosim == Which::Sample && fewer && simulator != Simulator::Builtin {
            let (some, all) = (total.close_places, total.sums.close);
            let name = Choice::name(simulator);
            warn(&format!(
                "{some} of {all} possibly incorrect and close pairs are simulated by {name}, all by the built-in simulator; \
                 --close takes more"
            ));
        }
    }
    if let Some(picture) = picture {
        let frame = arguments.frame.map_or(total.fullest, |frame| frame as usize);
        draw(arguments, &scene, frame, &planner::frame_contacts(&front, &plan, frame), picture)?;
    }
    let report = sinks.finish(view, &plan.command_line)?;
    let (cosimulated, every_one) = (cosimulation.as_ref(), every.as_ref());
    report.finish(&End::new(&total, cosimulated, every_one), || words(&plan, &total, cosimulated, every_one))?;
    verdict(&plan, &total, cosimulation.iter().chain(&every))
}

fn draw(
    arguments: &Arguments,
    scene: &Scene,
    frame: usize,
    contacts: &[Contact],
    mut file: Output,
) -> Result<(), Failure> {
    let picture = Picture::new(scene, frame, contacts);
    let png = arguments.picture.as_ref().is_some_and(|path| path.extension().is_some_and(|e| e == "png"));
    if png {
        file.write(picture.png())?;
    } else {
        file.write(picture.svg())?;
    }
    file.finish()
}

/// Whether all that must hold does.
fn verdict<'a, 'b: 'a>(
    plan: &Plan,
    total: &Total,
    cosimulations: impl Iterator<Item = &'a Cosimulation<'b, 'b>>,
) -> Result<(), Failure> {
    let mut faults = vec![];
    if total.sums.contradictions > 0 {
        faults.push(format!("{} definite verdicts contradict the full unit", total.sums.contradictions));
    }
    if total.sums.wrong > 0 {
        faults.push(format!("{} wrong definite verdicts", total.sums.wrong));
    }
    if total.sums.less_definite != plan.planned.tally.less_definite {
        let (planned, found) = (plan.planned.tally.less_definite, total.sums.less_definite);
        faults.push(format!("{found} pairs less definite than in the full unit instead of {planned}"));
    }
    for cosimulation in cosimulations.filter(|cosimulation| cosimulation.mismatches > 0) {
        let first = cosimulation.first_mismatch.as_deref().unwrap_or("unknown");
        let (count, vectors) = (cosimulation.mismatches, cosimulation.vectors);
        faults.push(format!("{count} mismatches in {vectors} vectors, the first: {first}"));
    }
    match faults.is_empty() {
        true => Ok(()),
        false => Err(Failure::Check(faults.join("; "))),
    }
}
