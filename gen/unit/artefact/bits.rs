//! Bits that stand side by side.

use std::fmt;

/// Bits of a word from the highest to the lowest, printed as the range that VHDL takes: `7 downto 0`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bits {
    /// The highest.
    pub high: u32,
    /// The lowest.
    pub low: u32,
}

impl Bits {
    /// So many bits from `low` on, at least one.
    pub fn new(low: u32, bits: u32) -> Self {
        Self { high: low + bits - 1, low }
    }

    /// All bits of a word.
    pub fn all(bits: u32) -> Self {
        Self::new(0, bits)
    }
}

impl fmt::Display for Bits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} downto {}", self.high, self.low)
    }
}
