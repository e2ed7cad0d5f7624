//! What is told in the entities that take pairs by number.

use super::{Bits, zeros};
use crate::artefact::EngineDesign;
use crate::format::EngineFormat;
use crate::params::Memory;
use crate::words::Command;

/// An object, and the cache of its triangles among those of the read master.
#[derive(Debug)]
pub(crate) struct Side {
    pub name: char,
    pub cache: u32,
}

/// Packets, and reports that wait.
#[derive(Debug)]
pub(crate) struct Numbers {
    pub header: String,
    /// Words before the first pair.
    pub pairs_word: u32,
    /// The last word of the pose, counted from its first.
    pub last_of_pose: u32,
    /// Kinds of word that are told apart.
    pub kinds: u32,
    /// Bits of a word that are to be the sign of a number.
    pub signs: Vec<Bits>,
    pub sign_high: u32,
    /// Bits of the number of a triangle in an address of a load, and those above, which are zero.
    pub load_line: Bits,
    pub load_above: Bits,
    pub load_zeros: String,
    /// A count of pairs wraps there.
    pub marks: u32,
    pub mark_bits: u32,
    pub mark_field: Bits,
    pub report_high: u32,
    pub sides: [Side; 2],
}

/// Bits of a report that waits below its mark: reason, number, two counts.
const REPORT_BITS: u32 = 5 + 24 + 32 + 32;

impl Numbers {
    pub fn new(design: &EngineDesign) -> Self {
        let format = &design.format;
        let lane = format.triangle().lane;
        let sign = |i: u32| Bits { high: lane * (i + 1) - 1, low: lane * i + format.transform_width - 1 };
        let load_line = Bits::new(6, design.params.triangle_lines.ilog2());
        let mark_bits = (2 * design.unit.places as u32).next_power_of_two().trailing_zeros();
        let mark_field = Bits::new(REPORT_BITS, mark_bits);
        Self {
            header: format!("{:08x}", format.header(Command::Numbers)),
            pairs_word: format.pairs_at(),
            last_of_pose: format.pairs_at() - EngineFormat::NUMBERS_POSE_AT - 1,
            kinds: if design.params.memory == Memory::BlockRam { 4 } else { 3 },
            signs: (0..super::WORD / lane).map(sign).collect(),
            sign_high: lane - format.transform_width,
            load_line,
            load_above: Bits { high: 30, low: load_line.high + 1 },
            load_zeros: zeros(30 - load_line.high),
            marks: 1 << mark_bits,
            mark_bits,
            mark_field,
            report_high: mark_field.high,
            sides: [Side { name: 'a', cache: 2 }, Side { name: 'b', cache: 3 }],
        }
    }
}
