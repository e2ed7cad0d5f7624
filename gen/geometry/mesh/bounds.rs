//! Axis-aligned bounding boxes.

use nalgebra::{Point3, Vector3};

/// A closed axis-aligned box. It is made by comparisons alone, so it is exact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The least coordinates.
    pub min: Point3<f64>,
    /// The greatest coordinates.
    pub max: Point3<f64>,
}

impl Bounds {
    /// The box of no point: the neutral element of [`union`](Self::union), and it overlaps nothing.
    pub fn empty() -> Self {
        Self { min: Vector3::repeat(f64::INFINITY).into(), max: Vector3::repeat(f64::NEG_INFINITY).into() }
    }

    /// The least box that holds all `points`.
    pub fn of<'a>(points: impl IntoIterator<Item = &'a Point3<f64>>) -> Self {
        points.into_iter().fold(Self::empty(), |b, &p| b.union(&Self { min: p, max: p }))
    }

    /// The least box that holds both.
    pub fn union(&self, other: &Self) -> Self {
        Self { min: self.min.inf(&other.min), max: self.max.sup(&other.max) }
    }

    /// Whether the closed boxes have a common point: touching counts.
    pub fn overlaps(&self, other: &Self) -> bool {
        (0..3).all(|i| self.min[i] <= other.max[i] && other.min[i] <= self.max[i])
    }

    /// The midpoint, rounded to binary64. (Halving first: the sum of two finite numbers may overflow.)
    pub fn centre(&self) -> Point3<f64> {
        (self.min.coords * 0.5 + self.max.coords * 0.5).into()
    }

    /// The greatest half-extent, rounded to binary64: the half-size of the least cube that holds the box.
    pub fn half_size(&self) -> f64 {
        (self.max.coords * 0.5 - self.min.coords * 0.5).max()
    }
}
