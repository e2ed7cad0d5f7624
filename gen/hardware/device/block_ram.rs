//! How many block RAMs a memory takes.

/// Places and bits that a block RAM of 18 kbit can have: widths of nine bits and more use its parity bits.
const SHAPES: [(u64, u64); 6] = [(16_384, 1), (8192, 2), (4096, 4), (2048, 9), (1024, 18), (512, 36)];

/// Block RAMs of 18 kbit that a memory with one or two ports takes, by the shape that needs the fewest.
pub fn block_rams(places: u64, bits: u64) -> u64 {
    let of_shape = |(deep, wide): (u64, u64)| places.div_ceil(deep) * bits.div_ceil(wide);
    SHAPES.into_iter().map(of_shape).min().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_best_shape_counts() {
        assert_eq!([(512, 36), (512, 37), (1024, 36), (1025, 18)].map(|(p, b)| block_rams(p, b)), [1, 2, 2, 2]);
        assert_eq!([(16_384, 1), (16_384, 64), (65, 512)].map(|(p, b)| block_rams(p, b)), [1, 64, 15]);
    }
}
