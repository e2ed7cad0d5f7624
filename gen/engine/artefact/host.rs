//! The host side of an engine: its constants in VHDL, C and Python, and the packing and unpacking of its words.

use super::{EngineDesign, NAME};
use crate::format::EngineFormat;
use crate::host::{FINE, Header as ImageHeader, LINE, TRIANGLES_AT};
use crate::params::Memory;
use crate::words::{BlockLayout, Command, EngineAnswer, EngineReport, LINK_NUMBER_BITS, QueryFlags, Reason};
use askama::Template;
use efsat_unit::artefact::Prefix;
use efsat_unit::pair::Verdict;
use efsat_unit::params::Quantity;
use efsat_unit::parts::{HostSide, RETEST, constants_package, retest};
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
    /// Names of this header and of that of the retest, without an ending, and the latter as constants begin.
    file: String,
    retest: String,
    retest_upper: String,
    /// Constants of images, and of poses.
    image: Vec<Group>,
    pose: Vec<Group>,
    /// The first bytes of an image, how many directions there are, each of them, and those of each choice of a row.
    head: String,
    k: u32,
    vectors: String,
    choices: String,
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

/// The reader of images in C.
#[derive(Template)]
#[template(path = "host/efsat_engine_image.h", escape = "none")]
struct ImageReader<'a> {
    h: &'a Host<'a>,
}

/// The numbers of a pose in C.
#[derive(Template)]
#[template(path = "host/efsat_engine_pose.h", escape = "none")]
struct PoseNumbers<'a> {
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
pub(super) fn files(design: &EngineDesign, prefix: &Prefix) -> [(String, String); 5] {
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
        IMAGE[0],
        IMAGE[1],
        IMAGE[2],
        ("HEIGHT", "height of the tree of A (0) or B (1),"),
        ("BLOCKS", "blocks of A (0) or B (1),"),
        ("MOVE", "a way that is no multiple of 64 or leaves memory"),
        ("NO_REPORT", "an answer without a report that is due at its end, words"),
        ("PAIR", "a word that is no pair of the objects, word"),
        ("TWICE", "a pair of triangles twice, word"),
        BITS[0],
        BITS[1],
        BITS[2],
        BITS[3],
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
        IMAGE[0],
        IMAGE[1],
        IMAGE[2],
        ("NO_REPORT", "an answer without a report that is due at its end, words"),
        ("PAIR", "a word that is not the next one of the pairs, word"),
        BITS[0],
        BITS[1],
        BITS[2],
        BITS[3],
    ];
    let format = &design.format;
    let vectors: Vec<[i8; 3]> = (0..format.directions.count()).map(|index| format.directions.vector(index)).collect();
    let list = |numbers: &[i8]| format!("{{{}}}", numbers.iter().map(i8::to_string).collect::<Vec<_>>().join(", "));
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
        file: prefix.of(NAME),
        retest: prefix.of(RETEST),
        retest_upper: prefix.of(RETEST).to_uppercase(),
        image: vec![Group { what: "Images.", constants: of_images(format) }],
        pose: vec![Group { what: "Numbers of a pose.", constants: of_poses(design) }],
        head: ImageHeader::head(format)
            .iter()
            .flat_map(|word| word.to_le_bytes())
            .map(|x| x.to_string())
            .collect::<Vec<_>>()
            .join(", "),
        k: format.k(),
        vectors: vectors.iter().map(|vector| list(vector)).collect::<Vec<_>>().join(", "),
        choices: format
            .directions
            .slots()
            .map(|slot| list(&slot.iter().map(|&x| x as i8).collect::<Vec<_>>()))
            .join(", "),
    };
    let render = |text: Result<String, askama::Error>| text.expect("the template renders");
    [
        (format!("host/{}.h", prefix.of(NAME)), render(Header { h: &host }.render())),
        (format!("host/{}.py", prefix.of(NAME)), render(Module { h: &host }.render())),
        (format!("host/{}_image.h", prefix.of(NAME)), render(ImageReader { h: &host }.render())),
        (format!("host/{}_pose.h", prefix.of(NAME)), render(PoseNumbers { h: &host }.render())),
        retest(prefix),
    ]
}

