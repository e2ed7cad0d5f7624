//! Blocks of trees, and what they are compared with, in parts that a device compares fast.

use super::{Bits, binary, zeros};
use crate::format::EngineFormat;
use crate::words::BlockLayout;

/// Bits that are compared together, and what they are compared with, the highest first.
#[derive(Debug)]
pub(crate) struct Part {
    pub bits: Bits,
    pub due: String,
}

/// A code of a block in two parts, compared with the one that is unusable.
#[derive(Debug)]
pub(crate) struct Code {
    pub upper: Part,
    pub lower: Part,
}

/// What is where in a block.
#[derive(Debug)]
pub(crate) struct Blocks {
    pub codes: Vec<Code>,
    pub code_count: usize,
    pub offset_bits: u32,
    pub block_tag_parts: Vec<Part>,
    pub origin_bits: u32,
    pub factor_bits: u32,
}

impl Blocks {
    pub fn new(format: &EngineFormat) -> Self {
        Self {
            codes: (0..2 * format.k()).map(|i| code(format, i)).collect(),
            code_count: 2 * format.k() as usize,
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

/// Code i of a block, both children counted through. The unusable code has its sign bit alone.
fn code(format: &EngineFormat, i: u32) -> Code {
    let (low, bits) = (BlockLayout::CODES_AT + format.offset_bits * i, format.offset_bits);
    let (middle, end) = (low + bits / 2, low + bits);
    let part = |low, end, due| Part { bits: Bits { high: end - 1, low }, due };
    let upper = part(middle, end, binary(1 << (end - middle - 1), end - middle));
    Code { upper, lower: part(low, middle, zeros(middle - low)) }
}

/// The tag of a block and the zeros behind it, in parts that are no longer than those of a code.
fn tag_parts(block: &BlockLayout) -> Vec<Part> {
    const LONGEST: u32 = 5;
    (block.tag_at..BlockLayout::CODES_AT)
        .step_by(LONGEST as usize)
        .map(|low| {
            let bits = LONGEST.min(BlockLayout::CODES_AT - low);
            let due = block.tag.checked_shr(low - block.tag_at).unwrap_or(0) & ((1 << bits) - 1);
            Part { bits: Bits::new(low, bits), due: binary(due, bits) }
        })
        .collect()
}
