//! Triangles as they are in memory.

use super::block::{field, put, signed};
use crate::format::EngineFormat;
use efsat_unit::pair::Input;

/// A triangle as the unit reads it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Triangle {
    /// The number that answers carry.
    pub number: u32,
    /// Its corners.
    pub corners: [[Input; 3]; 3],
}

impl Triangle {
    /// The triangle as 64-bit words, up to its stride.
    pub fn words(&self, format: &EngineFormat) -> Vec<u64> {
        let layout = format.triangle();
        let mut words = vec![0; layout.stride as usize / 8];
        put(&mut words, 0, layout.number_bits, self.number.into());
        for (i, x) in (0..).zip(self.corners.as_flattened()) {
            put(&mut words, layout.lane * (1 + i), layout.lane, x.lo as u64);
            if let Some(at) = layout.sticky_at {
                put(&mut words, at + i, 1, x.sticky.into());
            }
        }
        words
    }

    /// Reads the words of a triangle.
    pub fn of(words: &[u64], format: &EngineFormat) -> Self {
        let layout = format.triangle();
        let input = |i: u32| Input {
            lo: signed(words, layout.lane * (1 + i), format.transform_width),
            sticky: layout.sticky_at.is_some_and(|at| field(words, at + i, 1) == 1),
        };
        Self {
            number: field(words, 0, layout.number_bits) as u32,
            corners: [0, 1, 2].map(|k| [0, 1, 2].map(|axis| input(3 * k + axis))),
        }
    }
}
