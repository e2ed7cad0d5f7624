//! The directions of k-DOPs, and any vector as a sum of three of them.

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
pub(super) type Term = (usize, f64);

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
    pub fn count(self) -> usize {
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
    pub(super) fn combination(self, w: &Vector3<f64>) -> [Term; 3] {
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
