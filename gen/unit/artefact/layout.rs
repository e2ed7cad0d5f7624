//! What others must know of a design, as named constants: one list, which is printed as a VHDL package, a C header and a
//! Python module. So all of them agree.

use super::{Prefix, origin, stream};
use crate::design::Design;
use crate::golden::Verdict;
use crate::params::options::Choice;
use crate::params::stream::{
    BYPASS_AT, Kind, MALFORMED, OUTSIDE, REASON_AT, REPORT, STATUS_BITS, StreamFormat, TAG_AT,
};
use crate::params::{Method, Params, Quantity, Transform, Upper};
use askama::Template;

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

/// A list of refusals, in the order of their codes.
pub fn refusals<const N: usize>(list: [(&'static str, &'static str); N]) -> Vec<Refusal> {
    list.map(|(name, what)| Refusal { name, what }).into()
}

/// All constants of a design with a stream of that format. What the design does not have is not among them.
pub(super) fn groups(design: &Design, format: &StreamFormat) -> Vec<Group> {
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
                number("pair_words", format.record_words(Kind::Pairs), "words of the record of a pair"),
                number("pair_numbers", format.numbers(Kind::Pairs), "numbers in it"),
                number("pose_words", format.record_words(Kind::Pose), "words of the record of a pose")
                    .filter(|_| has_pose),
                number("pose_numbers", format.numbers(Kind::Pose), "numbers in it").filter(|_| has_pose),
                word("pairs_header", format.header(Kind::Pairs), "header of a packet of pairs"),
                word("pose_header", format.header(Kind::Pose), "header of a packet of a pose").filter(|_| has_pose),
                number(
                    "stream_clocks_per_pair",
                    stream::pair_period(p, format) as u32,
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

#[derive(Template)]
#[template(path = "efsat_constants.vhd", escape = "none")]
struct Package<'a> {
    header: Vec<String>,
    prefix: &'a Prefix,
    /// What the constants are of, whose name begins that of the package, and for whom they are.
    of: &'a str,
    whose: &'a str,
    groups: Vec<Group>,
}

impl Constant {
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
    fn vhdl(&self) -> String {
        match self.value {
            Value::Number(number) => format!("natural := {number}"),
            Value::Word(word) => format!("std_logic_vector(31 downto 0) := x\"{word:08x}\""),
            Value::End(_) => unreachable!("packages in VHDL have no ranges, which may be beyond its integers"),
        }
    }
}

/// What the files of the host side are made of.
struct Host<'a> {
    header: Vec<String>,
    prefix: &'a Prefix,
    /// The entity behind the words, and what stands before the names of constants.
    base: &'static str,
    upper: String,
    groups: Vec<Group>,
    refusals: Vec<Refusal>,
    /// The first refusals that are about unsigned numbers, and that expect nothing in particular.
    unsigned: &'static str,
    unexpected: &'static str,
    has_tag: bool,
    is_sticky: bool,
    has_pose: bool,
    has_matrix: bool,
    has_outside: bool,
    /// Whether a guard takes numbers outside their ranges, and which functions there are for it.
    has_guards: bool,
    variants: &'static [bool],
    method: &'static str,
    edge_test: bool,
}

/// The file in C.
#[derive(Template)]
#[template(path = "host/efsat.h", escape = "none")]
struct Header<'a> {
    h: &'a Host<'a>,
}

/// The file in Python.
#[derive(Template)]
#[template(path = "host/efsat.py", escape = "none")]
struct Module<'a> {
    h: &'a Host<'a>,
}

/// The host side in C and in Python: names and texts.
pub(super) fn host(design: &Design, format: &StreamFormat, prefix: &Prefix) -> [(String, String); 2] {
    let p = &design.params;
    let mut groups = groups(design, format);
    groups.insert(1, ranges(p));
    let host = Host {
        header: origin(),
        prefix,
        base: "efsat",
        upper: prefix.of("efsat").to_uppercase(),
        groups,
        refusals: refusals([
            ("COORDINATE", Quantity::Coordinate.name()),
            ("ENTRY", Quantity::Entry.name()),
            ("TRANSLATION", Quantity::Translation.name()),
            ("NUMBER", Quantity::Unread.name()),
            ("STICKY", "sticky bits"),
            ("TAG", "tag"),
            ("ORDER", "tag of answer"),
            ("SIZE", "bytes of the answer"),
            ("REPORT", "a report in place of a verdict, answer"),
            ("ANSWER", "a word that no unit of this design sends, answer"),
        ]),
        unsigned: "TAG",
        unexpected: "REPORT",
        has_tag: p.tag_width > 0,
        is_sticky: p.upper == Upper::Sticky,
        has_pose: format.has_pose(),
        has_matrix: p.transform == Transform::On,
        has_outside: p.guarded(),
        has_guards: p.has_guards(),
        variants: if p.has_guards() { &[false, true] } else { &[false] },
        method: p.method.name(),
        edge_test: p.edge_test,
    };
    let texts = [("efsat.h", Header { h: &host }.render()), ("efsat.py", Module { h: &host }.render())];
    texts.map(|(name, text)| (format!("host/{}", prefix.of(name)), text.expect("the template renders")))
}

/// The package of constants in VHDL.
pub(super) fn package(design: &Design, format: &StreamFormat, prefix: &Prefix) -> String {
    let whose = format!("{prefix}efsat or {prefix}efsat_stream. The unit");
    constants_package(groups(design, format), prefix, "efsat", &whose)
}

/// The package of constants of an entity; `whose` says for whom they are, and who does not use them.
pub fn constants_package(groups: Vec<Group>, prefix: &Prefix, of: &str, whose: &str) -> String {
    let package = Package { header: origin(), prefix, of, whose, groups };
    package.render().expect("the template renders")
}
