//! What others must know of a design, as named constants: one list, of which a VHDL package, a C header and a Python module are
//! printed. So all of them agree.

use super::{BYPASS_AT, MALFORMED, OUTSIDE, PacketKind, REASON_AT, REPORT, STATUS_BITS, StreamFormat, TAG_AT};
use crate::design::Design;
use crate::pair::Verdict;
use crate::params::{Method, Params, Quantity, Transform, Upper};

/// A constant.
pub struct Constant {
    /// Its name, in lower case.
    pub name: &'static str,
    /// Its value.
    pub value: Value,
    /// What it is.
    pub what: &'static str,
}

impl Constant {
    /// A number.
    pub fn number(name: &'static str, value: u32, what: &'static str) -> Self {
        Self { name, value: Value::Number(value), what }
    }

    /// A word.
    pub fn word(name: &'static str, value: u32, what: &'static str) -> Self {
        Self { name, value: Value::Word(value), what }
    }

    /// An end of a range, for hosts alone.
    fn end(name: &'static str, value: i64, what: &'static str) -> Self {
        Self { name, value: Value::End(value), what }
    }

    /// Its name in upper case.
    pub fn upper(&self) -> String {
        self.name.to_uppercase()
    }

    /// Its value in C.
    pub fn c(&self) -> String {
        match self.value {
            Value::Number(number) => number.to_string(),
            Value::Word(word) => format!("UINT32_C(0x{word:08x})"),
            Value::End(end) => format!("INT64_C({end})"),
        }
    }

    /// Its value in Python.
    pub fn python(&self) -> String {
        match self.value {
            Value::Number(number) => number.to_string(),
            Value::Word(word) => format!("0x{word:08x}"),
            Value::End(end) => end.to_string(),
        }
    }

    /// The subtype and the value in VHDL.
    pub fn vhdl(&self) -> String {
        match self.value {
            Value::Number(number) => format!("natural := {number}"),
            Value::Word(word) => format!("std_logic_vector(31 downto 0) := x\"{word:08x}\""),
            Value::End(_) => unreachable!("packages in VHDL have no ranges, which may be beyond its integers"),
        }
    }
}

/// What a constant is.
#[derive(Clone, Copy)]
pub enum Value {
    /// A number, below 2^31.
    Number(u32),
    /// 32 bits.
    Word(u32),
    /// A signed number of up to 48 bits.
    End(i64),
}

/// Constants under a heading.
pub struct Group {
    /// The heading.
    pub what: &'static str,
    /// The constants.
    pub constants: Vec<Constant>,
}

/// The ranges that hosts keep to, of numbers that a pair has, and a pose if there is one with or without a matrix.
pub fn ranges(p: &Params) -> Group {
    let both = |of, [least, most]: [&'static str; 2], what: [&'static str; 2]| {
        let [from, to] = p.declared(of);
        [Constant::end(least, from, what[0]), Constant::end(most, to, what[1])]
    };
    let mut constants = vec![];
    constants.extend(both(
        Quantity::Unread,
        ["number_least", "number_most"],
        ["the least number that a word holds", "the greatest"],
    ));
    constants.extend(both(
        Quantity::Coordinate,
        ["coordinate_least", "coordinate_most"],
        ["the least coordinate that is declared", "the greatest"],
    ));
    if p.transform == Transform::On {
        constants.extend(both(
            Quantity::Entry,
            ["entry_least", "entry_most"],
            ["the least entry of M that is declared", "the greatest"],
        ));
    }
    if p.transform != Transform::Off {
        constants.extend(both(
            Quantity::Translation,
            ["translation_least", "translation_most"],
            ["the least entry of t that is declared", "the greatest"],
        ));
    }
    Group {
        what: "Ranges of numbers; for others the unit makes no promise, and the functions below refuse them.",
        constants,
    }
}

/// Something that the functions in C refuse.
pub struct Refusal {
    /// The end of its name.
    pub name: &'static str,
    /// What explanations call it.
    pub what: &'static str,
}

