//! Images of points under x to M * x + t: rounded, how far these may be off, and whether they are off at all.

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

/// The image of a triangle if nothing had to be rounded on the way to it.
pub(super) fn exact(x: &[[f64; 3]; 3], m: &[[f64; 3]; 3], t: &[f64; 3]) -> Option<[[f64; 3]; 3]> {
    let mut images = [[0.0; 3]; 3];
    for (image, x) in images.iter_mut().zip(x) {
        for i in 0..3 {
            let [p, q, r] = [product(m[i][0], x[0])?, product(m[i][1], x[1])?, product(m[i][2], x[2])?];
            image[i] = sum(sum(sum(p, q)?, r)?, t[i])?;
        }
    }
    Some(images)
}

/// a * b, if that is a binary64 number. Products whose error might underflow count as rounded.
fn product(a: f64, b: f64) -> Option<f64> {
    let product = a * b;
    if a == 0.0 || b == 0.0 || a.abs() == 1.0 || b.abs() == 1.0 {
        return Some(product);
    }
    // The error of a product is a multiple of 2^-104 of it, at least.
    let least = 2f64.powi(-960);
    let is_exact = (least..=f64::MAX).contains(&product.abs()) && a.mul_add(b, -product) == 0.0;
    is_exact.then_some(product)
}

/// a + b, if that is a binary64 number: the error of a sum is one, and found by Knuth's six operations.
fn sum(a: f64, b: f64) -> Option<f64> {
    let sum = a + b;
    let of_b = sum - a;
    let error = (a - (sum - of_b)) + (b - of_b);
    // Where the sum overflows, the error is NaN and not 0.
    (error == 0.0).then_some(sum)
}
