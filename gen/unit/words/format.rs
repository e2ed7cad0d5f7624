//! Where the fields of records and answers are.

use super::{AnswerFields, STATUS_BITS, StreamWidth, StreamWord};
use crate::pair::{Input, Pair, Pose};
use crate::params::{Axes, Method, Params, Transform};
use efsat_hardware::number::Upper;

/// What the records of a packet are. The discriminant is the low byte of the header.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum PacketKind {
    /// Pairs.
    Pairs = 1,
    /// One pose.
    Pose = 2,
}

/// Bit of the header of an exact unit.
const EXACT_BIT: u32 = 14;
/// Bit of the header of a unit that answers by determinants with bounds.
const DETERMINANTS_BIT: u32 = 15;
/// Bit of the header, and of the flags of a record, at which nothing but this is found: 17 axes, bypass.
const TOP_BIT: u32 = 31;
/// Place of the tag in a record.
pub const TAG_AT: u32 = 32;
/// Place of the bypass in the record of a pose.
pub const BYPASS_AT: u32 = TOP_BIT;

/// The stream format of a parameter set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StreamFormat {
    /// Bits of a word into the unit.
    pub width: StreamWidth,
    /// Bits of the tag.
    pub tag_width: u32,
    /// Flags of each kind in an answer: one for each axis, or for each witness.
    pub flags: u32,
    method: Method,
    axes: Axes,
    pub(super) number_bits: u32,
    pub(super) int_bits: u32,
    pub(super) sticky: bool,
    transform: Transform,
    guarded: bool,
}

impl StreamFormat {
    /// The format of validated parameters.
    pub fn new(params: &Params, width: StreamWidth) -> Self {
        Self {
            width,
            tag_width: params.tag_width,
            flags: params.flags(),
            method: params.method,
            axes: params.axes,
            number_bits: params.transform_width,
            int_bits: params.int_bits,
            sticky: params.upper == Upper::Sticky,
            transform: params.transform,
            guarded: params.guarded(),
        }
    }

    /// The low 32 bits of the header word; the others are not read. It names the format, so that a unit refuses what
    /// was packed for another one: kind in bits 7..0, bits of a number in 13..8, exact in 14, determinants in 15, bits of the tag in
    /// 23..16, integral digits in 27..24, sticky in 28, transform in 30..29 (0 off, 1 translate, 2 on), 17 axes in 31.
    pub fn header(&self, kind: PacketKind) -> u32 {
        let transform = match self.transform {
            Transform::Off => 0,
            Transform::Translate => 1,
            Transform::On => 2,
        };
        kind as u32
            | self.number_bits << 8
            | self.tag_width << 16
            | self.int_bits << 24
            | u32::from(self.sticky) << 28
            | transform << 29
            | u32::from(self.method == Method::Determinants) << DETERMINANTS_BIT
            | u32::from(self.method == Method::Exact) << EXACT_BIT
            | u32::from(self.axes == Axes::Seventeen) << TOP_BIT
    }

    /// Numbers in a record: 18 coordinates, or the entries of M and t that the unit has.
    pub fn numbers(&self, kind: PacketKind) -> u32 {
        match (kind, self.transform) {
            (PacketKind::Pairs, _) => 18,
            (PacketKind::Pose, Transform::On) => 12,
            (PacketKind::Pose, Transform::Translate) => 3,
            (PacketKind::Pose, Transform::Off) => 0,
        }
    }

    /// Bits from one number to the next.
    pub fn lane(&self) -> u32 {
        if self.number_bits <= 32 { 32 } else { 64 }
    }

    /// High bits of a number's field that a guarded unit checks to be its sign, because they do not reach it; 0 where there
    /// is nothing to check. All fields from the first number to the end of the record are checked alike.
    pub fn spare_bits(&self) -> u32 {
        if self.guarded { self.lane() - self.number_bits } else { 0 }
    }

