//! The host side of an engine: its constants in VHDL, C and Python, and the packing and unpacking of its words.

use super::{EngineDesign, NAME};
use crate::format::EngineFormat;
use crate::host::TRIANGLES_AT;
use crate::params::Memory;
use crate::words::{Command, EngineAnswer, EngineReport, QueryFlags, Reason};
use askama::Template;
use efsat_unit::artefact::Prefix;
use efsat_unit::pair::Verdict;
use efsat_unit::params::Quantity;
use efsat_unit::parts::{HostSide, constants_package};
use efsat_unit::words::REPORT;
use efsat_unit::words::constants::{Constant, Group};
use std::ops::Deref;

/// What the files of the host side are made of.
struct Host<'a> {
    side: HostSide<'a>,
    reasons: Vec<&'static str>,
    /// How many directions each choice of a row has.
    slots: String,
    is_sticky: bool,
    block_ram: bool,
    by_number: bool,
}

impl<'a> Deref for Host<'a> {
    type Target = HostSide<'a>;

    fn deref(&self) -> &HostSide<'a> {
        &self.side
    }
}

/// The file in C.
#[derive(Template)]
#[template(path = "host/efsat_engine.h", escape = "none")]
struct Header<'a> {
    h: &'a Host<'a>,
}

/// The file in Python.
#[derive(Template)]
#[template(path = "host/efsat_engine.py", escape = "none")]
struct Module<'a> {
    h: &'a Host<'a>,
}

/// The package of constants in VHDL: name and text.
pub(super) fn package(design: &EngineDesign, prefix: &Prefix) -> (String, String) {
    let text = constants_package(groups(design), prefix, NAME, &format!("{prefix}{NAME}. The engine"));
    (format!("{}_constants.vhd", prefix.of(NAME)), text)
}

/// The files of the host side: names and texts.
pub(super) fn files(design: &EngineDesign, prefix: &Prefix) -> [(String, String); 2] {
    let refusals = [
        ("ENTRY", Quantity::Entry.name()),
        ("TRANSLATION", Quantity::Translation.name()),
        ("STICKY", "sticky bits"),
        ("ERROR", "error of the shift"),
        ("REST", "rest of row"),
        ("CHOICE", "a choice of row"),
        ("FACTOR", "a factor of row"),
        ("FLAGS", "flags"),
        ("ADDRESS", "no multiple of 64 in memory, address"),
        ("ANSWER_NUMBER", "report of query"),
        ("COUNT", "pairs of a verdict in the answer, as the report counts them"),
        ("MOVE", "a way that is no multiple of 64 or leaves memory"),
        ("NO_REPORT", "an answer without a report that is due at its end, words"),
        ("PAIR", "a word that is no pair of the objects, word"),
        ("TWICE", "a pair of triangles twice, word"),
    ];
    let of_numbers = [
        refusals[0],
        refusals[1],
        refusals[2],
        ("TRIANGLE", "triangle of A (0) or B (1)"),
        refusals[7],
        refusals[8],
        ("ANSWER_NUMBER", "report of packet"),
        ("COUNT", "pairs in the answer, as report and packet say"),
        ("NO_REPORT", "an answer without a report that is due at its end, words"),
        ("PAIR", "a word that is not the next one of the pairs, word"),
    ];
    let (name, constants) = ((NAME, prefix), (groups(design), &design.unit.params));
    let host = Host {
        side: match design.by_number {
            false => HostSide::new(name, constants, refusals, ["PAIR", "MOVE"]),
            true => HostSide::new(name, constants, of_numbers, ["PAIR", "NO_REPORT"]),
        },
        by_number: design.by_number,
        reasons: Reason::ALL.map(|code| reason(code).1).into(),
        slots: design.format.directions.slots().map(|slot| slot.len().to_string()).join(", "),
        is_sticky: design.format.sticky,
        block_ram: design.params.memory == Memory::BlockRam,
    };
    let render = |text: Result<String, askama::Error>| text.expect("the template renders");
    [
        (format!("host/{}.h", prefix.of(NAME)), render(Header { h: &host }.render())),
        (format!("host/{}.py", prefix.of(NAME)), render(Module { h: &host }.render())),
    ]
}

