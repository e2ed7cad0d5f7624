//! How a pair is decided, and what there is to choose in the determinant unit (docs/determinants.md) and in the exact one
//! (docs/exact.md).

use super::options::Choice;
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
