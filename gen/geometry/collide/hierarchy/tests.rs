//! Tests of k-DOP trees: combinations, realigned offsets against exact ones, and that no pair is lost.

use super::family::{Group, LANES, Members};
use super::realign::Realignment;
use super::*;
use crate::collide::pose::Pose;
use crate::collide::split::Node;
use crate::exact::{ContactKind, Exact, pair, posed_pair};
use crate::mesh::{Mesh, headlight};
use crate::power::scaled;
use crate::rounds;
use crate::scene::rotation::axis_angle;
use crate::software::interval_axes;
use nalgebra::{Matrix3, Point3, Rotation3, Vector3};
use num_bigint::BigInt;
use num_rational::Ratio;
use num_traits::float::FloatCore;
use num_traits::{Signed, Zero};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

/// Beyond it offsets are clamped.
const FAR: i32 = 1 << 28;

type Rational = Ratio<BigInt>;

fn rational(x: f64) -> Rational {
    let (mantissa, exponent, sign) = x.integer_decode();
    Rational::from_integer(BigInt::from(mantissa) * sign) * power_of_two(exponent.into())
}

fn power_of_two(exponent: i32) -> Rational {
    let one = Rational::from_integer(1.into());
    let power = Rational::from_integer(BigInt::from(1) << exponent.unsigned_abs());
    if exponent < 0 { one / power } else { power }
}

/// A mesh of `count` triangles with corners on a coarse grid around a point, so that they often touch exactly.
fn random_mesh(rng: &mut ChaCha8Rng, count: u32, scale: f64, centre: f64) -> Mesh {
    let mut corner = || Point3::from([0; 3].map(|_| (centre + f64::from(rng.random_range(-8..=8))) * scale));
    let vertices: Vec<_> = (0..3 * count).map(|_| corner()).collect();
    Mesh::new(vertices, (0..count).map(|i| [3 * i, 3 * i + 1, 3 * i + 2])).unwrap()
}

/// Quarter turns and any others, shears, and what no rotation is.
fn random_pose(rng: &mut ChaCha8Rng, round: usize, scale: f64) -> Pose {
    let axis = Vector3::from([0; 3].map(|_| rng.random_range(-1.0..1.0)));
    let rotation = match round % 6 {
        0 => Matrix3::identity(),
        1 => axis_angle(Vector3::z(), 90.0 * f64::from(rng.random_range(0..4))),
        2 => Matrix3::from_fn(|_, _| f64::from(rng.random_range(-2..=2)) * 0.75),
        3 => Matrix3::from_fn(|_, _| rng.random_range(-1.0..1.0) * [1e-3, 1.0, 1e5][rng.random_range(0..3)]),
        _ => axis_angle(axis, rng.random_range(-180.0..180.0)),
    };
    let translation = Vector3::from([0; 3].map(|_| f64::from(rng.random_range(-9..=9)) * scale));
    Pose { rotation, translation }
}

/// The offsets of one child of a family.
fn child(groups: &[Group], child: usize, k: usize) -> Vec<i32> {
    (0..k).map(|index| groups[(2 * index + child) / LANES].0[(2 * index + child) % LANES]).collect()
}

/// The d_i of each node.
fn dops(tree: &DopTree) -> Vec<Vec<i32>> {
    let groups = tree.families.len() / tree.links.len();
    let of = |family: usize| &tree.families[family * groups..][..groups];
    tree.members().iter().map(|(place, _)| child(of(place.family()), place.child(), tree.directions.count())).collect()
}

/// The offsets of each node in the frame of another tree.
fn realigned(realignment: &Realignment, tree: &DopTree) -> Vec<Vec<i32>> {
    fn families<const GROUPS: usize>(realignment: &Realignment, tree: &DopTree) -> Vec<Vec<i32>> {
        let mut out = vec![[Group::ZERO; GROUPS]; tree.links.len()];
        for (family, out) in tree.families.as_chunks().0.iter().zip(&mut out) {
            realignment.realign(family, out);
        }
        let opposite = |&(place, _): &(Members, Members)| -> Vec<i32> {
            child(&out[place.family()], place.child(), tree.directions.count())
        };
        let straight = |dop: Vec<i32>| (0..dop.len()).map(|index| dop[index ^ 1]).collect();
        tree.members().iter().map(opposite).map(straight).collect()
    }
    match tree.directions {
        Directions::Six => families::<2>(realignment, tree),
        Directions::Fourteen => families::<4>(realignment, tree),
        Directions::Eighteen => families::<5>(realignment, tree),
        Directions::TwentySix => families::<7>(realignment, tree),
    }
}

