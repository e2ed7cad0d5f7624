//! The header of a PLY file.

use crate::mesh::error::Fault;
use crate::mesh::text::{quoted, without_mark};

const LEGAL: &str = "expected a PLY header with the elements vertex (x, y, z) and face or tristrips (vertex_indices)";
/// Beyond this a header is none.
const MOST_BYTES: usize = 1 << 20;

/// How numbers are written.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Encoding {
    Text,
    Binary { big: bool },
}

/// The type of a number.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    I64,
    U64,
    F32,
    F64,
}

impl Kind {
    fn of(word: &str) -> Option<Self> {
        Some(match word {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "int64" | "long" | "longlong" => Self::I64,
            "uint64" | "ulong" | "ulonglong" => Self::U64,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return None,
        })
    }

    /// The bytes of a number.
    pub fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::I64 | Self::U64 | Self::F64 => 8,
        }
    }

    fn is_whole(self) -> bool {
        !matches!(self, Self::F32 | Self::F64)
    }
}

/// A property of an element: a number, or a list whose count has a type of its own.
pub(super) struct Property {
    pub name: String,
    pub kind: Kind,
    pub list: Option<Kind>,
}

impl Property {
    /// Whether this is the list of the vertices of a face.
    pub fn is_corners(&self) -> bool {
        ["vertex_indices", "vertex_index"].contains(&self.name.as_str())
    }
}

/// A kind of element, and how many of it follow.
pub(super) struct Element {
    pub name: String,
    pub count: u64,
    pub properties: Vec<Property>,
    /// Whether it is one whose list of vertices is read.
    pub has_corners: bool,
}

/// The header.
pub(super) struct Header {
    pub encoding: Encoding,
    pub elements: Vec<Element>,
}

impl Header {
    /// Reads the header; the bytes behind it, and the number of its lines.
    pub fn read(bytes: &[u8]) -> Result<(Self, &[u8], usize), Fault> {
        let mut rest = without_mark(bytes);
        let (mut encoding, mut elements) = (None, vec![]);
        // A line feed may be the first byte of binary numbers behind a lone carriage return: all lines end as the first does.
        let pairs = rest
            .iter()
            .position(|byte| matches!(byte, b'\n' | b'\r'))
            .is_some_and(|at| rest[at..].starts_with(b"\r\n"));
        for line in 1.. {
            let end = rest.iter().take(MOST_BYTES).position(|byte| matches!(byte, b'\n' | b'\r'));
            let text = String::from_utf8_lossy(&rest[..end.unwrap_or(rest.len().min(MOST_BYTES))]);
            let words: Vec<&str> = text.split_whitespace().collect();
            let found = || format!("'{}'", quoted(text.trim()));
            let fault = |found: String| Fault::new(found, LEGAL).at(line);
            match words[..] {
                ["ply"] if line == 1 => {}
                _ if line == 1 => return Err(fault(format!("{} for 'ply'", found()))),
                [] | ["comment" | "obj_info", ..] => {}
                ["format", word, "1.0"] if encoding.is_none() => {
                    encoding = Some(match word {
                        "ascii" => Encoding::Text,
                        "binary_little_endian" => Encoding::Binary { big: false },
                        "binary_big_endian" => Encoding::Binary { big: true },
                        _ => return Err(fault(found())),
                    });
                }
                ["element", name, count] => {
                    let count = count.parse().map_err(|_| fault(found()))?;
                    let element = Element { name: name.to_owned(), count, properties: vec![], has_corners: false };
                    if elements.iter().any(|known: &Element| known.name == name) {
                        return Err(fault(format!("a second {}", found())));
                    }
                    elements.push(element);
                }
                ["property", ref kinds @ .., name] if matches!(kinds.len(), 1 | 3) => {
                    let property = property(kinds, name).ok_or_else(|| fault(found()))?;
                    let element = elements.last_mut().ok_or_else(|| fault(format!("{} before an element", found())))?;
                    if element.properties.iter().any(|known| known.name == name) {
                        return Err(fault(format!("a second {}", found())));
                    }
                    element.properties.push(property);
                }
                ["end_header"] if end.is_some() => {}
                _ if end.is_none() => return Err(fault("the file ends before 'end_header'".to_owned())),
                _ => return Err(fault(found())),
            }
            let Some(end) = end else { return Err(fault("the file ends before 'end_header'".to_owned())) };
            let by = if rest[end] == b'\r' && pairs && rest.get(end + 1) == Some(&b'\n') { 2 } else { 1 };
            let is_last = words == ["end_header"];
            rest = &rest[end + by..];
            if is_last {
                let encoding = encoding.ok_or_else(|| fault("no line 'format'".to_owned()))?;
                return Ok((Self::checked(encoding, elements)?, rest, line));
            }
        }
        unreachable!("a file has an end")
    }

    /// The header must declare coordinates and faces in a shape that can be used.
    fn checked(encoding: Encoding, mut elements: Vec<Element>) -> Result<Self, Fault> {
        let fault = |found: String| Fault::new(found, LEGAL);
        let vertex = elements.iter().find(|element| element.name == "vertex");
        let vertex = vertex.ok_or_else(|| fault("no element vertex".to_owned()))?;
        for axis in ["x", "y", "z"] {
            if !vertex.properties.iter().any(|property| property.name == axis && property.list.is_none()) {
                return Err(fault(format!("no number {axis} of a vertex")));
            }
        }
        let mut any = false;
        for element in elements.iter_mut().filter(|element| ["face", "tristrips"].contains(&element.name.as_str())) {
            let is_list =
                |property: &Property| property.is_corners() && property.list.is_some() && property.kind.is_whole();
            element.has_corners = element.properties.iter().filter(|property| is_list(property)).count() == 1;
            if !element.has_corners {
                return Err(fault(format!("no list of vertex indices of a {}", element.name)));
            }
            any = true;
        }
        if !any {
            return Err(fault("no element face".to_owned()));
        }
        Ok(Self { encoding, elements })
    }
}

fn property(kinds: &[&str], name: &str) -> Option<Property> {
    let (kind, list) = match kinds {
        ["list", count, kind] => (kind, Some(Kind::of(count).filter(|count| count.is_whole())?)),
        [kind] => (kind, None),
        _ => return None,
    };
    Some(Property { name: name.to_owned(), kind: Kind::of(kind)?, list })
}
