//! The comparator network of one axis: from projections to *separated* and *surely overlapping* (equations 3 and 6, and
//! the contract's section 6 in place of 7 to 9).

use super::guard::any;
use super::interval::Interval;
use efsat_hardware::entity;
use efsat_hardware::graph::{Sig, Signals};
use efsat_hardware::op::{And, Select, Type};

/// Which projections of a triangle are equal in exact arithmetic: none, edge 0, 1, 2, all three.
pub const DUPLICATES: Type = Type::index(5);

/// How the projections belong to the triangles.
#[derive(Clone)]
pub enum Owners<'l> {
    /// The first three are A's, the others B's from the last one down.
    Fixed,
    /// As with `Fixed`; those that are equal in exact arithmetic are intersected, by a code for each triangle.
    Intersected([Sig<'l>; 2]),
    /// The first is A's and the last B's; those between belong to either, by a flag for the second and third of each.
    Shared([Vec<Sig<'l>>; 2]),
}

/// Whether points of B certainly are above points of A, and whether they are below: a flag for each of the [`pairs`].
pub type Sides<'l> = [Vec<Sig<'l>>; 2];

/// One point of A with one of B, by their places among `count` projections: A's from the first on, B's from the last one
/// down, at most three of each.
pub fn pairs(count: usize) -> impl Iterator<Item = [usize; 2]> {
    (0..3).flat_map(move |a| (1..=3).map(move |b| [a, count - b])).filter(|[a, b]| a < b)
}

/// One axis decided from the projections of the points: separated, and surely overlapping; with `edges` also where the
/// points are as they are projected.
pub fn comparator<'l>(
    p: Vec<Interval<Sig<'l>>>,
    owners: Owners<'l>,
    edges: bool,
) -> ((Sig<'l>, Sig<'l>), Option<Sides<'l>>) {
    let mut doc = vec![
        "Decides one axis by comparing every point of A with every point of B (equations 3 and 6):",
        "  above: b_lo > a_hi; below: a_lo > b_hi",
        "  separated   = all above or all below, so b_min_lo > a_max_hi or a_min_lo > b_max_hi",
        "  overlapping = some above and some below, so a_min_hi < b_max_lo and b_min_hi < a_max_lo (sound in place of",
        "                equations 7 to 9; strict)",
    ];
    if !matches!(owners, Owners::Shared(_)) {
        doc.push("p(0) to p(2) are A's, p(3) to p(5) are B's from the last one down.");
    }
    match owners {
        Owners::Fixed => entity!("comparator_network", &doc, (p) => {
            let sides = sides(&p, "");
            (decide(&sides, &[]), edges.then_some(sides))
        }),
        Owners::Intersected(duplicates) => entity!("comparator_network", &doc, (p, duplicates) => {
            let joint = [intersected(&p[..3], duplicates[0], "a"), intersected(&p[3..], duplicates[1], "b")].concat();
            (decide(&sides(&joint, "joint_"), &[]), edges.then(|| sides(&p, "")))
        }),
        Owners::Shared(has) => {
            let last = p.len() - 1;
            let between = (1..last).map(|i| {
                let owns = |name, triangle: usize, place: usize| {
                    (place < 3).then(|| format!("{name} if has({triangle})({}) is set", place - 1))
                };
                let owners = [owns("A's", 0, i), owns("B's", 1, last - i)].into_iter().flatten().collect::<Vec<_>>();
                format!("  p({i}) is {}", owners.join(", "))
            });
            let between = between.collect::<Vec<_>>();
            let ends =
                format!("p(0) is A's, p({last}) is B's. separated and overlapping count comparisons of A with B:");
            doc.push(&ends);
            doc.extend(between.iter().map(String::as_str));
            entity!("comparator_network", &doc, (p, has) => {
                let sides = sides(&p, "");
                let has = |triangle: usize, place: usize| (place > 0).then(|| has[triangle][place - 1]);
                let counts = |(i, [a, b]): (usize, [usize; 2])| {
                    let both = [has(0, a), has(1, last - b)].into_iter().flatten();
                    both.reduce(|a, b| a.apply(And, &[b]).named_at("counts", i))
                };
                (decide(&sides, &pairs(p.len()).enumerate().map(counts).collect::<Vec<_>>()), edges.then_some(sides))
            })
        }
    }
}

/// Where points of B certainly are.
fn sides<'l>(p: &[Interval<Sig<'l>>], name: &str) -> Sides<'l> {
    let above = pairs(p.len()).map(|[a, b]| p[a].hi.less(p[b].lo)).collect::<Vec<_>>();
    let below = pairs(p.len()).map(|[a, b]| p[b].hi.less(p[a].lo)).collect::<Vec<_>>();
    [above.named(&format!("{name}above")), below.named(&format!("{name}below"))]
}

/// Equation 6, and the test that two projections surely overlap. A pair with a flag counts where that is set.
fn decide<'l>([above, below]: &Sides<'l>, counts: &[Option<Sig<'l>>]) -> (Sig<'l>, Sig<'l>) {
    let some = |flags: Vec<Sig<'l>>| {
        let counted = flags.iter().enumerate().map(|(i, flag)| match counts.get(i).copied().flatten() {
            Some(counts) => flag.apply(And, &[counts]),
            None => *flag,
        });
        any(&counted.collect::<Vec<_>>())
    };
    let not_all = |flags: &Vec<Sig<'l>>| some(flags.each(|_, flag| !flag));
    let separated = !(not_all(above).named("not_all_above") & not_all(below).named("not_all_below"));
    let overlapping = some(above.clone()).named("some_above") & some(below.clone()).named("some_below");
    (separated.named("separated"), overlapping.named("overlapping"))
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
