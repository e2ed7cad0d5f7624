//! Nodes, the stack and what is in flight.

use super::{binary, places, zeros};
use crate::artefact::EngineDesign;
use crate::params::{EngineParams, Memory};

/// Entries of the stack, and how many of everything there may be.
#[derive(Debug)]
pub(crate) struct Traversal {
    pub levels: u32,
    pub deepest: String,
    pub entry_bits: u32,
    pub root_entry: String,
    pub stack: u32,
    pub stack_places: u32,
    pub stack_bits: u32,
    pub wide: i64,
    pub room_bits: u32,
    pub in_flight: u32,
    pub flight_places: u32,
    pub flight_bits: u32,
    pub pairs: u32,
    /// Of all lanes together.
    pub all_pairs: u32,
    pub pair_bits: u32,
    pub pair_room_bits: u32,
    /// The volume unit takes far less than a pair of nodes every other clock, and so many are popped at most; and at least three clocks
    /// are between two that it takes, so that the words of their queries come from registers.
    pub paced: bool,
    /// Pairs of nodes without blocks, in front of which a younger query waits.
    pub crowd: u32,
    pub open_bits: u32,
}

/// Clocks from a request of blocks that are in a cache to their being taken, about.
const BLOCK_CLOCKS: u32 = 8;

impl Traversal {
    pub fn new(design: &EngineDesign) -> Self {
        let params = &design.params;
        let node_bits = params.block_number_bits;
        let level_bits = level_bits(params);
        let root = format!("{}11", zeros(node_bits));
        let (stack_places, stack_bits) = places(params.stack);
        let (flight_places, flight_bits) = places(params.in_flight);
        let wide = i64::from(params.wide_limit());
        let most = params.stack + 4 * params.in_flight + 8;
        // Waiting, in the unit, and between: in front of the memory of triangles, looked up or on their way from it, and held in
        // front of the answers, fewer than 32 all together.
        let open = params.pair_queue + design.unit.places as u32 + 32;
        Self {
            levels: params.tree_height,
            deepest: binary(params.tree_height, level_bits),
            entry_bits: entry_bits(params),
            root_entry: format!("{root}{root}{}", zeros(level_bits)),
            stack: params.stack,
            stack_places,
            stack_bits,
            wide,
            room_bits: 34 - most.leading_zeros(),
            in_flight: params.in_flight,
            flight_places,
            flight_bits,
            pairs: params.pair_queue,
            all_pairs: params.queries * params.pair_queue,
            pair_bits: params.pair_queue.ilog2(),
            pair_room_bits: 34 - (params.pair_queue + 4 * params.in_flight + 8).leading_zeros(),
            paced: params.memory == Memory::Axi && params.expansion_clocks > 2,
            crowd: BLOCK_CLOCKS.div_ceil(params.expansion_clocks) + 1,
            open_bits: 33 - open.leading_zeros(),
        }
    }
}

/// Bits of a level.
pub(super) fn level_bits(params: &EngineParams) -> u32 {
    u32::BITS - params.tree_height.leading_zeros()
}

/// Bits of an entry of the stack: a level, and for both trees a node and which of its children are to be tested.
pub(super) fn entry_bits(params: &EngineParams) -> u32 {
    level_bits(params) + 2 * (params.block_number_bits + 2)
}