/// The triangles under each node.
fn triangles_of(tree: &DopTree) -> Vec<Vec<u32>> {
    let mut sets: Vec<Vec<u32>> = vec![vec![]; tree.len()];
    for (node, kind) in tree.nodes.iter().enumerate().rev() {
        sets[node] = match *kind {
            Node::Leaf(triangle) => vec![triangle],
            Node::Inner(right) => [sets[node + 1].clone(), sets[right as usize].clone()].concat(),
        };
    }
    sets
}

/// The corners of the triangles of a mesh as M x + t - c, exactly.
fn exact_corners(mesh: &Mesh, pose: &Pose, centre: &Point3<f64>) -> Vec<[[Rational; 3]; 3]> {
    let image = |x: Point3<f64>| {
        [0, 1, 2].map(|i| {
            (0..3).fold(rational(pose.translation[i]) - rational(centre[i]), |row, j| {
                row + rational(pose.rotation[(i, j)]) * rational(x[j])
            })
        })
    };
    (0..mesh.faces().len()).map(|face| mesh.triangle(face).map(image)).collect()
}

/// The greatest h . x of the corners of some triangles, in steps of a grid, exactly.
fn exact_offset(corners: &[[[Rational; 3]; 3]], triangles: &[u32], h: [i8; 3], exponent: i32) -> Rational {
    let corners = triangles.iter().flat_map(|&face| &corners[face as usize]);
    let along = |x: &[Rational; 3]| {
        (0..3).map(|i| &x[i] * Rational::from_integer(h[i].into())).fold(Rational::zero(), |sum, part| sum + part)
    };
    corners.map(along).max().expect("a triangle has corners") / power_of_two(exponent)
}

/// Contacts without their kinds.
fn classes((found, statistics): Contacts<ContactKind>) -> Contacts<Exact> {
    (found.into_iter().map(|(pair, kind)| (pair, kind.into())).collect(), statistics)
}

/// Realigned offsets are upper bounds, in exact arithmetic, for scales and poses of all kinds.
#[test]
fn realigned_offsets_hold_what_is_in_them() {
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    let (mut compared, mut tight) = (0, 0usize);
    for round in 0..rounds(84) {
        let scales = [1.0, 0.1, 1e-3, 1e-160, 1e150, 1e-300, 1e5];
        let (of_a, of_b) = (scales[round % 7], if round % 5 == 0 { scales[round % 4] } else { scales[round % 7] });
        let far = [0.0, 1e3, 1e9][round % 3];
        let meshes = [random_mesh(&mut rng, 3, of_a, far), random_mesh(&mut rng, 5, of_b, far)];
        let pose = random_pose(&mut rng, round, of_a);
        for set in Directions::ALL {
            let [a, b] = [0, 1].map(|mesh: usize| DopTree::new(&meshes[mesh], set));
            let realignment = Realignment::new(&a, &b, &pose);
            let seen = realigned(&realignment, &b);
            let corners = exact_corners(&meshes[1], &pose, &a.centre);
            for (node, triangles) in triangles_of(&b).iter().enumerate() {
                for (index, &offset) in seen[node].iter().enumerate().filter(|(_, offset)| **offset < FAR) {
                    let exact = exact_offset(&corners, triangles, set.vector(index), a.exponent);
                    let excess = Rational::from_integer(offset.into()) - exact;
                    assert!(!excess.is_negative(), "round {round}, {set:?}, node {node}, direction {index}");
                    compared += 1;
                    tight += usize::from(excess < Rational::from_integer(64.into()));
                }
            }
            // The offsets of A itself are those of the identity, but for the rounding.
            let corners = exact_corners(&meshes[0], &Pose::identity(), &a.centre);
            for (dop, triangles) in dops(&a).iter().zip(&triangles_of(&a)) {
                for (index, &offset) in dop.iter().enumerate() {
                    let exact = exact_offset(&corners, triangles, set.vector(index), a.exponent);
                    let excess = Rational::from_integer(offset.into()) - exact;
                    assert!(!excess.is_negative() && excess < Rational::from_integer(2.into()));
                }
            }
        }
    }
    assert!(compared > rounds(10_000) && tight * 4 > compared, "{tight} of {compared} within 64 steps");
}

