//! Names for the widths that the entities of the engine share, and for the fields of their words.

use super::blocks::block_bits;
use super::traversal::{entry_bits, level_bits};
use super::{Bits, WORD, word_at};
use crate::artefact::{EngineDesign, host};
use crate::format::EngineFormat;
use crate::params::{EngineParams, Memory};
use crate::words::{QueryFlags, Reason};
use efsat_unit::design::top::pose_ports;
use efsat_unit::params::Upper;
use efsat_unit::words::{BYPASS_AT, PacketKind, TAG_AT};
use std::fmt;

/// A heading and what stands below it.
#[derive(Debug)]
pub(crate) struct Group {
    pub what: &'static str,
    pub items: Vec<Item>,
}

/// A name and what it stands for.
#[derive(Clone, Debug)]
pub(crate) struct Item {
    name: String,
    value: Value,
    /// A comment behind it, if it is not empty.
    pub what: &'static str,
}

#[derive(Clone, Debug)]
enum Value {
    Number(u32),
    Field(Bits),
    Reason(Reason),
}

/// The declaration in VHDL.
impl fmt::Display for Item {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = &self.name;
        match &self.value {
            Value::Number(number) => write!(f, "constant {name} : natural := {number};"),
            Value::Field(bits) => write!(f, "subtype {name} is natural range {bits};"),
            Value::Reason(reason) => {
                let code = *reason as u32;
                write!(f, "constant {name} : std_logic_vector(4 downto 0) := \"{code:05b}\";")
            }
        }
    }
}

fn number(name: impl Into<String>, number: u32, what: &'static str) -> Item {
    Item { name: name.into(), value: Value::Number(number), what }
}

/// So many bits from `low` on.
fn field(name: impl Into<String>, low: u32, bits: u32, what: &'static str) -> Item {
    Item { name: name.into(), value: Value::Field(Bits::new(low, bits)), what }
}

/// Fields of equal widths, each behind the one before.
fn fields<const N: usize>(names: [(&'static str, &'static str); N], from: u32, bits: u32) -> Vec<Item> {
    (0..).zip(names).map(|(i, (name, what))| field(name, from + bits * i, bits, what)).collect()
}

/// Entries of the matrix of a pose, row by row, and the axes of its shift.
pub(super) const ENTRIES: [&str; 9] = ["m00", "m01", "m02", "m10", "m11", "m12", "m20", "m21", "m22"];
pub(super) const AXES: [&str; 3] = ["x", "y", "z"];

/// All of them.
pub(super) fn groups(design: &EngineDesign) -> Vec<Group> {
    if design.by_number {
        return groups_by_number(design);
    }
    let (params, format) = (&design.params, &design.format);
    let mut groups = vec![
        Group { what: "Blocks and triangles, as they come from memory.", items: objects(design) },
        Group { what: "Queries in flight: each has a lane, the next query the next one.", items: lanes(params) },
        Group {
            what: "An entry of the stack: a pair of nodes. Children are 11 (both), 01 (left) or 10 (right).",
            items: entry(params),
        },
        Group { what: "Packets in: words counted from the header, which is word 0.", items: packets(format) },
        Group {
            what: "The words of a job: those of a query from word 1 on, the first in the low bits.",
            items: job(design),
        },
        Group { what: "The options of a query.", items: options() },
        Group {
            what: "The pose of a job, where that of a query is; a number takes the low bits of its place.",
            items: [pose(design, word_at(EngineFormat::POSE_AT)), shift(design)].concat(),
        },
        Group { what: "The last words of a job while they are a pair of a packet.", items: pair(design) },
        Group { what: "What the volume unit knows of a query.", items: query(format) },
        Group { what: "Reasons of a report.", items: reasons() },
    ];
    groups.push(match params.memory {
        Memory::Axi => {
            Group { what: "Memory.", items: vec![number("memory_width", params.memory_width, "bits of a word")] }
        }
        Memory::BlockRam => {
            let [blocks, triangles] = [params.block_lines.ilog2(), params.triangle_lines.ilog2()];
            let items = vec![
                number("block_line_bits", blocks, "of the number of a block in memory"),
                number("triangle_line_bits", triangles, "of a triangle"),
                number("load_line_bits", blocks.max(triangles), "of both"),
            ];
            Group { what: "Memory.", items }
        }
    });
    groups
}

