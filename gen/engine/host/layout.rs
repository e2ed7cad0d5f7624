//! Where images are in the memory of an engine.

use super::Image;
use super::image::{LINE, memory};
use crate::format::EngineFormat;
use crate::model::{Query, Side};
use crate::params::{EngineParams, Memory};
use crate::words::Command;
use efsat_unit::params::ParamError;

/// Address of the first triangle in block RAM, in units of 64 bytes; that of the first block is 0.
pub const TRIANGLES_AT: u32 = 1 << 25;

/// Images one after the other, from the first address on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Layout {
    /// What is in memory behind AXI, in words of 64 bits from address 0; nothing for block RAM.
    pub memory: Vec<u64>,
    /// Packets that fill block RAM, each of which is answered by a report; none for AXI.
    pub loads: Vec<Vec<u64>>,
    /// Where each image is.
    pub sides: Vec<Side>,
}

impl Layout {
    /// Places images for an engine.
    ///
    /// # Errors
    /// If block RAM is too small for them.
    pub fn new(engine: &EngineParams, format: &EngineFormat, images: &[&Image]) -> Result<Self, ParamError> {
        let (words, sides) = memory(images);
        if engine.memory == Memory::Axi {
            return Ok(Self { memory: words, loads: vec![], sides });
        }
        let total = |of: fn(&Side) -> u32| sides.iter().map(of).sum::<u32>();
        let needs = [
            ("block-lines", engine.block_lines, total(|side| side.blocks)),
            ("triangle-lines", engine.triangle_lines, total(|side| side.triangles)),
        ];
        if let Some((option, found, least)) = needs.into_iter().find(|(_, found, least)| found < least) {
            let legal = format!("expected at least {least}, which the meshes take in block RAM");
            return Err(ParamError { option, found: found.to_string(), legal });
        }
        let load = |from: u32, to: u32, count: u32| {
            let line = LINE as usize / 8;
            let head = [format.header(Command::Load), u64::from(to) * u64::from(LINE)];
            [&head[..], &words[from as usize * line..][..count as usize * line]].concat()
        };
        let mut next = Side { blocks_at: 0, triangles_at: TRIANGLES_AT, ..Side::default() };
        let mut loads = vec![];
        let placed = sides.iter().map(|side| {
            loads.push(load(side.blocks_at, next.blocks_at, side.blocks));
            loads.push(load(side.triangles_at, next.triangles_at, side.triangles));
            let here = Side { blocks_at: next.blocks_at, triangles_at: next.triangles_at, ..*side };
            next.blocks_at += side.blocks;
            next.triangles_at += side.triangles;
            here
        });
        let sides = placed.collect();
        Ok(Self { memory: vec![], loads, sides })
    }

    /// A query about the images where they are, from one that has them where `from` says.
    ///
    /// # Panics
    /// If one of its sides is none of `from`.
    pub fn moved(&self, query: &Query, from: &[Side]) -> Query {
        Query { sides: query.sides.map(|side| self.there(side, from)), ..query.clone() }
    }

    /// Where an object is, of those that are where `from` says.
    ///
    /// # Panics
    /// If it is none of them.
    #[doc(hidden)]
    pub fn there(&self, side: Side, from: &[Side]) -> Side {
        let there = self.sides
            [from.iter().position(|known| known.triangles_at == side.triangles_at).expect("a side of an image")];
        Side { blocks_at: there.blocks_at, triangles_at: there.triangles_at, ..side }
    }
}
