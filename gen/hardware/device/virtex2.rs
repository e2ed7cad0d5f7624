//! Virtex-II, speed grade 4: the part of the paper.
//!
//! Every delay is read from XST 10.1.03 synthesis reports for xc2v6000-4 (speed data PRODUCTION 1.121, stepping 0) that
//! stand in public student projects of MIT 6.111 (GitHub: lycarter/6.111-finalproj, mhollands/6.111-final-project,
//! plancherb1/6.111-Final-Project and others); the same element has the same figure in all of them. What is on the part
//! is read from their utilisation tables: 33,792 slices, 67,584 look-up tables and flip-flops, 144 multipliers and as many
//! block RAMs of 18 kbit.
//!
//! Not known from any public report: set-up and clock-to-output of the registered multiplier MULT18X18S, and MUXCY from
//! DI to its output (see [`delay::CARRY_DATA`]). The model divides the combinational delay of 10.4 ns: 3.0 behind the
//! register, the rest before it. At 100 MHz the default design's schedule holds for any division with 1.8 to 4.0 ns
//! behind it: operands come straight from registers, and a sum of two products follows.

use super::{Chains, Device, Fabric, Family, MULTIPLIER_BITS, MultiplierRegisters, Part, Resources};

/// Delays of single elements, nanoseconds, for the static timing estimate.
pub mod delay {
    /// Flip-flop, clock to output.
    pub const CLOCK_TO_OUTPUT: f64 = 0.568;
    /// Flip-flop, set-up of data.
    pub const SETUP: f64 = 0.370;
    /// Flip-flop, set-up of the enable.
    pub const ENABLE_SETUP: f64 = 0.240;
    /// Flip-flop, set-up of synchronous set and reset.
    pub const RESET_SETUP: f64 = 0.280;
    /// Look-up table and inverter.
    pub const LUT: f64 = 0.439;
    /// MUXCY from its select input to the next bit.
    pub const CARRY_START: f64 = 0.298;
    /// MUXCY from its select input to a net that leaves the chain.
    pub const CARRY_START_LEAVING: f64 = 1.187;
    /// MUXCY from carry to the next bit.
    pub const CARRY: f64 = 0.053;
    /// MUXCY from carry to a net that leaves the chain.
    pub const CARRY_LEAVING: f64 = 0.942;
    /// MUXCY from DI: in no report, although every operand of an adder has this way beside the one through its table. It
    /// is therefore taken to be no longer than that one, 0.439 + 0.298.
    pub const CARRY_DATA: f64 = 0.737;
    /// XORCY from carry.
    pub const SUM: f64 = 1.274;
    /// XORCY from its look-up table.
    pub const SUM_FROM_LUT: f64 = 0.684;
    /// MUXF5 from data and from select.
    pub const WIDE: (f64, f64) = (0.436, 0.699);
    /// MUXF6 to MUXF8 from data and from select.
    pub const WIDER: (f64, f64) = (0.447, 0.570);
    /// SRL16, clock to output.
    pub const SHIFT_CLOCK_TO_OUTPUT: f64 = 2.901;
    /// MULT18X18 from either operand to bit k of the product: the first and k times the second. Exact for the ten bits
    /// reported (7 to 28); bit 35 (10.356 ns) is the line continued.
    pub const PRODUCT: (f64, f64) = (3.111, 0.207);

    /// A net by its number of loads, as XST estimates it before placement: a fit to 376 nets of the same reports, on
    /// average 6 % above them, nine in ten within -16 and +18 %.
    pub fn net(loads: usize) -> f64 {
        match loads {
            0 | 1 => 0.61,
            2..=3 => 0.83,
            4..=8 => 0.93,
            9..=20 => 1.1,
            n => 1.25 + 0.0025 * (n as f64 - 20.0),
        }
    }
}

/// Yosys 0.23, `synth_xilinx -family xc2v -nowidelut`.
static FABRIC: Fabric = Fabric {
    tables: &[0, 1, 1, 1, 1],
    prices: &[0.0, 1.0, 1.0, 1.0, 1.0],
    chains: Chains::WithTables,
    chain_levels: 0,
    carry_cell: 1,
    carry_entry: 0,
    shortest_sum: 2,
    shortest_product: super::SHORTEST_PRODUCT,
    multiplier_registers: MultiplierRegisters::Product,
    longest_shift: 16,
    memory_cell: (16, 1, 2),
    one_place_bits: 2,
    deepest_table_memory: 16,
    guarded_block_rams: false,
};

/// The paper's part.
pub(super) const XC2V6000: Device = Device {
    name: "xc2v6000-4",
    family: Family::Virtex2,
    part: Part { family: "Virtex2", device: "xc2v6000", package: "bf957", speed: "-4" },
    capacity: Resources { multipliers: 144, luts: 67_584, memory_luts: 67_584, flip_flops: 67_584, carry: 67_584 },
    multipliers: 144,
    block_rams: 144,
    source: "public XST 10.1.03 reports for xc2v6000-4",
    multiplier: [MULTIPLIER_BITS; 2],
    adder: 0,
    fabric: &FABRIC,
    clock_to_output: delay::CLOCK_TO_OUTPUT,
    product_to_output: delay::CLOCK_TO_OUTPUT,
    tapped_line: Some(delay::SHIFT_CLOCK_TO_OUTPUT),
    setup: delay::SETUP,
    lut: delay::LUT,
    wide_choice: None,
    net: 0.83,
    wide_net: 1.5,
    // Table, start of the chain, exclusive disjunction at its end.
    carry: delay::LUT + delay::CARRY_START + delay::SUM,
    carry_bit: delay::CARRY,
    far_multipliers: None,
    product: delay::PRODUCT,
    product_behind_register: 3.0,
};