/// Those that entities without a traversal have.
fn groups_by_number(design: &EngineDesign) -> Vec<Group> {
    let (params, format) = (&design.params, &design.format);
    let mut job = vec![number("job_bits", WORD * format.pose_words, "")];
    job.extend(pose(design, 0));
    let mut named = options().split_off(1);
    named.push(number("option_keep", QueryFlags::KEEP_CACHES, "no image has changed"));
    named.push(field("option_spare", QueryFlags::KEEP_CACHES + 1, 4, ""));
    let memory = match params.memory {
        Memory::Axi => number("memory_width", params.memory_width, "bits of a word"),
        Memory::BlockRam => {
            number("triangle_line_bits", params.triangle_lines.ilog2(), "of the number of a triangle in memory")
        }
    };
    vec![
        Group { what: "Triangles, as they come from memory.", items: triangles(design) },
        Group { what: "The pose of a packet; a number takes the low bits of its place.", items: job },
        Group { what: "The options of a packet, in its first word.", items: named },
        Group { what: "Reasons of a report.", items: reasons() },
        Group { what: "Memory.", items: vec![memory] },
    ]
}

fn objects(design: &EngineDesign) -> Vec<Item> {
    let blocks = number("block_bits", block_bits(&design.format), "");
    [vec![blocks], triangles(design)].concat()
}

fn triangles(design: &EngineDesign) -> Vec<Item> {
    let triangle = design.format.triangle();
    let mut items = vec![
        number("triangle_bits", triangle.bits, ""),
        field("triangle_number", 0, triangle.number_bits, ""),
        field("triangle_corners", triangle.lane, 9 * triangle.lane, "x, y and z of three corners"),
    ];
    items.extend(triangle.sticky_at.map(|at| field("triangle_sticky", at, 9, "a bit for each of these numbers")));
    items
}

fn lanes(params: &EngineParams) -> Vec<Item> {
    let engines = (params.engines > 1).then(|| number("engines", params.engines, "behind one stream"));
    let lanes =
        [number("lanes", params.queries, ""), number("lane_bits", params.lane_bits(), "of the number of a lane")];
    engines.into_iter().chain(lanes).collect()
}

fn entry(params: &EngineParams) -> Vec<Item> {
    let (node_bits, level_bits) = (params.block_number_bits, level_bits(params));
    let node_b = level_bits + 2;
    let node_a = node_b + node_bits + 2;
    vec![
        number("node_bits", node_bits, "of the number of a block"),
        number("level_bits", level_bits, ""),
        number("entry_bits", entry_bits(params), ""),
        field("entry_level", 0, level_bits, ""),
        field("entry_children_b", node_b - 2, 2, "which of them are to be tested"),
        field("entry_node_b", node_b, node_bits, ""),
        field("entry_children_a", node_a - 2, 2, ""),
        field("entry_node_a", node_a, node_bits, ""),
    ]
}

fn packets(format: &EngineFormat) -> Vec<Item> {
    vec![
        number("query_words", format.query_words(), "words of a query"),
        number("options_word", OPTIONS_WORD, "the word with the options of a query"),
        number("pose_word", EngineFormat::POSE_AT, "first word of its pose"),
        number("row_word", format.row_at(0), "first row; a pose and a pair are shifted to end before it, too"),
        number("pair_words", format.stream.record_words(PacketKind::Pairs), "words of a pair"),
    ]
}

/// The word with the options of a query.
const OPTIONS_WORD: u32 = 5;

fn job(design: &EngineDesign) -> Vec<Item> {
    let format = &design.format;
    let halves = [
        ("job_blocks_a", "where the blocks of A are: address / 64"),
        ("job_blocks_b", ""),
        ("job_triangles_a", ""),
        ("job_triangles_b", ""),
        ("job_block_count_a", "how many there are"),
        ("job_block_count_b", ""),
        ("job_triangle_count_a", ""),
        ("job_triangle_count_b", ""),
    ];
    let mut items = vec![number("job_bits", WORD * (format.query_words() - 1), "")];
    items.extend(fields(halves, word_at(1), WORD / 2));
    let options = word_at(OPTIONS_WORD);
    items.push(field("job_options", options, WORD, ""));
    items.push(number("head_bits", options + WORD, "of all up to here"));
    items.push(number("job_keep", options + QueryFlags::KEEP_CACHES, "of them: no image has changed"));
    let errors = 3 * format.shift_error_bits();
    items.push(field("job_errors", word_at(6), errors, "errors of the shift; the bits above are not read"));
    let row = |i| field(format!("job_row_{i}"), word_at(format.row_at(i)), row_bits(format), "");
    items.extend((0..format.rows()).map(row));
    items
}

