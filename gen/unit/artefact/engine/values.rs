//! The numbers that the templates of the engine print.

use super::EngineDesign;
use super::vectors::formats_line;
use crate::artefact::testbench::half_period;
use crate::design::top::{pair_ports, pose_ports};
use crate::params::Params;
use crate::params::Upper;
use crate::params::engine::{
    ADDRESS_BITS as LINE_ADDRESS_BITS, BlockLayout, Command, EngineFormat, LINK_NUMBER_BITS, Memory, QueryFlags,
};
use crate::params::stream::{BYPASS_AT, Kind, StreamFormat};

/// Lines that a cache may have asked for and not got.
const PLACES: u32 = 16;
/// Words of a stream into the engine.
pub(super) const WORD: u32 = 64;

/// Bits of a word.
#[derive(Debug)]
pub(super) struct Bits {
    pub high: u32,
    pub low: u32,
}

/// Bits to one place and where they come from.
#[derive(Debug)]
pub(super) struct Slice {
    pub high: u32,
    pub low: u32,
    pub from_high: u32,
    pub from_low: u32,
}

/// Bits that are compared together, and what they are compared with, the highest first.
#[derive(Debug)]
pub(super) struct Part {
    pub high: u32,
    pub low: u32,
    pub due: String,
}

/// A code of a block in two parts, compared with the one that is unusable.
#[derive(Debug)]
pub(super) struct Code {
    pub upper: Part,
    pub lower: Part,
}

/// A choice in a row of the query that has fewer values than its bits.
#[derive(Debug)]
pub(super) struct Slot {
    pub high: u32,
    pub low: u32,
    pub count: usize,
}

/// A port and what is connected to it.
#[derive(Debug)]
pub(super) struct Connection {
    pub port: String,
    pub value: String,
}

/// One of the four caches and what is connected to it.
#[derive(Debug)]
pub(super) struct Cache {
    pub label: &'static str,
    pub entity: &'static str,
    pub base: &'static str,
    pub request: &'static str,
    pub number: &'static str,
    pub taken: &'static str,
    pub line: &'static str,
}

/// A memory of lines, or a cache.
#[derive(Debug)]
pub(super) struct Lines {
    pub entity: &'static str,
    pub what: &'static str,
    pub lines: u32,
    pub line_bits: u32,
    pub line_address_bits: u32,
    pub number_bits: u32,
    pub used_number_bits: u32,
    pub word_bits: u32,
    pub words_per_line: u32,
    pub word_places: Vec<u32>,
    pub padded_bits: u32,
    pub tag_bits: u32,
    /// Bits of a tag that are compared together, and those of an address that they are compared with.
    pub tag_parts: Vec<Slice>,
    pub places: u32,
    pub place_bits: u32,
    pub return_words: u32,
    pub return_bits: u32,
}