    /// The first bit of a number in its record.
    pub fn number_at(&self, number: u32) -> u32 {
        let before = if self.tag_width <= 32 { 64 } else { 128 };
        before + self.lane() * number
    }

    /// Words of a record.
    pub fn record_words(&self, kind: PacketKind) -> u32 {
        self.number_at(self.numbers(kind)).div_ceil(self.width.bits())
    }

    /// Whether there are poses.
    pub fn has_pose(&self) -> bool {
        self.transform != Transform::Off
    }

    /// Clocks from pair to pair inside a long packet: as many as it has words, in whole slots of a unit of that interval.
    pub fn pair_period(&self, interval: usize) -> usize {
        (self.record_words(PacketKind::Pairs) as usize).next_multiple_of(interval)
    }

    /// The words of a pair: mantissa and sticky bit of the 18 coordinates of V0 V1 V2 W0 W1 W2.
    pub fn pair_record(&self, tag: u64, pair: &Pair) -> Vec<StreamWord> {
        self.record(PacketKind::Pairs, 0, tag, pair.a.iter().chain(&pair.b).flatten())
    }

    /// The words of a pose: mantissa and sticky bit of the nine entries of M, row by row, and the three of t.
    pub fn pose_record(&self, pose: &Pose) -> Vec<StreamWord> {
        let skipped = 12 - self.numbers(PacketKind::Pose);
        let numbers = pose.m.iter().flatten().chain(&pose.t).skip(skipped as usize);
        self.record(PacketKind::Pose, u32::from(pose.bypass) << BYPASS_AT, 0, numbers)
    }

