//! Tests of containment: boxes on a coarse grid, where rays meet vertices and edges all the time, against comparisons of their ends.

use super::*;
use crate::exact::{Exact, posed_pair};
use crate::scene::rotation::axis_angle;
use nalgebra::{Matrix3, Point3, Vector3};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

/// Least and greatest coordinates.
type Box3 = [[i32; 3]; 2];

/// A mesh of boxes, each with vertices of its own; diagonals of the sides and orders of corners differ.
fn boxes(rng: &mut ChaCha8Rng, boxes: &[Box3]) -> Mesh {
    let (mut vertices, mut faces) = (vec![], vec![]);
    for ends in boxes {
        let first = vertices.len() as u32;
        vertices.extend(
            (0..8).map(|corner: usize| Point3::from([0, 1, 2].map(|axis| f64::from(ends[corner >> axis & 1][axis])))),
        );
        for (axis, end) in (0..3).flat_map(|axis| [(axis, 0), (axis, 1)]) {
            let [j, k] = [(axis + 1) % 3, (axis + 2) % 3];
            let mut square = [0, 1 << j, 1 << j | 1 << k, 1 << k].map(|corner| first + (end << axis | corner));
            square.rotate_left(rng.random_range(0..4));
            let [p, q, r, s] = square;
            faces.extend([[p, q, r], if rng.random() { [p, r, s] } else { [s, r, p] }]);
        }
    }
    Mesh::new(vertices, faces).unwrap()
}

fn found(a: &Mesh, b: &Mesh, pose: &Pose) -> Vec<((u32, u32), Nesting)> {
    let components = [a, b].map(|mesh| Components::new(mesh).unwrap());
    let corners = |mesh: &Mesh, face: u32| mesh.triangle(face as usize).map(<[f64; 3]>::from);
    let touch = |&(p, q): &(u32, u32)| {
        let exact = posed_pair(&corners(a, p), &corners(b, q), &pose.rows(), &pose.translation.into());
        exact.unwrap() != Exact::Separate
    };
    let pairs = (0..a.faces().len() as u32).flat_map(|p| (0..b.faces().len() as u32).map(move |q| (p, q)));
    let touching = pairs.filter(touch).map(|(p, q)| (components[0].of(p), components[1].of(q))).collect();
    nestings([a, b], [&components[0], &components[1]], pose, &touching)
}

#[test]
fn boxes_on_a_grid_are_told_apart_nested_and_touching() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let mut seen = [0; 3];
    for round in 0..300 {
        let mut random = |count: usize, lengths: std::ops::RangeInclusive<i32>| -> Vec<Box3> {
            let ends = |rng: &mut ChaCha8Rng| {
                let (low, length) = (rng.random_range(-4..=1), rng.random_range(lengths.clone()));
                [low, low + length]
            };
            (0..count)
                .map(|_| {
                    let [x, y, z] = [(); 3].map(|()| ends(&mut rng));
                    [[x[0], y[0], z[0]], [x[1], y[1], z[1]]]
                })
                // Boxes of one mesh that have a corner in common would be one component.
                .fold(vec![], |mut kept: Vec<Box3>, next| {
                    let corners =
                        |b: &Box3| [0, 1, 2, 3, 4, 5, 6, 7].map(|c: usize| [0, 1, 2].map(|i| b[c >> i & 1][i]));
                    let new = corners(&next);
                    if kept.iter().all(|old| corners(old).iter().all(|corner| !new.contains(corner))) {
                        kept.push(next);
                    }
                    kept
                })
        };
        let (mut of_a, mut of_b) = (random(3, 4..=8), random(3, 1..=4));
        if round % 2 == 0 {
            (of_a, of_b) = (of_b, of_a);
        }
        // A quarter turn, or a doubling, or a step that no coordinate is a multiple of; boxes stay boxes.
        let turn = Matrix3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
        let (rotation, step) = match round % 4 {
            0 => (Matrix3::identity(), 0.0),
            1 => (turn, 1.0),
            2 => (Matrix3::identity() * 2.0, 1.0),
            _ => (turn * 0.1, 0.1),
        };
        let pose = Pose { rotation, translation: Vector3::repeat(step) };
        let mut expected = vec![];
        for (p, a) in (0..).zip(&of_a) {
            for (q, b) in (0..).zip(&of_b) {
                // In fifteenths of the grid, all but for a little: 0.1 is no binary number, but no two ends are that close.
                let image = b.map(|end| pose.image(&Point3::from(end.map(f64::from))));
                let a = a.map(|end| Point3::from(end.map(f64::from)));
                let inside = |x: &[Point3<f64>; 2], y: &[Point3<f64>; 2]| {
                    (0..3).all(|i| {
                        x[0][i].min(x[1][i]) > y[0][i].min(y[1][i]) && x[0][i].max(x[1][i]) < y[0][i].max(y[1][i])
                    })
                };
                if inside(&image, &a) {
                    expected.push(((p, q), Nesting::BInA));
                    seen[0] += 1;
                } else if inside(&a, &image) {
                    expected.push(((p, q), Nesting::AInB));
                    seen[1] += 1;
                } else {
                    seen[2] += 1;
                }
            }
        }
        let (a, b) = (boxes(&mut rng, &of_a), boxes(&mut rng, &of_b));
        assert_eq!(found(&a, &b, &pose), expected, "round {round}: {of_a:?} {of_b:?}");
    }
    assert!(seen.iter().all(|&count| count > 20), "{seen:?}");
}

