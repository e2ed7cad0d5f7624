//! One row of the frame transform, B = M B~ + t (section 3 of the contract).

use super::interval::Interval;
use super::number::Number;
use super::product::product;
use crate::params::Params;
use efsat_hardware::entity;
use efsat_hardware::graph::{Sig, Signals, Vec3};
use efsat_hardware::number::Upper;

/// `b = m0 x0 + m1 x1 + m2 x2 + t`, exact, then rounded outward once.
///
/// With `bypass` matrix and translation are exact, and nothing is rounded: for a row of the identity the result is x, bit
/// for bit.
pub fn transform_row<'l>(
    p: &Params,
    m: Vec3<Number<Sig<'l>>>,
    x: Vec3<Number<Sig<'l>>>,
    t: Number<Sig<'l>>,
    bypass: Sig<'l>,
) -> Interval<Sig<'l>> {
    let doc = [
        "One row of the frame transform, b = m . x + t (section 3 of the contract), exact, then rounded outward once.",
        "With bypass m and t are exact and nothing is rounded.",
        "",
        "A bound is a lower bound plus none or one unit in the last place (m_ulp, x_ulp), so one product serves both ends:",
        "  lo = sum of m x + (m if m < 0 and x_ulp) + (x if x < 0 and m_ulp) + (1 if both)",
        "  hi = sum of m x + (m if m >= 0 and x_ulp) + (x if x >= 0 and m_ulp) + (1 if both), and what t is above its bound",
    ];
    let fraction = p.input().fraction;
    entity!("transform_row", &doc, (m, x, t, bypass) => {
        let inexact = |n: Number<Sig<'l>>| n.sticky.unwrap_or(!bypass);
        let products = m.zip(x, |m, x| product(m.lo, x.lo)).named("product");
        let point = products[0].ty().fraction;
        let sum = (products[0] + products[1]).named("sum_xy") + (products[2] + t.lo.floor(-fraction)).named("sum_zt");
        let sum = sum.named("sum");
        // What an end adds to the sum: terms for the factors of the sign that it takes the other's upper bound with.
        let end = |name: &str, takes: &dyn Fn(Sig<'l>) -> Sig<'l>| {
            let takes_m = m.zip(x, |m, x| takes(m.lo.negative()) & x.inexact()).named(&format!("{name}_takes_m"));
            let takes_x = m.zip(x, |m, x| takes(x.lo.negative()) & inexact(m)).named(&format!("{name}_takes_x"));
            let term = |j: usize| {
                let of = |takes: Sig<'l>, n: Number<Sig<'l>>| takes.choose(n.lo, n.lo.like(0));
                of(takes_m[j], m[j]).plus(of(takes_x[j], x[j]), takes_m[j] & takes_x[j])
            };
            let terms = Vec3::each(term).named(&format!("{name}_term"));
            ((terms[0] + terms[1]) + terms[2]).at_point(point).named(&format!("{name}_terms"))
        };
        let lo = (sum + end("lo", &|negative| negative)).named("lo_exact");
        let terms = end("hi", &|negative| !negative);
        let ty = t.lo.ty();
        let hi = match p.upper {
            // Two units: one above t, one of rounding up. With bypass t is exact and nothing is rounded.
            Upper::Implied => (sum + terms).named("hi_exact").floor(fraction) + (!bypass).floor(-1),
            Upper::Sticky => {
                let hi = ((sum + inexact(t).floor(-fraction)) + terms).named("hi_exact");
                hi.floor(fraction) + hi.low(fraction as u32).any()
            }
        };
        bounded(p, Interval { lo: lo.floor(fraction), hi }).each(|_, end| end.resize(ty)).named("b")
    })
}

/// `b = x + t`, a pure translation, exact.
pub fn translate_row<'l>(p: &Params, x: Number<Sig<'l>>, t: Number<Sig<'l>>, bypass: Sig<'l>) -> Interval<Sig<'l>> {
    let doc = ["One coordinate of the frame transform, b = x + t (a pure translation), exact. With bypass t is exact."];
    entity!("transform_row", &doc, (x, t, bypass) => {
        let ty = x.lo.ty();
        let x = x.interval();
        let t_hi = t.lo + t.sticky.unwrap_or(!bypass);
        bounded(p, Interval { lo: x.lo + t.lo, hi: x.hi + t_hi }).each(|_, end| end.resize(ty)).named("b")
    })
}

/// What the declared ranges say of a transformed coordinate: with sticky bits no bound of a number is farther from zero than
/// its declared range, which the lower bound and the bit do not tell each by itself.
fn bounded<'l>(p: &Params, b: Interval<Sig<'l>>) -> Interval<Sig<'l>> {
    match p.upper {
        Upper::Implied => b,
        Upper::Sticky => b.each(|_, end| end.assume(p.formats().transformed_bound(), "declared-range")),
    }
}
