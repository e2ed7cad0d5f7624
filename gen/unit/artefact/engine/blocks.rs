//! What a block is compared with, in parts that a device compares fast.

use crate::params::engine::{BlockLayout, EngineFormat};

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

/// The bits of a number, the highest first.
pub(super) fn binary(value: u32, bits: u32) -> String {
    (0..bits).rev().map(|i| if value >> i & 1 == 1 { '1' } else { '0' }).collect()
}

pub(super) fn zeros(bits: u32) -> String {
    "0".repeat(bits as usize)
}

/// Code i of a block, both children counted through. The unusable code has its sign bit alone.
pub(super) fn code(format: &EngineFormat, i: u32) -> Code {
    let (low, bits) = (BlockLayout::CODES_AT + format.offset_bits * i, format.offset_bits);
    let (middle, end) = (low + bits / 2, low + bits);
    let upper = Part { high: end - 1, low: middle, due: binary(1 << (end - middle - 1), end - middle) };
    Code { upper, lower: Part { high: middle - 1, low, due: zeros(middle - low) } }
}

/// The tag of a block and the zeros behind it, in parts that are no longer than those of a code.
pub(super) fn block_tag_parts(block: &BlockLayout) -> Vec<Part> {
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