/// The error of the fixed point: 2 steps and 9 * 2^(20 - places) g_B / g_A, at most 20 for rotations of equal meshes.
#[test]
fn the_error_of_the_fixed_point_is_bounded() {
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    let mesh = random_mesh(&mut rng, 6, 1.0, 0.0);
    let mut worst: f64 = 0.0;
    for _ in 0..300 {
        let axis = Vector3::from([0; 3].map(|_| rng.random_range(-1.0..1.0)));
        let translation = Vector3::from([0; 3].map(|_| rng.random_range(-9.0..9.0)));
        let pose = Pose { rotation: axis_angle(axis, rng.random_range(-180.0..180.0)), translation };
        for set in Directions::ALL {
            let tree = DopTree::new(&mesh, set);
            let realignment = Realignment::new(&tree, &tree, &pose);
            for (dop, offsets) in dops(&tree).into_iter().zip(realigned(&realignment, &tree)) {
                for (index, &offset) in offsets.iter().enumerate() {
                    let h = Vector3::from(set.vector(index).map(f64::from));
                    let terms = set.combination(&(pose.rotation.transpose() * h));
                    let sum: f64 = terms.iter().map(|&(j, factor)| factor * f64::from(dop[j])).sum();
                    let centre = pose.rotation * tree.centre.coords + translation - tree.centre.coords;
                    let real = sum + scaled(h.dot(&centre), -tree.exponent);
                    worst = worst.max(f64::from(offset) - real);
                }
            }
        }
    }
    assert!(worst > 0.5 && worst < 21.0, "{worst} steps");
}

/// Against brute force: every pair that touches, exactly, is found with every set of directions.
#[test]
fn no_pair_of_touching_triangles_is_lost() {
    let mut rng = ChaCha8Rng::seed_from_u64(4);
    let mut scratch = Scratch::default();
    let (mut touching, mut found_in_all) = (0, 0);
    for round in 0..60 {
        let scale = [1.0, 0.1, 1e-3, 1e-160, 1e100][round % 5];
        let [a, b] = [0, 1].map(|_| random_mesh(&mut rng, 10, scale, [0.0, 64.0][round % 2]));
        let pose = random_pose(&mut rng, round, scale);
        let m = pose.rows();
        let corners = |mesh: &Mesh, face: usize| mesh.triangle(face).map(<[f64; 3]>::from);
        let all = (0..10u32).flat_map(|p| (0..10u32).map(move |q| (p, q)));
        let touch = |&(p, q): &(u32, u32)| {
            let (x, y) = (corners(&a, p as usize), corners(&b, q as usize));
            posed_pair(&x, &y, &m, &pose.translation.into()).unwrap()
        };
        let all = all.map(|pair| (pair, touch(&pair)));
        let exact: Vec<((u32, u32), Exact)> = all.filter(|(_, exact)| *exact != Exact::Separate).collect();
        let expected: Vec<(u32, u32)> = exact.iter().map(|(pair, _)| *pair).collect();
        for set in Directions::ALL {
            let trees = [&a, &b].map(|mesh| DopTree::new(mesh, set));
            let (found, statistics) = pairs(&trees[0], &trees[1], &pose, &mut scratch);
            assert!(found.windows(2).all(|w| w[0] < w[1]));
            assert_eq!(statistics.pairs_tested, found.len() as u64);
            let (touching, took) = classes(contacts([&a, &b], [&trees[0], &trees[1]], &pose, &mut scratch));
            assert_eq!((&touching, took), (&exact, statistics), "round {round}, {set:?}");
            let rounded = rounded_contacts([&a, &b], [&trees[0], &trees[1]], &pose, &mut scratch).unwrap().0;
            let test = |&(p, q): &(u32, u32)| {
                let y = corners(&b, q as usize).map(|x| pose.image(&x.into()).into());
                let [[x0, x1, x2], [y0, y1, y2]] = [corners(&a, p as usize), y];
                ((p, q), pair(&[x0, x1, x2, y0, y1, y2]).unwrap())
            };
            assert!(found.iter().map(test).filter(|(_, exact)| *exact != Exact::Separate).eq(rounded));
            for pair in &expected {
                assert!(found.binary_search(pair).is_ok(), "round {round}, {set:?}: {pair:?}");
            }
            found_in_all += found.len();
        }
        touching += expected.len();
    }
    assert!(touching > 300, "{touching} pairs touch");
    assert!(found_in_all < 4 * 60 * 100 * 2 / 3, "and not simply all pairs are found: {found_in_all}");
}

