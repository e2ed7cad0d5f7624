//! `efsat self-intersections`.

use super::error::Failure;
use super::file::{self, Output};
use super::output::{print, print_json, readable, warn};
use super::params::whole;
use super::progress;
use super::source::load_mesh;
use efsat_geometry::exact::Exact;
use efsat_geometry::mesh::{Findings, Mesh, Numbers, Snapped};
use efsat_geometry::scene::{Object, Pose, Scene};
use efsat_geometry::self_intersections::{Defect, Effort, Kind, Search};
use efsat_studies::planner::picture::Picture;
use efsat_studies::planner::{Contact, Place};
use efsat_unit::host::self_intersections::{Asked, Checker};
use efsat_unit::pair::Verdict;
use efsat_unit::params::{Method, Params};
use serde::Serialize;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Finds all pairs of triangles of a mesh that intersect, exactly, for the coordinates of the file
///
/// Vertices of equal coordinates are one. A common vertex or edge alone is no defect. With --grid or --width the mesh is first moved to
/// a grid, and its pairs are answered by the reference model of the unit that `efsat generate --method exact` makes: the list is
/// then that of the moved mesh, and a line says how far it moved.
/// Exit status 0 whether or not there are defects; 1 if --exact finds an answer wrong.
#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// Mesh file (.stl, .obj, .ply or .off), or builtin:NAME
    #[arg(value_name = "MESH")]
    mesh: PathBuf,
    /// Move vertices to a grid, for a unit with N bits for a difference of coordinates, 6 to 32; 18 if only --grid is given
    #[arg(long, value_name = "N", value_parser = whole(6..=32), allow_negative_numbers = true)]
    width: Option<u32>,
    /// Move vertices to a grid: the distance of two of its points, in units of the mesh; with --width alone the finest power of two on
    /// which the mesh fits N bits
    #[arg(long, value_name = "SIZE", value_parser = size, allow_negative_numbers = true)]
    grid: Option<f64>,
    /// Compare every answer with that of the exact oracle, for the mesh that is answered
    #[arg(long)]
    exact: bool,
    /// Write the defects, one row for each: numbers of the two faces in the file, from 0, and kind; if faces are more than one
    /// triangle, also which triangle of its face each one is, from 0
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// With --grid or --width, write all pairs that the unit is asked about to a .csv file, as `efsat cosim FILE --method exact`
    /// reads them: for two triangles one row, two if they have one common vertex, none if they are duplicates
    #[arg(long, value_name = "FILE", value_parser = file::rows)]
    pairs: Option<PathBuf>,
    /// Draw the mesh with its defects, as .svg or .png
    #[arg(long, value_name = "FILE", value_parser = file::picture)]
    picture: Option<PathBuf>,
    /// Print one JSON object instead of a table
    #[arg(long)]
    json: bool,
}

/// A positive number.
fn size(text: &str) -> Result<f64, String> {
    text.parse().ok().filter(|x: &f64| *x > 0.0 && x.is_finite()).ok_or_else(|| "expected a positive number".to_owned())
}

/// The JSON object.
#[derive(Serialize)]
struct Summary<'a> {
    mesh: String,
    triangles: usize,
    vertices: usize,
    left_out: u64,
    findings: &'a Findings,
    #[serde(flatten)]
    moved: Option<Moved>,
    degenerate: usize,
    #[serde(flatten)]
    effort: &'a Effort,
    defects: u64,
    crossing: u64,
    touching: u64,
    neighbours_meet: u64,
    duplicate: u64,
}

/// What the grid did to the mesh, and what the unit was asked.
#[derive(Serialize)]
struct Moved {
    grid: f64,
    width: u32,
    moved: f64,
    merged: usize,
    #[serde(flatten)]
    asked: Asked,
}

/// What answers.
enum Answers {
    /// Software, for the coordinates as given.
    Given(Search),
    /// The exact unit, for a mesh on a grid.
    Grid(Snapped, Params),
}

impl Answers {
    fn mesh(&self) -> &Mesh {
        match self {
            Self::Given(search) => search.mesh(),
            Self::Grid(snapped, _) => &snapped.mesh,
        }
    }

    fn degenerate(&self) -> usize {
        match self {
            Self::Given(search) => search.degenerate(),
            Self::Grid(snapped, _) => snapped.mesh.degenerate().len(),
        }
    }
}

/// Bits of the unit where only a grid is given.
const WIDTH: u32 = 18;

/// Self-intersections that a picture shows.
const MOST_DRAWN: usize = 100_000;