/// All of them.
#[derive(Debug)]
pub(super) struct Values {
    pub axi: bool,
    pub block_ram: bool,
    // Traversal
    pub node_bits: u32,
    pub level_bits: u32,
    pub levels: u32,
    pub deepest: String,
    pub entry_bits: u32,
    pub a_high: u32,
    pub a_low: u32,
    pub b_high: u32,
    pub b_low: u32,
    pub root_entry: String,
    pub stack: u32,
    pub stack_places: u32,
    pub stack_bits: u32,
    pub wide: i64,
    pub room_bits: u32,
    pub in_flight: u32,
    pub flight_places: u32,
    pub flight_bits: u32,
    pub pairs: u32,
    pub pair_bits: u32,
    pub open_bits: u32,
    // Blocks
    pub block_bits: u32,
    pub codes: Vec<Code>,
    pub code_count: usize,
    pub offset_bits: u32,
    pub block_tag_parts: Vec<Part>,
    pub origin_bits: u32,
    pub factor_bits: u32,
    // Triangles
    pub triangle_bits: u32,
    pub triangle_number_bits: u32,
    pub number_above: String,
    pub unit_inputs: Vec<Connection>,
    /// The unit takes no pair in the clock behind another one.
    pub paced: bool,
    pub guarded: bool,
    pub sticky: bool,
    /// Flags of each kind that the unit gives.
    pub flags: u32,
    // Pairs of packets
    pub pairs_header: String,
    pub pose_header: String,
    pub pair_words: u32,
    pub pose_words: u32,
    /// Place of the last pair in the words of a job.
    pub pair_at: u32,
    pub pair_tag_bits: u32,
    pub unit_tag_zeros: String,
    pub flag_zeros: String,
    pub bypass_at: u32,
    /// Bits of a word that are to be the sign of a number, if the unit has a guard and does not read them.
    pub signs: Vec<Bits>,
    pub sign_high: u32,
    // Query
    pub directions: u32,
    pub query_words: u32,
    /// Kinds of header that are told apart.
    pub kinds: u32,
    pub job_bits: u32,
    pub query_header: String,
    pub query_format: String,
    pub load_header: String,
    pub stop_header: String,
    pub options_word: u32,
    pub pose_word: u32,
    pub first_row: u32,
    pub row_bits: u32,
    pub row_zeros: String,
    pub checked_slots: Vec<Slot>,
    pub word1: u32,
    pub word2: u32,
    pub word3: u32,
    pub word4: u32,
    pub word5: u32,
    pub word6: u32,
    pub matrix_entries: Vec<Slice>,
    pub number_bits: u32,
    pub cut_high: u32,
    pub cut_low: u32,
    pub above_bits: u32,
    pub above_zeros: String,
    pub above_ones: String,
    pub greatest_entry: String,
    pub least_entry: String,
    pub below_least: String,
    pub shift_slices: Vec<Slice>,
    pub row_slices: Vec<Slice>,
    pub pose_bits: u32,
    pub shift_bits: u32,
    pub rows_bits: u32,
    // Memory
    pub block_lines: u32,
    pub triangle_lines: u32,
    pub blocks: u32,
    pub triangles: u32,
    pub block_line_bits: u32,
    pub triangle_line_bits: u32,
    pub load_bits: u32,
    pub load_zeros: String,
    pub memory_width: u32,
    pub memory_size: String,
    pub block_words: u32,
    pub triangle_words: u32,
    pub memory_bytes: u32,
    pub memory_words: u32,
    // Testbench
    pub formats: String,
    pub patience: usize,
    pub half_period: String,
    pub memories: Vec<Lines>,
    pub caches: Vec<Cache>,
}

/// The bits of a number, the highest first.
fn binary(value: u32, bits: u32) -> String {
    (0..bits).rev().map(|i| if value >> i & 1 == 1 { '1' } else { '0' }).collect()
}

fn zeros(bits: u32) -> String {
    "0".repeat(bits as usize)
}

/// Places up to the least power of two, at least two, and the bits of a place.
fn places(count: u32) -> (u32, u32) {
    let places = count.max(2).next_power_of_two();
    (places, places.trailing_zeros())
}

/// Place of the words of a job from word 1 on.
fn word_at(word: u32) -> u32 {
    WORD * (word - 1)
}

fn lines(design: &EngineDesign, triangles: bool) -> Lines {
    let params = &design.params;
    let axi = params.memory == Memory::Axi;
    let (entity, what, count, line_bits, number_bits) = match (axi, triangles) {
        (false, false) => {
            ("engine_block_memory", "Blocks", params.block_lines, block_bits(&design.format), params.block_number_bits)
        }
        (false, true) => (
            "engine_triangle_memory",
            "Triangles",
            params.triangle_lines,
            design.format.triangle().bits,
            LINK_NUMBER_BITS,
        ),
        // One for each side.
        (true, false) => (
            "engine_block_cache",
            "Blocks",
            params.block_lines / 2,
            block_bits(&design.format),
            params.block_number_bits,
        ),
        (true, true) => (
            "engine_triangle_cache",
            "Triangles",
            params.triangle_lines / 2,
            design.format.triangle().bits,
            LINK_NUMBER_BITS,
        ),
    };
    let word_bits = if axi { params.memory_width } else { WORD };
    let words_per_line = line_bits.div_ceil(word_bits);
    let line_address_bits = count.ilog2();
    let address_bits = if axi { LINE_ADDRESS_BITS } else { line_address_bits };
    let (return_words, return_bits) = places(PLACES * words_per_line);
    let tag_bits = LINE_ADDRESS_BITS - line_address_bits;
    let part = |low: u32, high: u32| Slice {
        high,
        low,
        from_high: line_address_bits + high,
        from_low: line_address_bits + low,
    };
    const LONGEST: u32 = 3;
    Lines {
        entity,
        what,
        lines: count,
        line_bits,
        line_address_bits,
        number_bits,
        used_number_bits: number_bits.min(address_bits),
        word_bits,
        words_per_line,
        word_places: (0..words_per_line).rev().collect(),
        padded_bits: word_bits * words_per_line,
        tag_bits,
        tag_parts: (0..tag_bits)
            .step_by(LONGEST as usize)
            .map(|low| part(low, tag_bits.min(low + LONGEST) - 1))
            .collect(),
        places: PLACES,
        place_bits: PLACES.ilog2(),
        return_words,
        return_bits,
    }
}

