//! The ways to write one pair: orders of vertices and roles, turned and mirrored coordinate axes, exact scales and
//! exact translations. None of them changes how two triangles lie to each other.

use super::VertexOrder;
use super::families::power_of_two;
use efsat_geometry::Points;
use rand::RngExt;
use rand::rngs::ChaCha8Rng;
use std::fmt;

const PERMUTATIONS: [[usize; 3]; 6] = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];

/// Orders of six vertices and two roles.
const ORDERS: usize = 72;

/// Permutations of three coordinate axes with every choice of signs.
const TURNS: usize = 48;

/// Translations that are tried for a pair; most are exact only where coordinates have few bits.
const TRANSLATIONS: usize = 4;

/// One way to write a pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Variant {
    /// The pair as the family made it.
    Given,
    /// Vertices and roles in order number `order` of 72, coordinate axes in turn number `turn` of 48.
    Written { order: usize, turn: usize },
    /// Times a power of two.
    Scaled(i32),
    /// Moved.
    Translated([f64; 3]),
}

impl Variant {
    /// All variants of a pair: 72 orders; 47 turns, each in a random order; scales; translations.
    pub fn all(points: &Points, rng: &mut ChaCha8Rng) -> Vec<Self> {
        let mut all: Vec<Self> = (1..ORDERS).map(|order| Self::Written { order, turn: 0 }).collect();
        all.extend((1..TURNS).map(|turn| Self::Written { order: rng.random_range(0..ORDERS), turn }));
        let Some(span) = Span::of(points) else { return all };
        let (least, greatest) = (-1074 - span.low, 1023 - span.high);
        let scales = [least, -300, -37, -1, 1, 37, 300, greatest];
        all.extend(scales.into_iter().filter(|power| (least..=greatest).contains(power)).map(Self::Scaled));
        for _ in 0..TRANSLATIONS {
            // Whole multiples of the pair's own grid, from a step to far beyond the pair.
            let unit = power_of_two((span.low + rng.random_range(0..=20)).min(990));
            let reach = 1i32 << rng.random_range(0..=30);
            let by = [(); 3].map(|()| f64::from(rng.random_range(-reach..=reach)) * unit);
            let exact = |x: &[f64; 3]| (0..3).all(|i| sum_is_exact(x[i], by[i]));
            if points.iter().all(exact) {
                all.push(Self::Translated(by));
            }
        }
        all
    }

    /// The pair written in this way.
    pub fn of(self, points: &Points) -> Points {
        match self {
            Self::Given => *points,
            Self::Written { order, turn } => {
                let axes = PERMUTATIONS[turn / 8];
                let sign = |axis: usize| if turn >> axis & 1 == 0 { 1.0 } else { -1.0 };
                vertices(order).map(|k| [0, 1, 2].map(|axis| sign(axis) * points[k][axes[axis]]))
            }
            Self::Scaled(power) => {
                // Three factors, because fewer may be outside the range; the numbers in between are exact all the same.
                let third = power / 3;
                let factors = [third, third, power - 2 * third].map(power_of_two);
                points.map(|point| point.map(|x| factors.iter().fold(x, |x, factor| x * factor)))
            }
            Self::Translated(by) => points.map(|point| [0, 1, 2].map(|axis| point[axis] + by[axis])),
        }
    }

    /// Whether the host makes the very same pair of it as of the given one, bit for bit.
    pub fn is_normalised_away(self) -> bool {
        !matches!(self, Self::Written { .. })
    }
}

impl fmt::Display for Variant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Given => f.write_str("as made"),
            Self::Written { order, turn } => {
                let names = ["a0", "a1", "a2", "b0", "b1", "b2"];
                let sign = |axis: usize| if turn >> axis & 1 == 0 { "+" } else { "-" };
                let axis = |axis: usize| format!("{}{}", sign(axis), ["x", "y", "z"][PERMUTATIONS[turn / 8][axis]]);
                write!(f, "order {}", vertices(*order).map(|k| names[k]).join(" "))?;
                write!(f, ", axes {}", [0, 1, 2].map(axis).join(" "))
            }
            Self::Scaled(power) => write!(f, "times 2^{power}"),
            Self::Translated(by) => write!(f, "moved by {by:?}"),
        }
    }
}

/// Indices of the points in order number `order`: the second half of the orders has the roles exchanged.
fn vertices(order: usize) -> [usize; 6] {
    let (a, b) = (PERMUTATIONS[order / 6 % 6], PERMUTATIONS[order % 6].map(|k| k + 3));
    let [first, second] = if order < ORDERS / 2 { [a, b] } else { [b, a] };
    [first[0], first[1], first[2], second[0], second[1], second[2]]
}

