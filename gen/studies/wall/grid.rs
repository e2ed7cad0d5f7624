//! The pairs of a map's cells.

use super::step::COARSEST;
use super::{Contact, Step, WallError};
use efsat_unit::params::Params;

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
    /// The grid around a contact.
    ///
    /// # Errors
    /// A step with which cells leave the contact.
    pub fn new(contact: &Contact, step: Step, params: &Params) -> Result<Self, WallError> {
        let exponent = step.exponent(contact, params);
        if exponent > COARSEST {
            return Err(WallError::Coarse { contact: contact.name, step, exponent });
        }
        Ok(Self { contact: *contact, points: contact.points(), exponent })
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
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wall::CONTACTS;
    use crate::wall::step::FINEST;

    /// A sum is exact if taking either term from it leaves the other.
    #[test]
    fn no_cell_is_rounded() {
        for contact in &CONTACTS {
            for step in [Step::Power(FINEST), Step::Binary64, Step::Working, Step::Power(COARSEST)] {
                let grid = Grid::new(contact, step, &Params::default()).unwrap();
                let start = grid.points[contact.moved];
                let exact = |cell: usize| {
                    let (offset, pair) = (grid.offset(cell / SIZE, cell % SIZE), grid.pair(cell / SIZE, cell % SIZE));
                    (0..3).all(|i| {
                        let sum = pair[contact.moved][i];
                        sum - start[i] == offset[i] && sum - offset[i] == start[i]
                    })
                };
                assert!((0..SIZE * SIZE).all(exact), "{} {step}", contact.name);
            }
        }
    }

    #[test]
    fn cells_count_from_the_top_left() {
        let contact = Contact::named("vertex-on-face").unwrap();
        let grid = Grid::new(contact, Step::Power(-10), &Params::default()).unwrap();
        assert_eq!(grid.pair(SIZE / 2, SIZE / 2), contact.points());
        let moved = |row, column| grid.pair(row, column)[contact.moved];
        assert_eq!(moved(0, 0), [0.5 - 0.125, 0.75, 0.625 + 0.125]);
        assert_eq!(moved(SIZE / 2, SIZE / 2 + 1), [0.5 + 1.0 / 1024.0, 0.75, 0.625]);
    }

    #[test]
    fn coarse_steps_are_refused() {
        let params = Params { width: 13, ..Params::default() };
        let contact = Contact::named("edge-on-edge").unwrap();
        let error = Grid::new(contact, Step::Working, &params).unwrap_err();
        assert_eq!(error, WallError::Coarse { contact: "edge-on-edge", step: Step::Working, exponent: -6 });
    }
}
