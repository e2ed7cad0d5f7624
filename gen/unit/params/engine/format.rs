//! The formats of the engine: blocks and triangles in memory, words of a query, numbers of the test.

use super::{EngineParams, Widths};
use crate::params::Params;
use crate::params::stream::{Kind, StreamFormat, StreamWidth};
use efsat_geometry::directions::Directions;
use efsat_hardware::number::Upper;

/// Bit of a link that says that it leads to a triangle.
pub const LEAF_BIT: u32 = 31;
/// Bits of the number in a link.
pub const LINK_NUMBER_BITS: u32 = 28;
/// The link of a child that is not there.
pub const NO_CHILD: u32 = u32::MAX;
/// The step of the grid is 2^-(bits of a code + this), so that the greatest exponent, 15, reaches 3 (1 + 2^-17), the
/// farthest that a projection is from an origin.
const GRID: u32 = 12;
/// An origin has at most so many bits more than a code, or it would not lie on the grid.
pub const ORIGIN_OVER_OFFSET: u32 = GRID + 1;
/// Version of the block's format.
const VERSION: u32 = 1;

/// Where the fields of a block are. All fields are little-endian, bit 0 the lowest bit of the first byte.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BlockLayout {
    /// Bits that mean something; those after them up to the stride are zero.
    pub bits: u32,
    /// Bytes from one block to the next: the least power of two that holds a block, so that no block crosses 4 KB.
    pub stride: u32,
    /// Place of the x of the origin; y and z follow.
    pub origin_at: u32,
    /// Bits of a coordinate of the origin.
    pub origin_bits: u32,
    /// Place of the exponent.
    pub exponent_at: u32,
    /// Place of the tag of the format.
    pub tag_at: u32,
    /// The tag: directions in bits 7..0, bits of a code in 11..8, version in 15..12.
    pub tag: u32,
    /// Place of the bits between tag and codes, which are zero.
    pub zeros_at: u32,
    /// Bits of a code.
    pub code_bits: u32,
    /// Codes of a child.
    pub directions: u32,
}

impl BlockLayout {
    /// Bits of a link.
    pub const LINK_BITS: u32 = 32;
    /// Bits of the exponent.
    pub const EXPONENT_BITS: u32 = 4;
    /// Bits of the tag.
    pub const TAG_BITS: u32 = 16;
    /// Place of the first code.
    pub const CODES_AT: u32 = 152;
    /// Bits of the greatest block.
    pub const MOST_BITS: u32 = 1024;

    /// Place of the link of a child: 0 left, 1 right.
    pub const fn link_at(child: u32) -> u32 {
        Self::LINK_BITS * child
    }

    /// Place of a code of a child.
    pub const fn code_at(&self, child: u32, direction: u32) -> u32 {
        Self::CODES_AT + self.code_bits * (self.directions * child + direction)
    }
}

/// Where the fields of a triangle are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TriangleLayout {
    /// Bits that mean something.
    pub bits: u32,
    /// Bytes from one triangle to the next.
    pub stride: u32,
    /// Bits of the number that answers carry, from bit 0.
    pub number_bits: u32,
    /// Place of the sticky bit of number 0, if there are any; the others follow.
    pub sticky_at: Option<u32>,
    /// Place of the first of the nine numbers v0_x .. v2_z, which is also the distance from one to the next.
    pub lane: u32,
}

/// Places of the flags in the query's word 5.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct QueryFlags;

impl QueryFlags {
    /// Stop at the first certain contact.
    pub const FIRST_CONTACT: u32 = 32;
    /// Answer separate pairs too.
    pub const ALL_PAIRS: u32 = 33;
    /// No triangle test: leaf pairs are answered possibly incorrect.
    pub const LEAF_PAIRS: u32 = 34;
    /// Keep the caches of the query before: the images are still what they were.
    pub const KEEP_CACHES: u32 = 35;
    /// Place of the number that the report returns.
    pub const NUMBER_AT: u32 = 40;
    /// Its bits.
    pub const NUMBER_BITS: u32 = 24;
    /// How many numbers that are.
    pub const NUMBERS: u32 = 1 << Self::NUMBER_BITS;
}

