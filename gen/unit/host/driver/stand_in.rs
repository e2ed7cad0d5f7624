//! The unit behind its stream wrapper, in software: the reference model reading and writing words.

use super::Transfer;
use crate::golden::Golden;
use crate::pair::{Outcome, Pose};
use crate::params::{ParamError, Params};
use crate::words::{AnswerFields, PacketKind, Record, StreamFormat, StreamReport, StreamWidth, StreamWord};

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
        let kind = [PacketKind::Pairs, PacketKind::Pose].into_iter().find(|&kind| {
            let exists = kind == PacketKind::Pairs || self.format.has_pose();
            exists && words[0].low() as u32 == self.format.header(kind)
        });
        let body = &words[1..];
        let report = match kind {
            None => StreamReport::UnknownHeader,
            Some(PacketKind::Pairs) => {
                let size = self.format.record_words(PacketKind::Pairs) as usize;
                for record in body.chunks_exact(size) {
                    let data = self.format.answer(&self.verdict(record)).into();
                    answers.push(Transfer { data, last: false });
                }
                if !body.is_empty() && body.len().is_multiple_of(size) {
                    answers.last_mut().expect("an answer a record").last = true;
                    return;
                }
                StreamReport::TooShort
            }
            Some(PacketKind::Pose) => match body.len().cmp(&(self.format.record_words(PacketKind::Pose) as usize)) {
                std::cmp::Ordering::Less => StreamReport::TooShort,
                std::cmp::Ordering::Greater => StreamReport::TooLong,
                std::cmp::Ordering::Equal => {
                    let record = Record::new(&self.format, body);
                    self.pose = record.pose();
                    self.pose_unfit = record.unfit() && !self.pose.bypass;
                    StreamReport::PoseTaken
                }
            },
        };
        answers.push(Transfer { data: self.format.answer(&AnswerFields::report(report)).into(), last: true });
    }

    fn verdict(&self, words: &[StreamWord]) -> AnswerFields {
        let record = Record::new(&self.format, words);
        let unfit = self.pose_unfit || record.unfit();
        let outcome = if unfit { Outcome::outside() } else { self.golden.outcome(&self.pose, &record.pair()) };
        AnswerFields::verdict(record.tag(), &outcome)
    }
}
