//! The exact unit against the oracle: not a definite answer that is right, but the same answer for every pair that fits.

use rand::rngs::ChaCha8Rng;
use rand::seq::IndexedRandom;
use rand::{RngExt, SeedableRng};

use crate::golden::{Golden, Input, Outcome, Pair, Pose, Verdict};
use crate::params::{Method, Params};
use efsat_geometry::exact::{self, Exact, Relation};

type Point = [i64; 3];
type Points = [Point; 6];

/// Both triangles as the unit reads them.
fn read(points: &Points) -> Pair {
    let at = |i: usize| points[i].map(Input::exact);
    Pair { a: [at(0), at(1), at(2)], b: [at(3), at(4), at(5)] }
}

/// What the oracle says.
fn truth(points: &Points) -> Relation {
    exact::relation(&points.map(|point| point.map(|x| x as f64)))
}

/// The unit that takes differences of `width` bits.
fn golden(width: u32) -> Golden {
    let p = Params { width, transform_width: width + 4, ..Params::of(Method::Exact) };
    p.validate().unwrap();
    Golden::new(&p)
}

fn outcome(golden: &Golden, points: &Points) -> Outcome {
    let p = Params::of(Method::Exact);
    golden.outcome(&Pose::identity(&p), &read(points))
}

/// The verdict, whether the triangles cross, and whether they are in one plane, all as the oracle says.
fn check(golden: &Golden, points: &Points) -> Relation {
    let (truth, outcome) = (truth(points), outcome(golden, points));
    let verdict = if truth.class == Exact::Separate { Verdict::Separate } else { Verdict::Intersect };
    let expected = (verdict, truth.class == Exact::Intersect, truth.coplanar, false);
    let found = (outcome.verdict, outcome.overlapping & 1 != 0, outcome.overlapping & 2 != 0, outcome.outside);
    assert_eq!(found, expected, "{points:?}: {truth}, {outcome:?}");
    truth
}

/// How often each answer came, to see that a test has all kinds of pairs.
#[derive(Debug, Default)]
struct Seen {
    /// Not in one plane, in one plane; separate, touch, intersect.
    classes: [[u64; 3]; 2],
}

impl Seen {
    fn add(&mut self, truth: Relation) {
        self.classes[usize::from(truth.coplanar)][truth.class as usize] += 1;
    }

    fn all(&self) -> impl Iterator<Item = u64> {
        self.classes.into_iter().flatten()
    }
}

/// Points of a small lattice, in families in which most pairs are degenerate in some way.
fn small(rng: &mut ChaCha8Rng) -> Points {
    let reach = rng.random_range(1..=3);
    let within = |rng: &mut ChaCha8Rng| rng.random_range(-reach..=reach);
    let any = |rng: &mut ChaCha8Rng| [(); 3].map(|()| within(rng));
    let [origin, x, y] = [(); 3].map(|()| any(rng));
    let family = rng.random_range(0..8);
    let mut points = [(); 6].map(|()| match family {
        // One coordinate plane.
        0 => [within(rng), within(rng), 0],
        // One slanted plane, or a line.
        1 | 2 => {
            let (u, v) = (within(rng), if family == 1 { within(rng) } else { 0 });
            [0, 1, 2].map(|j| origin[j] + u * x[j] + v * y[j])
        }
        _ => any(rng),
    });
    match family {
        // Two lines through a point, or through the points of a parallelogram.
        3 => {
            let apart = *[[0; 3], y].choose(rng).unwrap();
            for (i, point) in points.iter_mut().enumerate() {
                let (along, shift) = if i < 3 { (x, [0; 3]) } else { (y, apart) };
                let u = within(rng);
                *point = [0, 1, 2].map(|j| origin[j] + shift[j] + u * along[j]);
            }
        }
        // Common vertices.
        4 => {
            for _ in 0..rng.random_range(1..=3) {
                points[rng.random_range(3..6)] = points[rng.random_range(0..3)];
            }
        }
        // Segments and points.
        5 => {
            for _ in 0..rng.random_range(1..=3) {
                let (to, from) = *[(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3)].choose(rng).unwrap();
                points[to] = points[from];
            }
        }
        // One triangle in a line with points of the other.
        6 => points[5] = [0, 1, 2].map(|j| 2 * points[rng.random_range(0..2)][j] - points[4][j]),
        _ => {}
    }
    points
}

#[test]
fn every_pair_of_a_small_lattice_is_right() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let golden = golden(7);
    let mut seen = Seen::default();
    for _ in 0..200_000 {
        seen.add(check(&golden, &small(&mut rng)));
    }
    assert!(seen.all().all(|count| count > 2000), "{seen:?}");
}
