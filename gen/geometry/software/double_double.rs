//! Numbers of twice the length of binary64: unevaluated sums of two of them.
//!
//! After T. J. Dekker, *A floating-point technique for extending the available precision* (1971). With u = 2^-53, a sum is off by at
//! most 3 u^2 (1 + 5 u) of itself and a product by 7 u^2 (M. Joldes, J.-M. Muller, V. Popescu, *Tight and rigorous error bounds for
//! basic building blocks of double-word arithmetic*, 2017, theorems 3.1 and 5.1), unless something leaves the normal numbers.

/// The sum of two numbers, of which the second is at most half a unit in the last place of the first.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Double {
    pub high: f64,
    pub low: f64,
}

impl From<f64> for Double {
    fn from(high: f64) -> Self {
        Self { high, low: 0.0 }
    }
}

impl Double {
    /// self + other.
    pub fn plus(self, other: Self) -> Self {
        let (high, low) = (two_sum(self.high, other.high), two_sum(self.low, other.low));
        let sum = fast_two_sum(high.high, high.low + low.high);
        fast_two_sum(sum.high, low.low + sum.low)
    }

    /// self - other.
    pub fn minus(self, Self { high, low }: Self) -> Self {
        self.plus(Self { high: -high, low: -low })
    }

    /// self * other.
    pub fn times(self, other: Self) -> Self {
        let product = two_product(self.high, other.high);
        fast_two_sum(product.high, product.low + (self.high * other.low + self.low * other.high))
    }
}

/// a + b, exactly.
pub(super) fn two_sum(a: f64, b: f64) -> Double {
    let high = a + b;
    let of_b = high - a;
    Double { high, low: (a - (high - of_b)) + (b - of_b) }
}

/// a + b, exactly where b is not greater than a.
fn fast_two_sum(a: f64, b: f64) -> Double {
    let high = a + b;
    Double { high, low: b - (high - a) }
}

/// a * b, exactly unless something underflows or overflows.
pub(super) fn two_product(a: f64, b: f64) -> Double {
    // Halves of 26 bits, whose products are exact.
    let halves = |x: f64| {
        let upper = x * 134_217_729.0;
        let upper = upper - (upper - x);
        (upper, x - upper)
    };
    let high = a * b;
    let ((a, of_a), (b, of_b)) = (halves(a), halves(b));
    Double { high, low: of_a * of_b - (((high - a * b) - of_a * b) - a * of_b) }
}
