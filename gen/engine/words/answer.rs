//! The words that an engine answers: pairs of triangles, and the report at the end.

use super::QueryFlags;
use efsat_unit::words::REPORT;

/// Why a query has ended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u8)]
pub enum Reason {
    /// Everything was traversed.
    #[default]
    Complete = 0,
    /// A certain contact was found, and the query asked for no more.
    Contact = 1,
    /// The limit of expansions was reached before the end.
    Limit = 2,
    /// A block that no tree has.
    BadTree = 3,
    /// The memory answered with an error.
    Memory = 4,
    /// The host has sent a stop.
    Stopped = 5,
    /// The header is no header, or one for another design.
    UnknownHeader = 6,
    /// The packet was too short.
    TooShort = 7,
    /// The packet was too long.
    TooLong = 8,
    /// The memory does not answer.
    Silent = 9,
    /// A soft reset: all that was asked for before has no other answer.
    Reset = 10,
}

impl Reason {
    /// All reasons by their code.
    pub const ALL: [Self; 11] = [
        Self::Complete,
        Self::Contact,
        Self::Limit,
        Self::BadTree,
        Self::Memory,
        Self::Stopped,
        Self::UnknownHeader,
        Self::TooShort,
        Self::TooLong,
        Self::Silent,
        Self::Reset,
    ];

    /// Whether pairs that touch may be missing from the answer.
    pub fn is_incomplete(self) -> bool {
        !matches!(self, Self::Complete | Self::Contact)
    }
}

/// A word of the answer that is a pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct EngineAnswer {
    /// The code of the verdict.
    pub verdict: u8,
    /// The numbers that the triangles of A and of B carry.
    pub triangles: [u32; 2],
}

impl EngineAnswer {
    /// Place of the number of A's triangle.
    pub const A_AT: u32 = 8;
    /// Place of the number of B's triangle.
    pub const B_AT: u32 = 36;
    /// Bits of both.
    pub const NUMBER_BITS: u32 = 28;

    /// Its word.
    pub fn word(&self) -> u64 {
        let [a, b] = self.triangles.map(u64::from);
        u64::from(self.verdict) | a << Self::A_AT | b << Self::B_AT
    }

    /// What a word says, none if it is no answer: the first of a report, or a word with bits that no answer has.
    pub fn of(word: u64) -> Option<Self> {
        let number = |at: u32| (word >> at & ((1 << Self::NUMBER_BITS) - 1)) as u32;
        let answer = Self { verdict: word as u8 & REPORT, triangles: [number(Self::A_AT), number(Self::B_AT)] };
        (answer.verdict != REPORT && answer.word() == word).then_some(answer)
    }
}

/// The report at the end of an answer. Without a fault all of expansions to possibly incorrect are functions of trees and pose
/// alone, if the query asks for all contacts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct EngineReport {
    /// Why the query has ended.
    pub reason: Reason,
    /// The number that the query carried, 24 bits.
    pub number: u32,
    /// Clocks from the first word of the query to the report.
    pub clocks: u32,
    /// Pairs of nodes opened.
    pub expansions: u32,
    /// Pairs of volumes tested.
    pub tests: u32,
    /// Those that may overlap.
    pub survivors: u32,
    /// Those of them that are two triangles.
    pub leaf_pairs: u32,
    /// Pairs of triangles that intersect.
    pub intersect: u32,
    /// Pairs of triangles that are possibly incorrect.
    pub possibly_incorrect: u32,
    /// Blocks asked for, and read from memory.
    pub blocks: [u32; 2],
    /// Triangles asked for, and read from memory.
    pub triangles: [u32; 2],
    /// Words read from memory.
    pub words: u32,
    /// Clocks in which the volume unit waited for memory.
    pub memory_waits: u32,
    /// Clocks in which survivors waited for the queue of leaf pairs.
    pub queue_waits: u32,
    /// Greatest number of entries of the stack.
    pub stack: u16,
}

impl EngineReport {
    /// Words of a report.
    pub const WORDS: usize = 8;
    /// Place of the reason in word 0.
    pub const REASON_AT: u32 = 2;
    /// Bit of word 0: pairs may be missing.
    pub const INCOMPLETE_AT: u32 = 7;
    /// Place of the query's number in word 0.
    pub const NUMBER_AT: u32 = 8;

    /// Its words.
    pub fn words(&self) -> [u64; Self::WORDS] {
        let both = |low: u32, high: u32| u64::from(low) | u64::from(high) << 32;
        let incomplete = u64::from(self.reason.is_incomplete()) << Self::INCOMPLETE_AT;
        let head = u64::from(REPORT) | (self.reason as u64) << Self::REASON_AT | incomplete;
        [
            head | u64::from(self.number % QueryFlags::NUMBERS) << Self::NUMBER_AT | u64::from(self.clocks) << 32,
            both(self.expansions, self.tests),
            both(self.survivors, self.leaf_pairs),
            both(self.intersect, self.possibly_incorrect),
            both(self.blocks[0], self.blocks[1]),
            both(self.triangles[0], self.triangles[1]),
            both(self.words, self.memory_waits),
            both(self.queue_waits, self.stack.into()),
        ]
    }

    /// Whether it has the number of its query: not of a packet that was not read, and a soft reset has one of its own.
    pub(crate) fn is_numbered(&self) -> bool {
        !matches!(self.reason, Reason::UnknownHeader | Reason::TooShort | Reason::TooLong | Reason::Reset)
    }

    /// What eight words say, none if they are no report.
    pub fn of(words: &[u64; Self::WORDS]) -> Option<Self> {
        let [low, high] = [0, 32].map(|at| words.map(|word| (word >> at) as u32));
        let report = Self {
            reason: *Reason::ALL.get((low[0] >> Self::REASON_AT & 0x1f) as usize)?,
            number: low[0] >> Self::NUMBER_AT,
            clocks: high[0],
            expansions: low[1],
            tests: high[1],
            survivors: low[2],
            leaf_pairs: high[2],
            intersect: low[3],
            possibly_incorrect: high[3],
            blocks: [low[4], high[4]],
            triangles: [low[5], high[5]],
            words: low[6],
            memory_waits: high[6],
            queue_waits: low[7],
            stack: high[7] as u16,
        };
        (report.words() == *words).then_some(report)
    }
}
