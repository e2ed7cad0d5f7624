//! 7-series, parts of speed grade 1: two of Artix-7, and the Zynq with its logic that many boards have.
//!
//! Cell delays are read from a Vivado timing report in a public student project (GitHub: constant619/EESM6000C-Lab3, a
//! Zynq xc7z020-1, whose logic is that of Artix-7): flip-flop 0.478 ns clock to output and less than nothing of set-up
//! (-0.076), LUT 0.124, CARRY4 from a table to its carry 0.533, 0.117 for every four bits more, 0.337 to the sum at the
//! end, DSP48E1 from operand to the cascade output 4.036. Nets are 0.8 ns before placement there; after routing they
//! are longer, so this model takes 1.0. What is on the part is from the family overview (DS180): 134,600 look-up
//! tables, 269,200 flip-flops, 740 multipliers (DSP48E1), 33,650 slices, 365 block RAMs of 36 kbit; on the smaller part
//! 63,400, 126,800, 240, 15,850 and 135. The Zynq has 53,200, 106,400, 220, 13,300 and 140 (DS190).
//!
//! Not known: DSP48E1 from operand to its own output (the cascade output is taken for it), and how its registers divide
//! the delay.

use super::{Device, Family, Part, Resources, fabric};

/// The largest Artix-7.
pub(super) const XC7A200T: Device = Device {
    name: "xc7a200t-1",
    family: Family::Series7,
    part: Part { family: "Artix7", device: "xc7a200t", package: "fbg676", speed: "-1" },
    capacity: Resources { multipliers: 740, luts: 134_600, memory_luts: 46_200, flip_flops: 269_200, carry: 134_600 },
    multipliers: 740,
    block_rams: 730,
    source: "public Vivado report for xc7z020-1",
    multiplier: [25, 18],
    adder: 48,
    fabric: &fabric::SIX_INPUTS,
    clock_to_output: 0.478,
    product_to_output: 0.478,
    tapped_line: None,
    setup: 0.1,
    lut: 0.124,
    wide_choice: None,
    net: 1.0,
    wide_net: 1.5,
    // Table, start of the chain, sum at its end.
    carry: 0.124 + 0.533 + 0.337,
    carry_bit: 0.117 / 4.0,
    far_multipliers: None,
    product: (4.036, 0.0),
    product_behind_register: 1.5,
};

/// That of the board Arty A7-100T.
pub(super) const XC7A100T: Device = Device {
    name: "xc7a100t-1",
    part: Part { device: "xc7a100t", package: "csg324", ..XC7A200T.part },
    capacity: Resources { multipliers: 240, luts: 63_400, memory_luts: 19_000, flip_flops: 126_800, carry: 63_400 },
    multipliers: 240,
    block_rams: 270,
    ..XC7A200T
};

/// That of the boards PYNQ-Z2 and Zybo Z7-20.
pub(super) const XC7Z020: Device = Device {
    name: "xc7z020-1",
    part: Part { family: "Zynq", device: "xc7z020", package: "clg400", ..XC7A200T.part },
    capacity: Resources { multipliers: 220, luts: 53_200, memory_luts: 17_400, flip_flops: 106_400, carry: 53_200 },
    multipliers: 220,
    block_rams: 280,
    ..XC7A200T
};
