//! OFF, the Object File Format of Geomview, as text: vertices of three coordinates, and faces. Normals, colours and texture
//! coordinates are skipped.

use super::build::Builder;
use super::error::Fault;
use super::text::{Lines, Words, number, quoted};
use super::{Defect, Parsed};

/// First words of a file whose vertices have three coordinates.
pub(super) const KEYWORDS: [&str; 8] = ["OFF", "COFF", "NOFF", "CNOFF", "STOFF", "STCOFF", "STNOFF", "STCNOFF"];

const HEADER: &str =
    "expected 'OFF' (or COFF, NOFF, STOFF and their combinations), then the numbers of vertices, faces and edges";
const VERTEX: &str = "expected the three coordinates of a vertex in decimal numbers";
const FACE: &str = "expected a number of corners, and as many vertices, counted from 0";
/// Numbers of a colour.
const COLOUR: usize = 4;

/// Reads the bytes of an OFF file. A vertex and a face begin on a line of their own and may go on to the next.
pub(super) fn parse(bytes: &[u8]) -> Result<Parsed, Fault> {
    if bytes.is_empty() {
        return Err(Fault::new("empty file", HEADER));
    }
    let mut words = Words::new(Lines::new(bytes)?, true);
    let keyword = keyword(&mut words)?;
    let mut count = |what: &str| {
        let word = words.next();
        let count = word.as_deref().and_then(|word| word.parse::<u32>().ok());
        let found = || format!("{} for the number of {what}", shown(word.as_deref()));
        count.ok_or_else(|| Fault::new(found(), HEADER).at(words.line()))
    };
    let (vertices, faces) = (count("vertices")?, count("faces")?);
    // The number of edges, which some files leave out, is not used.
    let edges = words.rest_of_line();
    if edges.len() > 1 || edges.iter().any(|word| word.parse::<u64>().is_err()) {
        return Err(
            Fault::new(format!("'{}' behind the number of faces", quoted(&edges.join(" "))), HEADER).at(words.line())
        );
    }
    let mut builder = Builder::new(0);
    for number in 0..vertices {
        vertex(&mut builder, &mut words, number, vertices, keyword)?;
    }
    for number in 0..faces {
        face(&mut builder, &mut words, number, faces)?;
    }
    if let Some(word) = words.next() {
        let line = words.line();
        builder.remark("text behind the last face, not read", || format!("line {line}: '{}'", quoted(&word)));
    }
    if faces == 0 {
        return Err(Fault::new("no face", "expected at least one"));
    }
    Ok(builder.finish())
}

fn shown(word: Option<&str>) -> String {
    word.map_or("the end of the file".to_owned(), |word| format!("'{}'", quoted(word)))
}

/// The first word, which some files write without a blank before the numbers, and some leave out.
fn keyword(words: &mut Words<'_>) -> Result<&'static str, Fault> {
    let first = words.next().unwrap_or_default();
    let split = first.find(|c: char| c.is_ascii_digit()).unwrap_or(first.len());
    let (word, digits) = first.split_at(split);
    if !digits.is_empty() {
        words.back(vec![digits.to_owned()]);
    }
    let found = match KEYWORDS.into_iter().find(|known| *known == word) {
        Some(known) => Ok(known),
        None if word.is_empty() && !digits.is_empty() && digits.bytes().all(|c| c.is_ascii_digit()) => Ok("OFF"),
        None => Err(Fault::new(shown(Some(&first)), HEADER).at(words.line())),
    }?;
    if digits.is_empty() {
        let rest = words.rest_of_line();
        if rest.first().is_some_and(|word| word == "BINARY") {
            return Err(Fault::new("binary OFF", "expected OFF as text").at(words.line()));
        }
        words.back(rest);
    }
    Ok(found)
}

fn vertex(builder: &mut Builder, words: &mut Words<'_>, index: u32, of: u32, keyword: &str) -> Result<(), Fault> {
    let mut point = [0.0; 3];
    let mut first = None;
    for (axis, x) in point.iter_mut().enumerate() {
        // Words of the next line would make one vertex of two, and shift all behind it.
        let word = if axis == 0 { words.next() } else { words.here() };
        let fault = |found: String| Fault::new(format!("vertex {index}: {found}"), VERTEX).at(words.line());
        let word = word.ok_or_else(|| {
            fault(if axis == 0 {
                format!("the file ends before it, of {of}")
            } else {
                format!("a line of {axis} numbers")
            })
        })?;
        *x = number(&word).map_err(|wrong| fault(format!("{wrong} is no number")))?;
        first = first.or(Some(words.line()));
    }
    let rest = words.rest_of_line();
    if keyword == "OFF" && !rest.is_empty() {
        let line = words.line();
        builder.remark("numbers behind the coordinates of a vertex, not read", || {
            format!("line {line}: '{}'", quoted(&rest.join(" ")))
        });
    }
    builder.vertex(point, first)
}

fn face(builder: &mut Builder, words: &mut Words<'_>, index: u32, of: u32) -> Result<(), Fault> {
    let vertices = builder.vertices();
    let word = words.next();
    let line = words.line();
    let fault = |found: String, line: usize| Fault::new(format!("face {index}{found}"), FACE).at(line);
    let word = word.ok_or_else(|| fault(format!(": the file ends before it, of {of}"), line))?;
    let count: usize = word.parse().map_err(|_| fault(format!(": {} corners", shown(Some(&word))), line))?;
    let mut corners = vec![];
    let mut bad = None;
    for _ in 0..count {
        let word = words.next();
        let word = word.ok_or_else(|| fault(": the file ends within it".to_owned(), words.line()))?;
        match word.parse::<i64>() {
            Ok(i) if (0..vertices as i64).contains(&i) => corners.push(i as u32),
            Ok(i) => bad = bad.or(Some(i)),
            Err(_) => return Err(fault(format!(": vertex {}", shown(Some(&word))), words.line())),
        }
    }
    let rest = words.rest_of_line();
    if rest.len() > COLOUR {
        let line = words.line();
        builder.remark("words behind the corners of a face that are no colour, not read", || {
            format!("line {line}: '{}'", quoted(&rest.join(" ")))
        });
    }
    if count < 3 {
        builder.left_out(Defect::FewCorners, fault(format!(" has {count} vertices"), line));
    } else if let Some(bad) = bad {
        builder.left_out(Defect::OutOfRange, fault(format!(" has vertex {bad} in a file of {vertices}"), line));
    } else {
        builder.face(&corners, Some(line))?;
    }
    Ok(())
}
