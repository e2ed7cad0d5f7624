//! Where meshes are put, so that fixed-point numbers hold them.

use crate::exact::ceiling;
use crate::mesh::Mesh;
use crate::power::ceil_log2;

/// Powers of two by which meshes are scaled: a mesh of one point has one too.
const POWERS: std::ops::RangeInclusive<i32> = -1024..=1022;

/// The map x to 2^power (x - centre) that brings the vertices of a mesh into the cube from -1 to 1. All its numbers are exact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// The middle of the mesh's box, rounded.
    pub centre: [f64; 3],
    /// The scale is 2^power.
    pub power: i32,
}

impl Placement {
    /// The placements of meshes with one scale, the greatest with which all of them fit.
    pub fn common(meshes: &[&Mesh]) -> Vec<Self> {
        let own: Vec<Self> = meshes.iter().map(|mesh| Self::of(mesh)).collect();
        let power = own.iter().map(|placement| placement.power).min().unwrap_or(0);
        own.into_iter().map(|placement| Self { power, ..placement }).collect()
    }

    /// The placement of one mesh with the greatest scale.
    fn of(mesh: &Mesh) -> Self {
        if mesh.vertices().is_empty() {
            return Self { centre: [0.0; 3], power: *POWERS.end() };
        }
        let centre: [f64; 3] = mesh.bounds().centre().into();
        // The greatest distance from the centre, rounded, tells the power but for one.
        let far = mesh.vertices().iter().flat_map(|v| (0..3).map(|i| (v[i] - centre[i]).abs())).fold(0.0, f64::max);
        let guess = (1 - ceil_log2(far)).clamp(*POWERS.start(), *POWERS.end());
        let powers = (*POWERS.start()..=guess).rev();
        let placements = powers.map(|power| Self { centre, power });
        placements
            .into_iter()
            .find(|placement| placement.holds(mesh))
            .unwrap_or(Self { centre, power: *POWERS.start() })
    }

    /// Whether all vertices are in the cube.
    pub fn holds(&self, mesh: &Mesh) -> bool {
        let inside = |x: f64, axis: usize| {
            let c = self.centre[axis];
            let at_most_one = |numbers: [f64; 2]| ceiling(&numbers, self.power).is_some_and(|number| number <= 1);
            at_most_one([x, -c]) && at_most_one([-x, c])
        };
        mesh.vertices().iter().all(|v| (0..3).all(|axis| inside(v[axis], axis)))
    }

    /// The least whole number of steps of 2^-fraction not below n . y, y the image of x.
    ///
    /// # Panics
    /// If it does not fit 32 bits, which that of a point of the cube does up to a fraction of 28.
    pub fn offset(&self, x: [f64; 3], n: [i8; 3], fraction: u32) -> i32 {
        let mut numbers = [0.0; 6];
        for axis in 0..3 {
            // Signs are 1, 0 and -1, so that the products are exact.
            numbers[2 * axis] = f64::from(n[axis]) * x[axis];
            numbers[2 * axis + 1] = -f64::from(n[axis]) * self.centre[axis];
        }
        let steps = ceiling(&numbers, self.power + fraction as i32).and_then(|steps| steps.try_into().ok());
        steps.expect("a point of the cube has offsets of at most 3")
    }

    /// The greatest whole number of steps of 2^-fraction not above the image of a coordinate, and whether it is less.
    pub fn floor(&self, x: f64, axis: usize, fraction: u32) -> Option<(i64, bool)> {
        let (c, power) = (self.centre[axis], self.power + fraction as i32);
        let (below, above) = (-ceiling(&[-x, c], power)?, ceiling(&[x, -c], power)?);
        Some((below, below != above))
    }
}