/// Takes defects piece by piece: what is found is counted and written, and what a picture shows is kept.
struct Found {
    csv: Option<Output>,
    numbers: Numbers,
    pairs: Option<Output>,
    counts: [u64; Kind::ALL.len()],
    effort: Effort,
    asked: Asked,
    drawn: Vec<Defect>,
}

impl Found {
    fn begin(&mut self) -> Result<(), Failure> {
        self.csv.as_mut().map_or(Ok(()), |csv| {
            csv.write(match self.numbers.are_split() {
                false => "first,second,kind\n",
                true => "first,second,kind,first_part,second_part\n",
            })
        })
    }

    fn take(&mut self, defects: &[Defect], effort: &Effort) -> Result<(), Failure> {
        self.effort.add(effort);
        for defect @ Defect { pair: (p, q), kind } in defects {
            self.counts[*kind as usize] += 1;
            if let Some(csv) = &mut self.csv {
                let ([p, part], [q, other]) = (self.numbers.of(*p), self.numbers.of(*q));
                let parts = if self.numbers.are_split() { format!(",{part},{other}") } else { String::new() };
                csv.write(format!("{p},{q},{}{parts}\n", kind.name()))?;
            }
            if self.drawn.len() < MOST_DRAWN {
                self.drawn.push(*defect);
            }
        }
        Ok(())
    }

    /// Takes pairs that the unit answers.
    fn check(&mut self, checker: &Checker<'_>, pairs: &[(u32, u32)]) -> Result<(), Failure> {
        let (defects, effort, asked) = checker.check(pairs);
        self.asked.add(&asked);
        self.take(&defects, &effort)?;
        if let Some(file) = &mut self.pairs {
            for points in pairs.iter().flat_map(|pair| checker.asked(*pair)) {
                let numbers: Vec<String> = points.as_flattened().iter().map(f64::to_string).collect();
                file.write(numbers.join(",") + "\n")?;
            }
        }
        Ok(())
    }
}

/// What answers for a mesh, as the arguments say.
fn answers(arguments: &Arguments, mesh: Mesh) -> Result<Answers, Failure> {
    let Some(width) = arguments.width.or(arguments.grid.map(|_| WIDTH)) else {
        if arguments.pairs.is_some() {
            let message = "--pairs: these are the pairs of the exact unit; expected --grid or --width with it";
            return Err(Failure::Usage(message.to_owned()));
        }
        return Ok(Answers::Given(Search::new(mesh, arguments.exact)));
    };
    let most = f64::from((1u32 << (width - 1)) - 1);
    let grid = arguments.grid.or_else(|| Snapped::finest(&mesh, most)).ok_or_else(|| {
        let why = "no power of two is a grid for a mesh as large or as small as this; expected --grid STEP";
        Failure::Usage(format!("{}: {why}", arguments.mesh.display()))
    })?;
    if Snapped::most(&mesh) / grid >= 2f64.powi(53) {
        let message = format!("--grid {grid:e}: a coordinate has 2^53 units or more; expected a coarser grid");
        return Err(Failure::Usage(message));
    }
    Ok(Answers::Grid(Snapped::new(&mesh, grid), Params { width, ..Params::of(Method::Exact) }))
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let outputs = [&arguments.csv, &arguments.pairs, &arguments.picture];
    let (original, findings) = load_mesh(&arguments.mesh)?;
    file::distinct(outputs.into_iter().flatten().map(PathBuf::as_path))?;
    let answers = answers(arguments, original)?;
    let [csv, pairs, picture] = outputs.map(|path| path.as_deref().map(Output::new).transpose());
    let (csv, pairs, picture) = (csv?, pairs?, picture?);
    let mesh = answers.mesh();
    let bar = progress::bar("finding intersections", mesh.faces().len() as u64, "triangles", false);
    let numbers = findings.numbers.clone();
    let (counts, effort, asked) = ([0; Kind::ALL.len()], Effort::default(), Asked::default());
    let mut found = Found { csv, numbers, pairs, counts, effort, asked, drawn: vec![] };
    found.begin()?;
    match &answers {
        Answers::Given(search) => search.each(|done, defects, effort| {
            bar.set_position(done as u64);
            found.take(defects, effort)
        })?,
        Answers::Grid(snapped, params) => {
            let checker = Checker::new(&snapped.mesh, params, arguments.exact);
            checker.candidates(|pairs| {
                bar.set_position(pairs.last().map_or(0, |(first, _)| u64::from(*first)));
                found.check(&checker, pairs)
            })?;
        }
    }
    bar.finish_and_clear();
    let Found { csv, pairs, counts, effort, asked, drawn, .. } = found;
    csv.into_iter().chain(pairs).try_for_each(Output::finish)?;
    if let Some(mut file) = picture {
        let png = arguments.picture.as_ref().is_some_and(|path| path.extension().is_some_and(|e| e == "png"));
        let picture = self::drawn(&arguments.mesh, mesh, &drawn);
        if png {
            file.write(picture.png())?;
        } else {
            file.write(picture.svg())?;
        }
        file.finish()?;
    }
    let defects = counts.iter().sum();
    if arguments.picture.is_some() && defects > MOST_DRAWN as u64 {
        warn(&format!("the picture shows the first {MOST_DRAWN} of {defects} self-intersections"));
    }
    let count = |kind: Kind| counts[kind as usize];
    let summary = Summary {
        mesh: arguments.mesh.display().to_string(),
        triangles: mesh.faces().len(),
        vertices: mesh.vertices().len(),
        left_out: findings.left_out(),
        findings: &findings,
        moved: match &answers {
            Answers::Given(_) => None,
            Answers::Grid(Snapped { grid, moved, merged, .. }, Params { width, .. }) => {
                Some(Moved { grid: *grid, width: *width, moved: *moved, merged: *merged, asked })
            }
        },
        degenerate: answers.degenerate(),
        effort: &effort,
        defects,
        crossing: count(Kind::Crossing),
        touching: count(Kind::Touching),
        neighbours_meet: count(Kind::Neighbours),
        duplicate: count(Kind::Duplicate),
    };
    if arguments.json {
        print_json(&summary)?;
    } else {
        print(&table(&summary, arguments.exact))?;
    }
    if let (Some(Moved { grid, .. }), true) = (&summary.moved, summary.degenerate == summary.triangles) {
        warn(&format!(
            "every triangle is a segment or a point on a grid of {}; expected a finer --grid",
            readable(*grid)
        ));
    }
    if effort.contradictions > 0 {
        return Err(Failure::Check(format!("{} answers are not those of the exact oracle", effort.contradictions)));
    }
    Ok(())
}

