//! Memories and caches.

use super::blocks::block_bits;
use super::{Bits, WORD, binary, places, zeros};
use crate::artefact::EngineDesign;
use crate::params::{ADDRESS_BITS as LINE_ADDRESS_BITS, Memory};
use crate::words::LINK_NUMBER_BITS;

/// Lines that a cache may have asked for and not got.
const PLACES: u32 = 16;

/// One of the four caches and what is connected to it.
#[derive(Debug)]
pub(crate) struct Cache {
    pub label: &'static str,
    pub entity: &'static str,
    pub base: &'static str,
    pub request: &'static str,
    pub number: &'static str,
    pub taken: &'static str,
    pub line: &'static str,
}

/// Bits of a tag that are compared together, and those of an address that they are compared with.
#[derive(Debug)]
pub(crate) struct TagPart {
    pub tag: Bits,
    pub address: Bits,
}

/// A memory of lines, or a cache.
#[derive(Debug)]
pub(crate) struct Lines {
    pub entity: &'static str,
    pub what: &'static str,
    pub lines: u32,
    /// Bits of a line, of its place, of its number, and of a word.
    pub line: Bits,
    pub place: Bits,
    pub number: Bits,
    pub word: Bits,
    /// Lines are taken so seldom that one need not follow another at once: whether one is taken is known late in a clock.
    pub paced: bool,
    pub line_bits: u32,
    pub line_address_bits: u32,
    pub number_bits: u32,
    /// Bits of a number that can be set.
    pub used_number: Bits,
    pub word_bits: u32,
    pub words_per_line: u32,
    pub word_places: Vec<u32>,
    pub padded: Bits,
    pub tag_bits: u32,
    pub tag_parts: Vec<TagPart>,
    pub places: u32,
    pub place_bits: u32,
    pub return_words: u32,
    pub return_bits: u32,
}

/// Lines and words of both, and what they are made of.
#[derive(Debug)]
pub(crate) struct Memories {
    pub block_lines: u32,
    pub triangle_lines: u32,
    pub blocks: u32,
    pub triangles: u32,
    /// Bits of the number of a line in an address of a load, and those above, which are zero.
    pub load_line: Bits,
    pub load_above: Bits,
    pub load_zeros: String,
    pub memory_width: u32,
    pub word: Bits,
    pub memory_size: String,
    pub block_words: u32,
    pub triangle_words: u32,
    pub memory_bytes: u32,
    /// Clocks of the watchdog, none if 0, and the bits that count them.
    pub watchdog: u32,
    pub watchdog_bits: u32,
    pub id: Option<Bits>,
    pub memory_words: u32,
    pub memories: Vec<Lines>,
    pub caches: Vec<Cache>,
}

impl Memories {
    pub fn new(design: &EngineDesign) -> Self {
        let params = &design.params;
        let memories = vec![lines(design, false), lines(design, true)];
        let [block_line_bits, triangle_line_bits] = [0, 1].map(|i: usize| memories[i].line_address_bits);
        // Behind the place of a byte in its line.
        let load_line = Bits::new(6, block_line_bits.max(triangle_line_bits));
        let all_lines = |lines: u32| if params.memory == Memory::Axi { 1 << LINE_ADDRESS_BITS } else { lines };
        Self {
            block_lines: all_lines(params.block_lines),
            triangle_lines: all_lines(params.triangle_lines),
            blocks: params.block_lines,
            triangles: params.triangle_lines,
            load_line,
            load_above: Bits { high: 30, low: load_line.high + 1 },
            load_zeros: zeros(30 - load_line.high),
            memory_width: params.memory_width,
            word: Bits::all(params.memory_width),
            memory_size: binary((params.memory_width / 8).ilog2(), 3),
            block_words: memories[0].words_per_line,
            triangle_words: memories[1].words_per_line,
            memory_bytes: params.memory_width / 8,
            watchdog: params.watchdog,
            watchdog_bits: u32::BITS - params.watchdog.leading_zeros(),
            id: (params.axi_id_bits > 0).then(|| Bits::all(params.axi_id_bits)),
            memory_words: params.memory_width.div_ceil(WORD),
            memories,
            caches: caches(),
        }
    }
}

fn lines(design: &EngineDesign, triangles: bool) -> Lines {
    let params = &design.params;
    let axi = params.memory == Memory::Axi;
    let (what, count, line_bits, number_bits) = match triangles {
        false => ("Blocks", params.block_lines, block_bits(&design.format), params.block_number_bits),
        true => ("Triangles", params.triangle_lines, design.format.triangle().bits, LINK_NUMBER_BITS),
    };
    let entity = match (axi, triangles) {
        (false, false) => "engine_block_memory",
        (false, true) => "engine_triangle_memory",
        (true, false) => "engine_block_cache",
        (true, true) => "engine_triangle_cache",
    };
    // Of caches there is one for each side.
    let count = if axi { count / 2 } else { count };
    let word_bits = if axi { params.memory_width } else { WORD };
    let words_per_line = line_bits.div_ceil(word_bits);
    let line_address_bits = count.ilog2();
    let address_bits = if axi { LINE_ADDRESS_BITS } else { line_address_bits };
    let (return_words, return_bits) = places(PLACES * words_per_line);
    let tag_bits = LINE_ADDRESS_BITS - line_address_bits;
    // Tags come late in their clock: a table of four inputs compares a part.
    const LONGEST: u32 = 2;
    let part = |low: u32| {
        let bits = LONGEST.min(tag_bits - low);
        TagPart { tag: Bits::new(low, bits), address: Bits::new(line_address_bits + low, bits) }
    };
    // That blocks are taken is known late in a clock; of triangles a register says it, or some are taken in every clock.
    let paced = !triangles && params.expansion_clocks > 1;
    Lines {
        entity,
        what,
        lines: count,
        line: Bits::all(line_bits),
        place: Bits::all(line_address_bits),
        number: Bits::all(number_bits),
        word: Bits::all(word_bits),
        paced,
        line_bits,
        line_address_bits,
        number_bits,
        used_number: Bits::all(number_bits.min(address_bits)),
        word_bits,
        words_per_line,
        word_places: (0..words_per_line).rev().collect(),
        padded: Bits::all(word_bits * words_per_line),
        tag_bits,
        tag_parts: (0..tag_bits).step_by(LONGEST as usize).map(part).collect(),
        places: PLACES,
        place_bits: PLACES.ilog2(),
        return_words,
        return_bits,
    }
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