/// All 36 orders of vertices that keep the roles.
pub(super) fn vertex_orders() -> Vec<VertexOrder> {
    let indices = PERMUTATIONS.map(|order| order.map(|k| k as u32));
    indices.iter().flat_map(|&a| indices.map(|b| [a, b])).collect()
}

/// Binary64 exponents of the lowest and the highest bit set in any coordinate.
struct Span {
    low: i32,
    high: i32,
}

impl Span {
    /// None if all coordinates are zero.
    fn of(points: &Points) -> Option<Self> {
        let spans = points.iter().flatten().filter(|x| **x != 0.0).map(|x| {
            let bits = x.to_bits();
            let field = (bits >> 52 & 0x7ff) as i32;
            let stored = bits & ((1 << 52) - 1);
            let mantissa = if field == 0 { stored } else { stored | 1 << 52 };
            let unit = field.max(1) - 1075;
            let highest = u64::BITS - 1 - mantissa.leading_zeros();
            Self { low: unit + mantissa.trailing_zeros() as i32, high: unit + highest as i32 }
        });
        spans.reduce(|x, y| Self { low: x.low.min(y.low), high: x.high.max(y.high) })
    }
}

/// Whether the binary64 sum is the real sum (Knuth's error term, valid in round to nearest).
fn sum_is_exact(x: f64, y: f64) -> bool {
    let sum = x + y;
    let back = sum - x;
    sum.is_finite() && back.is_finite() && (x - (sum - back)) + (y - back) == 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use efsat_geometry::exact;
    use rand::SeedableRng;
    use std::collections::BTreeSet;

    const POINTS: Points = [[0., 0., 0.], [5., 0., 0.], [0., 7., 0.], [1., 1., -1.], [1.25, 1.5, 1.], [2., 0.75, 3.5]];

    #[test]
    fn the_variants_are_all_there_and_different() {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        let all = Variant::all(&POINTS, &mut rng);
        let count = |wanted: fn(&Variant) -> bool| all.iter().filter(|v| wanted(v)).count();
        assert_eq!(count(|v| matches!(v, Variant::Written { turn: 0, .. })), 71);
        assert_eq!(count(|v| matches!(v, Variant::Written { turn: 1.., .. })), 47);
        assert_eq!(count(|v| matches!(v, Variant::Scaled(_))), 8);
        assert_eq!(count(|v| matches!(v, Variant::Translated(_))), 4);
        let turns = (0..TURNS).map(|turn| Variant::Written { order: 0, turn });
        let orders = (0..ORDERS).map(|order| Variant::Written { order, turn: 0 });
        let bits = |v: Variant| v.of(&POINTS).map(|p| p.map(|x| (x + 0.0).to_bits()));
        assert_eq!(turns.chain(orders).map(bits).collect::<BTreeSet<_>>().len(), TURNS + ORDERS - 1);
        let expected = exact::pair(&POINTS).unwrap();
        assert!(all.iter().all(|v| exact::pair(&v.of(&POINTS)).unwrap() == expected));
    }

    #[test]
    fn scales_reach_both_ends_of_binary64_exactly() {
        let mut rng = ChaCha8Rng::seed_from_u64(2);
        let all = Variant::all(&POINTS, &mut rng);
        let powers: Vec<i32> =
            all.iter().filter_map(|v| if let Variant::Scaled(p) = v { Some(*p) } else { None }).collect();
        assert_eq!((powers[0], powers[7]), (-1072, 1021));
        for power in powers {
            let scaled = Variant::Scaled(power).of(&POINTS);
            assert_eq!(Variant::Scaled(-power).of(&scaled), POINTS, "{power}");
        }
        let least = POINTS.map(|point| point.map(|x| x * 4.0 * 5e-324));
        let mut widest = Variant::all(&least, &mut rng).into_iter().filter(|v| matches!(v, Variant::Scaled(1000..)));
        assert_eq!(widest.next().map(|v| v.of(&least)), Some(POINTS.map(|point| point.map(|x| x * 2f64.powi(1021)))));
        let ends = [[5e-324, 0.0, 0.0], [f64::MAX, 0.0, 0.0], [0.0; 3], [0.0; 3], [0.0; 3], [0.0; 3]];
        assert!(!Variant::all(&ends, &mut rng).iter().any(|v| matches!(v, Variant::Scaled(1.. | ..=-1))));
    }

    #[test]
    fn rounded_sums_are_noticed() {
        assert!(sum_is_exact(0.5, 0.25) && sum_is_exact(1.0, -1.0) && sum_is_exact(5e-324, 1e-323));
        assert!(!sum_is_exact(1.0, 1e-17) && !sum_is_exact(1.0, f64::EPSILON / 2.0) && !sum_is_exact(0.1, 0.2));
        assert!(!sum_is_exact(f64::MAX, f64::MAX));
    }
}
