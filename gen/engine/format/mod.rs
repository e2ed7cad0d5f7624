//! The formats of an engine, which follow from its options and from those of the unit behind it: how many bits words, blocks and
//! numbers have, and where their fields are.

mod agreement;
#[cfg(test)]
mod tests;
mod widths;

pub use widths::{Width, Widths};

use crate::params::EngineParams;
use crate::words::{BlockLayout, Command, LINK_NUMBER_BITS, QueryFlags, TriangleLayout};
use efsat_geometry::directions::Directions;
use efsat_hardware::number::Upper;
use efsat_unit::params::{Params, Truth};
use efsat_unit::words::{PacketKind, StreamFormat, StreamWidth};

/// The step of the grid is 2^-(bits of a code + this), so that the greatest exponent, 15, reaches 3 (1 + 2^-17), the
/// farthest that a projection is from an origin.
const GRID: u32 = 12;
/// An origin has at most so many bits more than a code, or it would not lie on the grid.
pub const ORIGIN_OVER_OFFSET: u32 = GRID + 1;
/// How many steps of a word a snapped point of B is off along an axis, as seen from one of A, which is snapped too.
const SNAPPED: u32 = 5;
/// Version of the block's format.
const VERSION: u32 = 1;

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
    /// Whether the unit answers for points that are snapped to its grid, which the volumes have to hold too.
    pub snapped: bool,
    /// Words of the pose.
    pub pose_words: u32,
    /// The format of the unit's stream, whose headers and poses the engine takes over.
    pub stream: StreamFormat,
}

impl EngineFormat {
    /// Words before the pose.
    pub const POSE_AT: u32 = 7;
    /// Words before the pose of a packet of pairs by number.
    #[doc(hidden)]
    pub const NUMBERS_POSE_AT: u32 = 3;
    /// Bits of an error of a shift.
    const SHIFT_ERROR_BITS: u32 = 16;
    /// Bits of the tag of a pair in a packet of pairs.
    const PACKET_TAG: u32 = 16;

    fn new(engine: &EngineParams, unit: &Params) -> Self {
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
            snapped: unit.truth == Truth::Snapped,
            pose_words: stream.record_words(PacketKind::Pose),
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

    /// Number of rows of a query: one for each two opposite directions.
    pub fn rows(&self) -> u32 {
        self.k() / 2
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

    /// What the floor of the sum of products and the word of the shift are rounded by, counted in G; and, if points are snapped,
    /// by how much less the real ones are apart than those: less than 5 steps of a word along each axis (docs/exact.md).
    pub(crate) fn shift_rounding(&self) -> u32 {
        let (grid, word) = (self.grid_fraction(), self.word_fraction());
        let steps = |count: u32| (count << grid.saturating_sub(word)).div_ceil(1 << word.saturating_sub(grid));
        1 + steps(1) + if self.snapped { steps(SNAPPED) } else { 0 }
    }

    /// What an error of a shift may be, counted in G: the roundings of three matrix entries, and the others.
    fn shift_error_bound(&self) -> u64 {
        let step = |fraction: u32| 1u64 << self.grid_fraction().saturating_sub(fraction);
        let entry = step(self.origin_fraction()).max(step(self.word_fraction()));
        // One more for a count that is rounded up.
        3 * entry + u64::from(self.shift_rounding()) + 1
    }

    /// The header word of a command.
    pub fn header(&self, command: Command) -> u64 {
        let high = if command == Command::Query { self.header_high() } else { 0 };
        let low = self.stream.header(PacketKind::Pose) - PacketKind::Pose as u32 + command as u32;
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
        self.row_at(self.rows())
    }

    /// The first word of a packet of pairs by number that is a pair, behind the pose.
    #[doc(hidden)]
    pub fn pairs_at(&self) -> u32 {
        Self::NUMBERS_POSE_AT + self.pose_words
    }

    /// The word of a row of a query.
    pub fn row_at(&self, row: u32) -> u32 {
        Self::POSE_AT + self.pose_words + row
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
