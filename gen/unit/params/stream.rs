//! The stream format: how pairs, poses and verdicts travel through the words of an AXI4-Stream (docs/stream.md).
//!
//! A packet is one header word and then records: any number of pairs, or one pose. A record is a row of little-endian
//! fields, padded with zeros to whole words:
//!
//! ```text
//! bits 31..0    flags: bit i is the sticky bit of number i (sticky designs); bit 31 of a pose is its bypass
//! bits 63..32   tag of a pair (bits 95..32 of 128 where the tag is wider than 32 bits), zero in a pose
//! then          the numbers, sign-extended to 32 bits each, or to 64 where they are wider than 32
//! ```
//!
//! Every packet is answered by one packet: one word a pair, or one report. An answer is `status` (8 bits), tag,
//! separated and overlapping axes, side by side from bit 0, in the narrowest of the legal words.

use super::options::Choice;
use super::{Axes, Method, Params, Transform};
use efsat_hardware::number::Upper;
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
    fn new(lanes: &[u32]) -> Self {
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

/// What the records of a packet are. The discriminant is the low byte of the header.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Kind {
    /// Pairs.
    Pairs = 1,
    /// One pose.
    Pose = 2,
}

/// What a word that is no verdict says. The discriminant is its reason, bits 3..2 of the status.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Report {
    /// The pose holds for the packets that follow.
    PoseTaken = 0,
    /// The header is no header, or one for another design; the packet was skipped.
    UnknownHeader = 1,
    /// The packet ended inside a record, or without one.
    TooShort = 2,
    /// A pose packet went on after its record; the pose was not taken.
    TooLong = 3,
}

impl Report {
    const ALL: [Self; 4] = [Self::PoseTaken, Self::UnknownHeader, Self::TooShort, Self::TooLong];
}

/// Status bits 1..0 of a report, where a verdict has its code.
pub const REPORT: u8 = 0b11;
/// Place of the reason in the status of a report.
pub const REASON_AT: u32 = 2;
/// Status bit of a packet that was malformed: none of its verdicts counts.
pub const MALFORMED: u8 = 1 << 7;
/// Status bit of a pair outside the declared ranges; only units with a guard set it.
pub const OUTSIDE: u8 = 1 << 4;
/// Bits of the status.
pub const STATUS_BITS: u32 = 8;
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

/// The status of a verdict: its code, and whether the pair is outside the declared ranges.
pub fn verdict_status(code: u8, outside: bool) -> u8 {
    if outside { code | OUTSIDE } else { code }
}

/// One word of answers, taken apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AnswerFields {
    /// Code of a verdict in bits 1..0 and [`OUTSIDE`], or [`REPORT`] with the reason in bits 3..2 and [`MALFORMED`].
    pub status: u8,
    /// Tag of the pair.
    pub tag: u64,
    /// The axes on which the images are certainly disjoint, or the witnesses of that kind.
    pub separated: u32,
    /// The axes on which the images certainly overlap, or the witnesses of that kind.
    pub overlapping: u32,
}

impl AnswerFields {
    /// The word of a report.
    pub fn report(report: Report) -> Self {
        let malformed = if report == Report::PoseTaken { 0 } else { MALFORMED };
        Self { status: REPORT | (report as u8) << REASON_AT | malformed, tag: 0, separated: 0, overlapping: 0 }
    }

