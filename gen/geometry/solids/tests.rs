//! Tests of solids: bodies of unit cubes and tetrahedra on coarse grids, where corners, edges and faces meet all the time, against cubes
//! compared one by one and separating axes; and situations that users of other programs reported.

use super::*;
use crate::mesh::Mesh;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

type Vector = [i64; 3];

/// The surface of some unit cubes of a grid, by their least corners, with diagonals as they come, mapped by a matrix in rows.
fn cubes(rng: &mut ChaCha8Rng, cells: &[Vector], map: &[Vector; 3]) -> Mesh {
    let mut triangles = vec![];
    for cell in cells {
        for (axis, end) in (0..3).flat_map(|axis| [(axis, 0), (axis, 1)]) {
            let mut beside = *cell;
            beside[axis] += 2 * end - 1;
            if cells.contains(&beside) {
                continue;
            }
            let [j, k] = [(axis + 1) % 3, (axis + 2) % 3];
            let mut square = [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[u, v]| {
                let mut corner = *cell;
                corner[axis] += end;
                corner[j] += u;
                corner[k] += v;
                mapped(map, corner).map(|x| x as f64)
            });
            if end == 0 {
                square.reverse();
            }
            square.rotate_left(rng.random_range(0..4));
            let [p, q, r, s] = square;
            triangles.extend([[p, q, r], [p, r, s]]);
        }
    }
    Mesh::from_triangles(triangles).unwrap()
}

fn mapped(map: &[Vector; 3], x: Vector) -> Vector {
    map.map(|row| row[0] * x[0] + row[1] * x[1] + row[2] * x[2])
}

/// Cells of two by two by two that hang together by whole sides.
fn some_cells(rng: &mut ChaCha8Rng) -> Vec<Vector> {
    let mut cells = vec![[0; 3].map(|_: i64| rng.random_range(0..2))];
    for _ in 0..rng.random_range(0..7) {
        let mut next: Vector = cells[rng.random_range(0..cells.len())];
        next[rng.random_range(0..3)] = rng.random_range(0..2);
        if !cells.contains(&next) {
            cells.push(next);
        }
    }
    cells
}

