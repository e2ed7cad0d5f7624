//! Blocks: the volumes of the two children of an inner node, as they are in memory.

use crate::format::EngineFormat;
use crate::words::{BlockLayout, LEAF_BIT, NO_CHILD};

/// What a child is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Link {
    /// There is none.
    None,
    /// A triangle.
    Leaf(u32),
    /// An inner node: the block of its children.
    Inner(u32),
}

impl Link {
    /// Its word.
    pub fn word(self) -> u32 {
        match self {
            Self::None => NO_CHILD,
            Self::Leaf(number) => number | 1 << LEAF_BIT,
            Self::Inner(number) => number,
        }
    }

    /// What a word says. A number has 31 bits here: one that no tree has is refused where it leads.
    fn of(word: u32) -> Self {
        let number = word & !(1 << LEAF_BIT);
        match word {
            NO_CHILD => Self::None,
            _ if word == number => Self::Inner(number),
            _ => Self::Leaf(number),
        }
    }
}

/// Why a block is none of a tree in this format. Engine and model end the query.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BadBlock {
    /// Another number of directions or of bits, or no block.
    #[error("tag {found:#06x}: expected {expected:#06x}")]
    Tag {
        /// What was found.
        found: u32,
        /// The tag of the format.
        expected: u32,
    },
    /// The bits between tag and codes.
    #[error("bits {from} to {to} not all zero: expected zeros")]
    NotZero {
        /// The first of them.
        from: u32,
        /// The last of them.
        to: u32,
    },
    /// A code that has no opposite.
    #[error("code {direction} of child {child}: {found}: expected at least {least}")]
    Code {
        /// Its child, 0 left or 1 right.
        child: usize,
        /// Its direction.
        direction: usize,
        /// What was found.
        found: i32,
        /// The least there may be.
        least: i32,
    },
}

impl BadBlock {
    /// What was found, in words.
    pub fn found(&self) -> String {
        match self {
            Self::Tag { found, .. } => format!("{found:#06x}"),
            Self::NotZero { .. } => "not all zero".to_owned(),
            Self::Code { found, .. } => found.to_string(),
        }
    }

    /// What was expected, in words.
    pub fn expected(&self) -> String {
        match self {
            Self::Tag { expected, .. } => format!("{expected:#06x}"),
            Self::NotZero { .. } => "zeros".to_owned(),
            Self::Code { least, .. } => format!("at least {least}"),
        }
    }
}

/// The volumes of the two children of a node: child c holds all x with n_i . (x - o) <= codes_i 2^e G.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Block {
    /// What the children are, left and right.
    pub links: [Link; 2],
    /// o, in steps of 2^-(origin bits - 1).
    pub origin: [i32; 3],
    /// e.
    pub exponent: u32,
    /// The codes of both children, one for each direction; zeros for a child that is not there.
    pub codes: [Vec<i32>; 2],
}

/// One child's volume: what the test of two volumes reads of a block.
#[derive(Clone, Copy, Debug)]
pub struct Volume<'a> {
    /// e.
    pub exponent: u32,
    /// One code for each direction.
    pub codes: &'a [i32],
}

impl Block {
    /// The volume of a child.
    pub fn volume(&self, child: usize) -> Volume<'_> {
        Volume { exponent: self.exponent, codes: &self.codes[child] }
    }

    /// The block as 64-bit words, the lowest first, up to its stride.
    pub fn words(&self, format: &EngineFormat) -> Vec<u64> {
        let layout = format.block();
        let mut words = vec![0; layout.stride as usize / 8];
        for (child, link) in (0..).zip(self.links) {
            put(&mut words, BlockLayout::link_at(child), BlockLayout::LINK_BITS, link.word().into());
        }
        for (axis, coordinate) in (0..).zip(self.origin) {
            put(&mut words, layout.origin_at + axis * layout.origin_bits, layout.origin_bits, coordinate as u64);
        }
        put(&mut words, layout.exponent_at, BlockLayout::EXPONENT_BITS, self.exponent.into());
        put(&mut words, layout.tag_at, BlockLayout::TAG_BITS, layout.tag.into());
        for (child, codes) in (0..).zip(&self.codes) {
            for (direction, code) in (0..).zip(codes) {
                put(&mut words, layout.code_at(child, direction), layout.code_bits, *code as u64);
            }
        }
        words
    }

    /// Reads the words of a block.
    ///
    /// # Errors
    /// If they are none of this format: what the engine refuses as well.
    ///
    /// # Panics
    /// If there are fewer words than a block has.
    pub fn of(words: &[u64], format: &EngineFormat) -> Result<Self, BadBlock> {
        let layout = format.block();
        let found = field(words, layout.tag_at, BlockLayout::TAG_BITS) as u32;
        if found != layout.tag {
            return Err(BadBlock::Tag { found, expected: layout.tag });
        }
        let zeros = BlockLayout::CODES_AT - layout.zeros_at;
        if field(words, layout.zeros_at, zeros) != 0 {
            return Err(BadBlock::NotZero { from: layout.zeros_at, to: BlockLayout::CODES_AT - 1 });
        }
        let link = |child| Link::of(field(words, BlockLayout::link_at(child), BlockLayout::LINK_BITS) as u32);
        let coordinate = |axis| signed(words, layout.origin_at + axis * layout.origin_bits, layout.origin_bits) as i32;
        let codes = [0, 1].map(|child| {
            (0..layout.directions)
                .map(|i| signed(words, layout.code_at(child, i), layout.code_bits) as i32)
                .collect::<Vec<i32>>()
        });
        let least = -format.most();
        for (child, codes) in codes.iter().enumerate() {
            if let Some(direction) = codes.iter().position(|&found| found < least) {
                return Err(BadBlock::Code { child, direction, found: codes[direction], least });
            }
        }
        let exponent = field(words, layout.exponent_at, BlockLayout::EXPONENT_BITS) as u32;
        Ok(Self { links: [0, 1].map(link), origin: [0, 1, 2].map(coordinate), exponent, codes })
    }
}

/// Puts the low bits of a value at a place where there are zeros.
pub fn put(words: &mut [u64], at: u32, bits: u32, value: u64) {
    let (index, shift) = ((at / 64) as usize, at % 64);
    let value = u128::from(value & (u64::MAX >> (64 - bits))) << shift;
    words[index] |= value as u64;
    if let Some(high) = words.get_mut(index + 1) {
        *high |= (value >> 64) as u64;
    }
}

/// The bits at a place, at most 64; none are zero.
pub fn field(words: &[u64], at: u32, bits: u32) -> u64 {
    let (index, shift) = ((at / 64) as usize, at % 64);
    let high = words.get(index + 1).copied().unwrap_or(0);
    let value = (u128::from(words[index]) | u128::from(high) << 64) >> shift;
    value as u64 & (u64::MAX >> (64 - bits.clamp(1, 64))) & if bits == 0 { 0 } else { u64::MAX }
}

/// The bits at a place in two's complement, at most 64.
pub fn signed(words: &[u64], at: u32, bits: u32) -> i64 {
    let shift = 64 - bits;
    (field(words, at, bits) << shift) as i64 >> shift
}
