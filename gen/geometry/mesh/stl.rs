//! STL, binary and ASCII, with the crate `stl_io`. Coordinates are binary32 in both; binary64 holds them exactly.

use super::error::Fault;
use super::lines::{LineReader, line_before};
use super::{Defect, Mesh, Parsed};
use nalgebra::Point3;
use std::cell::Cell;
use std::collections::HashMap;
use std::io::Cursor;

/// Bytes before the first triangle of a binary file: a free text and the number of triangles.
const HEADER: usize = 84;
/// Bytes of a triangle: normal, three vertices and an attribute.
const TRIANGLE: u64 = 50;

/// Reads the bytes of an STL file.
///
/// A binary file may start with the word `solid` as an ASCII file must, so the size decides: that of a binary file is
/// known from its triangle count. The count is not believed before it has been checked against the size.
pub(super) fn parse(bytes: &[u8]) -> Result<Parsed, Fault> {
    let count = bytes.get(HEADER - 4..HEADER).and_then(|b| b.try_into().ok()).map(u32::from_le_bytes);
    let promised = count.map(|n| HEADER as u64 + TRIANGLE * u64::from(n));
    let (mut mesh, mut faults) = (Indexer::default(), vec![]);
    if promised == Some(bytes.len() as u64) {
        faults = binary(bytes, &mut mesh)?;
    } else if is_text(bytes) {
        // Keywords are written in capitals by some programs; names may be in any encoding.
        ascii(&String::from_utf8_lossy(bytes).to_ascii_lowercase(), &mut mesh)?;
    } else {
        let legal = "expected binary STL of 84 + 50 n bytes or ASCII STL starting with 'solid'";
        let size = bytes.len();
        return Err(match (count, promised) {
            _ if size == 0 => Fault::new("empty file", legal),
            (Some(n), Some(p)) => Fault::new(format!("{size} bytes where {n} triangles take {p}"), legal),
            _ => Fault::new(format!("{size} bytes, less than the header of a binary STL"), legal),
        });
    }
    if mesh.mesh.faces.is_empty() && faults.is_empty() {
        return Err(Fault::new("no triangle", "expected at least one"));
    }
    Ok(Parsed { mesh: mesh.mesh, faults })
}

/// Whether the content can be ASCII STL. A zero byte tells a damaged binary file whose header starts with `solid`.
fn is_text(bytes: &[u8]) -> bool {
    let start = bytes.trim_ascii_start();
    start.len() >= 5 && start[..5].eq_ignore_ascii_case(b"solid") && !bytes.contains(&0)
}

/// Stores the triangles that are finite and returns the faults of the others.
fn binary(bytes: &[u8], mesh: &mut Indexer) -> Result<Vec<(Defect, Fault)>, Fault> {
    let legal = "expected binary STL of 84 + 50 n bytes";
    // The crate tells the formats apart by the word `solid`; the header carries nothing, so it is blanked.
    let blank = [&[0; HEADER - 4], &bytes[HEADER - 4..]].concat();
    let mut reader = Cursor::new(blank);
    let triangles = stl_io::create_stl_reader(&mut reader).map_err(|e| Fault::new(e.to_string(), legal))?;
    let mut faults = vec![];
    for (number, triangle) in triangles.enumerate() {
        let triangle = triangle.map_err(|e| Fault::new(e.to_string(), legal))?;
        if let Some(x) = triangle.vertices.iter().flat_map(|v| v.0).find(|x| !x.is_finite()) {
            let fault = Fault::new(format!("triangle {number} has the coordinate {x}"), "expected a finite number");
            faults.push((Defect::NonFinite, fault));
        } else {
            mesh.push(&triangle);
        }
    }
    Ok(faults)
}

/// An ASCII file may hold several solids, one after the other; the crate reads one.
fn ascii(text: &str, mesh: &mut Indexer) -> Result<(), Fault> {
    let position = Cell::new(0);
    while let Some(line) = next_line(text, &position) {
        if line.split_whitespace().next() != Some("solid") {
            let fault = Fault::new(format!("'{}'", line.trim()), "expected 'solid' and a name");
            return Err(fault.at(line_before(text, position.get())));
        }
        // Its header line must be "solid " to the letter, so it is given one; the name carries nothing.
        let mut reader = LineReader::new("solid \n", text, &position);
        let fault = |e: std::io::Error| {
            let legal = "expected facet normal, outer loop, three lines 'vertex x y z' in finite numbers, endloop, \
                         endfacet; endsolid at the end";
            Fault::new(e.to_string(), legal).at(line_before(text, position.get()))
        };
        for triangle in stl_io::create_stl_reader(&mut reader).map_err(fault)? {
            mesh.push(&triangle.map_err(fault)?);
        }
    }
    Ok(())
}

/// The next line that is not blank; `position` moves behind it.
fn next_line<'a>(text: &'a str, position: &Cell<usize>) -> Option<&'a str> {
    text[position.get()..].split_inclusive('\n').find(|line| {
        position.set(position.get() + line.len());
        !line.trim().is_empty()
    })
}

/// A mesh under construction that stores vertices equal bit for bit once.
#[derive(Default)]
struct Indexer {
    mesh: Mesh,
    known: HashMap<[u32; 3], u32>,
}

impl Indexer {
    fn push(&mut self, triangle: &stl_io::Triangle) {
        let Self { mesh, known } = self;
        let face = triangle.vertices.map(|v| {
            *known.entry(v.0.map(f32::to_bits)).or_insert_with(|| {
                mesh.vertices.push(Point3::from(v.0.map(f64::from)));
                mesh.vertices.len() as u32 - 1
            })
        });
        mesh.faces.push(face);
    }
}
