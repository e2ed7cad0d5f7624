//! What two triangles have in common: nothing, a point, a segment or a convex polygon of up to six corners.
//!
//! A is clipped by the planes that bound B, in integers of any length. A triangle with area is a plane, of which a point must be on
//! neither side, and three half spaces that are upright on it at its edges; a segment is a line, as three planes, and two half spaces
//! at its ends; a point is three planes. A polygon that is clipped by closed half spaces one after the other keeps just the points in
//! all of them, and this holds of polygons that are segments or points, too. Corners are homogeneous: numerators and one
//! denominator, which no step divides.

use super::integers::{Motion, Scaled, whole};
use super::minkowski::{cross, difference, dot, is_zero};
use super::round::nearest;
use crate::finite::{self, NotFinite};
use num_bigint::{BigInt, Sign};
use num_rational::Ratio;

/// A point with whole coordinates.
pub(crate) type Whole = [BigInt; 3];

/// A point with rational coordinates.
#[derive(Clone, Debug)]
pub struct ExactPoint {
    numerators: Whole,
    /// Positive.
    denominator: BigInt,
}

impl PartialEq for ExactPoint {
    fn eq(&self, other: &Self) -> bool {
        is_zero(&self.towards(other))
    }
}

impl ExactPoint {
    /// The coordinates as fractions in lowest terms.
    pub fn coordinates(&self) -> [Ratio<BigInt>; 3] {
        self.numerators.each_ref().map(|x| Ratio::new(x.clone(), self.denominator.clone()))
    }

    /// The binary64 numbers nearest to the coordinates, those with an even last place where two are as near: none is off by more
    /// than half a unit in its last place.
    pub fn rounded(&self) -> [f64; 3] {
        self.numerators.each_ref().map(|x| nearest(x, &self.denominator))
    }

    /// A vector to another point, times a positive number.
    pub(crate) fn towards(&self, other: &Self) -> Whole {
        [0, 1, 2].map(|i| &other.numerators[i] * &self.denominator - &self.numerators[i] * &other.denominator)
    }

    /// The same to a whole point.
    #[cfg(feature = "meshes")]
    pub(crate) fn towards_whole(&self, other: &Whole) -> Whole {
        [0, 1, 2].map(|i| &other[i] * &self.denominator - &self.numerators[i])
    }
}

/// What the triangles a0 a1 a2 and b0 b1 b2 have in common: nothing, a point, the ends of a segment, or the corners of a convex
/// polygon in their order.
///
/// ```
/// use efsat_geometry::exact::common;
///
/// let face = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
/// let [a0, a1, a2] = face;
/// let ends = common(&[a0, a1, a2, [1.0, 1.0, -1.0], [1.0, 1.0, 2.0], [2.0, 2.0, 0.0]])?;
/// let rounded: Vec<[f64; 3]> = ends.iter().map(|end| end.rounded()).collect();
/// assert!(rounded.len() == 2 && rounded.contains(&[1.0, 1.0, 0.0]) && rounded.contains(&[2.0, 2.0, 0.0]));
/// let third = common(&[a0, a1, a2, [0.0, 1.0, -1.0], [0.0, 1.0, 2.0], [1.0, 1.0, 2.0]])?;
/// assert!(third.iter().any(|end| end.coordinates()[0].to_string() == "1/3"));
/// # Ok::<(), efsat_geometry::NotFinite>(())
/// ```
///
/// # Errors
/// If a number is not finite.
pub fn common(points: &[[f64; 3]; 6]) -> Result<Vec<ExactPoint>, NotFinite> {
    finite::pair(points)?;
    Ok(of_places(points.map(|point| point.map(Scaled::from))))
}

/// What A and the image of B under x to M * x + t have in common, as [`common`] says it; `m` is indexed `[row][column]`.
///
/// # Errors
/// If a number is not finite.
pub fn posed_common(
    a: &[[f64; 3]; 3],
    b: &[[f64; 3]; 3],
    m: &[[f64; 3]; 3],
    t: &[f64; 3],
) -> Result<Vec<ExactPoint>, NotFinite> {
    finite::posed(a, b, m, t)?;
    let motion = Motion::new(m, t);
    let ([a0, a1, a2], [b0, b1, b2]) = (a.map(|x| x.map(Scaled::from)), b.map(|x| motion.image(&x)));
    Ok(of_places([a0, a1, a2, b0, b1, b2]))
}

fn of_places(places: [[Scaled; 3]; 6]) -> Vec<ExactPoint> {
    let (points, grid) = whole(&places);
    let triangle = |first: usize| [0, 1, 2].map(|corner| points[first + corner].clone());
    let mut corners = clipped(&triangle(0), &triangle(3));
    for ExactPoint { numerators, denominator } in &mut corners {
        if grid >= 0 {
            numerators.iter_mut().for_each(|x| *x <<= grid);
        } else {
            *denominator <<= -grid;
        }
    }
    corners
}

