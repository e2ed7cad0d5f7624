//! Scene files: TOML, described in `scenes/headlight.toml` by example.

use super::pose::{axis_angle, quaternion, tumble, ScenePose};
use super::Scene;
use crate::mesh::{self, Mesh};
use nalgebra::{Matrix3, Vector3};
use serde::Deserialize;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use toml::Spanned;

/// The most poses a scene may have.
const MOST_POSES: u64 = 1_000_000;
/// The name of the built-in mesh in a scene file.
const HEADLIGHT: &str = "builtin:headlight";

/// A scene file that cannot be used: where, what was found, what is legal. It prints as one line.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{}:{} {message}", file.display(), line.map(|n| format!("{n}:")).unwrap_or_default())]
pub struct SceneError {
    /// The file.
    pub file: PathBuf,
    /// The line, counted from 1, where one line is to blame.
    pub line: Option<usize>,
    /// What was found and what is legal.
    pub message: String,
}

/// The whole file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SceneFile {
    name: String,
    a: MeshTable,
    b: MeshTable,
    tumble: Option<TumbleTable>,
    #[serde(default)]
    pose: Vec<Spanned<PoseTable>>,
}

/// `[a]` and `[b]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct MeshTable {
    mesh: Spanned<String>,
    scale: Option<Spanned<f64>>,
}

/// `[tumble]`: see [`tumble`].
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct TumbleTable {
    steps: Spanned<u32>,
    distances: Spanned<Vec<f64>>,
    direction: Option<Spanned<[f64; 3]>>,
}

/// `[[pose]]`: one of `matrix`, `axis` with `angle_degrees`, and `quaternion`, or none for no rotation.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PoseTable {
    label: Option<String>,
    matrix: Option<Spanned<[f64; 9]>>,
    axis: Option<Spanned<[f64; 3]>>,
    angle_degrees: Option<Spanned<f64>>,
    quaternion: Option<Spanned<[f64; 4]>>,
    translation: Option<Spanned<[f64; 3]>>,
}

/// What is wrong, and the bytes of the file it concerns.
struct Fault {
    span: Option<Range<usize>>,
    message: String,
}

impl Fault {
    fn at<T>(value: &Spanned<T>, message: impl Into<String>) -> Self {
        Self { span: Some(value.span()), message: message.into() }
    }
}

/// Reads a scene file. Paths of meshes are relative to it.
///
/// # Errors
/// One line with the file, the line where it can be known, what was found and what is legal; faults of the meshes too.
pub fn load(path: &Path) -> Result<Scene, SceneError> {
    let text = std::fs::read_to_string(path).map_err(|e| SceneError {
        file: path.to_owned(),
        line: None,
        message: format!("cannot be read ({e}): legal is a readable TOML file"),
    })?;
    parse(&text, path)
}

/// Reads the text of a scene file that stands, or might stand, at `path`.
pub(super) fn parse(text: &str, path: &Path) -> Result<Scene, SceneError> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let scene = toml::from_str(text)
        .map_err(|e| Fault { span: e.span(), message: e.message().replace('\n', "; ") })
        .and_then(|file| build(file, folder));
    scene.map_err(|Fault { span, message }| SceneError {
        file: path.to_owned(),
        line: span.map(|s| 1 + text.bytes().take(s.start).filter(|&byte| byte == b'\n').count()),
        message,
    })
}

fn build(file: SceneFile, folder: &Path) -> Result<Scene, Fault> {
    let a = mesh_of(&file.a, folder)?;
    // Two equal meshes are one in memory.
    let same = file.a.mesh.get_ref() == file.b.mesh.get_ref()
        && file.a.scale.as_ref().map(Spanned::get_ref) == file.b.scale.as_ref().map(Spanned::get_ref);
    let b = if same { Arc::clone(&a) } else { mesh_of(&file.b, folder)? };
    let mut poses = match &file.tumble {
        Some(table) => tumbling(table, &a, &b)?,
        None => Vec::new(),
    };
    for (number, table) in file.pose.iter().enumerate() {
        poses.push(pose_of(table, number)?);
    }
    if poses.is_empty() {
        let message = "no pose: legal is a table [tumble], tables [[pose]], or both".to_owned();
        return Err(Fault { span: None, message });
    }
    if let Some(pose) = poses.iter().find(|p| !p.translation.iter().all(|x| x.is_finite())) {
        let message = format!("{}: the translation overflows: legal are smaller meshes or distances", pose.label);
        return Err(Fault { span: None, message });
    }
    Ok(Scene { name: file.name, a, b, poses })
}