/// Small triangles that meet in a corner but for a unit in the last place or two: their rounded images tell it with certainty, and often
/// wrongly.
#[test]
fn what_rounding_of_the_pose_moves_is_known() {
    let mut rng = ChaCha8Rng::seed_from_u64(11);
    let mut scratch = Scratch::default();
    let mut misled = 0;
    for _ in 0..2000 {
        let [roll, pitch, yaw] = [0; 3].map(|_| rng.random_range(-3.0..3.0));
        let rotation = Rotation3::from_euler_angles(roll, pitch, yaw).into_inner();
        let vector = |rng: &mut ChaCha8Rng| Vector3::from_fn(|_, _| rng.random_range(0.5..1.0));
        let pose = Pose { rotation, translation: vector(&mut rng) };
        let corner = Point3::from(vector(&mut rng));
        let size = 2f64.powi(-20);
        let gap = Vector3::x() * f64::from(rng.random_range(-2..=2)) * f64::EPSILON;
        let mesh = |corner: Point3<f64>, sides: [Vector3<f64>; 2]| {
            Mesh::new(vec![corner, corner + sides[0], corner + sides[1]], vec![[0, 1, 2]]).unwrap()
        };
        let sides = [[1.0, 0.5, 0.0], [1.0, -0.5, 0.25]].map(|side| Vector3::from(side) * size);
        let a = mesh(pose.image(&corner) + gap, sides);
        let sides =
            [[-1.0, 0.25, 0.5], [-1.0, -0.25, -0.75]].map(|side| rotation.transpose() * Vector3::from(side) * size);
        let b = mesh(corner, sides);
        let [x, y] = [&a, &b].map(|mesh| mesh.triangle(0).map(<[f64; 3]>::from));
        let truth = posed_pair(&x, &y, &pose.rows(), &pose.translation.into()).unwrap();
        let trees = [&a, &b].map(|mesh| DopTree::new(mesh, Directions::Six));
        let found = classes(contacts([&a, &b], [&trees[0], &trees[1]], &pose, &mut scratch)).0;
        let due: &[((u32, u32), Exact)] = if truth == Exact::Separate { &[] } else { &[((0, 0), truth)] };
        assert_eq!(found, due, "{pose:?} {a:?} {b:?}");
        let [y0, y1, y2] = b.triangle(0).map(|y| pose.image(&y).into());
        misled +=
            usize::from(interval_axes::decide(&[x[0], x[1], x[2], y0, y1, y2]).is_some_and(|found| found != truth));
    }
    assert!(misled > 100, "{misled} of 2,000 would be wrong without the error of the pose");
}

#[test]
fn the_first_hit_ends_the_query() {
    let mesh = headlight();
    let tree = DopTree::new(&mesh, Directions::Eighteen);
    let pose = Pose { rotation: axis_angle(Vector3::y(), 20.0), translation: Vector3::new(0.0, 0.0, 60.0) };
    let mut scratch = Scratch::default();
    let (all, whole) = pairs(&tree, &tree, &pose, &mut scratch);
    assert!(all.len() > 1000);
    assert!(whole.transforms <= tree.len() as u64 && whole.transforms < whole.overlap_tests);
    assert!(whole.nodes_visited <= whole.overlap_tests && whole.pairs_tested < whole.nodes_visited);
    let wanted = all[all.len() / 2];
    let (hit, part) = first_hit(&tree, &tree, &pose, &mut scratch, |pair| pair == wanted);
    assert_eq!(hit, Some(wanted));
    assert!(part.pairs_tested < whole.pairs_tested && part.overlap_tests < whole.overlap_tests);
    let (hit, none) = first_hit(&tree, &tree, &pose, &mut scratch, |_| false);
    assert_eq!((hit, none), (None, whole));
}

