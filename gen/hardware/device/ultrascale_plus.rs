//! UltraScale+, speed grade 1: the Zynq of the boards Ultra96 and its like.
//!
//! Cell delays are read from routed Vivado 2021.2 reports for an xczu3eg-sbva484-1 in a public research repository (GitHub:
//! gussmith23/lakeroad-evaluation): flip-flop 0.097 ns clock to output, 0.035 of clock uncertainty and less than nothing of
//! set-up (0.027), LUT 0.04 to 0.18 by pin and taken as 0.18; CARRY8 from a table to its carry 0.238, 0.023 and a net of 0.028 for every
//! eight bits more, 0.146 to the sum at the end; DSP48E2 from operand through multiplier (1.083) and adder (0.699) to its own
//! output (0.141). Nets took 0.1 to 0.5 ns there, one of 88 loads 0.7; those designs are small, and the model takes 0.5
//! and 0.9. What is on the part is from the family overview (DS891): 70,560 look-up tables, 141,120 flip-flops, 360
//! multipliers (DSP48E2), 216 block RAMs of 36 kbit, 1.8 Mbit of memory in tables.
//!
//! Not known: clock to output of the multiplier's inner register, taken as that of a flip-flop. Yosys 0.23 leaves registers
//! out of DSP48E2 and makes chains of four bits; the model counts the registers that the multiplier has.

use super::{Device, Family, Part, Resources, fabric};

/// Zynq UltraScale+ with 154,000 logic cells.
pub(super) const XCZU3EG: Device = Device {
    name: "xczu3eg-1",
    family: Family::UltraScalePlus,
    part: Part { family: "Zynquplus", device: "xczu3eg", package: "-sbva484", speed: "-1-e" },
    capacity: Resources { multipliers: 360, luts: 70_560, memory_luts: 28_800, flip_flops: 141_120, carry: 70_560 },
    multipliers: 360,
    block_rams: 432,
    source: "public routed Vivado reports for xczu3eg-1",
    multiplier: [27, 18],
    adder: 48,
    fabric: &fabric::SIX_INPUTS,
    clock_to_output: 0.097,
    product_to_output: 0.097,
    tapped_line: None,
    setup: 0.04,
    lut: 0.18,
    wide_choice: None,
    net: 0.5,
    wide_net: 0.9,
    // Table, start of the chain, sum at its end.
    carry: 0.18 + 0.238 + 0.146,
    carry_bit: (0.023 + 0.028) / 8.0,
    far_multipliers: None,
    // From operand to output; the adder and what follows it are behind the register.
    product: (0.195 + 0.092 + 0.737 + 0.059 + 0.699 + 0.141, 0.0),
    product_behind_register: 0.699 + 0.141,
};
