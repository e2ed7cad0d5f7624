//! Words of a query, and what is cut from them.

use super::layout::{AXES, ENTRIES, row_bits};
use super::{Bits, WORD, binary, zeros};
use crate::format::EngineFormat;
use crate::params::Memory;
use crate::words::Command;

/// A choice in a row of the query that has fewer values than its bits.
#[derive(Debug)]
pub(crate) struct Slot {
    pub bits: Bits,
    pub count: usize,
}

/// Headers, words and rows.
#[derive(Debug)]
pub(crate) struct Query {
    pub directions: u32,
    pub rows: u32,
    pub query_words: u32,
    /// What is told of a word when it arrives.
    pub kinds: u32,
    pub query_header: String,
    pub query_format: String,
    pub load_header: String,
    pub stop_header: String,
    pub reset_header: String,
    pub row_bits: u32,
    pub row_zeros: String,
    pub checked_slots: Vec<Slot>,
    /// The number of an entry of the matrix, what is cut from it, and what must be its sign if it fits.
    pub entry: Bits,
    pub cut: Bits,
    pub origin: Bits,
    pub above: Bits,
    pub above_bits: u32,
    pub above_zeros: String,
    pub above_ones: String,
    pub greatest_entry: String,
    pub least_entry: String,
    pub below_least: String,
    /// Names of the entries of the matrix and of the axes of the shift.
    pub entries: [&'static str; 9],
    pub axes: [&'static str; 3],
}

impl Query {
    pub fn new(format: &EngineFormat, memory: Memory) -> Self {
        let origin_bits = format.origin_bits;
        let row_bits = row_bits(format);
        let cut = Bits::new(format.matrix_shift() as u32, origin_bits);
        let above_bits = format.transform_width - cut.high;
        let header = |command| format!("{:08x}", format.header(command) as u32);
        let slot = |(s, directions): (u32, &[u8])| {
            let (low, bits) = (format.choice_at(s), format.choice_bits());
            (directions.len() < 1 << bits).then(|| Slot { bits: Bits::new(low, bits), count: directions.len() })
        };
        Self {
            directions: format.k(),
            rows: format.rows(),
            query_words: format.query_words(),
            kinds: if memory == Memory::BlockRam { 11 } else { 10 },
            query_header: header(Command::Query),
            query_format: format!("{:08x}", format.header_high()),
            load_header: header(Command::Load),
            stop_header: header(Command::Stop),
            reset_header: header(Command::Reset),
            row_bits,
            row_zeros: zeros(WORD - row_bits),
            checked_slots: (0..).zip(format.directions.slots()).filter_map(slot).collect(),
            entry: Bits::all(format.transform_width),
            cut,
            origin: Bits::all(origin_bits),
            above: Bits::new(cut.high, above_bits),
            above_bits,
            above_zeros: zeros(above_bits),
            above_ones: "1".repeat(above_bits as usize),
            greatest_entry: binary((1 << (origin_bits - 1)) - 1, origin_bits),
            least_entry: binary((1 << (origin_bits - 1)) + 1, origin_bits),
            below_least: binary(1 << (origin_bits - 1), origin_bits),
            entries: ENTRIES,
            axes: AXES,
        }
    }
}
