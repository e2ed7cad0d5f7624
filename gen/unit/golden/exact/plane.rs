//! Pairs in one plane or on one line (section 5 of docs/exact.md).

use super::verdict::Position;
use crate::golden::determinants::differences::Points;
use crate::golden::determinants::moments::Moments;
use crate::golden::determinants::number::{Number, Vector, cross};
use crate::golden::interval::three;

/// The third level of products. They are formed for every pair, whether or not it is in one plane.
#[derive(Clone, Copy, Debug)]
pub(super) enum Components {
    /// Some moment is not 0.
    Plane {
        /// c, the first coordinate in which one is not.
        along: usize,
        /// x_il, component c of v_i x w_l, `[i - 1][l]`.
        x: [[i64; 3]; 2],
    },
    /// u, of triangles that are each on a line through V0.
    Lines(Vector),
}

impl Components {
    pub fn new(points: &Points, Moments { m, n }: &Moments) -> Self {
        let Points { v, w } = points;
        match (0..3).find(|&j| m.iter().chain([n]).any(|moment| moment[j] != 0)) {
            Some(along) => Self::Plane { along, x: [0, 1].map(|i| three(|l| cross(&v[i], &w[l])[along])) },
            None => Self::Lines(cross(&first(v), &first(w))),
        }
    }

    /// The six numbers as they leave the multipliers.
    pub fn products(&self, Points { v, w }: &Points) -> [i64; 6] {
        let [[x0, x1, x2], [x3, x4, x5]] = match *self {
            Self::Plane { x, .. } => x,
            Self::Lines(u) => [u, three(|l| cross(&v[1], &w[l])[0])],
        };
        [x0, x1, x2, x3, x4, x5]
    }

    /// How a pair lies whose six points are in one plane.
    pub fn position<N: Number>(&self, points: &Points, moments: &Moments) -> Position {
        let boxes = Boxes::new(points);
        let (separate, inside, agree) = match self {
            Self::Plane { along, x } => {
                let edges = Edges::new::<N>(*along, x, moments);
                (edges.part || boxes.apart, !edges.nearly_part && !boxes.nearly_apart, edges.agree)
            }
            Self::Lines([0, 0, 0]) => (boxes.apart, !boxes.nearly_apart, false),
            Self::Lines(_) => {
                let (separate, inside) = at_v0(points);
                (separate, inside, false)
            }
        };
        let crosses = inside && !separate;
        Position { separate, crosses, alike: crosses && agree }
    }
}

/// The first vector that is not 0, or 0.
fn first(vectors: &[Vector]) -> Vector {
    vectors.iter().copied().find(|x| *x != [0; 3]).unwrap_or_default()
}

/// Of segments on two lines that meet in V0 alone: whether they are separate, and whether V0 is inside both.
fn at_v0(points: &Points) -> (bool, bool) {
    let along = three(|j| points.along(j));
    let holds_0 = |&[_, _, x, y, z]: &[i64; 5]| x.min(y).min(z) <= 0 && x.max(y).max(z) >= 0;
    let inside_a = along.iter().any(|&[x, y, ..]| x.signum() * y.signum() == -1);
    let inside_b = along.iter().any(|&[_, _, x, y, z]| x.min(y).min(z) < 0 && x.max(y).max(z) > 0);
    (!along.iter().all(holds_0), inside_a && inside_b)
}

/// What the boxes of the triangles say.
struct Boxes {
    apart: bool,
    /// Some coordinate plane that does not hold both triangles has one of them on each side, or in itself.
    nearly_apart: bool,
}

impl Boxes {
    fn new(points: &Points) -> Self {
        let ranges = three(|j| {
            let [v1, v2, w0, w1, w2] = points.along(j);
            [[0.min(v1).min(v2), 0.max(v1).max(v2)], [w0.min(w1).min(w2), w0.max(w1).max(w2)]]
        });
        let apart = |[a, b]: &[[i64; 2]; 2]| a[1] < b[0] || b[1] < a[0];
        let point = |[a, b]: &[[i64; 2]; 2]| a == b && a[0] == a[1];
        let nearly_apart = |range: &[[i64; 2]; 2]| {
            let [a, b] = range;
            (a[1] <= b[0] || b[1] <= a[0]) && !point(range)
        };
        Self { apart: ranges.iter().any(apart), nearly_apart: ranges.iter().any(nearly_apart) }
    }
}

/// What the six edges say, in the projection along a coordinate.
struct Edges {
    part: bool,
    nearly_part: bool,
    /// Both areas have one sign.
    agree: bool,
}

impl Edges {
    fn new<N: Number>(along: usize, x: &[[i64; 3]; 2], Moments { m, n }: &Moments) -> Self {
        let [x1, x2] = x.map(|x| x.map(N::from));
        let (m, n) = (m.map(|m| N::from(m[along])), N::from(n[along]));
        let (area, zero) = (m[0] + m[1] + m[2], N::from(0));
        let of_a = [x1, three(|l| n + x2[l] - x1[l]), three(|l| -x2[l])].map(|x| (x, n));
        let of_b = three(|l| {
            let next = (l + 1) % 3;
            ([m[l], m[l] + x1[l] - x1[next], m[l] + x2[l] - x2[next]], area)
        });
        let edges = || of_a.iter().chain(&of_b);
        Self {
            part: edges().any(|(x, area)| parts(x, *area)),
            nearly_part: edges().any(|(x, area)| nearly_parts(x, *area)),
            agree: (n > zero && area > zero) || (n < zero && area < zero),
        }
    }
}

/// Whether an edge has its own triangle on one side or on itself, and the other triangle strictly on the other side.
fn parts<N: Number>(x: &[N; 3], area: N) -> bool {
    let zero = N::from(0);
    (x.iter().all(|x| *x < zero) && area >= zero) || (x.iter().all(|x| *x > zero) && area <= zero)
}

/// Whether an edge has the triangles on different sides or on itself, but not both on itself.
fn nearly_parts<N: Number>(x: &[N; 3], area: N) -> bool {
    let zero = N::from(0);
    let apart = (x.iter().all(|x| *x <= zero) && area >= zero) || (x.iter().all(|x| *x >= zero) && area <= zero);
    apart && (x.iter().any(|x| *x != zero) || area != zero)
}
