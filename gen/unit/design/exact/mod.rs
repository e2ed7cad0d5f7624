//! The exact unit: a pair of triangles on a grid, decided by the signs of fifteen determinants without rounding
//! (docs/exact.md).
//!
//! Differences and determinants are those of [`determinants`](super::determinants). In [`digits`] are products of factors
//! that are wider than a multiplier, in [`plane`] is the rule for pairs in one plane, in `verdict` that for all others. In
//! [`cascade`] another data path stands in front, which decides most pairs by rounded determinants.

pub mod cascade;
pub mod digits;
pub mod plane;
mod verdict;

use super::determinants::fifteen::{self, Fifteen};
use super::determinants::{Points, differences, shared, traced};
use super::guard::Guards;
use super::pipeline::Inputs;
use super::product::product;
use crate::params::Params;
use efsat_hardware::entity;
use efsat_hardware::graph::{Block, Library, Sig, Signals, Top, Vec3};
use std::rc::Rc;
use verdict::Outcome;

/// The data path for a parameter set. Its inputs are the pair and its pose, held for the slot; its outputs are `verdict`,
/// `outside`, and `separated` and `overlapping` (bit i: witness i).
pub fn unit(p: &Params) -> Rc<Block> {
    let doc = [
        "The data path of one pair: differences from V0, moments, fifteen determinants, the rule for pairs in one plane,",
        "verdict; nothing is rounded. Units are shared over the phases of the slot; a bound at a port covers all uses of the",
        "unit. A value captured for the pair is named after what it is; later copies end in _h<clocks>, or are elements of",
        "x_held.",
    ];
    Library::default().block("pair_pipeline", &doc, p.interval(), |u| {
        let inputs = Inputs::new(u, p);
        let guards = Guards::new(u, p);
        let doc = ["Section 2: the points relative to V0, B's in A's frame, and whether they fit."];
        let (points, outside) = u.section("pair_differences", &doc, || {
            let differences = differences::points(u, p, &guards, &inputs);
            fitted(p, &differences, &guards)
        });
        decided(u, &points, Some(outside))
    })
}

/// What the differences that fit decide: sections 3 to 6.
fn decided<'l>(u: Top<'l>, points: &Points<'l>, outside: Option<Sig<'l>>) -> Outcome<'l> {
    let doc = ["Section 3: moments of the edges of B, and the normal of A."];
    let moments = u.section("pair_moments", &doc, || moments(u, points));
    let doc = ["Sections 3 and 4: the fifteen determinants and their signs."];
    let signs = u.section("pair_determinants", &doc, || determinant_signs(u, points, &moments));
    let doc = ["Section 5: the rule for pairs in one plane."];
    let plane = u.section("pair_plane", &doc, || plane::plane(u, points, &moments));
    let doc = ["Section 6: witnesses and verdict."];
    u.section("pair_witnesses", &doc, || verdict::verdict(&signs, &plane, outside))
}

/// The signs of the fifteen determinants.
fn determinant_signs<'l>(u: Top<'l>, points: &Points<'l>, moments: &[Vec3<Sig<'l>>; 4]) -> Fifteen<Sign<'l>> {
    // Two products of differences, whatever A's may be behind a frame transform.
    let most = 2 * digits::most(points.v[0][0]).pow(2);
    let offset = (*moments).map(|m| m.map(|x| digits::offset(x, most)));
    (0..4).filter(|l| offset[*l] != moments[*l]).for_each(|l| {
        offset[l].named(&format!("offset_{}", MOMENTS[l]));
    });
    let determinants = fifteen::determinants(points, &offset, |jobs| digits::dot_products(u, jobs));
    signs(&determinants)
}

