//! Nexus (CrossLink-NX), speed grade 9, that of the evaluation board: 18 x 18 multipliers with registers of their own.
//!
//! Cell delays are those of nextpnr-nexus 0.11.1 (Project Oxide, which takes them from the delays that the vendor's Radiant
//! annotates), read from its reports and SDF files for circuits of one adder, choice, product or memory each, the slow
//! corner: flip-flop 0.307 ns clock to output and no set-up, LUT4 0.213; CCU2 from operand to carry 0.316, 0.027 a bit and
//! 0.05 from one tile of eight bits to the next, 0.208 from carry to sum; WIDEFN9, two tables with a multiplexer, 0.276.
//! MULT18X18 takes 2.244 from operand to product, 0.365 to the register behind it, whose set-up is 0.566 and whose output
//! comes after 0.406. EBR gives a word after 1.84.
//! Nets took 0.25 to 1.0 ns in these circuits. In a whole design (the default one as scheduled for the ECP5 at 150 MHz, one
//! seed, 147.7 MHz) arrivals leave about 0.7 for a net with one load in the median, 2.9 for one with 64 or more, up to 5.6;
//! the longest path was a choice with 6.0 in its two nets. The model takes 1.5 a net and 3.0 for many loads. The nets into
//! and out of a multiplier took up to 3.8 together; the model takes 2.3 for the one behind it.
//!
//! What is on the part is what the router's database has: 32,256 tables and flip-flops, 4,032 cells of distributed memory of
//! six tables each, 84 EBR of 18 kbit and 56 multipliers. Its two large RAMs (LRAM) are left unused. The data sheet
//! (FPGA-DS-02049) was not at hand.
//!
//! `synth_nexus` (Yosys 0.23) leaves the registers of MULT18X18 and MULT9X9 unused; the flow of this project moves the
//! register behind a product there before it places (`verilog::product_registers`), and the model counts with it. A
//! product of at most 9 x 9 bits takes half of a multiplier; it is counted as one.
//!
//! Whether words are equal is told by a tree of tables.
//!
//! Not known: nets before placement; the set-up of resets (0.205) is taken to be none. No vendor tool was run.

use super::{Chains, Device, Fabric, Family, MULTIPLIER_BITS, MultiplierRegisters, Part, Resources};

/// Yosys 0.23, `synth_nexus -abc9`.
static FABRIC: Fabric = Fabric {
    // WIDEFN9 makes a function of five inputs of two tables.
    tables: &[0, 1, 1, 1, 1, 2],
    prices: &[0.0, 1.0, 1.0, 1.0, 1.0, 2.0],
    chains: Chains::Complete,
    // `-abc9` knows the delays of carry cells.
    chain_levels: 2,
    carry_cell: 2,
    // The carry in comes from a cell of its own.
    carry_entry: 1,
    shortest_sum: 4,
    shortest_product: 0,
    multiplier_registers: MultiplierRegisters::Product,
    longest_shift: 0,
    memory_cell: (16, 4, 6),
    // As on the ECP5; no engine was mapped for this part.
    one_place_bits: 4,
    deepest_table_memory: 32,
    guarded_block_rams: true,
};

/// The CrossLink-NX of the evaluation board, fastest speed grade.
pub(super) const LIFCL_40: Device = Device {
    name: "lifcl-40-9",
    family: Family::Nexus,
    part: Part { family: "LIFCL", device: "LIFCL-40", package: "CABGA400", speed: "-9" },
    capacity: Resources { multipliers: 56, luts: 32_256, memory_luts: 24_192, flip_flops: 32_256, carry: 32_256 },
    multipliers: 56,
    block_rams: 84,
    source: "nextpnr-nexus 0.11.1 (Project Oxide), nets after routing",
    multiplier: [MULTIPLIER_BITS; 2],
    adder: 0,
    fabric: &FABRIC,
    clock_to_output: 0.307,
    // 2.3 for the net behind it instead of 1.5.
    product_to_output: 0.406 + 0.8,
    tapped_line: None,
    setup: 0.0,
    lut: 0.213,
    wide_choice: None,
    net: 1.5,
    wide_net: 3.0,
    carry: 0.316 + 0.208,
    carry_bit: 0.027 + 0.05 / 8.0,
    far_multipliers: Some(1.0),
    // Net inside and set-up of the register behind the product.
    product: (2.244 + 0.365 + 0.566, 0.0),
    product_behind_register: 0.0,
};
