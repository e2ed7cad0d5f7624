//! The host's side of the stream wrapper: packs pairs and poses into words, unpacks verdicts, retests in software.
//!
//! A [`Driver`] knows the format of one design ([`StreamFormat`]). From loose pairs ([`Driver::loose`]) or from two
//! meshes under a pose ([`Driver::meshes`]) it makes a [`Job`]: the words to send, without the pairs that the host
//! decides itself. [`Job::finish`] takes the words that came back and gives the exact answer of every pair, those that
//! the unit calls possibly incorrect retested in software. How words get to the unit and back (DMA, PCIe, UART) is the
//! user's; [`StandIn`] answers in software as the unit does.
//!
//! ```
//! use efsat_unit::host::driver::{Driver, StandIn};
//! use efsat_geometry::exact::Exact;
//! use efsat_unit::params::Params;
//! use efsat_unit::words::StreamWidth;
//!
//! // A vertex through a face, on it, and above it.
//! let face = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
//! let pair = |z: f64| [face[0], face[1], face[2], [1.0, 1.0, z], [1.5, 1.25, 1.0], [2.0, 1.5, 1.25]];
//! let pairs = [pair(-0.5), pair(0.0), pair(0.5)];
//!
//! let params = Params::default();
//! let driver = Driver::new(&params, StreamWidth::Bits64)?;
//! let job = driver.loose(&pairs)?;
//! let mut unit = StandIn::new(&params, StreamWidth::Bits64)?;
//! let answers = unit.answer(job.transfers());
//! let results = job.finish(&answers)?;
//! assert_eq!(results.answers, [Exact::Intersect, Exact::Touch, Exact::Separate]);
//! assert_eq!(results.statistics.retested, 1);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod contradiction;
mod job;
mod stand_in;
#[cfg(test)]
mod tests;

pub use job::{Job, Meshes, Results, Statistics};
pub use stand_in::StandIn;

use crate::host::{self, SceneHost};
use crate::pair::{Input, Outcome, Pair, Pose, Verdict};
use crate::params::{ParamError, Params, Quantity, Transform, Upper};
use crate::words::{AnswerFields, PacketKind, StreamFormat, StreamReport, StreamWidth, StreamWord, verdict_status};
use efsat_geometry::finite::NotFinite;

/// One word of a stream and its TLAST.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Transfer {
    /// TDATA.
    pub data: StreamWord,
    /// TLAST: the last word of its packet.
    pub last: bool,
}

/// What one word from the unit says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnitAnswer {
    /// The verdict of the pair that was sent with this tag.
    Pair {
        /// Tag, cut to the tag width of the design.
        tag: u64,
        /// Verdict and flags.
        outcome: Outcome,
    },
    /// No verdict.
    Report(StreamReport),
}

/// What cannot be sent, or came back and is no answer to what was sent.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DriverError {
    /// A word that no unit of this design sends.
    #[error("found {:#x} as answer {at}, which no unit of this design sends", **data)]
    Word {
        /// Number of the answer, from 0.
        at: usize,
        /// The word.
        data: Box<StreamWord>,
    },
    /// The unit found a packet malformed, or reported something else than expected.
    #[error("the unit reports {report:?} as answer {at}")]
    Reported {
        /// Number of the answer, from 0.
        at: usize,
        /// The report.
        report: StreamReport,
    },
    /// A verdict where the pose's report was expected, or one for another pair.
    #[error("answer {at} belongs to another pair or packet")]
    Order {
        /// Number of the answer, from 0.
        at: usize,
    },
    /// More or fewer answers than expected.
    #[error("found {found} answers; {expected} are due")]
    Count {
        /// Answers due.
        expected: usize,
        /// Answers found.
        found: usize,
    },
    /// A pose that the design has no ports for: it would be answered as another one.
    #[error("the design cannot do this pose: {0}")]
    Pose(&'static str),
    /// A number outside its declared range, for which the unit makes no promise.
    #[error("{} {index}: found {found}; expected {least} to {most}", quantity.name())]
    Number {
        /// What it is.
        quantity: Quantity,
        /// Its place in the record.
        index: usize,
        /// The number.
        found: i64,
        /// The least number expected.
        least: i64,
        /// The greatest one; one less if its sticky bit is set.
        most: i64,
    },
    /// A unit that would answer for numbers outside their ranges.
    #[error("the unit has no guard, and may answer wrongly for a number outside its range; expected --guard always")]
    Unguarded,
    /// Bytes that are no whole words.
    #[error("found {found} bytes; expected a multiple of {word}")]
    Bytes {
        /// Bytes found.
        found: usize,
        /// Bytes of a word.
        word: usize,
    },
}

