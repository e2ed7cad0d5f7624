//! Scene files: TOML, described in `docs/scenes.md`.

mod motions;
mod numbers;
mod objects;
mod tables;

use super::motion::Motion;
use super::{Entry, Scene};
use crate::input;
use std::ops::Range;
use std::path::{Path, PathBuf};
use tables::{Entries, SceneTable};
use toml::{Spanned, Value};

/// A scene file that cannot be used: where, what was found, what was expected. It prints as one line.
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

/// What is wrong, and the bytes of the file it concerns.
struct Fault {
    span: Option<Range<usize>>,
    message: String,
}

impl Fault {
    fn at<T>(value: &Spanned<T>, message: impl Into<String>) -> Self {
        Self { span: Some(value.span()), message: message.into() }
    }

    fn whole(message: impl Into<String>) -> Self {
        Self { span: None, message: message.into() }
    }
}

/// Reads a scene file. Paths of meshes are relative to it.
///
/// # Errors
/// One line with the file, the line where it can be known, what was found and what was expected; faults of the meshes too.
/// Faces of a mesh that cannot be used are none: they are left out and reported in [`Object::findings`].
///
/// [`Object::findings`]: super::Object::findings
pub fn load(path: &Path) -> Result<Scene, SceneError> {
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    let hint = match extension.as_str() {
        "csv" | "f64" => "pairs of triangles",
        "stl" | "obj" | "ply" | "off" => "a mesh, which a scene file names",
        _ => "",
    };
    if !hint.is_empty() {
        let message = format!("found {hint}: expected a scene in TOML");
        return Err(SceneError { file: path.to_owned(), line: None, message });
    }
    let text = input::text(path).map_err(|e| SceneError {
        file: path.to_owned(),
        line: None,
        message: format!("cannot be read ({e}): expected a readable TOML file"),
    })?;
    parse(&text, path)
}

/// Reads the text of a scene file that stands, or might stand, at `path`.
pub(super) fn parse(text: &str, path: &Path) -> Result<Scene, SceneError> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let scene = toml::from_str(text)
        .map_err(|e| Fault { span: e.span(), message: e.message().replace('\n', "; ") })
        .and_then(|table| build(table, text, folder));
    scene.map_err(|Fault { span, message }| SceneError {
        file: path.to_owned(),
        line: span.map(|s| line(text, s.start)),
        message,
    })
}

/// The line that a byte of a text is in, counted from 1.
fn line(text: &str, byte: usize) -> usize {
    1 + text.bytes().take(byte).filter(|&byte| byte == b'\n').count()
}

fn build(table: SceneTable, text: &str, folder: &Path) -> Result<Scene, Fault> {
    let objects = objects::of(&table, folder)?;
    let mut motions = motions::of(&table, &objects)?;
    if motions.is_empty() {
        if table.object.is_empty() {
            let legal = "expected a table [tumble], tables [[pose]], tables [[trajectory]], or several of them";
            return Err(Fault::whole(format!("no pose: {legal}")));
        }
        motions.push(Motion::Rest);
    }
    let meshes = table.a.iter().chain(&table.b).chain(&table.object).map(|object| object.get_ref().mesh.get_ref());
    let read: Vec<String> = meshes.filter(|mesh| !mesh.starts_with(objects::BUILTIN)).cloned().collect();
    let [effects, parameters] = [table.effects, table.parameters].map(|table| entries(table, text));
    let files = read.into_iter().map(|mesh| folder.join(mesh)).collect();
    let scene = Scene { name: table.name, objects, effects, parameters, motions, files };
    scene.checked().map_err(|e| Fault::whole(e.to_string()))
}

/// The entries of a table that is not for us.
fn entries(table: Entries, text: &str) -> Vec<Entry> {
    let entry = |(key, value): (Spanned<String>, Value)| {
        let line = line(text, key.span().start);
        Entry { key: key.into_inner(), value, line }
    };
    table.into_iter().map(entry).collect()
}
