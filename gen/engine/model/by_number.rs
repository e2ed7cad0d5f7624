//! Packets of pairs by number, and what an engine that takes them answers.

use super::block::field;
use super::{EngineOutcome, Model, Query, Side};
use crate::format::EngineFormat;
use crate::words::{Command, EngineAnswer, EngineReport, QueryFlags, Reason};
use efsat_unit::pair::{Pose, Verdict};
use efsat_unit::words::{Record, StreamWord};

/// Pairs of triangles of two images, named by their numbers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ByNumber {
    /// A and B; where their blocks are is not said.
    pub sides: [Side; 2],
    /// Whether to answer separate pairs too.
    pub all_pairs: bool,
    /// Whether to keep the caches of the packet before.
    pub keep_caches: bool,
    /// The number that the report returns, 24 bits.
    pub number: u32,
    /// B is moved by this; with the bypass B is taken as it lies.
    pub pose: Pose,
    /// The places of the triangles in the images of A and of B.
    pub pairs: Vec<[u32; 2]>,
}

impl ByNumber {
    /// These pairs, of the objects and in the pose of a query.
    #[doc(hidden)]
    pub fn of_query(query: &Query, pairs: Vec<[u32; 2]>) -> Self {
        let &Query { sides, all_pairs, keep_caches, number, pose, .. } = query;
        Self { sides, all_pairs, keep_caches, number, pose, pairs }
    }

    /// Its words.
    #[doc(hidden)]
    pub fn words(&self, format: &EngineFormat) -> Vec<u64> {
        let both = |[low, high]: [u32; 2]| u64::from(low) | u64::from(high) << 32;
        let flags = [(QueryFlags::ALL_PAIRS, self.all_pairs), (QueryFlags::KEEP_CACHES, self.keep_caches)];
        let flags: u64 = flags.into_iter().map(|(at, flag)| u64::from(flag) << at).sum();
        let mut words = vec![
            format.order(Command::Numbers, self.number) | flags,
            both(self.sides.map(|side| side.triangles_at)),
            both(self.sides.map(|side| side.triangles)),
        ];
        words.extend(format.stream.pose_record(&self.pose).iter().map(|word| word.low() as u64));
        words.extend(self.pairs.iter().copied().map(both));
        words
    }

    /// Reads the words of a packet; a pair of triangles that are not there, and those behind it, are left out, with the reason.
    ///
    /// # Errors
    /// The reason of the report, if it is no packet for this engine.
    #[doc(hidden)]
    pub fn of(words: &[u64], format: &EngineFormat) -> Result<(Self, Reason), Reason> {
        let flags = [QueryFlags::ALL_PAIRS, QueryFlags::KEEP_CACHES].map(|at| 1 << at);
        let flag = |i: usize| words[0] & flags[i] != 0;
        let Some(first) = words.first() else { return Err(Reason::TooShort) };
        if !format.is_order(Command::Numbers, first & !flags[0] & !flags[1]) {
            return Err(Reason::UnknownHeader);
        }
        let (pose_at, pairs_at) = (EngineFormat::NUMBERS_POSE_AT as usize, format.pairs_at() as usize);
        // What is wrong first: a number of the pose that is no sign extension of what the unit reads, or the end of the packet.
        let sign = 64 - format.transform_width;
        let fits = |word: &u64| {
            [*word, word >> 32].iter().all(|&half| {
                let number = half as u32 as i32;
                let read = ((i64::from(number) << sign) >> sign) as i32;
                read == number
            })
        };
        // The end comes first in the last word, if that is not the last one of the pose.
        let whole = if words.len() < pairs_at { words.len() - 1 } else { pairs_at };
        if words[..whole].iter().skip(pose_at + 1).any(|word| !fits(word)) {
            return Err(Reason::UnknownHeader);
        }
        if words.len() < pairs_at {
            return Err(Reason::TooShort);
        }
        let half = |word: u64, side: usize| (word >> (32 * side)) as u32;
        let side =
            |side| Side { triangles_at: half(words[1], side), triangles: half(words[2], side), ..Side::default() };
        let sides = [0, 1].map(side);
        let record: Vec<StreamWord> = words[pose_at..pairs_at].iter().map(|&word| u128::from(word).into()).collect();
        let named = words[pairs_at..].iter().map(|&word| [half(word, 0), half(word, 1)]);
        let there = |pair: &[u32; 2]| pair.iter().zip(&sides).all(|(&number, side)| number < side.triangles);
        let pairs: Vec<[u32; 2]> = named.take_while(there).collect();
        let reason = if pairs.len() == words.len() - pairs_at { Reason::Complete } else { Reason::BadTree };
        let packet = Self {
            sides,
            all_pairs: flag(0),
            keep_caches: flag(1),
            number: field(&words[..1], QueryFlags::NUMBER_AT, QueryFlags::NUMBER_BITS) as u32,
            pose: Record::new(&format.stream, &record).pose(),
            pairs,
        };
        Ok((packet, reason))
    }
}

impl Model {
    /// Answers a packet of pairs by number over a memory of 64-bit words, in the order of the pairs.
    pub fn run_numbers(&self, memory: &[u64], packet: &[u64]) -> EngineOutcome {
        let (packet, reason) = match ByNumber::of(packet, self.format()) {
            Ok(read) => read,
            Err(reason) => {
                return EngineOutcome { answers: vec![], report: EngineReport { reason, ..EngineReport::default() } };
            }
        };
        let mut report = EngineReport { reason, number: packet.number, ..EngineReport::default() };
        if let Err(reason) = self.ranges(memory, &packet.sides) {
            return EngineOutcome { answers: vec![], report: EngineReport { reason, ..report } };
        }
        let records: Vec<_> = packet.pairs.iter().map(|&pair| self.triangles(memory, &packet.sides, pair)).collect();
        let (_, verdicts) = self.verdicts(&packet.pose, &records);
        report.leaf_pairs = verdicts.len() as u32;
        let mut answers = vec![];
        for (verdict, [a, b]) in verdicts.into_iter().zip(records) {
            match verdict {
                Verdict::Separate if !packet.all_pairs => continue,
                Verdict::Separate => {}
                Verdict::Intersect => report.intersect += 1,
                Verdict::PossiblyIncorrect => report.possibly_incorrect += 1,
            }
            answers.push(EngineAnswer { verdict: verdict as u8, triangles: [a.number, b.number] });
        }
        EngineOutcome { answers, report }
    }
}
