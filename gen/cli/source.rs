//! Where pairs come from: files of pairs, scenes and seeded random numbers.

use super::error::Failure;
use super::file;
use super::output::warn;
use efsat_geometry::mesh::{self, BUILTIN, Findings, Mesh};
use efsat_geometry::pair_file::PairFileError;
use efsat_geometry::scene::{self, Scene};
use efsat_geometry::{Points, pair_file};
use efsat_unit::host::settings::Settings;
use std::path::Path;

/// The word for the built-in scene.
pub(super) const HEADLIGHT: &str = "headlight";

/// Options that name a scene or random pairs.
#[derive(Debug, clap::Args)]
pub(super) struct SourceArguments {
    /// All candidate pairs of a scene: a TOML file, or `headlight` for the built-in scene
    #[arg(long, value_name = "FILE", conflicts_with = "random")]
    pub scene: Option<String>,
    /// Random pairs
    #[arg(long, value_name = "N", value_parser = count, allow_negative_numbers = true)]
    pub random: Option<u64>,
    /// Seed of the random pairs
    #[arg(long, value_name = "S", default_value_t = 1, value_parser = seed, allow_negative_numbers = true)]
    #[arg(conflicts_with = "scene")]
    pub seed: u64,
}

/// A source of pairs that is not random.
#[derive(Debug)]
pub(super) enum Source {
    /// Pairs of a file.
    Pairs(Vec<Points>),
    /// A scene.
    Scene(Scene),
}

impl Source {
    /// Reads a file of pairs, or a scene if its name ends in `.toml`.
    pub fn file(name: &str) -> Result<Self, Failure> {
        if Path::new(name).extension().is_some_and(|e| e.eq_ignore_ascii_case("toml")) {
            return Self::scene(name);
        }
        file::reads(name.as_ref());
        pair_file::read(name).map(Self::Pairs).map_err(|e| match e {
            // Here scenes are read as well.
            PairFileError::Kind { file, found, hint } => {
                let found = match (Path::new(name).is_dir(), found.as_str()) {
                    (true, _) => "found a directory".to_owned(),
                    (false, "") => "found a name without an ending".to_owned(),
                    (false, ending) => format!("found a name ending in .{ending}"),
                };
                let expected = "expected .csv or .f64 (pairs), .toml (a scene), or - for CSV on standard input";
                Failure::Usage(format!("{file}: {found}; {expected}{hint}"))
            }
            e => e.into(),
        })
    }

    /// Reads a scene, or takes the built-in one.
    pub fn scene(name: &str) -> Result<Self, Failure> {
        Ok(Self::Scene(load_scene(name)?))
    }
}

/// Reads a mesh file, or takes one that is built in. What of the file is not in the mesh as it stands there is said on
/// standard error.
pub(super) fn load_mesh(path: &Path) -> Result<(Mesh, Findings), Failure> {
    let Some(name) = path.to_str().and_then(|name| name.strip_prefix("builtin:")) else {
        file::reads(path);
        let (mesh, findings) = mesh::survey(path).map_err(|e| Failure::Usage(e.to_string()))?;
        if findings.must_be_said() {
            warn(&format!("{}: {findings}", path.display()));
        }
        return Ok((mesh, findings));
    };
    let found = mesh::builtin(name).ok_or_else(|| {
        Failure::Usage(format!("builtin:{name}: no such mesh; expected builtin: and one of {}", BUILTIN.join(", ")))
    })?;
    Ok(((*found).clone(), Findings::of_mesh(&found)))
}

/// Reads a scene, or takes the built-in one, for a command that does not plan: what the file says of effects and
/// parameters is not for it, which is said on standard error.
pub(super) fn load_scene(name: &str) -> Result<Scene, Failure> {
    let (scene, settings) = load_planned(name)?;
    if settings != Settings::default() {
        warn(&format!("{name}: [effects] and [parameters] are for scene plan and scene run; not used here"));
    }
    Ok(scene)
}

/// Reads a scene with its settings, or takes the built-in one. What of the mesh files is not in the meshes as it stands
/// there is said on standard error.
pub(super) fn load_planned(name: &str) -> Result<(Scene, Settings), Failure> {
    if name == HEADLIGHT {
        return Ok((Scene::default_scene(), Settings::default()));
    }
    let path = Path::new(name);
    if path.extension().is_none() && !path.exists() {
        return Err(Failure::Usage(format!("{name}: not found: expected {}", known_scenes())));
    }
    let scene = scene::load(path)?;
    file::reads(path);
    scene.files().iter().for_each(|mesh| file::reads(mesh));
    let settings = Settings::of(&scene, name.as_ref())?;
    for object in scene.objects.iter().filter(|object| object.findings.must_be_said()) {
        warn(&format!("{name}: object {}: {}", object.name, object.findings));
    }
    Ok((scene, settings))
}

/// What could have been meant: the built-in scene, and the files that lie where the repository has its scenes.
fn known_scenes() -> String {
    let files = std::fs::read_dir("scenes").into_iter().flatten().filter_map(|entry| Some(entry.ok()?.path()));
    let scenes = files.filter(|path| path.extension().is_some_and(|e| e == "toml"));
    let mut names: Vec<String> = scenes.map(|path| path.display().to_string()).collect();
    names.sort();
    match names.as_slice() {
        [] => format!("{HEADLIGHT} or a file that ends in .toml"),
        names => format!("one of {HEADLIGHT}, {}, or another file that ends in .toml", names.join(", ")),
    }
}

/// A whole number, at least 1.
pub(super) fn count(text: &str) -> Result<u64, String> {
    let legal = |e: &u64| *e > 0;
    text.parse().ok().filter(legal).ok_or_else(|| format!("expected a whole number from 1 to {}", u64::MAX))
}

pub(super) fn seed(text: &str) -> Result<u64, String> {
    text.parse().map_err(|_| format!("expected a whole number from 0 to {}", u64::MAX))
}
