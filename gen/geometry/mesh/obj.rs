//! Wavefront OBJ: vertices and faces. Other statements of the format that make no faces are skipped in silence; what makes
//! surfaces of another kind, or is no statement of the format, is skipped and said.

use super::build::Builder;
use super::error::Fault;
use super::text::{Line, Lines, number, quoted, uncommented};
use super::{Defect, Parsed};

const VERTEX: &str = "expected 'v x y z' in decimal numbers, then nothing, a weight other than 0, or a colour";
const FACE: &str = "expected 'f' and three or more vertices of the file, counted from 1, or back from -1";

/// Statements without faces.
const SKIPPED: [&str; 26] = [
    "vt",
    "vn",
    "vp",
    "g",
    "o",
    "s",
    "mg",
    "p",
    "l",
    "usemtl",
    "mtllib",
    "usemap",
    "maplib",
    "bevel",
    "c_interp",
    "d_interp",
    "lod",
    "shadow_obj",
    "trace_obj",
    "cstype",
    "deg",
    "bmat",
    "step",
    "ctech",
    "stech",
    "end",
];
/// Statements that end in names or paths, where a backslash at the end belongs to the name.
const NAMED: [&str; 8] = ["g", "o", "usemtl", "mtllib", "usemap", "maplib", "shadow_obj", "trace_obj"];

/// Reads the bytes of an OBJ file: first all vertices, then all faces, which may stand before their vertices.
pub(super) fn parse(bytes: &[u8]) -> Result<Parsed, Fault> {
    if bytes.is_empty() {
        return Err(Fault::new("empty file", "expected an OBJ file with at least one face"));
    }
    let mut builder = Builder::new(1);
    statements(bytes, |line, words| match words {
        ["v", numbers @ ..] => builder.vertex(vertex(numbers).map_err(|fault| fault.at(line))?, Some(line)),
        [word @ ("V" | "F"), ..] => {
            let found = format!("'{word}' in '{}'", quoted(&words.join(" ")));
            Err(Fault::new(found, "expected 'v' and 'f' in small letters").at(line))
        }
        _ => Ok(()),
    })?;
    let (mut seen, mut faces) = (0, 0u64);
    statements(bytes, |line, words| {
        match words {
            [] => {}
            ["v", ..] => seen += 1,
            ["f", corners @ ..] => {
                faces += 1;
                face(&mut builder, seen, line, corners)?;
            }
            [word, ..] if SKIPPED.contains(word) => {}
            _ => builder.remark("lines not read", || format!("line {line}: '{}'", quoted(&words.join(" ")))),
        }
        Ok(())
    })?;
    if faces == 0 {
        return Err(Fault::new("no face", "expected at least one line 'f'"));
    }
    Ok(builder.finish())
}

/// Every statement with its line: without a comment, and with the lines that follow a backslash at its end.
fn statements(bytes: &[u8], mut each: impl FnMut(usize, &[&str]) -> Result<(), Fault>) -> Result<(), Fault> {
    let mut lines = Lines::new(bytes)?;
    while let Some(Line { number, text }) = lines.next() {
        let (text, mut is_comment) = uncommented(&text);
        let mut statement = text.to_owned();
        let is_named = statement.split_whitespace().next().is_some_and(|word| NAMED.contains(&word));
        while !is_comment && !is_named && statement.trim_end().ends_with('\\') {
            statement.truncate(statement.trim_end().len() - 1);
            let Some(next) = lines.next() else { break };
            let (text, ends) = uncommented(&next.text);
            is_comment = ends;
            statement.push(' ');
            statement.push_str(text);
        }
        each(number, &statement.split_whitespace().collect::<Vec<_>>())?;
    }
    Ok(())
}

/// The point of the numbers behind `v`.
fn vertex(words: &[&str]) -> Result<[f64; 3], Fault> {
    let shown = || quoted(&words.join(" "));
    let number = |word: &str| {
        number(word).map_err(|wrong| Fault::new(format!("{wrong} in 'v {}' is no number", shown()), VERTEX))
    };
    // A colour is not read. With seven numbers it has an opacity.
    if !matches!(words.len(), 3 | 4 | 6 | 7) {
        return Err(Fault::new(format!("{} numbers in 'v {}'", words.len(), shown()), VERTEX));
    }
    let [x, y, z] = [number(words[0])?, number(words[1])?, number(words[2])?];
    let weight = if words.len() == 4 { number(words[3])? } else { 1.0 };
    if weight == 0.0 || weight.is_nan() {
        return Err(Fault::new(format!("the weight '{}' in 'v {}'", quoted(words[3]), shown()), VERTEX));
    }
    let point = [x / weight, y / weight, z / weight];
    if [x, y, z]
        .iter()
        .zip(&point)
        .any(|(x, quotient)| *x != 0.0 && *quotient == 0.0 || x.is_finite() && !quotient.is_finite())
    {
        let found = format!("'v {}': a coordinate divided by its weight leaves the range of binary64", shown());
        return Err(Fault::new(found, VERTEX));
    }
    Ok(point)
}

/// Takes a face of which each corner is a number of a vertex, or several with slashes between them, of which the first counts.
fn face(builder: &mut Builder, seen: i64, line: usize, corners: &[&str]) -> Result<(), Fault> {
    let vertices = builder.vertices() as i64;
    let mut places = Vec::with_capacity(corners.len());
    let mut bad = None;
    for corner in corners {
        let index = corner.split('/').next().and_then(|word| word.parse::<i64>().ok());
        match index {
            Some(0) => {
                let found = format!("vertex 0 in 'f {}'", quoted(&corners.join(" ")));
                let legal =
                    "expected vertices counted from 1: counted from 0, every face of the file would be one vertex off";
                return Err(Fault::new(found, legal).at(line));
            }
            Some(i) if (1..=vertices).contains(&i) => places.push((i - 1) as u32),
            Some(i) if (-seen..0).contains(&i) => places.push((seen + i) as u32),
            _ => bad = bad.or(Some(corner)),
        }
    }
    let fault = |found: String| Fault::new(found, FACE).at(line);
    if corners.len() < 3 {
        builder.left_out(Defect::FewCorners, fault(format!("a face of {} vertices", corners.len())));
    } else if let Some(corner) = bad {
        builder.left_out(Defect::OutOfRange, fault(format!("vertex '{}' in a file of {vertices}", quoted(corner))));
    } else {
        builder.face(&places, Some(line))?;
    }
    Ok(())
}
