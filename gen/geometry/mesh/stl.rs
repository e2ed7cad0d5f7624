//! STL, binary and as text. Binary coordinates are binary32, which binary64 holds exactly; a decimal in a text stands for the
//! nearest binary64 number. Normals and attributes are not read.

use super::build::{Builder, FINITE};
use super::error::Fault;
use super::text::{Lines, Words, number, quoted, without_mark};
use super::{Defect, Parsed};
use std::collections::HashMap;

/// Bytes before the first triangle of a binary file: a free text and the number of triangles.
const HEADER: usize = 84;
/// Bytes of a triangle: normal, three vertices and an attribute.
const TRIANGLE: usize = 50;

const FACET: &str = "expected 'facet normal', 'outer loop', three times 'vertex x y z' in decimal numbers, 'endloop', 'endfacet'; \
                     'endsolid' at the end";

/// Reads the bytes of an STL file.
///
/// A binary file may start with the word `solid` as a text must, so the size decides: that of a binary file is known from its
/// triangle count. The count is not believed before it has been checked against the size.
pub(super) fn parse(bytes: &[u8]) -> Result<Parsed, Fault> {
    let legal = "expected binary STL of 84 + 50 n bytes or ASCII STL starting with 'solid'";
    let size = bytes.len();
    let mut mesh = Indexer { builder: Builder::new(0), known: HashMap::new() };
    let count = count(bytes);
    let promised = count.map(|count| HEADER as u64 + TRIANGLE as u64 * u64::from(count));
    match (count, promised) {
        (Some(count), Some(promised)) if promised == size as u64 && !(count == 0 && is_text(bytes)) => {
            binary(bytes, &mut mesh)?
        }
        _ if is_text(bytes) => text(bytes, &mut mesh)?,
        _ if size == 0 => return Err(Fault::new("empty file", legal)),
        _ if !bytes.iter().any(|byte| byte.is_ascii_control() && !byte.is_ascii_whitespace()) => {
            let mut words = Words::new(Lines::new(bytes)?, false);
            let first = words.next().unwrap_or_default();
            return Err(
                Fault::new(format!("text that begins with '{}'", quoted(&first)), legal).at(words.line().max(1))
            );
        }
        (Some(0), Some(_)) if (size - HEADER).is_multiple_of(TRIANGLE) => {
            let triangles = (size - HEADER) / TRIANGLE;
            mesh.builder
                .remark("the header counts 0 triangles", || format!("as many as the size tells are read: {triangles}"));
            binary(bytes, &mut mesh)?;
        }
        (Some(1..), Some(promised)) if promised < size as u64 => {
            let behind = size as u64 - promised;
            mesh.builder.remark("bytes behind the last triangle, not read", || behind.to_string());
            binary(&bytes[..promised as usize], &mut mesh)?;
        }
        (Some(n), Some(p)) => return Err(Fault::new(format!("{size} bytes where {n} triangles take {p}"), legal)),
        _ => return Err(Fault::new(format!("{size} bytes, less than the header of a binary STL"), legal)),
    }
    if mesh.builder.faces() == 0 {
        return Err(Fault::new("no triangle", "expected at least one"));
    }
    Ok(mesh.builder.finish())
}

/// The number of triangles in the header of a binary file.
fn count(bytes: &[u8]) -> Option<u32> {
    bytes.get(HEADER - 4..HEADER).and_then(|b| b.try_into().ok()).map(u32::from_le_bytes)
}

/// Whether the content can be ASCII STL. A zero byte tells a damaged binary file whose header starts with `solid`.
fn is_text(bytes: &[u8]) -> bool {
    let start = without_mark(bytes).trim_ascii_start();
    start.len() >= 5 && start[..5].eq_ignore_ascii_case(b"solid") && !bytes.contains(&0)
}

/// Whether the content is STL whatever the file is called: as many bytes as its triangles take, or a text of facets.
pub(super) fn is_surely(bytes: &[u8]) -> bool {
    let begins = |line: &str| line.split_whitespace().next().is_some_and(|word| word.eq_ignore_ascii_case("facet"));
    let has_size = |count: u32| count > 0 && bytes.len() as u64 == HEADER as u64 + TRIANGLE as u64 * u64::from(count);
    let has_facet = || Lines::new(bytes).is_ok_and(|lines| lines.take(8).any(|line| begins(&line.text)));
    bytes.contains(&0) && count(bytes).is_some_and(has_size) || is_text(bytes) && has_facet()
}

fn binary(bytes: &[u8], mesh: &mut Indexer) -> Result<(), Fault> {
    for (number, triangle) in bytes[HEADER..].chunks_exact(TRIANGLE).enumerate() {
        let coordinate = |i: usize| f32::from_le_bytes([0, 1, 2, 3].map(|byte| triangle[12 + 4 * i + byte])).into();
        let corners = [0, 1, 2].map(|corner| [0, 1, 2].map(|axis| coordinate(3 * corner + axis)));
        mesh.push(corners, |x| Fault::new(format!("triangle {number} has the coordinate {x}"), FINITE))?;
    }
    Ok(())
}

