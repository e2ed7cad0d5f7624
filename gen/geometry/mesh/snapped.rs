//! A mesh whose vertices are moved to the points of a grid.

use super::Mesh;
use nalgebra::Point3;

/// A mesh on a grid. Its faces are those of the mesh that it was made of, in their order; equal vertices are one.
#[derive(Clone, Debug)]
pub struct Snapped {
    /// The distance of two points of the grid.
    pub grid: f64,
    /// The same mesh in units of the grid: every coordinate is a whole number, and no two vertices are equal.
    pub mesh: Mesh,
    /// How far the vertex that moved farthest is from where it was, in units of the given mesh, computed in binary64.
    pub moved: f64,
    /// How many fewer vertices there are than different ones were given.
    pub merged: usize,
}

impl Snapped {
    /// Moves each vertex to the nearest point of the grid, and to the one farther from the origin if two are as near.
    ///
    /// # Panics
    /// If the grid is not positive, or a coordinate has 2^53 units of it or more, which binary64 cannot count.
    pub fn new(mesh: &Mesh, grid: f64) -> Self {
        assert!(grid > 0.0 && Self::most(mesh) / grid < 2f64.powi(53), "expected a grid that binary64 can count");
        let units = |vertex: &Point3<f64>| vertex.map(|x| (x / grid).round());
        let vertices: Vec<Point3<f64>> = mesh.vertices.iter().map(units).collect();
        // A fused product shows whether a vertex moved at all; scaled, no square underflows.
        let length = |(given, units): (&Point3<f64>, &Point3<f64>)| {
            let by = given.coords.zip_map(&units.coords, |given: f64, units: f64| units.mul_add(grid, -given));
            let most = by.amax();
            if most == 0.0 { 0.0 } else { most * (by / most).norm() }
        };
        let moved = mesh.vertices.iter().zip(&vertices).map(length).fold(0.0, f64::max);
        let snapped = Mesh { vertices, faces: mesh.faces.clone() }.welded();
        let merged = mesh.welded().vertices.len() - snapped.vertices.len();
        Self { grid, mesh: snapped, moved, merged }
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
        let Snapped { mesh: Mesh { vertices, faces }, moved, merged, .. } = Snapped::new(&mesh, 0.5);
        assert_eq!(vertices, [[1.0, -1.0, 0.0], [0.0; 3], [0.0, 0.0, 2.0], [2.0, 0.0, 0.0]].map(Point3::from));
        assert_eq!(faces, [[0, 1, 2], [3, 1, 0]]);
        // The first one farthest, to (0.5, -0.5, 0).
        assert!((moved - 0.24f64.hypot(0.24)).abs() < 1e-12 && merged == 0, "{moved} {merged}");
        let whole = Mesh { vertices, faces };
        let Snapped { moved, merged, .. } = Snapped::new(&whole, 0.5);
        assert_eq!((moved, merged), (0.0, 0));
        // By less than a square can show.
        let tiny = Mesh { vertices: vec![Point3::new(3e-200, 0.0, 0.0)], faces: vec![] };
        assert_eq!(Snapped::new(&tiny, 1.0).moved, 3e-200);
        let coarse = Snapped::new(&mesh, 2.0);
        assert_eq!((coarse.mesh.faces, coarse.merged), (vec![[0, 0, 1], [0, 0, 0]], 2));
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
