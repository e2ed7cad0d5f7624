//! The directions of k-DOPs, and any vector as a sum of three of them.
//!
//! ```
//! use efsat_geometry::directions::Directions;
//!
//! let set = Directions::of(18).unwrap();
//! let terms = set.combination(&[3.0, -1.0, 0.5].into());
//! let sum = |axis: usize| terms.iter().map(|&(index, factor)| f64::from(set.vector(index)[axis]) * factor).sum::<f64>();
//! assert_eq!([sum(0), sum(1), sum(2)], [3.0, -1.0, 0.5]);
//! ```

use nalgebra::Vector3;

/// The outward normals of a k-DOP: small integers, each beside its opposite.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Directions {
    /// The six of a box.
    Six,
    /// Those and the eight of an octahedron, (1, 1, 1) and alike.
    Fourteen,
    /// The six of a box and twelve that cut its edges, (1, 1, 0) and alike.
    Eighteen,
    /// All of them.
    TwentySix,
}

/// A direction by its number, and its factor.
pub type Term = (usize, f64);

const AXES: usize = 6;
const EDGES: usize = 12;

/// Axes, then what cuts edges, then what cuts corners; the opposite of number i is i ^ 1.
const ALL: [[i8; 3]; 26] = [
    [1, 0, 0],
    [-1, 0, 0],
    [0, 1, 0],
    [0, -1, 0],
    [0, 0, 1],
    [0, 0, -1],
    [1, 1, 0],
    [-1, -1, 0],
    [1, -1, 0],
    [-1, 1, 0],
    [1, 0, 1],
    [-1, 0, -1],
    [1, 0, -1],
    [-1, 0, 1],
    [0, 1, 1],
    [0, -1, -1],
    [0, 1, -1],
    [0, -1, 1],
    [1, 1, 1],
    [-1, -1, -1],
    [1, 1, -1],
    [-1, -1, 1],
    [1, -1, 1],
    [-1, 1, -1],
    [-1, 1, 1],
    [1, -1, -1],
];

impl Directions {
    /// All sets.
    pub const ALL: [Self; 4] = [Self::Six, Self::Fourteen, Self::Eighteen, Self::TwentySix];

    /// The number of directions.
    pub const fn count(self) -> usize {
        match self {
            Self::Six => 6,
            Self::Fourteen => 14,
            Self::Eighteen => 18,
            Self::TwentySix => 26,
        }
    }

    /// The set of that many directions, if there is one.
    pub fn of(count: usize) -> Option<Self> {
        Self::ALL.into_iter().find(|set| set.count() == count)
    }

    /// Direction number `index`; its opposite is number `index ^ 1`.
    ///
    /// # Panics
    /// If there is none.
    pub fn vector(self, index: usize) -> [i8; 3] {
        assert!(index < self.count(), "direction {index} of {}", self.count());
        match self {
            Self::Fourteen if index >= AXES => ALL[index + EDGES],
            _ => ALL[index],
        }
    }

    /// The directions among which each term of a [`combination`](Self::combination) is found: no vector has two terms of
    /// one slot, so that hardware chooses each term among a third of the directions.
    ///
    /// | k | slot 0 | slot 1 | slot 2 |
    /// | --- | --- | --- | --- |
    /// | 6 | x | y | z |
    /// | 14 | axes | corners | corners |
    /// | 18 | x, edges in the plane of y and z | y, edges of x and z | z, edges of x and y |
    /// | 26 | axes | edges | corners |
    pub fn slots(self) -> [&'static [u8]; 3] {
        match self {
            Self::Six => [&[0, 1], &[2, 3], &[4, 5]],
            Self::Fourteen => [&[0, 1, 2, 3, 4, 5], &[6, 7, 8, 9, 10, 11, 12, 13], &[6, 7, 8, 9, 10, 11, 12, 13]],
            Self::Eighteen => [&[0, 1, 14, 15, 16, 17], &[2, 3, 10, 11, 12, 13], &[4, 5, 6, 7, 8, 9]],
            Self::TwentySix => {
                [&[0, 1, 2, 3, 4, 5], &[6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17], &[18, 19, 20, 21, 22, 23, 24, 25]]
            }
        }
    }

    /// The terms of a [`combination`](Self::combination) in the order of their slots, each by its place in its slot.
    pub fn in_slots(self, terms: [Term; 3]) -> [Term; 3] {
        let mut placed = [None; 3];
        for (index, factor) in terms {
            let place = |slot: usize| self.slots()[slot].iter().position(|&entry| usize::from(entry) == index);
            let free = (0..3).filter(|&slot| placed[slot].is_none());
            let (slot, choice) =
                free.filter_map(|slot| Some((slot, place(slot)?))).next().expect("each term has a slot of its own");
            placed[slot] = Some((choice, factor));
        }
        placed.map(|term| term.expect("three terms fill three slots"))
    }

