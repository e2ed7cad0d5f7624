//! The AXI4-Stream wrapper of a design and its testbench: strict VHDL-93 from the layout in [`StreamFormat`].

use crate::artefact::Prefix;
use crate::artefact::bits::Bits;
use crate::artefact::check::{stream_vectors, testbench};
use crate::design::Design;
use crate::design::top::{pair_ports, pose_ports};
use crate::params::{Method, Params, Upper};
use crate::words::{BYPASS_AT, PacketKind, STATUS_BITS, StreamFormat, TAG_AT};
use askama::Template;

/// Name of the wrapper's entity, without a prefix.
pub const NAME: &str = "efsat_stream";
/// Name of the testbench entity, without a prefix.
pub const TESTBENCH: &str = "efsat_stream_tb";

/// Bits of a word that must all be the sign of a number, in the words of a record for which `when` holds.
struct Sign {
    high: u32,
    low: u32,
    when: String,
}

/// An input port of the unit and its bits in the assembled record.
struct Field {
    port: String,
    place: String,
}

#[derive(Template)]
#[template(path = "stream/efsat_stream.vhd", escape = "none")]
struct Wrapper<'a> {
    header: Vec<String>,
    prefix: &'a Prefix,
    width: u32,
    word: Bits,
    keep: Bits,
    answer: Bits,
    answer_keep: Bits,
    pairs_header: String,
    pose_header: String,
    has_pose: bool,
    pair_words: u32,
    pose_words: u32,
    assembly_high: u32,
    places: usize,
    place_bits: u32,
    tag_width: u32,
    tag: Bits,
    flags: Bits,
    report_zeros: Bits,
    guarded: bool,
    signs: Vec<Sign>,
    sign_high: u32,
    flags_high: u32,
    bypass_place: u32,
    unit_inputs: Vec<Field>,
    unused: u32,
    unused_zeros: String,
}

#[derive(Template)]
#[template(path = "stream/efsat_stream_tb.vhd", escape = "none")]
struct Testbench<'a> {
    header: &'a [String],
    prefix: &'a Prefix,
    formats: String,
    word: Bits,
    keep: Bits,
    answer: Bits,
    answer_keep: Bits,
    patience: usize,
    full_after: usize,
    begun: u32,
    half_period: String,
}

/// Where the inputs of the unit are in the assembled record, whose latest word is in the high bits.
fn unit_inputs(p: &Params, format: &StreamFormat, assembly: u32) -> Vec<Field> {
    let mut fields = vec![];
    let mut field = |port: &str, low: u32, bits: u32| {
        let place = if bits == 1 { low.to_string() } else { format!("{} downto {low}", low + bits - 1) };
        fields.push(Field { port: port.to_owned(), place });
    };
    let mut numbers = |kind: PacketKind, names: &[String], base: u32| {
        for (i, name) in (0..).zip(names) {
            field(name, base + format.number_at(i), p.transform_width);
            if p.upper == Upper::Sticky {
                field(&format!("{name}_sticky"), base + i, 1);
            }
        }
        if kind == PacketKind::Pose {
            field("pose_bypass", base + BYPASS_AT, 1);
        } else if p.tag_width > 0 {
            field("in_tag", base + TAG_AT, p.tag_width);
        }
    };
    let base = |kind| assembly - format.record_words(kind) * format.width.bits();
    numbers(PacketKind::Pairs, &pair_ports(), base(PacketKind::Pairs));
    if format.has_pose() {
        numbers(PacketKind::Pose, &pose_ports(p), base(PacketKind::Pose));
    }
    fields
}

/// Where a word has bits of numbers that do not reach the unit, and the sign that they must repeat.
fn signs(format: &StreamFormat) -> Vec<Sign> {
    let (width, lane, spare, first) = (format.width.bits(), format.lane(), format.spare_bits(), format.number_at(0));
    if spare == 0 {
        return vec![];
    }
    if width < lane {
        // A number takes two words, the odd one of which has its sign.
        let when = format!("place > {} and place(0) = '1'", first / width);
        return vec![Sign { high: width - 1, low: width - 1 - spare, when }];
    }
    let sign = |at: u32| {
        let from = first.saturating_sub(at).div_ceil(width);
        let high = at + lane - 1;
        Sign { high, low: high - spare, when: format!("place >= {from}") }
    };
    (0..width).step_by(lane as usize).map(sign).collect()
}