/// Packs for, and unpacks from, the stream wrapper of one design.
#[derive(Clone, Debug)]
pub struct Driver {
    params: Params,
    format: StreamFormat,
    /// Whether numbers outside their declared ranges are sent, too.
    passes: bool,
}

/// Words as one packet.
pub fn packet(words: Vec<StreamWord>) -> Vec<Transfer> {
    let count = words.len();
    words.into_iter().enumerate().map(|(i, data)| Transfer { data, last: i + 1 == count }).collect()
}

impl Driver {
    /// The driver of a design.
    ///
    /// # Errors
    /// A parameter outside its range.
    pub fn new(params: &Params, width: StreamWidth) -> Result<Self, ParamError> {
        params.validate()?;
        Ok(Self { params: params.clone(), format: StreamFormat::new(params, width), passes: false })
    }

    /// A driver that also packs numbers outside their declared ranges, as long as their words hold them: the guard answers
    /// such pairs possibly incorrect.
    ///
    /// # Errors
    /// A unit without a guard.
    pub fn passing_all(self) -> Result<Self, DriverError> {
        if self.params.guarded() { Ok(Self { passes: true, ..self }) } else { Err(DriverError::Unguarded) }
    }

    /// The format of the words.
    pub fn format(&self) -> &StreamFormat {
        &self.format
    }

    /// The packet that loads a pose for the packets after it; no words for the identity in a design without a transform.
    ///
    /// # Errors
    /// A pose that the design cannot do, or a number outside its declared range. With the bypass numbers are not read, and
    /// only have to fit their words.
    pub fn pack_pose(&self, pose: &Pose) -> Result<Vec<Transfer>, DriverError> {
        let identity = Pose::identity(&self.params);
        let (turned, moved) = (!pose.bypass && pose.m != identity.m, !pose.bypass && pose.t != identity.t);
        match self.params.transform {
            Transform::Off if turned || moved => return Err(DriverError::Pose("only the identity")),
            Transform::Translate if turned => return Err(DriverError::Pose("only translations")),
            Transform::Off => return Ok(vec![]),
            Transform::Translate | Transform::On => {}
        }
        let unread = |quantity| if pose.bypass { Quantity::Unread } else { quantity };
        let entries = if self.params.transform == Transform::On { 9 } else { 0 };
        self.check(unread(Quantity::Entry), 0, pose.m.iter().flatten().take(entries))?;
        self.check(unread(Quantity::Translation), entries, &pose.t)?;
        let mut words = vec![u128::from(self.format.header(PacketKind::Pose)).into()];
        words.extend(self.format.pose_record(pose));
        Ok(packet(words))
    }

    /// The packet of some pairs with their tags, of which the low bits travel; no words if there are no pairs.
    ///
    /// # Errors
    /// A coordinate outside its declared range.
    pub fn pack_pairs<'a>(
        &self,
        pairs: impl IntoIterator<Item = (u64, &'a Pair)>,
    ) -> Result<Vec<Transfer>, DriverError> {
        let mut words = vec![u128::from(self.format.header(PacketKind::Pairs)).into()];
        for (tag, pair) in pairs {
            self.check(Quantity::Coordinate, 0, pair.a.iter().chain(&pair.b).flatten())?;
            words.extend(self.format.pair_record(tag, pair));
        }
        Ok(if words.len() == 1 { vec![] } else { packet(words) })
    }

