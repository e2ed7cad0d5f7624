//! PLY, as text and binary: the elements `vertex` (x, y, z), `face` (a list of vertices counted from 0) and `tristrips` (a list
//! with -1 between strips); everything else in such a file is skipped.

mod header;
mod values;

use super::build::{Builder, located};
use super::error::Fault;
use super::{Defect, Parsed};
use header::{Element, Encoding, Header};
use values::{Binary, Text};

const VERTEX: &str = "expected a vertex as the header declares it, x, y and z in decimal numbers";
const LIST: &str = "expected a list as the header declares it: a count, and as many numbers";
const FACE: &str = "expected three or more indices of vertices, counted from 0";

/// What a payload gives, number by number.
trait Values {
    /// Where the value is that is read next, or was read last, if there are lines.
    fn line(&self) -> Option<usize>;
    /// The next number as a coordinate. An error says what was found.
    fn coordinate(&mut self, kind: header::Kind) -> Result<f64, String>;
    /// The next number as a count or an index.
    fn whole(&mut self, kind: header::Kind) -> Result<i64, String>;
    /// Passes over numbers.
    fn skip(&mut self, kind: header::Kind, count: u64) -> Result<(), String>;
    /// Whether the payload has as many numbers left.
    fn has(&self, kind: header::Kind, count: u64) -> bool;
    /// Ends an element: what stands behind it where the next has to begin.
    fn end(&mut self) -> Result<(), String>;
    /// What is left behind the last element.
    fn left(&mut self) -> Option<String>;
}

/// Lists of corners, which may stand before the vertices.
#[derive(Default)]
struct Lists {
    corners: Vec<i64>,
    /// Where each list ends, and its line.
    ends: Vec<(usize, Option<usize>)>,
}

impl Lists {
    fn iter(&self) -> impl Iterator<Item = (&[i64], Option<usize>)> {
        let starts = std::iter::once(0).chain(self.ends.iter().map(|(end, _)| *end));
        starts.zip(&self.ends).map(|(start, (end, line))| (&self.corners[start..*end], *line))
    }
}

/// Reads the bytes of a PLY file.
pub(super) fn parse(bytes: &[u8]) -> Result<Parsed, Fault> {
    let (header, rest, lines) = Header::read(bytes)?;
    match header.encoding {
        Encoding::Text => elements(&header, &mut Text::new(rest, lines)?),
        Encoding::Binary { big } => elements(&header, &mut Binary::new(rest, big)),
    }
}

fn elements(header: &Header, values: &mut impl Values) -> Result<Parsed, Fault> {
    let mut builder = Builder::new(0);
    let (mut faces, mut strips) = (Lists::default(), Lists::default());
    for element in &header.elements {
        match element.name.as_str() {
            // Nothing to read, however many there are.
            _ if element.properties.is_empty() => {}
            "vertex" => vertices(element, values, &mut builder)?,
            "face" => lists(element, values, &mut faces)?,
            "tristrips" => lists(element, values, &mut strips)?,
            _ => {
                (0..element.count).try_for_each(|number| read(element, number, values, None, &mut vec![]).map(drop))?
            }
        }
    }
    if let Some(left) = values.left() {
        builder.remark("what stands behind the last element, not read", || left);
    }
    let count = builder.vertices();
    let place = |corner: i64| usize::try_from(corner).ok().filter(|place| *place < count).map(|place| place as u32);
    for (number, (corners, line)) in faces.iter().enumerate() {
        let fault = |found: String| located(Fault::new(format!("face {number} has {found}"), FACE), line);
        if corners.len() < 3 {
            builder.left_out(Defect::FewCorners, fault(format!("{} vertices", corners.len())));
        } else if let Some(bad) = corners.iter().find(|corner| place(**corner).is_none()) {
            builder.left_out(Defect::OutOfRange, fault(format!("vertex {bad} in a file of {count}")));
        } else {
            builder.face(&corners.iter().filter_map(|corner| place(*corner)).collect::<Vec<_>>(), line)?;
        }
    }
    for (corners, line) in strips.iter() {
        for strip in corners.split(|corner| *corner == -1).filter(|strip| !strip.is_empty()) {
            if let Some(bad) = strip.iter().find(|corner| place(**corner).is_none()) {
                let found = format!("a strip has vertex {bad} in a file of {count}");
                builder.left_out(Defect::OutOfRange, located(Fault::new(found, FACE), line));
            } else {
                builder.strip(&strip.iter().filter_map(|corner| place(*corner)).collect::<Vec<_>>(), line)?;
            }
        }
    }
    if faces.ends.is_empty() && strips.ends.is_empty() {
        return Err(Fault::new("no face", "expected at least one"));
    }
    Ok(builder.finish())
}

fn vertices(element: &Element, values: &mut impl Values, builder: &mut Builder) -> Result<(), Fault> {
    for number in 0..element.count {
        let mut point = [0.0; 3];
        let line = read(element, number, values, Some(&mut point), &mut vec![])?;
        builder.vertex(point, line)?;
    }
    Ok(())
}

fn lists(element: &Element, values: &mut impl Values, lists: &mut Lists) -> Result<(), Fault> {
    for number in 0..element.count {
        let line = read(element, number, values, None, &mut lists.corners)?;
        lists.ends.push((lists.corners.len(), line));
    }
    Ok(())
}

/// Reads an element: the coordinates if it has any that are wanted, and its list of vertices. Its line.
fn read(
    element: &Element,
    number: u64,
    values: &mut impl Values,
    mut point: Option<&mut [f64; 3]>,
    corners: &mut Vec<i64>,
) -> Result<Option<usize>, Fault> {
    let mut first = None;
    let mut begun = false;
    for property in &element.properties {
        let legal = if point.is_some() { VERTEX } else { LIST };
        let fault = |found: String, line: Option<usize>| {
            let what = format!("{} {number}, {}: {found}", element.name, property.name);
            located(Fault::new(what, legal), line)
        };
        let axis = ["x", "y", "z"].iter().position(|axis| *axis == property.name);
        let read = match (property.list, axis, point.as_deref_mut()) {
            (None, Some(axis), Some(point)) => values.coordinate(property.kind).map(|x| point[axis] = x),
            (None, ..) => values.skip(property.kind, 1),
            (Some(count), ..) => values.whole(count).and_then(|count| {
                let count = u64::try_from(count).map_err(|_| format!("a list of {count} numbers"))?;
                if !values.has(property.kind, count) {
                    return Err(format!("a list of {count} numbers, which the file does not have"));
                }
                if element.has_corners && property.is_corners() {
                    (0..count).try_for_each(|_| values.whole(property.kind).map(|corner| corners.push(corner)))
                } else {
                    values.skip(property.kind, count)
                }
            }),
        };
        read.map_err(|found| fault(found, values.line()))?;
        if !begun {
            (first, begun) = (values.line(), true);
        }
    }
    values
        .end()
        .map_err(|found| located(Fault::new(format!("{} {number}: {found}", element.name), VERTEX), values.line()))?;
    Ok(first)
}