/// The mesh of a table, with its scale applied: exact if that is a power of two, and in any case the vertices as
/// rounded to binary64 are the truth.
fn mesh_of(table: &MeshTable, folder: &Path) -> Result<Arc<Mesh>, Fault> {
    let source = table.mesh.get_ref();
    let read = match source.strip_prefix("builtin:") {
        None => mesh::read(&folder.join(source)).map(Arc::new).map_err(|e| Fault::at(&table.mesh, e.to_string()))?,
        Some(_) if source == HEADLIGHT => mesh::headlight(),
        Some(_) => {
            return Err(Fault::at(&table.mesh, format!("mesh '{source}': the only built-in one is {HEADLIGHT}")))
        }
    };
    let Some(scale) = &table.scale else { return Ok(read) };
    let factor = *scale.get_ref();
    if !(factor.is_finite() && factor > 0.0) {
        return Err(Fault::at(scale, format!("scale {factor}: legal is a positive number")));
    }
    let mut scaled = Mesh::clone(&read);
    for vertex in &mut scaled.vertices {
        *vertex *= factor;
    }
    if !scaled.vertices.iter().flat_map(|v| v.iter()).all(|x| x.is_finite()) {
        return Err(Fault::at(scale, format!("scale {factor}: the vertices overflow")));
    }
    Ok(Arc::new(scaled))
}

fn tumbling(table: &TumbleTable, a: &Mesh, b: &Mesh) -> Result<Vec<ScenePose>, Fault> {
    let (steps, distances) = (*table.steps.get_ref(), finite(&table.distances, "distances")?);
    if distances.is_empty() {
        return Err(Fault::at(&table.distances, "distances is empty: legal is at least one"));
    }
    let most = MOST_POSES / distances.len() as u64;
    if steps == 0 || u64::from(steps) > most {
        let message = format!("steps {steps}: legal is 1 to {most} at this number of distances");
        return Err(Fault::at(&table.steps, message));
    }
    let direction = match &table.direction {
        Some(given) => non_zero(given, "direction")?,
        None => Vector3::z(),
    };
    Ok(tumble(a, b, steps, distances, direction))
}

fn pose_of(table: &Spanned<PoseTable>, number: usize) -> Result<ScenePose, Fault> {
    let PoseTable { label, matrix, axis, angle_degrees, quaternion: q, translation } = table.get_ref();
    let rotation = match (matrix, axis, angle_degrees, q) {
        (None, None, None, None) => Matrix3::identity(),
        (Some(m), None, None, None) => Matrix3::from_row_slice(finite(m, "matrix")?),
        (None, Some(axis), Some(angle), None) => {
            let degrees = *angle.get_ref();
            if !degrees.is_finite() {
                return Err(Fault::at(angle, format!("angle_degrees {degrees}: legal is a finite number")));
            }
            axis_angle(non_zero(axis, "axis")?, degrees)
        }
        (None, None, None, Some(q)) => {
            if finite(q, "quaternion")?.iter().all(|&x| x == 0.0) {
                return Err(Fault::at(q, "quaternion of four zeros: legal is any other [w, x, y, z]"));
            }
            quaternion(*q.get_ref())
        }
        _ => {
            let message = "pose: legal is one of matrix, axis with angle_degrees, and quaternion, or none";
            return Err(Fault::at(table, message));
        }
    };
    let translation = match translation {
        Some(t) => Vector3::from(*finite(t, "translation")?),
        None => Vector3::zeros(),
    };
    let label = label.clone().unwrap_or_else(|| format!("pose {number}"));
    Ok(ScenePose { label, distance: None, rotation, translation })
}

/// The numbers of a list, if they are all finite: TOML can write `inf` and `nan`.
fn finite<'a, T: AsRef<[f64]>>(list: &'a Spanned<T>, key: &str) -> Result<&'a T, Fault> {
    match list.get_ref().as_ref().iter().find(|x| !x.is_finite()) {
        Some(x) => Err(Fault::at(list, format!("{key} holds {x}: legal are finite numbers"))),
        None => Ok(list.get_ref()),
    }
}

/// A direction: three finite numbers, not all zero.
fn non_zero(list: &Spanned<[f64; 3]>, key: &str) -> Result<Vector3<f64>, Fault> {
    let vector = Vector3::from(*finite(list, key)?);
    match vector.amax() {
        0.0 => Err(Fault::at(list, format!("{key} of three zeros: legal is any other vector"))),
        _ => Ok(vector),
    }
}
