//! Polygons as triangles.
//!
//! A polygon is looked at along one of the coordinate axes: that along which its area, as binary64 has it, is greatest; if it
//! is not simple seen from there, the next. Every decision is the exact sign of a determinant. What is returned tiles the
//! projection: no two triangles overlap in it, so none meet in space but in their common corners and edges, whether or not the
//! corners are in one plane.
//!
//! Why it tiles: cutting off an ear keeps the sum of the areas as chains, so the triangles cover every point as often as the
//! polygon winds around it. All triangles have one orientation, so each point is covered by as many triangles as the winding
//! number says. If no two overlap, that is 0 or 1 everywhere, which is what a simple polygon is, also one that touches itself.

use nalgebra::Point3;
use num_bigint::{BigInt, Sign};
use robust::{Coord, Coord3D, orient2d, orient3d};
use std::collections::VecDeque;

/// The most corners of a polygon: the time taken grows with the square of their number.
pub(super) const MOST: usize = 1 << 14;

/// What a polygon became.
pub(super) struct Triangulation {
    /// Places of corners in the list given.
    pub triangles: Vec<[usize; 3]>,
    /// How far a corner is from the plane of the others, about, if they are not exactly in one plane.
    pub off: Option<f64>,
}

/// The triangles of a polygon of three or more corners that are finite: a triangle as it is, others without corners that
/// repeat the one before. None for a polygon that is not simple along any axis.
pub(super) fn triangulate(corners: &[Point3<f64>]) -> Option<Triangulation> {
    let distinct = distinct(corners);
    if let [p, q, r] = distinct[..] {
        return Some(Triangulation { triangles: vec![[p, q, r]], off: None });
    }
    if distinct.len() < 3 {
        return None;
    }
    let (points, power) = scaled(&distinct.iter().map(|&i| corners[i]).collect::<Vec<_>>());
    let exact = Exact::of(&points);
    let normal = area(&points);
    let mut axes = [0, 1, 2];
    axes.sort_by(|&x, &y| normal[y].abs().total_cmp(&normal[x].abs()));
    let tiled = axes.into_iter().find_map(|axis| {
        let (x, y) = ((axis + 1) % 3, (axis + 2) % 3);
        let orientation = 1f64.copysign(normal[axis]);
        let mut plane = Plane { points: points.iter().map(|p| [p[x], p[y]]).collect(), exact, orientation };
        plane.tiles().or_else(|| {
            plane.orientation = -orientation;
            plane.tiles()
        })
    })?;
    let off = exact.off_plane(&points, &tiled).map(|off| off * power);
    let triangles = tiled.into_iter().map(|triangle| triangle.map(|i| distinct[i])).collect();
    Some(Triangulation { triangles, off })
}

/// The places of the corners without those that are where the one before is, the last one's next being the first.
fn distinct(corners: &[Point3<f64>]) -> Vec<usize> {
    if corners.len() == 3 {
        return vec![0, 1, 2];
    }
    let mut kept: Vec<usize> = vec![];
    for (i, corner) in corners.iter().enumerate() {
        if kept.last().is_none_or(|&last| corners[last] != *corner) {
            kept.push(i);
        }
    }
    while kept.len() > 1 && corners[kept[0]] == corners[kept[kept.len() - 1]] {
        kept.pop();
    }
    kept
}

/// The points divided by a power of two near the greatest coordinate, so that differences do not overflow, and that power;
/// as they are, and 1, where the division would round.
fn scaled(points: &[Point3<f64>]) -> (Vec<[f64; 3]>, f64) {
    let whole: Vec<[f64; 3]> = points.iter().map(|p| (*p).into()).collect();
    let greatest = whole.iter().flatten().fold(0.0f64, |most, x| most.max(x.abs()));
    // The exponent alone; 0 for a number without one.
    let power = f64::from_bits(greatest.to_bits() & (0x7ff << 52));
    let divided: Vec<[f64; 3]> = whole.iter().map(|p| p.map(|x| x / power)).collect();
    let same = whole.iter().flatten().zip(divided.iter().flatten()).all(|(x, y)| y * power == *x);
    if same { (divided, power) } else { (whole, 1.0) }
}

