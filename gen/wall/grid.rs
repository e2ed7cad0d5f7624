//! The pairs of a map's cells.

use super::{Contact, Step, WallError};
use crate::params::Params;

/// Cells in each direction.
pub const SIZE: usize = 256;

/// The pairs around a contact, each coordinate exact.
#[derive(Clone, Debug)]
pub struct Grid {
    contact: Contact,
    points: [[f64; 3]; 6],
    exponent: i32,
}

impl Grid {
    pub(super) fn new(contact: &Contact, step: Step, params: &Params) -> Result<Self, WallError> {
        let exponent = step.exponent(contact, params);
        let found = (contact.name, step, exponent);
        if exponent > -7 {
            let (contact, step, exponent) = found;
            return Err(WallError::Coarse { contact, step, exponent });
        }
        let grid = Self { contact: *contact, points: contact.points(), exponent };
        // All cells are multiples of the step if those of the corners are, and then rounding one step shows.
        if !grid.exact() {
            let (contact, step, exponent) = found;
            return Err(WallError::Fine { contact, step, exponent });
        }
        Ok(grid)
    }

    /// The binary exponent of the step.
    pub fn exponent(&self) -> i32 {
        self.exponent
    }

    /// The pair of a cell; rows count from the top, columns from the left, and the contact itself is the cell
    /// (SIZE / 2, SIZE / 2).
    pub fn pair(&self, row: usize, column: usize) -> [[f64; 3]; 6] {
        let mut points = self.points;
        let offset = self.offset(row, column);
        for (x, offset) in points[self.contact.moved].iter_mut().zip(offset) {
            *x += offset;
        }
        points
    }

    /// How far a cell is from the contact.
    fn offset(&self, row: usize, column: usize) -> [f64; 3] {
        let half = (SIZE / 2) as f64;
        let (right, up) = (column as f64 - half, half - row as f64);
        let step = f64::from(self.exponent).exp2();
        [0, 1, 2].map(|i| (right * self.contact.along[i] + up * self.contact.through[i]) * step)
    }

    /// Whether no cell is rounded: a sum is exact if taking either term from it leaves the other.
    fn exact(&self) -> bool {
        let start = self.points[self.contact.moved];
        (0..SIZE * SIZE).all(|cell| {
            let offset = self.offset(cell / SIZE, cell % SIZE);
            (0..3).all(|i| {
                let sum = start[i] + offset[i];
                sum - start[i] == offset[i] && sum - offset[i] == start[i]
            })
        })
    }
}