/// A plane, by a normal and the product of that with its points.
struct Plane(Whole, BigInt);

impl Plane {
    fn through(point: &Whole, normal: Whole) -> Self {
        let at = dot(&normal, point);
        Self(normal, at)
    }

    fn turned(&self) -> Self {
        Self(self.0.each_ref().map(|x| -x), -&self.1)
    }

    /// A number with the sign of the height of a point above the plane.
    fn height(&self, point: &ExactPoint) -> BigInt {
        dot(&self.0, &point.numerators) - &self.1 * &point.denominator
    }
}

/// The corners of what two triangles have in common, each once.
pub(crate) fn clipped(a: &[Whole; 3], b: &[Whole; 3]) -> Vec<ExactPoint> {
    let corner = |x: &Whole| ExactPoint { numerators: x.clone(), denominator: 1.into() };
    // A segment has no corner between its ends.
    let mut polygon: Vec<ExactPoint> =
        if is_zero(&normal(a)) { ends(a).map(corner).into() } else { a.iter().map(corner).collect() };
    let (planes, halves) = bounds(b);
    for plane in planes {
        polygon = above(&polygon, &plane);
        polygon = above(&polygon, &plane.turned());
    }
    for half in halves {
        polygon = above(&polygon, &half);
    }
    let mut corners: Vec<ExactPoint> = vec![];
    for point in polygon {
        if !corners.contains(&point) {
            corners.push(point);
        }
    }
    corners
}

/// A normal of a triangle; 0 for a segment.
fn normal(triangle: &[Whole; 3]) -> Whole {
    cross(&difference(&triangle[1], &triangle[0]), &difference(&triangle[2], &triangle[1]))
}

/// The ends of a segment: along a line points are in lexicographic order.
fn ends(triangle: &[Whole; 3]) -> [&Whole; 2] {
    let mut corners = triangle.each_ref();
    corners.sort();
    [corners[0], corners[2]]
}

/// The planes that a triangle lies in and the half spaces that bound it there.
fn bounds(triangle: &[Whole; 3]) -> (Vec<Plane>, Vec<Plane>) {
    let edges = [0, 1, 2].map(|k| difference(&triangle[(k + 1) % 3], &triangle[k]));
    let normal = normal(triangle);
    if !is_zero(&normal) {
        let upright = |k: usize| Plane::through(&triangle[k], cross(&normal, &edges[k]));
        let halves = vec![upright(0), upright(1), upright(2)];
        return (vec![Plane::through(&triangle[0], normal)], halves);
    }
    let unit = |axis: usize| [0, 1, 2].map(|i| BigInt::from(u8::from(i == axis)));
    let [least, greatest] = ends(triangle);
    let along = difference(greatest, least);
    if is_zero(&along) {
        return ((0..3).map(|axis| Plane::through(least, unit(axis))).collect(), vec![]);
    }
    let planes = (0..3).map(|axis| Plane::through(least, cross(&along, &unit(axis)))).collect();
    (planes, vec![Plane::through(least, along.clone()), Plane::through(greatest, along).turned()])
}