/// Twice the areas of the projections along the axes, signed, as binary64 has them: what the first try is chosen by.
fn area(points: &[[f64; 3]]) -> [f64; 3] {
    let origin = points[0];
    let from = |p: &[f64; 3]| [0, 1, 2].map(|i| p[i] - origin[i]);
    let mut sum = [0.0; 3];
    for edge in points.windows(2) {
        let (p, q) = (from(&edge[0]), from(&edge[1]));
        for (axis, sum) in sum.iter_mut().enumerate() {
            let (x, y) = ((axis + 1) % 3, (axis + 2) % 3);
            *sum += p[x] * q[y] - p[y] * q[x];
        }
    }
    sum.map(|x| if x.is_nan() { 0.0 } else { x })
}

/// How signs of determinants are found: by the crate `robust` where no product of it can leave the range of binary64, else in
/// integers.
#[derive(Clone, Copy)]
enum Exact {
    Robust,
    Integers,
}

impl Exact {
    fn of(points: &[[f64; 3]]) -> Self {
        let (least, most) = (2f64.powi(-200), 2f64.powi(200));
        let fits = |x: &f64| *x == 0.0 || (least..most).contains(&x.abs());
        if points.iter().flatten().all(fits) { Self::Robust } else { Self::Integers }
    }

    /// The sign of twice the area of a triangle.
    fn turn(self, [p, q, r]: [[f64; 2]; 3]) -> f64 {
        match self {
            Self::Robust => {
                let coord = |p: [f64; 2]| Coord { x: p[0], y: p[1] };
                orient2d(coord(p), coord(q), coord(r))
            }
            Self::Integers => {
                let [p, q, r] = [p, q, r].map(|p| p.map(integer));
                let side = |p: &[BigInt; 2]| [&p[0] - &r[0], &p[1] - &r[1]];
                let ([ax, ay], [bx, by]) = (side(&p), side(&q));
                sign(&(ax * by - ay * bx))
            }
        }
    }

    /// The sign of the volume of four points.
    fn volume(self, points: [[f64; 3]; 4]) -> f64 {
        match self {
            Self::Robust => {
                let [p, q, r, s] = points.map(|[x, y, z]| Coord3D { x, y, z });
                orient3d(p, q, r, s)
            }
            Self::Integers => {
                let [p, q, r, s] = points.map(|p| p.map(integer));
                let side = |p: &[BigInt; 3]| [0, 1, 2].map(|i| &p[i] - &s[i]);
                let [a, b, c] = [side(&p), side(&q), side(&r)];
                let minor = |i: usize, j: usize| &b[i] * &c[j] - &b[j] * &c[i];
                sign(&(&a[0] * minor(1, 2) + &a[1] * minor(2, 0) + &a[2] * minor(0, 1)))
            }
        }
    }

    /// The greatest distance, about, of a point from the plane of the largest triangle; none if all are exactly in it.
    fn off_plane(self, points: &[[f64; 3]], triangles: &[[usize; 3]]) -> Option<f64> {
        let normal = |triangle: &[usize; 3]| {
            let [p, q, r] = triangle.map(|i| nalgebra::Vector3::from(points[i]));
            (q - p).cross(&(r - p))
        };
        let plane = triangles.iter().max_by(|x, y| normal(x).norm().total_cmp(&normal(y).norm()))?;
        let [p, q, r] = plane.map(|i| points[i]);
        let is_off = |s: &&[f64; 3]| self.volume([p, q, r, **s]) != 0.0;
        let unit = normal(plane).try_normalize(0.0);
        let distance = |s: &[f64; 3]| {
            unit.map_or(0.0, |unit| unit.dot(&(nalgebra::Vector3::from(*s) - nalgebra::Vector3::from(p))).abs())
        };
        points.iter().filter(is_off).map(distance).reduce(f64::max)
    }
}

