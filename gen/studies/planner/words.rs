//! Numbers in words.

pub(super) use crate::plot::grouped;

/// A part of a whole in percent; 0 of nothing.
pub(super) fn share(part: u64, whole: u64) -> String {
    let share = if whole == 0 { 0.0 } else { 100.0 * part as f64 / whole as f64 };
    format!("{share:.2} %")
}

/// A positive number as the nearest power of two.
pub(super) fn power(part: f64) -> String {
    format!("2^{}", part.log2().round())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_in_words() {
        let list = [0, 7, 999, 1000, 41_200, 1_234_567].map(grouped);
        assert_eq!(list, ["0", "7", "999", "1,000", "41,200", "1,234,567"]);
        assert_eq!([share(1, 3), share(0, 0), share(3, 3)], ["33.33 %", "0.00 %", "100.00 %"]);
        assert_eq!([power(0.00195), power(1.0)], ["2^-9", "2^0"]);
    }
}
