//! Words for the stream wrapper and the answers they must get, from the reference model.
//!
//! The file begins with the line of formats, which the testbench compares with its own. Then, in hexadecimal with the
//! TLAST of each word: `I <word> <last> <whole>` into the wrapper, `O <word> <last>` out of it; other lines are comments.
//! A word that is not whole lacks its highest byte by TKEEP.

use super::{Stimulus, vectors};
use crate::golden::Golden;
use crate::pair::{Input, Pair, Pose};
use crate::params::Params;
use crate::words::{AnswerFields, PacketKind, StreamFormat, StreamReport, StreamWord};

/// Pairs of the first packet that fill the default design.
pub const FILLING: usize = 22;
/// Pairs among which those are sought that tell two poses apart.
const TELLING: usize = 64;
/// Of the words for a guard, every so manieth segment is sent.
const EVERY: usize = 7;
/// Pairs of the packets after it, each under a pose of its own.
const OTHERS: [usize; 3] = [1, 4, 2];

/// A word in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WordIn {
    /// TDATA.
    pub data: StreamWord,
    /// TLAST.
    pub last: bool,
    /// Whether TKEEP is set for every byte.
    pub whole: bool,
}

/// Words in and answers out.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct StreamVectors {
    /// Words in.
    pub words: Vec<WordIn>,
    /// Answers out, each with its TLAST.
    pub answers: Vec<(u128, bool)>,
}

/// The first line of a file, also a constant of the testbench.
pub fn formats_line(p: &Params, format: &StreamFormat) -> String {
    let vectors = vectors::formats_line(p);
    format!("{vectors} tag {} stream {} to {}", p.tag_width, format.width.bits(), format.answer_width())
}

/// Makes vectors packet by packet.
pub struct Maker<'a> {
    golden: Golden,
    format: &'a StreamFormat,
    /// The pose that holds.
    pub pose: Pose,
    tag: u64,
    /// What has been made.
    pub vectors: StreamVectors,
}

impl<'a> Maker<'a> {
    /// Nothing yet, under the identity.
    pub fn new(p: &Params, format: &'a StreamFormat) -> Self {
        let vectors = StreamVectors::default();
        Self { golden: Golden::new(p), format, pose: Pose::identity(p), tag: 0, vectors }
    }

    fn header(&self, kind: PacketKind) -> Vec<StreamWord> {
        vec![u128::from(self.format.header(kind)).into()]
    }

    /// Sends words as one packet.
    fn send(&mut self, words: Vec<StreamWord>) {
        let end = words.len() - 1;
        self.vectors.words.extend(words.into_iter().enumerate().map(|(i, data)| WordIn {
            data,
            last: i == end,
            whole: true,
        }));
    }

    /// Takes a byte from a word of the packet sent last, counted from its end.
    fn lacks_byte(&mut self, from_end: usize) {
        let end = self.vectors.words.len() - 1;
        self.vectors.words[end - from_end].whole = false;
    }

    fn report(&mut self, report: StreamReport) {
        self.vectors.answers.push((self.format.answer(&AnswerFields::report(report)), true));
    }

    /// The words of a pair; its answer is awaited.
    fn pair(&mut self, pair: &Pair, last: bool) -> Vec<StreamWord> {
        let outcome = self.golden.outcome(&self.pose, pair);
        // Some tag that uses all bits.
        self.tag = self.tag.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let tag = self.tag & u64::MAX.checked_shr(64 - self.format.tag_width).unwrap_or(0);
        let fields = AnswerFields::verdict(tag, &outcome);
        self.vectors.answers.push((self.format.answer(&fields), last));
        self.format.pair_record(tag, pair)
    }

    /// A packet of pairs.
    pub fn pairs(&mut self, pairs: &[Pair]) {
        let mut words = self.header(PacketKind::Pairs);
        for (i, pair) in pairs.iter().enumerate() {
            words.extend(self.pair(pair, i + 1 == pairs.len()));
        }
        self.send(words);
    }

    fn pose_words(&self, pose: &Pose) -> Vec<StreamWord> {
        let mut words = self.header(PacketKind::Pose);
        words.extend(self.format.pose_record(pose));
        words
    }

    /// A packet with a pose, if there are such.
    pub fn pose(&mut self, pose: &Pose) {
        if self.format.has_pose() {
            let words = self.pose_words(pose);
            self.send(words);
            self.report(StreamReport::PoseTaken);
            self.pose = *pose;
        }
    }

    /// Packets for a guard: words outside the declared ranges, and numbers that are no sign extension of what the unit
    /// reads of them, of pairs and of poses, with what is inside in between.
    pub fn outside(&mut self, p: &Params) {
        for (pose, pairs) in Stimulus::outside(p).segments.iter().step_by(EVERY) {
            self.pose(pose);
            self.pairs(pairs);
        }
        if self.format.spare_bits() == 0 {
            return;
        }
        let segments = Stimulus::random(p, 32, 12).segments;
        let unfit = |x: &mut Input, by: i64| x.lo += by << p.transform_width;
        // Far apart at every width: a definite verdict and flags, to be lost where a number does not fit.
        let one = p.one() as i64;
        let triangle = |z: i64| [[0, 0, z], [one, 0, z], [0, one, z]].map(|v| v.map(Input::exact));
        let apart = Pair { a: triangle(-one), b: triangle(one) };
        for (i, (pose, pairs)) in segments.into_iter().enumerate() {
            let mut wrong = pose;
            unfit(&mut wrong.t[i % 3], 1);
            self.pose(&wrong);
            self.pairs(&pairs[..1]);
            self.pose(&Pose { bypass: true, ..wrong });
            let mut cut = apart;
            unfit(&mut cut.b[i][2], 1);
            self.pairs(&[pairs[0], cut, apart]);
            self.pose(&pose);
            let mut pairs = pairs[..6].to_vec();
            unfit(&mut pairs[0].a[0][0], 1);
            unfit(&mut pairs[2].b[2][2], -1);
            unfit(&mut pairs[3].b[i][1], -1);
            self.pairs(&pairs);
        }
    }

