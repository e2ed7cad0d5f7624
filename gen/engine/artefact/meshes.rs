//! Small meshes of whole numbers, and a turn, for vector files and tests.

use efsat_geometry::mesh::Mesh;
use nalgebra::Point3;

/// A field of so many cells in each direction, two triangles a cell, with hills of whole sixteenths.
pub fn hills(cells: u32) -> Mesh {
    let row = cells + 1;
    let height = |x: u32, y: u32| f64::from((7 * x + 5 * y + x * y) % 11) / 16.0;
    let vertices = (0..row).flat_map(|y| (0..row).map(move |x| Point3::new(f64::from(x), f64::from(y), height(x, y))));
    let cell = |x: u32, y: u32| {
        let corner = y * row + x;
        [[corner, corner + 1, corner + row + 1], [corner, corner + row + 1, corner + row]]
    };
    let faces = (0..cells).flat_map(|y| (0..cells).flat_map(move |x| cell(x, y)));
    Mesh::new(vertices, faces).expect("a grid")
}

/// The surface of a box with whole corners.
pub fn cuboid(x: u32, y: u32, z: u32) -> Mesh {
    let [x, y, z] = [x, y, z].map(f64::from);
    let vertices = (0..8).map(|i| {
        let at = |bit: u32, end: f64| if i >> bit & 1 == 1 { end } else { 0.0 };
        Point3::new(at(0, x), at(1, y), at(2, z))
    });
    let sides = [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
    let faces = sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
    Mesh::new(vertices, faces).expect("a box")
}

/// A turn about an axis by the angle of the triangle 3, 4, 5.
pub fn turn(axis: usize) -> [[f64; 3]; 3] {
    let (mut m, [i, j]) = ([[0.0; 3]; 3], [(axis + 1) % 3, (axis + 2) % 3]);
    m[axis][axis] = 1.0;
    (m[i][i], m[i][j], m[j][i], m[j][j]) = (0.8, -0.6, 0.6, 0.8);
    m
}
