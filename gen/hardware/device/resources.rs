//! What a circuit takes of a device.

use std::iter::Sum;
use std::ops::{Add, Mul};

/// Cells of a circuit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Resources {
    /// Hardware multipliers.
    pub multipliers: u64,
    /// Look-up tables used for logic.
    pub luts: u64,
    /// Look-up tables used as shift registers or memory.
    pub memory_luts: u64,
    /// Flip-flops outside multipliers.
    pub flip_flops: u64,
    /// Bits of carry chains.
    pub carry: u64,
}

impl Resources {
    /// All that a part with this capacity has too little of: the kind of cells, how many are used and how many there are.
    pub fn shortages(&self, capacity: &Self) -> Vec<(&'static str, u64, u64)> {
        let kinds = [
            ("multipliers", self.multipliers, capacity.multipliers),
            ("LUTs", self.luts + self.memory_luts, capacity.luts),
            ("flip-flops", self.flip_flops, capacity.flip_flops),
        ];
        kinds.into_iter().filter(|(_, used, there)| used > there).collect()
    }
}

impl Add for Resources {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            multipliers: self.multipliers + other.multipliers,
            luts: self.luts + other.luts,
            memory_luts: self.memory_luts + other.memory_luts,
            flip_flops: self.flip_flops + other.flip_flops,
            carry: self.carry + other.carry,
        }
    }
}

impl Mul<u64> for Resources {
    type Output = Self;

    fn mul(self, n: u64) -> Self {
        Self {
            multipliers: self.multipliers * n,
            luts: self.luts * n,
            memory_luts: self.memory_luts * n,
            flip_flops: self.flip_flops * n,
            carry: self.carry * n,
        }
    }
}

impl Sum for Resources {
    fn sum<I: Iterator<Item = Self>>(all: I) -> Self {
        all.fold(Self::default(), Add::add)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_that_does_not_fit_is_named() {
        let design = Resources { multipliers: 39, luts: 2000, memory_luts: 808, flip_flops: 3467, carry: 0 };
        let part = Resources { multipliers: 1, luts: 2807, memory_luts: 900, flip_flops: 3467, carry: 0 };
        assert_eq!(design.shortages(&part), [("multipliers", 39, 1), ("LUTs", 2808, 2807)]);
    }
}
