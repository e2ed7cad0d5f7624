//! Images of points under x to M * x + t as rounded, and how far these may be off.

/// What an image is off by at most in a coordinate, for S = |m0 x0| + |m1 x1| + |m2 x2| + |t| as computed: see `scene::enclosure`.
/// If S is too large for that, or no number, it may be anywhere.
pub(crate) fn radius(size: f64) -> f64 {
    // NaN is not less than anything, so that it becomes infinity, too.
    if size < f64::MAX / 4.0 { size * 2f64.powi(-50) + f64::MIN_POSITIVE } else { f64::INFINITY }
}

/// The image of a triangle as rounded, and what its coordinates are off by at most.
pub(super) fn rounded(x: &[[f64; 3]; 3], m: &[[f64; 3]; 3], t: &[f64; 3]) -> ([[f64; 3]; 3], f64) {
    let mut size = 0.0;
    let images = x.map(|x| {
        [0, 1, 2].map(|i| {
            let terms = [m[i][0] * x[0], m[i][1] * x[1], m[i][2] * x[2], t[i]];
            let of_terms = terms[0].abs() + terms[1].abs() + terms[2].abs() + terms[3].abs();
            // No term is NaN, and no sum of magnitudes: `max` loses nothing.
            size = f64::max(size, of_terms);
            terms[0] + terms[1] + terms[2] + terms[3]
        })
    });
    (images, radius(size))
}
