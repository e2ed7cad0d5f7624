//! Spartan-6, speed grade 3.
//!
//! The delays are estimates after the data sheet (DS162) and reports of XST; none of them was checked by a run of the
//! vendor's tools. What is on the part is from the family overview (DS160): 92,152 look-up tables, 184,304 flip-flops,
//! 180 multipliers (DSP48A1), 23,038 slices, 268 block RAMs of 18 kbit. Not known: how DS162's set-up and clock-to-output
//! of the multiplier's registers divide its delay; a product takes registers for the delay without them.

use super::{Device, Family, MULTIPLIER_BITS, Part, Resources, fabric};

/// The largest of the family.
pub(super) const XC6SLX150: Device = Device {
    name: "xc6slx150-3",
    family: Family::Spartan6,
    part: Part { family: "Spartan6", device: "xc6slx150", package: "fgg676", speed: "-3" },
    capacity: Resources { multipliers: 180, luts: 92_152, memory_luts: 21_680, flip_flops: 184_304, carry: 46_076 },
    multipliers: 180,
    block_rams: 268,
    source: "estimated after the Spartan-6 data sheet",
    multiplier: [MULTIPLIER_BITS; 2],
    adder: 0,
    fabric: &fabric::SIX_INPUTS,
    clock_to_output: 0.45,
    product_to_output: 0.45,
    tapped_line: None,
    setup: 0.40,
    lut: 0.21,
    wide_choice: None,
    net: 0.85,
    wide_net: 1.3,
    carry: 0.70,
    carry_bit: 0.025,
    far_multipliers: None,
    product: (3.2, 0.03),
    product_behind_register: 1.5,
};
