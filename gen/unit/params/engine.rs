//! The options of the collision engine (docs/engine.md), each in one place, and what they have to agree on.
//!
//! Everything downstream reads [`EngineParams`] and the [`EngineFormat`] that follows from them and from the [`Params`] of the
//! unit behind the engine; nothing else decides a width or the place of a field.

mod format;
mod report;
#[cfg(test)]
mod tests;
mod widths;

pub use format::{
    BlockLayout, Command, EngineFormat, LEAF_BIT, LINK_NUMBER_BITS, NO_CHILD, ORIGIN_OVER_OFFSET, QueryFlags,
    TriangleLayout,
};
pub use report::{Answer, EngineReport, Reason};
pub use widths::{Width, Widths};

use super::options::{Choice, Spelled};
#[cfg(feature = "clap")]
use super::options::{choice, one_of, whole};
use super::{Method, ParamError, Params, Transform};
use efsat_geometry::directions::Directions;
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

impl Choice for Directions {
    const ALL: &'static [Self] = &Self::ALL;

    fn name(self) -> &'static str {
        match self {
            Self::Six => "6",
            Self::Fourteen => "14",
            Self::Eighteen => "18",
            Self::TwentySix => "26",
        }
    }
}

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

/// The table of options: name, field and type, default, and further arguments for clap; its comment is its help.
macro_rules! options {
    ($(
        #[doc = $help:literal]
        $name:literal $field:ident: $type:ty = $default:expr, [$($argument:tt)*];
    )+) => {
        /// A complete parameter set of the engine around a unit. Build one with [`EngineParams::default`] and change fields,
        /// then [`format`](EngineParams::format).
        #[derive(Clone, Debug, PartialEq, Eq, Hash)]
        #[cfg_attr(feature = "clap", derive(clap::Args))]
        #[cfg_attr(feature = "clap", command(next_help_heading = "Parameters of the engine"))]
        pub struct EngineParams {
            $(
                #[doc = $help]
                #[cfg_attr(feature = "clap", arg(long = $name, default_value = <$type>::spelled(&$default), $($argument)*))]
                pub $field: $type,
            )+
        }

        impl Default for EngineParams {
            fn default() -> Self {
                Self { $($field: $default,)+ }
            }
        }

        impl EngineParams {
            /// Every option (without its dashes) with its value, in a fixed order.
            pub fn options(&self) -> Vec<(&'static str, String)> {
                vec![$(($name, self.$field.spelled()),)+]
            }
        }
    };
}

options! {
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
    "block-lines" block_lines: u32 = 512,
        [value_name = "N", value_parser = one_of(LINES), allow_negative_numbers = true];
    /// Lines of the caches of triangles, half for each mesh; with --memory block-ram the triangles of both meshes
    "triangle-lines" triangle_lines: u32 = 256,
        [value_name = "N", value_parser = one_of(LINES), allow_negative_numbers = true];
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
}

impl EngineParams {
    /// Checks every range, and every relation between options and with those of the unit behind the engine, and derives the
    /// formats.
    ///
    /// # Errors
    /// The first option outside its range, with the legal range.
    pub fn format(&self, unit: &Params) -> Result<EngineFormat, ParamError> {
        unit.validate()?;
        if unit.method == Method::Exact && unit.transform != Transform::On {
            let found = unit.truth.name().to_owned();
            let legal = "expected snapped with --transform-width 26 in the engine, which gives the unit both triangles in their \
                own frames";
            return Err(ParamError { option: "truth", found, legal: legal.to_owned() });
        }
        if unit.transform != Transform::On {
            let found = unit.transform.name().to_owned();
            let legal = "expected on: the engine gives the unit both triangles in their own frames".to_owned();
            return Err(ParamError { option: "transform", found, legal });
        }
        self.ranges()?;
        let wrong = |option, found: u32, legal: String| Err(ParamError { option, found: found.to_string(), legal });
        let format = EngineFormat::new(self, unit);
        let most = self.offset_bits + ORIGIN_OVER_OFFSET;
        if self.origin_bits > most {
            let legal = format!(
                "expected at most {most}, the bits of a code and {ORIGIN_OVER_OFFSET}: origins lie on the grid of codes"
            );
            return wrong("origin-bits", self.origin_bits, legal);
        }
        if format.shift_error_bound() >= 1 << format.shift_error_bits() {
            let legal = "expected more: the error of a shift would not fit its 16 bits (origin-bits, and transform-width \
                less int-bits, against offset-bits)";
            return wrong("origin-bits", self.origin_bits, legal.to_owned());
        }
        if format.rest_at() + format.rest_bits() > u64::BITS {
            let most = (u64::BITS - format.rest_bits()) / 3 - format.choice_bits();
            let legal = format!(
                "expected at most {most} with --directions {} --offset-bits {}: a row of a query has 64 bits",
                format.k(),
                self.offset_bits
            );
            return wrong("factor-bits", self.factor_bits, legal);
        }
        let bits = format.block().bits;
        if bits > BlockLayout::MOST_BITS {
            let legal = format!("expected fewer: a block would have {bits} bits of {}", BlockLayout::MOST_BITS);
            return wrong("offset-bits", self.offset_bits, legal);
        }
        self.block_numbers()?;
        if self.memory == Memory::BlockRam && self.axi_id_bits > 0 {
            return wrong("axi-id-bits", self.axi_id_bits, "expected 0 with --memory block-ram".to_owned());
        }
        let least = 3 * self.tree_height + 2;
        if self.stack < least {
            return wrong("stack", self.stack, format!("expected at least 3 x tree-height + 2 = {least}"));
        }
        Ok(format)
    }

    /// Greatest number of entries up to which the stack is filled by more than one pair in flight (docs/engine.md).
    pub fn wide_limit(&self) -> u32 {
        self.stack - 3 * self.tree_height - 1
    }

    /// Whether the numbers of blocks are those of the blocks that memory can hold.
    fn block_numbers(&self) -> Result<(), ParamError> {
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

    fn ranges(&self) -> Result<(), ParamError> {
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
