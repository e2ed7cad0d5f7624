//! What goes to the triangle unit and comes from it.

use super::{Bits, WORD, word_at, zeros};
use crate::artefact::EngineDesign;
use crate::format::EngineFormat;
use crate::words::LINK_NUMBER_BITS;
use efsat_unit::design::top::{pair_ports, pose_ports};
use efsat_unit::params::stream::{BYPASS_AT, Kind, StreamFormat};
use efsat_unit::params::{Params, Upper};

/// A port and what is connected to it.
#[derive(Debug)]
pub(crate) struct Connection {
    pub port: String,
    pub value: String,
}

/// Triangles, and packets of pairs and poses.
#[derive(Debug)]
pub(crate) struct Unit {
    pub triangle_bits: u32,
    pub triangle_number_bits: u32,
    pub number_above: String,
    pub unit_inputs: Vec<Connection>,
    /// The unit takes no pair in the clock behind another one.
    pub paced: bool,
    pub guarded: bool,
    pub sticky: bool,
    /// Flags of each kind that the unit gives.
    pub flags: u32,
    pub pairs_header: String,
    pub pose_header: String,
    pub pair_words: u32,
    pub pose_words: u32,
    /// Place of the last pair in the words of a job.
    pub pair_at: u32,
    pub pair_tag_bits: u32,
    pub unit_tag_zeros: String,
    pub flag_zeros: String,
    pub bypass_at: u32,
    /// Bits of a word that are to be the sign of a number, if the unit has a guard and does not read them.
    pub signs: Vec<Bits>,
    pub sign_high: u32,
}

impl Unit {
    pub fn new(design: &EngineDesign) -> Self {
        let (format, unit) = (&design.format, &design.unit.params);
        let (triangle, stream) = (format.triangle(), &format.stream);
        Self {
            triangle_bits: triangle.bits,
            triangle_number_bits: triangle.number_bits,
            number_above: match LINK_NUMBER_BITS - triangle.number_bits {
                0 => String::new(),
                bits => format!("\"{}\" & ", zeros(bits)),
            },
            unit_inputs: unit_inputs(unit, stream),
            paced: design.unit.interval > 1,
            guarded: unit.guarded(),
            sticky: unit.upper == Upper::Sticky,
            flags: stream.flags,
            pairs_header: format!("{:08x}", stream.header(Kind::Pairs)),
            pose_header: format!("{:08x}", stream.header(Kind::Pose)),
            pair_words: stream.record_words(Kind::Pairs),
            pose_words: format.pose_words,
            pair_at: word_at(format.query_words() - stream.record_words(Kind::Pairs)),
            pair_tag_bits: stream.tag_width,
            unit_tag_zeros: zeros(unit.tag_width - stream.tag_width - 1),
            flag_zeros: zeros(WORD - stream.answer_bits()),
            bypass_at: word_at(EngineFormat::POSE_AT) + BYPASS_AT,
            signs: signs(stream),
            sign_high: stream.spare_bits(),
        }
    }
}

/// The inputs of the unit: the numbers of both triangles, and those of the pose in the words of the job.
fn unit_inputs(p: &Params, pose: &StreamFormat) -> Vec<Connection> {
    let mut inputs = vec![];
    let mut add = |port: String, word: &str, low: u32, bits: Option<u32>| {
        let place = bits.map_or(low.to_string(), |bits| format!("{} downto {low}", low + bits - 1));
        inputs.push(Connection { port, value: format!("{word}({place})") });
    };
    for (i, port) in (0..).zip(pair_ports()) {
        let [word, sticky] = if i < 9 { ["unit_v", "sticky_v"] } else { ["unit_w", "sticky_w"] };
        add(port.clone(), word, pose.lane() * (i % 9), Some(p.transform_width));
        if p.upper == Upper::Sticky {
            add(format!("{port}_sticky"), sticky, i % 9, None);
        }
    }
    for (i, port) in (0..).zip(pose_ports(p)) {
        let at = word_at(EngineFormat::POSE_AT);
        add(port.clone(), "job_words", at + pose.number_at(i), Some(p.transform_width));
        if p.upper == Upper::Sticky {
            add(format!("{port}_sticky"), "job_words", at + i, None);
        }
    }
    inputs
}

/// The bits above the numbers of a word, in units whose guard has them checked.
fn signs(stream: &StreamFormat) -> Vec<Bits> {
    let (lane, spare) = (stream.lane(), stream.spare_bits());
    let ends = (1..=WORD / lane).map(|i| lane * i - 1);
    if spare > 0 { ends.map(|high| Bits { high, low: high - spare }).collect() } else { vec![] }
}
