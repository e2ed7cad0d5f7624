//! The comparator network of one axis: from projections to *separated* and *surely overlapping* (equations 3 and 6, and
//! the contract's section 6 in place of 7 to 9).

use super::interval::Interval;
use efsat_hardware::entity;
use efsat_hardware::graph::{Sig, Signals};
use efsat_hardware::op::{Select, Type};

/// Which projections of a triangle are equal in exact arithmetic: none, edge 0, 1, 2, all three.
pub const DUPLICATES: Type = Type::index(5);

/// How the projections belong to the triangles.
#[derive(Clone)]
pub enum Owners<'l> {
    /// The first three are A's, the others B's.
    Fixed,
    /// As with `Fixed`; those that are equal in exact arithmetic are intersected, by a code for each triangle.
    Intersected([Sig<'l>; 2]),
    /// The first is A's and the last B's; those between belong to either, by a flag for the second and third of each.
    Shared([Vec<Sig<'l>>; 2]),
}

/// One axis decided from the projections of the points: separated, and surely overlapping.
pub fn comparator<'l>(p: Vec<Interval<Sig<'l>>>, owners: Owners<'l>) -> (Sig<'l>, Sig<'l>) {
    let doc = [
        "Decides one axis: enclosures of the least and greatest projection of each triangle (equation 3), then",
        "  separated   = b_min_lo > a_max_hi or a_min_lo > b_max_hi   (equation 6)",
        "  overlapping = a_min_hi < b_max_lo and b_min_hi < a_max_lo  (sound in place of 7 to 9; strict)",
    ];
    let last = p.len() - 1;
    match owners {
        Owners::Fixed => entity!("comparator_network", &doc, (p) => decide(&p[..3], &p[3..])),
        Owners::Intersected(duplicates) => entity!("comparator_network", &doc, (p, duplicates) => {
            let [a, b] = duplicates;
            decide(&intersected(&p[..3], a, "a"), &intersected(&p[3..], b, "b"))
        }),
        Owners::Shared(has) => entity!("comparator_network", &doc, (p, has) => {
            let own = |i: usize, first: usize, has: Sig<'l>| has.choose(p[i], p[first]);
            let others = |triangle: usize, [second, third]: [usize; 2], first: usize, name: &str| {
                let has = &has[triangle];
                let [second, third] = [own(second, first, has[0]), own(third, first, has[1])].named(name);
                [p[first], second, third]
            };
            decide(&others(0, [1, 2], 0, "a"), &others(1, [last - 1, last - 2], last, "b"))
        }),
    }
}

/// Equation 6, and the test that two projections surely overlap.
fn decide<'l>(a: &[Interval<Sig<'l>>], b: &[Interval<Sig<'l>>]) -> (Sig<'l>, Sig<'l>) {
    let (a_min, a_max) = extremes(a, "a");
    let (b_min, b_max) = extremes(b, "b");
    let separated = a_max.hi.less(b_min.lo) | b_max.hi.less(a_min.lo);
    let overlapping = a_min.hi.less(b_max.lo) & b_min.hi.less(a_max.lo);
    (separated.named("separated"), overlapping.named("overlapping"))
}

/// Enclosures of the least and the greatest of three projections (equation 3): bound by bound, the order of the first two
/// found once for both.
fn extremes<'l>(p: &[Interval<Sig<'l>>], name: &str) -> (Interval<Sig<'l>>, Interval<Sig<'l>>) {
    let of = |end: &str, bound: fn(&Interval<Sig<'l>>) -> Sig<'l>| {
        let [first, second, third] = [bound(&p[0]), bound(&p[1]), bound(&p[2])];
        let order = first.less(second).named(&format!("{name}_ordered_{end}"));
        let lesser = order.choose(first, second).named(&format!("{name}_lesser_{end}"));
        let greater = order.choose(second, first).named(&format!("{name}_greater_{end}"));
        let least = lesser.less(third).choose(lesser, third);
        let greatest = greater.less(third).choose(third, greater);
        (least, greatest)
    };
    let (min_lo, max_lo) = of("lo", |x| x.lo);
    let (min_hi, max_hi) = of("hi", |x| x.hi);
    let min = Interval { lo: min_lo, hi: min_hi }.named(&format!("{name}_min"));
    let max = Interval { lo: max_lo, hi: max_hi }.named(&format!("{name}_max"));
    (min, max)
}

/// Projections with the duplicates replaced by their intersection.
fn intersected<'l>(p: &[Interval<Sig<'l>>], code: Sig<'l>, name: &str) -> Vec<Interval<Sig<'l>>> {
    let meet = |x: Interval<Sig<'l>>, y: Interval<Sig<'l>>| Interval {
        lo: x.lo.less(y.lo).choose(y.lo, x.lo),
        hi: x.hi.less(y.hi).choose(x.hi, y.hi),
    };
    let edges = [0, 1, 2].map(|k| meet(p[k], p[(k + 1) % 3])).named(&format!("{name}_edge"));
    let all = meet(edges[0], p[2]).named(&format!("{name}_all"));
    let joint = |i: usize| {
        // Vertex i lies on edge i and on edge i - 1.
        let on = |k: usize| if k == i || (k + 1) % 3 == i { edges[k] } else { p[i] };
        let ways = [p[i], on(0), on(1), on(2), all];
        let end = |of: fn(&Interval<Sig<'l>>) -> Sig<'l>| {
            code.apply(Select::default(), &ways.iter().map(of).collect::<Vec<_>>())
        };
        Interval { lo: end(|x| x.lo), hi: end(|x| x.hi) }
    };
    (0..3).map(joint).collect::<Vec<_>>().named(&format!("{name}_joint"))
}
