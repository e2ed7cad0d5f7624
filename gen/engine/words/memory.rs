//! Blocks and triangles in memory.

/// Bit of a link that says that it leads to a triangle.
pub const LEAF_BIT: u32 = 31;
/// Bits of the number in a link.
pub const LINK_NUMBER_BITS: u32 = 28;
/// The link of a child that is not there.
pub const NO_CHILD: u32 = u32::MAX;

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
