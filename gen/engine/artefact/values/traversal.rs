//! Nodes, the stack and what is in flight.

use super::{binary, places, zeros};
use crate::artefact::EngineDesign;

/// Entries of the stack, and how many of everything there may be.
#[derive(Debug)]
pub(crate) struct Traversal {
    pub node_bits: u32,
    pub level_bits: u32,
    pub levels: u32,
    pub deepest: String,
    pub entry_bits: u32,
    pub a_high: u32,
    pub a_low: u32,
    pub b_high: u32,
    pub b_low: u32,
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
    pub pair_bits: u32,
    pub open_bits: u32,
}

impl Traversal {
    pub fn new(design: &EngineDesign) -> Self {
        let params = &design.params;
        let node_bits = params.block_number_bits;
        let level_bits = 32 - params.tree_height.leading_zeros();
        let b_low = level_bits + 2;
        let a_low = b_low + node_bits + 2;
        let entry_bits = a_low + node_bits;
        let root = format!("{}11", zeros(node_bits));
        let (stack_places, stack_bits) = places(params.stack);
        let (flight_places, flight_bits) = places(params.in_flight);
        let wide = i64::from(params.wide_limit());
        let most = params.stack + 4 * params.in_flight + 8;
        // Waiting, in the unit, and between: in front of the memory of triangles, looked up or on their way from it, and held in
        // front of the answers, fewer than 32 all together.
        let open = params.pair_queue + design.unit.places as u32 + 32;
        Self {
            node_bits,
            level_bits,
            levels: params.tree_height,
            deepest: binary(params.tree_height, level_bits),
            entry_bits,
            a_high: entry_bits - 1,
            a_low,
            b_high: b_low + node_bits - 1,
            b_low,
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
            pair_bits: params.pair_queue.ilog2(),
            open_bits: 32 - open.leading_zeros(),
        }
    }
}