/// The formats of an engine and the unit behind it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EngineFormat {
    /// Directions of a volume.
    pub directions: Directions,
    /// Bits of a coordinate of an origin; one of them is integral.
    pub origin_bits: u32,
    /// Bits of a code.
    pub offset_bits: u32,
    /// Bits of a factor.
    pub factor_bits: u32,
    /// Greatest level of a pair of nodes.
    pub tree_height: u32,
    /// Bits of a number of a triangle and of a pose.
    pub transform_width: u32,
    /// Integral digits of those.
    pub int_bits: u32,
    /// Whether triangles and poses have sticky bits.
    pub sticky: bool,
    /// Words of the pose.
    pub pose_words: u32,
    /// The format of the unit's stream, whose headers and poses the engine takes over.
    pub stream: StreamFormat,
}

/// What a packet to the engine asks for. The discriminant is the low byte of its header; 1 and 2 are pairs and poses for the
/// unit alone ([`Kind`]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Command {
    /// Find the pairs of triangles that touch.
    Query = 3,
    /// Fill memory in block RAM.
    Load = 4,
    /// End a query that runs or waits.
    Stop = 5,
    /// Forget all work.
    Reset = 6,
}

impl EngineFormat {
    /// Words before the pose.
    pub const POSE_AT: u32 = 7;
    /// Bits of an error of a shift.
    const SHIFT_ERROR_BITS: u32 = 16;
    /// Bits of the tag of a pair in a packet of pairs.
    const PACKET_TAG: u32 = 16;

    pub(super) fn new(engine: &EngineParams, unit: &Params) -> Self {
        let stream = StreamFormat::new(&Self::packets(unit), StreamWidth::Bits64);
        Self {
            directions: engine.directions,
            origin_bits: engine.origin_bits,
            offset_bits: engine.offset_bits,
            factor_bits: engine.factor_bits,
            tree_height: engine.tree_height,
            transform_width: unit.transform_width,
            int_bits: unit.int_bits,
            sticky: unit.upper == Upper::Sticky,
            pose_words: stream.record_words(Kind::Pose),
            stream,
        }
    }

    /// The parameters by which packets of pairs and poses are made and read: those of the unit in the engine, with a tag of
    /// 16 bits, so that an answer has no more than 64.
    pub fn packets(unit: &Params) -> Params {
        Params { tag_width: Self::PACKET_TAG, ..unit.clone() }
    }

    /// Number of directions.
    pub fn k(&self) -> u32 {
        self.directions.count() as u32
    }

    /// The greatest magnitude of a code, 2^(bits - 1) - 1.
    pub fn most(&self) -> i32 {
        (1 << (self.offset_bits - 1)) - 1
    }

    /// Fraction bits of the grid G.
    pub fn grid_fraction(&self) -> u32 {
        self.offset_bits + GRID
    }

    /// Fraction bits of origins and of the matrix that meets them.
    pub fn origin_fraction(&self) -> u32 {
        self.origin_bits - 1
    }

    /// The greatest magnitude of a coordinate of an origin and of a matrix entry that meets it.
    pub fn most_origin(&self) -> i32 {
        (1 << self.origin_fraction()) - 1
    }

    /// Fraction bits of the words of triangles and poses.
    pub fn word_fraction(&self) -> u32 {
        self.transform_width - self.int_bits
    }

    /// A matrix entry is a pose word shifted to the right by this, or to the left if it is negative, and saturated.
    pub fn matrix_shift(&self) -> i32 {
        self.word_fraction() as i32 - self.origin_fraction() as i32
    }

    /// A coordinate of the shift is a pose word shifted to the right by this, or to the left if it is negative.
    pub fn translation_shift(&self) -> i32 {
        self.word_fraction() as i32 - self.grid_fraction() as i32
    }

    /// The sum of products of matrix and origin is shifted to the right by this to the grid.
    pub fn product_shift(&self) -> i32 {
        2 * self.origin_fraction() as i32 - self.grid_fraction() as i32
    }

    /// An origin is shifted to the left by this to the grid.
    pub fn origin_shift(&self) -> u32 {
        self.grid_fraction() - self.origin_fraction()
    }

    /// A factor counts 2^-this.
    pub fn factor_fraction(&self) -> u32 {
        self.factor_bits - 1
    }

