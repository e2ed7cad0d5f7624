//! What an engine is predicted to take of a device around its two units, entity by entity.
//!
//! Flip-flops, memories and carry chains are those that the templates declare, by the widths that they print. Look-up tables of
//! logic are what Yosys 0.23 makes of three engines, split into a base and what grows with the options: so much for each lane, for
//! each bit that is chosen by lane, for each bit of an entry. A base has three values, by the tables and chains of a family.

use super::values::{Lines, Values};
use super::{EngineDesign, NAME};
use crate::params::ADDRESS_BITS;
use crate::words::EngineAnswer;
use efsat_hardware::device::{Chains, Device, Fabric, Resources, block_rams};
use efsat_hardware::estimate;
use std::iter::Sum;
use std::ops::{Add, Mul};

/// By how much the look-up tables of the control, all entities together, may differ from what Yosys makes of them, in per cent.
// For the command line and the checks.
#[doc(hidden)]
pub const WITHIN: u32 = 10;

/// Words of the memories that a query has a row in: as many as a look-up table has.
const ROWS: u32 = 16;
/// Bits of a pair of triangles in its queue.
const PAIR_BITS: u32 = 2 * EngineAnswer::NUMBER_BITS;
/// Bits of a word of an answer, and whether it is the last.
const ANSWER_BITS: u32 = 65;

/// Cells, and block RAMs of 18 kbit.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cells {
    pub resources: Resources,
    pub block_rams: u64,
}

impl Add for Cells {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { resources: self.resources + other.resources, block_rams: self.block_rams + other.block_rams }
    }
}

impl Mul<u64> for Cells {
    type Output = Self;

    fn mul(self, n: u64) -> Self {
        Self { resources: self.resources * n, block_rams: self.block_rams * n }
    }
}

impl Sum for Cells {
    fn sum<I: Iterator<Item = Self>>(all: I) -> Self {
        all.fold(Self::default(), Add::add)
    }
}

/// An entity of the control.
// For the command line, the checks and the studies.
#[doc(hidden)]
#[derive(Clone, Debug)]
pub struct Entity {
    /// Its name, without a prefix.
    pub name: &'static str,
    /// Instances in the entity around it.
    pub instances: u64,
    /// What is predicted of one by itself, without those in it.
    pub own: Cells,
    /// The entities in it. The two units are not among them.
    pub parts: Vec<Self>,
}

impl Entity {
    /// One with everything in it.
    pub fn whole(&self) -> Cells {
        self.own + self.parts.iter().map(|part| part.whole() * part.instances).sum()
    }

    fn holding(self, parts: Vec<Self>) -> Self {
        Self { parts, ..self }
    }

    fn times(self, instances: u32) -> Self {
        Self { instances: instances.into(), ..self }
    }
}

/// How a memory is read.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Read {
    /// In the same clock, at a place of its own.
    Apart,
    /// In the same clock, at the place where it is written.
    InPlace,
    /// Into a register, which a block RAM has in it, at a place of its own.
    Registered,
    /// The same, at the place where it is written.
    RegisteredInPlace,
}
use Read::{Apart, InPlace, Registered, RegisteredInPlace};

/// A memory: how it is read, its places and its bits.
type Memory = (Read, u32, u32);

/// Chains of carry: how many, and their bits.
type Chain = (u32, u32);

/// Look-up tables by family: of four inputs in front of chains (Virtex-II), beside chains that have tables of their own (ECP5), and
/// of six inputs.
type ByFamily = [u32; 3];

/// What is counted by.
struct Sheet<'a> {
    design: &'a EngineDesign,
    values: Values,
    fabric: &'a Fabric,
}

impl EngineDesign {
    /// The top with the entities around the units, each with what it is predicted to take. Registers behind AXI4-Lite are not
    /// among them.
    #[doc(hidden)]
    pub fn control(&self, device: &Device) -> Entity {
        let sheet = Sheet { design: self, values: Values::new(self), fabric: device.fabric };
        match (self.by_number, self.params.engines) {
            (true, _) => sheet.by_number(),
            (false, 1) => sheet.engine(),
            (false, _) => sheet.engines(),
        }
    }

