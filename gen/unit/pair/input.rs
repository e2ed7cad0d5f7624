//! What the unit reads: quantised numbers, pairs of triangles and poses (contract section 2, the paper's equation 5).

use crate::params::Params;
use efsat_hardware::number::{Interval, Upper};

/// One quantised real number x in the format [`Params::input`]: the lower bound of its enclosure and whether x lies
/// off the grid.
///
/// The upper bound is `lo + 1` with [`Upper::Implied`] and `lo + sticky` with [`Upper::Sticky`]; `sticky` is always
/// right, whichever rule the design uses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Input {
    /// Mantissa of the floor of x.
    pub lo: i64,
    /// Whether x is greater than its floor.
    pub sticky: bool,
}

impl Input {
    /// A number on the grid.
    pub const fn exact(lo: i64) -> Self {
        Self { lo, sticky: false }
    }

    /// The enclosure of the number, equation (5) or its exact-ceiling variant.
    #[inline]
    pub fn interval(self, upper: Upper) -> Interval<i64> {
        let width = match upper {
            Upper::Implied => 1,
            Upper::Sticky => i64::from(self.sticky),
        };
        Interval::new(self.lo, self.lo + width)
    }
}

/// Two triangles as the unit reads them, indexed `[vertex][coordinate]`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Pair {
    /// V0, V1, V2 of triangle A, in the frame of A.
    pub a: [[Input; 3]; 3],
    /// The vertices of triangle B~, in the frame of B.
    pub b: [[Input; 3]; 3],
}

/// The change of frame B = M * B~ + t, loaded once per query (contract section 3).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Pose {
    /// M, indexed `[row][column]`.
    pub m: [[Input; 3]; 3],
    /// t.
    pub t: [Input; 3],
    /// The frame change is the identity: B = B~ bit for bit, M and t are not read.
    pub bypass: bool,
}

impl Pose {
    /// The identity: M = I, t = 0, bypassed.
    pub fn identity(params: &Params) -> Self {
        Self::with_one(params.one() as i64)
    }

    /// The identity where 1 has that mantissa.
    pub fn with_one(one: i64) -> Self {
        let one = Input::exact(one);
        let mut m = [[Input::default(); 3]; 3];
        for (i, row) in m.iter_mut().enumerate() {
            row[i] = one;
        }
        Self { m, t: [Input::default(); 3], bypass: true }
    }
}