#[test]
fn bodies_of_cubes_lie_as_their_cubes_do() {
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    let mut seen = [0; 3];
    let maps = [
        [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
        [[1, 1, 0], [0, 1, 0], [0, 0, 1]],
        [[2, 1, 0], [-1, 3, 1], [0, 1, 1]],
        [[0, 0, 1], [1, 0, 0], [0, 1, 0]],
    ];
    for round in 0..600 {
        let map = &maps[round % maps.len()];
        let cells = [some_cells(&mut rng), some_cells(&mut rng)];
        let meshes = [0, 1].map(|side| cubes(&mut rng, &cells[side], map));
        let halves = [0; 3].map(|_: i64| rng.random_range(-3..=3));
        // Of a pair of cubes, how far the one that reaches further is beyond the other, in half units.
        let between = |p: &Vector, q: &Vector| {
            (0..3).map(|i| (2 * q[i] + halves[i] - 2 * p[i]).abs()).max().expect("there are three axes")
        };
        let nearest = cells[0].iter().flat_map(|p| cells[1].iter().map(move |q| between(p, q))).min().unwrap();
        let due = match nearest {
            0 | 1 => Solids::Overlap,
            2 => Solids::Abut,
            _ => Solids::Apart,
        };
        let t = mapped(map, halves).map(|x| x as f64 / 2.0);
        let solids = meshes.map(|mesh| Solid::new(mesh).unwrap());
        let found = solids[0].beside(&solids[1], &Pose::moved(t).unwrap()).unwrap();
        assert_eq!(found, due, "round {round}: {cells:?}, {halves:?}, {map:?}");
        let back = Pose::moved(t.map(|x| -x)).unwrap();
        assert_eq!(solids[1].beside(&solids[0], &back).unwrap(), due, "round {round}, exchanged");
        seen[due as usize] += 1;
    }
    assert!(seen.iter().all(|count| *count > 40), "{seen:?}");
}

fn minus(p: Vector, q: Vector) -> Vector {
    [0, 1, 2].map(|i| p[i] - q[i])
}

fn product(p: Vector, q: Vector) -> Vector {
    [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
}

fn along(n: Vector, x: Vector) -> i64 {
    n[0] * x[0] + n[1] * x[1] + n[2] * x[2]
}

const SIDES: [[usize; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];

/// By the theorem of separating axes: some normal of a side or product of two edges shows that convex bodies are apart, or their insides.
fn by_axes(a: &[Vector; 4], b: &[Vector; 4]) -> Solids {
    let edges = |x: &[Vector; 4]| [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)].map(|(i, j)| minus(x[j], x[i]));
    let normals = |x: &[Vector; 4]| SIDES.map(|[i, j, k]| product(minus(x[j], x[i]), minus(x[k], x[i])));
    let products = edges(a).into_iter().flat_map(|e| edges(b).map(|f| product(e, f)));
    let axes = normals(a).into_iter().chain(normals(b)).chain(products).filter(|n| *n != [0; 3]);
    let mut gaps = axes.map(|n| {
        let ends = |x: &[Vector; 4]| {
            let places = x.map(|x| along(n, x));
            (places.into_iter().min().unwrap(), places.into_iter().max().unwrap())
        };
        let ((p, q), (r, s)) = (ends(a), ends(b));
        (r - q).max(p - s)
    });
    match gaps.try_fold(i64::MIN, |most, gap| if gap > 0 { None } else { Some(most.max(gap)) }) {
        None => Solids::Apart,
        Some(0) => Solids::Abut,
        Some(_) => Solids::Overlap,
    }
}

#[test]
fn tetrahedra_lie_as_separating_axes_say() {
    let mut rng = ChaCha8Rng::seed_from_u64(6);
    let mut seen = [0; 3];
    for round in 0..3_000 {
        let mut tetrahedron = || loop {
            let [p, q, r, s] = [[(); 3]; 4].map(|x| x.map(|()| rng.random_range(0..4i64)));
            let volume = along(product(minus(q, p), minus(r, p)), minus(s, p));
            if volume != 0 {
                return if volume > 0 { [p, q, r, s] } else { [p, r, q, s] };
            }
        };
        let (a, b) = (tetrahedron(), tetrahedron());
        let mesh = |x: [Vector; 4]| {
            let corners = x.map(|x| x.map(|x| x as f64));
            Solid::new(Mesh::new(corners, SIDES.map(|side| side.map(|corner| corner as u32))).unwrap()).unwrap()
        };
        let due = by_axes(&a, &b);
        let found = mesh(a).beside(&mesh(b), &Pose::identity());
        assert_eq!(found, Ok(due), "round {round}: {a:?} {b:?}");
        // Mirrored, with a pose that turns it back.
        let mirror = |x: Vector| [-x[0], x[1], x[2]];
        let [p, q, r, s] = b.map(mirror);
        let back = Pose::from_rows([[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], [0.0; 3]).unwrap();
        assert_eq!(mesh(a).beside(&mesh([p, r, q, s]), &back), Ok(due), "round {round}, mirrored");
        seen[due as usize] += 1;
    }
    assert!(seen.iter().all(|count| *count > 200), "{seen:?}");
}

/// A box, its sides from the first corner to the second.
fn cuboid(least: [f64; 3], greatest: [f64; 3]) -> Mesh {
    let ends = [least, greatest];
    let corners = (0..8).map(|corner: usize| [0, 1, 2].map(|axis| ends[corner >> axis & 1][axis]));
    let sides = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    Mesh::new(corners, sides.into_iter().flat_map(|[p, q, r, s]| [[p, q, r], [p, r, s]])).unwrap()
}

/// Two meshes as one.
fn joined(a: &Mesh, b: &Mesh) -> Mesh {
    let first = a.vertices().len() as u32;
    let faces = a.faces().iter().copied().chain(b.faces().iter().map(|face| face.map(|vertex| vertex + first)));
    Mesh::new(a.vertices().iter().chain(b.vertices()).copied(), faces).unwrap()
}

/// Its triangles turned around: a cavity.
fn inside_out(mesh: &Mesh) -> Mesh {
    Mesh::new(mesh.vertices().iter().copied(), mesh.faces().iter().map(|[p, q, r]| [*p, *r, *q])).unwrap()
}

fn lie(a: &Mesh, b: &Mesh) -> Solids {
    Solid::new(a).unwrap().beside(&Solid::new(b).unwrap(), &Pose::identity()).unwrap()
}

#[test]
fn boxes_face_to_face_abut() {
    let unit = cuboid([0.0; 3], [1.0; 3]);
    assert_eq!(lie(&unit, &cuboid([1.0, 0.0, 0.0], [2.0, 1.0, 1.0])), Solids::Abut);
    // Shifted, larger, at an edge, at a corner.
    assert_eq!(lie(&unit, &cuboid([1.0, 0.3, 0.3], [2.0, 1.7, 0.6])), Solids::Abut);
    assert_eq!(lie(&unit, &cuboid([1.0, -1.0, -1.0], [2.0, 2.0, 2.0])), Solids::Abut);
    assert_eq!(lie(&unit, &cuboid([1.0, 1.0, 0.0], [2.0, 2.0, 1.0])), Solids::Abut);
    assert_eq!(lie(&unit, &cuboid([1.0; 3], [2.0; 3])), Solids::Abut);
    // Into it by one step, and off it by one.
    assert_eq!(lie(&unit, &cuboid([1.0f64.next_down(), 0.0, 0.0], [2.0, 1.0, 1.0])), Solids::Overlap);
    assert_eq!(lie(&unit, &cuboid([1.0f64.next_up(), 0.0, 0.0], [2.0, 1.0, 1.0])), Solids::Apart);
    // Aligned so that no triangles cross: through it, with its sides in the same planes.
    assert_eq!(lie(&unit, &cuboid([0.25, -1.0, 0.0], [0.75, 2.0, 1.0])), Solids::Overlap);
    assert_eq!(lie(&unit, &unit), Solids::Overlap);
}

#[test]
fn a_box_beside_a_wall_overlaps_only_beyond_it() {
    let wall = cuboid([-5.0, -5.0, -0.2], [5.0, 5.0, 0.1]);
    let beside = |z: f64| lie(&wall, &cuboid([0.0, 0.0, z], [1.0, 1.0, z + 1.0]));
    assert_eq!(beside(0.1), Solids::Abut);
    assert_eq!(beside(0.1f64.next_up()), Solids::Apart);
    assert_eq!(beside(0.1f64.next_down()), Solids::Overlap);
}

#[test]
fn a_beam_fits_its_pocket() {
    // A wall with a pocket: cells of a grid, so that sides are whole; the beam ends in the pocket.
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    let one = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
    let cells =
        (0..27).map(|cell| [cell % 3, cell / 3 % 3, cell / 9]).filter(|cell| ![[1, 1, 1], [1, 1, 2]].contains(cell));
    let wall = cubes(&mut rng, &cells.collect::<Vec<_>>(), &one);
    let beam = |z: f64, width: f64| cuboid([1.5 - width, 1.5 - width, z], [1.5 + width, 1.5 + width, 9.0]);
    assert_eq!(lie(&wall, &beam(1.0, 0.5)), Solids::Abut);
    assert_eq!(lie(&wall, &beam(1.0f64.next_down(), 0.5)), Solids::Overlap);
    assert_eq!(lie(&wall, &beam(1.0, 0.5f64.next_up())), Solids::Overlap);
    assert_eq!(lie(&wall, &beam(1.5, 0.25)), Solids::Apart);
    assert_eq!(lie(&wall, &beam(1.5, 0.5)), Solids::Abut);
}

#[test]
fn what_is_inside_overlaps_and_what_is_in_a_cavity_does_not() {
    let (outer, inner, core) = (cuboid([0.0; 3], [9.0; 3]), cuboid([1.0; 3], [8.0; 3]), cuboid([2.0; 3], [3.0; 3]));
    assert_eq!([lie(&outer, &core), lie(&core, &outer)], [Solids::Overlap; 2]);
    // From inside at a corner, at a side.
    assert_eq!(lie(&outer, &cuboid([0.0; 3], [1.0; 3])), Solids::Overlap);
    assert_eq!(lie(&outer, &cuboid([0.0, 2.0, 2.0], [1.0, 3.0, 3.0])), Solids::Overlap);
    let hollow = joined(&outer, &inside_out(&inner));
    assert_eq!([lie(&hollow, &core), lie(&core, &hollow)], [Solids::Apart; 2]);
    // It fills the cavity, it lies in a corner of it, it sticks out of it.
    assert_eq!(lie(&hollow, &inner), Solids::Abut);
    assert_eq!(lie(&hollow, &cuboid([1.0; 3], [2.0; 3])), Solids::Abut);
    assert_eq!(lie(&hollow, &cuboid([0.5; 3], [2.0; 3])), Solids::Overlap);
    // Another one in the cavity, with something in its material.
    let nested = joined(&hollow, &cuboid([3.0; 3], [6.0; 3]));
    assert_eq!(lie(&nested, &cuboid([4.0; 3], [5.0; 3])), Solids::Overlap);
    assert_eq!(lie(&nested, &cuboid([2.0; 3], [7.0; 3])), Solids::Overlap);
    assert_eq!(lie(&nested, &core), Solids::Abut);
}

#[test]
fn what_is_no_solid_is_refused() {
    let unit = cuboid([0.0; 3], [1.0; 3]);
    let with = |mesh: &Mesh| Solid::new(mesh).unwrap_err();
    let open = Mesh::new(unit.vertices().to_vec(), unit.faces()[1..].to_vec()).unwrap();
    assert!(matches!(with(&open), NotSolid::Open(_)));
    let mut faces = unit.faces().to_vec();
    faces[5].swap(0, 1);
    let turned = Mesh::new(unit.vertices().to_vec(), faces).unwrap();
    assert_eq!(
        with(&turned).to_string(),
        "triangle 0 has an edge in the direction of another one: expected neighbours that turn alike"
    );
    assert_eq!(with(&inside_out(&unit)), NotSolid::InsideOut { component: 0 });
    let twice = joined(&unit, &cuboid([0.5; 3], [2.0; 3]));
    assert!(matches!(with(&twice), NotSolid::Intersects(_)));
    let nested = joined(&cuboid([-1.0; 3], [2.0; 3]), &unit);
    assert_eq!(with(&nested), NotSolid::InsideOut { component: 1 });
    let flat = Pose::from_rows([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]], [0.0; 3]).unwrap();
    let unit = Solid::new(&unit).unwrap();
    assert_eq!(unit.beside(&unit, &flat), Err(NotSolid::Flat));
}