/// The differences in N bits each, and whether some did not fit or a guard found something. In place of those that do
/// not fit are zeros.
fn fitted<'l>(p: &Params, differences: &Points<'l>, guards: &Guards<'l, '_>) -> (Points<'l>, Sig<'l>) {
    let most = (1 << (p.width - 1)) - 1;
    let doc = [format!("A difference in {} bits. One beyond +-{most} is flagged, and 0 goes on.", p.width)];
    let fit = |x: Sig<'l>| {
        entity!("difference_fit", &doc.each_ref().map(String::as_str), (x) => {
            let outside = (x.less(x.like(-most)) | x.like(most).less(x)).named("outside");
            (outside.choose(x.like(0), x).assume(most, "fit").bits(p.width).named("fitted"), outside)
        })
    };
    let all = differences.all().map(|point| point.map(fit));
    let points = Points::of(all.map(|point| point.map(|(x, _)| x)).named("fitted"));
    let outside = all.map(|point| point.map(|(_, outside)| outside)).named("fit_outside").signals();
    guards.found(&outside);
    (
        points,
        guards.outside().expect("there are flags").comment(if p.has_guards() {
            "a number is outside its declared range, or a difference of coordinates does not fit"
        } else {
            "a difference of coordinates does not fit"
        }),
    )
}

/// The moments of the edges of B, then the normal of A, exact.
fn moments<'l>(u: Top<'l>, points: &Points<'l>) -> [Vec3<Sig<'l>>; 4] {
    let Points { v: [v1, v2], w: [w0, w1, w2] } = *points;
    let factors = [[w0, w1], [w1, w2], [w2, w0], [v1, v2]];
    let jobs: Vec<_> = factors.iter().flat_map(|[x, y]| (0..3).map(|i| factors_of(*x, *y, i))).collect();
    let all = components(u, "moment_component", &jobs);
    let of = |l: usize| Vec3([all[3 * l], all[3 * l + 1], all[3 * l + 2]]);
    [0, 1, 2, 3].map(|l| traced(of(l), &format!("moment_{}", MOMENTS[l])))
}

/// What the moments are called.
const MOMENTS: [&str; 4] = ["m0", "m1", "m2", "n"];

/// x_j y_k and x_k y_j, whose difference is component i of x x y, as (plus, minus).
type Factors<'l> = ([Sig<'l>; 2], [Sig<'l>; 2]);

/// The factors of component `i` of x x y.
fn factors_of<'l>(x: Vec3<Sig<'l>>, y: Vec3<Sig<'l>>, i: usize) -> Factors<'l> {
    ([x[i + 1], y[i + 2]], [x[i + 2], y[i + 1]])
}

/// Components of cross products.
fn components<'l>(u: Top<'l>, name: &str, jobs: &[Factors<'l>]) -> Vec<Sig<'l>> {
    shared(u, name, jobs, |k, (plus, minus)| {
        let (plus, minus) = (plus.named_at(&format!("{name}_plus"), k), minus.named_at(&format!("{name}_minus"), k));
        let doc = ["One component of a cross product, c = x y - x' y', exact."];
        let bits = 2 * plus[0].ty().bits;
        let component = entity!("cross_component", &doc, (plus, minus) => {
            (product(plus[0], plus[1]) - product(minus[0], minus[1])).bits(bits).named("c")
        });
        component.named_at(&format!("{name}_lane"), k)
    })
}

/// The signs of the determinants.
fn signs<'l>(determinants: &Fifteen<Sig<'l>>) -> Fifteen<Sign<'l>> {
    let all = fifteen::alike(determinants.all(), "of_sign");
    let doc = ["The sign of a number: (0) it is positive, (1) it is negative."];
    let of = |x: Sig<'l>| entity!("exact_sign", &doc, (x) => sign(x).named("sign"));
    Fifteen::of(&all.into_iter().map(of).collect::<Vec<_>>().named("sign"))
}

/// The sign of a number: whether it is positive, and whether it is negative.
type Sign<'l> = [Sig<'l>; 2];

/// Neither of the flags is set of 0.
fn sign(x: Sig<'_>) -> Sign<'_> {
    let negative = x.negative();
    [!negative & not_0(x), negative]
}

/// Flag: a number is not 0.
fn not_0(x: Sig<'_>) -> Sig<'_> {
    !x.equals(x.like(0))
}
