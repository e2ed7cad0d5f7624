//! PLY, ASCII and binary, with the crate `ply-rs-bw`: the elements `vertex` (x, y, z) and `face` (a list of vertex
//! indices counted from 0); everything else in such a file is skipped.

use super::error::Fault;
use super::{Defect, Mesh, Parsed};
use nalgebra::Point3;
use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{
    ElementDef, Encoding, Header, Property, PropertyAccess, PropertyAccessResult, PropertyType, ScalarType,
};

const HEADER: &str = "expected a PLY header with the elements vertex (x, y, z) and face (vertex_indices)";
const ELEMENT: &str = "expected the numbers that the header declares";
const VERTEX: &str = "expected a finite number";
const FACE: &str = "expected three or more indices of vertices, counted from 0";

/// An element as read: a vertex, a face, or something else.
#[derive(Default)]
struct Element {
    point: [f64; 3],
    corners: Vec<i64>,
}

impl PropertyAccess for Element {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        if let Some(axis) = ["x", "y", "z"].iter().position(|axis| *axis == name) {
            self.point[axis] = scalar(&property);
        } else if is_corners(name) {
            self.corners = list(&property);
        } else {
            return PropertyAccessResult::Ignored;
        }
        PropertyAccessResult::Set
    }
}

fn is_corners(name: &str) -> bool {
    ["vertex_indices", "vertex_index"].contains(&name)
}

fn scalar(property: &Property) -> f64 {
    match *property {
        Property::Char(x) => x.into(),
        Property::UChar(x) => x.into(),
        Property::Short(x) => x.into(),
        Property::UShort(x) => x.into(),
        Property::Int(x) => x.into(),
        Property::UInt(x) => x.into(),
        Property::Float(x) => x.into(),
        Property::Double(x) => x,
        _ => f64::NAN,
    }
}

fn list(property: &Property) -> Vec<i64> {
    fn wide<T: Copy + Into<i64>>(values: &[T]) -> Vec<i64> {
        values.iter().map(|&x| x.into()).collect()
    }
    match property {
        Property::ListChar(v) => wide(v),
        Property::ListUChar(v) => wide(v),
        Property::ListShort(v) => wide(v),
        Property::ListUShort(v) => wide(v),
        Property::ListInt(v) => wide(v),
        Property::ListUInt(v) => wide(v),
        _ => vec![],
    }
}

/// Reads the bytes of a PLY file. A face of more than three corners becomes the triangle fan of its first one.
pub(super) fn parse(bytes: &[u8]) -> Result<Parsed, Fault> {
    let parser = Parser::<Element>::new();
    let mut reader = Reader::new(bytes);
    let header = parser.read_header(&mut reader).map_err(|e| header_fault(&e.to_string()))?;
    let rest = reader.into_inner();
    check(&header)?;
    let mut payload = Payload { lines: 1 + newlines(&bytes[..bytes.len() - rest.len()]), rest, header: &header };
    let (mut vertices, mut faces) = (vec![], vec![]);
    for element in header.elements.values() {
        for number in 0..element.count {
            let line = payload.line();
            let read = payload.element(&parser, element, number)?;
            match element.name.as_str() {
                "vertex" => vertices.push((Point3::from(read.point), line)),
                "face" => faces.push((read.corners, line)),
                _ => {}
            }
        }
    }
    Ok(build(&vertices, &faces))
}

/// The mesh of the elements, each with its line if the file has lines.
fn build(vertices: &[(Point3<f64>, Option<usize>)], faces: &[(Vec<i64>, Option<usize>)]) -> Parsed {
    let located = |fault: Fault, line: Option<usize>| line.into_iter().fold(fault, Fault::at);
    let mut parsed = Parsed { mesh: Mesh::default(), faults: vec![] };
    parsed.mesh.vertices = vertices.iter().map(|(point, _)| *point).collect();
    for (number, (corners, line)) in faces.iter().enumerate() {
        let mut fault = |defect, found: String| parsed.faults.push((defect, located(Fault::new(found, FACE), *line)));
        if corners.len() < 3 {
            fault(Defect::FewCorners, format!("face {number} has {} vertices", corners.len()));
        } else if let Some(bad) = corners.iter().find(|i| !(0..vertices.len() as i64).contains(*i)) {
            fault(Defect::OutOfRange, format!("face {number} has vertex {bad} in a file of {}", vertices.len()));
        } else {
            let fan = corners[1..].windows(2).map(|edge| [corners[0], edge[0], edge[1]].map(|i| i as u32));
            parsed.mesh.faces.extend(fan);
        }
    }
    parsed.without_non_finite(|vertex| {
        let (point, line) = &vertices[vertex];
        let bad = point.iter().find(|x| !x.is_finite()).unwrap_or(&f64::NAN);
        located(Fault::new(format!("vertex {vertex} has the coordinate {bad}"), VERTEX), *line)
    })
}

/// The crate's messages run over several lines, the first of which may begin with the line's number.
fn header_fault(message: &str) -> Fault {
    let first = message.lines().next().unwrap_or_default();
    let located = first.strip_prefix("Line ").and_then(|rest| rest.split_once(": "));
    match located.and_then(|(line, found)| Some((line.parse().ok()?, found))) {
        Some((line, found)) => Fault::new(found, HEADER).at(line),
        None => Fault::new(first, HEADER),
    }
}

