//! How a family's logic is built and what open synthesis (Yosys) makes of it: what the prediction of parts counts by.

/// Look-up tables, carry chains and what else synthesis puts logic into.
#[derive(Clone, Debug, PartialEq)]
pub struct Fabric {
    /// Look-up tables that a function of i inputs takes, entry i; one entry more than a function may have inputs.
    pub tables: &'static [u64],
    /// What synthesis weighs such a function with.
    pub prices: &'static [f64],
    /// Kind of carry chain.
    pub chains: Chains,
    /// Tables in a row that take as long as a chain where mapping looks through chains; 0 where they end its paths.
    pub chain_levels: u32,
    /// Bits in one carry cell.
    pub carry_cell: usize,
    /// Cells in front of a chain that only give it its carry in.
    pub carry_entry: usize,
    /// Sums of at most this many bits are made of look-up tables.
    pub shortest_sum: usize,
    /// Products of fewer bits are made of look-up tables.
    pub shortest_product: u32,
    /// Registers that a multiplier takes in.
    pub multiplier_registers: MultiplierRegisters,
    /// Clocks of delay that one look-up table makes; 0 if synthesis makes none so.
    pub longest_shift: usize,
    /// Distributed memory: words and bits of one cell, and the look-up tables it takes.
    pub memory_cell: (usize, u32, u64),
    /// Bits of such a cell that is read where it is written.
    pub one_place_bits: u32,
    /// Places up to which a memory whose output is a register is made of look-up tables, not of block RAM.
    pub deepest_table_memory: u32,
    /// Whether synthesis keeps what goes into a block RAM in registers, for a read of the place that is written.
    pub guarded_block_rams: bool,
}

/// Where the operands of a carry chain meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Chains {
    /// In look-up tables in front of the chain, which may compute more than the chain needs (Xilinx).
    WithTables,
    /// In the carry cell itself, whose tables are used up by it (ECP5, Nexus).
    Complete,
}

/// Registers around a product that are part of the multiplier.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MultiplierRegisters {
    /// The first register behind the product.
    Product,
    /// Two registers behind the product, and two in front of every operand.
    OperandsAndProduct,
}

/// Families with tables of six inputs: Yosys 0.23, `synth_xilinx -family xc6s` and `xc7`, `-nowidelut`. Yosys counts a
/// table of two inputs as cheap, one of four to six as dear.
pub(super) static SIX_INPUTS: Fabric = Fabric {
    tables: &[0, 1, 1, 1, 1, 1, 1],
    prices: &[0.0, 2.0, 2.0, 3.0, 5.0, 5.0, 5.0],
    chains: Chains::WithTables,
    chain_levels: 0,
    carry_cell: 4,
    carry_entry: 0,
    shortest_sum: 2,
    shortest_product: super::SHORTEST_PRODUCT,
    multiplier_registers: MultiplierRegisters::OperandsAndProduct,
    longest_shift: 32,
    memory_cell: (32, 6, 4),
    one_place_bits: 8,
    deepest_table_memory: 64,
    guarded_block_rams: false,
};

impl Fabric {
    /// Most inputs of a function that carry chains compare in one table.
    pub fn lut_inputs(&self) -> usize {
        self.tables.iter().rposition(|n| *n == 1).unwrap_or(0)
    }

    /// Bits of carry that a chain takes, whole cells; none if it has no bits.
    pub fn carry_bits(&self, bits: usize) -> u64 {
        let cells = bits.div_ceil(self.carry_cell) + if bits > 0 { self.carry_entry } else { 0 };
        (cells * self.carry_cell) as u64
    }

    /// Look-up tables that carry chains of that many bits take beside those in front of them.
    pub fn chain_luts(&self, bits: u64) -> u64 {
        match self.chains {
            Chains::WithTables => 0,
            Chains::Complete => bits,
        }
    }

    /// Look-up tables of a memory, which is read where it is written or elsewhere.
    pub fn memory_luts(&self, words: usize, bits: u32, in_place: bool) -> u64 {
        let (cell_words, cell_bits, luts) = self.memory_cell;
        let cell_bits = if in_place { self.one_place_bits } else { cell_bits };
        words.div_ceil(cell_words) as u64 * u64::from(bits.div_ceil(cell_bits)) * luts
    }
}

#[cfg(test)]
mod tests {
    use crate::device;

    #[test]
    fn a_memory_is_whole_cells() {
        let fabric = |name| device::find(name).unwrap().fabric;
        // RAM16X1D: two tables a bit and 16 words.
        assert_eq!(fabric("xc2v6000-4").memory_luts(16, 40, false), 80);
        assert_eq!(fabric("xc2v6000-4").memory_luts(32, 3, false), 12);
        // RAM16X1S: one.
        assert_eq!(fabric("xc2v6000-4").memory_luts(16, 40, true), 40);
        // TRELLIS_DPR16X4: six tables for four bits.
        assert_eq!(fabric("lfe5u-85-6").memory_luts(16, 5, false), 12);
    }

    #[test]
    fn chains_take_whole_cells() {
        assert_eq!(device::find("xc7a200t-1").unwrap().fabric.carry_bits(5), 8);
        assert_eq!(device::find("xc2v6000-4").unwrap().fabric.carry_bits(5), 5);
        let nexus = device::find("lifcl-40-9").unwrap().fabric;
        assert_eq!([0, 5, 32].map(|bits| nexus.carry_bits(bits)), [0, 8, 34], "one cell more than on the ECP5");
    }
}
