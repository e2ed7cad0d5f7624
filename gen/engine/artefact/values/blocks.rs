//! Blocks of trees, and what they are compared with, in parts that a device compares fast.

use super::{Bits, binary};
use crate::format::EngineFormat;
use crate::words::BlockLayout;

/// Bits that are compared together, and what they are compared with, the highest first.
#[derive(Debug)]
pub(crate) struct Part {
    pub bits: Bits,
    pub due: String,
}

/// What is where in a block.
#[derive(Debug)]
pub(crate) struct Blocks {
    /// Each in parts, compared with the one that is unusable.
    pub codes: Vec<Vec<Part>>,
    pub code_parts: usize,
    pub code_count: usize,
    pub offset_bits: u32,
    pub block_tag_parts: Vec<Part>,
    pub origin_bits: u32,
    pub factor_bits: u32,
}

impl Blocks {
    pub fn new(format: &EngineFormat) -> Self {
        let codes: Vec<_> = (0..2 * format.k()).map(|i| code(format, i)).collect();
        Self {
            code_parts: codes[0].len(),
            code_count: codes.len(),
            codes,
            offset_bits: format.offset_bits,
            block_tag_parts: tag_parts(&format.block()),
            origin_bits: format.origin_bits,
            factor_bits: format.factor_bits,
        }
    }
}

/// Bits of a block.
pub(super) fn block_bits(format: &EngineFormat) -> u32 {
    8 * format.block().stride
}

/// Bits of a part: what one table of any part compares, as its word comes late in a clock.
const LONGEST: u32 = 4;

/// Code i of a block, both children counted through. The unusable code has its sign bit alone.
fn code(format: &EngineFormat, i: u32) -> Vec<Part> {
    let bits = format.offset_bits;
    parts(BlockLayout::CODES_AT + bits * i, bits, 1 << (bits - 1))
}

/// The tag of a block and the zeros behind it.
fn tag_parts(block: &BlockLayout) -> Vec<Part> {
    parts(block.tag_at, BlockLayout::CODES_AT - block.tag_at, block.tag)
}

/// So many bits from `low` on, which are to be `due`.
fn parts(low: u32, bits: u32, due: u32) -> Vec<Part> {
    (0..bits)
        .step_by(LONGEST as usize)
        .map(|done| {
            let bits = LONGEST.min(bits - done);
            let due = due.checked_shr(done).unwrap_or(0) & ((1 << bits) - 1);
            Part { bits: Bits::new(low + done, bits), due: binary(due, bits) }
        })
        .collect()
}
