//! Claims of additions, subtractions, edges and roundings, each operator as an entity of its own: in a design they stand
//! among others.

use super::claim::Claim;
use super::rounding::claim_rounded;
use super::settings::{Setting, rule};
use super::unit::Mistake::{NoUlp, OtherBound, Reversed, WrongSign, WrongSlice};
use super::unit::{Mistake, Subject};
use efsat::design::interval::Interval;
use efsat::design::rounding::{Rounding, Roundings};
use efsat::graph::{Library, Sig, Signals, Top};
use efsat::op::Type;
use efsat::params::{FormatRow, Upper};
use efsat_hardware::entity;

/// An interval of whole numbers, its bounds of all magnitudes that so many bits have with both signs.
pub fn interval(u: Top<'_>, bits: u32) -> Interval<Sig<'_>> {
    let most = (1 << (bits - 1)) - 1;
    let bound = || u.input(Type { signed: true, bits, fraction: None }, (-most, most));
    Interval { lo: bound(), hi: bound() }
}

/// A function of two intervals as an entity.
fn binary(
    name: &str,
    bits: u32,
    of: impl for<'l> Fn(Interval<Sig<'l>>, Interval<Sig<'l>>) -> Interval<Sig<'l>>,
) -> Subject {
    let unit = Library::default().block("operator", &[], 1, |u| {
        let (x, y) = (interval(u, bits).named("x"), interval(u, bits).named("y"));
        entity!(name, &[], (x, y) => of(x, y).named("r")).named("r")
    });
    Subject::of_unit(&unit, name)
}

/// Additions and subtractions are exact; where `sound`, every sum of two numbers from the operands is inside.
pub fn exact_sums(bits: u32, sound: bool) -> Vec<Claim> {
    let property = if sound { "exact, contains the result" } else { "exact" };
    let claim = |subject, result: &str, exact: &str| {
        let mut claim = Claim::new(subject, format!("{bits} bits"), property);
        if sound {
            claim.within("x", "x").within("y", "y").shown(format!("r_lo <= {result} && {result} <= r_hi"));
        }
        claim.shown(exact);
        for mistake in [OtherBound, WrongSign] {
            claim.mutant(mistake, "r.lo").mutant(mistake, "r.hi");
        }
        claim
    };
    vec![
        claim(binary("interval_add", bits, |x, y| x + y), "x + y", "r_lo == x_lo + y_lo && r_hi == x_hi + y_hi"),
        claim(binary("interval_subtract", bits, |x, y| x - y), "x - y", "r_lo == x_lo - y_hi && r_hi == x_hi - y_lo"),
    ]
}

/// Edges: differences of coordinates in the format of their row.
pub fn edges(setting: &Setting) -> Vec<Claim> {
    let params = &setting.params;
    let formats = params.formats();
    let grid = formats.coordinate_a.format.fraction;
    // Lemma anchored-edge: a bound on the computed difference.
    let most = (1i128 << grid) + 1;
    let edge = |name: &str, row: &FormatRow, anchored: bool| {
        let way = Rounding::to_row(grid, row);
        let unit = Library::default().block("operator", &[], 1, |u| {
            // Re-normalised coordinates are in [-1, 1].
            let coordinate = || u.input(Type::signed(params.width, grid), (-(1 << grid), 1 << grid));
            let point = |name: &str| Interval { lo: coordinate(), hi: coordinate() }.named(name);
            let (x, y) = (point("x"), point("y"));
            entity!(name, &[], (x, y) => {
                let exact = (x - y).named("exact");
                let exact = if anchored { exact.assume(most, "anchored-edge") } else { exact };
                let ty = Type::signed(params.width, grid - way.drop);
                exact.round_outward(&Roundings::one(way, params.upper, ty)).named("r")
            })
            .named("r")
        });
        let mut claim = Claim::new(Subject::of_unit(&unit, name), setting.label(), "contains x - y, within an ulp");
        claim.value("exact_lo", "x_lo - y_hi").value("exact_hi", "x_hi - y_lo");
        if setting.small {
            claim.within("x", "x").within("y", "y").value("exact_truth", "x - y");
        } else {
            claim.between("exact_truth", "exact_lo", "exact_hi", params.width + 1);
        }
        if anchored {
            claim.given(format!("-{most} <= exact_lo && exact_hi <= {most}"));
        }
        claim_rounded(&mut claim, "1", "r", "exact", way, params.upper);
        claim.mutant(OtherBound, "exact.lo").mutant(Reversed, "exact.hi");
        if way.drop > 0 {
            claim.mutant(NoUlp, "r.hi|r_hi_up").mutant(WrongSlice, "r.lo");
        }
        claim
    };
    let mut claims = vec![edge("edge_b", &formats.edge_b, false), edge("edge_a", &formats.edge_a[1], false)];
    if params.renormalise {
        claims.push(edge("edge_a_anchored", &formats.edge_a[0], true));
    }
    claims
}

/// Roundings by themselves: dropping bits, keeping them, appending zeros, and saturating.
pub fn roundings(bits: u32, most_dropped: u32) -> Vec<Claim> {
    let mut claims = vec![];
    for upper in [Upper::Implied, Upper::Sticky] {
        for (drop, most) in [(-2, None), (0, None), (1, None), (most_dropped as i32, None), (3, Some(5i128))] {
            let way = Rounding { drop, saturate: most.map(|most| (most, "edge-extent")) };
            let kept = if most.is_some() { 4 } else { (bits as i32 - drop.min(bits as i32) + 2) as u32 };
            let unit = Library::default().block("operator", &[], 1, |u| {
                let x = interval(u, bits).named("x");
                let ty = Type { signed: true, bits: kept, fraction: None };
                entity!("rounding", &[], (x) => x.round_outward(&Roundings::one(way, upper, ty)).named("r")).named("r")
            });
            let saturated = if most.is_some() { ", saturated" } else { "" };
            let widths = format!("{bits} bits, {drop} dropped, {}{saturated}", rule(upper));
            let mut claim = Claim::new(Subject::of_unit(&unit, "rounding"), widths, "contains x, within an ulp");
            claim.value("exact_lo", "x_lo").value("exact_hi", "x_hi").within("exact_truth", "x");
            claim_rounded(&mut claim, "1", "r", "exact", way, upper);
            let mut mutants: Vec<(Mistake, &str)> = vec![(OtherBound, "r.lo|r_saturated.hi|x_lo_floor_3_d1")];
            if drop > 0 {
                mutants.extend([
                    (NoUlp, "r.hi|r_hi_up|r_hi_up_up_d1|x_hi_floor_3_up_d1|x_hi_floor_3_up_up_d1"),
                    (WrongSlice, "r.lo|x_lo_floor_3_d1"),
                ]);
            }
            if most.is_some() {
                mutants.push((Mistake::WrongArm, "r_saturated.hi"));
            }
            for (mistake, signal) in mutants {
                claim.mutant(mistake, signal);
            }
            claims.push(claim);
        }
    }
    claims
}
