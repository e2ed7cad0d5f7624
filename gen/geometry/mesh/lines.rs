//! A reader that hands out one line at a time, so that it is known where a parser behind it stopped.

use std::cell::Cell;
use std::io::{Read, Result, Seek, SeekFrom};

/// A text, preceded by a header line that is not in it, one line for each call of `read`.
///
/// The parsers of the crates we use wrap their input in a buffer and do not say where they met an error. A buffer
/// asks for more only when it is empty, so with a line for each call the position is that of the line last parsed.
pub(super) struct LineReader<'a> {
    header: &'static [u8],
    header_sent: usize,
    text: &'a [u8],
    start: usize,
    position: &'a Cell<usize>,
}

impl<'a> LineReader<'a> {
    /// Reads `header`, then `text` from `position` on; `position` follows as lines are read.
    pub(super) fn new(header: &'static str, text: &'a str, position: &'a Cell<usize>) -> Self {
        Self { header: header.as_bytes(), header_sent: 0, text: text.as_bytes(), start: position.get(), position }
    }
}

impl Read for LineReader<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> Result<usize> {
        let header = &self.header[self.header_sent..];
        let from = self.position.get();
        let line = match header {
            [] => self.text[from..].split_inclusive(|&byte| byte == b'\n').next().unwrap_or_default(),
            _ => header,
        };
        let length = line.len().min(buffer.len());
        buffer[..length].copy_from_slice(&line[..length]);
        if header.is_empty() {
            self.position.set(from + length);
        } else {
            self.header_sent += length;
        }
        Ok(length)
    }
}

impl Seek for LineReader<'_> {
    /// Only back to the start, which is all that telling formats apart takes.
    fn seek(&mut self, to: SeekFrom) -> Result<u64> {
        if to != SeekFrom::Start(0) {
            return Err(std::io::ErrorKind::Unsupported.into());
        }
        self.header_sent = 0;
        self.position.set(self.start);
        Ok(0)
    }
}

/// The number, counted from 1, of the line that ends at byte `position` of `text`.
pub(super) fn line_before(text: &str, position: usize) -> usize {
    let before = &text.as_bytes()[..position];
    let whole = before.strip_suffix(b"\n").unwrap_or(before);
    1 + whole.iter().filter(|&&byte| byte == b'\n').count()
}
