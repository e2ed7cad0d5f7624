//! Claims of additions, subtractions, edges and roundings.

use super::claim::Claim;
use super::rounding::{claim_rounded, Exact};
use super::settings::{label, Setting};
use super::unit::Mistake::{NoUlp, NotStrict, OtherBound, Reversed, WrongArm, WrongSign, WrongSlice};
use super::unit::Subject;
use efsat::design::interval::{self, Rounding};
use efsat::graph::{Builder, Rate, Type};
use efsat::number::Upper;
use efsat::params::{Params, Row};

/// Additions and subtractions: exact, and every sum of two numbers from the operands is inside.
pub fn exact_sums(setting: &Setting) -> Vec<Claim> {
    let params = &setting.params;
    let adders = ["projection_add_two", "projection_add_three", "transform_add_two", "transform_add_t", "transform_add_all"];
    let mut claims: Vec<Claim> = adders
        .into_iter()
        .map(|name| {
            let mut claim = Claim::new(Subject::of_design(params, name), label(params), "exact sum, contains x + y");
            claim.within("x", "x").within("y", "y").shown("lo <= x + y && x + y <= hi");
            claim.shown("lo == x_lo + y_lo && hi == x_hi + y_hi");
            claim.mutant(OtherBound, "sum_lo").mutant(OtherBound, "sum_hi").mutant(WrongSign, "sum_lo");
            claim
        })
        .collect();
    let subject = Subject::of_design(params, "axis_subtract");
    let mut claim = Claim::new(subject, label(params), "exact difference, contains x - y");
    claim.within("x", "x").within("y", "y").shown("lo <= x - y && x - y <= hi");
    claim.shown("lo == x_lo - y_hi && hi == x_hi - y_lo");
    claim.mutant(OtherBound, "difference_lo").mutant(OtherBound, "difference_hi").mutant(Reversed, "difference_lo");
    claims.push(claim);
    claims
}

/// Edges: differences of coordinates in the format of their row.
pub fn edges(setting: &Setting) -> Vec<Claim> {
    let params = &setting.params;
    let formats = params.formats();
    let grid = formats.coordinate_a.format.fraction;
    let edge = |name: &str, row: &Row, anchored: bool| {
        let mut claim = Claim::new(Subject::of_design(params, name), label(params), "contains x - y, within an ulp");
        claim.within("x", "x").within("y", "y");
        if anchored {
            // Lemma anchored-edge: a bound on the computed difference.
            let most = (1i128 << grid) + 1;
            claim.given(format!("-{most} <= x_lo - y_hi && x_hi - y_lo <= {most}"));
        }
        let way = Rounding { drop: grid - row.format.fraction, clamp: row.clamp.map(|c| (c.bound, c.lemma)) };
        let exact = Exact { lo: "(x_lo - y_hi)", hi: "(x_hi - y_lo)", truth: "(x - y)" };
        claim_rounded(&mut claim, "1", "", &exact, way, params.upper);
        claim.mutant(OtherBound, "difference_lo").mutant(Reversed, "difference_hi");
        if way.drop > 0 {
            claim.mutant(NoUlp, "rounded_up").mutant(WrongSlice, "rounded_floor_lo");
        }
        claim
    };
    let mut claims = vec![edge("edge_b", &formats.edge_b, false), edge("edge_a", &formats.edge_a[1], false)];
    if params.renormalise {
        claims.push(edge("edge_a_anchored", &formats.edge_a[0], true));
    } else {
        claims.pop();
    }
    claims
}

/// Roundings by themselves: dropping bits, keeping them, appending zeros, and a clamp.
pub fn roundings(bits: u32, most_dropped: u32) -> Vec<Claim> {
    let mut claims = vec![];
    for upper in [Upper::Implied, Upper::Sticky] {
        for (drop, clamp) in [(-2, None), (0, None), (1, None), (most_dropped as i32, None), (3, Some(5i128))] {
            let ty = Type::signed(bits, 0);
            let way = Rounding { drop, clamp: clamp.map(|bound| (bound, "edge-extent")) };
            let kept = if clamp.is_some() { 4 } else { (bits as i32 - drop.min(bits as i32) + 2) as u32 };
            let mut b = Builder::new("rounding", 1, &[]);
            let x = interval::input(&mut b, "x", ty, ty.limits());
            let result = interval::round(&mut b, "rounded", x, &[way], None, upper, kept);
            interval::output(&mut b, "", result);
            let clamped = if clamp.is_some() { ", clamped" } else { "" };
            let widths = format!("{bits} bits, {drop} dropped, {}{clamped}", super::settings::rule(upper));
            let mut claim = Claim::new(Subject::of_unit(&b.finish()), widths, "contains x, within an ulp");
            claim.within("x", "x");
            claim_rounded(&mut claim, "1", "", &Exact { lo: "x_lo", hi: "x_hi", truth: "x" }, way, upper);
            if drop > 0 {
                claim.mutant(OtherBound, "rounded_floor_lo").mutant(NoUlp, "rounded_up");
                if drop > 1 {
                    claim.mutant(WrongSlice, "rounded_floor_hi");
                }
            }
            if drop > 0 && upper == Upper::Sticky {
                claim.mutant(WrongArm, "rounded_sticky");
            }
            claims.push(claim);
        }
    }
    claims
}
