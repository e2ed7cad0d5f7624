//! Tests of the engine's reference model.

use super::*;
use crate::params::{EngineFormat, EngineParams, Params};
use efsat_geometry::directions::Directions;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

fn formats() -> Vec<EngineFormat> {
    let make = |directions, origin_bits, offset_bits, factor_bits| {
        let engine = EngineParams { directions, origin_bits, offset_bits, factor_bits, ..EngineParams::default() };
        engine.format(&Params::default()).unwrap()
    };
    vec![
        make(Directions::Eighteen, 18, 10, 12),
        make(Directions::Six, 12, 6, 6),
        make(Directions::Fourteen, 15, 9, 11),
        make(Directions::TwentySix, 22, 14, 11),
    ]
}

fn random_block(rng: &mut ChaCha8Rng, format: &EngineFormat) -> Block {
    let (origin, most) = (format.most_origin(), format.most());
    let mut link = || match rng.random_range(0..3) {
        0 => Link::None,
        1 => Link::Leaf(rng.random_range(0..1 << 28)),
        _ => Link::Inner(rng.random_range(0..1 << 28)),
    };
    let links = [link(), link()];
    Block {
        links,
        origin: [0; 3].map(|_| rng.random_range(-origin..=origin)),
        exponent: rng.random_range(0..16),
        codes: [0; 2].map(|_| (0..format.k()).map(|_| rng.random_range(-most..=most)).collect()),
    }
}

#[test]
fn blocks_are_read_as_they_were_written() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    for format in formats() {
        for _ in 0..200 {
            let block = random_block(&mut rng, &format);
            let words = block.words(&format);
            assert_eq!(words.len() * 8, format.block().stride as usize);
            assert_eq!(Block::of(&words, &format), Ok(block));
        }
    }
}

#[test]
fn blocks_of_no_tree_are_refused() {
    let format = formats()[0];
    let block = random_block(&mut ChaCha8Rng::seed_from_u64(2), &format);
    let with = |change: fn(&mut Vec<u64>)| {
        let mut words = block.words(&format);
        change(&mut words);
        Block::of(&words, &format).unwrap_err().to_string()
    };
    assert_eq!(with(|w| w[1] ^= 1 << 58), "tag 0x1a13: expected 0x1a12");
    assert_eq!(with(|w| w[2] |= 1 << 23), "bits 138 to 151 not all zero: expected zeros");
    let message = "code 0 of child 0: -512: expected at least -511";
    assert_eq!(with(|w| w[2] = w[2] & !(0x3ff << 24) | 0x200 << 24), message);
}
