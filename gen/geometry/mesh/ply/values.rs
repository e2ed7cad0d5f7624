//! The numbers behind a header, as text and binary.

use super::Values;
use super::header::Kind;
use crate::mesh::error::Fault;
use crate::mesh::text::{Lines, Words, number, quoted};

/// Numbers as text: an element begins on a line of its own and may go on to the next; blank lines are skipped.
pub(super) struct Text<'a> {
    words: Words<'a>,
    before: usize,
    /// Bytes that can hold numbers, at most: each takes two but the last.
    bytes: u64,
}

impl<'a> Text<'a> {
    pub fn new(rest: &'a [u8], before: usize) -> Result<Self, Fault> {
        Ok(Self { words: Words::new(Lines::new(rest)?, false), before, bytes: rest.len() as u64 })
    }

    fn word(&mut self) -> Result<String, String> {
        self.words.next().ok_or_else(|| "the file ends before it".to_owned())
    }
}

impl Values for Text<'_> {
    fn line(&self) -> Option<usize> {
        Some(self.before + self.words.line())
    }

    /// The type is not looked at: a decimal stands for the nearest binary64 number.
    fn coordinate(&mut self, _: Kind) -> Result<f64, String> {
        number(&self.word()?).map_err(|wrong| format!("{wrong} is no number"))
    }

    fn whole(&mut self, _: Kind) -> Result<i64, String> {
        let word = self.word()?;
        word.parse().map_err(|_| format!("'{}' is no whole number", quoted(&word)))
    }

    fn skip(&mut self, _: Kind, count: u64) -> Result<(), String> {
        (0..count).try_for_each(|_| self.word().map(drop))
    }

    fn has(&self, _: Kind, count: u64) -> bool {
        count <= self.bytes
    }

    fn end(&mut self) -> Result<(), String> {
        let rest = self.words.rest_of_line();
        if rest.is_empty() { Ok(()) } else { Err(format!("'{}' behind it on its line", quoted(&rest.join(" ")))) }
    }

    fn left(&mut self) -> Option<String> {
        let word = self.words.next()?;
        Some(format!("line {}: '{}'", self.before + self.words.line(), quoted(&word)))
    }
}

/// Numbers as bytes.
pub(super) struct Binary<'a> {
    rest: &'a [u8],
    big: bool,
}

impl<'a> Binary<'a> {
    pub fn new(rest: &'a [u8], big: bool) -> Self {
        Self { rest, big }
    }

    /// The next bytes, the least significant first.
    fn bytes<const N: usize>(&mut self) -> Result<[u8; N], String> {
        let (bytes, rest) = self.rest.split_first_chunk::<N>().ok_or("the file ends within it")?;
        self.rest = rest;
        let mut bytes = *bytes;
        if self.big {
            bytes.reverse();
        }
        Ok(bytes)
    }
}

impl Values for Binary<'_> {
    fn line(&self) -> Option<usize> {
        None
    }

    fn coordinate(&mut self, kind: Kind) -> Result<f64, String> {
        Ok(match kind {
            Kind::F32 => f32::from_le_bytes(self.bytes()?).into(),
            Kind::F64 => f64::from_le_bytes(self.bytes()?),
            kind => {
                let whole = self.whole(kind)?;
                // 64 bits may have more digits than binary64.
                if whole.unsigned_abs() > 1 << 53 {
                    return Err(format!("{whole}, which binary64 rounds"));
                }
                whole as f64
            }
        })
    }

    fn whole(&mut self, kind: Kind) -> Result<i64, String> {
        Ok(match kind {
            Kind::I8 => i8::from_le_bytes(self.bytes()?).into(),
            Kind::U8 => u8::from_le_bytes(self.bytes()?).into(),
            Kind::I16 => i16::from_le_bytes(self.bytes()?).into(),
            Kind::U16 => u16::from_le_bytes(self.bytes()?).into(),
            Kind::I32 => i32::from_le_bytes(self.bytes()?).into(),
            Kind::U32 => u32::from_le_bytes(self.bytes()?).into(),
            Kind::I64 => i64::from_le_bytes(self.bytes()?),
            Kind::U64 => {
                let whole = u64::from_le_bytes(self.bytes()?);
                i64::try_from(whole).map_err(|_| format!("{whole}, expected less than 2^63"))?
            }
            Kind::F32 | Kind::F64 => return Err("a number with a fraction".to_owned()),
        })
    }

    fn skip(&mut self, kind: Kind, count: u64) -> Result<(), String> {
        let bytes = usize::try_from(count).ok().and_then(|count| count.checked_mul(kind.size()));
        self.rest = bytes.and_then(|bytes| self.rest.get(bytes..)).ok_or("the file ends within it")?;
        Ok(())
    }

    fn has(&self, kind: Kind, count: u64) -> bool {
        count.checked_mul(kind.size() as u64).is_some_and(|bytes| bytes <= self.rest.len() as u64)
    }

    fn end(&mut self) -> Result<(), String> {
        Ok(())
    }

    fn left(&mut self) -> Option<String> {
        (!self.rest.is_empty()).then(|| format!("{} bytes", self.rest.len()))
    }
}
