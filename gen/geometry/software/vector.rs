//! Vectors and planes in plain floating point.

use num_traits::Float;

/// a - b.
pub(super) fn difference<T: Float>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    [0, 1, 2].map(|i| a[i] - b[i])
}

/// a x b.
pub(super) fn cross<T: Float>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    [(1, 2), (2, 0), (0, 1)].map(|(j, k)| a[j] * b[k] - a[k] * b[j])
}

/// a . b.
pub(super) fn dot<T: Float>(a: [T; 3], b: [T; 3]) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The coordinate along which a vector is longest, the first of equals.
pub(super) fn longest(v: [f64; 3]) -> usize {
    (1..3).fold(0, |best, i| if v[i].abs() > v[best].abs() { i } else { best })
}

/// Both triangles of a pair.
pub(super) fn triangles<T: Copy>(points: &[T; 6]) -> [[T; 3]; 2] {
    let [a0, a1, a2, b0, b1, b2] = *points;
    [[a0, a1, a2], [b0, b1, b2]]
}

/// The plane of a triangle: all x with `normal . x + offset = 0`. The normal is as long as the triangle has area, twice;
/// distances are multiplied by that length.
pub(super) struct Plane {
    /// (v1 - v0) x (v2 - v0).
    pub normal: [f64; 3],
    offset: f64,
}

impl Plane {
    /// The plane through three points.
    pub fn through([a, b, c]: [[f64; 3]; 3]) -> Self {
        let normal = cross(difference(b, a), difference(c, a));
        Self { normal, offset: -dot(normal, a) }
    }

    /// The signed distance of a point, times the length of the normal.
    pub fn distance(&self, x: [f64; 3]) -> f64 {
        dot(self.normal, x) + self.offset
    }
}

/// Whether three numbers have one sign, none of them zero.
pub(super) fn one_side(distances: [f64; 3]) -> bool {
    distances.iter().all(|&d| d > 0.0) || distances.iter().all(|&d| d < 0.0)
}
