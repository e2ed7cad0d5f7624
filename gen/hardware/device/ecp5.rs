//! ECP5, speed grade 6 (the slowest): the open relative of Virtex-II, with 18 x 18 multipliers of its own.
//!
//! Cell delays are those of nextpnr-ecp5 0.11.1 (Project Trellis' timing data), read from its reports: flip-flop 0.52 ns
//! clock to output and no set-up, LUT4 0.24, CCU2C from operand to carry 0.45, 0.07 for every cell of two bits, 0.44
//! from carry to sum; MULT18X18D 3.93 from operand to product, or with a register behind the product 3.49 of set-up and
//! 0.74 to its output. PFUMX (0.17) makes two tables one of five inputs, L6MUX21 (0.24 each) those of six and seven, which
//! reach a flip-flop by a net; a choice among 11 legs ended in one of seven, 0.65, which the model takes for every choice.
//! Nets take 0.1 to 1.5 ns in small units. In whole designs such a choice, by lines with many loads, took 5.1 to 7.6 ns in
//! its nets; the model takes 1.5 a net and 3.0 for many loads, 7.5 together. Behind a multiplier, which lies in a column of
//! its own, nets on the critical path took 3.2 to 4.2 ns; the model takes 4.2. What is on the part is from the family's
//! data sheet (FPGA-DS-02012).
//!
//! `synth_ecp5` (Yosys 0.23) leaves the registers of MULT18X18D unused; the flow of this project moves the register
//! behind a product there before it places (`verilog::product_registers`), and the model counts with it.
//!
//! Whether words are equal is told by a tree of tables.
//!
//! Not known: nets before placement; the set-up of enables and resets (0.42 ns in one report), taken to be none. No
//! vendor tool was run.

use super::{Chains, Device, Fabric, Family, MULTIPLIER_BITS, MultiplierRegisters, Part, Resources, WideChoice};

/// Yosys 0.23, `synth_ecp5 -abc9`.
static FABRIC: Fabric = Fabric {
    // Wider functions are made of two, four and eight tables by multiplexers of their own (PFUMX, L6MUX21).
    tables: &[0, 1, 1, 1, 1, 2, 4],
    prices: &[0.0, 1.0, 1.0, 1.0, 1.0, 2.0, 4.0],
    chains: Chains::Complete,
    // `-abc9` knows the delays of carry cells: 1.0 to 1.5 ns for a sum, 0.54 for a table with its net.
    chain_levels: 2,
    carry_cell: 2,
    carry_entry: 0,
    shortest_sum: 4,
    shortest_product: 0,
    multiplier_registers: MultiplierRegisters::Product,
    longest_shift: 0,
    memory_cell: (16, 4, 6),
    one_place_bits: 4,
    deepest_table_memory: 32,
    guarded_block_rams: true,
};

/// The largest ECP5, slowest speed grade.
pub(super) const LFE5U_85: Device = Device {
    name: "lfe5u-85-6",
    family: Family::Ecp5,
    part: Part { family: "ECP5U", device: "LFE5U-85F", package: "CABGA756", speed: "-6" },
    capacity: Resources { multipliers: 156, luts: 83_640, memory_luts: 41_820, flip_flops: 83_640, carry: 83_640 },
    multipliers: 156,
    block_rams: 208,
    source: "nextpnr-ecp5 0.11.1 (Project Trellis), nets after routing",
    multiplier: [MULTIPLIER_BITS; 2],
    adder: 0,
    fabric: &FABRIC,
    clock_to_output: 0.52,
    // 4.2 for the net behind it instead of 1.5.
    product_to_output: 0.74 + 2.7,
    tapped_line: None,
    setup: 0.0,
    lut: 0.24,
    // A table of seven inputs: PFUMX 0.17 and two of L6MUX21, 0.24 each.
    wide_choice: Some(WideChoice { legs: 4, multiplexers: 0.65 }),
    net: 1.5,
    wide_net: 3.0,
    carry: 0.45 + 0.44,
    carry_bit: 0.07 / 2.0,
    // 1.5 and this are the 5.4 ns that a routed cascade took to a multiplier.
    far_multipliers: Some(3.9),
    // Set-up of the register behind the product.
    product: (3.49, 0.0),
    product_behind_register: 0.0,
};
