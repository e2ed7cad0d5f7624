//! Whether a ray from a point crosses a triangle, such that the number of crossings of a closed surface is odd inside it.
//!
//! The ray goes along x. So that it never meets an edge or a vertex, and no triangle that it could run in, it starts beside the point
//! by e along y and by e^2 along z, for an e that is positive and less than any number that occurs: signs of sums are those of their
//! first term that is not zero. The point itself must not be on the triangle, and then it may stand for the one beside it: nothing
//! of the surface is between them.

use super::integers::{Scaled, relative};
use num_bigint::BigInt;
use num_traits::Signed;

/// Whether the ray crosses the triangle, of which the point must not be a point.
pub(crate) fn crosses(from: &[Scaled; 3], triangle: &[[Scaled; 3]; 3]) -> bool {
    let corners @ [u, v, w] = &relative(from, triangle);
    // Seen along the ray, the triangle is around it if it is on one side of all three edges.
    let [side, second, third] = [(u, v), (v, w), (w, u)].map(|(p, q)| side(p, q));
    if side == 0 || side != second || side != third {
        return false;
    }
    // The ray meets the plane at det / area, of which the area has the sign of the sides. The determinant is not zero: the plane
    // would hold the point, and as it does not hold the ray, the point would be in the triangle.
    let minor = |p: &[BigInt; 3], q: &[BigInt; 3]| &p[1] * &q[2] - &p[2] * &q[1];
    let [x, y, z] = corners.each_ref().map(|corner| &corner[0]);
    let determinant = x * minor(v, w) + y * minor(w, u) + z * minor(u, v);
    side == sign(&determinant)
}

/// On which side of the line from p to q, seen along x, the ray is; 0 only if p and q are one point there.
fn side(p: &[BigInt; 3], q: &[BigInt; 3]) -> i8 {
    let at_origin = sign(&(&p[1] * &q[2] - &p[2] * &q[1]));
    let beside = [at_origin, sign(&(&p[2] - &q[2])), sign(&(&q[1] - &p[1]))];
    beside.into_iter().find(|sign| *sign != 0).unwrap_or(0)
}

fn sign(x: &BigInt) -> i8 {
    i8::from(x.is_positive()) - i8::from(x.is_negative())
}