/// What the header of the wrapper says: the format of both streams.
fn description(p: &Params, format: &StreamFormat) -> Vec<String> {
    let (width, lane) = (format.width.bits(), format.lane());
    let tag_high = TAG_AT + p.tag_width.max(1) - 1;
    let mut lines = vec![
        "AXI4-Stream wrapper of efsat. A word that lacks bytes by its TKEEP makes its packet malformed.".to_owned(),
        String::new(),
        format!(
            "In: packets of {width}-bit words, the last with TLAST. The first word is the header, in its low 32 bits:"
        ),
        format!("  16#{:08x}#  pairs: any number of records follow, at least one", format.header(PacketKind::Pairs)),
    ];
    if format.has_pose() {
        lines.push(format!("  16#{:08x}#  pose: one record follows", format.header(PacketKind::Pose)));
    }
    lines.extend([
        match format.record_words(PacketKind::Pairs) {
            1 => "A record is one word for a pair:".to_owned(),
            words => format!("A record is {words} words for a pair, the first in the low bits:"),
        },
        match p.upper {
            Upper::Sticky => "  31 downto 0  bit i is the sticky bit of number i".to_owned(),
            Upper::Implied => "  31 downto 0  not read".to_owned(),
        },
        match p.tag_width {
            0 => "  63 downto 32  not read: there is no tag".to_owned(),
            _ => match format.number_at(0) - 1 {
                high if high > tag_high => {
                    format!("  {tag_high} downto {TAG_AT}  tag; {high} downto {}  not read", tag_high + 1)
                }
                _ => format!("  {tag_high} downto {TAG_AT}  tag"),
            },
        },
        format!(
            "  from bit {} on, each in the low {} of {lane} bits: v0_x v0_y v0_z v1_x ... w2_z",
            format.number_at(0),
            p.transform_width
        ),
    ]);
    if format.has_pose() {
        let names: Vec<String> = pose_ports(p).iter().map(|name| name[5..].to_owned()).collect();
        lines.extend([
            format!(
                "and {} for a pose, in the same places: bit 31 bypass, no tag, numbers",
                match format.record_words(PacketKind::Pose) {
                    1 => "one word".to_owned(),
                    words => format!("{words} words"),
                }
            ),
            format!("  {}", names.join(" ")),
            "A pose holds for the packets after it; before the first one B = B~.".to_owned(),
        ]);
    }
    if format.spare_bits() > 0 {
        lines.push(
            "A number that is not sign-extended is outside its declared range, and so is the fill of a record."
                .to_owned(),
        );
    }
    let (tag, flags) = (p.tag_width, format.flags);
    let what = match p.method {
        Method::Axes => "axis",
        Method::Determinants | Method::Exact => "witness",
    };
    let status = "  7 downto 0  status; bits 1..0: 00 separate, 01 intersect, 10 possibly incorrect, 11 report";
    let outside = "              bit 4: a number of the pair or its pose is outside its declared range (10, no flags)";
    lines.extend([
        String::new(),
        format!(
            "Out: one packet of {}-bit words for every packet, in order: one word per pair, or",
            format.answer_width()
        ),
        "one report; TLAST with the last. From bit 0 on:".to_owned(),
        status.to_owned(),
    ]);
    lines.extend(p.guarded().then(|| outside.to_owned()));
    lines.extend([
        if tag > 0 { format!("  {} downto 8  tag", tag + 7) } else { "  (no tag)".to_owned() },
        format!("  {} downto {}  out_separated, bit i for {what} i", tag + flags + 7, tag + 8),
        format!("  {} downto {}  out_overlapping, bit i for {what} i", tag + 2 * flags + 7, tag + flags + 8),
        "A report has its reason in bits 3..2: 0 pose taken, 1 unknown header, 2 packet too short (or not whole".to_owned(),
        "records), 3 pose packet too long. Bit 7 is set in 1 to 3: the packet was malformed and none of the verdicts".to_owned(),
        "that it may have had before the report counts; a malformed pose is not taken. The next packet is read as ever."
            .to_owned(),
        String::new(),
        format!(
            "Full back-pressure both ways: neither ready depends on a valid or ready of the other side. A pair {}.",
            match format.pair_period(p.interval()) {
                1 => "per clock".to_owned(),
                clocks => format!("every {clocks} clocks"),
            }
        ),
    ]);
    lines
}

/// The text of the wrapper, `origin` on top.
pub fn wrapper(design: &Design, format: &StreamFormat, prefix: &Prefix, origin: &[String]) -> String {
    let p = &design.params;
    let mut header = origin.to_vec();
    header.push(String::new());
    header.extend(description(p, format));
    let [pair_words, pose_words] = [PacketKind::Pairs, PacketKind::Pose].map(|kind| format.record_words(kind));
    let assembly = format.width.bits() * if format.has_pose() { pair_words.max(pose_words) } else { pair_words };
    // More than the unit holds, so that it is never the first to be full.
    let places = 2 * design.places;
    let unused = format.answer_width() - format.answer_bits();
    let wrapper = Wrapper {
        header,
        prefix,
        width: format.width.bits(),
        word: Bits::all(format.width.bits()),
        keep: Bits::all(format.width.bits() / 8),
        answer: Bits::all(format.answer_width()),
        answer_keep: Bits::all(format.answer_width() / 8),
        pairs_header: format!("{:08x}", format.header(PacketKind::Pairs)),
        pose_header: format!("{:08x}", format.header(PacketKind::Pose)),
        has_pose: format.has_pose(),
        pair_words,
        pose_words,
        assembly_high: assembly - 1,
        places,
        place_bits: places.trailing_zeros(),
        tag_width: p.tag_width,
        tag: Bits::all(p.tag_width.max(1)),
        flags: Bits::all(format.flags),
        report_zeros: Bits::all(format.answer_width() - STATUS_BITS),
        guarded: p.guarded(),
        signs: signs(format),
        sign_high: format.spare_bits(),
        flags_high: 2 * format.flags - 1,
        bypass_place: assembly - pose_words * format.width.bits() + BYPASS_AT,
        unit_inputs: unit_inputs(p, format, assembly),
        unused,
        unused_zeros: "0".repeat(unused as usize),
    };
    wrapper.render().expect("the template renders")
}

/// The text of the testbench, `origin` on top.
pub fn bench(design: &Design, format: &StreamFormat, prefix: &Prefix, origin: &[String]) -> String {
    let p = &design.params;
    let bench = Testbench {
        header: origin,
        prefix,
        formats: stream_vectors::formats_line(p, format),
        word: Bits::all(format.width.bits()),
        keep: Bits::all(format.width.bits() / 8),
        answer: Bits::all(format.answer_width()),
        answer_keep: Bits::all(format.answer_width() / 8),
        patience: 4096 + 4 * design.latency,
        full_after: testbench::full_after(design) + 64,
        // The header, a pair in the unit, and one that waits for its slot.
        begun: 1 + 2 * format.record_words(PacketKind::Pairs),
        half_period: format!("{} ps", testbench::half_period(p)),
    };
    bench.render().expect("the template renders")
}