    /// What the design is predicted to take of a device, with the units of every engine.
    #[doc(hidden)]
    pub fn cells(&self, device: &Device) -> Cells {
        let units = self.units().into_iter().map(|unit| estimate::whole(unit, device)).sum();
        self.cells_around(units, device)
    }

    /// The same where it is known what the units of one engine take.
    #[doc(hidden)]
    pub fn cells_around(&self, units: Resources, device: &Device) -> Cells {
        Cells { resources: units, block_rams: 0 } * self.params.engines.into() + self.control(device).whole()
    }
}

impl Sheet<'_> {
    fn entity(&self, name: &'static str, flip_flops: u32, memories: &[Memory], chains: &[Chain], luts: u32) -> Entity {
        // The top bit of a sum needs no carry out of it; a cell of several bits is there all the same.
        let unused = u32::from(self.fabric.carry_cell == 1);
        let bits =
            |&(count, bits): &Chain| u64::from(count) * self.fabric.carry_bits(bits.saturating_sub(unused) as usize);
        let carry = chains.iter().map(bits).sum();
        let luts = u64::from(luts) + self.fabric.chain_luts(carry);
        let resources = Resources { luts, flip_flops: flip_flops.into(), carry, ..Resources::default() };
        let memories = memories.iter().map(|memory| self.memory(*memory)).sum();
        Entity { name, instances: 1, own: Cells { resources, block_rams: 0 } + memories, parts: vec![] }
    }

    /// A memory, with the register that it is read into and what chooses between its cells.
    fn memory(&self, (read, places, bits): Memory) -> Cells {
        let fabric = self.fabric;
        let registered = matches!(read, Registered | RegisteredInPlace);
        let (wide, place_bits) = (u64::from(bits), u64::from(places.ilog2()));
        if registered && places > fabric.deepest_table_memory {
            let mut resources = Resources::default();
            if read == Registered && fabric.guarded_block_rams {
                resources.flip_flops = 2 * wide + place_bits + 2;
                resources.luts = wide + place_bits;
            }
            return Cells { resources, block_rams: block_rams(places.into(), wide) };
        }
        let in_place = matches!(read, InPlace | RegisteredInPlace);
        let resources = Resources {
            memory_luts: fabric.memory_luts(places as usize, bits, in_place),
            flip_flops: if registered { wide } else { 0 },
            luts: if fabric.chains == Chains::Complete { wide * u64::from(places.div_ceil(16) - 1) } else { 0 },
            ..Resources::default()
        };
        Cells { resources, block_rams: 0 }
    }

    fn of(&self, luts: ByFamily) -> u32 {
        match self.fabric.chains {
            Chains::Complete => luts[1],
            Chains::WithTables if self.fabric.lut_inputs() < 6 => luts[0],
            Chains::WithTables => luts[2],
        }
    }

    /// The bits that are read, where memories have cells of one bit, or all.
    fn read_bits(&self, used: u32, stored: u32) -> u32 {
        if self.fabric.memory_cell.1 == 1 { used } else { stored }
    }

    /// Bits that are chosen among lanes.
    fn chosen(&self, bits: u32) -> u32 {
        let lanes = self.design.params.queries;
        bits * self.of([lanes / 2, lanes / 2, lanes.div_ceil(4)])
    }

    /// Comparisons of so many bits with a constant.
    fn compared(&self, bits: u32) -> u32 {
        bits.saturating_sub(1).div_ceil(self.fabric.lut_inputs() as u32 - 1)
    }
}

