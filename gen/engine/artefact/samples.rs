//! The vector file of a generated engine: small meshes, and queries of every kind.

use super::vectors::EngineVectors;
use super::{EngineDesign, by_number};
use crate::host::{Header, Image, Numbers, TRIANGLES_AT};
use crate::model::Query;
use crate::params::{EngineParams, Memory};
use crate::words::{Command, Reason};
use efsat_unit::pair::Pair;
use efsat_unit::params::ParamError;

pub use super::meshes::{cuboid, hills, turn};

/// Queries of every kind over two meshes that cross each other, and packets that are none.
///
/// # Errors
/// If the meshes are too large for the memory, or their trees for the stack.
pub fn text(design: &EngineDesign) -> Result<String, ParamError> {
    if design.by_number {
        return by_number::samples(design);
    }
    let numbers =
        Numbers::new(&design.params, &design.unit.params).expect("parameters of a design are in their ranges");
    let meshes = [hills(6), cuboid(3, 4, 2)];
    let images = Image::build(&[&meshes[0], &meshes[1]], &design.format).expect("small meshes");
    let images: Vec<&Image> = images.iter().collect();
    let params = &design.params;
    let sum = |of: fn(&Header) -> u32| images.iter().map(|image| of(image.header())).sum::<u32>();
    let height = images.iter().map(|image| image.header().height).max().unwrap_or(0);
    let block_ram = params.memory == Memory::BlockRam;
    let needs = [
        ("block-lines", params.block_lines, if block_ram { sum(|header| header.blocks) } else { 0 }),
        ("triangle-lines", params.triangle_lines, if block_ram { sum(|header| header.triangles) } else { 0 }),
        ("tree-height", params.tree_height, height),
    ];
    if let Some((option, found, least)) = needs.into_iter().find(|(_, found, least)| found < least) {
        let legal = format!("expected at least {least}, which the meshes of the testbench take");
        return Err(ParamError { option, found: found.to_string(), legal });
    }
    let mut vectors = EngineVectors::new(design, &images);
    let sides = [0, 1].map(|i| vectors.side(i));
    let make = |a: usize, b: usize, axis: usize, t: [f64; 3]| {
        numbers
            .query([(images[a], sides[a]), (images[b], sides[b])], &turn(axis), &t)
            .expect("a pose inside the ranges")
    };
    let crossing = Query { number: 1, ..make(0, 1, 2, [2.5, 1.0, -1.0]) };
    // Pairs and poses between the queries: as after reset, under a pose of their own, under that of a query.
    let segments = vectors.random_pairs(48, 7);
    let pairs: Vec<Pair> = segments.iter().flat_map(|(_, pairs)| pairs).copied().collect();
    vectors.pairs(&pairs[..3]);
    vectors.pose(&segments[0].0);
    vectors.pairs(&pairs[..12]);
    vectors.pairs(&pairs[12..13]);
    vectors.query(&crossing);
    vectors.pairs(&pairs[16..20]);
    vectors.pose(&segments[1].0);
    vectors.query(&Query { number: 2, ..make(1, 0, 0, [-1.0, 2.0, 0.5]) });
    vectors.query(&Query { number: 3, ..make(0, 0, 1, [0.5, 0.0, 3.0]) });
    // Apart; the same object twice; answers for separate pairs, and without the unit.
    vectors.query(&Query { number: 4, ..make(0, 1, 0, [0.0, 0.0, 9.0]) });
    vectors.query(&Query { number: 5, ..make(1, 1, 2, [0.0, 0.0, 0.0]) });
    vectors.query(&Query { number: 6, all_pairs: true, ..crossing.clone() });
    vectors.query(&Query { number: 7, leaf_pairs: true, keep_caches: true, ..crossing.clone() });
    vectors.pairs(&pairs[20..23]);
    vectors.pose(&segments[1].0);
    vectors.pairs(&pairs[23..26]);
    // Ends of every kind.
    vectors.query(&Query { number: 8, first_contact: true, keep_caches: true, ..crossing.clone() });
    vectors.pairs(&pairs[..2]);
    vectors.query(&Query { number: 9, limit: 5, ..crossing.clone() });
    vectors.unusual_pairs(&pairs[0], &segments[2].0);
    vectors.pairs(&pairs[2..5]);
    vectors.query(&Query { number: 0xab_cdef, ..crossing.clone() });
    let words = crossing.words(&design.format);
    let whole = |words: &[u64]| words.iter().map(|&word| (word, true)).collect::<Vec<_>>();
    vectors.malformed(&whole(&[0]), Reason::UnknownHeader);
    vectors.malformed(&whole(&[vec![words[0] ^ 1 << 8], words[1..].to_vec()].concat()), Reason::UnknownHeader);
    vectors.malformed(&whole(&[vec![words[0] ^ 1 << 40], words[1..].to_vec()].concat()), Reason::UnknownHeader);
    vectors.malformed(&whole(&words[..1]), Reason::TooShort);
    vectors.malformed(&whole(&words[..words.len() - 1]), Reason::TooShort);
    vectors.malformed(&whole(&[words.clone(), vec![0]].concat()), Reason::TooLong);
    vectors.malformed(&whole(&[design.format.order(Command::Stop, 7), 0]), Reason::TooLong);
    vectors.malformed(&whole(&[design.format.order(Command::Reset, 7), 0]), Reason::TooLong);
    vectors.malformed(&whole(&[design.format.order(Command::Stop, 7) | 1 << 32]), Reason::UnknownHeader);
    vectors.malformed(&whole(&[design.format.order(Command::Reset, 7) | 1 << 39]), Reason::UnknownHeader);
    if design.params.memory == Memory::BlockRam {
        refused_loads(&mut vectors, design);
    }
    let with = |place: usize, change: &dyn Fn(&mut (u64, bool))| {
        let mut changed = whole(&words);
        change(&mut changed[place]);
        changed
    };
    let row = design.format.row_at(design.format.rows() - 1) as usize;
    vectors.malformed(&with(3, &|word| word.1 = false), Reason::TooShort);
    vectors.malformed(&with(0, &|word| word.1 = false), Reason::UnknownHeader);
    vectors.malformed(&with(5, &|word| word.0 |= 1 << 36), Reason::UnknownHeader);
    vectors.malformed(&with(7, &|word| word.0 |= 1 << 31), Reason::UnknownHeader);
    let spare = design.format.rest_at() + design.format.rest_bits();
    if spare < u64::BITS {
        vectors.malformed(&with(row, &|word| word.0 |= 1 << 63), Reason::UnknownHeader);
        let first = design.format.row_at(0) as usize;
        vectors.malformed(&with(first, &|word| word.0 |= 1 << spare), Reason::UnknownHeader);
    }
    let slots = design.format.directions.slots();
    if let Some(slot) = slots.iter().position(|slot| slot.len() < 1 << design.format.choice_bits()) {
        let choice = (slots[slot].len() as u64) << design.format.choice_at(slot as u32);
        let mask = ((1u64 << design.format.choice_bits()) - 1) << design.format.choice_at(slot as u32);
        vectors.malformed(&with(row, &|word| word.0 = word.0 & !mask | choice), Reason::UnknownHeader);
    }
    // Trees that are none; ranges beyond the end of memory.
    let damaged = |number: u32, change: &dyn Fn(&mut Query)| {
        let mut query = Query { number, ..crossing.clone() };
        change(&mut query);
        query
    };
    vectors.query(&damaged(10, &|query| query.sides[0].blocks = 0));
    vectors.query(&damaged(11, &|query| query.sides[0].blocks -= 30));
    vectors.query(&damaged(12, &|query| query.sides[1].triangles = 3));
    vectors.query(&Query { number: 13, ..crossing.clone() });
    // A stop without a query does nothing.
    vectors.wait();
    vectors.stop(40, 14);
    vectors.query(&Query { number: 14, ..make(1, 0, 1, [1.0, 1.0, 1.0]) });
    // Soft resets: while nothing is to be done, while a query runs and others wait, in the midst of answers.
    vectors.wait();
    vectors.reset(40, Some(15));
    vectors.pairs(&pairs[5..7]);
    for clocks in [150, 600, 1000, 1500] {
        vectors.query(&Query { number: 16, ..crossing.clone() });
        vectors.query(&Query { number: 17, ..crossing.clone() });
        vectors.reset(clocks, (clocks < 1000).then_some(clocks));
        vectors.query(&Query { number: 18, ..crossing.clone() });
    }
    Ok(vectors.text().to_owned())
}

/// Loads that write nothing: addresses that are none, and those from the first behind each memory to the last there is.
fn refused_loads(vectors: &mut EngineVectors<'_>, design: &EngineDesign) {
    let mut load = |rest: &[u64], reason| vectors.refused_load(rest, reason);
    let EngineParams { block_lines, triangle_lines, .. } = design.params;
    let larger = block_lines.max(triangle_lines).next_power_of_two();
    for (memory, lines) in [(0, block_lines), (TRIANGLES_AT, triangle_lines)] {
        for line in [lines, larger, 2 * larger, TRIANGLES_AT - 1] {
            let address = u64::from(memory + line) << 6;
            load(&[address, 0, 0, 0, 0, 0, 0, 0, 0], Reason::TooLong);
        }
    }
    load(&[8, 0], Reason::UnknownHeader);
    load(&[1 << 32, 0], Reason::UnknownHeader);
    load(&[0], Reason::TooShort);
    load(&[], Reason::TooShort);
}
