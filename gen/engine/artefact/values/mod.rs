//! The numbers that the templates of the engine print.

mod blocks;
mod by_number;
mod engines;
mod layout;
mod memory;
mod query;
mod traversal;
mod unit;

use super::EngineDesign;
use super::vectors::formats_line;
use crate::params::Memory;
use blocks::Blocks;
use by_number::Numbers;
use efsat_unit::artefact::testbench::half_period;
use efsat_unit::parts::Bits;
use engines::Engines;
use layout::Group;
use memory::Memories;
use query::Query;
use traversal::Traversal;
use unit::Unit;

pub(super) use memory::Lines;

/// Words of a stream into the engine.
pub(super) const WORD: u32 = 64;

/// All of them.
#[derive(Debug)]
pub(super) struct Values {
    pub axi: bool,
    pub block_ram: bool,
    pub layout: Vec<Group>,
    /// Queries have lanes.
    pub lanes: bool,
    pub traversal: Traversal,
    pub blocks: Blocks,
    pub unit: Unit,
    pub query: Query,
    pub memory: Memories,
    pub numbers: Numbers,
    pub engines: Engines,
    pub top: &'static str,
    pub formats: String,
    pub patience: usize,
    pub half_period: String,
}

impl Values {
    pub(super) fn new(design: &EngineDesign) -> Self {
        let EngineDesign { params, format, unit, volume, .. } = design;
        let axi = params.memory == Memory::Axi;
        Self {
            axi,
            block_ram: !axi,
            layout: layout::groups(design),
            lanes: !design.by_number,
            traversal: Traversal::new(design),
            blocks: Blocks::new(format),
            unit: Unit::new(design),
            query: Query::new(format, params.memory),
            memory: Memories::new(design),
            numbers: Numbers::new(design),
            engines: Engines::new(design),
            top: design.top(),
            formats: formats_line(design),
            patience: 20000 + 4 * (unit.latency + volume.latency),
            half_period: format!("{} ps", half_period(&unit.params)),
        }
    }
}

/// The bits of a number, the highest first.
fn binary(value: u32, bits: u32) -> String {
    (0..bits).rev().map(|i| if value >> i & 1 == 1 { '1' } else { '0' }).collect()
}

fn zeros(bits: u32) -> String {
    "0".repeat(bits as usize)
}

/// Places up to the least power of two, at least two, and the bits of a place.
fn places(count: u32) -> (u32, u32) {
    let places = count.max(2).next_power_of_two();
    (places, places.trailing_zeros())
}

/// Place of the words of a job from word 1 on.
fn word_at(word: u32) -> u32 {
    WORD * (word - 1)
}
