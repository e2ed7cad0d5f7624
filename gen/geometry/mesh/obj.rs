//! Wavefront OBJ with the crate `tobj`: vertices and faces; everything else in such a file is skipped.

use super::error::Fault;
use super::lines::{LineReader, line_before};
use super::{Defect, Mesh, Parsed};
use nalgebra::Point3;
use std::cell::{Cell, OnceCell};
use std::io::BufReader;

const VERTEX: &str = "expected 'v x y z' in finite numbers, then nothing, a weight other than 0, or a colour";
const FACE: &str = "expected 'f' and three or more vertices of the file, counted from 1, or back from -1";

/// Reads the bytes of an OBJ file. A face of more than three corners becomes the triangle fan of its first one.
pub(super) fn parse(bytes: &[u8]) -> Result<Parsed, Fault> {
    if bytes.is_empty() {
        return Err(Fault::new("empty file", "expected an OBJ file with at least one face"));
    }
    let source = String::from_utf8_lossy(bytes);
    let (text, faults) = geometry(&source);
    let position = Cell::new(0);
    let mut reader = BufReader::new(LineReader::new("", &text, &position));
    let options = tobj::LoadOptions { triangulate: true, ..Default::default() };
    let loaded = tobj::load_obj_buf(&mut reader, &options, |_| Err(tobj::LoadError::GenericFailure));
    let (models, _) = loaded.map_err(|e| {
        let line = line_before(&text, position.get());
        let legal = if keyword(&text, line) == Some("v") { VERTEX } else { FACE };
        Fault::new(e.to_string(), legal).at(line)
    })?;
    // Without `o`, `g` and `usemtl` lines there is one model; none if there is no face.
    let Some(model) = models.into_iter().map(|m| m.mesh).find(|m| !m.indices.is_empty()) else {
        return match faults.is_empty() {
            true => Err(Fault::new("no face", "expected at least one line 'f'")),
            false => Ok(Parsed { mesh: Mesh::default(), faults }),
        };
    };
    let vertices = model.positions.chunks_exact(3).map(Point3::from_slice).collect();
    let faces = model.indices.chunks_exact(3).map(|f| [f[0], f[1], f[2]]).collect();
    let blamed = OnceCell::new();
    let parsed = Parsed { mesh: Mesh { vertices, faces }, faults };
    Ok(parsed.without_non_finite(|_| blamed.get_or_init(|| non_finite(&text)).clone()))
}

/// The lines that carry geometry, every other one blank so that line numbers stay: vertices without colours, faces
/// without references to texture coordinates and normals (the crate computes with those unchecked), whose vertices
/// are checked here, where the line is known; and the faults of the faces left out.
fn geometry(source: &str) -> (String, Vec<(Defect, Fault)>) {
    let vertices = source.lines().filter(|line| line.split_whitespace().next() == Some("v")).count() as i64;
    let mut seen = 0;
    let mut text = String::with_capacity(source.len());
    let mut faults = vec![];
    for (number, line) in source.lines().enumerate() {
        let words: Vec<&str> = line.split('#').next().unwrap_or_default().split_whitespace().collect();
        match words[..] {
            ["v", x, y, z, _, _, _] => text.extend(["v ", x, " ", y, " ", z]),
            ["v", ..] => text.push_str(&words.join(" ")),
            ["f", ref corners @ ..] => {
                let index = |corner: &&str| corner.split('/').next().unwrap_or_default().parse::<i64>().ok();
                let legal = |i: i64| (1..=vertices).contains(&i) || (-seen..0).contains(&i);
                let bad = corners.iter().find(|corner| !index(corner).is_some_and(legal));
                let fault = |found: String| Fault::new(found, FACE).at(number + 1);
                if corners.len() < 3 {
                    faults.push((Defect::FewCorners, fault(format!("a face of {} vertices", corners.len()))));
                } else if let Some(corner) = bad {
                    faults.push((Defect::OutOfRange, fault(format!("vertex '{corner}' in a file of {vertices}"))));
                } else {
                    text.push('f');
                    text.extend(corners.iter().filter_map(index).map(|i| format!(" {i}")));
                }
            }
            _ => {}
        }
        seen += i64::from(words.first() == Some(&"v"));
        text.push('\n');
    }
    (text, faults)
}

/// The first word of line `number`, counted from 1.
fn keyword(text: &str, number: usize) -> Option<&str> {
    text.lines().nth(number.saturating_sub(1))?.split_whitespace().next()
}

/// The fault of a file one of whose vertices is not finite: the line to blame is sought only now.
fn non_finite(text: &str) -> Fault {
    let is_bad = |word: &str| word.parse().is_ok_and(|x: f64| !x.is_finite());
    let blamed = text.lines().enumerate().find(|(_, l)| l.starts_with("v ") && l.split_whitespace().any(is_bad));
    match blamed {
        Some((number, line)) => Fault::new(format!("'{line}'"), VERTEX).at(number + 1),
        // The quotient of a coordinate and its weight.
        None => Fault::new("a coordinate that overflows when divided by its weight", VERTEX),
    }
}
