//! The example design: a core behind a UART; and its testbench around the wrapped unit.

use crate::artefact::bits::Bits;
use crate::artefact::files::core::Core;
use crate::artefact::files::file_lists::{BenchFiles, FileLists};
use crate::artefact::{FileSet, Prefix, origin};
use crate::design::Design;
use crate::golden::Golden;
use crate::host::{Host, loose_pair};
use crate::pair::Pose;
use crate::words::{AnswerFields, PacketKind, StreamFormat, StreamReport, StreamWord};
use askama::Template;

#[derive(Template)]
#[template(path = "example/uart_receiver.vhd", escape = "none")]
struct Receiver<'a> {
    header: &'a [String],
    prefix: &'a Prefix,
}

#[derive(Template)]
#[template(path = "example/uart_transmitter.vhd", escape = "none")]
struct Transmitter<'a> {
    header: &'a [String],
    prefix: &'a Prefix,
}

#[derive(Template)]
#[template(path = "example/efsat_uart_top.vhd", escape = "none")]
struct Top<'a> {
    header: &'a [String],
    prefix: &'a Prefix,
    core: &'a Core,
    frequency: u32,
    word: Bits,
    word_bytes: u32,
    answer: Bits,
    answer_bytes: u32,
}

#[derive(Template)]
#[template(path = "example/efsat_uart_tb.vhd", escape = "none")]
struct Bench<'a> {
    header: &'a [String],
    prefix: &'a Prefix,
    story: &'static str,
    packets: Vec<Packet>,
    steps: Vec<String>,
}

/// Bytes as a constant.
struct Packet {
    name: String,
    what: &'static str,
    high: usize,
    rows: Vec<String>,
}

/// A vertex through a face.
const POINTS: [[f64; 3]; 6] =
    [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [1.0, 1.0, -1.0], [1.5, 1.25, 1.0], [2.0, 1.5, 1.25]];
/// Its tag, cut to the design's.
const TAG: u64 = 0x5a5a_5a5a_5a5a_5a5a;

fn packet(name: &str, what: &'static str, words: &[StreamWord], bits: u32) -> Packet {
    let bytes: Vec<u8> = words.iter().flat_map(|w| w.bytes().take(bits as usize / 8)).collect();
    let all: Vec<String> = bytes.iter().map(|byte| format!("x\"{byte:02x}\"")).collect();
    let mut rows: Vec<String> = all.chunks(12).map(|row| format!("{},", row.join(", "))).collect();
    if let Some(last) = rows.last_mut() {
        last.pop();
    }
    Packet { name: name.to_owned(), what, high: bytes.len() - 1, rows }
}

fn bench(design: &Design, format: &StreamFormat, prefix: &Prefix, header: &[String]) -> String {
    let p = &design.params;
    let Ok(Host::Unit(pair)) = loose_pair(&POINTS, p) else {
        unreachable!("a loose pair is inside the declared ranges")
    };
    let pose = Pose::identity(p);
    let header_word = |kind| StreamWord::from(u128::from(format.header(kind)));
    let tag = TAG & u64::MAX.checked_shr(64 - p.tag_width).unwrap_or(0);
    let outcome = Golden::new(p).outcome(&pose, &pair);
    let verdict = AnswerFields::verdict(tag, &outcome);
    let (width, answer_width) = (format.width.bits(), format.answer_width());
    let answer = |name, what, fields: &AnswerFields| packet(name, what, &[format.answer(fields).into()], answer_width);
    let (mut packets, mut steps) = (vec![], vec![]);
    let mut exchange = |sent: &str, answer: &str, bytes: Packet, expected: Packet| {
        steps.extend([format!("send({sent});"), format!("expect_answer({answer});")]);
        packets.extend([bytes, expected]);
    };
    if format.has_pose() {
        let record = format.pose_record(&pose);
        let words = [vec![header_word(PacketKind::Pose)], record].concat();
        let taken = AnswerFields::report(StreamReport::PoseTaken);
        exchange(
            "pose_packet",
            "pose_answer",
            packet("pose_packet", "The identity, bypassed.", &words, width),
            answer("pose_answer", "Pose taken.", &taken),
        );
    }
    let record = format.pair_record(tag, &pair);
    let words = [vec![header_word(PacketKind::Pairs)], record].concat();
    exchange(
        "pair_packet",
        "pair_answer",
        packet("pair_packet", "A vertex through a face.", &words, width),
        answer("pair_answer", "Verdict, tag and flags of the reference model.", &verdict),
    );
    let unknown = AnswerFields::report(StreamReport::UnknownHeader);
    exchange(
        "stray_bytes",
        "stray_answer",
        packet("stray_bytes", "No whole word.", &[0xc3_a5_5a.into()], 24),
        answer("stray_answer", "Malformed: unknown header.", &unknown),
    );
    let story = if format.has_pose() { "sends a pose and a pair" } else { "sends a pair" };
    Bench { header, prefix, story, packets, steps }.render().expect("the template renders")
}

/// Adds the example with its testbench.
pub(in crate::artefact) fn add(
    set: &mut FileSet,
    design: &Design,
    format: &StreamFormat,
    prefix: &Prefix,
    file: &BenchFiles,
) {
    add_top(set, &Core::UNIT, design.params.frequency, [format.width.bits(), format.answer_width()], prefix);
    set.insert(&file.file, bench(design, format, prefix, &origin()));
}

/// Adds the example around a core with words of so many bits in and out.
pub fn add_top(set: &mut FileSet, core: &Core, frequency: u32, [width, answer_width]: [u32; 2], prefix: &Prefix) {
    let header = &origin()[..];
    let top = Top {
        header,
        prefix,
        core,
        frequency,
        word: Bits::all(width),
        word_bytes: width / 8,
        answer: Bits::all(answer_width),
        answer_bytes: answer_width / 8,
    };
    let texts = [Receiver { header, prefix }.render(), Transmitter { header, prefix }.render(), top.render()];
    for (name, text) in FileLists::example(prefix).iter().zip(texts) {
        set.insert(name, text.expect("the template renders"));
    }
}