fn sign(x: &BigInt) -> f64 {
    match x.sign() {
        Sign::Minus => -1.0,
        Sign::NoSign => 0.0,
        Sign::Plus => 1.0,
    }
}

/// A finite number in units of 2^-1074, the least of binary64.
fn integer(x: f64) -> BigInt {
    let bits = x.to_bits();
    let (exponent, fraction) = ((bits >> 52) & 0x7ff, bits & ((1 << 52) - 1));
    let magnitude = match exponent {
        0 => BigInt::from(fraction),
        _ => BigInt::from(fraction | 1 << 52) << (exponent - 1),
    };
    if x.is_sign_negative() { -magnitude } else { magnitude }
}

/// A polygon in a plane, of which one orientation is tried.
struct Plane {
    points: Vec<[f64; 2]>,
    exact: Exact,
    orientation: f64,
}

impl Plane {
    /// Positive for a turn in the orientation that is tried.
    fn turn(&self, triangle: [usize; 3]) -> f64 {
        self.exact.turn(triangle.map(|i| self.points[i])) * self.orientation
    }

    /// Triangles that tile the polygon, if it is simple and has this orientation.
    fn tiles(&self) -> Option<Vec<[usize; 3]>> {
        self.fan().or_else(|| self.ears().filter(|triangles| self.are_apart(triangles)))
    }

    /// The fan of the first corner, if every triangle of it has the orientation, and all are on one side of the first edge,
    /// which the last one may lie along: then they do not overlap.
    fn fan(&self) -> Option<Vec<[usize; 3]>> {
        let last = self.points.len() - 1;
        let is_fan = (1..last).all(|i| self.turn([0, i, i + 1]) > 0.0)
            && (2..last).all(|i| self.turn([0, 1, i]) > 0.0)
            && self.turn([0, 1, last]) >= 0.0;
        is_fan.then(|| (1..last).map(|i| [0, i, i + 1]).collect())
    }

    /// Cuts off ears: corners that turn in the orientation, and whose triangle holds no other corner. Those that are cut off
    /// are not neighbours as long as others are left, so that triangles stay fat.
    fn ears(&self) -> Option<Vec<[usize; 3]>> {
        let count = self.points.len();
        let mut ring = Ring {
            before: (0..count).map(|i| (i + count - 1) % count).collect(),
            after: (0..count).map(|i| (i + 1) % count).collect(),
            left: vec![true; count],
        };
        // What may be in a triangle: corners that do not turn in the orientation. Once one does, it does so for good.
        let mut blunt: Vec<usize> = (0..count).filter(|&i| self.turn(ring.corner(i)) <= 0.0).collect();
        let mut stamps = vec![0u32; count];
        let mut queue: VecDeque<(usize, u32)> = (0..count).map(|i| (i, 0)).collect();
        // Corners whose triangles a blunt one was found in: they are looked at again once it is blunt no more.
        let mut waiting: Vec<Vec<usize>> = vec![vec![]; count];
        let mut triangles = Vec::with_capacity(count - 2);
        while triangles.len() + 3 < count {
            let (i, stamp) = queue.pop_front()?;
            if !ring.left[i] || stamps[i] != stamp {
                continue;
            }
            let ear = ring.corner(i);
            if self.turn(ear) <= 0.0 {
                continue;
            }
            if let Some(&blocking) = blunt.iter().find(|&&j| self.holds(ear, j)) {
                waiting[blocking].push(i);
                continue;
            }
            triangles.push(ear);
            let [before, _, after] = ear;
            ring.cut(i);
            let mut again = vec![before, after];
            for sharp in [before, after].into_iter().filter(|&j| self.turn(ring.corner(j)) > 0.0) {
                blunt.retain(|&j| j != sharp);
                again.append(&mut waiting[sharp]);
            }
            for corner in again {
                stamps[corner] += 1;
                queue.push_back((corner, stamps[corner]));
            }
        }
        let last = ring.corner((0..count).find(|&i| ring.left[i])?);
        triangles.push(last);
        (self.turn(last) > 0.0).then_some(triangles)
    }

