//! The comparator network of one axis: from projections to *separated* and *surely overlapping* (equations 3 and 6, and
//! the contract's section 6 in place of 7 to 9).

use super::interval::{self, Bounds};
use crate::params::Projections;
use efsat_hardware::graph::{Builder, NodeId, Op, Rate, Type, Unit};
use std::rc::Rc;

/// Codes of the `duplicates` ports: none, edge 0, 1, 2, all three projections equal.
pub const DUPLICATE_BITS: u32 = 3;

/// The comparator network for `points` projections of `bits` bits.
///
/// With [`Projections::Skip`] the first projections belong to A and the last to B; those in between change hands with
/// the axis, by the ports `a_has_<i>` and `b_has_<i>`. With [`Projections::Intersect`] the ports `duplicates_a` and
/// `duplicates_b` say which projections are equal in exact arithmetic.
pub fn unit(bits: u32, bound: i128, points: usize, policy: Projections) -> Rc<Unit> {
    let mut b = Builder::new(
        "comparator_network",
        1,
        &[
            "One axis decided: enclosures of the least and greatest projection of each triangle (equation 3), then",
            "  separated   = b_min_lo > a_max_hi or a_min_lo > b_max_hi   (equation 6)",
            "  overlapping = a_min_hi < b_max_lo and b_min_hi < a_max_lo  (sound in place of 7 to 9; strict)",
        ],
    );
    let ty = Type::signed(bits, 0);
    let p: Vec<Bounds> =
        (0..points).map(|i| interval::input(&mut b, &format!("p{i}"), ty, interval::symmetric(bound))).collect();
    let (a, others): (Vec<Bounds>, Vec<Bounds>) = match policy {
        Projections::All => (p[..3].to_vec(), p[3..].to_vec()),
        Projections::Intersect => {
            let mut join = |name: &str, p: &[Bounds]| {
                let ty = Type::unsigned(DUPLICATE_BITS);
                let code = b.input(&format!("duplicates_{name}"), ty, (0, 4), Rate::Any);
                intersected(&mut b, name, p, code)
            };
            (join("a", &p[..3]), join("b", &p[3..]))
        }
        Projections::Skip => {
            let mut own = |name: &str, i: usize, first: usize| {
                if i == first {
                    return p[i];
                }
                let has = b.input(&format!("{name}_has_{i}"), Type::FLAG, (0, 1), Rate::Any);
                let pick = |b: &mut Builder, end: &str, x, y| b.either(&format!("{name}_{i}_{end}"), has, x, y);
                let lo = pick(&mut b, "lo", p[i].lo, p[first].lo);
                let hi = pick(&mut b, "hi", p[i].hi, p[first].hi);
                Bounds { lo, hi }
            };
            let last = points - 1;
            let a = (0..3).map(|i| own("a", i, 0)).collect();
            (a, (0..3).map(|i| own("b", last - i, last)).collect())
        }
    };
    let [a_min, a_max] = extremes(&mut b, "a", &a);
    let [b_min, b_max] = extremes(&mut b, "b", &others);
    let below = b.less("a_below_b", a_max.hi, b_min.lo);
    let above = b.less("a_above_b", b_max.hi, a_min.lo);
    let reaches_up = b.less("a_reaches_b", a_min.hi, b_max.lo);
    let reaches_down = b.less("b_reaches_a", b_min.hi, a_max.lo);
    let separated = b.op("is_separated", Op::Or, &[below, above]);
    let overlapping = b.op("is_overlapping", Op::And, &[reaches_up, reaches_down]);
    b.output("separated", separated);
    b.output("overlapping", overlapping);
    b.finish()
}

/// Enclosures of the least and the greatest of three projections (equation 3): bounds by bounds, the order of the first
/// two found once for both.
fn extremes(b: &mut Builder, name: &str, p: &[Bounds]) -> [Bounds; 2] {
    let mut of_end = |end: &str, of: fn(&Bounds) -> NodeId| {
        let [first, second, third] = [of(&p[0]), of(&p[1]), of(&p[2])];
        let order = b.less(&format!("{name}_{end}_order"), first, second);
        let lesser = b.either(&format!("{name}_lesser_{end}"), order, first, second);
        let greater = b.either(&format!("{name}_greater_{end}"), order, second, first);
        let least = b.least(&format!("{name}_min_{end}"), lesser, third);
        let greatest = b.greatest(&format!("{name}_max_{end}"), greater, third);
        b.comment(least, "enclosure of the least projection (equation 3)");
        b.comment(greatest, "enclosure of the greatest projection (equation 3)");
        (least, greatest)
    };
    let (min_lo, max_lo) = of_end("lo", |x| x.lo);
    let (min_hi, max_hi) = of_end("hi", |x| x.hi);
    [Bounds { lo: min_lo, hi: min_hi }, Bounds { lo: max_lo, hi: max_hi }]
}

/// Projections with the duplicates replaced by their intersection.
fn intersected(b: &mut Builder, name: &str, p: &[Bounds], code: NodeId) -> Vec<Bounds> {
    type Choice = fn(&mut Builder, &str, NodeId, NodeId) -> NodeId;
    let mut joint = |end: &str, choice: Choice, of: fn(&Bounds) -> NodeId| -> Vec<NodeId> {
        let v: Vec<NodeId> = p.iter().map(of).collect();
        let pair = |b: &mut Builder, k: usize| choice(b, &format!("{name}_edge_{k}_{end}"), v[k], v[(k + 1) % 3]);
        let edges = [pair(b, 0), pair(b, 1), pair(b, 2)];
        let all = choice(b, &format!("{name}_all_{end}"), edges[0], v[2]);
        (0..3)
            .map(|i| {
                // Vertex i lies on edge i and on edge i - 1.
                let on = |k: usize| if k == i || (k + 1) % 3 == i { edges[k] } else { v[i] };
                let id = b.op(&format!("{name}_{i}_{end}"), Op::Select, &[code, v[i], on(0), on(1), on(2), all]);
                b.comment(id, "intersected with the projections equal to it")
            })
            .collect()
    };
    let lo = joint("lo", Builder::greatest, |x| x.lo);
    let hi = joint("hi", Builder::least, |x| x.hi);
    lo.into_iter().zip(hi).map(|(lo, hi)| Bounds { lo, hi }).collect()
}
