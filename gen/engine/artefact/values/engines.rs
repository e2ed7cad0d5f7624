//! Several engines.

use crate::artefact::EngineDesign;
use crate::params::MemoryPorts;
use crate::words::QueryFlags;
use efsat_unit::words::PacketKind;

/// Words of an answer that wait for their turn, by engine: of most answers all.
const ANSWER_PLACES: u32 = 512;
/// Bursts under way of all engines.
const BURSTS: u32 = 64;

/// What is around them.
#[derive(Debug)]
pub(crate) struct Engines {
    pub several: bool,
    pub count: u32,
    /// Their numbers.
    pub each: Vec<u32>,
    /// The read ports of the top, [`EngineDesign::read_ports`].
    pub ports: Vec<String>,
    /// Whether each has a port of its own.
    pub own_ports: bool,
    /// Queries that an engine has: those in flight, and one that waits.
    pub most_queries: u32,
    pub answer_places: u32,
    pub answer_bits: u32,
    pub bursts: u32,
    pub burst_bits: u32,
    /// The low bytes of the headers of packets for the unit alone.
    pub pairs_kind: String,
    pub pose_kind: String,
    /// The bit of the options of a query that keeps the caches.
    pub keep: u32,
}

impl Engines {
    pub fn new(design: &EngineDesign) -> Self {
        let count = design.params.engines;
        let kind = |kind| format!("{:02x}", design.format.stream.header(kind) as u8);
        Self {
            ports: design.read_ports(),
            own_ports: design.params.memory_ports == MemoryPorts::Each,
            several: count > 1,
            count,
            each: (0..count).collect(),
            most_queries: design.params.queries + 1,
            answer_places: ANSWER_PLACES,
            answer_bits: ANSWER_PLACES.ilog2(),
            bursts: BURSTS,
            burst_bits: BURSTS.ilog2(),
            pairs_kind: kind(PacketKind::Pairs),
            pose_kind: kind(PacketKind::Pose),
            keep: QueryFlags::KEEP_CACHES,
        }
    }
}