/// All constants. What the engine does not have is not among them.
fn groups(design: &EngineDesign) -> Vec<Group> {
    let (params, format) = (&design.params, &design.format);
    let (number, word) = (Constant::number, Constant::word);
    let header = |command| format.header(command) as u32;
    let block_ram = params.memory == Memory::BlockRam;
    let reset = word(
        "reset_header",
        header(Command::Reset),
        "the only word of a soft reset, without the number for its report",
    );
    let mut packets = match design.by_number {
        true => vec![
            word("numbers_header", header(Command::Numbers), "low half of the first word of a packet"),
            reset,
            number("triangles_word", 2, "the word that says how many triangles the objects have"),
            number("pairs_word", format.pairs_at(), "the word of the first pair"),
        ],
        false => vec![
            word("query_header", header(Command::Query), "low half of the first word of a query"),
            word("query_format", format.header_high(), "high half, which says the formats below"),
            word("stop_header", header(Command::Stop), "the only word of a stop, without the number of its query"),
            reset,
            number("query_words", format.query_words(), "words of a query"),
            number("triangles_word", 4, "the word that says how many triangles the objects have"),
            number("options_word", 5, "the word that says what is asked for"),
        ],
    };
    if block_ram {
        packets.push(word("load_header", header(Command::Load), "first word of a load"));
        packets.push(word("triangles_at", TRIANGLES_AT << 6, "byte address of the first triangle; blocks begin at 0"));
        packets.push(number("block_lines", params.block_lines, "blocks that memory holds"));
        packets.push(number("triangle_lines", params.triangle_lines, "triangles that memory holds"));
    }
    let flag = |at: u32| 1 << (at - u32::BITS);
    let all = [QueryFlags::FIRST_CONTACT, QueryFlags::ALL_PAIRS, QueryFlags::LEAF_PAIRS, QueryFlags::KEEP_CACHES];
    let flags = all.into_iter().map(flag).sum();
    let mut groups = vec![
        Group { what: "The engine.", constants: of_engine(design) },
        Group { what: "Packets in.", constants: packets },
        Group {
            what: "What is asked for: flags in the high half of the options, and fields.",
            constants: vec![
                number("first_contact", flag(QueryFlags::FIRST_CONTACT), "stop at the first certain contact"),
                number("all_pairs", flag(QueryFlags::ALL_PAIRS), "answer separate pairs too"),
                number("leaf_pairs", flag(QueryFlags::LEAF_PAIRS), "no triangle test: all are possibly incorrect"),
                number("keep_caches", flag(QueryFlags::KEEP_CACHES), "no image has changed since the last query"),
                number("query_flags", flags, "all of them"),
                number(
                    "query_number_low",
                    QueryFlags::NUMBER_AT,
                    "the number that the report returns; also in stop and reset",
                ),
                number("query_number_bits", QueryFlags::NUMBER_BITS, "its bits"),
            ],
        },
        Group {
            what: "Bits of a row.",
            constants: vec![
                number("row_choice_bits", format.choice_bits(), "bits of a choice, below its factor"),
                number("row_slot_bits", format.choice_at(1), "from choice to choice"),
                number("row_rest_low", format.rest_at(), "the rest"),
                number("row_rest_bits", format.rest_bits(), "its bits"),
            ],
        },
        Group {
            what: "Verdicts: the low bits of a word out.",
            constants: vec![
                number(
                    "verdict_separate",
                    Verdict::Separate as u32,
                    "no common point, if separate pairs are asked for",
                ),
                number("verdict_intersect", Verdict::Intersect as u32, "a common point, certainly"),
                number("verdict_possibly_incorrect", Verdict::PossiblyIncorrect as u32, "too close for this width"),
                number("verdict_report", REPORT.into(), "no pair: the first word of the report"),
            ],
        },
        Group {
            what: "Packets out: pairs, then a report.",
            constants: vec![
                number("answer_a_low", EngineAnswer::A_AT, "number of A's triangle"),
                number("answer_b_low", EngineAnswer::B_AT, "number of B's triangle"),
                number("answer_number_bits", EngineAnswer::NUMBER_BITS, "bits of both"),
                number("report_words", EngineReport::WORDS as u32, "words of the report"),
                number("report_reason_low", EngineReport::REASON_AT, "reason, five bits of its first word"),
                number("report_incomplete", EngineReport::INCOMPLETE_AT, "pairs that touch may be missing"),
                number("report_number_low", EngineReport::NUMBER_AT, "number of the query, 24 bits"),
            ],
        },
        Group { what: "Reasons of a report.", constants: Reason::ALL.map(|code| reason(code).0).into() },
    ];
    if design.by_number {
        let has = |constant: &Constant| !WITH_TREES.contains(&constant.name);
        groups.iter_mut().for_each(|group| group.constants.retain(has));
        groups.retain(|group| !group.constants.is_empty());
    }
    groups
}