    /// The number of a direction of the set.
    fn index(self, vector: [i8; 3]) -> usize {
        let found = (0..self.count()).find(|&index| self.vector(index) == vector);
        found.expect("only directions of the set are sought")
    }

    /// Three directions and their factors, not negative but for rounding, of which `w` is the sum.
    ///
    /// Written for w1 >= w2 >= w3 >= 0; the other cases are the same with axes and signs exchanged. The directions are
    /// those around `w`:
    ///
    /// | k | w = |
    /// | --- | --- |
    /// | 6 | w1 (1,0,0) + w2 (0,1,0) + w3 (0,0,1) |
    /// | 14 | (w1 - w2) (1,0,0) + (w2 + w3)/2 (1,1,1) + (w2 - w3)/2 (1,1,-1) |
    /// | 18, w1 >= w2 + w3 | (w1 - w2 - w3) (1,0,0) + w2 (1,1,0) + w3 (1,0,1) |
    /// | 18, else | (w1 + w2 - w3)/2 (1,1,0) + (w1 + w3 - w2)/2 (1,0,1) + (w2 + w3 - w1)/2 (0,1,1) |
    /// | 26 | (w1 - w2) (1,0,0) + (w2 - w3) (1,1,0) + w3 (1,1,1) |
    pub fn combination(self, w: &Vector3<f64>) -> [Term; 3] {
        let mut order = [0, 1, 2];
        order.sort_by(|&i, &j| w[j].abs().total_cmp(&w[i].abs()));
        let [x, y, z] = order.map(|axis| w[axis].abs());
        let terms = match self {
            Self::Six => [([1, 0, 0], x), ([0, 1, 0], y), ([0, 0, 1], z)],
            Self::Fourteen => [([1, 0, 0], x - y), ([1, 1, 1], (y + z) / 2.0), ([1, 1, -1], (y - z) / 2.0)],
            Self::Eighteen if x >= y + z => [([1, 0, 0], x - (y + z)), ([1, 1, 0], y), ([1, 0, 1], z)],
            Self::Eighteen => {
                [([1, 1, 0], (x + y - z) / 2.0), ([1, 0, 1], (x + z - y) / 2.0), ([0, 1, 1], (y + z - x) / 2.0)]
            }
            Self::TwentySix => [([1, 0, 0], x - y), ([1, 1, 0], y - z), ([1, 1, 1], z)],
        };
        terms.map(|(sorted, factor): ([i8; 3], f64)| {
            let mut vector = [0; 3];
            for (axis, entry) in order.into_iter().zip(sorted) {
                vector[axis] = if w[axis] < 0.0 { -entry } else { entry };
            }
            (self.index(vector), factor)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::rngs::ChaCha8Rng;
    use rand::{RngExt, SeedableRng};

    #[test]
    fn directions_come_with_their_opposites() {
        for set in Directions::ALL {
            let vectors: Vec<[i8; 3]> = (0..set.count()).map(|index| set.vector(index)).collect();
            for (index, vector) in vectors.iter().enumerate() {
                assert_eq!(vectors[index ^ 1], vector.map(|x| -x));
                assert_eq!(vectors.iter().filter(|other| *other == vector).count(), 1);
            }
            assert_eq!(Directions::of(set.count()), Some(set));
        }
        assert_eq!(Directions::of(8), None);
        // 14 = 6 + 8 and 18 = 6 + 12.
        let length = |set: Directions| set.vector(set.count() - 1).iter().map(|x| x.abs()).sum::<i8>();
        assert_eq!(Directions::ALL.map(length), [1, 3, 2, 3]);
    }

    #[test]
    fn every_vector_is_a_sum_of_three_directions_with_factors_that_are_not_negative() {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        for round in 0..4000 {
            // Multiples of four, so that halves are whole; ties and zeros are frequent.
            let w = Vector3::from([0; 3].map(|_| 4.0 * f64::from(rng.random_range(-5 - round % 50..=5))));
            for set in Directions::ALL {
                let mut sum = Vector3::zeros();
                for (index, factor) in set.combination(&w) {
                    assert!(factor >= 0.0, "{set:?} {w:?}");
                    sum += Vector3::from(set.vector(index).map(f64::from)) * factor;
                }
                assert_eq!(sum, w, "{set:?}");
            }
        }
    }
}