#[test]
fn meshes_without_triangles_and_of_one_point_have_trees() {
    let (empty, one) = (Mesh::default(), Mesh::new(vec![Point3::new(3.0, 0.1, -7.0)], vec![[0; 3]]).unwrap());
    for set in Directions::ALL {
        let [none, point] = [&empty, &one].map(|mesh| DopTree::new(mesh, set));
        assert!(none.is_empty() && point.len() == 1);
        let mut scratch = Scratch::default();
        let mut count = |a, b, pose| pairs(a, b, &pose, &mut scratch).0.len();
        assert_eq!(count(&none, &point, Pose::identity()), 0);
        assert_eq!(count(&point, &none, Pose::identity()), 0);
        assert_eq!(count(&point, &point, Pose::identity()), 1);
        let away = Pose { translation: Vector3::new(1e-9, 0.0, 0.0), ..Pose::identity() };
        assert_eq!(count(&point, &point, away), 0);
    }
}

/// Entries whose sums are beyond the numbers, beside entries of any size, and triangles of B that are as small as that takes. Every
/// row may have a scale of its own, and so have A and the translation along that axis.
#[test]
fn no_pair_is_lost_where_sums_of_entries_overflow() {
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    let mut scratch = Scratch::default();
    let (mut touching, mut lost, mut overflowing) = (0, vec![], 0);
    for round in 0..rounds(20_000) {
        // B has a size of 2^-exponent, and M one of 2^exponent but for the factors of rows.
        let exponent = [1023, 1022, 1000, 600, 0, -900][round % 6];
        let rows = [0; 3].map(|_| if rng.random_range(0..4) == 0 { rng.random_range(-60..=0) } else { 0 });
        let entry = |rng: &mut ChaCha8Rng, row: usize| match rng.random_range(0..8) {
            0 => 0.0,
            1 => scaled(1.0, rng.random_range(-1022..=exponent)),
            _ => {
                let sign = if rng.random() { 1.0 } else { -1.0 };
                sign * scaled(rng.random_range(1.0..2.0), exponent + rows[row])
            }
        };
        let rotation = Matrix3::from_fn(|row, _| entry(&mut rng, row));
        let mut whole = |most: i32| f64::from(rng.random_range(-most..=most));
        let translation = Vector3::from_fn(|row, _| scaled(whole(4), rows[row]));
        let mesh = |corners: [Point3<f64>; 6]| Mesh::new(corners, vec![[0, 1, 2], [3, 4, 5]]).unwrap();
        let a = mesh([(); 6].map(|()| Point3::from([0, 1, 2].map(|row| scaled(whole(5), rows[row])))));
        let b = mesh([(); 6].map(|()| Point3::from([0; 3].map(|_| scaled(whole(2), -exponent)))));
        let pose = Pose { rotation, translation };
        overflowing += usize::from(!(rotation.transpose().abs() * Vector3::repeat(1.0)).max().is_finite());
        let due: Vec<((u32, u32), Exact)> = (0..4u32)
            .map(|pair| (pair >> 1, pair & 1))
            .map(|(p, q)| {
                let [x, y] = [(&a, p), (&b, q)].map(|(mesh, face)| mesh.triangle(face as usize).map(<[f64; 3]>::from));
                ((p, q), posed_pair(&x, &y, &pose.rows(), &pose.translation.into()).unwrap())
            })
            .filter(|(_, exact)| *exact != Exact::Separate)
            .collect();
        touching += due.len();
        for set in Directions::ALL {
            let trees = [&a, &b].map(|mesh| DopTree::new(mesh, set));
            let found = classes(contacts([&a, &b], [&trees[0], &trees[1]], &pose, &mut scratch)).0;
            if found != due {
                lost.push(format!("{set:?}, {pose:?}, {a:?}, {b:?}: {found:?}, expected {due:?}"));
            }
        }
    }
    assert!(
        touching > rounds(5_000) && overflowing > rounds(3_000),
        "{touching} pairs touch, {overflowing} poses overflow"
    );
    assert!(lost.is_empty(), "{} queries, the first: {}", lost.len(), lost[0]);
}