/// What is refused of images, as found in a range.
const IMAGE: [(&str, &str); 3] = [
    ("IMAGE_FIELD", "field of an image, or of a block or triangle, at byte"),
    ("IMAGE_SIZE", "bytes of an image"),
    ("SCALE", "power of the scale of image"),
];

/// What is refused of images and poses, as bits.
const BITS: [(&str, &str); 4] = [
    ("IMAGE_LINK", "a link that makes no tree, or none, in the block at byte"),
    ("IMAGE_CODE", "a code that excludes a triangle below it, in the block at byte"),
    ("NOT_FINITE", "not finite, here as bits: number"),
    ("WORDS", "more words are needed for number"),
];

fn of_images(format: &EngineFormat) -> Vec<Constant> {
    let number = Constant::number;
    let (block, triangle) = (format.block(), format.triangle());
    let (grid, word) = (format.grid_fraction(), format.word_fraction());
    vec![
        number("image_directions", format.k(), "directions of a volume"),
        number("image_header_bytes", LINE, "bytes of the header"),
        number("image_block_bytes", block.stride, "from block to block"),
        number("image_triangle_bytes", triangle.stride, "from triangle to triangle"),
        number("image_face_bits", triangle.number_bits, "the face of a triangle, its lowest bits"),
        number("image_most_triangles", 1 << LINK_NUMBER_BITS, "the most triangles of any image"),
        number("block_origin_bits", block.origin_bits, "bits of a coordinate of an origin, from bit 64 of a block on"),
        number("block_most_origin", format.most_origin() as u32, "its greatest magnitude"),
        number("block_exponent_low", block.exponent_at, "the exponent, four bits"),
        number("block_tag_low", block.tag_at, "the tag, and zeros above it"),
        number("block_tag", block.tag, "what it is"),
        number("block_codes_low", BlockLayout::CODES_AT, "the codes of the left child, then those of the right one"),
        number("block_code_bits", block.code_bits, "bits of a code"),
        number("block_most_code", format.most() as u32, "its greatest magnitude"),
        number("block_bits", block.bits, "bits that mean something"),
        number(
            "triangle_head_bits",
            triangle.number_bits + if format.sticky { 9 } else { 0 },
            "the face and sticky bits",
        ),
        number("triangle_step", triangle.lane, "bits from number to number, and to the first one"),
        number("triangle_one", 1 << word, "1 as a coordinate"),
        number("origin_shift", format.origin_shift(), "from origins to the grid"),
        number("held_shift", word.max(grid) - grid, "from the grid to its or the coordinates' units, the finer ones"),
        number("reach_shift", word.max(grid) - word, "from coordinates to them"),
    ]
}

fn of_poses(design: &EngineDesign) -> Vec<Constant> {
    let (number, format) = (Constant::number, &design.format);
    let fraction = number("fraction_bits", format.word_fraction(), "fraction bits of a number of the pose");
    if design.by_number {
        return vec![fraction];
    }
    vec![
        fraction,
        number("image_most_blocks", 1 << design.params.block_number_bits, "the most blocks of an image"),
        number("fine_bits", FINE, "fraction bits in which rows are computed"),
        number("matrix_shift", format.matrix_shift() as u32, "dropped bits of an entry that meets an origin"),
        number("origin_drop", FINE - format.origin_fraction(), "bits between them and origins"),
        number("grid_drop", FINE - format.grid_fraction(), "bits between them and the grid"),
        number("factor_drop", FINE - format.factor_fraction(), "bits between them and factors"),
        number("shift_rounding", format.shift_rounding(), "roundings of the shift, in steps of the grid"),
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
const WITH_TREES: [&str; 16] = [
    "first_contact",
    "leaf_pairs",
    "query_flags",
    "row_choice_bits",
    "row_slot_bits",
    "row_rest_low",
    "row_rest_bits",
    "directions",
    "rows",
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
        number("directions", format.k(), "directions of a volume"),
        number("rows", format.rows(), "rows of a query, one for each two opposite directions"),
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
