//! What goes to the triangle unit and comes from it.

use super::{Bits, WORD, zeros};
use crate::artefact::EngineDesign;
use crate::words::LINK_NUMBER_BITS;
use efsat_unit::design::top::{pair_ports, pose_ports};
use efsat_unit::params::{Params, Upper};
use efsat_unit::words::{PacketKind, StreamFormat};

/// A port and what is connected to it.
#[derive(Debug)]
pub(crate) struct Connection {
    pub port: String,
    pub value: String,
}

/// Triangles, and packets of pairs and poses.
#[derive(Debug)]
pub(crate) struct Unit {
    pub triangle_number_bits: u32,
    pub number_above: String,
    pub unit_inputs: Vec<Connection>,
    /// The unit takes no pair in the clock behind another one.
    pub paced: bool,
    /// It takes so few pairs that one may be offered to it a clock later.
    pub offers: bool,
    pub guarded: bool,
    pub sticky: bool,
    /// Flags of each kind that the unit gives.
    pub flags: Bits,
    pub pairs_header: String,
    pub pose_header: String,
    pub pair_words: u32,
    pub pose_words: u32,
    pub pair_tag_bits: u32,
    pub pair_tag: Bits,
    /// Bits of the unit's tag above that of a pair.
    pub tag_last: u32,
    pub tag_unfit: u32,
    /// All that a packet gives of the unit's tag.
    pub packet_tag: Bits,
    pub flag_zeros: String,
    /// Bits of a word that are to be the sign of a number, if the unit has a guard and does not read them.
    pub signs: Vec<Bits>,
    pub sign_high: u32,
}

impl Unit {
    pub fn new(design: &EngineDesign) -> Self {
        let (format, unit) = (&design.format, &design.unit.params);
        let (triangle, stream) = (format.triangle(), &format.stream);
        let signs = signs(stream);
        Self {
            triangle_number_bits: triangle.number_bits,
            number_above: match LINK_NUMBER_BITS - triangle.number_bits {
                0 => String::new(),
                bits => format!("\"{}\" & ", zeros(bits)),
            },
            unit_inputs: unit_inputs(unit, stream),
            paced: design.unit.interval > 1,
            offers: design.unit.interval > 2,
            guarded: unit.guarded(),
            sticky: unit.upper == Upper::Sticky,
            flags: Bits::all(stream.flags),
            pairs_header: format!("{:08x}", stream.header(PacketKind::Pairs)),
            pose_header: format!("{:08x}", stream.header(PacketKind::Pose)),
            pair_words: stream.record_words(PacketKind::Pairs),
            pose_words: format.pose_words,
            pair_tag_bits: stream.tag_width,
            pair_tag: Bits::all(stream.tag_width),
            tag_last: stream.tag_width,
            tag_unfit: stream.tag_width + 1,
            packet_tag: Bits::all(stream.tag_width + 1 + u32::from(!signs.is_empty())),
            flag_zeros: zeros(WORD - stream.answer_bits()),
            signs,
            sign_high: stream.spare_bits(),
        }
    }
}

/// The inputs of the unit: the numbers of both triangles, and those of the pose, whose places in the words of a job have names.
fn unit_inputs(p: &Params, stream: &StreamFormat) -> Vec<Connection> {
    let sticky = p.upper == Upper::Sticky;
    let mut inputs = vec![];
    let mut add = |port: String, value: String| inputs.push(Connection { port, value });
    for (i, port) in (0..).zip(pair_ports()) {
        let [word, flags] = if i < 9 { ["unit_v", "sticky_v"] } else { ["unit_w", "sticky_w"] };
        add(port.clone(), format!("{word}({})", Bits::new(stream.lane() * (i % 9), p.transform_width)));
        if sticky {
            add(format!("{port}_sticky"), format!("{flags}({})", i % 9));
        }
    }
    for port in pose_ports(p) {
        let sticky = sticky.then(|| format!("{port}_sticky"));
        for port in [port].into_iter().chain(sticky) {
            add(port.clone(), format!("pose_words(job_{port})"));
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
