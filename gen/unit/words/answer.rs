//! What a word of the unit says: a verdict, or a report.

use crate::pair::Outcome;

/// What a word that is no verdict says. The discriminant is its reason, bits 3..2 of the status.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum StreamReport {
    /// The pose holds for the packets that follow.
    PoseTaken = 0,
    /// The header is no header, or one for another design; the packet was skipped.
    UnknownHeader = 1,
    /// The packet ended inside a record, or without one.
    TooShort = 2,
    /// A pose packet went on after its record; the pose was not taken.
    TooLong = 3,
}

impl StreamReport {
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
    /// The word of a verdict.
    pub fn verdict(tag: u64, outcome: &Outcome) -> Self {
        let status = verdict_status(outcome.verdict as u8, outcome.outside);
        Self { status, tag, separated: outcome.separated, overlapping: outcome.overlapping }
    }

    /// The word of a report.
    pub fn report(report: StreamReport) -> Self {
        let malformed = if report == StreamReport::PoseTaken { 0 } else { MALFORMED };
        Self { status: REPORT | (report as u8) << REASON_AT | malformed, tag: 0, separated: 0, overlapping: 0 }
    }

    /// What the word reports, none if it is a verdict.
    pub fn reported(&self) -> Option<StreamReport> {
        (self.status & 0b11 == REPORT).then(|| StreamReport::ALL[usize::from(self.status >> REASON_AT & 0b11)])
    }
}