fn options() -> Vec<Item> {
    vec![
        field("option_expansions", 0, 32, "the most of them; 0: no limit"),
        number("option_contact", QueryFlags::FIRST_CONTACT, "stop at the first certain contact"),
        number("option_separate", QueryFlags::ALL_PAIRS, "answer separate pairs too"),
        number("option_leaves", QueryFlags::LEAF_PAIRS, "no triangle test"),
        field(
            "option_number",
            QueryFlags::NUMBER_AT,
            QueryFlags::NUMBER_BITS,
            "for the report; also in stop and reset",
        ),
    ]
}

/// The pose whose record begins there.
fn pose(design: &EngineDesign, at: u32) -> Vec<Item> {
    let (format, unit) = (&design.format, &design.unit.params);
    let number_at = |i| at + format.stream.number_at(i);
    let bits = word_at(format.row_at(0)) - at;
    let mut items = vec![
        number("pose_bits", bits, ""),
        field("job_pose", at, bits, "all of it"),
        number("job_bypass", at + BYPASS_AT, "the unit takes pairs as they are"),
    ];
    for (i, port) in (0..).zip(pose_ports(unit)) {
        items.push(field(format!("job_{port}"), number_at(i), format.transform_width, ""));
        if unit.upper == Upper::Sticky {
            items.push(number(format!("job_{port}_sticky"), at + i, ""));
        }
    }
    items
}

fn shift(design: &EngineDesign) -> Vec<Item> {
    let format = &design.format;
    let number_at = |i| word_at(EngineFormat::POSE_AT) + format.stream.number_at(i);
    let (cut, bits) = (format.translation_shift() as u32, shift_bits(format));
    let shift =
        |(i, axis): (u32, &str)| field(format!("job_shift_{axis}"), number_at(9 + i) + cut, bits, "the shift as s4.22");
    (0..).zip(AXES).map(shift).collect()
}

fn pair(design: &EngineDesign) -> Vec<Item> {
    let (format, unit) = (&design.format, &design.unit.params);
    let (stream, words) = (&format.stream, format.stream.record_words(PacketKind::Pairs));
    let at = word_at(format.query_words() - words);
    let corners = 9 * stream.lane();
    let mut items = vec![
        field("job_pair_tag", at + TAG_AT, stream.tag_width, ""),
        field("job_pair_v", at + stream.number_at(0), corners, "corners of the triangle of A"),
        field("job_pair_w", at + stream.number_at(9), corners, "of B"),
    ];
    if unit.upper == Upper::Sticky {
        items.extend(fields([("job_pair_sticky_v", ""), ("job_pair_sticky_w", "")], at, 9));
    }
    items
}

fn query(format: &EngineFormat) -> Vec<Item> {
    let (origin, shift, row) = (format.origin_bits, shift_bits(format), row_bits(format));
    let mut items = vec![
        number("query_pose_bits", 9 * origin, "the matrix for origins"),
        number("query_shift_bits", 3 * shift, ""),
        number("query_errors_bits", 3 * format.shift_error_bits(), ""),
        number("query_rows_bits", format.rows() * row, ""),
    ];
    items.extend((0..).zip(ENTRIES).map(|(i, name)| field(format!("query_{name}"), origin * i, origin, "")));
    items.extend((0..).zip(AXES).map(|(i, axis)| field(format!("query_shift_{axis}"), shift * i, shift, "")));
    items.extend((0..format.rows()).map(|i| field(format!("query_row_{i}"), row * i, row, "")));
    items
}

fn reasons() -> Vec<Item> {
    let item = |code| {
        let constant = host::reason(code).0;
        Item { name: constant.name.to_owned(), value: Value::Reason(code), what: constant.what }
    };
    Reason::ALL.map(item).into()
}

/// Bits of a coordinate of the shift.
fn shift_bits(format: &EngineFormat) -> u32 {
    format.widths().translation.bits()
}

/// Bits of a row that mean something.
pub(super) fn row_bits(format: &EngineFormat) -> u32 {
    format.rest_at() + format.rest_bits()
}
