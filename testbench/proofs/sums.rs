//! Claims of additions, subtractions, edges and roundings.

use super::claim::Claim;
use super::rounding::claim_rounded;
use super::settings::{Setting, rule};
use super::unit::Mistake::{NoUlp, OtherBound, Reversed, WrongArm, WrongSign, WrongSlice};
use super::unit::Subject;
use efsat::design::interval::{self, Rounding};
use efsat::graph::{Builder, Type};
use efsat::number::Upper;
use efsat::params::Row;

/// Additions and subtractions are exact; at small widths also, every sum of two numbers from the operands is inside.
/// The transform's, which are twice as wide, are left out at small widths: that is the slowest proof, and the same one.
pub fn exact_sums(setting: &Setting) -> Vec<Claim> {
    let units = [
        ("projection_add_two", "x + y", "sum"),
        ("projection_add_three", "x + y", "sum"),
        ("transform_add_two", "x + y", "sum"),
        ("transform_add_t", "x + y", "sum"),
        ("transform_add_all", "x + y", "sum"),
        ("axis_subtract", "x - y", "difference"),
    ];
    let claim = |(name, result, signal): (&str, &str, &str)| {
        let property = if setting.small { "exact, contains the result" } else { "exact" };
        let mut claim = Claim::new(Subject::of_design(&setting.params, name), setting.label(), property);
        if setting.small {
            claim.within("x", "x").within("y", "y").shown(format!("lo <= {result} && {result} <= hi"));
        }
        claim.shown(match signal {
            "sum" => "lo == x_lo + y_lo && hi == x_hi + y_hi",
            _ => "lo == x_lo - y_hi && hi == x_hi - y_lo",
        });
        let (lo, hi) = (format!("{signal}_lo"), format!("{signal}_hi"));
        claim.mutant(OtherBound, &lo).mutant(OtherBound, &hi).mutant(WrongSign, &lo).mutant(WrongSign, &hi);
        claim
    };
    let taken = |unit: &(&str, &str, &str)| !setting.small || !unit.0.starts_with("transform");
    units.into_iter().filter(taken).map(claim).collect()
}

/// Edges: differences of coordinates in the format of their row.
pub fn edges(setting: &Setting) -> Vec<Claim> {
    let params = &setting.params;
    let formats = params.formats();
    let grid = formats.coordinate_a.format.fraction;
    let edge = |name: &str, row: &Row, anchored: bool| {
        let subject = Subject::of_design(params, name);
        let mut claim = Claim::new(subject, setting.label(), "contains x - y, within an ulp");
        claim.value("exact_lo", "x_lo - y_hi").value("exact_hi", "x_hi - y_lo");
        if setting.small {
            claim.within("x", "x").within("y", "y").value("truth", "x - y");
        } else {
            claim.between("truth", "exact_lo", "exact_hi", params.width + 1);
        }
        if anchored {
            // Lemma anchored-edge: a bound on the computed difference.
            let most = (1i128 << grid) + 1;
            claim.given(format!("-{most} <= exact_lo && exact_hi <= {most}"));
        }
        let way = Rounding { drop: grid - row.format.fraction, clamp: row.clamp.map(|c| (c.bound, c.lemma)) };
        claim_rounded(&mut claim, "1", "", "exact", way, params.upper);
        claim.mutant(OtherBound, "difference_lo").mutant(Reversed, "difference_hi");
        if way.drop > 0 {
            claim.mutant(NoUlp, "rounded_up").mutant(WrongSlice, "rounded_floor_lo");
        }
        claim
    };
    let mut claims = vec![edge("edge_b", &formats.edge_b, false), edge("edge_a", &formats.edge_a[1], false)];
    if params.renormalise {
        claims.push(edge("edge_a_anchored", &formats.edge_a[0], true));
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
            let widths = format!("{bits} bits, {drop} dropped, {}{clamped}", rule(upper));
            let mut claim = Claim::new(Subject::of_unit(&b.finish()), widths, "contains x, within an ulp");
            claim.value("exact_lo", "x_lo").value("exact_hi", "x_hi").within("truth", "x");
            claim_rounded(&mut claim, "1", "", "exact", way, upper);
            if drop <= 0 {
                claim.mutant(OtherBound, "lo");
            } else {
                claim.mutant(OtherBound, "rounded_floor_lo").mutant(NoUlp, "rounded_up");
                claim.mutant(WrongSlice, "rounded_floor_hi");
            }
            if drop > 1 && upper == Upper::Sticky {
                claim.mutant(WrongArm, "rounded_sticky");
            }
            claims.push(claim);
        }
    }
    claims
}