/// The part of a convex polygon that is not below a plane.
fn above(polygon: &[ExactPoint], plane: &Plane) -> Vec<ExactPoint> {
    let heights: Vec<BigInt> = polygon.iter().map(|point| plane.height(point)).collect();
    let mut kept = vec![];
    for (k, point) in polygon.iter().enumerate() {
        let next = (k + 1) % polygon.len();
        if heights[k].sign() != Sign::Minus {
            kept.push(point.clone());
        }
        if heights[k].sign() == -heights[next].sign() && heights[k].sign() != Sign::NoSign {
            // The mean of both, weighted with the height of the other one.
            let weights = [&heights[next], &heights[k]].map(BigInt::magnitude).map(|x| BigInt::from(x.clone()));
            let mean = |x: &BigInt, y: &BigInt| x * &weights[0] + y * &weights[1];
            let other = &polygon[next];
            kept.push(ExactPoint {
                numerators: [0, 1, 2].map(|i| mean(&point.numerators[i], &other.numerators[i])),
                denominator: mean(&point.denominator, &other.denominator),
            });
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Points;
    use crate::exact::{ContactKind, relation};
    use rand::rngs::ChaCha8Rng;
    use rand::{RngExt, SeedableRng};

    type Rational = Ratio<BigInt>;

    /// Whether a point is in a triangle: the planes that bound the triangle have it on no wrong side.
    fn holds(points: &[[f64; 3]], point: &ExactPoint, grid: i64) -> bool {
        let (corners, own) = whole(&[0, 1, 2].map(|corner| points[corner].map(Scaled::from)));
        assert!(own >= grid);
        let corners = [0, 1, 2].map(|corner| corners[corner].each_ref().map(|x| x << (own - grid)));
        // In units of the grid.
        let point = ExactPoint { numerators: point.numerators.clone(), denominator: &point.denominator << grid.max(0) };
        let point = ExactPoint { numerators: point.numerators.map(|x| x << (-grid).max(0)), ..point };
        let (planes, halves) = bounds(&corners);
        planes.iter().all(|plane| plane.height(&point).sign() == Sign::NoSign)
            && halves.iter().all(|half| half.height(&point).sign() != Sign::Minus)
    }

    /// Twice the area of a polygon as vectors from its first corner, squared: 0 for a segment.
    fn has_area(corners: &[ExactPoint]) -> bool {
        let spokes: Vec<Whole> = corners.iter().skip(1).map(|x| corners[0].towards(x)).collect();
        spokes.windows(2).all(|two| !is_zero(&cross(&two[0], &two[1]))) && spokes.len() > 1
    }

    /// The same points whichever triangle is clipped, all of them in both; as many as the kind of the contact has.
    #[test]
    fn what_two_triangles_share_is_in_both_and_fits_their_relation() {
        let mut rng = ChaCha8Rng::seed_from_u64(3);
        let mut sizes = [0; 7];
        for round in 0..20_000 {
            let reach = [1, 2, 4, 1 << 20][round % 4];
            let flat = rng.random_range(0..3) == 0;
            let mut corner = || {
                let [x, y, z] = [(); 3].map(|()| f64::from(rng.random_range(-reach..=reach)));
                [x, y, if flat { 2.0 * x - y } else { z }].map(|x| x * 0.125)
            };
            let mut points: Points = [(); 6].map(|()| corner());
            if round % 11 == 0 {
                points[4] = points[3];
            }
            let [a0, a1, a2, b0, b1, b2] = points;
            let (ours, theirs) = (common(&points).unwrap(), common(&[b0, b1, b2, a0, a1, a2]).unwrap());
            assert!(ours.len() == theirs.len() && ours.iter().all(|x| theirs.contains(x)), "{points:?}");
            let (_, grid) = whole(&points.map(|point| point.map(Scaled::from)));
            assert!(ours.iter().all(|x| holds(&points[..3], x, grid) && holds(&points[3..], x, grid)), "{points:?}");
            let proper = |corners: &[[f64; 3]]| {
                let (corners, _) = whole(&[0, 1, 2].map(|corner| corners[corner].map(Scaled::from)));
                !is_zero(&normal(&[0, 1, 2].map(|k| corners[k].clone())))
            };
            let both = proper(&points[..3]) && proper(&points[3..]);
            let fits = match relation(&points).unwrap().kind() {
                None => ours.is_empty(),
                Some(ContactKind::Crossing) if both => ours.len() == 2,
                Some(ContactKind::Coplanar) if both => has_area(&ours),
                Some(ContactKind::Touching) if both => (1..3).contains(&ours.len()),
                Some(_) => (1..3).contains(&ours.len()),
            };
            assert!(fits, "{points:?}: {ours:?}");
            sizes[ours.len()] += 1;
        }
        assert!(sizes.iter().all(|count| *count > 20), "{sizes:?}");
    }

    /// A point that is known: an edge through a face, far from the origin, and moved by numbers that round.
    #[test]
    fn corners_are_exact_and_rounded_once() {
        let third = Rational::new(1.into(), 3.into());
        let a = [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0]];
        let b = [[0.0, 1.0, -1.0], [1.0, 1.0, 2.0], [0.0, 1.0, -1.0]];
        let [[a0, a1, a2], [b0, b1, b2]] = [a, b];
        let found = common(&[a0, a1, a2, b0, b1, b2]).unwrap();
        assert_eq!(found[0].coordinates(), [third, Rational::from_integer(1.into()), Rational::from_integer(0.into())]);
        assert_eq!((found.len(), found[0].rounded()), (1, [1.0 / 3.0, 1.0, 0.0]));
        // Three tenths of binary64 are not three times a tenth.
        let m = [[0.1, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let posed = posed_common(&a, &[[3.0, 1.0, 0.0]; 3], &m, &[0.0; 3]).unwrap();
        let tenth = Rational::new(BigInt::from(0.1f64.to_bits() & ((1 << 52) - 1) | 1 << 52), BigInt::from(1) << 56);
        assert_eq!(posed[0].coordinates()[0], tenth * BigInt::from(3));
        assert_eq!(posed[0].rounded()[0], 0.30000000000000004);
        assert!(common(&[a0, a1, a2, b0, b1, [f64::NAN; 3]]).is_err());
    }
}
