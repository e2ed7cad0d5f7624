//! How a pair is decided, and what there is to choose in the determinant unit (docs/determinants.md) and in the exact one
//! (docs/exact.md).

use super::options::Choice;
use super::{Params, Transform};
use std::ops::RangeInclusive;

/// How a pair is decided.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Method {
    /// Separating axes in interval arithmetic: the paper's.
    Axes,
    /// The signs of fifteen determinants with error bounds.
    Determinants,
    /// The signs of fifteen determinants without error, for points on a grid.
    Exact,
}

impl Choice for Method {
    const ALL: &'static [Self] = &[Self::Axes, Self::Determinants, Self::Exact];

    fn name(self) -> &'static str {
        match self {
            Self::Axes => "axes",
            Self::Determinants => "determinants",
            Self::Exact => "exact",
        }
    }
}

/// Which geometry the exact unit answers for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Truth {
    /// That which is given; pairs are put on a grid by the host.
    Given,
    /// Meshes rounded to the grid of the input format, and B rounded to it again behind the frame transform.
    Snapped,
}

impl Choice for Truth {
    const ALL: &'static [Self] = &[Self::Given, Self::Snapped];

    fn name(self) -> &'static str {
        match self {
            Self::Given => "given",
            Self::Snapped => "snapped",
        }
    }
}

/// What the error bounds of the determinants are made of, from coarse to fine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Bound {
    /// The shift of the moments and the error level alone.
    Static,
    /// Lengths of edges and vertices.
    Edges,
    /// Those, and the moments.
    Moments,
    /// The moments, and products of the leading bits of coordinates.
    Products,
}

impl Choice for Bound {
    const ALL: &'static [Self] = &[Self::Static, Self::Edges, Self::Moments, Self::Products];

    fn name(self) -> &'static str {
        match self {
            Self::Static => "static",
            Self::Edges => "edges",
            Self::Moments => "moments",
            Self::Products => "products",
        }
    }
}

/// Binary places below the grid that the first stage of a cascade adds to differences: three that are dropped in any case,
/// and as many as bring a difference of one to 18 bits.
pub const BELOW_GRID: u32 = 20;
/// The clocks between pairs of the second stage of a cascade, or none: a unit of one stage.
pub type ExactClocks = Option<u32>;
/// How many clocks those may be.
pub const EXACT_CLOCKS: RangeInclusive<u32> = 11..=32;
/// Clocks between pairs.
pub const CLOCKS_PER_PAIR: &[u32] = &[1, 2, 3, 6, 11];
/// How many places the shift of the moments has to choose from, beside the first.
pub const SPAN: &[u32] = &[0, 1, 3];
/// Greatest error levels.
pub const LEVELS: &[u32] = &[0, 2, 6];

/// The error of the coordinates of a determinant unit, told in levels: a coordinate of level e is wrong by at most
/// 1/2 + 2^(e-3) (section 3 of docs/determinants.md).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ErrorLevels {
    /// The bits that are dropped of a difference at least, so that no level is above [`Params::levels`].
    pub least: u32,
    /// An axis that drops d bits has level fine - d.
    pub fine: u32,
    /// The greatest level that there is where nothing is dropped, and so nothing is rounded.
    pub greatest: u32,
}

impl Params {
    /// A bound of the error of a difference in ulps of the input format, which no difference reaches (section 7.1 of
    /// docs/determinants.md).
    pub const fn difference_error(&self) -> u32 {
        match self.transform {
            Transform::On => 5,
            Transform::Translate => 2,
            Transform::Off => 1,
        }
    }

    /// The error levels that follow from the error of a difference.
    pub fn error_levels(&self) -> ErrorLevels {
        let error = self.difference_error();
        // The least with error <= 2^(fine-3), and the least with error <= 1/2 + 2^(greatest-3).
        let fine = error.next_power_of_two().ilog2() + 3;
        let greatest = (2 * error - 1).next_power_of_two().ilog2() + 2;
        let least = if self.levels >= greatest { 0 } else { fine.saturating_sub(self.levels) };
        ErrorLevels { least, fine, greatest }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The table of section 3 of docs/determinants.md, and what section 7.1 needs of it: the error behind d dropped bits is
    /// within that of the level.
    #[test]
    fn levels_cover_the_error_of_a_difference() {
        let expected = [(Transform::On, [6, 6]), (Transform::Translate, [4, 4]), (Transform::Off, [3, 2])];
        for (transform, table) in expected {
            for &levels in LEVELS {
                let p = Params { transform, levels, ..Params::of(Method::Determinants) };
                let ErrorLevels { least, fine, greatest } = p.error_levels();
                assert_eq!([fine, greatest], table);
                for d in least..10 {
                    let level = fine.saturating_sub(d).min(greatest);
                    assert!(level <= levels, "{p:?}");
                    let halves = |x: f64| if d > 0 { x + 0.5 } else { x };
                    let error = halves(f64::from(p.difference_error()) / f64::from(d).exp2());
                    assert!(error <= 0.5 + (f64::from(level) - 3.0).exp2(), "{transform:?}, {d} bits dropped");
                }
            }
        }
    }
}