/// The entities. A number without a name is of flags, states and counters of fixed width.
impl Sheet<'_> {
    fn engine(&self) -> Entity {
        let luts = 40 + self.design.params.lane_bits() * self.of([15, 24, 16]);
        let around = [self.answer(), self.command(), self.control(), self.lines(), self.pairs(), self.queries()];
        let parts = around.into_iter().chain([self.traverse(), self.triangles()]).collect();
        self.entity(NAME, 4, &[], &[], luts).holding(parts)
    }

    /// What both sides have to take and to give.
    fn lines(&self) -> Entity {
        let memories = self.values.memory.memories.iter().map(|lines| self.memory_of(lines));
        let parts = memories.chain(self.values.axi.then(|| self.read_master())).collect();
        self.entity("engine_lines", 0, &[], &[], 7 * u32::from(self.values.axi)).holding(parts)
    }

    /// Corners come from memory or from a packet; numbers go past the unit.
    fn triangles(&self) -> Entity {
        let unit = &self.values.unit;
        let corners = 18 * (self.design.unit.params.transform_width + u32::from(unit.sticky));
        let flags = [unit.paced, unit.offers, !unit.signs.is_empty()].map(u32::from).iter().sum::<u32>() + 2;
        let luts = corners + self.of([208, 162, 184]);
        self.entity("engine_triangles", flags + 2 * unit.triangle_number_bits, &[], &[], luts)
    }

    /// Words of pairs and of the report, ten counters, two sums, and for each lane five counters.
    fn answer(&self) -> Entity {
        let (lanes, lane_bits) = (self.design.params.queries, self.design.params.lane_bits());
        let flip_flops =
            210 + lanes + 2 * lane_bits + 2 * u32::from(self.values.unit.guarded) + 12 * 32 + (lanes + 1) * 5 * 32;
        let luts = self.of([857, 1012, 795]) + lanes * self.of([40, 130, 4]);
        // Each bit of a count is chosen among more lanes than a table has inputs for.
        let luts = luts + u32::from(lanes > 4) * 5 * 32 * self.of([2, 0, 2]);
        self.entity("engine_answer", flip_flops, &[], &[(5 * lanes + 12, 32)], luts)
    }

    /// The words of a query, of which one is shifted at a time.
    fn command(&self) -> Entity {
        let (design, values) = (self.design, &self.values);
        let words = 64 * (design.format.query_words() - 1);
        let (loads, line) =
            (u32::from(values.block_ram), values.memory.load_line.high - values.memory.load_line.low + 1);
        let signs = values.unit.signs.len() as u32;
        let flip_flops = words + 278 + signs.min(1) + loads * (55 + 2 * line);
        let luts = self.of([287, 313, 247]) + signs * self.of([2, 16, 2]) + loads * self.of([52, 105, 51]);
        self.entity("engine_command", flip_flops, &[], &[(1, 6), (loads, line + 1), (loads, 8)], luts)
    }

    /// For each lane a number, a reason and flags.
    fn control(&self) -> Entity {
        let (lanes, lane_bits, axi) =
            (self.design.params.queries, self.design.params.lane_bits(), u32::from(self.values.axi));
        let flip_flops = lanes * (5 + 15) + 2 * lane_bits + 4 + 4 * axi;
        let luts = self.of([14, 150, 27]) + lanes * self.of([60, 60, 43]) + self.chosen(5);
        self.entity("engine_control", flip_flops, &[], &[], luts).holding(vec![self.admission(), self.stop()])
    }

    /// Which lane is next, and states.
    fn admission(&self) -> Entity {
        let (lanes, lane_bits, axi) =
            (self.design.params.queries, self.design.params.lane_bits(), u32::from(self.values.axi));
        let (flip_flops, luts) = (lanes + 2 * lane_bits + 11 + 5 * axi, lanes * self.of([15, 20, 12]));
        self.entity("engine_admission", flip_flops, &[], &[], luts).holding(vec![self.check()])
    }

    /// Bases, counts and a limit; what caches have is compared with what a query is about.
    fn check(&self) -> Entity {
        let axi = u32::from(self.values.axi);
        let luts = self.of([135, 20, 24]) + axi * self.of([176, 116, 245]);
        let ends = if self.fabric.chains == Chains::Complete { (4, 32) } else { (1, 32) };
        self.entity("engine_check", 9 * 32 + 5 + 5 * axi, &[], &[(4, 33), ends], luts)
    }

    /// Numbers, each compared with that of a stop.
    fn stop(&self) -> Entity {
        let lanes = self.design.params.queries;
        let luts = self.of([44, 60, 37]) + lanes * self.of([50, 80, 45]) + self.chosen(24);
        self.entity("engine_stop", lanes * (24 + 4) + 4 + self.design.params.lane_bits(), &[], &[], luts)
    }

    /// The words of queries for each of their readers; entries of the matrix are cut off and saturated.
    fn queries(&self) -> Entity {
        let (lanes, format) = (self.design.params.queries, &self.design.format);
        let (entries, rows) = (9 * format.origin_bits, format.rows() * self.values.query.row_bits);
        let (shift, errors) = (3 * format.widths().translation.bits(), 3 * format.shift_error_bits());
        let in_place = [entries, shift, errors, rows].map(|bits| (InPlace, ROWS, bits));
        let apart = [64, 64, 64 * format.pose_words].map(|bits| (Apart, ROWS, bits));
        let registered = [5 * 64, 4 * 32].map(|bits| (RegisteredInPlace, ROWS, bits));
        // Of the longest entries Yosys makes trees of the ECP5's wide multiplexers.
        let trees = if format.origin_bits > 16 { self.of([0, 8 * entries, 0]) } else { 0 };
        let luts = self.of([250, 181 + 17 * format.rows(), 235]) + trees;
        let written = if self.values.traversal.paced { 1 + self.design.params.lane_bits() } else { 0 };
        self.entity(
            "engine_queries",
            3 * lanes + written + 2 * 9,
            &[in_place.as_slice(), &apart, &registered].concat(),
            &[],
            luts,
        )
    }

    /// Registers of the lanes that end.
    fn traverse(&self) -> Entity {
        let parts = vec![self.issue(), self.flight(), self.survivors()];
        self.entity("engine_traverse", self.design.params.queries, &[], &[], 0).holding(parts)
    }

    /// Room of both kinds, pairs in flight and expansions that are left.
    fn lane(&self) -> Entity {
        let t = &self.values.traversal;
        let flip_flops = t.room_bits + t.pair_room_bits + t.flight_bits + 60;
        let sums = self.of([3, 2, 3]);
        let chains = [(1, 32), (sums, t.room_bits), (sums, t.pair_room_bits), (2, t.flight_bits + 2)];
        let luts = (13 * t.room_bits + 14 * t.pair_room_bits) / 3 + 4 * (t.flight_bits + 2) + t.entry_bits;
        self.entity("engine_lane", flip_flops, &[], &chains, luts + 80).holding(vec![self.stack()])
    }

    /// The lane that was chosen, the pair whose blocks are asked for, and what flies.
    fn issue(&self) -> Entity {
        let (params, t) = (&self.design.params, &self.values.traversal);
        let (lanes, lane, flight) = (params.queries, params.lane_bits(), t.flight_bits);
        let flip_flops = lanes + 2 * params.block_number_bits + 3 * lane + 13 + 2 * flight + 16 - u32::from(t.paced);
        let chains = [(1, 32), (4, flight + 2)];
        let bits = t.entry_bits + 16;
        // The top of a stack is chosen among more lanes than a table has inputs for.
        let luts = self.of([148, 171, 120]) + self.chosen(bits) + u32::from(lanes > 4) * 7 * bits / 2;
        self.entity("engine_issue", flip_flops, &[], &chains, luts).holding(vec![self.lane().times(lanes)])
    }

    /// Places in flight, and the children of the blocks.
    fn flight(&self) -> Entity {
        let (params, t) = (&self.design.params, &self.values.traversal);
        let (lanes, lane) = (params.queries, params.lane_bits());
        // Which children an entry has and the fault of a child are not read.
        let met = self.read_bits(t.entry_bits - 4, t.entry_bits);
        let flip_flops = 5 * t.flight_bits + 4 * lane + 43 + met + self.read_bits(4 * 29, 4 * 30) + lanes;
        let memories =
            [t.entry_bits, met, lane, lane, self.read_bits(116, 120), 12].map(|bits| (Apart, t.flight_places, bits));
        let own = self.entity("engine_flight", flip_flops, &memories, &[(4, t.flight_bits)], 60);
        own.holding(vec![self.children().times(2)])
    }

    /// Both queues of survivors, and those that are pushed and sent.
    fn survivors(&self) -> Entity {
        let (params, t) = (&self.design.params, &self.values.traversal);
        let (lane, node, entry, flight) = (params.lane_bits(), params.block_number_bits, t.entry_bits, t.flight_bits);
        let (child, level) = (node + 1, entry - 2 * node - 4);
        // Nor are bits that the number of a block has not: whole cells of them are left out.
        let (cell, unread) = (self.fabric.memory_cell.1, 31 - child);
        let whole = (unread + 1).saturating_sub(cell) / cell * cell;
        let record = self.read_bits(entry + 4 * child + 1, entry + 125 - 4 * whole);
        let queues = 2 * (3 * flight + 2) + lane + 119;
        let pushed = 3 * lane + 18 + (entry - 4) + 4 * child + 2 * child + 2 * node + level;
        let memories = [record, lane, 116, lane].map(|bits| (Apart, t.flight_places, bits));
        let luts = self.of([314, 369, 305]) + 8 * node;
        self.entity("engine_survivors", queues + pushed, &memories, &[(4, flight), (4, flight + 1)], luts)
    }

    /// Links and the number of a block; its codes and its tag, which are compared in parts.
    fn children(&self) -> Entity {
        let (blocks, node) = (&self.values.blocks, self.design.params.block_number_bits);
        let [codes, parts_of_code, tags] =
            [blocks.code_count, blocks.code_parts, blocks.block_tag_parts.len()].map(|count| count as u32);
        let parts = (codes * parts_of_code + tags) * self.compared(4);
        let luts = self.of([190, 33, 136])
            + node * self.of([3, 0, 3]) / 4
            + parts
            + (codes * parts_of_code + tags) * self.of([5, 5, 4]) / 16;
        // Two or three bits are compared in a table.
        let chains = match self.of([2, 1, 3]) {
            1 => [(4, 31), (2, 31)],
            bits => [(4, 31u32.div_ceil(bits) + 1), (2, (node + 4) / bits + 1)],
        };
        self.entity("engine_children", 2 * 32 + node + codes * (parts_of_code + 1) + tags + 4, &[], &chains, luts)
    }

    /// Four entries, and places.
    fn stack(&self) -> Entity {
        let (entry, places, place) =
            (self.values.traversal.entry_bits, self.values.traversal.stack_places, self.values.traversal.stack_bits);
        let luts = entry * self.of([3, 3, 2]) + place * self.of([5, 12, 5]) + self.of([10, 0, 9]);
        let compares = self.of([1, 7, 1]);
        let chains = [(1, place + 1), (2, place), (1, place * compares / 2 + 1)];
        let memory = (RegisteredInPlace, places, entry);
        self.entity("engine_stack", 4 * entry + 4 * place + 7, &[memory], &chains, luts)
    }

    /// For each lane the places of its queue, and the pairs that are asked for and not answered.
    fn pairs(&self) -> Entity {
        let (params, t) = (&self.design.params, &self.values.traversal);
        let (lanes, place, open) = (params.queries, t.pair_bits, t.open_bits);
        let flip_flops = lanes * (3 * place + open + 10) + 3 * params.lane_bits() + 2 * open + 9 + 2 * PAIR_BITS;
        let luts = self.of([2, 63, 17])
            + lanes * (place + 2 * open + self.of([37, 30, 29]))
            + 5 * open
            + self.chosen(2 * place);
        let chains = [(2 * lanes, place), (lanes, place + 1), (lanes + 5, open)];
        self.entity("engine_pairs", flip_flops, &[(Registered, t.all_pairs, PAIR_BITS)], &chains, luts)
    }

    /// A memory of lines, or a cache for each of the two trees.
    fn memory_of(&self, lines: &Lines) -> Entity {
        let (place, words) = (lines.line_address_bits, lines.words_per_line);
        // The last word ends with the line.
        let last = lines.line_bits - (words - 1) * lines.word_bits;
        let bank = |i| (RegisteredInPlace, lines.lines, if i + 1 == words { last } else { lines.word_bits });
        let mut memories: Vec<Memory> = (0..words).map(bank).collect();
        if self.values.block_ram {
            // Both trees are read in one clock. Yosys keeps words of one of them on Virtex-II and the ECP5.
            let (flip_flops, luts) = (2 * place + 2, 32 + self.of([lines.line_bits, 2 * lines.line_bits, 0]));
            let kept = self.of([lines.line_bits, 2 * lines.word_bits + 21, 0]);
            return self.entity(lines.entity, flip_flops + kept, &memories, &[(2, place)], luts);
        }
        let (tags, returned) = (lines.tag_parts.len() as u32, lines.return_bits);
        memories.push((Registered, lines.lines, lines.tag_bits + 1));
        memories.push((Registered, lines.return_words, lines.word_bits));
        memories.push((Apart, lines.places, place + 1));
        let used = lines.used_number.high + 1;
        let flip_flops =
            5 * ADDRESS_BITS + lines.word_bits + 2 * place + 3 * returned + tags + 40 + words + lines.line_bits;
        let chains = [(1, ADDRESS_BITS), (1, place), (2, 5), (3, 4), (2, returned), (1, returned + 1)];
        let luts = self.of([182, 190, 169]) + 2 * words + 2 * tags + used;
        self.entity(lines.entity, flip_flops, &memories, &chains, luts).times(2)
    }

    /// Who asks, a word, and clocks without one.
    fn read_master(&self) -> Entity {
        let memory = &self.values.memory;
        let watchdog = u32::from(memory.watchdog > 0);
        let flip_flops = 58 + memory.memory_width + watchdog * (memory.watchdog_bits + 1);
        let chains = [(watchdog, memory.watchdog_bits), (2, 5), (1, 6), (1, 4)];
        let luts = self.of([109, 161, 72]) + watchdog * self.of([8, 10, 6]);
        self.entity("engine_read_master", flip_flops, &[(Apart, 32, 2)], &chains, luts)
    }

    fn engines(&self) -> Entity {
        let (params, engines) = (&self.design.params, &self.values.engines);
        let (count, place) = (params.engines, engines.answer_bits);
        let queue = (Registered, engines.answer_places, ANSWER_BITS);
        let queue = self.entity(
            "engines_queue",
            2 * place + 2 * (place + 1) + 1,
            &[queue],
            &[(2, place), (2, place + 1)],
            self.of([38, 54, 34]),
        );
        let gather = self.of([48, 56, 21]) + count * self.of([55, 55, 50]);
        let gather = self.entity("engines_gather", 94 + 4 * count, &[], &[(1, 3)], gather);
        let dispatch = self.of([165, 210, 156]) + 24 * count;
        let compared = self.of([5, 5, 8]);
        let dispatch = self.entity("engines_dispatch", 179 + 10 * count, &[], &[(count, compared)], dispatch);
        let mut parts = vec![dispatch, self.engine().times(count), gather.holding(vec![queue.times(count)])];
        if !engines.own_ports {
            let luts = self.of([21, 40, 0]) + count * self.of([32, 32, 29]);
            let memory = (Apart, engines.bursts, count + 4);
            let chains = [(2, engines.burst_bits), (1, engines.burst_bits + 1), (1, 4)];
            parts.push(self.entity("engines_memory", 63 + params.memory_width + 3 * count, &[memory], &chains, luts));
        }
        self.entity(self.design.top(), 0, &[], &[], 1).holding(parts)
    }

    fn by_number(&self) -> Entity {
        let (design, values) = (self.design, &self.values);
        let (axi, place) = (u32::from(values.axi), values.memory.memories[1].line_address_bits);
        let loads = 1 - axi;
        // A pose, bases and counts, two lines that are asked for; counts of what memory gives, or a word for it.
        let flip_flops = 64 * design.format.pose_words + 427 + 67 * axi + loads * (50 + 2 * place);
        let chains = [(2 + 2 * axi, 32), (2, 33), (2, ADDRESS_BITS), (self.of([4, 6, 4]), 17), (1, 7), (1, 4)];
        let luts = self.of([471, 375, 436]);
        let command = self.entity("engine_number_command", flip_flops, &[], &chains, luts);
        let mark = values.numbers.mark_bits;
        let chains = [(3, 32), (2, mark), (2, 4), (1, 3)];
        let memory = (Apart, 8, values.numbers.report_high + 1);
        let answer = self.entity("engine_number_answer", 198 + 2 * mark, &[memory], &chains, self.of([266, 635, 195]));
        let mut parts = vec![answer, command, self.memory_of(&values.memory.memories[1])];
        parts.extend(values.axi.then(|| self.read_master()));
        self.entity(NAME, u32::from(values.unit.paced), &[], &[], 33).holding(parts)
    }
}