/// Code i of a block, both children counted through. The unusable code has its sign bit alone.
fn code(format: &EngineFormat, i: u32) -> Code {
    let (low, bits) = (BlockLayout::CODES_AT + format.offset_bits * i, format.offset_bits);
    let (middle, end) = (low + bits / 2, low + bits);
    let upper = Part { high: end - 1, low: middle, due: binary(1 << (end - middle - 1), end - middle) };
    Code { upper, lower: Part { high: middle - 1, low, due: zeros(middle - low) } }
}

/// The tag of a block and the zeros behind it, in parts that are no longer than those of a code.
fn block_tag_parts(block: &BlockLayout) -> Vec<Part> {
    const LONGEST: u32 = 5;
    (block.tag_at..BlockLayout::CODES_AT)
        .step_by(LONGEST as usize)
        .map(|low| {
            let bits = LONGEST.min(BlockLayout::CODES_AT - low);
            let due = block.tag.checked_shr(low - block.tag_at).unwrap_or(0) & ((1 << bits) - 1);
            Part { high: low + bits - 1, low, due: binary(due, bits) }
        })
        .collect()
}

fn block_bits(format: &EngineFormat) -> u32 {
    8 * format.block().stride
}

/// The inputs of the unit: the numbers of both triangles, and those of the pose in the words of the job.
fn unit_inputs(p: &Params, pose: &StreamFormat) -> Vec<Connection> {
    let mut inputs = vec![];
    let mut add = |port: String, word: &str, low: u32, bits: Option<u32>| {
        let place = bits.map_or(low.to_string(), |bits| format!("{} downto {low}", low + bits - 1));
        inputs.push(Connection { port, value: format!("{word}({place})") });
    };
    for (i, port) in (0..).zip(pair_ports()) {
        let [word, sticky] = if i < 9 { ["unit_v", "sticky_v"] } else { ["unit_w", "sticky_w"] };
        add(port.clone(), word, pose.lane() * (i % 9), Some(p.transform_width));
        if p.upper == Upper::Sticky {
            add(format!("{port}_sticky"), sticky, i % 9, None);
        }
    }
    for (i, port) in (0..).zip(pose_ports(p)) {
        let at = word_at(EngineFormat::POSE_AT);
        add(port.clone(), "job_words", at + pose.number_at(i), Some(p.transform_width));
        if p.upper == Upper::Sticky {
            add(format!("{port}_sticky"), "job_words", at + i, None);
        }
    }
    inputs
}

/// The bits above the numbers of a word, in units whose guard has them checked.
fn signs(stream: &StreamFormat) -> Vec<Bits> {
    let (lane, spare) = (stream.lane(), stream.spare_bits());
    let ends = (1..=WORD / lane).map(|i| lane * i - 1);
    if spare > 0 { ends.map(|high| Bits { high, low: high - spare }).collect() } else { vec![] }
}