/// The facets of a text; there may be several solids, one after the other.
fn text(bytes: &[u8], mesh: &mut Indexer) -> Result<(), Fault> {
    let mut words = Words::new(Lines::new(bytes)?, false);
    while let Some(word) = words.next() {
        if !word.eq_ignore_ascii_case("solid") {
            return Err(Fault::new(format!("'{}'", quoted(&word)), "expected 'solid' and a name").at(words.line()));
        }
        name(&mut words);
        solid(&mut words, mesh)?;
    }
    Ok(())
}

/// Passes over the name of a solid, which ends with the line, or before a facet on it; the words of the name.
fn name(words: &mut Words<'_>) -> Vec<String> {
    let mut name = vec![];
    while let Some(word) = words.here() {
        let is_next = |word: &str, last: Option<&String>| {
            word.eq_ignore_ascii_case("normal") && last.is_some_and(|last| last.eq_ignore_ascii_case("facet"))
        };
        if is_next(&word, name.last()) {
            words.back(name.split_off(name.len() - 1).into_iter().chain([word]).collect());
            break;
        }
        name.push(word);
    }
    name
}

/// The facets of a solid, up to its end.
fn solid(words: &mut Words<'_>, mesh: &mut Indexer) -> Result<(), Fault> {
    loop {
        match &keyword(words)?[..] {
            "facet" => facet(words, mesh)?,
            "endsolid" => {
                let line = words.line();
                let mut name = name(words);
                // The next solid on the same line.
                if let Some(facet) = words.here() {
                    let solid = name.iter().rposition(|word| word.eq_ignore_ascii_case("solid"));
                    let solid = solid.ok_or_else(|| Fault::new("a facet behind 'endsolid'", FACET).at(line))?;
                    words.back(name.split_off(solid).into_iter().chain([facet]).collect());
                }
                return Ok(());
            }
            other => return Err(unexpected("facet' or 'endsolid", other, words)),
        }
    }
}

fn facet(words: &mut Words<'_>, mesh: &mut Indexer) -> Result<(), Fault> {
    // The normal is not read: a word and three numbers, whatever they are.
    let mut word = keyword(words)?;
    for _ in 0..4 {
        if word != "outer" {
            word = keyword(words)?;
        }
    }
    if word != "outer" {
        return Err(unexpected("outer loop", &word, words));
    }
    let line = words.line();
    expect(words, "loop")?;
    let mut corners = [[0.0; 3]; 3];
    for corner in &mut corners {
        expect(words, "vertex")?;
        for x in corner {
            let word = words.next().ok_or_else(|| ends(words))?;
            let wrong = |wrong| Fault::new(format!("{wrong} is no number"), FACET).at(words.line());
            *x = number(&word).map_err(wrong)?;
        }
    }
    expect(words, "endloop")?;
    expect(words, "endfacet")?;
    mesh.push(corners, |x| Fault::new(format!("a corner has the coordinate {x}"), FINITE).at(line))
}

/// The next word in small letters; `end` and the word behind it are one.
fn keyword(words: &mut Words<'_>) -> Result<String, Fault> {
    let mut word = words.next().ok_or_else(|| ends(words))?.to_ascii_lowercase();
    if word == "end" {
        word += &words.here().unwrap_or_default().to_ascii_lowercase();
    }
    Ok(word)
}

fn expect(words: &mut Words<'_>, expected: &str) -> Result<(), Fault> {
    let word = keyword(words)?;
    if word == expected { Ok(()) } else { Err(unexpected(expected, &word, words)) }
}

fn unexpected(expected: &str, word: &str, words: &Words<'_>) -> Fault {
    Fault::new(format!("'{}' for '{expected}'", quoted(word)), FACET).at(words.line())
}

fn ends(words: &Words<'_>) -> Fault {
    Fault::new("the file ends before 'endsolid'", FACET).at(words.line())
}

/// Stores vertices that are equal bit for bit once.
struct Indexer {
    builder: Builder,
    known: HashMap<[u64; 3], u32>,
}

impl Indexer {
    /// Takes a triangle, if it is finite; `fault` names a coordinate that is not.
    fn push(&mut self, corners: [[f64; 3]; 3], fault: impl Fn(f64) -> Fault) -> Result<(), Fault> {
        let Self { builder, known } = self;
        if let Some(x) = corners.iter().flatten().find(|x| !x.is_finite()) {
            builder.left_out(Defect::NonFinite, fault(*x));
            return Ok(());
        }
        let mut face = [0; 3];
        for (place, corner) in face.iter_mut().zip(corners) {
            let next = builder.vertices() as u32;
            *place = *known.entry(corner.map(f64::to_bits)).or_insert(next);
            if *place == next {
                builder.vertex(corner, None)?;
            }
        }
        builder.face(&face, None)
    }
}