    /// Whether a triangle of the orientation holds a corner, on its edges too, that is not where one of its own is.
    fn holds(&self, triangle: [usize; 3], corner: usize) -> bool {
        let [p, q, r] = triangle;
        let [x, y] = self.points[corner];
        let outside = |axis: usize, value: f64| {
            let ends = triangle.map(|i| self.points[i][axis]);
            ends.iter().all(|end| *end < value) || ends.iter().all(|end| *end > value)
        };
        !outside(0, x)
            && !outside(1, y)
            && triangle.iter().all(|&i| self.points[i] != self.points[corner])
            && [[p, q], [q, r], [r, p]].iter().all(|&[from, to]| self.turn([from, to, corner]) >= 0.0)
    }

    /// Whether no two triangles of the orientation overlap: an edge of one of them has the other one beyond it.
    fn are_apart(&self, triangles: &[[usize; 3]]) -> bool {
        let span = |triangle: &[usize; 3], axis: usize| {
            let ends = triangle.map(|i| self.points[i][axis]);
            (ends.into_iter().fold(f64::INFINITY, f64::min), ends.into_iter().fold(f64::NEG_INFINITY, f64::max))
        };
        let mut order: Vec<_> = triangles.iter().map(|t| (span(t, 0), span(t, 1), *t)).collect();
        order.sort_by(|x, y| x.0.0.total_cmp(&y.0.0));
        let beyond = |of: [usize; 3], other: [usize; 3]| {
            let [p, q, r] = of;
            [[p, q], [q, r], [r, p]].iter().any(|&[from, to]| other.iter().all(|&i| self.turn([from, to, i]) <= 0.0))
        };
        order.iter().enumerate().all(|(number, (x, y, triangle))| {
            let later = order[number + 1..].iter().take_while(|other| other.0.0 < x.1);
            later
                .filter(|(_, other, _)| other.0 < y.1 && y.0 < other.1)
                .all(|(_, _, other)| beyond(*triangle, *other) || beyond(*other, *triangle))
        })
    }
}

/// The corners that are left, in a ring.
struct Ring {
    before: Vec<usize>,
    after: Vec<usize>,
    left: Vec<bool>,
}

impl Ring {
    fn corner(&self, i: usize) -> [usize; 3] {
        [self.before[i], i, self.after[i]]
    }

