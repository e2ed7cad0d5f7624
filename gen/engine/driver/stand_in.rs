//! The engine in software: the reference model reading and writing packets.

use super::{Engine, EngineError, Objects};
use crate::format::EngineFormat;
use crate::host::TRIANGLES_AT;
use crate::model::{Model, Query, Side};
use crate::params::Memory;
use crate::words::{Command, EngineAnswer, EngineReport, QueryFlags, Reason};
use efsat_unit::host::driver::StandIn as Unit;
use efsat_unit::params::ParamError;
use efsat_unit::parts::packet;
use efsat_unit::words::{PacketKind, StreamWidth};
use rayon::prelude::*;

/// 64-bit words in a line of memory.
const LINE: usize = 8;

/// Answers packets as the engine does, without time: counts of clocks and of memory are zero in its reports.
#[derive(Clone, Debug)]
pub struct StandIn {
    model: Model,
    /// All of memory. In block RAM the triangles are behind the blocks.
    memory: Vec<u64>,
    /// Lines of blocks and of triangles in block RAM; none for an AXI4 read master.
    block_ram: Option<[u32; 2]>,
    /// Answers packets of pairs and poses.
    unit: Unit,
}

impl StandIn {
    /// The engine of objects, with their images in its memory.
    ///
    /// # Errors
    /// A parameter outside its range.
    pub fn new(objects: &Objects<'_>) -> Result<Self, ParamError> {
        let engine = &objects.engine;
        let model = Model::new(engine, &objects.unit)?;
        let (memory, block_ram) = match engine.memory {
            Memory::Axi => (objects.memory().to_vec(), None),
            Memory::BlockRam => {
                let lines = [engine.block_lines, engine.triangle_lines];
                (vec![0; LINE * (lines[0] + lines[1]) as usize], Some(lines))
            }
        };
        let unit = Unit::new(&EngineFormat::packets(&objects.unit), StreamWidth::Bits64)?;
        let mut stand_in = Self { model, memory, block_ram, unit };
        for packet in objects.loads() {
            stand_in.packet(packet);
        }
        Ok(stand_in)
    }

    /// The memory, to damage it.
    pub fn memory_mut(&mut self) -> &mut Vec<u64> {
        &mut self.memory
    }

    /// The words of the answer to a packet; a stop has none, and nothing to end. A soft reset finds nothing to forget but the pose.
    pub fn packet(&mut self, words: &[u64]) -> Vec<u64> {
        match self.block_ram {
            _ if for_unit(words) => {
                let transfers = packet(words.iter().map(|&word| u128::from(word).into()).collect());
                self.unit.answer(&transfers).iter().map(|transfer| transfer.data.low() as u64).collect()
            }
            Some(lines) if self.begins(words, Command::Load) => {
                report(self.load(&words[1..], lines).err().unwrap_or_default())
            }
            _ => {
                self.pose_of(words);
                self.read_only(words)
            }
        }
    }

    /// The unit keeps the pose of a query; a soft reset takes it away.
    fn pose_of(&mut self, words: &[u64]) {
        if self.orders(words, Command::Reset) && words.len() == 1 {
            self.unit.reset();
        }
        if let Ok(query) = Query::of(words, self.model.format()) {
            self.unit.set_pose(query.pose);
        }
    }

    /// The same for a packet that is no load and not for the unit alone.
    fn read_only(&self, words: &[u64]) -> Vec<u64> {
        match self.block_ram {
            _ if self.orders(words, Command::Stop) && words.len() == 1 => vec![],
            _ if self.orders(words, Command::Reset) && words.len() == 1 => {
                let number = (words[0] >> QueryFlags::NUMBER_AT) as u32;
                EngineReport { reason: Reason::Reset, number, ..EngineReport::default() }.words().to_vec()
            }
            _ if [Command::Stop, Command::Reset].iter().any(|&order| self.orders(words, order)) => {
                report(Reason::TooLong)
            }
            _ if words
                .first()
                .is_some_and(|&word| word as u32 == self.model.format().header(Command::Numbers) as u32) =>
            {
                self.numbers(words)
            }
            Some(lines) if self.begins(words, Command::Query) => match self.placed(words, lines) {
                Ok(words) => self.query(&words),
                Err(answer) => answer,
            },
            _ => self.query(words),
        }
    }

    fn begins(&self, words: &[u64], command: Command) -> bool {
        words.first() == Some(&self.model.format().header(command))
    }

