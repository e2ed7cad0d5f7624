//! A mesh whose vertices are moved to the points of a grid.

use super::Mesh;
use nalgebra::Point3;
use std::collections::HashMap;

/// A mesh on a grid. Its faces are those of the mesh that it was made of, in their order; equal vertices are one.
#[derive(Clone, Debug)]
pub struct Snapped {
    /// The distance of two points of the grid.
    pub grid: f64,
    /// The same mesh in units of the grid: every coordinate is a whole number, and no two vertices are equal.
    pub mesh: Mesh,
}

impl Snapped {
    /// Moves each vertex to the nearest point of the grid, and to the one farther from the origin if two are as near.
    ///
    /// # Panics
    /// If the grid is not positive, or a coordinate has 2^53 units of it or more, which binary64 cannot count.
    pub fn new(mesh: &Mesh, grid: f64) -> Self {
        assert!(grid > 0.0 && Self::most(mesh) / grid < 2f64.powi(53), "expected a grid that binary64 can count");
        let mut numbers: HashMap<[i64; 3], u32> = HashMap::new();
        let mut vertices = vec![];
        let mut number = |vertex: &Point3<f64>| {
            let units = [0, 1, 2].map(|axis| (vertex[axis] / grid).round());
            *numbers.entry(units.map(|x| x as i64)).or_insert_with(|| {
                // Not -0.
                vertices.push(Point3::from(units.map(|x| x + 0.0)));
                vertices.len() as u32 - 1
            })
        };
        let of_old: Vec<u32> = mesh.vertices.iter().map(&mut number).collect();
        let faces = mesh.faces.iter().map(|face| face.map(|vertex| of_old[vertex as usize])).collect();
        Self { grid, mesh: Mesh { vertices, faces } }
    }

    /// The finest grid of a power of two on which no two vertices of a mesh are more than `most` units apart along an axis; 1
    /// for a mesh of one point. None if binary64 has no such grid: the mesh is too large or too small.
    pub fn finest(mesh: &Mesh, most: f64) -> Option<f64> {
        let ends = |axis: usize| {
            let along = mesh.vertices.iter().map(|vertex| vertex[axis]);
            along.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
        };
        let ends = [0, 1, 2].map(ends);
        if ends.iter().all(|(low, high)| low >= high) {
            return Some(1.0);
        }
        // Half of an extent does not overflow.
        let half = ends.iter().map(|(low, high)| high / 2.0 - low / 2.0).fold(0.0, f64::max);
        let grid = (half / (most / 2.0)).log2().ceil().exp2();
        // Both ends may be rounded outward.
        let fits = |grid: f64| ends.iter().all(|(low, high)| (high / grid).round() - (low / grid).round() <= most);
        let grid = if fits(grid) { grid } else { 2.0 * grid };
        (grid.is_normal() && fits(grid)).then_some(grid)
    }

    /// The greatest magnitude of a coordinate.
    pub fn most(mesh: &Mesh) -> f64 {
        mesh.vertices.iter().map(|vertex| vertex.coords.amax()).fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vertices_go_to_the_nearest_points_and_equal_ones_become_one() {
        let vertices = [[0.26, -0.26, 0.0], [0.24, 0.1, -0.2], [-0.1, 0.24, 1.0], [0.75, 0.0, 0.0]].map(Point3::from);
        let mesh = Mesh { vertices: vertices.into(), faces: vec![[0, 1, 2], [3, 1, 0]] };
        let Mesh { vertices, faces } = Snapped::new(&mesh, 0.5).mesh;
        assert_eq!(vertices, [[1.0, -1.0, 0.0], [0.0; 3], [0.0, 0.0, 2.0], [2.0, 0.0, 0.0]].map(Point3::from));
        assert_eq!(faces, [[0, 1, 2], [3, 1, 0]]);
        assert_eq!(Snapped::new(&mesh, 2.0).mesh.faces, [[0, 0, 1], [0, 0, 0]]);
        assert_eq!(Snapped::finest(&mesh, 131_071.0), Some(2f64.powi(-16)));
    }

    #[test]
    fn the_finest_grid_counts_rounded_ends() {
        let along = |low: f64, high: f64| {
            let vertices = vec![Point3::new(low, 0.0, 0.0), Point3::new(high, 0.0, 0.0)];
            Snapped::finest(&Mesh { vertices, faces: vec![] }, 131_071.0)
        };
        assert_eq!(along(0.0, 131_071.0), Some(1.0));
        // 131,071 long, and 131,072 steps of 1 once both ends are rounded.
        assert_eq!(along(-0.5, 131_070.5), Some(2.0));
        assert_eq!(along(3.0, 3.0), Some(1.0));
        assert_eq!([along(-1.7e308, 1.7e308), along(0.0, 5e-324)], [Some(2f64.powi(1008)), None]);
    }
}
