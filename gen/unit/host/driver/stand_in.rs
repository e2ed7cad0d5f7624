//! The unit behind its stream wrapper, in software: the reference model reading and writing words.

use super::Transfer;
use crate::golden::{Golden, Input, Pair, Pose, Verdict};
use crate::params::stream::{
    AnswerFields, BYPASS_AT, Kind, Report, StreamFormat, StreamWidth, StreamWord, TAG_AT, verdict_status,
};
use crate::params::{ParamError, Params, Transform, Upper};

/// Answers words as the wrapped unit does, to test what drives it. The state is what wrapper and unit keep: the pose.
#[derive(Clone, Debug)]
pub struct StandIn {
    params: Params,
    format: StreamFormat,
    golden: Golden,
    pose: Pose,
    /// Whether a number of the pose does not fit its word.
    pose_unfit: bool,
}

/// A record: its bits by place.
struct Record<'a> {
    words: &'a [StreamWord],
    width: u32,
}

impl Record<'_> {
    fn bits(&self, at: u32, count: u32) -> u64 {
        let bit = |i: u32| u64::from(self.words[(i / self.width) as usize].bit(i % self.width));
        (0..count).fold(0, |bits, i| bits | bit(at + i) << i)
    }
}

impl StandIn {
    /// The unit after reset.
    ///
    /// # Errors
    /// A parameter outside its range.
    pub fn new(params: &Params, width: StreamWidth) -> Result<Self, ParamError> {
        params.validate()?;
        let format = StreamFormat::new(params, width);
        let pose = Pose::identity(params);
        Ok(Self { params: params.clone(), format, golden: Golden::new(params), pose, pose_unfit: false })
    }

    /// The unit under a pose that came another way than as a packet.
    pub fn set_pose(&mut self, pose: Pose) {
        self.pose = pose;
        self.pose_unfit = false;
    }

    /// The unit after reset.
    pub fn reset(&mut self) {
        self.set_pose(Pose::identity(&self.params));
    }

    /// The answers to whole packets; a packet that does not end is not answered.
    pub fn answer(&mut self, transfers: &[Transfer]) -> Vec<Transfer> {
        let mut answers = vec![];
        for packet in transfers.split_inclusive(|transfer| transfer.last).filter(|p| p.last().is_some_and(|t| t.last)) {
            let words: Vec<StreamWord> = packet.iter().map(|transfer| transfer.data).collect();
            self.packet(&words, &mut answers);
        }
        answers
    }

    fn packet(&mut self, words: &[StreamWord], answers: &mut Vec<Transfer>) {
        let kind = [Kind::Pairs, Kind::Pose].into_iter().find(|&kind| {
            let exists = kind == Kind::Pairs || self.format.has_pose();
            exists && words[0].low() as u32 == self.format.header(kind)
        });
        let body = &words[1..];
        let report = match kind {
            None => Report::UnknownHeader,
            Some(Kind::Pairs) => {
                let size = self.format.record_words(Kind::Pairs) as usize;
                for record in body.chunks_exact(size) {
                    let data = self.format.answer(&self.verdict(record)).into();
                    answers.push(Transfer { data, last: false });
                }
                if !body.is_empty() && body.len().is_multiple_of(size) {
                    answers.last_mut().expect("an answer a record").last = true;
                    return;
                }
                Report::TooShort
            }
            Some(Kind::Pose) => match body.len().cmp(&(self.format.record_words(Kind::Pose) as usize)) {
                std::cmp::Ordering::Less => Report::TooShort,
                std::cmp::Ordering::Greater => Report::TooLong,
                std::cmp::Ordering::Equal => {
                    self.pose = self.read_pose(body);
                    self.pose_unfit = self.unfit(body) && !self.pose.bypass;
                    Report::PoseTaken
                }
            },
        };
        answers.push(Transfer { data: self.format.answer(&AnswerFields::report(report)).into(), last: true });
    }

    fn record<'a>(&self, words: &'a [StreamWord]) -> Record<'a> {
        Record { words, width: self.format.width.bits() }
    }

    /// Number `i` of a record.
    fn number(&self, record: &Record, i: u32) -> Input {
        let bits = self.params.transform_width;
        let value = record.bits(self.format.number_at(i), bits) as i64;
        let lo = value << (64 - bits) >> (64 - bits);
        Input { lo, sticky: self.params.upper == Upper::Sticky && record.bits(i, 1) == 1 }
    }

    /// Whether a guarded unit finds a number that is not the sign extension of what it reads of it.
    fn unfit(&self, words: &[StreamWord]) -> bool {
        let (spare, lane) = (self.format.spare_bits(), self.format.lane());
        let record = self.record(words);
        let end = words.len() as u32 * record.width;
        let signs = |at: u32| record.bits(at + lane - 1 - spare, spare + 1);
        let all = (1 << (spare + 1)) - 1;
        spare > 0 && (self.format.number_at(0)..end).step_by(lane as usize).any(|at| ![0, all].contains(&signs(at)))
    }

    fn verdict(&self, words: &[StreamWord]) -> AnswerFields {
        let record = self.record(words);
        let tag = record.bits(TAG_AT, self.params.tag_width);
        if self.pose_unfit || self.unfit(words) {
            let status = verdict_status(Verdict::PossiblyIncorrect as u8, true);
            return AnswerFields { status, tag, separated: 0, overlapping: 0 };
        }
        let point = |k: u32| [0, 1, 2].map(|i| self.number(&record, 3 * k + i));
        let pair = Pair { a: [0, 1, 2].map(point), b: [3, 4, 5].map(point) };
        let outcome = self.golden.outcome(&self.pose, &pair);
        AnswerFields {
            status: verdict_status(outcome.verdict as u8, outcome.outside),
            tag,
            separated: outcome.separated,
            overlapping: outcome.overlapping,
        }
    }

    fn read_pose(&self, words: &[StreamWord]) -> Pose {
        let record = self.record(words);
        let mut pose = Pose { bypass: record.bits(BYPASS_AT, 1) == 1, ..Pose::identity(&self.params) };
        let turns = self.params.transform == Transform::On;
        let matrix = pose.m.iter_mut().flatten().filter(|_| turns);
        for (i, entry) in (0..).zip(matrix.chain(&mut pose.t)) {
            *entry = self.number(&record, i);
        }
        pose
    }
}
