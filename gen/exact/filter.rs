//! The same decision in binary64 with an error bound: an answer, or none when the margin is too small.
//!
//! Let all points be taken relative to a0 and M be their greatest coordinate. A computed relative coordinate is off by
//! at most h = u M + 2 d, u = 2^-52, when the points themselves are off by d. Edges are then off by 4h (h >= u M, and
//! h < M / 1024 is checked), components of cross products, of magnitude 8 M^2, by 49 M h, and projections, of magnitude
//! 24 M^3, by 243 M^2 h, roundings included. Two projections that differ by more than 1024 M^2 h are therefore in that
//! order. Underflow cannot matter, because M is kept between 2^-200 and 2^200.

use super::Exact;

type Vector = [f64; 3];

/// Decides the pair if its points, each coordinate off by at most `error`, leave no doubt.
///
/// `Intersect` is certain once the images overlap by more than a point on all 11 axes: n_A projects A to one number,
/// inside the image of B, so A - B is three-dimensional and those axes are all its facets' normals. `Touch` is never
/// certain here.
pub(super) fn decide(points: &[Vector; 6], error: f64) -> Option<Exact> {
    let p = points.map(|point| difference(&point, &points[0]));
    let reach = p.iter().flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
    if !(exp2(-200)..exp2(200)).contains(&reach) {
        return None;
    }
    let h = f64::EPSILON * reach + 2.0 * error;
    if h * 1024.0 >= reach {
        return None;
    }
    let margin = 1024.0 * reach * reach * h;
    let edges = [0, 1, 2, 3, 4, 5].map(|i| {
        let next = if i % 3 == 2 { i - 2 } else { i + 1 };
        difference(&p[next], &p[i])
    });
    let normals = [cross(&edges[0], &edges[1]), cross(&edges[3], &edges[4])];
    let products = (0..9).map(|i| cross(&edges[i / 3], &edges[3 + i % 3]));
    let mut overlapping = true;
    for direction in normals.into_iter().chain(products) {
        let image = |triangle: &[Vector]| {
            triangle
                .iter()
                .map(|point| dot(point, &direction))
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
        };
        let (a, b) = (image(&p[..3]), image(&p[3..]));
        if b.0 - a.1 > margin || a.0 - b.1 > margin {
            return Some(Exact::Separate);
        }
        overlapping &= a.1 - b.0 > margin && b.1 - a.0 > margin;
    }
    overlapping.then_some(Exact::Intersect)
}

/// Decides the pair of A and the image of B if binary64 arithmetic leaves no doubt.
///
/// A coordinate of an image is a sum of four terms, none greater than its magnitude bound s: it is off by less than
/// 4 u s.
pub(super) fn decide_posed(a: &[Vector; 3], b: &[Vector; 3], m: &[Vector; 3], t: &Vector) -> Option<Exact> {
    let greatest = |x: &[f64]| x.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    let bound = 3.0 * greatest(m.as_flattened()) * greatest(b.as_flattened()) + greatest(t);
    if !(exp2(-200)..exp2(200)).contains(&bound) {
        return None;
    }
    let image = |x: &Vector| [0, 1, 2].map(|i| dot(&m[i], x) + t[i]);
    let points = [a[0], a[1], a[2], image(&b[0]), image(&b[1]), image(&b[2])];
    decide(&points, 8.0 * f64::EPSILON * bound)
}

fn exp2(power: i32) -> f64 {
    f64::from(power).exp2()
}

fn difference(a: &Vector, b: &Vector) -> Vector {
    [0, 1, 2].map(|i| a[i] - b[i])
}

fn cross(a: &Vector, b: &Vector) -> Vector {
    [(1, 2), (2, 0), (0, 1)].map(|(j, k)| a[j] * b[k] - a[k] * b[j])
}

fn dot(a: &Vector, b: &Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
