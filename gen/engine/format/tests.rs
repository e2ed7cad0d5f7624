//! Tests of the engine's options and formats.

use super::*;
use crate::params::{Memory, OFFSET_BITS};
use efsat_hardware::number::Upper;
use efsat_unit::params::{Method, ParamError, Transform};

fn format(change: impl FnOnce(&mut EngineParams)) -> Result<EngineFormat, ParamError> {
    let mut engine = EngineParams::default();
    change(&mut engine);
    engine.format(&Params::default())
}

#[test]
fn the_default_is_a_block_of_64_bytes_and_a_query_of_23_words() {
    let format = format(|_| {}).unwrap();
    let block = format.block();
    assert_eq!((block.bits, block.stride, block.origin_at, block.exponent_at), (512, 64, 64, 118));
    assert_eq!((block.tag_at, block.zeros_at, block.tag), (122, 138, 18 | 10 << 8 | 1 << 12));
    assert_eq!((block.code_at(0, 0), block.code_at(1, 0), block.code_at(1, 17)), (152, 332, 502));
    let triangle = format.triangle();
    assert_eq!((triangle.bits, triangle.stride, triangle.number_bits, triangle.lane), (320, 64, 28, 32));
    assert_eq!((format.query_words(), format.row_at(0), format.pose_words), (23, 14, 7));
    assert_eq!((format.choice_at(1), format.choice_at(2), format.rest_at(), format.rest_bits()), (15, 30, 45, 13));
    assert_eq!((format.grid_fraction(), format.product_shift(), format.origin_shift()), (22, 12, 5));
    assert_eq!((format.matrix_shift(), format.translation_shift(), format.factor_fraction()), (11, 6, 11));
    let widths = format.widths();
    let bits = [widths.origin, widths.translation, widths.distance, widths.base, widths.sum, widths.upper, widths.code];
    assert_eq!(bits.map(|width| width.bits()), [18, 26, 26, 28, 24, 28, 25]);
    assert_eq!(widths.gap.bits(), 29);
    assert_eq!(EngineParams::default().wide_limit(), 415);
}

#[test]
fn blocks_of_other_formats_are_powers_of_two() {
    let stride = |directions, offset_bits| {
        let engine = EngineParams { directions, offset_bits, ..EngineParams::default() };
        engine.format(&Params::default()).map(|format| format.block().stride)
    };
    assert_eq!(stride(Directions::Six, 8), Ok(32));
    assert_eq!(stride(Directions::Six, 10), Ok(64));
    assert_eq!(stride(Directions::Fourteen, 10), Ok(64));
    assert_eq!(stride(Directions::TwentySix, 9), Ok(128));
    let wide = Params { transform_width: 48, upper: Upper::Sticky, ..Params::default() };
    let format = EngineParams::default().format(&wide).unwrap();
    let triangle = format.triangle();
    assert_eq!((triangle.stride, triangle.number_bits, triangle.sticky_at), (128, 23, Some(23)));
    assert_eq!((format.pose_words, format.query_words()), (13, 29));
    // The greatest exponent reaches what a projection can be from an origin, whatever the bits of a code.
    for offset_bits in OFFSET_BITS {
        let (most, grid) = (f64::from((1 << (offset_bits - 1)) - 1), f64::from(offset_bits) + 12.0);
        assert!(most * 2f64.powf(15.0 - grid) > 3.0 * (1.0 + 2f64.powi(-17)));
    }
}

#[test]
fn every_option_outside_its_range_is_named() {
    type Change = fn(&mut EngineParams);
    let cases: [(Change, &str); 18] = [
        (|p| p.origin_bits = 23, "--origin-bits 23: expected 4 to 22"),
        (|p| p.offset_bits = 16, "--offset-bits 16: expected 4 to 15"),
        (|p| p.factor_bits = 3, "--factor-bits 3: expected 4 to 16"),
        (|p| p.expansion_clocks = 3, "--expansion-clocks 3: expected one of 1, 2, 4"),
        (|p| p.memory_width = 16, "--memory-width 16: expected one of 32, 64, 128, 256, 512"),
        (|p| p.pair_queue = 100, "--pair-queue 100: expected one of 16, 32, 64, 128, 256, 512, 1024"),
        (
            |p| (p.offset_bits, p.origin_bits) = (4, 18),
            "--origin-bits 18: expected at most 17, the bits of a code and 13: origins lie on the grid of codes",
        ),
        (
            |p| p.origin_bits = 8,
            "--origin-bits 8: expected more: the error of a shift would not fit its 16 bits (origin-bits, and \
             transform-width less int-bits, against offset-bits)",
        ),
        (
            |p| (p.directions, p.factor_bits, p.offset_bits) = (Directions::TwentySix, 15, 12),
            "--factor-bits 15: expected at most 12 with --directions 26 --offset-bits 12: a row of a query has 64 bits",
        ),
        (|p| p.stack = 97, "--stack 97: expected at least 3 x tree-height + 2 = 98"),
        (|p| p.in_flight = 0, "--in-flight 0: expected 1 to 64"),
        (|p| p.watchdog = (1 << 24) + 1, "--watchdog 16777217: expected 0 to 16777216"),
        (|p| p.axi_id_bits = 17, "--axi-id-bits 17: expected 0 to 16"),
        (
            |p| (p.memory, p.axi_id_bits) = (Memory::BlockRam, 1),
            "--axi-id-bits 1: expected --memory axi with it: block RAM has no read port",
        ),
        (
            |p| (p.memory, p.watchdog) = (Memory::BlockRam, 500),
            "--watchdog 500: expected --memory axi with it: block RAM has no read port",
        ),
        (
            |p| (p.memory, p.memory_width) = (Memory::BlockRam, 128),
            "--memory-width 128: expected --memory axi with it: block RAM has no read port",
        ),
        (|p| p.block_number_bits = 27, "--block-number-bits 27: expected at most 26: no more blocks have an address"),
        (
            |p| (p.memory, p.block_lines, p.block_number_bits) = (Memory::BlockRam, 1024, 9),
            "--block-number-bits 9: expected at least 10 for the 1024 blocks of --block-lines",
        ),
    ];
    for (change, message) in cases {
        assert_eq!(format(change).unwrap_err().to_string(), message);
    }
    let exact = Params::of(Method::Exact);
    let message = EngineParams::default().format(&exact).unwrap_err().to_string();
    assert!(
        message.starts_with("--truth given: expected snapped with --transform-width 26 in the engine"),
        "{message}"
    );
    let off = Params { transform: Transform::Off, ..Params::default() };
    let message = EngineParams::default().format(&off).unwrap_err().to_string();
    assert_eq!(message, "--transform off: expected on: the engine gives the unit both triangles in their own frames");
}

#[test]
fn orders_carry_a_number() {
    let format = format(|_| {}).unwrap();
    let stop = format.order(Command::Stop, 0xab_cdef);
    assert_eq!(stop, format.header(Command::Stop) | 0xab_cdef << 40);
    assert!(format.is_order(Command::Stop, stop) && !format.is_order(Command::Reset, stop));
    assert!(!format.is_order(Command::Stop, stop | 1 << 39));
}