    /// What the word reports, none if it is a verdict.
    pub fn reported(&self) -> Option<Report> {
        (self.status & 0b11 == REPORT).then(|| Report::ALL[usize::from(self.status >> REASON_AT & 0b11)])
    }
}

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
    number_bits: u32,
    int_bits: u32,
    sticky: bool,
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
    pub fn header(&self, kind: Kind) -> u32 {
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
    pub fn numbers(&self, kind: Kind) -> u32 {
        match (kind, self.transform) {
            (Kind::Pairs, _) => 18,
            (Kind::Pose, Transform::On) => 12,
            (Kind::Pose, Transform::Translate) => 3,
            (Kind::Pose, Transform::Off) => 0,
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
    pub fn record_words(&self, kind: Kind) -> u32 {
        self.number_at(self.numbers(kind)).div_ceil(self.width.bits())
    }

    /// Whether there are poses.
    pub fn has_pose(&self) -> bool {
        self.transform != Transform::Off
    }

    /// The words of a pair: mantissa and sticky bit of the 18 coordinates of V0 V1 V2 W0 W1 W2.
    pub fn pair_record(&self, tag: u64, numbers: impl IntoIterator<Item = (i64, bool)>) -> Vec<StreamWord> {
        self.record(Kind::Pairs, 0, tag, numbers)
    }

    /// The words of a pose: mantissa and sticky bit of the nine entries of M, row by row, and the three of t.
    pub fn pose_record(&self, bypass: bool, numbers: impl IntoIterator<Item = (i64, bool)>) -> Vec<StreamWord> {
        let skipped = 12 - self.numbers(Kind::Pose);
        self.record(Kind::Pose, u32::from(bypass) << BYPASS_AT, 0, numbers.into_iter().skip(skipped as usize))
    }

    fn record(
        &self,
        kind: Kind,
        mut flags: u32,
        tag: u64,
        numbers: impl IntoIterator<Item = (i64, bool)>,
    ) -> Vec<StreamWord> {
        let mut lanes = vec![0; (self.record_words(kind) * self.width.bits() / 32) as usize];
        let mut put = |bit: u32, value: u64| {
            let lane = (bit / 32) as usize;
            lanes[lane] = value as u32;
            if let Some(high) = lanes.get_mut(lane + 1) {
                *high = (value >> 32) as u32;
            }
        };
        if kind == Kind::Pairs {
            put(TAG_AT, tag);
        }
        for (i, (mantissa, sticky)) in (0..).zip(numbers) {
            put(self.number_at(i), if self.lane() == 32 { u64::from(mantissa as u32) } else { mantissa as u64 });
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

    #[test]
    fn the_default_record_is_ten_words_of_64_bits() {
        let format = StreamFormat::new(&Params::default(), StreamWidth::Bits64);
        let words = format.pair_record(0xabcd, (0..18).map(|i| (-i, true)));
        assert_eq!(words.len(), 10);
        assert_eq!(words[0], 0x0000_abcd_0000_0000, "no sticky bits with implied upper bounds");
        assert_eq!(words[1], 0xffff_ffff_0000_0000);
        assert_eq!(words[9], u128::from((-16i32) as u32) | u128::from((-17i32) as u32) << 32);
        assert_eq!(format.header(Kind::Pairs), 0x4410_2001);
        assert_eq!(format.pose_record(true, (0..12).map(|i| (i, false)))[0], 1 << 31);
        assert_eq!((format.record_words(Kind::Pose), format.answer_width()), (7, 64));
    }

    #[test]
    fn a_pair_fits_one_word_of_1024_bits() {
        let params = Params { method: Method::Determinants, ..Params::default() };
        let format = StreamFormat::new(&params, StreamWidth::Bits1024);
        let words = format.pair_record(0xabcd, (0..18).map(|i| (-i, false)));
        assert_eq!((words.len(), format.record_words(Kind::Pose)), (1, 1));
        assert_eq!(StreamWord::from_hex(&words[0].hex(1024)), Some(words[0]));
        assert_eq!(words[0].low(), 0xffff_ffff_0000_0000_0000_abcd_0000_0000);
        assert_eq!(format.header(Kind::Pairs), 0x4410_a001);
        let exact = StreamFormat::new(&Params::of(Method::Exact), StreamWidth::Bits1024);
        assert_eq!(exact.header(Kind::Pairs), 0x0410_6001);
        assert_eq!((format.answer_bits(), format.answer_width()), (8 + 16 + 18, 64));
    }

    #[test]
    fn wide_numbers_and_tags_take_64_bits_each() {
        let params = Params { transform_width: 48, tag_width: 64, upper: Upper::Sticky, ..Params::default() };
        let format = StreamFormat::new(&params, StreamWidth::Bits32);
        let words = format.pair_record(u64::MAX - 1, (0..18).map(|i| (i - 1, i == 17)));
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
            let report = AnswerFields::report(Report::TooShort);
            assert_eq!((report.status, report.reported()), (0b1000_1011, Some(Report::TooShort)));
        }
    }
}
