//! Where two triangles meet, for drawing: in binary64, so that no answer may depend on it.

use nalgebra::Point3;

type Triangle = [Point3<f64>; 3];

/// How far outside a triangle a point may be by its weights, so that touching corners are drawn.
const TOLERANCE: f64 = 1e-9;

/// The ends of the segment that two triangles have in common; none if that is empty or if they lie in one plane.
pub(super) fn segment(a: &Triangle, b: &Triangle) -> Option<[Point3<f64>; 2]> {
    let points: Vec<Point3<f64>> = pierced(a, b).chain(pierced(b, a)).collect();
    let ends = points.iter().flat_map(|p| points.iter().map(move |q| [*p, *q]));
    let length = |[p, q]: &[Point3<f64>; 2]| (q - p).norm_squared();
    ends.max_by(|x, y| length(x).total_cmp(&length(y)))
}

/// Where the edges of one triangle pass through the other.
fn pierced<'a>(edges: &'a Triangle, face: &'a Triangle) -> impl Iterator<Item = Point3<f64>> + 'a {
    let normal = (face[1] - face[0]).cross(&(face[2] - face[0]));
    (0..3).filter_map(move |k| {
        let (p, q) = (edges[k], edges[(k + 1) % 3]);
        let [above, below] = [p, q].map(|end| normal.dot(&(end - face[0])));
        if above * below > 0.0 || above == below {
            return None;
        }
        let point = p + (q - p) * (above / (above - below));
        let inside = (0..3).all(|l| {
            let (from, to) = (face[l], face[(l + 1) % 3]);
            (to - from).cross(&(point - from)).dot(&normal) >= -TOLERANCE * normal.norm_squared()
        });
        inside.then_some(point)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const FACE: [[f64; 3]; 3] = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];

    fn found(a: [[f64; 3]; 3], b: [[f64; 3]; 3]) -> Option<f64> {
        let [a, b] = [a, b].map(|corners| corners.map(Point3::from));
        segment(&a, &b).map(|[p, q]| (q - p).norm())
    }

    #[test]
    fn segments_have_their_lengths() {
        let upright = |x: f64| [[x, 1.0, -1.0], [x, 1.0, 1.0], [x, 2.0, 0.0]];
        assert_eq!(found(FACE, upright(1.0)), Some(1.0));
        // The slanted edge of the face cuts it short.
        assert_eq!(found(FACE, upright(2.5)), Some(0.5));
        assert_eq!(found(FACE, upright(3.5)), None);
        assert_eq!(found(FACE, [[1.0, 1.0, 0.0], [1.0, 1.0, 1.0], [2.0, 1.0, 1.0]]), Some(0.0));
        assert_eq!(found(FACE, FACE), None);
    }
}