/// What an engine that takes pairs by number does not have.
const WITH_TREES: [&str; 15] = [
    "first_contact",
    "leaf_pairs",
    "query_flags",
    "row_choice_bits",
    "row_slot_bits",
    "row_rest_low",
    "row_rest_bits",
    "directions",
    "offset_bits",
    "origin_bits",
    "factor_bits",
    "tree_height",
    "row_word",
    "clocks_per_expansion",
    "block_lines",
];

fn of_engine(design: &EngineDesign) -> Vec<Constant> {
    let (params, format) = (&design.params, &design.format);
    let number = Constant::number;
    vec![
        number("directions", format.k(), "directions of a volume, and rows of a query"),
        number("offset_bits", format.offset_bits, "bits of a code"),
        number("origin_bits", format.origin_bits, "bits of a coordinate of an origin"),
        number("factor_bits", format.factor_bits, "bits of a factor of a row"),
        number("transform_bits", format.transform_width, "bits of a number of a triangle or a pose"),
        number("integral_bits", format.int_bits, "of them integral, with the sign"),
        number("tree_height", params.tree_height, "the greatest height of a tree"),
        match design.by_number {
            false => number("pose_word", EngineFormat::POSE_AT, "first word of the pose in a query"),
            true => number("pose_word", EngineFormat::NUMBERS_POSE_AT, "first word of the pose in a packet"),
        },
        number("row_word", format.row_at(0), "first row in a query"),
        number("clocks_per_expansion", design.volume.interval as u32, "clocks from expansion to expansion"),
        number("clocks_per_pair", design.unit.interval as u32, "clocks from pair to pair of triangles"),
        number("clock_mhz", design.unit.params.frequency, "the target clock in MHz"),
    ]
}

/// The constant of a reason, and what sentences call it.
pub(super) fn reason(reason: Reason) -> (Constant, &'static str) {
    let (name, what, called) = match reason {
        Reason::Complete => ("reason_complete", "everything was traversed", "complete"),
        Reason::Contact => ("reason_contact", "stopped at a certain contact", "stopped at a certain contact"),
        Reason::Limit => {
            ("reason_limit", "limit of expansions; from here on the answer is incomplete", "limit of expansions")
        }
        Reason::BadTree => ("reason_bad_tree", "a block that no tree has", "bad tree"),
        Reason::Memory => ("reason_memory", "error of the memory", "memory error"),
        Reason::Stopped => ("reason_stopped", "stopped by the host", "stopped by the host"),
        Reason::UnknownHeader => ("reason_unknown_header", "no query for this engine", "unknown header"),
        Reason::TooShort => ("reason_too_short", "the packet was too short", "packet too short"),
        Reason::Silent => ("reason_silent", "the memory does not answer", "memory does not answer"),
        Reason::Reset => ("reason_reset", "soft reset; nothing before it has another answer", "soft reset"),
        Reason::TooLong => ("reason_too_long", "the packet was too long", "packet too long"),
    };
    (Constant::number(name, reason as u32, what), called)
}
