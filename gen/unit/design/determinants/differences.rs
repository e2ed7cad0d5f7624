//! Five points relative to the floor of V0 (section 2 of docs/determinants.md).

use super::super::guard::Guards;
use super::super::number::Number;
use super::super::pipeline::Inputs;
use super::super::product::product;
use super::{Points, constant, shared};
use crate::params::{Method, Params, Transform};
use efsat_hardware::device::MULTIPLIER_BITS;
use efsat_hardware::entity;
use efsat_hardware::graph::{Sig, Signals, Top, Vec3};
use efsat_hardware::op::Type;

/// An integer that a multiplier takes.
const FACTOR: Type = Type { signed: true, bits: MULTIPLIER_BITS, fraction: None };

/// The differences, T + 1 bits each.
pub(in super::super) fn points<'l>(u: Top<'l>, p: &Params, guards: &Guards<'l, '_>, inputs: &Inputs<'l>) -> Points<'l> {
    let guarded = |x: Vec3<Number<Sig<'l>>>, bound: i128, name: (&str, Option<usize>)| {
        Vec3(guards.guarded(x.0, bound, &[], name)).map(|number| number.lo.at_point(None))
    };
    let bound = p.coordinate_bound();
    let v = [0, 1, 2].map(|k| guarded(inputs.v[k], bound, ("in_v", Some(k))));
    let w = [0, 1, 2].map(|l| guarded(inputs.w[l], bound, ("in_w", Some(l))));
    let origin = v[0];
    // Any words may be added where nothing is rounded.
    let sums = p.method == Method::Exact && p.transform == Transform::Translate;
    let bits = p.transform_width + if sums { 2 } else { 1 };
    let narrow = |x: Vec3<Sig<'l>>| x.map(|x| x.bits(bits));
    let of_a = [v[1] - origin, v[2] - origin].map(narrow);
    let of_b = match &inputs.pose {
        None => w.map(|w| w - origin),
        Some(pose) => {
            let t = pose.t.map(|t| Number { lo: pose.bypass.choose(t.lo.like(0), t.lo), ..t });
            let t = guarded(t, p.translation_bound(), ("pose_t", None));
            let moved = (t - origin).named("moved").comment("t - V0, or - V0 with the bypass");
            match pose.m.filter(|_| p.transform == Transform::On) {
                None => w.map(|w| w + moved),
                Some(m) => {
                    let used = (!pose.bypass).named("pose_m_used");
                    let rows = [0, 1, 2].map(|i| {
                        let row = guards.guarded_if(used, m[i].0, p.one(), ("pose_m", i));
                        Vec3(row).map(|number| number.lo.at_point(None))
                    });
                    turned(u, p, rows, w, moved, pose.bypass)
                }
            }
        }
    };
    Points { v: of_a, w: of_b.map(narrow) }.traced("difference")
}

/// The rows of M times the vertices.
fn turned<'l>(
    u: Top<'l>,
    p: &Params,
    m: [Vec3<Sig<'l>>; 3],
    w: [Vec3<Sig<'l>>; 3],
    moved: Vec3<Sig<'l>>,
    bypass: Sig<'l>,
) -> [Vec3<Sig<'l>>; 3] {
    let mut rows: Vec<(usize, usize)> = (0..9).map(|job| (job % 3, job / 3)).collect();
    if u.interval() == 2 {
        // The two jobs of a unit have the row or the vertex in common.
        rows = vec![(0, 0), (1, 0), (2, 0), (0, 2), (2, 2), (0, 1), (1, 1), (2, 1), (1, 2)];
    }
    let job = |&(i, l): &(usize, usize)| ((m[i], w[l]), [moved[i], w[l][i]]);
    let x = shared(u, "difference", &rows.iter().map(job).collect::<Vec<_>>(), |k, ((m, w), [moved, same])| {
        let turned = row(p, m.named_at("row_m", k), w.named_at("row_w", k)).named_at("row_turned", k);
        let turned = bypass.choose(same.named_at("row_same", k), turned);
        (turned + moved.named_at("row_moved", k)).named_at("row", k)
    });
    let of = |i: usize, l: usize| x[rows.iter().position(|row| *row == (i, l)).expect("every row is computed")];
    [0, 1, 2].map(|l| Vec3::each(|i| of(i, l)))
}

/// A row of M times a vertex.
pub fn row<'l>(p: &Params, m: Vec3<Sig<'l>>, w: Vec3<Sig<'l>>) -> Sig<'l> {
    let fraction = p.input().fraction as u32;
    // The low bits of a factor that is too wide for a multiplier.
    let low_bits = (fraction + 3).saturating_sub(MULTIPLIER_BITS);
    let cut = low_bits > 0 && 2 * low_bits <= fraction;
    let parts =
        format!("three products of two factors, cut at bit {low_bits}; low times low is left out, its middle added");
    let doc = [
        "One row of M times one vertex: the sum of (2 m + 1) (2 w + 1), the middles of both, rounded to the input format",
        "(section 2 of docs/determinants.md):",
        if cut { &parts } else { "the products are exact" },
    ];
    // One more bit than 2^f has, for the sign.
    let middle = |x: Sig<'l>| constant(x.block(), 1).below(&[x.bits(fraction + 2)]);
    entity!("difference_row", &doc, (m, w) => {
        let (m, w) = (m.map(middle).named("m_middle"), w.map(middle).named("w_middle"));
        let sum = |x: Vec3<Sig<'l>>, more: i128| (x[0] + x[1]) + (x[2] + constant(x[0].block(), more));
        let half = 1 << (fraction + 1);
        let turned = if cut {
            let (q, high) = (low_bits, |x: Sig<'l>| x.floor(low_bits as i32));
            let low = |x: Sig<'l>| x.low(low_bits).resize(FACTOR);
            let highs = m.zip(w, |m, w| product(high(m), high(w))).named("high_high");
            let mixed = m.zip(w, |m, w| product(high(m), low(w)) + product(low(m), high(w))).named("high_low");
            // In units of 2^q: three halves of 2^q for the products of low parts, and half a unit of the result.
            let mixed = sum(mixed, (3 << (q - 1)) + (half >> q)).named("mixed");
            let highs = (highs[0] + highs[1]) + highs[2];
            (highs.named("high") + mixed.floor(q as i32)).named("sum").floor((fraction + 2 - 2 * q) as i32)
        } else {
            sum(m.zip(w, product).named("product"), half).named("sum").floor(fraction as i32 + 2)
        };
        turned.assume(3 * p.one() + 4, "row").bits(p.transform_width).named("turned")
    })
}