    fn cut(&mut self, i: usize) {
        let [before, _, after] = self.corner(i);
        self.after[before] = after;
        self.before[after] = before;
        self.left[i] = false;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::{self, Exact as Answer};
    use rand::rngs::ChaCha8Rng;
    use rand::{RngExt, SeedableRng};

    fn points(list: &[[f64; 3]]) -> Vec<Point3<f64>> {
        list.iter().copied().map(Point3::from).collect()
    }

    fn flat(list: &[[f64; 2]]) -> Vec<Point3<f64>> {
        list.iter().map(|[x, y]| Point3::new(*x, *y, 0.0)).collect()
    }

    /// Twice the area of a polygon in the plane z = 0, exact for small whole numbers.
    fn area(corners: &[Point3<f64>]) -> f64 {
        let next = corners.iter().cycle().skip(1);
        corners.iter().zip(next).map(|(p, q)| p.x * q.y - p.y * q.x).sum()
    }

    /// The triangles tile: all have the orientation of the polygon and add up to its area; two of them without a common
    /// corner do not touch.
    fn tiles(corners: &[Point3<f64>]) -> Vec<[usize; 3]> {
        let found = triangulate(corners).expect("a simple polygon");
        assert!(found.off.is_none());
        let areas: Vec<f64> = found.triangles.iter().map(|t| area(&t.map(|i| corners[i]))).collect();
        let whole = area(corners);
        assert!(areas.iter().all(|area| area * whole > 0.0), "{areas:?}");
        assert_eq!(areas.iter().sum::<f64>(), whole);
        for (number, p) in found.triangles.iter().enumerate() {
            for q in &found.triangles[..number] {
                let at = |i: &usize| corners[*i];
                if !p.iter().any(|i| q.iter().any(|j| at(i) == at(j))) {
                    let [a, b] = [p, q].map(|t| t.map(|i| <[f64; 3]>::from(corners[i])));
                    let answer = exact::pair(&[a[0], a[1], a[2], b[0], b[1], b[2]]);
                    assert_eq!(answer, Ok(Answer::Separate), "{p:?} {q:?}");
                }
            }
        }
        found.triangles
    }

    #[test]
    fn simple_polygons_stay_themselves() {
        let square = [[0., 0.], [4., 0.], [4., 4.], [0., 4.]];
        assert_eq!(tiles(&flat(&square)), [[0, 1, 2], [0, 2, 3]]);
        // A reflex corner in each place.
        let dart = [[0., 0.], [4., 0.], [1., 1.], [0., 4.]];
        for turn in 0..4 {
            let mut dart = dart;
            dart.rotate_left(turn);
            assert_eq!(tiles(&flat(&dart)).len(), 2);
            dart.reverse();
            assert_eq!(tiles(&flat(&dart)).len(), 2);
        }
        let u = [[0., 0.], [6., 0.], [6., 4.], [4., 4.], [4., 2.], [2., 2.], [2., 4.], [0., 4.]];
        assert_eq!(tiles(&flat(&u)).len(), 6);
        // The diagonals of the first ears go through the reflex corner.
        let notch = [[0., 0.], [4., 0.], [4., 4.], [2., 2.], [0., 4.]];
        assert_eq!(tiles(&flat(&notch)).len(), 3);
        // Corners on straight edges, and corners that are given again.
        let straight = [[0., 0.], [2., 0.], [4., 0.], [4., 0.], [4., 4.], [2., 4.], [0., 4.], [0., 2.], [0., 0.]];
        assert_eq!(tiles(&flat(&straight)).len(), 5);
        let triangle = [[0., 0.], [1., 0.], [2., 0.], [3., 0.], [0., 3.]];
        assert_eq!(tiles(&flat(&triangle)).len(), 3);
        // A square with a hole, cut open between them.
        let ring = [[0., 0.], [9., 0.], [9., 9.], [0., 9.], [0., 0.], [3., 3.], [3., 6.], [6., 6.], [6., 3.], [3., 3.]];
        assert_eq!(tiles(&flat(&ring)).len(), 8);
        // A spiral.
        let mut spiral = vec![];
        for turn in 0..40 {
            let far = 4.0 * f64::from(turn) + 4.0;
            spiral.push([[far, -far], [far, far], [-far, far], [-far, -far - 4.0]][turn as usize % 4]);
        }
        let inner: Vec<[f64; 2]> = spiral.iter().rev().map(|[x, y]| [x - x.signum(), y - y.signum()]).collect();
        assert_eq!(tiles(&flat(&[spiral, inner].concat())).len(), 78);
    }

    #[test]
    fn polygons_that_are_not_simple_are_none() {
        let bow = flat(&[[0., 0.], [4., 4.], [4., 0.], [0., 4.]]);
        let uneven = flat(&[[0., 0.], [4., 4.], [4., 0.], [0., 9.]]);
        let star: Vec<[f64; 2]> =
            (0..5).map(|i| (f64::from(4 * i) * std::f64::consts::PI / 5.0).sin_cos().into()).collect();
        let twice = flat(&[[0., 0.], [4., 0.], [0., 4.], [0., 0.], [4., 0.], [0., 4.]]);
        let spike = flat(&[[0., 0.], [4., 0.], [9., 0.], [4., 0.], [0., 4.]]);
        let line = flat(&[[0., 0.], [1., 0.], [2., 0.], [3., 0.]]);
        let point = flat(&[[1., 1.]; 5]);
        // A strip that goes round by more than a turn: it has triangles of one orientation, but they overlap.
        let at = |step: i32, radius: f64| {
            let (y, x) = (f64::from(step) * 31f64.to_radians()).sin_cos();
            [radius * x, radius * y]
        };
        let strip: Vec<[f64; 2]> = (0..13).map(|i| at(i, 10.0)).chain((0..13).rev().map(|i| at(i, 5.0))).collect();
        for polygon in [bow, uneven, flat(&star), twice, spike, line, point, flat(&strip)] {
            assert!(triangulate(&polygon).is_none(), "{polygon:?}");
        }
    }

    #[test]
    fn planes_are_exact_at_all_scales() {
        for scale in [1.0, 2f64.powi(-300), 2f64.powi(400), 2f64.powi(1020), 2f64.powi(-1060)] {
            let tilted = [[0., 0., 0.], [4., 1., 2.], [5., 5., 7.], [1., 4., 5.]].map(|p| p.map(|x| x * scale));
            let found = triangulate(&points(&tilted)).unwrap();
            assert_eq!((found.triangles, found.off), (vec![[0, 1, 2], [0, 2, 3]], None), "{scale}");
            let mut bent = tilted;
            bent[3][2] = f64::from_bits(bent[3][2].to_bits() + 1);
            let off = triangulate(&points(&bent)).unwrap().off;
            assert!(off.is_some(), "{scale}");
        }
        // Upright, and far apart in size: one corner is off the edge by the least number.
        let upright = points(&[[0., 0., 0.], [0., 4., 0.], [0., 4., 4.], [0., 1., 1.]]);
        assert_eq!(triangulate(&upright).unwrap().triangles.len(), 2, "the last corner is on an edge");
        let least = points(&[[0., 0., 0.], [0., 4., 0.], [0., 4., 4.], [0., 0., 5e-324]]);
        assert_eq!(triangulate(&least).unwrap().triangles, [[0, 1, 2], [0, 2, 3]]);
    }

    /// Polygons around a point, concave, in a plane that is tilted.
    #[test]
    fn random_polygons_are_tiled() {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        for round in 0..300 {
            let count = rng.random_range(4..40);
            let mut angles: Vec<f64> = (0..count).map(|i| f64::from(i) + rng.random_range(0.0..0.9)).collect();
            angles.iter_mut().for_each(|angle| *angle *= std::f64::consts::TAU / f64::from(count));
            let corner = |angle: f64| {
                let radius = rng.random_range(1.0..1000.0);
                Point3::new((radius * angle.cos()).round(), (radius * angle.sin()).round(), 0.0)
            };
            let polygon: Vec<Point3<f64>> = angles.into_iter().map(corner).collect();
            // Rounding may fold a polygon with an angle near 180 degrees.
            if let Some(found) = triangulate(&polygon) {
                assert_eq!(tiles(&polygon), found.triangles, "round {round}");
            } else {
                assert!(count < 8, "round {round}");
            }
        }
    }

    #[test]
    fn many_corners_are_soon_tiled() {
        let start = std::time::Instant::now();
        let count = MOST as i32 / 2;
        // Teeth: half of the corners are reflex.
        let mut teeth: Vec<[f64; 2]> =
            (0..count).map(|i| [f64::from(i), f64::from(i % 2) * 3.0 + f64::from(i) * 1e-3]).collect();
        teeth.extend((0..count).rev().map(|i| [f64::from(i), f64::from(i % 2) * 3.0 - 1.0 + f64::from(i) * 1e-3]));
        let found = triangulate(&flat(&teeth)).unwrap();
        assert_eq!(found.triangles.len(), MOST - 2);
        assert!(start.elapsed().as_secs() < 30, "{:?}", start.elapsed());
    }
}