fn caches() -> Vec<Cache> {
    let cache =
        |label, entity, base, request, number, taken, line| Cache { label, entity, base, request, number, taken, line };
    let [blocks, triangles] = ["engine_block_cache", "engine_triangle_cache"];
    vec![
        cache("blocks_of_a", blocks, "block_base_a", "both_blocks_ask", "request_a", "blocks_taken", "block_a"),
        cache("blocks_of_b", blocks, "block_base_b", "both_blocks_ask", "request_b", "blocks_taken", "block_b"),
        cache(
            "triangles_of_a",
            triangles,
            "triangle_base_a",
            "both_triangles_ask",
            "leaf_a",
            "triangles_taken",
            "triangle_a",
        ),
        cache(
            "triangles_of_b",
            triangles,
            "triangle_base_b",
            "both_triangles_ask",
            "leaf_b",
            "triangles_taken",
            "triangle_b",
        ),
    ]
}

impl Values {
    pub(super) fn new(design: &EngineDesign) -> Self {
        let (params, format, unit) = (&design.params, &design.format, &design.unit.params);
        let (block, triangle, k) = (format.block(), format.triangle(), format.k());
        let stream = &format.stream;
        let node_bits = params.block_number_bits;
        let level_bits = 32 - params.tree_height.leading_zeros();
        let b_low = level_bits + 2;
        let a_low = b_low + node_bits + 2;
        let entry_bits = a_low + node_bits;
        let root = format!("{}11", zeros(node_bits));
        let (stack_places, stack_bits) = places(params.stack);
        let (flight_places, flight_bits) = places(params.in_flight);
        let wide = i64::from(params.wide_limit());
        let most = params.stack + 4 * params.in_flight + 8;
        // Waiting, in the unit, and between: in front of the memory of triangles, looked up or on their way from it, and held in
        // front of the answers, fewer than 32 all together.
        let open = params.pair_queue + design.unit.places as u32 + 32;
        let axi = params.memory == Memory::Axi;
        let memories = vec![lines(design, false), lines(design, true)];
        let [block_line_bits, triangle_line_bits] = [0, 1].map(|i: usize| memories[i].line_address_bits);
        let load_bits = block_line_bits.max(triangle_line_bits);
        let all_lines = |lines: u32| if axi { 1 << LINE_ADDRESS_BITS } else { lines };
        let row_bits = format.rest_at() + format.rest_bits();
        let shift = format.widths().translation.bits();
        let pose_low = word_at(EngineFormat::POSE_AT) + stream.number_at(0);
        let cut_low = format.matrix_shift() as u32;
        let cut_high = cut_low + format.origin_bits - 1;
        let above_bits = format.transform_width - cut_high;
        let slot = |(s, directions): (u32, &[u8])| {
            let low = format.choice_at(s);
            let bits = format.choice_bits();
            (directions.len() < 1 << bits).then(|| Slot { high: low + bits - 1, low, count: directions.len() })
        };
        let header = |command| format!("{:08x}", format.header(command) as u32);
        Self {
            axi,
            block_ram: !axi,
            node_bits,
            level_bits,
            levels: params.tree_height,
            deepest: binary(params.tree_height, level_bits),
            entry_bits,
            a_high: entry_bits - 1,
            a_low,
            b_high: b_low + node_bits - 1,
            b_low,
            root_entry: format!("{root}{root}{}", zeros(level_bits)),
            stack: params.stack,
            stack_places,
            stack_bits,
            wide,
            room_bits: 34 - most.leading_zeros(),
            in_flight: params.in_flight,
            flight_places,
            flight_bits,
            pairs: params.pair_queue,
            pair_bits: params.pair_queue.ilog2(),
            open_bits: 32 - open.leading_zeros(),
            block_bits: block_bits(format),
            codes: (0..2 * k).map(|i| code(format, i)).collect(),
            code_count: 2 * k as usize,
            offset_bits: format.offset_bits,
            block_tag_parts: block_tag_parts(&block),
            origin_bits: format.origin_bits,
            factor_bits: format.factor_bits,
            triangle_bits: triangle.bits,
            triangle_number_bits: triangle.number_bits,
            number_above: match LINK_NUMBER_BITS - triangle.number_bits {
                0 => String::new(),
                bits => format!("\"{}\" & ", zeros(bits)),
            },
            unit_inputs: unit_inputs(unit, stream),
            paced: design.unit.interval > 1,
            guarded: unit.guarded(),
            sticky: unit.upper == Upper::Sticky,
            flags: stream.flags,
            pairs_header: format!("{:08x}", stream.header(Kind::Pairs)),
            pose_header: format!("{:08x}", stream.header(Kind::Pose)),
            pair_words: stream.record_words(Kind::Pairs),
            pose_words: format.pose_words,
            pair_at: word_at(format.query_words() - stream.record_words(Kind::Pairs)),
            pair_tag_bits: stream.tag_width,
            unit_tag_zeros: zeros(design.unit.params.tag_width - stream.tag_width - 1),
            flag_zeros: zeros(WORD - stream.answer_bits()),
            bypass_at: word_at(EngineFormat::POSE_AT) + BYPASS_AT,
            signs: signs(stream),
            sign_high: stream.spare_bits(),
            directions: k,
            query_words: format.query_words(),
            kinds: if params.memory == Memory::BlockRam { 7 } else { 6 },
            job_bits: WORD * (format.query_words() - 1),
            query_header: header(Command::Query),
            query_format: format!("{:08x}", format.header_high()),
            load_header: header(Command::Load),
            stop_header: header(Command::Stop),
            options_word: 5,
            pose_word: EngineFormat::POSE_AT,
            first_row: format.row_at(0),
            row_bits,
            row_zeros: zeros(WORD - row_bits),
            checked_slots: (0..).zip(format.directions.slots()).filter_map(slot).collect(),
            word1: word_at(1),
            word2: word_at(2),
            word3: word_at(3),
            word4: word_at(4),
            word5: word_at(5),
            word6: word_at(6),
            matrix_entries: (0..9)
                .map(|i| {
                    let (low, from_low) = (format.origin_bits * i, pose_low + stream.lane() * i);
                    let (high, from_high) = (low + format.origin_bits - 1, from_low + format.transform_width - 1);
                    Slice { high, low, from_high, from_low }
                })
                .collect(),
            number_bits: format.transform_width,
            cut_high,
            cut_low,
            above_bits,
            above_zeros: zeros(above_bits),
            above_ones: "1".repeat(above_bits as usize),
            greatest_entry: binary((1 << (format.origin_bits - 1)) - 1, format.origin_bits),
            least_entry: binary((1 << (format.origin_bits - 1)) + 1, format.origin_bits),
            below_least: binary(1 << (format.origin_bits - 1), format.origin_bits),
            shift_slices: (0..3)
                .map(|i| {
                    let from_low = pose_low + stream.lane() * (9 + i) + format.translation_shift() as u32;
                    let low = shift * i;
                    Slice { high: low + shift - 1, low, from_high: from_low + shift - 1, from_low }
                })
                .collect(),
            row_slices: (0..k)
                .map(|i| {
                    let (low, from_low) = (row_bits * i, word_at(format.row_at(i)));
                    Slice { high: low + row_bits - 1, low, from_high: from_low + row_bits - 1, from_low }
                })
                .collect(),
            pose_bits: 9 * format.origin_bits,
            shift_bits: 3 * shift,
            rows_bits: k * row_bits,
            block_lines: all_lines(params.block_lines),
            triangle_lines: all_lines(params.triangle_lines),
            blocks: params.block_lines,
            triangles: params.triangle_lines,
            block_line_bits,
            triangle_line_bits,
            load_bits,
            load_zeros: zeros(31 - (load_bits + 6)),
            memory_width: params.memory_width,
            memory_size: binary((params.memory_width / 8).ilog2(), 3),
            block_words: memories[0].words_per_line,
            triangle_words: memories[1].words_per_line,
            memory_bytes: params.memory_width / 8,
            memory_words: params.memory_width.div_ceil(WORD),
            formats: formats_line(design),
            patience: 20000 + 4 * (design.unit.latency + design.volume.latency),
            half_period: format!("{} ps", half_period(unit)),
            memories,
            caches: caches(),
        }
    }
}

// The places of the flags are fixed in the text of the templates.
const _: () = assert!(
    QueryFlags::FIRST_CONTACT == 32
        && QueryFlags::ALL_PAIRS == 33
        && QueryFlags::LEAF_PAIRS == 34
        && QueryFlags::EMPTY_CACHES == 35
        && QueryFlags::NUMBER_AT == 40
);
