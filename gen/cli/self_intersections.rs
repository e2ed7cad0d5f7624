//! `efsat self-intersections`.

use super::error::Failure;
use super::file::{self, Output};
use super::output::{print, print_json, readable, warn};
use super::params::whole;
use super::progress;
use super::source::load_mesh;
use crate::effects::picture::Picture;
use crate::effects::{Contact, Place};
use crate::exact::Exact;
use crate::golden::Verdict;
use crate::host::self_intersections::{Checker, Defect, Effort, Kind};
use crate::mesh::{Findings, Mesh, Numbers, Snapped};
use crate::params::{Method, Params};
use crate::scene::{Object, Pose, Scene};
use serde::Serialize;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Finds all pairs of triangles of a mesh that intersect, on a grid, by answers of the exact unit
///
/// Vertices are moved to the nearest points of the grid, and equal ones become one. Pairs of triangles whose boxes overlap go to
/// the reference model of the unit that `efsat generate --method exact` makes. A common vertex or edge alone is no defect.
/// Exit status 0 whether or not there are defects; 1 if --exact finds an answer wrong.
#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// Mesh file (.stl, .obj, .ply or .off), or builtin:NAME
    #[arg(value_name = "MESH")]
    mesh: PathBuf,
    /// Bits of a difference of coordinates in the unit, 6 to 32
    #[arg(long, value_name = "N", default_value_t = 18, value_parser = whole(6..=32), allow_negative_numbers = true)]
    width: u32,
    /// Distance of two points of the grid, in units of the mesh; by default the finest power of two on which the mesh fits N bits
    #[arg(long, value_name = "SIZE", value_parser = size, allow_negative_numbers = true)]
    grid: Option<f64>,
    /// Ask the exact oracle about every pair too
    #[arg(long)]
    exact: bool,
    /// Write the defects, one row for each: numbers of the two faces in the file, from 0, and kind; if faces are more than one
    /// triangle, also which triangle of its face each one is, from 0
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Write all pairs that are asked about to a .csv file, as `efsat cosim --method exact --pairs FILE` reads them: for two
    /// triangles one row, two if they have one common vertex, none if they are duplicates
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
    grid: f64,
    width: u32,
    degenerate: usize,
    #[serde(flatten)]
    effort: &'a Effort,
    defects: u64,
    crossing: u64,
    touching: u64,
    neighbours_meet: u64,
    duplicate: u64,
}

/// Self-intersections that a picture shows.
const MOST_DRAWN: usize = 100_000;

/// Takes candidate pairs piece by piece: what is found is counted and written, and what a picture shows is kept.
struct Found {
    csv: Option<Output>,
    numbers: Numbers,
    pairs: Option<Output>,
    counts: [u64; Kind::ALL.len()],
    effort: Effort,
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

    fn take(&mut self, checker: &Checker<'_>, pairs: &[(u32, u32)]) -> Result<(), Failure> {
        let (defects, effort) = checker.check(pairs);
        self.effort.add(&effort);
        for defect @ Defect { pair: (p, q), kind } in &defects {
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
        if let Some(file) = &mut self.pairs {
            for points in pairs.iter().flat_map(|pair| checker.asked(*pair)) {
                let numbers: Vec<String> = points.as_flattened().iter().map(f64::to_string).collect();
                file.write(numbers.join(",") + "\n")?;
            }
        }
        Ok(())
    }
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let outputs = [&arguments.csv, &arguments.pairs, &arguments.picture];
    let (original, findings) = load_mesh(&arguments.mesh)?;
    // The mesh is not overwritten either.
    let mesh = Some(arguments.mesh.as_path()).filter(|mesh| mesh.exists());
    file::distinct(mesh.into_iter().chain(outputs.into_iter().flatten().map(PathBuf::as_path)))?;
    let most = f64::from((1u32 << (arguments.width - 1)) - 1);
    let grid = arguments.grid.or_else(|| Snapped::finest(&original, most)).ok_or_else(|| {
        let why = "no power of two is a grid for a mesh as large or as small as this; expected --grid STEP";
        Failure::Usage(format!("{}: {why}", arguments.mesh.display()))
    })?;
    if Snapped::most(&original) / grid >= 2f64.powi(53) {
        let message = format!("--grid {grid:e}: a coordinate has 2^53 units or more; expected a coarser grid");
        return Err(Failure::Usage(message));
    }
    let Snapped { mesh, .. } = Snapped::new(&original, grid);
    let [csv, pairs, picture] = outputs.map(|path| path.as_deref().map(Output::new).transpose());
    let (csv, pairs, picture) = (csv?, pairs?, picture?);
    let params = Params { width: arguments.width, ..Params::of(Method::Exact) };
    let checker = Checker::new(&mesh, &params, arguments.exact);
    let bar = progress::bar("finding intersections", mesh.faces.len() as u64, "triangles", false);
    let numbers = findings.numbers.clone();
    let (counts, effort) = ([0; Kind::ALL.len()], Effort::default());
    let mut found = Found { csv, numbers, pairs, counts, effort, drawn: vec![] };
    found.begin()?;
    checker.candidates(|pairs| {
        bar.set_position(pairs.last().map_or(0, |(first, _)| u64::from(*first)));
        found.take(&checker, pairs)
    })?;
    bar.finish_and_clear();
    let Found { csv, pairs, counts, effort, drawn, .. } = found;
    csv.into_iter().chain(pairs).try_for_each(Output::finish)?;
    if let Some(mut file) = picture {
        let png = arguments.picture.as_ref().is_some_and(|path| path.extension().is_some_and(|e| e == "png"));
        let picture = self::drawn(&arguments.mesh, &mesh, &drawn);
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
        triangles: mesh.faces.len(),
        vertices: mesh.vertices.len(),
        left_out: findings.left_out(),
        findings: &findings,
        grid,
        width: arguments.width,
        degenerate: mesh.degenerate().len(),
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
    if summary.degenerate == summary.triangles {
        warn(&format!(
            "every triangle is a segment or a point on a grid of {}; expected a finer --grid",
            readable(grid)
        ));
    }
    if effort.contradictions > 0 {
        return Err(Failure::Check(format!("{} answers are not those of the exact oracle", effort.contradictions)));
    }
    Ok(())
}

fn table(summary: &Summary<'_>, exact: bool) -> String {
    let Summary { mesh, triangles, vertices, left_out, grid, width, degenerate, effort, .. } = summary;
    let mut text =
        format!("{mesh}: {triangles} triangles, {vertices} vertices on a grid of {}, {width} bits\n", readable(*grid));
    if *left_out > 0 {
        let _ =
            writeln!(text, "faces of the file that cannot be used and are left out: {left_out}; {}", summary.findings);
    }
    let _ = writeln!(text, "triangles that are segments or points on this grid: {degenerate}");
    let mut row = |what: &str, count: u64| {
        let _ = writeln!(text, "{what:<44}{count:>12}");
    };
    row("pairs of triangles whose boxes overlap", effort.candidates);
    row("  of these with a common vertex or edge", effort.neighbours);
    row("pairs asked about, as --pairs writes them", effort.asked + effort.by_host);
    row("  decided by the unit", effort.asked);
    row("  that do not fit it, decided by the host", effort.by_host);
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
    Picture::new(&Scene::at_rest(name, vec![object]), 0, &contacts)
}