    fn record<'a>(
        &self,
        kind: PacketKind,
        mut flags: u32,
        tag: u64,
        numbers: impl Iterator<Item = &'a Input>,
    ) -> Vec<StreamWord> {
        let mut lanes = vec![0; (self.record_words(kind) * self.width.bits() / 32) as usize];
        let mut put = |bit: u32, value: u64| {
            let lane = (bit / 32) as usize;
            lanes[lane] = value as u32;
            if let Some(high) = lanes.get_mut(lane + 1) {
                *high = (value >> 32) as u32;
            }
        };
        if kind == PacketKind::Pairs {
            put(TAG_AT, tag);
        }
        for (i, &Input { lo, sticky }) in (0..).zip(numbers) {
            put(self.number_at(i), if self.lane() == 32 { u64::from(lo as u32) } else { lo as u64 });
            flags |= u32::from(sticky && self.sticky) << i;
        }
        lanes[0] = flags;
        lanes.chunks(self.width.bits() as usize / 32).map(StreamWord::new).collect()
    }

    /// Bits of an answer that mean something.
    pub fn answer_bits(&self) -> u32 {
        STATUS_BITS + self.tag_width + 2 * self.flags
    }

    /// Bits of a word out of the unit: the least of 32, 64 and 128 that holds an answer.
    pub fn answer_width(&self) -> u32 {
        self.answer_bits().next_power_of_two().max(32)
    }

    /// The word of an answer.
    pub fn answer(&self, fields: &AnswerFields) -> u128 {
        let flags = u128::from(fields.separated) | u128::from(fields.overlapping) << self.flags;
        u128::from(fields.status) | u128::from(fields.tag) << STATUS_BITS | flags << (STATUS_BITS + self.tag_width)
    }

    /// The fields of a word, none if a bit is set that no answer has.
    pub fn answer_fields(&self, word: u128) -> Option<AnswerFields> {
        let field = |at: u32, bits: u32| word >> at & ((1 << bits) - 1);
        let fields = AnswerFields {
            status: field(0, STATUS_BITS) as u8,
            tag: field(STATUS_BITS, self.tag_width) as u64,
            separated: field(STATUS_BITS + self.tag_width, self.flags) as u32,
            overlapping: field(STATUS_BITS + self.tag_width + self.flags, self.flags) as u32,
        };
        (self.answer(&fields) == word).then_some(fields)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::words::StreamReport;

    fn pair(number: impl Fn(i64) -> (i64, bool)) -> Pair {
        let input = |i: i64| {
            let (lo, sticky) = number(i);
            Input { lo, sticky }
        };
        let point = |k: i64| [0, 1, 2].map(|i| input(3 * k + i));
        Pair { a: [0, 1, 2].map(point), b: [3, 4, 5].map(point) }
    }

    #[test]
    fn the_default_record_is_ten_words_of_64_bits() {
        let format = StreamFormat::new(&Params::default(), StreamWidth::Bits64);
        let words = format.pair_record(0xabcd, &pair(|i| (-i, true)));
        assert_eq!(words.len(), 10);
        assert_eq!(words[0], 0x0000_abcd_0000_0000, "no sticky bits with implied upper bounds");
        assert_eq!(words[1], 0xffff_ffff_0000_0000);
        assert_eq!(words[9], u128::from((-16i32) as u32) | u128::from((-17i32) as u32) << 32);
        assert_eq!(format.header(PacketKind::Pairs), 0x4410_2001);
        assert_eq!(format.pose_record(&Pose::identity(&Params::default()))[0], 1 << 31);
        assert_eq!((format.record_words(PacketKind::Pose), format.answer_width()), (7, 64));
    }

    #[test]
    fn a_pair_fits_one_word_of_1024_bits() {
        let params = Params { method: Method::Determinants, ..Params::default() };
        let format = StreamFormat::new(&params, StreamWidth::Bits1024);
        let words = format.pair_record(0xabcd, &pair(|i| (-i, false)));
        assert_eq!((words.len(), format.record_words(PacketKind::Pose)), (1, 1));
        assert_eq!(StreamWord::from_hex(&words[0].hex(1024)), Some(words[0]));
        assert_eq!(words[0].low(), 0xffff_ffff_0000_0000_0000_abcd_0000_0000);
        assert_eq!(format.header(PacketKind::Pairs), 0x4410_a001);
        let exact = StreamFormat::new(&Params::of(Method::Exact), StreamWidth::Bits1024);
        assert_eq!(exact.header(PacketKind::Pairs), 0x0410_6001);
        assert_eq!((format.answer_bits(), format.answer_width()), (8 + 16 + 18, 64));
    }

    #[test]
    fn wide_numbers_and_tags_take_64_bits_each() {
        let params = Params { transform_width: 48, tag_width: 64, upper: Upper::Sticky, ..Params::default() };
        let format = StreamFormat::new(&params, StreamWidth::Bits32);
        let words = format.pair_record(u64::MAX - 1, &pair(|i| (i - 1, i == 17)));
        assert_eq!(words.len(), 4 + 36);
        assert_eq!(words[..8], [1u128 << 17, 0xffff_fffe, 0xffff_ffff, 0, 0xffff_ffff, 0xffff_ffff, 0, 0]);
        assert_eq!((words[38].low(), words[39].low(), format.answer_width()), (16, 0, 128));
        let narrow = Params { tag_width: 0, ..Params::default() };
        assert_eq!(StreamFormat::new(&narrow, StreamWidth::Bits128).answer_width(), 32);
    }

    #[test]
    fn answers_are_taken_apart_again() {
        for tag_width in [0, 16, 64] {
            let params = Params { tag_width, axes: Axes::Seventeen, ..Params::default() };
            let format = StreamFormat::new(&params, StreamWidth::Bits64);
            let tag = u64::MAX.checked_shr(64 - tag_width).unwrap_or(0);
            let fields = AnswerFields { status: 2, tag, separated: 0x1_5555, overlapping: 0x0_aaaa };
            let word = format.answer(&fields);
            assert_eq!((format.answer_fields(word), fields.reported()), (Some(fields), None));
            assert_eq!(format.answer_fields(word | 1 << format.answer_bits()), None);
            let report = AnswerFields::report(StreamReport::TooShort);
            assert_eq!((report.status, report.reported()), (0b1000_1011, Some(StreamReport::TooShort)));
        }
    }
}