#[test]
fn shells_within_shells_in_any_pose() {
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    let cube = |half: i32| [[-half; 3], [half; 3]];
    let aside = [[20, -1, -1], [22, 1, 1]];
    // Three deep, by turns: 8 around 4 around 2, and a box that is outside of all.
    let (a, b) = (boxes(&mut rng, &[cube(8), cube(2), aside]), boxes(&mut rng, &[cube(4)]));
    for _ in 0..20 {
        let axis = Vector3::from([0; 3].map(|_| rng.random_range(-1.0..1.0)));
        let pose = Pose { rotation: axis_angle(axis, rng.random_range(-180.0..180.0)), translation: axis * 0.5 };
        assert_eq!(found(&a, &b, &pose), [((0, 0), Nesting::BInA), ((1, 0), Nesting::AInB)]);
    }
    // A matrix that is singular leaves a flat surface, which is around nothing.
    let flat = Pose { rotation: Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 0.0)), translation: Vector3::z() * 0.5 };
    assert_eq!(found(&a, &b, &flat), [((0, 0), Nesting::BInA)]);
}

#[test]
fn the_hole_of_a_ring_is_outside() {
    // A square ring around z: outer and inner corners, below and above.
    let corner = |half: f64, z: f64| {
        [[1, 1], [-1, 1], [-1, -1], [1, -1]].map(|[x, y]| Point3::new(f64::from(x) * half, f64::from(y) * half, z))
    };
    let vertices = [corner(3.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(3.0, 1.0)].concat();
    let square = |(strip, side): (u32, u32)| {
        let [p, q] = [side, (side + 1) % 4].map(|corner| 4 * strip + corner);
        let [s, r] = [p, q].map(|corner| (corner + 4) % 16);
        [[p, q, r], [p, r, s]]
    };
    let faces: Vec<_> = (0..4).flat_map(|strip| (0..4).map(move |side| (strip, side))).flat_map(square).collect();
    let ring = Mesh::new(vertices, faces).unwrap();
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    let small = boxes(&mut rng, &[[[-1; 3], [1; 3]]]);
    let at = |x: f64, y: f64| {
        let pose = Pose { rotation: Matrix3::identity() * 0.25, translation: Vector3::new(x, y, 0.0) };
        found(&ring, &small, &pose)
    };
    let inside = [((0, 0), Nesting::BInA)];
    assert_eq!(at(0.0, 0.0), []);
    assert_eq!(at(2.0, 0.0), inside);
    assert_eq!(at(-2.0, 2.25), inside);
    assert_eq!(at(-2.0, 0.0), inside);
    assert_eq!(at(4.0, 0.0), []);
    assert_eq!(at(1.25, 0.0), [], "it touches the wall");
}

#[test]
fn open_meshes_are_refused_with_an_edge() {
    let mut rng = ChaCha8Rng::seed_from_u64(4);
    let whole = boxes(&mut rng, &[[[0; 3], [1; 3]], [[5; 3], [7; 3]]]);
    assert_eq!(Components::new(&whole).unwrap().len(), 2);
    for missing in 0..whole.faces().len() {
        let faces: Vec<[u32; 3]> =
            (0..).zip(whole.faces()).filter(|(face, _)| *face != missing).map(|(_, f)| *f).collect();
        let open = Mesh::new(whole.vertices().to_vec(), faces).unwrap();
        let edge = Components::new(&open).unwrap_err();
        let corners = whole.triangle(missing).map(<[f64; 3]>::from);
        assert!(edge.count == 1 && edge.ends.iter().all(|end| corners.contains(end)), "{missing}: {edge}");
    }
    // Vertices that are equal are one, whatever their zeros are; two boxes that share an edge are one component, and four triangles are
    // at it.
    let apart: Vec<Point3<f64>> = whole.faces().iter().flatten().map(|&v| whole.vertices()[v as usize]).collect();
    let apart: Vec<Point3<f64>> = apart
        .iter()
        .enumerate()
        .map(|(i, v)| if i % 2 == 0 { v.map(|x| if x == 0.0 { -0.0 } else { x }) } else { *v })
        .collect();
    let faces: Vec<_> = (0..apart.len() as u32 / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    assert_eq!(Components::new(&Mesh::new(apart, faces).unwrap()).unwrap().len(), 2);
    let at_an_edge = boxes(&mut rng, &[[[0; 3], [1; 3]], [[1, 1, 0], [2, 2, 1]]]);
    assert_eq!(Components::new(&at_an_edge).unwrap().len(), 1);
    assert!(Components::new(&Mesh::default()).unwrap().is_empty());
}