    /// Whether numbers are inside their range, of which the first has the place `from` in its record.
    fn check<'a>(
        &self,
        quantity: Quantity,
        from: usize,
        numbers: impl IntoIterator<Item = &'a Input>,
    ) -> Result<(), DriverError> {
        let quantity = if self.passes { Quantity::Unread } else { quantity };
        let [least, end] = self.params.declared(quantity);
        let sticky = self.params.upper == Upper::Sticky && quantity != Quantity::Unread;
        for (index, x) in (from..).zip(numbers) {
            let most = end - i64::from(sticky && x.sticky);
            if !(least..=most).contains(&x.lo) {
                return Err(DriverError::Number { quantity, index, found: x.lo, least, most });
            }
        }
        Ok(())
    }

    /// What a word from the unit says; none if no unit of this design sends it: it has bits that no answer has, or its verdict
    /// contradicts its flags.
    pub fn unpack(&self, data: StreamWord) -> Option<UnitAnswer> {
        let fields = self.format.answer_fields(data.low()).filter(|_| data == data.low())?;
        let silent = fields.separated == 0 && fields.overlapping == 0;
        let outside = fields.status == verdict_status(Verdict::PossiblyIncorrect as u8, true);
        let verdict = match fields.status {
            0 => Verdict::Separate,
            1 => Verdict::Intersect,
            2 => Verdict::PossiblyIncorrect,
            _ if outside && silent && self.params.guarded() => Verdict::PossiblyIncorrect,
            _ => {
                let report = fields.reported()?;
                let known = AnswerFields::report(report) == fields;
                return known.then_some(UnitAnswer::Report(report));
            }
        };
        let outcome = Outcome { verdict, separated: fields.separated, overlapping: fields.overlapping, outside };
        let sound = !contradiction::contradicts(&self.params, &outcome);
        sound.then_some(UnitAnswer::Pair { tag: fields.tag, outcome })
    }

    /// Words for the unit as little-endian bytes, as they lie in a buffer for DMA. Packet ends are not in it.
    pub fn bytes(&self, transfers: &[Transfer]) -> Vec<u8> {
        let word = self.format.width.bits() as usize / 8;
        transfers.iter().flat_map(|transfer| transfer.data.bytes().take(word)).collect()
    }

    /// One packet from the unit, from its little-endian bytes.
    ///
    /// # Errors
    /// Bytes that are no whole words.
    pub fn packet(&self, bytes: &[u8]) -> Result<Vec<Transfer>, DriverError> {
        let word = self.format.answer_width() as usize / 8;
        if !bytes.len().is_multiple_of(word) {
            return Err(DriverError::Bytes { found: bytes.len(), word });
        }
        let data = |bytes: &[u8]| bytes.iter().rev().fold(0u128, |data, byte| data << 8 | u128::from(*byte)).into();
        Ok(packet(bytes.chunks(word).map(data).collect()))
    }

    /// The job of loose pairs a0 a1 a2 b0 b1 b2, each normalised by itself. Memory grows with the number of pairs: give
    /// them in batches.
    ///
    /// # Errors
    /// The first number that is not finite.
    pub fn loose<'a>(&'a self, pairs: &'a [[[f64; 3]; 6]]) -> Result<Job<'a>, NotFinite> {
        let normalised = host::loose_pairs(pairs, &self.params)?;
        Ok(Job::new(self, &Pose::identity(&self.params), normalised.into_iter(), job::Geometry::Loose(pairs)))
    }

    /// Two meshes by their vertices, normalised once for any number of jobs.
    ///
    /// # Errors
    /// The first coordinate that is not finite.
    pub fn meshes<'a>(&'a self, a: &'a [[f64; 3]], b: &'a [[f64; 3]]) -> Result<Meshes<'a>, NotFinite> {
        Ok(Meshes::new(self, SceneHost::new(a, b, &self.params)?, a, b))
    }
}
