//! Blocks of trees.

use super::{Bits, binary};
use crate::params::engine::{BlockLayout, EngineFormat};

/// What is where in a block.
#[derive(Debug)]
pub(in super::super) struct Blocks {
    pub block_bits: u32,
    pub codes: Vec<Bits>,
    pub codes_at: u32,
    pub code_count: usize,
    pub offset_bits: u32,
    pub tag_at: u32,
    pub tag_bits: u32,
    pub block_tag: String,
    pub unusable_code: String,
    pub origin_bits: u32,
    pub factor_bits: u32,
}

impl Blocks {
    pub fn new(format: &EngineFormat) -> Self {
        let block = format.block();
        let code = |i| {
            let low = BlockLayout::CODES_AT + format.offset_bits * i;
            Bits { high: low + format.offset_bits - 1, low }
        };
        Self {
            block_bits: block_bits(format),
            codes: (0..2 * format.k()).map(code).collect(),
            codes_at: BlockLayout::CODES_AT,
            code_count: 2 * format.k() as usize,
            offset_bits: format.offset_bits,
            tag_at: block.tag_at,
            tag_bits: BlockLayout::CODES_AT - block.tag_at,
            block_tag: binary(block.tag, BlockLayout::CODES_AT - block.tag_at),
            unusable_code: binary(1 << (format.offset_bits - 1), format.offset_bits),
            origin_bits: format.origin_bits,
            factor_bits: format.factor_bits,
        }
    }
}

/// Bits of a block.
pub(super) fn block_bits(format: &EngineFormat) -> u32 {
    8 * format.block().stride
}
