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

    /// The finest grid of a power of two on which no two vertices of a mesh are `most` units or more apart along an axis; 1
    /// for a mesh of one point.
    pub fn finest(mesh: &Mesh, most: f64) -> f64 {
        let size = 2.0 * mesh.bounds().half_size();
        if size > 0.0 { (size / most).log2().ceil().exp2() } else { 1.0 }
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
        assert_eq!(Snapped::finest(&mesh, 131_071.0), 2f64.powi(-16));
    }
}
