//! A spur gear.

use crate::mesh::Mesh;
use crate::mesh::angle::sin_cos_degrees;
use nalgebra::Point3;

const TEETH: u32 = 16;
const BORE: f64 = 2.0;
const WIDTH: f64 = 3.0;
/// The flank of a tooth from the root to the tip: radius, and degrees from the middle of the tooth. The involute of a gear
/// of pitch radius 8 at a pressure angle of 20 degrees, less 0.1 degrees of play; straight to the root, which is wider.
const FLANK: [(f64, f64); 5] = [(6.8, 6.9), (7.5175, 6.38), (8.0, 5.525), (8.5, 3.966), (9.0, 2.018)];

/// A gear of 16 teeth about the z axis, from z = 0 to 3, of pitch radius 8; a tooth points along x. Two of them run at a
/// distance of 16, one turned by half a tooth.
pub(super) fn mesh() -> Mesh {
    let outline: Vec<(f64, f64)> = (0..TEETH)
        .flat_map(|tooth| {
            let middle = 360.0 * f64::from(tooth) / f64::from(TEETH);
            let rising = FLANK.map(|(radius, angle)| (radius, middle - angle));
            let falling = FLANK.map(|(radius, angle)| (radius, middle + angle));
            rising.into_iter().chain(falling.into_iter().rev())
        })
        .collect();
    let count = outline.len() as u32;
    let point = |radius: f64, angle: f64, z: f64| {
        let (s, c) = sin_cos_degrees(angle);
        Point3::new(radius * c, radius * s, z)
    };
    // Rings of vertices: teeth below and above, bore below and above.
    let ring = |bore: bool, z: f64| {
        let radius = move |radius: f64| if bore { BORE } else { radius };
        outline.iter().map(move |&(r, angle)| point(radius(r), angle, z))
    };
    let rings = [(false, 0.0), (false, WIDTH), (true, 0.0), (true, WIDTH)];
    let vertices = rings.into_iter().flat_map(|(bore, z)| ring(bore, z)).collect();
    // Walls between rings, seen from outside: from the first counterclockwise to the second.
    let walls = [(0, 1), (1, 3), (3, 2), (2, 0)];
    let quad = |(low, high): (u32, u32), i: u32| {
        let next = (i + 1) % count;
        let [p, q, r, s] = [low * count + i, low * count + next, high * count + next, high * count + i];
        [[p, q, r], [p, r, s]]
    };
    let faces = walls.into_iter().flat_map(|wall| (0..count).flat_map(move |i| quad(wall, i))).collect();
    Mesh { vertices, faces }
}
