//! The words of a query: what the command decoder makes of them.

use super::block::{field, put};
use super::{Frame, QueryRow};
use crate::format::EngineFormat;
use crate::words::{Command, QueryFlags, Reason};
use efsat_unit::pair::Pose;
use efsat_unit::words::{Record, StreamWord};

/// Where an object is in memory.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Side {
    /// Address of the blocks, in units of 64 bytes.
    pub blocks_at: u32,
    /// Address of the triangles, in units of 64 bytes.
    pub triangles_at: u32,
    /// Number of blocks.
    pub blocks: u32,
    /// Number of triangles.
    pub triangles: u32,
}

/// A query.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Query {
    /// A and B.
    pub sides: [Side; 2],
    /// The most expansions, 0 for no limit but 2^32 - 1.
    pub limit: u32,
    /// Whether to stop at the first certain contact.
    pub first_contact: bool,
    /// Whether to answer separate pairs too.
    pub all_pairs: bool,
    /// Whether to answer leaf pairs possibly incorrect, without a triangle test.
    pub leaf_pairs: bool,
    /// Whether to keep the caches of the query before.
    pub keep_caches: bool,
    /// The number that the report returns, 24 bits.
    pub number: u32,
    /// The error of the shift for each axis of A, in steps of the grid.
    pub errors: [u32; 3],
    /// The pose; never bypassed.
    pub pose: Pose,
    /// One row for each two opposite directions.
    pub rows: Vec<QueryRow>,
}

impl Query {
    /// What the test of volumes reads.
    pub fn frame(&self, format: &EngineFormat) -> Frame {
        Frame::new(&self.pose, self.errors, self.rows.clone(), format)
    }

    /// Its words.
    pub fn words(&self, format: &EngineFormat) -> Vec<u64> {
        let both = |[low, high]: [u32; 2]| u64::from(low) | u64::from(high) << 32;
        let sides = |of: fn(&Side) -> u32| both(self.sides.each_ref().map(of));
        let flags = [
            (QueryFlags::FIRST_CONTACT, self.first_contact),
            (QueryFlags::ALL_PAIRS, self.all_pairs),
            (QueryFlags::LEAF_PAIRS, self.leaf_pairs),
            (QueryFlags::KEEP_CACHES, self.keep_caches),
        ];
        let flags: u64 = flags.into_iter().map(|(at, flag)| u64::from(flag) << at).sum();
        let mut errors = 0;
        for (axis, &error) in (0..).zip(&self.errors) {
            errors |= u64::from(error) << (axis * format.shift_error_bits());
        }
        let mut words = vec![
            format.header(Command::Query),
            sides(|side| side.blocks_at),
            sides(|side| side.triangles_at),
            sides(|side| side.blocks),
            sides(|side| side.triangles),
            u64::from(self.limit) | flags | u64::from(self.number) << QueryFlags::NUMBER_AT,
            errors,
        ];
        let pose = Pose { bypass: false, ..self.pose };
        words.extend(format.stream.pose_record(&pose).iter().map(|word| word.low() as u64));
        words.extend(self.rows.iter().map(|row| {
            let mut word = [0];
            for (slot, (choice, factor)) in (0..).zip(row.terms) {
                put(&mut word, format.choice_at(slot), format.choice_bits(), choice.into());
                put(&mut word, format.choice_at(slot) + format.choice_bits(), format.factor_bits, factor.into());
            }
            put(&mut word, format.rest_at(), format.rest_bits(), row.rest.into());
            word[0]
        }));
        words
    }

    /// Reads the words of a packet.
    ///
    /// # Errors
    /// The reason of the report, if it is no query for this engine.
    pub fn of(words: &[u64], format: &EngineFormat) -> Result<Self, Reason> {
        if words.first() != Some(&format.header(Command::Query)) {
            return Err(Reason::UnknownHeader);
        }
        match words.len().cmp(&(format.query_words() as usize)) {
            std::cmp::Ordering::Less => return Err(Reason::TooShort),
            std::cmp::Ordering::Greater => return Err(Reason::TooLong),
            std::cmp::Ordering::Equal => {}
        }
        let half = |word: usize, side: usize| (words[word] >> (32 * side)) as u32;
        let side = |side| Side {
            blocks_at: half(1, side),
            triangles_at: half(2, side),
            blocks: half(3, side),
            triangles: half(4, side),
        };
        let flag = |at: u32| words[5] >> at & 1 == 1;
        let spare =
            field(&words[5..6], QueryFlags::KEEP_CACHES + 1, QueryFlags::NUMBER_AT - QueryFlags::KEEP_CACHES - 1);
        let record = &words[EngineFormat::POSE_AT as usize..format.row_at(0) as usize];
        let record: Vec<StreamWord> = record.iter().map(|&word| u128::from(word).into()).collect();
        let pose = Record::new(&format.stream, &record).pose();
        if spare != 0 || pose.bypass {
            return Err(Reason::UnknownHeader);
        }
        let rows = words[format.row_at(0) as usize..].iter().map(|word| {
            let at = |at, bits| field(std::slice::from_ref(word), at, bits) as u32;
            let terms = [0, 1, 2].map(|slot| {
                let choice = at(format.choice_at(slot), format.choice_bits());
                (choice, at(format.choice_at(slot) + format.choice_bits(), format.factor_bits))
            });
            let slots = format.directions.slots();
            let known = terms.iter().zip(slots).all(|((choice, _), slot)| (*choice as usize) < slot.len());
            let spare = word.checked_shr(format.rest_at() + format.rest_bits()).unwrap_or(0);
            (known && spare == 0)
                .then(|| QueryRow { terms, rest: at(format.rest_at(), format.rest_bits()) })
                .ok_or(Reason::UnknownHeader)
        });
        let error = |axis| field(&words[6..7], axis * format.shift_error_bits(), format.shift_error_bits()) as u32;
        Ok(Self {
            sides: [0, 1].map(side),
            limit: words[5] as u32,
            first_contact: flag(QueryFlags::FIRST_CONTACT),
            all_pairs: flag(QueryFlags::ALL_PAIRS),
            leaf_pairs: flag(QueryFlags::LEAF_PAIRS),
            keep_caches: flag(QueryFlags::KEEP_CACHES),
            number: (words[5] >> QueryFlags::NUMBER_AT) as u32,
            errors: [0, 1, 2].map(error),
            pose,
            rows: rows.collect::<Result<_, _>>()?,
        })
    }
}
