//! Tests of the engine's reference model.

use super::*;
use crate::format::EngineFormat;
use crate::params::EngineParams;
use efsat_geometry::directions::Directions;
use efsat_unit::params::Params;
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

/// With 4-bit codes and factors: U is the least whole number not below the sum of its row, for every factor, code and exponent.
#[test]
fn bounds_of_rows_are_rounded_up() {
    let engine = EngineParams {
        directions: Directions::Six,
        origin_bits: 10,
        offset_bits: 4,
        factor_bits: 4,
        ..EngineParams::default()
    };
    let format = engine.format(&Params::default()).unwrap();
    let none = [0; 6];
    for (factor, rest) in (0..16).flat_map(|factor| (0..8).map(move |rest| (factor, rest))) {
        let row = QueryRow { terms: [(0, factor), (0, 0), (0, 0)], rest };
        let frame = Frame { matrix: [[0; 3]; 3], shift: [0; 3], errors: [0; 3], rows: vec![row; 3] };
        for (code, exponent) in (-7..=7).flat_map(|code| (0..16).map(move |exponent| (code, exponent))) {
            let codes = [code; 6];
            let (a, b) = (Volume { exponent: 0, codes: &none }, Volume { exponent, codes: &codes });
            let [base, upper, _] = bounds(0, &[0; 3], &frame, &a, &b, &format);
            // In steps of 2^-3.
            let sum = (i64::from(factor) * i64::from(code) + i64::from(rest)) << exponent;
            assert!(base == 0 && 8 * upper >= sum && 8 * (upper - 1) < sum, "{factor} {code} {rest} {exponent}");
        }
    }
}
