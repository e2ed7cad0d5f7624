//! A word of a stream.

use crate::params::options::Choice;
use std::fmt::{self, Formatter, LowerHex};

/// Bits of a word of the stream into the unit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum StreamWidth {
    /// 32.
    Bits32,
    /// 64.
    #[default]
    Bits64,
    /// 128.
    Bits128,
    /// 256.
    Bits256,
    /// 512.
    Bits512,
    /// 1024: a pair in one word, if its numbers have no more than 32 bits.
    Bits1024,
}

impl StreamWidth {
    /// Number of bits.
    pub const fn bits(self) -> u32 {
        match self {
            Self::Bits32 => 32,
            Self::Bits64 => 64,
            Self::Bits128 => 128,
            Self::Bits256 => 256,
            Self::Bits512 => 512,
            Self::Bits1024 => 1024,
        }
    }
}

impl Choice for StreamWidth {
    const ALL: &'static [Self] =
        &[Self::Bits32, Self::Bits64, Self::Bits128, Self::Bits256, Self::Bits512, Self::Bits1024];

    fn name(self) -> &'static str {
        match self {
            Self::Bits32 => "32",
            Self::Bits64 => "64",
            Self::Bits128 => "128",
            Self::Bits256 => "256",
            Self::Bits512 => "512",
            Self::Bits1024 => "1024",
        }
    }
}

/// A word of a stream, of up to 1024 bits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StreamWord([u32; StreamWord::LANES]);

impl StreamWord {
    /// Of 32 bits each, the lowest first.
    const LANES: usize = 32;

    /// From its lanes of 32 bits, the lowest first; those that are missing are zero.
    pub(super) fn new(lanes: &[u32]) -> Self {
        Self(std::array::from_fn(|i| lanes.get(i).copied().unwrap_or(0)))
    }

    /// The lowest 128 bits: all of an answer.
    pub fn low(&self) -> u128 {
        self.0[..4].iter().rev().fold(0, |word, lane| word << 32 | u128::from(*lane))
    }

    /// A bit.
    pub fn bit(&self, at: u32) -> bool {
        self.0[(at / 32) as usize] >> (at % 32) & 1 == 1
    }

    /// The word with a bit changed.
    pub fn flipped(mut self, at: u32) -> Self {
        self.0[(at / 32) as usize] ^= 1 << (at % 32);
        self
    }

    /// Its bytes, the lowest first.
    pub fn bytes(&self) -> impl Iterator<Item = u8> {
        self.0.into_iter().flat_map(u32::to_le_bytes)
    }

    /// The hexadecimal digits of so many bits.
    pub fn hex(&self, bits: u32) -> String {
        self.0[..(bits / 32) as usize].iter().rev().map(|lane| format!("{lane:08x}")).collect()
    }

    /// The word that hexadecimal digits spell; none if something else is among them, or they are too many.
    pub fn from_hex(text: &str) -> Option<Self> {
        let mut word = Self::default();
        for (i, digit) in text.chars().rev().enumerate() {
            *word.0.get_mut(i / 8)? |= digit.to_digit(16)? << (4 * (i % 8));
        }
        Some(word)
    }
}

impl From<u128> for StreamWord {
    fn from(low: u128) -> Self {
        Self::new(&[0, 32, 64, 96].map(|at| (low >> at) as u32))
    }
}

impl PartialEq<u128> for StreamWord {
    fn eq(&self, other: &u128) -> bool {
        *self == Self::from(*other)
    }
}

impl LowerHex for StreamWord {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let digits = self.hex(1024);
        let digits = digits.trim_start_matches('0');
        f.pad_integral(true, "0x", if digits.is_empty() { "0" } else { digits })
    }
}
