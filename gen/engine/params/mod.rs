//! The options of the collision engine (docs/engine.md), each in one place.
//!
//! Everything downstream reads [`EngineParams`] and the [`EngineFormat`](crate::format::EngineFormat) that follows from them and
//! from the parameters of the unit behind the engine; nothing else decides a width or the place of a field.

use crate::words::LINK_NUMBER_BITS;
use efsat_geometry::directions::Directions;
use efsat_unit::option_set;
use efsat_unit::params::options::Choice;
use efsat_unit::params::{CLOCKS_PER_PAIR, Method, ParamError, Params};
use efsat_unit::parts::Spelled;
#[cfg(feature = "clap")]
use efsat_unit::parts::{choice, one_of, whole};
use std::ops::RangeInclusive;

/// Legal bits of a coordinate of an origin.
pub const ORIGIN_BITS: RangeInclusive<u32> = 4..=22;
/// Legal bits of a code.
pub const OFFSET_BITS: RangeInclusive<u32> = 4..=15;
/// Legal bits of a factor.
pub const FACTOR_BITS: RangeInclusive<u32> = 4..=16;
/// Legal clocks of an expansion.
pub const EXPANSION_CLOCKS: &[u32] = &[1, 2, 4];
/// Legal bits of a word of memory.
pub const MEMORY_WIDTH: &[u32] = &[32, 64, 128, 256, 512];
/// Legal lines of a cache.
pub const LINES: &[u32] = &[16, 32, 64, 128, 256, 512, 1024, 2048, 4096, 8192, 16384];
/// Legal numbers of queries in flight.
#[doc(hidden)]
pub const QUERIES: &[u32] = &[2, 4, 8];
/// Legal numbers of engines behind one stream.
#[doc(hidden)]
pub const ENGINES: RangeInclusive<u32> = 1..=16;
/// Options of the read port: block RAM has none, and one stream to fill it.
const OF_PORT: [&str; 5] = ["memory-width", "axi-id-bits", "watchdog", "engines", "memory-ports"];
/// Options of several engines.
const OF_SEVERAL: [&str; 2] = ["engines", "memory-ports"];
/// Legal numbers of pairs of nodes in flight.
pub const IN_FLIGHT: RangeInclusive<u32> = 1..=64;
/// Legal capacities of the stack, the bound by the height of trees aside.
pub const STACK: RangeInclusive<u32> = 8..=4096;
/// Legal heights of trees.
pub const TREE_HEIGHT: RangeInclusive<u32> = 1..=62;
/// Legal capacities of the queue of leaf pairs.
pub const PAIR_QUEUE: &[u32] = &[16, 32, 64, 128, 256, 512, 1024];
/// Legal clocks of the watchdog: 0 is none.
pub const WATCHDOG: RangeInclusive<u32> = 0..=1 << 24;
/// Legal bits of an ID of AXI.
pub const AXI_ID_BITS: RangeInclusive<u32> = 0..=16;
/// Bits of an address of AXI, in units of 64 bytes.
pub const ADDRESS_BITS: u32 = 26;
/// Legal bits of the number of a block.
pub const BLOCK_NUMBER_BITS: RangeInclusive<u32> = 8..=LINK_NUMBER_BITS;

/// Where trees and triangles are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Memory {
    /// In memory behind an AXI4 read master, with caches in front of it.
    Axi,
    /// In block RAM, filled through the stream.
    BlockRam,
}

impl Choice for Memory {
    const ALL: &'static [Self] = &[Self::Axi, Self::BlockRam];

    fn name(self) -> &'static str {
        match self {
            Self::Axi => "axi",
            Self::BlockRam => "block-ram",
        }
    }
}

/// The read ports of several engines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[doc(hidden)]
pub enum MemoryPorts {
    /// One for all.
    One,
    /// One for each.
    Each,
}

impl Choice for MemoryPorts {
    const ALL: &'static [Self] = &[Self::One, Self::Each];

    fn name(self) -> &'static str {
        match self {
            Self::One => "one",
            Self::Each => "each",
        }
    }
}

