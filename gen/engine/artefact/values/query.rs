//! Words of a query, and what is cut from them.

use super::{Slice, WORD, binary, word_at, zeros};
use crate::format::EngineFormat;
use crate::params::Memory;
use crate::words::{Command, QueryFlags};

/// A choice in a row of the query that has fewer values than its bits.
#[derive(Debug)]
pub(crate) struct Slot {
    pub high: u32,
    pub low: u32,
    pub count: usize,
}

/// Headers, words and rows.
#[derive(Debug)]
pub(crate) struct Query {
    pub directions: u32,
    pub query_words: u32,
    /// Kinds of header that are told apart.
    pub kinds: u32,
    pub job_bits: u32,
    pub query_header: String,
    pub query_format: String,
    pub load_header: String,
    pub stop_header: String,
    pub reset_header: String,
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
}

impl Query {
    pub fn new(format: &EngineFormat, memory: Memory) -> Self {
        let (k, origin_bits) = (format.k(), format.origin_bits);
        let row_bits = format.rest_at() + format.rest_bits();
        let shift = format.widths().translation.bits();
        let cut_low = format.matrix_shift() as u32;
        let cut_high = cut_low + origin_bits - 1;
        let above_bits = format.transform_width - cut_high;
        let header = |command| format!("{:08x}", format.header(command) as u32);
        // Where number `i` of the pose is.
        let number_at = |i| word_at(EngineFormat::POSE_AT) + format.stream.number_at(0) + format.stream.lane() * i;
        let translation_at = |i| number_at(9 + i) + format.translation_shift() as u32;
        let slot = |(s, directions): (u32, &[u8])| {
            let (low, bits) = (format.choice_at(s), format.choice_bits());
            (directions.len() < 1 << bits).then(|| Slot { high: low + bits - 1, low, count: directions.len() })
        };
        Self {
            directions: k,
            query_words: format.query_words(),
            kinds: if memory == Memory::BlockRam { 8 } else { 7 },
            job_bits: WORD * (format.query_words() - 1),
            query_header: header(Command::Query),
            query_format: format!("{:08x}", format.header_high()),
            load_header: header(Command::Load),
            stop_header: header(Command::Stop),
            reset_header: header(Command::Reset),
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
                .map(|i| Slice::new(origin_bits * i, origin_bits, number_at(i), format.transform_width))
                .collect(),
            number_bits: format.transform_width,
            cut_high,
            cut_low,
            above_bits,
            above_zeros: zeros(above_bits),
            above_ones: "1".repeat(above_bits as usize),
            greatest_entry: binary((1 << (origin_bits - 1)) - 1, origin_bits),
            least_entry: binary((1 << (origin_bits - 1)) + 1, origin_bits),
            below_least: binary(1 << (origin_bits - 1), origin_bits),
            shift_slices: (0..3).map(|i| Slice::new(shift * i, shift, translation_at(i), shift)).collect(),
            row_slices: (0..k)
                .map(|i| Slice::new(row_bits * i, row_bits, word_at(format.row_at(i)), row_bits))
                .collect(),
            pose_bits: 9 * origin_bits,
            shift_bits: 3 * shift,
            rows_bits: k * row_bits,
        }
    }
}

// The places of the flags are fixed in the text of the templates.
const _: () = assert!(
    QueryFlags::FIRST_CONTACT == 32
        && QueryFlags::ALL_PAIRS == 33
        && QueryFlags::LEAF_PAIRS == 34
        && QueryFlags::KEEP_CACHES == 35
        && QueryFlags::NUMBER_AT == 40
);