/// The header must declare coordinates and faces in a shape that can be used.
fn check(header: &Header) -> Result<(), Fault> {
    let element = |name: &str| {
        header
            .elements
            .values()
            .find(|e| e.name == name)
            .ok_or_else(|| Fault::new(format!("no element {name}"), HEADER))
    };
    let (vertex, face) = (element("vertex")?, element("face")?);
    for axis in ["x", "y", "z"] {
        if !matches!(vertex.properties.get(axis).map(|p| &p.data_type), Some(PropertyType::Scalar(_))) {
            return Err(Fault::new(format!("no number {axis} of a vertex"), HEADER));
        }
    }
    let is_list = |kind: &PropertyType| matches!(kind, PropertyType::List(_, item) if !matches!(item, ScalarType::Float | ScalarType::Double));
    if !face.properties.iter().any(|(name, p)| is_corners(name) && is_list(&p.data_type)) {
        return Err(Fault::new("no list of vertex indices of a face", HEADER));
    }
    if face.count == 0 {
        return Err(Fault::new("no face", HEADER));
    }
    match header.elements.values().find(|e| e.properties.is_empty() && e.count > 0) {
        Some(e) => Err(Fault::new(format!("element {} without properties", e.name), HEADER)),
        None => Ok(()),
    }
}

fn newlines(bytes: &[u8]) -> usize {
    bytes.iter().filter(|&&byte| byte == b'\n').count()
}

/// What follows the header, element by element.
struct Payload<'a> {
    header: &'a Header,
    rest: &'a [u8],
    /// The number of the next line.
    lines: usize,
}

impl Payload<'_> {
    /// The line of the next element, if the file has lines.
    fn line(&self) -> Option<usize> {
        (self.header.encoding == Encoding::Ascii).then_some(self.lines)
    }

    fn element(&mut self, parser: &Parser<Element>, element: &ElementDef, number: usize) -> Result<Element, Fault> {
        let line = self.line();
        let fault = |found: String| {
            let fault = Fault::new(format!("{} {number}: {found}", element.name), ELEMENT);
            line.into_iter().fold(fault, Fault::at)
        };
        if self.rest.is_empty() {
            return Err(fault(format!("the file ends before it, of {}", element.count)));
        }
        let length = match line {
            Some(_) => self.rest.iter().position(|&byte| byte == b'\n').map_or(self.rest.len(), |end| end + 1),
            None => self.binary_length(element).ok_or_else(|| fault("the file ends within it".to_owned()))?,
        };
        let (bytes, rest) = self.rest.split_at(length);
        self.rest = rest;
        self.lines += 1;
        // The crate's messages run over several lines; the last one says what is wrong.
        let brief = |e: ParseError| fault(e.to_string().lines().last().unwrap_or_default().trim().to_owned());
        match self.header.encoding {
            Encoding::Ascii => {
                let text = String::from_utf8_lossy(bytes);
                if let Some(read) = without_number(&text, element, fault)? {
                    return Ok(read);
                }
                if !lists_fit(&text, element) {
                    return Err(fault("a list with fewer numbers than it announces".to_owned()));
                }
                parser.read_ascii_element(&text, element).map_err(brief)
            }
            Encoding::BinaryBigEndian => parser.read_big_endian_element(&mut &bytes[..], element).map_err(brief),
            Encoding::BinaryLittleEndian => parser.read_little_endian_element(&mut &bytes[..], element).map_err(brief),
        }
    }

    /// The bytes of the next element, if the file holds as many: the crate reserves what a list announces.
    fn binary_length(&self, element: &ElementDef) -> Option<usize> {
        let mut length = 0usize;
        for (_, property) in &element.properties {
            let (count, item) = match &property.data_type {
                PropertyType::Scalar(item) => (1, item),
                PropertyType::List(index, item) => {
                    let end = length.checked_add(size(index))?;
                    let bytes = self.rest.get(length..end)?;
                    length = end;
                    let push = |sum: usize, byte: &u8| sum << 8 | usize::from(*byte);
                    let count = match self.header.encoding {
                        Encoding::BinaryBigEndian => bytes.iter().fold(0, push),
                        _ => bytes.iter().rev().fold(0, push),
                    };
                    (count, item)
                }
            };
            length = length.checked_add(count.checked_mul(size(item))?)?;
        }
        (length <= self.rest.len()).then_some(length)
    }
}

/// A vertex with a coordinate that is not finite, which the crate does not read; a fault for what is no number.
fn without_number(line: &str, element: &ElementDef, fault: impl Fn(String) -> Fault) -> Result<Option<Element>, Fault> {
    let words: Vec<&str> = line.split_whitespace().collect();
    for word in &words {
        match word.parse::<f64>() {
            Ok(x) if x.is_finite() => {}
            Ok(x) if element.name == "vertex" && words.len() >= element.properties.len() => {
                return Ok(Some(Element { point: [x; 3], corners: vec![] }));
            }
            _ => return Err(fault(format!("'{word}' is no finite number"))),
        }
    }
    Ok(None)
}

/// Whether the lists of an ASCII element are not longer than its line: the crate reserves what a list announces.
fn lists_fit(line: &str, element: &ElementDef) -> bool {
    let words: Vec<&str> = line.split_whitespace().collect();
    let mut next = 0usize;
    element.properties.values().all(|property| {
        let count = match property.data_type {
            PropertyType::Scalar(_) => 0,
            PropertyType::List(..) => words.get(next).and_then(|word| word.parse().ok()).unwrap_or(0),
        };
        next = next.saturating_add(1).saturating_add(count);
        count == 0 || next <= words.len()
    })
}

/// The bytes of a number.
fn size(kind: &ScalarType) -> usize {
    match kind {
        ScalarType::Char | ScalarType::UChar => 1,
        ScalarType::Short | ScalarType::UShort => 2,
        ScalarType::Int | ScalarType::UInt | ScalarType::Float => 4,
        ScalarType::Double => 8,
    }
}