option_set! {
    /// A complete parameter set of the engine around a unit. Build one with [`EngineParams::default`] and change fields,
    /// then [`format`](EngineParams::format).
    #[cfg_attr(feature = "clap", command(next_help_heading = "Parameters of the engine"))]
    EngineParams,
    /// An engine whose trees are in memory, behind caches.
    default,
    /// Every option (without its dashes) with its value, in a fixed order.
    options;
    /// Directions of a bounding volume; 26 need --offset-bits of 6 or less
    "directions" directions: Directions = Directions::Eighteen,
        [value_name = "K", value_parser = choice::<Directions>(), allow_negative_numbers = true];
    /// Bits of a coordinate of a block's origin, and of a matrix entry that meets it, 4 to 22
    "origin-bits" origin_bits: u32 = 18,
        [value_name = "N", value_parser = whole(ORIGIN_BITS), allow_negative_numbers = true];
    /// Bits of a code, which is an offset of a bounding volume relative to its block, 4 to 15
    "offset-bits" offset_bits: u32 = 10,
        [value_name = "N", value_parser = whole(OFFSET_BITS), allow_negative_numbers = true];
    /// Bits of a factor of the realignment, 4 to 16
    "factor-bits" factor_bits: u32 = 12,
        [value_name = "N", value_parser = whole(FACTOR_BITS), allow_negative_numbers = true];
    /// Clocks between expansions, which test up to four pairs of volumes; fewer clocks take more multipliers
    "expansion-clocks" expansion_clocks: u32 = 4,
        [value_name = "N", value_parser = one_of(EXPANSION_CLOCKS), allow_negative_numbers = true];
    /// Where trees are: in memory behind an AXI4 read master with caches, or in block RAM that the stream fills
    "memory" memory: Memory = Memory::Axi,
        [value_name = "KIND", value_parser = choice::<Memory>()];
    /// Bits of a word of memory
    "memory-width" memory_width: u32 = 64,
        [value_name = "N", value_parser = one_of(MEMORY_WIDTH), allow_negative_numbers = true];
    /// Clocks without a word of memory, while a read is under way, after which a query ends with a reason of its own; 0 for never
    "watchdog" watchdog: u32 = 65_536,
        [value_name = "CLOCKS", value_parser = whole(WATCHDOG), allow_negative_numbers = true];
    /// Bits of ARID and RID of the AXI4 read port, 0 to 16; 0 for none. The ID is always 0
    "axi-id-bits" axi_id_bits: u32 = 0,
        [value_name = "N", value_parser = whole(AXI_ID_BITS), allow_negative_numbers = true];
    /// Lines of the caches of blocks, half for each tree; with --memory block-ram the blocks of both trees
    "block-lines" block_lines: u32 = 1024,
        [value_name = "N", value_parser = one_of(LINES), allow_negative_numbers = true];
    /// Lines of the caches of triangles, half for each mesh; with --memory block-ram the triangles of both meshes
    "triangle-lines" triangle_lines: u32 = 1024,
        [value_name = "N", value_parser = one_of(LINES), allow_negative_numbers = true];
    /// Queries in flight, 2, 4 or 8: while the oldest ends, the next ones begin
    "queries" queries: u32 = 4,
        [value_name = "N", value_parser = one_of(QUERIES), allow_negative_numbers = true];
    /// Pairs of nodes in flight, 1 to 64; fewer wait longer for memory
    "in-flight" in_flight: u32 = 16,
        [value_name = "N", value_parser = whole(IN_FLIGHT), allow_negative_numbers = true];
    /// Pairs of nodes that the stack holds, at least 3 x tree-height + 2
    "stack" stack: u32 = 512,
        [value_name = "N", value_parser = whole(STACK), allow_negative_numbers = true];
    /// Greatest level of a pair of nodes; no tree is higher
    "tree-height" tree_height: u32 = 32,
        [value_name = "N", value_parser = whole(TREE_HEIGHT), allow_negative_numbers = true];
    /// Pairs of triangles that wait for their turn to be read from memory; when it is full, the traversal waits
    "pair-queue" pair_queue: u32 = 128,
        [value_name = "N", value_parser = one_of(PAIR_QUEUE), allow_negative_numbers = true];
    /// Bits of the number of a block, 8 to 28, with --memory axi at most 26: a tree has no more blocks
    "block-number-bits" block_number_bits: u32 = 24,
        [value_name = "N", value_parser = whole(BLOCK_NUMBER_BITS), allow_negative_numbers = true];
    /// Engines behind one stream, 1 to 16: a query goes to one that is free, and answers come in any order
    "engines" engines: u32 = 1,
        [value_name = "N", value_parser = whole(ENGINES), allow_negative_numbers = true];
    /// Read ports of several engines: one for all, or one for each
    "memory-ports" memory_ports: MemoryPorts = MemoryPorts::One,
        [value_name = "KIND", value_parser = choice::<MemoryPorts>()];
}

impl EngineParams {
    /// The unit of an engine for which no other is chosen: determinants, as fast as the volume unit and no faster.
    pub fn unit(&self) -> Params {
        let keeps_up = |clocks: &u32| *clocks <= self.expansion_clocks;
        let clocks_per_pair = CLOCKS_PER_PAIR.iter().copied().filter(keeps_up).max().unwrap_or(1);
        Params { clocks_per_pair, ..Params::of(Method::Determinants) }
    }