    /// Packets of pairs or a pose that are none, with what is to be said of each.
    pub fn malformed(&mut self, pair: &Pair, pose: &Pose) {
        // A header of another design, with a pair after it.
        let record = self.format.pair_record(0, pair);
        let other = u128::from(self.format.header(PacketKind::Pairs) ^ 1 << 8).into();
        self.send([vec![other], record.clone()].concat());
        self.report(StreamReport::UnknownHeader);
        self.send(self.header(PacketKind::Pairs));
        self.report(StreamReport::TooShort);
        let several = record.len() > 1;
        if several {
            // A pair, and then another that lacks its last word.
            let mut words = self.header(PacketKind::Pairs);
            words.extend(self.pair(pair, false));
            words.extend_from_within(1..words.len() - 1);
            self.send(words);
            self.report(StreamReport::TooShort);
        }
        // A pair that lacks a byte, in its last word and elsewhere; a header that does.
        let words = [self.header(PacketKind::Pairs), record.clone()].concat();
        let size = words.len();
        let mut lacking = vec![(0, StreamReport::TooShort), (size - 1, StreamReport::UnknownHeader)];
        lacking.extend(several.then_some((1, StreamReport::TooShort)));
        for (from_end, report) in lacking {
            self.send(words.clone());
            self.lacks_byte(from_end);
            self.report(report);
        }
        if self.format.has_pose() {
            let words = self.pose_words(pose);
            self.send(words.clone());
            self.lacks_byte(0);
            self.report(StreamReport::TooShort);
            self.send([words.clone(), vec![StreamWord::default()]].concat());
            self.report(StreamReport::TooLong);
            self.send([words.clone(), words.clone()].concat());
            self.report(StreamReport::TooLong);
            self.send(words[..words.len() - 1].to_vec());
            self.report(StreamReport::TooShort);
            self.send(words[..1].to_vec());
            self.report(StreamReport::TooShort);
        } else {
            // A pose for a unit that has none.
            self.send([self.header(PacketKind::Pose), vec![StreamWord::default(); 3]].concat());
            self.report(StreamReport::UnknownHeader);
        }
    }
}

/// Packets of every kind, the first of `first` pairs (at least 2): before any pose, under several poses, every way to be
/// malformed, and good ones after that, still under a pose; to a unit with a guard, words outside the declared ranges.
pub fn mixed(p: &Params, format: &StreamFormat, first: usize) -> StreamVectors {
    let mut maker = Maker::new(p, format);
    let pairs = |count: usize, seed: u64| Stimulus::random(p, count, seed).segments;
    let flat = |count, seed| pairs(count, seed).into_iter().flat_map(|s| s.1).collect::<Vec<Pair>>();
    let first = flat(first, 1);
    maker.pairs(&first);
    for (seed, count) in (2..).zip(OTHERS) {
        for (pose, pairs) in pairs(count, seed) {
            maker.pose(&pose);
            maker.pairs(&pairs);
        }
    }
    maker.outside(p);
    let other = pairs(1, 9)[0].0;
    maker.send(vec![StreamWord::default()]);
    maker.report(StreamReport::UnknownHeader);
    maker.malformed(&first[0], &other);
    // The old pose still holds: pairs that the malformed one would answer differently, where there are such.
    let answer = |pose: &Pose, pair: &Pair| maker.golden.outcome(pose, pair);
    let mut candidates = flat(TELLING, 10);
    candidates.sort_by_key(|pair| answer(&maker.pose, pair) == answer(&other, pair));
    maker.pairs(&candidates[..2]);
    maker.vectors
}

/// One packet of random pairs, to measure the speed.
pub fn one_packet(p: &Params, format: &StreamFormat, pairs: usize) -> StreamVectors {
    let mut maker = Maker::new(p, format);
    let pairs: Vec<Pair> = Stimulus::random(p, pairs, 1).segments.into_iter().flat_map(|s| s.1).collect();
    maker.pairs(&pairs);
    maker.vectors
}

/// The file; without answers the testbench compares none.
pub fn text(p: &Params, format: &StreamFormat, vectors: &StreamVectors) -> String {
    let line =
        |kind: char, width: u32, word: StreamWord, last: bool| format!("{kind} {} {}", word.hex(width), u8::from(last));
    let (width, answer_width) = (format.width.bits(), format.answer_width());
    let mut lines = vec![
        formats_line(p, format),
        "# I <word> <last> <whole> into the wrapper, O <word> <last> out of it; answers from the reference model"
            .to_owned(),
    ];
    let words = vectors.words.iter();
    lines.extend(words.map(|w| format!("{} {}", line('I', width, w.data, w.last), u8::from(w.whole))));
    lines.extend(vectors.answers.iter().map(|&(word, last)| line('O', answer_width, word.into(), last)));
    lines.push(String::new());
    lines.join("\n")
}