    /// Bits of a choice in a row of the query.
    pub fn choice_bits(&self) -> u32 {
        let most = self.directions.slots().map(<[u8]>::len).into_iter().max().unwrap_or(1);
        most.next_power_of_two().ilog2()
    }

    /// Bits of the rest of a row.
    pub fn rest_bits(&self) -> u32 {
        self.offset_bits + 3
    }

    /// Place of a choice in a row; its factor follows.
    pub fn choice_at(&self, slot: u32) -> u32 {
        slot * (self.choice_bits() + self.factor_bits)
    }

    /// Place of the rest in a row; zeros follow.
    pub fn rest_at(&self) -> u32 {
        self.choice_at(3)
    }

    /// Bits of an error of a shift; axis i is at that many bits times i of word 6.
    pub fn shift_error_bits(&self) -> u32 {
        Self::SHIFT_ERROR_BITS
    }

    /// What an error of a shift may be, counted in G: the roundings of three matrix entries and of the sum, and that of the
    /// shift.
    pub(super) fn shift_error_bound(&self) -> u64 {
        let step = |fraction: u32| 1u64 << self.grid_fraction().saturating_sub(fraction);
        let entry = step(self.origin_fraction()).max(step(self.word_fraction()));
        // One more for a count that is rounded up.
        3 * entry + step(self.word_fraction()) + 2
    }

    /// The header word of a command.
    pub fn header(&self, command: Command) -> u64 {
        let high = if command == Command::Query { self.header_high() } else { 0 };
        let low = self.stream.header(Kind::Pose) - Kind::Pose as u32 + command as u32;
        u64::from(low) | u64::from(high) << 32
    }

    /// The word of a stop or of a soft reset: the number of the query that is to end, or of the report of the reset, is where a
    /// query has its own.
    pub fn order(&self, command: Command, number: u32) -> u64 {
        self.header(command) | u64::from(number % QueryFlags::NUMBERS) << QueryFlags::NUMBER_AT
    }

    /// Whether a word is that of a stop or of a soft reset, whatever its number.
    pub fn is_order(&self, command: Command, word: u64) -> bool {
        word & ((1 << QueryFlags::NUMBER_AT) - 1) == self.header(command)
    }

    /// The upper half of a query's header word: directions in bits 7..0, bits of a code in 11..8, of a factor in 16..12, of an
    /// origin in 21..17.
    pub fn header_high(&self) -> u32 {
        self.k() | self.offset_bits << 8 | self.factor_bits << 12 | self.origin_bits << 17
    }

    /// Words of a query.
    pub fn query_words(&self) -> u32 {
        self.row_at(self.k())
    }

    /// The word of a row of a query.
    pub fn row_at(&self, direction: u32) -> u32 {
        Self::POSE_AT + self.pose_words + direction
    }

    /// Where the fields of a block are.
    pub fn block(&self) -> BlockLayout {
        let origin_at = 2 * BlockLayout::LINK_BITS;
        let exponent_at = origin_at + 3 * self.origin_bits;
        let tag_at = exponent_at + BlockLayout::EXPONENT_BITS;
        let bits = BlockLayout::CODES_AT + 2 * self.k() * self.offset_bits;
        BlockLayout {
            bits,
            stride: bits.next_power_of_two().max(256) / 8,
            origin_at,
            origin_bits: self.origin_bits,
            exponent_at,
            tag_at,
            tag: self.k() | self.offset_bits << 8 | VERSION << 12,
            zeros_at: tag_at + BlockLayout::TAG_BITS,
            code_bits: self.offset_bits,
            directions: self.k(),
        }
    }

    /// Where the fields of a triangle are.
    pub fn triangle(&self) -> TriangleLayout {
        let lane = if self.transform_width <= 32 { 32 } else { 64 };
        let bits = 10 * lane;
        let number_bits = if self.sticky { 23 } else { LINK_NUMBER_BITS };
        let sticky_at = self.sticky.then_some(number_bits);
        TriangleLayout { bits, stride: bits.next_power_of_two() / 8, number_bits, sticky_at, lane }
    }

    /// Widths of the numbers of the test.
    pub fn widths(&self) -> Widths {
        Widths::new(self)
    }
}