    /// Bits of the number of a lane, which a query in flight has.
    #[doc(hidden)]
    pub fn lane_bits(&self) -> u32 {
        self.queries.ilog2()
    }

    /// Greatest number of entries up to which the stack is filled by more than one pair in flight (docs/engine.md).
    pub fn wide_limit(&self) -> u32 {
        self.stack - 3 * self.tree_height - 1
    }

    /// Whether the engine has an option: with block RAM there is no read port, and one engine is by itself.
    #[doc(hidden)]
    pub fn has(&self, option: &str) -> bool {
        (self.memory == Memory::Axi || !OF_PORT.contains(&option))
            && (self.engines > 1 || !OF_SEVERAL.contains(&option))
    }

    /// Refuses options of the read port where there is none: `given` are those that somebody chose.
    ///
    /// # Errors
    /// The first such option.
    #[doc(hidden)]
    pub fn refuse_of_port<'a>(
        &self,
        mut given: impl Iterator<Item = &'a (&'static str, String)>,
    ) -> Result<(), ParamError> {
        match given.find(|(option, _)| self.memory != Memory::Axi && OF_PORT.contains(option)) {
            None => Ok(()),
            Some((option, found)) => {
                let legal = "expected --memory axi with it: block RAM has no read port".to_owned();
                Err(ParamError { option, found: found.clone(), legal })
            }
        }
    }

    /// Refuses several engines with block RAM, and ports of each where there is one.
    pub(crate) fn several(&self) -> Result<(), ParamError> {
        if self.engines == 1 && self.memory_ports == MemoryPorts::Each {
            let legal = "expected --engines 2 or more with it".to_owned();
            return Err(ParamError { option: "memory-ports", found: self.memory_ports.name().to_owned(), legal });
        }
        let options = [("engines", self.engines.to_string())];
        if self.engines > 1 { self.refuse_of_port(options.iter()) } else { Ok(()) }
    }

    /// Whether the numbers of blocks are those of the blocks that memory can hold.
    pub(crate) fn block_numbers(&self) -> Result<(), ParamError> {
        let (bits, lines) = (self.block_number_bits, self.block_lines);
        let legal = match self.memory {
            Memory::Axi if bits > ADDRESS_BITS => {
                format!("expected at most {ADDRESS_BITS}: no more blocks have an address")
            }
            Memory::BlockRam if lines > 1 << bits => {
                format!("expected at least {} for the {lines} blocks of --block-lines", lines.ilog2())
            }
            _ => return Ok(()),
        };
        Err(ParamError { option: "block-number-bits", found: bits.to_string(), legal })
    }

    /// Checks every range.
    pub(crate) fn ranges(&self) -> Result<(), ParamError> {
        let ranges = [
            ("origin-bits", self.origin_bits, ORIGIN_BITS),
            ("offset-bits", self.offset_bits, OFFSET_BITS),
            ("factor-bits", self.factor_bits, FACTOR_BITS),
            ("in-flight", self.in_flight, IN_FLIGHT),
            ("stack", self.stack, STACK),
            ("tree-height", self.tree_height, TREE_HEIGHT),
            ("block-number-bits", self.block_number_bits, BLOCK_NUMBER_BITS),
            ("watchdog", self.watchdog, WATCHDOG),
            ("axi-id-bits", self.axi_id_bits, AXI_ID_BITS),
            ("engines", self.engines, ENGINES),
        ];
        let outside = ranges.into_iter().find(|(_, found, legal)| !legal.contains(found));
        if let Some((option, found, legal)) = outside {
            let legal = format!("expected {} to {}", legal.start(), legal.end());
            return Err(ParamError { option, found: found.to_string(), legal });
        }
        let lists = [
            ("expansion-clocks", self.expansion_clocks, EXPANSION_CLOCKS),
            ("memory-width", self.memory_width, MEMORY_WIDTH),
            ("block-lines", self.block_lines, LINES),
            ("triangle-lines", self.triangle_lines, LINES),
            ("pair-queue", self.pair_queue, PAIR_QUEUE),
            ("queries", self.queries, QUERIES),
        ];
        match lists.into_iter().find(|(_, found, list)| !list.contains(found)) {
            None => Ok(()),
            Some((option, found, list)) => {
                let legal = list.iter().map(u32::to_string).collect::<Vec<_>>().join(", ");
                Err(ParamError { option, found: found.to_string(), legal: format!("expected one of {legal}") })
            }
        }
    }
}
