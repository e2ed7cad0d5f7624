//! Records taken apart again.

use super::{BYPASS_AT, PacketKind, StreamFormat, StreamWord, TAG_AT};
use crate::pair::{Input, Pair, Pose};

/// A record: its bits by place.
pub struct Record<'a> {
    format: &'a StreamFormat,
    words: &'a [StreamWord],
}

impl<'a> Record<'a> {
    /// The words of a record.
    pub fn new(format: &'a StreamFormat, words: &'a [StreamWord]) -> Self {
        Self { format, words }
    }

    fn bits(&self, at: u32, count: u32) -> u64 {
        let width = self.format.width.bits();
        let bit = |i: u32| u64::from(self.words[(i / width) as usize].bit(i % width));
        (0..count).fold(0, |bits, i| bits | bit(at + i) << i)
    }

    /// The tag of a pair.
    pub fn tag(&self) -> u64 {
        self.bits(TAG_AT, self.format.tag_width)
    }

    /// The bypass of a pose.
    pub fn bypass(&self) -> bool {
        self.bits(BYPASS_AT, 1) == 1
    }

    /// A number, as far as the unit reads it.
    fn number(&self, i: u32) -> Input {
        let bits = self.format.number_bits;
        let value = self.bits(self.format.number_at(i), bits) as i64;
        let lo = value << (64 - bits) >> (64 - bits);
        Input { lo, sticky: self.format.sticky && self.bits(i, 1) == 1 }
    }

    /// Whether a guarded unit finds a number that is not the sign extension of what it reads of it.
    pub fn unfit(&self) -> bool {
        let (spare, lane) = (self.format.spare_bits(), self.format.lane());
        let end = self.words.len() as u32 * self.format.width.bits();
        let signs = |at: u32| self.bits(at + lane - 1 - spare, spare + 1);
        let all = (1 << (spare + 1)) - 1;
        spare > 0 && (self.format.number_at(0)..end).step_by(lane as usize).any(|at| ![0, all].contains(&signs(at)))
    }

    /// The pair.
    pub fn pair(&self) -> Pair {
        let point = |k: u32| [0, 1, 2].map(|i| self.number(3 * k + i));
        Pair { a: [0, 1, 2].map(point), b: [3, 4, 5].map(point) }
    }

    /// The pose; what the record does not have is as in the identity.
    pub fn pose(&self) -> Pose {
        let mut pose =
            Pose { bypass: self.bypass(), ..Pose::with_one(1 << (self.format.number_bits - self.format.int_bits)) };
        let turns = self.format.numbers(PacketKind::Pose) == 12;
        let matrix = pose.m.iter_mut().flatten().filter(|_| turns);
        for (i, entry) in (0..).zip(matrix.chain(&mut pose.t)) {
            *entry = self.number(i);
        }
        pose
    }
}