    fn orders(&self, words: &[u64], command: Command) -> bool {
        words.first().is_some_and(|&word| self.model.format().is_order(command, word))
    }

    fn query(&self, words: &[u64]) -> Vec<u64> {
        let outcome = self.model.run(&self.memory, words);
        outcome.answers.iter().map(EngineAnswer::word).chain(outcome.report.words()).collect()
    }

    /// Pairs by number, as an engine that takes them answers.
    fn numbers(&self, words: &[u64]) -> Vec<u64> {
        let mut words = words.to_vec();
        if let Some([blocks, triangles]) = self.block_ram
            && let [_, at, counts, ..] = &mut words[..]
        {
            // Triangles are behind the blocks; what begins or ends outside them ends beyond the memory.
            let half = |word: u64, side: usize| (word >> (32 * side)) as u32;
            let placed = [0, 1].map(|side| match half(*at, side).checked_sub(TRIANGLES_AT) {
                Some(line) if u64::from(line) + u64::from(half(*counts, side)) <= u64::from(triangles) => blocks + line,
                _ => u32::MAX,
            });
            *at = u64::from(placed[0]) | u64::from(placed[1]) << 32;
        }
        let outcome = self.model.run_numbers(&self.memory, &words);
        outcome.answers.iter().map(EngineAnswer::word).chain(outcome.report.words()).collect()
    }

    /// Writes a line after the other.
    fn load(&mut self, words: &[u64], [blocks, triangles]: [u32; 2]) -> Result<(), Reason> {
        let [address, words @ ..] = words else { return Err(Reason::TooShort) };
        let line = u32::try_from(address >> 6).ok().filter(|_| address % 64 == 0 && *address < 1 << 32);
        let line = line.ok_or(Reason::UnknownHeader)?;
        let (start, end) = match line.checked_sub(TRIANGLES_AT) {
            None => (line, blocks),
            Some(line) => (blocks + line, blocks + triangles),
        };
        let room = end.saturating_sub(start) as usize * LINE;
        let count = words.len().min(room);
        self.memory[start.min(end) as usize * LINE..][..count].copy_from_slice(&words[..count]);
        match words.len() {
            0 => Err(Reason::TooShort),
            length if length > room => Err(Reason::TooLong),
            length if !length.is_multiple_of(LINE) => Err(Reason::TooShort),
            _ => Ok(()),
        }
    }

    /// A query with the addresses of the model's memory; the answer, if a range is not in the memory that it names.
    fn placed(&self, words: &[u64], lines: [u32; 2]) -> Result<Vec<u64>, Vec<u64>> {
        let format = self.model.format();
        let mut query = Query::of(words, format).map_err(report)?;
        let number = query.number;
        let outside = || EngineReport { reason: Reason::Memory, number, ..EngineReport::default() }.words().to_vec();
        for side in &mut query.sides {
            let Side { blocks_at, triangles_at, blocks, triangles } = side;
            let triangle = triangles_at.checked_sub(TRIANGLES_AT).ok_or_else(outside)?;
            let ends = [(*blocks_at, *blocks), (triangle, *triangles)];
            let ends = ends.map(|(at, count)| u64::from(at) + u64::from(count));
            if ends.iter().zip(lines).any(|(&end, lines)| end > lines.into()) {
                return Err(outside());
            }
            *triangles_at = lines[0] + triangle;
        }
        Ok(query.words(format))
    }
}

/// Whether a packet is one of pairs or a pose, or would be one.
fn for_unit(words: &[u64]) -> bool {
    let kind = words.first().map(|header| *header as u8);
    [PacketKind::Pairs, PacketKind::Pose].map(|kind| Some(kind as u8)).contains(&kind)
}

/// The answer to a packet that was not read, or was read to its end.
fn report(reason: Reason) -> Vec<u64> {
    EngineReport { reason, ..EngineReport::default() }.words().to_vec()
}

impl Engine for StandIn {
    type Error = EngineError;

    fn answer(&mut self, packets: &[&[u64]]) -> Result<Vec<Vec<u64>>, EngineError> {
        // Queries by themselves change nothing but the pose.
        if packets.iter().any(|packet| for_unit(packet) || self.begins(packet, Command::Load)) {
            return Ok(packets.iter().map(|packet| self.packet(packet)).collect());
        }
        packets.iter().for_each(|packet| self.pose_of(packet));
        Ok(packets.par_iter().map(|packet| self.read_only(packet)).collect())
    }
}