fn table(summary: &Summary<'_>, exact: bool) -> String {
    let Summary { mesh, triangles, vertices, left_out, moved, degenerate, effort, .. } = summary;
    let mut text = format!("{mesh}: {triangles} triangles, {vertices} vertices");
    if let Some(Moved { grid, width, moved, merged, .. }) = moved {
        let _ = writeln!(text, " on a grid of {}, {width} bits", readable(*grid));
        let _ = if *moved == 0.0 {
            writeln!(text, "no vertex moved: the list is that of the file")
        } else {
            let merged = if *merged == 0 { "none".to_owned() } else { merged.to_string() };
            writeln!(
                text,
                "vertices moved by up to {moved:.2e}, {merged} merged with others: the list is that of the moved mesh, not of the file"
            )
        };
    } else {
        text += ", coordinates as given\n";
    }
    if *left_out > 0 {
        let _ =
            writeln!(text, "faces of the file that cannot be used and are left out: {left_out}; {}", summary.findings);
    }
    let on_grid = if moved.is_some() { " on this grid" } else { "" };
    let _ = writeln!(text, "triangles that are segments or points{on_grid}: {degenerate}");
    let mut row = |what: &str, count: u64| {
        let _ = writeln!(text, "{what:<44}{count:>12}");
    };
    row("pairs of triangles whose boxes overlap", effort.candidates);
    row("  of these with a common vertex or edge", effort.neighbours);
    if let Some(Moved { asked: Asked { asked, by_host }, .. }) = moved {
        row("pairs asked about, as --pairs writes them", asked + by_host);
        row("  decided by the unit", *asked);
        row("  that do not fit it, decided by the host", *by_host);
    }
    if exact {
        row("answers that are not the oracle's", effort.contradictions);
    }
    row("self-intersections", summary.defects);
    row("  crossing", summary.crossing);
    row("  touching", summary.touching);
    row("  neighbours that meet elsewhere too", summary.neighbours_meet);
    row("  duplicate triangles", summary.duplicate);
    text
}

/// The mesh as a scene of one object, whose triangles meet each other.
fn drawn(path: &Path, mesh: &Mesh, defects: &[Defect]) -> Picture {
    let name = path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
    let object = Object {
        name: name.clone(),
        mesh: Arc::new(mesh.clone()),
        findings: Findings::default(),
        placed: Pose::identity(),
    };
    let contacts: Vec<Contact> = defects
        .iter()
        .map(|defect| Contact {
            place: Place { frame: 0, objects: (0, 0), pair: defect.pair },
            verdict: Some(Verdict::Intersect),
            exact: Some(if defect.kind == Kind::Touching { Exact::Touch } else { Exact::Intersect }),
        })
        .collect();
    let scene = Scene::at_rest(name, vec![object]).expect("one object at rest");
    Picture::new(&scene, 0, &contacts)
}
