//! ECP5, speed grade 6.

use super::{Chains, Device, Fabric, Family, MultiplierRegisters, Part, Resources};

/// Yosys 0.23, `synth_ecp5`.
static FABRIC: Fabric = Fabric {
    // Wider functions are made of two, four and eight tables by multiplexers of their own (PFUMX, L6MUX21).
    tables: &[0, 1, 1, 1, 1, 2, 4],
    prices: &[0.0, 1.0, 1.0, 1.0, 1.0, 2.0, 4.0],
    chains: Chains::Complete,
    carry_cell: 2,
    shortest_sum: 4,
    shortest_comparison: 4,
    multiplier_registers: MultiplierRegisters::None,
    longest_shift: 0,
    memory_cell: (16, 4, 6),
};

/// The largest ECP5, slowest speed grade.
pub(super) const LFE5U_85: Device = Device {
    name: "lfe5u-85-6",
    family: Family::Ecp5,
    part: Part { family: "ECP5U", device: "LFE5U-85F", package: "CABGA756", speed: "-6" },
    capacity: Resources { multipliers: 156, luts: 83_640, memory_luts: 41_820, flip_flops: 83_640, carry: 83_640 },
    multipliers: 156,
    source: "nextpnr's timing data",
    fabric: &FABRIC,
    clock_to_output: 0.52,
    setup: 0.0,
    lut: 0.24,
    net: 1.3,
    wide_net: 2.0,
    carry: 0.45 + 0.44,
    carry_bit: 0.07 / 2.0,
    product: (4.0, 0.0),
};