/// All constants of a design with a stream of that format. What the design does not have is not among them.
pub fn groups(design: &Design, format: &StreamFormat) -> Vec<Group> {
    let p = &design.params;
    let number = |name, value, what| Some(Constant::number(name, value, what));
    let word = |name, value, what| Some(Constant::word(name, value, what));
    let bit = |mask: u8| mask.trailing_zeros();
    let flags_are = match p.method {
        Method::Axes => "flags of each kind, one for each axis",
        Method::Determinants | Method::Exact => "flags of each kind, one for each witness",
    };
    let latency = match design.second {
        None => number("latency", design.latency as u32, "clocks from a pair taken to its verdict"),
        Some(_) => number("latency", design.latency as u32, "least clocks from a pair taken to its verdict"),
    };
    let tag_end = STATUS_BITS + p.tag_width;
    let (has_pose, has_tag, is_sticky) = (format.has_pose(), p.tag_width > 0, p.upper == Upper::Sticky);
    let group =
        |what, constants: Vec<Option<Constant>>| Group { what, constants: constants.into_iter().flatten().collect() };
    vec![
        group(
            "The unit.",
            vec![
                number("number_bits", p.transform_width, "bits of a coordinate"),
                number("integral_bits", p.int_bits, "of them integral, with the sign"),
                number("tag_bits", p.tag_width, "bits of the tag of a pair"),
                number("flag_bits", format.flags, flags_are),
                number("clocks_per_pair", design.interval as u32, "clocks from pair to pair, the initiation interval"),
                latency,
                number("clock_mhz", p.frequency, "the target clock in MHz"),
            ],
        ),
        group(
            "Verdicts: out_verdict, and the low bits of an answer.",
            vec![
                number("verdict_separate", Verdict::Separate as u32, "no common point, certainly"),
                number("verdict_intersect", Verdict::Intersect as u32, "a common point, certainly"),
                number("verdict_possibly_incorrect", Verdict::PossiblyIncorrect as u32, "too close for this width"),
                number("verdict_report", REPORT.into(), "no verdict: an answer to a pose or to a malformed packet"),
            ],
        ),
        group(
            "Packets of the stream: a header word, then records.",
            vec![
                number("word_bits", format.width.bits(), "bits of a word in"),
                number("answer_word_bits", format.answer_width(), "bits of a word out"),
                number("pair_words", format.record_words(PacketKind::Pairs), "words of the record of a pair"),
                number("pair_numbers", format.numbers(PacketKind::Pairs), "numbers in it"),
                number("pose_words", format.record_words(PacketKind::Pose), "words of the record of a pose")
                    .filter(|_| has_pose),
                number("pose_numbers", format.numbers(PacketKind::Pose), "numbers in it").filter(|_| has_pose),
                word("pairs_header", format.header(PacketKind::Pairs), "header of a packet of pairs"),
                word("pose_header", format.header(PacketKind::Pose), "header of a packet of a pose")
                    .filter(|_| has_pose),
                number(
                    "stream_clocks_per_pair",
                    format.pair_period(p.interval()) as u32,
                    "clocks from pair to pair in a long packet",
                ),
            ],
        ),
        group(
            "Bits of a record, counted from bit 0 of its first word.",
            vec![
                number("record_sticky_low", 0, "sticky bit of number 0; those of the others follow")
                    .filter(|_| is_sticky),
                number("record_bypass", BYPASS_AT, "of a pose: B = B~, its numbers are not read").filter(|_| has_pose),
                number("record_tag_low", TAG_AT, "tag of a pair").filter(|_| has_tag),
                number("record_number_low", format.number_at(0), "number 0"),
                number("record_number_step", format.lane(), "from number to number, each sign-extended"),
            ],
        ),
        group(
            "Bits of an answer.",
            vec![
                number("answer_verdict_low", 0, "verdict, two bits"),
                number("answer_reason_low", REASON_AT, "of a report: its reason, two bits"),
                number("answer_outside", bit(OUTSIDE), "a number is outside its declared range")
                    .filter(|_| p.guarded()),
                number("answer_malformed", bit(MALFORMED), "of a report: the packet was malformed"),
                number("answer_tag_low", STATUS_BITS, "tag of the pair").filter(|_| has_tag),
                number("answer_separated_low", tag_end, "out_separated"),
                number("answer_overlapping_low", tag_end + format.flags, "out_overlapping"),
            ],
        ),
    ]
}
